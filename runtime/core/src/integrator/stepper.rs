//! Steppers: what a run drives.

use super::clock::RemainingSteps;
use super::{Pace, Statistics};
use crate::error::Error;
use crate::state::Timed;

/// Takes steps: a method with its system and the present state. A [`Run`](super::Run) chooses sizes and times of the steps.
///
/// Every integrator of this crate is a run of a stepper. Your own method becomes one with an implementation:
///
/// ```
/// use symplectic::nalgebra::Vector1;
/// use symplectic::stepper::{Equal, StepMap, Stepper};
/// use symplectic::{Error, Run, State, Statistics};
///
/// /// The symplectic Euler method for a pendulum.
/// #[derive(Clone)]
/// struct Pendulum {
///     state: State<Vector1<f64>>,
///     statistics: Statistics,
/// }
///
/// impl Stepper for Pendulum {
///     type State = State<Vector1<f64>>;
///     type Error = Error;
///     type Pace = Equal;
///     type Saved = Self;
///
///     fn state(&self) -> &Self::State {
///         &self.state
///     }
///
///     fn statistics(&self) -> &Statistics {
///         &self.statistics
///     }
///
///     fn statistics_mut(&mut self) -> &mut Statistics {
///         &mut self.statistics
///     }
///
///     fn set_state(&mut self, state: &Self::State) -> Result<(), Error> {
///         self.state = state.clone();
///         Ok(())
///     }
///
///     fn advance(&mut self, size: f64, end: f64) -> Result<(), Error> {
///         let State { time, q, p } = &mut self.state;
///         p[0] -= size * q[0].sin();
///         q[0] += size * p[0];
///         *time = end;
///         self.statistics.steps += 1;
///         Ok(())
///     }
///
///     fn save(&self) -> Self {
///         self.clone()
///     }
///
///     fn go_back(&mut self, saved: &Self) {
///         self.clone_from(saved);
///     }
/// }
///
/// # fn main() -> Result<(), Error> {
/// let near = |a, b| State::from_arrays(0.0, [1.0 + a], [b]);
/// let stepper = Pendulum { state: near(0.0, 0.0), statistics: Statistics::default() };
/// let mut run = Run::of(stepper, 0.01)?;
/// assert!(run.symplecticity_defect(near)? < 1e-11);
/// let end = run.integrate_to(10.0)?;
/// assert!((end.p[0] * end.p[0] / 2.0 - end.q[0].cos() + 1_f64.cos()).abs() < 0.01);
/// assert_eq!((run.state().time, run.steps()), (10.0, 1000));
/// # Ok(())
/// # }
/// ```
pub trait Stepper {
    /// The state.
    type State: Timed;

    /// The error of a step: [`Error`], or one that contains it if the method can fail in other ways.
    type Error: core::error::Error + From<Error> + Send + Sync + 'static;

    /// Who chooses the sizes of the steps: [`Equal`](super::Equal) or [`Own`](super::Own).
    type Pace: Pace;

    /// What a step changes.
    type Saved;

    /// The present state.
    fn state(&self) -> &Self::State;

    /// Returns the present state and drops the stepper.
    fn into_state(self) -> Self::State
    where
        Self: Sized,
    {
        self.state().clone()
    }

    /// The time of the present state.
    #[inline]
    fn time(&self) -> f64 {
        self.state().time()
    }

    /// The statistics of all steps so far.
    fn statistics(&self) -> &Statistics;

    /// The statistics, for a run that counts what it rejects.
    fn statistics_mut(&mut self) -> &mut Statistics;

    /// Replaces the present state. The next step is that of a new stepper from there.
    ///
    /// # Errors
    ///
    /// Those of a new stepper at this state; nothing is then changed.
    fn set_state(&mut self, state: &Self::State) -> Result<(), Self::Error>;

    /// Takes a step of size `size` to the time `end`, which is not the present time, and counts it. A stepper with its [`Own`](super::Own)
    /// pace ignores both.
    ///
    /// # Errors
    ///
    /// Those of the method; the state is then unchanged.
    fn advance(&mut self, size: f64, end: f64) -> Result<(), Self::Error>;

    /// Takes all these steps. They have the bits of single steps.
    ///
    /// # Errors
    ///
    /// Those of [`advance`](Self::advance) and [`Error::TimeResolution`]; the step that failed is then the next of `steps`.
    #[inline]
    fn take(&mut self, steps: &mut RemainingSteps) -> Result<(), Self::Error> {
        self.take_while(steps, |_, _| true).map(|_| ())
    }

    /// Takes these steps until `goes_on` of the state and the statistics after a step is `false`; returns whether it always was `true`.
    ///
    /// # Errors
    ///
    /// As for [`take`](Self::take).
    #[inline]
    fn take_while(
        &mut self,
        steps: &mut RemainingSteps,
        mut goes_on: impl FnMut(&Self::State, &Statistics) -> bool,
    ) -> Result<bool, Self::Error> {
        while let Some((size, end)) = steps.next() {
            advance_in_time(self, size, end)?;
            steps.tick();
            if !goes_on(self.state(), self.statistics()) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The approximate size of the next step, negative in a run backward; asked only of a stepper with its [`Own`](super::Own) pace.
    fn own_step_size(&self) -> Option<f64> {
        None
    }

    /// What the next step may change, statistics included.
    fn save(&self) -> Self::Saved;

    /// Returns to what was saved.
    fn go_back(&mut self, saved: &Self::Saved);

    /// Whether a step that failed with this error may be [split](super::Retry) into shorter ones. By default it may not. Most
    /// methods answer with [`Error::depends_on_the_size`].
    fn may_split(&self, error: &Self::Error) -> bool {
        let _ = error;
        false
    }
}

/// [`Stepper::advance`], after a check that the step changes the time.
///
/// # Errors
///
/// [`Error::TimeResolution`] if it does not; those of [`Stepper::advance`].
#[inline]
pub fn advance_in_time<S: Stepper + ?Sized>(
    stepper: &mut S,
    size: f64,
    end: f64,
) -> Result<(), S::Error> {
    if !S::Pace::OWN && end == stepper.time() {
        let (time, step_size) = (end, size);
        return Err(Error::TimeResolution { time, step_size }.into());
    }
    stepper.advance(size, end)
}
