//! Applied forces: orders, Newton's method, forces in formulas.

use crate::methods::{
    ForestRuth, Gauss2, Gauss3, Gauss4, Lobatto3, Lobatto4, Lobatto5, Midpoint, StoermerVerlet,
};
use symplectic::nalgebra::{DVector, SVector, Vector2, Vector3};
use symplectic::solver::ByNewton;
use symplectic::variational::{Error, StagesOfStep, StepWithStages, generating_function};
use symplectic::{Integrator, Method, ProvedFor, Scalar, State, System, hamiltonian};

symplectic::hamiltonian! {
    /// The ring of Marsden & West (2001), Figure 2, with friction.
    pub Ring { gamma: 1e-3 }
    q: [x, y], p: [px, py];
    let r = x^2 + y^2;
    H = (px^2 + py^2)/2 + r (r - 1)^2
    force: { x = -gamma px, y = -gamma py }
}

symplectic::hamiltonian! {
    /// An oscillator of frequency 1 that is driven.
    pub Driven { f: 1, omega: 0.5 }
    q: [x], p: [px];
    H = (px^2 + x^2)/2
    force: { x = f cos(omega t) }
}

pub fn ring_start() -> State<Vector2<f64>> {
    State::from_arrays(0.0, [1.25, 0.0], [0.0, 0.5])
}

fn distance<const N: usize>(a: &State<SVector<f64, N>>, b: &State<SVector<f64, N>>) -> f64 {
    (a.q - b.q).norm() + (a.p - b.p).norm()
}

/// How the error of steps of a method falls from one number of steps to twice as many.
pub fn slope<M, S, const N: usize>(
    method: M,
    system: impl Fn() -> S,
    start: &State<SVector<f64, N>>,
    end: &State<SVector<f64, N>>,
    steps: u32,
) -> f64
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<SVector<f64, N>>,
{
    let errors = [steps, 2 * steps].map(|steps| {
        let size = (end.time - start.time) / f64::from(steps);
        let mut run = Integrator::new(method, system(), start.clone(), size).expect("a run");
        distance(run.integrate_to(end.time).expect("steps"), end)
    });
    (errors[0] / errors[1]).log2()
}

/// The order is that for general Hamiltonians, and not one higher.
#[test]
fn methods_have_their_general_order_with_a_force_of_momenta() {
    let ring = || Ring { gamma: 0.25 };
    let mut run = Integrator::new(Gauss4, ring(), ring_start(), 1.0 / 256.0).expect("a run");
    let end = run.integrate_to(2.0).expect("steps").clone();
    let start = ring_start();
    for (found, order) in [
        (slope(Midpoint, ring, &start, &end, 128), 2.0),
        (slope(Gauss2, ring, &start, &end, 48), 4.0),
        (slope(Gauss3, ring, &start, &end, 64), 6.0),
        (slope(Gauss4, ring, &start, &end, 48), 8.0),
        (slope(StoermerVerlet, ring, &start, &end, 64), 2.0),
        (slope(Lobatto3, ring, &start, &end, 64), 4.0),
        (slope(Lobatto4, ring, &start, &end, 64), 6.0),
        (slope(Lobatto5, ring, &start, &end, 48), 8.0),
    ] {
        assert!((found - order).abs() < 0.05, "{found} instead of {order}");
    }
}

/// A force of the time leaves the system separable, and splittings explicit: against the closed form.
#[test]
fn methods_have_their_order_with_a_force_of_time() {
    let exact = |time: f64| {
        // x = F/(1 − ω²) (cos ωt − cos t)
        let (omega, factor) = (0.5, 1.0 / 0.75);
        let x = factor * ((omega * time).cos() - time.cos());
        let p = factor * (time.sin() - omega * (omega * time).sin());
        State::from_arrays(time, [x], [p])
    };
    let driven = Driven::new;
    for (found, order) in [
        (
            slope(StoermerVerlet, driven, &exact(0.0), &exact(5.0), 100),
            2.0,
        ),
        (
            slope(ForestRuth, driven, &exact(0.0), &exact(5.0), 100),
            4.0,
        ),
        (slope(Gauss3, driven, &exact(0.0), &exact(5.0), 20), 6.0),
    ] {
        assert!((found - order).abs() < 0.05, "{found} instead of {order}");
    }
}

