//! Trajectories run by one thread, in lanes where possible.

use alloc::vec::Vec;
use core::ops::{ControlFlow, Range};

use super::coupled::Coupled;
use super::registers::{may_be_found, width};
use super::run::Way;
use super::{Ensemble, Row};
use crate::error::Error;
use crate::integrator::Integrator;
use crate::method::{Method, Solver};
use crate::number::registers::Widest;
use crate::number::vector::same;
use crate::number::{Lanes, Scalar, Summation, Vector, WideF64x8, WidestF64x16};
use crate::output::at_times::{self, Output};
use crate::output::steps::is_after;
use crate::state::State;
use crate::system::{Join, LaneWork, System};

/// Number of steps between checks whether the run is stopped.
const BLOCK: u64 = 1 << 16;

/// The task of every trajectory.
pub(super) enum Task<'a> {
    /// Integrate to a time.
    To(f64),
    /// Take a number of steps.
    Steps(u64),
    /// Observe at given times.
    At(&'a [f64]),
}

/// A few trajectories of an ensemble.
pub(super) struct Group<'a, M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>, L, A>
{
    pub(super) ensemble: &'a Ensemble<M, S, V, R, N, L>,
    pub(super) members: Vec<Member<M, S, V, R, N, A>>,
    has_one_system: bool,
}

pub(super) struct Member<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>, A> {
    trajectory: usize,
    pub(super) run: Integrator<M, S, V, R, N>,
    pub(super) output: A,
    pub(super) outcome: Result<(), Error>,
}

/// Outcome of an attempt to run in lanes.
pub(super) enum Attempt {
    /// All trajectories have ended.
    Ended,
    /// The ensemble was stopped.
    Stopped,
    /// Lanes are not possible; nothing was computed.
    Refused,
}

