//! Splittings and compositions on the command line, and choosing among the methods of the catalogue.

use crate::run::{failure, stdout};
use expect_test::expect;

#[test]
fn derive_takes_kicks_and_drifts() {
    expect![[r#"
        ruth, 3 stages, kick 7/24, 3/4, -1/24, drift 2/3, -2/3, 1

          c │ a                    c̃ │ ã
        ────┼─────────────     ──────┼─────────────────
          0 │   0     0  0      7/24 │ 7/24    0      0
        2/3 │ 2/3     0  0     25/24 │ 7/24  3/4      0
          0 │ 2/3  -2/3  0         1 │ 7/24  3/4  -1/24
        ────┼─────────────     ──────┼─────────────────
          b │ 2/3  -2/3  1         b̃ │ 7/24  3/4  -1/24

        properties
          symplectic             no   refuted  b_1 − b̃_1 = 3/8
          symmetric              no   refuted  no order of the stages makes the tableau equal to its adjoint
          consistent             yes  proved
          equal_matrices         no   refuted  a_11 − ã_11 = -7/24
          explicit               yes  proved   Q1, P1, Q2, P2, Q3, P3
          first_row_zero         yes  proved
          stiffly_accurate       no   refuted  b_3 − a_33 = 1
          first_same_as_last     no   refuted  b_3 − a_33 = 1
          positive_weights       no   refuted  b_2 = -2/3
          constrained            no   refuted  b_3 − a_33 = 1
          nonholonomic           no   refuted  b_1 − b̃_1 = 3/8
          symplectic(separable)  yes  proved

        order
          general    1, proved; not 2: q[q] has the weight -4/9 instead of 1/2, a difference of -17/18; error constant 0.998686…
          separable  3, proved; not 4: q[p,p,p] has the weight 101/384 instead of 1/4, a difference of 5/384; error constant 0.057860…
          nystrom    3, proved; not 4: p[q,q,q] has the weight 2/9 instead of 1/4, a difference of -1/36; error constant 0.050290…
          perturbed  (3, 3), proved; not 4 in ε: A^3B has the coefficient 1/27 instead of 1/24, a difference of -1/216
          of symplecticity: 1, proved; not 2: the colour of the root of q[q] makes a difference of -17/18

        stability on the oscillator, ν = hω
          trace: (3456 − 1728ν² + 144ν⁴ − 7ν⁶)/1728
          stable for ν in (0, 2.50748117095…), proved
          phase: order 4, error 11/17280 ν^5, proved
    "#]].assert_eq(&stdout(&[
        "derive",
        "--kick",
        "7/24, 3/4, -1/24",
        "--drift",
        "2/3, -2/3, 1",
        "--name",
        "ruth",
    ]));
}

#[test]
fn derive_takes_a_base_and_weights() {
    let toml = stdout(&[
        "derive",
        "--base",
        "StoermerVerlet",
        "--weights",
        "triple_jump(4)",
        "--format",
        "toml",
    ]);
    assert!(
        toml.contains("base = \"stormer-verlet\"\nweights = \"triple_jump(4)\"\n"),
        "{toml}"
    );
    let half = stdout(&[
        "derive",
        "--kick",
        "1/6, 2/3",
        "--drift",
        "1/2",
        "--symmetric",
        "--first",
        "kick",
        "--format",
        "toml",
    ]);
    assert!(
        half.contains("kick = \"1/6, 2/3\"\ndrift = \"1/2\"\nsymmetric = true\n"),
        "{half}"
    );
    assert!(
        half.contains("symmetric_separable = { evidence = \"proved\" }\n"),
        "{half}"
    );
}

/// A file as a person writes it, and the whole file that comes of it.
#[test]
fn files_define_splittings() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let file = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).expect("a file");
        path.display().to_string()
    };
    let written = "[provenance]\nkick = \"1/6, 2/3\"\ndrift = \"1/2\"\nsymmetric = true\n";
    let written = file("splitting.toml", written);
    let whole = stdout(&["derive", &written, "--format", "toml"]);
    let checked = stdout(&["check", &file("whole.toml", &whole)]);
    assert!(checked.contains("3 stages"), "{checked}");
    let json = stdout(&["derive", &written, "--format", "json"]);
    stdout(&["check", &file("whole.json", &json)]);
    let wrong = file(
        "wrong.toml",
        "[provenance]\nkick = \"1/6, 1/3\"\ndrift = \"1, 0\"\n",
    );
    let (status, errors) = failure(&["derive", &wrong]);
    assert_eq!(status, Some(2));
    assert!(
        errors.contains("the kicks sum to 1/2, but must sum to 1;"),
        "{errors}"
    );
    assert!(errors.contains("2 | kick = \"1/6, 1/3\""), "{errors}");
}

