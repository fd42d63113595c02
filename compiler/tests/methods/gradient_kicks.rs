//! Splittings with gradient kicks: what is derived, proved and refused.

use symplectic_compiler::export::{json, text, toml};
use symplectic_compiler::order::{HamiltonianClass, OrderOptions, Pendulum};
use symplectic_compiler::schedule::Evaluations;
use symplectic_compiler::{Definition, Evidence, Limits, Tableau, catalogue, check, require};

fn define(text: &str) -> Tableau {
    let definition = Definition::parse(text).expect(text);
    definition.derive(&Limits::default()).expect(text)
}

fn message(text: &str) -> String {
    let refused = Definition::parse(text).and_then(|text| text.derive(&Limits::default()));
    refused.expect_err(text).to_string()
}

/// Chin's method, and the one with the other sign of `g`.
const CHIN: &str = "kick: [1/6, 2/3, 1/6], drift: [1/2, 1/2, 0], gradient: [0, 1/72, 0]";
const OTHER_SIGN: &str = "kick: [1/6, 2/3, 1/6], drift: [1/2, 1/2, 0], gradient: [0, -1/72, 0]";

fn nystrom(tableau: &Tableau) -> usize {
    tableau.orders().nystrom.order
}

#[test]
fn the_order_is_sharp_and_that_of_the_pendulum() {
    for (text, order) in [
        (CHIN, 4),
        (OTHER_SIGN, 2),
        (
            "kick: [1/6, 2/3, 1/6], drift: [1/2, 1/2, 0], gradient: [0, 1/73, 0]",
            2,
        ),
        // Without a kick by U itself.
        (
            "kick: [0, 1, 0], drift: [1/2, 1/2, 0], gradient: [1/48, 0, 1/48]",
            2,
        ),
    ] {
        let tableau = define(text);
        let found = tableau.orders().nystrom;
        assert_eq!(
            (found.order, found.evidence),
            (order, Evidence::Proved),
            "{text}"
        );
        assert!(found.refuted_by.is_some(), "{text}");
        let seen = tableau
            .observed_order(Pendulum::Quadratic, order)
            .expect(text);
        assert!((seen - order as f64).abs() < 1e-6, "{text}: {seen}");
        assert_eq!(tableau.observed_order(Pendulum::Relativistic, order), None);
    }
}

/// One condition for each tree without a root, and all of them, give the same order and the same norm of the error.
#[test]
fn all_conditions_and_one_for_all_rootings_agree() {
    let all = OrderOptions {
        all_conditions: true,
        ..OrderOptions::default()
    };
    for text in [
        CHIN,
        OTHER_SIGN,
        "kick: [1/5, 4/5], drift: [1/3, 2/3], gradient: [1/7, -2/9]",
        "kick: [0, 3/4, 1/4], drift: [1/3, 1/3, 1/3], gradient: [1/11, 0, 1/13], first: drift",
        "base: chin-1997-c, weights: triple_jump(6)",
    ] {
        let tableau = define(text);
        let (one, every) = (tableau.orders().nystrom, tableau.order(&all).nystrom);
        assert_eq!(one.order, every.order, "{text}");
        assert!(one.error_constant.is_some(), "{text}");
        assert_eq!(one.error_constant, every.error_constant, "{text}");
    }
}

/// Up to its order the modified equation is the given one. The first term beyond it is that of the order condition.
#[test]
fn the_modified_equation_is_the_given_one_up_to_the_order() {
    for (text, order) in [(CHIN, 4), (OTHER_SIGN, 2)] {
        let terms = define(text).modified_equation(HamiltonianClass::Nystrom, order + 1);
        for term in &terms {
            let vertices = term.tree.order();
            let expected = if vertices == 1 { "1" } else { "0" };
            if vertices <= order {
                assert_eq!(
                    term.exact.as_deref(),
                    Some(expected),
                    "{text} {}",
                    term.tree
                );
            }
        }
        let beyond = terms.iter().filter(|term| term.tree.order() == order + 1);
        assert!(
            beyond
                .clone()
                .any(|term| term.exact.as_deref() != Some("0")),
            "{text}"
        );
        assert!(
            define(text)
                .modified_equation(HamiltonianClass::Separable, 3)
                .is_empty()
        );
    }
}

/// `p −= (k h − 2 g h³) q`: the trace of `kick(1/6) drift(1/2) kick(2/3, 1/72) drift(1/2) kick(1/6)`, by hand.
#[test]
fn the_step_of_the_oscillator_has_the_matrix_found_by_hand() {
    let stability = define(CHIN).stability();
    assert_eq!(stability.trace.to_string(), "(864 − 432ν² + 36ν⁴ − ν⁶)/432");
    assert_eq!(stability.intervals_text(), "(0, 2*sqrt(3)]");
    let dispersion = stability.dispersion.expect("consistent");
    assert_eq!(
        (dispersion.order, &*dispersion.coefficient.text),
        (4, "-1/4320")
    );
    // The first interval from the first half alone.
    let jump = define("base: chin-1997-c, weights: triple_jump(6)");
    let first = jump.first_stable_interval().expect("a palindrome");
    assert_eq!(
        first.high.decimal(20),
        jump.stability().intervals[0].high.decimal(20)
    );
}

