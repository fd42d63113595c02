//! Sweep after sweep over coupled stages, until they have settled.

use crate::{
    Change, Class, EvaluationCounts, Failure, Kept, PartChange, Quantity, Scalar, Separable,
    Stopping, Work,
};

/// Changes up to this many units of EPSILON can be rounding errors: one sweep rounds s products, s sums and the
/// evaluations, s ≤ 20 in practice. The change also has to have stopped shrinking, so that an iteration which still
/// gains digits below the threshold goes on.
const ROUNDING: f64 = 64.0;

/// Sweeps without progress after which a change that has shrunk by [`CONTRACTION`] counts as noise.
const PATIENCE: u32 = 10;

/// The part of its sweeps for which an iteration has to be without progress: where it converges slowly and turns as it does,
/// changes grow now and then long before it has settled.
const STAGNATION: u32 = 16;

/// Changes above this many units of EPSILON, of the stages of the step before or of those that were looked at first, are not looked
/// at further in the first sweeps: none of them is the last.
const FAR: f64 = ROUNDING * ROUNDING;

/// Noise up to this many units of EPSILON is noise still where the smallest change was at most [`ROUNDING`].
const AMPLIFIED: f64 = 4.0 * ROUNDING;

/// What tells an iteration that came down to its noise from one that never got anywhere.
const CONTRACTION: f64 = 1.0 / 1024.0;

/// Stages that are iterated.
pub(crate) trait Sweeps {
    /// How a sweep moves them.
    type Movement: Movement;

    /// Whether a change that is down to rounding errors is the last where the next one would be down to a unit of EPSILON.
    const HASTY: bool;

    /// Whether changes that are far from rounding errors are looked at.
    const LOOKS_AFAR: bool = false;

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
    fn begin(&mut self, kept: Kept);

    /// The first evaluation that is not finite although its argument is.
    fn non_finite(&mut self) -> Option<(Quantity, usize)>;

    /// The first stage, from 1, whose force is not finite: forces come first in a sweep.
    fn non_finite_force(&mut self) -> Option<usize>;

    /// One sweep over all of them.
    fn sweep(&mut self) -> Self::Movement;

    /// By how much that moved them altogether.
    fn change(&self, movement: &Self::Movement) -> Change;

    /// Whether the positions, and the momenta where they count, are as large as this but for a factor of two.
    #[inline(always)]
    fn are_about(&self, movement: &Self::Movement, [q, p]: [f64; 2], both: bool) -> bool {
        let is_about = |size: f64, other: f64| size > 0.5 * other && size <= 2.0 * other;
        let change = self.change(movement);
        is_about(change.q.scale(), q) && (!both || is_about(change.p.scale(), p))
    }
}

/// How a sweep moved the stages.
pub(crate) trait Movement: Copy {
    /// Whether it is a number, and by how much the positions moved, and the momenta where they count, not above these bounds.
    fn is_within(&self, bounds: [f64; 2], both: bool) -> bool;

    /// Whether it is a number, and by how much the positions moved, and the momenta where they count, above these bounds.
    fn exceeds(&self, bounds: [f64; 2], both: bool) -> bool;

    /// Whether the positions, and the momenta where they count, [would move](is_next_within) by no more than these bounds next.
    fn is_next_within(&self, before: &Self, bounds: [f64; 2], both: bool) -> bool;
}

impl Movement for Change {
    #[inline(always)]
    fn is_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        self.q.difference() <= q && (!both || self.p.difference() <= p)
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
}

