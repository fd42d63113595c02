//! Methods with known stability, and the whole catalogue against floating-point arithmetic.

use std::sync::Arc;

use super::*;
use crate::algebra::{Constants, Dense, NodeAlgebra, Rationals, Real, Reals, Zero};
use crate::arithmetic::rational::{parse, ratio};
use crate::arithmetic::rounding::to_f64;
use crate::catalogue;
use crate::coefficients::Coefficients;
use crate::exact::over_algebra;
use crate::symbolic::Constant;
use crate::{Definition, Limits, Tableau};

fn derived(basis: &str, nodes: &str) -> Stability {
    crate::derive(basis, nodes).expect("derived").stability()
}

fn matrix(rows: &[&[&str]]) -> Vec<Vec<BigRational>> {
    let row = |row: &&[&str]| row.iter().map(|x| parse(x).expect("a rational")).collect();
    rows.iter().map(row).collect()
}

fn pair(a: &[&[&str]], b: &[&str]) -> Partitioned<Dense<Rationals>> {
    let algebra = Arc::new(Dense::new(Rationals, b.len()));
    Partitioned::equal(algebra, matrix(a), matrix(&[b]).remove(0))
}

fn runge_kutta(a: &[&[&str]], b: &[&str]) -> (Stability, RungeKuttaStability) {
    let stability = Stability::of_pair(&pair(a, b));
    let function = stability.runge_kutta.clone().expect("one tableau");
    (stability, function)
}

#[test]
fn stability_of_textbook_methods_agrees_with_the_theory() {
    let verlet = derived("polynomial(2)", "lobatto(2)");
    assert_eq!(verlet.trace.to_string(), "2 − ν²");
    assert_eq!(verlet.intervals_text(), "(0, 2)");
    let dispersion = verlet.dispersion.as_ref().expect("consistent");
    assert_eq!(
        (dispersion.order, dispersion.coefficient.text.as_str()),
        (2, "1/24")
    );
    assert!(verlet.preserves_area && !verlet.p_stable);
    assert!(verlet.stable_to(&ratio(1999, 1000)) && !verlet.stable_to(&ratio(2, 1)));
    let lobatto = derived("polynomial(3)", "lobatto(3)");
    assert_eq!(lobatto.trace.to_string(), "(ν⁴ − 22ν² + 48)/(ν² + 24)");
    assert_eq!(
        lobatto.intervals_text(),
        "(0, 2*sqrt(2)) ∪ (2*sqrt(3), 2*sqrt(6))"
    );
    assert!(!lobatto.contains(&ratio(3, 1)) && lobatto.contains(&ratio(4, 1)));
    assert!(!lobatto.stable_to(&ratio(3, 1)));
    let json = serde_json::to_string(&lobatto.summary(5)).expect("plain data");
    assert!(
        json.contains(
            r#""intervals":[["0","2*sqrt(2)"],["2*sqrt(3)","2*sqrt(6)"]],"decimal":[["0","2.8284"],["3.4641","4.8990"]]"#
        ),
        "{json}"
    );
}

#[test]
fn gauss_is_stable_for_all_steps() {
    for s in 1..=5 {
        let gauss = derived(&format!("polynomial({s})"), &format!("gauss({s})"));
        assert!(gauss.p_stable && gauss.preserves_area, "{gauss}");
        assert!(gauss.stable_to(&ratio(1_000_000_007, 3)));
        let rk = gauss.runge_kutta.expect("one tableau");
        assert!(rk.a_stable && !rk.l_stable && rk.imaginary.is_infinite());
        let sign = if s % 2 == 0 { 1 } else { -1 };
        assert_eq!(
            rk.at_infinity.and_then(|c| c.rational),
            Some(ratio(sign, 1))
        );
        // The phase error is that of the diagonal Padé approximant of exp(iν), −s!²/((2s)!(2s+1)!).
        let factorial = |n: usize| (1..=n as i64).product::<i64>();
        let error = ratio(-factorial(s).pow(2), factorial(2 * s)) / ratio(factorial(2 * s + 1), 1);
        let found = gauss.dispersion.map(|d| (d.order, d.coefficient.rational));
        assert_eq!(found, Some((2 * s, Some(error))));
    }
    let midpoint = derived("polynomial(1)", "gauss(1)");
    assert_eq!(
        midpoint
            .runge_kutta
            .expect("one tableau")
            .function
            .to_string(),
        "(z + 2)/(2 − z)"
    );
    // θ = 2 arctan(ν/2) = ν − ν³/12 + …
    let error = midpoint.dispersion.map(|d| d.coefficient.text);
    assert_eq!(error.as_deref(), Some("-1/12"));
}

