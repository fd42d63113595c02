//! The classes of Hamiltonians for which a method has a plan.

#[cfg(feature = "alloc")]
use core::marker::PhantomData;

use crate::contract::{Method, Plan, Solver, System};
use crate::error::Error;
use crate::number::Vector;

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::General {}
    impl Sealed for super::Separable {}
    impl Sealed for super::Damped {}
    #[cfg(feature = "alloc")]
    impl<C> Sealed for super::Constrained<C> {}
    #[cfg(feature = "alloc")]
    impl<C> Sealed for super::Nonholonomic<C> {}
}

/// What the derivatives of a [`Hamiltonian`](crate::Hamiltonian) depend on: [`General`] or [`Separable`]; with linear
/// friction [`Damped`], with holonomic constraints [`Constrained`], with non-holonomic ones [`Nonholonomic`].
///
/// It selects the [`Plan`] of a [`Method`] at compile time. Sealed.
pub trait Class: sealed::Sealed + Clone + 'static {
    /// The plan of the method `M` for systems of this class.
    type Plan<M: Method>: Plan<Class = Self>;
    /// Whether the velocity depends on the momentum only, and the force on the position only.
    const SEPARABLE: bool;
    /// Whether there is friction that is not part of the force.
    #[doc(hidden)]
    const FRICTION: bool = false;
    /// Whether there are constraints.
    #[doc(hidden)]
    const CONSTRAINED: bool = false;

    /// The memory of the steps of a method.
    #[doc(hidden)]
    fn memory<M: Method, V: Vector, S: System<V>, N: Solver<V, S>>(
        method: &M,
        prototype: &V,
    ) -> <Self::Plan<M> as Plan>::Memory<V, S, N>;

    /// Checks that a method whose coefficients are known only at run time has steps for systems of this class.
    ///
    /// # Errors
    ///
    /// [`Error::NoConstrainedSteps`](crate::Error::NoConstrainedSteps)
    #[doc(hidden)]
    fn check_steps<M: Method>(_method: &M) -> Result<(), Error> {
        Ok(())
    }
}

/// A class without constraints and friction: [`General`] or [`Separable`].
///
/// A method that is proved for general Hamiltonians is proved for both. Generic code that uses such a method needs the bound
/// `S::Class: Unconstrained`.
#[diagnostic::on_unimplemented(
    message = "this method has no steps for systems of class `{Self}`",
    label = "no steps for this class",
    note = "class `Damped`, with friction, needs a splitting, such as `velocity-verlet` or `forest-ruth-1990`; for any other method make the friction part of the force: `force: {{ x = -gamma px }}` in a formula, `type Class = General` in a system of your own",
    note = "class `Constrained`, with holonomic constraints, needs a method that is `constrained`: `basis: polynomial(s), nodes: lobatto(s)`, which with two stages is RATTLE, or a composition of these methods",
    note = "class `Nonholonomic` needs a method that is `nonholonomic`: `basis: polynomial(1), nodes: gauss(1)`, or a composition of it",
    note = "`require: [constrained]` or `require: [nonholonomic]` in `tableau!` checks that a method has constrained or non-holonomic steps",
    note = "with a method for systems without constraints and friction, generic code needs the bound `S::Class: Unconstrained`"
)]
pub trait Unconstrained {}

impl Unconstrained for General {}

impl Unconstrained for Separable {}

impl Unconstrained for () {}

/// A class without non-holonomic constraints: an [`Unconstrained`] class, or [`Constrained`].
#[diagnostic::on_unimplemented(
    message = "this method has no steps for systems of class `{Self}`",
    label = "no steps for this class",
    note = "class `Damped`, with friction, needs a splitting, such as `velocity-verlet` or `forest-ruth-1990`; for any other method make the friction part of the force: `force: {{ x = -gamma px }}` in a formula",
    note = "class `Nonholonomic` needs a method that is `nonholonomic`: `basis: polynomial(1), nodes: gauss(1)`, or a composition of it",
    note = "a method of higher order would lose it: only compositions of symmetric steps keep theirs"
)]
pub trait Holonomic {}

/// A class without holonomic constraints: an [`Unconstrained`] class, or [`Nonholonomic`].
#[diagnostic::on_unimplemented(
    message = "this method has no steps for systems of class `{Self}`",
    label = "no steps for this class",
    note = "class `Damped`, with friction, needs a splitting, such as `velocity-verlet` or `forest-ruth-1990`; for any other method make the friction part of the force: `force: {{ x = -gamma px }}` in a formula",
    note = "class `Constrained` needs a method that is `constrained`: `basis: polynomial(s), nodes: lobatto(s)`, which with two stages is RATTLE, or a composition of these methods"
)]
pub trait FreePositions {}

