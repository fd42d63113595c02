//! Many trajectories at once: in SIMD lanes and on all cores.

use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::Ordering;

use numpy::{IntoPyArray, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use symplectic::at_run_time::RunTimeTableau;
use symplectic::emitted::Solver;
use symplectic::ensemble::{Ensemble, Row};
use symplectic::solver::Newton;
use symplectic::system::{Class, Conservative};
use symplectic::tangent::{self, Megno, Tangent};
use symplectic::{Compensated, Hamiltonian, Integrator, Method as Steps, State, Statistics};
use symplectic_tape::{Formula, Parameters};

use crate::errors;
use crate::events::{Events, Given};
use crate::method::Method;
use crate::problem::Problem;
use crate::single::{OneByOne, Output, Plan, Seen, reserve};
use crate::watch::{Pulse, guarded};
use crate::work::{Effort, Failure, Families, FreeWork, Job, Setting, Starts, Vector, Work};

/// The largest number of states at events of all trajectories.
const MOST_EVENTS: usize = 100_000_000;

/// The states of all trajectories at their ends, their counts and failures.
#[derive(Default)]
struct Ends {
    t: Vec<f64>,
    q: Vec<f64>,
    p: Vec<f64>,
    statistics: Vec<Statistics>,
    failures: Vec<(usize, String, &'static str)>,
}

impl Ends {
    fn with_capacity(count: usize, dimension: usize) -> Self {
        Ends {
            t: Vec::with_capacity(count),
            q: Vec::with_capacity(count * dimension),
            p: Vec::with_capacity(count * dimension),
            statistics: Vec::with_capacity(count),
            failures: Vec::new(),
        }
    }

    fn add<A>(&mut self, row: &Row<Vector, A>) {
        self.add_state(&row.state, row.statistics);
        if let Err(error) = &row.outcome {
            let message = errors::in_python(error);
            self.failures
                .push((row.trajectory, message, errors::kind(error)));
        }
    }

    fn add_state(&mut self, state: &State<Vector>, statistics: Statistics) {
        self.t.push(state.time);
        self.q.extend_from_slice(state.q.as_slice());
        self.p.extend_from_slice(state.p.as_slice());
        self.statistics.push(statistics);
    }

    /// Sets the arrays `end_t`, `end_q`, `end_p`, the counts and the failures.
    fn write<'py>(
        mut self,
        py: Python<'py>,
        found: &Bound<'py, PyDict>,
        dimension: usize,
        interrupted: Option<PyErr>,
    ) -> PyResult<()> {
        if interrupted.is_some() {
            for (_, message, kind) in &mut self.failures {
                *message = "the run was interrupted".to_owned();
                *kind = "interrupted";
            }
        }
        found.set_item(
            "interrupted",
            interrupted.map(|signal| signal.into_value(py)),
        )?;
        let count = self.t.len();
        let shaped = |list: Vec<f64>| list.into_pyarray(py).reshape([count, dimension]);
        found.set_item("end_t", self.t.into_pyarray(py))?;
        found.set_item("end_q", shaped(self.q)?)?;
        found.set_item("end_p", shaped(self.p)?)?;
        let counts = PyDict::new(py);
        let column = |of: fn(&Statistics) -> u64| {
            let column: Vec<u64> = self.statistics.iter().map(of).collect();
            column.into_pyarray(py)
        };
        counts.set_item("steps", column(|row| row.steps))?;
        counts.set_item("iterations", column(|row| row.iterations))?;
        counts.set_item("evaluations", column(|row| row.evaluations))?;
        counts.set_item("rejected", column(|row| row.rejected))?;
        found.set_item("statistics", counts)?;
        found.set_item("failures", self.failures)
    }
}

/// Multiplies the momenta of states in rows by the factors of friction.
fn damp(
    problem: &Problem,
    varied: &[f64],
    times: impl Fn(usize) -> f64,
    momenta: &mut [f64],
    rows_of_trajectory: usize,
) {
    if !problem.tapes.has_friction() {
        return;
    }
    let width = problem.varied;
    for (row, momenta) in momenta.chunks_exact_mut(problem.dimension).enumerate() {
        let trajectory = row / rows_of_trajectory;
        let own = Parameters::from(&varied[trajectory * width..][..width]);
        let factors = problem.tapes.factors(&own, times(row)).unwrap_or_default();
        for (momentum, factor) in momenta.iter_mut().zip(factors) {
            *momentum *= factor;
        }
    }
}

/// The place of a trajectory in the arrays of the output.
struct Place<'a> {
    q: &'a mut [f64],
    p: &'a mut [f64],
    row: usize,
}

