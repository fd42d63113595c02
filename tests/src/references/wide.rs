//! A [`Scalar`] with 237 bits, 71 digits: `f256` of the crate of that name.

use std::fmt;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use f256::f256;
use symplectic::Scalar;
use symplectic::num_traits::{One, Zero};

/// A number with 237 bits.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Wide(f256);

impl Wide {
    /// The number nearest to a decimal; `None` if the text is not a decimal.
    pub fn parse(decimal: &str) -> Option<Self> {
        decimal.parse().ok().map(Self)
    }

    /// `self·factor + summand`, rounded once.
    pub fn mul_add(self, factor: Self, summand: Self) -> Self {
        Self(self.0.mul_add(factor.0, summand.0))
    }

    /// The nearest double, or a neighbour of it.
    pub fn to_f64(self) -> f64 {
        // The crate converts to text only. Rounding via 40 digits is correct except near ties.
        format!("{:.40e}", self.0).parse().unwrap_or(f64::NAN)
    }
}

impl fmt::Display for Wide {
    /// 30 significant digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.29e}", self.0)
    }
}

macro_rules! operators {
    ($($operator:ident $function:ident $assign:ident $assigning:ident)*) => {
        $(
            impl $operator for Wide {
                type Output = Self;

                fn $function(self, other: Self) -> Self {
                    Self(self.0.$function(other.0))
                }
            }

            impl $assign for Wide {
                fn $assigning(&mut self, other: Self) {
                    *self = self.$function(other);
                }
            }
        )*
    };
}

operators! {
    Add add AddAssign add_assign
    Sub sub SubAssign sub_assign
    Mul mul MulAssign mul_assign
    Div div DivAssign div_assign
}

impl Neg for Wide {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Zero for Wide {
    fn zero() -> Self {
        Self(f256::ZERO)
    }

    fn is_zero(&self) -> bool {
        self.0 == f256::ZERO
    }
}

impl One for Wide {
    fn one() -> Self {
        Self(f256::ONE)
    }
}

macro_rules! forward {
    ($($function:ident)*) => {
        $(
            fn $function(self) -> Self {
                Self(self.0.$function())
            }
        )*
    };
}

impl Scalar for Wide {
    /// 2⁻²³⁶
    const EPSILON: f64 = 9.055_679_078_826_712e-72;

    fn from_f64(value: f64) -> Self {
        Self(f256::from(value))
    }

    fn magnitude(self) -> f64 {
        self.abs().to_f64()
    }

    forward! { sqrt recip abs exp ln sin cos tan asin acos atan }

    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.0.sin_cos();
        (Self(sine), Self(cosine))
    }

    fn sinh(self) -> Self {
        let growth = self.exp();
        (growth - growth.recip()) * Self::from_f64(0.5)
    }

    fn cosh(self) -> Self {
        let growth = self.exp();
        (growth + growth.recip()) * Self::from_f64(0.5)
    }

    fn tanh(self) -> Self {
        self.sinh() / self.cosh()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of mpmath 1.3 with 60 digits at the double 0.7, for the functions that the scenes use.
    #[test]
    fn functions_have_their_digits() {
        let x = Wide::from_f64(0.7);
        for (found, digits) in [
            (
                x.sqrt(),
                "0.8366600265340755214387655903101847364813919672324875592129",
            ),
            (
                x.recip(),
                "1.428571428571428662059022418380131498582943904001770831649",
            ),
            (
                x.exp(),
                "2.013752707470476432195964519184246838532090514047043712314",
            ),
            (
                x.ln(),
                "-0.3566749439387324423539544041072745145718090708994979507824",
            ),
            (
                x.sin(),
                "0.6442176872376910197067980902825121612742878370285401540431",
            ),
            (
                x.cos(),
                "0.7648421872844884548648723598739629158509581390674649115142",
            ),
            (
                x.tan(),
                "0.8422883804630793722133176426063604267307690979536796234095",
            ),
            (
                x.asin(),
                "0.7753974966107530015554257442371730995077594174483078430624",
            ),
            (
                x.acos(),
                "0.795398830184143617675895947402578342590825282239245067425",
            ),
            (
                x.atan(),
                "0.6107259643892085867391139201101941183421589577627363117207",
            ),
            (
                x.sinh(),
                "0.7585837018395334477191734536993409499489271756983642954736",
            ),
            (
                x.cosh(),
                "1.25516900563094298447679106548490588858316333834867941684",
            ),
            (
                x.tanh(),
                "0.604367777117163468120586885517550279877154938292554943306",
            ),
        ] {
            let expected = Wide::parse(digits).expect("a decimal");
            assert!(
                ((found - expected) / expected).abs() < Wide::from_f64(1e-54),
                "{found} {digits}"
            );
        }
        assert!(Wide::parse("one").is_none());
    }

    #[test]
    fn numbers_become_doubles_and_digits() {
        for value in [0.0, -1.5, 1.0 / 3.0, 1e-300, -6.02e23] {
            assert_eq!(Wide::from_f64(value).to_f64(), value);
        }
        let third = Wide::one() / Wide::from_f64(3.0);
        assert_eq!(third.to_f64(), 1.0 / 3.0);
        assert_eq!(third.to_string(), "3.33333333333333333333333333333e-1");
        assert!(third.mul_add(Wide::from_f64(3.0), -Wide::one()).magnitude() <= Wide::EPSILON);
        // The rounding error of the third; a separately rounded product would hide it.
        assert!(!third.mul_add(Wide::from_f64(3.0), -Wide::one()).is_zero());
    }
}
