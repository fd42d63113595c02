//! Evaluations that neither the result of a step nor a stage it needs depends on.

use super::{Evaluation, StageValue, StepGraph};
use crate::algebra::{Number, Zero};

impl StepGraph<'_> {
    /// The graph for separable Hamiltonians without unused evaluations and their stages. An evaluation is unused if it has no
    /// weight and no used stage needs it: the drift of 0 at the end of a splitting needs no velocity.
    ///
    /// A coefficient that is only known to be tiny counts as used.
    pub(super) fn without_unused_evaluations(mut self) -> Self {
        loop {
            let used = |evaluations: &[Evaluation<'_>], values: &[StageValue<'_>]| {
                let needed = |(index, evaluation): (usize, &Evaluation<'_>)| {
                    let in_row = |value: &StageValue<'_>| !vanishes(&value.coefficients[index]);
                    !vanishes(&evaluation.weight) || values.iter().any(in_row)
                };
                evaluations
                    .iter()
                    .enumerate()
                    .map(needed)
                    .collect::<Vec<bool>>()
            };
            let velocities = used(&self.velocities, &self.positions);
            let forces = used(&self.forces, &self.momenta);
            if velocities.iter().chain(&forces).all(|used| *used) {
                return self;
            }
            retain(&mut self.velocities, &velocities);
            retain(&mut self.forces, &forces);
            // Stage and evaluation have the same index here: a force belongs to a position, a velocity to a momentum.
            retain(&mut self.positions, &forces);
            retain(&mut self.momenta, &velocities);
            for (values, kept) in [
                (&mut self.positions, &velocities),
                (&mut self.momenta, &forces),
            ] {
                for value in values {
                    retain(&mut value.coefficients, kept);
                    value
                        .applied
                        .iter_mut()
                        .for_each(|applied| retain(applied, kept));
                }
            }
            let moved = |index: &mut Option<usize>, kept: &[bool]| {
                if let Some(index) = index {
                    *index = kept[..*index].iter().filter(|kept| **kept).count();
                }
            };
            for evaluation in &mut self.forces {
                moved(&mut evaluation.position, &forces);
            }
            for evaluation in &mut self.velocities {
                moved(&mut evaluation.momentum, &velocities);
            }
        }
    }
}

fn vanishes(number: &Number<'_>) -> bool {
    number.zero() == Zero::Yes
}

fn retain<T>(items: &mut Vec<T>, kept: &[bool]) {
    let mut kept = kept.iter();
    items.retain(|_| kept.next().copied().unwrap_or(true));
}
