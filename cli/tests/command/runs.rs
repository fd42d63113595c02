//! `symplectic run`: trajectories beside those of the macros, starts, files, and what is refused.

use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::Output;

use ::symplectic::ensemble::{Ensemble, Parquet, ParquetColumn};
use ::symplectic::nalgebra::DVector;
use ::symplectic::{Method, ProvedFor, State, System, Vector};

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use crate::run;

::symplectic::tableau! {
    S10 { base: blanes-moan-2002-s10 }
    Gauss2 { basis: polynomial(2), nodes: gauss(2) }
}

::symplectic::hamiltonian! { Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a) }
::symplectic::hamiltonian! { Product q: [x], p: [px]; H = (x^2 + 1)(px^2 + 1)/2 }
::symplectic::hamiltonian! {
    Planets { m: [..], G: 1 }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)
}

/// A folder of a test.
fn folder(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("symplectic-run-{}-{name}", std::process::id()));
    fs::create_dir_all(&path).expect("a folder");
    path
}

fn call(folder: &Path, setup: &str, options: &[&str]) -> Output {
    let file = folder.join("setup.toml");
    fs::write(&file, setup).expect("a file");
    let file = file.display().to_string();
    run::symplectic(&[&["run", &file], options].concat())
}

/// Runs a setup that must succeed in silence, and returns the file `out.csv`.
fn csv(folder: &Path, setup: &str) -> String {
    let output = call(folder, setup, &[]);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && errors.is_empty(), "{errors}");
    fs::read_to_string(folder.join("out.csv")).expect("the output")
}

/// Some columns of a CSV file.
fn columns(text: &str, names: &[&str]) -> Vec<Vec<f64>> {
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let places = names.iter().map(|name| {
        let place = header.iter().position(|known| known == name);
        place.unwrap_or_else(|| panic!("no column {name} in {header:?}"))
    });
    let places: Vec<usize> = places.collect();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        places
            .iter()
            .map(|&place| cells[place].parse().expect("a number"))
            .collect()
    };
    lines.map(row).collect()
}

/// The ends of an ensemble of an emitted method.
fn ends<M, S, V>(method: M, system: S, starts: Vec<State<V>>, size: f64, end: f64) -> Vec<Vec<f64>>
where
    M: Method + ProvedFor<S::Class>,
    S: System<V> + Clone + Send + Sync,
    V: Vector<Scalar = f64> + Send + Sync,
{
    let mut ends = Vec::new();
    Ensemble::new(method, system, starts, size)
        .expect("starts")
        .integrate_to(end, |row| {
            assert_eq!(row.outcome, Ok(()));
            let (q, p) = row.state.as_slices();
            ends.push([q, p].concat());
            ControlFlow::Continue(())
        });
    ends
}

fn assert_near(found: &[Vec<f64>], expected: &[Vec<f64>], bound: f64) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!(found.len(), expected.len());
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < bound, "{found:?} {expected:?}");
        }
    }
}

const PENDULUM: &str = r#"
    system = "Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)"
    method = "blanes-moan-2002-s10"
    step_size = 0.05
    end = 10.0
    parameters.g = 4
    [starts]
    a = { from = -1, to = 1, count = 11 }
    pa = 0.5
    [output]
    file = "out.csv"
"#;

#[test]
fn a_pendulum_ends_where_the_emitted_method_does() {
    let folder = folder("pendulum");
    let found = columns(&csv(&folder, PENDULUM), &["a", "pa"]);
    let start = |k: i32| State::from_arrays(0.0, [-1.0 + 0.2 * f64::from(k)], [0.5]);
    let starts = || (0..11).map(start).collect::<Vec<_>>();
    let expected = ends(S10, Pendulum { g: 4.0 }, starts(), 0.05, 10.0);
    // 200 steps with a rounding error each, amplified by the flow.
    assert_near(&found, &expected, 1e-12);
    // With another g they are elsewhere.
    let other = ends(S10, Pendulum { g: 9.81 }, starts(), 0.05, 10.0);
    assert!((other[0][0] - found[0][0]).abs() > 0.1);

    let errors = columns(&csv(&folder, PENDULUM), &["energy_error", "steps"]);
    assert!(
        errors
            .iter()
            .all(|row| row[0].abs() < 1e-7 && row[1] == 200.0),
        "{errors:?}"
    );
}

