//! Changes of stages in lanes by a sweep.

use crate::number::Lanes;
use crate::solver::convergence::Movement;

/// Change of the positions and the momenta of the stages in a sweep: the largest change of a component, lane by lane. NaN if any change
/// is NaN. A stage that recovers from NaN has also changed by NaN.
#[derive(Clone, Copy)]
pub struct LaneMovement<L> {
    /// Of the positions.
    pub q: L,
    /// Of the momenta.
    pub p: L,
}

/// The largest change so far and one more. `None` instead of zero at the start: otherwise the compiler would compare with zero.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn noted<L: Lanes>(largest: Option<L>, change: L) -> L {
    match largest {
        Some(largest) => largest.larger_or_nan(change),
        None => change,
    }
}

/// The largest number of all lanes; NaN if one of them is NaN.
#[cfg_attr(not(debug_assertions), inline(always))]
fn largest<L: Lanes>(numbers: L) -> f64 {
    match numbers.any_nan() {
        false => numbers.largest(),
        true => f64::NAN,
    }
}

impl<L: Lanes> Movement for LaneMovement<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn exceeds(&self, [q, p]: [f64; 2]) -> [bool; 2] {
        [self.q.any_above(q), self.p.any_above(p)]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn differences(&self) -> [f64; 2] {
        [largest(self.q), largest(self.p)]
    }
}

#[cfg(test)]
mod tests {
    use num_traits::Zero;

    use super::*;
    use crate::number::{F64x2, Scalar};

    #[test]
    fn a_nan_change_is_kept_in_its_lane() {
        let changes = [[1.0, 0.5], [2.0, 0.0], [0.25, 3.0]];
        let all_noted = |changes: &[[f64; 2]]| {
            let changes = changes.iter().map(|&change| F64x2::from_array(change));
            let largest = changes.fold(None, |largest, x| Some(noted(largest, x)));
            largest.unwrap_or_else(F64x2::zero)
        };
        let all = all_noted(&changes);
        let none = all_noted(&[]);
        assert_eq!(LaneMovement { q: all, p: none }.differences(), [3.0, 0.0]);
        for component in 0..3 {
            for lane in 0..2 {
                let mut changes = changes;
                changes[component][lane] = f64::NAN;
                let lost = all_noted(&changes);
                let [q, p] = LaneMovement { q: all, p: lost }.differences();
                assert!(q == 3.0 && p.is_nan());
            }
        }
    }

    #[test]
    fn a_change_exceeds_a_bound_in_any_lane() {
        let [zero, one] = [[0.0, 0.0], [0.0, 1.0]].map(F64x2::from_array);
        let change = LaneMovement { q: one, p: zero };
        assert_eq!(change.exceeds([0.5; 2]), [true, false]);
        assert_eq!(change.exceeds([1.0; 2]), [false, false]);
        let lost = F64x2::from_f64(f64::NAN);
        let change = LaneMovement { q: lost, p: zero };
        assert_eq!(change.exceeds([0.5; 2]), [false, false]);
    }
}
