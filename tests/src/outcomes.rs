//! What becomes of methods where problems are stiff or extreme: a table of methods and problems, each cell a finite answer.

use std::fmt;

use symplectic::nalgebra::Vector1;
use symplectic::{
    Error, Hamiltonian, Integrator, Method, SeparableHamiltonian, Solver, State, Summation, Vector,
};

use crate::linear_stability::Entry;
use crate::measure::largest;
use crate::methods::{
    BlanesMoanSrkn14a, ForestRuth, Gauss2, Gauss4, Gauss8, Lobatto3, StoermerVerlet,
    SymplecticEuler,
};
use crate::scenes::fput_springs::{self, FputSprings};
use crate::scenes::harmonic_oscillator::{self, HarmonicOscillator};
use crate::scenes::kepler::{self, Kepler};
use crate::scenes::pythagorean_three_body::{self, PythagoreanThreeBody};
use crate::scenes::spring_pendulum::{self, SpringPendulum};

/// What became of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// All steps were taken and the error is at most [`ACCURATE`]: of the state at the end where a reference is known, of
    /// the energy elsewhere.
    Accurate {
        /// That error, relative.
        error: f64,
    },
    /// All steps were taken and the energy stays within [`GROWTH`] of what it was, but the error is larger.
    Bounded {
        /// The largest relative error of the energy.
        energy: f64,
        /// The relative error of the state at the end, or that of the energy.
        error: f64,
    },
    /// The energy left these bounds.
    Unstable {
        /// The steps until then.
        steps: u64,
    },
    /// A step was refused, and the state left as it was.
    Stopped {
        /// Why.
        error: Error,
    },
}

/// The largest error that is accurate.
pub const ACCURATE: f64 = 1e-3;

/// The relative error of the energy that is out of bounds. Inside of a stability interval the energy of the oscillator
/// oscillates by a factor, which is large near the end.
pub const GROWTH: f64 = 1e4;

impl Outcome {
    /// The kind of outcome in one letter, as tables of expectations have it: a, b, u; n for an iteration that does not
    /// converge, f for a number that is not finite, s for a singular matrix, x for another error.
    pub const fn letter(&self) -> char {
        match self {
            Self::Accurate { .. } => 'a',
            Self::Bounded { .. } => 'b',
            Self::Unstable { .. } => 'u',
            Self::Stopped { error } => match error {
                Error::NoConvergence { .. } => 'n',
                Error::NonFinite { .. } => 'f',
                Error::SingularMatrix { .. } => 's',
                _ => 'x',
            },
        }
    }

    /// Whether all its numbers are finite.
    pub const fn is_finite(&self) -> bool {
        match self {
            Self::Accurate { error } => error.is_finite(),
            Self::Bounded { energy, error } => energy.is_finite() && error.is_finite(),
            Self::Unstable { .. } | Self::Stopped { .. } => true,
        }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Accurate { error } => write!(f, "stable, accurate to {error:.0e}"),
            Self::Bounded { energy, error } => {
                write!(f, "stable, energy within {energy:.0e}, error {error:.0e}")
            }
            Self::Unstable { steps } => write!(f, "unstable after {steps} steps"),
            Self::Stopped { error } => write!(f, "stopped: {error}"),
        }
    }
}

/// Takes so many steps, or as many as go well, and says what became of it.
///
/// The system has to have an energy.
pub fn outcome<M, S, V, R, N>(
    mut integrator: Integrator<M, S, V, R, N>,
    steps: u64,
    reference: Option<&State<V>>,
) -> Outcome
where
    M: Method,
    S: Hamiltonian<V>,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    let initial = integrator.energy().unwrap_or(f64::NAN);
    let mut energy = 0.0;
    for count in 1..=steps {
        if let Err(error) = integrator.step() {
            return Outcome::Stopped { error };
        }
        let now = integrator.energy().unwrap_or(f64::NAN);
        energy = largest(energy, (now / initial - 1.0).abs());
        // Not a number is out of bounds too.
        if energy.is_nan() || energy > GROWTH {
            return Outcome::Unstable { steps: count };
        }
    }
    let error = reference.map_or(energy, |reference| distance(integrator.state(), reference));
    if error <= ACCURATE {
        Outcome::Accurate { error }
    } else {
        Outcome::Bounded { energy, error }
    }
}

/// The larger one of the relative distances of q and of p in the 2-norm.
fn distance<V: Vector<Scalar = f64>>(found: &State<V>, reference: &State<V>) -> f64 {
    // Scaled, for the squares of 1e300 and of 1e-300 are no doubles.
    let relative = |found: &V, reference: &V| {
        let scale = reference
            .as_slice()
            .iter()
            .fold(0.0_f64, |a, x| a.max(x.abs()));
        let pairs = found.as_slice().iter().zip(reference.as_slice());
        let squares = pairs.map(|(a, b)| ((a - b) / scale).powi(2)).sum::<f64>();
        let norm = reference
            .as_slice()
            .iter()
            .map(|b| (b / scale).powi(2))
            .sum::<f64>();
        (squares / norm).sqrt()
    };
    largest(
        relative(&found.q, &reference.q),
        relative(&found.p, &reference.p),
    )
}

