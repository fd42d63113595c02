//! Fitted methods against closed forms and against the methods that are derived for single frequencies.

use super::*;
use crate::arithmetic::rational::ratio;

fn fitted(text: &str) -> Fitted {
    let definition = Definition::parse(text).expect(text);
    Fitted::derive(&definition, &Limits::default()).expect(text)
}

fn error(text: &str) -> String {
    let definition = Definition::parse(text).expect(text);
    let error = Fitted::derive(&definition, &Limits::default()).expect_err(text);
    error.to_string()
}

const LOBATTO_3: &str = "parameters: w, basis: [1, cos(w*t), sin(w*t)], nodes: [0, 1/2, 1]";
const GAUSS_2: &str = "parameters: w, basis: [cos(w*t), sin(w*t)], nodes: gauss(2)";
const GAUSS_3: &str = "parameters: w, basis: [1, cos(w*t), sin(w*t)], nodes: gauss(3)";
const LOBATTO_4: &str = "parameters: w, basis: [1, t, cos(w*t), sin(w*t)], nodes: lobatto(4)";

#[test]
fn weights_of_three_nodes_have_their_closed_form() {
    let method = fitted(LOBATTO_3);
    let ring = method.ring();
    let whole = |n: i64, d: i64| ring.rational(ratio(n, d));
    // b_1 = (1 − sin(ν/2)/(ν/2))/(2 − 2 cos(ν/2))
    let wave = |power, n, d, sine, c| ring.wave(power, whole(n, d), sine, whole(c, 1));
    let numerator = ring.subtract(&ring.one(), &wave(-1, 1, 2, true, 2));
    let denominator = ring.add(&wave(0, 0, 1, false, 2), &wave(0, 1, 2, false, -2));
    let expected = ring.quotient(numerator, denominator);
    let (_, weights) = method.constructed();
    assert!(ring.equal(&weights[0], &expected));
    assert!(ring.equal(&weights[2], &expected));
    assert!(!ring.equal(&weights[1], &expected));
}

#[test]
fn orders_are_those_of_the_polynomial_method_at_the_same_nodes() {
    for (text, order) in [(LOBATTO_3, 4), (GAUSS_2, 4), (GAUSS_3, 6), (LOBATTO_4, 6)] {
        let method = fitted(text);
        let orders = method.orders().expect(text);
        assert_eq!(orders.general.order, order, "{text}");
        assert_eq!(
            orders.general.violated.map(|(vertices, _)| vertices > 0),
            Some(true)
        );
        assert!(method.is_symmetric(), "{text}");
    }
    assert!(fitted(LOBATTO_3).is_consistent());
    assert!(!fitted(GAUSS_2).is_consistent());
}

#[test]
fn limits_are_the_polynomial_methods() {
    let method = fitted(GAUSS_2);
    let series = method.series(3).expect("a limit");
    let gauss = crate::derive("polynomial(2)", "gauss(2)").expect("gauss");
    let gauss = gauss.to_f64();
    for (row, known) in series.a.iter().zip(&gauss.a) {
        for (x, known) in row.iter().zip(known) {
            assert_eq!(method.number(&x[0]).to_f64(), *known);
        }
    }
}

#[test]
fn coefficients_at_a_number_are_those_derived_there() {
    for text in [LOBATTO_3, GAUSS_2, LOBATTO_4] {
        let method = fitted(text);
        let at = method.definition_at("3/4").expect(text);
        let exact = at.derive(&Limits::default()).expect(text).to_f64();
        let series = method.series(40).expect(text);
        let pairs = series.map(|x| {
            let terms = x.iter().rev();
            terms.fold(0.0, |sum, c| sum * 0.75 + method.number(c).to_f64())
        });
        for (x, y) in pairs.zip(exact).iter() {
            assert!((x - y).abs() < 1e-14, "{text}: {x} {y}");
        }
    }
}

#[test]
fn the_span_on_which_momenta_are_exact_is_decided() {
    let exact = fitted(LOBATTO_3).exact_on();
    assert_eq!(exact.velocities, [0, 1, 2]);
    assert_eq!(exact.step, [0, 1, 2]);
    assert_eq!(exact.forces, Vec::<usize>::new());
    let exchanged = fitted(&format!("{LOBATTO_3}, exchange: true")).exact_on();
    assert_eq!(exchanged.forces, [0, 1, 2]);
}

#[test]
fn the_phase_error_at_the_frequency_is_found() {
    for (text, known) in [
        (LOBATTO_3, (5, ratio(1, 576))),
        (GAUSS_2, (7, ratio(1, 13_824))),
        (GAUSS_3, (9, ratio(1, 3_600_000))),
    ] {
        let method = fitted(text);
        let (power, value) = known;
        let coefficient = method.ring().rational(value);
        let known = PhaseError::Leading { power, coefficient };
        assert_eq!(method.phase_error(), Ok(known), "{text}");
    }
}

#[test]
fn definitions_that_cannot_be_fitted_are_refused_with_the_reason() {
    let cases = [
        (
            "parameters: w, basis: [1, exp(w*t)], nodes: [0, 1]",
            "`exp(w*t)` is not supported",
        ),
        (
            "parameters: w, basis: [1, t], nodes: [0, 1]",
            "the parameter `w` is in none",
        ),
        (
            "parameters: t, basis: [1, t], nodes: [0, 1]",
            "the name of a frequency",
        ),
        (
            "parameters: [v, w], basis: [1, t], nodes: [0, 1]",
            "one frequency",
        ),
        (
            "parameters: w, basis: [cos(w*t), sin(w*t)], nodes: [0, 1/2, 1]",
            "2 ",
        ),
        (
            "parameters: w, basis: [cos(w*t), 2*cos(w*t)], nodes: [0, 1]",
            "vanishes at all nodes",
        ),
        ("parameters: w, kick: [1], drift: [1]", "leave out `kick`"),
    ];
    for (text, message) in cases {
        assert!(error(text).contains(message), "{text}: {}", error(text));
    }
}
