//! Refining Butcher arrays on the command line.

use std::path::Path;

use crate::run::{failure, stdout};
use expect_test::expect;
use serde_json::Value;
use symplectic_compiler::arithmetic::rounding::Decimal;
use symplectic_compiler::{Definition, Limits, Tableau};

/// A file of this test.
fn written(name: &str, text: &str) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let path = folder.join(format!("refine-table-{name}.toml"));
    std::fs::write(&path, text).expect("a file");
    path.display().to_string()
}

fn derive(definition: &str) -> Tableau {
    let definition = Definition::parse(definition).expect("a definition");
    definition.derive(&Limits::default()).expect("a tableau")
}

fn quoted(numbers: impl IntoIterator<Item = Decimal>) -> String {
    let texts = numbers.into_iter().map(|number| format!("\"{number}\""));
    format!("[{}]", texts.collect::<Vec<_>>().join(", "))
}

/// The arrays of a tableau to some significant digits: those for positions, and for a pair those for momenta.
fn arrays(tableau: &Tableau, digits: usize, pair: bool) -> String {
    let numbers = tableau.numbers().map(|number| number.decimal(digits));
    let matrix = |rows: &[Vec<Decimal>]| {
        let rows = rows.iter().map(|row| quoted(row.iter().cloned()));
        format!("[{}]", rows.collect::<Vec<_>>().join(", "))
    };
    let mut text = format!(
        "a = {}\nb = {}\nc = {}\n",
        matrix(&numbers.a),
        quoted(numbers.b.clone()),
        quoted(numbers.c.clone()),
    );
    if pair {
        text.push_str(&format!(
            "a_tilde = {}\nb_tilde = {}\nc_tilde = {}\n",
            matrix(&numbers.a_tilde),
            quoted(numbers.b_tilde.clone()),
            quoted(numbers.c_tilde.clone()),
        ));
    }
    text
}

fn file(class: &str, order: usize, properties: &[&str], arrays: &str) -> String {
    format!(
        "[claim]\nclass = \"{class}\"\norder = {order}\nproperties = {properties:?}\n\n[printed]\n{arrays}"
    )
}

fn refined(name: &str, text: &str) -> Value {
    let json = stdout(&[
        "refine",
        &written(name, text),
        "--digits",
        "40",
        "--format",
        "json",
    ]);
    serde_json::from_str(&json).expect("JSON")
}

fn refused(name: &str, text: &str) -> String {
    let path = written(name, text);
    let (status, errors) = failure(&["refine", &path]);
    assert_eq!(status, Some(1), "{errors}");
    errors.replace(&path, "file")
}

/// Every number of a refined table is that of the tableau, to 40 digits.
fn assert_numbers(found: &Value, tableau: &Tableau) {
    let numbers = tableau
        .numbers()
        .map(|number| number.decimal(40).to_string());
    let decimal = |cell: &Value| cell["decimal"].as_str().expect("a text").to_owned();
    let list = |value: &Value| -> Vec<String> {
        let cells = value.as_array().expect("a list").iter();
        cells.map(decimal).collect()
    };
    assert_eq!(list(&found["b"]), numbers.b);
    assert_eq!(list(&found["c"]), numbers.c);
    for (key, rows) in [("a", &numbers.a), ("a_tilde", &numbers.a_tilde)] {
        if let Some(found) = found[key].as_array() {
            assert_eq!(&found.iter().map(list).collect::<Vec<_>>(), rows);
        }
    }
}

