//! What can go wrong with the blocks of an ensemble.

use std::fmt;
use std::io;
use std::path::PathBuf;

use symplectic::CheckpointError;
use symplectic::ensemble::EnsembleError;

/// The message, as `main` and `unwrap` print it.
impl fmt::Debug for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, formatter)
    }
}

/// Why blocks were not run, or not merged.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No block, or an empty one.
    #[error(
        "{count} blocks of {trajectories} trajectories: take at least one block, and at most as many as trajectories"
    )]
    Count {
        /// The number of blocks.
        count: usize,
        /// The number of trajectories.
        trajectories: usize,
    },

    /// The ensemble goes on from a checkpoint.
    #[error(
        "the ensemble begins at trajectory {first}, after a checkpoint: give all of it, since the folder knows which blocks are done"
    )]
    Resumed {
        /// The first trajectory that it would run.
        first: usize,
    },

    /// The ensemble cannot be saved.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),

    /// The ensemble cannot be divided.
    #[error(transparent)]
    Ensemble(#[from] EnsembleError),

    /// The facts cannot be written.
    #[error("the facts of the run: {0}")]
    Facts(io::Error),

    /// MPI was started for one thread.
    #[error(
        "MPI was started for a single thread: start it with `mpi::initialize_with_threading(Threading::Funneled)`"
    )]
    Threading,

    /// A block could not be filled.
    #[error("block {block}: {error}")]
    Work {
        /// Its number, from 0.
        block: usize,
        /// What `work` returned, or what is missing in what it wrote.
        error: io::Error,
    },

    /// A file or folder cannot be read or written. Blocks that were complete are as they were.
    #[error("`{}`: {error}; blocks that were complete are as they were", path.display())]
    File {
        /// Where.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },

    /// The folder holds blocks of another run.
    #[error("`{}` is of another run: {difference}; take another folder", path.display())]
    OtherRun {
        /// The file.
        path: PathBuf,
        /// What differs.
        difference: String,
    },

    /// A block is not there.
    #[error(
        "there is no `{}`: run the blocks first, in a folder that all ranks share", path.display()
    )]
    Missing {
        /// Where it should be.
        path: PathBuf,
    },

    /// Another rank has failed.
    #[error("rank {rank}: {reason}")]
    Rank {
        /// Its number.
        rank: i32,
        /// Its error.
        reason: String,
    },
}
