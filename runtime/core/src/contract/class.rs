//! The classes of Hamiltonians for which a method has a plan.

use crate::contract::{Method, Plan, Solver, System};
use crate::error::Error;
use crate::number::Vector;

/// What the derivatives of a [`Hamiltonian`](crate::Hamiltonian) depend on: [`General`] or [`Separable`]. Other packages add classes: with
/// linear friction `friction::Damped`, with constraints `constraints::Constrained` and `constraints::Nonholonomic`.
///
/// It selects the [`Plan`] of a [`Method`] at compile time. The packages of this workspace implement it; it is no promise to others.
pub trait Class: Clone + 'static {
    /// The plan of the method `M` for systems of this class.
    type Plan<M: Method>: Plan<Class = Self>;
    /// What systems of this class give in addition to velocity and force: a reference to their constraints or to their friction, or `()`.
    type Extra<'a, V: Vector>: Copy;
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

    /// Shows the numbers at a position that identify the [`Extra`](Self::Extra) of a system in a checkpoint.
    #[doc(hidden)]
    fn numbers<V: Vector, S: System<V, Class = Self>>(
        _system: &S,
        _q: &V,
        _show: &mut dyn FnMut(V::Scalar),
    ) {
    }

    /// The error of a step, with details from the [`Extra`](Self::Extra) of the system.
    #[doc(hidden)]
    fn explain<V: Vector, S: System<V, Class = Self>>(_system: &S, error: Error) -> Error {
        error
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

/// A class without non-holonomic constraints: an [`Unconstrained`] class, or `Constrained`.
#[diagnostic::on_unimplemented(
    message = "this method has no steps for systems of class `{Self}`",
    label = "no steps for this class",
    note = "class `Damped`, with friction, needs a splitting, such as `velocity-verlet` or `forest-ruth-1990`; for any other method make the friction part of the force: `force: {{ x = -gamma px }}` in a formula",
    note = "class `Nonholonomic` needs a method that is `nonholonomic`: `basis: polynomial(1), nodes: gauss(1)`, or a composition of it",
    note = "a method of higher order would lose it: only compositions of symmetric steps keep theirs"
)]
pub trait Holonomic {}

/// A class without holonomic constraints: an [`Unconstrained`] class, or `Nonholonomic`.
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

/// A class without friction: any but `Damped`. Tableaux at run time are for these classes.
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

macro_rules! or_damped {
    ($($class:ident or $with:ident, without $without:literal, $needs:literal;)*) => {$(
        #[doc = concat!("A class that is [`", stringify!($class), "`], or `Damped`: the classes of a splitting that has no steps with ", $without, ".")]
        #[diagnostic::on_unimplemented(
            message = "this method has no steps for systems of class `{Self}`",
            label = "no steps for these constraints",
            note = $needs
        )]
        pub trait $with {}
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

/// Any class but [`General`]: for splittings of more than 36 stages, which have no plan for it. Steps with constraints do not use that plan.
#[diagnostic::on_unimplemented(
    message = "a splitting of more than 36 stages has no steps for systems of class `{Self}`",
    label = "steps separable Hamiltonians only",
    note = "implement the system as a separable one, or take a method for general Hamiltonians"
)]
pub trait NotGeneral {}

impl NotGeneral for Separable {}

impl NotGeneral for () {}

/// [`Separable`], or `Damped`: the classes of a splitting that keeps its order on separable Hamiltonians only.
pub trait SeparableOrDamped {}

impl SeparableOrDamped for Separable {}

impl SeparableOrDamped for () {}

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

impl Class for General {
    type Plan<M: Method> = M::General;
    type Extra<'a, V: Vector> = ();
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
    type Extra<'a, V: Vector> = ();
    const SEPARABLE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn memory<M: Method, V: Vector, S: System<V>, N: Solver<V, S>>(
        method: &M,
        prototype: &V,
    ) -> <M::Separable as Plan>::Memory<V, S, N> {
        method.separable_memory::<V, S, N>(prototype)
    }
}
