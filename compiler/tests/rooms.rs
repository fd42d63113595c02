//! The rooms of the compiler: imports run downward, and nothing is imported through the root.

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms from the lowest to the highest. Those on one line do not import each other, except for [`TOGETHER`].
const ROOMS: &[&[&str]] = &[
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
    &["derive"],
    &["tableau"],
    &["efficiency", "operations", "requirement"],
    &["export"],
    &["check", "emit"],
    // What the package `symplectic-tools` needs.
    &["inside"],
];

/// A number field decides whether a constant is zero, and its numbers are constants.
const TOGETHER: [&str; 2] = ["symbolic", "algebra"];

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

/// Whether a file has nothing but tests, which import what they like.
fn is_of_tests(file: &str) -> bool {
    let tests = |part: &str| matches!(part, "tests" | "tests.rs");
    file.split('/').any(tests) || file == "decisions.rs"
}

/// The first names of paths from the root in code, without comments and tests. After `$crate::` an exported macro names what it
/// needs in another crate.
fn imports(text: &str) -> Vec<String> {
    let code = text
        .split("#[cfg(test)]\nmod tests {")
        .next()
        .unwrap_or(text);
    let code = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let code = code.collect::<Vec<_>>().join("\n");
    let mut found = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        if code[..at].ends_with('$') {
            continue;
        }
        let rest = &code[at + "crate::".len()..];
        match rest.strip_prefix('{') {
            Some(list) => found.extend(of_list(list)),
            None => found.push(name(rest)),
        }
    }
    found
}

/// The name at the start of a text.
fn name(text: &str) -> String {
    let text = text.trim_start();
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_'));
    text[..end.unwrap_or(text.len())].to_owned()
}

/// The names of a list of imports, the text after its opening brace.
fn of_list(list: &str) -> Vec<String> {
    let (mut depth, mut found, mut start) = (0, Vec::new(), 0);
    for (at, c) in list.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                found.push(name(&list[start..]));
                start = at + 1;
                if c == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    found.retain(|name| !name.is_empty());
    found
}

/// The names after as many `super::` as lead from a file to the root.
fn through_super(file: &str, text: &str) -> Vec<String> {
    let depth = file.trim_end_matches("/mod.rs").split('/').count();
    let path = "super::".repeat(depth);
    let code = text.split("#[cfg(test)]\nmod tests {").next();
    let code = code.unwrap_or(text).lines();
    let code = code.filter(|line| !line.trim_start().starts_with("//"));
    let starts = code.flat_map(|line| line.match_indices(&path).map(move |(at, _)| &line[at..]));
    let names = starts.map(|rest| rest[path.len()..].trim_start_matches('{'));
    let names = names.filter(|rest| !rest.starts_with("super::"));
    names.map(name).collect()
}

/// What is wrong with the imports of a file in a room.
fn faults(file: &str, text: &str) -> Vec<String> {
    let room = file.split(['/', '.']).next().unwrap_or(file);
    let own = level(room).unwrap_or_else(|| panic!("{file} is in no room"));
    let together = |import: &str| [room, import].iter().all(|name| TOGETHER.contains(name));
    let wrong = |import: &String| match level(import) {
        None => true,
        Some(level) => import != room && level >= own && !together(import),
    };
    let mut all = imports(text);
    all.extend(through_super(file, text));
    let wrong = all.into_iter().filter(wrong);
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
        if file == "lib.rs" || is_of_tests(&file) {
            continue;
        }
        let text = fs::read_to_string(&path).expect("text");
        seen += imports(&text).len();
        found.extend(faults(&file, &text));
    }
    assert_eq!(found, Vec::<String>::new());
    assert!(seen > 600, "{seen}");
}

#[test]
fn an_import_that_runs_up_is_found() {
    let count = |file: &str, text: &str| faults(file, text).len();
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
