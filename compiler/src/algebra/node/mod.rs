//! The node algebra `K = Q[x]/(m)`: exact arithmetic on functions of the nodes.
//!
//! Let the nodes `c_1 < … < c_s` be the roots of a squarefree rational polynomial `m`. A quantity with one index is
//! a polynomial `f` modulo `m` with `f_i = f(c_i)`. A quantity with two indices is an element of `K ⊗ K`, a
//! polynomial in `x` and `y` modulo `m(x)` and `m(y)`. Sums over nodes are traces. `m` may be reducible; no
//! splitting field is ever built, and no root is approximated to derive or to prove anything.

mod closed_form;
mod divisor;
mod number;
mod stages;
mod tensor;

use std::sync::{Arc, Mutex, OnceLock};

use num_bigint::BigInt;
use num_rational::BigRational;

use super::StageAlgebra;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::power_sums::power_sums;
use crate::arithmetic::roots::{Root, enclose_from, real_roots};
use crate::error::ErrorKind;
use crate::expression::{Input, parse_list};
use crate::symbolic::Constant;

pub use closed_form::ClosedForm;
pub(super) use closed_form::short_rational;
pub use number::NodeNumber;
pub use tensor::Tensor;

/// Enclosures have a multiple of this number of binary places, so that few are computed.
const ENCLOSURE_STEP: u32 = 64;

/// The algebra `Q[x]/(m)` of functions on the roots of a squarefree polynomial with only real roots.
///
/// Its elements are polynomials of degree less than the number of nodes.
#[derive(Debug)]
pub struct NodeAlgebra {
    modulus: Polynomial,
    roots: Vec<Root>,
    /// `Tr xᵏ = Σ_i c_iᵏ` for `k < 2s − 1`, the powers that occur in a product of two elements, as the coefficients
    /// of a polynomial.
    power_sums: Polynomial,
    /// The finest enclosures of the nodes so far.
    enclosures: Mutex<Option<Arc<Vec<Interval>>>>,
    /// Short exact forms of the nodes, computed on demand.
    forms: OnceLock<Vec<Option<ClosedForm>>>,
}

impl NodeAlgebra {
    /// The algebra of functions on the roots of `polynomial`.
    ///
    /// # Errors
    /// If the roots are not distinct, not real, or there are none.
    pub fn new(polynomial: &Polynomial) -> Result<Self, ErrorKind> {
        let modulus = polynomial.primitive();
        let degree = modulus.degree().unwrap_or(0);
        if degree == 0 || modulus.gcd(&modulus.derivative()).degree() != Some(0) {
            return Err(ErrorKind::NotSquarefree {
                polynomial: modulus.display("x").to_string(),
            });
        }
        let roots = real_roots(&modulus);
        if roots.len() != degree {
            return Err(ErrorKind::ComplexRoots {
                degree,
                real: roots.len(),
            });
        }
        let power_sums = Polynomial::from_rationals(&power_sums(&modulus, 2 * degree - 1));
        Ok(NodeAlgebra {
            modulus,
            roots,
            power_sums,
            enclosures: Mutex::new(None),
            forms: OnceLock::new(),
        })
    }

    /// The number of nodes, which is the dimension of the algebra.
    pub fn dimension(&self) -> usize {
        self.roots.len()
    }

    /// The node polynomial, primitive: coprime integer coefficients, with a positive leading coefficient.
    pub fn modulus(&self) -> &Polynomial {
        &self.modulus
    }

    /// The nodes in ascending order.
    pub fn roots(&self) -> &[Root] {
        &self.roots
    }

    /// The function `c_i ↦ c_i`.
    pub fn variable(&self) -> Polynomial {
        self.reduce(&Polynomial::variable())
    }

    /// A polynomial as a function on the nodes.
    pub fn reduce(&self, polynomial: &Polynomial) -> Polynomial {
        polynomial.remainder(&self.modulus)
    }

    /// The product, node by node.
    pub fn multiply(&self, left: &Polynomial, right: &Polynomial) -> Polynomial {
        self.reduce(&(left * right))
    }

