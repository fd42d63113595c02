//! Bad input on the command line: the message, the caret and the exit status.

use crate::run::{failure, stdout};
use expect_test::{Expect, expect};

fn bad_input(arguments: &[&str], expected: Expect) {
    let (status, errors) = failure(arguments);
    assert_eq!(status, Some(2), "{arguments:?}");
    expected.assert_eq(&errors);
}

#[test]
fn bad_expressions_are_refused_with_a_caret() {
    let derive = |basis, nodes, expected| {
        bad_input(&["derive", "--basis", basis, "--nodes", nodes], expected)
    };
    derive(
        "polynomial(3)",
        "0, 1/2, 2/4",
        expect![[r#"
        error: the node 1/2 is listed twice; nodes must be distinct
         --> nodes:1:9
          |
        1 | 0, 1/2, 2/4
          |         ^^^
    "#]],
    );
    derive(
        "polynomial(3)",
        "0, 1/3, 4/3",
        expect![[r#"
        error: the node 4/3 lies outside [0, 1]; nodes are fractions of a step
         --> nodes:1:9
          |
        1 | 0, 1/3, 4/3
          |         ^^^
    "#]],
    );
    derive(
        "polynomial(2)",
        "-1/9, 1",
        expect![[r#"
        error: the node -1/9 lies outside [0, 1]; nodes are fractions of a step
         --> nodes:1:1
          |
        1 | -1/9, 1
          | ^^^^
    "#]],
    );
    derive(
        "1, t, 2 - t",
        "gauss(3)",
        expect![[r#"
        error: the basis functions are linearly dependent: 2*1 - t - (-t + 2) = 0; leave one of them out
         --> basis:1:1
          |
        1 | 1, t, 2 - t
          | ^^^^^^^^^^^
    "#]],
    );
    derive(
        "polynomial(2)",
        "1/2, 1",
        expect![[r#"
        error: the weight b_2 at the node c_2 = 1 is zero, and ã_2j = (b_2 b_j − b_j a_j2)/b_2 divides by it; choose other nodes, another basis or other weights
         --> nodes:1:1
          |
        1 | 1/2, 1
          | ^^^^^^
    "#]],
    );
    derive(
        "polynomial(1)",
        "gauss(0)",
        expect![[r#"
        error: `gauss(0)` does not exist: `gauss(s)` needs s ≥ 1
         --> nodes:1:1
          |
        1 | gauss(0)
          | ^^^^^^^^
    "#]],
    );
    derive(
        "polynomial(1)",
        "lobatto(1)",
        expect![[r#"
        error: `lobatto(1)` does not exist: `lobatto(s)` needs s ≥ 2
         --> nodes:1:1
          |
        1 | lobatto(1)
          | ^^^^^^^^^^
    "#]],
    );
    derive(
        "polynomial(8)",
        "chebyshev(8)",
        expect![[r#"
        error: `chebyshev(8)` has only 2 real nodes out of 8; real nodes exist only for s = 1, …, 7 and 9 (Bernstein 1937)
         --> nodes:1:1
          |
        1 | chebyshev(8)
          | ^^^^^^^^^^^^
    "#]],
    );
    derive(
        "1, t/0",
        "0, 1",
        expect![[r#"
        error: division by zero
         --> basis:1:6
          |
        1 | 1, t/0
          |      ^
    "#]],
    );
    derive(
        "polynomial(2)",
        "0, (1",
        expect![[r#"
        error: `(` has no matching `)`
         --> nodes:1:4
          |
        1 | 0, (1
          |    ^
    "#]],
    );
    derive(
        "polynomial(2)",
        "0, 1)",
        expect![[r#"
        error: `)` has no matching `(`
         --> nodes:1:5
          |
        1 | 0, 1)
          |     ^
    "#]],
    );
    derive(
        "1, t^2 - foo(3)",
        "0, 1",
        expect![[r#"
            error: unknown function `foo`; known here: sin, cos, tan, exp, cosh, sinh, ln, sqrt, cbrt, root
             --> basis:1:10
              |
            1 | 1, t^2 - foo(3)
              |          ^^^
        "#]],
    );
    derive(
        "polynomial(2)",
        "",
        expect![[r#"
            error: the input ends, expected a number, a name or `(`
             --> nodes:1:1
              |
            1 |
              | ^
        "#]],
    );
    derive(
        "polynomial(3)",
        "0, α, 1",
        expect![[r#"
            error: unknown name `α`; known here: t, pi, e, numbers
             --> nodes:1:4
              |
            1 | 0, α, 1
              |    ^
        "#]],
    );
    derive(
        "polynomial(3)",
        "0,\n  1/2,\n  1/0",
        expect![[r#"
        error: division by zero
         --> nodes:3:5
          |
        3 |   1/0
          |     ^
    "#]],
    );
    derive(
        "polynomial(40)",
        "gauss(40)",
        expect![[r#"
        error: 40 stages exceed the limit of 36, beyond which a derivation may run for very long; raise it with `--max-stages 40` (in the macro `max_stages: 40`)
         --> basis:1:1
          |
        1 | polynomial(40)
          | ^^^^^^^^^^^^^^
    "#]],
    );
}

#[test]
fn tiny_constants_are_refused_like_huge_ones() {
    let cases: [&[&str]; 4] = [
        &["--basis=1", "--nodes=exp(-99999999999)"],
        &["--basis=1", "--nodes=exp(99999999999)"],
        &["--kick=e^-1000000,1-e^-1000000", "--drift=1,0"],
        &["--kick=e^1000000,1-e^1000000", "--drift=1,0"],
    ];
    for arguments in cases {
        let (status, errors) = failure(&[&["derive"], arguments].concat());
        assert_eq!(status, Some(2), "{errors}");
        let between = "constants that are not rational lie between 2^-4096 and 2^4096";
        assert!(
            errors.starts_with("error: exp(") && errors.contains(between),
            "{errors}"
        );
    }
}

#[test]
fn a_limit_can_be_raised_and_lowered() {
    // Beyond the limit there is another complaint, without the work of 33 stages.
    let (status, errors) = failure(&[
        "derive",
        "--basis",
        "polynomial(33)",
        "--nodes",
        "0, 1",
        "--max-stages",
        "33",
    ]);
    assert_eq!(status, Some(2));
    assert!(
        errors.contains("33 basis functions and 2 nodes"),
        "{errors}"
    );
    let (status, errors) = failure(&["show", "gauss-3", "--max-stages", "2"]);
    assert_eq!(status, Some(2));
    assert!(
        errors.contains("3 stages exceed the limit of 2"),
        "{errors}"
    );
}

#[test]
fn wrong_options_and_names_are_refused() {
    bad_input(
        &["show", "gaus-3"],
        expect![[r#"
        error: unknown method `gaus-3`; known here: gauss-3, gauss-1, gauss-2, …; did you mean `gauss-3`?
    "#]],
    );
    bad_input(
        &["show", "dormand-prince"],
        expect![[r#"
        error: unknown method `dormand-prince`; known here: the names that `symplectic list` shows
    "#]],
    );
    for digits in ["0", "10001", "-3", "many"] {
        let (status, errors) = failure(&["show", "gauss-3", &format!("--digits={digits}")]);
        assert_eq!(status, Some(2));
        assert!(
            errors.contains("expected a whole number from 1 to 10000"),
            "{errors}"
        );
    }
    for arguments in [
        &["derive"][..],
        &["show"],
        &["check"],
        &["fly"],
        &[],
        &["show", "gauss-3", "--format", "xml"],
    ] {
        assert_eq!(failure(arguments).0, Some(2), "{arguments:?}");
    }
    assert!(stdout(&["show", "midpoint", "--digits", "10000", "--format", "toml"]).len() > 40_000);
}

#[test]
fn more_digits_than_can_be_computed_in_time_are_refused() {
    let gauss = [
        "derive",
        "--basis",
        "polynomial(36)",
        "--nodes",
        "gauss(36)",
    ];
    let (status, errors) = failure(&[&gauss[..], &["--digits", "10000"]].concat());
    assert_eq!(status, Some(2), "{errors}");
    assert_eq!(
        errors.trim_end(),
        "error: 10000 digits take too long for a method with 36 stages: for this method `--digits` may be up to 6500"
    );
}
