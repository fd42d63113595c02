//! Files that are no tables, and tables that are not what they say: each refused with the reason and
//! the place.

use symplectic_compiler::export::{json, toml};
use symplectic_compiler::{Error, ErrorKind, Limits, check, derive};

fn toml_text() -> String {
    let tableau = derive("polynomial(2)", "lobatto(2)").expect("Störmer–Verlet");
    toml::write(&tableau.named("verlet"), 6)
}

fn json_text() -> String {
    json::write(&derive("polynomial(2)", "gauss(2)").expect("Gauss"), 6)
}

/// The text with one part replaced, which must be there.
fn edited(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from} is not in\n{text}");
    text.replacen(from, to, 1)
}

/// What the place of an error covers.
fn covered(error: &Error) -> &str {
    let place = error.place.as_ref().expect("a place");
    &place.text[place.span.clone()]
}

fn refused_reading(text: &str) -> Error {
    toml::read("t.toml", text, &Limits::default()).expect_err(text)
}

#[test]
fn files_that_are_not_tables_are_refused_at_the_place() {
    let text = toml_text();
    // What is replaced by what, what the message says, and what it points at.
    let cases = [
        ("[exact]\n", "[exact]\nc = []\n", "unknown field `c`", "c"),
        (
            "stages = 2",
            "stages = 2\nspeed = 3",
            "unknown field `speed`",
            "speed",
        ),
        (
            "stages = 2",
            "stages = \"2\"",
            "invalid type: string \"2\", expected usize",
            "\"2\"",
        ),
        (
            "stages = 2",
            "stages = -2",
            "invalid value: integer `-2`",
            "-2",
        ),
        ("stages = 2", "stages = 0", "at least one stage", "0"),
        (
            "stages = 2",
            "stages = 3",
            "`node_polynomial` has 3 entries where 4 are needed for 3 stages",
            "[\"0\", \"-1\", \"1\"]",
        ),
        (
            "stages = 2",
            "stages = 37",
            "37 stages exceed the limit of 36",
            "37",
        ),
        ("b = [\"1/2\", \"0\"]\n", "", "missing field `b`", "[exact]"),
        (
            "b = [\"1/2\", \"0\"]",
            "b = [\"1/2\"]",
            "`b` has 1 entries where 2 are needed",
            "[\"1/2\"]",
        ),
        (
            "\"1/2\"], # 1",
            "], # 1",
            "`a[0]` has 1 entries where 2 are needed",
            "[\"0\", ]",
        ),
        (
            "b = [\"1/2\", \"0\"]",
            "b = [\"1/2\", 0]",
            "invalid type: integer `0`",
            "0",
        ),
        (
            "b = [\"1/2\", \"0\"]",
            "b = [\"1/2\", \"1/0\"]",
            "`1/0` is not a rational number",
            "\"1/0\"",
        ),
        (
            "b = [\"1/2\", \"0\"]",
            "b = [\"1/2\", \"0.5\"]",
            "`0.5` is not a rational number",
            "\"0.5\"",
        ),
        (
            "[\"0\", \"-1\", \"1\"]",
            "[\"1\", \"-2\", \"1\"]",
            "x^2 - 2*x + 1 is not squarefree",
            "[\"1\", \"-2\", \"1\"]",
        ),
        (
            "[\"0\", \"-1\", \"1\"]",
            "[\"0\", \"0\", \"0\"]",
            "0 is not squarefree",
            "[\"0\", \"0\", \"0\"]",
        ),
        (
            "[\"0\", \"-1\", \"1\"]",
            "[\"1\", \"0\", \"1\"]",
            "has 2 roots, but only 0 of them are real",
            "[\"1\", \"0\", \"1\"]",
        ),
        (
            "[\"0\", \"-1\", \"1\"]",
            "[\"0\", \"-2\", \"1\"]",
            "the node 2 lies outside [0, 1]",
            "[\"0\", \"-2\", \"1\"]",
        ),
        (
            "[\"0\", \"-1\", \"1\"]",
            "[\"-1\", \"2\", \"0\"]",
            "has 1 roots, but there are 2 stages",
            "[\"-1\", \"2\", \"0\"]",
        ),
        (
            "digits = 6",
            "digits = 0",
            "the number of digits must be from 1 to 10000",
            "0",
        ),
        (
            "digits = 6",
            "digits = 6000000",
            "the number of digits must be from 1 to 10000",
            "6000000",
        ),
        (
            "symmetric ",
            "symmetrical",
            "unknown property `symmetrical`",
            "symmetrical",
        ),
        (
            "positive_weights",
            "symmetric",
            "duplicate key",
            "symmetric",
        ),
        (
            "evidence = \"proved\" }\n",
            "proof = 1 }\n",
            "unknown field `proof`",
            "proof",
        ),
        ("[properties]", "[properties", "unclosed table", ""),
    ];
    for (from, to, message, place) in cases {
        let error = refused_reading(&edited(&text, from, to));
        assert!(
            error.kind.to_string().contains(message),
            "{from} → {to}: {error}"
        );
        assert!(
            !matches!(*error.kind, ErrorKind::Mismatch { .. }),
            "{error}"
        );
        assert_eq!(covered(&error), place, "{from} → {to}: {error}");
    }
    let (before, after) = text
        .split_once("positive_weights")
        .expect("the last property");
    let (_, after) = after.split_once('\n').expect("a line");
    let error = refused_reading(&format!("{before}{after}"));
    assert_eq!(
        error.kind.to_string(),
        "the property `positive_weights` is missing"
    );
    assert_eq!(covered(&error), "[properties]");
    let long = edited(&text, "\"-1\"", &format!("\"{}\"", "9".repeat(1_000_000)));
    assert!(refused_reading(&long).kind.to_string().contains("too long"));
}

