//! Coupled stages by fixed-point iteration.

use core::marker::PhantomData;

use crate::{
    Change, Class, EvaluationCounts, Failure, Hamiltonian, Inside, Kept, Outcome, Quantity, Scalar,
    Separable, Solver, StagePlan, StageStorage, StageTableau, Step, Summation, Vector, Work,
};

/// Fixed-point iteration: sweep after sweep from the latest evaluations to new stages. It converges where the step size
/// times the Lipschitz constant of the system is small.
///
/// The iteration runs until it stagnates, for a tolerance above the rounding errors would let the energy drift
/// (Hairer, McLachlan & Razakarivony, 2008). It has settled when a sweep changes nothing, or when the change has
/// stopped shrinking and is down to rounding errors, at most 64 units of [`Scalar::EPSILON`] relative to the
/// largest position and the largest momentum: in either half for a separable system, in both for a general one
/// (see [`Class::settling`]). For a general one whose evaluations are noisier than that, it is enough that the
/// change has shrunk a thousandfold, has not shrunk further in ten sweeps, and one half is down to rounding
/// errors.
///
/// With [`Plain`](crate::Plain) sums the energy drifts anyway, and the iteration does not wait for the stagnation: it
/// ends with a change that is at most 64 units of [`Scalar::EPSILON`] if the next one, should it shrink by the same factor,
/// would be at most one.
#[derive(Clone, Copy, Debug, Default)]
pub struct FixedPoint;

/// Changes up to this many units of EPSILON can be rounding errors: one sweep rounds s products, s sums and the
/// evaluations, s ≤ 20 in practice. The change also has to have stopped shrinking, so that an iteration which still
/// gains digits below the threshold goes on.
const ROUNDING: f64 = 64.0;

/// Sweeps without progress after which a change that has shrunk by [`CONTRACTION`] counts as noise.
const PATIENCE: u32 = 10;

/// What tells an iteration that came down to its noise from one that never got anywhere.
const CONTRACTION: f64 = 1.0 / 1024.0;

impl<V: Vector, S: Hamiltonian<V>> Solver<V, S> for FixedPoint {
    type Memory<P: StageTableau> = P::Stages<V>;

    #[inline(always)]
    fn take<P, R>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut P::Stages<V>,
        kept: Kept,
        max_iterations: u32,
        outcome: Outcome<'_, V>,
    ) -> Result<Work, Failure>
    where
        P: StageTableau,
        R: Summation,
        S: Hamiltonian<V, Class = P::Class>,
    {
        by_stages::<P, R, V, S>(step, system, stages, kept, max_iterations, outcome)
    }

    fn extend<P: StageTableau>(stages: &P::Stages<V>, at: Inside, q: &mut V, p: &mut V) {
        let [velocities, forces] = P::stored(stages);
        at.add(&P::MOMENTA, P::INCREMENTS, velocities, q);
        at.add(&P::POSITIONS, P::INCREMENTS, forces, p);
    }
}

/// Takes a step stage by stage; returns what it took.
#[inline]
pub(crate) fn by_stages<P, R, V, S>(
    step: &Step<'_, V>,
    system: &S,
    stages: &mut P::Stages<V>,
    kept: Kept,
    max_iterations: u32,
    outcome: Outcome<'_, V>,
) -> Result<Work, Failure>
where
    P: StagePlan,
    R: Summation,
    V: Vector,
    S: Hamiltonian<V, Class = P::Class>,
{
    let mut sweeps = ByStages::<P, R, V, S> {
        step,
        system,
        stages: &mut *stages,
        sums: PhantomData,
    };
    let mut work = settle::<P::Class, V::Scalar>(&mut sweeps, kept, max_iterations)?;
    P::finish::<R, V, S, ()>(step, system, stages, kept, outcome, &mut ());
    work.evaluations += P::EVALUATIONS.finish;
    Ok(work)
}

/// Stages that are iterated.
pub(crate) trait Sweeps {
    /// Whether a change that is down to rounding errors is the last where the next one would be down to a unit of EPSILON.
    const HASTY: bool;

    /// How many evaluations they make.
    fn evaluations(&self) -> EvaluationCounts;

    /// The relative change by which the iteration is seen to go on.
    #[inline(always)]
    fn progress<C: Class>(change: &Change) -> f64 {
        C::progress(change)
    }

    /// Starting values; evaluations that are made once. Returns whether all of these are seen to be finite.
    fn begin(&mut self, kept: Kept) -> bool;

    /// The first evaluation that is not finite although its argument is.
    fn non_finite(&self) -> Option<(Quantity, usize)>;

    /// The first stage, from 1, whose force is not finite: forces come first in a sweep.
    fn non_finite_force(&self) -> Option<usize>;

    /// One sweep over all of them.
    fn sweep(&mut self) -> Change;
}

/// The stages of a plan, one after another.
struct ByStages<'a, P: StagePlan, R, V: Vector, S> {
    step: &'a Step<'a, V>,
    system: &'a S,
    stages: &'a mut P::Stages<V>,
    sums: PhantomData<R>,
}

