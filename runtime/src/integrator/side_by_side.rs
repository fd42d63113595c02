//! Trajectories side by side: one integrator over lanes in place of one integrator per trajectory.
//!
//! Every lane of a step of a [lanewise](Plan::LANEWISE) plan has the bits of a step of doubles. A run can therefore switch between
//! integrators of doubles and one over lanes at any step.

use alloc::vec::Vec;
use core::marker::PhantomData;

use super::{Integrator, MemoryOf, PlanOf, StepMemory};
use crate::integrator::Retry;
use crate::integrator::clock::{Clock, RemainingSteps};
use crate::method::{Method, Plan, Solver, StageStorage};
use crate::number::{Lanes, Scalar, Summation, Vector, vector_words};
use crate::state::State;
use crate::system::System;

/// The state of a run at an earlier step, and the data that steps left behind there.
pub(crate) struct SavedRun<V, T> {
    step_memory: StepMemory<V, T>,
    clock: Clock,
}

/// The saved run of an integrator.
pub(crate) type SavedRunOf<M, S, V, N> = SavedRun<V, MemoryOf<M, S, V, N>>;

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// Whether every lane of a step over lanes has the bits of a step of doubles.
    pub(crate) const LANEWISE: bool = <PlanOf<M, S, V> as Plan>::LANEWISE;

    /// Whether steps of several runs are taken in [`CoupledLanes`](crate::integrator::CoupledLanes).
    pub(crate) fn goes_in_lanes() -> bool {
        <PlanOf<M, S, V> as Plan>::goes_in_lanes::<V, S, N>()
    }

    /// The times of the steps.
    pub(crate) const fn clock(&self) -> Clock {
        self.clock
    }

    /// [`take_block`](Self::take_block) for runs side by side; returns `false` if one of them fails or is not finite. The warm starts of the
    /// other runs are then lost, and all have to [return](Self::return_to) to the start of the block.
    pub(crate) fn take_block_together(
        &mut self,
        block: u64,
        remaining: &mut RemainingSteps,
    ) -> bool {
        let ready = self.step_memory.kept.evaluation && remaining.left > 1;
        if ready && self.advance_in_place(block, remaining) {
            return true;
        }
        let is_lost = ready && !self.step_memory.kept.evaluation;
        !is_lost && self.take_block(block, remaining).is_ok()
    }

    /// A copy of the run to [return](Self::return_to) to.
    pub(crate) fn saved(&self) -> SavedRunOf<M, S, V, N> {
        SavedRun {
            step_memory: self.step_memory.clone(),
            clock: self.clock,
        }
    }

    /// Returns to a [saved](Self::saved) run.
    pub(crate) fn return_to(&mut self, saved: SavedRunOf<M, S, V, N>) {
        (self.step_memory, self.clock) = (saved.step_memory, saved.clock);
    }

    /// An integrator for runs like this one, with the system of their lanes, in vectors like `zeros`; every lane still has to be
    /// [set](Self::set_lane).
    pub(crate) fn over_lanes<W: Vector<Scalar: Lanes>, J: System<W>>(
        &self,
        system: J,
        zeros: &W,
    ) -> Integrator<M, J, W, R, <J as System<W>>::Solver> {
        let blank = State::new(self.step_memory.state.time, zeros.clone(), zeros.clone());
        let mut lanes = Integrator {
            system,
            step_memory: StepMemory::new(false, blank),
            clock: self.clock,
            step_size: self.step_size,
            stopping: self.stopping,
            // A step that fails is repeated by the trajectory that it belongs to.
            retry: Retry::Never,
            last_event: self.last_event,
            method: PhantomData,
        };
        if let Some(tableau) = self.step_memory.memory.tableau() {
            lanes.set_tableau(tableau);
        }
        lanes
    }
}

impl<M: Method, J: System<W>, W: Vector<Scalar: Lanes>, R: Summation, N: Solver<W, J>>
    Integrator<M, J, W, R, N>
{
    /// Sets the system, with the parameters of the run in each lane.
    pub(crate) fn set_system(&mut self, system: J) {
        self.system = system;
    }

    /// Copies a run into a lane. The run has to be at the same step as the runs in the other lanes.
    pub(crate) fn set_lane<S: System<V>, V: Vector, O: Solver<V, S>>(
        &mut self,
        lane: usize,
        run: &Integrator<M, S, V, R, O>,
    ) {
        let words = words_of(&mut run.step_memory.clone());
        let mut number = 0;
        self.step_memory.scalar_words(&mut |word| {
            if number % <W::Scalar as Lanes>::WIDTH == lane {
                *word = words[number / <W::Scalar as Lanes>::WIDTH];
            }
            number += 1;
        });
        self.step_memory.same_place(&run.step_memory);
        self.clock = run.clock;
    }

    /// Copies a lane into a run.
    pub(crate) fn get_lane<S: System<V>, V: Vector, O: Solver<V, S>>(
        &self,
        lane: usize,
        run: &mut Integrator<M, S, V, R, O>,
    ) {
        let words = words_of(&mut self.step_memory.clone());
        let mut number = lane;
        run.step_memory.scalar_words(&mut |word| {
            *word = words[number];
            number += <W::Scalar as Lanes>::WIDTH;
        });
        run.step_memory.same_place(&self.step_memory);
        run.clock = self.clock;
    }

    /// Whether the system gives a lane the same bits as the run of doubles.
    pub(crate) fn evaluates_like<S: System<V>, V: Vector, O: Solver<V, S>>(
        &self,
        lane: usize,
        run: &Integrator<M, S, V, R, O>,
    ) -> bool {
        let lanes = evaluations(&self.system, &self.step_memory.state);
        let alone = evaluations(&run.system, &run.step_memory.state);
        let in_lane = lanes.iter().skip(lane).step_by(<W::Scalar as Lanes>::WIDTH);
        in_lane.eq(&alone)
    }
}

/// The words of all scalars of a run.
fn words_of<V: Vector, T: StageStorage<V>>(step_memory: &mut StepMemory<V, T>) -> Vec<u64> {
    let mut words = Vec::new();
    step_memory.scalar_words(&mut |word| words.push(*word));
    words
}

/// The words of velocity and force at a state.
pub(crate) fn evaluations<V: Vector, S: System<V>>(
    system: &S,
    State { time, q, p }: &State<V>,
) -> Vec<u64> {
    let time = V::Scalar::from_f64(*time);
    let mut found = [q.zeros_like(), q.zeros_like()];
    let [velocity, force] = &mut found;
    system.velocity(time, q, p, velocity);
    system.force(time, q, p, force);
    let mut words = Vec::new();
    vector_words(&mut found, &mut |word| words.push(*word));
    words
}
