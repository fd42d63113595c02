//! Constraints, holonomic and not.

use std::fs;

use ::symplectic::{Plain, State};

use crate::systems::{assert_near, ends, ends_with};
use crate::{array, call, columns, csv, doubles, folder};

::symplectic::tableau! {
    Rattle { basis: polynomial(2), nodes: lobatto(2) }
    Lobatto3 { basis: polynomial(3), nodes: lobatto(3) }
    Jump { base: lobatto-2, weights: triple_jump(4) }
    Euler { basis: polynomial(1), nodes: [0] }
    Midpoint { basis: polynomial(1), nodes: gauss(1) }
    Gauss4 { basis: polynomial(4), nodes: gauss(4) }
}

::symplectic::hamiltonian! {
    Pendulum { g: 9.81, l: 1 } q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + g y
    constraints: { rod = x^2 + y^2 - l^2 }
}

/// A pendulum as two coordinates on a circle.
const PENDULUM: &str = r#"
system = """
Pendulum { g: 9.81, l: 1 } q: [x, y], p: [px, py];
H = (px^2 + py^2)/2 + g y
constraints: { rod = x^2 + y^2 - l^2 }
"""
method = "lobatto-3"
step_size = 0.01
end = 5.0
[starts]
x = { values = [0.6, -0.8] }
y = "-sqrt(1 - x^2)"
px = "-1.5 y"
py = "1.5 x"
[output]
file = "out.csv"
"#;

fn starts() -> Vec<State<::symplectic::nalgebra::Vector2<f64>>> {
    let start = |x: f64| {
        let y = -(1.0 - x * x).sqrt();
        State::from_arrays(0.0, [x, y], [-1.5 * y, 1.5 * x])
    };
    [0.6, -0.8].map(start).to_vec()
}

const NAMES: [&str; 4] = ["x", "y", "px", "py"];

