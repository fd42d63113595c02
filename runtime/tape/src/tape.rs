//! A formula as a list of operations on registers, and its interpreter over any scalar.
//!
//! A tape runs on SIMD lanes: each operation is applied to all trajectories in the lanes before the next one is read.
//! It has the operations that the macro emits for the same formula.

use std::sync::Arc;

use symplectic::Scalar;
use symplectic::simd::MAX_LANES;
use symplectic_formula::System;
use symplectic_formula::graph::Id;

use crate::unroll::{Refusal, Unrolled};
use crate::values::Values;

/// The operation of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Code {
    /// `a + b`
    Add,
    /// `a − b`
    Subtract,
    /// `a b`
    Multiply,
    /// `a/b`
    Divide,
    /// `a b + c`, rounded twice.
    MultiplyAdd,
    /// `a b − c`, rounded twice.
    MultiplySubtract,
    /// `c − a b`, rounded twice.
    SubtractProduct,
    /// `−a`
    Negative,
    /// `1/a`
    Reciprocal,
    /// `√a`
    Root,
    /// `|a|`
    Absolute,
    /// `a`, or 0 if b is 0
    OrZero,
    /// eᵃ
    Exp,
    /// The natural logarithm.
    Ln,
    /// The sine.
    Sin,
    /// The cosine.
    Cos,
    /// The tangent.
    Tan,
    /// The inverse sine.
    Asin,
    /// The inverse cosine.
    Acos,
    /// The inverse tangent.
    Atan,
    /// The hyperbolic sine.
    Sinh,
    /// The hyperbolic cosine.
    Cosh,
    /// The hyperbolic tangent.
    Tanh,
    /// The angle of the point `(b, a)`.
    Atan2,
}

/// The number of a register.
pub(crate) type Register = u16;

/// An operation that reads at most three registers and writes one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    pub(crate) code: Code,
    pub(crate) into: Register,
    pub(crate) operands: [Register; 3],
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

/// The operations that compute a list of results.
#[derive(Debug, Clone, Default)]
pub struct Tape {
    /// The initial values of the first registers.
    pub(crate) inputs: Vec<Input>,
    pub(crate) steps: Vec<Step>,
    /// The register of each result at the end.
    pub(crate) results: Vec<Register>,
    /// Number of registers.
    pub(crate) registers: usize,
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
    /// The value of an input.
    #[inline(always)]
    fn value(&self, input: Input) -> T {
        let entry = |half: &[T], k: usize| match half.get(k) {
            Some(&value) => value,
            None => T::from_f64(f64::NAN),
        };
        match input {
            Input::Constant(value) => T::from_f64(value),
            Input::Time => self.time,
            Input::Position(k) => entry(self.q, k),
            Input::Momentum(k) => entry(self.p, k),
            Input::Parameter(k) => self.parameters.get(k),
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
    pub fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    /// The result of a tape that has one.
    pub fn value<T: Scalar>(&self, point: At<'_, T>) -> T {
        let mut result = T::zero();
        self.run(1, |_| point, |_, _, value| result = value);
        result
    }

    /// Evaluates the tape at `count` points and calls `write` with the number of the point, and the number and the value of
    /// each result.
    ///
    /// An operation is applied at up to four points before the next one is read. Up to 256 registers are an array on the
    /// stack, of the next larger of five sizes; more are allocated in every evaluation.
    #[inline]
    pub fn run<'a, T: Scalar>(
        &self,
        count: usize,
        at: impl Fn(usize) -> At<'a, T>,
        mut write: impl FnMut(usize, usize, T),
    ) {
        if self.steps.is_empty() {
            (0..count).for_each(|point| self.copy(at(point), |k, value| write(point, k, value)));
            return;
        }
        let mut first = 0;
        while first < count {
            let at = |point: usize| at(first + point);
            let write = |point: usize, k: usize, value: T| write(first + point, k, value);
            // Registers of four points in lanes take eight kilobytes.
            first += match (count - first, self.registers) {
                (2..4, 0..=8) => self.on_stack::<T, 8, 2>(at, write),
                (2..4, 9..=16) => self.on_stack::<T, 16, 2>(at, write),
                (2..4, 17..=32) => self.on_stack::<T, 32, 2>(at, write),
                (4.., 0..=8) => self.on_stack::<T, 8, 4>(at, write),
                (4.., 9..=16) => self.on_stack::<T, 16, 4>(at, write),
                (4.., 17..=32) => self.on_stack::<T, 32, 4>(at, write),
                (_, 0..=8) => self.on_stack::<T, 8, 1>(at, write),
                (_, 9..=16) => self.on_stack::<T, 16, 1>(at, write),
                (_, 17..=32) => self.on_stack::<T, 32, 1>(at, write),
                (_, 33..=64) => self.on_stack::<T, 64, 1>(at, write),
                (_, 65..=256) => self.on_stack::<T, 256, 1>(at, write),
                (_, many) => {
                    let mut registers = vec![[T::zero()]; many];
                    self.execute(&mut registers, usize::from, at, write)
                }
            };
        }
    }

    /// Copies results that are inputs, such as the velocity with unit masses.
    #[inline]
    fn copy<T: Scalar>(&self, at: At<'_, T>, mut write: impl FnMut(usize, T)) {
        for (number, &register) in self.results.iter().enumerate() {
            if let Some(&input) = self.inputs.get(usize::from(register)) {
                write(number, at.value(input));
            }
        }
    }

    #[inline(never)]
    fn on_stack<'a, T: Scalar, const N: usize, const POINTS: usize>(
        &self,
        at: impl Fn(usize) -> At<'a, T>,
        write: impl FnMut(usize, usize, T),
    ) -> usize {
        let mut registers = [[T::zero(); POINTS]; N];
        // N is a power of two: the mask makes every index valid, so that no bound is checked.
        let place = |register: Register| usize::from(register) & (N - 1);
        self.execute(&mut registers, place, at, write)
    }

