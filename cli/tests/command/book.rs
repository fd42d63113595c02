//! The book: its catalogue is the output of `symplectic list --facts`, and its links lead somewhere.

use std::fs;
use std::path::{Path, PathBuf};

use crate::run::stdout;

#[test]
fn the_catalogue_of_the_book_is_what_the_tool_lists() {
    let page = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/src/reference/catalogue.md");
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
    let book = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src");
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
