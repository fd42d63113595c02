//! Sweep after sweep over coupled stages, until they have settled.

mod cold_start;
mod warm_start;

pub(crate) use self::cold_start::patiently;
#[cfg(feature = "alloc")]
pub(crate) use self::cold_start::{is_last, non_finite};
use self::warm_start::hasten;
use crate::error::Quantity;
use crate::method::{EvaluationCounts, Failure, StageChange, StepStatistics, Stopping, WarmStart};
use crate::number::Scalar;
use crate::system::Class;

/// Changes up to this many units of EPSILON can be rounding errors: one sweep rounds s products, s sums and the
/// evaluations, s ≤ 20 in practice. The change also has to have stopped shrinking, so that an iteration which still
/// gains digits below the threshold goes on.
pub(crate) const ROUNDING: f64 = 64.0;

/// Sweeps without progress after which a change that has shrunk by [`CONTRACTION`] counts as noise; before as many all
/// sweeps are early ones.
pub(crate) const PATIENCE: u32 = 10;

/// The part of its sweeps for which an iteration has to be without progress: where it converges slowly and turns as it does,
/// changes grow now and then long before it has settled. Of fewer sweeps one without progress will do.
pub(crate) const STAGNATION: u32 = 16;

/// Changes above this many units of EPSILON, of the stages of the step before or of those that were looked at first, are not looked
/// at further in the first sweeps: none of them is the last.
const FAR: f64 = ROUNDING * ROUNDING;

/// Noise up to this many units of EPSILON is noise still where the smallest change was at most [`ROUNDING`].
const AMPLIFIED: f64 = 4.0 * ROUNDING;

/// What tells an iteration that came down to its noise from one that never got anywhere.
pub(crate) const CONTRACTION: f64 = 1.0 / 1024.0;

/// A relative change above this is not the noise of evaluations that are good for anything.
pub(crate) const NOISIEST: f64 = 1e-5;

/// Stages that are iterated.
pub(crate) trait Sweeps {
    /// How a sweep moves them.
    type Movement: Movement;

    /// Whether a change that is down to rounding errors is the last where the next one would be down to a unit of EPSILON.
    const STOPS_AT_ROUNDING: bool;

    /// Whether it is known after each sweep how large they are; else only what they [are about](Self::are_about), from the start.
    const MEASURED: bool = true;

    /// How many evaluations they make.
    fn evaluations(&self) -> EvaluationCounts;

    /// Whether the momenta too show that the iteration goes on: not where they are a function of the positions before.
    #[inline(always)]
    fn both<C: Class>() -> bool {
        !C::SEPARABLE
    }

    /// When the step starts.
    fn time(&self) -> f64;

    /// Starting values; evaluations that are made once.
    fn begin(&mut self, kept: WarmStart);

    /// The first evaluation that is not finite although its argument is.
    fn non_finite(&self) -> Option<(Quantity, usize)>;

    /// The first stage, from 1, whose force is not finite: forces come first in a sweep.
    fn non_finite_force(&self) -> Option<usize>;

    /// One sweep over all of them.
    fn sweep(&mut self) -> Self::Movement;

    /// How many sweeps are not worth a look, for there will be others: at the start of a step that goes on from one before.
    #[inline(always)]
    fn unseen(&self) -> u32 {
        0
    }

    /// A sweep of which nobody wants to know how it moves the stages.
    #[inline(always)]
    fn sweep_unseen(&mut self) {
        self.sweep();
    }

    /// One that moves them twice as far. Only asked for of systems that are not separable, of sums that wait for stagnation, and where
    /// changes that are far from rounding are not looked at: others need not have it.
    #[inline(always)]
    fn overrelaxed_sweep(&mut self) -> Self::Movement {
        self.sweep()
    }

    /// By how much that moved them altogether, where they are [measured](Self::MEASURED).
    fn change(&self, movement: &Self::Movement) -> StageChange;

