//! From a Lagrangian to the Hamiltonian: `L = v·M v/2 + A·v − U` gives `H = (p − A)·M⁻¹(p − A)/2 + U`, all functions of positions and time.
//!
//! M and A are derivatives of the graph of L, and H is again a graph, as if it had been written. M falls into blocks: the bodies of a sum
//! over all bodies, and velocities that are not coupled. A block of up to three velocities is inverted by its adjugate, a larger block by
//! elimination. M must be regular; otherwise positions and momenta obey a primary constraint. If L is not quadratic in the velocities,
//! it is used directly ([`Legendre::None`]).

mod inverse;
mod masses;

use std::collections::{BTreeMap, HashMap};

use num_traits::One;

use self::inverse::Block;
use self::masses::Masses;
use super::check::at;
use super::derivative::{Scatter, gradient};
use super::display::Notation;
use super::graph::{Coordinate, Graph, Half, Id, Index, Node, Number, integer};
use super::modular::Points;
use super::rewrite::{Copier, at_rest, flat};
use super::structure::terms;
use super::syntax::{CoordinatesKind, Definition, Span};
use super::system::{Lagrangian, Layout, Legendre, System};
use symplectic_exact::error::Error;
use symplectic_exact::error::FormulaError;
use symplectic_exact::input::Input;

/// The Hamiltonian system of a Lagrangian. On input, `energy` holds L.
///
/// # Errors
/// If L is not quadratic in the velocities, or has a singular mass matrix.
pub(super) fn transform(
    mut system: System,
    definition: &Definition,
    input: Input<'_>,
) -> Result<System, Error> {
    let formula = system.energy;
    let whole = definition
        .function
        .as_ref()
        .map_or(0..0, |written| written.span.clone());
    if let Some(part) = not_quadratic(&mut system.graph, formula) {
        return match needs_hamiltonian(&system) {
            None => every_velocity(system, definition, input),
            Some(what) => {
                let place = system.place_of(part).unwrap_or(&whole);
                Err(input.error(place, FormulaError::NotQuadratic { what }.into()))
            }
        };
    }
    let Some(masses) = Masses::of(&mut system, formula) else {
        let kind = FormulaError::Unsupported {
            what: "a kinetic energy with this coupling of velocities".to_owned(),
            instead: "couple at most 16 of them, with a number as the length of the positions, at most 64, and with sums over ranges",
        };
        return Err(input.error(&whole, kind.into()));
    };
    let rest = at_rest(&mut system.graph, formula);
    let points = Points::of(&system);
    let new = Graph::with_loops_of(&system.graph);
    let mut copier = Copier::new(std::mem::replace(&mut system.graph, new));
    let graph = &mut system.graph;
    copier.copy_names(graph);
    let kinetic = match masses.kinetic(&mut copier, graph, &points) {
        Ok(kinetic) => kinetic,
        Err(constraint) => {
            let span = velocity_span(definition, constraint.velocity).unwrap_or(whole);
            return Err(input.error(&span, constraint.error(&system).into()));
        }
    };
    let rest = copier.copy(rest, graph);
    let mut bonds = Vec::new();
    for known in &mut system.bonds {
        known.whole = copier.copy(known.whole, graph);
        known.potential = copier.copy(known.potential, graph);
        bonds.push(graph.scaled(known.whole).1);
    }
    let mut terms = Vec::new();
    for (sign, part) in kinetic
        .into_iter()
        .map(|part| (1, part))
        .chain([(-1, rest)])
    {
        terms.extend(flat(graph, sign, part, &bonds));
    }
    let energy = graph.sum(terms);
    let formula = copier.copy(formula, graph);
    for part in system
        .invariants
        .iter_mut()
        .flat_map(|known| &mut known.parts)
    {
        *part = copier.copy(*part, graph);
    }
    let constraints = system
        .constraints
        .iter_mut()
        .chain(&mut system.nonholonomic);
    for part in constraints.flat_map(|known| &mut known.parts) {
        *part = copier.copy(*part, graph);
    }
    for rate in &mut system.friction {
        *rate = copier.copy(*rate, graph);
    }
    for part in &mut system.applied {
        part.value = copier.copy(part.value, graph);
    }
    system.energy = energy;
    system.lagrangian = Some(Lagrangian {
        formula,
        applied: system.applied.clone(),
        legendre: match masses.are_numbers {
            true => Legendre::Regular,
            false => Legendre::RegularAtRandomPoints,
        },
    });
    // If several nodes have become one, keep the place of the first.
    let old = std::mem::take(&mut system.places);
    let ordered: BTreeMap<Id, Span> = old.into_iter().collect();
    for (id, span) in ordered {
        if let Some(copy) = copier.known.get(&id) {
            system.places.entry(*copy).or_insert(span);
        }
    }
    forces_of_momenta(&mut system, definition, input)?;
    Ok(system)
}

