//! Coefficients as papers print them: decimals and fractions, and what can be inferred from their digits.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::CertifyError;
use crate::arithmetic::rational::{ratio, simplest_between};

/// The largest number of characters of a printed number, the largest magnitude of its exponent, and the largest number
/// of digits that are computed.
pub const MAX_DIGITS: usize = 10_000;

/// Decimals with at most this many significant digits are assumed to be exact: `0.28`, `-0.5`, `0.1867`.
const EXACT_DIGITS: u64 = 6;

/// A number as it is printed: a decimal such as `-0.045454545454545454545` or `1e-3`, or a fraction of two
/// decimals such as `-1/24` or `7.0 / 24.0`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Printed {
    text: String,
    value: BigRational,
    /// The decimal places; `None` for a fraction or an integer, which is exact.
    places: Option<u32>,
}

impl Printed {
    /// Reads a printed number.
    ///
    /// ```
    /// use symplectic_compiler::certify::Printed;
    ///
    /// let printed = Printed::parse("0.54545454545454545455")?;
    /// assert_eq!(printed.places(), Some(20));
    /// assert_eq!(printed.simple().map(|x| x.to_string()).as_deref(), Some("6/11"));
    /// # Ok::<(), symplectic_compiler::certify::CertifyError>(())
    /// ```
    ///
    /// # Errors
    /// [`CertifyError::NotANumber`] if the text is not a decimal or a fraction of two, or is longer than
    /// [`MAX_DIGITS`].
    pub fn parse(text: &str) -> Result<Self, CertifyError> {
        let wrong = || CertifyError::NotANumber {
            text: text.chars().take(40).collect(),
        };
        if text.len() > MAX_DIGITS {
            return Err(wrong());
        }
        let (value, places) = match text.split_once('/') {
            None => {
                let text = text.trim();
                let (value, places) = decimal(text).ok_or_else(wrong)?;
                let integer = !text.contains(['.', 'e', 'E']);
                (value, (!integer).then_some(places))
            }
            Some((above, below)) => {
                let (above, _) = decimal(above.trim()).ok_or_else(wrong)?;
                let (below, _) = decimal(below.trim()).ok_or_else(wrong)?;
                if below.is_zero() {
                    return Err(wrong());
                }
                (above / below, None)
            }
        };
        Ok(Printed {
            text: text.to_owned(),
            value,
            places,
        })
    }

