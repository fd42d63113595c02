//! Convergence test of the Newton iteration, and the attempts of a step.

use super::linear_solver::LinearSolver;
use super::sweep::ByIncrements;
use symplectic_core::inside::{Progress, ROUNDING, STAGNATION, dither_last_sweep, non_finite};
use symplectic_core::solver::{
    Failure, HalfChange, StageChange, StageTableau, StepStatistics, Stopping, WarmStart,
};
use symplectic_core::system::Class;
use symplectic_core::{Scalar, Separable, Summation, System, Vector};

/// The change stagnates if it has not halved in this many sweeps.
///
/// In the rounded equations a change can shrink for thousands of sweeps by less than a part in a thousand. The force at a rounded
/// stage stays the same while the increments approach it.
const SLOW: u32 = 3;

/// Changes up to this multiple of the [measured](ByIncrements::noise) noise are noise: a sweep rounds at more places than there are
/// arguments.
const NOISY: f64 = 16.0;

/// Changes below this many units of EPSILON count as equal: a component that should be zero may shrink to 10⁻³⁰⁰.
const FLOOR: f64 = 0.25;

/// Maximal number of noise measurements in one attempt.
const MAX_MEASUREMENTS: u32 = 4;

/// Maximal number of sweeps of an attempt with the derivatives at one point, if those at every stage are available.
pub(super) const MAX_SWEEPS: u32 = 16;

/// Steps that use the derivatives at every stage after a step that needed them.
const STEPS_IN_FULL: u32 = 16;

/// The starting values of an iteration, and the derivatives that it uses.
#[derive(Clone, Copy)]
pub(super) struct Attempt {
    /// Whether it starts from the stages of the previous step.
    pub(super) kept: bool,
    /// Whether it uses the derivatives at every stage, again in every sweep.
    pub(super) in_full: bool,
    /// Whether another attempt follows.
    gives_up: bool,
}

/// The attempts of a step, in order. Starting values: the stages of the previous step, if they are kept, then the start of the step.
/// Both use the derivatives at one point. A last attempt from the start of the step uses those at every stage, if `available`.
/// With `in_full`, all attempts use the derivatives at every stage.
fn attempts(kept: bool, in_full: bool, available: bool) -> impl Iterator<Item = Attempt> {
    let all = [(true, false), (true, true), (false, false), (false, true)];
    let attempts = all.into_iter().filter(move |&(from_kept, full)| {
        (kept || !from_kept) && (full == in_full || full && !from_kept && available)
    });
    attempts.map(move |(kept, in_full)| Attempt {
        kept,
        in_full,
        gives_up: available && !in_full,
    })
}

/// Iterates until the stages have settled; returns the statistics of the step.
pub(super) fn settle<P, R, V, S, L>(
    sweeps: &mut ByIncrements<'_, P, R, V, S, L>,
    kept: WarmStart,
    stopping: Stopping,
) -> Result<StepStatistics, Failure>
where
    P: StageTableau,
    R: Summation,
    V: Vector,
    S: System<V, Class = P::Class>,
    L: LinearSolver<V, S>,
{
    let mut work = StepStatistics::default();
    let steps_in_full = sweeps.steps_in_full();
    let was_in_full = *steps_in_full > 0;
    *steps_in_full = steps_in_full.saturating_sub(1);
    let mut failure = None;
    for attempt in attempts(kept.stages, was_in_full, L::EVERY_STAGE) {
        match take(sweeps, attempt, stopping, &mut work) {
            Ok(()) => {
                if attempt.in_full && !was_in_full {
                    *sweeps.steps_in_full() = STEPS_IN_FULL;
                }
                return Ok(work);
            }
            // Any other attempt from the start of the step begins with the same evaluations.
            Err(failure @ Failure::NonFinite { stage: Some(_), .. }) if !attempt.kept => {
                return Err(failure);
            }
            Err(latest) => failure = Some(latest),
        }
    }
    Err(failure.unwrap_or(Failure::NoConvergence {
        residual: f64::INFINITY,
        iterations: 0,
    }))
}

