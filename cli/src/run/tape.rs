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
    /// Evaluates the tape and calls `write` with the number and the value of each result.
    ///
    /// Up to 256 registers are an array on the stack, of the next larger of five sizes; more are allocated in every
    /// evaluation.
    #[inline]
    pub(super) fn run<T: Scalar>(&self, at: At<'_, T>, write: impl FnMut(usize, T)) {
        if self.steps.is_empty() {
            return self.copy(at, write);
        }
        match self.registers {
            0..=8 => self.on_stack::<T, 8>(at, write),
            9..=16 => self.on_stack::<T, 16>(at, write),
            17..=32 => self.on_stack::<T, 32>(at, write),
            33..=64 => self.on_stack::<T, 64>(at, write),
            65..=256 => self.on_stack::<T, 256>(at, write),
            count => {
                let mut registers = vec![T::zero(); count];
                self.execute(&mut registers, usize::from, at, write);
            }
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
    fn on_stack<T: Scalar, const N: usize>(&self, at: At<'_, T>, write: impl FnMut(usize, T)) {
        let mut registers = [T::zero(); N];
        // N is a power of two: the mask makes every index valid, so that no bound is checked.
        let place = |register: Register| usize::from(register) & (N - 1);
        self.execute(&mut registers, place, at, write);
    }

    #[inline(always)]
    fn execute<T: Scalar>(
        &self,
        registers: &mut [T],
        place: impl Fn(Register) -> usize,
        at: At<'_, T>,
        mut write: impl FnMut(usize, T),
    ) {
        for (register, &input) in registers.iter_mut().zip(&self.inputs) {
            *register = at.value(input);
        }
        for step in &self.steps {
            let [a, b, c] = step.operands.map(&place);
            let value = apply(step.code, registers[a], || registers[b], || registers[c]);
            registers[place(step.into)] = value;
        }
        for (number, &register) in self.results.iter().enumerate() {
            write(number, registers[place(register)]);
        }
    }
}

/// Applies an operation; it reads only the operands it needs.
#[inline(always)]
pub(super) fn apply<T: Scalar>(
    code: Code,
    a: T,
    b: impl FnOnce() -> T,
    c: impl FnOnce() -> T,
) -> T {
    match code {
        Code::Add => a + b(),
        Code::Subtract => a - b(),
        Code::Multiply => a * b(),
        Code::Divide => a / b(),
        Code::MultiplyAdd => a * b() + c(),
        Code::MultiplySubtract => a * b() - c(),
        Code::SubtractProduct => c() - a * b(),
        Code::Negative => -a,
        Code::Reciprocal => a.recip(),
        Code::Root => a.sqrt(),
        Code::Absolute => a.abs(),
        Code::Exp => a.exp(),
        Code::Ln => a.ln(),
        Code::Sin => a.sin(),
        Code::Cos => a.cos(),
        Code::Tan => a.tan(),
        Code::Asin => a.asin(),
        Code::Acos => a.acos(),
        Code::Atan => a.atan(),
        Code::Sinh => a.sinh(),
        Code::Cosh => a.cosh(),
        Code::Tanh => a.tanh(),
        Code::Atan2 => a.atan2(b()),
    }
}