#[test]
fn a_gradient_kick_counts_as_a_force_and_a_product() {
    let count = |text: &str| define(text).evaluations().expect("explicit");
    let of = |forces, velocities, gradients| Evaluations {
        forces,
        velocities,
        gradients,
    };
    assert_eq!(count(CHIN), of(2, 2, 1));
    // Both ends have the same force, and the same product.
    let at_the_ends = "kick: [1/2, 1/2], drift: [1, 0], gradient: [1/48, 1/48]";
    assert_eq!(count(at_the_ends), of(1, 1, 1));
    let at_one_end = "kick: [1/2, 1/2], drift: [1, 0], gradient: [1/24, 0]";
    assert_eq!(count(at_one_end), of(1, 1, 1));
    // Without a gradient weight it is an ordinary splitting.
    let plain = define("kick: [1/2, 1/2], drift: [1, 0], gradient: [0, 0]");
    assert_eq!(plain.evaluations(), Some(of(1, 1, 0)));
    assert_eq!(plain.orders().separable.order, 2);
    // n C^(1/p) ε^(−1/p) with n = 3.
    let cost = define(CHIN).evaluations_for(HamiltonianClass::Nystrom, 1e-8);
    assert!((cost.expect("a figure") - 3.0 * (0.005_746_384_994e8_f64).powf(0.25)).abs() < 1e-6);
}

#[test]
fn classes_with_other_kinetic_energies_are_refused() {
    let refused = |text: &str, requirement: &str| {
        let error = require(text, requirement, None, &Limits::default());
        error.expect_err(requirement).to_string()
    };
    for (requirement, message) in [
        (
            "order(separable) >= 2",
            "the method has no order for separable H: gradient kicks need quadratic T; require `order(nystrom)`",
        ),
        (
            "order >= 1",
            "the method has no order for general H: gradient kicks need quadratic T; require `order(nystrom)`",
        ),
        (
            "order(perturbed) >= (2, 2)",
            "the method has no order for perturbed H: gradient kicks need quadratic T",
        ),
        (
            "symplectic(separable)",
            "the method is not `symplectic(separable)`: gradient kicks need quadratic T; require `symplectic(nystrom)`",
        ),
        (
            "symmetric",
            "the method is not `symmetric`: gradient kicks need quadratic T; for nystrom H it is: require `symmetric(nystrom)`",
        ),
        (
            "constrained",
            "the method is not `constrained`: gradient kicks need quadratic T",
        ),
    ] {
        assert_eq!(refused(CHIN, requirement), message);
    }
    for requirement in [
        "order(nystrom) == 4",
        "symplectic(nystrom)",
        "symmetric(nystrom)",
    ] {
        assert!(require(CHIN, requirement, None, &Limits::default()).is_ok());
    }
    // Every splitting is symplectic for the smaller class too.
    let verlet = "kick: [1/2, 1/2], drift: [1, 0]";
    assert!(require(verlet, "symplectic(nystrom)", None, &Limits::default()).is_ok());
    let asymmetric = CHIN.replace("0, 1/72, 0", "1/72, 0, 0");
    assert!(
        refused(&asymmetric, "symmetric(nystrom)")
            .ends_with("the kicks and drifts are not a palindrome")
    );
}

#[test]
fn compositions_and_adjoints_have_gradient_kicks_in_the_third_power() {
    let scaled = define(&format!("compose: [[1/2, {CHIN}], [1/2, {CHIN}]]"));
    let gradient: Vec<_> = scaled.exact_forms().gradient;
    let expected = ["0", "1/576", "0", "1/576", "0"].map(|text| Some(text.to_owned()));
    assert_eq!(gradient, expected);
    assert_eq!(nystrom(&scaled), 4);
    let jump = define("base: chin-1997-c, weights: triple_jump(6)");
    assert_eq!(nystrom(&jump), 6);
    let seen = jump
        .observed_order(Pendulum::Quadratic, 6)
        .expect("an order");
    assert!((seen - 6.0).abs() < 1e-6);
    let euler = "kick: [1], drift: [1], gradient: [1/12]";
    let there_and_back = format!("compose: [[1/2, {euler}], [1/2, {euler}, adjoint: true]]");
    let found = define(&there_and_back);
    assert!(found.separable_properties().symmetric.holds);
    let adjoint = define(&format!("{euler}, adjoint: true")).exact_forms();
    assert_eq!(adjoint.gradient, [Some("1/12".to_owned())]);
    let seen = define(&format!("{euler}, adjoint: true")).observed_order(Pendulum::Quadratic, 1);
    assert!((seen.expect("an order") - 1.0).abs() < 1e-6);
}

