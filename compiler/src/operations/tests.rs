//! Laws of the operations.

use num_rational::BigRational;
use proptest::prelude::*;

use super::*;
use crate::algebra::{Constants, Field};
use crate::arithmetic::polynomial::Polynomial;
use crate::evidence::Evidence;
use crate::export::toml;
use crate::expression::{Input, parse_list};
use crate::order::OrderOptions;
use crate::{Basis, Definition, Limits, QuadratureRule, Tier, check};

fn constant(text: &str) -> Constant {
    let input = Input { name: "test", text };
    parse_list(input)
        .and_then(|list| list[0].constant(input))
        .expect(text)
}

fn define(text: &str) -> Tableau {
    Definition::parse(text)
        .and_then(|definition| definition.derive(&Limits::default()))
        .expect(text)
}

const VERLET: &str = "basis: polynomial(2), nodes: lobatto(2)";

/// The composition of a method with itself, with these fractions of the step.
fn powers(method: &Tableau, fractions: &[&str]) -> Tableau {
    let fractions: Vec<Constant> = fractions.iter().map(|text| constant(text)).collect();
    let steps: Vec<_> = fractions
        .iter()
        .map(|fraction| (fraction, method))
        .collect();
    Tableau::concatenate(&steps).expect("a composition")
}

/// Whether all coefficients are equal when stage `i` of one is stage `order(i)` of the other: exactly where they
/// have exact forms, and to 60 digits otherwise.
fn equal(one: &Tableau, other: &Tableau, order: impl Fn(usize) -> usize) -> bool {
    let texts = |tableau: &Tableau| {
        let decimals = tableau.numbers();
        let decimals = decimals.map(|number| number.decimal(60).to_string());
        tableau.exact_forms().zip(decimals)
    };
    type Texts = (Option<String>, String);
    let agree = |(exact, decimal): &Texts, (other, digits): &Texts| match (exact, other) {
        (Some(exact), Some(other)) => exact == other || equal_constants(exact, other),
        _ => decimal == digits,
    };
    let (one, other) = (texts(one), texts(other));
    let stages = one.b.len();
    stages == other.b.len()
        && (0..stages).all(|i| {
            let k = order(i);
            agree(&one.b[i], &other.b[k])
                && agree(&one.b_tilde[i], &other.b_tilde[k])
                && (0..stages).all(|j| {
                    let l = order(j);
                    agree(&one.a[i][j], &other.a[k][l])
                        && agree(&one.a_tilde[i][j], &other.a_tilde[k][l])
                })
        })
}

/// Whether two exact forms, which may be written in different fields, have the same value.
fn equal_constants(one: &str, other: &str) -> bool {
    let (one, other) = (constant(one), constant(other));
    let field = Constants::containing([&one, &other]).expect("a constant field");
    field.constant(&one) == field.constant(&other)
}

fn same(one: &Tableau, other: &Tableau) -> bool {
    equal(one, other, |i| i)
}

/// Methods of all tiers, symplectic or not, symmetric or not.
const METHODS: [&str; 9] = [
    "basis: 1, nodes: 0",
    VERLET,
    "basis: polynomial(2), nodes: radau-right(2)",
    "basis: polynomial(2), nodes: gauss(2), exchange: true",
    "basis: polynomial(2), nodes: [0, 1/3], adjoint: true",
    "a: [[0, 0], [1, 0]], b: [1/2, 1/2]",
    "a: [[0, 0], [2/3, 0]], b: [1/4, 3/4], a_tilde: [[1/3, 0], [1/3, 2/3]], b_tilde: [1/3, 2/3]",
    "basis: [1, exp(-t)], nodes: [1/3, 1]",
    "basis: [1, exp(t*pi)], nodes: [0, 1]",
];

fn methods() -> impl Strategy<Value = Tableau> {
    let random = prop::collection::vec((-6i64..7, 1i64..5), 12).prop_map(|entries| {
        let q = |k: usize| BigRational::new(entries[k].0.into(), entries[k].1.into()).to_string();
        let row = |k: usize| format!("[{}, {}]", q(k), q(k + 1));
        let matrix = |k: usize| format!("[{}, {}]", row(k), row(k + 2));
        define(&format!(
            "a: {}, b: {}, a_tilde: {}, b_tilde: {}",
            matrix(0),
            row(4),
            matrix(6),
            row(10)
        ))
    });
    prop_oneof![
        prop::sample::select(METHODS.to_vec()).prop_map(define),
        random
    ]
}

