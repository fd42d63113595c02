//! Formulas: what is emitted for them, what is refused, and their derivatives.

use crate::formula::{self, Wide};
use expect_test::expect_file;
use f256::f256;
use proc_macro2::TokenStream;
use proptest::prelude::*;
use quote::{format_ident, quote};
use symplectic_formula::derivative::gradient;
use symplectic_formula::display::Notation;
use symplectic_formula::emit::{Header, system};
use symplectic_formula::evaluate::{Evaluator, Point};
use symplectic_formula::graph::{Half, integer};
use symplectic_formula::hessian::MomentumHessian;
use symplectic_formula::{Form, Kinetic, Structure, System, description};

fn read(text: &str) -> (System, Structure) {
    formula::read(Form::Hamiltonian, text)
}

fn code(text: &str) -> String {
    let (read, structure) = read(text);
    formula::code(&read, &structure)
}

fn refused(text: &str) -> String {
    formula::refused(Form::Hamiltonian, text)
}

const DOUBLE_PENDULUM: &str = "DoublePendulum { g: 9.81 }
    q: [a, b], p: [pa, pb];
    let d = a - b;
    H = (pa^2 + 2 pb^2 - 2 pa pb cos(d)) / (2 (1 + sin(d)^2)) - g (2 cos(a) + cos(b))";

const PLANETS: &str = "Planets<N> { m: [N], G: 2.95912208286e-4 }
    q: [N; 3], p: [N; 3];
    H = sum(i in 0..N: |p[i]|^2 / (2 m[i])) - sum(i < j: G m[i] m[j] / |q[i] - q[j]|)
    invariants: { momentum = sum(i: p[i]), angular_momentum = sum(i: q[i] × p[i]) }
    require: [separable, quadratic_kinetic]";

const FPUT: &str = "Fput { beta: 1 }
    q: [..], p: [..]; bonds: walls;
    H = sum(i: p[i]^2 / 2) + sum(bonds d: d^2/2 + beta d^4/4)";

#[test]
fn code_of_the_example_formulas_has_the_recorded_text() {
    for (text, name) in [
        (DOUBLE_PENDULUM, "double_pendulum"),
        (PLANETS, "planets"),
        (FPUT, "fput"),
    ] {
        expect_file![format!("emitted/formula_{name}.rs")].assert_eq(&code(text));
    }
}

#[test]
fn the_code_does_not_grow_with_the_number_of_bodies() {
    let bodies = |n: usize| {
        code(&format!(
            "Planets {{ m: [{n}], G: 1 }} q: [{n}; 3], p: [{n}; 3];
             H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)"
        ))
    };
    let [fifty, thousand] = [50, 1000].map(|n| bodies(n).split_whitespace().collect::<String>());
    assert!(fifty.replace("50", "1000") == thousand);
}

#[test]
fn numbers_without_parameters_are_doubles_in_lanes_too() {
    let code = code("Well { a } q: [x], p: [px]; H = px^2/2 + sqrt(2) x^4/4 + exp(-a) x^2");
    assert!(code.contains("Scalar::sqrt(2.0)") && code.contains("Scalar::exp(-self.a)"));
    // Only the exponential of a parameter is computed in every lane.
    assert!(
        !code.contains(".sqrt()") && code.contains(".exp()"),
        "{code}"
    );
}

#[test]
fn the_structure_of_a_formula_is_recognised() {
    let kinetic = |h: &str| {
        read(&format!(
            "S {{ m: 2, A: [2, 2] }} q: [x, y], p: [px, py]; H = {h}"
        ))
        .1
    };
    assert_eq!(kinetic("(px^2 + py^2 + x^2)/2").kinetic, Kinetic::Unit);
    assert_eq!(kinetic("|p|^2/2 + x y").kinetic, Kinetic::Unit);
    assert_eq!(
        kinetic("px^2/(2 m) + py^2 + t px - cos(x)").kinetic,
        Kinetic::Diagonal
    );
    assert_eq!(
        kinetic("dot(p, A p)/2 - cos(x)").kinetic,
        Kinetic::Quadratic
    );
    assert_eq!(
        kinetic("sqrt(1 + px^2 + py^2) + x^2").kinetic,
        Kinetic::General
    );
    assert_eq!(kinetic("t px^2 + py^2").kinetic, Kinetic::General);
    assert!(kinetic("px^2 + py^2 + (px + x)^2").split.is_err());
    let polar = kinetic("(px^2 + py^2/x^2)/2 - 1/x");
    assert_eq!(polar.cyclic, [1]);
    assert!(polar.split.is_err() && !polar.time_dependent);
    let kepler = read("K q: [3], p: [3]; H = |p|^2/2 - 1/|q| + 0.1 q[2]").1;
    assert_eq!(kepler.rotations, [[0, 1]]);
    let planets = read(PLANETS).1;
    assert_eq!(planets.translations, [0, 1, 2]);
    assert_eq!(planets.rotations, [[0, 1], [0, 2], [1, 2]]);
    assert!(read(FPUT).1.chain.is_some());
    let unequal = FPUT.replace("p[i]^2 / 2", "p[i]^2");
    assert!(read(&unequal).1.chain.is_none());
}

