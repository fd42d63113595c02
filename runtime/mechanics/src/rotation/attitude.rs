//! The attitude as a normalized quaternion.

use nalgebra::{Quaternion, UnitQuaternion, Vector3, Vector4};

use symplectic_core::Scalar;
use symplectic_core::inside::{add_sum, fast_two_sum, words};
use symplectic_core::solver::{Visit, Words};

/// A compensated vector `high + low`; `low` is the rounding error of `high`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Precise<const N: usize> {
    pub(super) high: [f64; N],
    low: [f64; N],
}

impl<const N: usize> Words for Precise<N> {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.high, self.low);
    }
}

impl<const N: usize> Precise<N> {
    pub(super) const fn new(high: [f64; N]) -> Self {
        Self {
            high,
            low: [0.0; N],
        }
    }

    /// Adds a vector.
    pub(super) fn add(&mut self, increment: [f64; N]) {
        for (k, increment) in increment.into_iter().enumerate() {
            let (high, low) = add_sum(self.high[k], self.low[k], (increment, None));
            (self.high[k], self.low[k]) = (high, low);
        }
    }
}

/// A unit quaternion `w + xi + yj + zk` as a compensated sum.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attitude(Precise<4>);

impl Words for Attitude {
    fn words(&mut self, visit: &mut Visit<'_>) {
        self.0.words(visit);
    }
}

impl Attitude {
    /// The attitude of a quaternion, normalized.
    pub(super) fn new(attitude: &UnitQuaternion<f64>) -> Self {
        let q = attitude.quaternion();
        let norm: f64 = Scalar::sqrt(q.coords.dot(&q.coords));
        let mut new = Self(Precise::new([q.w, q.i, q.j, q.k].map(|part| part / norm)));
        new.normalize();
        new
    }

    /// The attitude, rounded.
    pub(super) fn rounded(&self) -> UnitQuaternion<f64> {
        let [w, i, j, k] = self.0.high;
        UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k))
    }

    /// Rotates the body by the vector `w` in its frame: `R ← R exp(ŵ)`.
    ///
    /// With the quaternion `e = exp(ŵ) − 1 = −2 sin²(θ/4) + w sin(θ/2)/θ` the product is `q + q e`. Its rounding errors
    /// are relative to the increment.
    pub(super) fn turn(&mut self, rotation: &Vector3<f64>) {
        let angle = Scalar::sqrt(rotation.dot(rotation));
        let ratio = if angle == 0.0 {
            0.5
        } else {
            Scalar::sin(angle / 2.0) / angle
        };
        let quarter: f64 = Scalar::sin(angle / 4.0);
        let increment = Quaternion::from_parts(-2.0 * quarter * quarter, rotation * ratio);
        let product = |[w, i, j, k]: [f64; 4]| {
            let product = Quaternion::new(w, i, j, k) * increment;
            [product.w, product.i, product.j, product.k]
        };
        let (high, low) = (product(self.0.high), product(self.0.low));
        self.0.add(high);
        self.0.add(low);
        self.normalize();
    }

    /// Corrects the norm, whose error is of the size of rounding, in `low`. The correction is parallel to the
    /// quaternion, so that it does not rotate the body.
    fn normalize(&mut self) {
        let Precise { high, low } = &mut self.0;
        let (q, rest) = (Vector4::from(*high), Vector4::from(*low));
        let excess = (q.dot(&q) - 1.0) / 2.0 + q.dot(&rest);
        for (high, low) in high.iter_mut().zip(low) {
            (*high, *low) = fast_two_sum(*high, *low - *high * excess);
        }
    }
}
