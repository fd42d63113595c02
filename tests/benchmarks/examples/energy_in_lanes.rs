//! The energy of a formula at many points, in eight and in four lanes: nanoseconds per point.
//!
//! `cargo run --release -p symplectic-benchmarks --example energy_in_lanes`, and with `RUSTFLAGS="-C target-cpu=native"`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::hint::black_box;
use std::time::Instant;

use symplectic::nalgebra::SVector;
use symplectic::simd::{F64x4, F64x8, Lanes};
use symplectic::{Hamiltonian, Scalar};
use symplectic_tests::formulas::RestrictedThreeBody;

/// Number of points; they fit the first-level cache.
const POINTS: usize = 512;
/// Number of passes over all points in a measurement.
const PASSES: usize = 100;
/// Number of measurements, of which the shortest counts.
const ROUNDS: usize = 500;

/// Position and momentum of a group of points.
type Point<T> = [SVector<T, 2>; 2];

/// The energies at the points, one group after another.
fn energies<T: Scalar>(system: &RestrictedThreeBody, points: &[Point<T>], energies: &mut [T]) {
    for ([q, p], energy) in points.iter().zip(energies) {
        *energy = system
            .energy(T::zero(), q, p)
            .unwrap_or_else(|| T::from_f64(f64::NAN));
    }
}

/// Irregularly spaced points around the Earth and the Moon.
fn points<T: Scalar>(width: usize, group: impl Fn(&dyn Fn(usize) -> f64) -> T) -> Vec<Point<T>> {
    let number = |k: usize| (k as f64 * 0.754_877_666_2).fract() * 3.0 - 1.5;
    let component =
        |first: usize, c: usize| group(&|lane| number(4 * (first * width + lane) + c + 1));
    (0..POINTS / width)
        .map(|k| [0, 2].map(|half| SVector::from([0, 1].map(|c| component(k, half + c)))))
        .collect()
}

/// Only the two square roots and two quotients of that energy: the share of the division unit of the processor.
fn roots_and_quotients<T: Scalar>(points: &[Point<T>], values: &mut [T]) {
    for ([q, p], value) in points.iter().zip(values) {
        *value = T::from_f64(0.3) / q[0].sqrt() + T::from_f64(0.7) / p[0].sqrt();
    }
}

/// Nanoseconds per point for the energy, and for its roots and quotients alone.
fn times<T: Scalar>(points: &[Point<T>]) -> [f64; 2] {
    let system = black_box(RestrictedThreeBody::default());
    let positive = points.iter().map(|[q, p]| [q.map(T::abs), p.map(T::abs)]);
    let positive: Vec<Point<T>> = positive.collect();
    let energy = shortest(points, |points, out| energies(&system, points, out));
    [energy, shortest(&positive, roots_and_quotients)]
}

/// Nanoseconds per point, from the shortest measurement.
fn shortest<T: Scalar>(points: &[Point<T>], pass: impl Fn(&[Point<T>], &mut [T])) -> f64 {
    let mut out = vec![T::zero(); points.len()];
    let round = |_| {
        let began = Instant::now();
        for _ in 0..PASSES {
            pass(black_box(points), &mut out);
            black_box(&mut out);
        }
        began.elapsed().as_secs_f64()
    };
    let shortest = (0..ROUNDS).map(round).fold(f64::INFINITY, f64::min);
    shortest * 1e9 / (PASSES * POINTS) as f64
}

fn main() {
    println!("H of the restricted three-body problem, {POINTS} points, ns a point:\n");
    println!("| numbers | H | its two roots and two quotients alone |");
    println!("|---|---:|---:|");
    let row = |numbers, [energy, limit]: [f64; 2]| {
        println!("| {numbers} | {energy:.2} | {limit:.2} |");
    };
    row("f64", times::<f64>(&points(1, |number| number(0))));
    row("F64x4", times(&points(4, |number| F64x4::from_fn(number))));
    row("F64x8", times(&points(8, |number| F64x8::from_fn(number))));
}
