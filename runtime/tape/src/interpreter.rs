//! The interpreter of a tape, over any scalar.
//!
//! It enters the widest registers of the processor where that pays: for rows of doubles, for several points at once, and for lanes.

use std::any::Any;
use std::cell::RefCell;
use std::marker::PhantomData;
use std::slice;

use symplectic::Scalar;
use symplectic::nalgebra::DVector;
use symplectic::simd::Lanes;
use symplectic_core::inside::{EightLanes, Work, in_eight_lanes};

use crate::assembly::{CHUNK, SHORTEST_ROW};
use crate::operation::{Operation, Use, dispatch};
use crate::tape::{At, Input, Load, Register, Step, Tape};

/// Eight numbers side by side.
type Eight = [f64; CHUNK];

impl Tape {
    /// Evaluates the tape at a point, and calls `write` with the number of a result and the values from there on.
    ///
    /// A few registers are an array on the stack. More are kept by the thread for the next evaluation.
    pub fn run<T: Scalar>(&self, at: At<'_, T>, mut write: impl FnMut(usize, &[T])) {
        if self.steps.is_empty() {
            return self.copy(at, write);
        }
        let mut finish = |registers: &[T]| {
            for row in &self.writes {
                write(row.to, &registers[row.from as usize..][..row.count]);
            }
        };
        match self.registers {
            _ if T::IS_DOUBLE && self.is_wide => {
                with_registers(self.registers, T::zero(), |registers| {
                    self.load(at, registers);
                    if let Some(doubles) = T::doubles_mut(registers) {
                        by_rows(&self.steps, doubles);
                    }
                    finish(registers);
                });
            }
            0..=16 => {
                let mut registers = [T::zero(); 16];
                self.load(at, &mut registers);
                apply(&self.steps, &mut registers);
                finish(&registers);
            }
            17..=64 => {
                let mut registers = [T::zero(); 64];
                self.load(at, &mut registers);
                apply(&self.steps, &mut registers);
                finish(&registers);
            }
            many => with_registers(many, T::zero(), |registers| {
                self.load(at, registers);
                apply(&self.steps, registers);
                finish(registers);
            }),
        }
    }

    /// Evaluates the tape at a point for each vector, and writes the results there. Doubles are evaluated at eight points at once.
    pub(crate) fn fill<'a, T: Scalar>(
        &self,
        at: impl Fn(usize) -> At<'a, T>,
        vectors: &mut [DVector<T>],
    ) {
        let in_eights = T::IS_DOUBLE && !self.is_wide && !self.steps.is_empty();
        if !in_eights || vectors.len() < 2 {
            for (point, vector) in vectors.iter_mut().enumerate() {
                self.run(at(point), |to, values| copy_to(vector.as_mut_slice(), to, values));
            }
            return;
        }
        for (number, vectors) in vectors.chunks_mut(CHUNK).enumerate() {
            let at = |lane: usize| at(CHUNK * number + lane);
            match self.registers {
                0..=32 => {
                    let mut registers = [[0.0; CHUNK]; 32];
                    self.load_points(at, vectors.len(), &mut registers);
                    apply_eights(&self.steps, &mut registers);
                    self.write_points(&registers, vectors);
                }
                many => with_registers(many, [0.0; CHUNK], |registers| {
                    self.load_points(at, vectors.len(), registers);
                    apply_eights(&self.steps, registers);
                    self.write_points(registers, vectors);
                }),
            }
        }
    }

    /// Copies results that are inputs, such as the velocity with unit masses.
    #[inline]
    fn copy<T: Scalar>(&self, at: At<'_, T>, mut write: impl FnMut(usize, &[T])) {
        for load in &self.loads {
            match at.row(load) {
                Some(row) => write(load.into as usize, row),
                None => at.each(load, |k, value| write(load.into as usize + k, &[value])),
            }
        }
    }

    #[inline]
    fn load<T: Scalar>(&self, at: At<'_, T>, registers: &mut [T]) {
        for load in &self.loads {
            let into = load.into as usize;
            match at.row(load) {
                Some(row) => registers[into..into + load.count].copy_from_slice(row),
                None => at.each(load, |k, value| registers[into + k] = value),
            }
        }
    }

    /// Loads at most eight points. Lanes without a point repeat the last one.
    fn load_points<'a, T: Scalar>(
        &self,
        at: impl Fn(usize) -> At<'a, T>,
        points: usize,
        registers: &mut [Eight],
    ) {
        for lane in 0..CHUNK {
            let at = at(lane.min(points - 1));
            for load in &self.loads {
                let into = &mut registers[load.into as usize..][..load.count];
                at.each(load, |k, value| into[k][lane] = double(value));
            }
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
                places.zip(values).for_each(|(place, value)| *place = value[lane]);
            }
        }
    }
}