    /// [`patiently`], in another place where that leaves these stages in registers.
    fn go_on<C: Class, T: Scalar>(
        &mut self,
        kept: WarmStart,
        stopping: Stopping,
        begun: Begun<Self::Movement>,
    ) -> Result<StepStatistics, Failure>
    where
        Self: Sized,
    {
        patiently::<C, T, _>(self, kept, stopping, begun)
    }

    /// Whether the positions, and the momenta where they count, are as large as this but for a factor of two.
    #[inline(always)]
    fn are_about(&self, movement: &Self::Movement, [q, p]: [f64; 2], both: bool) -> bool {
        let is_about = |size: f64, other: f64| size > 0.5 * other && size <= 2.0 * other;
        let change = self.change(movement);
        is_about(change.q.scale(), q) && (!both || is_about(change.p.scale(), p))
    }
}

/// How a sweep moved the stages. Comparisons, but for [`is_within`](Self::is_within), may lose what is not a number: see
/// [`is_number`](Self::is_number).
pub(crate) trait Movement: Copy {
    /// Whether the positions moved, and the momenta where they count, by no more than these bounds, and both by numbers.
    fn is_within(&self, bounds: [f64; 2], both: bool) -> bool;

    /// [`is_within`](Self::is_within), but either half will do where the momenta do not count: [`settling`].
    fn settles_within(&self, bounds: [f64; 2], both: bool) -> bool;

    /// Whether the positions moved, and the momenta where they count, by more than these bounds.
    fn exceeds(&self, bounds: [f64; 2], both: bool) -> bool;

    /// Whether the positions, and the momenta where they count, [would move](is_next_within) by no more than these bounds next.
    fn is_next_within(&self, before: &Self, bounds: [f64; 2], both: bool) -> bool;

    /// By how much the positions moved; where the momenta count, the larger of both, each multiplied by its weight.
    fn size(&self, weights: [f64; 2], both: bool) -> f64;

    /// Whether that is below this, but not zero.
    fn shrinks(&self, below: f64, weights: [f64; 2], both: bool) -> bool;

    /// Whether it is a number, of all components: to be looked at where an iteration could end.
    fn is_number(&self) -> bool;
}

impl Movement for StageChange {
    #[inline(always)]
    fn is_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        self.q.difference() <= q && (!both || self.p.difference() <= p)
    }

    #[inline(always)]
    fn settles_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        let (of_q, of_p) = (self.q.difference() <= q, self.p.difference() <= p);
        !self.is_undefined() && if both { of_q && of_p } else { of_q || of_p }
    }

    #[inline(always)]
    fn exceeds(&self, [q, p]: [f64; 2], both: bool) -> bool {
        self.q.difference() > q && (!both || self.p.difference() > p)
    }

    #[inline(always)]
    fn is_next_within(&self, before: &Self, [q, p]: [f64; 2], both: bool) -> bool {
        is_next_within(before.q.difference(), self.q.difference(), q)
            && (!both || is_next_within(before.p.difference(), self.p.difference(), p))
    }

    #[inline(always)]
    fn size(&self, [q, p]: [f64; 2], both: bool) -> f64 {
        match both {
            true => larger(self.q.difference() * q, self.p.difference() * p),
            false => self.q.difference(),
        }
    }

    #[inline(always)]
    fn shrinks(&self, below: f64, weights: [f64; 2], both: bool) -> bool {
        let size = self.size(weights, both);
        size < below && size > 0.0
    }

    #[inline(always)]
    fn is_number(&self) -> bool {
        // What is none is neither within a bound nor above it.
        true
    }
}

/// An iteration that has not come to its end.
#[derive(Clone, Copy)]
pub(crate) struct Begun<M> {
    /// How many sweeps were made.
    iterations: u32,
    /// The first one, where it was not looked at and somebody may want to know; where it was [not seen](Sweeps::unseen) nobody does, and
    /// what is then noise counts as such if it is small beside what was looked at.
    first: Option<M>,
    /// The one before the last.
    before: Option<M>,
    /// The one that moved the stages least of those that were looked at, and which it was.
    least: Option<(u32, M)>,
    /// The last one, if it was not looked at.
    last: Option<M>,
}

