//! The terms that add up to a momentum.

use super::Gradients;
use alloc::vec;
use alloc::vec::Vec;
use symplectic_core::Scalar;

/// The sizes of the terms of a momentum, component by component.
///
/// Forces and impulses of a step may cancel, as they do for a body at rest. The momentum then has rounding errors of `ε` times the size of
/// these terms, and so have velocity and position. For a body at rest at the origin they have no other scale.
#[derive(Clone, Debug)]
pub(super) struct MomentumTerms(Vec<f64>);

impl MomentumTerms {
    pub(super) fn new(dimension: usize) -> Self {
        Self(vec![0.0; dimension])
    }

    /// The terms of a momentum without increments.
    pub(super) fn start<T: Scalar>(&mut self, momentum: &[T]) {
        self.0.fill(0.0);
        self.add(momentum);
    }

    /// Adds the size of an increment.
    pub(super) fn add<T: Scalar>(&mut self, increment: &[T]) {
        let places = self.0.iter_mut().zip(increment);
        places.for_each(|(size, term)| *size += term.magnitude());
    }

    /// Adds the sizes of the impulses `−Gᵀ multipliers`, constraint by constraint.
    pub(super) fn add_impulses<T: Scalar>(&mut self, gradients: &Gradients<T>, multipliers: &[T]) {
        for (constraint, component, value) in gradients.entries() {
            self.0[component] += value.magnitude() * multipliers[constraint].magnitude();
        }
    }

    pub(super) fn sizes(&self) -> &[f64] {
        &self.0
    }
}
