//! What is written reads back to the same, for any method.

use proptest::prelude::*;
use symplectic_compiler::export::{json, text, toml};
use symplectic_compiler::{Limits, Tableau, check, derive};

/// Methods at rational nodes and at those of rules, with changed bases; those that exist.
fn methods() -> impl Strategy<Value = Tableau> {
    let lists = prop::collection::btree_set(0i64..13, 1..5).prop_map(|nodes| {
        let text: Vec<String> = nodes.iter().map(|n| format!("{n}/12")).collect();
        (nodes.len(), text.join(", "))
    });
    let names = [
        "gauss",
        "lobatto",
        "radau-left",
        "radau-right",
        "chebyshev",
        "clenshaw-curtis",
        "fejer",
    ];
    let rules = (prop::sample::select(names.to_vec()), 2usize..6)
        .prop_map(|(name, stages)| (stages, format!("{name}({stages})")));
    let functions = prop::collection::vec(-3i64..4, 16);
    (prop_oneof![lists, rules], functions, any::<bool>()).prop_filter_map(
        "no such method",
        |((stages, nodes), coefficients, monomials)| {
            let function = |row: &[i64]| {
                let terms: Vec<String> = row
                    .iter()
                    .enumerate()
                    .map(|(k, c)| format!("{c}/2*t^{k}"))
                    .collect();
                terms.join(" + ")
            };
            let list: Vec<String> = coefficients.chunks(4).take(stages).map(function).collect();
            let basis = if monomials || stages > 4 {
                format!("polynomial({stages})")
            } else {
                list.join(", ")
            };
            derive(&basis, &nodes).ok()
        },
    )
}

fn escaped(json: &str) -> String {
    let mut units = [0; 2];
    let escape = |c: char| match c.is_ascii() {
        true => c.to_string(),
        false => c
            .encode_utf16(&mut units)
            .iter()
            .map(|unit| format!("\\u{unit:04x}"))
            .collect(),
    };
    json.chars().map(escape).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    #[ignore = "thorough"]
    fn toml_and_json_give_the_tableau_back(tableau in methods(), digits in 1usize..60, named in any::<bool>()) {
        let tableau = if named {
            tableau.named("a \"name\"\n\\ with ã, \u{7f} and \t").with_source("'''\"\"\"")
        } else {
            tableau
        };
        let limits = Limits::default();
        let written = toml::write(&tableau, digits);
        let read = toml::read("t.toml", &written, &limits);
        prop_assert_eq!(read.as_ref(), Ok(&tableau));
        prop_assert_eq!(toml::write(&tableau, digits), written.clone());
        prop_assert_eq!(check("t.toml", &written, &limits), Ok(tableau.clone()));

        let written = json::write(&tableau, digits);
        prop_assert_eq!(json::read("t.json", &written, &limits), Ok(tableau.clone()));
        prop_assert_eq!(check("t.JSON", &written, &limits), Ok(tableau.clone()));
        // Other programs write what is not ASCII as escapes.
        prop_assert_eq!(check("t.json", &escaped(&written), &limits), Ok(tableau.clone()));
        let value: serde_json::Value = serde_json::from_str(&written).expect("JSON");
        prop_assert_eq!(value["stages"].as_u64(), Some(tableau.stages() as u64));
        prop_assert!(text::write(&tableau, digits).contains("symplectic"));
    }

    #[test]
    fn methods_at_random_nodes_are_symplectic(tableau in methods()) {
        prop_assert!(tableau.properties().symplectic.holds);
    }

    #[test]
    #[ignore = "thorough"]
    fn the_adjoint_of_the_adjoint_is_the_method(tableau in methods()) {
        let adjoint = tableau.adjoint();
        prop_assert_eq!(adjoint.adjoint(), tableau.clone());
        // The adjoint of a symplectic method is symplectic, and has lossless exact data of its own.
        prop_assert!(adjoint.properties().symplectic.holds);
        let written = toml::write(&adjoint, 10);
        prop_assert_eq!(toml::read("t.toml", &written, &Limits::default()), Ok(adjoint.clone()));
        // Its definition says that it is the adjoint, and derives it again.
        prop_assert_eq!(check("t.toml", &written, &Limits::default()), Ok(adjoint));
    }

    /// Whatever is done to a file, it is refused or read, but nothing panics.
    #[test]
    fn damaged_files_are_refused_or_harmless(position in 0usize..2500, length in 0usize..40, filling in ".{0,3}") {
        let tableau = derive("polynomial(2)", "gauss(2)").expect("a method");
        for (name, written) in [("t.toml", toml::write(&tableau, 10)), ("t.json", json::write(&tableau, 10))] {
            let floor = |offset: usize| (0..=offset.min(written.len())).rev().find(|&o| written.is_char_boundary(o)).unwrap_or(0);
            let (start, end) = (floor(position), floor(position + length));
            let damaged = format!("{}{filling}{}", &written[..start], &written[end..]);
            if name.ends_with("toml") && let Err(error) = toml::read(name, &damaged, &Limits::default()) {
                prop_assert!(error.place.is_some());
            }
            match check(name, &damaged, &Limits::default()) {
                // White space, comments and the name are nobody's business.
                Ok(checked) => prop_assert!(checked.has_coefficients_of(&tableau)),
                Err(error) => {
                    let place = error.place.as_ref().expect("a place");
                    prop_assert!(place.span.start <= place.text.len());
                    prop_assert!(!error.to_string().is_empty());
                }
            }
        }
    }
}

#[test]
fn an_incomplete_provenance_is_refused_at_the_place() {
    for (text, place) in [
        ("[provenance]\nbasis = \"polynomial(2)\"\n", "[provenance]"),
        ("[provenance]\nnodes = \"gauss(2)\"\n", "[provenance]"),
        ("name = \"x\"\nprovenance = {}\n", "{}"),
        ("provenance.b = \"[1]\"", "provenance"),
    ] {
        let error = check("t.toml", text, &Limits::default()).expect_err("half a method");
        let found = error.place.expect("a place");
        assert_eq!(&found.text[found.span], place);
    }
}
