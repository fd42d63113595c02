//! Fixed-point iteration of coupled stages until they have settled.

use crate::contract::{
    Class, EvaluationCounts, Failure, StageChange, StepStatistics, Stopping, WarmStart,
};
use crate::error::Quantity;
use crate::number::Scalar;
use crate::number::dither::{dither_last_sweep, dither_side};

/// Changes up to this many units of EPSILON can be rounding errors: one sweep rounds s products, s sums and the
/// evaluations, s ≤ 20 in practice. The change must also have stopped shrinking, so that an iteration that still
/// gains digits below the threshold goes on.
pub const ROUNDING: f64 = 64.0;

/// Sweeps without progress after which a change that has shrunk by `CONTRACTION` counts as noise. The sweeps before
/// this one are the early sweeps: they are not examined before the change can be rounding errors.
pub const PATIENCE: u32 = 10;

/// An iteration has stagnated when the latest 1/`STAGNATION` of its sweeps made no progress. If it converges slowly and with
/// oscillations, its change grows now and then long before it has settled. With fewer sweeps, one without progress suffices.
pub const STAGNATION: u32 = 16;

/// Noise up to this many units of EPSILON still counts as noise if the smallest change was at most [`ROUNDING`].
const AMPLIFIED: f64 = 4.0 * ROUNDING;

/// Contraction of the change that distinguishes an iteration that reached its noise from one that made no progress.
const CONTRACTION: f64 = 1.0 / 1024.0;

/// A relative change above this is not noise: evaluations that noisy would be useless.
pub(crate) const NOISIEST: f64 = 1e-5;

/// Fixed-point sweeps over coupled stages.
pub(crate) trait Sweeps {
    /// Change of the stages in a sweep.
    type Movement: Movement;

    /// Whether a change at the level of rounding errors is the last if the next one would be at most one unit of EPSILON.
    const STOPS_AT_ROUNDING: bool;

    /// Numbers of evaluations that a step makes.
    fn evaluations(&self) -> EvaluationCounts;

    /// Time at the start of the step.
    fn time(&self) -> f64;

    /// Computes the starting values and the evaluations that are made once.
    fn begin(&mut self, kept: WarmStart);

    /// The first evaluation that is NaN or infinite although its argument is finite.
    fn non_finite(&self) -> Option<(Quantity, usize)>;

    /// The first stage, from 1, whose force is NaN or infinite: forces come first in a sweep.
    fn non_finite_force(&self) -> Option<usize>;

    /// One sweep over all stages.
    fn sweep(&mut self) -> Self::Movement;

    /// A sweep that moves the stages twice as far (over-relaxation with factor 2). It is called only for systems that are not separable,
    /// with sums that wait for stagnation, in a warm start. Other implementations need not override it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn overrelaxed_sweep(&mut self) -> Self::Movement {
        self.sweep()
    }

    /// The largest position and the largest momentum of the step so far.
    fn scales(&self, movement: &Self::Movement) -> [f64; 2];
}

/// Change of the stages in a sweep.
pub(crate) trait Movement: Copy {
    /// Whether the change of the positions and that of the momenta exceed these bounds; a NaN exceeds none.
    fn exceeds(&self, bounds: [f64; 2]) -> [bool; 2];

    /// The largest change of a position and of a momentum; NaN if any change is NaN.
    fn differences(&self) -> [f64; 2];
}

impl Movement for StageChange {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn exceeds(&self, [q, p]: [f64; 2]) -> [bool; 2] {
        [self.q.difference() > q, self.p.difference() > p]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn differences(&self) -> [f64; 2] {
        [self.q.difference(), self.p.difference()]
    }
}

/// Iterates until the stages have settled; returns the statistics of the step.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn settle<C: Class, T: Scalar, W: Sweeps>(
    sweeps: &mut W,
    mut kept: WarmStart,
    stopping: Stopping,
) -> Result<StepStatistics, Failure> {
    let mut work = StepStatistics::default();
    loop {
        let solved = attempt::<C, T, W>(sweeps, kept, stopping, &mut work);
        if solved.is_ok() || !kept.stages {
            return solved.map(|()| work);
        }
        // The warm start may be misleading: repeat the iteration without it.
        kept.stages = false;
    }
}

