//! Coefficients as papers print them: decimals and fractions, and what can be inferred from their digits.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::CertifyError;
use crate::arithmetic::rational::{ratio, simplest_between};
use crate::arithmetic::rounding::Decimal;

/// The largest number of characters of a printed number, the largest magnitude of its exponent, and the largest number
/// of digits that are computed.
pub const MAX_DIGITS: usize = 10_000;

/// Decimals with at most this many significant digits are assumed to be exact: `0.28`, `-0.5`, `0.1867`.
const EXACT_DIGITS: u64 = 6;

/// A number as it is printed: a decimal such as `-0.045454545454545454545` or `1e-3`, or a fraction of two
/// decimals such as `-1/24` or `7.0 / 24.0`. A number that was computed from rounded ones is printed with a bound on its
/// distance from the rounded number: `0.5308644 ± 1e-7`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Printed {
    text: String,
    value: BigRational,
    /// The decimal places; `None` for a fraction or an integer, which is exact.
    places: Option<u32>,
    /// The bound after `±`.
    bound: Option<BigRational>,
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
    /// assert_eq!(Printed::parse("0.5308644 ± 1e-7")?.half_unit().to_string(), "1/10000000");
    /// # Ok::<(), symplectic_compiler::certify::CertifyError>(())
    /// ```
    ///
    /// # Errors
    /// [`CertifyError::NotANumber`] if the text is not a decimal or a fraction of two, optionally with `±` and a positive bound, or
    /// is longer than [`MAX_DIGITS`].
    pub fn parse(text: &str) -> Result<Self, CertifyError> {
        let wrong = || CertifyError::NotANumber {
            text: text.chars().take(40).collect(),
        };
        if text.len() > MAX_DIGITS {
            return Err(wrong());
        }
        if let Some((value, bound)) = text.split_once('±') {
            if bound.contains('±') {
                return Err(wrong());
            }
            let [value, bound] = [value, bound].map(Printed::parse);
            let (
                Ok(Printed {
                    value, bound: None, ..
                }),
                Ok(Printed {
                    value: bound,
                    bound: None,
                    ..
                }),
            ) = (value, bound)
            else {
                return Err(wrong());
            };
            if !bound.is_positive() {
                return Err(wrong());
            }
            return Ok(Printed::bounded(text.to_owned(), value, bound));
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
            bound: None,
        })
    }

    /// A number that was computed from rounded ones, and a bound on its distance from the one computed from exact ones.
    pub(crate) fn computed(value: &BigRational, bound: &BigRational) -> Self {
        let text = decimal_text(value).unwrap_or_else(|| value.to_string());
        match Printed::parse(&text) {
            Ok(printed) if printed.half_unit() == *bound => printed,
            _ => {
                // Rounded up, to three digits.
                let short = Decimal::round(bound, 3);
                let bound = match short.value() == *bound {
                    true => short,
                    false => Decimal::round(&(bound * ratio(101, 100)), 3),
                };
                let text = format!("{text} ± {}", trimmed(&bound.to_string()));
                Printed::bounded(text, value.clone(), bound.value())
            }
        }
    }

    fn bounded(text: String, value: BigRational, bound: BigRational) -> Self {
        // Half a unit of the last of these places is at least the bound.
        let units = (BigRational::one() / (&bound * ratio(2, 1))).to_integer();
        let places = u32::try_from(decimal_length(&units).saturating_sub(1)).unwrap_or(0);
        Printed {
            text,
            value,
            places: Some(places),
            bound: Some(bound),
        }
    }

    /// The number 0.
    pub fn zero() -> Self {
        Printed {
            text: "0".to_owned(),
            value: BigRational::zero(),
            places: None,
            bound: None,
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

    /// Half a unit of the last decimal place, or the bound after `±`: the largest distance of a number from a print that rounds it. Zero for a
    /// fraction or an integer, and for a printed zero, which means that the step is left out.
    pub fn half_unit(&self) -> BigRational {
        if let Some(bound) = &self.bound {
            return bound.clone();
        }
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
        if self.bound.is_none() && decimal_length(&short) <= EXACT_DIGITS {
            return Some(self.value.clone());
        }
        let half = self.bound.clone().unwrap_or(unit * ratio(1, 2));
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

/// The longest decimal as which a fraction is written.
const LONGEST_DECIMAL: u64 = 1 << 10;

/// A number as a decimal with all its places; `None` if it does not terminate, or is very long.
pub fn decimal_text(value: &BigRational) -> Option<String> {
    // A denominator below 2ⁿ has at most n factors 2 or 5.
    let places = value.denom().bits();
    if places > LONGEST_DECIMAL {
        return None;
    }
    let places = u32::try_from(places).ok()?;
    let digits = value * BigRational::from_integer(power_of_ten(places));
    if !digits.is_integer() {
        return None;
    }
    let text = format!(
        "{:0>width$}",
        digits.numer().abs(),
        width = places as usize + 1
    );
    let (whole, fraction) = text.split_at(text.len() - places as usize);
    let sign = if value.is_negative() { "-" } else { "" };
    Some(trimmed(&format!("{sign}{whole}.{fraction}")))
}

/// A decimal without zeros at the end of its digits.
fn trimmed(decimal: &str) -> String {
    let (digits, exponent) = match decimal.find('e') {
        Some(mark) => decimal.split_at(mark),
        None => (decimal, ""),
    };
    let digits = match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.'),
        false => digits,
    };
    format!("{digits}{exponent}")
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
        // Refused at the second one: the third of ten thousand is not read.
        let bounds = "1±".repeat(MAX_DIGITS / 3);
        for text in [
            "", ".", "-", "1/0", "a", "1.2.3", "1e", "1e99999", "--1", "0x1", &long, &bounds,
        ] {
            assert!(Printed::parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn computed_numbers_keep_their_value_and_have_a_bound() {
        for (value, bound, text, places) in [
            (
                ratio(5308644, 10_000_000),
                ratio(1, 10_000_000),
                "0.5308644 ± 1e-7",
                6,
            ),
            // Half a unit of the last place needs no bound.
            (
                ratio(8765433, 10_000_000),
                ratio(1, 20_000_000),
                "0.8765433",
                7,
            ),
            (
                ratio(-1234567, 30_000_000),
                ratio(1, 60_000_000),
                "-1234567/30000000 ± 1.68e-8",
                7,
            ),
        ] {
            let computed = Printed::computed(&value, &bound);
            assert_eq!(computed.text(), text);
            assert_eq!(computed, printed(text));
            assert_eq!(
                (computed.value(), computed.places()),
                (&value, Some(places))
            );
            assert!(computed.half_unit() >= bound, "{text}");
        }
        let third = printed("0.33333333 ± 1e-8");
        assert_eq!(third.simple(), Some(ratio(1, 3)));
        // Few digits do not make a computed number exact.
        assert_eq!(printed("0.1234 ± 1e-8").simple(), None);
        for text in ["1 ± 0", "1 ± -1e-3", "± 1", "1 ±", "1 ± 2 ± 3", "0.5 ± x"] {
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
