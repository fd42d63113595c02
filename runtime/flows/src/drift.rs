//! A drift by the velocity of a system.

use super::kick::{add, work_vector};
use super::{Flow, FlowError, Span};
use symplectic_core::{Quantity, Separable, System, Vector};

/// The flow of the kinetic energy of a separable system: `q ← q + h velocity(t, p)`, with t at the [middle](Span::middle) of the span.
///
/// It is exact if the velocity does not depend on time, and has order 2 otherwise.
///
/// ```
/// use symplectic::flow::{Drift, Flow, FlowError, Span};
/// use symplectic::nalgebra::Vector1;
/// use symplectic::separable;
///
/// // A mass of 2.
/// let system = separable::<Vector1<f64>, _, _>(|_, p, velocity| velocity[0] = p[0] / 2.0, |_, _, force| force[0] = 0.0);
/// let (mut q, mut p) = (Vector1::new(2.0), Vector1::new(1.0));
/// Drift::new(system).flow(Span { time: 0.0, size: 0.5 }, &mut q, &mut p)?;
/// assert_eq!((q[0], p[0]), (2.25, 1.0));
/// # Ok::<(), FlowError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Drift<S, V> {
    system: S,
    velocity: Option<V>,
}

impl<V: Vector<Scalar = f64>, S: System<V, Class = Separable>> Drift<S, V> {
    /// The drift by the velocity of this system.
    pub const fn new(system: S) -> Self {
        Self {
            system,
            velocity: None,
        }
    }
}

impl<V: Vector<Scalar = f64>, S: System<V, Class = Separable>> Flow<V> for Drift<S, V> {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        if S::MASSES.are_unit() {
            return add(Quantity::Velocity, span.size, p, q);
        }
        let velocity = work_vector(&mut self.velocity, q, p)?;
        self.system.velocity(span.middle(), q, p, velocity);
        add(Quantity::Velocity, span.size, velocity, q)
    }
}
