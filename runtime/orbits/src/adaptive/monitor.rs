//! Monitors: functions of the positions that set the step size.

use symplectic_core::{Hamiltonian, Scalar, Separable, System, Vector};
use symplectic_linearisation::HyperDual;

/// A monitor σ(q) > 0, which sets the step size `h ≈ ε σ(q)`. The run chooses ε.
///
/// σ must be small where the motion is fast: `|q|^{3/2}` for a Kepler orbit, by Kepler's third law. The positions are given as a slice, so
/// that one monitor serves vectors of every type. A monitor is written once, for every [`Scalar`]: dual numbers give its derivatives. As in
/// all code for every scalar, no branch may depend on a value.
///
/// ```
/// use symplectic::Scalar;
/// use symplectic::adaptive::Monitor;
///
/// /// Short steps near the wall x = 0.
/// struct NearWall;
///
/// impl Monitor for NearWall {
///     fn value<T: Scalar>(&self, q: &[T]) -> T {
///         (q[0] * q[0] + T::from_f64(0.01)).sqrt()
///     }
/// }
///
/// assert!((NearWall.value(&[0.0_f64]) - 0.1).abs() < 1e-15);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a monitor of step sizes",
    note = "take `DistancePower`, `PairDistances` or `ForcePower`, or implement `Monitor` with `fn value<T: Scalar>(&self, q: &[T]) -> T`"
)]
pub trait Monitor {
    /// σ(q), finite and positive wherever the motion goes.
    fn value<T: Scalar>(&self, q: &[T]) -> T;

    /// Writes `∇ ln σ = ∇σ/σ`, with as many components as `q`, and returns `true`. If it returns `false`, the default, dual numbers give
    /// the derivatives. Implement it if it is cheaper than evaluating σ in dual numbers.
    fn logarithmic_gradient(&self, _q: &[f64], _gradient: &mut [f64]) -> bool {
        false
    }
}

impl<W: Monitor + ?Sized> Monitor for &W {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        (**self).value(q)
    }

    fn logarithmic_gradient(&self, q: &[f64], gradient: &mut [f64]) -> bool {
        (**self).logarithmic_gradient(q, gradient)
    }
}

/// The monitor `σ = |q|^α`, for motion about a centre.
///
/// With `α = 3/2` the step size is proportional to the free-fall time to a Kepler centre: use it for orbits of high eccentricity.
///
/// ```
/// use symplectic::adaptive::{DistancePower, Monitor};
///
/// assert!((DistancePower(1.5).value(&[0.0, 4.0_f64]) - 8.0).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistancePower(
    /// The exponent α.
    pub f64,
);

impl Monitor for DistancePower {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        power(square(q), 0.5 * self.0)
    }

    /// `α q/|q|²`
    fn logarithmic_gradient(&self, q: &[f64], gradient: &mut [f64]) -> bool {
        let factor = self.0 / square(q);
        for (gradient, q) in gradient.iter_mut().zip(q) {
            *gradient = factor * q;
        }
        true
    }
}

/// A smooth monitor for close encounters of bodies: about `r^α`, with the smallest distance r between two bodies,
///
/// ```text
/// σ = (Σ_{i<j} |q_i − q_j|^{−2m})^{−α/(2m)}
/// ```
///
/// `q` holds the bodies in sequence, with as many components each as space has dimensions; leftover components are ignored. The larger m
/// is, the closer σ is to `r^α`.
///
/// ```
/// use symplectic::adaptive::{Monitor, PairDistances};
///
/// // Three bodies in the plane.
/// let monitor = PairDistances { dimensions: 2, sharpness: 2, exponent: 1.5 };
/// let least = 0.25_f64;
/// let found = monitor.value(&[0.0, 0.0, least, 0.0, 3.0, 4.0]);
/// assert!((found / least.powf(1.5) - 1.0).abs() < 1e-3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairDistances {
    /// Components of a body: 2 in the plane, 3 in space.
    pub dimensions: usize,
    /// m
    pub sharpness: u16,
    /// α
    pub exponent: f64,
}

impl PairDistances {
    /// Calls `see(i, j, r², r^{−2m})` for each pair of bodies: the indices of their first components, and their distance r.
    fn pairs<T: Scalar>(&self, q: &[T], mut see: impl FnMut(usize, usize, T, T)) {
        let dimensions = self.dimensions.max(1);
        let places = || (0..q.len() / dimensions).map(|body| body * dimensions);
        let body = |place: usize| q[place..].iter().take(self.dimensions);
        for i in places() {
            for j in places().take_while(|&j| j < i) {
                let differences = body(i).zip(body(j)).map(|(&a, &b)| a - b);
                let square = differences.fold(T::zero(), |sum, d| sum + d * d);
                see(i, j, square, square.powi(-i32::from(self.sharpness)));
            }
        }
    }
}

impl Monitor for PairDistances {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        let mut sum = T::zero();
        self.pairs(q, |_, _, _, term| sum += term);
        power(sum, -0.5 * self.exponent / f64::from(self.sharpness))
    }

    /// `α Σ_j r_ij^{−2m−2} (q_i − q_j) / Σ r^{−2m}` for body i.
    fn logarithmic_gradient(&self, q: &[f64], gradient: &mut [f64]) -> bool {
        gradient.fill(0.0);
        let mut sum = 0.0;
        self.pairs(q, |i, j, square, term| {
            sum += term;
            for k in 0..self.dimensions {
                let part = term / square * (q[i + k] - q[j + k]);
                gradient[i + k] += part;
                gradient[j + k] -= part;
            }
        });
        for component in gradient {
            *component *= self.exponent / sum;
        }
        true
    }
}

