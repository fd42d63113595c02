//! Integrators by Newton's iteration.

use symplectic_core::solver::Solver;
use symplectic_core::{Integrator, Method, Summation, System, Vector};

use super::Newton;

/// An integrator that can take Newton's iteration.
pub trait ByNewton {
    /// The integrator with it.
    type ByNewton;

    /// The same integrator with [`Newton`]'s iteration, for stiff and strongly coupled systems. An explicit method does not change.
    /// With constraints nothing changes either: their steps have an iteration of their own.
    ///
    /// The second derivatives are exact if the system [implements them](symplectic_core::System::second_derivatives), as a system from a
    /// [formula](symplectic_core::hamiltonian!) does. Otherwise they are difference quotients. The matrices are banded if the system provides its
    /// [half bandwidth](symplectic_core::System::half_bandwidth), and full otherwise. The first step allocates them.
    ///
    /// ```
    /// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, separable};
    /// use symplectic::solver::ByNewton;
    /// # fn main() -> Result<(), Error> {
    /// let stiff = separable::<Vector1<f64>, _, _>(|_, p, velocity| *velocity = *p, |_, q, force| *force = -q * 1e12);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::new(Midpoint, stiff, start, 0.1)?.by_newton();
    /// integrator.integrate_to(10.0)?;
    /// assert_eq!(integrator.statistics().factorisations, 1);
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    fn by_newton(self) -> Self::ByNewton;
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> ByNewton
    for Integrator<M, S, V, R, N>
{
    type ByNewton = Integrator<M, S, V, R, Newton>;

    fn by_newton(self) -> Self::ByNewton {
        self.with_solver(Newton::new())
    }
}
