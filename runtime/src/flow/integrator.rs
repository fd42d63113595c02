//! Steps of a flow.

use super::memory::Memory;
use super::{Flow, FlowError, Span};
use crate::error::{Error, Quantity};
use crate::integrator::validation::{check_state, check_step_size};
use crate::integrator::{Run, Statistics, Stepper};
use crate::method::storage::is_finite;
use crate::number::words::{Visit, Words, words};
use crate::number::{Vector, copy};
use crate::state::State;

/// Integrates with a composed [`Flow`], such as a [`Splitting`](super::Splitting) or a [`Palindrome`](super::Palindrome).
///
/// Sums are not compensated. Steps do not allocate unless the flows do. A failed step is not [split](crate::Retry). A clone, if the flow
/// can be cloned, continues with the same bits. [`set_state`](Run::set_state) leaves the [memory](Flow::memory) of the flow as it is.
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
pub type FlowIntegrator<V, F> = Run<FlowSteps<V, F>>;

/// The steps of a [`FlowIntegrator`].
#[derive(Clone, Debug)]
pub struct FlowSteps<V, F> {
    pub(super) flow: F,
    pub(super) run_state: RunState<V>,
    /// Work space for the memory of the flow during a partial step.
    #[cfg(feature = "alloc")]
    present: Memory,
}

/// What a step changes, apart from the flow.
#[derive(Clone, Debug)]
pub(super) struct RunState<V> {
    pub(super) state: State<V>,
    pub(super) statistics: Statistics,
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
        check_step_size(step_size)?;
        let mut memory = Memory::default();
        memory.keep(&mut flow);
        let stepper = FlowSteps {
            flow,
            run_state: RunState {
                before: (state.q.clone(), state.p.clone()),
                last: None,
                memory,
                state,
                statistics: Statistics::default(),
            },
            #[cfg(feature = "alloc")]
            present: Memory::default(),
        };
        Self::of(stepper, step_size)
    }

    /// The flow of a step.
    pub const fn flow(&self) -> &F {
        &self.stepper.flow
    }
}

#[cfg(feature = "alloc")]
impl<V: Vector<Scalar = f64>, F: Flow<V>> FlowSteps<V, F> {
    /// Writes the state at the present time or at a time within the last step.
    pub(super) fn look_at(&mut self, time: f64, out: &mut State<V>) -> Result<(), Error> {
        let RunState {
            state,
            before,
            last,
            memory,
            statistics,
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
        taken.map_err(|failure| failed(failure, span, statistics.steps))
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

impl<V: Vector<Scalar = f64>, F: Flow<V>> Stepper for FlowSteps<V, F> {
    type State = State<V>;
    /// A step with noise is not repeated.
    type Saved = ();

    fn state(&self) -> &State<V> {
        &self.run_state.state
    }

    fn time(&self) -> f64 {
        self.run_state.state.time
    }

    fn statistics(&self) -> &Statistics {
        &self.run_state.statistics
    }

    fn statistics_mut(&mut self) -> &mut Statistics {
        &mut self.run_state.statistics
    }

    fn set_state(&mut self, state: &State<V>) -> Result<(), Error> {
        let RunState {
            state: own, last, ..
        } = &mut self.run_state;
        check_state(state.time, &state.q, &state.p, own.q.dimension())?;
        own.copy_from(state);
        *last = None;
        Ok(())
    }

    fn advance(&mut self, size: f64, end: f64) -> Result<(), Error> {
        let RunState {
            state,
            statistics,
            before,
            last,
            memory,
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
            return Err(failed(failure, span, statistics.steps + 1));
        }
        let start = state.time;
        *last = Some(Last { start, size });
        state.time = end;
        statistics.steps += 1;
        Ok(())
    }

    fn save(&self) {}

    fn go_back(&mut self, _saved: &()) {}
}
