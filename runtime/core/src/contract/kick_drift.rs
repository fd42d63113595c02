//! The kicks and drifts of a splitting.

use crate::number::{Coefficient, Summation, Vector, advance};

/// How the kicks and drifts of a splitting are applied. `()` adds the force and the velocity of the system.
pub trait KickDrift {
    /// Adds `(h weight) force` to the momentum.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick<R: Summation, V: Vector>(
        &mut self,
        h: f64,
        weight: Coefficient,
        _q: &V,
        force: &V,
        (p, p_low): (&mut V, &mut V),
    ) {
        advance::<R, V>(p, p_low, h, weight, force);
    }

    /// Adds `(h weight) velocity` to the position.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn drift<R: Summation, V: Vector>(
        &mut self,
        h: f64,
        weight: Coefficient,
        velocity: &V,
        (q, q_low): (&mut V, &mut V),
    ) {
        advance::<R, V>(q, q_low, h, weight, velocity);
    }
}

impl KickDrift for () {}
