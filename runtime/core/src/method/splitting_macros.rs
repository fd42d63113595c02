//! The macros for explicit methods of separable systems.

/// Proves and emits a splitting: kicks and drifts one after another, explicit for `H = T(p) + U(q)`.
///
/// With lists of `n` exact numbers a step of `h` does, for `i = 1, …, n`,
///
/// ```text
/// kick    p −= kick_i h ∂U/∂q(q)
/// drift   q += drift_i h ∂T/∂p(p)
/// ```
///
/// ```
/// symplectic::splitting! {
///     /// Ruth's method of order 3.
///     pub Ruth { kick: [7/24, 3/4, -1/24], drift: [2/3, -2/3, 1], require: [order(separable) == 3] }
///
///     /// Forest & Ruth, order 4: half of a palindrome.
///     pub ForestRuth {
///         kick: [1/(4 - 2*cbrt(2)), (1 - cbrt(2))/(4 - 2*cbrt(2))],
///         drift: [1/(2 - cbrt(2)), -cbrt(2)/(2 - cbrt(2))],
///         symmetric: true,
///         require: [symplectic(separable), symmetric(separable), explicit, order(separable) == 4],
///     }
/// }
///
/// use symplectic::Method;
/// assert_eq!(Ruth::B_TILDE, [7.0 / 24.0, 0.75, -1.0 / 24.0]);
/// assert_eq!(ForestRuth::STAGES, 4);
/// ```
///
/// | key | value |
/// |---|---|
/// | `kick`, `drift` | two lists of the same length, each with sum 1; 0 omits the kick or drift |
/// | `first` | `drift` if each drift comes before the kick of the same number; default `kick` |
/// | `claim` | `separable(6)`, `nystrom(6)` or `perturbed(8, 6, 4)`: the lists are printed digits, and the method is the exact one of that order, proved to lie near them |
/// | `symmetric` | `true` if the lists are the first half of a palindrome: the last entry is the middle and occurs once. The flow that comes first may have one entry more than the other; its last entry is then the middle |
/// | `processor` | `[kick: [1/2], drift: [0]]`: a processor P, whose drifts sum to 0. The method is `P ∘ K ∘ P⁻¹` with the splitting as the kernel K: see [`ProcessedIntegrator`](crate::ProcessedIntegrator). Without a `claim` |
/// | `exchange`, `adjoint`, `require`, `accept`, `max_stages` | as in [`tableau!`](crate::tableau) |
///
/// Drifts with no kick between them are merged into one, and likewise kicks. A 0 at either end is dropped. The method is the partitioned
/// Runge–Kutta method
///
/// ```text
/// a_ij = drift_j for j < i     ã_ij = kick_j for j ≤ i     b = drift     b̃ = kick
/// ```
///
/// (Marsden & West 2001, §2.6.4), so everything that is proved of a tableau is proved of it. It is symplectic for separable Hamiltonians,
/// `require: [symplectic(separable)]`. On a [`General`](crate::General) system it is not symplectic and has a lower order: it compiles
/// there only with [`accept_lower_order`](crate::Method::accept_lower_order).
///
/// A step of a [`Separable`](crate::Separable) system is straight-line code. If the step begins and ends with a kick, the force at its end
/// is also used at the start of the next step.
///
/// # Errors
///
/// As with [`tableau!`](crate::tableau); also if the lists differ in length or do not sum to 1.
///
/// ```compile_fail
/// symplectic::splitting! {
///     // error: the kicks sum to 11/12, but must sum to 1; …
///     Typo { kick: [7/24, 3/4, -1/8], drift: [2/3, -2/3, 1] }
/// }
/// ```
pub use symplectic_macros::splitting;

