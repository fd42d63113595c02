//! The functions of a stepper's system, from a formula.
//!
//! The order of evaluation is that of [`operations`](symplectic_formula::operations), as in the code of the macros.

mod names;
mod writer;

use self::names::Names;
use self::writer::Writer;
use super::Stepper;
use super::languages::formulas::{Field, FieldShape, Formulas, formulas};
use super::template::fill;
use symplectic_compiler::{Error, ErrorKind};
use symplectic_exact::rounding::to_f64;
use symplectic_formula::derivative::{Scatter, gradient};
use symplectic_formula::display::Notation;
use symplectic_formula::graph::{Half, Id, integer};
use symplectic_formula::operations::Operations;
use symplectic_formula::statements::Goal;
use symplectic_formula::structure::each_once;
use symplectic_formula::syntax::Length;
use symplectic_formula::{Layout, Shape, Structure, System};

/// Refuses systems that are more than a formula of H.
pub(super) fn check(system: &System) -> Result<(), Error> {
    let what = if system.without_hamiltonian().is_some() {
        "a Lagrangian that is not quadratic in the velocities: there is no formula of H"
    } else if !system.functions.is_empty() {
        "functions that are written in Rust: write them as formulas"
    } else if system.is_constrained() {
        "constraints: take the macro `hamiltonian!`"
    } else if !system.is_free() {
        "friction or applied forces, which H does not contain: take the macro `hamiltonian!`"
    } else {
        return Ok(());
    };
    Err(ErrorKind::NoStepperOfSystem { what }.into())
}

/// The text after a stepper: parameters, velocity, force and energy. Of a splitting, velocity and force have one vector as argument.
pub(super) fn section(
    language: Stepper,
    system: &System,
    structure: &Structure,
    is_splitting: bool,
    method: &[(&str, &str); 3],
) -> Result<String, Error> {
    let mut system = system.clone();
    let energy = system.energy;
    let split = structure.split.ok();
    let [kinetic, potential] = split.map_or([energy; 2], |split| [split.kinetic, split.potential]);
    let graph = &mut system.graph;
    let velocity = gradient(graph, kinetic, &[], integer(1), Half::P);
    let force = gradient(graph, potential, &[], integer(-1), Half::Q);
    if graph.overflowed() {
        let what = "derivatives with too many sums in one another";
        return Err(ErrorKind::NoStepperOfSystem { what }.into());
    }
    let notation = formulas(language);
    let [.., (_, module)] = method;
    let names = Names::new(&system, notation, module);
    let text = Text {
        system: &system,
        names: &names,
        notation,
    };
    let roots = |parts: &[Scatter]| -> Vec<Id> { parts.iter().map(|part| part.value).collect() };
    let both = [roots(&velocity), roots(&force)].concat();
    // Parts of a separable H share nothing. Otherwise both are known, so that they have the same bits as together.
    let of = |parts: &[Scatter]| {
        if split.is_some() {
            roots(parts)
        } else {
            both.clone()
        }
    };
    let halves: [&[&str]; 2] = if is_splitting {
        [&["p"], &["q"]]
    } else {
        [&["q", "p"]; 2]
    };
    let enough = text.too_few(notation.enough, "");
    let velocity = text.derivative(&of(&velocity), "v", &velocity, halves[0]);
    let force = text.derivative(&of(&force), "f", &force, halves[1]);
    let energy = text.energy();
    let dimension = text.dimension();
    let [velocity_of, force_of] = halves.map(|half| text.arguments(half, &dimension));
    let mut values = vec![
        ("Type", &names.kind[..]),
        ("system", &names.prefix),
        ("dimension", &dimension),
        ("velocity_of", &velocity_of),
        ("force_of", &force_of),
        ("velocity", &velocity),
        ("force", &force),
        ("energy", &energy),
        ("enough", &enough),
    ];
    values.extend(method);
    let fields = text.fields();
    let parameters = fill(&(notation.declare)(&fields, system.least), &values);
    let usage = (notation.usage)(&fields);
    let usage: Vec<String> = usage.iter().map(|line| fill(line, &values)).collect();
    let about = (notation.comment)(&text.about(&usage));
    values.extend([("parameters", &parameters[..]), ("about", &about)]);
    Ok(fill(notation.template, &values))
}

/// The parts of the text.
struct Text<'a> {
    system: &'a System,
    names: &'a Names,
    notation: &'a Formulas,
}

