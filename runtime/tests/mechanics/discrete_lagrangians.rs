//! Discrete Lagrangians that are given, against Runge–Kutta steps of the same systems.

use crate::methods::{Gauss6, Lobatto3, Midpoint, StoermerVerlet};
use symplectic::nalgebra::{DVector, SVector, Vector2};
use symplectic::variational::{
    DiscreteLagrangian, DiscretePath, Error, VariationalIntegrator, VariationalSteps,
};
use symplectic::{
    Error as CoreError, Integrator, Method, ProvedFor, Quantity, Scalar, State, System, Vector,
    hamiltonian, separable,
};

symplectic::composition! {
    Suzuki4 { base: stormer-verlet, weights: suzuki(4), require: [order == 4] }
    pub Jump6 { base: lobatto-2, weights: triple_jump(6), require: [order == 6] }
}

symplectic::lagrangian! {
    /// The double pendulum by its angles from below.
    pub DoublePendulum
    q: [a, b], v: [va, vb];
    L = va^2 + vb^2/2 + va vb cos(a - b) + 2 cos(a) + cos(b)
}

symplectic::hamiltonian! {
    /// A pendulum with its action: `s' = L` as long as `ps = 0`.
    pub PendulumWithAction
    q: [x, s], p: [px, ps];
    H = px^2/2 - cos(x) + ps (px^2/2 + cos(x))
}

symplectic::hamiltonian! {
    /// A pendulum in gravity that is shaken.
    pub Shaken
    q: [x], p: [px];
    H = px^2/2 - (1 + sin(3 t)/2) cos(x)
}

symplectic::hamiltonian! {
    /// Kepler's problem in the plane.
    pub Kepler
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)
}

type V1<T> = SVector<T, 1>;
type V2<T> = SVector<T, 2>;

/// Ld^α = h L((1 − α)q0 + αq1, (q1 − q0)/h) of the double pendulum (Marsden & West, 1.3.1).
#[derive(Clone, Copy)]
pub struct AtOnePoint(pub f64);

impl DiscreteLagrangian for AtOnePoint {
    type Vector<T: Scalar> = V2<T>;

    fn value<T: Scalar>(&self, _: T, h: T, q0: &V2<T>, q1: &V2<T>) -> T {
        let [before, after] = [1.0 - self.0, self.0].map(T::from_f64);
        let (q, v) = (q0 * before + q1 * after, (q1 - q0) * h.recip());
        let half = T::from_f64(0.5);
        let kinetic = v[0] * v[0] + v[1] * v[1] * half + v[0] * v[1] * (q[0] - q[1]).cos();
        h * (kinetic + q[0].cos() + q[0].cos() + q[1].cos())
    }
}

/// (Ld^α + Ld^{1−α})/2.
#[derive(Clone, Copy)]
pub struct AtTwoPoints(pub f64);

impl DiscreteLagrangian for AtTwoPoints {
    type Vector<T: Scalar> = V2<T>;

    fn value<T: Scalar>(&self, time: T, h: T, q0: &V2<T>, q1: &V2<T>) -> T {
        let [one, other] = [self.0, 1.0 - self.0].map(AtOnePoint);
        (one.value(time, h, q0, q1) + other.value(time, h, q0, q1)) * T::from_f64(0.5)
    }
}

fn double_start() -> State<Vector2<f64>> {
    State::from_arrays(0.0, [1.0, -0.4], [0.5, 0.2])
}

/// L = |v|²/2 + 1/|q| by the trapezoidal rule.
#[derive(Clone, Copy)]
pub struct Trapezoid;

impl DiscreteLagrangian for Trapezoid {
    type Vector<T: Scalar> = V2<T>;

    fn value<T: Scalar>(&self, _: T, h: T, q0: &V2<T>, q1: &V2<T>) -> T {
        let (half, way) = (T::from_f64(0.5), q1 - q0);
        let attraction = |q: &V2<T>| q.dot(q).sqrt().recip();
        half * way.dot(&way) / h + h * half * (attraction(q0) + attraction(q1))
    }
}