/// The methods of the table in the order of its columns: their names, and those of the catalogue.
pub const METHODS: [(&str, &str); 9] = [
    ("symplectic Euler", "symplectic-euler"),
    ("Störmer–Verlet", "stormer-verlet"),
    ("Forest & Ruth", "forest-ruth-1990"),
    ("Blanes & Moan SRKN₁₄ᵃ", "blanes-moan-2002-srkn14a"),
    ("Lobatto 3", "lobatto-3"),
    ("Gauss 2", "gauss-2"),
    ("Gauss 4", "gauss-4"),
    ("Gauss 8", "gauss-8"),
    ("Gauss 4 by Newton", "gauss-4"),
];

/// The number of columns with explicit methods, which come first.
pub const EXPLICIT: usize = 4;

/// The column of the method whose stages are found by Newton's iteration.
pub const BY_NEWTON: usize = 8;

/// A problem, and what became of it with each of [`METHODS`].
#[derive(Clone, Debug)]
pub struct Row {
    /// The problem.
    pub problem: String,
    /// In the order of [`METHODS`]; `None` where there is no such step.
    pub outcomes: [Option<Outcome>; METHODS.len()],
}

/// A run: equal steps from a start.
struct Run<S, V> {
    system: S,
    start: State<V>,
    step_size: f64,
    steps: u64,
    reference: Option<State<V>>,
}

impl<S, V> Run<S, V>
where
    S: SeparableHamiltonian<V> + Copy,
    V: Vector<Scalar = f64>,
{
    /// By all methods.
    fn row(&self, problem: impl Into<String>) -> Row {
        Row {
            problem: problem.into(),
            outcomes: std::array::from_fn(|column| Some(self.by(column))),
        }
    }

    /// By one of [`METHODS`].
    fn by(&self, column: usize) -> Outcome {
        match column {
            0 => self.by_method(SymplecticEuler),
            1 => self.by_method(StoermerVerlet),
            2 => self.by_method(ForestRuth),
            3 => self.by_method(BlanesMoanSrkn14a),
            4 => self.by_method(Lobatto3),
            5 => self.by_method(Gauss2),
            6 => self.by_method(Gauss4),
            7 => self.by_method(Gauss8),
            _ => match self.integrator(Gauss4) {
                Ok(integrator) => {
                    outcome(integrator.by_newton(), self.steps, self.reference.as_ref())
                }
                Err(error) => Outcome::Stopped { error },
            },
        }
    }

    fn by_method<M: Method>(&self, method: M) -> Outcome {
        match self.integrator(method) {
            Ok(integrator) => outcome(integrator, self.steps, self.reference.as_ref()),
            Err(error) => Outcome::Stopped { error },
        }
    }

    fn integrator<M: Method>(&self, method: M) -> Result<Integrator<M, S, V>, Error> {
        Integrator::new(method, self.system, self.start.clone(), self.step_size)
    }
}

/// The oscillator with `hω = ν`, 1000 steps.
fn oscillator(nu: f64) -> Run<HarmonicOscillator, Vector1<f64>> {
    Run {
        system: HarmonicOscillator { omega: nu },
        start: harmonic_oscillator::start(),
        step_size: 1.0,
        steps: 1000,
        reference: Some(harmonic_oscillator::exact(nu, 1000.0)),
    }
}

/// The steps `hω` of the oscillator in the table.
pub const OSCILLATOR_STEPS: [f64; 7] = [0.1, 1.0, 2.5, 10.0, 100.0, 1e3, 1e4];

/// The oscillator with each of [`OSCILLATOR_STEPS`].
pub fn oscillators() -> Vec<Row> {
    let rows = OSCILLATOR_STEPS.iter();
    rows.map(|&nu| oscillator(nu).row(format!("oscillator, hω = {nu}")))
        .collect()
}

/// The oscillator with `hω = fraction·ν*`, where ν* is the proved end of the first stability interval of each method, in
/// the order of [`METHODS`]; nothing for methods without an end.
pub fn oscillators_at_the_limit(fraction: f64, entries: [&Entry; METHODS.len()]) -> Row {
    Row {
        problem: format!("oscillator, hω = {fraction} ν*"),
        outcomes: std::array::from_fn(|column| {
            let limit = entries[column].proved_limit()?;
            limit
                .is_finite()
                .then(|| oscillator(fraction * limit).by(column))
        }),
    }
}

