//! Splittings and compositions: what is written, what is derived of it, and what is refused.

mod printed;

use printed::PRINTED;
use symplectic_compiler::order::{HamiltonianClass, OrderOptions};
use symplectic_compiler::schedule::Evaluations;
use symplectic_compiler::symbolic::Constant;
use symplectic_compiler::{Definition, Evidence, Limits, Tableau, Tier, catalogue, require};

fn define(text: &str) -> Tableau {
    Definition::parse(text)
        .and_then(|definition| definition.derive(&Limits::default()))
        .expect(text)
}

fn message(text: &str) -> String {
    let refused = Definition::parse(text).and_then(|text| text.derive(&Limits::default()));
    refused.expect_err(text).to_string()
}

fn known(name: &str) -> Tableau {
    catalogue::find(name).expect(name).derive().expect(name)
}

/// The weights, which are the kicks and the drifts, as decimals.
fn decimals(tableau: &Tableau, digits: usize) -> [Vec<String>; 2] {
    let numbers = tableau.numbers();
    [numbers.b_tilde, numbers.b].map(|weights| {
        let decimal = |number: &symplectic_compiler::algebra::Number<'_>| number.decimal(digits);
        weights
            .iter()
            .map(|number| decimal(number).to_string())
            .collect()
    })
}

#[test]
fn closed_forms_have_the_printed_digits_and_the_orders_that_were_found() {
    for method in PRINTED {
        let tableau = known(method.name);
        let mut kick = method.kick.to_vec();
        if kick[0] == "0.0" {
            // Printed with a kick of 0 to start with; drifts come first here.
            kick.rotate_left(1);
        }
        let printed = [&kick[..], method.drift];
        for (weights, printed) in decimals(&tableau, 40).iter().zip(printed) {
            assert_eq!(weights.len(), printed.len(), "{}", method.name);
            for (weight, printed) in weights.iter().zip(printed) {
                // 19 places and more are printed.
                let difference = exact(weight) - exact(printed);
                let bound = exact("1e-19");
                assert!(
                    -&bound < difference && difference < bound,
                    "{}: {weight}, printed {printed}",
                    method.name
                );
            }
        }
        let orders = tableau.orders();
        assert_eq!(orders.separable.order, method.order, "{}", method.name);
        assert!(
            orders.separable.refuted_by.is_some() && orders.separable.evidence == Evidence::Proved
        );
        assert_eq!(
            tableau.evaluations().map(|found| found.forces),
            Some(method.forces),
            "{}",
            method.name
        );
        assert!(
            tableau.separable_properties().symplectic.holds,
            "{}",
            method.name
        );
    }
}

/// A printed number, exactly.
fn exact(text: &str) -> num_rational::BigRational {
    let input = symplectic_compiler::expression::Input {
        name: "printed",
        text,
    };
    let list = symplectic_compiler::expression::parse_list(input).expect(text);
    list[0].rational(input).expect(text)
}

/// Order 4 and more needs every digit: a kick moved by 10⁻¹⁸ and the last one back make order 1.
#[test]
fn a_moved_kick_is_refuted() {
    let ruth = "kick: [7/24, 3/4, -1/24], drift: [2/3, -2/3, 1]";
    let moved = "kick: [7/24 + 1e-18, 3/4 - 1e-18, -1/24], drift: [2/3, -2/3, 1]";
    let order = |text: &str| define(text).orders().separable.order;
    assert_eq!((order(ruth), order(moved)), (3, 1));
    let forest = "kick: [1/(4 - 2*cbrt(2)), (1 - cbrt(2))/(4 - 2*cbrt(2))], drift: [1/(2 - cbrt(2)), -cbrt(2)/(2 - cbrt(2))], symmetric: true";
    let moved = forest.replacen(
        "drift: [1/(2 - cbrt(2)), -",
        "drift: [1/(2 - cbrt(2)) + 1e-18, -2e-18 - ",
        1,
    );
    assert_eq!((order(forest), order(&moved)), (4, 2));
    // Twins: drifts and kicks exchanged have the order again, those of a half step more have none.
    assert_eq!(order(&format!("{ruth}, exchange: true")), 3);
    assert_eq!(order(&format!("{ruth}, first: drift")), 1);
    assert_eq!(order(&format!("{ruth}, adjoint: true")), 3);
}

