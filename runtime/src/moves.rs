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
    /// The step size and the weight of each kick, the latest one first: where two steps meet, there are two.
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
        let [later, earlier] = self.kicks.map(|kick| kick.map(factor));
        let drift = factor((drift.span.size, drift.weight));
        if let (Some(Force { span, time, .. }), Some(later)) = (self.force, later) {
            let both = [earlier.unwrap_or(later), later];
            let kicks = &both[usize::from(earlier.is_none())..];
            let state = (q.as_mut_slice(), p.as_mut_slice());
            if system.kick_and_drift(span.at(time), state, kicks, drift) {
                *self = Self::default();
                return;
            }
        }
        self.evaluate(system, force, q, p);
        self.kicks = [None; 2];
        kick_and_drift(q, p, force, [earlier, later], drift);
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
        let [later, earlier] = self.kicks;
        for (h, weight) in [earlier, later].into_iter().flatten() {
            advance::<R, V>(p, p_low, h, weight, force);
        }
        self.kicks = [None; 2];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bonds, Chain, Plain, acceleration, separable};
    use nalgebra::Vector2;

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

    /// What moves are made on.
    #[derive(Clone, Debug, PartialEq)]
    struct Places {
        q: (Vector2<f64>, Vector2<f64>),
        p: (Vector2<f64>, Vector2<f64>),
        force: Vector2<f64>,
    }

    impl Places {
        fn force(&mut self, moves: &mut impl Moves, system: &impl Hamiltonian<Vector2<f64>>) {
            let force = Force {
                span: SPAN,
                stage: 1,
                time: Coefficient::exact(0.75),
            };
            let (place, p) = (&mut self.force, (&mut self.p.0, &mut self.p.1));
            moves.force::<Plain, _, _, _>(force, system, place, &self.q.0, p, &mut ());
        }

        fn kick(
            &mut self,
            moves: &mut impl Moves,
            system: &impl Hamiltonian<Vector2<f64>>,
            weight: f64,
        ) {
            let (weight, p) = (Coefficient::exact(weight), (&mut self.p.0, &mut self.p.1));
            let (force, q) = (&mut self.force, &self.q.0);
            moves.kick::<Plain, _, _>(SPAN.size, weight, system, force, q, p);
        }

        fn drift(&mut self, moves: &mut impl Moves, system: &impl Hamiltonian<Vector2<f64>>) {
            let drift = Drift {
                span: SPAN,
                stage: 1,
                time: Coefficient::exact(0.5),
                weight: Coefficient::exact(0.75),
                known: false,
            };
            let evaluations = (&mut Vector2::zeros(), &mut self.force);
            let (q, p) = (
                (&mut self.q.0, &mut self.q.1),
                (&mut self.p.0, &mut self.p.1),
            );
            moves.drift::<Plain, _, _, _>(drift, system, evaluations, q, p, &mut ());
        }

        fn settle(&mut self, moves: &mut impl Moves, system: &impl Hamiltonian<Vector2<f64>>) {
            let p = (&mut self.p.0, &mut self.p.1);
            moves.settle::<Plain, _, _>(system, &mut self.force, &self.q.0, p);
        }
    }

    /// More kicks than a splitting has before a drift, forces without kicks, and kicks without a drift.
    #[test]
    fn what_waits_is_made_as_what_does_not() {
        fn all(
            mut moves: impl Moves,
            mut places: Places,
            system: &impl Hamiltonian<Vector2<f64>>,
        ) -> Places {
            for (forces, kicks) in [
                (0, 1),
                (1, 1),
                (1, 2),
                (1, 3),
                (2, 5),
                (1, 0),
                (0, 2),
                (0, 0),
            ] {
                for _ in 0..forces {
                    places.force(&mut moves, system);
                }
                for kick in 0..kicks {
                    places.kick(&mut moves, system, 0.25 * f64::from(kick + 1));
                }
                places.drift(&mut moves, system);
            }
            places.force(&mut moves, system);
            for weight in [0.5, -1.5] {
                places.kick(&mut moves, system, weight);
            }
            for _ in 0..2 {
                places.settle(&mut moves, system);
            }
            places
        }
        fn check(system: &impl Hamiltonian<Vector2<f64>>) {
            let zero = Vector2::zeros();
            let start = Places {
                q: (Vector2::new(0.1, 0.2), zero),
                p: (Vector2::new(0.3, 0.03), zero),
                force: Vector2::new(0.1, -0.7),
            };
            let expected = all((), start.clone(), system);
            assert_eq!(all(Waiting::default(), start, system), expected);
            assert!(expected.q.0.iter().all(|q| q.is_finite()));
        }
        check(&Chain::ring(Pulling));
        check(&Chain::between_walls(Pulling));
        check(&acceleration(|time, q: &Vector2<f64>, a| *a = *q * time));
        check(&separable(
            |_time, p: &Vector2<f64>, v| *v = *p * 0.5,
            |time, q, f| *f = *q * time,
        ));
    }
}
