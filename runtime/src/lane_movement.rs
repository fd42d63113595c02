//! How sweeps move stages in lanes.

use crate::iteration::{Movement, is_next_within};
use crate::{Lanes, PartChange};

/// How a sweep moved the stages, lane by lane.
#[derive(Clone, Copy)]
pub(crate) struct LaneMovement<L> {
    pub(crate) q: LanePart<L>,
    pub(crate) p: LanePart<L>,
}

/// How it moved the positions, or the momenta.
#[derive(Clone, Copy)]
pub(crate) struct LanePart<L> {
    /// The largest change of a component; where one is NaN, any.
    pub(crate) difference: L,
    /// All changes together: NaN if one is.
    pub(crate) sum: L,
}

impl<L: Lanes> Movement for LaneMovement<L> {
    #[inline(always)]
    fn is_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        self.q.is_within(q) && (!both || self.p.is_within(p))
    }

    #[inline(always)]
    fn settles_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        match both {
            true => self.q.is_within(q) & self.p.is_within(p),
            false => {
                self.q.is_within(q) && !self.p.sum.any_nan()
                    || self.p.is_within(p) && !self.q.sum.any_nan()
            }
        }
    }

    #[inline(always)]
    fn exceeds(&self, [q, p]: [f64; 2], both: bool) -> bool {
        self.q.exceeds(q) && (!both || self.p.exceeds(p))
    }

    #[inline(always)]
    fn is_next_within(&self, before: &Self, [q, p]: [f64; 2], both: bool) -> bool {
        self.q.is_next_within(&before.q, q) && (!both || self.p.is_next_within(&before.p, p))
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
        let (of_q, of_p) = (self.q.difference, self.p.difference);
        match both {
            true => (of_q * L::from_f64(q)).larger(of_p * L::from_f64(p)),
            false => of_q,
        }
    }
}

impl<L: Lanes> LanePart<L> {
    /// No change.
    #[inline(always)]
    pub(crate) fn none() -> Self {
        let zero = L::from_f64(0.0);
        Self {
            difference: zero,
            sum: zero,
        }
    }

    /// With that of one more component: not from zero, which the compiler has to add. The lanes take the larger numbers, and may lose what
    /// is not one; the sum does not.
    #[inline(always)]
    pub(crate) fn noted(part: Option<Self>, moved: L) -> Self {
        match part {
            Some(Self { difference, sum }) => Self {
                difference: difference.larger(moved),
                sum: sum + moved,
            },
            None => Self {
                difference: moved,
                sum: moved,
            },
        }
    }

    /// All lanes together; `scale` is the largest component, lane by lane.
    #[inline(always)]
    pub(crate) fn change(&self, scale: L) -> PartChange {
        if self.sum.any_nan() {
            return PartChange::new(f64::NAN, f64::NAN);
        }
        PartChange::new(self.difference.largest(), scale.largest())
    }

    #[inline(always)]
    fn is_next_within(&self, before: &Self, bound: f64) -> bool {
        let (this, before) = (self.difference, before.difference);
        // What holds in every lane holds for the largest of all, for which the processor would have to wait.
        let in_lanes = !(this * this - before * L::from_f64(bound)).any_above(0.0);
        in_lanes || is_next_within(before.largest(), this.largest(), bound)
    }

    #[inline(always)]
    fn is_within(&self, bound: f64) -> bool {
        !self.difference.any_above(bound) && !self.sum.any_nan()
    }

    #[inline(always)]
    fn exceeds(&self, bound: f64) -> bool {
        self.difference.any_above(bound) && !self.sum.any_nan()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Change, F64x2, Scalar};

    /// How lanes moved, and the same as one number for each half.
    fn moved(lanes: [[f64; 2]; 2]) -> (LaneMovement<F64x2>, Change) {
        let [q, p] = lanes.map(|lanes| {
            let lanes = F64x2::from_array(lanes);
            LanePart {
                // The larger ones lose what is not a number.
                difference: F64x2::from_f64(0.0).larger(lanes),
                sum: lanes,
            }
        });
        let one = F64x2::from_f64(1.0);
        let change = Change {
            q: q.change(one),
            p: p.change(one),
        };
        (LaneMovement { q, p }, change)
    }

    #[test]
    fn lanes_are_compared_as_the_largest_of_them_is() {
        let numbers = [0.0, 0.25, 1.0, 3.0, f64::INFINITY, f64::NAN];
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
                    if !change.is_undefined() {
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
}
