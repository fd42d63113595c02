//! Ready flows, against closed forms and the same motion in canonical coordinates.

use symplectic::flow::{
    Damping, Drift, Error, Flow, FlowError, FlowSteps, Gyration, Kick, Linear, OrnsteinUhlenbeck,
    Palindrome, Span,
};
use symplectic::nalgebra::{DMatrix, DVector, Rotation3, SMatrix, Vector1, Vector2, Vector3};
use symplectic::{State, System, acceleration};

use crate::common::methods::Gauss5;
use crate::common::run;

const fn span(size: f64) -> Span {
    Span { time: 0.0, size }
}

/// Three masses 1 between two walls, by springs 1: the frequencies are `2 sin(kπ/8)`, the modes sines.
#[test]
fn a_linear_system_has_its_modes() {
    let stiffness =
        DMatrix::from_row_slice(3, 3, &[2.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 2.0]);
    let mut flow = Linear::oscillators(&[1.0; 3], &stiffness).expect("a system");
    let eighth = std::f64::consts::PI / 8.0;
    for size in [1e-3, 0.1, -0.7, 3.0, 50.0] {
        for k in 1..4 {
            let frequency = 2.0 * (f64::from(k) * eighth).sin();
            let mode =
                Vector3::from_fn(|i, _| (f64::from(k) * 2.0 * eighth * (i as f64 + 1.0)).sin());
            let (mut q, mut p) = (mode, mode * 0.5);
            flow.flow(span(size), &mut q, &mut p).expect("a flow");
            let (sine, cosine) = (frequency * size).sin_cos();
            let expected = mode * (cosine + 0.5 / frequency * sine);
            let momentum = mode * (0.5 * cosine - frequency * sine);
            let bound = 4e-16 * (2.0 + 3.0 * size.abs());
            assert!(
                (q - expected).norm() < bound,
                "{size}: {}",
                (q - expected).norm()
            );
            assert!((p - momentum).norm() < 2.0 * bound);
        }
    }
}

#[test]
fn a_stiffness_that_is_not_symmetric_is_refused() {
    let lopsided = DMatrix::from_row_slice(2, 2, &[1.0, 0.5, 0.0, 1.0]);
    let refused = Linear::oscillators(&[1.0; 2], &lopsided).err();
    let named = |error| {
        matches!(
            error,
            Error::FlowParameter {
                what: "stiffness",
                ..
            }
        )
    };
    assert!(refused.is_some_and(named));
    // What rounding leaves beside zeros is none of the matrix.
    let rounded = DMatrix::from_row_slice(2, 2, &[1.0, 1e-17, -3e-17, 1.0]);
    assert!(Linear::oscillators(&[1.0; 2], &rounded).is_ok());
}

/// A saddle with masses, the product of its two directions, and frequencies far apart.
#[test]
fn a_linear_system_may_grow_and_be_stiff() {
    let mut saddle =
        Linear::oscillators(&[4.0], &DMatrix::from_element(1, 1, -9.0)).expect("a system");
    let (mut q, mut p) = (Vector1::new(1.0), Vector1::new(2.0));
    saddle.flow(span(4.0), &mut q, &mut p).expect("a flow");
    let (x, rate) = (6.0_f64, 1.5);
    let expected = x.cosh() + 2.0 / (4.0 * rate) * x.sinh();
    assert!((q[0] / expected - 1.0).abs() < 1e-14);
    let stiffness = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 1e8]);
    let mut stiff = Linear::oscillators(&[1.0; 2], &stiffness).expect("a system");
    let (mut q, mut p) = (Vector2::new(1.0, 1.0), Vector2::zeros());
    stiff.flow(span(1.0), &mut q, &mut p).expect("a flow");
    assert!((q - Vector2::new(1.0_f64.cos(), 1e4_f64.cos())).norm() < 1e-9);
    let (mut q, mut p) = (Vector1::new(1.0), Vector1::new(0.0));
    let failure = saddle.flow(span(1e6), &mut q, &mut p);
    assert!(matches!(failure, Err(FlowError::NonFinite { .. })));
    assert_eq!((q[0], p[0]), (1.0, 0.0));
    // Of cos 10¹⁶ nothing is known from 10¹⁶ with rounding.
    let mut spring = Linear::oscillators(&[1.0], &DMatrix::identity(1, 1)).expect("a system");
    let failure = spring.flow(span(1e16), &mut q, &mut p);
    assert!(matches!(failure, Err(FlowError::Other { .. })));
    assert_eq!((q[0], p[0]), (1.0, 0.0));
    assert!(matches!(
        Linear::new(&DMatrix::zeros(3, 3)),
        Err(Error::FlowParameter { value: 3.0, .. })
    ));
    let entry = DMatrix::from_element(2, 2, f64::NAN);
    assert!(matches!(
        Linear::new(&entry),
        Err(Error::FlowParameter { .. })
    ));
}

