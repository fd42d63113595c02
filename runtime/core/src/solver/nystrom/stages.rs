//! Memory of the Nyström form.

use crate::contract::storage::stored_words;
#[cfg(feature = "alloc")]
use crate::contract::{StagePart, StageVisit};
use crate::contract::{StageStorage, StageTableau};
use crate::error::Quantity;
use crate::number::Vector;
use crate::solver::stages_in_lanes::stages::SimdStages;

/// Stages in lanes, and the velocity at the start of the step.
#[derive(Debug)]
pub struct NystromStages<V: Vector, P: StageTableau> {
    pub(crate) lanes: SimdStages<V, P>,
    /// The velocity at the start of the step if the momenta are eliminated; unused with unit masses, where it is the momentum.
    pub(crate) start: V,
    /// Whether the forces, and `M⁻¹` times them, are stored as increments between steps: with compensated sums.
    pub(crate) of_increments: bool,
    /// Whether the momenta of the stages are eliminated.
    pub(crate) eliminated: bool,
}

impl<V: Vector, P: StageTableau> Clone for NystromStages<V, P> {
    fn clone(&self) -> Self {
        Self {
            lanes: self.lanes.clone(),
            start: self.start.clone(),
            ..*self
        }
    }
}

impl<V: Vector<Scalar = f64>, P: StageTableau> StageStorage<V> for NystromStages<V, P> {
    fn like(prototype: &V) -> Self {
        Self {
            lanes: SimdStages::like(prototype),
            start: prototype.zeros_like(),
            of_increments: false,
            eliminated: false,
        }
    }

    stored_words! { lanes: memory; start: vector; of_increments: number; eliminated: number; }

    #[cfg(feature = "alloc")]
    fn stages(&mut self, visit: &mut StageVisit<'_>) {
        self.lanes.stages(visit);
        for (component, number) in self.start.as_mut_slice().iter_mut().enumerate() {
            visit(StagePart::Start, 0, component, number);
        }
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        self.lanes.non_finite()
    }

    fn non_finite_force(&self) -> Option<usize> {
        self.lanes.non_finite_force()
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        self.lanes.mismatch(dimension)
    }
}
