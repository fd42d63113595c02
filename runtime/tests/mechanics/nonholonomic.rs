//! Motion, order, reversibility and energy of steps with non-holonomic constraints.

use symplectic::constraints::{Nonholonomic, consistent_momentum};
use symplectic::nalgebra::{SVector, Vector2, Vector3};
use symplectic::system::Class;
use symplectic::{Hamiltonian, Integrator, Method, ProvedFor, Separable, State, Vector};

use crate::rolling::*;
use crate::systems::{HalfSteps4, Pendulum, Rattle};

/// The distance of two vectors in their largest component.
fn distance<V: Vector<Scalar = f64>>(a: &V, b: &V) -> f64 {
    let pairs = a.as_slice().iter().zip(b.as_slice());
    pairs.fold(0.0_f64, |largest, (a, b)| largest.max((a - b).abs()))
}

/// The states at t = 1 of runs with numbers of steps, each twice the one before.
fn ends<M, S, C, V>(method: M, system: S, start: &State<V>, steps: u32) -> [State<V>; 3]
where
    M: Method + Copy + ProvedFor<Nonholonomic<C>>,
    V: Vector<Scalar = f64>,
    S: Hamiltonian<Class = Nonholonomic<C>, Vector<f64> = V> + Copy,
    C: Class + symplectic::system::Unconstrained,
{
    [1, 2, 4].map(|factor| {
        let size = 1.0 / f64::from(factor * steps);
        let mut run = Integrator::new(method, system, start.clone(), size).expect("consistent");
        run.integrate_to(1.0).expect("converges").clone()
    })
}

/// Checks that errors shrink with an order and no other one.
#[track_caller]
fn assert_order(errors: [f64; 3], order: f64, method: &str) {
    let slopes = [0, 1].map(|k| (errors[k] / errors[k + 1]).log2());
    assert!(
        (slopes[1] - order).abs() < 0.05,
        "{method}: slopes {slopes:?} of {errors:?}"
    );
}

/// θ and φ grow by the same amounts in every step, by `hω (I + R²)/(I + R² cos(Ωh/2))` and `hΩ`: along the constraints
/// `(I + R²)ω` is the momentum, and the impulse of the constraints turns it by half the angle of the step. The disk goes round on a circle
/// of radius `R Δθ/(2 sin(Ωh/2))`.
#[test]
fn the_rolling_disk_goes_round_on_a_circle() {
    const SIZE: f64 = 0.3;
    let start = disk_start();
    let turned = 0.8 * SIZE;
    let square = RADIUS * RADIUS;
    let rolled = 1.3 * SIZE * (0.3 + square) / (0.3 + square * (turned / 2.0).cos());
    let radius = RADIUS * rolled / (2.0 * (turned / 2.0).sin());
    let (sin, cos) = start.q[3].sin_cos();
    let centre = [start.q[0] - radius * sin, start.q[1] + radius * cos];
    let mut run = Integrator::new(Midpoint, Disk, start.clone(), SIZE).expect("a run");
    for k in 1..=1000 {
        let q = run.step().expect("a step").q;
        let angles = [
            start.q[2] + f64::from(k) * rolled,
            start.q[3] + f64::from(k) * turned,
        ];
        assert!((q[2] - angles[0]).abs() < 5e-14 * angles[0], "θ, step {k}");
        assert!((q[3] - angles[1]).abs() < 5e-14 * angles[1], "φ, step {k}");
        let found = (q[0] - centre[0]).hypot(q[1] - centre[1]);
        assert!(
            (found - radius).abs() < 1e-12,
            "step {k}: {found} for {radius}"
        );
    }
    // The circle of the motion is smaller.
    assert!((radius - RADIUS * 1.3 / 0.8).abs() > 1e-3);
}

