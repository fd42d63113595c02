//! A method.

#[cfg(feature = "alloc")]
use alloc::string::String;
use core::fmt::Debug;

use crate::contract::{
    Class, ConstrainedStep, General, LowerOrder, Orders, Plan, ProvedFor, Separable, Solver,
    StageStorage, Symmetry, System,
};
use crate::error::Error;
use crate::number::{Coefficients, Vector};

/// A symplectic partitioned Runge–Kutta method: a value without fields, emitted from a proved tableau, or, with the feature
/// `at-run-time`, a tableau at run time.
///
/// It can be run on separable systems, and on general systems if it is [`ProvedFor`] them.
pub trait Method:
    ProvedFor<Separable> + ProvedFor<()> + Clone + Debug + Send + Sync + 'static
{
    /// Name of the method.
    const NAME: &'static str;
    /// Number of stages s of the tableau; a plan may store fewer.
    const STAGES: usize;
    /// Its definition: `basis: polynomial(3), nodes: lobatto(3)`. The compiler derives the exact tableau from it again.
    const DEFINITION: &'static str;
    /// The coefficients, for computations outside the step; the plans have theirs in their code.
    const COEFFICIENTS: Coefficients;
    /// Its order for each class of Hamiltonians.
    const ORDERS: Orders;
    /// The Hamiltonians for which it is symmetric.
    const SYMMETRY: Symmetry = Symmetry::NONE;
    /// Whether it is refused for separable systems whose kinetic energy is not quadratic, because its order is lower there.
    const NEEDS_QUADRATIC_KINETIC: bool = Self::ORDERS.nystrom > Self::ORDERS.separable;

    /// Number of basis functions of the velocity inside a step. It is the number of stages, or less if the quadrature formula has more
    /// nodes than the basis has functions.
    const FUNCTIONS: usize = Self::STAGES;

    /// Its steps for systems with holonomic constraints: one step, or those of a composition. Empty if it has none.
    const CONSTRAINED: &'static [ConstrainedStep] = &[];

    /// Its steps for systems with non-holonomic constraints: one step, or those of a composition. Empty if it has none.
    const NONHOLONOMIC: &'static [ConstrainedStep] = &[];

    /// Whether the coefficients are in the value. The constants then say nothing about them, and code that reads them does not compile.
    const AT_RUN_TIME: bool = false;

    /// Name of the method; that of a tableau at run time is in the value.
    fn name(&self) -> &str {
        Self::NAME
    }

    /// Its order for each class of Hamiltonians.
    fn orders(&self) -> Orders {
        Self::ORDERS
    }

    /// The orders, if it is refused for separable systems whose kinetic energy is not quadratic:
    /// [`NEEDS_QUADRATIC_KINETIC`](Self::NEEDS_QUADRATIC_KINETIC).
    #[doc(hidden)]
    fn needs_quadratic_kinetic(&self) -> Option<Orders> {
        Self::NEEDS_QUADRATIC_KINETIC.then_some(Self::ORDERS)
    }

    /// What checkpoints are compared by: its definition, or the coefficients of a tableau at run time, bit by bit.
    #[cfg(feature = "alloc")]
    #[doc(hidden)]
    fn identity(&self) -> String {
        Self::DEFINITION.into()
    }

    /// Its steps for systems with holonomic constraints.
    #[doc(hidden)]
    fn holonomic(&self) -> &'static [ConstrainedStep] {
        Self::CONSTRAINED
    }

    /// Its steps for systems with non-holonomic constraints.
    #[doc(hidden)]
    fn nonholonomic(&self) -> &'static [ConstrainedStep] {
        Self::NONHOLONOMIC
    }

    /// Checks that it keeps its order on systems of class `C`. The compiler has proved it of an emitted method.
    ///
    /// # Errors
    ///
    /// [`Error::SeparableTableau`](crate::Error::SeparableTableau) for a tableau at run time.
    #[doc(hidden)]
    fn check_order<C: Class>(&self) -> Result<(), Error> {
        Ok(())
    }

    /// Whether its plans for separable systems are [lanewise](Plan::LANEWISE) with these coefficients.
    #[doc(hidden)]
    fn is_lanewise(&self) -> bool {
        true
    }

    /// The memory of its steps for systems with a general Hamiltonian.
    #[doc(hidden)]
    fn general_memory<V: Vector, S: System<V>, N: Solver<V, S>>(
        &self,
        prototype: &V,
    ) -> <Self::General as Plan>::Memory<V, S, N> {
        StageStorage::like(prototype)
    }

    /// The memory of its steps for systems with a separable Hamiltonian.
    #[doc(hidden)]
    fn separable_memory<V: Vector, S: System<V>, N: Solver<V, S>>(
        &self,
        prototype: &V,
    ) -> <Self::Separable as Plan>::Memory<V, S, N> {
        StageStorage::like(prototype)
    }

    /// The same method for every system, even if its order is lower or it is not symplectic.
    ///
    /// ```
    /// symplectic::tableau! { ForestRuth { base: forest-ruth-1990 } }
    /// use symplectic::nalgebra::Vector1;
    /// use symplectic::{Error, Integrator, Method, State, hamiltonian};
    ///
    /// # fn main() -> Result<(), Error> {
    /// let system = hamiltonian::<Vector1<f64>, _, _>(
    ///     |_, q, p, velocity| velocity[0] = p[0] * (q[0] * q[0] + 1.0),
    ///     |_, q, p, force| force[0] = -q[0] * (p[0] * p[0] + 1.0),
    /// );
    /// let start = State::from_arrays(0.0, [0.0], [1.0]);
    /// assert_eq!((ForestRuth::ORDERS.separable, ForestRuth::ORDERS.general), (4, 1));
    /// let mut integrator = Integrator::new(ForestRuth.accept_lower_order(), system, start, 0.1)?;
    /// integrator.step()?;
    /// # Ok(())
    /// # }
    /// ```
    fn accept_lower_order(self) -> LowerOrder<Self> {
        LowerOrder(self)
    }

    /// Its plan for systems with a general Hamiltonian.
    type General: Plan<Class = General>;
    /// Its plan for systems with a separable Hamiltonian.
    type Separable: Plan<Class = Separable>;
}
