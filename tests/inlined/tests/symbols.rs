//! In wide registers everything is inlined: an operation that is not is a call, and a step takes up to 50 times as long.
//!
//! This is seen in optimised programs only: `.ci/run` has the command.

#![cfg(all(not(debug_assertions), target_arch = "x86_64", target_os = "linux"))]

use std::error::Error;

use object::{Object, ObjectSymbol};

/// The operations of AVX2 and AVX-512 that are functions of a program.
fn operations(program: &str) -> Result<Vec<String>, Box<dyn Error>> {
    let data = std::fs::read(program)?;
    let file = object::File::parse(&*data)?;
    let names = file
        .symbols()
        .filter_map(|symbol| symbol.name().ok().map(str::to_owned));
    let is_operation = |name: &String| name.contains("_mm256_") || name.contains("_mm512_");
    Ok(names.filter(is_operation).collect())
}

#[test]
fn operations_in_wide_registers_are_inlined() -> Result<(), Box<dyn Error>> {
    assert_eq!(
        operations(env!("CARGO_BIN_EXE_formulas"))?,
        Vec::<String>::new()
    );
    // The same search finds those that are.
    let found = operations(env!("CARGO_BIN_EXE_broken_promise"))?;
    assert!(found.iter().any(|name| name.contains("_mm256_mul_pd")));
    Ok(())
}

#[test]
fn the_programs_run() -> Result<(), Box<dyn Error>> {
    for program in [
        env!("CARGO_BIN_EXE_formulas"),
        env!("CARGO_BIN_EXE_broken_promise"),
    ] {
        assert!(std::process::Command::new(program).status()?.success());
    }
    Ok(())
}
