//! From a definition to a graph: the meanings of names, the shapes of values, the ranges of indices.

mod arithmetic;
mod constants;
mod constraints;
mod declarations;
mod forces;
mod indices;
mod nonholonomic;
mod smooth;
mod totals;
mod values;

use std::collections::HashMap;

use self::declarations::{check_names, coordinate, layout, parameters};
use self::smooth::Role;
pub use self::totals::STRETCH;
use super::graph::{Base, Coordinate, Graph, Half, Id, Index, LoopId, Node};
use super::syntax::{CoordinatesKind, Definition, Form, Length, Span};
use super::system::{Bonds, Invariant, Lagrangian, Layout, Legendre, Parameter, Shape, System};
use symplectic_exact::error::Error;
use symplectic_exact::error::FormulaError;
use symplectic_exact::input::Input;

/// The longest array that is written out if it is used as a whole.
const MAX_COMPONENTS: usize = 64;
/// The largest exponent, and the largest denominator of an exponent.
const MAX_EXPONENT: i64 = 1000;
/// The largest exponent of powers of powers.
const MAX_JOINED_EXPONENT: i64 = 1_000_000;
/// The largest number of nodes of a graph.
const MAX_NODES: usize = 1_000_000;

/// A value: a number, or an array.
#[derive(Debug, Clone)]
enum Value {
    Scalar(Id),
    Vector(Vec<Id>),
    Matrix(Vec<Vec<Id>>),
    /// Positions or momenta as a whole.
    Half(Half),
    /// A parameter as a whole.
    Parameter(usize),
    /// The index of a loop, or a length.
    Index(Index),
    /// An abbreviation with arguments.
    Abbreviation(usize),
    /// A function of the user.
    Function(usize),
}

/// Whether momenta are available here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Momenta {
    Known,
    NotInLagrangian,
    NotInForce,
}

/// Elaborates a definition. The energy of a Lagrangian system is not known yet; its field holds L.
///
/// # Errors
/// Unknown names, wrong shapes, indices out of range, functions that are not smooth, each at its place.
pub fn elaborate(input: Input<'_>, definition: &Definition) -> Result<System, Error> {
    check_names(input, definition)?;
    let (layout, velocities) = layout(input, definition)?;
    let parameters = parameters(input, definition, &layout)?;
    let elaborator = Elaborator {
        input,
        definition,
        layout,
        velocities,
        momenta: match definition.form {
            Form::Hamiltonian => Momenta::Known,
            Form::Lagrangian => Momenta::NotInLagrangian,
        },
        parameters,
        graph: Graph::default(),
        names: HashMap::new(),
        locals: Vec::new(),
        expansions: 0,
        nested: 0,
        loops: Vec::new(),
        bonds: Vec::new(),
        least: 0,
        places: HashMap::new(),
        powers: HashMap::new(),
    };
    elaborator.run()
}

struct Elaborator<'a> {
    input: Input<'a>,
    definition: &'a Definition,
    layout: Layout,
    /// The names of velocities.
    velocities: Vec<String>,
    momenta: Momenta,
    parameters: Vec<Parameter>,
    graph: Graph,
    /// The meanings of names.
    names: HashMap<String, Value>,
    /// The names that are only valid in a part of the formula.
    locals: Vec<String>,
    /// How many abbreviations with arguments have been written out.
    expansions: usize,
    /// The number of nested abbreviations around the current expression.
    nested: usize,
    /// The loops around the current expression.
    loops: Vec<LoopId>,
    bonds: Vec<Bonds>,
    /// The smallest number of coordinates the formula needs.
    least: usize,
    /// Where a node was first read.
    places: HashMap<Id, Span>,
    /// Where the base of a power that is not whole was first read.
    powers: HashMap<Id, Span>,
}

