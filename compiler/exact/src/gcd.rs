//! Greatest common divisors of long integers (Lehmer).

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, ToPrimitive, Zero};

/// Length in bits below which the binary algorithm is used. Both are quadratic in the length; on long numbers Lehmer's
/// is ten times faster.
const SHORT: u64 = 1024;
/// Number of leading bits that determine the quotients.
const LEADING: u64 = 126;
/// Bound on the cofactors, so that they fit machine words.
const LARGEST: i128 = 1 << 62;

/// The nonnegative greatest common divisor.
pub fn gcd(a: &BigInt, b: &BigInt) -> BigInt {
    if a.bits().min(b.bits()) < SHORT {
        return short(a, b);
    }
    let (mut x, mut y) = (a.abs(), b.abs());
    if x < y {
        std::mem::swap(&mut x, &mut y);
    }
    while y.bits() >= SHORT {
        (x, y) = match cofactors(&x, &y) {
            Some([[a, b], [c, d]]) => (&x * a + &y * b, &x * c + &y * d),
            None => {
                let rest = x % &y;
                (y, rest)
            }
        };
    }
    short(&x, &y)
}

/// One division first, so that both operands have the length of the shorter one.
fn short(a: &BigInt, b: &BigInt) -> BigInt {
    let (long, short) = if a.bits() < b.bits() { (b, a) } else { (a, b) };
    if short.is_zero() {
        return long.abs();
    }
    short.gcd(&(long % short))
}

/// The product of the matrices of all steps of Euclid's algorithm that the leading bits of `x ≥ y` determine (Knuth,
/// *The Art of Computer Programming* 2, 4.5.2, Algorithm L).
fn cofactors(x: &BigInt, y: &BigInt) -> Option<[[i64; 2]; 2]> {
    let excess = x.bits() - LEADING;
    let (mut high, mut low) = ((x >> excess).to_i128()?, (y >> excess).to_i128()?);
    let ([mut a, mut b], [mut c, mut d]) = ([1i128, 0], [0, 1]);
    while low + c != 0 && low + d != 0 {
        let quotient = (high + a) / (low + c);
        if quotient != (high + b) / (low + d) || quotient >= LARGEST {
            break;
        }
        let next = [a - quotient * c, b - quotient * d];
        if next.iter().any(|x| x.abs() >= LARGEST) {
            break;
        }
        ([a, b], [c, d]) = ([c, d], next);
        (high, low) = (low, high - quotient * low);
    }
    let small = |x: i128| i64::try_from(x).ok();
    // `None` without progress; the caller then divides.
    (b != 0).then_some([[small(a)?, small(b)?], [small(c)?, small(d)?]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::One;
    use proptest::prelude::*;

    fn number(digits: &[u32], negative: bool) -> BigInt {
        let size = digits.iter().fold(BigInt::zero(), |x, &d| (x << 32u32) + d);
        if negative { -size } else { size }
    }

    proptest! {
        #[test]
        fn gcd_of_integers_equals_the_binary_one(
            a in prop::collection::vec(any::<u32>(), 0..90),
            b in prop::collection::vec(any::<u32>(), 0..90),
            common in prop::collection::vec(any::<u32>(), 0..60),
            signs in any::<[bool; 2]>(),
        ) {
            let common = number(&common, false);
            let (a, b) = (number(&a, signs[0]) * &common, number(&b, signs[1]) * &common);
            prop_assert_eq!(gcd(&a, &b), Integer::gcd(&a, &b));
        }
    }

    /// Fibonacci numbers, whose quotients are all 1, and extremely large quotients.
    #[test]
    fn gcd_is_right_for_extreme_quotients() {
        let (mut a, mut b) = (BigInt::one(), BigInt::one());
        while b.bits() < 5000 {
            (a, b) = (b.clone(), a + b);
        }
        assert!(gcd(&a, &b).is_one());
        let power = BigInt::one() << 3000u32;
        assert_eq!(gcd(&(&power * &power), &power), power);
        assert!(gcd(&(&power * &power + 1u32), &power).is_one());
        assert_eq!(gcd(&BigInt::zero(), &-&power), power);
        assert!(gcd(&(&power - 1u32), &power).is_one());
    }
}
