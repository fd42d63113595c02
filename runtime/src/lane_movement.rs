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
    /// The largest change of a component; any where one is NaN.
    pub(crate) largest: L,
    /// All changes together: NaN where one is. A stage that is a number again after it was none has changed by NaN too.
    pub(crate) sum: L,
}

impl<L: Lanes> LanePart<L> {
    /// With one more change: not from zero, which the compiler has to add.
    #[inline(always)]
    pub(crate) fn noted(part: Option<Self>, change: L) -> Self {
        match part {
            Some(Self { largest, sum }) => Self {
                largest: largest.larger(change),
                sum: sum + change,
            },
            None => Self {
                largest: change,
                sum: change,
            },
        }
    }

    /// No change, where there is no component.
    #[inline(always)]
    pub(crate) fn or_none(part: Option<Self>) -> Self {
        part.unwrap_or_else(|| Self::noted(None, L::zero()))
    }

    /// That of all lanes together; `scale` is the largest component, lane by lane.
    #[inline(always)]
    pub(crate) fn change(&self, scale: L) -> PartChange {
        match self.sum.any_nan() {
            false => PartChange::new(self.largest.largest(), scale.largest()),
            true => PartChange::new(f64::NAN, f64::NAN),
        }
    }
}

impl<L: Lanes> Movement for LaneMovement<L> {
    #[inline(always)]
    fn is_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        !self.q.largest.any_above(q) && (!both || !self.p.largest.any_above(p))
    }

    #[inline(always)]
    fn settles_within(&self, [q, p]: [f64; 2], both: bool) -> bool {
        let (of_q, of_p) = (!self.q.largest.any_above(q), !self.p.largest.any_above(p));
        if both { of_q & of_p } else { of_q | of_p }
    }

    #[inline(always)]
    fn exceeds(&self, [q, p]: [f64; 2], both: bool) -> bool {
        self.q.largest.any_above(q) && (!both || self.p.largest.any_above(p))
    }

    #[inline(always)]
    fn is_next_within(&self, before: &Self, [q, p]: [f64; 2], both: bool) -> bool {
        let of = |before: LanePart<L>, this: LanePart<L>, bound: f64| {
            let sum = before.sum;
            let (before, this) = (before.largest, this.largest);
            // What holds in every lane holds for the largest of all, for which the processor would have to wait.
            let in_lanes = !(this * this - before * L::from_f64(bound)).any_above(0.0);
            (in_lanes || is_next_within(before.largest(), this.largest(), bound)) && !sum.any_nan()
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

    #[inline(always)]
    fn is_number(&self) -> bool {
        !(self.q.sum + self.p.sum).any_nan()
    }
}

impl<L: Lanes> LaneMovement<L> {
    /// [`size`](Movement::size), lane by lane.
    #[inline(always)]
    fn sizes(&self, [q, p]: [f64; 2], both: bool) -> L {
        match both {
            true => (self.q.largest * L::from_f64(q)).larger(self.p.largest * L::from_f64(p)),
            false => self.q.largest,
        }
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
        let [q, p] = [q, p].map(|change| LanePart::noted(None, change));
        let change = Change {
            q: q.change(one),
            p: p.change(one),
        };
        (LaneMovement { q, p }, change)
    }

    #[test]
    fn what_is_not_a_number_is_not_lost() {
        let changes = [[1.0, 0.5], [2.0, 0.0], [0.25, 3.0]];
        let noted = |changes: &[[f64; 2]]| {
            let changes = changes.iter().map(|&change| F64x2::from_array(change));
            LanePart::or_none(changes.fold(None, |part, x| Some(LanePart::noted(part, x))))
        };
        let ones = F64x2::from_f64(1.0);
        let all = noted(&changes);
        assert_eq!(all.change(ones), PartChange::new(3.0, 1.0));
        assert!(LaneMovement { q: all, p: all }.is_number());
        assert_eq!(noted(&[]).change(ones), PartChange::new(0.0, 1.0));
        for component in 0..3 {
            for lane in 0..2 {
                let mut changes = changes;
                changes[component][lane] = f64::NAN;
                let none = noted(&changes);
                assert!(none.change(ones).is_undefined());
                assert!(!LaneMovement { q: none, p: all }.is_number());
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
