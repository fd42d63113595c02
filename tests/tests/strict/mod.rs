//! A scalar that counts its products and does not put up with a zero in one.

use std::cell::Cell;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use symplectic::Scalar;
use symplectic::num_traits::{One, Zero};

thread_local! {
    static PRODUCTS: Cell<u64> = const { Cell::new(0) };
}

/// Products in this thread so far.
pub fn products() -> u64 {
    PRODUCTS.get()
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strict(pub f64);

impl Mul for Strict {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        assert!(self.0 != 0.0 && other.0 != 0.0, "a product with zero");
        PRODUCTS.set(PRODUCTS.get() + 1);
        Self(self.0 * other.0)
    }
}

macro_rules! operators {
    ($($operator:ident $function:ident $sign:tt;)*) => {
        $(impl $operator for Strict {
            type Output = Self;

            fn $function(self, other: Self) -> Self {
                Self(self.0 $sign other.0)
            }
        })*
    };
}

operators! { Add add +; Sub sub -; Div div /; }

macro_rules! assignments {
    ($($operator:ident $function:ident $sign:tt;)*) => {
        $(impl $operator for Strict {
            fn $function(&mut self, other: Self) {
                *self = *self $sign other;
            }
        })*
    };
}

assignments! { AddAssign add_assign +; SubAssign sub_assign -; MulAssign mul_assign *; DivAssign div_assign /; }

impl Neg for Strict {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Zero for Strict {
    fn zero() -> Self {
        Self(0.0)
    }

    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl One for Strict {
    fn one() -> Self {
        Self(1.0)
    }
}

macro_rules! functions {
    ($($function:ident)*) => {
        $(fn $function(self) -> Self {
            Self(self.0.$function())
        })*
    };
}

impl Scalar for Strict {
    const EPSILON: f64 = f64::EPSILON;

    fn from_f64(value: f64) -> Self {
        Self(value)
    }

    fn magnitude(self) -> f64 {
        self.0.abs()
    }

    fn powi(self, exponent: i32) -> Self {
        Self(self.0.powi(exponent))
    }

    functions! { sqrt recip abs exp ln sin cos tan asin acos atan sinh cosh tanh }
}
