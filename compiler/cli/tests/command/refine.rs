//! Refining printed coefficients on the command line.

use std::path::Path;
use std::sync::LazyLock;

use crate::run::{failure, stdout};
use expect_test::expect;
use serde_json::Value;

/// Files of the methods that are known by their decimals only, with what is in them: written once, for tests that run side by side.
static FILES: LazyLock<Vec<(String, String)>> = LazyLock::new(files);

fn files() -> Vec<(String, String)> {
    let data: Value =
        serde_json::from_str(include_str!("../../../tests/data/explicit-methods.json"))
            .expect("JSON");
    let methods = data["methods"].as_array().expect("a list").iter();
    let file = |method: &Value| {
        let entry = symplectic_compiler::catalogue::find(method["name"].as_str()?)?;
        entry.definition.contains("claim: ").then(|| {
            let text = format!(
                "name = \"{}\"\nsource = {}\n\n[claim]\nclass = {}\norder = {}\n\n[printed]\nkick = {}\ndrift = {}\n",
                entry.name,
                method["source"],
                method["hamiltonian_class"],
                method["order"],
                method["kick"],
                method["drift"],
            );
            (written(&entry.name, &text), text)
        })
    };
    let files: Vec<_> = methods.filter_map(file).collect();
    assert_eq!(files.len(), 19);
    files
}

/// The path of one of them.
fn path(name: &str) -> String {
    let named = format!("\"{name}\"");
    let file = FILES.iter().find(|(_, text)| text.contains(&named));
    file.expect(name).0.clone()
}

/// A file of this test.
fn written(name: &str, text: &str) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let path = folder.join(format!("refine-{name}.toml"));
    std::fs::write(&path, text).expect("a file");
    path.display().to_string()
}

/// The message about a file that is refused, with a short path.
fn refused(name: &str, text: &str, expected: Option<i32>) -> String {
    let (status, errors) = failure(&["refine", &written(name, text)]);
    assert_eq!(status, expected, "{errors}");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("refine-");
    errors.replace(&folder.display().to_string(), "")
}

fn parsed(text: &str) -> toml::Table {
    text.parse().expect("TOML")
}

#[test]
fn every_method_is_certified() {
    for (path, text) in FILES.iter() {
        let json = |digits: &str| -> Value {
            let output = stdout(&["refine", path, "--digits", digits, "--format", "json"]);
            serde_json::from_str(&output).expect("JSON")
        };
        let (short, long) = (json("100"), json("120"));
        let file = parsed(text);
        assert_eq!(short["name"].as_str(), file["name"].as_str(), "{path}");
        assert_eq!(short["evidence"], "certified", "{path}");
        assert_eq!(short["next_order_refuted"], true, "{path}");
        let distance: f64 = short["distance"]
            .as_str()
            .and_then(|x| x.parse().ok())
            .expect(path);
        assert!(distance < 1e-12, "{path}: {distance}");
        let order = file["claim"]["order"].as_integer().expect(path);
        let claim = short["claim"].as_str().expect(path);
        assert!(claim.starts_with(&format!("order {order} for ")), "{claim}");
        for key in ["kick", "drift"] {
            let printed = file["printed"][key].as_array().expect(path);
            let found = short[key].as_array().expect(path);
            assert_eq!(printed.len(), found.len(), "{path}");
            for (index, (entry, printed)) in found.iter().zip(printed).enumerate() {
                assert_eq!(entry["printed"].as_str(), printed.as_str());
                let decimal = entry["decimal"].as_str().expect(path);
                let value = |text: &str| -> f64 { text.parse().expect(text) };
                let printed = printed.as_str().map_or(f64::NAN, value);
                assert!(
                    (value(decimal) - printed).abs() < 1e-12,
                    "{path}: {decimal}"
                );
                // Rounded later it begins with the same digits.
                let longer = long[key][index]["decimal"].as_str().expect(path);
                assert!(
                    decimal == "0" || longer.starts_with(&decimal[..decimal.len() - 12]),
                    "{longer}"
                );
            }
        }
    }
}

/// The example of the book is a file.
#[test]
fn a_file_is_refined() {
    let file = "tests/command/data/yoshida-1990-order-6-a.toml";
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let found = stdout(&["refine", &file.display().to_string(), "--digits", "100"]);
    let same = stdout(&["refine", &path("yoshida-1990-order-6-a"), "--digits", "100"]);
    let coefficients = |text: &str| text.split_once("\n\n").map(|(_, rest)| rest.to_owned());
    assert_eq!(coefficients(&found), coefficients(&same));
    assert!(
        found.contains("exists within 5.8e-21 of the printed digits"),
        "{found}"
    );
}

