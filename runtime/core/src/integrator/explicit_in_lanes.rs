//! Trajectories side by side: one integrator over lanes in place of one integrator per trajectory.
//!
//! Every lane of a step of a [lanewise](Plan::LANEWISE) plan has the bits of a step of doubles. A run can therefore switch between
//! integrators of doubles and one over lanes at any step.

use alloc::vec::Vec;
use core::marker::PhantomData;

use num_traits::Zero;

use super::memory::StepMemory;
use super::partitioned::MemoryOf;
use super::partitioned::memory_of;
use super::{Integrator, Partitioned, PlanOf, Run};
use crate::integrator::clock::{Clock, RemainingSteps};
use crate::integrator::{Retry, Statistics};
use crate::method::{Method, Plan, Solver, StageStorage, WarmStart};
use crate::number::registers::Work;
use crate::number::{Lanes, Scalar, Summation, Vector};
use crate::state::State;
use crate::system::System;

/// The state of a run at an earlier step, and the data that steps left behind there.
pub struct SavedRun<V, T> {
    step_memory: StepMemory<V, T>,
    clock: Clock,
}

/// The saved run of an integrator.
pub(crate) type SavedRunOf<M, S, V, N> = SavedRun<V, MemoryOf<M, S, V, N>>;

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// Whether every lane of a step over lanes has the bits of a step of doubles.
    #[doc(hidden)]
    pub const LANEWISE: bool = <PlanOf<M, S, V> as Plan>::LANEWISE;

    /// Whether steps of several runs are taken in [`CoupledLanes`](crate::integrator::CoupledLanes).
    #[doc(hidden)]
    pub fn goes_in_lanes() -> bool {
        <PlanOf<M, S, V> as Plan>::goes_in_lanes::<V, S, N>()
    }

    /// A copy of the run to [return](Self::return_to) to.
    #[doc(hidden)]
    pub fn saved(&self) -> SavedRunOf<M, S, V, N> {
        SavedRun {
            step_memory: self.stepper.step_memory.clone(),
            clock: self.clock,
        }
    }

    /// Returns to a [saved](Self::saved) run.
    #[doc(hidden)]
    pub fn return_to(&mut self, saved: SavedRunOf<M, S, V, N>) {
        (self.stepper.step_memory, self.clock) = (saved.step_memory, saved.clock);
    }

    /// An integrator for runs like this one, with the system of their lanes, in vectors like `zeros`; every lane still has to be
    /// [begun](Self::begin_together).
    #[doc(hidden)]
    pub fn over_lanes<W: Vector<Scalar: Lanes>, J: System<W>>(
        &self,
        system: J,
        zeros: &W,
    ) -> Integrator<M, J, W, R, <J as System<W>>::Solver> {
        let blank = State::new(
            self.stepper.step_memory.state.time,
            zeros.clone(),
            zeros.clone(),
        );
        let method = self.stepper.method.clone();
        let memory = memory_of::<M, J, W, J::Solver>(&method, zeros);
        Run {
            stepper: Partitioned {
                system,
                step_memory: StepMemory::new(memory, false, blank),
                stopping: self.stepper.stopping,
                method,
                kind: PhantomData,
            },
            clock: self.clock,
            step_size: self.step_size,
            // A step that fails is repeated by the trajectory that it belongs to.
            retry: Retry::Never,
            last_event: self.last_event,
        }
    }
}