/// A class whose velocity depends on the momentum only, and whose force, without friction, depends on the position only:
/// [`Class::SEPARABLE`].
#[diagnostic::on_unimplemented(
    message = "systems of class `{Self}` are not separable",
    label = "not separable",
    note = "this method is symmetric for H = T(p) + U(q) only: for a general H take `basis: polynomial(s)` with `nodes: gauss(s)` or `lobatto(s)`"
)]
pub trait SplitClass {}

impl SplitClass for Separable {}

impl SplitClass for Damped {}

#[cfg(feature = "alloc")]
impl<C: SplitClass> SplitClass for Constrained<C> {}

#[cfg(feature = "alloc")]
impl<C: SplitClass> SplitClass for Nonholonomic<C> {}

/// A class without friction: any but [`Damped`]. Tableaux at run time are for these classes.
#[diagnostic::on_unimplemented(
    message = "this method has no steps for systems of class `{Self}`",
    label = "no steps with friction",
    note = "class `Damped`, with friction, needs a splitting, such as `velocity-verlet` or `forest-ruth-1990`; for any other method make the friction part of the force: `force: {{ x = -gamma px }}` in a formula, `type Class = General` in a system of your own"
)]
pub trait Frictionless {}

macro_rules! implement {
    ($($class:ident: $($with:ident),*;)*) => {$($(
        impl<C: $class> $with for C {}
    )*)*};
}

implement! {
    Unconstrained: Holonomic, FreePositions, UnconstrainedOrDamped;
    Holonomic: HolonomicOrDamped;
    FreePositions: FreePositionsOrDamped;
}

// Without it the message would be that of methods without steps for constraints.
#[diagnostic::do_not_recommend]
impl<C: Unconstrained> Frictionless for C {}

#[cfg(feature = "alloc")]
impl<C> Holonomic for Constrained<C> {}

#[cfg(feature = "alloc")]
impl<C> FreePositions for Nonholonomic<C> {}

#[cfg(feature = "alloc")]
impl<C> Frictionless for Constrained<C> {}

#[cfg(feature = "alloc")]
impl<C> Frictionless for Nonholonomic<C> {}

macro_rules! or_damped {
    ($($class:ident or $with:ident, without $without:literal, $needs:literal;)*) => {$(
        #[doc = concat!("A class that is [`", stringify!($class), "`], or [`Damped`]: the classes of a splitting that has no steps with ", $without, ".")]
        #[diagnostic::on_unimplemented(
            message = "this method has no steps for systems of class `{Self}`",
            label = "no steps for these constraints",
            note = $needs
        )]
        pub trait $with {}

        impl $with for Damped {}
    )*};
}

or_damped! {
    Unconstrained or UnconstrainedOrDamped, without "constraints",
    "class `Constrained` needs a method that is `constrained`, such as `basis: polynomial(2), nodes: lobatto(2)`; class `Nonholonomic` one that is `nonholonomic`, such as `basis: polynomial(1), nodes: gauss(1)`";
    Holonomic or HolonomicOrDamped, without "non-holonomic constraints",
    "class `Nonholonomic` needs a method that is `nonholonomic`: `basis: polynomial(1), nodes: gauss(1)`, or a composition of it";
    FreePositions or FreePositionsOrDamped, without "holonomic constraints",
    "class `Constrained` needs a method that is `constrained`: `basis: polynomial(s), nodes: lobatto(s)`, or a composition of these methods";
}

/// A class without friction and constraints: [`General`] or [`Separable`]. Generating functions and tangent systems are for these
/// classes.
///
/// With friction a step is not symplectic; with constraints it is symplectic on the constrained phase space only.
#[diagnostic::on_unimplemented(
    message = "systems of class `{Self}` have friction or constraints, and this is for systems without",
    label = "not with friction or constraints",
    note = "a step with friction or constraints has no generating function",
    note = "friction as part of a force makes the class `General`: in a formula `force: {{ x = -gamma px }}`",
    note = "generic code needs the bound `S::Class: Conservative`"
)]
pub trait Conservative: Unconstrained {}

impl Conservative for General {}

impl Conservative for Separable {}

/// Both velocity and force may depend on position and momentum.
#[derive(Clone, Copy, Debug)]
pub struct General;

/// `H = T(t, p) + U(t, q)`: the velocity depends on the momentum only, the force on the position only.
#[derive(Clone, Copy, Debug)]
pub struct Separable;