/// One order more, one wrong digit, kicks and drifts exchanged: refused with the place.
#[test]
#[ignore = "thorough"]
fn refine_refuses_a_higher_order_a_wrong_digit_and_exchanged_lists() {
    for (path, text) in FILES.iter() {
        let file = parsed(text);
        let name = file["name"].as_str().expect("a name");
        let order = parsed(text)["claim"]["order"].as_integer().expect(path);
        let higher = text.replace(
            &format!("order = {order}\n"),
            &format!("order = {}\n", order + 1),
        );
        let told = refused(&format!("{name}-higher"), &higher, Some(1));
        assert!(told.contains("^"), "{told}");
        // The first drift, with another digit in its sixth place.
        let file = parsed(text);
        let drift = file["printed"]["drift"][0].as_str().expect(path);
        let (whole, fraction) = drift.split_once('.').expect("a decimal");
        let mut digits = format!("{fraction:0<6}").into_bytes();
        digits[5] = if digits[5] == b'9' {
            b'8'
        } else {
            digits[5] + 1
        };
        let digits = String::from_utf8(digits).expect("digits");
        let (kicks, drifts) = text.split_once("drift = [").expect("drifts");
        let drifts = drifts.replacen(drift, &format!("{whole}.{digits}"), 1);
        let wrong = format!("{kicks}drift = [{drifts}");
        let told = refused(&format!("{name}-wrong"), &wrong, Some(1));
        assert!(told.starts_with("error: the drifts sum to "), "{told}");
    }
}

