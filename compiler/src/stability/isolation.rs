//! Simple positive roots of polynomials with enclosed coefficients.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::algebra::Ball;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::dyadic;

/// Half-open intervals `(low, high]·2⁻ᵇⁱᵗˢ` in ascending order that contain all positive roots. In each, the polynomial has at most
/// one root, where it changes its sign.
///
/// With `f(m + ry) = Σ c_k yᵏ` there is no root for `|y| ≤ 1` if `|c_0| > Σ_{k>0} |c_k|`, and `f` is monotonic if
/// `|c_1| > Σ_{k>1} k|c_k|`. `None` if the enclosures are too wide to tell.
pub(super) fn monotonic(coefficients: &[Ball], precision: u32) -> Option<Vec<Interval>> {
    let windows = windows(coefficients)?.into_iter();
    let found = windows.map(|window| monotonic_within(coefficients, &window, precision));
    Some(found.collect::<Option<Vec<_>>>()?.concat())
}

/// Intervals `(low, high]` in ascending order that contain all positive roots. Outside of them one term is larger than all others
/// together. `None` if the leading coefficient may be zero.
///
/// The ends are powers of two, near the slopes of the Newton polygon, or zero.
fn windows(coefficients: &[Ball]) -> Option<Vec<Interval>> {
    coefficients.last()?.least_magnitude()?;
    let mut windows = Vec::new();
    let mut low = None;
    for k in 0..coefficients.len() {
        let Some((first, last)) = dominated(coefficients, k) else {
            continue;
        };
        windows.extend(
            first
                .filter(|&high| low < Some(high))
                .map(|high| window(low, high)),
        );
        low = last;
    }
    Some(windows)
}

/// The first and the last exponent `e` for which the term of degree `k` is larger than all others together at `x = 2ᵉ`. The first
/// is `None` if there is no lower bound.
fn dominated(coefficients: &[Ball], k: usize) -> Option<(Option<i64>, Option<i64>)> {
    let least = coefficients[k].least_magnitude()?;
    // An upper bound on the number of terms, as a power of two.
    let terms = i64::from(usize::BITS - coefficients.len().leading_zeros());
    let excess = |c: &Ball| c.magnitude() + terms - least;
    let nonzero = |c: &&Ball| c.sign() != Some(Ordering::Equal);
    let (below, above) = (&coefficients[..k], &coefficients[k + 1..]);
    let below = (1..).zip(below.iter().rev()).filter(|(_, c)| nonzero(c));
    let first = below.map(|(n, c)| -(-excess(c)).div_euclid(n)).max();
    let above = (1..).zip(above).filter(|(_, c)| nonzero(c));
    let last = above.map(|(n, c)| (-excess(c)).div_euclid(n)).min();
    let empty = matches!((first, last), (Some(first), Some(last)) if first > last);
    (!empty).then_some((first, last))
}

/// The interval between powers of two, or from zero.
fn window(low: Option<i64>, high: i64) -> Interval {
    let bits = (-low.unwrap_or(high)).max(0);
    let power = |exponent: i64| BigInt::one() << (exponent + bits);
    Interval {
        low: low.map_or_else(BigInt::zero, power),
        high: power(high),
        bits: bits as u32,
    }
}

