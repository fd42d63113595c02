//! One coefficient of a tableau: an exact real number that can be enclosed and correctly rounded.

use std::borrow::Cow;
use std::cmp::Ordering;

use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::tensor::magnitude_bits;
use super::{NodeAlgebra, Tensor, divisor};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::ratio;
use crate::arithmetic::rounding::{Decimal, exact, to_f64};

/// The value of an element of `K` at a node, or of an element of `K ⊗ K` at two: an algebraic number.
///
/// Questions about it are answered exactly: its sign, whether it equals a rational, its value rounded
/// to a double or to any number of digits.
#[derive(Debug, Clone)]
pub struct Number<'a> {
    algebra: &'a NodeAlgebra,
    source: Source<'a>,
    /// A first enclosure.
    start: Interval,
}

#[derive(Debug, Clone)]
enum Source<'a> {
    Element(Cow<'a, Polynomial>, usize),
    Entry(&'a Tensor, usize, usize),
}

/// Binary places of the first enclosure, beyond the cancellation that the coefficients suggest.
const FIRST_BITS: u32 = 192;

impl<'a> Number<'a> {
    /// The values of an element at all nodes.
    pub fn of_element(algebra: &'a NodeAlgebra, element: Cow<'a, Polynomial>) -> Vec<Self> {
        let bits = FIRST_BITS + magnitude_bits(&element);
        let starts = algebra.enclose(&element, bits);
        let number = |(node, start)| Number {
            algebra,
            source: Source::Element(element.clone(), node),
            start,
        };
        starts.into_iter().enumerate().map(number).collect()
    }

    /// The value of an element at one node.
    pub fn at(algebra: &'a NodeAlgebra, element: Polynomial, node: usize) -> Self {
        let bits = FIRST_BITS + magnitude_bits(&element);
        let start = algebra.enclose_nodes(bits)[node].evaluate(&element);
        Number {
            algebra,
            source: Source::Element(Cow::Owned(element), node),
            start,
        }
    }

    /// The entries of a matrix.
    pub fn of_tensor(algebra: &'a NodeAlgebra, tensor: &'a Tensor) -> Vec<Vec<Self>> {
        let nodes = algebra.enclose_nodes(FIRST_BITS + tensor.bits());
        (0..algebra.dimension())
            .map(|row| {
                let starts = tensor.enclose_row(&nodes, row).into_iter().enumerate();
                starts
                    .map(|(column, start)| Number {
                        algebra,
                        source: Source::Entry(tensor, row, column),
                        start,
                    })
                    .collect()
            })
            .collect()
    }

    /// An enclosure with at least this many binary places.
    ///
    /// Its width tends to zero as `bits` grows.
    pub fn enclose(&self, bits: u32) -> Interval {
        if bits <= self.start.bits() {
            return self.start.clone();
        }
        let nodes = self.algebra.enclose_nodes(bits);
        match &self.source {
            Source::Element(element, node) => nodes[*node].evaluate(element),
            Source::Entry(tensor, row, column) => {
                tensor.enclose_row(&nodes, *row).swap_remove(*column)
            }
        }
    }

    /// Whether the number equals a rational, decided exactly.
    pub fn equals(&self, value: &BigRational) -> bool {
        if !self.start.contains(value) {
            return false;
        }
        match &self.source {
            Source::Element(element, node) => element_vanishes(
                self.algebra,
                &(&**element - &Polynomial::constant(value.clone())),
                *node,
            ),
            Source::Entry(tensor, row, column) => {
                let shifted = tensor.subtract(&Tensor::from_products(
                    self.algebra,
                    &[(Polynomial::constant(value.clone()), Polynomial::one())],
                ));
                entry_vanishes(self.algebra, &shifted, *row, *column)
            }
        }
    }

    /// The number, if it is a rational with a short numerator and denominator; proved.
    pub fn short_rational(&self) -> Option<BigRational> {
        super::closed_form::short_rational(&self.start).filter(|candidate| self.equals(candidate))
    }

    /// Whether the number is zero, decided exactly.
    pub fn is_zero(&self) -> bool {
        self.equals(&BigRational::zero())
    }

    /// The sign of the number, decided exactly.
    pub fn sign(&self) -> Ordering {
        if self.is_zero() {
            return Ordering::Equal;
        }
        let mut bits = self.start.bits();
        loop {
            if let Some(sign) = self.enclose(bits).sign() {
                return sign;
            }
            bits *= 2;
        }
    }

    /// The nearest double, ties to even.
    pub fn to_f64(&self) -> f64 {
        self.round(to_f64, |&double| exact(double))
    }

    /// The number rounded to `digits` significant decimal digits, ties to even.
    pub fn decimal(&self, digits: usize) -> Decimal {
        self.round(|value| Decimal::round(value, digits), Decimal::value)
    }

    /// Rounds by refining the enclosure until both ends round to the same.
    ///
    /// That ends unless the number is zero or the middle between two neighbours of the target format,
    /// which is decided exactly when an enclosure has become narrow and does not exclude it.
    fn round<T: PartialEq>(
        &self,
        round: impl Fn(&BigRational) -> T,
        value: impl Fn(&T) -> BigRational,
    ) -> T {
        if self.is_zero() {
            return round(&BigRational::zero());
        }
        let mut interval = self.start.clone();
        let mut excluded = None;
        loop {
            let (low, high) = (interval.low(), interval.high());
            let (below, above) = (round(&low), round(&high));
            let decided = interval.sign().is_some();
            if decided && below == above {
                return below;
            }
            let (a, b) = (value(&below), value(&above));
            let middle = (&a + &b) / ratio(2, 1);
            // Ends that are close compared with the distance of what they round to are on both sides of
            // the middle between neighbours. That close, they hardly ever are unless the number is the
            // middle: the exact test is expensive, so it has to be worth it.
            let narrow = (high - low) * exact(2f64.powi(64)) < (b - a).abs();
            if decided && narrow && excluded.as_ref() != Some(&middle) {
                if self.equals(&middle) {
                    return round(&middle);
                }
                excluded = Some(middle);
            }
            interval = self.enclose(interval.bits() * 2);
        }
    }
}

/// Whether `f(c_node) = 0`.
fn element_vanishes(algebra: &NodeAlgebra, element: &Polynomial, node: usize) -> bool {
    if element.is_zero() {
        return true;
    }
    let root = &algebra.roots()[node];
    match root.rational() {
        Some(value) => element.evaluate(value).is_zero(),
        None => root.is_root_of_divisor(&algebra.modulus().gcd(element)),
    }
}

/// Whether `T(c_row, c_column) = 0`.
fn entry_vanishes(algebra: &NodeAlgebra, tensor: &Tensor, row: usize, column: usize) -> bool {
    let roots = algebra.roots();
    if let Some(node) = roots[row].rational() {
        element_vanishes(algebra, &tensor.row_at(node), column)
    } else if let Some(node) = roots[column].rational() {
        element_vanishes(algebra, &tensor.column_at(node), row)
    } else if row == column {
        element_vanishes(algebra, &tensor.on_graph(algebra, &algebra.variable()), row)
    } else {
        divisor::vanishes(algebra, tensor, row, column)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::One;

    /// Nodes 1/2 ∓ √3/6.
    fn algebra() -> NodeAlgebra {
        NodeAlgebra::new(&Polynomial::from_integers(&[1, -6, 6])).expect("nodes")
    }

    #[test]
    fn decimals_agree_with_known_digits() {
        let k = algebra();
        let x = k.variable();
        let nodes = Number::of_element(&k, Cow::Borrowed(&x));
        // 1/2 + √3/6, from the known digits of √3.
        let sqrt3 = "1.73205080756887729352744634150587236694280525381038062805580697945193301690880003708114618675724857567562614142";
        let digits = nodes[1].decimal(60).to_string();
        let six: BigRational = ratio(6, 1);
        let integer: num_bigint::BigInt = sqrt3.replace('.', "").parse().expect("digits");
        let scale = num_bigint::BigInt::from(10).pow(sqrt3.len() as u32 - 2);
        let reference = BigRational::new(integer, scale) / six + ratio(1, 2);
        assert_eq!(digits, Decimal::round(&reference, 60).to_string());
        assert_eq!(nodes[1].to_f64(), 0.5 + 3f64.sqrt() / 6.0);
    }

    /// At these lengths an early enclosure often meets the middle between two decimals by chance.
    #[test]
    fn near_ties_are_not_taken_for_ties() {
        let gauss = crate::derive("polynomial(8)", "gauss(8)").expect("derived");
        for digits in [55, 56, 57, 58, 59, 60, 61, 62, 121, 122, 123] {
            for number in gauss.numbers().iter() {
                // Far more places than it takes, and another route.
                let fine = Decimal::round(&number.enclose(2000).low(), digits);
                assert_eq!(number.decimal(digits), fine);
            }
        }
    }

    #[test]
    fn ties_and_zeros_of_irrational_nodes_are_decided() {
        let k = algebra();
        // x(1 − x) = 1/6 at both nodes, hidden; reduced by hand it would be a constant, so hide it
        // among two indices instead: x·(1 − y) on the antidiagonal y = 1 − x gives x² = x − 1/6.
        let x = k.variable();
        let product = Tensor::from_products(&k, &[(x.clone(), x.clone())]);
        let entries = Number::of_tensor(&k, &product);
        // c_1 c_2 = 1/6 exactly.
        assert!(entries[0][1].equals(&ratio(1, 6)));
        assert!(!entries[0][0].equals(&ratio(1, 6)));
        let shifted = product.subtract(&Tensor::from_products(
            &k,
            &[(
                Polynomial::constant(ratio(1, 6) - ratio(1, 4)),
                Polynomial::one(),
            )],
        ));
        let quarter = &Number::of_tensor(&k, &shifted)[0][1];
        // 1/4 to one digit is a tie; to even it is 0.2. Its neighbours are not ties.
        assert_eq!(quarter.decimal(1).to_string(), "0.2");
        let hair = BigRational::new(One::one(), num_bigint::BigInt::one() << 500);
        let above = shifted.add(&Tensor::from_products(
            &k,
            &[(Polynomial::constant(hair.clone()), Polynomial::one())],
        ));
        assert_eq!(
            Number::of_tensor(&k, &above)[0][1].decimal(1).to_string(),
            "0.3"
        );
        let double_tie = exact(1.0) + exact(f64::EPSILON) / ratio(2, 1) - ratio(1, 4);
        let tie = shifted.add(&Tensor::from_products(
            &k,
            &[(Polynomial::constant(double_tie.clone()), Polynomial::one())],
        ));
        assert_eq!(Number::of_tensor(&k, &tie)[0][1].to_f64(), 1.0);
        let above = tie.add(&Tensor::from_products(
            &k,
            &[(Polynomial::constant(hair), Polynomial::one())],
        ));
        assert_eq!(
            Number::of_tensor(&k, &above)[0][1].to_f64(),
            1.0 + f64::EPSILON
        );
        let zero = shifted.subtract(&Tensor::from_products(
            &k,
            &[(Polynomial::constant(ratio(1, 4)), Polynomial::one())],
        ));
        assert!(Number::of_tensor(&k, &zero)[0][1].is_zero());
        assert_eq!(
            Number::of_tensor(&k, &zero)[0][1].decimal(5).to_string(),
            "0"
        );
        assert_eq!(Number::of_tensor(&k, &zero)[0][0].sign(), Ordering::Less);
    }
}
