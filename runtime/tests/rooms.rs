//! The rooms of the runtime: imports run downward, and nothing is imported through the root.

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms from the lowest to the highest. Those on one line do not import each other.
const ROOMS: &[&[&str]] = &[
    &["error"],
    &["number"],
    &["state"],
    &["system"],
    &["method"],
    &["solver"],
    &["integrator"],
    &["output", "rotation", "tangent", "variational"],
    &["adaptive", "flow"],
    &["ensemble"],
    &["files"],
];

/// The imports that run up. A system chooses how it is stepped: its class the plan of a method, and its type the solver.
const UPWARD: &[(&str, &str)] = &[
    ("system/class.rs", "method"),
    ("system/over_vectors.rs", "method"),
    ("system/over_vectors.rs", "solver"),
    ("system/closures.rs", "solver"),
    ("system/chain/mod.rs", "solver"),
    // The system without its friction is a system.
    ("method/damped.rs", "solver"),
    // With its rows for gradients it is one too.
    ("method/nonholonomic/rows.rs", "solver"),
    // With its dimensions checked it is one, too.
    ("method/constrained/of_dimension.rs", "solver"),
];

fn level(room: &str) -> Option<usize> {
    ROOMS.iter().position(|rooms| rooms.contains(&room))
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// The first names after `crate::` in code, not in comments. After `$crate::` an exported macro names what it needs in another crate.
fn imports(text: &str) -> Vec<&str> {
    let code = text
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    code.flat_map(|line| line.match_indices("crate::").map(move |(at, _)| (line, at)))
        .filter(|(line, at)| !line[..*at].ends_with('$'))
        .map(|(line, at)| {
            let rest = &line[at + "crate::".len()..];
            let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_'));
            &rest[..end.unwrap_or(rest.len())]
        })
        .collect()
}

/// What is wrong with the imports of a file in a room.
fn faults(file: &str, text: &str) -> Vec<String> {
    let room = file.split(['/', '.']).next().unwrap_or(file);
    let own = level(room).unwrap_or_else(|| panic!("{file} is in no room"));
    let wrong = |import: &&str| match level(import) {
        None => true,
        Some(level) => *import != room && level >= own && !UPWARD.contains(&(file, import)),
    };
    let wrong = imports(text).into_iter().filter(wrong);
    wrong
        .map(|import| format!("{file} imports crate::{import}"))
        .collect()
}

#[test]
fn imports_run_downward() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut all = Vec::new();
    files(&source, &mut all);
    let mut found = Vec::new();
    let mut seen = 0;
    for path in all {
        let file = path.strip_prefix(&source).expect("below the source");
        let file = file.to_string_lossy().replace('\\', "/");
        if file == "lib.rs" {
            continue;
        }
        let text = fs::read_to_string(&path).expect("text");
        seen += imports(&text).len();
        found.extend(faults(&file, &text));
    }
    assert_eq!(found, Vec::<String>::new());
    assert!(seen > 300, "{seen}");
}

#[test]
fn an_import_that_runs_up_is_found() {
    let up = "use crate::solver::FixedPoint;\n";
    assert_eq!(faults("method/step.rs", up).len(), 1);
    assert_eq!(faults("integrator/mod.rs", up).len(), 0);
    assert_eq!(
        faults("output/dense.rs", "use crate::variational::x;").len(),
        1
    );
    assert_eq!(
        faults("number/scalar.rs", "    crate::Vector::new()").len(),
        1
    );
    assert_eq!(
        faults("number/scalar.rs", "/// [`x`](crate::solver::x)\n").len(),
        0
    );
}

/// One style of module files: a module with parts is `folder/mod.rs`, not `folder.rs` beside `folder/`.
#[test]
fn a_module_with_parts_is_a_folder() {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
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
