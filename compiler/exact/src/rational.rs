//! Rational numbers as text, and the simplest rational in an interval.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::gcd::gcd;

/// The rational `numerator/denominator`. The denominator must not be zero.
pub fn ratio(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(numerator.into(), denominator.into())
}

/// The bits of the longer one of numerator and denominator.
pub fn length(value: &BigRational) -> u64 {
    value.numer().bits().max(value.denom().bits())
}

/// `numerator·2⁻ᵇⁱᵗˢ` in lowest terms, without a greatest common divisor.
pub fn dyadic(numerator: &BigInt, bits: u32) -> BigRational {
    match numerator.trailing_zeros() {
        None => BigRational::zero(),
        Some(zeros) => {
            let common = u32::try_from(zeros).unwrap_or(u32::MAX).min(bits);
            BigRational::new_raw(numerator >> common, BigInt::one() << (bits - common))
        }
    }
}

/// The number of binary places of a dyadic rational, 0 for an integer; `None` for other rationals.
fn places(value: &BigRational) -> Option<u32> {
    let places = value.denom().bits() - 1;
    (value.denom().trailing_zeros() == Some(places)).then_some(u32::try_from(places).ok()?)
}

/// The sum. Dyadic rationals are added without a greatest common divisor, which is slow for long numbers.
pub fn add(a: &BigRational, b: &BigRational) -> BigRational {
    if let (Some(m), Some(n)) = (places(a), places(b)) {
        let most = m.max(n);
        return dyadic(
            &((a.numer() << (most - m)) + (b.numer() << (most - n))),
            most,
        );
    }
    if a.denom().bits().min(b.denom().bits()) < LONG {
        return a + b;
    }
    // A common divisor of the sum and its denominator divides the common divisor of both denominators.
    let common = gcd(a.denom(), b.denom());
    let (left, right) = (a.denom() / &common, b.denom() / &common);
    let numerator = a.numer() * &right + b.numer() * &left;
    let excess = gcd(&numerator, &common);
    if numerator.is_zero() {
        return BigRational::zero();
    }
    BigRational::new_raw(numerator / &excess, left * (b.denom() / excess))
}

/// Length in bits from which Lehmer's algorithm is faster.
const LONG: u64 = 1024;

/// The product. Integers are multiplied without a greatest common divisor.
pub fn multiply(a: &BigRational, b: &BigRational) -> BigRational {
    if a.is_integer() && b.is_integer() {
        BigRational::from_integer(a.numer() * b.numer())
    } else if b.is_integer() && b.numer().magnitude().is_one() {
        BigRational::new_raw(a.numer() * b.numer(), a.denom().clone())
    } else if a.is_integer() && a.numer().magnitude().is_one() {
        BigRational::new_raw(a.numer() * b.numer(), b.denom().clone())
    } else if length(a).max(length(b)) < LONG {
        a * b
    } else {
        let (left, right) = (gcd(a.numer(), b.denom()), gcd(b.numer(), a.denom()));
        BigRational::new_raw(
            (a.numer() / &left) * (b.numer() / &right),
            (a.denom() / right) * (b.denom() / left),
        )
    }
}

/// Parses `3` or `-3/4`, the format of rationals in files.
///
/// Returns `None` for anything else, including a zero denominator.
pub fn parse(text: &str) -> Option<BigRational> {
    let integer = |digits: &str, signed: bool| -> Option<BigInt> {
        let bare = if signed {
            digits.strip_prefix('-').unwrap_or(digits)
        } else {
            digits
        };
        let plain = !bare.is_empty() && bare.bytes().all(|b| b.is_ascii_digit());
        plain.then(|| digits.parse().ok()).flatten()
    };
    match text.split_once('/') {
        None => integer(text, true).map(BigRational::from_integer),
        Some((numerator, denominator)) => {
            let denominator = integer(denominator, false)?;
            if denominator.is_zero() {
                return None;
            }
            Some(BigRational::new(integer(numerator, true)?, denominator))
        }
    }
}

/// The rational with the smallest denominator in the closed interval `[low, high]` (Stern–Brocot).
pub fn simplest_between(low: &BigRational, high: &BigRational) -> BigRational {
    simplest_until(low, high, u64::MAX)
}

/// [`simplest_between`], if its numerator and denominator have at most `bits` bits.
pub fn short_between(low: &BigRational, high: &BigRational, bits: u64) -> Option<BigRational> {
    let found = simplest_until(low, high, bits);
    (found.numer().bits() <= bits && found.denom().bits() <= bits).then_some(found)
}

