//! Nodes and weights: the classical rules on `[0, 1]`, each a rational node polynomial.
//!
//! A family is a few lines of data in a separate file: its name, its node polynomial, and the degree of
//! precision from the literature, which the tests compare with the exact one.

mod chebyshev;
mod clenshaw_curtis;
mod fejer;
mod gauss;
mod lobatto;
mod newton_cotes;
mod nodes;
mod radau;

pub use nodes::Nodes;

use std::borrow::Cow;
use std::sync::Arc;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use crate::algebra::{NodeAlgebra, StageAlgebra};
use crate::arithmetic::polynomial::Polynomial;
use crate::error::{Error, ErrorKind};
use crate::expression::{Expression, Input, shown};
use crate::limits::Limits;

/// A family of rules with one member for each number of nodes.
#[derive(Debug)]
pub struct Family {
    /// The name, as it is written: `gauss`.
    pub name: &'static str,
    /// What it is, in one line.
    pub description: &'static str,
    /// The smallest number of nodes.
    pub minimum: usize,
    /// The polynomial on `[0, 1]` whose roots are the nodes; any multiple of it.
    node_polynomial: fn(usize) -> Polynomial,
    /// The numbers of nodes for which all nodes are real, if not all.
    real_for: &'static str,
    /// The degree of precision that the literature states.
    #[cfg(test)]
    degree_of_precision: fn(usize) -> usize,
}

/// All families.
pub const FAMILIES: [&Family; 8] = [
    &gauss::FAMILY,
    &lobatto::FAMILY,
    &radau::LEFT,
    &radau::RIGHT,
    &chebyshev::FAMILY,
    &clenshaw_curtis::FAMILY,
    &fejer::FAMILY,
    &newton_cotes::FAMILY,
];

/// A quadrature rule `∫_0^1 f ≈ Σ_i b_i f(c_i)` with distinct real nodes in `[0, 1]` and the
/// interpolatory weights, all exact.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct QuadratureRule {
    name: String,
    algebra: Arc<NodeAlgebra>,
    weights: Polynomial,
    degree_of_precision: usize,
}

impl QuadratureRule {
    /// Reads `gauss(3)` or a list of distinct rationals in `[0, 1]`, e.g. `0, 1/3, 1`.
    ///
    /// # Errors
    /// As [`Nodes::parse`], and where the nodes are not all rational.
    ///
    /// ```
    /// use symplectic_compiler::{Limits, QuadratureRule};
    ///
    /// let rule = QuadratureRule::parse("lobatto(3)", &Limits::default())?;
    /// assert_eq!(rule.degree_of_precision(), 3);
    /// let error = QuadratureRule::parse("0, 1/2, 2/4", &Limits::default()).unwrap_err();
    /// assert_eq!(error.to_string(), "nodes, column 9: the node 1/2 is listed twice; nodes must be distinct");
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn parse(text: &str, limits: &Limits) -> Result<Self, Error> {
        match Nodes::parse("nodes", text, limits)? {
            Nodes::Rule(rule) => Ok(rule),
            Nodes::Listed { name, .. } => {
                let kind = ErrorKind::Type {
                    found: format!("the irrational list {}", shown(&name)),
                    expected: "a rule or a list of rationals".to_owned(),
                };
                Err(kind.into())
            }
        }
    }

    /// The member of a family with this number of nodes.
    pub(super) fn member(
        family: &Family,
        stages: &BigInt,
        limits: &Limits,
    ) -> Result<Self, ErrorKind> {
        if *stages < family.minimum.into() {
            let (rule, stages) = (family.name, stages.to_string());
            return Err(ErrorKind::TooFewStages {
                rule,
                stages,
                minimum: family.minimum,
            });
        }
        let stages = check_stages(stages, limits)?;
        let polynomial = (family.node_polynomial)(stages);
        Self::with_nodes(format!("{}({stages})", family.name), &polynomial).map_err(|kind| {
            match kind {
                ErrorKind::ComplexRoots { degree, real } => ErrorKind::ComplexNodes {
                    rule: family.name,
                    stages: degree,
                    real,
                    exist: family.real_for,
                },
                other => other,
            }
        })
    }

