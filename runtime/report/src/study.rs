//! Studies: all methods on all problems.

use std::time::Duration;

use super::contestant::{Contestant, Stop};
use super::observer::{Function, Observer};
use super::timing::{Repetitions, Samples, clock, round};
use super::{
    Curve, Kind, Measured, Measurements, MethodRecord, Outcome, Parameter, Point, Problem,
    ProblemRecord, Trace, text,
};
use symplectic::{State, System, Vector};

/// The extent of the measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The errors for which methods are compared, from coarse to fine.
    pub targets: Vec<f64>,
    /// Time limit of a run; runs that would exceed it are reported as skipped.
    pub budget: Duration,
    /// Number of timed repetitions of each run.
    pub repetitions: Repetitions,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            targets: vec![1e-3, 1e-6, 1e-9, 1e-12],
            budget: Duration::from_millis(250),
            repetitions: Repetitions::default(),
        }
    }
}

/// Progress of a study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advance<'a> {
    /// The current problem.
    pub problem: &'a str,
    /// The current method; `None` during timing, when methods take turns.
    pub method: Option<&'a str>,
    /// Fraction of the study that is done, from 0 to 1, with equal weight for all problems.
    pub fraction: f64,
}

/// A collection of problems with their methods.
///
/// See the [module](super) for an example.
pub struct Study {
    title: String,
    problems: Vec<Box<dyn Contest>>,
}

impl Study {
    /// A study without problems.
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            problems: Vec::new(),
        }
    }

    /// Adds a problem.
    #[must_use]
    pub fn problem<V, S>(mut self, problem: Problem<V, S>) -> Self
    where
        V: Vector<Scalar = f64>,
        S: System<V> + Clone + 'static,
    {
        self.problems.push(Box::new(problem));
        self
    }

    /// Removes the methods for whose names `keep` returns false.
    pub fn retain_methods(&mut self, mut keep: impl FnMut(&str) -> bool) {
        for problem in &mut self.problems {
            problem.retain_methods(&mut keep);
        }
    }

    /// [`run`](Self::run) with the default settings.
    pub fn measure(&self) -> Measurements {
        self.run(&Settings::default(), |_| {})
    }

    /// Runs all methods on all problems and reports the progress. Failures are part of the result.
    pub fn run(&self, settings: &Settings, mut progress: impl FnMut(Advance<'_>)) -> Measurements {
        let mut methods: Vec<MethodRecord> = Vec::new();
        let mut problems = Vec::new();
        let all = self.problems.len() as f64;
        for (number, problem) in self.problems.iter().enumerate() {
            let mut progress = |advance: Advance<'_>| {
                let fraction = (number as f64 + advance.fraction) / all;
                progress(Advance {
                    fraction,
                    ..advance
                });
            };
            problems.push(problem.run(settings, &mut progress));
            for method in problem.records() {
                if methods.iter().all(|known| known.name != method.name) {
                    methods.push(method);
                }
            }
        }
        for method in &mut methods {
            let curves = problems.iter().flat_map(|problem| &problem.curves);
            let mut own = curves.filter(|curve| curve.method == method.name);
            let iterates = |curve: &Curve| curve.measured().any(|(_, run)| run.most_iterations > 0);
            if method.kind != Kind::Peer && own.any(iterates) {
                method.kind = Kind::Implicit;
            }
        }
        Measurements {
            title: self.title.clone(),
            circumstances: Vec::new(),
            targets: settings.targets.clone(),
            methods,
            problems,
            verdicts: Vec::new(),
            limits: Vec::new(),
        }
    }
}

