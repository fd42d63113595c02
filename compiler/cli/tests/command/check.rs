//! `symplectic check`: files that fit, files that do not, files that are no tables.

use std::path::PathBuf;

use crate::run::{stdout, symplectic};

/// A file of this test, in a folder of its own.
fn file(name: &str, contents: &[u8]) -> String {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("cli");
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join(name);
    std::fs::write(&path, contents).expect("a file");
    path.to_str().expect("a path in UTF-8").to_owned()
}

fn checked(file: &str) -> (Option<i32>, String, String) {
    let output = symplectic(&["check", file]);
    let (out, errors) = (
        String::from_utf8(output.stdout),
        String::from_utf8(output.stderr),
    );
    (
        output.status.code(),
        out.expect("text"),
        errors.expect("text"),
    )
}

#[test]
fn check_accepts_written_files_and_finds_a_changed_digit() {
    for format in ["toml", "json"] {
        let text = stdout(&["show", "lobatto-3", "--format", format]);
        let path = file(&format!("good.{format}"), text.as_bytes());
        assert_eq!(
            checked(&path),
            (
                Some(0),
                format!(
                    "{path}: ok, lobatto-3 with 3 stages, order general 4, separable 4, nystrom 4, stable for hω in (0, 2*sqrt(2)) ∪ (2*sqrt(3), 2*sqrt(6))\n"
                ),
                String::new()
            )
        );
        // One digit, the last, of the last decimal.
        let last = text
            .rfind("0.8333333333333333333333333333333333333333")
            .expect("ã_32");
        let mut edited = text.clone();
        edited.replace_range(last + 41..last + 42, "4");
        let path = file(&format!("edited.{format}"), edited.as_bytes());
        let (status, out, errors) = checked(&path);
        assert_eq!(status, Some(1));
        assert!(
            out.starts_with(&format!("{path}: FAILED, `ã_32 (decimal)` does not fit")),
            "{out}"
        );
        let lines: Vec<&str> = errors.lines().collect();
        assert!(
            lines[0].starts_with("error: `ã_32 (decimal)` does not fit: the file has 0.83333"),
            "{errors}"
        );
        // The carets stand under the value.
        let column = |line: &str, part: &str| line.find(part).map(|at| line[..at].chars().count());
        assert_eq!(
            column(lines[4], "^"),
            column(lines[3], "\"0.8333"),
            "{errors}"
        );
    }
    let text = stdout(&["show", "gauss-4", "--format", "toml"]);
    let path = file(
        "exact.toml",
        text.replacen("\"-140\"", "\"-141\"", 1).as_bytes(),
    );
    let (status, out, _) = checked(&path);
    assert_eq!(status, Some(1));
    assert!(
        out.contains(
            "`the node polynomial, coefficient of x^3 (exact)` does not fit: the file has -141"
        ),
        "{out}"
    );
}