/// A monitor that is small where the force is strong, for systems without a natural distance:
///
/// ```text
/// σ = (F_0² + |∂H/∂q|²)^{−α/2}
/// ```
///
/// With `α = 3/4` and `F_0 = 0` it is `|q|^{3/2}` in the Kepler problem `U = −1/|q|`. If the force has zeros, a floor `F_0 > 0` keeps σ
/// finite. The force is evaluated at time 0: once for a value of σ, and once in dual numbers for a directional derivative. With dynamic
/// vectors each evaluation allocates.
///
/// ```
/// use symplectic::adaptive::{ForcePower, Monitor};
///
/// symplectic::hamiltonian! { Kepler q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2) }
///
/// let monitor = ForcePower { system: Kepler, exponent: 0.75, floor: 0.0 };
/// assert!((monitor.value(&[0.0, 4.0_f64]) - 8.0).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForcePower<S> {
    /// The system whose force is evaluated.
    pub system: S,
    /// α
    pub exponent: f64,
    /// `F_0`
    pub floor: f64,
}

impl<S: Hamiltonian<Class = Separable>> Monitor for ForcePower<S> {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        let Ok(q) = S::Vector::from_slice(q) else {
            return T::from_f64(f64::NAN);
        };
        let mut force = q.zeros_like();
        self.system.force(T::zero(), &q, &q, &mut force);
        let floor = T::from_f64(self.floor);
        power(
            floor * floor + square(force.as_slice()),
            -0.5 * self.exponent,
        )
    }
}

/// Σ x²
fn square<T: Scalar>(x: &[T]) -> T {
    x.iter().fold(T::zero(), |sum, &x| sum + x * x)
}

/// `x^exponent` for x > 0.
fn power<T: Scalar>(x: T, exponent: f64) -> T {
    (x.ln() * T::from_f64(exponent)).exp()
}

/// The value of a monitor at a position; the value as an error if it is not finite and positive.
pub(super) fn value_at<W: Monitor>(monitor: &W, q: &[f64]) -> Result<f64, f64> {
    let value = monitor.value(q);
    // 1/σ must not overflow either.
    let sound = value > 0.0 && value.is_finite() && value.recip().is_finite();
    if sound { Ok(value) } else { Err(value) }
}

/// The positions on which a monitor depends, without displacements: see [`System::DISPLACED`].
pub(super) fn seen<S: System<V>, V: Vector>(q: &V) -> &[V::Scalar] {
    let q = q.as_slice();
    match S::DISPLACED {
        true => &q[..q.len() / 2],
        false => q,
    }
}

/// Work vectors for the derivatives of a monitor.
#[derive(Clone, Debug)]
pub(super) struct Slopes<V: Vector> {
    gradient: V,
    duals: V::With<HyperDual>,
}

impl<V: Vector<Scalar = f64>> Slopes<V> {
    pub(super) fn like(prototype: &V) -> Self {
        Self {
            gradient: prototype.zeros_like(),
            duals: prototype.zeros_with(),
        }
    }

    /// `∇ ln σ · direction`; NaN if dual numbers evaluate it and σ is not positive.
    pub(super) fn along<W: Monitor>(&mut self, monitor: &W, q: &[f64], direction: &[f64]) -> f64 {
        let gradient = &mut self.gradient.as_mut_slice()[..q.len()];
        if monitor.logarithmic_gradient(q, gradient) {
            let products = gradient.iter().zip(direction).map(|(g, d)| g * d);
            return products.fold(0.0, |sum, product| sum + product);
        }
        let duals = &mut self.duals.as_mut_slice()[..q.len()];
        for ((dual, &value), &first) in duals.iter_mut().zip(q).zip(direction) {
            *dual = HyperDual::new(value, first, 0.0);
        }
        let found = monitor.value(duals);
        if found.real() > 0.0 {
            found.first() / found.real()
        } else {
            f64::NAN
        }
    }

    /// `∇ ln σ`
    #[cfg(feature = "alloc")]
    pub(super) fn gradient<W: Monitor>(&mut self, monitor: &W, q: &V) -> &V {
        let q = q.as_slice();
        let gradient = self.gradient.as_mut_slice();
        if !monitor.logarithmic_gradient(q, gradient) {
            let duals = self.duals.as_mut_slice();
            for (dual, &value) in duals.iter_mut().zip(q) {
                *dual = HyperDual::from_f64(value);
            }
            // One evaluation gives two components.
            for (pair, gradient) in gradient.chunks_mut(2).enumerate() {
                let seed = |duals: &mut [HyperDual], slope: f64| {
                    duals[2 * pair].set_first(slope);
                    if let Some(dual) = duals.get_mut(2 * pair + 1) {
                        dual.set_second(slope);
                    }
                };
                seed(duals, 1.0);
                let found = monitor.value(duals);
                seed(duals, 0.0);
                for (gradient, slope) in gradient.iter_mut().zip([found.first(), found.second()]) {
                    *gradient = slope / found.real();
                }
            }
        }
        &self.gradient
    }
}

/// Makes [`Error::Monitor`](symplectic_core::Error::Monitor) at a time from a value.
pub(super) const fn monitor_at(time: f64) -> impl Fn(f64) -> symplectic_core::Error {
    move |value| symplectic_core::Error::Monitor { time, value }
}