pub fn perihelion() -> State<Vector2<f64>> {
    State::from_arrays(0.0, [0.4, 0.0], [0.0, 2.0])
}

/// The shaken pendulum at the middle of the step, over vectors on the heap.
#[derive(Clone, Copy)]
pub struct ShakenLagrangian;

impl DiscreteLagrangian for ShakenLagrangian {
    type Vector<T: Scalar> = DVector<T>;

    fn value<T: Scalar>(&self, time: T, h: T, q0: &DVector<T>, q1: &DVector<T>) -> T {
        let half = T::from_f64(0.5);
        let (q, v) = ((q0[0] + q1[0]) * half, (q1[0] - q0[0]) / h);
        let gravity = T::one() + (T::from_f64(3.0) * (time + h * half)).sin() * half;
        h * (v * v * half + gravity * q.cos())
    }
}

fn distance<V: Vector<Scalar = f64>, W: Vector<Scalar = f64>>(a: &State<V>, b: &State<W>) -> f64 {
    let largest = |a: &[f64], b: &[f64]| {
        let pairs = a.iter().zip(b);
        pairs.fold(0.0_f64, |largest, (a, b)| largest.max((a - b).abs()))
    };
    let ((q, p), (r, s)) = (a.as_slices(), b.as_slices());
    largest(q, r).max(largest(p, s))
}

/// A hundred steps of both, and how far they are from each other.
fn difference<M, S, L>(method: M, system: S, lagrangian: L, start: State<L::Vector<f64>>) -> f64
where
    L: DiscreteLagrangian,
    S: System<L::Vector<f64>>,
    M: Method + ProvedFor<S::Class>,
{
    let mut one = Integrator::new(method, system, start.clone(), 0.05).expect("a run");
    let mut other = VariationalSteps::run(lagrangian, start, 0.05).expect("a run");
    (0..100).fold(0.0_f64, |largest, _| {
        let other = other.step().expect("a step");
        largest.max(distance(one.step().expect("a step"), other))
    })
}

/// At the middle: Gauss with one stage, also where the kinetic energy depends on the place. With trapezoids: Störmer–Verlet.
#[test]
fn midpoint_and_trapezoid_lagrangians_are_gauss_1_and_verlet() {
    let middle = difference(Midpoint, DoublePendulum, AtOnePoint(0.5), double_start());
    assert!(middle < 1e-12, "{middle:e}");
    let ends = difference(StoermerVerlet, Kepler, Trapezoid, perihelion());
    assert!(ends < 1e-12, "{ends:e}");
    let other = difference(Midpoint, DoublePendulum, AtOnePoint(0.49), double_start());
    assert!(other > 1e-4, "{other:e}");
}

/// Checks the order, from the error at t = 1 with a number of steps and with twice as many.
fn assert_order<L, V>(
    order: f64,
    reference: &State<V>,
    start: &State<L::Vector<f64>>,
    steps: u32,
    run: impl Fn(State<L::Vector<f64>>, f64) -> Result<VariationalIntegrator<L>, Error>,
) where
    L: DiscreteLagrangian,
    V: Vector<Scalar = f64>,
{
    let [coarse, fine] = [steps, 2 * steps].map(|steps| {
        let mut run = run(start.clone(), 1.0 / f64::from(steps)).expect("a run");
        distance(run.integrate_to(1.0).expect("steps"), reference)
    });
    let slope = (coarse / fine).log2();
    assert!(
        (slope - order).abs() < 0.05,
        "slope {slope} instead of {order}: {coarse:e} {fine:e}"
    );
}

