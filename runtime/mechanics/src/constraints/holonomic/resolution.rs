//! How well the values of constraints resolve positions.

use crate::constraints::{Gradients, WithConstraints};
use alloc::vec;
use alloc::vec::Vec;
use symplectic_core::inside::words;
use symplectic_core::solver::Visit;
use symplectic_core::{Scalar, System, Vector};

/// Displacements are tried from `4^−RANGE` to `4^RANGE`.
const RANGE: i32 = 48;
/// The values respond to a displacement if they change as the gradient predicts, up to this fraction.
const ANSWER: f64 = 0.25;

/// The rounding errors of constraints at a state. The terms of a constraint may be much larger than gradient times position. An example is
/// `|q − c|² − |c|²` at `q = 0`, of a pendulum with the pivot `c`.
#[derive(Clone, Debug)]
pub(super) struct Resolution {
    /// The size of the terms of each constraint; its values have a rounding error of about `ε` times this size.
    pub(super) values: Vec<f64>,
    /// The size of a position with the same rounding error, for the constraint where it is largest.
    pub(super) position: f64,
}

impl Resolution {
    /// Measured by the smallest displacement that the values respond to.
    pub(super) fn new<V: Vector, S: System<V>>(
        system: &WithConstraints<'_, V, S>,
        q: &V,
        gradients: &Gradients<V::Scalar>,
    ) -> Self {
        let constraints = gradients.constraints();
        let zeros = || vec![V::Scalar::from_f64(0.0); constraints];
        let (mut here, mut there, mut slopes) = (zeros(), zeros(), zeros());
        let mut moved = q.clone();
        let direction = |k: usize| 0.25 + ((k + 1) as f64 * 0.618_033_988_749_895) % 1.0;
        for (k, component) in moved.as_mut_slice().iter_mut().enumerate() {
            *component = V::Scalar::from_f64(direction(k));
        }
        gradients.multiply(moved.as_slice(), &mut slopes);
        system.constraint_values(q, &mut here);
        let mut candidates = vec![[0.0; 2]; constraints];
        let mut answered = vec![0_u8; constraints];
        for exponent in -RANGE..=RANGE {
            let size = num_traits::Float::powi(4.0_f64, exponent);
            moved.clone_from(q);
            for (k, component) in moved.as_mut_slice().iter_mut().enumerate() {
                *component += V::Scalar::from_f64(size * direction(k));
            }
            system.constraint_values(&moved, &mut there);
            for c in 0..constraints {
                let expected = slopes[c] * V::Scalar::from_f64(size);
                let error = (there[c] - here[c] - expected).magnitude();
                // Two responses in a row: a single one may be chance.
                let answers = error <= ANSWER * expected.magnitude() && expected.magnitude() > 0.0;
                match answered[c] {
                    2 => {}
                    _ if answers => answered[c] += 1,
                    _ => answered[c] = 0,
                }
                if answers && answered[c] == 1 {
                    candidates[c] = [expected.magnitude(), size];
                }
            }
            if answered.iter().all(|&answered| answered == 2) {
                break;
            }
        }
        let (mut values, mut position) = (vec![0.0; constraints], 0.0_f64);
        for (c, [value, size]) in candidates.into_iter().enumerate() {
            if answered[c] == 2 {
                values[c] = value / V::Scalar::EPSILON;
                position = position.max(size / V::Scalar::EPSILON);
            }
        }
        Self { values, position }
    }

    /// The words of all numbers.
    pub(super) fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.values[..], self.position);
    }
}
