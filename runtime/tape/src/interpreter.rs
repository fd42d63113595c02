//! The interpreter of a tape, over any scalar.
//!
//! It enters the widest registers of the processor where that pays: for rows of doubles, for several points at once, and for lanes.

use std::any::Any;
use std::cell::RefCell;
use std::iter::repeat;
use std::marker::PhantomData;

use symplectic::Scalar;
use symplectic::nalgebra::DVector;
use symplectic::simd::Lanes;
use symplectic_core::inside::{EightLanes, Work, in_eight_lanes};

use crate::assembly::CHUNK;
use crate::operation::{Operation, Use, dispatch};
use crate::tape::{At, Operand, Register, Step, Tape};

/// Eight numbers side by side.
type Eight = [f64; CHUNK];

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
    /// most operations are in rows.
    pub(crate) fn fill<'a, T: Scalar>(
        &self,
        at: impl Fn(usize) -> At<'a, T>,
        vectors: &mut [DVector<T>],
    ) {
        let rows_pay = 4 * self.in_rows >= 3 * self.operands.len();
        if !T::IS_DOUBLE || rows_pay || vectors.len() < 2 {
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

/// The size of a cache line: no chunk of a row in a block is in two.
const LINE: usize = 64;

/// Runs work with so many registers, which the thread keeps for the next time. Their values are any.
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
        let room = LINE / size_of::<R>().clamp(1, LINE);
        if registers.len() < count + room {
            registers.resize(count + room, zero);
        }
        let start = registers.as_ptr().align_offset(LINE).min(room);
        work(&mut registers[start..start + count]);
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

/// Operations on doubles.
struct Rows<'a> {
    tape: &'a Tape,
    registers: &'a mut [f64],
}

/// Applies the operations of a tape to doubles, rows in chunks.
#[inline(never)]
fn by_rows(tape: &Tape, registers: &mut [f64]) {
    in_eight_lanes(Rows { tape, registers });
}

impl EightLanes for Rows<'_> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<L: Lanes<Array = Eight>>(self) {
        let mut operands = &self.tape.operands[..];
        for step in &self.tape.steps {
            let (list, rest) = operands.split_at(step.count as usize);
            operands = rest;
            let row = Row::<L> {
                step,
                operands: list,
                registers: &mut *self.registers,
                lanes: PhantomData,
            };
            dispatch(step.code, row);
        }
    }
}

/// An operation on doubles, in chunks of lanes `L` if they are in rows.
struct Row<'a, L> {
    step: &'a Step,
    operands: &'a [[Register; 3]],
    registers: &'a mut [f64],
    lanes: PhantomData<L>,
}

impl<L: Lanes<Array = Eight>> Use for Row<'_, L> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with<O: Operation>(self) {
        let Self {
            step,
            operands,
            registers,
            ..
        } = self;
        let (Some(kinds), [first, ..]) = (step.row, operands) else {
            let list = OneByOne::<f64, [f64]> {
                into: step.into,
                operands,
                registers,
                numbers: PhantomData,
            };
            return list.with::<O>();
        };
        let (into, length) = (step.into as usize, operands.len().next_multiple_of(CHUNK));
        let (before, rest) = registers.split_at_mut(into);
        let (out, after) = rest.split_at_mut(length);
        let from = |slot: usize| {
            let register = first[slot] as usize;
            match register < into {
                true => &before[register..],
                false => &after[register - into - length..],
            }
        };
        let (a, b, c) = (from(0), from(1), from(2));
        let same = [[a[0]; CHUNK], [b[0]; CHUNK], [c[0]; CHUNK]];
        let [same_a, same_b, same_c] = [repeat(&same[0]), repeat(&same[1]), repeat(&same[2])];
        // An operand that is no row may be near the end.
        let [a, b, c] = [a, b, c].map(|row| row.get(..length).unwrap_or(&[]).as_chunks().0.iter());
        let out = out.as_chunks_mut().0;
        use Operand::Same;
        match kinds {
            _ if O::ARITY == 1 => in_chunks::<L, O>(out, (a, same_b, same_c)),
            [Same, ..] if O::ARITY == 2 => in_chunks::<L, O>(out, (same_a, b, same_c)),
            [_, Same, _] if O::ARITY == 2 => in_chunks::<L, O>(out, (a, same_b, same_c)),
            _ if O::ARITY == 2 => in_chunks::<L, O>(out, (a, b, same_c)),
            [Same, Same, _] => in_chunks::<L, O>(out, (same_a, same_b, c)),
            [Same, _, Same] => in_chunks::<L, O>(out, (same_a, b, same_c)),
            [_, Same, Same] => in_chunks::<L, O>(out, (a, same_b, same_c)),
            [Same, ..] => in_chunks::<L, O>(out, (same_a, b, c)),
            [_, Same, _] => in_chunks::<L, O>(out, (a, same_b, c)),
            [.., Same] => in_chunks::<L, O>(out, (a, b, same_c)),
            _ => in_chunks::<L, O>(out, (a, b, c)),
        }
    }
}

