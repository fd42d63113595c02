//! Newton's iteration.

use crate::{call, columns, folder};

/// A pendulum on a stiff spring; fixed-point sweeps diverge.
const STIFF: &str = r#"
solver = "newton"
system = "Spring { k: 1e8 } q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + k (|[x, y]| - 1)^2/2 + y"
method = "gauss-4"
step_size = 0.01
end = 1.0
starts = { x = { values = [1, 0.6] }, y = "-sqrt(1 - x^2)", px = 0, py = 0 }
output.file = "out.csv"
"#;

#[test]
fn newton_takes_steps_of_stiff_systems() {
    let folder = folder("newton");
    let output = call(&folder, &STIFF.replace("newton", "fixed-point"), &[]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        said.contains("failed, no convergence  2: trajectory 0: "),
        "{said}"
    );
    let output = call(&folder, STIFF, &[]);
    assert!(
        output.status.success() && output.stderr.is_empty(),
        "{output:?}"
    );
    let text = std::fs::read_to_string(folder.join("out.csv")).expect("the output");
    for row in columns(&text, &["x", "y", "energy_error"]) {
        // The spring is longer by the force over k, at most 3e-8, and oscillates with the same amplitude.
        assert!((row[0].hypot(row[1]) - 1.0).abs() < 1e-7, "{row:?}");
    }
}

#[test]
fn a_solver_that_does_nothing_is_refused() {
    let folder = folder("solver");
    for (setup, told) in [
        (
            STIFF.replace("gauss-4", "forest-ruth-1990"),
            "`forest-ruth-1990` is explicit for this H",
        ),
        (
            STIFF.replace("newton", "Newton"),
            "unknown solver `Newton`, expected `fixed-point` or `newton`",
        ),
        (
            STIFF.replace("\"newton\"", "1"),
            "`solver`: found the integer `1`, expected a string",
        ),
    ] {
        let output = call(&folder, &setup, &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(
            error.contains(told) && error.contains("setup.toml:2:10"),
            "{error}"
        );
    }
}
