//! Trajectories with coupled stages in lanes.
//!
//! Every step is taken in all lanes. A trajectory whose stages do not converge in its lane takes the step alone.

pub(super) mod lanes;
mod stages;
mod sweeps;

use core::ops::ControlFlow;

use self::lanes::{CoupledLanes, has_linear_velocity};
use crate::group::{Attempt, Group, Member, Task};
use symplectic_core::inside::{Output, is_after};
use symplectic_core::simd::Lanes;
use symplectic_core::solver::Solver;
use symplectic_core::{Error, Method, State, Summation, System, Vector};

/// Number of steps between checks whether the run is stopped.
const BLOCK: u64 = 1 << 10;
/// Largest number of steps between attempts in lanes.
const MAX_PAUSE: u32 = 63;

/// The trajectories of a group in lanes.
pub(super) struct Coupled<'g, 'a, M, S, V, R, N, L, A, F, W, J>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
    W: Vector,
{
    group: &'g mut Group<'a, M, S, V, R, N, L, A>,
    see: &'g F,
    lanes: &'g mut CoupledLanes<M, S, V, R, N, W, J>,
    /// The lanes whose trajectory has not failed.
    live: u32,
    /// The lanes whose trajectory takes the next step in its lane.
    ready: u32,
    /// Number of steps to take alone; it grows after attempts in which no lane succeeds.
    pause: u32,
    last_pause: u32,
}