/// Iterates until the stages have settled; returns what that took.
#[inline(always)]
pub(crate) fn settle<C: Class, T: Scalar>(
    sweeps: &mut impl Sweeps,
    kept: Kept,
    stopping: Stopping,
) -> Result<Work, Failure> {
    let mut work = Work::default();
    let mut kept = kept;
    loop {
        let solved = solve::<C, T>(sweeps, kept, stopping, &mut work);
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
    stopping: Stopping,
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
    let solved = iterate::<C, T, _>(sweeps, kept, stopping);
    let iterations = match solved {
        Ok((iterations, scales)) => {
            work.scales = scales;
            iterations
        }
        Err(Failure::NoConvergence { iterations, .. }) => iterations,
        Err(Failure::NonFinite { .. } | Failure::SingularMatrix) => 1,
    };
    work.iterations += iterations;
    work.evaluations += iterations * counts.sweep;
    solved.map(|_| ())
}

/// Sweeps until stagnation; returns the number of sweeps, and how large the stages are, if that is known.
///
/// A change that grows ends nothing: where the stages are many and their coupling is far from normal, it can
/// grow for many sweeps and vanish after all. A true divergence ends at the bound or overflows.
#[inline(always)]
fn iterate<C: Class, T: Scalar, W: Sweeps>(
    sweeps: &mut W,
    kept: Kept,
    stopping: Stopping,
) -> Result<(u32, [f64; 2]), Failure> {
    let Stopping {
        max_iterations,
        tolerance,
    } = stopping;
    let both = W::both::<C>();
    let units = |count: f64, [q, p]: [f64; 2]| [count * T::EPSILON * q, count * T::EPSILON * p];
    // Sweeps before this one are early.
    let late = max_iterations.min(PATIENCE);
    let tolerates = W::HASTY && tolerance > 0.0;
    // Without stages that are kept the first sweep is looked at: it shows what is not finite.
    let scales = if kept.stages { kept.scales } else { [0.0; 2] };
    let one = units(1.0, scales);
    let is_known = is_square_safe(one[0]) && (!both || is_square_safe(one[1]));
    let is_known = !W::LOOKS_AFAR && is_known;
    let is_tolerable = |this: &W::Movement| this.is_within([tolerance; 2], both);
    let mut iteration = 0;
    let mut previous = None;
    // The sweep that is looked at first, if it has been made.
    let mut made = None;
    let near = units(ROUNDING, scales);
    // A tolerance that rounding may keep changes from is not waited for.
    let tolerates_more = tolerates && tolerance >= near[0] && (!both || tolerance >= near[1]);
    let tolerates_more = tolerates_more && kept.stages && !W::LOOKS_AFAR;
    // Comparisons with what is known before the sweep: the processor need not wait for the largest of all lanes. Nothing is made
    // ready here for what is looked at below, for most iterations end here; and a tolerance keeps nothing of the sweep before.
    if tolerates_more {
        while iteration + 1 < late {
            let this = sweeps.sweep();
            iteration += 1;
            if is_tolerable(&this) {
                return Ok((iteration, scales));
            }
        }
    } else if W::HASTY && is_known {
        while iteration + 1 < late {
            let this = sweeps.sweep();
            iteration += 1;
            if this.is_within(near, both) {
                let is_last = this.is_within(one, both)
                    || previous.is_some_and(|before| this.is_next_within(&before, one, both));
                if is_last && sweeps.are_about(&this, scales, both) {
                    return Ok((iteration, scales));
                }
                made = Some(this);
                break;
            }
            previous = Some(this);
        }
    }
    let relative = |change: &Change| match both {
        true => change.residual(),
        false => change.q.relative(),
    };
    // What shrinks from sweep to sweep: without a division where it is one half.
    let size_of = |change: &Change| match both {
        true => change.residual(),
        false => change.q.difference(),
    };
    // Whether there are changes that are not looked at, and which.
    let (mut overlooks, mut far) = (is_known, units(FAR, scales));
    let (mut last, mut looked) = (Change::default(), 0);
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0);
    // The first sweep, where it is not looked at and somebody may want to know.
    let mut first = None;
    let mut least = last;
    let mut idle = 0;
    let mut once_more = false;
    while iteration < max_iterations {
        let this = made.take().unwrap_or_else(|| {
            iteration += 1;
            sweeps.sweep()
        });
        let before: Option<W::Movement> = previous.replace(this);
        let early = iteration < late;
        if once_more {
            return Ok((iteration, last.scales()));
        }
        if tolerates && is_tolerable(&this) {
            return Ok((iteration, sweeps.change(&this).scales()));
        }
        if overlooks && early && this.exceeds(far, both) {
            if iteration == 1 {
                first = Some(this);
            }
        } else {
            let change = sweeps.change(&this);
            if change.is_undefined() {
                if iteration == 1 {
                    return Err(non_finite(sweeps, &change));
                }
                // It has run away: the change before is shown, if it was looked at.
                let residual = match looked + 1 == iteration {
                    true => relative(&last),
                    false => f64::INFINITY,
                };
                return Err(Failure::NoConvergence {
                    residual,
                    iterations: iteration,
                });
            }
            if W::HASTY && is_last::<T>(before.map(|x| sweeps.change(&x)), &change, both) {
                return Ok((iteration, change.scales()));
            }
            let size = size_of(&change);
            if looked == 0 {
                (overlooks, far) = (!W::LOOKS_AFAR, units(FAR, change.scales()));
            }
            (last, looked) = (change, iteration);
            largest = larger(size, largest);
            // Comparisons, for it is a number: `min` and `max` look whether it is.
            (smallest, least, idle) = if size < smallest {
                (size, change, 0)
            } else {
                (smallest, least, idle + 1)
            };
            let is_rounding = || C::settling(&change) <= ROUNDING * T::EPSILON;
            // What rounding does may be amplified by all sweeps after the one whose change was the smallest.
            let is_noise = || {
                let at_first = first.map_or(0.0, |first| size_of(&sweeps.change(&first)));
                smallest <= CONTRACTION * larger(at_first, largest)
                    && Separable::settling(&least) <= ROUNDING * T::EPSILON
                    && Separable::settling(&change) <= AMPLIFIED * T::EPSILON
            };
            if size == 0.0 {
                return Ok((iteration, change.scales()));
            }
            // At the bound one sweep without progress will do.
            let waited = iteration == max_iterations || idle > iteration / STAGNATION;
            if idle > 0 && waited && (is_rounding() || idle >= PATIENCE && is_noise()) {
                // What took many sweeps converges so slowly that another one is not about rounding.
                if W::HASTY || !early || !coin(sweeps.time()) {
                    return Ok((iteration, change.scales()));
                }
                once_more = true;
            }
        }
    }
    Err(Failure::NoConvergence {
        residual: relative(&last),
        iterations: max_iterations,
    })
}

