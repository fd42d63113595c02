//! The first stable steps of a palindromic (symmetric) splitting, from one half of it.
//!
//! Let `N = (a b; c d)` be the matrix of the first half, with the middle flow halved, and `R = diag(1, −1)`. Each flow satisfies
//! `R F⁻¹ R = F`. So the other half, the same flows in reverse, is `R N⁻¹ R = (d b; c a)`, and the step is
//!
//! ```text
//! M = R N⁻¹ R N = ⎛ ad + bc   2bd    ⎞      (tr M/2)² − 1 = 4abcd .
//!                 ⎝ 2ac      ad + bc ⎠
//! ```
//!
//! Near zero `a, d > 0`, `b > 0` and `c < 0`. So all steps are stable up to the first root of `a`, `b/ν`, `c/ν` or `d`, which
//! are polynomials in `x = ν²` of half the degree of the trace. Because `ad − bc = 1`, a root of exactly one of them leaves one
//! of the entries `2bd` and `2ac` nonzero: that step is not stable, nor are those just after it.
//!
//! The trace comes close to ±2 wherever a step is close to a multiple of half a period. Its roots there are pairs whose
//! distance is as small as the phase error; the roots of the four polynomials are well separated.

use std::cmp::Ordering;
use std::sync::{Arc, OnceLock};

use num_bigint::BigInt;
use num_rational::BigRational;

use super::end_point::{EndPoint, PositiveReal};
use super::intervals::StabilityInterval;
use super::isolation::{monotonic_within, narrow, root_bound};
use super::oscillator::{matrix_of_flows, product_of_flows};
use crate::algebra::{Ball, Balls, Field, Scalar, StageAlgebra, Zero};
use crate::arithmetic::enclosure_cache::EnclosureCache;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::ratio;
use crate::partitioned::{Flows, Partitioned};

/// Bits of enclosures.
const PRECISIONS: [u32; 7] = [
    1 << 10,
    1 << 11,
    1 << 12,
    1 << 13,
    1 << 14,
    1 << 15,
    1 << 16,
];

/// Bits, beyond those of the point, by which a value near a root is distinguished from zero.
const NEAR: u32 = 512;

/// The number of [`PRECISIONS`] that are tried to separate the roots.
const TRIED: usize = 3;

/// The interval of stable steps that begins at zero, if the pair is a palindromic splitting
/// and enclosures decide where the interval ends.
///
/// They do not decide it if two of the polynomials share their first root, where the step is `±1`, or if
/// that root is a double root.
pub(super) fn first_interval<A: StageAlgebra + 'static>(
    pair: &Partitioned<A>,
) -> Option<StabilityInterval> {
    let half = Half::of(pair)?;
    let (entry, interval) = (0..TRIED).find_map(|precision| half.first_root(precision))?;
    Some(StabilityInterval {
        low: EndPoint::ZERO,
        high: EndPoint::square_root(FirstRoot {
            half,
            entry,
            interval,
            finest: EnclosureCache::default(),
        }),
        low_closed: false,
        high_closed: false,
    })
}

/// The first half of a splitting.
#[derive(Debug)]
struct Half<A: StageAlgebra> {
    algebra: Arc<A>,
    flows: Flows<Scalar<A>>,
    /// Enclosures for each of [`PRECISIONS`], computed on demand.
    enclosures: [OnceLock<Flows<Ball>>; PRECISIONS.len()],
}

impl<A: StageAlgebra> Half<A> {
    fn of(pair: &Partitioned<A>) -> Option<Self> {
        let flows = pair.flows().filter(Flows::is_palindrome)?;
        let field = pair.algebra.constants();
        let half = field.rational(&ratio(1, 2));
        Some(Half {
            flows: flows.first_half(|middle| field.multiply(&half, middle)),
            algebra: Arc::clone(&pair.algebra),
            enclosures: Default::default(),
        })
    }

    fn enclosed(&self, precision: usize) -> &Flows<Ball> {
        let field = self.algebra.constants();
        let enclose = |x: &Scalar<A>| field.enclose(x, PRECISIONS[precision]);
        self.enclosures[precision].get_or_init(|| self.flows.map(enclose))
    }

