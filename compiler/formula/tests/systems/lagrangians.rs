//! Lagrangians: the Hamiltonians that follow from them, what is emitted, and what is refused.

use crate::formula::{Wide, code, read, refused};
use expect_test::{expect, expect_file};
use f256::f256;
use proptest::prelude::*;
use symplectic_formula::derivative::gradient;
use symplectic_formula::display::Notation;
use symplectic_formula::evaluate::{Evaluator, Point};
use symplectic_formula::graph::{Half, Id, integer};
use symplectic_formula::{Form, Kinetic, Legendre, Structure, System, description};

fn lagrangian(text: &str) -> (System, Structure) {
    read(Form::Lagrangian, text)
}

/// The formula of the Hamiltonian.
fn hamiltonian(text: &str) -> String {
    let (read, _) = lagrangian(text);
    read.formula(read.energy, Notation::Text)
}

const DOUBLE_PENDULUM: &str = "DoublePendulum { g: 9.81 }
    q: [a, b], v: [va, vb];
    let d = a - b;
    L = va^2 + vb^2/2 + va vb cos(d) + g (2 cos(a) + cos(b))";

/// Velocities in a force are written with momenta.
#[test]
fn forces_of_velocities_are_written_with_momenta() {
    let force = |text: &str| {
        let (read, _) = lagrangian(text);
        read.applied_forces(Notation::Text).join("; ")
    };
    expect!["force on r = −c (pr/m); force on a = −r² c (pa/(r² m))"].assert_eq(&force(
        "S { c, m } q: [r, a], v: [vr, va]; L = m (vr^2 + r^2 va^2)/2 force: { r = -c vr, a = -c r^2 va }",
    ));
    expect!["force on q[i] = −p[i]/m[i]    (0 ≤ i < N)"].assert_eq(&force(
        "S<N> { m: [N] } q: [N], v: [N]; L = sum(i: m[i] v[i]^2/2 - q[i]^2) force: { q[i] = -v[i] }",
    ));
}

#[test]
fn code_of_the_double_pendulum_has_the_recorded_text() {
    let (read, structure) = lagrangian(DOUBLE_PENDULUM);
    expect_file!["emitted/lagrangian_double_pendulum.rs"].assert_eq(&code(&read, &structure));
}

/// Without the function for momenta, nothing shows that it was a Lagrangian.
#[test]
fn the_code_is_that_of_the_hamiltonian() {
    for (l, h) in [
        (
            "S { g: 9.81 } q: [a], v: [va]; L = va^2/2 + g cos(a)",
            "S { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)",
        ),
        (
            "S<N> { m: [N], G: 1 } q: [N; 3], v: [N; 3];
             L = sum(i: m[i] |v[i]|^2/2) + sum(i < j: G m[i] m[j]/|q[i] - q[j]|)
             require: [separable, quadratic_kinetic]",
            "S<N> { m: [N], G: 1 } q: [N; 3], p: [N; 3];
             H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)
             require: [separable, quadratic_kinetic]",
        ),
        (
            "S { beta: 1 } q: [..], v: [..]; bonds: walls;
             L = sum(i: v[i]^2/2) - sum(bonds d: d^2/2 + beta d^4/4) require: [chain]",
            "S { beta: 1 } q: [..], p: [..]; bonds: walls;
             H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + beta d^4/4) require: [chain]",
        ),
        (
            "S { stiffness: 16 } q: [..], v: [..]; bonds: ring;
             L = sum(i: v[i]^2/2 - 1 + cos(q[i])) - sum(bonds d: stiffness d^2/2)",
            "S { stiffness: 16 } q: [..], p: [..]; bonds: ring;
             H = sum(i: p[i]^2/2 + 1 - cos(q[i])) + sum(bonds d: stiffness d^2/2)",
        ),
        (
            "S { springs: pairs, m: [..] } q: [..; 2], v: [..; 2];
             L = sum(i: m[i] |v[i]|^2/2) - sum((i, j) in springs: (|q[i] - q[j]| - 1)^2)",
            "S { springs: pairs, m: [..] } q: [..; 2], p: [..; 2];
             H = sum(i: |p[i]|^2/(2 m[i])) + sum((i, j) in springs: (|q[i] - q[j]| - 1)^2)",
        ),
    ] {
        let (mut from_l, structure) = lagrangian(l);
        assert!(code(&from_l, &structure).contains("momentum_of_velocity"));
        from_l.lagrangian = None;
        let (from_h, other) = read(Form::Hamiltonian, h);
        // After the documentation, where terms may be in another order.
        let [from_l, from_h] = [code(&from_l, &structure), code(&from_h, &other)].map(|code| {
            code.split_once("pub struct")
                .map(|(_, code)| code.to_owned())
        });
        assert_eq!(from_l, from_h);
    }
}

