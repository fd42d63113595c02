//! Files of results, and their parts.

use std::fs;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use crate::{CLOUD, CUBIC, PENDULUM, array, call, columns, csv, doubles, folder};

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

/// The examples of the book that are complete files.
#[test]
fn the_examples_of_the_book_run() {
    let page = include_str!("../../../../docs/src/guide/run.md");
    let blocks = page.split("```toml\n").skip(1);
    let blocks = blocks.filter_map(|rest| rest.split("```").next());
    let folder = folder("book");
    let mut count = 0;
    for setup in blocks.filter(|block| block.contains("system =")) {
        let output = call(&folder, setup, &[]);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && errors.is_empty(), "{errors}");
        count += 1;
    }
    assert_eq!(count, 3);
    let text = fs::read_to_string(folder.join("double-pendulum.csv")).expect("the output");
    for row in columns(&text, &["constraint_error", "energy_error"]) {
        assert!(row[0] < 1e-14 && row[1].abs() < 1e-3, "{row:?}");
    }
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
    // Two trajectories at five times; of the third what it reached, and its end.
    assert!(lines_in_both("parquet", CUBIC, "forest-ruth-1990") > 11);
    // Between steps there are no multipliers.
    let rod = r#"
        system = "Rod q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + y constraints: { rod = x^2 + y^2 - 1 }"
        method = "lobatto-2"
        step_size = 0.1
        times = [0, 0.05, 0.1]
        starts = { x = 0.6, y = -0.8, px = 0, py = 0 }
        output.file = "out.csv"
    "#;
    assert_eq!(lines_in_both("parquet-rod", rod, "lobatto-2"), 3);
}

/// Compares a table as Parquet with that as CSV, and returns the number of its lines.
fn lines_in_both(name: &str, setup: &str, expected: &str) -> usize {
    let folder = folder(name);
    let table = csv(&folder, setup);
    call(&folder, &setup.replace("out.csv", "out.parquet"), &[]);
    let file = fs::File::open(folder.join("out.parquet")).expect("the output");
    let reader = SerializedFileReader::new(file).expect("a table");
    let about = reader.metadata().file_metadata();
    let notes = about.key_value_metadata().expect("notes");
    let method = notes.iter().find(|note| note.key == "method");
    let method = method.and_then(|note| note.value.as_deref());
    assert_eq!(method, Some(expected));
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
    assert_eq!(count, lines.len());
    count
}

/// Neither the message nor a file of results advises a call: they name the keys.
#[test]
fn an_iteration_that_diverges_has_advice_for_files() {
    let folder = folder("diverges");
    let setup = "system = \"Osc q: [x], p: [px]; H = px^2/2 + 1e6 x^2/2\"\nmethod = \"gauss-2\"\nstep_size = 0.1\nend = 10\n\
                 starts = { x = 1, px = 0 }\n";
    for name in ["t.csv", "t.npz"] {
        let output = call(&folder, &format!("{setup}output.file = \"{name}\"\n"), &[]);
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(said.contains("did not converge"), "{said}");
        assert!(
            said.contains("; take a smaller step (the key `step_size`), or `solver = \"newton\"` for a stiff system"),
            "{said}"
        );
        let file = fs::read(folder.join(name)).expect("the results");
        let file = String::from_utf8_lossy(&file);
        assert!(
            file.contains("did not converge") || name == "t.npz",
            "{file}"
        );
        for text in [&said, &file] {
            assert!(!text.contains("by_newton"), "{text}");
        }
    }
}
