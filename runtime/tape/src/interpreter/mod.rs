//! The interpreter of a tape, over any scalar.
//!
//! It enters the widest registers of the processor where that pays: for rows of doubles, for several points at once, and for lanes.

mod registers;
mod rows;
#[cfg(test)]
mod tests;

use std::marker::PhantomData;

use symplectic::Scalar;
use symplectic::nalgebra::DVector;
use symplectic::simd::Lanes;
use symplectic_core::inside::{EightLanes, Work, in_eight_lanes};

use self::registers::{Eights, Registers, with_registers};
use self::rows::by_rows;
use crate::assembly::CHUNK;
use crate::operation::{Operation, Use, dispatch};
use crate::tape::{At, Register, Tape};

/// Eight numbers side by side.
type Eight = [f64; CHUNK];

/// The smallest number of points that are faster at once than one after another.
const FEWEST_POINTS: usize = 4;

impl Tape {
    /// Evaluates the tape at a point, and calls `write` with the number of a result and the values from there on.
    ///
    /// A few registers are an array on the stack. More are kept by the thread for the next evaluation.
    pub fn run<T: Scalar>(&self, at: At<'_, T>, mut write: impl FnMut(usize, &[T])) {
        if self.steps.is_empty() {
            // Results that are inputs, such as the velocity with unit masses.
            return self.inputs.each(at, write);
        }
        let mut finish = |registers: &[T]| {
            for row in &self.writes {
                write(row.to, &registers[row.from as usize..][..row.count]);
            }
        };
        match self.registers {
            _ if T::IS_DOUBLE && self.in_rows > 0 => {
                with_registers(self.registers, T::zero(), |registers| {
                    self.load(at, registers);
                    if let Some(doubles) = T::doubles_mut(registers) {
                        by_rows(self, doubles);
                    }
                    finish(registers);
                });
            }
            0..=16 => {
                let mut registers = [T::zero(); 16];
                self.load(at, &mut registers);
                apply(self, &mut registers);
                finish(&registers);
            }
            17..=64 => {
                let mut registers = [T::zero(); 64];
                self.load(at, &mut registers);
                apply(self, &mut registers);
                finish(&registers);
            }
            many => with_registers(many, T::zero(), |registers| {
                self.load(at, registers);
                apply(self, registers);
                finish(registers);
            }),
        }
    }

    /// Evaluates the tape at a point for each vector, and writes the results there. Doubles are evaluated at eight points at once, unless
    /// there are few points or most operations are in rows.
    pub(crate) fn fill<'a, T: Scalar>(
        &self,
        at: impl Fn(usize) -> At<'a, T>,
        vectors: &mut [DVector<T>],
    ) {
        let rows_pay = 4 * self.in_rows >= 3 * self.operands.len();
        if !T::IS_DOUBLE || rows_pay || vectors.len() < FEWEST_POINTS {
            for (point, vector) in vectors.iter_mut().enumerate() {
                self.run(at(point), |to, values| {
                    copy_to(vector.as_mut_slice(), to, values)
                });
            }
            return;
        }
        for (number, vectors) in vectors.chunks_mut(CHUNK).enumerate() {
            let at = |lane: usize| at(CHUNK * number + lane);
            match self.registers {
                0..=32 => {
                    let mut registers = [[0.0; CHUNK]; 32];
                    self.load_points(at, vectors.len(), &mut registers);
                    apply_eights(self, &mut registers);
                    self.write_points(&registers, vectors);
                }
                many => with_registers(many, [0.0; CHUNK], |registers| {
                    self.load_points(at, vectors.len(), registers);
                    apply_eights(self, registers);
                    self.write_points(registers, vectors);
                }),
            }
        }
    }

    #[inline]
    fn load<T: Scalar>(&self, at: At<'_, T>, registers: &mut [T]) {
        self.inputs
            .each(at, |into, values| copy_to(registers, into, values));
    }

    /// Loads at most eight points. Lanes without a point repeat the last one.
    fn load_points<'a, T: Scalar>(
        &self,
        at: impl Fn(usize) -> At<'a, T>,
        points: usize,
        registers: &mut [Eight],
    ) {
        (self.inputs).each_constant(|into, value| registers[into] = [value; CHUNK]);
        for lane in 0..CHUNK {
            let write = |into: usize, values: &[T]| {
                let values = T::doubles(values).unwrap_or(&[]).iter();
                let places = registers[into..].iter_mut();
                places
                    .zip(values)
                    .for_each(|(place, value)| place[lane] = *value);
            };
            self.inputs.each_of_point(at(lane.min(points - 1)), write);
        }
    }

    fn write_points<T: Scalar>(&self, registers: &[Eight], vectors: &mut [DVector<T>]) {
        for (lane, vector) in vectors.iter_mut().enumerate() {
            let Some(out) = T::doubles_mut(vector.as_mut_slice()) else {
                return;
            };
            for row in &self.writes {
                let values = &registers[row.from as usize..][..row.count];
                let places = out.iter_mut().skip(row.to);
                places
                    .zip(values)
                    .for_each(|(place, value)| *place = value[lane]);
            }
        }
    }
}

