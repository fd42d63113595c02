//! Fixed-point iteration of coupled stages until they have settled.

mod cold_start;
mod warm_start;

pub(crate) use self::cold_start::settle_from_cold_start;
#[cfg(feature = "alloc")]
pub(crate) use self::cold_start::{is_last, non_finite};
#[cfg(feature = "alloc")]
pub(crate) use self::warm_start::WITHIN_REACH;
use self::warm_start::settle_from_warm_start;
use crate::error::Quantity;
use crate::method::{EvaluationCounts, Failure, StageChange, StepStatistics, Stopping, WarmStart};
use crate::number::Scalar;
use crate::system::Class;

/// Changes up to this many units of EPSILON can be rounding errors: one sweep rounds s products, s sums and the
/// evaluations, s ≤ 20 in practice. The change must also have stopped shrinking, so that an iteration that still
/// gains digits below the threshold goes on.
pub(crate) const ROUNDING: f64 = 64.0;

/// Sweeps without progress after which a change that has shrunk by [`CONTRACTION`] counts as noise. The sweeps before
/// this one are the early sweeps.
pub(crate) const PATIENCE: u32 = 10;

/// An iteration has stagnated when the latest 1/`STAGNATION` of its sweeps made no progress. If it converges slowly and with
/// oscillations, its change grows now and then long before it has settled. With fewer sweeps, one without progress suffices.
pub(crate) const STAGNATION: u32 = 16;

/// Early sweeps that change the stages by more than this many units of EPSILON are not examined further: none of them is the last.
/// The unit refers to the stages of the previous step, or to the first stages that were examined.
const FAR: f64 = ROUNDING * ROUNDING;

/// Noise up to this many units of EPSILON still counts as noise if the smallest change was at most [`ROUNDING`].
const AMPLIFIED: f64 = 4.0 * ROUNDING;

/// Contraction of the change that distinguishes an iteration that reached its noise from one that made no progress.
pub(crate) const CONTRACTION: f64 = 1.0 / 1024.0;

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

    /// The change of all stages together in a sweep.
    fn change(&self, movement: &Self::Movement) -> StageChange;

    /// [`settle_from_cold_start`], on a copy of the stages if that keeps the original in registers.
    fn go_on<C: Class, T: Scalar>(
        &mut self,
        kept: WarmStart,
        stopping: Stopping,
        begun: Begun<Self::Movement>,
    ) -> Result<StepStatistics, Failure>
    where
        Self: Sized,
    {
        settle_from_cold_start::<C, T, _>(self, kept, stopping, begun)
    }

    /// Whether the positions, and if `both` the momenta, have these sizes up to a factor of two.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn are_about(&self, movement: &Self::Movement, [q, p]: [f64; 2], both: bool) -> bool {
        let is_about = |size: f64, other: f64| size > 0.5 * other && size <= 2.0 * other;
        let change = self.change(movement);
        is_about(change.q.scale(), q) && (!both || is_about(change.p.scale(), p))
    }
}

/// Change of the stages in a sweep. All comparisons except [`is_within`](Self::is_within) may miss a NaN: see
/// [`is_number`](Self::is_number).
pub(crate) trait Movement: Copy {
    /// Whether the changes of the positions, and if `both` of the momenta, are within these bounds, and neither change is NaN.
    fn is_within(&self, bounds: [f64; 2], both: bool) -> bool;

    /// Like [`is_within`](Self::is_within), but without `both` one of the two halves suffices: [`settling`].
    fn settles_within(&self, bounds: [f64; 2], both: bool) -> bool;

    /// Whether the changes of the positions, and if `both` of the momenta, exceed these bounds.
    fn exceeds(&self, bounds: [f64; 2], both: bool) -> bool;

    /// Whether the next change of the positions, and if `both` of the momenta, [would be within](is_next_within) these bounds.
    fn is_next_within(&self, before: &Self, bounds: [f64; 2], both: bool) -> bool;

    /// The change of the positions; if `both`, the larger of the changes of positions and momenta, each multiplied by its weight.
    fn size(&self, weights: [f64; 2], both: bool) -> f64;

    /// Whether the [size](Self::size) is below this bound, but not zero.
    fn shrinks(&self, below: f64, weights: [f64; 2], both: bool) -> bool;

    /// Whether no component of the change is NaN. Checked wherever an iteration could end.
    fn is_number(&self) -> bool;
}

