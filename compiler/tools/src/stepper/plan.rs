//! The plan of a stepper, independent of the language.

use super::SteppedClass;
use crate::language::table::{Entry, Flow, Table, weight};
use symplectic_compiler::emit::Rounded;
use symplectic_compiler::inside::left_out;
use symplectic_compiler::inside::{Known, Relative};
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::schedule::{Class, Node, StepGraph};
use symplectic_compiler::{Error, ErrorKind};
use symplectic_formula::{Kinetic, Structure, System};

/// A step.
pub(super) enum Plan<'t> {
    /// A sequence of drifts and kicks.
    Splitting(&'t [Flow]),
    /// Coupled stages.
    Coupled(Box<Coupled>),
}

/// The coefficients of coupled stages: `Q_i = q + Σ_j μ_ij (h b_j velocity_j)`, `P_i = p + Σ_j μ̃_ij (h b̃_j force_j)`.
pub(super) struct Coupled {
    /// Nodes and weights by name.
    pub vectors: [(&'static str, Vec<Entry>); 3],
    /// μ and μ̃ by name.
    pub matrices: [(&'static str, Vec<Vec<f64>>); 2],
}

impl<'t> Plan<'t> {
    /// The plan for a class of Hamiltonians. Without a class: drifts and kicks if possible.
    pub fn new(
        table: &'t Table<'_>,
        class: Option<SteppedClass>,
        digits: usize,
    ) -> Result<Self, Error> {
        match (class, &table.flows) {
            (None | Some(SteppedClass::Separable), Some(flows)) => Ok(Plan::Splitting(flows)),
            (Some(SteppedClass::Separable), None) => Err(refused(
                "it does not consist of drifts and kicks: leave the class out, which gives a stepper for every H",
            )),
            _ => Coupled::new(table, digits).map(|coupled| Plan::Coupled(Box::new(coupled))),
        }
    }
}

/// The class of a stepper for a system, for which the method has to have its order.
pub(super) fn class_of(
    table: &Table<'_>,
    class: Option<SteppedClass>,
    system: &System,
    structure: &Structure,
) -> Result<Option<SteppedClass>, Error> {
    let [general, separable, nystrom] = [
        HamiltonianClass::General,
        HamiltonianClass::Separable,
        HamiltonianClass::Nystrom,
    ]
    .map(|class| table.order(class));
    let Ok(split) = structure.split else {
        if class == Some(SteppedClass::Separable) {
            return Err(refused(
                "H is not separable: leave the class out, which gives a stepper for every H",
            ));
        }
        if general < separable {
            return Err(refused(
                "H is not separable, where it has a lower order: take a method with its order for every H (`symplectic list --class general`)",
            ));
        }
        return Ok(Some(SteppedClass::General));
    };
    // A time in the kinetic energy lowers the order also where it is in a term that is linear in the momenta.
    let is_quadratic =
        structure.kinetic != Kinetic::General && !system.graph.depends(split.kinetic).time;
    if separable < nystrom && !is_quadratic {
        return Err(refused(
            "the kinetic energy is not quadratic in the momenta or depends on the time, where it has a lower order: take another method (`symplectic list --class separable`)",
        ));
    }
    Ok(class)
}

impl Coupled {
    fn new(table: &Table<'_>, digits: usize) -> Result<Self, Error> {
        let tableau = table.tableau;
        if left_out(tableau).is_some() {
            return Err(refused(
                "it is too long for a Hamiltonian that is not separable: take one with at most 36 stages",
            ));
        }
        if !tableau.properties().symplectic.holds {
            return Err(refused(
                "its stages are solved for, and it is not symplectic: coefficients that are symplectic as rounded do not exist",
            ));
        }
        let (numbers, forms) = (tableau.numbers(), tableau.exact_forms());
        let graph = StepGraph::new(Class::General, tableau.exact(), &numbers);
        let relative = Relative::new(&graph, &Known::new(tableau)).ok_or_else(|| {
            refused(
                "its stages are solved for, and one has the weight zero: a_ij / b_j does not exist",
            )
        })?;
        // Both evaluations use the same stages and the same time, as if time were a position. So a step is symplectic also if H depends
        // on time.
        let nodes = |kind: fn(usize) -> Node| (0..graph.forces.len()).map(kind);
        let weights = |kind| -> Vec<Entry> {
            nodes(kind)
                .map(|n| weight(&graph, n, &forms, digits))
                .collect()
        };
        let stage = |node| graph.stages_of(graph.evaluation(node))[0];
        let times = nodes(Node::Force).map(|node| table.entries.c[stage(node)].clone());
        let doubles =
            |row: &[Rounded]| -> Vec<f64> { row.iter().map(|entry| entry.double).collect() };
        let positions = graph.forces.iter().filter_map(|force| force.position);
        let momenta = graph
            .velocities
            .iter()
            .filter_map(|velocity| velocity.momentum);
        Ok(Coupled {
            vectors: [
                ("c", times.collect()),
                ("b", weights(Node::Velocity)),
                ("b_tilde", weights(Node::Force)),
            ],
            matrices: [
                (
                    "mu",
                    positions
                        .map(|row| doubles(&relative.positions[row]))
                        .collect(),
                ),
                (
                    "mu_tilde",
                    momenta.map(|row| doubles(&relative.momenta[row])).collect(),
                ),
            ],
        })
    }
}

pub(super) fn refused(reason: &'static str) -> Error {
    ErrorKind::NoStepper { reason }.into()
}
