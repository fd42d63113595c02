//! Trajectories run by one thread, in lanes where possible.

use alloc::vec::Vec;
use core::ops::{ControlFlow, Range};

use crate::explicit::SideBySide;
use crate::in_lanes::{evaluations, is_same};
use crate::run::Way;
use crate::{Ensemble, Row};
use symplectic_core::inside::{over_lanes_of, width};
use symplectic_core::simd::Lanes;
use symplectic_core::solver::Solver;
use symplectic_core::system::Join;
use symplectic_core::{Error, Integrator, Method, State, Statistics, Summation, System, Vector};

/// The task of every trajectory.
#[derive(Clone, Copy)]
pub(super) enum Task<'a> {
    /// Integrate to a time.
    To(f64),
    /// Take a number of steps.
    Steps(u64),
    /// Observe at given times.
    At(&'a [f64]),
}

/// A run of an ensemble.
pub(super) struct Job<'a, M, S: System<V>, V: Vector, R, N, L, A, F> {
    pub(super) ensemble: &'a Ensemble<M, S, V, R, N, L>,
    pub(super) task: Task<'a>,
    /// Creates the output of a trajectory.
    pub(super) output: &'a (dyn Fn(usize) -> A + Sync),
    /// Updates it.
    pub(super) see: &'a F,
    pub(super) way: Way,
    /// The number of trajectories in a full group.
    pub(super) width: usize,
}

/// A few trajectories of an ensemble.
pub(super) struct Group<'a, M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>, L, A>
{
    pub(super) ensemble: &'a Ensemble<M, S, V, R, N, L>,
    /// The indices of the starts.
    places: Range<usize>,
    /// The outputs of trajectories without an integrator of their own.
    outputs: Vec<A>,
    /// The trajectories, if they have left their lanes.
    pub(super) members: Vec<Member<M, S, V, R, N, A>>,
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

impl<M, S, V, R, N, L, A, F> Job<'_, M, S, V, R, N, L, A, F>
where
    M: Method,
    S: System<V> + Clone + Send,
    V: Vector + Send + Sync,
    R: Summation,
    N: Solver<V, S>,
    L: Lanes,
    A: Send,
    F: Fn(&mut A, &State<V>),
{
    /// Runs the trajectories whose starts have the indices `places` and appends their rows; those after a stop have none.
    pub(super) fn run(&self, mut places: Range<usize>, rows: &mut Vec<Row<V, A>>) {
        rows.reserve(places.len());
        if self.way == Way::Alone {
            // Without a row for all of them the run ends.
            let _ = Group::new(self, places).run_alone(self, rows);
            return;
        }
        let mut outcome = ControlFlow::Continue(());
        while places.start < places.end && outcome.is_continue() {
            let group = self.group_of(&places);
            let before = places.start;
            if self.is_enough(group.len()) {
                outcome = self.run_in_lanes(&mut places, rows);
            }
            if places.start == before && outcome.is_continue() {
                places.start = group.end;
                outcome = Group::new(self, group).run_alone(self, rows);
            }
        }
    }

    /// The first group of these trajectories.
    pub(super) fn group_of(&self, places: &Range<usize>) -> Range<usize> {
        places.start..self.ensemble.end_of_group(places, self.width)
    }

    /// Whether lanes are faster for this number of trajectories.
    pub(super) fn is_enough(&self, count: usize) -> bool {
        // A sweep takes the same time in a few lanes as in all: with fewer than half of them, single runs are as fast.
        match self.way {
            Way::Alone => false,
            Way::Explicit => count > 1,
            Way::Coupled => 2 * count >= width::<L>(self.ensemble.registers),
        }
    }

    /// Runs the first of these trajectories in lanes, group after group, and removes them from the range. It removes none if lanes are not
    /// possible.
    fn run_in_lanes(
        &self,
        places: &mut Range<usize>,
        rows: &mut Vec<Row<V, A>>,
    ) -> ControlFlow<()> {
        let work = SideBySide {
            job: self,
            has_one_system: self.ensemble.has_one_system(&self.group_of(places)),
            places,
            rows,
        };
        let outcome = over_lanes_of::<V, S, L, _, _>(self.ensemble.registers, work);
        outcome.unwrap_or(ControlFlow::Continue(()))
    }
}

impl<'a, M, S, V, R, N, L, A> Group<'a, M, S, V, R, N, L, A>
where
    M: Method,
    S: System<V> + Clone + Send,
    V: Vector + Send + Sync,
    R: Summation,
    N: Solver<V, S>,
    L: Lanes,
    A: Send,
{
    /// The trajectories whose starts have the indices `places`.
    pub(super) fn new<F>(job: &Job<'a, M, S, V, R, N, L, A, F>, places: Range<usize>) -> Self {
        let outputs = places
            .clone()
            .map(|place| (job.output)(job.ensemble.number(place)));
        Self {
            ensemble: job.ensemble,
            outputs: outputs.collect(),
            places,
            members: Vec::new(),
        }
    }

    /// The number of trajectories.
    pub(super) fn len(&self) -> usize {
        self.places.len()
    }

    /// The start of a trajectory of the group.
    pub(super) fn start(&self, index: usize) -> &'a State<V> {
        &self.ensemble.starts[self.places.start + index]
    }

