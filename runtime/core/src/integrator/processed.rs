//! Runs of processed methods: the kernel in every step, the processor where a state is shown.

#[cfg(feature = "alloc")]
use alloc::format;
#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use core::fmt;
use core::mem;

#[cfg(feature = "alloc")]
use super::checkpoint::{Checkpoint, SaveWords};
use super::clock::RemainingSteps;
#[cfg(feature = "alloc")]
use super::fingerprint::system_fingerprint;
use super::memory::StepMemory;
use super::one_step::error_of;
use super::partitioned::{MemoryOf, Partitioned, PlanOf, step_memory_of};
use super::steps_beside::StepsBeside;
use super::{Equal, Integrator, NamedSteps, Run, Statistics, Stepper};
use crate::contract::Processed;
use crate::error::Error;
use crate::method::{Method, ProvedFor, Solver};
#[cfg(feature = "alloc")]
use crate::number::scalar_words;
#[cfg(feature = "alloc")]
use crate::number::words::{Visit, words};
use crate::number::{Compensated, Scalar, Summation, Vector};
use crate::state::State;
use crate::system::{Class, Named, System};

/// A run of a [`Processed`] method: `P ∘ Kⁿ ∘ P⁻¹`.
///
/// A step costs as much as one of the kernel K. The processor P is applied where a state is shown: after [`step`](Run::step), at the end of
/// [`take_steps`](Run::take_steps) and [`integrate_to`](Run::integrate_to), at output times and events. Its error is that of the whole method
/// and does not grow with time. So ask for few states: `take_steps(1000)` costs two processors, and a thousand calls of `step` cost two
/// thousand.
///
/// The run continues from the variables of the kernel, not from the state shown. A new step size, as the equal steps to an end need, begins
/// with other variables of the kernel. For a symmetric kernel a step backward has the processor of the same step forward; the run back is then
/// exact to rounding.
///
/// States inside a step are those of a shorter step of the whole method. Checkpoints store the variables of the kernel.
///
/// ```
/// // The symplectic Euler method; processed with half a kick it is Störmer–Verlet.
/// symplectic::splitting! { Verlet { kick: [1], drift: [1], processor: [kick: [1/2], drift: [0]] } }
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{Error, Integrator, ProcessedIntegrator, State, acceleration};
///
/// # fn main() -> Result<(), Error> {
/// let pendulum = || acceleration(|_time, q: &Vector1<f64>, acceleration| acceleration[0] = -q[0].sin());
/// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
/// let mut run = ProcessedIntegrator::new(Verlet, pendulum(), start.clone(), 0.1)?;
/// let mut by_steps = Integrator::new(Verlet, pendulum(), start, 0.1)?;
/// let (end, other) = (run.take_steps(1000)?, by_steps.take_steps(1000)?);
/// assert!((end.q - other.q).norm() < 1e-13 && (end.p - other.p).norm() < 1e-13);
/// # Ok(())
/// # }
/// ```
pub type ProcessedIntegrator<M, S, V, R = Compensated, N = <S as System<V>>::Solver> =
    Run<ProcessedSteps<M, S, V, R, N>>;

/// The steps of a [`ProcessedIntegrator`].
pub struct ProcessedSteps<M, S, V, R, N>
where
    M: Processed,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    method: M,
    kernel: Partitioned<M::Kernel, S, V, R, N>,
    processor: StepMemory<V, MemoryOf<M::Processor, S, V, N>>,
    inverse: StepMemory<V, MemoryOf<M::Inverse, S, V, N>>,
    moving: Moving<V>,
}

/// What a step changes beside the kernel.
#[derive(Clone)]
pub struct Moving<V> {
    /// The state that is shown, and its round-off.
    shown: State<V>,
    low: (V, V),
    /// The state at the start of the last step.
    start: State<V>,
    /// The size of the last step; 0 before the first one.
    last_size: f64,
    /// The size of the processor in the variables of the kernel; 0 before the first step from a new state.
    size: f64,
}

/// Sizes that differ by less, relatively, have the same processor up to rounding.
const SAME: f64 = 1e-12;

