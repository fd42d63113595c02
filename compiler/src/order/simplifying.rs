//! Order without enumerating trees: the simplifying assumptions.
//!
//! The statement is at [`SimplifyingAssumptions`]. For `ã = a` it is Butcher's theorem (Butcher 1964; Hairer,
//! Nørsett & Wanner, *Solving ODEs I*, Theorem II.7.4: `p ≤ η + ζ + 1` and `p ≤ 2η + 2`). It does not require
//! symplecticity.
//!
//! **Proof**, along the lines of Butcher's. Write `η_x`, `ζ_x` for the numbers of the matrix that belongs to children
//! of colour `x`. Let a *generalised tree* have, besides vertices, factors `c` at vertices, each counted as one vertex
//! of the order. Its weight has `c_i` there. Its required value is the weight under the exact flow. This is the method
//! with the stages `0 ≤ t ≤ 1`, `Σ_j a_ij f_j = ∫_0^t f` and `c = t`. The exact flow satisfies all assumptions for all
//! `k`, so each replacement below changes weight and required value in the same way. So it is enough to show that
//! replacements lead every generalised tree of order `n ≤ p` to trees of lower order and to `Σ_i b_i c_i^(n−1)`, where
//! `B` holds. The colour of the root does not matter, because `b = b̃`. The proof is by induction over the order and
//! then over the number of vertices.
//!
//! 1. A vertex of colour `x` other than the root that carries `k − 1` factors `c` and nothing else, with
//!    `k ≤ η_x`, is replaced by `c^k/k` at its parent, by `C`. That leaves fewer vertices.
//! 2. Where no such vertex is left, each branch at the root has a lowest vertex, of some colour `y`, with
//! 2. If no such vertex is left, each branch at the root has a lowest vertex, of some colour `y`, with
//!    at least `η_y` factors `c`: the branch has order at least `η_y + 1`. Two branches would give
//!    `n ≥ 2 min(η, η̂) + 3 > p`. So there is one branch, or none, which is `B`.
//! 3. The root has `k − 1` factors `c` and one branch, whose own root has colour `x`. If that root is the lowest
//!    vertex, the branch has order at least `η_x + 1` and `k ≤ n − η_x − 1 ≤ ζ_x`. If the lowest vertex is a different
//!    one, of colour `y`, the order is at least `η_y + 2` and
//!    `k ≤ n − η_y − 2 ≤ p − min(η, η̂) − 2 ≤ min(ζ, ζ̂) ≤ ζ_x`. In both cases `D` replaces `Σ_i b_i c_i^(k−1) a_ij` by
//!    `b_j (1 − c_j^k)/k`. The root of the branch becomes the root, once with order `n − k`, and once with `k`
//!    additional factors `c`, order `n` and one vertex less.
//!
//! The second case of step 3, for `y ≠ x`, is the difference from using Butcher's theorem with the smaller numbers of
//! both matrices. Lobatto IIIA has `C(s)`, `D(s−2)`, IIIB `Ĉ(s−2)`, `D̂(s)`; the theorem gives `2s − 2`, the order of
//! the quadrature (Jay 1996), whereas the smaller numbers give `2s − 3`. Let `a` be a collocation method at `s` nodes
//! with a quadrature of order `s + m`, and `ã` its symplectic partner. Then `C(s)` and `D(m)` hold, hence `D̂(s)` and
//! `Ĉ(m)`, and the theorem gives `min(s + m, 2m + 2)`: Gauss `2s`, Radau `2s − 1`, Lobatto `2s − 2`.

use num_rational::BigRational;
use num_traits::One;

use crate::algebra::{StageAlgebra, Zero};
use crate::evidence::Evidence;
use crate::partitioned::Partitioned;
use crate::properties::vanishing_vector;

/// The largest numbers for which the simplifying assumptions hold, each at most that of `B`.
///
/// For weights `b = b̃` and one vector `c`, the row sums of `a` or of `ã`,
///
/// ```text
/// B(p):  Σ_i b_i c_i^(k−1) = 1/k                       k ≤ p
/// C(η):  Σ_j a_ij c_j^(k−1) = c_i^k / k                k ≤ η     Ĉ(η̂) the same for ã
/// D(ζ):  Σ_i b_i c_i^(k−1) a_ij = b_j (1 − c_j^k)/k    k ≤ ζ     D̂(ζ̂) the same for ã
/// ```
///
/// **Theorem.** If these hold, the method has, for every Hamiltonian, every order
///
/// ```text
/// p ≤ 2 min(η, η̂) + 2,    p ≤ η + ζ + 1,    p ≤ η̂ + ζ̂ + 1,    p ≤ min(η, η̂) + min(ζ, ζ̂) + 2
/// ```
///
/// up to the order of `B` (Butcher 1964 for `ã = a`; the source of this file has the proof for pairs).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SimplifyingAssumptions {
    /// `p` of `B(p)`: the order of the quadrature.
    pub b: usize,
    /// `η` of `C(η)`, for `a`.
    pub c: usize,
    /// `η̂` of `Ĉ(η̂)`, for `ã`.
    pub c_tilde: usize,
    /// `ζ` of `D(ζ)`, for `a`.
    pub d: usize,
    /// `ζ̂` of `D̂(ζ̂)`, for `ã`.
    pub d_tilde: usize,
    /// The evidence that all of these hold.
    pub evidence: Evidence,
}

