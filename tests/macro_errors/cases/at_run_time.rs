//! A tableau at run time has no steps with friction. Whether it has steps with constraints is known at run time.

use symplectic::at_run_time::RunTimeTableau;
use symplectic::ensemble::Ensemble;
use symplectic::{Integrator, State};

symplectic::hamiltonian! {
    Rod
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + y
    constraints: { rod = x^2 + y^2 - 1 }
}

symplectic::hamiltonian! {
    Damped { gamma }
    q: [x], p: [px];
    H = px^2/2 + x^2/2
    friction: gamma
}

fn steps(tableau: &RunTimeTableau) -> Result<(), Box<dyn std::error::Error>> {
    let rod = State::from_arrays(0.0, [1.0, 0.0], [0.0, 0.0]);
    let damped = State::from_arrays(0.0, [1.0], [0.0]);
    let _rod = Integrator::new(tableau.clone(), Rod, rod, 0.1)?;
    let _damped = Integrator::new(tableau.clone(), Damped::new(0.1), damped.clone(), 0.1)?;
    let _ensemble = Ensemble::new(tableau.clone(), Damped::new(0.1), vec![damped.clone()], 0.1)?;
    let _plain = Integrator::plain(tableau.clone(), Damped::new(0.1), damped, 0.1)?;
    Ok(())
}

fn main() {
    let _used = steps;
}