/// Finds the coupled stages from one start, and adds the statistics to `work`.
///
/// A growing change does not end the iteration. With many stages and a coupling matrix far from normal, it can
/// grow for many sweeps and vanish after all. A true divergence ends at the bound or overflows.
#[cfg_attr(not(debug_assertions), inline(always))]
fn attempt<C: Class, T: Scalar, W: Sweeps>(
    sweeps: &mut W,
    kept: WarmStart,
    stopping: Stopping,
    work: &mut StepStatistics,
) -> Result<(), Failure> {
    let (both, waits) = (!C::SEPARABLE, !W::STOPS_AT_ROUNDING);
    let max_iterations = stopping.max_iterations;
    let tolerance = if waits { 0.0 } else { stopping.tolerance };
    // Sweeps before this one are early.
    let late = max_iterations.min(PATIENCE);
    sweeps.begin(kept);
    let counts = sweeps.evaluations();
    let made = counts.at_begin(kept);
    work.evaluations += made;
    // After a warm start the first sweep reveals it, and the second attempt, without the warm start, reports it.
    if made > 0
        && !kept.stages
        && let Some((what, stage)) = sweeps.non_finite()
    {
        let stage = Some(stage);
        return Err(Failure::NonFinite { what, stage });
    }
    // Half of the steps approach from the other side.
    let reflects = waits && both && kept.stages && late == PATIENCE && dither_side(sweeps.time());
    let mut sizes = Sizes::new(if kept.stages { kept.scales } else { [0.0; 2] });
    // Early sweeps that change more than this are not examined.
    let mut near = sizes.rounding::<T>(tolerance);
    // The relative change; in a separable system, of the positions.
    let relative = |[q, p]: [f64; 2]| if both { larger(q, p) } else { q };
    // What shrinks from sweep to sweep: the relative change; for positions alone no size is needed.
    let size_of = |differences: [f64; 2], sizes: &Sizes| match both {
        true => relative(sizes.change(differences)),
        false => differences[0],
    };
    // Compares a relative change with a number of units of EPSILON: both halves, or one of them.
    let is_within = |count: f64, [q, p]: [f64; 2], both: bool| {
        let bound = count * T::EPSILON;
        match both {
            true => q <= bound && p <= bound,
            false => q <= bound || p <= bound,
        }
    };
    let mut progress = Progress::NONE;
    let (mut first, mut before) = (None, None);
    let (mut is_measured, mut has_settled, mut once_more) = (false, false, false);
    let mut iteration = 0;
    let solved = loop {
        let this = sweeps.sweep();
        iteration += 1;
        let previous: Option<W::Movement> = before.replace(this);
        if once_more {
            break Ok(());
        }
        if iteration == 1 {
            first = Some(this);
            if reflects {
                // The ordinary sweep leaves mostly the slowest-decaying error, which is reflected.
                sweeps.overrelaxed_sweep();
                iteration += 1;
                continue;
            }
        }
        if iteration < late && is_far(this, near, both) {
            continue;
        }
        let differences @ [q, p] = this.differences();
        if !(q + p).is_finite() {
            break Err(match iteration {
                1 => non_finite(
                    sweeps.non_finite_force(),
                    || sweeps.non_finite(),
                    !q.is_finite(),
                ),
                _ => {
                    let last = differences_of(previous);
                    let last = last.map(|last| relative(sizes.change(last)));
                    Failure::NoConvergence {
                        residual: last.filter(|size| !size.is_nan()).unwrap_or(f64::INFINITY),
                        iterations: iteration,
                    }
                }
            });
        }
        // Once the positions move by rounding errors, the sizes no longer vary.
        if !is_measured {
            sizes = Sizes::new(sweeps.scales(&this));
        }
        let (change, size) = (sizes.change(differences), size_of(differences, &sizes));
        if !waits {
            let before = differences_of(previous).map(|before| sizes.change(before));
            if q <= tolerance && (!both || p <= tolerance)
                || is_last::<T>(before.map(|before| before[0]), change[0])
                    && (!both || is_last::<T>(before.map(|before| before[1]), change[1]))
            {
                break Ok(());
            }
        }
        if size == 0.0 {
            break Ok(());
        }
        let is_rounding = is_within(ROUNDING, change, both);
        is_measured |= is_rounding && change[0] <= ROUNDING * T::EPSILON;
        has_settled |= is_rounding;
        if iteration < late && !has_settled {
            near = sizes.rounding::<T>(tolerance);
            continue;
        }
        // From here on every change counts.
        near = [f64::INFINITY; 2];
        // Comparisons, because `size` is not NaN: `min` and `max` would test for it.
        if size < progress.smallest {
            (progress.smallest, progress.idle) = (size, 0);
            progress.was_rounding = is_within(ROUNDING, change, false);
        } else {
            progress.idle += 1;
        }
        let at_bound = iteration >= max_iterations;
        if iteration >= late {
            progress.note(size);
        }
        // At the bound, one sweep without progress suffices.
        let has_stagnated = progress.idle > if at_bound { 0 } else { iteration / STAGNATION };
        let first_size =
            |first: Option<[f64; 2]>| first.map_or(0.0, |first| size_of(first, &sizes));
        let is_noise = |first: f64| progress.is_noise(first) && is_within(AMPLIFIED, change, false);
        if has_stagnated && (is_rounding || is_noise(first_size(differences_of(first)))) {
            // At the bound, no further sweep is allowed.
            once_more = waits && !at_bound && dither_last_sweep(sweeps.time());
            if once_more {
                continue;
            }
            break Ok(());
        }
        if at_bound {
            let first = first_size(differences_of(first));
            break Err(progress.failure(size, relative(change), first, iteration));
        }
    };
    work.iterations += iteration;
    work.evaluations += iteration * counts.sweep;
    work.scales = sizes.scales;
    solved
}