#[test]
fn orbits_close() {
    let folder = folder("kepler");
    // Of semi-major axis 1, from the pericentre: the eccentricity is 1 − q.
    let setup = r#"
        system = "Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q|"
        method = "blanes-moan-2002-s10"
        step_size = 0.01
        end = 6.283185307179586
        starts = "starts.csv"
        output.file = "out.csv"
    "#;
    let mut starts = "p[1], q[1], q[0], p[0]\n".to_owned();
    let mut expected = Vec::new();
    for eccentricity in [0.0_f64, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6] {
        let (q, p) = (
            1.0 - eccentricity,
            ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt(),
        );
        starts.push_str(&format!("{p},0,{q},0\n"));
        expected.push(vec![q, 0.0, 0.0, p]);
    }
    fs::write(folder.join("starts.csv"), starts).expect("a file");
    let found = columns(&csv(&folder, setup), &["q[0]", "q[1]", "p[0]", "p[1]"]);
    assert_near(&found, &expected, 1e-8);
}

#[test]
fn three_bodies_end_where_the_emitted_method_does() {
    let setup = r#"
        system = """
        Planets { m: [..], G: 1 }
        q: [..; 2], p: [..; 2];
        H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)
        """
        method = "blanes-moan-2002-s10"
        step_size = 0.01
        end = 5.0
        parameters.m = [1, 1e-3, 2e-3]
        [starts]
        q = [[0, 0], [1, 0], [{ from = -2, to = -1.5, count = 3 }, 0]]
        p = [[0, 0], [0, 1e-3], [0, -1.4e-3]]
        [output]
        file = "out.csv"
    "#;
    let names: Vec<String> = ["q", "p"]
        .iter()
        .flat_map(|half| (0..3).flat_map(move |i| (0..2).map(move |k| format!("{half}[{i}][{k}]"))))
        .collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let found = columns(&csv(&folder("planets"), setup), &names);
    let start = |x: f64| {
        let q = [0.0, 0.0, 1.0, 0.0, x, 0.0];
        let p = [0.0, 0.0, 0.0, 1e-3, 0.0, -1.4e-3];
        let vector = |numbers: &[f64]| DVector::from_column_slice(numbers);
        State::new(0.0, vector(&q), vector(&p))
    };
    let system = Planets {
        m: vec![1.0, 1e-3, 2e-3],
        G: 1.0,
    };
    let starts = vec![start(-2.0), start(-1.75), start(-1.5)];
    assert_near(&found, &ends(S10, system, starts, 0.01, 5.0), 1e-11);
}

#[test]
fn a_system_that_is_not_separable() {
    let setup = r#"
        system = "Product q: [x], p: [px]; H = (x^2 + 1)(px^2 + 1)/2"
        method = { basis = "polynomial(2)", nodes = "gauss(2)" }
        sums = "plain"
        step_size = -0.05
        end = -5
        [[starts]]
        x = 0.1
        px = 0.3
        [[starts]]
        x = 0.2
        px = 0.4
        [output]
        file = "out.csv"
    "#;
    let found = columns(&csv(&folder("product"), setup), &["x", "px"]);
    let starts = [[0.1, 0.3], [0.2, 0.4]].map(|[x, p]| State::from_arrays(0.0, [x], [p]));
    // Iterations stop within some units of rounding.
    assert_near(
        &found,
        &ends(Gauss2, Product, starts.to_vec(), -0.05, -5.0),
        1e-11,
    );
}

#[test]
fn grids_go_through_the_last_coordinate_first() {
    let setup = PENDULUM.replace("end = 10.0", "end = 0.0").replace(
        "a = { from = -1, to = 1, count = 11 }\n    pa = 0.5",
        "pa = { values = [3, 1, 2] }\n    a = { from = 0, to = 1, count = 2 }",
    );
    let found = columns(&csv(&folder("grid"), &setup), &["pa_start", "a_start"]);
    let expected = [[3., 0.], [3., 1.], [1., 0.], [1., 1.], [2., 0.], [2., 1.]];
    assert_eq!(found, expected.map(Vec::from));
}

const CLOUD: &str = r#"
    system = "Oscillator q: [x], p: [px]; H = px^2/2 + x^2/2"
    method = "forest-ruth-1990"
    step_size = 0.1
    end = 1.0
    random = { seed = 7, count = 4000 }
    [starts]
    x = { uniform = [-1, 3] }
    px = { normal = [2, 0.5] }
    [output]
    file = "out.csv"