#[test]
fn the_transform_of_cartesian_velocities_is_short() {
    let cartesian = "S { l: 1, m, g: 9.81 } q: [a, b], v: [va, vb];
        let x1 = l cos(a) va; let y1 = l sin(a) va;
        let x2 = x1 + l cos(b) vb; let y2 = y1 + l sin(b) vb;
        L = m (x1^2 + y1^2)/2 + m (x2^2 + y2^2)/2 + m g l (2 cos(a) + cos(b))";
    expect!["(1/2) (pa² (l² m) − 2 pa pb (l² m cos(a − b)) + 2 pb² (l² m))/(2 (l² m)² − (l² m cos(a − b))²) − l m g (2 cos(a) + cos(b))"]
        .assert_eq(&hamiltonian(cartesian));
    let polar = "S q: [r, f], v: [vr, vf];
        let x = vr cos(f) - r sin(f) vf; let y = vr sin(f) + r cos(f) vf;
        L = (x^2 + y^2)/2 + 1/r";
    expect!["(1/2) pr² + (1/2) pf²/r² − 1/r"].assert_eq(&hamiltonian(polar));
}

#[test]
fn the_structure_of_a_lagrangian_is_recognised() {
    let regularity = |(read, _): (System, Structure)| read.lagrangian.map(|known| known.legendre);
    let single = |l: &str| lagrangian(&format!("S {{ m: 2 }} q: [4], v: [4]; L = {l} - |q|^2"));
    // Constant masses, proved; products of velocities only; masses that are set later.
    let (_, structure) = single("v[0] v[1] + v[2] v[3] + v[0] v[3]/2 + (v[0] + v[2])^2/2");
    assert_eq!(structure.kinetic, Kinetic::Quadratic);
    assert_eq!(single("|v|^2/2").1.kinetic, Kinetic::Unit);
    assert_eq!(single("m |v|^2/2 + v[0]").1.kinetic, Kinetic::Diagonal);
    let proved = Some(Legendre::Regular);
    assert_eq!(regularity(single("v[0] v[1] + v[2] v[3]")), proved);
    assert_eq!(regularity(single("|v|^2/2 + q[1] v[0]")), proved);
    let found = Some(Legendre::RegularAtRandomPoints);
    assert_eq!(regularity(single("m |v|^2/2")), found);
    let sphere = lagrangian("S q: [a, b], v: [va, vb]; L = (va^2 + sin(a)^2 vb^2)/2 - cos(a)");
    assert_eq!(sphere.1.cyclic, [1]);
    assert_eq!(sphere.0.layout.name(Half::P, 1), "pb");
    // The name of a momentum is one that is free.
    let taken = lagrangian(
        "S { px: 1 } q: [x], v: [u]; L = u^2/2 - px x^2 invariants: { e = p_x^2/2 + px x^2 }",
    )
    .0;
    assert_eq!(taken.layout.name(Half::P, 0), "p_x");
    // In a magnetic field: |p − A|²/2.
    expect!["(1/2) ((px + (1/2) y B)² + (py − (1/2) x B)²) + U(x)"].assert_eq(&hamiltonian(
        "S { B } q: [x, y], v: [u, w]; extern fn U with dU, d2U; L = (u^2 + w^2)/2 + B (x w - y u)/2 - U(x)",
    ));
    let angular = lagrangian("K q: [3], v: [3]; L = |v|^2/2 + 1/|q| - 0.1 q[2]");
    assert_eq!(angular.1.rotations, [[0, 1]]);
}

