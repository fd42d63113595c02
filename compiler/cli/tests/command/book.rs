//! The book: its catalogue is the output of `symplectic list --facts`, its language of formulas that of the macro, and its links lead
//! somewhere.

use std::fs;
use std::path::{Path, PathBuf};

use crate::run::stdout;

#[test]
#[ignore = "thorough"]
fn the_catalogue_of_the_book_is_what_the_tool_lists() {
    let page =
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/reference/catalogue.md");
    let text = fs::read_to_string(&page).expect("the page");
    let start = text.find("| method |").expect("a table");
    let listed = stdout(&["list", "--facts"]);
    if std::env::var_os("UPDATE_EXPECT").is_some_and(|value| value == "1") {
        fs::write(&page, format!("{}{listed}", &text[..start]))
            .expect("a page that can be written");
        return;
    }
    assert!(
        text[start..] == listed,
        "the table is stale: write it anew with `UPDATE_EXPECT=1`"
    );
}

/// The sections of the documentation of `hamiltonian!` that describe its language, as a page of the book: without links into the library.
fn language() -> String {
    let source = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../runtime/core/src/system/hamiltonian_macro.rs");
    let text = fs::read_to_string(source).expect("the documentation of the macro");
    let lines = text.lines().filter_map(|line| line.strip_prefix("///"));
    let lines = lines.map(|line| line.strip_prefix(' ').unwrap_or(line));
    let mut page = String::from(
        "# The language of formulas\n\nFor `hamiltonian!`, `lagrangian!` and the files of [`symplectic run`](../guide/run.md). A first example is in \
         [Formulas](../guide/formulas.md).\n\n",
    );
    let mut in_code = false;
    for line in lines.skip_while(|line| *line != "# Coordinates") {
        let fence = line.strip_prefix("```");
        let line = match fence {
            Some("") if !in_code => "```rust".to_owned(),
            Some(kind) if !in_code => format!("```rust,{kind}"),
            None if !in_code && line.starts_with('#') => format!("#{line}"),
            _ => line.to_owned(),
        };
        in_code ^= fence.is_some();
        page.push_str(&if in_code { line } else { without_links(&line) });
        page.push('\n');
    }
    page
}

/// The text of a line whose links into the library are only their words.
fn without_links(line: &str) -> String {
    let mut parts = line.split("](crate::");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        if let Some(start) = text.rfind('[') {
            text.remove(start);
        }
        text.push_str(part.split_once(')').map_or(part, |(_, rest)| rest));
    }
    text
}

#[test]
fn the_language_of_the_book_is_that_of_the_macro() {
    let page =
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/reference/formulas.md");
    let expected = language();
    assert!(expected.contains("atan2") && !expected.contains("crate::"));
    if std::env::var_os("UPDATE_EXPECT").is_some_and(|value| value == "1") {
        fs::write(&page, expected).expect("a page that can be written");
        return;
    }
    assert!(
        fs::read_to_string(&page).expect("the page") == expected,
        "the page is stale: write it anew with `UPDATE_EXPECT=1`"
    );
}

/// The pages in a folder, and in the folders in it.
fn pages(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            pages(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            found.push(path);
        }
    }
}

/// The text of a page without its blocks of code.
fn prose(page: &Path) -> String {
    let text = fs::read_to_string(page).expect("a page");
    let blocks = text.split("```").step_by(2);
    blocks.collect()
}

/// The targets of the links in a text, not in the code of its lines.
fn links(text: &str) -> Vec<String> {
    let plain: String = text.split('`').step_by(2).collect();
    let ends = plain.split("](").skip(1);
    ends.filter_map(|rest| rest.split(')').next())
        .filter(|target| !target.contains("://"))
        .map(str::to_owned)
        .collect()
}

/// A heading as an address: mdBook's rule.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter_map(|c| match c {
        c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
        c if c.is_whitespace() => Some('-'),
        _ => None,
    });
    kept.collect::<String>().to_lowercase()
}

#[test]
fn every_link_of_the_book_leads_somewhere() {
    let book = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src");
    let mut all = vec![book.join("../../README.md")];
    pages(&book, &mut all);
    let summary = prose(&book.join("SUMMARY.md"));
    let listed = links(&summary);
    let mut wrong = Vec::new();
    let mut seen = 0;
    for page in &all {
        let name = page
            .strip_prefix(&book)
            .unwrap_or(page)
            .display()
            .to_string();
        let is_a_chapter = !name.ends_with("README.md") && name != "SUMMARY.md";
        if is_a_chapter && !listed.contains(&name) {
            wrong.push(format!("{name} is not in SUMMARY.md"));
        }
        for link in links(&prose(page)) {
            seen += 1;
            let (file, heading) = link.split_once('#').unwrap_or((&link, ""));
            let target = match file {
                "" => page.clone(),
                file => page.parent().expect("a folder").join(file),
            };
            let is_page = target
                .extension()
                .is_some_and(|extension| extension == "md");
            let has_heading = || {
                let text = prose(&target);
                let mut headings = text.lines().filter(|line| line.starts_with('#'));
                headings.any(|line| anchor(line.trim_start_matches('#').trim()) == heading)
            };
            if !target.exists() || is_page && !heading.is_empty() && !has_heading() {
                wrong.push(format!("{name}: {link}"));
            }
        }
    }
    assert!(seen > 100, "{seen} links only");
    assert_eq!(wrong, Vec::<String>::new());
}

#[test]
fn the_book_shows_every_feature_of_the_runtime() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let read = |name: &str| fs::read_to_string(root.join(name)).expect("a file");
    let manifest: toml::Table = read("runtime/Cargo.toml").parse().expect("a manifest");
    let features = manifest["features"].as_table().expect("features").keys();
    let mut features: Vec<&String> = features.filter(|name| *name != "default").collect();
    let page = read("docs/src/index.md");
    let start = page.find("## Features\n").expect("a heading");
    let section = page[start..].split("\n## ").next().expect("a section");
    assert!(section.contains("\nsymplectic = { path = \"symplectic/runtime\", features = ["));
    let rows = section.lines().filter_map(|line| line.strip_prefix("| `"));
    let mut rows: Vec<&str> = rows.filter_map(|row| row.split('`').next()).collect();
    features.sort_unstable();
    rows.sort_unstable();
    assert_eq!(rows, features);
}
