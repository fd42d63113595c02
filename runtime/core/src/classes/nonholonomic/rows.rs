//! A system whose constraints are the rows of w.

use crate::contract::{Class, Gradients, Masses, Nonholonomic, System, Unconstrained};
use crate::error::ConstraintName;
use crate::number::Vector;
use crate::solver::FixedPoint;

/// A system with its rows w in place of the gradients of holonomic constraints: the linear algebra is the same for both.
pub(super) struct RowsAsGradients<'a, S>(pub(super) &'a S);

impl<V, S, C> System<V> for RowsAsGradients<'_, S>
where
    V: Vector,
    S: System<V, Class = Nonholonomic<C>>,
    C: Class + Unconstrained,
{
    type Class = C;
    type Solver = FixedPoint;

    const MASSES: Masses = S::MASSES;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V) {
        self.0.velocity(time, q, p, velocity);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V) {
        self.0.force(time, q, p, force);
    }

    fn constraints(&self) -> usize {
        self.0.nonholonomic_constraints()
    }

    fn constraint_name(&self, constraint: usize) -> Option<ConstraintName> {
        self.0.constraint_name(constraint)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn constraint_gradients(&self, q: &V, gradients: &mut Gradients<V::Scalar>) {
        self.0.nonholonomic_rows(q, gradients);
    }
}