/// L that is not quadratic in the velocities is taken as it is.
#[test]
fn a_lagrangian_without_a_closed_hamiltonian_is_accepted_as_it_is() {
    let text = "Particle { m: 1, c: 1, drag: 0 } q: [x, y], v: [vx, vy];
        L = -m c^2 sqrt(1 - (vx^2 + vy^2)/c^2) - (x^2 + y^2)/2
        force: { x = -drag vx, y = -drag vy }";
    let (read, structure) = lagrangian(text);
    expect_file!["emitted/lagrangian_particle.rs"].assert_eq(&code(&read, &structure));
    expect![[r#"
        Particle

        parameters
          m = 1
          c = 1
          drag = 0

        Lagrangian
          L = −m c² √(1 − (vx² + vy²)/c²) − (1/2) (x² + y²)

        momenta
          px = vx ((m c²/√(1 − (vx² + vy²)/c²))/c²)
          py = vy ((m c²/√(1 − (vx² + vy²)/c²))/c²)

        equations of motion
          x' = vx
          y' = vy
          px' = −x − vx drag
          py' = −y − vy drag

        found in the formula
          not quadratic in the velocities, so there is no formula of H: steps are those of `symplectic::variational::LagrangianIntegrator`, by L and its derivatives
    "#]].assert_eq(&description::text(&read, &structure));
    expect![[r#"
        \begin{aligned}
          L &= -m\,{c}^{2}\,\sqrt{1 - \frac{\left({\mathrm{vx}}^{2} + {\mathrm{vy}}^{2}\right)}{{c}^{2}}} - \tfrac{1}{2}\,\left({x}^{2} + {y}^{2}\right) \\
          \mathrm{px} &= \mathrm{vx}\,\left(\frac{\left(\frac{m\,{c}^{2}}{\sqrt{1 - \frac{\left({\mathrm{vx}}^{2} + {\mathrm{vy}}^{2}\right)}{{c}^{2}}}}\right)}{{c}^{2}}\right) \\
          \mathrm{py} &= \mathrm{vy}\,\left(\frac{\left(\frac{m\,{c}^{2}}{\sqrt{1 - \frac{\left({\mathrm{vx}}^{2} + {\mathrm{vy}}^{2}\right)}{{c}^{2}}}}\right)}{{c}^{2}}\right) \\
          \dot{x} &= \mathrm{vx} \\
          \dot{y} &= \mathrm{vy} \\
          \dot{\mathrm{px}} &= -x - \mathrm{vx}\,\mathrm{drag} \\
          \dot{\mathrm{py}} &= -y - \mathrm{vy}\,\mathrm{drag}
        \end{aligned}
    "#]].assert_eq(&description::latex(&read, &structure));
    let json = description::json(&read, &structure);
    assert_eq!(json["hamiltonian"], serde_json::Value::Null);
    assert_eq!(json["momenta"]["text"].as_array().map(Vec::len), Some(2));
}

#[test]
fn wrong_lagrangians_are_refused_at_their_place() {
    let all = [
        "P q: [x, y], v: [vx, vy]; L = vy^2/2 - x y",
        "P q: [x, y], v: [vx, vy]; L = vy^2/2 + x y vx",
        "P q: [x, y], v: [vx, vy]; L = (vx + vy)^2/2 - x y",
        "P q: [x, y], v: [vx, vy]; L = (vx cos(x) + vy sin(x))^2/2 + x vy",
        "P q: [x, y], v: [vx, vy]; L = vx^2/2 + vx vy sin(x) + vy^2 (1 - cos(x)^2)/2",
        "P q: [x, y], v: [vx, vy]; L = (vx^2 + vy^2)/2 + vx vy (sin(x + y) - sin(x) cos(y) - cos(x) sin(y) + 1)",
        "P q: [4], v: [4]; L = (v[0] + v[1])^2/2 + (v[2] + v[3])^2/2 + (v[0] + v[2])^2/2",
        "P<N> { m: [N] } q: [N; 2], v: [N; 2]; L = sum(i: m[i] v[i][0]^2/2) - sum(i: |q[i]|^2)",
        "P<N> q: [N], v: [N]; L = sum(i: (v[i]^2 + q[i]^2)/2 + q[i] v[i] sum(j: v[j]))",
        "P q: [..], v: [..]; L = sum(i: v[i]^2/2) + sum(i: v[i])^2",
        "P q: [17], v: [17]; L = sum(i: v[i])^2",
        "P { m, c } q: [3], v: [3]; L = -m c^2 sqrt(1 - |v|^2/c^2) - |q|^2 require: [separable]",
        "P q: [x, y], v: [vx, vy]; L = (vx^2 + vy^2)/2 + x vx^4 - x^2 constraints: { line = x - y }",
        "P<N> q: [N; 2], v: [N; 2]; L = sum(i: |v[i]|^2/2 + |v[i]|^4/8) friction: 1",
        "P q: [x, y], v: [vx, vy]; L = vx^2/2 + vy^2 (1 + x^2)/2 friction: 1",
        "P q: [x, y], v: [vx, vy]; L = vx^4/4 - x^2 - y^2",
        "P q: [x], v: [vx]; L = x^2",
        "P q: [x], v: [vx]; L = vx^2/2 + px",
        "P q: [3], v: [3]; L = |v|^2/2 + dot(p, q)",
        "P q: [x], v: [vx]; let k = p[0]; L = vx^2/2",
        "P q: [x, y], v: [vx, vy]; L = vx^2/2 + vy^2/2 force: { x = -vx, y = 1 - 2 py }",
        "P q: [x], v: [u]; L = u^4 force: { x = -p[0] }",
        "P q: [x], v: [u]; let drag(c) = -c px; L = u^4 force: { x = drag(2) }",
        "P<N> q: [N; 2], v: [N; 2]; L = sum(i: |v[i]|^2/2) force: { q[i] = -p[i] }",
        "P q: [x], v: [vx]; L = vx^2/2 force: { px = 1 }",
        "P q: [x], v: [vx]; L = vx^2/2 force: -vx",
        "P q: [x, y], v: [vx, vy]; L = vx^2 + vy^2 friction: 1 constraints: { rod = x }",
        "P<N> { g: [N] } q: [N], v: [N]; L = sum(i: v[i]^2) friction: g",
        "P q: [x], v: [vx]; H = vx^2/2",
        "P q: [x], p: [px]; L = px^2/2",
        "P q: [x]; L = x^2/2",
        "P q: [x], v: [vx];",
        "P q: [x, y], v: [vx]; L = vx^2",
        "P q: [x], v: [x]; L = x^2",
        "P { vx: 1 } q: [x], v: [vx]; L = vx^2",
        "P q: [x], v: [vx]; let v = 1; L = vx^2",
        "P q: [x], v: [vx]; let L = 1; L = vx^2",
        "P q: [x], v: [vx]; let vx = 1; L = vx^2",
        "P q: [x], v: [vx]; L = vx^2/2 + cso(x)",
        "P q: [x], v: [vx]; L = vx^2/2 - x^2 invariants: { e = vx^2/2 + x^2 }",
        "P q: [x], v: [vx]; L = vx^2/2 - x^2 invariants: { e = px^2 }",
        "P q: [x], v: [vx]; L = vx^2/2 - x^2 invariants: { momentum_of_velocity = px^2/2 + x^2 }",
        "P q: [x], v: [vx]; L = vx^2 (1 + x^2)/2 - x^2 require: [separable]",
        "P q: [x], v: [vx]; L = vx^2/2 - x^2 cos(t) require: [time_independent]",
    ];
    let mut all: Vec<String> = all
        .iter()
        .map(|text| refused(Form::Lagrangian, text))
        .collect();
    for h in [
        "P q: [x], v: [vx]; H = vx^2/2",
        "P q: [x], p: [px]; L = px^2/2",
    ] {
        all.push(refused(Form::Hamiltonian, h));
    }
    expect_file!["data/lagrangians_refused.txt"].assert_eq(&(all.join("\n\n") + "\n"));
}

#[test]
fn a_text_is_recognised_as_hamiltonian_or_lagrangian() {
    let l = [DOUBLE_PENDULUM, "S q: [x], v: [vx];", "S q: [x] L = x^2"];
    assert!(l.iter().all(|text| Form::of(text) == Form::Lagrangian));
    let h = [
        "S { L: 1 } q: [x], p: [px]; let L = 2; H = px^2 + L",
        "S<N> q: [N], p: [N]; H = sum(v: p[v]^2)",
    ];
    assert!(h.iter().all(|text| Form::of(text) == Form::Hamiltonian));
}

#[test]
fn lagrangians_that_would_take_for_ever_are_refused_or_cut_short() {
    for n in [3, 12] {
        let text = format!(
            "S q: [{n}], v: [{n}]; L = sum(i: v[i]^2) + sum(i < j: v[i] v[j] cos(q[i] - q[j])/100)"
        );
        let (read, structure) = lagrangian(&text);
        let equations = read.momentum_equations(Notation::Text);
        assert!(!equations.is_empty() && structure.split.is_err());
    }
    let terms: String = (0..300).map(|k| format!(" + (vx + x/{k}.5)^2")).collect();
    let powers = (0..30)
        .map(|k| format!("(sin(x) + {k} cos(x) + 1)"))
        .collect::<Vec<_>>()
        .join(" ");
    let lets: Vec<String> = (1..2000)
        .map(|k| format!("let a{k} = a{0} + sin(a{0});", k - 1))
        .collect();
    for text in [
        format!("S q: [x], v: [vx]; L = vx^2{terms}"),
        format!("S q: [x], v: [vx]; L = vx^2 {powers}"),
        format!(
            "S q: [x], v: [vx]; let a0 = x; {} L = vx^2 (2 + sin(a1999))",
            lets.join(" ")
        ),
        format!(
            "S q: [4], v: [4]; let a0 = q[0]; {} L = sum(i: v[i]^2 (2 + sin(a1999))) + sum(i < j: v[i] v[j]/9)",
            lets.join(" ")
        ),
    ] {
        if let Ok(mut read) = System::read_as(Form::Lagrangian, "long", &text) {
            let structure = Structure::of(&mut read);
            let _ = description::page(&read, &structure);
        }
    }
}

/// Coefficients of L: functions of the positions and the time.
fn coefficients() -> impl Strategy<Value = String> {
    let position = (0..5_usize).prop_map(|k| format!("q[{k}]"));
    prop_oneof![
        (1..9_u32).prop_map(|n| format!("{n}/4")),
        Just("g".to_owned()),
        position.clone().prop_map(|x| format!("sin({x})")),
        position.clone().prop_map(|x| format!("cos({x} - t)")),
        position.clone().prop_map(|x| format!("1/(2 + sin({x}))")),
        position.clone().prop_map(|x| format!("exp(sin({x}))")),
        position.clone().prop_map(|x| format!("sqrt(1 + {x}^2)")),
        (position.clone(), position).prop_map(|(x, y)| format!("cos({x} - {y})")),
    ]
}

/// A Lagrangian of some velocities with a positive definite mass matrix: squares of all velocities and of sums of some.
fn lagrangians() -> impl Strategy<Value = (usize, String)> {
    let squares = prop::collection::vec((coefficients(), any::<bool>()), 5);
    let sums = prop::collection::vec(
        prop::collection::vec((coefficients(), 0..5_usize), 1..4),
        0..3,
    );
    let shift = prop::collection::vec((coefficients(), 0..5_usize), 0..3);
    let potential = prop::collection::vec((coefficients(), coefficients()), 1..4);
    (1..=5_usize, squares, sums, shift, potential).prop_map(
        |(n, squares, sums, shift, potential)| {
            let within = |text: String| {
                (n..5).fold(text, |text, k| {
                    text.replace(&format!("q[{k}]"), &format!("q[{}]", k % n))
                })
            };
            let mut l = String::new();
            for (k, (coefficient, constant)) in squares.into_iter().enumerate().take(n) {
                let mass = match constant {
                    true => format!("{}/3", k + 1),
                    false => format!("(1 + ({coefficient})^2)"),
                };
                l.push_str(&format!(" + {mass} * v[{k}]^2"));
            }
            for sum in sums {
                let terms = sum.into_iter().map(|(c, k)| format!("({c}) v[{}]", k % n));
                l.push_str(&format!(
                    " + ({})^2/2",
                    terms.collect::<Vec<_>>().join(" + ")
                ));
            }
            for (coefficient, k) in shift {
                l.push_str(&format!(" - ({coefficient}) v[{}]", k % n));
            }
            for (a, b) in potential {
                l.push_str(&format!(" - ({a}) ({b})"));
            }
            (n, within(l.trim_start_matches(" + ").to_owned()))
        },
    )
}

/// `H = v·p − L`, `∂H/∂p = v` and `−∂H/∂q = ∂L/∂q` at `p = ∂L/∂v`, in 71 digits.
fn the_transform_is_right(n: usize, formula: &str, values: &[f64]) -> Result<(), TestCaseError> {
    let text = format!("F {{ g: 1.25 }} q: [{n}], v: [{n}]; L = {formula}");
    let mut read = System::read_as(Form::Lagrangian, "formula", &text)
        .map_err(|error| TestCaseError::fail(format!("{error}")))?;
    let (l, h) = (read.lagrangian.as_ref().expect("L").formula, read.energy);
    let wide = |x: f64| Wide(f256::from(x));
    let half = |values: &[f64]| values.iter().map(|&x| vec![wide(x)]).collect::<Vec<_>>();
    let mut point = Point {
        time: wide(0.3),
        halves: [half(&values[..n]), half(&values[5..5 + n])],
        parameters: vec![vec![vec![wide(1.25)]]],
        pairs: vec![Vec::new()],
    };
    let mut slopes = |of: Id, by: Half, point: &Point<Wide>| -> Vec<f256> {
        let parts = gradient(&mut read.graph, of, &[], integer(1), by);
        let sum = Evaluator::new(&read.graph, point).sum(&parts);
        sum.expect("values").iter().map(|x| x[0].0).collect()
    };
    let speeds: Vec<f256> = point.halves[1].iter().map(|x| x[0].0).collect();
    let momenta = slopes(l, Half::V, &point);
    let push = slopes(l, Half::Q, &point);
    let at_l = point.clone();
    point.halves[1] = momenta.iter().map(|&p| vec![Wide(p)]).collect();
    let velocity = slopes(h, Half::P, &point);
    let force = slopes(h, Half::Q, &point);
    let value = |of: Id, point: &Point<Wide>| {
        Evaluator::new(&read.graph, point)
            .value(of)
            .expect("a value")
            .0
    };
    let mut energy = -value(l, &at_l);
    for (v, p) in speeds.iter().zip(&momenta) {
        energy += *v * *p;
    }
    let mut pairs = vec![(value(h, &point), energy)];
    pairs.extend(velocity.into_iter().zip(speeds));
    pairs.extend(force.into_iter().map(|x| -x).zip(push));
    for (found, expected) in pairs {
        // Rounding, times a condition number of some thousands.
        let bound = f256::from(1e-60) * (f256::ONE + expected.abs());
        prop_assert!(
            (found - expected).abs() <= bound,
            "{formula}: {found:?} and not {expected:?}"
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn hamiltonians_of_random_lagrangians_are_their_transforms((n, formula) in lagrangians(), values in prop::collection::vec(-1.5..1.5_f64, 10)) {
        the_transform_is_right(n, &formula, &values)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

    /// Whatever is written: an answer, and no panic.
    #[test]
    fn any_text_has_an_answer(words in prop::collection::vec(prop::sample::select(WORDS.to_vec()), 0..30)) {
        for start in ["", "S q: [x, y], v: [vx, vy]; L = vx^2 + ", "S<N> { m: [N], e: pairs } q: [N; 2], v: [N; 2]; L = sum(i: |v[i]|^2) + ", "S q: [3], v: [3]; L = "] {
            let text = format!("{start}{}", words.join(" "));
            if let Ok(mut read) = System::read_as(Form::Lagrangian, "any", &text) {
                let structure = Structure::of(&mut read);
                let _ = read.check(&structure, &text);
            }
        }
    }
}

const WORDS: [&str; 40] = [
    "x",
    "vx",
    "vy",
    "q",
    "v",
    "p",
    "t",
    "i",
    "j",
    "N",
    "m",
    "e",
    "L",
    "H",
    "sum(i:",
    "sum(i < j:",
    "v[i]",
    "v[j]",
    "q[i]",
    "v[0]",
    "v[1]",
    "v[2]",
    "dot(v, v)",
    "|v|^2",
    "bonds",
    "+",
    "-",
    "*",
    "/",
    "^",
    "2",
    "(",
    ")",
    "[",
    "]",
    "|",
    "0",
    "1.5",
    "sin(x)",
    "(i, j)",
];
