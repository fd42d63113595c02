//! Real roots of rational polynomials: isolation by Sturm sequences, certified refinement.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::interval::Interval;
use super::polynomial::Polynomial;
use super::prime_field::{PrimeField, large_primes};
use super::rational::simplest_between;

/// An exact real root of a squarefree polynomial.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Root {
    /// A rational root.
    Rational(BigRational),
    /// An irrational root: the only root in an interval, whose ends are not roots.
    Irrational(Interval),
}

impl Root {
    /// The root, if it is rational.
    pub fn rational(&self) -> Option<&BigRational> {
        match self {
            Root::Rational(value) => Some(value),
            Root::Irrational(_) => None,
        }
    }

    /// Whether a divisor of the root's polynomial vanishes at this root.
    ///
    /// In the isolating interval the divisor has at most this simple root: it vanishes there if and only if its sign
    /// changes.
    pub fn is_root_of_divisor(&self, divisor: &Polynomial) -> bool {
        match self {
            Root::Rational(value) => divisor.evaluate(value).is_zero(),
            Root::Irrational(interval) => {
                sign_at(divisor, &interval.low, interval.bits)
                    != sign_at(divisor, &interval.high, interval.bits)
            }
        }
    }
}

/// The real roots of a squarefree polynomial in ascending order, each isolated and classified as rational or
/// irrational.
pub fn real_roots(polynomial: &Polynomial) -> Vec<Root> {
    let polynomial = &polynomial.primitive();
    let chain = SturmChain::new(polynomial);
    let bound = root_bound(polynomial);
    let mut roots = Vec::new();
    // Half-open intervals (low, high]·2⁻ᵇⁱᵗˢ, the leftmost on top.
    let mut pending = vec![(-&bound, bound, 0u32)];
    while let Some((low, high, bits)) = pending.pop() {
        match chain
            .count(&low, bits)
            .saturating_sub(chain.count(&high, bits))
        {
            0 => {}
            1 => roots.push(classify(polynomial, low, high, bits)),
            _ => {
                let (low, high) = (low << 1, high << 1);
                let middle: BigInt = (&low + &high) >> 1;
                pending.push((middle.clone(), high, bits + 1));
                pending.push((low, middle, bits + 1));
            }
        }
    }
    roots
}

/// An integer above the absolute value of every root (Cauchy).
fn root_bound(polynomial: &Polynomial) -> BigInt {
    let Some((leading, rest)) = polynomial.numerators().split_last() else {
        return BigInt::one();
    };
    let largest = rest.iter().map(Signed::abs).max().unwrap_or_default();
    largest / leading.abs() + 2
}

/// The sign of a polynomial at `point·2⁻ᵇⁱᵗˢ`.
fn sign_at(polynomial: &Polynomial, point: &BigInt, bits: u32) -> Sign {
    value_at(polynomial, point, bits).sign()
}

/// The value of a polynomial of degree `n` at `point·2⁻ᵇⁱᵗˢ`, times its denominator and `2^(n·bits)`.
fn value_at(polynomial: &Polynomial, point: &BigInt, bits: u32) -> BigInt {
    let mut scale = 0;
    let mut value = BigInt::zero();
    for numerator in polynomial.numerators().iter().rev() {
        value = value * point + (numerator << scale);
        scale += bits as usize;
    }
    value
}

/// Sturm's chain of a polynomial without multiple roots: positive multiples of it, its derivative, and the negative remainders down to a
/// number, with coprime integer coefficients.
pub fn sturm_chain(polynomial: &Polynomial) -> Vec<Polynomial> {
    let SturmChain(mut chain) = SturmChain::new(polynomial);
    chain.pop_if(|last| last.is_zero());
    let coprime = |p: &Polynomial| match p.leading().is_negative() {
        true => -&p.primitive(),
        false => p.primitive(),
    };
    chain.iter().map(coprime).collect()
}

struct SturmChain(Vec<Polynomial>);

