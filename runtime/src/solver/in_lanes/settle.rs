//! Convergence test of several trajectories, lane by lane: that of a [warm start](crate::solver::convergence) of a single run.

use super::LaneSweeps;
use crate::method::Stopping;
use crate::number::Lanes;
use crate::number::dither::{dither_last_sweep, dither_side};
use crate::solver::convergence::{PATIENCE, ROUNDING, STAGNATION, WITHIN_REACH};
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
    live: u32,
    scales: [L; 2],
    stopping: Stopping,
) -> Settled<L> {
    let late = stopping.max_iterations.min(PATIENCE);
    let bound = stopping.max_iterations.min(STAGNATION);
    let iteration = Iteration {
        live,
        late,
        bound,
        near_by: if C::SEPARABLE { late } else { bound },
        made: 0,
        size: Size::of(scales),
        settled: Settled {
            lanes: 0,
            sweeps: L::from_f64(0.0),
            scales,
        },
    };
    sweeps.begin();
    match W::STOPS_AT_ROUNDING {
        true => iteration.until_rounding::<C, _>(sweeps, stopping.tolerance),
        false => iteration.until_stagnation::<C, _>(sweeps, time),
    }
}

/// An iteration of all lanes.
struct Iteration<L> {
    live: u32,
    late: u32,
    bound: u32,
    near_by: u32,
    /// Number of sweeps made.
    made: u32,
    size: Size<L>,
    settled: Settled<L>,
}

impl<L: Lanes> Iteration<L> {
    /// Ends the iteration in these lanes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn end(&mut self, sweeps: &mut impl LaneSweeps<L>, lanes: u32) {
        if lanes == 0 {
            return;
        }
        sweeps.keep(lanes);
        let made = L::from_f64(f64::from(self.made));
        let settled = &mut self.settled;
        settled.lanes |= lanes;
        settled.sweeps = L::select(lanes, made, settled.sweeps);
        settled.scales =
            [0, 1].map(|half| L::select(lanes, self.size.scales[half], settled.scales[half]));
    }

    /// Takes the sizes of these lanes from the stages, where they are known; returns where.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn measure(&mut self, lanes: u32, scales: [L; 2], both: bool) -> u32 {
        let known = scales.map(is_known);
        let known = lanes & known[0] & if both { known[1] } else { u32::MAX };
        self.size = Size::select(known, &Size::of(scales), &self.size);
        known
    }

    /// Until changes that can be rounding errors have stopped shrinking, and once more if [`dither_last_sweep`] says so.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn until_stagnation<C: Class, W: LaneSweeps<L>>(
        mut self,
        sweeps: &mut W,
        time: f64,
    ) -> Settled<L> {
        let both = !C::SEPARABLE;
        if both && self.late == PATIENCE && dither_side(time) {
            sweeps.sweep();
            sweeps.overrelaxed_sweep();
            self.made += 2;
        }
        let dithers = dither_last_sweep(time);
        let zero = L::from_f64(0.0);
        // Lanes whose change is not near rounding errors yet, those whose change shrinks, and those with one more sweep to make.
        let (mut far, mut shrinking, mut last) = (self.live, 0, 0);
        let mut smallest = L::from_f64(f64::INFINITY);
        while far | shrinking | last != 0 {
            let this = sweeps.sweep();
            self.made += 1;
            self.end(sweeps, last);
            last = 0;
            far &= numbers(&this);
            let mut near = far & settles_within(&this, &self.size.near, both);
            if near != 0 {
                let scales = sweeps.scales();
                let about = [0, 1].map(|half| is_about(scales[half], self.size.scales[half]));
                let moved = near & !(about[0] & about[1]);
                if moved != 0 {
                    let known = self.measure(moved, scales, true);
                    let within = settles_within(&this, &self.size.near, both);
                    near &= !moved | known & within;
                }
                far &= !near;
                shrinking |= near;
            }
            if self.made + 1 >= self.near_by {
                far = 0;
            }
            if shrinking == 0 {
                continue;
            }
            let [q, p] = self.size.scales;
            let size = match both {
                true => (this.q * p).larger(this.p * q),
                false => this.q,
            };
            let positive = zero.below(size);
            let shrinks = shrinking & size.below(smallest) & positive;
            let mut ends = shrinking & !shrinks;
            shrinking = if self.made + 1 >= self.bound {
                0
            } else {
                shrinks
            };
            smallest = L::select(shrinks, size, smallest);
            if ends != 0 {
                ends &= settles_within(&this, &self.size.near, both) & numbers(&this);
                if dithers {
                    let finite = size.below(L::from_f64(f64::INFINITY));
                    last = ends & positive & finite;
                    ends &= !last;
                }
                self.end(sweeps, ends);
            }
        }
        self.settled
    }

    /// Until a change can be rounding errors and the next one would be at most one unit of EPSILON; in lanes for which the tolerance is
    /// within reach, until a change is within the tolerance.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn until_rounding<C: Class, W: LaneSweeps<L>>(
        mut self,
        sweeps: &mut W,
        tolerance: f64,
    ) -> Settled<L> {
        let both = !C::SEPARABLE;
        let tolerances = [L::from_f64(tolerance); 2];
        let reach = units(WITHIN_REACH, self.size.scales);
        let mut tolerant = self.live & reach[0].at_most(tolerances[0]);
        if both {
            tolerant &= reach[1].at_most(tolerances[1]);
        }
        let mut exact = self.live & !tolerant;
        // Lanes with a change that was near rounding errors, but not the last one.
        let mut seen = 0;
        let mut before: Option<LaneMovement<L>> = None;
        while exact | tolerant != 0 {
            if self.made + 1 >= self.near_by {
                tolerant = 0;
            }
            if self.made + 1 >= self.late {
                exact = 0;
            }
            if exact | tolerant == 0 {
                break;
            }
            let this = sweeps.sweep();
            self.made += 1;
            let ends = tolerant & is_within(&this, &tolerances, both);
            tolerant &= !ends & numbers(&this);
            self.end(sweeps, ends);
            exact &= numbers(&this);
            let near = exact & is_within(&this, &self.size.near, both);
            if near != 0 {
                let scales = sweeps.scales();
                let is_last = |size: &Size<L>| {
                    let one = units(1.0, size.scales);
                    let next = |before: &LaneMovement<L>| {
                        let of = |before: L, this: L, one: L| (this * this).at_most(before * one);
                        let q = of(before.q, this.q, one[0]);
                        q & if both {
                            of(before.p, this.p, one[1])
                        } else {
                            u32::MAX
                        }
                    };
                    is_within(&this, &one, both) | before.as_ref().map_or(0, next)
                };
                let mut about = is_about(scales[0], self.size.scales[0]);
                if both {
                    about &= is_about(scales[1], self.size.scales[1]);
                }
                let ends = near & is_last(&self.size) & about;
                self.end(sweeps, ends);
                exact &= !ends;
                let known = self.measure(near & !ends, scales, both);
                let near = known & is_within(&this, &self.size.near, both);
                let ends = near & is_last(&self.size);
                self.end(sweeps, ends);
                exact &= !ends & !(near & seen);
                seen |= near;
            }
            before = Some(this);
        }
        self.settled
    }
}

