//! Blocks over ranks: work stealing by a counter that rank 0 keeps.

use std::io;
use std::panic::resume_unwind;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::{self, ScopedJoinHandle};
use std::vec;

use mpi::Threading;
use mpi::environment::threading_support;
use mpi::topology::SimpleCommunicator;
use mpi::traits::Communicator;
use symplectic::ensemble::{Ensemble, Npz, NpzArray};
use symplectic::simd::Lanes;
use symplectic::solver::Solver;
use symplectic::{Method, Summation, System, Vector};

use crate::blocks::Found;
use crate::message::Message;
use crate::{Blocks, Error};

/// What became of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Summary {
    /// The number of blocks that were complete before.
    pub found: usize,
    /// The number of files that were cut off or changed; their blocks were run again.
    pub damaged: usize,
    /// The number of blocks that this rank has run.
    pub run: usize,
}

impl<M, S, V, R, N, L> Blocks<'_, M, S, V, R, N, L>
where
    M: Method,
    S: System<V> + Clone + Send + Sync,
    V: Vector + Send + Sync,
    R: Summation,
    N: Solver<V, S>,
    L: Lanes,
{
    /// Runs all blocks that are not complete, on all ranks. Every rank must call it, with the same ensemble.
    ///
    /// `work` runs the ensemble of a block and writes its rows, by [`Npz::rows`], and other arrays whose first index goes over the
    /// trajectories or over what was found on them. On rank 0 it is called in a thread of its own.
    ///
    /// # Errors
    ///
    /// [`Error::Threading`], [`Error::File`], [`Error::OtherRun`], [`Error::Work`]. Where one rank fails, the others finish the blocks
    /// that they have, and then return [`Error::Rank`] with its reason.
    ///
    /// # Panics
    ///
    /// A panic of `work` ends all ranks (`MPI_Abort`).
    pub fn run(
        &self,
        world: &impl Communicator,
        work: impl FnMut(&Ensemble<M, S, V, R, N, L>, &mut Npz<Vec<u8>>) -> io::Result<()> + Send,
    ) -> Result<Summary, Error> {
        if threading_support() < Threading::Funneled {
            return Err(Error::Threading);
        }
        // Its messages are apart from all others.
        let world = world.duplicate();
        let _guard = AbortOnPanic(&world);
        match world.rank() {
            0 => self.lead(&world, work),
            _ => self.follow(&world, work),
        }
    }

    /// Rank 0: this thread gives out blocks, another one runs them.
    fn lead(
        &self,
        world: &SimpleCommunicator,
        mut work: impl FnMut(&Ensemble<M, S, V, R, N, L>, &mut Npz<Vec<u8>>) -> io::Result<()> + Send,
    ) -> Result<Summary, Error> {
        let counter = Mutex::new(self.counter());
        let run = thread::scope(|scope| {
            let own = scope.spawn(|| {
                let mut run = 0;
                loop {
                    let Some(block) = lock(&counter).next() else {
                        return run;
                    };
                    match self.fill(block, &mut work) {
                        Ok(()) => run += 1,
                        Err(error) => lock(&counter).fail(error),
                    }
                }
            });
            self.serve(world, &counter, own)
        });
        let Counter {
            found,
            damaged,
            failure,
            ..
        } = counter.into_inner().unwrap_or_else(PoisonError::into_inner);
        let last = match &failure {
            None => Message::Done { found, damaged },
            Some(Error::Rank { rank, reason }) => Message::Failed {
                rank: *rank,
                reason: reason.clone(),
            },
            Some(error) => Message::Failed {
                rank: 0,
                reason: error.to_string(),
            },
        };
        for rank in 1..world.size() {
            last.send(world, rank);
        }
        match failure {
            None => Ok(Summary {
                found,
                damaged,
                run,
            }),
            Some(error) => Err(error),
        }
    }

    /// Gives out blocks until all ranks wait for the last message and the own thread has ended. Returns how many blocks that has run.
    fn serve(
        &self,
        world: &SimpleCommunicator,
        counter: &Mutex<Counter>,
        own: ScopedJoinHandle<'_, usize>,
    ) -> usize {
        let mut working = world.size() - 1;
        let mut own = Some(own);
        let mut run = 0;
        while own.is_some() || working > 0 {
            if let Some(ended) = own.take_if(|own| own.is_finished()) {
                // A panic ends all ranks, at once.
                run = ended.join().unwrap_or_else(|panic| resume_unwind(panic));
            }
            let Some((rank, message)) = Message::receive(world) else {
                continue;
            };
            let mut counter = lock(counter);
            match message {
                Message::Join { head, blocks } => {
                    if let Some(reason) = self.other_run(&head, blocks) {
                        counter.fail(Error::Rank { rank, reason });
                    }
                }
                Message::Failed { rank, reason } => counter.fail(Error::Rank { rank, reason }),
                _ => {}
            }
            match counter.next() {
                Some(block) => Message::Block(block).send(world, rank),
                None => working -= 1,
            }
        }
        run
    }

    /// Every other rank: asks for blocks and runs them.
    fn follow(
        &self,
        world: &SimpleCommunicator,
        mut work: impl FnMut(&Ensemble<M, S, V, R, N, L>, &mut Npz<Vec<u8>>) -> io::Result<()>,
    ) -> Result<Summary, Error> {
        let rank = world.rank();
        let (mut run, mut failure) = (0, None);
        let mut message = Message::Join {
            head: self.head().to_vec(),
            blocks: self.count(),
        };
        loop {
            message.send(world, 0);
            message = match Message::wait(world) {
                Message::Block(block) => match self.fill(block, &mut work) {
                    Ok(()) => {
                        run += 1;
                        Message::Next
                    }
                    Err(error) => {
                        let reason = error.to_string();
                        failure = Some(error);
                        Message::Failed { rank, reason }
                    }
                },
                Message::Done { found, damaged } => {
                    return Ok(Summary {
                        found,
                        damaged,
                        run,
                    });
                }
                Message::Failed { rank, reason } => {
                    return Err(failure.unwrap_or(Error::Rank { rank, reason }));
                }
                Message::Join { .. } | Message::Next => Message::Next,
            };
        }
    }

    /// What there is to do.
    fn counter(&self) -> Counter {
        let mut blocks = Vec::new();
        let (mut found, mut damaged) = (0, 0);
        let mut look = || {
            self.open()?;
            for block in 0..self.count() {
                match self.find(block)? {
                    Found::Complete(_) => {
                        found += 1;
                        continue;
                    }
                    Found::Damaged(_) => damaged += 1,
                    Found::Nothing => {}
                }
                blocks.push(block);
            }
            Ok(())
        };
        let failure = look().err();
        Counter {
            blocks: blocks.into_iter(),
            found,
            damaged,
            failure,
        }
    }

    /// The first difference between the blocks of another rank and those of this one.
    fn other_run(&self, head: &[u8], blocks: usize) -> Option<String> {
        let difference = if blocks != self.count() {
            format!("it has {blocks} blocks, not {}", self.count())
        } else if head != self.head() {
            let difference = match NpzArray::read_all(head) {
                Ok(arrays) => self.difference(&arrays),
                Err(error) => Some(error.to_string()),
            };
            difference.unwrap_or_else(|| "it has more facts".to_owned())
        } else {
            return None;
        };
        Some(format!(
            "its run is another than that of rank 0: {difference}"
        ))
    }
}

/// The blocks that nobody has taken.
struct Counter {
    blocks: vec::IntoIter<usize>,
    found: usize,
    damaged: usize,
    /// The first failure: after it nobody gets a block.
    failure: Option<Error>,
}

impl Counter {
    fn next(&mut self) -> Option<usize> {
        match self.failure {
            None => self.blocks.next(),
            Some(_) => None,
        }
    }

    fn fail(&mut self, error: Error) {
        self.failure.get_or_insert(error);
    }
}

fn lock(counter: &Mutex<Counter>) -> MutexGuard<'_, Counter> {
    counter.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Else the other ranks would wait for one that has panicked.
struct AbortOnPanic<'a>(&'a SimpleCommunicator);

impl Drop for AbortOnPanic<'_> {
    fn drop(&mut self) {
        if thread::panicking() {
            self.0.abort(101);
        }
    }
}
