//! Convergence test of several trajectories, lane by lane: that of a single run with a warm start.

use super::LaneSweeps;
use symplectic_core::inside::sweeps::{LaneMovement, PATIENCE};
use symplectic_core::inside::{ROUNDING, STAGNATION, dither_last_sweep, dither_side};
use symplectic_core::simd::Lanes;
use symplectic_core::solver::Stopping;
use symplectic_core::system::Class;

/// The lanes that have settled, with the number of sweeps and the sizes of the stages.
pub(super) struct Settled<L> {
    pub(super) lanes: u32,
    pub(super) sweeps: L,
    pub(super) scales: [L; 2],
}

/// Sweeps from the stages of the previous step, which have the sizes `scales`. Ends when each of the `live` lanes has settled or is left to
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
    let mut near = bounds(scales, tolerance);
    let most = L::from_f64(f64::MAX);
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
        let exceeds = [near[0].below(q), near[1].below(p)];
        let far = match (exceeds, both) {
            ([q, p], true) => q | p,
            ([q, p], false) => q & p,
        };
        let mut examined = if made < late { live & !far } else { live };
        if examined != 0 {
            let fresh = examined & !measured;
            if fresh != 0 {
                let new = sweeps.scales();
                scales = select(fresh, new, scales);
                inverse = inverses(scales);
            }
            let change = [q * inverse[0], p * inverse[1]];
            // Where a change is infinite or NaN, a single run begins again.
            live &= !examined | (q + p).at_most(most);
            examined &= live;
            if !waits {
                let tolerated = at_most(this, tolerance);
                let is_last = match previous {
                    Some([q, p]) => [
                        is_last(Some(q * inverse[0]), change[0]),
                        is_last(Some(p * inverse[1]), change[1]),
                    ],
                    None => [is_last(None, change[0]), is_last(None, change[1])],
                };
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
            let near_by = at_most(change, ROUNDING * L::EPSILON);
            let rounding = match (near_by, both) {
                ([q, p], true) => q & p,
                ([q, p], false) => q | p,
            };
            reached |= examined & rounding;
            measured |= examined & near_by[0] & rounding;
            let next = select(reached, [infinite; 2], bounds(scales, tolerance));
            near = select(examined, next, near);
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
            settled.scales = select(ends, scales, settled.scales);
            live &= !ends;
        }
    }
    settled
}

// Two halves each. Closures that compute with lanes may not be inlined: no `map` here.

/// The largest changes that could be rounding errors, or are tolerated; infinite where a size is zero.
#[cfg_attr(not(debug_assertions), inline(always))]
fn bounds<L: Lanes>([q, p]: [L; 2], tolerance: f64) -> [L; 2] {
    let (zero, infinite) = (L::from_f64(0.0), L::from_f64(f64::INFINITY));
    let (unit, tolerance) = (
        L::from_f64(2.0 * ROUNDING * L::EPSILON),
        L::from_f64(tolerance),
    );
    [
        L::select(q.at_most(zero), infinite, (unit * q).larger(tolerance)),
        L::select(p.at_most(zero), infinite, (unit * p).larger(tolerance)),
    ]
}

/// The inverses of sizes, but no infinite ones.
#[cfg_attr(not(debug_assertions), inline(always))]
fn inverses<L: Lanes>([q, p]: [L; 2]) -> [L; 2] {
    let (most, [q, p]) = (L::from_f64(f64::MAX), [q.recip(), p.recip()]);
    [
        L::select(q.below(most), q, most),
        L::select(p.below(most), p, most),
    ]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn select<L: Lanes>(lanes: u32, yes: [L; 2], no: [L; 2]) -> [L; 2] {
    [
        L::select(lanes, yes[0], no[0]),
        L::select(lanes, yes[1], no[1]),
    ]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn at_most<L: Lanes>([q, p]: [L; 2], bound: f64) -> [u32; 2] {
    let bound = L::from_f64(bound);
    [q.at_most(bound), p.at_most(bound)]
}

/// Where a relative change ends an iteration that does not wait for stagnation.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_last<L: Lanes>(before: Option<L>, this: L) -> u32 {
    let (one, more) = (L::from_f64(L::EPSILON), L::from_f64(ROUNDING * L::EPSILON));
    let next = match before {
        Some(before) => (this * this).at_most(before * one),
        None => 0,
    };
    this.at_most(one) | this.at_most(more) & next
}
