//! The splitting of Wisdom and Holman: steps per second with eight planets, and the outer planets over a million years.
//!
//! `cargo run --release -p symplectic-benchmarks --example kepler_drift`, with `RUSTFLAGS="-C target-cpu=native"` for wider registers. All times
//! are CPU times.

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::f64::consts::TAU;
use std::hint::black_box;

use cpu_time::ThreadTime;
use symplectic::flow::kepler::{Heliocentric, Jacobi};
use symplectic::flow::{Corrector, Error, Flow, FlowSteps, Span, Splitting, Substeps};
use symplectic::friction::Damped;
use symplectic::nalgebra::{DVector, Rotation3, Vector3};
use symplectic::proved::{Splits, SymmetricFor};
use symplectic::{ProvedFor, Separable, State};
use symplectic_tests::scenes::outer_solar_system::{BODIES_AT_START, GRAVITATIONAL_CONSTANT};

symplectic::tableau! {
    /// Drift, kick, drift.
    Leapfrog { base: saba-1 }
    /// Order (6, 2).
    Saba3 { base: saba-3 }
    /// Blanes et al. 2013, order (10, 6, 4).
    Aba1064 { base: blanes-2013-aba-10-6-4 }
}

type Bodies = State<DVector<f64>>;

/// Number of measurements, of which the median counts.
const ROUNDS: usize = 101;
/// Steps of a measurement.
const STEPS: u32 = 2_000;

/// Mass of the Sun over that of the planet, semi-major axis, eccentricity, and in degrees inclination, mean longitude, longitudes of the
/// perihelion and of the ascending node: Mercury to Neptune at J2000 (Standish, *Keplerian elements for approximate positions of the
/// major planets*, table 1).
#[rustfmt::skip]
const PLANETS: [[f64; 7]; 8] = [
    [6_023_600.0, 0.387_099, 0.205_636, 7.004_979, 252.250_324, 77.457_796, 48.330_766],
    [408_523.7, 0.723_336, 0.006_777, 3.394_676, 181.979_099, 131.602_467, 76.679_843],
    [328_900.6, 1.000_003, 0.016_711, -0.000_015, 100.464_572, 102.937_682, 0.0],
    [3_098_708.0, 1.523_710, 0.093_394, 1.849_691, -4.553_432, -23.943_630, 49.559_539],
    [1_047.35, 5.202_887, 0.048_386, 1.304_397, 34.396_441, 14.728_480, 100.473_909],
    [3_497.9, 9.536_676, 0.053_862, 2.485_992, 49.954_244, 92.598_878, 113.662_424],
    [22_903.0, 19.189_165, 0.047_257, 0.772_638, 313.238_105, 170.954_276, 74.016_925],
    [19_412.2, 30.069_923, 0.008_590, 1.770_043, -55.120_030, 44.964_762, 131.784_226],
];

/// A star and planets, and where they start.
struct System {
    gravity: f64,
    masses: Vec<f64>,
    start: Bodies,
}

impl System {
    /// The Sun and eight planets, in astronomical units, years and solar masses.
    fn planets() -> Result<Self, Error> {
        let gravity = TAU * TAU;
        let (mut masses, mut q, mut p) = (vec![1.0], vec![0.0; 3], vec![0.0; 3]);
        for [ratio, axis, e, inclination, longitude, perihelion, node] in PLANETS {
            let mean = (longitude - perihelion).to_radians();
            let anomaly = (0..50).fold(mean, |x, _| mean + e * x.sin());
            let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), node.to_radians())
                * Rotation3::from_axis_angle(&Vector3::x_axis(), inclination.to_radians())
                * Rotation3::from_axis_angle(&Vector3::z_axis(), (perihelion - node).to_radians());
            let (mass, other) = (ratio.recip(), (1.0 - e * e).sqrt());
            let (sine, cosine) = anomaly.sin_cos();
            let speed = (gravity / axis).sqrt() / (1.0 - e * cosine);
            let place = turn * Vector3::new(cosine - e, other * sine, 0.0) * axis;
            let momentum = turn * Vector3::new(-sine, other * cosine, 0.0) * (speed * mass);
            masses.push(mass);
            q.extend_from_slice(place.as_slice());
            p.extend_from_slice(momentum.as_slice());
        }
        let start = State::from_slices(0.0, &q, &p)?;
        Ok(Self {
            gravity,
            masses,
            start,
        })
    }

    /// The Sun and the five outer planets, in astronomical units and days.
    fn outer() -> Result<Self, Error> {
        let bodies = &BODIES_AT_START;
        let q: Vec<f64> = bodies.iter().flat_map(|body| body.position).collect();
        let p: Vec<f64> = bodies
            .iter()
            .flat_map(|body| body.velocity.map(|v| v * body.mass))
            .collect();
        Ok(Self {
            gravity: GRAVITATIONAL_CONSTANT,
            masses: bodies.iter().map(|body| body.mass).collect(),
            start: State::from_slices(0.0, &q, &p)?,
        })
    }

    fn energy(&self, state: &Bodies) -> f64 {
        let place = |i: usize| state.q.fixed_rows::<3>(3 * i).into_owned();
        let mut energy = 0.0;
        for (i, mass) in self.masses.iter().enumerate() {
            energy += state.p.fixed_rows::<3>(3 * i).norm_squared() / (2.0 * mass);
            for j in 0..i {
                energy -= self.gravity * mass * self.masses[j] / (place(i) - place(j)).norm();
            }
        }
        energy
    }
}