/// Copies results from the number `to` on, as many as there are places.
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

/// A number that is a double.
#[inline(always)]
fn double<T: Scalar>(number: T) -> f64 {
    T::doubles(slice::from_ref(&number)).map_or(f64::NAN, |number| number[0])
}

impl<'a, T: Scalar> At<'a, T> {
    /// The components of the state that a row of several inputs reads, if all exist.
    #[inline(always)]
    fn row(&self, load: &Load) -> Option<&'a [T]> {
        let (half, first) = match load.input {
            _ if load.count == 1 => return None,
            Input::Position(first) => (self.q, first),
            Input::Momentum(first) => (self.p, first),
            _ => return None,
        };
        half.get(first..first + load.count)
    }

    /// Calls `work` with the number and the value of each input of a row.
    #[inline(always)]
    fn each(&self, load: &Load, mut work: impl FnMut(usize, T)) {
        if load.count == 1 {
            return work(0, self.value(load.input));
        }
        match self.row(load) {
            Some(row) => row.iter().enumerate().for_each(|(k, value)| work(k, *value)),
            None => {
                let inputs = (0..load.count).filter_map(|k| Some((k, load.input.after(k)?)));
                inputs.for_each(|(k, input)| work(k, self.value(input)));
            }
        }
    }
}

/// Runs work with at least so many registers, which the thread keeps for the next time. Their values are any.
fn with_registers<R: Copy + 'static>(count: usize, zero: R, work: impl FnOnce(&mut [R])) {
    thread_local! {
        static KEPT: RefCell<Vec<Box<dyn Any>>> = const { RefCell::new(Vec::new()) };
    }
    KEPT.with(|kept| {
        let find = |kept: &mut Vec<Box<dyn Any>>| {
            let place = kept.iter().position(|kept| kept.is::<Vec<R>>())?;
            kept.swap_remove(place).downcast::<Vec<R>>().ok()
        };
        let mut registers = find(&mut kept.borrow_mut()).unwrap_or_default();
        if registers.len() < count {
            registers.resize(count, zero);
        }
        work(&mut registers[..count]);
        kept.borrow_mut().push(registers);
    });
}

/// Registers that hold numbers `T`.
trait Registers<T> {
    fn read(&self, register: Register) -> T;
    fn write(&mut self, register: Register, value: T);
}

/// N is a power of two: the mask makes every index valid, so that no bound is checked.
impl<T: Scalar, const N: usize> Registers<T> for [T; N] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn read(&self, register: Register) -> T {
        self[register as usize & (N - 1)]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn write(&mut self, register: Register, value: T) {
        self[register as usize & (N - 1)] = value;
    }
}

impl<T: Scalar> Registers<T> for [T] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn read(&self, register: Register) -> T {
        self[register as usize]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn write(&mut self, register: Register, value: T) {
        self[register as usize] = value;
    }
}

/// Registers of eight doubles, as lanes.
struct Eights<R>(R);

impl<L: Lanes<Array = Eight>, const N: usize> Registers<L> for Eights<&mut [Eight; N]> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn read(&self, register: Register) -> L {
        L::from_array(self.0[register as usize & (N - 1)])
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn write(&mut self, register: Register, value: L) {
        self.0[register as usize & (N - 1)] = value.to_array();
    }
}

impl<L: Lanes<Array = Eight>> Registers<L> for Eights<&mut [Eight]> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn read(&self, register: Register) -> L {
        L::from_array(self.0[register as usize])
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn write(&mut self, register: Register, value: L) {
        self.0[register as usize] = value.to_array();
    }
}

/// The operations of a tape, in the registers of the numbers `T`.
struct Steps<'a, T, R: ?Sized> {
    steps: &'a [Step],
    registers: &'a mut R,
    numbers: PhantomData<T>,
}

/// Applies the operations of a tape. Not inlined, because there are many callers: so it enters the registers of the numbers.
#[inline(never)]
fn apply<T: Scalar, R: Registers<T> + ?Sized>(steps: &[Step], registers: &mut R) {
    T::in_registers(Steps {
        steps,
        registers,
        numbers: PhantomData,
    });
}

