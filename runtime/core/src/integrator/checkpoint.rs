//! Checkpoints: interrupted runs continue with the same bits.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;

use crate::integrator::clock::Clock;
use crate::integrator::fingerprint::{hash_of, system_fingerprint};
use crate::integrator::last_step::LastEvent;
use crate::integrator::memory::StepMemory;
use crate::integrator::parts::parts_of;
use crate::integrator::{Integrator, Retry, Run, Statistics, Stepper};
use crate::method::{Method, Solver, Stopping, WarmStart};
use crate::number::words::{Visit, Words, words};
use crate::number::{Scalar, Summation, Vector};
use crate::state::State;
use crate::system::System;

/// Everything that a run needs to continue from its present state with the bits of an uninterrupted run.
///
/// It contains the state with the round-off of its compensated sums, and the stages from which the next ones are extrapolated. It also
/// contains the matrices of Newton's iteration, clock, step size, tolerance and statistics. All integrators of this library have checkpoints.
///
/// With the feature `serde` it can be written in any format. All numbers are in `words`: sixteen hexadecimal digits for each word of
/// 64 bits, or eight bytes in a binary format. A word is the bits of an IEEE 754 double, of a single in its lower half, or of an integer.
/// The order of the words belongs to the number `format`. Versions of the library with the same number read each other's checkpoints, and
/// those of older formats if the words of the run have not changed; the run then continues with the arithmetic of the version that reads.
/// Binary files that were written before format 2 contained digits; they are not read.
///
/// ```
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{Error, Integrator, State, acceleration};
///
/// symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let run = || {
///     let pendulum = acceleration(|_time, q: &Vector1<f64>, acceleration| acceleration[0] = -q[0].sin());
///     Integrator::new(Gauss4, pendulum, State::new(0.0, Vector1::new(1.0), Vector1::new(0.0)), 0.1)
/// };
/// let mut whole = run()?;
/// whole.take_steps(100)?;
/// let checkpoint = whole.checkpoint()?;
/// whole.take_steps(100)?;
///
/// // In another process, say.
/// let mut resumed = run()?;
/// resumed.restore(&checkpoint)?;
/// resumed.take_steps(100)?;
/// assert_eq!(resumed.state(), whole.state());
/// assert_eq!(resumed.statistics(), whole.statistics());
/// # Ok(())
/// # }
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct Checkpoint {
    /// Number of the order of the words.
    pub(super) format: u32,
    /// The version of the library that wrote it.
    pub(super) version: String,
    /// Name and definition of the method.
    pub(super) method: String,
    pub(super) definition: String,
    /// The type of the numbers.
    pub(super) scalar: String,
    pub(super) sums: String,
    pub(super) solver: String,
    pub(super) dimension: usize,
    /// The words, each as eight bytes, the lowest first.
    pub(super) words: Vec<u8>,
    /// What was wrong when it was read.
    pub(super) damage: Option<&'static str>,
}

impl fmt::Debug for Checkpoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("Checkpoint");
        shown.field("format", &self.format);
        shown.field("version", &self.version);
        for (name, value) in self.header() {
            shown.field(name, &value);
        }
        let words: String = self
            .words
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect();
        shown.field("words", &words).finish_non_exhaustive()
    }
}

crate::error::debug::debug_by_message!(CheckpointError);

/// Why a run cannot be saved, or cannot continue from a checkpoint.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The numbers of the run are neither f64 nor f32.
    #[error("numbers of this type cannot be saved: only f64 and f32 can")]
    Scalar,

    /// The checkpoint has the words in an order that this version does not read.
    #[error(
        "the checkpoint has format {format} and was written by version {version} of this library; this version continues such runs from \
         format {own}: continue with version {version}, or begin a new run from a state",
        own = Checkpoint::FORMAT
    )]
    OtherFormat {
        /// The number of its format.
        format: u32,
        /// The version that wrote it.
        version: String,
    },

    /// The checkpoint belongs to another run.
    #[error(
        "the {what} of the checkpoint is `{found}`, that of this integrator `{expected}`: construct the integrator with the same {what}"
    )]
    OtherRun {
        /// Method, definition, scalar, sums, solver or dimension.
        what: &'static str,
        /// Its value in the checkpoint.
        found: String,
        /// Its value in the integrator.
        expected: String,
    },

    /// The system gives another velocity, force, constraint, Lagrangian, flow, moment of inertia or torque at or near the state of the
    /// checkpoint.
    #[error(
        "the system gives another velocity, force, constraint, Lagrangian, flow, moment of inertia or torque at or near the state of the \
         checkpoint: it is another system, or has other parameters"
    )]
    OtherSystem,

    /// The checkpoint is truncated or was changed.
    #[error("the checkpoint is damaged: {reason}; take an earlier one")]
    Damaged {
        /// What is wrong.
        reason: &'static str,
    },
}

