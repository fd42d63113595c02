//! The reaction to a failed step: it is repeated as several shorter ones.

use core::convert::Infallible;
use core::ops::ControlFlow;

use super::clock::RemainingSteps;
use super::stepper::advance_in_time;
use super::{Run, Stepper};
use crate::number::words::{Visit, Words};

/// The reaction of a [`Run`] with equal steps if the stages of a step do not converge or a result is NaN or infinite.
///
/// It has no effect on runs of a flow, whose noise would be another one, and on steps that return their stages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Retry {
    /// The step fails, with the error.
    #[default]
    Never,
    /// The step is repeated as 2, 4, … up to 2^`halvings` equal steps. If all attempts fail, it fails with the error of the whole step.
    /// `halvings` is limited to [`Retry::MAX_HALVINGS`].
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
    pub const MAX_HALVINGS: u32 = 16;

    /// The number of parts of the step in each attempt.
    pub(crate) fn parts(self) -> impl Iterator<Item = u32> {
        let halvings = match self {
            Self::Never => 0,
            Self::Split { halvings } => halvings.min(Self::MAX_HALVINGS),
        };
        (1..=halvings).map(|halving| 1 << halving)
    }
}

impl Words for Retry {
    fn words(&mut self, visit: &mut Visit<'_>) {
        let mut halvings = match *self {
            Self::Never => None,
            Self::Split { halvings } => Some(halvings),
        };
        halvings.words(visit);
        *self = halvings.map_or(Self::Never, |halvings| Self::Split { halvings });
    }
}

impl<S: Stepper> Run<S> {
    /// [`take_again`](Self::take_again), and once more with `see` when the number of parts is known.
    #[cold]
    pub(super) fn take_again_in_sight<B>(
        &mut self,
        size: f64,
        time: f64,
        error: S::Error,
        see: &mut impl FnMut(&mut S) -> Result<ControlFlow<B>, S::Error>,
    ) -> Result<ControlFlow<B>, S::Error> {
        if !self.is_to_be_split(&error) {
            return Err(error);
        }
        let saved = self.stepper.save();
        let parts = self.take_again(size, time, error)?;
        let statistics = *self.stepper.statistics();
        self.stepper.go_back(&saved);
        let seen = self.take_in_parts(size, time, parts, see);
        *self.stepper.statistics_mut() = statistics;
        seen
    }

    /// Repeats a step that failed with `error` in parts, if it is to be retried; returns the number of parts.
    #[cold]
    pub(super) fn take_again(
        &mut self,
        size: f64,
        time: f64,
        error: S::Error,
    ) -> Result<u32, S::Error> {
        if !self.is_to_be_split(&error) {
            return Err(error);
        }
        let saved = self.stepper.save();
        for (failed, parts) in (1..).zip(self.retry.parts()) {
            let mut ignore = |_: &mut S| Ok(ControlFlow::<Infallible>::Continue(()));
            if self.take_in_parts(size, time, parts, &mut ignore).is_ok() {
                self.stepper.statistics_mut().rejected += failed;
                return Ok(parts);
            }
            self.stepper.go_back(&saved);
        }
        Err(error)
    }

    fn is_to_be_split(&self, error: &S::Error) -> bool {
        self.retry != Retry::Never && self.stepper.may_split(error)
    }

    /// Takes a step as several equal parts and calls `see` after each until it breaks. If a part fails, the state is that before it.
    fn take_in_parts<B>(
        &mut self,
        size: f64,
        end: f64,
        parts: u32,
        see: &mut impl FnMut(&mut S) -> Result<ControlFlow<B>, S::Error>,
    ) -> Result<ControlFlow<B>, S::Error> {
        let mut seen = ControlFlow::Continue(());
        let part = size / f64::from(parts);
        let start = self.stepper.time();
        let mut remaining = RemainingSteps::of_size(u64::from(parts), part, start, end);
        while let Some((part, time)) = remaining.next_step() {
            advance_in_time(&mut self.stepper, part, time)?;
            if seen.is_continue() {
                seen = see(&mut self.stepper)?;
            }
        }
        Ok(seen)
    }
}