/// Sizes of the stages, and the bounds below which changes can be rounding errors.
struct Size<L> {
    scales: [L; 2],
    near: [L; 2],
}

impl<L: Lanes> Size<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(scales: [L; 2]) -> Self {
        Self {
            scales,
            near: units(ROUNDING, scales),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn select(lanes: u32, yes: &Self, no: &Self) -> Self {
        let select = |yes: [L; 2], no: [L; 2]| [0, 1].map(|k| L::select(lanes, yes[k], no[k]));
        Self {
            scales: select(yes.scales, no.scales),
            near: select(yes.near, no.near),
        }
    }
}

/// `count` units of EPSILON of numbers of these sizes.
#[cfg_attr(not(debug_assertions), inline(always))]
fn units<L: Lanes>(count: f64, scales: [L; 2]) -> [L; 2] {
    scales.map(|scale| L::from_f64(count * L::EPSILON) * scale)
}

/// Where the change is no NaN.
#[cfg_attr(not(debug_assertions), inline(always))]
fn numbers<L: Lanes>(change: &LaneMovement<L>) -> u32 {
    let infinite = L::from_f64(f64::INFINITY);
    change.q.at_most(infinite) & change.p.at_most(infinite)
}

/// Where the change of the positions, or that of the momenta, is within the bounds; if `both`, where both are.
#[cfg_attr(not(debug_assertions), inline(always))]
fn settles_within<L: Lanes>(change: &LaneMovement<L>, [q, p]: &[L; 2], both: bool) -> u32 {
    let (of_q, of_p) = (change.q.at_most(*q), change.p.at_most(*p));
    if both { of_q & of_p } else { of_q | of_p }
}

/// Where the change of the positions, and if `both` that of the momenta, is within the bounds.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_within<L: Lanes>(change: &LaneMovement<L>, [q, p]: &[L; 2], both: bool) -> u32 {
    let of_q = change.q.at_most(*q) & numbers(change);
    if both {
        of_q & change.p.at_most(*p)
    } else {
        of_q
    }
}

/// Where a size equals another up to a factor of two.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_about<L: Lanes>(size: L, other: L) -> u32 {
    let half = L::from_f64(0.5) * other;
    half.below(size) & size.at_most(L::from_f64(2.0) * other)
}

/// Where the rounding errors of numbers of this size can be squared safely.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_known<L: Lanes>(size: L) -> u32 {
    let unit = L::from_f64(L::EPSILON) * size;
    L::from_f64(1e-140).below(unit) & unit.below(L::from_f64(1e140))
}
