//! Derived tableaux.

use std::sync::Arc;

use clap::ValueEnum;
use pyo3::prelude::*;
use symplectic_cli::output::{Format, write};
use symplectic_compiler::export::toml;
use symplectic_compiler::stability::StableSteps;
use symplectic_compiler::{
    Definition, Evidence, Key, Limits, Property, Requirement, SeparableProperties,
    Tableau as Exact, catalogue, check, did_you_mean,
};
use symplectic_tools::{SteppedClass, Stepper, certificate};

use crate::errors;
use crate::formula::Formula;

/// A derived tableau, with its proofs.
#[pyclass(frozen, module = "symplectica._native")]
pub(crate) struct Tableau(pub(crate) Arc<Exact>);

/// Lists and matrices of a tableau, by name.
type Coefficients<T> = [(&'static str, Vec<Vec<T>>); 6];

/// A property with its evidence.
type Statement = (
    &'static str,
    bool,
    &'static str,
    Option<u32>,
    Option<String>,
);

fn limits(max_stages: Option<usize>) -> Limits {
    max_stages.map_or_else(Limits::default, Limits::at_most)
}

fn listed<T: Clone>(all: symplectic_compiler::Coefficients<T>) -> Coefficients<T> {
    [
        ("a", all.a),
        ("a_tilde", all.a_tilde),
        ("b", vec![all.b]),
        ("b_tilde", vec![all.b_tilde]),
        ("c", vec![all.c]),
        ("c_tilde", vec![all.c_tilde]),
    ]
}

#[pymethods]
impl Tableau {
    /// Derives the tableau of a definition: its keys with their values.
    #[staticmethod]
    #[pyo3(signature = (parts, name=None, max_stages=None))]
    fn derive(
        py: Python<'_>,
        parts: Vec<(String, String)>,
        name: Option<String>,
        max_stages: Option<usize>,
    ) -> PyResult<Self> {
        let mut given = Vec::new();
        for (key, value) in parts {
            let Some(found) = Key::find(&key) else {
                let known: Vec<&str> = Key::ALL.iter().map(|key| key.name()).collect();
                return Err(errors::argument(format!(
                    "a method has no key `{key}`; its keys are {}{}",
                    known.join(", "),
                    did_you_mean(&key, known.iter().copied())
                )));
            };
            given.push((found, value));
        }
        let derived = py.detach(|| Definition::new(given).derive(&limits(max_stages)));
        Self::named(derived, name)
    }

    /// A method of the catalogue.
    #[staticmethod]
    #[pyo3(signature = (name, max_stages=None))]
    fn of_catalogue(py: Python<'_>, name: &str, max_stages: Option<usize>) -> PyResult<Self> {
        let entry = catalogue::find(name)
            .ok_or_else(|| catalogue::unknown(name))
            .map_err(|error| errors::definition(&error))?;
        let limits = max_stages.map_or(entry.limits(), |most| limits(Some(most)));
        let derived = py.detach(|| entry.derive_within(&limits));
        Self::named(derived, Some(entry.name))
    }

    /// The tableau of a text in TOML or JSON, proved again and compared with the text.
    #[staticmethod]
    #[pyo3(signature = (source, text, max_stages=None))]
    fn read(py: Python<'_>, source: &str, text: &str, max_stages: Option<usize>) -> PyResult<Self> {
        let derived = py.detach(|| check(source, text, &limits(max_stages)));
        Self::named(derived, None)
    }

    /// Its name, if it has one.
    #[getter]
    fn name(&self) -> Option<&str> {
        self.0.name()
    }

    /// The number of stages.
    #[getter]
    fn stages(&self) -> usize {
        self.0.stages()
    }

    /// The keys of its definition with their values.
    #[getter]
    fn definition(&self) -> Vec<(&'static str, String)> {
        let definition = &self.0.provenance().definition;
        let parts = definition.parts();
        parts
            .map(|(key, value)| (key.name(), value.to_owned()))
            .collect()
    }

    /// The source of the method, if it is known.
    #[getter]
    fn source(&self) -> Option<String> {
        self.0.provenance().source.clone()
    }

    /// The printed numbers of a claim that are not correctly rounded.
    #[getter]
    fn wrong_digits(&self) -> Vec<String> {
        let wrong = self.0.wrong_digits().iter();
        wrong.map(ToString::to_string).collect()
    }

    /// The correctly rounded doubles: `a`, `a_tilde`, and one row for each of `b`, `b_tilde`, `c`, `c_tilde`.
    fn doubles(&self) -> Coefficients<f64> {
        listed(self.0.to_f64())
    }

    /// The exact forms, `None` where there is no short one.
    fn exact(&self) -> Coefficients<Option<String>> {
        listed(self.0.exact_forms())
    }

    /// The tableau in a format of the command line.
    #[pyo3(signature = (format, digits=None))]
    fn write(&self, py: Python<'_>, format: &str, digits: Option<usize>) -> PyResult<String> {
        let Ok(found) = Format::from_str(format, false) else {
            let known = Format::value_variants().iter();
            let known: Vec<String> = known
                .filter_map(|format| Some(format.to_possible_value()?.get_name().to_owned()))
                .collect();
            return Err(errors::argument(format!(
                "unknown format `{format}`; known here: {}{}",
                known.join(", "),
                did_you_mean(format, known.iter().map(String::as_str))
            )));
        };
        if digits.is_some_and(|digits| !(1..=10_000).contains(&digits)) {
            return Err(errors::argument("digits must be from 1 to 10000"));
        }
        py.detach(|| write(&self.0, found, digits))
            .map_err(|error| errors::definition(&error))
    }

    /// All exact data, to derive it again.
    fn toml(&self) -> String {
        toml::write(&self.0, 17)
    }

    /// The certificate for the independent checker.
    fn certificate(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| certificate::write(&self.0))
            .map_err(|error| errors::definition(&error))
    }

    /// A program that takes steps with the method, and with a formula if there is one.
    #[pyo3(signature = (language, formula=None, kind=None))]
    fn emit(
        &self,
        language: &str,
        formula: Option<&Formula>,
        kind: Option<&str>,
    ) -> PyResult<String> {
        let language = match language {
            "c" => Stepper::C,
            "rust" => Stepper::Rust,
            "julia" => Stepper::Julia,
            "python" => Stepper::Python,
            _ => {
                return Err(errors::argument(format!(
                    "unknown language `{language}`; known here: c, rust, julia, python"
                )));
            }
        };
        let class = match kind {
            None => None,
            Some("general") => Some(SteppedClass::General),
            Some("separable") => Some(SteppedClass::Separable),
            Some(other) => {
                return Err(errors::argument(format!(
                    "unknown class `{other}`; known here: general, separable"
                )));
            }
        };
        match formula {
            None => language.write(&self.0, class),
            Some(formula) => {
                language.write_with_system(&self.0, class, formula.system(), formula.structure())
            }
        }
        .map_err(|error| errors::definition(&error))
    }

    /// Decides a requirement such as `symplectic` or `order(separable) == 4`.
    #[pyo3(signature = (requirement, accepted_bits=None))]
    fn require(
        &self,
        py: Python<'_>,
        requirement: &str,
        accepted_bits: Option<u32>,
    ) -> PyResult<()> {
        let read = Requirement::parse(requirement).map_err(|error| errors::definition(&error))?;
        py.detach(|| self.0.require(&read, accepted_bits))
            .map_err(|kind| errors::proof(&kind.to_string(), requirement))
    }

    /// What holds for separable H: name, whether it holds, evidence, binary places of a verification, witness.
    fn separable_properties(&self, py: Python<'_>) -> Vec<Statement> {
        let found = py.detach(|| self.0.separable_properties());
        let statement = |(name, property): (&'static str, &Property)| {
            let (evidence, bits) = match property.evidence {
                Evidence::Proved => ("proved", None),
                Evidence::Refuted => ("refuted", None),
                Evidence::Certified => ("certified", None),
                Evidence::Verified { bits } => ("verified", Some(bits)),
                Evidence::Undecided { bits } => ("undecided", Some(bits)),
            };
            (
                name,
                property.holds,
                evidence,
                bits,
                property.witness.clone(),
            )
        };
        let names = SeparableProperties::NAMES.into_iter();
        let all = names.filter_map(|name| Some((name, found.get(name)?)));
        all.map(statement).collect()
    }

    /// Forces per step of a method that is explicit for separable H.
    #[getter]
    fn forces(&self) -> Option<usize> {
        self.0.evaluations().map(|evaluations| evaluations.cost())
    }

    /// The stable steps hω on the oscillator, as text.
    #[getter]
    fn stable_steps(&self, py: Python<'_>) -> String {
        py.detach(|| match self.0.stable_steps() {
            StableSteps::NotComputed => "not computed".to_owned(),
            steps => steps.to_string(),
        })
    }

    /// The adjoint method.
    fn adjoint(&self, py: Python<'_>) -> Self {
        Tableau(Arc::new(py.detach(|| self.0.adjoint())))
    }

    /// Whether another tableau has the same coefficients.
    fn has_coefficients_of(&self, py: Python<'_>, other: &Self) -> bool {
        py.detach(|| self.0.has_coefficients_of(&other.0))
    }
}

impl Tableau {
    pub(crate) fn named(
        derived: Result<Exact, symplectic_compiler::Error>,
        name: Option<String>,
    ) -> PyResult<Self> {
        let tableau = derived.map_err(|error| errors::definition(&error))?;
        Ok(Tableau(Arc::new(match name {
            Some(name) => tableau.named(name),
            None => tableau,
        })))
    }
}
