//! The two matrices and the weights of a partitioned Runge–Kutta method over an algebra.

use std::borrow::Cow;
use std::sync::Arc;

use num_rational::BigRational;
use num_traits::One;

use crate::algebra::{Number, StageAlgebra, Zero};
use crate::coefficients::Coefficients;

/// The exact coefficients `a, b` for positions and `ã, b̃` for momenta of
///
/// ```text
/// Q_i = q0 + h Σ_j a_ij ∂H/∂p(Q_j, P_j)      q1 = q0 + h Σ_i b_i ∂H/∂p(Q_i, P_i)
/// P_i = p0 − h Σ_j ã_ij ∂H/∂q(Q_j, P_j)      p1 = p0 − h Σ_i b̃_i ∂H/∂q(Q_i, P_i)
/// ```
#[derive(Debug, PartialEq)]
pub struct Pair<A: StageAlgebra> {
    /// The algebra that the coefficients are elements of.
    pub algebra: Arc<A>,
    /// `a_ij`
    pub a: A::Matrix,
    /// `ã_ij`
    pub a_tilde: A::Matrix,
    /// `b_i`
    pub b: A::Vector,
    /// `b̃_i`
    pub b_tilde: A::Vector,
}

/// What the matrices of a splitting look like, each stage of which makes one drift and one kick.
///
/// ```text
/// kicks first    a_ij = b_j for j < i    ã_ij = b̃_j for j ≤ i
/// drifts first   a_ij = b_j for j ≤ i    ã_ij = b̃_j for j < i
/// ```
///
/// and zero elsewhere, so that the weights say all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Staircase {
    /// `P_i` has the kick that is made at `Q_i`.
    KicksFirst,
    /// `Q_i` has the drift that is made at `P_i`.
    DriftsFirst,
}

impl<A: StageAlgebra> Clone for Pair<A> {
    fn clone(&self) -> Self {
        Pair {
            algebra: Arc::clone(&self.algebra),
            a: self.a.clone(),
            a_tilde: self.a_tilde.clone(),
            b: self.b.clone(),
            b_tilde: self.b_tilde.clone(),
        }
    }
}

impl<A: StageAlgebra> Pair<A> {
    /// The pair with `b̃ = b` and the `ã` that makes it symplectic (MW 2.6.7),
    /// `ã_ij = (b_i b_j − b_j a_ji)/b_i`.
    ///
    /// # Errors
    /// The first stage whose weight vanishes, or cannot be told from zero, and which of the two.
    pub fn symplectic(algebra: Arc<A>, a: A::Matrix, b: A::Vector) -> Result<Self, (usize, Zero)> {
        let inverse = algebra.reciprocal(&b)?;
        let one = algebra.constant(&BigRational::one());
        // b_i − a_ji at (j, i), so that ã_ij = b_j (b_i − a_ji)/b_i is exactly zero where a_ji is b_i.
        let complement = algebra.subtract_matrices(&algebra.outer(&one, &b), &a);
        let scaled = algebra.transpose(&algebra.scale_rows(&complement, &b));
        Ok(Pair {
            a_tilde: algebra.scale_rows(&scaled, &inverse),
            b_tilde: b.clone(),
            algebra,
            a,
            b,
        })
    }

    /// A Runge–Kutta method: the same coefficients for positions and momenta.
    pub fn equal(algebra: Arc<A>, a: A::Matrix, b: A::Vector) -> Self {
        Pair {
            algebra,
            a_tilde: a.clone(),
            b_tilde: b.clone(),
            a,
            b,
        }
    }

    /// The pair with positions and momenta exchanged: `a ↔ ã`, `b ↔ b̃` (T Remark 2.3).
    #[must_use]
    pub fn exchanged(self) -> Self {
        Pair {
            a: self.a_tilde,
            a_tilde: self.a,
            b: self.b_tilde,
            b_tilde: self.b,
            ..self
        }
    }

    /// The adjoint method, the inverse of the step with `−h`: `a*_ij = b_j − a_ij` and
    /// `ã*_ij = b̃_j − ã_ij`, `b* = b`, `b̃* = b̃` up to the order of the stages (GNI II.3).
    ///
    /// The stages keep their labels, so that the adjoint of the adjoint is the method itself; in the
    /// order of ascending `c*` they stand in reverse.
    #[must_use]
    pub fn adjoint(&self) -> Self {
        let algebra = &self.algebra;
        let one = algebra.constant(&BigRational::one());
        let complement =
            |b: &A::Vector, a: &A::Matrix| algebra.subtract_matrices(&algebra.outer(&one, b), a);
        Pair {
            a: complement(&self.b, &self.a),
            a_tilde: complement(&self.b_tilde, &self.a_tilde),
            ..self.clone()
        }
    }

