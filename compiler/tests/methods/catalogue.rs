//! The files of `tableaux/` and the certificates in it are what the tool writes now, no more and no fewer, and they check.

use std::collections::BTreeSet;
use std::path::PathBuf;

use symplectic_compiler::export::{DEFAULT_DIGITS, certificate, toml};
use symplectic_compiler::{Tableau, catalogue, check};

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tableaux")
}

fn derived(name: &str) -> Tableau {
    let entry = catalogue::find(name).expect(name);
    entry.derive().expect(name)
}

/// The files of some entries that are not what the tool writes, and the names of all files of these entries.
fn stale(entries: impl Iterator<Item = catalogue::Entry>) -> (Vec<String>, BTreeSet<String>) {
    let update = std::env::var_os("UPDATE_EXPECT").is_some_and(|value| value == "1");
    let mut wrong = Vec::new();
    let mut known = BTreeSet::new();
    for entry in entries {
        let name = format!("{}.toml", entry.name);
        let tableau = entry.derive().expect(&name);
        assert_eq!(tableau.stages(), entry.stages, "{name}");
        let text = toml::write(&tableau, DEFAULT_DIGITS);
        let mut written = vec![(name.clone(), text.clone())];
        if let Ok(text) = certificate::write(&tableau) {
            written.push((format!("certificates/{}.json", entry.name), text));
        }
        for (name, text) in written {
            let path = folder().join(&name);
            if update {
                std::fs::write(&path, &text).expect("a folder that can be written to");
            }
            match std::fs::read_to_string(&path) {
                Ok(found) if found == text => {}
                Ok(_) => wrong.push(format!("{name} is stale")),
                Err(error) => wrong.push(format!("{name}: {error}")),
            }
            known.insert(name);
        }
        // Both ways to read it give the tableau back, one of them from basis and nodes only.
        assert_eq!(
            toml::read(&name, &text, &entry.limits()),
            Ok(tableau.clone())
        );
        assert_eq!(check(&name, &text, &entry.limits()), Ok(tableau));
    }
    (wrong, known)
}

#[test]
fn files_of_methods_with_two_stages_are_those_that_the_tool_writes() {
    let (wrong, known) = stale(catalogue::entries().filter(|entry| entry.stages == 2));
    assert!(known.len() > 20, "{known:?}");
    assert_eq!(wrong, Vec::<String>::new());
}

#[test]
#[ignore = "thorough"]
fn the_files_are_those_that_the_tool_writes() {
    let (mut wrong, known) = stale(catalogue::entries());
    for (subfolder, extension) in [("", ".toml"), ("certificates/", ".json")] {
        for file in std::fs::read_dir(folder().join(subfolder)).expect("the folder") {
            let file = file.expect("a file").file_name();
            let name = format!("{subfolder}{}", file.to_string_lossy());
            if name.ends_with(extension) && !known.contains(&name) {
                wrong.push(format!("{name} is not in the catalogue"));
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "{wrong:#?}\nUPDATE_EXPECT=1 writes the files anew"
    );
}

#[test]
#[ignore = "thorough"]
fn methods_coincide_where_it_is_said_and_nowhere_else() {
    let all: Vec<_> = catalogue::entries()
        .map(|entry| (entry.derive().expect("derived"), entry))
        .collect();
    for (one, entry) in &all {
        for (other, second) in all.iter().filter(|(_, second)| second.name != entry.name) {
            let equal = one.has_coefficients_of(other);
            let said = entry.same_as().contains(&second.name.as_str());
            assert_eq!(equal, said, "{} and {}", entry.name, second.name);
            if said {
                assert!(entry.source.contains(&second.name), "{}", entry.source);
            }
        }
    }
}

#[test]
#[ignore = "thorough"]
fn every_method_is_symplectic_for_separable_systems_consistent_and_has_a_source() {
    for entry in catalogue::entries() {
        let tableau = entry.derive().expect("derived");
        let symplectic = tableau.separable_properties().symplectic;
        assert!(
            symplectic.holds && tableau.properties().consistent.holds,
            "{}",
            entry.name
        );
        assert!(
            !entry.source.is_empty() && !entry.title.is_empty(),
            "{}",
            entry.name
        );
    }
}

#[test]
fn the_titles_of_the_radau_methods_are_true() {
    let entries = |table: Vec<Vec<Option<String>>>| {
        let shown = |row: Vec<Option<String>>| row.into_iter().flatten().collect::<Vec<_>>();
        table.into_iter().map(shown).collect::<Vec<_>>()
    };
    // Hairer & Wanner, Solving Ordinary Differential Equations II, tables IV.5.4 and IV.5.5.
    let left = derived("radau-left-2").exact_forms();
    assert_eq!(
        entries(left.a_tilde),
        [["1/4", "-1/4"], ["1/4", "5/12"]],
        "Radau IA"
    );
    let right = derived("radau-right-2").exact_forms();
    assert_eq!(
        entries(right.a),
        [["5/12", "-1/12"], ["3/4", "1/4"]],
        "Radau IIA"
    );
    // The partner of Radau IIA has the right nodes and is not Radau IA.
    assert_eq!(entries(right.a_tilde), [["1/3", "0"], ["1", "0"]]);
}

#[test]
fn symplectic_euler_and_its_adjoint_are_adjoint() {
    let adjoint = derived("symplectic-euler").adjoint();
    let forms = |tableau: &Tableau| {
        let forms = tableau.exact_forms();
        (forms.a, forms.a_tilde, forms.b)
    };
    assert_eq!(forms(&adjoint), forms(&derived("symplectic-euler-adjoint")));
    assert_ne!(forms(&derived("midpoint")), forms(&adjoint));
}
