//! The second derivatives of a chain.

use super::{Bonds, Chain, Ends};
use crate::contract::Jacobian;
use crate::number::Scalar;

impl<B: Bonds> Chain<B> {
    /// Adds the second derivatives of H; returns `None` if the bonds do not provide theirs.
    pub(super) fn add_second_derivatives<T: Scalar>(
        &self,
        time: T,
        q: &[T],
        jacobian: &mut Jacobian<T>,
    ) -> Option<()> {
        let forces = &mut jacobian.force_by_position;
        let mut bond = |left: Option<usize>, right: Option<usize>| {
            let place = |i: Option<usize>| i.map_or(T::zero(), |i| q[i]);
            let stiffness = self.bonds.stiffness(time, place(right) - place(left))?;
            for end in [left, right].into_iter().flatten() {
                forces.add(end, end, -stiffness);
            }
            if let (Some(left), Some(right)) = (left, right) {
                forces.add(left, right, stiffness);
                forces.add(right, left, stiffness);
            }
            Some(())
        };
        let last = q.len().checked_sub(1)?;
        match self.ends {
            Ends::Walls => {
                bond(None, Some(0))?;
                bond(Some(last), None)?;
            }
            Ends::Free => {}
            Ends::Ring => bond(Some(last), Some(0))?,
        }
        for i in 0..last {
            bond(Some(i), Some(i + 1))?;
        }
        for (i, &q) in q.iter().enumerate() {
            jacobian.velocity_by_momentum.set(i, i, T::one());
            if self.bonds.outer_force(time, q).is_some() {
                let stiffness = self.bonds.outer_stiffness(time, q)?;
                jacobian.force_by_position.add(i, i, -stiffness);
            }
        }
        Some(())
    }
}
