//! From a problem and a method to an ensemble of the right type.

use std::marker::PhantomData;
use std::sync::{Arc, OnceLock};

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use symplectic::at_run_time::RunTimeTableau;
use symplectic::constraints::{Constrained, Nonholonomic, consistent, consistent_momentum};
use symplectic::emitted::Solver;
use symplectic::ensemble::{Ensemble, EnsembleError};
use symplectic::nalgebra::DVector;
use symplectic::solver::Newton;
use symplectic::stepper::RemainingSteps;
use symplectic::system::{Class, Conservative};
use symplectic::{
    Compensated, Error, General, Hamiltonian, Method as Steps, ProvedFor, Retry, Separable, State,
};
use symplectic_tape::{Formula, Parameters, Watch};

use crate::emitted::{Emitted, ForEverySystem, OfMethod};
use crate::errors;
use crate::method::Method;
use crate::problem::Problem;
use crate::watch::Pulse;

pub(crate) type Vector = DVector<f64>;

/// Moves a state onto the constraints.
type Project<C> = fn(&Formula<C>, State<Vector>) -> Result<State<Vector>, Error>;

/// How a run is made.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Setting {
    pub(crate) step: f64,
    newton: bool,
    accept_lower_order: bool,
    project: bool,
    /// The number of halvings of a failed step.
    halvings: u32,
    threads: Option<usize>,
}

/// The starts of trajectories in rows, with the parameters of each that vary.
pub(crate) struct Starts<'a> {
    pub(crate) time: f64,
    pub(crate) q: &'a [f64],
    pub(crate) p: &'a [f64],
    pub(crate) varied: &'a [f64],
    pub(crate) count: usize,
}

impl<'a> Starts<'a> {
    pub(crate) fn new(
        time: f64,
        q: &'a PyReadonlyArray2<'_, f64>,
        p: &'a PyReadonlyArray2<'_, f64>,
        varied: &'a PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Self> {
        Ok(Starts {
            time,
            q: q.as_slice()?,
            p: p.as_slice()?,
            varied: varied.as_slice()?,
            count: q.as_array().nrows(),
        })
    }
}

impl Setting {
    /// The size of the equal steps from a time to the end.
    pub(crate) fn size(&self, time: f64, end: f64) -> f64 {
        let remaining = RemainingSteps::between(time, end, self.step);
        let next = remaining.ok().and_then(|remaining| remaining.next());
        next.map_or(self.step, |(size, _)| size)
    }
}

/// What is done with an ensemble of formulas.
pub(crate) trait Work: Send {
    type Output: Send;

    fn run<M, C, const F: bool, N>(
        self,
        ensemble: Ensemble<M, Formula<C, F>, Vector, Compensated, N>,
    ) -> Self::Output
    where
        M: Steps + Send + Sync,
        C: Class,
        Formula<C, F>: Hamiltonian<Class = C, Vector<f64> = Vector>,
        N: Solver<Vector, Formula<C, F>>;
}

/// Does work with the ensemble of a compiled method.
struct Compiled<'j, 'a, C, W> {
    job: &'j Job<'a>,
    work: W,
    class: PhantomData<fn() -> C>,
}

macro_rules! compiled {
    ($($class:ident)*) => {$(
        impl<W: Work> OfMethod for Compiled<'_, '_, $class, W> {
            type Output = Result<W::Output, Failure>;

            fn run<M: Steps + Copy + Send + Sync + ForEverySystem>(self, method: M) -> Self::Output {
                let families = self.job.families::<$class, false>();
                let ensemble = self.job.made(method, families)?;
                Ok(self.work.run(ensemble))
            }
        }
    )*};
}

compiled! { General Separable }

/// What is done with systems of H alone.
pub(crate) trait FreeWork: Send {
    type Output: Send;

    fn run<C: Class + Conservative>(
        self,
        job: &Job<'_>,
        newton: bool,
        families: Families<C, false>,
    ) -> Result<Self::Output, Failure>
    where
        Formula<C>: Hamiltonian<Class = C, Vector<f64> = Vector>;
}

