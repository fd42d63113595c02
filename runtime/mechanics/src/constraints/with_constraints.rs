//! A system together with its constraints.

use alloc::vec;
use alloc::vec::Vec;
use core::cell::Cell;

use super::{Gradients, HolonomicConstraints, NonholonomicConstraints};
use symplectic_core::solver::FixedPoint;
use symplectic_core::system::{ConstraintName, Masses};
use symplectic_core::{Error, Quantity, Scalar, System, Vector};

/// The constraints of a system; the linear algebra is the same for both kinds.
pub enum Constraints<'a, V: Vector> {
    Holonomic(&'a dyn HolonomicConstraints<V>),
    Nonholonomic(&'a dyn NonholonomicConstraints<V>),
}

/// A system with its constraints, as steps evaluate it. NaN replaces an evaluation of a wrong dimension: so nothing is cut off, and no
/// component is missing.
pub struct WithConstraints<'a, V: Vector, S> {
    system: &'a S,
    /// None if the system does not give them.
    constraints: Option<Constraints<'a, V>>,
    /// The trait that gives them.
    by: &'static str,
    dimension: usize,
    /// The first evaluation of a wrong dimension, and this dimension.
    resized: Cell<Option<(Quantity, usize)>>,
}

impl<'a, V: Vector, S: System<V>> WithConstraints<'a, V, S> {
    /// A system with these constraints, given by this trait, for states of this dimension.
    pub(super) const fn new(
        system: &'a S,
        (constraints, by): (Option<Constraints<'a, V>>, &'static str),
        dimension: usize,
    ) -> Self {
        Self {
            system,
            constraints,
            by,
            dimension,
            resized: Cell::new(None),
        }
    }

    /// Checks that the system gives its constraints.
    pub(super) fn check_given(&self) -> Result<(), Error> {
        let missing = Error::NoExtra {
            what: "constraints",
            by: self.by,
        };
        self.constraints.as_ref().map(|_| ()).ok_or(missing)
    }

    /// The number of constraints.
    pub(super) fn constraints(&self) -> usize {
        match self.constraints {
            Some(Constraints::Holonomic(constraints)) => constraints.constraints(),
            Some(Constraints::Nonholonomic(constraints)) => constraints.nonholonomic_constraints(),
            None => 0,
        }
    }

    /// The name of a constraint.
    pub(super) fn constraint_name(&self, constraint: usize) -> Option<ConstraintName> {
        match self.constraints.as_ref()? {
            Constraints::Holonomic(constraints) => constraints.constraint_name(constraint),
            Constraints::Nonholonomic(constraints) => constraints.constraint_name(constraint),
        }
    }

    /// Writes the values of holonomic constraints.
    #[inline]
    pub(super) fn constraint_values(&self, q: &V, values: &mut [V::Scalar]) {
        if let Some(Constraints::Holonomic(constraints)) = self.constraints {
            constraints.constraint_values(q, values);
        }
    }

    /// Sets the gradients, or the rows w.
    #[inline]
    pub(super) fn constraint_gradients(&self, q: &V, gradients: &mut Gradients<V::Scalar>) {
        match self.constraints {
            Some(Constraints::Holonomic(constraints)) => {
                constraints.constraint_gradients(q, gradients);
            }
            Some(Constraints::Nonholonomic(constraints)) => {
                constraints.nonholonomic_rows(q, gradients);
            }
            None => {}
        }
    }

    /// The values of holonomic constraints, or the entries of w, then a zero for each component: the numbers that identify the constraints
    /// in a checkpoint.
    pub(super) fn numbers(&self, q: &V) -> Vec<V::Scalar> {
        let zeros = |count| vec![V::Scalar::from_f64(0.0); count];
        let mut found = match self.constraints {
            Some(Constraints::Nonholonomic(_)) => {
                let evaluate = |rows: &mut Gradients<V::Scalar>| self.constraint_gradients(q, rows);
                let rows = Gradients::learned(self.constraints(), q.dimension(), evaluate);
                rows.values().to_vec()
            }
            _ => zeros(self.constraints()),
        };
        self.constraint_values(q, &mut found);
        found.extend(zeros(q.dimension()));
        found
    }

    /// The first evaluation of a wrong dimension, and this dimension.
    pub(super) const fn resized(&self) -> Option<(Quantity, usize)> {
        self.resized.get()
    }

    /// The outcome at a state, or [`Error::ResizedEvaluation`]: any other error may be a consequence.
    pub(super) fn check<T>(&self, time: f64, outcome: Result<T, Error>) -> Result<T, Error> {
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
    fn restore(&self, what: Quantity, like: &V, value: &mut V) {
        let found = value.dimension();
        if found != self.dimension {
            let first = self.resized().unwrap_or((what, found));
            self.resized.set(Some(first));
            value.clone_from(like);
            value.as_mut_slice().fill(V::Scalar::from_f64(f64::NAN));
        }
    }
}

impl<V: Vector, S: System<V>> System<V> for WithConstraints<'_, V, S> {
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
}