    /// The interpolatory rule whose nodes are the roots of a polynomial. Its `name` must be the text that is read as these nodes.
    ///
    /// # Errors
    /// Where the roots are not distinct reals in `[0, 1]`.
    #[doc(hidden)]
    pub fn with_nodes(name: String, polynomial: &Polynomial) -> Result<Self, ErrorKind> {
        let algebra = Arc::new(NodeAlgebra::new(polynomial)?);
        if let Some(outside) = first_outside(&algebra) {
            return Err(ErrorKind::NodeOutside {
                node: node_text(&algebra, outside),
            });
        }
        // b = Σ_k (∫ xᵏ) e_k with the dual basis e_k: the integral of the interpolation polynomial.
        let weights = algebra
            .dual_basis()
            .iter()
            .enumerate()
            .fold(Polynomial::zero(), |sum, (k, dual)| {
                &sum + &dual.scale(&moment(k))
            });
        let degree_of_precision = degree_of_precision(&algebra, &weights);
        Ok(QuadratureRule {
            name,
            algebra,
            weights,
            degree_of_precision,
        })
    }

    /// The rule as it is written: `gauss(3)`, or the list of its nodes in ascending order.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The algebra of functions on the nodes.
    pub fn algebra(&self) -> &Arc<NodeAlgebra> {
        &self.algebra
    }

    /// The number of nodes.
    pub fn len(&self) -> usize {
        self.algebra.dimension()
    }

    /// Never: a rule has at least one node.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The weights, `b_i = b(c_i)`.
    pub fn weights(&self) -> &Polynomial {
        &self.weights
    }

    /// The largest `d` such that the rule is exact for all polynomials of degree `d`. It is sharp: the
    /// rule is not exact for the power `d + 1`.
    pub fn degree_of_precision(&self) -> usize {
        self.degree_of_precision
    }
}

/// The number of stages as an argument `(s)`.
pub(crate) fn count(
    input: Input<'_>,
    call: &Expression,
    function: &str,
    arguments: &[Expression],
) -> Result<BigInt, Error> {
    match arguments {
        [stages] => stages.whole(input),
        _ => {
            let kind = ErrorKind::Arguments {
                function: function.to_owned(),
                expected: "one number, the number of stages".to_owned(),
                found: format!("{} arguments", arguments.len()),
            };
            Err(input.error(&call.span, kind))
        }
    }
}

/// A number of stages within the limits.
pub fn check_stages(stages: &BigInt, limits: &Limits) -> Result<usize, ErrorKind> {
    stages
        .to_usize()
        .filter(|&s| s <= limits.stages)
        .ok_or_else(|| ErrorKind::TooManyStages {
            stages: shown(&stages.to_string()),
            limit: limits.stages,
        })
}

/// `∫_0^1 xᵏ dx`.
pub(crate) fn moment(power: usize) -> BigRational {
    BigRational::new(BigInt::one(), (power + 1).into())
}

/// The first node outside `[0, 1]`.
pub(crate) fn first_outside(algebra: &NodeAlgebra) -> Option<usize> {
    let (zero, one) = (BigRational::zero(), BigRational::one());
    let outside = |index: usize| match algebra.roots()[index].rational() {
        Some(value) => *value < zero || *value > one,
        None => {
            // Irrational, so neither 0 nor 1: some enclosure decides.
            let mut bits = 64;
            loop {
                let enclosure = &algebra.enclose_nodes(bits)[index];
                if !enclosure.contains(&zero) && !enclosure.contains(&one) {
                    return enclosure.low() < zero || enclosure.high() > one;
                }
                bits *= 2;
            }
        }
    };
    (0..algebra.dimension()).find(|&index| outside(index))
}

/// A node as it is shown in messages: exactly where that is short.
pub(crate) fn node_text(algebra: &NodeAlgebra, index: usize) -> String {
    let variable = algebra.variable();
    let exact = algebra.exact_values(&variable).swap_remove(index);
    exact.unwrap_or_else(|| {
        let node = &algebra.values(Cow::Owned(variable))[index];
        node.decimal(10).to_string()
    })
}