#[test]
fn bad_input_is_refused_with_a_caret() {
    let (status, errors) = failure(&["derive", "--kick", "1/2, 1/3", "--drift", "1, 0"]);
    assert_eq!(status, Some(2));
    expect![[r#"
        error: the kicks sum to 5/6, but must sum to 1; give exact numbers, one of them as 1 minus the others
         --> kick:1:1
          |
        1 | 1/2, 1/3
          | ^^^^^^^^
    "#]].assert_eq(&errors);
    let (status, errors) = failure(&[
        "derive",
        "--base",
        "stromer-verlet",
        "--weights",
        "triple_jump(4)",
    ]);
    assert_eq!(status, Some(2));
    expect![[r#"
        error: unknown method `stromer-verlet`; known here: stormer-verlet, …; did you mean `stormer-verlet`?
         --> base:1:1
          |
        1 | stromer-verlet
          | ^^^^^^^^^^^^^^
    "#]]
    .assert_eq(&errors);
    let weights = ["--weights", "tripel_jump(4)"];
    let (_, errors) = failure(&[&["derive", "--base", "gauss-1"], &weights[..]].concat());
    let advice = "known here: triple_jump, suzuki, adjoint, sin, ";
    assert!(errors.contains(advice) && errors.contains("; did you mean `triple_jump`?"));
    let (status, errors) = failure(&["list", "--tolerance", "-1"]);
    assert_eq!(status, Some(2));
    assert!(
        errors.contains("expected a positive number such as 1e-8"),
        "{errors}"
    );
}

/// The names in a table of `list`.
fn names(arguments: &[&str]) -> Vec<String> {
    let text = stdout(arguments);
    let rows = text
        .lines()
        .skip_while(|line| !line.trim_start().starts_with("name"));
    rows.skip(1)
        .filter_map(|line| Some(line.split_whitespace().next()?.to_owned()))
        .collect()
}

/// The names of the methods with at most five evaluations that `list` chooses.
fn choice(others: &[&str]) -> Vec<String> {
    let few = ["list", "--max-evaluations", "5"];
    names(&[&few[..], others].concat())
}

#[test]
#[ignore = "thorough"]
fn list_filters_and_sorts() {
    let efficient = choice(&[
        "--class",
        "separable",
        "--min-order",
        "4",
        "--sort",
        "efficiency",
    ]);
    assert_eq!(efficient[0], "ostmeyer-2022-order-4");
    assert_eq!(efficient.last().map(String::as_str), Some("triple-jump-4"));
    // No method of order 3, none that iterates and none with more evaluations is among them.
    for other in ["ruth-1983", "gauss-2", "suzuki-6"] {
        assert!(!efficient.iter().any(|name| name == other), "{other}");
    }
    let mut by_name = choice(&["--min-order", "4", "--sort", "name"]);
    assert!(by_name.is_sorted());
    by_name.sort_by_key(|name| efficient.iter().position(|other| other == name));
    assert_eq!(by_name, efficient);
    let third = choice(&["--min-order", "3", "--max-order", "3"]);
    assert_eq!(
        third,
        [
            "ruth-1983",
            "mclachlan-atela-1992-order-3-optimal",
            "mclachlan-atela-1992-order-4-optimal"
        ]
    );
}

#[test]
#[ignore = "thorough"]
fn list_sorts_by_efficiency_and_error() {
    // The coarser the tolerance, the better the lower order.
    let coarse = choice(&["--sort", "efficiency", "--tolerance", "1"]);
    let fine = choice(&["--sort", "efficiency", "--tolerance", "1e-8"]);
    let place = |names: &[String], name: &str| names.iter().position(|other| other == name);
    assert!(place(&coarse, "stormer-verlet") < place(&coarse, "mclachlan-1995-s5"));
    assert!(place(&fine, "stormer-verlet") > place(&fine, "mclachlan-1995-s5"));
    // For p²/2 + U(q) another one is best.
    let nystrom = choice(&["--class", "nystrom", "--min-order", "4", "--sort", "error"]);
    assert_ne!(nystrom[0], "mclachlan-1995-s5");
}
