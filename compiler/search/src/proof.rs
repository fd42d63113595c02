//! From a solution in doubles to a proved method.
//!
//! The free parameters of a solution are set to short decimals near the minimum. The others solve the order conditions with them, first in
//! doubles and then, by the proof that a method with a claim goes through, exactly.

use nalgebra::DVector;
use symplectic_compiler::arithmetic::rounding::{Decimal, exact};
use symplectic_compiler::certify::{
    Certificate, CertifyError, Claim, KICK, Printed, Processor, Splitting, certify,
    certify_composition, certify_processed,
};
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{Definition, Error, Key, Limits, Tableau};

use crate::hunt::{Problem, Solution};
use crate::manifold::{Manifold, tangents};
use crate::structure::{Model, Structure};
use crate::words::Exponent;

/// A method that is proved to have the claimed order.
#[derive(Debug, Clone)]
pub struct Method {
    /// The definition, with a claim and the digits of the exact method.
    pub definition: Definition,
    /// The derived tableau.
    pub tableau: Tableau,
    /// The numbers of the unknowns that were free, and are short decimals.
    pub free: Vec<usize>,
    /// The error constant in the class and the order of the search, proved to 12 digits.
    pub error: f64,
}

/// Why a solution in doubles has not become a method.
#[derive(Debug, thiserror::Error)]
pub enum ProofError {
    /// The exact method was not found near the digits.
    #[error(transparent)]
    Certify(#[from] CertifyError),
    /// The definition with the exact digits has an error.
    #[error(transparent)]
    Derive(#[from] Error),
    /// With short decimals for the free parameters there is no solution nearby.
    #[error("there is no solution with short decimals near this one: it is almost singular")]
    Singular,
}

/// Significant digits of the coefficients that are not free.
const DIGITS: usize = 35;
/// Digits of a double of which all are right.
const DOUBLE: usize = 10;
/// Decimals of free parameters: the fewest that raise the error by less than this share.
const DECIMALS: std::ops::RangeInclusive<usize> = 3..=9;
const RISE: f64 = 1e-3;

impl Problem {
    /// Proves that an exact method of the claimed order is near a solution, and writes it down.
    ///
    /// # Errors
    /// [`ProofError`], in practice only for solutions that are almost singular.
    pub fn prove(&self, solution: &Solution) -> Result<Method, ProofError> {
        let manifold = self.manifold()?;
        let (unknowns, free) = shortened(&manifold, solution).ok_or(ProofError::Singular)?;
        let texts: Vec<String> = unknowns
            .iter()
            .enumerate()
            .map(
                |(index, value)| match free.iter().find(|(number, _)| *number == index) {
                    Some((_, decimals)) => format!("{value:.decimals$}"),
                    None => double_text(*value),
                },
            )
            .collect();
        let certificate = self.certificate(&manifold.model, &texts)?;
        let digits = self.exact_digits(&manifold.model, &certificate, &texts, &free)?;
        let definition = self.definition(&manifold.model, &digits);
        let tableau = definition.derive(&Limits::at_most(usize::from(u16::MAX)))?;
        let (class, _) = self.compared_in();
        let error = error_constant(&tableau, class);
        Ok(Method {
            definition,
            tableau,
            error,
            free: free.into_iter().map(|(index, _)| index).collect(),
        })
    }

    /// The proof for the printed unknowns.
    fn certificate(&self, model: &Model, texts: &[String]) -> Result<Certificate, CertifyError> {
        let printed: Vec<Printed> = texts
            .iter()
            .map(|text| Printed::parse(text))
            .collect::<Result<_, _>>()?;
        if let Claim::SymmetricBase(order) = self.claim {
            let weights: Vec<Printed> = model
                .sequence
                .iter()
                .map(|&unknown| printed[unknown].clone())
                .collect();
            if matches!(self.structure, Structure::Processed { .. }) {
                let kernel = weights.len().div_ceil(2);
                let processor = Processor::BackAndForth(printed[kernel..].to_vec());
                return certify_processed(&weights, &processor, order);
            }
            return certify_composition(&weights, order);
        }
        let (mut kick, mut drift, mut gradient) = (Vec::new(), Vec::new(), Vec::new());
        for (exponent, &unknown) in model.steps.exponents.iter().zip(&model.sequence) {
            let value = printed[unknown].clone();
            match exponent {
                Exponent::Letter(KICK) => kick.push(value),
                Exponent::Gradient => {
                    gradient.resize_with(kick.len().saturating_sub(1), Printed::zero);
                    gradient.push(value);
                }
                _ => {
                    if kick.len() == drift.len() {
                        kick.push(Printed::zero());
                    }
                    drift.push(value);
                }
            }
        }
        drift.resize_with(kick.len(), Printed::zero);
        if !gradient.is_empty() {
            gradient.resize_with(kick.len(), Printed::zero);
        }
        certify(
            &Splitting {
                kick,
                drift,
                gradient,
            },
            &self.claim,
        )
    }

    /// The digits of the unknowns of the exact method.
    fn exact_digits(
        &self,
        model: &Model,
        certificate: &Certificate,
        texts: &[String],
        free: &[(usize, usize)],
    ) -> Result<Vec<String>, CertifyError> {
        (0..model.unknowns())
            .map(|index| {
                let is_free = free.iter().any(|(number, _)| *number == index);
                let decimal = certificate.decimal(model.names[index], DIGITS)?;
                Ok(match decimal {
                    Some(decimal) if !is_free => decimal.to_string(),
                    _ => texts[index].clone(),
                })
            })
            .collect()
    }

    fn definition(&self, model: &Model, digits: &[String]) -> Definition {
        let (lists, others) = model.lists();
        let list = |numbers: Vec<Option<usize>>| {
            let values: Vec<&str> = numbers
                .iter()
                .map(|index| index.map_or("0", |index| &*digits[index]))
                .collect();
            values.join(", ")
        };
        let list = |key: Key, numbers: Vec<Option<usize>>| match key {
            Key::Processor => format!("back_and_forth({})", list(numbers)),
            _ => format!("[{}]", list(numbers)),
        };
        let mut parts: Vec<(Key, String)> = lists
            .into_iter()
            .map(|(key, numbers)| (key, list(key, numbers)))
            .collect();
        parts.extend(others.into_iter().map(|(key, text)| (key, text.to_owned())));
        parts.push((Key::Claim, self.claim.notation()));
        Definition::new(parts)
    }
}

/// The error constant of a tableau in a class.
pub(crate) fn error_constant(tableau: &Tableau, class: HamiltonianClass) -> f64 {
    let report = tableau.orders();
    let constant = report.class(class).error_constant.as_ref();
    constant.map_or(f64::NAN, |constant| {
        symplectic_compiler::arithmetic::rounding::to_f64(&constant.value())
    })
}

/// A double with all its digits, as a decimal without an exponent.
fn double_text(value: f64) -> String {
    Decimal::round(&exact(value), DOUBLE).to_string()
}

/// The numbers of free unknowns with their decimals.
type Decimals = Vec<(usize, usize)>;

/// The solution with its free unknowns rounded to short decimals: the unknowns, and the numbers of the free ones with their decimals.
fn shortened(manifold: &Manifold, solution: &Solution) -> Option<(DVector<f64>, Decimals)> {
    let start = DVector::from_vec(solution.unknowns.clone());
    let (_, slopes) = manifold.constraints(&start);
    let free = leading_rows(tangents(&slopes));
    if free.is_empty() {
        let solved = manifold.project(&start, 20)?;
        return Some((solved, Vec::new()));
    }
    let mut last = None;
    for decimals in DECIMALS {
        let ten = 10f64.powi(i32::try_from(decimals).unwrap_or(0));
        let fixed: Vec<(usize, f64)> = free
            .iter()
            .map(|&index| (index, (start[index] * ten).round() / ten))
            .collect();
        let Some(solved) = manifold.project_with(&start, &fixed) else {
            continue;
        };
        let error = manifold.figure.value(&manifold.model, &solved).sqrt();
        let with_decimals = free.iter().map(|&index| (index, decimals)).collect();
        if error <= solution.error * (1.0 + RISE) {
            return Some((solved, with_decimals));
        }
        last = Some((solved, with_decimals));
    }
    last
}

/// As many rows of a matrix as it has columns, whose minor is large: the row that is largest, then the one that is largest beside it, ….
fn leading_rows(mut matrix: nalgebra::DMatrix<f64>) -> Vec<usize> {
    let mut rows = Vec::new();
    for _ in 0..matrix.ncols() {
        let lengths = matrix.row_iter().map(|row| row.norm());
        let Some((largest, length)) = lengths.enumerate().max_by(|x, y| x.1.total_cmp(&y.1)) else {
            break;
        };
        let direction = matrix.row(largest) / length;
        let along = &matrix * direction.transpose();
        matrix -= along * direction;
        rows.push(largest);
    }
    rows.sort_unstable();
    rows
}
