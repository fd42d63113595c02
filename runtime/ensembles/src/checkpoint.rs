//! Checkpoints of ensembles: an interrupted run resumes with the same rows.

use alloc::format;
use alloc::string::{String, ToString};

use crate::Ensemble;
use symplectic_core::inside::system_fingerprint;
use symplectic_core::simd::Lanes;
use symplectic_core::solver::{Solver, scalar_words};
use symplectic_core::{Checkpoint, CheckpointError, Method, State, Summation, System, Vector};

/// Progress of an ensemble: which rows are complete.
///
/// It contains no trajectories. Trajectories without a row run again from their starts, with the same bits. Store
/// results of the earlier rows next to it, for example [`Moments`](super::Moments). With the feature `serde` it can be
/// written in any format.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct EnsembleCheckpoint {
    /// Checkpoint of the first trajectory at its start, if there is one: method, summation, solver, step size and
    /// tolerance.
    run: Option<Checkpoint>,
    /// Hash of the starts and of the systems there.
    starts: String,
    /// The first trajectory, and one past the last.
    range: [usize; 2],
    /// The first trajectory without a row.
    next: usize,
    /// Checksum of the fields above except `run`.
    checksum: String,
}

impl EnsembleCheckpoint {
    fn sum(&self) -> String {
        let numbers = [self.range[0], self.range[1], self.next].map(|number| number as u64);
        let letters = self.starts.bytes().map(u64::from);
        format!("{:016x}", hash_of_words(letters.chain(numbers)))
    }
}

/// FNV-1a on words. The upper half of each product is folded onto the lower half; otherwise two simultaneous changes of
/// sign could cancel.
fn hash_of_words(words: impl Iterator<Item = u64>) -> u64 {
    words.fold(0xcbf2_9ce4_8422_2325, |hash, word| {
        let product = (hash ^ word).wrapping_mul(0x0100_0000_01b3);
        product ^ (product >> 32)
    })
}

impl<M, S, V, R, N, L> Ensemble<M, S, V, R, N, L>
where
    M: Method,
    S: System<V> + Clone + Send,
    V: Vector + Send + Sync,
    R: Summation,
    N: Solver<V, S>,
    L: Lanes,
{
    /// Checkpoint from which a run can [resume](Self::restore) at the trajectory `next`, the number after that of the
    /// last row passed to `show`.
    ///
    /// The system is evaluated at every start, to identify it later. Take a checkpoint occasionally, not after every
    /// row.
    ///
    /// # Errors
    ///
    /// [`CheckpointError::Scalar`] for a number type that checkpoints do not support.
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// use symplectic::State;
    /// use symplectic::ensemble::{Ensemble, EnsembleError};
    ///
    /// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    /// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let make = || {
    ///     let starts = (0..100).map(|k| State::from_arrays(0.0, [0.03 * f64::from(k)], [0.0])).collect();
    ///     Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)
    /// };
    /// let (ensemble, mut rows) = (make()?, Vec::new());
    /// let next = ensemble.integrate_to(1.0, |row| {
    ///     rows.push(row);
    ///     // It is interrupted.
    ///     if rows.len() < 30 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    /// });
    /// let checkpoint = ensemble.checkpoint(next)?;
    ///
    /// // In another process, say.
    /// let mut resumed = make()?;
    /// resumed.restore(&checkpoint)?;
    /// resumed.integrate_to(1.0, |row| {
    ///     rows.push(row);
    ///     ControlFlow::Continue(())
    /// });
    /// assert!(rows.iter().map(|row| row.trajectory).eq(0..100));
    /// # Ok(())
    /// # }
    /// ```
    pub fn checkpoint(&self, next: usize) -> Result<EnsembleCheckpoint, CheckpointError> {
        let range = [self.offset, self.offset + self.starts.len()];
        let mut checkpoint = EnsembleCheckpoint {
            run: match self.starts.is_empty() {
                true => None,
                false => Some(self.integrator(0).1.checkpoint()?),
            },
            starts: self.starts_fingerprint(),
            range,
            next: next.clamp(range[0], range[1]),
            checksum: String::new(),
        };
        checkpoint.checksum = checkpoint.sum();
        Ok(checkpoint)
    }

    /// Resumes from a checkpoint of an identical ensemble: runs begin at the first trajectory without a row.
    ///
    /// # Errors
    ///
    /// [`CheckpointError`] as for [`check`](Self::check); the ensemble is then unchanged.
    pub fn restore(&mut self, checkpoint: &EnsembleCheckpoint) -> Result<(), CheckpointError> {
        self.check(checkpoint)?;
        let end = self.starts.len();
        self.first = checkpoint.next.saturating_sub(self.offset).min(end);
        Ok(())
    }

    /// Checks that a checkpoint belongs to an identical ensemble; the error states the difference.
    ///
    /// The system is evaluated at every start.
    ///
    /// # Errors
    ///
    /// [`CheckpointError`]
    pub fn check(&self, checkpoint: &EnsembleCheckpoint) -> Result<(), CheckpointError> {
        if checkpoint.checksum != checkpoint.sum() {
            return Err(CheckpointError::Damaged {
                reason: "its checksum does not match its contents",
            });
        }
        let own = self.checkpoint(checkpoint.next)?;
        let same = |what, found: String, expected: String| match found == expected {
            true => Ok(()),
            false => Err(CheckpointError::OtherRun {
                what,
                found,
                expected,
            }),
        };
        let range = |[first, end]: [usize; 2]| format!("{first}..{end}");
        same("trajectories", range(checkpoint.range), range(own.range))?;
        if let Some(run) = &checkpoint.run {
            let mut mine = self.integrator(0).1;
            mine.restore(run)?;
            let size = |size: f64| size.to_string();
            same("step size", size(mine.step_size()), size(self.step_size))?;
        }
        same("starts", checkpoint.starts.clone(), own.starts.clone())?;
        let is_same = match (&checkpoint.run, &own.run) {
            (Some(run), Some(own)) => run.is_same_run(own),
            (run, own) => run == own,
        };
        if !is_same {
            return Err(CheckpointError::OtherRun {
                what: "tolerance, bound on the sweeps or retry",
                found: "other".to_string(),
                expected: "this".to_string(),
            });
        }
        Ok(())
    }

    /// Hash of all starts and of the system at each.
    fn starts_fingerprint(&self) -> String {
        let mut hash = 0;
        let mut place = 0;
        for (system, end) in &self.systems {
            for State { time, q, p } in &self.starts[place..*end] {
                let mut add = |word: &mut u64| hash = hash_of_words([hash, *word].into_iter());
                add(&mut time.to_bits());
                for vector in [&mut q.clone(), &mut p.clone()] {
                    scalar_words(vector.as_mut_slice(), &mut add);
                }
                let mut system = system_fingerprint(system, *time, q, p);
                system.iter_mut().for_each(add);
            }
            place = place.max(*end);
        }
        format!("{hash:016x}")
    }
}
