//! Theorems for Coq: their form, and what Coq says of them where it is installed.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use crate::run::{failure, stdout};
use expect_test::expect_file;

/// The files of `tableaux/coq`, each after those that it needs.
const LIBRARY: [&str; 5] = ["Definitions", "Orders", "Symplectic", "Tables", "Nodes"];
/// Every axiom that a theorem rested on would stand in its place.
const NO_AXIOM: &str = "Closed under the global context\n";

#[test]
fn coq_theorems_have_the_recorded_text() {
    for method in ["gauss-2", "symplectic-euler", "gauss-4", "position-verlet"] {
        let version = concat!("symplectic ", env!("CARGO_PKG_VERSION"));
        let text = theorem(method).replace(version, "symplectic VERSION");
        let file = format!("data/coq/{method}.v");
        expect_file![file].assert_eq(&text);
    }
}

/// 18 stages in a field of degree 15.
#[test]
fn an_order_that_takes_too_long_is_lowered() {
    let text = theorem("triple-jump-6");
    let claim = "has_order M general 4 (* of 6; higher orders take Coq too long *) /\\\n";
    assert!(text.contains(claim));
}

#[test]
fn coq_export_refuses_coefficients_that_are_not_exact() {
    for (method, reason) in [
        ("fourier-3", "contain pi, e or such"),
        ("blanes-moan-2002-s6", "known by enclosures, not exactly"),
    ] {
        let (status, message) = failure(&["show", method, "--format", "coq"]);
        assert_eq!(status, Some(2), "{method}");
        assert!(
            message.contains("no theorem of this method can be written for Coq")
                && message.contains(reason),
            "{message}"
        );
    }
}

/// Rational, quadratic and cubic entries, and entries in the nodes, up to order 8 for every Hamiltonian.
#[test]
fn coq_accepts_what_is_proved() {
    let Some(folder) = library() else {
        return;
    };
    for method in [
        "symplectic-euler",
        "lobatto-3",
        "gauss-2",
        "gauss-3",
        "gauss-4",
        "lobatto-4",
        "forest-ruth-1990",
        "saba-2",
        "mclachlan-1995-sb3a5",
    ] {
        let output = coqc(folder, &method.replace('-', "_"), &theorem(method));
        assert_eq!(output, Ok(NO_AXIOM.to_owned()), "{method}");
    }
}

/// What a theorem supposes of a number, sqrt 3 satisfies.
#[test]
fn a_theorem_speaks_of_real_numbers() {
    let Some(folder) = library() else {
        return;
    };
    let theorem = coqc(folder, "gauss_2_of_reals", &theorem("gauss-2"));
    assert_eq!(theorem, Ok(NO_AXIOM.to_owned()));
    let reals = include_str!("data/coq/reals.v").replace("gauss_2.", "gauss_2_of_reals.");
    assert_eq!(coqc(folder, "reals", &reals), Ok(String::new()));
}

/// `Fail` is an error where Coq accepts what follows.
#[test]
fn coq_refuses_every_changed_digit() {
    let Some(folder) = library() else {
        return;
    };
    // No weight is zero: every entry matters.
    for method in ["lobatto-3", "gauss-2", "gauss-3", "gauss-4"] {
        let text = theorem(method);
        let parts = Parts::of(&text);
        let mut twins = parts.head.to_owned();
        twins.push_str(&parts.module(0, parts.table, parts.statement, ""));
        let tables = changed(parts.table);
        for (at, table) in &tables {
            twins.push_str(&parts.module(*at, table, parts.statement, "Fail "));
        }
        assert!(tables.len() > 20, "{method}: {}", tables.len());
        let name = format!("{}_twins", method.replace('-', "_"));
        assert_eq!(coqc(folder, &name, &twins), Ok(String::new()), "{method}");
    }
}

/// Symmetry alone, of splittings: every digit counts except those of a row of no use, of a stage after the last flow.
#[test]
fn coq_refuses_changed_digits_of_symmetric_splittings() {
    let Some(folder) = library() else {
        return;
    };
    const SYMMETRIC: &str = "is_symmetric_for_separable M";
    // Of the last momentum there, no drift is made; of the last position, no kick.
    for (method, unused) in [
        ("forest-ruth-1990", Some("momentum")),
        ("saba-2", Some("position")),
        ("ruth-1983", None),
    ] {
        let text = theorem(method);
        let parts = Parts::of(&text);
        let Some(unused) = unused else {
            assert!(!text.contains(SYMMETRIC), "{method}");
            continue;
        };
        let (head, claims) = parts.statement.split_once("in\n  ").expect("claims");
        assert!(
            claims.ends_with(&format!(" /\\\n  {SYMMETRIC}")),
            "{method}"
        );
        let statement = format!("{head}in {SYMMETRIC}");
        let mut twins = parts.head.to_owned();
        twins.push_str(&parts.module(0, parts.table, &statement, ""));
        // Before the matrices is what x is, which has no part in symmetry.
        let (entries, row) = (
            parts.table.find("matrix").expect("matrices"),
            unused_row(parts.table, unused),
        );
        let mut tables = changed(parts.table);
        tables.retain(|(at, _)| *at > entries && !row.contains(at));
        for (at, table) in &tables {
            twins.push_str(&parts.module(*at, table, &statement, "Fail "));
        }
        assert!(tables.len() > 40, "{method}: {}", tables.len());
        let name = format!("{}_asymmetric", method.replace('-', "_"));
        assert_eq!(coqc(folder, &name, &twins), Ok(String::new()), "{method}");
    }
}

