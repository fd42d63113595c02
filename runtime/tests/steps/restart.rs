//! A run that is saved, dropped and restored has the bits of the run that went on: chains, settings, files. For the methods and solvers
//! see `matrix.rs`.

use crate::common::methods::{Gauss3, Gauss8, Lobatto3, StoermerVerlet};
use crate::common::systems::Kepler;
use proptest::prelude::*;
use symplectic::emitted::{Bonds, Chain};
use symplectic::nalgebra::{DVector, SVector};
use symplectic::solver::{Banded, ByNewton, Differences, Newton, Solver};
use symplectic::{
    Checkpoint, CheckpointError, Error, Integrator, Method, ProvedFor, Retry, Scalar, Separable,
    SeparableHamiltonian, State, Summation, System, Vector,
};

/// H = |p|²/(2 m) − 1/|q|
#[derive(Clone, Copy)]
struct HeavyKepler {
    mass: f64,
}

impl SeparableHamiltonian for HeavyKepler {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = p / T::from_f64(self.mass);
    }

    fn force<T: Scalar>(&self, time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        SeparableHamiltonian::force(&Kepler, time, q, force);
    }
}

/// V(d) = d²/2 + d⁴/4
#[derive(Clone, Copy)]
struct Beta;

impl Bonds for Beta {
    fn tension<T: Scalar>(&self, _time: T, d: T) -> T {
        d + d * d * d
    }
}

/// Steps before runs are saved, from one to the next: any.
const BREAKS: [u64; 6] = [1, 3, 2, 17, 1, 40];

fn check<M: Method, S: System<V> + Copy, V: Vector, R: Summation, N: Solver<V, S>>(
    made: impl Fn() -> Result<Integrator<M, S, V, R, N>, Error>,
) -> Result<(), Error> {
    check_at(&BREAKS, made)
}

/// A run that is saved and restored, and one that is cloned, after each of these numbers of steps, beside the one that goes on.
fn check_at<M: Method, S: System<V> + Copy, V: Vector, R: Summation, N: Solver<V, S>>(
    breaks: &[u64],
    made: impl Fn() -> Result<Integrator<M, S, V, R, N>, Error>,
) -> Result<(), Error> {
    let mut whole = made()?;
    let mut cloned = made()?;
    let mut saved = made()?.checkpoint().expect("doubles or singles");
    for &steps in breaks {
        let mut resumed = made()?;
        resumed.restore(&saved).expect("the same run");
        let mut copy = cloned.clone();
        for integrator in [&mut whole, &mut resumed, &mut copy] {
            // Some of them by themselves.
            integrator.take_steps(steps / 2)?;
            for _ in steps / 2..steps {
                integrator.step()?;
            }
        }
        for other in [&resumed, &copy] {
            assert_eq!(other.state(), whole.state(), "{}", M::NAME);
            assert_eq!(other.remainder(), whole.remainder(), "{}", M::NAME);
            assert_eq!(other.statistics(), whole.statistics(), "{}", M::NAME);
        }
        saved = resumed.checkpoint().expect("doubles or singles");
        assert_eq!(Ok(&saved), whole.checkpoint().as_ref(), "{}", M::NAME);
        cloned = copy;
    }
    Ok(())
}

fn kepler() -> State<SVector<f64, 2>> {
    State::new(0.0, SVector::from([0.6, 0.0]), SVector::from([0.0, 1.5]))
}

fn waves(n: usize) -> State<DVector<f64>> {
    let wave = |phase: f64| DVector::from_fn(n, |i, _| 0.3 * (phase + 1.7 * i as f64).sin());
    State::new(0.0, wave(0.1), wave(1.3))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    #[ignore = "thorough"]
    fn runs_restart_at_random_steps(
        breaks in proptest::collection::vec(0_u64..60, 1..6),
        size in 0.01..0.3,
    ) {
        let kepler = || (HeavyKepler { mass: 1.3 }, kepler());
        let result = (|| {
            let made = |(system, start)| Integrator::new(StoermerVerlet, system, start, size);
            check_at(&breaks, || made(kepler()))?;
            let made = |(system, start)| Integrator::new(Gauss8, system, start, size);
            check_at(&breaks, || made(kepler()))?;
            check_at(&breaks, || Ok(made(kepler())?.by_newton()))?;
            let made = |(system, start)| Integrator::plain(Lobatto3, system, start, size);
            check_at(&breaks, || made(kepler()))
        })();
        prop_assert_eq!(result, Ok(()));
    }
}

