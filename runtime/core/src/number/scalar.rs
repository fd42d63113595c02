//! The numbers of a system.

use core::ops::Neg;

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign};
use num_traits::{Float, One, Zero};

use crate::number::registers::Work;
use crate::number::words::{Visit, words};
use crate::number::{Coefficient, MAX_LANES};

/// A real number, or a type that behaves like one: f32, f64, a dual number, SIMD lanes.
///
/// A system written for every `T: Scalar` runs on all of them without a change. The operators come from the
/// supertraits, which nalgebra also requires for `q + p`, `q * s`, `-q` and `q.dot(&p)`. Scalars have no order, since
/// SIMD lanes have none: code that is generic over scalars cannot branch on a value.
///
/// Sine, cosine, exponential function and logarithm of doubles use the same operations on every platform and in
/// [lanes](crate::simd::Lanes). Their error is below one unit in the last place. They may differ in the last bit from those of `f64`, which
/// depend on the platform. `Scalar::sin(x)` calls them where `x` is known to be an f64.
///
/// ```
/// use symplectic::Scalar;
/// use symplectic::nalgebra::SVector;
///
/// /// The force of a Kepler potential −1/|q|.
/// fn kepler<T: Scalar>(q: &SVector<T, 2>) -> SVector<T, 2> {
///     let square = q.dot(q);
///     -q * (square * square.sqrt()).recip()
/// }
///
/// assert_eq!(kepler(&SVector::<f64, 2>::new(0.0, 2.0))[1], -0.25);
/// assert_eq!(kepler(&SVector::<f32, 2>::new(0.0, 2.0))[1], -0.25);
/// ```
pub trait Scalar:
    nalgebra::Scalar
    + Copy
    + Zero
    + One
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + ClosedDivAssign
    + Neg<Output = Self>
{
    /// Distance from 1 to the next larger number: 2⁻⁵² for f64, 2⁻²³ for f32.
    const EPSILON: f64;

    /// Whether the scalar is f64, so that coupled stages can be computed side by side in lanes.
    #[doc(hidden)]
    const IS_DOUBLE: bool = false;

    /// Whether these are lanes of registers that the program detects at run time: see [`in_registers`](Self::in_registers).
    #[doc(hidden)]
    const FOUND: bool = false;

    /// The scalar nearest to `value`, as a constant: all derivatives are zero and all lanes equal.
    fn from_f64(value: f64) -> Self;

    /// A constant with these numbers in its lanes; the first number, if there are no lanes.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_lanes(numbers: &[f64; MAX_LANES]) -> Self {
        Self::from_f64(numbers[0])
    }

    /// The scalar nearest to a coefficient of a method, as a constant: its nearest double, or its nearest single for f32.
    ///
    /// A scalar with more digits than a double also uses [`Coefficient::low`], here and in [`weight`](Self::weight).
    ///
    /// ```
    /// use symplectic::Scalar;
    /// use symplectic::solver::Coefficient;
    ///
    /// // 1 + 2⁻²⁴ + 2⁻⁶⁰: its double is the middle of two singles, of which the lower one is even.
    /// let c = Coefficient::new(1.0 + 2_f64.powi(-24), 2_f64.powi(-60), 1.0 + f32::EPSILON);
    /// assert_eq!(f32::from_coefficient(c), 1.0 + f32::EPSILON);
    /// assert_eq!(c.double() as f32, 1.0);
    /// ```
    #[inline]
    fn from_coefficient(coefficient: Coefficient) -> Self {
        Self::from_f64(coefficient.double())
    }

    /// `step_size` times a coefficient of a method, as a constant: the factor of an evaluation in a stage.
    ///
    /// The product is computed in double precision and rounded to the scalar last. For f32 its relative error is then at most 2⁻²⁴, the
    /// smallest possible bound. From the coefficient as an f32 the bound would be twice as large, and the error would have the same sign in
    /// every step. On a Kepler orbit of 20 000 steps of Gauss with five stages the energy error would be twice as large.
    #[inline]
    fn weight(step_size: f64, coefficient: Coefficient) -> Self {
        Self::from_f64(step_size * coefficient.double())
    }

    /// The largest absolute value among the parts. For a float it is |x|, for a dual number the largest over value and derivatives, for
    /// SIMD lanes the largest over the lanes.
    ///
    /// NaN if any part is NaN, even if another part is larger: the solver and the checks for finiteness rely on it.
    fn magnitude(self) -> f64;

    /// Whether all parts are finite. The result of a step is checked by its [magnitude](Self::magnitude) alone.
    #[inline]
    fn is_finite(self) -> bool {
        self.magnitude().is_finite()
    }

    /// `self·factor + term`, the building block of sums of products: rounded twice, or once with the feature `fma`.
    ///
    /// ```
    /// use symplectic::Scalar;
    ///
    /// assert_eq!(2.0_f64.fused(3.0, 4.0), 10.0);
    /// let (x, square) = (1.0 + f64::EPSILON, 1.0 + 2.0 * f64::EPSILON);
    /// let rest = if cfg!(feature = "fma") { f64::EPSILON.powi(2) } else { 0.0 };
    /// assert_eq!(x.fused(x, -square), rest);
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fused(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    /// Name of the type in checkpoints; `None` if it cannot be saved.
    #[doc(hidden)]
    const SAVED_AS: Option<&'static str> = None;

    /// The [words](crate::number::Words) of the scalar, if it can be [saved](Self::SAVED_AS).
    #[doc(hidden)]
    fn as_words(&mut self, _visit: &mut Visit<'_>) {}

    /// The numbers as doubles, if they are doubles.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn doubles(_numbers: &[Self]) -> Option<&[f64]> {
        None
    }

    /// Mutable [`doubles`](Self::doubles).
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn doubles_mut(_numbers: &mut [Self]) -> Option<&mut [f64]> {
        None
    }

    /// Runs work in a function that is compiled for the registers of these numbers.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn in_registers<W: Work>(work: W) -> W::Output {
        work.run()
    }

    /// Square root.
    fn sqrt(self) -> Self;
    /// 1/x.
    fn recip(self) -> Self;
    /// xⁿ by repeated squaring: the same products in the same order for every scalar.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn powi(self, exponent: i32) -> Self {
        let (mut rest, mut square) = (exponent.unsigned_abs(), self);
        let mut power = Self::one();
        while rest > 0 {
            if rest % 2 == 1 {
                power *= square;
            }
            rest /= 2;
            if rest > 0 {
                square *= square;
            }
        }
        if exponent < 0 { power.recip() } else { power }
    }
    /// |x|; its derivative is the sign of x.
    fn abs(self) -> Self;
    /// 1 with the sign of x, the derivative of |x|.
    #[doc(hidden)]
    #[inline]
    fn sign(self) -> Self {
        self.abs() / self
    }
    /// The number, or 0 with all its derivatives if the value of `base` is 0. Emitted code applies it to a power of `base`, if the
    /// compiler finds that the formula and the derivatives that are needed have the same limits with 0 for the power. So 0·∞ does not occur.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn or_zero(self, base: Self) -> Self {
        if base.is_zero() { Self::zero() } else { self }
    }
    /// Exponential function.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Sine of an angle in radians.
    fn sin(self) -> Self;
    /// Cosine of an angle in radians.
    fn cos(self) -> Self;
    /// Tangent of an angle in radians.
    fn tan(self) -> Self;
    /// Inverse sine, in radians.
    fn asin(self) -> Self;
    /// Inverse cosine, in radians.
    fn acos(self) -> Self;
    /// Inverse tangent, in radians.
    fn atan(self) -> Self;
    /// The angle of the point `(x, self)` in radians, from −π to π.
    ///
    /// The default is `2 atan(y/(√(x² + y²) + x))`, which loses digits near the negative half of the x axis.
    #[inline]
    fn atan2(self, x: Self) -> Self {
        let angle = (self / ((self * self + x * x).sqrt() + x)).atan();
        angle + angle
    }
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;

    /// Sine and cosine together.
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        (self.sin(), self.cos())
    }

    /// Sines and cosines of several angles, each with the bits of [`sin_cos`](Self::sin_cos). For independent angles of doubles and lanes
    /// this is faster than one call after the other. Unused results are not computed.
    ///
    /// ```
    /// use symplectic::Scalar;
    ///
    /// let [(sine, cosine), (other, _)] = Scalar::sin_cos_all([0.5, 2.0_f64]);
    /// assert_eq!((sine, cosine, other), (Scalar::sin(0.5), Scalar::cos(0.5), Scalar::sin(2.0)));
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        let mut all = [(Self::zero(), Self::zero()); N];
        for (both, angle) in all.iter_mut().zip(angles) {
            *both = angle.sin_cos();
        }
        all
    }
}

