//! The mollified impulse method: one stiff oscillator and one free particle in a soft potential.

use std::f64::consts::PI;

use symplectic::State;
use symplectic::flow::{
    Error, Flow, FlowError, FlowSteps, Kick, Linear, MollifiedKick, Palindrome, Span, Splitting,
};
use symplectic::nalgebra::{DMatrix, Matrix4, Vector1, Vector2, Vector4};

use crate::common::methods::{Gauss8, StoermerVerlet};
use crate::common::{distance, run};

type V = Vector2<f64>;

symplectic::hamiltonian! {
    /// The slow part.
    Soft q: [x, y], p: [u, v]; H = (u^2 + v^2)/2 + (x + y)^2/2 + y^4/4
}

symplectic::hamiltonian! {
    /// Both parts.
    Both { stiffness: 400 } q: [x, y], p: [u, v]; H = (u^2 + v^2 + stiffness x^2)/2 + (x + y)^2/2 + y^4/4
}

fn fast(frequency: f64) -> Result<Linear, Error> {
    let stiffness = DMatrix::from_row_slice(2, 2, &[frequency * frequency, 0.0, 0.0, 0.0]);
    Linear::oscillators(&[1.0; 2], &stiffness)
}

/// Kicks at means over `duration`.
fn step(frequency: f64, duration: f64) -> Result<impl Flow<V> + Clone, Error> {
    let fast = fast(frequency)?;
    let kick = MollifiedKick::new(Soft, &fast, duration)?;
    Ok(Splitting::new(StoermerVerlet, fast, kick))
}

fn start(frequency: f64) -> State<V> {
    State::from_arrays(0.0, [0.5 / frequency, 0.7], [0.3, -0.2])
}

/// The largest error of the energy in 8000 steps, with an energy of about 0.5.
fn worst(flow: impl Flow<V>, frequency: f64, size: f64) -> Result<f64, Error> {
    let mut run = FlowSteps::run(flow, start(frequency), size)?;
    let stiffness = frequency * frequency;
    let energy = |state: &State<V>| {
        let (q, p) = (state.q, state.p);
        (p.norm_squared() + stiffness * q.x * q.x + (q.x + q.y).powi(2)) / 2.0 + q.y.powi(4) / 4.0
    };
    let before = energy(run.state());
    let mut worst = 0.0_f64;
    for _ in 0..8000 {
        worst = worst.max((energy(run.step()?) - before).abs());
    }
    Ok(worst)
}

/// Where a step is one or two halves of a fast period the impulse method gains energy without a bound.
#[test]
fn mollified_steps_stay_bounded_at_resonances() -> Result<(), Error> {
    let frequency = 20.0;
    for halves in [1.0, 2.0] {
        let size = halves * PI / frequency;
        let impulse = Splitting::new(StoermerVerlet, fast(frequency)?, Kick::new(Soft));
        let impulse = worst(impulse, frequency, size)?;
        // The book has these bounds.
        assert!(impulse > 400.0, "{impulse}");
        let long = worst(step(frequency, size)?, frequency, size)?;
        assert!(long < 0.045, "{long}");
        // The mean over half of a step vanishes at the second resonance only.
        let short = worst(step(frequency, size / 2.0)?, frequency, size)?;
        match halves {
            1.0 => assert!(short > 10.0, "{short}"),
            _ => assert!(short < 0.05, "{short}"),
        }
    }
    Ok(())
}

#[test]
fn the_order_is_two() -> Result<(), Error> {
    let frequency = 4.0;
    let (stiffness, end) = (frequency * frequency, 3.0);
    let exact = run(Gauss8, Both { stiffness }, start(frequency), end, 300)?;
    let error = |steps: u32, part: f64| -> Result<f64, Error> {
        let size = end / f64::from(steps);
        let mut run = FlowSteps::run(step(frequency, part * size)?, start(frequency), size)?;
        Ok(distance(run.integrate_to(end)?, &exact))
    };
    for part in [0.5, 1.0] {
        let slope = (error(100, part)? / error(200, part)?).log2();
        assert!((slope - 2.0).abs() < 0.05, "{slope}");
    }
    // Means over a time that stays leave an error that stays.
    let fixed = |steps: u32| error(steps, 0.1 * f64::from(steps) / end);
    assert!((fixed(100)? / fixed(200)?).log2() < 0.2);
    Ok(())
}

