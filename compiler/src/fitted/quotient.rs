//! Quotients of sums of waves, and their power series in `ν`.

use num_rational::BigRational;

use crate::algebra::{Field, FieldElement};
use crate::error::ErrorKind;
use crate::fitted::waves::{Ring, Waves};

/// The highest power of `ν` in which a denominator is looked for.
const DEEPEST: i32 = 64;

/// A quotient of two sums of waves. Different quotients may be equal: [`Ring::equal`] decides.
#[derive(Debug, Clone, PartialEq)]
pub struct Quotient {
    /// The numerator.
    pub numerator: Waves,
    /// The denominator, not the function 0.
    pub denominator: Waves,
}

impl Ring {
    /// A quotient with the smallest powers of `ν`, 1/1 and 0/1 where it is a number of the field.
    pub fn quotient(&self, numerator: Waves, denominator: Waves) -> Quotient {
        let lowest = [&numerator, &denominator].into_iter();
        let lowest = lowest.filter_map(Waves::lowest_power).min().unwrap_or(0);
        let shift = self.rational(BigRational::from_integer(1.into()));
        let [numerator, denominator] =
            [&numerator, &denominator].map(|x| self.scale(x, &shift, -lowest));
        // A multiple of the denominator is a number.
        let ratio = numerator.terms().next().and_then(|(wave, x)| {
            let (_, y) = denominator.terms().find(|(known, _)| *known == wave)?;
            Some(self.field.multiply(x, &self.field.inverse(y)?))
        });
        let number = match (&ratio, numerator.is_zero()) {
            (_, true) => Some(self.rational(BigRational::default())),
            (Some(ratio), false) => self
                .subtract(&numerator, &self.scale(&denominator, ratio, 0))
                .is_zero()
                .then(|| ratio.clone()),
            (None, false) => None,
        };
        match number {
            Some(number) => Quotient {
                numerator: self.constant(number),
                denominator: self.one(),
            },
            None => Quotient {
                numerator,
                denominator,
            },
        }
    }

    /// Whether two quotients are the same function.
    pub fn equal(&self, x: &Quotient, y: &Quotient) -> bool {
        let left = self.multiply(&x.numerator, &y.denominator);
        let right = self.multiply(&y.numerator, &x.denominator);
        self.subtract(&left, &right).is_zero()
    }

    /// The first coefficients of the power series in `ν`.
    ///
    /// # Errors
    /// [`ErrorKind::Definition`] if the function has no limit at `ν = 0`.
    pub fn series(&self, x: &Quotient, length: usize) -> Result<Vec<FieldElement>, ErrorKind> {
        let terms = i32::try_from(length).unwrap_or(DEEPEST);
        let low = self.expansion(&x.denominator, 0, DEEPEST);
        let valuation = low.iter().position(|c| !c.is_zero());
        let valuation = valuation.and_then(|v| i32::try_from(v).ok());
        let Some(valuation) = valuation else {
            return Err(no_limit());
        };
        if self
            .expansion(&x.numerator, 0, valuation)
            .iter()
            .any(|c| !c.is_zero())
        {
            return Err(no_limit());
        }
        let numerator = self.expansion(&x.numerator, valuation, valuation + terms);
        let denominator = self.expansion(&x.denominator, valuation, valuation + terms);
        self.divide(&numerator, &denominator, length)
    }

    /// The quotient of two power series, to this length.
    ///
    /// # Errors
    /// [`ErrorKind::Definition`] if the divisor is 0 at `ν = 0`.
    pub fn divide(
        &self,
        x: &[FieldElement],
        y: &[FieldElement],
        length: usize,
    ) -> Result<Vec<FieldElement>, ErrorKind> {
        let inverse = y.first().and_then(|c| self.field.inverse(c));
        let inverse = inverse.ok_or_else(no_limit)?;
        let mut series: Vec<FieldElement> = Vec::new();
        for (k, coefficient) in x.iter().enumerate().take(length) {
            let known = series.iter().enumerate();
            let known = known.filter_map(|(i, s)| Some((s, y.get(k - i)?)));
            let rest = known.fold(coefficient.clone(), |rest, (s, d)| {
                if s.is_zero() || d.is_zero() {
                    return rest;
                }
                self.field.subtract(&rest, &self.field.multiply(s, d))
            });
            series.push(self.field.multiply(&rest, &inverse));
        }
        Ok(series)
    }

    /// The product of two power series, to this length.
    pub fn times(
        &self,
        x: &[FieldElement],
        y: &[FieldElement],
        length: usize,
    ) -> Vec<FieldElement> {
        let coefficient = |k: usize| {
            let pairs = (0..=k).filter_map(|i| Some((x.get(i)?, y.get(k - i)?)));
            let pairs = pairs.filter(|(x, y)| !x.is_zero() && !y.is_zero());
            let products = pairs.map(|(x, y)| self.field.multiply(x, y));
            products.fold(self.rational(BigRational::default()), |sum, product| {
                self.field.add(&sum, &product)
            })
        };
        (0..length).map(coefficient).collect()
    }

    /// The sum of power series, to this length.
    pub fn total(&self, terms: &[Vec<FieldElement>], length: usize) -> Vec<FieldElement> {
        let coefficient = |k: usize| {
            let all = terms.iter().filter_map(|series| series.get(k));
            all.fold(self.rational(BigRational::default()), |sum, x| {
                self.field.add(&sum, x)
            })
        };
        (0..length).map(coefficient).collect()
    }

    /// The quotient as text, with this name for `ν`.
    pub fn display_quotient(&self, x: &Quotient, name: &str) -> String {
        let numerator = self.display(&x.numerator, name);
        if x.denominator == self.one() {
            return numerator;
        }
        let denominator = self.display(&x.denominator, name);
        let bracketed = |text: String| match text.get(1..) {
            Some(rest) if rest.contains([' ', '*', '/']) => format!("({text})"),
            _ => text,
        };
        format!("{}/{}", bracketed(numerator), bracketed(denominator))
    }
}

fn no_limit() -> ErrorKind {
    ErrorKind::Definition {
        message: "the coefficients have no limit where the frequency goes to 0, so that small steps have no method: take \
                  a basis with as many powers of t as the functions of the frequency need, such as 1, cos(w*t), sin(w*t)"
            .to_owned(),
    }
}
