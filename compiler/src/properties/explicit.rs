//! Explicitness for separable Hamiltonians.

use super::{Evidence, Examined, Property, Zero};
use crate::algebra::{Number, StageAlgebra};
use crate::arithmetic::roots::compare;
use crate::schedule::{Class, StageValue, StepGraph};

/// Decides from the zeros of both matrices whether the stages can be computed in sequence for
/// `H = T(p) + U(q)`. There `Q_i` needs the velocities at the `P_j` with `a_ij ≠ 0`, and `P_i` needs the
/// forces at the `Q_j` with `ã_ij ≠ 0`. Stages that coincide count as one.
///
/// Where the algebra does not look for coincidences of some stages, the property is refuted for certain
/// only if they cannot coincide, because their `c` and `c̃` differ.
pub(super) fn decide<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    let (pair, numbers) = (examined.pair, examined.numbers);
    let algebra = &*pair.algebra;
    let graph = StepGraph::of_pair(Class::Separable, pair, numbers);
    let mut cycle = match graph.order() {
        // Numbers that are zero only as far as is known make it known only as far.
        Ok(order) => {
            let values: Vec<_> = graph.positions.iter().chain(&graph.momenta).collect();
            let joined = values.iter().any(|value| value.stages.len() > 1);
            let evidence = match algebra.verified_bits() {
                Some(bits) if joined => Evidence::Verified { bits },
                _ => Evidence::Proved,
            };
            let zeros = values.iter().flat_map(|value| &value.coefficients);
            let evidence = zeros.fold(evidence, |evidence, zero| match zero.zero() {
                Zero::Within(bits) => evidence.and(Evidence::Verified { bits }),
                Zero::Yes | Zero::No => evidence,
            });
            return Property::holding(evidence, Some(order.join(", ")));
        }
        Err(cycle) => cycle,
    };
    cycle.extend(cycle.first().cloned());
    let cycle = format!("these stages need one another: {}", cycle.join(" → "));
    let coincide = |times: &[Number<'_>], values: &[StageValue<'_>]| {
        let joined = |i, j| {
            let both =
                |value: &StageValue<'_>| value.stages.contains(&i) && value.stages.contains(&j);
            values.iter().any(both)
        };
        let enclosures: Vec<_> = times.iter().map(|time| time.enclose(0)).collect();
        (0..times.len())
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .any(|(i, j)| {
                let seen = algebra.sees_coincidences_of(i) && algebra.sees_coincidences_of(j);
                !seen && !joined(i, j) && compare(&enclosures[i], &enclosures[j]).is_none()
            })
    };
    if coincide(&numbers.c, &graph.positions) || coincide(&numbers.c_tilde, &graph.momenta) {
        let bits = numbers.c[0].enclose(0).bits();
        let witness = format!("{cycle}, unless stages at irrational nodes coincide");
        return Property::undecided(bits, witness);
    }
    Property::refuted(cycle)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn explicitness_is_refuted_only_if_no_stages_can_coincide() {
        let gauss = crate::derive("polynomial(2)", "gauss(2)")
            .expect("derived")
            .properties()
            .explicit;
        assert_eq!((gauss.holds, gauss.evidence), (false, Evidence::Refuted));
        // The first function is 1 at both nodes and has no integral between them: all rows are the same.
        let same = crate::derive("18*t^2 - 18*t + 4, 2*t - 1", "gauss(2)")
            .expect("derived")
            .properties()
            .explicit;
        assert_eq!((same.holds, same.evidence), (false, Evidence::Refuted));
        // No integral between the outer nodes, for any of the functions: c_1 = c_3.
        let even = "(20*(t - 1/2)^4 - 3*(t - 1/2)^2)";
        let basis = format!("1 + 50/3*{even}, t - 1/2, (t - 1/2)^2 + 5/6*{even}");
        let outer = crate::derive(&basis, "gauss(3)")
            .expect("derived")
            .properties()
            .explicit;
        assert!(
            !outer.holds && matches!(outer.evidence, Evidence::Undecided { .. }),
            "{outer}"
        );
    }
}
