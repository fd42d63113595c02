//! Instructions of an explicit step of the library and of hand-written code, counted by callgrind.
//!
//! `cargo run --release -p symplectic-benchmarks --example instructions` runs itself under `valgrind --tool=callgrind`, once for each number of
//! components, and prints the ratios. Valgrind does not support AVX-512: build for the baseline target.
//!
//! The program runs with two numbers of steps. The difference of the counts divided by the difference of the steps
//! excludes all code before and after the steps.

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;
use std::hint::black_box;
use std::process::Command;

use symplectic::nalgebra::{DVector, SVector};
use symplectic::solver::FixedPoint;
use symplectic::system::Masses;
use symplectic::{
    Compensated, Integrator, Method, Plain, Scalar, Separable, State, Summation, System, Vector,
};
use symplectic_benchmarks::baseline::lanes::{fast_two_sum, two_sum};
use symplectic_tests::methods::{ForestRuth, VelocityVerlet};

type Outcome = Result<(), Box<dyn Error>>;

/// Numbers of steps of the short and of the long run.
const STEPS: [u64; 2] = [100, 1100];

fn main() -> Outcome {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [case, who, steps] = &arguments[..] {
        return run(case, who, steps.parse()?);
    }
    println!(
        "Instructions a step, as callgrind counts them; velocity Verlet and Forest–Ruth on coupled oscillators.\n"
    );
    println!("| method | sums | dimension | by hand | library | ratio |");
    println!("|---|---|---|---:|---:|---:|");
    for method in ["verlet", "forest-ruth"] {
        for sums in ["plain", "compensated"] {
            for dimension in [
                "2",
                "6",
                "18",
                "1024",
                "dynamic-2",
                "dynamic-6",
                "dynamic-18",
                "dynamic-1024",
            ] {
                let case = format!("{method} {sums} {dimension}");
                let (by_hand, library) = (count(&case, "hand")?, count(&case, "library")?);
                println!(
                    "| {method} | {sums} | {dimension} | {by_hand:.1} | {library:.1} | {:.3} |",
                    library / by_hand
                );
            }
        }
    }
    Ok(())
}

/// Instructions per step.
fn count(case: &str, who: &str) -> Result<f64, Box<dyn Error>> {
    let [short, long] = STEPS.map(|steps| instructions(case, who, steps));
    Ok((long? - short?) / (STEPS[1] - STEPS[0]) as f64)
}

/// Instructions of a whole run, from the summary of callgrind: `Collected : 12345`.
fn instructions(case: &str, who: &str, steps: u64) -> Result<f64, Box<dyn Error>> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(std::env::current_exe()?)
        .args([case, who, &steps.to_string()])
        .output()?;
    let report = String::from_utf8(output.stderr)?;
    let line = report
        .lines()
        .find_map(|line| line.split("Collected :").nth(1));
    let count = line.ok_or_else(|| format!("no count in what valgrind says:\n{report}"))?;
    Ok(count.trim().parse()?)
}

/// A row of coupled oscillators: the forces are cheap, so that the overhead is visible.
#[derive(Clone, Copy)]
struct Oscillators;

impl<V: Vector> System<V> for Oscillators {
    type Class = Separable;
    type Solver = FixedPoint;

    const MASSES: Masses = Masses::Unit;

    #[inline(always)]
    fn velocity(&self, _time: V::Scalar, _q: &V, p: &V, velocity: &mut V) {
        symplectic::emitted::copy(velocity, p);
    }

    #[inline(always)]
    fn force(&self, _time: V::Scalar, q: &V, _p: &V, force: &mut V) {
        pull(q.as_slice(), force.as_mut_slice());
    }
}

/// The force: `q_{i+1} − 2q_i`, the last one without a neighbour.
#[inline(always)]
fn pull<T: Scalar>(q: &[T], force: &mut [T]) {
    let n = q.len().min(force.len());
    let (q, force) = (&q[..n], &mut force[..n]);
    for i in 0..n {
        force[i] = -(q[i] + q[i]);
    }
    for i in 1..n {
        force[i - 1] += q[i];
    }
}