    /// The number 0.
    pub(crate) fn zero() -> Self {
        Printed {
            text: "0".to_owned(),
            value: BigRational::zero(),
            places: None,
        }
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The exact value of the text.
    pub fn value(&self) -> &BigRational {
        &self.value
    }

    /// The number of decimal places; `None` for a fraction or an integer, which is exact.
    pub fn places(&self) -> Option<u32> {
        self.places
    }

    /// Half a unit of the last decimal place: the largest distance of a number from a print that rounds it. Zero for a fraction
    /// or an integer, and for a printed zero, which means that the step is left out.
    pub fn half_unit(&self) -> BigRational {
        match self.places {
            Some(places) if !self.value.is_zero() => {
                BigRational::new(BigInt::one(), power_of_ten(places) * 2u32)
            }
            _ => BigRational::zero(),
        }
    }

    /// The number of digits from the first nonzero one to the last decimal place; 20 for a fraction or an integer.
    pub fn significant_digits(&self) -> usize {
        const OF_FRACTIONS: usize = 20;
        let digits = self.places.map(|places| {
            let scaled = &self.value * BigRational::from_integer(power_of_ten(places));
            decimal_length(&scaled.to_integer())
        });
        digits.map_or(OF_FRACTIONS, |digits| {
            usize::try_from(digits).unwrap_or(1).max(1)
        })
    }

    /// The exact number that the digits seem to represent, if it is simple: a fraction, a decimal with few digits, or the
    /// fraction that a long decimal rounds.
    ///
    /// A decimal with `D` significant digits is taken for `a/b` if `|a|·b ≤ 10^(D/2)`, which happens by chance
    /// with a probability of about `10^(−D/2)`. The proofs do not depend on the guess: it only chooses
    /// the value at which a free coefficient is fixed.
    pub fn simple(&self) -> Option<BigRational> {
        let Some(places) = self.places else {
            return Some(self.value.clone());
        };
        let unit = BigRational::new(BigInt::one(), power_of_ten(places));
        let digits = (&self.value / &unit).to_integer().abs();
        let significant = decimal_length(&digits);
        let mut short = digits;
        while !short.is_zero() && (&short % 10u32).is_zero() {
            short /= 10u32;
        }
        if decimal_length(&short) <= EXACT_DIGITS {
            return Some(self.value.clone());
        }
        let half = unit * ratio(1, 2);
        let simplest = simplest_between(&(&self.value - &half), &(&self.value + &half));
        let height = simplest.numer().abs() * simplest.denom();
        let bound = power_of_ten(u32::try_from(significant / 2).unwrap_or(0));
        (height <= bound).then_some(simplest)
    }
}

pub(super) fn power_of_ten(exponent: u32) -> BigInt {
    BigInt::from(10).pow(exponent)
}

fn decimal_length(value: &BigInt) -> u64 {
    if value.is_zero() {
        0
    } else {
        value.to_string().trim_start_matches('-').len() as u64
    }
}

/// The value of `-12.5e-3` and the number of its decimal places.
fn decimal(text: &str) -> Option<(BigRational, u32)> {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        None => (text, 0),
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
    };
    if exponent.unsigned_abs() as usize > MAX_DIGITS {
        return None;
    }
    let (negative, bare) = match mantissa.strip_prefix(['-', '+']) {
        Some(bare) => (mantissa.starts_with('-'), bare),
        None => (false, mantissa),
    };
    let (whole, fraction) = bare.split_once('.').unwrap_or((bare, ""));
    let digits = format!("{whole}{fraction}");
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let mut numerator: BigInt = digits.parse().ok()?;
    if negative {
        numerator = -numerator;
    }
    let places = i32::try_from(fraction.len()).ok()? - exponent;
    let value = match u32::try_from(places) {
        Ok(places) => BigRational::new(numerator, power_of_ten(places)),
        Err(_) => BigRational::from_integer(numerator * power_of_ten(places.unsigned_abs())),
    };
    Some((value, places.max(0).unsigned_abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn printed(text: &str) -> Printed {
        Printed::parse(text).expect(text)
    }

    #[test]
    fn reads_decimals_and_fractions() {
        for (text, value, places) in [
            ("0.5", ratio(1, 2), Some(1)),
            ("-1.250", ratio(-5, 4), Some(3)),
            (".25", ratio(1, 4), Some(2)),
            ("3", ratio(3, 1), None),
            ("3.", ratio(3, 1), Some(0)),
            ("12.5e-3", ratio(1, 80), Some(4)),
            ("2e2", ratio(200, 1), Some(0)),
            ("-2.0 / 3.0", ratio(-2, 3), None),
            ("7/24", ratio(7, 24), None),
        ] {
            assert_eq!(printed(text).value(), &value, "{text}");
            assert_eq!(printed(text).places(), places, "{text}");
        }
        let long = "1".repeat(MAX_DIGITS + 1);
        for text in [
            "", ".", "-", "1/0", "a", "1.2.3", "1e", "1e99999", "--1", "0x1", &long,
        ] {
            assert!(Printed::parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn simple_values_are_recognised_and_others_are_not() {
        for (text, simple) in [
            ("-0.045454545454545454545", Some(ratio(-1, 22))),
            ("0.12886597938144329897", Some(ratio(25, 194))),
            ("0.28813559322033898305", Some(ratio(17, 59))),
            ("0.1867", Some(ratio(1867, 10000))),
            ("0.66666666666666666667", Some(ratio(2, 3))),
            // The last digit of 6/11 changed.
            ("0.54545454545454545457", None),
            ("0.20951510661336200", None),
            ("1.3512071919596576340", None),
        ] {
            assert_eq!(printed(text).simple(), simple, "{text}");
        }
    }
}