#[test]
fn explicit_runge_kutta_methods_have_their_known_stability() {
    let (euler, rk) = runge_kutta(&[&["0"]], &["1"]);
    assert_eq!(rk.function.to_string(), "z + 1");
    assert!(rk.imaginary.is_zero() && !rk.a_stable && rk.at_infinity.is_none());
    assert!(euler.intervals.is_empty() && !euler.preserves_area);
    assert_eq!(euler.intervals_text(), "∅");
    assert_eq!(euler.determinant.to_string(), "ν² + 1");
    // θ = arctan ν = ν − ν³/3 + …
    let error = euler.dispersion.expect("consistent");
    assert_eq!((error.order, error.coefficient.text.as_str()), (2, "-1/3"));
    let (kutta, rk) = runge_kutta(
        &[&["0", "0", "0"], &["1/2", "0", "0"], &["-1", "2", "0"]],
        &["1/6", "2/3", "1/6"],
    );
    assert_eq!(rk.imaginary.exact(), Some("sqrt(3)"));
    // Damped up to the end of the interval, and bounded there.
    assert_eq!(kutta.intervals_text(), "(0, sqrt(3)]");
    let (classical, rk) = runge_kutta(
        &[
            &["0", "0", "0", "0"],
            &["1/2", "0", "0", "0"],
            &["0", "1/2", "0", "0"],
            &["0", "0", "1", "0"],
        ],
        &["1/6", "1/3", "1/3", "1/6"],
    );
    assert_eq!(rk.imaginary.decimal(11), "2.8284271247");
    assert_eq!(classical.intervals_text(), "(0, 2*sqrt(2)]");
    assert_eq!(rk.function.to_string(), "(z⁴ + 4z³ + 12z² + 24z + 24)/24");
    assert_eq!(classical.dispersion.map(|d| d.order), Some(4));
}

#[test]
fn implicit_runge_kutta_methods_have_their_known_stability() {
    let (euler, rk) = runge_kutta(&[&["1"]], &["1"]);
    assert!(rk.a_stable && rk.l_stable && euler.p_stable);
    assert_eq!(rk.function.to_string(), "1/(1 − z)");
    let (_, radau) = runge_kutta(&[&["5/12", "-1/12"], &["3/4", "1/4"]], &["3/4", "1/4"]);
    assert_eq!(radau.function.to_string(), "(2z + 6)/(z² − 4z + 6)");
    assert!(radau.a_stable && radau.l_stable);
    let (_, lobatto) = runge_kutta(
        &[
            &["1/6", "-1/3", "1/6"],
            &["1/6", "5/12", "-1/12"],
            &["1/6", "2/3", "1/6"],
        ],
        &["1/6", "2/3", "1/6"],
    );
    assert!(lobatto.l_stable && lobatto.imaginary.is_infinite());
    // R(z) = (1 + 3z/2)/(1 + z/2): |R| > 1 on the axis, and a pole on the left.
    let (_, negative) = runge_kutta(&[&["-1/2"]], &["1"]);
    assert!(!negative.a_stable && !negative.imaginary.is_infinite());
    // R(z) = 1/(1 + z) is bounded on the axis by 1, and has a pole on the left.
    let (_, reversed) = runge_kutta(&[&["-1"]], &["-1"]);
    assert!(reversed.imaginary.is_infinite() && !reversed.a_stable);
}

/// `Q(√2)`, by way of the nodes ∓√2.
#[derive(Debug, PartialEq)]
struct Surds(NodeAlgebra);

impl Surds {
    fn new() -> Self {
        Surds(NodeAlgebra::new(&Polynomial::from_integers(&[-2, 0, 1])).expect("nodes"))
    }
}

impl Field for Surds {
    type Element = Polynomial;

    fn rational(&self, value: &BigRational) -> Polynomial {
        Polynomial::constant(value.clone())
    }

    fn constant(&self, value: &Constant) -> Option<Polynomial> {
        value.as_rational().cloned().map(Polynomial::constant)
    }

    fn add(&self, x: &Polynomial, y: &Polynomial) -> Polynomial {
        x + y
    }

    fn subtract(&self, x: &Polynomial, y: &Polynomial) -> Polynomial {
        x - y
    }

    fn multiply(&self, x: &Polynomial, y: &Polynomial) -> Polynomial {
        self.0.multiply(x, y)
    }

    fn inverse(&self, x: &Polynomial) -> Option<Polynomial> {
        self.0.inverse(x).ok()
    }

    fn verified_bits(&self) -> Option<u32> {
        None
    }