#[test]
fn wrong_formulas_are_refused_at_their_place() {
    let pendulum = |h: &str| refused(&format!("P {{ g: 9.81, m: [3] }} q: [a], p: [pa]; H = {h}"));
    let bodies = |h: &str| {
        refused(&format!(
            "B<N> {{ m: [N], c: [3] }} q: [N; 3], p: [N; 3]; H = {h}"
        ))
    };
    let all = [
        pendulum("pa^2/2 - g cos(b)"),
        pendulum("pa^2/2 - g cso(a)"),
        pendulum("pa^2/2 - m[3] a"),
        pendulum("pa^2/2 - m a"),
        pendulum("pa^2/2 - g/0 a"),
        pendulum("pa^2/2 - a/(1 - 1)"),
        pendulum("pa^2/2 - abs(a)"),
        pendulum("pa^2/2 + |a|"),
        pendulum("pa^2/2 + max(a, 0)"),
        pendulum("pa^2/2 + a/g a"),
        pendulum("cos(a)"),
        pendulum("pa^2/2 + sum(i: m[i])"),
        pendulum("pa^2/2 + sqrt(-1)"),
        pendulum("pa^2/2 + (a"),
        pendulum("pa^2/2 + atan2(a)"),
        pendulum("pa^2/2 + a 2"),
        bodies("sum(i: |p[i]|^2) + sum(i: |q[i] - m[i]|)"),
        bodies("sum(i: |p[i]|^2) + sum(i: |q[i] - m|)"),
        bodies("sum(i: |p[i]|^2) + sum(i: |q[i+1] - q[i]|)"),
        bodies("sum(i: |p[i]|^2) + sum(i: c[i])"),
        bodies("sum(i: |p[i]|^2) + q[0][3]"),
        bodies("sum(i: p[i]^2)"),
        bodies("sum(i: |p[i]|^2 + q[i])"),
        bodies("sum(i: |p[i]|^2) + sum(i: sum(i: m[i]))"),
        refused("P { a: 1 } q: [a], p: [pa]; H = pa^2"),
        refused("P q: [a, b], p: [pa]; H = pa^2"),
        refused("P q: [a, b], p: [pa, pb]; H = pa^2"),
        refused("P q: [a], p: [pa];"),
        refused("P q: [t], p: [pt]; H = pt^2"),
        refused("P H = 1"),
        refused("P q: [N; 3], p: [N; 3]; H = 1"),
        refused("P q: [x], p: [px]; H = px^2 + x px require: [separable]"),
        refused("P q: [x], p: [px]; H = sqrt(1 + px^2) + x require: [quadratic_kinetic]"),
        refused("P q: [x], p: [px]; H = px^2 + x cos(t) require: [time_independent]"),
        refused("P q: [x], p: [px]; H = px^2 + x require: [fast]"),
        refused("P q: [x], p: [px]; H = px^2 + x^2 invariants: { momentum = px }"),
        refused("P { eps: 0 } q: [x], p: [px]; H = px^2 + eps x^2 invariants: { momentum = px }"),
        refused(
            "P q: [x], p: [px]; extern fn V with dV, d2V; H = px^2 + V(x) invariants: { momentum = px }",
        ),
        refused(
            "P<N> q: [N], p: [N]; let s = sum(i: q[i]); H = sum(i: p[i]^2 + q[i]^2 s) invariants: { bad = sum(i: q[i]) }",
        ),
        refused("P q: [x], p: [px]; H = px^2 invariants: { a = px, a = px }"),
        refused("P<i> q: [i], p: [i]; H = sum(a < b: p[a] p[b])"),
        refused("P { self } q: [x], p: [px]; H = px^2/2 + self x^2"),
        refused("P { super: 2 } q: [x], p: [px]; H = px^2/2 + super x^2"),
        refused("P { crate: 2 } q: [x], p: [px]; H = px^2/2 + crate x^2"),
        refused("P<Self> { m: [Self] } q: [Self], p: [Self]; H = sum(i: p[i]^2)"),
        refused("P { fn: 2 } q: [x], p: [px]; H = px^2/2 + fn x^2"),
        refused("P q: [x], p: [px]; extern fn force with dV, d2V; H = px^2 + force(x)"),
        refused("P q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + sum(i in 0..2: q[i]^2)"),
        refused("P q: [3], p: [3]; H = |p|^2 + sum(i in -1..2: q[i+1]^4)"),
        refused("P q: [x], p: [px]; H = px^2 + ((((((x^999)^999)^999)^999)^999)^999)^999"),
        refused("P q: [x], p: [px]; H = px^2 + x^((((1/3)^400)^400)^400)"),
        refused("P q: [x, y], p: [px, py]; H = px^2 + py^2 constraints: { rod = x^2 + px - 1 }"),
        refused("P q: [x, y], p: [px, py]; H = px^2 + py^2 constraints: { rod = x - t }"),
        refused("P { l: 1 } q: [x, y], p: [px, py]; H = px^2 + py^2 constraints: { rod = l - 1 }"),
        refused("P q: [x, y], p: [px, py]; H = px^2 + py^2 constraints: { rod = x, rod = y }"),
        refused("P q: [x, y], p: [px, py]; H = px^2 + py^2 constraints: { x = y }"),
        refused(
            "P<N> q: [N], p: [N]; H = sum(i: p[i]^2) constraints: { all(i < j) = q[i] - q[j] }",
        ),
        refused("P q: [..], p: [..]; H = sum(i: p[i]^2) constraints: { all(i) = q[i] }"),
        refused(
            "P<N> q: [N], p: [N]; bonds: free; H = sum(i: p[i]^2) constraints: { all(bonds d) = d }",
        ),
        refused(
            "P<N> q: [N], p: [N]; H = sum(i: p[i]^2) constraints: { all(i in 1..N) = q[i] - q[i-2] }",
        ),
        refused(
            "P q: [x, y], p: [px, py]; H = px^2 + py^2 constraints: { rod = x } invariants: { momentum = px + py }",
        ),
        refused("P q: [x, y], p: [px, py]; H = px^2 + py^2 constraints: rod = x"),
        refused("P q: [x], p: [px]; H = px^2 + x^2 friction: x"),
        refused("P q: [x], p: [px]; H = px^2 + x^2 friction: 1 friction: 2"),
        refused("P q: [x, y], p: [px, py]; H = px^2 + py^2 friction: [1, 2, 3]"),
        refused("P q: [x, y], p: [px, py]; H = px^2 + py^2 friction: [1]"),
        refused("P q: [x, y], p: [px, py]; H = px^2 + py^2 friction: [1, x]"),
        refused("P q: [x], p: [px]; H = px^2 friction: [1, 2]"),
        refused("P<N> { g: [N] } q: [N], p: [N]; H = sum(i: p[i]^2) friction: g"),
        refused("P { g: [..] } q: [..; 2], p: [..; 2]; H = sum(i: |p[i]|^2) friction: g"),
        refused("P<N> { g: [N, 2] } q: [N; 2], p: [N; 2]; H = sum(i: |p[i]|^2) friction: g"),
        refused("P q: [x], p: [px]; H = px^2 + x px friction: 1"),
        refused("P q: [x], p: [px]; H = px^2 friction: 1 invariants: { momentum = px }"),
        refused("P q: [x, y], p: [px, py]; H = px^2 + py^2 friction: 1 constraints: { rod = x }"),
        refused(
            "P q: [a, b, c, d], p: [pa, pb, pc, pd]; H = pa^2 + pb^2 + pc^2 + pd^2 friction: 1 constraints: { rod = a }",
        ),
        refused("P q: [4], p: [4]; H = |p|^2 friction: 1 constraints: { rod = q[0] }"),
        refused("P q: [x], p: [px]; H = px^2 force: { px = 1 }"),
        refused("P q: [x], p: [px]; H = px^2 force: { z = 1 }"),
        refused("P q: [x], p: [px]; H = px^2 force: -px"),
        refused("P q: [x], p: [px]; H = px^2 force: { x = [1, 2] }"),
        refused("P q: [x], p: [px]; H = px^2 force: { x + 1 = 2 }"),
        refused("P q: [x], p: [px]; H = px^2 force: { x = |px| }"),
        refused("P q: [N], p: [N]; H = |p|^2 force: { q[i] = 1 }"),
        refused("P<N> q: [N; 2], p: [N; 2]; H = sum(i: |p[i]|^2) force: { q[i] = 1 }"),
        refused("P<N> q: [N], p: [N]; H = sum(i: p[i]^2) force: { q[i](i in 1..N) = p[i-2] }"),
        refused("P q: [3], p: [3]; H = |p|^2 force: { q[3] = 1 }"),
        refused("P q: [x], p: [px]; H = px^2 friction: 1 force: { x = -px }"),
        refused("P q: [x], p: [px]; H = px^2 force: { x = -px } require: [separable]"),
        refused("P q: [x], p: [px]; H = px^2 force: { x = cos(t) } require: [time_independent]"),
        refused("P q: [x], p: [px]; H = px^2 force: { x = 1 } invariants: { momentum = px }"),
        refused(
            "P<N> q: [N], p: [N]; H = sum(i: p[i]^2) force: { q[i] = -p[i] } invariants: { total = sum(i: p[i]) }",
        ),
        refused(
            "P q: [x, y], p: [px, py], v: [vx, vy]; H = px^2 + py^2 nonholonomic: { edge = vx - y vy^2 }",
        ),
        refused(
            "P q: [x, y], p: [px, py], v: [vx, vy]; H = px^2 + py^2 nonholonomic: { edge = vx - x y }",
        ),
        refused(
            "P q: [x, y], p: [px, py], v: [vx, vy]; H = px^2 + py^2 nonholonomic: { edge = vx - py }",
        ),
        refused(
            "P q: [x, y], p: [px, py], v: [vx, vy]; H = px^2 + py^2 nonholonomic: { edge = vx - t vy }",
        ),
        refused(
            "P q: [x, y], p: [px, py], v: [vx, vy]; H = px^2 + py^2 nonholonomic: { edge = vx - vx }",
        ),
        refused(
            "P q: [x, y], p: [px, py], v: [vx, vy]; H = px^2 + py^2 + vx nonholonomic: { edge = vx }",
        ),
        refused("P q: [x, y], p: [px, py], v: [vx]; H = px^2 + py^2 nonholonomic: { edge = vx }"),
        refused(
            "P q: [x, y], p: [px, py], v: [vx, x]; H = px^2 + py^2 nonholonomic: { edge = vx }",
        ),
        refused("P q: [x, y], p: [px, py]; H = px^2 + py^2 nonholonomic: { edge = vx }"),
        refused("P q: [x, y], p: [px, py], v: [vx, vy]; H = px^2 + py^2"),
        refused(
            "P q: [x, y], p: [px, py], v: [vx, vy]; H = px^2 + py^2 constraints: { rod = x } nonholonomic: { edge = vx }",
        ),
        refused(
            "P q: [x, y], p: [px, py], v: [vx, vy]; H = px^2 + py^2 friction: 1 nonholonomic: { edge = vx }",
        ),
        refused(
            "P q: [x, y], p: [px, py], v: [vx, vy]; H = px^2 + py^2 nonholonomic: { edge = vx } invariants: { momentum = py }",
        ),
        pendulum("pa^2/2 + asin(2) a"),
        pendulum("pa^2/2 + acos(-3/2) a"),
        pendulum("pa^2/2 + asin(sqrt(2)) a"),
        pendulum("pa^2/2 + a^2/sin(pi)"),
        pendulum("pa^2/2 + a^2/(sqrt(2) - sqrt(2))"),
        pendulum("pa^2/2 + tan(-3 pi/2) a"),
        pendulum("pa^2/2 + exp(1000) a"),
        pendulum("pa^2/2 + 1e400 a"),
        pendulum("pa^2/2 + (-2)^a"),
        pendulum("pa^2/2 + ln(sqrt(2) - 2) a"),
        pendulum("pa^2/2 + sqrt(a^2)"),
        pendulum("pa^2/2 + (a^2)^(1/2)"),
        pendulum("pa^2/2 + sqrt(4 a^2 (1 + pa^2))"),
        pendulum("pa^2/2 + ((a - 1)^4)^(3/8)"),
        pendulum("pa^2/2 + besselj(0, a)"),
        pendulum("pa^2/2 + erf(a)"),
        pendulum("pa^2/2 + log(a)"),
        pendulum("pa^2/2 + a**2"),
        pendulum("pa^2/2 + a.powi(2)"),
        pendulum("pa^2/2 + a.cos()"),
        pendulum("pa^2/2 + e^a"),
        pendulum("pa^2/2 + foo"),
        refused("P q: [x], p: [px]; H = (px^2 + x^2)/2 constrains: { r = x }"),
        refused("P q: [x], p: [px]; H = px^2/2 + x forces: { x = -px }"),
        refused("P q: [x], p: [px]; H = px^2/2 + x; requires: [separable]"),
        refused("P q: [x], p: [px]; let b = c/2; let c = 3; H = px^2 + b x^2"),
        refused("P q: [x], p: [px]; let b = c(2); let c(y) = y^2; H = px^2 + b x^2"),
        refused("P q: [3], p: [3]; let u(i, j) = q[i] q[j]; H = |p|^2/2 + u(1/2, 1)"),
        refused("P q: [3], p: [3]; let u(i, j) = q[i] q[j]; H = |p|^2/2 + u(0, 3)"),
    ];
    expect_file!["data/formulas_refused.txt"].assert_eq(&(all.join("\n\n") + "\n"));
}

