//! A splitting takes a separable system: on another one it is not symplectic.

symplectic::tableau! { ForestRuth { base: forest-ruth-1990 } }

use symplectic::nalgebra::Vector1;
use symplectic::{Error, General, Integrator, State, hamiltonian, System, solver::FixedPoint};

/// H = (q² + 1)(p² + 1)/2
struct NotSeparable;

impl System<Vector1<f64>> for NotSeparable {
    type Class = General;
    type Solver = FixedPoint;

    fn velocity(
        &self,
        _time: f64,
        q: &Vector1<f64>,
        p: &Vector1<f64>,
        velocity: &mut Vector1<f64>,
    ) {
        velocity[0] = (q[0] * q[0] + 1.0) * p[0];
    }

    fn force(&self, _time: f64, q: &Vector1<f64>, p: &Vector1<f64>, force: &mut Vector1<f64>) {
        force[0] = -q[0] * (p[0] * p[0] + 1.0);
    }
}

fn main() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [0.0], [1.0]);
    Integrator::new(ForestRuth, NotSeparable, start, 0.1)?;
    let closures = hamiltonian::<Vector1<f64>, _, _>(
        |_, q, p, velocity| velocity[0] = p[0] * (q[0] * q[0] + 1.0),
        |_, q, p, force| force[0] = -q[0] * (p[0] * p[0] + 1.0),
    );
    Integrator::plain(ForestRuth, closures, start, 0.1)?;
    Ok(())
}
