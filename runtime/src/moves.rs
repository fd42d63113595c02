//! Kicks and drifts: what a splitting is made of.

use crate::kernel::{advance, kick_and_drift, velocity};
use crate::{Coefficient, Hamiltonian, Quantity, Scalar, Span, Summation, Vector, Witness};

/// The velocity of a splitting that makes a drift.
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
    /// Whether it has been evaluated before.
    pub known: bool,
}

/// The force of a splitting that makes kicks.
#[derive(Clone, Copy, Debug)]
pub struct Force {
    /// The step.
    pub span: Span,
    /// The number of its stage, from 1.
    pub stage: usize,
    /// Its time, as a fraction of the step.
    pub time: Coefficient,
}

/// How the kicks and drifts of a splitting are made: one by one, `()`, or so that they wait for the drift after them.
pub trait Moves {
    /// Evaluates the force, for the kicks that come next.
    fn force<R: Summation, V: Vector, S: Hamiltonian<V>, W: Witness>(
        &mut self,
        force: Force,
        system: &S,
        place: &mut V,
        position: &V,
        momentum: (&mut V, &mut V),
        witness: &mut W,
    );

    /// Adds `(h weight) force` to the momentum.
    fn kick<R: Summation, V: Vector, S: Hamiltonian<V>>(
        &mut self,
        h: f64,
        weight: Coefficient,
        system: &S,
        force: &mut V,
        position: &V,
        momentum: (&mut V, &mut V),
    );

    /// Evaluates the velocity, and adds it to the position.
    fn drift<R: Summation, V: Vector, S: Hamiltonian<V>, W: Witness>(
        &mut self,
        drift: Drift,
        system: &S,
        evaluations: (&mut V, &mut V),
        position: (&mut V, &mut V),
        momentum: (&mut V, &mut V),
        witness: &mut W,
    );

    /// Makes what waits: before there is another force, and in the end.
    fn settle<R: Summation, V: Vector, S: Hamiltonian<V>>(
        &mut self,
        system: &S,
        force: &mut V,
        position: &V,
        momentum: (&mut V, &mut V),
    );
}

impl Moves for () {
    #[inline(always)]
    fn force<R: Summation, V: Vector, S: Hamiltonian<V>, W: Witness>(
        &mut self,
        Force { span, stage, time }: Force,
        system: &S,
        place: &mut V,
        q: &V,
        (p, _p_low): (&mut V, &mut V),
        witness: &mut W,
    ) {
        system.force(span.at(time), q, p, place);
        witness.evaluation(Quantity::Force, stage, q, place);
    }

    #[inline(always)]
    fn kick<R: Summation, V: Vector, S: Hamiltonian<V>>(
        &mut self,
        h: f64,
        weight: Coefficient,
        _system: &S,
        force: &mut V,
        _position: &V,
        (p, p_low): (&mut V, &mut V),
    ) {
        advance::<R, V>(p, p_low, h, weight, force);
    }

    #[inline(always)]
    fn drift<R: Summation, V: Vector, S: Hamiltonian<V>, W: Witness>(
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

    #[inline(always)]
    fn settle<R: Summation, V: Vector, S: Hamiltonian<V>>(
        &mut self,
        _system: &S,
        _force: &mut V,
        _position: &V,
        _momentum: (&mut V, &mut V),
    ) {
    }
}

/// A force that has not been evaluated yet, and kicks by one force that the momentum has not been given yet: they wait for the drift
/// that comes next, which makes them on its own way through the momentum. With long vectors every way through memory counts. The
/// force too is made on this way if the system [can](Hamiltonian::kick_and_drift).
///
/// The sums are plain, and every component has the same bits as where nothing waits.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Waiting {
    force: Option<Force>,
    /// The step size and the weight of each kick: the last of a step and the first of the next, at most.
    kicks: [Option<(f64, Coefficient)>; 2],
}

impl Waiting {
    /// Evaluates the force that waits.
    #[inline(always)]
    fn evaluate<V: Vector, S: Hamiltonian<V>>(&mut self, system: &S, place: &mut V, q: &V, p: &V) {
        if let Some(Force { span, time, .. }) = self.force.take() {
            system.force(span.at(time), q, p, place);
        }
    }
}