#[test]
fn discrete_lagrangians_have_their_orders() {
    let start = double_start();
    let mut run = Integrator::new(Gauss6, DoublePendulum, start.clone(), 0.02).expect("a run");
    let reference = &run.integrate_to(1.0).expect("steps").clone();
    for (order, alpha) in [(2.0, 0.5), (1.0, 0.3), (1.0, 0.0), (1.0, 1.0)] {
        assert_order(order, reference, &start, 400, |state, size| {
            VariationalSteps::run(AtOnePoint(alpha), state, size)
        });
    }
    assert_order(2.0, reference, &start, 50, |state, size| {
        VariationalSteps::run(AtTwoPoints(0.3), state, size)
    });
    assert_order(4.0, reference, &start, 40, |state, size| {
        VariationalSteps::composed(Suzuki4, AtOnePoint(0.5), state, size)
    });
    assert_order(6.0, reference, &start, 40, |state, size| {
        VariationalSteps::composed(Jump6, AtTwoPoints(0.1), state, size)
    });
    // Not self-adjoint: the composition would have order 1, for Σγ² is not 0.
    let refused = VariationalSteps::composed(Suzuki4, AtOnePoint(0.3), start, 0.1);
    let refused = refused.err();
    assert!(
        matches!(refused, Some(Error::NotSelfAdjoint { defect }) if defect > 1e-3),
        "{refused:?}"
    );
}

/// Steps of a composition at their times, and vectors on the heap.
#[test]
fn time_dependent_discrete_lagrangians_keep_their_order() {
    let start = State::from_arrays(0.0, [1.0], [0.3]);
    let mut run = Integrator::new(Gauss6, Shaken, start, 0.02).expect("a run");
    let reference = &run.integrate_to(1.0).expect("steps").clone();
    let start = State::from_slices(0.0, &[1.0], &[0.3]).expect("equal lengths");
    assert_order(2.0, reference, &start, 80, |state, size| {
        VariationalSteps::run(ShakenLagrangian, state, size)
    });
    assert_order(4.0, reference, &start, 40, |state, size| {
        VariationalSteps::composed(Suzuki4, ShakenLagrangian, state, size)
    });
}

/// The pendulum by Ld^α.
pub struct Pendulum(pub f64);

impl DiscreteLagrangian for Pendulum {
    type Vector<T: Scalar> = V1<T>;

    fn value<T: Scalar>(&self, _: T, h: T, q0: &V1<T>, q1: &V1<T>) -> T {
        let [before, after] = [1.0 - self.0, self.0].map(T::from_f64);
        let (q, v) = (q0[0] * before + q1[0] * after, (q1[0] - q0[0]) / h);
        h * (v * v * T::from_f64(0.5) + q.cos())
    }
}

/// The pendulum by the parabola through q0, q, q1 and Simpson's rule, with the q in the middle for which that action is extremal.
#[derive(Clone, Copy)]
pub struct Simpson;

impl DiscreteLagrangian for Simpson {
    type Vector<T: Scalar> = V1<T>;

    fn value<T: Scalar>(&self, _: T, h: T, q0: &V1<T>, q1: &V1<T>) -> T {
        let number = T::from_f64;
        let (q0, q1) = (q0[0], q1[0]);
        // The action is extremal where q = (q0 + q1)/2 + (h²/8) sin q; the derivatives converge as q does.
        let middle = (q0 + q1) * number(0.5);
        let q = (0..30).fold(middle, |q, _| middle + h * h * number(0.125) * q.sin());
        let three = number(3.0);
        let velocities = [
            (q * number(4.0) - q0 * three - q1) / h,
            (q1 - q0) / h,
            (q1 * three - q * number(4.0) + q0) / h,
        ];
        let lagrangian = |v: T, q: T| v * v * number(0.5) + q.cos();
        let [start, middle, end] = velocities;
        let sum = lagrangian(start, q0) + lagrangian(end, q1) + number(4.0) * lagrangian(middle, q);
        h * sum / number(6.0)
    }
}

