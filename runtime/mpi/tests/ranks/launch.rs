//! Starts ranks by `mpirun`.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use std::{env, fs, thread};

/// A folder for a test, empty at first; none, with a word, where there is no `mpirun`.
#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
pub fn folder(name: &str) -> Option<PathBuf> {
    let found = Command::new("mpirun").arg("--version").output();
    if !found.is_ok_and(|output| output.status.success()) {
        eprintln!("no mpirun: {name} is skipped");
        return None;
    }
    Some(empty_folder(name))
}

pub fn empty_folder(name: &str) -> PathBuf {
    let folder = env::temp_dir().join(format!("symplectic-mpi-{}-{name}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// `mpirun` with ranks of [`program`](crate::program::program), started through `before` if there is anything.
pub fn start(folder: &Path, ranks: usize, mode: &str, before: &[&str]) -> Child {
    let mut command = Command::new("mpirun");
    command
        .args(["-n", &ranks.to_string()])
        .args(before)
        .arg(env::current_exe().expect("this program"))
        .args(["--exact", "program::program"])
        .env("SYMPLECTIC_RANKS", folder)
        .env("SYMPLECTIC_MODE", mode)
        // As root, and with more ranks than cores: of Open MPI 4, then 5.
        .env("OMPI_ALLOW_RUN_AS_ROOT", "1")
        .env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
        .env("OMPI_MCA_rmaps_base_oversubscribe", "1")
        .env("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe")
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command.spawn().expect("mpirun")
}

/// Whether it ends well. One that has not ended after ten minutes hangs.
pub fn ends_well(mut mpirun: Child) -> bool {
    let began = Instant::now();
    loop {
        if let Some(status) = mpirun.try_wait().expect("mpirun") {
            return status.success();
        }
        if began.elapsed() > Duration::from_secs(600) {
            mpirun.kill().expect("mpirun");
            panic!("mpirun hangs");
        }
        thread::sleep(Duration::from_millis(10));
    }
}

/// What every rank says in the end.
pub fn run(folder: &Path, ranks: usize, mode: &str) -> Vec<String> {
    assert!(ends_well(start(folder, ranks, mode, &[])));
    outcomes(folder, ranks)
}

pub fn outcomes(folder: &Path, ranks: usize) -> Vec<String> {
    let outcome = |rank| fs::read_to_string(folder.join(format!("outcome-{rank}")));
    (0..ranks)
        .map(|rank| outcome(rank).expect("an outcome"))
        .collect()
}

/// Blocks found, damaged, and run on all ranks.
pub fn summary(outcomes: &[String]) -> [usize; 3] {
    let numbers = |text: &String| -> Vec<usize> {
        let number = |word: &str| word.parse().expect("a number");
        text.split(' ').map(number).collect()
    };
    let all: Vec<Vec<usize>> = outcomes.iter().map(numbers).collect();
    // All ranks know the first two.
    assert!(all.iter().all(|own| own[..2] == all[0][..2]), "{all:?}");
    [all[0][0], all[0][1], all.iter().map(|own| own[2]).sum()]
}
