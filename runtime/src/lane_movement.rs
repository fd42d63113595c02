//! How sweeps move stages in lanes.

use crate::iteration::{Movement, is_next_within};
use crate::{Lanes, PartChange};

/// How a sweep moved the stages: the largest change of a component, lane by lane. What is not a number may be lost, see
/// [`is_number`](crate::iteration::Sweeps::is_number).
#[derive(Clone, Copy)]
pub(crate) struct LaneMovement<L> {
    pub(crate) q: L,
    pub(crate) p: L,
}

impl<L: Lanes> Movement for LaneMovement<L> {
    #[inline(always)]
    fn is_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        !self.q.any_above(q) && (!both || !self.p.any_above(p))
    }

    #[inline(always)]
    fn settles_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        let (of_q, of_p) = (!self.q.any_above(q), !self.p.any_above(p));
        if both { of_q & of_p } else { of_q | of_p }
    }

    #[inline(always)]
    fn exceeds(&self, [q, p]: [f64; 2], both: bool) -> bool {
        self.q.any_above(q) && (!both || self.p.any_above(p))
    }

    #[inline(always)]
    fn is_next_within(&self, before: &Self, [q, p]: [f64; 2], both: bool) -> bool {
        let of = |before: L, this: L, bound: f64| {
            // What holds in every lane holds for the largest of all, for which the processor would have to wait.
            let in_lanes = !(this * this - before * L::from_f64(bound)).any_above(0.0);
            in_lanes || is_next_within(before.largest(), this.largest(), bound)
        };
        of(before.q, self.q, q) && (!both || of(before.p, self.p, p))
    }

    #[inline(always)]
    fn size(&self, weights: [f64; 2], both: bool) -> f64 {
        self.sizes(weights, both).largest()
    }

    #[inline(always)]
    fn shrinks(&self, below: f64, weights: [f64; 2], both: bool) -> bool {
        // The processor need not wait for the largest of all lanes.
        let sizes = self.sizes(weights, both);
        sizes.all_below(below) & sizes.any_above(0.0)
    }
}

impl<L: Lanes> LaneMovement<L> {
    /// [`size`](Movement::size), lane by lane.
    #[inline(always)]
    fn sizes(&self, [q, p]: [f64; 2], both: bool) -> L {
        match both {
            true => (self.q * L::from_f64(q)).larger(self.p * L::from_f64(p)),
            false => self.q,
        }
    }
}

/// The change of one half in all lanes together, if it is a number; `scale` is the largest component, lane by lane.
#[inline(always)]
pub(crate) fn part_change<L: Lanes>(difference: L, scale: L, is_number: bool) -> PartChange {
    match is_number {
        true => PartChange::new(difference.largest(), scale.largest()),
        false => PartChange::new(f64::NAN, f64::NAN),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Change, F64x2, Scalar};

    /// How lanes moved, and the same as one number for each half.
    fn moved(lanes: [[f64; 2]; 2]) -> (LaneMovement<F64x2>, Change) {
        let [q, p] = lanes.map(F64x2::from_array);
        let one = F64x2::from_f64(1.0);
        let change = Change {
            q: part_change(q, one, true),
            p: part_change(p, one, true),
        };
        (LaneMovement { q, p }, change)
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
                }
            }
        }
    }
}
