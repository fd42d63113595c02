//! The force of the constraints at a state.

use alloc::vec;
use alloc::vec::Vec;

use super::start::{check_start, error};
use crate::constraints::kind::with_constraints;
use crate::constraints::metric::{Metric, Point};
use crate::constraints::{Constrained, WithConstraints};
use symplectic_core::inside::{is_finite, named};
use symplectic_core::system::{Class, Unconstrained};
use symplectic_core::{Error, Quantity, Scalar, State, System, Vector};

/// The result of [`constraint_force`]: the force of the constraints at a state, and their multipliers.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstraintForce<V: Vector> {
    /// The multiplier λ of each constraint.
    pub multipliers: Vec<V::Scalar>,
    /// `−Gᵀλ`, what the constraints add to the force.
    pub force: V,
}

/// The force `−Gᵀλ` of the constraints of a system at a state on them, from `d/dt (G ∂H/∂p) = 0`:
///
/// ```text
/// G H_pp Gᵀ λ = d/dt (G ∂H/∂p)   along q' = ∂H/∂p, p' = −∂H/∂q
/// ```
///
/// So it has the order of the state, whereas the multipliers inside a step of s stages have only order s − 1 (Jay, 1996). The time
/// derivative is a difference quotient over five points. It has about twelve correct digits, and about eight if the velocity is not linear
/// in the momentum.
///
/// # Errors
///
/// [`Error::NoExtra`] if the system does not give its constraints; [`Error::InconsistentStart`] if the state is not on the constraints; [`Error::DependentConstraints`]; [`Error::NonFiniteState`];
/// [`Error::ResizedEvaluation`].
///
/// ```
/// use symplectic::constraints::constraint_force;
/// use symplectic::{Error, State};
///
/// symplectic::hamiltonian! { Pendulum q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + 9.81 y constraints: { rod = x^2 + y^2 - 1 } }
///
/// # fn main() -> Result<(), Error> {
/// // A pendulum of length 1 at its lowest point: the rod carries g + v².
/// let state = State::from_arrays(0.0, [0.0, -1.0], [2.0, 0.0]);
/// let rod = constraint_force(&Pendulum, &state)?;
/// assert!(f64::abs(rod.force[1] - (9.81 + 4.0)) < 1e-10);
/// # Ok(())
/// # }
/// ```
pub fn constraint_force<V, S, C>(system: &S, state: &State<V>) -> Result<ConstraintForce<V>, Error>
where
    V: Vector,
    S: System<V, Class = Constrained<C>>,
    C: Class + Unconstrained,
{
    let State { time, q, p } = state;
    let system = &with_constraints(system, q.dimension());
    check_start(system, *time, q, p)?;
    let mut force = q.zeros_like();
    system.force(V::Scalar::from_f64(*time), q, p, &mut force);
    let found = multipliers(system, *time, (q, p), &force);
    let (multipliers, point) = system.check(*time, found)?;
    force.as_mut_slice().fill(V::Scalar::from_f64(0.0));
    (point.gradients).subtract_transposed(&multipliers, force.as_mut_slice());
    if !is_finite(&force) {
        return Err(Error::NonFiniteState {
            what: Quantity::Force,
        });
    }
    Ok(ConstraintForce { multipliers, force })
}

/// Adds the force of the constraints to `force`. If the multipliers cannot be found, fills `force` with NaN.
pub(in crate::constraints) fn add_to_force<V: Vector, S: System<V>>(
    system: &WithConstraints<'_, V, S>,
    time: f64,
    at: (&V, &V),
    force: &mut V,
) {
    if force.dimension() != at.0.dimension() {
        // Dense output refuses it.
        return;
    }
    match multipliers(system, time, at, force) {
        Ok((multipliers, point)) => {
            (point.gradients).subtract_transposed(&multipliers, force.as_mut_slice());
        }
        Err(_) => (force.as_mut_slice()).fill(V::Scalar::from_f64(f64::NAN)),
    }
}

/// The multipliers at a state at which the force without the constraints is known.
fn multipliers<V: Vector, S: System<V>>(
    system: &WithConstraints<'_, V, S>,
    time: f64,
    (q, p): (&V, &V),
    force: &V,
) -> Result<(Vec<V::Scalar>, Point<V>), Error> {
    let (metric, mut point) = Metric::new(system, time, q, p);
    let mut scratch = core::array::from_fn(|_| q.zeros_like());
    let evaluated = metric.evaluate(system, time, (q, p), &mut point, &mut scratch);
    evaluated.map_err(|failure| named(error(failure, time), |k| system.constraint_name(k)))?;
    let mut velocity = q.zeros_like();
    system.velocity(V::Scalar::from_f64(time), q, p, &mut velocity);
    // A time in which the state changes little.
    let size = |vector: &V| {
        let sizes = vector.as_slice().iter().map(|x| x.magnitude());
        sizes.fold(0.0, f64::max)
    };
    let scales = [(size(q), size(&velocity)), (size(p), size(force))];
    let scales = scales.into_iter().filter(|&(a, b)| a > 0.0 && b > 0.0);
    let scale = scales.map(|(a, b)| a / b).fold(f64::INFINITY, f64::min);
    let scale = if scale.is_finite() { scale } else { 1.0 };
    // Balances the truncation error h⁴ and the rounding error ε/h.
    let step = num_traits::Float::powf(V::Scalar::EPSILON, 0.2) * scale * 2.0;
    let [moved_q, moved_p, moved_velocity] = &mut scratch;
    let mut gradients = point.gradients.clone();
    let mut rates = vec![V::Scalar::from_f64(0.0); system.constraints()];
    let mut sum = rates.clone();
    for (place, weight) in [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)] {
        let by = place * step;
        let along = |out: &mut V, from: &V, rate: &V| {
            let pairs = from.as_slice().iter().zip(rate.as_slice());
            for (out, (&from, &rate)) in out.as_mut_slice().iter_mut().zip(pairs) {
                *out = from + V::Scalar::from_f64(by) * rate;
            }
        };
        along(moved_q, q, &velocity);
        along(moved_p, p, force);
        let at = V::Scalar::from_f64(time + by);
        system.velocity(at, moved_q, moved_p, moved_velocity);
        gradients.evaluate(|gradients| system.constraint_gradients(moved_q, gradients));
        gradients.multiply(moved_velocity.as_slice(), &mut rates);
        let factor = V::Scalar::from_f64(weight / (12.0 * step));
        for (sum, &rate) in sum.iter_mut().zip(&rates) {
            *sum += factor * rate;
        }
    }
    point.normal.solve(&mut sum);
    Ok((sum, point))
}
