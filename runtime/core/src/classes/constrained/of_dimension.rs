//! A system whose evaluations have the dimension of the state.

use core::cell::Cell;

use crate::contract::storage::first_non_finite_of;
use crate::contract::{Gradients, Masses, System};
use crate::error::{ConstraintName, Error, Quantity};
use crate::number::{Scalar, Vector};
use crate::solver::FixedPoint;

/// A system with NaN in place of an evaluation of a wrong dimension. So nothing is cut off, and no component is missing.
pub(in crate::classes) struct OfDimension<'a, S> {
    system: &'a S,
    dimension: usize,
    /// The first such evaluation, and its dimension.
    resized: Cell<Option<(Quantity, usize)>>,
}

impl<'a, S> OfDimension<'a, S> {
    pub(in crate::classes) const fn new(system: &'a S, dimension: usize) -> Self {
        Self {
            system,
            dimension,
            resized: Cell::new(None),
        }
    }

    /// The first evaluation of a wrong dimension, and its dimension.
    pub(in crate::classes) const fn resized(&self) -> Option<(Quantity, usize)> {
        self.resized.get()
    }

    /// The outcome at a state, or [`Error::ResizedEvaluation`]: any other error may be a consequence.
    pub(in crate::classes) fn check<T>(
        &self,
        time: f64,
        outcome: Result<T, Error>,
    ) -> Result<T, Error> {
        match self.resized() {
            Some((what, found)) => Err(Error::ResizedEvaluation {
                time,
                what,
                expected: self.dimension,
                found,
            }),
            None => outcome,
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn restore<V: Vector>(&self, what: Quantity, like: &V, value: &mut V) {
        let found = value.dimension();
        if found != self.dimension {
            let first = self.resized().unwrap_or((what, found));
            self.resized.set(Some(first));
            value.clone_from(like);
            value.as_mut_slice().fill(V::Scalar::from_f64(f64::NAN));
        }
    }
}

impl<V: Vector, S: System<V>> System<V> for OfDimension<'_, S> {
    type Class = S::Class;
    type Solver = FixedPoint;

    const MASSES: Masses = S::MASSES;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V) {
        self.system.velocity(time, q, p, velocity);
        self.restore(Quantity::Velocity, q, velocity);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V) {
        self.system.force(time, q, p, force);
        self.restore(Quantity::Force, q, force);
    }

    fn constraints(&self) -> usize {
        self.system.constraints()
    }

    fn constraint_name(&self, constraint: usize) -> Option<ConstraintName> {
        self.system.constraint_name(constraint)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn constraint_values(&self, q: &V, values: &mut [V::Scalar]) {
        self.system.constraint_values(q, values);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn constraint_gradients(&self, q: &V, gradients: &mut Gradients<V::Scalar>) {
        self.system.constraint_gradients(q, gradients);
    }
}

/// The quantity of an evaluation of a wrong dimension, its stage from 1 (0 outside the stages), and its dimension. NaN replaced it, so its
/// stage is the first increment of a step that is not finite.
pub(in crate::classes) fn place_of_resized<V: Vector>(
    (what, found): (Quantity, usize),
    kick: &[V],
    drift: &[V],
) -> Option<(Quantity, usize, usize)> {
    let increments = match what {
        Quantity::Force => kick,
        _ => drift,
    };
    let stage = first_non_finite_of(increments).unwrap_or(0);
    Some((what, stage, found))
}
