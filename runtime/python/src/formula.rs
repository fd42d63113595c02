//! Systems that are given by formulas.

use pyo3::prelude::*;
use symplectic_formula::display::{Notation, number_text};
use symplectic_formula::graph::Half;
use symplectic_formula::syntax::Length;
use symplectic_formula::{Form, Layout, Shape, Structure, System, description};
use symplectic_run::method::constraints_of;

use crate::errors;

/// A system that is given by the formula of H or L.
#[pyclass(frozen, module = "symplectica._native")]
pub(crate) struct Formula {
    text: String,
    form: Form,
    system: System,
    structure: Structure,
}

impl Formula {
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    pub(crate) fn form(&self) -> Form {
        self.form
    }

    pub(crate) fn system(&self) -> &System {
        &self.system
    }

    pub(crate) fn structure(&self) -> &Structure {
        &self.structure
    }
}

fn notation(latex: bool) -> Notation {
    match latex {
        true => Notation::Latex,
        false => Notation::Text,
    }
}

fn words(length: &Length) -> String {
    match length {
        Length::Fixed(n) => n.to_string(),
        Length::Generic(name) => name.clone(),
        Length::Runtime => "n".to_owned(),
        Length::PairsOf(name) => format!("pairs of {name}"),
    }
}

#[pymethods]
impl Formula {
    /// Reads a formula and checks what it requires and declares.
    #[new]
    fn new(py: Python<'_>, source: &str, text: String) -> PyResult<Self> {
        let form = Form::of(&text);
        let read = py.detach(|| {
            let mut system = System::read_as(form, source, &text)?;
            let structure = Structure::of(&mut system);
            system.check(&structure, &text)?;
            Ok((system, structure))
        });
        let (system, structure) = read.map_err(|error| errors::definition(&error))?;
        Ok(Formula {
            text,
            form,
            system,
            structure,
        })
    }

    #[getter(text)]
    fn own_text(&self) -> &str {
        &self.text
    }

    #[getter]
    fn name(&self) -> &str {
        &self.system.name
    }

    /// Why no run is possible with this formula in Python, if so.
    #[getter]
    fn refusal(&self) -> Option<&'static str> {
        if self.system.without_hamiltonian().is_some() {
            Some("a Lagrangian that is not quadratic in the velocities")
        } else if !self.system.functions.is_empty() {
            Some("functions that are written in Rust")
        } else {
            None
        }
    }

    /// `H` or `L`.
    #[getter]
    fn function(&self) -> &'static str {
        match self.form {
            Form::Hamiltonian => "H",
            Form::Lagrangian => "L",
        }
    }

    /// The names of positions and momenta, if they have names.
    #[getter]
    fn coordinates(&self) -> Option<[Vec<String>; 2]> {
        match &self.system.layout {
            Layout::Named(names) => Some(names.clone()),
            Layout::Numbered(..) => None,
        }
    }

    /// The number of coordinates, or of bodies, if the formula fixes it, and the number of components of each.
    #[getter]
    fn layout(&self) -> (Option<usize>, usize) {
        let length = match self.system.layout.length() {
            Length::Fixed(n) => Some(n),
            _ => None,
        };
        (length, self.system.layout.components())
    }

    /// Name, lengths (none for a number, `pairs` for pairs of indices) and default of each parameter.
    #[getter]
    fn parameters(&self) -> Vec<(String, Vec<String>, Option<String>)> {
        let described = |parameter: &symplectic_formula::Parameter| {
            let (lengths, default) = match &parameter.shape {
                Shape::Number(default) => (Vec::new(), default.as_ref().map(number_text)),
                Shape::Array(lengths) => (lengths.iter().map(words).collect(), None),
                Shape::Pairs => (vec!["pairs".to_owned(), "2".to_owned()], None),
            };
            (parameter.name.clone(), lengths, default)
        };
        self.system.parameters.iter().map(described).collect()
    }

    /// Whether H = T(t, p) + U(t, q) and no force depends on momenta.
    #[getter]
    pub(crate) fn is_separable(&self) -> bool {
        self.structure.split.is_ok() && self.system.force_of_momenta().is_none()
    }

    /// Whether the constraints are holonomic, if there are any.
    #[getter]
    fn constraints(&self) -> Option<bool> {
        constraints_of(&self.system)
    }

    #[getter]
    fn has_friction(&self) -> bool {
        !self.system.friction.is_empty()
    }

    /// Whether H is the same along every trajectory.
    #[getter]
    fn conserves_energy(&self) -> bool {
        description::conserves_energy(&self.system, &self.structure)
    }

    /// The equations of motion.
    fn equations(&self, latex: bool) -> Vec<String> {
        let notation = notation(latex);
        let mut all = self.system.equations_of_motion(notation);
        all.extend(self.system.constraint_equations(notation));
        all
    }

    /// What was found in the formula, a sentence each.
    fn facts(&self) -> Vec<String> {
        description::facts(&self.system, &self.structure)
    }

    /// The text of `symplectic derive-system`.
    fn describe(&self, format: &str) -> PyResult<String> {
        match format {
            "text" => Ok(description::text(&self.system, &self.structure)),
            "latex" => Ok(description::latex(&self.system, &self.structure)),
            "json" => Ok(description::json(&self.system, &self.structure).to_string()),
            _ => Err(errors::argument(format!(
                "unknown format `{format}`; known here: text, latex, json"
            ))),
        }
    }

    /// The Hamiltonian, also of a Lagrangian.
    fn hamiltonian(&self, latex: bool) -> String {
        self.system.formula(self.system.energy, notation(latex))
    }

    /// The name of each component of a position and of a momentum, for columns of a table.
    fn names(&self, dimension: usize) -> [Vec<String>; 2] {
        let components = self.system.layout.components();
        [Half::Q, Half::P].map(|half| {
            let name = |k: usize| match components {
                1 => self.system.layout.name(half, k),
                _ => {
                    let body = self.system.layout.name(half, k / components);
                    format!("{body}[{}]", k % components)
                }
            };
            let bound = match &self.system.layout {
                Layout::Named([names, _]) => names.len().min(dimension),
                Layout::Numbered(..) => dimension,
            };
            (0..bound).map(name).collect()
        })
    }
}