/// Prints the number of calls of a flow in a second.
fn row<F: Flow<DVector<f64>>>(
    name: &str,
    flow: &mut F,
    start: &Bodies,
    size: f64,
    calls: u32,
    wanted: &str,
) {
    let State { mut q, mut p, .. } = start.clone();
    let mut rates: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let began = ThreadTime::now();
            for _ in 0..calls {
                let span = Span { time: 0.0, size };
                if let Err(failure) = flow.flow(span, &mut q, &mut p) {
                    println!("{name}: {failure}");
                    return 0.0;
                }
            }
            black_box((&q, &p));
            f64::from(STEPS) / began.elapsed().as_secs_f64()
        })
        .collect();
    rates.sort_by(f64::total_cmp);
    let [median, fastest] = [rates[ROUNDS / 2], rates[ROUNDS - 1]];
    println!("| {name} | {median:.2e} | {fastest:.2e} | {wanted} |");
}

fn eight_planets() -> Result<(), Error> {
    const WANTED: &str = "1.5e6 with AVX2, 3e6 with AVX-512";
    /// Steps in a call.
    const MANY: u32 = 100;
    println!("Sun and eight planets, step 5 days.\n");
    println!("| | steps/s, median | fastest | wanted |");
    println!("|---|---:|---:|---|");
    let system = System::planets()?;
    let size = 5.0 / 365.25;
    let jacobi = Jacobi::new(system.gravity, &system.masses)?;
    let start = jacobi.from_inertial(&system.start)?;
    let step = Splitting::new(Leapfrog, jacobi.drift(), jacobi.kick());
    let mut steps = Substeps::new(step, MANY)?;
    let (size_of_many, calls) = (size * f64::from(MANY), STEPS / MANY);
    row("Jacobi", &mut steps, &start, size_of_many, calls, WANTED);
    row(
        "– the drift alone",
        &mut jacobi.drift(),
        &start,
        size,
        STEPS,
        "",
    );
    row(
        "– the kick alone",
        &mut jacobi.kick(),
        &start,
        0.0,
        STEPS,
        "",
    );
    for (name, system, start) in [
        (
            "democratic heliocentric",
            Heliocentric::new(system.gravity, &system.masses)?,
            &system.start,
        ),
        (
            "WHDS",
            Heliocentric::of_pairs(system.gravity, &system.masses)?,
            &system.start,
        ),
    ] {
        let start = system.from_inertial(start)?;
        let step = Splitting::new(Leapfrog, system.drift(), system.kick());
        let mut steps = Substeps::new(step, MANY)?;
        row(name, &mut steps, &start, size_of_many, calls, WANTED);
    }
    Ok(())
}

/// Prints run time and largest energy error over a million years of outer planets.
fn million_years<M: Copy + Splits + SymmetricFor<Separable> + ProvedFor<Damped>>(
    name: &str,
    method: M,
    size: f64,
    pairs: Option<u32>,
) -> Result<(), Error> {
    const END: f64 = 365.25e6;
    const MANY: u32 = 500;
    let system = System::outer()?;
    let jacobi = Jacobi::new(system.gravity, &system.masses)?;
    let start = jacobi.from_inertial(&system.start)?;
    let mut corrector = pairs
        .map(|pairs| Corrector::new(method, jacobi.drift(), jacobi.kick(), pairs as _))
        .transpose()?;
    let start = match &mut corrector {
        Some(corrector) => corrector.to_kernel(&start, size)?,
        None => start,
    };
    let step = Splitting::new(method, jacobi.drift(), jacobi.kick());
    let many = size * f64::from(MANY);
    let mut run = FlowSteps::run(Substeps::new(step, MANY)?, start, many)?;
    let before = system.energy(&system.start);
    let mut largest = 0.0_f64;
    let blocks = (END / many).ceil() as u64;
    let began = ThreadTime::now();
    for _ in 0..blocks {
        let state = run.step()?;
        let state = match &mut corrector {
            Some(corrector) => corrector.from_kernel(state, size)?,
            None => state.clone(),
        };
        let energy = system.energy(&jacobi.to_inertial(&state)?);
        largest = largest.max(((energy - before) / before).abs());
    }
    let seconds = began.elapsed().as_secs_f64();
    println!("| {name} | {size} | {seconds:.2} | {largest:.1e} |");
    Ok(())
}

fn main() -> Result<(), Error> {
    eight_planets()?;
    println!(
        "\nSun and five outer planets, a million years: wanted 3 s with an energy error of 1e-9.\n"
    );
    println!("| method | step in days | s | largest relative energy error |");
    println!("|---|---:|---:|---:|");
    million_years("ABA(10, 6, 4)", Aba1064, 700.0, None)?;
    million_years("leapfrog, corrector with 4 pairs", Leapfrog, 100.0, Some(4))?;
    million_years("SABA3", Saba3, 200.0, None)?;
    Ok(())
}
