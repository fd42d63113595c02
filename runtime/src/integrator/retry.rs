//! The reaction to a failed step: it is repeated as several shorter ones.

use core::convert::Infallible;
use core::ops::ControlFlow;

use super::Integrator;
use crate::error::Error;
use crate::integrator::clock::RemainingSteps;
use crate::method::{Method, Solver, WarmStart};
use crate::number::{Summation, Vector};
use crate::system::System;

/// The reaction of an [`Integrator`] if the stages of a step do not converge or a result is NaN or infinite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Retry {
    /// The step fails, with the error.
    #[default]
    Never,
    /// The step is repeated as 2, 4, … up to 2^`halvings` equal steps. If all attempts fail, it fails with the error of the whole step.
    /// `halvings` is limited to [`Retry::MOST_HALVINGS`].
    ///
    /// A method with variable steps is not the symplectic map that it is with equal steps. Use this for rare
    /// stiff phases; [`Statistics::rejected`](crate::Statistics::rejected) counts them. Convergence of the
    /// stages does not make a step accurate. Each retry allocates memory for the state before the step.
    Split {
        /// The largest number of halvings.
        halvings: u32,
    },
}

impl Retry {
    /// Bound on the work of one step: 65 536 steps instead of one.
    pub const MOST_HALVINGS: u32 = 16;

    /// The number of parts of the step in each attempt.
    pub(crate) fn parts(self) -> impl Iterator<Item = u32> {
        let halvings = match self {
            Self::Never => 0,
            Self::Split { halvings } => halvings.min(Self::MOST_HALVINGS),
        };
        (1..=halvings).map(|halving| 1 << halving)
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// [`take_again`](Self::take_again), and once more with `see` when the number of parts is known.
    #[cold]
    pub(super) fn take_again_in_sight<B>(
        &mut self,
        size: f64,
        time: f64,
        error: Error,
        see: &mut impl FnMut(&Self) -> Result<ControlFlow<B>, Error>,
    ) -> Result<ControlFlow<B>, Error> {
        let (state, low) = (self.step_memory.state.clone(), self.step_memory.low.clone());
        let parts = self.take_again(size, time, error)?;
        let statistics = self.step_memory.statistics;
        (
            self.step_memory.state,
            self.step_memory.low,
            self.step_memory.kept,
        ) = (state, low, WarmStart::default());
        let seen = self.take_in_parts(size, time, parts, see);
        self.step_memory.statistics = statistics;
        seen
    }

    /// Repeats a step that failed with `error` in parts, if it is to be retried; returns the number of parts.
    #[cold]
    pub(super) fn take_again(&mut self, size: f64, time: f64, error: Error) -> Result<u32, Error> {
        let of_the_size = matches!(
            error,
            Error::NoConvergence { .. }
                | Error::Stagnation { .. }
                | Error::NonFinite { .. }
                | Error::SingularMatrix { .. }
        );
        if !of_the_size || self.retry == Retry::Never {
            return Err(error);
        }
        let (state, low) = (self.step_memory.state.clone(), self.step_memory.low.clone());
        let statistics = self.step_memory.statistics;
        for (failed, parts) in (1..).zip(self.retry.parts()) {
            let mut ignore = |_: &Self| Ok(ControlFlow::<Infallible>::Continue(()));
            if self.take_in_parts(size, time, parts, &mut ignore).is_ok() {
                self.step_memory.statistics.rejected += failed;
                return Ok(parts);
            }
            self.step_memory.state = state.clone();
            self.step_memory.low = low.clone();
            self.step_memory.statistics = statistics;
        }
        Err(error)
    }

    /// Takes a step as several equal parts and calls `see` after each until it breaks. If a part fails, the state is that before it.
    fn take_in_parts<B>(
        &mut self,
        size: f64,
        end: f64,
        parts: u32,
        see: &mut impl FnMut(&Self) -> Result<ControlFlow<B>, Error>,
    ) -> Result<ControlFlow<B>, Error> {
        let mut seen = ControlFlow::Continue(());
        let part = size / f64::from(parts);
        let start = self.step_memory.state.time;
        let mut remaining = RemainingSteps::of_size(u64::from(parts), part, start, end);
        while let Some((part, time)) = remaining.next_step() {
            let work = self.prepare(part, time)?;
            self.step_memory.accept::<R>(part, time, work);
            if seen.is_continue() {
                seen = see(self)?;
            }
        }
        Ok(seen)
    }
}
