//! Fast parts in substeps: r-RESPA.

use std::cell::Cell;
use std::rc::Rc;

use symplectic::flow::{Drift, FlowSteps, Kick, Linear, Splitting, Substeps};
use symplectic::nalgebra::{DMatrix, SVector};
use symplectic::{Separable, State, System, separable};

use crate::common::methods::{Gauss5, StoermerVerlet};
use crate::common::{distance, run};

const N: usize = 12;

type V = SVector<f64, N>;

/// A chain with fixed ends: every other bond is stiff, and those between are soft and not linear.
fn chain(
    stiff: bool,
    soft: bool,
    count: Rc<Cell<u32>>,
) -> impl System<V, Class = Separable> + Clone {
    separable::<V, _, _>(
        |_, p, velocity: &mut V| *velocity = *p,
        move |_, q: &V, force: &mut V| {
            count.set(count.get() + 1);
            let at = |i: usize| if (1..=N).contains(&i) { q[i - 1] } else { 0.0 };
            let tension = |bond: usize| {
                let stretch = at(bond + 1) - at(bond);
                match bond % 2 {
                    1 if stiff => 400.0 * stretch,
                    0 if soft => stretch + 0.5 * stretch.powi(3),
                    _ => 0.0,
                }
            };
            for i in 0..N {
                force[i] = tension(i + 1) - tension(i);
            }
        },
    )
}

const END: f64 = 8.0;

/// The error at the end, and the evaluations of the slow force.
#[test]
fn slow_forces_are_evaluated_less_often() {
    let start = State::new(
        0.0,
        V::from_fn(|i, _| 0.5 * (0.6 * (i as f64)).sin()),
        V::from_fn(|i, _| 0.3 * (1.1 * (i as f64)).cos()),
    );
    let none = || Rc::new(Cell::new(0));
    let exact = run(Gauss5, chain(true, true, none()), start.clone(), END, 4000).expect("a run");
    let slow_forces = |outer: u32, inner: u32| {
        let (fast, slow) = (none(), none());
        let drift = Drift::new(chain(false, false, none()));
        let step = Splitting::new(StoermerVerlet, drift, Kick::new(chain(true, false, fast)));
        let step = Splitting::new(
            StoermerVerlet,
            Substeps::new(step, inner).expect("substeps"),
            Kick::new(chain(false, true, slow.clone())),
        );
        let all = Substeps::new(step, outer).expect("steps");
        let mut run = FlowSteps::run(all, start.clone(), END).expect("a run");
        run.integrate_to(END).expect("steps");
        (distance(run.state(), &exact), slow.get())
    };
    let plain = |steps: u32| {
        let count = none();
        let end = run(
            StoermerVerlet,
            chain(true, true, count.clone()),
            start.clone(),
            END,
            steps,
        );
        (distance(&end.expect("a run"), &exact), count.get())
    };
    let (error, evaluations) = plain(8000);
    let (nested_error, nested) = slow_forces(1000, 8);
    assert_eq!((evaluations, nested), (8001, 1001));
    assert!(nested_error <= 1.01 * error, "{nested_error} {error}");

    // The fast part exactly: the rest is of order 2.
    let stiffness = DMatrix::from_fn(N, N, |i, j| match (i, j) {
        _ if i == j => 400.0,
        _ if i.abs_diff(j) == 1 && i.max(j) % 2 == 1 => -400.0,
        _ => 0.0,
    });
    let [coarse, fine] = [250, 500].map(|steps| {
        let fast = Linear::oscillators(&[1.0; N], &stiffness).expect("a system");
        let kick = Kick::new(chain(false, true, none()));
        let step = Splitting::new(StoermerVerlet, fast, kick);
        let size = END / f64::from(steps);
        let mut run = FlowSteps::run(step, start.clone(), size).expect("a run");
        distance(run.integrate_to(END).expect("steps"), &exact)
    });
    let slope = (coarse / fine).log2();
    assert!((slope - 2.0).abs() < 0.05, "{slope}");
    assert!(fine < error, "{fine} {error}");
}