impl Checkpoint {
    /// The format of this version: a new number for every change of the order of the words of any run. Format 2: planets carry the
    /// round-off of their centre of mass. Format 3: runs of a flow carry their last event.
    pub(super) const FORMAT: u32 = 3;

    /// The method of a flow.
    const OF_FLOW: &str = "steps of a flow";

    /// Whether it is the same except for the version that wrote it.
    #[doc(hidden)]
    pub fn is_same_run(&self, other: &Self) -> bool {
        let version = self.version.clone();
        *self
            == Self {
                version,
                ..other.clone()
            }
    }

    /// An empty checkpoint of a flow. `carried` is the number of words of the flow's own memory; flows with another number are told apart.
    #[doc(hidden)]
    pub fn of_flow(dimension: usize, carried: usize) -> Self {
        let definition = format!("words carried: {carried}");
        Self::of_method(Self::OF_FLOW, definition, dimension)
    }

    /// An empty checkpoint of a method, with plain sums of doubles.
    #[doc(hidden)]
    pub fn of_method(method: &str, definition: String, dimension: usize) -> Self {
        Self {
            format: Self::FORMAT,
            version: env!("CARGO_PKG_VERSION").to_string(),
            method: method.to_string(),
            definition,
            scalar: f64::SAVED_AS.unwrap_or_default().to_string(),
            sums: "plain".to_string(),
            solver: String::new(),
            dimension,
            words: Vec::new(),
            damage: None,
        }
    }

    /// The same with compensated sums.
    #[doc(hidden)]
    #[must_use]
    pub fn with_compensated_sums(self) -> Self {
        let sums = "compensated".to_string();
        Self { sums, ..self }
    }

    /// An empty checkpoint of values that are computed beside a run.
    #[doc(hidden)]
    pub fn of_values(name: &str) -> Self {
        Self::of_method(name, String::new(), 0)
    }

