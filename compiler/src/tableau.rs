//! The exact tableau of a symplectic partitioned Runge–Kutta method.

use std::borrow::Cow;
use std::sync::Arc;

use num_rational::BigRational;
use num_traits::One;

use crate::algebra::{ClosedForm, NodeAlgebra, Number, Tensor, closed_form};
use crate::arithmetic::polynomial::Polynomial;

/// Where a tableau comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Provenance {
    /// The basis, as it is written: `polynomial(3)`.
    pub basis: String,
    /// The nodes, as they are written: `lobatto(3)`.
    pub nodes: String,
    /// The paper or book that the method is from.
    pub source: Option<String>,
}

/// The exact coefficients of the method (LZ 42, MW 2.6.6)
///
/// ```text
/// Q_i = q0 + h Σ_j a_ij ∂H/∂p(Q_j, P_j)      q1 = q0 + h Σ_i b_i ∂H/∂p(Q_i, P_i)
/// P_i = p0 − h Σ_j ã_ij ∂H/∂q(Q_j, P_j)      p1 = p0 − h Σ_i b̃_i ∂H/∂q(Q_i, P_i)
/// ```
///
/// with `c_i = Σ_j a_ij` and `c̃_i = Σ_j ã_ij`, as elements of the node algebra `K` and of `K ⊗ K`.
/// Stages are ordered by ascending nodes. Nothing in it is a floating-point number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tableau {
    pub(crate) name: Option<String>,
    pub(crate) provenance: Provenance,
    pub(crate) algebra: Arc<NodeAlgebra>,
    pub(crate) a: Tensor,
    pub(crate) a_tilde: Tensor,
    pub(crate) b: Polynomial,
    pub(crate) b_tilde: Polynomial,
}

impl Tableau {
    /// The same tableau with a name.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    /// The same tableau with the paper or book that it is from.
    #[must_use]
    pub fn with_source(mut self, source: impl Into<String>) -> Self {
        self.provenance.source = Some(source.into());
        self
    }

    /// The name, if it was given one.
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Where the tableau comes from.
    pub fn provenance(&self) -> &Provenance {
        &self.provenance
    }

    /// The number of stages.
    pub fn stages(&self) -> usize {
        self.algebra.dimension()
    }

    /// The algebra that the coefficients are elements of.
    pub fn algebra(&self) -> &Arc<NodeAlgebra> {
        &self.algebra
    }

    /// `a_ij = a(c_i, c_j)`.
    pub fn a(&self) -> &Tensor {
        &self.a
    }

    /// `ã_ij = ã(c_i, c_j)`.
    pub fn a_tilde(&self) -> &Tensor {
        &self.a_tilde
    }

    /// `b_i = b(c_i)`.
    pub fn b(&self) -> &Polynomial {
        &self.b
    }

    /// `b̃_i = b̃(c_i)`.
    pub fn b_tilde(&self) -> &Polynomial {
        &self.b_tilde
    }

    /// `c_i = Σ_j a_ij`. These are the nodes iff the basis spans the constants.
    pub fn c(&self) -> Polynomial {
        self.a.apply(&self.algebra, &Polynomial::one())
    }

    /// `c̃_i = Σ_j ã_ij`, which need not be the nodes.
    pub fn c_tilde(&self) -> Polynomial {
        self.a_tilde.apply(&self.algebra, &Polynomial::one())
    }

    /// The adjoint method, the inverse of the step with `−h`: `a*_ij = b_j − a_ij` and
    /// `ã*_ij = b̃_j − ã_ij`, `b* = b`, `b̃* = b̃` (theory.md §4 up to the order of the stages).
    ///
    /// The stages keep their labels, so that the adjoint of the adjoint is the method itself; in the
    /// order of ascending `c*` they stand in reverse.
    #[must_use]
    pub fn adjoint(&self) -> Self {
        let outer = |b: &Polynomial| {
            Tensor::from_products(&self.algebra, &[(Polynomial::one(), b.clone())])
        };
        Tableau {
            name: self.name.as_ref().map(|name| format!("adjoint of {name}")),
            a: outer(&self.b).subtract(&self.a),
            a_tilde: outer(&self.b_tilde).subtract(&self.a_tilde),
            ..self.clone()
        }
    }