impl SimplifyingAssumptions {
    /// The largest `p` for which the theorem proves order `p` for every Hamiltonian.
    pub fn order(&self) -> usize {
        let (c, d) = (self.c.min(self.c_tilde), self.d.min(self.d_tilde));
        let bounds = [
            2 * c + 2,
            self.c + self.d + 1,
            self.c_tilde + self.d_tilde + 1,
            c + d + 2,
        ];
        bounds.into_iter().fold(self.b, usize::min)
    }
}

/// The simplifying assumptions of a pair with `b = b̃` and without gradient kicks. `c` is the row sums of `a` or those of `ã`,
/// whichever prove the higher order. `None` if `b` differs from `b̃`.
///
/// Each equation is decided in the algebra; the work is a few products of a matrix and a vector for each
/// number up to `2s`.
pub(crate) fn simplifying_assumptions<A: StageAlgebra>(
    pair: &Partitioned<A>,
) -> Option<SimplifyingAssumptions> {
    if pair.gradient.is_some() {
        return None;
    }
    let algebra = &*pair.algebra;
    let weights = vanishing_vector(algebra, &algebra.subtract(&pair.b, &pair.b_tilde)).ok()?;
    let (c, c_tilde) = (pair.c(), pair.c_tilde());
    let found = assumptions(pair, &c, weights);
    if c == c_tilde {
        return Some(found);
    }
    let other = assumptions(pair, &c_tilde, weights);
    let better = other.order() > found.order();
    Some(if better { other } else { found })
}

fn assumptions<A: StageAlgebra>(
    pair: &Partitioned<A>,
    c: &A::Vector,
    mut evidence: Evidence,
) -> SimplifyingAssumptions {
    let algebra = &*pair.algebra;
    // c^k, starting with k = 0, computed as needed, because powers of long numbers are long.
    let mut powers = vec![algebra.constant(&BigRational::one())];
    let mut b = 0;
    // A quadrature with s weights has order at most 2s.
    while b < 2 * algebra.stages() {
        let wanted = BigRational::new(One::one(), (b + 1).into());
        match algebra.inner(&pair.b, &powers[b]).difference(&wanted) {
            Zero::Yes => {}
            Zero::Within(bits) => evidence = evidence.and(Evidence::Verified { bits }),
            Zero::No => break,
        }
        powers.push(algebra.multiply(&powers[b], c));
        b += 1;
    }
    let mut largest = |bound: usize, holds: &dyn Fn(usize) -> Option<Evidence>| {
        let mut found = 0;
        while found < bound {
            match holds(found + 1) {
                Some(one) => evidence = evidence.and(one),
                None => break,
            }
            found += 1;
        }
        found
    };
    let fraction = |k: usize| algebra.constant(&BigRational::new(One::one(), k.into()));
    let vanishes =
        |f: &A::Vector, g: &A::Vector| vanishing_vector(algebra, &algebra.subtract(f, g)).ok();
    // Orders higher than that of B are useless.
    let mut rows = |matrix: &A::Matrix| {
        largest(b, &|k| {
            let integral = algebra.multiply(&powers[k], &fraction(k));
            vanishes(&algebra.apply(matrix, &powers[k - 1]), &integral)
        })
    };
    let equal = pair.a == pair.a_tilde;
    let eta = rows(&pair.a);
    let eta_tilde = if equal { eta } else { rows(&pair.a_tilde) };
    let mut columns = |matrix: &A::Matrix| {
        let transposed = algebra.transpose(matrix);
        largest(b, &|k| {
            let sums = algebra.apply(&transposed, &algebra.multiply(&pair.b, &powers[k - 1]));
            let rest = algebra.subtract(&powers[0], &powers[k]);
            let wanted = algebra.multiply(&algebra.multiply(&pair.b, &rest), &fraction(k));
            vanishes(&sums, &wanted)
        })
    };
    let zeta = columns(&pair.a);
    let zeta_tilde = if equal { zeta } else { columns(&pair.a_tilde) };
    SimplifyingAssumptions {
        b,
        c: eta,
        c_tilde: eta_tilde,
        d: zeta,
        d_tilde: zeta_tilde,
        evidence,
    }
}