impl Elaborator<'_> {
    fn run(mut self) -> Result<System, Error> {
        let definition = self.definition;
        if let Layout::Named(names) = self.layout.clone() {
            let names = names.iter().chain([&self.velocities]);
            for (half, names) in [Half::Q, Half::P, Half::V].into_iter().zip(names) {
                for (k, name) in names.iter().enumerate() {
                    let coordinate = Coordinate {
                        half,
                        index: Index::number(k as i64),
                        component: 0,
                    };
                    let id = self.graph.coordinate(coordinate);
                    self.names.insert(name.clone(), Value::Scalar(id));
                }
            }
        }
        for (k, parameter) in self.parameters.iter().enumerate() {
            let value = match parameter.shape {
                Shape::Number(_) => Value::Scalar(self.graph.parameter(k, Vec::new())),
                Shape::Array(_) | Shape::Pairs => Value::Parameter(k),
            };
            self.names.insert(parameter.name.clone(), value);
        }
        for length in &definition.lengths {
            let index = Index::of(Base::End(Length::Generic(length.text.clone())));
            self.names.insert(length.text.clone(), Value::Index(index));
        }
        let velocity = definition.form == Form::Lagrangian || definition.velocities.is_some();
        let halves = [Half::Q, Half::P]
            .into_iter()
            .chain(velocity.then_some(Half::V));
        for half in halves {
            // A single coordinate can have this name.
            let name = self.names.entry(half.letter().to_owned());
            name.or_insert(Value::Half(half));
        }
        for (k, [function, ..]) in definition.functions.iter().enumerate() {
            self.names.insert(function.text.clone(), Value::Function(k));
        }
        for (k, abbreviation) in definition.abbreviations.iter().enumerate() {
            let name = &abbreviation.name;
            if self.names.contains_key(&name.text) {
                return Err(self.taken(name));
            }
            let value = match abbreviation.arguments.is_empty() {
                true => self.value(&abbreviation.value)?,
                false => Value::Abbreviation(k),
            };
            self.names.insert(name.text.clone(), value);
        }
        let Some(written) = &definition.function else {
            let (part, example) = match definition.form {
                Form::Hamiltonian => ("Hamiltonian", "H = p^2/2 - cos(q)"),
                Form::Lagrangian => ("Lagrangian", "L = v^2/2 + cos(q)"),
            };
            let kind = FormulaError::Missing { part, example };
            return Err(self.input.error(&definition.name.span, kind.into()));
        };
        let energy = self.scalar(written)?;
        if definition.form == Form::Hamiltonian {
            self.no_velocity(energy, written)?;
        }
        self.check_smooth(energy, Role::Function, written)?;
        self.momenta = Momenta::Known;
        let constraints = self.constraints()?;
        let applied = self.forces()?;
        let nonholonomic = self.nonholonomic(&constraints)?;
        let friction = self.friction()?;
        let mut invariants: Vec<Invariant> = Vec::new();
        for (name, written) in &definition.invariants {
            let meaning = match name.text.as_str() {
                "new" => Some("what makes a system"),
                "momentum_of_velocity" if definition.form == Form::Lagrangian => {
                    Some("the function for p = ∂L/∂v")
                }
                "energy" => Some("the value of H, which is observed"),
                // The momentum of a cyclic coordinate is observed by its name.
                text if self.layout.names().any(|known| known == text) => {
                    Some(coordinate(definition.form))
                }
                text if invariants.iter().any(|known| known.name == text) => Some("an invariant"),
                _ => None,
            };
            if let Some(meaning) = meaning {
                let kind = FormulaError::Taken {
                    name: name.text.clone(),
                    meaning: meaning.to_owned(),
                };
                return Err(self.input.error(&name.span, kind.into()));
            }
            let (parts, scalar) = match self.value(written)? {
                Value::Scalar(id) => (vec![id], true),
                value => (self.components(value, written)?, false),
            };
            if parts.iter().any(|&part| self.graph.depends(part).v) {
                let what = match name.text.is_empty() {
                    true => "a velocity",
                    false => "a velocity in a conserved quantity",
                };
                let kind = FormulaError::Unsupported {
                    what: what.to_owned(),
                    instead: "write it with the momenta: `p`, or `pa` for the coordinate `a`",
                };
                return self.error(written, kind);
            }
            for &part in &parts {
                self.check_smooth(part, Role::Quantity, written)?;
            }
            invariants.push(Invariant {
                name: name.text.clone(),
                span: name.span.clone(),
                parts,
                scalar,
                proved: false,
            });
        }
        let lagrangian = match definition.form {
            Form::Hamiltonian => {
                self.all_appear(energy)?;
                None
            }
            Form::Lagrangian => Some(Lagrangian {
                formula: energy,
                applied: applied.clone(),
                legendre: Legendre::None,
            }),
        };
        Ok(System {
            source: self.input.name.to_owned(),
            name: definition.name.text.clone(),
            lengths: definition
                .lengths
                .iter()
                .map(|length| length.text.clone())
                .collect(),
            parameters: self.parameters,
            layout: self.layout,
            ends: definition.ends.as_ref().map(|(ends, _)| *ends),
            functions: definition
                .functions
                .iter()
                .map(|all| all.clone().map(|name| name.text))
                .collect(),
            graph: self.graph,
            energy,
            lagrangian,
            velocities: self.velocities,
            constraints,
            applied,
            nonholonomic,
            friction,
            invariants,
            required: definition.required.clone(),
            bonds: self.bonds,
            least: self.least,
            places: self.places,
        })
    }

    /// The meaning of a name, for messages.
    fn meaning(&self, name: &str) -> String {
        match self.names.get(name) {
            Some(Value::Half(Half::Q)) => "the positions".to_owned(),
            Some(Value::Half(Half::P)) => "the momenta".to_owned(),
            Some(Value::Half(Half::V)) => "the velocities".to_owned(),
            Some(Value::Parameter(_)) => "a parameter".to_owned(),
            Some(Value::Index(_)) => "an index or a length".to_owned(),
            Some(Value::Function(_)) => "a function".to_owned(),
            // The formula of a Lagrangian does not name it.
            Some(value) if self.definition.form == Form::Lagrangian && self.is_momentum(value) => {
                "the name of a momentum".to_owned()
            }
            _ if self.locals.iter().any(|known| known == name) => "an argument".to_owned(),
            _ if self
                .parameters
                .iter()
                .any(|parameter| parameter.name == name) =>
            {
                "a parameter".to_owned()
            }
            _ if self
                .layout
                .names()
                .chain(&self.velocities)
                .any(|known| known == name) =>
            {
                coordinate(self.definition.form).to_owned()
            }
            _ => "an abbreviation".to_owned(),
        }
    }

    /// Checks that every momentum, and every coordinate or its momentum, is in H.
    fn all_appear(&self, energy: Id) -> Result<(), Error> {
        let below = self.graph.below([energy]);
        let appears = |half: Half, k: Option<i64>| {
            below.iter().any(|&id| match self.graph.node(id) {
                Node::Coordinate(found) => {
                    found.half == half && k.is_none_or(|k| found.index == Index::number(k))
                }
                _ => false,
            })
        };
        let unused = |span: &Span, coordinate: String| {
            Err(self
                .input
                .error(span, FormulaError::Unused { coordinate }.into()))
        };
        let spans = self.definition.coordinates.iter().flatten();
        let [q, p] = [0, 1].map(|k| spans.clone().nth(k));
        let (Some(q), Some(p)) = (q, p) else {
            return Ok(());
        };
        if let (CoordinatesKind::Named(positions), CoordinatesKind::Named(momenta)) =
            (&q.kind, &p.kind)
        {
            for (k, (position, momentum)) in positions.iter().zip(momenta).enumerate() {
                let k = Some(k as i64);
                if !appears(Half::P, k) {
                    let neither = !appears(Half::Q, k);
                    return match neither {
                        true => unused(
                            &position.span,
                            format!("`{}` and its momentum `{}`", position.text, momentum.text),
                        ),
                        false => {
                            unused(&momentum.span, format!("the momentum `{}`", momentum.text))
                        }
                    };
                }
            }
        } else if !appears(Half::P, None) {
            return unused(&p.span, "the momentum `p`".to_owned());
        }
        Ok(())
    }
}
