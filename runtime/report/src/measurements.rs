//! The results of a study as plain data, the only input of all writers and plots.

use serde::{Deserialize, Serialize};

use super::{StabilityLimit, Verdicts};

/// The measurements of a study.
///
/// Its writers produce the same bytes for the same measurements: [`csv`](Self::csv), [`json`](Self::json),
/// [`plots`](Self::plots), [`page`](Self::page), [`table`](Self::table); [`write`](Self::write) calls all of them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measurements {
    /// Title of the study.
    pub title: String,
    /// Circumstances of the measurement: machine, compiler, date.
    pub circumstances: Vec<Fact>,
    /// The errors for which methods are compared.
    pub targets: Vec<f64>,
    /// The methods, in the order in which they first appear.
    pub methods: Vec<MethodRecord>,
    /// The problems.
    pub problems: Vec<ProblemRecord>,
    /// Tables of verdicts, for large step sizes and failures to converge. A study leaves them empty; they are drawn and
    /// written with the other results.
    #[serde(default)]
    pub verdicts: Vec<Verdicts>,
    /// Limits of stability of methods, proved and measured.
    #[serde(default)]
    pub limits: Vec<StabilityLimit>,
}

/// A named fact.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fact {
    /// Name of the fact.
    pub name: String,
    /// Value of the fact.
    pub value: String,
}

impl Fact {
    /// The fact that `name` is `value`.
    pub fn new(name: impl Into<String>, value: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            value: value.into(),
        }
    }
}

/// A method, independent of the problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MethodRecord {
    /// Name of the method and of its curves.
    pub name: String,
    /// The kind of method, as observed.
    pub kind: Kind,
    /// Its definition: [`Method::DEFINITION`](symplectic::Method::DEFINITION).
    pub definition: Option<String>,
    /// Number of stages.
    pub stages: Option<usize>,
    /// Proved facts. A study leaves them empty; the compiler can derive them from the definition
    /// ([`Measurements::add_facts`]).
    pub facts: Vec<Fact>,
}

/// The kind of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Kind {
    /// A method of the library that did not iterate on any problem.
    Explicit,
    /// A method of the library that iterated.
    Implicit,
    /// A method from elsewhere.
    Peer,
}

/// A problem, with the results of the methods.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProblemRecord {
    /// Name of the problem.
    pub name: String,
    /// The Hamiltonian and the source of the data.
    pub description: String,
    /// Its requirements on a method.
    pub needs: String,
    /// Dimension of the position.
    pub dimension: usize,
    /// Time at the start.
    pub start: f64,
    /// Time at the end.
    pub end: f64,
    /// Source of the reference state at the end.
    pub reference: String,
    /// Uncertainty of the reference, as an error like [`Measured::error`].
    pub uncertainty: f64,
    /// The step size for the comparison of the energy over time, if given.
    pub traced_at: Option<f64>,
    /// Names of the invariants in [`Measured::drifts`].
    pub invariants: Vec<String>,
    /// The curves of the methods.
    pub curves: Vec<Curve>,
}

/// The runs of one method on one problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// The name of the method.
    pub method: String,
    /// Meaning of [`Point::parameter`].
    pub parameter: Parameter,
    /// The runs, from coarse to fine.
    pub points: Vec<Point>,
    /// The energy over time in one of the runs, chosen so that the curves of a problem are comparable.
    pub trace: Option<Trace>,
}

impl Curve {
    /// The runs that reached the end, with their parameters.
    pub fn measured(&self) -> impl Iterator<Item = (f64, &Measured)> {
        self.points.iter().filter_map(|point| match &point.outcome {
            Outcome::Measured(measured) => Some((point.parameter, measured)),
            Outcome::Failed { .. } | Outcome::Skipped { .. } => None,
        })
    }
}

/// The parameter that decreases from run to run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Parameter {
    /// The step size.
    StepSize,
    /// A tolerance, relative or absolute.
    Tolerance,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// The requested step size or tolerance.
    pub parameter: f64,
    /// The outcome.
    pub outcome: Outcome,
}

/// The outcome of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// It reached the end.
    Measured(Measured),
    /// It failed.
    Failed {
        /// The error message.
        error: String,
    },
    /// It was not started, or not completed.
    Skipped {
        /// The reason.
        reason: String,
    },
}

/// A run that reached the end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// The global error at the end: the larger of `|q − q*|/|q*|` and `|p − p*|/|p*|` in the 2-norm, absolute if the
    /// reference is zero.
    pub error: f64,
    /// The largest error of the energy along the run, relative to its initial value, absolute if that is zero; `None`
    /// if the system has no energy or the error is not finite.
    pub energy_error: Option<f64>,
    /// The largest deviations of the invariants of the problem, in the same sense; `None` if a deviation is not finite.
    pub drifts: Vec<Option<f64>>,
    /// Seconds of CPU time, the median of the repetitions.
    pub seconds: f64,
    /// Number of timed repetitions.
    pub repetitions: usize,
    /// Number of steps, if known.
    pub steps: Option<u64>,
    /// Number of evaluations of velocity and force, counted separately.
    pub evaluations: u64,
    /// Mean number of iterations per step; 0 for an explicit method.
    pub mean_iterations: f64,
    /// Largest number of iterations of a step.
    pub most_iterations: u32,
}

/// The error of the energy over time: its range in equal time intervals.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// Parameter of the run.
    pub parameter: f64,
    /// The smallest and the largest signed relative error of the energy in each time interval; `None` if it contains no
    /// observed state.
    pub ranges: Vec<Option<(f64, f64)>>,
}

impl Measurements {
    /// Adds the facts that `facts` returns for the definition of each method.
    ///
    /// This crate does not contain the exact engine; with it, `facts` can prove orders and other properties from the
    /// definition.
    pub fn add_facts(&mut self, mut facts: impl FnMut(&str) -> Vec<Fact>) {
        for method in &mut self.methods {
            if let Some(definition) = &method.definition {
                method.facts.extend(facts(definition));
            }
        }
    }

    /// The method of this name.
    pub fn method(&self, name: &str) -> Option<&MethodRecord> {
        self.methods.iter().find(|method| method.name == name)
    }

    /// The measurements as JSON; [`from_json`](Self::from_json) restores them bit for bit.
    ///
    /// # Errors
    ///
    /// Errors of the serializer. A number that is not finite becomes null, which [`from_json`](Self::from_json)
    /// refuses; a study writes none.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        let mut text = serde_json::to_string_pretty(self)?;
        text.push('\n');
        Ok(text)
    }

    /// Parses the output of [`json`](Self::json).
    ///
    /// # Errors
    ///
    /// If the text has another format.
    pub fn from_json(text: &str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(text)
    }
}