#[test]
fn the_convention_is_that_of_the_papers() {
    let forms = define("kick: [1/4, 3/4], drift: [2/3, 1/3]").exact_forms();
    let rows = |rows: Vec<Vec<Option<String>>>| {
        let row =
            |row: Vec<Option<String>>| row.into_iter().flatten().collect::<Vec<_>>().join(" ");
        rows.into_iter().map(row).collect::<Vec<_>>()
    };
    assert_eq!(rows(forms.a), ["0 0", "2/3 0"]);
    assert_eq!(rows(forms.a_tilde), ["1/4 0", "1/4 3/4"]);
    assert_eq!(rows(vec![forms.b, forms.b_tilde]), ["2/3 1/3", "1/4 3/4"]);
    let forms = define("kick: [1/4, 3/4], drift: [2/3, 1/3], first: drift").exact_forms();
    assert_eq!(rows(forms.a), ["2/3 0", "2/3 1/3"]);
    assert_eq!(rows(forms.a_tilde), ["0 0", "1/4 0"]);
}

#[test]
fn neighbours_merge_and_what_is_zero_at_an_end_is_no_step() {
    let same = |one: &str, other: &str| {
        let (one, other) = (define(one), define(other));
        assert!(
            one.has_coefficients_of(&other),
            "{:?} {:?}",
            one.exact_forms(),
            other.exact_forms()
        );
    };
    let verlet = "kick: [1/2, 1/2], drift: [1, 0]";
    // Kicks with no drift between them, at the start, in the middle and at the end.
    same("kick: [1/4, 1/4, 1/2], drift: [0, 1, 0]", verlet);
    same("kick: [1/2, 1/3, 1/6], drift: [1, 0, 0]", verlet);
    same("kick: [1/2, 0, 1/2], drift: [1/3, 2/3, 0]", verlet);
    same("kick: [1/2, 1/2, 0, 0], drift: [1, 0, 0, 0]", verlet);
    // The zero is one only in the field.
    same(
        "kick: [1/2, sqrt(2) + sqrt(3) - sqrt(5 + 2*sqrt(6)), 1/2], drift: [1/3, 2/3, 0]",
        verlet,
    );
    // What cancels takes its neighbours with it.
    same(
        "kick: [1/4, 1/4, -1/4, 3/4], drift: [0, 0, 1, 0]",
        "kick: [1/4, 3/4], drift: [1, 0]",
    );
    same(
        "kick: [1/2, 1/4, -1/4, 1/2], drift: [1/2, 0, 1/2, 0]",
        verlet,
    );
    // A first kick of zero is the other order; as many stages, so the pairs stay as they are written.
    let position = define("kick: [0, 1], drift: [1/2, 1/2]");
    assert_eq!(
        (position.stages(), position.evaluations().map(|e| e.forces)),
        (2, Some(1))
    );
    assert_eq!(position.exact_forms().b_tilde[0].as_deref(), Some("0"));
    // One pair fewer where drifts come first.
    same(
        "kick: [0, 1], drift: [1, 0]",
        "kick: [1], drift: [1], first: drift",
    );
}

#[test]
fn a_mirrored_half_is_the_whole() {
    let same = |half: &str, whole: &str| {
        assert!(define(half).has_coefficients_of(&define(whole)), "{half}");
    };
    same(
        "kick: [1/2], drift: [1], symmetric: true",
        "kick: [1/2, 1/2], drift: [1, 0]",
    );
    // A drift in the middle, a kick in the middle, and both with drifts first.
    same(
        "kick: [1/6, 1/3], drift: [3/4, -1/2], symmetric: true",
        "kick: [1/6, 1/3, 1/3, 1/6], drift: [3/4, -1/2, 3/4, 0]",
    );
    same(
        "kick: [1/6, 2/3], drift: [1/2], symmetric: true",
        "kick: [1/6, 2/3, 1/6], drift: [1/2, 1/2, 0]",
    );
    same(
        "kick: [1/2], drift: [1/6, 2/3], first: drift, symmetric: true",
        "kick: [1/2, 1/2, 0], drift: [1/6, 2/3, 1/6], first: drift",
    );
    same(
        "kick: [1/3, 1/3], drift: [1/4, 1/4], first: drift, symmetric: true",
        "kick: [1/3, 1/3, 1/3, 0], drift: [1/4, 1/4, 1/4, 1/4], first: drift",
    );
}

