//! The two Hamiltonian forms of discrete Dirac mechanics (Leok & Ohsawa, arXiv:0810.0740v1, 4.35 and 4.52), for steps with rows.

use symplectic::nalgebra::Vector3;
use symplectic::system::Conservative;
use symplectic::variational::{GeneratingFunction, generating_function};
use symplectic::{Error, Integrator, ProvedFor, State, System};

use crate::rolling::Midpoint;

symplectic::hamiltonian! {
    pub Free
    q: [x, y, z], p: [px, py, pz];
    H = (1 + x^2/4) (px^2 + py^2)/2 + pz^2/2 + cos(x) + y^4/4
}

symplectic::hamiltonian! {
    /// With z' = y x'.
    pub Bound
    q: [x, y, z], p: [px, py, pz], v: [vx, vy, vz];
    H = (1 + x^2/4) (px^2 + py^2)/2 + pz^2/2 + cos(x) + y^4/4
    nonholonomic: { slip = vz - y vx }
}

symplectic::hamiltonian! {
    /// Linear in a momentum: there is no Lagrangian.
    pub FreeDegenerate
    q: [x, y, z], p: [px, py, pz];
    H = x px + (py^2 + pz^2)/2 + y^4/4 + cos(x) y
}

symplectic::hamiltonian! {
    pub BoundDegenerate
    q: [x, y, z], p: [px, py, pz], v: [vx, vy, vz];
    H = x px + (py^2 + pz^2)/2 + y^4/4 + cos(x) y
    nonholonomic: { slip = vz - y vx }
}

symplectic::hamiltonian! {
    /// The velocity along the row depends on no momentum.
    pub NoMultiplier
    q: [x, y, z], p: [px, py, pz], v: [vx, vy, vz];
    H = x px + py^2/2 + z pz
    nonholonomic: { slip = vz - y vx }
}

type V3 = Vector3<f64>;

const SIZE: f64 = 0.1;

/// w(q)
fn row(q: &V3) -> V3 {
    V3::new(-q[1], 0.0, 1.0)
}

/// How far a covector is from the span of w(q)ᵀ.
fn off_the_span(q: &V3, covector: &V3) -> f64 {
    covector[1]
        .abs()
        .max((covector[0] + q[1] * covector[2]).abs())
}

fn generating<S>(free: &S, q0: &V3, p1: &V3) -> GeneratingFunction<V3>
where
    S: System<V3, Class: Conservative>,
    Midpoint: ProvedFor<S::Class>,
{
    generating_function(Midpoint, free, 0.0, q0, p1, SIZE).expect("an energy")
}

/// P = p1 + w(q1)ᵀμ with q1 = D2 H_d⁺(q0, P), by the secant method along the row.
fn momentum_before_the_impulse<S>(free: &S, q0: &V3, end: &State<V3>) -> V3
where
    S: System<V3, Class: Conservative>,
    Midpoint: ProvedFor<S::Class>,
{
    let row = row(&end.q);
    let defect = |mu: f64| (generating(free, q0, &(end.p + row * mu)).q1 - end.q).dot(&row);
    let (mut before, mut now) = ((0.0, defect(0.0)), (1e-3, defect(1e-3)));
    for _ in 0..12 {
        if now.1 == before.1 {
            break;
        }
        let next = now.0 - now.1 * (now.0 - before.0) / (now.1 - before.1);
        (before, now) = (now, (next, defect(next)));
    }
    end.p + row * now.0
}

/// The gradient of a function, by differences.
fn gradient(at: &V3, function: impl Fn(&V3) -> f64) -> V3 {
    const WAY: f64 = 1e-4;
    V3::from_fn(|k, _| {
        let moved = |by: f64| {
            let mut at = *at;
            at[k] += by;
            function(&at)
        };
        (moved(WAY) - moved(-WAY)) / (2.0 * WAY)
    })
}