/// What resembles a refused formula, but is smooth and finite.
#[test]
fn smooth_and_finite_formulas_are_accepted() {
    for h in [
        "asin(1) a + acos(-1) a^2",
        "a^2/sin(pi/2) + tan(pi/4) a + a cos(3 pi)",
        "sqrt((1 + a^2)^2) + sqrt(exp(a)^2)",
        "sqrt(a^4) + (a^2)^(3/2) + (a^2)^(-1/2)",
        "sqrt(g^2) a + sqrt(t^2) a^2",
        "2^a + exp(700) a",
    ] {
        let text = format!("P {{ g: 9.81 }} q: [a], p: [pa]; H = pa^2/2 + {h}");
        let (mut read, structure) = read(&text);
        read.check(&structure, &text).expect(&text);
    }
    // An exact zero, and whole numbers as arguments.
    let zero = "P q: [a], p: [pa]; H = pa^2/2 + sin(2 pi) a^4 + cos(pi/2) a^3 + cos(pi) a";
    assert_eq!(code(zero), code("P q: [a], p: [pa]; H = pa^2/2 - a"));
    let called = "P q: [3], p: [3]; let u(i, j) = q[i] q[j]; H = |p|^2/2 + u(0, 2)";
    let written = "P q: [3], p: [3]; H = |p|^2/2 + q[0] q[2]";
    assert_eq!(code(called), code(written));
}