impl SturmChain {
    fn new(polynomial: &Polynomial) -> Self {
        let mut chain = vec![polynomial.clone(), polynomial.derivative()];
        while let [.., a, b] = chain.as_slice()
            && !b.is_zero()
        {
            // Positive multiples only: `primitive` makes the leading coefficient positive, which
            // may flip the sign.
            let r = a.remainder(b);
            let next = if r.leading().is_negative() {
                r.primitive()
            } else {
                -&r.primitive()
            };
            chain.push(if r.is_zero() { r } else { next });
        }
        SturmChain(chain)
    }

    /// The number of sign changes along the chain at `point·2⁻ᵇⁱᵗˢ`.
    fn count(&self, point: &BigInt, bits: u32) -> usize {
        let signs: Vec<Sign> = self
            .0
            .iter()
            .map(|p| sign_at(p, point, bits))
            .filter(|&s| s != Sign::NoSign)
            .collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }
}

/// Classifies the only root of a polynomial in `(low, high]·2⁻ᵇⁱᵗˢ` as rational or irrational.
pub fn classified(polynomial: &Polynomial, interval: &Interval) -> Root {
    let Interval { low, high, bits } = interval.clone();
    classify(&polynomial.whole_multiple(), low, high, bits)
}

/// Length in bits of leading coefficients above which testing a rational candidate is slow.
const LONG: u64 = 1024;
/// Number of primes to try for the exclusion of rational roots.
const PRIMES: usize = 64;

/// Whether a prime proves that a polynomial with integer coefficients has no rational root: it has no root modulo the
/// prime, which does not divide the leading coefficient.
fn surely_has_no_rational_root(polynomial: &Polynomial) -> bool {
    let proves = |field: PrimeField| {
        let residues = field.reduce(polynomial)?;
        if residues.len() != polynomial.numerators().len() {
            return None;
        }
        let power = field.power_modulo(&[0, 1], field.prime(), &residues);
        let difference = field.subtract(&power, &field.remainder(&[0, 1], &residues));
        (field.gcd(&residues, &difference).len() == 1).then_some(())
    };
    let mut primes = large_primes().take(PRIMES).map(PrimeField::new);
    primes.any(|field| proves(field).is_some())
}

/// Decides whether the only root in `(low, high]` is rational.
fn classify(polynomial: &Polynomial, low: BigInt, high: BigInt, bits: u32) -> Root {
    let rational = |point: &BigInt, bits: u32| {
        Root::Rational(BigRational::new(point.clone(), BigInt::one() << bits))
    };
    if let [constant, slope] = polynomial.numerators() {
        return Root::Rational(BigRational::new(-constant, slope.clone()));
    }
    if sign_at(polynomial, &high, bits) == Sign::NoSign {
        return rational(&high, bits);
    }
    // The lower end may be another root, which the half-open interval excludes.
    let (mut low, mut high, mut bits) = (low, high, bits);
    while sign_at(polynomial, &low, bits) == Sign::NoSign {
        (low, high, bits) = (low << 1, high << 1, bits + 1);
        let middle: BigInt = (&low + &high) >> 1;
        match sign_at(polynomial, &middle, bits) {
            Sign::NoSign => return rational(&middle, bits),
            sign if sign == sign_at(polynomial, &high, bits) => high = middle,
            _ => low = middle,
        }
    }
    if is_long(polynomial) && surely_has_no_rational_root(polynomial) {
        return Root::Irrational(Interval { low, high, bits });
    }
    let places = polynomial.leading().numer().bits() as u32 + 2;
    let interval = match refine(polynomial, &Interval { low, high, bits }, places) {
        Refined::Exactly(value) => return Root::Rational(value),
        Refined::Within(interval) => interval,
    };
    rational_root(polynomial, &interval).map_or(Root::Irrational(interval), Root::Rational)
}

fn is_long(polynomial: &Polynomial) -> bool {
    polynomial.leading().numer().bits() > LONG
}

