//! Files of every older format are read. Each file is as an earlier version wrote it.

use symplectic_compiler::{Limits, check, check_and_list, derive, export};

/// A file, its text, and the properties that it does not state.
const FILES: [(&str, &str, &[&str]); 9] = [
    // Neither tier, orders nor stability.
    (
        "lobatto-3.toml",
        include_str!("older/lobatto-3-first.toml"),
        &["constrained", "nonholonomic"],
    ),
    // Neither orders nor stability.
    (
        "gauss-2.toml",
        include_str!("older/gauss-2-tier.toml"),
        &["constrained", "nonholonomic"],
    ),
    (
        "forest-ruth-1990.toml",
        include_str!("older/forest-ruth-1990-orders.toml"),
        &["constrained", "nonholonomic"],
    ),
    // Witnesses in other words.
    (
        "chebyshev-2.toml",
        include_str!("older/chebyshev-2-witness.toml"),
        &["constrained", "nonholonomic"],
    ),
    // What is proved now was only verified then.
    (
        "blanes-moan-2002-s6.toml",
        include_str!("older/blanes-moan-2002-s6-evidence.toml"),
        &["constrained", "nonholonomic"],
    ),
    // A composition of methods that qualify, which then did not.
    (
        "suzuki-4.toml",
        include_str!("older/suzuki-4-constrained.toml"),
        &[],
    ),
    // The adjoint of a method that qualifies, which then did not.
    (
        "adjoint-rattle.toml",
        include_str!("older/adjoint-rattle-constrained.toml"),
        &[],
    ),
    // With a byte order mark.
    (
        "gauss-1.toml",
        include_str!("older/gauss-1-bom.toml"),
        &["constrained", "nonholonomic"],
    ),
    (
        "gauss-1.json",
        include_str!("older/gauss-1.json"),
        &["constrained", "nonholonomic"],
    ),
];

fn without_mark(text: &str) -> &str {
    export::without_mark(text)
}

#[test]
fn files_of_older_formats_are_checked_and_their_missing_properties_are_listed() {
    for (name, text, missing) in FILES {
        let checked = check_and_list(name, without_mark(text), &Limits::default());
        let (tableau, not_stated) = checked.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(not_stated, missing, "{name}");
        let stem = name.split('.').next();
        assert_eq!(tableau.name(), stem, "{name}");
    }
}

#[test]
fn an_older_file_with_a_wrong_entry_is_refused_at_this_entry() {
    let edits = [
        ("lobatto-3.toml", "0.6666", "0.6667", "(decimal)"),
        (
            "gauss-2.toml",
            "holds = true",
            "holds = false",
            "symplectic (holds)",
        ),
        ("gauss-2.toml", "node algebra", "enclosure", "tier"),
        (
            "forest-ruth-1990.toml",
            "nystrom = { order = 4",
            "nystrom = { order = 5",
            "order.nystrom.order",
        ),
        (
            "gauss-1.json",
            "\"p_stable\": true",
            "\"p_stable\": false",
            "stability.p_stable",
        ),
        // Evidence that is stronger than that of the derivation.
        (
            "blanes-moan-2002-s6.toml",
            "consistent         = { holds = true, evidence = \"verified\"",
            "consistent         = { holds = true, evidence = \"proved\"",
            "consistent (evidence)",
        ),
        // A list is stated as a whole.
        (
            "gauss-1.toml",
            "intervals = [[\"0\", \"infinity\"]]",
            "intervals = [[\"0\"]]",
            "stability.intervals[0][1]",
        ),
        (
            "gauss-1.json",
            "\"symplecticity_order\": null",
            "\"symplecticity_order\": 2",
            "symplecticity_order",
        ),
    ];
    for (name, from, to, place) in edits {
        let (_, text, _) = FILES
            .into_iter()
            .find(|(known, ..)| *known == name)
            .expect(name);
        assert!(text.contains(from), "{name}: {from}");
        let edited = without_mark(text).replacen(from, to, 1);
        let error = check(name, &edited, &Limits::default()).expect_err(to);
        let shown = error.to_string();
        assert!(
            shown.contains("does not fit") && shown.contains(place),
            "{name}: {shown}"
        );
    }
}

