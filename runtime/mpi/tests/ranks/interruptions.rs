//! Ranks that die, files that are damaged, disks that are full.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::Duration;

use crate::launch::{ends_well, folder, outcomes, run, start, summary};
use crate::program::{BLOCKS, complete, plain};

/// What is left after an interruption is found, the rest is run, and the bits are the same.
fn goes_on(folder: &Path, ranks: usize) {
    let before = complete(folder);
    assert!(0 < before && before < BLOCKS, "{before} blocks");
    let found = summary(&run(folder, ranks, ""));
    assert_eq!(found, [before, 0, BLOCKS - before]);
    let merged = fs::read(folder.join("merged.npz")).expect("a file");
    assert!(merged == plain());
    fs::remove_dir_all(folder).expect("a folder");
}

#[test]
fn the_work_of_a_killed_rank_is_done_by_the_next_run() {
    let Some(folder) = folder("killed") else {
        return;
    };
    let mut mpirun = start(&folder, 3, "hold", &[]);
    while !folder.join("here-1").exists() || complete(&folder) < 2 {
        assert!(mpirun.try_wait().expect("mpirun").is_none());
        thread::sleep(Duration::from_millis(5));
    }
    let rank = fs::read_to_string(folder.join("pid-1")).expect("a file");
    let killed = Command::new("kill").args(["-9", &rank]).status();
    assert!(killed.expect("kill").success());
    assert!(!ends_well(mpirun));
    goes_on(&folder, 2);
}

#[test]
fn a_panic_ends_all_ranks() {
    for rank in [0, 1] {
        let Some(folder) = folder(&format!("panic-{rank}")) else {
            return;
        };
        let mode = format!("panic on rank {rank}");
        assert!(!ends_well(start(&folder, 3, &mode, &[])));
        assert!(complete(&folder) < BLOCKS);
        fs::remove_dir_all(&folder).expect("a folder");
    }
}

#[test]
fn a_damaged_block_is_run_again() {
    let Some(folder) = folder("damaged") else {
        return;
    };
    run(&folder, 2, "");
    let block = |number: usize| {
        let name = format!("blocks/block-{number:06}-of-{BLOCKS:06}.npz");
        folder.join(name)
    };
    let mut cut = fs::read(block(3)).expect("a block");
    cut.truncate(cut.len() / 2);
    fs::write(block(3), cut).expect("a block");
    // A bit among the numbers: only the checksum knows.
    let mut changed = fs::read(block(11)).expect("a block");
    let middle = changed.len() / 2;
    changed[middle] ^= 1;
    fs::write(block(11), changed).expect("a block");
    // A block in the place of another.
    fs::copy(block(6), block(7)).expect("a block");
    fs::remove_file(block(0)).expect("a block");
    assert_eq!(summary(&run(&folder, 2, "")), [BLOCKS - 4, 3, 4]);
    let merged = fs::read(folder.join("merged.npz")).expect("a file");
    assert!(merged == plain());
    fs::remove_dir_all(&folder).expect("a folder");
}

/// Ranks that may write files of 32 KiB at most: the first blocks are smaller, the last ones larger.
#[test]
fn complete_blocks_remain_if_the_disk_is_full() {
    let Some(folder) = folder("full") else {
        return;
    };
    // The unit of `ulimit -f` is 512 bytes, in some shells 1024. Shared memory is a file too, so messages go another way.
    let limited = r#"trap '' XFSZ; ulimit -f 64; export OMPI_MCA_btl=self,tcp; exec "$0" "$@""#;
    assert!(ends_well(start(&folder, 2, "", &["sh", "-c", limited])));
    let outcomes = outcomes(&folder, 2);
    for (outcome, place) in outcomes.iter().zip(["", "rank "]) {
        assert!(
            outcome.contains("/block-0000")
                && outcome.contains("blocks that were complete are as they were"),
            "{place}{outcome}"
        );
    }
    let entries = fs::read_dir(folder.join("blocks")).expect("a folder");
    assert_eq!(entries.count(), complete(&folder), "a file in part is left");
    goes_on(&folder, 2);
}
