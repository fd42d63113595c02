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
/// errors; these are counted from the tenth on while the change is above 4096 units of the start.
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

/// Changes above this many units of EPSILON of the start are not looked at further in the first sweeps: neither are they
/// the last, nor is the next one by its size alone.
const FAR: f64 = ROUNDING * ROUNDING;

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
    /// How a sweep moves them.
    type Movement: Movement;

    /// Whether a change that is down to rounding errors is the last where the next one would be down to a unit of EPSILON.
    const HASTY: bool;

    /// How many evaluations they make.
    fn evaluations(&self) -> EvaluationCounts;

    /// Whether the momenta too show that the iteration goes on: not where they are a function of the positions before.
    #[inline(always)]
    fn both<C: Class>() -> bool {
        !C::SEPARABLE
    }

    /// The largest components of the position and of the momentum at the start; infinite where every change is to be looked at.
    fn scales(&self) -> [f64; 2];

    /// Starting values; evaluations that are made once.
    fn begin(&mut self, kept: Kept);

    /// The first evaluation that is not finite although its argument is.
    fn non_finite(&mut self) -> Option<(Quantity, usize)>;

    /// The first stage, from 1, whose force is not finite: forces come first in a sweep.
    fn non_finite_force(&mut self) -> Option<usize>;

    /// One sweep over all of them.
    fn sweep(&mut self) -> Self::Movement;
}

/// How a sweep moved the stages.
pub(crate) trait Movement: Copy {
    /// By how much altogether.
    fn change(&self) -> Change;

    /// Whether it is a number, and by how much the positions moved, or the momenta where they count, is above its bound.
    fn exceeds(&self, bounds: [f64; 2], both: bool) -> bool;
}

impl Movement for Change {
    #[inline(always)]
    fn change(&self) -> Change {
        *self
    }

    #[inline(always)]
    fn exceeds(&self, [q, p]: [f64; 2], both: bool) -> bool {
        self.q.exceeds(q) || both && self.p.exceeds(p)
    }
}

/// The largest components of the position and of the momentum at the start of a step.
#[inline(always)]
pub(crate) fn scales<V: Vector>(step: &Step<'_, V>) -> [f64; 2] {
    [step.q, step.p].map(|vector| {
        let sizes = vector.as_slice().iter().map(|x| x.magnitude());
        sizes.fold(0.0, larger)
    })
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
    type Movement = Change;

    const HASTY: bool = !R::COMPENSATED;

    #[inline(always)]
    fn evaluations(&self) -> EvaluationCounts {
        P::EVALUATIONS
    }

    #[inline(always)]
    fn scales(&self) -> [f64; 2] {
        scales(self.step)
    }

    #[inline(always)]
    fn begin(&mut self, kept: Kept) {
        P::begin::<R, V, S>(self.step, self.system, self.stages, kept);
    }

    fn non_finite(&mut self) -> Option<(Quantity, usize)> {
        self.stages.non_finite()
    }

    fn non_finite_force(&mut self) -> Option<usize> {
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
    let mut kept = kept;
    loop {
        let solved = solve::<C, T>(sweeps, kept, max_iterations, &mut work);
        if solved.is_ok() || !kept.stages {
            return solved.map(|()| work);
        }
        // What the step before was like may say nothing about this one: once more without it.
        kept.stages = false;
    }
}

/// Finds the coupled stages, and adds to `work` what that took.
#[inline(always)]
fn solve<C: Class, T: Scalar>(
    sweeps: &mut impl Sweeps,
    kept: Kept,
    max_iterations: u32,
    work: &mut Work,
) -> Result<(), Failure> {
    sweeps.begin(kept);
    let counts = sweeps.evaluations();
    let made = counts.at_begin(kept);
    work.evaluations += made;
    // With stages that are kept the first sweep shows it, and the attempt without them is looked at.
    if made > 0
        && !kept.stages
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
#[inline(always)]
fn iterate<C: Class, T: Scalar, W: Sweeps>(
    sweeps: &mut W,
    max_iterations: u32,
) -> Result<u32, Failure> {
    let rounding = ROUNDING * T::EPSILON;
    let both = W::both::<C>();
    let progress = |change: &Change| match both {
        true => change.residual(),
        false => change.q.relative(),
    };
    let scales = sweeps.scales();
    let far = scales.map(|scale| FAR * T::EPSILON * scale);
    // A change that is the last with sums that are hasty. The first has none before it that would tell how fast they shrink.
    let mut enough = T::EPSILON;
    let mut smallest = f64::INFINITY;
    let mut largest = 0.0_f64;
    let mut idle = 0;
    let mut first = None;
    let mut before = None;
    for iteration in 1..=max_iterations {
        let movement = sweeps.sweep();
        let last = before.replace(movement);
        if iteration == 1 {
            first = before;
        }
        if iteration < PATIENCE && movement.exceeds(far, both) {
            enough = rounding;
            continue;
        }
        let change = movement.change();
        let residual = progress(&change);
        if W::HASTY && residual <= enough {
            return Ok(iteration);
        }
        if change.q.is_undefined() || change.p.is_undefined() {
            // In the first sweep the system has been evaluated at the start and next to it: that the state is
            // out of bounds is likelier than that the iteration is. Later it has run away.
            return Err(match last {
                None => non_finite(sweeps, &change),
                Some(last) => Failure::NoConvergence {
                    residual: progress(&last.change()),
                    iterations: iteration,
                },
            });
        }
        // Comparisons, for it is a number: `min` and `max` look whether it is.
        (smallest, idle) = if residual < smallest {
            (residual, 0)
        } else {
            (smallest, idle + 1)
        };
        largest = larger(residual, largest);
        let exact = residual == 0.0;
        let rounded = idle > 0 && C::settling(&change) <= rounding;
        let noisy = || {
            let first = first.map_or(0.0, |first: W::Movement| progress(&first.change()));
            smallest <= CONTRACTION * larger(largest, first)
                && Separable::settling(&change) <= rounding
        };
        if exact || rounded || idle >= PATIENCE && noisy() {
            return Ok(iteration);
        }
        // After the next one, should it shrink by the factor by which it has shrunk itself, comes one of next²/residual.
        if W::HASTY {
            enough = larger(Scalar::sqrt(T::EPSILON * residual), T::EPSILON);
            enough = if enough < rounding { enough } else { rounding };
        }
    }
    Err(Failure::NoConvergence {
        residual: before.map_or(f64::INFINITY, |last| progress(&last.change())),
        iterations: max_iterations,
    })
}

/// What is to blame for a first sweep that is not finite.
// A function of its own, which the stages were passed to, would keep them out of registers.
#[inline(always)]
fn non_finite(sweeps: &mut impl Sweeps, change: &Change) -> Failure {
    let part = if change.q.is_undefined() {
        Quantity::Position
    } else {
        Quantity::Momentum
    };
    let force = sweeps.non_finite_force();
    let culprit = force.map(|stage| (Quantity::Force, stage));
    let culprit = culprit.or_else(|| sweeps.non_finite());
    Failure::NonFinite {
        what: culprit.map_or(part, |(what, _)| what),
        stage: culprit.map(|(_, stage)| stage),
    }
}

/// The larger of two numbers.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