/// Long vectors: a ring of particles.
#[test]
#[ignore = "thorough"]
fn restored_chains_have_the_bits_of_those_that_went_on() -> Result<(), Error> {
    fn all<M: Method + Copy + ProvedFor<Separable>>(method: M) -> Result<(), Error> {
        for n in [17, 64] {
            let chain = Chain::ring(Beta);
            check(|| Integrator::new(method, chain, waves(n), 0.1))?;
            check(|| Integrator::plain(method, chain, waves(n), 0.1))?;
        }
        Ok(())
    }
    all(StoermerVerlet)?;
    all(Gauss3)?;
    all(Gauss8)?;
    all(Lobatto3)?;
    // A new integrator has not yet made room for the matrices.
    check(|| Ok(Integrator::new(Gauss3, Chain::between_walls(Beta), waves(17), 0.1)?.by_newton()))?;
    check(|| {
        let banded = Newton::<Banded<1, Differences>>::new();
        let chain = Chain::between_walls(Beta);
        Ok(Integrator::new(Gauss3, chain, waves(17), 0.1)?.with_solver(banded))
    })
}

#[test]
fn singles_and_settings_are_saved_too() -> Result<(), Error> {
    let start = State::new(
        0.0_f64,
        SVector::from([0.6_f32, 0.0]),
        SVector::from([0.0, 1.5]),
    );
    check(|| Integrator::new(Gauss3, HeavyKepler { mass: 1.0 }, start.clone(), 0.1))?;

    let mut set = Integrator::plain(Gauss3, HeavyKepler { mass: 1.0 }, kepler(), 0.1)?;
    set.set_tolerance(1e-6)?;
    set.set_max_iterations(33);
    set.set_retry(Retry::Split { halvings: 3 });
    set.set_step_size(0.05)?;
    set.take_steps(3)?;
    let mut restored = Integrator::plain(Gauss3, HeavyKepler { mass: 1.0 }, kepler(), 0.2)?;
    restored
        .restore(&set.checkpoint().expect("doubles"))
        .expect("the same run");
    assert_eq!(restored.integrate_to(3.0)?, set.integrate_to(3.0)?);
    assert_eq!(restored.statistics(), set.statistics());
    Ok(())
}

/// A checkpoint of another run is refused, and the integrator goes on as if nothing had been.
#[test]
fn checkpoints_of_other_runs_are_refused() -> Result<(), Error> {
    let heavy = HeavyKepler { mass: 2.0 };
    let saved = |made: Result<Checkpoint, CheckpointError>| made.expect("doubles");
    let checkpoint = saved(Integrator::new(Gauss3, heavy, kepler(), 0.1)?.checkpoint());
    fn refused<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>>(
        mut integrator: Integrator<M, S, V, R, N>,
        checkpoint: &Checkpoint,
    ) -> CheckpointError {
        let before = integrator.checkpoint();
        let error = integrator.restore(checkpoint).expect_err("another run");
        assert_eq!(integrator.checkpoint(), before);
        error
    }
    let of = |error: CheckpointError| match error {
        CheckpointError::OtherRun { what, .. } => what,
        other => panic!("{other}"),
    };
    let method = Integrator::new(Gauss8, heavy, kepler(), 0.1)?;
    assert_eq!(of(refused(method, &checkpoint)), "method");
    let sums = Integrator::plain(Gauss3, heavy, kepler(), 0.1)?;
    assert_eq!(of(refused(sums, &checkpoint)), "sums");
    let solver = Integrator::new(Gauss3, heavy, kepler(), 0.1)?.by_newton();
    assert_eq!(of(refused(solver, &checkpoint)), "solver");
    let dimension = Integrator::new(Gauss3, Chain::ring(Beta), waves(3), 0.1)?;
    assert_eq!(of(refused(dimension, &checkpoint)), "dimension");
    let light = Integrator::new(Gauss3, HeavyKepler { mass: 1.0 }, kepler(), 0.1)?;
    let error = refused(light, &checkpoint);
    assert_eq!(error, CheckpointError::OtherSystem);
    assert_eq!(
        error.to_string(),
        "the system gives another velocity, force, constraint, Lagrangian, flow, moment of inertia or torque at or near the state of the \
         checkpoint: it is another system, or has other parameters"
    );
    Ok(())
}

/// Dual numbers cannot be saved: they say so.
#[test]
#[cfg(feature = "num-dual")]
fn other_numbers_are_refused() -> Result<(), Error> {
    let two = |x: f64, y: f64| SVector::from([x.into(), y.into()]);
    let start: State<SVector<num_dual::Dual64, 2>> = State::new(0.0, two(0.6, 0.0), two(0.0, 1.5));
    let integrator = Integrator::new(Gauss3, HeavyKepler { mass: 1.0 }, start, 0.1)?;
    assert_eq!(integrator.checkpoint(), Err(CheckpointError::Scalar));
    Ok(())
}

#[cfg(feature = "serde")]
mod files {
    use std::path::Path;
    use std::process::{Child, Command};
    use std::time::Duration;
    use std::{env, fs, thread};