#[test]
fn check_refuses_files_that_are_not_tables() {
    let good = stdout(&["show", "midpoint", "--format", "toml"]);
    let folder = env!("CARGO_TARGET_TMPDIR").to_owned();
    // The first two bytes of all in this order are the mark of UTF-16.
    let garbage: Vec<u8> = (0..=254).rev().collect();
    let marked: Vec<u8> = (0..=255).rev().collect();
    for (path, message) in [
        (
            file("truncated.toml", &good.as_bytes()[..good.len() / 2]),
            "not a TOML file of a tableau",
        ),
        (file("truncated.json", b"{\"name\": "), "EOF while parsing"),
        (
            file("garbage.toml", &garbage),
            "not UTF-8 text: the byte at offset 0 is wrong",
        ),
        (file("garbage.json", &garbage), "not UTF-8 text"),
        (
            file("marked.toml", &marked),
            "is UTF-16 (little-endian) text",
        ),
        (file("empty.toml", b""), "missing field `provenance`"),
        (file("empty.json", b""), "EOF while parsing a value"),
        (
            file("table.txt", good.as_bytes()),
            "is named neither .toml nor .json",
        ),
        (folder.clone(), "cannot read"),
        (format!("{folder}/nowhere.toml"), "cannot read"),
    ] {
        let (status, out, errors) = checked(&path);
        assert_eq!(status, Some(2), "{path}");
        assert!(
            errors.contains(message) && !errors.contains("panicked"),
            "{path}: {errors}"
        );
        assert!(
            out.starts_with(&format!("{path}: FAILED, ")) && out.lines().count() == 1,
            "{out}"
        );
    }
    // All files are looked at, and the worst decides.
    let (good, bad) = (
        file("one.toml", good.as_bytes()),
        file("two.toml", b"stages"),
    );
    let output = symplectic(&["check", &bad, &good]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(String::from_utf8_lossy(&output.stdout).lines().count(), 2);
}

#[test]
fn facts_are_neither_hidden_nor_added_nor_left_out() {
    let toml = stdout(&["show", "lobatto-3", "--format", "toml"]);
    let json = stdout(&["show", "lobatto-3", "--format", "json"]);
    for (name, text, from, to, message) in [
        (
            "twice.json",
            &json,
            r#""p_stable": false"#,
            r#""p_stable": true, "p_stable": false"#,
            "`stability.p_stable` does not fit: the file has true, the derivation gives false",
        ),
        (
            "nothing.json",
            &json,
            r#""p_stable": false"#,
            r#""p_stable": false, "l_stable": []"#,
            "`stability.l_stable` does not fit: the file has [], the derivation gives no such entry",
        ),
        (
            "nothing.toml",
            &toml,
            "p_stable = false",
            "p_stable = false\nl_stable = {}",
            "`stability.l_stable` does not fit: the file has {}, the derivation gives no such entry",
        ),
        (
            "quoted.toml",
            &toml,
            "p_stable = false",
            "p_stable = \"false\"",
            "`stability.p_stable` does not fit: the file has \"false\", the derivation gives false",
        ),
        (
            "float.toml",
            &toml,
            "dispersion_order = 4",
            "dispersion_order = 4.0",
            "`stability.dispersion_order` does not fit: the file has 4.0, the derivation gives 4",
        ),
        (
            "missing.toml",
            &toml,
            "determinant = \"1\"\n",
            "",
            "`stability.determinant` does not fit: the file has no such entry before `stability.dispersion`, the derivation gives \"1\"",
        ),
    ] {
        assert_eq!(text.matches(from).count(), 1, "{name}");
        let path = file(name, text.replace(from, to).as_bytes());
        let (status, out, _) = checked(&path);
        assert_eq!(
            (status, out),
            (Some(1), format!("{path}: FAILED, {message}\n"))
        );
    }
}

/// A digit of a claim that is changed after the tenth place is told, in the definition and in a whole table.
#[test]
fn printed_digits_of_a_claim_are_checked() {
    let right = "[provenance]\nkick = \"0.675603595979829, -0.175603595979829\"\ndrift = \"1.351207191959658, -1.702414383919315\"\nsymmetric = true\nclaim = \"separable(4)\"\n";
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let checked = |name: &str, text: &str| {
        let path = folder.join(name).display().to_string();
        std::fs::write(&path, text).expect("a file");
        let output = symplectic(&["check", &path]);
        assert!(output.status.success(), "{output:?}");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        (
            text(&output.stdout).replace(&path, name),
            text(&output.stderr).replace(&path, name),
        )
    };
    let (verdict, warnings) = checked("claim-right.toml", right);
    assert!(verdict.starts_with("claim-right.toml: ok, "), "{verdict}");
    assert_eq!(warnings, "");
    let wrong = right.replace("0.675603595979829", "0.675603595989829");
    let (verdict, warnings) = checked("claim-wrong.toml", &wrong);
    assert!(
        verdict.starts_with("claim-wrong.toml: ok apart from the digits of 1 printed number, "),
        "{verdict}"
    );
    expect_test::expect![[r#"
        warning: `0.675603595989829` is not the exact kick[0], rounded: that is 0.675603595979829; no method of this structure and order has all printed digits, which is proved
         --> claim-wrong.toml:2:9
          |
        2 | kick = "0.675603595989829, -0.175603595979829"
          |         ^^^^^^^^^^^^^^^^^
    "#]].assert_eq(&warnings);
}

#[test]
fn an_inconsistent_method_is_named() {
    let definition = b"[provenance]\na = \"[[1/2]]\"\nb = \"1/3\"\n";
    let path = file("inconsistent.toml", definition);
    let text = stdout(&["check", &path]).replace(&path, "file");
    let wanted = "file: ok but not consistent: the weights sum to 1/3 instead of 1, a tableau without a name";
    assert!(text.starts_with(wanted), "{text}");
}
