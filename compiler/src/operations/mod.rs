//! Adjoint methods and compositions (MW 2.5).
//!
//! What an operation gives has a definition that derives it again, in every tier: the definitions of the
//! operands and the operation, `compose: […]` or `adjoint: true`. Coefficients alone would not do, for those
//! at the roots of a polynomial of high degree, and those known as enclosures, have no exact form to write.

use std::sync::Arc;

use crate::derive::{Problem, Step, check_depth, concatenate};
use crate::error::ErrorKind;
use crate::symbolic::Constant;
use crate::tableau::Tableau;

impl Tableau {
    /// The adjoint method `Φ*_h = Φ_{−h}⁻¹`: `a*_ij = b_j − a_ij` and `b* = b`, and the same with tildes.
    ///
    /// The stages keep their labels, so the adjoint of the adjoint is the method itself. In the order of ascending `c*`
    /// they are reversed (GNI II.3, Theorem 3.3).
    ///
    /// ```
    /// let euler = symplectic_compiler::derive("1", "0")?;
    /// let adjoint = euler.adjoint();
    /// assert_eq!(adjoint.exact_forms().a[0][0].as_deref(), Some("1"));
    /// assert_eq!(adjoint.provenance().definition.to_string(), "basis: 1, nodes: 0, adjoint: true");
    /// assert_eq!(adjoint.adjoint(), euler);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    #[must_use]
    pub fn adjoint(&self) -> Self {
        const PREFIX: &str = "adjoint of ";
        let renamed = |name: &str| match name.strip_prefix(PREFIX) {
            Some(name) => name.to_owned(),
            None => format!("{PREFIX}{name}"),
        };
        let exact = Arc::new(self.exact.adjoint());
        let definition = self.provenance.definition.adjoint();
        let mut adjoint = Tableau::read(definition, exact);
        if let Some(problem) = self.known_problem() {
            adjoint = adjoint.with_problem(problem.adjoint());
        }
        // The inverse of a map of order p with −h for h is one too.
        adjoint.given.clone_from(&self.given);
        adjoint.name = self.name().map(renamed);
        adjoint
            .provenance
            .source
            .clone_from(&self.provenance.source);
        adjoint
    }

    /// The method `Φ_{γh}`, whose step is this method's step of `γh`: `γa_ij`, `γb_i`, and the same with
    /// tildes. It is consistent only as a part of a composition, unless `γ = 1`.
    ///
    /// Where `γ` is rational, the coefficients stay in the algebra that holds them.
    ///
    /// # Errors
    /// As [`Tableau::concatenate`].
    ///
    /// ```
    /// use symplectic_compiler::symbolic::Constant;
    ///
    /// let verlet = symplectic_compiler::derive("polynomial(2)", "lobatto(2)")?;
    /// let twice = verlet.scale(&Constant::whole(2))?;
    /// assert_eq!(twice.exact_forms().b[0].as_deref(), Some("1"));
    /// assert_eq!(twice.provenance().definition.to_string(), "compose: [[2, basis: polynomial(2), nodes: lobatto(2)]]");
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn scale(&self, step: &Constant) -> Result<Self, ErrorKind> {
        Tableau::concatenate(&[(step, self)])
    }

    /// The composition `Φ ∘ Ψ`: a step of this method `Ψ` and then one of `next`, `Φ`. Both have the whole step `h`, so
    /// together they are a step of `2h`.
    ///
    /// With the coefficients `a, b` of `Ψ` and `a', b'` of `Φ` it has the stages of both, in this order:
    ///
    /// ```text
    /// [[a, 0], [1 bᵀ, a']]      (b, b')
    /// ```
    ///
    /// and the same with tildes.
    ///
    /// # Errors
    /// As [`Tableau::concatenate`].
    ///
    /// ```
    /// let euler = symplectic_compiler::derive("1", "0")?;
    /// let twice = euler.compose(&euler.adjoint())?;
    /// assert_eq!(twice.to_f64().a, [[0.0, 0.0], [1.0, 1.0]]);
    /// assert!(twice.properties().symmetric.holds);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn compose(&self, next: &Tableau) -> Result<Self, ErrorKind> {
        let one = Constant::one();
        Tableau::concatenate(&[(&one, self), (&one, next)])
    }

    /// The composition `Φ^m_{γ_m h} ∘ … ∘ Φ^1_{γ_1 h}` of methods with fractions of the step; `Φ^1` acts
    /// first (MW 2.5; GNI II.4). It has the stages of all methods, in this order:
    ///
    /// ```text
    /// Q_i of method k = q0 + h Σ_{l<k} γ_l Σ_j bˡ_j ∂H/∂p(Q_j, P_j) + h γ_k Σ_j aᵏ_ij ∂H/∂p(Q_j, P_j)
    /// ```
    ///
    /// and likewise with tildes for `P_i`, with the sign of the forces. An empty list of methods is rejected: its step does
    /// nothing and has no stages.
    ///
    /// If all methods are splittings, so is the result. It merges neighbouring drifts and kicks, so it has fewer stages than
    /// the methods together.
    ///
    /// The coefficients are in the field that the nodes or coefficients of all methods and the `γ_k` generate, if it is
    /// a constant field, and otherwise certified enclosures. The result has no name and no source; its definition
    /// consists of the definitions of the methods, and derives it.
    ///
    /// # Errors
    /// [`ErrorKind::Definition`] if there are no methods; [`ErrorKind::ExpressionSize`] if a node or a coefficient
    /// exceeds the bounds of constants, or if compositions of compositions are too deep to be read as a definition.
    ///
    /// ```
    /// use symplectic_compiler::{Tableau, order::OrderOptions, symbolic::Constant};
    ///
    /// // The triple jump (GNI II.4.4).
    /// let verlet = symplectic_compiler::derive("polynomial(2)", "lobatto(2)")?;
    /// let root = Constant::whole(2).cbrt()?;
    /// let outer = Constant::whole(2).subtract(&root)?.inverse()?;
    /// let inner = root.multiply(&outer)?.negate()?;
    /// let jump = Tableau::concatenate(&[(&outer, &verlet), (&inner, &verlet), (&outer, &verlet)])?;
    /// assert_eq!(jump.order(&OrderOptions::default()).general.order, 4);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn concatenate(methods: &[(&Constant, &Tableau)]) -> Result<Self, ErrorKind> {
        let step = |&(fraction, method): &(&Constant, &Tableau)| {
            Ok::<_, ErrorKind>(Step {
                fraction: fraction.clone(),
                method: method.problem()?.clone(),
            })
        };
        let steps = methods.iter().map(step).collect::<Result<_, _>>()?;
        let problem = Problem::composition(steps);
        for (_, text) in problem.definition().parts() {
            check_depth(text)?;
        }
        let exact = match problem.sequence() {
            Some(sequence) => sequence.exact()?,
            None => {
                let parts = methods.iter();
                let parts = parts.map(|&(fraction, method)| (fraction, &*method.exact));
                concatenate(&parts.collect::<Vec<_>>())?
            }
        };
        Ok(Tableau::of(problem, Arc::new(exact)))
    }
}

#[cfg(test)]
mod tests;
