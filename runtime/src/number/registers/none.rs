//! Processors without registers to be found.

use core::convert::Infallible;

use super::Work;

/// Does not exist here.
#[derive(Clone, Copy, Debug)]
pub struct WideRegisters(Infallible);

impl WideRegisters {
    pub(crate) const fn detect() -> Option<Self> {
        None
    }

    pub(crate) fn run<W: Work>(self, _work: W) -> W::Output {
        match self.0 {}
    }
}
