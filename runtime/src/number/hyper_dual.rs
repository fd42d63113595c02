//! Numbers with two derivatives and their mixed one.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{Float, One, Zero};

use crate::number::Scalar;

/// `value + first ε1 + second ε2 + mixed ε1ε2` with `ε1² = ε2² = 0`: a value, its derivatives by two parameters, and the second derivative by
/// both (Fike & Alonso 2011).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HyperDual {
    pub(crate) value: f64,
    pub(crate) first: f64,
    pub(crate) second: f64,
    pub(crate) mixed: f64,
}

impl HyperDual {
    /// A function of this number, from its value and its two derivatives there.
    #[inline]
    fn chain(self, value: f64, slope: f64, curvature: f64) -> Self {
        Self {
            value,
            first: slope * self.first,
            second: slope * self.second,
            mixed: slope * self.mixed + curvature * self.first * self.second,
        }
    }
}

impl Add for HyperDual {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            first: self.first + other.first,
            second: self.second + other.second,
            mixed: self.mixed + other.mixed,
        }
    }
}

impl Neg for HyperDual {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            first: -self.first,
            second: -self.second,
            mixed: -self.mixed,
        }
    }
}

impl Sub for HyperDual {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for HyperDual {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        Self {
            value: a.value * b.value,
            first: a.value * b.first + a.first * b.value,
            second: a.value * b.second + a.second * b.value,
            mixed: (a.value * b.mixed + a.mixed * b.value)
                + (a.first * b.second + a.second * b.first),
        }
    }
}

impl Div for HyperDual {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let (a, b) = (self, other);
        let value = a.value / b.value;
        let first = (a.first - value * b.first) / b.value;
        let second = (a.second - value * b.second) / b.value;
        let rest = value * b.mixed + (first * b.second + second * b.first);
        Self {
            value,
            first,
            second,
            mixed: (a.mixed - rest) / b.value,
        }
    }
}

macro_rules! assign {
    ($($name:ident $function:ident $operator:tt;)*) => {$(
        impl $name for HyperDual {
            #[inline]
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

impl Zero for HyperDual {
    fn zero() -> Self {
        Self::from_f64(0.0)
    }

    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl One for HyperDual {
    fn one() -> Self {
        Self::from_f64(1.0)
    }
}

impl Scalar for HyperDual {
    const EPSILON: f64 = f64::EPSILON;

    #[inline]
    fn from_f64(value: f64) -> Self {
        Self {
            value,
            first: 0.0,
            second: 0.0,
            mixed: 0.0,
        }
    }

    fn magnitude(self) -> f64 {
        let parts = [self.value, self.first, self.second, self.mixed];
        parts.into_iter().fold(0.0, |largest: f64, part| {
            let size = Float::abs(part);
            if size > largest || size.is_nan() {
                size
            } else {
                largest
            }
        })
    }

    fn sqrt(self) -> Self {
        let root = Scalar::sqrt(self.value);
        let slope = 0.5 / root;
        self.chain(root, slope, -0.5 * slope / self.value)
    }

    fn recip(self) -> Self {
        let inverse = 1.0 / self.value;
        let square = inverse * inverse;
        self.chain(inverse, -square, 2.0 * square * inverse)
    }

    fn abs(self) -> Self {
        if self.value.is_sign_negative() {
            -self
        } else {
            self
        }
    }

    fn exp(self) -> Self {
        let value = Scalar::exp(self.value);
        self.chain(value, value, value)
    }

    fn ln(self) -> Self {
        let slope = 1.0 / self.value;
        self.chain(Scalar::ln(self.value), slope, -slope * slope)
    }

    fn sin(self) -> Self {
        self.sin_cos().0
    }

    fn cos(self) -> Self {
        self.sin_cos().1
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = Scalar::sin_cos(self.value);
        (
            self.chain(sine, cosine, -sine),
            self.chain(cosine, -sine, -cosine),
        )
    }

    fn tan(self) -> Self {
        let tangent = Scalar::tan(self.value);
        let slope = 1.0 + tangent * tangent;
        self.chain(tangent, slope, 2.0 * tangent * slope)
    }

    fn asin(self) -> Self {
        let square = 1.0 - self.value * self.value;
        let slope = 1.0 / Scalar::sqrt(square);
        self.chain(Scalar::asin(self.value), slope, self.value * slope / square)
    }

    fn acos(self) -> Self {
        let square = 1.0 - self.value * self.value;
        let slope = -1.0 / Scalar::sqrt(square);
        self.chain(Scalar::acos(self.value), slope, self.value * slope / square)
    }

    fn atan(self) -> Self {
        let slope = 1.0 / (1.0 + self.value * self.value);
        let curvature = -2.0 * self.value * slope * slope;
        self.chain(Scalar::atan(self.value), slope, curvature)
    }

    fn sinh(self) -> Self {
        let (sine, cosine) = (Scalar::sinh(self.value), Scalar::cosh(self.value));
        self.chain(sine, cosine, sine)
    }

    fn cosh(self) -> Self {
        let (sine, cosine) = (Scalar::sinh(self.value), Scalar::cosh(self.value));
        self.chain(cosine, sine, cosine)
    }

    fn tanh(self) -> Self {
        let tangent = Scalar::tanh(self.value);
        let slope = 1.0 - tangent * tangent;
        self.chain(tangent, slope, -2.0 * tangent * slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every function against differences of order 4, along both parameters.
    #[test]
    fn derivatives() {
        fn check(name: &str, f: impl Fn(HyperDual) -> HyperDual) {
            let at = |a: f64, b: f64| {
                // x(a, b) has derivatives by both and a mixed one.
                let x = 0.4 + 0.7 * a + 0.3 * b + 0.2 * a * b;
                f(HyperDual::from_f64(x)).value
            };
            let found = f(HyperDual {
                value: 0.4,
                first: 0.7,
                second: 0.3,
                mixed: 0.2,
            });
            const H: f64 = 2e-3;
            let slope = |f: &dyn Fn(f64) -> f64| {
                (8.0 * (f(H) - f(-H)) - (f(2.0 * H) - f(-2.0 * H))) / (12.0 * H)
            };
            let expected = HyperDual {
                value: at(0.0, 0.0),
                first: slope(&|a| at(a, 0.0)),
                second: slope(&|b| at(0.0, b)),
                mixed: slope(&|a| slope(&|b| at(a, b))),
            };
            let error = (found - expected).magnitude();
            assert!(
                error < 1e-8 * expected.magnitude(),
                "{name}: {found:?} {expected:?}"
            );
        }
        let constant = HyperDual::from_f64(1.7);
        check("product", |x| x * (x + constant) * x);
        check("quotient", |x| (x - constant) / (x * x));
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
        check("sinh", Scalar::sinh);
        check("cosh", Scalar::cosh);
        check("tanh", Scalar::tanh);
    }
}
