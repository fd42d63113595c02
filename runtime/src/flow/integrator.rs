//! Steps of a flow.

use super::memory::Memory;
use super::{Flow, FlowError, Span};
use crate::error::{Error, Quantity};
use crate::integrator::StepMap;
use crate::integrator::step_clock::{StepClock, Stepper};
use crate::integrator::validation::check_state;
use crate::method::storage::is_finite;
use crate::number::words::{Visit, Words, words};
use crate::number::{Vector, copy};
use crate::state::State;

/// Integrates with a composed [`Flow`], such as a [`Splitting`](super::Splitting) or a [`Palindrome`](super::Palindrome).
///
/// A failed step leaves the state untouched. Sums are not compensated. Steps do not allocate unless the flows do. A clone, if the flow
/// can be cloned, continues with the same bits.
///
/// ```
/// symplectic::tableau! { Verlet { base: velocity-verlet } }
/// use symplectic::flow::{Drift, FlowIntegrator, Kick, Splitting};
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{State, acceleration};
///
/// # fn main() -> Result<(), symplectic::Error> {
/// let spring = || acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0]);
/// let step = Splitting::new(Verlet, Drift::new(spring()), Kick::new(spring()));
/// let mut run = FlowIntegrator::new(step, State::from_arrays(0.0, [1.0], [0.0]), 0.001)?;
/// run.integrate_to(1.0)?;
/// assert_eq!(run.state().time, 1.0);
/// assert!((run.state().q[0] - 1.0_f64.cos()).abs() < 1e-6);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct FlowIntegrator<V, F> {
    pub(super) flow: F,
    pub(super) run_state: RunState<V>,
    /// Work space for the memory of the flow during a partial step.
    #[cfg(feature = "alloc")]
    present: Memory,
}

/// What a step changes, apart from the flow.
#[derive(Clone, Debug)]
pub(super) struct RunState<V> {
    pub(super) step_clock: StepClock,
    pub(super) state: State<V>,
    /// Position and momentum before the last step.
    pub(super) before: (V, V),
    pub(super) last: Option<Last>,
    /// The memory of the flow before the last step.
    pub(super) memory: Memory,
}

/// The last step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Last {
    pub(super) start: f64,
    pub(super) size: f64,
}

impl Words for Last {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.start, self.size);
    }
}

impl<V: Vector<Scalar = f64>, F: Flow<V>> FlowIntegrator<V, F> {
    /// An integrator at `state`, with steps of size `step_size`, negative to go backward.
    ///
    /// # Errors
    ///
    /// [`Error::StepSize`], [`Error::Dimension`], [`Error::NonFiniteState`].
    pub fn new(mut flow: F, state: State<V>, step_size: f64) -> Result<Self, Error> {
        check_state(state.time, &state.q, &state.p, state.q.dimension())?;
        let mut memory = Memory::default();
        memory.keep(&mut flow);
        Ok(Self {
            flow,
            run_state: RunState {
                step_clock: StepClock::new(state.time, step_size)?,
                before: (state.q.clone(), state.p.clone()),
                last: None,
                memory,
                state,
            },
            #[cfg(feature = "alloc")]
            present: Memory::default(),
        })
    }

    /// Takes one step and returns the state after it. The time after `k` steps is `start + k h`.
    ///
    /// # Errors
    ///
    /// [`Error::Flow`], [`Error::NonFinite`], [`Error::TimeResolution`]; the state is untouched.
    pub fn step(&mut self) -> Result<&State<V>, Error> {
        self.one_step()?;
        Ok(&self.run_state.state)
    }

    /// Takes `count` steps and returns the state after them.
    ///
    /// # Errors
    ///
    /// Those of [`step`](Self::step); the state is then that of the last successful step.
    pub fn take_steps(&mut self, count: u64) -> Result<&State<V>, Error> {
        for _ in 0..count {
            self.one_step()?;
        }
        Ok(&self.run_state.state)
    }

    /// An endless iterator over the states after each step, cloned. After an error there are no more items.
    pub fn states(&mut self) -> impl Iterator<Item = Result<State<V>, Error>> {
        let mut failed = false;
        core::iter::from_fn(move || {
            if failed {
                return None;
            }
            let state = self.step().cloned();
            failed = state.is_err();
            Some(state)
        })
    }

    /// Integrates to the time `end` exactly, forward or backward, in the smallest number of equal steps no longer than the step size.
    ///
    /// # Errors
    ///
    /// [`Error::EndTime`], [`Error::StepCount`], and those of [`step`](Self::step); the state is then that of the last successful step.
    pub fn integrate_to(&mut self, end: f64) -> Result<&State<V>, Error> {
        self.steps_to(end)?;
        Ok(&self.run_state.state)
    }

    /// Like [`integrate_to`](Self::integrate_to), and calls `observe` with the state after every step.
    ///
    /// # Errors
    ///
    /// As for [`integrate_to`](Self::integrate_to).
    pub fn integrate_with<O: FnMut(&State<V>)>(
        &mut self,
        end: f64,
        mut observe: O,
    ) -> Result<&State<V>, Error> {
        self.steps_in_sight(end, |run| observe(&run.run_state.state))?;
        Ok(&self.run_state.state)
    }

    /// The present state.
    pub const fn state(&self) -> &State<V> {
        &self.run_state.state
    }

