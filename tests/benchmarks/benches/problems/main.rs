//! Whole runs of the problems to errors of about 1e-9: by the library, by hand-written code, and by other crates.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo bench --bench problems`; a table of the errors is printed first, because a
//! time means nothing without its error. The example `ratios` compares the library and hand-written code step by step.

#![allow(clippy::print_stdout, reason = "a bench prints")]

mod peers;

use std::hint::black_box;

use divan::Bencher;
use peers::{End, Equations};
use symplectic::nalgebra::SVector;
use symplectic::solver::{FixedPoint, Solver};
use symplectic::system::{SystemInLanes, Unconstrained};
use symplectic::{
    Compensated, Error, Integrator, Method, Plain, ProvedFor, Separable, State, Summation, System,
    Vector,
};
use symplectic_benchmarks::baseline::gauss::{FirstOrder, Rule, SecondOrder};
use symplectic_benchmarks::baseline::no_drift::{Double, NoDrift, NoDriftGeneral};
use symplectic_benchmarks::baseline::{chain, explicit, systems};
use symplectic_tests::methods::{BlanesMoanSrkn14a, Gauss8};
use symplectic_tests::scenes::{
    double_pendulum, fput_chain, fput_springs, henon_heiles, kepler, nonseparable,
    outer_solar_system,
};
use wide::f64x8;

/// Gauss with eight stages, for the hand-written integrators.
const GAUSS: Rule<8> = Rule {
    a: Gauss8::A,
    a_tilde: Gauss8::A_TILDE,
    b: Gauss8::B,
    c: Gauss8::C,
};

/// An integrator on a problem.
struct Entry {
    name: &'static str,
    run: Box<dyn Fn() -> End>,
}

/// The settings of the integrators, for errors of about 1e-9; larger for Forest & Ruth, which would take too long.
struct Settings {
    end: f64,
    /// Step sizes of Gauss with eight stages, of Blanes & Moan, and of Forest & Ruth in another crate.
    gauss: f64,
    blanes_moan: f64,
    forest_ruth: f64,
    /// Largest final change of a stage, in the plain hand-written form.
    stages: f64,
    /// Tolerance of DOP853.
    tolerance: f64,
    /// Step size of the reference: hand-written Gauss with eight stages, in the form without drift.
    reference: f64,
}

/// The entries of a problem, the reference last.
macro_rules! entries {
    ($problem:ident, $settings:expr, $system:expr, $by_hand:expr, $start:expr, $N:literal, $kind:ident) => {
        fn $problem() -> Vec<Entry> {
            $kind::<_, _, $N, { 2 * $N }>(&$settings, $system, $by_hand, &$start)
        }
    };
}

entries!(
    kepler,
    Settings {
        end: 125.0,
        gauss: 0.195,
        blanes_moan: 0.025,
        forest_ruth: 1e-3,
        stages: 1e-12,
        tolerance: 1e-13,
        reference: 0.0625
    },
    kepler::Kepler,
    systems::Kepler,
    kepler::start(0.6),
    2,
    separable
);
entries!(
    outer_planets,
    Settings {
        end: 5e5,
        gauss: 488.0,
        blanes_moan: 100.0,
        forest_ruth: 10.0,
        stages: 1e-11,
        tolerance: 1e-13,
        reference: 250.0
    },
    outer_solar_system::OuterSolarSystem,
    systems::OuterSolarSystem,
    outer_solar_system::start(),
    18,
    separable
);
entries!(
    galaxy,
    Settings {
        end: 1e4,
        gauss: 0.39,
        blanes_moan: 0.1,
        forest_ruth: 0.01,
        stages: 1e-14,
        tolerance: 1e-14,
        reference: 0.125
    },
    henon_heiles::HenonHeiles,
    systems::HenonHeiles,
    henon_heiles::start(),
    2,
    separable
);
entries!(
    springs,
    Settings {
        end: 200.0,
        gauss: 0.04,
        blanes_moan: 2e-3,
        forest_ruth: 2e-4,
        stages: 1e-14,
        tolerance: 1e-13,
        reference: 0.01
    },
    fput_springs::FputSprings {
        omega: fput_springs::OMEGA
    },
    systems::FputSprings {
        omega: fput_springs::OMEGA
    },
    fput_springs::start(fput_springs::OMEGA),
    6,
    separable
);
entries!(
    pendulum,
    Settings {
        end: 100.0,
        gauss: 0.1,
        blanes_moan: 0.0,
        forest_ruth: 0.0,
        stages: 1e-11,
        tolerance: 1e-13,
        reference: 0.025
    },
    double_pendulum::DoublePendulum,
    systems::DoublePendulum,
    double_pendulum::start(),
    2,
    general
);
entries!(
    coupled,
    Settings {
        end: 100.0,
        gauss: 0.1,
        blanes_moan: 0.0,
        forest_ruth: 0.0,
        stages: 1e-11,
        tolerance: 1e-12,
        reference: 0.025
    },
    nonseparable::Nonseparable,
    systems::Nonseparable,
    nonseparable::start(),
    1,
    general
);