    /// Fills a checkpoint with the words that `show` shows.
    #[doc(hidden)]
    pub fn filled(mut self, show: impl FnOnce(&mut Visit<'_>)) -> Self {
        let words = &mut self.words;
        show(&mut |word| words.extend_from_slice(&word.to_le_bytes()));
        self
    }

    /// Lets `take` replace its words by those of this checkpoint. It must have the same number of words, and the other fields of `own`.
    #[doc(hidden)]
    pub fn read(
        &self,
        own: &Self,
        take: impl FnOnce(&mut Visit<'_>),
    ) -> Result<(), CheckpointError> {
        let other_format = CheckpointError::OtherFormat {
            format: self.format,
            version: self.version.clone(),
        };
        if !(1..=Self::FORMAT).contains(&self.format) {
            return Err(other_format);
        }
        // Only flows had other words in an older format.
        let is_older = self.format < Self::FORMAT && self.method == Self::OF_FLOW;
        for ((what, found), (_, expected)) in self.header().into_iter().zip(own.header()) {
            if is_older && what == "definition" && found != expected {
                return Err(other_format);
            }
            if found != expected {
                return Err(CheckpointError::OtherRun {
                    what,
                    found,
                    expected,
                });
            }
        }
        if let Some(reason) = self.damage {
            return Err(CheckpointError::Damaged { reason });
        }
        let (words, rest) = self.words.as_chunks();
        let (mut words, mut missing) = (words.iter(), !rest.is_empty());
        take(&mut |word| match words.next() {
            Some(found) => *word = u64::from_le_bytes(*found),
            None => missing = true,
        });
        if (missing || words.next().is_some()) && is_older {
            return Err(other_format);
        }
        if missing || words.next().is_some() {
            let reason = "it has more or fewer words than this run";
            return Err(CheckpointError::Damaged { reason });
        }
        Ok(())
    }

    /// The fields that are the same for the same run, with their names.
    pub(super) fn header(&self) -> [(&'static str, String); 6] {
        [
            ("method", self.method.clone()),
            ("definition", self.definition.clone()),
            ("scalar", self.scalar.clone()),
            ("sums", self.sums.clone()),
            ("solver", self.solver.clone()),
            ("dimension", self.dimension.to_string()),
        ]
    }
}

/// A stepper of another package whose runs can be saved.
pub trait Save: Stepper + Sized {
    /// See [`Run::checkpoint`].
    ///
    /// # Errors
    ///
    /// Those of [`Run::checkpoint`].
    fn checkpoint(run: &mut Run<Self>) -> Result<Checkpoint, CheckpointError>;

    /// See [`Run::restore`].
    ///
    /// # Errors
    ///
    /// Those of [`Run::restore`].
    fn restore(run: &mut Run<Self>, checkpoint: &Checkpoint) -> Result<(), CheckpointError>;
}

/// A stepper whose checkpoints consist of the words of its run, its own, and the fingerprint of its system.
pub trait SaveWords: Stepper {
    /// A checkpoint without words.
    fn blank_checkpoint(&self) -> Checkpoint;

    /// Shows `visit` every word on which the next steps depend.
    fn words(&mut self, visit: &mut Visit<'_>);

    /// Numbers that differ for a system with other parameters, at the present state. Those that are not finite are ignored.
    fn fingerprint(&mut self) -> Vec<f64>;
}

impl<S: SaveWords> Save for S {
    fn checkpoint(run: &mut Run<S>) -> Result<Checkpoint, CheckpointError> {
        Ok(run.stepper.blank_checkpoint().filled(|visit| {
            words!(visit: parts_of(run), hash_of(run.stepper.fingerprint()));
            run.stepper.words(visit);
        }))
    }

    fn restore(run: &mut Run<S>, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
        let present = Self::checkpoint(run)?;
        let read = |run: &mut Run<S>, checkpoint: &Checkpoint| {
            let mut fingerprint = 0;
            checkpoint.read(&present, |visit| {
                words!(visit: parts_of(run), fingerprint);
                run.stepper.words(visit);
            })?;
            Ok(fingerprint)
        };
        let reason = match read(run, checkpoint) {
            Ok(fingerprint) if fingerprint == hash_of(run.stepper.fingerprint()) => return Ok(()),
            Ok(_) => CheckpointError::OtherSystem,
            Err(error) => error,
        };
        // Back to what the run was.
        read(run, &present)?;
        Err(reason)
    }
}

impl<S: Save> Run<S> {
    /// All that the run needs to [continue](Self::restore) from here with the same bits: see [`Checkpoint`].
    ///
    /// # Errors
    ///
    /// [`CheckpointError::Scalar`].
    pub fn checkpoint(&mut self) -> Result<Checkpoint, CheckpointError> {
        S::checkpoint(self)
    }

    /// Continues from a checkpoint of a run of the same kind.
    ///
    /// # Errors
    ///
    /// [`CheckpointError`]; the run is then unchanged.
    pub fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
        S::restore(self, checkpoint)
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// A checkpoint from which the run can [continue](crate::Integrator#method.restore) with the same bits.
    ///
    /// # Errors
    ///
    /// [`CheckpointError::Scalar`].
    pub fn checkpoint(&self) -> Result<Checkpoint, CheckpointError> {
        self.checkpoint_with("", self.last_event, &[])
    }

    /// A checkpoint of a run of kind `kind`, with its last event and the values `beside` that change in addition to the integrator.
    #[doc(hidden)]
    pub fn checkpoint_with(
        &self,
        kind: &str,
        last_event: Option<LastEvent>,
        beside: &[f64],
    ) -> Result<Checkpoint, CheckpointError> {
        let mut numbers = Numbers {
            last_event,
            ..self.numbers()
        };
        Ok(self.blank_checkpoint(kind)?.filled(|visit| {
            numbers.words(visit, |visit| self.stepper.step_memory.show_scalars(visit));
            beside.iter().for_each(|value| visit(&mut value.to_bits()));
        }))
    }

    /// Continues from a checkpoint of an integrator with the same method, system, sums and solver, for vectors of the same dimension. State
    /// and step size become those of the checkpoint.
    ///
    /// # Errors
    ///
    /// [`CheckpointError`]; the integrator is then unchanged.
    pub fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
        self.restore_with("", checkpoint, &mut [], |_, _| true)
    }

    /// Continues from a checkpoint of [kind](Self::checkpoint_with) `kind`, if `mine` accepts the position and the values beside the
    /// integrator.
    #[doc(hidden)]
    pub fn restore_with(
        &mut self,
        kind: &str,
        checkpoint: &Checkpoint,
        beside: &mut [f64],
        mine: impl FnOnce(&V, &[f64]) -> bool,
    ) -> Result<(), CheckpointError> {
        let (mut numbers, mut step_memory) = (self.numbers(), self.stepper.step_memory.clone());
        checkpoint.read(&self.blank_checkpoint(kind)?, |visit| {
            numbers.words(visit, |visit| step_memory.scalar_words(visit));
            beside.words(visit);
        })?;
        step_memory.state.time = numbers.time;
        let known = numbers.fingerprint == fingerprint_at(&self.stepper.system, &step_memory.state);
        if !known || !mine(&step_memory.state.q, beside) {
            return Err(CheckpointError::OtherSystem);
        }
        self.stepper.step_memory = StepMemory {
            kept: numbers.kept,
            last_size: numbers.last_size,
            last_time: numbers.last_time,
            statistics: numbers.statistics,
            linear_velocity: numbers.linear_velocity,
            ..step_memory
        };
        self.clock = numbers.clock;
        self.step_size = numbers.step_size;
        self.stepper.stopping = numbers.stopping;
        self.retry = numbers.retry;
        self.last_event = numbers.last_event;
        Ok(())
    }

    /// A checkpoint without words, of a run of kind `kind`.
    fn blank_checkpoint(&self, kind: &str) -> Result<Checkpoint, CheckpointError> {
        let sums = if R::COMPENSATED {
            "compensated"
        } else {
            "plain"
        };
        Ok(Checkpoint {
            format: Checkpoint::FORMAT,
            version: env!("CARGO_PKG_VERSION").to_string(),
            method: match kind {
                "" => M::NAME.to_string(),
                _ => format!("{}, {kind}", M::NAME),
            },
            definition: self.stepper.method.identity(),
            scalar: V::Scalar::SAVED_AS
                .ok_or(CheckpointError::Scalar)?
                .to_string(),
            sums: sums.to_string(),
            solver: N::name(),
            dimension: self.stepper.step_memory.state.q.dimension(),
            words: Vec::new(),
            damage: None,
        })
    }

    /// Everything that the words store beside the scalars of the [`StepMemory`].
    fn numbers(&self) -> Numbers {
        let StepMemory {
            state,
            kept,
            last_size,
            last_time,
            statistics,
            linear_velocity,
            ..
        } = &self.stepper.step_memory;
        Numbers {
            time: state.time,
            step_size: self.step_size,
            kept: *kept,
            last_size: *last_size,
            last_time: *last_time,
            linear_velocity: *linear_velocity,
            statistics: *statistics,
            clock: self.clock,
            stopping: self.stepper.stopping,
            retry: self.retry,
            last_event: self.last_event,
            fingerprint: fingerprint_at(&self.stepper.system, state),
        }
    }
}

/// The numbers that change in a run, beside the scalars of its memory.
struct Numbers {
    time: f64,
    step_size: f64,
    kept: WarmStart,
    last_size: f64,
    last_time: f64,
    linear_velocity: bool,
    statistics: Statistics,
    clock: Clock,
    stopping: Stopping,
    retry: Retry,
    last_event: Option<LastEvent>,
    /// Detects a system with other parameters.
    fingerprint: [u64; 2],
}

impl Numbers {
    /// Shows `visit` every word; `scalars` does so for the memory of the steps.
    fn words(&mut self, visit: &mut Visit<'_>, scalars: impl FnOnce(&mut Visit<'_>)) {
        words!(visit: self.time, self.step_size);
        scalars(visit);
        let WarmStart {
            evaluation,
            stages,
            scales,
        } = &mut self.kept;
        words!(visit: *evaluation, *stages, *scales, self.last_size, self.last_time, self.linear_velocity);
        words!(visit: self.statistics, self.clock, self.stopping.max_iterations, self.stopping.tolerance);
        words!(visit: self.retry, self.last_event, self.fingerprint);
    }
}

/// [`system_fingerprint`] at a state.
fn fingerprint_at<V: Vector, S: System<V>>(
    system: &S,
    State { time, q, p }: &State<V>,
) -> [u64; 2] {
    system_fingerprint(system, *time, q, p)
}