/// `H_d⁺(q0, p1) = p1·q1 − L_d(q0, q1)`
#[test]
fn the_action_is_that_of_the_generating_function() -> Result<(), Error> {
    let pendulum = hamiltonian::<SVector<f64, 1>, _, _>(
        |_, _, p, velocity| *velocity = *p,
        |_, q, _, force| force[0] = -q[0].sin(),
    )
    .with_energy(|_, q, p| p[0] * p[0] / 2.0 - q[0].cos());
    let start = State::from_arrays(0.0, [0.4], [0.9]);
    let mut run = Integrator::new(Gauss3, pendulum, start.clone(), 0.25)?;
    let stages: StagesOfStep<_> = run.step_with_stages()?;
    let end = run.state().clone();
    let generating = generating_function(Gauss3, &pendulum, 0.0, &start.q, &end.p, 0.25)?;
    let legendre = end.p.dot(&end.q) - generating.value;
    assert!((stages.action(&pendulum)? - legendre).abs() < 1e-15);
    assert!(legendre.abs() > 0.1);
    Ok(())
}

symplectic::hamiltonian! {
    /// A spherical pendulum of length 1 in a resisting medium.
    pub Resisted { gamma: 0.3, g: 1 }
    q: [x, y, z], p: [px, py, pz];
    H = (px^2 + py^2 + pz^2)/2 + g z
    constraints: { rod = x^2 + y^2 + z^2 - 1 }
    force: { x = -gamma px, y = -gamma py, z = -gamma pz }
}

symplectic::composition! {
    pub FourthRattle { base: lobatto-2, weights: triple_jump(4) }
}

pub fn swing() -> State<Vector3<f64>> {
    State::from_arrays(0.0, [0.6, 0.0, -0.8], [0.4, 0.7, 0.3])
}

/// With constraints the balance of momentum is exact too.
#[test]
fn the_momentum_balance_is_exact_with_constraints() {
    fn check<M: Method + ProvedFor<symplectic::constraints::Constrained<symplectic::General>>>(
        method: M,
    ) {
        let mut run = Integrator::new(method, Resisted::new(), swing(), 0.1).expect("a run");
        let vertical =
            |state: &State<Vector3<f64>>| state.q[0] * state.p[1] - state.q[1] * state.p[0];
        for _ in 0..20 {
            let before = vertical(run.state());
            let stages = run.step_with_stages().expect("a step");
            let change = vertical(run.state()) - before;
            let impulse = stages.impulse(|q, out| *out = Vector3::new(-q[1], q[0], 0.0));
            assert!((change - impulse).abs() < 2e-15, "{change:e} {impulse:e}");
            assert!(change.abs() > 1e-5, "{change:e}");
        }
    }
    check(StoermerVerlet);
    check(Lobatto3);
    check(FourthRattle);
}

symplectic::hamiltonian! {
    /// A skate with drag.
    pub Skate { c: 0.3 }
    q: [x, y, a], p: [px, py, pa], v: [vx, vy, va];
    H = (px^2 + py^2 + pa^2)/2
    nonholonomic: { edge = vx sin(a) - vy cos(a) }
    force: { x = -c px, y = -c py }
}

symplectic::composition! {
    pub FourthMidpoint { base: gauss-1, weights: suzuki(4) }
}

