//! From a definition to its tableau.

use super::Tableau;
use crate::basis::Basis;
use crate::catalogue::Entry;
use crate::definition::{Definition, Key, trimmed};
use crate::derive::Problem;
use crate::error::{Error, ErrorKind, Place};
use crate::limits::Limits;
use crate::quadrature::{Nodes, QuadratureRule};

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
        Tableau::derived(problem).map_err(|kind| vec![self.place(kind)])
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

impl Entry {
    /// Derives the tableau, with its name and source.
    ///
    /// # Errors
    /// None for the methods that are in the catalogue now.
    ///
    /// ```
    /// use symplectic_compiler::catalogue;
    ///
    /// let verlet = catalogue::find("stormer-verlet").expect("a known method").derive()?;
    /// assert!(verlet.properties().explicit.holds);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn derive(&self) -> Result<Tableau, Error> {
        self.derive_within(&self.limits())
    }

    /// As [`Entry::derive`], within given limits.
    ///
    /// # Errors
    /// [`ErrorKind::TooManyStages`].
    pub fn derive_within(&self, limits: &Limits) -> Result<Tableau, Error> {
        let tableau = Definition::parse(&self.definition)?.derive(limits)?;
        Ok(tableau.named(&self.name).with_source(&self.source))
    }
}

/// Derives the tableau of a basis `ψ_1, …, ψ_s` at the nodes `c_1, …, c_s` of a rule.
///
/// # Errors
/// [`ErrorKind::NotSquare`], [`ErrorKind::SingularBasis`], [`ErrorKind::ZeroWeight`].
pub fn derive_from(basis: &Basis, rule: &QuadratureRule) -> Result<Tableau, ErrorKind> {
    let nodes = Nodes::Rule(rule.clone());
    Tableau::derived(Problem::collocation(basis.clone(), nodes))
}

/// The first of some errors.
pub(super) fn first(mut errors: Vec<Error>) -> Error {
    if errors.is_empty() {
        let message = "this definition cannot be derived".to_owned();
        return ErrorKind::Definition { message }.into();
    }
    errors.swap_remove(0)
}
