//! Methods fitted to a frequency on the command line.

use crate::run::{failure, stdout};
use expect_test::expect;

const GAUSS_2: [&str; 7] = [
    "derive",
    "--parameters",
    "w",
    "--basis",
    "cos(w*t), sin(w*t)",
    "--nodes",
    "gauss(2)",
];

#[test]
fn derive_prints_functions_of_a_parameter_and_what_is_proved_about_them() {
    let printed = stdout(&GAUSS_2);
    expect![[r#"
        2 stages, parameters w, basis cos(w*t), sin(w*t), nodes gauss(2)
        coefficients are functions of the product of frequency and step size, which is called w

        D    = w*sin(sqrt(3)/3*w)
        b_1  = (cos((1/2 - sqrt(3)/6)*w) - cos((1/2 + sqrt(3)/6)*w))/D  → 1/2
        b_2  = (-cos((1/2 + sqrt(3)/6)*w) + cos((1/2 - sqrt(3)/6)*w))/D  → 1/2
        a_11 = (cos(sqrt(3)/3*w) - cos((1/2 + sqrt(3)/6)*w))/D  → 1/4
        a_12 = (-1 + cos((1/2 - sqrt(3)/6)*w))/D  → 1/4 - sqrt(3)/6
        a_21 = (1 - cos((1/2 + sqrt(3)/6)*w))/D  → 1/4 + sqrt(3)/6
        a_22 = (-cos(sqrt(3)/3*w) + cos((1/2 - sqrt(3)/6)*w))/D  → 1/4

        ã_ij = b_j (b_i − a_ji)/b_i and b̃ = b; c_i and c̃_i are the sums of the rows. After → is the limit for w → 0.

        properties, for every w
          symplectic  yes  proved
          symmetric   yes  proved
          consistent  no   refuted

        order, for small steps at a fixed frequency
          general    4, proved; not 5: a tree of order 1 has a residual in w^4
          separable  4, proved; not 5: a tree of order 1 has a residual in w^4
          nystrom    4, proved; not 5: a tree of order 1 has a residual in w^4

        exact on the span of the basis, with w the frequency and t the time in the step; proved
          positions at the end:    velocities in the span of cos(w*t), sin(w*t)
          momenta at the end:      forces in the span of cos(w*t), sin(w*t)
          positions at the stages: velocities in the span of cos(w*t), sin(w*t)
          momenta at the stages:   no function of the basis

        oscillator of the frequency w
          phase: order 6, error 1/13824 w^7, proved
    "#]].assert_eq(&printed);
    let page =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/guide/methods.md");
    let page = std::fs::read_to_string(page).expect("the page");
    assert!(page.contains(&printed), "the page is stale");
}

#[test]
fn derive_at_a_number_is_the_method_of_this_number() {
    let derive = |basis: &str, more: &[&str]| {
        let definition = ["derive", "--basis", basis, "--nodes", "0, 1/2, 1"];
        stdout(&[&definition[..], more].concat())
    };
    let at = ["--parameters", "w", "--at", "w=3/2"];
    let at = derive("1, cos(w*t), sin(w*t)", &at);
    let number = derive("1, cos((3/2)*t), sin((3/2)*t)", &[]);
    assert_eq!(at, number);
    let statement = "exact on the span of 1, cos(3*t/2), sin(3*t/2), proved\n";
    assert!(at.contains(statement), "{at}");
}

#[test]
fn options_that_need_numbers_are_refused_with_a_parameter() {
    let refused = |more: &[&str]| failure(&[&GAUSS_2[..], more].concat());
    for (more, message) in [
        (&["--format", "toml"][..], "this format needs numbers"),
        (&["--digits", "20"], "`--digits` needs numbers"),
        (
            &["--at", "v=3"],
            "`v` is not a parameter: the parameters are w",
        ),
        (&["--at", "w"], "expected a name and a number"),
        (&["--at", "w=t"], "an expression that depends on `t`"),
        (&["--at", "w=1", "--at", "w=2"], "`w` has 2"),
        (&["--adjoint"], "leave out `adjoint`"),
    ] {
        let (status, found) = refused(more);
        assert_eq!(status, Some(2));
        assert!(found.contains(message), "{more:?}: {found}");
    }
}