/// By differences of order 4 over 10⁻³: an error of about 10⁻¹², of the truncation and of rounding.
fn defect(mut flow: impl Flow<V>) -> Result<f64, Error> {
    let mut map = |z: Vector4<f64>| {
        let (mut q, mut p) = (V::new(z[0], z[1]), V::new(z[2], z[3]));
        let span = Span {
            time: 0.0,
            size: 0.3,
        };
        flow.flow(span, &mut q, &mut p).expect("a step");
        Vector4::new(q.x, q.y, p.x, p.y)
    };
    let at = Vector4::new(0.3, -0.8, 0.4, 0.9);
    let mut difference = |k: usize, size: f64| {
        let by = Vector4::from_fn(|i, _| if i == k { size } else { 0.0 });
        (map(at + by) - map(at - by)) / (2.0 * size)
    };
    let columns: Vec<_> = (0..4)
        .map(|k| (difference(k, 1e-3) * 4.0 - difference(k, 2e-3)) / 3.0)
        .collect();
    let jacobian = Matrix4::from_columns(&columns);
    let form = Matrix4::from_fn(|i, j| f64::from(i + 2 == j) - f64::from(j + 2 == i));
    Ok((jacobian.transpose() * form * jacobian - form).amax())
}

/// The kick at mean positions without the transpose of their derivative.
struct Half(f64);

impl Flow<V> for Half {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        let mut mean = V::new(q.x * self.0, q.y);
        Kick::new(Soft).flow(span, &mut mean, p)
    }
}

#[test]
fn a_step_is_symplectic() -> Result<(), Error> {
    let whole = defect(step(5.0, 0.3)?)?;
    assert!(whole < 1e-9, "{whole:e}");
    let half = defect(Palindrome::new(Half(1.5_f64.sin() / 1.5), fast(5.0)?))?;
    assert!(half > 1e-3, "{half:e}");
    Ok(())
}

/// Coupled oscillators of different masses, against the sum over small steps of the fast motion.
#[test]
fn means_are_those_of_the_fast_motion() -> Result<(), Error> {
    let stiffness = DMatrix::from_row_slice(2, 2, &[30.0, -12.0, -12.0, 20.0]);
    let fast = Linear::oscillators(&[1.0, 3.0], &stiffness)?;
    let duration = 1.7;
    let (start, count) = (V::new(0.4, -0.9), 64);
    // Simpson's rule has an error of about (hω)⁴/180.
    let mut flow = fast.clone();
    let at = |flow: &mut Linear, part: f64| {
        let (mut q, mut p) = (start, V::zeros());
        let size = part * duration;
        flow.flow(Span { time: 0.0, size }, &mut q, &mut p)
            .map(|()| q)
    };
    let mut mean = V::zeros();
    for k in 0..=2 * count {
        let weight = match (k, k % 2) {
            (0, _) => 1.0,
            (k, _) if k == 2 * count => 1.0,
            (_, 1) => 4.0,
            _ => 2.0,
        };
        let q = at(&mut flow, f64::from(k) / f64::from(2 * count)).expect("a flow");
        mean += q * (weight / f64::from(6 * count));
    }
    // A force that is the position: Aᵀ A q.
    symplectic::hamiltonian! { Saddle q: [x, y], p: [u, v]; H = (u^2 + v^2 - x^2 - y^2)/2 }
    let mut kick = MollifiedKick::new(Saddle, &fast, duration)?;
    let (mut q, mut p) = (start, V::zeros());
    kick.flow(
        Span {
            time: 0.0,
            size: 1.0,
        },
        &mut q,
        &mut p,
    )
    .expect("a kick");
    // q·AᵀAq = |Aq|².
    assert!((p.dot(&start) - mean.norm_squared()).abs() < 1e-6);
    assert_eq!(q, start);
    let mut none = MollifiedKick::new(Saddle, &fast, 0.0)?;
    let mut p = V::zeros();
    none.flow(
        Span {
            time: 0.0,
            size: 1.0,
        },
        &mut q,
        &mut p,
    )
    .expect("a kick");
    assert_eq!(p, start);
    Ok(())
}

#[test]
fn bad_input_is_refused() -> Result<(), Error> {
    for duration in [-0.1, f64::NAN, f64::INFINITY, 1e16] {
        let refused = MollifiedKick::<_, V>::new(Soft, &fast(20.0)?, duration).err();
        assert!(matches!(
            refused,
            Some(Error::FlowParameter {
                what: "duration of the mean",
                ..
            })
        ));
    }
    symplectic::hamiltonian! { Line q: [x], p: [u]; H = (u^2 + x^2)/2 }
    let mut kick = MollifiedKick::new(Line, &fast(20.0)?, 0.1)?;
    let (mut q, mut p) = (Vector1::new(1.0), Vector1::new(0.0));
    let refused = kick.flow(
        Span {
            time: 0.0,
            size: 0.1,
        },
        &mut q,
        &mut p,
    );
    let (expected, found) = (2, 1);
    assert_eq!(refused, Err(FlowError::Dimension { expected, found }));
    Ok(())
}
