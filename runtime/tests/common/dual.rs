use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use symplectic::Scalar;
use symplectic::num_traits::{One, Zero};

/// A value and its derivative by one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual {
    pub value: f64,
    pub derivative: f64,
}

pub const fn dual(value: f64, derivative: f64) -> Dual {
    Dual { value, derivative }
}

impl Dual {
    fn chain(self, value: f64, slope: f64) -> Self {
        dual(value, slope * self.derivative)
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        dual(self.value + other.value, self.derivative + other.derivative)
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        dual(self.value - other.value, self.derivative - other.derivative)
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        dual(
            self.value * other.value,
            self.derivative * other.value + self.value * other.derivative,
        )
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        dual(
            value,
            (self.derivative - value * other.derivative) / other.value,
        )
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        dual(-self.value, -self.derivative)
    }
}

impl AddAssign for Dual {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Dual {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign for Dual {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl DivAssign for Dual {
    fn div_assign(&mut self, other: Self) {
        *self = *self / other;
    }
}

impl Zero for Dual {
    fn zero() -> Self {
        dual(0.0, 0.0)
    }
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl One for Dual {
    fn one() -> Self {
        dual(1.0, 0.0)
    }
}

impl Scalar for Dual {
    const EPSILON: f64 = f64::EPSILON;

    fn from_f64(value: f64) -> Self {
        dual(value, 0.0)
    }

    fn magnitude(self) -> f64 {
        let (value, derivative) = (self.value.abs(), self.derivative.abs());
        if value.is_nan() || derivative.is_nan() {
            f64::NAN
        } else {
            value.max(derivative)
        }
    }

    fn sqrt(self) -> Self {
        self.chain(self.value.sqrt(), 0.5 / self.value.sqrt())
    }

    fn recip(self) -> Self {
        self.chain(self.value.recip(), -self.value.powi(-2))
    }

    fn powi(self, exponent: i32) -> Self {
        self.chain(
            self.value.powi(exponent),
            f64::from(exponent) * self.value.powi(exponent - 1),
        )
    }

    fn abs(self) -> Self {
        self.chain(self.value.abs(), self.value.signum())
    }

    fn exp(self) -> Self {
        self.chain(self.value.exp(), self.value.exp())
    }

    fn ln(self) -> Self {
        self.chain(self.value.ln(), self.value.recip())
    }

    fn sin(self) -> Self {
        self.chain(self.value.sin(), self.value.cos())
    }

    fn cos(self) -> Self {
        self.chain(self.value.cos(), -self.value.sin())
    }

    fn tan(self) -> Self {
        self.sin() / self.cos()
    }

    fn asin(self) -> Self {
        self.chain(
            self.value.asin(),
            (1.0 - self.value * self.value).sqrt().recip(),
        )
    }

    fn acos(self) -> Self {
        self.chain(
            self.value.acos(),
            -(1.0 - self.value * self.value).sqrt().recip(),
        )
    }

    fn atan(self) -> Self {
        self.chain(self.value.atan(), (1.0 + self.value * self.value).recip())
    }

    fn sinh(self) -> Self {
        self.chain(self.value.sinh(), self.value.cosh())
    }

    fn cosh(self) -> Self {
        self.chain(self.value.cosh(), self.value.sinh())
    }

    fn tanh(self) -> Self {
        self.sinh() / self.cosh()
    }
}
