//! Short exact forms of coefficients: rationals and `p + q√d`.

use std::cmp::Ordering;
use std::fmt;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::tensor::magnitude_bits;
use super::{NodeAlgebra, NodeNumber, Tensor};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::{ratio, short_between};
use crate::arithmetic::roots::compare;

/// The number `rational + factor·√radicand`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClosedForm {
    rational: BigRational,
    factor: BigRational,
    /// Not a perfect square; 1 if `factor` is zero.
    radicand: BigInt,
}

/// Candidates with longer numerators or denominators do not count as short.
const SHORT_BITS: u64 = 60;

impl ClosedForm {
    /// A rational number.
    pub fn rational(value: BigRational) -> Self {
        ClosedForm {
            rational: value,
            factor: BigRational::zero(),
            radicand: BigInt::one(),
        }
    }

    /// The numbers `p` and `q` if the form is `p + q√d` with this `d`.
    pub fn over(&self, radicand: &BigInt) -> Option<[BigRational; 2]> {
        let known = self.factor.is_zero() || self.radicand == *radicand;
        known.then(|| [self.rational.clone(), self.factor.clone()])
    }

    /// The `d` of `p + q√d`; `None` for a rational number.
    pub fn radicand(&self) -> Option<&BigInt> {
        (!self.factor.is_zero()).then_some(&self.radicand)
    }

    /// `rational ± √square` for a positive `square`.
    fn surd(rational: BigRational, square: &BigRational, sign: Ordering) -> Self {
        // √(n/d) = √(n·d)/d, and square factors are taken out of the root.
        let mut radicand = square.numer() * square.denom();
        let mut factor = BigRational::new(BigInt::one(), square.denom().clone());
        let root = radicand.sqrt();
        if &root * &root == radicand {
            let value = factor * BigRational::from_integer(root);
            let value = if sign == Ordering::Less {
                -value
            } else {
                value
            };
            return ClosedForm::rational(rational + value);
        }
        for prime in 2u32..2000 {
            let square = BigInt::from(prime * prime);
            while (&radicand % &square).is_zero() {
                radicand /= &square;
                factor *= BigRational::from_integer(prime.into());
            }
        }
        ClosedForm {
            rational,
            factor: if sign == Ordering::Less {
                -factor
            } else {
                factor
            },
            radicand,
        }
    }

    /// The radicand of two numbers in one quadratic field.
    fn common_radicand(&self, other: &Self) -> Option<BigInt> {
        if self.factor.is_zero() {
            Some(other.radicand.clone())
        } else if other.factor.is_zero() || self.radicand == other.radicand {
            Some(self.radicand.clone())
        } else {
            None
        }
    }

    fn new(rational: BigRational, factor: BigRational, radicand: BigInt) -> Self {
        if factor.is_zero() {
            ClosedForm::rational(rational)
        } else {
            ClosedForm {
                rational,
                factor,
                radicand,
            }
        }
    }

    fn add(&self, other: &Self) -> Option<Self> {
        let radicand = self.common_radicand(other)?;
        Some(ClosedForm::new(
            &self.rational + &other.rational,
            &self.factor + &other.factor,
            radicand,
        ))
    }

    fn multiply(&self, other: &Self) -> Option<Self> {
        let radicand = self.common_radicand(other)?;
        let square = BigRational::from_integer(radicand.clone());
        let rational = &self.rational * &other.rational + &self.factor * &other.factor * square;
        let factor = &self.rational * &other.factor + &self.factor * &other.rational;
        Some(ClosedForm::new(rational, factor, radicand))
    }

    /// The value of a polynomial at this number.
    fn evaluate(&self, polynomial: &Polynomial) -> Option<Self> {
        if self.factor.is_zero() {
            return Some(ClosedForm::rational(polynomial.evaluate(&self.rational)));
        }
        let zero = ClosedForm::rational(BigRational::zero());
        let mut coefficients = polynomial.coefficients().into_iter().rev();
        coefficients.try_fold(zero, |value, c| {
            value.multiply(self)?.add(&ClosedForm::rational(c))
        })
    }
}

/// A polynomial whose coefficients are in one quadratic field: `rational + √radicand · factor`.
struct QuadraticPolynomial {
    rational: Polynomial,
    factor: Polynomial,
    root: ClosedForm,
}