    fn zero(&self, x: &Polynomial) -> Zero {
        if x.is_zero() { Zero::Yes } else { Zero::No }
    }

    fn pivot(&self, candidates: &[&Polynomial]) -> Option<usize> {
        candidates.iter().position(|x| !x.is_zero())
    }

    fn number(&self, x: &Polynomial) -> Number<'_> {
        x.as_constant().map_or_else(
            || Number::Node(crate::algebra::node::NodeNumber::at(&self.0, x.clone(), 1)),
            Number::Rational,
        )
    }

    fn exact(&self, x: &Polynomial) -> Option<String> {
        Some(x.display("sqrt(2)").to_string())
    }
}

/// Two stages with γ on the diagonal, stiffly accurate, of order 2 for γ = 1 ± √2/2.
fn diagonally_implicit(gamma: &Polynomial) -> RungeKuttaStability {
    let algebra = Arc::new(Dense::new(Surds::new(), 2));
    let rest = &Polynomial::one() - gamma;
    let a = vec![
        vec![gamma.clone(), Polynomial::zero()],
        vec![rest.clone(), gamma.clone()],
    ];
    let stability = Stability::of_pair(&Partitioned::equal(algebra, a, vec![rest, gamma.clone()]));
    stability.runge_kutta.expect("one tableau")
}

#[test]
fn methods_over_a_number_field_have_their_known_stability() {
    for sign in [-1, 1] {
        let gamma = Polynomial::from_rationals(&[ratio(1, 1), ratio(sign, 2)]);
        let rk = diagonally_implicit(&gamma);
        assert!(rk.a_stable && rk.l_stable, "{}", rk.function);
        assert!(rk.imaginary.is_infinite() && rk.function.rational.is_none());
    }
    // 1 − 3√2/4 is negative: the poles are on the left.
    let gamma = Polynomial::from_rationals(&[ratio(1, 1), ratio(-3, 4)]);
    assert!(!diagonally_implicit(&gamma).a_stable);
    // A kick and a drift, with weights whose product is √2: tr M = 2 − √2ν².
    let algebra = Arc::new(Dense::new(Surds::new(), 1));
    let pair = Partitioned {
        a: vec![vec![Polynomial::variable()]],
        a_tilde: vec![vec![Polynomial::zero()]],
        b: vec![Polynomial::variable()],
        b_tilde: vec![Polynomial::one()],
        gradient: None,
        algebra,
    };
    let stability = Stability::of_pair(&pair);
    assert_eq!(stability.trace.to_string(), "2 − sqrt(2) ν²");
    assert_eq!(stability.intervals_text(), "(0, sqrt(2*sqrt(2)))");
    assert_eq!(stability.intervals[0].high.to_f64(), 2f64.powf(0.75));
    assert!(stability.preserves_area && stability.dispersion.is_none());
}

/// Stability by the arithmetic for any field, whether the polynomials are rational or not.
fn over_field<A: StageAlgebra + 'static>(pair: &Partitioned<A>) -> Stability {
    let make = |list: &Vec<Scalar<A>>| {
        FieldPolynomial::new(&pair.algebra, &Arc::new(Budget::unlimited()), list.clone())
    };
    let parts = oscillator::parts(pair).map(|list| Some(make(list)));
    let equal = pair.equal_halves() == (true, true);
    let function = equal.then(|| runge_kutta::parts(pair).map(|list| make(&list)));
    Stability::decide(&parts.expect("all of them"), function)
}

#[test]
fn both_kinds_of_polynomials_agree() {
    for (basis, nodes) in [
        ("polynomial(3)", "lobatto(3)"),
        ("polynomial(4)", "lobatto(4)"),
        ("polynomial(3)", "gauss(3)"),
        ("polynomial(3)", "radau-right(3)"),
        ("polynomial(4)", "newton-cotes(4)"),
    ] {
        let tableau = crate::derive(basis, nodes).expect("derived");
        let fast = tableau.stability();
        let general = over_algebra!(&tableau.exact, pair => over_field(pair));
        assert_eq!(fast.p_stable, general.p_stable);
        assert_eq!(fast.intervals.len(), general.intervals.len());
        for (x, y) in fast.intervals.iter().zip(&general.intervals) {
            assert_eq!(x.low.decimal(40), y.low.decimal(40));
            assert_eq!(x.high.decimal(40), y.high.decimal(40));
            assert_eq!((x.low_closed, x.high_closed), (y.low_closed, y.high_closed));
        }
        let order = |s: &Stability| {
            s.dispersion
                .as_ref()
                .map(|d| (d.order, d.coefficient.clone()))
        };
        assert_eq!(order(&fast), order(&general));
    }
    let rk = pair(&[&["5/12", "-1/12"], &["3/4", "1/4"]], &["3/4", "1/4"]);
    let radau = over_field(&rk).runge_kutta.expect("one tableau");
    assert!(radau.a_stable && radau.l_stable);
}

