//! Operations on rows of doubles, eight at a time.

use std::iter::repeat;
use std::marker::PhantomData;

use symplectic::simd::Lanes;
use symplectic_core::inside::{EightLanes, in_eight_lanes};

use super::{Eight, OneByOne};
use crate::assembly::CHUNK;
use crate::operation::{Operation, Use, dispatch};
use crate::tape::{Operand, Register, Step, Tape};

/// Operations on doubles.
pub(super) struct Rows<'a> {
    pub(super) tape: &'a Tape,
    pub(super) registers: &'a mut [f64],
}

/// Applies the operations of a tape to doubles, rows in chunks.
#[inline(never)]
pub(super) fn by_rows(tape: &Tape, registers: &mut [f64]) {
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
