//! The coefficients as lists of rational numbers.

use std::collections::{BTreeMap, BTreeSet};

use super::levels;
use super::solution::{self, Solution};
use symplectic_compiler::Tableau;
use symplectic_compiler::algebra::field::{FieldElement, Transcendental};
use symplectic_compiler::algebra::{Constants, Dense, Field, NodeAlgebra, Real, Reals, Tensor};
use symplectic_compiler::certify::{Certificate, Claim};
use symplectic_compiler::inside::Affine;
use symplectic_compiler::inside::Exact;
use symplectic_compiler::inside::Fact;
use symplectic_compiler::inside::{LowerTriangular, Partitioned};
use symplectic_exact::interval::Interval;
use symplectic_exact::polynomial::Polynomial;
use symplectic_exact::rounding::Decimal;

use Fact::{List, Literal, Table, Text};

/// The significant digits that separate a root from the others, and the solution of order conditions from all nearby ones.
pub(super) const DIGITS: usize = 40;

/// The coefficients of a method.
pub(super) struct Numbers {
    /// The basis of the coordinates in the lists below.
    pub kind: Fact,
    /// The form of the matrices, if the weights determine them.
    pub lower_triangular: Option<LowerTriangular>,
    pub b: Fact,
    pub b_tilde: Fact,
    /// The weights of gradient kicks.
    pub gradient: Option<Fact>,
    pub matrices: Option<(Fact, Fact)>,
}

impl Numbers {
    /// The coefficients; `None` if there is no exact form.
    pub fn of(tableau: &Tableau) -> Option<Self> {
        match tableau.exact() {
            Exact::Nodes(pair) => Some(Numbers::of_nodes(pair)),
            Exact::Field(pair) => Some(Numbers::of_field(pair)),
            Exact::Reals(pair) => {
                Numbers::of_solution(pair).or_else(|| Numbers::of_levels(tableau, pair))
            }
        }
    }

    /// Functions of the nodes: polynomials.
    fn of_nodes(pair: &Partitioned<NodeAlgebra>) -> Self {
        let matrix = |tensor: &Tensor| List(tensor.columns().iter().map(coefficients).collect());
        Numbers {
            kind: Table(vec![
                ("kind", text("nodes")),
                ("polynomial", coefficients(pair.algebra.modulus())),
            ]),
            lower_triangular: None,
            b: coefficients(&pair.b),
            b_tilde: coefficients(&pair.b_tilde),
            gradient: None,
            matrices: Some((matrix(&pair.a), matrix(&pair.a_tilde))),
        }
    }

    /// Elements of `Q(θ)`: polynomials in `θ`. Those of `Q(θ)(X)` are pairs of lists with such a polynomial for each power of `X`.
    fn of_field(pair: &Partitioned<Dense<Constants>>) -> Self {
        let constants = pair.algebra.field();
        let field = constants.field();
        let number_field = field.algebraic();
        let root = field.from_algebraic(&Polynomial::variable());
        let mut kind = vec![
            ("polynomial", coefficients(number_field.modulus())),
            ("root", text(constants.number(&root).decimal(DIGITS))),
        ];
        let variable = field.generator().map(|x: Transcendental| x.power(1));
        let list = |list: &[Polynomial]| List(list.iter().map(coefficients).collect());
        let element = |x: &FieldElement| match &variable {
            Some(_) => List(vec![list(x.numerator()), list(x.denominator())]),
            None => coefficients(&x.as_algebraic().unwrap_or_else(Polynomial::zero)),
        };
        let name = if variable.is_some() {
            "functions"
        } else {
            "field"
        };
        kind.insert(0, ("kind", text(name)));
        kind.extend(variable.as_ref().map(|x| ("variable", text(x))));
        let vector = |list: &Vec<FieldElement>| List(list.iter().map(element).collect());
        let matrix = |rows: &Vec<Vec<FieldElement>>| List(rows.iter().map(vector).collect());
        let lower_triangular = pair.lower_triangular();
        Numbers {
            kind: Table(kind),
            lower_triangular,
            b: vector(&pair.b),
            b_tilde: vector(&pair.b_tilde),
            gradient: pair.gradient.as_ref().map(vector),
            matrices: match lower_triangular {
                Some(_) => None,
                None => Some((matrix(&pair.a), matrix(&pair.a_tilde))),
            },
        }
    }

