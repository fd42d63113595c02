//! Parameters of several systems of the same type, side by side in lanes.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

use crate::number::MAX_LANES;

/// A parameter of a system: a number, an array of parameters, or a pair of indices.
pub trait LaneParameter {
    /// The parameters of several systems; numbers have one for each lane.
    type InLanes;

    /// This parameter in all lanes.
    fn in_all_lanes(&self) -> Self::InLanes;

    /// Sets a lane; `None` if the parameters differ in more than their numbers, or if there is no such lane.
    fn set_lane(&self, lane: usize, lanes: &mut Self::InLanes) -> Option<()>;
}

impl LaneParameter for f64 {
    type InLanes = [Self; MAX_LANES];

    fn in_all_lanes(&self) -> Self::InLanes {
        [*self; MAX_LANES]
    }

    fn set_lane(&self, lane: usize, lanes: &mut Self::InLanes) -> Option<()> {
        *lanes.get_mut(lane)? = *self;
        Some(())
    }
}

/// Indices are the same in all lanes.
impl LaneParameter for (usize, usize) {
    type InLanes = Self;

    fn in_all_lanes(&self) -> Self {
        *self
    }

    fn set_lane(&self, _lane: usize, lanes: &mut Self) -> Option<()> {
        (lanes == self).then_some(())
    }
}

impl<P: LaneParameter, const N: usize> LaneParameter for [P; N] {
    type InLanes = [P::InLanes; N];

    fn in_all_lanes(&self) -> Self::InLanes {
        self.each_ref().map(P::in_all_lanes)
    }

    fn set_lane(&self, lane: usize, lanes: &mut Self::InLanes) -> Option<()> {
        set_all(self, lane, lanes)
    }
}

#[cfg(feature = "alloc")]
impl<P: LaneParameter> LaneParameter for Vec<P> {
    type InLanes = Vec<P::InLanes>;

    fn in_all_lanes(&self) -> Self::InLanes {
        self.iter().map(P::in_all_lanes).collect()
    }

    fn set_lane(&self, lane: usize, lanes: &mut Self::InLanes) -> Option<()> {
        set_all(self, lane, lanes)
    }
}

fn set_all<P: LaneParameter>(all: &[P], lane: usize, lanes: &mut [P::InLanes]) -> Option<()> {
    (all.len() == lanes.len()).then_some(())?;
    let mut pairs = all.iter().zip(lanes);
    pairs.try_for_each(|(parameter, lanes)| parameter.set_lane(lane, lanes))
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use alloc::vec;
    use alloc::vec::Vec;

    use super::LaneParameter;

    #[test]
    fn lanes_may_differ_in_numbers_but_not_in_indices_or_lengths() {
        let first = (vec![[1.0, 2.0]], vec![(0, 1)]);
        let mut lanes = (first.0.in_all_lanes(), first.1.in_all_lanes());
        assert_eq!(vec![[3.0, 4.0]].set_lane(1, &mut lanes.0), Some(()));
        assert_eq!(lanes.0[0][1][..3], [2.0, 4.0, 2.0]);
        assert_eq!(vec![(0, 1)].set_lane(1, &mut lanes.1), Some(()));
        assert_eq!(vec![(1, 0)].set_lane(1, &mut lanes.1), None);
        assert_eq!(vec![[3.0, 4.0]; 2].set_lane(1, &mut lanes.0), None);
        assert_eq!(Vec::<[f64; 2]>::new().set_lane(1, &mut lanes.0), None);
        assert_eq!(vec![[3.0, 4.0]].set_lane(16, &mut lanes.0), None);
    }
}