/// The rational root of a polynomial with integer coefficients in an interval with one root.
///
/// It is `k/leading` with an integer `k`. The interval is shorter than `1/(2·leading)`, so the simplest rational in the
/// scaled interval is the only candidate for `k`.
fn rational_root(polynomial: &Polynomial, interval: &Interval) -> Option<BigRational> {
    let leading = BigRational::from_integer(polynomial.leading().to_integer());
    let scaled = |end: BigRational| end * &leading;
    let whole = simplest_between(&scaled(interval.low()), &scaled(interval.high()));
    let candidate = whole / &leading;
    polynomial.sign_at(&candidate).is_eq().then_some(candidate)
}

/// The outcome of a refinement.
enum Refined {
    /// The root was hit exactly.
    Exactly(BigRational),
    /// An interval with a sign change.
    Within(Interval),
}

/// An interval around a root with this number of binary places, at most two units wide.
///
/// `polynomial` is the squarefree polynomial whose root was isolated.
pub fn enclose(polynomial: &Polynomial, root: &Root, bits: u32) -> Interval {
    enclose_from(polynomial, root, None, bits)
}

/// [`enclose`], starting from a `known` enclosure.
pub fn enclose_from(
    polynomial: &Polynomial,
    root: &Root,
    known: Option<&Interval>,
    bits: u32,
) -> Interval {
    match root {
        Root::Rational(value) => Interval::enclosing(value, bits),
        Root::Irrational(interval) => match refine(polynomial, narrower(interval, known), bits) {
            Refined::Exactly(value) => Interval::enclosing(&value, bits),
            Refined::Within(fine) => {
                // Return exactly the requested binary places, rounded outward.
                let excess = fine.bits.saturating_sub(bits);
                let low: BigInt = &fine.low >> excess;
                let high: BigInt = -((-&fine.high) >> excess);
                let missing = bits.saturating_sub(fine.bits);
                Interval {
                    low: low << missing,
                    high: high << missing,
                    bits,
                }
            }
        },
    }
}

/// The known enclosure of the root if it lies inside the isolating interval, where it also has a sign change; otherwise
/// the isolating interval.
fn narrower<'i>(isolating: &'i Interval, known: Option<&'i Interval>) -> &'i Interval {
    let inside = |known: &&Interval| {
        known.bits >= isolating.bits && {
            let finer = known.bits - isolating.bits;
            &isolating.low << finer <= known.low && known.high <= &isolating.high << finer
        }
    };
    known.filter(inside).unwrap_or(isolating)
}

/// Narrows an interval with a sign change to a width of at most `2⁻ᵗᵃʳᵍᵉᵗ`.
///
/// The interval is divided into `2ⁿ` parts, and the part in which the chord vanishes is tested. If it contains the
/// root, `n` is doubled, otherwise halved (Abbott, *Quadratic interval refinement for real roots*). Only certified
/// signs decide.
fn refine(polynomial: &Polynomial, interval: &Interval, target: u32) -> Refined {
    let Interval {
        mut low,
        mut high,
        mut bits,
    } = interval.clone();
    let value = |point: &BigInt, bits: u32, wanted: u32| Value::at(polynomial, point, bits, wanted);
    let [mut below, mut above] = [&low, &high].map(|end| value(end, bits, bits));
    let sign = below.mantissa.sign();
    let mut parts = 1;
    loop {
        let width: BigInt = &high - &low;
        let missing = i64::from(target) - i64::from(bits) + width.bits() as i64;
        let Some(missing) = u32::try_from(missing).ok().filter(|&missing| missing > 0) else {
            return Refined::Within(Interval { low, high, bits });
        };
        let count = parts.min(missing);
        (low, high, bits) = (low << count, high << count, bits + count);
        let (start, last) = (low.clone(), (BigInt::one() << count) - BigInt::one());
        let mut part = chord(&below, &above, count).clamp(BigInt::one(), last.clone());
        // Test the ends of this part.
        for _ in 0..2 {
            if !part.is_positive() || part > last {
                break;
            }
            let point = &start + &width * &part;
            // Enough places for the next, finer division.
            let wanted = bits.saturating_add(2 * count).min(target.max(bits));
            let value = value(&point, bits, wanted);
            if value.mantissa.is_zero() {
                return Refined::Exactly(BigRational::new(point, BigInt::one() << bits));
            }
            if value.mantissa.sign() == sign {
                (low, below) = (point, value);
                part += 1;
            } else {
                (high, above) = (point, value);
                part -= 1;
            }
        }
        parts = if &high - &low <= width {
            2 * count
        } else {
            count.div_ceil(2)
        };
    }
}

