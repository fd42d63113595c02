//! What a use of `tableau!` or `hamiltonian!` adds to the build of a crate outside this workspace, without any profile of its own.
//!
//! `cargo run --release -p symplectic-tests --example macro_cost`; needs cargo. The median of some builds after a change of the source, less
//! that of an empty program.
#![allow(clippy::print_stdout, reason = "the table is what this program is for")]

use std::io::{Error, Result};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};
use std::{env, fs};

const DEFINITIONS: [&str; 7] = [
    "basis: polynomial(8), nodes: gauss(8)",
    "basis: polynomial(8), nodes: lobatto(8)",
    "basis: polynomial(8), nodes: radau-right(8)",
    "basis: polynomial(8), nodes: clenshaw-curtis(8)",
    "basis: legendre(4), quadrature: gauss(8)",
    "basis: [1, t, cos(pi*t), sin(pi*t), cos(2*pi*t), sin(2*pi*t), cos(3*pi*t), sin(3*pi*t)], nodes: gauss(8)",
    "basis: [1, t, t^2, exp(t), exp(2*t), exp(3*t), exp(-t), exp(-2*t)], nodes: gauss(8)",
];

/// A module of formulas.
const FORMULAS: &str = include_str!("../src/formulas/mod.rs");

const REPETITIONS: usize = 7;

fn main() -> Result<()> {
    let program = Program::new(env::temp_dir().join("symplectic-macro-cost"))?;
    println!("| added by | debug | release |\n|---|---:|---:|");
    let profiles: [&[&str]; 2] = [&[], &["--release"]];
    let empty = profiles.map(|profile| program.build("", profile));
    let [debug, release] = empty;
    let empty = [debug?, release?];
    let tableaux = DEFINITIONS.map(|definition| {
        let code = format!("symplectic::tableau! {{ Method {{ {definition} }} }}");
        (format!("`{definition}`"), code, 1)
    });
    let count = FORMULAS.matches("hamiltonian! {").count() as u32;
    let formulas = (
        format!("each of {count} formulas"),
        "#[allow(dead_code)]\npub mod formulas;".to_owned(),
        count,
    );
    for (name, code, count) in tableaux.into_iter().chain([formulas]) {
        print!("| {name} |");
        for (profile, empty) in profiles.iter().zip(empty) {
            let added = program.build(&code, profile)?.saturating_sub(empty) / count;
            print!(" {:.2} s |", added.as_secs_f64());
        }
        println!();
    }
    Ok(())
}

/// A crate that depends on the runtime by its path.
struct Program(PathBuf);

impl Program {
    fn new(directory: PathBuf) -> Result<Self> {
        let runtime = Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime");
        fs::create_dir_all(directory.join("src"))?;
        let manifest = format!(
            "[package]\nname = \"macro-cost\"\nedition = \"2024\"\n[workspace]\n[dependencies]\nsymplectic.path = {:?}\n",
            runtime.canonicalize()?
        );
        fs::write(directory.join("Cargo.toml"), manifest)?;
        fs::write(directory.join("src/formulas.rs"), FORMULAS)?;
        // The versions that this workspace is built with.
        fs::copy(
            Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.lock"),
            directory.join("Cargo.lock"),
        )?;
        Ok(Program(directory))
    }

    /// The median time of a build of this code when everything else is built.
    fn build(&self, code: &str, profile: &[&str]) -> Result<Duration> {
        let once = |number: usize| {
            let source = format!("// {number}\n{code}\nfn main() {{}}\n");
            fs::write(self.0.join("src/main.rs"), source)?;
            let start = Instant::now();
            let status = Command::new("cargo")
                .args(["build", "--quiet"])
                .args(profile)
                .current_dir(&self.0)
                .env_remove("CARGO_TARGET_DIR")
                .status()?;
            if status.success() {
                Ok(start.elapsed())
            } else {
                Err(Error::other(format!("cargo build: {status}")))
            }
        };
        once(0)?;
        let times = (1..=REPETITIONS).map(once);
        let mut times = times.collect::<Result<Vec<_>>>()?;
        times.sort();
        Ok(times[REPETITIONS / 2])
    }
}