/// Only compositions and adjoints may have become one since: other methods have always qualified by their coefficients.
#[test]
fn an_older_file_that_denies_a_property_of_the_coefficients_is_refused() {
    const LAST: &str = "positive_weights   = { holds = true, evidence = \"proved\" }";
    const LAST_OF_JSON: &str = "\"positive_weights\": {\"holds\": true, \"evidence\": \"proved\", \"bits\": null, \"witness\": null}";
    let json = LAST_OF_JSON.replace("positive_weights", "nonholonomic");
    let json = format!("{LAST_OF_JSON},\n{}", json.replace("true", "false"));
    let refuted = "{ holds = false, evidence = \"refuted\" }";
    for (name, property, last, edited) in [
        (
            "lobatto-3.toml",
            "constrained",
            LAST,
            format!("{LAST}\nconstrained = {refuted}"),
        ),
        (
            "gauss-1.toml",
            "nonholonomic",
            LAST,
            format!("{LAST}\nnonholonomic = {refuted}"),
        ),
        ("gauss-1.json", "nonholonomic", LAST_OF_JSON, json),
    ] {
        let (_, text, _) = FILES
            .into_iter()
            .find(|(known, ..)| *known == name)
            .expect(name);
        assert!(text.contains(last), "{name}");
        let edited = without_mark(text).replacen(last, &edited, 1);
        let error = check(name, &edited, &Limits::default()).expect_err(name);
        let wanted = format!("`{property} (holds)` does not fit");
        assert!(error.to_string().contains(&wanted), "{name}: {error}");
    }
}

#[test]
fn a_file_of_the_current_format_states_everything() {
    let gauss = derive("polynomial(2)", "gauss(2)").expect("Gauss");
    let (toml, json) = (
        export::toml::write(&gauss, 10),
        export::json::write(&gauss, 10),
    );
    let from = |text: &str, key: &str| {
        let lines = text
            .lines()
            .filter(|line| !line.trim_start().starts_with(key));
        lines.collect::<Vec<_>>().join("\n")
    };
    let cases = [
        (
            "t.toml",
            from(&toml, "constrained"),
            "the property `constrained` is missing",
        ),
        (
            "t.json",
            from(&json, "\"constrained\""),
            "missing field `constrained`",
        ),
        (
            "t.toml",
            toml[..toml.find("[stability]").expect("a section")].to_owned(),
            "missing field `stability`",
        ),
        (
            "t.json",
            from(&json, "\"symplecticity_order\"").replace("  },\n}", "  }\n}"),
            "missing field `symplecticity_order`",
        ),
    ];
    for (name, text, message) in cases {
        let error = check(name, &text, &Limits::default()).expect_err(message);
        assert!(error.to_string().contains(message), "{name}: {error}");
    }
}

#[test]
fn a_file_of_a_later_format_is_refused_by_its_number() {
    let gauss = derive("polynomial(2)", "gauss(2)").expect("Gauss");
    let (toml, json) = (
        export::toml::write(&gauss, 10),
        export::json::write(&gauss, 10),
    );
    let later = "format 3 belongs to a later version of `symplectic`: this version reads the formats 1 to 2";
    let none = "`format` is a whole number from 1 to 2";
    for (number, message) in [
        ("3", later),
        ("0", none),
        ("-1", none),
        ("\"2\"", none),
        (
            "\"symplectic certificate\"",
            "this is a certificate, not a tableau: check it with",
        ),
        ("2.5", none),
    ] {
        // Keys that only the later version knows do not hide the reason.
        let toml = toml.replace(
            "format = 2",
            &format!("format = {number}\nbeauty = \"great\""),
        );
        let json = json.replace(
            "\"format\": 2,",
            &format!("\"format\": {number}, \"beauty\": \"great\","),
        );
        for (name, text) in [("t.toml", toml), ("t.json", json)] {
            let error = check(name, &text, &Limits::default()).expect_err(number);
            assert!(error.to_string().contains(message), "{name}: {error}");
            assert!(error.place.is_some(), "{error}");
        }
    }
    // The definition alone has no format, or the current one.
    let alone = "format = 2\n[provenance]\nbasis = \"1\"\nnodes = \"1/2\"\n";
    assert!(check("t.toml", alone, &Limits::default()).is_ok());
}

/// Fewer digits are printed than determine the method: an earlier version took another one.
#[test]
fn an_older_file_of_another_certified_method_says_who_wrote_it_and_what_to_do() {
    let text = include_str!("older/mclachlan-atela-1992-order-5-optimal-certified.toml");
    let error = |text: &str| {
        let checked = check("file.toml", text, &Limits::default());
        checked.expect_err("other coefficients").to_string()
    };
    let shown = error(text);
    assert!(shown.contains("`c_2 (decimal)` does not fit"), "{shown}");
    let advice = "an earlier version of `symplectic` wrote this file, and may have taken another exact method with the same printed digits: \
                  export the method again, with `symplectic derive` or `symplectic show`";
    assert!(shown.ends_with(advice), "{shown}");
    // This version cannot have written it.
    let current = error(&format!("format = 2\n{text}"));
    assert!(!current.contains("earlier"), "{current}");
}
