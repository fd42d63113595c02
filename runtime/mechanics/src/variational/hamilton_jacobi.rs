//! Solutions of the discrete Hamilton–Jacobi equation along a run.

use super::two_ends::dot;
use symplectic_core::{Scalar, State, Vector};

/// The generating functions of a whole run, which solve the discrete Hamilton–Jacobi equations (Leok & Zhang, eq. 21 to 24):
///
/// ```text
/// S_I(q0, q_N)   = Σ L_d                  dS_I   = p_N·dq_N − p0·dq0
/// S_II(q0, p_N)  = p_N·q_N − Σ L_d        dS_II  = p0·dq0 + q_N·dp_N
/// S_III(p0, q_N) = −p0·q0 − Σ L_d         dS_III = −q0·dp0 − p_N·dq_N
/// ```
///
/// $$ S_{I} = \sum_k L_d(q_k, q_{k+1}) \qquad S_{II} = p_N q_N - S_I \qquad S_{III} = -p_0 q_0 - S_I $$
///
/// A step changes them by
///
/// ```text
/// L_d(q_k, q_{k+1})      H_d⁺(q_k, p_{k+1}) − p_k·q_k      H_d⁻(p_k, q_{k+1}) + p_k·q_k
/// ```
///
/// The action of a step is given by [`VariationalSteps::action`](super::VariationalSteps::action), and by
/// [`GeneratingFunction::discrete_lagrangian`](super::GeneratingFunction::discrete_lagrangian). The sum is compensated.
///
/// ```
/// use symplectic::nalgebra::Vector1;
/// use symplectic::variational::{DiscreteHamiltonJacobi, Error, step_with_generating_function};
/// use symplectic::{Integrator, State, hamiltonian};
///
/// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
///
/// # fn main() -> Result<(), Error> {
/// // H = q·p: steps multiply q by 5/3, and H_d⁺(q0, p1) = 5/3 q0·p1. So S_II = (5/3)^N q0·p_N.
/// let system = hamiltonian::<Vector1<f64>, _, _>(|_, q, _p, velocity| *velocity = *q, |_, _q, p, force| *force = -p)
///     .with_energy(|_, q, p| q[0] * p[0]);
/// let start = State::new(0.0, Vector1::new(3.0), Vector1::new(2.0));
/// let mut solution = DiscreteHamiltonJacobi::new(&start);
/// let mut run = Integrator::new(Midpoint, system, start, 0.5)?;
/// for _ in 0..4 {
///     let generating = step_with_generating_function(&mut run)?;
///     solution.add(generating.discrete_lagrangian(&run.state().p));
/// }
/// let expected = (5.0_f64 / 3.0).powi(4) * 3.0 * run.state().p[0];
/// assert!((solution.type_two(run.state()) - expected).abs() < 1e-14);
/// assert!(solution.type_one().abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DiscreteHamiltonJacobi<T> {
    /// `p0·q0`
    start: T,
    action: T,
    /// The compensation of the sum.
    rest: T,
}

impl<T: Scalar> DiscreteHamiltonJacobi<T> {
    /// The functions before the first step from a state: `S_I = 0`, `S_II = p0·q0`, `S_III = −p0·q0`.
    pub fn new<V: Vector<Scalar = T>>(start: &State<V>) -> Self {
        Self {
            start: dot(&start.p, &start.q),
            action: T::zero(),
            rest: T::zero(),
        }
    }

    /// Adds a step with the action `L_d(q_k, q_{k+1})`.
    pub fn add(&mut self, action: T) {
        let add = action + self.rest;
        let sum = self.action + add;
        self.rest = add - (sum - self.action);
        self.action = sum;
    }

    /// `S_I`, at the position after the steps: the action of the run.
    pub const fn type_one(&self) -> T {
        self.action
    }

    /// `S_II`, at the momentum of `state`, which is the state after the steps.
    pub fn type_two<V: Vector<Scalar = T>>(&self, state: &State<V>) -> T {
        dot(&state.p, &state.q) - self.action
    }

    /// `S_III`, at the position after the steps.
    pub fn type_three(&self) -> T {
        -self.start - self.action
    }
}