/// Whether a change is above these bounds: of one half, or of `both`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_far<M: Movement>(change: M, near: [f64; 2], both: bool) -> bool {
    let [q, p] = change.exceeds(near);
    if both { q | p } else { q & p }
}

/// The differences of a change. No closure: operations of lanes in a closure may not be inlined.
#[cfg_attr(not(debug_assertions), inline(always))]
fn differences_of<M: Movement>(change: Option<M>) -> Option<[f64; 2]> {
    Some(change?.differences())
}

/// The sizes of the stages.
#[derive(Clone, Copy)]
struct Sizes {
    /// The largest position and the largest momentum; zero if unknown.
    scales: [f64; 2],
    /// The factors that express changes relative to these.
    inverse: [f64; 2],
}

impl Sizes {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn new(scales: [f64; 2]) -> Self {
        // Finite, so that a change of zero is zero relative to a size of zero, not NaN.
        let inverse = scales.map(|size| smaller(1.0 / size, f64::MAX));
        Self { scales, inverse }
    }

    /// The largest changes that are examined in early sweeps: all that can be rounding errors, even if the sizes double, and all within the
    /// tolerance. If the size is not known, all changes are examined.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rounding<T: Scalar>(&self, tolerance: f64) -> [f64; 2] {
        self.scales.map(|size| match size == 0.0 {
            true => f64::INFINITY,
            false => larger(2.0 * ROUNDING * T::EPSILON * size, tolerance),
        })
    }

    /// A change relative to these sizes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn change(&self, [q, p]: [f64; 2]) -> [f64; 2] {
        [q * self.inverse[0], p * self.inverse[1]]
    }
}

/// The history of changes of these sizes.
pub struct Progress {
    /// The smallest change.
    pub smallest: f64,
    /// Whether the smallest change can be rounding errors in one half.
    was_rounding: bool,
    /// Number of sweeps since the smallest change.
    pub idle: u32,
    /// The largest noted change.
    largest: f64,
    /// The last noted change that was at most half of the previous such, and the number of sweeps since.
    mark: f64,
    /// Number of sweeps since that change.
    pub slow: u32,
}

impl Progress {
    /// No change yet.
    pub const NONE: Self = Self {
        smallest: f64::INFINITY,
        was_rounding: false,
        idle: 0,
        largest: 0.0,
        mark: f64::INFINITY,
        slow: 0,
    };

    /// Notes a change: the fixed-point iteration after its early sweeps, Newton's in each sweep.
    pub fn note(&mut self, size: f64) {
        self.largest = larger(size, self.largest);
        (self.mark, self.slow) = match size <= 0.5 * self.mark {
            true => (size, 0),
            false => (self.mark, self.slow + 1),
        };
    }

    /// Whether the change has shrunk by [`CONTRACTION`], from the largest noted one or the `first`.
    pub fn has_contracted(&self, first: f64) -> bool {
        self.smallest <= CONTRACTION * larger(first, self.largest)
    }

    /// Whether changes up to [`AMPLIFIED`] are noise of the evaluations or amplified rounding errors: see [`PATIENCE`].
    fn is_noise(&self, first: f64) -> bool {
        self.idle >= PATIENCE && self.was_rounding && self.has_contracted(first)
    }

    /// An iteration that has not settled in the allowed number of sweeps.
    pub fn failure(&self, size: f64, residual: f64, first: f64, iterations: u32) -> Failure {
        // The change shrank and then stagnated at the level of its noise.
        let came_down =
            residual <= NOISIEST && self.has_contracted(first) && size <= ROUNDING * self.smallest;
        match self.slow >= PATIENCE && came_down {
            true => Failure::Stagnation {
                residual,
                iterations,
            },
            false => Failure::NoConvergence {
                residual,
                iterations,
            },
        }
    }
}

/// Whether a relative change ends an iteration that does not wait for stagnation. It does if it is at most one unit of EPSILON. It also
/// does if it can be rounding errors and the next one would be at most one unit. The next one is estimated by a constant contraction rate.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_last<T: Scalar>(before: Option<f64>, this: f64) -> bool {
    let is_next_within = |before: f64| this * this <= before * T::EPSILON;
    this <= T::EPSILON || this <= ROUNDING * T::EPSILON && before.is_some_and(is_next_within)
}

/// The cause of a first sweep that is NaN or infinite: the force of a stage, or the first such evaluation.
pub fn non_finite(
    force: Option<usize>,
    evaluation: impl FnOnce() -> Option<(Quantity, usize)>,
    of_positions: bool,
) -> Failure {
    let culprit = match force {
        Some(stage) => Some((Quantity::Force, stage)),
        None => evaluation(),
    };
    let part = match of_positions {
        true => Quantity::Position,
        false => Quantity::Momentum,
    };
    let (what, stage) = match culprit {
        Some((what, stage)) => (what, Some(stage)),
        None => (part, None),
    };
    Failure::NonFinite { what, stage }
}

/// The larger of two numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of two numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[cfg(test)]
mod tests;
