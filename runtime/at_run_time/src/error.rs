//! Errors in coefficients.

use symplectic_core::inside::debug_by_message;

use crate::coefficients::RunTimeCoefficients;

debug_by_message!(TableauError);

/// Why coefficients are not those of a symplectic method. Rows, columns and stages are counted from 1.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableauError {
    /// There is no stage.
    #[error("the tableau has no stages; give at least one weight")]
    NoStages,

    /// There are gradient kicks.
    #[error(
        "the tableau has gradient kicks, which only a method that a macro emits takes: `tableau! {{ Name {{ base: chin-1997-c }} }}`"
    )]
    GradientKicks,

    /// A list or a row does not have an entry for each stage.
    #[error("{what}{} has {found} entries and the tableau {expected} stages", OfRow(*.row))]
    Shape {
        /// The list or matrix: `a`, `ã`, `b`, `b̃`, `c` or `c̃`.
        what: &'static str,
        /// The row; `None` if the list itself or the number of rows is wrong.
        row: Option<usize>,
        /// Number of stages, which is the number of entries of `b`.
        expected: usize,
        /// Number of entries.
        found: usize,
    },

    /// A coefficient is NaN or infinite.
    #[error("entry {column} of {what}{} is {value}; coefficients must be finite", OfRow(*.row))]
    NotFinite {
        /// The list or matrix.
        what: &'static str,
        /// The row of a matrix.
        row: Option<usize>,
        /// The entry.
        column: usize,
        /// Its value.
        value: f64,
    },

    /// The weights do not sum to 1.
    #[error("the weights {what} sum to {sum} and not to 1")]
    Weights {
        /// `b` or `b̃`.
        what: &'static str,
        /// Their sum.
        sum: f64,
    },

    /// A node is not the sum of its row.
    #[error("row {row} of {what} sums to {sum}, and its node is {node}")]
    Node {
        /// `a` or `ã`.
        what: &'static str,
        /// The row.
        row: usize,
        /// The sum of the row.
        sum: f64,
        /// `c_i` or `c̃_i`.
        node: f64,
    },

    /// The angle of a fitted method is too large or not a number.
    #[error(
        "the product of frequency and step size is {nu}; it must be a number between -64 and 64"
    )]
    Angle {
        /// `ν = wh`
        nu: f64,
    },

    /// A fitted method does not exist at an angle.
    #[error(
        "the method has no coefficients where the product of frequency and step size is {nu}: a weight or a determinant vanishes there; \
         take another step size"
    )]
    NoMethod {
        /// `ν = wh`
        nu: f64,
    },

    /// The method is not symplectic.
    #[error(
        "row {row} of ã and column {row} of a are not symplectic: b_i ã_ij + b̃_j a_ji − b_i b̃_j is {defect:e} for \
         i = {row}, j = {column}; it must be zero up to rounding"
    )]
    NotSymplectic {
        /// i
        row: usize,
        /// j
        column: usize,
        /// `b_i ã_ij + b̃_j a_ji − b_i b̃_j`
        defect: f64,
    },
}

/// " in row i", or nothing.
struct OfRow(Option<usize>);

impl core::fmt::Display for OfRow {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.0
            .map_or(Ok(()), |row| write!(formatter, " in row {row}"))
    }
}

/// Rounding errors of sums and products of correctly rounded numbers, in units of EPSILON; each term of a sum adds one more.
const UNITS: f64 = 4.0;

/// Whether two numbers are equal up to the rounding errors of the `terms` terms that they were computed from.
pub(crate) fn is_about(left: f64, right: f64, terms: usize) -> bool {
    is_rounding(left - right, left.abs() + right.abs(), terms)
}

/// Whether a number is the rounding error of `terms` terms whose sizes sum to `size`.
fn is_rounding(value: f64, size: f64, terms: usize) -> bool {
    value.abs() <= (UNITS + terms as f64) * f64::EPSILON * size
}

/// Whether the weights of a method must sum to 1. Those of a fitted method tend to this sum as the step gets smaller.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Weights {
    SumToOne,
    Fitted,
}

/// Makes every check that needs only the coefficients.
pub(crate) fn check(
    coefficients: &RunTimeCoefficients,
    weights: Weights,
) -> Result<(), TableauError> {
    let consistent = weights == Weights::SumToOne;
    let RunTimeCoefficients {
        a,
        a_tilde,
        b,
        b_tilde,
        c,
        c_tilde,
        gradient,
    } = coefficients;
    let stages = b.len();
    if stages == 0 {
        return Err(TableauError::NoStages);
    }
    if gradient.iter().any(|&weight| weight != 0.0) {
        return Err(TableauError::GradientKicks);
    }
    for (what, list) in [("b", b), ("b̃", b_tilde), ("c", c), ("c̃", c_tilde)] {
        check_list(what, None, list, stages)?;
    }
    for (what, matrix) in [("a", a), ("ã", a_tilde)] {
        if matrix.len() != stages {
            let found = matrix.len();
            return Err(shape(what, None, stages, found));
        }
        for (i, row) in matrix.iter().enumerate() {
            check_list(what, Some(i + 1), row, stages)?;
        }
    }
    for (what, weights) in [("b", b), ("b̃", b_tilde)] {
        let sum: f64 = weights.iter().sum();
        let size: f64 = weights.iter().map(|weight| weight.abs()).sum();
        if consistent && !is_rounding(sum - 1.0, size + 1.0, stages) {
            return Err(TableauError::Weights { what, sum });
        }
    }
    for (what, matrix, nodes) in [("a", a, c), ("ã", a_tilde, c_tilde)] {
        for (i, (row, &node)) in matrix.iter().zip(nodes).enumerate() {
            let sum: f64 = row.iter().sum();
            let size: f64 = row.iter().map(|entry| entry.abs()).sum();
            if !is_rounding(sum - node, size + node.abs(), stages) {
                let row = i + 1;
                return Err(TableauError::Node {
                    what,
                    row,
                    sum,
                    node,
                });
            }
        }
    }
    for i in 0..stages {
        for j in 0..stages {
            let terms = [
                b[i] * a_tilde[i][j],
                b_tilde[j] * a[j][i],
                -b[i] * b_tilde[j],
            ];
            let defect: f64 = terms.iter().sum();
            let size: f64 = terms.iter().map(|term| term.abs()).sum();
            if !is_rounding(defect, size, 0) {
                return Err(TableauError::NotSymplectic {
                    row: i + 1,
                    column: j + 1,
                    defect,
                });
            }
        }
    }
    Ok(())
}

fn shape(what: &'static str, row: Option<usize>, expected: usize, found: usize) -> TableauError {
    TableauError::Shape {
        what,
        row,
        expected,
        found,
    }
}

fn check_list(
    what: &'static str,
    row: Option<usize>,
    list: &[f64],
    stages: usize,
) -> Result<(), TableauError> {
    if list.len() != stages {
        return Err(shape(what, row, stages, list.len()));
    }
    match list.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(TableauError::NotFinite {
            what,
            row,
            column: index + 1,
            value: list[index],
        }),
        None => Ok(()),
    }
}