    /// The inverse, node by node.
    ///
    /// # Errors
    /// If the element is not a unit: the common divisor of the element and the node polynomial, whose
    /// roots are the nodes at which the element vanishes.
    pub fn inverse(&self, element: &Polynomial) -> Result<Polynomial, Polynomial> {
        element.inverse_modulo(&self.modulus)
    }

    /// Short exact forms of the values of an element at all nodes, if there are any.
    pub fn closed_values(&self, element: &Polynomial) -> Vec<Option<ClosedForm>> {
        closed_form::of_element(self, element)
    }

    /// Short exact forms of the entries of a matrix, if there are any.
    pub fn closed_entries(&self, matrix: &Tensor) -> Vec<Vec<Option<ClosedForm>>> {
        closed_form::of_tensor(self, matrix)
    }

    /// The trace `Σ_i f(c_i)`.
    pub fn trace(&self, element: &Polynomial) -> BigRational {
        if element.degree() < Some(2 * self.dimension() - 1) {
            self.trace_of_numerators(element.numerators(), element.denominator())
        } else {
            self.trace(&self.reduce(element))
        }
    }

    /// The trace of a product of two elements, `Σ_i f(c_i) g(c_i)`, without reducing the product.
    pub fn trace_of_product(&self, left: &Polynomial, right: &Polynomial) -> BigRational {
        let s = self.dimension();
        let (f, g) = (left.numerators(), right.numerators());
        if f.len() > s || g.len() > s {
            return self.trace(&self.multiply(left, right));
        }
        let mut product = vec![BigInt::default(); (f.len() + g.len()).saturating_sub(1)];
        for (i, x) in f.iter().enumerate() {
            for (sum, y) in product[i..].iter_mut().zip(g) {
                *sum += x * y;
            }
        }
        self.trace_of_numerators(&product, &(left.denominator() * right.denominator()))
    }

    /// The trace of a polynomial of degree less than `2s − 1`.
    fn trace_of_numerators(&self, numerators: &[BigInt], denominator: &BigInt) -> BigRational {
        let products = numerators
            .iter()
            .zip(self.power_sums.numerators())
            .map(|(n, p)| n * p);
        BigRational::new(products.sum(), denominator * self.power_sums.denominator())
    }

    /// The basis of `K` that is dual to the powers of `x`: elements `e_k` with
    /// `Σ_k xᵏ e_k(y) = δ(x, y)`, which is 1 at equal nodes and 0 at different ones.
    ///
    /// From `δ(x, y) = (m(x) − m(y))/(x − y) · m'(y)⁻¹`.
    pub fn dual_basis(&self) -> Vec<Polynomial> {
        let m = self.modulus.coefficients();
        // m is squarefree, so its derivative is a unit.
        let unit = self
            .inverse(&self.modulus.derivative())
            .unwrap_or_else(|_| Polynomial::zero());
        (0..self.dimension())
            .map(|k| self.multiply(&Polynomial::from_rationals(&m[k + 1..]), &unit))
            .collect()
    }

    /// The nodes as constants, in ascending order.
    ///
    /// # Errors
    /// [`ErrorKind::ExpressionSize`] if the node polynomial is beyond the bounds of constants.
    pub fn node_constants(&self) -> Result<Vec<Constant>, ErrorKind> {
        let exact = self.exact_values(&self.variable());
        let node = |(index, text): (usize, &Option<String>)| match text {
            // The printed text is read again.
            Some(text) => {
                let input = Input {
                    name: "nodes",
                    text,
                };
                let items = parse_list(input).map_err(|error| *error.kind)?;
                items[0].constant(input).map_err(|error| *error.kind)
            }
            None => Constant::root(&self.modulus, &BigInt::from(index + 1)),
        };
        exact.iter().enumerate().map(node).collect()
    }

