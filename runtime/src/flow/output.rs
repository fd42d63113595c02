//! Output of a run of a flow between its steps.

use super::Flow;
use super::integrator::FlowIntegrator;
use crate::error::Error;
use crate::integrator::clock::check_count;
use crate::number::Vector;
use crate::output::at_times::check_times;
use crate::output::steps::is_after;
use crate::state::State;

impl<V: Vector<Scalar = f64>, F: Flow<V>> FlowIntegrator<V, F> {
    /// Takes steps until all `times` have been passed, and calls `observe` with the state at each of them in order: see
    /// [`Integrator::integrate_at`](crate::Integrator::integrate_at).
    ///
    /// The steps have the same bits as those of [`step`](Self::step), whatever the times. States inside them are those of
    /// [`state_at`](Self::state_at). The first time may be the present one or lie in the last step.
    ///
    /// # Errors
    ///
    /// [`Error::OutputTime`] for the first time that is not finite, or before its predecessor or the last step, and
    /// [`Error::StepCount`]: no step is taken then. Those of [`step`](Self::step) and of [`state_at`](Self::state_at).
    ///
    /// ```
    /// symplectic::tableau! { ForestRuth { base: forest-ruth-1990 } }
    /// use symplectic::flow::{Drift, FlowIntegrator, Kick, Splitting};
    /// use symplectic::nalgebra::Vector1;
    /// use symplectic::{State, acceleration};
    ///
    /// # fn main() -> Result<(), symplectic::Error> {
    /// let spring = || acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0]);
    /// let step = Splitting::new(ForestRuth, Drift::new(spring()), Kick::new(spring()));
    /// let mut run = FlowIntegrator::new(step, State::from_arrays(0.0, [1.0], [0.0]), 0.125)?;
    /// let mut found = Vec::new();
    /// run.integrate_at(&[0.0, 0.3, 0.31, 1.1], |state| found.push((state.time, state.q[0])))?;
    /// assert!(found.iter().all(|(time, q)| (q - time.cos()).abs() < 1e-4));
    /// assert_eq!((run.state().time, run.steps()), (1.125, 9));
    /// # Ok(())
    /// # }
    /// ```
    pub fn integrate_at<O: FnMut(&State<V>)>(
        &mut self,
        times: &[f64],
        mut observe: O,
    ) -> Result<&State<V>, Error> {
        let direction = self.step_size();
        let end = check_times(direction, times, self.start_of_last_step(), None)?;
        check_count(self.state().time, end, direction)?;
        let mut inside = self.state().clone();
        for &time in times {
            while is_after(direction, time, self.state().time) {
                self.step()?;
            }
            self.stepper.look_at(time, &mut inside)?;
            observe(&inside);
        }
        Ok(self.state())
    }

    /// The state at a time within the last step, by a shorter step of the flow from its start. The error is that of one step, of the order
    /// of the method; at both ends of the step the state is exact to the bit.
    ///
    /// The shorter step has the direction of the step, so it works for flows that cannot go backward. It costs as much as a step. It starts
    /// with the [memory](Flow::memory) of the start of the step, and then restores the present memory. So noise uses the random numbers of
    /// the step. The state has the distribution of a shorter step from the start; it is not a bridge, which would depend on the end too.
    ///
    /// # Errors
    ///
    /// [`Error::NoStep`] before the first step, after a failed step and after [`set_state`](Self::set_state); [`Error::OutsideStep`];
    /// [`Error::Flow`] and [`Error::NonFinite`] if the shorter step fails.
    pub fn state_at(&mut self, time: f64) -> Result<State<V>, Error> {
        let mut state = self.state().clone();
        if self.stepper.run_state.last.is_none() {
            return Err(Error::NoStep);
        }
        self.stepper.look_at(time, &mut state)?;
        Ok(state)
    }

    /// The start of the last step; the present time if there is no last step or it had the other direction.
    fn start_of_last_step(&self) -> f64 {
        let present = self.state().time;
        match self.stepper.run_state.last {
            Some(last) if is_after(self.step_size(), present, last.start) => last.start,
            _ => present,
        }
    }
}