impl<M, S, V> ProcessedIntegrator<M, S, V>
where
    M: Processed + ProvedFor<S::Class>,
    S: System<V>,
    V: Vector,
{
    /// Creates an integrator at `state` with [`Compensated`] sums. A negative `step_size` steps backward.
    ///
    /// # Errors
    ///
    /// Those of [`Integrator::new`](crate::Integrator#method.new).
    pub fn new(method: M, system: S, state: State<V>, step_size: f64) -> Result<Self, Error> {
        Self::with_summation(method, system, state, step_size)
    }
}

impl<M, S, V, R, N> ProcessedIntegrator<M, S, V, R, N>
where
    M: Processed,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    /// [`new`](crate::ProcessedIntegrator#method.new) with the sums given by the type.
    ///
    /// # Errors
    ///
    /// Those of [`new`](crate::ProcessedIntegrator#method.new).
    pub fn with_summation(
        method: M,
        system: S,
        state: State<V>,
        step_size: f64,
    ) -> Result<Self, Error>
    where
        M: ProvedFor<S::Class>,
    {
        Integrator::<M, S, V, R, N>::check(&method, &system, &state, step_size)?;
        let (kernel, processor, inverse) = Default::default();
        S::Class::check_steps::<M::Kernel>(&kernel)?;
        S::Class::check_steps::<M::Processor>(&processor)?;
        S::Class::check_steps::<M::Inverse>(&inverse)?;
        let stepper = ProcessedSteps {
            processor: step_memory_of::<_, _, _, N>(&processor, &system, state.clone()),
            inverse: step_memory_of::<_, _, _, N>(&inverse, &system, state.clone()),
            method,
            kernel: Partitioned::unchecked(kernel, system, state.clone()),
            moving: Moving {
                low: (state.q.zeros_like(), state.q.zeros_like()),
                start: state.clone(),
                shown: state,
                last_size: 0.0,
                size: 0.0,
            },
        };
        Run::of(stepper, step_size)
    }

    /// The system.
    pub const fn system(&self) -> &S {
        self.stepper.kernel.system()
    }

    /// The energy of the present state, if the system provides it.
    pub fn energy(&self) -> Option<V::Scalar> {
        let State { time, q, p } = &self.stepper.moving.shown;
        let time = V::Scalar::from_f64(*time);
        self.stepper.kernel.system.energy(time, q, p)
    }
}

impl<M, S, V, R, N> ProcessedSteps<M, S, V, R, N>
where
    M: Processed,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    /// Goes to the variables of the kernel for steps of this size, unless they are the present ones.
    fn enter(&mut self, size: f64) -> Result<(), Error> {
        let symmetric = M::Kernel::SYMMETRY;
        let symmetric = symmetric.general || symmetric.separable;
        let size = if symmetric { size.abs() } else { size };
        let Self {
            kernel,
            inverse,
            moving,
            ..
        } = self;
        if (size - moving.size).abs() <= SAME * size.abs() {
            return Ok(());
        }
        let from = (&moving.shown, &moving.low);
        map::<M::Inverse, M::Kernel, S, V, R, N>(inverse, kernel, from, size)?;
        let kernel = &mut kernel.step_memory;
        kernel.forget();
        kernel.copy_state(&inverse.state);
        copy_pair(&mut kernel.low, &inverse.low);
        kernel.statistics.evaluations += inverse.statistics.evaluations;
        moving.size = size;
        Ok(())
    }

    /// Shows the state of the kernel.
    fn show(&mut self) -> Result<(), Error> {
        let Self {
            kernel,
            processor,
            moving,
            ..
        } = self;
        let from = (&kernel.step_memory.state, &kernel.step_memory.low);
        map::<M::Processor, M::Kernel, S, V, R, N>(processor, kernel, from, moving.size)?;
        kernel.step_memory.statistics.evaluations += processor.statistics.evaluations;
        moving.shown.copy_from(&processor.state);
        copy_pair(&mut moving.low, &processor.low);
        Ok(())
    }

    /// Takes all steps but the last, and shows the state before it. Takes the last one too if a state cannot be shown.
    fn take_most(&mut self, steps: &mut RemainingSteps) -> Result<(), Error> {
        let mut most = RemainingSteps {
            left: steps.left - 1,
            end: None,
            ..*steps
        };
        let before = self.kernel.save();
        let outcome = self.kernel.take(&mut most);
        if self.show().is_err() {
            // One of these steps cannot be shown: up to it they are taken alone.
            self.kernel.go_back(&before);
            while let Some((size, end)) = steps.next() {
                self.advance(size, end)?;
                steps.tick();
            }
            return Ok(());
        }
        *steps = RemainingSteps {
            left: most.left + 1,
            end: steps.end,
            ..most
        };
        outcome
    }

    /// Takes one step from the state shown.
    fn advance_shown(&mut self, size: f64, end: f64) -> Result<(), Error> {
        self.enter(size)?;
        let before = self.kernel.save();
        self.kernel.advance(size, end)?;
        let Moving { start, shown, .. } = &mut self.moving;
        start.copy_from(shown);
        if let Err(error) = self.show() {
            self.kernel.go_back(&before);
            return Err(error);
        }
        self.moving.last_size = size;
        Ok(())
    }
}

