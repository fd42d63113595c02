//! One step, as a plan sees it.

use crate::error::Quantity;
use crate::number::vector::{same, same_mut};
use crate::number::{Coefficient, Scalar, Summation, Vector, copy};

/// The step that is taken: from `(q, p)` at `time` to `time + size`.
#[derive(Debug)]
pub struct Step<'a, V> {
    /// Time at the start, t0.
    pub time: f64,
    /// Step size h; negative for a step backward.
    pub size: f64,
    /// Position at the start, q0, rounded.
    pub q: &'a V,
    /// Compensation of `q`: with [`Compensated`](crate::Compensated) sums the position is `q + q_low`.
    pub q_low: &'a V,
    /// Momentum at the start, p0, rounded.
    pub p: &'a V,
    /// Compensation of `p`.
    pub p_low: &'a V,
    /// Whether the velocity is linear in the momentum and does not depend on time: the kinetic energy is quadratic. Also `false` if the
    /// [solver](crate::solver::Solver::TRIES_LINEARITY) does not test it.
    pub linear_velocity: bool,
}

impl<V: Vector> Step<'_, V> {
    /// The same step for vectors of another type, if that is the same type.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn same<W: Vector>(&self) -> Option<Step<'_, W>> {
        Some(Step {
            time: self.time,
            size: self.size,
            q: same(self.q)?,
            q_low: same(self.q_low)?,
            p: same(self.p)?,
            p_low: same(self.p_low)?,
            linear_velocity: self.linear_velocity,
        })
    }
}

impl<V> Step<'_, V> {
    /// The time `t0 + c h` of the node `c`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn at<T: Scalar>(&self, c: Coefficient) -> T {
        self.span().at(c)
    }

    /// The time span of the step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn span(&self) -> Span {
        Span {
            time: self.time,
            size: self.size,
        }
    }
}

/// The time span of a step: from `time` to `time + size`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Time at the start, t0.
    pub time: f64,
    /// Step size h; negative for a step backward.
    pub size: f64,
}

impl Span {
    /// The time `t0 + c h` of the node `c`, computed in double precision like all times, whatever the scalar.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn at<T: Scalar>(&self, c: Coefficient) -> T {
        T::from_f64(self.time + c.double() * self.size)
    }

    /// The time in the middle, `t0 + h/2`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn middle(&self) -> f64 {
        self.time + self.size / 2.0
    }

    /// The span of size `size` about the time `middle`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[doc(hidden)]
    pub const fn about(middle: f64, size: f64) -> Self {
        Self {
            time: middle - size / 2.0,
            size,
        }
    }
}

/// A stage of a completed step.
#[derive(Clone, Copy, Debug)]
pub struct StageView<'a, V: Vector> {
    /// `h b_i`
    pub weight: f64,
    /// `h b̃_i`
    pub force_weight: f64,
    /// `t0 + c_i h`
    pub time: f64,
    /// `t0 + c̃_i h`
    pub momentum_time: f64,
    /// Position `Q_i`.
    pub q: &'a V,
    /// Momentum `P_i`.
    pub p: &'a V,
    /// `h b_i Λ_i` of each holonomic constraint; empty without any.
    pub impulses: &'a [V::Scalar],
    /// `h b_i` of these, or `h` at a stage of weight zero.
    pub impulse_weight: f64,
}

/// Where the result of a step is written; the old values are ignored.
#[derive(Debug)]
pub struct Outcome<'a, V> {
    /// Position q1, rounded.
    pub q: &'a mut V,
    /// Compensation of `q`; untouched by [`Plain`](crate::Plain) sums.
    pub q_low: &'a mut V,
    /// Momentum p1, rounded.
    pub p: &'a mut V,
    /// Compensation of `p`; untouched by [`Plain`](crate::Plain) sums.
    pub p_low: &'a mut V,
}

impl<'a, V: Vector> Outcome<'a, V> {
    /// The same places for vectors of another type, if that is the same type.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn same<W: Vector>(self) -> Option<Outcome<'a, W>> {
        Some(Outcome {
            q: same_mut(self.q)?,
            q_low: same_mut(self.q_low)?,
            p: same_mut(self.p)?,
            p_low: same_mut(self.p_low)?,
        })
    }

    /// Copies the state before `step`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn copy_from<R: Summation>(&mut self, step: &Step<'_, V>) {
        copy(self.q, step.q);
        copy(self.p, step.p);
        if R::COMPENSATED {
            copy(self.q_low, step.q_low);
            copy(self.p_low, step.p_low);
        }
    }
}

impl<V> Outcome<'_, V> {
    /// Borrows the same places again.
    pub const fn reborrow(&mut self) -> Outcome<'_, V> {
        Outcome {
            q: self.q,
            q_low: self.q_low,
            p: self.p,
            p_low: self.p_low,
        }
    }
}

/// The data of the previous step that the memory of the stages still holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WarmStart {
    /// Whether the evaluations at its end are kept. They are those at the start of this step.
    pub evaluation: bool,
    /// Whether the increments of its stages are kept, to extrapolate those of this step. It was then taken by the same method with the same
    /// step size.
    pub stages: bool,
    /// Size of [those stages](crate::solver::StepStatistics::scales), as returned by the previous step: zero if unknown.
    pub scales: [f64; 2],
}

impl WarmStart {
    /// Keeps evaluations, stages, or both.
    pub const fn new(evaluation: bool, stages: bool) -> Self {
        Self {
            evaluation,
            stages,
            scales: [0.0; 2],
        }
    }
}

impl Default for WarmStart {
    /// Keeps nothing. Written out because the default of an array would be a function call: see `array.rs`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn default() -> Self {
        Self::new(false, false)
    }
}

/// Evaluations that a [`StagePlan`](crate::emitted::StagePlan) makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EvaluationCounts {
    /// Before the coupled stages.
    pub begin: u32,
    /// For the starting values of the coupled stages, if no stages are [kept](WarmStart::stages).
    pub start: u32,
    /// In one sweep.
    pub sweep: u32,
    /// After the coupled stages.
    pub finish: u32,
    /// Number of first evaluations that are skipped if the previous step has [kept](WarmStart::evaluation) them. Every accepted step keeps
    /// them.
    pub carried: u32,
}

impl EvaluationCounts {
    /// Number of evaluations before the coupled stages, given what is kept from the previous step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) const fn at_begin(&self, kept: WarmStart) -> u32 {
        let carried = if kept.evaluation { self.carried } else { 0 };
        let start = if kept.stages { 0 } else { self.start };
        self.begin + start - carried
    }
}

/// Observer of every evaluation of a step that stores no stages. Normal steps use `()`, which ignores them.
pub trait EvaluationObserver {
    /// Receives the evaluation `value` of a stage, from 1, at `argument`.
    fn evaluation<V: Vector>(&mut self, what: Quantity, stage: usize, argument: &V, value: &V);
}

impl EvaluationObserver for () {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluation<V: Vector>(&mut self, _what: Quantity, _stage: usize, _at: &V, _value: &V) {}
}
