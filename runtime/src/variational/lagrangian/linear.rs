//! Lagrangians that are linear in the velocities, `L = a(q)·v − H(q)`: momenta are `p = a(q)`.

use super::derivatives::Derivatives;
use crate::error::Error;
use crate::number::Vector;
use crate::system::Lagrangian;

/// The largest deviation of `p` from `a(q)`, relative to the largest component of both: rounding errors of long runs are smaller.
const LARGEST: f64 = 1e-10;

/// The primary constraints `p = a(q)`.
#[derive(Clone)]
pub(super) struct LinearConstraint<L: Lagrangian> {
    derivatives: Derivatives<L>,
    velocity: L::Vector<f64>,
}

impl<L: Lagrangian> LinearConstraint<L> {
    pub(super) fn new(q: &L::Vector<f64>) -> Result<Self, Error> {
        Ok(Self {
            derivatives: Derivatives::new(q.dimension())?,
            velocity: q.zeros_like(),
        })
    }

    /// Whether `∂²L/∂v∂v` is zero, at two velocities.
    pub(super) fn is_linear(&mut self, lagrangian: &L, time: f64, q: &L::Vector<f64>) -> bool {
        [1.0, 0.0].into_iter().all(|component| {
            self.velocity.as_mut_slice().fill(component);
            let (q, v) = (q.as_slice(), self.velocity.as_slice());
            self.derivatives.second(lagrangian, time, q, v);
            let mut entries = self.derivatives.momentum_by_velocity.iter();
            entries.all(|&entry| entry == 0.0)
        })
    }

    /// The component in which `p` deviates most from `a(q)`, and the deviation; `None` if it is a rounding error.
    pub(super) fn violation(
        &mut self,
        lagrangian: &L,
        time: f64,
        q: &L::Vector<f64>,
        p: &L::Vector<f64>,
    ) -> Option<(usize, f64)> {
        self.velocity.as_mut_slice().fill(0.0);
        let (q, v) = (q.as_slice(), self.velocity.as_slice());
        self.derivatives.first(lagrangian, time, q, v);
        let (mut size, mut largest) = (0.0_f64, (0, 0.0_f64));
        let pairs = p.as_slice().iter().zip(&self.derivatives.momentum);
        for (component, (&p, &a)) in pairs.enumerate() {
            size = size.max(p.abs()).max(a.abs());
            if (p - a).abs() > largest.1.abs() {
                largest = (component, p - a);
            }
        }
        (largest.1.abs() > LARGEST * size).then_some(largest)
    }
}
