//! Systems without a formula of H: L itself.

use super::derivative::{Scatter, gradient};
use super::description::displays;
use super::display::Notation;
use super::graph::{Half, integer};
use super::system::System;

/// The note for such a system.
pub const FACT: &str = "not quadratic in the velocities, so there is no formula of H: steps are those of \
                        `symplectic::variational::LagrangianIntegrator`, by L and its derivatives";

/// `q' = v` and `p' = ∂L/∂q + f`, a line for each part; `None` if there is H.
pub fn equations(system: &System, notation: Notation) -> Option<Vec<String>> {
    let lagrangian = system.without_hamiltonian()?;
    let mut copy = system.clone();
    let of = lagrangian.formula;
    let mut parts: Vec<Scatter> = gradient(&mut copy.graph, of, &[], integer(1), Half::Q);
    copy.add_applied(&mut parts);
    let force = copy.completed(parts);
    let mut velocity = copy.completed(Vec::new());
    for part in &mut velocity {
        part.value = copy.graph.coordinate(part.target.of(Half::V));
    }
    Some(copy.equations(&[(Half::Q, velocity), (Half::P, force)], notation))
}

/// The documentation of the type of such a system; `None` if there is H.
pub fn page(system: &System) -> Option<String> {
    let lines = |notation| {
        let mut lines = vec![format!("L = {}", system.lagrangian_formula(notation)?)];
        lines.extend(system.momentum_equations(notation));
        lines.extend(equations(system, notation)?);
        Some(lines)
    };
    let (text, display) = (lines(Notation::Text)?, displays(&lines(Notation::Latex)?));
    let text = text.join("\n");
    Some(format!(
        "\n\n```text\n{text}\n```\n\n{display}Found in the formula: {FACT}.\n"
    ))
}
