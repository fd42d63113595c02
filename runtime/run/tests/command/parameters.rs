//! Parameters that differ between trajectories.

use std::fs;

use crate::{CLOUD, PENDULUM, array, call, columns, csv, doubles, folder};

/// The lines of a table without its header, the number of the trajectory, and the column of the parameter, which comes after the starts.
fn lines(table: &str, with_parameter: bool) -> Vec<String> {
    let line = |line: &str| {
        let mut cells: Vec<&str> = line.split(',').collect();
        if with_parameter {
            cells.remove(3);
        }
        cells[1..].join(",")
    };
    table.lines().skip(1).map(line).collect()
}

/// Every trajectory is that of a run in which all have its parameter, to the bit: ends, energies, numbers of steps.
#[test]
fn trajectories_on_a_grid_of_a_parameter_have_the_bits_of_single_runs() {
    let folder = folder("parameters");
    for method in ["blanes-moan-2002-s10", "gauss-4"] {
        for sums in ["plain", "compensated"] {
            let setup = PENDULUM
                .replace("blanes-moan-2002-s10", method)
                .replace("end = 10.0", &format!("end = 10.0\n    sums = '{sums}'"))
                .replace("count = 11", "count = 3");
            let values = [4.0, 5.5, 7.0, 8.5, 10.0];
            let mut expected = Vec::new();
            for g in values {
                let own = setup.replace("parameters.g = 4", &format!("parameters.g = {g}"));
                expected.extend(lines(&csv(&folder, &own), false));
            }
            let range = "parameters.g = { from = 4, to = 10, count = 5 }";
            let table = csv(&folder, &setup.replace("parameters.g = 4", range));
            assert_eq!(lines(&table, true), expected, "{method}, {sums}");
            let found = columns(&table, &["trajectory", "g"]);
            let numbered = (0..15).map(|k| vec![f64::from(k), values[k as usize / 3]]);
            assert!(found.into_iter().eq(numbered));
        }
    }
}

/// The frequency of each oscillator is its own, whether it is an entry of an array or a column of a table.
#[test]
fn parameters_are_read_from_arrays_and_columns() {
    let folder = folder("parameters-columns");
    let setup = r#"
        system = "Oscillators { k: [..] } q: [..], p: [..]; H = sum(i: p[i]^2/2 + k[i] q[i]^2/2)"
        method = "blanes-moan-2002-s10"
        step_size = 0.01
        end = 1.0
        parameters.k = [1, { values = [4, 9] }]
        starts = { q = [1, 1], p = [0, 0] }
        output.file = "out.csv"
    "#;
    let found = columns(&csv(&folder, setup), &["k[1]", "q[0]", "q[1]"]);
    assert_eq!(found.len(), 2);
    for (row, frequency) in found.iter().zip([2.0_f64, 3.0]) {
        assert_eq!(row[0], frequency * frequency);
        // The error of the method in 100 steps.
        assert!((row[1] - 1.0_f64.cos()).abs() < 1e-10, "{row:?}");
        assert!((row[2] - frequency.cos()).abs() < 1e-8, "{row:?}");
    }

    let setup = r#"
        system = "Oscillator { k } q: [x], p: [px]; H = px^2/2 + k x^2/2"
        method = "gauss-4"
        step_size = 0.01
        end = 1.0
        starts = "starts.csv"
        output.file = "out.npz"
    "#;
    fs::write(folder.join("starts.csv"), "k,x,px\n4,1,0\n9,1,0\n1,1,0\n").expect("a file");
    let output = call(&folder, setup, &[]);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && errors.is_empty(), "{errors}");
    let file = fs::read(folder.join("out.npz")).expect("the output");
    let (header, bytes) = array(&file, "parameters");
    assert!(header.contains("(3, 1, )"), "{header}");
    assert_eq!(doubles(&bytes), [4.0, 9.0, 1.0]);
    let ends = doubles(&array(&file, "q").1);
    for (end, frequency) in ends.iter().zip([2.0_f64, 3.0, 1.0]) {
        assert!((end - frequency.cos()).abs() < 1e-11, "{end} {frequency}");
    }
    // Energies of a system with the parameter of another trajectory would not be conserved.
    let errors = doubles(&array(&file, "energy_error").1);
    assert!(errors.iter().all(|error| error.abs() < 1e-13), "{errors:?}");
}

#[test]
fn random_parameters_are_the_same_in_parts() {
    let folder = folder("parameters-random");
    let setup = PENDULUM
        .replace(
            "parameters.g = 4",
            "parameters.g = { uniform = [4, 5] }\n    random = { seed = 3, count = 20 }",
        )
        .replace("end = 10.0", "end = 1.0")
        .replace("count = 11", "count = 2");
    let whole = csv(&folder, &setup);
    let found = columns(&whole, &["g"]);
    assert!(found.len() == 40 && found.iter().all(|row| (4.0..=5.0).contains(&row[0])));
    assert!(found.windows(2).all(|pair| pair[0] != pair[1]));
    let output = call(&folder, &setup, &["--shard", "1/3"]);
    assert!(output.status.success());
    let part = fs::read_to_string(folder.join("out.1-of-3.csv")).expect("a part");
    let own: Vec<&str> = whole.lines().skip(1 + 13).take(13).collect();
    assert_eq!(part.lines().skip(1).collect::<Vec<_>>(), own);
}

#[test]
fn random_coordinates_do_not_depend_on_a_random_parameter() {
    let folder = folder("parameters-beside");
    let spring = CLOUD
        .replace("x^2/2\"", "k x^2/2\"\n    parameters.k = 1")
        .replace("Oscillator q", "Oscillator { k: 1 } q")
        .replace("4000", "20");
    let starts = |setup: &str| columns(&csv(&folder, setup), &["x_start", "px_start"]);
    let fixed = starts(&spring);
    assert_eq!(fixed.len(), 20);
    let varied = spring.replace("parameters.k = 1", "parameters.k = { uniform = [1, 2] }");
    assert_eq!(starts(&varied), fixed);
}

#[test]
fn wrong_parameters_are_refused_at_their_place() {
    let folder = folder("parameters-wrong");
    fs::write(folder.join("starts.csv"), "a,pa,g\n0,1,4\n").expect("a file");
    let of_file = |parameter: &str| {
        let setup = PENDULUM.split("[starts]").next().expect("a setup");
        let setup = setup.replace("parameters.g = 4", parameter);
        format!("{setup}\n    starts = 'starts.csv'\n    output.file = 'out.csv'")
    };
    let cases = [
        (
            PENDULUM.replace("g = 4", "g = { from = 1, to = 2 }"),
            "6:",
            "`g`: the key `count` is missing: expected a number, { from, to, count }",
        ),
        (
            PENDULUM.replace("g = 4", "g = { uniform = [1, 2] }"),
            "7:",
            "`random = { seed = 1, count = 1000 }`",
        ),
        (of_file("parameters.g = 4"), "6:", "`g` is also a column"),
        (
            of_file("parameters.g = { values = [1, 2] }"),
            "6:",
            "write its values into a column of that file",
        ),
        (
            of_file("parameters.g = [4, { from = 1, to = 2, count = 2 }]")
                .replace("{ g: 9.81 }", "{ g: [2] }")
                .replace("g cos", "g[1] cos"),
            "6:",
            "`g[1]` varies, but the starts are in a file, whose columns are coordinates and parameters that are numbers",
        ),
    ];
    for (setup, place, message) in cases {
        let output = call(&folder, &setup, &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}: {error}");
        assert!(
            error.contains(message) && error.contains(&format!("setup.toml:{place}")),
            "{place} {message}: {error}"
        );
    }
}
