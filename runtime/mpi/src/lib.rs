//! Ensembles of [`symplectic`] on several machines, by MPI.
//!
//! The ensemble is divided into [`Blocks`] of trajectories. Every rank takes the next block when it is done with one, and writes it as a
//! file of its own; [`Blocks::merge`] makes one file of them. Each trajectory has the bits that it has alone, so the merged file has the
//! same bytes for any number of ranks.
//!
//! ```no_run
//! use std::ops::ControlFlow;
//! use symplectic::State;
//! use symplectic::ensemble::{Ensemble, WriteEnsemble};
//! use symplectic_mpi::Blocks;
//! use symplectic_mpi::mpi::{self, Threading, topology::SimpleCommunicator, traits::Communicator};
//!
//! symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
//! symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
//!
//! const END: f64 = 1000.0;
//!
//! fn run(world: &SimpleCommunicator) -> Result<(), Box<dyn std::error::Error>> {
//!     let starts = (0..1000).map(|k| State::from_arrays(0.0, [0.003 * f64::from(k)], [0.0])).collect();
//!     let ensemble = Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)?;
//!     let blocks = Blocks::new(&ensemble, "pendulums", 50, |file| file.doubles("end", &[], &[END]))?;
//!     blocks.run(world, |block, file| {
//!         let mut rows = Vec::new();
//!         block.integrate_to(END, |row| {
//!             rows.push(row);
//!             ControlFlow::Continue(())
//!         });
//!         file.rows(&rows)
//!     })?;
//!     if world.rank() == 0 {
//!         blocks.merge("pendulums.npz")?;
//!     }
//!     Ok(())
//! }
//!
//! fn main() {
//!     let started = mpi::initialize_with_threading(Threading::Funneled);
//!     let (universe, _) = started.expect("MPI is started once");
//!     let world = universe.world();
//!     if let Err(error) = run(&world) {
//!         eprintln!("rank {}: {error}", world.rank());
//!         // A rank that fails before `Blocks::run` must not keep the others waiting.
//!         world.abort(1);
//!     }
//! }
//! ```
//!
//! ```console
//! $ mpirun -n 64 target/release/pendulums
//! $ srun --ntasks=64 --kill-on-bad-exit=1 target/release/pendulums     # in Slurm
//! ```
//!
//! # Interruptions
//!
//! When a rank dies, `mpirun` ends the others. Start the same program again: it runs the blocks that are not there, and no other. So a
//! dead rank's work is done, and a run may be stopped at any time, by the time limit of a queue say. A block is the unit: there is no
//! checkpoint inside it. Take more blocks if too much is lost with one.
//!
//! A file that was cut off or changed is run again, and [`Summary::damaged`] counts it. A folder of another run, with another step size
//! say, is refused.
//!
//! # The counter
//!
//! Rank 0 keeps the list of blocks, and gives the next one to a rank that asks. It runs blocks too, in a thread of its own; the
//! thread that started MPI looks for messages every millisecond and sleeps in between. One-sided operations (`MPI_Fetch_and_op`) would
//! need no such thread, but the crate `mpi` has no safe interface to them, and unsafe code is forbidden here.
//!
//! Threads are for one rank: with the feature `parallel` of `symplectic`, start one rank on each machine; without it, one on each core.

mod blocks;
mod error;
mod message;
mod run;

pub use blocks::Blocks;
pub use error::Error;
pub use mpi;
pub use run::Summary;