#[test]
fn collocation_methods_are_those_of_their_nodes() {
    for (nodes, order, pair, properties) in [
        (
            "gauss(2)",
            4,
            false,
            &["symplectic", "symmetric", "collocation"][..],
        ),
        (
            "gauss(3)",
            6,
            false,
            &["symplectic", "symmetric", "collocation"],
        ),
        (
            "gauss(4)",
            8,
            true,
            &["symplectic", "symmetric", "collocation"],
        ),
        (
            "gauss(10)",
            20,
            false,
            &["symplectic", "symmetric", "collocation"],
        ),
        ("lobatto(3)", 4, true, &["symplectic", "symmetric"]),
        (
            "lobatto(5)",
            8,
            true,
            &["symplectic", "symmetric", "collocation"],
        ),
        ("lobatto(4)", 6, false, &["symmetric", "collocation"]),
        ("radau-right(3)", 5, false, &["collocation"]),
        ("radau-right(2)", 3, true, &["symplectic"]),
        ("chebyshev(3)", 4, false, &["symmetric", "collocation"]),
    ] {
        let (_, stages) = nodes.split_once('(').expect(nodes);
        let tableau = derive(&format!("basis: polynomial({stages}, nodes: {nodes}"));
        for digits in [12, 16, 20] {
            let name = format!("{}-{digits}", nodes.replace(['(', ')'], "-"));
            let text = file(
                "general",
                order,
                properties,
                &arrays(&tableau, digits, pair),
            );
            let found = refined(&name, &text);
            assert_eq!(found["evidence"], "proved", "{name}");
            let method = found["method"].as_str().expect("a method");
            assert_eq!(found["printed_digits"], "all", "{name}: {found}");
            // Three equal weights: √2/4 is one free number, which moves within the last places.
            if !nodes.starts_with("chebyshev") {
                assert!(method.contains(nodes), "{method}");
                assert_numbers(&found, &tableau);
            }
        }
        // One order more is refuted.
        let higher = file(
            "general",
            order + 1,
            properties,
            &arrays(&tableau, 16, pair),
        );
        let told = refused("higher", &higher);
        assert!(
            told.contains("order") || told.contains("away from"),
            "{nodes}: {told}"
        );
    }
}

/// Positions and momenta exchanged, and stages in another order.
#[test]
fn pairs_are_found_in_any_order() {
    let tableau = derive("basis: polynomial(3), nodes: lobatto(3), exchange: true");
    let text = file("general", 4, &["symplectic"], &arrays(&tableau, 16, true));
    let found = refined("exchanged", &text);
    assert_eq!(found["printed_digits"], "all");
    assert_numbers(&found, &tableau);
    let reversed = "a = [[\"0.25\", \"0.538675134594813\"], [\"-0.038675134594813\", \"0.25\"]]\nb = [\"0.5\", \"0.5\"]\n";
    let found = refined("reversed", &file("general", 4, &["symplectic"], reversed));
    assert_eq!(found["printed_digits"], "all");
    let entry = &found["a"][0][1]["decimal"];
    assert_eq!(entry, "0.5386751345948128822545743902509787278238");
}