/// Applies an operation to rows, chunk by chunk. The iterators are over memory, not over lanes, which only inlined functions may return.
#[cfg_attr(not(debug_assertions), inline(always))]
fn in_chunks<'a, L: Lanes<Array = Eight>, O: Operation>(
    out: &mut [Eight],
    (a, b, c): (
        impl Iterator<Item = &'a Eight>,
        impl Iterator<Item = &'a Eight>,
        impl Iterator<Item = &'a Eight>,
    ),
) {
    for (((out, a), b), c) in out.iter_mut().zip(a).zip(b).zip(c) {
        let operands = [L::from_array(*a), L::from_array(*b), L::from_array(*c)];
        *out = O::of(operands).to_array();
    }
}

#[cfg(test)]
mod tests {
    use symplectic::simd::{F64x2, F64x4, F64x8, F64x16, MAX_LANES};
    use symplectic_core::inside::{Avx2, Avx512, Widest, in_eight_lanes_of};

    use super::*;
    use crate::assembly::{Assembly, join_products};
    use crate::operation::{Code, apply as apply_once};
    use crate::tape::Parameters;
    use crate::unroll::{Number, Value};

    /// Pseudo-random numbers.
    struct Random(u64);

    impl Random {
        fn below(&mut self, bound: usize) -> usize {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
            self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 33) as usize % bound
        }