/// The larger of two numbers; NaN if either is, unlike [`f64::max`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub const fn larger_or_nan(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

macro_rules! forward {
    ($($function:ident)*) => {
        $(
            #[inline]
            fn $function(self) -> Self {
                Float::$function(self)
            }
        )*
    };
}

/// Functions of [`elementary`](crate::number::elementary).
macro_rules! elementary {
    ($($function:ident -> $result:ty),*) => {
        $(
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $function(self) -> $result {
                $crate::number::elementary::$function(self)
            }
        )*

        #[cfg_attr(not(debug_assertions), inline(always))]
        fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
            $crate::number::elementary::sin_cos_all(angles)
        }
    };
}
pub(crate) use elementary;

macro_rules! float {
    ($float:ident, $coefficient:ident, { $($own:tt)* }) => {
        impl Scalar for $float {
            const EPSILON: f64 = $float::EPSILON as f64;

            #[inline]
            fn from_f64(value: f64) -> Self {
                value as $float
            }

            #[inline]
            fn from_coefficient(coefficient: Coefficient) -> Self {
                coefficient.$coefficient()
            }

            #[inline]
            fn magnitude(self) -> f64 {
                self.abs() as f64
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn fused(self, factor: Self, term: Self) -> Self {
                if cfg!(feature = "fma") {
                    Float::mul_add(self, factor, term)
                } else {
                    self * factor + term
                }
            }

            forward! { sqrt recip abs tan asin acos atan sinh cosh tanh }

            #[inline]
            fn sign(self) -> Self {
                Float::signum(self)
            }

            #[inline]
            fn atan2(self, x: Self) -> Self {
                Float::atan2(self, x)
            }

            $($own)*
        }
    };
}

float!(f64, double, {
    const SAVED_AS: Option<&'static str> = Some("f64");

    fn as_words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: *self);
    }

    const IS_DOUBLE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn doubles(numbers: &[f64]) -> Option<&[f64]> {
        Some(numbers)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn doubles_mut(numbers: &mut [f64]) -> Option<&mut [f64]> {
        Some(numbers)
    }

    elementary! { exp -> Self, ln -> Self, sin -> Self, cos -> Self, sin_cos -> (Self, Self) }
});
float!(f32, single, {
    const SAVED_AS: Option<&'static str> = Some("f32");

    fn as_words(&mut self, visit: &mut Visit<'_>) {
        let mut bits = self.to_bits();
        words!(visit: bits);
        *self = f32::from_bits(bits);
    }

    forward! { exp ln sin cos }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        Float::sin_cos(self)
    }
});

#[cfg(test)]
mod tests {
    use super::larger_or_nan;

    #[test]
    fn not_a_number_is_the_largest() {
        let larger = [larger_or_nan(1.0, 2.0), larger_or_nan(2.0, 1.0)];
        assert_eq!(larger, [2.0; 2]);
        assert_eq!(larger_or_nan(1.0, f64::INFINITY), f64::INFINITY);
        for other in [0.0, 1.0, f64::INFINITY, f64::NAN] {
            assert!(larger_or_nan(other, f64::NAN).is_nan(), "{other}");
            assert!(larger_or_nan(f64::NAN, other).is_nan(), "{other}");
        }
    }
}
