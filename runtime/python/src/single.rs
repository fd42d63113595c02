//! Trajectories one by one: output at any time and events.

use std::ops::ControlFlow;

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use symplectic::emitted::Solver;
use symplectic::ensemble::{Ensemble, Row};
use symplectic::output::Moment;
use symplectic::stepper::RemainingSteps;
use symplectic::system::Class;
use symplectic::{Compensated, Error, Hamiltonian, Integrator, Method as Steps, State, Statistics};
use symplectic_tape::{Formula, Parameters, Tapes};

use crate::errors;
use crate::events::{Events, Given};
use crate::method::Method;
use crate::problem::Problem;
use crate::watch::{Pulse, guarded};
use crate::work::{Effort, Job, Setting, Starts, Vector, Work};

/// When states are written.
#[derive(FromPyObject)]
pub(crate) enum Output {
    /// At these times.
    Times(Vec<f64>),
    /// After steps, equally far from each other, with at most this number of states; 0 for the end only.
    Steps(usize),
}

/// States in rows.
#[derive(Default)]
pub(crate) struct Rows {
    pub(crate) t: Vec<f64>,
    pub(crate) q: Vec<f64>,
    pub(crate) p: Vec<f64>,
}

impl Rows {
    fn with_capacity(count: usize, dimension: usize) -> Self {
        Rows {
            t: Vec::with_capacity(count),
            q: Vec::with_capacity(count * dimension),
            p: Vec::with_capacity(count * dimension),
        }
    }

    /// Adds a state; with friction, the momenta of the system from those of the integrator.
    fn add(&mut self, state: &State<Vector>, (tapes, parameters): (&Tapes, &Parameters)) {
        self.t.push(state.time);
        self.q.extend_from_slice(state.q.as_slice());
        let factors = tapes.factors(parameters, state.time);
        match factors {
            None => self.p.extend_from_slice(state.p.as_slice()),
            Some(factors) => {
                let damped = state.p.iter().zip(factors).map(|(p, factor)| p * factor);
                self.p.extend(damped);
            }
        }
    }

    /// The arrays `t`, `q` and `p`.
    pub(crate) fn arrays<'py>(self, py: Python<'py>, dimension: usize) -> PyResult<Arrays<'py>> {
        let count = self.t.len();
        let shaped = |list: Vec<f64>| list.into_pyarray(py).reshape([count, dimension]);
        let (q, p) = (shaped(self.q)?, shaped(self.p)?);
        Ok((self.t.into_pyarray(py), q, p))
    }
}

/// Times, positions and momenta.
type Arrays<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
);

/// What a trajectory leaves.
#[derive(Default)]
pub(crate) struct Seen {
    pub(crate) output: Rows,
    pub(crate) events: Rows,
    /// The number of the event of each row of `events`.
    pub(crate) indices: Vec<u32>,
    /// Whether there are more events than may be kept.
    pub(crate) is_full: bool,
}

/// Where a run goes, and what is written on the way.
pub(crate) struct Plan<'a> {
    pub(crate) end: f64,
    pub(crate) output: &'a Output,
    pub(crate) events: &'a Events,
    pub(crate) tapes: &'a Tapes,
    /// The largest number of states at events.
    pub(crate) most: usize,
    pub(crate) pulse: &'a Pulse,
}

