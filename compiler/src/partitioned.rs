//! The two matrices and the weights of a partitioned Runge–Kutta method over an algebra.

use std::borrow::Cow;
use std::sync::Arc;

use num_rational::BigRational;
use num_traits::One;

use crate::algebra::{Ball, Balls, Dense, Field, Number, Scalar, StageAlgebra, Zero};
use crate::coefficients::Coefficients;

/// The exact coefficients `a, b` for positions and `ã, b̃` for momenta of
///
/// ```text
/// Q_i = q0 + h Σ_j a_ij ∂H/∂p(Q_j, P_j)      q1 = q0 + h Σ_i b_i ∂H/∂p(Q_i, P_i)
/// P_i = p0 − h Σ_j ã_ij ∂H/∂q(Q_j, P_j)      p1 = p0 − h Σ_i b̃_i ∂H/∂q(Q_i, P_i)
/// ```
///
/// A splitting may have gradient kicks, for quadratic kinetic energy: with `f = −∂U/∂q` its kicks are
/// `p += h (b̃_i f + 2 g_i h² f′ M⁻¹ f)`, the flow of the potential `b̃_i U − g_i h² ∇U·M⁻¹∇U`.
#[derive(Debug, PartialEq)]
pub struct Partitioned<A: StageAlgebra> {
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
    /// `g_i` of gradient kicks, for splittings with such kicks only.
    pub gradient: Option<A::Vector>,
}

/// The form of the matrices of a splitting whose stages have one drift and one kick each.
///
/// ```text
/// kicks first    a_ij = b_j for j < i    ã_ij = b̃_j for j ≤ i
/// drifts first   a_ij = b_j for j ≤ i    ã_ij = b̃_j for j < i
/// ```
///
/// and zero elsewhere, so that the weights say all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LowerTriangular {
    /// `P_i` contains the kick at `Q_i`.
    KicksFirst,
    /// `Q_i` contains the drift at `P_i`.
    DriftsFirst,
}

impl LowerTriangular {
    /// Whether a stage position contains the drift of its own stage.
    pub fn has_own_drift(self) -> bool {
        self == LowerTriangular::DriftsFirst
    }

    /// Whether a stage momentum contains the kick of its own stage.
    pub fn has_own_kick(self) -> bool {
        self == LowerTriangular::KicksFirst
    }
}

/// A kick or a drift.
#[derive(Debug, Clone, PartialEq)]
pub struct Flow<T> {
    /// Whether it is a kick.
    pub is_kick: bool,
    /// The fraction of the step.
    pub fraction: T,
    /// `g` of a gradient kick.
    pub gradient: Option<T>,
}

impl<T> Flow<T> {
    /// Other numbers in the places of the fraction and of `g`.
    fn map<U>(&self, mut each: impl FnMut(&T) -> U) -> Flow<U> {
        Flow {
            is_kick: self.is_kick,
            fraction: each(&self.fraction),
            gradient: self.gradient.as_ref().map(each),
        }
    }
}

/// The flows of a splitting in their order: alternating kicks and drifts, without flows of zero time at either end.
#[derive(Debug, Clone)]
pub struct Flows<T>(Vec<Flow<T>>);

impl<T: PartialEq> Flows<T> {
    fn new(mut flows: Vec<Flow<T>>, zero: &T) -> Self {
        let nothing = |flow: &Flow<T>| flow.fraction == *zero && flow.gradient.is_none();
        while flows.last().is_some_and(nothing) {
            flows.pop();
        }
        let start = flows.iter().take_while(|flow| nothing(flow)).count();
        flows.drain(..start);
        Flows(flows)
    }

    /// Whether they are the same from both ends.
    pub fn is_palindrome(&self) -> bool {
        // Both ends are of one kind.
        self.0.len() % 2 == 1 && self.0.iter().eq(self.0.iter().rev())
    }
}

impl<T> Flows<T> {
    /// The flows in their order.
    pub fn iter(&self) -> impl Iterator<Item = &Flow<T>> {
        self.0.iter()
    }

    /// Other numbers in the places of the fractions.
    pub fn map<U>(&self, mut each: impl FnMut(&T) -> U) -> Flows<U> {
        Flows(self.0.iter().map(|flow| flow.map(&mut each)).collect())
    }