/// The value of a polynomial at a point: approximately `m·2ᵉ`, with the exact sign, and zero only if the value is zero.
struct Value {
    mantissa: BigInt,
    exponent: i64,
}

impl Value {
    /// The value at `point·2⁻ᵇⁱᵗˢ`: with approximately `wanted` places if these determine the sign, exactly otherwise.
    fn at(polynomial: &Polynomial, point: &BigInt, bits: u32, wanted: u32) -> Self {
        let degree = polynomial.degree().unwrap_or(0);
        let exact = degree as u64 * u64::from(bits);
        for guard in GUARDS {
            let places = wanted.saturating_add(guard);
            // Exact arithmetic is no slower.
            if exact <= 2 * u64::from(places) {
                break;
            }
            let (middle, error) = rounded_value_at(polynomial, point, bits, places);
            if middle.bits() > error.bits() + 1 {
                return Value {
                    mantissa: middle,
                    exponent: -i64::from(places),
                };
            }
        }
        Value {
            mantissa: value_at(polynomial, point, bits),
            exponent: -(exact as i64),
        }
    }
}

/// Guard places to try for values near a root.
const GUARDS: [u32; 3] = [128, 512, 4096];

/// The value at `point·2⁻ᵇⁱᵗˢ` in units of `2⁻ᵖˡᵃᶜᵉˢ`, and a bound on its error, by Horner's scheme.
fn rounded_value_at(
    polynomial: &Polynomial,
    point: &BigInt,
    bits: u32,
    places: u32,
) -> (BigInt, BigInt) {
    // A bound on |x|, rounded up to a whole number.
    let size: BigInt = (point.abs() >> bits) + 1;
    let (mut value, mut error) = (BigInt::zero(), BigInt::zero());
    for numerator in polynomial.numerators().iter().rev() {
        // The shift rounds down by less than one unit.
        value = ((value * point) >> bits) + (numerator << places);
        error = error * &size + 1;
    }
    (value, error)
}

/// The approximate zero of the chord through the values at the ends of an interval, in units of 1/2ⁿ of its width.
fn chord(below: &Value, above: &Value, parts: u32) -> BigInt {
    let top = |value: &Value| value.mantissa.bits() as i64 + value.exponent;
    let least = top(below).max(top(above)) - i64::from(parts) - 64;
    let [below, above] = [below, above].map(|value| {
        let shift = value.exponent - least;
        let size = value.mantissa.abs();
        if shift < 0 {
            size >> -shift
        } else {
            size << shift
        }
    });
    let sum = &below + above;
    if sum.is_zero() {
        return sum;
    }
    (below << parts) / sum
}