#[test]
fn definitions_that_do_not_fit_gradient_kicks_are_refused() {
    for (text, part) in [
        (
            "kick: [1/2, 1/2], drift: [1, 0], gradient: [1/24]",
            "2 kicks and 1 weight of gradient kicks: one for each kick; write 0 where there is none",
        ),
        (
            "kick: [1/2, 1/2], drift: [1, 0], gradient: [1/24, 1/24], exchange: true",
            "`exchange` would make drifts of gradient kicks, which change momenta only: leave it out",
        ),
        (
            "compose: [[1/2, kick: [1], drift: [1], gradient: [1/24]], [1/2, basis: polynomial(1), nodes: gauss(1)]]",
            "a splitting with gradient kicks is composed with splittings only",
        ),
        (
            "a: [[1/2]], b: [1], gradient: [1]",
            "`kick` and `drift` define a splitting completely: leave out `a`, or both of them",
        ),
        (
            "base: chin-1997-c, weights: [0.5, 0.5], claim: separable(2)",
            "a `claim` takes a base for separable H, and chin-1997-c has gradient kicks, which need quadratic T",
        ),
        (
            "kick: [0.5, 0.5], drift: [1.0, 0], gradient: [0.1, 0.1], claim: separable(2)",
            "gradient kicks need quadratic T: claim `nystrom(2)`",
        ),
    ] {
        let told = message(text);
        assert!(told.contains(part), "{text}: {told}");
    }
}

/// The methods of the catalogue from decimals: the exact ones are found, and a changed digit is.
#[test]
fn printed_gradient_weights_are_certified() {
    let chin = "kick: [0.16666666666666667, 0.66666666666666667], drift: [0.5], \
                gradient: [0, 0.013888888888888889], symmetric: true, claim: nystrom(4)";
    let tableau = define(chin);
    assert!(tableau.has_coefficients_of(&define(CHIN)));
    assert!(tableau.wrong_digits().is_empty());
    let changed = define(&chin.replace("0.013888888888888889", "0.013888888889888889"));
    let wrong = changed.wrong_digits();
    assert_eq!(wrong.len(), 1);
    let told = wrong[0].to_string();
    assert!(
        told.contains("`0.013888888889888889` is not the exact gradient[1], rounded: that is 0.013888888888888889"),
        "{told}"
    );
    // Another sign is too far away.
    let other = message(&chin.replace("0.0138", "-0.0138"));
    assert!(
        other.contains("farther") || other.contains("away"),
        "{other}"
    );
    // Two gradient kicks, with irrational numbers.
    let two = define(
        "kick: [0.5], drift: [0.21132486540518712, 0.57735026918962576], gradient: [0.0055822748423150563], \
         first: drift, symmetric: true, claim: nystrom(4)",
    );
    let found = two.orders().nystrom;
    assert_eq!((found.order, found.evidence), (4, Evidence::Certified));
    let exact = catalogue::find("chin-chen-2002-4b")
        .expect("known")
        .derive()
        .expect("derived");
    let digits = |tableau: &Tableau| -> Vec<String> {
        let numbers = tableau.numbers().gradient;
        numbers.iter().map(|g| g.decimal(40).to_string()).collect()
    };
    assert_eq!(digits(&two), digits(&exact));
}

/// A claim of one order more, and its digits, are refused.
#[test]
fn claims_of_a_higher_order_are_refused() {
    let chin = "kick: [0.16666666666666667, 0.66666666666666667], drift: [0.5], \
                gradient: [0, 0.013888888888888889], symmetric: true, claim: nystrom(6)";
    assert!(message(chin).contains("conditions"), "{}", message(chin));
}

#[test]
fn files_have_the_gradient_weights_and_are_checked() {
    let tableau = define(CHIN).named("chin");
    let limits = Limits::default();
    let (in_toml, in_json) = (toml::write(&tableau, 20), json::write(&tableau, 20));
    assert!(
        in_toml.contains("gradient = [\"0\", \"1/72\", \"0\"]"),
        "{in_toml}"
    );
    assert!(in_json.contains("\"gradient\": ["), "{in_json}");
    for (name, written) in [("chin.toml", in_toml), ("chin.json", in_json)] {
        assert_eq!(check(name, &written, &limits).expect(name), tableau);
        let changed = written.replacen("0.013888888888888888889", "0.013888888888888888888", 1);
        let told = check(name, &changed, &limits).expect_err(name).to_string();
        assert!(told.contains("g_2 (decimal)"), "{told}");
    }
    let table = text::write(&tableau, 16);
    assert!(
        table.contains("g = 0, 1/72, 0: p += h (b̃_i f + 2 g_i h² f′ M⁻¹ f)"),
        "{table}"
    );
    let long = Definition::parse(&format!("base: [{CHIN}], weights: triple_jump(10)"));
    let long = long
        .and_then(|text| text.derive(&Limits { stages: 55 }))
        .expect("derived");
    let table = text::write(&long, 16);
    assert!(
        table.lines().any(|line| line.contains("gradient g")),
        "{table}"
    );
}
