//! Runs to a given time.

use core::convert::Infallible;
use core::ops::ControlFlow;

use super::{Equal, Pace, Run, Stepper};

/// A [`Pace`] at which a [`Run`] integrates to a given time: [`Equal`] steps end there; a stepper with its [`Own`](super::Own) pace passes it,
/// if it knows the states [inside its last step](super::DenseSteps).
pub trait Reach<S: Stepper>: Pace {
    /// The state at a given time: a reference to the present state, or a state inside the last step.
    type Reached<'a>
    where
        S: 'a;

    /// See [`Run::integrate_with`].
    ///
    /// # Errors
    ///
    /// Those of [`Run::integrate_with`].
    fn integrate_with(
        run: &mut Run<S>,
        end: f64,
        observe: impl FnMut(&S::State),
    ) -> Result<Self::Reached<'_>, S::Error>;

    /// See [`Run::integrate_to`].
    ///
    /// # Errors
    ///
    /// Those of [`Run::integrate_to`].
    fn integrate_to(run: &mut Run<S>, end: f64) -> Result<Self::Reached<'_>, S::Error> {
        Self::integrate_with(run, end, |_| ())
    }
}

/// The state at the end of a run to a given time: `&S::State` if the steps are [`Equal`], `S::State` if the stepper has its
/// [`Own`](super::Own) pace.
pub type Reached<'a, S> = <<S as Stepper>::Pace as Reach<S>>::Reached<'a>;

impl<S: Stepper> Run<S> {
    /// Integrates to the time `end` and returns the state there.
    ///
    /// Equal steps end at that time, exactly: it takes the smallest number of equal steps that are no longer than the step size, up to
    /// rounding. The sign of the step size does not matter. At the time `end` it takes no step.
    ///
    /// A stepper with its [`Own`](super::Own) pace takes steps until `end` is reached or passed. If `end` is inside the last step, a shorter
    /// step from its start gives the state there. The present state is that after the last step, so the step sizes do not depend on `end`.
    /// If `end` is already inside the last step, no step is taken.
    ///
    /// # Errors
    ///
    /// [`Error::EndTime`](crate::Error::EndTime), [`Error::StepCount`](crate::Error::StepCount), and those of [`step`](Self::step); the state is then that after the
    /// last successful step. If the stepper has its own pace: [`Error::OutputTime`](crate::Error::OutputTime) if `end` is not finite, or before the start of the last
    /// step in the direction of the run.
    pub fn integrate_to(&mut self, end: f64) -> Result<Reached<'_, S>, S::Error>
    where
        S::Pace: Reach<S>,
    {
        S::Pace::integrate_to(self, end)
    }

    /// [`integrate_to`](Self::integrate_to) that calls `observe` with the state after every step.
    ///
    /// # Errors
    ///
    /// As for [`integrate_to`](Self::integrate_to).
    ///
    /// ```
    /// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, separable};
    /// # fn main() -> Result<(), Error> {
    /// let oscillator = separable::<Vector1<f64>, _, _>(|_, p, velocity| *velocity = *p, |_, q, force| *force = -q);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::new(StoermerVerlet, oscillator, start, 0.1)?;
    /// let mut times = Vec::new();
    /// integrator.integrate_with(0.5, |state| times.push(state.time))?;
    /// assert_eq!(times, [0.1, 0.2, 0.1 * 3.0, 0.4, 0.5]);
    /// # Ok(())
    /// # }
    /// ```
    pub fn integrate_with<F: FnMut(&S::State)>(
        &mut self,
        end: f64,
        observe: F,
    ) -> Result<Reached<'_, S>, S::Error>
    where
        S::Pace: Reach<S>,
    {
        S::Pace::integrate_with(self, end, observe)
    }
}

impl<S: Stepper<Pace = Self>> Reach<S> for Equal {
    type Reached<'a>
        = &'a S::State
    where
        S: 'a;

    fn integrate_to(run: &mut Run<S>, end: f64) -> Result<&S::State, S::Error> {
        let mut remaining = run.steps_to_time(end)?;
        let outcome = run.take_remaining(&mut remaining);
        run.restart_clock();
        outcome.map(|()| run.stepper.state())
    }

    fn integrate_with(
        run: &mut Run<S>,
        end: f64,
        mut observe: impl FnMut(&S::State),
    ) -> Result<&S::State, S::Error> {
        let ControlFlow::Continue(()) = run.steps_to(end, |run, size, time| {
            run.advance(size, time)?;
            observe(run.state());
            Ok(ControlFlow::<Infallible>::Continue(()))
        })?;
        Ok(run.stepper.state())
    }
}
