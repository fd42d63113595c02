//! What a tape reads.

use symplectic::Scalar;

use crate::tape::{At, Input, Register};

/// Inputs for a row of registers: without operations, for a row of results.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Load {
    pub(crate) into: Register,
    pub(crate) count: usize,
    /// The first input.
    pub(crate) input: Input,
}

/// The inputs of a tape by their kinds, because a choice for each input costs as much as an operation.
#[derive(Debug, Clone, Default)]
pub(crate) struct Inputs {
    constants: Vec<(Register, f64)>,
    state: Vec<Row>,
    /// The time, and parameters that vary.
    others: Vec<(Register, Input)>,
}

/// Components of q, half 0, or of p, half 1.
#[derive(Debug, Clone, Copy)]
struct Row {
    into: Register,
    half: usize,
    first: usize,
    count: usize,
}

impl FromIterator<Load> for Inputs {
    fn from_iter<I: IntoIterator<Item = Load>>(loads: I) -> Self {
        let mut all = Inputs::default();
        for Load { into, count, input } in loads {
            match (input, input.component()) {
                (Input::Constant(value), _) => all.constants.push((into, value)),
                (_, Some((half, first))) => all.state.push(Row {
                    into,
                    half,
                    first,
                    count,
                }),
                _ => all.others.push((into, input)),
            }
        }
        all
    }
}

impl Inputs {
    /// All inputs.
    pub(crate) fn all(&self) -> impl Iterator<Item = Input> {
        let constants = self
            .constants
            .iter()
            .map(|(_, value)| Input::Constant(*value));
        let state = self.state.iter().flat_map(|row| {
            let input = match row.half {
                0 => Input::Position,
                _ => Input::Momentum,
            };
            (row.first..row.first + row.count).map(input)
        });
        let others = self.others.iter().map(|(_, input)| *input);
        constants.chain(state).chain(others)
    }

    /// Calls `write` with the register and the values of each row of inputs.
    #[inline]
    pub(crate) fn each<T: Scalar>(&self, at: At<'_, T>, mut write: impl FnMut(usize, &[T])) {
        for &(into, value) in &self.constants {
            write(into as usize, &[T::from_f64(value)]);
        }
        self.each_of_point(at, write);
    }

    /// [`each`](Self::each) without constants.
    #[inline]
    pub(crate) fn each_of_point<T: Scalar>(
        &self,
        at: At<'_, T>,
        mut write: impl FnMut(usize, &[T]),
    ) {
        let nan = || T::from_f64(f64::NAN);
        for &Row {
            into,
            half,
            first,
            count,
        } in &self.state
        {
            let (into, half) = (into as usize, if half == 0 { at.q } else { at.p });
            if count == 1 {
                write(into, &[half.get(first).copied().unwrap_or_else(nan)]);
            } else if let Some(row) = half.get(first..first + count) {
                write(into, row);
            } else {
                for k in 0..count {
                    let value = half.get(first + k).copied();
                    write(into + k, &[value.unwrap_or_else(nan)]);
                }
            }
        }
        for &(into, input) in &self.others {
            write(into as usize, &[at.other(input)]);
        }
    }

    /// Calls `write` with the register and the value of each constant.
    pub(crate) fn each_constant(&self, mut write: impl FnMut(usize, f64)) {
        for &(into, value) in &self.constants {
            write(into as usize, value);
        }
    }
}