    /// The first half of an odd number of flows, with half of the middle flow at its end.
    pub fn first_half(mut self, halved: impl FnMut(&T) -> T) -> Self {
        self.0.truncate(self.0.len() / 2 + 1);
        if let Some(middle) = self.0.last_mut() {
            *middle = middle.map(halved);
        }
        self
    }
}

impl<F: Field> Partitioned<Dense<F>> {
    /// The coefficients of a splitting with the drifts `b` and the kicks `b̃`.
    pub fn of_splitting(
        field: F,
        lower_triangular: LowerTriangular,
        b: Vec<F::Element>,
        b_tilde: Vec<F::Element>,
    ) -> Self {
        let zero = field.rational(&BigRational::default());
        let rows = |weights: &[F::Element], own: bool| -> Vec<Vec<F::Element>> {
            let entry = |i: usize, j: usize| match j < i + usize::from(own) {
                true => weights[j].clone(),
                false => zero.clone(),
            };
            let row = |i: usize| (0..weights.len()).map(|j| entry(i, j)).collect();
            (0..weights.len()).map(row).collect()
        };
        Partitioned {
            a: rows(&b, lower_triangular.has_own_drift()),
            a_tilde: rows(&b_tilde, lower_triangular.has_own_kick()),
            algebra: Arc::new(Dense::new(field, b.len())),
            b,
            b_tilde,
            gradient: None,
        }
    }
}

impl<A: StageAlgebra> Clone for Partitioned<A> {
    fn clone(&self) -> Self {
        Partitioned {
            algebra: Arc::clone(&self.algebra),
            a: self.a.clone(),
            a_tilde: self.a_tilde.clone(),
            b: self.b.clone(),
            b_tilde: self.b_tilde.clone(),
            gradient: self.gradient.clone(),
        }
    }
}

impl<A: StageAlgebra> Partitioned<A> {
    /// The coefficients with `b̃ = b` and the `ã` that makes it symplectic (MW 2.6.7),
    /// `ã_ij = (b_i b_j − b_j a_ji)/b_i`.
    ///
    /// # Errors
    /// The first stage whose weight vanishes or cannot be distinguished from zero, and which of the two.
    pub fn symplectic(algebra: Arc<A>, a: A::Matrix, b: A::Vector) -> Result<Self, (usize, Zero)> {
        let inverse = algebra.reciprocal(&b)?;
        let one = algebra.constant(&BigRational::one());
        // b_i − a_ji at (j, i), so that ã_ij = b_j (b_i − a_ji)/b_i is exactly zero where a_ji is b_i.
        let complement = algebra.subtract_matrices(&algebra.outer(&one, &b), &a);
        let scaled = algebra.transpose(&algebra.scale_rows(&complement, &b));
        Ok(Partitioned {
            a_tilde: algebra.scale_rows(&scaled, &inverse),
            b_tilde: b.clone(),
            algebra,
            a,
            b,
            gradient: None,
        })
    }

    /// A Runge–Kutta method: the same coefficients for positions and momenta.
    pub fn equal(algebra: Arc<A>, a: A::Matrix, b: A::Vector) -> Self {
        Partitioned {
            algebra,
            a_tilde: a.clone(),
            b_tilde: b.clone(),
            a,
            b,
            gradient: None,
        }
    }

    /// The Runge–Kutta method with the coefficients for momenta.
    pub fn partner_alone(&self) -> Self {
        let algebra = Arc::clone(&self.algebra);
        Partitioned::equal(algebra, self.a_tilde.clone(), self.b_tilde.clone())
    }

