//! A splitting takes a separable system: on another one it is not symplectic.

symplectic::tableau! { ForestRuth { base: forest-ruth-1990 } }

use symplectic::nalgebra::{SVector, Vector1};
use symplectic::{Error, General, Hamiltonian, Integrator, Scalar, State, hamiltonian};

/// H = (q² + 1)(p² + 1)/2
struct NotSeparable;

impl Hamiltonian for NotSeparable {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 1>;

    fn velocity<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 1>,
        p: &SVector<T, 1>,
        velocity: &mut SVector<T, 1>,
    ) {
        velocity[0] = (q[0] * q[0] + T::one()) * p[0];
    }

    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>, force: &mut SVector<T, 1>) {
        force[0] = -q[0] * (p[0] * p[0] + T::one());
    }
}

/// It has no equations.
struct Nothing;

fn main() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [0.0], [1.0]);
    Integrator::new(ForestRuth, NotSeparable, start, 0.1)?;
    let closures = hamiltonian::<Vector1<f64>, _, _>(
        |_, q, p, velocity| velocity[0] = p[0] * (q[0] * q[0] + 1.0),
        |_, q, p, force| force[0] = -q[0] * (p[0] * p[0] + 1.0),
    );
    Integrator::plain(ForestRuth, closures, start, 0.1)?;
    Integrator::new(ForestRuth, Nothing, start, 0.1)?;
    Ok(())
}
