//! What the tables of other libraries claim and what is proved of them.

use std::collections::BTreeMap;
use std::path::Path;

use crate::run::{failure, symplectic};
use serde_json::Value;
use symplectic_compiler::{Error, Limits};
use symplectic_tools::audit::{Audit, Row, Verdict};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tableaux/libraries");

fn table(convention: &str, claim: &str, numbers: &str) -> Result<Row, Error> {
    let text = format!(
        "library = \"L\"\nversion = \"V\"\nsource = \"S\"\n{convention}\n[[table]]\nname = \"T\"\n{claim}\n[table.numbers]\n{numbers}\n"
    );
    let mut audit = Audit::default();
    audit.add("tables.toml", &text, &Limits::default())?;
    Ok(audit.rows.swap_remove(0))
}

/// A table of a file of `tableaux/libraries/`, stepped as by another library or by steps of a file.
fn library_row(file: &str, name: &str, convention: &str) -> Row {
    let text = std::fs::read_to_string(format!("{FOLDER}/{file}.toml")).expect("read");
    let at = text
        .find(&format!("[[table]]\nname = \"{name}\""))
        .expect(name);
    let end = text[at + 1..].find("[[table]]");
    let mut table = text[at..end.map_or(text.len(), |end| at + 1 + end)].to_owned();
    // The same list under the other library's letter.
    let letters = [("\nb = ", "\nahat = "), ("\nahat = ", "\nb = ")];
    for (letter, other) in letters {
        let foreign = (convention == "sundials") == (other == "\nahat = ");
        if matches!(convention, "sundials" | "sciml") && foreign {
            table = table.replace(letter, other);
        }
    }
    let convention = match convention.starts_with('[') {
        true => convention.to_owned(),
        false => format!("convention = \"{convention}\""),
    };
    let head = format!("library = \"L\"\nversion = \"V\"\nsource = \"S\"\n{convention}\n");
    let mut audit = Audit::default();
    audit
        .add("tables.toml", &(head + &table), &Limits::default())
        .expect("a row");
    audit.rows.swap_remove(0)
}