/// Dampers between pairs leave the total momentum alone, and a rotation does not see a central force.
#[test]
fn applied_forces_keep_only_the_invariants_that_are_proved() {
    for (text, proved) in [
        (
            "P { dampers: pairs } q: [..], p: [..]; H = sum(i: p[i]^2/2)
             force: { q[i]((i, j) in dampers) = p[j] - p[i], q[j]((i, j) in dampers) = p[i] - p[j] }
             invariants: { total = sum(i: p[i]) }",
            false,
        ),
        (
            "P q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 - 1/|[x, y]|
             force: { x = -x sin(t), y = -y sin(t) }
             invariants: { angular_momentum = x py - y px }",
            false,
        ),
        (
            "P q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 force: { x = -px } invariants: { momentum = py }",
            true,
        ),
    ] {
        let (mut read, structure) = read(text);
        read.check(&structure, text).expect("conserved");
        assert_eq!(read.invariants[0].proved, proved, "{text}");
        assert!(structure.translations.is_empty() && structure.rotations.is_empty());
    }
}

/// The class, the equations and the second derivatives with a force.
#[test]
fn a_formula_with_a_force_has_the_recorded_code_and_equations() {
    let (read, structure) = read(
        "Drone { c: 0.1, g: 9.81 } q: [x, y], p: [px, py];
         H = (px^2 + py^2)/2 + g y force: { y = -c py |[px, py]|, x = -c px |[px, py]| + sin(t) }",
    );
    expect_file!["emitted/formula_forced.rs"].assert_eq(&formula::code(&read, &structure));
    expect_file!["data/forced.txt"].assert_eq(&description::text(&read, &structure));
    expect_file!["data/forced.latex"].assert_eq(&description::latex(&read, &structure));
}

