//! A pendulum on a stiffer and stiffer spring, by fixed-point and by Newton's iteration: `cargo run --release --example newton`

#![allow(clippy::print_stdout, reason = "an example prints")]

use symplectic::solver::ByNewton;
use symplectic::{Error, Integrator, State};

symplectic::tableau! {
    /// Gauss with four stages, order 8.
    Gauss4 { basis: polynomial(4), nodes: gauss(4), require: [symplectic, symmetric] }
}

symplectic::hamiltonian! {
    /// A pendulum of length 1 on a spring of stiffness `k`.
    SpringPendulum { k: 1 }
    q: [2], p: [2];
    H = |p|^2/2 + k (|q| - 1)^2/2 + q[1]
}

const STEP_SIZE: f64 = 0.01;

fn main() -> Result<(), Error> {
    println!("h ω is the step size times the frequency of the spring.");
    println!("stiffness     h ω   fixed-point sweeps   Newton sweeps   energy error");
    for k in [1e2, 1e4, 1e6, 1e8] {
        let start = || State::from_arrays(0.0, [1.0_f64, 0.0], [0.0, 0.0]);

        let mut fixed_point = Integrator::new(Gauss4, SpringPendulum { k }, start(), STEP_SIZE)?;
        let converged = fixed_point.integrate_to(10.0).is_ok();
        let sweeps = match converged {
            true => format!("{:.1}", fixed_point.statistics().mean_iterations()),
            false => "no convergence".to_string(),
        };

        // The second derivatives follow from the formula.
        let mut newton =
            Integrator::new(Gauss4, SpringPendulum { k }, start(), STEP_SIZE)?.by_newton();
        let before = newton.energy().unwrap_or(f64::NAN);
        newton.integrate_to(10.0)?;
        let error = newton.energy().unwrap_or(f64::NAN) - before;

        let newton_sweeps = newton.statistics().mean_iterations();
        let frequency = f64::sqrt(k);
        println!(
            "{k:9.0e}  {:6.1}  {sweeps:>19}  {newton_sweeps:14.1}  {error:13.1e}",
            STEP_SIZE * frequency
        );
    }
    Ok(())
}
