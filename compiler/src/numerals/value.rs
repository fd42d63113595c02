//! Numbers of tables: exact values with error bounds.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::arithmetic::rational::ratio;
use crate::arithmetic::rounding::{shortest, to_f64};
use crate::certify::Printed;
use crate::error::ErrorKind;
use crate::symbolic::Constant;

/// Decimals with at most this many significant digits are exact: `0.28`, `-0.5`.
const EXACT_DIGITS: usize = 6;
/// Doubles with at most this many binary digits are exact: `0x1.8p-1`.
const EXACT_BITS: u64 = 20;
/// The decimal places of irrational exact values when others are decimals.
pub const PLACES: u32 = 50;

/// A number of a table.
#[derive(Debug, Clone)]
pub struct Value {
    /// The exact value as written.
    pub constant: Constant,
    /// Half a unit of the last place of a decimal, propagated through operations; zero for an exact number.
    pub error: BigRational,
    /// The text of a single decimal.
    text: Option<String>,
    /// Whether it is an integer in its language, such as `1` but not `1.0`.
    pub whole: bool,
}

impl Value {
    /// An exact number.
    pub fn exact(constant: Constant) -> Self {
        Value {
            constant,
            error: BigRational::zero(),
            text: None,
            whole: false,
        }
    }

    /// A literal such as `0.5`, `1e-3` or `2`.
    pub fn decimal(text: &str) -> Result<Self, ErrorKind> {
        let printed = Printed::parse(text).map_err(|error| ErrorKind::Document {
            message: error.to_string(),
        })?;
        let mantissa = text.split(['e', 'E']).next().unwrap_or(text);
        let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
        let long = digits.trim_matches('0').len() > EXACT_DIGITS;
        let constant = Constant::rational(printed.value().clone())?;
        let whole = text.bytes().all(|byte| byte.is_ascii_digit());
        Ok(match long {
            true => Value {
                constant,
                error: printed.half_unit(),
                text: Some(text.to_owned()),
                whole,
            },
            false => Value {
                whole,
                ..Value::exact(constant)
            },
        })
    }

    /// The decimal of a floating-point number with `bits` binary digits. A short decimal is exact; another may be off by one unit of the last
    /// binary digit.
    pub fn rounded(text: &str, bits: u32) -> Result<Self, ErrorKind> {
        let mut value = Value::decimal(text)?;
        if !value.is_exact() {
            let unit = BigRational::new(BigInt::one(), BigInt::one() << (bits - 1));
            value.error = value.rational().abs() * unit;
            value.text = None;
        }
        Ok(value)
    }

    /// The number `numerator·2^exponent` of a hexadecimal constant, which is considered rounded if it has many digits.
    pub fn binary(numerator: BigInt, exponent: i64) -> Result<Self, ErrorKind> {
        let twos = numerator.trailing_zeros().unwrap_or(0);
        let long = numerator.bits() - twos > EXACT_BITS;
        let two = |n: i64| match u64::try_from(n) {
            Ok(n) => BigRational::from_integer(BigInt::one() << n),
            Err(_) => BigRational::new(BigInt::one(), BigInt::one() << n.unsigned_abs()),
        };
        // Half a unit of the last of 53 binary places.
        let last = i64::try_from(numerator.bits()).unwrap_or(i64::MAX) + exponent - 53;
        let value = BigRational::from_integer(numerator) * two(exponent);
        // The shortest decimal that reads back to this double: the intended number, if that was a decimal.
        let text = long.then(|| shortest(to_f64(&value)));
        Ok(Value {
            constant: Constant::rational(value)?,
            error: if long {
                two(last - 1)
            } else {
                BigRational::zero()
            },
            text,
            whole: false,
        })
    }

    /// The same number, marked as an integer of its language or not.
    pub fn with_whole(mut self, whole: bool) -> Self {
        self.whole = whole;
        self
    }

    /// Whether it is exact.
    pub fn is_exact(&self) -> bool {
        self.error.is_zero()
    }

    /// A rational number within the error of this one, or within `10^−50` if it is irrational.
    pub fn rational(&self) -> BigRational {
        match self.constant.as_rational() {
            Some(value) => value.clone(),
            None => {
                let enclosure = self.constant.enclose(PLACES * 4);
                enclosure.map_or_else(BigRational::zero, |found| found.middle())
            }
        }
    }

    /// The number as a paper would print it: the text as written, a fraction if it is exact, else its value with its error. A computed
    /// number is not rounded again: it is exact, given the numbers from which it is computed.
    pub fn printed(&self) -> Result<Printed, ErrorKind> {
        let parsed = |text: &str| {
            Printed::parse(text).map_err(|error| ErrorKind::Document {
                message: error.to_string(),
            })
        };
        match (&self.text, self.constant.as_rational()) {
            (Some(text), _) => parsed(text),
            (None, Some(value)) if self.is_exact() => parsed(&value.to_string()),
            (None, Some(value)) => Ok(Printed::computed(value, &self.error)),
            (None, None) => {
                let printed = parsed(&fixed_point(&self.rational(), PLACES))?;
                Ok(match printed.half_unit() < self.error {
                    true => Printed::computed(printed.value(), &self.error),
                    false => printed,
                })
            }
        }
    }

    pub(super) fn negate(&self) -> Result<Self, ErrorKind> {
        let text = self.text.as_ref();
        Ok(Value {
            constant: self.constant.negate()?,
            error: self.error.clone(),
            text: text.map(|text| match text.strip_prefix('-') {
                Some(bare) => bare.to_owned(),
                None => format!("-{}", text.trim_start_matches('+')),
            }),
            whole: self.whole,
        })
    }

