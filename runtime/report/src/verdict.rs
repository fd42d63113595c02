//! Classification of runs: accurate, bounded, unstable or stopped.

use core::fmt;

use serde::{Deserialize, Serialize};

use super::observer::Deviation;
use super::text;
use super::{Fact, Measured};
use symplectic::solver::Solver;
use symplectic::{Error, Integrator, Method, State, Summation, System, Vector};

/// The verdict on a run with a constant step size.
///
/// ```
/// use symplectic::nalgebra::Vector1;
/// use symplectic_report::Verdict;
/// use symplectic::{Integrator, State, acceleration};
///
/// symplectic::tableau! { Verlet { basis: polynomial(2), nodes: lobatto(2) } }
///
/// let oscillator = acceleration::<Vector1<f64>, _>(|_time, q, acceleration| *acceleration = -q)
///     .with_energy(|_time, q, p| (q[0] * q[0] + p[0] * p[0]) / 2.0);
/// let run = |step_size| {
///     let start = State::from_arrays(0.0, [1.0], [0.0]);
///     Verdict::of(Integrator::new(Verlet, oscillator.clone(), start, step_size), 1000, None)
/// };
/// assert!(matches!(run(0.01), Verdict::Accurate { .. }));
/// // Stable for hω < 2, that is proved.
/// assert!(matches!(run(1.99), Verdict::Bounded { .. }));
/// assert!(matches!(run(2.01), Verdict::Unstable { .. }));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Verdict {
    /// All steps were taken and the error is at most [`ACCURATE`](Self::ACCURATE). It is the error of the state at the
    /// end if there is a reference, otherwise the error of the energy.
    Accurate {
        /// The relative error.
        error: f64,
    },
    /// All steps were taken and the error of the energy stays within [`GROWTH`](Self::GROWTH), but the error is larger.
    Bounded {
        /// The largest relative error of the energy.
        energy: f64,
        /// The relative error of the state at the end, or of the energy.
        error: f64,
    },
    /// The error of the energy exceeded [`GROWTH`](Self::GROWTH) or became NaN.
    Unstable {
        /// Number of steps until then.
        steps: u64,
    },
    /// A step failed; the state is untouched.
    Stopped {
        /// The kind of error.
        cause: Cause,
        /// The error message.
        error: String,
    },
}

/// Why a step failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Cause {
    /// [`Error::NoConvergence`] or [`Error::Stagnation`].
    NoConvergence,
    /// [`Error::NonFinite`].
    NonFinite,
    /// [`Error::SingularMatrix`].
    SingularMatrix,
    /// Another [`Error`].
    Other,
}

impl Verdict {
    /// Largest relative error that counts as accurate.
    pub const ACCURATE: f64 = 1e-3;

    /// Largest relative error of the energy that counts as bounded. Inside a stability interval the energy of the
    /// oscillator oscillates by a factor, which is large near the end of the interval.
    pub const GROWTH: f64 = 1e4;

    /// Takes `steps` steps, or fewer if a step fails or the energy grows, and returns the verdict. The system must have
    /// an energy.
    ///
    /// An error from the construction of the integrator also gives a verdict.
    pub fn of<M, S, V, R, N>(
        integrator: Result<Integrator<M, S, V, R, N>, Error>,
        steps: u64,
        reference: Option<&State<V>>,
    ) -> Self
    where
        M: Method,
        S: System<V>,
        V: Vector<Scalar = f64>,
        R: Summation,
        N: Solver<V, S>,
    {
        let mut integrator = match integrator {
            Ok(integrator) => integrator,
            Err(error) => return Self::stopped(&error),
        };
        if integrator.energy().is_none() {
            return Self::stopped(&Error::NoEnergy);
        }
        let energy_of = |state: &State<V>| {
            let energy = integrator.system().energy(state.time, &state.q, &state.p);
            energy.unwrap_or(f64::NAN)
        };
        let mut energy = Deviation::new(energy_of, integrator.state());
        for count in 1..=steps {
            if let Err(error) = integrator.step() {
                return Self::stopped(&error);
            }
            energy.observe(integrator.energy().unwrap_or(f64::NAN));
            // NaN is out of bounds, too.
            if energy.largest().is_nan() || energy.largest() > Self::GROWTH {
                return Self::Unstable { steps: count };
            }
        }
        let energy = energy.largest();
        let error = reference.map_or(energy, |reference| {
            Measured::error_of(integrator.state(), reference)
        });
        if error <= Self::ACCURATE {
            Self::Accurate { error }
        } else {
            Self::Bounded { energy, error }
        }
    }

