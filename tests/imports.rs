//! The imports inside a package, for the tests that they run downward: `compiler/tests/rooms.rs` and `runtime/core/tests/rooms.rs`.

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms of a package from the lowest to the highest. Those on one line do not import each other.
pub struct Rooms {
    pub levels: &'static [&'static [&'static str]],
    /// Whether a file may import a room that is not below it.
    pub may: fn(file: &str, import: &str) -> bool,
    /// Whether a file has nothing but tests, which import what they like.
    pub is_of_tests: fn(file: &str) -> bool,
}

impl Rooms {
    fn level(&self, room: &str) -> Option<usize> {
        self.levels.iter().position(|rooms| rooms.contains(&room))
    }

    /// What is wrong with the imports of a file.
    pub fn faults(&self, file: &str, text: &str) -> Vec<String> {
        let room = file.split(['/', '.']).next().unwrap_or(file);
        let own = self.level(room);
        let own = own.unwrap_or_else(|| panic!("{file} is in no room"));
        let wrong = |import: &String| match self.level(import) {
            None => true,
            Some(level) => import != room && level >= own && !(self.may)(file, import),
        };
        let mut all = imports(text);
        all.extend(through_super(file, text));
        let wrong = all.into_iter().filter(wrong);
        wrong
            .map(|import| format!("{file} imports crate::{import}"))
            .collect()
    }

    /// What is wrong in all files of a source folder, and the number of its imports.
    pub fn faults_in(&self, source: &Path) -> (Vec<String>, usize) {
        let mut all = Vec::new();
        files(source, &mut all);
        let (mut found, mut seen) = (Vec::new(), 0);
        for path in all {
            let file = path.strip_prefix(source).expect("below the source");
            let file = file.to_string_lossy().replace('\\', "/");
            if file == "lib.rs" || (self.is_of_tests)(&file) {
                continue;
            }
            let text = fs::read_to_string(&path).expect("text");
            seen += imports(&text).len();
            found.extend(self.faults(&file, &text));
        }
        (found, seen)
    }
}

/// The Rust files in a folder, and in the folders in it.
pub fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
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
