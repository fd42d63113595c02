//! The files of `tableaux/` and the certificates in it are what the tool writes now, no more and no fewer, and they check.

use std::collections::BTreeSet;
use std::path::PathBuf;

use symplectic_compiler::export::{DEFAULT_DIGITS, toml};
use symplectic_compiler::{catalogue, check};
use symplectic_tools::certificate;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tableaux")
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
