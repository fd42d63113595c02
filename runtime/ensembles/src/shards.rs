//! Parts of an ensemble, for several machines.

use alloc::sync::Arc;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::Range;

use crate::{Ensemble, EnsembleError};
use symplectic_core::simd::Lanes;
use symplectic_core::solver::Solver;
use symplectic_core::{Method, State, Summation, System, Vector};

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>, L: Lanes>
    Ensemble<M, S, V, R, N, L>
{
    /// Part `part`, from 0, of `count` parts of almost equal size. The trajectories keep their numbers.
    ///
    /// The parts are consecutive. On several machines, for example with `--array` of Slurm, each machine runs one part.
    /// The rows of all parts in order are those of the whole ensemble.
    ///
    /// # Errors
    ///
    /// [`EnsembleError::Shard`] unless `part < count`.
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// # use symplectic::State;
    /// # use symplectic::ensemble::{Ensemble, EnsembleError};
    /// # symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    /// # symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
    /// # fn main() -> Result<(), EnsembleError> {
    /// let whole = || {
    ///     let starts = (0..10).map(|k| State::from_arrays(0.0, [0.1 * f64::from(k)], [0.0])).collect();
    ///     Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)
    /// };
    /// let mut seen = Vec::new();
    /// for part in 0..3 {
    ///     whole()?.shard(part, 3)?.integrate_to(1.0, |row| {
    ///         seen.push(row.trajectory);
    ///         ControlFlow::Continue(())
    ///     });
    /// }
    /// assert_eq!(seen, Vec::from_iter(0..10));
    /// assert!(whole()?.shard(3, 3).is_err());
    /// # Ok(())
    /// # }
    /// ```
    pub fn shard(mut self, part: usize, count: usize) -> Result<Self, EnsembleError> {
        let Range { start, end } = self.places_of(part, count)?;
        let starts = Arc::make_mut(&mut self.starts);
        starts.truncate(end);
        starts.drain(..start);
        for (_, last) in &mut self.systems {
            *last = (*last).min(end).saturating_sub(start);
        }
        self.offset += start;
        self.first = self.first.clamp(start, end) - start;
        Ok(self)
    }

    /// A copy of the part that [`shard`](Self::shard) returns; only the starts of the part are copied.
    ///
    /// # Errors
    ///
    /// Those of [`shard`](Self::shard).
    ///
    /// ```
    /// # use symplectic::State;
    /// # use symplectic::ensemble::{Ensemble, EnsembleError};
    /// # symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    /// # symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
    /// # let starts = (0..10).map(|k| State::from_arrays(0.0, [0.1 * f64::from(k)], [0.0])).collect();
    /// let ensemble = Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)?;
    /// let second = ensemble.to_shard(1, 2)?;
    /// assert_eq!((second.trajectories(), ensemble.trajectories()), (5..10, 0..10));
    /// # Ok::<(), EnsembleError>(())
    /// ```
    pub fn to_shard(&self, part: usize, count: usize) -> Result<Self, EnsembleError>
    where
        S: Clone,
    {
        let Range { start, end } = self.places_of(part, count)?;
        let mut systems = self.systems_of(&(start..end)).to_vec();
        for (_, last) in &mut systems {
            *last = (*last).min(end) - start;
        }
        let starts = Arc::new(self.starts[start..end].to_vec());
        Ok(Self {
            offset: self.offset + start,
            first: self.first.clamp(start, end) - start,
            ..self.with(systems, starts)
        })
    }

    /// An ensemble with all starts, but only the systems of these; it reuses a former one.
    pub(super) fn part(&self, places: &Range<usize>, former: Option<Self>) -> Self
    where
        S: Clone,
    {
        let systems = self.systems_of(places);
        let Some(former) = former else {
            return self.with(systems.to_vec(), self.starts.clone());
        };
        // The ends tell which systems these are.
        let ends = systems.iter().map(|(_, end)| end);
        match ends.eq(former.systems.iter().map(|(_, end)| end)) {
            true => former,
            false => Self {
                systems: systems.to_vec(),
                ..former
            },
        }
    }

    /// The same ensemble with other systems and starts.
    fn with(&self, systems: Vec<(S, usize)>, starts: Arc<Vec<State<V>>>) -> Self {
        Self {
            systems,
            starts,
            step_size: self.step_size,
            offset: self.offset,
            first: self.first,
            stopping: self.stopping,
            retry: self.retry,
            lanes: self.lanes,
            registers: self.registers,
            stop: self.stop.clone(),
            method: self.method.clone(),
            kind: PhantomData,
        }
    }

    /// The systems of a range of starts, each with the end of its own range; every start may have its own system.
    fn systems_of(&self, places: &Range<usize>) -> &[(S, usize)] {
        let before = |(_, end): &(S, usize)| *end <= places.start;
        let after = &self.systems[self.systems.partition_point(before)..];
        let count = after.partition_point(|(_, end)| *end < places.end) + 1;
        &after[..count.min(after.len())]
    }

    /// The range of starts of a part.
    fn places_of(&self, part: usize, count: usize) -> Result<Range<usize>, EnsembleError> {
        if part >= count {
            return Err(EnsembleError::Shard { part, count });
        }
        let total = self.starts.len();
        // The product may overflow `usize`.
        let bound = |part: usize| (part as u128 * total as u128 / count as u128) as usize;
        Ok(bound(part)..bound(part + 1))
    }
}
