//! Compositions of symmetric steps of order 2: methods of higher order.

use super::{Flow, FlowError, Span};
use symplectic_core::Vector;
use symplectic_core::inside::SymmetricSteps;
use symplectic_core::proved::StoermerVerletSteps;

/// A symmetric flow of order 2, such as a [`Palindrome`](super::Palindrome) of three parts, composed with the step sizes `γ_1 h, …, γ_m h`.
/// The `γ_i` come from a composition of Störmer–Verlet steps, defined by [`composition!`](symplectic_core::composition).
///
/// The order is `M::ORDERS.general`: the order conditions are the same for every symmetric method of order 2 (Hairer, Lubich & Wanner, V.3).
/// A method that is not a composition of Störmer–Verlet steps does not compile.
///
/// ```
/// symplectic::composition! { Suzuki4 { base: stormer-verlet, weights: suzuki(4), require: [order == 4] } }
/// use symplectic::flow::{Composed, Drift, Kick, Palindrome};
/// use symplectic::nalgebra::Vector1;
/// use symplectic::acceleration;
///
/// let part = |stiffness: f64| acceleration::<Vector1<f64>, _>(move |_, q, force| force[0] = -stiffness * q[0]);
/// let three = Palindrome::new(Kick::new(part(1.0)), Palindrome::new(Kick::new(part(2.0)), Drift::new(part(0.0))));
/// let step = Composed::new(Suzuki4, three);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Composed<F> {
    steps: SymmetricSteps,
    /// The symmetric step of order 2.
    pub step: F,
}

impl<F> Composed<F> {
    /// The composition of steps of `step` with the fractions `γ_i` of the method.
    pub fn new<M: StoermerVerletSteps>(_method: M, step: F) -> Self {
        Self {
            steps: SymmetricSteps::of::<M>(),
            step,
        }
    }
}

impl<V: Vector, F: Flow<V>> Flow<V> for Composed<F> {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        self.flow_through(core::iter::once(span), q, p)
    }

    fn flow_through(
        &mut self,
        spans: impl Iterator<Item = Span>,
        q: &mut V,
        p: &mut V,
    ) -> Result<(), FlowError> {
        let steps = self.steps;
        let parts = spans.flat_map(|Span { time, size }| {
            let parts = steps.parts(time, size, time + size);
            parts.map(|part| Span {
                time: part.time,
                size: part.size,
            })
        });
        self.step.flow_through(parts, q, p)
    }

    fn memory(&mut self, visit: &mut dyn FnMut(&mut u64)) {
        self.step.memory(visit);
    }
}
