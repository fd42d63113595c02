//! Systems from formulas against the same systems written by hand: median ratios of the times of whole runs in turn.
//!
//! `cargo run --release -p symplectic-benchmarks --example formulas`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::hint::black_box;
use std::time::Instant;

use symplectic::nalgebra::{DVector, SMatrix, SVector};
use symplectic::{Integrator, State, Vector};
use symplectic_tests::formulas;
use symplectic_tests::methods::{BlanesMoanS10, Gauss4, Gauss8, StoermerVerlet};
use symplectic_tests::scenes::{self, outer_solar_system as planets};

/// Number of runs of both, in turn.
const ROUNDS: usize = 41;

/// Prints a row and stores its ratios, from runs of both systems with each method.
macro_rules! scene {
    ($all:ident, $name:literal, $hand:expr, $formula:expr, $start:expr => $vector:ty, $step:expr, $steps:expr, [$($method:ident),*]) => {
        $(
            let (hand, formula) = ($hand, $formula);
            let start = $start;
            let other = State::new(start.time, vector::<$vector>(start.q.as_slice()), vector::<$vector>(start.p.as_slice()));
            let median = ratio(
                || {
                    let mut run = Integrator::new($method, hand, start.clone(), $step).expect("a start");
                    run.integrate_to(start.time + $step * f64::from($steps)).expect("a run");
                    black_box(run.state());
                },
                || {
                    let mut run = Integrator::new($method, formula, other.clone(), $step).expect("a start");
                    run.integrate_to(start.time + $step * f64::from($steps)).expect("a run");
                    black_box(run.state());
                },
            );
            println!("| {} | {} | {median:.2} |", $name, stringify!($method));
            $all.push(median);
        )*
    };
}

fn vector<V: Vector<Scalar = f64>>(components: &[f64]) -> V {
    V::from_slice(components).expect("as many components")
}

/// The median of the ratios of consecutive runs, the second over the first.
fn ratio(mut hand: impl FnMut(), mut formula: impl FnMut()) -> f64 {
    let seconds = |run: &mut dyn FnMut()| {
        let began = Instant::now();
        run();
        began.elapsed().as_secs_f64()
    };
    let mut ratios: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let by_hand = seconds(&mut hand);
            seconds(&mut formula) / by_hand
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    ratios[ROUNDS / 2]
}

fn main() {
    println!("The time of a system from a formula over that of the system by hand.\n");
    println!("| scene | method | ratio |");
    println!("|---|---|---:|");
    let mut all = Vec::new();
    scene!(all, "Kepler", scenes::kepler::Kepler, formulas::Kepler, scenes::kepler::start::<f64>(0.6) => SVector<f64, 2>, 0.05, 20_000, [StoermerVerlet, BlanesMoanS10, Gauss4, Gauss8]);
    scene!(all, "Hénon–Heiles", scenes::henon_heiles::HenonHeiles, formulas::HenonHeiles, scenes::henon_heiles::start::<f64>() => SVector<f64, 2>, 0.1, 20_000, [StoermerVerlet, BlanesMoanS10, Gauss4, Gauss8]);
    scene!(all, "outer solar system", planets::OuterSolarSystem, formulas::Planets::<6>::new(planets::BODIES_AT_START.map(|body| body.mass)), planets::start::<f64>() => SMatrix<f64, 3, 6>, 50.0, 2_000, [StoermerVerlet, BlanesMoanS10, Gauss4, Gauss8]);
    scene!(all, "double pendulum", scenes::double_pendulum::DoublePendulum, formulas::DoublePendulum::default(), scenes::double_pendulum::start::<f64>() => SVector<f64, 2>, 0.05, 5_000, [Gauss4, Gauss8]);
    scene!(all, "(q² + 1)(p² + 1)/2", scenes::nonseparable::Nonseparable, formulas::Nonseparable, scenes::nonseparable::start::<f64>() => SVector<f64, 1>, 0.05, 5_000, [Gauss4, Gauss8]);
    scene!(all, "FPUT springs", scenes::fput_springs::FputSprings { omega: 50.0 }, formulas::FputSprings::default(), scenes::fput_springs::start::<f64>(50.0) => SVector<f64, 6>, 0.01, 5_000, [StoermerVerlet, BlanesMoanS10, Gauss4, Gauss8]);
    scene!(all, "argon crystal", scenes::argon_crystal::ArgonCrystal, formulas::ArgonCrystal::new(scenes::argon_crystal::MASS), scenes::argon_crystal::start::<f64>() => SMatrix<f64, 2, 7>, 1e-5, 2_000, [StoermerVerlet, BlanesMoanS10, Gauss4, Gauss8]);
    scene!(all, "charged particle", scenes::charged_particle::ChargedParticle, formulas::ChargedParticle, scenes::charged_particle::start::<f64>() => SVector<f64, 3>, 0.05, 5_000, [Gauss4, Gauss8]);
    scene!(all, "post-Newtonian Kepler", scenes::post_newtonian_kepler::EQUAL_MASSES, formulas::PostNewtonianKepler { epsilon: 0.001, nu: 0.25 }, scenes::post_newtonian_kepler::start::<f64>() => SVector<f64, 2>, 0.05, 5_000, [Gauss4, Gauss8]);
    scene!(all, "four vortices", scenes::point_vortices::FOUR, formulas::PointVortices { strength: scenes::point_vortices::FOUR.strengths }, scenes::point_vortices::start::<f64>() => SVector<f64, 4>, 0.05, 3_000, [Gauss4, Gauss8]);
    scene!(all, "FPUT chain of 1024", scenes::fput_chain::system(), formulas::FputChain, scenes::fput_chain::start(1024) => DVector<f64>, 0.05, 500, [StoermerVerlet, BlanesMoanS10, Gauss4]);
    let mean = all.iter().map(|ratio| ratio.ln()).sum::<f64>() / all.len() as f64;
    let largest = all
        .iter()
        .fold(0.0_f64, |largest, &ratio| largest.max(ratio));
    println!("\nGeometric mean {:.2}, largest {largest:.2}.", mean.exp());
}
