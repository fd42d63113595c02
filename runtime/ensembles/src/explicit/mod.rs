//! Trajectories in lanes, group after group.
//!
//! With explicit steps one integrator over lanes takes the steps of a group. A trajectory gets its own integrator only if a step fails in a
//! lane of its group.

mod lanes;

use alloc::vec::Vec;
use core::ops::{ControlFlow, Range};

use self::lanes::{InLanes, OutputInLanes, words_of};
use crate::Row;
use crate::coupled::Coupled;
use crate::coupled::lanes::CoupledLanes;
use crate::group::{Attempt, Group, Job, Task};
use crate::in_lanes::copy_lane;
use crate::run::Way;
use symplectic_core::inside::{Output, Plan, PlanOf, is_after, same};
use symplectic_core::simd::Lanes;
use symplectic_core::solver::Solver;
use symplectic_core::system::{Join, LaneWork};
use symplectic_core::{Method, State, Summation, System, Vector};

/// Number of steps between checks whether the run is stopped.
const BLOCK: u64 = 1 << 16;
/// Number of steps that trajectories repeat from their starts, rather than from a saved state, if one of them fails in its lane.
const UNSAVED: u64 = 1 << 8;

/// Runs trajectories in lanes and removes them from `places`, as long as their systems are of the kind of the first group.
pub(super) struct SideBySide<'j, 'a, M, S: System<V>, V: Vector, R, N, L, A, F> {
    pub(super) job: &'j Job<'a, M, S, V, R, N, L, A, F>,
    pub(super) has_one_system: bool,
    pub(super) places: &'j mut Range<usize>,
    pub(super) rows: &'j mut Vec<Row<V, A>>,
}

impl<M, S, V, R, N, L, K, A, F> LaneWork<V, S, K> for SideBySide<'_, '_, M, S, V, R, N, L, A, F>
where
    M: Method,
    S: System<V> + Clone + Send,
    V: Vector + Send + Sync,
    R: Summation,
    N: Solver<V, S>,
    L: Lanes,
    K: Lanes,
    A: Send,
    F: Fn(&mut A, &State<V>),
{
    /// Whether the ensemble was stopped.
    type Output = ControlFlow<()>;

    fn has_one_system(&self) -> bool {
        self.has_one_system
    }

    fn run<W, J>(self, join: Join<S, J>) -> ControlFlow<()>
    where
        W: Vector<Scalar = K>,
        J: System<W, Class = <S as System<V>>::Class>,
    {
        let Self {
            job,
            has_one_system,
            places,
            rows,
        } = self;
        let ensemble = job.ensemble;
        let like = ensemble.starts[places.start].q.zeros_with::<K>();
        let Some(zeros) = same::<_, W>(&like) else {
            return ControlFlow::Continue(());
        };
        let end_of_family = ensemble.family_of(places.start).1;
        let mut lanes: Option<InLanes<M, J, W, R>> = None;
        let mut coupled: Option<CoupledLanes<M, S, V, R, N, W, J>> = None;
        while places.start < places.end {
            let own = job.group_of(places);
            let is_other = has_one_system && places.start >= end_of_family
                || ensemble.has_one_system(&own) != has_one_system;
            if is_other || !job.is_enough(own.len()) {
                break;
            }
            if ensemble.is_stopped() {
                return ControlFlow::Break(());
            }
            places.start = own.end;
            let mut group = Group::new(job, own);
            let joined = match has_one_system && (lanes.is_some() || coupled.is_some()) {
                true => None,
                false => Some(group.joined(join, cycle::<K>(0..group.len()))),
            };
            let attempt = if matches!(joined, Some(None)) {
                Attempt::Refused
            } else if job.way == Way::Coupled {
                let lanes = ready(
                    &mut coupled,
                    joined.flatten(),
                    CoupledLanes::set_system,
                    |system| CoupledLanes::like(&mut group.integrator(0), system, zeros),
                );
                let run = lanes.and_then(|lanes| Coupled::new(&mut group, job.see, lanes));
                run.map_or(Attempt::Refused, |run| run.run(job.task))
            } else if PlanOf::<M, S, V>::LANEWISE {
                // A constant condition: other methods compile without this code.
                let lanes = ready(
                    &mut lanes,
                    joined.flatten(),
                    InLanes::set_system,
                    |system| {
                        let method = ensemble.method.clone();
                        let (size, stopping) = (ensemble.step_size, ensemble.stopping);
                        InLanes::new(method, system, zeros, size, stopping)
                    },
                );
                let run = lanes.map(|lanes| Explicit::new(&mut group, job, lanes, join));
                run.map_or(Attempt::Refused, |run| run.run(rows))
            } else {
                Attempt::Refused
            };
            match attempt {
                Attempt::Ended => group.write(rows),
                Attempt::Stopped => return ControlFlow::Break(()),
                Attempt::Refused => group.run_alone(job, rows)?,
            }
        }
        ControlFlow::Continue(())
    }
}

