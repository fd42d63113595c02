//! Orders of splittings, against the same motion by an integrator of another kind.

use std::cell::Cell;

use symplectic::flow::{
    Composed, Drift, Error, Flow, FlowError, FlowSteps, Kick, Palindrome, Span, Splitting, Substeps,
};
use symplectic::friction::Damped;
use symplectic::nalgebra::Vector1;
use symplectic::proved::Splits;
use symplectic::{Method, ProvedFor, Quantity, State, acceleration};

use crate::common::methods::{ForestRuth, Gauss8, McLachlanAtela, PositionJump, StoermerVerlet};
use crate::common::systems::{Driven, Pendulum, point};
use crate::common::{distance, run};
use crate::methods::{Aba1064, BlanesMoan6, Saba2, Saba3};

symplectic::composition! {
    Suzuki4 { base: stormer-verlet, weights: suzuki(4), require: [order == 4] }
    Verlet { base: velocity-verlet, weights: [1] }
}

type V = Vector1<f64>;

symplectic::hamiltonian! {
    /// A rotation, a squeeze and a quartic potential.
    Sum { squeeze: 0.6, quartic: 0 }
    q: [x], p: [y];
    H = (x^2 + y^2)/2 + squeeze x^2 y^2/2 + quartic x^4/4
}

/// H = (q² + p²)/2.
#[derive(Clone, Copy)]
pub struct Rotation;

impl Flow<V> for Rotation {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        let (sine, cosine) = span.size.sin_cos();
        (*q, *p) = (*q * cosine + *p * sine, *p * cosine - *q * sine);
        Ok(())
    }
}

/// H = c q²p²/2: the product qp stays.
#[derive(Clone, Copy)]
struct Squeeze(f64);

impl Flow<V> for Squeeze {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        let exponent = self.0 * q[0] * p[0] * span.size;
        *q *= exponent.exp();
        *p *= (-exponent).exp();
        Ok(())
    }
}

/// H = cq⁴/4.
#[derive(Clone, Copy)]
pub struct Quartic(pub f64);

impl Flow<V> for Quartic {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        p[0] -= self.0 * span.size * q[0].powi(3);
        Ok(())
    }
}

pub const END: f64 = 4.0;

pub fn start() -> State<V> {
    point(0.9, 0.4)
}

/// The motion by Gauss with eight stages and 400 steps.
pub fn exact(squeeze: f64, quartic: f64) -> State<V> {
    run(Gauss8, Sum { squeeze, quartic }, start(), END, 400).expect("a run")
}

fn end(flow: impl Flow<V>, steps: u32) -> State<V> {
    let size = END / f64::from(steps);
    let mut run = FlowSteps::run(flow, start(), size).expect("a run");
    run.integrate_to(END).expect("steps").clone()
}

/// The slope of the error when the number of steps is doubled.
fn slope(flow: impl Flow<V> + Copy, exact: &State<V>, steps: u32) -> f64 {
    let [coarse, fine] = [steps, 2 * steps].map(|steps| distance(&end(flow, steps), exact));
    assert!(fine > 1e-13, "{fine}");
    (coarse / fine).log2()
}

pub fn near(slope: f64, order: f64) {
    assert!((slope - order).abs() < 0.05, "{slope} instead of {order}");
}

/// The squeeze is no potential: `[B, [B, [B, A]]] ≠ 0`.
#[test]
fn the_order_is_that_for_separable_systems() {
    let exact = exact(0.6, 0.0);
    let (a, b) = (Rotation, Squeeze(0.6));
    near(
        slope(Splitting::new(StoermerVerlet, a, b), &exact, 400),
        2.0,
    );
    near(
        slope(Splitting::new(StoermerVerlet, b, a), &exact, 400),
        2.0,
    );
    near(slope(Splitting::new(ForestRuth, a, b), &exact, 200), 4.0);
    near(slope(Splitting::new(BlanesMoan6, a, b), &exact, 24), 6.0);
    near(slope(Splitting::new(Aba1064, a, b), &exact, 64), 4.0);
    // Of order 4 for quadratic kinetic energies only.
    let nystrom = Splitting::new(McLachlanAtela.accept_lower_order(), b, a);
    near(slope(nystrom, &exact, 192), 3.0);
}

