//! Tests of the derivation.

use num_rational::BigRational;
use proptest::prelude::*;

use crate::algebra::NodeAlgebra;
use crate::arithmetic::matrix;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::ratio;
use crate::basis::Basis;
use crate::error::ErrorKind;
use crate::exact::Exact;
use crate::limits::Limits;
use crate::partitioned::Partitioned;
use crate::quadrature::{Nodes, QuadratureRule};
use crate::symbolic::Function;
use crate::tableau::{Tableau, derive, derive_from};

fn basis_of(polynomials: &[Polynomial]) -> Result<Basis, ErrorKind> {
    let functions = polynomials.iter().map(Function::polynomial);
    Basis::new(functions.collect::<Result<_, _>>()?)
}

/// Whether a basis of polynomials spans the constants, which consistency requires.
fn spans_constants(polynomials: &[Polynomial]) -> bool {
    basis_of(&[polynomials, &[Polynomial::one()]].concat()).is_err()
}

#[test]
fn derive_refuses_singular_definitions_at_the_place() {
    let cases = [
        (
            "polynomial(2)",
            "gauss(3)",
            "basis, column 1: 2 basis functions and 3 nodes",
        ),
        ("1", "0, 1", "basis, column 1: 1 basis function and 2 nodes"),
        // t(t − 1) vanishes at both nodes.
        (
            "1, t - t^2",
            "0, 1",
            "nodes, column 1: the matrix of the basis at the nodes is singular: -t^2 + t vanishes at every node",
        ),
        (
            "1, t^2 - t^4",
            "0, 1",
            "nodes, column 1: the matrix of the basis at the nodes is singular",
        ),
        (
            "polynomial(2)",
            "1/2, 1",
            "nodes, column 1: the weight b_2 at the node c_2 = 1 is zero",
        ),
    ];
    for (basis, nodes, message) in cases {
        let error = derive(basis, nodes).expect_err(message).to_string();
        assert!(error.starts_with(message), "{basis} at {nodes}: {error}");
    }
}

fn nodes_of(tableau: &Tableau) -> &Partitioned<NodeAlgebra> {
    match &*tableau.exact {
        Exact::Nodes(pair) => pair,
        _ => panic!("not in the node algebra"),
    }
}

proptest! {
    /// LZ's formulas evaluated directly at rational nodes, with a matrix inverse: another route.
    #[test]
    fn the_tableau_follows_the_formulas(
        nodes in prop::collection::btree_set(0i64..12, 1..5),
        coefficients in prop::collection::vec(-4i64..5, 20),
    ) {
        let size = nodes.len();
        let c: Vec<BigRational> = nodes.iter().map(|&n| ratio(n, 11)).collect();
        let functions: Vec<Polynomial> = coefficients.chunks(5).take(size).map(Polynomial::from_integers).collect();
        let Ok(basis) = basis_of(&functions) else { return Ok(()) };
        let text = c.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
        let rule = QuadratureRule::parse(&text, &Limits::default()).expect("nodes");
        let m: Vec<Vec<BigRational>> = functions.iter().map(|f| c.iter().map(|x| f.evaluate(x)).collect()).collect();
        match (derive_from(&basis, &rule), matrix::inverse(&m)) {
            (Err(ErrorKind::SingularBasis { .. }), inverse) => prop_assert!(inverse.is_err()),
            (result, Ok(inverse)) => {
                let integral = |k: usize, x: &BigRational| functions[k].antiderivative().evaluate(x);
                let b: Vec<BigRational> = (0..size)
                    .map(|j| (0..size).map(|k| &inverse[j][k] * integral(k, &ratio(1, 1))).sum())
                    .collect();
                let a: Vec<Vec<BigRational>> = c.iter().map(|x| (0..size)
                    .map(|j| (0..size).map(|k| integral(k, x) * &inverse[j][k]).sum()).collect()).collect();
                let zero = b.iter().position(|b| *b == ratio(0, 1));
                match result {
                    Err(ErrorKind::ZeroWeight { index, .. }) => prop_assert_eq!(Some(index - 1), zero),
                    Err(other) => prop_assert!(false, "{}", other),
                    Ok(tableau) => {
                        prop_assert_eq!(zero, None);
                        let pair = nodes_of(&tableau);
                        for i in 0..size {
                            prop_assert_eq!(pair.b.evaluate(&c[i]), b[i].clone());
                            for j in 0..size {
                                prop_assert_eq!(pair.a.row_at(&c[i]).evaluate(&c[j]), a[i][j].clone());
                                let tilde = (&b[i] * &b[j] - &b[j] * &a[j][i]) / &b[i];
                                prop_assert_eq!(pair.a_tilde.row_at(&c[i]).evaluate(&c[j]), tilde);
                            }
                        }
                        prop_assert!(tableau.properties().symplectic.holds);
                        if spans_constants(&functions) {
                            prop_assert_eq!(pair.c(), pair.algebra.variable());
                            prop_assert!(tableau.properties().consistent.holds);
                        }
                    }
                }
            }
            (result, Err(_)) => prop_assert!(false, "singular, but {:?}", result.map(|_| ())),
        }
    }

    #[test]
    fn the_tableau_depends_on_the_span_only(entries in prop::collection::vec(-3i64..4, 9), nodes in prop::sample::select(vec!["gauss(3)", "lobatto(3)", "0, 1/5, 1", "chebyshev(3)"])) {
        let rows: Vec<Vec<BigRational>> = entries.chunks(3).map(|r| r.iter().map(|&x| ratio(x, 1)).collect()).collect();
        prop_assume!(matrix::inverse(&rows).is_ok());
        let changed = basis_of(&entries.chunks(3).map(Polynomial::from_integers).collect::<Vec<_>>()).expect("independent");
        let rule = QuadratureRule::parse(nodes, &Limits::default()).expect("nodes");
        let (one, other) = (derive_from(&Basis::monomials(3), &rule).expect("derived"), derive_from(&changed, &rule).expect("derived"));
        prop_assert!(one.has_coefficients_of(&other));
    }
}

