//! Files as editors write them: with a byte-order mark, with CRLF, in UTF-16.

use std::path::PathBuf;

use crate::run::{stdout, symplectic};

/// A file of this test.
fn file(name: &str, contents: &[u8]) -> String {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("encodings");
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join(name);
    std::fs::write(&path, contents).expect("a file");
    path.to_str().expect("a path in UTF-8").to_owned()
}

const PRINTED: &str = r#"name = "verlet"
[claim]
class = "separable"
order = 2
[printed]
kick = ["0.5", "0.5"]
drift = ["1", "0"]
"#;

/// Every kind of file with its text and the commands that read it.
fn readers() -> Vec<(&'static str, String, Vec<&'static str>)> {
    let shown = |format| stdout(&["show", "gauss-2", "--format", format]);
    let definition = "[provenance]\nbasis = \"polynomial(2)\"\nnodes = \"gauss(2)\"\n";
    let tables: Vec<&'static str> = vec!["check", "derive"];
    vec![
        ("table.json", shown("json"), tables.clone()),
        ("table.toml", shown("toml"), tables.clone()),
        ("definition.toml", definition.to_owned(), tables),
        ("printed.toml", PRINTED.to_owned(), vec!["refine"]),
    ]
}

#[test]
fn a_byte_order_mark_and_line_ends_change_nothing() {
    for (name, text, commands) in readers() {
        for command in commands {
            let run = |variant: &str, contents: &str| {
                let path = file(&format!("{variant}-{name}"), contents.as_bytes());
                stdout(&[command, &path]).replace(&path, name)
            };
            let plain = run("plain", &text);
            let lines = text.replace('\n', "\r\n");
            assert_eq!(run("mark", &format!("\u{feff}{text}")), plain, "{name}");
            assert_eq!(run("lines", &lines), plain, "{name}");
            assert_eq!(run("both", &format!("\u{feff}{lines}")), plain, "{name}");
            let returns = text.replace('\n', "\r");
            assert_eq!(run("returns", &returns), plain, "{name}");
        }
    }
}

#[test]
fn places_are_those_of_the_text_without_the_mark() {
    for (name, text, commands) in readers() {
        let broken = text.replacen('\n', "\n?", 1);
        for command in commands {
            let run = |variant: &str, contents: &str| {
                let path = file(&format!("broken-{variant}-{name}"), contents.as_bytes());
                let output = symplectic(&[command, &path]);
                assert_eq!(output.status.code(), Some(2), "{name}");
                String::from_utf8(output.stderr)
                    .expect("text")
                    .replace(&path, name)
            };
            let plain = run("plain", &broken);
            assert!(plain.contains(&format!("{name}:2:")), "{plain}");
            assert_eq!(run("mark", &format!("\u{feff}{broken}")), plain, "{name}");
        }
    }
}

#[test]
fn other_encodings_are_named() {
    for (name, text, commands) in readers() {
        let units = |mark: &str, bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
            let text = format!("{mark}{text}");
            text.encode_utf16().flat_map(bytes).collect()
        };
        let mut latin = text.clone().into_bytes();
        latin.extend(b"# \xe3");
        let cases = [
            (
                "le",
                units("\u{feff}", u16::to_le_bytes),
                "is UTF-16 (little-endian) text; save it as UTF-8",
            ),
            (
                "be",
                units("\u{feff}", u16::to_be_bytes),
                "is UTF-16 (big-endian) text; save it as UTF-8",
            ),
            (
                "bare-le",
                units("", u16::to_le_bytes),
                "is UTF-16 (little-endian) text; save it as UTF-8",
            ),
            (
                "bare-be",
                units("", u16::to_be_bytes),
                "is UTF-16 (big-endian) text; save it as UTF-8",
            ),
            ("latin", latin, "is wrong; save it as UTF-8"),
        ];
        for (variant, contents, message) in cases {
            let path = file(&format!("{variant}-{name}"), &contents);
            for command in &commands {
                let output = symplectic(&[command, &path]);
                let errors = String::from_utf8(output.stderr).expect("text");
                assert_eq!(output.status.code(), Some(2), "{path}: {errors}");
                assert!(
                    errors.contains(message) && errors.contains(&path),
                    "{errors}"
                );
            }
        }
    }
}

#[test]
fn options_may_hold_the_text_of_a_file() {
    let weights = "1/2,\r\n1/2\r\n";
    let derive = |weights: &str| stdout(&["derive", "--base=midpoint", "--weights", weights]);
    assert_eq!(derive(&format!("\u{feff}{weights}")), derive("1/2, 1/2"));
}