/// Ld = h (v²/2a + b cos q1) is the step q1 = q0 + ahp0, p1 = p0 − bh sin q1 of explicit partitioned methods (Marsden & West, 2.6.4, which
/// prints b for 1/a and 1/a for b).
#[test]
fn a_drift_kick_lagrangian_steps_by_its_closed_form() -> Result<(), Error> {
    struct DriftAndKick(f64, f64);
    impl DiscreteLagrangian for DriftAndKick {
        type Vector<T: Scalar> = V1<T>;

        fn value<T: Scalar>(&self, _: T, h: T, q0: &V1<T>, q1: &V1<T>) -> T {
            let (v, Self(a, b)) = ((q1[0] - q0[0]) / h, self);
            h * (v * v * T::from_f64(0.5 / a) + q1[0].cos() * T::from_f64(*b))
        }
    }
    let start = State::from_arrays(0.0, [1.0], [0.4]);
    let mut run = VariationalSteps::run(DriftAndKick(0.7, 0.4), start, 0.25)?;
    let end = run.step()?;
    let q = 1.0 + 0.7 * 0.25 * 0.4;
    assert!((end.q[0] - q).abs() < 1e-15);
    assert!((end.p[0] - (0.4 - 0.4 * 0.25 * q.sin())).abs() < 1e-15);
    Ok(())
}

/// A Galerkin method whose inner point is found in the code of Ld: Lobatto IIIA–IIIB with three stages, of order 4.
#[test]
fn a_discrete_lagrangian_with_an_inner_point_is_lobatto_3() {
    let start = State::from_arrays(0.0, [1.0], [0.4]);
    let pendulum = || {
        separable::<V1<f64>, _, _>(
            |_, p, velocity| *velocity = *p,
            |_, q, force| force[0] = -q[0].sin(),
        )
    };
    let found = difference(Lobatto3, pendulum(), Simpson, start.clone());
    assert!(found < 1e-12, "{found:e}");
    let mut run = Integrator::new(Gauss6, pendulum(), start.clone(), 0.02).expect("a run");
    let reference = &run.integrate_to(1.0).expect("steps").clone();
    assert_order(4.0, reference, &start, 10, |state, size| {
        VariationalSteps::run(Simpson, state, size)
    });
}

/// Along an orbit Ld is the action up to h^{r+1}, and −D1 Ld and D2 Ld are its momenta up to h^r, r the order of the map (Theorem 2.3.1).
#[test]
fn the_order_of_a_discrete_lagrangian_is_that_of_its_steps() {
    let exact = |size: f64| {
        let start = State::from_arrays(0.0, [1.0, 0.0], [0.4, 0.0]);
        let mut run = Integrator::new(Gauss6, PendulumWithAction, start, size).expect("a run");
        let (q, p) = run.step().expect("a step").to_arrays();
        (q[0], p[0], q[1])
    };
    for (alpha, order) in [(0.5, 2.0), (0.3, 1.0), (1.0, 1.0)] {
        let errors = [0.04, 0.02].map(|step_size| {
            let (x, p, action) = exact(step_size);
            let (q0, q1) = (V1::from([1.0]), V1::from([x]));
            let (time, q0, q1) = (0.0, &q0, &q1);
            let path = DiscretePath {
                time,
                step_size,
                q0,
                q1,
            };
            let (p0, p1) = path.momenta(&Pendulum(alpha)).expect("equal dimensions");
            let value = Pendulum(alpha).value(0.0, step_size, q0, q1);
            [value - action, p0[0] - 0.4, p1[0] - p].map(f64::abs)
        });
        // Of the momenta at both ends, the larger error.
        let [coarse, fine] = errors.map(|[value, p0, p1]| [value, p0.max(p1)]);
        let slopes = [0, 1].map(|k| (coarse[k] / fine[k]).log2());
        assert!(
            (slopes[0] - order - 1.0).abs() < 0.05,
            "{alpha}: {slopes:?}"
        );
        assert!((slopes[1] - order).abs() < 0.05, "{alpha}: {slopes:?}");
    }
}

