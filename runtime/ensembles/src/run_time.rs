//! Ensembles with a tableau at run time.

use alloc::vec::Vec;

use crate::{Ensemble, EnsembleError};
use symplectic_core::inside::check_orders;
use symplectic_core::system::Frictionless;
use symplectic_core::{AtRunTime, Plain, RunTimeTableau, State, Summation, System, Vector};

impl<S: System<V, Class: Frictionless>, V: Vector> Ensemble<AtRunTime, S, V> {
    /// [`new`](Ensemble::new) with a tableau at run time and with [`Compensated`](symplectic_core::Compensated) sums.
    ///
    /// Trajectories run in lanes, whether the stages are explicit or coupled. Each has the same bits as if run alone in
    /// [`Integrator::at_run_time`](symplectic_core::Integrator::at_run_time).
    ///
    /// # Errors
    ///
    /// Those of [`new`](Ensemble::new). [`EnsembleError::All`] with
    /// [`Error::SeparableTableau`](symplectic_core::Error::SeparableTableau) if the system is not separable and the tableau has a
    /// lower order for such systems or is not symplectic. [`EnsembleError::Start`] with
    /// [`Error::NotQuadraticKinetic`](symplectic_core::Error::NotQuadraticKinetic) for a Nyström method if the velocity is not
    /// linear in the momentum.
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// use symplectic::ensemble::Ensemble;
    /// use symplectic::{Orders, RunTimeCoefficients, RunTimeTableau, State};
    ///
    /// symplectic::hamiltonian! { Oscillator q: [x], p: [px]; H = px^2/2 + x^2/2 }
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
    ///
    /// let starts = (0..100).map(|k| State::from_arrays(0.0, [0.01 * f64::from(k)], [0.0])).collect();
    /// let ensemble = Ensemble::at_run_time(&verlet, Oscillator, starts, 0.01)?;
    /// ensemble.integrate_to(1.0, |row| {
    ///     let exact = 0.01 * row.trajectory as f64 * 1.0_f64.cos();
    ///     assert!((row.state.q[0] - exact).abs() < 1e-5);
    ///     ControlFlow::Continue(())
    /// });
    /// # Ok(())
    /// # }
    /// ```
    pub fn at_run_time(
        tableau: &RunTimeTableau,
        system: S,
        starts: Vec<State<V>>,
        step_size: f64,
    ) -> Result<Self, EnsembleError> {
        Self::families_at_run_time(tableau, [(system, starts)], step_size)
    }
}

impl<S: System<V, Class: Frictionless>, V: Vector> Ensemble<AtRunTime, S, V, Plain> {
    /// [`at_run_time`](Ensemble::at_run_time) with [`Plain`] sums.
    ///
    /// # Errors
    ///
    /// Those of [`at_run_time`](Ensemble::at_run_time).
    pub fn plain_at_run_time(
        tableau: &RunTimeTableau,
        system: S,
        starts: Vec<State<V>>,
        step_size: f64,
    ) -> Result<Self, EnsembleError> {
        Self::families_at_run_time(tableau, [(system, starts)], step_size)
    }
}

impl<S: System<V, Class: Frictionless>, V: Vector, R: Summation> Ensemble<AtRunTime, S, V, R> {
    /// [`of_families`](Ensemble::of_families) with a tableau at run time and with the [`Summation`] of the type.
    ///
    /// # Errors
    ///
    /// Those of [`at_run_time`](Ensemble::at_run_time).
    pub fn families_at_run_time(
        tableau: &RunTimeTableau,
        families: impl IntoIterator<Item = (S, Vec<State<V>>)>,
        step_size: f64,
    ) -> Result<Self, EnsembleError> {
        check_orders::<V, S>(tableau).map_err(EnsembleError::All)?;
        Self::of(families, step_size, Some(tableau))
    }
}