    use super::*;

    /// The variable that names the checkpoint of the process that is killed.
    const FILE: &str = "SYMPLECTIC_TEST_CHECKPOINT";

    /// A process that does not survive a test that fails.
    struct Killed(Child);

    impl Drop for Killed {
        fn drop(&mut self) {
            self.0.kill().expect("killed");
            self.0.wait().expect("ended");
        }
    }

    /// A process that saves its run after every hundred steps is killed, three times, at any of them. The last one goes on to the bits of a
    /// run that was never interrupted.
    #[test]
    fn a_killed_process_is_continued() -> Result<(), Error> {
        const NAME: &str = "restart::files::a_killed_process_is_continued";
        let made = || Integrator::new(Gauss8, HeavyKepler { mass: 1.3 }, kepler(), 0.1);
        let read = |path: &Path| -> Option<Checkpoint> {
            serde_json::from_str(&fs::read_to_string(path).ok()?).ok()
        };
        if let Some(path) = env::var_os(FILE) {
            let (path, mut run) = (Path::new(&path), made()?);
            if let Some(checkpoint) = read(path) {
                run.restore(&checkpoint).expect("the same run");
            }
            // It is killed much earlier.
            for _ in 0..100_000 {
                run.take_steps(100)?;
                let text = serde_json::to_string(&run.checkpoint().expect("doubles"));
                let new = path.with_extension("new");
                fs::write(&new, text.expect("a checkpoint")).expect("written");
                fs::rename(&new, path).expect("the old one is replaced as a whole");
            }
            return Ok(());
        }
        let path = env::temp_dir().join(format!("symplectic-killed-{}.json", std::process::id()));
        let _ = fs::remove_file(&path);
        let mut steps = 0;
        for _ in 0..3 {
            let process = Command::new(env::current_exe().expect("this test"))
                .args(["--exact", NAME])
                .env(FILE, &path)
                .spawn()
                .expect("a process");
            let mut process = Killed(process);
            let last = loop {
                thread::sleep(Duration::from_millis(20));
                assert_eq!(process.0.try_wait().expect("its status"), None, "it ended");
                let mut run = made()?;
                if let Some(checkpoint) = read(&path) {
                    run.restore(&checkpoint).expect("the same run");
                }
                if run.statistics().steps > steps {
                    break run.statistics().steps;
                }
            };
            drop(process);
            steps = last;
        }
        let mut resumed = made()?;
        let checkpoint = read(&path).expect("a whole file");
        resumed.restore(&checkpoint).expect("the same run");
        let mut whole = made()?;
        whole.take_steps(resumed.statistics().steps)?;
        assert_eq!(resumed.take_steps(50)?, whole.take_steps(50)?);
        assert_eq!(resumed.statistics(), whole.statistics());
        assert_eq!(resumed.checkpoint(), whole.checkpoint());
        fs::remove_file(&path).expect("removed");
        // A file that was not renamed any more.
        let _ = fs::remove_file(path.with_extension("new"));
        Ok(())
    }

    /// The same after a file, which is refused where one character is another one, or where it ends too early.
    #[test]
    fn files_are_read_as_they_were_written_or_not_at_all() -> Result<(), Error> {
        let made = || Integrator::new(Gauss3, HeavyKepler { mass: 1.0 }, kepler(), 0.1);
        let mut whole = made()?;
        whole.take_steps(7)?;
        let checkpoint = whole.checkpoint().expect("doubles");
        let text = serde_json::to_string(&checkpoint).expect("a checkpoint");
        let read: Checkpoint = serde_json::from_str(&text).expect("the same checkpoint");
        let mut resumed = made()?;
        resumed.restore(&read).expect("the same run");
        assert_eq!(resumed.take_steps(50)?, whole.take_steps(50)?);

        for place in 0..text.len() {
            let mut changed = text.clone().into_bytes();
            changed[place] = if changed[place] == b'1' { b'2' } else { b'1' };
            let Ok(changed) = String::from_utf8(changed) else {
                continue;
            };
            if let Ok(read) = serde_json::from_str::<Checkpoint>(&changed) {
                let before = resumed.checkpoint();
                assert!(resumed.restore(&read).is_err(), "{place}");
                assert_eq!(resumed.checkpoint(), before);
            }
        }
        for length in 0..text.len() {
            assert!(serde_json::from_str::<Checkpoint>(&text[..length]).is_err());
        }
        Ok(())
    }