    fn stopped(error: &Error) -> Self {
        let cause = match error {
            Error::NoConvergence { .. } | Error::Stagnation { .. } => Cause::NoConvergence,
            Error::NonFinite { .. } => Cause::NonFinite,
            Error::SingularMatrix { .. } => Cause::SingularMatrix,
            _ => Cause::Other,
        };
        Self::Stopped {
            cause,
            error: error.to_string(),
        }
    }

    /// The kind of verdict as a letter, for tables of expectations: a, b, u; n for no convergence, f for a number that
    /// is not finite, s for a singular matrix, x for another error.
    pub const fn letter(&self) -> char {
        match self {
            Self::Accurate { .. } => 'a',
            Self::Bounded { .. } => 'b',
            Self::Unstable { .. } => 'u',
            Self::Stopped { cause, .. } => match cause {
                Cause::NoConvergence => 'n',
                Cause::NonFinite => 'f',
                Cause::SingularMatrix => 's',
                Cause::Other => 'x',
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

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Accurate { error } => {
                write!(f, "stable, accurate to {}", text::scientific(*error))
            }
            Self::Bounded { energy, error } => write!(
                f,
                "stable, energy within {}, error {}",
                text::scientific(*energy),
                text::scientific(*error)
            ),
            Self::Unstable { steps } => write!(f, "unstable after {} steps", text::grouped(*steps)),
            Self::Stopped { error, .. } => write!(f, "stopped: {error}"),
        }
    }
}

/// Verdicts as a table: its rows are problems and its columns methods.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Verdicts {
    /// Title of the table.
    pub title: String,
    /// Description of the table.
    pub description: String,
    /// The methods, in the order in which they first appear.
    pub columns: Vec<Column>,
    /// The problems, in the order in which they first appear.
    pub rows: Vec<Row>,
}

/// A method in a table of verdicts.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// Name of the method.
    pub method: String,
    /// Proved facts.
    pub facts: Vec<Fact>,
}

/// A problem in a table of verdicts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name of the problem.
    pub problem: String,
    /// Cells in the order of the [columns](Verdicts::columns); missing or `None` if a method was not run.
    pub cells: Vec<Option<Cell>>,
}

/// A verdict, and the proved stability.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// The verdict on the run.
    pub verdict: Verdict,
    /// Whether the step is in the proved stability set of the method; `None` if the problem is not the oscillator.
    pub proved_stable: Option<bool>,
}

impl From<Verdict> for Cell {
    fn from(verdict: Verdict) -> Self {
        Self {
            verdict,
            proved_stable: None,
        }
    }
}

impl Cell {
    /// Whether the verdict agrees with the proof; `None` if nothing is proved or the run stopped.
    pub const fn is_as_proved(&self) -> Option<bool> {
        match (&self.verdict, self.proved_stable) {
            (_, None) | (Verdict::Stopped { .. }, _) => None,
            (Verdict::Unstable { .. }, Some(stable)) => Some(!stable),
            (Verdict::Accurate { .. } | Verdict::Bounded { .. }, Some(stable)) => Some(stable),
        }
    }
}

impl Verdicts {
    /// An empty table.
    pub fn new(title: impl Into<String>, description: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            description: description.into(),
            ..Self::default()
        }
    }

    /// Appends a method with its proved facts.
    pub fn add_column(&mut self, method: impl Into<String>, facts: Vec<Fact>) {
        self.columns.push(Column {
            method: method.into(),
            facts,
        });
    }

    /// Sets a cell; adds a row or a column if the name is new.
    pub fn set(&mut self, problem: &str, method: &str, cell: impl Into<Cell>) {
        let column = self.columns.iter().position(|c| c.method == method);
        let column = column.unwrap_or_else(|| {
            self.add_column(method, Vec::new());
            self.columns.len() - 1
        });
        let row = self.rows.iter().position(|row| row.problem == problem);
        let row = row.unwrap_or_else(|| {
            self.rows.push(Row {
                problem: problem.into(),
                cells: Vec::new(),
            });
            self.rows.len() - 1
        });
        let cells = &mut self.rows[row].cells;
        if cells.len() <= column {
            cells.resize(column + 1, None);
        }
        cells[column] = Some(cell.into());
    }

    /// The cell of a problem and a method.
    pub fn cell(&self, problem: &str, method: &str) -> Option<&Cell> {
        let column = self.columns.iter().position(|c| c.method == method)?;
        let row = self.rows.iter().find(|row| row.problem == problem)?;
        row.cells.get(column)?.as_ref()
    }
}