/// [`monotonic`] for the roots in one half-open interval `(low, high]`.
pub(super) fn monotonic_within(
    coefficients: &[Ball],
    interval: &Interval,
    precision: u32,
) -> Option<Vec<Interval>> {
    let Interval { low, high, bits } = interval.clone();
    let first_bits = bits;
    let spread = match low.is_zero() {
        true => 0,
        false => high.bits() - low.bits(),
    };
    let deepest = u64::from(precision) + spread;
    let mut found = Vec::new();
    let whole = local(coefficients, &low, &high, bits, precision);
    let words = coefficients.len().pow(2) * (precision / 64 + OVERHEAD) as usize;
    let mut left = (MAX_WORDS / words).max(FEWEST_PARTS);
    // The leftmost interval on top.
    let mut pending = vec![(low, high, bits, whole)];
    while let Some((low, high, bits, shifted)) = pending.pop() {
        let depth = bits - first_bits;
        // The root may be a double root, at any distance.
        let undecided = |list: &[Ball]| {
            let mut lowest = list.iter().take(2);
            list.len() > 1 && lowest.all(|c| c.sign().is_none())
        };
        let shifted = if depth > 0 && depth.is_multiple_of(HALVINGS) || undecided(&shifted) {
            local(coefficients, &low, &high, bits, precision)
        } else {
            shifted
        };
        if undecided(&shifted) {
            return None;
        }
        // Σ |c_k| binom(k, m) over the terms with k ≥ `first`.
        let sum = |first: usize, derivative: usize| {
            let terms = shifted.iter().enumerate().skip(first);
            terms.fold(None, |sum: Option<Ball>, (k, c)| {
                let size = match derivative {
                    0 => c.size(),
                    1 => c.size().multiply(&Ball::whole(k), precision),
                    _ => c.size().multiply(&Ball::whole(k * (k - 1) / 2), precision),
                };
                Some(match sum {
                    Some(sum) => sum.add(&size, precision),
                    None => size,
                })
            })
        };
        let excess = |k: usize, rest: Option<Ball>| {
            let size = shifted.get(k)?.size();
            let difference = match rest {
                Some(rest) => size.add(&rest.negate(), precision),
                None => size,
            };
            (difference.sign() == Some(Ordering::Greater)).then_some(difference)
        };
        if excess(0, sum(1, 0)).is_some() {
            continue;
        }
        if excess(1, sum(2, 1)).is_some() {
            found.push(Interval { low, high, bits });
            continue;
        }
        if let Some(bend) = excess(2, sum(3, 2)) {
            let exact = local(coefficients, &low, &high, bits, precision);
            match vertex(&exact, &bend, precision) {
                Some(Vertex::NoRoot) => continue,
                Some(Vertex::Outside) => {
                    found.push(Interval { low, high, bits });
                    continue;
                }
                Some(Vertex::Undecided) => return None,
                Some(Vertex::Beyond { y, places }) => {
                    // m + ry in units of 2⁻ᵇⁱᵗˢ⁻ᵖˡᵃᶜᵉˢ⁻¹.
                    let middle = ((&low + &high) << places) + (&high - &low) * y;
                    let finer = places + 1;
                    let bits = bits + finer;
                    let (low, high) = (low << finer, high << finer);
                    let ends = [(low, middle.clone()), (middle, high)];
                    found.extend(ends.map(|(low, high)| Interval { low, high, bits }));
                    continue;
                }
                None => {}
            }
        }
        left = left.saturating_sub(1);
        if u64::from(depth) > deepest || left == 0 {
            return None;
        }
        let (low, high) = (low << 1, high << 1);
        let middle: BigInt = (&low + &high) >> 1;
        let half = |right: bool| half(&shifted, right, precision.min(COARSE));
        pending.push((middle.clone(), high, bits + 1, half(true)));
        pending.push((low, middle, bits + 1, half(false)));
    }
    Some(found)
}

/// Binary places of a point between two roots that are tried first.
const FIRST_PLACES: u32 = 4;

/// The extremum of a polynomial that is convex or concave for `|y| ≤ 1`, relative to zero.
enum Vertex {
    /// The polynomial has no root.
    NoRoot,
    /// The extremum is outside the interval: the polynomial is monotonic.
    Outside,
    /// The polynomial has the other sign at `y·2⁻ᵖˡᵃᶜᵉˢ`: at most one root is on either side of that point.
    Beyond { y: BigInt, places: u32 },
    /// The extremum cannot be distinguished from zero: there may be a double root.
    Undecided,
}

