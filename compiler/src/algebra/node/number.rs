//! Values of functions of the nodes: algebraic numbers.

use std::borrow::Cow;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use num_rational::BigRational;
use num_traits::Zero;

use super::tensor::magnitude_bits;
use super::{NodeAlgebra, Tensor, divisor};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;

/// The value of an element of `K` at a node, or of an element of `K ⊗ K` at two nodes: an algebraic number.
///
/// Questions about it are answered exactly: its sign, whether it equals a rational, its value rounded
/// to a double or to any number of digits.
#[derive(Debug, Clone)]
pub struct NodeNumber<'a> {
    algebra: &'a NodeAlgebra,
    source: Source<'a>,
    /// A first enclosure.
    start: Interval,
}

#[derive(Debug, Clone)]
enum Source<'a> {
    Element(Cow<'a, Polynomial>, usize),
    Entry(&'a Tensor, usize, usize, Arc<Row>),
}

/// The data known about the entries of a row.
#[derive(Debug)]
struct Row {
    /// The finest enclosures so far, which are computed together.
    finest: Mutex<Vec<Interval>>,
    /// Which of them are zero, as far as this has been decided.
    zeros: Vec<OnceLock<bool>>,
}

/// Binary places of the first enclosure, in addition to the cancellation that the coefficients suggest.
const FIRST_BITS: u32 = 192;

impl<'a> NodeNumber<'a> {
    /// The values of an element at all nodes.
    pub fn of_element(algebra: &'a NodeAlgebra, element: Cow<'a, Polynomial>) -> Vec<Self> {
        let bits = FIRST_BITS + magnitude_bits(&element);
        let starts = algebra.enclose(&element, bits);
        let number = |(node, start)| NodeNumber {
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
        NodeNumber {
            algebra,
            source: Source::Element(Cow::Owned(element), node),
            start,
        }
    }

    /// The entries of one row of a matrix.
    pub fn of_row(algebra: &'a NodeAlgebra, tensor: &'a Tensor, row: usize) -> Vec<Self> {
        let nodes = algebra.enclose_nodes(FIRST_BITS + tensor.bits());
        let starts = tensor.enclose_row(&nodes, row);
        let known = Arc::new(Row {
            zeros: vec![OnceLock::new(); starts.len()],
            finest: Mutex::new(starts.clone()),
        });
        let number = |(column, start)| NodeNumber {
            algebra,
            source: Source::Entry(tensor, row, column, Arc::clone(&known)),
            start,
        };
        starts.into_iter().enumerate().map(number).collect()
    }

    /// An enclosure with at least this many binary places.
    ///
    /// Its width tends to zero as `bits` grows.
    pub fn enclose(&self, bits: u32) -> Interval {
        if bits <= self.start.bits() {
            return self.start.clone();
        }
        match &self.source {
            Source::Element(element, node) => {
                let bits = bits + magnitude_bits(element);
                self.algebra.enclose_nodes(bits)[*node].evaluate(element)
            }
            Source::Entry(tensor, row, column, known) => {
                let bits = bits + tensor.bits();
                let mut finest = known.finest.lock().unwrap_or_else(PoisonError::into_inner);
                if finest[*column].bits() < bits {
                    *finest = tensor.enclose_row(&self.algebra.enclose_nodes(bits), *row);
                }
                finest[*column].clone()
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
            Source::Entry(tensor, row, column, known) if value.is_zero() => *known.zeros[*column]
                .get_or_init(|| entry_vanishes(self.algebra, tensor, *row, *column)),
            Source::Entry(tensor, row, column, _) => {
                let shifted = tensor.subtract(&Tensor::from_products(
                    self.algebra,
                    &[(Polynomial::constant(value.clone()), Polynomial::one())],
                ));
                entry_vanishes(self.algebra, &shifted, *row, *column)
            }
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