fn fractions() -> impl Strategy<Value = Constant> {
    let texts = ["1/2", "-1", "2/3", "1/(2 - cbrt(2))", "sqrt(3)", "0"];
    prop::sample::select(texts.to_vec()).prop_map(constant)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn the_adjoint_of_the_adjoint_is_the_method(method in methods()) {
        prop_assert_eq!(method.adjoint().adjoint(), method);
    }

    #[test]
    fn the_adjoint_of_a_composition_is_that_of_the_adjoints(first in methods(), second in methods()) {
        let adjoint = first.compose(&second).expect("composed").adjoint();
        let adjoints = second.adjoint().compose(&first.adjoint()).expect("composed");
        let (s, t) = (first.stages(), second.stages());
        prop_assert!(equal(&adjoint, &adjoints, |i| (i + t) % (s + t)));
        // The stages of `second` are not those of `first`.
        prop_assert!(same(&first, &second) || !same(&adjoint, &adjoints));
    }

    #[test]
    fn scaling_is_an_action_that_composition_respects(
        method in methods(), next in methods(), x in fractions(), y in fractions(),
    ) {
        prop_assert!(method.scale(&Constant::one()).expect("scaled").has_coefficients_of(&method));
        let twice = method.scale(&x).and_then(|scaled| scaled.scale(&y)).expect("scaled");
        let product = x.multiply(&y).expect("small");
        prop_assert!(same(&twice, &method.scale(&product).expect("scaled")));
        let composed = method.compose(&next).and_then(|composed| composed.scale(&x)).expect("composed");
        let parts = Tableau::concatenate(&[(&x, &method), (&x, &next)]).expect("composed");
        prop_assert!(same(&composed, &parts));
        // (Φ_γ)* = (Φ*)_γ
        let adjoint = method.scale(&x).expect("scaled").adjoint();
        prop_assert!(same(&adjoint, &method.adjoint().scale(&x).expect("scaled")));
    }

    #[test]
    #[ignore = "thorough"]
    fn composition_is_associative(first in methods(), second in methods(), third in methods()) {
        let left = first.compose(&second).and_then(|composed| composed.compose(&third)).expect("composed");
        let right = second.compose(&third).and_then(|composed| first.compose(&composed)).expect("composed");
        let one = Constant::one();
        let flat = Tableau::concatenate(&[(&one, &first), (&one, &second), (&one, &third)]).expect("composed");
        prop_assert!(same(&left, &right) && same(&left, &flat));
    }

    #[test]
    #[ignore = "thorough"]
    fn a_method_and_its_adjoint_are_symmetric(method in methods()) {
        let half = constant("1/2");
        let adjoint = method.adjoint();
        let known = method.properties();
        for steps in [[(&half, &method), (&half, &adjoint)], [(&half, &adjoint), (&half, &method)]] {
            let composed = Tableau::concatenate(&steps).expect("composed");
            let properties = composed.properties();
            prop_assert!(properties.symmetric.holds, "{}", properties.symmetric);
            prop_assert_eq!(properties.symplectic.holds, known.symplectic.holds);
            prop_assert_eq!(properties.consistent.holds, known.consistent.holds);
        }
        // Two steps of a method are symmetric iff it is.
        prop_assert_eq!(powers(&method, &["1/2", "1/2"]).properties().symmetric.holds, known.symmetric.holds);
    }

    #[test]
    #[ignore = "thorough"]
    fn definitions_derive_the_results_again(
        method in methods(), next in methods(), x in fractions(), y in fractions(), exchange in any::<bool>(),
    ) {
        let inner = Tableau::concatenate(&[(&x, &method), (&y, &next)]).expect("composed");
        let outer = inner.adjoint().compose(&next.scale(&y).expect("scaled")).expect("composed");
        for tableau in [method.adjoint(), inner.adjoint(), outer.adjoint(), inner, outer] {
            let mut text = tableau.provenance().definition.to_string();
            let derived = define(&text);
            prop_assert_eq!(&derived, &tableau);
            prop_assert!(same(&derived, &tableau));
            if exchange && !text.contains("exchange") {
                // The adjoint and the exchange can be taken in any order.
                text.push_str(", exchange: true");
                let exchanged = define(&text);
                prop_assert_eq!(exchanged.adjoint().adjoint(), exchanged.clone());
                prop_assert_eq!(exchanged.exact_forms().a, tableau.exact_forms().a_tilde);
            }
        }
    }
}