/// One attempt.
fn take<P, R, V, S, L>(
    sweeps: &mut ByIncrements<'_, P, R, V, S, L>,
    attempt: Attempt,
    stopping: Stopping,
    work: &mut StepStatistics,
) -> Result<(), Failure>
where
    P: StageTableau,
    R: Summation,
    V: Vector,
    S: System<V, Class = P::Class>,
    L: LinearSolver<V, S>,
{
    let max_iterations = stopping.max_iterations;
    let mut history = History::NONE;
    let mut once_more = false;
    let mut measurements = 0;
    sweeps.begin(attempt)?;
    for iteration in 1..=max_iterations {
        let change = sweeps.sweep()?;
        work.iterations += 1;
        work.evaluations += sweeps.evaluations();
        if change.is_undefined() {
            return Err(match iteration {
                1 => non_finite(
                    sweeps.non_finite_force(),
                    || sweeps.non_finite(),
                    change.q.is_undefined(),
                ),
                _ => history.failure(iteration),
            });
        }
        let before = history.last;
        history.note::<P::Class>(&change, FLOOR * V::Scalar::EPSILON);
        work.scales = change.scales();
        work.residual = change.residual();
        let within = |tolerance: f64| {
            tolerance > 0.0
                && change.q.difference() <= tolerance
                && change.p.difference() <= tolerance
        };
        let is_hastily_settled = !R::COMPENSATED
            && (within(stopping.tolerance) || is_last::<V::Scalar>(before, &change, true));
        if once_more || is_hastily_settled || change.residual() == 0.0 {
            return Ok(());
        }
        if history.stagnates(iteration, max_iterations) {
            let is_within = |size: f64| size <= ROUNDING * V::Scalar::EPSILON;
            // The noise with derivatives at one point may be larger than necessary.
            let may_be_noise = !attempt.gives_up || is_within(settling::<Separable>(&change));
            let is_noise = is_within(settling::<P::Class>(&change))
                || may_be_noise && history.may_be_noise() && measurements < MAX_MEASUREMENTS && {
                    measurements += 1;
                    work.evaluations += 2 * sweeps.evaluations();
                    let [q, p] = sweeps.noise()?;
                    change.q.difference() <= NOISY * q && change.p.difference() <= NOISY * p
                };
            if is_noise {
                if !R::COMPENSATED
                    || iteration == max_iterations
                    || !dither_last_sweep(sweeps.time())
                {
                    return Ok(());
                }
                once_more = true;
            }
        }
        let is_late = iteration >= MAX_SWEEPS || history.progress.slow >= SLOW;
        let is_far = settling::<P::Class>(&change) > ROUNDING * V::Scalar::EPSILON;
        if attempt.gives_up && (is_late && is_far || sweeps.is_slow()) {
            return Err(history.failure(iteration));
        }
    }
    Err(history.failure(max_iterations))
}

/// Size of a change. For a separable system it is the relative change of the positions: if they no longer change, neither do the forces,
/// and the momenta follow. Momenta may stop changing earlier: relative to a huge momentum, changes of the others are negligible. For a
/// general system it is the larger of both relative changes.
pub(super) fn size<C: Class>(change: &StageChange) -> f64 {
    if C::SEPARABLE {
        change.q.relative()
    } else {
        change.residual()
    }
}

/// The history of the changes, measured by their [`size`].
struct History {
    last: Option<StageChange>,
    progress: Progress,
    /// Number of consecutive sweeps in which one half stood still.
    resting: u32,
}

impl History {
    const NONE: Self = Self {
        last: None,
        progress: Progress::NONE,
        resting: 0,
    };

    /// Records a change; sizes below `floor` count as `floor`.
    fn note<C: Class>(&mut self, change: &StageChange, floor: f64) {
        let size = size::<C>(change).max(floor);
        let progress = &mut self.progress;
        progress.note(size);
        match self.last.replace(*change) {
            Some(_) if size >= progress.smallest => progress.idle += 1,
            _ => (progress.smallest, progress.idle) = (size, 0),
        }
        self.resting = match C::SEPARABLE && change.q.relative() <= floor
            || !C::SEPARABLE && settling::<Separable>(change) <= floor
        {
            true => self.resting + 1,
            false => 0,
        };
    }

    /// Whether the changes have stopped shrinking; at the bound, one sweep without progress suffices.
    const fn stagnates(&self, iteration: u32, max_iterations: u32) -> bool {
        let Progress { idle, slow, .. } = self.progress;
        let waited = iteration == max_iterations || idle > iteration / STAGNATION;
        idle > 0 && waited || slow >= SLOW || self.resting > 1
    }

    /// Whether it is worthwhile to measure the noise: not while the iteration may still be in its initial phase.
    fn may_be_noise(&self) -> bool {
        let progress = &self.progress;
        let has_come_down = progress.has_contracted(0.0);
        progress.slow >= SLOW || self.resting > 1 || has_come_down
    }

    /// The reason why the iteration has not settled.
    fn failure(&self, iterations: u32) -> Failure {
        let residual = self.last.map_or(f64::INFINITY, |change| change.residual());
        self.progress.failure(residual, residual, 0.0, iterations)
    }
}

/// Whether this change, after the change `before`, ends an iteration that does not wait for stagnation.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_last<T: Scalar>(before: Option<StageChange>, change: &StageChange, both: bool) -> bool {
    let of = |before: Option<f64>, change: &HalfChange| {
        let (unit, this) = (T::EPSILON * change.scale(), change.difference());
        // Estimates the next change by a constant contraction rate, with a quotient, which works for numbers of any size.
        let is_next_within = |before| this / before * this <= unit;
        this <= unit || this <= ROUNDING * unit && before.is_some_and(is_next_within)
    };
    of(before.map(|x| x.q.difference()), &change.q)
        && (!both || of(before.map(|x| x.p.difference()), &change.p))
}

/// The relative change of the stages that must be at the level of rounding errors when an iteration has settled.
///
/// In a general system positions and momenta must be. In a separable system one of them suffices, once the positions have stopped
/// shrinking. The other then moves at most by the noise of the system's evaluations. This noise can be far above the rounding errors of a
/// sum, as with stiff springs between masses far from the origin. One of them alone proves nothing: relative to a huge momentum, the
/// changes of all other momenta are negligible from the start.
fn settling<C: Class>(change: &StageChange) -> f64 {
    if C::SEPARABLE {
        change.q.relative().min(change.p.relative())
    } else {
        change.residual()
    }
}
