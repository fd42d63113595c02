//! Friction: systems of class [`Damped`] and the steps of splittings for them.

use core::marker::PhantomData;
use core::slice;

use num_traits::Float;
use symplectic_core::inside::{
    EvaluationObserver, Evaluations, KickDrift, Plan, add, add_products, larger_or_nan, same,
    same_mut,
};
use symplectic_core::proved::{LowerOrder, Splits};
use symplectic_core::solver::{
    Coefficient, Failure, FixedPoint, Outcome, Solver, StageStorage, Step, StepStatistics,
    Stopping, Visit, WarmStart,
};
use symplectic_core::system::{
    Class, FreePositionsOrDamped, HolonomicOrDamped, Masses, NotGeneral, SeparableOrDamped,
    SplitClass, UnconstrainedOrDamped,
};
use symplectic_core::{
    Error, Method, ProvedFor, Quantity, Scalar, Separable, Summation, System, Vector,
};

/// The class of a separable Hamiltonian with linear friction: `p' = −∂H/∂q − γp`, with a rate γ for each component. More generally, the
/// friction may be any force of positions and momenta whose flow at a fixed position is known. The system gives it by [`Friction`].
///
/// Splittings whose order is proved for separable Hamiltonians step such systems, with the exact flow of the friction in
/// every kick. The order is preserved. If all γ are equal, a step of size h shrinks dq∧dp and the momentum maps of symmetries of H by
/// `e^{−γh}` exactly. Negative kicks grow by `e^{γ|τ|}`, see [`friction_growth`]: for stiff friction choose a
/// method whose kicks are positive. For any other method [`Integrator::new`](symplectic_core::Integrator#method.new) does not compile; there any
/// friction can be part of [`Hamiltonian::force`](symplectic_core::Hamiltonian::force) of a system of class [`General`](symplectic_core::General).
///
/// ```compile_fail,E0277
/// use symplectic::{Integrator, State};
///
/// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
/// symplectic::hamiltonian! { Pendulum { gamma } q: [a], p: [pa]; H = pa^2/2 - cos(a) friction: gamma }
///
/// let start = State::from_arrays(0.0, [1.0], [0.0]);
/// let integrator = Integrator::new(Gauss2, Pendulum::new(0.1), start, 0.1);
/// # assert!(integrator.is_ok());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Damped;

impl SplitClass for Damped {}

impl UnconstrainedOrDamped for Damped {}

impl HolonomicOrDamped for Damped {}

impl FreePositionsOrDamped for Damped {}

impl SeparableOrDamped for Damped {}

impl NotGeneral for Damped {}

impl<M: Splits> ProvedFor<Damped> for LowerOrder<M> {}

/// The friction of a system of class [`Damped`]. It is implemented for the vectors of every scalar:
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::friction::{Damped, Friction};
/// use symplectic::{Error, Hamiltonian, Integrator, Scalar, State};
///
/// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
///
/// /// An oscillator with friction: q'' = −q − q'/5.
/// struct Oscillator;
///
/// impl Hamiltonian for Oscillator {
///     type Class = Damped;
///     type Vector<T: Scalar> = SVector<T, 1>;
///
///     fn velocity<T: Scalar>(&self, _: T, _: &SVector<T, 1>, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
///         *velocity = *p;
///     }
///
///     fn force<T: Scalar>(&self, _: T, q: &SVector<T, 1>, _: &SVector<T, 1>, force: &mut SVector<T, 1>) {
///         *force = -q;
///     }
///
///     fn extra<T: Scalar>(&self) -> Option<&dyn Friction<SVector<T, 1>>> {
///         Some(self)
///     }
/// }
///
/// impl<T: Scalar> Friction<SVector<T, 1>> for Oscillator {
///     fn friction(&self, _component: usize) -> f64 {
///         0.2
///     }
/// }
///
/// # fn main() -> Result<(), Error> {
/// let start = State::from_arrays(0.0, [1.0], [0.0]);
/// let mut run = Integrator::new(StoermerVerlet, Oscillator, start, 0.01)?;
/// let end = run.integrate_to(10.0)?;
/// let (rate, frequency) = (0.1_f64, 0.99_f64.sqrt());
/// let exact = (-rate * 10.0).exp() * ((frequency * 10.0).cos() + rate / frequency * (frequency * 10.0).sin());
/// assert!((end.q[0] - exact).abs() < 1e-4);
/// # Ok(())
/// # }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not give its friction over the vectors `{V}`",
    label = "implement `Friction` for the vectors of every scalar"
)]
pub trait Friction<V: Vector>: of_class::Damped<V> {
    /// The rate γ of the friction `−γp` of a component of the momentum, per unit of time.
    fn friction(&self, component: usize) -> f64;

