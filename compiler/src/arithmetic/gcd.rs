//! Greatest common divisors of long whole numbers (Lehmer).

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, ToPrimitive, Zero};

/// Shorter numbers are left to the binary algorithm, whose time grows with the square of the length, too, but which is
/// slower by a factor of ten.
const SHORT: u64 = 1024;
/// The leading bits by which quotients are found.
const LEADING: u64 = 126;
/// Cofactors are below this, so that they are machine words.
const LARGEST: i128 = 1 << 62;

/// The greatest common divisor, not negative.
pub(crate) fn gcd(a: &BigInt, b: &BigInt) -> BigInt {
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

/// One division, so that both are as short as the shorter one.
fn short(a: &BigInt, b: &BigInt) -> BigInt {
    let (long, short) = if a.bits() < b.bits() { (b, a) } else { (a, b) };
    if short.is_zero() {
        return long.abs();
    }
    short.gcd(&(long % short))
}

/// The product of the matrices of as many steps of Euclid's algorithm as the leading bits of `x ≥ y` decide (Knuth, *The
/// Art of Computer Programming* 2, 4.5.2, Algorithm L).
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
    // Without a step it would not end.
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
        fn it_is_the_one_of_the_binary_algorithm(
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

    /// The longest run of quotients 1, and quotients that are as large as they can be.
    #[test]
    fn extreme_quotients() {
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