"#;

#[test]
fn random_starts_are_those_of_their_seed() {
    let folder = folder("random");
    let first = csv(&folder, CLOUD);
    assert_eq!(first, csv(&folder, CLOUD));
    let other = csv(&folder, &CLOUD.replace("seed = 7", "seed = 8"));
    let starts = columns(&first, &["x_start", "px_start"]);
    let others = columns(&other, &["x_start", "px_start"]);
    assert!(
        starts
            .iter()
            .zip(&others)
            .all(|(a, b)| a[0] != b[0] && a[1] != b[1])
    );
    let count = starts.len() as f64;
    assert_eq!(count, 4000.0);
    let mean = |of: &dyn Fn(&Vec<f64>) -> f64| starts.iter().map(of).sum::<f64>() / count;
    // Five standard deviations of the mean and of the variance.
    let bound = 5.0 / count.sqrt();
    let deviation = 4.0 / 12.0_f64.sqrt();
    assert!((mean(&|row| row[0]) - 1.0).abs() < bound * deviation);
    assert!((mean(&|row| (row[0] - 1.0).powi(2)) - 4.0 / 3.0).abs() < bound * 1.2);
    assert!((mean(&|row| row[1]) - 2.0).abs() < bound * 0.5);
    assert!((mean(&|row| (row[1] - 2.0).powi(2)) - 0.25).abs() < bound * 0.25 * 2.0_f64.sqrt());
    // They do not depend on each other.
    assert!(mean(&|row| (row[0] - 1.0) * (row[1] - 2.0)).abs() < bound * deviation * 0.5);
    assert!(starts.iter().all(|row| (-1.0..=3.0).contains(&row[0])));
}