/// Decides a requirement of a definition, by proofs alone.
fn holds(definition: &str, requirement: &str) -> Result<(), symplectic_compiler::Error> {
    require(definition, requirement, None, &Limits::default())
}

#[test]
fn symmetry_and_symplecticity_for_separable_systems() {
    let decided = |text: &str| {
        let properties = define(text).separable_properties();
        [
            properties.symplectic.evidence,
            properties.symmetric.evidence,
        ]
    };
    use Evidence::{Proved, Refuted};
    assert_eq!(decided("kick: [1/2, 1/2], drift: [1, 0]"), [Proved, Proved]);
    assert_eq!(decided("kick: [0, 1], drift: [1/2, 1/2]"), [Proved, Proved]);
    assert_eq!(
        decided("kick: [1/4, 3/4], drift: [1, 0]"),
        [Proved, Refuted]
    );
    assert_eq!(
        decided("kick: [7/24, 3/4, -1/24], drift: [2/3, -2/3, 1]"),
        [Proved, Refuted]
    );
    // Symmetric weights in a step that is not: the kicks mirror one another and the drifts do not.
    assert_eq!(
        decided("kick: [1/4, 1/2, 1/4], drift: [1/3, 2/3, 0]"),
        [Proved, Refuted]
    );
    // Given coefficients that are no splitting.
    let spoilt =
        "a: [[0, 0], [1, 0]], b: [1, 0], a_tilde: [[1/2, 1/8], [1/2, 1/2]], b_tilde: [1/2, 1/2]";
    assert_eq!(decided(spoilt)[0], Refuted);
    // Suzuki's has equal weights, which only their places tell apart.
    assert_eq!(
        decided("base: velocity-verlet, weights: suzuki(4)"),
        [Proved, Proved]
    );
    let refused =
        holds("kick: [1/2, 1/2], drift: [1, 0]", "symplectic").expect_err("for separable H only");
    assert_eq!(
        refused.to_string(),
        "the method is not `symplectic`: b_1 − b̃_1 = 1/2; for separable H it is: require `symplectic(separable)`"
    );
    assert!(holds("kick: [1/2, 1/2], drift: [1, 0]", "symmetric(separable)").is_ok());
    assert!(holds("kick: [1/4, 3/4], drift: [1, 0]", "symmetric(separable)").is_err());
    assert!(
        holds(
            "basis: polynomial(2), nodes: gauss(2)",
            "symmetric(separable)"
        )
        .is_ok()
    );
}

#[test]
fn compositions_by_name() {
    let jump = define("base: velocity-verlet, weights: triple_jump(4)");
    assert!(jump.has_coefficients_of(&known("forest-ruth-1990")));
    assert_eq!(jump.stages(), 4);
    // The same weights by hand, whole and mirrored, and the base by its definition.
    for weights in [
        "weights: [1/(2 - cbrt(2)), -cbrt(2)/(2 - cbrt(2))], symmetric: true",
        "weights: [1/(2 - cbrt(2)), -cbrt(2)/(2 - cbrt(2)), 1/(2 - cbrt(2))]",
    ] {
        let text = format!("base: [kick: [1/2, 1/2], drift: [1, 0]], {weights}");
        assert!(define(&text).has_coefficients_of(&jump), "{text}");
    }
    // Symplectic for all Hamiltonians, as the base is.
    let general = define("base: StoermerVerlet, weights: suzuki(4)");
    let properties = general.properties();
    assert!(properties.symplectic.holds && properties.symmetric.holds);
    let orders = general.orders();
    assert_eq!((orders.general.order, orders.separable.order), (4, 4));
    assert_eq!(
        general.evaluations(),
        Some(Evaluations {
            forces: 5,
            velocities: 5
        })
    );
    // One step of Gauss, order 4, is where the scheme starts from.
    let gauss = define("base: gauss-2, weights: triple_jump(6)");
    assert_eq!((gauss.stages(), gauss.orders().general.order), (6, 6));
    assert_eq!(gauss.tier(), Tier::ConstantField);
    // Euler and its adjoint.
    let verlet = define("base: symplectic-euler, weights: [1/2, adjoint(1/2)]");
    assert_eq!(verlet.orders().general.order, 2);
    assert!(verlet.properties().symmetric.holds);
    let euler = define("base: symplectic-euler, weights: [1/2, 1/2]");
    assert_eq!(euler.orders().general.order, 1);
    // A base is a method, with nothing else.
    assert!(define("base: gauss-2").has_coefficients_of(&known("gauss-2")));
}