/// It turns at a constant rate ω and slows down: x + iy = u (e^{(iω − c)t} − 1)/(iω − c).
#[test]
fn methods_have_their_order_with_forces_and_nonholonomic_rows() {
    let exact = |time: f64| {
        let (u, omega, c) = (1.5_f64, 2.0, 0.3);
        let (sin, cos) = (omega * time).sin_cos();
        let decay = (-c * time).exp();
        let (re, im) = (u * (decay * cos - 1.0), u * decay * sin);
        let square = c * c + omega * omega;
        let (x, y) = (
            (-c * re + omega * im) / square,
            (-c * im - omega * re) / square,
        );
        State::from_arrays(
            time,
            [x, y, omega * time],
            [u * decay * cos, u * decay * sin, omega],
        )
    };
    for (found, order) in [
        (
            slope(Midpoint, Skate::new, &exact(0.0), &exact(2.0), 50),
            2.0,
        ),
        (
            slope(StoermerVerlet, Skate::new, &exact(0.0), &exact(2.0), 50),
            2.0,
        ),
        (
            slope(FourthMidpoint, Skate::new, &exact(0.0), &exact(2.0), 50),
            4.0,
        ),
    ] {
        assert!((found - order).abs() < 0.05, "{found} instead of {order}");
    }
    // The constraint does no work, so the balance of the energy is that of the drag: of order 3 in a step.
    let defect = |size: f64| -> f64 {
        let mut run = Integrator::new(Midpoint, Skate::new(), exact(0.5), size).expect("a run");
        let before = run.energy().expect("known");
        let work = run.step_with_stages().expect("a step").work();
        assert!(work < -0.1 * size);
        run.energy().expect("known") - before - work
    };
    let found = (defect(0.02) / defect(0.01)).log2();
    assert!((found - 3.0).abs() < 0.1, "{found}");
}

symplectic::lagrangian! {
    /// A particle in the plane with drag, in polar coordinates.
    pub Polar { c: 0.2 }
    q: [r, a], v: [vr, va];
    let speed2 = vr^2 + (r va)^2;
    L = (vr^2 + r^2 va^2)/2 + 1/r
    // Drag −c |v|² v, as the covector of r and a.
    force: { r = -c speed2 vr, a = -c speed2 r^2 va }
}

symplectic::hamiltonian! {
    /// The same in Cartesian coordinates.
    pub Cartesian { c: 0.2 }
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 - 1/|[x, y]|
    force: { x = -c (px^2 + py^2) px, y = -c (px^2 + py^2) py }
}

#[test]
fn a_force_of_velocities_is_one_of_momenta() -> Result<(), Error> {
    let polar = Polar::new();
    let (q, v) = ([1.2, 0.3].into(), [0.1, 0.7].into());
    let p = polar.momentum_of_velocity(0.0, &q, &v);
    let start: State<Vector2<f64>> = State::new(0.0, q, p);
    let end = Integrator::new(Gauss4, polar, start, 1.0 / 64.0)?
        .integrate_to(3.0)?
        .clone();
    let place = |r: f64, a: f64| Vector2::new(r * a.cos(), r * a.sin());
    let (sin, cos) = 0.3_f64.sin_cos();
    let p = Vector2::new(0.1 * cos - 0.84 * sin, 0.1 * sin + 0.84 * cos);
    let start = State::new(0.0, place(1.2, 0.3), p);
    let other = Integrator::new(Gauss4, Cartesian::new(), start, 1.0 / 64.0)?
        .integrate_to(3.0)?
        .clone();
    assert!((place(end.q[0], end.q[1]) - other.q).norm() < 1e-11);
    Ok(())
}

symplectic::hamiltonian! {
    /// Beads in the plane: dampers between pairs of them, drag on each, a push on the first.
    pub Beads { dampers: pairs, c: 0.3, drag: 0.1 }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/2 + |q[i]|^2/2)
    force: {
        q[i] = -drag |p[i]|^2 p[i],
        q[i](s = (i, j) in dampers) = -c (p[i] - p[j]),
        q[j](s = (i, j) in dampers) = c (p[i] - p[j]),
        q[0] = [cos(t), 0],
    }
}