/// The exact degree of precision of a rule, by traces.
fn degree_of_precision(algebra: &NodeAlgebra, weights: &Polynomial) -> usize {
    let mut powers = weights.clone();
    let mut degree = 0;
    // The degree is at most 2s − 1, because ∫ m² > 0 = Σ b_i m(c_i)².
    loop {
        powers = algebra.multiply(&powers, &Polynomial::variable());
        if algebra.trace(&powers) != moment(degree + 1) {
            return degree;
        }
        degree += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rule(text: &str) -> QuadratureRule {
        QuadratureRule::parse(text, &Limits::default())
            .unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    fn error(text: &str) -> String {
        QuadratureRule::parse(text, &Limits::default())
            .expect_err(text)
            .to_string()
    }

    #[test]
    fn every_degree_of_precision_is_the_known_one_and_sharp() {
        for family in FAMILIES {
            for stages in family.minimum..=9 {
                let Ok(rule) = QuadratureRule::member(family, &stages.into(), &Limits::default())
                else {
                    assert_eq!((family.name, stages), ("chebyshev", 8));
                    continue;
                };
                let degree = (family.degree_of_precision)(stages);
                assert_eq!(rule.degree_of_precision(), degree, "{}", rule.name());
                // Sharpness against an independent route: the quadrature of powers by traces.
                for power in 0..=degree + 1 {
                    let sum = rule
                        .algebra()
                        .trace(&(rule.weights() * &Polynomial::monomial(power)));
                    assert_eq!(
                        sum == moment(power),
                        power <= degree,
                        "{} x^{power}",
                        rule.name()
                    );
                }
            }
        }
    }

    #[test]
    fn names_of_families_are_read_as_they_are_written() {
        for family in FAMILIES {
            let (name, count) = (family.name, family.minimum.max(2));
            assert_eq!(rule(&format!("{name}({count})")).len(), count);
        }
    }

    #[test]
    fn chebyshev_weights_are_equal() {
        for stages in [1, 2, 3, 4, 5, 6, 7, 9] {
            let rule = rule(&format!("chebyshev({stages})"));
            assert_eq!(
                *rule.weights(),
                Polynomial::constant(crate::arithmetic::rational::ratio(1, stages))
            );
        }
    }

    #[test]
    fn listed_nodes_are_sorted_and_give_the_known_rules() {
        assert_eq!(rule("[1, 0, 1/3]").name(), "0, 1/3, 1");
        assert_eq!(rule("0, 1/2, 1").algebra(), rule("lobatto(3)").algebra());
        assert_eq!(
            rule("0, 1/2, 1").weights(),
            rule("newton-cotes(3)").weights()
        );
    }

    #[test]
    fn wrong_rules_are_refused_with_the_reason() {
        let cases = [
            (
                "gauss(0)",
                "nodes, column 1: `gauss(0)` does not exist: `gauss(s)` needs s ≥ 1",
            ),
            ("gauss(-3)", "nodes, column 1: `gauss(-3)` does not exist"),
            (
                "lobatto(1)",
                "nodes, column 1: `lobatto(1)` does not exist: `lobatto(s)` needs s ≥ 2",
            ),
            (
                "chebyshev(8)",
                "nodes, column 1: `chebyshev(8)` has only 2 real nodes out of 8; real nodes exist only for s = 1, …, 7 and 9",
            ),
            ("chebyshev(10)", "nodes, column 1: `chebyshev(10)` has only"),
            (
                "gauss(1/2)",
                "nodes, column 7: found 1/2, expected a whole number",
            ),
            (
                "gauss()",
                "nodes, column 1: `gauss` takes one number, the number of stages, found 0 arguments",
            ),
            (
                "gauss(37)",
                "nodes, column 1: 37 stages exceed the limit of 36",
            ),
            (
                "gauss(10^300)",
                "nodes, column 1: 1000000000000000000000000000000000000000… stages exceed",
            ),
            (
                "gaus(3)",
                "nodes, column 1: unknown quadrature rule `gaus`; known here: gauss, lobatto, radau-left",
            ),
            (
                "0, 1, 3/2",
                "nodes, column 7: the node 3/2 lies outside [0, 1]",
            ),
            (
                "0, -1/9",
                "nodes, column 4: the node -1/9 lies outside [0, 1]",
            ),
            (
                "0, t",
                "nodes, column 4: found an expression that depends on `t`, expected a constant",
            ),
        ];
        for (text, message) in cases {
            assert!(error(text).starts_with(message), "{text}: {}", error(text));
        }
    }

    #[test]
    fn irrational_nodes_outside_are_found() {
        // Roots (1 ± √5)/2.
        let kind = QuadratureRule::with_nodes("x".into(), &Polynomial::from_integers(&[-1, -1, 1]))
            .expect_err("outside");
        assert_eq!(
            kind,
            ErrorKind::NodeOutside {
                node: "1/2 - sqrt(5)/2".into()
            }
        );
    }
}