impl QuadraticPolynomial {
    /// The row of a matrix at a node, a polynomial in `y`.
    fn row(tensor: &Tensor, node: &ClosedForm) -> Option<Self> {
        let values: Vec<ClosedForm> = tensor
            .columns()
            .iter()
            .map(|c| node.evaluate(c))
            .collect::<Option<_>>()?;
        let part = |part: fn(&ClosedForm) -> &BigRational| {
            Polynomial::from_rationals(
                &values
                    .iter()
                    .map(|value| part(value).clone())
                    .collect::<Vec<_>>(),
            )
        };
        let root = ClosedForm::new(
            BigRational::zero(),
            BigRational::one(),
            node.radicand.clone(),
        );
        Some(QuadraticPolynomial {
            rational: part(|value| &value.rational),
            factor: part(|value| &value.factor),
            root,
        })
    }

    fn evaluate(&self, y: &ClosedForm) -> Option<ClosedForm> {
        let rational = y.evaluate(&self.rational)?;
        if self.factor.is_zero() {
            return Some(rational);
        }
        rational.add(&y.evaluate(&self.factor)?.multiply(&self.root)?)
    }
}

impl fmt::Display for ClosedForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.factor.is_zero() {
            return write!(f, "{}", self.rational);
        }
        match (self.rational.is_zero(), self.factor.is_negative()) {
            (true, true) => f.write_str("-")?,
            (true, false) => {}
            (false, negative) => {
                write!(f, "{} {} ", self.rational, if negative { '-' } else { '+' })?
            }
        }
        let (numerator, denominator) = (self.factor.numer().abs(), self.factor.denom());
        if !numerator.is_one() {
            write!(f, "{numerator}*")?;
        }
        write!(f, "sqrt({})", self.radicand)?;
        if denominator.is_one() {
            Ok(())
        } else {
            write!(f, "/{denominator}")
        }
    }
}

/// Short exact forms of the nodes, if there are any.
fn of_nodes(algebra: &NodeAlgebra) -> &[Option<ClosedForm>] {
    algebra
        .forms
        .get_or_init(|| search(algebra, &algebra.variable()))
}

/// Short exact forms of the values of an element at all nodes, if there are any.
pub fn of_element(algebra: &NodeAlgebra, element: &Polynomial) -> Vec<Option<ClosedForm>> {
    if *element == algebra.variable() {
        of_nodes(algebra).to_vec()
    } else {
        search(algebra, element)
    }
}

fn search(algebra: &NodeAlgebra, element: &Polynomial) -> Vec<Option<ClosedForm>> {
    let values = algebra.enclose(element, 4 * SHORT_BITS as u32 + 2 * magnitude_bits(element));
    let vanishes = |f: &Polynomial, node: usize| {
        NodeNumber::at(algebra, algebra.reduce(f), node).equals(&BigRational::zero())
    };
    let rational = |node: usize| {
        if let Some(node) = algebra.roots()[node].rational() {
            return Some(element.evaluate(node));
        }
        let candidate = short_rational(&values[node])?;
        let distance = element - &Polynomial::constant(candidate.clone());
        vanishes(&distance, node).then_some(candidate)
    };
    let nodes = 0..algebra.dimension();
    let mut forms: Vec<Option<ClosedForm>> = nodes
        .clone()
        .map(|node| rational(node).map(ClosedForm::rational))
        .collect();
    // The conjugate of a quadratic number is the value at another node.
    for node in nodes.clone() {
        for other in node + 1..nodes.end {
            if forms[node].is_some() && forms[other].is_some() {
                continue;
            }
            let Some(quadratic) = Quadratic::of_roots(&values[node], &values[other]) else {
                continue;
            };
            let residual = quadratic.at(element);
            let sign = compare(&values[node], &values[other]);
            for (node, sign) in [(node, sign), (other, sign.map(Ordering::reverse))] {
                if forms[node].is_none() && vanishes(&residual, node) {
                    forms[node] = sign.map(|sign| quadratic.root(sign));
                }
            }
        }
    }
    forms
}

/// The polynomial `z² − sum·z + product` with distinct real roots.
struct Quadratic {
    sum: BigRational,
    product: BigRational,
}

impl Quadratic {
    /// The polynomial with these roots, if its coefficients are short.
    fn of_roots(a: &Interval, b: &Interval) -> Option<Self> {
        let found = Quadratic {
            sum: short_rational(&a.add(b))?,
            product: short_rational(&a.multiply(b))?,
        };
        found.discriminant().is_positive().then_some(found)
    }