/// A skate that turns at the rate Ω on a slope s goes on a cycloid: x = s sin²(Ωt)/2Ω², y = s(Ωt − sin(2Ωt)/2)/2Ω².
#[test]
fn a_skate_on_a_slope_goes_on_a_cycloid() {
    let (slope, rate) = (2.0, 1.5_f64);
    let start = State::new(0.0, Vector3::zeros(), Vector3::new(0.0, 0.0, rate));
    let factor = slope / (2.0 * rate * rate);
    let exact = Vector3::new(
        factor * rate.sin().powi(2),
        factor * (rate - (2.0 * rate).sin() / 2.0),
        rate,
    );
    let system = Skate { slope };
    let errors = |ends: [State<Vector3<f64>>; 3]| ends.map(|end| distance(&end.q, &exact));
    assert_order(errors(ends(Midpoint, system, &start, 20)), 2.0, "midpoint");
    assert_order(
        errors(ends(Trapezoid, system, &start, 20)),
        2.0,
        "trapezoid",
    );
    assert_order(errors(ends(Midpoint4, system, &start, 20)), 4.0, "order 4");
    // It does not go down: after half a turn it is as high as at the start.
    let mut run = Integrator::new(Midpoint6, system, start, 0.02).expect("a run");
    let end = run
        .integrate_to(std::f64::consts::PI / rate)
        .expect("a turn");
    assert!(end.q[0].abs() < 1e-9 && end.p[0].abs() < 1e-9, "{end:?}");
}

/// Across the slope a skate at rest stays there, though the force on it is not small.
#[test]
fn a_skate_across_the_slope_stays_at_rest() {
    let start = State::from_arrays(0.0, [0.0, 0.0, std::f64::consts::FRAC_PI_2], [0.0; 3]);
    let mut run = Integrator::new(Midpoint, Skate { slope: 9.81 }, start, 0.1).expect("a run");
    let end = run.integrate_to(10.0).expect("it converges");
    assert!(end.q[0].abs() < 1e-13 && end.q[1].abs() < 1e-13, "{end:?}");
}

macro_rules! orders {
    ($exact:expr, $system:expr, $start:expr, [$($method:ident $steps:literal $order:literal,)*]) => {$({
        let ends = ends($method, $system, $start, $steps);
        let errors = ends.map(|end| ($exact)(&end));
        assert_order(errors, f64::from($order), stringify!($method));
    })*};
}

#[test]
fn nonholonomic_methods_have_their_orders_on_an_oscillator() {
    let exact = oscillator_exact(1.0);
    let error =
        |end: &State<Vector3<f64>>| distance(&end.q, &exact.q).max(distance(&end.p, &exact.p));
    orders!(error, Oscillator, &oscillator_start(), [
        Midpoint 20 2, Trapezoid 20 2, Thirds 20 2, AtStart 320 1, AtEnd 320 1, Midpoint4 20 4, Trapezoid4 20 4, Midpoint6 3 6,
        Gauss1And2 20 2, QuarterAndAdjoint 20 2, HalfSteps4 20 4,
    ]);
}

/// v' = ℓω², v² + (I + ℓ²)ω² = C²: the speed is C tanh(ℓC(t − t0)/(I + ℓ²)).
#[test]
fn nonholonomic_methods_have_their_orders_on_a_sleigh() {
    let (a, speed, rate) = (0.3, -0.4, 1.1_f64);
    let start = State::new(
        0.0,
        Vector3::new(0.1, 0.2, a),
        sleigh_momentum(a, speed, rate),
    );
    let inertia = INERTIA + LENGTH * LENGTH;
    let constant = (speed * speed + inertia * rate * rate).sqrt();
    let phase = (speed / constant).atanh() + LENGTH * constant / inertia;
    let exact = [
        constant * phase.tanh(),
        constant / inertia.sqrt() / phase.cosh(),
    ];
    let error = |State { q, p, .. }: &State<Vector3<f64>>| {
        let mut velocity = Vector3::zeros();
        Sleigh.velocity(0.0, q, p, &mut velocity);
        let speed = velocity[0] * q[2].cos() + velocity[1] * q[2].sin();
        (speed - exact[0]).abs().max((velocity[2] - exact[1]).abs())
    };
    orders!(error, Sleigh, &start, [
        Midpoint 20 2, Trapezoid 20 2, AtStart 320 1, AtEnd 320 1, Midpoint4 20 4, Midpoint6 3 6,
        Gauss1And2 20 2, QuarterAndAdjoint 20 2, HalfSteps4 20 4,
    ]);
}

