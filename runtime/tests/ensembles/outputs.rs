//! What is made of many trajectories, against closed forms.

use std::ops::ControlFlow;

use symplectic::State;
use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::Vector1;

use crate::common::methods::Yoshida6;

symplectic::hamiltonian! {
    Oscillator { omega }
    q: [x], p: [px];
    H = px^2/2 + (omega x)^2/2
}

#[test]
fn oscillators_are_where_they_should_be() {
    let family = |k: u32| {
        let omega = 1.0 + 0.1 * f64::from(k);
        let starts = (1..=5).map(|a| State::from_arrays(0.0, [f64::from(a)], [0.0]));
        (Oscillator { omega }, starts.collect())
    };
    let ensemble = Ensemble::of_families(Yoshida6, (0..3).map(family), 0.02).expect("starts");
    let times = [0.5, 1.0, 2.75];
    let see = |seen: &mut Vec<_>, state: &State<Vector1<f64>>| seen.push((state.time, state.q[0]));
    let mut shown = 0;
    ensemble.integrate_at(
        &times,
        |_| Vec::new(),
        see,
        |row| {
            let (k, a) = (row.trajectory / 5, row.trajectory % 5 + 1);
            let omega = 1.0 + 0.1 * k as f64;
            assert_eq!(row.output.len(), times.len());
            for ((time, q), expected) in row.output.into_iter().zip(times) {
                assert_eq!(time, expected);
                // A cubic between steps of 0.02: (h/2)⁴/4!·ω⁴ a < 5e-9 a.
                assert!((q - a as f64 * (omega * time).cos()).abs() < 1e-8 * a as f64);
            }
            shown += 1;
            ControlFlow::Continue(())
        },
    );
    assert_eq!(shown, 15);
}
