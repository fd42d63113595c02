//! A Hamiltonian system as a graph.

use std::collections::{BTreeMap, HashMap};

use super::derivative::Scatter;
use super::graph::{Coordinate, Graph, Half, Id, LoopId, Number, integer};
use super::smooth::{Powers, Smoothness, kinks};
use super::syntax::{Ends, Length, Name, Span};

/// A Hamiltonian system that was read from a formula.
#[derive(Debug, Clone)]
pub struct System {
    /// The source of the text.
    pub source: String,
    /// Its name.
    pub name: String,
    /// The generic lengths of its type.
    pub lengths: Vec<String>,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// Its coordinates.
    pub layout: Layout,
    /// The ends of a chain.
    pub ends: Option<Ends>,
    /// The user's functions, each with its first two derivatives.
    pub functions: Vec<[String; 3]>,
    /// All formulas.
    pub graph: Graph,
    /// H; L where H [does not follow](Legendre::None).
    pub energy: Id,
    /// The Lagrangian, if one was given.
    pub lagrangian: Option<Lagrangian>,
    /// The names of the velocities, if coordinates have names and velocities are known.
    pub velocities: Vec<String>,
    /// Holonomic constraints.
    pub constraints: Vec<Constraint>,
    /// Applied forces: each value is added to the force on its coordinate.
    pub applied: Vec<Scatter>,
    /// Non-holonomic constraints, linear in the velocities.
    pub nonholonomic: Vec<Constraint>,
    /// The rates γ of a friction `−γp`: none, one, or one for each component of a position or, if positions are vectors, of a vector.
    pub friction: Vec<Id>,
    /// The functions declared to be conserved.
    pub invariants: Vec<Invariant>,
    /// The required properties.
    pub required: Vec<Name>,
    /// The sums over bonds.
    pub bonds: Vec<Bonds>,
    /// The smallest number of coordinates the formula needs.
    pub least: usize,
    /// Where nodes were first read.
    pub places: HashMap<Id, Span>,
}

/// A Lagrangian.
#[derive(Debug, Clone)]
pub struct Lagrangian {
    /// L
    pub formula: Id,
    /// Applied forces, as functions of the velocities.
    pub applied: Vec<Scatter>,
    /// Whether H follows from L.
    pub legendre: Legendre,
}

/// Whether H follows from a Lagrangian.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Legendre {
    /// H follows: `L = v·M v/2 + A·v − U`, and M is a numeric matrix with a nonzero determinant.
    Regular,
    /// H follows, and the determinant of M is nonzero at random points.
    RegularAtRandomPoints,
    /// L is not quadratic in the velocities: there is no formula of H, and `energy` holds L.
    None,
}

/// A parameter.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its shape.
    pub shape: Shape,
}

/// The shape of a parameter.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A number, with its default value if it has one.
    Number(Option<Number>),
    /// Numbers in one or two dimensions.
    Array(Vec<Length>),
    /// Pairs of indices.
    Pairs,
}

/// The layout of positions and momenta.
#[derive(Debug, Clone)]
pub enum Layout {
    /// Named coordinates.
    Named([Vec<String>; 2]),
    /// Numbered coordinates, with the number of components if each is a vector.
    Numbered(Length, Option<usize>),
}

impl Layout {
    /// The names of all coordinates and momenta.
    pub fn names(&self) -> impl Iterator<Item = &String> {
        let names: &[Vec<String>] = match self {
            Layout::Named(names) => names,
            Layout::Numbered(..) => &[],
        };
        names.iter().flatten()
    }

    /// The statement of a drag on every coordinate, with the velocities if they are given, otherwise with the momenta; truncated if there
    /// are many coordinates.
    pub(super) fn drag(&self, velocities: Option<&[String]>) -> String {
        let drags = match (self, velocities) {
            (Layout::Named([positions, momenta]), velocities) => {
                let (letter, factors) = match velocities {
                    None => ("gamma", &momenta[..]),
                    Some(velocities) => ("c", velocities),
                };
                let pairs = positions.iter().zip(factors);
                let mut drags: Vec<String> = pairs
                    .map(|(position, factor)| format!("{position} = -{letter} {factor}"))
                    .collect();
                if drags.len() > 3 {
                    drags.truncate(2);
                    drags.push("…".to_owned());
                }
                drags.join(", ")
            }
            (Layout::Numbered(..), None) => "q[i] = -gamma p[i]".to_owned(),
            (Layout::Numbered(..), Some(_)) => "q[i] = -c v[i]".to_owned(),
        };
        format!("force: {{ {drags} }}")
    }

    /// The number of coordinates.
    pub fn length(&self) -> Length {
        match self {
            Layout::Named([names, _]) => Length::Fixed(names.len()),
            Layout::Numbered(length, _) => length.clone(),
        }
    }

    /// The number of components of each coordinate.
    pub fn components(&self) -> usize {
        match self {
            Layout::Numbered(_, Some(components)) => *components,
            _ => 1,
        }
    }

