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

/// How the kicks and drifts of a splitting are made: one by one, `()`, or so that kicks wait for the drift after them.
pub trait Moves {
    /// Adds `(h weight) force` to the momentum.
    fn kick<R: Summation, V: Vector>(
        &mut self,
        momentum: (&mut V, &mut V),
        h: f64,
        weight: Coefficient,
        force: &V,
    );

    /// Evaluates the velocity, and adds it to the position.
    fn drift<R: Summation, V: Vector, S: Hamiltonian<V>, W: Witness>(
        &mut self,
        drift: Drift,
        system: &S,
        evaluations: (&mut V, &V),
        position: (&mut V, &mut V),
        momentum: (&mut V, &mut V),
        witness: &mut W,
    );

    /// Makes the kicks that wait: before there is another force, and in the end.
    fn settle<R: Summation, V: Vector>(&mut self, momentum: (&mut V, &mut V), force: &V);
}

impl Moves for () {
    #[inline(always)]
    fn kick<R: Summation, V: Vector>(
        &mut self,
        (p, p_low): (&mut V, &mut V),
        h: f64,
        weight: Coefficient,
        force: &V,
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
        (place, _force): (&mut V, &V),
        (q, q_low): (&mut V, &mut V),
        (p, _p_low): (&mut V, &mut V),
        witness: &mut W,
    ) {
        let slope = velocity(system, span.at(time), q, p, place, known);
        witness.evaluation(Quantity::Velocity, stage, &*p, slope);
        advance::<R, V>(q, q_low, span.size, weight, slope);
    }

    #[inline(always)]
    fn settle<R: Summation, V: Vector>(&mut self, _momentum: (&mut V, &mut V), _force: &V) {}
}

/// Kicks by one force that the momentum has not been given yet: they are given to it by the drift that comes next, on its own way
/// through the momentum. With long vectors every way through memory counts.
///
/// The sums are plain, and every component has the same bits as where nothing waits.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Waiting {
    /// The step size and the weight of each: the last of a step and the first of the next, at most.
    kicks: [Option<(f64, Coefficient)>; 2],
}

impl Moves for Waiting {
    #[inline(always)]
    fn kick<R: Summation, V: Vector>(
        &mut self,
        momentum: (&mut V, &mut V),
        h: f64,
        weight: Coefficient,
        force: &V,
    ) {
        if self.kicks[1].is_some() {
            self.settle::<R, V>(momentum, force);
        }
        self.kicks = [Some((h, weight)), self.kicks[0]];
    }

    #[inline(always)]
    fn drift<R: Summation, V: Vector, S: Hamiltonian<V>, W: Witness>(
        &mut self,
        drift: Drift,
        system: &S,
        evaluations: (&mut V, &V),
        position: (&mut V, &mut V),
        momentum: (&mut V, &mut V),
        witness: &mut W,
    ) {
        if S::UNIT_MASSES {
            let factor = |(size, weight)| V::Scalar::weight(size, weight);
            let [last, first] = self.kicks.map(|kick| kick.map(factor));
            self.kicks = [None; 2];
            let drift = factor((drift.span.size, drift.weight));
            kick_and_drift(position.0, momentum.0, evaluations.1, [first, last], drift);
        } else {
            self.settle::<R, V>((&mut *momentum.0, &mut *momentum.1), evaluations.1);
            ().drift::<R, V, S, W>(drift, system, evaluations, position, momentum, witness);
        }
    }

    #[inline(always)]
    fn settle<R: Summation, V: Vector>(&mut self, (p, p_low): (&mut V, &mut V), force: &V) {
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
        let force = Vector2::new(0.1, -0.7);
        fn all<K: Moves>(
            mut moves: K,
            [q, q_low, p, p_low]: &mut [Vector2<f64>; 4],
            system: &impl Hamiltonian<Vector2<f64>>,
            force: &Vector2<f64>,
        ) {
            let span = Span {
                time: 0.0,
                size: 0.3,
            };
            for kicks in [0, 1, 2, 3, 5] {
                for kick in 0..kicks {
                    let weight = Coefficient::exact(0.25 * f64::from(kick + 1));
                    moves.kick::<Plain, _>((&mut *p, &mut *p_low), span.size, weight, force);
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
                    (&mut Vector2::zeros(), force),
                    (&mut *q, &mut *q_low),
                    (&mut *p, &mut *p_low),
                    &mut (),
                );
            }
            for weight in [0.5, -1.5] {
                let weight = Coefficient::exact(weight);
                moves.kick::<Plain, _>((&mut *p, &mut *p_low), span.size, weight, force);
            }
            moves.settle::<Plain, _>((&mut *p, &mut *p_low), force);
            moves.settle::<Plain, _>((p, p_low), force);
        }
        let zero = Vector2::zeros();
        let mut waiting = [Vector2::new(1.0, 2.0), zero, Vector2::new(3.0, 0.3), zero];
        let mut at_once = waiting;
        all(Waiting::default(), &mut waiting, &unit, &force);
        all((), &mut at_once, &unit, &force);
        assert_eq!(waiting, at_once);
    }
}
