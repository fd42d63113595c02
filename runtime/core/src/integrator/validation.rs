//! Checks before an integrator is created or changed.

use crate::error::{Error, Quantity};
use crate::method::storage::is_finite;
use crate::method::{Method, Solver};
use crate::number::vector::beside;
use crate::number::{Scalar, Vector};
use crate::state::State;
use crate::system::linearity::non_linear_velocity;
use crate::system::{Class, System};

/// Checks that a step size is finite and not zero: [`Error::StepSize`].
pub fn check_step_size(value: f64) -> Result<(), Error> {
    if value.is_finite() && value != 0.0 {
        Ok(())
    } else {
        Err(Error::StepSize { value })
    }
}

/// Checks that the velocity equals the momentum if the system claims it. Tests the momentum of the state, which may be zero, and another.
pub(super) fn check_masses<V: Vector, S: System<V>>(
    system: &S,
    state: &State<V>,
) -> Result<(), Error> {
    if !S::MASSES.are_unit() {
        return Ok(());
    }
    let State { time, q, p } = state;
    let (mut other, mut velocity) = (p.clone(), p.zeros_like());
    for (k, component) in other.as_mut_slice().iter_mut().enumerate() {
        *component = V::Scalar::from_f64(0.7 * (k + 1) as f64);
    }
    for momentum in [p, &other] {
        system.velocity(V::Scalar::from_f64(*time), q, momentum, &mut velocity);
        if let Some((component, velocity, momentum)) = first_difference(&velocity, momentum) {
            return Err(Error::NotUnitMasses {
                component,
                velocity,
                momentum,
            });
        }
    }
    Ok(())
}

/// Checks the declarations of a system. If it is separable, its velocity must not read q, nor its force p. An applied force must be
/// declared.
fn check_declarations<V: Vector, S: System<V>>(
    system: &S,
    State { time, q, p }: &State<V>,
) -> Result<(), Error> {
    if S::WELL_DECLARED {
        return Ok(());
    }
    let time = V::Scalar::from_f64(*time);
    let (other_q, other_p) = (beside(q), beside(p));
    if S::Class::SEPARABLE {
        let [mut one, mut other] = [q, q].map(V::zeros_like);
        system.velocity(time, q, p, &mut one);
        system.velocity(time, &other_q, p, &mut other);
        if let Some(component) = first_clear_difference(&one, &other) {
            let what = Quantity::Velocity;
            return Err(Error::NotSeparable { what, component });
        }
        let [mut one, mut other] = [q, q].map(V::zeros_like);
        system.force(time, q, p, &mut one);
        system.force(time, q, &other_p, &mut other);
        if let Some(component) = first_clear_difference(&one, &other) {
            let what = Quantity::Force;
            return Err(Error::NotSeparable { what, component });
        }
    }
    if !S::FORCED {
        let [zero, mut applied] = [q, q].map(V::zeros_like);
        system.applied_force(time, q, &other_p, &mut applied);
        if let Some((component, ..)) = first_difference(&applied, &zero) {
            return Err(Error::NotForced { component });
        }
    }
    Ok(())
}

/// The first component in which two vectors differ by more than sums in another order could, relative to the largest component.
fn first_clear_difference<V: Vector>(left: &V, right: &V) -> Option<usize> {
    first_difference(left, right)?;
    let sizes = left.as_slice().iter().map(|x| x.magnitude());
    let bound = num_traits::Float::sqrt(V::Scalar::EPSILON) * sizes.fold(0.0, f64::max);
    let mut pairs = left.as_slice().iter().zip(right.as_slice());
    // NaN on one side is a difference.
    pairs.position(|(&left, &right)| {
        left.is_finite() != right.is_finite() || (left - right).magnitude() > bound
    })
}

/// Checks that the velocity is linear in the momentum, for a method that has its order only then.
pub(crate) fn check_quadratic_kinetic<M: Method, V: Vector, S: System<V>>(
    method: &M,
    system: &S,
    state: &State<V>,
) -> Result<(), Error> {
    let orders = method.needs_quadratic_kinetic();
    let Some(orders) = orders.filter(|_| !S::MASSES.are_unit()) else {
        return Ok(());
    };
    let State { time, q, p } = state;
    non_linear_velocity(system, *time, q, p).map_or(Ok(()), |found| {
        Err(Error::NotQuadraticKinetic {
            method: M::NAME,
            order: orders.nystrom,
            lower_order: orders.separable,
            component: found.component,
            velocity: found.velocity,
            linear: found.linear,
        })
    })
}

/// Whether the velocity is linear in the momentum, if the solver uses this.
pub(super) fn has_linear_velocity<V: Vector, S: System<V>, N: Solver<V, S>>(
    system: &S,
    state: &State<V>,
) -> bool {
    let State { time, q, p } = state;
    N::TRIES_LINEARITY
        && S::Class::SEPARABLE
        && (S::MASSES.are_unit() || non_linear_velocity(system, *time, q, p).is_none())
}

/// The first component in which two vectors differ, and its size in both. Components that are NaN or infinite in both are skipped: the
/// first step reports them as an error.
fn first_difference<V: Vector>(left: &V, right: &V) -> Option<(usize, f64, f64)> {
    if left.dimension() != right.dimension() {
        // The first step reports this error, too.
        return None;
    }
    let mut pairs = left.as_slice().iter().zip(right.as_slice()).enumerate();
    let (component, (left, right)) = pairs
        .find(|(_, (left, right))| left != right && (left.is_finite() || right.is_finite()))?;
    Some((component, left.magnitude(), right.magnitude()))
}

/// [`check_state`], that the parameters of the system fit the dimension, and that its declarations are right.
pub fn check_start<V: Vector, S: System<V>>(system: &S, state: &State<V>) -> Result<(), Error> {
    let dimension = state.q.dimension();
    check_state(state.time, &state.q, &state.p, dimension)?;
    system.check_dimension(dimension)?;
    check_declarations(system, state)
}

/// Checks that position and momentum have this dimension and that the state is finite: [`Error::Dimension`], [`Error::NonFiniteState`].
pub fn check_state<V: Vector>(time: f64, q: &V, p: &V, dimension: usize) -> Result<(), Error> {
    let (position, momentum) = (q.dimension(), p.dimension());
    if position != dimension || momentum != dimension {
        return Err(Error::Dimension { position, momentum });
    }
    let what = if !time.is_finite() {
        Quantity::Time
    } else if !is_finite(q) {
        Quantity::Position
    } else if !is_finite(p) {
        Quantity::Momentum
    } else {
        return Ok(());
    };
    Err(Error::NonFiniteState { what })
}
