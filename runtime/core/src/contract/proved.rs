//! The classes of systems for which a method is proved to keep its order and symplecticity.

#[cfg(feature = "alloc")]
use alloc::string::String;

use crate::contract::{General, Method, Plan, Separable, Solver, System};
use crate::number::{Coefficients, Vector};

/// A method that keeps its order and its symplecticity on all systems of class `C`.
///
/// The macros implement it if the compiler proves two things for class `C`. The order is as high as on the narrower classes, and the step
/// is symplectic if it is on those. Every method implements it for [`Separable`](crate::Separable). A splitting is symplectic for separable
/// Hamiltonians only and does not implement it for [`General`](crate::General), so [`Integrator::new`](crate::Integrator#method.new) does
/// not compile for a general system. [`Method::accept_lower_order`] lifts this restriction.
///
/// Every method also implements it for `()`, which is not a class. If a method implemented it for one class only, rustc would infer that
/// class from the method and report an error in the system.
///
/// Code that is generic over the method and the system needs the bound `M: Method + ProvedFor<S::Class>`.
///
/// A method whose order holds for quadratic kinetic energy only (Runge–Kutta–Nyström) is checked when the integrator is created: see
/// [`Error::NotQuadraticKinetic`](crate::Error::NotQuadraticKinetic).
///
/// ```compile_fail
/// symplectic::tableau! { ForestRuth { base: forest-ruth-1990 } }
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{Integrator, State, hamiltonian};
///
/// // H = (q² + 1)(p² + 1)/2 is not T(p) + U(q).
/// let system = hamiltonian::<Vector1<f64>, _, _>(
///     |_, q, p, velocity| velocity[0] = p[0] * (q[0] * q[0] + 1.0),
///     |_, q, p, force| force[0] = -q[0] * (p[0] * p[0] + 1.0),
/// );
/// let start = State::from_arrays(0.0, [0.0], [1.0]);
/// let integrator = Integrator::new(ForestRuth, system, start, 0.1);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` loses its order or its symplecticity on systems of class `{C}`",
    label = "not proved for this class",
    note = "if H = T(p) + U(q), write the system with `separable(…)` or implement `SeparableHamiltonian`; a function that returns such a system needs the return type `impl System<V, Class = Separable>`",
    note = "otherwise take a method for general Hamiltonians, such as `basis: polynomial(s), nodes: gauss(s)` or `lobatto(s)`",
    note = "for holonomic constraints, class `Constrained`, take a method that is `constrained`: `basis: polynomial(s), nodes: lobatto(s)`, or a composition of these methods",
    note = "for non-holonomic constraints, class `Nonholonomic`, take a method that is `nonholonomic`: `basis: polynomial(1), nodes: gauss(1)`, or a composition of it",
    note = "for friction, class `Damped`, and for flows of two parts, take a splitting whose order holds for every separable Hamiltonian, such as `velocity-verlet` or `forest-ruth-1990`",
    note = "without constraints, to go on knowingly with a lower order, write `.accept_lower_order()` after the method"
)]
pub trait ProvedFor<C> {}

/// A method that consists of kicks and drifts on separable systems. The macros implement it.
///
/// Kicks and drifts can be replaced: by the flow of friction, or by flows of any two parts.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not consist of kicks and drifts",
    label = "not a splitting",
    note = "take a splitting, such as `velocity-verlet`, `forest-ruth-1990` or `saba-3`"
)]
pub trait Splits: Method {}

/// A plan that has steps: any but that of a splitting with gradient kicks or more than 36 stages for general Hamiltonians.
#[diagnostic::on_unimplemented(
    message = "a splitting of more than 36 stages, or with gradient kicks, has no steps for systems of class `General`",
    label = "steps separable Hamiltonians only",
    note = "implement the system as a separable one, or take a method for general Hamiltonians"
)]
pub trait Possible: Plan {}