/// There and back: symmetric methods return, and the constraint at one end does not, unless it goes back with that at the other.
#[test]
fn symmetric_steps_go_back() {
    fn distance_back<M, N>(there: M, back: N) -> f64
    where
        M: Method + ProvedFor<Nonholonomic<Separable>>,
        N: Method + ProvedFor<Nonholonomic<Separable>>,
    {
        let start = oscillator_start();
        let mut run = Integrator::new(there, Oscillator, start.clone(), 0.1).expect("a run");
        for _ in 0..50 {
            run.step().expect("a step");
        }
        let turn = run.state().clone();
        let mut run = Integrator::new(back, Oscillator, turn, -0.1).expect("a run");
        for _ in 0..50 {
            run.step().expect("a step");
        }
        let State { q, p, .. } = run.state();
        distance(q, &start.q).max(distance(p, &start.p))
    }
    for back in [
        distance_back(Midpoint, Midpoint),
        distance_back(Trapezoid, Trapezoid),
        distance_back(Thirds, Thirds),
        distance_back(Midpoint4, Midpoint4),
        distance_back(AtStart, AtEnd),
        distance_back(AtEnd, AtStart),
    ] {
        assert!(back < 2e-13, "{back:e}");
    }
    for astray in [distance_back(AtStart, AtStart), distance_back(AtEnd, AtEnd)] {
        assert!(astray > 1e-2, "{astray:e}");
    }
}

/// The discrete Lagrange–d'Alembert equation, without a momentum: with the midpoint rule
/// `(q2 − 2q1 + q0)/h − h (F(½(q0 + q1)) + F(½(q1 + q2)))/2` is in the span of `w(q1)`, and `w(½(q0 + q1))·(q1 − q0) = 0`. So positions do
/// not depend on the multiplier that makes velocities obey the constraint.
#[test]
fn positions_obey_the_equation_without_momenta() {
    const SIZE: f64 = 0.1;
    let mut run = Integrator::new(Midpoint, Oscillator, oscillator_start(), SIZE).expect("a run");
    let mut positions = vec![oscillator_start().q];
    for _ in 0..200 {
        let State { q, p, .. } = run.step().expect("a step");
        positions.push(*q);
        assert!((p[2] - q[1] * p[0]).abs() < 4e-16);
    }
    let mut largest = 0.0_f64;
    for three in positions.windows(3) {
        let [before, now, after] = [three[0], three[1], three[2]];
        let force = |a: Vector3<f64>, b: Vector3<f64>| {
            Vector3::new(-(a[0] + b[0]) / 2.0, -(a[1] + b[1]) / 2.0, 0.0)
        };
        let impulse = (after - now * 2.0 + before) / SIZE
            - (force(before, now) + force(now, after)) * (SIZE / 2.0);
        // w = (y, 0, −1)
        assert!(impulse[1].abs() < 1e-13, "{impulse}");
        assert!(
            (impulse[0] + now[1] * impulse[2]).abs() < 1e-13,
            "{impulse}"
        );
        // The force of the constraint along z, from z' = yx': h z'' = h (x'y' − xy)/(1 + y²) up to O(h³), with factors of order 1.
        let v = (after - before) / (2.0 * SIZE);
        let force = (v[0] * v[1] - now[0] * now[1]) / (1.0 + now[1] * now[1]);
        assert!(
            (impulse[2] - SIZE * force).abs() < 2.0 * SIZE.powi(3),
            "{impulse} {force}"
        );
        largest = largest.max(impulse[2].abs());
        let slip = (now[1] + before[1]) / 2.0 * (now[0] - before[0]) - (now[2] - before[2]);
        assert!(slip.abs() < 1e-15, "{slip:e}");
    }
    // Ten times that.
    assert!(largest > 20.0 * SIZE.powi(3), "{largest:e}");
}

