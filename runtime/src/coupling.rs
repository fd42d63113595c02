//! How the stages of a step are found: in order, or by iteration.

use crate::{
    Class, Hamiltonian, Kept, Outcome, Quantity, Scalar, Separable, StagePlan, StageStorage, Step,
    Summation, Vector, Witness,
};

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Explicit {}
    impl Sealed for super::Coupled {}
}

/// Whether the stages of a [`StagePlan`] have to be solved for: [`Explicit`] or [`Coupled`]. Sealed.
pub trait Coupling: sealed::Sealed + Sized + 'static {
    /// Takes `step` and writes its result into `outcome`; returns what that took.
    ///
    /// # Errors
    ///
    /// [`Failure`], where the stages cannot be found. That the result is finite is left to the caller to check.
    fn drive<P, R, V, S>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut P::Stages<V>,
        kept: Kept,
        max_iterations: u32,
        outcome: Outcome<'_, V>,
    ) -> Result<Work, Failure>
    where
        P: StagePlan<Coupling = Self>,
        R: Summation,
        V: Vector,
        S: Hamiltonian<V, Class = P::Class>;

    /// Takes a step that failed once more and shows its evaluations to `witness`, if they are not in `stages`.
    fn observe<P, R, V, S, W>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut P::Stages<V>,
        outcome: Outcome<'_, V>,
        witness: &mut W,
    ) where
        P: StagePlan<Coupling = Self>,
        R: Summation,
        V: Vector,
        S: Hamiltonian<V, Class = P::Class>,
        W: Witness;
}

/// What a step took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Fixed-point sweeps.
    pub iterations: u32,
    /// Evaluations of a velocity or a force.
    pub evaluations: u32,
}

/// Why the stages of a step could not be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure {
    /// The iteration did not settle: [`Error::NoConvergence`](crate::Error::NoConvergence).
    NoConvergence {
        /// Relative change in the last sweep in which it was finite.
        residual: f64,
        /// Sweeps made.
        iterations: u32,
    },
    /// An evaluation at the start of the iteration is not finite: [`Error::NonFinite`](crate::Error::NonFinite).
    NonFinite {
        /// What is not finite.
        what: Quantity,
        /// The stage of the evaluation, from 1.
        stage: Option<usize>,
    },
}

impl Failure {
    /// The same in a longer step, in which there are this many stages before.
    pub(crate) fn after(self, stages: usize) -> Self {
        match self {
            Self::NonFinite { what, stage } => Self::NonFinite {
                what,
                stage: stage.map(|stage| stages + stage),
            },
            Self::NoConvergence { .. } => self,
        }
    }
}

/// Every stage is computed from the ones before it. There is no solver in the code of such a step.
#[derive(Clone, Copy, Debug)]
pub struct Explicit;

/// Some stages depend on each other and are found by fixed-point iteration.
///
/// The iteration runs until it stagnates, for a tolerance above the rounding errors would let the energy drift
/// (Hairer, McLachlan & Razakarivony, 2008). It has settled when a sweep changes nothing, or when the change has
/// stopped shrinking and is down to rounding errors, at most 64 units of [`Scalar::EPSILON`] relative to the
/// largest position and the largest momentum: in either half for a separable system, in both for a general one
/// (see [`Class::settling`]). For a general one whose evaluations are noisier than that, it is enough that the
/// change has shrunk a thousandfold, has not shrunk further in ten sweeps, and one half is down to rounding
/// errors.
#[derive(Clone, Copy, Debug)]
pub struct Coupled;

/// Changes up to this many units of EPSILON can be rounding errors: one sweep rounds s products, s sums and the
/// evaluations, s ≤ 20 in practice. The change also has to have stopped shrinking, so that an iteration which still
/// gains digits below the threshold goes on.
const ROUNDING: f64 = 64.0;

/// Sweeps without progress after which a change that has shrunk by [`CONTRACTION`] counts as noise.
const PATIENCE: u32 = 10;

/// What tells an iteration that came down to its noise from one that never got anywhere.
const CONTRACTION: f64 = 1.0 / 1024.0;

impl Coupling for Explicit {
    #[inline(always)]
    fn drive<P, R, V, S>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut P::Stages<V>,
        kept: Kept,
        _max_iterations: u32,
        outcome: Outcome<'_, V>,
    ) -> Result<Work, Failure>
    where
        P: StagePlan<Coupling = Self>,
        R: Summation,
        V: Vector,
        S: Hamiltonian<V, Class = P::Class>,
    {
        P::begin::<R, V, S>(step, system, stages, kept);
        P::finish::<R, V, S, ()>(step, system, stages, kept, outcome, &mut ());
        Ok(Work {
            iterations: 0,
            evaluations: P::EVALUATIONS.at_begin(kept) + P::EVALUATIONS.finish,
        })
    }

    fn observe<P, R, V, S, W>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut P::Stages<V>,
        outcome: Outcome<'_, V>,
        witness: &mut W,
    ) where
        P: StagePlan<Coupling = Self>,
        R: Summation,
        V: Vector,
        S: Hamiltonian<V, Class = P::Class>,
        W: Witness,
    {
        *stages = P::Stages::like(step.q);
        P::begin::<R, V, S>(step, system, stages, Kept::default());
        P::finish::<R, V, S, W>(step, system, stages, Kept::default(), outcome, witness);
    }
}

