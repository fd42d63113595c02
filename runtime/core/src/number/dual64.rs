//! Dual numbers of `num_dual` as scalars.

use num_dual::{Dual64, DualNum};

use crate::number::Scalar;

macro_rules! forward {
    ($($function:ident)*) => {
        $(
            #[inline]
            fn $function(self) -> Self {
                DualNum::$function(&self)
            }
        )*
    };
}

/// A dual number: a value and its derivative.
impl Scalar for Dual64 {
    const EPSILON: f64 = f64::EPSILON;

    #[inline]
    fn from_f64(value: f64) -> Self {
        Self::new(value, 0.0)
    }

    #[inline]
    fn magnitude(self) -> f64 {
        let (value, derivative) = (self.re.abs(), self.eps.abs());
        if value >= derivative || value.is_nan() {
            value
        } else {
            derivative
        }
    }

    #[inline]
    fn abs(self) -> Self {
        if self.re.is_sign_negative() {
            -self
        } else {
            self
        }
    }

    #[inline]
    fn sign(self) -> Self {
        Self::from_f64(self.re.signum())
    }

    #[inline]
    fn or_zero(self, base: Self) -> Self {
        Self::new(self.re.or_zero(base.re), self.eps.or_zero(base.re))
    }

    #[inline]
    fn atan2(self, x: Self) -> Self {
        DualNum::atan2(&self, x)
    }

    forward! { sqrt recip exp ln sin cos tan asin acos atan sinh cosh tanh }
}
