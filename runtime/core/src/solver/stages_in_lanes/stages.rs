//! Memory of coupled stages in SIMD lanes.

use crate::contract::storage::stored_words;
use crate::contract::{HalfTableau, StageStorage, StageTableau};
#[cfg(feature = "alloc")]
use crate::contract::{StagePart, StageVisit};
use crate::error::Quantity;
use crate::number::{Lanes, Vector};

/// A vector of lanes.
pub(crate) type Laned<V, P> = <V as Vector>::With<<P as StageTableau>::Lanes>;

/// Stages in lanes.
#[derive(Debug)]
pub struct SimdStages<V: Vector, P: StageTableau> {
    pub(crate) q: P::Groups<Laned<V, P>>,
    pub(crate) p: P::Groups<Laned<V, P>>,
    /// Velocities, or the increments computed from them; likewise for the forces.
    pub(crate) velocity: P::Groups<Laned<V, P>>,
    pub(crate) force: P::Groups<Laned<V, P>>,
}

impl<V: Vector, P: StageTableau> Clone for SimdStages<V, P> {
    fn clone(&self) -> Self {
        let clone = |groups: &P::Groups<Laned<V, P>>| P::groups(|k| groups.as_ref()[k].clone());
        Self {
            q: clone(&self.q),
            p: clone(&self.p),
            velocity: clone(&self.velocity),
            force: clone(&self.force),
        }
    }
}

impl<V: Vector<Scalar = f64>, P: StageTableau> StageStorage<V> for SimdStages<V, P> {
    fn like(prototype: &V) -> Self {
        let zeros = || P::groups(|_| prototype.zeros_with::<P::Lanes>());
        Self {
            q: zeros(),
            p: zeros(),
            velocity: zeros(),
            force: zeros(),
        }
    }

    stored_words! { q: vectors; p: vectors; velocity: vectors; force: vectors; }

    #[cfg(feature = "alloc")]
    fn stages(&mut self, visit: &mut StageVisit<'_>) {
        let parts = [
            (StagePart::Positions, &mut self.q, P::POSITIONS.count),
            (StagePart::Momenta, &mut self.p, P::MOMENTA.count),
            (StagePart::Velocities, &mut self.velocity, P::MOMENTA.count),
            (StagePart::Forces, &mut self.force, P::POSITIONS.count),
        ];
        for (part, groups, count) in parts {
            for (group, vector) in groups.as_mut().iter_mut().enumerate() {
                for (component, lanes) in vector.as_mut_slice().iter_mut().enumerate() {
                    let numbers = lanes.to_array();
                    // The last stage fills the lanes of its group.
                    *lanes = P::Lanes::from_fn(|lane| {
                        let stage = (group * P::Lanes::WIDTH + lane).min(count - 1);
                        let mut number = numbers.as_ref()[lane];
                        visit(part, stage, component, &mut number);
                        number
                    });
                }
            }
        }
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        let first = |half: &HalfTableau, values: &[_], evaluations: &[_]| {
            (0..half.count).find(|&stage| {
                is_lane_finite::<V, P>(values, stage) && !is_lane_finite::<V, P>(evaluations, stage)
            })
        };
        let force = first(&P::POSITIONS, self.q.as_ref(), self.force.as_ref());
        let velocity = first(&P::MOMENTA, self.p.as_ref(), self.velocity.as_ref());
        match (force, velocity) {
            (Some(i), Some(j)) if j < i => Some((Quantity::Velocity, j + 1)),
            (Some(i), _) => Some((Quantity::Force, i + 1)),
            (None, j) => j.map(|j| (Quantity::Velocity, j + 1)),
        }
    }

    fn non_finite_force(&self) -> Option<usize> {
        let mut stages = 0..P::POSITIONS.count;
        let first = stages.find(|&stage| !is_lane_finite::<V, P>(self.force.as_ref(), stage));
        first.map(|index| index + 1)
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        let first = |groups: &P::Groups<Laned<V, P>>| {
            let mut groups = groups.as_ref().iter().map(Vector::dimension).enumerate();
            groups.find(|&(_, found)| found != dimension)
        };
        // A system that returns a wrong dimension returns it in all lanes: the first stage of the group represents all.
        let stage = |group: usize| group * P::Lanes::WIDTH + 1;
        if let Some((group, found)) = first(&self.force) {
            return Some((Quantity::Force, stage(group), found));
        }
        first(&self.velocity).map(|(group, found)| (Quantity::Velocity, stage(group), found))
    }
}

/// Whether a vector is finite in the lane of this stage.
fn is_lane_finite<V: Vector, P: StageTableau>(groups: &[Laned<V, P>], stage: usize) -> bool {
    let group = &groups[stage / P::Lanes::WIDTH];
    let lane = stage % P::Lanes::WIDTH;
    let mut components = group.as_slice().iter();
    components.all(|component| component.to_array().as_ref()[lane].is_finite())
}
