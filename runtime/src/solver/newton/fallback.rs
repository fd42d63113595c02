//! The fixed-point iteration with a fallback to Newton's.

use core::fmt;

use super::linear_solver::{BandOrDense, LinearSolver};
use super::{AnalyticOrDifferences, Newton, memory::NewtonMemory};
use crate::error::Quantity;
use crate::method::{
    Failure, Inside, Outcome, Solver, StageStorage, StageTableau, Step, StepStatistics, Stopping,
    WarmStart,
};
use crate::number::words::words;
use crate::number::{Summation, Vector, Visit};
use crate::solver::FixedPoint;
use crate::solver::fixed_point::by_stages;
use crate::system::System;

/// Steps that use Newton's iteration after a step in which the fixed-point iteration failed.
const PATIENCE: u32 = 16;

/// [`FixedPoint`](crate::solver::FixedPoint) with a fallback to [`Newton`], for systems that are stiff for some time.
///
/// A step in which the fixed-point iteration fails is counted as [rejected](crate::Statistics::rejected). That step and the next 16
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

/// The memory of [`FixedPointThenNewton`] for the method `P`.
pub struct FixedPointThenNewtonMemory<
    V: Vector,
    P: StageTableau,
    S: System<V>,
    L: LinearSolver<V, S>,
> {
    fixed_point: P::Stages<V>,
    newton: NewtonMemory<V, P, S, L>,
    /// Whether the previous step used Newton's iteration.
    was_newton: bool,
    /// Number of further steps that use Newton's iteration.
    newton_steps: u32,
}

impl<V: Vector, P: StageTableau, S: System<V>, L: LinearSolver<V, S>> Clone
    for FixedPointThenNewtonMemory<V, P, S, L>
{
    fn clone(&self) -> Self {
        Self {
            fixed_point: self.fixed_point.clone(),
            newton: self.newton.clone(),
            ..*self
        }
    }
}

impl<V: Vector, P: StageTableau, S: System<V>, L: LinearSolver<V, S>> StageStorage<V>
    for FixedPointThenNewtonMemory<V, P, S, L>
{
    fn like(prototype: &V) -> Self {
        Self {
            fixed_point: StageStorage::like(prototype),
            newton: StageStorage::like(prototype),
            was_newton: false,
            newton_steps: 0,
        }
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        self.fixed_point.words(visit);
        self.newton.words(visit);
        words!(visit: self.was_newton, self.newton_steps);
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

impl<V: Vector, P: StageTableau, S: System<V>, L: LinearSolver<V, S>> fmt::Debug
    for FixedPointThenNewtonMemory<V, P, S, L>
{
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("FixedPointThenNewtonMemory")
            .field("newton", &self.newton)
            .finish_non_exhaustive()
    }
}

impl<V, S, L> Solver<V, S> for FixedPointThenNewton<L>
where
    V: Vector,
    S: System<V>,
    L: LinearSolver<V, S>,
{
    type Memory<P: StageTableau> = FixedPointThenNewtonMemory<V, P, S, L>;

    fn take<P, R>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Self::Memory<P>,
        kept: WarmStart,
        stopping: Stopping,
        mut outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>
    where
        P: StageTableau,
        R: Summation,
        S: System<V, Class = P::Class>,
    {
        // A warm start is valid only if the same solver took the previous step.
        let if_kept = |is: bool| if is { kept } else { WarmStart::default() };
        let mut rejected = 0;
        if memory.newton_steps == 0 {
            let taken = by_stages::<P, R, V, S>(
                step,
                system,
                &mut memory.fixed_point,
                if_kept(!memory.was_newton),
                stopping,
                outcome.reborrow(),
            );
            if taken.is_ok() {
                memory.was_newton = false;
                return taken;
            }
            // The stages have diverged: clear them.
            memory.fixed_point = StageStorage::like(step.q);
            (rejected, memory.newton_steps) = (1, PATIENCE + 1);
        }
        memory.newton_steps -= 1;
        let kept = if_kept(memory.was_newton);
        let newton = &mut memory.newton;
        let mut work = Newton::<L>::take::<P, R>(step, system, newton, kept, stopping, outcome)?;
        memory.was_newton = true;
        work.rejected = rejected;
        Ok(work)
    }

    fn extend<P: StageTableau>(memory: &Self::Memory<P>, at: Inside<'_, V>, q: &mut V, p: &mut V) {
        if memory.was_newton {
            <Newton<L> as Solver<V, S>>::extend::<P>(&memory.newton, at, q, p);
        } else {
            <FixedPoint as Solver<V, S>>::extend::<P>(&memory.fixed_point, at, q, p);
        }
    }
}