    /// A composition of compositions: its levels give the weights.
    fn of_levels(tableau: &Tableau, pair: &Partitioned<Dense<Reals>>) -> Option<Self> {
        if pair.gradient.is_some() {
            return None;
        }
        Some(Numbers {
            kind: levels::of(&tableau.provenance().definition)?,
            lower_triangular: Some(pair.lower_triangular()?),
            b: List(Vec::new()),
            b_tilde: List(Vec::new()),
            gradient: None,
            matrices: None,
        })
    }

    /// The solution of order conditions: affine functions of its irrational coordinates.
    fn of_solution(pair: &Partitioned<Dense<Reals>>) -> Option<Self> {
        let mut certificate: Option<Certificate> = None;
        let mut affine = |list: &[Real]| -> Option<Vec<Affine>> {
            list.iter().map(|x| x.affine(&mut certificate)).collect()
        };
        let (b, b_tilde) = (affine(&pair.b)?, affine(&pair.b_tilde)?);
        let gradient = match &pair.gradient {
            Some(gradient) => Some(affine(gradient)?),
            None => None,
        };
        let certificate = certificate?;
        let solved = certificate.solved()?;
        let all = b
            .iter()
            .chain(&b_tilde)
            .chain(gradient.iter().flatten())
            .chain(solved.weights.iter().flatten())
            .chain(solved.processor.iter().flat_map(|x| &x.weights));
        let unknowns: BTreeSet<usize> = all.flat_map(|x| x.factors.keys().copied()).collect();
        let list = |list: &[Affine]| List(list.iter().map(|x| coordinates(x, &unknowns)).collect());
        let lower_triangular = pair.lower_triangular()?;
        let enclosed = certificate.enclosed_unknowns(solution::BITS);
        let with_index = |index: &usize| Some((*index, enclosed.get(*index)?.clone()));
        let processor = solved.processor.as_ref();
        let proof = Solution {
            claim: &solved.claim,
            lower_triangular,
            b: &b,
            b_tilde: &b_tilde,
            gradient: gradient.as_deref(),
            weights: solved.weights.as_deref(),
            processed: processor.map(|x| (&x.system, &x.arguments[..])),
            unknowns: unknowns.iter().filter_map(with_index).collect(),
        };
        let (class, orders) = claim(&solved.claim);
        let orders = orders.iter().map(|order| Literal(order.to_string()));
        let mut kind = vec![
            ("kind", text("solution")),
            ("class", text(class)),
            ("orders", List(orders.collect())),
            ("unknowns", decimals(&proof.unknowns)?),
        ];
        kind.extend(proof.proof()?);
        kind.extend(solved.weights.as_deref().map(|x| ("weights", list(x))));
        kind.extend(processor.map(|x| {
            let weights = ("weights", list(&x.weights));
            let both_ways = Literal(x.back_and_forth.to_string());
            (
                "processor",
                Table(vec![weights, ("back_and_forth", both_ways)]),
            )
        }));
        Some(Numbers {
            kind: Table(kind),
            lower_triangular: Some(lower_triangular),
            b: list(&b),
            b_tilde: list(&b_tilde),
            gradient: gradient.as_deref().map(list),
            matrices: None,
        })
    }
}

pub(super) fn text(value: impl ToString) -> Fact {
    Text(value.to_string())
}

/// The coefficients of `1, x, x², …`.
pub(super) fn coefficients(polynomial: &Polynomial) -> Fact {
    List(polynomial.coefficients().iter().map(text).collect())
}

/// The class of the order conditions, and their orders.
fn claim(claim: &Claim) -> (&'static str, Vec<usize>) {
    match claim {
        Claim::Separable(order) => ("separable", vec![*order]),
        Claim::Nystrom(order) => ("nystrom", vec![*order]),
        Claim::SymmetricBase(order) => ("composition", vec![*order]),
        Claim::Perturbed(orders) => ("perturbed", orders.clone()),
    }
}

/// The constant and the factors of the unknowns.
fn coordinates(x: &Affine, unknowns: &BTreeSet<usize>) -> Fact {
    let factor = |index| x.factors.get(index).cloned().unwrap_or_default();
    let factors = unknowns.iter().map(factor);
    let all = std::iter::once(x.constant.clone()).chain(factors);
    List(all.map(text).collect())
}

/// The unknowns, correctly rounded.
fn decimals(unknowns: &BTreeMap<usize, Interval>) -> Option<Fact> {
    let rounded = |x: &Interval| {
        let [low, high] = [x.low(), x.high()].map(|end| Decimal::round(&end, DIGITS));
        (low == high).then(|| text(low))
    };
    let list: Option<Vec<Fact>> = unknowns.values().map(rounded).collect();
    Some(List(list?))
}
