//! What every rank does, and the same without MPI.

use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;
use std::{env, fs, process, thread};

use symplectic::State;
use symplectic::ensemble::{Ensemble, Npz, WriteEnsemble};
use symplectic::nalgebra::Vector1;
use symplectic_mpi::mpi::{self, Threading, traits::Communicator};
use symplectic_mpi::{Blocks, Error};

symplectic::tableau! { pub VelocityVerlet { base: velocity-verlet } }
symplectic::hamiltonian! { pub Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }

pub type Pendulums = Ensemble<VelocityVerlet, Pendulum, Vector1<f64>>;

pub const TRAJECTORIES: usize = 31;
pub const BLOCKS: usize = 12;
pub const STEP: f64 = 0.01;
pub const END: f64 = 60.0;

/// Swings from narrow to wide. Two trajectories overflow, at other times: their errors have other lengths.
pub fn pendulums(step: f64) -> Pendulums {
    let start = |k: usize| match k {
        5 => State::from_arrays(0.0, [0.1], [1e307]),
        17 => State::from_arrays(0.0, [0.1], [1.7e308]),
        _ => State::from_arrays(0.0, [0.1 * k as f64], [0.0]),
    };
    let starts = (0..TRAJECTORIES).map(start).collect();
    Ensemble::new(VelocityVerlet, Pendulum, starts, step).expect("starts")
}

/// Rows, and the angles beyond 1: none in the first blocks, thousands in the last ones.
pub fn work<W: Write>(ensemble: &Pendulums, file: &mut Npz<W>) -> io::Result<()> {
    let times: Vec<f64> = (0..6000).map(|k| f64::from(k) * (END / 6000.0)).collect();
    let see = |wide: &mut Vec<f64>, state: &State<Vector1<f64>>| {
        if state.q[0].abs() > 1.0 {
            wide.push(state.q[0]);
        }
    };
    let mut rows = Vec::new();
    ensemble.integrate_at(
        &times,
        |_| Vec::new(),
        see,
        |row| {
            rows.push(row);
            ControlFlow::Continue(())
        },
    );
    file.rows(&rows)?;
    let wide: Vec<f64> = rows.iter().flat_map(|row| &row.output).copied().collect();
    file.doubles("wide", &[wide.len()], &wide)
}

/// The file of one process, without blocks.
pub fn plain() -> Vec<u8> {
    let ensemble = pendulums(STEP);
    let mut file = Npz::new(Vec::new());
    file.facts(&ensemble).expect("room");
    file.doubles("end", &[], &[END]).expect("room");
    work(&ensemble, &mut file).expect("room");
    file.finish().expect("room")
}

pub fn blocks<'a>(ensemble: &'a Pendulums, folder: &Path, count: usize) -> Result<Of<'a>, Error> {
    Blocks::new(ensemble, folder.join("blocks"), count, |file| {
        file.doubles("end", &[], &[END])
    })
}

type Of<'a> = Blocks<'a, VelocityVerlet, Pendulum, Vector1<f64>>;

/// The blocks that are there.
pub fn complete(folder: &Path) -> usize {
    let entries = fs::read_dir(folder.join("blocks")).into_iter().flatten();
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    names
        .filter(|name| name.to_string_lossy().ends_with(".npz"))
        .count()
}

/// One rank. It does nothing unless [`launch`](crate::launch) has set the variables.
#[test]
fn program() {
    let Some(folder) = env::var_os("SYMPLECTIC_RANKS") else {
        return;
    };
    let folder = Path::new(&folder);
    let mode = env::var("SYMPLECTIC_MODE").expect("a mode");
    let level = match mode.as_str() {
        "single" => Threading::Single,
        _ => Threading::Funneled,
    };
    let (universe, level) = mpi::initialize_with_threading(level).expect("MPI is started once");
    let world = universe.world();
    let rank = world.rank();
    let note = |name: &str, text: String| {
        fs::write(folder.join(format!("{name}-{rank}")), text).expect("a file");
    };
    note("pid", process::id().to_string());
    let (step, count) = match mode.as_str() {
        "half" => (STEP / 2.0, BLOCKS),
        "half on rank 1" if rank == 1 => (STEP / 2.0, BLOCKS),
        "other blocks" => (STEP, BLOCKS + 1),
        "other blocks on rank 1" if rank == 1 => (STEP, BLOCKS + 1),
        _ => (STEP, BLOCKS),
    };
    let ensemble = pendulums(step);
    let blocks = match mode.as_str() {
        "other end" => Blocks::new(&ensemble, folder.join("blocks"), count, |file| {
            file.doubles("end", &[], &[END / 2.0])
        }),
        _ => blocks(&ensemble, folder, count),
    };
    let blocks = blocks.expect("blocks");
    let outcome = blocks.run(&world, |block, file| {
        match mode.as_str() {
            "hold" if rank == 1 => {
                note("here", String::new());
                thread::sleep(Duration::from_secs(600));
            }
            // Unless the others take all other blocks, it waits for ever.
            "steal" if rank == 1 => {
                while complete(folder) < BLOCKS - 1 {
                    thread::sleep(Duration::from_millis(5));
                }
            }
            "panic on rank 0" if rank == 0 => panic!("as it should"),
            "panic on rank 1" if rank == 1 => panic!("as it should"),
            "stop" if rank == 1 => return file.integers("trajectory", &[1], &[0]),
            _ => {}
        }
        work(block, file)
    });
    let text = match outcome {
        Ok(summary) => format!("{} {} {}", summary.found, summary.damaged, summary.run),
        Err(Error::Threading) if level < Threading::Funneled => "one thread".to_owned(),
        Err(error) => error.to_string(),
    };
    if text.starts_with(|c: char| c.is_ascii_digit()) && rank == 0 {
        blocks.merge(folder.join("merged.npz")).expect("all blocks");
    }
    note("outcome", text);
}
