//! A Hamiltonian system as a graph.

use std::collections::HashMap;

use super::derivative::Scatter;
use super::graph::{Coordinate, Graph, Half, Id, LoopId, Number, integer};
use super::syntax::{Ends, Length, Name, Span};

/// A Hamiltonian system that was read from a formula.
#[derive(Debug, Clone)]
pub struct System {
    /// Where the text is from.
    pub source: String,
    /// Its name.
    pub name: String,
    /// The lengths that its type is generic in.
    pub lengths: Vec<String>,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// Its coordinates.
    pub layout: Layout,
    /// How it ends, if it is a chain.
    pub ends: Option<Ends>,
    /// The functions of the user, each with its two derivatives.
    pub functions: Vec<[String; 3]>,
    /// All formulas.
    pub graph: Graph,
    /// H; L where H [does not follow](Legendre::None).
    pub energy: Id,
    /// The Lagrangian, if one was given.
    pub lagrangian: Option<Lagrangian>,
    /// The names of the velocities, where coordinates have names and velocities are known.
    pub velocities: Vec<String>,
    /// Holonomic constraints.
    pub constraints: Vec<Constraint>,
    /// Applied forces: each value is added to the force on its coordinate.
    pub applied: Vec<Scatter>,
    /// Non-holonomic constraints, linear in the velocities.
    pub nonholonomic: Vec<Constraint>,
    /// The rate γ of a friction `−γp`.
    pub friction: Option<Id>,
    /// What is said to be conserved.
    pub invariants: Vec<Invariant>,
    /// What it has to be.
    pub required: Vec<Name>,
    /// The sums over bonds.
    pub bonds: Vec<Bonds>,
    /// How many coordinates there have to be at least.
    pub least: usize,
    /// Where nodes were read first.
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
    /// It does: `L = v·M v/2 + A·v − U`, and M consists of numbers, with a determinant that is not zero.
    Regular,
    /// It does, and the determinant of M is not zero at random points.
    RegularAtRandomPoints,
    /// L is not quadratic in the velocities: there is no formula of H, and the formula of the energy is L.
    None,
}

/// A parameter.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// What it holds.
    pub shape: Shape,
}

/// What a parameter holds.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A number, with the value that it has unless another is set.
    Number(Option<Number>),
    /// Numbers in one or two dimensions.
    Array(Vec<Length>),
    /// Pairs of indices.
    Pairs,
}

/// How positions and momenta are laid out.
#[derive(Debug, Clone)]
pub enum Layout {
    /// Each has a name.
    Named([Vec<String>; 2]),
    /// They are numbered; with the number of components, if each is a vector.
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

    /// How many there are.
    pub fn length(&self) -> Length {
        match self {
            Layout::Named([names, _]) => Length::Fixed(names.len()),
            Layout::Numbered(length, _) => length.clone(),
        }
    }

    /// The number of components of each.
    pub fn components(&self) -> usize {
        match self {
            Layout::Numbered(_, Some(components)) => *components,
            _ => 1,
        }
    }

    /// What a coordinate is called.
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

    /// Whether there is nothing but H: no constraint, no applied force, no friction.
    pub fn is_free(&self) -> bool {
        !self.is_constrained() && self.applied.is_empty() && self.friction.is_none()
    }

    /// Whether there are constraints, holonomic or not.
    pub fn is_constrained(&self) -> bool {
        !(self.constraints.is_empty() && self.nonholonomic.is_empty())
    }

    /// Adds the applied forces to the parts of `−∂H/∂q`: in one term where the same loops go to the same coordinate.
    pub fn add_applied(&mut self, force: &mut Vec<Scatter>) {
        for applied in &self.applied {
            let same =
                |part: &&mut Scatter| part.loops == applied.loops && part.target == applied.target;
            match force.iter_mut().find(same) {
                Some(part) => {
                    let terms = [part.value, applied.value].map(|value| (integer(1), value));
                    part.value = self.graph.sum(terms);
                }
                None => force.push(applied.clone()),
            }
        }
    }

    /// An applied force that depends on momenta, if there is one.
    pub fn force_of_momenta(&self) -> Option<Id> {
        let mut values = self.applied.iter().map(|part| part.value);
        values.find(|&value| self.graph.depends(value).p)
    }

    /// The sum of the squares of all constraints, which changes wherever one of them does; none where there is no constraint.
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

    /// Where a node, or the node that it is a multiple of, was read first.
    pub fn place_of(&self, id: Id) -> Option<&Span> {
        let inner = self.graph.scaled(id).1;
        self.places.get(&inner).or_else(|| self.places.get(&id))
    }

    /// What a coordinate with a number is called.
    pub fn name_of(&self, coordinate: &Coordinate) -> String {
        let index = usize::try_from(coordinate.index.offset).unwrap_or(0);
        match (self.velocities.get(index), &self.layout, coordinate.half) {
            (Some(velocity), Layout::Named(_), Half::V) => velocity.clone(),
            _ => self.layout.name(coordinate.half, index),
        }
    }
}

/// Functions of the positions, or forms of the velocities, that are zero.
#[derive(Debug, Clone)]
pub struct Constraint {
    /// The name.
    pub name: String,
    /// The loop for each index of which there is one.
    pub over: Option<LoopId>,
    /// What is zero: one function, or the components of a vector.
    pub parts: Vec<Id>,
}

/// A function of the state that is said to be conserved.
#[derive(Debug, Clone)]
pub struct Invariant {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub span: Span,
    /// Its components.
    pub parts: Vec<Id>,
    /// Whether it is a number, and no vector.
    pub scalar: bool,
    /// Whether it is proved that it is conserved, by a symmetry that shows in the formula.
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