    /// The flow of `p' = force + f(q, p)` at a fixed position. f is any force of positions and momenta whose flow is known. Writes
    /// `p(duration) − p` into `change` and returns `true`. If it returns `false`, kicks use the rates of [`friction`](Self::friction).
    ///
    /// `duration` may be negative. The force of the system does not include f here. For output between the steps, write f into
    /// [`applied_force`](symplectic_core::Hamiltonian::applied_force), with `FORCED = true`.
    ///
    /// ```
    /// use symplectic::nalgebra::SVector;
    /// use symplectic::friction::{Damped, Friction};
    /// use symplectic::{Error, Hamiltonian, Integrator, Scalar, State};
    ///
    /// symplectic::tableau! { StrangSplitting { base: velocity-verlet } }
    ///
    /// /// A ball in free flight with the drag −p|p|/10, without a potential: the flow of the drag is p/(1 + |p|τ/10).
    /// struct Ball;
    ///
    /// type Vector1<T> = SVector<T, 1>;
    ///
    /// impl Hamiltonian for Ball {
    ///     type Class = Damped;
    ///     type Vector<T: Scalar> = Vector1<T>;
    ///
    ///     fn velocity<T: Scalar>(&self, _: T, _: &Vector1<T>, p: &Vector1<T>, velocity: &mut Vector1<T>) {
    ///         *velocity = *p;
    ///     }
    ///
    ///     fn force<T: Scalar>(&self, _: T, _: &Vector1<T>, _: &Vector1<T>, force: &mut Vector1<T>) {
    ///         force[0] = T::zero();
    ///     }
    ///
    ///     fn extra<T: Scalar>(&self) -> Option<&dyn Friction<Vector1<T>>> {
    ///         Some(self)
    ///     }
    /// }
    ///
    /// impl<T: Scalar> Friction<Vector1<T>> for Ball {
    ///     fn friction(&self, _component: usize) -> f64 {
    ///         0.0
    ///     }
    ///
    ///     fn kick(
    ///         &self,
    ///         duration: T,
    ///         _q: &Vector1<T>,
    ///         _force: &Vector1<T>,
    ///         p: &Vector1<T>,
    ///         change: &mut Vector1<T>,
    ///     ) -> bool {
    ///         let loss = p[0].abs() * duration * T::from_f64(0.1);
    ///         change[0] = -p[0] * loss / (loss + T::one());
    ///         true
    ///     }
    /// }
    ///
    /// # fn main() -> Result<(), Error> {
    /// let start = State::from_arrays(0.0, [0.0], [2.0]);
    /// let mut run = Integrator::new(StrangSplitting, Ball, start, 0.01)?;
    /// // p = 2/(1 + t/5), q = 10 ln(1 + t/5)
    /// let end = run.integrate_to(5.0)?;
    /// assert!((end.p[0] - 1.0).abs() < 1e-14);
    /// assert!((end.q[0] - 10.0 * 2.0_f64.ln()).abs() < 1e-5);
    /// # Ok(())
    /// # }
    /// ```
    fn kick(&self, _duration: V::Scalar, _q: &V, _force: &V, _p: &V, _change: &mut V) -> bool {
        false
    }
}

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
    type Extra<'a, V: Vector> = &'a (dyn Friction<V> + 'a);
    const SEPARABLE: bool = true;
    const FRICTION: bool = true;

    fn memory<M: Method, V: Vector, S: System<V>, N: Solver<V, S>>(
        _method: &M,
        prototype: &V,
    ) -> DampedMemory<V> {
        DampedMemory::like(prototype)
    }

    fn numbers<V: Vector, S: System<V, Class = Self>>(
        system: &S,
        q: &V,
        show: &mut dyn FnMut(V::Scalar),
    ) {
        let friction = system.extra();
        for k in 0..q.dimension() {
            let rate = friction.map_or(0.0, |friction| friction.friction(k));
            show(V::Scalar::from_f64(rate));
        }
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
/// `rate` is γ, in units of 1/time, as in [`Friction::friction`]. `step_size` is h, in units of time. x
/// has no unit, and is NaN if either argument is NaN. With x = 1 a kick multiplies a momentum and its errors by e, and the positive kicks
/// of the step undo it. Keep x well below 1, by a smaller step or by a method whose kicks are positive.
///
/// ```
/// use symplectic::friction::friction_growth;
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
    let coefficients = M::COEFFICIENTS;
    let mut weights = coefficients.b_tilde.iter().map(|weight| weight.double());
    let kicks = coefficients.a.chunk_by(PartialEq::eq).map(|same| {
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
}

/// Kicks by the exact flow with the friction of a system, or by the system's own kick.
struct DampedKicks<'a, C: Vector> {
    friction: Option<&'a (dyn Friction<C> + 'a)>,
    /// The change of the momentum by a kick of the system.
    change: &'a mut C,
    /// The dimension of the first change of a wrong dimension.
    resized: &'a mut Option<usize>,
}

impl<C: Vector> KickDrift for DampedKicks<'_, C> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick<R: Summation, V: Vector>(
        &mut self,
        h: f64,
        weight: Coefficient,
        q: &V,
        force: &V,
        (p, p_low): (&mut V, &mut V),
    ) {
        let time = h * weight.double();
        // `C` and `V` are the same type.
        if let (Some(q), Some(force), Some(momentum)) = (same(q), same(force), same(&*p))
            && let duration = C::Scalar::from_f64(time)
            && let Some(friction) = self.friction
            && friction.kick(duration, q, force, momentum, self.change)
            && let Some(change) = same_mut::<C, V>(self.change)
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
        let rate = |k| self.friction.map_or(0.0, |friction| friction.friction(k));
        let momenta = p.as_mut_slice().iter_mut().zip(p_low.as_mut_slice());
        for (k, ((p, low), &force)) in momenta.zip(force.as_slice()).enumerate() {
            let exponent = -rate(k) * time;
            if exponent == 0.0 {
                // The bits of a kick without friction.
                let gain = V::Scalar::weight(h, weight);
                let (p, low) = (slice::from_mut(p), slice::from_mut(low));
                add_products::<R, V>(p, low, gain, &[force]);
                continue;
            }
            // e^{−γτ} − 1, and (1 − e^{−γτ})/γ.
            let loss = Float::exp_m1(exponent);
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

    fn words(&mut self, visit: &mut Visit<'_>) {
        self.evaluations.words(visit);
    }

    fn show_words(&self, visit: &mut Visit<'_>) {
        self.evaluations.show_words(visit);
    }

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
        let missing = Error::NoExtra {
            what: "friction",
            by: "Friction",
        };
        system.extra().map(|_| ()).ok_or(missing)
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
        let mut kick_drift = DampedKicks {
            friction: system.extra(),
            change,
            resized,
        };
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
        let mut kick_drift = DampedKicks {
            friction: system.extra(),
            change,
            resized,
        };
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
        let Some(friction) = system.extra() else {
            return;
        };
        let pairs = rate.as_mut_slice().iter_mut().zip(momentum.as_slice());
        for (k, (rate, &p)) in pairs.enumerate() {
            *rate -= V::Scalar::from_f64(friction.friction(k)) * p;
        }
        // Only a system that makes its own kicks leaves the applied force out of its force.
        let mut applied = q.zeros_like();
        let own_kicks = friction.kick(V::Scalar::from_f64(0.0), q, rate, momentum, &mut applied);
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

/// What the class of a system with friction must be.
#[doc(hidden)]
pub mod of_class {
    use symplectic_core::{System, Vector};

    /// A system of the class with friction.
    #[diagnostic::on_unimplemented(
        message = "`{Self}` has friction, but its class excludes it",
        label = "declare `type Class = Damped;`"
    )]
    pub trait Damped<V> {}

    #[diagnostic::do_not_recommend]
    impl<V: Vector, S: System<V, Class = super::Damped>> Damped<V> for S {}
}
