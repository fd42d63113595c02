//! What the binary prints.

use std::io::Read;
use std::process::{Command, Stdio};

use crate::run::stdout;
use expect_test::expect;

#[test]
fn derive_prints_the_tableau_of_the_readme() {
    expect![[r#"
        3 stages, basis polynomial(3), nodes lobatto(3)

          c │ a                      c̃ │ ã
        ────┼─────────────────     ────┼───────────────
          0 │    0    0      0       0 │ 1/6  -1/6    0
        1/2 │ 5/24  1/3  -1/24     1/2 │ 1/6   1/3    0
          1 │  1/6  2/3    1/6       1 │ 1/6   5/6    0
        ────┼─────────────────     ────┼───────────────
          b │  1/6  2/3    1/6       b̃ │ 1/6   2/3  1/6

        properties
          symplectic          yes  proved
          symmetric           yes  proved
          consistent          yes  proved
          equal_matrices      no   refuted  a_11 − ã_11 = -1/6
          explicit            no   refuted  these stages need one another: Q2 → P1 → Q2
          first_row_zero      yes  proved
          stiffly_accurate    yes  proved
          first_same_as_last  yes  proved   Q_s = q1 is Q_1 of the next step
          positive_weights    yes  proved
          constrained         yes  proved   det (A Ã) ≈ 0.0208333
          nonholonomic        no   refuted  steps with non-holonomic constraints have order 2 at most

        order
          general    4, proved; not 5: q[q^4] has the weight 5/24 instead of 1/5, a difference of 1/120; error constant 0.034929…
          separable  4, proved; not 5: q[p^4] has the weight 5/24 instead of 1/5, a difference of 1/120; error constant 0.007879…
          nystrom    4, proved; not 5: p[q^4] has the weight 5/24 instead of 1/5, a difference of 1/120; error constant 0.006113…

        stability on the oscillator, ν = hω
          trace: (ν⁴ − 22ν² + 48)/(ν² + 24)
          stable for ν in (0, 2*sqrt(2)) ∪ (2*sqrt(3), 2*sqrt(6)), proved
          phase: order 4, error 1/2880 ν^5, proved
    "#]]
    .assert_eq(&stdout(&[
        "derive",
        "--basis",
        "polynomial(3)",
        "--nodes",
        "lobatto(3)",
    ]));
}

#[test]
fn irrational_and_long_entries_are_readable() {
    expect![[r#"
        gauss-3, 3 stages, basis polynomial(3), nodes gauss(3)
        source: Kuntzmann 1961;
                Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964);
                Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3;
                built as in Marsden & West 2001, Theorem 2.6.2

                        c │ a
        ──────────────────┼──────────────────────────────────────────────────────────
        1/2 - sqrt(15)/10 │               5/36  2/9 - sqrt(15)/15  5/36 - sqrt(15)/30
                      1/2 │ 5/36 + sqrt(15)/24                2/9  5/36 - sqrt(15)/24
        1/2 + sqrt(15)/10 │ 5/36 + sqrt(15)/30  2/9 + sqrt(15)/15                5/36
        ──────────────────┼──────────────────────────────────────────────────────────
                        b │               5/18                4/9                5/18

        ã = a, b̃ = b, c̃ = c: the same for momenta.

        properties
          symplectic          yes  proved
          symmetric           yes  proved
          consistent          yes  proved
          equal_matrices      yes  proved
          explicit            no   refuted  these stages need one another: Q1 → P1 → Q1
          first_row_zero      no   refuted  a_11 = 5/36
          stiffly_accurate    no   refuted  b_1 − a_31 = 0.00978944401531…
          first_same_as_last  no   refuted  a_11 = 5/36
          positive_weights    yes  proved
          constrained         no   refuted  a_11 = 5/36
          nonholonomic        no   refuted  steps with non-holonomic constraints have order 2 at most

        order
          general    6, proved; not 7: q[q^6] has the weight 57/400 instead of 1/7, a difference of -1/2800; error constant 0.002278…
          separable  6, proved; not 7: q[p^6] has the weight 57/400 instead of 1/7, a difference of -1/2800; error constant 0.000233…
          nystrom    6, proved; not 7: p[q^6] has the weight 57/400 instead of 1/7, a difference of -1/2800; error constant 0.000115…

        stability on the oscillator, ν = hω
          trace: (28800 − 12960ν² + 528ν⁴ − 2ν⁶)/(ν⁶ + 24ν⁴ + 720ν² + 14400)
          stable for ν in (0, ∞) (P-stable), proved
          phase: order 6, error -1/100800 ν^7, proved
          R(z) = (z³ + 12z² + 60z + 120)/(120 − 60z + 12z² − z³), proved
          A-stable: yes, L-stable: no, on the imaginary axis up to ∞, proved
    "#]]
    .assert_eq(&stdout(&["show", "gauss-3"]));
    expect![[r#"
        radau-right-3, 3 stages, basis polynomial(3), nodes radau-right(3)
        source: Radau IIA: Ehle 1969, Axelsson 1969;
                as a symplectic pair: Sun, J. Comput. Math. 11 (1993);
                built as in Marsden & West 2001, Theorem 2.6.2

                       c │ a
        ─────────────────┼──────────────────────────────────────────────────────────────────────────
        2/5 - sqrt(6)/10 │     11/45 - 7*sqrt(6)/360  37/225 - 169*sqrt(6)/1800  -2/225 + sqrt(6)/75
        2/5 + sqrt(6)/10 │ 37/225 + 169*sqrt(6)/1800      11/45 + 7*sqrt(6)/360  -2/225 - sqrt(6)/75
                       1 │          4/9 - sqrt(6)/36           4/9 + sqrt(6)/36                  1/9
        ─────────────────┼──────────────────────────────────────────────────────────────────────────
                       b │          4/9 - sqrt(6)/36           4/9 + sqrt(6)/36                  1/9

                       c̃ │ ã
        ─────────────────┼────────────────────────────────────────────────
        2/5 - sqrt(6)/10 │    1/5 - sqrt(6)/120  1/5 - 11*sqrt(6)/120    0
        2/5 + sqrt(6)/10 │ 1/5 + 11*sqrt(6)/120     1/5 + sqrt(6)/120    0
                       1 │     1/2 - sqrt(6)/12      1/2 + sqrt(6)/12    0
        ─────────────────┼────────────────────────────────────────────────
                       b̃ │     4/9 - sqrt(6)/36      4/9 + sqrt(6)/36  1/9

        properties
          symplectic          yes  proved
          symmetric           no   refuted  no order of the stages makes the tableau equal to its adjoint
          consistent          yes  proved
          equal_matrices      no   refuted  a_11 − ã_11 = 2/45 - sqrt(6)/90
          explicit            no   refuted  these stages need one another: Q1 → P1 → Q1
          first_row_zero      no   refuted  a_11 = 0.196815477224…
          stiffly_accurate    yes  proved
          first_same_as_last  no   refuted  a_11 = 0.196815477224…
          positive_weights    yes  proved
          constrained         no   refuted  a_11 = 0.196815477224…
          nonholonomic        no   refuted  steps with non-holonomic constraints have order 2 at most

        order
          general    5, proved; not 6: q[q^5] has the weight 101/600 instead of 1/6, a difference of 1/600; error constant 0.009249…
          separable  5, proved; not 6: q[p^5] has the weight 101/600 instead of 1/6, a difference of 1/600; error constant 0.001399…
          nystrom    5, proved; not 6: p[q^5] has the weight 101/600 instead of 1/6, a difference of 1/600; error constant 0.000830…

        stability on the oscillator, ν = hω
          trace: (7200 − 3312ν² + 162ν⁴ − ν⁶)/(3ν⁴ + 144ν² + 3600)
          stable for ν in (0, 3.05248911040…) ∪ (3.22862518301…, -3 + sqrt(69)) ∪ (3 + sqrt(69), 12.1761360726…), proved
          phase: order 6, error 1/252000 ν^7, proved
    "#]]
    .assert_eq(&stdout(&["show", "radau-right-3", "--digits", "8"]));
    // Entries without a short form are decimals.
    expect![[r#"
        gauss-4, 4 stages, basis polynomial(4), nodes gauss(4)
        source: Kuntzmann 1961;
                Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964);
                Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3;
                built as in Marsden & West 2001, Theorem 2.6.2

                  c │ a
        ────────────┼───────────────────────────────────────────────────────────────────────────────
        0.069431844 │ 1/8 - sqrt(30)/144        -0.026604180         0.012627463       -0.0035551497
         0.33000948 │         0.18811812  1/8 + sqrt(30)/144        -0.027880429        0.0067355006
         0.66999052 │         0.16719192          0.35395301  1/8 + sqrt(30)/144        -0.014190695
         0.93056816 │         0.17748257          0.31344511          0.35267676  1/8 - sqrt(30)/144
        ────────────┼───────────────────────────────────────────────────────────────────────────────
                  b │  1/4 - sqrt(30)/72   1/4 + sqrt(30)/72   1/4 + sqrt(30)/72   1/4 - sqrt(30)/72

        ã = a, b̃ = b, c̃ = c: the same for momenta.

        Entries with a decimal point are correctly rounded to 8 significant digits; all others are exact.

        properties
          symplectic          yes  proved
          symmetric           yes  proved
          consistent          yes  proved
          equal_matrices      yes  proved
          explicit            no   refuted  these stages need one another: Q1 → P1 → Q1
          first_row_zero      no   refuted  a_11 = 0.0869637112844…
          stiffly_accurate    no   refuted  b_1 − a_41 = -0.00355514968580…
          first_same_as_last  no   refuted  a_11 = 0.0869637112844…
          positive_weights    yes  proved
          constrained         no   refuted  a_11 = 0.0869637112844…
          nonholonomic        no   refuted  steps with non-holonomic constraints have order 2 at most

        order
          general    8, proved; not 9: q[q^8] has the weight 1633/14700 instead of 1/9, a difference of -1/44100; error constant 0.000172…
          separable  8, proved; not 9: q[p^8] has the weight 1633/14700 instead of 1/9, a difference of -1/44100; error constant 0.000008…
          nystrom    8, proved; not 9: p[q^8] has the weight 1633/14700 instead of 1/9, a difference of -1/44100; error constant 0.000002…

        stability on the oscillator, ν = hω
          trace: (2ν⁸ − 1520ν⁶ + 138720ν⁴ − 2620800ν² + 5644800)/(ν⁸ + 40ν⁶ + 2160ν⁴ + 100800ν² + 2822400)
          stable for ν in (0, ∞) (P-stable), proved
          phase: order 8, error -1/25401600 ν^9, proved
          R(z) = (z⁴ + 20z³ + 180z² + 840z + 1680)/(z⁴ − 20z³ + 180z² − 840z + 1680), proved
          A-stable: yes, L-stable: no, on the imaginary axis up to ∞, proved
    "#]].assert_eq(&stdout(&["show", "gauss-4", "--digits", "8"]));
}

#[test]
fn toml_is_readable() {
    expect![[r##"
        # A symplectic partitioned Runge–Kutta method. `symplectic check` derives it anew and compares every entry.
        format = 2
        name = "stormer-verlet"
        stages = 2

        [provenance]
        basis = "polynomial(2)"
        nodes = "lobatto(2)"
        tier = "node algebra"
        source = "Verlet 1967; Marsden & West 2001, §2.6.2; Hairer, Lubich & Wanner, Geometric Numerical Integration, §I.1.4; Leok & Zhang, Example 3 and the remark after it (from the basis 1, cos(πτ), the same tableau); the same method as lobatto-2 and newton-cotes-2 and leok-zhang-3"

        [exact]
        # The nodes are the roots of the node polynomial in ascending order; coefficients of 1, x, x^2, …
        node_polynomial = ["0", "-1", "1"]
        # b_i = b(c_i) and b̃_i = b̃(c_i): polynomials in a node, coefficients of 1, x, x^2, …
        b = ["1/2", "0"]
        b_tilde = ["1/2", "0"]
        # a_ij = a(c_i, c_j) and ã_ij = ã(c_i, c_j): polynomials in two nodes x = c_i and y = c_j.
        # A row has the coefficients of 1, x, x^2, … beside one power of y.
        a = [
            ["0", "1/2"], # 1
            ["0",   "0"], # y
        ]
        a_tilde = [
            [ "1/2", "0"], # 1
            ["-1/2", "0"], # y
        ]

        [decimals]
        # Significant digits, correctly rounded.
        digits = 5
        c = ["0", "1.0000"]
        c_tilde = ["0.50000", "0.50000"]
        b = ["0.50000", "0.50000"]
        b_tilde = ["0.50000", "0.50000"]
        a = [
            [      "0",       "0"], # i = 1
            ["0.50000", "0.50000"], # i = 2
        ]
        a_tilde = [
            ["0.50000", "0"], # i = 1
            ["0.50000", "0"], # i = 2
        ]

        [properties]
        symplectic         = { holds = true, evidence = "proved" }
        symmetric          = { holds = true, evidence = "proved" }
        consistent         = { holds = true, evidence = "proved" }
        equal_matrices     = { holds = false, evidence = "refuted", witness = "a_11 − ã_11 = -1/2" }
        explicit           = { holds = true, evidence = "proved", witness = "Q1, P1 = P2, Q2" }
        first_row_zero     = { holds = true, evidence = "proved" }
        stiffly_accurate   = { holds = true, evidence = "proved" }
        first_same_as_last = { holds = true, evidence = "proved", witness = "Q_s = q1 is Q_1 of the next step" }
        positive_weights   = { holds = true, evidence = "proved" }
        constrained        = { holds = true, evidence = "proved", witness = "det (A Ã) ≈ 0.500000" }
        nonholonomic       = { holds = true, evidence = "proved", witness = "order 2: Σ b c² = 1/2 ≠ 1/3" }

        [order]
        general = { order = 2, evidence = "proved", refuted_by = "q[q,q]", value = "1/2", wanted = "1/3", residual = "1/6", error_constant = "0.358430219460" }
        separable = { order = 2, evidence = "proved", refuted_by = "q[p,p]", value = "1/4", wanted = "1/3", residual = "-1/12", error_constant = "0.208333333333" }
        nystrom = { order = 2, evidence = "proved", refuted_by = "p[q,q]", value = "1/2", wanted = "1/3", residual = "1/6", error_constant = "0.204124145232" }
        perturbed = [{ order = 2, evidence = "proved", refuted_by = "A^2B", value = "1/4", wanted = "1/6", residual = "1/12" }, { order = 2, evidence = "proved", refuted_by = "A^2B", value = "1/4", wanted = "1/6", residual = "1/12" }]

        [stability]
        trace = "2 − ν²"
        determinant = "1"
        intervals = [["0", "2"]]
        decimal = [["0", "2.0000"]]
        closed = [[false, false]]
        p_stable = false
        evidence = "proved"
        dispersion_order = 2
        dispersion = "1/24"
    "##]].assert_eq(&stdout(&[
        "show",
        "stormer-verlet",
        "--format",
        "toml",
        "--digits",
        "5",
    ]));
}

/// The contract of the issue, read back by another reader and held against `√3` of the standard library.
#[test]
fn json_keeps_its_contract() {
    let text = stdout(&[
        "derive",
        "--basis",
        "polynomial(2)",
        "--nodes",
        "gauss(2)",
        "--format",
        "json",
        "--name",
        "Gauss",
    ]);
    let value: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(value["name"], "Gauss");
    assert_eq!(value["stages"], 2);
    assert_eq!(value["basis"], "polynomial(2)");
    assert_eq!(value["nodes"], "gauss(2)");
    assert_eq!(value["tier"], "node algebra");
    assert!(value["definition"].is_null());
    assert!(value["source"].is_null());
    // 1/4 ∓ √3/6 from known digits of √3/6 = 0.28867513459481288225457439025097872782380087563506343800930…
    let digits =
        |number: &serde_json::Value| number["decimal"].as_str().expect("a string").to_owned();
    assert_eq!(
        digits(&value["a"][0][1]),
        "-0.03867513459481288225457439025097872782380"
    );
    assert_eq!(
        digits(&value["a_tilde"][1][0]),
        "0.5386751345948128822545743902509787278238"
    );
    assert_eq!(
        digits(&value["c"][0]),
        "0.2113248654051871177454256097490212721762"
    );
    assert_eq!(
        digits(&value["b"][0]),
        "0.5000000000000000000000000000000000000000"
    );
    assert_eq!(value["a"][0][1]["exact"], "1/4 - sqrt(3)/6");
    for key in ["c", "c_tilde", "b", "b_tilde"] {
        assert_eq!(value[key].as_array().map(Vec::len), Some(2), "{key}");
    }
    let double = |number: &serde_json::Value| -> f64 {
        number["f64"]
            .as_str()
            .expect("a string")
            .parse()
            .expect("a double")
    };
    assert_eq!(double(&value["a"][1][0]), 0.25 + 3f64.sqrt() / 6.0);
    assert_eq!(double(&value["c_tilde"][1]), 0.5 + 3f64.sqrt() / 6.0);
    let properties = value["properties"].as_object().expect("an object");
    let mut names: Vec<&str> = properties.keys().map(String::as_str).collect();
    names.sort_unstable();
    let mut known = symplectic_compiler::Properties::NAMES.to_vec();
    known.sort_unstable();
    assert_eq!(names, known);
    for property in properties.values() {
        let (holds, evidence) = (property["holds"].as_bool(), property["evidence"].as_str());
        assert_eq!(
            evidence,
            Some(if holds == Some(true) {
                "proved"
            } else {
                "refuted"
            })
        );
        assert!(property["bits"].is_null());
        assert!(property["witness"].is_null() || property["witness"].is_string());
    }
    assert_eq!(properties["symplectic"]["holds"], true);
    assert_eq!(properties["explicit"]["holds"], false);
    // No short exact form, zero, and the digits asked for.
    let text = stdout(&[
        "derive",
        "--basis",
        "polynomial(4)",
        "--nodes",
        "radau-left(4)",
        "--format",
        "json",
        "--digits",
        "3",
    ]);
    let value: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert!(value["c"][1]["exact"].is_null());
    // The second zero of the Radau polynomial, 0.21234053823915…
    assert_eq!(digits(&value["c"][1]), "0.212");
    assert_eq!(
        value["c"][0],
        serde_json::json!({"exact": "0", "decimal": "0", "f64": "0", "f32": "0"})
    );
}

#[test]
fn list_shows_every_method_and_rule() {
    let text = stdout(&["list"]);
    for entry in symplectic_compiler::catalogue::entries() {
        assert!(
            text.contains(&format!("\n  {} ", entry.name)),
            "{}",
            entry.name
        );
    }
    for family in symplectic_compiler::FAMILIES {
        assert!(
            text.contains(&format!("\n  {}(s) ", family.name)),
            "{}",
            family.name
        );
        assert!(text.contains(family.description), "{}", family.name);
    }
}

#[test]
fn a_long_definition_widens_only_its_own_line() {
    let text = stdout(&["list"]);
    let width = |name: &str| {
        let line = text
            .lines()
            .find(|line| line.starts_with(&format!("  {name} ")));
        line.expect(name).chars().count()
    };
    assert!(width("gauss-2") < 160, "{}", width("gauss-2"));
    let gap = " ".repeat(60);
    assert!(!text.contains(&gap), "{text}");
}

#[test]
fn a_closed_output_pipe_is_not_an_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_symplectic"))
        .args(["show", "gauss-10", "--format", "json", "--digits", "400"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary runs");
    drop(child.stdout.take());
    let mut errors = String::new();
    child
        .stderr
        .take()
        .expect("stderr")
        .read_to_string(&mut errors)
        .expect("text");
    assert_eq!(errors, "");
    assert!(child.wait().expect("it ends").success());
}