/// Integrates to the end, or at times into arrays.
struct InLanes<'a> {
    end: f64,
    times: &'a [f64],
    places: Vec<Mutex<Option<Place<'a>>>>,
    dimension: usize,
    pulse: &'a Pulse,
}

impl Work for InLanes<'_> {
    type Output = Ends;

    fn run<M, C, const F: bool, N>(
        self,
        ensemble: Ensemble<M, Formula<C, F>, Vector, Compensated, N>,
    ) -> Ends
    where
        M: Steps + Send + Sync,
        C: Class,
        Formula<C, F>: Hamiltonian<Class = C, Vector<f64> = Vector>,
        N: Solver<Vector, Formula<C, F>>,
    {
        let dimension = self.dimension;
        let mut ends = Ends::with_capacity(ensemble.starts().len(), dimension);
        let finished = &self.pulse.finished;
        if self.times.is_empty() {
            ensemble.integrate_to(self.end, |row| {
                finished.fetch_add(1, Ordering::Relaxed);
                ends.add(&row);
                ControlFlow::Continue(())
            });
            return ends;
        }
        let place = |trajectory: usize| {
            self.places
                .get(trajectory)
                .and_then(|place| place.lock().ok()?.take())
        };
        let see = |place: &mut Option<Place<'_>>, state: &State<Vector>| {
            let Some(Place { q, p, row }) = place else {
                return;
            };
            let range = *row * dimension..(*row + 1) * dimension;
            if let (Some(q), Some(p)) = (q.get_mut(range.clone()), p.get_mut(range)) {
                q.copy_from_slice(state.q.as_slice());
                p.copy_from_slice(state.p.as_slice());
            }
            *row += 1;
        };
        ensemble.integrate_at(self.times, place, see, |row| {
            finished.fetch_add(1, Ordering::Relaxed);
            ends.add(&row);
            ControlFlow::Continue(())
        });
        ends
    }
}

/// Trajectories of many starts: their ends, and with `times` the states there in arrays of shape (n, times, dimension).
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn ensemble<'py>(
    py: Python<'py>,
    problem: &Problem,
    method: &Method,
    setting: Setting,
    time: f64,
    q: PyReadonlyArray2<'py, f64>,
    p: PyReadonlyArray2<'py, f64>,
    varied: PyReadonlyArray2<'py, f64>,
    end: f64,
    times: Vec<f64>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let starts = Starts::new(time, &q, &p, &varied)?;
    let (count, varied) = (starts.count, starts.varied);
    let dimension = problem.dimension;
    let width = times.len() * dimension;
    let size = count.saturating_mul(width);
    reserve(size.div_ceil(dimension), dimension)?;
    // Output times are in equal steps to the end, as without output.
    let mut setting = setting;
    let mut seen = times.clone();
    if let Some(&last) = times.last() {
        setting.step = setting.size(time, end);
        if last != end {
            seen.push(end);
        }
    }
    let job = Job::new(problem, method, &setting, starts, Effort::to(end))?;
    // A state that is not reached stays NaN.
    let (mut all_q, mut all_p) = (vec![f64::NAN; size], vec![f64::NAN; size]);
    let chunks = all_q.chunks_exact_mut(width.max(1));
    let chunks = chunks.zip(all_p.chunks_exact_mut(width.max(1)));
    let places = chunks.map(|(q, p)| Mutex::new(Some(Place { q, p, row: 0 })));
    let work = InLanes {
        end,
        times: &seen,
        places: places.collect(),
        dimension,
        pulse: &job.pulse,
    };
    let (ends, interrupted) = guarded(py, &job.pulse, progress.as_ref(), || job.run(work))?;
    let mut ends = ends?;
    let rows = times.len().max(1);
    damp(problem, varied, |row| ends.t[row], &mut ends.p, 1);
    damp(problem, varied, |row| times[row % rows], &mut all_p, rows);
    let found = PyDict::new(py);
    if !times.is_empty() {
        let shape = [count, times.len(), dimension];
        found.set_item("q", all_q.into_pyarray(py).reshape(shape)?)?;
        found.set_item("p", all_p.into_pyarray(py).reshape(shape)?)?;
    }
    ends.write(py, &found, dimension, interrupted)?;
    Ok(found)
}