#[test]
fn truncated_files_are_refused_everywhere() {
    for (name, text) in [("t.toml", toml_text()), ("t.json", json_text())] {
        // Without the last line break alone, nothing is missing.
        let complete = text.trim_end().len();
        assert!(check(name, &text[..complete], &Limits::default()).is_ok());
        for end in (0..complete).filter(|&end| text.is_char_boundary(end)) {
            let error = check(name, &text[..end], &Limits::default()).expect_err("truncated");
            assert!(error.place.is_some(), "{error}");
        }
    }
    let error = check("t.toml", "", &Limits::default()).expect_err("empty");
    assert_eq!(
        error.to_string(),
        "t.toml, column 1: not a TOML file of a tableau: missing field `provenance`"
    );
    let error = check("t.json", "", &Limits::default()).expect_err("empty");
    assert_eq!(
        error.to_string(),
        "t.json, column 1: not a JSON export of a tableau: EOF while parsing a value"
    );
    let error = check("t.txt", "", &Limits::default()).expect_err("unknown");
    assert_eq!(
        error.to_string(),
        "`t.txt` is named neither .toml nor .json"
    );
}

/// Every edit of a value is found and named, in TOML.
#[test]
fn the_first_entry_that_does_not_fit_is_named() {
    let text = toml_text();
    let cases = [
        (
            "nodes = \"lobatto(2)\"",
            "nodes = \"gauss(2)\"",
            "the node polynomial, coefficient of 1 (exact)",
            "0",
            "1",
        ),
        (
            "basis = \"polynomial(2)\"",
            "basis = \" polynomial(2)\"",
            "basis",
            " polynomial(2)",
            "polynomial(2)",
        ),
        (
            "[\"0\", \"-1\", \"1\"]",
            "[\"0\", \"-2\", \"2\"]",
            "the node polynomial, coefficient of x (exact)",
            "-2",
            "-1",
        ),
        (
            "b = [\"1/2\", \"0\"]",
            "b = [\"2/4\", \"0\"]",
            "b, coefficient of 1 (exact)",
            "2/4",
            "1/2",
        ),
        (
            "b_tilde = [\"1/2\", \"0\"]",
            "b_tilde = [\"1/2\", \"1\"]",
            "b̃, coefficient of x (exact)",
            "1",
            "0",
        ),
        (
            "\"1/2\"], # 1",
            "\"1/3\"], # 1",
            "a, coefficient of x (exact)",
            "1/3",
            "1/2",
        ),
        (
            "\"-1/2\", \"0\"], # y",
            "\"-1/2\", \"1/0\"], # y",
            "ã, coefficient of x y (exact)",
            "1/0",
            "0",
        ),
        (
            "digits = 6",
            "digits = 7",
            "c_2 (decimal)",
            "1.00000",
            "1.000000",
        ),
        (
            "b_tilde = [\"0.500000\"",
            "b_tilde = [\"0.500001\"",
            "b̃_1 (decimal)",
            "0.500001",
            "0.500000",
        ),
        (
            "\"0.500000\"], # i = 2",
            "\"0.50000\"], # i = 2",
            "a_22 (decimal)",
            "0.50000",
            "0.500000",
        ),
        (
            "symmetric          = { holds = true",
            "symmetric          = { holds = false",
            "symmetric (holds)",
            "false",
            "true",
        ),
        (
            "\"refuted\"",
            "\"proved\"",
            "equal_matrices (evidence)",
            "proved",
            "refuted",
        ),
        (
            "= -1/2\" }",
            "= -1/3\" }",
            "equal_matrices (witness)",
            "a_11 − ã_11 = -1/3",
            "a_11 − ã_11 = -1/2",
        ),
        (
            ", witness = \"a_11 − ã_11 = -1/2\"",
            "",
            "equal_matrices (witness)",
            "nothing",
            "a_11 − ã_11 = -1/2",
        ),
        (
            "evidence = \"proved\" }",
            "evidence = \"proved\", bits = 9 }",
            "symplectic (bits)",
            "9",
            "nothing",
        ),
    ];
    for (from, to, entry, found, expected) in cases {
        let text = edited(&text, from, to);
        let error = check("t.toml", &text, &Limits::default()).expect_err(to);
        let kind = ErrorKind::Mismatch {
            entry: entry.to_owned(),
            found: found.to_owned(),
            expected: expected.to_owned(),
            advice: "",
        };
        assert_eq!(*error.kind, kind, "{from} → {to}");
        assert!(
            covered(&error).contains(found) || found == "nothing",
            "{error}"
        );
    }
    // The name is nobody's business, nor is the layout, nor another expression for the same nodes.
    for (from, to) in [
        ("nodes = \"lobatto(2)\"", "nodes = \"0, 1\""),
        ("name = \"verlet\"", "name = \"other\""),
        ("name = \"verlet\"\n", ""),
        ("stages = 2", "stages  =  2 # two"),
    ] {
        assert!(check("t.toml", &edited(&text, from, to), &Limits::default()).is_ok());
    }
}

