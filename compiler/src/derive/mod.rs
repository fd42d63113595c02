//! From a definition to the tableau (LZ §4.4, steps 1–5; T §2.2).
//!
//! The tier follows from the definition. Polynomial bases at all roots of one polynomial are derived in the node
//! algebra. Anything else is derived in a constant field, if one holds all values and integrals of the basis,
//! and otherwise as certified enclosures. Splittings and their compositions are derived in the field of their
//! fractions. Results of [operations](crate::Tableau::concatenate) on tableaux are derived from the definitions
//! of the operands by the same operations.

mod base_method;
mod certified;
mod claim;
mod composition;
mod construction_kind;
mod dense;
mod fractions;
mod linear;
mod named_compositions;
mod node;
mod parts;
mod problem;
mod reading;
mod sequence;
mod splitting;
mod tiers;

pub(crate) use self::composition::check_depth;
pub(crate) use self::named_compositions::Scheme;
pub(crate) use self::parts::{Parts, Substep, parts};
use self::problem::{Construction, Problem};
use crate::basis::Basis;
use crate::definition::{Definition, Key, trimmed};
use crate::error::{Error, ErrorKind, Place};
use crate::exact::Exact;
use crate::limits::Limits;
use crate::quadrature::{Nodes, QuadratureRule};
use crate::tableau::Tableau;

/// Derives the tableau of a basis at nodes, both given as text, within the default [`Limits`].
///
/// # Errors
/// The errors of [`Definition::derive`].
///
/// ```
/// let tableau = symplectic_compiler::derive("polynomial(3)", "lobatto(3)")?;
/// assert_eq!(tableau.stages(), 3);
/// assert!(tableau.properties().symplectic.holds);
///
/// let error = symplectic_compiler::derive("polynomial(2)", "0, 0").unwrap_err();
/// assert_eq!(error.to_string(), "nodes, column 4: the node 0 is listed twice; nodes must be distinct");
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
pub fn derive(basis: &str, nodes: &str) -> Result<Tableau, Error> {
    derive_within(basis, nodes, &Limits::default())
}

/// [`derive()`] within given limits.
///
/// # Errors
/// The errors of [`Definition::derive`].
pub fn derive_within(basis: &str, nodes: &str, limits: &Limits) -> Result<Tableau, Error> {
    Definition::new([(Key::Basis, basis), (Key::Nodes, nodes)]).derive(limits)
}

impl Definition {
    /// Derives the tableau.
    ///
    /// # Errors
    /// The first error of [`Definition::derive_or_all_errors`].
    pub fn derive(&self, limits: &Limits) -> Result<Tableau, Error> {
        self.derive_or_all_errors(limits).map_err(first)
    }

    /// Derives the tableau, or returns all errors in the parts.
    ///
    /// # Errors
    /// Wrong expressions, unknown names, too many stages, nodes that are equal or outside `[0, 1]`, dependent
    /// functions, each at its place in the part. Incompatible parts; [`ErrorKind::NotSquare`],
    /// [`ErrorKind::SingularBasis`], [`ErrorKind::ZeroWeight`] and the undecided cases of the last two.
    pub fn derive_or_all_errors(&self, limits: &Limits) -> Result<Tableau, Vec<Error>> {
        let problem = Problem::read(self, limits)?;
        problem.derive().map_err(|kind| vec![self.place(kind)])
    }

    /// Places an error of the derivation at the relevant part.
    fn place(&self, kind: ErrorKind) -> Error {
        let keys: &[Key] = if kind.is_about_basis() {
            &[Key::Basis, Key::Compose]
        } else if kind.is_about_weight() {
            &[Key::Nodes, Key::Weights, Key::Quadrature, Key::B]
        } else {
            &[
                Key::Nodes,
                Key::Quadrature,
                Key::A,
                Key::Kick,
                Key::Base,
                Key::Compose,
            ]
        };
        let part = keys.iter().find_map(|&key| Some((key, self.get(key)?)));
        match part {
            None => kind.into(),
            Some((key, text)) => Error::at(
                kind,
                Place {
                    input: key.name().to_owned(),
                    text: text.to_owned(),
                    span: trimmed(text, 0..text.len()),
                },
            ),
        }
    }
}

/// Derives the tableau of a basis `ψ_1, …, ψ_s` at the nodes `c_1, …, c_s` of a rule.
///
/// # Errors
/// [`ErrorKind::NotSquare`], [`ErrorKind::SingularBasis`], [`ErrorKind::ZeroWeight`].
pub fn derive_from(basis: &Basis, rule: &QuadratureRule) -> Result<Tableau, ErrorKind> {
    let problem = Problem {
        construction: Construction::Collocation {
            basis: basis.clone(),
            nodes: Nodes::Rule(rule.clone()),
        },
        exchange: false,
        adjoint: false,
    };
    problem.derive()
}

/// The coefficients of a definition that is a sequence of drifts and kicks; `None` for any other definition.
///
/// # Errors
/// The errors of [`Definition::derive`], without places.
pub(crate) fn splitting(definition: &Definition) -> Result<Option<Exact>, ErrorKind> {
    let sequence = read_again(definition)?.sequence();
    sequence.map(|sequence| sequence.exact()).transpose()
}

/// Reads again a definition that has been derived before.
fn read_again(definition: &Definition) -> Result<Problem, ErrorKind> {
    let unlimited = Limits { stages: usize::MAX };
    Problem::read(definition, &unlimited).map_err(|errors| *first(errors).kind)
}

/// The first of some errors.
fn first(mut errors: Vec<Error>) -> Error {
    if errors.is_empty() {
        let message = "this definition cannot be derived".to_owned();
        return ErrorKind::Definition { message }.into();
    }
    errors.swap_remove(0)
}

#[cfg(test)]
mod tests;
