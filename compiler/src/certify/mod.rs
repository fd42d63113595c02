//! Certified coefficients of explicit methods: a proof that an exact method lies behind printed digits.
//!
//! The decimals of a paper satisfy the order conditions only up to their last digits. [`certify()`] solves the
//! conditions exactly: it proves that near the digits there is a method with real coefficients which has the
//! claimed order. It bounds the distance of that method from the digits, gives a radius within which it is unique, and
//! computes its coefficients to any number of digits.
//!
//! ```
//! use symplectic_compiler::certify::{Claim, Coefficient, Splitting, certify};
//!
//! // The triple jump of Störmer–Verlet, to eight digits.
//! let kick = ["0.67560360", "-0.17560360", "-0.17560360", "0.67560360"];
//! let drift = ["1.35120719", "-1.70241438", "1.35120719", "0"];
//! let exact = certify(&Splitting::parse(&kick, &drift)?, &Claim::Separable(4))?;
//! let digits = exact.decimal(Coefficient::Drift(0), 30)?.map(|d| d.to_string());
//! // 1/(2 − ∛2)
//! assert_eq!(digits.as_deref(), Some("1.35120719195965763404768780897"));
//! assert_eq!(exact.distance_text(), "4.0e-9");
//! # Ok::<(), symplectic_compiler::certify::CertifyError>(())
//! ```
//!
//! 1. The structure is read off the digits: symmetric sequences, compositions of Störmer–Verlet, equal
//!    coefficients ([`Structure`]). Readings with more structure are tried first.
//! 2. Each structure has a sufficient set of order conditions ([`Conditions`], where they are derived), which
//!    are polynomials in the unknowns with rational coefficients.
//! 3. There may be more unknowns than conditions, as in methods whose authors minimised an error norm. Then the excess
//!    unknowns are fixed at exact values ([`Certificate::fixed`]): first those that look exact in print, such as
//!    `0.28` or `0.5454…5455 = 6/11`, then those on which the conditions depend least.
//! 4. Newton's iteration leads from the digits to a point, and Krawczyk's test in interval arithmetic proves that
//!    this point is near an exact solution (Krawczyk 1969).
//!
//! The proof does not depend on the guesses. Whatever structure was read and whichever unknowns were fixed, the method
//! in the certificate has real coefficients that satisfy every order condition of the claim.

mod affine;
mod certificate;
mod conditions;
mod digits;
mod error;
mod find;
mod linear;
mod lyndon;
mod minimax;
mod newton;
mod nystrom;
mod printed;
mod processed;
mod proof;
mod search;
mod selection;
mod settle;
mod splitting;
mod structure;
mod system;

pub use certificate::{Certificate, Fixed};
pub use conditions::{Claim, Condition, Conditions, MAX_ORDER, MAX_PERTURBED_ORDER};
pub use digits::Digits;
pub use error::CertifyError;
pub use find::find_processor;
pub(crate) use lyndon::split_lyndon;
pub use lyndon::{Alphabet, Word, is_lyndon};
pub use printed::{MAX_DIGITS, Printed};
pub use processed::Processor;
pub use search::{certify, certify_composition, certify_processed};
pub use splitting::{MAX_STAGES, Splitting};
pub use structure::{Coefficient, Structure};

// What `symplectic-tools` needs: see `crate::inside`.
#[doc(hidden)]
pub use affine::Affine;
#[doc(hidden)]
pub use certificate::Enclosed;
#[doc(hidden)]
pub use linear::{inverse, middle};
#[doc(hidden)]
pub use lyndon::{DRIFT, KICK};
#[doc(hidden)]
pub use minimax::{Best, Row, minimax};
#[doc(hidden)]
pub use newton::{Equations, Square};
#[doc(hidden)]
pub use printed::decimal_text;
#[doc(hidden)]
pub use proof::Proof;
#[doc(hidden)]
pub use search::PROOF_BITS;
#[doc(hidden)]
pub use selection::pivots;
#[doc(hidden)]
pub use settle::{Settled, settle};
#[doc(hidden)]
pub use structure::{Target, Unknown};
#[doc(hidden)]
pub use system::{Kind, Step, System};

#[cfg(test)]
mod tests;
