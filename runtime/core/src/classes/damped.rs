//! Steps of splittings for systems with linear friction.

use core::marker::PhantomData;
use core::slice;

use crate::contract::storage::stored_words;
use crate::contract::{
    Class, Damped, EvaluationObserver, Evaluations, Failure, KickDrift, Masses, Method, Outcome,
    Plan, ProvedFor, Separable, Solver, StageStorage, Step, StepStatistics, Stopping, System,
    WarmStart, check_no_constraints,
};
use crate::error::{Error, Quantity};
use crate::number::linear_combination::add_products;
use crate::number::summation::add;
use crate::number::vector::same_mut;
use crate::number::{Coefficient, Coefficients, Scalar, Summation, Vector, larger_or_nan};
use crate::solver::FixedPoint;

/// The plan of the splitting `M` for systems with linear friction `−γp`. A kick is the exact flow at a fixed position,
///
/// ```text
/// p ← e^{−γτ} p + (1 − e^{−γτ})/γ · force      τ = h b̃_i
/// ```
///
/// so the order is that for separable Hamiltonians. With one rate γ every step shrinks dq∧dp by exactly `e^{−γh}`. With several rates it
/// shrinks the volume of phase space by exactly `e^{−h tr Γ}`, where Γ is the diagonal matrix of the rates.
#[derive(Debug)]
pub struct DampedPlan<M>(PhantomData<M>);

impl Class for Damped {
    type Plan<M: Method> = DampedPlan<M>;
    const SEPARABLE: bool = true;
    const FRICTION: bool = true;

    fn memory<M: Method, V: Vector, S: System<V>, N: Solver<V, S>>(
        _method: &M,
        prototype: &V,
    ) -> DampedMemory<V> {
        DampedMemory::like(prototype)
    }
}

/// The exponent x of the largest growth `e^x` of a momentum by friction in a kick of a step:
///
/// ```text
/// x = max(0, −γ h β_1, …, −γ h β_m)
/// ```
///
/// `h β_k` is the length of kick k; β_k is the sum of the weights `b̃_i` of successive stages with the same position. For h > 0 only
/// negative kicks grow, and x is 0 if there are none. The method must support systems of class [`Damped`].
///
/// `rate` is γ, in units of 1/time, as in [`Hamiltonian::friction`](crate::Hamiltonian::friction). `step_size` is h, in units of time. x
/// has no unit, and is NaN if either argument is NaN. With x = 1 a kick multiplies a momentum and its errors by e, and the positive kicks
/// of the step undo it. Keep x well below 1, by a smaller step or by a method whose kicks are positive.
///
/// ```
/// use symplectic::friction_growth;
///
/// symplectic::tableau! {
///     StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) }
///     ForestRuth { base: forest-ruth-1990 }
/// }
///
/// assert_eq!(friction_growth(StoermerVerlet, 2.0, 0.1), 0.0);
/// // The kicks have the lengths 0.676 h, −0.176 h, −0.176 h and 0.676 h, and γh is 1.
/// assert!((friction_growth(ForestRuth, 2.0, 0.5) - 0.1756).abs() < 1e-4);
/// ```
pub fn friction_growth<M: Method + ProvedFor<Damped>>(
    _method: M,
    rate: f64,
    step_size: f64,
) -> f64 {
    let Coefficients { a, b_tilde, .. } = M::COEFFICIENTS;
    let mut weights = b_tilde.iter().map(|weight| weight.double());
    let kicks = a.chunk_by(PartialEq::eq).map(|same| {
        let weights = weights.by_ref().take(same.len());
        weights.sum::<f64>()
    });
    let growths = kicks.map(|kick| -rate * step_size * kick);
    growths.fold(0.0, larger_or_nan)
}

/// The system as a separable one; only kicks use its friction.
struct AsSeparable<'a, S>(&'a S);

impl<V: Vector, S: System<V, Class = Damped>> System<V> for AsSeparable<'_, S> {
    type Class = Separable;
    type Solver = FixedPoint;

    const MASSES: Masses = S::MASSES;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V) {
        self.0.velocity(time, q, p, velocity);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V) {
        self.0.force(time, q, p, force);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn friction(&self, component: usize) -> f64 {
        self.0.friction(component)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick(&self, duration: V::Scalar, q: &V, force: &V, p: &V, change: &mut V) -> bool {
        self.0.kick(duration, q, force, p, change)
    }
}

/// Kicks by the exact flow with the friction of a system, or by the system's own kick.
struct DampedKicks<'a, C> {
    /// The change of the momentum by a kick of the system.
    change: &'a mut C,
    /// The dimension of the first change of a wrong dimension.
    resized: &'a mut Option<usize>,
}