/// Systems with their starts.
pub(crate) type Families<C, const F: bool> = Vec<(Formula<C, F>, Vec<State<Vector>>)>;

/// Why no ensemble can be made.
pub(crate) struct Failure(String);

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        errors::argument(failure.0)
    }
}

/// How far a run goes, and what is done beside its steps.
#[derive(Clone, Copy, Default)]
pub(crate) struct Effort {
    pub(crate) end: f64,
    /// The number of looks into every step.
    pub(crate) looks: f64,
    /// The number of states that are written.
    pub(crate) outputs: usize,
    /// Whether the progress is shown.
    pub(crate) is_shown: bool,
}

impl Effort {
    /// Steps to an end.
    pub(crate) fn to(end: f64) -> Self {
        Effort {
            end,
            ..Effort::default()
        }
    }
}

/// All that decides a run.
pub(crate) struct Job<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) method: RunTimeTableau,
    is_proved: bool,
    pub(crate) setting: &'a Setting,
    pub(crate) starts: Starts<'a>,
    pub(crate) pulse: Arc<Pulse>,
    is_shown: bool,
}

impl<'a> Job<'a> {
    pub(crate) fn new(
        problem: &'a Problem,
        method: &Method,
        setting: &'a Setting,
        starts: Starts<'a>,
        Effort {
            end,
            looks,
            outputs,
            is_shown,
        }: Effort,
    ) -> PyResult<Self> {
        let (dimension, width) = (problem.dimension, problem.varied);
        let Starts {
            q,
            p,
            varied,
            count,
            time,
        } = starts;
        let numbers = count.checked_mul(dimension);
        let fits = Some(q.len()) == numbers
            && Some(p.len()) == numbers
            && Some(varied.len()) == count.checked_mul(width);
        if !fits {
            return Err(errors::internal("starts of another dimension"));
        }
        if setting.project && problem.kind.holonomic.is_none() {
            return Err(errors::argument(
                "the system has no constraints, so starts are not projected: leave out `project_starts`",
            ));
        }
        if setting.newton && problem.kind.holonomic.is_some() {
            return Err(errors::argument(
                "steps with constraints have an iteration of their own: leave out `solver`",
            ));
        }
        if setting.newton && problem.kind.is_separable && method.tableau.is_explicit() {
            return Err(errors::argument(format!(
                "`{}` is explicit for this H, so its stages need no iteration: leave out `solver`, or take an implicit method",
                method.tableau.name()
            )));
        }
        let orders = method.tableau.orders();
        if problem.tapes.has_friction()
            && orders.nystrom > orders.separable
            && !setting.accept_lower_order
        {
            return Err(errors::argument(format!(
                "`{}` has order {} without friction, but only {} with it: take another method, or `accept_lower_order=True`",
                method.tableau.name(),
                orders.nystrom,
                orders.separable
            )));
        }
        // Coupled stages take some sweeps. Newton's iteration also solves linear systems.
        let stages = 4.0 * method.tableau.stages() as f64;
        let steps = ((end - time) / setting.step).abs() * (1.0 + looks) + outputs as f64;
        let operations = match setting.newton || count > 1 {
            true => f64::INFINITY,
            false => steps * stages * problem.tapes.operations() as f64,
        };
        let pulse = Pulse::new(time, operations);
        let tableau = method.tableau.clone();
        Ok(Job {
            problem,
            is_shown,
            is_proved: method.is_proved,
            method: match setting.accept_lower_order {
                true => tableau.accept_lower_order(),
                false => tableau,
            },
            setting,
            starts,
            pulse,
        })
    }

    /// Does work with the ensemble of the starts.
    pub(crate) fn run<W: Work>(&self, work: W) -> Result<W::Output, Failure> {
        self.on_threads(|| self.of_kind(work))
    }

    /// Does work with systems of H alone.
    pub(crate) fn run_free<W: FreeWork>(&self, work: W) -> Result<W::Output, Failure> {
        let newton = self.setting.newton;
        self.on_threads(|| match self.problem.kind.is_separable {
            true => work.run::<Separable>(self, newton, self.families()),
            false => work.run::<General>(self, newton, self.families()),
        })
    }