/// Trajectories with the states at events: these one after another, with the number of states of each trajectory.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn section<'py>(
    py: Python<'py>,
    problem: &Problem,
    method: &Method,
    setting: Setting,
    time: f64,
    q: PyReadonlyArray2<'py, f64>,
    p: PyReadonlyArray2<'py, f64>,
    varied: PyReadonlyArray2<'py, f64>,
    end: f64,
    events: Vec<Given>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let events = Events::new(problem, events)?;
    let starts = Starts::new(time, &q, &p, &varied)?;
    let count = starts.count;
    let job = Job::new(problem, method, &setting, starts, Effort::to(end))?;
    let output = Output::Steps(0);
    let most = MOST_EVENTS / count.max(1);
    let work = OneByOne(Plan {
        end,
        output: &output,
        events: &events,
        tapes: &problem.tapes,
        most,
        pulse: &job.pulse,
    });
    let (rows, interrupted) = guarded(py, &job.pulse, progress.as_ref(), || job.run(work))?;
    let rows = rows?;
    let dimension = problem.dimension;
    let mut ends = Ends::with_capacity(rows.len(), dimension);
    let mut all = Seen::default();
    let mut counts = Vec::with_capacity(rows.len());
    for row in rows {
        ends.add(&row);
        if row.output.is_full {
            let message =
                format!("it has more than {most} events: give fewer starts, or an earlier end");
            ends.failures
                .push((row.trajectory, message, "too many events"));
        }
        counts.push(row.output.indices.len() as u64);
        all.events.t.extend(row.output.events.t);
        all.events.q.extend(row.output.events.q);
        all.events.p.extend(row.output.events.p);
        all.indices.extend(row.output.indices);
    }
    damp(
        problem,
        varied.as_slice()?,
        |row| ends.t[row],
        &mut ends.p,
        1,
    );
    let found = PyDict::new(py);
    let (t, q, p) = all.events.arrays(py, dimension)?;
    found.set_item("event_t", t)?;
    found.set_item("event_q", q)?;
    found.set_item("event_p", p)?;
    found.set_item("event_index", all.indices.into_pyarray(py))?;
    found.set_item("counts", counts.into_pyarray(py))?;
    ends.write(py, &found, dimension, interrupted)?;
    Ok(found)
}

/// A system with its variational equations: one row of displacements for each start.
struct Displaced<'a, W> {
    displacements: &'a [f64],
    work: W,
}

/// What is done with tangent systems.
trait TangentWork: Send {
    type Output: Send;

    fn run<C: Class + Conservative, N: Solver<Vector, Tangent<Formula<C>>>>(
        self,
        ensemble: Ensemble<RunTimeTableau, Tangent<Formula<C>>, Vector, Compensated, N>,
    ) -> Self::Output
    where
        Formula<C>: Hamiltonian<Class = C, Vector<f64> = Vector>;
}