/// Of a hundred names or numbers, with a force on one of them.
#[test]
fn every_coordinate_has_an_equation() {
    let names = |letter: &str, sign: &str| {
        let names = (0..100).map(|k| format!("{letter}{k}"));
        names.collect::<Vec<_>>().join(sign)
    };
    let (q, p) = (names("x", ", "), names("y", ", "));
    let squares = names("y", "^2 + ");
    let (named, _) = read(&format!("S q: [{q}], p: [{p}]; H = {squares}^2 + x7"));
    let lines = named.equations_of_motion(Notation::Text);
    assert_eq!(lines.len(), 200);
    assert_eq!((&*lines[107], &*lines[108]), ("y7' = −1", "y8' = 0"));
    let (numbered, _) = read("S q: [100], p: [100]; H = sum(i: p[i]^2/2) + q[7]");
    let lines = numbered.equations_of_motion(Notation::Text);
    assert_eq!(lines[1..], ["p'[i] += 0    (0 ≤ i < 100)", "p'[7] += −1"]);
}

#[test]
fn a_rate_of_friction_for_each_component() {
    let (read, structure) =
        read("P { g } q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 friction: [g, 2 g]");
    let facts = description::facts(&read, &structure).join("; ");
    assert!(facts.contains("friction −γp with γ = [g, 2 g]"), "{facts}");
    let friction = &description::json(&read, &structure)["friction"];
    let texts = [&friction["text"], &friction["latex"]];
    assert_eq!(texts, ["[g, 2 g]", r"[g, 2\,g]"]);
}

/// The advice of the error for a rate for each body.
#[test]
fn a_rate_of_friction_for_each_body() {
    for layout in [
        "q: [N], p: [N]; H = sum(i: p[i]^2)",
        "q: [N; 2], p: [N; 2]; H = sum(i: |p[i]|^2)",
    ] {
        let text = format!("P<N> {{ g: [N] }} {layout} force: {{ q[i] = -g[i] p[i] }}");
        let (mut read, structure) = read(&text);
        read.check(&structure, &text).expect("a force");
        assert!(read.force_of_momenta().is_some());
    }
}