impl<'g, 'a, M, S, V, R, N, L, A, F, W, J> Coupled<'g, 'a, M, S, V, R, N, L, A, F, W, J>
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
    J: System<W, Class = <S as System<V>>::Class>,
{
    /// Trajectories in lanes with this system; `None` if their velocities are not of one kind, or the lanes round differently.
    pub(super) fn new(
        group: &'g mut Group<'a, M, S, V, R, N, L, A>,
        see: &'g F,
        lanes: &'g mut CoupledLanes<M, S, V, R, N, W, J>,
    ) -> Option<Self> {
        group.leave_lanes();
        let count = group.members.len();
        let members = group.members.iter_mut();
        let mut kinds = members.map(|member| has_linear_velocity(&mut member.run));
        let linear_velocity = kinds.next()?;
        if kinds.any(|other| other != linear_velocity) || !lanes.may_sweep() {
            return None;
        }
        // Unused lanes hold copies: zeros might be a singular point.
        lanes.begin(linear_velocity, |lane| group.start(lane % count));
        if !group.evaluates_like(&lanes.evaluations()) {
            return None;
        }
        let live = (1 << count) - 1;
        Some(Self {
            group,
            see,
            lanes,
            live,
            ready: 0,
            pause: 0,
            last_pause: 0,
        })
    }

    /// Runs all trajectories.
    pub(super) fn run(mut self, task: Task<'_>) -> Attempt {
        let attempt = match task {
            Task::To(_) | Task::Steps(_) => self.take_remaining(task),
            Task::At(times) => self.see_at(times),
        };
        for lane in bits(self.ready) {
            let run = &mut self.group.members[lane].run;
            self.lanes.store_state(lane, run);
        }
        attempt
    }

    fn take_remaining(&mut self, task: Task<'_>) -> Attempt {
        let run = &self.group.members[0].run;
        let remaining = match task {
            Task::To(end) => run.steps_to_time(end),
            Task::Steps(count) => Ok(run.steps_left(count)),
            Task::At(_) => return Attempt::Refused,
        };
        let Ok(mut remaining) = remaining else {
            return Attempt::Refused;
        };
        let mut count = 0;
        while let Some((size, time)) = remaining.next() {
            remaining.tick();
            if count % BLOCK == 0 && self.group.ensemble.is_stopped() {
                return Attempt::Stopped;
            }
            count += 1;
            self.step(size, time, |member| member.run.advance(size, time));
            if self.live == 0 {
                break;
            }
        }
        Attempt::Ended
    }

    fn see_at(&mut self, times: &[f64]) -> Attempt {
        let run = &self.group.members[0].run;
        if run.check_times(times).is_err() {
            return Attempt::Refused;
        }
        let mut steps = run.steps_left(u64::MAX);
        let see = self.see;
        let direction = run.step_size();
        let mut output = Output::new(run.stepper(), direction);
        let mut rest = times;
        for (lane, member) in self.group.members.iter_mut().enumerate() {
            let Member {
                run, output: own, ..
            } = member;
            let mut seen = times;
            member.outcome =
                output.show(run.stepper_mut(), &mut seen, &mut |state| see(own, state));
            self.live &= !(u32::from(member.outcome.is_err()) << lane);
        }
        skip(&mut rest, direction, self.lanes.time());
        let mut count = 0;
        while !rest.is_empty()
            && self.live != 0
            && let Some((size, time)) = steps.next()
        {
            if count % BLOCK == 0 && self.group.ensemble.is_stopped() {
                return Attempt::Stopped;
            }
            count += 1;
            let before = rest;
            let settled = self.step(size, time, |member| {
                let Member {
                    run, output: own, ..
                } = member;
                let mut seen = before;
                let outcome = run.advance_in_sight(size, time, &mut |stepper| {
                    output.show(stepper, &mut seen, &mut |state| see(own, state))?;
                    Ok(ControlFlow::<()>::Continue(()))
                });
                outcome.map(|_| ())
            });
            steps.tick();
            skip(&mut rest, direction, time);
            if rest.len() == before.len() {
                continue;
            }
            for lane in bits(settled) {
                let Member {
                    run,
                    output: own,
                    outcome,
                    ..
                } = &mut self.group.members[lane];
                self.lanes.store(lane, run);
                let mut seen = before;
                *outcome = output.show(run.stepper_mut(), &mut seen, &mut |state| see(own, state));
                if outcome.is_err() {
                    self.live &= !(1 << lane);
                    self.ready &= !(1 << lane);
                }
            }
        }
        Attempt::Ended
    }

    /// Takes a step of every trajectory, by `alone` if it fails in its lane; returns the lanes that succeeded.
    fn step(
        &mut self,
        size: f64,
        time: f64,
        mut alone: impl FnMut(&mut Member<M, S, V, R, N, A>) -> Result<(), Error>,
    ) -> u32 {
        let tries = self.pause == 0 && self.ready != 0 && time != self.lanes.time();
        self.pause = self.pause.saturating_sub(1);
        let settled = match tries {
            true => self.lanes.attempt(size, self.ready),
            false => 0,
        };
        if tries {
            self.last_pause = match settled {
                0 => (2 * self.last_pause + 1).min(MAX_PAUSE),
                _ => 0,
            };
            self.pause = self.last_pause;
        }
        for lane in bits(self.ready & !settled) {
            self.lanes.store(lane, &mut self.group.members[lane].run);
        }
        match settled {
            0 => self.lanes.go_to(size, time),
            _ => self.lanes.accept(size, time),
        }
        for lane in bits(self.live & !settled) {
            let member = &mut self.group.members[lane];
            member.outcome = alone(member);
            let bit = 1 << lane;
            self.ready &= !bit;
            match member.outcome {
                Ok(()) if self.lanes.load(lane, &mut member.run, size) => self.ready |= bit,
                Ok(()) => (),
                Err(_) => self.live &= !bit,
            }
        }
        settled
    }
}

/// Removes the times up to the time `present` from the list.
fn skip(times: &mut &[f64], direction: f64, present: f64) {
    let seen = times
        .iter()
        .take_while(|&&time| !is_after(direction, time, present));
    *times = &times[seen.count()..];
}

/// The indices of the bits that are set.
fn bits(mut set: u32) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let first = (set != 0).then(|| set.trailing_zeros() as usize);
        set &= set.wrapping_sub(1);
        first
    })
}