/// A problem with its types erased.
trait Contest {
    fn retain_methods(&mut self, keep: &mut dyn FnMut(&str) -> bool);
    fn records(&self) -> Vec<MethodRecord>;
    fn run(&self, settings: &Settings, progress: &mut dyn FnMut(Advance<'_>)) -> ProblemRecord;
}

impl<V, S> Contest for Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: System<V> + Clone + 'static,
{
    fn retain_methods(&mut self, keep: &mut dyn FnMut(&str) -> bool) {
        self.contestants.retain(|contestant| keep(&contestant.name));
    }

    fn records(&self) -> Vec<MethodRecord> {
        self.contestants.iter().map(Contestant::record).collect()
    }

    fn run(&self, settings: &Settings, progress: &mut dyn FnMut(Advance<'_>)) -> ProblemRecord {
        let count = self.contestants.len() as f64;
        // Timing takes about as long as everything else.
        let mut explored = Vec::new();
        for (number, contestant) in self.contestants.iter().enumerate() {
            progress(Advance {
                problem: &self.name,
                method: Some(&contestant.name),
                fraction: 0.5 * number as f64 / count,
            });
            explored.push(self.explore(contestant, settings));
        }
        self.take_times(&mut explored, settings, progress);
        let curves = self.contestants.iter().zip(explored);
        let (mut curves, traces): (Vec<_>, Vec<_>) = curves
            .map(|(contestant, explored)| {
                let curve = Curve {
                    method: contestant.name.clone(),
                    parameter: contestant.ladder.parameter(),
                    points: explored.points,
                    trace: None,
                };
                (curve, explored.traces)
            })
            .unzip();
        choose_traces(&mut curves, traces, self.trace_at);
        ProblemRecord {
            name: self.name.clone(),
            description: self.description.clone(),
            needs: self.needs.clone(),
            dimension: self.start.q.dimension(),
            start: self.start.time,
            end: self.reference.end.time,
            reference: self.reference.origin.clone(),
            uncertainty: self.reference.uncertainty,
            traced_at: self.trace_at,
            invariants: self
                .invariants
                .iter()
                .map(|(name, _)| name.clone())
                .collect(),
            curves,
        }
    }
}

/// The runs of a method before timing.
struct Explored {
    points: Vec<Point>,
    /// The trace of each point.
    traces: Vec<Option<Trace>>,
    /// The index and the samples of each measured point.
    samples: Vec<(usize, Samples)>,
}

/// Time limit of an observed run in units of the budget, because energies and invariants also take time.
const OBSERVED: u32 = 4;

impl<V, S> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: System<V> + Clone + 'static,
{
    /// Runs a method along its ladder.
    fn explore(&self, contestant: &Contestant<V>, settings: &Settings) -> Explored {
        let mut explored = Explored {
            points: Vec::new(),
            traces: Vec::new(),
            samples: Vec::new(),
        };
        let finest = settings
            .targets
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        let mut descent = contestant.ladder.descent(finest);
        let budget = settings.budget.as_secs_f64();
        // The parameter and the time in seconds of the last run.
        let mut last: Option<(f64, f64)> = None;
        while let Some(parameter) = descent.next() {
            let expected = last.map_or(0.0, |(before, seconds)| {
                seconds * longer(contestant.ladder.parameter(), before / parameter)
            });
            if expected > budget {
                explored.points.push(Point {
                    parameter,
                    outcome: Outcome::Skipped {
                        reason: format!(
                            "it would take about {}, over the budget of {} for a run",
                            text::seconds(expected),
                            text::seconds(budget)
                        ),
                    },
                });
                explored.traces.push(None);
                break;
            }
            let mut observed = None;
            let mut seconds =
                clock(|| observed = Some(self.observe(contestant, parameter, settings)));
            let Some((outcome, trace)) = observed else {
                break;
            };
            let error = match &outcome {
                Outcome::Measured(measured) => {
                    seconds = clock(|| contestant.run_bare(parameter));
                    explored
                        .samples
                        .push((explored.points.len(), Samples::new(seconds)));
                    Some(measured.error)
                }
                Outcome::Failed { .. } | Outcome::Skipped { .. } => None,
            };
            let is_skipped = matches!(outcome, Outcome::Skipped { .. });
            explored.points.push(Point { parameter, outcome });
            explored.traces.push(trace);
            if is_skipped {
                break;
            }
            last = Some((parameter, seconds));
            descent.take(error);
        }
        explored
    }

    /// An observed run, without timing.
    fn observe(
        &self,
        contestant: &Contestant<V>,
        parameter: f64,
        settings: &Settings,
    ) -> (Outcome, Option<Trace>) {
        let system = &self.system;
        let energy = |state: &State<V>| {
            let energy = system.energy(state.time, &state.q, &state.p);
            energy.unwrap_or(f64::NAN)
        };
        let has_energy = energy(&self.start).is_finite();
        let energy: &Function<'_, V> = &energy;
        let invariants = self
            .invariants
            .iter()
            .map(|(_, invariant)| -> &Function<'_, V> { &**invariant });
        let end = &self.reference.end;
        let mut observer = Observer::new(
            has_energy.then_some(energy),
            invariants,
            &self.start,
            end.time,
        );
        let limit = settings.budget * OBSERVED;
        let finish =
            contestant.run_observed(parameter, limit, &mut |state| observer.observe(state));
        let finish = match finish {
            Ok(finish) => finish,
            Err(Stop::Failed(error)) => return (Outcome::Failed { error }, None),
            Err(Stop::TooLong) => {
                let reason = format!(
                    "it had not come to the end after {}, observed",
                    text::seconds(limit.as_secs_f64())
                );
                return (Outcome::Skipped { reason }, None);
            }
        };
        let error = Measured::error_of(&finish.state, end);
        if !error.is_finite() {
            let error = "the state at the end is not finite".into();
            return (Outcome::Failed { error }, None);
        }
        observer.observe(&finish.state);
        let measured = Measured {
            error,
            energy_error: observer.energy_error(),
            drifts: observer.drifts(),
            seconds: 0.0,
            repetitions: 0,
            steps: finish.steps,
            evaluations: finish.evaluations,
            mean_iterations: match finish.steps {
                Some(steps) if steps > 0 => finish.iterations as f64 / steps as f64,
                _ => 0.0,
            },
            most_iterations: finish.most_iterations,
        };
        (Outcome::Measured(measured), observer.trace(parameter))
    }

    /// Times all points in rounds in which the methods take turns.
    fn take_times(
        &self,
        explored: &mut [Explored],
        settings: &Settings,
        progress: &mut dyn FnMut(Advance<'_>),
    ) {
        let lengths: Vec<usize> = explored
            .iter()
            .map(|explored| explored.samples.len())
            .collect();
        let wanted = &settings.repetitions;
        for number in 0.. {
            progress(Advance {
                problem: &self.name,
                method: None,
                fraction: 0.5
                    + 0.5 * (number as f64 / wanted.most.max(wanted.least) as f64).min(1.0),
            });
            let mut is_done = true;
            for (curve, point) in round(&lengths) {
                let Explored {
                    points, samples, ..
                } = &mut explored[curve];
                let (place, samples) = &mut samples[point];
                if !samples.suffice(wanted) {
                    is_done = false;
                    let parameter = points[*place].parameter;
                    samples.take(&mut || self.contestants[curve].run_bare(parameter));
                }
            }
            if is_done {
                break;
            }
        }
        for Explored {
            points, samples, ..
        } in explored
        {
            for (place, samples) in samples {
                if let Outcome::Measured(measured) = &mut points[*place].outcome {
                    measured.seconds = samples.median().unwrap_or(0.0);
                    measured.repetitions = samples.count();
                }
            }
        }
    }
}

/// The ratio of run times if the parameter is divided by `factor`.
fn longer(parameter: Parameter, factor: f64) -> f64 {
    match parameter {
        Parameter::StepSize => factor,
        // Assumes order 8.
        Parameter::Tolerance => factor.powf(0.125),
    }
}

/// Selects the trace of a point for each curve: the one whose step size is nearest to `at`, or whose number of
/// evaluations is nearest to the typical number.
fn choose_traces(curves: &mut [Curve], traces: Vec<Vec<Option<Trace>>>, at: Option<f64>) {
    let typical = typical_evaluations(curves);
    for (curve, traces) in curves.iter_mut().zip(traces) {
        let distance = |point: &Point| match (&point.outcome, at) {
            (Outcome::Measured(_), Some(at)) => Some((point.parameter / at).ln().abs()),
            (Outcome::Measured(measured), None) => {
                Some((measured.evaluations.max(1) as f64 / typical).ln().abs())
            }
            (Outcome::Failed { .. } | Outcome::Skipped { .. }, _) => None,
        };
        let candidates = curve.points.iter().zip(traces);
        let nearest = candidates
            .filter_map(|(point, trace)| Some((distance(point)?, trace?)))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        curve.trace = nearest.map(|(_, trace)| trace);
    }
}

/// The median over the curves of the evaluations of the first run with an error of at most 10⁻⁶, or of the best run.
fn typical_evaluations(curves: &[Curve]) -> f64 {
    let mut evaluations: Vec<u64> = curves
        .iter()
        .filter_map(|curve| {
            let good = curve.measured().find(|(_, run)| run.error <= 1e-6);
            let best = || {
                curve
                    .measured()
                    .min_by(|a, b| a.1.error.total_cmp(&b.1.error))
            };
            good.or_else(best).map(|(_, run)| run.evaluations)
        })
        .collect();
    evaluations.sort_unstable();
    let median = evaluations.get(evaluations.len() / 2).copied();
    median.unwrap_or(1).max(1) as f64
}
