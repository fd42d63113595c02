//! The stages of previous steps, from which those of the next step are extrapolated.

use alloc::vec;
use alloc::vec::Vec;
use core::array;

use crate::number::words::words;
use crate::number::{Scalar, Vector, Visit, scalar_words, vector_words};

/// Number of steps from which stages are extrapolated.
const STEPS: usize = 3;

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
/// step follow from the last three with a relative error of order h³.
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

    /// Begins a step of a size. Extrapolates the impulses and returns `true`, or `false` if too few steps of this size are known.
    pub(super) fn begin(&mut self, size: f64, impulses: &mut [V::Scalar]) -> bool {
        if self.size != size {
            (self.size, self.known) = (size, 0);
        }
        let extrapolated = self.known == STEPS;
        if extrapolated {
            let [last, before, first] = &self.steps;
            let known = last
                .impulses
                .iter()
                .zip(&before.impulses)
                .zip(&first.impulses);
            for (impulse, ((&last, &before), &first)) in impulses.iter_mut().zip(known) {
                *impulse = next(last, before, first);
            }
        }
        extrapolated
    }

    /// Corrects the guess of stage value `k` by extrapolation if that is possible.
    pub(super) fn correct(&mut self, k: usize, guess: &mut V) {
        let extrapolated = self.known == STEPS;
        let [last, before, first] = &mut self.steps;
        let (last, before) = (
            last.corrections[k].as_slice(),
            before.corrections[k].as_slice(),
        );
        let first = first.corrections[k].as_mut_slice().iter_mut();
        for ((guess, first), (&last, &before)) in
            (guess.as_mut_slice().iter_mut().zip(first)).zip(last.iter().zip(before))
        {
            let correction = next(last, before, *first);
            *first = -*guess;
            if extrapolated {
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

/// The next value of a sequence by a parabola through the last three.
#[inline(always)]
fn next<T: Scalar>(last: T, before: T, first: T) -> T {
    (last - before) * T::from_f64(3.0) + first
}