    fn discriminant(&self) -> BigRational {
        &self.sum * &self.sum - &self.product * ratio(4, 1)
    }

    /// The value of the polynomial at an element.
    fn at(&self, z: &Polynomial) -> Polynomial {
        &(&(z * z) - &z.scale(&self.sum)) + &Polynomial::constant(self.product.clone())
    }

    /// The root that compares with the other root in this way.
    fn root(&self, sign: Ordering) -> ClosedForm {
        let two = ratio(2, 1);
        ClosedForm::surd(
            &self.sum / &two,
            &(self.discriminant() / (&two * &two)),
            sign,
        )
    }
}

/// The simplest rational in an interval, if it is short.
pub fn short_rational(interval: &Interval) -> Option<BigRational> {
    // Two short rationals cannot be that close.
    let interval = interval.with_bits(interval.bits().min(2 * SHORT_BITS as u32 + 4));
    short_between(&interval.low(), &interval.high(), SHORT_BITS)
}

/// Short exact forms of the entries of a matrix, if there are any.
///
/// Found if both nodes lie in one quadratic field, on the diagonal, and if the nodes are mirror
/// images, `c_i + c_j = 1`.
pub fn of_tensor(algebra: &NodeAlgebra, tensor: &Tensor) -> Vec<Vec<Option<ClosedForm>>> {
    let size = algebra.dimension();
    let nodes = of_nodes(algebra);
    let diagonal = of_element(algebra, &tensor.on_graph(algebra, &algebra.variable()));
    let reflection = Polynomial::from_integers(&[1, -1]);
    let mirrored = algebra.modulus().compose(&reflection).primitive() == *algebra.modulus();
    let antidiagonal = if mirrored {
        of_element(
            algebra,
            &tensor.on_graph(algebra, &algebra.reduce(&reflection)),
        )
    } else {
        vec![None; size]
    };
    (0..size)
        .map(|row| {
            let values = nodes[row]
                .as_ref()
                .and_then(|node| QuadraticPolynomial::row(tensor, node));
            (0..size)
                .map(|column| match (&values, &nodes[column]) {
                    _ if row == column && diagonal[row].is_some() => diagonal[row].clone(),
                    _ if row + column + 1 == size && antidiagonal[row].is_some() => {
                        antidiagonal[row].clone()
                    }
                    (Some(values), Some(y)) => values.evaluate(y),
                    _ => None,
                })
                .collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(forms: Vec<Option<ClosedForm>>) -> Vec<String> {
        forms
            .into_iter()
            .map(|f| f.map_or("-".to_owned(), |f| f.to_string()))
            .collect()
    }

    #[test]
    fn quadratic_nodes_and_their_functions_are_recognised() {
        let m = &Polynomial::from_integers(&[1, -6, 6]) * &Polynomial::from_integers(&[-1, 2]);
        let k = NodeAlgebra::new(&m).expect("nodes");
        assert_eq!(
            shown(of_element(&k, &k.variable())),
            ["1/2 - sqrt(3)/6", "1/2", "1/2 + sqrt(3)/6"]
        );
        let f = Polynomial::from_integers(&[0, -12]);
        assert_eq!(
            shown(of_element(&k, &f)),
            ["-6 + 2*sqrt(3)", "-6", "-6 - 2*sqrt(3)"]
        );
        let centred = Polynomial::from_integers(&[-1, 2]);
        assert_eq!(
            shown(of_element(&k, &centred)),
            ["-sqrt(3)/3", "0", "sqrt(3)/3"]
        );
    }

    #[test]
    fn a_node_of_degree_4_has_no_short_form_and_a_quadratic_function_has() {
        // Gauss(4): z² = (3 ± 2√(6/5))/28 with z = x − 1/2.
        let m = Polynomial::from_integers(&[1, -20, 90, -140, 70]);
        let k = NodeAlgebra::new(&m).expect("nodes");
        assert_eq!(shown(of_element(&k, &k.variable())), ["-"; 4]);
        let z2 = Polynomial::from_rationals(&[ratio(1, 4), ratio(-1, 1), ratio(1, 1)]);
        let forms = shown(of_element(&k, &z2));
        assert_eq!(forms[0], "3/28 + sqrt(30)/70");
        assert_eq!(forms[1], "3/28 - sqrt(30)/70");
        assert_eq!(forms[0], forms[3]);
    }
}
