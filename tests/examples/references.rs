//! The references of the scenes: recomputed, and written to `tests/data/references.toml` or compared with it.
//!
//! `cargo run --release -p symplectic-tests --example references` writes, `-- --check` compares; with the name of a scene behind that, only that
//! one. All of them took half an hour of time of one processor, on a machine with much other work.

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Instant;

use symplectic_tests::references::{ALL, Collocation, Record, Records};

/// Stages of the Gauss method: the order 32.
const STAGES: usize = 16;

/// Digits of its coefficients.
const DIGITS: usize = 70;

const HEADER: &str = "\
# Reference end states of the scenes, written by `cargo run --release -p symplectic-tests --example references`: by a Gauss method over numbers
# of 237 bits, in two runs of different step sizes. `agreement` is the larger relative distance of their q and their p, and
# the digits are those of the finer one.
";

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1).peekable();
    let check = arguments
        .next_if(|argument| argument == "--check")
        .is_some();
    let name = arguments.next().unwrap_or_default();
    let method = gauss(STAGES)?;
    let chosen: Vec<_> = ALL.iter().filter(|run| run.scene.contains(&name)).collect();
    // One thread a processor, each of which takes the next run and records it as soon as it is there.
    let next = AtomicUsize::new(0);
    let known = Mutex::new(read()?);
    let work = || -> Result<(), String> {
        while let Some(run) = chosen.get(next.fetch_add(1, Ordering::Relaxed)) {
            let begin = Instant::now();
            let record = run.run(&method).map_err(|error| error.to_string())?;
            println!(
                "{:24} {:20} t = {:<8} agreement {}, {:?} steps, {:.1} s",
                run.scene,
                run.parameters,
                run.time,
                record.agreement,
                record.steps,
                begin.elapsed().as_secs_f64()
            );
            let mut known = known.lock().map_err(|error| error.to_string())?;
            if !check {
                known.retain(|other| !run.is_of(other));
                known.push(record);
                write(&mut known).map_err(|error| error.to_string())?;
            } else if !known.contains(&record) {
                return Err(format!(
                    "{} {} is not as recorded",
                    run.scene, run.parameters
                ));
            }
        }
        Ok(())
    };
    thread::scope(|scope| {
        let processors = thread::available_parallelism().map_or(1, usize::from);
        let threads: Vec<_> = (0..processors).map(|_| scope.spawn(work)).collect();
        let mut results = threads.into_iter().map(|thread| thread.join());
        results.try_for_each(|result| result.map_err(|_| "a run panicked".to_owned())?)
    })?;
    Ok(())
}

/// Reads the file.
fn read() -> Result<Vec<Record>, Box<dyn Error>> {
    let records: Records = toml::from_str(&std::fs::read_to_string(file())?)?;
    Ok(records.reference)
}

fn file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data/references.toml")
}

/// Writes the file, in the order of [`ALL`].
fn write(records: &mut Vec<Record>) -> Result<(), Box<dyn Error>> {
    records.retain(|record| ALL.iter().any(|run| run.is_of(record)));
    records.sort_by_key(|record| ALL.iter().position(|run| run.is_of(record)));
    let text = toml::to_string(&Records {
        reference: records.clone(),
    })?;
    std::fs::write(file(), format!("{HEADER}\n{text}"))?;
    Ok(())
}

/// The Gauss method, from the exact engine.
fn gauss(stages: usize) -> Result<Collocation, Box<dyn Error>> {
    let tableau = symplectic_compiler::derive(
        &format!("polynomial({stages})"),
        &format!("gauss({stages})"),
    )?;
    let decimals = tableau
        .numbers()
        .map(|number| number.decimal(DIGITS).to_string());
    Collocation::from_decimals(&decimals.a, &decimals.b).ok_or_else(|| "not a decimal".into())
}