#[test]
fn the_self_adjoint_defect_vanishes_for_symmetric_lagrangians_only() {
    let (q0, q1) = (V2::from([1.0, -0.4]), V2::from([1.1, -0.2]));
    let path = DiscretePath {
        time: 0.0,
        step_size: 0.1,
        q0: &q0,
        q1: &q1,
    };
    let at_once = DiscretePath {
        step_size: 0.0,
        ..path
    };
    let error = Error::Core(CoreError::StepSize { value: 0.0 });
    assert_eq!(at_once.momenta(&AtOnePoint(0.5)), Err(error));
    assert!(path.self_adjoint_defect(&AtOnePoint(0.5)) < 1e-16);
    assert!(path.self_adjoint_defect(&AtTwoPoints(0.3)) < 1e-16);
    assert!(path.self_adjoint_defect(&AtOnePoint(0.3)) > 1e-3);
    let q = DVector::from_vec(vec![1.0]);
    let path = DiscretePath {
        time: 0.2,
        step_size: 0.1,
        q0: &q,
        q1: &(&q * 1.1),
    };
    assert!(path.self_adjoint_defect(&ShakenLagrangian) < 1e-16);
}

/// The angular momentum of Kepler's problem; and J⁺ − J⁻, the change of Ld, for translations, which are no symmetry.
#[test]
fn symmetries_of_a_discrete_lagrangian_conserve_momentum() {
    let mut run = VariationalSteps::run(Trapezoid, perihelion(), 0.02).expect("a run");
    for _ in 0..10_000 {
        let State { q, p, .. } = run.step().expect("a step");
        let momentum = q.perp(p);
        assert!((momentum - 0.8).abs() < 1e-13, "{momentum}");
    }
    let (q0, q1) = (V2::from([1.0, -0.4]), V2::from([1.1, -0.2]));
    let path = DiscretePath {
        time: 0.0,
        step_size: 0.1,
        q0: &q0,
        q1: &q1,
    };
    let turn = |q: &V2<f64>| V2::from([-q[1], q[0]]);
    let [before, after] = path.momentum_maps(&Trapezoid, turn).expect("maps");
    assert!(
        (after - before).abs() < 4e-15 && before.abs() > 1.0,
        "{before} {after}"
    );
    let shift = |_: &V2<f64>| V2::from([1.0, 0.0]);
    let [before, after] = path.momentum_maps(&Trapezoid, shift).expect("maps");
    let moved = |by: f64| {
        let by = V2::from([by, 0.0]);
        Trapezoid.value(0.0, 0.1, &(q0 + by), &(q1 + by))
    };
    let change = (moved(1e-5) - moved(-1e-5)) / 2e-5;
    assert!((after - before - change).abs() < 1e-9 && change.abs() > 1e-2);
}

/// A particle in a central potential with drag: L = |v|²/2 − |q|⁴/4, f = −γv, at one point (Marsden & West, Example 3.2.2).
#[derive(Clone, Copy)]
struct Dragged {
    alpha: f64,
    drag: f64,
}

impl Dragged {
    fn point<T: Scalar>(&self, q0: &V2<T>, q1: &V2<T>) -> V2<T> {
        q0 * T::from_f64(1.0 - self.alpha) + q1 * T::from_f64(self.alpha)
    }
}

impl DiscreteLagrangian for Dragged {
    type Vector<T: Scalar> = V2<T>;

    const FORCED: bool = true;

    fn value<T: Scalar>(&self, _: T, h: T, q0: &V2<T>, q1: &V2<T>) -> T {
        let (q, v) = (self.point(q0, q1), (q1 - q0) * h.recip());
        h * (v.dot(&v) * T::from_f64(0.5) - q.dot(&q).powi(2) * T::from_f64(0.25))
    }

