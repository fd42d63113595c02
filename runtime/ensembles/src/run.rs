//! Runs of an ensemble.

use alloc::vec::Vec;
use core::ops::{ControlFlow, Range};

use crate::coupled::lanes::goes_in_lanes;
use crate::group::{Job, Task};
use crate::pool::{self, threads};
use crate::{Ensemble, Row, Wanted};
use symplectic_core::inside::{Plan, PlanOf, Widest, step_parts_of, width};
use symplectic_core::simd::Lanes;
use symplectic_core::solver::Solver;
use symplectic_core::stepper::Stepper;
use symplectic_core::system::{Join, LaneWork};
use symplectic_core::{
    Error, Integrator, Method, Run, Scalar, State, Statistics, Summation, System, Vector,
};

/// Number of steps below which lanes are slower with coupled stages.
const FEW_STEPS: f64 = 4.0;
/// Number of steps after which a thread reports, roughly.
const SHARE: f64 = (1_u64 << 16) as f64;
/// The largest number of groups that a thread runs before it reports.
const MAX_GROUPS: usize = 1 << 5;

/// How trajectories run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// One at a time.
    Alone,
    /// In lanes, with explicit steps.
    Explicit,
    /// In lanes, with coupled stages.
    Coupled,
}

/// Empty work over lanes, to test whether a system is defined over lanes.
struct Known;

impl<V: Vector, S: System<V>, L: Lanes> LaneWork<V, S, L> for Known {
    type Output = ();

    fn has_one_system(&self) -> bool {
        true
    }

    fn run<W, J>(self, _join: Join<S, J>)
    where
        W: Vector<Scalar = L>,
        J: System<W, Class = <S as System<V>>::Class>,
    {
    }
}

/// Counts the leading systems that join.
struct Joining<'i, 's, S> {
    systems: &'i mut dyn Iterator<Item = &'s S>,
}

impl<V: Vector, S: System<V>, L: Lanes> LaneWork<V, S, L> for Joining<'_, '_, S> {
    type Output = usize;

    fn has_one_system(&self) -> bool {
        false
    }

    fn run<W, J>(self, join: Join<S, J>) -> usize
    where
        W: Vector<Scalar = L>,
        J: System<W, Class = <S as System<V>>::Class>,
    {
        let mut read = 0;
        // The last system read is the one that does not join.
        match join(&mut self.systems.inspect(|_| read += 1)) {
            Some(_) => read,
            None => read.saturating_sub(1).max(1),
        }
    }
}

