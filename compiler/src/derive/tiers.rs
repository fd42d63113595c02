//! The algebra in which a problem is solved: the strongest one that holds its numbers.

use std::fmt;
use std::sync::Arc;

use num_rational::BigRational;
use num_traits::Zero;

use super::concatenate::concatenate;
use super::dense::{self, Samples};
use super::node;
use super::problem::{Construction, Momenta};
use super::reading::outside;
use crate::algebra::{self, Constants, Dense, Field, NodeAlgebra, Reals};
use crate::arithmetic::polynomial::Polynomial;
use crate::basis::{Basis, Coefficient, combination};
use crate::error::ErrorKind;
use crate::exact::Exact;
use crate::partitioned::Partitioned;
use crate::quadrature::{Nodes, node_text};
use crate::symbolic::{Constant, Function};

impl Construction {
    /// Derives the coefficients.
    pub(super) fn exact(&self) -> Result<Exact, ErrorKind> {
        match self {
            Construction::Collocation { basis, nodes } => collocation(basis, nodes),
            Construction::Galerkin {
                basis,
                nodes,
                weights,
            } => galerkin(basis, nodes, weights.as_deref()),
            Construction::Given { a, b, momenta } => given(a, b, momenta),
            Construction::Splitting(splitting) => splitting.sequence().exact(),
            Construction::Certified(certified) => certified.sequence().exact(),
            Construction::Based(based) => based.exact(),
            Construction::Composition { .. } | Construction::Processed(_) => {
                let steps = self.composed().unwrap_or_default();
                if let Some(sequence) = self.sequence() {
                    return sequence.exact();
                }
                let methods = steps.iter().map(|step| step.method.exact());
                let methods: Vec<Arc<Exact>> = methods.collect::<Result<_, _>>()?;
                let fractions = steps.iter().map(|step| &step.fraction);
                let methods = methods.iter().map(|exact| &**exact);
                concatenate(&fractions.zip(methods).collect::<Vec<_>>())
            }
        }
    }
}

fn collocation(basis: &Basis, nodes: &Nodes) -> Result<Exact, ErrorKind> {
    if basis.len() != nodes.len() {
        return Err(ErrorKind::NotSquare {
            basis: basis.len(),
            nodes: nodes.len(),
        });
    }
    if let (Some(polynomials), Nodes::Rule(rule)) = (basis.polynomials(), nodes) {
        let pair = node::collocation(polynomials, rule.algebra());
        return pair
            .map(Exact::Nodes)
            .map_err(|failure| in_node_algebra(failure, polynomials, rule.algebra(), false));
    }
    let functions = basis.functions()?;
    let constants = nodes.constants()?;
    let samples = Samples::new(&functions, &constants)?;
    let explain = Explanation {
        gram: false,
        functions: &functions,
        nodes: &constants,
    };
    match Constants::containing(samples.constants()) {
        Some(field) => {
            let pair = dense::collocation(field.clone(), &elements(&samples, &field)?);
            pair.map(Exact::Field)
                .map_err(|failure| explain.failure(&field, failure))
        }
        None => {
            let pair = dense::collocation(Reals, &elements(&samples, &Reals)?);
            pair.map(Exact::Reals)
                .map_err(|failure| explain.failure(&Reals, failure))
        }
    }
}

fn galerkin(
    basis: &Basis,
    nodes: &Nodes,
    weights: Option<&[Constant]>,
) -> Result<Exact, ErrorKind> {
    if basis.len() > nodes.len() {
        return Err(ErrorKind::NotRectangular {
            basis: basis.len(),
            nodes: nodes.len(),
        });
    }
    if let (Some(polynomials), Nodes::Rule(rule), None) = (basis.polynomials(), nodes, weights) {
        return node::galerkin(polynomials, rule)
            .map(Exact::Nodes)
            .map_err(|failure| in_node_algebra(failure, polynomials, rule.algebra(), true));
    }
    // All polynomials of degree less than the number of nodes: the weights of the square construction are
    // the interpolatory ones, and everything else agrees too.
    let spans = |f: &[Polynomial]| f.iter().all(|f| f.degree() < Some(nodes.len()));
    if weights.is_none() && basis.len() == nodes.len() && basis.polynomials().is_some_and(spans) {
        return collocation(basis, nodes);
    }
    let functions = basis.functions()?;
    let constants = nodes.constants()?;
    let samples = Samples::new(&functions, &constants)?;
    let powers = Basis::monomials(constants.len());
    let moments = Samples::new(&powers.functions()?, &constants)?;
    let needed = samples.constants().chain(moments.constants());
    let needed = needed.chain(weights.unwrap_or_default());
    let explain = Explanation {
        gram: true,
        functions: &functions,
        nodes: &constants,
    };
    match Constants::containing(needed) {
        Some(field) => {
            let pair = dense_galerkin(&field, &samples, &moments, weights);
            pair.map(Exact::Field)
                .map_err(|failure| explain.failure(&field, failure))
        }
        None => {
            let pair = dense_galerkin(&Reals, &samples, &moments, weights);
            pair.map(Exact::Reals)
                .map_err(|failure| explain.failure(&Reals, failure))
        }
    }
}

fn dense_galerkin<F: Field + Clone>(
    field: &F,
    samples: &Samples<Constant>,
    moments: &Samples<Constant>,
    weights: Option<&[Constant]>,
) -> Result<Partitioned<Dense<F>>, dense::Failure<F::Element>> {
    let b = match weights {
        Some(weights) => weights.iter().map(|w| field.constant(w)).collect(),
        None => Some(dense::interpolatory_weights(
            field,
            &elements(moments, field).map_err(dense::Failure::Kind)?,
        )?),
    };
    let b = b.ok_or(dense::Failure::Kind(outside()))?;
    let samples = elements(samples, field).map_err(dense::Failure::Kind)?;
    dense::galerkin(field.clone(), &samples, b)
}

