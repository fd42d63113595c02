//! Enclosures of π and of the elementary functions.
//!
//! A function is evaluated at the ends of its interval; interior extrema are added if it is not monotone. At an end,
//! the argument is reduced exactly or with a certified error. A series is summed with additional binary places; its
//! remainder and its rounding errors are bounded where they arise.
//!
//! Results are rounded outward. Their ends are within two units in the last place of the exact range, plus the width of
//! the operand in units.

use std::sync::{Mutex, PoisonError};

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::interval::Interval;

/// The largest argument of [`exp`]; its exponential has 94,548 bits before the binary point.
pub const LARGEST_EXPONENT: u32 = 1 << 16;

/// An enclosure of π, at most two units wide.
pub fn pi(bits: u32) -> Interval {
    /// The finest enclosure so far; every evaluation of `wave` needs π.
    static FINEST: Mutex<Option<Interval>> = Mutex::new(None);
    let mut finest = FINEST.lock().unwrap_or_else(PoisonError::into_inner);
    // With 64 extra places, so that the rounded result does not depend on the precision of the stored value.
    let known = match finest.take().filter(|known| known.bits >= bits + 64) {
        Some(known) => known,
        None => compute_pi(bits + 64),
    };
    finest.insert(known).with_bits(bits)
}

fn compute_pi(bits: u32) -> Interval {
    // 1/π = 12·Σ (−1)ᵏ (6k)! (13591409 + 545140134k)/((3k)! k!³ 640320^(3k+3/2)) (Chudnovsky). The terms
    // alternate and fall by at least 2⁻⁴¹ each, so the relative error after n terms is below
    // 2^(1−41n): less than one unit here.
    let fine = bits + 4;
    let (_, q, t) = chudnovsky(0, fine / 41 + 2);
    let root = (BigInt::from(10005) << (2 * u64::from(fine))).sqrt();
    // The root is less than one unit too small, which is 426880·q/t < 1/30 units of the quotient; the
    // quotient is rounded down by less than one unit.
    let value = root * q * 426_880 / t;
    Interval {
        low: &value - 3,
        high: value + 3,
        bits: fine,
    }
    .with_bits(bits)
}

/// The terms `from..to` of Chudnovsky's series as `(p, q, t)`: their sum is `t/q`, and `p/q` is the factor of the terms
/// that follow.
fn chudnovsky(from: u32, to: u32) -> (BigInt, BigInt, BigInt) {
    if from + 1 < to {
        let middle = from.midpoint(to);
        let (p1, q1, t1) = chudnovsky(from, middle);
        let (p2, q2, t2) = chudnovsky(middle, to);
        return (&p1 * p2, q1 * &q2, q2 * t1 + p1 * t2);
    }
    let k = BigInt::from(from);
    let linear = &k * 545_140_134 + 13_591_409;
    if from == 0 {
        return (BigInt::one(), BigInt::one(), linear);
    }
    let factors: [BigInt; 3] = [&k * 6 - 5, &k * 2 - 1, &k * 6 - 1];
    let p = -factors.iter().product::<BigInt>();
    // 640320³/24
    let q = &k * &k * &k * 10_939_058_860_032_000u64;
    let t = &p * linear;
    (p, q, t)
}

/// The exponential function; `None` if the upper end exceeds [`LARGEST_EXPONENT`].
pub fn exp(x: &Interval) -> Option<Interval> {
    if &x.high >> x.bits > BigInt::from(LARGEST_EXPONENT) {
        return None;
    }
    let low = exp_of_point(&x.low, x.bits);
    let width = &x.high - &x.low;
    let high = if width.is_zero() {
        low.high
    } else if width.bits() <= u64::from(x.bits) {
        // eʷ ≤ 1 + w + w² for w ≤ 1.
        let growth: BigInt = &width + ((&width * &width) >> x.bits) + 1;
        &low.high + ((&low.high * growth) >> x.bits) + 1
    } else {
        exp_of_point(&x.high, x.bits).high
    };
    Some(Interval {
        low: low.low,
        high,
        bits: x.bits,
    })
}