    fn forces<T: Scalar>(
        &self,
        _: T,
        _: T,
        q0: &V2<T>,
        q1: &V2<T>,
        minus: &mut V2<T>,
        plus: &mut V2<T>,
    ) {
        // h f, with f = −γ(q1 − q0)/h.
        let impulse = (q1 - q0) * T::from_f64(-self.drag);
        *minus = impulse * T::from_f64(1.0 - self.alpha);
        *plus = impulse * T::from_f64(self.alpha);
    }
}

fn dragged(drag: f64) -> impl System<V2<f64>, Class = symplectic::General> {
    hamiltonian::<V2<f64>, _, _>(
        |_, _, p, velocity| *velocity = *p,
        move |_, q, p, force| *force = -q * q.dot(q) - p * drag,
    )
}

#[test]
fn discrete_forces_balance_the_momentum() {
    let start = State::from_arrays(0.0, [1.0, 0.2], [-0.3, 0.9]);
    let (alpha, drag) = (0.5, 0.4);
    // At the middle: Gauss with one stage of the forced system.
    let middle = difference(
        Midpoint,
        dragged(drag),
        Dragged { alpha, drag },
        start.clone(),
    );
    assert!(middle < 1e-13, "{middle:e}");
    let mut run = Integrator::new(Gauss6, dragged(drag), start.clone(), 0.02).expect("a run");
    let reference = &run.integrate_to(1.0).expect("steps").clone();
    for (order, alpha) in [(2.0, 0.5), (1.0, 0.3)] {
        assert_order(order, reference, &start, 200, |state, size| {
            VariationalSteps::run(Dragged { alpha, drag }, state, size)
        });
    }
    // The potential is central: only the forces change the angular momentum, at both ends of the step, at any step size.
    let lagrangian = Dragged { alpha: 0.3, drag };
    let mut run = VariationalSteps::run(lagrangian, start, 0.2).expect("a run");
    for _ in 0..50 {
        let State { q: q0, p: p0, .. } = run.state().clone();
        let State { q: q1, p: p1, .. } = run.step().expect("a step").clone();
        let (mut minus, mut plus) = (V2::zeros(), V2::zeros());
        lagrangian.forces(0.0, 0.2, &q0, &q1, &mut minus, &mut plus);
        let change = q0.perp(&minus) + q1.perp(&plus);
        assert!((q1.perp(&p1) - q0.perp(&p0) - change).abs() < 4e-15);
        let path = DiscretePath {
            time: 0.0,
            step_size: 0.2,
            q0: &q0,
            q1: &q1,
        };
        let (before, after) = path.momenta(&lagrangian).expect("momenta");
        assert!((before - p0).norm() < 1e-14 && (after - p1).norm() < 1e-14);
    }
}

/// Adds `f(q1) − f(q0)`, f = x²y, and a function of the step size.
struct Equivalent<L>(L, f64, f64);

impl<L: DiscreteLagrangian<Vector<f64> = V2<f64>>> DiscreteLagrangian for Equivalent<L> {
    type Vector<T: Scalar> = L::Vector<T>;

    fn value<T: Scalar>(&self, time: T, h: T, q0: &L::Vector<T>, q1: &L::Vector<T>) -> T {
        let f = |q: &L::Vector<T>| q.as_slice()[0] * q.as_slice()[0] * q.as_slice()[1];
        let rest = (f(q1) - f(q0)) * T::from_f64(self.1) + h * h * T::from_f64(self.2);
        self.0.value(time, h, q0, q1) + rest
    }
}

