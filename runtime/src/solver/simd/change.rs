//! Changes of stages in lanes by a sweep.

use crate::method::HalfChange;
use crate::number::Lanes;
use crate::solver::convergence::{Movement, is_next_within};

/// Change of the positions and the momenta of the stages in a sweep: the largest change of a component, lane by lane. NaN if any change
/// is NaN. A stage that recovers from NaN has also changed by NaN.
#[derive(Clone, Copy)]
pub(crate) struct LaneMovement<L> {
    pub(crate) q: L,
    pub(crate) p: L,
}

/// The largest change so far and one more. `None` instead of zero at the start: otherwise the compiler would compare with zero.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn noted<L: Lanes>(largest: Option<L>, change: L) -> L {
    largest.map_or(change, |largest| largest.larger_or_nan(change))
}

/// Reduces the largest change and the largest component of each lane to those of all lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn part_change<L: Lanes>(change: L, scale: L) -> HalfChange {
    match change.any_nan() {
        false => HalfChange::new(change.largest(), scale.largest()),
        true => HalfChange::new(f64::NAN, f64::NAN),
    }
}

impl<L: Lanes> Movement for LaneMovement<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        !self.q.any_above(q) && (!both || !self.p.any_above(p)) && self.is_number()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn settles_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        let (of_q, of_p) = (!self.q.any_above(q), !self.p.any_above(p));
        if both { of_q & of_p } else { of_q | of_p }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn exceeds(&self, [q, p]: [f64; 2], both: bool) -> bool {
        self.q.any_above(q) && (!both || self.p.any_above(p))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_next_within(&self, before: &Self, [q, p]: [f64; 2], both: bool) -> bool {
        let of = |before: L, this: L, bound: f64| {
            // A bound that holds in every lane holds for the maximum over the lanes, for which the processor would have to wait.
            let in_lanes = !(this * this - before * L::from_f64(bound)).any_above(0.0);
            (in_lanes || is_next_within(before.largest(), this.largest(), bound))
                && !before.any_nan()
        };
        of(before.q, self.q, q) && (!both || of(before.p, self.p, p))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn size(&self, weights: [f64; 2], both: bool) -> f64 {
        self.sizes(weights, both).largest()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shrinks(&self, below: f64, weights: [f64; 2], both: bool) -> bool {
        // The processor need not wait for the maximum over all lanes.
        let sizes = self.sizes(weights, both);
        sizes.all_below(below) & sizes.any_above(0.0)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_number(&self) -> bool {
        !(self.q + self.p).any_nan()
    }
}

impl<L: Lanes> LaneMovement<L> {
    /// [`size`](Movement::size), lane by lane.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sizes(&self, [q, p]: [f64; 2], both: bool) -> L {
        match both {
            true => (self.q * L::from_f64(q)).larger(self.p * L::from_f64(p)),
            false => self.q,
        }
    }
}

#[cfg(test)]
mod tests {
    use num_traits::Zero;

    use super::*;
    use crate::method::StageChange;
    use crate::number::{F64x2, Scalar};

    /// A change lane by lane, and the same change as one number for each half.
    fn moved(lanes: [[f64; 2]; 2]) -> (LaneMovement<F64x2>, StageChange) {
        let [q, p] = lanes.map(F64x2::from_array);
        let one = F64x2::from_f64(1.0);
        let [of_q, of_p] = [q, p].map(|change| part_change(change, one));
        let change = StageChange { q: of_q, p: of_p };
        (LaneMovement { q, p }, change)
    }

    #[test]
    fn what_is_not_a_number_is_not_lost() {
        let changes = [[1.0, 0.5], [2.0, 0.0], [0.25, 3.0]];
        let all_noted = |changes: &[[f64; 2]]| {
            let changes = changes.iter().map(|&change| F64x2::from_array(change));
            let largest = changes.fold(None, |largest, x| Some(noted(largest, x)));
            largest.unwrap_or_else(F64x2::zero)
        };
        let ones = F64x2::from_f64(1.0);
        let all = all_noted(&changes);
        assert_eq!(part_change(all, ones), HalfChange::new(3.0, 1.0));
        assert!(LaneMovement { q: all, p: all }.is_number());
        assert_eq!(part_change(all_noted(&[]), ones), HalfChange::new(0.0, 1.0));
        for component in 0..3 {
            for lane in 0..2 {
                let mut changes = changes;
                changes[component][lane] = f64::NAN;
                let none = all_noted(&changes);
                assert!(part_change(none, ones).is_undefined());
                assert!(!LaneMovement { q: none, p: all }.is_number());
                for both in [false, true] {
                    assert!(!LaneMovement { q: none, p: all }.is_within([10.0; 2], both));
                    assert!(!LaneMovement { q: all, p: none }.is_within([10.0; 2], both));
                }
                assert!(!LaneMovement { q: all, p: none }.is_number());
            }
        }
    }

    #[test]
    fn lanes_are_compared_as_the_largest_of_them_is() {
        let numbers = [0.0, 0.25, 1.0, 3.0, f64::INFINITY];
        let all = || numbers.iter().flat_map(|&x| numbers.map(|y| [x, y]));
        for q in all() {
            for p in all() {
                let (lanes, change) = moved([q, p]);
                for both in [true, false] {
                    for bounds in [[0.5, 0.5], [2.0, 0.5], [0.1, 2.0], [0.0, 0.0]] {
                        let found = [
                            lanes.is_within(bounds, both),
                            lanes.settles_within(bounds, both),
                            lanes.exceeds(bounds, both),
                        ];
                        let expected = [
                            change.is_within(bounds, both),
                            change.settles_within(bounds, both),
                            change.exceeds(bounds, both),
                        ];
                        assert_eq!(found, expected, "{q:?} {p:?} {bounds:?} {both}");
                    }
                    let sizes = [lanes.size([2.0, 0.5], both), change.size([2.0, 0.5], both)];
                    assert_eq!(sizes[0], sizes[1], "{q:?} {p:?} {both}");
                    for below in [0.0, 0.5, sizes[0], 2.0, f64::INFINITY] {
                        let [this, other] = [
                            lanes.shrinks(below, [2.0, 0.5], both),
                            change.shrinks(below, [2.0, 0.5], both),
                        ];
                        assert_eq!(this, other, "{q:?} {p:?} {both} {below}");
                    }
                    for before in [[0.0, 0.5], [0.25, 0.25], [f64::NAN, 0.0]] {
                        let (lanes_before, change_before) = moved([before, before]);
                        let [this, other] = [
                            lanes.is_next_within(&lanes_before, [0.5, 0.25], both),
                            change.is_next_within(&change_before, [0.5, 0.25], both),
                        ];
                        assert_eq!(this, other, "{q:?} {p:?} {both} {before:?}");
                    }
                }
            }
        }
    }
}