/// `exp(point·2⁻ᵇⁱᵗˢ)`.
fn exp_of_point(point: &BigInt, bits: u32) -> Interval {
    let size = point.abs();
    let whole = (&size >> bits).to_u32().unwrap_or(u32::MAX);
    if point.is_negative() && whole >= bits {
        // 0 < e⁻ⁿ < 2⁻ⁿ.
        return Interval {
            low: BigInt::zero(),
            high: BigInt::one(),
            bits,
        };
    }
    // e^|x| = (e^r)^(2^h) with r = |x|/2ʰ < 2⁻¹. Every squaring doubles the relative error, and the
    // result has less than 3/2·|x| + 2 bits before the binary point.
    let growth = if point.is_negative() {
        0
    } else {
        whole + whole / 2 + 2
    };
    let halvings = (32 - whole.leading_zeros()) + (bits + growth).isqrt() / 2 + 2;
    let fine = bits + growth + halvings + 2 * (32 - (bits + growth).leading_zeros()) + 10;
    let r = size << (fine - bits - halvings);
    let mut term = BigInt::one() << fine;
    let mut sum = term.clone();
    let mut n = 0u32;
    while !term.is_zero() {
        n += 1;
        term = ((term * &r) >> fine) / n;
        sum += &term;
    }
    // The two roundings of a term lower it by less than 2 units; with half of the error of the previous term this adds
    // up to less than 4. Each omitted term is less than half of its predecessor; together they are less than 5 units.
    let mut error = BigInt::from(4 * n + 10);
    for _ in 0..halvings {
        // (p + e)² − p² = 2pe + e², and each of the two shifts rounds by less than one unit.
        error = ((&error * (&error + (&sum << 1u32))) >> fine) + 2;
        sum = (&sum * &sum) >> fine;
    }
    let mut power = Interval {
        low: sum.clone(),
        high: sum + error,
        bits: fine,
    };
    if point.is_negative() {
        let one = BigInt::one() << fine;
        let one = Interval {
            low: one.clone(),
            high: one,
            bits: fine,
        };
        power = one.divide(&power).unwrap_or(power);
    }
    power.with_bits(bits)
}

/// The natural logarithm; `None` unless the lower end is positive.
pub fn ln(x: &Interval) -> Option<Interval> {
    if !x.low.is_positive() {
        return None;
    }
    let low = ln_of_point(&x.low, x.bits);
    let width = &x.high - &x.low;
    let excess = 2 * (x.low.bits() as i64 - 1 - width.bits() as i64);
    let high = if width.is_zero() {
        low.high
    } else if excess >= i64::from(x.bits) {
        // ln(x + w) ≤ ln x + w/x; this bound is at most one unit too large.
        &low.high + (width << x.bits).div_ceil(&x.low)
    } else {
        ln_of_point(&x.high, x.bits).high
    };
    Some(Interval {
        low: low.low,
        high,
        bits: x.bits,
    })
}

/// `ln(point·2⁻ᵇⁱᵗˢ)` for a positive point.
fn ln_of_point(point: &BigInt, bits: u32) -> Interval {
    // x = m·2ᵏ with 1 ≤ m < 2, and ln m = 2ʰ·ln z for the 2ʰ-th root z of m.
    let k = point.bits() as i64 - 1 - i64::from(bits);
    let halvings = bits.isqrt() / 2 + 2;
    let length = |n: u64| 64 - n.leading_zeros();
    let fine = bits + halvings + length(u64::from(bits)) + length(k.unsigned_abs()) + 12;
    let shift = i64::from(fine) + 1 - point.bits() as i64;
    let mut z = if shift >= 0 {
        point << shift
    } else {
        point >> -shift
    };
    // The exact number lies in [z, z + 2]: the root halves the distance and adds less than 1.
    for _ in 0..halvings {
        z = (z << fine).sqrt();
    }
    // ln z = 2·artanh u with u = (z − 1)/(z + 1) < 1/3.
    let one = BigInt::one() << fine;
    let u = ((&z - &one) << fine) / (z + one);
    let square = (&u * &u) >> fine;
    let (mut power, mut sum, mut n) = (u, BigInt::zero(), 0u32);
    while !power.is_zero() {
        sum += &power / (2 * n + 1);
        power = (power * &square) >> fine;
        n += 1;
    }
    // u is less than 2 units too small, and artanh' ≤ 9/8. Every term is less than 3 units too small, and the remainder
    // is less than 4.
    let artanh = Interval {
        low: sum.clone(),
        high: sum + (3 * n + 7),
        bits: fine,
    };
    let doubled = Interval {
        low: artanh.low << (halvings + 1),
        high: artanh.high << (halvings + 1),
        bits: fine,
    };
    let whole = BigRational::from_integer(k.into());
    doubled.add(&ln_2(fine).scale(&whole)).with_bits(bits)
}