/// Copies results into the places from the number `to` on; those without a place are left out.
#[inline]
pub(crate) fn copy_to<T: Scalar>(out: &mut [T], to: usize, values: &[T]) {
    if let [value] = values {
        // Without a call.
        if let Some(place) = out.get_mut(to) {
            *place = *value;
        }
    } else if let Some(out) = out.get_mut(to..) {
        let count = out.len().min(values.len());
        out[..count].copy_from_slice(&values[..count]);
    }
}

/// The operations of a tape, in the registers of the numbers `T`.
struct Steps<'a, T, R: ?Sized> {
    tape: &'a Tape,
    registers: &'a mut R,
    numbers: PhantomData<T>,
}

/// Applies the operations of a tape. Not inlined, because there are many callers: so it enters the registers of the numbers.
#[inline(never)]
fn apply<T: Scalar, R: Registers<T> + ?Sized>(tape: &Tape, registers: &mut R) {
    T::in_registers(Steps {
        tape,
        registers,
        numbers: PhantomData,
    });
}

impl<T: Scalar, R: Registers<T> + ?Sized> Work for Steps<'_, T, R> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        let mut operands = &self.tape.operands[..];
        for step in &self.tape.steps {
            let (list, rest) = operands.split_at(step.count as usize);
            operands = rest;
            let list = OneByOne::<T, R> {
                into: step.into,
                operands: list,
                registers: &mut *self.registers,
                numbers: PhantomData,
            };
            dispatch(step.code, list);
        }
    }
}

/// An operation on one register after another.
struct OneByOne<'a, T, R: ?Sized> {
    into: Register,
    operands: &'a [[Register; 3]],
    registers: &'a mut R,
    numbers: PhantomData<T>,
}

impl<T: Scalar, R: Registers<T> + ?Sized> Use for OneByOne<'_, T, R> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with<O: Operation>(self) {
        for (into, &[a, b, c]) in (self.into..).zip(self.operands) {
            // Constant conditions: only what is needed is read.
            let first = self.registers.read(a);
            let second = match O::ARITY > 1 {
                true => self.registers.read(b),
                false => first,
            };
            let third = match O::ARITY > 2 {
                true => self.registers.read(c),
                false => first,
            };
            self.registers.write(into, O::of([first, second, third]));
        }
    }
}

/// The operations of a tape at eight points.
struct AtEight<'a, R: ?Sized> {
    tape: &'a Tape,
    registers: &'a mut R,
}

#[inline(never)]
fn apply_eights<R: ?Sized>(tape: &Tape, registers: &mut R)
where
    for<'a> AtEight<'a, R>: EightLanes<Output = ()>,
{
    in_eight_lanes(AtEight { tape, registers });
}

impl<const N: usize> EightLanes for AtEight<'_, [Eight; N]> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<L: Lanes<Array = Eight>>(self) {
        let steps = Steps::<L, _> {
            tape: self.tape,
            registers: &mut Eights(self.registers),
            numbers: PhantomData,
        };
        steps.run();
    }
}

impl EightLanes for AtEight<'_, [Eight]> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<L: Lanes<Array = Eight>>(self) {
        let steps = Steps::<L, _> {
            tape: self.tape,
            registers: &mut Eights(self.registers),
            numbers: PhantomData,
        };
        steps.run();
    }
}
