//! The same problems by other crates.

use differential_equations::methods::{ExplicitRungeKutta, SymplecticIntegrator};
use differential_equations::prelude::IVP;
use symplectic::nalgebra::SVector;
use symplectic_tests::peers;
pub use symplectic_tests::peers::Equations;

/// The state `y = (q, p)` at the end; `None` if the crate fails.
pub type End = Option<Vec<f64>>;

/// DOP853 from `ode_solvers`, with the same relative and absolute tolerance.
pub fn ode_solvers<S, const N: usize, const M: usize>(
    equations: &Equations<S, N>,
    start: [f64; M],
    end: f64,
    tolerance: f64,
) -> End
where
    S: symplectic::System<SVector<f64, N>>,
{
    let mut solver = peers::dop853(equations, start, end, tolerance, 10_000_000);
    solver.integrate().ok()?;
    Some(solver.y_out().last()?.as_slice().to_vec())
}

/// DOP853 from `differential-equations`, with the same relative and absolute tolerance.
pub fn dop853<S, const N: usize, const M: usize>(
    equations: &Equations<S, N>,
    start: [f64; M],
    end: f64,
    tolerance: f64,
) -> End
where
    S: symplectic::System<SVector<f64, N>>,
{
    let method = ExplicitRungeKutta::dop853()
        .rtol(tolerance)
        .atol(tolerance)
        .max_steps(10_000_000);
    let problem = IVP::ode(equations, 0.0, end, start).method(method);
    let solution = problem.t_eval([end]).solve().ok()?;
    Some(solution.last().ok()?.1.to_vec())
}

/// The symplectic method of Forest & Ruth from `differential-equations`, for separable systems.
pub fn forest_ruth<S, const N: usize, const M: usize>(
    equations: &Equations<S, N>,
    start: [f64; M],
    end: f64,
    step_size: f64,
) -> End
where
    S: symplectic::System<SVector<f64, N>>,
{
    let method = SymplecticIntegrator::ruth_forest(step_size).max_steps(100_000_000);
    let problem = IVP::hamiltonian(equations, 0.0, end, start).method(method);
    let solution = problem.t_eval([end]).solve().ok()?;
    Some(solution.last().ok()?.1.to_vec())
}