impl<W: TangentWork> FreeWork for Displaced<'_, W> {
    type Output = W::Output;

    fn run<C: Class + Conservative>(
        self,
        job: &Job<'_>,
        newton: bool,
        families: Families<C, false>,
    ) -> Result<W::Output, Failure>
    where
        Formula<C>: Hamiltonian<Class = C, Vector<f64> = Vector>,
    {
        let dimension = job.problem.dimension;
        let mut rows = self.displacements.chunks_exact(2 * dimension);
        let mut tangents = Vec::with_capacity(families.len());
        for (system, starts) in families {
            let displaced = starts.into_iter().zip(rows.by_ref());
            let displaced = displaced.map(|(start, row)| {
                let (dq, dp) = row.split_at(dimension);
                let joined =
                    |first: &[f64], second: &[f64]| Vector::from_vec([first, second].concat());
                let (q, p) = start.as_slices();
                State::new(start.time, joined(q, dq), joined(dp, p))
            });
            let displaced = displaced.collect();
            tangents.push((Tangent::new(system), displaced));
        }
        let ensemble = job.made(job.method.clone(), tangents)?;
        Ok(match newton {
            false => self.work.run(ensemble),
            true => self.work.run(ensemble.with_solver(<Newton>::new())),
        })
    }
}

/// The parts of a state of a tangent system: q, p, δq, δp.
fn parts(state: &State<Vector>) -> [&[f64]; 4] {
    let (q, p) = state.as_slices();
    let half = q.len() / 2;
    [&q[..half], &p[half..], &q[half..], &p[..half]]
}

/// Follows displacements to the end.
struct Follow<'a> {
    end: f64,
    pulse: &'a Pulse,
}

impl TangentWork for Follow<'_> {
    /// The ends, and the displacements there.
    type Output = (Ends, Vec<f64>);

    fn run<C: Class + Conservative, N: Solver<Vector, Tangent<Formula<C>>>>(
        self,
        ensemble: Ensemble<RunTimeTableau, Tangent<Formula<C>>, Vector, Compensated, N>,
    ) -> Self::Output
    where
        Formula<C>: Hamiltonian<Class = C, Vector<f64> = Vector>,
    {
        let (mut ends, mut displacements) = (Ends::default(), Vec::new());
        ensemble.integrate_to(self.end, |row| {
            self.pulse.finished.fetch_add(1, Ordering::Relaxed);
            let [q, p, dq, dp] = parts(&row.state);
            displacements.extend_from_slice(dq);
            displacements.extend_from_slice(dp);
            let part = Vector::from_column_slice;
            ends.add(&Row {
                state: State::new(row.state.time, part(q), part(p)),
                ..row
            });
            ControlFlow::Continue(())
        });
        (ends, displacements)
    }
}

/// Indicators of chaos.
struct Chaos<'a> {
    end: f64,
    pulse: &'a Pulse,
}

impl TangentWork for Chaos<'_> {
    /// The ends, and the mean MEGNO and the exponent of each trajectory.
    type Output = (Ends, Vec<[f64; 2]>);

    fn run<C: Class + Conservative, N: Solver<Vector, Tangent<Formula<C>>>>(
        self,
        ensemble: Ensemble<RunTimeTableau, Tangent<Formula<C>>, Vector, Compensated, N>,
    ) -> Self::Output
    where
        Formula<C>: Hamiltonian<Class = C, Vector<f64> = Vector>,
    {
        let (mut ends, mut indicators) = (Ends::default(), Vec::new());
        let work = |found: &mut [f64; 2],
                    run: &mut Integrator<
            RunTimeTableau,
            Tangent<Formula<C>>,
            Vector,
            Compensated,
            N,
        >| {
            let mut megno = Megno::new(run.state())?;
            let ended = run.integrate_while(self.end, |progress| {
                megno.see(progress.state);
                ControlFlow::<()>::Continue(())
            });
            *found = [megno.mean(), megno.lyapunov_exponent()];
            ended?;
            Ok(())
        };
        let show = |row: Row<Vector, [f64; 2], tangent::Error>| {
            self.pulse.finished.fetch_add(1, Ordering::Relaxed);
            let [q, p, ..] = parts(&row.state);
            let part = Vector::from_column_slice;
            let state = State::new(row.state.time, part(q), part(p));
            indicators.push(row.output);
            match row.outcome {
                Ok(()) => ends.add_state(&state, row.statistics),
                Err(error) => {
                    let (message, kind) = match &error {
                        tangent::Error::Core(error) => {
                            (errors::in_python(error), errors::kind(error))
                        }
                        error => (error.to_string(), "other"),
                    };
                    ends.add_state(&state, row.statistics);
                    ends.failures.push((row.trajectory, message, kind));
                }
            }
            ControlFlow::Continue(())
        };
        ensemble.each_as(Ok::<_, tangent::Error>, |_| [f64::NAN; 2], work, show);
        (ends, indicators)
    }
}

