//! The two Hamiltonian forms of discrete Dirac mechanics (Leok & Ohsawa, arXiv:0810.0740v1, 4.35 and 4.52), for steps with rows.

use symplectic::nalgebra::{SMatrix, SVector};
use symplectic::system::Conservative;
use symplectic::variational::{
    GeneratingFunction, GeneratingFunctions, StagesOfStep, StepWithStages, generating_function,
};
use symplectic::{Error, Integrator, Method, ProvedFor, State, System};

use crate::rolling::{Disk, Midpoint, RADIUS, Trapezoid, disk_start};

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

symplectic::hamiltonian! {
    /// The disk without its rows.
    pub FreeDisk
    q: [x, y, a, b], p: [px, py, pa, pb];
    H = (px^2 + py^2)/2 + pa^2/0.6 + pb^2/0.4
}

type Point<const N: usize> = SVector<f64, N>;

/// w(q)
type Rows<const R: usize, const N: usize> = fn(&Point<N>) -> SMatrix<f64, R, N>;

const SIZE: f64 = 0.1;

fn row(q: &Point<3>) -> SMatrix<f64, 1, 3> {
    SMatrix::from([[-q[1]], [0.0], [1.0]])
}

fn rows_of_the_disk(q: &Point<4>) -> SMatrix<f64, 2, 4> {
    let (sin, cos) = q[3].sin_cos();
    SMatrix::from([
        [1.0, 0.0],
        [0.0, 1.0],
        [-RADIUS * cos, -RADIUS * sin],
        [0.0, 0.0],
    ])
}

/// How far a covector is from the span of wᵀ.
fn off_the_span<const R: usize, const N: usize>(
    w: &SMatrix<f64, R, N>,
    covector: &Point<N>,
) -> f64 {
    let inverse = (w * w.transpose()).try_inverse().expect("independent rows");
    (covector - w.transpose() * inverse * w * covector).amax()
}

fn generating<M, S, const N: usize>(
    method: M,
    free: &S,
    q0: &Point<N>,
    p1: &Point<N>,
) -> GeneratingFunction<Point<N>>
where
    M: Method + ProvedFor<S::Class>,
    S: System<Point<N>, Class: Conservative>,
{
    generating_function(method, free, 0.0, q0, p1, SIZE).expect("an energy")
}

/// The momentum P at the end of a step before the impulse of the constraint, `P_1 + h Σ_j (b̃_j − ã_1j) force_j`.
fn momentum_before_the_impulse<M: Method, const N: usize>(
    stages: &StagesOfStep<Point<N>>,
) -> Point<N> {
    let stages = stages.stages();
    let row = M::COEFFICIENTS.a_tilde[0];
    let forces = stages.iter().zip(row);
    forces.fold(stages[0].p, |sum, (stage, a)| {
        sum + stage.force * (stage.force_weight - SIZE * a.double())
    })
}

/// The gradient of a function, by differences.
fn gradient<const N: usize>(at: &Point<N>, function: impl Fn(&Point<N>) -> f64) -> Point<N> {
    const WAY: f64 = 1e-4;
    Point::<N>::from_fn(|k, _| {
        let moved = |by: f64| {
            let mut at = *at;
            at[k] += by;
            function(&at)
        };
        (moved(WAY) - moved(-WAY)) / (2.0 * WAY)
    })
}