#[test]
fn definitions_of_a_composition_and_its_adjoint_derive_them_again() {
    let (third, rest) = (constant("1/3"), constant("2/3"));
    let exchanged = define(METHODS[3]);
    let composition = Tableau::concatenate(&[(&third, &define(VERLET)), (&rest, &exchanged)]);
    let composition = composition.expect("composed");
    for tableau in [composition.adjoint(), composition] {
        let derived = define(&tableau.provenance().definition.to_string());
        assert_eq!(derived, tableau);
        assert!(same(&derived, &tableau));
        let written = toml::write(&tableau, 20);
        assert_eq!(check("t.toml", &written, &Limits::default()), Ok(tableau));
    }
}

/// The adjoint of a method from a file has the text of the file, whatever has been asked of the method before.
#[test]
fn the_adjoint_of_a_method_from_a_file_does_not_depend_on_what_was_read_before() {
    let written = toml::write(&define(VERLET), 20);
    let written = written.replace("\"polynomial(2)\"", "\"polynomial( 2 )\"");
    let read = toml::read("t.toml", &written, &Limits::default()).expect("a file");
    assert!(read.provenance().definition.to_string().contains("( 2 )"));
    let before = read.adjoint();
    read.scale(&constant("1/2")).expect("scaled");
    assert_eq!(read.adjoint(), before);
    assert_eq!(read.adjoint().adjoint(), read);
}

/// Two rules with one name: their methods are two methods.
#[test]
fn methods_with_equal_definitions_and_other_coefficients_are_two_parts() {
    let method = |roots: [i64; 3]| {
        let nodes = Polynomial::from_integers(&roots);
        let rule = QuadratureRule::with_nodes("mine".to_owned(), &nodes).expect("nodes");
        crate::derive_from(&Basis::monomials(2), &rule).expect("derived")
    };
    // t² − t + 3/16 = 0 and t² − t + 2/9 = 0.
    let (one, other) = (method([3, -16, 16]), method([2, -9, 9]));
    assert!(!one.has_coefficients_of(&other));
    let half = constant("1/2");
    for (next, count) in [(&other, 2), (&one, 1)] {
        let both = Tableau::concatenate(&[(&half, &one), (&half, next)]).expect("composed");
        assert_eq!(both.parts().expect("parts").methods.len(), count);
    }
}

#[test]
fn other_coefficients_have_proofs_of_their_own() {
    let heun = define(METHODS[5]);
    assert!(!heun.properties().symplectic.holds);
    let gauss = define("basis: polynomial(2), nodes: gauss(2)");
    let changed = heun.with_exact(gauss.exact().clone());
    assert!(changed.properties().symplectic.holds);
}

#[test]
#[ignore = "thorough"]
fn files_of_results_are_checked_in_every_tier() {
    let third = constant("1/3");
    for (text, tier) in [
        (VERLET, Tier::ConstantField),
        ("basis: polynomial(2), nodes: gauss(2)", Tier::ConstantField),
        (
            "basis: [1, cos(pi*t), sin(pi*t)], nodes: [0, 1/2, 1]",
            Tier::ConstantField,
        ),
        ("basis: [1, cos(t)], nodes: gauss(2)", Tier::Enclosure),
        ("basis: polynomial(5), nodes: fejer(5)", Tier::ConstantField),
        // Fields that hold all of these nodes are too large.
        ("basis: polynomial(8), nodes: gauss(8)", Tier::Enclosure),
    ] {
        let method = define(text);
        let composed = Tableau::concatenate(&[(&third, &method), (&third, &method.adjoint())]);
        let composed = composed.expect("composed").named("composed");
        assert_eq!(composed.tier(), tier, "{text}");
        for tableau in [composed.adjoint(), composed] {
            let written = toml::write(&tableau, 20);
            let checked = check("t.toml", &written, &Limits::default());
            assert_eq!(checked.as_ref(), Ok(&tableau), "{written}");
            let read = toml::read("t.toml", &written, &Limits::default());
            assert_eq!(read, Ok(tableau.clone()));
            let json = crate::export::json::write(&tableau, 20);
            assert_eq!(check("t.json", &json, &Limits::default()), Ok(tableau));
        }
        // A rational multiple stays in the algebra that holds the method.
        let scaled = method.scale(&third).expect("scaled");
        assert_eq!(scaled.tier(), method.tier());
        let written = toml::write(&scaled, 20);
        assert_eq!(check("t.toml", &written, &Limits::default()), Ok(scaled));
    }
}