/// The vertex of a polynomial `f = Σ c_k yᵏ` with `|f''| ≥ 2·bend` for `|y| ≤ 1`; `None` if it is not found in the interval.
///
/// With `f'(z) = s` and `f'' > 0`, the minimum is at least `f(z) − s²/(4·bend)`.
fn vertex(coefficients: &[Ball], bend: &Ball, precision: u32) -> Option<Vertex> {
    let derivative = |list: &[Ball]| -> Vec<Ball> {
        let terms = list.iter().enumerate().skip(1);
        terms
            .map(|(k, c)| c.multiply(&Ball::whole(k), precision))
            .collect()
    };
    let at = |list: &[Ball], y: &Ball| {
        let terms = list.iter().rev().cloned();
        terms.reduce(|value, c| value.multiply(y, precision).add(&c, precision))
    };
    let side = coefficients.get(2)?.sign()?;
    let slopes = derivative(coefficients);
    let bends = derivative(&slopes);
    let one = Ball::whole(1);
    let slope = |y: &Ball| at(&slopes, y)?.sign();
    match [slope(&one.negate())?, slope(&one)?] {
        // Zero at an end point.
        [first, last] if first.is_eq() || last.is_eq() => return None,
        [first, last] if first == last => return Some(Vertex::Outside),
        // The slope has one root in the interval.
        _ => {}
    }
    let dyadic = |y: &BigInt| Ball::dyadic(y.clone(), -i64::from(precision), u32::MAX);
    let unit = BigInt::one() << precision;
    let mut y = BigInt::zero();
    // Newton's iteration doubles the places once it is near the root.
    for _ in 0..=2 * precision.ilog2() {
        let here = dyadic(&y);
        let change =
            at(&slopes, &here)?.multiply(&at(&bends, &here)?.inverse(precision)?, precision);
        let change = change.interval(precision);
        let change: BigInt = (change.low + change.high) >> 1;
        if change.is_zero() {
            break;
        }
        y = (y - change).clamp(-&unit, unit.clone());
    }
    let here = dyadic(&y);
    let value = at(coefficients, &here)?;
    let Some(sign) = value.sign() else {
        return Some(Vertex::Undecided);
    };
    if sign.is_eq() {
        return None;
    }
    if sign != side {
        // As few places as suffice.
        let mut places = FIRST_PLACES.min(precision);
        loop {
            let coarse: BigInt = &y >> (precision - places);
            let point = Ball::dyadic(coarse.clone(), -i64::from(places), u32::MAX);
            let beyond = at(coefficients, &point)?.sign() == Some(sign);
            if beyond && coarse.bits() <= u64::from(places) {
                return Some(Vertex::Beyond { y: coarse, places });
            }
            if places == precision {
                return None;
            }
            places = (2 * places).min(precision);
        }
    }
    let slope = at(&slopes, &here)?.size();
    let below = slope.multiply(&slope, precision);
    let below = below
        .multiply(&bend.inverse(precision)?, precision)
        .shifted(-2);
    let least = value.size().add(&below.negate(), precision);
    (least.sign() == Some(Ordering::Greater)).then_some(Vertex::NoRoot)
}

/// Halvings after which the coefficients are recomputed: each halving costs one binary place.
const HALVINGS: u32 = 32;
/// Bits of the coefficients in between, which only need to give magnitudes.
const COARSE: u32 = 192;

/// Sums of machine words that may be spent on one interval: about a tenth of a second.
const MAX_WORDS: usize = 1 << 25;
/// The number of parts of an interval that are examined in any case.
const FEWEST_PARTS: usize = 1 << 12;
/// The overhead of one addition, in machine words.
const OVERHEAD: u32 = 32;

