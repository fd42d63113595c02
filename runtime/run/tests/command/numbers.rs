//! The numbers of ranges, and numbers that are refused.

use std::fs;

use crate::{CLOUD, PENDULUM, call, columns, csv, folder};

/// `from + (to − from) k / n` is exact if the products are; `from (1 − k/n) + to k/n` gave 7.000000000000001.
#[test]
fn a_range_of_whole_numbers_has_whole_numbers() {
    let folder = folder("whole");
    let setup = PENDULUM
        .replace("end = 10.0", "times = { from = 0, to = 100, count = 101 }")
        .replace("count = 11", "count = 1");
    let times = columns(&csv(&folder, &setup), &["time"]);
    let expected: Vec<Vec<f64>> = (0..=100).map(|k| vec![f64::from(k)]).collect();
    assert_eq!(times, expected);
    // The last number is that of the file; where the difference overflows, the numbers are still finite.
    for [from, to] in [[0.1, 0.1], [0.3, 0.7], [-1.7e308, 1.7e308]] {
        let range = format!("from = {from:e}, to = {to:e}, count = 51");
        let setup = PENDULUM
            .replace("end = 10.0", "end = 0.0")
            .replace("from = -1, to = 1, count = 11", &range);
        let found = columns(&csv(&folder, &setup), &["a_start"]).concat();
        assert_eq!((found.len(), found[0], found[50]), (51, from, to));
        assert!(found.is_sorted() && found.iter().all(|x| x.is_finite()));
        assert!(from != to || found.iter().all(|&x| x == from), "{found:?}");
    }
}

/// Digits are the shortest.
#[test]
fn small_and_large_numbers_have_exponents() {
    let folder = folder("exponents");
    let values = "1e-300, -9.9e-6, 1e-5, 0.1, -0.0, 123456789, 1e15, 1e16, -1.7e308";
    let setup = PENDULUM.replace("end = 10.0", "end = 0.0").replace(
        "from = -1, to = 1, count = 11",
        &format!("values = [{values}]"),
    );
    let text = csv(&folder, &setup);
    let cells = text.lines().skip(1).map(|line| line.split(',').nth(1));
    let cells: Vec<&str> = cells.map(|cell| cell.expect("a cell")).collect();
    let expected = "1e-300,-9.9e-6,0.00001,0.1,-0,123456789,1000000000000000,1e16,-1.7e308";
    assert_eq!(cells.join(","), expected);
}

#[test]
fn wrong_numbers_are_named_at_their_place() {
    let folder = folder("numbers");
    let range = "{ from = -1, to = 1, count = 11 }";
    let (pendulum, cloud) = (PENDULUM, CLOUD);
    for (setup, from, to, place, message) in [
        (
            pendulum,
            "pa = 0.5",
            "pa = nan",
            "9:",
            "`pa` has a value that is not finite: NaN",
        ),
        (
            pendulum,
            range,
            "{ values = [0, -inf] }",
            "8:",
            "`a` has a value that is not finite: -inf",
        ),
        (
            cloud,
            "[-1, 3]",
            "[-1.7e308, 1.7e308]",
            "8:",
            "`x`: the bounds -1.7e308 and 1.7e308 are too far apart",
        ),
        (
            cloud,
            "[-1, 3]",
            "[3, -1]",
            "8:",
            "`x`: the lower bound 3.0 is above the upper bound -1.0",
        ),
        (
            cloud,
            "[2, 0.5]",
            "[2, -0.5]",
            "9:",
            "`px`: the standard deviation is -0.5",
        ),
        (
            cloud,
            "[2, 0.5]",
            "[0, 1e308]",
            "9:",
            "`px`: the standard deviation 1e308 is too large",
        ),
        (
            pendulum,
            "parameters.g = 4",
            "parameters.g = { uniform = [2, 1] }",
            "6:",
            "`g`: the lower bound 2.0 is above the upper bound 1.0",
        ),
        (
            pendulum,
            "count = 11",
            "count = 0",
            "8:",
            "`a`: the count is 0: it must be from 1 to 4194304",
        ),
        (
            pendulum,
            "count = 11",
            "count = -3",
            "8:",
            "`a`: the count is -3: it must be",
        ),
        (
            pendulum,
            range,
            "{ values = [] }",
            "8:",
            "`a`: the list of values is empty",
        ),
        (
            pendulum,
            "end = 10.0",
            "times = { from = 0, to = 1, count = 0 }",
            "5:",
            "the count is 0: it must be",
        ),
        (
            pendulum,
            "end = 10.0",
            "times = { from = 0, to = 1, count = -3 }",
            "5:",
            "the count is -3: it must be",
        ),
        (
            pendulum,
            "end = 10.0",
            "times = []",
            "5:",
            "`times` is empty: give at least one time",
        ),
        (
            pendulum,
            "end = 10.0",
            "times = [0, 2, 1e-300]",
            "5:",
            "`times` goes back from 2.0 to 1e-300",
        ),
        (
            pendulum,
            "end = 10.0",
            "start_time = nan\n    end = 10.0",
            "5:",
            "`start_time` is NaN: it must be finite",
        ),
        (
            pendulum,
            "0.05",
            "1e-300",
            "5:",
            "from 0.0 to 10.0 there are more than 2^53 steps of 1e-300",
        ),
    ] {
        assert!(setup.contains(from), "{from}");
        let output = call(&folder, &setup.replacen(from, to, 1), &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}: {error}");
        assert!(
            error.contains(message) && error.contains(&format!("setup.toml:{place}")),
            "{place} {message}: {error}"
        );
    }
}

/// The advice of the error helps.
#[test]
fn more_stages_can_be_allowed() {
    let folder = folder("stages");
    let method = "{ basis = \"polynomial(37)\", nodes = \"gauss(37)\" }";
    let setup = PENDULUM.replace("\"blanes-moan-2002-s10\"", method);
    let setup = setup.replace("end = 10.0", "end = 0.1");
    let output = call(&folder, &setup, &[]);
    let error = String::from_utf8_lossy(&output.stderr);
    let advice = "raise it with `--max-stages 37`";
    assert!(output.status.code() == Some(2) && error.contains(advice));
    let output = call(&folder, &setup, &["--max-stages", "37"]);
    assert!(output.status.success(), "{output:?}");
}

#[cfg(unix)]
#[test]
fn starts_that_have_no_end_are_refused() {
    let setup = &PENDULUM[..PENDULUM.find("[starts]").expect("a table")];
    let folder = folder("device");
    let large = fs::File::create(folder.join("large.csv")).expect("a file");
    large.set_len((1 << 31) + 1).expect("a sparse file");
    for (name, told) in [
        ("/dev/null", "/dev/null: not a file on a disk"),
        ("large.csv", "longer than 2147483648 bytes"),
    ] {
        let setup = format!("starts = '{name}'\noutput.file = 'out.csv'\n{setup}");
        let output = call(&folder, &setup, &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(
            output.status.code() == Some(2) && error.contains(told),
            "{error}"
        );
    }
}
