//! Sections: states at the zeros of an expression.

use std::f64::consts::{PI, TAU};
use std::fs;

use super::{array, call, columns, csv, folder};

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

#[test]
fn zeros_are_those_of_the_solution() {
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
    let cubic = super::CUBIC
        .replace("times = { from = 0, to = 20, count = 5 }", "end = 20")
        .replace("output", "section.of = \"px\"\n    output");
    let text = csv(&folder, &cubic);
    let (good, failed): (Vec<&str>, Vec<&str>) =
        text.lines().skip(1).partition(|line| line.ends_with(','));
    // The number in the last line is that of the crossings before it.
    let before = good.iter().filter(|line| line.starts_with("2,")).count();
    let [failed] = failed[..] else {
        panic!("{text}");
    };
    assert!(
        failed.starts_with(&format!("2,1.5,0,{before},")),
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

#[test]
fn wrong_sections_are_refused_at_their_place() {
    let folder = folder("section-wrong");
    let section = r#"{ of = "x" }"#;
    for (wrong, place, message) in [
        (r#"{ of = "x + y" }"#, "8:27", "unknown name `y`"),
        (r#"{ of = "x +" }"#, "8:", "expected"),
        (r#"{ of = "" }"#, "8:", "expected"),
        (r#"{ of = "[x, px]" }"#, "8:22", "a function with one value"),
        (
            r#"{ of = "x", direction = "up" }"#,
            "8:",
            "unknown variant `up`",
        ),
        (r#"{ off = "x" }"#, "8:", "unknown field `off`"),
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
