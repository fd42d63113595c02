//! True factors from factors modulo a prime power.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::polynomial::Polynomial;
use crate::residues::Residues;

/// Largest number of sets of factors modulo `p` to try.
const MAX_TRIALS: u32 = 1 << 20;

/// Combines factors modulo a prime power to true factors, the smallest sets first; `None` beyond [`MAX_TRIALS`].
pub(super) fn recombine(
    polynomial: &Polynomial,
    ring: &Residues,
    lifted: Vec<Vec<BigInt>>,
    degrees: &[bool],
) -> Option<Vec<Polynomial>> {
    let mut found = Vec::new();
    let mut rest = polynomial.clone();
    let mut search = Search::new(&rest, ring, lifted);
    let mut size = 1;
    let mut trials = 0u32;
    while 2 * size <= search.factors.len() {
        let mut set: Vec<usize> = (0..size).collect();
        let factor = loop {
            trials += 1;
            if trials > MAX_TRIALS {
                return None;
            }
            if degrees[search.degree(&set)]
                && search.traces_match(&set)
                && let Some((factor, quotient)) = search.divide(&rest, &set)
            {
                break Some((factor, quotient));
            }
            if !advance(&mut set, search.factors.len()) {
                break None;
            }
        };
        let Some((factor, quotient)) = factor else {
            size += 1;
            continue;
        };
        found.push(factor);
        rest = quotient;
        let mut remaining = search.factors;
        for index in set.iter().rev() {
            remaining.remove(*index);
        }
        search = Search::new(&rest, ring, remaining);
    }
    if rest.degree() > Some(0) {
        found.push(rest);
    }
    Some(found)
}

/// Advances to the next set of the same size of indices below a bound, in lexicographic order.
fn advance(set: &mut [usize], bound: usize) -> bool {
    let size = set.len();
    let Some(position) = (0..size).rev().find(|&i| set[i] < bound - size + i) else {
        return false;
    };
    let first = set[position] + 1;
    for (offset, index) in set[position..].iter_mut().enumerate() {
        *index = first + offset;
    }
    true
}

/// The search for sets of lifted factors whose product is a true factor.
struct Search<'a> {
    ring: &'a Residues,
    leading: BigInt,
    factors: Vec<Vec<BigInt>>,
    /// `leading` times the sum of the roots of each factor, as a fraction of the modulus in units of
    /// 2⁻⁶⁴.
    traces: Vec<u64>,
    /// The largest trace of a true factor, in the same units; `None` if the bound excludes nothing.
    tolerance: Option<u64>,
}

impl<'a> Search<'a> {
    fn new(polynomial: &Polynomial, ring: &'a Residues, factors: Vec<Vec<BigInt>>) -> Self {
        let leading = polynomial.leading().to_integer();
        let fraction = |residue: BigInt| -> BigInt { (residue << 64) / ring.modulus() };
        let traces = factors
            .iter()
            .map(|factor| {
                let second = factor.len().checked_sub(2).map(|k| -&factor[k] * &leading);
                let residue = second.unwrap_or_default().mod_floor(ring.modulus());
                fraction(residue).to_u64().unwrap_or(0)
            })
            .collect();
        // Every fraction is rounded down by at most one unit.
        let rounding = BigInt::from(factors.len() + 1);
        let largest = BigInt::one() << trace_bits(polynomial);
        let tolerance = (fraction(largest) + rounding).to_u64();
        Search {
            ring,
            leading,
            factors,
            traces,
            tolerance: tolerance.filter(|t| *t < 1 << 62),
        }
    }

    fn degree(&self, set: &[usize]) -> usize {
        set.iter().map(|&i| self.factors[i].len() - 1).sum()
    }

    /// Whether the sum of the roots is small enough for a true factor. This excludes almost all sets.
    fn traces_match(&self, set: &[usize]) -> bool {
        let sum = set
            .iter()
            .fold(0u64, |sum, &i| sum.wrapping_add(self.traces[i]));
        self.tolerance
            .is_none_or(|tolerance| sum <= tolerance || sum.wrapping_neg() <= tolerance)
    }

    /// The true factor from a set of lifted factors, and the quotient.
    fn divide(&self, polynomial: &Polynomial, set: &[usize]) -> Option<(Polynomial, Polynomial)> {
        let factors = || set.iter().map(|&i| &self.factors[i]);
        let constant = factors().fold(self.leading.clone(), |product, factor| {
            (product * &factor[0]).mod_floor(self.ring.modulus())
        });
        // The constant term of a factor is nonzero and divides that of the polynomial.
        let whole = polynomial.coefficient(0).to_integer() * &self.leading;
        let constant = self.ring.symmetric(&constant);
        if constant.is_zero() || !(whole % constant).is_zero() {
            return None;
        }
        let product = factors().fold(vec![self.leading.clone()], |product, factor| {
            self.ring.multiply(&product, factor)
        });
        let product = product.iter().map(|c| self.ring.symmetric(c)).collect();
        let candidate = Polynomial::new(product, BigInt::one()).primitive();
        let (quotient, remainder) = polynomial.div_rem(&candidate)?;
        remainder
            .is_zero()
            .then(|| (candidate, quotient.primitive()))
    }
}

/// A number `n` with `|leading · Σ roots| < 2ⁿ` for every factor.
fn trace_bits(polynomial: &Polynomial) -> u64 {
    let bits = |n: &BigInt| n.abs().bits() as i64;
    let Some((leading, rest)) = polynomial.numerators().split_last() else {
        return 0;
    };
    // Fujiwara: every root is at most twice the largest (|a_(n−k)|/|a_n|)^(1/k).
    let quotient = |(k, n): (i64, &BigInt)| (bits(n) - bits(leading) + 1).max(0) / k + 1;
    let root = (1..).zip(rest.iter().rev()).map(quotient).max();
    let count = u64::from((rest.len() + 1).ilog2()) + 1;
    leading.bits() + root.unwrap_or(0) as u64 + 1 + count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_sets_are_visited_once() {
        let mut set = vec![0, 1, 2];
        let mut seen = vec![set.clone()];
        while advance(&mut set, 6) {
            seen.push(set.clone());
        }
        assert_eq!(seen.len(), 20);
        assert!(seen.is_sorted() && seen.iter().all(|s| s.is_sorted()));
        seen.dedup();
        assert_eq!(seen.len(), 20);
    }

    #[test]
    fn sums_of_roots_are_within_the_bound() {
        // 7 (x − 1000)(x + 3)(x − 1/7): the largest partial sum is 1000 + 1/7.
        let f = [[-1000, 1], [3, 1], [-1, 7]]
            .iter()
            .fold(Polynomial::one(), |p, c| &p * &Polynomial::from_integers(c));
        let bound = 1i64 << trace_bits(&f);
        assert!((7 * 1000 + 1..1 << 24).contains(&bound));
    }
}
