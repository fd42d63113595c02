//! The macro that makes a method.

/// Derives a method from a basis and nodes, proves what is required of it, and emits it as a type.
///
/// ```
/// symplectic::tableau! {
///     /// Three-stage Lobatto IIIA–IIIB pair.
///     pub Lobatto3 { basis: polynomial(3), nodes: lobatto(3), require: [symplectic, symmetric] }
/// }
///
/// use symplectic::Method;
/// assert_eq!(Lobatto3::STAGES, 3);
/// assert_eq!(Lobatto3::A[1], [5.0 / 24.0, 1.0 / 3.0, -1.0 / 24.0]);
/// ```
///
/// Any number of definitions may stand in one macro. The type is `Copy`, has no fields and implements
/// [`Method`](crate::Method); its coefficients are constants, each the double nearest to the exact one:
/// `A`, `A_TILDE`, `B`, `B_TILDE`, `C`, `C_TILDE`; for other scalars than f64 there is
/// [`Method::COEFFICIENTS`](crate::Method::COEFFICIENTS), rounded from the exact ones again. Its page in the documentation shows the exact tableau
/// and what is proved about it.
///
/// | key | value |
/// |---|---|
/// | `basis` | `polynomial(s)`, or a list of `s` linearly independent polynomials in `t`: `[1, t, t^2 - 1/3]` |
/// | `nodes` | `gauss(s)`, `lobatto(s)`, `radau-left(s)`, `radau-right(s)`, `chebyshev(s)`, `clenshaw-curtis(s)`, `fejer(s)`, `newton-cotes(s)`, or a list of distinct rationals in `[0, 1]`: `[0, 1/3, 1]` |
/// | `file` | instead of both: a table file, relative to the crate: `"tableaux/gauss-4.toml"`; it is derived and proved anew, and an edit of it rebuilds the crate |
/// | `require` | properties that have to be proved: `symplectic`, `symmetric`, `consistent`, `equal_matrices`, `explicit`, `first_row_zero`, `stiffly_accurate`, `first_same_as_last`, `positive_weights` |
/// | `max_stages` | a bound on the number of stages other than 32 |
///
/// The coefficients are those of Leok & Zhang, *Discrete Hamiltonian variational integrators*, §4.4: with
/// `M = [ψ_i(c_j)]` and `B_i = ∫_0^1 ψ_i`, `b = M⁻¹B`, `a = A_ψ M⁻ᵀ` where `(A_ψ)_ij = ∫_0^{c_i} ψ_j`, and
/// `ã_ij = (b_i b_j − b_j a_ji)/b_i`.
///
/// # Errors
///
/// What cannot be derived or is not proved does not compile; the error stands at the offending tokens, and
/// all errors of all definitions are reported together.
///
/// ```compile_fail
/// symplectic::tableau! {
///     // error: the method is not `explicit`: these stages need one another: Q2 → P1 → Q2
///     Lobatto3 { basis: polynomial(3), nodes: lobatto(3), require: [explicit] }
/// }
/// ```
///
/// # Cost
///
/// The derivation runs while the crate compiles. Where it takes noticeable time in a debug build, optimise
/// its arithmetic in the crate's `Cargo.toml`: `[profile.dev.build-override] opt-level = 3`.
pub use symplectic_macros::tableau;
