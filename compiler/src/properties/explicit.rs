//! Explicitness for separable Hamiltonians.

use super::{Evidence, Examined, Property};
use crate::algebra::Number;
use crate::arithmetic::roots::compare;
use crate::schedule::{Class, StepGraph};

/// Decides from the zeros of both matrices whether the stages can be computed one after another, for
/// `H = T(p) + U(q)`, where `Q_i` needs the velocities at the `P_j` with `a_ij ≠ 0` and `P_i` needs the
/// forces at the `Q_j` with `ã_ij ≠ 0`. Stages that coincide are one.
///
/// Coincidences at irrational nodes are not looked for. Stages can coincide only where their `c` or `c̃`
/// do, so that without such a pair the property is refuted for certain.
pub(super) fn decide(examined: &Examined<'_>) -> Property {
    let graph = StepGraph::new(Class::Separable, examined.tableau, examined.numbers);
    let mut cycle = match graph.order() {
        Ok(order) => return Property::proved(Some(order.join(", "))),
        Err(cycle) => cycle,
    };
    cycle.extend(cycle.first().cloned());
    let cycle = format!("these stages need one another: {}", cycle.join(" → "));
    let roots = examined.tableau.algebra().roots();
    let coincide = |times: &[Number<'_>]| {
        let enclosures: Vec<_> = times.iter().map(|time| time.enclose(0)).collect();
        (0..times.len())
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .any(|(i, j)| {
                let irrational = roots[i].rational().is_none() || roots[j].rational().is_none();
                irrational && compare(&enclosures[i], &enclosures[j]).is_none()
            })
    };
    if coincide(&examined.numbers.c) || coincide(&examined.numbers.c_tilde) {
        let bits = examined.numbers.c[0].enclose(0).bits();
        let witness = format!("{cycle}, unless stages at irrational nodes coincide");
        return Property {
            holds: false,
            evidence: Evidence::Verified { bits },
            witness: Some(witness),
        };
    }
    Property::refuted(cycle)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refutation_is_one_only_where_no_stages_can_coincide() {
        let gauss = crate::derive("polynomial(2)", "gauss(2)")
            .expect("derived")
            .properties()
            .explicit;
        assert_eq!((gauss.holds, gauss.evidence), (false, Evidence::Refuted));
        // The first function is 1 at both nodes and has no integral between them: c_1 = c_2.
        let odd = crate::derive("18*t^2 - 18*t + 4, 2*t - 1", "gauss(2)")
            .expect("derived")
            .properties()
            .explicit;
        assert!(
            !odd.holds && matches!(odd.evidence, Evidence::Verified { .. }),
            "{odd}"
        );
    }
}
