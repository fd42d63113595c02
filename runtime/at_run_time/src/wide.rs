//! Numbers of about 104 bits, as unevaluated sums of two doubles (Dekker, Numer. Math. 18, 1971).

use core::ops::{Add, Div, Mul, Neg, Sub};

/// `high + low`, where `high` is the sum rounded to a double.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wide {
    pub high: f64,
    pub low: f64,
}

/// Half of π as three doubles.
const HALF_PI: [f64; 3] = [
    core::f64::consts::FRAC_PI_2,
    6.123_233_995_736_766e-17,
    -1.497_384_904_859_169_8e-33,
];

impl Wide {
    pub const ZERO: Self = Self::of(0.0);
    pub const ONE: Self = Self::of(1.0);

    pub const fn of(high: f64) -> Self {
        Self { high, low: 0.0 }
    }

    pub const fn pair([high, low]: [f64; 2]) -> Self {
        Self { high, low }
    }

    /// The nearest double.
    pub fn double(self) -> f64 {
        self.high + self.low
    }

    pub fn absolute(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The sum of two doubles, exactly.
    fn sum(x: f64, y: f64) -> Self {
        let high = x + y;
        let part = high - x;
        let low = (x - (high - part)) + (y - part);
        Self { high, low }
    }

    /// The product of two doubles, exactly.
    fn product(x: f64, y: f64) -> Self {
        let ((a, b), (c, d)) = (halves(x), halves(y));
        let high = x * y;
        let low = ((a * c - high) + a * d + b * c) + b * d;
        Self { high, low }
    }

    pub fn power(self, exponent: u32) -> Self {
        (0..exponent).fold(Self::ONE, |product, _| product * self)
    }

    /// `(sin, cos)` of an angle of moderate size.
    pub fn sine_cosine(self) -> (Self, Self) {
        // The nearest multiple of π/2.
        let quarters = self.high / HALF_PI[0];
        let turns = (quarters + if quarters < 0.0 { -0.5 } else { 0.5 }) as i64;
        let rest = HALF_PI
            .iter()
            .fold(self, |rest, &part| rest - Self::product(turns as f64, part));
        let (sine, cosine) = rest.small_sine_cosine();
        match turns.rem_euclid(4) {
            0 => (sine, cosine),
            1 => (cosine, -sine),
            2 => (-sine, -cosine),
            _ => (-cosine, sine),
        }
    }

    /// Taylor's series for |x| ≤ π/4, whose last term is below 2⁻¹¹⁰.
    fn small_sine_cosine(self) -> (Self, Self) {
        const TERMS: u32 = 30;
        let (mut sine, mut cosine) = (Self::ZERO, Self::ZERO);
        let mut term = Self::ONE;
        for n in 0..TERMS {
            let signed = if n % 4 < 2 { term } else { -term };
            if n % 2 == 0 {
                cosine = cosine + signed;
            } else {
                sine = sine + signed;
            }
            term = term * self / Self::of(f64::from(n + 1));
        }
        (sine, cosine)
    }
}

/// A double as the sum of two numbers of at most 26 bits (Veltkamp).
fn halves(x: f64) -> (f64, f64) {
    let scaled = 134_217_729.0 * x;
    let high = scaled - (scaled - x);
    (high, x - high)
}

impl Add for Wide {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, low) = (
            Self::sum(self.high, other.high),
            Self::sum(self.low, other.low),
        );
        let first = Self::sum(high.high, high.low + low.high);
        Self::sum(first.high, first.low + low.low)
    }
}

impl Neg for Wide {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Sub for Wide {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Wide {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let rest = self.high * other.low + self.low * other.high;
        Self::sum(product.high, product.low + rest)
    }
}

impl Div for Wide {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::of(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::of(second);
        Self::sum(first, second) + Self::of(rest.high / other.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums and products whose low parts are known: (1 + 2⁻⁵²)² and 1/3, which has the bits 01 again and again.
    #[test]
    fn operations_keep_what_a_double_loses() {
        let x = Wide::of(1.0 + f64::EPSILON);
        let square = x * x - Wide::ONE - Wide::of(2.0 * f64::EPSILON);
        assert_eq!(square.double(), f64::EPSILON * f64::EPSILON);
        let third = Wide::ONE / Wide::of(3.0);
        assert_eq!(third.high, 1.0 / 3.0);
        let rest = Wide::ONE - third * Wide::of(3.0);
        assert!(rest.double().abs() < 1e-31, "{rest:?}");
    }

    /// sin 1 and cos 100 to 32 digits, by mpmath.
    #[test]
    fn sines_and_cosines_have_thirty_digits() {
        let (sine, _) = Wide::ONE.sine_cosine();
        let error = sine - Wide::pair([0.841_470_984_807_896_5, 1.776_845_092_935_536e-18]);
        assert!(error.double().abs() < 1e-30, "{sine:?}");
        for angle in [-3.0, -0.5, 0.25, 2.0, 7.0, 100.0] {
            let (s, c) = Wide::of(angle).sine_cosine();
            let one = s * s + c * c - Wide::ONE;
            assert!(one.double().abs() < 1e-31, "{angle}: {one:?}");
            // sin 2x = 2 sin x cos x
            let (double, _) = Wide::of(2.0 * angle).sine_cosine();
            let difference = double - Wide::of(2.0) * s * c;
            assert!(difference.double().abs() < 1e-29, "{angle}: {difference:?}");
        }
    }
}