    /// The sign of an entry of `N` at `x`, if enclosures determine it.
    fn sign_at(&self, entry: usize, x: &BigRational) -> Option<Ordering> {
        self.value_at(entry, x).and_then(|value| value.sign())
    }

    /// Whether an entry of `N` is known to vanish at `x`.
    fn vanishes_at(&self, entry: usize, x: &BigRational) -> bool {
        if let Some(sign) = self.sign_at(entry, x) {
            return sign.is_eq();
        }
        let field = self.algebra.constants();
        let [zero, one, x] = [&ratio(0, 1), &ratio(1, 1), x].map(|value| field.rational(value));
        let add = |sum: &mut Scalar<A>, factor: &Scalar<A>, value: &Scalar<A>, power| {
            let product = field.multiply(factor, value);
            let product = (0..power).fold(product, |product, _| field.multiply(&product, &x));
            *sum = field.add(sum, &product);
        };
        let negative = |kick: &Scalar<A>| field.subtract(&zero, kick);
        let entries = product_of_flows(&self.flows, [zero.clone(), one], negative, add);
        field.zero(&entries[entry]) == Zero::Yes
    }

    /// The value of an entry of `N` at `x`, if enclosures determine its sign.
    ///
    /// Near a root this takes as many bits as the point has; fewer bits are not tried.
    fn value_at(&self, entry: usize, x: &BigRational) -> Option<Ball> {
        let value = |precision: usize, bits: u32| {
            let x = Ball::quotient(x, bits);
            let add = |sum: &mut Ball, factor: &Ball, value: &Ball, power| {
                let product = factor.with_bits(bits).multiply(value, bits);
                let product = (0..power).fold(product, |product, _| product.multiply(&x, bits));
                *sum = sum.add(&product, bits);
            };
            let units = [Ball::whole(0), Ball::whole(1)];
            let [a, b, c, d] = product_of_flows(self.enclosed(precision), units, Ball::negate, add);
            let value = [a, b, c, d].into_iter().nth(entry)?;
            value.sign().map(|_| value)
        };
        let needed = u32::try_from(x.denom().bits()).unwrap_or(u32::MAX);
        let needed = needed.saturating_add(NEAR);
        let last = PRECISIONS.len() - 1;
        let first = PRECISIONS.iter().position(|&bits| bits >= needed);
        let first = first.unwrap_or(last);
        let few = value(first, needed.min(PRECISIONS[first]));
        few.or_else(|| (first..=last).find_map(|k| value(k, PRECISIONS[k])))
    }

    /// The first positive root among the entries of `N`: the index of its entry, and an interval that isolates it and before
    /// which no entry has a root. `None` if enclosures of these bits do not decide.
    fn first_root(&self, precision: usize) -> Option<(usize, Interval)> {
        let bits = PRECISIONS[precision];
        let entries = matrix_of_flows(&Balls::new(bits), self.enclosed(precision));
        let [a, b, c, d] = [0, 1, 2, 3].map(|entry| self.sign_at(entry, &ratio(0, 1)));
        let c = c.map(Ordering::reverse);
        let stable_at_first = [a, b, c, d] == [Some(Ordering::Greater); 4];
        let bounds = entries.iter().map(|list| root_bound(list));
        let last = bounds.collect::<Option<Vec<_>>>()?.into_iter().max()?;
        if !stable_at_first {
            return None;
        }
        // Up to x = 1, 2, 4, …, so that the search goes little beyond the first root.
        let (mut low, mut high) = (BigInt::from(0), BigInt::from(1));
        while high.bits() as i64 <= last.max(0) + 1 {
            let window = Interval { low, high, bits: 0 };
            let mut roots = Vec::new();
            for (entry, list) in entries.iter().enumerate() {
                for interval in monotonic_within(list, &window, bits)? {
                    let ends = [interval.low(), interval.high()].map(|x| self.sign_at(entry, &x));
                    match ends {
                        [None | Some(Ordering::Equal), _] | [_, None | Some(Ordering::Equal)] => {
                            return None;
                        }
                        [low, high] if low == high => {}
                        _ => {
                            roots.push((entry, interval));
                            break;
                        }
                    }
                }
            }
            if !roots.is_empty() {
                return self.least(roots);
            }
            (low, high) = (window.high.clone(), window.high << 1);
        }
        None
    }

