//! The states of an integration, one after the other.

use core::fmt;
use core::iter::FusedIterator;

use crate::{Compensated, Error, Hamiltonian, Integrator, Method, State, Summation, Vector};

/// The endless iterator that [`Integrator::states`] returns.
///
/// Every item is the state after one more step, cloned. After an error there are no more items.
pub struct States<'a, M: Method, S: Hamiltonian<V>, V: Vector, R: Summation = Compensated> {
    integrator: &'a mut Integrator<M, S, V, R>,
    failed: bool,
}

impl<'a, M: Method, S: Hamiltonian<V>, V: Vector, R: Summation> States<'a, M, S, V, R> {
    pub(crate) const fn new(integrator: &'a mut Integrator<M, S, V, R>) -> Self {
        Self {
            integrator,
            failed: false,
        }
    }
}

impl<M: Method, S: Hamiltonian<V>, V: Vector, R: Summation> Iterator for States<'_, M, S, V, R> {
    type Item = Result<State<V>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let state = self.integrator.step().cloned();
        self.failed = state.is_err();
        Some(state)
    }
}

impl<M: Method, S: Hamiltonian<V>, V: Vector, R: Summation> FusedIterator
    for States<'_, M, S, V, R>
{
}

impl<M: Method, S: Hamiltonian<V>, V: Vector, R: Summation> fmt::Debug for States<'_, M, S, V, R> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("States")
            .field("integrator", self.integrator)
            .field("failed", &self.failed)
            .finish()
    }
}