/// A part of the definition that needs H.
fn needs_hamiltonian(system: &System) -> Option<&'static str> {
    let parts = [
        ("constraints", !system.constraints.is_empty()),
        ("nonholonomic", !system.nonholonomic.is_empty()),
        ("friction", !system.friction.is_empty()),
        ("invariants", !system.invariants.is_empty()),
        ("require", !system.required.is_empty()),
    ];
    parts
        .into_iter()
        .find_map(|(what, there)| there.then_some(what))
}

/// The system with L itself, if L contains every named velocity.
fn every_velocity(
    mut system: System,
    definition: &Definition,
    input: Input<'_>,
) -> Result<System, Error> {
    let Layout::Named([names, _]) = &system.layout else {
        return Ok(system);
    };
    let velocities: Vec<Coordinate> = (0..names.len())
        .map(|k| Coordinate {
            half: Half::V,
            index: Index::number(k as i64),
            component: 0,
        })
        .collect();
    for velocity in 0..velocities.len() {
        let own = system.graph.coordinate(velocities[velocity].clone());
        if system.graph.below([system.energy]).contains(&own) {
            continue;
        }
        let residual = system.graph.coordinate(velocities[velocity].of(Half::P));
        let constraint = Constraint {
            velocity,
            block: vec![velocity],
            velocities,
            residual,
            appears: false,
        };
        let span = velocity_span(definition, velocity).unwrap_or(0..0);
        return Err(input.error(&span, constraint.error(&system).into()));
    }
    Ok(system)
}

/// Substitutes `∂H/∂p` for the velocities in applied forces.
fn forces_of_momenta(
    system: &mut System,
    definition: &Definition,
    input: Input<'_>,
) -> Result<(), Error> {
    let energy = system.energy;
    let velocity = gradient(&mut system.graph, energy, &[], Number::one(), Half::P);
    let mut applied = std::mem::take(&mut system.applied);
    for part in &mut applied {
        let found = with_velocities(system, &velocity, part);
        (system.graph, part.value) = found.ok_or_else(|| {
            let kind = FormulaError::Unsupported {
                what: "a velocity in this force".to_owned(),
                instead: "write the system with `hamiltonian!`, whose forces are functions of momenta",
            };
            let whole = definition.forces.first().map(|force| &force.value.span);
            let place = system.place_of(part.value).or(whole);
            input.error(place.unwrap_or(&(0..0)), kind.into())
        })?;
    }
    system.applied = applied;
    Ok(())
}

/// The value of a part with the given velocities (as parts of a derivative) substituted. `None` if these contain sums whose index is
/// in use already, or if the parts do not show a velocity.
fn with_velocities(system: &System, velocity: &[Scatter], part: &Scatter) -> Option<(Graph, Id)> {
    let mut graph = system.graph.clone();
    let mut around = part.loops.clone();
    around.extend(graph.totals(part.value));
    let mut known: HashMap<Id, Id> = HashMap::new();
    let mut seen = true;
    for id in graph.below([part.value]) {
        if !graph.depends(id).v {
            continue;
        }
        let with = match graph.node(id).clone() {
            Node::Coordinate(coordinate) => {
                let value = at(system, &mut graph, velocity, &coordinate);
                let apart = |value: &Id| {
                    let totals = graph.totals(*value);
                    totals.iter().all(|over| !around.contains(over))
                };
                let value = value.filter(apart);
                seen &= value.is_some();
                value.unwrap_or(id)
            }
            _ => graph.rebuild(id, |part| known.get(&part).copied().unwrap_or(part)),
        };
        known.insert(id, with);
    }
    let value = known.get(&part.value).copied().unwrap_or(part.value);
    seen.then_some((graph, value))
}

/// A part of L with a nonzero third derivative with respect to velocities, as far as the formula shows.
fn not_quadratic(graph: &mut Graph, formula: Id) -> Option<Id> {
    let fixed = |graph: &Graph, id: Id| !graph.depends(id).v;
    let Some(terms) = terms(graph, formula, fixed) else {
        return Some(formula);
    };
    for (term, part) in terms {
        for first in gradient(graph, term, &[], Number::one(), Half::V) {
            let second = gradient(graph, first.value, &first.loops, Number::one(), Half::V);
            if second.iter().any(|second| graph.depends(second.value).v) {
                return Some(part);
            }
        }
    }
    None
}

