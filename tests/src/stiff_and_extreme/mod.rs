//! Verdicts on methods for stiff and extreme problems: a table of problems by methods.

mod erased;
mod methods;

use std::io;

use symplectic::nalgebra::{DVector, SVector, Vector1, Vector2};
use symplectic::solver::ByNewton;
use symplectic::{Error, Integrator, Method, Separable, State, System};
use symplectic_report::{Cell, StabilityLimit, Verdict, Verdicts};

use crate::linear_stability::{self, Entry, FARTHEST};
use crate::scenes::fput_springs::{self, FputSprings};
use crate::scenes::harmonic_oscillator::{self, HarmonicOscillator};
use crate::scenes::kepler::{self, Kepler};
use crate::scenes::pythagorean_three_body::{self, PythagoreanThreeBody};
use crate::scenes::spring_pendulum::{self, SpringPendulum};

use erased::{Erased, erased};
pub use methods::{ENTRANTS, Entrant, Stages};

/// A run with equal steps from a start.
#[derive(Clone, Debug)]
pub struct Run {
    system: Problem,
    start: State<DVector<f64>>,
    step_size: f64,
    steps: u64,
    reference: Option<State<DVector<f64>>>,
}

#[derive(Clone, Debug)]
enum Problem {
    Any(Erased),
    /// The problem with millions of steps, where a static type saves minutes.
    Kepler,
}

impl Run {
    fn new<S, const N: usize>(
        system: S,
        start: &State<SVector<f64, N>>,
        step_size: f64,
        steps: u64,
    ) -> Self
    where
        S: System<SVector<f64, N>, Class = Separable> + 'static,
    {
        Self {
            system: Problem::Any(Erased::new(system)),
            start: erased(start),
            step_size,
            steps,
            reference: None,
        }
    }

    /// The oscillator with `hω = ν`, 1000 steps.
    pub fn oscillator(nu: f64) -> Self {
        let system = HarmonicOscillator { omega: nu };
        let run = Self::new(system, &harmonic_oscillator::start(), 1.0, 1000);
        run.with_reference(&harmonic_oscillator::exact(nu, 1000.0))
    }

    fn with_reference<const N: usize>(mut self, reference: &State<SVector<f64, N>>) -> Self {
        self.reference = Some(erased(reference));
        self
    }

    fn by<M: Method>(&self, method: M) -> Verdict {
        match &self.system {
            Problem::Any(system) => {
                let integrator = self.integrator(method, system);
                Verdict::of(integrator, self.steps, self.reference.as_ref())
            }
            Problem::Kepler => {
                let State { time, q, p } = &self.start;
                let start = State::from_slices(*time, q.as_slice(), p.as_slice());
                let integrator =
                    start.and_then(|start| Integrator::new(method, Kepler, start, self.step_size));
                let integrator: Result<Integrator<M, Kepler, Vector2<f64>>, Error> = integrator;
                Verdict::of(integrator, self.steps, None)
            }
        }
    }

    fn by_newton<M: Method>(&self, method: M) -> Option<Verdict> {
        let Problem::Any(system) = &self.system else {
            return None;
        };
        let integrator = self.integrator(method, system).map(ByNewton::by_newton);
        Some(Verdict::of(integrator, self.steps, self.reference.as_ref()))
    }

    fn integrator<M: Method>(
        &self,
        method: M,
        system: &Erased,
    ) -> Result<Integrator<M, Erased, DVector<f64>>, Error> {
        Integrator::new(method, system.clone(), self.start.clone(), self.step_size)
    }
}

/// The steps `hω` of the oscillator in the table.
pub const OSCILLATOR_STEPS: [f64; 8] = [0.1, 1.0, 2.5, 4.5, 10.0, 100.0, 1e3, 1e4];

/// Additional steps `hω` of the oscillator, relative to the proved end of the first stability interval of each method.
pub const PARTS_OF_THE_LIMIT: [f64; 2] = [0.99, 1.01];

/// The name of the row for the oscillator at this fraction of the limit.
pub fn at_the_limit(part: f64) -> String {
    format!("oscillator, hω = {part} ν*")
}

