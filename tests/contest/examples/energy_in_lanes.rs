//! The energy of a formula over many points, eight and four of them side by side: nanoseconds a point.
//!
//! `cargo run --release -p symplectic-contest --example energy_in_lanes`, and with `RUSTFLAGS="-C target-cpu=native"`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::hint::black_box;
use std::time::Instant;

use symplectic::nalgebra::SVector;
use symplectic::simd::{F64x4, F64x8, Lanes};
use symplectic::{Hamiltonian, Scalar};
use symplectic_tests::formulas::RestrictedThreeBody;

/// They stay in the first cache.
const POINTS: usize = 512;
/// Passes over all points in one measurement.
const PASSES: usize = 2_000;
/// Measurements, of which the shortest counts.
const ROUNDS: usize = 25;

/// Position and momentum of a group of points.
type Point<T> = [SVector<T, 2>; 2];

/// The energy of some points, one group after another.
fn energies<T: Scalar>(system: &RestrictedThreeBody, points: &[Point<T>], energies: &mut [T]) {
    for ([q, p], energy) in points.iter().zip(energies) {
        *energy = system
            .energy(T::zero(), q, p)
            .unwrap_or_else(|| T::from_f64(f64::NAN));
    }
}

/// Points without a pattern around the Earth and the Moon.
fn points<T: Scalar>(width: usize, group: impl Fn(&dyn Fn(usize) -> f64) -> T) -> Vec<Point<T>> {
    let number = |k: usize| (k as f64 * 0.754_877_666_2).fract() * 3.0 - 1.5;
    let component =
        |first: usize, c: usize| group(&|lane| number(4 * (first * width + lane) + c + 1));
    (0..POINTS / width)
        .map(|k| [0, 2].map(|half| SVector::from([0, 1].map(|c| component(k, half + c)))))
        .collect()
}

/// Nanoseconds a point.
fn time<T: Scalar>(points: &[Point<T>]) -> f64 {
    let system = black_box(RestrictedThreeBody::default());
    let mut out = vec![T::zero(); points.len()];
    let round = |_| {
        let began = Instant::now();
        for _ in 0..PASSES {
            energies(&system, black_box(points), &mut out);
            black_box(&mut out);
        }
        began.elapsed().as_secs_f64()
    };
    let shortest = (0..ROUNDS).map(round).fold(f64::INFINITY, f64::min);
    shortest * 1e9 / (PASSES * POINTS) as f64
}

fn main() {
    println!("H of the restricted three-body problem, {POINTS} points, ns a point:\n");
    println!("| numbers | ns |");
    println!("|---|---:|");
    println!(
        "| f64 | {:.2} |",
        time(&points::<f64>(1, |number| number(0)))
    );
    println!(
        "| F64x4 | {:.2} |",
        time(&points(4, |number| F64x4::from_fn(number)))
    );
    println!(
        "| F64x8 | {:.2} |",
        time(&points(8, |number| F64x8::from_fn(number)))
    );
}