    /// A text has digits and a checksum of its characters: files of earlier builds are read, and new ones are the same.
    #[test]
    fn a_text_has_sixteen_digits_for_each_word() -> Result<(), Error> {
        let mut run = Integrator::new(Gauss3, HeavyKepler { mass: 1.0 }, kepler(), 0.1)?;
        run.take_steps(7)?;
        let checkpoint = run.checkpoint().expect("doubles");
        let text = serde_json::to_value(&checkpoint).expect("a checkpoint");
        assert_eq!(text["checksum"], checksum(&text));
        let words = text["words"].as_str().expect("digits");
        // The time, the step size, the position.
        let word = |x: f64| format!("{:016x}", x.to_bits());
        let state = run.state();
        let start = [state.time, 0.1, state.q[0], state.q[1]].map(word).concat();
        assert!(words.starts_with(&start) && words.len().is_multiple_of(16));
        assert_eq!(text.as_object().map(serde_json::Map::len), Some(10));
        Ok(())
    }

    /// The checksum of a text: FNV-1a, with a byte after each field that is in no text.
    fn checksum(text: &serde_json::Value) -> String {
        let names = [
            "version",
            "method",
            "definition",
            "scalar",
            "sums",
            "solver",
        ];
        let mut fields: Vec<String> = text["format"]
            .as_u64()
            .map(|format| format.to_string())
            .into_iter()
            .collect();
        let texts = names
            .iter()
            .map(|&name| text[name].as_str().expect("a text"));
        fields.extend(texts.map(str::to_owned));
        fields.push(text["dimension"].to_string());
        fields.push(text["words"].as_str().expect("digits").to_owned());
        let bytes = fields.iter().flat_map(|field| field.bytes().chain([0xff]));
        let sum = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        format!("{sum:016x}")
    }

    #[test]
    fn checkpoints_of_other_versions_are_read_if_they_have_the_same_format() -> Result<(), Error> {
        let made = || Integrator::new(Gauss3, HeavyKepler { mass: 1.0 }, kepler(), 0.1);
        let mut whole = made()?;
        whole.take_steps(7)?;
        let checkpoint = whole.checkpoint().expect("doubles");
        let mut text = serde_json::to_value(&checkpoint).expect("a checkpoint");
        let read = |text: &serde_json::Value| -> Result<_, Error> {
            let read: Checkpoint = serde_json::from_value(text.clone()).expect("a checkpoint");
            let mut resumed = made()?;
            let restored = resumed.restore(&read);
            Ok(restored.map(|()| resumed))
        };
        text["version"] = "0.0.9".into();
        text["checksum"] = checksum(&text).into();
        let resumed = read(&text)?.expect("the same format");
        assert_eq!(resumed.state(), whole.state());
        // The first files have no number.
        text.as_object_mut().expect("fields").remove("format");
        text["checksum"] = checksum(&text).into();
        assert!(read(&text)?.is_ok());
        text["format"] = 4.into();
        text["checksum"] = checksum(&text).into();
        let Err(error) = read(&text)? else {
            panic!("a later format");
        };
        let error = error.to_string();
        assert!(
            error.starts_with("the checkpoint has format 4 and was written by version 0.0.9"),
            "{error}"
        );
        Ok(())
    }

    /// Half the size of the digits; refused where one byte is another one, or where it ends too early.
    #[test]
    fn a_binary_file_has_eight_bytes_for_each_word() -> Result<(), Error> {
        let made = || Integrator::new(Gauss3, HeavyKepler { mass: 1.0 }, kepler(), 0.1);
        let mut whole = made()?;
        whole.take_steps(7)?;
        let checkpoint = whole.checkpoint().expect("doubles");
        let text = serde_json::to_value(&checkpoint).expect("a checkpoint");
        let digits = text["words"].as_str().expect("digits").len();
        let file = postcard::to_allocvec(&checkpoint).expect("a checkpoint");
        let others: usize = [
            "version",
            "method",
            "definition",
            "scalar",
            "sums",
            "solver",
        ]
        .map(|name| text[name].as_str().map_or(0, str::len))
        .iter()
        .sum();
        // Beside the other texts, sixteen digits of the checksum, the format, and lengths of at most two bytes.
        assert!(
            file.len() <= digits / 2 + others + 16 + 1 + 2 * 9,
            "{}",
            file.len()
        );
        let read: Checkpoint = postcard::from_bytes(&file).expect("the same checkpoint");
        assert_eq!(read, checkpoint);
        let mut resumed = made()?;
        resumed.restore(&read).expect("the same run");
        assert_eq!(resumed.take_steps(50)?, whole.take_steps(50)?);
        for place in 0..file.len() {
            let mut changed = file.clone();
            changed[place] ^= 1;
            if let Ok(read) = postcard::from_bytes::<Checkpoint>(&changed) {
                let before = resumed.checkpoint();
                assert!(resumed.restore(&read).is_err(), "{place}");
                assert_eq!(resumed.checkpoint(), before);
            }
            assert!(postcard::from_bytes::<Checkpoint>(&file[..place]).is_err());
        }
        Ok(())
    }
}
