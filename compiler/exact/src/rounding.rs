//! Correct rounding of rationals to doubles, to singles and to decimals, ties to even.

use std::fmt;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// The double nearest to a rational, ties to even; infinite on overflow.
pub fn to_f64(value: &BigRational) -> f64 {
    DOUBLE.nearest(value)
}

/// The single nearest to a rational, ties to even; infinite on overflow.
///
/// Rounding via a double would be wrong: the double may be a midpoint of two singles although the rational is not.
pub fn to_f32(value: &BigRational) -> f32 {
    // The argument is a single, 2¹²⁸ or infinite; the latter two become infinite.
    SINGLE.nearest(value) as f32
}

/// A binary format: numbers mantissa·2^exponent.
struct Format {
    /// Binary digits of the mantissa.
    digits: i64,
    /// The exponent of the subnormals.
    least: i64,
    /// The exponent of the largest number, whose mantissa is 2^digits − 1.
    most: i64,
}

const DOUBLE: Format = Format {
    digits: 53,
    least: -1074,
    most: 971,
};

const SINGLE: Format = Format {
    digits: 24,
    least: -149,
    most: 104,
};

impl Format {
    /// The nearest number of the format, ties to even. If the result exceeds the largest number by rounding up, it is
    /// the next power of two, which for doubles is infinite. Larger numbers are infinite.
    fn nearest(&self, value: &BigRational) -> f64 {
        if value.is_zero() {
            return 0.0;
        }
        let (numerator, denominator) = (value.numer().abs(), value.denom());
        // value ≈ mantissa·2^exponent with a mantissa of full length, or with the least exponent for subnormals.
        let scaled = |exponent: i64| {
            if exponent >= 0 {
                numerator.div_rem(&(denominator << exponent))
            } else {
                (&numerator << -exponent).div_rem(denominator)
            }
        };
        let lengths = numerator.bits() as i64 - denominator.bits() as i64;
        let mut exponent = (lengths - self.digits).max(self.least);
        let (mut mantissa, mut remainder) = scaled(exponent);
        if mantissa.bits() as i64 > self.digits {
            exponent += 1;
            (mantissa, remainder) = scaled(exponent);
        }
        let unit = if exponent > 0 {
            denominator << exponent
        } else {
            denominator.clone()
        };
        if rounds_up(&mantissa, &remainder, &unit) {
            mantissa += 1;
        }
        let size = if exponent > self.most {
            f64::INFINITY
        } else {
            // Both factors and the product are doubles, so this is exact (or overflows to infinity).
            mantissa.to_u64().unwrap_or(u64::MAX) as f64 * power_of_two(exponent)
        };
        if value.is_negative() { -size } else { size }
    }
}

fn power_of_two(exponent: i64) -> f64 {
    match exponent {
        -1074..-1022 => f64::from_bits(1 << (exponent + 1074)),
        _ => f64::from_bits(((exponent + 1023) as u64) << 52),
    }
}

/// Whether `quotient + remainder/unit` rounds to `quotient + 1`.
fn rounds_up(quotient: &BigInt, remainder: &BigInt, unit: &BigInt) -> bool {
    match (remainder << 1u32).cmp(unit) {
        std::cmp::Ordering::Less => false,
        std::cmp::Ordering::Equal => quotient.is_odd(),
        std::cmp::Ordering::Greater => true,
    }
}

/// The shortest decimal that parses to the double: `0.25`, `1e-20`.
pub fn shortest(value: f64) -> String {
    without_fraction(format!("{value:?}"))
}

/// The shortest decimal that parses to the single.
pub fn shortest_single(value: f32) -> String {
    without_fraction(format!("{value:?}"))
}

fn without_fraction(text: String) -> String {
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// A number rounded to a number of significant decimal digits: `±digits·10^exponent`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decimal {
    /// Signed; zero, or with exactly the requested number of digits.
    digits: BigInt,
    exponent: i64,
}