/// Strong and weak equivalence (Marsden & West, §2.1.2): the same momenta; the same positions.
#[test]
fn equivalent_discrete_lagrangians_give_the_same_positions() {
    let end = |weak: f64, strong: f64| {
        let lagrangian = Equivalent(Trapezoid, weak, strong);
        let mut start = perihelion();
        // The momenta of Ld + f(q1) − f(q0) are p + f'(q).
        let gradient = |q: &V2<f64>| V2::from([2.0 * q[0] * q[1], q[0] * q[0]]) * weak;
        start.p += gradient(&start.q);
        let mut run = VariationalSteps::run(lagrangian, start, 0.02).expect("a run");
        let State { time, q, p } = run.integrate_to(1.0).expect("steps").clone();
        State::new(time, q, p - gradient(&q))
    };
    let expected = end(0.0, 0.0);
    assert!(distance(&end(0.7, 0.0), &expected) < 1e-12);
    assert!(distance(&end(0.0, 0.3), &expected) < 1e-12);

    let (q0, q1) = (V2::from([1.0, -0.4]), V2::from([1.1, -0.2]));
    let (path, q2) = (
        DiscretePath {
            time: 0.0,
            step_size: 0.1,
            q0: &q0,
            q1: &q1,
        },
        V2::from([1.3, 0.1]),
    );
    let (strong, weak) = path
        .difference(&Trapezoid, &Equivalent(Trapezoid, 0.0, 0.3), &q2)
        .expect("vectors");
    assert!(strong < 1e-14 && weak < 1e-14, "{strong:e} {weak:e}");
    let (strong, weak) = path
        .difference(&Trapezoid, &Equivalent(Trapezoid, 0.7, 0.3), &q2)
        .expect("vectors");
    assert!(strong > 0.5 && weak < 1e-13, "{strong:e} {weak:e}");
    let (strong, weak) = path
        .difference(&AtOnePoint(0.5), &AtOnePoint(0.4), &q2)
        .expect("vectors");
    assert!(strong > 1e-3 && weak > 1e-3, "{strong:e} {weak:e}");
}

/// Ld of a step, and the sum over the steps of a composition.
#[test]
fn the_action_of_a_step_is_the_discrete_lagrangian() {
    let mut run = VariationalSteps::run(Trapezoid, perihelion(), 0.02).expect("a run");
    assert_eq!(run.stepper().action(), None);
    let end = run.step().expect("a step").clone();
    let value = Trapezoid.value(0.0, 0.02, &perihelion().q, &end.q);
    assert_eq!(run.stepper().action(), Some(value));
    // L = E + 2/|q| with E = −1/2, on the orbit: by the composition to its order, by one step to order 2.
    let mut exact = Integrator::new(Gauss6, Kepler, perihelion(), 0.001).expect("a run");
    let mut action = 0.0;
    for _ in 0..20 {
        let before = 2.0 / exact.state().q.norm() - 0.5;
        let start = exact.state().clone();
        let after = 2.0 / exact.step().expect("a step").q.norm() - 0.5;
        let mut half = Integrator::new(Gauss6, Kepler, start, 0.0005).expect("a run");
        let middle = 2.0 / half.step().expect("a step").q.norm() - 0.5;
        action += (before + 4.0 * middle + after) * 0.001 / 6.0;
    }
    let mut composed =
        VariationalSteps::composed(Jump6, Trapezoid, perihelion(), 0.02).expect("a run");
    composed.step().expect("a step");
    let error = composed.stepper().action().expect("a step") - action;
    assert!(error.abs() < 1e-7, "{error:e}");
    assert!((value - action).abs() > 1e-5);
}

/// A Lagrangian of which the kinetic energy is |Av|²/2.
struct Kinetic([[f64; 2]; 2]);

impl DiscreteLagrangian for Kinetic {
    type Vector<T: Scalar> = V2<T>;

    fn value<T: Scalar>(&self, _: T, h: T, q0: &V2<T>, q1: &V2<T>) -> T {
        let v = q1 - q0;
        let squares = self.0.map(|row| {
            let [a, b] = row.map(T::from_f64);
            (a * v[0] + b * v[1]).powi(2)
        });
        (squares[0] + squares[1]) * T::from_f64(0.5) / h
    }
}

