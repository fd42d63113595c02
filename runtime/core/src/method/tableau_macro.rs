//! The macro that makes a method.

/// Derives a method from its definition, proves the required properties, and emits the method as a type.
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
/// One macro may contain any number of definitions. The type is `Copy`, has no fields and implements [`Method`](crate::Method). Its
/// coefficients are constants, each the double nearest to the exact one: `A`, `A_TILDE`, `B`, `B_TILDE`, `C`, `C_TILDE`. For scalars other
/// than f64 there is [`Method::COEFFICIENTS`](crate::Method::COEFFICIENTS), rounded separately from the exact coefficients. Its page in the
/// documentation shows the exact tableau and what is proved about it.
///
/// | key | value |
/// |---|---|
/// | `basis` | `polynomial(s)`, `legendre(s)`, or a list of `s` linearly independent functions of `t`: `[1, t, exp(-t/2)]`, `[1, cos(pi*t), sin(pi*t)]` |
/// | `parameters` | with `basis` and `nodes`: the name of a frequency in the basis, see [below](#fitted-to-a-frequency) |
/// | `nodes` | `gauss(s)`, `lobatto(s)`, `radau-left(s)`, `radau-right(s)`, `chebyshev(s)`, `clenshaw-curtis(s)`, `fejer(s)`, `newton-cotes(s)`, or a list of distinct numbers in `[0, 1]`: `[0, 1/3, 1]`, `[1/2 - sqrt(2)/4, 1/2 + sqrt(2)/4]`, with as many nodes as functions |
/// | `quadrature` | instead of `nodes`: the same with at least as many nodes as functions (rectangular Galerkin construction) |
/// | `weights` | of the quadrature, if not the interpolatory ones: `[1/6, 2/3, 1/6]` |
/// | `a`, `b` | instead of `basis`: given coefficients, `[[0, 0], [1/2, 1/2]]` and `[1/2, 1/2]` |
/// | `a_tilde`, `b_tilde` | with `a` and `b`: the coefficients for momenta, or `a_tilde: symplectic_partner`; default: those for positions |
/// | `kick`, `drift`, `first`, `symmetric`, `processor`, `claim` | instead of all these: a splitting, as in [`splitting!`](crate::splitting) |
/// | `base`, `weights`, `symmetric`, `processor`, `claim` | instead of all these: a method of the catalogue, or a composition of steps of it, as in [`composition!`](crate::composition) |
/// | `compose` | instead of all these: steps of other methods one after another, each with its fraction of the step and its definition: `[[1/2, basis: 1, nodes: 0], [1/2, basis: 1, nodes: 1]]` |
/// | `exchange` | `true` exchanges positions and momenta at the end |
/// | `adjoint` | `true` for the adjoint of the method |
/// | `file` | instead of all these: a TOML file with a definition or a whole tableau, relative to the crate: `"tableaux/gauss-4.toml"`; it is derived and proved again, and an edit of it rebuilds the crate |
/// | `require` | a list of the requirements below |
/// | `accept` | `verified(100 bits)`: a property verified to that many bits satisfies a requirement too; needed only for tableaux that no exact arithmetic can represent |
/// | `max_stages` | maximum number of stages; default 36 |
///
/// | requirement | meaning |
/// |---|---|
/// | `symplectic`, `symmetric`; `symplectic(separable)`, `symmetric(separable)` | for every Hamiltonian; for separable Hamiltonians |
/// | `order >= 4`, `order(separable) == 6`, `order(nystrom) >= 4` | the order for every Hamiltonian, for `T(p) + U(q)`, for `pᵀM⁻¹p/2 + U(q)` |
/// | `order(perturbed) >= (8, 4)` | the order in `ε`, `ε²`, … of a splitting for `H_A + εH_B`, with drifts for `H_A` and kicks for `εH_B` |
/// | `consistent` | `Σ b_i = Σ b̃_i = 1`: order at least 1 |
/// | `explicit` | for separable Hamiltonians the stages are computed one after another |
/// | `equal_matrices` | `ã = a` and `b̃ = b` |
/// | `positive_weights` | `b_i > 0` and `b̃_i > 0` |
/// | `first_row_zero`, `stiffly_accurate`, `first_same_as_last` | `Q_1 = q0`; `Q_s = q1`; both |
/// | `constrained`, `nonholonomic` | it steps systems with holonomic constraints; with non-holonomic constraints |
/// | `p_stable`, `stable_to(14/5)` | stable on the oscillator for every hω; for 0 < hω ≤ 14/5 |
///
/// The coefficients are those of Leok & Zhang, *Discrete Hamiltonian variational integrators*, §4.4, with `M = [ψ_i(c_j)]`,
/// `B_i = ∫_0^1 ψ_i` and `(A_ψ)_ij = ∫_0^{c_i} ψ_j`:
///
/// ```text
/// b = M⁻¹B      a = A_ψ M⁻ᵀ      ã_ij = (b_i b_j − b_j a_ji)/b_i
/// ```
///
/// The rectangular construction is that of Tang, *Two types of variational integrators*, §2.2.
///
/// # Fitted to a frequency
///
/// With `parameters: w` the functions of the basis may contain the frequency `w`, as in `[1, cos(w*t), sin(w*t)]`. The coefficients are then
/// functions of `ν = wh`. The macro emits a type with the field `w`. Its method `at(h)` returns the
/// [method](../at_run_time/struct.RunTimeTableau.html) for the step size `h`; this needs the feature `at-run-time`. `require` accepts
/// `symplectic`, `symmetric`, `consistent` and orders for `h → 0`, each for every frequency.
///
/// ```
/// symplectic::tableau! {
///     Fitted { parameters: w, basis: [cos(w*t), sin(w*t)], nodes: gauss(2), require: [symmetric, order == 4] }
/// }
///
/// # fn main() -> Result<(), symplectic::at_run_time::TableauError> {
/// let method = Fitted { w: 3.0 }.at(0.1)?;
/// assert_eq!(method.stages(), 2);
/// # Ok(())
/// # }
/// ```
///
/// # Errors
///
/// A definition that cannot be derived, or a requirement that is not proved, does not compile. The error points at the offending tokens,
/// and all errors of all definitions are reported together. A method that is not consistent compiles with a warning, unless `consistent` is
/// required.
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
/// The derivation runs while the crate compiles. If it takes noticeable time in a debug build, optimise its arithmetic in the crate's
/// `Cargo.toml`: `[profile.dev.build-override] opt-level = 3`.
pub use symplectic_macros::tableau;