/// Changes each `stride`-th digit of the values of a file after a word, which is refused each time; returns how many.
fn change_digits(name: &str, text: &str, after: &str, stride: usize) -> usize {
    let data = text.find(after).expect(after);
    let is_value = |&(offset, c): &(usize, char)| {
        let line_start = text[..offset].rfind('\n').map_or(0, |n| n + 1);
        // Keys are no values: nothing with digits but `"f64"`.
        let before = &text[..offset];
        let key = before.ends_with("\"f") || before.ends_with("\"f6");
        offset > data && c.is_ascii_digit() && !text[line_start..offset].contains('#') && !key
    };
    let digits = text.char_indices().filter(is_value);
    let digits = digits.skip(stride / 2).step_by(stride);
    let changed = digits.map(|(offset, digit)| {
        let other = if digit == '9' {
            '8'
        } else {
            (digit as u8 + 1) as char
        };
        let changed = format!("{}{other}{}", &text[..offset], &text[offset + 1..]);
        let checked = check(name, &changed, &Limits::default());
        assert!(checked.is_err(), "{name} at {offset}");
    });
    changed.count()
}

#[test]
#[ignore = "thorough"]
fn every_changed_digit_of_a_file_is_found() {
    assert!(change_digits("t.toml", &toml_text(), "stages", 1) > 100);
    assert!(change_digits("t.json", &json_text(), "stages", 1) > 100);
}