/// A budget with enough operations for the exact arithmetic, and one with too few.
#[test]
fn the_budget_changes_the_evidence_only() {
    for (basis, nodes) in [
        ("1, exp(t), exp(2*t), t", "0, 1/3, 2/3, 1"),
        ("1, cos(pi*t), sin(pi*t), t, t^2", "0, 1/4, 1/2, 3/4, 1"),
        ("1, cos(t), sin(t)", "0, 1/2, 1"),
        ("1, cos(pi*t), sin(pi*t)", "0, 1/2, 1"),
    ] {
        let tableau = crate::derive(basis, nodes).expect("derived");
        let within =
            |products| over_algebra!(&tableau.exact, pair => Stability::within(pair, products));
        let exact = within(PRODUCTS);
        assert_eq!(exact.evidence, Evidence::Proved, "{basis}");
        assert!(exact.preserves_area && exact.dispersion.is_some());
        let limited = within(1000);
        assert_eq!(limited.evidence, Evidence::Verified { bits: ZERO_BITS });
        assert!(limited.preserves_area);
        for (x, y) in exact.intervals.iter().zip(&limited.intervals) {
            assert_eq!(x.low.decimal(40), y.low.decimal(40));
            assert_eq!(x.high.decimal(40), y.high.decimal(40));
            assert_eq!((x.low_closed, x.high_closed), (y.low_closed, y.high_closed));
        }
        assert_eq!(exact.intervals.len(), limited.intervals.len(), "{basis}");
        let order = |s: &Stability| {
            s.dispersion
                .as_ref()
                .map(|d| (d.order, d.coefficient.value))
        };
        assert_eq!(order(&exact), order(&limited));
    }
    // Six stages with exponentials exceed the budget.
    let basis = "1, exp(t), exp(2*t), exp(3*t), exp(-t), t";
    let tableau = crate::derive(basis, "0, 1/5, 2/5, 3/5, 4/5, 1").expect("derived");
    assert_eq!(tableau.tier(), crate::Tier::ConstantField);
    let stability = tableau.stability();
    assert_eq!(stability.evidence, Evidence::Verified { bits: ZERO_BITS });
    // The same end point from exact arithmetic without a bound.
    assert_eq!(stability.intervals[0].high.decimal(12), "2.31069986965");
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(24))]

    /// Methods whose stability function has the denominator `1 − Kz`, for a multiple `K` of π and for a rational number
    /// near it: the sets are the same, however large or small `K` is.
    #[test]
    #[ignore = "thorough"]
    fn enclosures_do_not_depend_on_the_scale(n in 1i64..50, exponent in -400i32..400, second in -40i32..40) {
        let ten = ratio(10, 1);
        let power = |k: i32| if k < 0 { ten.pow(-k).recip() } else { ten.pow(k) };
        let pi = Real::constant(Constant::pi());
        let [first, other] = [power(exponent) * ratio(n, 7), power(second)];
        let real = |x: &BigRational| Reals.multiply(&pi, &Reals.rational(x));
        let near = pi.enclose(2000).low();
        let rational = |x: &BigRational| x * &near;
        let half = ratio(1, 2);
        let zero = BigRational::default();
        let reals = Partitioned::equal(
            Arc::new(Dense::new(Reals, 2)),
            vec![vec![real(&first), Real::rational(zero.clone())], vec![real(&other), Real::rational(zero.clone())]],
            vec![Real::rational(half.clone()); 2],
        );
        let rationals = Partitioned::equal(
            Arc::new(Dense::new(Rationals, 2)),
            vec![vec![rational(&first), zero.clone()], vec![rational(&other), zero]],
            vec![half; 2],
        );
        let (enclosed, exact) = (Stability::of_pair(&reals), Stability::of_pair(&rationals));
        proptest::prop_assert_eq!(enclosed.evidence, Evidence::Verified { bits: ZERO_BITS });
        proptest::prop_assert_eq!(enclosed.intervals.len(), exact.intervals.len());
        for (x, y) in enclosed.intervals.iter().zip(&exact.intervals) {
            proptest::prop_assert_eq!(x.low.decimal(30), y.low.decimal(30));
            proptest::prop_assert_eq!(x.high.decimal(30), y.high.decimal(30));
            proptest::prop_assert_eq!((x.low_closed, x.high_closed), (y.low_closed, y.high_closed));
        }
        let degrees = |s: &Stability| {
            let function = s.runge_kutta.as_ref().map(|rk| &rk.function);
            let all = [Some(&s.trace), Some(&s.determinant), function];
            all.map(|f| f.map(|f| (f.numerator.len(), f.denominator.len())))
        };
        proptest::prop_assert_eq!(degrees(&enclosed), degrees(&exact));
    }
}