    /// The name of a coordinate.
    pub fn name(&self, half: Half, index: usize) -> String {
        match (self, half) {
            (Layout::Named([names, _]), Half::Q) | (Layout::Named([_, names]), Half::P) => {
                names[index].clone()
            }
            (_, half) => format!("{}[{index}]", half.letter()),
        }
    }
}

impl System {
    /// The Lagrangian, if there is no formula of H.
    pub fn without_hamiltonian(&self) -> Option<&Lagrangian> {
        let lagrangian = self.lagrangian.as_ref()?;
        (lagrangian.legendre == Legendre::None).then_some(lagrangian)
    }

    /// Whether the system consists of H alone: no constraint, no applied force, no friction.
    pub fn is_free(&self) -> bool {
        !self.is_constrained() && self.applied.is_empty() && self.friction.is_empty()
    }

    /// Whether there are constraints, holonomic or not.
    pub fn is_constrained(&self) -> bool {
        !(self.constraints.is_empty() && self.nonholonomic.is_empty())
    }

    /// An applied force that depends on momenta, if there is one.
    pub fn force_of_momenta(&self) -> Option<Id> {
        let mut values = self.applied.iter().map(|part| part.value);
        values.find(|&value| self.graph.depends(value).p)
    }

    /// The sum of the squares of all constraints, which changes wherever one of them changes; `None` without constraints.
    pub fn constraint_square(&mut self) -> Option<Id> {
        let mut terms = Vec::new();
        for constraint in &self.constraints {
            for &part in &constraint.parts {
                let square = self.graph.power(part, integer(2));
                terms.push(match constraint.over {
                    Some(over) => (integer(1), self.graph.total(over, square)),
                    None => (integer(1), square),
                });
            }
        }
        (!terms.is_empty()).then(|| self.graph.sum(terms))
    }

    /// Finds the powers at whose zeros all formulas are as smooth as they have to be, whatever [factors](Powers::Free) the powers have: the
    /// limits of their derivatives are those with 0 in place of the powers.
    pub(super) fn find_smooth_powers(&mut self) {
        let mut roots = vec![(self.energy, 2)];
        roots.extend(self.bonds.iter().map(|bonds| (bonds.potential, 2)));
        roots.extend(self.applied.iter().map(|part| (part.value, 1)));
        let parts = |all: &[Constraint]| all.iter().flat_map(|all| all.parts.clone()).collect();
        let [holonomic, others]: [Vec<Id>; 2] =
            [parts(&self.constraints), parts(&self.nonholonomic)];
        roots.extend(holonomic.into_iter().map(|part| (part, 2)));
        roots.extend(others.into_iter().map(|part| (part, 1)));
        if let Some(lagrangian) = &self.lagrangian {
            roots.push((lagrangian.formula, 2));
            roots.extend(lagrangian.applied.iter().map(|part| (part.value, 1)));
        }
        let invariants = self.invariants.iter().flat_map(|all| &all.parts);
        roots.extend(invariants.map(|part| (*part, 0)));
        roots.sort_unstable();
        roots.dedup();
        let mut bases: BTreeMap<Id, bool> = BTreeMap::new();
        for (root, order) in roots {
            for (kink, smoothness) in kinks(&self.graph, root, order, Powers::Free, |_| true) {
                for base in kink.bases {
                    *bases.entry(base).or_insert(true) &= smoothness == Smoothness::Smooth;
                }
            }
        }
        for (base, _) in bases.into_iter().filter(|(_, is_smooth)| *is_smooth) {
            self.graph.set_smooth(base);
        }
    }

    /// Where a node, or the node that it is a multiple of, was first read.
    pub fn place_of(&self, id: Id) -> Option<&Span> {
        let inner = self.graph.scaled(id).1;
        self.places.get(&inner).or_else(|| self.places.get(&id))
    }

    /// The name of a coordinate with a numeric index.
    pub fn name_of(&self, coordinate: &Coordinate) -> String {
        let index = usize::try_from(coordinate.index.offset).unwrap_or(0);
        match (self.velocities.get(index), &self.layout, coordinate.half) {
            (Some(velocity), Layout::Named(_), Half::V) => velocity.clone(),
            _ => self.layout.name(coordinate.half, index),
        }
    }
}

/// Functions of the positions, or forms of the velocities, that vanish.
#[derive(Debug, Clone)]
pub struct Constraint {
    /// The name.
    pub name: String,
    /// The loop over the indices of the family.
    pub over: Option<LoopId>,
    /// The vanishing function, or the components of a vanishing vector.
    pub parts: Vec<Id>,
}

/// A function of the state that is declared to be conserved.
#[derive(Debug, Clone)]
pub struct Invariant {
    /// Its name.
    pub name: String,
    /// The place of the name.
    pub span: Span,
    /// Its components.
    pub parts: Vec<Id>,
    /// Whether it is a number rather than a vector.
    pub scalar: bool,
    /// Whether it is proved to be conserved, by a symmetry visible in the formula.
    pub proved: bool,
}

/// A sum over the bonds of a chain.
#[derive(Debug, Clone)]
pub struct Bonds {
    /// The sum, written with the positions.
    pub whole: Id,
    /// The potential of a bond, a function of the position [`STRETCH`](super::elaborate::STRETCH).
    pub potential: Id,
}