/// The errors that are odd and even in ε, ε and ε².
fn by_powers<M: Copy + Splits + ProvedFor<Damped>>(method: M, small: f64, steps: u32) -> [f64; 2] {
    let [plus, minus] = [small, -small].map(|small| {
        let (found, exact) = (
            end(Splitting::new(method, Rotation, Quartic(small)), steps),
            exact(0.0, small),
        );
        [found.q - exact.q, found.p - exact.p]
    });
    [-1.0, 1.0].map(|sign| {
        let parts = [0, 1].map(|k| (plus[k] + minus[k] * sign)[0].abs() / 2.0);
        parts[0].hypot(parts[1])
    })
}

/// The error is O(εh^s1) + O(ε²h^s2) + O(ε³h^s3). That of ABA(10, 6, 4) with ε is below rounding where the step is small.
#[test]
fn perturbed_systems_have_two_orders() {
    fn slopes<M>(method: M, small: [f64; 2], steps: [u32; 2]) -> [f64; 2]
    where
        M: Copy + Splits + ProvedFor<Damped>,
    {
        [0, 1].map(|power| {
            let (small, steps) = (small[power], steps[power]);
            let [coarse, fine] =
                [steps, 2 * steps].map(|steps| by_powers(method, small, steps)[power]);
            assert!(fine > 1e-14, "{fine}");
            (coarse / fine).log2()
        })
    }
    for (found, orders) in [
        (slopes(Saba2, [1e-4, 1e-2], [20, 40]), [4.0, 2.0]),
        (slopes(Saba3, [1e-4, 1e-2], [20, 40]), [6.0, 2.0]),
    ] {
        near(found[0], orders[0]);
        near(found[1], orders[1]);
    }
    let slope = |small, power: usize, steps| {
        let [coarse, fine] =
            [steps, 2 * steps].map(|steps| by_powers(Aba1064, small, steps)[power]);
        (coarse / fine).log2()
    };
    near(slope(1e-2, 1, 12), 6.0);
    near(slope(1e-1, 0, 32), 4.0);
}

#[test]
fn palindromes_of_three_parts_have_orders_two_and_four() {
    let exact = exact(0.6, 0.3);
    let step = Palindrome::new(Rotation, Palindrome::new(Squeeze(0.6), Quartic(0.3)));
    near(slope(step, &exact, 200), 2.0);
    near(slope(Composed::new(Suzuki4, step), &exact, 40), 4.0);
    let other = Palindrome::new(Quartic(0.3), Palindrome::new(Rotation, Squeeze(0.6)));
    near(slope(Composed::new(Suzuki4, other), &exact, 40), 4.0);
}

fn pendulum() -> impl symplectic::System<V, Class = symplectic::Separable> + Copy {
    acceleration::<V, _>(|_, q, force| force[0] = -q[0].sin())
}

#[test]
fn kicks_and_drifts_are_those_of_the_integrator() {
    let expected = run(ForestRuth, Pendulum::default(), point(1.2, 0.3), 10.0, 100).expect("a run");
    let step = Splitting::new(ForestRuth, Drift::new(pendulum()), Kick::new(pendulum()));
    let mut flows = FlowSteps::run(step, point(1.2, 0.3), 0.1).expect("a run");
    let found = flows.integrate_to(10.0).expect("steps");
    assert!(distance(found, &expected) < 1e-13);
    assert_eq!(flows.steps(), 100);
    flows.integrate_to(0.0).expect("steps");
    assert!(distance(flows.state(), &point(1.2, 0.3)) < 1e-12);
}

