//! Enclosures of π and of elementary functions by power series.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::arithmetic::interval::Interval;

/// The additional binary places of a series.
const GUARD: u32 = 24;

/// An enclosure of π with this number of binary places.
pub(super) fn pi(bits: u32) -> Interval {
    // Machin: π = 16 arctan(1/5) − 4 arctan(1/239).
    let working = bits + GUARD;
    let arctangent = |n: u32| {
        let mut power = (BigInt::one() << working) / n;
        let (mut sum, mut k) = (BigInt::zero(), 1u32);
        while !power.is_zero() {
            if k % 4 == 1 {
                sum += &power / k;
            } else {
                sum -= &power / k;
            }
            power /= n * n;
            k += 2;
        }
        sum
    };
    // Every term is wrong by two units at most.
    let error = BigInt::from(working) << 6;
    around(arctangent(5) * 16 - arctangent(239) * 4, error, working).rounded(bits)
}

/// The exponentials of the numbers in an interval in `[0, 1]`.
pub(super) fn exp(argument: &Interval) -> Interval {
    hull(argument, |x, working| series(x, working, [1; 4]))
}

/// The sines of the numbers in an interval in `[0, 1]`.
pub(super) fn sin(argument: &Interval) -> Interval {
    hull(argument, |x, working| series(x, working, [0, 1, 0, -1]))
}

/// The cosines of the numbers in an interval in `[0, 1]`.
pub(super) fn cos(argument: &Interval) -> Interval {
    hull(argument, |x, working| series(x, working, [1, 0, -1, 0]))
}

/// The quotients of the numbers in two intervals; `None` if the divisor contains zero.
pub(super) fn divide(left: &Interval, right: &Interval) -> Option<Interval> {
    let sign = right.sign().filter(|sign| sign.is_ne())?;
    let (left, right) = if sign.is_lt() {
        let negative = |i: &Interval| Interval {
            low: -&i.high,
            high: -&i.low,
            bits: i.bits,
        };
        (negative(left), negative(right))
    } else {
        (left.clone(), right.clone())
    };
    let quotient = |end: &BigInt, towards: bool| {
        // The divisor is the smaller one where that makes the quotient larger in absolute value.
        let divisor = if end.is_negative() == towards {
            &right.low
        } else {
            &right.high
        };
        (end << left.bits, divisor.clone())
    };
    let (low, below) = quotient(&left.low, true);
    let (high, above) = quotient(&left.high, false);
    Some(Interval {
        low: low.div_floor(&below),
        high: -(-high).div_floor(&above),
        bits: left.bits,
    })
}

/// The values of a monotonic function between those at the ends.
fn hull(argument: &Interval, value: impl Fn(&BigRational, u32) -> Interval) -> Interval {
    let working = argument.bits + GUARD;
    let [a, b] = [argument.low(), argument.high()].map(|x| value(&x, working));
    Interval {
        low: a.low.min(b.low),
        high: a.high.max(b.high),
        bits: working,
    }
    .rounded(argument.bits)
}

/// The sum of `σ_k xᵏ/k!` with signs `σ_k` that repeat after four terms.
fn series(x: &BigRational, working: u32, signs: [i32; 4]) -> Interval {
    let x: BigInt = (x.numer() << working) / x.denom();
    let mut term = BigInt::one() << working;
    let (mut sum, mut k) = (BigInt::zero(), 0u32);
    while !term.is_zero() {
        sum += &term * signs[k as usize % 4];
        k += 1;
        term = ((term * &x) >> working) / k;
    }
    // For x in [0, 1] every term is wrong by less than four units.
    around(sum, BigInt::from(4 * (k + 2)), working)
}

fn around(middle: BigInt, error: BigInt, bits: u32) -> Interval {
    Interval {
        low: &middle - &error,
        high: middle + error,
        bits,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use crate::arithmetic::rounding::to_f64;

    #[test]
    fn values_agree_with_doubles() {
        let middle = |i: Interval| to_f64(&((i.low() + i.high()) / ratio(2, 1)));
        assert_eq!(middle(pi(200)), std::f64::consts::PI);
        for (n, d) in [(1, 3), (1, 1), (3, 4), (1, 100)] {
            let x = Interval::enclosing(&ratio(n, d), 120);
            let double = n as f64 / d as f64;
            for (interval, value) in [
                (exp(&x), double.exp()),
                (sin(&x), double.sin()),
                (cos(&x), double.cos()),
                (
                    divide(&cos(&x), &sin(&x)).expect("not zero"),
                    1.0 / double.tan(),
                ),
            ] {
                assert!(interval.high() - interval.low() < ratio(1, 1 << 60));
                assert!((middle(interval) / value - 1.0).abs() < 1e-14);
            }
        }
        assert_eq!(divide(&pi(9), &Interval::enclosing(&ratio(0, 1), 9)), None);
    }

    #[test]
    fn quotients_are_enclosed() {
        for a in [-7, -1, 0, 2, 9] {
            for b in [-5, -2, 3, 8] {
                let around = |n: i64| Interval {
                    low: BigInt::from(16 * n - 9),
                    high: BigInt::from(16 * n + 5),
                    bits: 4,
                };
                let quotient = divide(&around(a), &around(b)).expect("not zero");
                for (i, j) in [(-9, -9), (-9, 5), (5, -9), (5, 5), (0, 0)] {
                    assert!(quotient.contains(&ratio(16 * a + i, 16 * b + j)));
                }
            }
        }
    }
}