fn long_chain() -> Vec<Entry> {
    const N: usize = fput_chain::PARTICLES;
    let settings = Settings {
        end: 100.0,
        gauss: 0.8,
        blanes_moan: 0.2,
        forest_ruth: 0.01,
        stages: 1e-12,
        tolerance: 1e-12,
        reference: 0.25,
    };
    let dynamic = fput_chain::start(N);
    let start = State::new(
        0.0,
        SVector::from_fn(|i, _| dynamic.q[i]),
        SVector::from_fn(|i, _| dynamic.p[i]),
    );
    let blocks = (
        chain::Blocks::new(dynamic.q.as_slice()),
        chain::Blocks::new(dynamic.p.as_slice()),
    );
    let mut entries = others::<_, N, { 2 * N }>(&settings, fput_chain::system(), &start);
    entries.extend(gauss_8(&settings, fput_chain::system(), dynamic.clone()));
    entries.push(library(
        "Blanes–Moan, library, plain",
        BlanesMoanSrkn14a,
        (fput_chain::system(), dynamic),
        (settings.end, settings.blanes_moan),
        Ok::<Integrator<_, _, _, Plain>, _>,
    ));
    let values =
        |q: &chain::Blocks, p: &chain::Blocks| Some(q.values().chain(p.values()).collect());
    let begin = blocks.clone();
    entries.push(entry("Blanes–Moan, by hand", move || {
        let (mut q, mut p) = begin.clone();
        let (h, steps) = steps(settings.end, settings.blanes_moan);
        chain::explicit::<explicit::BlanesMoan>(&mut q, &mut p, h, steps);
        values(&q, &p)
    }));
    for (name, step_size, tolerance) in [
        ("Gauss 8, by hand, plain", settings.gauss, settings.stages),
        ("reference", settings.reference, 1e-16),
    ] {
        let begin = blocks.clone();
        entries.push(entry(name, move || {
            let (mut q, mut p) = begin.clone();
            let (h, steps) = steps(settings.end, step_size);
            chain::SecondOrder::<8>::new(&GAUSS, N, h).run(&mut q, &mut p, tolerance, steps);
            values(&q, &p)
        }));
    }
    entries
}

fn entry(name: &'static str, run: impl Fn() -> End + 'static) -> Entry {
    Entry {
        name,
        run: Box::new(run),
    }
}

/// Equal steps of about `step_size` to `end`: their size and number.
fn steps(end: f64, step_size: f64) -> (f64, u64) {
    let steps = (end / step_size).round();
    (end / steps, steps as u64)
}

/// A run of the library with the given solver.
fn library<M, S, V, R, N>(
    name: &'static str,
    method: M,
    (system, start): (S, State<V>),
    (end, step_size): (f64, f64),
    set: impl Fn(Integrator<M, S, V, R>) -> Result<Integrator<M, S, V, R, N>, Error> + 'static,
) -> Entry
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<V> + Copy + 'static,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    entry(name, move || {
        let (h, steps) = steps(end, step_size);
        let integrator = Integrator::with_summation(method, system, start.clone(), h);
        let mut integrator = integrator.and_then(&set).ok()?;
        integrator.take_steps(steps).ok()?;
        let State { q, p, .. } = integrator.state();
        Some([q.as_slice(), p.as_slice()].concat())
    })
}

