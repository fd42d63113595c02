//! Starting values for the stages of a step from those of the step before.

use crate::algebra::Number;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::ratio;
use crate::arithmetic::rounding::to_f64;
use crate::schedule::Evaluation;

use super::relative::decide;

/// The matrix that takes the increments `h w_j f_j` of a step to those of the next one of the same size.
///
/// The polynomial through the evaluations `f_j` at the times `c_j` is evaluated at `1 + c_i`:
///
/// ```text
/// E_ij = (w_i/w_j) Π_{k≠j} (1 + c_i − c_k)/(c_j − c_k)
/// ```
///
/// Correctly rounded; `None` where times coincide, as far as is known.
pub(super) fn matrix(evaluations: &[&Evaluation<'_>]) -> Option<Vec<Vec<f64>>> {
    let entry = |i: usize, j: usize| {
        decide(|bits| enclose(evaluations, i, j, bits), to_f64).filter(|value| value.is_finite())
    };
    let indices = 0..evaluations.len();
    let row = |i| indices.clone().map(|j| entry(i, j)).collect();
    indices.clone().map(row).collect()
}

/// An enclosure of one entry; `None` where a divisor is not told from zero by it.
fn enclose(evaluations: &[&Evaluation<'_>], i: usize, j: usize, bits: u32) -> Option<Interval> {
    let value = |number: &Number<'_>| number.enclose(bits);
    let time = |k: usize| value(&evaluations[k].time);
    let weights = value(&evaluations[i].weight).divide(&value(&evaluations[j].weight))?;
    let later = time(i).add(&Interval::enclosing(&ratio(1, 1), weights.bits()));
    let others = (0..evaluations.len()).filter(|&k| k != j);
    others.into_iter().try_fold(weights, |product, k| {
        let factor = later
            .subtract(&time(k))
            .divide(&time(j).subtract(&time(k)))?;
        Some(product.multiply(&factor))
    })
}
