//! Fixed-point real and complex numbers, for computations that need no proof.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

/// Number of binary places.
const PLACES: u32 = 320;

/// Binary places that are free of errors: smaller numbers count as zero.
const SURE_PLACES: u32 = 150;

/// A real number in units of 2^−320; operations round by about a unit.
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

    /// An integer.
    pub fn integer(value: i64) -> Self {
        Fixed(BigInt::from(value) << PLACES)
    }

    /// A rational number, truncated towards zero.
    pub fn new(value: &BigRational) -> Self {
        Fixed((value.numer() << PLACES) / value.denom())
    }

    /// The value as a rational number; 0 if it [`vanishes`](Self::vanishes).
    pub fn rational(&self) -> BigRational {
        if self.vanishes() {
            return BigRational::zero();
        }
        // Only powers of two can cancel; no greatest common divisor is needed.
        let twos = self.0.trailing_zeros().unwrap_or(0).min(PLACES.into());
        let denominator = BigInt::from(1) << (u64::from(PLACES) - twos);
        BigRational::new_raw(&self.0 >> twos, denominator)
    }

    /// Whether it counts as zero.
    pub fn vanishes(&self) -> bool {
        self.is_below(SURE_PLACES)
    }

    /// Whether its absolute value is below 2 to the power of −`places`.
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

    /// x / y; zero if y is zero.
    pub fn divide(&self, other: &Self) -> Self {
        if other.0.is_zero() {
            return Self::zero();
        }
        Fixed((&self.0 << PLACES) / &other.0)
    }
}

/// A complex number with [`Fixed`] parts.
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

    /// z / w; zero if w is zero.
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
