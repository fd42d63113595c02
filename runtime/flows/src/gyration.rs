//! A magnetic field.

use nalgebra::Vector3;

use super::{Flow, FlowError, Span};
use symplectic_core::{Quantity, Scalar, Vector};

/// The rotation of particles in a magnetic field: `v' = v × B(t, q)` at fixed positions. `B` is charge over mass times the magnetic field,
/// at the [middle](Span::middle) of the time span.
///
/// The velocity of each particle, three components of `p`, turns exactly by the angle `−h|B|` about `B(t, q)` (Rodrigues' formula). The
/// rotation depends on `q` only, so it conserves `|v|` and the volume in phase space. With a drift and a kick by the electric field, a
/// [`Palindrome`](super::Palindrome) gives Boris's method with the exact angle. It has order 2, is symmetric and preserves volume (Boris
/// 1970; Qin et al., *Phys. Plasmas* 20, 084503, 2013). It is not symplectic in general: `v` is the kinetic momentum.
///
/// ```
/// use symplectic::flow::{Flow, FlowError, Gyration, Span};
/// use symplectic::nalgebra::Vector3;
///
/// let mut gyration = Gyration::new(|_time, _q: &Vector3<f64>| Vector3::z());
/// let (mut q, mut v) = (Vector3::zeros(), Vector3::x());
/// gyration.flow(Span { time: 0.0, size: std::f64::consts::FRAC_PI_2 }, &mut q, &mut v)?;
/// assert!((v + Vector3::y()).norm() < 1e-15);
/// # Ok::<(), FlowError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Gyration<F> {
    field: F,
}

impl<F: Fn(f64, &Vector3<f64>) -> Vector3<f64>> Gyration<F> {
    /// The field `B(t, q)`: charge over mass times the field in space.
    pub const fn new(field: F) -> Self {
        Self { field }
    }

    /// The rotation of a velocity.
    fn turned(&self, span: Span, q: &Vector3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
        let angle = (self.field)(span.middle(), q) * -span.size;
        let (size, half) = (Scalar::sqrt(angle.dot(&angle)), 0.5);
        if size == 0.0 {
            return *v;
        }
        // Half the angle avoids the cancellation in 1 − cos.
        let (sine, cosine) = Scalar::sin_cos(half * size);
        let axis = angle / size;
        let once = axis.cross(v);
        let twice = axis.cross(&once);
        v + once * (2.0 * sine * cosine) + twice * (2.0 * sine * sine)
    }
}

impl<V, F> Flow<V> for Gyration<F>
where
    V: Vector<Scalar = f64>,
    F: Fn(f64, &Vector3<f64>) -> Vector3<f64>,
{
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        let (q, p) = (q.as_slice(), p.as_mut_slice());
        if q.len() % 3 != 0 || p.len() != q.len() {
            return Err(FlowError::Dimension {
                expected: q.len().next_multiple_of(3),
                found: p.len(),
            });
        }
        for (q, p) in q.chunks_exact(3).zip(p.chunks_exact_mut(3)) {
            let (q, v) = (Vector3::from_column_slice(q), Vector3::from_column_slice(p));
            let turned = self.turned(span, &q, &v);
            if !turned.iter().all(|component| component.is_finite()) {
                let what = Quantity::Momentum;
                return Err(FlowError::NonFinite { what });
            }
            p.copy_from_slice(turned.as_slice());
        }
        Ok(())
    }
}
