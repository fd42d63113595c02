//! Errors of formulas, beyond those of any expression.

/// The errors of formulas.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FormulaError {
    /// A name with two meanings.
    #[error("`{name}` is {meaning} already; choose another name")]
    Taken {
        /// The name.
        name: String,
        /// Its meaning.
        meaning: String,
    },
    /// A required part of the definition is missing.
    #[error("the system has no {part}: write `{example}`")]
    Missing {
        /// What is missing.
        part: &'static str,
        /// An example of how it is written.
        example: &'static str,
    },
    /// A part is given twice.
    #[error("{part} is given twice")]
    Twice {
        /// The part.
        part: String,
    },
    /// A part that belongs to the other form: H in a Lagrangian, or L in a Hamiltonian.
    #[error(
        "`{found}` does not belong here: write `{coordinates}` and `{function} = …`, or take `{other}`"
    )]
    OtherForm {
        /// What was written.
        found: String,
        /// The letter of the function.
        function: &'static str,
        /// How coordinates are declared.
        coordinates: &'static str,
        /// The macro for what was written.
        other: &'static str,
    },
    /// A momentum in a Lagrangian.
    #[error(
        "`{name}` is a momentum: L is a function of positions and velocities, and p = ∂L/∂v follows from it"
    )]
    MomentumInLagrangian {
        /// The name.
        name: String,
    },
    /// A momentum in a force of a Lagrangian.
    #[error(
        "`{name}` is a momentum: a Lagrangian has velocities and no momenta; write this force with `{velocity}`, where {name} = ∂L/∂{velocity}"
    )]
    MomentumInForce {
        /// The name.
        name: String,
        /// The name of its velocity.
        velocity: String,
    },
    /// A Lagrangian that is not quadratic in the velocities.
    #[error(
        "this term is not quadratic in the velocities, so there is no formula of H for `{what}`: take L = v·M v/2 + A·v − U, with functions M, A \
         and U of q and t, or leave `{what}` out"
    )]
    NotQuadratic {
        /// The part of the definition that needs H.
        what: &'static str,
    },
    /// A mass matrix without an inverse.
    #[error(
        "{reason}: {constraint} is a primary constraint; write a Lagrangian with a regular mass matrix, \
         or implement `Lagrangian` by hand and take `symplectic::variational::DiracIntegrator`"
    )]
    Singular {
        /// The reason why it is singular.
        reason: String,
        /// The resulting relation of positions and momenta.
        constraint: String,
    },
    /// A coordinate on which H does not depend.
    #[error("H does not depend on {coordinate}")]
    Unused {
        /// The coordinate or momentum.
        coordinate: String,
    },
    /// A function with jumps.
    #[error(
        "`{function}` has jumps: a formula must be continuously differentiable; use a smooth function, or `x |x|` for `sign(x) x^2`"
    )]
    Jumps {
        /// The function.
        function: String,
    },
    /// A formula with too few continuous derivatives.
    #[error(
        "{formula} must be {times}continuously differentiable, and is not at the kink of `{function}`: {instead}"
    )]
    Kink {
        /// The function with a kink.
        function: String,
        /// The formula in which it is.
        formula: &'static str,
        /// The number of derivatives, with a space, or nothing.
        times: &'static str,
        /// The remedy.
        instead: &'static str,
    },
    /// A constant that is infinite or NaN in double precision.
    #[error("`{value}` has no finite value in double precision; write a constant that has one")]
    NotFinite {
        /// The constant.
        value: String,
    },
    /// An ambiguous quotient followed by a product.
    #[error("is it `a / (b c)` or `(a / b) c`? Write the parentheses")]
    AmbiguousQuotient,
    /// An index out of range.
    #[error("the index {index} of `{name}` is not between 0 and {last}")]
    IndexRange {
        /// The index.
        index: String,
        /// The array.
        name: String,
        /// The largest index.
        last: String,
    },
    /// A sum without a known range.
    #[error(
        "the range of the sum is not known: write `sum({index} in 0..n: …)` with a number or a length of the system for n"
    )]
    Unbounded {
        /// The index.
        index: String,
    },
    /// A required property that does not hold.
    #[error("the system is not {property}: {reason}")]
    Property {
        /// The property.
        property: &'static str,
        /// Why it does not hold.
        reason: String,
    },
    /// A supposed invariant that changes along solutions.
    #[error("`{name}` is not conserved: {{{name}, {of}}} is {bracket} at a random state, not 0")]
    NotConserved {
        /// The name of the invariant.
        name: String,
        /// H, or the squares of the constraints.
        of: &'static str,
        /// The Poisson bracket.
        bracket: String,
    },
    /// Friction that must be a force.
    #[error("friction {with} is not supported here: write it as a force: `{force}`")]
    FrictionAsForce {
        /// What excludes friction.
        with: &'static str,
        /// The force, in the names of the system.
        force: String,
    },
    /// A feature that this kind of system does not support.
    #[error("{what} is not supported here: {instead}")]
    Unsupported {
        /// What was written.
        what: String,
        /// The alternative.
        instead: &'static str,
    },
}
