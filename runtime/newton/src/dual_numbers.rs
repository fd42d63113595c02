//! Derivatives by dual numbers.

use num_dual::Dual64;

use super::jacobian::{Derivatives, groups, scatter};
use symplectic_core::system::Jacobian;
use symplectic_core::{Scalar, System, Vector};

/// A system over vectors of doubles and over vectors of dual numbers. Every system that is generic over the scalar implements it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a Hamiltonian system over the vectors `{V}` with dual numbers in place of doubles",
    label = "this needs a system that is written for every `Scalar`: `SeparableHamiltonian` or `Hamiltonian`"
)]
pub trait SystemInDuals<V: Vector>: System<V> + System<V::With<Dual64>> {}

impl<V: Vector, S> SystemInDuals<V> for S where S: System<V> + System<V::With<Dual64>> {}

/// Derivatives by dual numbers, which pass through the code of the system. The system must be generic over the scalar. The derivatives
/// are exact; they take one evaluation for each component or, for a band, for each of its columns.
///
/// ```
/// symplectic::tableau! { Gauss3 { basis: polynomial(3), nodes: gauss(3) } }
/// use symplectic::nalgebra::SVector;
/// use symplectic::{Error, Integrator, Scalar, SeparableHamiltonian, State};
/// use symplectic::solver::{Dense, DualNumbers, Newton};
///
/// /// H = p²/2 + 10⁸ (1 − cos q)
/// struct Stiff;
///
/// impl SeparableHamiltonian for Stiff {
///     type Vector<T: Scalar> = SVector<T, 1>;
///
///     fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
///         *velocity = *p;
///     }
///
///     fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
///         force[0] = -q[0].sin() * T::from_f64(1e8);
///     }
/// }
///
/// # fn main() -> Result<(), Error> {
/// let start = State::new(0.0, SVector::from([1e-3]), SVector::from([0.0]));
/// let newton = Newton::<Dense<DualNumbers>>::new();
/// let mut integrator = Integrator::new(Gauss3, Stiff, start, 0.01)?.with_solver(newton);
/// integrator.integrate_to(1.0)?;
/// assert!(integrator.statistics().mean_iterations() < 10.0);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct DualNumbers;

impl<V, S> Derivatives<V, S> for DualNumbers
where
    V: Vector<Scalar = f64>,
    S: SystemInDuals<V>,
{
    /// Position, momentum and an evaluation.
    type Memory = [V::With<Dual64>; 3];

    fn memory(prototype: &V) -> Self::Memory {
        core::array::from_fn(|_| prototype.zeros_with())
    }

    fn evaluate(
        [q, p, out]: &mut Self::Memory,
        system: &S,
        time: f64,
        position: &V,
        momentum: &V,
        jacobian: &mut Jacobian<f64>,
    ) {
        let time = Dual64::from_f64(time);
        let groups = groups(jacobian);
        seed(p, momentum, groups, groups);
        for group in 0..groups {
            seed(q, position, group, groups);
            System::<V::With<Dual64>>::velocity(system, time, q, p, out);
            let derivative = |i: usize| out.as_slice().get(i).map(|dual| dual.eps);
            scatter(
                &mut jacobian.velocity_by_position,
                group,
                groups,
                derivative,
            );
            System::<V::With<Dual64>>::force(system, time, q, p, out);
            let derivative = |i: usize| out.as_slice().get(i).map(|dual| dual.eps);
            scatter(&mut jacobian.force_by_position, group, groups, derivative);
        }
        seed(q, position, groups, groups);
        for group in 0..groups {
            seed(p, momentum, group, groups);
            System::<V::With<Dual64>>::velocity(system, time, q, p, out);
            let derivative = |i: usize| out.as_slice().get(i).map(|dual| dual.eps);
            scatter(
                &mut jacobian.velocity_by_momentum,
                group,
                groups,
                derivative,
            );
            if <S as System<V>>::FORCED {
                System::<V::With<Dual64>>::applied_force(system, time, q, p, out);
                let derivative = |i: usize| out.as_slice().get(i).map(|dual| dual.eps);
                scatter(
                    &mut jacobian.applied_force_by_momentum,
                    group,
                    groups,
                    derivative,
                );
            }
        }
    }
}

/// A vector with derivative 1 in every component of this group, that is, with an index equal to `group` modulo `groups`, and 0 elsewhere.
fn seed<V: Vector<Scalar = f64>>(out: &mut V::With<Dual64>, from: &V, group: usize, groups: usize) {
    let pairs = out.as_mut_slice().iter_mut().zip(from.as_slice());
    for (i, (out, &from)) in pairs.enumerate() {
        *out = Dual64::new(from, if i % groups == group { 1.0 } else { 0.0 });
    }
}
