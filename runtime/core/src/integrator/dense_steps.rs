//! Steppers whose last step can be followed.

use super::Stepper;
use crate::error::Error;
use crate::number::Vector;
use crate::state::State;

/// A [`Stepper`] that knows the states inside its last step: runs then have output at any time, events and walls.
pub trait DenseSteps: Stepper<State = State<Self::Vector>> {
    /// The vectors of a state.
    type Vector: Vector;

    /// Memory for states inside steps.
    type Scratch;

    /// Memory for states like the present one.
    fn scratch(&self) -> Self::Scratch;

    /// The times of the start and the end of the last step. `None` before the first step and after every call that discards it, such as a
    /// new state or a failed step.
    fn last_span(&self) -> Option<(f64, f64)>;

    /// Writes the state at the start of the last step; the present state if there is no last step.
    fn write_start(&self, out: &mut State<Self::Vector>);

    /// Prepares the memory for the last step; it is called once, before the first look into the step.
    ///
    /// # Errors
    ///
    /// [`Error::NoStep`] and those of the method.
    fn prepare(&self, scratch: &mut Self::Scratch) -> Result<(), Self::Error> {
        let _ = scratch;
        self.last_span()
            .map(|_| ())
            .ok_or_else(|| Error::NoStep.into())
    }

    /// Writes the state at a time inside the last step, for which the memory was [prepared](Self::prepare).
    ///
    /// # Errors
    ///
    /// [`Error::NoStep`], [`Error::OutsideStep`] and those of the method.
    fn look(
        &mut self,
        time: f64,
        scratch: &mut Self::Scratch,
        out: &mut State<Self::Vector>,
    ) -> Result<(), Self::Error>;

    /// [`look`](Self::look) by a step of the method from the start of the last step; it needs no preparation.
    ///
    /// # Errors
    ///
    /// [`Error::NoStep`] and those of a step.
    fn look_by_step(
        &mut self,
        time: f64,
        scratch: &mut Self::Scratch,
        out: &mut State<Self::Vector>,
    ) -> Result<(), Self::Error> {
        self.prepare(scratch)?;
        self.look(time, scratch, out)
    }

    /// Writes q' and p' at a state; `size` is small compared with a step, for difference quotients.
    fn slopes(
        &mut self,
        state: &State<Self::Vector>,
        size: f64,
        velocity: &mut Self::Vector,
        force: &mut Self::Vector,
    );
}
