//! The same integrator with another solver for coupled stages.

use core::marker::PhantomData;

use super::validation::check_local_forces;
use crate::error::Error;
use crate::integrator::Integrator;
use crate::method::{Method, Solver};
use crate::number::{Summation, Vector};
#[cfg(feature = "alloc")]
use crate::solver::{Dense, Differences, Newton};
use crate::solver::{SimdFixedPoint, SimdJacobi, SimdNystrom};
use crate::state::State;
use crate::system::{Hamiltonian, HamiltonianInLanes};

impl<M: Method, S: Hamiltonian<V>, V: Vector, R: Summation, N: Solver<V, S>>
    Integrator<M, S, V, R, N>
{
    /// The same integrator with another [`Solver`] for coupled stages: from here on, with the counts so far.
    pub fn with_solver<O: Solver<V, S>>(self, _solver: O) -> Integrator<M, S, V, R, O> {
        Integrator {
            system: self.system,
            course: self.course.with_memory(),
            clock: self.clock,
            step_size: self.step_size,
            stopping: self.stopping,
            retry: self.retry,
            last_event: self.last_event,
            method: PhantomData,
        }
    }

    /// The same integrator with [`Newton`]'s iteration, on full matrices of [`Differences`]: for stiff systems with few
    /// components. An explicit method stays what it is.
    ///
    /// ```
    /// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, separable};
    /// # fn main() -> Result<(), Error> {
    /// let stiff = separable::<Vector1<f64>, _, _>(|_, p, velocity| *velocity = *p, |_, q, force| *force = -q * 1e12);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::new(Midpoint, stiff, start, 0.1)?.by_newton();
    /// integrator.integrate_to(10.0)?;
    /// assert_eq!(integrator.statistics().factorisations, 1);
    /// # Ok(())
    /// # }
    /// ```
    #[cfg(feature = "alloc")]
    pub fn by_newton(self) -> Integrator<M, S, V, R, Newton<Dense<Differences>>> {
        self.with_solver(Newton::new())
    }
}

impl<M: Method, S: HamiltonianInLanes<V>, V: Vector<Scalar = f64>, R: Summation>
    Integrator<M, S, V, R>
{
    /// The same integrator with coupled stages side by side, [`SimdFixedPoint`]: for a system that is generic over its
    /// scalar. Vectors may be long. An explicit method stays what it is.
    ///
    /// ```
    /// symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }
    /// use symplectic::nalgebra::SVector;
    /// use symplectic::{Error, Integrator, Scalar, SeparableHamiltonian, State};
    ///
    /// struct Kepler;
    ///
    /// impl<T: Scalar> SeparableHamiltonian<SVector<T, 2>> for Kepler {
    ///     fn velocity(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
    ///         *velocity = *p;
    ///     }
    ///
    ///     fn force(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
    ///         let square = q.dot(q);
    ///         *force = -q * (square * square.sqrt()).recip();
    ///     }
    /// }
    ///
    /// # fn main() -> Result<(), Error> {
    /// let start = || State::new(0.0, SVector::from([0.4, 0.0]), SVector::from([0.0, 2.0]));
    /// let mut one_by_one = Integrator::new(Gauss4, Kepler, start(), 0.05)?;
    /// let mut side_by_side = Integrator::new(Gauss4, Kepler, start(), 0.05)?.in_lanes();
    /// // The same to the last bit.
    /// assert_eq!(one_by_one.integrate_to(10.0)?, side_by_side.integrate_to(10.0)?);
    /// # Ok(())
    /// # }
    /// ```
    pub fn in_lanes(self) -> Integrator<M, S, V, R, SimdFixedPoint> {
        self.with_solver(SimdFixedPoint)
    }

    /// [`in_lanes`](Self::in_lanes) for a Hamiltonian that is not separable, with positions and momenta iterated at once:
    /// [`SimdJacobi`], which says where that pays.
    pub fn at_once_in_lanes(self) -> Integrator<M, S, V, R, SimdJacobi> {
        self.with_solver(SimdJacobi)
    }

    /// [`in_lanes`](Self::in_lanes) for a second-order system `q'' = M⁻¹ f(q)`, one whose velocity `M⁻¹ p` is linear in the
    /// momentum: by [`SimdNystrom`], which iterates the positions only.
    ///
    /// # Errors
    ///
    /// [`Error::NotSecondOrder`], where the velocity is not linear in the momentum, or depends on time;
    /// [`Error::NotTheSameLocalForce`], where the force component by component, or in rows, is another one, and [`Error::NoSuchRow`], where
    /// there is no such row.
    pub fn in_second_order_lanes(self) -> Result<Integrator<M, S, V, R, SimdNystrom>, Error> {
        check_local_forces(&self.system, &self.course.state, self.step_size)?;
        let State { time, q, p } = &self.course.state;
        let solver = SimdNystrom::new(&self.system, *time, q, p)?;
        Ok(self.with_solver(solver))
    }
}
