//! The command `symplectic search`.

use std::path::PathBuf;
use std::process::{Command, Output};

fn search(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_symplectic-search"));
    command
        .args(arguments)
        .output()
        .expect("the program starts")
}

fn printed(arguments: &[&str]) -> String {
    let output = search(arguments);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).expect("text")
}

fn refusal(arguments: &[&str]) -> String {
    let output = search(arguments);
    assert_eq!(output.status.code(), Some(2));
    String::from_utf8(output.stderr).expect("text")
}

fn folder(name: &str) -> PathBuf {
    let folder =
        std::env::temp_dir().join(format!("symplectic-search-{}-{name}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

#[test]
fn a_search_ends_with_proved_methods_beside_the_catalogue_and_writes_them() {
    let out = folder("out");
    let path = out.display().to_string();
    let text = printed(&[
        "--class",
        "nystrom",
        "--order",
        "4",
        "--kicks",
        "6",
        "--structure",
        "bab",
        "--starts",
        "128",
        "--keep",
        "1",
        "--out",
        &path,
    ]);
    for part in [
        "4 conditions, 7 unknowns, 3 free parameters",
        "1. Proved: order 4 for separable H, 4 for nystrom H",
        "claim: nystrom(4), symmetric: true",
        "blanes-moan-2002-srkn6b",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let written = std::fs::read_to_string(out.join("nystrom-4-bab-6-1.toml")).expect("a file");
    let limits = symplectic_compiler::Limits::default();
    let tableau =
        symplectic_compiler::check("method.toml", &written, &limits).expect("a correct file");
    assert_eq!(tableau.orders().nystrom.order, 4);
    let certificate = std::fs::read_to_string(out.join("nystrom-4-bab-6-1.certificate.json"))
        .expect("a certificate");
    assert!(certificate.contains("symplectic certificate"));
    std::fs::remove_dir_all(&out).expect("the folder");
}

#[test]
fn an_interrupted_search_goes_on_from_its_file() {
    let file = folder("state");
    let path = file.display().to_string();
    let with = |starts: &str| {
        printed(&[
            "--order", "4", "--kicks", "4", "--keep", "1", "--starts", starts, "--resume", &path,
        ])
    };
    with("64");
    let resumed = with("192");
    let whole = printed(&[
        "--order", "4", "--kicks", "4", "--keep", "1", "--starts", "192",
    ]);
    assert_eq!(resumed, whole);
    let other = refusal(&[
        "--order", "4", "--kicks", "5", "--starts", "64", "--resume", &path,
    ]);
    assert!(other.contains("is the state of another search"), "{other}");
    std::fs::remove_file(&file).expect("the file");
}

#[test]
fn impossible_isolated_and_unstable_solutions_are_reported_with_their_counts() {
    let text = printed(&["--order", "6", "--kicks", "5", "--starts", "64"]);
    assert!(
        text.contains(
            "nothing found from 64 starts; there are 10 conditions for 6 unknowns: take more kicks"
        ),
        "{text}"
    );
    let text = printed(&["--order", "4", "--kicks", "3", "--starts", "64"]);
    assert!(text.contains("solutions are isolated"), "{text}");
    let text = printed(&[
        "--order",
        "4",
        "--kicks",
        "3",
        "--starts",
        "64",
        "--at-least-stable",
        "1.9",
    ]);
    assert!(text.contains("is stable up to hω = 1.9 a kick"), "{text}");
}

#[test]
fn wrong_options_are_refused_with_what_to_do_instead() {
    for (arguments, expected) in [
        (
            &["--order", "5", "--kicks", "9"][..],
            "symmetric methods have even orders",
        ),
        (
            &["--order", "8,4", "--kicks", "5"],
            "`--class perturbed` has several orders",
        ),
        (&["--order", "12", "--kicks", "9"], "order"),
        (
            &[
                "--class",
                "nystrom",
                "--order",
                "4",
                "--kicks",
                "5",
                "--structure",
                "composition",
            ],
            "leave out `--class`",
        ),
        (
            &["--order", "4", "--kicks", "5", "--time", "5"],
            "expected a time such as 30s, 5m or 1h",
        ),
        (
            &["--order", "4", "--kicks", "5", "--largest", "-1"],
            "expected a positive number",
        ),
    ] {
        let error = refusal(arguments);
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
}