#[test]
fn degenerate_and_polynomial_hamiltonians_are_found() {
    let found = |h: &str| {
        let (_, structure) = read(&format!("S {{ g }} q: [x, y], p: [px, py]; H = {h}"));
        (structure.hessian, structure.degree)
    };
    let singular = MomentumHessian::Singular { rank: 1, size: 2 };
    for (h, hessian, degree) in [
        ("x px + y py", MomentumHessian::Zero, Some(2)),
        ("x px + y^2 py^2", singular, Some(4)),
        ("(px + py)^2/2 - x", singular, Some(2)),
        ("(px cos(x) + py sin(x))^2/2", singular, None),
        // Singular by identities that are seen exactly, and by one that is seen in doubles.
        (
            "px^2 cos(x)^2 + py^2 (1 - cos(x)^2) + px py sin(2 x)",
            singular,
            None,
        ),
        (
            "px^2 cos(x)^2 + py^2 (1 - cos(x)^2) + 2 px py sin(x) cos(x)",
            singular,
            None,
        ),
        ("px py", MomentumHessian::Regular, Some(2)),
        // In any units.
        ("px^2/2e-27 + py^2/2", MomentumHessian::Regular, Some(2)),
        (
            "1e27 px^2/2 + 1e13 px py + py^2",
            MomentumHessian::Regular,
            Some(2),
        ),
        ("sqrt(1 + |p|^2) + x", MomentumHessian::Regular, None),
        // A polynomial with coefficients that are not.
        (
            "|p|^2 exp(t) + sqrt(g) x^3",
            MomentumHessian::Regular,
            Some(3),
        ),
        // The fourth powers cancel.
        (
            "|p|^2 + (x + y)^4 - (x^2 + 2 x y + y^2)^2 + x y^2",
            MomentumHessian::Regular,
            Some(3),
        ),
        ("|p|^2 + (x + 1)^2 - x^2", MomentumHessian::Regular, Some(2)),
        ("|p|^2 + x/(1 + y^2)", MomentumHessian::Regular, None),
        (
            "|p|^2/(2 + g) + (x^2)^(3/2)",
            MomentumHessian::Regular,
            None,
        ),
    ] {
        assert_eq!(found(h), (hessian, degree), "{h}");
    }
    let fput = read(FPUT).1;
    assert_eq!(
        (fput.hessian, fput.degree),
        (MomentumHessian::Regular, Some(4))
    );
    let bodies = |h: &str| read(&format!("S<N> q: [N; 2], p: [N; 2]; H = {h}"));
    let (system, structure) = bodies("sum(i: p[i][0]^2 + p[i][1]) + sum(i < j: |q[i] - q[j]|^2)");
    assert!(matches!(
        structure.hessian,
        MomentumHessian::Singular { .. }
    ));
    let facts = description::facts(&system, &structure).join("; ");
    assert!(
        facts.contains("degenerate: ∂²H/∂p² is singular at random points"),
        "{facts}"
    );
    assert!(facts.contains("a polynomial of degree 2"), "{facts}");
    let coupled = bodies("sum(i: p[i][0])^2 + sum(i < j: |p[i] - p[j]|^2)").1;
    assert!(matches!(coupled.hessian, MomentumHessian::Singular { .. }));
    let planets = read(PLANETS).1;
    assert_eq!(
        (planets.hessian, planets.degree),
        (MomentumHessian::Regular, None)
    );
}

#[test]
fn symmetries_that_do_not_hold_are_not_reported() {
    let springs = read("S q: [3], p: [3]; bonds: free; H = |p|^2/2 + sum(bonds d: d^2/2)").1;
    assert!(springs.rotations.is_empty());
    let line = read("S q: [2], p: [2]; H = |p|^2/2 + sum(i in 0..1: (q[i+1] - q[i])^2)").1;
    assert!(line.rotations.is_empty());
    let mean = read("S<N> q: [N], p: [N]; H = sum(i: p[i])^2/2 + sum(i: p[i]^2/2)").1;
    assert_eq!(mean.kinetic, Kinetic::Quadratic);
    let (read, _) = read(
        "S q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 - cos(x) invariants: { e = py^2, h = px^2/2 - cos(x) }",
    );
    let proved: Vec<bool> = read
        .invariants
        .iter()
        .map(|invariant| invariant.proved)
        .collect();
    assert_eq!(proved, [true, true]);
}

/// Each of these is refused, or its code is short: nothing is expanded without bound.
fn assert_bounded(texts: &[String]) {
    for text in texts {
        if let Ok(mut read) = System::read("long", text) {
            let structure = Structure::of(&mut read);
            let _ = read.check(&structure, text);
            let header = Header {
                attributes: TokenStream::new(),
                visibility: quote!(pub),
                name: format_ident!("S"),
            };
            let code = system(&read, &structure, &header).to_string();
            assert!(code.len() < 10_000_000);
        }
    }
}