/// `R(z) = (1 + z/2 …)/(1 − Kz)` with a `K` whose double is zero.
#[test]
fn a_number_whose_double_is_zero_is_not_zero() {
    let field = Constants::containing([&Constant::pi()]).expect("small");
    let pi = field.constant(&Constant::pi()).expect("an element");
    let tiny = field.multiply(&pi, &field.rational(&ratio(10, 1).pow(400).recip()));
    let [zero, one, half] = [ratio(0, 1), ratio(1, 1), ratio(1, 2)].map(|x| field.rational(&x));
    let a = vec![vec![tiny, zero.clone()], vec![one, zero]];
    let stability = Stability::of_pair(&Partitioned::equal(
        Arc::new(Dense::new(field, 2)),
        a,
        vec![half; 2],
    ));
    let function = stability.runge_kutta.expect("one tableau").function;
    let slope = &function.denominator[1];
    assert!(slope.value == 0.0 && !slope.is_zero());
    assert!(function.to_string().contains("z)"), "{function}");
    assert_eq!(stability.evidence, Evidence::Proved);
    // √(4K), from K = π·10⁻⁴⁰⁰.
    assert_eq!(stability.intervals[0].high.decimal(9), "3.54490770e-200");
}

/// Pairs that are not symplectic, and a pair whose stages have no solution at a point where the matrix is defined.
#[test]
fn stability_of_nonsymplectic_pairs_uses_the_determinant() {
    // Two stages: Heun's method for both q and p.
    let (heun, _) = runge_kutta(&[&["0", "0"], &["1", "0"]], &["1/2", "1/2"]);
    // det = (1 − x/2)² + x = 1 + x²/4: unstable for all steps.
    assert_eq!(heun.determinant.to_string(), "(ν⁴ + 4)/4");
    assert!(heun.intervals.is_empty());
    // Implicit, with too small a weight of the force: damped.
    let algebra = Arc::new(Dense::new(Rationals, 1));
    let damped = Partitioned {
        a: matrix(&[&["1"]]),
        a_tilde: matrix(&[&["1"]]),
        b: matrix(&[&["1"]]).remove(0),
        b_tilde: matrix(&[&["1/2"]]).remove(0),
        gradient: None,
        algebra: Arc::clone(&algebra),
    };
    let damped = Stability::of_pair(&damped);
    assert!(!damped.preserves_area && damped.p_stable, "{damped}");
    // A second stage without weight that has no solution at ν = 1.
    let algebra = Arc::new(Dense::new(Rationals, 2));
    let unseen = Partitioned {
        a: matrix(&[&["1/2", "0"], &["0", "1"]]),
        a_tilde: matrix(&[&["1/2", "0"], &["0", "-1"]]),
        b: matrix(&[&["1", "0"]]).remove(0),
        b_tilde: matrix(&[&["1", "0"]]).remove(0),
        gradient: None,
        algebra,
    };
    let unseen = Stability::of_pair(&unseen);
    assert_eq!(unseen.intervals_text(), "(0, 1) ∪ (1, ∞)");
    assert_eq!(unseen.trace.to_string(), "(8 − 2ν²)/(ν² + 4)");
}

/// Two Störmer–Verlet steps of half the length: `tr M = T² − 2` with `T = 2 − ν²/4` touches −2 at `ν = 2√2`, where
/// `M = −1`, and the set is not split there.
#[test]
fn a_touching_trace_does_not_split_an_interval_if_the_matrix_is_scalar() {
    let algebra = Arc::new(Dense::new(Rationals, 4));
    let verlet = Partitioned {
        a: matrix(&[
            &["0", "0", "0", "0"],
            &["1/4", "1/4", "0", "0"],
            &["1/4", "1/4", "0", "0"],
            &["1/4", "1/4", "1/4", "1/4"],
        ]),
        a_tilde: matrix(&[
            &["1/4", "0", "0", "0"],
            &["1/4", "0", "0", "0"],
            &["1/4", "1/4", "1/4", "0"],
            &["1/4", "1/4", "1/4", "0"],
        ]),
        b: matrix(&[&["1/4", "1/4", "1/4", "1/4"]]).remove(0),
        b_tilde: matrix(&[&["1/4", "1/4", "1/4", "1/4"]]).remove(0),
        gradient: None,
        algebra,
    };
    let stability = Stability::of_pair(&verlet);
    assert_eq!(stability.trace.to_string(), "(ν⁴ − 16ν² + 32)/16");
    assert_eq!(stability.intervals_text(), "(0, 4)");
    let error = stability.dispersion.expect("consistent");
    assert_eq!(error.coefficient.text, "1/96");
}

