//! What a study has found, as plain data: everything that is written or drawn comes from here alone.

use serde::{Deserialize, Serialize};

use super::{StabilityLimit, Verdicts};

/// All that was measured.
///
/// The writers are methods of it, and give the same bytes for the same measurements: [`csv`](Self::csv),
/// [`json`](Self::json), [`plots`](Self::plots), [`page`](Self::page), [`table`](Self::table); [`write`](Self::write) is all of
/// them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measurements {
    /// What the study is called.
    pub title: String,
    /// Where and how it was measured: the machine, the compiler, the date.
    pub circumstances: Vec<Fact>,
    /// The errors for which methods are compared.
    pub targets: Vec<f64>,
    /// The methods, in the order in which they first appear.
    pub methods: Vec<MethodRecord>,
    /// The problems.
    pub problems: Vec<ProblemRecord>,
    /// Tables of what becomes of methods, where they do not converge or steps are too long. No study fills them; they are
    /// drawn and written with all the rest.
    #[serde(default)]
    pub verdicts: Vec<Verdicts>,
    /// Limits of stability of methods, proved and measured.
    #[serde(default)]
    pub limits: Vec<StabilityLimit>,
}

/// Something to know, with its name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fact {
    /// What it is about.
    pub name: String,
    /// What there is to say.
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

/// A method, whatever the problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MethodRecord {
    /// What it is called, and its curves are.
    pub name: String,
    /// What it is, as far as that was seen.
    pub kind: Kind,
    /// What it was derived from: [`Method::DEFINITION`](symplectic::Method::DEFINITION).
    pub definition: Option<String>,
    /// Number of stages.
    pub stages: Option<usize>,
    /// What is proved of it. The harness leaves it empty: the compiler knows, from the definition.
    pub facts: Vec<Fact>,
}

/// What kind of method a curve belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Kind {
    /// One of the library that has solved no equations in any problem.
    Explicit,
    /// One of the library that has iterated.
    Implicit,
    /// One that is not of the library.
    Peer,
}

/// A problem, and how the methods did on it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProblemRecord {
    /// What it is called.
    pub name: String,
    /// The Hamiltonian and where the data are from.
    pub description: String,
    /// What it asks of a method.
    pub needs: String,
    /// Number of positions.
    pub dimension: usize,
    /// Time at the start.
    pub start: f64,
    /// Time at the end.
    pub end: f64,
    /// Where the state at the end is known from.
    pub reference: String,
    /// How well it is known, as an error of [`Measured::error`].
    pub uncertainty: f64,
    /// The step size whose energy over time is compared, if the problem asks for one.
    pub traced_at: Option<f64>,
    /// The names of the functions in [`Measured::drifts`].
    pub invariants: Vec<String>,
    /// The methods on it.
    pub curves: Vec<Curve>,
}

/// The runs of one method on one problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// The name of the method.
    pub method: String,
    /// What the [`Point::parameter`] is.
    pub parameter: Parameter,
    /// The runs, from coarse to fine.
    pub points: Vec<Point>,
    /// The energy over time in one of them, chosen so that the curves of a problem can be compared.
    pub trace: Option<Trace>,
}

impl Curve {
    /// The runs that came to the end, with their parameters.
    pub fn measured(&self) -> impl Iterator<Item = (f64, &Measured)> {
        self.points.iter().filter_map(|point| match &point.outcome {
            Outcome::Measured(measured) => Some((point.parameter, measured)),
            Outcome::Failed { .. } | Outcome::Skipped { .. } => None,
        })
    }
}

/// What is made smaller from run to run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Parameter {
    /// The step size.
    StepSize,
    /// A tolerance, relative or absolute.
    Tolerance,
}

/// One run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// The step size or the tolerance that was asked for.
    pub parameter: f64,
    /// What came of it.
    pub outcome: Outcome,
}

/// What came of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// It came to the end.
    Measured(Measured),
    /// It failed.
    Failed {
        /// With this error.
        error: String,
    },
    /// It was not made, or not to its end.
    Skipped {
        /// For this reason.
        reason: String,
    },
}

/// A run that came to the end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// The global error at the end: the larger one of `|q − q*|/|q*|` and `|p − p*|/|p*|` in 2-norms, absolute where the
    /// reference is zero.
    pub error: f64,
    /// The largest error of the energy along the run, relative to that at the start, absolute where it is zero there; `None`
    /// where the system does not know its energy.
    pub energy_error: Option<f64>,
    /// The largest deviations of the invariants of the problem, in the same sense; `None` where one is not finite.
    pub drifts: Vec<Option<f64>>,
    /// Seconds of CPU time: the median of the repetitions.
    pub seconds: f64,
    /// How often the time was taken.
    pub repetitions: usize,
    /// Steps taken, where they are known.
    pub steps: Option<u64>,
    /// Evaluations of a velocity or a force, each counted for itself.
    pub evaluations: u64,
    /// Iterations a step; 0 for an explicit method.
    pub mean_iterations: f64,
    /// The most iterations that one step took.
    pub most_iterations: u32,
}

/// The error of the energy over time: its range in equal parts of the time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// The parameter of the run.
    pub parameter: f64,
    /// The smallest and the largest relative error of the energy, with their signs, in each part of the time; `None` where the
    /// run shows no state.
    pub ranges: Vec<Option<(f64, f64)>>,
}

impl Measurements {
    /// Adds what `facts` knows of each definition of a method.
    ///
    /// The exact engine is no part of this crate; with it, `facts` proves the order and whatever else again.
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

    /// The measurements as JSON; [`from_json`](Self::from_json) reads them again, to the last bit.
    ///
    /// # Errors
    ///
    /// Where a number is not finite, which no study writes: it is null in JSON and cannot be read again.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        let mut text = serde_json::to_string_pretty(self)?;
        text.push('\n');
        Ok(text)
    }

    /// Reads [`json`](Self::json).
    ///
    /// # Errors
    ///
    /// Where the text is something else.
    pub fn from_json(text: &str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(text)
    }
}
