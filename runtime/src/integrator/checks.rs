//! What is looked at before an integrator is made or changed.

use crate::kernel::kick_and_drift;
use crate::stage::is_finite;
use crate::{Class, Error, Hamiltonian, Layout, Quantity, Scalar, State, Vector, copy};

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

/// Checks that two kicks and a drift in one pass, and one kick and a drift after them, are those by the force, in any layout, where the
/// system makes such passes.
pub(super) fn check_pass<V: Vector, S: Hamiltonian<V>>(
    system: &S,
    state: &State<V>,
    step_size: f64,
) -> Result<(), Error> {
    if !(S::UNIT_MASSES && S::Class::SEPARABLE) {
        return Ok(());
    }
    let [half, whole] = [0.5 * step_size, step_size].map(V::Scalar::from_f64);
    let passes = [
        (state.time, &[half, whole][..]),
        (state.time + step_size, &[whole]),
    ];
    let mut place = state.q.zeros_like();
    let by_force = |(time, kicks), (q, p): (&mut V, &mut V), force: &mut V| {
        system.force(V::Scalar::from_f64(time), q, p, force);
        kick_and_drift(q, p, force, kicks, whole);
    };
    let State { mut q, mut p, .. } = state.clone();
    for pass in passes {
        by_force(pass, (&mut q, &mut p), &mut place);
    }
    let State {
        q: of_q, p: of_p, ..
    } = &mut state.clone();
    for in_layout in [false, true] {
        copy(of_q, &state.q);
        copy(of_p, &state.p);
        let layout = match in_layout {
            true => (system.layout(of_q.as_slice(), of_p.as_slice())).within(place.dimension()),
            false => Layout::NATURAL,
        };
        if in_layout && layout.is_natural() {
            break;
        }
        layout.put_vectors((of_q, of_p), &mut place);
        for (time, kicks) in passes {
            let at = V::Scalar::from_f64(time);
            let places = (of_q.as_mut_slice(), of_p.as_mut_slice());
            if !system.kick_and_drift(at, places, layout, kicks, whole) {
                layout.put_vectors_back((of_q, of_p), &mut place);
                by_force((time, kicks), (of_q, of_p), &mut place);
                layout.put_vectors((of_q, of_p), &mut place);
            }
        }
        layout.put_vectors_back((of_q, of_p), &mut place);
        let differing = first_difference(of_p, &p).or_else(|| first_difference(of_q, &q));
        if let Some((component, of_pass, expected)) = differing {
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

/// Components that are compared at once.
const BLOCK: usize = 1 << 6;

/// The first component in which two vectors differ, and how large it is in them; none where both are not finite, which is an error of
/// the first step.
fn first_difference<V: Vector>(left: &V, right: &V) -> Option<(usize, f64, f64)> {
    if left.dimension() != right.dimension() {
        // An error of the first step, too.
        return None;
    }
    let (left, right) = (left.as_slice(), right.as_slice());
    // Most are the same, which is seen for many at once.
    let same = |(left, right): (&[_], &[_])| {
        (left.iter().zip(right)).fold(true, |same, (left, right)| same & (left == right))
    };
    let blocks = left.chunks(BLOCK).zip(right.chunks(BLOCK));
    let begin = BLOCK * blocks.take_while(|&blocks| same(blocks)).count();
    let pairs = left.iter().zip(right).skip(begin);
    let differ = |(_, (left, right)): &(usize, (&V::Scalar, &V::Scalar))| {
        left != right && (left.is_finite() || right.is_finite())
    };
    let (component, (left, right)) = pairs.enumerate().find(differ)?;
    Some((begin + component, left.magnitude(), right.magnitude()))
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
