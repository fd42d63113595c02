//! Tables of runs, written in one line.

use std::path::PathBuf;
use std::{fs, io};

use crate::common::methods::{ForestRuth, Gauss2, StoermerVerlet};
use crate::common::systems::point;
use symplectic::adaptive::{AdaptiveSteps, DistancePower};
use symplectic::files::{Recording, record_at, record_to};
use symplectic::nalgebra::{SVector, Vector1};
use symplectic::system::Named;
use symplectic::variational::LagrangianSteps;
use symplectic::{Error, Integrator, Scalar, SeparableHamiltonian, State, separable};

type Outcome = Result<(), Box<dyn std::error::Error>>;

symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
symplectic::hamiltonian! { Cubic q: [x], p: [px]; H = px^2/2 + x^2/2 - x^3/3 }
symplectic::hamiltonian! { Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q| }
symplectic::hamiltonian! { Clock q: [time], p: [rate]; H = rate^2/2 }
symplectic::lagrangian! { Relativistic q: [x], v: [vx]; L = -sqrt(1 - vx^2) - x^2/2 }

/// The same pendulum by hand.
struct ByHand;

impl SeparableHamiltonian for ByHand {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
        force[0] = -q[0].sin();
    }
}

impl Named for ByHand {
    const NAMES: [&'static [&'static str]; 2] = [&["angle"], &["momentum"]];
}

fn path(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("symplectic-{}-{name}", std::process::id()))
}

/// The lines of a file, which is then removed.
fn lines(path: &PathBuf) -> io::Result<Vec<String>> {
    let text = fs::read_to_string(path)?;
    fs::remove_file(path)?;
    Ok(text.lines().map(str::to_owned).collect())
}

#[test]
fn a_recorded_run_has_all_states_with_the_names_of_the_formula() -> Outcome {
    let path = path("steps.csv");
    let mut run = Integrator::new(StoermerVerlet, Pendulum, point(1.0, 0.0), 0.1)?;
    record_to(&mut run, 1.0, &path)?;
    let lines = lines(&path)?;
    assert_eq!((&*lines[0], lines.len()), ("time,a,pa", 12));
    let State { time, q, p } = run.state();
    assert_eq!(lines[11], format!("{time:?},{:?},{:?}", q[0], p[0]));
    Ok(())
}

#[test]
fn a_run_recorded_at_times_has_no_other_states() -> Outcome {
    let path = path("times.csv");
    let mut run = Integrator::new(StoermerVerlet, Pendulum, point(1.0, 0.0), 0.1)?;
    record_at(&mut run, &[0.0, 0.25, 1.0], &path)?;
    let lines = lines(&path)?;
    let times: Vec<&str> = lines
        .iter()
        .filter_map(|line| line.split(',').next())
        .collect();
    assert_eq!(times, ["time", "0.0", "0.25", "1.0"]);
    Ok(())
}

#[test]
fn runs_with_steps_of_variable_size_are_recorded() -> Outcome {
    let path = path("variable.csv");
    let start = State::from_arrays(0.0, [0.1, 0.0], [0.0, 4.0]);
    let monitor = DistancePower(1.5);
    let mut run = AdaptiveSteps::run(StoermerVerlet, Kepler, monitor, start, 0.05)?;
    record_to(&mut run, 1.0, &path)?;
    let lines = lines(&path)?;
    assert_eq!(lines[0], "time,q[0],q[1],p[0],p[1]");
    assert_eq!(lines.len() as u64, 2 + run.steps());
    Ok(())
}

#[test]
fn systems_by_hand_have_their_own_names_or_numbers() -> Outcome {
    let header = |table: Recording| -> io::Result<String> {
        let mut text = Vec::new();
        table.write_csv(&mut text)?;
        let text = String::from_utf8_lossy(&text).into_owned();
        Ok(text.lines().next().unwrap_or_default().to_owned())
    };
    let start = State::from_arrays(0.0, [1.0], [0.0]);
    let run = Integrator::new(ForestRuth, ByHand, start.clone(), 0.1)?;
    let table = Recording::of(run.system(), run.state())?;
    assert_eq!(header(table)?, "time,angle,momentum");
    let closures = separable::<Vector1<f64>, _, _>(
        |_, p, velocity| *velocity = *p,
        |_, q, force| force[0] = -q[0].sin(),
    );
    let run = Integrator::new(ForestRuth, closures, start, 0.1)?;
    let table = Recording::of(run.system(), run.state())?;
    assert_eq!(header(table)?, "time,q[0],p[0]");
    let two = State::from_arrays(0.0, [1.0; 2], [0.0; 2]);
    let failure = Recording::of(&ByHand, &two).expect_err("two names for four components");
    assert!(failure.to_string().contains("4 components"), "{failure}");
    Ok(())
}

#[test]
fn a_lagrangian_that_has_no_hamiltonian_has_names_of_momenta() -> Outcome {
    let start = State::from_arrays(0.0, [0.5], [0.0]);
    let mut run = LagrangianSteps::run(Gauss2, Relativistic, start, 0.1)?;
    let mut table = Recording::of(&Relativistic, run.state())?;
    table.record(run.step()?);
    let mut text = Vec::new();
    table.write_csv(&mut text)?;
    assert!(text.starts_with(b"time,x,px\n0.0,0.5,0.0\n0.1,"));
    Ok(())
}

#[test]
fn a_run_that_fails_leaves_the_states_before_its_error() -> Outcome {
    let path = path("failure.csv");
    // It escapes to infinity.
    let mut run = Integrator::new(StoermerVerlet, Cubic, point(1.5, 0.0), 0.1)?;
    let failure = record_to(&mut run, 100.0, &path).expect_err("an escape");
    let inner = failure
        .get_ref()
        .and_then(|error| error.downcast_ref::<Error>());
    assert!(inner.is_some(), "{failure:?}");
    assert_eq!(lines(&path)?.len() as u64, 2 + run.steps());
    Ok(())
}

#[test]
fn a_file_that_cannot_be_written_is_refused_before_the_run() -> Outcome {
    let mut run = Integrator::new(StoermerVerlet, Pendulum, point(1.0, 0.0), 0.1)?;
    for name in ["run.txt", "no-such-folder/run.csv"] {
        record_to(&mut run, 1.0, path(name)).expect_err("a wrong path");
        assert_eq!(run.steps(), 0);
    }
    // This column would have the name of the time.
    let mut clock = Integrator::new(StoermerVerlet, Clock, point(0.0, 1.0), 0.1)?;
    let failure = record_to(&mut clock, 1.0, path("clock.csv")).expect_err("two times");
    assert!(failure.to_string().contains("\"time\""), "{failure}");
    Ok(())
}
