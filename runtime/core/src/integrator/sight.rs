//! Steps that are seen only if there is something to see.

use core::ops::ControlFlow;

use super::{Statistics, Stepper};

/// What is to be seen in the steps of a run: output and events.
pub(crate) trait Sight<S: Stepper, B> {
    /// Whether nothing is to be seen in the step to `state`. The state before the step and its stages may be unavailable.
    fn passes(&mut self, state: &S::State, statistics: &Statistics) -> bool;

    /// Sees the last step, unless it passes.
    fn see(&mut self, stepper: &mut S) -> Result<ControlFlow<B>, S::Error>;

    /// Sees the last step if it does not pass.
    fn see_or_pass(&mut self, stepper: &mut S) -> Result<ControlFlow<B>, S::Error> {
        match self.passes(stepper.state(), stepper.statistics()) {
            true => Ok(ControlFlow::Continue(())),
            false => self.see(stepper),
        }
    }
}