/// Runs one case.
fn run(case: &str, who: &str, steps: u64) -> Outcome {
    let mut words = case.split(' ');
    let mut word = || words.next().ok_or("three words: method, sums, dimension");
    let (method, sums, dimension) = (word()?, word()?, word()?);
    match (method, sums) {
        ("verlet", "plain") => {
            run_in::<VelocityVerlet, Plain>(VelocityVerlet, dimension, who, steps)
        }
        ("verlet", _) => {
            run_in::<VelocityVerlet, Compensated>(VelocityVerlet, dimension, who, steps)
        }
        (_, "plain") => run_in::<ForestRuth, Plain>(ForestRuth, dimension, who, steps),
        _ => run_in::<ForestRuth, Compensated>(ForestRuth, dimension, who, steps),
    }
}

fn run_in<M: ByHand, R: Summation>(method: M, dimension: &str, who: &str, steps: u64) -> Outcome {
    let of = |n| DVector::from_fn(n, |i, _| 1.0 / (1 + i) as f64);
    match dimension {
        "2" => step::<M, R, SVector<f64, 2>>(method, of(2).fixed_rows::<2>(0).into(), who, steps),
        "6" => step::<M, R, SVector<f64, 6>>(method, of(6).fixed_rows::<6>(0).into(), who, steps),
        "18" => {
            step::<M, R, SVector<f64, 18>>(method, of(18).fixed_rows::<18>(0).into(), who, steps)
        }
        "1024" => step::<M, R, SVector<f64, 1024>>(
            method,
            of(1024).fixed_rows::<1024>(0).into(),
            who,
            steps,
        ),
        dynamic => {
            let n = dynamic.trim_start_matches("dynamic-").parse()?;
            step::<M, R, DVector<f64>>(method, of(n), who, steps)
        }
    }
}

fn step<M: ByHand, R: Summation, V: Vector<Scalar = f64>>(
    method: M,
    q: V,
    who: &str,
    steps: u64,
) -> Outcome {
    let p = q.clone();
    let h = black_box(1.0 / 64.0);
    if who == "hand" {
        let memory = [q.zeros_like(), q.zeros_like(), q.zeros_like()];
        black_box(by_hand::<M, R, V>(q, p, memory, h, steps));
    } else {
        let start = State::new(0.0, q, p);
        let mut integrator =
            Integrator::<M, _, V, R>::with_summation(method, Oscillators, start, h)?;
        integrator.take_steps(steps)?;
        black_box(integrator.into_state());
    }
    Ok(())
}

/// The kicks and drifts of a splitting that begins and ends with a kick.
trait ByHand: Method {
    const KICKS: &'static [f64];
    const DRIFTS: &'static [f64];
}

impl ByHand for VelocityVerlet {
    const KICKS: &'static [f64] = &Self::B_TILDE;
    const DRIFTS: &'static [f64] = &Self::B;
}

impl ByHand for ForestRuth {
    const KICKS: &'static [f64] = &Self::B_TILDE;
    const DRIFTS: &'static [f64] = &Self::B;
}

/// A kick, then alternating drifts and kicks. The force is kept from step to step; masses are 1.
#[inline(never)]
fn by_hand<M: ByHand, R: Summation, V: Vector<Scalar = f64>>(
    mut q: V,
    mut p: V,
    [mut q_low, mut p_low, mut force]: [V; 3],
    h: f64,
    steps: u64,
) -> (V, V) {
    pull(q.as_slice(), force.as_mut_slice());
    for _ in 0..steps {
        add::<R, V>(&mut p, &mut p_low, h * M::KICKS[0], &force);
        for i in 1..M::KICKS.len() {
            add::<R, V>(&mut q, &mut q_low, h * M::DRIFTS[i - 1], &p);
            pull(q.as_slice(), force.as_mut_slice());
            add::<R, V>(&mut p, &mut p_low, h * M::KICKS[i], &force);
        }
    }
    (q, p)
}

/// `x += factor slope`.
#[inline(always)]
fn add<R: Summation, V: Vector<Scalar = f64>>(x: &mut V, low: &mut V, factor: f64, slope: &V) {
    let n = slope.as_slice().len();
    let (x, low) = (&mut x.as_mut_slice()[..n], &mut low.as_mut_slice()[..n]);
    let slope = &slope.as_slice()[..n];
    for i in 0..n {
        if R::COMPENSATED {
            let (high, error) = two_sum(x[i], factor * slope[i]);
            (x[i], low[i]) = fast_two_sum(high, low[i] + error);
        } else {
            x[i] += factor * slope[i];
        }
    }
}
