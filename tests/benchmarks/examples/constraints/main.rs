//! Constrained steps against hand-written code, and the cost of a chain of links:
//! `cargo run --release -p symplectic-benchmarks --example constraints`.
//!
//! Rigid triangles in a box: RATTLE of the library against SHAKE and RATTLE as usually written. Chains of links: time per link and step. A
//! pendulum on one rod against RATTLE with a number in place of every matrix. The double pendulum in Cartesian coordinates and in angles, by
//! methods of order 4, 6 and 8.

#![allow(clippy::print_stdout, reason = "it prints")]

use cpu_time::ThreadTime;
use symplectic::nalgebra::DVector;
use symplectic::{Error, Integrator, State};

mod pendulums;
mod water;

symplectic::tableau! {
    Rattle { basis: polynomial(2), nodes: lobatto(2), require: [constrained] }
    Lobatto3 { basis: polynomial(3), nodes: lobatto(3), require: [constrained] }
    Lobatto4 { basis: polynomial(4), nodes: lobatto(4), require: [constrained] }
    Lobatto5 { basis: polynomial(5), nodes: lobatto(5), require: [constrained] }
}

symplectic::hamiltonian! {
    /// A hanging chain.
    pub Chain { rods: pairs }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/2 + q[i][1])
    constraints: { anchor = |q[0]|^2 - 1, rod(s = (i, j) in rods) = |q[i] - q[j]|^2 - 1 }
}

/// Number of runs of each program, in turn.
const RUNS: usize = 9;

/// The median CPU times of programs that run in turn, in seconds.
fn medians<const N: usize>(mut programs: [Box<dyn FnMut() + '_>; N]) -> [f64; N] {
    let mut times = [const { Vec::new() }; N];
    for _ in 0..RUNS {
        for (program, times) in programs.iter_mut().zip(&mut times) {
            let start = ThreadTime::now();
            program();
            times.push(start.elapsed().as_secs_f64());
        }
    }
    times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[RUNS / 2]
    })
}

fn chains() -> Result<(), Error> {
    for links in [100, 1000, 10_000] {
        let chain = Chain::new((1..links).map(|k| (k - 1, k)).collect());
        let place = |k: usize, _: usize| {
            if k.is_multiple_of(2) {
                (k / 2 + 1) as f64
            } else {
                0.0
            }
        };
        let start = State::new(
            0.0,
            DVector::from_fn(2 * links, place),
            DVector::zeros(2 * links),
        );
        let mut run = Integrator::new(Rattle, chain, start, 0.002)?;
        run.take_steps(2)?;
        let start = ThreadTime::now();
        run.take_steps(100)?;
        println!(
            "chain of {links} links, RATTLE: {:.0} ns a link and step",
            start.elapsed().as_secs_f64() * 1e7 / links as f64
        );
    }
    Ok(())
}

fn main() -> Result<(), Error> {
    water::compare()?;
    chains()?;
    pendulums::one_rod()?;
    let ratios = [
        pendulums::two_rods(Lobatto3, 1000)?,
        pendulums::two_rods(Lobatto4, 150)?,
        pendulums::two_rods(Lobatto5, 60)?,
    ];
    let mean = ratios.iter().product::<f64>().cbrt();
    println!("geometric mean of the three: {mean:.2} times the time");
    Ok(())
}