#[test]
fn refine_prints_a_readable_report() {
    let path_of = path;
    let path = path_of("mclachlan-1995-ss9");
    expect![[r#"
        mclachlan-1995-ss9, McLachlan 1995, On the numerical integration of ODEs by symmetric composition methods

        certified: an exact method of order 6 for separable H exists within 4.2e-20 of the printed digits
          structure    symmetric composition
          equations    4 conditions for 5 unknowns
          fixed        drift[0] = 0.1867
          unique       the only one within 0.000061 of the printed unknowns
          next order   refuted
          wrong digits none

          kick[0]   0.093350000000000000000000000000000000000000000000000 = 1867/20000
          kick[1]   0.37109851185623919957845677181419560048202869762506
          kick[2]   0.34248198631297687860647937641929799089042870933475
          kick[3]  -0.35689933723712962524654878608730510452611936041355
          kick[4]   0.049968839067913547061612637853811513153661953453752
          kick[5]   0.049968839067913547061612637853811513153661953453752
          kick[6]  -0.35689933723712962524654878608730510452611936041355
          kick[7]   0.34248198631297687860647937641929799089042870933475
          kick[8]   0.37109851185623919957845677181419560048202869762506
          kick[9]   0.093350000000000000000000000000000000000000000000000 = 1867/20000

          drift[0]   0.18670000000000000000000000000000000000000000000000 = 1867/10000
          drift[1]   0.55549702371247839915691354362839120096405739525011
          drift[2]   0.12946694891347535805604520921020478081680002341938
          drift[3]  -0.84326562338773460854914278138481498986903874424649
          drift[4]   0.94320330152356170267236805709243801617636265115399
          drift[5]  -0.84326562338773460854914278138481498986903874424649
          drift[6]   0.12946694891347535805604520921020478081680002341938
          drift[7]   0.55549702371247839915691354362839120096405739525011
          drift[8]   0.18670000000000000000000000000000000000000000000000 = 1867/10000
          drift[9]   0
    "#]].assert_eq(&stdout(&["refine", &path, "--digits", "50"]));
    let path = path_of("blanes-moan-2002-s6");
    expect![[r#"
        blanes-moan-2002-s6, Blanes & Moan 2002, Practical symplectic partitioned Runge-Kutta and Runge-Kutta-Nystrom methods

        certified: an exact method of order 4 for separable H exists within 1.0e-16 of the printed digits
          structure    symmetric splitting
          equations    4 conditions for 7 unknowns
          fixed        kick[1] = 0.35317290604977400, drift[2] = 0.43433666656645600, kick[3] = 0.21937695575349960
          unique       the only one within 0.0018 of the printed unknowns
          next order   refuted
          wrong digits in 8 of 14 coefficients, marked below
                       proved: no symmetric splitting of order 4 for separable H rounds to all printed digits

          kick[0]   0.0792036964311957056736295639756  (the print is off by 5.7e-18)
          kick[1]   0.353172906049774000000000000000
          kick[2]  -0.0420650803577195056736295639756  (the print is off by 5.7e-18)
          kick[3]   0.219376955753499600000000000000
          kick[4]  -0.0420650803577195056736295639756  (the print is off by 5.7e-18)
          kick[5]   0.353172906049774000000000000000
          kick[6]   0.0792036964311957056736295639756  (the print is off by 5.7e-18)

          drift[0]   0.209515106613362095153556868169  (the print is off by 1.0e-16)
          drift[1]  -0.143851773179818095153556868169  (the print is off by 1.0e-16)
          drift[2]   0.434336666566456000000000000000
          drift[3]   0.434336666566456000000000000000
          drift[4]  -0.143851773179818095153556868169  (the print is off by 1.0e-16)
          drift[5]   0.209515106613362095153556868169  (the print is off by 1.0e-16)
          drift[6]   0
    "#]].assert_eq(&stdout(&["refine", &path, "--digits", "30"]));
}

/// Suzuki's weights, for any symmetric method: 1/(4 − ∛4) and what is left.
const WEIGHTS: &str = r#"[claim]
order = 4

[printed]
weights = ["0.41449077", "0.41449077", "-0.65796309", "0.41449077", "0.41449077"]
"#;

#[test]
fn refine_writes_the_report_as_json() {
    let path = written("suzuki", WEIGHTS);
    expect![[r#"
        {
          "name": null,
          "source": null,
          "claim": "order 4 with any symmetric basic method",
          "evidence": "certified",
          "distance": "3.1e-9",
          "structure": "symmetric composition",
          "conditions": 2,
          "unknowns": 2,
          "fixed": [],
          "exact": false,
          "uniqueness_radius": "0.031",
          "next_order_refuted": true,
          "wrong_digits": [],
          "printed_digits": "all",
          "could_be_wrong_instead": [],
          "digits": 30,
          "weights": [
            {
              "printed": "0.41449077",
              "exact": null,
              "decimal": "0.414490771794375737142354062861"
            },
            {
              "printed": "0.41449077",
              "exact": null,
              "decimal": "0.414490771794375737142354062861"
            },
            {
              "printed": "-0.65796309",
              "exact": null,
              "decimal": "-0.657963087177502948569416251443"
            },
            {
              "printed": "0.41449077",
              "exact": null,
              "decimal": "0.414490771794375737142354062861"
            },
            {
              "printed": "0.41449077",
              "exact": null,
              "decimal": "0.414490771794375737142354062861"
            }
          ]
        }
    "#]]
    .assert_eq(&stdout(&[
        "refine", &path, "--digits", "30", "--format", "json",
    ]));
}

#[test]
fn exact_and_perturbed_methods_are_refined() {
    let ruth = "[claim]\nclass = \"separable\"\norder = 3\n\n[printed]\nkick = [\"7/24\", \"3/4\", \"-1/24\"]\ndrift = [\"2/3\", \"-2/3\", \"1\"]\n";
    expect![[r#"
        certified: the printed digits are an exact method of order 3 for separable H
          structure    splitting
          equations    5 conditions for 6 unknowns
          exact        all coefficients are rational
          next order   refuted
          wrong digits none

          kick[0]   0.2916666667 = 7/24
          kick[1]   0.7500000000 = 3/4
          kick[2]  -0.04166666667 = -1/24

          drift[0]   0.6666666667 = 2/3
          drift[1]  -0.6666666667 = -2/3
          drift[2]   1.000000000
    "#]]
    .assert_eq(&stdout(&[
        "refine",
        &written("ruth", ruth),
        "--digits",
        "10",
    ]));
    let saba = "[claim]\nperturbed = [4, 2]\n\n[printed]\nkick = [\"0\", \"0.5\", \"0.5\"]\ndrift = [\"0.2113248654\", \"0.5773502692\", \"0.2113248654\"]\n";
    let text = stdout(&["refine", &written("saba", saba), "--digits", "20"]);
    assert!(
        text.starts_with(
            "certified: an exact method of order (4, 2) for perturbed H exists within "
        ),
        "{text}"
    );
    assert!(text.contains("drift[1]   0.57735026918962576451"), "{text}");
}

const VERLET: &str = "[claim]\nclass = \"separable\"\norder = 2\n\n[printed]\nkick = [\"0.5\", \"0.5\"]\ndrift = [\"1\", \"0\"]\n";

#[test]
fn refine_refuses_malformed_files_at_the_place() {
    let told = |name: &str, from: &str, to: &str| {
        assert!(VERLET.contains(from), "{from}");
        refused(name, &VERLET.replace(from, to), Some(2))
    };
    expect![[r#"
        error: 2 kicks and 1 drifts: the lists of a splitting have the same length; a method that ends with a kick has a last drift 0, one that begins with a drift has a first kick 0
         --> lengths.toml:7:9
          |
        7 | drift = ["1"]
          |         ^^^^^
    "#]].assert_eq(&told("lengths", "\"1\", \"0\"", "\"1\""));
    expect![[r#"
        error: `0,0` is not a decimal or a fraction of two, with at most 10000 characters
         --> number.toml:7:15
          |
        7 | drift = ["1", "0,0"]
          |               ^^^^^
    "#]]
    .assert_eq(&told("number", "\"1\", \"0\"", "\"1\", \"0,0\""));
    expect![[r#"
        error: not a file of printed coefficients: invalid type: floating point `1.0`, expected a string
         --> float.toml:7:10
          |
        7 | drift = [1.0, 0.0]
          |          ^^^
    "#]].assert_eq(&told("float", "\"1\", \"0\"", "1.0, 0.0"));
    expect![[r#"
        error: drift[0] = 1.00000e9 is larger than 1000
         --> large.toml:7:10
          |
        7 | drift = ["1e9", "0"]
          |          ^^^^^
    "#]]
    .assert_eq(&told("large", "\"1\", \"0\"", "\"1e9\", \"0\""));
    expect![[r#"
        error: unknown class `general`; known here: separable, nystrom
         --> class.toml:2:9
          |
        2 | class = "general"
          |         ^^^^^^^^^
    "#]]
    .assert_eq(&told("class", "separable", "general"));
    expect![[r#"
        error: the order 12 cannot be claimed: orders are from 1 to 10, and those for perturbed systems do not increase
         --> order.toml:3:9
          |
        3 | order = 12
          |         ^^
    "#]].assert_eq(&told("order", "order = 2", "order = 12"));
    expect![[r#"
        error: the claim is an `order` with a `class`, or `perturbed = [8, 4]`
         --> none.toml:1:1
          |
        1 | [claim]
          | ^^^^^^^
    "#]]
    .assert_eq(&told("none", "class = \"separable\"\norder = 2", ""));
    expect![[r#"
        error: the order of a splitting is for a `class`: "separable", or "nystrom" for quadratic T
         --> classless.toml:1:1
          |
        1 | [claim]
          | ^^^^^^^
    "#]]
    .assert_eq(&told("classless", "class = \"separable\"\n", ""));
    expect![[r#"
        error: `perturbed` is a claim on its own, for H = H_A + εH_B: leave out `class` and `order`
         --> both.toml:3:13
          |
        3 | perturbed = [2, 2]
          |             ^^^^^^
    "#]]
    .assert_eq(&told("both", "order = 2", "perturbed = [2, 2]"));
    expect![[r#"
        error: a splitting has `kick` and `drift`: `kick` is missing
         --> missing.toml:5:1
          |
        5 | [printed]
          | ^^^^^^^^^
    "#]]
    .assert_eq(&told("missing", "kick = [\"0.5\", \"0.5\"]\n", ""));
    expect![[r#"
        error: not a file of printed coefficients: unknown field `kicks`, expected one of `kick`, `drift`, `gradient`, `weights`; did you mean `kick`?
         --> unknown.toml:6:1
          |
        6 | kicks = ["0.5", "0.5"]
          | ^^^^^
    "#]].assert_eq(&told("unknown", "kick", "kicks"));
    let class = WEIGHTS.replace("order", "class = \"separable\"\norder");
    expect![[r#"
        error: a composition has its order with any symmetric base: leave out the `class`
         --> weights-class.toml:2:9
          |
        2 | class = "separable"
          |         ^^^^^^^^^^^
    "#]]
    .assert_eq(&refused("weights-class", &class, Some(2)));
    let (status, errors) = failure(&["refine", "no-such-file.toml"]);
    assert_eq!(status, Some(2));
    assert!(
        errors.contains("cannot read `no-such-file.toml`"),
        "{errors}"
    );
    let (status, errors) = failure(&["refine", "x.toml", "--digits", "0"]);
    assert_eq!(status, Some(2));
    assert!(
        errors.contains("expected a whole number from 1 to 10000"),
        "{errors}"
    );
}

#[test]
fn refine_refuses_digits_that_belong_to_no_method() {
    let told = |name: &str, from: &str, to: &str| {
        assert!(VERLET.contains(from), "{from}");
        refused(name, &VERLET.replace(from, to), Some(1))
    };
    expect![[r#"
        error: the kicks sum to 0.9, not to 1; the nearest certified solution is 0.10 away
         --> sum.toml:6:8
          |
        6 | kick = ["0.5", "0.4"]
          |        ^^^^^^^^^^^^^^
    "#]]
    .assert_eq(&told("sum", "\"0.5\", \"0.5\"", "\"0.5\", \"0.4\""));
    expect![[r#"
        error: order 4 for separable H takes 2 conditions, and a symmetric composition with these coefficients has 1 unknown: too few to certify a solution
         --> few.toml:3:9
          |
        3 | order = 4
          |         ^
    "#]].assert_eq(&told("few", "order = 2", "order = 4"));
    // The triple jump with two wrong digits that leave the sum as it is.
    let jump = "[claim]\nclass = \"separable\"\norder = 4\n\n[printed]\nkick = [\"0.675603595979829\", \"-0.175603595979829\", \"-0.175603595979829\", \"0.675603595979829\"]\ndrift = [\"1.351208191959658\", \"-1.702415383919316\", \"1.351207191959658\", \"0\"]\n";
    expect![[r#"
        error: the nearest certified solution of order 4 for separable H is 0.0000010 away from the digits, and they allow for 1.0e-10; the farthest is drift[1] = -1.7024143839193152681…
         --> jump.toml:7:31
          |
        7 | drift = ["1.351208191959658", "-1.702415383919316", "1.351207191959658", "0"]
          |                               ^^^^^^^^^^^^^^^^^^^^
    "#]].assert_eq(&refused("jump", jump, Some(1)));
    let weights = WEIGHTS.replace("-0.65796309", "-0.65796209");
    expect![[r#"
        error: the weights sum to 1.00000099, not to 1; the nearest certified solution is 0.0000010 away
         --> weights.toml:5:11
          |
        5 | weights = ["0.41449077", "0.41449077", "-0.65796209", "0.41449077", "0.41449077"]
          |           ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
    "#]].assert_eq(&refused("weights", &weights, Some(1)));
}

/// All four are roundings of `kick = (1 − x, x)`, `drift = (1/(2x), 1 − 1/(2x))` with `x = 0.750251234`.
const COARSE: &str = r#"[claim]
class = "separable"
order = 2

[printed]
kick = ["0.2497", "0.7503"]
drift = ["0.666443422", "0.333556578"]
"#;

/// Predescu et al. 2012 and Omelyan, Mryglod & Folk 2003, 4MN5FV, as lattice codes have it: the two in the middle are
/// what is left of 1 in doubles.
const LATTICE: &str = r#"[claim]
class = "separable"
order = 4

[printed]
kick = ["0.08398315262876693", "0.6822365335719091", "-0.26621968620067603", "-0.26621968620067603", "0.6822365335719091", "0.08398315262876693"]
drift = ["0.2539785108410595", "-0.03230286765269967", "0.55664871362328034", "-0.03230286765269967", "0.2539785108410595", "0"]
"#;

fn refined(name: &str, text: &str) -> Value {
    let path = written(name, text);
    let json = stdout(&["refine", &path, "--digits", "30", "--format", "json"]);
    serde_json::from_str(&json).expect("JSON")
}

/// Which coefficients have wrong digits, and whether it is known that no method has all.
fn wrong(found: &Value) -> (Vec<&str>, &str) {
    let wrong = found["wrong_digits"].as_array().expect("a list").iter();
    let names = wrong.map(|wrong| wrong["coefficient"].as_str().expect("a name"));
    (
        names.collect(),
        found["printed_digits"].as_str().expect("a word"),
    )
}

#[test]
fn free_coefficients_move_within_their_last_place() {
    let found = refined("coarse", COARSE);
    assert_eq!(wrong(&found), (vec![], "all"));
    // Each coefficient rounds to its print.
    for (key, places) in [("kick", 4), ("drift", 9)] {
        for entry in found[key].as_array().expect("a list") {
            let value = |key: &str| -> f64 {
                let text = entry[key].as_str().expect("a text");
                text.parse().expect(text)
            };
            let distance = (value("decimal") - value("printed")).abs();
            assert!(distance <= 0.5 * 10f64.powi(-places) + 1e-16, "{entry}");
        }
    }
    // A unit more in the last place of one drift: 1/(2x) and 1 − 1/(2x) cannot round to both.
    let twin = COARSE.replace("0.333556578", "0.333556580");
    let found = refined("coarse-twin", &twin);
    let (names, digits) = wrong(&found);
    assert_eq!((names.len(), digits), (1, "excluded"), "{found}");
    assert!(names[0].starts_with("drift"), "{names:?}");
}

#[test]
fn digits_of_lattice_codes_are_not_blamed() {
    let found = refined("lattice", LATTICE);
    assert_eq!(wrong(&found), (vec!["drift[2]"], "excluded"));
    assert_eq!(found["could_be_wrong_instead"][0], "kick[0]");
    // The four that were published, with the middle ones to fewer places.
    let published = LATTICE
        .replace("-0.26621968620067603", "-0.266219686200676")
        .replace("0.55664871362328034", "0.556648713623280");
    assert_eq!(
        wrong(&refined("lattice-published", &published)),
        (vec![], "all")
    );
}

#[test]
fn a_wrong_digit_is_found_among_right_ones() {
    // The method has a free coefficient with four places, so that a proof for all that round to them would take smaller
    // boxes.
    let path = path("mclachlan-1995-ss9");
    let text = std::fs::read_to_string(&path).expect("a file");
    assert_eq!(wrong(&refined("ss9", &text)), (vec![], "all"));
    let file = parsed(&text);
    let drift = file["printed"]["drift"][1].as_str().expect("a decimal");
    let changed = format!("{}7{}", &drift[..14], &drift[15..]);
    assert_ne!(drift, changed);
    let found = refined("ss9-wrong", &text.replace(drift, &changed));
    assert_eq!(
        wrong(&found),
        (vec!["drift[1]", "drift[7]"], "not found"),
        "{found}"
    );
}

/// What is left of 1 beside a fraction is exactly that.
#[test]
fn fractions_are_exact() {
    let fraction = "[claim]\nclass = \"separable\"\norder = 4\n\n[printed]\nkick = [\"0\", \"7/10\", \"-1/5\", \"-1/5\", \"7/10\"]\ndrift = [\"0.17803803316981432\", \"-0.071071040644672856\", \"0.78606601494971706\", \"-0.071071040644672856\", \"0.17803803316981432\"]\n";
    let found = refined("fraction", fraction);
    assert_eq!(wrong(&found), (vec![], "all"));
    assert_eq!(found["kick"][1]["exact"], "7/10");
    let decimals = fraction.replace("7/10", "0.7").replace("-1/5", "-0.2");
    let found = refined("decimals", &decimals);
    assert_eq!(wrong(&found), (vec![], "all"));
    // A fraction that is not the exact number, however near: there is one free kick, and it is −1/5.
    let near = fraction.replace("7/10", "700000000000001/1000000000000000");
    let found = refined("near-fraction", &near);
    assert!(!wrong(&found).0.is_empty(), "{found}");
}

/// Verlet with kicks that are off by a tenth, as a splitting, as weights, and as an array: the solution is printed with its distance.
#[test]
fn the_nearest_solution_is_printed_however_far_it_is() {
    for (name, text, first, number) in [
        (
            "far.toml",
            "[claim]\nclass = \"separable\"\norder = 2\n[printed]\nkick = [\"0.4\", \"0.6\"]\ndrift = [\"1\", \"0\"]\n",
            "certified: an exact method of order 2 for separable H exists within 0.10 of the printed digits",
            "kick[0]   0.50000000000000000000",
        ),
        (
            "far-weights.toml",
            "[claim]\norder = 4\n[printed]\nweights = [\"1.3\", \"-1.6\", \"1.3\"]\n",
            "certified: an exact method of order 4 with any symmetric basic method exists within 0.11 of the printed digits",
            "weight[0]   1.3512071919596576340",
        ),
        (
            "far-array.toml",
            "[claim]\nclass = \"general\"\norder = 2\n[printed]\na = [[\"0.501\"]]\nb = [\"1.001\"]\n",
            "proved: an exact method is within 0.0011 of the printed digits",
            "a[0][0]   0.50000000000000000000",
        ),
    ] {
        let path = written(name, text);
        let (status, message) = failure(&["refine", &path]);
        assert!(status == Some(1), "{message}");
        let found = stdout(&["refine", &path, "--nearest", "--digits", "20"]);
        assert!(
            found.starts_with(first) && found.contains(number),
            "{found}"
        );
    }
}
