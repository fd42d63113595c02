//! The stages of previous steps, from which those of the next step are extrapolated.

use alloc::vec;
use alloc::vec::Vec;
use core::array;
use symplectic_core::inside::{dither_side, larger_or_nan, words};
use symplectic_core::solver::{Visit, scalar_words, vector_words};
use symplectic_core::{Scalar, Vector};

/// Number of steps from which stages are extrapolated.
const STEPS: usize = 5;

/// Weights of the last steps in the extrapolation to the next, the last step first.
type Weights = [f64; STEPS];

/// The quartic through the last five steps, minus or plus an eighth of its difference from the parabola through the last three. So the
/// error has either sign.
const SIDES: [Weights; 2] = [
    [4.75, -9.125, 8.875, -4.375, 0.875],
    [5.25, -10.875, 11.125, -5.625, 1.125],
];

/// Steps are too long if the two extrapolations of the impulses differ by more than this fraction of the largest impulse. They differ by a
/// quarter of the difference between quartic and parabola. The iteration could then end at another solution of the equations.
const APART: f64 = 0.0125;

/// The quantities of a step that are extrapolated.
#[derive(Clone, Debug)]
struct Stages<V: Vector> {
    /// The differences between stages and their first guesses.
    corrections: Vec<V>,
    /// `h b_k Λ_k`, stage by stage.
    impulses: Vec<V::Scalar>,
}

/// The stages of the last steps with one tableau, all of the same size.
///
/// With equal steps, the differences between the stages and guesses from the start of the step are smooth functions of time. Those of the
/// next step follow from the last ones with a relative error of order h³. [`dither_side`] chooses its sign: the iteration ends within a
/// rounding error of its limit, on the side from which it came.
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
    /// this size are known, or if the steps are too long. `negligible(d)` returns whether a difference d of impulses is a rounding error.
    pub(super) fn begin(
        &mut self,
        time: f64,
        size: f64,
        impulses: &mut [V::Scalar],
        negligible: impl FnOnce(f64) -> bool,
    ) -> Option<Weights> {
        if self.size != size {
            (self.size, self.known) = (size, 0);
        }
        if self.known < STEPS {
            return None;
        }
        let side = usize::from(dither_side(time));
        let (mut largest, mut apart) = (0.0, 0.0);
        for (k, impulse) in impulses.iter_mut().enumerate() {
            let last = |step: usize| self.steps[step].impulses[k];
            let (less, more) = (next(SIDES[0], last), next(SIDES[1], last));
            largest = larger_or_nan(largest, less.magnitude());
            apart = larger_or_nan(apart, (more - less).magnitude());
            *impulse = if side == 0 { less } else { more };
        }
        (apart <= APART * largest || negligible(apart)).then_some(SIDES[side])
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
        self.known = STEPS.min(self.known);
        for step in &mut self.steps {
            vector_words(&mut step.corrections, visit);
            scalar_words(&mut step.impulses, visit);
        }
    }
}

/// The next value of a sequence, where `last(k)` is the one k steps before the last.
#[cfg_attr(not(debug_assertions), inline(always))]
fn next<T: Scalar>(weights: Weights, last: impl Fn(usize) -> T) -> T {
    let mut sum = last(0) * T::from_f64(weights[0]);
    for (k, &weight) in weights.iter().enumerate().skip(1) {
        sum += last(k) * T::from_f64(weight);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::{SIDES, next};

    #[test]
    fn both_extrapolations_are_exact_for_parabolas_with_opposite_errors() {
        let errors = |power: i32| {
            let value = |step: usize| (-1.0 - step as f64).powi(power);
            SIDES.map(|weights| next(weights, value))
        };
        assert_eq!(SIDES.map(|weights| next(weights, |_| 1.0)), [1.0; 2]);
        assert_eq!([errors(1), errors(2)], [[0.0; 2]; 2]);
        // The third difference of t³ is 6.
        assert_eq!(errors(3), [-0.75, 0.75]);
        let [less, more] = errors(4);
        assert!(less != 0.0 && less == -more);
        // The fifth difference of t⁵ is 120: no quartic continues it.
        assert_eq!(errors(5).iter().sum::<f64>(), -240.0);
    }
}
