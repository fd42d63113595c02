//! Complex numbers with a fixed number of binary places, for what needs no proof.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

/// Binary places.
const PLACES: u32 = 320;

/// Binary places that errors leave alone: what vanishes to them is taken for zero.
const SURE_PLACES: u32 = 150;

/// A real number in units of 2^−320, with rounding errors of some of them.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fixed(BigInt);

impl Fixed {
    /// 0
    pub fn zero() -> Self {
        Fixed(BigInt::zero())
    }

    /// 1
    pub fn one() -> Self {
        Self::integer(1)
    }

    /// A whole number.
    pub fn integer(value: i64) -> Self {
        Fixed(BigInt::from(value) << PLACES)
    }

    /// The nearest one below a rational number.
    pub fn new(value: &BigRational) -> Self {
        Fixed((value.numer() << PLACES) / value.denom())
    }

    /// As a rational number; what is taken for zero is zero.
    pub fn rational(&self) -> BigRational {
        if self.vanishes() {
            return BigRational::zero();
        }
        // The fraction is in lowest terms without its powers of two, and there is no divisor to look for.
        let twos = self.0.trailing_zeros().unwrap_or(0).min(PLACES.into());
        let denominator = BigInt::from(1) << (u64::from(PLACES) - twos);
        BigRational::new_raw(&self.0 >> twos, denominator)
    }

    /// Whether it is taken for zero.
    pub fn vanishes(&self) -> bool {
        self.is_below(SURE_PLACES)
    }

    /// Whether it is below 2 to the power of −`places`.
    pub fn is_below(&self, places: u32) -> bool {
        self.0.bits() <= u64::from(PLACES.saturating_sub(places))
    }

    /// The absolute value.
    pub fn abs(&self) -> Self {
        Fixed(self.0.abs())
    }

    /// −x
    pub fn negate(&self) -> Self {
        Fixed(-&self.0)
    }

    /// x + y
    pub fn add(&self, other: &Self) -> Self {
        Fixed(&self.0 + &other.0)
    }

    /// x − y
    pub fn subtract(&self, other: &Self) -> Self {
        Fixed(&self.0 - &other.0)
    }

    /// x y
    pub fn multiply(&self, other: &Self) -> Self {
        Fixed((&self.0 * &other.0) >> PLACES)
    }

    /// x / y; zero where y is zero.
    pub fn divide(&self, other: &Self) -> Self {
        if other.0.is_zero() {
            return Self::zero();
        }
        Fixed((&self.0 << PLACES) / &other.0)
    }
}

/// A complex number of two [`Fixed`] parts.
#[derive(Debug, Clone, PartialEq)]
pub struct Complex {
    /// Real part.
    pub re: Fixed,
    /// Imaginary part.
    pub im: Fixed,
}

impl Complex {
    /// A real number.
    pub fn real(re: Fixed) -> Self {
        Complex {
            re,
            im: Fixed::zero(),
        }
    }

    /// |Re| + |Im|
    pub fn size(&self) -> Fixed {
        self.re.abs().add(&self.im.abs())
    }

    /// z + w
    pub fn add(&self, other: &Self) -> Self {
        Complex {
            re: self.re.add(&other.re),
            im: self.im.add(&other.im),
        }
    }

    /// z − w
    pub fn subtract(&self, other: &Self) -> Self {
        Complex {
            re: self.re.subtract(&other.re),
            im: self.im.subtract(&other.im),
        }
    }

    /// z w
    pub fn multiply(&self, other: &Self) -> Self {
        let product = |a: &Fixed, b: &Fixed| a.multiply(b);
        Complex {
            re: product(&self.re, &other.re).subtract(&product(&self.im, &other.im)),
            im: product(&self.re, &other.im).add(&product(&self.im, &other.re)),
        }
    }

    /// z / w; zero where w is zero.
    pub fn divide(&self, other: &Self) -> Self {
        let conjugate = Complex {
            re: other.re.clone(),
            im: other.im.negate(),
        };
        let numerator = self.multiply(&conjugate);
        let denominator = other.multiply(&conjugate).re;
        Complex {
            re: numerator.re.divide(&denominator),
            im: numerator.im.divide(&denominator),
        }
    }
}