impl Plan<'_> {
    /// Integrates to the end.
    fn walk<M, C, N, const F: bool>(
        &self,
        seen: &mut Seen,
        run: &mut Integrator<M, Formula<C, F>, Vector, Compensated, N>,
    ) -> Result<(), Error>
    where
        M: Steps,
        C: Class,
        Formula<C, F>: Hamiltonian<Class = C, Vector<f64> = Vector>,
        N: Solver<Vector, Formula<C, F>>,
    {
        let parameters = run.system().parameters().clone();
        let with = (self.tapes, &parameters);
        let dimension = run.state().q.len();
        let steps;
        let times = match self.output {
            Output::Times(times) => times,
            Output::Steps(most) => {
                steps = step_times(run, self.end, *most)?;
                &steps
            }
        };
        seen.output = Rows::with_capacity(times.len(), dimension);
        if times.is_empty() && self.events.is_empty() {
            return run.integrate_to(self.end).map(|_| ());
        }
        run.set_output_by_steps(true);
        let list = self.events.list(&parameters);
        let mut counts = vec![0; list.len()];
        // The state of an event that ends the run is its last one.
        let mut last = None;
        let ended = run.integrate_through(self.end, times, &list, |moment| {
            let (index, state) = match moment {
                Moment::Output(state) => {
                    seen.output.add(state, with);
                    return match self.pulse.is_stopped() {
                        true => ControlFlow::Break(()),
                        false => ControlFlow::Continue(()),
                    };
                }
                Moment::Event { index, state } => (index, state),
            };
            if seen.indices.len() >= self.most {
                seen.is_full = true;
                return ControlFlow::Break(());
            }
            seen.events.add(state, with);
            seen.indices.push(index as u32);
            self.events.change(index, &parameters, state);
            counts[index] += 1;
            match self.events.ends(index, counts[index]) {
                true => {
                    last = Some(state.clone());
                    ControlFlow::Break(())
                }
                false => ControlFlow::Continue(()),
            }
        });
        ended?;
        last.map_or(Ok(()), |state| run.set_state(state))
    }
}

/// The times after steps, equally far from each other.
fn step_times<M, C, N, const F: bool>(
    run: &Integrator<M, Formula<C, F>, Vector, Compensated, N>,
    end: f64,
    most: usize,
) -> Result<Vec<f64>, Error>
where
    M: Steps,
    C: Class,
    Formula<C, F>: Hamiltonian<Class = C, Vector<f64> = Vector>,
    N: Solver<Vector, Formula<C, F>>,
{
    let Some(intervals) = most.checked_sub(1).filter(|&intervals| intervals > 0) else {
        return Ok(Vec::new());
    };
    let mut remaining = run.steps_to_time(end)?;
    let stride = remaining.left().div_ceil(intervals as u64).max(1);
    let mut times = vec![run.state().time];
    while remaining.left() > 0 {
        remaining.skip(stride.min(remaining.left()) - 1);
        times.extend(remaining.next().map(|(_, time)| time));
        remaining.tick();
    }
    Ok(times)
}

/// Integrates each trajectory alone.
pub(crate) struct OneByOne<'a>(pub(crate) Plan<'a>);

impl Work for OneByOne<'_> {
    type Output = Vec<Row<Vector, Seen>>;

    fn run<M, C, const F: bool, N>(
        self,
        ensemble: Ensemble<M, Formula<C, F>, Vector, Compensated, N>,
    ) -> Self::Output
    where
        M: Steps + Send + Sync,
        C: Class,
        Formula<C, F>: Hamiltonian<Class = C, Vector<f64> = Vector>,
        N: Solver<Vector, Formula<C, F>>,
    {
        let mut rows = Vec::new();
        let work = |seen: &mut Seen, run: &mut _| self.0.walk(seen, run);
        ensemble.each(
            |_| Seen::default(),
            work,
            |row| {
                let finished = &self.0.pulse.finished;
                finished.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                rows.push(row);
                ControlFlow::Continue(())
            },
        );
        rows
    }
}

/// Checks that states in rows fit into memory.
pub(crate) fn reserve(rows: usize, dimension: usize) -> PyResult<()> {
    let numbers = rows.checked_mul(2 * dimension + 1);
    let fits = numbers.is_some_and(|numbers| Vec::<f64>::new().try_reserve_exact(numbers).is_ok());
    match fits {
        true => Ok(()),
        false => Err(PyMemoryError::new_err(
            "the output does not fit into memory: give fewer times, or write a file with `run_file`",
        )),
    }
}