    /// All coefficients as numbers that can be enclosed and correctly rounded.
    ///
    /// ```
    /// let gauss = symplectic_compiler::derive("polynomial(2)", "gauss(2)")?;
    /// assert_eq!(gauss.numbers().a[1][0].decimal(20).to_string(), "0.53867513459481288225");
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn numbers(&self) -> Coefficients<Number<'_>> {
        let matrix = |tensor| Number::of_tensor(&self.algebra, tensor);
        let vector = |element| Number::of_element(&self.algebra, element);
        let (a, b) = (matrix(&self.a), vector(Cow::Borrowed(&self.b)));
        // Without a second look where both halves are the same.
        let a_tilde = if self.a == self.a_tilde {
            a.clone()
        } else {
            matrix(&self.a_tilde)
        };
        let b_tilde = if self.b == self.b_tilde {
            b.clone()
        } else {
            vector(Cow::Borrowed(&self.b_tilde))
        };
        let (c, c_tilde) = (
            vector(Cow::Owned(self.c())),
            vector(Cow::Owned(self.c_tilde())),
        );
        Coefficients {
            c,
            c_tilde,
            b,
            b_tilde,
            a,
            a_tilde,
        }
    }

    /// The short exact forms of all coefficients that have one: rationals and `p + q√d`.
    pub fn closed_forms(&self) -> Coefficients<Option<ClosedForm>> {
        let vector = |element: &Polynomial| closed_form::of_element(&self.algebra, element);
        let a = closed_form::of_tensor(&self.algebra, &self.a);
        let a_tilde = if self.a == self.a_tilde {
            a.clone()
        } else {
            closed_form::of_tensor(&self.algebra, &self.a_tilde)
        };
        let b = vector(&self.b);
        let b_tilde = if self.b == self.b_tilde {
            b.clone()
        } else {
            vector(&self.b_tilde)
        };
        Coefficients {
            c: vector(&self.c()),
            c_tilde: vector(&self.c_tilde()),
            b,
            b_tilde,
            a,
            a_tilde,
        }
    }

    /// All coefficients as correctly rounded doubles.
    ///
    /// ```
    /// let gauss = symplectic_compiler::derive("polynomial(2)", "gauss(2)")?;
    /// assert_eq!(gauss.to_f64().a[1], [0.25 + 3f64.sqrt() / 6.0, 0.25]);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn to_f64(&self) -> Coefficients<f64> {
        self.numbers().map(Number::to_f64)
    }

    /// `Σ_i b_i` and `Σ_i b̃_i`.
    pub(crate) fn weight_sums(&self) -> (BigRational, BigRational) {
        (
            self.algebra.trace(&self.b),
            self.algebra.trace(&self.b_tilde),
        )
    }

    /// Whether both sums of weights are 1.
    pub(crate) fn weights_sum_to_one(&self) -> bool {
        let (q, p) = self.weight_sums();
        q.is_one() && p.is_one()
    }
}

/// One thing for each coefficient of a tableau, in the order of ascending nodes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Coefficients<T> {
    /// `c_i`
    pub c: Vec<T>,
    /// `c̃_i`
    pub c_tilde: Vec<T>,
    /// `b_i`
    pub b: Vec<T>,
    /// `b̃_i`
    pub b_tilde: Vec<T>,
    /// `a_ij`
    pub a: Vec<Vec<T>>,
    /// `ã_ij`
    pub a_tilde: Vec<Vec<T>>,
}

impl<T> Coefficients<T> {
    /// All of them: `c`, `c̃`, `b`, `b̃`, then `a` and `ã` by rows.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        let vectors = [&self.c, &self.c_tilde, &self.b, &self.b_tilde];
        vectors
            .into_iter()
            .chain(&self.a)
            .chain(&self.a_tilde)
            .flatten()
    }

    /// Something else for each coefficient.
    pub fn map<U>(&self, each: impl Fn(&T) -> U) -> Coefficients<U> {
        let vector = |v: &Vec<T>| v.iter().map(&each).collect();
        let matrix = |m: &Vec<Vec<T>>| {
            m.iter()
                .map(|row| row.iter().map(&each).collect())
                .collect()
        };
        Coefficients {
            c: vector(&self.c),
            c_tilde: vector(&self.c_tilde),
            b: vector(&self.b),
            b_tilde: vector(&self.b_tilde),
            a: matrix(&self.a),
            a_tilde: matrix(&self.a_tilde),
        }
    }

    /// Both things for each coefficient.
    pub fn zip<U>(self, other: Coefficients<U>) -> Coefficients<(T, U)> {
        fn vector<T, U>(a: Vec<T>, b: Vec<U>) -> Vec<(T, U)> {
            a.into_iter().zip(b).collect()
        }
        fn matrix<T, U>(a: Vec<Vec<T>>, b: Vec<Vec<U>>) -> Vec<Vec<(T, U)>> {
            a.into_iter().zip(b).map(|(a, b)| vector(a, b)).collect()
        }
        Coefficients {
            c: vector(self.c, other.c),
            c_tilde: vector(self.c_tilde, other.c_tilde),
            b: vector(self.b, other.b),
            b_tilde: vector(self.b_tilde, other.b_tilde),
            a: matrix(self.a, other.a),
            a_tilde: matrix(self.a_tilde, other.a_tilde),
        }
    }
}

/// The index of a matrix entry, counted from 1, as a subscript: `21`, and `2,10` where digits would run together.
pub(crate) fn subscript(row: usize, column: usize) -> String {
    if row < 10 && column < 10 {
        format!("{row}{column}")
    } else {
        format!("{row},{column}")
    }
}
