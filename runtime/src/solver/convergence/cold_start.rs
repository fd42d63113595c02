//! Sweeps that are looked at one by one.

use super::{
    AMPLIFIED, Begun, CONTRACTION, FAR, Movement, NOISIEST, PATIENCE, ROUNDING, STAGNATION, Sweeps,
    dither_last_sweep, is_known, known, larger, units,
};
use crate::error::Quantity;
use crate::method::{Failure, HalfChange, StageChange, StepStatistics, Stopping, WarmStart};
use crate::number::Scalar;
use crate::solver::convergence::settling;
use crate::system::{Class, Separable};

/// Iterates until the stages have settled, from where that was begun; returns what all of it took.
///
/// A function of its own: what it needs is not in the registers of the steps that can do without.
#[inline(never)]
pub(crate) fn patiently<C: Class, T: Scalar, W: Sweeps>(
    sweeps: &mut W,
    kept: WarmStart,
    stopping: Stopping,
    begun: Begun<W::Movement>,
) -> Result<StepStatistics, Failure> {
    let (mut kept, mut begun) = (kept, begun);
    let mut work = StepStatistics::default();
    loop {
        let solved = solve::<C, T, _>(sweeps, kept, stopping, begun, &mut work);
        if solved.is_ok() || !kept.stages {
            return solved.map(|()| work);
        }
        // What the step before was like may say nothing about this one: once more without it.
        (kept.stages, begun) = (false, Begun::NOTHING);
    }
}

/// Finds the coupled stages, and adds to `work` what that took.
pub(super) fn solve<C: Class, T: Scalar, W: Sweeps>(
    sweeps: &mut W,
    kept: WarmStart,
    stopping: Stopping,
    begun: Begun<W::Movement>,
    work: &mut StepStatistics,
) -> Result<(), Failure> {
    if begun.is_nothing() {
        sweeps.begin(kept);
    }
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
    let solved = iterate::<C, T, _>(sweeps, kept, stopping, begun);
    let iterations = match solved {
        Ok((iterations, scales)) => {
            work.scales = known::<T>(scales, W::both::<C>() || !W::STOPS_AT_ROUNDING);
            iterations
        }
        Err(Failure::NoConvergence { iterations, .. } | Failure::Stagnation { iterations, .. }) => {
            iterations
        }
        Err(_) => 1,
    };
    work.iterations += iterations;
    work.evaluations += iterations * counts.sweep;
    solved.map(|_| ())
}

