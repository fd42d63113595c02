//! Enclosures and signs of constants.

use std::cmp::Ordering;
use std::collections::HashMap;

use num_rational::BigRational;
use num_traits::Zero;

use super::zero::is_zero;
use super::{Constant, MAX_MAGNITUDE, MAX_SIGN_BITS, Tree};
use crate::arithmetic::elementary;
use crate::arithmetic::interval::{Interval, more_places};

/// Largest number of guard places for an argument of a function: enough for a product of the largest numbers and the
/// inverse of the smallest number that can be separated from zero.
pub(super) const ARGUMENT_GUARD: u32 = 3 * MAX_MAGNITUDE as u32;
/// Largest number of guard places for any constant: for its arguments, for a product of functions and for its
/// coefficient in a sum.
const MAX_GUARD: u32 = 4 * ARGUMENT_GUARD;

impl Constant {
    /// An enclosure with this number of binary places, at most two units wide.
    ///
    /// `None` if a part that must be nonzero or positive cannot be proved so, or if the evaluation loses more than
    /// 49152 binary places; the limits on constants exclude the latter.
    pub fn enclose(&self, bits: u32) -> Option<Interval> {
        self.enclose_with(bits, MAX_GUARD)
    }

    /// The enclosure, if its evaluation loses at most `most` places.
    pub(super) fn enclose_with(&self, bits: u32, most: u32) -> Option<Interval> {
        if let Tree::Rational(value) = self.tree() {
            return Some(Interval::enclosing(value, bits));
        }
        let mut guard = 16 + (usize::BITS - self.size().leading_zeros());
        loop {
            let fine = self.evaluate(bits.saturating_add(guard));
            if let Some(fine) = &fine
                && fine.width_bits() <= -i64::from(bits)
            {
                return Some(fine.with_bits(bits));
            }
            if guard >= most {
                return None;
            }
            guard = more_places(guard, bits, fine.as_ref()).min(most);
        }
    }

    /// The sign; `None` if the constant cannot be proved zero exactly, nor nonzero by enclosures with 4096 binary
    /// places.
    pub fn sign(&self) -> Option<Ordering> {
        match self.tree() {
            Tree::Rational(value) => Some(value.cmp(&BigRational::zero())),
            Tree::Pi | Tree::Exp(_) | Tree::Sqrt(_) => Some(Ordering::Greater),
            Tree::Product(factors) => {
                let mut sign = Ordering::Greater;
                for (base, exponent) in factors {
                    match base.sign()? {
                        Ordering::Equal => return Some(Ordering::Equal),
                        Ordering::Less if exponent % 2 != 0 => sign = sign.reverse(),
                        _ => {}
                    }
                }
                Some(sign)
            }
            Tree::Sum(constant, terms) if constant.is_zero() && terms.len() == 1 => {
                let (x, factor) = &terms[0];
                let sign = x.sign()?;
                Some(if *factor < BigRational::zero() {
                    sign.reverse()
                } else {
                    sign
                })
            }
            _ => self.separation().map(|(sign, _)| sign),
        }
    }

    /// The sign and a number `n` with `|x| ≥ 2ⁿ`, or [`Ordering::Equal`] and any number.
    pub(super) fn separation(&self) -> Option<(Ordering, i64)> {
        *self.separation_cell().get_or_init(|| self.separate())
    }

    fn separate(&self) -> Option<(Ordering, i64)> {
        if let Tree::Rational(value) = self.tree() {
            let least = value.numer().bits() as i64 - 1 - value.denom().bits() as i64;
            return Some((value.cmp(&BigRational::zero()), least));
        }
        let decide = |interval: &Interval| {
            let sign = interval.sign().filter(|sign| sign.is_ne())?;
            let nearest = if sign.is_gt() {
                &interval.low
            } else {
                &interval.high
            };
            Some((sign, nearest.bits() as i64 - 1 - i64::from(interval.bits())))
        };
        // Most nonzero values are separated from zero immediately. Zero is decided exactly before high precision is
        // used.
        let mut bits = 64;
        while bits < MAX_SIGN_BITS {
            if let Some(found) = self.evaluate(bits).as_ref().and_then(decide) {
                return Some(found);
            }
            if bits == 256 && is_zero(self) == Some(true) {
                return Some((Ordering::Equal, 0));
            }
            bits *= 2;
        }
        decide(&self.enclose(MAX_SIGN_BITS + 2)?)
    }

    /// An enclosure of any width, evaluated with this number of binary places throughout.
    fn evaluate(&self, bits: u32) -> Option<Interval> {
        Evaluation {
            bits,
            known: HashMap::new(),
        }
        .of(self)
    }
}

/// The enclosures of the parts of a constant, by address: equal parts mostly share memory.
struct Evaluation {
    bits: u32,
    known: HashMap<usize, Interval>,
}