/// The row names and steps `hω` of the oscillator.
pub fn oscillators() -> impl Iterator<Item = (String, f64)> {
    OSCILLATOR_STEPS
        .into_iter()
        .map(|nu| (format!("oscillator, hω = {nu}"), nu))
}

/// The whole table for the methods for whose names `keep` returns true. `long_steps` is the number of steps in its last
/// row; `progress` receives each problem and the completed fraction of the table.
///
/// # Errors
///
/// Where the catalogue cannot be read.
pub fn verdicts(
    long_steps: u64,
    keep: impl Fn(&str) -> bool,
    mut progress: impl FnMut(&str, f64),
) -> io::Result<Verdicts> {
    let catalogue = linear_stability::catalogue()?;
    let entrants = ENTRANTS.iter().filter(|entrant| keep(entrant.name));
    let entrants: Vec<(&Entrant, Entry)> = entrants
        .map(|entrant| {
            let entry = match entrant.catalogue {
                Some(name) => catalogue.get(name).cloned().ok_or_else(|| missing(name))?,
                None => Entry::derived(entrant.name, entrant.definition)?,
            };
            Ok((entrant, entry))
        })
        .collect::<io::Result<_>>()?;
    let mut table = Verdicts::new(TITLE, DESCRIPTION);
    for (entrant, entry) in &entrants {
        table.add_column(entrant.name, entry.facts());
    }
    for (problem, nu) in oscillators() {
        progress(&problem, 0.0);
        for (entrant, entry) in &entrants {
            if let Some(cell) = oscillator(entrant, entry, nu) {
                table.set(&problem, entrant.name, cell);
            }
        }
    }
    for part in PARTS_OF_THE_LIMIT {
        for (entrant, entry) in &entrants {
            let limit = entry.proved_limit().filter(|limit| limit.is_finite());
            if let Some(cell) = limit.and_then(|limit| oscillator(entrant, entry, part * limit)) {
                table.set(&at_the_limit(part), entrant.name, cell);
            }
        }
    }
    let problems = extremes(long_steps);
    for (index, (problem, run)) in problems.iter().enumerate() {
        for (number, (entrant, _)) in entrants.iter().enumerate() {
            let done = index as f64 + number as f64 / entrants.len() as f64;
            progress(problem, done / problems.len() as f64);
            if let Some(verdict) = entrant.verdict(run) {
                table.set(problem, entrant.name, verdict);
            }
        }
    }
    Ok(table)
}

fn missing(name: &str) -> io::Error {
    io::Error::other(format!("{name} is not in the catalogue"))
}

const TITLE: &str = "Stiff and extreme cases";

const DESCRIPTION: &str = "What becomes of methods with steps that are longer than anyone would take, and of problems that are \
    not of the size of one. ν* is the proved end of the first interval of stability of each method. The iteration of an \
    implicit method is by fixed points where nothing else is said, and converges for short steps only.";

/// The verdict on the oscillator with `hω = ν`, and whether it is proved to be stable.
fn oscillator(entrant: &Entrant, entry: &Entry, nu: f64) -> Option<Cell> {
    Some(Cell {
        verdict: entrant.verdict(&Run::oscillator(nu))?,
        proved_stable: Some(entry.is_stable_at(nu)),
    })
}

/// The proved and measured limits of stability of the explicit methods of the catalogue for whose names `keep` returns
/// true. If no limit was found, the measured limit is [`FARTHEST`].
///
/// # Errors
///
/// Where the catalogue cannot be read.
pub fn limits(keep: impl Fn(&str) -> bool) -> io::Result<Vec<StabilityLimit>> {
    let catalogue = linear_stability::catalogue()?;
    let mut limits: Vec<StabilityLimit> = catalogue
        .values()
        .filter(|entry| entry.is_explicit && keep(&entry.name))
        .filter_map(|entry| {
            Some(StabilityLimit {
                method: entry.name.clone(),
                proved: entry.proved_limit()?,
                // JSON has no infinity.
                measured: entry.explicit()?.measured_limit().min(FARTHEST),
            })
        })
        .collect();
    limits.sort_by(|a, b| a.method.cmp(&b.method));
    Ok(limits)
}