/// Whether a change, after the one `before`, is the last of an iteration that does not wait for stagnation.
#[inline(always)]
fn is_last<T: Scalar>(before: Option<Change>, change: &Change, both: bool) -> bool {
    let of = |before: Option<f64>, change: &PartChange| {
        let (unit, this) = (T::EPSILON * change.scale(), change.difference());
        // The next one by a quotient, for numbers of any size.
        let is_next_within = |before| this / before * this <= unit;
        this <= unit || this <= ROUNDING * unit && before.is_some_and(is_next_within)
    };
    of(before.map(|x| x.q.difference()), &change.q)
        && (!both || of(before.map(|x| x.p.difference()), &change.p))
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
const fn coin(time: f64) -> bool {
    // All bits of the time go into every bit (Appleby, MurmurHash3, the last mixing).
    let mut bits = time.to_bits();
    bits = (bits ^ bits >> 33).wrapping_mul(0xff51_afd7_ed55_8ccd);
    bits = (bits ^ bits >> 33).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    (bits ^ bits >> 33) & 1 == 1
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
    let culprit = match sweeps.non_finite_force() {
        Some(stage) => Some((Quantity::Force, stage)),
        None => sweeps.non_finite(),
    };
    let (what, stage) = match culprit {
        Some((what, stage)) => (what, Some(stage)),
        None => (part, None),
    };
    Failure::NonFinite { what, stage }
}

/// The larger of two numbers.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests;
