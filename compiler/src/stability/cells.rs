//! The positive half-line cut at the roots of polynomials.

use std::sync::Arc;

use num_rational::BigRational;
use num_traits::One;

use super::end_point::PositiveRoot;
use super::polynomial::RealPolynomial;
use crate::arithmetic::rational::{ratio, simplest_between};
use crate::arithmetic::roots::compare;

/// The positive roots of polynomials in ascending order, and rational sample points: between every two roots, before the
/// first and after the last.
///
/// The roots are those of squarefree, pairwise coprime polynomials. Each given polynomial is a product of
/// these, up to multiplicity: at a root, a given polynomial vanishes iff it is divisible
/// by the root's polynomial. Between the roots all given polynomials have constant signs.
pub(super) struct Cells<P> {
    pub(super) roots: Vec<PositiveRoot<P>>,
    /// One sample more than there are roots.
    pub(super) samples: Vec<BigRational>,
}

impl<P: RealPolynomial> Cells<P> {
    /// Cuts at the positive roots of these polynomials, ignoring zero polynomials. `None` if enclosures do not separate the roots.
    pub(super) fn new(polynomials: &[P]) -> Option<Self> {
        let mut roots: Vec<PositiveRoot<P>> = Vec::new();
        for polynomial in coprime_base(polynomials) {
            let polynomial = Arc::new(polynomial);
            let found = polynomial.positive_roots()?.into_iter();
            roots.extend(found.map(|root| PositiveRoot::new(&polynomial, root)));
        }
        let mut bits = FIRST_BITS;
        let finest = roots
            .iter()
            .filter_map(|root| root.polynomial.finest_bits());
        let finest = finest.min().unwrap_or(MAX_BITS);
        // Distinct positive numbers: with enough places, enclosures separate them from each other and from zero.
        let enclosures = loop {
            let enclosed = |root: PositiveRoot<P>| (root.enclose(bits), root);
            let mut enclosures: Vec<_> = roots.drain(..).map(enclosed).collect();
            enclosures.sort_by_key(|(x, _)| x.low());
            let apart = enclosures
                .windows(2)
                .all(|pair| compare(&pair[0].0, &pair[1].0).is_some());
            let positive = enclosures
                .first()
                .is_none_or(|(x, _)| x.sign().is_some_and(std::cmp::Ordering::is_gt));
            if apart && positive {
                break enclosures;
            }
            if bits > finest {
                return None;
            }
            roots = enclosures.into_iter().map(|(_, root)| root).collect();
            bits *= 2;
        };
        let mut samples = Vec::new();
        let mut below = BigRational::default();
        for (enclosure, _) in &enclosures {
            samples.push(between(&below, &enclosure.low()));
            below = enclosure.high();
        }
        samples.push(below.floor() + BigRational::one());
        Some(Cells {
            roots: enclosures.into_iter().map(|(_, root)| root).collect(),
            samples,
        })
    }
}

/// Binary places of the first enclosures.
const FIRST_BITS: u32 = 32;
/// Binary places of the last enclosures, for numbers that are known to any precision.
const MAX_BITS: u32 = 1 << 16;

/// A short rational strictly between two rationals.
fn between(low: &BigRational, high: &BigRational) -> BigRational {
    let margin = (high - low) / ratio(4, 1);
    simplest_between(&(low + &margin), &(high - &margin))
}

/// Squarefree polynomials, pairwise coprime and not constant. Each given polynomial is a product of them, up to
/// multiplicity.
fn coprime_base<P: RealPolynomial>(polynomials: &[P]) -> Vec<P> {
    let long = |p: &P| p.degree().unwrap_or(0) > 0;
    let mut base: Vec<P> = Vec::new();
    for polynomial in polynomials.iter().filter(|p| long(p)) {
        let mut rest = polynomial.squarefree();
        let mut finer = Vec::new();
        for known in base {
            let common = if long(&rest) {
                known.common_factor(&rest)
            } else {
                rest.clone()
            };
            if long(&common) {
                let other = known.divide(&common).0;
                rest = rest.divide(&common).0;
                finer.extend([common, other].into_iter().filter(long));
            } else {
                finer.push(known);
            }
        }
        finer.extend(Some(rest).filter(long));
        base = finer;
    }
    base
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::polynomial::Polynomial;

    #[test]
    fn the_base_is_coprime_and_divides() {
        let p = |c: &[i64]| Polynomial::from_integers(c);
        // (x − 1)²(x − 2), (x − 2)(x − 3), x + 1, a constant, zero
        let given = [
            &p(&[1, -2, 1]) * &p(&[-2, 1]),
            p(&[6, -5, 1]),
            p(&[1, 1]),
            p(&[4]),
            p(&[]),
        ];
        let base = coprime_base(&given);
        assert_eq!(base.len(), 4);
        let cells = Cells::new(&given).expect("apart");
        let roots: Vec<_> = cells
            .roots
            .iter()
            .filter_map(|r| r.root.rational().cloned())
            .collect();
        assert_eq!(roots, [ratio(1, 1), ratio(2, 1), ratio(3, 1)]);
        for (index, sample) in cells.samples.iter().enumerate() {
            assert!(index == 0 || roots[index - 1] < *sample);
            assert!(index == roots.len() || *sample < roots[index]);
        }
    }

    #[test]
    fn close_roots_are_separated() {
        let tiny = crate::arithmetic::rounding::exact(2f64.powi(-100));
        let near = Polynomial::from_rationals(&[-(ratio(1, 1) + &tiny), ratio(1, 1)]);
        let cells = Cells::new(&[
            near,
            Polynomial::from_integers(&[-1, 1]),
            Polynomial::from_rationals(&[-tiny, ratio(1, 1)]),
        ]);
        let cells = cells.expect("apart");
        assert_eq!(cells.roots.len(), 3);
        assert!(cells.samples[2] > ratio(1, 1));
    }
}