    /// The sum.
    pub fn add(&self, other: &Self) -> Result<Self, ErrorKind> {
        Ok(Value {
            constant: self.constant.add(&other.constant)?,
            error: &self.error + &other.error,
            text: None,
            whole: self.whole && other.whole,
        })
    }

    /// The difference.
    pub fn subtract(&self, other: &Self) -> Result<Self, ErrorKind> {
        self.add(&other.negate()?)
    }

    /// The product.
    pub fn multiply(&self, other: &Self) -> Result<Self, ErrorKind> {
        let (x, y) = (self.rational().abs(), other.rational().abs());
        Ok(Value {
            constant: self.constant.multiply(&other.constant)?,
            error: x * &other.error + y * &self.error + &self.error * &other.error,
            text: None,
            whole: self.whole && other.whole,
        })
    }

    pub(super) fn divide(&self, other: &Self) -> Result<Self, ErrorKind> {
        let constant = self.constant.divide(&other.constant)?;
        let quotient = Value::exact(constant.clone()).rational().abs();
        let divisor = other.rational().abs();
        let error = (&self.error + quotient * &other.error) / divisor;
        Ok(Value {
            constant,
            // The first-order error is doubled to cover the rest, if there is one.
            error: match other.is_exact() {
                true => error,
                false => error * ratio(2, 1),
            },
            text: None,
            whole: false,
        })
    }

    /// `self^exponent` for a fraction with denominator 1, 2 or 3.
    pub fn power(&self, exponent: &Self) -> Result<Self, ErrorKind> {
        let wrong = || ErrorKind::Type {
            found: format!("the exponent {}", exponent.constant),
            expected: "a whole number, or halves or thirds of one,".to_owned(),
        };
        let power = exponent.constant.as_rational().ok_or_else(wrong)?;
        let root = match power.denom() {
            one if one.is_one() => self.clone(),
            two if *two == 2.into() => self.root("sqrt")?,
            three if *three == 3.into() => self.root("cbrt")?,
            _ => return Err(wrong()),
        };
        let whole = i32::try_from(power.numer()).map_err(|_| wrong())?;
        let limit = i32::try_from(crate::expression::MAX_EXPONENT).unwrap_or(i32::MAX);
        if whole.abs() > limit {
            return Err(wrong());
        }
        if root.is_exact() {
            return root.constant.power(whole).map(Value::exact);
        }
        let one = Value::exact(Constant::one());
        let raised =
            (0..whole.abs()).try_fold(one.clone(), |product, _| product.multiply(&root))?;
        match whole < 0 {
            true => one.divide(&raised),
            false => Ok(raised),
        }
    }

    /// The square or the cubic root.
    pub fn root(&self, name: &str) -> Result<Self, ErrorKind> {
        let constant = match name {
            "sqrt" => self.constant.sqrt()?,
            _ => self.constant.cbrt()?,
        };
        let value = Value::exact(constant);
        if self.is_exact() {
            return Ok(value);
        }
        let (root, radicand) = (value.rational().abs(), self.rational().abs());
        let error = match radicand.is_zero() {
            true => self.error.clone(),
            false => &self.error * root / radicand,
        };
        Ok(Value { error, ..value })
    }
}

/// A rational number rounded to `places` decimal places.
fn fixed_point(value: &BigRational, places: u32) -> String {
    let scaled = (value * BigRational::from_integer(BigInt::from(10).pow(places))).round();
    let digits = scaled.to_integer();
    let sign = if digits.is_negative() { "-" } else { "" };
    let digits = format!("{:0>width$}", digits.abs(), width = places as usize + 1);
    let (whole, fraction) = digits.split_at(digits.len() - places as usize);
    format!("{sign}{whole}.{fraction}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Value {
        Value::decimal(text).expect(text)
    }

    #[test]
    fn short_numbers_are_exact_and_errors_propagate() {
        assert!(
            value("0.28").is_exact() && value("7").is_exact() && !value("0.1234567").is_exact()
        );
        let sum = value("0.1234567").add(&value("0.25")).expect("a sum");
        assert_eq!(sum.rational(), ratio(3734567, 10_000_000));
        assert_eq!(sum.printed().expect("printed").text(), "0.3734567");
        let computed = value("1")
            .subtract(&sum.add(&sum).expect("a sum"))
            .expect("a difference");
        assert_eq!(
            computed.printed().expect("printed").text(),
            "0.2530866 ± 1e-7"
        );
        let half = value("0.12345678901").divide(&value("2")).expect("half");
        assert!(half.error >= ratio(1, 400_000_000_000));
        let tenth = Value::binary(0x1999999999999a_i64.into(), -56).expect("a double");
        assert_eq!(tenth.printed().expect("printed").text(), "0.1");
        assert!(!tenth.is_exact() && tenth.rational() != ratio(1, 10));
        assert!(Value::binary(3.into(), -2).expect("3/4").is_exact());
    }

    #[test]
    fn powers_are_halves_and_thirds() {
        let two = value("2");
        let third = value("1").divide(&value("3")).expect("1/3");
        let root = two.power(&third).expect("a cubic root");
        assert_eq!(root.constant.to_string(), "cbrt(2)");
        assert!(two.power(&value("0.2")).is_err());
    }
}
