//! Parts that depend on time, in every place of a step.

use symplectic::flow::{
    Composed, Drift, Flow, FlowSteps, Gyration, Kick, Palindrome, Span, Splitting, Substeps,
};
use symplectic::nalgebra::{DVector, Vector1, Vector3};
use symplectic::{Separable, State, System, acceleration, separable};

use crate::common::methods::{ForestRuth, Gauss5, StoermerVerlet};
use crate::common::systems::point;
use crate::common::{distance, run};
use crate::methods::BlanesMoan6;

symplectic::composition! {
    Suzuki4 { base: stormer-verlet, weights: suzuki(4), require: [order == 4] }
}

type V = Vector1<f64>;

const END: f64 = 2.0;

/// A pendulum whose mass and weight grow.
fn pendulum() -> impl System<V, Class = Separable> + Copy {
    separable::<V, _, _>(
        |t, p, velocity: &mut V| velocity[0] = p[0] / (1.0 + 0.5 * t),
        |t, q, force: &mut V| force[0] = -(1.0 + 0.3 * t) * q[0].sin(),
    )
}

/// The order that the errors with one and with twice as many steps show.
fn slope(flow: impl Flow<V> + Clone, steps: u32) -> f64 {
    let start = point(1.0, 0.2);
    let exact = run(Gauss5, pendulum(), start.clone(), END, 200).expect("a run");
    let [coarse, fine] = [steps, 2 * steps].map(|steps| {
        let size = END / f64::from(steps);
        let mut run = FlowSteps::run(flow.clone(), start.clone(), size).expect("a run");
        distance(run.integrate_to(END).expect("steps"), &exact)
    });
    (coarse / fine).log2()
}

fn thirds<F>(flow: F) -> Substeps<F> {
    Substeps::new(flow, 3).expect("3 steps")
}

fn near(slope: f64, order: f64) {
    assert!((slope - order).abs() < 0.05, "{slope} instead of {order}");
}

#[test]
fn both_parts_may_depend_on_time() {
    let (drift, kick) = (Drift::new(pendulum()), Kick::new(pendulum()));
    near(slope(Splitting::new(StoermerVerlet, drift, kick), 50), 2.0);
    // A composition of Verlet steps keeps its order, and another splitting does not.
    near(slope(Splitting::new(ForestRuth, drift, kick), 100), 4.0);
    near(slope(Splitting::new(BlanesMoan6, drift, kick), 50), 2.0);
    let nested = Splitting::new(StoermerVerlet, drift, thirds(kick));
    near(slope(nested, 50), 2.0);
    near(slope(Palindrome::new(thirds(kick), drift), 50), 2.0);
    let step = Palindrome::new(kick, drift);
    near(slope(thirds(step), 50), 2.0);
    near(slope(Composed::new(Suzuki4, step), 20), 4.0);
    let step = Palindrome::new(drift, kick);
    near(slope(step, 50), 2.0);
    near(slope(Composed::new(Suzuki4, step), 20), 4.0);
}

/// A uniform field 1 + t³ turns the velocity by t + t⁴/4.
#[test]
fn a_magnetic_field_may_depend_on_time() {
    let free = acceleration::<Vector3<f64>, _>(|_, _, force| force.fill(0.0));
    let errors = [100, 200].map(|steps| {
        let field = |t: f64, _: &Vector3<f64>| Vector3::z() * (1.0 + t * t * t);
        let inner = Palindrome::new(Kick::new(free), Gyration::new(field));
        let step = Palindrome::new(Drift::new(free), inner);
        let start = State::new(0.0, Vector3::zeros(), Vector3::x());
        let mut run = FlowSteps::run(step, start, END / f64::from(steps)).expect("a run");
        let v = run.integrate_to(END).expect("steps").p;
        let angle = END + END.powi(4) / 4.0;
        (v - Vector3::new(angle.cos(), -angle.sin(), 0.0)).norm()
    });
    near((errors[0] / errors[1]).log2(), 2.0);
}

/// One flow after another, of states with different numbers of components.
#[test]
fn a_flow_takes_states_of_any_dimension() {
    let system = separable::<DVector<f64>, _, _>(
        |_, p, velocity| (0..p.len()).for_each(|i| velocity[i] = 2.0 * p[i]),
        |_, q, force| (0..q.len()).for_each(|i| force[i] = -q[i]),
    );
    let mut step = Palindrome::new(Kick::new(system.clone()), Drift::new(system));
    let span = Span {
        time: 0.0,
        size: 0.5,
    };
    for dimension in [1, 3, 2] {
        let (mut q, mut p) = (DVector::repeat(dimension, 1.0), DVector::zeros(dimension));
        step.flow(span, &mut q, &mut p).expect("a step");
        assert_eq!(q, DVector::repeat(dimension, 0.75));
        assert_eq!(p, DVector::repeat(dimension, -0.4375));
    }
}
