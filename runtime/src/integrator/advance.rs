//! One step: taken, checked, and accepted or not.

use core::mem;
use core::ops::ControlFlow;

use super::{Integrator, PlanOf};
use crate::diagnosis::{Attempt, FirstFault};
use crate::stage::is_finite;
use crate::{
    Error, Failure, Hamiltonian, Kept, Method, Outcome, Plan, Solver, StageStorage, State, Step,
    Summation, Vector,
};

impl<M: Method, S: Hamiltonian<V>, V: Vector, R: Summation, N: Solver<V, S>>
    Integrator<M, S, V, R, N>
{
    /// One step of size `size`, to the time `time`. The clock is the caller's.
    #[inline]
    pub(crate) fn advance(&mut self, size: f64, time: f64) -> Result<(), Error> {
        match self.prepare(size, time) {
            Ok(()) => {
                self.accept(size, time);
                Ok(())
            }
            Err(error) => self.take_again(size, time, error).map(|_| ()),
        }
    }

    /// [`advance`](Self::advance) that shows the step to `see` as long as it does not break: each of its parts, if it has
    /// to be taken in parts.
    #[inline]
    pub(crate) fn advance_in_sight<B>(
        &mut self,
        size: f64,
        time: f64,
        see: &mut impl FnMut(&Self) -> Result<ControlFlow<B>, Error>,
    ) -> Result<ControlFlow<B>, Error> {
        match self.prepare(size, time) {
            Ok(()) => {
                self.accept(size, time);
                see(self)
            }
            Err(error) => self.take_again_in_sight(size, time, error, see),
        }
    }

    /// Computes a step of size `size`, to the time `time`, into `next`.
    #[inline]
    pub(super) fn prepare(&mut self, size: f64, time: f64) -> Result<(), Error> {
        if time == self.state.time {
            return Err(Error::TimeResolution {
                time,
                step_size: size,
            });
        }
        self.attempt(size)
            .map_err(|failure| self.fail(size, failure))
    }

    /// Makes the step that [`prepare`](Self::prepare) has computed the present state.
    #[inline]
    pub(super) fn accept(&mut self, size: f64, time: f64) {
        mem::swap(&mut self.state.q, &mut self.next.0);
        mem::swap(&mut self.state.p, &mut self.next.1);
        if R::COMPENSATED {
            mem::swap(&mut self.low, &mut self.next_low);
        }
        self.last_time = mem::replace(&mut self.state.time, time);
        self.statistics.count(self.work);
        self.last_size = size;
        self.kept = Kept {
            evaluation: true,
            stages: true,
        };
    }

    /// Computes a step into `next` and checks it.
    #[inline]
    fn attempt(&mut self, size: f64) -> Result<(), Option<Failure>> {
        let kept = Kept {
            stages: self.kept.stages && size == self.last_size,
            ..self.kept
        };
        self.work = <PlanOf<M, S, V> as Plan>::take::<R, V, S, N>(
            &step(&self.state, &self.low, size),
            &self.system,
            &mut self.memory,
            kept,
            self.max_iterations,
            outcome(&mut self.next, &mut self.next_low),
        )?;
        let (q1, p1) = &self.next;
        let dimension = self.state.q.dimension();
        let sound = self.memory.mismatch(dimension).is_none() && is_finite(q1) && is_finite(p1);
        if sound { Ok(()) } else { Err(None) }
    }

    /// Says why a step failed, and forgets everything that it left behind.
    #[cold]
    fn fail(&mut self, size: f64, failure: Option<Failure>) -> Error {
        let attempt = Attempt {
            time: self.state.time,
            step_size: size,
            step: self.statistics.steps + 1,
            dimension: self.state.q.dimension(),
        };
        let mut fault = FirstFault::new(attempt.dimension);
        if failure.is_none() {
            <PlanOf<M, S, V> as Plan>::observe::<R, V, S, N, FirstFault>(
                &step(&self.state, &self.low, size),
                &self.system,
                &mut self.memory,
                outcome(&mut self.next, &mut self.next_low),
                &mut fault,
            );
        }
        let error = attempt.error(failure, &fault, &self.memory, &self.next.0);
        self.memory = StageStorage::like(&self.state.q);
        self.kept = Kept::default();
        error
    }
}

/// A step of size `size` from a state and what it leaves out.
#[inline(always)]
const fn step<'a, V>(state: &'a State<V>, low: &'a (V, V), size: f64) -> Step<'a, V> {
    Step {
        time: state.time,
        size,
        q: &state.q,
        q_low: &low.0,
        p: &state.p,
        p_low: &low.1,
    }
}

/// Places for the result of a step.
#[inline(always)]
const fn outcome<'a, V>(next: &'a mut (V, V), low: &'a mut (V, V)) -> Outcome<'a, V> {
    Outcome {
        q: &mut next.0,
        q_low: &mut low.0,
        p: &mut next.1,
        p_low: &mut low.1,
    }
}