impl<M: Method, J: System<W>, W: Vector<Scalar: Lanes>, R: Summation, N: Solver<W, J>>
    Integrator<M, J, W, R, N>
{
    /// [`take_block`](Self::take_block) for runs side by side; returns `false` if one of them fails or is not finite. The warm starts of
    /// the other runs are then lost, and all have to [return](Self::return_to) to the start of the block.
    #[doc(hidden)]
    pub fn take_block_together(&mut self, block: u64, remaining: &mut RemainingSteps) -> bool {
        let ready = self.stepper.step_memory.kept.evaluation && remaining.left > 1;
        if ready {
            let (run, remaining) = (&mut *self, &mut *remaining);
            if W::Scalar::in_registers(InPlace {
                run,
                block,
                remaining,
            }) {
                return true;
            }
        }
        if ready && !self.stepper.step_memory.kept.evaluation {
            return false;
        }
        for _ in 0..block {
            if !self.advance_together(remaining.size, remaining.next_time()) {
                return false;
            }
            remaining.tick();
        }
        true
    }

    /// [`advance`](Self::advance) for runs side by side.
    fn advance_together(&mut self, size: f64, time: f64) -> bool {
        time != self.stepper.step_memory.state.time
            && W::Scalar::in_registers(OneStep {
                run: self,
                size,
                time,
            })
    }

    /// [`step`](Self::step) for runs side by side; returns `false` if one of them fails or is not finite.
    #[doc(hidden)]
    pub fn step_together(&mut self) -> bool {
        let succeeds = self.advance_together(self.step_size, self.clock.next());
        if succeeds {
            self.clock.tick();
        }
        succeeds
    }

    /// Sets the system, with the parameters of the run in each lane.
    #[doc(hidden)]
    pub fn set_system(&mut self, system: J) {
        self.stepper.system = system;
    }

    /// Begins runs at other states of the same time: each lane at the state that `start` returns for it.
    #[doc(hidden)]
    pub fn begin_together<'s, V: Vector + 's>(&mut self, start: impl Fn(usize) -> &'s State<V>) {
        let StepMemory {
            state,
            low,
            kept,
            last_size,
            last_time,
            statistics,
            ..
        } = &mut self.stepper.step_memory;
        state.time = start(0).time;
        fill(&mut state.q, |lane| start(lane).q.as_slice());
        fill(&mut state.p, |lane| start(lane).p.as_slice());
        for low in [&mut low.0, &mut low.1] {
            low.as_mut_slice().fill(W::Scalar::zero());
        }
        // Without these nothing else is read that an earlier run has left.
        (*kept, *last_size) = (WarmStart::default(), 0.0);
        (*last_time, *statistics) = (state.time, Statistics::default());
        self.clock = Clock::new(state.time, self.step_size);
    }

    /// Velocity and force in all lanes.
    #[doc(hidden)]
    pub fn evaluations_together(&self) -> [W; 2] {
        evaluations(&self.stepper.system, &self.stepper.step_memory.state)
    }

    /// Writes the state of each lane, from the first on, to the `state` of an item.
    #[doc(hidden)]
    pub fn write_lanes<V: Vector, T>(
        &self,
        items: &mut [T],
        state: impl Fn(&mut T) -> &mut State<V>,
    ) {
        let own = &self.stepper.step_memory.state;
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

    /// Copies a run into each lane. The runs have to be at the same step.
    #[doc(hidden)]
    pub fn set_lanes<'r, S, V, O>(&mut self, run: impl Fn(usize) -> &'r Integrator<M, S, V, R, O>)
    where
        S: System<V> + 'r,
        V: Vector + 'r,
        O: Solver<V, S> + 'r,
    {
        let width = <W::Scalar as Lanes>::WIDTH;
        let words = |lane| words_of(&run(lane).stepper.step_memory);
        let words: Vec<Vec<u64>> = (0..width).map(words).collect();
        let mut number = 0;
        self.stepper.step_memory.scalar_words(&mut |word| {
            *word = words[number % width][number / width];
            number += 1;
        });
        self.stepper
            .step_memory
            .same_place(&run(0).stepper.step_memory);
        self.clock = run(0).clock;
    }

    /// The words of all lanes, for [`get_lane`](Self::get_lane).
    #[doc(hidden)]
    pub fn words(&self) -> Vec<u64> {
        words_of(&self.stepper.step_memory)
    }

    /// Copies a lane into a run, from the [words](Self::words) of all lanes.
    #[doc(hidden)]
    pub fn get_lane<S: System<V>, V: Vector, O: Solver<V, S>>(
        &self,
        words: &[u64],
        lane: usize,
        run: &mut Integrator<M, S, V, R, O>,
    ) {
        let mut number = lane;
        run.stepper.step_memory.scalar_words(&mut |word| {
            *word = words[number];
            number += <W::Scalar as Lanes>::WIDTH;
        });
        run.stepper
            .step_memory
            .same_place(&self.stepper.step_memory);
        run.clock = self.clock;
    }
}