impl Decimal {
    /// Rounds a rational to `digits ≥ 1` significant digits, ties to even.
    pub fn round(value: &BigRational, digits: usize) -> Self {
        if value.is_zero() {
            return Decimal {
                digits: BigInt::zero(),
                exponent: 0,
            };
        }
        let digits = digits.max(1);
        let (numerator, denominator) = (value.numer().abs(), value.denom());
        let ten = |power: i64| BigInt::from(10u32).pow(power.unsigned_abs() as u32);
        // 10^place ≤ |value| < 10^(place + 1): estimated from the binary lengths, then corrected exactly.
        let mut place = ((numerator.bits() as f64 - denominator.bits() as f64)
            * std::f64::consts::LOG10_2)
            .floor() as i64;
        let at_least = |place: i64| {
            if place >= 0 {
                numerator >= denominator * ten(place)
            } else {
                &numerator * ten(place) >= *denominator
            }
        };
        while !at_least(place) {
            place -= 1;
        }
        while at_least(place + 1) {
            place += 1;
        }
        let mut exponent = place + 1 - digits as i64;
        let (quotient, remainder, unit) = if exponent >= 0 {
            let unit = denominator * ten(exponent);
            let (q, r) = numerator.div_rem(&unit);
            (q, r, unit)
        } else {
            let (q, r) = (&numerator * ten(exponent)).div_rem(denominator);
            (q, r, denominator.clone())
        };
        let mut rounded = if rounds_up(&quotient, &remainder, &unit) {
            quotient + 1
        } else {
            quotient
        };
        if rounded == ten(digits as i64) {
            rounded /= 10;
            exponent += 1;
        }
        Decimal {
            digits: if value.is_negative() {
                -rounded
            } else {
                rounded
            },
            exponent,
        }
    }

    /// The exact value of the decimal.
    pub fn value(&self) -> BigRational {
        let ten = BigInt::from(10u32).pow(self.exponent.unsigned_abs() as u32);
        if self.exponent >= 0 {
            BigRational::from_integer(&self.digits * ten)
        } else {
            BigRational::new(self.digits.clone(), ten)
        }
    }
}

impl fmt::Display for Decimal {
    /// All digits, in positional notation down to 10⁻⁶, otherwise in scientific notation.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.digits.is_zero() {
            return f.write_str("0");
        }
        let digits = self.digits.abs().to_string();
        let count = digits.len() as i64;
        if self.digits.is_negative() {
            f.write_str("-")?;
        }
        // Number of digits before the decimal point.
        let point = count + self.exponent;
        match point {
            _ if point > 0 && point < count => {
                let (whole, fraction) = digits.split_at(point as usize);
                write!(f, "{whole}.{fraction}")
            }
            _ if point == count => f.write_str(&digits),
            -5..=0 => write!(f, "0.{}{digits}", "0".repeat(point.unsigned_abs() as usize)),
            _ => {
                let (first, rest) = digits.split_at(1);
                let dot = if rest.is_empty() { "" } else { "." };
                write!(f, "{first}{dot}{rest}e{}", point - 1)
            }
        }
    }
}

