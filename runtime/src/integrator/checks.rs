//! What is looked at before an integrator is made or changed.

use crate::kernel::kick_and_drift;
use crate::stage::is_finite;
use crate::{Error, Hamiltonian, Quantity, Scalar, State, Vector};

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
    let pairs = velocity.as_slice().iter().zip(p.as_slice());
    for (component, (&velocity, &momentum)) in pairs.enumerate() {
        if velocity != momentum {
            return Err(Error::NotUnitMasses {
                component,
                velocity: velocity.magnitude(),
                momentum: momentum.magnitude(),
            });
        }
    }
    Ok(())
}

/// Checks that kicks and a drift in one pass are those by the force, where the system makes such a pass.
pub(super) fn check_pass<V: Vector, S: Hamiltonian<V>>(
    system: &S,
    state: &State<V>,
    step_size: f64,
) -> Result<(), Error> {
    let State { time, q, p } = state;
    let time = V::Scalar::from_f64(*time);
    let [half, whole] = [0.5 * step_size, step_size].map(V::Scalar::from_f64);
    let (mut q_pass, mut p_pass) = (q.clone(), p.clone());
    if !S::UNIT_MASSES
        || !system.kick_and_drift(time, (&mut q_pass, &mut p_pass), &[half, whole], whole)
    {
        return Ok(());
    }
    let (mut q, mut p, mut force) = (q.clone(), p.clone(), q.zeros_like());
    system.force(time, &q, &p, &mut force);
    let kicks = [Some(half), Some(whole)];
    kick_and_drift(&mut q, &mut p, &force, kicks, whole);
    for (of_pass, expected) in [(&p_pass, &p), (&q_pass, &q)] {
        let pairs = of_pass.as_slice().iter().zip(expected.as_slice());
        for (component, (&of_pass, &expected)) in pairs.enumerate() {
            // A force that is not finite is an error of the first step.
            if of_pass != expected && (of_pass.is_finite() || expected.is_finite()) {
                return Err(Error::NotTheSameForce {
                    component,
                    of_pass: of_pass.magnitude(),
                    expected: expected.magnitude(),
                });
            }
        }
    }
    Ok(())
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
