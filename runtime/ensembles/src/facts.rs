//! The facts about a method that are stored in a file of results.

use alloc::string::String;

use crate::Ensemble;
use symplectic_core::solver::Solver;
use symplectic_core::{Method, Summation, System, Vector};

/// The origin of the numbers of a file.
pub(super) struct Facts<'a> {
    pub(super) method: &'a str,
    /// `at run time` for a tableau at run time.
    pub(super) definition: &'static str,
    /// The proved orders for general H, for separable H, and for H with quadratic kinetic energy.
    pub(super) orders: [u64; 3],
    pub(super) step_size: f64,
    /// `compensated` or `plain`.
    pub(super) sums: &'static str,
    pub(super) solver: String,
    /// Tolerance of the iteration; 0 is rounding.
    pub(super) tolerance: f64,
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>, L>
    Ensemble<M, S, V, R, N, L>
{
    pub(super) fn method_facts(&self) -> Facts<'_> {
        let orders = self.method.orders();
        Facts {
            method: self.method.name(),
            definition: M::DEFINITION,
            orders: [orders.general, orders.separable, orders.nystrom].map(u64::from),
            step_size: self.step_size,
            sums: if R::COMPENSATED {
                "compensated"
            } else {
                "plain"
            },
            solver: N::name(),
            tolerance: self.stopping.tolerance,
        }
    }
}