/// A sum of calls of a function that is itself a long sum.
fn calls_of_a_sum(terms: u32, calls: u32) -> String {
    let terms: String = (0..terms).map(|k| format!(" + {k} a^2")).collect();
    let calls: String = (1..calls).map(|k| format!(" + f({k} x)")).collect();
    format!("S q: [x], p: [px]; let f(a) = 1{terms}; H = px^2{calls}")
}

/// Values each of which contains the one before it twice.
fn doubled(count: u32) -> String {
    let values: String = (1..count)
        .map(|k| format!("let a{k} = g a{0} + h a{0}; ", k - 1))
        .collect();
    let last = count - 1;
    format!("S {{ g, h }} q: [x], p: [px]; let a0 = x px; {values} H = px^2 + a{last}")
}

/// The fourth power of a sum of all coordinates.
fn power_of_a_sum(coordinates: u32) -> String {
    let names = |letter: &str| -> Vec<String> {
        (0..coordinates).map(|k| format!("{letter}{k}")).collect()
    };
    let [q, p] = ["x", "y"].map(names);
    format!(
        "S q: [{}], p: [{}]; H = ({})^4 + |p|^2",
        q.join(","),
        p.join(","),
        q.join("+")
    )
}

#[test]
fn formulas_that_would_take_for_ever_are_refused_or_cut_short() {
    let nested: String = (1..3000)
        .map(|k| format!("let f{k}(a) = f{}(a) + 1; ", k - 1))
        .collect();
    assert_bounded(&[
        format!("S q: [x], p: [px]; let f0(a) = a; {nested} H = px^2/2 + f2999(x)^2"),
        "S q: [x], p: [px]; H = px^2 + x ((((3^64)^64)^64)^64)^64".to_owned(),
        "S q: [300], p: [300]; H = |p|^2 + sum(i: sum(j: sum(k: sum(l: q[i] q[j] q[k] q[l])))) invariants: { bad = sum(i: p[i]) }".to_owned(),
        doubled(12),
        calls_of_a_sum(300, 30),
        power_of_a_sum(40),
    ]);
}

#[test]
#[ignore = "thorough"]
fn the_longest_formulas_are_refused_or_cut_short() {
    assert_bounded(&[
        doubled(30),
        calls_of_a_sum(30_000, 9000),
        power_of_a_sum(300),
    ]);
}

#[test]
fn long_formulas_are_read() {
    let terms: Vec<String> = (0..3000).map(|k| format!("cos({k} x)/{}", k + 1)).collect();
    let code = code(&format!(
        "Long q: [x], p: [px]; H = px^2/2 + {}",
        terms.join(" + ")
    ));
    assert!(code.len() > 100_000);
    let lets: Vec<String> = (1..2000)
        .map(|k| format!("let a{k} = a{} + sin(a{});", k - 1, k - 1))
        .collect();
    let deep = format!(
        "Deep q: [x], p: [px]; let a0 = x; {} H = px^2/2 + a1999",
        lets.join(" ")
    );
    assert!(read(&deep).1.split.is_ok());
    let powers = (0..200)
        .map(|k| format!("(x + {k})"))
        .collect::<Vec<_>>()
        .join(" ");
    assert!(
        read(&format!("Product q: [x], p: [px]; H = px^2/2 + {powers}"))
            .1
            .split
            .is_ok()
    );
}

/// Random formulas of two coordinates, `depth` operations deep.
fn formulas(depth: u32) -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        Just("a".to_owned()),
        Just("b".to_owned()),
        Just("pa".to_owned()),
        Just("pb".to_owned()),
        Just("g".to_owned()),
        (1..20_u32).prop_map(|n| format!("{n}")),
        (1..200_u32).prop_map(|n| format!("0.{n}")),
    ];
    leaf.prop_recursive(depth, 40, 3, |inner| {
        let pair = (inner.clone(), inner.clone());
        prop_oneof![
            pair.clone().prop_map(|(a, b)| format!("({a} + {b})")),
            pair.clone().prop_map(|(a, b)| format!("({a} - {b})")),
            pair.clone().prop_map(|(a, b)| format!("({a}) ({b})")),
            pair.clone()
                .prop_map(|(a, b)| format!("(({a})/(2 + sin({b})))")),
            pair.prop_map(|(a, b)| format!("hypot(1 + {a}, {b})")),
            (inner.clone(), 2..5_u32).prop_map(|(a, n)| format!("({a})^{n}")),
            inner.clone().prop_map(|a| format!("(1 + ({a})^2)^(-3/2)")),
            inner.clone().prop_map(|a| format!("sqrt(2 + cos({a}))")),
            inner.clone().prop_map(|a| format!("ln(1 + ({a})^2)")),
            inner.clone().prop_map(|a| format!("exp(sin({a}))")),
            inner.clone().prop_map(|a| format!("tanh({a})")),
            inner.clone().prop_map(|a| format!("atan({a})")),
            inner.clone().prop_map(|a| format!("sinh(cos({a}))")),
            inner.clone().prop_map(|a| format!("cosh(sin({a}))")),
            inner.clone().prop_map(|a| format!("tan(sin({a}))")),
            inner.clone().prop_map(|a| format!("asin(sin({a})/2)")),
            inner
                .clone()
                .prop_map(|a| format!("atan2({a}, 3 + cos(a))")),
            inner.prop_map(|a| format!("-{a}")),
        ]
    })
}