fn copy_pair<V: Vector>(to: &mut (V, V), from: &(V, V)) {
    to.0.as_mut_slice().copy_from_slice(from.0.as_slice());
    to.1.as_mut_slice().copy_from_slice(from.1.as_slice());
}

/// Applies the step of a method that takes no time. The result is the state of the memory.
fn map<M, K, S, V, R, N>(
    memory: &mut StepMemory<V, MemoryOf<M, S, V, N>>,
    kernel: &Partitioned<K, S, V, R, N>,
    (from, low): (&State<V>, &(V, V)),
    size: f64,
) -> Result<(), Error>
where
    M: Method,
    K: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    let (system, number) = (&kernel.system, kernel.step_memory.statistics.steps + 1);
    memory.forget();
    memory.copy_state(from);
    copy_pair(&mut memory.low, low);
    memory.statistics = Statistics::default();
    match memory.attempt::<PlanOf<M, S, V>, R, S, N>(system, size, kernel.stopping) {
        Ok(work) => {
            memory.accept::<R>(size, from.time, work);
            Ok(())
        }
        Err(failed) => Err(error_of::<M, S, V, R, N>(
            memory,
            system,
            size,
            number,
            failed.failure,
        )),
    }
}

impl<M, S, V, R, N> Stepper for ProcessedSteps<M, S, V, R, N>
where
    M: Processed,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    type State = State<V>;
    type Error = Error;
    type Pace = Equal;
    type Saved = ((State<V>, (V, V), Statistics), Moving<V>);

    fn state(&self) -> &State<V> {
        &self.moving.shown
    }

    fn into_state(self) -> State<V> {
        self.moving.shown
    }

    fn statistics(&self) -> &Statistics {
        self.kernel.statistics()
    }

    fn statistics_mut(&mut self) -> &mut Statistics {
        self.kernel.statistics_mut()
    }

    fn set_state(&mut self, state: &State<V>) -> Result<(), Error> {
        self.kernel.set_state(state)?;
        self.moving.show_new(state);
        Ok(())
    }

    fn advance(&mut self, size: f64, end: f64) -> Result<(), Error> {
        self.kernel.check_progress(size, end)?;
        self.advance_shown(size, end)
    }

    fn take(&mut self, steps: &mut RemainingSteps) -> Result<(), Error> {
        if steps.left > 1 {
            self.enter(steps.size)?;
            self.take_most(steps)?;
        }
        if let Some((size, end)) = steps.next() {
            self.advance(size, end)?;
            steps.tick();
        }
        Ok(())
    }

    fn save(&self) -> Self::Saved {
        (self.kernel.save(), self.moving.clone())
    }

    fn go_back(&mut self, (kernel, moving): &Self::Saved) {
        self.kernel.go_back(kernel);
        self.moving = moving.clone();
    }

    fn may_split(&self, error: &Error) -> bool {
        error.depends_on_the_size()
    }
}

