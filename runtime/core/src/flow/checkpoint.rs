//! Checkpoints of runs of a flow; a restored run has the same bits.

use super::integrator::{FlowIntegrator, FlowSteps, RunState};
use super::memory::Memory;
use super::{Flow, Span};
use crate::integrator::clock::Clock;
use crate::integrator::fingerprint::hash;
use crate::integrator::last_step::LastEvent;
use crate::integrator::{Checkpoint, CheckpointError};
use crate::number::Vector;
use crate::number::words::{Visit, Words, vector_words, words};
use crate::state::State;

impl<V: Vector<Scalar = f64>, F: Flow<V>> FlowIntegrator<V, F> {
    /// All that the run needs to [continue](crate::flow::FlowIntegrator#method.restore) from here with the same bits: state, step size,
    /// clock, last step, last event, and the [memory](Flow::memory) of the flow. See [`Checkpoint`].
    ///
    /// The flow itself is not stored. It is identified by a hash of a trial step from the present state; the trial changes nothing.
    ///
    /// ```
    /// use symplectic::flow::{Drift, FlowIntegrator, Kick, OrnsteinUhlenbeck, Palindrome};
    /// use symplectic::nalgebra::Vector1;
    /// use symplectic::{State, acceleration};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let run = || {
    ///     let spring = || acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0]);
    ///     let bath = OrnsteinUhlenbeck::new(0.5, 1.0, [1.0], 2024)?;
    ///     let step = Palindrome::new(Kick::new(spring()), Palindrome::new(Drift::new(spring()), bath));
    ///     FlowIntegrator::new(step, State::from_arrays(0.0, [1.0], [0.0]), 0.1)
    /// };
    /// let mut whole = run()?;
    /// whole.take_steps(100)?;
    /// let checkpoint = whole.checkpoint();
    ///
    /// // In another process, say.
    /// let mut resumed = run()?;
    /// resumed.restore(&checkpoint)?;
    /// assert_eq!(resumed.take_steps(100)?, whole.take_steps(100)?);
    /// # Ok(())
    /// # }
    /// ```
    pub fn checkpoint(&mut self) -> Checkpoint {
        let (mut saved, mut memory) = (self.saved(), self.stepper.present_memory());
        let mut tried = self.stepper.tried_step(self.step_size);
        let blank = Checkpoint::of_flow(saved.run_state.state.q.dimension(), memory.len());
        blank.filled(|visit| {
            words!(visit: saved, memory, tried);
        })
    }

    /// Continues from a checkpoint of a run with the same flow. State and step size become those of the checkpoint.
    ///
    /// # Errors
    ///
    /// [`CheckpointError`]; it is [`OtherSystem`](CheckpointError::OtherSystem) if a step of the flow from the stored state gives another
    /// result. The run is then unchanged.
    pub fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
        let (mut saved, mut memory) = (self.saved(), self.stepper.present_memory());
        let own = Checkpoint::of_flow(saved.run_state.state.q.dimension(), memory.len());
        let mut tried = 0_u64;
        checkpoint.read(&own, |visit| {
            words!(visit: saved, memory, tried);
        })?;
        let stepper = &mut self.stepper;
        let present = stepper.present_memory();
        core::mem::swap(&mut stepper.run_state, &mut saved.run_state);
        memory.put_back(&mut stepper.flow);
        if stepper.tried_step(saved.step_size) != tried {
            stepper.run_state = saved.run_state;
            present.put_back(&mut stepper.flow);
            return Err(CheckpointError::OtherSystem);
        }
        (self.step_size, self.clock) = (saved.step_size, saved.clock);
        self.last_event = saved.last_event;
        Ok(())
    }

    fn saved(&self) -> Saved<V> {
        Saved {
            step_size: self.step_size,
            clock: self.clock,
            last_event: self.last_event,
            run_state: self.stepper.run_state.clone(),
        }
    }
}

impl<V: Vector<Scalar = f64>, F: Flow<V>> FlowSteps<V, F> {
    fn present_memory(&mut self) -> Memory {
        let mut memory = Memory::default();
        memory.keep(&mut self.flow);
        memory
    }

    /// A hash of the state after the next step, of this size, also if that step fails.
    fn tried_step(&mut self, size: f64) -> u64 {
        let memory = self.present_memory();
        let State { time, q, p } = &self.run_state.state;
        let span = Span { time: *time, size };
        let (mut q, mut p) = (q.clone(), p.clone());
        // A failed step leaves other bits than a good one.
        let _ = self.flow.flow(span, &mut q, &mut p);
        memory.put_back(&mut self.flow);
        hash(&mut [q, p])
    }
}

/// What changes in a run, apart from the flow.
struct Saved<V> {
    step_size: f64,
    clock: Clock,
    last_event: Option<LastEvent>,
    run_state: RunState<V>,
}

impl<V: Vector<Scalar = f64>> Words for Saved<V> {
    fn words(&mut self, visit: &mut Visit<'_>) {
        let RunState {
            state: State { time, q, p },
            statistics,
            before,
            last,
            memory,
        } = &mut self.run_state;
        words!(visit: *time, self.step_size, self.clock, statistics.steps, *last, *memory, self.last_event);
        for vector in [q, p, &mut before.0, &mut before.1] {
            vector_words(core::slice::from_mut(vector), visit);
        }
    }
}
