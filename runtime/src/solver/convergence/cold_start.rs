//! Convergence test that examines each sweep.

use super::{
    AMPLIFIED, Begun, CONTRACTION, FAR, Movement, NOISIEST, PATIENCE, ROUNDING, STAGNATION, Sweeps,
    is_known, known, larger, units,
};
use crate::error::Quantity;
use crate::method::{Failure, HalfChange, StageChange, StepStatistics, Stopping, WarmStart};
use crate::number::Scalar;
use crate::number::dither::dither_last_sweep;
use crate::solver::convergence::settling;
use crate::system::{Class, Separable};

/// Iterates until the stages have settled, starting from `begun`; returns the statistics of all sweeps.
///
/// A function of its own, so that its variables take no registers in steps that do not need it.
#[inline(never)]
pub(crate) fn settle_from_cold_start<C: Class, T: Scalar, W: Sweeps>(
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
        // The warm start may be misleading: repeat the iteration without it.
        (kept.stages, begun) = (false, Begun::NOTHING);
    }
}

/// Finds the coupled stages, and adds the statistics to `work`.
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
    // After a warm start the first sweep reveals it, and the second attempt, without the warm start, reports it.
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
            work.scales = known::<T>(scales, !C::SEPARABLE || !W::STOPS_AT_ROUNDING);
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

/// Sweeps until stagnation; returns the number of sweeps, and the sizes of the stages, if known.
///
/// A growing change does not end the iteration. With many stages and a coupling matrix far from normal, it can
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
    let both = !C::SEPARABLE;
    // Sweeps before this one are early.
    let late = max_iterations.min(PATIENCE);
    let tolerates = W::STOPS_AT_ROUNDING && tolerance > 0.0;
    let relative = |change: &StageChange| match both {
        true => change.residual(),
        false => change.q.relative(),
    };
    // The size that shrinks from sweep to sweep; for one half alone no division is needed.
    let size_of = |change: &StageChange| match both {
        true => change.residual(),
        false => change.q.difference(),
    };
    // Whether large changes are skipped, and how large: without a warm start the first sweep must be examined for NaN or infinite
    // values.
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
    // The last change that was at most half of the previous mark, and the number of sweeps since.
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
                // The iteration diverged: report the previous change, if it was examined.
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
            // Comparisons, because `size` is not NaN: `min` and `max` would test for it.
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
            // After the sweep with the smallest change, later sweeps may amplify rounding errors.
            let is_noise = || {
                let at_first = first.map_or(0.0, |first| size_of(&sweeps.change(&first)));
                smallest <= CONTRACTION * larger(at_first, largest)
                    && settling::<Separable>(&least) <= ROUNDING * T::EPSILON
                    && settling::<Separable>(&change) <= AMPLIFIED * T::EPSILON
            };
            if size == 0.0 {
                return Ok((iteration, change.scales()));
            }
            // At the bound, one sweep without progress suffices.
            let waited = iteration == max_iterations || idle > iteration / STAGNATION;
            if idle > 0 && waited && (is_rounding() || idle >= PATIENCE && is_noise()) {
                // At the bound, no further sweep is allowed.
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
    // The change shrank and then stagnated at the level of its noise.
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

/// Whether this change, after the change `before`, ends an iteration that does not wait for stagnation.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn is_last<T: Scalar>(
    before: Option<StageChange>,
    change: &StageChange,
    both: bool,
) -> bool {
    let of = |before: Option<f64>, change: &HalfChange| {
        let (unit, this) = (T::EPSILON * change.scale(), change.difference());
        // Estimates the next change by a quotient, which works for numbers of any size.
        let is_next_within = |before| this / before * this <= unit;
        this <= unit || this <= ROUNDING * unit && before.is_some_and(is_next_within)
    };
    of(before.map(|x| x.q.difference()), &change.q)
        && (!both || of(before.map(|x| x.p.difference()), &change.p))
}

/// The cause of a first sweep that is NaN or infinite: the force of a stage, or the first such evaluation.
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