    /// The coefficients with positions and momenta exchanged: `a ↔ ã`, `b ↔ b̃` (T Remark 2.3).
    #[must_use]
    pub fn exchanged(self) -> Self {
        Partitioned {
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
    /// The stages keep their labels, so the adjoint of the adjoint is the method itself. In the order of ascending `c*`
    /// they are reversed.
    #[must_use]
    pub fn adjoint(&self) -> Self {
        let algebra = &self.algebra;
        let one = algebra.constant(&BigRational::one());
        let complement =
            |b: &A::Vector, a: &A::Matrix| algebra.subtract_matrices(&algebra.outer(&one, b), a);
        Partitioned {
            a: complement(&self.b, &self.a),
            a_tilde: complement(&self.b_tilde, &self.a_tilde),
            ..self.clone()
        }
    }

    /// The method with the step `γh`: `γa_ij`, `γb_i`, `γã_ij`, `γb̃_i`, `γ³g_i`, for the same `γ` at every stage.
    #[must_use]
    pub fn scaled(&self, fraction: &A::Vector) -> Self {
        let algebra = &self.algebra;
        let (same_a, same_b) = self.equal_halves();
        let matrix = |a: &A::Matrix| algebra.scale_rows(a, fraction);
        let vector = |b: &A::Vector| algebra.multiply(b, fraction);
        let (a, b) = (matrix(&self.a), vector(&self.b));
        // What is the same expression for both halves stays the same.
        Partitioned {
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
            gradient: self.gradient.as_ref().map(|gradient| {
                (0..3).fold(gradient.clone(), |product, _| {
                    algebra.multiply(&product, fraction)
                })
            }),
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

    /// Whether the coefficients have the form of a splitting; other coefficients may also be splittings.
    pub fn lower_triangular(&self) -> Option<LowerTriangular> {
        let algebra = &*self.algebra;
        let steps = |positions, momenta| {
            algebra.is_lower_triangular(&self.a, &self.b, positions)
                && algebra.is_lower_triangular(&self.a_tilde, &self.b_tilde, momenta)
        };
        if steps(false, true) {
            Some(LowerTriangular::KicksFirst)
        } else if steps(true, false) {
            Some(LowerTriangular::DriftsFirst)
        } else {
            None
        }
    }

    /// The coefficients with enclosures of the coefficients, of this many bits.
    pub(crate) fn enclosed(&self, bits: u32) -> Partitioned<Dense<Balls>> {
        let algebra = &*self.algebra;
        let vector = |f: &A::Vector| -> Vec<Ball> {
            let values = algebra.values(Cow::Borrowed(f));
            values.iter().map(|x| x.ball(bits)).collect()
        };
        let (b, b_tilde) = (vector(&self.b), vector(&self.b_tilde));
        let gradient = self.gradient.as_ref().map(vector);
        if let Some(lower_triangular) = self.lower_triangular() {
            return Partitioned {
                gradient,
                ..Partitioned::of_splitting(Balls::new(bits), lower_triangular, b, b_tilde)
            };
        }
        let matrix = |m: &A::Matrix| -> Vec<Vec<Ball>> {
            let row = |row: &Vec<Number<'_>>| row.iter().map(|x| x.ball(bits)).collect();
            algebra.entries(m).iter().map(row).collect()
        };
        Partitioned {
            algebra: Arc::new(Dense::new(Balls::new(bits), algebra.stages())),
            a: matrix(&self.a),
            a_tilde: matrix(&self.a_tilde),
            b,
            b_tilde,
            gradient,
        }
    }

    /// The flows of a splitting, by its [`Partitioned::lower_triangular`].
    pub(crate) fn flows(&self) -> Option<Flows<Scalar<A>>> {
        let lower_triangular = self.lower_triangular()?;
        let zero = self.algebra.constants().rational(&BigRational::default());
        let [drifts, kicks] = [&self.b, &self.b_tilde].map(|f| self.algebra.functional(f));
        let gradients = self.gradient.as_ref().map(|g| self.algebra.functional(g));
        let pairs = kicks.into_iter().zip(drifts).enumerate();
        let flows = pairs.flat_map(|(i, (kick, drift))| {
            let gradient = gradients.as_ref().and_then(|all| all.get(i));
            let kick = Flow {
                is_kick: true,
                fraction: kick,
                gradient: gradient.filter(|g| **g != zero).cloned(),
            };
            let drift = Flow {
                is_kick: false,
                fraction: drift,
                gradient: None,
            };
            match lower_triangular {
                LowerTriangular::KicksFirst => [kick, drift],
                LowerTriangular::DriftsFirst => [drift, kick],
            }
        });
        Some(Flows::new(flows.collect(), &zero))
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
            gradient: self.gradient.as_ref().map(&weights).unwrap_or_default(),
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