/// The exact value of a finite double; 2¹⁰²⁴ for infinities and NaN.
pub fn exact(value: f64) -> BigRational {
    BigRational::from_float(value)
        .unwrap_or_else(|| BigRational::from_integer(BigInt::one() << 1024u32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;
    use proptest::prelude::*;

    proptest! {
        /// An independent check: the standard library parses decimals with correct rounding.
        #[test]
        fn doubles_agree_with_the_decimal_reader(n in any::<i64>(), scale in -330i64..320) {
            let ten = BigInt::from(10).pow(scale.unsigned_abs() as u32);
            let n = BigInt::from(n);
            let value = if scale < 0 { BigRational::new(n.clone(), ten) } else { BigRational::from_integer(&n * ten) };
            let read: f64 = format!("{n}e{scale}").parse().expect("a decimal");
            prop_assert_eq!(to_f64(&value).abs().to_bits(), read.abs().to_bits());
        }

        /// The same for singles, which the standard library parses without an intermediate double. Short numerators
        /// produce near ties, where an intermediate double would be a midpoint of two singles.
        #[test]
        fn singles_agree_with_the_decimal_reader(n in any::<i64>(), short in 0u32..40, scale in -65i64..40) {
            let n = BigInt::from(n >> short);
            let ten = BigInt::from(10).pow(scale.unsigned_abs() as u32);
            let value = if scale < 0 { BigRational::new(n.clone(), ten) } else { BigRational::from_integer(&n * ten) };
            let read: f32 = format!("{n}e{scale}").parse().expect("a decimal");
            prop_assert_eq!(to_f32(&value).abs().to_bits(), read.abs().to_bits());
            prop_assert!(value.is_zero() || to_f32(&value).is_sign_negative() == value.is_negative());
        }

        #[test]
        fn single_ties_go_to_even_and_neighbours_do_not(bits in 0u32..0x7f7f_ffff) {
            let (low, high) = (f32::from_bits(bits), f32::from_bits(bits + 1));
            let middle = (exact(low.into()) + exact(high.into())) / ratio(2, 1);
            let even = if bits % 2 == 0 { low } else { high };
            prop_assert_eq!(to_f32(&middle), even);
            // Closer to the midpoint than doubles resolve: double rounding would treat both as ties.
            let nudge = &middle / BigRational::from_integer(BigInt::one() << 200u32);
            prop_assert_eq!(to_f32(&(&middle - &nudge)), low);
            prop_assert_eq!(to_f32(&(&middle + &nudge)), high);
        }

        #[test]
        fn ties_go_to_even_and_neighbours_do_not(bits in 1u64..0x7fe0_0000_0000_0000) {
            let (low, high) = (f64::from_bits(bits), f64::from_bits(bits + 1));
            let middle = (exact(low) + exact(high)) / ratio(2, 1);
            let even = if bits % 2 == 0 { low } else { high };
            prop_assert_eq!(to_f64(&middle), even);
            let nudge = &middle / BigRational::from_integer(BigInt::one() << 200u32);
            prop_assert_eq!(to_f64(&(&middle - &nudge)), low);
            prop_assert_eq!(to_f64(&(&middle + &nudge)), high);
        }

        #[test]
        fn decimals_are_within_half_a_unit(n in -5000i64..5000, d in 1i64..5000, digits in 1usize..30) {
            prop_assume!(n != 0);
            let value = ratio(n, d);
            let rounded = Decimal::round(&value, digits);
            let unit = BigRational::from_integer(10.into()).pow(rounded.exponent as i32);
            prop_assert!((rounded.value() - &value).abs() * ratio(2, 1) <= unit);
            prop_assert_eq!(rounded.digits.abs().to_string().len(), digits);
            let printed: f64 = rounded.to_string().parse().expect("a decimal");
            prop_assert_eq!(printed, to_f64(&rounded.value()));
        }
    }

    #[test]
    fn decimal_ties_and_carries() {
        assert_eq!(Decimal::round(&ratio(25, 100), 1).to_string(), "0.2");
        assert_eq!(Decimal::round(&ratio(35, 100), 1).to_string(), "0.4");
        assert_eq!(Decimal::round(&ratio(-9996, 1000), 3).to_string(), "-10.0");
        assert_eq!(Decimal::round(&ratio(1, 3), 5).to_string(), "0.33333");
        assert_eq!(Decimal::round(&ratio(1, 30000), 3).to_string(), "0.0000333");
        assert_eq!(
            Decimal::round(&ratio(1, 30_000_000), 3).to_string(),
            "3.33e-8"
        );
        assert_eq!(Decimal::round(&ratio(1234, 1), 4).to_string(), "1234");
        assert_eq!(Decimal::round(&ratio(123456, 1), 2).to_string(), "1.2e5");
    }

    #[test]
    fn shortest_decimals_read_back() {
        for value in [0.25, 1.0, -1e-20, 5e-324, f64::MAX, 0.1 + 0.2] {
            assert_eq!(shortest(value).parse::<f64>(), Ok(value));
        }
        assert_eq!(shortest(1.0), "1");
        assert_eq!(shortest(0.0), "0");
    }

    #[test]
    fn values_beyond_the_range_round_to_infinity_or_zero() {
        assert_eq!(to_f64(&(exact(f64::MAX) * ratio(2, 1))), f64::INFINITY);
        assert_eq!(to_f64(&(exact(5e-324) / ratio(2, 1))), 0.0);
        assert_eq!(to_f64(&(exact(5e-324) * ratio(3, 4))), 5e-324);
        let largest = exact(f32::MAX.into());
        assert_eq!(to_f32(&largest), f32::MAX);
        // The midpoint between it and 2^128 is a tie, and 2^128 is even.
        let beyond = &largest + exact(2f64.powi(103));
        assert_eq!(to_f32(&beyond), f32::INFINITY);
        assert_eq!(to_f32(&-(&beyond)), f32::NEG_INFINITY);
        assert_eq!(to_f32(&(&beyond - ratio(1, 1000))), f32::MAX);
        assert_eq!(to_f32(&exact(f64::MAX)), f32::INFINITY);
        let least = exact(1e-45_f32.into());
        assert_eq!(to_f32(&(&least / ratio(2, 1))), 0.0);
        assert_eq!(to_f32(&(&least * ratio(3, 4))), 1e-45);
    }
}