/// The rows of a holonomic constraint give RATTLE: the constraint of the pendulum is quadratic, so its mean over a step vanishes exactly.
#[test]
fn rows_of_a_holonomic_constraint_are_rattle() {
    let start: State<Vector2<f64>> = State::from_arrays(0.0, [0.6, -0.8], [0.8, 0.6]);
    let mut rows = Integrator::new(Trapezoid, PendulumByRows, start.clone(), 0.05).expect("a run");
    let mut rattle = Integrator::new(Rattle, Pendulum, start, 0.05).expect("a run");
    for step in 0..2000 {
        let (rows, rattle) = (rows.step().expect("a step"), rattle.step().expect("a step"));
        let State { q, p, .. } = rows;
        assert!(q.dot(p).abs() < 1e-15, "step {step}");
        assert!((q.norm() - 1.0).abs() < 1e-13, "step {step}");
        let apart = distance(q, &rattle.q).max(distance(p, &rattle.p));
        assert!(
            apart < 1e-12 * f64::from(step + 10),
            "step {step}: {apart:e}"
        );
    }
}

/// The mean energy over each quarter of a long run, less that at the start.
fn mean_energies<M: Method + ProvedFor<Nonholonomic<Separable>>>(method: M) -> [f64; 4] {
    const STEPS: u32 = 5000;
    let mut run = Integrator::new(method, Oscillator, oscillator_start(), 0.1).expect("a run");
    let before = run.energy().expect("an energy");
    [(); 4].map(|()| {
        let mut sum = 0.0;
        for _ in 0..STEPS {
            run.step().expect("a step");
            sum += run.energy().expect("an energy") - before;
        }
        sum / f64::from(STEPS)
    })
}

/// Symmetric steps keep the mean energy; the constraint at one end loses it or gains it.
#[test]
#[ignore = "thorough"]
fn the_mean_energy_of_symmetric_steps_stays() {
    for means in [mean_energies(Midpoint), mean_energies(Trapezoid)] {
        let drift = means
            .iter()
            .map(|mean| (mean - means[0]).abs())
            .fold(0.0, f64::max);
        assert!(drift < 1e-5 && means[0].abs() < 1e-3, "{means:?}");
    }
    for means in [mean_energies(AtStart), mean_energies(AtEnd)] {
        assert!((means[3] - means[0]).abs() > 0.05, "{means:?}");
    }
}

/// The projection changes the momentum along `wᵀ` only, and gives a velocity that obeys the constraints.
#[test]
fn a_consistent_momentum_is_the_nearest_one() {
    let pushed: State<SVector<f64, 4>> =
        State::from_arrays(0.0, [0.2, -0.4, 0.1, 0.3], [1.0, -2.0, 0.7, 0.4]);
    let State { q, p, .. } = consistent_momentum(&Disk, pushed.clone()).expect("regular");
    assert_eq!((q, p[3]), (pushed.q, pushed.p[3]));
    let rolls = p[2] / 0.3;
    assert!((p[0] - RADIUS * rolls * 0.3_f64.cos()).abs() < 1e-15);
    assert!((p[1] - RADIUS * rolls * 0.3_f64.sin()).abs() < 1e-15);
    // The impulse of the two rows: (λ, μ, −R(λ cos φ + μ sin φ), 0).
    let impulse = pushed.p - p;
    let expected = -RADIUS * (impulse[0] * 0.3_f64.cos() + impulse[1] * 0.3_f64.sin());
    assert!((impulse[2] - expected).abs() < 1e-15);
}

/// A run that is saved and restored has the bits of the run that goes on.
#[test]
fn a_restored_nonholonomic_run_has_the_same_bits() {
    let new = || Integrator::new(Midpoint4, Oscillator, oscillator_start(), 0.1).expect("a run");
    let (mut run, mut other) = (new(), new());
    run.take_steps(7).expect("steps");
    let saved = run.checkpoint().expect("saved");
    other.restore(&saved).expect("restored");
    assert_eq!(
        run.take_steps(20).expect("steps"),
        other.take_steps(20).expect("steps")
    );
}

/// Few sweeps a step: each leaves a part of the error that shrinks with the step.
#[test]
fn steps_cost_few_sweeps() {
    let mut run = Integrator::new(Midpoint, Oscillator, oscillator_start(), 0.01).expect("a run");
    run.integrate_to(10.0).expect("converges");
    let sweeps = run.statistics().mean_iterations();
    assert!((3.0..9.0).contains(&sweeps), "{sweeps}");
}