#[test]
fn polynomial_bases_give_the_weights_of_the_rule() {
    for nodes in ["gauss(4)", "radau-left(3)", "fejer(5)", "newton-cotes(4)"] {
        let rule = QuadratureRule::parse(nodes, &Limits::default()).expect("nodes");
        let tableau = derive_from(&Basis::monomials(rule.len()), &rule).expect("derived");
        assert_eq!(nodes_of(&tableau).b, *rule.weights());
        assert!(tableau.properties().consistent.holds);
    }
}

/// Numbers of one tier lie in the enclosures of the next.
fn agree(exact: &Tableau, enclosed: &Tableau) {
    let pairs = exact.numbers();
    for (x, y) in pairs.iter().zip(enclosed.numbers().iter()) {
        for bits in [200, 500] {
            let difference = x.enclose(bits).subtract(&y.enclose(bits));
            assert!(difference.contains(&ratio(0, 1)));
            // A few units of the last place, times the coefficients of the polynomial that is evaluated at a node:
            // at most 1/c⁴ for the nodes and functions here, that is 5⁴ < 2¹⁰.
            assert!(difference.width_bits() < 18 - i64::from(bits));
        }
    }
}

/// The same construction in each tier that can hold it, strongest first.
fn in_all_tiers(basis: &str, nodes: &str) -> Vec<Tableau> {
    use super::dense::{Samples, collocation};
    use crate::algebra::{Constants, Reals};

    let limits = Limits::default();
    let derived = derive(basis, nodes).expect("derived");
    let functions = Basis::parse(basis, &limits).and_then(|b| Ok(b.functions()?));
    let constants = Nodes::parse("nodes", nodes, &limits).and_then(|n| Ok(n.constants()?));
    let samples =
        Samples::new(&functions.expect("functions"), &constants.expect("nodes")).expect("small");
    let definition = derived.provenance().definition.clone();
    let mut all = vec![derived];
    if let Some(field) = Constants::containing(samples.constants()) {
        let samples = samples.in_field(&field).expect("in the field");
        let pair = collocation(field, &samples).unwrap_or_else(|_| panic!("derived before"));
        all.push(Tableau::read(definition.clone(), Exact::Field(pair).into()));
    }
    let samples = samples.in_field(&Reals).expect("reals");
    let pair = collocation(Reals, &samples).unwrap_or_else(|_| panic!("derived before"));
    all.push(Tableau::read(definition, Exact::Reals(pair).into()));
    all
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn tiers_agree_where_they_overlap(
        functions in prop::sample::subsequence(
            vec!["t^2 - 1/3", "cos(pi*t)", "sin(pi*t/2)", "t*sin(pi*t)", "t^3", "cos(2*pi*t/3 + pi/7)"], 1..3),
        more in prop::sample::subsequence(vec!["t", "exp(t)", "t*exp(-t)", "cosh(t/2)", "cos(t)", "sin(t + 1)"], 0..2),
        nodes in prop::sample::subsequence(vec!["0", "1/5", "1/3", "1/2", "sqrt(2)/2", "3/4", "cos(pi/9)", "1"], 4),
    ) {
        let basis = [vec!["1"], functions, more].concat();
        let nodes = nodes[..basis.len().min(4)].join(", ");
        prop_assume!(basis.len() <= 4);
        let basis = basis.join(", ");
        prop_assume!(derive(&basis, &nodes).is_ok());
        let all = in_all_tiers(&basis, &nodes);
        for pair in all.windows(2) {
            agree(&pair[0], &pair[1]);
        }
    }
}

#[test]
fn tiers_agree_on_the_classical_rules() {
    for (basis, nodes) in [
        ("polynomial(2)", "gauss(2)"),
        ("polynomial(3)", "lobatto(3)"),
        ("polynomial(4)", "gauss(4)"),
        ("legendre(3)", "chebyshev(3)"),
    ] {
        let all = in_all_tiers(basis, nodes);
        assert_eq!(all.len(), 3, "{basis} at {nodes}");
        for pair in all.windows(2) {
            agree(&pair[0], &pair[1]);
        }
    }
    // A wrong digit is detected.
    let wrong = derive("polynomial(2)", "1/5, 4/5").expect("derived");
    let right = derive("polynomial(2)", "gauss(2)").expect("derived");
    let difference = wrong.numbers().a[0][0]
        .enclose(200)
        .subtract(&right.numbers().a[0][0].enclose(200));
    assert!(!difference.contains(&ratio(0, 1)));
}