    /// The present state, by value.
    pub fn into_state(self) -> State<V> {
        self.run_state.state
    }

    /// Replaces the present state by another state of the same dimension. The [memory](Flow::memory) of the flow stays.
    ///
    /// # Errors
    ///
    /// [`Error::Dimension`], [`Error::NonFiniteState`]; the state is then untouched.
    pub fn set_state(&mut self, state: State<V>) -> Result<(), Error> {
        let dimension = self.run_state.state.q.dimension();
        check_state(state.time, &state.q, &state.p, dimension)?;
        self.run_state.step_clock.restart(state.time);
        self.run_state.state = state;
        self.run_state.last = None;
        Ok(())
    }

    /// The flow of a step.
    pub const fn flow(&self) -> &F {
        &self.flow
    }

    /// The step size.
    pub const fn step_size(&self) -> f64 {
        self.run_state.step_clock.step_size()
    }

    /// Steps taken.
    pub const fn steps(&self) -> u64 {
        self.run_state.step_clock.taken()
    }

    /// Changes the step size; negative to go backward.
    ///
    /// # Errors
    ///
    /// [`Error::StepSize`]; the step size is then unchanged.
    pub fn set_step_size(&mut self, step_size: f64) -> Result<(), Error> {
        let time = self.run_state.state.time;
        self.run_state.step_clock.set_step_size(time, step_size)
    }

    /// Writes the state at the present time or at a time within the last step.
    #[cfg(feature = "alloc")]
    pub(super) fn look_at(&mut self, time: f64, out: &mut State<V>) -> Result<(), Error> {
        let RunState {
            state,
            before,
            last,
            memory,
            step_clock,
        } = &self.run_state;
        out.time = time;
        if time == state.time {
            copy(&mut out.q, &state.q);
            copy(&mut out.p, &state.p);
            return Ok(());
        }
        let (Last { start, size }, end) = (last.ok_or(Error::NoStep)?, state.time);
        if !(start.min(end) <= time && time <= start.max(end)) {
            return Err(Error::OutsideStep { time, start, end });
        }
        copy(&mut out.q, &before.0);
        copy(&mut out.p, &before.1);
        if time == start {
            return Ok(());
        }
        let span = Span {
            time: start,
            size: size * ((time - start) / (end - start)),
        };
        self.present.keep(&mut self.flow);
        memory.put_back(&mut self.flow);
        let taken = take(&mut self.flow, span, out);
        self.present.put_back(&mut self.flow);
        taken.map_err(|failure| failed(failure, span, step_clock.taken()))
    }
}

/// Applies a flow and checks the result.
fn take<V: Vector<Scalar = f64>, F: Flow<V>>(
    flow: &mut F,
    span: Span,
    state: &mut State<V>,
) -> Result<(), FlowError> {
    let dimension = state.q.dimension();
    flow.flow(span, &mut state.q, &mut state.p)?;
    check_end(dimension, state)
}

/// Checks the result of a flow.
pub(super) fn check_end<V: Vector<Scalar = f64>>(
    dimension: usize,
    State { q, p, .. }: &State<V>,
) -> Result<(), FlowError> {
    super::check_dimension(dimension, q)?;
    super::check_dimension(dimension, p)?;
    let what = if !is_finite(q) {
        Quantity::Position
    } else if !is_finite(p) {
        Quantity::Momentum
    } else {
        return Ok(());
    };
    Err(FlowError::NonFinite { what })
}

/// The error of a step.
pub(super) const fn failed(failure: FlowError, span: Span, step: u64) -> Error {
    let (time, step_size) = (span.time, span.size);
    match failure {
        FlowError::NonFinite { what } => Error::NonFinite {
            time,
            step_size,
            step,
            what,
            stage: None,
        },
        failure => Error::Flow {
            time,
            step_size,
            step,
            failure,
        },
    }
}

impl<V: Vector<Scalar = f64>, F: Flow<V>> Stepper for FlowIntegrator<V, F> {
    fn step_clock(&mut self) -> &mut StepClock {
        &mut self.run_state.step_clock
    }

    fn time(&self) -> f64 {
        self.run_state.state.time
    }

    fn advance(&mut self, size: f64, end: f64, number: u64) -> Result<(), Error> {
        let RunState {
            state,
            before,
            last,
            memory,
            ..
        } = &mut self.run_state;
        let span = Span {
            time: state.time,
            size,
        };
        copy(&mut before.0, &state.q);
        copy(&mut before.1, &state.p);
        memory.keep(&mut self.flow);
        if let Err(failure) = take(&mut self.flow, span, state) {
            state.q.clone_from(&before.0);
            state.p.clone_from(&before.1);
            memory.put_back(&mut self.flow);
            *last = None;
            return Err(failed(failure, span, number));
        }
        let start = state.time;
        *last = Some(Last { start, size });
        state.time = end;
        Ok(())
    }
}

impl<V: Vector<Scalar = f64>, F: Flow<V>> StepMap for FlowIntegrator<V, F>
where
    Self: Clone,
{
    type State = State<V>;

    fn present(&self) -> &State<V> {
        &self.run_state.state
    }

    fn step_from(&self, state: State<V>) -> Result<State<V>, Error> {
        let mut run = self.clone();
        run.set_state(state)?;
        run.step()?;
        Ok(run.into_state())
    }
}