/// `M = ((1, 0), (−ν(1 − ν²/2), 1))`: the trace is 2 everywhere, and the powers are bounded only where `M = 1`.
#[test]
fn a_constant_trace_leaves_the_points_where_the_matrix_is_scalar() {
    let kick = Partitioned {
        algebra: Arc::new(Dense::new(Rationals, 2)),
        a: matrix(&[&["0", "0"], &["1", "-1"]]),
        a_tilde: matrix(&[&["1", "0"], &["0", "0"]]),
        b: matrix(&[&["0", "0"]]).remove(0),
        b_tilde: matrix(&[&["1/2", "1/2"]]).remove(0),
        gradient: None,
    };
    let stability = Stability::of_pair(&kick);
    assert_eq!(stability.trace.to_string(), "2");
    assert_eq!(stability.intervals_text(), "[sqrt(2), sqrt(2)]");
}

/// The trace of this splitting goes below −2 by less than 1e-30 at ν = 3.043: its ends there differ in the 21st digit.
#[test]
fn ends_of_neighbouring_intervals_are_shown_with_the_digits_that_distinguish_them() {
    let definition = "first: drift, symmetric: true, kick: [0.1916678, 0.3083322], \
         drift: [0.071353913450279725904, 0.268548791161230105820, 0.320194590776980336552]";
    let definition = Definition::parse(definition).expect("a definition");
    let tableau = definition.derive(&Limits::default());
    let stability = tableau.expect("derived").stability();
    let shown = "(0, 3.04299999999999999998351…) ∪ (3.04300000000000000001533…, 5.35371767219…) ∪ ";
    assert!(stability.intervals_text().starts_with(shown), "{stability}");
}

/// The trace and the spectral radius of one step, computed from the coefficients in floating-point arithmetic.
fn trace_and_radius(c: &Coefficients<f64>, nu: f64) -> (f64, f64) {
    let s = c.b.len();
    // (1 + ν²AÃ) Q = q0 + νA1 p0 by elimination with pivoting.
    let mut rows: Vec<Vec<f64>> = (0..s)
        .map(|i| {
            let mut row: Vec<f64> = (0..s)
                .map(|j| {
                    let sum: f64 = (0..s).map(|k| c.a[i][k] * c.a_tilde[k][j]).sum();
                    f64::from(u8::from(i == j)) + nu * nu * sum
                })
                .collect();
            row.extend([1.0, nu * c.a[i].iter().sum::<f64>()]);
            row
        })
        .collect();
    for k in 0..s {
        let pivot = (k..s).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs()));
        rows.swap(k, pivot.expect("a row"));
        let reference = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = row[k] / reference[k];
            row.iter_mut()
                .zip(&reference)
                .for_each(|(x, r)| *x -= factor * r);
            assert!(i < s);
        }
    }
    let column = |start: [f64; 2], column: usize| {
        let q: Vec<f64> = (0..s).map(|i| rows[i][s + column] / rows[i][i]).collect();
        let p: Vec<f64> = (0..s)
            .map(|i| start[1] - nu * (0..s).map(|j| c.a_tilde[i][j] * q[j]).sum::<f64>())
            .collect();
        let [dq, dp] = [(&c.b, &p), (&c.b_tilde, &q)]
            .map(|(b, f)| b.iter().zip(f).map(|(x, y)| x * y).sum::<f64>());
        [start[0] + nu * dq, start[1] - nu * dp]
    };
    let ([m11, m21], [m12, m22]) = (column([1.0, 0.0], 0), column([0.0, 1.0], 1));
    let (trace, determinant) = (m11 + m22, m11 * m22 - m12 * m21);
    let discriminant = trace * trace / 4.0 - determinant;
    let radius = if discriminant < 0.0 {
        determinant.sqrt()
    } else {
        trace.abs() / 2.0 + discriminant.sqrt()
    };
    (trace, radius)
}

/// The coefficients with the kicks `b̃ − 2gν²` that gradient kicks are on the oscillator.
fn kicked(mut c: Coefficients<f64>, nu: f64) -> Coefficients<f64> {
    let weights = c.gradient.iter().enumerate();
    for (j, g) in weights.filter(|(_, g)| **g != 0.0) {
        let ratio = 1.0 - 2.0 * g * nu * nu / c.b_tilde[j];
        c.b_tilde[j] *= ratio;
        c.a_tilde.iter_mut().for_each(|row| row[j] *= ratio);
    }
    c
}