/// Gauss with eight stages of the library, in lanes like the hand-written code, and stage by stage.
fn gauss_8<S, V>(settings: &Settings, system: S, start: State<V>) -> [Entry; 3]
where
    S: SystemInLanes<V> + System<V, Class: Unconstrained> + Copy + 'static,
    V: Vector<Scalar = f64>,
{
    let (tolerance, problem) = (settings.stages, (system, start));
    let steps_to = (settings.end, settings.gauss);
    [
        library(
            "Gauss 8, library",
            Gauss8,
            problem.clone(),
            steps_to,
            Ok::<Integrator<_, _, _, Compensated>, _>,
        ),
        library(
            "Gauss 8, library, plain",
            Gauss8,
            problem.clone(),
            steps_to,
            move |mut made: Integrator<_, _, _, Plain>| {
                made.set_tolerance(tolerance)?;
                Ok(made)
            },
        ),
        library(
            "Gauss 8, library, stage by stage",
            Gauss8,
            problem,
            steps_to,
            |made: Integrator<_, _, _, Compensated>| Ok(made.with_solver(FixedPoint)),
        ),
    ]
}

/// DOP853 of both crates.
fn others<S, const N: usize, const M: usize>(
    settings: &Settings,
    system: S,
    start: &State<SVector<f64, N>>,
) -> Vec<Entry>
where
    S: System<SVector<f64, N>> + Copy + 'static,
{
    let &Settings { end, tolerance, .. } = settings;
    let y = together::<N, M>(start);
    vec![
        entry("DOP853, ode_solvers", move || {
            peers::ode_solvers(&Equations(system), y, end, tolerance)
        }),
        entry("DOP853, differential-equations", move || {
            peers::dop853(&Equations(system), y, end, tolerance)
        }),
    ]
}

/// `(q, p)` in one array.
fn together<const N: usize, const M: usize>(start: &State<SVector<f64, N>>) -> [f64; M] {
    std::array::from_fn(|i| if i < N { start.q[i] } else { start.p[i - N] })
}

fn separable<S, B, const N: usize, const M: usize>(
    settings: &Settings,
    system: S,
    by_hand: B,
    start: &State<SVector<f64, N>>,
) -> Vec<Entry>
where
    S: SystemInLanes<SVector<f64, N>> + System<SVector<f64, N>, Class = Separable> + Copy + 'static,
    B: systems::Separable<N> + Copy + 'static,
{
    let &Settings {
        end,
        gauss,
        blanes_moan,
        forest_ruth,
        stages,
        reference,
        ..
    } = settings;
    let mut entries = others::<S, N, M>(settings, system, start);
    let y = together::<N, M>(start);
    entries.push(entry("Forest–Ruth, differential-equations", move || {
        peers::forest_ruth(&Equations(system), y, end, forest_ruth)
    }));
    entries.extend(gauss_8(settings, system, start.clone()));
    entries.push(library(
        "Blanes–Moan, library, plain",
        BlanesMoanSrkn14a,
        (system, start.clone()),
        (end, blanes_moan),
        Ok::<Integrator<_, _, _, Plain>, _>,
    ));
    let (q, p) = (start.q.data.0[0], start.p.data.0[0]);
    entries.push(entry("Blanes–Moan, by hand", move || {
        let (mut q, mut p) = (q, p);
        let (h, steps) = steps(end, blanes_moan);
        explicit::run::<explicit::BlanesMoan, B, N>(&by_hand, (&mut q, &mut p), h, steps);
        Some([q, p].concat())
    }));
    entries.push(entry("Gauss 8, by hand, plain", move || {
        let (mut q, mut p) = (q, p);
        let (h, steps) = steps(end, gauss);
        SecondOrder::<f64x8, 8>::new(&GAUSS, h).run(&by_hand, (&mut q, &mut p), stages, steps);
        Some([q, p].concat())
    }));
    for (name, step_size) in [("Gauss 8, by hand", gauss), ("reference", reference)] {
        entries.push(entry(name, move || {
            let (mut q, mut p) = (Double::new(q), Double::new(p));
            let (h, steps) = steps(end, step_size);
            NoDrift::<f64x8, 8>::new(&GAUSS, h).run(
                &by_hand,
                (&mut q, &mut p),
                1e3 * stages,
                steps,
            );
            Some([q.high, p.high].concat())
        }));
    }
    entries
}