#[test]
#[ignore = "thorough"]
fn forces_between_listed_pairs_are_those_by_hand() -> Result<(), Error> {
    let pairs = [(0, 1), (1, 2), (3, 0)];
    let beads = Beads::new(pairs.to_vec());
    let q = DVector::from_fn(8, |k, _| (0.3 * k as f64).sin());
    let p = DVector::from_fn(8, |k, _| 1.0 - 0.2 * k as f64);
    let (mut force, mut applied) = (q.clone(), q.clone());
    System::<DVector<f64>>::force(&beads, 0.7, &q, &p, &mut force);
    System::<DVector<f64>>::applied_force(&beads, 0.7, &q, &p, &mut applied);
    let mut expected = DVector::zeros(8);
    for i in 0..4 {
        let square = p[2 * i] * p[2 * i] + p[2 * i + 1] * p[2 * i + 1];
        for k in 0..2 {
            expected[2 * i + k] -= 0.1 * square * p[2 * i + k];
        }
    }
    for (i, j) in pairs {
        for k in 0..2 {
            let relative = 0.3 * (p[2 * i + k] - p[2 * j + k]);
            expected[2 * i + k] -= relative;
            expected[2 * j + k] += relative;
        }
    }
    expected[0] += 0.7_f64.cos();
    assert!((&applied - &expected).norm() < 1e-15);
    assert!((&force + &q - &expected).norm() < 1e-14);
    // Pushed and damped, all of them come to a motion with the period of the push.
    let start = State::new(0.0, q, p);
    let mut run = Integrator::new(Gauss3, beads, start, 0.1)?;
    let one = run.integrate_to(400.0)?.clone();
    let next = run.integrate_to(400.0 + core::f64::consts::TAU)?;
    assert!(
        (&one.q - &next.q).norm() < 1e-3,
        "{}",
        (&one.q - &next.q).norm()
    );
    Ok(())
}

symplectic::hamiltonian! {
    /// Friction that is far too stiff for a fixed-point iteration.
    pub Stiff { gamma: 1e6 }
    q: [x], p: [px];
    H = (px^2 + x^2)/2
    force: { x = -gamma px }
}

/// Newton's matrix contains the derivative of the force by the momentum.
#[test]
fn newton_steps_a_stiff_force_of_momenta() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [1.0], [-1e-6]);
    let mut run = Integrator::new(Gauss3, Stiff::new(), start, 0.1)?.by_newton();
    run.integrate_to(10.0)?;
    // x' = −x/γ on the slow manifold.
    assert!((run.state().q[0] - (-10.0 / 1e6_f64).exp()).abs() < 1e-9);
    assert!(run.statistics().mean_iterations() < 6.0);
    let mut run = Integrator::new(Gauss3, Differenced, run.into_state(), 0.1)?.by_newton();
    run.integrate_to(20.0)?;
    assert!((run.state().q[0] - (-20.0 / 1e6_f64).exp()).abs() < 1e-9);
    assert!(run.statistics().mean_iterations() < 8.0);
    Ok(())
}

/// The same without second derivatives: differences.
struct Differenced;

impl symplectic::Hamiltonian for Differenced {
    type Class = symplectic::General;
    type Vector<T: Scalar> = SVector<T, 1>;
    const FORCED: bool = true;

    fn velocity<T: Scalar>(
        &self,
        _: T,
        _: &SVector<T, 1>,
        p: &SVector<T, 1>,
        velocity: &mut SVector<T, 1>,
    ) {
        *velocity = *p;
    }

    fn force<T: Scalar>(
        &self,
        time: T,
        q: &SVector<T, 1>,
        p: &SVector<T, 1>,
        force: &mut SVector<T, 1>,
    ) {
        symplectic::Hamiltonian::applied_force(self, time, q, p, force);
        *force -= q;
    }

    fn applied_force<T: Scalar>(
        &self,
        _: T,
        _: &SVector<T, 1>,
        p: &SVector<T, 1>,
        applied: &mut SVector<T, 1>,
    ) {
        *applied = p * T::from_f64(-1e6);
    }
}
