//! Several steps of a flow as one step.

use core::num::NonZeroU32;

use super::{Flow, FlowError, Span};
use crate::Error;
use symplectic_core::Vector;

/// `n` steps of size `h/n` of a flow.
///
/// In a step of the slow part of a system it takes several steps of the fast part. For r-RESPA (Tuckerman, Berne & Martyna 1992), use a
/// velocity-Verlet [`Splitting`](super::Splitting): its drift is `Substeps` of the fast part, its kick the slow force. The last flow of a
/// substep and the first of the next are merged, so that a kick–drift–kick substep evaluates the force once.
///
/// ```
/// symplectic::tableau! { Verlet { base: velocity-verlet } }
/// use symplectic::flow::{Drift, FlowSteps, Kick, Splitting, Substeps};
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{State, acceleration};
///
/// # fn main() -> Result<(), symplectic::flow::Error> {
/// let stiff = || acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -100.0 * q[0]);
/// let soft = acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0].powi(3));
/// let fast = Splitting::new(Verlet, Drift::new(stiff()), Kick::new(stiff()));
/// let step = Splitting::new(Verlet, Substeps::new(fast, 8)?, Kick::new(soft));
/// let mut run = FlowSteps::run(step, State::from_arrays(0.0, [1.0], [0.0]), 0.1)?;
/// run.integrate_to(10.0)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Substeps<F> {
    count: NonZeroU32,
    /// The flow of a substep.
    pub step: F,
}

impl<F> Substeps<F> {
    /// `count` steps of the flow.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] for 0 steps.
    pub fn new(step: F, count: u32) -> Result<Self, Error> {
        let count = NonZeroU32::new(count).ok_or(Error::FlowParameter {
            what: "number of substeps",
            index: 0,
            value: 0.0,
            range: "1 or more",
        })?;
        Ok(Self { count, step })
    }
}

impl<V: Vector, F: Flow<V>> Flow<V> for Substeps<F> {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        self.flow_through(core::iter::once(span), q, p)
    }

    fn flow_through(
        &mut self,
        spans: impl Iterator<Item = Span>,
        q: &mut V,
        p: &mut V,
    ) -> Result<(), FlowError> {
        let count = self.count.get();
        let parts = spans.flat_map(|Span { time, size }| {
            let size = size / f64::from(count);
            (0..count).map(move |number| Span {
                time: time + f64::from(number) * size,
                size,
            })
        });
        self.step.flow_through(parts, q, p)
    }

    fn memory(&mut self, visit: &mut dyn FnMut(&mut u64)) {
        self.step.memory(visit);
    }
}
