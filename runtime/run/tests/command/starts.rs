//! Grids, random starts, and starts in a table.

use std::fs;

use ::symplectic::ensemble::{Parquet, ParquetColumn};

use crate::{CLOUD, PENDULUM, call, columns, csv, folder};

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
        ("other", "the column `b` is neither a coordinate nor"),
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

/// A run of one trajectory, whose steps are shown, has the row of an ensemble.
#[test]
fn a_single_trajectory_is_that_of_an_ensemble() {
    let folder = folder("single");
    let range = "{ from = -1, to = 1, count = 11 }";
    for end in ["end = 10.0", "times = [1.01, 10]"] {
        let setup = PENDULUM.replace("end = 10.0", end);
        let first = |starts: &str, rows: usize| -> Vec<String> {
            let text = csv(&folder, &setup.replace(range, starts));
            text.lines().take(1 + rows).map(str::to_owned).collect()
        };
        let rows = end.matches(',').count() + 1;
        assert_eq!(first("{ values = [0.3, 1] }", rows), first("0.3", rows));
    }
}