    /// Returns the number of points.
    #[inline(always)]
    fn execute<'a, T: Scalar, const POINTS: usize>(
        &self,
        registers: &mut [[T; POINTS]],
        place: impl Fn(Register) -> usize,
        at: impl Fn(usize) -> At<'a, T>,
        mut write: impl FnMut(usize, usize, T),
    ) -> usize {
        for point in 0..POINTS {
            let at = at(point);
            for (register, &input) in registers.iter_mut().zip(&self.inputs) {
                register[point] = at.value(input);
            }
        }
        for step in &self.steps {
            let [a, b, c] = step.operands.map(&place);
            let into = place(step.into);
            dispatch(
                step.code,
                AtPoints {
                    registers,
                    operands: [a, b, c],
                    into,
                },
            );
        }
        for (number, &register) in self.results.iter().enumerate() {
            for (point, &value) in registers[place(register)].iter().enumerate() {
                write(point, number, value);
            }
        }
        POINTS
    }
}

/// Use of an operation.
trait Use<T> {
    type Output;

    /// Applies the operation, which ignores the operands it does not need.
    fn with(self, operation: impl Fn(T, T, T) -> T) -> Self::Output;
}

/// Application to registers, at all points.
struct AtPoints<'a, T, const POINTS: usize> {
    registers: &'a mut [[T; POINTS]],
    operands: [usize; 3],
    into: usize,
}

impl<T: Scalar, const POINTS: usize> Use<T> for AtPoints<'_, T, POINTS> {
    type Output = ();

    #[inline(always)]
    fn with(self, operation: impl Fn(T, T, T) -> T) {
        let (registers, [a, b, c]) = (self.registers, self.operands);
        let value = |registers: &[[T; POINTS]], point: usize| {
            let [a, b, c] = [a, b, c].map(|place| registers[place][point]);
            operation(a, b, c)
        };
        for point in 0..POINTS {
            registers[self.into][point] = value(registers, point);
        }
    }
}

/// Application to three numbers.
struct AtOnce<T>([T; 3]);

impl<T> Use<T> for AtOnce<T> {
    type Output = T;

    #[inline(always)]
    fn with(self, operation: impl Fn(T, T, T) -> T) -> T {
        let [a, b, c] = self.0;
        operation(a, b, c)
    }
}

/// Applies an operation to numbers.
pub(crate) fn apply<T: Scalar>(code: Code, operands: [T; 3]) -> T {
    dispatch(code, AtOnce(operands))
}

