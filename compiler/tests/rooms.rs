//! The rooms of the compiler: imports run downward, and nothing is imported through the root.

#[path = "../../tests/imports.rs"]
mod imports;

use std::path::Path;

use imports::Rooms;

/// The rooms from the lowest to the highest. Those on one line do not import each other, except for [`TOGETHER`].
const LEVELS: &[&[&str]] = &[
    // The package `symplectic-exact`.
    &["arithmetic", "error", "suggestion"],
    &["evidence", "hamiltonian_class", "limits"],
    &["certify"],
    &["expression"],
    &["symbolic", "algebra"],
    &["catalogue", "coefficients", "definition", "library"],
    &["numerals", "partitioned", "quadrature"],
    &["basis", "exact"],
    &["schedule", "stability"],
    &["properties"],
    &["order"],
    &["derive", "fitted"],
    &["tableau"],
    &["efficiency", "operations", "requirement"],
    &["export"],
    &["check", "emit"],
    // What the package `symplectic-tools` needs.
    &["inside"],
];

/// A number field decides whether a constant is zero, and its numbers are constants.
const TOGETHER: [&str; 2] = ["symbolic", "algebra"];

const ROOMS: Rooms = Rooms {
    levels: LEVELS,
    may: |file, import| {
        let room = file.split(['/', '.']).next().unwrap_or(file);
        [room, import].iter().all(|name| TOGETHER.contains(name))
    },
    is_of_tests: |file| {
        let tests = |part: &str| matches!(part, "tests" | "tests.rs");
        file.split('/').any(tests) || file == "decisions.rs"
    },
};

#[test]
fn imports_run_downward() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (found, seen) = ROOMS.faults_in(&source);
    assert_eq!(found, Vec::<String>::new());
    assert!(seen > 600, "{seen}");
}

#[test]
fn an_import_that_runs_up_is_found() {
    let count = |file: &str, text: &str| ROOMS.faults(file, text).len();
    assert_eq!(count("order/tree.rs", "use crate::tableau::Tableau;\n"), 1);
    assert_eq!(count("emit/mod.rs", "use crate::tableau::Tableau;\n"), 0);
    // Beside it, and through the root.
    assert_eq!(count("stability/mod.rs", "use crate::schedule::Class;"), 1);
    assert_eq!(count("order/mod.rs", "    crate::Limits::default()"), 1);
    let list = "use crate::{\n    Definition,\n    error::{Error, ErrorKind},\n    tableau,\n};";
    assert_eq!(count("order/mod.rs", list), 2);
    // By way of the parents.
    assert_eq!(count("order/mod.rs", "use super::tableau::Tableau;"), 1);
    assert_eq!(count("order/tree.rs", "use super::tableau::Tableau;"), 0);
    let twice = "use super::super::tableau::Tableau;";
    assert_eq!(count("order/tree.rs", twice), 1);
    assert_eq!(count("basis.rs", "use super::emit;"), 1);
    // The one pair that needs each other.
    assert_eq!(count("symbolic/zero.rs", "use crate::algebra::Field;"), 0);
    assert_eq!(
        count("algebra/real.rs", "use crate::symbolic::Constant;"),
        0
    );
    let test = "fn f() {}\n\n#[cfg(test)]\nmod tests {\n    use crate::catalogue;\n}\n";
    assert_eq!(count("order/mod.rs", test), 0);
    assert_eq!(count("order/mod.rs", "/// [`x`](crate::emit::x)\n"), 0);
}
