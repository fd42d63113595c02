//! The recorded references: complete, good to twenty digits, recomputed where that is cheap, and reached by the library as
//! far as doubles go.

use std::error::Error;

use symplectic::system::Unconstrained;
use symplectic::{Integrator, State, System, Vector};
use symplectic_tests::methods::Gauss8;
use symplectic_tests::references::{ALL, Collocation, Record, find, records};
use symplectic_tests::scenes::*;

/// The record of a run.
fn record(scene: &str, parameters: &str) -> &'static Record {
    let mut records = records().iter();
    let record = records.find(|r| r.scene == scene && r.parameters == parameters);
    record.expect("a recorded scene")
}

#[test]
fn every_run_is_recorded_once_to_twenty_digits() {
    assert_eq!(records().len(), ALL.len());
    for (run, record) in ALL.iter().zip(records()) {
        assert!(run.is_of(record), "{} {}", run.scene, run.parameters);
        let agreement: f64 = record.agreement.parse().expect("a number");
        assert!(agreement < 1e-20, "{} {agreement:e}", run.scene);
        // The finer run is another one, and as many digits are there as are said to be.
        assert!(record.steps[1] > record.steps[0]);
        assert_eq!(record.q.len(), record.p.len());
        for digits in record.q.iter().chain(&record.p) {
            let (mantissa, _) = digits.split_once('e').expect("a power of ten");
            let count = mantissa.chars().filter(char::is_ascii_digit).count();
            assert!(count == 30 || digits.parse() == Ok(0.0), "{digits}");
        }
    }
}

#[test]
fn a_record_is_found_by_scene_parameters_time_and_dimension() {
    use symplectic::nalgebra::{Vector1, Vector2};
    let known: Option<State<Vector1<f64>>> = find("nonseparable", "", 100.0);
    assert_eq!(known.map(|state| state.time), Some(100.0));
    assert_eq!(find::<Vector1<f64>>("nonseparable", "", 99.0), None);
    assert_eq!(find::<Vector1<f64>>("nonseparable", "e = 0", 100.0), None);
    assert_eq!(find::<Vector2<f64>>("nonseparable", "", 100.0), None);
}

#[test]
fn a_recomputation_gives_the_recorded_digits() -> Result<(), Box<dyn Error>> {
    let tableau = symplectic_compiler::derive("polynomial(16)", "gauss(16)")?;
    let decimals = tableau
        .numbers()
        .map(|number| number.decimal(70).to_string());
    let method = Collocation::from_decimals(&decimals.a, &decimals.b).ok_or("not a decimal")?;
    let run = ALL.iter().find(|run| run.scene == "damped particle");
    let run = run.ok_or("no such run")?;
    let known = record(run.scene, run.parameters);
    let agreement: f64 = known.agreement.parse()?;
    // The coarser run is as far off as it was.
    let distance = known.distance(run, &method, run.step)?;
    assert!((distance / agreement - 1.0).abs() < 0.1, "{distance:e}");
    // One digit that is wrong is seen, even the 25th.
    let mut wrong = known.clone();
    let digit = if wrong.q[0].as_bytes()[27] == b'5' {
        "6"
    } else {
        "5"
    };
    wrong.q[0].replace_range(27..28, digit);
    let distance = wrong.distance(run, &method, run.step)?;
    assert!(distance > 1.5 * agreement, "{distance:e}");
    Ok(())
}

/// The larger relative distance of the halves from the recorded state, after steps of Gauss with eight stages.
fn error<V, S>(
    system: S,
    start: State<V>,
    recorded: Option<State<V>>,
    step_size: f64,
) -> Result<f64, Box<dyn Error>>
where
    V: Vector<Scalar = f64>,
    S: System<V, Class: Unconstrained>,
{
    let recorded = recorded.ok_or("not recorded")?;
    let mut integrator = Integrator::new(Gauss8, system, start, step_size)?;
    let end = integrator.integrate_to(recorded.time)?;
    let distance = |found: &V, expected: &V| {
        let pairs = found.as_slice().iter().zip(expected.as_slice());
        let square: f64 = pairs.map(|(a, b)| (a - b).powi(2)).sum();
        (square / expected.as_slice().iter().map(|x| x * x).sum::<f64>()).sqrt()
    };
    Ok(distance(&end.q, &recorded.q).max(distance(&end.p, &recorded.p)))
}

