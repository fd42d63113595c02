//! The registers whose lanes run trajectories.

use crate::number::registers::{self, Widest};
use crate::number::{Lanes, Vector, WideF64x8, WidestF64x16};
use crate::system::{LaneWork, System};

/// Whether this program may have to detect the registers for a system.
pub const fn may_be_found<V: Vector, S: System<V>>() -> bool {
    registers::UNKNOWN && S::INLINED
}

/// The widest registers of this processor for a system.
pub fn widest<V: Vector, S: System<V>>() -> Widest {
    match may_be_found::<V, S>() {
        true => Widest::find(),
        false => Widest::Build,
    }
}

/// The number of lanes; `L` are those of the build.
pub const fn width<L: Lanes>(registers: Widest) -> usize {
    match registers {
        Widest::Build => L::WIDTH,
        Widest::Avx2(_) => WideF64x8::WIDTH,
        Widest::Avx512(_) => WidestF64x16::WIDTH,
    }
}

/// Runs work with a system over the lanes of these registers; `L` are those of the build. `None` if the system has none.
pub fn over_lanes_of<V, S, L, W, O>(registers: Widest, work: W) -> Option<O>
where
    V: Vector,
    S: System<V> + Clone,
    L: Lanes,
    W: LaneWork<V, S, L, Output = O>
        + LaneWork<V, S, WideF64x8, Output = O>
        + LaneWork<V, S, WidestF64x16, Output = O>,
{
    // Constant conditions: other ensembles compile without this code.
    if const { may_be_found::<V, S>() } {
        match registers {
            Widest::Build => S::over_lanes::<L, _>(work),
            Widest::Avx2(_) => S::over_lanes::<WideF64x8, _>(work),
            Widest::Avx512(_) => S::over_lanes::<WidestF64x16, _>(work),
        }
    } else {
        S::over_lanes::<L, _>(work)
    }
}