/// The problems that are nonlinear or not of order one. `long_steps` is the number of steps of the last problem, which
/// is not run with Newton's iteration, because that is many times slower.
pub fn extremes(long_steps: u64) -> Vec<(String, Run)> {
    let mut rows = Vec::new();
    for (name, product) in [("resolved", 0.25), ("a hundred times too long", 25.0)] {
        let omega = 1e4;
        let (system, start) = (SpringPendulum { omega }, spring_pendulum::start());
        let run = Run::new(system, &start, product / omega, 1000);
        rows.push((format!("spring pendulum, ω = 10⁴, {name}"), run));
        let omega = 1e5;
        let (system, start) = (FputSprings { omega }, fput_springs::start(omega));
        let run = Run::new(system, &start, product / omega, 1000);
        rows.push((format!("FPUT springs, ω = 10⁵, {name}"), run));
    }
    for (eccentricity, step_size, steps, name) in [
        (0.9, 1e-2, 628, "e = 0.9"),
        (0.999, 2.5e-6, 2000, "e = 0.999, resolved"),
        (0.999, 1e-2, 628, "e = 0.999, not resolved"),
        (1.0 - 1e-9, 1e-16, 1000, "e = 1 − 10⁻⁹, resolved"),
        (1.0 - 1e-9, 1e-3, 100, "e = 1 − 10⁻⁹, not resolved"),
    ] {
        let run = Run::new(Kepler, &kepler::start(eccentricity), step_size, steps);
        rows.push((format!("Kepler, {name}"), run));
    }
    let at_rest = State::from_arrays(0.0, [1.0, 0.0], [0.0, 0.0]);
    let run = Run::new(Kepler, &at_rest, 1e-2, 1000);
    rows.push(("Kepler, head-on collision".into(), run));
    let start = pythagorean_three_body::start();
    let run = Run::new(PythagoreanThreeBody, &start, 1.0 / 64.0, 1500);
    rows.push(("three bodies, not resolved".into(), run));
    for exponent in [-300, -150, 150, 300] {
        let scale = 10f64.powi(exponent);
        let start = State::new(0.0, Vector1::new(scale), Vector1::new(0.0));
        let exact = harmonic_oscillator::exact(1.0, 10.0);
        let exact = State::new(10.0, exact.q * scale, exact.p * scale);
        let run = Run::new(Scaled { scale }, &start, 1.0 / 64.0, 640).with_reference(&exact);
        rows.push((format!("oscillator of the size 10^{exponent}"), run));
    }
    let run = Run::new(Kepler, &kepler::start(0.6), 1.0 / 64.0, long_steps / 10);
    rows.push((
        format!("Kepler, e = 0.6, {:e} steps", run.steps),
        run.clone(),
    ));
    let run = Run {
        system: Problem::Kepler,
        steps: long_steps,
        ..run
    };
    rows.push((format!("Kepler, e = 0.6, {:e} steps", run.steps), run));
    rows
}

/// The oscillator with ω = 1 and its energy in units of `scale²`, so that it neither overflows nor underflows.
#[derive(Clone, Copy, Debug)]
struct Scaled {
    scale: f64,
}

impl System<Vector1<f64>> for Scaled {
    type Class = Separable;
    type Solver = symplectic::solver::FixedPoint;

    fn velocity(
        &self,
        _time: f64,
        _q: &Vector1<f64>,
        p: &Vector1<f64>,
        velocity: &mut Vector1<f64>,
    ) {
        *velocity = *p;
    }

    fn force(&self, _time: f64, q: &Vector1<f64>, _p: &Vector1<f64>, force: &mut Vector1<f64>) {
        *force = -*q;
    }

    fn energy(&self, _time: f64, q: &Vector1<f64>, p: &Vector1<f64>) -> Option<f64> {
        Some(((q[0] / self.scale).powi(2) + (p[0] / self.scale).powi(2)) / 2.0)
    }
}