#[test]
fn compositions_have_the_blocks_of_their_methods() {
    let method = define(METHODS[6]);
    let forms = powers(&method, &["1/2", "3"]).exact_forms();
    let texts = |list: &[Option<String>]| list.iter().flatten().cloned().collect::<Vec<_>>();
    assert_eq!(texts(&forms.b), ["1/8", "3/8", "3/4", "9/4"]);
    assert_eq!(texts(&forms.b_tilde), ["1/6", "1/3", "1", "2"]);
    assert_eq!(texts(&forms.a[1]), ["1/3", "0", "0", "0"]);
    assert_eq!(texts(&forms.a[3]), ["1/8", "3/8", "2", "0"]);
    assert_eq!(texts(&forms.a_tilde[1]), ["1/6", "1/3", "0", "0"]);
    assert_eq!(texts(&forms.a_tilde[2]), ["1/6", "1/3", "1", "0"]);
}

/// The steps of symplectic Euler and its adjoint of half the size are Störmer–Verlet (GNI I.1.4).
#[test]
fn known_methods_are_compositions() {
    let (euler, half) = (define("basis: 1, nodes: 0"), constant("1/2"));
    let verlet = Tableau::concatenate(&[(&half, &euler), (&half, &euler.adjoint())]);
    assert!(same(&verlet.expect("composed"), &define(VERLET)));
    // Half a step of implicit Euler after one of explicit Euler is the trapezoidal rule.
    let [explicit, implicit] = ["a: [[0]], b: [1]", "a: [[1]], b: [1]"].map(define);
    let trapezoidal = Tableau::concatenate(&[(&half, &explicit), (&half, &implicit)]);
    let given = define("a: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2]");
    assert!(same(&trapezoidal.expect("composed"), &given));
    assert!(same(&explicit.adjoint(), &implicit));
}

const JUMP: [&str; 3] = [
    "1/(2 - cbrt(2))",
    "-cbrt(2)/(2 - cbrt(2))",
    "1/(2 - cbrt(2))",
];

#[test]
fn the_triple_jump_has_order_four() {
    let jump = powers(&define(VERLET), &JUMP);
    assert_eq!(jump.tier(), Tier::ConstantField);
    let properties = jump.properties();
    for (name, holds) in [
        ("symplectic", true),
        ("symmetric", true),
        ("explicit", true),
        ("positive_weights", false),
    ] {
        assert_eq!(properties.get(name).map(|p| p.holds), Some(holds), "{name}");
    }
    assert_eq!(properties.symmetric.evidence, Evidence::Proved);
    // The six stages are those of a splitting with four positions and three momenta.
    assert_eq!(
        properties.explicit.witness.as_deref(),
        Some("Q1, P1 = P2, Q2 = Q3, P3 = P4, Q4 = Q5, P5 = P6, Q6")
    );
    let order = jump.order(&OrderOptions::default());
    for class in [order.general, order.separable, order.nystrom] {
        assert_eq!((class.order, class.evidence), (4, Evidence::Proved));
        assert_eq!(class.refuted_by.expect("refuted").tree.order(), 5);
    }
    // A wrong sign in the middle, and a fraction that is nearly right.
    let wrong = powers(
        &define(VERLET),
        &[JUMP[0], "cbrt(2)/(2 - cbrt(2))", JUMP[0]],
    );
    assert_eq!(wrong.order(&OrderOptions::default()).separable.order, 0);
    let near = [
        "1.3512071919596578",
        "-1.7024143839193156",
        "1.3512071919596578",
    ];
    let near = powers(&define(VERLET), &near).order(&OrderOptions::default());
    assert_eq!((near.general.order, near.nystrom.order), (2, 2));
}