/// A method that is symmetric, its own adjoint, on systems of class `C`. The macros implement it: see [`Symmetry`].
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not symmetric on systems of class `{C}`",
    label = "not symmetric",
    note = "variable steps are reversible, and a corrector exists, only for a symmetric method: take `velocity-verlet`, a symmetric splitting, or `basis: polynomial(s)` with `nodes: gauss(s)` or `lobatto(s)`",
    note = "generic code needs the bound `M: SymmetricFor<S::Class>`"
)]
pub trait SymmetricFor<C>: Method {}

/// A method whose steps are Störmer–Verlet, or a composition of it. The macros implement it.
///
/// The fractions of such a composition apply to every symmetric step of order 2.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a composition of Störmer–Verlet steps",
    label = "not a composition of Störmer–Verlet steps",
    note = "`composition! {{ Name {{ base: stormer-verlet, weights: suzuki(4) }} }}` makes one"
)]
pub trait StoermerVerletSteps: Method {}

/// The order of a method for each class of Hamiltonians, as the compiler found it. The documentation of the method says how each
/// order is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Orders {
    /// For every `H(q, p)`.
    pub general: u32,
    /// For `H = T(p) + U(q)`.
    pub separable: u32,
    /// For `H = pᵀM⁻¹p/2 + U(q)`.
    pub nystrom: u32,
}

/// The Hamiltonians for which a method is symmetric, as the compiler proved it. A symmetric method is its own adjoint: a step of size `−h`
/// undoes a step of size `h`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Symmetry {
    /// For every `H(q, p)`.
    pub general: bool,
    /// For `H = T(p) + U(q)`.
    pub separable: bool,
}

impl Symmetry {
    /// For no Hamiltonian.
    pub const NONE: Self = Self {
        general: false,
        separable: false,
    };
}

/// The result of [`Method::accept_lower_order`]: a method on systems for which it has a lower order, or is not symplectic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LowerOrder<M>(pub(crate) M);

impl<M: Method> Method for LowerOrder<M> {
    const NAME: &'static str = M::NAME;
    const STAGES: usize = M::STAGES;
    const DEFINITION: &'static str = M::DEFINITION;
    const COEFFICIENTS: Coefficients = M::COEFFICIENTS;
    const ORDERS: Orders = M::ORDERS;
    const SYMMETRY: Symmetry = M::SYMMETRY;
    const NEEDS_QUADRATIC_KINETIC: bool = false;
    const FUNCTIONS: usize = M::FUNCTIONS;
    const AT_RUN_TIME: bool = M::AT_RUN_TIME;
    type General = M::General;
    type Separable = M::Separable;

    fn name(&self) -> &str {
        self.0.name()
    }

    fn orders(&self) -> Orders {
        self.0.orders()
    }

    fn needs_quadratic_kinetic(&self) -> Option<Orders> {
        None
    }

    #[cfg(feature = "alloc")]
    fn identity(&self) -> String {
        self.0.identity()
    }

    fn is_lanewise(&self) -> bool {
        self.0.is_lanewise()
    }

    fn general_memory<V: Vector, S: System<V>, N: Solver<V, S>>(
        &self,
        prototype: &V,
    ) -> <M::General as Plan>::Memory<V, S, N> {
        self.0.general_memory::<V, S, N>(prototype)
    }

    fn separable_memory<V: Vector, S: System<V>, N: Solver<V, S>>(
        &self,
        prototype: &V,
    ) -> <M::Separable as Plan>::Memory<V, S, N> {
        self.0.separable_memory::<V, S, N>(prototype)
    }
}

// With constraints or friction there is no lower order to accept for a method without such steps.
impl<M: Method<General: Possible>> ProvedFor<General> for LowerOrder<M> {}

impl<M: Method> ProvedFor<Separable> for LowerOrder<M> {}

impl<M: Method> ProvedFor<()> for LowerOrder<M> {}

impl<M: Splits> Splits for LowerOrder<M> {}

impl<M: SymmetricFor<C>, C> SymmetricFor<C> for LowerOrder<M> {}
