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

/// Checks that two kicks and a drift in one pass, and one kick and a drift after them, are those by the force, where the system makes
/// such passes.
pub(super) fn check_pass<V: Vector, S: Hamiltonian<V>>(
    system: &S,
    state: &State<V>,
    step_size: f64,
) -> Result<(), Error> {
    if !(S::UNIT_MASSES && S::Class::SEPARABLE) {
        return Ok(());
    }
    let [half, whole] = [0.5 * step_size, step_size].map(V::Scalar::from_f64);
    let mut of_pass = state.clone();
    for (kicks, time) in [
        (&[half, whole][..], state.time),
        (&[whole], state.time + step_size),
    ] {
        let time = V::Scalar::from_f64(time);
        let State { mut q, mut p, .. } = of_pass.clone();
        let places = (of_pass.q.as_mut_slice(), of_pass.p.as_mut_slice());
        let made = system.kick_and_drift(time, places, kicks, whole);
        if made {
            let mut force = q.zeros_like();
            system.force(time, &q, &p, &mut force);
            let kick = |number: usize| kicks.get(number).copied();
            kick_and_drift(&mut q, &mut p, &force, [kick(0), kick(1)], whole);
        }
        let differing = first_difference(&of_pass.p, &p);
        if let Some((component, of_pass, expected)) =
            differing.or_else(|| first_difference(&of_pass.q, &q))
        {
            return Err(Error::NotTheSameForce {
                component,
                of_pass,
                expected,
            });
        }
    }
    Ok(())
}

/// Checks that velocity and force at once are those one by one, where the system says so.
pub(super) fn check_slopes<V: Vector, S: Hamiltonian<V>>(
    system: &S,
    state: &State<V>,
) -> Result<(), Error> {
    if !S::SHARED_SLOPES {
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

/// The first component in which two vectors differ, and how large it is in them; none where both are not finite, which is an error of
/// the first step.
fn first_difference<V: Vector>(left: &V, right: &V) -> Option<(usize, f64, f64)> {
    if left.dimension() != right.dimension() {
        // An error of the first step, too.
        return None;
    }
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