#[inline(always)]
fn dispatch<T: Scalar, U: Use<T>>(code: Code, to: U) -> U::Output {
    match code {
        Code::Add => to.with(|a, b, _| a + b),
        Code::Subtract => to.with(|a, b, _| a - b),
        Code::Multiply => to.with(|a, b, _| a * b),
        Code::Divide => to.with(|a, b, _| a / b),
        Code::MultiplyAdd => to.with(|a, b, c| a * b + c),
        Code::MultiplySubtract => to.with(|a, b, c| a * b - c),
        Code::SubtractProduct => to.with(|a, b, c| c - a * b),
        Code::Negative => to.with(|a, _, _| -a),
        Code::Reciprocal => to.with(|a, _, _| a.recip()),
        Code::Root => to.with(|a, _, _| a.sqrt()),
        Code::Absolute => to.with(|a, _, _| a.abs()),
        Code::OrZero => to.with(|a, b, _| a.or_zero(b)),
        Code::Exp => to.with(|a, _, _| a.exp()),
        Code::Ln => to.with(|a, _, _| a.ln()),
        Code::Sin => to.with(|a, _, _| a.sin()),
        Code::Cos => to.with(|a, _, _| a.cos()),
        Code::Tan => to.with(|a, _, _| a.tan()),
        Code::Asin => to.with(|a, _, _| a.asin()),
        Code::Acos => to.with(|a, _, _| a.acos()),
        Code::Atan => to.with(|a, _, _| a.atan()),
        Code::Sinh => to.with(|a, _, _| a.sinh()),
        Code::Cosh => to.with(|a, _, _| a.cosh()),
        Code::Tanh => to.with(|a, _, _| a.tanh()),
        Code::Atan2 => to.with(|a, b, _| a.atan2(b)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use symplectic::simd::{F64x8, Lanes};

    /// A tape for (x + c) p² with this number of registers.
    fn tape(registers: Register) -> Tape {
        let step = |code, into, operands| Step {
            code,
            into,
            operands,
        };
        let (last, spare) = (registers - 1, registers - 2);
        Tape {
            inputs: vec![Input::Position(0), Input::Momentum(0), Input::Parameter(0)],
            steps: vec![
                step(Code::Add, last, [0, 2, 0]),
                step(Code::Multiply, spare, [1, 1, 1]),
                step(Code::Multiply, last, [last, spare, last]),
            ],
            results: vec![last, 1],
            registers: usize::from(registers),
        }
    }

    #[test]
    fn several_points_have_the_values_of_each_point() {
        let parameters = Parameters::from(&[0.1][..]);
        for registers in [5, 8, 9, 16, 17, 32, 33, 64, 65, 256, 257, 1000] {
            let tape = tape(registers);
            for count in 0..10 {
                let q: Vec<f64> = (0..count).map(|k| 0.3 + k as f64).collect();
                let p: Vec<f64> = (0..count).map(|k| 0.7 - k as f64).collect();
                let at = |k: usize| At {
                    parameters: &parameters,
                    time: 0.0,
                    q: &q[k..=k],
                    p: &p[k..=k],
                };
                let mut found = vec![[f64::NAN; 2]; count];
                tape.run(count, at, |point, k, value| found[point][k] = value);
                let expected = q.iter().zip(&p).map(|(q, p)| [(q + 0.1) * (p * p), *p]);
                assert!(found.into_iter().eq(expected), "{registers}, {count}");
            }
        }
    }

    #[test]
    fn every_lane_has_its_own_parameters() {
        let own: Vec<_> = (0..8)
            .map(|lane| Parameters::from(&[lane as f64][..]))
            .collect();
        let joined = Parameters::join(own.iter()).expect("eight lanes");
        let (q, p) = ([F64x8::from_f64(0.5)], [F64x8::from_f64(2.0)]);
        let at = |_| At {
            parameters: &joined,
            time: F64x8::from_f64(0.0),
            q: &q,
            p: &p,
        };
        let mut found = None;
        tape(8).run(1, at, |_, k, value| {
            if k == 0 {
                found = Some(value.to_array());
            }
        });
        assert_eq!(found, Some([2.0, 6.0, 10.0, 14.0, 18.0, 22.0, 26.0, 30.0]));
        assert!(Parameters::join([joined.clone()].iter()).is_none());
    }
}