fn general<S, B, const N: usize, const M: usize>(
    settings: &Settings,
    system: S,
    by_hand: B,
    start: &State<SVector<f64, N>>,
) -> Vec<Entry>
where
    S: SystemInLanes<SVector<f64, N>>
        + System<SVector<f64, N>, Class: Unconstrained>
        + Copy
        + 'static,
    B: systems::General<N> + Copy + 'static,
{
    let &Settings {
        end,
        gauss,
        stages,
        reference,
        ..
    } = settings;
    let mut entries = others::<S, N, M>(settings, system, start);
    let (problem, steps_to) = ((system, start.clone()), (end, gauss));
    entries.push(library(
        "Gauss 8, library",
        Gauss8,
        problem.clone(),
        steps_to,
        Ok::<Integrator<_, _, _, Compensated>, _>,
    ));
    entries.push(library(
        "Gauss 8, library, plain",
        Gauss8,
        problem.clone(),
        steps_to,
        move |mut made: Integrator<_, _, _, Plain>| {
            made.set_tolerance(stages)?;
            Ok(made)
        },
    ));
    entries.push(library(
        "Gauss 8, library, stage by stage",
        Gauss8,
        problem,
        steps_to,
        |made: Integrator<_, _, _, Compensated>| Ok(made.with_solver(FixedPoint)),
    ));
    let (q, p) = (start.q.data.0[0], start.p.data.0[0]);
    entries.push(entry("Gauss 8, by hand, plain", move || {
        let (mut q, mut p) = (q, p);
        let (h, steps) = steps(end, gauss);
        FirstOrder::<f64x8, 8>::new(&GAUSS, h).run(&by_hand, (&mut q, &mut p), stages, steps);
        Some([q, p].concat())
    }));
    for (name, step_size) in [("Gauss 8, by hand", gauss), ("reference", reference)] {
        entries.push(entry(name, move || {
            let (mut q, mut p) = (Double::new(q), Double::new(p));
            let (h, steps) = steps(end, step_size);
            NoDriftGeneral::<f64x8, 8>::new(&GAUSS, h).run(&by_hand, (&mut q, &mut p), steps);
            Some([q.high, p.high].concat())
        }));
    }
    entries
}

/// The larger of the relative errors of q and p in the 2-norm.
fn error(found: &[f64], reference: &[f64]) -> f64 {
    let half = reference.len() / 2;
    let relative = |a: &[f64], b: &[f64]| {
        let difference: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
        (difference / b.iter().map(|b| b * b).sum::<f64>()).sqrt()
    };
    let (q, p) = (
        relative(&found[..half], &reference[..half]),
        relative(&found[half..], &reference[half..]),
    );
    symplectic_tests::measure::largest(q, p)
}

/// The names of the entries, without the reference.
fn names(entries: &[Entry]) -> Vec<&'static str> {
    let timed = &entries[..entries.len() - 1];
    timed.iter().map(|entry| entry.name).collect()
}

/// Prints the errors of all entries.
fn errors(problem: &str, entries: &[Entry]) {
    let Some(reference) = entries.last().and_then(|entry| (entry.run)()) else {
        return;
    };
    for entry in &entries[..entries.len() - 1] {
        let error = (entry.run)().map_or(f64::NAN, |found| error(&found, &reference));
        println!("| {problem} | {} | {error:.1e} |", entry.name);
    }
}

macro_rules! problems {
    ($($name:ident: $entries:ident, $text:literal;)+) => {
        fn main() {
            println!("| problem | integrator | error |\n|---|---|---:|");
            $(errors($text, &$entries());)+
            divan::main();
        }

        $(#[divan::bench(args = names(&$entries()), sample_count = 20)]
        fn $name(bencher: Bencher<'_, '_>, name: &str) {
            let entries = $entries();
            let entry = entries.iter().find(|entry| entry.name == name);
            bencher.bench_local(|| black_box(entry.map(|entry| (entry.run)())));
        })+
    };
}

problems! {
    bench_kepler: kepler, "Kepler, e = 0.6, t = 125";
    bench_outer_planets: outer_planets, "outer solar system, 500 000 days";
    bench_galaxy: galaxy, "Hénon–Heiles, t = 10⁴";
    bench_pendulum: pendulum, "double pendulum, t = 100";
    bench_coupled: coupled, "(q² + 1)(p² + 1)/2, t = 100";
    bench_springs: springs, "FPUT springs, ω = 50, t = 200";
    bench_chain: long_chain, "FPUT chain, N = 1024, t = 100";
}
