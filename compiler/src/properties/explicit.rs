//! Explicitness for separable Hamiltonians.

use super::{Examined, Property};
use crate::schedule::{ReducedTableau, StageGraph};

/// Decides from the zeros of both matrices whether the stages can be computed one after another, for
/// `H = T(p) + U(q)`, where `Q_i` needs the velocities at the `P_j` with `a_ij ≠ 0` and `P_i` needs the
/// forces at the `Q_j` with `ã_ij ≠ 0`.
pub(super) fn decide(examined: &Examined<'_>) -> Property {
    let reduced = ReducedTableau::separable(examined.tableau, examined.numbers);
    let graph = StageGraph::new(&reduced);
    match graph.order() {
        Ok(order) => {
            let names: Vec<String> = order
                .iter()
                .map(|stage| reduced.all_names(*stage))
                .collect();
            Property::proved(Some(names.join(", ")))
        }
        Err(cycle) => {
            let mut names: Vec<String> = cycle.iter().map(|stage| reduced.name(*stage)).collect();
            names.extend(names.first().cloned());
            Property::refuted(format!(
                "these stages need one another: {}",
                names.join(" → ")
            ))
        }
    }
}