/// Narrows an isolating interval, at whose ends a function has different signs, to this many binary places, or
/// until a sign is not known.
///
/// The interval is cut into `2ⁿ` parts, and the root is sought in the part in which the chord vanishes. If it is there,
/// `n` is doubled, otherwise halved (Abbott, *Quadratic interval refinement for real roots*). `value_at` returns a
/// value whose sign is known.
pub(super) fn narrow(
    interval: &Interval,
    bits: u32,
    value_at: impl Fn(&BigRational) -> Option<Ball>,
) -> Interval {
    let value = |n: &BigInt, places: u32| value_at(&dyadic(n, places));
    let Interval {
        mut low,
        mut high,
        bits: mut places,
    } = interval.clone();
    let (Some(mut below), Some(mut above)) = (value(&low, places), value(&high, places)) else {
        return interval.with_bits(bits);
    };
    let mut parts = 1;
    loop {
        let width = &high - &low;
        let excess = i64::from(bits) - i64::from(places) + width.bits() as i64;
        if excess <= 0 || excess == 1 && width == BigInt::one() << (places.saturating_sub(bits)) {
            break;
        }
        let count = parts.min(u32::try_from(excess).unwrap_or(u32::MAX));
        (low, high, places) = (low << count, high << count, places + count);
        let (start, last) = (low.clone(), (BigInt::one() << count) - BigInt::one());
        let mut part = chord(&below, &above, count).clamp(BigInt::one(), last.clone());
        // The ends of the part that should contain the root.
        for _ in 0..2 {
            if !part.is_positive() || part > last {
                break;
            }
            let point = &start + &width * &part;
            let Some(found) = value(&point, places) else {
                return Interval {
                    low,
                    high,
                    bits: places,
                }
                .with_bits(bits);
            };
            if found.sign() == Some(Ordering::Equal) {
                return Interval::enclosing(&dyadic(&point, places), bits);
            }
            if found.sign() == below.sign() {
                (low, below) = (point, found);
                part += 1;
            } else {
                (high, above) = (point, found);
                part -= 1;
            }
        }
        parts = if &high - &low <= width {
            2 * count
        } else {
            count.div_ceil(2)
        };
    }
    Interval {
        low,
        high,
        bits: places,
    }
    .with_bits(bits)
}

/// Approximate zero of the chord between the values at the ends of an interval, in `2ⁿ` parts of it.
fn chord(below: &Ball, above: &Ball, parts: u32) -> BigInt {
    let bits = parts + 64;
    let (below, above) = (below.size(), above.size());
    let inverse = below.add(&above, bits).inverse(bits);
    let fraction = inverse.map(|inverse| below.multiply(&inverse, bits));
    let half = || Ball::dyadic(BigInt::one(), -1, 1);
    let scaled = fraction.unwrap_or_else(half).shifted(i64::from(parts));
    scaled.interval(0).low
}

/// The coefficients of `f((z ± 1)/2)` from those of `f(y)`: halves of the interval `|y| ≤ 1`, by additions alone. Each
/// halving costs about one binary place.
fn half(coefficients: &[Ball], right: bool, precision: u32) -> Vec<Ball> {
    let halved = (0..).zip(coefficients).map(|(k, c): (i64, &Ball)| {
        // With −z for z on the left, so that the shift is positive on both sides.
        let c = c.with_bits(precision).shifted(-k);
        if right || k % 2 == 0 { c } else { c.negate() }
    });
    let mut list: Vec<Ball> = halved.collect();
    for first in 0..list.len() {
        for k in (first..list.len() - 1).rev() {
            list[k] = list[k].add(&list[k + 1], precision);
        }
    }
    if !right {
        let odd = list.iter_mut().skip(1).step_by(2);
        odd.for_each(|c| *c = c.negate());
    }
    list
}

/// The coefficients of `f(m + ry)` for the interval `m ± r`.
fn local(
    coefficients: &[Ball],
    low: &BigInt,
    high: &BigInt,
    bits: u32,
    precision: u32,
) -> Vec<Ball> {
    let half = |n: BigInt| Ball::dyadic(n, -i64::from(bits) - 1, precision);
    let (middle, radius) = (half(low + high), half(high - low));
    let mut list = coefficients.to_vec();
    for first in 0..list.len() {
        for k in (first..list.len() - 1).rev() {
            list[k] = list[k].add(&list[k + 1].multiply(&middle, precision), precision);
        }
    }
    let mut power = Ball::whole(1);
    for c in &mut list {
        *c = c.multiply(&power, precision);
        power = power.multiply(&radius, precision);
    }
    list
}

