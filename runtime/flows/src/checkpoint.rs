//! Checkpoints of runs of a flow; a restored run has the same bits.

use super::integrator::{FlowIntegrator, FlowSteps, RunState};
use super::memory::Memory;
use super::{Flow, Span};

use symplectic_core::inside::{Clock, LastEvent, Parts, Save, hash, parts_of, words};
use symplectic_core::solver::{Visit, Words, vector_words};
use symplectic_core::{Checkpoint, CheckpointError, Run, State, Vector};

impl<V: Vector<Scalar = f64>, F: Flow<V>> Save for FlowSteps<V, F> {
    fn checkpoint(run: &mut Run<Self>) -> Result<Checkpoint, CheckpointError> {
        let mut saved = Saved::of(run);
        let Parts {
            stepper, step_size, ..
        } = parts_of(run);
        let mut memory = stepper.present_memory();
        let mut tried = stepper.tried_step(*step_size);
        let blank = Checkpoint::of_flow(saved.run_state.state.q.dimension(), memory.len());
        Ok(blank.filled(|visit| {
            words!(visit: saved, memory, tried);
        }))
    }

    fn restore(run: &mut Run<Self>, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
        let mut saved = Saved::of(run);
        let Parts {
            stepper,
            clock,
            step_size,
            last_event,
            ..
        } = parts_of(run);
        let mut memory = stepper.present_memory();
        let own = Checkpoint::of_flow(saved.run_state.state.q.dimension(), memory.len());
        let mut tried = 0_u64;
        checkpoint.read(&own, |visit| {
            words!(visit: saved, memory, tried);
        })?;
        let present = stepper.present_memory();
        core::mem::swap(&mut stepper.run_state, &mut saved.run_state);
        memory.put_back(&mut stepper.flow);
        if stepper.tried_step(saved.step_size) != tried {
            stepper.run_state = saved.run_state;
            present.put_back(&mut stepper.flow);
            return Err(CheckpointError::OtherSystem);
        }
        (*step_size, *clock) = (saved.step_size, saved.clock);
        *last_event = saved.last_event;
        Ok(())
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

impl<V: Clone> Saved<V> {
    fn of<F>(run: &mut FlowIntegrator<V, F>) -> Self {
        let parts = parts_of(run);
        Self {
            step_size: *parts.step_size,
            clock: *parts.clock,
            last_event: *parts.last_event,
            run_state: parts.stepper.run_state.clone(),
        }
    }
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
