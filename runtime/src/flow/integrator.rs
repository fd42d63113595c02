//! Steps of a flow.

use super::{Flow, FlowError, Span};
use crate::error::{Error, Quantity};
use crate::integrator::pace::{Pace, Stepper};
use crate::integrator::validation::check_state;
use crate::method::storage::is_finite;
use crate::number::{Vector, copy};
use crate::state::State;

/// Takes steps of a [`Flow`] that consists of others: a [`Splitting`](super::Splitting), a [`Palindrome`](super::Palindrome), …
///
/// A step that fails leaves the state as it was. Sums are plain. No step allocates, if the flows do not.
///
/// ```
/// symplectic::tableau! { Verlet { base: velocity-verlet } }
/// use symplectic::flow::{Drift, FlowIntegrator, Kick, Splitting};
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{State, acceleration};
///
/// # fn main() -> Result<(), symplectic::Error> {
/// let spring = || acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0]);
/// let step = Splitting::new(Verlet, Drift::new(spring()), Kick::new(spring()));
/// let mut run = FlowIntegrator::new(step, State::from_arrays(0.0, [1.0], [0.0]), 0.001)?;
/// run.integrate_to(1.0)?;
/// assert_eq!(run.state().time, 1.0);
/// assert!((run.state().q[0] - 1.0_f64.cos()).abs() < 1e-6);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct FlowIntegrator<V, F> {
    flow: F,
    pace: Pace,
    state: State<V>,
    /// Position and momentum before the step.
    before: (V, V),
}

impl<V: Vector<Scalar = f64>, F: Flow<V>> FlowIntegrator<V, F> {
    /// An integrator at `state`, with steps of size `step_size`, negative to go backward.
    ///
    /// # Errors
    ///
    /// [`Error::StepSize`], [`Error::Dimension`], [`Error::NonFiniteState`].
    pub fn new(flow: F, state: State<V>, step_size: f64) -> Result<Self, Error> {
        check_state(state.time, &state.q, &state.p, state.q.dimension())?;
        Ok(Self {
            flow,
            pace: Pace::new(state.time, step_size)?,
            before: (state.q.clone(), state.p.clone()),
            state,
        })
    }

    /// Takes one step and returns the state after it. The time after `k` steps is `start + k h`.
    ///
    /// # Errors
    ///
    /// [`Error::Flow`], [`Error::NonFinite`], [`Error::TimeResolution`]; the state is untouched.
    pub fn step(&mut self) -> Result<&State<V>, Error> {
        self.one_step()?;
        Ok(&self.state)
    }

    /// Goes to the time `end`, exactly, in the smallest number of equal steps that are no longer than the step size; forward or backward.
    ///
    /// # Errors
    ///
    /// [`Error::EndTime`], [`Error::StepCount`], and those of [`step`](Self::step); the state is then that of the last good step.
    pub fn integrate_to(&mut self, end: f64) -> Result<&State<V>, Error> {
        self.steps_to(end)?;
        Ok(&self.state)
    }

    /// The present state.
    pub const fn state(&self) -> &State<V> {
        &self.state
    }

    /// The present state, moved out.
    pub fn into_state(self) -> State<V> {
        self.state
    }

    /// The flow of a step.
    pub const fn flow(&self) -> &F {
        &self.flow
    }

    /// The step size.
    pub const fn step_size(&self) -> f64 {
        self.pace.step_size()
    }

    /// Steps taken.
    pub const fn steps(&self) -> u64 {
        self.pace.taken()
    }

    /// Changes the step size; negative to go backward.
    ///
    /// # Errors
    ///
    /// [`Error::StepSize`]; the one before then holds.
    pub fn set_step_size(&mut self, step_size: f64) -> Result<(), Error> {
        self.pace.set_step_size(self.state.time, step_size)
    }

    /// What is wrong with the result of a step.
    fn check(&self) -> Result<(), FlowError> {
        let State { q, p, .. } = &self.state;
        let expected = self.before.0.dimension();
        super::check_dimension(expected, q)?;
        super::check_dimension(expected, p)?;
        let what = if !is_finite(q) {
            Quantity::Position
        } else if !is_finite(p) {
            Quantity::Momentum
        } else {
            return Ok(());
        };
        Err(FlowError::NonFinite { what })
    }
}

impl<V: Vector<Scalar = f64>, F: Flow<V>> Stepper for FlowIntegrator<V, F> {
    fn pace(&mut self) -> &mut Pace {
        &mut self.pace
    }

    fn time(&self) -> f64 {
        self.state.time
    }

    fn advance(&mut self, size: f64, end: f64, number: u64) -> Result<(), Error> {
        let State { time, q, p } = &mut self.state;
        let (time, step_size) = (*time, size);
        copy(&mut self.before.0, q);
        copy(&mut self.before.1, p);
        let outcome = self.flow.flow(Span { time, size }, q, p);
        if let Err(failure) = outcome.and_then(|()| self.check()) {
            self.state.q.clone_from(&self.before.0);
            self.state.p.clone_from(&self.before.1);
            return Err(match failure {
                FlowError::NonFinite { what } => Error::NonFinite {
                    time,
                    step_size,
                    step: number,
                    what,
                    stage: None,
                },
                failure => Error::Flow {
                    time,
                    step_size,
                    step: number,
                    failure,
                },
            });
        }
        self.state.time = end;
        Ok(())
    }
}