#[test]
fn orders_of_the_schemes() {
    let order = |text: &str| {
        let tableau = Definition::parse(text)
            .and_then(|definition| definition.derive(&Limits { stages: 40 }))
            .expect(text);
        let options = OrderOptions {
            limit: 9,
            ..OrderOptions::default()
        };
        let order = tableau
            .order(&options)
            .class(HamiltonianClass::Separable)
            .clone();
        (
            order.order,
            order.evidence == Evidence::Proved,
            tableau.tier(),
        )
    };
    let base = "base: velocity-verlet, weights";
    assert_eq!(
        order(&format!("{base}: triple_jump(6)")),
        (6, true, Tier::ConstantField)
    );
    assert_eq!(
        order(&format!("{base}: suzuki(6)")),
        (6, true, Tier::ConstantField)
    );
    // cbrt 2, ⁵√2 and ⁷√2 together have the degree 105.
    assert_eq!(
        order(&format!("{base}: triple_jump(8)")),
        (8, false, Tier::Enclosure)
    );
}

#[test]
fn what_is_derived_from_splittings_is_derived_again() {
    let verlet = known("velocity-verlet");
    let half = Constant::whole(2).inverse().expect("1/2");
    let twice = Tableau::concatenate(&[(&half, &verlet), (&half, &verlet)]).expect("composed");
    // Two of the four kicks are one.
    assert_eq!(twice.stages(), 3);
    assert!(twice.has_coefficients_of(&define("kick: [1/4, 1/2, 1/4], drift: [1/2, 1/2, 0]")));
    assert_eq!(define(&twice.provenance().definition.to_string()), twice);
    let adjoint = known("ruth-1983").adjoint();
    let there_and_back =
        Tableau::concatenate(&[(&half, &known("ruth-1983")), (&half, &adjoint)]).expect("composed");
    assert_eq!(
        define(&there_and_back.provenance().definition.to_string()),
        there_and_back
    );
    assert!(there_and_back.separable_properties().symmetric.holds);
    assert_eq!(there_and_back.orders().separable.order, 4);
    // Definitions are printed as they are read.
    for text in [
        "kick: [1/2, 1/2], drift: [1, 0]",
        "kick: 1, drift: 1, first: drift",
        "kick: [1/6, 2/3], drift: 1/2, symmetric: true",
        "base: stormer-verlet, weights: triple_jump(4)",
        "base: symplectic-euler, weights: [1/2, adjoint(1/2)]",
        "base: [basis: polynomial(2), nodes: gauss(2)], weights: [1/3, 1/3], symmetric: true, adjoint: true",
    ] {
        assert_eq!(define(text).provenance().definition.to_string(), text);
    }
    assert_eq!(decimals(&known("forest-ruth-1990"), 6)[0][0], "0.675604");
}