impl<P, R, V, S> Sweeps for ByStages<'_, P, R, V, S>
where
    P: StagePlan,
    R: Summation,
    V: Vector,
    S: Hamiltonian<V, Class = P::Class>,
{
    const HASTY: bool = !R::COMPENSATED;

    #[inline(always)]
    fn evaluations(&self) -> EvaluationCounts {
        P::EVALUATIONS
    }

    #[inline(always)]
    fn begin(&mut self, kept: Kept) -> bool {
        P::begin::<R, V, S>(self.step, self.system, self.stages, kept);
        false
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        self.stages.non_finite()
    }

    fn non_finite_force(&self) -> Option<usize> {
        self.stages.non_finite_force()
    }

    #[inline(always)]
    fn sweep(&mut self) -> Change {
        P::sweep::<R, V, S>(self.step, self.system, self.stages)
    }
}

/// Iterates until the stages have settled; returns what that took.
#[inline(always)]
pub(crate) fn settle<C: Class, T: Scalar>(
    sweeps: &mut impl Sweeps,
    kept: Kept,
    max_iterations: u32,
) -> Result<Work, Failure> {
    let mut work = Work::default();
    let mut solved = solve::<C, T>(sweeps, kept, max_iterations, &mut work);
    if solved.is_err() && kept.stages {
        // What the step before was like may say nothing about this one: once more without it.
        let anew = Kept {
            stages: false,
            ..kept
        };
        solved = solve::<C, T>(sweeps, anew, max_iterations, &mut work);
    }
    solved.map(|()| work)
}

/// Finds the coupled stages, and adds to `work` what that took.
#[inline(always)]
fn solve<C: Class, T: Scalar>(
    sweeps: &mut impl Sweeps,
    kept: Kept,
    max_iterations: u32,
    work: &mut Work,
) -> Result<(), Failure> {
    let sound = sweeps.begin(kept);
    let counts = sweeps.evaluations();
    let made = counts.at_begin(kept);
    work.evaluations += made;
    if made > 0
        && !sound
        && let Some((what, stage)) = sweeps.non_finite()
    {
        return Err(Failure::NonFinite {
            what,
            stage: Some(stage),
        });
    }
    let solved = iterate::<C, T, _>(sweeps, max_iterations);
    let iterations = match solved {
        Ok(iterations) | Err(Failure::NoConvergence { iterations, .. }) => iterations,
        Err(Failure::NonFinite { .. } | Failure::SingularMatrix) => 1,
    };
    work.iterations += iterations;
    work.evaluations += iterations * counts.sweep;
    solved.map(|_| ())
}

/// Sweeps until stagnation; returns the number of sweeps.
///
/// A change that grows ends nothing: where the stages are many and their coupling is far from normal, it can
/// grow for many sweeps and vanish after all. A true divergence ends at the bound or overflows.
#[inline]
fn iterate<C: Class, T: Scalar, W: Sweeps>(
    sweeps: &mut W,
    max_iterations: u32,
) -> Result<u32, Failure> {
    let rounding = ROUNDING * T::EPSILON;
    let mut smallest = f64::INFINITY;
    let mut largest = 0.0_f64;
    let mut last = f64::INFINITY;
    let mut idle = 0;
    for iteration in 1..=max_iterations {
        let change = sweeps.sweep();
        let residual = W::progress::<C>(&change);
        if change.residual().is_nan() {
            // In the first sweep the system has been evaluated at the start and next to it: that the state is
            // out of bounds is likelier than that the iteration is. Later it has run away.
            if iteration > 1 {
                return Err(Failure::NoConvergence {
                    residual: last,
                    iterations: iteration,
                });
            }
            let part = if change.q.relative().is_nan() {
                Quantity::Position
            } else {
                Quantity::Momentum
            };
            let force = sweeps.non_finite_force();
            let culprit = force.map(|stage| (Quantity::Force, stage));
            let culprit = culprit.or_else(|| sweeps.non_finite());
            return Err(Failure::NonFinite {
                what: culprit.map_or(part, |(what, _)| what),
                stage: culprit.map(|(_, stage)| stage),
            });
        }
        idle = if residual < smallest { 0 } else { idle + 1 };
        smallest = smallest.min(residual);
        largest = largest.max(residual);
        let exact = residual == 0.0;
        // The next one would be residual²/last. The first has none before it that would tell how fast they shrink.
        let before = if iteration > 1 { last } else { residual };
        let small = W::HASTY
            && residual <= rounding
            && residual * residual.min(before) <= T::EPSILON * before;
        let rounded = idle > 0 && C::settling(&change) <= rounding;
        let noisy = idle >= PATIENCE
            && smallest <= CONTRACTION * largest
            && Separable::settling(&change) <= rounding;
        if exact || small || rounded || noisy {
            return Ok(iteration);
        }
        last = residual;
    }
    Err(Failure::NoConvergence {
        residual: last,
        iterations: max_iterations,
    })
}