#[test]
#[ignore = "thorough"]
fn the_catalogue_agrees_with_floating_point_arithmetic() {
    let (mut inside, mut outside) = (0, 0);
    // The methods whose stable steps are in the catalogue files.
    let entries = catalogue::entries().filter(|entry| entry.stages <= MAX_STAGES);
    for entry in entries {
        let tableau = entry.derive().expect("derived");
        let stability = tableau.stability();
        let coefficients = tableau.to_f64();
        assert!(stability.preserves_area, "{}", entry.name);
        let proved = tableau.tier() != crate::Tier::Enclosure;
        assert_eq!(
            stability.evidence == Evidence::Proved,
            proved,
            "{}",
            entry.name
        );
        let ends: Vec<f64> = stability
            .intervals
            .iter()
            .flat_map(|i| [i.low.to_f64(), i.high.to_f64()])
            .collect();
        for k in 1..200 {
            let nu = ratio(k * 7, 50);
            let x = to_f64(&nu);
            if ends.iter().any(|end| (end - x).abs() < 1e-3) {
                continue;
            }
            let coefficients = kicked(coefficients.clone(), x);
            let (trace, radius) = trace_and_radius(&coefficients, x);
            let stable = stability.contains(&nu);
            // Close to a touching trace the radius is 1 up to the square root of the round-off.
            assert_eq!(
                stable,
                radius < 1.0 + 1e-5,
                "{}: ν = {x}, radius {radius}",
                entry.name
            );
            *(if stable { &mut inside } else { &mut outside }) += 1;
            let exact = stability.trace.value_at(x);
            // Where a method with many stages is unstable beyond 10⁶, elimination in doubles loses all digits.
            if tableau.stages() > 8 && exact.abs() > 1e6 {
                continue;
            }
            // With more than 30 stages doubles lose half of their digits.
            let tolerance = if tableau.stages() > 30 { 1e-4 } else { 1e-6 };
            assert!(
                (trace - exact).abs() < tolerance * exact.abs().max(1.0),
                "{}: ν = {x}, traces {trace}, {exact}",
                entry.name
            );
        }
    }
    assert!(inside > 1000 && outside > 1000);
}

fn splitting(kick: &str, drift: &str) -> Stability {
    let definition = Definition::parse(&format!("kick: [{kick}], drift: [{drift}]"));
    let tableau = definition.and_then(|d| d.derive(&Limits::default()));
    tableau.expect("derived").stability()
}

/// A kick and a drift are inserted that are so small that the first stable steps do not change in 12 digits.
#[test]
fn tiny_kicks_do_not_move_the_stable_interval() {
    let near = splitting("pi, 1 - pi", "e, 1 - e").intervals[0]
        .high
        .decimal(12);
    assert_eq!(near, "0.178386584319");
    for tiny in ["1e-30", "1e-280", "1e-400"] {
        let found = splitting(
            &format!("pi, {tiny}, 1 - pi - {tiny}"),
            &format!("e, {tiny}, 1 - e - {tiny}"),
        );
        assert_eq!(
            found.evidence,
            Evidence::Verified { bits: ZERO_BITS },
            "{tiny}"
        );
        assert_eq!(found.intervals[0].high.decimal(12), near, "{tiny}");
        // The leading coefficient of the trace is nonzero: there are also stable steps at the other end.
        assert_eq!(found.intervals.len(), 2, "{tiny}");
    }
}

/// Numbers of so few digits that greatest common divisors need no fast algorithm.
#[test]
#[ignore = "thorough"]
fn many_digits_are_proved_in_bounded_time() {
    let digits = |seed: u64, count: usize| -> String {
        let next = |state: &mut u64| {
            *state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            Some(char::from(b'0' + (*state >> 33) as u8 % 10))
        };
        std::iter::successors(Some(seed), |state| Some(*state))
            .scan(seed, |state, _| next(state))
            .take(count)
            .collect()
    };
    for count in [200, 1000, 4000] {
        let [kick, drift] = [1, 2].map(|seed| {
            let [a, b] = [seed, seed + 7].map(|seed| format!("0.3{}", digits(seed, count)));
            format!("{a}, {b}, 1 - {a} - {b}")
        });
        let found = splitting(&kick, &drift);
        assert_eq!(found.evidence, Evidence::Proved);
        assert!(!found.intervals.is_empty());
    }
}