    /// The method with the step `γh`: `γa_ij`, `γb_i`, `γã_ij`, `γb̃_i`, for the same `γ` at every stage.
    #[must_use]
    pub fn scaled(&self, fraction: &A::Vector) -> Self {
        let algebra = &self.algebra;
        let (same_a, same_b) = self.equal_halves();
        let matrix = |a: &A::Matrix| algebra.scale_rows(a, fraction);
        let vector = |b: &A::Vector| algebra.multiply(b, fraction);
        let (a, b) = (matrix(&self.a), vector(&self.b));
        // What is the same expression for both halves stays the same.
        Pair {
            a_tilde: if same_a {
                a.clone()
            } else {
                matrix(&self.a_tilde)
            },
            b_tilde: if same_b {
                b.clone()
            } else {
                vector(&self.b_tilde)
            },
            algebra: Arc::clone(algebra),
            a,
            b,
        }
    }

    /// `c_i = Σ_j a_ij`. These are the nodes iff the basis spans the constants.
    pub fn c(&self) -> A::Vector {
        self.row_sums(&self.a)
    }

    /// `c̃_i = Σ_j ã_ij`, which need not be the nodes.
    pub fn c_tilde(&self) -> A::Vector {
        self.row_sums(&self.a_tilde)
    }

    /// Whether the coefficients are those of a splitting as they stand; there may be splittings with other ones.
    pub(crate) fn staircase(&self) -> Option<Staircase> {
        let algebra = &*self.algebra;
        let steps = |positions, momenta| {
            algebra.is_staircase(&self.a, &self.b, positions)
                && algebra.is_staircase(&self.a_tilde, &self.b_tilde, momenta)
        };
        if steps(false, true) {
            Some(Staircase::KicksFirst)
        } else if steps(true, false) {
            Some(Staircase::DriftsFirst)
        } else {
            None
        }
    }

    fn row_sums(&self, matrix: &A::Matrix) -> A::Vector {
        let one = self.algebra.constant(&BigRational::one());
        self.algebra.apply(matrix, &one)
    }

    /// Whether `a = ã` and whether `b = b̃`, as elements.
    pub fn equal_halves(&self) -> (bool, bool) {
        (self.a == self.a_tilde, self.b == self.b_tilde)
    }

    /// All coefficients as numbers that can be enclosed and correctly rounded.
    pub fn numbers(&self) -> Coefficients<Number<'_>> {
        let algebra = &*self.algebra;
        self.coefficients(
            |sums| algebra.values(Cow::Owned(sums)),
            |weights| algebra.values(Cow::Borrowed(weights)),
            |matrix| algebra.entries(matrix),
        )
    }

    /// Readable exact forms of all coefficients that have one.
    pub fn exact_forms(&self) -> Coefficients<Option<String>> {
        let algebra = &*self.algebra;
        self.coefficients(
            |sums| algebra.exact_values(&sums),
            |weights| algebra.exact_values(weights),
            |matrix| algebra.exact_entries(matrix),
        )
    }

    /// Something for each coefficient, without a second look where both halves are the same.
    fn coefficients<'a, T: Clone>(
        &'a self,
        sums: impl Fn(A::Vector) -> Vec<T>,
        weights: impl Fn(&'a A::Vector) -> Vec<T>,
        matrix: impl Fn(&'a A::Matrix) -> Vec<Vec<T>>,
    ) -> Coefficients<T> {
        let (same_a, same_b) = self.equal_halves();
        let (c, b, a) = (sums(self.c()), weights(&self.b), matrix(&self.a));
        Coefficients {
            c_tilde: if same_a {
                c.clone()
            } else {
                sums(self.c_tilde())
            },
            b_tilde: if same_b {
                b.clone()
            } else {
                weights(&self.b_tilde)
            },
            a_tilde: if same_a {
                a.clone()
            } else {
                matrix(&self.a_tilde)
            },
            c,
            b,
            a,
        }
    }
}
