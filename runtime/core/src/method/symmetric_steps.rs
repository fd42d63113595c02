//! The steps of a composition of Störmer–Verlet, taken with another symmetric method of order 2.

#[cfg(feature = "alloc")]
use alloc::string::String;

use crate::contract::{ConstrainedStep, StoermerVerletSteps};

/// The fractions `γ_1, …, γ_m` of a composition of Störmer–Verlet steps.
///
/// They apply to every symmetric method of order 2, because its compositions have the same order conditions (Hairer, Lubich & Wanner,
/// *Geometric numerical integration*, V.3).
#[derive(Clone, Copy, Debug)]
pub struct SymmetricSteps(&'static [ConstrainedStep]);

/// A substep.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Time at the start of the substep.
    pub time: f64,
    /// Its size.
    pub size: f64,
    /// Time at the end of the substep.
    pub end: f64,
}

impl SymmetricSteps {
    /// A single step, not a composition.
    pub const ONE: Self = Self(&[]);

    /// The steps of `M`.
    pub fn of<M: StoermerVerletSteps>() -> Self {
        Self(M::CONSTRAINED)
    }

    /// The text that identifies them in a checkpoint.
    #[cfg(feature = "alloc")]
    pub fn definition(self) -> String {
        if self.0.is_empty() {
            return "single steps".into();
        }
        let fractions = self.0.iter().map(|step| step.fraction.double());
        fractions.fold("composed steps:".into(), |text, fraction| {
            alloc::format!("{text} {fraction}")
        })
    }

    /// The substeps of the step of size `size` from `time` to `end`.
    pub fn parts(self, time: f64, size: f64, end: f64) -> impl Iterator<Item = Part> {
        let count = self.0.len().max(1);
        let at = move |number: usize, start: f64| match number {
            0 => time,
            _ if number == count => end,
            _ => time + start * size,
        };
        let start = move |number: usize| self.0.get(number).map_or(0.0, |step| step.start.double());
        (0..count).map(move |number| Part {
            time: at(number, start(number)),
            size: self
                .0
                .get(number)
                .map_or(1.0, |step| step.fraction.double())
                * size,
            end: at(number + 1, start(number + 1)),
        })
    }
}