impl<C: Vector> KickDrift for DampedKicks<'_, C> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick<R: Summation, V: Vector, S: System<V>>(
        &mut self,
        h: f64,
        weight: Coefficient,
        system: &S,
        q: &V,
        force: &V,
        (p, p_low): (&mut V, &mut V),
    ) {
        let time = h * weight.double();
        // `C` and `V` are the same type.
        if let Some(change) = same_mut::<C, V>(self.change)
            && system.kick(V::Scalar::from_f64(time), q, force, p, change)
        {
            let found = change.dimension();
            if found != p.dimension() {
                self.resized.get_or_insert(found);
                return;
            }
            let momenta = p.as_mut_slice().iter_mut().zip(p_low.as_mut_slice());
            for ((p, low), &change) in momenta.zip(change.as_slice()) {
                (*p, *low) = add::<R, _>(*p, *low, 1, |_| change);
            }
            return;
        }
        let momenta = p.as_mut_slice().iter_mut().zip(p_low.as_mut_slice());
        for (k, ((p, low), &force)) in momenta.zip(force.as_slice()).enumerate() {
            let exponent = -system.friction(k) * time;
            if exponent == 0.0 {
                // The bits of a kick without friction.
                let gain = V::Scalar::weight(h, weight);
                let (p, low) = (slice::from_mut(p), slice::from_mut(low));
                add_products::<R, V>(p, low, gain, &[force]);
                continue;
            }
            // e^{−γτ} − 1, and (1 − e^{−γτ})/γ.
            let loss = num_traits::Float::exp_m1(exponent);
            let gain = time * (loss / exponent);
            let (loss, gain) = (V::Scalar::from_f64(loss), V::Scalar::from_f64(gain));
            let terms = [loss * *p, gain * force, loss * *low];
            let count = if R::COMPENSATED { 3 } else { 2 };
            (*p, *low) = add::<R, _>(*p, *low, count, |j| terms[j]);
        }
    }
}

/// The memory of a step with friction.
#[derive(Clone, Debug)]
pub struct DampedMemory<V> {
    evaluations: Evaluations<V>,
    change: V,
    /// The dimension of the first change of the momentum of a wrong dimension, in the last step.
    resized: Option<usize>,
}

impl<V: Vector> StageStorage<V> for DampedMemory<V> {
    fn like(prototype: &V) -> Self {
        Self {
            evaluations: Evaluations::like(prototype),
            change: prototype.zeros_like(),
            resized: None,
        }
    }

    stored_words! { evaluations: memory; }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        None
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        let kick = self.resized.map(|found| (Quantity::Kick, 0, found));
        kick.or_else(|| self.evaluations.mismatch(dimension))
    }
}

impl<M: Method> Plan for DampedPlan<M> {
    type Class = Damped;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> = DampedMemory<V>;

    const LANEWISE: bool = true;

    fn check<V, S>(system: &S, _time: f64, _q: &V, _p: &V) -> Result<(), Error>
    where
        V: Vector,
        S: System<V, Class = Damped>,
    {
        check_no_constraints(system)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<R: Summation, V: Vector, S: System<V, Class = Damped>, N: Solver<V, S>>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut DampedMemory<V>,
        kept: WarmStart,
        _stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure> {
        let DampedMemory {
            evaluations,
            change,
            resized,
        } = memory;
        *resized = None;
        let mut kick_drift = DampedKicks { change, resized };
        let separable = AsSeparable(system);
        Ok(M::Separable::take_by::<R, V, _, _, ()>(
            step,
            &separable,
            evaluations,
            kept,
            outcome,
            &mut kick_drift,
            &mut (),
        ))
    }

    fn observe<R, V, S, N, W>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut DampedMemory<V>,
        outcome: Outcome<'_, V>,
        observer: &mut W,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = Damped>,
        N: Solver<V, S>,
        W: EvaluationObserver,
    {
        let DampedMemory {
            evaluations,
            change,
            resized,
        } = memory;
        *resized = None;
        let mut kick_drift = DampedKicks { change, resized };
        let separable = AsSeparable(system);
        let kept = WarmStart::default();
        M::Separable::take_by::<R, V, _, _, W>(
            step,
            &separable,
            evaluations,
            kept,
            outcome,
            &mut kick_drift,
            observer,
        );
    }

    fn momentum_rate<V, S>(system: &S, time: f64, q: &V, momentum: &V, rate: &mut V)
    where
        V: Vector,
        S: System<V, Class = Damped>,
    {
        system.force(V::Scalar::from_f64(time), q, momentum, rate);
        if rate.dimension() != q.dimension() {
            // Dense output refuses a rate of this dimension.
            return;
        }
        let pairs = rate.as_mut_slice().iter_mut().zip(momentum.as_slice());
        for (k, (rate, &p)) in pairs.enumerate() {
            *rate -= V::Scalar::from_f64(system.friction(k)) * p;
        }
        // Only a system that makes its own kicks leaves the applied force out of its force.
        let mut applied = q.zeros_like();
        let own_kicks = system.kick(V::Scalar::from_f64(0.0), q, rate, momentum, &mut applied);
        if S::FORCED && own_kicks {
            // A kick may have resized it.
            applied = q.zeros_like();
            system.applied_force(V::Scalar::from_f64(time), q, momentum, &mut applied);
            if applied.dimension() != q.dimension() {
                *rate = applied;
                return;
            }
            let pairs = rate.as_mut_slice().iter_mut().zip(applied.as_slice());
            pairs.for_each(|(rate, &applied)| *rate += applied);
        }
    }
}