/// H_d⁻(p0, q1) of Type III: the position q0 from which the step with the momentum p0 goes to q1, by fixed points.
fn type_three<S>(free: &S, p0: &V3, q1: &V3) -> f64
where
    S: System<V3, Class: Conservative> + Copy,
    Midpoint: ProvedFor<S::Class>,
{
    let (mut q0, mut p1) = (*q1, *p0);
    for _ in 0..40 {
        let start = State::new(0.0, q0, *p0);
        let mut run = Integrator::new(Midpoint, *free, start, SIZE).expect("a run");
        let end = run.step().expect("a step");
        q0 += q1 - end.q;
        p1 = end.p;
    }
    generating(free, &q0, &p1).type_three(&q0, &p1)
}

/// Checks the steps of a system with a row against the generating functions of the system without it.
fn check<S, B>(free: S, bound: B, start: State<V3>)
where
    S: System<V3, Class: Conservative> + Copy,
    B: System<V3> + Copy,
    Midpoint: ProvedFor<S::Class> + ProvedFor<B::Class>,
{
    let mut run = Integrator::new(Midpoint, bound, start, SIZE).expect("consistent");
    let mut largest = 0.0_f64;
    for step in 0..30 {
        let before = run.state().clone();
        let end = run.step().expect("a step").clone();
        let p = momentum_before_the_impulse(&free, &before.q, &end);
        let function = generating(&free, &before.q, &p);
        // (4.35)
        let distance = (function.q1 - end.q).amax();
        assert!(distance < 1e-13, "step {step}: {distance:e}");
        let impulse = before.p - function.p0;
        let off = off_the_span(&before.q, &impulse);
        assert!(off < 1e-13, "step {step}: {off:e}");
        largest = largest.max(impulse.amax());
        let slip = row(&((before.q + end.q) / 2.0)).dot(&(end.q - before.q));
        assert!(slip.abs() < 1e-14, "step {step}: {slip:e}");
        if step >= 3 {
            continue;
        }
        // The derivatives of H_d⁺ are what they are called.
        let by_position = gradient(&before.q, |q| generating(&free, q, &p).value);
        let by_momentum = gradient(&p, |p| generating(&free, &before.q, p).value);
        assert!((by_position - function.p0).amax() < 1e-8);
        assert!((by_momentum - end.q).amax() < 1e-8);
        // (4.52), with the momentum p̃ = p0 − w(q0)ᵀλ
        let momentum = function.p0;
        let by_momentum = gradient(&momentum, |p| type_three(&free, p, &end.q));
        let by_position = gradient(&end.q, |q| type_three(&free, &momentum, q));
        let distance = (before.q + by_momentum).amax();
        assert!(distance < 1e-8, "step {step}: {distance:e}");
        let off = off_the_span(&end.q, &(end.p + by_position));
        assert!(off < 1e-8, "step {step}: {off:e}");
    }
    // The constraint acts.
    assert!(largest > 1e-3, "{largest:e}");
}

#[test]
fn steps_with_a_row_are_both_forms() {
    // z' = y x' = 0.5 · 0.8 (1 + x²/4)
    let pz = 0.5 * 0.8 * (1.0 + 0.36 / 4.0);
    let start = State::from_arrays(0.0, [0.6, 0.5, -0.1], [0.8, 0.9, pz]);
    check(Free, Bound, start);
}

/// H_pp may be singular, if the velocity along the row depends on a momentum.
#[test]
fn a_degenerate_hamiltonian_with_a_row() {
    // z' = y x' = 0.5 · 0.6
    let start = State::from_arrays(0.0, [0.6, 0.5, -0.1], [0.8, 0.9, 0.3]);
    check(FreeDegenerate, BoundDegenerate, start);
    // Else there is no multiplier.
    let start = State::from_arrays(0.0, [0.6, 0.5, 0.3], [0.8, 0.9, 0.3]);
    let error = Integrator::new(Midpoint, NoMultiplier, start, SIZE).map(|_| ());
    let error = error.expect_err("no multiplier");
    assert!(
        matches!(error, Error::DependentConstraints { constraint: 0, .. }),
        "{error}"
    );
}