#[test]
fn a_constrained_pendulum_has_the_bits_of_the_macro() {
    let folder = folder("constrained");
    let system = Pendulum { g: 9.81, l: 1.0 };
    let jump = r#"{ base = "lobatto-2", weights = "triple_jump(4)" }"#;
    for (method, expected) in [
        (r#""lobatto-2""#, ends(Rattle, system, starts(), 0.01, 5.0)),
        (
            r#""lobatto-3""#,
            ends(Lobatto3, system, starts(), 0.01, 5.0),
        ),
        (jump, ends(Jump, system, starts(), 0.01, 5.0)),
        (
            r#"{ basis = "polynomial(1)", nodes = "[0]" }"#,
            ends(Euler, system, starts(), 0.01, 5.0),
        ),
    ] {
        let setup = PENDULUM.replace(r#""lobatto-3""#, method);
        let setup = setup.replace("[starts]", "warn_energy_error = inf\n[starts]");
        assert_eq!(columns(&csv(&folder, &setup), &NAMES), expected, "{method}");
    }
    let plain = PENDULUM.replace("[starts]", "sums = 'plain'\n[starts]");
    let expected = ends_with::<_, _, _, Plain>(Lobatto3, system, starts(), 0.01, 5.0);
    assert_eq!(columns(&csv(&folder, &plain), &NAMES), expected);
}

#[test]
fn a_constrained_pendulum_moves_like_one_with_an_angle() {
    let folder = folder("reduced");
    let found = columns(&csv(&folder, PENDULUM), &NAMES);
    ::symplectic::hamiltonian! { Angle q: [a], p: [pa]; H = pa^2/2 - 9.81 cos(a) }
    let start = |x: f64| State::from_arrays(0.0, [x.asin()], [1.5]);
    let angles = ends(Gauss4, Angle, [0.6, -0.8].map(start).to_vec(), 0.01, 5.0);
    let expected: Vec<Vec<f64>> = angles
        .into_iter()
        .map(|state| {
            let (sin, cos) = state[0].sin_cos();
            vec![sin, -cos, state[1] * cos, state[1] * sin]
        })
        .collect();
    // The method has order 4.
    assert_near(&found, &expected, 1e-6);
}

/// At the lowest point the rod carries g + v² = 2λ, and v² = 2(E + g).
#[test]
fn outputs_have_the_error_of_the_constraints_and_the_multipliers() {
    let folder = folder("multipliers");
    let section = "end = 5.0\nsection = { of = 'x', direction = 'both' }";
    let setup = PENDULUM.replace("end = 5.0", section);
    let names = ["y", "px", "constraint_error", "multiplier_rod"];
    let rows = columns(&csv(&folder, &setup), &names);
    assert!(rows.len() > 4, "{rows:?}");
    for row in rows {
        let &[y, px, error, multiplier] = &row[..] else {
            panic!("{row:?}");
        };
        assert!(error < 1e-15, "{row:?}");
        assert!(
            (multiplier + y * (9.81 + px * px) / 2.0).abs() < 1e-9,
            "{row:?}"
        );
    }
    // 0.005 is inside a step, where the interpolated state is not on the constraint.
    let times = PENDULUM
        .replace("end = 5.0", "times = [0, 0.005, 1]")
        .replace("out.csv", "out.npz");
    assert!(call(&folder, &times, &[]).status.success());
    let file = fs::read(folder.join("out.npz")).expect("the output");
    let (header, bytes) = array(&file, "multipliers");
    assert!(header.contains("(2, 3, 1, )"), "{header}");
    let multipliers = doubles(&bytes);
    let is_nan: Vec<bool> = multipliers.iter().map(|x| x.is_nan()).collect();
    assert_eq!(is_nan, [false, true, false, false, true, false]);
    // −g y + 1.5² at the start.
    assert!((multipliers[0] - (9.81 * 0.8 + 2.25) / 2.0).abs() < 1e-9);
    let (header, bytes) = array(&file, "constraint_error");
    assert!(header.contains("(2, 3, )"), "{header}");
    assert!(doubles(&bytes)[1] > 1e-12);
}

#[test]
fn families_of_constraints_end_where_those_of_the_macro_do() {
    ::symplectic::hamiltonian! {
        Molecules { m: [..], rods: pairs, length: [rods] }
        q: [..; 2], p: [..; 2];
        H = sum(i: |p[i]|^2/(2 m[i]) + m[i] q[i][1])
        constraints: { rod(s = (i, j) in rods) = |q[i] - q[j]|^2 - length[s]^2, fixed = q[0] - [0.5, 0.25] }
    }
    let setup = r#"
system = """
Molecules { m: [..], rods: pairs, length: [rods] }
q: [..; 2], p: [..; 2];
H = sum(i: |p[i]|^2/(2 m[i]) + m[i] q[i][1])
constraints: { rod(s = (i, j) in rods) = |q[i] - q[j]|^2 - length[s]^2, fixed = q[0] - [0.5, 0.25] }
"""
method = "lobatto-3"
step_size = 0.01
end = 2.0
parameters = { m = [1, { values = [2] }, 3], rods = [[0, 1], [1, 2]], length = [1, 2] }
starts = { q = [[0.5, 0.25], [1.5, 0.25], [1.5, 2.25]], p = [[0, 0], [0, 0.5], [1, 0.75]] }
output.file = "out.csv"
"#;
    let text = csv(&folder("families"), setup);
    let columns_of = |half: &str| -> Vec<String> {
        let names = (0..3).flat_map(|i| (0..2).map(move |k| (i, k)));
        names.map(|(i, k)| format!("{half}[{i}][{k}]")).collect()
    };
    let names = [columns_of("q"), columns_of("p")].concat();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let found = columns(&text, &names);
    let header = text.lines().next().expect("a header");
    for name in ["rod[0]", "rod[1]", "fixed[0]", "fixed[1]"] {
        assert!(header.contains(&format!("multiplier_{name}")), "{header}");
    }
    let vector = ::symplectic::nalgebra::DVector::from_row_slice;
    let q = vector(&[0.5, 0.25, 1.5, 0.25, 1.5, 2.25]);
    let p = vector(&[0.0, 0.0, 0.0, 0.5, 1.0, 0.75]);
    let system = Molecules::new(vec![1.0, 2.0, 3.0], vec![(0, 1), (1, 2)], vec![1.0, 2.0]);
    let expected = ends(Lobatto3, system, vec![State::new(0.0, q, p)], 0.01, 2.0);
    assert_near(&found, &expected, 1e-12);
    let errors = columns(&text, &["constraint_error"]);
    assert!(errors[0][0] < 1e-14, "{errors:?}");
}

::symplectic::hamiltonian! {
    Skate q: [x, y, a], p: [px, py, pa]; v: [vx, vy, va];
    H = (px^2 + py^2 + pa^2)/2
    nonholonomic: { edge = vx sin(a) - vy cos(a) }
}

const SKATE: &str = r#"
system = """
Skate q: [x, y, a], p: [px, py, pa]; v: [vx, vy, va];
H = (px^2 + py^2 + pa^2)/2
nonholonomic: { edge = vx sin(a) - vy cos(a) }
"""
method = "gauss-1"
step_size = 0.01
end = 2.0
starts = { x = 0, y = 0, a = 0.3, px = "cos(a)", py = "sin(a)", pa = 1.5 }
output.file = "out.csv"
"#;

/// A skate with constant speed and constant rotation moves in a circle.
#[test]
fn a_nonholonomic_system_has_the_bits_of_the_macro() {
    let folder = folder("skate");
    let text = csv(&folder, SKATE);
    let found = columns(&text, &["x", "y", "a", "px", "py", "pa"]);
    let (sin, cos) = 0.3_f64.sin_cos();
    let start = State::from_arrays(0.0, [0.0, 0.0, 0.3], [cos, sin, 1.5]);
    assert_eq!(found, ends(Midpoint, Skate, vec![start], 0.01, 2.0));
    let end = 0.3 + 1.5 * 2.0_f64;
    let circle = [(end.sin() - sin) / 1.5, (cos - end.cos()) / 1.5];
    // The method has order 2.
    assert!((found[0][0] - circle[0]).abs() < 1e-4 && (found[0][1] - circle[1]).abs() < 1e-4);
    assert!(columns(&text, &["constraint_error"])[0][0] < 1e-15);
    assert!(!text.contains("multiplier"), "{text}");
}

#[test]
fn project_starts_moves_starts_onto_the_constraints() {
    let folder = folder("projected");
    let near = PENDULUM
        .replace("\"-sqrt(1 - x^2)\"", "-0.79")
        .replace("[starts]", "project_starts = true\n[starts]");
    let text = csv(&folder, &near.replace("5.0", "0.01"));
    for row in columns(&text, &["x_start", "y_start", "px_start", "py_start"]) {
        let (radius, rate) = (row[0].hypot(row[1]), row[0] * row[2] + row[1] * row[3]);
        assert!(
            (radius - 1.0).abs() < 1e-15 && rate.abs() < 1e-15,
            "{row:?}"
        );
    }
    let pushed = SKATE.replace("\"cos(a)\"", "2");
    let pushed = csv(&folder, &format!("project_starts = true\n{pushed}"));
    let start = &columns(&pushed, &["px_start", "py_start"])[0];
    let rate = start[0] * 0.3_f64.sin() - start[1] * 0.3_f64.cos();
    assert!(rate.abs() < 1e-15, "{start:?}");
}

#[test]
fn keys_that_constraints_exclude_are_refused_at_their_place() {
    let folder = folder("constrained-refused");
    let replaced = |setup: &str, from: &str, to: &str| {
        assert!(setup.contains(from), "{from}");
        setup.replace(from, to)
    };
    for (setup, place, told) in [
        (
            replaced(PENDULUM, "-1.5 y", "0"),
            "10:1",
            "start 0 is not on the constraint `rod`: |φ| = 0e0, |dφ/dt| =",
        ),
        (
            replaced(PENDULUM, "- x^2)", "- x^2) + 0.1"),
            "10:1",
            "write `project_starts = true`",
        ),
        (
            replaced(SKATE, "\"cos(a)\"", "2"),
            "10:10",
            "start 0 is not on the constraint `edge`: |w·q'| =",
        ),
        (
            replaced(PENDULUM, "lobatto-3", "gauss-2"),
            "7:10",
            "`gauss-2` has no steps for holonomic constraints: take one that is `constrained`",
        ),
        (
            replaced(PENDULUM, "lobatto-3", "blanes-moan-2002-s10"),
            "7:10",
            "has no steps for holonomic constraints",
        ),
        (
            replaced(SKATE, "gauss-1", "gauss-2"),
            "7:10",
            "`gauss-2` has no steps for non-holonomic constraints: take one that is `nonholonomic`",
        ),
        (
            format!("megno = true{PENDULUM}"),
            "1:9",
            "MEGNO is computed without constraints only",
        ),
        (
            format!("solver = 'newton'{PENDULUM}"),
            "1:10",
            "steps with constraints have an iteration of their own: leave out `solver`",
        ),
        (
            replaced(
                PENDULUM,
                "rod = x^2 + y^2 - l^2",
                "rod = x^2 + y^2 - l^2, again = x^2 + y^2 - l^2",
            ),
            "10:1",
            "constraint 1 (`again`) depends on those before it",
        ),
        (
            replaced(
                &replaced(PENDULUM, "constraints: { rod = x^2 + y^2 - l^2 }", ""),
                "[starts]",
                "project_starts = true\n[starts]",
            ),
            "10:18",
            "the system has no constraints, so starts are not projected",
        ),
        (
            replaced(PENDULUM, "+ g y\n", "+ g y\nfriction: 0.1\n"),
            "5:11",
            "friction with constraints is not supported here",
        ),
        (
            replaced(
                &replaced(PENDULUM, "\"-sqrt(1 - x^2)\"", "-1"),
                "[starts]",
                "project_starts = true\n[starts]",
            )
            .replace("rod = x^2 + y^2 - l^2", "rod = x^2 + y^2 + l^2"),
            "10:18",
            "start 0: no state on the constraints was found near this one",
        ),
    ] {
        let output = call(&folder, &setup, &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{setup}{error}");
        assert!(
            error.contains(told) && error.contains(&format!("setup.toml:{place}")),
            "{told}: {error}"
        );
    }
}

#[test]
fn parts_and_threads_do_not_change_constrained_trajectories() {
    let folder = folder("constrained-parts");
    let many = PENDULUM.replace("values = [0.6, -0.8]", "from = -0.9, to = 0.9, count = 7");
    let whole = columns(&csv(&folder, &many), &NAMES);
    let options = ["--shard", "1/2", "--threads", "1"];
    assert!(call(&folder, &many, &options).status.success());
    let part = fs::read_to_string(folder.join("out.1-of-2.csv")).expect("a part");
    let part = columns(&part, &NAMES);
    assert_eq!(part, whole[whole.len() - part.len()..]);
}