    /// Enclosures of all nodes with at least this number of binary places.
    pub(crate) fn enclose_nodes(&self, bits: u32) -> Arc<Vec<Interval>> {
        // The next request often has a few more places.
        let bits = bits.next_multiple_of(ENCLOSURE_STEP);
        let mut cache = self
            .enclosures
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        match &*cache {
            Some(known) if known.first().is_some_and(|i| i.bits() == bits) => Arc::clone(known),
            // A coarser enclosure comes from the finest.
            Some(known) if known.first().is_some_and(|i| i.bits() > bits) => {
                Arc::new(known.iter().map(|node| node.with_bits(bits)).collect())
            }
            known => {
                let known = |index: usize| known.as_ref().and_then(|known| known.get(index));
                let roots = self.roots.iter().enumerate();
                let nodes =
                    roots.map(|(i, root)| enclose_from(&self.modulus, root, known(i), bits));
                let nodes = Arc::new(nodes.collect());
                Arc::clone(cache.insert(nodes))
            }
        }
    }

    /// Enclosures of the values of an element at all nodes.
    pub fn enclose(&self, element: &Polynomial, bits: u32) -> Vec<Interval> {
        self.enclose_nodes(bits)
            .iter()
            .map(|node| node.evaluate(element))
            .collect()
    }
}

impl PartialEq for NodeAlgebra {
    fn eq(&self, other: &Self) -> bool {
        self.modulus == other.modulus
    }
}

impl Eq for NodeAlgebra {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use num_traits::One;
    use proptest::prelude::*;

    fn algebra() -> NodeAlgebra {
        // (6x² − 6x + 1)·x·(3x − 2): reducible, with irrational and rational nodes.
        let m = [[1, -6, 6].as_slice(), &[0, 1], &[-2, 3]]
            .iter()
            .fold(Polynomial::one(), |p, c| &p * &Polynomial::from_integers(c));
        NodeAlgebra::new(&m).expect("distinct real roots")
    }

    #[test]
    fn the_dual_basis_gives_the_identity() {
        let k = algebra();
        let dual = k.dual_basis();
        // Σ_j δ(x, c_j) f(c_j) = f(x) for every f; on powers it is Tr(e_k xˡ) = δ_kl.
        for (i, e) in dual.iter().enumerate() {
            for j in 0..k.dimension() {
                assert_eq!(
                    k.trace(&k.multiply(e, &Polynomial::monomial(j))),
                    ratio(i64::from(i == j), 1)
                );
            }
        }
    }

    #[test]
    fn an_element_that_vanishes_at_a_node_has_no_inverse() {
        let k = algebra();
        let f = Polynomial::from_integers(&[-2, 3]);
        assert_eq!(k.inverse(&f), Err(f.clone()));
        assert_eq!(k.inverse(&Polynomial::zero()), Err(k.modulus().clone()));
    }

    #[test]
    fn bad_node_polynomials_are_refused() {
        let new = |c: &[i64]| NodeAlgebra::new(&Polynomial::from_integers(c)).err();
        assert!(matches!(
            new(&[1, -2, 1]),
            Some(ErrorKind::NotSquarefree { .. })
        ));
        assert!(matches!(new(&[3]), Some(ErrorKind::NotSquarefree { .. })));
        assert!(matches!(new(&[]), Some(ErrorKind::NotSquarefree { .. })));
        assert_eq!(
            new(&[1, 0, 1]),
            Some(ErrorKind::ComplexRoots { degree: 2, real: 0 })
        );
    }

    proptest! {
        #[test]
        fn an_inverse_times_its_element_is_one(c in prop::collection::vec(-9i64..9, 4)) {
            let k = algebra();
            let f = Polynomial::from_integers(&c);
            match k.inverse(&f) {
                Ok(inverse) => prop_assert_eq!(k.multiply(&f, &inverse), Polynomial::one()),
                Err(divisor) => {
                    prop_assert!(divisor.degree() > Some(0) || f.is_zero());
                    prop_assert!(k.modulus().remainder(&divisor).is_zero());
                    prop_assert!(f.remainder(&divisor).is_zero());
                }
            }
        }

        #[test]
        fn the_trace_is_the_sum_over_the_nodes(c in prop::collection::vec(-9i64..9, 7)) {
            let k = algebra();
            let f = Polynomial::from_integers(&c);
            let sum = k.enclose(&k.reduce(&f), 80).into_iter().reduce(|a, b| a.add(&b)).expect("nodes");
            prop_assert!(sum.contains(&k.trace(&f)));
            prop_assert!(sum.high() - sum.low() < BigRational::new(One::one(), BigInt::one() << 60));
        }
    }
}