/// The place where a velocity is declared.
fn velocity_span(definition: &Definition, velocity: usize) -> Option<Span> {
    let velocities = definition.coordinates[1].as_ref()?;
    Some(match &velocities.kind {
        CoordinatesKind::Named(names) => names.get(velocity)?.span.clone(),
        CoordinatesKind::Numbered(..) => velocities.span.clone(),
    })
}

/// The primary constraint of a singular mass matrix.
struct Constraint {
    /// The index of a velocity that the momenta do not determine.
    velocity: usize,
    /// Its block, as indices of velocities.
    block: Vec<usize>,
    /// All velocities.
    velocities: Vec<Coordinate>,
    /// The expression that vanishes.
    residual: Id,
    /// Whether the velocity is in L.
    appears: bool,
}

impl Constraint {
    fn error(&self, system: &System) -> FormulaError {
        let name = |k: usize, half| {
            let coordinate = self.velocities[k].of(half);
            system.coordinate_name(&coordinate, Notation::Text)
        };
        let residual = system.formula(self.residual, Notation::Text);
        let own = name(self.velocity, Half::V);
        let reason = match (self.block.len(), self.appears) {
            (1, false) => format!("L does not contain `{own}`"),
            (1, true) => {
                format!("L has no square of `{own}`, and no product of it with another velocity")
            }
            _ => {
                let names: Vec<String> = self
                    .block
                    .iter()
                    .map(|&k| format!("`{}`", name(k, Half::V)))
                    .collect();
                format!("the mass matrix of {} is singular", names.join(", "))
            }
        };
        FormulaError::Singular {
            reason,
            constraint: format!("{residual} = 0"),
        }
    }
}

impl Masses {
    /// The terms of the kinetic energy in the momenta; momenta are copied before masses.
    fn kinetic(
        &self,
        copier: &mut Copier,
        graph: &mut Graph,
        points: &Points,
    ) -> Result<Vec<Id>, Constraint> {
        let mut residuals = Vec::new();
        for (velocity, shift) in self.velocities.iter().zip(&self.shift) {
            let momentum = graph.coordinate(velocity.of(Half::P));
            let shift = copier.copy(*shift, graph);
            residuals.push(graph.sum([(Number::one(), momentum), (-Number::one(), shift)]));
        }
        let zero = |graph: &Graph, id: Id, scale: Id| points.vanishes(graph, id, scale, self.over);
        let constraint = |block: &[usize], k: usize, residual: Id| Constraint {
            velocity: k,
            block: block.to_vec(),
            velocities: self.velocities.clone(),
            residual,
            appears: self.appears[k],
        };
        let mut terms = Vec::new();
        for block in self.blocks() {
            let own: Vec<Id> = block.iter().map(|&k| residuals[k]).collect();
            // Velocities of the same mass together.
            if self.is_diagonal(&block) {
                let squares: Vec<_> = own
                    .iter()
                    .map(|&residual| (Number::one(), graph.power(residual, integer(2))))
                    .collect();
                let squares = graph.sum(squares);
                let mass = copier.copy(self.matrix[block[0]][block[0]], graph);
                if zero(graph, mass, mass) {
                    return Err(constraint(&block[..1], block[0], own[0]));
                }
                terms.push(
                    graph.product(half(), [(squares, Number::one()), (mass, -Number::one())]),
                );
                continue;
            }
            let row = |k: &usize, copier: &mut Copier, graph: &mut Graph| -> Vec<Id> {
                let entries = block.iter().map(|&l| self.matrix[*k][l]);
                entries.map(|entry| copier.copy(entry, graph)).collect()
            };
            let matrix = block.iter().map(|k| row(k, copier, graph)).collect();
            let solved = Block::new(matrix, own).energy(graph, &zero);
            terms.push(solved.map_err(|(k, residual)| constraint(&block, block[k], residual))?);
        }
        Ok(match self.over {
            None => terms,
            Some(over) => {
                let terms: Vec<_> = terms
                    .into_iter()
                    .map(|term| (Number::one(), term))
                    .collect();
                let body = graph.sum(terms);
                vec![graph.total(over, body)]
            }
        })
    }
}

fn half() -> Number {
    Number::new(1.into(), 2.into())
}
