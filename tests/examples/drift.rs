//! Whether rounding errors make the energy drift: ensembles of 32 orbits over 4 194 304 steps.
//!
//! `cargo run --release --example drift`, some minutes; `-- --quick` for 65 536 steps.

#![allow(clippy::print_stdout, reason = "an example prints")]

use symplectic::system::HamiltonianInLanes;
use symplectic::{
    Class, Compensated, Error, Hamiltonian, Integrator, Method, Plain, ProvedFor, State, Summation,
    Vector,
};
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
    chain.second_order::<_, Compensated>(Gauss6, "compensated", 1.0 / 8.0, &steps)?;
    chain.second_order::<_, Plain>(Gauss6, "plain", 1.0 / 8.0, &steps)?;
    chain.second_order::<_, Compensated>(Gauss8, "compensated", 1.0 / 4.0, &steps)?;
    chain.second_order::<_, Plain>(Gauss8, "plain", 1.0 / 4.0, &steps)
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

impl<S: HamiltonianInLanes<V> + Copy, V: Vector<Scalar = f64>> Ensemble<'_, S, V> {
    /// A row for each kind of sums, and one for the step without momentum stages where the Hamiltonian is separable, or for that with
    /// positions and momenta at once where it is not.
    fn rows<M: Method + ProvedFor<<S as Hamiltonian<V>>::Class>>(
        &self,
        method: M,
        step_size: f64,
        steps: &[u64],
    ) -> Result<(), Error> {
        let system = self.system;
        let row = |sums, samples: Vec<Sample>| self.row::<M>(sums, &samples);
        // In lanes they are the same to the last bit, and faster.
        let compensated = |start| Ok(Integrator::new(method, system, start, step_size)?.in_lanes());
        row("compensated", ensemble(compensated, self.starts, steps)?);
        if <S as Hamiltonian<V>>::Class::SEPARABLE {
            self.second_order::<M, Compensated>(method, "compensated", step_size, steps)?;
        } else {
            let at_once =
                |start| Ok(Integrator::new(method, system, start, step_size)?.at_once_in_lanes());
            row(
                "compensated, at once",
                ensemble(at_once, self.starts, steps)?,
            );
        }
        let plain = |start| Ok(Integrator::plain(method, system, start, step_size)?.in_lanes());
        row("plain", ensemble(plain, self.starts, steps)?);
        Ok(())
    }

    /// A row for the step without momentum stages.
    fn second_order<M: Method + ProvedFor<<S as Hamiltonian<V>>::Class>, R: Summation>(
        &self,
        method: M,
        sums: &str,
        step_size: f64,
        steps: &[u64],
    ) -> Result<(), Error> {
        let made = |start| {
            let made =
                Integrator::<_, _, _, R>::with_summation(method, self.system, start, step_size)?;
            made.in_second_order_lanes()
        };
        self.row::<M>(
            &format!("{sums}, second order"),
            &ensemble(made, self.starts, steps)?,
        );
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