fn point(values: [f64; 4]) -> Point<Wide> {
    let wide = |x: f64| Wide(f256::from(x));
    Point {
        time: wide(0.3),
        halves: [[values[0], values[1]], [values[2], values[3]]]
            .map(|half| half.iter().map(|&x| vec![wide(x)]).collect()),
        parameters: vec![vec![vec![wide(1.25)]]],
        pairs: vec![Vec::new()],
    }
}

/// The gradient and the second derivatives are those of the formula, by differences of 71 digits.
fn derivatives_are_right(formula: &str, values: [f64; 4]) -> Result<(), TestCaseError> {
    let text = format!("F {{ g: 1.25 }} q: [a, b], p: [pa, pb]; H = {formula} + pa^2 + pb^2");
    let mut read = match System::read("formula", &text) {
        Ok(read) => read,
        // A zero in a denominator, say.
        Err(_) => return Ok(()),
    };
    let energy = read.energy;
    let here = point(values);
    let small = f256::from(1e-20);
    let mut first = Vec::new();
    for half in [Half::Q, Half::P] {
        first.push((
            half,
            energy,
            gradient(&mut read.graph, energy, &[], integer(1), half),
        ));
    }
    let mut all = first.clone();
    for (_, _, parts) in &first {
        for part in parts {
            for half in [Half::Q, Half::P] {
                all.push((
                    half,
                    part.value,
                    gradient(&mut read.graph, part.value, &[], integer(1), half),
                ));
            }
        }
    }
    for (half, of, parts) in all {
        let found = Evaluator::new(&read.graph, &here)
            .sum(&parts)
            .expect("values");
        for (i, entry) in found.iter().enumerate() {
            let at = |by: f256| {
                let mut there = here.clone();
                let x = &mut there.halves[usize::from(half == Half::P)][i][0];
                *x = Wide(x.0 + by);
                Evaluator::new(&read.graph, &there)
                    .value(of)
                    .expect("a value")
                    .0
            };
            let size = at(f256::ZERO).abs() + f256::ONE;
            let slope = (at(small) - at(-small)) / (small + small);
            let error = (slope - entry[0].0).abs();
            // The truncation error is 10⁻⁴⁰ times a third derivative, which may be large; rounding makes 10⁻⁵⁰.
            let bound = f256::from(1e-25) * (size + slope.abs());
            prop_assert!(
                error <= bound || !slope.is_finite(),
                "{formula}: the derivative by {i} of {half:?} is {:?} and not {slope:?}",
                entry[0].0
            );
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn derivatives_of_random_formulas_agree_with_differences(formula in formulas(5), values in prop::array::uniform4(-1.5..1.5_f64)) {
        derivatives_are_right(&formula, values)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    /// Whatever is written: an answer, and no panic.
    #[test]
    fn any_text_has_an_answer(words in prop::collection::vec(prop::sample::select(WORDS.to_vec()), 0..40)) {
        for start in ["", "S q: [x], p: [px]; H = ", "S<N> { m: [N], A: [2, 2], e: pairs } q: [N; 2], p: [N; 2]; H = sum(i: |p[i]|^2) + "] {
            let text = format!("{start}{}", words.join(" "));
            if let Ok(mut read) = System::read("any", &text) {
                let structure = Structure::of(&mut read);
                let _ = read.check(&structure, &text);
            }
        }
    }
}

const WORDS: [&str; 52] = [
    "x",
    "px",
    "q",
    "p",
    "t",
    "pi",
    "i",
    "j",
    "N",
    "m",
    "A",
    "e",
    "S",
    "H",
    "let",
    "sum",
    "bonds",
    "require",
    "invariants",
    "in",
    "+",
    "-",
    "*",
    "/",
    "^",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    "|",
    ",",
    ";",
    ":",
    "=",
    "<",
    ">",
    "..",
    ".",
    "×",
    "0",
    "1",
    "2.5",
    "1e-3",
    "sin",
    "sqrt",
    "dot",
    "norm",
    "abs",
    "(i, j)",
    "q[i]",
];