/// L = v³/6 + v²/20, whose momentum v²/2 + v/10 is never −1; `√(0.25 − t)` in place of that, where asked for.
struct Bounded(bool);

impl DiscreteLagrangian for Bounded {
    type Vector<T: Scalar> = V1<T>;

    fn value<T: Scalar>(&self, time: T, h: T, q0: &V1<T>, q1: &V1<T>) -> T {
        let v = (q1[0] - q0[0]) / h;
        if self.0 {
            return h * (v * v + q1[0] * (T::from_f64(0.25) - time).sqrt());
        }
        h * (v.powi(3) * T::from_f64(1.0 / 6.0) + v * v * T::from_f64(0.05))
    }
}

#[test]
fn degenerate_discrete_lagrangians_are_refused() {
    let start = State::from_arrays(0.0, [1.0, 2.0], [0.5, 0.5]);
    let degenerate = [
        ([[1.0, 0.0], [0.0, 0.0]], 1),
        ([[0.0, 0.0], [0.0, 1.0]], 0),
        ([[0.3, 0.1], [0.9, 0.3]], 1),
    ];
    for (matrix, expected) in degenerate {
        let mut run = VariationalSteps::run(Kinetic(matrix), start.clone(), 0.1).expect("a run");
        let error = run.step().map(|_| ()).expect_err("a degenerate Lagrangian");
        assert!(
            matches!(error, Error::IrregularLagrangian { step: 1, component, pivot, .. } if component == expected && pivot < 1e-14),
            "{error}"
        );
        assert_eq!(
            (run.state(), run.steps(), run.stepper().action()),
            (&start, 0, None)
        );
        let (q0, q1) = (V2::from([1.0, -0.4]), V2::from([1.1, -0.2]));
        let path = DiscretePath {
            time: 0.0,
            step_size: 0.1,
            q0: &q0,
            q1: &q1,
        };
        assert_eq!(path.is_regular(&Kinetic(matrix)), Ok(false));
        assert_eq!(
            path.is_regular(&Kinetic([[1e-9, 0.0], [0.0, 1e9]])),
            Ok(true)
        );
    }

    let start = State::from_arrays(0.0, [1.0], [-1.0]);
    let mut run = VariationalSteps::run(Bounded(false), start.clone(), 0.1).expect("a run");
    let error = run
        .step()
        .map(|_| ())
        .expect_err("no velocity has this momentum");
    assert!(
        matches!(error, Error::NoEndOfStep { step: 1, .. }),
        "{error}"
    );
    assert_eq!(run.state(), &start);

    let mut run = VariationalSteps::run(Bounded(true), start.clone(), 0.1).expect("a run");
    let error = run
        .integrate_to(1.0)
        .map(|_| ())
        .expect_err("a root of a negative number");
    let what = Quantity::DiscreteLagrangian;
    let matches = matches!(error, Error::Core(CoreError::NonFinite { step: 4, what: found, .. }) if found == what);
    assert!(matches, "{error}");
    assert_eq!(run.steps(), 3);

    let new = |state, size| VariationalSteps::run(Bounded(true), state, size).map(|_| ());
    assert_eq!(
        new(start.clone(), 0.0),
        Err(Error::Core(CoreError::StepSize { value: 0.0 }))
    );
    let infinite = State::from_arrays(0.0, [f64::INFINITY], [0.0]);
    let what = Quantity::Position;
    assert_eq!(
        new(infinite, 0.1),
        Err(Error::Core(CoreError::NonFiniteState { what }))
    );
    let (q0, q1) = (DVector::zeros(1), DVector::zeros(2));
    let path = DiscretePath {
        time: 0.0,
        step_size: 0.1,
        q0: &q0,
        q1: &q1,
    };
    let expected = Error::Core(CoreError::Dimension {
        position: 1,
        momentum: 2,
    });
    assert_eq!(path.momenta(&ShakenLagrangian), Err(expected));
}
