//! The rows w(q) of the constraints, with their derivatives.

use alloc::vec;

use num_traits::Zero;

use super::DiracSystem;
use crate::constraints::Gradients;
use symplectic_core::{Error, Scalar, Vector};
use symplectic_linearisation::HyperDual;

/// An entry of w.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) constraint: usize,
    pub(super) component: usize,
    pub(super) value: f64,
    /// Its derivative with respect to a component of q.
    pub(super) slope: f64,
}

/// The rows, and memory to evaluate them.
#[derive(Clone)]
pub(super) struct Rows<L: DiracSystem> {
    q: L::Vector<HyperDual>,
    rows: Gradients<HyperDual>,
}

impl<L: DiracSystem> Rows<L> {
    /// The rows of a system at `q`.
    pub(super) fn new(system: &L, q: &[f64]) -> Result<Self, Error> {
        let (constraints, dimension) = (system.nonholonomic_constraints(), q.len());
        if constraints > dimension {
            return Err(Error::ConstraintCount {
                constraints,
                dimension,
            });
        }
        let mut point: L::Vector<HyperDual> =
            Vector::from_slice(&vec![HyperDual::zero(); dimension])?;
        place(&mut point, q);
        let rows = Gradients::learned(constraints, dimension, |rows| {
            system.nonholonomic_rows(&point, rows);
        });
        if let Some((constraint, component)) = rows.misplaced() {
            return Err(Error::GradientPlace {
                constraint,
                component,
                constraints,
                dimension,
            });
        }
        Ok(Self { q: point, rows })
    }

    pub(super) fn constraints(&self) -> usize {
        self.rows.constraints()
    }

    /// The entries at `q`; `None` if their sparsity pattern has changed.
    pub(super) fn at(&mut self, system: &L, q: &[f64]) -> Option<impl Iterator<Item = Entry>> {
        place(&mut self.q, q);
        self.evaluate(system)
    }

    /// The entries at `q` with their derivatives with respect to a component of `q`.
    pub(super) fn along(
        &mut self,
        system: &L,
        q: &[f64],
        component: usize,
    ) -> Option<impl Iterator<Item = Entry>> {
        place(&mut self.q, q);
        self.q.as_mut_slice()[component].set_first(1.0);
        self.evaluate(system)
    }

    fn evaluate(&mut self, system: &L) -> Option<impl Iterator<Item = Entry>> {
        let q = &self.q;
        let settled = self.rows.evaluate(|rows| system.nonholonomic_rows(q, rows));
        let entry = |(constraint, component, entry): (usize, usize, HyperDual)| Entry {
            constraint,
            component,
            value: entry.real(),
            slope: entry.first(),
        };
        settled.then(|| self.rows.entries().map(entry))
    }
}

fn place<V: Vector<Scalar = HyperDual>>(point: &mut V, q: &[f64]) {
    let pairs = point.as_mut_slice().iter_mut().zip(q);
    pairs.for_each(|(dual, &value)| *dual = HyperDual::from_f64(value));
}