impl Coupling for Coupled {
    #[inline]
    fn drive<P, R, V, S>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut P::Stages<V>,
        kept: Kept,
        max_iterations: u32,
        outcome: Outcome<'_, V>,
    ) -> Result<Work, Failure>
    where
        P: StagePlan<Coupling = Self>,
        R: Summation,
        V: Vector,
        S: Hamiltonian<V, Class = P::Class>,
    {
        let mut work = Work::default();
        let mut solved = solve::<P, R, V, S>(step, system, stages, kept, max_iterations, &mut work);
        if solved.is_err() && kept.stages {
            // What the step before was like may say nothing about this one: once more without it.
            let anew = Kept {
                stages: false,
                ..kept
            };
            solved = solve::<P, R, V, S>(step, system, stages, anew, max_iterations, &mut work);
        }
        solved?;
        P::finish::<R, V, S, ()>(step, system, stages, kept, outcome, &mut ());
        work.evaluations += P::EVALUATIONS.finish;
        Ok(work)
    }

    fn observe<P, R, V, S, W>(
        _step: &Step<'_, V>,
        _system: &S,
        _stages: &mut P::Stages<V>,
        _outcome: Outcome<'_, V>,
        _witness: &mut W,
    ) where
        P: StagePlan<Coupling = Self>,
        R: Summation,
        V: Vector,
        S: Hamiltonian<V, Class = P::Class>,
        W: Witness,
    {
    }
}

/// Finds the coupled stages, and adds to `work` what that took.
#[inline(always)]
fn solve<P, R, V, S>(
    step: &Step<'_, V>,
    system: &S,
    stages: &mut P::Stages<V>,
    kept: Kept,
    max_iterations: u32,
    work: &mut Work,
) -> Result<(), Failure>
where
    P: StagePlan,
    R: Summation,
    V: Vector,
    S: Hamiltonian<V, Class = P::Class>,
{
    P::begin::<R, V, S>(step, system, stages, kept);
    work.evaluations += P::EVALUATIONS.at_begin(kept);
    if let Some((what, stage)) = stages.non_finite() {
        return Err(Failure::NonFinite {
            what,
            stage: Some(stage),
        });
    }
    let solved = iterate::<P, R, V, S>(step, system, stages, max_iterations);
    let iterations = match solved {
        Ok(iterations) | Err(Failure::NoConvergence { iterations, .. }) => iterations,
        Err(Failure::NonFinite { .. }) => 1,
    };
    work.iterations += iterations;
    work.evaluations += iterations * P::EVALUATIONS.sweep;
    solved.map(|_| ())
}

/// Sweeps until stagnation; returns the number of sweeps.
///
/// A change that grows ends nothing: where the stages are many and their coupling is far from normal, it can
/// grow for many sweeps and vanish after all. A true divergence ends at the bound or overflows.
#[inline]
fn iterate<P, R, V, S>(
    step: &Step<'_, V>,
    system: &S,
    stages: &mut P::Stages<V>,
    max_iterations: u32,
) -> Result<u32, Failure>
where
    P: StagePlan,
    R: Summation,
    V: Vector,
    S: Hamiltonian<V, Class = P::Class>,
{
    let rounding = ROUNDING * V::Scalar::EPSILON;
    let mut smallest = f64::INFINITY;
    let mut largest = 0.0_f64;
    let mut last = f64::INFINITY;
    let mut idle = 0;
    for iteration in 1..=max_iterations {
        let change = P::sweep::<R, V, S>(step, system, stages);
        let residual = change.residual();
        if residual.is_nan() {
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
            let culprit = stages.non_finite();
            return Err(Failure::NonFinite {
                what: culprit.map_or(part, |(what, _)| what),
                stage: culprit.map(|(_, stage)| stage),
            });
        }
        idle = if residual < smallest { 0 } else { idle + 1 };
        smallest = smallest.min(residual);
        largest = largest.max(residual);
        let exact = residual == 0.0;
        let rounded = idle > 0 && P::Class::settling(&change) <= rounding;
        let noisy = idle >= PATIENCE
            && smallest <= CONTRACTION * largest
            && Separable::settling(&change) <= rounding;
        if exact || rounded || noisy {
            return Ok(iteration);
        }
        last = residual;
    }
    Err(Failure::NoConvergence {
        residual: last,
        iterations: max_iterations,
    })
}
