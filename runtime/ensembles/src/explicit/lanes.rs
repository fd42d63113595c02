//! Trajectories side by side: one integrator over lanes in place of one integrator per trajectory.
//!
//! Every lane of a step of a [lanewise](symplectic_core::inside::Plan::LANEWISE) plan has the bits of a step of doubles. A run can
//! therefore switch between integrators of doubles and one over lanes at any step.

use alloc::vec::Vec;

use crate::in_lanes::{evaluations, fill};
use symplectic_core::inside::{
    Clock, MemoryOf, Output, PlanOf, StepMemory, StepParts, Work, parts_of, step_parts_of,
};
use symplectic_core::num_traits::Zero;
use symplectic_core::simd::Lanes;
use symplectic_core::solver::{Solver, Stopping, WarmStart};
use symplectic_core::stepper::{DenseSteps, Partitioned, RemainingSteps, Stepper};
use symplectic_core::{
    Error, Integrator, Method, Scalar, State, Statistics, Summation, System, Vector,
};

/// The integrator whose lanes hold the trajectories.
pub(super) struct InLanes<M, J, W, R>
where
    M: Method,
    J: System<W>,
    W: Vector,
    R: Summation,
{
    pub(super) run: Integrator<M, J, W, R, <J as System<W>>::Solver>,
}

/// Its stepper.
type StepperInLanes<M, J, W, R> = Partitioned<M, J, W, R, <J as System<W>>::Solver>;

/// Output of such an integrator.
pub(super) type OutputInLanes<M, J, W, R> = Output<StepperInLanes<M, J, W, R>>;

/// The state of a run at an earlier step, and the data that steps left behind there.
pub(super) struct Saved<M: Method, J: System<W>, W: Vector> {
    step_memory: StepMemory<W, MemoryOf<M, J, W, <J as System<W>>::Solver>>,
    clock: Clock,
}

impl<M, J, W, R> InLanes<M, J, W, R>
where
    M: Method,
    J: System<W>,
    W: Vector<Scalar: Lanes>,
    R: Summation,
{
    /// An integrator of the system of the lanes, in vectors like `zeros`; every lane still has to be [begun](Self::begin).
    pub(super) fn new(method: M, system: J, zeros: &W, step_size: f64, stopping: Stopping) -> Self {
        let blank = State::new(0.0, zeros.clone(), zeros.clone());
        // Its steps are never split: one that fails is repeated by the trajectory that it belongs to.
        let mut run = Integrator::unchecked(method, system, blank, step_size);
        *step_parts_of(run.stepper_mut()).stopping = stopping;
        Self { run }
    }

    /// Begins runs at other states of the same time: each lane at the state that `start` returns for it.
    pub(super) fn begin<'s, V: Vector + 's>(&mut self, start: impl Fn(usize) -> &'s State<V>) {
        let StepMemory {
            state,
            low,
            kept,
            last_size,
            last_time,
            statistics,
            ..
        } = step_parts_of(self.run.stepper_mut()).step_memory;
        state.time = start(0).time;
        fill(&mut state.q, |lane| start(lane).q.as_slice());
        fill(&mut state.p, |lane| start(lane).p.as_slice());
        for low in [&mut low.0, &mut low.1] {
            low.as_mut_slice().fill(W::Scalar::zero());
        }
        // Without these nothing else is read that an earlier run has left.
        (*kept, *last_size) = (WarmStart::default(), 0.0);
        (*last_time, *statistics) = (state.time, Statistics::default());
        let parts = parts_of(&mut self.run);
        *parts.clock = Clock::new(start(0).time, *parts.step_size);
    }

    /// Sets the system, with the parameters of the run in each lane.
    pub(super) fn set_system(&mut self, system: J) {
        *step_parts_of(self.run.stepper_mut()).system = system;
    }

    /// Velocity and force in all lanes.
    pub(super) fn evaluations(&self) -> [W; 2] {
        evaluations(self.run.system(), self.run.state())
    }

    /// Takes a block of the remaining steps; returns `false` if one of the runs fails or is not finite. The warm starts of the other runs
    /// are then lost, and all have to [return](Self::return_to) to the start of the block.
    pub(super) fn take_block(&mut self, block: u64, remaining: &mut RemainingSteps) -> bool {
        if self.keeps_evaluation() && remaining.left() > 1 {
            let in_place = InPlace {
                stepper: self.run.stepper_mut(),
                block,
                remaining: &mut *remaining,
            };
            if W::Scalar::in_registers(in_place) {
                return true;
            }
            if !self.keeps_evaluation() {
                return false;
            }
        }
        for _ in 0..block {
            let Some((size, time)) = remaining.next() else {
                break;
            };
            if !self.advance(size, time) {
                return false;
            }
            remaining.tick();
        }
        true
    }

    /// Whether the next step can begin with an evaluation of the last one.
    fn keeps_evaluation(&mut self) -> bool {
        step_parts_of(self.run.stepper_mut())
            .step_memory
            .kept
            .evaluation
    }

    /// Takes a step; returns `false` if one of the runs fails or is not finite.
    pub(super) fn step(&mut self) -> bool {
        let (size, time) = (self.run.step_size(), parts_of(&mut self.run).clock.next());
        let succeeds = self.advance(size, time);
        if succeeds {
            parts_of(&mut self.run).clock.tick();
        }
        succeeds
    }

    fn advance(&mut self, size: f64, time: f64) -> bool {
        let stepper = self.run.stepper_mut();
        time != stepper.state().time
            && W::Scalar::in_registers(OneStep {
                stepper,
                size,
                time,
            })
    }

    /// Sets the state of `output` to that at a time inside the last step.
    pub(super) fn look_at(
        &mut self,
        time: f64,
        output: &mut OutputInLanes<M, J, W, R>,
    ) -> Result<(), Error> {
        let stepper = self.run.stepper_mut();
        W::Scalar::in_registers(Look {
            output,
            stepper,
            time,
        })
    }

    /// A copy of the run to [return](Self::return_to) to.
    pub(super) fn saved(&mut self) -> Saved<M, J, W> {
        Saved {
            step_memory: step_parts_of(self.run.stepper_mut()).step_memory.clone(),
            clock: *parts_of(&mut self.run).clock,
        }
    }

    /// Returns to a [saved](Self::saved) run.
    pub(super) fn return_to(&mut self, saved: Saved<M, J, W>) {
        *step_parts_of(self.run.stepper_mut()).step_memory = saved.step_memory;
        *parts_of(&mut self.run).clock = saved.clock;
    }

    /// Writes the state of each lane, from the first on, to the `state` of an item.
    pub(super) fn write_states<V: Vector, T>(
        &self,
        items: &mut [T],
        state: impl Fn(&mut T) -> &mut State<V>,
    ) {
        let own = self.run.state();
        for item in &mut *items {
            state(item).time = own.time;
        }
        let mut write = |from: &W, to: fn(&mut State<V>) -> &mut V| {
            for (number, lanes) in from.as_slice().iter().enumerate() {
                let lanes = lanes.to_array();
                for (&double, item) in lanes.as_ref().iter().zip(&mut *items) {
                    to(state(item)).as_mut_slice()[number] = V::Scalar::from_f64(double);
                }
            }
        };
        write(&own.q, |state| &mut state.q);
        write(&own.p, |state| &mut state.p);
    }

    /// Copies the [words](words_of) of a run into each lane, cyclically, and its place from the first run. The runs have to be at the same
    /// step.
    pub(super) fn load<S: System<V>, V: Vector, N: Solver<V, S>>(
        &mut self,
        words: &[Vec<u64>],
        first: &mut Integrator<M, S, V, R, N>,
    ) {
        let width = <W::Scalar as Lanes>::WIDTH;
        let own = step_parts_of(self.run.stepper_mut()).step_memory;
        let mut number = 0;
        own.scalar_words(&mut |word| {
            *word = words[number % width % words.len()][number / width];
            number += 1;
        });
        same_place(own, step_parts_of(first.stepper_mut()).step_memory);
        *parts_of(&mut self.run).clock = *parts_of(first).clock;
    }

    /// Copies a lane into a run, from the [words](words_of) of all lanes.
    pub(super) fn store<S: System<V>, V: Vector, N: Solver<V, S>>(
        &mut self,
        words: &[u64],
        lane: usize,
        run: &mut Integrator<M, S, V, R, N>,
    ) {
        let own = step_parts_of(run.stepper_mut()).step_memory;
        let mut number = lane;
        own.scalar_words(&mut |word| {
            *word = words[number];
            number += <W::Scalar as Lanes>::WIDTH;
        });
        same_place(own, step_parts_of(self.run.stepper_mut()).step_memory);
        *parts_of(run).clock = *parts_of(&mut self.run).clock;
    }
}

