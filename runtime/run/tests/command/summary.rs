//! What a run says at its end.

use std::process::Output;

use crate::{CUBIC, PENDULUM, call, folder};

/// The lines of standard output without that of the time, and standard error.
fn said(output: &Output) -> (Vec<String>, String) {
    let text = String::from_utf8_lossy(&output.stdout);
    let lines = text.lines().filter(|line| !line.starts_with("  time "));
    let lines = lines.map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    (lines.collect(), errors)
}

const FAR: &str = r#"
system = "Kepler q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 - 1/|[x, y]|"
method = "gauss-4"
step_size = 1000
end = 1e6
starts = { x = 1, y = 0, px = 0, py = 1 }
output.file = "k.csv"
"#;

/// A step of 159 periods: the orbit leaves to r = 95 790.
#[test]
fn a_run_with_a_large_energy_error_warns() {
    let folder = folder("far");
    let output = call(&folder, FAR, &[]);
    assert_eq!(output.status.code(), Some(0));
    let (lines, errors) = said(&output);
    assert!(
        lines[0].starts_with("1 trajectory, 0 failed: "),
        "{lines:?}"
    );
    assert_eq!(
        lines[1],
        "largest energy error 1.9e0 (trajectory 0, time 1000000)"
    );
    assert_eq!(lines[2], "steps 1000");
    assert!(
        lines[3].starts_with("sweeps ") && lines.len() == 4,
        "{lines:?}"
    );
    assert!(
        errors.contains("warning: the energy error is above 0.01 in 1 of 1 trajectory; the largest is 1.9e0 (trajectory 0, time 1000000)"),
        "{errors}"
    );
    for (bound, warns) in [("2", false), ("inf", false), ("1.5", true), ("0", true)] {
        let setup = format!("warn_energy_error = {bound}\n{FAR}");
        let (_, errors) = said(&call(&folder, &setup, &[]));
        let told = format!("above {bound} in");
        assert_eq!(errors.contains(&told), warns, "{bound}: {errors}");
    }
    for (bound, told) in [
        ("nan", "`warn_energy_error` is NaN"),
        ("-1", "`warn_energy_error` is -1"),
        (
            "'1'",
            "`warn_energy_error`: found a string, expected a number",
        ),
    ] {
        let output = call(&folder, &format!("warn_energy_error = {bound}\n{FAR}"), &[]);
        let (_, errors) = said(&output);
        assert_eq!(output.status.code(), Some(2));
        assert!(errors.contains(told), "{errors}");
    }
}

/// Also at times within the run, and in a section without states.
#[test]
fn the_largest_energy_error_is_that_of_all_states() {
    let folder = folder("largest");
    let at_times = FAR.replace("end = 1e6", "times = [1000, 2000, 3000]");
    let section = FAR.replace("end = 1e6", "end = 1e6\nsection.of = 'x - 1e9'");
    for setup in [at_times, section] {
        let (lines, errors) = said(&call(&folder, &setup, &[]));
        assert!(lines[1].starts_with("largest energy error "), "{lines:?}");
        assert!(errors.contains("warning: the energy error"), "{errors}");
    }
}

/// If H depends on time, it is not conserved.
#[test]
fn a_change_of_energy_with_time_is_not_an_error() {
    let folder = folder("forced");
    let setup = PENDULUM.replace("cos(a)", "cos(a) + a sin(t)");
    let output = call(&folder, &setup, &[]);
    let (lines, errors) = said(&output);
    assert!(
        lines[1].starts_with("largest change of energy "),
        "{lines:?}"
    );
    assert!(errors.is_empty(), "{errors}");
}

/// The third trajectory escapes; its energy is not that of the others.
#[test]
fn failures_are_counted_by_kind() {
    let folder = folder("kinds");
    let setup = CUBIC.replace("[0.1, 0.5, 1.5]", "[0.1, 1.5, 0.5, 1.6]");
    let (lines, errors) = said(&call(&folder, &setup, &[]));
    assert!(
        lines[0].starts_with("4 trajectories, 2 failed: "),
        "{lines:?}"
    );
    assert!(
        lines[1].starts_with("failed, not finite 2: trajectory 1: step "),
        "{lines:?}"
    );
    assert!(
        lines[2].starts_with("largest energy error") && lines[2].contains("(trajectory 2, time "),
        "{lines:?}"
    );
    assert!(errors.is_empty(), "{errors}");
}