impl<'a, M, S, V, R, N, L, A> Group<'a, M, S, V, R, N, L, A>
where
    M: Method,
    S: System<V> + Clone + Send + Sync,
    V: Vector + Send + Sync,
    R: Summation,
    N: Solver<V, S>,
    L: Lanes,
    A: Send,
{
    /// The trajectories whose starts have the indices `places`.
    pub(super) fn new(
        ensemble: &'a Ensemble<M, S, V, R, N, L>,
        places: Range<usize>,
        output: &impl Fn(usize) -> A,
    ) -> Self {
        let member = |place| {
            let (trajectory, run) = ensemble.integrator(place);
            Member {
                trajectory,
                run,
                output: output(trajectory),
                outcome: Ok(()),
            }
        };
        Self {
            ensemble,
            has_one_system: places.end <= ensemble.family_of(places.start).1,
            members: places.map(member).collect(),
        }
    }

    /// Runs all trajectories; returns `Break` if the ensemble was stopped.
    pub(super) fn run(
        &mut self,
        task: &Task<'_>,
        see: &impl Fn(&mut A, &State<V>),
    ) -> ControlFlow<()> {
        let count = self.members.len();
        // A sweep takes the same time in a few lanes as in all: with fewer than half of them, single runs are as fast.
        let enough = match self.ensemble.way() {
            Way::Alone => false,
            Way::Explicit => count > 1,
            Way::Coupled => 2 * count >= width::<L>(self.ensemble.registers),
        };
        let tried = match enough {
            true => self.run_in_lanes(task, see),
            false => None,
        };
        match tried {
            Some(Attempt::Ended) => ControlFlow::Continue(()),
            Some(Attempt::Stopped) => ControlFlow::Break(()),
            Some(Attempt::Refused) | None => {
                for member in &mut self.members {
                    if self.ensemble.is_stopped() {
                        return ControlFlow::Break(());
                    }
                    member.run_alone(task, see);
                }
                ControlFlow::Continue(())
            }
        }
    }

    /// Runs all trajectories in lanes; `None` if the system is not defined over lanes.
    fn run_in_lanes(
        &mut self,
        task: &Task<'_>,
        see: &impl Fn(&mut A, &State<V>),
    ) -> Option<Attempt> {
        macro_rules! lanes {
            ($lanes:ty) => {
                S::over_lanes::<$lanes, _>(SideBySide {
                    group: self,
                    task,
                    see,
                })
            };
        }
        // Constant conditions: other ensembles compile without this code.
        if const { may_be_found::<V, S>() } {
            match self.ensemble.registers {
                Widest::Build => lanes!(L),
                Widest::Avx2(_) => lanes!(WideF64x8),
                Widest::Avx512(_) => lanes!(WidestF64x16),
            }
        } else {
            lanes!(L)
        }
    }

    /// The system whose lanes have the parameters of the members with these indices; `None` if there is none.
    pub(super) fn system<J>(
        &self,
        join: Join<S, J>,
        places: impl Iterator<Item = usize>,
    ) -> Option<J> {
        join(&mut places.map(|place| self.members[place].run.system()))
    }

    /// The rows of all trajectories.
    pub(super) fn rows(self) -> Vec<Row<V, A>> {
        let row = |member: Member<M, S, V, R, N, A>| Row {
            trajectory: member.trajectory,
            outcome: member.outcome,
            statistics: *member.run.statistics(),
            state: member.run.into_state(),
            output: member.output,
        };
        self.members.into_iter().map(row).collect()
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>, A>
    Member<M, S, V, R, N, A>
{
    fn run_alone(&mut self, task: &Task<'_>, see: &impl Fn(&mut A, &State<V>)) {
        let Self { run, output, .. } = self;
        let outcome = match *task {
            Task::To(end) => run.integrate_to(end),
            Task::Steps(count) => run.take_steps(count),
            Task::At(times) => run.integrate_at(times, |state| see(output, state)),
        };
        self.outcome = outcome.map(|_| ());
    }
}

/// The trajectories of a group, in lanes.
struct SideBySide<
    'g,
    'a,
    't,
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
    L,
    A,
    F,
> {
    group: &'g mut Group<'a, M, S, V, R, N, L, A>,
    task: &'g Task<'t>,
    see: &'g F,
}

/// The integrator whose lanes hold the trajectories.
type InLanes<M, J, W, R> = Integrator<M, J, W, R, <J as System<W>>::Solver>;

impl<M, S, V, R, N, L, K, A, F> LaneWork<V, S, K> for SideBySide<'_, '_, '_, M, S, V, R, N, L, A, F>
where
    M: Method,
    S: System<V> + Clone + Send + Sync,
    V: Vector + Send + Sync,
    R: Summation,
    N: Solver<V, S>,
    L: Lanes,
    K: Lanes,
    A: Send,
    F: Fn(&mut A, &State<V>),
{
    type Output = Attempt;

    fn has_one_system(&self) -> bool {
        self.group.has_one_system
    }

    fn run<W, J>(mut self, join: Join<S, J>) -> Attempt
    where
        W: Vector<Scalar = K>,
        J: System<W, Class = <S as System<V>>::Class>,
    {
        let first = &self.group.members[0].run;
        let like = first.state().q.zeros_with::<K>();
        let Some(zeros) = same::<_, W>(&like) else {
            return Attempt::Refused;
        };
        if self.group.ensemble.way() == Way::Coupled {
            let coupled = Coupled::new(self.group, self.see, join, zeros);
            return coupled.map_or(Attempt::Refused, |coupled| coupled.run(self.task));
        }
        // A constant condition: other methods compile without the code below.
        if !Integrator::<M, S, V, R, N>::LANEWISE {
            return Attempt::Refused;
        }
        let mut live: Vec<usize> = (0..self.group.members.len()).collect();
        let Some(system) = self.group.system(join, cycle::<K>(&live)) else {
            return Attempt::Refused;
        };
        let mut lanes: InLanes<M, J, W, R> = first.over_lanes(system, zeros);
        self.put_in_lanes(&mut lanes, &live);
        let alike = |&place: &usize| lanes.evaluates_like(place, &self.group.members[place].run);
        if !live.iter().all(alike) {
            return Attempt::Refused;
        }
        match *self.task {
            Task::To(_) | Task::Steps(_) => self.take_remaining(&mut lanes, join, &mut live),
            Task::At(times) => self.see_at(times, &mut lanes, &live),
        }
    }
}

impl<M, S, V, R, N, L, A, F> SideBySide<'_, '_, '_, M, S, V, R, N, L, A, F>
where
    M: Method,
    S: System<V> + Clone + Send + Sync,
    V: Vector + Send + Sync,
    R: Summation,
    N: Solver<V, S>,
    L: Lanes,
    A: Send,
    F: Fn(&mut A, &State<V>),
{
    /// Copies the live trajectories into the lanes.
    fn put_in_lanes<W, J>(&self, lanes: &mut InLanes<M, J, W, R>, live: &[usize])
    where
        W: Vector<Scalar: Lanes>,
        J: System<W>,
    {
        for (lane, place) in cycle::<W::Scalar>(live).enumerate() {
            lanes.set_lane(lane, &self.group.members[place].run);
        }
    }

    /// Copies the lanes back to the live trajectories.
    fn take_from_lanes<W, J>(&mut self, lanes: &InLanes<M, J, W, R>, live: &[usize])
    where
        W: Vector<Scalar: Lanes>,
        J: System<W>,
    {
        for (lane, &place) in live.iter().enumerate() {
            lanes.get_lane(lane, &mut self.group.members[place].run);
        }
    }

    /// Takes the remaining steps. If a step fails in a lane, every trajectory repeats the current block of steps alone;
    /// those that succeed continue in lanes.
    fn take_remaining<W, J>(
        &mut self,
        lanes: &mut InLanes<M, J, W, R>,
        join: Join<S, J>,
        live: &mut Vec<usize>,
    ) -> Attempt
    where
        W: Vector<Scalar: Lanes>,
        J: System<W>,
    {
        let remaining = match *self.task {
            Task::To(end) => lanes.steps_to_time(end),
            Task::Steps(count) => Ok(lanes.steps_left(count)),
            Task::At(_) => return Attempt::Refused,
        };
        let Ok(mut remaining) = remaining else {
            return Attempt::Refused;
        };
        while remaining.left > 0 {
            if self.group.ensemble.is_stopped() {
                return Attempt::Stopped;
            }
            let (saved, begun) = (lanes.saved(), remaining);
            let block = lanes.block_of(&remaining);
            if lanes.take_block_together(block, &mut remaining) {
                continue;
            }
            lanes.return_to(saved);
            self.take_from_lanes(lanes, live);
            let mut first = None;
            live.retain(|&place| {
                let member = &mut self.group.members[place];
                let mut own = begun;
                member.outcome = member.run.take_block(block, &mut own);
                let statistics = *member.run.statistics();
                if member.outcome.is_ok() && *first.get_or_insert(statistics) != statistics {
                    // A retry changed its steps, so it no longer runs in lockstep with the others.
                    member.outcome = member.run.take_remaining(&mut own);
                    return false;
                }
                if member.outcome.is_ok() {
                    remaining = own;
                }
                member.outcome.is_ok()
            });
            let Some(system) = self.group.system(join, cycle::<W::Scalar>(live)) else {
                for &place in live.iter() {
                    if self.group.ensemble.is_stopped() {
                        return Attempt::Stopped;
                    }
                    let member = &mut self.group.members[place];
                    member.outcome = member.run.take_remaining(&mut remaining.clone());
                }
                return Attempt::Ended;
            };
            lanes.set_system(system);
            self.put_in_lanes(lanes, live);
        }
        self.take_from_lanes(lanes, live);
        Attempt::Ended
    }

    /// Observes the trajectories at given times. If anything fails in a lane, all trajectories continue alone from the
    /// last observed time.
    fn see_at<W, J>(
        &mut self,
        times: &[f64],
        lanes: &mut InLanes<M, J, W, R>,
        live: &[usize],
    ) -> Attempt
    where
        W: Vector<Scalar: Lanes>,
        J: System<W>,
    {
        if at_times::check(lanes, times).is_err() {
            return Attempt::Refused;
        }
        let present = lanes.state().time;
        let direction = lanes.step_size();
        let seen = times
            .iter()
            .take_while(|&&time| !is_after(direction, time, present));
        let mut rest = &times[seen.count()..];
        for member in &mut self.group.members {
            for _ in rest.len()..times.len() {
                (self.see)(&mut member.output, member.run.state());
            }
        }
        let mut output = Output::new(lanes, direction);
        let mut shown = self.group.members[0].run.state().clone();
        while !rest.is_empty() {
            if self.group.ensemble.is_stopped() {
                return Attempt::Stopped;
            }
            let saved = lanes.saved();
            let Some(seen) = self.see_next(rest, lanes, live, (&mut output, &mut shown)) else {
                lanes.return_to(saved);
                self.take_from_lanes(lanes, live);
                for &place in live {
                    if self.group.ensemble.is_stopped() {
                        return Attempt::Stopped;
                    }
                    self.group.members[place].run_alone(&Task::At(rest), self.see);
                }
                return Attempt::Ended;
            };
            rest = &rest[seen..];
        }
        self.take_from_lanes(lanes, live);
        Attempt::Ended
    }

    /// Steps past the first of the times, observes the states at all times in the last step, and returns their number: zero if the run was
    /// stopped, `None` if a lane failed.
    fn see_next<W, J>(
        &mut self,
        times: &[f64],
        lanes: &mut InLanes<M, J, W, R>,
        live: &[usize],
        (output, shown): (&mut Output<W>, &mut State<V>),
    ) -> Option<usize>
    where
        W: Vector<Scalar: Lanes>,
        J: System<W>,
    {
        let direction = lanes.step_size();
        let mut steps = 0_u64;
        while is_after(direction, times[0], lanes.state().time) {
            if !lanes.step_together() {
                return None;
            }
            output.evaluated = false;
            steps += 1;
            if steps.is_multiple_of(BLOCK) && self.group.ensemble.is_stopped() {
                return Some(0);
            }
        }
        let present = lanes.state();
        let mut count = 0;
        for &time in times {
            if is_after(direction, time, present.time) {
                break;
            }
            let state = match time == present.time {
                // A zero time has the same sign as in a run of one trajectory.
                true => present,
                false => {
                    output.look_together(lanes, time).ok()?;
                    &output.state
                }
            };
            shown.time = state.time;
            for (lane, &place) in live.iter().enumerate() {
                copy_lane(lane, &state.q, &mut shown.q);
                copy_lane(lane, &state.p, &mut shown.p);
                (self.see)(&mut self.group.members[place].output, shown);
            }
            count += 1;
        }
        Some(count)
    }
}

/// A live trajectory for each lane, cyclically, so that no lane is empty.
fn cycle<L: Lanes>(live: &[usize]) -> impl Iterator<Item = usize> {
    live.iter().copied().cycle().take(L::WIDTH)
}

/// Copies the vector of a lane.
fn copy_lane<V: Vector, W: Vector<Scalar: Lanes>>(lane: usize, from: &W, to: &mut V) {
    for (to, from) in to.as_mut_slice().iter_mut().zip(from.as_slice()) {
        *to = V::Scalar::from_f64(from.get(lane));
    }
}
