//! Blocks over ranks. `mpirun` starts this test program again, once for each rank; without `mpirun` those tests are skipped.

mod bits;
mod interruptions;
mod launch;
mod program;
mod refusals;