    /// The system of a trajectory of the group.
    fn system(&self, index: usize) -> &'a S {
        &self.ensemble.family_of(self.places.start + index).0
    }

    /// The system whose lanes have the parameters of the trajectories with these indices; `None` if there is none.
    pub(super) fn joined<J>(
        &self,
        join: Join<S, J>,
        indices: impl Iterator<Item = usize>,
    ) -> Option<J> {
        join(&mut indices.map(|index| self.system(index)))
    }

    /// An integrator at the start of a trajectory of the group.
    pub(super) fn integrator(&self, index: usize) -> Integrator<M, S, V, R, N> {
        self.ensemble.integrator(self.places.start + index).1
    }

    /// Makes an integrator for every trajectory, at its start.
    pub(super) fn leave_lanes(&mut self) {
        let outputs = self.places.clone().zip(self.outputs.drain(..));
        let member = |(place, output)| Member::new(self.ensemble, place, output);
        self.members.extend(outputs.map(member));
    }

    /// Whether velocity and force have the same bits in lanes and as doubles: at all starts of the first group of a run, and at one start
    /// of every other group.
    pub(super) fn evaluates_like<W: Vector<Scalar: Lanes>>(&self, in_lanes: &[W; 2]) -> bool {
        let (first, count) = (self.places.start, self.len());
        let mut compared = match first == self.ensemble.first {
            true => 0..count,
            false => first / count % count..first / count % count + 1,
        };
        compared.all(|index| {
            let alone = evaluations(self.system(index), self.start(index));
            is_same(in_lanes, index, &alone)
        })
    }

    /// Runs all trajectories one at a time and appends their rows.
    pub(super) fn run_alone<F: Fn(&mut A, &State<V>)>(
        self,
        job: &Job<'a, M, S, V, R, N, L, A, F>,
        rows: &mut Vec<Row<V, A>>,
    ) -> ControlFlow<()> {
        let ensemble = self.ensemble;
        // One exists at a time, unless they are there already.
        let others = self.places.zip(self.outputs);
        let others = others.map(|(place, output)| Member::new(ensemble, place, output));
        for mut member in self.members.into_iter().chain(others) {
            if ensemble.is_stopped() {
                return ControlFlow::Break(());
            }
            member.run_alone(job.task, job.see);
            rows.push(member.row());
        }
        ControlFlow::Continue(())
    }

    /// The output of a trajectory of the group.
    pub(super) fn output(&mut self, index: usize) -> Option<&mut A> {
        match self.members.get_mut(index) {
            Some(member) => Some(&mut member.output),
            None => self.outputs.get_mut(index),
        }
    }

    /// Appends rows of all trajectories with these statistics; the states are those at the start.
    pub(super) fn write_starts(&mut self, statistics: Statistics, rows: &mut Vec<Row<V, A>>) {
        let ensemble = self.ensemble;
        let row = |(place, output): (usize, A)| Row {
            trajectory: ensemble.number(place),
            outcome: Ok(()),
            state: ensemble.starts[place].clone(),
            statistics,
            output,
        };
        rows.extend(self.places.clone().zip(self.outputs.drain(..)).map(row));
    }

    /// Appends the rows of trajectories that have left their lanes.
    pub(super) fn write(self, rows: &mut Vec<Row<V, A>>) {
        rows.extend(self.members.into_iter().map(Member::row));
    }
}

impl<M, S, V, R, N, A> Member<M, S, V, R, N, A>
where
    M: Method,
    S: System<V> + Clone + Send,
    V: Vector + Send + Sync,
    R: Summation,
    N: Solver<V, S>,
{
    /// A trajectory at its start.
    fn new<L: Lanes>(ensemble: &Ensemble<M, S, V, R, N, L>, place: usize, output: A) -> Self {
        let (trajectory, run) = ensemble.integrator(place);
        Self {
            trajectory,
            run,
            output,
            outcome: Ok(()),
        }
    }

    pub(super) fn run_alone(&mut self, task: Task<'_>, see: &impl Fn(&mut A, &State<V>)) {
        let Self { run, output, .. } = self;
        let outcome = match task {
            Task::To(end) => run.integrate_to(end),
            Task::Steps(count) => run.take_steps(count),
            Task::At(times) => run.integrate_at(times, |state| see(output, state)),
        };
        self.outcome = outcome.map(|_| ());
    }

    fn row(self) -> Row<V, A> {
        Row {
            trajectory: self.trajectory,
            outcome: self.outcome,
            statistics: *self.run.statistics(),
            state: self.run.into_state(),
            output: self.output,
        }
    }
}
