//! What ranks say to each other.

use std::thread;
use std::time::Duration;

use mpi::Rank;
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, Destination, MatchedReceiveVec, Source};
use serde::{Deserialize, Serialize};

/// How long a rank sleeps before it looks for a message again. A receive of MPI would keep a core busy.
const PAUSE: Duration = Duration::from_millis(1);

/// Rank 0 answers each message of another rank with one.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Message {
    /// To rank 0: a block, please.
    Join {
        /// What the blocks of this rank begin with.
        head: Vec<u8>,
        /// Their number.
        blocks: usize,
    },
    /// To rank 0: the block is written; another one, please.
    Next,
    /// From rank 0: a block.
    Block(usize),
    /// From rank 0: all blocks are done.
    Done {
        /// How many were complete before.
        found: usize,
        /// How many files were damaged.
        damaged: usize,
    },
    /// Both ways: a rank has failed.
    Failed {
        /// Which.
        rank: Rank,
        /// Its error.
        reason: String,
    },
}

impl Message {
    pub(crate) fn send(&self, world: &SimpleCommunicator, rank: Rank) {
        // Of these types there is no value without a text.
        let bytes = serde_json::to_vec(self).unwrap_or_default();
        world.process_at_rank(rank).send(&bytes[..]);
    }

    /// The next message, with its sender; sleeps a little where there is none.
    pub(crate) fn receive(world: &SimpleCommunicator) -> Option<(Rank, Self)> {
        let Some(found) = world.any_process().immediate_matched_probe() else {
            thread::sleep(PAUSE);
            return None;
        };
        let (bytes, status) = found.matched_receive_vec::<u8>();
        let rank = status.source_rank();
        let message = serde_json::from_slice(&bytes).unwrap_or_else(|error| Self::Failed {
            rank,
            reason: format!("its message cannot be read: {error}"),
        });
        Some((rank, message))
    }

    /// Waits for the answer of rank 0.
    pub(crate) fn wait(world: &SimpleCommunicator) -> Self {
        loop {
            if let Some((_, message)) = Self::receive(world) {
                return message;
            }
        }
    }
}
