//! Sections: states at the zeros of an expression.

use std::f64::consts::{PI, TAU};
use std::fs;

use crate::{array, call, columns, csv, folder};

/// x = cos ωt from rest, with ω = 1, 2, 3.
const OSCILLATORS: &str = r#"
    system = "Oscillator { w } q: [x], p: [px]; H = px^2/2 + (w x)^2/2"
    method = "blanes-moan-2002-s10"
    step_size = 0.05
    end = 20.0
    parameters.w = { from = 1, to = 3, count = 3 }
    starts = { x = 1.0, px = 0.0 }
    section = { of = "x" }
    output.file = "out.csv"
"#;

/// Checks lines against the times of the zeros of each oscillator.
fn check(text: &str, zeros: impl Fn(f64) -> Vec<f64>) {
    let lines = columns(text, &["trajectory", "w", "number", "time", "x", "px"]);
    let mut lines = lines.iter();
    for (trajectory, w) in [1.0, 2.0, 3.0].into_iter().enumerate() {
        for (number, time) in zeros(w).into_iter().enumerate() {
            let line = lines.next().expect("a zero");
            assert_eq!(line[..3], [trajectory as f64, w, number as f64]);
            // The error of the method, of order 6 in ω h = 0.15.
            assert!((line[3] - time).abs() < 1e-6, "{line:?} {time}");
            let exact = [(w * time).cos(), -w * (w * time).sin()];
            assert!((line[4] - exact[0]).abs() < 1e-6, "{line:?}");
            assert!((line[5] - exact[1]).abs() < 1e-5, "{line:?}");
        }
    }
    assert_eq!(lines.next(), None);
}

/// (first + k distance)/ω up to 20.
fn zeros(first: f64, distance: f64) -> impl Fn(f64) -> Vec<f64> {
    move |w| {
        let times = (0..40).map(|k| (first + f64::from(k) * distance) / w);
        times.filter(|time| *time <= 20.0).collect()
    }
}

/// x = cos t is above a level for a short time in each period, less than the error of the interpolation.
#[test]
fn shallow_crossings_in_large_steps_are_all_found() {
    let folder = folder("shallow-section");
    for (step_size, level) in [(1.0, 0.999), (0.5, 0.9999), (0.25, 0.99999)] {
        let file = format!(
            r#"
            system = "Osc q: [x], p: [px]; H = px^2/2 + x^2/2"
            method = "gauss-4"
            step_size = {step_size:?}
            end = 200.0
            starts = {{ x = 1, px = 0 }}
            section = {{ of = "x - {level}", direction = "both" }}
            output.file = "out.csv"
            "#
        );
        let half = f64::acos(level);
        let times = (0..32).flat_map(|k| [-half, half].map(|by| TAU * f64::from(k) + by));
        let expected = times.filter(|time| (0.0..200.0).contains(time));
        let found = columns(&csv(&folder, &file), &["time", "x"]);
        assert_eq!(found.len(), 63, "{step_size} {level}");
        for (line, time) in found.iter().zip(expected) {
            // The error of the phase of the method, and of the level by it.
            assert!((line[0] - time).abs() < 1e-3, "{line:?} {time}");
            assert!((line[1] - level).abs() < 1e-12, "{line:?} {level}");
        }
    }
}