    fn on_threads<T: Send>(
        &self,
        work: impl FnOnce() -> Result<T, Failure> + Send,
    ) -> Result<T, Failure> {
        // The threads of all work stay in the process that started them.
        static FIRST: OnceLock<u32> = OnceLock::new();
        let is_forked = *FIRST.get_or_init(std::process::id) != std::process::id();
        let threads = match self.setting.threads {
            None if self.starts.count == 1 || !is_forked => return work(),
            threads => threads.unwrap_or_default(),
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build();
        let pool = pool.map_err(|error| Failure(format!("cannot start the threads: {error}")))?;
        pool.install(work)
    }

    fn of_kind<W: Work>(&self, work: W) -> Result<W::Output, Failure> {
        let kind = self.problem.kind;
        if let Some(emitted) = self.emitted() {
            return match kind.is_separable {
                true => emitted.with(Compiled::<Separable, W> {
                    job: self,
                    work,
                    class: PhantomData,
                }),
                false => emitted.with(Compiled::<General, W> {
                    job: self,
                    work,
                    class: PhantomData,
                }),
            };
        }
        match (kind.holonomic, kind.is_separable, kind.is_forced) {
            (Some(true), true, _) => self.holonomic::<Separable, W>(work),
            (Some(true), false, _) => self.holonomic::<General, W>(work),
            (Some(false), true, _) => self.nonholonomic::<Separable, W>(work),
            (Some(false), false, _) => self.nonholonomic::<General, W>(work),
            (None, true, true) => self.by_solver::<Separable, true, W>(work),
            (None, false, true) => self.by_solver::<General, true, W>(work),
            (None, true, false) => self.by_solver::<Separable, false, W>(work),
            (None, false, false) => self.by_solver::<General, false, W>(work),
        }
    }

    /// The method, if it is compiled into this module for the kind of system.
    fn emitted(&self) -> Option<Emitted> {
        let kind = self.problem.kind;
        let is_plain =
            self.is_proved && kind.holonomic.is_none() && !kind.is_forced && !self.setting.newton;
        is_plain.then(|| Emitted::of(&self.method)).flatten()
    }

    fn by_solver<C: Class + Conservative, const F: bool, W: Work>(
        &self,
        work: W,
    ) -> Result<W::Output, Failure>
    where
        Formula<C, F>: Hamiltonian<Class = C, Vector<f64> = Vector>,
    {
        let ensemble = self.made(self.method.clone(), self.families::<C, F>())?;
        Ok(match self.setting.newton {
            false => work.run(ensemble),
            true => work.run(ensemble.with_solver(<Newton>::new())),
        })
    }

    fn holonomic<C, W: Work>(&self, work: W) -> Result<W::Output, Failure>
    where
        C: Class + symplectic::system::Unconstrained,
    {
        let families = self.projected::<Constrained<C>>(consistent)?;
        Ok(work.run(self.made(self.method.clone(), families)?))
    }

    fn nonholonomic<C, W: Work>(&self, work: W) -> Result<W::Output, Failure>
    where
        C: Class + symplectic::system::Unconstrained,
    {
        let families = self.projected::<Nonholonomic<C>>(consistent_momentum)?;
        Ok(work.run(self.made(self.method.clone(), families)?))
    }

    /// An ensemble of systems.
    pub(crate) fn made<M, S>(
        &self,
        method: M,
        families: impl IntoIterator<Item = (S, Vec<State<Vector>>)>,
    ) -> Result<Ensemble<M, S, Vector>, Failure>
    where
        M: Steps + ProvedFor<S::Class>,
        S: symplectic::System<Vector>,
    {
        let made = Ensemble::of_families(method, families, self.setting.step);
        let mut ensemble = made.map_err(|error| self.refused(&error))?;
        if self.setting.halvings > 0 {
            ensemble.set_retry(Retry::Split {
                halvings: self.setting.halvings,
            });
        }
        let pulse = Arc::clone(&self.pulse);
        ensemble.stop_if(move || pulse.is_stopped());
        Ok(ensemble)
    }

    /// The systems of the starts: one for all trajectories with the same parameters.
    fn families<C, const F: bool>(&self) -> Families<C, F> {
        let Starts {
            time,
            q,
            p,
            varied,
            count,
        } = self.starts;
        let (dimension, width) = (self.problem.dimension, self.problem.varied);
        let mut families: Families<C, F> = Vec::new();
        let bits = |row: &[f64]| row.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let mut last: Option<Vec<u64>> = None;
        for row in 0..count {
            let part = |all: &[f64]| {
                Vector::from_column_slice(&all[row * dimension..(row + 1) * dimension])
            };
            let state = State::new(time, part(q), part(p));
            let own = &varied[row * width..(row + 1) * width];
            let is_same = last.as_ref().is_some_and(|last| *last == bits(own));
            match families.last_mut() {
                Some((_, family)) if is_same => family.push(state),
                _ => {
                    let system =
                        Formula::new(Arc::clone(&self.problem.tapes), Parameters::from(own));
                    // Of many trajectories the finished ones show the progress.
                    let watch: Option<Arc<dyn Watch>> = match self.is_shown && count == 1 {
                        true => Some(Arc::<Pulse>::clone(&self.pulse)),
                        false => None,
                    };
                    let system = system
                        .watched(watch)
                        .stopped_by(Arc::clone(&self.pulse.stop));
                    families.push((system, vec![state]));
                    last = Some(bits(own));
                }
            }
        }
        families
    }

    /// The systems with their starts on the constraints, if that is wanted.
    fn projected<C>(&self, project: Project<C>) -> Result<Families<C, false>, Failure> {
        let mut families = self.families::<C, false>();
        if !self.setting.project {
            return Ok(families);
        }
        let all = families.iter_mut();
        let all = all.flat_map(|(system, starts)| starts.iter_mut().map(|start| (&*system, start)));
        for (number, (system, start)) in all.enumerate() {
            *start = project(system, start.clone())
                .map_err(|error| Failure(format!("start {number}: {error}")))?;
        }
        Ok(families)
    }

    /// Translates an error of the ensemble into terms of Python.
    fn refused(&self, error: &EnsembleError) -> Failure {
        let accept = "take another method, or `accept_lower_order=True`";
        let name = self.method.name();
        let off = |start: usize, constraint: Option<String>, how: String| {
            format!(
                "start {start} is not on the constraint{}: {how}, but each must be 0; give other starts, or `project_starts=True`, which \
                 moves starts to the nearest ones on the constraints",
                constraint.unwrap_or_default()
            )
        };
        Failure(match error {
            EnsembleError::Start {
                error:
                    Error::NotQuadraticKinetic {
                        order, lower_order, ..
                    },
                ..
            } => format!(
                "`{name}` has order {order} if the kinetic energy is quadratic in the momenta, but for this H only {lower_order}: {accept}"
            ),
            EnsembleError::Start {
                trajectory,
                error:
                    Error::InconsistentStart {
                        name, value, rate, ..
                    },
            } => off(
                *trajectory,
                name.as_ref().map(|name| format!(" `{name}`")),
                format!("|φ| = {value:e}, |dφ/dt| = {rate:e}"),
            ),
            EnsembleError::Start {
                trajectory,
                error: Error::InconsistentVelocity { name, rate, .. },
            } => off(
                *trajectory,
                name.as_ref().map(|name| format!(" `{name}`")),
                format!("|w·q'| = {rate:e}"),
            ),
            EnsembleError::All(Error::SeparableTableau { order, lower_order }) => format!(
                "H is not separable, or a force depends on momenta: `{name}` has order {order} for separable H only, and for this H it has \
                 order {lower_order} or is not symplectic: {accept}"
            ),
            // A single start needs no number.
            EnsembleError::Start { error, .. } if self.starts.count == 1 => error.to_string(),
            other => other.to_string(),
        })
    }
}