/// The last row of the matrix of a colour.
fn unused_row(table: &str, colour: &str) -> std::ops::Range<usize> {
    let start = table.find(&format!("| {colour} => ")).expect("a matrix");
    let end = start + table[start..].find("]]\n").expect("its end");
    let row = table[..end].rfind("[[").expect("its last row");
    row..end
}

/// The order of each class is what the compiler found, and no higher.
#[test]
fn coq_refuses_a_higher_order() {
    let Some(folder) = library() else {
        return;
    };
    for (method, order, higher) in [
        ("lobatto-4", "general 6", "general 7"),
        ("radau-left-2", "general 3", "general 4"),
        ("forest-ruth-1990", "general 1", "general 2"),
        ("forest-ruth-1990", "separable 4", "separable 5"),
        ("forest-ruth-1990", "separable 4", "nystrom 5"),
    ] {
        let text = theorem(method);
        let parts = Parts::of(&text);
        let statement = parts.statement.replace(order, higher);
        assert_ne!(statement, parts.statement, "{method}");
        let twin = parts.module(0, parts.table, &statement, "Fail ");
        let name = format!("{method}_{higher}").replace(['-', ' '], "_");
        let output = coqc(folder, &name, &format!("{}{twin}", parts.head));
        assert_eq!(output, Ok(String::new()), "{method}: {higher}");
    }
}

/// A file of a theorem in its parts.
struct Parts<'a> {
    /// What it imports.
    head: &'a str,
    table: &'a str,
    name: &'a str,
    statement: &'a str,
    tactic: &'a str,
}

impl<'a> Parts<'a> {
    fn of(text: &'a str) -> Self {
        let (head, rest) = text.split_once("Definition ").expect("a table");
        let (table, rest) = rest.split_once("Theorem ").expect("a theorem");
        let (name, rest) = rest.split_once(" : ").expect("a statement");
        let (statement, rest) = rest.split_once(".\nProof. ").expect("a proof");
        let (tactic, _) = rest.split_once(". Qed.").expect("its end");
        Parts {
            head,
            table,
            name,
            statement,
            tactic,
        }
    }

    /// The theorem with another table or statement, in a module of its own.
    fn module(&self, index: usize, table: &str, statement: &str, fail: &str) -> String {
        let Parts { name, tactic, .. } = self;
        format!(
            "Module Twin{index}.\nDefinition {table}{fail}Definition {name} : {statement} := ltac:({tactic}).\nEnd Twin{index}.\n"
        )
    }
}

/// A table with one digit changed, for each of its digits with its place; zero becomes one, and no denominator becomes zero.
fn changed(table: &str) -> Vec<(usize, String)> {
    let start = table.find(":=").expect("the entries");
    let digits = table.char_indices().skip_while(|(at, _)| *at < start);
    let digits = digits.filter_map(|(at, c)| Some((at, c.to_digit(10)?)));
    let twin = |(at, digit): (usize, u32)| {
        let other = if digit == 9 { 8 } else { digit + 1 };
        (at, format!("{}{other}{}", &table[..at], &table[at + 1..]))
    };
    digits.map(twin).collect()
}

fn theorem(method: &str) -> String {
    stdout(&["show", method, "--format", "coq"])
}

/// A folder with the library, compiled; `None` if there is no Coq here.
fn library() -> Option<&'static Path> {
    static FOLDER: OnceLock<Option<PathBuf>> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| {
        let version = Command::new("coqc").arg("--version").output();
        if !version.is_ok_and(|output| output.status.success()) {
            // Not captured: whoever reads the output of the tests shall see it.
            let _ = writeln!(std::io::stderr(), "skipped, as there is no coqc here");
            return None;
        }
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("coq");
        fs::create_dir_all(&folder).expect("a folder");
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tableaux/coq");
        for file in LIBRARY {
            let text = fs::read_to_string(source.join(file).with_extension("v")).expect("a file");
            // Nothing in it is taken for granted.
            assert!(
                !text.contains("Admitted") && !text.contains("Axiom"),
                "{file}"
            );
            assert_eq!(coqc(&folder, file, &text), Ok(String::new()));
        }
        Some(folder)
    });
    folder.as_deref()
}

/// What Coq prints of a file, or its message if it refuses it.
fn coqc(folder: &Path, name: &str, text: &str) -> Result<String, String> {
    fs::write(folder.join(name).with_extension("v"), text).expect("written");
    let output = Command::new("coqc")
        .args(["-R", ".", "SPRK", &format!("{name}.v")])
        .current_dir(folder)
        .output()
        .expect("Coq runs");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    if output.status.success() {
        Ok(text(output.stdout))
    } else {
        Err(text(output.stderr))
    }
}
