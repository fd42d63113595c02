//! Lagrangians that are linear in the velocities, `L = a(q)·v − H(q)`: momenta are `p = a(q)`.

use alloc::vec::Vec;

use super::derivatives::Derivatives;
use crate::variational::regular::Factors;
use symplectic_core::inside::{beside, words};
use symplectic_core::solver::{Visit, Words};
use symplectic_core::system::Lagrangian;
use symplectic_core::{Error, Vector};

/// The largest deviation of `p` from `a(q)`, relative to their largest terms so far. Rounding errors of long runs are smaller; the
/// deviation of a method that leaves `p = a(q)` grows above it, unless its steps are so short that it does not matter.
const LARGEST: f64 = 1e-8;

/// The primary constraints `p = a(q)`.
#[derive(Clone)]
pub(super) struct LinearConstraint<L: Lagrangian> {
    derivatives: Derivatives<L>,
    velocity: L::Vector<f64>,
    /// `|∂a_i/∂q_j|` at the start, by rows.
    slopes: Vec<f64>,
    /// The largest term so far.
    pub(super) size: f64,
}

impl<L: Lagrangian> Words for LinearConstraint<L> {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.slopes[..], self.size);
    }
}

impl<L: Lagrangian> LinearConstraint<L> {
    /// The constraints, if `∂²L/∂v∂v` is zero at two velocities; `None` if it is not.
    pub(super) fn new(
        lagrangian: &L,
        time: f64,
        q: &L::Vector<f64>,
    ) -> Result<Option<Self>, Error> {
        let mut derivatives = Derivatives::new(q.dimension())?;
        let mut velocity = q.zeros_like();
        for component in [1.0, 0.0] {
            velocity.as_mut_slice().fill(component);
            derivatives.second(lagrangian, time, q.as_slice(), velocity.as_slice());
            let mut entries = derivatives.momentum_by_velocity.iter();
            if !entries.all(|&entry| entry == 0.0) {
                return Ok(None);
            }
        }
        let slopes = derivatives.momentum_by_position.iter();
        Ok(Some(Self {
            slopes: slopes.map(|slope| slope.abs()).collect(),
            derivatives,
            velocity,
            size: 0.0,
        }))
    }

    /// [`violation`](Self::violation) at a new start, as if there had been no terms before; a violation changes nothing.
    pub(super) fn violation_at_start(
        &mut self,
        lagrangian: &L,
        time: f64,
        q: &L::Vector<f64>,
        p: &L::Vector<f64>,
    ) -> Option<(usize, f64)> {
        let before = core::mem::take(&mut self.size);
        let found = self.violation(lagrangian, time, q, p);
        if found.is_some() {
            self.size = before;
        }
        found
    }

    /// The component in which `p` deviates most from `a(q)`, and the deviation; `None` if it is a rounding error.
    pub(super) fn violation(
        &mut self,
        lagrangian: &L,
        time: f64,
        q: &L::Vector<f64>,
        p: &L::Vector<f64>,
    ) -> Option<(usize, f64)> {
        let (q, v) = (q.as_slice(), self.velocity.as_slice());
        self.derivatives.first(lagrangian, time, q, v);
        let mut largest = (0, 0.0_f64);
        let pairs = p.as_slice().iter().zip(&self.derivatives.momentum);
        let rows = self.slopes.chunks_exact(q.len().max(1));
        for ((component, (&p, &a)), row) in pairs.enumerate().zip(rows) {
            let terms = row.iter().zip(q).map(|(slope, q)| slope * q.abs());
            self.size = self.size.max(p.abs()).max(a.abs()).max(terms.sum());
            if (p - a).abs() > largest.1.abs() {
                largest = (component, p - a);
            }
        }
        (largest.1.abs() > LARGEST * self.size).then_some(largest)
    }
}

/// Whether `∂²L/∂v∂v` is regular beside a state: L is degenerate at that state only, as in polar coordinates at the centre.
pub(super) fn is_regular_beside<L: Lagrangian>(
    lagrangian: &L,
    time: f64,
    q: &L::Vector<f64>,
    v: &L::Vector<f64>,
) -> Result<bool, Error> {
    let n = q.dimension();
    let mut derivatives = Derivatives::new(n)?;
    derivatives.second(lagrangian, time, beside(q).as_slice(), beside(v).as_slice());
    let mut factors = Factors::new(n);
    Ok(derivatives.is_finite() && factors.factor(&derivatives.momentum_by_velocity).is_ok())
}
