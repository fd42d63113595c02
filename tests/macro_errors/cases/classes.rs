//! Constraints take a class that has them and a method that is `constrained`, friction a splitting of full order for separable Hamiltonians.

symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
symplectic::tableau! { Nystrom { base: mclachlan-atela-1992-order-4-optimal } }

use symplectic::constraints::{Constrained, Gradients, HolonomicConstraints, NonholonomicConstraints};
use symplectic::friction::{Damped, Friction};
use symplectic::nalgebra::SVector;
use symplectic::{Error, Hamiltonian, Integrator, Scalar, Separable, State};

/// H = p²/2 on the circle |q| = 1.
struct Circle;

impl Hamiltonian for Circle {
    type Class = Constrained<Separable>;
    type Vector<T: Scalar> = SVector<T, 2>;

    fn velocity<T: Scalar>(&self, _: T, _: &SVector<T, 2>, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _: T, _: &SVector<T, 2>, _: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        force.fill(T::zero());
    }
}

/// q'' = −q − q'/5
struct Oscillator;

impl Hamiltonian for Oscillator {
    type Class = Damped;
    type Vector<T: Scalar> = SVector<T, 1>;

    fn velocity<T: Scalar>(&self, _: T, _: &SVector<T, 1>, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _: T, q: &SVector<T, 1>, _: &SVector<T, 1>, force: &mut SVector<T, 1>) {
        *force = -q;
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn Friction<SVector<T, 1>>> {
        Some(self)
    }
}

impl<T: Scalar> Friction<SVector<T, 1>> for Oscillator {
    fn friction(&self, _component: usize) -> f64 {
        0.2
    }
}

// Its class is `Separable`.
symplectic::hamiltonian! { Free q: [x], p: [px]; H = px^2/2 }

impl<T: Scalar> HolonomicConstraints<SVector<T, 1>> for Free {
    fn constraints(&self) -> usize {
        1
    }

    fn constraint_values(&self, q: &SVector<T, 1>, values: &mut [T]) {
        values[0] = q[0];
    }

    fn constraint_gradients(&self, _: &SVector<T, 1>, gradients: &mut Gradients<T>) {
        gradients.set(0, 0, T::one());
    }
}

impl<T: Scalar> NonholonomicConstraints<SVector<T, 1>> for Free {
    fn nonholonomic_constraints(&self) -> usize {
        1
    }

    fn nonholonomic_rows(&self, _: &SVector<T, 1>, rows: &mut Gradients<T>) {
        rows.set(0, 0, T::one());
    }
}

impl<T: Scalar> Friction<SVector<T, 1>> for Free {
    fn friction(&self, _component: usize) -> f64 {
        0.2
    }
}

fn main() -> Result<(), Error> {
    Integrator::new(Gauss2, Circle, State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.0]), 0.1)?;
    Integrator::new(Nystrom, Oscillator, State::from_arrays(0.0, [1.0], [0.0]), 0.1)?;
    Ok(())
}
