//! Starting approximations for the stages of a step from those of the previous step.

use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::ratio;
use crate::arithmetic::rounding::to_f64;
use crate::schedule::{Evaluation, Node, StepGraph};

use super::facts::{Extrapolation, Half, Known};
use super::symplectic_rounding::decide;

/// The matrix that maps the increments `h w_j f_j` of a step to those of the next step of the same size.
///
/// The polynomial through the evaluations `f_j` at the times `c_j` is evaluated at `1 + c_i`:
///
/// ```text
/// E_ij = (w_i/w_j) Π_{k≠j} (1 + c_i − c_k)/(c_j − c_k)
/// ```
///
/// The entries are correctly rounded. Returns `None` if times coincide as far as enclosures can tell. `kind` selects the
/// evaluations; its index does not matter.
pub(super) fn matrix(
    graph: &StepGraph<'_>,
    kind: Node,
    evaluations: &[&Evaluation<'_>],
    known: &Known,
) -> Extrapolation {
    let half = match kind {
        Node::Force(_) => Half::Momenta,
        _ => Half::Positions,
    };
    let stages = evaluations.iter().map(|e| graph.stages_of(e)).collect();
    known.extrapolation(half, stages, || compute(evaluations))
}

fn compute(evaluations: &[&Evaluation<'_>]) -> Option<Vec<Vec<f64>>> {
    let first = Enclosed::new(evaluations, 0);
    let entry = |i: usize, j: usize| {
        let enclose = |bits| match bits <= first.bits {
            true => first.entry(i, j),
            false => Enclosed::new(evaluations, bits).entry(i, j),
        };
        decide(enclose, to_f64).filter(|value| value.is_finite())
    };
    let indices = 0..evaluations.len();
    let row = |i| indices.clone().map(|j| entry(i, j)).collect();
    indices.clone().map(row).collect()
}

/// Enclosures of the factors of the entries.
struct Enclosed {
    bits: u32,
    times: Vec<Interval>,
    weights: Vec<Interval>,
    /// `w_j Π_{k≠j} (c_j − c_k)`
    divisors: Vec<Interval>,
}

impl Enclosed {
    fn new(evaluations: &[&Evaluation<'_>], bits: u32) -> Self {
        let times: Vec<Interval> = evaluations.iter().map(|e| e.time.enclose(bits)).collect();
        let weights: Vec<Interval> = evaluations.iter().map(|e| e.weight.enclose(bits)).collect();
        let divisors = (0..times.len()).map(|j| product(&weights[j], &times[j], &times, j));
        Enclosed {
            bits: times.first().map_or(0, Interval::bits),
            divisors: divisors.collect(),
            times,
            weights,
        }
    }

    /// An enclosure of one entry; `None` if a divisor's enclosure contains zero.
    fn entry(&self, i: usize, j: usize) -> Option<Interval> {
        let later = self.times[i].add(&Interval::enclosing(&ratio(1, 1), self.bits));
        product(&self.weights[i], &later, &self.times, j).divide(&self.divisors[j])
    }
}

/// `factor Π_{k≠j} (time − c_k)`
fn product(factor: &Interval, time: &Interval, times: &[Interval], j: usize) -> Interval {
    let others = times.iter().enumerate().filter(|&(k, _)| k != j);
    others.fold(factor.clone(), |product, (_, other)| {
        product.multiply(&time.subtract(other))
    })
}
