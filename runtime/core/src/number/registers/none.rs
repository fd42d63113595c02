//! Processors without wide registers to detect.

use core::convert::Infallible;

use super::Work;

macro_rules! none {
    ($($name:ident)*) => {
        $(
            /// Does not exist here.
            #[derive(Clone, Copy, Debug)]
            pub struct $name(Infallible);

            impl $name {
                /// `None`: the processor does not have it.
                pub const fn detect() -> Option<Self> {
                    None
                }

                pub(crate) fn run<W: Work>(self, _work: W) -> W::Output {
                    match self.0 {}
                }
            }
        )*
    };
}

none! { Avx2 Avx512 }
