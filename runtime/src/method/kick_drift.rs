//! Kicks and drifts, the parts of a splitting.

use crate::error::Quantity;
use crate::method::{EvaluationObserver, Span};
use crate::number::linear_combination::advance;
use crate::number::{Coefficient, Summation, Vector};
use crate::system::System;

/// A velocity of a splitting and its drift.
#[derive(Clone, Copy, Debug)]
pub struct Drift {
    /// The step.
    pub span: Span,
    /// The number of its stage, from 1.
    pub stage: usize,
    /// Its time, as a fraction of the step.
    pub time: Coefficient,
    /// Its weight in the result of the step.
    pub weight: Coefficient,
    /// Whether the velocity has already been evaluated.
    pub known: bool,
}

/// A force of a splitting, for its kicks.
#[derive(Clone, Copy, Debug)]
pub struct Force {
    /// The step.
    pub span: Span,
    /// The number of its stage, from 1.
    pub stage: usize,
    /// Its time, as a fraction of the step.
    pub time: Coefficient,
}

/// How the kicks and drifts of a splitting are applied. `()` applies the force and the velocity of the system.
pub trait KickDrift {
    /// Evaluates the force, in `place`, for the next kicks.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force<V: Vector, S: System<V>, W: EvaluationObserver>(
        &mut self,
        Force { span, stage, time }: Force,
        system: &S,
        q: &V,
        p: &V,
        place: &mut V,
        witness: &mut W,
    ) {
        system.force(span.at(time), q, p, place);
        witness.evaluation(Quantity::Force, stage, q, place);
    }

    /// Adds `(h weight) force` to the momentum.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick<R: Summation, V: Vector, S: System<V>>(
        &mut self,
        h: f64,
        weight: Coefficient,
        _system: &S,
        _q: &V,
        force: &V,
        (p, p_low): (&mut V, &mut V),
    ) {
        advance::<R, V>(p, p_low, h, weight, force);
    }

    /// Evaluates the velocity, in `place`, and adds it to the position. With [unit masses](System::UNIT_MASSES) the velocity is the momentum
    /// itself.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn drift<R: Summation, V: Vector, S: System<V>, W: EvaluationObserver>(
        &mut self,
        drift: Drift,
        system: &S,
        place: &mut V,
        (q, q_low): (&mut V, &mut V),
        p: &V,
        witness: &mut W,
    ) {
        let slope = match S::UNIT_MASSES {
            true => p,
            false => {
                if !drift.known {
                    system.velocity(drift.span.at(drift.time), q, p, place);
                }
                place
            }
        };
        witness.evaluation(Quantity::Velocity, drift.stage, p, slope);
        advance::<R, V>(q, q_low, drift.span.size, drift.weight, slope);
    }
}

impl KickDrift for () {}
