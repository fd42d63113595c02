//! Iterator over the states of an integration.

use core::iter::FusedIterator;

use crate::integrator::{Run, Stepper};

impl<S: Stepper> Run<S> {
    /// An endless iterator over the states after each step; limit it by [`Iterator::take`].
    pub const fn states(&mut self) -> States<'_, S> {
        States {
            run: self,
            stride: 1,
            failed: false,
        }
    }
}

/// The endless iterator that [`Run::states`] returns.
///
/// Each item is a clone of the state after one more step, or after [several](Self::every). It ends after an error.
#[derive(Debug)]
pub struct States<'a, S> {
    run: &'a mut Run<S>,
    /// Number of steps between items.
    stride: u64,
    failed: bool,
}

impl<S: Stepper> States<'_, S> {
    /// Yields the states after every `steps` steps only, without a copy of the states in between; 0 counts as 1.
    ///
    /// ```
    /// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, acceleration};
    /// # fn main() -> Result<(), Error> {
    /// let oscillator = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::new(StoermerVerlet, oscillator, start, 0.125)?;
    /// let states: Result<Vec<_>, _> = integrator.states().every(8).take(3).collect();
    /// let times: Vec<f64> = states?.iter().map(|state| state.time).collect();
    /// assert_eq!(times, [1.0, 2.0, 3.0]);
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    pub const fn every(mut self, steps: u64) -> Self {
        self.stride = if steps == 0 { 1 } else { steps };
        self
    }
}

impl<S: Stepper> Iterator for States<'_, S> {
    type Item = Result<S::State, S::Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let state = self.run.take_steps(self.stride).cloned();
        self.failed = state.is_err();
        Some(state)
    }
}

impl<S: Stepper> FusedIterator for States<'_, S> {}
