//! The references of the scenes: recomputed, and written to `tests/data/references.toml` or compared with it.
//!
//! `cargo run --release --example references` writes, `-- --check` compares, `-- --check NAME` only the scenes whose name
//! contains this. TIMING

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Instant;

use symplectic_tests::references::{ALL, Collocation, Record, Records, records};

/// Stages of the Gauss method: the order 32.
const STAGES: usize = 16;

/// Digits of its coefficients.
const DIGITS: usize = 70;

const HEADER: &str = "\
# Reference end states of the scenes, written by `cargo run --release --example references`: by a Gauss method over numbers
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
    // One thread a processor, each of which takes the next run.
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(run) = chosen.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let begin = Instant::now();
                    let record = run.run(&method);
                    if let Ok(record) = &record {
                        println!(
                            "{:24} {:20} t = {:<8} agreement {:.1e}, {:?} steps, {:.1} s",
                            run.scene,
                            run.parameters,
                            run.time,
                            record.agreement,
                            record.steps,
                            begin.elapsed().as_secs_f64()
                        );
                    }
                    let place = ALL.iter().position(|other| std::ptr::eq(other, *run));
                    if let Ok(mut done) = done.lock() {
                        done.push((place, record));
                    }
                }
            });
        }
    });
    let mut done = done.into_inner()?;
    done.sort_by_key(|(place, _)| *place);
    let found: Vec<Record> = done
        .into_iter()
        .map(|(_, record)| record)
        .collect::<Result<_, _>>()?;
    if check {
        let known = records();
        for record in &found {
            if !known.contains(record) {
                return Err(
                    format!("{} {} is not as recorded", record.scene, record.parameters).into(),
                );
            }
        }
        println!("{} references are as recorded", found.len());
        return Ok(());
    }
    if !name.is_empty() {
        return Ok(());
    }
    let text = toml::to_string(&Records { reference: found })?;
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/references.toml");
    std::fs::write(path, format!("{HEADER}\n{text}"))?;
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
