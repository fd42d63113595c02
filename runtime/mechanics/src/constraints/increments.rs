//! Positions and momenta as sums of increments.

use symplectic_core::inside::{ConstrainedTableau, add, copy};
use symplectic_core::solver::Coefficient;
use symplectic_core::system::Class;
use symplectic_core::{Scalar, Summation, System, Vector};

/// Whether momentum and velocity of a stage are those of the previous stage: for a separable system with equal rows.
#[inline]
pub(super) fn same_momentum<V: Vector, S: System<V>>(
    tableau: &ConstrainedTableau,
    i: usize,
) -> bool {
    i > 0
        && S::Class::SEPARABLE
        && tableau.momentum_nodes[i] == tableau.momentum_nodes[i - 1]
        && tableau.momenta[i] == tableau.momenta[i - 1]
}

/// Position or momentum after a step, `base + low + Σ_j increment_j`, with its compensation.
pub(super) fn result<R: Summation, V: Vector>(
    (out, out_low): (&mut V, &mut V),
    (base, low): (&V, &V),
    increments: &[V],
) {
    let (base, low) = (base.as_slice(), low.as_slice());
    let places = out.as_mut_slice().iter_mut();
    for (k, (out, out_low)) in places.zip(out_low.as_mut_slice()).enumerate() {
        let increment = |j: usize| increments[j].as_slice()[k];
        let (sum, rest) = add::<R, _>(base[k], low[k], increments.len(), increment);
        *out = sum;
        if R::COMPENSATED {
            *out_low = rest;
        }
    }
}

/// `out = base + (low + Σ_j factor_j increment_j)`
#[inline]
pub(super) fn stage<V: Vector>(
    out: &mut V,
    (base, low): (&V, &V),
    factors: &[Coefficient],
    increments: &[V],
) {
    copy(out, low);
    for (&factor, increment) in factors.iter().zip(increments) {
        if factor.double() == 0.0 {
            continue;
        }
        let factor = V::Scalar::from_coefficient(factor);
        let pairs = out.as_mut_slice().iter_mut().zip(increment.as_slice());
        for (out, &increment) in pairs {
            *out = increment.fused(factor, *out);
        }
    }
    for (out, &base) in out.as_mut_slice().iter_mut().zip(base.as_slice()) {
        *out = base + *out;
    }
}