symplectic::hamiltonian! {
    /// A charge in the field B = (0, 0, 1 + x²) and a potential, by its canonical momentum.
    Charge
    q: [x, y, z], p: [px, py, pz];
    H = (px^2 + (py - x - x^3/3)^2 + pz^2)/2 + (x^2 + 2 y^2 + z^2)/10
}

fn field(_time: f64, q: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(0.0, 0.0, 1.0 + q.x * q.x)
}

fn boris() -> impl Flow<Vector3<f64>> + Clone {
    let well = acceleration::<Vector3<f64>, _>(|_, q, force| {
        *force = Vector3::new(-0.2 * q.x, -0.4 * q.y, -0.2 * q.z);
    });
    let inner = Palindrome::new(Kick::new(well), Gyration::new(field));
    Palindrome::new(Drift::new(well), inner)
}

const CHARGE: (Vector3<f64>, Vector3<f64>) =
    (Vector3::new(0.5, -0.3, 0.2), Vector3::new(0.4, 0.7, -0.1));

#[test]
fn a_charge_moves_as_with_its_canonical_momentum() {
    let (q, v) = CHARGE;
    let potential = |q: &Vector3<f64>| Vector3::new(0.0, q.x + q.x.powi(3) / 3.0, 0.0);
    let start = State::new(0.0, q, v + potential(&q));
    let exact = run(Gauss5, Charge, start, 5.0, 500).expect("a run");
    let velocity = exact.p - potential(&exact.q);
    let [coarse, fine] = [200, 400].map(|steps| {
        let size = 5.0 / f64::from(steps);
        let mut run = FlowSteps::run(boris(), State::new(0.0, q, v), size).expect("a run");
        let end = run.integrate_to(5.0).expect("steps");
        (end.q - exact.q).norm() + (end.p - velocity).norm()
    });
    let slope = (coarse / fine).log2();
    assert!((slope - 2.0).abs() < 0.05, "{slope}");
}

/// The determinant of a step by differences is 1, and the step is not symplectic in position and velocity.
#[test]
fn a_step_in_a_magnetic_field_keeps_the_volume() {
    let step = |at: SMatrix<f64, 6, 1>| {
        let (mut q, mut v) = (
            at.fixed_rows::<3>(0).into_owned(),
            at.fixed_rows::<3>(3).into_owned(),
        );
        boris().flow(span(0.4), &mut q, &mut v).expect("a step");
        SMatrix::<f64, 6, 1>::from_fn(|i, _| if i < 3 { q[i] } else { v[i - 3] })
    };
    let (q, v) = CHARGE;
    let at = SMatrix::<f64, 6, 1>::from_fn(|i, _| if i < 3 { q[i] } else { v[i - 3] });
    let difference = |k: usize, size: f64| {
        let mut by = SMatrix::<f64, 6, 1>::zeros();
        by[k] = size;
        (step(at + by) - step(at - by)) / (2.0 * size)
    };
    // Of order 4 in the size of the differences.
    let columns =
        [0, 1, 2, 3, 4, 5].map(|k| (difference(k, 1e-3) * 4.0 - difference(k, 2e-3)) / 3.0);
    let derivative = SMatrix::<f64, 6, 6>::from_columns(&columns);
    let volume = derivative.determinant();
    assert!((volume - 1.0).abs() < 1e-10, "{volume}");
    let form = SMatrix::<f64, 6, 6>::from_fn(|i, j| match (i + 3 == j, j + 3 == i) {
        (true, _) => 1.0,
        (_, true) => -1.0,
        _ => 0.0,
    });
    assert!((derivative.transpose() * form * derivative - form).norm() > 0.1);
}

