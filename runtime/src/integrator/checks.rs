//! What is looked at before an integrator is made or changed.

use crate::kernel::kick_and_drift;
use crate::stage::is_finite;
use crate::{Class, Error, Hamiltonian, Quantity, Scalar, State, Vector};

pub(crate) fn check_step_size(value: f64) -> Result<(), Error> {
    if value.is_finite() && value != 0.0 {
        Ok(())
    } else {
        Err(Error::StepSize { value })
    }
}

/// Checks that the velocity is the momentum where the system says so.
pub(super) fn check_masses<V: Vector, S: Hamiltonian<V>>(
    system: &S,
    state: &State<V>,
) -> Result<(), Error> {
    if !S::UNIT_MASSES {
        return Ok(());
    }
    let State { time, q, p } = state;
    let mut velocity = p.zeros_like();
    system.velocity(V::Scalar::from_f64(*time), q, p, &mut velocity);
    first_difference(&velocity, p).map_or(Ok(()), |(component, velocity, momentum)| {
        Err(Error::NotUnitMasses {
            component,
            velocity,
            momentum,
        })
    })
}

/// Checks that kicks and a drift in one pass are those by the force, where the system makes such a pass.
pub(super) fn check_pass<V: Vector, S: Hamiltonian<V>>(
    system: &S,
    state: &State<V>,
    step_size: f64,
) -> Result<(), Error> {
    if !S::UNIT_MASSES {
        return Ok(());
    }
    let State { time, q, p } = state;
    let time = V::Scalar::from_f64(*time);
    let [half, whole] = [0.5 * step_size, step_size].map(V::Scalar::from_f64);
    let (mut q_pass, mut p_pass) = (q.clone(), p.clone());
    if !system.kick_and_drift(time, (&mut q_pass, &mut p_pass), &[half, whole], whole) {
        return Ok(());
    }
    let (mut q, mut p, mut force) = (q.clone(), p.clone(), q.zeros_like());
    system.force(time, &q, &p, &mut force);
    let kicks = [Some(half), Some(whole)];
    kick_and_drift(&mut q, &mut p, &force, kicks, whole);
    let differing = first_difference(&p_pass, &p).or_else(|| first_difference(&q_pass, &q));
    differing.map_or(Ok(()), |(component, of_pass, expected)| {
        Err(Error::NotTheSameForce {
            component,
            of_pass,
            expected,
        })
    })
}

/// Checks that velocity and force at once are those one by one, where the halves of a step may be iterated at once.
pub(super) fn check_slopes<V: Vector, S: Hamiltonian<V>>(
    system: &S,
    state: &State<V>,
) -> Result<(), Error> {
    if S::Class::SEPARABLE {
        return Ok(());
    }
    let State { time, q, p } = state;
    let time = V::Scalar::from_f64(*time);
    let blank = || (q.zeros_like(), q.zeros_like());
    let (mut slopes, mut alone) = (blank(), blank());
    system.slopes(time, q, p, (&mut slopes.0, &mut slopes.1));
    system.velocity(time, q, p, &mut alone.0);
    system.force(time, q, p, &mut alone.1);
    for (what, slopes, alone) in [
        (Quantity::Velocity, &slopes.0, &alone.0),
        (Quantity::Force, &slopes.1, &alone.1),
    ] {
        if let Some((component, at_once, alone)) = first_difference(slopes, alone) {
            return Err(Error::NotTheSameSlopes {
                what,
                component,
                at_once,
                alone,
            });
        }
    }
    Ok(())
}

/// The first component in which two vectors differ and are not both other than finite, which is an error of the first step; and how
/// large it is in them.
fn first_difference<V: Vector>(left: &V, right: &V) -> Option<(usize, f64, f64)> {
    let pairs = left.as_slice().iter().zip(right.as_slice());
    let differ = |(_, (left, right)): &(usize, (&V::Scalar, &V::Scalar))| {
        left != right && (left.is_finite() || right.is_finite())
    };
    let (component, (left, right)) = pairs.enumerate().find(differ)?;
    Some((component, left.magnitude(), right.magnitude()))
}

pub(crate) fn check_state<V: Vector>(
    time: f64,
    q: &V,
    p: &V,
    dimension: usize,
) -> Result<(), Error> {
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