impl Text<'_> {
    /// A writer of statements in a function that `outside` leaves without a result.
    fn writer<'a>(&'a self, operations: &'a Operations<'a>, outside: String) -> Writer<'a> {
        Writer {
            system: self.system,
            names: self.names,
            notation: self.notation,
            operations,
            outside,
        }
    }

    /// The body of a function that writes a derivative.
    fn derivative(&self, roots: &[Id], into: &str, parts: &[Scatter], reads: &[&str]) -> String {
        let operations = Operations::new(&self.system.graph, roots);
        let dimension = self.dimension();
        let vector = [("vector", into), ("dimension", &dimension)];
        let writer = self.writer(&operations, fill(self.notation.outside, &vector));
        // Entries that are set once need no zero first.
        let once = each_once(self.system, parts);
        let goals = parts.iter().map(|part| Goal {
            loops: part.loops.clone(),
            value: operations.of(part.value),
        });
        let goals: Vec<Goal> = goals.collect();
        let pattern = if once {
            self.notation.set
        } else {
            self.notation.increase
        };
        let mut body = String::new();
        if !once && !self.notation.clear.is_empty() {
            writer.line(&mut body, 0, &fill(self.notation.clear, &vector));
        }
        body.push_str(&writer.write(&goals, &|place, value| {
            let target = writer.entry(into, &parts[place].target);
            fill(pattern, &[("target", &target), ("value", value)])
        }));
        self.function(&body, self.notation.too_few, into, reads)
    }

    fn energy(&self) -> String {
        let operations = Operations::new(&self.system.graph, &[self.system.energy]);
        let goal = Goal {
            loops: Vec::new(),
            value: operations.of(self.system.energy),
        };
        let writer = self.writer(&operations, self.notation.outside_energy.to_owned());
        let body = writer.write(&[goal], &|_, value| {
            fill(self.notation.result, &[("value", value)])
        });
        self.function(&body, self.notation.too_few_for_energy, "", &["q", "p"])
    }

    /// The check that there are at least as many coordinates as the formula names.
    fn too_few(&self, pattern: &str, vector: &str) -> String {
        let length = self.system.layout.length();
        if self.system.least == 0 || matches!(length, Length::Fixed(_)) {
            return String::new();
        }
        let values = [
            ("length", &self.names.length(&length, self.notation)[..]),
            ("least", &self.system.least.to_string()),
            ("vector", vector),
            ("dimension", &self.dimension()),
        ];
        fill(pattern, &values)
    }

    /// A body with what comes before it.
    fn function(&self, body: &str, too_few: &str, into: &str, reads: &[&str]) -> String {
        let body = self.too_few(too_few, into) + body;
        let start = (self.notation.start)(&body, &self.names.prefix, reads);
        start + &body
    }

    /// The number of coordinates.
    fn dimension(&self) -> String {
        let components = self.system.layout.components();
        match self.system.layout.length() {
            Length::Fixed(n) => (n * components).to_string(),
            length => {
                let length = self.names.length(&length, self.notation);
                match components {
                    1 => length,
                    _ => fill(
                        self.notation.multiple,
                        &[("count", &components.to_string()), ("length", &length)],
                    ),
                }
            }
        }
    }

    fn arguments(&self, halves: &[&str], dimension: &str) -> String {
        let argument = |half: &&str| {
            fill(
                self.notation.argument,
                &[("half", half), ("dimension", dimension)],
            )
        };
        let arguments: Vec<String> = halves.iter().map(argument).collect();
        arguments.join(", ")
    }

    /// Lengths that the formula leaves open, and parameters.
    fn fields(&self) -> Vec<Field> {
        let lengths = self.names.lengths.iter().map(|(_, name)| Field {
            name: name.clone(),
            shape: FieldShape::Length,
        });
        let parameters = self.system.parameters.iter().zip(&self.names.parameters);
        let parameters = parameters.map(|(parameter, name)| Field {
            name: name.clone(),
            shape: match &parameter.shape {
                Shape::Number(default) => FieldShape::Number(default.as_ref().map(to_f64)),
                Shape::Array(lengths) => FieldShape::Array {
                    lengths: lengths
                        .iter()
                        .map(|length| self.names.length(length, self.notation))
                        .collect(),
                    is_fixed: lengths
                        .iter()
                        .all(|length| matches!(length, Length::Fixed(_))),
                },
                Shape::Pairs => FieldShape::Pairs {
                    count: self
                        .names
                        .length(&Length::PairsOf(parameter.name.clone()), self.notation),
                },
            },
        });
        lengths.chain(parameters).collect()
    }

    /// H, the meaning of the coordinates, and how the stepper takes the system.
    fn about(&self, usage: &[String]) -> Vec<String> {
        let system = self.system;
        let mut lines = vec![format!(
            "The system {}: H = {}",
            system.name,
            system.formula(system.energy, Notation::Text)
        )];
        match &system.layout {
            Layout::Named([q, p]) => {
                let [q, p] = [q, p].map(|names| names.join(", "));
                lines.push(format!("Positions q = ({q}), momenta p = ({p})."));
            }
            Layout::Numbered(_, None) => {}
            Layout::Numbered(_, Some(components)) => lines.push(format!(
                "The formula's q[i][k] is the entry {components} i + k of q, counted from 0; p likewise."
            )),
        }
        lines.extend(["", "Usage:", ""].map(str::to_owned));
        lines.extend(usage.iter().map(|line| format!("    {line}")));
        lines
    }
}
