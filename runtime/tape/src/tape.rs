//! A formula as a list of operations on registers.
//!
//! A tape has the operations that the macro emits for the same formula.

use std::sync::Arc;

use symplectic::Scalar;
use symplectic::simd::MAX_LANES;
use symplectic_formula::System;
use symplectic_formula::graph::Id;

use crate::inputs::Inputs;
use crate::operation::Code;
use crate::unroll::{Refusal, Unrolled};
use crate::values::Values;

/// The number of a register.
pub(crate) type Register = u32;

/// An operation on some operands, with its results in successive registers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    pub(crate) code: Code,
    /// The kind of each operand if they form rows, which are computed in chunks.
    pub(crate) row: Option<[Operand; 3]>,
    /// The first register that it writes.
    pub(crate) into: Register,
    /// How often it is applied.
    pub(crate) count: u32,
}

/// The registers of an operand in a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Operand {
    /// The same register for the whole row.
    Same,
    /// Successive registers.
    Row,
}

/// The initial value of a register.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Input {
    /// A number.
    Constant(f64),
    /// The time.
    Time,
    /// A component of q.
    Position(usize),
    /// A component of p.
    Momentum(usize),
    /// A parameter that varies between trajectories.
    Parameter(usize),
}

impl Input {
    /// The half of the state, 0 for q and 1 for p, and the component that it reads; `None` for other inputs.
    pub(crate) fn component(self) -> Option<(usize, usize)> {
        match self {
            Input::Position(k) => Some((0, k)),
            Input::Momentum(k) => Some((1, k)),
            _ => None,
        }
    }

    /// The input `k` places after this one in the state.
    pub(crate) fn after(self, k: usize) -> Option<Self> {
        match self {
            Input::Position(first) => Some(Input::Position(first + k)),
            Input::Momentum(first) => Some(Input::Momentum(first + k)),
            other => (k == 0).then_some(other),
        }
    }
}

/// Results in a row of registers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Write {
    pub(crate) from: Register,
    /// The first result.
    pub(crate) to: usize,
    pub(crate) count: usize,
}

/// The operations that compute a list of results.
#[derive(Debug, Clone, Default)]
pub struct Tape {
    pub(crate) inputs: Inputs,
    pub(crate) steps: Vec<Step>,
    /// The operands of all steps; those that an operation does not need are the first one.
    pub(crate) operands: Vec<[Register; 3]>,
    pub(crate) writes: Vec<Write>,
    /// Number of registers.
    pub(crate) registers: usize,
    /// Number of results.
    pub(crate) results: usize,
    /// Number of operations in rows.
    pub(crate) in_rows: usize,
}

/// The parameters that vary between trajectories. Where one is missing it is NaN, and a step fails.
#[derive(Debug, Clone)]
pub struct Parameters(Held);

#[derive(Debug, Clone)]
enum Held {
    /// Of one trajectory.
    Own(Arc<[f64]>),
    /// Of the trajectory in each lane.
    InLanes(Arc<[[f64; MAX_LANES]]>),
}

impl From<&[f64]> for Parameters {
    /// The parameters of one trajectory.
    fn from(own: &[f64]) -> Self {
        Parameters(Held::Own(own.into()))
    }
}

impl Parameters {
    /// No parameter varies.
    pub fn none() -> Self {
        Self::from(&[][..])
    }

    #[inline(always)]
    fn get<T: Scalar>(&self, k: usize) -> T {
        match &self.0 {
            Held::Own(numbers) => T::from_f64(numbers.get(k).copied().unwrap_or(f64::NAN)),
            Held::InLanes(numbers) => match numbers.get(k) {
                Some(numbers) => T::from_lanes(numbers),
                None => T::from_f64(f64::NAN),
            },
        }
    }

    /// The parameters of several trajectories, each in its lane.
    pub(crate) fn join<'a>(all: impl Iterator<Item = &'a Self>) -> Option<Self> {
        let mut joined: Vec<[f64; MAX_LANES]> = Vec::new();
        for (lane, parameters) in all.enumerate() {
            let Held::Own(own) = &parameters.0 else {
                return None;
            };
            joined.resize(own.len(), [f64::NAN; MAX_LANES]);
            for (numbers, own) in joined.iter_mut().zip(own.iter()) {
                *numbers.get_mut(lane)? = *own;
            }
        }
        Some(Parameters(Held::InLanes(joined.into())))
    }
}

/// The point of evaluation.
#[derive(Debug, Clone, Copy)]
pub struct At<'a, T> {
    /// The parameters of the trajectory, or of those in the lanes.
    pub parameters: &'a Parameters,
    /// The time.
    pub time: T,
    /// The positions.
    pub q: &'a [T],
    /// The momenta.
    pub p: &'a [T],
}

impl<T: Scalar> At<'_, T> {
    /// The time, or a parameter.
    #[inline(always)]
    pub(crate) fn other(&self, input: Input) -> T {
        match input {
            Input::Parameter(k) => self.parameters.get(k),
            _ => self.time,
        }
    }
}

impl Tape {
    /// The tape of one value of a system, a node outside of loops. With friction from a time `start`, the momenta are those
    /// that [`Formula`](crate::Formula) steps.
    ///
    /// # Errors
    ///
    /// The [`Refusal`] of a formula that is too long or goes beyond its arrays.
    pub fn of_value(
        system: &System,
        values: &Values,
        value: Id,
        start: Option<f64>,
    ) -> Result<Self, Refusal> {
        if system.graph.overflowed() {
            return Err(Refusal::TooLong);
        }
        let unrolled = Unrolled::new(system, values, &[value], start)?;
        unrolled.tape(&[unrolled.of(value)?])
    }

    /// What the tape reads.
    pub fn inputs(&self) -> impl Iterator<Item = Input> {
        self.inputs.all()
    }

    /// The result of a tape that has one.
    pub fn value<T: Scalar>(&self, point: At<'_, T>) -> T {
        let mut result = T::zero();
        self.run(point, |_, values| result = values[0]);
        result
    }
}