/// The lanes with this system, or with the one that they have. They are made for the first one.
fn ready<T, J>(
    lanes: &mut Option<T>,
    system: Option<J>,
    set_system: impl FnOnce(&mut T, J),
    make: impl FnOnce(J) -> T,
) -> Option<&mut T> {
    match (&mut *lanes, system) {
        (_, None) => {}
        (Some(lanes), Some(system)) => set_system(lanes, system),
        (None, Some(system)) => *lanes = Some(make(system)),
    }
    lanes.as_mut()
}

/// A group in lanes with explicit steps.
struct Explicit<'g, 'a, M, S, V, R, N, L, A, F, W, J>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
    W: Vector,
    J: System<W>,
{
    group: &'g mut Group<'a, M, S, V, R, N, L, A>,
    job: &'g Job<'a, M, S, V, R, N, L, A, F>,
    lanes: &'g mut InLanes<M, J, W, R>,
    join: Join<S, J>,
    /// The members of the group that are in lanes, in their order.
    live: Vec<usize>,
}

impl<'g, 'a, M, S, V, R, N, L, A, F, W, J> Explicit<'g, 'a, M, S, V, R, N, L, A, F, W, J>
where
    M: Method,
    S: System<V> + Clone + Send,
    V: Vector + Send + Sync,
    R: Summation,
    N: Solver<V, S>,
    L: Lanes,
    A: Send,
    F: Fn(&mut A, &State<V>),
    W: Vector<Scalar: Lanes>,
    J: System<W>,
{
    /// Loads the starts into the lanes.
    fn new(
        group: &'g mut Group<'a, M, S, V, R, N, L, A>,
        job: &'g Job<'a, M, S, V, R, N, L, A, F>,
        lanes: &'g mut InLanes<M, J, W, R>,
        join: Join<S, J>,
    ) -> Self {
        // Unused lanes hold copies: zeros might be a singular point.
        lanes.begin(|lane| group.start(lane % group.len()));
        Self {
            group,
            job,
            lanes,
            join,
            live: Vec::new(),
        }
    }

    /// Runs all trajectories; those that stay in their lanes get their rows.
    fn run(mut self, rows: &mut Vec<Row<V, A>>) -> Attempt {
        if !self.group.evaluates_like(&self.lanes.evaluations()) {
            return Attempt::Refused;
        }
        let attempt = match self.job.task {
            Task::To(_) | Task::Steps(_) => self.take_remaining(),
            Task::At(times) => self.see_at(times),
        };
        if let Attempt::Ended = attempt {
            match self.group.members.is_empty() {
                true => {
                    let first = rows.len();
                    self.group.write_starts(*self.lanes.run.statistics(), rows);
                    self.lanes
                        .write_states(&mut rows[first..], |row| &mut row.state);
                }
                false => self.take_from_lanes(),
            }
        }
        attempt
    }

    /// Copies the live members into the lanes.
    fn put_in_lanes(&mut self) {
        let Some(&first) = self.live.first() else {
            return;
        };
        let members = &mut self.group.members;
        let words = |&place: &usize| words_of(&mut members[place].run);
        let words: Vec<_> = self.live.iter().map(words).collect();
        self.lanes.load(&words, &mut members[first].run);
    }

    /// Copies the lanes back to the live members.
    fn take_from_lanes(&mut self) {
        let words = words_of(&mut self.lanes.run);
        for (lane, &place) in self.live.iter().enumerate() {
            let run = &mut self.group.members[place].run;
            self.lanes.store(&words, lane, run);
        }
    }

    /// Takes the remaining steps. If a step fails in a lane, every trajectory repeats the last steps alone; those that succeed continue in
    /// lanes.
    fn take_remaining(&mut self) -> Attempt {
        let remaining = match self.job.task {
            Task::To(end) => self.lanes.run.steps_to_time(end),
            Task::Steps(count) => Ok(self.lanes.run.steps_left(count)),
            Task::At(_) => return Attempt::Refused,
        };
        let Ok(mut remaining) = remaining else {
            return Attempt::Refused;
        };
        // From where trajectories repeat steps: from `saved`, or else from their starts or the members.
        let (mut saved, mut begun) = (None, remaining);
        while remaining.left() > 0 {
            if self.job.ensemble.is_stopped() {
                return Attempt::Stopped;
            }
            let block = self.lanes.run.stepper().block_of(&remaining);
            let left = remaining.left() - block;
            if begun.left() > remaining.left() && begun.left() - left > UNSAVED {
                (saved, begun) = (Some(self.lanes.saved()), remaining);
            }
            if self.lanes.take_block(block, &mut remaining) {
                continue;
            }
            self.leave_lanes();
            if let Some(saved) = saved.take() {
                self.lanes.return_to(saved);
                self.take_from_lanes();
            }
            let members = &mut self.group.members;
            let mut first = None;
            self.live.retain(|&place| {
                let member = &mut members[place];
                let mut own = begun;
                member.outcome = member.run.take_until(left, &mut own);
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
            let live = cycle::<W::Scalar>(self.live.iter().copied());
            let Some(system) = self.group.joined(self.join, live) else {
                for place in core::mem::take(&mut self.live) {
                    if self.job.ensemble.is_stopped() {
                        return Attempt::Stopped;
                    }
                    let member = &mut self.group.members[place];
                    member.outcome = member.run.take_remaining(&mut remaining.clone());
                }
                return Attempt::Ended;
            };
            self.lanes.set_system(system);
            self.put_in_lanes();
            begun = remaining;
        }
        Attempt::Ended
    }

    /// Makes members of all trajectories unless they are.
    fn leave_lanes(&mut self) {
        if self.group.members.is_empty() {
            self.group.leave_lanes();
            self.live = (0..self.group.len()).collect();
        }
    }

    /// Observes the trajectories at given times. If anything fails in a lane, all trajectories continue alone from the
    /// last observed time.
    fn see_at(&mut self, times: &[f64]) -> Attempt {
        if self.lanes.run.check_times(times).is_err() {
            return Attempt::Refused;
        }
        let present = self.lanes.run.state().time;
        let direction = self.lanes.run.step_size();
        let seen = times
            .iter()
            .take_while(|&&time| !is_after(direction, time, present));
        let mut rest = &times[seen.count()..];
        for index in 0..self.group.len() {
            let start = self.group.start(index);
            for _ in rest.len()..times.len() {
                self.see(index, start);
            }
        }
        let mut output = Output::new(self.lanes.run.stepper(), direction);
        let mut shown = self.group.start(0).clone();
        while !rest.is_empty() {
            if self.job.ensemble.is_stopped() {
                return Attempt::Stopped;
            }
            let saved = self.lanes.saved();
            let Some(seen) = self.see_next(rest, (&mut output, &mut shown)) else {
                self.lanes.return_to(saved);
                self.leave_lanes();
                self.take_from_lanes();
                for place in core::mem::take(&mut self.live) {
                    if self.job.ensemble.is_stopped() {
                        return Attempt::Stopped;
                    }
                    self.group.members[place].run_alone(Task::At(rest), self.job.see);
                }
                return Attempt::Ended;
            };
            if seen == 0 {
                return Attempt::Stopped;
            }
            rest = &rest[seen..];
        }
        Attempt::Ended
    }

    /// Updates the output of a trajectory.
    fn see(&mut self, index: usize, state: &State<V>) {
        if let Some(output) = self.group.output(index) {
            (self.job.see)(output, state);
        }
    }

    /// Steps past the first of the times, observes the states at all times in the last step, and returns their number: zero if the run was
    /// stopped, `None` if a lane failed.
    fn see_next(
        &mut self,
        times: &[f64],
        (output, shown): (&mut OutputInLanes<M, J, W, R>, &mut State<V>),
    ) -> Option<usize> {
        let direction = self.lanes.run.step_size();
        let mut steps = 0_u64;
        while is_after(direction, times[0], self.lanes.run.state().time) {
            if !self.lanes.step() {
                return None;
            }
            output.evaluated = false;
            steps += 1;
            if steps.is_multiple_of(BLOCK) && self.job.ensemble.is_stopped() {
                return Some(0);
            }
        }
        let mut count = 0;
        for &time in times {
            let present = self.lanes.run.state();
            if is_after(direction, time, present.time) {
                break;
            }
            let state = match time == present.time {
                // A zero time has the same sign as in a run of one trajectory.
                true => present,
                false => {
                    self.lanes.look_at(time, output).ok()?;
                    &output.state
                }
            };
            shown.time = state.time;
            for index in 0..self.group.len() {
                copy_lane(index, &state.q, &mut shown.q);
                copy_lane(index, &state.p, &mut shown.p);
                if let Some(output) = self.group.output(index) {
                    (self.job.see)(output, shown);
                }
            }
            count += 1;
        }
        Some(count)
    }
}

/// A live trajectory for each lane, cyclically, so that no lane is empty.
fn cycle<L: Lanes>(live: impl Iterator<Item = usize> + Clone) -> impl Iterator<Item = usize> {
    live.cycle().take(L::WIDTH)
}