impl<M> Begun<M> {
    /// One that has not begun.
    const NOTHING: Self = Self {
        iterations: 0,
        first: None,
        before: None,
        least: None,
        last: None,
    };

    /// Whether it has not begun.
    #[inline(always)]
    pub(crate) const fn is_nothing(&self) -> bool {
        self.iterations == 0
    }
}

/// Iterates until the stages have settled; returns what that took.
#[inline(always)]
pub(crate) fn settle<C: Class, T: Scalar>(
    sweeps: &mut impl Sweeps,
    kept: WarmStart,
    stopping: Stopping,
) -> Result<StepStatistics, Failure> {
    match hasten::<C, T, _>(sweeps, kept, stopping) {
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

/// So many units of EPSILON of positions and of momenta.
#[inline(always)]
fn units<T: Scalar>(count: f64, [q, p]: [f64; 2]) -> [f64; 2] {
    [count * T::EPSILON * q, count * T::EPSILON * p]
}

/// Whether it is known how large positions, and momenta where they count, were: numbers that can be squared.
#[inline(always)]
fn is_known<T: Scalar>(scales: [f64; 2], both: bool) -> bool {
    let [q, p] = units::<T>(1.0, scales);
    is_square_safe(q) && (!both || is_square_safe(p))
}

/// These sizes where they are [known](is_known), zero elsewhere.
fn known<T: Scalar>(scales: [f64; 2], both: bool) -> [f64; 2] {
    match is_known::<T>(scales, both) {
        true => scales,
        false => [0.0; 2],
    }
}

/// Whether the change after two others, `this²/before` should they shrink by one factor, is within a bound the square of which
/// [is a number](is_square_safe).
#[inline(always)]
pub(crate) fn is_next_within(before: f64, this: f64, bound: f64) -> bool {
    this * this <= before * bound
}

/// Whether squares of numbers of this size are far from the smallest and the largest numbers.
#[inline(always)]
fn is_square_safe(size: f64) -> bool {
    size > 1e-140 && size < 1e140
}

/// A bit of the time that is as good as random, and the same on every run.
///
/// Where stages stagnate without standing still, rounding lets them jump to and fro, from sweep to sweep, between two values.
/// At which of the two the iteration ends goes with the side from which it came, and starting values come from the same side
/// at every step: the energy would drift, for Hénon–Heiles and Gauss 8 by 1e-21 of it a step.
#[inline]
pub(crate) const fn dither_last_sweep(time: f64) -> bool {
    bits(time) & 1 == 1
}

/// Another one.
///
/// Where stages stand still they do so at one of several roundings that solve the rounded equations, and that too goes with the side
/// from which they came. For `(q² + 1)(p² + 1)/2` and Gauss 6 the energy would drift by 1e-20 of it a step.
#[inline]
const fn dither_side(time: f64) -> bool {
    bits(time) & 2 == 2
}

/// All bits of the time go into every bit (Appleby, MurmurHash3, the last mixing).
#[inline]
const fn bits(time: f64) -> u64 {
    let mut bits = time.to_bits();
    bits = (bits ^ bits >> 33).wrapping_mul(0xff51_afd7_ed55_8ccd);
    bits = (bits ^ bits >> 33).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    bits ^ bits >> 33
}

/// The larger of two numbers.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests;

/// The relative change of the stages that has to be down to rounding errors where an iteration has settled.
///
/// Of a general system both halves have to be. Of a separable one either will do, once the positions have stopped shrinking: then
/// the other half moves by the noise of the system's own evaluations at most. This noise can be far above the rounding errors of a
/// sum: stiff springs between masses far from the origin. Alone it proves nothing: beside a huge momentum the others rest at once.
#[inline]
pub(crate) fn settling<C: Class>(change: &StageChange) -> f64 {
    if C::SEPARABLE {
        change.q.relative().min(change.p.relative())
    } else {
        change.residual()
    }
}