impl<M, S, V, R, N> StepsBeside for ProcessedSteps<M, S, V, R, N>
where
    M: Processed,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    type Vector = V;
    type Moving = (StepMemory<V, MemoryOf<M::Kernel, S, V, N>>, Moving<V>);

    fn moving(&self) -> Self::Moving {
        (self.kernel.step_memory.clone(), self.moving.clone())
    }

    fn exchange(&mut self, (kernel, moving): &mut Self::Moving) {
        mem::swap(&mut self.kernel.step_memory, kernel);
        mem::swap(&mut self.moving, moving);
    }

    fn begin_beside(&mut self, _run: &Self::Moving, state: &State<V>, _size: f64) {
        self.kernel.step_memory.copy_state(state);
        self.moving.show_new(state);
    }

    fn last_step(&self) -> Option<(&State<V>, f64)> {
        let Moving {
            start, last_size, ..
        } = &self.moving;
        (*last_size != 0.0).then_some((start, *last_size))
    }
}

impl<M, S, V, R, N> NamedSteps for ProcessedSteps<M, S, V, R, N>
where
    M: Processed,
    S: System<V> + Named,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    type System = S;

    fn system(&self) -> &S {
        &self.kernel.system
    }
}

#[cfg(feature = "alloc")]
impl<M, S, V, R, N> SaveWords for ProcessedSteps<M, S, V, R, N>
where
    M: Processed,
    S: System<V>,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    fn blank_checkpoint(&self) -> Checkpoint {
        let definition = format!("{}, solver {}", self.method.identity(), N::name());
        let dimension = self.moving.shown.q.dimension();
        let blank = Checkpoint::of_method(M::NAME, definition, dimension);
        match R::COMPENSATED {
            true => blank.with_compensated_sums(),
            false => blank,
        }
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        let Partitioned {
            step_memory,
            stopping,
            ..
        } = &mut self.kernel;
        step_memory.scalar_words(visit);
        let StepMemory {
            state,
            kept,
            last_size,
            last_time,
            statistics,
            linear_velocity,
            ..
        } = step_memory;
        words!(visit: state.time, *last_size, *last_time, *statistics, *linear_velocity);
        words!(visit: kept.evaluation, kept.stages, kept.scales, stopping.max_iterations, stopping.tolerance);
        let Moving {
            shown,
            low,
            start,
            last_size,
            size,
        } = &mut self.moving;
        for vector in [
            &mut shown.q,
            &mut shown.p,
            &mut low.0,
            &mut low.1,
            &mut start.q,
            &mut start.p,
        ] {
            scalar_words(vector.as_mut_slice(), visit);
        }
        words!(visit: shown.time, start.time, *last_size, *size);
    }

    fn fingerprint(&mut self) -> Vec<f64> {
        let State { time, q, p } = &self.kernel.step_memory.state;
        let hashes = system_fingerprint(&self.kernel.system, *time, q, p);
        let halves = |hash: u64| [hash >> 32, hash & 0xffff_ffff].map(|half| half as f64);
        hashes.into_iter().flat_map(halves).collect()
    }
}

impl<V: Vector> Moving<V> {
    /// Shows a state from which no step has been taken.
    fn show_new(&mut self, state: &State<V>) {
        self.shown.copy_from(state);
        for low in [&mut self.low.0, &mut self.low.1] {
            low.as_mut_slice().fill(num_traits::Zero::zero());
        }
        (self.last_size, self.size) = (0.0, 0.0);
    }
}

impl<M, S, V, R, N> Clone for ProcessedSteps<M, S, V, R, N>
where
    M: Processed,
    S: System<V> + Clone,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    /// Both continue with the same bits.
    fn clone(&self) -> Self {
        Self {
            method: self.method.clone(),
            kernel: self.kernel.clone(),
            processor: self.processor.clone(),
            inverse: self.inverse.clone(),
            moving: self.moving.clone(),
        }
    }
}

impl<M, S, V, R, N> fmt::Debug for ProcessedSteps<M, S, V, R, N>
where
    M: Processed,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("ProcessedSteps")
            .field("method", &self.method.name())
            .field("state", &self.moving.shown)
            .field("statistics", self.kernel.statistics())
            .finish_non_exhaustive()
    }
}