/// Checks the steps of a system with rows against the generating functions of the system without them.
fn check<M, S, B, const R: usize, const N: usize>(
    method: M,
    free: S,
    (bound, rows): (B, Rows<R, N>),
    start: State<Point<N>>,
) where
    M: Method + Copy + ProvedFor<S::Class> + ProvedFor<B::Class>,
    S: System<Point<N>, Class: Conservative> + Copy,
    B: System<Point<N>> + Copy,
{
    let mut run = Integrator::new(method, bound, start, SIZE).expect("consistent");
    let mut largest = 0.0_f64;
    for step in 0..30 {
        let before = run.state().clone();
        let stages = run.step_with_stages().expect("a step");
        let end = run.state().clone();
        let [first, last] = [&before.q, &end.q].map(rows);
        let p = momentum_before_the_impulse::<M, N>(&stages);
        let function = generating(method, &free, &before.q, &p);
        // (4.35)
        let distance = (function.q1 - end.q).amax();
        assert!(distance < 1e-13, "step {step}: {distance:e}");
        let impulse = before.p - function.p0;
        let off = off_the_span(&first, &impulse);
        assert!(off < 1e-13, "step {step}: {off:e}");
        largest = largest.max(impulse.amax());
        // Σ b_i w(Q_i)·(q1 − q0), with the stages Q_i on the line from q0 to q1
        let way = end.q - before.q;
        let nodes = M::COEFFICIENTS.c.iter().zip(M::COEFFICIENTS.b);
        let slips = nodes.map(|(c, b)| rows(&(before.q + way * c.double())) * way * b.double());
        let slip = slips.sum::<SVector<f64, R>>().amax();
        assert!(slip < 1e-14, "step {step}: {slip:e}");
        if step >= 3 {
            continue;
        }
        // The derivatives of H_d⁺ are what they are called.
        let by_position = gradient(&before.q, |q| generating(method, &free, q, &p).value);
        let by_momentum = gradient(&p, |p| generating(method, &free, &before.q, p).value);
        assert!((by_position - function.p0).amax() < 1e-8);
        assert!((by_momentum - end.q).amax() < 1e-8);
        // (4.52), with the momentum p̃ = p0 − w(q0)ᵀλ
        let momentum = function.p0;
        let free = Integrator::new(method, free, State::new(0.0, before.q, momentum), SIZE);
        let free = free.expect("a run");
        let type_three = |p: &_, q: &_| free.type_three(p, q).expect("a step").value;
        let by_momentum = gradient(&momentum, |p| type_three(p, &end.q));
        let by_position = gradient(&end.q, |q| type_three(&momentum, q));
        let distance = (before.q + by_momentum).amax();
        assert!(distance < 1e-8, "step {step}: {distance:e}");
        let off = off_the_span(&last, &(end.p + by_position));
        assert!(off < 1e-8, "step {step}: {off:e}");
    }
    // The constraint acts.
    assert!(largest > 1e-3, "{largest:e}");
}

#[test]
fn a_dirac_step_satisfies_both_hamiltonian_forms() {
    // z' = y x' = 0.5 · 0.8 (1 + x²/4)
    let pz = 0.5 * 0.8 * (1.0 + 0.36 / 4.0);
    let start = State::from_arrays(0.0, [0.6, 0.5, -0.1], [0.8, 0.9, pz]);
    check(Midpoint, Free, (Bound, row), start.clone());
    check(Trapezoid, Free, (Bound, row), start);
}

#[test]
fn a_dirac_step_with_two_rows_satisfies_both_hamiltonian_forms() {
    check(Midpoint, FreeDisk, (Disk, rows_of_the_disk), disk_start());
    check(Trapezoid, FreeDisk, (Disk, rows_of_the_disk), disk_start());
}

/// H_pp may be singular, if the velocity along the row depends on a momentum.
#[test]
fn a_row_can_determine_the_velocity_of_a_degenerate_hamiltonian() {
    // z' = y x' = 0.5 · 0.6
    let start = State::from_arrays(0.0, [0.6, 0.5, -0.1], [0.8, 0.9, 0.3]);
    check(Midpoint, FreeDegenerate, (BoundDegenerate, row), start);
    // Else there is no multiplier.
    let start = State::from_arrays(0.0, [0.6, 0.5, 0.3], [0.8, 0.9, 0.3]);
    let error = Integrator::new(Midpoint, NoMultiplier, start, SIZE).map(|_| ());
    let error = error.expect_err("no multiplier");
    assert!(
        matches!(error, Error::DependentConstraints { constraint: 0, .. }),
        "{error}"
    );
}
