//! Kicks and drifts, the parts of a splitting.

use crate::error::Quantity;
use crate::method::{EvaluationObserver, Span};
use crate::number::linear_combination::{advance, kick_and_drift};
use crate::number::{Coefficient, Scalar, Summation, Vector};
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

/// How the kicks and drifts of a splitting are applied: one by one, `()`, or deferred to the next drift.
pub trait KickDrift {
    /// Evaluates the force for the next kicks.
    fn force<R: Summation, V: Vector, S: System<V>, W: EvaluationObserver>(
        &mut self,
        force: Force,
        system: &S,
        place: &mut V,
        position: &mut V,
        momentum: (&mut V, &mut V),
        witness: &mut W,
    );

    /// Adds `(h weight) force` to the momentum.
    fn kick<R: Summation, V: Vector, S: System<V>>(
        &mut self,
        h: f64,
        weight: Coefficient,
        system: &S,
        force: &mut V,
        position: &mut V,
        momentum: (&mut V, &mut V),
    );

    /// Evaluates the velocity, and adds it to the position.
    fn drift<R: Summation, V: Vector, S: System<V>, W: EvaluationObserver>(
        &mut self,
        drift: Drift,
        system: &S,
        evaluations: (&mut V, &mut V),
        position: (&mut V, &mut V),
        momentum: (&mut V, &mut V),
        witness: &mut W,
    );

    /// Applies what is deferred. Called before another force, and at the end.
    fn settle<R: Summation, V: Vector, S: System<V>>(
        &mut self,
        system: &S,
        force: &mut V,
        position: &mut V,
        momentum: (&mut V, &mut V),
    );
}

impl KickDrift for () {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force<R: Summation, V: Vector, S: System<V>, W: EvaluationObserver>(
        &mut self,
        Force { span, stage, time }: Force,
        system: &S,
        place: &mut V,
        q: &mut V,
        (p, _p_low): (&mut V, &mut V),
        witness: &mut W,
    ) {
        system.force(span.at(time), q, p, place);
        witness.evaluation(Quantity::Force, stage, q, place);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick<R: Summation, V: Vector, S: System<V>>(
        &mut self,
        h: f64,
        weight: Coefficient,
        _system: &S,
        force: &mut V,
        _position: &mut V,
        (p, p_low): (&mut V, &mut V),
    ) {
        advance::<R, V>(p, p_low, h, weight, force);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn drift<R: Summation, V: Vector, S: System<V>, W: EvaluationObserver>(
        &mut self,
        Drift {
            span,
            stage,
            time,
            weight,
            known,
        }: Drift,
        system: &S,
        (place, _force): (&mut V, &mut V),
        (q, q_low): (&mut V, &mut V),
        (p, _p_low): (&mut V, &mut V),
        witness: &mut W,
    ) {
        let slope = velocity(system, span.at(time), q, p, place, known);
        witness.evaluation(Quantity::Velocity, stage, &*p, slope);
        advance::<R, V>(q, q_low, span.size, weight, slope);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn settle<R: Summation, V: Vector, S: System<V>>(
        &mut self,
        _system: &S,
        _force: &mut V,
        _position: &mut V,
        _momentum: (&mut V, &mut V),
    ) {
    }
}

/// A deferred force and deferred kicks: the force is not yet evaluated, and the kicks by one force are not yet added to the momentum. The
/// next drift applies them in its own pass through the momentum, because with long vectors every pass through memory counts. The same pass
/// evaluates the force if the system [can](System::kick_and_drift).
///
/// The sums are plain, and every component has the same bits as without deferral.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FusedKicks {
    force: Option<Force>,
    /// The step size and the weight of each kick. Where two steps meet, there are two kicks.
    kicks: [(f64, Coefficient); 2],
    /// Number of deferred kicks.
    count: usize,
}

impl FusedKicks {
    /// Nothing is deferred.
    pub(crate) const fn new() -> Self {
        Self {
            force: None,
            kicks: [(0.0, Coefficient::exact(0.0)); 2],
            count: 0,
        }
    }

    /// The factors of the deferred kicks.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn factors<T: Scalar>(&self) -> ([T; 2], usize) {
        let factors = self.kicks.map(|(h, weight)| T::weight(h, weight));
        (factors, self.count.min(factors.len()))
    }

    /// Evaluates the deferred force.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate<V: Vector, S: System<V>>(&mut self, system: &S, place: &mut V, q: &V, p: &V) {
        if let Some(Force { span, time, .. }) = self.force.take() {
            system.force(span.at(time), q, p, place);
        }
    }
}

