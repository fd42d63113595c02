//! Splittings and compositions: what is written, what is derived of it, and what is refused.

use serde_json::Value;
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

/// The methods of the data file, as they are printed, with the orders that 50-digit arithmetic found: all are in the
/// catalogue, by closed forms or by their digits.
#[test]
#[ignore = "thorough"]
fn printed_methods_have_their_digits_and_the_orders_that_were_found() {
    let data: Value =
        serde_json::from_str(include_str!("../data/explicit-methods.json")).expect("JSON");
    let methods = data["methods"].as_array().expect("a list");
    assert_eq!(methods.len(), 31);
    for method in methods {
        let name = match method["name"].as_str().expect("a name") {
            "StormerVerlet" => "velocity-verlet",
            name => name,
        };
        let entry = catalogue::find(name).expect(name);
        let tableau = entry.derive().expect(name);
        let claimed = entry.definition.contains("claim: ");
        let list = |key: &str| -> Vec<&str> {
            let list = method[key].as_array().into_iter().flatten();
            let list = list.filter_map(Value::as_str);
            list.filter(|text| !["0", "0.0"].contains(text)).collect()
        };
        let printed = ["kick", "drift"].map(list);
        let mut same = true;
        // Closed forms agree to 19 places and more; some papers have wrong digits from the 13th place on.
        let bound = exact(if claimed { "1e-12" } else { "1e-19" });
        for (weights, printed) in decimals(&tableau, 40).iter().zip(&printed) {
            let weights: Vec<&String> = weights.iter().filter(|weight| *weight != "0").collect();
            assert_eq!(weights.len(), printed.len(), "{name}");
            for (weight, printed) in weights.iter().zip(printed) {
                let difference = exact(weight) - exact(printed);
                assert!(
                    -&bound < difference && difference < bound,
                    "{name}: {weight}, printed {printed}"
                );
                same &= entry.definition.contains(printed);
            }
        }
        // What is claimed of digits is claimed of those that are printed; weights are the drifts.
        let weights = entry.definition.contains("weights: ");
        let drifts = || {
            printed[1]
                .iter()
                .all(|text| entry.definition.contains(text))
        };
        assert!(!claimed || same || weights && drifts(), "{name}");
        let known = |key: &str| method[key].as_u64().map(|number| number as usize);
        let orders = tableau.orders();
        let class = method["hamiltonian_class"].as_str();
        for (found, known, of_claim) in [
            (
                &orders.separable,
                known("order_general_separable"),
                class == Some("separable"),
            ),
            (&orders.nystrom, known("order"), true),
        ] {
            assert_eq!(Some(found.order), known, "{name}");
            assert!(found.refuted_by.is_some(), "{name}");
            match found.evidence {
                Evidence::Proved => assert!(!claimed, "{name}"),
                Evidence::Certified => assert!(claimed, "{name}"),
                _ => assert!(claimed && !of_claim, "{name}"),
            }
        }
        assert_eq!(
            tableau.evaluations().map(|found| found.forces),
            known("force_evaluations_per_step"),
            "{name}"
        );
        let properties = tableau.separable_properties();
        assert!(properties.symplectic.holds, "{name}");
        assert_eq!(
            Some(properties.symmetric.holds),
            method["time_reversible"].as_bool(),
            "{name}"
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
fn adjacent_flows_merge_and_zero_steps_at_the_ends_are_dropped() {
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
fn splittings_are_symplectic_if_separable_and_palindromes_symmetric() {
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
fn a_named_composition_is_the_one_written_by_hand() {
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
            velocities: 5,
            gradients: 0,
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

/// Weights as they are printed: the exact ones near them, for any base of kicks and drifts that is symmetric.
#[test]
fn weights_of_a_composition_are_certified() {
    let suzuki = "weights: [0.4144907718, 0.4144907718, -0.6579630872], claim: separable(4), symmetric: true";
    let certified = define(&format!("base: velocity-verlet, {suzuki}"));
    assert_eq!(
        decimals(&certified, 60),
        decimals(&known("suzuki-1990"), 60)
    );
    assert_eq!(certified.tier(), Tier::Enclosure);
    let text = certified.provenance().definition.to_string();
    assert_eq!(text, format!("base: velocity-verlet, {suzuki}"));
    assert_eq!(define(&text), certified);
    let whole = "weights: [0.4144907718, 0.4144907718, -0.6579630872, 0.4144907718, 0.4144907718], claim: separable(4)";
    for base in [
        "position-verlet",
        "[kick: [1/2, 1/2], drift: [1, 0]]",
        "mclachlan-1995-s4",
    ] {
        for weights in [suzuki, whole] {
            let order = define(&format!("base: {base}, {weights}"))
                .orders()
                .separable;
            assert_eq!(
                (order.order, order.evidence),
                (4, Evidence::Certified),
                "{base}"
            );
            assert!(order.refuted_by.is_some());
        }
    }
    // Fractions that are exact are a method with exact coefficients.
    let verlet =
        define("base: velocity-verlet, weights: [1/3, 1/3], symmetric: true, claim: separable(2)");
    assert_eq!(verlet.tier(), Tier::ConstantField);
    assert_eq!(verlet.orders().separable.evidence, Evidence::Proved);
}

#[test]
fn named_compositions_have_their_proved_orders() {
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
    // cbrt 2, ⁵√2 and ⁷√2 together have the degree 105: the order follows from how the method is made.
    assert_eq!(
        order(&format!("{base}: triple_jump(8)")),
        (8, true, Tier::Enclosure)
    );
}

#[test]
fn compositions_and_adjoints_of_splittings_are_derived_again() {
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
fn malformed_splittings_are_refused_at_the_place() {
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
            "kick, column 1: the kicks sum to 5/6, but must sum to 1; give exact numbers, one of them as 1 minus the others",
        ),
        (
            "kick: [1/2], drift: [1/2], symmetric: true",
            "drift, column 1: the drifts, mirrored, sum to 1/2, but must",
        ),
        (
            "kick: [0.5, 0.5], drift: [0.33333333333333333333, 0.66666666666666666666]",
            "drift, column 1: the drifts sum to 0.99999999999999999999… (off by -1.0e-20), but",
        ),
        ("kick: [], drift: []", "kick, column 2: found `]`"),
        (
            "kick: 1",
            "a splitting has `kick` and `drift`, two lists of the same length: `drift` is missing beside `kick`",
        ),
        (
            "kick: 1, drift: 1, first: last",
            "first, column 1: found last, expected `kick` or `drift`",
        ),
        (
            "kick: 1, drift: 1, basis: polynomial(1)",
            "`kick` and `drift` define a splitting completely: leave out `basis`, or both of them",
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
            "`kick` and `drift` define a splitting completely: leave out `weights`, or both of them",
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
            "weights, column 2: found `triple_jump` among others, expected ",
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
            "weights, column 1: 250 stages exceed the limit of 36",
        ),
        (
            "base: velocity-verlet, claim: separable(4)",
            "beside a `base` a `claim` is about its printed `weights`, which are missing",
        ),
        (
            "base: velocity-verlet, weights: [0.4144907718, 0.4144907718, -0.7579630872], symmetric: true, claim: separable(4)",
            "weights, column 1: the weights sum to 0.9, not to 1; the nearest certified solution is 0.1",
        ),
        (
            "base: velocity-verlet, weights: [1.3512071920, -1.7024143839], symmetric: true, claim: separable(6)",
            "claim, column 1: order 6 with any symmetric basic method takes 4 conditions, and a symmetric composition with these coefficients has 2 unknowns: too few",
        ),
        (
            "base: velocity-verlet, weights: [1.3512071920, -1.7024143840], symmetric: true, claim: separable(12)",
            "claim, column 1: the order 12 cannot be claimed: ",
        ),
        (
            "base: velocity-verlet, weights: [1.3512071920, -1.7024143840], symmetric: true, claim: nystrom(4)",
            "claim, column 1: printed `weights` claim an order that they give every symmetric base: `separable(8)`",
        ),
        (
            "base: velocity-verlet, weights: [1.3512071920, -cbrt(5)], symmetric: true, claim: separable(4)",
            "weights, column 16: `-cbrt(5)` is not a decimal",
        ),
        (
            "base: ruth-1983, weights: [1.3512071920, -1.7024143840], symmetric: true, claim: separable(4)",
            "base, column 1: a `claim` needs a base method that is symmetric, and ruth-1983 is not: ",
        ),
        (
            "base: gauss-2, weights: [1.3512071920, -1.7024143840], symmetric: true, claim: separable(4)",
            "base, column 1: a `claim` takes a base of kicks and drifts, such as velocity-verlet, not gauss-2",
        ),
    ] {
        let found = message(text);
        assert!(found.starts_with(expected), "{text}\n{found}");
    }
}

/// What follows from how a method is made, although the field of its weights is too large: degree 945 for order 10.
#[test]
#[ignore = "thorough"]
fn named_compositions_have_the_order_that_they_are_made_for() {
    for (name, order, steps) in [
        ("triple-jump-8", 8, 27),
        ("triple-jump-10", 10, 81),
        ("suzuki-8", 8, 125),
        ("suzuki-10", 10, 625),
    ] {
        let tableau = known(name);
        assert_eq!(tableau.tier(), Tier::Enclosure, "{name}");
        let report = tableau.orders();
        for class in [HamiltonianClass::Separable, HamiltonianClass::Nystrom] {
            let found = report.class(class);
            // Sharp, too: a condition of the next order is refuted.
            assert!(found.refuted_by.is_some(), "{name}: {found}");
            assert_eq!(
                (found.order, found.evidence),
                (order, Evidence::Proved),
                "{name}"
            );
        }
        assert_eq!(
            (report.general.order, report.general.evidence),
            (1, Evidence::Proved)
        );
        let separable = tableau.separable_properties();
        assert_eq!(separable.symplectic.evidence, Evidence::Proved, "{name}");
        assert_eq!(separable.symmetric.evidence, Evidence::Proved, "{name}");
        assert_eq!(tableau.properties().consistent.evidence, Evidence::Proved);
        let made = tableau.evaluations().expect("explicit");
        assert_eq!((made.forces, made.velocities), (steps, steps), "{name}");
    }
    // The same theorem for a base that is solved for, and for every Hamiltonian.
    let gauss = define("base: gauss-2, weights: triple_jump(8)");
    let general = gauss.orders().general;
    assert_eq!(
        (general.order >= 8, general.evidence),
        (true, Evidence::Proved)
    );
}

/// Nothing is given of a list of the same weights, nor of one that is nearly the same.
#[test]
fn orders_are_given_to_named_compositions_only() {
    let outer = "1/(2 - root(t^3 - 2, 1))";
    let listed = |outer: &str| {
        define(&format!(
            "base: velocity-verlet, weights: [{outer}, 1 - 2*({outer})], symmetric: true"
        ))
    };
    assert_eq!(listed(outer).orders().separable.order, 4);
    let off = listed(&format!("{outer} + 1/10^30")).orders().separable;
    assert_eq!(off.order, 2);
    assert!(off.refuted_by.is_some());
}

/// The digits of a certified method read the same from both ends, and so do its exact coefficients.
#[test]
fn a_certified_palindrome_is_proved_to_be_symmetric() {
    let base = known("blanes-moan-2002-s6");
    assert_eq!(
        base.separable_properties().symmetric.evidence,
        Evidence::Proved
    );
    let jump = define(
        "base: blanes-moan-2002-s6, weights: [1.3512071920, -1.7024143840], symmetric: true, claim: separable(4)",
    );
    let separable = jump.orders().separable;
    assert!(separable.order >= 4, "{separable}");
    assert_eq!(separable.evidence, Evidence::Certified);
}

#[test]
fn hostile_lengths_are_refused_at_once() {
    let many = vec!["0"; 20_000].join(", ");
    for text in [
        format!("kick: [{many}], drift: [{many}]"),
        format!("kick: [{many}], drift: [{many}], symmetric: true"),
        format!("base: gauss-2, weights: [{many}]"),
        format!("base: gauss-2, weights: [{many}], symmetric: true"),
        format!("base: velocity-verlet, weights: [{many}], claim: separable(4)"),
    ] {
        let found = message(&text);
        assert!(found.contains("stages exceed the limit of 36"), "{found}");
    }
    let deep = format!(
        "base: {}base: gauss-2{}",
        "[".repeat(5000),
        "]".repeat(5000)
    );
    assert!(message(&deep).contains("depth"));
}