/// A matrix of all stages with these entries, and weights of a sum that is not 1.
fn dense(stages: usize, entry: impl Fn(usize) -> String) -> Tableau {
    let list = |row: usize| {
        let entries: Vec<String> = (0..stages).map(|k| entry(stages * row + k)).collect();
        format!("[{}]", entries.join(", "))
    };
    let rows: Vec<String> = (0..stages).map(list).collect();
    let definition = format!("a: [{}], b: {}", rows.join(", "), list(stages));
    let definition = Definition::parse(&definition).expect("a definition");
    definition.derive(&Limits::default()).expect("a tableau")
}

fn cost(tableau: &Tableau) -> u64 {
    over_algebra!(&tableau.exact, pair => oscillator::cost(pair))
}

/// Decimals have a common denominator, so that the matrix needs whole numbers only: 22 stages are proved. Fractions with unrelated
/// denominators would need numbers that are as long as all of these together: enclosures decide.
#[test]
#[ignore = "thorough"]
fn matrices_of_all_stages_are_decided_in_bounded_work() {
    // Digits without a pattern.
    let digits = |k: usize| (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 1;
    let decimals = dense(22, |k| format!("0.{:016}", digits(k) % 10_u64.pow(16)));
    assert!(cost(&decimals) < PRODUCTS);
    assert_eq!(decimals.stability().evidence, Evidence::Proved);
    let fraction = |k: usize| {
        format!(
            "{}/{}",
            digits(k) % 99_999_989,
            digits(k + 7) % 99_999_971 + 1
        )
    };
    let [few, many] = [4, 22].map(|stages| dense(stages, fraction));
    assert!(cost(&few) < PRODUCTS && cost(&many) > 10 * PRODUCTS);
    assert_eq!(few.stability().evidence, Evidence::Proved);
    assert!(
        matches!(many.stable_steps(), StableSteps::All(found) if found.evidence != Evidence::Proved)
    );
}

/// The work that decides stability is bounded; the printed end points are still correct to any number of digits.
#[test]
fn more_digits_do_not_change_the_first_ones() {
    for name in ["forest-ruth-1990", "triple-jump-6", "exponential-lobatto-2"] {
        let tableau = catalogue::find(name).expect(name).derive().expect(name);
        let ends = |digits| -> Vec<String> {
            let intervals = tableau.stability().intervals;
            intervals.iter().map(|i| i.high.decimal(digits)).collect()
        };
        for (few, many) in ends(100).iter().zip(ends(2000)) {
            assert!(many.starts_with(&few[..few.len() - 1]), "{name}: {few}");
        }
    }
}

/// The difference of large numbers that cancel is not zero.
#[test]
fn a_difference_of_large_numbers_is_not_taken_for_zero() {
    for size in ["exp(1000)", "exp(2000)", "(10^200)^2*pi"] {
        let found = splitting(&format!("{size}, 1, -{size}"), "pi, 1 - pi, 0");
        let trace = found.trace.to_string();
        assert!(trace == "2 − ν²" || !found.is_decided(), "{size}: {trace}");
        assert!(found.is_decided() || size != "exp(1000)");
        let found = splitting("e, 1 - e", &format!("{size}, 1 - {size}"));
        assert!(!found.intervals.is_empty() || !found.is_decided(), "{size}");
    }
    // Rows with the sum 1/2: the midpoint rule.
    for size in ["exp(900)", "exp(1450)"] {
        let text = format!("a: [[{size}, 1/2 - {size}], [pi, 1/2 - pi]], b: [1/2, 1/2]");
        let definition = Definition::parse(&text).expect("text");
        let tableau = definition.derive(&Limits::default()).expect("derived");
        let found = tableau.stability();
        assert!(found.p_stable || !found.is_decided(), "{size}");
        if let Some(dispersion) = &found.dispersion {
            assert_eq!(dispersion.order, 2, "{size}");
        }
    }
}

/// A third of a step is moved by 5e-701, which is the difference of large numbers: two end points stay distinct.
#[test]
fn a_small_difference_of_large_numbers_keeps_end_points_distinct() {
    let tiny = "(sqrt((10^350)^4 + 1) - (10^350)^2)";
    let found = splitting(
        &format!("1/6, 1/3 + {tiny}, 1/3 - {tiny}, 1/6"),
        "1/3, 1/3, 1/3, 0",
    );
    assert!(found.intervals.len() > 1 || !found.is_decided());
    let text = format!("base: velocity-verlet, weights: [{tiny}, pi, e, 1 - pi - e - {tiny}]");
    let definition = Definition::parse(&text).expect("text");
    let tableau = definition.derive(&Limits::default()).expect("derived");
    assert_eq!(
        tableau.numbers().c_tilde[0].decimal(3).to_string(),
        "2.50e-701"
    );
}