#[test]
fn a_magnetic_field_turns_velocities_only() {
    let mut flow = Gyration::new(|time, _: &Vector3<f64>| Vector3::new(0.3, -0.4, 1.2) * time);
    let span = Span {
        time: 2.0,
        size: 0.7,
    };
    let (mut q, mut v) = CHARGE;
    flow.flow(span, &mut q, &mut v).expect("a flow");
    assert_eq!(q, CHARGE.0);
    // By the matrix of a rotation of nalgebra, at the time 2.35.
    let turned = Rotation3::new(Vector3::new(0.3, -0.4, 1.2) * (-2.35 * 0.7)) * CHARGE.1;
    assert!((v - turned).norm() < 1e-15);
    let mut broken = Gyration::new(|_, _: &Vector3<f64>| Vector3::repeat(f64::NAN));
    assert!(matches!(
        broken.flow(span, &mut q, &mut v),
        Err(FlowError::NonFinite { .. })
    ));
    let (mut q, mut v) = (Vector2::zeros(), Vector2::x());
    assert_eq!(
        flow.flow(span, &mut q, &mut v),
        Err(FlowError::Dimension {
            expected: 3,
            found: 2
        })
    );
}

type V = Vector1<f64>;

fn spring() -> impl System<V, Class = symplectic::Separable> + Copy {
    acceleration::<V, _>(|_, q, force| force[0] = -q[0])
}

/// The area between two solutions of a linear equation with friction decays by `e^{−γt}`.
#[test]
#[ignore = "thorough"]
fn the_rate_of_the_decay_is_exact_over_a_million_steps() {
    let (rate, size, steps) = (1e-3, 0.1, 1_000_000);
    let ends = [(1.0, 0.0), (0.0, 1.0)].map(|(q, p)| {
        let free = Palindrome::new(Drift::new(spring()), Damping::new(rate).expect("a rate"));
        let step = Palindrome::new(Kick::new(spring()), free);
        let mut run = FlowSteps::run(step, State::from_arrays(0.0, [q], [p]), size).expect("a run");
        for _ in 0..steps {
            run.step().expect("a step");
        }
        (run.state().q[0], run.state().p[0])
    });
    let area = ends[0].0 * ends[1].1 - ends[1].0 * ends[0].1;
    let found = -area.ln() / (size * f64::from(steps));
    assert!((found / rate - 1.0).abs() < 1e-12, "{found}");
    for rate in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            Damping::new(rate),
            Err(Error::FlowParameter { .. })
        ));
    }
}

const BODIES: usize = 2000;

/// BAOAB of many oscillators of frequency 1 with two masses, at rest first: after a long time.
fn heated(size: f64, seed: u64) -> State<DVector<f64>> {
    let masses: Vec<f64> = (0..BODIES).map(|k| [1.0, 3.0][k % 2]).collect();
    let velocities = masses.clone();
    let system = symplectic::separable::<DVector<f64>, _, _>(
        move |_, p, velocity| {
            for (k, velocity) in velocity.iter_mut().enumerate() {
                *velocity = p[k] / velocities[k];
            }
        },
        {
            let masses = masses.clone();
            move |_, q, force| {
                for (k, force) in force.iter_mut().enumerate() {
                    *force = -masses[k] * q[k];
                }
            }
        },
    );
    let kick = Kick::new(system);
    let bath = OrnsteinUhlenbeck::new(1.0, 2.0, masses.clone(), seed).expect("a bath");
    let velocities = masses;
    let drift = symplectic::separable::<DVector<f64>, _, _>(
        move |_, p, velocity| {
            for (k, velocity) in velocity.iter_mut().enumerate() {
                *velocity = p[k] / velocities[k];
            }
        },
        |_, _, force| force.fill(0.0),
    );
    let step = Palindrome::new(kick, Palindrome::new(Drift::new(drift), bath));
    let zero = DVector::zeros(BODIES);
    let mut run = FlowSteps::run(step, State::new(0.0, zero.clone(), zero), size).expect("a run");
    run.integrate_to(40.0).expect("steps");
    run.into_state()
}

