//! The force gradient `f′ M⁻¹ f`, which gradient kicks need.
//!
//! Let `f = −∇U` and `w` a vector that does not depend on the positions. Then `f′ w = −∇(w·∇U)`: the gradient of a derivative in a
//! direction. So with `w = M⁻¹ f` in the place of the velocities one pass over the formula gives it, exactly, for the price of a force.

use super::Structure;
use super::check::at;
use super::derivative::{Scatter, directional, gradient};
use super::graph::{Half, Id, integer};
use super::structure::{Kinetic, each_once};
use super::system::System;

impl System {
    /// The parts of `f′ M⁻¹ f`, in which the momenta are the components of the force `f`. `None` if H is not
    /// `pᵀM⁻¹p/2 + a·p + U(t, q)` with constant `M` and `a`, if it is not all of the system, or if the formula does not show a component of
    /// `M⁻¹f`.
    pub fn force_gradient(&mut self, structure: &Structure) -> Option<Vec<Scatter>> {
        let split = structure.split.ok()?;
        let is_quadratic = structure.kinetic != Kinetic::General
            && !self.graph.depends(split.kinetic).time
            && self.is_free();
        if !is_quadratic {
            return None;
        }
        // A loop too many would make other derivatives wrong.
        let graph = self.graph.clone();
        let found = self.along_the_force(split.kinetic, split.potential);
        if self.graph.overflowed() && !graph.overflowed() {
            self.graph = graph;
            return None;
        }
        found
    }

    fn along_the_force(&mut self, kinetic: Id, potential: Id) -> Option<Vec<Scatter>> {
        let mut velocities = gradient(&mut self.graph, kinetic, &[], integer(1), Half::P);
        for part in &mut velocities {
            // Without the terms that do not depend on the momenta: those of a·p.
            part.value =
                directional(
                    &mut self.graph,
                    part.value,
                    None,
                    |graph, coordinate| match coordinate.half {
                        Half::P => graph.coordinate(coordinate.clone()),
                        _ => graph.integer(0),
                    },
                );
        }
        let common = self.common_mass(&velocities);
        let system = self.clone();
        let mut shown = true;
        let speed = directional(&mut self.graph, potential, None, |graph, coordinate| {
            let found = match (coordinate.half, common) {
                (Half::Q, Some(inverse)) => {
                    let momentum = graph.coordinate(coordinate.of(Half::P));
                    Some(graph.multiply(inverse, momentum))
                }
                (Half::Q, None) => at(&system, graph, &velocities, coordinate),
                _ => None,
            };
            shown &= found.is_some();
            found.unwrap_or_else(|| graph.integer(0))
        });
        shown.then(|| gradient(&mut self.graph, speed, &[], integer(-1), Half::Q))
    }

    /// `1/m`, if the velocities are `p/m` with one `m` for all coordinates, however they are written.
    fn common_mass(&mut self, velocities: &[Scatter]) -> Option<Id> {
        if !each_once(self, velocities) {
            return None;
        }
        let mut inverse = None;
        for Scatter { target, value, .. } in velocities {
            let graph = &mut self.graph;
            let own = directional(graph, *value, None, |graph, coordinate| {
                graph.integer((coordinate == target).into())
            });
            let momentum = graph.coordinate(target.clone());
            let is_all = graph.multiply(own, momentum) == *value;
            let is_same = inverse.is_none_or(|known| known == own);
            if !is_all || !is_same || graph.depends(own).loops != 0 {
                return None;
            }
            inverse = Some(own);
        }
        inverse
    }
}