impl Movement for StageChange {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        self.q.difference() <= q && (!both || self.p.difference() <= p)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn settles_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        let (of_q, of_p) = (self.q.difference() <= q, self.p.difference() <= p);
        !self.is_undefined() && if both { of_q && of_p } else { of_q || of_p }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn exceeds(&self, [q, p]: [f64; 2], both: bool) -> bool {
        self.q.difference() > q && (!both || self.p.difference() > p)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_next_within(&self, before: &Self, [q, p]: [f64; 2], both: bool) -> bool {
        is_next_within(before.q.difference(), self.q.difference(), q)
            && (!both || is_next_within(before.p.difference(), self.p.difference(), p))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn size(&self, [q, p]: [f64; 2], both: bool) -> f64 {
        match both {
            true => larger(self.q.difference() * q, self.p.difference() * p),
            false => self.q.difference(),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shrinks(&self, below: f64, weights: [f64; 2], both: bool) -> bool {
        let size = self.size(weights, both);
        size < below && size > 0.0
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_number(&self) -> bool {
        // A NaN is neither within a bound nor above it.
        true
    }
}

/// An iteration that has not ended yet.
#[derive(Clone, Copy)]
pub(crate) struct Begun<M> {
    /// Number of sweeps made.
    iterations: u32,
    /// The change of the first sweep, if it was not examined but may be needed. A change then counts as noise if it is small compared
    /// with the examined changes.
    first: Option<M>,
    /// The change of the sweep before the one that is examined next, if known.
    before: Option<M>,
    /// The smallest of the examined changes, and the number of its sweep.
    least: Option<(u32, M)>,
    /// The change of the last sweep, if it was not examined.
    last: Option<M>,
}

impl<M> Begun<M> {
    /// An iteration that has not begun.
    const NOTHING: Self = Self {
        iterations: 0,
        first: None,
        before: None,
        least: None,
        last: None,
    };

    /// Whether the iteration has not begun.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) const fn is_nothing(&self) -> bool {
        self.iterations == 0
    }
}

/// Iterates until the stages have settled; returns the statistics of the step.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn settle<C: Class, T: Scalar>(
    sweeps: &mut impl Sweeps,
    kept: WarmStart,
    stopping: Stopping,
) -> Result<StepStatistics, Failure> {
    match settle_from_warm_start::<C, T, _>(sweeps, kept, stopping) {
        Ok((iterations, scales)) => {
            let counts = sweeps.evaluations();
            Ok(StepStatistics {
                iterations,
                evaluations: counts.at_begin(kept) + iterations * counts.sweep,
                scales,
                ..StepStatistics::default()
            })
        }
        Err(begun) => sweeps.go_on::<C, T>(kept, stopping, begun),
    }
}

/// `count` units of EPSILON of positions and of momenta of these sizes.
#[cfg_attr(not(debug_assertions), inline(always))]
fn units<T: Scalar>(count: f64, [q, p]: [f64; 2]) -> [f64; 2] {
    [count * T::EPSILON * q, count * T::EPSILON * p]
}

/// Whether the sizes of the positions, and if `both` of the momenta, are known and their rounding errors can be squared safely.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_known<T: Scalar>(scales: [f64; 2], both: bool) -> bool {
    let [q, p] = units::<T>(1.0, scales);
    is_square_safe(q) && (!both || is_square_safe(p))
}

/// These sizes if they are [known](is_known), zero otherwise.
fn known<T: Scalar>(scales: [f64; 2], both: bool) -> [f64; 2] {
    match is_known::<T>(scales, both) {
        true => scales,
        false => [0.0; 2],
    }
}

/// Whether the next change is within a bound. It is estimated as `this²/before`, by a constant contraction rate.
/// The square of the bound [must neither overflow nor underflow](is_square_safe).
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn is_next_within(before: f64, this: f64, bound: f64) -> bool {
    this * this <= before * bound
}

/// Whether the square of a number of this size neither overflows nor underflows.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_square_safe(size: f64) -> bool {
    size > 1e-140 && size < 1e140
}

/// The larger of two numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests;

/// The relative change of the stages that must be at the level of rounding errors when an iteration has settled.
///
/// In a general system both halves must be. In a separable system one half suffices, once the positions have stopped shrinking. The
/// other half then moves at most by the noise of the system's evaluations. This noise can be far above the rounding errors of a
/// sum, as with stiff springs between masses far from the origin. One half alone proves nothing: beside a huge momentum, the changes
/// of all other momenta are negligible from the start.
#[inline]
pub(crate) fn settling<C: Class>(change: &StageChange) -> f64 {
    if C::SEPARABLE {
        change.q.relative().min(change.p.relative())
    } else {
        change.residual()
    }
}
