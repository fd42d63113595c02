//! Trajectories side by side: one integrator over lanes in place of one integrator per trajectory.
//!
//! Every lane of a step of a [lanewise](Plan::LANEWISE) plan has the bits of a step of doubles. A run can therefore switch between
//! integrators of doubles and one over lanes at any step.

use alloc::vec::Vec;
use core::marker::PhantomData;

use super::{Integrator, MemoryOf, PlanOf, StepMemory};
use crate::error::Error;
use crate::integrator::Retry;
use crate::integrator::clock::{Clock, uniform};
use crate::method::{Method, Plan, Solver, StageStorage};
use crate::number::{Lanes, Scalar, Summation, Vector, vector_words};
use crate::state::State;
use crate::system::System;

/// Remaining steps of one size.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg {
    left: u64,
    size: f64,
    clock: Clock,
    /// The time of the last step, if it is given.
    end: Option<f64>,
}

impl Leg {
    /// Whether all steps are taken.
    pub(crate) const fn is_done(&self) -> bool {
        self.left == 0
    }

    /// The size of the next step and the time after it, if a step is left; the step counts as taken.
    pub(crate) fn next_step(&mut self) -> Option<(f64, f64)> {
        self.left = self.left.checked_sub(1)?;
        let end = self.end.filter(|_| self.left == 0);
        let time = end.unwrap_or_else(|| self.clock.next());
        self.clock.tick();
        Some((self.size, time))
    }
}

/// A saved position of a run.
pub(crate) struct Mark<V, T> {
    course: StepMemory<V, T>,
    clock: Clock,
}

/// The mark of an integrator.
pub(crate) type MarkOf<M, S, V, N> = Mark<V, MemoryOf<M, S, V, N>>;

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// Whether every lane of a step over lanes has the bits of a step of doubles.
    pub(crate) const LANEWISE: bool = <PlanOf<M, S, V> as Plan>::LANEWISE;

    /// The steps of [`take_steps`](Self::take_steps).
    pub(crate) const fn leg_of(&self, count: u64) -> Leg {
        Leg {
            left: count,
            size: self.step_size,
            clock: self.clock,
            end: None,
        }
    }

    /// The steps of [`integrate_to`](Self::integrate_to).
    pub(crate) fn leg_to(&self, end: f64) -> Result<Leg, Error> {
        let start = self.course.state.time;
        let (left, size) = uniform(start, end, self.step_size)?;
        Ok(Leg {
            left,
            size,
            clock: Clock::new(start, size),
            end: Some(end),
        })
    }

    /// Whether steps of several runs are taken in [`CoupledLanes`](crate::integrator::CoupledLanes).
    pub(crate) fn goes_in_lanes() -> bool {
        <PlanOf<M, S, V> as Plan>::goes_in_lanes::<V, S, N>()
    }

    /// The times of the steps.
    pub(crate) const fn clock(&self) -> Clock {
        self.clock
    }

    /// Number of steps of a leg that are taken at once.
    pub(crate) fn block_of(&self, leg: &Leg) -> u64 {
        self.next_block(leg.left)
    }

    /// Takes the next [block](Self::block_of) of a leg, as its integrator would.
    pub(crate) fn take_block(&mut self, block: u64, leg: &mut Leg) -> Result<(), Error> {
        let Leg {
            left,
            size,
            clock,
            end,
        } = leg;
        self.advance_block(block, *left, *size, clock, *end)?;
        *left -= block;
        Ok(())
    }

    /// [`take_block`](Self::take_block) for runs side by side; returns `false` if one of them fails or is not finite. The data that steps
    /// left behind for the others are then lost, and the run has to [go back](Self::go_back).
    pub(crate) fn take_block_together(&mut self, block: u64, leg: &mut Leg) -> bool {
        let ready = self.course.kept.evaluation && leg.left > 1;
        if ready && self.advance_in_place(block, leg.size, &mut leg.clock) {
            leg.left -= block;
            return true;
        }
        let is_lost = ready && !self.course.kept.evaluation;
        !is_lost && self.take_block(block, leg).is_ok()
    }

    /// Takes all steps of a leg.
    pub(crate) fn take_leg(&mut self, leg: &mut Leg) -> Result<(), Error> {
        self.advance_by(leg.left, leg.size, &mut leg.clock, leg.end)?;
        leg.left = 0;
        Ok(())
    }

    /// Saves the position of the run.
    pub(crate) fn mark(&self) -> MarkOf<M, S, V, N> {
        Mark {
            course: self.course.clone(),
            clock: self.clock,
        }
    }

    /// Returns to a saved position.
    pub(crate) fn go_back(&mut self, mark: MarkOf<M, S, V, N>) {
        (self.course, self.clock) = (mark.course, mark.clock);
    }

    /// An integrator for runs like this one, with the system of their lanes, in vectors like `zeros`; every lane still has to be
    /// [set](Self::set_lane).
    pub(crate) fn over_lanes<W, J>(
        &self,
        system: J,
        zeros: &W,
    ) -> Integrator<M, J, W, R, <J as System<W>>::Solver>
    where
        W: Vector<Scalar: Lanes>,
        J: System<W>,
    {
        let blank = State::new(self.course.state.time, zeros.clone(), zeros.clone());
        let mut lanes = Integrator {
            system,
            course: StepMemory::new(false, blank),
            clock: self.clock,
            step_size: self.step_size,
            stopping: self.stopping,
            // A step that fails is repeated by the trajectory that it belongs to.
            retry: Retry::Never,
            last_event: self.last_event,
            method: PhantomData,
        };
        if let Some(tableau) = self.course.memory.tableau() {
            lanes.set_tableau(tableau);
        }
        lanes
    }
}

impl<M, J, W, R, N> Integrator<M, J, W, R, N>
where
    M: Method,
    J: System<W>,
    W: Vector<Scalar: Lanes>,
    R: Summation,
    N: Solver<W, J>,
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
        let words = words_of(&mut run.course.clone());
        let mut number = 0;
        self.course.scalar_words(&mut |word| {
            if number % <W::Scalar as Lanes>::WIDTH == lane {
                *word = words[number / <W::Scalar as Lanes>::WIDTH];
            }
            number += 1;
        });
        self.course.same_place(&run.course);
        self.clock = run.clock;
    }

    /// Copies a lane into a run.
    pub(crate) fn get_lane<S: System<V>, V: Vector, O: Solver<V, S>>(
        &self,
        lane: usize,
        run: &mut Integrator<M, S, V, R, O>,
    ) {
        let words = words_of(&mut self.course.clone());
        let mut number = lane;
        run.course.scalar_words(&mut |word| {
            *word = words[number];
            number += <W::Scalar as Lanes>::WIDTH;
        });
        run.course.same_place(&self.course);
        run.clock = self.clock;
    }

    /// Whether the system gives a lane the same bits as the run of doubles.
    pub(crate) fn evaluates_like<S: System<V>, V: Vector, O: Solver<V, S>>(
        &self,
        lane: usize,
        run: &Integrator<M, S, V, R, O>,
    ) -> bool {
        let lanes = evaluations(&self.system, &self.course.state);
        let alone = evaluations(&run.system, &run.course.state);
        let in_lane = lanes.iter().skip(lane).step_by(<W::Scalar as Lanes>::WIDTH);
        in_lane.eq(&alone)
    }
}

/// The words of all scalars of a run.
fn words_of<V: Vector, T: StageStorage<V>>(course: &mut StepMemory<V, T>) -> Vec<u64> {
    let mut words = Vec::new();
    course.scalar_words(&mut |word| words.push(*word));
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