/// The problems that are not linear, or not of the size of one. `long_steps` is the number of steps of the last one.
pub fn extremes(long_steps: u64) -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, product) in [("resolved", 0.25), ("a hundred times too long", 25.0)] {
        let omega = 1e4;
        let run = Run {
            system: SpringPendulum { omega },
            start: spring_pendulum::start(),
            step_size: product / omega,
            steps: 1000,
            reference: None,
        };
        rows.push(run.row(format!("spring pendulum, ω = 10⁴, {name}")));
        let omega = 1e5;
        let run = Run {
            system: FputSprings { omega },
            start: fput_springs::start(omega),
            step_size: product / omega,
            steps: 1000,
            reference: None,
        };
        rows.push(run.row(format!("FPUT springs, ω = 10⁵, {name}")));
    }
    for (eccentricity, step_size, steps, name) in [
        (0.9, 1e-2, 628, "e = 0.9"),
        (0.999, 2.5e-6, 2000, "e = 0.999, resolved"),
        (0.999, 1e-2, 628, "e = 0.999, not resolved"),
        (1.0 - 1e-9, 1e-16, 1000, "e = 1 − 10⁻⁹, resolved"),
        (1.0 - 1e-9, 1e-3, 100, "e = 1 − 10⁻⁹, not resolved"),
    ] {
        let run = Run {
            system: Kepler,
            start: kepler::start(eccentricity),
            step_size,
            steps,
            reference: None,
        };
        rows.push(run.row(format!("Kepler, {name}")));
    }
    let run = Run {
        system: Kepler,
        start: State::from_arrays(0.0, [1.0, 0.0], [0.0, 0.0]),
        step_size: 1e-2,
        steps: 1000,
        reference: None,
    };
    rows.push(run.row("Kepler, head-on collision"));
    let run = Run {
        system: PythagoreanThreeBody,
        start: pythagorean_three_body::start(),
        step_size: 1.0 / 64.0,
        steps: 1500,
        reference: None,
    };
    rows.push(run.row("three bodies, not resolved"));
    for exponent in [-300, -150, 150, 300] {
        let scale = 10f64.powi(exponent);
        let exact = harmonic_oscillator::exact(1.0, 10.0);
        let run = Run {
            system: Scaled { scale },
            start: State::new(0.0, Vector1::new(scale), Vector1::new(0.0)),
            step_size: 1.0 / 64.0,
            steps: 640,
            reference: Some(State::new(10.0, exact.q * scale, exact.p * scale)),
        };
        rows.push(run.row(format!("oscillator of the size 10^{exponent}")));
    }
    let run = Run {
        system: Kepler,
        start: kepler::start(0.6),
        step_size: 1.0 / 64.0,
        steps: long_steps,
        reference: None,
    };
    rows.push(run.row(format!("Kepler, e = 0.6, {long_steps} steps")));
    rows
}

/// The oscillator with ω = 1 and an energy in the unit `scale²`, which neither overflows nor underflows.
#[derive(Clone, Copy, Debug)]
struct Scaled {
    scale: f64,
}

impl SeparableHamiltonian<Vector1<f64>> for Scaled {
    fn velocity(&self, _time: f64, p: &Vector1<f64>, velocity: &mut Vector1<f64>) {
        *velocity = *p;
    }

    fn force(&self, _time: f64, q: &Vector1<f64>, force: &mut Vector1<f64>) {
        *force = -*q;
    }

    fn energy(&self, _time: f64, q: &Vector1<f64>, p: &Vector1<f64>) -> Option<f64> {
        Some(((q[0] / self.scale).powi(2) + (p[0] / self.scale).powi(2)) / 2.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_of_outcome_is_told_from_the_others() {
        // Störmer–Verlet is off by ν²/8 and a phase of ν³/24 a step, unstable from ν = 2 on.
        let verlet = |nu: f64| oscillator(nu).by(1);
        assert!(matches!(verlet(0.01), Outcome::Accurate { error } if error > 1e-6));
        assert!(
            matches!(verlet(1.0), Outcome::Bounded { energy, error } if energy < 1.0 && error > 0.1)
        );
        assert!(matches!(verlet(2.5), Outcome::Unstable { steps } if steps < 20));
        let stopped = oscillator(10.0).by(6);
        assert!(matches!(
            &stopped,
            Outcome::Stopped {
                error: Error::NoConvergence { .. }
            }
        ));
        assert!(stopped.to_string().starts_with("stopped: step 1 of size 1"));
        let letters =
            [verlet(0.01), verlet(1.0), verlet(2.5), stopped].map(|outcome| outcome.letter());
        assert_eq!(letters, ['a', 'b', 'u', 'n']);
    }

    #[test]
    fn what_is_not_a_number_is_not_stable() {
        let nothing = Outcome::Bounded {
            energy: f64::NAN,
            error: 1.0,
        };
        assert!(!nothing.is_finite());
        let start: State<Vector1<f64>> = harmonic_oscillator::start();
        assert!(distance(&State::new(0.0, start.q * f64::NAN, start.p), &start).is_nan());
    }
}
