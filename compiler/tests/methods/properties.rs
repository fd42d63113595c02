//! Every property has a tableau of which it is proved and one of which it is refuted, with the witness.

use symplectic_compiler::export::{json, toml};
use symplectic_compiler::{Definition, Evidence, Limits, Properties, Requirement, Tableau, derive};

/// The tableau of an edited file; reading does not derive it anew.
fn edited(tableau: &Tableau, from: &str, to: &str) -> Tableau {
    let text = toml::write(tableau, 5);
    assert!(text.contains(from), "{from} is not in\n{text}");
    toml::read(
        "edited.toml",
        &text.replacen(from, to, 1),
        &Limits::default(),
    )
    .expect("readable")
}

fn method(basis: &str, nodes: &str) -> Tableau {
    derive(basis, nodes).expect("a method")
}

fn assert_refuted(tableau: &Tableau, name: &str, witness: &str) {
    let properties = tableau.properties();
    let property = properties.get(name).expect(name);
    assert!(!property.holds, "{name}");
    assert_eq!(property.evidence, Evidence::Refuted, "{name}");
    assert_eq!(property.witness.as_deref(), Some(witness), "{name}");
}

#[test]
fn every_property_is_proved_of_one_method_and_refuted_of_another() {
    let cases = [
        // The method of which it holds, and the one of which it does not.
        (
            "symmetric",
            "lobatto(3)",
            "radau-right(3)",
            "no order of the stages makes the tableau equal to its adjoint",
        ),
        (
            "equal_matrices",
            "gauss(3)",
            "lobatto(3)",
            "a_11 − ã_11 = -1/6",
        ),
        (
            "explicit",
            "lobatto(2)",
            "gauss(1)",
            "these stages need one another: Q1 → P1 → Q1",
        ),
        (
            "first_row_zero",
            "radau-left(2)",
            "radau-right(2)",
            "a_11 = 5/12",
        ),
        (
            "stiffly_accurate",
            "radau-right(2)",
            "radau-left(2)",
            "b_1 − a_21 = -1/12",
        ),
        (
            "first_same_as_last",
            "lobatto(2)",
            "radau-left(2)",
            "b_1 − a_21 = -1/12",
        ),
        (
            "first_same_as_last",
            "newton-cotes(4)",
            "radau-right(2)",
            "a_11 = 5/12",
        ),
        // 4/14175 · (989, 5888, −928, …), the weights of nine equidistant nodes on an interval of length 8.
        (
            "positive_weights",
            "newton-cotes(8)",
            "newton-cotes(9)",
            "b_3 = -464/14175",
        ),
        ("constrained", "lobatto(4)", "gauss(2)", "a_11 = 1/4"),
        (
            "constrained",
            "newton-cotes(5)",
            "radau-left(2)",
            "b_1 − a_21 = -1/12",
        ),
        (
            "nonholonomic",
            "lobatto(2)",
            "lobatto(3)",
            "steps with non-holonomic constraints have order 2 at most",
        ),
        (
            "nonholonomic",
            "gauss(1)",
            "gauss(2)",
            "steps with non-holonomic constraints have order 2 at most",
        ),
    ];
    for (name, holds, fails, witness) in cases {
        let basis = |nodes: &str| {
            nodes
                .split_once('(')
                .map(|(_, s)| format!("polynomial({s}"))
        };
        let tableau = method(&basis(holds).expect("a rule"), holds);
        let properties = tableau.properties();
        let property = properties.get(name).expect(name);
        assert!(
            property.holds && property.evidence == Evidence::Proved,
            "{name} of {holds}"
        );
        assert_refuted(
            &method(&basis(fails).expect("a rule"), fails),
            name,
            witness,
        );
    }
}

