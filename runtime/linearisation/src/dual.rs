//! Dual numbers: a number and its derivative.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

use symplectic_core::Scalar;
use symplectic_core::emitted::Coefficient;
use symplectic_core::inside::larger_or_nan;

/// `value + slope ε` with `ε² = 0`: a number and its derivative with respect to a parameter. The bits of the value are those without it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T> {
    /// The number.
    pub value: T,
    /// Its derivative.
    pub slope: T,
}

/// `value + first ε1 + second ε2 + mixed ε1ε2`: a value, its derivatives with respect to two parameters, and the mixed second derivative
/// (Fike & Alonso 2011).
pub type HyperDual = Dual<Dual<f64>>;

impl HyperDual {
    /// A number with these derivatives; the mixed one is zero.
    #[inline]
    pub const fn new(value: f64, first: f64, second: f64) -> Self {
        Self {
            value: Dual {
                value,
                slope: second,
            },
            slope: Dual {
                value: first,
                slope: 0.0,
            },
        }
    }

    /// The value.
    #[inline]
    pub const fn real(self) -> f64 {
        self.value.value
    }

    /// The derivative with respect to the first parameter.
    #[inline]
    pub const fn first(self) -> f64 {
        self.slope.value
    }
}

#[cfg(feature = "alloc")]
impl HyperDual {
    /// The derivative with respect to the second parameter.
    #[inline]
    pub const fn second(self) -> f64 {
        self.value.slope
    }

    /// The derivative with respect to both parameters.
    #[inline]
    pub const fn mixed(self) -> f64 {
        self.slope.slope
    }

    /// Sets the derivative with respect to the first parameter.
    #[inline]
    pub const fn set_first(&mut self, first: f64) {
        self.slope.value = first;
    }

    /// Sets the derivative by the second parameter.
    #[inline]
    pub const fn set_second(&mut self, second: f64) {
        self.value.slope = second;
    }
}

impl<T: Scalar> Dual<T> {
    /// A constant.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn constant(value: T) -> Self {
        Self {
            value,
            slope: T::zero(),
        }
    }

    /// A function of this number, from its value and its derivative there.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn chain(self, value: T, slope: T) -> Self {
        Self {
            value,
            slope: slope * self.slope,
        }
    }
}

impl<T: Scalar> Add for Dual<T> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            slope: self.slope + other.slope,
        }
    }
}

impl<T: Scalar> Neg for Dual<T> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            slope: -self.slope,
        }
    }
}

impl<T: Scalar> Sub for Dual<T> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            slope: self.slope - other.slope,
        }
    }
}

impl<T: Scalar> Mul for Dual<T> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            slope: self.value * other.slope + self.slope * other.value,
        }
    }
}

impl<T: Scalar> Div for Dual<T> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self {
            value,
            slope: (self.slope - value * other.slope) / other.value,
        }
    }
}

