//! The registers of an evaluation.

use std::any::Any;
use std::cell::RefCell;

use symplectic::Scalar;
use symplectic::simd::Lanes;

use super::Eight;
use crate::tape::Register;

/// The size of a cache line: no chunk of a row in a block is in two.
const LINE: usize = 64;

/// Runs work with `count` registers, which the thread keeps for the next evaluation. They hold old values at first.
pub(super) fn with_registers<R: Copy + 'static>(
    count: usize,
    zero: R,
    work: impl FnOnce(&mut [R]),
) {
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
pub(super) trait Registers<T> {
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
pub(super) struct Eights<R>(pub(super) R);

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