/// ln 2 = 18·artanh(1/26) − 2·artanh(1/4801) + 8·artanh(1/8749).
fn ln_2(bits: u32) -> Interval {
    let artanh = |reciprocal: u32| {
        let mut power = (BigInt::one() << bits) / reciprocal;
        let (mut sum, mut n) = (BigInt::zero(), 0u32);
        while !power.is_zero() {
            sum += &power / (2 * n + 1);
            power /= reciprocal * reciprocal;
            n += 1;
        }
        // Every power is less than 2 units too small, and its quotient less than 3; the remainder is less than 4.
        let high = &sum + (3 * n + 4);
        Interval {
            low: sum,
            high,
            bits,
        }
    };
    let times = |factor: i64, x: Interval| x.scale(&super::rational::ratio(factor, 1));
    times(18, artanh(26))
        .add(&times(-2, artanh(4801)))
        .add(&times(8, artanh(8749)))
}

/// The cosine.
pub fn cos(x: &Interval) -> Interval {
    wave(x, 0)
}

/// The sine.
pub fn sin(x: &Interval) -> Interval {
    wave(x, 1)
}

/// `cos(x − quarter·π/2)`.
fn wave(x: &Interval, quarter: u32) -> Interval {
    let bits = x.bits;
    let one = BigInt::one() << bits;
    let width = &x.high - &x.low;
    if width >= &one * 7 {
        return Interval {
            low: -&one,
            high: one,
            bits,
        };
    }
    // π/2, with additional binary places for the bits of the argument before the binary point.
    let fine = bits + x.magnitude_bits().max(0) as u32 + 8;
    let half_pi = Interval {
        bits: fine + 1,
        ..pi(fine)
    };
    let [low, high] = [&x.low, &x.high].map(|end| end << (half_pi.bits - bits));
    // |cos'| ≤ 1: one evaluation is enough for a narrow interval.
    if width <= BigInt::from(256) {
        let start = wave_of_point(&low, quarter, &half_pi, bits);
        return Interval {
            low: (start.low - &width).max(-&one),
            high: (start.high + width).min(one),
            bits,
        };
    }
    // The multiples n·π/2 in the interval. A multiple that lies outside by less than a rounding error is harmless: the
    // function is within a rounding error of its extremum.
    let over = |end: &BigInt, outer: &BigInt, inner: &BigInt| {
        end.div_floor(if end.is_negative() { inner } else { outer })
    };
    let first: BigInt = -over(&-&low, &half_pi.low, &half_pi.high);
    let last = over(&high, &half_pi.low, &half_pi.high);
    let meets = |phase: u32| {
        let steps: BigInt = BigInt::from(quarter + phase) - &first;
        first.clone() + steps.mod_floor(&BigInt::from(4)) <= last
    };
    let start = wave_of_point(&low, quarter, &half_pi, bits);
    let end = wave_of_point(&high, quarter, &half_pi, bits);
    Interval {
        low: if meets(2) {
            -&one
        } else {
            start.low.min(end.low).max(-&one)
        },
        high: if meets(0) {
            one
        } else {
            start.high.max(end.high).min(one)
        },
        bits,
    }
}

/// The cosine of `point − quarter·π/2` with `bits` binary places; `point` has as many binary places as π/2.
fn wave_of_point(point: &BigInt, quarter: u32, half_pi: &Interval, bits: u32) -> Interval {
    let turn: BigInt = &half_pi.low << 2u32;
    let shifted = point - &half_pi.low * quarter;
    let turns = (shifted + (&turn >> 1u32)).div_floor(&turn);
    let quarters: BigInt = turns * 4 + quarter;
    let reduced = half_pi.scale(&BigRational::from_integer(-quarters));
    // The reduced argument lies within `slack` of its lower end, and |cos'| ≤ 1.
    let slack = &reduced.high - &reduced.low;
    let y = (reduced.low + point).abs();
    let cosine = cos_of_reduced(&y, half_pi.bits);
    Interval {
        low: cosine.low - &slack,
        high: cosine.high + slack,
        bits: half_pi.bits,
    }
    .with_bits(bits)
}

