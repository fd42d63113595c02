//! Steps of a flow.

use super::memory::Memory;
use super::{Flow, FlowError, Span};
use crate::Error;
use symplectic_core::inside::{check_state, check_step_size, copy, is_finite, words};
use symplectic_core::solver::{Visit, Words};
#[cfg(feature = "alloc")]
use symplectic_core::stepper::DenseSteps;
use symplectic_core::stepper::{Equal, Stepper};
use symplectic_core::{Quantity, Run, State, Statistics, Vector};

/// Integrates with a composed [`Flow`], such as a [`Splitting`](super::Splitting) or a [`Palindrome`](super::Palindrome).
///
/// Sums are not compensated. Steps do not allocate unless the flows do. A failed step is not [split](symplectic_core::Retry). A clone, if the flow
/// can be cloned, continues with the same bits. [`set_state`](Run::set_state) leaves the [memory](Flow::memory) of the flow as it is.
/// So after a [wall](symplectic_core::Event::wall), or a search that failed, position, momentum and time are those of the event or of the state
/// before the step, but the memory of the flow is that after the step. All other methods: [`Run`].
///
/// The errors of a step are [`Error::Flow`], and [`Error::Core`] with `NonFinite` or `TimeResolution`.
///
/// A state inside the last step is that of a shorter step of the flow from its start. It has the error of a step and costs as much. The
/// shorter step has the direction of the step, so it works for flows that cannot go backward. It starts with the memory of the start of the
/// step, and then restores the present memory. So noise uses the random numbers of the step. The state has the distribution of a shorter
/// step from the start; it is not a bridge, which would depend on the end too.
///
/// ```
/// symplectic::tableau! { Verlet { base: velocity-verlet } }
/// use symplectic::flow::{Drift, FlowSteps, Kick, Splitting};
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{State, acceleration};
///
/// # fn main() -> Result<(), symplectic::flow::Error> {
/// let spring = || acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0]);
/// let step = Splitting::new(Verlet, Drift::new(spring()), Kick::new(spring()));
/// let mut run = FlowSteps::run(step, State::from_arrays(0.0, [1.0], [0.0]), 0.001)?;
/// run.integrate_to(1.0)?;
/// assert_eq!(run.state().time, 1.0);
/// assert!((run.state().q[0] - 1.0_f64.cos()).abs() < 1e-6);
/// # Ok(())
/// # }
/// ```
///
/// # Checkpoints
///
/// With the feature `alloc` a [checkpoint](Run::checkpoint) contains state, step size, clock, last step, last event, and the
/// [memory](Flow::memory) of the flow. The flow itself is not stored. It is identified by a hash of a trial step from the present state;
/// the trial changes nothing. If a step of the flow from the stored state gives another result, [`restore`](Run::restore) returns
/// [`OtherSystem`](symplectic_core::CheckpointError::OtherSystem).
///
/// ```
/// use symplectic::flow::{Drift, FlowSteps, Kick, OrnsteinUhlenbeck, Palindrome};
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{State, acceleration};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let run = || {
///     let spring = || acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0]);
///     let bath = OrnsteinUhlenbeck::new(0.5, 1.0, [1.0], 2024)?;
///     let step = Palindrome::new(Kick::new(spring()), Palindrome::new(Drift::new(spring()), bath));
///     FlowSteps::run(step, State::from_arrays(0.0, [1.0], [0.0]), 0.1)
/// };
/// let mut whole = run()?;
/// whole.take_steps(100)?;
/// let checkpoint = whole.checkpoint()?;
///
/// // In another process, say.
/// let mut resumed = run()?;
/// resumed.restore(&checkpoint)?;
/// assert_eq!(resumed.take_steps(100)?, whole.take_steps(100)?);
/// # Ok(())
/// # }
/// ```
pub type FlowIntegrator<V, F> = Run<FlowSteps<V, F>>;

/// The steps of a [`FlowIntegrator`].
#[derive(Clone, Debug)]
pub struct FlowSteps<V, F> {
    pub(super) flow: F,
    pub(super) run_state: RunState<V>,
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

impl<V: Vector<Scalar = f64>, F: Flow<V>> FlowSteps<V, F> {
    /// An integrator at `state`, with steps of size `step_size`, negative to go backward.
    ///
    /// # Errors
    ///
    /// [`Error::Core`] with `StepSize`, `Dimension` or `NonFiniteState`.
    pub fn run(
        mut flow: F,
        state: State<V>,
        step_size: f64,
    ) -> Result<FlowIntegrator<V, F>, Error> {
        check_state(state.time, &state.q, &state.p, state.q.dimension())?;
        check_step_size(step_size)?;
        let mut memory = Memory::default();
        memory.keep(&mut flow);
        let stepper = Self {
            flow,
            run_state: RunState {
                before: (state.q.clone(), state.p.clone()),
                last: None,
                memory,
                state,
                statistics: Statistics::default(),
            },
        };
        Ok(Run::of(stepper, step_size)?)
    }

    /// The flow of a step.
    pub const fn flow(&self) -> &F {
        &self.flow
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
        FlowError::NonFinite { what } => Error::Core(symplectic_core::Error::NonFinite {
            time,
            step_size,
            step,
            what,
            stage: None,
        }),
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
    type Error = Error;
    type Pace = Equal;
    /// A step with noise is not repeated.
    type Saved = ();

    fn state(&self) -> &State<V> {
        &self.run_state.state
    }

    fn into_state(self) -> State<V> {
        self.run_state.state
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

    fn may_split(&self, _error: &Error) -> bool {
        false
    }
}

/// Without memory of the flow, looks would change its random numbers.
#[cfg(feature = "alloc")]
impl<V: Vector<Scalar = f64>, F: Flow<V>> DenseSteps for FlowSteps<V, F> {
    type Vector = V;
    /// The present memory of the flow, during a shorter step.
    type Scratch = Memory;

    fn scratch(&self) -> Memory {
        Memory::default()
    }

    fn last_span(&self) -> Option<(f64, f64)> {
        let last = self.run_state.last?;
        Some((last.start, self.run_state.state.time))
    }

    fn write_start(&self, out: &mut State<V>) {
        let RunState {
            state,
            before,
            last,
            ..
        } = &self.run_state;
        match last {
            Some(last) => {
                out.time = last.start;
                copy(&mut out.q, &before.0);
                copy(&mut out.p, &before.1);
            }
            None => out.copy_from(state),
        }
    }

    /// By a shorter step from the start of the last step, with the memory of the flow there.
    fn look(&mut self, time: f64, present: &mut Memory, out: &mut State<V>) -> Result<(), Error> {
        if time == self.run_state.state.time {
            out.copy_from(&self.run_state.state);
            return Ok(());
        }
        self.write_start(out);
        let (start, end) = self.last_span().ok_or(symplectic_core::Error::NoStep)?;
        if !(start.min(end) <= time && time <= start.max(end)) {
            return Err(symplectic_core::Error::OutsideStep { time, start, end }.into());
        }
        if time == start {
            return Ok(());
        }
        let Self { flow, run_state } = self;
        let size = run_state.last.map_or(0.0, |last| last.size);
        let span = Span {
            time: start,
            size: size * ((time - start) / (end - start)),
        };
        present.keep(flow);
        run_state.memory.put_back(flow);
        let taken = take(flow, span, out);
        present.put_back(flow);
        out.time = time;
        taken.map_err(|failure| failed(failure, span, run_state.statistics.steps))
    }

    /// Difference quotients of a short step forward; 0 if it fails.
    fn slopes(&mut self, state: &State<V>, size: f64, velocity: &mut V, force: &mut V) {
        copy(velocity, &state.q);
        copy(force, &state.p);
        let mut present = Memory::default();
        present.keep(&mut self.flow);
        let span = Span {
            time: state.time,
            size,
        };
        let taken = self.flow.flow(span, velocity, force);
        present.put_back(&mut self.flow);
        for (end, start) in [(velocity, &state.q), (force, &state.p)] {
            let pairs = end.as_mut_slice().iter_mut().zip(start.as_slice());
            pairs.for_each(|(end, start)| match taken {
                Ok(()) => *end = (*end - start) / size,
                Err(_) => *end = 0.0,
            });
        }
    }
}