/// All digits of the values of ten tables of the catalogue, and some of each other table that is not long. Years of sources are no values,
/// and a printed digit of a definition with a claim may be wrong: a warning says so.
#[test]
#[ignore = "thorough"]
fn changed_digits_in_files_of_the_catalogue_are_found() {
    const ALL: [&str; 10] = [
        "symplectic-euler",
        "symplectic-euler-adjoint",
        "stormer-verlet",
        "velocity-verlet",
        "position-verlet",
        "gauss-1",
        "gauss-2",
        "radau-left-1",
        "radau-right-1",
        "chebyshev-1",
    ];
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../tableaux");
    let (mut all, mut others) = (0, 0);
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let (Some(stem), Some("toml")) = (
            path.file_stem().and_then(|stem| stem.to_str()),
            path.extension().and_then(|extension| extension.to_str()),
        ) else {
            continue;
        };
        let text = std::fs::read_to_string(&path).expect("text");
        let name = format!("{stem}.toml");
        if ALL.contains(&stem) {
            all += usize::from(change_digits(&name, &text, "\n[exact]", 1) > 20);
        } else if text.len() < 10_000 {
            others += change_digits(&name, &text, "\n[decimals]", 400);
        }
    }
    assert_eq!(all, ALL.len());
    assert!(others > 40, "{others}");
}

/// A file whose decimals fit its exact data, both of another valid method, and whose provenance is a lie.
#[test]
fn another_method_under_a_false_provenance_is_refused() {
    let verlet = toml_text();
    let gauss = toml::write(&derive("polynomial(2)", "gauss(2)").expect("Gauss"), 6);
    let forged = edited(&gauss, "gauss(2)", "lobatto(2)");
    assert!(toml::read("t.toml", &forged, &Limits::default()).is_ok());
    let error = check("t.toml", &forged, &Limits::default()).expect_err("forged");
    assert!(
        error
            .to_string()
            .contains("`the node polynomial, coefficient of 1 (exact)` does not fit"),
        "{error}"
    );
    // The same nodes with other weights and matrices: a consistent change of a and ã.
    let other = edited(
        &edited(&verlet, "\"1/2\"], # 1", "\"1/3\"], # 1"),
        "\"-1/2\", \"0\"], # y",
        "\"-1/3\", \"0\"], # y",
    );
    assert!(check("t.toml", &other, &Limits::default()).is_err());
    let forged = edited(&json_text(), "gauss(2)", "lobatto(2)");
    let error = check("t.json", &forged, &Limits::default()).expect_err("forged");
    assert!(
        error.to_string().contains("`c_1 (exact)` does not fit"),
        "{error}"
    );
}

#[test]
fn expressions_in_files_are_refused_at_their_place_in_the_file() {
    for (name, text, from) in [
        ("t.toml", toml_text(), "lobatto(2)"),
        ("t.json", json_text(), "gauss(2)"),
    ] {
        let check =
            |to: &str| check(name, &edited(&text, from, to), &Limits::default()).expect_err(to);
        assert_eq!(covered(&check("0, 4/3")), "4/3");
        assert_eq!(covered(&check("lobato(2)")), "lobato");
        assert_eq!(check("lobato(2)").place.expect("a place").input, name);
        // An escape moves the bytes: the whole string is shown.
        assert_eq!(covered(&check("0, \\u0034/3")), "\"0, \\u0034/3\"");
    }
}

#[test]
fn json_of_another_shape_is_refused() {
    let text = json_text();
    let cases = [
        (
            "\"stages\": 2",
            "\"stages\": 3",
            "`c` has 2 entries, but there are 3 stages",
        ),
        (
            "\"stages\": 2",
            "\"stages\": \"two\"",
            "expected a number of stages",
        ),
        (
            "\"stages\": 2",
            "\"stages\": 1000",
            "1000 stages exceed the limit of 36",
        ),
        ("\"stages\": 2", "\"stage\": 2", "unknown field `stage`"),
        ("\"stages\": 2,", "", "missing field `stages`"),
        (
            "\"basis\": \"polynomial(2)\"",
            "\"basis\": 2",
            "expected a string",
        ),
        (
            "\"source\": null",
            "\"source\": []",
            "expected a string or null",
        ),
        (
            "\"symmetric\"",
            "\"symplectic\"",
            "duplicate field `symplectic`",
        ),
        ("\"symmetric\"", "\"elegant\"", "unknown field `elegant`"),
        ("\"bits\": null, ", "", "missing field `bits`"),
    ];
    for (from, to, message) in cases {
        let error =
            json::read("t.json", &edited(&text, from, to), &Limits::default()).expect_err(to);
        assert!(
            error.to_string().contains(message),
            "{from} → {to}: {error}"
        );
        assert!(error.place.is_some());
    }
}
