//! Integrators of methods that are known only at run time.

use super::memory::StepMemory;
use super::validation::{check_orders, check_quadratic_kinetic};
use crate::error::Error;
use crate::integrator::{Integrator, Partitioned, PlanOf};
use crate::method::{AtRunTime, Method, Plan, RunTimeTableau, Solver, StageStorage};
use crate::number::{Plain, Summation, Vector};
use crate::state::State;
use crate::system::{Frictionless, System};

impl<S: System<V, Class: Frictionless>, V: Vector> Integrator<AtRunTime, S, V> {
    /// [`new`](crate::Integrator#method.new) with a method that is known only at run time, and with
    /// [`Compensated`](crate::Compensated) sums.
    ///
    /// On separable systems an explicit tableau takes drifts and kicks. Coupled stages use the iteration of
    /// [`FixedPoint`](crate::solver::FixedPoint), one by one and never in lanes. For stiff systems take
    /// `by_newton`. Dense output is the cubic polynomial through the ends of the step.
    ///
    /// # Errors
    ///
    /// Those of [`new`](crate::Integrator#method.new), and [`Error::SeparableTableau`] if the system is not separable and the tableau has a
    /// lower order there or is not symplectic: see [`RunTimeTableau::accept_lower_order`]. With constraints also
    /// [`Error::NoConstrainedSteps`].
    ///
    /// ```
    /// use symplectic::nalgebra::Vector1;
    /// use symplectic::{Integrator, Orders, RunTimeCoefficients, RunTimeTableau, State, acceleration};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let verlet = RunTimeCoefficients {
    ///     a: vec![vec![0.0, 0.0], vec![0.5, 0.5]],
    ///     a_tilde: vec![vec![0.5, 0.0], vec![0.5, 0.0]],
    ///     b: vec![0.5, 0.5],
    ///     b_tilde: vec![0.5, 0.5],
    ///     c: vec![0.0, 1.0],
    ///     c_tilde: vec![0.5, 0.5],
    /// };
    /// let orders = Orders { general: 2, separable: 2, nystrom: 2 };
    /// let verlet = RunTimeTableau::new("Störmer–Verlet", &verlet, orders)?;
    /// assert!(verlet.is_explicit());
    ///
    /// let oscillator = acceleration(|_time, q: &Vector1<f64>, acceleration| *acceleration = -q);
    /// let start = State::from_arrays(0.0, [1.0], [0.0]);
    /// let mut integrator = Integrator::at_run_time(&verlet, oscillator, start, 0.01)?;
    /// let end = integrator.integrate_to(1.0)?;
    /// assert!((end.q[0] - 1.0_f64.cos()).abs() < 1e-5);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// With constraints the tableau needs its [constrained steps](RunTimeTableau::with_constrained_steps). With friction take an emitted
    /// method.
    ///
    /// ```compile_fail,E0277
    /// # use symplectic::{Integrator, RunTimeTableau, State};
    /// symplectic::hamiltonian! { Damped q: [x], p: [px]; H = (px^2 + x^2)/2 friction: 0.1 }
    ///
    /// fn step(tableau: &RunTimeTableau) -> Result<(), symplectic::Error> {
    ///     let start = State::from_arrays(0.0, [1.0], [0.0]);
    ///     Integrator::at_run_time(tableau, Damped, start, 0.1)?.step()?;
    ///     Ok(())
    /// }
    /// # let _used: fn(&RunTimeTableau) -> Result<(), symplectic::Error> = step;
    /// ```
    ///
    /// Solvers in lanes need an emitted method:
    ///
    /// ```compile_fail
    /// # use symplectic::solver::SimdFixedPoint;
    /// # use symplectic::{Integrator, RunTimeTableau, State};
    /// symplectic::hamiltonian! { Oscillator q: [x], p: [px]; H = px^2/2 + x^2/2 }
    ///
    /// fn step(tableau: &RunTimeTableau) -> Result<(), symplectic::Error> {
    ///     let start = State::from_arrays(0.0, [1.0], [0.0]);
    ///     Integrator::at_run_time(tableau, Oscillator, start, 0.1)?.with_solver(SimdFixedPoint).step()?;
    ///     Ok(())
    /// }
    /// # let _used: fn(&RunTimeTableau) -> Result<(), symplectic::Error> = step;
    /// ```
    pub fn at_run_time(
        tableau: &RunTimeTableau,
        system: S,
        state: State<V>,
        step_size: f64,
    ) -> Result<Self, Error> {
        Self::of_tableau(tableau, system, state, step_size)
    }
}

impl<S: System<V, Class: Frictionless>, V: Vector> Integrator<AtRunTime, S, V, Plain> {
    /// [`at_run_time`](Integrator::at_run_time) with [`Plain`] sums.
    ///
    /// # Errors
    ///
    /// As for [`at_run_time`](Integrator::at_run_time).
    pub fn plain_at_run_time(
        tableau: &RunTimeTableau,
        system: S,
        state: State<V>,
        step_size: f64,
    ) -> Result<Self, Error> {
        Self::of_tableau(tableau, system, state, step_size)
    }
}

impl<S: System<V, Class: Frictionless>, V: Vector, R: Summation> Integrator<AtRunTime, S, V, R> {
    fn of_tableau(
        tableau: &RunTimeTableau,
        system: S,
        state: State<V>,
        step_size: f64,
    ) -> Result<Self, Error> {
        check_orders::<V, S>(tableau)?;
        let mut made = Self::made(system, state, step_size)?;
        let orders = tableau.needs_quadratic_kinetic();
        check_quadratic_kinetic::<AtRunTime, V, S>(orders, made.system(), made.state())?;
        made.set_tableau(tableau);
        Ok(made)
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// Sets the tableau in the memory of steps.
    #[doc(hidden)]
    pub fn set_tableau(&mut self, tableau: &RunTimeTableau) {
        let Partitioned {
            system,
            step_memory: StepMemory { memory, state, .. },
            ..
        } = &mut self.stepper;
        memory.set_tableau(tableau, &state.q);
        let State { time, q, p } = state;
        <PlanOf<M, S, V> as Plan>::prepare::<V, S, N>(memory, system, *time, q, p);
    }
}
