//! The stages of a step from the position at its start and the momentum at its start or end.

use alloc::vec::Vec;
use core::marker::PhantomData;

use num_traits::Zero;

use symplectic_core::inside::{
    Attempt, FirstFault, StagePlan, by_stages, first_mismatch, first_non_finite,
    first_non_finite_of, is_finite,
};
use symplectic_core::solver::{
    Coefficient, Coefficients, EvaluationCounts, HalfChange, Outcome, StageChange, StageStorage,
    Step, Stopping, Visit, WarmStart,
};
use symplectic_core::system::Class;
use symplectic_core::{Error, Method, Plain, Quantity, Scalar, Summation, System, Vector};

/// The stages of the step with position `step.q` at its start and momentum `step.p` at its end, or at its start if `FORWARD`. Also returns
/// the other momentum and the position at the end. `number` is the number of the step, for errors.
pub(super) fn solve<const FORWARD: bool, M: Method, S: System<V>, V: Vector>(
    system: &S,
    step: &Step<'_, V>,
    number: u64,
    stopping: Stopping,
) -> Result<(Unknowns<M, V>, [V; 2]), Error> {
    const {
        assert!(
            M::STAGES > 0,
            "the stages of a tableau at run time are not solved for from both ends: let a macro emit the method"
        );
    }
    let mut stages = Unknowns::<M, V>::like(step.q);
    let zeros = || step.q.zeros_like();
    let (mut q1, mut p) = (zeros(), zeros());
    let outcome = by_stages::<Ends<FORWARD, M, S::Class>, Plain, V, S>(
        step,
        system,
        &mut stages,
        WarmStart::default(),
        stopping,
        Outcome {
            q: &mut q1,
            q_low: &mut zeros(),
            p: &mut p,
            p_low: &mut zeros(),
        },
    );
    let attempt = Attempt::of(step, number);
    let mismatch = stages.mismatch(attempt.dimension);
    let sound = mismatch.is_none() && is_finite(&q1) && is_finite(&p);
    if outcome.is_err() || !sound {
        // The error is determined from the stages in memory.
        let observed = FirstFault::new(attempt.dimension);
        return Err(attempt.error(outcome.err(), &observed, &stages, &q1));
    }
    Ok((stages, [p, q1]))
}

/// Maps `(q0, p1)` to `(q1, p0)`, or if `FORWARD` `(q0, p0)` to `(q1, p1)`. The position and momentum of its [`Step`] are the known ones;
/// its result contains the other momentum.
struct Ends<const FORWARD: bool, M, C>(PhantomData<(M, C)>);

impl<const FORWARD: bool, M: Method, C: Class> StagePlan for Ends<FORWARD, M, C> {
    type Class = C;
    type Stages<V: Vector> = Unknowns<M, V>;

    const EVALUATIONS: EvaluationCounts = EvaluationCounts {
        begin: 0,
        start: 1,
        sweep: 2 * M::STAGES as u32,
        finish: 0,
        carried: 0,
    };

    fn begin<R: Summation, V: Vector, S: System<V, Class = C>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut Unknowns<M, V>,
        _kept: WarmStart,
    ) {
        stages.weights = Weights::new(&M::COEFFICIENTS, step.size, FORWARD);
        stages.q.iter_mut().for_each(|q| q.clone_from(step.q));
        stages.p.iter_mut().for_each(|p| p.clone_from(step.p));
        // One evaluation for all stages is enough to start the iteration.
        if let Some((first, others)) = stages.velocity.split_first_mut() {
            system.velocity(V::Scalar::from_f64(step.time), step.q, step.p, first);
            others.iter_mut().for_each(|other| other.clone_from(first));
        }
    }

    fn sweep<R: Summation, V: Vector, S: System<V, Class = C>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut Unknowns<M, V>,
    ) -> StageChange {
        let Unknowns {
            q,
            p,
            velocity,
            force,
            increment,
            weights,
            ..
        } = stages;
        let mut change = StageChange::default();
        for (q, weights) in q.iter_mut().zip(&weights.a) {
            sum(increment, weights, velocity);
            settle(q, step.q, increment, &mut change.q);
        }
        let arguments = q.iter().zip(&*p).zip(M::COEFFICIENTS.c);
        for (((q, p), &c), force) in arguments.zip(force.iter_mut()) {
            system.force(step.at(c), q, p, force);
        }
        for (p, weights) in p.iter_mut().zip(&weights.rest) {
            sum(increment, weights, force);
            settle(p, step.p, increment, &mut change.p);
        }
        let arguments = q.iter().zip(&*p).zip(M::COEFFICIENTS.c_tilde);
        for (((q, p), &c), velocity) in arguments.zip(velocity.iter_mut()) {
            system.velocity(step.at(c), q, p, velocity);
        }
        change
    }

    fn finish<R: Summation, V: Vector, S: System<V, Class = C>>(
        step: &Step<'_, V>,
        _system: &S,
        stages: &mut Unknowns<M, V>,
        _kept: WarmStart,
        outcome: Outcome<'_, V>,
    ) {
        let Unknowns {
            velocity,
            force,
            increment,
            weights,
            ..
        } = stages;
        let mut unused = HalfChange::default();
        sum(increment, &weights.b, velocity);
        settle(outcome.q, step.q, increment, &mut unused);
        sum(increment, &weights.other, force);
        settle(outcome.p, step.p, increment, &mut unused);
    }
}