/// The methods that the guides name for systems with constraints, with the requirement that they name.
#[test]
#[ignore = "thorough"]
fn compositions_of_methods_that_qualify_can_be_required_to() {
    for (definition, requirement) in [
        ("base: lobatto-2, weights: triple_jump(4)", "constrained"),
        ("base: gauss-1, weights: suzuki(6)", "nonholonomic"),
        ("base: gauss-1, weights: suzuki(4)", "nonholonomic"),
        (
            "base: lobatto-2, weights: [1/2, adjoint(1/2)]",
            "constrained",
        ),
        (
            "base: [base: symplectic-euler, weights: [1/2, adjoint(1/2)]], weights: triple_jump(4)",
            "nonholonomic",
        ),
    ] {
        let parsed = Definition::parse(definition).expect(definition);
        let tableau = parsed.derive(&Limits::default()).expect("derived");
        let required = Requirement::parse(requirement).expect(requirement);
        assert_eq!(tableau.require(&required, None), Ok(()), "{definition}");
        let json = json::write(&tableau, 20);
        let json: serde_json::Value = serde_json::from_str(&json).expect("valid");
        let property = &json["properties"][requirement];
        assert_eq!(property["holds"], true, "{property}");
        assert_eq!(property["evidence"], "proved", "{property}");
    }
}

#[test]
fn a_changed_coefficient_is_no_longer_symplectic() {
    let midpoint = method("1", "1/2");
    assert!(midpoint.properties().symplectic.holds);
    // 1·1/2 + 1·1/3 − 1·1 = −1/6
    assert_refuted(
        &edited(&midpoint, "a = [\n    [\"1/2\"]", "a = [\n    [\"1/3\"]"),
        "symplectic",
        "b_1 ã_11 + b̃_1 a_11 − b_1 b̃_1 = -1/6",
    );
    assert_refuted(
        &edited(&midpoint, "b_tilde = [\"1\"]", "b_tilde = [\"2\"]"),
        "symplectic",
        "b_1 − b̃_1 = -1",
    );
    // Irrational tableaux: 1/12 more in the constant of a makes every entry 1/12 larger, times b_1 = 1/2.
    let gauss = edited(
        &method("polynomial(2)", "gauss(2)"),
        "a = [\n    [ \"1/4\"",
        "a = [\n    [ \"1/3\"",
    );
    let properties = gauss.properties();
    assert!(!properties.symplectic.holds);
    assert_eq!(
        properties.symplectic.witness.as_deref(),
        Some("b_1 ã_11 + b̃_1 a_11 − b_1 b̃_1 = 1/24")
    );
}

#[test]
fn a_changed_coefficient_is_no_longer_symmetric_consistent_or_equal() {
    let midpoint = method("1", "1/2");
    let weights = edited(&midpoint, "b = [\"1\"]", "b = [\"2\"]");
    assert_refuted(&weights, "consistent", "the weights b sum to 2 and b̃ to 1");
    assert_refuted(
        &edited(&weights, "b_tilde = [\"1\"]", "b_tilde = [\"2\"]"),
        "consistent",
        "the weights sum to 2 instead of 1",
    );
    let matrix = edited(&midpoint, "a = [\n    [\"1/2\"]", "a = [\n    [\"1/3\"]");
    assert_refuted(&matrix, "equal_matrices", "a_11 − ã_11 = -1/6");
    assert_refuted(
        &matrix,
        "symmetric",
        "a_σ(1)σ(1) + a_11 − b_1 = -1/3 where stage σ(i) is the mirror image of stage i",
    );
    assert_refuted(
        &edited(&midpoint, "b = [\"1\"]", "b = [\"-1\"]"),
        "positive_weights",
        "b_1 = -1",
    );
    assert_refuted(
        &edited(&midpoint, "b_tilde = [\"1\"]", "b_tilde = [\"0\"]"),
        "positive_weights",
        "b̃_1 = 0",
    );
}

#[test]
fn a_basis_without_constants_is_not_consistent() {
    // b = ∫t / 1 at the node 1.
    assert_refuted(
        &method("t", "1"),
        "consistent",
        "the weights sum to 1/2 instead of 1",
    );
}

#[test]
fn every_property_has_a_test_here() {
    let source = include_str!("properties.rs");
    for name in Properties::NAMES {
        assert!(
            source.matches(&format!("\"{name}\"")).count() >= 1,
            "{name}"
        );
    }
}