/// The whole audit: what is found for the libraries, and that all of it is seen in steps of the pendulum too.
#[test]
#[ignore = "thorough"]
fn the_audit_finds_exactly_the_known_deviations_of_the_libraries() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let [json, page] = ["audit.json", "audit.html"].map(|name| folder.join(name));
    let output = symplectic(&[
        "audit",
        FOLDER,
        "--json",
        json.to_str().expect("text"),
        "--html",
        page.to_str().expect("text"),
    ]);
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.success(),
        "{printed}{}",
        String::from_utf8_lossy(&output.stderr)
    );

    let text = std::fs::read_to_string(&json).expect("written");
    let found: Value = serde_json::from_str(&text).expect("JSON");
    let rows = found["rows"].as_array().expect("rows");
    let text = |row: &Value, key: &str| row[key].as_str().unwrap_or_default().to_owned();
    // Nothing is reported that is not seen, within 0.05.
    for row in rows {
        assert_eq!(row["explained"], true, "{row}");
        for (proved, seen) in [
            ("general", "seen_coupled"),
            ("separable", "seen_relativistic"),
            ("nystrom", "seen_quadratic"),
        ] {
            let proved = row[proved]["order"].as_f64().expect("an order");
            let seen = row[seen].as_f64().expect("an order");
            assert!((proved - seen).abs() < 0.05, "{row}");
        }
        assert!(
            !text(row, "version").is_empty() && text(row, "source").starts_with("https://"),
            "{row}"
        );
    }
    let mut tables: BTreeMap<String, usize> = BTreeMap::new();
    for row in rows {
        *tables.entry(text(row, "library")).or_default() += 1;
    }
    let tables: Vec<String> = tables
        .into_iter()
        .map(|(library, count)| format!("{library}: {count}"))
        .collect();
    expect_test::expect![[r#"
        AMUSE Huayno: 8
        AMUSE symple: 7
        Boost.Numeric.Odeint: 3
        OrdinaryDiffEqSymplecticRK of SciML: 18
        PETSc TSBASICSYMPLECTIC: 8
        Principia: 31
        REBOUND: 21
        RungeKutta.jl: 79
        SUNDIALS ARKODE SPRKStep: 12
        SUNDIALS ARKODE SplittingStep: 8
        TeNPy: 4
        galpy: 3
        jorbit: 3
        nodepy: 2
        pyHamSys: 19
        scirs2-integrate: 7
        xsuite: 4"#]]
    .assert_eq(&tables.join("\n"));
    let mut differences: Vec<String> = Vec::new();
    for row in rows.iter().filter(|row| row["verdict"] != "as_claimed") {
        differences.push(format!(
            "{}: {} {}, proved {} for T(p) + U(q), {} for quadratic T, not {}",
            text(row, "name"),
            row["claim"]["order"],
            text(&row["claim"], "class"),
            row["separable"]["order"],
            row["nystrom"]["order"],
            text(
                &row[row["claim"]["class"].as_str().expect("a class")],
                "violated"
            ),
        ));
    }
    expect_test::expect![[r#"
        RK42: 4 general, proved 1 for T(p) + U(q), 1 for quadratic T, not q[q]
        LobattoIIIF(2): 4 general, proved 2 for T(p) + U(q), 2 for quadratic T, not q[q,q]
        LobattoIIIF(3): 6 general, proved 4 for T(p) + U(q), 4 for quadratic T, not q[q^4]
        LobattoIIIF(4): 8 general, proved 6 for T(p) + U(q), 6 for quadratic T, not q[q^6]
        LobattoIIIF̄(2): 4 general, proved 2 for T(p) + U(q), 2 for quadratic T, not q[q,q]
        LobattoIIIF̄(3): 6 general, proved 4 for T(p) + U(q), 4 for quadratic T, not q[q^4]
        LobattoIIIF̄(4): 8 general, proved 6 for T(p) + U(q), 6 for quadratic T, not q[q^6]
        LobattoIIIG(2): 4 general, proved 2 for T(p) + U(q), 2 for quadratic T, not q[q,q]
        LobattoIIIG(3): 6 general, proved 4 for T(p) + U(q), 4 for quadratic T, not q[q^4]
        LobattoIIIG(4): 8 general, proved 6 for T(p) + U(q), 6 for quadratic T, not q[q^6]
        LobattoIIIFIIIF̄(2): 4 general, proved 2 for T(p) + U(q), 2 for quadratic T, not q[q,q]
        LobattoIIIFIIIF̄(3): 6 general, proved 4 for T(p) + U(q), 4 for quadratic T, not q[q^4]
        LobattoIIIFIIIF̄(4): 8 general, proved 6 for T(p) + U(q), 6 for quadratic T, not q[q^6]
        LobattoIIIF̄IIIF(2): 4 general, proved 2 for T(p) + U(q), 2 for quadratic T, not q[q,q]
        LobattoIIIF̄IIIF(3): 6 general, proved 4 for T(p) + U(q), 4 for quadratic T, not q[q^4]
        LobattoIIIF̄IIIF(4): 8 general, proved 6 for T(p) + U(q), 6 for quadratic T, not q[q^6]
        KraaijevangerSpijker: 2 general, proved 1 for T(p) + U(q), 1 for quadratic T, not q[q]
        McAte4: 4 nystrom, proved 3 for T(p) + U(q), 3 for quadratic T, not p[q,q,q]
        CalvoSanz4: 4 separable, proved 3 for T(p) + U(q), 3 for quadratic T, not p[q,q,q]
        McAte42: 4 separable, proved 1 for T(p) + U(q), 1 for quadratic T, not p[q]
        McAte5: 5 nystrom, proved 3 for T(p) + U(q), 3 for quadratic T, not p[q,q,q]
        CompositionMethod::eighth_order: 8 separable, proved 0 for T(p) + U(q), 0 for quadratic T, not q
        ARKODE_SPRK_MCLACHLAN_4_4: 4 separable, proved 3 for T(p) + U(q), 4 for quadratic T, not q[p,p,p]
        ARKODE_SPRK_MCLACHLAN_5_6: 5 separable, proved 3 for T(p) + U(q), 5 for quadratic T, not q[p,p,p]
        yoshida4: 4 separable, proved 6 for T(p) + U(q), 6 for quadratic T, not q[p^6]"#]]
    .assert_eq(&differences.join("\n"));
    // The method of SciML of order 4 by its name which is in no class of it.
    let row = |name: &str| rows.iter().find(|row| row["name"] == name).expect(name);
    assert_eq!(row("McAte42")["separable"]["order"], 1);
    assert_eq!(row("KahanLi8")["right_places"][1], 26);
    assert!(row("KahanLi8")["right_places"][0].as_u64() >= Some(25));
    assert!(row("ARKODE_SPRK_CANDY_ROZMUS_4_4")["right_places"].is_null());

    // The orders that are observed for every H, for T(p) + U(q) and for quadratic T, in the line of the table.
    let line = |name: &str| {
        printed
            .lines()
            .find(|line| line.contains(name))
            .expect(name)
    };
    assert!(line("ARKODE_SPRK_MCLACHLAN_4_4").contains("  1.00, 3.00, 4.00  "));
    // A page on its own.
    let page = std::fs::read_to_string(&page).expect("written");
    assert!(
        page.starts_with("<!doctype html>")
            && page.contains("McAte42: claimed 4 for separable H, proved 1"),
        "{page}"
    );
    for foreign in ["<script", "<link", "<img", "src=", "@import", "url("] {
        assert!(!page.contains(foreign), "{foreign}");
    }
    assert!(
        printed.ends_with(&format!(
            "{} tables; for {} the proved order is not the claimed order, 0 unexplained\n",
            rows.len(),
            differences.len()
        )),
        "{printed}"
    );
}

/// A page names its sources apart, links only to addresses of the web, and decimals without an exact method have no right places.
#[test]
fn audit_page_lists_each_source_separately_and_links_only_to_the_web() {
    let text = |version: &str, convention: &str, numbers: &str| {
        format!(
            "library = \"L\"\nversion = \"{version}\"\nsource = \"javascript:alert(1)\"\nconvention = \"{convention}\"\n[[table]]\nname = \"T\"\norder = 1\nclass = \"separable\"\n[table.numbers]\n{numbers}\n"
        )
    };
    let mut audit = Audit::default();
    let near = "a = [\"0.29289321\", \"0.70710678\"]\nahat = [\"0.70710678\", \"0.29299322\"]";
    for (version, convention, numbers) in [
        ("1", "sundials", near),
        ("2", "sundials", "a = [\"1\"]\nahat = [\"1\"]"),
        ("2", "principia", "a = [\"1\"]\nb = [\"1\"]"),
    ] {
        let text = text(version, convention, numbers);
        audit
            .add("tables.toml", &text, &Limits::default())
            .expect("rows");
    }
    let page = audit.html();
    assert_eq!(page.matches("<h2>L</h2>").count(), 3, "{page}");
    assert!(!page.contains("href"), "{page}");
    assert_eq!(audit.rows[0].right_places, None);
}

/// pyHamSys drifts first by the same letters where its README says so.
#[test]
fn the_convention_decides_whether_pyhamsys_kicks_or_drifts_first() {
    let claim = "order = 4\nclass = \"separable\"";
    let numbers = "a = [\"1\", \"0\"]\nb = [\"1/2\", \"1/2\"]";
    let [kick, drift] = ["pyhamsys", "pyhamsys-drift-first"].map(|convention| {
        table(&format!("convention = \"{convention}\""), claim, numbers).expect("a row")
    });
    assert!(kick.convention.starts_with("kick b_i, drift a_i ("));
    assert!(drift.convention.starts_with("drift b_i, kick a_i ("));
    assert_eq!((kick.separable.order, drift.separable.order), (2, 2));
}

/// A file names its own lists: of drifts and kicks, of half of them, and of the fractions of a composition.
#[test]
fn steps_of_a_file_are_the_lists_that_it_names() {
    let claim = "order = 4\nclass = \"separable\"";
    let steps = |keys: &str| format!("[steps]\n{keys}\nevidence = \"E\"");
    let (w, middle) = ("1/(2 - cbrt(2))", "-cbrt(2)/(2 - cbrt(2))");
    for (keys, numbers, words) in [
        (
            "drift = \"c\"\nkick = \"d\"\nfirst = \"kick\"",
            format!(
                "c = [\"{w}\", \"{middle}\", \"{w}\", \"0\"]\nd = [\"{w}/2\", \"({w} + {middle})/2\", \"({w} + {middle})/2\", \"{w}/2\"]"
            ),
            "kick d_i, drift c_i (E)",
        ),
        (
            "drift = \"c\"\nkick = \"d\"\nfirst = \"drift\"\nsymmetric = true",
            format!("c = [\"{w}/2\", \"({w} + {middle})/2\"]\nd = [\"{w}\", \"{middle}\"]"),
            "drift c_i, kick d_i, and back (E)",
        ),
        (
            "weights = \"w\"\nbase = \"velocity-verlet\"",
            format!("w = [\"{w}\", \"{middle}\", \"{w}\"]"),
            "velocity-verlet by the fractions w_i (E)",
        ),
        (
            "weights = \"w\"\nbase = \"position-verlet\"\nsymmetric = true",
            format!("w = [\"{w}\"]"),
            "position-verlet by the fractions w_i, and back (E)",
        ),
    ] {
        let row = table(&steps(keys), claim, &numbers).expect(keys);
        assert_eq!((row.separable.order, row.verdict), (4, Verdict::AsClaimed));
        assert_eq!(row.convention, words);
    }
    let numbers = "c = [\"1/2\", \"1/2\"]\nd = [\"1\"]\nw = [\"1\"]";
    for (keys, message) in [
        (
            "convention = \"sundials\"\n[steps]\ndrift = \"c\"\nkick = \"d\"\nevidence = \"E\""
                .to_owned(),
            "`convention` and `[steps]` both state how numbers are stepped",
        ),
        (
            steps("drift = \"c\"\nweights = \"w\""),
            "`[steps]` has `drift` and `kick`, with `first` if the lists are equally long, or `weights` and `base`",
        ),
        (
            steps("drift = \"c\"\nkick = \"d\"\nfirst = \"last\""),
            "unknown variant `last`, expected `drift` or `kick`",
        ),
        (
            steps("drift = \"c\"\nkick = \"k\""),
            "`[steps]` has no numbers `d`; it has c, k",
        ),
        (
            steps("weights = \"w\"\nbase = \"gauss-2\""),
            "`[steps]` has no numbers `c`; it has w",
        ),
    ] {
        let error = table(&keys, claim, numbers).expect_err(message);
        assert!(error.to_string().contains(message), "{error}");
    }
    let implicit = table(
        &steps("weights = \"w\"\nbase = \"gauss-2\""),
        claim,
        "w = [\"1\"]",
    );
    let error = implicit.expect_err("implicit").to_string();
    assert!(
        error.contains("the base of a composition must be a splitting"),
        "{error}"
    );
}

/// The composition of scirs2-integrate of order 8 has its middle weight twice: its sum is 0.2031 instead of 1. With this weight once it is a
/// method of order 8.
#[test]
fn the_middle_weight_of_scirs2_written_twice_leaves_order_0() {
    let convention =
        "[steps]\nweights = \"coefficients\"\nbase = \"velocity-verlet\"\nevidence = \"E\"";
    let orders = [("CompositionMethod::eighth_order", 0), ("Yoshida8", 8)];
    for (name, order) in orders {
        let row = library_row("scirs2", name, convention);
        let found = (row.separable.order, row.nystrom.order, row.explained);
        assert_eq!(found, (order, order, true), "{name}");
        assert_eq!(row.claim.order, 8, "{name}");
    }
    let row = library_row("scirs2", "CompositionMethod::eighth_order", convention);
    // The middle weight.
    let residual = row.separable.residual.expect("a residual");
    assert!(residual.starts_with("-0.79688793935"), "{residual}");
}

/// The methods of pyHamSys for quadratic T have order 4 instead of 6 where the other part goes first.
#[test]
fn nystrom_methods_need_their_order_of_flows() {
    for (own, other, name) in [
        ("pyhamsys", "pyhamsys-drift-first", "RKN6b"),
        ("pyhamsys-drift-first", "pyhamsys", "RKN6a"),
    ] {
        for (convention, order) in [(own, 6), (other, 4)] {
            let row = library_row(own, name, convention);
            assert_eq!(row.nystrom.order, order, "{name} {convention}");
        }
    }
}

/// The slopes that are known of tables of SciML and SUNDIALS, as the library steps them and with the two functions exchanged: for
/// `T = p²/2`, and for `T = √(1 + p²)`. SUNDIALS kicks first by `ahat` and SciML drifts first by `b`, so that each
/// is the other with the functions exchanged. Runs of SUNDIALS 7.1.1 had 4.01 and 5.01; 2.98 and 3.01; exchanged 3.01 and 2.99.
#[test]
fn known_slopes_are_observed() {
    for (file, name, claim, own, exchanged) in [
        ("sciml", "McAte4", 4, [3.0, 3.0], [4.0, 3.0]),
        ("sciml", "McAte5", 5, [3.0, 3.0], [5.0, 3.0]),
        ("sciml", "CalvoSanz4", 4, [3.0, 3.0], [4.0, 3.0]),
        ("sciml", "McAte42", 4, [1.0, 1.0], [1.0, 1.0]),
        (
            "sundials",
            "ARKODE_SPRK_MCLACHLAN_4_4",
            4,
            [4.0, 3.0],
            [3.0, 3.0],
        ),
        (
            "sundials",
            "ARKODE_SPRK_MCLACHLAN_5_6",
            5,
            [5.0, 3.0],
            [3.0, 3.0],
        ),
    ] {
        let other = if file == "sciml" { "sundials" } else { "sciml" };
        for (convention, slopes) in [(file, own), (other, exchanged)] {
            let row = library_row(file, name, convention);
            assert_eq!(row.claim.order, claim, "{name}");
            let seen = [row.seen_quadratic, row.seen_relativistic].map(|seen| seen.expect("seen"));
            let proved = [row.nystrom.order, row.separable.order];
            for ((seen, proved), slope) in seen.into_iter().zip(proved).zip(slopes) {
                // The next power of h is about 10⁻⁹ of the error here.
                assert!(
                    (seen - slope).abs() < 1e-3,
                    "{name} {convention}: {seen}, not {slope}"
                );
                assert_eq!(proved as f64, slope, "{name} {convention}");
            }
            assert!(row.explained, "{name} {convention}");
        }
    }
}

/// A claim for every H is compared with steps of a pendulum that is not separable: Ruth's method and Lobatto IIIA–IIIB, which has one
/// false entry, have order 3 or 4 for other Hamiltonians only.
#[test]
fn claims_for_every_hamiltonian_are_observed() {
    let claim = |order| format!("order = {order}\nclass = \"general\"");
    let ruth = table(
        "convention = \"sundials\"",
        &claim(3),
        "a = [\"2/3\", \"-2/3\", \"1\"]\nahat = [\"7/24\", \"3/4\", \"-1/24\"]",
    );
    let lobatto = |x: &str, y: &str, z: &str| {
        let numbers = format!(
            "a = [\"0\", \"0\", \"0\", \"5/24\", \"1/3\", \"-1/24\", \"1/6\", \"2/3\", \"1/6\"]\n\
             a_tilde = [\"{x}\", \"-1/6\", \"0\", \"{y}\", \"1/3\", \"0\", \"{z}\", \"5/6\", \"0\"]\n\
             b = [\"1/6\", \"2/3\", \"1/6\"]\nb_tilde = [\"1/6\", \"2/3\", \"1/6\"]"
        );
        table("convention = \"rungekutta.jl\"", &claim(4), &numbers)
    };
    let rows = [
        (ruth.expect("a row"), [1, 3, 3]),
        (lobatto("1/6", "1/6", "1/6").expect("a row"), [4, 4, 4]),
        (lobatto("1/3", "1/12", "1/3").expect("a row"), [2, 2, 4]),
    ];
    for (row, orders) in &rows {
        let proved = [row.general.order, row.separable.order, row.nystrom.order];
        assert_eq!(proved, *orders, "{row:?}");
        let seen = [row.seen_coupled, row.seen_relativistic, row.seen_quadratic];
        for (seen, order) in seen.into_iter().zip(orders) {
            let difference = seen.expect("seen") - *order as f64;
            assert!(difference.abs() < 1e-3, "{row:?}");
        }
        let less = row.general.order < row.claim.order;
        assert_eq!(row.verdict == Verdict::LessThanClaimed, less);
        assert!(row.explained);
    }
    let audit = Audit {
        rows: rows.into_iter().map(|(row, _)| row).collect(),
    };
    let page = audit.html();
    for text in [
        "<th>observed for each</th>",
        "<td>1.00, 3.00, 3.00</td>",
        "<td>4.00, 4.00, 4.00</td>",
        "claimed 3 for general H, proved 1; the condition of q[q] is off by -17/18. Orders for every H, for T(p) + U(q) and for \
         quadratic T: 1, 3, 3; observed 1.00, 3.00, 3.00.",
    ] {
        assert!(page.contains(text), "{text}: {page}");
    }
}

/// Whether the proof has the claimed order depends on who goes first, and on each digit.
#[test]
fn the_first_flow_and_every_digit_decide_the_proved_order() {
    let drifts = r#"["0.515352837431122936", "-0.085782019412973646", "0.441583023616466524", "0.128846158365384185"]"#;
    let kicks = r#"["0.134496199277431089", "-0.224819803079420806", "0.756320000515668291", "0.334003603286321425"]"#;
    let claim = "order = 4\nclass = \"nystrom\"";
    let sundials = table(
        "convention = \"sundials\"",
        claim,
        &format!("a = {drifts}\nahat = {kicks}"),
    )
    .expect("a row");
    assert_eq!(
        (
            sundials.nystrom.order,
            sundials.separable.order,
            sundials.verdict
        ),
        (4, 3, Verdict::AsClaimed)
    );
    let sciml = table(
        "convention = \"sciml\"",
        claim,
        &format!("a = {drifts}\nb = {kicks}"),
    )
    .expect("a row");
    assert_eq!(
        (sciml.nystrom.order, sciml.verdict, sciml.explained),
        (3, Verdict::LessThanClaimed, true)
    );
    let (tree, residual) = (
        sciml.nystrom.violated.expect("a tree"),
        sciml.nystrom.residual.expect("a residual"),
    );
    assert_eq!(tree, "p[q,q,q]");
    // Σ b̃ c³ − 1/4 in doubles, by hand.
    let (mut position, mut sum) = (0.0_f64, -0.25);
    for (drift, kick) in [
        (0.134496199277431, 0.5153528374311229),
        (-0.2248198030794208, -0.0857820194129736),
        (0.7563200005156682, 0.4415830236164665),
        (0.3340036032863214, 0.1288461583653841),
    ] {
        position += drift;
        sum += kick * position * position * position;
    }
    let residual: f64 = residual.trim_end_matches('…').parse().expect("a number");
    assert!((residual - sum).abs() < 1e-11, "{residual} {sum}");
    // A wrong digit, the sixth, leaves order 0 or 1, and no exact method of a higher order is near.
    let wrong = kicks.replace("0.756320000515668291", "0.756310000515668291");
    let wrong = table(
        "convention = \"sundials\"",
        claim,
        &format!("a = {drifts}\nahat = {wrong}"),
    )
    .expect("a row");
    assert!(
        wrong.nystrom.order <= 1 && wrong.verdict == Verdict::LessThanClaimed,
        "{wrong:?}"
    );
}

/// The table RK42 of RungeKutta.jl has order 1 for one wrong entry: Butcher (2016), p. 102, has 2 in its place.
#[test]
fn one_wrong_entry_lowers_the_order_of_rk42_from_four_to_one() {
    let claim = "convention = \"rungekutta.jl\"";
    let row = |entry| {
        let numbers = format!(
            "a = [\"0\", \"0\", \"0\", \"0\", \"1/4\", \"0\", \"0\", \"0\", \"0\", \"1/2\", \"0\", \"0\", \"1\", \"-2\", \"{entry}\", \"0\"]\n\
             b = [\"1/6\", \"0\", \"2/3\", \"1/6\"]"
        );
        table(claim, "order = 4\nclass = \"general\"", &numbers).expect("a row")
    };
    let (butcher, library) = (row("2"), row("1"));
    assert_eq!(
        (butcher.general.order, butcher.verdict),
        (4, Verdict::AsClaimed)
    );
    assert_eq!(
        (library.general.order, library.verdict, library.explained),
        (1, Verdict::LessThanClaimed, true)
    );
    // Σ b c − 1/2 with the last c 0 instead of 1.
    assert_eq!(library.general.residual.as_deref(), Some("-1/6"));
}

/// The Lobatto weights integrate polynomials to degree 2s − 3, so that no method with them and C(s − 1) has the order 2s that
/// RungeKutta.jl claims of Lobatto IIIF: Σ b c² is 1/2 instead of 1/3 with two stages.
#[test]
fn lobatto_weights_bound_the_order() {
    let row = table(
        "convention = \"rungekutta.jl\"",
        "order = 4\nclass = \"general\"",
        "a = [\"1/12\", \"-1/12\", \"7/12\", \"5/12\"]\nb = [\"1/2\", \"1/2\"]",
    )
    .expect("a row");
    assert_eq!((row.general.order, row.explained), (2, true));
    assert_eq!(
        (
            row.general.violated.as_deref(),
            row.general.residual.as_deref()
        ),
        (Some("q[q,q]"), Some("1/6"))
    );
}

/// A method that has more than its library claims is a row, and so is one that has no order at all.
#[test]
fn the_audit_reports_claims_that_are_too_low_or_too_high() {
    let verlet = "a = [\"1\", \"0\"]\nahat = [\"1/2\", \"1/2\"]";
    let row = |order| {
        table(
            "convention = \"sundials\"",
            &format!("order = {order}\nclass = \"separable\""),
            verlet,
        )
        .expect("a row")
    };
    assert_eq!(
        (row(1).verdict, row(2).verdict, row(9).verdict),
        (
            Verdict::MoreThanClaimed,
            Verdict::AsClaimed,
            Verdict::LessThanClaimed
        )
    );
    let none = table(
        "convention = \"sundials\"",
        "order = 1\nclass = \"separable\"",
        "a = [\"1\"]\nahat = [\"1/2\"]",
    )
    .expect("a row");
    assert_eq!(
        (none.separable.order, none.verdict),
        (0, Verdict::LessThanClaimed)
    );
}

#[test]
fn wrong_files_are_refused_at_their_place() {
    let claim = "order = 1\nclass = \"separable\"";
    let long = format!("a = [{0}]\nahat = [{0}]", "\"1/50\", ".repeat(50));
    for (convention, claim, numbers, message) in [
        (
            "",
            claim,
            "a = [\"1\"]\nahat = [\"1\"]",
            "tables.toml, column 1: `convention` is missing: whether kicks or drifts come first",
        ),
        (
            "convention = \"gsl\"",
            claim,
            "",
            "tables.toml, line 4, column 14: unknown library `gsl`; known here: sciml, sundials",
        ),
        (
            "convention = \"sundials\"",
            "order = 1\nclass = \"all\"",
            "a = [\"1\"]\nahat = [\"1\"]",
            "line 8, column 9: unknown class `all`; known here: general, separable, nystrom",
        ),
        (
            "convention = \"sundials\"",
            claim,
            "a = [\"1\"]",
            "line 6, column 8: the numbers `ahat` are missing, which `sundials` has",
        ),
        (
            "convention = \"sundials\"",
            claim,
            "a = [\"1\"]\nahat = [\"1\"]\nb = [\"1\"]",
            "line 6, column 8: `sundials` has no numbers `b`; it has a, ahat",
        ),
        (
            "convention = \"sundials\"",
            claim,
            "a = [\"1\", \"x\"]\nahat = [\"1\", \"0\"]",
            "line 10, column 12: found `x`, which has no value here",
        ),
        (
            "convention = \"sundials\"",
            claim,
            "a = [\"1\"]\nahat = [\"1\", \"0\", \"0\"]",
            "1 drifts `a` and 3 kicks `ahat`",
        ),
        (
            "convention = \"sundials\"",
            claim,
            "a = [1.0]\nahat = [\"1\"]",
            "line 10, column 6: not a file of tables: invalid type: floating point",
        ),
        // Texts are numbers to their end.
        (
            "convention = \"sundials\"",
            claim,
            "a = [\"1/2 & 99\"]\nahat = [\"1\"]",
            "line 10, column 11: found `&`",
        ),
        (
            "convention = \"sundials\"",
            claim,
            "a = [\"0 % 3\"]\nahat = [\"1\"]",
            "line 10, column 9: found `%`",
        ),
        (
            "convention = \"sundials\"",
            claim,
            "a = [\"1 ! x\"]\nahat = [\"1\"]",
            "line 10, column 9: found `!`",
        ),
        (
            "convention = \"sundials\"",
            claim,
            "a = [\"1 # x\"]\nahat = [\"1\"]",
            "line 10, column 9: found `#`",
        ),
        (
            "convention = \"sundials\"",
            claim,
            &long,
            "50 stages exceed the limit of 36",
        ),
        (
            "convention = \"sundials\"\nlicence = 1",
            claim,
            "",
            "not a file of tables: unknown field `licence`",
        ),
    ] {
        let found = table(convention, claim, numbers)
            .expect_err(message)
            .to_string();
        assert!(found.contains(message), "{found}\n{message}");
    }
    // No result replaces a table or the other result.
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let [tables, result] = ["overwritten.toml", "overwritten.out"].map(|name| folder.join(name));
    let verlet = std::fs::read_to_string(format!("{FOLDER}/petsc.toml")).expect("read");
    std::fs::write(&tables, verlet).expect("written");
    let [tables, result] = [&tables, &result].map(|path| path.to_str().expect("text"));
    for arguments in [
        ["audit", tables, "--json", tables, "--html", result],
        ["audit", tables, "--json", result, "--html", result],
    ] {
        let (status, message) = failure(&arguments);
        assert!(
            status == Some(2) && message.contains("would overwrite an input or the other output"),
            "{message}"
        );
    }
    let (status, message) = failure(&["audit", "no-such-folder"]);
    assert!(
        status == Some(2) && message.contains("cannot read `no-such-folder`"),
        "{message}"
    );
}
