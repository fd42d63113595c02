//! How the time of a derivation grows with the number of stages, and what it is in the other tiers.
//!
//! `cargo run --release --example cost`; other numbers of stages as arguments. One thread; the median of
//! several runs.
#![allow(clippy::print_stdout, reason = "the table is what this program is for")]

use std::time::{Duration, Instant};

use symplectic_compiler::export::DEFAULT_DIGITS;
use symplectic_compiler::{Definition, Error, Limits};

/// The derivation with all properties, exact forms, digits, doubles and singles; with the proofs of order and
/// stability if they are asked for.
fn compile(definition: &str, stages: usize, digits: usize, facts: bool) -> Result<Duration, Error> {
    let start = Instant::now();
    let tableau = Definition::parse(definition)?.derive(&Limits { stages })?;
    let properties = tableau.properties();
    let forms = tableau.exact_forms();
    let numbers = tableau.numbers().map(|number| {
        (
            number.decimal(digits).to_string(),
            number.to_f64(),
            number.to_f32(),
        )
    });
    if facts {
        let order = tableau.orders();
        let stability = tableau.stability();
        assert!(order.general.order > 0 && !stability.intervals.is_empty());
    }
    let time = start.elapsed();
    assert!(properties.all().len() > 1 && forms.iter().count() == numbers.iter().count());
    Ok(time)
}

/// Milliseconds.
fn median(definition: &str, stages: usize, digits: usize, facts: bool) -> Result<f64, Error> {
    let runs = if stages > 16 { 3 } else { 9 };
    let mut times = (0..runs)
        .map(|_| compile(definition, stages, digits, facts))
        .collect::<Result<Vec<_>, _>>()?;
    times.sort();
    Ok(times[runs / 2].as_secs_f64() * 1e3)
}

/// Definitions beyond polynomials at classical nodes, with their digits.
const OTHERS: [(&str, usize); 12] = [
    ("basis: [1], nodes: [0]", 40),
    ("basis: [1, cos(pi*t)], nodes: [0, 1]", 40),
    ("basis: [1, cos(pi*t), sin(pi*t)], nodes: [0, 1/2, 1]", 40),
    ("basis: polynomial(3), nodes: chebyshev(3)", 40),
    ("basis: polynomial(2), nodes: [1/2 - sqrt(2)/4, 3/4]", 40),
    ("basis: [1, cos(t), sin(t)], nodes: [0, 1/2, 1]", 40),
    ("basis: [1, exp(t), exp(-t)], nodes: [0, 1/2, 1]", 40),
    ("basis: legendre(3), quadrature: gauss(6)", 40),
    ("basis: [1, t, cos(pi*t), sin(pi*t)], nodes: gauss(4)", 40),
    (
        "basis: [1, cos(t), sin(t), cos(2*t), sin(2*t)], nodes: gauss(5)",
        40,
    ),
    (
        "basis: [1, cos(t), sin(t), cos(pi*t), sin(pi*t)], nodes: gauss(5)",
        40,
    ),
    ("basis: polynomial(20), nodes: gauss(20)", 200),
];

fn main() -> Result<(), Error> {
    let arguments: Vec<usize> = std::env::args()
        .skip(1)
        .filter_map(|argument| argument.parse().ok())
        .collect();
    let stages = if arguments.is_empty() {
        vec![2, 4, 8, 12, 16, 20, 24, 32]
    } else {
        arguments
    };
    println!(
        "derivation, all properties, exact forms, {DEFAULT_DIGITS} digits, doubles and singles, in milliseconds\n"
    );
    println!("| stages | gauss | lobatto | chebyshev or clenshaw-curtis |");
    println!("|---:|---:|---:|---:|");
    for s in stages {
        let third = if s <= 7 || s == 9 {
            "chebyshev"
        } else {
            "clenshaw-curtis"
        };
        let time = |family: &str| {
            let definition = format!("basis: polynomial({s}), nodes: {family}({s})");
            median(&definition, s, DEFAULT_DIGITS, false)
        };
        let [gauss, lobatto, third] = [time("gauss")?, time("lobatto")?, time(third)?];
        println!("| {s} | {gauss:.1} | {lobatto:.1} | {third:.1} |");
    }
    println!("\n| definition | digits | | with order and stability |\n|---|---:|---:|---:|");
    for (definition, digits) in OTHERS {
        let times = [false, true].map(|facts| median(definition, 32, digits, facts));
        let [time, with_facts] = times;
        println!(
            "| {definition} | {digits} | {:.1} | {:.1} |",
            time?, with_facts?
        );
    }
    Ok(())
}
