//! The fixed-point iteration with a fallback to Newton's.

use super::linear_solver::{BandOrDense, LinearSolver};
use super::{AnalyticOrDifferences, Newton};
use symplectic_core::inside::by_stages;
use symplectic_core::output::Inside;
use symplectic_core::solver::{
    Failure, FixedPoint, Outcome, Solver, StageStorage, StageTableau, Step, StepStatistics,
    Stopping, Visit, WarmStart, Words,
};
use symplectic_core::{Quantity, Summation, System, Vector};

/// Steps that use Newton's iteration after a step in which the fixed-point iteration failed.
const PATIENCE: u32 = 16;

/// [`FixedPoint`](symplectic_core::solver::FixedPoint) with a fallback to [`Newton`], for systems that are stiff for some time.
///
/// A step in which the fixed-point iteration fails is counted as [rejected](symplectic_core::Statistics::rejected). That step and the next 16
/// use Newton's iteration. If it fails too, the error is that of Newton's iteration.
///
/// ```
/// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{Error, Integrator, State, separable};
/// use symplectic::solver::FixedPointThenNewton;
///
/// # fn main() -> Result<(), Error> {
/// // An oscillator that is stiff for a while: ω² = 1 + 10⁸ exp(−(t − 5)²).
/// let oscillator = separable::<Vector1<f64>, _, _>(
///     |_time, p, velocity| *velocity = *p,
///     |time, q, force| *force = -q * (1.0 + 1e8 * (-(time - 5.0) * (time - 5.0)).exp()),
/// );
/// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
/// let solver = <FixedPointThenNewton>::new();
/// let mut integrator = Integrator::new(Midpoint, oscillator, start, 0.01)?.with_solver(solver);
/// integrator.integrate_to(10.0)?;
/// assert!(integrator.statistics().rejected > 0);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FixedPointThenNewton<L = BandOrDense<AnalyticOrDifferences>>(Newton<L>);

impl<L> FixedPointThenNewton<L> {
    /// The solver.
    pub const fn new() -> Self {
        Self(Newton::new())
    }
}

impl<L> Default for FixedPointThenNewton<L> {
    fn default() -> Self {
        Self::new()
    }
}

/// The memory of [`FixedPointThenNewton`]: that of the fixed-point iteration and that of Newton's.
#[derive(Clone, Debug)]
pub struct FixedPointThenNewtonMemory<F, N> {
    fixed_point: F,
    newton: N,
    /// Whether the previous step used Newton's iteration.
    was_newton: bool,
    /// Number of further steps that use Newton's iteration.
    newton_steps: u32,
}

impl<V: Vector, F: StageStorage<V>, N: StageStorage<V>> StageStorage<V>
    for FixedPointThenNewtonMemory<F, N>
{
    fn like(prototype: &V) -> Self {
        Self::new(F::like(prototype), N::like(prototype))
    }

    fn anew(&self, prototype: &V) -> Self {
        Self::new(
            self.fixed_point.anew(prototype),
            self.newton.anew(prototype),
        )
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        self.fixed_point.words(visit);
        self.newton.words(visit);
        self.was_newton.words(visit);
        self.newton_steps.words(visit);
    }

    fn show_words(&self, visit: &mut Visit<'_>) {
        self.fixed_point.show_words(visit);
        self.newton.show_words(visit);
        // The visitor sees copies.
        { self.was_newton }.words(visit);
        { self.newton_steps }.words(visit);
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        let newton = self.newton.non_finite();
        newton.or_else(|| self.fixed_point.non_finite())
    }

    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        let newton = self.newton.mismatch(dimension);
        newton.or_else(|| self.fixed_point.mismatch(dimension))
    }
}

impl<F, N> FixedPointThenNewtonMemory<F, N> {
    const fn new(fixed_point: F, newton: N) -> Self {
        Self {
            fixed_point,
            newton,
            was_newton: false,
            newton_steps: 0,
        }
    }

    /// Takes a step by one of the two iterations, each of which takes its memory and its warm start.
    fn take<V: Vector>(
        &mut self,
        step: &Step<'_, V>,
        kept: WarmStart,
        mut outcome: Outcome<'_, V>,
        by_fixed_point: impl FnOnce(
            &mut F,
            WarmStart,
            Outcome<'_, V>,
        ) -> Result<StepStatistics, Failure>,
        by_newton: impl FnOnce(&mut N, WarmStart, Outcome<'_, V>) -> Result<StepStatistics, Failure>,
    ) -> Result<StepStatistics, Failure>
    where
        F: StageStorage<V>,
    {
        // A warm start is valid only if the same iteration took the previous step.
        let if_kept = |is: bool| if is { kept } else { WarmStart::default() };
        let mut rejected = 0;
        if self.newton_steps == 0 {
            let kept = if_kept(!self.was_newton);
            let taken = by_fixed_point(&mut self.fixed_point, kept, outcome.reborrow());
            if taken.is_ok() {
                self.was_newton = false;
                return taken;
            }
            // The stages have diverged: clear them.
            self.fixed_point.forget(step.q);
            (rejected, self.newton_steps) = (1, PATIENCE + 1);
        }
        self.newton_steps -= 1;
        let mut work = by_newton(&mut self.newton, if_kept(self.was_newton), outcome)?;
        self.was_newton = true;
        work.rejected = rejected;
        Ok(work)
    }
}

impl<V, S, L> Solver<V, S> for FixedPointThenNewton<L>
where
    V: Vector,
    S: System<V>,
    L: LinearSolver<V, S>,
{
    const IS_NEWTON: bool = true;

    type Memory<P: StageTableau> =
        FixedPointThenNewtonMemory<P::Stages<V>, <Newton<L> as Solver<V, S>>::Memory<P>>;

    fn memory<P: StageTableau>(plan: &P, prototype: &V) -> Self::Memory<P> {
        let newton = Newton::<L>::memory(plan, prototype);
        FixedPointThenNewtonMemory::new(plan.stages(prototype), newton)
    }

    fn take<P, R>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Self::Memory<P>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>
    where
        P: StageTableau,
        R: Summation,
        S: System<V, Class = P::Class>,
    {
        memory.take(
            step,
            kept,
            outcome,
            |stages, kept, outcome| {
                by_stages::<P, R, V, S>(step, system, stages, kept, stopping, outcome)
            },
            |newton, kept, outcome| {
                Newton::<L>::take::<P, R>(step, system, newton, kept, stopping, outcome)
            },
        )
    }

    fn extend<P: StageTableau>(memory: &Self::Memory<P>, at: Inside<'_, V>, q: &mut V, p: &mut V) {
        if memory.was_newton {
            <Newton<L> as Solver<V, S>>::extend::<P>(&memory.newton, at, q, p);
        } else {
            <FixedPoint as Solver<V, S>>::extend::<P>(&memory.fixed_point, at, q, p);
        }
    }
}
