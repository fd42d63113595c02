//! A system that promises that everything is inlined, and calls a function.

use std::hint::black_box;

use symplectic::nalgebra::SVector;
use symplectic::{Error, Integrator, Scalar, SeparableHamiltonian, State};

symplectic::tableau! {
    Gauss4 { basis: polynomial(4), nodes: gauss(4) }
}

struct Spring;

#[inline(never)]
fn force<T: Scalar>(q: T) -> T {
    -q - q * q * q
}

impl SeparableHamiltonian for Spring {
    type Vector<T: Scalar> = SVector<T, 1>;

    const INLINED: bool = true;

    #[inline(always)]
    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
        velocity[0] = p[0];
    }

    #[inline(always)]
    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, out: &mut SVector<T, 1>) {
        out[0] = force(q[0]);
    }
}

fn main() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [1.0], [0.0]);
    let mut integrator = Integrator::new(Gauss4, Spring, start, 0.01)?;
    integrator.integrate_to(1.0)?;
    black_box(integrator.state());
    Ok(())
}