/// The simplest rational in an interval, or the first convergent towards it with more than `bits` bits.
fn simplest_until(low: &BigRational, high: &BigRational, bits: u64) -> BigRational {
    if !low.is_positive() && !high.is_negative() {
        return BigRational::zero();
    }
    if high.is_negative() {
        return -simplest_until(&-high, &-low, bits);
    }
    // Short numbers: without allocation, with room for the sum of two.
    let ends = [low.numer(), low.denom(), high.numer(), high.denom()];
    let short = |end: &BigInt| (end.bits() < 126).then(|| end.to_u128()).flatten();
    if let [Some(a), Some(b), Some(c), Some(d)] = ends.map(short) {
        let (p, q) = simplest([a, b], [c, d], |x| {
            128 - u64::from(x.leading_zeros()) > bits
        });
        return BigRational::new_raw(p.into(), q.into());
    }
    let [a, b, c, d] = ends.map(BigInt::clone);
    let (p, q) = simplest([a, b], [c, d], |x| x.bits() > bits);
    BigRational::new_raw(p, q)
}

/// The simplest fraction between two positive fractions, or the first convergent towards it with a part that is too
/// long.
///
/// No convergent has longer parts than the ends.
fn simplest<T: Integer + Clone>(
    [mut a, mut b]: [T; 2],
    [mut c, mut d]: [T; 2],
    is_long: impl Fn(&T) -> bool,
) -> (T, T) {
    // The simplest fraction shares the continued fraction of both ends up to the first term in which they differ.
    let (mut p0, mut q0, mut p1, mut q1) = (T::zero(), T::one(), T::one(), T::zero());
    let next = |term: T, last: &T, before: &T| term * last.clone() + before.clone();
    loop {
        // The continued fraction so far continues with a number between the ends a/b ≤ c/d, both positive.
        let (floor, remainder) = a.div_rem(&b);
        let above = floor.clone() + T::one();
        let (term, is_last) = if remainder.is_zero() {
            (floor.clone(), true)
        } else if above.clone() * d.clone() <= c {
            (above, true)
        } else {
            (floor.clone(), false)
        };
        let (p, q) = (next(term.clone(), &p1, &p0), next(term, &q1, &q0));
        if is_last || is_long(&p) || is_long(&q) {
            return (p, q);
        }
        (p0, q0, p1, q1) = (p1, q1, p, q);
        let high_remainder = c - floor * d.clone();
        // Reciprocals of the fractional parts; this exchanges the ends.
        (a, b, c, d) = (d, high_remainder, b, remainder);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_products_are_those_of_the_library() {
        let numbers = [(0, 1), (1, 1), (-1, 1), (7, 1), (-3, 4), (5, 6), (1, 4)];
        for (a, b) in numbers {
            for (c, d) in numbers {
                let (x, y) = (ratio(a, b), ratio(c, d));
                assert_eq!(add(&x, &y), &x + &y);
                assert_eq!(multiply(&x, &y), &x * &y);
            }
        }
    }

    #[test]
    fn reads_what_it_writes_and_nothing_else() {
        for text in ["0", "-3/4", "17", "1000000000000000000000000000000/7"] {
            assert_eq!(parse(text).expect(text).to_string(), text);
        }
        for text in [
            "", "-", "1/0", "1/-2", "+1", "1/2/3", "0.5", " 1", "1/", "/2", "--1",
        ] {
            assert_eq!(parse(text), None, "{text}");
        }
    }

    #[test]
    fn the_simplest_rational_has_the_smallest_denominator() {
        for (low, high) in [
            ((1, 3), (1, 2)),
            ((314, 100), (315, 100)),
            ((-5, 7), (-9, 13)),
            ((2, 7), (2, 7)),
            ((-1, 5), (1, 9)),
        ] {
            let (low, high) = (ratio(low.0, low.1), ratio(high.0, high.1));
            let found = simplest_between(&low, &high);
            assert!(low <= found && found <= high);
            let smaller = (1..)
                .take_while(|q| BigInt::from(*q) < *found.denom())
                .any(|q: i64| {
                    let p = (&low * BigRational::from_integer(q.into())).ceil();
                    p <= &high * BigRational::from_integer(q.into())
                });
            assert!(!smaller, "{found} is not the simplest in [{low}, {high}]");
        }
    }
}