/// The cosine of `y·2⁻ᵇⁱᵗˢ` for `0 ≤ y·2⁻ᵇⁱᵗˢ ≤ 4`.
fn cos_of_reduced(y: &BigInt, bits: u32) -> Interval {
    // cos 2θ = 2cos²θ − 1 multiplies the error by 4; θ = y/2ʰ ≤ 1/2.
    let halvings = bits.isqrt() / 2 + 3;
    let fine = bits + 2 * halvings + 2 * (32 - bits.leading_zeros()) + 6;
    let theta = y << (fine - bits - halvings);
    let square = (&theta * &theta) >> fine;
    let one = BigInt::one() << fine;
    let (mut term, mut sum, mut n) = (one.clone(), BigInt::zero(), 0u32);
    while !term.is_zero() {
        if n.is_multiple_of(2) {
            sum += &term;
        } else {
            sum -= &term;
        }
        term = ((term * &square) >> fine) / ((2 * n + 1) * (2 * n + 2));
        n += 1;
    }
    // Every term is less than 3 units too small, and so is the remainder.
    let mut error = BigInt::from(3 * n + 5);
    for _ in 0..halvings {
        // 2(c + e)² − 2c² = 4ce + 2e² with |c| ≤ 1, and each of the two shifts rounds by less than one unit.
        sum = ((&sum * &sum) >> (fine - 1)) - &one;
        error = (&error << 2u32) + ((&error * &error) >> (fine - 1)) + 2;
    }
    Interval {
        low: &sum - &error,
        high: sum + error,
        bits: fine,
    }
    .with_bits(bits)
}

/// The square root; `None` if the lower end is negative.
///
/// If the number is known to be nonnegative, restrict the interval first by [`Interval::nonnegative`].
pub fn sqrt(x: &Interval) -> Option<Interval> {
    root(x, 2)
}