/// Proves and emits a composition: steps of other methods one after another.
///
/// ```
/// symplectic::composition! {
///     /// The triple jump: order 4 from three steps of Störmer–Verlet.
///     pub Yoshida4 { base: StoermerVerlet, weights: triple_jump(4), require: [symplectic, symmetric, order == 4] }
///
///     /// McLachlan's five steps, the first half of them written.
///     pub Mclachlan5 {
///         base: StoermerVerlet,
///         weights: [
///             7/25,
///             root(93750*t^3 - 82500*t^2 + 18150*t - 2017, 1),
///             11/25 - 2*root(93750*t^3 - 82500*t^2 + 18150*t - 2017, 1),
///         ],
///         symmetric: true,
///         require: [order == 4],
///     }
///
///     /// Symplectic Euler and its adjoint: Störmer–Verlet.
///     pub Verlet { base: symplectic-euler, weights: [1/2, adjoint(1/2)], require: [symmetric, order == 2] }
///
///     /// Kahan & Li's nine steps, as they are printed.
///     pub KahanLi6 {
///         base: velocity-verlet,
///         weights: [
///             0.39216144400731413928,
///             0.33259913678935943860,
///             -0.70624617255763935981,
///             0.082213596293550800230,
///             0.79854399093482996340,
///         ],
///         symmetric: true,
///         claim: separable(6),
///         require: [order(separable) == 6],
///     }
///
///     /// A step of midpoint between two of Gauss.
///     pub Mixed { compose: [[1/4, base: gauss-2], [1/2, base: midpoint], [1/4, base: gauss-2]], require: [symmetric] }
/// }
/// ```
///
/// | key | value |
/// |---|---|
/// | `base` | a method of the catalogue (`symplectic list`; `StoermerVerlet` and `stormer-verlet` are the same name), or a definition in brackets: `[kick: [1/2, 1/2], drift: [1, 0]]` |
/// | `weights` | the fractions `γ_i` of the step, with sum 1; `adjoint(1/2)` for a step of the adjoint. Or `triple_jump(p)`, `suzuki(p)` for an even order `p` up to 10 from a symmetric base |
/// | `symmetric` | `true` if the weights are the first half of a palindrome: the last one is the middle and occurs once. The base has to be symmetric |
/// | `claim` | `separable(8)`: the weights are printed digits, and the method has the exact weights near them, which are proved to exist. With these every symmetric base of order 2 gives that order. The base is a splitting |
/// | `processor` | fractions of steps of the base that sum to 0, the first step first, or `back_and_forth(1/3, -1/3)` for the steps −1/3, 1/3, 1/3, −1/3: a processor P. The method is `P ∘ K ∘ P⁻¹` with the composition as the kernel K: see [`ProcessedIntegrator`](crate::ProcessedIntegrator). A `claim` is about the order of all three |
/// | `compose` | instead of these: steps of several methods, `[[γ_1, definition], …]` |
/// | `exchange`, `adjoint`, `require`, `accept`, `max_stages` | as in [`tableau!`](crate::tableau) |
///
/// The triple jump raises the order of a symmetric method from `p` to `p + 2` by `γ_1 = γ_3 = 1/(2 − 2^{1/(p+1)})`, `γ_2 = 1 − 2γ_1`,
/// Suzuki's fractal by `γ_1 = γ_2 = γ_4 = γ_5 = 1/(4 − 4^{1/(p+1)})`, `γ_3 = 1 − 4γ_1`. This is repeated up to the required order (Hairer,
/// Lubich & Wanner, *Geometric numerical integration*, §II.4). The weights are exact. Up to order 6 they lie in a number field, in which
/// everything is proved. From order 8 on the theorem on symmetric compositions proves the order.
///
/// A composition of splittings is a splitting, in which neighbouring drifts and kicks are merged. Any other composition has the stages of
/// all its steps; it is symplectic for all Hamiltonians if its methods are. If it has implicit stages, its steps are taken one by one, each
/// from the result of the previous one: see [`Composition`](crate::emitted::Composition).
///
/// # Errors
///
/// As with [`tableau!`](crate::tableau). Also for an unknown base (the message lists similar names), for weights whose sum is not 1, and if
/// a base is not symmetric but must be.
///
/// ```compile_fail
/// symplectic::composition! {
///     // error: `triple_jump` needs a base method that is symmetric, and ruth-1983 is not: …
///     Wrong { base: ruth-1983, weights: triple_jump(4) }
/// }
/// ```
pub use symplectic_macros::composition;