/// The words of all scalars of a run.
pub(super) fn words_of<M, S, V, R, N>(run: &mut Integrator<M, S, V, R, N>) -> Vec<u64>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    let mut words = Vec::new();
    let step_memory = step_parts_of(run.stepper_mut()).step_memory;
    step_memory.scalar_words(&mut |word| words.push(*word));
    words
}

/// Copies time, statistics and flags from a run with other vectors, but neither scalars nor [`linear_velocity`](StepMemory::linear_velocity).
fn same_place<V, T, W, U>(own: &mut StepMemory<V, T>, other: &StepMemory<W, U>) {
    own.state.time = other.state.time;
    own.kept = other.kept;
    own.last_size = other.last_size;
    own.last_time = other.last_time;
    own.statistics = other.statistics;
}

/// Steps in place.
struct InPlace<'a, T> {
    stepper: &'a mut T,
    block: u64,
    remaining: &'a mut RemainingSteps,
}

impl<M, S, V, R, N> Work for InPlace<'_, Partitioned<M, S, V, R, N>>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    type Output = bool;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> bool {
        self.stepper.advance_in_place(self.block, self.remaining)
    }
}

/// A step.
struct OneStep<'a, T> {
    stepper: &'a mut T,
    size: f64,
    time: f64,
}

impl<M, S, V, R, N> Work for OneStep<'_, Partitioned<M, S, V, R, N>>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    type Output = bool;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> bool {
        let StepParts {
            system,
            step_memory,
            stopping,
        } = step_parts_of(self.stepper);
        let attempt = step_memory.attempt::<PlanOf<M, S, V>, R, S, N>(system, self.size, *stopping);
        match attempt {
            Ok(work) => step_memory.accept::<R>(self.size, self.time, work),
            Err(_) => step_memory.forget(),
        }
        attempt.is_ok()
    }
}

/// A look at a time inside a step.
struct Look<'a, S: DenseSteps> {
    output: &'a mut Output<S>,
    stepper: &'a mut S,
    time: f64,
}

impl<S: DenseSteps> Work for Look<'_, S> {
    type Output = Result<(), S::Error>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Self::Output {
        self.output.look_at(self.stepper, self.time)
    }
}