/// The values and evaluations of all stages of the tableau.
#[derive(Clone)]
pub(super) struct Unknowns<M, V: Vector> {
    pub(super) q: Vec<V>,
    pub(super) p: Vec<V>,
    pub(super) velocity: Vec<V>,
    pub(super) force: Vec<V>,
    /// The increment of a stage, without its base.
    pub(super) increment: V,
    pub(super) weights: Weights<V::Scalar>,
    method: PhantomData<M>,
}

/// The coefficients times the step size.
#[derive(Clone)]
pub(super) struct Weights<T> {
    /// `h a_ij`
    pub(super) a: Vec<Vec<T>>,
    /// `−h (b̃_j − ã_ij)` from `p1`, `h ã_ij` from `p0`.
    rest: Vec<Vec<T>>,
    /// `h b_i`
    pub(super) b: Vec<T>,
    /// `−h b̃_i` from `p1`, `h b̃_i` from `p0`.
    pub(super) other: Vec<T>,
}

impl<T: Scalar> Weights<T> {
    fn new(coefficients: &Coefficients, h: f64, forward: bool) -> Self {
        let weights =
            |h: f64, list: &[Coefficient]| list.iter().map(|&c| T::weight(h, c)).collect();
        let rest = |row: &&[Coefficient]| {
            if forward {
                return weights(h, row);
            }
            let pairs = coefficients.b_tilde.iter().zip(*row);
            pairs
                .map(|(&b, &a)| T::weight(-h, difference(b, a)))
                .collect()
        };
        Self {
            a: coefficients.a.iter().map(|row| weights(h, row)).collect(),
            rest: coefficients.a_tilde.iter().map(rest).collect(),
            b: weights(h, coefficients.b),
            other: weights(if forward { h } else { -h }, coefficients.b_tilde),
        }
    }
}

/// `b − a`, accurate even if the two nearly cancel.
fn difference(b: Coefficient, a: Coefficient) -> Coefficient {
    Coefficient::exact((b.double() - a.double()) + (b.low() - a.low()))
}

impl<M: Method, V: Vector> StageStorage<V> for Unknowns<M, V> {
    fn like(prototype: &V) -> Self {
        let vectors = || (0..M::STAGES).map(|_| prototype.zeros_like()).collect();
        Self {
            q: vectors(),
            p: vectors(),
            velocity: vectors(),
            force: vectors(),
            increment: prototype.zeros_like(),
            weights: Weights::new(&M::COEFFICIENTS, 0.0, false),
            method: PhantomData,
        }
    }

    /// No data is kept for another step.
    fn words(&mut self, _visit: &mut Visit<'_>) {}

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        first_non_finite((&self.q, &self.force), (&self.p, &self.velocity))
    }

    fn non_finite_force(&self) -> Option<usize> {
        first_non_finite_of(&self.force)
    }

    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        first_mismatch(&self.force, &self.velocity, dimension)
    }
}

/// `out = Σ_j weights_j terms_j`.
pub(super) fn sum<V: Vector>(out: &mut V, weights: &[V::Scalar], terms: &[V]) {
    out.as_mut_slice().fill(V::Scalar::zero());
    for (&weight, term) in weights.iter().zip(terms) {
        let components = out.as_mut_slice().iter_mut().zip(term.as_slice());
        components.for_each(|(out, &term)| *out += weight * term);
    }
}

/// `out = base + increment`; records the change of `out` in `change`.
fn settle<V: Vector>(out: &mut V, base: &V, increment: &V, change: &mut HalfChange) {
    let ends = base.as_slice().iter().zip(increment.as_slice());
    for (out, (&base, &increment)) in out.as_mut_slice().iter_mut().zip(ends) {
        let new = base + increment;
        change.record(base, *out, new);
        *out = new;
    }
}

pub(super) fn dot<V: Vector>(a: &V, b: &V) -> V::Scalar {
    let products = a.as_slice().iter().zip(b.as_slice()).map(|(&a, &b)| a * b);
    products.fold(V::Scalar::zero(), |sum, product| sum + product)
}