impl KickDrift for FusedKicks {
    /// Shows no evaluation to the witness.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force<R: Summation, V: Vector, S: System<V>, W: EvaluationObserver>(
        &mut self,
        force: Force,
        system: &S,
        place: &mut V,
        position: &mut V,
        momentum: (&mut V, &mut V),
        _witness: &mut W,
    ) {
        if self.force.is_some() || self.count > 0 {
            self.settle::<R, V, S>(system, place, position, momentum);
        }
        self.force = Some(force);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick<R: Summation, V: Vector, S: System<V>>(
        &mut self,
        h: f64,
        weight: Coefficient,
        system: &S,
        force: &mut V,
        position: &mut V,
        momentum: (&mut V, &mut V),
    ) {
        if self.count == self.kicks.len() {
            self.settle::<R, V, S>(system, force, position, momentum);
        }
        // Constant indices allow the compiler to use registers.
        match self.count {
            0 => self.kicks[0] = (h, weight),
            _ => self.kicks[1] = (h, weight),
        }
        self.count += 1;
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn drift<R: Summation, V: Vector, S: System<V>, W: EvaluationObserver>(
        &mut self,
        drift: Drift,
        system: &S,
        (velocity, force): (&mut V, &mut V),
        position: (&mut V, &mut V),
        momentum: (&mut V, &mut V),
        witness: &mut W,
    ) {
        let (q, p) = (&mut *position.0, &mut *momentum.0);
        if !S::UNIT_MASSES {
            self.settle::<R, V, S>(system, force, q, (p, &mut *momentum.1));
            return ().drift::<R, V, S, W>(
                drift,
                system,
                (velocity, force),
                position,
                momentum,
                witness,
            );
        }
        let (factors, count) = self.factors();
        let kicks = &factors[..count];
        let step = V::Scalar::weight(drift.span.size, drift.weight);
        if let (Some(Force { span, time, .. }), true) = (self.force, count > 0) {
            // Velocities are momenta, so the vector `velocity` is free.
            let state = (q.as_mut_slice(), p.as_mut_slice());
            if system.kick_and_drift(span.at(time), state, kicks, step) {
                (self.force, self.count) = (None, 0);
                return;
            }
        }
        self.evaluate(system, force, q, p);
        self.count = 0;
        kick_and_drift(q, p, force, kicks, step);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn settle<R: Summation, V: Vector, S: System<V>>(
        &mut self,
        system: &S,
        force: &mut V,
        position: &mut V,
        (p, p_low): (&mut V, &mut V),
    ) {
        self.evaluate(system, force, position, p);
        for (number, &(h, weight)) in self.kicks.iter().enumerate() {
            if number < self.count {
                advance::<R, V>(p, p_low, h, weight, force);
            }
        }
        self.count = 0;
    }
}

/// The velocity of a drift. With [unit masses](System::UNIT_MASSES) this is the momentum itself; otherwise it is `place`, which is
/// evaluated unless it is `known`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn velocity<'a, V: Vector, S: System<V>>(
    system: &S,
    time: V::Scalar,
    q: &V,
    p: &'a V,
    place: &'a mut V,
    known: bool,
) -> &'a V {
    if S::UNIT_MASSES {
        return p;
    }
    if !known {
        system.velocity(time, q, p, place);
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Plain;
    use crate::system::chain::{Bonds, Chain};
    use crate::system::{acceleration, separable};
    use nalgebra::SVector;

    /// Long enough for SIMD rows.
    type Long = SVector<f64, 40>;

    /// Bonds that pull harder with time.
    struct Pulling;

    impl Bonds for Pulling {
        fn tension<T: Scalar>(&self, time: T, stretch: T) -> T {
            stretch * stretch + time
        }
    }

    const SPAN: Span = Span {
        time: 0.25,
        size: 0.3,
    };

    /// The vectors that kicks and drifts act on.
    #[derive(Clone, Debug, PartialEq)]
    struct Places {
        q: (Long, Long),
        p: (Long, Long),
        force: Long,
    }

    impl Places {
        fn force(&mut self, kick_drift: &mut impl KickDrift, system: &impl System<Long>) {
            let force = Force {
                span: SPAN,
                stage: 1,
                time: Coefficient::exact(0.75),
            };
            let (place, p) = (&mut self.force, (&mut self.p.0, &mut self.p.1));
            kick_drift.force::<Plain, _, _, _>(force, system, place, &mut self.q.0, p, &mut ());
        }

        fn kick(
            &mut self,
            kick_drift: &mut impl KickDrift,
            system: &impl System<Long>,
            weight: f64,
        ) {
            let (weight, p) = (Coefficient::exact(weight), (&mut self.p.0, &mut self.p.1));
            let (force, q) = (&mut self.force, &mut self.q.0);
            kick_drift.kick::<Plain, _, _>(SPAN.size, weight, system, force, q, p);
        }

        fn drift(&mut self, kick_drift: &mut impl KickDrift, system: &impl System<Long>) {
            let drift = Drift {
                span: SPAN,
                stage: 1,
                time: Coefficient::exact(0.5),
                weight: Coefficient::exact(0.75),
                known: false,
            };
            let evaluations = (&mut Long::zeros(), &mut self.force);
            let (q, p) = (
                (&mut self.q.0, &mut self.q.1),
                (&mut self.p.0, &mut self.p.1),
            );
            kick_drift.drift::<Plain, _, _, _>(drift, system, evaluations, q, p, &mut ());
        }

        fn settle(&mut self, kick_drift: &mut impl KickDrift, system: &impl System<Long>) {
            let p = (&mut self.p.0, &mut self.p.1);
            kick_drift.settle::<Plain, _, _>(system, &mut self.force, &mut self.q.0, p);
        }
    }

    /// More kicks than a splitting has before a drift, forces without kicks, and kicks without a drift.
    #[test]
    fn fused_kicks_give_the_same_bits_as_separate_kicks() {
        fn all(
            mut kick_drift: impl KickDrift,
            mut places: Places,
            system: &impl System<Long>,
        ) -> Places {
            for (forces, kicks) in [
                (0, 1),
                (1, 1),
                (0, 0),
                (1, 2),
                (1, 3),
                (2, 5),
                (1, 0),
                (0, 2),
                (0, 0),
            ] {
                for _ in 0..forces {
                    places.force(&mut kick_drift, system);
                }
                for kick in 0..kicks {
                    places.kick(&mut kick_drift, system, 0.25 * f64::from(kick + 1));
                }
                places.drift(&mut kick_drift, system);
            }
            places.force(&mut kick_drift, system);
            for weight in [0.5, -1.5] {
                places.kick(&mut kick_drift, system, weight);
            }
            for _ in 0..2 {
                places.settle(&mut kick_drift, system);
            }
            places
        }
        fn check(system: &impl System<Long>) {
            let zero = Long::zeros();
            let waves = |phase: f64| Long::from_fn(|i, _| 0.1 * (i as f64 + phase).sin());
            let start = Places {
                q: (waves(0.1), zero),
                p: (waves(0.7), zero),
                force: waves(1.9),
            };
            let expected = all((), start.clone(), system);
            assert_eq!(all(FusedKicks::new(), start.clone(), system), expected);
            assert!(expected.q.0.iter().all(|q| q.is_finite()));
        }
        check(&Chain::ring(Pulling));
        check(&Chain::between_walls(Pulling));
        check(&acceleration(|time, q: &Long, a| *a = *q * time));
        check(&separable(
            |_time, p: &Long, v| *v = *p * 0.5,
            |time, q, f| *f = *q * time,
        ));
    }
}
