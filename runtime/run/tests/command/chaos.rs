//! MEGNO and the largest Lyapunov exponent.

use std::fs;

use crate::{array, call, columns, csv, doubles, folder};

/// A quasi-periodic orbit and a chaotic one of the energy 1/8, as in the documentation of the tangent map.
const SETUP: &str = r#"
megno = true
system = "HenonHeiles q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + (x^2 + y^2)/2 + x^2 y - y^3/3"
method = "forest-ruth-1990"
step_size = 0.05
end = 1000.0
starts = { x = 0, y = { values = [0.2, -0.16] }, py = 0, px = { energy = 0.125 } }
output.file = "out.csv"
"#;

#[test]
fn megno_tells_chaotic_orbits_from_regular_ones() {
    let folder = folder("megno");
    let text = csv(&folder, SETUP);
    let rows = columns(&text, &["megno", "lyapunov_exponent", "energy_error"]);
    assert!(
        (1.8..2.2).contains(&rows[0][0]) && rows[0][1] < 0.02,
        "{rows:?}"
    );
    assert!(rows[1][0] > 10.0 && rows[1][1] > 0.03, "{rows:?}");
    // The orbit itself has the bits of a run without the displacement.
    let states = ["x", "y", "px", "py", "steps", "energy_error"];
    let without = csv(&folder, &SETUP.replace("megno = true", "megno = false"));
    assert!(!without.contains("megno"));
    assert_eq!(columns(&text, &states), columns(&without, &states));
    assert!(
        call(&folder, &SETUP.replace("out.csv", "out.npz"), &[])
            .status
            .success()
    );
    let file = fs::read(folder.join("out.npz")).expect("the output");
    let (header, bytes) = array(&file, "megno");
    assert!(header.contains("(2, )"), "{header}");
    assert_eq!(doubles(&bytes), [rows[0][0], rows[1][0]]);
}

#[test]
fn implicit_methods_and_parts_have_indicators() {
    let folder = folder("megno-implicit");
    for solver in ["fixed-point", "newton"] {
        let setup = format!("solver = \"{solver}\"\n{SETUP}");
        let setup = setup
            .replace("forest-ruth-1990", "gauss-2")
            .replace("0.05", "0.2")
            .replace("1000.0", "200.0");
        let rows = columns(&csv(&folder, &setup), &["megno"]);
        // After 30 periods a chaotic orbit has grown by about e^10.
        assert!(rows[0][0] < 2.3 && rows[1][0] > 3.0, "{solver}: {rows:?}");
        let output = call(&folder, &setup, &["--shard", "1/2"]);
        assert!(output.status.success());
        let text = fs::read_to_string(folder.join("out.1-of-2.csv")).expect("a part");
        assert_eq!(columns(&text, &["megno"])[0], rows[1]);
    }
}

#[test]
fn indicators_at_times_are_refused() {
    let folder = folder("megno-times");
    for other in ["times = [0, 1]", "end = 1.0\nsection.of = 'y'"] {
        let output = call(&folder, &SETUP.replace("end = 1000.0", other), &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2));
        assert!(
            error.contains("MEGNO is computed at the end only") && error.contains("setup.toml:2:9"),
            "{error}"
        );
    }
}
