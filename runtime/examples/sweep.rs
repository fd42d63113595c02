//! Which of the tableaux in a folder needs the fewest evaluations: `cargo run --release -p symplectic --example sweep -- tableaux`
//!
//! The files are those that `symplectic show NAME --format toml` and `symplectic derive … --format toml` write. Each is read when the
//! program runs; no macro has seen it.

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, f64, fs};

use symplectic::at_run_time::{RunTimeCoefficients, RunTimeTableau};
use symplectic::{Integrator, Orders, State};

/// The error that is asked for, at the end of three orbits.
const TARGET: f64 = 1e-8;

/// A list of decimals, each as the nearest double.
fn list(values: &toml::Value) -> Option<Vec<f64>> {
    let number = |value: &toml::Value| value.as_str()?.parse().ok();
    values.as_array()?.iter().map(number).collect()
}

/// A matrix by rows.
fn matrix(rows: &toml::Value) -> Option<Vec<Vec<f64>>> {
    rows.as_array()?.iter().map(list).collect()
}

/// Coefficients and orders of a file; nothing where its matrices are left out, as of splittings with more than 36 stages.
fn read(text: &str) -> Result<Option<(RunTimeCoefficients, Orders)>, toml::de::Error> {
    let file: toml::Table = toml::from_str(text)?;
    let part = |table: &str, key: &str| file.get(table)?.get(key);
    let order = |class: &str| {
        let order = part("order", class)?.get("order")?.as_integer()?;
        u32::try_from(order).ok()
    };
    let decimals = |key| part("decimals", key);
    let found = || {
        let coefficients = RunTimeCoefficients {
            a: matrix(decimals("a")?)?,
            a_tilde: matrix(decimals("a_tilde")?)?,
            b: list(decimals("b")?)?,
            b_tilde: list(decimals("b_tilde")?)?,
            c: list(decimals("c")?)?,
            c_tilde: list(decimals("c_tilde")?)?,
            // Refused if it is not empty.
            gradient: decimals("gradient").and_then(list).unwrap_or_default(),
        };
        let orders = Orders {
            general: order("general")?,
            separable: order("separable")?,
            nystrom: order("nystrom")?,
        };
        Some((coefficients, orders))
    };
    Ok(found())
}

symplectic::hamiltonian! { Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q| }

/// Evaluations for an error below the target on an orbit of eccentricity 0.6, with shorter and shorter steps until it is reached; nothing
/// where it is not.
fn evaluations(tableau: &RunTimeTableau) -> Option<u64> {
    let start = State::from_arrays(0.0, [0.4_f64, 0.0], [0.0, 2.0]);
    let end = 3.0 * f64::consts::TAU;
    let mut size = 0.25;
    while size > 1e-4 {
        size /= 1.25;
        let mut integrator =
            Integrator::plain(tableau.clone(), Kepler, start.clone(), size).ok()?;
        // Long steps may not converge.
        let Ok(last) = integrator.integrate_to(end) else {
            continue;
        };
        let error = (last.q - start.q).norm().max((last.p - start.p).norm());
        if error < TARGET {
            return Some(integrator.statistics().evaluations);
        }
    }
    None
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = env::args().nth(1).map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../tableaux"),
        PathBuf::from,
    );
    let mut found = Vec::new();
    let (mut left_out, mut missed) = (0, 0);
    for file in fs::read_dir(folder)? {
        let path = file?.path();
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let Some((coefficients, orders)) = read(&fs::read_to_string(&path)?)? else {
            left_out += 1;
            continue;
        };
        match RunTimeTableau::new(&name, &coefficients, orders) {
            Ok(tableau) => match evaluations(&tableau) {
                Some(count) => found.push((count, tableau)),
                None => missed += 1,
            },
            Err(error) => println!("{name}: {error}"),
        }
    }
    found.sort_by_key(|(count, _)| *count);
    let read = found.len() + missed;
    println!("{read} tableaux, {left_out} without matrices; {missed} do not reach {TARGET:e}.");
    println!("The first ten:");
    for (count, tableau) in found.iter().take(10) {
        let form = match tableau.is_explicit() {
            true => "explicit",
            false => "implicit",
        };
        let (name, order) = (tableau.name(), tableau.orders().nystrom);
        println!("{count:8} evaluations  {name}, {form}, order {order}");
    }
    Ok(())
}