/// Of BAOAB with oscillators the position has the exact variance, and the momentum `mkT(1 − h²/4)`.
#[test]
fn a_bath_has_its_temperature() {
    for size in [0.1, 1.0] {
        let state = heated(size, 7);
        let mass = |k: usize| [1.0, 3.0][k % 2];
        let mean = |of: &dyn Fn(usize) -> f64| (0..BODIES).map(of).sum::<f64>() / BODIES as f64;
        let kinetic = mean(&|k| state.p[k].powi(2) / mass(k));
        let potential = mean(&|k| state.q[k].powi(2) * mass(k));
        // Four times the error of a mean of squares of normal numbers.
        let bound = 4.0 * 2.0 * (2.0 / BODIES as f64).sqrt();
        assert!(
            (kinetic - 2.0 * (1.0 - size * size / 4.0)).abs() < bound,
            "{kinetic}"
        );
        assert!((potential - 2.0).abs() < bound, "{potential}");
        // No two are correlated.
        let correlation = mean(&|k| state.q[k] * state.q[(k + 1) % BODIES] * 3.0_f64.sqrt());
        assert!(correlation.abs() < bound, "{correlation}");
        let across = mean(&|k| state.q[k] * state.p[k]);
        assert!(across.abs() < bound, "{across}");
    }
    assert_eq!(heated(1.0, 7), heated(1.0, 7));
    assert_ne!(heated(1.0, 7), heated(1.0, 8));
}

/// Moments of the noise alone, over many draws: mean, variance, and the fourth moment.
#[test]
fn the_noise_is_normal() {
    let mut bath = OrnsteinUhlenbeck::new(0.5, 1.5, [2.0; 3], 1).expect("a bath");
    let count = 200_000;
    let variance = 3.0 * (1.0 - (-1.0_f64).exp());
    let mut sums = [0.0; 3];
    for _ in 0..count {
        let (mut q, mut p) = (Vector3::zeros(), Vector3::zeros());
        bath.flow(span(1.0), &mut q, &mut p).expect("a flow");
        for x in p.iter().map(|p| p / variance.sqrt()) {
            [x, x * x, x.powi(4)]
                .iter()
                .zip(&mut sums)
                .for_each(|(x, sum)| *sum += x);
        }
    }
    let samples = 3.0 * f64::from(count);
    for (sum, (moment, spread)) in sums.iter().zip([(0.0, 1.0_f64), (1.0, 2.0), (3.0, 96.0)]) {
        let error = (sum / samples - moment) / (spread / samples).sqrt();
        assert!(error.abs() < 4.0, "{moment}: {error}");
    }
    assert_eq!(bath.draws(), u64::from(count as u32));
}

#[test]
fn a_bath_cannot_go_backward_and_can_go_on() {
    let mut bath = OrnsteinUhlenbeck::new(0.5, 1.0, [1.0], 3).expect("a bath");
    let flow = |bath: &mut OrnsteinUhlenbeck<[f64; 1]>, size| {
        let (mut q, mut p) = (V::zeros(), V::new(0.7));
        bath.flow(span(size), &mut q, &mut p).map(|()| p[0])
    };
    assert_eq!(
        flow(&mut bath, -0.1),
        Err(FlowError::Backward { size: -0.1 })
    );
    let all = [(); 4].map(|()| flow(&mut bath, 0.1));
    let mut again = OrnsteinUhlenbeck::new(0.5, 1.0, [1.0], 3).expect("a bath");
    again.set_draws(2);
    assert_eq!(flow(&mut again, 0.1), all[2]);
    assert_eq!(flow(&mut again, 0.1), all[3]);
    for (friction, temperature, mass) in [(-1.0, 1.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0, 0.0)] {
        let failure = OrnsteinUhlenbeck::new(friction, temperature, [mass], 0);
        assert!(matches!(failure, Err(Error::FlowParameter { .. })));
    }
}
