//! The symmetric step of two or more flows.

use super::{Flow, FlowError, Span};
use symplectic_core::Vector;

/// `A(h/2) B(h) A(h/2)`: symmetric, of order 2 (Strang 1968).
///
/// `B` may be a palindrome again: `Palindrome::new(a, Palindrome::new(b, c))` is `A/2 B/2 C B/2 A/2`, and so on for any number of
/// parts. [`Composed`](super::Composed) raises the order.
///
/// The span of the inner flow is that of the step. The spans of the outer flow are centred at the start and at the end of the step. In
/// [`flow_through`](Flow::flow_through) the last outer flow of a step and the first of the next step are merged.
///
/// ```
/// use symplectic::flow::{Damping, Drift, FlowSteps, Kick, Palindrome};
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{State, acceleration};
///
/// # fn main() -> Result<(), symplectic::flow::Error> {
/// let spring = || acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0]);
/// let free = Palindrome::new(Drift::new(spring()), Damping::new(0.1)?);
/// let step = Palindrome::new(Kick::new(spring()), free);
/// let mut run = FlowSteps::run(step, State::from_arrays(0.0, [1.0], [0.0]), 0.01)?;
/// run.integrate_to(10.0)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Palindrome<A, B> {
    /// The flow at both ends.
    pub outer: A,
    /// The flow in the middle.
    pub inner: B,
}

impl<A, B> Palindrome<A, B> {
    /// The step with these flows.
    pub const fn new(outer: A, inner: B) -> Self {
        Self { outer, inner }
    }
}

impl<V: Vector, A: Flow<V>, B: Flow<V>> Flow<V> for Palindrome<A, B> {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        self.flow_through(core::iter::once(span), q, p)
    }

    fn flow_through(
        &mut self,
        spans: impl Iterator<Item = Span>,
        q: &mut V,
        p: &mut V,
    ) -> Result<(), FlowError> {
        // Middle and size of the pending outer flow at the end of the previous step.
        let mut pending: Option<(f64, f64)> = None;
        for span in spans {
            let half = span.size / 2.0;
            let first = match pending {
                Some((time, size)) => Span::about(time, size + half),
                None => Span::about(span.time, half),
            };
            self.outer.flow(first, q, p)?;
            self.inner.flow(span, q, p)?;
            pending = Some((span.time + span.size, half));
        }
        pending.map_or(Ok(()), |(time, size)| {
            self.outer.flow(Span::about(time, size), q, p)
        })
    }

    fn memory(&mut self, visit: &mut dyn FnMut(&mut u64)) {
        self.outer.memory(visit);
        self.inner.memory(visit);
    }
}