impl<M, S, V, R, N, L> Ensemble<M, S, V, R, N, L>
where
    M: Method,
    S: System<V> + Clone + Send,
    V: Vector + Send + Sync,
    R: Summation,
    N: Solver<V, S>,
    L: Lanes,
{
    /// Integrates every trajectory to the time `end`, like [`Integrator::integrate_to`].
    ///
    /// `show` receives a [`Row`] for each trajectory, in order, on this thread, also for failed trajectories. The run ends if `show`
    /// returns `Break`. Returns the number of the first trajectory without a row, which is the end of [`trajectories`](Self::trajectories)
    /// unless the run was stopped.
    pub fn integrate_to(&self, end: f64, show: impl FnMut(Row<V>) -> ControlFlow<()>) -> usize {
        self.run(Task::To(end), |_| (), |(), _| (), show)
    }

    /// Takes `count` steps of every trajectory, like [`Integrator::take_steps`]. `show` and the result are as for
    /// [`integrate_to`](Self::integrate_to).
    pub fn take_steps(&self, count: u64, show: impl FnMut(Row<V>) -> ControlFlow<()>) -> usize {
        self.run(Task::Steps(count), |_| (), |(), _| (), show)
    }

    /// Steps every trajectory past the last of `times`, like [`Integrator::integrate_at`].
    ///
    /// `output(k)` creates the output of trajectory k, `see` updates it at each of the times, and the [`Row`] contains
    /// it. Both run on any thread. `show` and the result are as for [`integrate_to`](Self::integrate_to).
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// use symplectic::State;
    /// use symplectic::ensemble::{Ensemble, EnsembleError};
    /// use symplectic::nalgebra::Vector1;
    ///
    /// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    /// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
    ///
    /// # fn main() -> Result<(), EnsembleError> {
    /// let starts = (0..10).map(|k| State::from_arrays(0.0, [0.1 * f64::from(k)], [0.0])).collect();
    /// let ensemble = Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)?;
    /// let mut table = Vec::new();
    /// let see = |angles: &mut Vec<f64>, state: &State<Vector1<f64>>| angles.push(state.q[0]);
    /// ensemble.integrate_at(&[0.0, 1.0, 2.0], |_| Vec::new(), see, |row| {
    ///     table.push(row.output);
    ///     ControlFlow::Continue(())
    /// });
    /// assert_eq!((table.len(), table[3].len(), table[3][0]), (10, 3, 0.1 * 3.0));
    /// # Ok(())
    /// # }
    /// ```
    pub fn integrate_at<A: Send>(
        &self,
        times: &[f64],
        output: impl Fn(usize) -> A + Sync,
        see: impl Fn(&mut A, &State<V>) + Sync,
        show: impl FnMut(Row<V, A>) -> ControlFlow<()>,
    ) -> usize {
        self.run(Task::At(times), output, see, show)
    }

    /// Calls `work` with the integrator of every trajectory: to find events, observe invariants, take steps.
    ///
    /// Trajectories run one at a time on every thread. The first argument of `work` is the value of `output`. `show` and the result are as
    /// for [`integrate_at`](Self::integrate_at).
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// use symplectic::ensemble::{Ensemble, EnsembleError};
    /// use symplectic::nalgebra::Vector1;
    /// use symplectic::{Event, State};
    ///
    /// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    /// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
    ///
    /// # fn main() -> Result<(), EnsembleError> {
    /// let starts = (1..10).map(|k| State::from_arrays(0.0, [0.3 * f64::from(k)], [0.0])).collect();
    /// let ensemble = Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)?;
    /// let mut swings = Vec::new();
    /// ensemble.each(
    ///     |_| 0,
    ///     |count, integrator| {
    ///         let lowest = Event::rising(|state: &State<Vector1<f64>>| state.q[0]);
    ///         integrator.integrate_with_events(100.0, &lowest, |_| {
    ///             *count += 1;
    ///             ControlFlow::<()>::Continue(())
    ///         })?;
    ///         Ok(())
    ///     },
    ///     |row| {
    ///         swings.push(row.output);
    ///         ControlFlow::Continue(())
    ///     },
    /// );
    /// // Wide swings are slower.
    /// assert!(swings.is_sorted_by(|a, b| a >= b) && swings[0] == 16 && swings[8] < 10);
    /// # Ok(())
    /// # }
    /// ```
    pub fn each<A: Send>(
        &self,
        output: impl Fn(usize) -> A + Sync,
        work: impl Fn(&mut A, &mut Integrator<M, S, V, R, N>) -> Result<(), Error> + Sync,
        show: impl FnMut(Row<V, A>) -> ControlFlow<()>,
    ) -> usize {
        self.each_as(Ok, output, work, show)
    }

    /// [`each`](Self::each) for runs of any [`Stepper`]: `make` constructs the [`Run`] of a trajectory from its integrator, for example with
    /// reversible steps of variable size. [`set_retry`](Self::set_retry) has an effect only
    /// if `make` returns the integrator itself, not on a run that `make` constructs from it.
    ///
    /// If `make` fails, the row has its error and the start. A [checkpoint](Self::checkpoint) does not store `make` and `work`: pass the
    /// same ones again.
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// use symplectic::State;
    /// use symplectic::adaptive::{AdaptiveSteps, DistancePower};
    /// use symplectic::ensemble::{Ensemble, EnsembleError};
    ///
    /// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    /// symplectic::hamiltonian! {
    ///     Kepler
    ///     q: [x, y], p: [px, py];
    ///     H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)
    /// }
    ///
    /// # fn main() -> Result<(), EnsembleError> {
    /// // Pericentres of orbits of eccentricity 0, 0.1, …, 0.9.
    /// let pericentre = |k: u8| {
    ///     let e = 0.1 * f64::from(k);
    ///     State::from_arrays(0.0, [1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()])
    /// };
    /// let ensemble = Ensemble::new(VelocityVerlet, Kepler, (0..10).map(pericentre).collect(), 0.02)?;
    /// ensemble.each_as(
    ///     |integrator| {
    ///         let epsilon = integrator.step_size();
    ///         AdaptiveSteps::of(integrator, DistancePower(1.5), epsilon)
    ///     },
    ///     |_| None,
    ///     |end, run| {
    ///         *end = Some(run.integrate_to(100.0)?);
    ///         Ok(())
    ///     },
    ///     |row| {
    ///         // The present state of such a run is that after its last step, which passes the end.
    ///         assert!(row.outcome.is_ok() && row.state.time >= 100.0);
    ///         assert_eq!(row.output.map(|end| end.time), Some(100.0));
    ///         ControlFlow::Continue(())
    ///     },
    /// );
    /// # Ok(())
    /// # }
    /// ```
    pub fn each_as<T: Stepper<State = State<V>>, A: Send, E: Send>(
        &self,
        make: impl Fn(Integrator<M, S, V, R, N>) -> Result<Run<T>, E> + Sync,
        output: impl Fn(usize) -> A + Sync,
        work: impl Fn(&mut A, &mut Run<T>) -> Result<(), E> + Sync,
        show: impl FnMut(Row<V, A, E>) -> ControlFlow<()>,
    ) -> usize {
        let row = |ensemble: &Self, place| {
            let (trajectory, integrator) = ensemble.integrator(place);
            let mut output = output(trajectory);
            let (outcome, state, statistics) = match make(integrator) {
                Ok(mut run) => {
                    let outcome = work(&mut output, &mut run);
                    (outcome, run.state().clone(), *run.statistics())
                }
                Err(error) => {
                    let start = ensemble.starts[place].clone();
                    (Err(error), start, Statistics::default())
                }
            };
            Row {
                trajectory,
                outcome,
                state,
                statistics,
                output,
            }
        };
        let fill = |ensemble: &Self, places: Range<usize>, rows: &mut Vec<Row<V, A, E>>| {
            let going_on = |_: &usize| !ensemble.is_stopped();
            rows.extend(
                places
                    .take_while(going_on)
                    .map(|place| row(ensemble, place)),
            );
        };
        self.show_all(1, fill, show)
    }

    fn run<A: Send>(
        &self,
        task: Task<'_>,
        output: impl Fn(usize) -> A + Sync,
        see: impl Fn(&mut A, &State<V>) + Sync,
        show: impl FnMut(Row<V, A>) -> ControlFlow<()>,
    ) -> usize {
        let steps = self.steps_of(task);
        let way = match self.way() {
            // The first step of each trajectory is taken alone.
            Way::Coupled if steps < FEW_STEPS => Way::Alone,
            way => way,
        };
        let width = match way {
            Way::Alone => 1,
            Way::Explicit => width::<L>(self.registers),
            // All threads take precedence over all lanes.
            Way::Coupled => {
                let count = self.starts.len() - self.first;
                count
                    .div_ceil(threads())
                    .clamp(1, width::<L>(self.registers))
            }
        };
        let fill = |ensemble: &Self, places, rows: &mut Vec<Row<V, A>>| {
            let job = Job {
                ensemble,
                task,
                output: &output,
                see: &see,
                way,
                width,
            };
            job.run(places, rows);
        };
        // A thread reports after a number of steps.
        let share = width * ((SHARE / steps.max(1.0)) as usize / width).clamp(1, MAX_GROUPS);
        self.show_all(share, fill, show)
    }

    /// The number of steps of a trajectory, roughly.
    fn steps_of(&self, task: Task<'_>) -> f64 {
        let start = self.starts.get(self.first).map_or(0.0, |start| start.time);
        match task {
            Task::Steps(count) => count as f64,
            Task::To(end) => ((end - start) / self.step_size).abs(),
            Task::At(times) => {
                let last = times.last().map_or(start, |last| *last);
                ((last - start) / self.step_size)
                    .abs()
                    .max(times.len() as f64)
            }
        }
    }

    /// How trajectories run.
    pub(super) fn way(&self) -> Way {
        let possible = self.lanes != Wanted::No
            && V::Scalar::IS_DOUBLE
            && S::over_lanes::<L, _>(Known).is_some();
        let is_wide =
            cfg!(target_feature = "avx512f") || matches!(self.registers, Widest::Avx512(_));
        // A compiled method already has its coupled stages in lanes. Twice as many components do not fit into registers.
        let faster = M::AT_RUN_TIME || is_wide && !S::DISPLACED;
        let coupled = faster || self.lanes == Wanted::Yes;
        match possible {
            true if PlanOf::<M, S, V>::LANEWISE && self.method.is_lanewise() => Way::Explicit,
            true if coupled && goes_in_lanes::<M, S, V, N>() => Way::Coupled,
            _ => Way::Alone,
        }
    }

    /// Runs shares of at most `share` trajectories and passes their rows to `show`.
    fn show_all<A: Send, E: Send>(
        &self,
        share: usize,
        fill: impl Fn(&Self, Range<usize>, &mut Vec<Row<V, A, E>>) + Sync,
        mut show: impl FnMut(Row<V, A, E>) -> ControlFlow<()>,
    ) -> usize {
        let mut shown = self.first;
        let part = |places: &Range<usize>, former| self.part(places, former);
        let places = self.first..self.starts.len();
        pool::in_order((self, part), places, share, fill, |rows| {
            rows.drain(..).try_for_each(|row| {
                shown += 1;
                show(row)
            })
        });
        self.offset + shown
    }

    pub(super) fn is_stopped(&self) -> bool {
        self.stop.as_ref().is_some_and(|stop| stop())
    }

    /// The end of the first group of these starts: at most `width` trajectories with the same start time and, unless systems
    /// [join](System::JOINS), the same system.
    pub(super) fn end_of_group(&self, places: &Range<usize>, width: usize) -> usize {
        let first = places.start;
        let time = self.starts[first].time.to_bits();
        let most = (first + width).min(places.end);
        let others = first + 1..most;
        let other = others.take_while(|&place| self.starts[place].time.to_bits() == time);
        let end = first + 1 + other.count();
        let families = || self.families_in(first..end);
        let joined = match S::JOINS && families().nth(1).is_some() {
            true => S::over_lanes::<L, _>(Joining {
                systems: &mut families().map(|(system, _)| system),
            }),
            false => None,
        };
        let last = families().take(joined.unwrap_or(1)).last();
        last.map_or(end, |(_, last)| end.min(*last))
    }

    /// Whether all these starts have the same system.
    pub(super) fn has_one_system(&self, places: &Range<usize>) -> bool {
        places.end <= self.family_of(places.start).1
    }

    /// The number of the trajectory from a start.
    pub(super) const fn number(&self, place: usize) -> usize {
        self.offset + place
    }

    /// The systems of a range of starts, each with the end of its own range.
    fn families_in(&self, range: Range<usize>) -> impl Iterator<Item = &(S, usize)> {
        let mut next = range.start;
        core::iter::from_fn(move || {
            let family = (next < range.end).then(|| self.family_of(next))?;
            next = family.1;
            Some(family)
        })
    }

    /// The system of a start, with the end of its range of starts.
    pub(super) fn family_of(&self, place: usize) -> &(S, usize) {
        let number = self.systems.partition_point(|(_, end)| *end <= place);
        &self.systems[number]
    }

    /// The number and the integrator of the trajectory from a start.
    pub(super) fn integrator(&self, place: usize) -> (usize, Integrator<M, S, V, R, N>) {
        let system = self.family_of(place).0.clone();
        let start = self.starts[place].clone();
        let mut run = Integrator::unchecked(self.method.clone(), system, start, self.step_size);
        *step_parts_of(run.stepper_mut()).stopping = self.stopping;
        run.set_retry(self.retry);
        (self.offset + place, run)
    }
}
