//! The gradients of constraints.

use alloc::vec::Vec;
use symplectic_core::Scalar;
use symplectic_core::solver::{Visit, scalar_words};

/// The gradients `G = ∂φ/∂q` of the constraints `φ(q) = 0` of a system, or the rows w of non-holonomic constraints `w(q)·q' = 0`: a
/// sparse m×n matrix.
///
/// A system [`set`](Self::set)s every entry that is not identically zero, in the same order at every evaluation. Values of an entry that is
/// set twice are added. Constraints and components are counted from 0.
#[derive(Clone, Debug)]
pub struct Gradients<T> {
    constraints: usize,
    dimension: usize,
    /// Constraint and component of each entry.
    places: Vec<(u32, u32)>,
    values: Vec<T>,
    /// The index of the entry to be set next.
    next: usize,
    /// Whether the places of entries are being recorded, at the first evaluation.
    learning: bool,
    /// An entry of the last evaluation that is outside the matrix, or at another place than at the first evaluation.
    misplaced: Option<(usize, usize)>,
}

/// The size of the terms of a constraint.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Terms {
    /// The sum of the sizes of the entries of its gradient.
    gradient: f64,
    /// The largest component of a vector at the places of these entries.
    largest: f64,
    /// The size is at least this.
    least: f64,
}

impl Terms {
    /// Upper bound of the product of gradient and vector.
    #[inline]
    pub(super) fn size(self) -> f64 {
        let size = self.gradient * self.largest;
        // A size that is NaN stays NaN.
        if self.least > size { self.least } else { size }
    }

    /// The size of a vector for which [`raise`](Self::raise)d terms have this size.
    #[inline]
    pub(super) fn raised(self) -> f64 {
        if self.least == 0.0 {
            return 0.0;
        }
        self.least / self.gradient
    }

    /// The bound that the size was [`raise`](Self::raise)d to.
    #[inline]
    pub(super) const fn least(self) -> f64 {
        self.least
    }

    /// Forgets a bound that is not above `factor` times the other terms.
    #[inline]
    pub(super) fn keep_above(&mut self, factor: f64) {
        if self.least <= factor * self.gradient * self.largest {
            self.least = 0.0;
        }
    }

    /// Makes the size at least this.
    #[inline]
    pub(super) fn raise(&mut self, least: f64) {
        self.least = least;
    }

    /// A residual relative to the terms and to `other`, a number in the same unit; zero if the residual is zero.
    #[inline]
    pub(super) fn relative(self, residual: f64, other: f64) -> f64 {
        if residual == 0.0 {
            return 0.0;
        }
        residual / (self.size() + other)
    }
}

impl<T: Scalar> Gradients<T> {
    /// An m×n matrix of gradients, with the places of the entries that `evaluate` sets.
    pub(crate) fn learned(
        constraints: usize,
        dimension: usize,
        evaluate: impl FnOnce(&mut Self),
    ) -> Self {
        let mut gradients = Self {
            constraints,
            dimension,
            places: Vec::new(),
            values: Vec::new(),
            next: 0,
            learning: true,
            misplaced: None,
        };
        evaluate(&mut gradients);
        gradients.learning = false;
        gradients
    }

    /// Sets the entry of a constraint and a component of the position.
    #[inline]
    pub fn set(&mut self, constraint: usize, component: usize, value: T) {
        let place = (constraint as u32, component as u32);
        if self.places.get(self.next) == Some(&place) {
            self.values[self.next] = value;
            self.next += 1;
        } else {
            self.note(constraint, component, value);
        }
    }

    /// Records a new place, or notes that it is misplaced.
    #[cold]
    fn note(&mut self, constraint: usize, component: usize, value: T) {
        if !self.learning || constraint >= self.constraints || component >= self.dimension {
            self.misplaced.get_or_insert((constraint, component));
            return;
        }
        self.places.push((constraint as u32, component as u32));
        self.values.push(value);
        self.next += 1;
    }

    /// Calls `evaluate` to set all entries; returns whether each entry had its place.
    #[inline]
    pub(crate) fn evaluate(&mut self, evaluate: impl FnOnce(&mut Self)) -> bool {
        self.next = 0;
        self.misplaced = None;
        evaluate(self);
        self.next == self.values.len() && self.misplaced.is_none()
    }

    /// The first misplaced entry: constraint and component.
    pub(crate) const fn misplaced(&self) -> Option<(usize, usize)> {
        self.misplaced
    }

    /// Number of constraints m.
    pub(crate) const fn constraints(&self) -> usize {
        self.constraints
    }

    /// Every entry: constraint, component and value.
    #[inline]
    pub(crate) fn entries(&self) -> impl Iterator<Item = (usize, usize, T)> {
        let entries = self.places.iter().zip(&self.values);
        entries.map(|(&(constraint, component), &value)| {
            (constraint as usize, component as usize, value)
        })
    }

    /// The values of the entries.
    pub(super) fn values(&self) -> &[T] {
        &self.values
    }

    /// `out −= Gᵀ factors`
    #[inline]
    pub(super) fn subtract_transposed(&self, factors: &[T], out: &mut [T]) {
        for (constraint, component, value) in self.entries() {
            out[component] -= value * factors[constraint];
        }
    }

    /// `out = G vector`
    #[inline]
    pub(super) fn multiply(&self, vector: &[T], out: &mut [T]) {
        out.fill(T::zero());
        for (constraint, component, value) in self.entries() {
            out[constraint] += value * vector[component];
        }
    }

    /// The size of the terms of every constraint: `Σ_k |g_ik|`, and the largest `size(k)` of its components.
    pub(super) fn sizes(&self, size: impl Fn(usize) -> f64, out: &mut [Terms]) {
        out.fill(Terms::default());
        for (constraint, component, value) in self.entries() {
            let Terms {
                gradient, largest, ..
            } = &mut out[constraint];
            *gradient += value.magnitude();
            *largest = largest.max(size(component));
        }
    }

    /// The words of the values.
    pub(super) fn words(&mut self, visit: &mut Visit<'_>) {
        scalar_words(&mut self.values, visit);
    }
}