#[test]
fn what_is_wrong_is_said_where_it_stands() {
    for (text, expected) in [
        (
            "kick: [1/2, 1/2], drift: 1",
            "drift, column 1: 2 kicks and 1 drift: the same number of both; write 0 where there is none",
        ),
        (
            "kick: 1, drift: [1/3, 1/3, 1/3], symmetric: true",
            "drift, column 1: 1 kick and 3 drifts: the same number of both, or one more in `kick`, which is in the middle then",
        ),
        (
            "kick: [1/2, 1/3], drift: [1, 0]",
            "kick, column 1: the kicks sum to 5/6, and a step makes them for a time of 1 together; give exact numbers, one of them as 1 minus the others",
        ),
        (
            "kick: [1/2], drift: [1/2], symmetric: true",
            "drift, column 1: the drifts, mirrored, sum to 1/2, and a step",
        ),
        (
            "kick: [0.5, 0.5], drift: [0.33333333333333333333, 0.66666666666666666666]",
            "drift, column 1: the drifts sum to 0.99999999999999999999… (off by -1.0e-20), and",
        ),
        ("kick: [], drift: []", "kick, column 2: found `]`"),
        (
            "kick: 1",
            "a splitting has `kick` and `drift`, two lists of the same length: `drift` is missing beside `kick`",
        ),
        (
            "kick: 1, drift: 1, first: last",
            "first, column 1: last where `kick` or `drift` is needed",
        ),
        (
            "kick: 1, drift: 1, basis: polynomial(1)",
            "a splitting is all in `kick` and `drift`: leave out `basis`, or them",
        ),
        (
            "basis: 1, nodes: 0, symmetric: true",
            "`symmetric` goes with the `kick` and `drift` of a splitting, or the `weights` of a `base`: leave it out",
        ),
        (
            "basis: 1, nodes: 0, first: drift",
            "`first` goes with the `kick` and `drift` of a splitting: leave it out",
        ),
        (
            "kick: 1, drift: 1, weights: 1",
            "a splitting is all in `kick` and `drift`: leave out `weights`, or them",
        ),
        (
            "base: stormer-verlett",
            "base, column 1: unknown method `stormer-verlett`; known here: stormer-verlet, ",
        ),
        (
            "base: gauss-2, nodes: 0",
            "`base` is a whole method, with which `weights` make a composition: leave out `nodes`, or `base`",
        ),
        (
            "base: gauss-2, symmetric: true",
            "`symmetric` mirrors the `weights` of a composition, which are missing",
        ),
        (
            "base: [nodes: gauss(2)]",
            "base, column 1: `basis` is missing; ",
        ),
        ("base: [nodes: gauss(0), basis: 1]", "base, column 9: "),
        (
            "base: gauss-2, weights: [1/2, 1/3]",
            "weights, column 1: the weights sum to 5/6, ",
        ),
        (
            "base: ruth-1983, weights: [1/3, 1/3], symmetric: true",
            "base, column 1: `symmetric` needs a base method that is symmetric, and ruth-1983 is not: no order of the position stages",
        ),
        (
            "base: radau-left-2, weights: suzuki(4)",
            "base, column 1: `suzuki` needs a base method that is symmetric, and radau-left-2 is not: ",
        ),
        (
            "base: gauss-2, weights: triple_jump(4)",
            "weights, column 13: `triple_jump` builds the orders 6, 8, 10 from the order 4 of the base, not 4",
        ),
        (
            "base: stormer-verlet, weights: triple_jump(5)",
            "weights, column 13: `triple_jump` builds the orders 4, 6, 8, 10 from the order 2 of the base, not 5",
        ),
        (
            "base: stormer-verlet, weights: triple_jump(1e300)",
            "weights, column 13: `triple_jump` builds the orders 4, 6, 8, 10 from the order 2 of the base, not 1000",
        ),
        (
            "base: stormer-verlet, weights: [triple_jump(4), 1]",
            "weights, column 2: `triple_jump` among others where ",
        ),
        (
            "base: stormer-verlet, weights: suzuki(4), symmetric: true",
            "symmetric, column 1: `suzuki` is symmetric by itself: leave out `symmetric`",
        ),
        (
            "base: stormer-verlet, weights: adjoint(1, 2)",
            "weights, column 1: `adjoint` takes one fraction of the step, found 2 of them",
        ),
        (
            "base: stormer-verlet, weights: suzuki(8)",
            "weights, column 1: 250 stages exceed the limit of 32",
        ),
    ] {
        let found = message(text);
        assert!(found.starts_with(expected), "{text}\n{found}");
    }
}

#[test]
fn hostile_lengths_are_refused_at_once() {
    let many = vec!["0"; 20_000].join(", ");
    for text in [
        format!("kick: [{many}], drift: [{many}]"),
        format!("kick: [{many}], drift: [{many}], symmetric: true"),
        format!("base: gauss-2, weights: [{many}]"),
        format!("base: gauss-2, weights: [{many}], symmetric: true"),
    ] {
        let found = message(&text);
        assert!(found.contains("stages exceed the limit of 32"), "{found}");
    }
    let deep = format!(
        "base: {}base: gauss-2{}",
        "[".repeat(5000),
        "]".repeat(5000)
    );
    assert!(message(&deep).contains("depth"));
}
