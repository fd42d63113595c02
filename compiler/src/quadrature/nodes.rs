//! Nodes as they are written: a rule, or a list of numbers.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;

use super::{FAMILIES, QuadratureRule, check_stages, count};
use crate::arithmetic::polynomial::Polynomial;
use crate::error::{Error, ErrorKind};
use crate::expression::{Expression, ExpressionKind, Input, parse_list, shown};
use crate::limits::Limits;
use crate::symbolic::Constant;

/// Distinct real nodes in `[0, 1]`, in ascending order.
#[derive(Debug, Clone, PartialEq)]
pub enum Nodes {
    /// All roots of one rational polynomial, with the interpolatory rule at them.
    Rule(QuadratureRule),
    /// Any other list.
    Listed {
        /// The list as it is written.
        name: String,
        /// Its numbers.
        values: Vec<Constant>,
    },
}

/// The longest node polynomial that a list of nodes may have: the time of a derivation grows with the
/// length of its coefficients as with the number of stages.
const MAX_NODE_BITS: usize = 1024;

impl Nodes {
    /// Reads `gauss(3)` or a list of distinct numbers in `[0, 1]`: `0, 1/3, 1`, or
    /// `1/2 - sqrt(2)/4, 1/2 + sqrt(2)/4`. `part` is what errors call the text.
    ///
    /// # Errors
    /// Wrong expressions, unknown rules, too many or too few nodes, rules whose nodes are not all
    /// real, equal nodes and nodes outside `[0, 1]`, each at its place in the text.
    pub fn parse(part: &'static str, text: &str, limits: &Limits) -> Result<Self, Error> {
        Self::parse_ordered(part, text, limits).map(|(nodes, _)| nodes)
    }

    /// As [`Nodes::parse`], with the places that the nodes have in the text, in ascending order of the nodes.
    ///
    /// # Errors
    /// As [`Nodes::parse`].
    pub(crate) fn parse_ordered(
        part: &'static str,
        text: &str,
        limits: &Limits,
    ) -> Result<(Self, Vec<usize>), Error> {
        let input = Input { name: part, text };
        let items = parse_list(input)?;
        if let [item] = items.as_slice()
            && let ExpressionKind::Call {
                function,
                name,
                arguments,
            } = &item.kind
        {
            if let Some(family) = FAMILIES.iter().find(|family| family.name == function) {
                let stages = count(input, item, family.name, arguments)?;
                let rule = QuadratureRule::member(family, &stages, limits);
                return rule
                    .map(|rule| ((0..rule.len()).collect(), rule))
                    .map(|(order, rule)| (Nodes::Rule(rule), order))
                    .map_err(|kind| input.error(&item.span, kind));
            }
            if !crate::symbolic::FUNCTIONS.contains(&function.as_str()) {
                let known = FAMILIES.map(|family| family.name).join(", ");
                let kind = ErrorKind::Unknown {
                    what: "quadrature rule",
                    name: function.clone(),
                    known: format!("{known}, or a list of numbers"),
                };
                return Err(input.error(name, kind));
            }
        }
        Self::list(input, &items, limits)
    }

    fn list(
        input: Input<'_>,
        items: &[Expression],
        limits: &Limits,
    ) -> Result<(Self, Vec<usize>), Error> {
        let whole = 0..input.text.len();
        check_stages(&items.len().into(), limits).map_err(|kind| input.error(&whole, kind))?;
        let mut nodes: Vec<Constant> = Vec::new();
        let mut order: Vec<usize> = Vec::new();
        for (index, item) in items.iter().enumerate() {
            let at = |kind| input.error(&item.span, kind);
            let node = item.constant(input)?;
            let outside = compare(&node, &Constant::zero()).map_err(at)? == Ordering::Less
                || compare(&node, &Constant::one()).map_err(at)? == Ordering::Greater;
            if outside {
                let node = shown(&node.to_string());
                return Err(at(ErrorKind::NodeOutside { node }));
            }
            // Inserted in ascending order.
            let mut place = 0;
            while place < nodes.len() {
                match compare(&nodes[place], &node).map_err(at)? {
                    Ordering::Less => place += 1,
                    Ordering::Equal => {
                        let node = shown(&node.to_string());
                        return Err(at(ErrorKind::EqualNodes { node }));
                    }
                    Ordering::Greater => break,
                }
            }
            nodes.insert(place, node);
            order.insert(place, index);
        }
        let texts: Vec<String> = nodes.iter().map(ToString::to_string).collect();
        let name = texts.join(", ");
        let rational: Option<Vec<&BigRational>> = nodes.iter().map(Constant::as_rational).collect();
        let Some(rational) = rational else {
            let values = nodes;
            return Ok((Nodes::Listed { name, values }, order));
        };
        let bits = rational.iter().map(|node| node.denom().bits() as usize);
        let size = bits.sum();
        if size > MAX_NODE_BITS {
            let what = "the length of all denominators together in bits";
            let kind = ErrorKind::ExpressionSize {
                what,
                size,
                limit: MAX_NODE_BITS,
            };
            return Err(input.error(&whole, kind));
        }
        let one = BigRational::from_integer(BigInt::from(1));
        let polynomial = rational.iter().fold(Polynomial::one(), |product, &node| {
            &product * &Polynomial::from_rationals(&[-node, one.clone()]).primitive()
        });
        QuadratureRule::with_nodes(name, &polynomial)
            .map(|rule| (Nodes::Rule(rule), order))
            .map_err(|kind| input.error(&whole, kind))
    }

    /// The nodes as they are written.
    pub fn name(&self) -> &str {
        match self {
            Nodes::Rule(rule) => rule.name(),
            Nodes::Listed { name, .. } => name,
        }
    }

    /// The number of nodes.
    pub fn len(&self) -> usize {
        match self {
            Nodes::Rule(rule) => rule.len(),
            Nodes::Listed { values, .. } => values.len(),
        }
    }

    /// Never: there is at least one node.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The nodes as constants.
    ///
    /// # Errors
    /// [`ErrorKind::ExpressionSize`] where the node polynomial is beyond the bounds of constants.
    pub fn constants(&self) -> Result<Vec<Constant>, ErrorKind> {
        match self {
            Nodes::Listed { values, .. } => Ok(values.clone()),
            Nodes::Rule(rule) => rule.algebra().node_constants(),
        }
    }
}

/// Compares two constants.
///
/// # Errors
/// [`ErrorKind::Undecided`] where no enclosure separates them and no exact argument makes them equal.
fn compare(x: &Constant, y: &Constant) -> Result<Ordering, ErrorKind> {
    let difference = x.subtract(y)?;
    difference.sign().ok_or_else(|| difference.undecided())
}
