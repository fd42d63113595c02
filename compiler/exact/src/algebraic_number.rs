//! Real algebraic numbers: an irreducible polynomial and one of its real roots.

use num_rational::BigRational;
use num_traits::Signed;

use super::enclosure_cache::EnclosureCache;
use super::factor::{irreducible_factor_at, irreducible_factors, squarefree_part};
use super::interval::Interval;
use super::polynomial::Polynomial;
use super::roots::{Root, enclose, real_roots};

/// Largest number of binary places in the search for an isolating interval; a root of the polynomial needs fewer.
const MAX_BITS: u32 = 1 << 17;

/// A real algebraic number.
#[derive(Debug, Clone)]
pub struct AlgebraicNumber {
    /// Irreducible and primitive, with a positive leading coefficient.
    polynomial: Polynomial,
    root: Root,
    finest: EnclosureCache,
}

impl AlgebraicNumber {
    fn new(polynomial: Polynomial, root: Root) -> Self {
        AlgebraicNumber {
            polynomial,
            root,
            finest: EnclosureCache::default(),
        }
    }

    /// A rational number.
    pub fn rational(value: BigRational) -> Self {
        let linear = &Polynomial::variable() - &Polynomial::constant(value.clone());
        AlgebraicNumber::new(linear.primitive(), Root::Rational(value))
    }

    /// The real root of a polynomial with this index, in ascending order from 1.
    ///
    /// `None` if there are fewer real roots, or if factoring exceeds its limit ([`irreducible_factors`]).
    pub fn real_root(polynomial: &Polynomial, index: usize) -> Option<Self> {
        polynomial.degree().filter(|degree| *degree > 0)?;
        let squarefree = squarefree_part(polynomial);
        let root = real_roots(&squarefree)
            .into_iter()
            .nth(index.checked_sub(1)?)?;
        let factor = irreducible_factor_at(&squarefree, &root)?;
        Some(AlgebraicNumber::new(factor, root))
    }

    /// The root of a polynomial in a nested sequence of enclosures, given by the number of binary places.
    ///
    /// `None` if factoring exceeds its limit ([`irreducible_factors`]), or if the enclosures exclude every root.
    pub fn identify(polynomial: &Polynomial, enclose: &dyn Fn(u32) -> Interval) -> Option<Self> {
        let mut factors = irreducible_factors(polynomial)?;
        let mut bits = 64;
        while bits <= MAX_BITS {
            let interval = enclose(bits);
            factors.retain(|factor| {
                interval
                    .evaluate(factor)
                    .sign()
                    .is_none_or(std::cmp::Ordering::is_eq)
            });
            match factors.as_slice() {
                [] => return None,
                [factor] if factor.degree() == Some(1) => {
                    let value = -factor.coefficient(0) / factor.leading();
                    return Some(AlgebraicNumber::rational(value));
                }
                [factor] => {
                    // If the derivative does not vanish, a sign change implies exactly one root.
                    let monotone = interval
                        .evaluate(&factor.derivative())
                        .sign()
                        .is_some_and(std::cmp::Ordering::is_ne);
                    let [low, high] =
                        [interval.low(), interval.high()].map(|x| factor.evaluate(&x));
                    if monotone && (low * high).is_negative() {
                        return Some(AlgebraicNumber::new(
                            factor.clone(),
                            Root::Irrational(interval),
                        ));
                    }
                }
                _ => {}
            }
            bits *= 2;
        }
        None
    }

    /// The irreducible polynomial, primitive with a positive leading coefficient.
    pub fn polynomial(&self) -> &Polynomial {
        &self.polynomial
    }

    /// Which root of the polynomial the number is.
    pub fn root(&self) -> &Root {
        &self.root
    }

    /// The degree of the polynomial.
    pub fn degree(&self) -> usize {
        self.polynomial.degree().unwrap_or(0)
    }

    /// An enclosure with this number of binary places, at most two units wide.
    pub fn enclose(&self, bits: u32) -> Interval {
        self.finest
            .enclose(bits, |bits| enclose(&self.polynomial, &self.root, bits))
    }
}

impl PartialEq for AlgebraicNumber {
    fn eq(&self, other: &Self) -> bool {
        if self.polynomial != other.polynomial {
            return false;
        }
        let Root::Irrational(isolated) = &self.root else {
            return true;
        };
        // `isolated` contains exactly one root of the polynomial: the other number lies inside if it is equal, else
        // outside.
        let mut bits = isolated.bits();
        loop {
            let (low, high) = (isolated.low(), isolated.high());
            let theirs = other.enclose(bits);
            if theirs.high() < low || high < theirs.low() {
                return false;
            }
            if low < theirs.low() && theirs.high() < high {
                return true;
            }
            bits += 32;
        }
    }
}

impl Eq for AlgebraicNumber {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;

    #[test]
    fn roots_have_their_irreducible_polynomial() {
        // (x² − 2)² (x − 1)
        let f =
            &Polynomial::from_integers(&[-2, 0, 1]).power(2) * &Polynomial::from_integers(&[-1, 1]);
        let root = |k| AlgebraicNumber::real_root(&f, k);
        assert_eq!(
            root(1).expect("root").polynomial(),
            &Polynomial::from_integers(&[-2, 0, 1])
        );
        assert_eq!(root(2), Some(AlgebraicNumber::rational(ratio(1, 1))));
        assert_ne!(root(1), root(3));
        assert_eq!((root(0), root(4)), (None, None));
        let square = |bits| {
            let x = root(3).expect("root").enclose(bits);
            x.multiply(&x).add(&x)
        };
        // 2 + √2 is a root of x² − 4x + 2.
        let polynomial =
            &Polynomial::from_integers(&[2, -4, 1]) * &Polynomial::from_integers(&[-3, 1]);
        let found = AlgebraicNumber::identify(&polynomial, &square).expect("a root");
        assert_eq!(found.degree(), 2);
        assert_eq!(
            Some(&found),
            AlgebraicNumber::real_root(&polynomial, 3).as_ref()
        );
        assert_eq!(
            AlgebraicNumber::identify(&Polynomial::from_integers(&[-3, 0, 1]), &square),
            None
        );
    }
}
