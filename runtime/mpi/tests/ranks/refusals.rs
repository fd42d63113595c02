//! What is refused, and with what words.

use std::fs;

use symplectic_mpi::Error;

use crate::launch::{empty_folder, folder, run, summary};
use crate::program::{BLOCKS, STEP, TRAJECTORIES, blocks, pendulums};

#[test]
fn blocks_refuse_a_wrong_count_and_a_resumed_ensemble() {
    let folder = empty_folder("counts");
    let ensemble = pendulums(STEP);
    for count in [0, TRAJECTORIES + 1] {
        let error = blocks(&ensemble, &folder, count).expect_err("no such blocks");
        assert!(matches!(error, Error::Count { count: found, .. } if found == count));
    }
    let mut resumed = pendulums(STEP);
    let checkpoint = resumed.checkpoint(3).expect("doubles");
    resumed.restore(&checkpoint).expect("the same run");
    let error = blocks(&resumed, &folder, 3).expect_err("it is not whole");
    assert!(matches!(error, Error::Resumed { first: 3 }), "{error}");
    // Nothing was run.
    let error = blocks(&ensemble, &folder, TRAJECTORIES)
        .and_then(|blocks| blocks.merge(folder.join("merged.npz")))
        .expect_err("nothing to merge");
    assert!(matches!(error, Error::Missing { .. }), "{error}");
    assert!(!folder.join("merged.npz").exists());
    fs::remove_dir_all(&folder).expect("a folder");
}

/// Every rank says it, and no block changes.
#[test]
fn every_rank_refuses_a_folder_of_another_run() {
    let Some(folder) = folder("other") else {
        return;
    };
    run(&folder, 1, "");
    let block = |number: usize| {
        let name = format!("blocks/block-{number:06}-of-{BLOCKS:06}.npz");
        folder.join(name)
    };
    let before = fs::read(block(0)).expect("a block");
    for (mode, words) in [
        ("half", "step size"),
        (
            "other end",
            "`end` is Doubles([60.0]), and here Doubles([30.0])",
        ),
        ("other blocks", "here there are 13 blocks"),
    ] {
        for outcome in run(&folder, 2, mode) {
            assert!(outcome.contains(words), "{mode}: {outcome}");
            assert!(outcome.contains("is of another run"), "{mode}: {outcome}");
        }
    }
    assert_eq!(fs::read(block(0)).expect("a block"), before);
    // A block that cannot be read.
    fs::remove_file(block(4)).expect("a block");
    fs::create_dir(block(4)).expect("a folder");
    for outcome in run(&folder, 2, "") {
        assert!(outcome.contains("block-000004-of-000012.npz"), "{outcome}");
    }
    // A file where the folder should be.
    fs::remove_dir_all(folder.join("blocks")).expect("a folder");
    fs::write(folder.join("blocks"), "").expect("a file");
    for outcome in run(&folder, 2, "") {
        assert!(outcome.contains("/blocks`"), "{outcome}");
    }
    fs::remove_dir_all(&folder).expect("a folder");
}

#[test]
fn all_ranks_fail_if_one_has_another_ensemble_or_misses_rows() {
    for (mode, words) in [
        ("half on rank 1", ["rank 1", "rank 0: the step size"]),
        (
            "other blocks on rank 1",
            ["rank 1", "it has 13 blocks, not 12"],
        ),
        ("stop", ["block ", "the array `trajectory` is not"]),
    ] {
        let Some(folder) = folder(&mode.replace(' ', "-")) else {
            return;
        };
        for outcome in run(&folder, 3, mode) {
            assert!(words.iter().all(|word| outcome.contains(word)), "{outcome}");
        }
        // It has left nothing that would be in the way.
        let [found, damaged, run] = summary(&run(&folder, 2, ""));
        assert_eq!([found + run, damaged], [BLOCKS, 0], "{mode}");
        fs::remove_dir_all(&folder).expect("a folder");
    }
}

/// An MPI that grants more threads than asked for is welcome to.
#[test]
fn ranks_refuse_an_mpi_for_one_thread() {
    let Some(folder) = folder("single") else {
        return;
    };
    let outcomes = run(&folder, 2, "single");
    let same = outcomes.iter().all(|text| text == "one thread");
    let granted = outcomes.iter().all(|text| text.starts_with("0 0 "));
    assert!(same || granted, "{outcomes:?}");
    fs::remove_dir_all(&folder).expect("a folder");
}