impl Evaluation {
    fn of(&mut self, constant: &Constant) -> Option<Interval> {
        let bits = self.bits;
        if let Tree::Rational(value) = constant.tree() {
            return Some(Interval::enclosing(value, bits));
        }
        if let Some(known) = self.known.get(&constant.identity()) {
            return Some(known.clone());
        }
        let interval = match constant.tree() {
            Tree::Rational(value) => Interval::enclosing(value, bits),
            Tree::Pi => elementary::pi(bits),
            Tree::Root(root) => root.enclose(bits),
            // A radicand is nonnegative even if its enclosure extends below zero.
            Tree::Sqrt(x) => elementary::sqrt(&self.of(x)?.nonnegative()?)?,
            Tree::Cbrt(x) => elementary::root(&self.of(x)?, 3)?,
            Tree::Exp(x) => elementary::exp(&self.of(x)?)?,
            Tree::Ln(x) => elementary::ln(&self.of(x)?)?,
            Tree::Cos(x) => elementary::cos(&self.of(x)?),
            Tree::Sin(x) => elementary::sin(&self.of(x)?),
            Tree::Product(factors) => {
                let one = Interval::enclosing(&num_traits::One::one(), bits);
                let (mut above, mut below) = (one.clone(), one);
                for (base, exponent) in factors {
                    let power = self.of(base)?.power(exponent.unsigned_abs());
                    let side = if *exponent > 0 {
                        &mut above
                    } else {
                        &mut below
                    };
                    *side = side.multiply(&power);
                }
                above.divide(&below)?
            }
            Tree::Sum(rational, terms) => {
                let mut sum = Interval::enclosing(rational, bits);
                for (x, factor) in terms {
                    sum = sum.add(&self.of(x)?.scale(factor));
                }
                sum
            }
        };
        self.known.insert(constant.identity(), interval.clone());
        Some(interval)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use crate::arithmetic::roots;
    use crate::arithmetic::rounding::to_f64;
    use crate::symbolic::constant::tests::{constant, value};
    use proptest::prelude::*;

    #[test]
    fn enclosures_are_as_narrow_as_asked() {
        for text in [
            "pi",
            "e^2000",
            "exp(-2800)",
            "pi^400/pi^398 - pi",
            "1/(pi - 22/7)",
            "sin(10^300)/7",
            "exp(-2000)*exp(1000)*exp(1000 - 1/3)",
            "root(t^3 - t - 1, 1)*cbrt(5)",
            "1/exp(-1000)^2",
            "sqrt(pi^2/10^400)",
            "1/(exp(-1000) + exp(-1001))^2",
            "ln(cos(1))",
            "ln(10^-400/9^400/9^400/9^400)",
        ] {
            let x = constant(text);
            let mut coarser: Option<Interval> = None;
            for bits in [8, 64, 500] {
                let interval = x.enclose(bits).expect(text);
                assert_eq!(interval.bits(), bits);
                assert!(&interval.high - &interval.low <= 2.into(), "{text}");
                if let Some(coarse) = coarser {
                    assert!(
                        roots::compare(&coarse.with_bits(bits), &interval).is_none(),
                        "{text}"
                    );
                }
                coarser = Some(interval);
            }
        }
    }

    #[test]
    fn signs_are_found_or_left_open() {
        let cases = [
            ("pi - 22/7", Some(Ordering::Less)),
            ("exp(-2800) + 10^-400", Some(Ordering::Greater)),
            ("-exp(-2800)*pi", Some(Ordering::Less)),
            ("exp(-2800) - exp(-2700)", Some(Ordering::Less)),
            ("(1 - pi)^3*(2 - e)^2", Some(Ordering::Less)),
            ("pi - pi", Some(Ordering::Equal)),
            ("sqrt(2)*sqrt(3) - sqrt(6)", Some(Ordering::Equal)),
            ("(1 - pi)*(1 + pi) + pi^2 - 1", Some(Ordering::Equal)),
            ("(e - pi)*(e + pi) - e^2 + pi^2", None),
        ];
        for (text, sign) in cases {
            assert_eq!(constant(text).sign(), sign, "{text}");
        }
    }

    proptest! {
        #[test]
        fn enclosures_agree_with_doubles(a in -40i64..40, b in 1i64..9, c in 1i64..30) {
            let (x, y) = (ratio(a, b), ratio(c, b));
            let text = format!("exp({x}/4)*sin({x}) - sqrt({y})/pi + cos({y}*pi + 1)*cbrt({x}) + ln({y})");
            let (u, v) = (to_f64(&x), to_f64(&y));
            let expected = (u / 4.0).exp() * u.sin() - v.sqrt() / std::f64::consts::PI
                + (v * std::f64::consts::PI + 1.0).cos() * u.cbrt() + v.ln();
            let found = value(&constant(&text));
            prop_assert!((found - expected).abs() <= 1e-9 * (1.0 + expected.abs()), "{}: {} {}", text, found, expected);
        }
    }
}