/// Orders of compositions that are known (GNI II.4): Suzuki's five jumps, and methods of odd order with
/// their adjoints.
#[test]
fn orders_of_compositions_are_known() {
    let (half, options) = (constant("1/2"), OrderOptions::default());
    let outer = "1/(4 - cbrt(4))";
    let suzuki = powers(
        &define(VERLET),
        &[outer, outer, "-cbrt(4)/(4 - cbrt(4))", outer, outer],
    );
    assert_eq!(suzuki.order(&options).general.order, 4);
    for (text, order, symmetric) in [
        ("basis: 1, nodes: 0", 1, 2),
        ("basis: polynomial(2), nodes: radau-left(2)", 3, 4),
        (
            "a: [[0, 0, 0], [1/2, 0, 0], [-1, 2, 0]], b: [1/6, 2/3, 1/6]",
            3,
            4,
        ),
    ] {
        let method = define(text);
        assert_eq!(method.order(&options).general.order, order);
        let steps = [(&half, &method), (&half, &method.adjoint())];
        let composed = Tableau::concatenate(&steps).expect("composed");
        assert_eq!(composed.order(&options).general.order, symmetric, "{text}");
        // Two steps of the same method have its order, and so has the adjoint.
        assert_eq!(
            powers(&method, &["1/3", "2/3"])
                .order(&options)
                .general
                .order,
            order
        );
        assert_eq!(method.adjoint().order(&options).general.order, order);
    }
}

#[test]
fn concatenate_refuses_empty_and_too_deep_compositions() {
    let refused =
        |methods: &[(&Constant, &Tableau)]| Tableau::concatenate(methods).expect_err("refused");
    assert!(matches!(refused(&[]), ErrorKind::Definition { .. }));
    let mut deep = define("basis: 1, nodes: 0");
    let error = loop {
        match deep.scale(&Constant::one()) {
            Ok(next) => deep = next,
            Err(kind) => break kind,
        }
    };
    assert!(matches!(error, ErrorKind::ExpressionSize { .. }));
    // What is not refused is read again.
    define(&deep.provenance().definition.to_string());
}

#[test]
fn errors_are_at_their_places_in_compositions() {
    let at = |text: &str, part: &str| {
        let definition = Definition::new([(crate::Key::Compose, text)]);
        let errors = definition
            .derive_or_all_errors(&Limits::default())
            .expect_err(text);
        let place = errors[0].place.as_ref().expect("a place");
        assert_eq!(
            (place.input.as_str(), place.text.as_str()),
            ("compose", text)
        );
        assert_eq!(&text[place.span.clone()], part, "{}", errors[0]);
        errors[0].kind.to_string()
    };
    at("[[1/2, basis: polynomial(2), nodes: lobato(2)]]", "lobato");
    at("[1/2, basis: 1, nodes: 0], [ 1/0, basis: 1, nodes: 1]", "0");
    at("[[1, compose: [[1, basis: 1, nodes: 2]]]]", "2");
    at(
        "[[1, compose: [[1, basis: 1, node: 2]]]]",
        " node: 2".trim(),
    );
    at("[[1, basis: 1]]", "[1, basis: 1]");
    at("[[1, basis: 1, nodes: 0, adjoint: yes]]", "yes");
    at(
        "[[1, basis: polynomial(2), nodes: 0]]",
        "[[1, basis: polynomial(2), nodes: 0]]",
    );
    at("[1, 2]", "2");
    at(" [] ", "");
    at("[]]", "]");
    at("[[1, basis: 1, nodes: 0], 3]", "3");
    let many = format!(
        "[{}]",
        "[1, basis: polynomial(8), nodes: gauss(8)], ".repeat(5)
    );
    assert!(at(&many, &many).starts_with("40 stages exceed"));
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(at(&deep, &deep).contains("depth"));
    let other = Definition::parse("compose: [[1, basis: 1, nodes: 0]], basis: 1").expect("parts");
    let error = other.derive(&Limits::default()).expect_err("two methods");
    assert!(error.to_string().contains("leave out `basis`"));
}
