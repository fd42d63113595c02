//! Applied forces.

use ::symplectic::State;
use ::symplectic::nalgebra::DVector;

use crate::friction::exact;
use crate::systems::{assert_near, ends};
use crate::{call, columns, csv, folder};

::symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }

/// An oscillator with drag and a drive of frequency 2.
const SETUP: &str = r#"
system = "Driven { c } q: [x], p: [px]; H = (px^2 + x^2)/2 force: { x = -c px + cos(2 t) }"
method = "gauss-2"
step_size = 0.1
end = 8.0
parameters.c = { values = [0.2, 0.3] }
starts = { x = 1, px = 0.5 }
output.file = "out.csv"
"#;

/// x and its momentum: A cos 2t + B sin 2t, and a damped oscillation.
fn driven(c: f64, time: f64) -> [f64; 2] {
    let (a, b) = (-3.0 / (9.0 + 4.0 * c * c), 2.0 * c / (9.0 + 4.0 * c * c));
    let [x, p] = exact(c, [1.0 - a, 0.5 - 2.0 * b], time);
    let (sin, cos) = (2.0 * time).sin_cos();
    [x + a * cos + b * sin, p + 2.0 * (b * cos - a * sin)]
}

fn error(rows: &[Vec<f64>]) -> f64 {
    let errors = rows.iter().map(|row| {
        let [x, p] = driven(row[0], row[1]);
        (row[2] - x).abs().max((row[3] - p).abs())
    });
    errors.fold(0.0, f64::max)
}

const NAMES: [&str; 4] = ["c", "time", "x", "px"];

#[test]
fn methods_have_their_order_with_forces() {
    let folder = folder("forces");
    let drive = "force: { x = cos(2 t) } friction: c";
    let rate = SETUP.replace("force: { x = -c px + cos(2 t) }", drive);
    for (setup, method, solver, order) in [
        (SETUP, "gauss-2", "", 4),
        (SETUP, "gauss-2", "solver = 'newton'", 4),
        (SETUP, "lobatto-2", "", 2),
        // With the drag as friction, the force depends on the time only.
        (&rate, "gauss-2", "solver = 'newton'", 4),
        (&rate, "forest-ruth-1990", "", 4),
        (&rate, "velocity-verlet", "", 2),
    ] {
        let of_step = |size: &str| {
            let setup = setup.replace("gauss-2", method).replace("0.1\n", size);
            let text = csv(&folder, &format!("{solver}\n{setup}"));
            error(&columns(&text, &NAMES))
        };
        let ratio = of_step("0.05\n") / of_step("0.025\n");
        let expected = f64::from(1 << order);
        // The ratio of the leading terms, up to those of the next even order.
        assert!((ratio / expected - 1.0).abs() < 0.1, "{method}: {ratio}");
    }
}

#[test]
fn forces_between_pairs_end_where_those_of_the_macro_do() {
    ::symplectic::hamiltonian! {
        Beads { dampers: pairs, c: 0.3 }
        q: [..; 2], p: [..; 2];
        H = sum(i: |p[i]|^2/2 + |q[i]|^2/2)
        force: {
            q[i](s = (i, j) in dampers) = -c (p[i] - p[j]),
            q[j](s = (i, j) in dampers) = c (p[i] - p[j]),
            q[0] = [cos(t), 0],
        }
    }
    let setup = r#"
system = """
Beads { dampers: pairs, c: 0.3 }
q: [..; 2], p: [..; 2];
H = sum(i: |p[i]|^2/2 + |q[i]|^2/2)
force: {
    q[i](s = (i, j) in dampers) = -c (p[i] - p[j]),
    q[j](s = (i, j) in dampers) = c (p[i] - p[j]),
    q[0] = [cos(t), 0],
}
"""
method = "gauss-2"
step_size = 0.05
end = 2.0
parameters.dampers = [[0, 1]]
starts = { q = [[1, 0], [0, 1]], p = [[0, 0.5], [0.25, 0]] }
output.file = "out.csv"
"#;
    let names = ["q[0][0]", "q[0][1]", "q[1][0]", "q[1][1]"];
    let names = [&names[..], &["p[0][0]", "p[0][1]", "p[1][0]", "p[1][1]"]].concat();
    let found = columns(&csv(&folder("beads"), setup), &names);
    let vector = DVector::from_row_slice;
    let (q, p) = (
        vector(&[1.0, 0.0, 0.0, 1.0]),
        vector(&[0.0, 0.5, 0.25, 0.0]),
    );
    let system = Beads::new(vec![(0, 1)]);
    let expected = ends(Gauss2, system, vec![State::new(0.0, q, p)], 0.05, 2.0);
    assert_near(&found, &expected, 1e-14);
}

/// A pendulum on a rod with drag: the velocity of the angle decays as in one coordinate.
#[test]
fn forces_act_beside_constraints() {
    let setup = r#"
system = """
Pendulum { c: 0.3 } q: [x, y], p: [px, py];
H = (px^2 + py^2)/2 + 9.81 y
constraints: { rod = x^2 + y^2 - 1 }
force: { x = -c px, y = -c py }
"""
method = "lobatto-3"
step_size = 0.01
end = 5.0
starts = { x = 0.6, y = -0.8, px = 0, py = 0 }
output.file = "out.csv"
"#;
    let text = csv(&folder("forced-rod"), setup);
    let found = columns(&text, &["x", "px", "constraint_error"]);
    ::symplectic::hamiltonian! {
        Angle q: [a], p: [pa]; H = pa^2/2 - 9.81 cos(a) force: { a = -0.3 pa }
    }
    let start = State::from_arrays(0.0, [0.6_f64.asin()], [0.0]);
    let angle = &ends(Gauss2, Angle, vec![start], 0.001, 5.0)[0];
    let (sin, cos) = angle[0].sin_cos();
    // The method has order 4.
    assert_near(
        &[found[0][..2].to_vec()],
        &[vec![sin, angle[1] * cos]],
        1e-7,
    );
    assert!(found[0][2] < 1e-15, "{found:?}");
}

#[test]
fn the_energy_is_not_said_to_be_conserved() {
    let folder = folder("forced-energy");
    let output = call(&folder, SETUP, &[]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("largest change of energy"), "{said}");
    assert!(output.stderr.is_empty(), "no warning");
    let section = SETUP.replace("8.0", "8.0\nsection = { of = 'px', direction = 'both' }");
    let rows = columns(&csv(&folder, &section), &NAMES);
    assert!(rows.len() >= 4 && error(&rows) < 1e-5, "{rows:?}");
}

#[test]
fn run_files_with_wrong_forces_are_refused_at_their_place() {
    let folder = folder("forced-refused");
    for (setup, place, told) in [
        (
            format!("megno = true{SETUP}"),
            "1:9",
            "MEGNO is computed without applied forces only",
        ),
        (
            SETUP.replace("gauss-2", "velocity-verlet"),
            "3:10",
            "H is not separable, or a force depends on momenta",
        ),
        (SETUP.replace("-c px", "-c py"), "2:76", "py"),
    ] {
        let output = call(&folder, &setup, &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(
            error.contains(told) && error.contains(&format!("setup.toml:{place}")),
            "{told}: {error}"
        );
    }
}
