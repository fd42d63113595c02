//! The rooms of the core: imports run downward, and nothing is imported through the root.

#[path = "../../../tests/imports.rs"]
mod imports;

use std::path::{Path, PathBuf};

use imports::{Rooms, files};

/// The rooms from the lowest to the highest. Those on one line do not import each other.
const LEVELS: &[&[&str]] = &[
    &["error"],
    &["number"],
    &["state"],
    &["contract"],
    &["method"],
    &["solver"],
    &["system"],
    &["integrator"],
    &["output"],
    &["inside"],
];

const ROOMS: Rooms = Rooms {
    levels: LEVELS,
    may: |_, _| false,
    is_of_tests: |_| false,
};

#[test]
fn imports_run_downward() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (found, seen) = ROOMS.faults_in(&source);
    assert_eq!(found, Vec::<String>::new());
    assert!(seen > 300, "{seen}");
}

#[test]
fn an_import_that_runs_up_is_found() {
    let up = "use crate::solver::FixedPoint;\n";
    assert_eq!(ROOMS.faults("method/step.rs", up).len(), 1);
    assert_eq!(ROOMS.faults("integrator/mod.rs", up).len(), 0);
    assert_eq!(
        ROOMS
            .faults("output/dense.rs", "use crate::inside::x;")
            .len(),
        1
    );
    assert_eq!(
        ROOMS
            .faults("number/scalar.rs", "    crate::Vector::new()")
            .len(),
        1
    );
    assert_eq!(
        ROOMS
            .faults("number/scalar.rs", "/// [`x`](crate::solver::x)\n")
            .len(),
        0
    );
}

/// One style of module files: a module with parts is `folder/mod.rs`, not `folder.rs` beside `folder/`.
#[test]
fn a_module_with_parts_is_a_folder() {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut all = Vec::new();
    for package in ["compiler", "macros", "runtime", "tests"] {
        files(&workspace.join(package), &mut all);
    }
    assert!(all.len() > 500, "{}", all.len());
    let built = |path: &PathBuf| path.components().any(|part| part.as_os_str() == "target");
    let beside = |path: &PathBuf| !built(path) && path.with_extension("").is_dir();
    let found: Vec<_> = all.into_iter().filter(beside).collect();
    assert_eq!(found, Vec::<PathBuf>::new());
}