        fn number(&mut self) -> f64 {
            self.below(2000) as f64 / 512.0 - 1.5
        }
    }

    const CODES: [Code; 24] = [
        Code::Add,
        Code::Subtract,
        Code::Multiply,
        Code::Divide,
        Code::MultiplyAdd,
        Code::MultiplySubtract,
        Code::SubtractProduct,
        Code::Negative,
        Code::Reciprocal,
        Code::Root,
        Code::Absolute,
        Code::OrZero,
        Code::Exp,
        Code::Ln,
        Code::Sin,
        Code::Cos,
        Code::Tan,
        Code::Asin,
        Code::Acos,
        Code::Atan,
        Code::Sinh,
        Code::Cosh,
        Code::Tanh,
        Code::Atan2,
    ];

    /// The dimension of q and of p.
    const DIMENSION: usize = 19;

    /// Values and results. Operations come in lists of up to `longest` of one kind, on operands that follow each other, are the same, or are
    /// anywhere. Results are any values, inputs too.
    fn formula(random: &mut Random, lists: usize, longest: usize) -> (Vec<Value>, Vec<Number>) {
        let mut list: Vec<Value> = (0..DIMENSION).map(Value::Position).collect();
        list.extend((0..DIMENSION).map(Value::Momentum));
        list.extend([Value::Time, Value::Parameter(0), Value::Parameter(1)]);
        list.extend([0.0_f64, 1.0, -2.5].map(|x| Value::Constant(x.to_bits())));
        for _ in 0..lists {
            let (code, count) = (CODES[random.below(24)], 1 + random.below(longest));
            let known = list.len();
            let firsts = [(); 3].map(|()| (random.below(known), random.below(3)));
            for k in 0..count {
                let operands = firsts.map(|(first, kind)| match kind {
                    0 => first,
                    1 => (first + k) % known,
                    _ => random.below(known),
                });
                list.push(Value::Step(code, operands.map(|operand| operand as Number)));
            }
        }
        let from = random.below(list.len());
        let last = from..list.len().min(from + 40);
        let any = (0..10).map(|_| random.below(list.len()));
        let results = any.collect::<Vec<_>>().into_iter().chain(last);
        let results = results.map(|result| result as Number).collect();
        (list, results)
    }

    fn assembled((list, results): &(Vec<Value>, Vec<Number>)) -> Tape {
        let mut list = list.clone();
        let uses = join_products(&mut list, results);
        let tape = Assembly::of(&list, uses, results).tape();
        tape.expect("few operations")
    }

    /// A point, with its time.
    #[derive(Clone, Copy)]
    struct Point {
        time: f64,
        q: [f64; DIMENSION],
        p: [f64; DIMENSION],
    }

    impl Point {
        fn any(random: &mut Random) -> Self {
            Point {
                time: random.number(),
                q: [(); DIMENSION].map(|()| random.number()),
                p: [(); DIMENSION].map(|()| random.number()),
            }
        }

        fn at<'a>(&'a self, parameters: &'a Parameters) -> At<'a, f64> {
            At {
                parameters,
                time: self.time,
                q: &self.q,
                p: &self.p,
            }
        }
    }

    const PARAMETERS: [f64; 2] = [0.75, -1.25];

    /// The results without a tape: value by value.
    fn expected((list, results): &(Vec<Value>, Vec<Number>), point: &Point) -> Vec<u64> {
        let mut known: Vec<f64> = Vec::new();
        for value in list {
            known.push(match *value {
                Value::Constant(bits) => f64::from_bits(bits),
                Value::Time => point.time,
                Value::Position(k) => point.q[k],
                Value::Momentum(k) => point.p[k],
                Value::Parameter(k) => PARAMETERS[k],
                Value::Step(code, operands) => {
                    apply_once(code, operands.map(|operand| known[operand as usize]))
                }
            });
        }
        results.iter().map(|k| bits(known[*k as usize])).collect()
    }

    /// NaN has many bit patterns.
    fn bits(value: f64) -> u64 {
        if value.is_nan() {
            u64::MAX
        } else {
            value.to_bits()
        }
    }

    /// Formulas of all sizes: in few and in many registers, with and without rows. Among them are results that are inputs only.
    fn each_formula(mut check: impl FnMut(&(Vec<Value>, Vec<Number>), &mut Random)) {
        let mut random = Random(7);
        for (lists, longest) in [
            (0, 1),
            (1, 3),
            (4, 3),
            (12, 1),
            (12, 3),
            (30, 2),
            (5, 20),
            (30, 30),
        ] {
            for _ in 0..12 {
                let formula = formula(&mut random, lists, longest);
                check(&formula, &mut random);
            }
        }
    }

    #[test]
    fn a_tape_has_the_bits_of_its_values() {
        let parameters = Parameters::from(&PARAMETERS[..]);
        let (mut wide, mut narrow) = (0, 0);
        each_formula(|formula, random| {
            let tape = assembled(formula);
            *(if tape.in_rows > 0 {
                &mut wide
            } else {
                &mut narrow
            }) += 1;
            let point = Point::any(random);
            let mut found = vec![0; formula.1.len()];
            tape.run(point.at(&parameters), |to, values: &[f64]| {
                for (place, value) in found[to..].iter_mut().zip(values) {
                    *place = bits(*value);
                }
            });
            assert_eq!(found, expected(formula, &point));
        });
        assert!(wide > 10 && narrow > 10, "{wide}, {narrow}");
    }

    #[test]
    fn several_points_have_the_bits_of_each_point() {
        let parameters = Parameters::from(&PARAMETERS[..]);
        each_formula(|formula, random| {
            let tape = assembled(formula);
            for count in (1..=9).chain([17]) {
                let points: Vec<Point> = (0..count).map(|_| Point::any(random)).collect();
                let mut found = vec![DVector::zeros(formula.1.len()); count];
                tape.fill(|k| points[k].at(&parameters), &mut found);
                for (found, point) in found.iter().zip(&points) {
                    let found: Vec<u64> = found.iter().map(|value| bits(*value)).collect();
                    assert_eq!(found, expected(formula, point), "{count}");
                }
            }
        });
    }

    fn compare_in_lanes<L: Lanes>() {
        // Each lane has its own parameters, which are the same here.
        let own = Parameters::from(&PARAMETERS[..]);
        let parameters = Parameters::join((0..MAX_LANES).map(|_| &own)).expect("as many lanes");
        each_formula(|formula, random| {
            let tape = assembled(formula);
            let points: Vec<Point> = (0..L::WIDTH).map(|_| Point::any(random)).collect();
            let half = |of: fn(&Point) -> &[f64; DIMENSION]| -> Vec<L> {
                let lanes = |k: usize| L::from_fn(|lane| of(&points[lane])[k]);
                (0..DIMENSION).map(lanes).collect()
            };
            let (q, p) = (half(|point| &point.q), half(|point| &point.p));
            let at = At {
                parameters: &parameters,
                time: L::from_fn(|lane| points[lane].time),
                q: &q,
                p: &p,
            };
            let mut found = vec![L::from_f64(f64::NAN); formula.1.len()];
            tape.run(at, |to, values: &[L]| copy_to(&mut found, to, values));
            for (lane, point) in points.iter().enumerate() {
                let found: Vec<u64> = found.iter().map(|value| bits(value.get(lane))).collect();
                assert_eq!(found, expected(formula, point), "{lane} of {}", L::WIDTH);
            }
        });
    }

    #[test]
    fn lanes_of_all_widths_have_the_bits_of_doubles() {
        compare_in_lanes::<F64x2>();
        compare_in_lanes::<F64x4>();
        compare_in_lanes::<F64x8>();
        compare_in_lanes::<F64x16>();
    }

    #[test]
    fn all_registers_of_the_processor_give_the_same_bits() {
        let mut all = vec![Widest::Build];
        all.extend(Avx2::detect().map(Widest::Avx2));
        all.extend(Avx512::detect().map(Widest::Avx512));
        let parameters = Parameters::from(&PARAMETERS[..]);
        each_formula(|formula, random| {
            let tape = assembled(formula);
            let point = Point::any(random);
            let expected = expected(formula, &point);
            for widest in &all {
                // By rows, and at eight points.
                let mut registers = vec![0.0; tape.registers];
                tape.load(point.at(&parameters), &mut registers);
                let mut eights = vec![[0.0; CHUNK]; tape.registers];
                tape.load_points(|_| point.at(&parameters), 3, &mut eights);
                let rows = Rows {
                    tape: &tape,
                    registers: &mut registers,
                };
                in_eight_lanes_of(*widest, rows);
                let points = AtEight {
                    tape: &tape,
                    registers: &mut eights[..],
                };
                in_eight_lanes_of(*widest, points);
                if tape.steps.is_empty() {
                    continue;
                }
                for row in &tape.writes {
                    for k in 0..row.count {
                        let place = row.from as usize + k;
                        let expected = expected[row.to + k];
                        assert_eq!(bits(registers[place]), expected, "{widest:?}");
                        assert!(eights[place].iter().all(|value| bits(*value) == expected));
                    }
                }
            }
        });
    }

    #[test]
    fn every_lane_has_its_own_parameters() {
        let own: Vec<_> = (0..8)
            .map(|lane| Parameters::from(&[lane as f64, 3.0][..]))
            .collect();
        let joined = Parameters::join(own.iter()).expect("eight lanes");
        let list = vec![
            Value::Parameter(0),
            Value::Parameter(1),
            Value::Step(Code::Multiply, [0, 1, 0]),
        ];
        let at = At {
            parameters: &joined,
            time: F64x8::from_f64(0.0),
            q: &[],
            p: &[],
        };
        let mut found = None;
        assembled(&(list, vec![2])).run(at, |_, values| found = Some(values[0].to_array()));
        assert_eq!(found, Some([0.0, 3.0, 6.0, 9.0, 12.0, 15.0, 18.0, 21.0]));
        assert!(Parameters::join([joined.clone()].iter()).is_none());
    }

    #[test]
    fn what_does_not_exist_is_nan() {
        let list: Vec<Value> = (0..6).map(Value::Position).collect();
        let tape = assembled(&(list, (0..6).collect()));
        let parameters = Parameters::none();
        let at = At {
            parameters: &parameters,
            time: 0.0,
            q: &[1.0, 2.0],
            p: &[],
        };
        let mut found = [0.0; 6];
        tape.run(at, |to, values| copy_to(&mut found, to, values));
        assert_eq!(found[..2], [1.0, 2.0]);
        assert!(found[2..].iter().all(|value: &f64| value.is_nan()));
    }
}
