//! What all algebras of functions of the stages can do.

use std::borrow::Cow;
use std::fmt::Debug;

use num_rational::BigRational;

use super::{Field, Number, Zero};

/// Arithmetic on vectors `f_i` and matrices `f_ij` over the stages of a tableau.
///
/// An equation between tableau coefficients, order conditions among them, is a few of these
/// operations and the question whether the residual vanishes.
pub trait StageAlgebra: Debug + PartialEq + Send + Sync + Sized {
    /// Quantities with one index.
    type Vector: Clone + Debug + PartialEq + Send + Sync;
    /// Quantities with two indices.
    type Matrix: Clone + Debug + PartialEq + Send + Sync;
    /// The numbers over which this is a linear algebra: a sum over all stages is one.
    type Constants: Field;

    /// The number of stages.
    fn stages(&self) -> usize;

    /// The same rational number at every stage.
    fn constant(&self, value: &BigRational) -> Self::Vector;
    /// `f_i + g_i`.
    fn add(&self, f: &Self::Vector, g: &Self::Vector) -> Self::Vector;
    /// `f_i − g_i`.
    fn subtract(&self, f: &Self::Vector, g: &Self::Vector) -> Self::Vector;
    /// `f_i g_i`.
    fn multiply(&self, f: &Self::Vector, g: &Self::Vector) -> Self::Vector;
    /// `1/f_i`.
    ///
    /// # Errors
    /// The first stage at which `f` vanishes or cannot be distinguished from zero, and which of the two.
    fn reciprocal(&self, f: &Self::Vector) -> Result<Self::Vector, (usize, Zero)>;
    /// The numbers over which this is a linear algebra.
    fn constants(&self) -> &Self::Constants;
    /// The coordinates of a vector in a basis that [`Self::functional`] and [`Self::operator`] also use.
    fn coordinates(&self, f: &Self::Vector) -> Vec<Scalar<Self>>;
    /// The row of the linear form `g ↦ Σ_i f_i g_i`.
    fn functional(&self, f: &Self::Vector) -> Vec<Scalar<Self>>;
    /// The rows of the linear map `g_i ↦ Σ_j m_ij g_j`.
    fn operator(&self, m: &Self::Matrix) -> Vec<Vec<Scalar<Self>>>;

    /// `Σ_i f_i`.
    fn sum(&self, f: &Self::Vector) -> Number<'_>;
    /// `Σ_i f_i g_i`.
    fn inner(&self, f: &Self::Vector, g: &Self::Vector) -> Number<'_> {
        self.sum(&self.multiply(f, g))
    }

    /// The matrix `f_i g_j`.
    fn outer(&self, f: &Self::Vector, g: &Self::Vector) -> Self::Matrix;
    /// `m_ij + n_ij`.
    fn add_matrices(&self, m: &Self::Matrix, n: &Self::Matrix) -> Self::Matrix;
    /// `m_ij − n_ij`.
    fn subtract_matrices(&self, m: &Self::Matrix, n: &Self::Matrix) -> Self::Matrix;
    /// `m_ji`.
    fn transpose(&self, m: &Self::Matrix) -> Self::Matrix;
    /// `f_i m_ij`.
    fn scale_rows(&self, m: &Self::Matrix, f: &Self::Vector) -> Self::Matrix;
    /// `Σ_j m_ij f_j`.
    fn apply(&self, m: &Self::Matrix, f: &Self::Vector) -> Self::Vector;

    /// The values of a vector.
    fn values<'a>(&'a self, f: Cow<'a, Self::Vector>) -> Vec<Number<'a>>;
    /// The entries of a matrix.
    fn entries<'a>(&'a self, m: &'a Self::Matrix) -> Vec<Vec<Number<'a>>>;
    /// The entries of one row of a matrix.
    fn row<'a>(&'a self, m: &'a Self::Matrix, row: usize) -> Vec<Number<'a>>;
    /// A readable exact form of `Σ_i f_i`, where there is one.
    fn exact_sum(&self, f: &Self::Vector) -> Option<String>;
    /// Readable exact forms of the values, where there are any.
    fn exact_values(&self, f: &Self::Vector) -> Vec<Option<String>>;
    /// Readable exact forms of the entries, where there are any.
    fn exact_entries(&self, m: &Self::Matrix) -> Vec<Vec<Option<String>>>;

    /// The binary places to which equations are verified that no exact argument decides; `None` where
    /// all equations are decided.
    fn verified_bits(&self) -> Option<u32>;

    /// Whether `m_ij` is `b_j` below the diagonal and zero above it, and on it `b_j` if `filled`, otherwise zero. All of this holds
    /// for the elements, so it is certain. An algebra may return `false` without looking.
    fn is_lower_triangular(&self, _m: &Self::Matrix, _b: &Self::Vector, _filled: bool) -> bool {
        false
    }

    /// `Σ_{j<i} f_j`, with `f_i` itself where it is `own`: what a matrix for which [`Self::is_lower_triangular`] holds makes of the
    /// products with its weights. `None` for an algebra that does not look for such matrices.
    fn partial_sums(&self, _f: &Self::Vector, _own: bool) -> Option<Self::Vector> {
        None
    }

    /// The numbers of stages after which one of several steps ends: `m_ij` is `b_j` for the stages `j` before and `i` after, and
    /// zero for `i` before and `j` after. This holds for the elements. An algebra may return nothing without looking.
    fn ends_of_steps(&self, _m: &Self::Matrix, _b: &Self::Vector) -> Vec<usize> {
        Vec::new()
    }

    /// Groups the stages whose rows are equal when the columns of each group are added.
    fn equal_rows(&self, m: &Self::Matrix, columns: &[Vec<usize>]) -> Vec<Vec<usize>>;
    /// Whether [`Self::equal_rows`] looks at this stage, or leaves it alone unseen.
    fn sees_coincidences_of(&self, stage: usize) -> bool;
    /// `Σ_{j in group} m_ij` in one row, for a group of [`Self::equal_rows`].
    fn merged_entry(&self, m: &Self::Matrix, row: usize, group: &[usize]) -> Number<'_>;
    /// `Σ_{j in group} f_j`, for a group of [`Self::equal_rows`].
    fn merged_value(&self, f: &Self::Vector, group: &[usize]) -> Number<'_>;
}

/// A number of the field of constants of an algebra.
pub type Scalar<A> = <<A as StageAlgebra>::Constants as Field>::Element;

/// Groups what has equal keys; what has none stays alone.
pub(crate) fn group_by<K>(
    count: usize,
    key: impl Fn(usize) -> Option<K>,
    equal: impl Fn(&K, &K) -> bool,
) -> Vec<Vec<usize>> {
    let mut groups: Vec<(Option<K>, Vec<usize>)> = Vec::new();
    for item in 0..count {
        let key = key(item);
        let known = groups.iter_mut().find(|(known, _)| match (known, &key) {
            (Some(known), Some(key)) => equal(known, key),
            _ => false,
        });
        match known {
            Some((_, group)) => group.push(item),
            None => groups.push((key, vec![item])),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}