#[test]
fn crossings_of_a_section_are_those_of_the_solution() {
    let folder = folder("section");
    let of = |section: &str| csv(&folder, &OSCILLATORS.replace(r#"{ of = "x" }"#, section));
    check(&of(r#"{ of = "x" }"#), zeros(1.5 * PI, TAU));
    check(
        &of(r#"{ of = "x", direction = "falling" }"#),
        zeros(0.5 * PI, TAU),
    );
    check(
        &of(r#"{ of = "x", direction = "both" }"#),
        zeros(0.5 * PI, PI),
    );
    // The momentum, which starts at zero; parameters; time.
    check(&of(r#"{ of = "px", direction = "both" }"#), zeros(PI, PI));
    check(&of(r#"{ of = "sin(w t)" }"#), zeros(TAU, TAU));
    check(&of(r#"{ of = "(w x)^2 - px^2" }"#), zeros(0.75 * PI, PI));
    check(&of(r#"{ of = "x - 2" }"#), |_| Vec::new());
}

#[test]
fn all_formats_have_the_same_states_on_any_threads() {
    let folder = folder("section-formats");
    let text = csv(&folder, OSCILLATORS);
    let one = call(&folder, OSCILLATORS, &["--threads", "1"]);
    assert!(one.status.success());
    let again = fs::read_to_string(folder.join("out.csv")).expect("the output");
    assert_eq!(again, text);
    call(&folder, OSCILLATORS, &["--shard", "1/3"]);
    let part = fs::read_to_string(folder.join("out.1-of-3.csv")).expect("the output");
    let second = text.lines().filter(|line| line.starts_with("1,"));
    assert!(part.lines().skip(1).eq(second));

    call(&folder, &OSCILLATORS.replace("out.csv", "out.npz"), &[]);
    let file = fs::read(folder.join("out.npz")).expect("the output");
    let doubles = |name: &str| -> Vec<f64> {
        let (_, bytes) = array(&file, name);
        let words = bytes.chunks_exact(8);
        words
            .map(|word| f64::from_le_bytes(word.try_into().expect("eight")))
            .collect()
    };
    let integers = |name: &str| -> Vec<f64> {
        doubles(name)
            .iter()
            .map(|word| word.to_bits() as f64)
            .collect()
    };
    let names = ["trajectory", "number", "time", "x", "px", "energy_error"];
    let lines = columns(&text, &names);
    let found = [
        integers("section_trajectory"),
        integers("section_number"),
        doubles("section_time"),
        doubles("section_q"),
        doubles("section_p"),
        doubles("energy_error"),
    ];
    for (k, found) in found.iter().enumerate() {
        let expected: Vec<f64> = lines.iter().map(|line| line[k]).collect();
        assert_eq!(*found, expected, "{}", names[k]);
    }
    let (header, _) = array(&file, "section_q");
    assert!(
        header.contains(&format!("({}, 1, )", lines.len())),
        "{header}"
    );

    call(&folder, &OSCILLATORS.replace("out.csv", "out.parquet"), &[]);
    let file = fs::File::open(folder.join("out.parquet")).expect("the output");
    let reader = parquet::file::reader::SerializedFileReader::new(file).expect("a table");
    let rows = parquet::file::reader::FileReader::get_row_iter(&reader, None).expect("rows");
    let rows = rows.map(|row| {
        let row = row.expect("a row");
        let cell = |name: &str| {
            let mut cells = row.get_column_iter();
            let (_, field) = cells.find(|(known, _)| *known == name).expect("a column");
            field.to_string().parse::<f64>().expect("a number")
        };
        names[..3].iter().map(|name| cell(name)).collect::<Vec<_>>()
    });
    assert!(rows.eq(lines.iter().map(|line| line[..3].to_vec())));
}

#[test]
fn failed_trajectories_end_with_their_error() {
    let folder = folder("section-failed");
    let cubic = crate::CUBIC
        .replace("times = { from = 0, to = 20, count = 5 }", "end = 20")
        .replace("0.5, 1.5", "0.5, -0.6")
        .replace("output", "section.of = \"x\"\n    output");
    let text = csv(&folder, &cubic);
    let (good, failed): (Vec<&str>, Vec<&str>) =
        text.lines().skip(1).partition(|line| line.ends_with(','));
    // From x = -0.6, with more energy than the barrier of 1/6, it rises through zero once and escapes. The number in its last line is that of
    // the crossings before it.
    let before = good.iter().filter(|line| line.starts_with("2,")).count();
    assert_eq!(before, 1, "{text}");
    let [failed] = failed[..] else {
        panic!("{text}");
    };
    assert!(
        failed.starts_with(&format!("2,-0.6,0,{before},")),
        "{failed}"
    );
    assert!(failed.contains("is not finite") && good.len() > 5, "{text}");
    // An expression that is NaN somewhere.
    let output = call(&folder, &OSCILLATORS.replace("\"x\"", "\"sqrt(x)\""), &[]);
    assert_eq!(output.status.code(), Some(1));
    let text = fs::read_to_string(folder.join("out.csv")).expect("the output");
    let failed = text
        .lines()
        .filter(|line| line.contains("the event function is NaN"));
    assert_eq!(failed.count(), 3, "{text}");
}

/// A section is an expression of its own: comments and the names of the formula do not matter.
#[test]
fn sections_do_not_depend_on_the_rest_of_the_formula() {
    let folder = folder("section-alone");
    let text = csv(&folder, OSCILLATORS);
    let more = OSCILLATORS.replace("H =", "let distance = x; H =").replace(
        "^2/2\"",
        "^2/2 invariants: { value_of_section = px^2/2 + (w x)^2/2 }\"",
    );
    assert_ne!(more, OSCILLATORS);
    for of in ["x", "x // distance", "distance", "(x)", " x "] {
        let setup = more.replace("of = \"x\"", &format!("of = \"{of}\""));
        assert_eq!(csv(&folder, &setup), text, "{of}");
    }
    // Momenta of a Lagrangian have names; velocities have none.
    let pendulum = OSCILLATORS.replace("px^2/2 + (w x)^2/2", "vx^2/2 - (w x)^2/2");
    let pendulum = pendulum.replace("p: [px]; H", "v: [vx]; L");
    assert_eq!(csv(&folder, &pendulum), text);
    let output = call(&folder, &pendulum.replace("of = \"x\"", "of = \"vx\""), &[]);
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        errors.contains("a velocity is not supported here: write it with the momenta"),
        "{errors}"
    );
}

/// What the tape of a section cannot hold is refused with the reason.
#[test]
fn sections_out_of_range_or_too_long_are_refused() {
    let folder = folder("section-long");
    let beads = r#"
        system = "Beads q: [..; 2], p: [..; 2]; H = sum(i: |p[i]|^2/2 + |q[i]|^2/2)"
        method = "blanes-moan-2002-s10"
        step_size = 0.05
        end = 1.0
        section = { of = "q[1][0]" }
        starts = { q = [[1, 0], [0, 1]], p = [[0, 1], [1, 0]] }
        output.file = "out.csv"
    "#;
    csv(&folder, beads);
    // Five operations a term.
    let terms = |k: usize| format!("sin({k}.5 q[0][0]) cos({k} q[0][1])");
    let long = (0..20_000).map(terms).collect::<Vec<_>>().join(" + ");
    for (of, message) in [
        (
            "q[2][0]",
            "an index in `of` is out of range: that coordinate or entry of a parameter does not exist; positions are from 0 to 1",
        ),
        (
            &long,
            "`of` has more than 60000 operations: give a shorter expression",
        ),
    ] {
        let output = call(&folder, &beads.replace("q[1][0]", of), &[]);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(
            errors.contains(message),
            "{message}: {}",
            &errors[..errors.len().min(400)]
        );
    }
}

#[test]
fn wrong_sections_are_refused_at_their_place() {
    let folder = folder("section-wrong");
    let section = r#"{ of = "x" }"#;
    for (wrong, place, message) in [
        (r#"{ of = "x + y" }"#, "8:27", "unknown name `y`"),
        (r#"{ of = "" }"#, "8:", "expected"),
        (
            r#"{ of = "[x, px]" }"#,
            "8:22",
            "`of` has 2 components: give one of them, or a run for each",
        ),
        (r#"{ of = "[]" }"#, "8:22", "`of` has no components"),
        // Only an expression, whatever it is.
        (
            r#"{ of = "x), b = (px" }"#,
            "8:24",
            "found `)`, expected an operator or the end of the expression",
        ),
        (
            r#"{ of = "x) } force: { x = (-px" }"#,
            "8:24",
            "found `)`, expected an operator or the end of the expression",
        ),
        (
            r#"{ of = "(x // distance" }"#,
            "8:23",
            "`(` has no matching `)`",
        ),
        (
            r#"{ of = "x +" }"#,
            "8:26",
            "the expression ends, expected a number",
        ),
        (
            r#"{ of = "x invariants: { a = x }" }"#,
            "8:25",
            "found `invariants`",
        ),
        (
            r#"{ of = "value_of_section" }"#,
            "8:23",
            "unknown name `value_of_section`; known here: p, pi, px, q, t, w, x",
        ),
        (
            r#"{ of = "x", direction = "up" }"#,
            "8:",
            "unknown direction `up`, expected `rising`, `falling` or `both`",
        ),
        (
            r#"{ of = "x", direction = 1 }"#,
            "8:39",
            "integer `1`, expected a string",
        ),
        (r#"'x'"#, "8:15", "expected one table, such as"),
        (r#"['x']"#, "8:15", "expected one table, such as"),
        (
            r#"{ direction = "both" }"#,
            "8:15",
            "the key `section.of` is missing",
        ),
        (
            r#"{ off = "x" }"#,
            "8:17",
            "there is no key `off`; known here: `of`, `direction`",
        ),
    ] {
        let output = call(&folder, &OSCILLATORS.replace(section, wrong), &[]);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{errors}");
        assert!(errors.contains(message), "{wrong}: {errors}");
        assert!(
            errors.contains(&format!("setup.toml:{place}")),
            "{wrong}: {errors}"
        );
    }
    // A text that is not literally in the file is shown by itself, whatever the formula is.
    let greek = OSCILLATORS.replace("Oscillator", "abΩΩΩ");
    for (wrong, place) in [
        (r#"{ of = "\u0078 + yy" }"#, "1:5"),
        (r#"{ of = "x +\n yy" }"#, "2:2"),
        ("{ of = \"\"\"x + \\\n\n  yy\"\"\" }", "1:5"),
    ] {
        let output = call(&folder, &greek.replace(section, wrong), &[]);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{errors}");
        assert!(errors.contains("unknown name `yy`"), "{wrong}: {errors}");
        let place = format!("setup.toml:{place}\n");
        assert!(
            errors.contains("> `of` in ") && errors.contains(&place),
            "{wrong}: {errors}"
        );
    }
    let times = OSCILLATORS.replace("end = 20.0", "times = [1, 2]");
    let errors = call(&folder, &times, &[]).stderr;
    let errors = String::from_utf8_lossy(&errors).into_owned();
    assert!(
        errors.contains("both `times` and `section` are given"),
        "{errors}"
    );
    let twin = OSCILLATORS
        .replace("[x]", "[number]")
        .replace("w x)", "w number)");
    let twin = twin
        .replace("{ x =", "{ number =")
        .replace("\"x\"", "\"number\"");
    let errors = call(&folder, &twin, &[]).stderr;
    let errors = String::from_utf8_lossy(&errors).into_owned();
    assert!(
        errors.contains("two columns of the table would have the name `number`"),
        "{errors}"
    );
}
