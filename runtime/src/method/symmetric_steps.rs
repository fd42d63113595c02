//! The steps of a composition of Störmer–Verlet, taken with another symmetric method of order 2.

use crate::method::{ConstrainedStep, Method};

/// The fractions `γ_1, …, γ_m` of a composition of Störmer–Verlet steps.
///
/// They apply to every symmetric method of order 2, because its compositions have the same order conditions (Hairer, Lubich & Wanner,
/// *Geometric numerical integration*, V.3).
#[derive(Clone, Copy, Debug)]
pub(crate) struct SymmetricSteps(&'static [ConstrainedStep]);

/// A substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    pub(crate) time: f64,
    pub(crate) size: f64,
    /// Time at the end of the substep.
    pub(crate) end: f64,
}

impl SymmetricSteps {
    /// A single step, not a composition.
    pub(crate) const ONE: Self = Self(&[]);

    /// The steps of `M`. Does not compile unless `M` is a composition of Störmer–Verlet steps.
    pub(crate) fn of<M: Method>() -> Self {
        const {
            assert!(
                is_stoermer_verlet(M::CONSTRAINED),
                "a composition for this base consists of Störmer–Verlet steps: \
                 `composition! {{ Name {{ base: stormer-verlet, weights: suzuki(4) }} }}`"
            );
        }
        Self(M::CONSTRAINED)
    }

    /// The substeps of the step of size `size` from `time` to `end`.
    pub(crate) fn parts(self, time: f64, size: f64, end: f64) -> impl Iterator<Item = Part> {
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

/// Whether there are steps and each is Lobatto IIIA–IIIB with two stages: nodes 0 and 1 and weights 1/2 determine the rest.
const fn is_stoermer_verlet(mut steps: &[ConstrainedStep]) -> bool {
    if steps.is_empty() {
        return false;
    }
    while let [step, rest @ ..] = steps {
        let ([first, second], [b1, b2]) = (step.tableau.nodes, step.tableau.weights) else {
            return false;
        };
        let nodes = first.double() == 0.0 && second.double() == 1.0;
        if !nodes || b1.double() != 0.5 || b2.double() != 0.5 {
            return false;
        }
        steps = rest;
    }
    true
}