#[test]
fn errors_to_the_references_stay_within_rounding() -> Result<(), Box<dyn Error>> {
    let springs = |omega: f64, time: f64, step: f64| {
        let system = fput_springs::FputSprings { omega };
        error(
            system,
            fput_springs::start(omega),
            fput_springs::recorded(omega, time),
            step,
        )
    };
    // The bounds are measured errors with a margin: some 2⁻⁵³ a step, times the factor by which orbits part from their
    // neighbours, which is large for chaotic ones.
    for (name, error, bound) in [
        (
            "damped particle",
            error(
                damped_particle::DampedParticle,
                damped_particle::start(),
                damped_particle::recorded(100.0),
                0.0625,
            )?,
            1e-11,
        ),
        (
            "nonseparable",
            error(
                nonseparable::Nonseparable,
                nonseparable::start(),
                nonseparable::recorded(100.0),
                0.03125,
            )?,
            1e-12,
        ),
        (
            "double pendulum",
            error(
                double_pendulum::DoublePendulum,
                double_pendulum::start(),
                double_pendulum::recorded(100.0),
                0.03125,
            )?,
            1e-9,
        ),
        (
            "charged particle",
            error(
                charged_particle::ChargedParticle,
                charged_particle::start(),
                charged_particle::recorded(100.0),
                0.03125,
            )?,
            1e-8,
        ),
        (
            "post-Newtonian Kepler",
            error(
                post_newtonian_kepler::EQUAL_MASSES,
                post_newtonian_kepler::start(),
                post_newtonian_kepler::recorded(125.0),
                0.0625,
            )?,
            1e-11,
        ),
        (
            "point vortices",
            error(
                point_vortices::FOUR,
                point_vortices::start(),
                point_vortices::recorded(50.0),
                0.0625,
            )?,
            1e-10,
        ),
        (
            "FPUT chain",
            error(
                fput_chain::system(),
                fput_chain::start(16),
                fput_chain::recorded(16, 100.0),
                0.125,
            )?,
            1e-11,
        ),
        (
            "FPUT springs, ω = 50",
            springs(50.0, 200.0, 1.0 / 64.0)?,
            1e-8,
        ),
        (
            "FPUT springs, ω = 1000",
            springs(1e3, 1.0, 1.0 / 1024.0)?,
            1e-11,
        ),
        (
            "FPUT springs, ω = 100000",
            springs(1e5, 1.0 / 64.0, 1.0 / 131_072.0)?,
            1e-10,
        ),
        (
            "sine-Gordon lattice",
            error(
                sine_gordon::system(),
                sine_gordon::start(),
                sine_gordon::recorded(10.0),
                0.125,
            )?,
            1e-12,
        ),
        (
            "argon crystal",
            error(
                argon_crystal::ArgonCrystal,
                argon_crystal::start(),
                argon_crystal::recorded(0.02),
                5e-5,
            )?,
            1e-10,
        ),
        (
            "outer solar system",
            error(
                outer_solar_system::OuterSolarSystem,
                outer_solar_system::start(),
                outer_solar_system::recorded(500_000.0),
                200.0,
            )?,
            1e-11,
        ),
        (
            "Hénon–Heiles, E = 1/8",
            error(
                henon_heiles::HenonHeiles,
                henon_heiles::start(),
                henon_heiles::recorded(1e4),
                0.5,
            )?,
            1e-10,
        ),
        (
            "Hénon–Heiles, E = 1/12",
            error(
                henon_heiles::HenonHeiles,
                henon_heiles::start_at_one_twelfth(),
                henon_heiles::recorded_at_one_twelfth(1e4),
                0.5,
            )?,
            1e-10,
        ),
    ] {
        assert!(error < bound, "{name}: {error:e}");
    }
    Ok(())
}
