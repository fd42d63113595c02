//! Convergence test of several trajectories, lane by lane: that of a [single run](crate::solver::convergence) with a warm start.

use super::LaneSweeps;
use crate::method::Stopping;
use crate::number::Lanes;
use crate::number::dither::{dither_last_sweep, dither_side};
use crate::solver::convergence::{PATIENCE, ROUNDING, STAGNATION};
use crate::solver::simd::change::LaneMovement;
use crate::system::Class;

/// The lanes that have settled, with the number of sweeps and the sizes of the stages.
pub(super) struct Settled<L> {
    pub(super) lanes: u32,
    pub(super) sweeps: L,
    pub(super) scales: [L; 2],
}

/// Sweeps from the stages of the previous step, which have the sizes `scales`, until every one of the `live` lanes has settled or is left to
/// a single run. A lane that settles here does so in the same sweep as its single run. A lane with NaN never does.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn settle<C: Class, L: Lanes, W: LaneSweeps<L>>(
    sweeps: &mut W,
    time: f64,
    mut live: u32,
    mut scales: [L; 2],
    stopping: Stopping,
) -> Settled<L> {
    let (both, waits) = (!C::SEPARABLE, !W::STOPS_AT_ROUNDING);
    let tolerance = if waits { 0.0 } else { stopping.tolerance };
    let late = stopping.max_iterations.min(PATIENCE);
    // After this many sweeps one without progress no longer suffices, or no further sweep is allowed.
    let bound = stopping.max_iterations.min(STAGNATION);
    let (zero, infinite) = (L::from_f64(0.0), L::from_f64(f64::INFINITY));
    let bounds = |scales: [L; 2]| {
        scales.map(|size| {
            let rounding = L::from_f64(2.0 * ROUNDING * L::EPSILON) * size;
            L::select(
                size.at_most(zero),
                infinite,
                rounding.larger(L::from_f64(tolerance)),
            )
        })
    };
    let mut near = bounds(scales);
    let most = L::from_f64(f64::MAX);
    let inverses = |scales: [L; 2]| {
        scales.map(|size| L::select((size.recip()).below(most), size.recip(), most))
    };
    let mut inverse = inverses(scales);
    let mut settled = Settled {
        lanes: 0,
        sweeps: zero,
        scales,
    };
    sweeps.begin();
    let mut made = 0;
    if waits && both && late == PATIENCE && dither_side(time) {
        sweeps.sweep();
        sweeps.overrelaxed_sweep();
        made += 2;
    }
    // Lanes whose sizes no longer vary, those with a change that could be rounding errors, and those with one more sweep to make.
    let (mut measured, mut reached, mut last) = (0, 0, 0);
    let (mut smallest, mut idle) = (infinite, zero);
    let mut before: Option<[L; 2]> = None;
    loop {
        if made + 1 >= bound {
            live &= last;
        }
        if live == 0 {
            break;
        }
        let LaneMovement { q, p } = sweeps.sweep();
        made += 1;
        let this = [q, p];
        let previous = before.replace(this);
        let mut ends = last;
        live &= !last;
        last = 0;
        let exceeds = [0, 1].map(|half| near[half].below(this[half]));
        let far = match (exceeds, both) {
            ([q, p], true) => q | p,
            ([q, p], false) => q & p,
        };
        let mut examined = if made < late { live & !far } else { live };
        if examined != 0 {
            let fresh = examined & !measured;
            if fresh != 0 {
                let new = sweeps.scales();
                scales = [0, 1].map(|half| L::select(fresh, new[half], scales[half]));
                inverse = inverses(scales);
            }
            let change = [q * inverse[0], p * inverse[1]];
            // Where a change is infinite or NaN, a single run begins again.
            live &= !examined | (q + p).at_most(most);
            examined &= live;
            if !waits {
                let tolerated = this.map(|this| this.at_most(L::from_f64(tolerance)));
                let is_last = [0, 1].map(|half| {
                    let before = previous.map(|before| before[half] * inverse[half]);
                    is_last(before, change[half])
                });
                let of_both = |[q, p]: [u32; 2]| if both { q & p } else { q };
                ends |= examined & (of_both(tolerated) | of_both(is_last));
                examined &= !ends;
            }
            let size = match both {
                true => change[0].larger(change[1]),
                false => q,
            };
            let zeros = examined & size.at_most(zero);
            ends |= zeros;
            examined &= !zeros;
            let near_by = change.map(|change| change.at_most(L::from_f64(ROUNDING * L::EPSILON)));
            let rounding = match (near_by, both) {
                ([q, p], true) => q & p,
                ([q, p], false) => q | p,
            };
            reached |= examined & rounding;
            measured |= examined & near_by[0] & rounding;
            let next = bounds(scales);
            near = [0, 1].map(|half| {
                let next = L::select(reached, infinite, next[half]);
                L::select(examined, next, near[half])
            });
            if made < late {
                examined &= reached;
            }
            let shrinks = size.below(smallest);
            smallest = L::select(examined & shrinks, size, smallest);
            let more = L::select(shrinks, zero, idle + L::from_f64(1.0));
            idle = L::select(examined, more, idle);
            let stagnates = examined & !shrinks & rounding;
            match waits && dither_last_sweep(time) {
                true => last = stagnates,
                false => ends |= stagnates,
            }
            // Where there is no progress, a single run decides whether that is noise.
            live &= idle.below(L::from_f64(f64::from(PATIENCE)));
        }
        if ends != 0 {
            sweeps.keep(ends);
            settled.lanes |= ends;
            settled.sweeps = L::select(ends, L::from_f64(f64::from(made)), settled.sweeps);
            settled.scales = [0, 1].map(|half| L::select(ends, scales[half], settled.scales[half]));
            live &= !ends;
        }
    }
    settled
}

/// Where a relative change ends an iteration that does not wait for stagnation.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_last<L: Lanes>(before: Option<L>, this: L) -> u32 {
    let bound = |count: f64| L::from_f64(count * L::EPSILON);
    let next = |before: L| (this * this).at_most(before * bound(1.0));
    this.at_most(bound(1.0)) | this.at_most(bound(ROUNDING)) & before.map_or(0, next)
}