#[test]
fn wrong_digits_are_named() {
    let radau = derive("basis: polynomial(2), nodes: radau-right(2)");
    let right = arrays(&radau, 16, false);
    assert!(right.contains("-0.08333333333333333"), "{right}");
    let wrong = right.replace("-0.08333333333333333", "-0.08333333333343333");
    let path = written("radau-wrong", &file("general", 3, &["collocation"], &wrong));
    expect![[r#"
        proved: an exact method is within 1.0e-13 of the printed digits
          method       polynomial(2) at radau-right(2)
          claim        order 3 for general H, that of the quadrature, proved
                       collocation, proved
          wrong digits in 1 of 8 numbers, marked below
                       proved: no method of this kind as claimed rounds to all printed digits
          note         c[0] = 0.3333333333333333 is not the sum of row 0 of `a`, which is 0.33333333333323337000

          a[0][0]   0.41666666666666666667
          a[0][1]  -0.083333333333333333333  (the print is off by 1.0e-13)
          a[1][0]   0.75000000000000000000
          a[1][1]   0.25000000000000000000

          b[0]      0.75000000000000000000
          b[1]      0.25000000000000000000

          c[0]      0.33333333333333333333
          c[1]      1.0000000000000000000
    "#]].assert_eq(&stdout(&["refine", &path, "--digits", "20"]));
    // A digit too early to be one of this method.
    let far = right.replace("-0.08333333333333333", "-0.0834333333333333");
    expect![[r#"
        error: c[0] = 0.3333333333333333 is not the sum of row 0 of `a`, which is 0.33323333333333340000
         --> file:9:6
          |
        9 | c = ["0.3333333333333333", "1.000000000000000"]
          |      ^^^^^^^^^^^^^^^^^^^^
    "#]].assert_eq(&refused("radau-far", &file("general", 3, &[], &far)));
    // A node that is not the row sum, and a claim that is too high.
    let node = right.replace("c = [\"0.3333333333333333\"", "c = [\"0.3333333333433333\"");
    expect![[r#"
        error: c[0] = 0.3333333333433333 is not the sum of row 0 of `a`, which is 0.33333333333333337000
         --> file:9:6
          |
        9 | c = ["0.3333333333433333", "1.000000000000000"]
          |      ^^^^^^^^^^^^^^^^^^^^
    "#]].assert_eq(&refused("radau-node", &file("general", 3, &[], &node)));
    expect![[r#"
        error: no collocation method with 2 nodes, 1 of them as printed exactly, has order 4
         --> file:3:9
          |
        3 | order = 4
          |         ^
    "#]]
    .assert_eq(&refused("radau-high", &file("general", 4, &[], &right)));
    let symplectic = file("general", 3, &["symplectic"], &right);
    expect![[r#"
        error: the method is not symplectic, which is proved
         --> file:4:15
          |
        4 | properties = ["symplectic"]
          |               ^^^^^^^^^^^^
    "#]]
    .assert_eq(&refused("radau-symplectic", &symplectic));
}

/// With one free node, another method is near in which ten numbers are a little off: they are not to blame.
#[test]
fn refine_names_only_the_wrong_entry_of_a_collocation_table() {
    let exact = derive("basis: polynomial(3), nodes: [1/7, 2/5, 6/7]");
    let right = arrays(&exact, 16, false);
    let found = refined("nodes-right", &file("general", 3, &["collocation"], &right));
    assert_eq!(found["printed_digits"], "all", "{found}");
    let entry = exact.numbers().map(|number| number.decimal(16)).a[1][2].to_string();
    assert_eq!(right.matches(&entry).count(), 1);
    let digit = entry.len() - 4;
    let changed = if &entry[digit..=digit] == "5" {
        "6"
    } else {
        "5"
    };
    let wrong = right.replace(
        &entry,
        &format!("{}{changed}{}", &entry[..digit], &entry[digit + 1..]),
    );
    let without_nodes = |text: &str| text.split("c = ").next().unwrap_or_default().to_owned();
    for printed in [wrong.clone(), without_nodes(&wrong)] {
        let found = refined(
            "nodes-wrong",
            &file("general", 3, &["collocation"], &printed),
        );
        let names: Vec<&str> = found["wrong_digits"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|wrong| wrong["coefficient"].as_str().expect("a name"))
            .collect();
        assert_eq!(names, ["a[1][2]"], "{found}");
        let notes = found["notes"].to_string();
        assert!(!notes.contains("may as well"), "{notes}");
    }
    // Two of them: neither alone leads to a method, and no number is called wrong.
    let second = exact.numbers().map(|number| number.decimal(16)).b[0].to_string();
    assert_eq!(right.matches(&second).count(), 1);
    let last = second.len() - 4;
    let changed = if &second[last..=last] == "5" {
        "6"
    } else {
        "5"
    };
    let both = wrong.replace(
        &second,
        &format!("{}{changed}{}", &second[..last], &second[last + 1..]),
    );
    let both = without_nodes(&both);
    let path = written("nodes-both", &file("general", 3, &["collocation"], &both));
    let text = stdout(&["refine", &path]);
    assert!(text.contains("wrong digits not told: "), "{text}");
    assert!(text.contains("no change of one number alone"), "{text}");
}

/// Qin & Zhang 1992 with two stages, and Sanz-Serna & Abia 1991, three steps of the midpoint rule as in the triple jump.
#[test]
fn symplectic_diagonally_implicit_methods_are_certified() {
    let qin_zhang = "a = [[\"0.25\", \"0.0\"], [\"0.5\", \"0.25\"]]\nb = [\"0.5\", \"0.5\"]\nc = [\"0.25\", \"0.75\"]\n";
    let found = refined("qin-zhang", &file("general", 2, &["symplectic"], qin_zhang));
    assert_eq!(found["printed_digits"], "all");
    let abia = "a = [[\"0.675603595979829\", \"0\", \"0\"], [\"1.351207191959658\", \"-0.851207191959658\", \"0\"], [\"1.351207191959658\", \"-1.702414383919315\", \"0.675603595979829\"]]\nb = [\"1.351207191959658\", \"-1.702414383919315\", \"1.351207191959658\"]\nc = [\"0.675603595979829\", \"0.5\", \"0.324396404020171\"]\n";
    let found = refined(
        "abia",
        &file("general", 4, &["symplectic", "symmetric"], abia),
    );
    assert_eq!(found["evidence"], "certified");
    assert_eq!(found["printed_digits"], "all", "{found}");
    // 1/(2 − ∛2).
    let b = &found["b"][0]["decimal"];
    assert_eq!(b, "1.351207191959657634047687808971460826922");
    let told = refused("abia-high", &file("general", 6, &["symplectic"], abia));
    assert!(told.contains("too few to certify"), "{told}");
}

#[test]
fn explicit_pairs_are_splittings() {
    let ruth = "a = [[\"0\", \"0\"], [\"1.0\", \"0\"]]\nb = [\"1.0\", \"0.0\"]\na_tilde = [[\"0.5\", \"0\"], [\"0.5\", \"0.5\"]]\nb_tilde = [\"0.5\", \"0.5\"]\n";
    let found = refined("verlet", &file("separable", 2, &["symplectic"], ruth));
    assert_eq!(found["evidence"], "certified");
    assert_eq!(found["printed_digits"], "all", "{found}");
    let told = refused("verlet-general", &file("general", 2, &[], ruth));
    assert!(told.contains("class = \"separable\""), "{told}");
}

/// Radau IA and Lobatto IIIB are the partners of collocation methods, here without these.
#[test]
#[ignore = "thorough"]
fn refine_recognises_partners_of_collocation_methods() {
    for (nodes, order, properties) in [
        ("lobatto(3)", 4, &["symmetric"][..]),
        ("lobatto(5)", 8, &["symmetric"]),
        ("radau-left(2)", 3, &[]),
        ("radau-left(4)", 7, &[]),
    ] {
        let (_, stages) = nodes.split_once('(').expect(nodes);
        let pair = derive(&format!("basis: polynomial({stages}, nodes: {nodes}"));
        for digits in [12, 16, 20] {
            let numbers = pair.numbers().map(|number| number.decimal(digits));
            let rows = numbers
                .a_tilde
                .iter()
                .map(|row| quoted(row.iter().cloned()));
            let arrays = format!(
                "a = [{}]\nb = {}\nc = {}\n",
                rows.collect::<Vec<_>>().join(", "),
                quoted(numbers.b_tilde.clone()),
                quoted(numbers.c_tilde.clone()),
            );
            let name = format!("partner-{}-{digits}", nodes.replace(['(', ')'], "-"));
            let found = refined(&name, &file("general", order, properties, &arrays));
            assert_eq!(found["evidence"], "proved", "{name}");
            assert_eq!(found["printed_digits"], "all", "{name}: {found}");
            let method = found["method"].as_str().expect("a method");
            assert!(
                method.contains("partner") && method.contains(nodes),
                "{method}"
            );
            let exact = pair.numbers().map(|number| number.decimal(40).to_string());
            for (row, wanted) in exact.a_tilde.iter().enumerate() {
                for (column, wanted) in wanted.iter().enumerate() {
                    assert_eq!(found["a"][row][column]["decimal"], **wanted, "{name}");
                }
            }
            let told = refused(
                "partner-high",
                &file("general", order + 1, properties, &arrays),
            );
            assert!(told.contains("has order"), "{told}");
            let told = refused(
                "partner-symplectic",
                &file("general", order, &["symplectic"], &arrays),
            );
            assert!(told.contains("not symplectic, which is proved"), "{told}");
        }
    }
}

/// Crouzeix 1975, two stages, diagonally implicit.
const CROUZEIX: &str = "a = [[\"0.7886751345948129\", \"0\"], [\"-0.5773502691896258\", \"0.7886751345948129\"]]\nb = [\"0.5\", \"0.5\"]\n";
/// The same with too few digits for surds.
const COARSE: &str =
    "a = [[\"0.78867513\", \"0\"], [\"-0.57735027\", \"0.78867513\"]]\nb = [\"0.5\", \"0.5\"]\n";
/// Chipman 1971, Lobatto IIIC with three stages.
const LOBATTO_IIIC: &str = "a = [[\"0.166666666666667\", \"-0.333333333333333\", \"0.166666666666667\"], [\"0.166666666666667\", \"0.416666666666667\", \"-0.083333333333333\"], [\"0.166666666666667\", \"0.666666666666667\", \"0.166666666666667\"]]\nb = [\"0.166666666666667\", \"0.666666666666667\", \"0.166666666666667\"]\nc = [\"0\", \"0.5\", \"1.0\"]\n";
/// Kutta 1901.
const KUTTA: &str = "a = [[\"0\", \"0\", \"0\", \"0\"], [\"0.5\", \"0\", \"0\", \"0\"], [\"0\", \"0.5\", \"0\", \"0\"], [\"0\", \"0\", \"1.0\", \"0\"]]\nb = [\"0.1666666666666667\", \"0.3333333333333333\", \"0.3333333333333333\", \"0.1666666666666667\"]\n";

#[test]
#[ignore = "thorough"]
fn fractions_and_surds_are_recognised() {
    for (name, order, arrays) in [
        ("crouzeix", 3, CROUZEIX),
        ("lobatto-iiic", 4, LOBATTO_IIIC),
        ("kutta", 4, KUTTA),
    ] {
        let found = refined(name, &file("general", order, &[], arrays));
        assert_eq!(found["evidence"], "proved", "{name}");
        assert_eq!(found["printed_digits"], "all", "{name}: {found}");
        let told = refused("surds-high", &file("general", order + 1, &[], arrays));
        let wanted = format!("have order {order} for general H, which is proved");
        assert!(told.contains(&wanted), "{told}");
        let symplectic = file("general", order, &["symplectic"], arrays);
        let told = refused("surds-symplectic", &symplectic);
        assert!(told.contains("not symplectic, which is proved"), "{told}");
    }
    let found = refined("crouzeix-surd", &file("general", 3, &[], CROUZEIX));
    // (3 + √3)/6.
    let entry = &found["a"][0][0]["decimal"];
    assert_eq!(entry, "0.7886751345948128822545743902509787278238");
}

/// Nørsett 1974, three stages, with a root of a cubic on the diagonal.
const NOERSETT: &str = "a = [[\"1.0685790213016288\", \"0\", \"0\"], [\"-0.5685790213016288\", \"1.0685790213016288\", \"0\"], [\"2.1371580426032576\", \"-3.2743160852065152\", \"1.0685790213016288\"]]\nb = [\"0.1288864005157204\", \"0.7422271989685592\", \"0.1288864005157204\"]\n";
/// Three stages with free coefficients, `a_ij = b_j/2 + w_ij/b_i` with a skew `w`.
const SYMPLECTIC: &str = "a = [[\"0.1511881448353374\", \"0.4592403719568859\", \"-0.4787285167922233\"], [\"-0.0746293200334268\", \"0.1841662248053720\", \"0.3727630952280548\"], [\"0.7419754225213008\", \"-0.0486259102625607\", \"0.1646456303592907\"]]\nb = [\"0.3023762896706747\", \"0.3683324496107439\", \"0.3292912607185814\"]\nc = [\"0.1317000000000000\", \"0.4823000000000000\", \"0.8579951426180307\"]\n";
/// A pair of two implicit halves, neither of which is collocation.
const PAIR: &str = "a = [[\"0.2137482918460000\", \"0.1178837462510000\"], [\"0.3319283746501900\", \"0.2869146078539478\"]]\nb = [\"0.4137829174631700\", \"0.5862170825368300\"]\na_tilde = [[\"0.2000346256171700\", \"0.1159654718817197\"], [\"0.3305743554844900\", \"0.2993024746828822\"]]\nb_tilde = [\"0.4137829174631700\", \"0.5862170825368300\"]\n";
/// A symmetric diagonally implicit method with four stages, not steps of the midpoint rule.
const SYMMETRIC: &str = "a = [[\"1.5128673650746718\", \"0\", \"0\", \"0\"], [\"-0.0052905628145118\", \"0.2000000000000000\", \"0\", \"0\"], [\"-0.0052905628145118\", \"0.5052905628145118\", \"0.3052905628145118\", \"0\"], [\"-0.0052905628145118\", \"0.5052905628145118\", \"0.5052905628145118\", \"-1.5181579278891836\"]]\nb = [\"-0.0052905628145118\", \"0.5052905628145118\", \"0.5052905628145118\", \"-0.0052905628145118\"]\n";

/// Equations that depend on others are evaluated, and that is told.
#[test]
#[ignore = "thorough"]
fn what_is_verified_is_not_called_proved() {
    let text = file("general", 4, &[], NOERSETT);
    let found = refined("noersett", &text);
    assert_eq!(found["evidence"], "verified", "{found}");
    assert_eq!(found["printed_digits"], "all", "{found}");
    // x³ − 3x²/2 + x/2 − 1/24 = 0.
    let entry = &found["a"][0][0]["decimal"];
    assert_eq!(entry, "1.068579021301628806418833975960049381291");
    let text = stdout(&["refine", &written("noersett", &text)]);
    assert!(text.starts_with("verified: a method is within"), "{text}");
    assert!(text.contains("verified to 2^-316, not proved"), "{text}");
    assert!(text.contains("6 of 8 equations hold, certified"), "{text}");
}

/// The equations lead to fractions and surds where the digits do not.
#[test]
fn numbers_are_recognised_once_they_are_refined() {
    let found = refined("surds-coarse", &file("general", 3, &[], COARSE));
    assert_eq!(found["evidence"], "proved", "{found}");
    assert_eq!(found["printed_digits"], "all", "{found}");
    let entry = &found["a"][0][0]["decimal"];
    assert_eq!(entry, "0.7886751345948128822545743902509787278238");
    let wrong = LOBATTO_IIIC.replace("-0.333333333333333", "-0.333333333433333");
    let found = refined("surds-wrong", &file("general", 4, &[], &wrong));
    assert_eq!(found["evidence"], "proved", "{found}");
    assert_eq!(found["printed_digits"], "excluded", "{found}");
    let wrong = found["wrong_digits"].as_array().expect("a list");
    assert_eq!(wrong.len(), 1, "{found}");
    assert_eq!(wrong[0]["coefficient"], "a[0][1]");
}

#[test]
#[ignore = "thorough"]
fn refine_certifies_tables_without_a_known_construction() {
    for (name, order, properties, arrays) in [
        ("symplectic", 4, &["symplectic"][..], SYMPLECTIC),
        ("pair", 2, &["symplectic"], PAIR),
        ("symmetric", 4, &["symmetric"], SYMMETRIC),
    ] {
        let name = format!("equations-{name}");
        let found = refined(&name, &file("general", order, properties, arrays));
        assert_eq!(found["evidence"], "certified", "{name}: {found}");
        assert_eq!(found["printed_digits"], "all", "{name}: {found}");
        let told = refused(
            "equations-high",
            &file("general", order + 1, properties, arrays),
        );
        let none = told.contains("no exact method") || told.contains("away from");
        assert!(none, "{name}: {told}");
    }
    let told = refused(
        "equations-both",
        &file("general", 4, &["symplectic", "symmetric"], SYMPLECTIC),
    );
    assert!(
        told.contains("no exact method") || told.contains("away from"),
        "{told}"
    );
    // A wrong digit, here in a number that all others determine.
    let wrong = SYMPLECTIC.replace("0.3727630952280548", "0.3727630952580548");
    let wrong = wrong.split("c = ").next().expect("a and b");
    let found = refined(
        "equations-wrong",
        &file("general", 4, &["symplectic"], wrong),
    );
    assert_eq!(found["printed_digits"], "excluded", "{found}");
    let wrong = found["wrong_digits"].as_array().expect("a list");
    let names = wrong.iter().map(|wrong| &wrong["coefficient"]);
    let notes = found["notes"].to_string();
    assert_eq!(names.len(), 1, "{found}");
    let mut names = names.map(|name| name.as_str().expect("a name"));
    assert!(
        notes.contains("a[1][2]") || names.any(|name| name == "a[1][2]"),
        "{found}"
    );
    // Too much work.
    let row = |i: usize| {
        quoted_text(
            &(0..7)
                .map(|j| format!("0.{}739182736451", 1 + (i + j * j) % 9))
                .collect::<Vec<_>>(),
        )
    };
    let rows: Vec<String> = (0..7).map(row).collect();
    let many = format!("a = [{}]\nb = {}\n", rows.join(", "), row(3));
    let told = refused("equations-many", &file("general", 9, &[], &many));
    assert!(told.contains("up to 6 stages"), "{told}");
}

fn quoted_text(numbers: &[String]) -> String {
    let texts: Vec<String> = numbers
        .iter()
        .map(|number| format!("\"{number}\""))
        .collect();
    format!("[{}]", texts.join(", "))
}

#[test]
fn other_arrays_and_files_are_refused() {
    let sdirk = CROUZEIX;
    let told = refused(
        "crouzeix-collocation",
        &file("general", 3, &["collocation"], sdirk),
    );
    assert!(
        told.contains("not the arrays of a collocation method"),
        "{told}"
    );
    let bad = |name: &str, text: &str| {
        let (status, errors) = failure(&["refine", &written(name, text)]);
        assert_eq!(status, Some(2), "{errors}");
        errors
    };
    let short = file("general", 1, &[], "a = [[\"1\"]]\nb = [\"1\", \"0\"]\n");
    assert!(bad("short", &short).contains("a length of 1 in `a`, and `b` has 2"));
    let class = file("everything", 1, &[], "a = [[\"1\"]]\nb = [\"1\"]\n");
    assert!(bad("class", &class).contains("unknown class `everything`"));
    let property = file("general", 1, &["stable"], "a = [[\"1\"]]\nb = [\"1\"]\n");
    assert!(bad("property", &property).contains("unknown property `stable`"));
    let missing = file("general", 1, &[], "a = [[\"1\"]]\n");
    assert!(bad("missing", &missing).contains("missing field `b`"));
    let many = vec!["\"0\""; 17].join(", ");
    let many = file("general", 1, &[], &format!("a = []\nb = [{many}]\n"));
    assert!(bad("many", &many).contains("tables of 1 to 16"));
    let long = format!("\"0.{}\"", "1".repeat(500));
    let long = file("general", 1, &[], &format!("a = [[{long}]]\nb = [\"1\"]\n"));
    assert!(bad("long", &long).contains("more than 400 decimal places"));
}
