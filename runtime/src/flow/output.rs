//! What is seen of a run of a flow between its steps.

use super::Flow;
use super::integrator::FlowIntegrator;
use crate::error::Error;
use crate::integrator::clock::check_count;
use crate::number::Vector;
use crate::output::at_times::check_times;
use crate::output::steps::is_after;
use crate::state::State;

impl<V: Vector<Scalar = f64>, F: Flow<V>> FlowIntegrator<V, F> {
    /// Takes steps until all `times` are behind, and shows `observe` the state at each of them, in their order: see
    /// [`Integrator::integrate_at`](crate::Integrator::integrate_at).
    ///
    /// The steps are those of [`step`](Self::step), with the same bits, whatever the times. States inside them are those of
    /// [`state_at`](Self::state_at). The first time may be the present one or lie in the last step.
    ///
    /// # Errors
    ///
    /// [`Error::OutputTime`] for the first time that is not finite, is before the one before it or before the last step, and
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
            self.look_at(time, &mut inside)?;
            observe(&inside);
        }
        Ok(self.state())
    }

    /// The state at a time of the last step, by a shorter step of the flow from its start. The error is that of one step, of the order of
    /// the method; both ends are those of the step, to the bit.
    ///
    /// The shorter step goes the way of the step, so flows that cannot go backward give it too. It costs as much as a step. It starts
    /// with the [memory](Flow::memory) that the step started with, and then puts the present one back. So noise is that of the random numbers of
    /// the step. The law of the state is that of a shorter step from the start; it is not a bridge, which would depend on the end too.
    ///
    /// # Errors
    ///
    /// [`Error::NoStep`] before the first step, after one that failed and after [`set_state`](Self::set_state); [`Error::OutsideStep`];
    /// [`Error::Flow`] and [`Error::NonFinite`] where the shorter step fails.
    pub fn state_at(&mut self, time: f64) -> Result<State<V>, Error> {
        let mut state = self.state().clone();
        if self.run_state.last.is_none() {
            return Err(Error::NoStep);
        }
        self.look_at(time, &mut state)?;
        Ok(state)
    }

    /// The start of the last step, or the present time where there is none, or where the last step went the other way.
    fn start_of_last_step(&self) -> f64 {
        let present = self.state().time;
        match self.run_state.last {
            Some(last) if is_after(self.step_size(), present, last.start) => last.start,
            _ => present,
        }
    }
}