/// Systems of H alone have variational equations.
fn refuse_others(problem: &Problem, what: &str) -> PyResult<()> {
    let kind = problem.kind;
    let with = match kind.holonomic {
        _ if problem.tapes.has_friction() => "friction",
        Some(_) => "constraints",
        None if kind.is_forced => "applied forces",
        None => return Ok(()),
    };
    Err(errors::argument(format!(
        "{what} is computed for systems without {with} only"
    )))
}

/// Mean MEGNO and largest Lyapunov exponent of many starts, with a displacement (δq, δp) of each.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn chaos<'py>(
    py: Python<'py>,
    problem: &Problem,
    method: &Method,
    setting: Setting,
    time: f64,
    q: PyReadonlyArray2<'py, f64>,
    p: PyReadonlyArray2<'py, f64>,
    varied: PyReadonlyArray2<'py, f64>,
    displacements: PyReadonlyArray2<'py, f64>,
    end: f64,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    refuse_others(problem, "MEGNO")?;
    let starts = Starts::new(time, &q, &p, &varied)?;
    let job = Job::new(problem, method, &setting, starts, Effort::to(end))?;
    let work = Displaced {
        displacements: displacements.as_slice()?,
        work: Chaos {
            end,
            pulse: &job.pulse,
        },
    };
    let (found, interrupted) = guarded(py, &job.pulse, progress.as_ref(), || job.run_free(work))?;
    let (ends, indicators) = found?;
    let found = PyDict::new(py);
    let column = |k: usize| {
        let column: Vec<f64> = indicators.iter().map(|row| row[k]).collect();
        column.into_pyarray(py)
    };
    found.set_item("megno", column(0))?;
    found.set_item("lyapunov", column(1))?;
    ends.write(py, &found, problem.dimension, interrupted)?;
    Ok(found)
}

/// The ends of displacements (δq, δp) of starts.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn transition<'py>(
    py: Python<'py>,
    problem: &Problem,
    method: &Method,
    setting: Setting,
    time: f64,
    q: PyReadonlyArray2<'py, f64>,
    p: PyReadonlyArray2<'py, f64>,
    varied: PyReadonlyArray2<'py, f64>,
    displacements: PyReadonlyArray2<'py, f64>,
    end: f64,
) -> PyResult<Bound<'py, PyDict>> {
    refuse_others(problem, "the state transition")?;
    let starts = Starts::new(time, &q, &p, &varied)?;
    let job = Job::new(problem, method, &setting, starts, Effort::to(end))?;
    let work = Displaced {
        displacements: displacements.as_slice()?,
        work: Follow {
            end,
            pulse: &job.pulse,
        },
    };
    let (found, interrupted) = guarded(py, &job.pulse, None, || job.run_free(work))?;
    let (ends, displacements) = found?;
    let found = PyDict::new(py);
    let dimension = problem.dimension;
    let rows = displacements.len() / (2 * dimension);
    let displacements = displacements.into_pyarray(py);
    found.set_item(
        "displacements",
        displacements.reshape([rows, 2 * dimension])?,
    )?;
    ends.write(py, &found, dimension, interrupted)?;
    Ok(found)
}
