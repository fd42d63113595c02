//! Tests by evaluations of the velocity whether the kinetic energy is quadratic.

use crate::contract::System;
use crate::number::{Scalar, Vector};

/// A component of a velocity that is not linear in the momentum.
pub struct NonLinear {
    /// The component, from 0.
    pub component: usize,
    /// Size of the velocity component.
    pub velocity: f64,
    /// Its size if the velocity were linear.
    pub linear: f64,
}

/// The first component in which the velocity is not linear in the momentum, or depends on time. The test evaluates it at `p`, at another
/// momentum of size at least 1, at combinations of both, and at another time.
pub fn non_linear_velocity<V: Vector, S: System<V>>(
    system: &S,
    time: f64,
    q: &V,
    p: &V,
) -> Option<NonLinear> {
    let velocity = |time: f64, momentum: &dyn Fn(usize) -> V::Scalar| {
        let (mut point, mut velocity) = (p.zeros_like(), p.zeros_like());
        for (k, component) in point.as_mut_slice().iter_mut().enumerate() {
            *component = momentum(k);
        }
        system.velocity(V::Scalar::from_f64(time), q, &point, &mut velocity);
        velocity
    };
    let number = V::Scalar::from_f64;
    let first = |k: usize| p.as_slice()[k];
    let second = |k: usize| number(0.75 * (k + 1) as f64);
    let (v, w) = (velocity(time, &first), velocity(time, &second));
    if [&v, &w].iter().any(|v| v.dimension() != p.dimension()) {
        // The first step reports this error.
        return None;
    }
    let cases = [
        (
            velocity(time, &|k| first(k) + second(k)),
            number(1.0),
            number(1.0),
        ),
        (
            velocity(time, &|k| number(-2.0) * second(k)),
            number(0.0),
            number(-2.0),
        ),
        (velocity(time + 1.0, &second), number(0.0), number(1.0)),
    ];
    let sizes = v.as_slice().iter().chain(w.as_slice());
    let largest = sizes.map(|x| x.magnitude()).fold(0.0, f64::max);
    let bound = UNITS * V::Scalar::EPSILON * largest;
    cases.iter().find_map(|(velocity, of_first, of_second)| {
        let components = velocity
            .as_slice()
            .iter()
            .zip(v.as_slice())
            .zip(w.as_slice());
        components
            .enumerate()
            .find_map(|(component, ((&velocity, &v), &w))| {
                let linear = *of_first * v + *of_second * w;
                // NaN fails the comparison.
                let near = (velocity - linear).magnitude() <= bound;
                (!near).then(|| NonLinear {
                    component,
                    velocity: velocity.magnitude(),
                    linear: linear.magnitude(),
                })
            })
    })
}

/// Allowed deviation from a linear velocity, in units of round-off of the largest component: far above the rounding errors.
const UNITS: f64 = 4096.0;
