//! Lagrangians that may be degenerate, with constraints on their velocities.

mod equations;
mod failure;
mod integrator;
mod primary;
mod rows;
mod step;

pub use integrator::{DiracIntegrator, DiracSteps};
pub use primary::{PrimaryConstraint, primary_constraints};

use crate::constraints::Gradients;
use symplectic_core::Scalar;
use symplectic_core::system::Lagrangian;

/// A Lagrangian, regular or degenerate, with optional constraints `w(q) v = 0` on its velocities.
///
/// ```text
/// d/dt ∂L/∂v − ∂L/∂q − f = wᵀλ      w(q) v = 0
/// ```
///
/// $$ \frac{d}{dt} \frac{\partial L}{\partial v} - \frac{\partial L}{\partial q} - f = w^T \lambda \qquad w(q) v = 0 $$
///
/// See [`DiracIntegrator`] for an example.
pub trait DiracSystem: Lagrangian {
    /// The number m of constraints, at most the number of components.
    fn nonholonomic_constraints(&self) -> usize {
        0
    }

    /// Sets the entries of the m×n matrix `w(q)`: always the same entries in the same order, even if they are zero.
    fn nonholonomic_rows<T: Scalar>(&self, _q: &Self::Vector<T>, _rows: &mut Gradients<T>) {}
}

impl<L: DiracSystem> DiracSystem for &L {
    fn nonholonomic_constraints(&self) -> usize {
        (**self).nonholonomic_constraints()
    }

    fn nonholonomic_rows<T: Scalar>(&self, q: &L::Vector<T>, rows: &mut Gradients<T>) {
        (**self).nonholonomic_rows(q, rows);
    }
}

/// How a step discretises the Lagrangian and the constraints, with `u = (q1 − q0)/h`:
///
/// ```text
/// Ld = h Σ_i b_i L(t0 + c_i h, q0 + c_i h u, u)      w_d = Σ_i b_i w(q0 + c_i h u)
/// ```
///
/// $$ L_d = h \sum_i b_i L(t_0 + c_i h, q_0 + c_i h u, u) \qquad w_d = \sum_i b_i w(q_0 + c_i h u) $$
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiracRule {
    /// The midpoint of the step. Order 2, self-adjoint.
    ///
    /// For regular Lagrangians and for those that are linear in the velocities. A condition on positions, such as that of a loop of
    /// capacitors, holds at the midpoint. Its error at the ends has order 2 and changes its sign in every step.
    Midpoint,
    /// The mean of both ends. Order 2, self-adjoint. Conditions on positions hold at the ends of steps.
    Trapezoid,
    /// At the start, Δ^(+) of Leok & Ohsawa. Order 1; the energy drifts if the constraints are not integrable. Conditions on positions
    /// leave the end of a step undetermined.
    AtStart,
    /// At the end, Δ^(−). Order 1; the energy drifts if the constraints are not integrable. From any start, one step satisfies the
    /// conditions on positions.
    AtEnd,
}