fn given(a: &[Vec<Constant>], b: &[Constant], momenta: &Momenta) -> Result<Exact, ErrorKind> {
    let mut all: Vec<&Constant> = a.iter().flatten().chain(b).collect();
    if let Momenta::Given { a_tilde, b_tilde } = momenta {
        all.extend(a_tilde.iter().flatten().chain(b_tilde));
    }
    let row_sum = |row: &Vec<Constant>| {
        let zero = Ok(Constant::zero());
        row.iter()
            .fold(zero, |sum: Result<_, ErrorKind>, x| sum?.add(x))
    };
    let nodes: Vec<Constant> = a.iter().map(row_sum).collect::<Result<_, _>>()?;
    let explain = Explanation {
        gram: false,
        functions: &[],
        nodes: &nodes,
    };
    match Constants::containing(all) {
        Some(field) => {
            let pair = given_in(&field, a, b, momenta);
            pair.map(Exact::Field)
                .map_err(|failure| explain.failure(&field, failure))
        }
        None => {
            let pair = given_in(&Reals, a, b, momenta);
            pair.map(Exact::Reals)
                .map_err(|failure| explain.failure(&Reals, failure))
        }
    }
}

fn given_in<F: Field + Clone>(
    field: &F,
    a: &[Vec<Constant>],
    b: &[Constant],
    momenta: &Momenta,
) -> Result<Partitioned<Dense<F>>, dense::Failure<F::Element>> {
    let vector = |v: &[Constant]| -> Result<Vec<F::Element>, _> {
        let elements = v.iter().map(|c| field.constant(c));
        let elements: Option<Vec<_>> = elements.collect();
        elements.ok_or(dense::Failure::Kind(outside()))
    };
    let matrix = |m: &[Vec<Constant>]| -> Result<Vec<Vec<F::Element>>, _> {
        m.iter().map(|row| vector(row)).collect()
    };
    let algebra = Arc::new(Dense::new(field.clone(), b.len()));
    let (a, b) = (matrix(a)?, vector(b)?);
    match momenta {
        Momenta::Equal => Ok(Partitioned::equal(algebra, a, b)),
        Momenta::SymplecticPartner => {
            Partitioned::symplectic(algebra, a, b).map_err(dense::Failure::from)
        }
        Momenta::Given { a_tilde, b_tilde } => Ok(Partitioned {
            algebra,
            a_tilde: matrix(a_tilde)?,
            b_tilde: vector(b_tilde)?,
            a,
            b,
            gradient: None,
        }),
    }
}

fn elements<F: Field>(
    samples: &Samples<Constant>,
    field: &F,
) -> Result<Samples<F::Element>, ErrorKind> {
    samples.in_field(field).ok_or_else(outside)
}

fn in_node_algebra(
    failure: node::Failure,
    functions: &[Polynomial],
    algebra: &NodeAlgebra,
    gram: bool,
) -> ErrorKind {
    match failure {
        node::Failure::Singular(coefficients) => {
            let texts: Vec<String> = functions
                .iter()
                .map(|f| f.display("t").to_string())
                .collect();
            let combination = combination(&texts, &coefficients);
            if gram {
                ErrorKind::SingularGram { combination }
            } else {
                ErrorKind::SingularBasis { combination }
            }
        }
        node::Failure::ZeroWeight(index) => ErrorKind::ZeroWeight {
            index: index + 1,
            node: node_text(algebra, index),
        },
    }
}

/// The data that messages about a derivation over a field mention.
struct Explanation<'a> {
    /// Whether the matrix is the Gram matrix of the functions.
    gram: bool,
    functions: &'a [Function],
    nodes: &'a [Constant],
}

impl Explanation<'_> {
    fn failure<F: Field>(&self, field: &F, failure: dense::Failure<F::Element>) -> ErrorKind {
        match failure {
            dense::Failure::Kind(kind) => kind,
            dense::Failure::Singular(singular) => {
                let texts: Vec<String> = self.functions.iter().map(ToString::to_string).collect();
                let coefficients: Vec<Shown> = singular
                    .combination
                    .iter()
                    .map(|x| Shown::new(field, x))
                    .collect();
                let combination = combination(&texts, &coefficients);
                if self.gram {
                    ErrorKind::SingularGram { combination }
                } else if singular.proved {
                    ErrorKind::SingularBasis { combination }
                } else {
                    ErrorKind::UndecidedBasis { combination }
                }
            }
            dense::Failure::ZeroWeight(index, zero) => {
                let node = self.nodes.get(index).map(ToString::to_string);
                let index = index + 1;
                match (zero, node) {
                    (algebra::Zero::Within(bits), _) => ErrorKind::UndecidedWeight { index, bits },
                    (_, node) => ErrorKind::ZeroWeight {
                        index,
                        node: node.unwrap_or_else(|| format!("c_{index}")),
                    },
                }
            }
        }
    }
}

/// A number in a message: exact, or its first digits.
struct Shown {
    text: String,
    rational: Option<BigRational>,
}

impl Shown {
    fn new<F: Field>(field: &F, x: &F::Element) -> Self {
        let number = field.number(x);
        let rational = match number.is_zero() {
            true => Some(BigRational::default()),
            false => number.short_rational(),
        };
        let digits = || format!("{}…", number.decimal(6));
        Shown {
            text: field.exact(x).unwrap_or_else(digits),
            rational,
        }
    }
}

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Coefficient for Shown {
    fn is_absent(&self) -> bool {
        self.rational.as_ref().is_some_and(Zero::is_zero)
    }

    fn rational(&self) -> Option<BigRational> {
        self.rational.clone()
    }
}