macro_rules! assign {
    ($($name:ident $function:ident $operator:tt;)*) => {$(
        impl<T: Scalar> $name for Dual<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $function(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )*};
}

assign! {
    AddAssign add_assign +;
    SubAssign sub_assign -;
    MulAssign mul_assign *;
    DivAssign div_assign /;
}

impl<T: Scalar> Zero for Dual<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn zero() -> Self {
        Self::constant(T::zero())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl<T: Scalar> One for Dual<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn one() -> Self {
        Self::constant(T::one())
    }
}

impl<T: Scalar> Scalar for Dual<T> {
    const EPSILON: f64 = T::EPSILON;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_f64(value: f64) -> Self {
        Self::constant(T::from_f64(value))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_coefficient(coefficient: Coefficient) -> Self {
        Self::constant(T::from_coefficient(coefficient))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn weight(step_size: f64, coefficient: Coefficient) -> Self {
        Self::constant(T::weight(step_size, coefficient))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fused(self, factor: Self, term: Self) -> Self {
        let slope = self.value.fused(factor.slope, term.slope);
        Self {
            value: self.value.fused(factor.value, term.value),
            slope: self.slope.fused(factor.value, slope),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn magnitude(self) -> f64 {
        larger_or_nan(self.value.magnitude(), self.slope.magnitude())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, T::from_f64(0.5) / root)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn recip(self) -> Self {
        let inverse = self.value.recip();
        self.chain(inverse, -(inverse * inverse))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sign(self) -> Self {
        Self::constant(self.value.sign())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn or_zero(self, base: Self) -> Self {
        Self {
            value: self.value.or_zero(base.value),
            slope: self.slope.or_zero(base.value),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn abs(self) -> Self {
        self.chain(self.value.abs(), self.value.sign())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, value)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn ln(self) -> Self {
        self.chain(self.value.ln(), self.value.recip())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin(self) -> Self {
        self.sin_cos().0
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn cos(self) -> Self {
        self.sin_cos().1
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sin_cos();
        (self.chain(sine, cosine), self.chain(cosine, -sine))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tan(self) -> Self {
        let tangent = self.value.tan();
        self.chain(tangent, T::one() + tangent * tangent)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn asin(self) -> Self {
        let square = T::one() - self.value * self.value;
        self.chain(self.value.asin(), square.sqrt().recip())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acos(self) -> Self {
        let square = T::one() - self.value * self.value;
        self.chain(self.value.acos(), -square.sqrt().recip())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn atan(self) -> Self {
        let square = T::one() + self.value * self.value;
        self.chain(self.value.atan(), square.recip())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        Self {
            value: self.value.atan2(x.value),
            slope: (x.value * self.slope - self.value * x.slope) / square,
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sinh(self) -> Self {
        self.chain(self.value.sinh(), self.value.cosh())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn cosh(self) -> Self {
        self.chain(self.value.cosh(), self.value.sinh())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tanh(self) -> Self {
        let inverse = self.value.cosh().recip();
        self.chain(self.value.tanh(), inverse * inverse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use symplectic_core::simd::{F64x2, Lanes};

    /// Checks every function against differences of order 4, along both parameters, and checks the same values and slopes in lanes.
    #[test]
    fn hyperdual_derivatives_agree_with_differences() {
        fn check(name: &str, f: impl Fn(HyperDual) -> HyperDual) {
            let at = |a: f64, b: f64| {
                // x(a, b) has derivatives with respect to both parameters and a mixed derivative.
                let x = 0.4 + 0.7 * a + 0.3 * b + 0.2 * a * b;
                f(HyperDual::from_f64(x)).real()
            };
            let mut x = HyperDual::new(0.4, 0.7, 0.3);
            x.slope.slope = 0.2;
            let found = f(x);
            const H: f64 = 2e-3;
            let slope = |f: &dyn Fn(f64) -> f64| {
                (8.0 * (f(H) - f(-H)) - (f(2.0 * H) - f(-2.0 * H))) / (12.0 * H)
            };
            let mut expected =
                HyperDual::new(at(0.0, 0.0), slope(&|a| at(a, 0.0)), slope(&|b| at(0.0, b)));
            expected.slope.slope = slope(&|a| slope(&|b| at(a, b)));
            let error = (found - expected).magnitude();
            assert!(
                error < 1e-8 * expected.magnitude(),
                "{name}: {found:?} {expected:?}"
            );
        }
        let constant = HyperDual::from_f64(1.7);
        check("product", |x| x * (x + constant) * x);
        check("quotient", |x| (x - constant) / (x * x));
        check("fused", |x| x.fused(x * x, x));
        check("sqrt", Scalar::sqrt);
        check("recip", Scalar::recip);
        check("powi", |x| x.powi(5));
        check("abs", |x| (x - constant).abs());
        check("exp", Scalar::exp);
        check("ln", Scalar::ln);
        check("sin", Scalar::sin);
        check("cos", Scalar::cos);
        check("tan", Scalar::tan);
        check("asin", Scalar::asin);
        check("acos", Scalar::acos);
        check("atan", Scalar::atan);
        check("atan2", |x| x.atan2(constant));
        check("atan2 of both", |x| (x - constant).atan2(x * x - constant));
        check("sinh", Scalar::sinh);
        check("cosh", Scalar::cosh);
        check("tanh", Scalar::tanh);
    }

    /// Each lane holds the dual number of its double, also at zeros of either sign.
    #[test]
    fn dual_numbers_in_lanes_are_those_of_doubles() {
        fn f<T: Scalar>(x: T) -> T {
            (x.abs() + T::one()).ln() * x.sin().exp() / (x * x + T::one()).sqrt()
        }
        for (a, b) in [(0.3, -2.0), (0.0, -0.0)] {
            let dual = |value| Dual { value, slope: 1.0 };
            let both = f(Dual {
                value: F64x2::from_array([a, b]),
                slope: F64x2::one(),
            });
            for (lane, x) in [a, b].into_iter().enumerate() {
                let found = f(dual(x));
                assert_eq!(found.value, both.value.to_array()[lane]);
                assert_eq!(found.slope, both.slope.to_array()[lane]);
            }
        }
    }
}