/// A separable Hamiltonian with linear friction: `p' = −∂H/∂q − γp`, with a rate γ for each component, given by
/// [`Hamiltonian::friction`](crate::Hamiltonian::friction). More generally, the friction may be any force of positions and momenta whose
/// flow at a fixed position is known, given by [`Hamiltonian::kick`](crate::Hamiltonian::kick).
///
/// Splittings whose order is proved for separable Hamiltonians step such systems, with the exact flow of the friction in
/// every kick. The order is preserved. If all γ are equal, a step of size h shrinks dq∧dp and the momentum maps of symmetries of H by
/// `e^{−γh}` exactly. Negative kicks grow by `e^{γ|τ|}`, see [`friction_growth`](crate::friction_growth): for stiff friction choose a
/// method whose kicks are positive. For any other method [`Integrator::new`](crate::Integrator#method.new) does not compile; there any
/// friction can be part of [`Hamiltonian::force`](crate::Hamiltonian::force) of a system of class [`General`].
///
/// ```compile_fail,E0277
/// use symplectic::{Integrator, State};
///
/// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
/// symplectic::hamiltonian! { Pendulum { gamma } q: [a], p: [pa]; H = pa^2/2 - cos(a) friction: gamma }
///
/// let start = State::from_arrays(0.0, [1.0], [0.0]);
/// let integrator = Integrator::new(Gauss2, Pendulum::new(0.1), start, 0.1);
/// # assert!(integrator.is_ok());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Damped;

impl Class for General {
    type Plan<M: Method> = M::General;
    const SEPARABLE: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn memory<M: Method, V: Vector, S: System<V>, N: Solver<V, S>>(
        method: &M,
        prototype: &V,
    ) -> <M::General as Plan>::Memory<V, S, N> {
        method.general_memory::<V, S, N>(prototype)
    }
}

impl Class for Separable {
    type Plan<M: Method> = M::Separable;
    const SEPARABLE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn memory<M: Method, V: Vector, S: System<V>, N: Solver<V, S>>(
        method: &M,
        prototype: &V,
    ) -> <M::Separable as Plan>::Memory<V, S, N> {
        method.separable_memory::<V, S, N>(prototype)
    }
}

/// `H` of class `C`, [`Separable`] or [`General`], with holonomic constraints `φ(q) = 0`:
///
/// ```text
/// q' = ∂H/∂p      p' = −∂H/∂q − Gᵀλ      φ(q) = 0      G = ∂φ/∂q
/// ```
///
/// The constraints are in [`Hamiltonian::constraint_values`](crate::Hamiltonian::constraint_values). Methods that are `constrained` step
/// such systems. They are Lobatto IIIA–IIIB (with two stages RATTLE), other pairs with stages at both ends, symplectic Euler and its
/// adjoint, and compositions. For any other method [`Integrator::new`](crate::Integrator#method.new) does not compile.
///
/// `Constrained<Damped>` is not a class: friction is part of the force of a system of class `Constrained<General>`.
///
/// ```compile_fail,E0277
/// use symplectic::{Class, Constrained, Damped};
///
/// const SEPARABLE: bool = <Constrained<Damped> as Class>::SEPARABLE;
/// assert!(SEPARABLE);
/// ```
#[cfg(feature = "alloc")]
#[derive(Clone, Copy, Debug)]
pub struct Constrained<C>(PhantomData<C>);

/// `H` of class `C`, [`Separable`] or [`General`], with non-holonomic constraints `w(q)·q' = 0`, linear in the velocities:
///
/// ```text
/// q' = ∂H/∂p      p' = −∂H/∂q − wᵀλ      w(q) ∂H/∂p = 0
/// ```
///
/// The rows of the m×n matrix `w` are in [`Hamiltonian::nonholonomic_rows`](crate::Hamiltonian::nonholonomic_rows). Methods that are
/// `nonholonomic` step such systems by the discrete Lagrange–d'Alembert–Pontryagin principle (Leok & Ohsawa, arXiv:0810.0740). These are
/// symmetric methods of order 2, compositions of one of them, and methods of order 1. Examples of the first are the implicit midpoint rule
/// and Lobatto IIIA–IIIB with two stages. A method of any other order would lose its order, and
/// [`Integrator::new`](crate::Integrator#method.new) does not compile:
///
/// ```compile_fail,E0277
/// use symplectic::nalgebra::Vector2;
/// use symplectic::{Error, Integrator, Nonholonomic, Separable, State, System};
///
/// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
///
/// fn run<S: System<Vector2<f64>, Class = Nonholonomic<Separable>>>(system: S, start: State<Vector2<f64>>) -> Result<(), Error> {
///     Integrator::new(Gauss2, system, start, 0.1)?;
///     Ok(())
/// }
/// ```
///
/// With `basis: polynomial(1), nodes: gauss(1)` it compiles:
///
/// ```
/// use symplectic::nalgebra::Vector2;
/// use symplectic::{Error, Integrator, Nonholonomic, Separable, State, System};
///
/// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
///
/// fn run<S: System<Vector2<f64>, Class = Nonholonomic<Separable>>>(system: S, start: State<Vector2<f64>>) -> Result<(), Error> {
///     Integrator::new(Midpoint, system, start, 0.1)?;
///     Ok(())
/// }
/// ```
///
/// `Nonholonomic<Damped>` is not a class: friction is part of the force of a system of class `Nonholonomic<General>`.
#[cfg(feature = "alloc")]
#[derive(Clone, Copy, Debug)]
pub struct Nonholonomic<C>(PhantomData<C>);
