//! Friction −γp.

use crate::{call, columns, csv, folder};

const SETUP: &str = r#"
system = "Oscillators { c } q: [x, y], p: [px, py]; H = (px^2 + py^2 + x^2 + y^2)/2 friction: [c, 0.5]"
method = "forest-ruth-1990"
step_size = 0.1
start_time = -2
end = 8.0
parameters.c = { values = [0.2, 0.3] }
starts = { x = 1, y = 0.5, px = 0, py = 1 }
output.file = "out.csv"
"#;

/// x and its momentum after a time, with the friction c.
pub(super) fn exact(c: f64, [x, p]: [f64; 2], time: f64) -> [f64; 2] {
    let omega = (1.0 - c * c / 4.0).sqrt();
    let (sin, cos) = (omega * time).sin_cos();
    let decay = (-c * time / 2.0).exp();
    let second = (p + c * x / 2.0) / omega;
    let value = decay * (x * cos + second * sin);
    let slope = decay * (second * omega * cos - x * omega * sin) - c / 2.0 * value;
    [value, slope]
}

/// The largest error of the rows of a table at a time since the start.
fn error(rows: &[Vec<f64>]) -> f64 {
    let errors = rows.iter().map(|row| {
        let &[c, time, x, y, px, py] = &row[..] else {
            panic!("{row:?}");
        };
        let [x_exact, px_exact] = exact(c, [1.0, 0.0], time + 2.0);
        let [y_exact, py_exact] = exact(0.5, [0.5, 1.0], time + 2.0);
        let parts = [x - x_exact, y - y_exact, px - px_exact, py - py_exact];
        parts.into_iter().map(f64::abs).fold(0.0, f64::max)
    });
    errors.fold(0.0, f64::max)
}

const NAMES: [&str; 6] = ["c", "time", "x", "y", "px", "py"];

#[test]
fn methods_have_their_order_with_friction() {
    let folder = folder("friction");
    for (method, solver, order) in [
        ("forest-ruth-1990", "", 4),
        ("velocity-verlet", "", 2),
        ("gauss-2", "", 4),
        ("gauss-2", "solver = 'newton'", 4),
    ] {
        let of_step = |size: &str| {
            let setup = SETUP.replace("forest-ruth-1990", method);
            let setup = format!("{solver}\n{}", setup.replace("0.1\n", size));
            error(&columns(&csv(&folder, &setup), &NAMES))
        };
        let ratio = of_step("0.1\n") / of_step("0.05\n");
        let expected = f64::from(1 << order);
        // The ratio of the leading terms, up to those of the next even order.
        assert!((ratio / expected - 1.0).abs() < 0.1, "{method}: {ratio}");
    }
}

#[test]
fn states_at_times_and_in_sections_have_the_momenta_with_friction() {
    let folder = folder("friction-seen");
    let at_times = SETUP.replace("end = 8.0", "times = [-2, -1, 0, 4.05, 8]");
    let output = call(&folder, &at_times, &[]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("largest change of energy"), "{said}");
    let text = std::fs::read_to_string(folder.join("out.csv")).expect("the output");
    let rows = columns(&text, &NAMES);
    assert!(rows.len() == 10 && error(&rows) < 1e-4, "{rows:?}");
    assert_eq!(rows[0], [0.2, -2.0, 1.0, 0.5, 0.0, 1.0]);
    let section = SETUP.replace(
        "end = 8.0",
        "end = 8.0\nsection = { of = 'px + c x', direction = 'both' }",
    );
    let rows = columns(&csv(&folder, &section), &NAMES);
    assert!(rows.len() >= 4 && error(&rows) < 1e-4, "{rows:?}");
    for row in rows {
        assert!((row[4] + row[0] * row[2]).abs() < 1e-12, "{row:?}");
    }
}

#[test]
fn options_that_friction_excludes_are_refused() {
    let folder = folder("friction-refused");
    let nystrom = "mclachlan-atela-1992-order-4-optimal";
    for (setup, place, told) in [
        (
            format!("megno = true{SETUP}"),
            "1:9",
            "MEGNO is computed without friction only",
        ),
        (
            SETUP.replace("forest-ruth-1990", nystrom),
            "3:10",
            "has order 4 without friction, but only",
        ),
        (
            SETUP.replace("8.0", "5000.0"),
            "2:10",
            "changes momenta by more than a factor of 1e250",
        ),
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
