//! Explicitness for separable Hamiltonians.

use super::{Examined, Property};
use crate::schedule::{Class, StepGraph};

/// Decides from the zeros of both matrices whether the stages can be computed one after another, for
/// `H = T(p) + U(q)`, where `Q_i` needs the velocities at the `P_j` with `a_ij ≠ 0` and `P_i` needs the
/// forces at the `Q_j` with `ã_ij ≠ 0`.
pub(super) fn decide(examined: &Examined<'_>) -> Property {
    match StepGraph::new(Class::Separable, examined.tableau, examined.numbers).order() {
        Ok(order) => Property::proved(Some(order.join(", "))),
        Err(mut cycle) => {
            cycle.extend(cycle.first().cloned());
            Property::refuted(format!(
                "these stages need one another: {}",
                cycle.join(" → ")
            ))
        }
    }
}