/// Sweeps until stagnation; returns the number of sweeps, and how large the stages are, if that is known.
///
/// A change that grows ends nothing: where the stages are many and their coupling is far from normal, it can
/// grow for many sweeps and vanish after all. A true divergence ends at the bound or overflows.
fn iterate<C: Class, T: Scalar, W: Sweeps>(
    sweeps: &mut W,
    kept: WarmStart,
    stopping: Stopping,
    begun: Begun<W::Movement>,
) -> Result<(u32, [f64; 2]), Failure> {
    let Stopping {
        max_iterations,
        tolerance,
    } = stopping;
    let both = W::both::<C>();
    // Sweeps before this one are early.
    let late = max_iterations.min(PATIENCE);
    let tolerates = W::STOPS_AT_ROUNDING && tolerance > 0.0;
    let relative = |change: &StageChange| match both {
        true => change.residual(),
        false => change.q.relative(),
    };
    // What shrinks from sweep to sweep: without a division where it is one half.
    let size_of = |change: &StageChange| match both {
        true => change.residual(),
        false => change.q.difference(),
    };
    // Whether there are changes that are not looked at, and which: without stages that are kept the first sweep shows what is
    // not finite.
    let is_known = kept.stages && is_known::<T>(kept.scales, both);
    let mut overlooks = is_known;
    let mut far = units::<T>(FAR, kept.scales);
    let Begun {
        iterations: mut iteration,
        mut first,
        before: mut previous,
        least: seen,
        last: mut made,
    } = begun;
    let (mut last, mut looked) = (StageChange::default(), 0);
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0);
    let mut least = last;
    let mut idle = 0;
    // The last change that was at most half of this before, and those since.
    let (mut mark, mut slow) = (f64::INFINITY, 0);
    let mut once_more = false;
    if let Some((sweep, movement)) = &seen {
        (last, looked) = (sweeps.change(movement), *sweep);
        (smallest, largest, least) = (size_of(&last), size_of(&last), last);
    }
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
        if tolerates && this.is_within([tolerance; 2], both) {
            return Ok((iteration, sweeps.change(&this).scales()));
        }
        if overlooks && early && this.exceeds(far, both) && this.is_number() {
            if iteration == 1 {
                first = Some(this);
            }
        } else {
            let change = sweeps.change(&this);
            if change.is_undefined() {
                if iteration == 1 {
                    return Err(non_finite(
                        sweeps.non_finite_force(),
                        || sweeps.non_finite(),
                        &change,
                    ));
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
            if W::STOPS_AT_ROUNDING
                && is_last::<T>(before.map(|x| sweeps.change(&x)), &change, both)
            {
                return Ok((iteration, change.scales()));
            }
            let size = size_of(&change);
            if looked == 0 {
                (overlooks, far) = (true, units::<T>(FAR, change.scales()));
            }
            (last, looked) = (change, iteration);
            largest = larger(size, largest);
            // Comparisons, for it is a number: `min` and `max` look whether it is.
            (smallest, least, idle) = if size < smallest {
                (size, change, 0)
            } else {
                (smallest, least, idle + 1)
            };
            (mark, slow) = if size <= 0.5 * mark {
                (size, 0)
            } else {
                (mark, slow + 1)
            };
            let is_rounding = || settling::<C>(&change) <= ROUNDING * T::EPSILON;
            // What rounding does may be amplified by all sweeps after the one whose change was the smallest.
            let is_noise = || {
                let at_first = first.map_or(0.0, |first| size_of(&sweeps.change(&first)));
                smallest <= CONTRACTION * larger(at_first, largest)
                    && settling::<Separable>(&least) <= ROUNDING * T::EPSILON
                    && settling::<Separable>(&change) <= AMPLIFIED * T::EPSILON
            };
            if size == 0.0 {
                return Ok((iteration, change.scales()));
            }
            // At the bound one sweep without progress will do.
            let waited = iteration == max_iterations || idle > iteration / STAGNATION;
            if idle > 0 && waited && (is_rounding() || idle >= PATIENCE && is_noise()) {
                // At the bound there is no sweep left to make.
                if W::STOPS_AT_ROUNDING
                    || iteration == max_iterations
                    || !dither_last_sweep(sweeps.time())
                {
                    return Ok((iteration, change.scales()));
                }
                once_more = true;
            }
        }
    }
    let (residual, iterations) = (relative(&last), max_iterations);
    // It came down and stands still, at its noise.
    let came_down = residual <= NOISIEST
        && smallest <= CONTRACTION * largest
        && size_of(&last) <= ROUNDING * smallest;
    Err(if slow >= PATIENCE && came_down {
        Failure::Stagnation {
            residual,
            iterations,
        }
    } else {
        Failure::NoConvergence {
            residual,
            iterations,
        }
    })
}

/// Whether a change, after the one `before`, is the last of an iteration that does not wait for stagnation.
#[inline(always)]
pub(crate) fn is_last<T: Scalar>(
    before: Option<StageChange>,
    change: &StageChange,
    both: bool,
) -> bool {
    let of = |before: Option<f64>, change: &HalfChange| {
        let (unit, this) = (T::EPSILON * change.scale(), change.difference());
        // The next one by a quotient, for numbers of any size.
        let is_next_within = |before| this / before * this <= unit;
        this <= unit || this <= ROUNDING * unit && before.is_some_and(is_next_within)
    };
    of(before.map(|x| x.q.difference()), &change.q)
        && (!both || of(before.map(|x| x.p.difference()), &change.p))
}

/// What is to blame for a first sweep that is not finite: the force of a stage, or the first evaluation that is not finite.
pub(crate) fn non_finite(
    force: Option<usize>,
    evaluation: impl FnOnce() -> Option<(Quantity, usize)>,
    change: &StageChange,
) -> Failure {
    let part = if change.q.is_undefined() {
        Quantity::Position
    } else {
        Quantity::Momentum
    };
    let culprit = match force {
        Some(stage) => Some((Quantity::Force, stage)),
        None => evaluation(),
    };
    let (what, stage) = match culprit {
        Some((what, stage)) => (what, Some(stage)),
        None => (part, None),
    };
    Failure::NonFinite { what, stage }
}
