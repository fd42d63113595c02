//! Whether rounding errors make the energy drift: ensembles of 32 orbits over 4 194 304 steps.
//!
//! `cargo run --release -p symplectic-tests --example drift`, some minutes; `-- --quick` for 65 536 steps.

#![allow(clippy::print_stdout, reason = "an example prints")]

use symplectic::solver::SimdFixedPoint;
use symplectic::system::SystemInLanes;
use symplectic::{Error, Integrator, Method, ProvedFor, State, System, Vector};
use symplectic_tests::drift::{Sample, ensemble, exponent};
use symplectic_tests::methods::{Gauss6, Gauss8};
use symplectic_tests::scenes::fput_chain;
use symplectic_tests::scenes::henon_heiles::{self, HenonHeiles};
use symplectic_tests::scenes::kepler::{self, Kepler};
use symplectic_tests::scenes::nonseparable::{self, Nonseparable};

const ORBITS: u32 = 32;

fn main() -> Result<(), Error> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let most = if quick { 16 } else { 22 };
    let steps: Vec<u64> = (most - 8..=most).step_by(2).map(|k| 1 << k).collect();
    println!("Relative energy errors of {ORBITS} orbits after 2^{most} steps.");
    println!(
        "ratio: the mean in units of its standard error; growth: exponents of the number of steps.\n"
    );
    println!(
        "| problem | method | sums | mean | spread | ratio | growth of the mean | of the spread |"
    );
    println!("|---|---|---|---:|---:|---:|---:|---:|");
    // Neighbouring orbits: their rounding errors are independent.
    let ellipses = orbits(|k| kepler::start(0.6 - 1e-3 * k));
    let stars = orbits(|k| beside(henon_heiles::start(), k));
    let rings = orbits(|k| beside(nonseparable::start(), k));
    let chains = orbits(|k| beside(fput_chain::start(8), k));
    // The step sizes are such that the errors of the methods themselves are below those of rounding.
    let kepler = Ensemble {
        problem: "Kepler, e ≈ 0.6",
        system: Kepler,
        starts: &ellipses,
    };
    kepler.rows(Gauss6, 1.0 / 32.0, &steps)?;
    kepler.rows(Gauss8, 1.0 / 16.0, &steps)?;
    let galaxy = Ensemble {
        problem: "Hénon–Heiles",
        system: HenonHeiles,
        starts: &stars,
    };
    galaxy.rows(Gauss6, 1.0 / 16.0, &steps)?;
    galaxy.rows(Gauss8, 1.0 / 8.0, &steps)?;
    let general = Ensemble {
        problem: "(q² + 1)(p² + 1)/2",
        system: Nonseparable,
        starts: &rings,
    };
    general.rows(Gauss6, 1.0 / 32.0, &steps)?;
    general.rows(Gauss8, 1.0 / 16.0, &steps)?;
    // Six stages go in rows of eight particles, eight stages in lanes of their own.
    let chain = Ensemble {
        problem: "FPUT chain, N = 8",
        system: fput_chain::system(),
        starts: &chains,
    };
    chain.compensated_and_plain(Gauss6, 1.0 / 8.0, &steps)?;
    chain.compensated_and_plain(Gauss8, 1.0 / 4.0, &steps)
}

/// The start of every orbit.
fn orbits<V>(start: impl Fn(f64) -> State<V>) -> Vec<State<V>> {
    (0..ORBITS).map(|k| start(f64::from(k))).collect()
}

/// The `k`-th neighbour of a state.
fn beside<V: Vector<Scalar = f64>>(mut state: State<V>, k: f64) -> State<V> {
    state.q.as_mut_slice()[0] += 1e-3 * k;
    state
}

/// Orbits of one system.
struct Ensemble<'a, S, V> {
    problem: &'a str,
    system: S,
    starts: &'a [State<V>],
}

impl<S: SystemInLanes<V> + Copy, V: Vector<Scalar = f64>> Ensemble<'_, S, V> {
    /// A row for each kind of sums, and one with both halves of the stages in turn.
    fn rows<M: Method + Copy + ProvedFor<<S as System<V>>::Class>>(
        &self,
        method: M,
        step_size: f64,
        steps: &[u64],
    ) -> Result<(), Error> {
        let system = self.system;
        let in_turn = |start| {
            Ok(Integrator::new(method, system, start, step_size)?.with_solver(SimdFixedPoint))
        };
        let in_turn = ensemble(in_turn, self.starts, steps)?;
        self.row::<M>("compensated, in turn", &in_turn);
        self.compensated_and_plain(method, step_size, steps)
    }

    /// A row for each kind of sums, by the solver that the types choose.
    fn compensated_and_plain<M: Method + Copy + ProvedFor<<S as System<V>>::Class>>(
        &self,
        method: M,
        step_size: f64,
        steps: &[u64],
    ) -> Result<(), Error> {
        let system = self.system;
        let compensated = |start| Integrator::new(method, system, start, step_size);
        self.row::<M>("compensated", &ensemble(compensated, self.starts, steps)?);
        let plain = |start| Integrator::plain(method, system, start, step_size);
        self.row::<M>("plain", &ensemble(plain, self.starts, steps)?);
        Ok(())
    }

    fn row<M: Method>(&self, sums: &str, samples: &[Sample]) {
        let Some(last) = samples.last() else {
            return;
        };
        println!(
            "| {} | {} | {sums} | {:.1e} | {:.1e} | {:.1} | {:.2} | {:.2} |",
            self.problem,
            M::NAME,
            last.mean,
            last.spread,
            last.significance,
            exponent(samples, |sample| sample.mean),
            exponent(samples, |sample| sample.spread),
        );
    }
}