    /// The least of the roots, if a few places separate it from the others.
    fn least(&self, mut roots: Vec<(usize, Interval)>) -> Option<(usize, Interval)> {
        for places in [32, 128, 512] {
            for (entry, interval) in &mut roots {
                *interval = narrow(interval, places, |x| self.value_at(*entry, x));
            }
            roots.sort_by_key(|(_, interval)| interval.low());
            let high = roots.first()?.1.high();
            if roots.iter().skip(1).all(|(_, other)| high < other.low()) {
                return Some(roots.swap_remove(0));
            }
        }
        None
    }
}

/// The first root of an entry.
#[derive(Debug)]
struct FirstRoot<A: StageAlgebra> {
    half: Half<A>,
    entry: usize,
    interval: Interval,
    finest: EnclosureCache,
}

impl<A: StageAlgebra> PositiveReal for FirstRoot<A> {
    fn enclose(&self, bits: u32) -> Interval {
        let value_at = |x: &BigRational| self.half.value_at(self.entry, x);
        let compute = |bits| narrow(&self.interval, bits, value_at);
        self.finest.enclose(bits, compute)
    }

    fn equals(&self, value: &BigRational) -> bool {
        self.interval.contains(value) && self.half.vanishes_at(self.entry, value)
    }
}

#[cfg(test)]
mod tests {
    use crate::arithmetic::rational::ratio;
    use crate::stability::Stability;
    use crate::{Definition, Limits, Tableau, catalogue};

    fn known(name: &str) -> Tableau {
        let entry = catalogue::find(name).expect(name);
        entry.derive().expect(name)
    }

    fn defined(text: &str) -> Tableau {
        let definition = Definition::parse(text).expect(text);
        definition.derive(&Limits::default()).expect(text)
    }

    #[test]
    fn the_first_interval_is_that_of_the_whole_trace() {
        for name in [
            "forest-ruth-1990",
            "suzuki-1990",
            "triple-jump-8",
            "blanes-moan-2002-s6",
        ] {
            let tableau = known(name);
            let Stability { intervals, .. } = tableau.stability();
            let first = tableau.first_stable_interval().expect(name);
            assert_eq!(
                first.high.decimal(30),
                intervals[0].high.decimal(30),
                "{name}"
            );
            let end = ratio(1, 1) / ratio(1 << 40, 1);
            let near = intervals[0].high.enclose(80).expect("finite").middle();
            assert!(
                first.contains(&(&near - &end)) && !first.contains(&(near + end)),
                "{name}"
            );
        }
    }

    /// Ends from the traces of products of 81, 125 and 625 matrices in arithmetic of 80 digits; the traces are ±2 there.
    #[test]
    fn stable_intervals_of_long_compositions_agree_with_products() {
        for (name, end) in [
            ("triple-jump-10", "1.2538295503375377928"),
            ("suzuki-8", "3.1415275035205379284"),
            ("suzuki-10", "3.1415926311546522896"),
        ] {
            let first = known(name).first_stable_interval().expect(name);
            assert_eq!(first.high.decimal(20), end, "{name}");
        }
    }

    #[test]
    fn halves_leave_asymmetric_and_touching_methods_undecided() {
        // Not palindromic.
        assert!(known("ruth-1983").first_stable_interval().is_none());
        // Not a splitting.
        assert!(known("gauss-2").first_stable_interval().is_none());
        // The step is ±1 at common roots, and stable beyond.
        let thrice = "base: velocity-verlet, weights: [1/3, 1/3, 1/3]";
        assert!(defined(thrice).first_stable_interval().is_none());
    }
}