/// The real root of order `n`; `None` for `n = 0`, and for even `n` if the lower end is negative.
pub fn root(x: &Interval, n: u32) -> Option<Interval> {
    if n == 0 || n.is_multiple_of(2) && x.low.is_negative() {
        return None;
    }
    // `nth_root` truncates towards zero; `step` corrects the end that must be rounded outward.
    let rooted = |end: &BigInt, step: i32| {
        let scaled = end << (u64::from(x.bits) * u64::from(n - 1));
        let root = scaled.nth_root(n);
        if step != 0 && root.pow(n) != scaled {
            root + step
        } else {
            root
        }
    };
    Some(Interval {
        low: rooted(&x.low, -i32::from(x.low.is_negative())),
        high: rooted(&x.high, i32::from(x.high.is_positive())),
        bits: x.bits,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::{parse, ratio};
    use proptest::prelude::*;

    /// The decimal `digits·10^(−places)` differs from the number by at most one unit.
    fn agrees(interval: &Interval, digits: &str, places: u32) {
        let value = BigRational::new(
            digits.parse().expect("digits"),
            BigInt::from(10).pow(places),
        );
        let unit = BigRational::new(BigInt::one(), BigInt::from(10).pow(places));
        assert!(
            interval.low() - &unit <= value && value <= interval.high() + unit,
            "{digits}"
        );
        assert!(interval.width_bits() <= 8 - i64::from(interval.bits()));
    }

    fn point(value: &BigRational, bits: u32) -> Interval {
        Interval::enclosing(value, bits)
    }

    #[test]
    fn elementary_functions_agree_with_known_digits() {
        agrees(
            &pi(200),
            "314159265358979323846264338327950288419716939937510",
            50,
        );
        let one = point(&ratio(1, 1), 200);
        let e = exp(&one).expect("small");
        agrees(
            &e,
            "271828182845904523536028747135266249775724709369995",
            50,
        );
        agrees(
            &sin(&one),
            "84147098480789650665250232163029899962256306079837",
            50,
        );
        agrees(
            &ln(&point(&ratio(2, 1), 200)).expect("positive"),
            "69314718055994530941723212145817656807550013436026",
            50,
        );
        let huge = point(&BigRational::from_integer(BigInt::from(10).pow(22)), 150);
        agrees(&sin(&huge), "-8522008497671888017727058937530293682618", 40);
        let small = exp(&point(&ratio(-50, 1), 250)).expect("small");
        agrees(&small, "1928749847963917783017343", 46);
    }

    #[test]
    fn huge_arguments_are_reduced() {
        // sin² + cos² = 1 and the double-angle formula hold only for the correct reduced argument.
        let x = point(&BigRational::from_integer(BigInt::from(10).pow(300)), 200);
        let twice = point(
            &BigRational::from_integer(BigInt::from(10).pow(300) * 2),
            200,
        );
        let (s, c) = (sin(&x), cos(&x));
        let sum = s.multiply(&s).add(&c.multiply(&c));
        assert!(sum.contains(&ratio(1, 1)) && sum.width_bits() < -190);
        let doubled = s.multiply(&c).scale(&ratio(2, 1));
        assert!(crate::roots::compare(&doubled, &sin(&twice)).is_none());
    }

    #[test]
    fn elementary_functions_return_none_outside_their_domain() {
        let (minus, zero) = (point(&ratio(-1, 1), 20), point(&ratio(0, 1), 20));
        assert!(ln(&minus).is_none() && ln(&zero).is_none() && sqrt(&minus).is_none());
        assert!(root(&minus, 3).is_some() && root(&minus, 0).is_none());
        assert!(exp(&point(&ratio(70_000, 1), 20)).is_none());
        assert!(exp(&point(&ratio(-70_000, 1), 20)).is_some());
        assert_eq!(sqrt(&zero), Some(zero.clone()));
        assert!(exp(&zero).expect("small").contains(&ratio(1, 1)));
        assert!(
            ln(&point(&ratio(1, 1), 20))
                .expect("positive")
                .contains(&ratio(0, 1))
        );
    }

    #[test]
    fn sine_and_cosine_of_intervals_include_their_extrema() {
        let between = |a: i64, b: i64| Interval {
            low: BigInt::from(a) << 20u32,
            high: BigInt::from(b) << 20u32,
            bits: 20,
        };
        let whole = Interval {
            low: -(BigInt::one() << 20u32),
            high: BigInt::one() << 20u32,
            bits: 20,
        };
        assert_eq!(cos(&between(-100, 100)), whole);
        assert_eq!(
            cos(&between(0, 6)),
            Interval {
                high: whole.high.clone(),
                ..whole.clone()
            }
        );
        assert_eq!(sin(&between(1, 2)).high, whole.high);
        assert_eq!(sin(&between(4, 5)).low, whole.low);
        assert_eq!(cos(&between(-1, 1)).high, whole.high);
        assert!(sin(&between(-1, 1)).low > whole.low && sin(&between(-1, 1)).high < whole.high);
    }

    #[test]
    fn enclosures_in_many_places_lie_within_those_in_few() {
        let x = parse("355/113").expect("a rational");
        let functions: [fn(&Interval) -> Option<Interval>; 5] =
            [exp, ln, |x| Some(sin(x)), |x| Some(cos(x)), sqrt];
        for function in functions {
            let fine = function(&point(&x, 4000)).expect("defined");
            assert!(fine.width_bits() < -3990);
            for bits in [1, 2, 3, 7, 64, 256, 1000] {
                let coarse = function(&point(&x, bits)).expect("defined");
                assert!(
                    coarse.low() <= fine.low() && fine.high() <= coarse.high(),
                    "{bits}"
                );
            }
        }
        for bits in [0, 1, 5, 40, 41, 42, 300] {
            let (coarse, fine) = (pi(bits), pi(2000));
            assert!(
                coarse.low() <= fine.low() && fine.high() <= coarse.high(),
                "{bits}"
            );
        }
    }

    proptest! {
        #[test]
        fn enclosures_contain_the_values_of_doubles(n in -40_000i64..40_000, spread in 0i64..1_000_000_000) {
            let x = ratio(n, 1000);
            let mut i = point(&x, 60);
            i.low -= spread;
            i.high += spread;
            let f = n as f64 / 1000.0;
            let close = |interval: Interval, value: f64| {
                let size = value.abs().max(1.0) * 1e-14;
                let unit = |v: f64| BigRational::from_float(v).expect("finite");
                interval.low() <= unit(value + size) && unit(value - size) <= interval.high()
                    && interval.width() <= unit((spread as f64 / 5e17 + 1e-16) * 10.0 * value.abs().max(1.0))
            };
            prop_assert!(close(sin(&i), f.sin()) && close(cos(&i), f.cos()));
            prop_assert!(close(exp(&i).expect("small"), f.exp()));
            if n > 100 {
                prop_assert!(close(ln(&i).expect("positive"), f.ln()) && close(sqrt(&i).expect("positive"), f.sqrt()));
            }
        }

        #[test]
        fn enclosures_satisfy_the_identities_of_elementary_functions(n in 1i64..1_000_000, d in 1i64..1000, bits in 20u32..300) {
            let x = ratio(n, d);
            let i = point(&x, bits);
            let (s, c) = (sin(&i), cos(&i));
            prop_assert!(s.multiply(&s).add(&c.multiply(&c)).contains(&ratio(1, 1)));
            let back = exp(&ln(&i).expect("positive")).expect("small");
            prop_assert!(back.contains(&x));
            prop_assert!(sqrt(&i).expect("positive").power(2).contains(&x));
            prop_assert!(root(&i.negate(), 3).expect("odd").power(3).contains(&-&x));
        }
    }
}
