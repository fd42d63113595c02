//! The trajectories of a run, and what becomes of them.

use std::ops::ControlFlow;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

use symplectic::at_run_time::RunTimeTableau;
use symplectic::constraints::{
    Constrained, ConstraintName, Nonholonomic, consistent, consistent_momentum,
};
use symplectic::emitted::Solver;
use symplectic::ensemble::{Ensemble, EnsembleError};
use symplectic::nalgebra::DVector;
use symplectic::output::Interpolation;
use symplectic::solver::Newton;
use symplectic::system::{Class, Conservative, Frictionless, Unconstrained};
use symplectic::{
    Compensated, Error as RunError, General, Hamiltonian, Plain, Separable, State, Summation,
    System,
};
use symplectic_compiler::Error;
use symplectic_formula::{Structure, System as Parsed};
use toml::Spanned;

use crate::output::{Facts, Results, Seen, append};
use crate::progress::{Meter, Progress};
use crate::resume::{Origin, Resume, checksum};
use crate::setup::{Iteration, Sums};
use crate::starts::Start;
use crate::summary::summary;
use crate::trajectory::Trajectory;
use crate::{Run, Shard, chaos, counted, document, memory};
use symplectic_tape::{Formula, Parameters};
use symplectic_terminal::{errors, print};

pub(super) type Vector = DVector<f64>;
pub(super) type States = Vec<State<Vector>>;
type Made<S, R> = Ensemble<RunTimeTableau, S, Vector, R>;
/// Systems with their starts.
type Families<C, const F: bool> = Vec<(Formula<C, F>, States)>;
/// Runs systems with their starts and the parameters of each.
type Go<'a, C, const F: bool> =
    fn(Run<'a>, Families<C, F>, &[Vec<f64>], &Progress) -> Result<ExitCode, Error>;
/// Moves a state onto the constraints.
type Project<C> = fn(&Formula<C>, State<Vector>) -> Result<State<Vector>, RunError>;
/// Runs the trajectories of an ensemble.
type Task<'a, S, R, N> = fn(&Run<'a>, &mut Ensemble<RunTimeTableau, S, Vector, R, N>, Keep<'_>);
/// Keeps a finished trajectory.
pub(super) type Keep<'k> = &'k mut dyn FnMut(Trajectory) -> ControlFlow<()>;

/// What decides the type of a system.
#[derive(Clone, Copy)]
pub(super) struct Kind {
    pub(super) is_separable: bool,
    is_forced: bool,
    /// With holonomic constraints, and with non-holonomic ones.
    constraints: [bool; 2],
}

impl Kind {
    pub(super) fn of(system: &Parsed, structure: &Structure) -> Self {
        Kind {
            is_separable: structure.split.is_ok() && system.force_of_momenta().is_none(),
            is_forced: !system.applied.is_empty(),
            constraints: [&system.constraints, &system.nonholonomic].map(|all| !all.is_empty()),
        }
    }
}

impl<'a> Run<'a> {
    pub(super) fn of_kind(self, kind: Kind, starts: Vec<Start>) -> Result<ExitCode, Error> {
        match self.setup.sums {
            Sums::Compensated => self.with_sums::<Compensated>(kind, starts),
            Sums::Plain => self.with_sums::<Plain>(kind, starts),
        }
    }

    fn with_sums<R: Summation>(self, kind: Kind, starts: Vec<Start>) -> Result<ExitCode, Error> {
        match (kind.constraints, kind.is_separable, kind.is_forced) {
            ([true, _], true, _) => self.integrate(starts, Self::holonomic::<Separable, R>),
            ([true, _], false, _) => self.integrate(starts, Self::holonomic::<General, R>),
            ([_, true], true, _) => self.integrate(starts, Self::nonholonomic::<Separable, R>),
            ([_, true], false, _) => self.integrate(starts, Self::nonholonomic::<General, R>),
            (_, true, true) => self.integrate(starts, Self::by_solver::<Separable, true, R>),
            (_, false, true) => self.integrate(starts, Self::by_solver::<General, true, R>),
            (_, true, false) => self.integrate(starts, Self::free::<Separable, R>),
            (_, false, false) => self.integrate(starts, Self::free::<General, R>),
        }
    }

    /// Groups the starts by parameters and runs their systems by `go`.
    fn integrate<C, const F: bool>(
        self,
        starts: Vec<Start>,
        go: Go<'a, C, F>,
    ) -> Result<ExitCode, Error> {
        let (start, end) = (self.setup.start(), self.end());
        let last = self.times.as_ref().and_then(|times| times.last());
        let size = *self.setup.step_size.get_ref();
        let meter = Meter::new([start, *last.unwrap_or(&end)], size);
        let progress = Progress::new(meter, self.arguments.progress);
        let mut parameters: Vec<Vec<f64>> = Vec::new();
        let mut families: Families<C, F> = Vec::new();
        let same_bits = |a: &[f64], b: &[f64]| {
            let bits = |x: &f64| x.to_bits();
            a.iter().map(bits).eq(b.iter().map(bits))
        };
        let noting = progress.meter().filter(|_| starts.len() <= MANY);
        for start in starts {
            let before = parameters.last();
            // The meter counts systems, so each trajectory has its own.
            let is_of_family = noting.is_none()
                && before.is_some_and(|before| same_bits(before, &start.parameters));
            match families.last_mut() {
                Some((_, family)) if is_of_family => {
                    family.push(start.state);
                }
                _ => {
                    let own = Parameters::from(start.parameters.as_slice());
                    let system = Formula::new(Arc::clone(&self.tapes), own);
                    let system = system.watched(noting.clone());
                    families.push((system, vec![start.state]));
                }
            }
            parameters.push(start.parameters);
        }
        for own in parameters.iter().filter(|_| self.tapes.has_friction()) {
            let own = Parameters::from(own.as_slice());
            let last = *last.unwrap_or(&end);
            let factors = self.tapes.factors(&own, last).unwrap_or_default();
            if factors
                .iter()
                .any(|factor| !(1e-250..1e250).contains(factor))
            {
                let message = format!(
                    "the friction changes momenta by more than a factor of 1e250 until the time {last}: give an earlier end"
                );
                return Err(self.file.error(self.setup.system.span(), message));
            }
        }
        go(self, families, &parameters, &progress)
    }

    /// An ensemble of systems.
    fn made<S, R>(
        &self,
        families: impl IntoIterator<Item = (S, States)>,
    ) -> Result<Made<S, R>, Error>
    where
        S: System<Vector, Class: Frictionless>,
        R: Summation,
    {
        let (tableau, size) = (&self.method.tableau, *self.setup.step_size.get_ref());
        let made = Made::with_summation(tableau.clone(), families, size);
        made.map_err(|error| self.refused(&error))
    }

    fn is_by_newton(&self) -> bool {
        self.setup.solver.as_ref().map(Spanned::get_ref) == Some(&Iteration::Newton)
    }

    /// Runs systems of H alone, perhaps with indicators of chaos.
    fn free<C: Class + Conservative, R: Summation>(
        self,
        families: Families<C, false>,
        parameters: &[Vec<f64>],
        progress: &Progress,
    ) -> Result<ExitCode, Error>
    where
        Formula<C>: Hamiltonian<Class = C, Vector<f64> = Vector>,
    {
        if !self.has_chaos() {
            return self.by_solver::<C, false, R>(families, parameters, progress);
        }
        let tangents = families.into_iter();
        let tangents = tangents.map(|(system, starts)| self.tangents(system, starts));
        let ensemble = self.made::<_, R>(tangents)?;
        match self.is_by_newton() {
            false => self.run(ensemble, parameters, progress, Self::chaos),
            true => self.run(
                ensemble.with_solver(<Newton>::new()),
                parameters,
                progress,
                Self::chaos,
            ),
        }
    }

    fn by_solver<C: Class + Conservative, const F: bool, R: Summation>(
        self,
        families: Families<C, F>,
        parameters: &[Vec<f64>],
        progress: &Progress,
    ) -> Result<ExitCode, Error>
    where
        Formula<C, F>: Hamiltonian<Class = C, Vector<f64> = Vector>,
    {
        let ensemble = self.made::<_, R>(families)?;
        match self.is_by_newton() {
            false => self.run(ensemble, parameters, progress, Self::states),
            true => self.run(
                ensemble.with_solver(<Newton>::new()),
                parameters,
                progress,
                Self::states,
            ),
        }
    }

    fn holonomic<C: Class + Unconstrained, R: Summation>(
        self,
        families: Families<Constrained<C>, false>,
        parameters: &[Vec<f64>],
        progress: &Progress,
    ) -> Result<ExitCode, Error> {
        let families = self.projected(families, consistent)?;
        let ensemble = self.made::<_, R>(families)?;
        self.run(ensemble, parameters, progress, Self::states)
    }

    fn nonholonomic<C: Class + Unconstrained, R: Summation>(
        self,
        families: Families<Nonholonomic<C>, false>,
        parameters: &[Vec<f64>],
        progress: &Progress,
    ) -> Result<ExitCode, Error> {
        let families = self.projected(families, consistent_momentum)?;
        let ensemble = self.made::<_, R>(families)?;
        self.run(ensemble, parameters, progress, Self::states)
    }

    /// Starts on the constraints, if that is wanted.
    fn projected<C>(
        &self,
        mut families: Families<C, false>,
        project: Project<C>,
    ) -> Result<Families<C, false>, Error> {
        let Some(wanted) = &self.setup.project_starts else {
            return Ok(families);
        };
        let all = families.iter_mut();
        let all = all.flat_map(|(system, starts)| starts.iter_mut().map(|start| (&*system, start)));
        for (number, (system, start)) in all.enumerate() {
            *start = project(system, start.clone()).map_err(|error| {
                let message = format!("start {number}: {error}");
                self.file.error(wanted.span(), message)
            })?;
        }
        Ok(families)
    }

    /// Runs an ensemble by `task`, and writes the results.
    fn run<S, R: Summation, N: Solver<Vector, S>>(
        self,
        mut ensemble: Ensemble<RunTimeTableau, S, Vector, R, N>,
        parameters: &[Vec<f64>],
        progress: &Progress,
        task: Task<'a, S, R, N>,
    ) -> Result<ExitCode, Error>
    where
        S: System<Vector> + Clone + Send + Sync,
    {
        if let Some(Shard { part, count }) = self.arguments.shard {
            ensemble = ensemble
                .shard(part, count)
                .map_err(|error| self.refused(&error))?;
        }
        let own = self.has_chaos().then(|| {
            let starts = ensemble.starts().iter();
            starts.map(chaos::original).collect::<Vec<_>>()
        });
        let (mut resume, mut rows) = self.resume(ensemble.starts(), parameters)?;
        let (all, before) = (ensemble.trajectories().len(), rows.len());
        if before > 0 {
            let next = ensemble.trajectories().start + before;
            let restored = ensemble
                .checkpoint(next)
                .and_then(|checkpoint| ensemble.restore(&checkpoint));
            restored.map_err(|error| document(error.to_string()))?;
        }
        if let Some(section) = &self.section {
            section.count(&rows);
        }
        rows.reserve(all.saturating_sub(before));
        let began = Instant::now();
        let shown = progress.show(all, before);
        let mut keep = |mut row: Trajectory| {
            self.damp(&mut row, parameters);
            rows.push(row);
            progress.finished();
            resume.save(&rows);
            ControlFlow::Continue(())
        };
        task(&self, &mut ensemble, &mut keep);
        if let Some(section) = &self.section
            && section.is_full()()
        {
            drop(shown);
            resume.remove();
            let fault = memory::fault_of_section(section.most(), all);
            let given = self.setup.section.as_ref().map_or(0..0, Spanned::span);
            return Err(self.file.error(given, fault));
        }
        drop(shown);
        let seconds = began.elapsed().as_secs_f64();
        let orders = self.method.tableau.orders();
        let results = Results {
            coordinates: self.coordinates,
            facts: Facts {
                method: self.method.tableau.name(),
                definition: &self.method.definition,
                orders: [orders.general, orders.separable, orders.nystrom].map(u64::from),
                step_size: *self.setup.step_size.get_ref(),
                sums: match self.setup.sums {
                    Sums::Compensated => "compensated",
                    Sums::Plain => "plain",
                },
                formula: self.setup.system.get_ref(),
                setup: self.file.text,
            },
            tapes: &self.tapes,
            rows: &rows,
            starts: own.as_deref().unwrap_or(ensemble.starts()),
            has_chaos: self.has_chaos(),
            parameters,
            seen: match (&self.times, &self.section) {
                (Some(times), _) => Seen::Times(times),
                (None, Some(_)) => Seen::Section,
                (None, None) => Seen::End,
            },
        };
        let failed = rows.iter().filter(|row| row.failure.is_some()).count();
        let bound = self.setup.warn_energy_error.as_ref();
        let bound = bound.map_or(ENERGY_ERROR, |bound| *bound.get_ref());
        let counts = [before, self.skipped];
        let (lines, warning) = summary(&results, bound, seconds, counts);
        let mut message = format!(
            "{}, {failed} failed: {}\n{lines}",
            counted(rows.len(), "trajectory", "trajectories"),
            self.target.path().display()
        );
        message.extend(self.note_on_times(S::Class::SEPARABLE));
        self.target.write(&results, || resume.advice(&rows))?;
        let fault = resume.fault();
        resume.remove();
        let printed = print(&message)?;
        let warnings = warning.into_iter().chain(fault);
        warnings.for_each(|warning| errors::warning(&warning));
        Ok(match failed > 0 && failed == rows.len() {
            true => ExitCode::from(1),
            false => printed,
        })
    }

    /// Integrates to the end, at the output times, or to the states of the section.
    fn states<C: Class, const F: bool, R: Summation, N: Solver<Vector, Formula<C, F>>>(
        &self,
        ensemble: &mut Ensemble<RunTimeTableau, Formula<C, F>, Vector, R, N>,
        keep: Keep<'_>,
    ) where
        Formula<C, F>: Hamiltonian<Class = C, Vector<f64> = Vector>,
    {
        let end = self.end();
        match (&self.times, &self.section) {
            (None, Some(section)) => {
                ensemble.stop_if(section.is_full());
                let see = |seen: &mut Vec<f64>, run: &mut _| section.see(seen, run, end);
                ensemble.each(|_| Vec::new(), see, |row| keep(row.into()));
            }
            (Some(times), _) => {
                let numbers = times.len() * (1 + 2 * self.coordinates.dimension());
                let output = |_| Vec::with_capacity(numbers);
                ensemble.integrate_at(times, output, append, |row| keep(row.into()));
            }
            (None, None) => {
                ensemble.integrate_to(end, |row| keep(row.into()));
            }
        }
    }

    /// With friction, the momenta of a trajectory from those of the integrator, which have factors.
    fn damp(&self, row: &mut Trajectory, parameters: &[Vec<f64>]) {
        if !self.tapes.has_friction() {
            return;
        }
        let own = parameters.get(row.number).map_or(&[][..], Vec::as_slice);
        let own = Parameters::from(own);
        let damp = |time: f64, momenta: &mut [f64]| {
            let factors = self.tapes.factors(&own, time).unwrap_or_default();
            for (momentum, factor) in momenta.iter_mut().zip(factors) {
                *momentum *= factor;
            }
        };
        let dimension = row.state.q.len();
        damp(row.state.time, row.state.p.as_mut_slice());
        for numbers in row.output.chunks_exact_mut(1 + 2 * dimension) {
            damp(numbers[0], &mut numbers[1 + dimension..]);
        }
    }

    /// The end time, if it is given.
    pub(super) fn end(&self) -> f64 {
        let end = self.setup.end.as_ref();
        end.map_or(self.setup.start(), |end| *end.get_ref())
    }

    /// The file of the finished trajectories, and those of an interrupted run.
    fn resume(
        &self,
        starts: &[State<Vector>],
        parameters: &[Vec<f64>],
    ) -> Result<(Resume, Vec<Trajectory>), Error> {
        let states = starts.iter().map(State::as_slices);
        let numbers = states.flat_map(|(q, p)| q.iter().chain(p));
        let numbers = numbers.chain(parameters.iter().flatten());
        let origin = Origin {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            formula: self.setup.system.get_ref().clone(),
            method: self.method.definition.clone(),
            setup: self.file.text.to_owned(),
            part: self.arguments.shard.map(|shard| [shard.part, shard.count]),
            starts: checksum(numbers.flat_map(|x| x.to_bits().to_le_bytes())),
        };
        let interval = Duration::from_secs(self.arguments.save_every.into());
        Resume::open(self.target.path(), origin, interval, self.arguments.resume)
    }

    /// What to know about output times inside steps, if the method has a higher order than their interpolation.
    fn note_on_times(&self, is_separable: bool) -> Option<String> {
        let size = *self.setup.step_size.get_ref();
        let is_inside = |time: &f64| {
            let steps = (time - self.setup.start()) / size;
            (steps - steps.round()).abs() > 1e-9 * steps.abs().max(1.0)
        };
        let orders = self.method.tableau.orders();
        let order = if is_separable {
            orders.separable
        } else {
            orders.general
        };
        let inside = self
            .times
            .as_ref()?
            .iter()
            .filter(|time| is_inside(time))
            .count();
        (inside > 0 && order > INTERPOLATION).then(|| {
            format!(
                "note: {inside} of the `times` are inside steps, where states are interpolated with order {INTERPOLATION}; the method has order {order} at multiples of `step_size`\n"
            )
        })
    }

    /// The error for a start that is not on the constraints.
    fn off_constraints(&self, start: usize, name: Option<&ConstraintName>, how: &str) -> Error {
        let name = name.map_or(String::new(), |name| format!(" `{name}`"));
        let message = format!(
            "start {start} is not on the constraint{name}: {how}, but each must be 0; give other starts, by formulas if needed, or write \
             `project_starts = true`, which moves starts to the nearest ones on the constraints"
        );
        self.file.error(self.setup.starts.span(), message)
    }

    /// Translates an error of the ensemble into the terms of the file.
    fn refused(&self, error: &EnsembleError) -> Error {
        let accept = "take another method (`symplectic list --class …`), or write `accept_lower_order = true`";
        let span = self.setup.method.span();
        let name = self.method.tableau.name();
        match error {
            EnsembleError::Start {
                error: RunError::NotQuadraticKinetic { order, lower_order, .. },
                ..
            } => self.file.error(
                span,
                format!("`{name}` has order {order} if the kinetic energy is quadratic in the momenta, but for this H only {lower_order}: {accept}"),
            ),
            EnsembleError::Start { trajectory, error: RunError::InconsistentStart { name, value, rate, .. } } => self.off_constraints(
                *trajectory,
                name.as_ref(),
                &format!("|φ| = {value:e}, |dφ/dt| = {rate:e}"),
            ),
            EnsembleError::Start { trajectory, error: RunError::InconsistentVelocity { name, rate, .. } } => {
                self.off_constraints(*trajectory, name.as_ref(), &format!("|w·q'| = {rate:e}"))
            }
            EnsembleError::All(RunError::SeparableTableau { order, lower_order }) => self.file.error(
                span,
                format!("H is not separable, or a force depends on momenta: `{name}` has order {order} for separable H only, and for this H it has order {lower_order} or is not symplectic: {accept}"),
            ),
            other => self.file.error(self.setup.starts.span(), other.to_string()),
        }
    }
}

/// With more trajectories the finished ones show the progress.
const MANY: usize = 100_000;

/// The |energy error| above which a run warns, unless the file gives another.
const ENERGY_ERROR: f64 = 0.01;

/// The order of states inside steps.
const INTERPOLATION: u32 = Interpolation::Hermite.order();