#[test]
fn parts_and_threads_have_the_same_bits() {
    let folder = folder("parts");
    let setup = CLOUD.replace("count = 4000", "count = 50");
    let whole = csv(&folder, &setup);
    let mut parts = String::new();
    for part in 0..3 {
        let output = call(&folder, &setup, &["--shard", &format!("{part}/3")]);
        assert!(output.status.success());
        let text = fs::read_to_string(folder.join(format!("out.{part}-of-3.csv"))).expect("a part");
        let (header, lines) = text.split_once('\n').expect("lines");
        assert!(whole.starts_with(header));
        parts.push_str(lines);
    }
    assert_eq!(whole.split_once('\n').expect("lines").1, parts);
    for threads in ["1", "2"] {
        let output = call(&folder, &setup, &["--threads", threads]);
        assert!(output.status.success());
        assert_eq!(
            fs::read_to_string(folder.join("out.csv")).expect("the output"),
            whole
        );
    }
    // Nothing else is left behind.
    let mut names: Vec<_> = fs::read_dir(&folder)
        .expect("a folder")
        .map(|entry| {
            entry
                .expect("a file")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    let expected = [
        "out.0-of-3.csv",
        "out.1-of-3.csv",
        "out.2-of-3.csv",
        "out.csv",
        "setup.toml",
    ];
    assert_eq!(names, expected);
}

#[test]
fn a_part_may_be_empty() {
    let folder = folder("empty-part");
    let output = call(&folder, PENDULUM, &["--shard", "0/64"]);
    assert!(output.status.success(), "{output:?}");
    let part = fs::read_to_string(folder.join("out.0-of-64.csv")).expect("a part");
    assert_eq!(part.lines().count(), 1);
}

/// The header and the data of an array in a `.npz` file, which is not compressed.
fn array(file: &[u8], name: &str) -> (String, Vec<u8>) {
    let short = |at: usize| usize::from(u16::from_le_bytes([file[at], file[at + 1]]));
    let mut at = 0;
    while file[at..].starts_with(b"PK\x03\x04") {
        let size = short(at + 18) + (short(at + 20) << 16);
        let begin = at + 30 + short(at + 26) + short(at + 28);
        if file[at + 30..].starts_with(format!("{name}.npy").as_bytes()) {
            let header = 10 + short(begin + 8);
            let text = String::from_utf8_lossy(&file[begin + 10..begin + header]).into_owned();
            return (text, file[begin + header..begin + size].to_vec());
        }
        at = begin + size;
    }
    panic!("no array {name}");
}

fn doubles(bytes: &[u8]) -> Vec<f64> {
    let (chunks, rest) = bytes.as_chunks::<8>();
    assert!(rest.is_empty());
    chunks
        .iter()
        .map(|bytes| f64::from_le_bytes(*bytes))
        .collect()
}

/// Three trajectories with states at times; the last one escapes to infinity.
const CUBIC: &str = r#"
    system = "Cubic q: [x], p: [px]; H = px^2/2 + x^2/2 - x^3/3"
    method = "forest-ruth-1990"
    step_size = 0.1
    times = { from = 0, to = 20, count = 5 }
    starts = { x = { values = [0.1, 0.5, 1.5] }, px = 0.0 }
    output.file = "out.csv"
"#;

#[test]
fn files_for_numpy_hold_states_at_times() {
    let folder = folder("npz");
    let output = call(&folder, &CUBIC.replace("out.csv", "out.npz"), &[]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.starts_with("3 trajectories, 1 failed: "), "{said}");
    let file = fs::read(folder.join("out.npz")).expect("the output");
    let (header, bytes) = array(&file, "q_at_times");
    assert!(
        header.contains("'<f8'") && header.contains("(3, 5, 1, )"),
        "{header}"
    );
    let seen = doubles(&bytes);
    assert_eq!([seen[0], seen[5], seen[10]], [0.1, 0.5, 1.5]);
    assert!(seen[..10].iter().all(|x| x.is_finite()));
    assert!(seen[14].is_nan());
    let at_end = doubles(&array(&file, "q").1);
    assert_eq!(at_end[..2], [seen[4], seen[9]]);
    let errors = doubles(&array(&file, "energy_error").1);
    assert!(errors[0] == 0.0 && errors[..10].iter().all(|error| error.abs() < 1e-3));
    assert_eq!(array(&file, "failed").1, 2_u64.to_le_bytes());
    let (header, method) = array(&file, "method");
    assert!(header.contains("'<U16'"), "{header}");
    let letters: String = method
        .iter()
        .filter(|&&byte| byte != 0)
        .map(|&byte| char::from(byte))
        .collect();
    assert_eq!(letters, "forest-ruth-1990");
}

#[test]
fn wrong_files_are_refused_at_their_place() {
    let folder = folder("wrong");
    let replaced = |from: &str, to: &str| {
        assert!(PENDULUM.contains(from), "{from}");
        PENDULUM.replace(from, to)
    };
    let quartic = PENDULUM.replace("pa^2/2", "pa^4/4").replace(
        "blanes-moan-2002-s10",
        "mclachlan-atela-1992-order-4-optimal",
    );
    let two = PENDULUM.replace("H = pa^2/2 - g cos(a)", "H = pa^2/2 - g cos(a) + a pa");
    for (setup, place, message) in [
        (replaced("end =", "ende ="), "5:", "unknown field `ende`"),
        (
            replaced("pa = 0.5", "pb = 0.5"),
            "9:",
            "there is no coordinate `pb`; the coordinates are a, pa",
        ),
        (replaced("pa = 0.5", ""), "7:", "give no value for `pa`"),
        (
            replaced("-s10", "-s9"),
            "3:",
            "known here: blanes-moan-2002-s6, blanes-moan-2002-s10",
        ),
        (replaced("= 0.05", "= 0"), "4:", "the step size is 0"),
        (
            replaced("= 10.0", "= -10.0"),
            "5:",
            "cannot reach the time -10",
        ),
        (replaced("pa = 0.5", "pa = nan"), "7:", "trajectory 0: "),
        (replaced("cos(a)", "cos(b)"), "2:72", "unknown name `b`"),
        (
            replaced("{ g: 9.81 }", "{ g }").replace("parameters.g = 4", ""),
            "2:",
            "the parameter `g` has no value",
        ),
        (
            replaced("parameters.g", "parameters.h"),
            "6:",
            "there is no parameter `h`; the parameters are g",
        ),
        (
            replaced("count = 11", "count = 0"),
            "8:",
            "`a`: expected a number",
        ),
        (
            replaced(
                "a = { from = -1, to = 1, count = 11 }",
                "a = { normal = [0, 1] }",
            ),
            "7:",
            "`random = { seed = 1, count = 1000 }`",
        ),
        (
            quartic,
            "3:",
            "has order 4 if the kinetic energy is quadratic",
        ),
        (two, "3:", "for separable H only"),
    ] {
        let output = call(&folder, &setup, &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}: {error}");
        assert!(
            error.contains(message) && error.contains(&format!("setup.toml:{place}")),
            "{place} {message}: {error}"
        );
    }
    for (file, message) in [
        ("nowhere/out.csv", "nothing was computed"),
        ("out.txt", "must end in .npz, .parquet or .csv"),
    ] {
        let output = call(&folder, &replaced("out.csv", file), &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(
            output.status.code() == Some(2) && error.contains(message),
            "{error}"
        );
    }
    // A table has a column for the time.
    let timed = replaced("[a]", "[time]").replace("cos(a)", "cos(time)");
    let timed = timed.replace("a = {", "time = {");
    for (file, status) in [("out.csv", 2), ("out.parquet", 2), ("out.npz", 0)] {
        let output = call(&folder, &timed.replace("out.csv", file), &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{error}");
        assert_eq!(error.contains("would have the name `time`"), status == 2);
    }
    // A line of a CSV file.
    let table = "starts.csv";
    let setup = &PENDULUM[..PENDULUM.find("[starts]").expect("a table")];
    let setup = format!("starts = '{table}'\noutput.file = 'out.csv'\n{setup}");
    for (text, message) in [
        (
            "a,pa\n0,1\n0,nan\n",
            "column `pa`: expected a finite number, found `nan`",
        ),
        ("a,pb\n0,1\n", "line 1: the column `pb` is not a coordinate"),
        ("a\n0\n", "line 1: the column `pa` is missing"),
    ] {
        fs::write(folder.join(table), text).expect("a file");
        let output = call(&folder, &setup, &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(
            output.status.code() == Some(2) && error.contains(message),
            "{error}"
        );
    }
}

/// H = Σ p²/2 + (Σ_i Σ_j A_ij q_i q_j)/2: a free sum in a sum. From q = (1, 0) with A = [[2, -1], [-1, 2]] the frequencies are 1 and √3.
#[test]
fn a_sum_in_a_sum() {
    let folder = folder("sums");
    let setup = |end: f64| {
        format!(
            r#"
    system = "Coupled {{ A: [.., ..] }} q: [..], p: [..]; H = sum(i: p[i]^2/2) + sum(i: sum(j: A[i, j] q[i] q[j]))/2"
    method = "blanes-moan-2002-s10"
    step_size = 0.05
    end = {end}
    parameters.A = [[2, -1], [-1, 2]]
    starts = {{ q = [1, 0], p = [0, 0] }}
    output.file = "out.csv"
"#
        )
    };
    let found = columns(&csv(&folder, &setup(7.0)), &["q[0]", "q[1]"]);
    let (slow, fast) = (7.0_f64.cos() / 2.0, (7.0 * 3.0_f64.sqrt()).cos() / 2.0);
    assert_near(&found, &[vec![slow + fast, slow - fast]], 1e-8);
}

/// What would lose something, or take all memory, is refused before anything is run.
#[test]
fn nothing_is_lost_and_nothing_is_endless() {
    let folder = folder("refused");
    fs::write(folder.join("starts.csv"), "a,pa\n1,0\n").expect("a file");
    fs::create_dir_all(folder.join("there.csv")).expect("a folder");
    let starts = "[starts]\n    a = { from = -1, to = 1, count = 11 }\n    pa = 0.5\n";
    assert!(PENDULUM.contains(starts));
    let of_file = PENDULUM
        .replace(&format!("    {starts}"), "")
        .replace("step_size", "starts = \"starts.csv\"\n    step_size");
    let cases = [
        (
            of_file.replace("out.csv", "starts.csv"),
            "would overwrite the file of the starts",
        ),
        (PENDULUM.replace("out.csv", "there.csv"), "is a folder"),
        (
            PENDULUM.replace("count = 11", "count = 1000000000000"),
            "up to 4194304",
        ),
        (
            PENDULUM.replace(
                "end = 10.0",
                "times = { from = 0, to = 1, count = 1000000000000 }",
            ),
            "more than 4194304 entries",
        ),
        (
            PENDULUM
                .replace(
                    "end = 10.0",
                    "times = { from = 0, to = 1, count = 4000000 }",
                )
                .replace("count = 11", "count = 1000"),
            "components in all: give fewer",
        ),
        (
            PENDULUM.replace("end = 10.0", "end = 1e300"),
            "more than 2^53 steps",
        ),
        (
            PENDULUM.replace("g = 4", "g = inf"),
            "expected a finite number",
        ),
    ];
    for (setup, told) in cases {
        let output = call(&folder, &setup, &[]);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}: {errors}");
        assert!(errors.contains(told), "{told}: {errors}");
    }
    let kept = fs::read_to_string(folder.join("starts.csv")).expect("the starts");
    assert_eq!(kept, "a,pa\n1,0\n");
}

#[test]
fn what_is_accepted_of_lower_order_runs() {
    let setup = PENDULUM
        .replace("pa^2/2", "pa^4/4")
        .replace(
            "blanes-moan-2002-s10",
            "mclachlan-atela-1992-order-4-optimal",
        )
        .replace("end = 10.0", "end = 1.0\n    accept_lower_order = true");
    assert_eq!(csv(&folder("lower"), &setup).lines().count(), 12);
}

/// Every function, in steps of size 0.01: beside a system of the macro.
#[test]
fn every_function_is_that_of_the_macro() {
    ::symplectic::hamiltonian! {
        Functions { k: 2 } q: [x, y], p: [px, py];
        H = (px^2 + py^2)/2 + exp(-x^2) + ln(2 + y) + tan(x/3) + asin(y/3) + acos(x/4) + atan(k x) + sinh(y/2)
            + cosh(x) + tanh(y) + atan2(1 + x, 2 + y) + sqrt(1 + x^2) + |x - 5|^3/7 + (2 + x)^(1/3) + sin(x y) cos(t) + pi x/(1 + y^2)^2
    }
    let formula = "Functions { k: 2 } q: [x, y], p: [px, py];
        H = (px^2 + py^2)/2 + exp(-x^2) + ln(2 + y) + tan(x/3) + asin(y/3) + acos(x/4) + atan(k x) + sinh(y/2)
            + cosh(x) + tanh(y) + atan2(1 + x, 2 + y) + sqrt(1 + x^2) + |x - 5|^3/7 + (2 + x)^(1/3) + sin(x y) cos(t) + pi x/(1 + y^2)^2";
    let setup = format!(
        "system = '''{formula}'''\nmethod = 'blanes-moan-2002-s10'\nstep_size = 0.01\nstart_time = 0.5\nend = 1.0
        starts = {{ x = {{ from = 0, to = 0.5, count = 9 }}, y = 0.1, px = 0, py = 0.2 }}\noutput.file = 'out.csv'"
    );
    let found = columns(&csv(&folder("functions"), &setup), &["x", "y", "px", "py"]);
    let starts = (0..9).map(|k| State::from_arrays(0.5, [0.0625 * f64::from(k), 0.1], [0.0, 0.2]));
    let expected = ends(S10, Functions { k: 2.0 }, starts.collect(), 0.01, 1.0);
    assert_near(&found, &expected, 1e-13);
}

/// The example of the book.
#[test]
fn the_example_of_the_book_runs() {
    let page = include_str!("../../../docs/src/guide/run.md");
    let setup = page
        .split("```toml\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next());
    let folder = folder("book");
    let output = call(&folder, setup.expect("an example"), &[]);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && errors.is_empty(), "{errors}");
    let file = fs::read(folder.join("henon-heiles.npz")).expect("the output");
    let errors = doubles(&array(&file, "energy_error").1);
    assert!(
        errors.len() == 64 && errors.iter().all(|error| error.abs() < 1e-6),
        "{errors:?}"
    );
}

/// Every number of a table in Parquet is that of the table in CSV, with the facts beside it.
#[test]
fn tables_are_the_same_as_parquet_and_as_csv() {
    let folder = folder("parquet");
    let table = csv(&folder, CUBIC);
    call(&folder, &CUBIC.replace("out.csv", "out.parquet"), &[]);
    let file = fs::File::open(folder.join("out.parquet")).expect("the output");
    let reader = SerializedFileReader::new(file).expect("a table");
    let about = reader.metadata().file_metadata();
    let notes = about.key_value_metadata().expect("notes");
    let method = notes.iter().find(|note| note.key == "method");
    let method = method.and_then(|note| note.value.as_deref());
    assert_eq!(method, Some("forest-ruth-1990"));
    let mut lines = csv::Reader::from_reader(table.as_bytes());
    let fields = about.schema().get_fields().iter();
    let names: Vec<&str> = fields.map(|field| field.name()).collect();
    assert_eq!(lines.headers().expect("a header"), names);
    let lines: Vec<csv::StringRecord> = lines.records().map(|line| line.expect("a line")).collect();
    let mut count = 0;
    for (row, line) in reader.get_row_iter(None).expect("rows").zip(&lines) {
        let row = row.expect("a row");
        for ((_, field), cell) in row.get_column_iter().zip(line) {
            let same = match field {
                Field::Double(value) => {
                    value.is_nan() && cell.is_empty() || cell.parse() == Ok(*value)
                }
                Field::ULong(value) => cell.parse() == Ok(*value),
                Field::Str(text) => cell == text && !cell.is_empty(),
                Field::Null => cell.is_empty(),
                _ => false,
            };
            assert!(same, "{field:?} {cell}");
        }
        count += 1;
    }
    // Two trajectories at five times; of the third what it reached, and its end.
    assert!(count > 11 && count == lines.len(), "{count}");
}

#[test]
fn starts_are_read_from_parquet() {
    let folder = folder("starts-parquet");
    let write = |name: &str, columns: &[(&str, ParquetColumn)]| {
        let mut file = Parquet::new(fs::File::create(folder.join(name)).expect("a file"));
        file.group(columns).expect("room");
        file.finish().expect("room");
    };
    let setup = &PENDULUM[..PENDULUM.find("[starts]").expect("a table")];
    let setup = |name: &str| format!("starts = '{name}'\noutput.file = 'out.csv'\n{setup}");
    let doubles = |values: &[f64]| ParquetColumn::Doubles(values.to_vec());
    let angles = [0.1, -0.25, 1.0 / 3.0];
    write(
        "starts.parquet",
        &[
            ("pa", ParquetColumn::Integers(vec![0, 1, 2])),
            ("a", doubles(&angles)),
        ],
    );
    let table = csv(&folder, &setup("starts.parquet"));
    fs::write(
        folder.join("starts.csv"),
        format!("a,pa\n{},0\n{},1\n{},2\n", angles[0], angles[1], angles[2]),
    )
    .expect("a file");
    assert_eq!(table, csv(&folder, &setup("starts.csv")));

    let texts = |values: &[Option<&str>]| {
        ParquetColumn::Texts(values.iter().map(|text| text.map(str::to_owned)).collect())
    };
    let a = || ("a", doubles(&[0.5]));
    write("nan.parquet", &[a(), ("pa", doubles(&[f64::NAN]))]);
    write("missing.parquet", &[a()]);
    write("other.parquet", &[a(), ("b", doubles(&[0.5]))]);
    write("text.parquet", &[a(), ("pa", texts(&[Some("half")]))]);
    write("null.parquet", &[a(), ("pa", texts(&[None]))]);
    write(
        "large.parquet",
        &[a(), ("pa", ParquetColumn::Integers(vec![(1 << 53) + 1]))],
    );
    fs::write(folder.join("no.parquet"), "PAR1").expect("a file");
    for (name, message) in [
        (
            "nan",
            "start 0, column `pa`: expected a finite number, found `NaN`",
        ),
        ("missing", "the column `pa` is missing"),
        ("other", "the column `b` is not a coordinate"),
        (
            "text",
            "start 0, column `pa`: expected a finite number, found `\"half\"`",
        ),
        (
            "null",
            "start 0, column `pa`: expected a finite number, found `null`",
        ),
        ("large", "found `9007199254740993`"),
        ("no", "no.parquet: "),
        ("absent", "absent.parquet: "),
    ] {
        let output = call(&folder, &setup(&format!("{name}.parquet")), &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(
            output.status.code() == Some(2) && error.contains(message),
            "{name}: {error}"
        );
    }
    // The first page begins at 4, written as 8; 1 is −1.
    let whole = fs::read(folder.join("starts.parquet")).expect("a file");
    let eights = (whole.len() / 2..whole.len()).filter(|&k| whole[k] == 8);
    let damaged = eights.filter(|&k| {
        let mut file = whole.clone();
        file[k] = 1;
        fs::write(folder.join("damaged.parquet"), file).expect("a file");
        let output = call(&folder, &setup("damaged.parquet"), &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        let code = output.status.code();
        assert!(code.is_some_and(|code| code <= 2), "{error}");
        error.contains("the file is damaged")
    });
    assert!(damaged.count() > 0);
}
