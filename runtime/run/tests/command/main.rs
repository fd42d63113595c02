//! What the command does and refuses: trajectories beside those of the macros, starts, numbers, parameters, files, and what is refused.

mod chaos;
mod constraints;
mod derived;
mod files;
mod forces;
mod friction;
mod kept;
mod names;
mod newton;
mod numbers;
mod parameters;
mod refused;
mod resume;
mod section;
mod starts;
mod summary;
mod systems;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

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
    Command::new(env!("CARGO_BIN_EXE_symplectic-run"))
        .arg(file)
        .args(options)
        .output()
        .expect("the binary runs")
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

/// Three trajectories with states at times; the last one escapes to infinity.
const CUBIC: &str = r#"
    system = "Cubic q: [x], p: [px]; H = px^2/2 + x^2/2 - x^3/3"
    method = "forest-ruth-1990"
    step_size = 0.1
    times = { from = 0, to = 20, count = 5 }
    starts = { x = { values = [0.1, 0.5, 1.5] }, px = 0.0 }
    output.file = "out.csv"
"#;

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