/// The velocity and the force of a system at a state.
pub fn evaluations<V: Vector, S: System<V>>(system: &S, state: &State<V>) -> [V; 2] {
    V::Scalar::in_registers(Evaluate { system, state })
}

/// Whether velocity and force have the same bits in a lane and as doubles.
pub fn is_same<W, V>(in_lanes: &[W; 2], lane: usize, alone: &[V; 2]) -> bool
where
    W: Vector<Scalar: Lanes>,
    V: Vector,
{
    in_lanes.iter().zip(alone).all(|(in_lanes, alone)| {
        let (in_lanes, alone) = (in_lanes.as_slice(), V::Scalar::doubles(alone.as_slice()));
        let alone = alone.unwrap_or(&[]);
        let mut pairs = in_lanes.iter().zip(alone);
        in_lanes.len() == alone.len()
            && pairs.all(|(in_lanes, alone)| in_lanes.get(lane).to_bits() == alone.to_bits())
    })
}

/// Sets every lane of a vector to the doubles of another one.
pub(super) fn fill<'v, W: Vector<Scalar: Lanes>, T: Scalar>(
    vector: &mut W,
    lane: impl Fn(usize) -> &'v [T],
) {
    for (number, component) in vector.as_mut_slice().iter_mut().enumerate() {
        *component = Lanes::from_fn(|place| {
            let doubles = T::doubles(lane(place)).unwrap_or(&[]);
            doubles.get(number).copied().unwrap_or_default()
        });
    }
}

/// Steps in place.
struct InPlace<'a, T> {
    run: &'a mut T,
    block: u64,
    remaining: &'a mut RemainingSteps,
}

impl<M, S, V, R, N> Work for InPlace<'_, Integrator<M, S, V, R, N>>
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
        self.run
            .stepper
            .advance_in_place(self.block, self.remaining)
    }
}

/// A step.
struct OneStep<'a, T> {
    run: &'a mut T,
    size: f64,
    time: f64,
}

impl<M, S, V, R, N> Work for OneStep<'_, Integrator<M, S, V, R, N>>
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
        let Partitioned {
            system,
            step_memory,
            stopping,
            ..
        } = &mut self.run.stepper;
        let attempt = step_memory.attempt::<PlanOf<M, S, V>, R, S, N>(system, self.size, *stopping);
        match attempt {
            Ok(work) => step_memory.accept::<R>(self.size, self.time, work),
            Err(_) => step_memory.forget(),
        }
        attempt.is_ok()
    }
}

/// The words of all scalars of a run.
fn words_of<V: Vector, T: StageStorage<V>>(step_memory: &StepMemory<V, T>) -> Vec<u64> {
    let mut words = Vec::new();
    step_memory.show_scalars(&mut |word| words.push(*word));
    words
}

/// Velocity and force at a state.
struct Evaluate<'a, S, V> {
    system: &'a S,
    state: &'a State<V>,
}

impl<V: Vector, S: System<V>> Work for Evaluate<'_, S, V> {
    type Output = [V; 2];

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> [V; 2] {
        let State { time, q, p } = self.state;
        let time = V::Scalar::from_f64(*time);
        let mut found = [q.zeros_like(), q.zeros_like()];
        let [velocity, force] = &mut found;
        self.system.velocity(time, q, p, velocity);
        self.system.force(time, q, p, force);
        found
    }
}