impl Moves for Waiting {
    /// Shows no evaluation to the witness.
    #[inline(always)]
    fn force<R: Summation, V: Vector, S: Hamiltonian<V>, W: Witness>(
        &mut self,
        force: Force,
        system: &S,
        place: &mut V,
        position: &V,
        momentum: (&mut V, &mut V),
        _witness: &mut W,
    ) {
        self.settle::<R, V, S>(system, place, position, momentum);
        self.force = Some(force);
    }

    #[inline(always)]
    fn kick<R: Summation, V: Vector, S: Hamiltonian<V>>(
        &mut self,
        h: f64,
        weight: Coefficient,
        system: &S,
        force: &mut V,
        position: &V,
        momentum: (&mut V, &mut V),
    ) {
        if self.kicks[1].is_some() {
            self.settle::<R, V, S>(system, force, position, momentum);
        }
        self.kicks = [Some((h, weight)), self.kicks[0]];
    }

    #[inline(always)]
    fn drift<R: Summation, V: Vector, S: Hamiltonian<V>, W: Witness>(
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
        let factor = |(size, weight)| V::Scalar::weight(size, weight);
        let [last, first] = self.kicks.map(|kick| kick.map(factor));
        let drift = factor((drift.span.size, drift.weight));
        if let (Some(Force { span, time, .. }), Some(kick)) = (self.force, last) {
            let kicks = [first.unwrap_or(kick), kick];
            let kicks = if first.is_some() {
                &kicks[..]
            } else {
                &kicks[1..]
            };
            if system.kick_and_drift(span.at(time), (q, p), kicks, drift) {
                *self = Self::default();
                return;
            }
        }
        self.evaluate(system, force, q, p);
        self.kicks = [None; 2];
        kick_and_drift(q, p, force, [first, last], drift);
    }

    #[inline(always)]
    fn settle<R: Summation, V: Vector, S: Hamiltonian<V>>(
        &mut self,
        system: &S,
        force: &mut V,
        position: &V,
        (p, p_low): (&mut V, &mut V),
    ) {
        self.evaluate(system, force, position, p);
        let [last, first] = self.kicks;
        for (h, weight) in [first, last].into_iter().flatten() {
            advance::<R, V>(p, p_low, h, weight, force);
        }
        self.kicks = [None; 2];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Plain, acceleration};
    use nalgebra::Vector2;

    /// More kicks than a splitting has before a drift, and kicks without one.
    #[test]
    fn kicks_that_wait_are_made_as_those_that_do_not() {
        let unit = acceleration(|_time, q: &Vector2<f64>, a: &mut Vector2<f64>| *a = *q);
        let mut force = Vector2::new(0.1, -0.7);
        fn all<K: Moves>(
            mut moves: K,
            [q, q_low, p, p_low]: &mut [Vector2<f64>; 4],
            system: &impl Hamiltonian<Vector2<f64>>,
            force: &mut Vector2<f64>,
        ) {
            let span = Span {
                time: 0.0,
                size: 0.3,
            };
            for kicks in [0, 1, 2, 3, 5] {
                for kick in 0..kicks {
                    let weight = Coefficient::exact(0.25 * f64::from(kick + 1));
                    moves.kick::<Plain, _, _>(
                        span.size,
                        weight,
                        system,
                        force,
                        &*q,
                        (&mut *p, &mut *p_low),
                    );
                }
                let drift = Drift {
                    span,
                    stage: 1,
                    time: Coefficient::exact(0.5),
                    weight: Coefficient::exact(0.75),
                    known: false,
                };
                moves.drift::<Plain, _, _, _>(
                    drift,
                    system,
                    (&mut Vector2::zeros(), &mut *force),
                    (&mut *q, &mut *q_low),
                    (&mut *p, &mut *p_low),
                    &mut (),
                );
            }
            for weight in [0.5, -1.5] {
                let weight = Coefficient::exact(weight);
                moves.kick::<Plain, _, _>(
                    span.size,
                    weight,
                    system,
                    force,
                    &*q,
                    (&mut *p, &mut *p_low),
                );
            }
            for _ in 0..2 {
                moves.settle::<Plain, _, _>(system, force, &*q, (&mut *p, &mut *p_low));
            }
        }
        let zero = Vector2::zeros();
        let mut waiting = [Vector2::new(1.0, 2.0), zero, Vector2::new(3.0, 0.3), zero];
        let mut at_once = waiting;
        all(Waiting::default(), &mut waiting, &unit, &mut force);
        all((), &mut at_once, &unit, &mut force);
        assert_eq!(waiting, at_once);
    }
}
