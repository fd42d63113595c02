//! Methods on a problem, with their types erased.

use core::hint::black_box;
use core::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::{Kind, Ladder, MethodRecord};
use symplectic::solver::Solver;
use symplectic::{Error, Integrator, Method, State, Statistics, Summation, System, Vector};

/// A callback for the states of a run.
pub type Observe<'a, V> = &'a mut dyn FnMut(&State<V>);

/// The end of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Finish<V> {
    /// The state at the end.
    pub state: State<V>,
    /// Number of steps, if known.
    pub steps: Option<u64>,
    /// Number of evaluations of velocity and force, counted separately: two per evaluation of a first-order system.
    pub evaluations: u64,
    /// Total number of iterations; 0 for an explicit method.
    pub iterations: u64,
    /// Largest number of iterations of a step.
    pub most_iterations: u32,
}

impl<V> Finish<V> {
    /// The end of a run by an explicit method.
    pub const fn explicit(state: State<V>, steps: Option<u64>, evaluations: u64) -> Self {
        Self {
            state,
            steps,
            evaluations,
            iterations: 0,
            most_iterations: 0,
        }
    }

    fn new(state: State<V>, statistics: &Statistics) -> Self {
        Self {
            state,
            steps: Some(statistics.steps),
            evaluations: statistics.evaluations,
            iterations: statistics.iterations,
            most_iterations: statistics.most_iterations,
        }
    }
}

/// Why a run did not reach the end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// It failed with this error.
    Failed(String),
    /// It took too long.
    TooLong,
}

type Observed<V> = dyn Fn(f64, Duration, Observe<'_, V>) -> Result<Finish<V>, Stop>;

/// A method on a problem.
pub(super) struct Contestant<V> {
    pub name: String,
    pub ladder: Ladder,
    is_peer: bool,
    definition: Option<&'static str>,
    stages: Option<usize>,
    observed: Box<Observed<V>>,
    bare: Box<dyn Fn(f64)>,
}

impl<V: Vector> Contestant<V> {
    pub fn of_integrator<M, S, R, N>(
        name: String,
        ladder: Ladder,
        end: f64,
        make: impl Fn(f64) -> Result<Integrator<M, S, V, R, N>, Error> + Clone + 'static,
    ) -> Self
    where
        M: Method,
        S: System<V> + 'static,
        R: Summation + 'static,
        N: Solver<V, S> + 'static,
    {
        let make_bare = make.clone();
        let observed = move |step_size, limit, observe: Observe<'_, V>| {
            run_observed(make(step_size), end, limit, observe)
        };
        let bare = move |step_size| {
            let run = || make_bare(step_size)?.integrate_to(end).cloned();
            // A failure here was already reported by the observed run.
            let _end = black_box(run());
        };
        Self {
            name,
            ladder,
            is_peer: false,
            definition: Some(M::DEFINITION),
            stages: Some(M::STAGES),
            observed: Box::new(observed),
            bare: Box::new(bare),
        }
    }

    pub fn of_peer(
        name: String,
        ladder: Ladder,
        integrate: impl Fn(f64, Option<Observe<'_, V>>) -> Result<Finish<V>, String> + 'static,
    ) -> Self {
        let integrate = std::rc::Rc::new(integrate);
        let integrate_bare = integrate.clone();
        let observed = move |parameter, _limit, observe: Observe<'_, V>| {
            integrate(parameter, Some(observe)).map_err(Stop::Failed)
        };
        let bare = move |parameter| {
            let _end = black_box(integrate_bare(parameter, None));
        };
        Self {
            name,
            ladder,
            is_peer: true,
            definition: None,
            stages: None,
            observed: Box::new(observed),
            bare: Box::new(bare),
        }
    }

    /// A run that passes its states to `observe`. A run of an integrator is stopped after `limit`.
    pub fn run_observed(
        &self,
        parameter: f64,
        limit: Duration,
        observe: Observe<'_, V>,
    ) -> Result<Finish<V>, Stop> {
        (self.observed)(parameter, limit, observe)
    }

    /// The same run without observation, for timing.
    pub fn run_bare(&self, parameter: f64) {
        (self.bare)(parameter);
    }

    /// The record of the method before any run.
    pub fn record(&self) -> MethodRecord {
        MethodRecord {
            name: self.name.clone(),
            kind: if self.is_peer {
                Kind::Peer
            } else {
                Kind::Explicit
            },
            definition: self.definition.map(Into::into),
            stages: self.stages,
            facts: Vec::new(),
        }
    }
}

/// Number of steps between checks of the time limit.
const WATCH: u64 = 64;

fn run_observed<M, S, V, R, N>(
    integrator: Result<Integrator<M, S, V, R, N>, Error>,
    end: f64,
    limit: Duration,
    observe: Observe<'_, V>,
) -> Result<Finish<V>, Stop>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    let failed = |error: Error| Stop::Failed(error.to_string());
    let mut integrator = integrator.map_err(failed)?;
    let begin = Instant::now();
    let stopped = integrator.integrate_while(end, |progress| {
        observe(progress.state);
        if progress.step % WATCH == 0 && begin.elapsed() > limit {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    match stopped.map_err(failed)? {
        Some(()) => Err(Stop::TooLong),
        None => Ok(Finish::new(
            integrator.state().clone(),
            integrator.statistics(),
        )),
    }
}
