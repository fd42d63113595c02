//! The stages of previous steps, from which those of the next step are extrapolated.

use alloc::vec;
use alloc::vec::Vec;
use core::array;

use super::step::maximum;
use crate::number::dither::dither_side;
use crate::number::words::words;
use crate::number::{Scalar, Vector, Visit, scalar_words, vector_words};

/// Number of steps from which stages are extrapolated.
const STEPS: usize = 5;

/// What the last steps contribute to the next, the last step first.
type Weights = [f64; STEPS];

/// A parabola through the last three steps. It misses by the third difference Δ³ of the sequence.
const PARABOLA: Weights = [3.0, -3.0, 1.0, 0.0, 0.0];

/// Twice the quartic through the last five steps, less the parabola: misses by −Δ³, up to the fifth difference.
const MIRRORED: Weights = [7.0, -17.0, 19.0, -10.0, 2.0];

/// Steps are too long if the two extrapolations of the impulses are further apart than this fraction of the largest impulse. The iteration
/// could then end at another solution of the equations.
const APART: f64 = 0.1;

/// What is extrapolated of a step.
#[derive(Clone, Debug)]
struct Stages<V: Vector> {
    /// The differences between stages and their first guesses.
    corrections: Vec<V>,
    /// `h b_k Λ_k`, stage by stage.
    impulses: Vec<V::Scalar>,
}

/// The stages of the last steps with one tableau, all of the same size.
///
/// With equal steps, the differences between the stages and guesses from the start of the step are smooth functions of time. Those of the next
/// step follow from the last ones with a relative error of order h³. [`dither_side`] chooses the sign of this error: the iteration ends within
/// a rounding error of its limit, on the side from which it came.
#[derive(Clone, Debug)]
pub(super) struct History<V: Vector> {
    /// The size of the steps.
    size: f64,
    /// Number of steps that are known.
    known: usize,
    /// The last step first. During a step, the last place holds its guesses with the opposite sign.
    steps: [Stages<V>; STEPS],
}

impl<V: Vector> History<V> {
    /// Memory for `stages` positions or momenta and for `impulses` impulses.
    pub(super) fn new(prototype: &V, stages: usize, impulses: usize) -> Self {
        let steps = array::from_fn(|_| Stages {
            corrections: (0..stages).map(|_| prototype.zeros_like()).collect(),
            impulses: vec![V::Scalar::from_f64(0.0); impulses],
        });
        Self {
            size: 0.0,
            known: 0,
            steps,
        }
    }

    /// Forgets all steps.
    pub(super) fn forget(&mut self) {
        self.known = 0;
    }

    /// Begins a step at a time, of a size. Extrapolates the impulses and returns the weights for stages. Returns `None` if too few steps of
    /// this size are known, or if they are too long for that.
    pub(super) fn begin(
        &mut self,
        time: f64,
        size: f64,
        impulses: &mut [V::Scalar],
    ) -> Option<Weights> {
        if self.size != size {
            (self.size, self.known) = (size, 0);
        }
        if self.known < STEPS {
            return None;
        }
        let is_mirrored = dither_side(time);
        let (mut largest, mut apart) = (0.0, 0.0);
        for (k, impulse) in impulses.iter_mut().enumerate() {
            let last = |step: usize| self.steps[step].impulses[k];
            let (parabola, mirrored) = (next(PARABOLA, last), next(MIRRORED, last));
            largest = maximum(largest, parabola.magnitude());
            apart = maximum(apart, (mirrored - parabola).magnitude());
            *impulse = if is_mirrored { mirrored } else { parabola };
        }
        let weights = if is_mirrored { MIRRORED } else { PARABOLA };
        (apart <= APART * largest).then_some(weights)
    }

    /// Notes the guess of stage value `k`, and corrects it if there are weights.
    pub(super) fn correct(&mut self, weights: Option<Weights>, k: usize, guess: &mut V) {
        let steps = &mut self.steps;
        for (component, guess) in guess.as_mut_slice().iter_mut().enumerate() {
            let correction = |step: usize| steps[step].corrections[k].as_slice()[component];
            let correction = weights.map(|weights| next(weights, correction));
            steps[STEPS - 1].corrections[k].as_mut_slice()[component] = -*guess;
            if let Some(correction) = correction {
                *guess += correction;
            }
        }
    }

    /// Ends a step with these stage values and impulses.
    pub(super) fn end<'a>(&mut self, stages: impl Iterator<Item = &'a V>, impulses: &[V::Scalar])
    where
        V: 'a,
    {
        let step = &mut self.steps[STEPS - 1];
        for (correction, stage) in step.corrections.iter_mut().zip(stages) {
            let pairs = correction.as_mut_slice().iter_mut();
            for (correction, &found) in pairs.zip(stage.as_slice()) {
                *correction += found;
            }
        }
        let places = step.impulses.iter_mut().zip(impulses);
        places.for_each(|(place, &impulse)| *place = impulse);
        self.steps.rotate_right(1);
        self.known = STEPS.min(self.known + 1);
    }

    /// The words of all numbers.
    pub(super) fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.size, self.known);
        for step in &mut self.steps {
            vector_words(&mut step.corrections, visit);
            scalar_words(&mut step.impulses, visit);
        }
    }
}

/// The next value of a sequence, where `last(k)` is the one k steps before the last.
#[inline(always)]
fn next<T: Scalar>(weights: Weights, last: impl Fn(usize) -> T) -> T {
    let terms = (1..STEPS).map(|k| last(k) * T::from_f64(weights[k]));
    terms.fold(last(0) * T::from_f64(weights[0]), |sum, term| sum + term)
}

#[cfg(test)]
mod tests {
    use super::{MIRRORED, PARABOLA, STEPS, next};

    #[test]
    fn both_continue_parabolas_and_miss_a_third_difference_by_opposite_errors() {
        let values = |power: i32| [0, 1, 2, 3, 4].map(|k| f64::from(-1 - k).powi(power));
        let extrapolated = |weights, power| next(weights, |step: usize| values(power)[step]);
        for power in 1..3 {
            assert_eq!(extrapolated(PARABOLA, power), 0.0);
            assert_eq!(extrapolated(MIRRORED, power), 0.0);
        }
        // The third difference of t³ is 6.
        assert_eq!(extrapolated(PARABOLA, 3), -6.0);
        assert_eq!(extrapolated(MIRRORED, 3), 6.0);
        // The errors of t⁴ cancel too, those of t⁵ do not.
        let both = |power| extrapolated(PARABOLA, power) + extrapolated(MIRRORED, power);
        assert_eq!(both(4), 0.0);
        assert_eq!(both(5), -2.0 * 120.0);
        assert_eq!(next(MIRRORED, |_| 1.0), 1.0);
        assert_eq!(PARABOLA.len(), STEPS);
    }
}