/// The counts of a run by name.
pub(crate) fn statistics<'py>(
    py: Python<'py>,
    statistics: &Statistics,
) -> PyResult<Bound<'py, PyDict>> {
    let Statistics {
        steps,
        rejected,
        iterations,
        most_iterations,
        evaluations,
        factorisations,
        largest_residual,
    } = *statistics;
    let dict = PyDict::new(py);
    dict.set_item("steps", steps)?;
    dict.set_item("rejected", rejected)?;
    dict.set_item("iterations", iterations)?;
    dict.set_item("most_iterations", most_iterations)?;
    dict.set_item("evaluations", evaluations)?;
    dict.set_item("factorisations", factorisations)?;
    dict.set_item("largest_residual", largest_residual)?;
    Ok(dict)
}

/// The trajectory of a start: a dictionary with the states at the output times and at events, the last state, the counts, the error of a
/// step that failed, and the exception of a signal.
#[pyfunction]
#[pyo3(signature = (problem, method, setting, time, q, p, varied, end, output, events, progress))]
#[allow(clippy::too_many_arguments)]
pub(crate) fn integrate<'py>(
    py: Python<'py>,
    problem: &Problem,
    method: &Method,
    setting: Setting,
    time: f64,
    q: PyReadonlyArray2<'py, f64>,
    p: PyReadonlyArray2<'py, f64>,
    varied: PyReadonlyArray2<'py, f64>,
    end: f64,
    output: Output,
    events: Vec<Given>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let events = Events::new(problem, events)?;
    let starts = Starts::new(time, &q, &p, &varied)?;
    let outputs = match &output {
        Output::Times(times) => times.len(),
        Output::Steps(most) => {
            let remaining = RemainingSteps::between(time, end, setting.step);
            let steps = remaining.map_or(0, |remaining| remaining.left());
            (*most).min(
                usize::try_from(steps)
                    .unwrap_or(usize::MAX)
                    .saturating_add(1),
            )
        }
    };
    reserve(outputs, problem.dimension)?;
    let effort = Effort {
        end,
        looks: events.looks(),
        outputs,
        is_shown: progress.is_some(),
    };
    let job = Job::new(problem, method, &setting, starts, effort)?;
    let work = OneByOne(Plan {
        end,
        output: &output,
        events: &events,
        tapes: &problem.tapes,
        most: usize::MAX,
        pulse: &job.pulse,
    });
    let (rows, interrupted) = guarded(py, &job.pulse, progress.as_ref(), || job.run(work))?;
    let row = rows?.pop();
    let found = PyDict::new(py);
    let Some(Row {
        outcome,
        state,
        statistics: counts,
        output: seen,
        ..
    }) = row
    else {
        let signal = interrupted.unwrap_or_else(|| errors::internal("the run has no result"));
        return Err(signal);
    };
    let (t, q, p) = seen.output.arrays(py, problem.dimension)?;
    found.set_item("t", t)?;
    found.set_item("q", q)?;
    found.set_item("p", p)?;
    let (t, q, p) = seen.events.arrays(py, problem.dimension)?;
    found.set_item("event_t", t)?;
    found.set_item("event_q", q)?;
    found.set_item("event_p", p)?;
    found.set_item("event_index", seen.indices.into_pyarray(py))?;
    let mut last = Rows::default();
    let own = Parameters::from(varied.as_slice()?);
    last.add(&state, (&problem.tapes, &own));
    found.set_item(
        "state",
        (last.t[0], last.q.into_pyarray(py), last.p.into_pyarray(py)),
    )?;
    found.set_item("statistics", statistics(py, &counts)?)?;
    // Whether an event ended it.
    found.set_item("ended", outcome.is_ok() && state.time != end)?;
    found.set_item("step", setting.size(time, end))?;
    let error = outcome.err().filter(|_| interrupted.is_none());
    found.set_item(
        "error",
        error.map(|error| errors::step(&error).into_value(py)),
    )?;
    found.set_item(
        "interrupted",
        interrupted.map(|signal| signal.into_value(py)),
    )?;
    Ok(found)
}
