//! Scalars that count their operations.

use std::cell::Cell;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use symplectic::Scalar;
use symplectic::num_traits::{One, Zero};

thread_local! {
    static OPERATIONS: Cell<u64> = const { Cell::new(0) };
}

/// A double whose operations are counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counted(pub f64);

/// The number of operations of a function on this thread.
pub fn operations(function: impl FnOnce()) -> u64 {
    let before = OPERATIONS.get();
    function();
    OPERATIONS.get() - before
}

fn count(value: f64) -> Counted {
    OPERATIONS.set(OPERATIONS.get() + 1);
    Counted(value)
}

macro_rules! operators {
    ($($name:ident $method:ident, $assign:ident $assign_method:ident;)*) => {
        $(
            impl $name for Counted {
                type Output = Self;

                fn $method(self, other: Self) -> Self {
                    count(self.0.$method(other.0))
                }
            }

            impl $assign for Counted {
                fn $assign_method(&mut self, other: Self) {
                    *self = self.$method(other);
                }
            }
        )*
    };
}

operators! {
    Add add, AddAssign add_assign;
    Sub sub, SubAssign sub_assign;
    Mul mul, MulAssign mul_assign;
    Div div, DivAssign div_assign;
}

impl Neg for Counted {
    type Output = Self;

    fn neg(self) -> Self {
        count(-self.0)
    }
}

impl Zero for Counted {
    fn zero() -> Self {
        Self(0.0)
    }

    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl One for Counted {
    fn one() -> Self {
        Self(1.0)
    }
}

macro_rules! functions {
    ($($name:ident)*) => {
        $(
            fn $name(self) -> Self {
                count(Scalar::$name(self.0))
            }
        )*
    };
}

impl Scalar for Counted {
    const EPSILON: f64 = f64::EPSILON;

    fn from_f64(value: f64) -> Self {
        Self(value)
    }

    fn magnitude(self) -> f64 {
        self.0.abs()
    }

    functions! { abs sqrt recip exp ln sin cos tan asin acos atan sinh cosh tanh }
}
