//! Reasons why a method is not certified.

use super::certificate::Certificate;
use super::conditions::Claim;
use super::structure::Structure;

/// The reason why there is no certificate.
#[derive(Debug, Clone, thiserror::Error)]
#[non_exhaustive]
pub enum CertifyError {
    /// The text of a coefficient is not a number.
    #[error("`{text}` is not a decimal or a fraction of two, with at most 10000 characters")]
    NotANumber {
        /// The beginning of the text.
        text: String,
    },
    /// Lists of different length.
    #[error(
        "{kicks} kicks and {drifts} drifts: the lists of a splitting have the same length; a method that ends with a kick has a last drift 0, one that begins with a drift has a first kick 0"
    )]
    Lengths {
        /// The number of kicks.
        kicks: usize,
        /// The number of drifts.
        drifts: usize,
    },
    /// Another claim than one for quadratic kinetic energy, of a splitting with gradient kicks.
    #[error("gradient kicks need quadratic T: claim `nystrom({order})`")]
    GradientKicks {
        /// The order that is claimed.
        order: usize,
    },
    /// Not one weight for each kick.
    #[error(
        "{kicks} kicks and {weights} weights of gradient kicks: one for each kick; write 0 where there is none"
    )]
    GradientLengths {
        /// The number of kicks.
        kicks: usize,
        /// The number of weights.
        weights: usize,
    },
    /// There are no coefficients, or too many.
    #[error("{count} stages; between 1 and {limit} are certified")]
    Stages {
        /// The number of stages.
        count: usize,
        /// The largest number that is certified.
        limit: usize,
    },
    /// A coefficient is too large for a practical method.
    #[error("{coefficient} = {value} is larger than {limit}")]
    TooLarge {
        /// The coefficient.
        coefficient: String,
        /// Its value.
        value: String,
        /// The bound.
        limit: u32,
    },
    /// An order that no claim can have.
    #[error(
        "the order {order} cannot be claimed: orders are from 1 to {limit}, and those for perturbed systems do not increase"
    )]
    Order {
        /// The order.
        order: usize,
        /// The highest order.
        limit: usize,
    },
    /// The weights do not sum to 1, by more than their digits explain.
    #[error("the {what} sum to {sum}, not to 1{}", nearest.as_ref().map_or("; no certified solution was found".to_owned(), |found| format!("; the nearest certified solution is {} away", found.distance_text())))]
    WeightSum {
        /// `kicks`, `drifts` or `weights`.
        what: &'static str,
        /// Their sum.
        sum: String,
        /// The exact method to which Newton's iteration leads from the digits, if it leads to any.
        nearest: Option<Box<Certificate>>,
    },
    /// An order for every symmetric basic method is claimed, but the coefficients are not those of a composition.
    #[error(
        "these are not the coefficients of a composition of Störmer–Verlet: then the outer ones were half sums of neighbouring inner ones"
    )]
    NotAComposition,
    /// Fewer coefficients than conditions.
    #[error(
        "{claim} takes {conditions} conditions, and a {structure} with these coefficients has {unknowns} unknown{}: too few to certify a solution", if *unknowns == 1 {""} else {"s"}
    )]
    TooFewCoefficients {
        /// The claim.
        claim: Claim,
        /// The structure in which the method was read.
        structure: Structure,
        /// The number of order conditions.
        conditions: usize,
        /// The number of free coefficients.
        unknowns: usize,
    },
    /// The conditions have dependent derivatives near the digits.
    #[error(
        "the {conditions} conditions of {claim} are dependent at these digits (rank {rank} as a {structure}), so that no solution near them can be proved by their derivatives"
    )]
    Dependent {
        /// The claim.
        claim: Claim,
        /// The structure in which the method was read.
        structure: Structure,
        /// The number of order conditions.
        conditions: usize,
        /// The numerical rank of their derivatives.
        rank: usize,
    },
    /// The exact method in the neighbourhood has other digits.
    #[error(
        "the nearest certified solution of {} is {} away from the digits, and they allow for {allowed}", certificate.claim(), certificate.distance_text()
    )]
    DifferentSolution {
        /// The largest distance that would have been accepted.
        allowed: String,
        /// The exact method that was found.
        certificate: Box<Certificate>,
    },
    /// Newton's iteration does not converge from the digits.
    #[error(
        "{claim} is not certified: no solution was found from these digits, whose largest residual is {residual}, in a condition of degree {degree}"
    )]
    NotFound {
        /// The claim.
        claim: Claim,
        /// The largest residual of an order condition for the digits.
        residual: String,
        /// The degree of that condition.
        degree: usize,
    },
    /// More digits are requested than are computed.
    #[error("{digits} digits; at most {limit} are computed")]
    Digits {
        /// The number of digits requested.
        digits: usize,
        /// The largest number of digits.
        limit: usize,
    },
}

impl CertifyError {
    /// The certificate of the nearest solution that was found, however far it is.
    ///
    /// # Errors
    /// The error itself, if there is none.
    pub fn into_nearest(self) -> Result<Certificate, CertifyError> {
        match self {
            CertifyError::DifferentSolution { certificate, .. }
            | CertifyError::WeightSum {
                nearest: Some(certificate),
                ..
            } => Ok(*certificate),
            other => Err(other),
        }
    }
}