/// q'' = −q + cos 3t, whose solution is known.
#[test]
fn kicks_may_depend_on_time() {
    let drift = acceleration::<V, _>(|_, _, force| force[0] = 0.0);
    fn slope(flow: impl Flow<V> + Clone, steps: u32) -> f64 {
        let [coarse, fine] = [steps, 2 * steps].map(|steps| {
            let size = 3.0 / f64::from(steps);
            let mut run = FlowSteps::run(flow.clone(), point(1.0, 0.0), size).expect("a run");
            distance(run.integrate_to(3.0).expect("steps"), &Driven::exact(3.0))
        });
        (coarse / fine).log2()
    }
    let (drift, kick) = (Drift::new(drift), Kick::new(Driven));
    near(slope(Splitting::new(ForestRuth, drift, kick), 200), 4.0);
    // Drift first, in a run of several steps that are joined.
    let jump = Splitting::new(PositionJump, drift, kick);
    near(slope(Substeps::new(jump, 10).expect("10 steps"), 20), 4.0);
    near(slope(Palindrome::new(kick, drift), 200), 2.0);
    near(
        slope(Composed::new(Suzuki4, Palindrome::new(kick, drift)), 50),
        4.0,
    );
}

/// Counts how often a flow is taken.
struct Counted<'a, F>(F, &'a Cell<u32>);

impl<F: Flow<V>> Flow<V> for Counted<'_, F> {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        self.1.set(self.1.get() + 1);
        self.0.flow(span, q, p)
    }
}

#[test]
fn adjacent_flows_of_one_part_are_merged() {
    let counts = [const { Cell::new(0) }; 2];
    let parts = || {
        let kick = Counted(Quartic(0.5), &counts[1]);
        (Counted(Rotation, &counts[0]), kick)
    };
    let taken = || counts.each_ref().map(|count| count.replace(0));
    let (drift, kick) = parts();
    let one = end(Splitting::new(Verlet, drift, kick), 40);
    assert_eq!(taken(), [40, 80]);
    let (drift, kick) = parts();
    let many = Substeps::new(Splitting::new(Verlet, drift, kick), 20).expect("20 steps");
    let joined = end(many, 2);
    assert_eq!(taken(), [40, 42]);
    assert!(distance(&one, &joined) < 1e-14);
    let (drift, kick) = parts();
    let many = Substeps::new(Palindrome::new(kick, drift), 20).expect("20 steps");
    assert!(distance(&one, &end(many, 2)) < 1e-14);
    assert_eq!(taken(), [40, 42]);
    // The kicks of the five steps of Suzuki's method meet.
    let (drift, kick) = parts();
    end(Composed::new(Suzuki4, Palindrome::new(kick, drift)), 10);
    assert_eq!(taken(), [50, 60]);
    let (drift, kick) = parts();
    end(Splitting::new(Suzuki4, drift, kick), 10);
    assert_eq!(taken(), [50, 60]);
}

#[test]
fn a_step_that_fails_leaves_the_state() {
    let wall = acceleration::<V, _>(|_, q, force| force[0] = 1.0 / (q[0] - 1.0).min(0.0).sqrt());
    let step = Splitting::new(ForestRuth, Drift::new(wall), Kick::new(wall));
    let mut run = FlowSteps::run(step, point(0.5, 1.0), 0.1).expect("a run");
    let before = run.state().clone();
    let failure = run.step().expect_err("a root of a negative number");
    let what = Quantity::Force;
    assert!(
        matches!(failure, Error::Core(symplectic::Error::NonFinite { what: found, step: 1, .. }) if found == what)
    );
    assert_eq!((run.state(), run.steps()), (&before, 0));
}

#[test]
fn bad_input_is_refused() {
    let new = |state, size| FlowSteps::run(Rotation, state, size).map(|_| ());
    assert_eq!(
        new(point(0.0, 1.0), 0.0),
        Err(Error::Core(symplectic::Error::StepSize { value: 0.0 }))
    );
    let what = Quantity::Position;
    assert_eq!(
        new(point(f64::NAN, 1.0), 0.1),
        Err(Error::Core(symplectic::Error::NonFiniteState { what }))
    );
    assert!(matches!(
        Substeps::new(Rotation, 0),
        Err(Error::FlowParameter { .. })
    ));
}
