//! A formula as a list of operations on registers, and its interpreter over any scalar.
//!
//! A tape runs on SIMD lanes: each operation is applied to all trajectories in the lanes before the next one is read.
//! It has the operations that the macro emits for the same formula.

use symplectic::Scalar;

/// The operation of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Code {
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
pub(super) type Register = u16;

/// An operation that reads at most three registers and writes one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    pub(super) code: Code,
    pub(super) into: Register,
    pub(super) operands: [Register; 3],
}

/// The initial value of a register.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Input {
    Constant(f64),
    Time,
    Position(usize),
    Momentum(usize),
}

/// The operations that compute a list of results.
#[derive(Debug, Clone, Default)]
pub(super) struct Tape {
    /// The initial values of the first registers.
    pub(super) inputs: Vec<Input>,
    pub(super) steps: Vec<Step>,
    /// The register of each result at the end.
    pub(super) results: Vec<Register>,
    /// Number of registers.
    pub(super) registers: usize,
}

/// The point of evaluation.
#[derive(Debug, Clone, Copy)]
pub(super) struct At<'a, T> {
    pub(super) time: T,
    pub(super) q: &'a [T],
    pub(super) p: &'a [T],
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
        }
    }
}

impl Tape {
    /// Evaluates the tape at `count` points and calls `write` with the number of the point, and the number and the value of
    /// each result.
    ///
    /// An operation is applied at up to four points before the next one is read. Up to 256 registers are an array on the
    /// stack, of the next larger of five sizes; more are allocated in every evaluation.
    #[inline]
    pub(super) fn run<'a, T: Scalar>(
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
        for point in 0..POINTS {
            let [a, b, c] = [a, b, c].map(|place| registers[place][point]);
            registers[self.into][point] = operation(a, b, c);
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
pub(super) fn apply<T: Scalar>(code: Code, operands: [T; 3]) -> T {
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