impl<T: Scalar, R: Registers<T> + ?Sized> Work for Steps<'_, T, R> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        for step in self.steps {
            let row = OneByOne::<T, R> {
                step,
                registers: &mut *self.registers,
                numbers: PhantomData,
            };
            dispatch(step.code, row);
        }
    }
}

/// A row, one register after another.
struct OneByOne<'a, T, R: ?Sized> {
    step: &'a Step,
    registers: &'a mut R,
    numbers: PhantomData<T>,
}

impl<T: Scalar, R: Registers<T> + ?Sized> Use for OneByOne<'_, T, R> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with<O: Operation>(self) {
        let Step {
            strides,
            mut into,
            operands: [mut a, mut b, mut c],
            count,
            ..
        } = *self.step;
        let mut left = count;
        loop {
            let operands = [
                self.registers.read(a),
                self.registers.read(b),
                self.registers.read(c),
            ];
            self.registers.write(into, O::of(operands));
            left -= 1;
            if left == 0 {
                return;
            }
            into += 1;
            a += Register::from(strides[0]);
            b += Register::from(strides[1]);
            c += Register::from(strides[2]);
        }
    }
}

/// The operations of a tape at eight points.
struct AtEight<'a, R: ?Sized> {
    steps: &'a [Step],
    registers: &'a mut R,
}

#[inline(never)]
fn apply_eights<R: ?Sized>(steps: &[Step], registers: &mut R)
where
    for<'a> AtEight<'a, R>: EightLanes<Output = ()>,
{
    in_eight_lanes(AtEight { steps, registers });
}

impl<const N: usize> EightLanes for AtEight<'_, [Eight; N]> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<L: Lanes<Array = Eight>>(self) {
        let steps = Steps::<L, _> {
            steps: self.steps,
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
            steps: self.steps,
            registers: &mut Eights(self.registers),
            numbers: PhantomData,
        };
        steps.run();
    }
}

/// Operations on rows of doubles.
struct Rows<'a> {
    steps: &'a [Step],
    registers: &'a mut [f64],
}

/// Applies the operations of a tape to doubles, long rows in chunks.
#[inline(never)]
fn by_rows(steps: &[Step], registers: &mut [f64]) {
    in_eight_lanes(Rows { steps, registers });
}

impl EightLanes for Rows<'_> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<L: Lanes<Array = Eight>>(self) {
        for step in self.steps {
            let row = Row::<L> {
                step,
                registers: &mut *self.registers,
                lanes: PhantomData,
            };
            dispatch(step.code, row);
        }
    }
}

/// A row of doubles, in chunks of lanes `L` if it is long.
struct Row<'a, L> {
    step: &'a Step,
    registers: &'a mut [f64],
    lanes: PhantomData<L>,
}

impl<L: Lanes<Array = Eight>> Use for Row<'_, L> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with<O: Operation>(self) {
        let Self {
            step, registers, ..
        } = self;
        if step.count < SHORTEST_ROW {
            let row = OneByOne::<f64, [f64]> {
                step,
                registers,
                numbers: PhantomData,
            };
            return row.with::<O>();
        }
        let chunks = step.count.div_ceil(CHUNK);
        let (into, length) = (step.into as usize, chunks * CHUNK);
        let (before, rest) = registers.split_at_mut(into);
        let (out, after) = rest.split_at_mut(length);
        let from = |slot: usize| {
            let register = step.operands[slot] as usize;
            match register < into {
                true => &before[register..],
                false => &after[register - into - length..],
            }
        };
        let (a, b, c) = (from(0), from(1), from(2));
        let splats = [[a[0]; CHUNK], [b[0]; CHUNK], [c[0]; CHUNK]];
        let [a, b, c] = [(a, 0), (b, 1), (c, 2)].map(|(row, slot)| match step.strides[slot] {
            0 => (slice::from_ref(&splats[slot]), 0),
            _ => (row[..length].as_chunks().0, 1),
        });
        for (k, out) in out.as_chunks_mut().0.iter_mut().enumerate() {
            let operands = [
                L::from_array(a.0[k * a.1]),
                L::from_array(b.0[k * b.1]),
                L::from_array(c.0[k * c.1]),
            ];
            *out = O::of(operands).to_array();
        }
    }
}