/// Compares two real numbers by their enclosures; `None` if these overlap.
pub fn compare(a: &Interval, b: &Interval) -> Option<Ordering> {
    debug_assert_eq!(a.bits, b.bits);
    if a.high < b.low {
        Some(Ordering::Less)
    } else if b.high < a.low {
        Some(Ordering::Greater)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;
    use proptest::prelude::*;

    #[test]
    fn known_roots_are_found_and_classified() {
        // (x − 1/3)(x² − 2)(x + 5)
        let p = [[-1, 3].as_slice(), &[-2, 0, 1], &[5, 1]]
            .iter()
            .fold(Polynomial::one(), |p, c| &p * &Polynomial::from_integers(c));
        let roots = real_roots(&p);
        assert_eq!(roots.len(), 4);
        assert_eq!(roots[0], Root::Rational(ratio(-5, 1)));
        assert_eq!(roots[2], Root::Rational(ratio(1, 3)));
        let narrow = enclose(&p, &roots[3], 200);
        assert!((&narrow.high - &narrow.low) <= BigInt::from(2));
        let square = narrow.multiply(&narrow);
        assert!(square.contains(&ratio(2, 1)));
        // Starting from this enclosure, or from one that is wider than the isolating interval.
        let wide = narrow.with_bits(1);
        for known in [&narrow, &wide] {
            let finer = enclose_from(&p, &roots[3], Some(known), 400);
            assert_eq!(
                finer.with_bits(390),
                enclose(&p, &roots[3], 400).with_bits(390)
            );
        }
    }

    /// Intermediate values are rounded; the signs at the ends differ exactly.
    #[test]
    fn many_places_of_a_root_are_those_of_the_root() {
        // Legendre's polynomial of degree 6, and one with roots that are 2⁻⁴⁰ apart.
        let near = BigRational::new(BigInt::one(), BigInt::one() << 80);
        let close = Polynomial::from_rationals(&[&ratio(2, 1) - &near, ratio(0, 1), ratio(-2, 1)]);
        let close = &(&close * &Polynomial::from_integers(&[-1, 0, 1]))
            * &Polynomial::from_integers(&[-7, 1, 0, 3]);
        for p in [
            Polynomial::from_integers(&[-5, 0, 105, 0, -315, 0, 231]),
            close,
        ] {
            for root in real_roots(&p) {
                let mut known = None;
                for bits in [300, 5000, 20_000] {
                    let found = enclose_from(&p, &root, known.as_ref(), bits);
                    assert!(&found.high - &found.low <= BigInt::from(2));
                    if let Root::Irrational(_) = root {
                        let ends = [&found.low, &found.high].map(|end| sign_at(&p, end, bits));
                        assert!(ends[0] != ends[1], "{root:?}");
                    }
                    known = Some(found);
                }
            }
        }
    }

    #[test]
    fn roots_at_bisection_points_are_not_lost() {
        // 0, 1/4, 1/2, 1 and their irrational neighbours.
        let p = [
            [0, 1].as_slice(),
            &[-1, 4],
            &[-1, 2],
            &[-1, 1],
            &[-1, 0, 8],
            &[-1, 0, 5],
        ]
        .iter()
        .fold(Polynomial::one(), |p, c| &p * &Polynomial::from_integers(c));
        let roots = real_roots(&p);
        assert_eq!(roots.len(), 8);
        assert_eq!(roots.iter().filter(|r| r.rational().is_some()).count(), 4);
    }

    #[test]
    fn complex_roots_are_not_found() {
        assert_eq!(real_roots(&Polynomial::from_integers(&[1, 0, 1])).len(), 0);
        assert_eq!(
            real_roots(&Polynomial::from_integers(&[-1, 0, 0, 0, 1])).len(),
            2
        );
    }

    proptest! {
        #[test]
        fn every_rational_root_is_found(mut fractions in prop::collection::btree_set((-40i64..40, 1i64..30), 1..6)) {
            let mut values: Vec<BigRational> = fractions.iter().map(|&(n, d)| ratio(n, d)).collect();
            fractions.clear();
            values.sort();
            values.dedup();
            let p = values.iter().fold(Polynomial::from_integers(&[1, 0, 1]), |p, v| {
                &p * &Polynomial::from_rationals(&[-v, BigRational::one()])
            });
            let found: Vec<BigRational> = real_roots(&p).iter().filter_map(|r| r.rational().cloned()).collect();
            prop_assert_eq!(found, values);
        }
    }
}