/// The end of the first stability interval of a method on the oscillator, proved and measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StabilityLimit {
    /// Name of the method.
    pub method: String,
    /// The proved limit of `hω`.
    pub proved: f64,
    /// The smallest `hω` with observed growth.
    pub measured: f64,
}

impl StabilityLimit {
    /// The relative deviation of the measured limit from the proved limit.
    pub const fn deviation(&self) -> f64 {
        (self.measured / self.proved - 1.0).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector1;
    use symplectic::acceleration;

    symplectic::tableau! {
        Verlet { basis: polynomial(2), nodes: lobatto(2) }
        Gauss4 { basis: polynomial(4), nodes: gauss(4) }
    }

    /// A thousand steps of the oscillator with ω = 1.
    fn oscillator<M: Method>(method: M, step_size: f64) -> Verdict {
        let system = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q)
            .with_energy(|_, q, p| (q[0] * q[0] + p[0] * p[0]) / 2.0);
        let end = 1000.0 * step_size;
        let exact = State::from_arrays(end, [end.cos()], [-end.sin()]);
        let start = State::from_arrays(0.0, [1.0], [0.0]);
        let integrator = Integrator::new(method, system, start, step_size);
        Verdict::of(integrator, 1000, Some(&exact))
    }

    #[test]
    fn verdicts_distinguish_accurate_bounded_and_unstable_runs() {
        // Störmer–Verlet has an amplitude error of ν²/8 and a phase error of ν³/24 per step; it is unstable from ν = 2
        // on.
        let found = [0.01, 1.0, 2.5].map(|nu| oscillator(Verlet, nu));
        assert!(matches!(found[0], Verdict::Accurate { error } if error > 1e-6));
        assert!(
            matches!(found[1], Verdict::Bounded { energy, error } if energy < 1.0 && error > 0.1)
        );
        assert!(matches!(found[2], Verdict::Unstable { steps } if steps < 20));
        let stopped = oscillator(Gauss4, 10.0);
        assert!(matches!(
            stopped,
            Verdict::Stopped {
                cause: Cause::NoConvergence,
                ..
            }
        ));
        assert!(
            stopped
                .to_string()
                .starts_with("stopped: step 1 of size 10")
        );
        let letters: String = found
            .iter()
            .chain([&stopped])
            .map(Verdict::letter)
            .collect();
        assert_eq!(letters, "abun");
    }

    #[test]
    fn a_run_that_cannot_be_judged_is_stopped() {
        let system = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
        let start = State::from_arrays(0.0, [1.0], [0.0]);
        let without_energy = Integrator::new(Verlet, system, start.clone(), 0.1);
        let not_made = Integrator::new(Verlet, system, start, 0.0);
        for integrator in [without_energy, not_made] {
            assert_eq!(Verdict::of(integrator, 1, None).letter(), 'x');
        }
    }

    #[test]
    fn a_run_with_a_nan_energy_is_unstable() {
        let system = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q)
            .with_energy(|time, q, _| if time > 0.25 { f64::NAN } else { q[0] });
        let start = State::from_arrays(0.0, [1.0], [0.0]);
        let found = Verdict::of(Integrator::new(Verlet, system, start, 0.1), 10, None);
        assert_eq!(found, Verdict::Unstable { steps: 3 });
        let nothing = Verdict::Bounded {
            energy: f64::NAN,
            error: 1.0,
        };
        assert!(!nothing.is_finite());
    }

    #[test]
    fn cells_find_their_rows_and_columns() {
        let mut table = Verdicts::new("Small", "");
        let unstable = || Verdict::Unstable { steps: 3 };
        table.set("first", "A", Verdict::Accurate { error: 1e-4 });
        table.set("second", "B", unstable());
        let proved = |proved_stable| Cell {
            verdict: unstable(),
            proved_stable,
        };
        table.set("first", "B", proved(Some(false)));
        assert_eq!((table.rows.len(), table.columns.len()), (2, 2));
        assert_eq!(table.cell("second", "A"), None);
        assert_eq!(table.cell("second", "B"), Some(&unstable().into()));
        let found = table.cell("first", "B").expect("it was set");
        assert_eq!(found.is_as_proved(), Some(true));
        assert_eq!(proved(Some(true)).is_as_proved(), Some(false));
        assert_eq!(proved(None).is_as_proved(), None);
    }
}