/// An exponent `n` such that all roots are below `2ⁿ` in magnitude (Fujiwara).
pub(super) fn root_bound(coefficients: &[Ball]) -> Option<i64> {
    let (leading, rest) = coefficients.split_last()?;
    let top = leading.least_magnitude()?;
    let degrees = (1i64..).zip(rest.iter().rev());
    let nonzero = degrees.filter(|(_, c)| c.sign() != Some(Ordering::Equal));
    // Rounded up, and a factor of 2.
    let bounds = nonzero.map(|(k, c)| (c.magnitude() - top).div_euclid(k) + 2);
    Some(bounds.max().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Balls, Field};
    use crate::arithmetic::polynomial::Polynomial;
    use crate::arithmetic::rational::ratio;

    fn found(coefficients: &[i64], shift: i64) -> Option<Vec<Interval>> {
        let balls = Balls::new(200);
        let list = (0..).zip(coefficients);
        let ball = |(k, &c): (i64, &i64)| balls.rational(&ratio(c, 1)).shifted(shift * k);
        monotonic(&list.map(ball).collect::<Vec<_>>(), 200)
    }

    #[test]
    fn roots_are_in_different_intervals() {
        // (x − 1)(x − 2)(x − 3)(x² + 1), and the same in 2ˢx
        let product = [-6, 11, -12, 12, -6, 1];
        for shift in [0, 500, -500] {
            let intervals = found(&product, shift).expect("told apart");
            let holds = |root: i64| {
                let root = match shift {
                    500 => ratio(root, 1) / ratio(2, 1).pow(500),
                    -500 => ratio(root, 1) * ratio(2, 1).pow(500),
                    _ => ratio(root, 1),
                };
                intervals.iter().position(|i| i.contains(&root))
            };
            let places: Vec<_> = (1..4).map(|k| holds(k).expect("somewhere")).collect();
            assert!(places[0] < places[1] && places[1] < places[2]);
            // In the other intervals the polynomial is monotonic and has no root.
            assert_eq!(with_a_root(&product, shift, &intervals), places);
        }
        let intervals = found(&[1, 0, 1], 0).expect("told apart");
        assert!(with_a_root(&[1, 0, 1], 0, &intervals).is_empty());
    }

    /// The indices of the intervals in which a polynomial in `2ˢx` changes its sign or vanishes at the upper end.
    fn with_a_root(coefficients: &[i64], shift: i64, intervals: &[Interval]) -> Vec<usize> {
        let scale = ratio(2, 1).pow(shift as i32);
        let list: Vec<_> = coefficients.iter().map(|&c| ratio(c, 1)).collect();
        let polynomial = Polynomial::from_rationals(&list);
        let changes = |interval: &Interval| {
            let ends = [interval.low(), interval.high()];
            let [low, high] = ends.map(|end| polynomial.sign_at(&(end * &scale)));
            low.is_ne() && low != high
        };
        (0..intervals.len())
            .filter(|&k| changes(&intervals[k]))
            .collect()
    }

    #[test]
    fn isolation_refuses_double_roots() {
        assert_eq!(found(&[4, -4, 1], 0).map(|i| i.len()), None);
        // (3x − 1)²(x² + 1)
        assert_eq!(found(&[1, -6, 10, -6, 9], 0).map(|i| i.len()), None);
    }

    #[test]
    fn isolation_separates_close_roots_and_rejects_close_complex_pairs() {
        // (x² + 1)(9x² − 6x + 1 ∓ 2⁻¹⁰⁰), with roots (1 ± 2⁻⁵⁰)/3 or none.
        for (sign, count) in [(-1, 2), (1, 0)] {
            let offset = ratio(sign, 1) / ratio(2, 1).pow(100);
            let quadratic = [&ratio(1, 1) + &offset, ratio(-6, 1), ratio(9, 1)];
            let product = [
                quadratic[0].clone(),
                quadratic[1].clone(),
                &quadratic[2] + &quadratic[0],
                quadratic[1].clone(),
                quadratic[2].clone(),
            ];
            let balls = Balls::new(400);
            let list: Vec<Ball> = product.iter().map(|c| balls.rational(c)).collect();
            let intervals = monotonic(&list, 400).expect("told apart");
            let polynomial = Polynomial::from_rationals(&product);
            let changes = |interval: &&Interval| {
                polynomial.sign_at(&interval.low()) != polynomial.sign_at(&interval.high())
            };
            assert_eq!(intervals.iter().filter(changes).count(), count);
        }
    }
}
