//! Coupled stages of emitted methods.

use core::marker::PhantomData;

use super::by_halves::{self, GaussSeidel, Jacobi};
use super::second_order::{self, SecondOrder};
use super::settle::settle;
use super::{Sums, largest, relax, scalar, transform};
use crate::coupled::stages::{LaneOutcome, LaneStages, StepInLanes};
use symplectic_core::inside::sweeps::{
    BasePlusSum, Columns, TermsOfComponents, are_at_one_time, eliminates, shortest,
};
use symplectic_core::inside::{Work, copy, scale, totals_by};
use symplectic_core::simd::Lanes;
use symplectic_core::solver::{Coefficient, HalfTableau, Outcome, StageTableau, Step};
use symplectic_core::system::Class;
use symplectic_core::{Summation, System, Vector};

/// A step of an emitted method.
pub(super) struct ByMethod<P, R, T>(pub(super) T, pub(super) PhantomData<(P, R)>);

impl<P, R, W, S> Work for ByMethod<P, R, StepInLanes<'_, W, S>>
where
    P: StageTableau,
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W, Class = P::Class>,
{
    type Output = Option<LaneOutcome<W::Scalar>>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Self::Output {
        let StepInLanes {
            step,
            system,
            memory,
            live,
            stopping,
            outcome,
        } = self.0;
        let scales = memory.scales;
        let mut stages = Emitted::<P, R, W, S> {
            step,
            system,
            before: &memory.before,
            now: &mut memory.now,
            settled: &mut memory.settled,
            kind: PhantomData,
        };
        let (settled, counts) = if P::Class::SEPARABLE && step.linear_velocity && eliminates::<P>()
        {
            stages.start();
            let mut sweeps = SecondOrder(stages);
            let settled = settle::<P::Class, _, _>(&mut sweeps, step.time, live, scales, stopping);
            sweeps.update(outcome);
            (settled, second_order::counts::<P, R>())
        } else if P::Class::SEPARABLE {
            let mut sweeps = GaussSeidel(stages);
            let settled = settle::<P::Class, _, _>(&mut sweeps, step.time, live, scales, stopping);
            sweeps.0.totals(outcome);
            (settled, by_halves::counts::<P>())
        } else {
            let mut sweeps = Jacobi(stages);
            let settled = settle::<P::Class, _, _>(&mut sweeps, step.time, live, scales, stopping);
            sweeps.0.totals(outcome);
            (settled, by_halves::counts::<P>())
        };
        let is_sound = !memory.now.mismatch(step.q.dimension());
        Some(LaneOutcome {
            settled: if is_sound { settled.lanes } else { 0 },
            sweeps: settled.sweeps,
            scales: settled.scales,
            counts,
        })
    }
}

/// The stages of a method. With plain sums evaluations are scaled to increments after the iteration, as in a single run.
pub(super) struct Emitted<'a, P, R, W, S> {
    pub(super) step: &'a Step<'a, W>,
    pub(super) system: &'a S,
    pub(super) before: &'a LaneStages<W>,
    pub(super) now: &'a mut LaneStages<W>,
    pub(super) settled: &'a mut LaneStages<W>,
    kind: PhantomData<(P, R)>,
}

/// The sums that give one half of the stages from the evaluations of the other half, which may be increments.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sums<R: Summation, P: StageTableau>(
    columns: &'static [&'static [f64]],
    weights: &'static [f64],
    h: f64,
    of_increments: bool,
) -> Sums<impl Fn(usize) -> usize, impl Fn(usize, usize) -> (usize, f64)> {
    Sums {
        count: |_| columns.len(),
        term: move |stage: usize, j: usize| {
            let entry = columns[j][stage];
            let factor = match (P::INCREMENTS, of_increments) {
                (true, true) => entry,
                (true, false) => entry * (h * weights[j]),
                (false, _) => entry * h,
            };
            (j, factor)
        },
        with_low: R::COMPENSATED,
    }
}

/// The time of an evaluation.
#[cfg_attr(not(debug_assertions), inline(always))]
fn at<W: Vector>(half: &HalfTableau, step: &Step<'_, W>, stage: usize) -> W::Scalar {
    scalar::<W>(step.time + half.times[stage] * step.size)
}

/// Scales evaluations to increments.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn increments<P: StageTableau, W: Vector>(
    half: &HalfTableau,
    h: f64,
    evaluations: &mut [W],
) {
    if P::INCREMENTS {
        for (stage, evaluation) in evaluations.iter_mut().enumerate() {
            scale(evaluation, h, Coefficient::exact(half.weights[stage]));
        }
    }
}

impl<P, R, W, S> Emitted<'_, P, R, W, S>
where
    P: StageTableau,
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W, Class = P::Class>,
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn forces(&mut self) {
        let LaneStages { q, p, force, .. } = &mut *self.now;
        for (stage, force) in force.iter_mut().enumerate() {
            let p = p.get(stage).unwrap_or(self.step.p);
            let time = at(&P::POSITIONS, self.step, stage);
            self.system.force(time, &q[stage], p, force);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn velocities(&mut self) {
        let LaneStages { q, p, velocity, .. } = &mut *self.now;
        for (stage, velocity) in velocity.iter_mut().enumerate() {
            let q = q.get(stage).unwrap_or(self.step.q);
            let time = at(&P::MOMENTA, self.step, stage);
            self.system.velocity(time, q, &p[stage], velocity);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn slopes(&mut self) {
        if !are_at_one_time::<P>() {
            self.forces();
            return self.velocities();
        }
        let LaneStages {
            q,
            p,
            velocity,
            force,
            ..
        } = &mut *self.now;
        for (stage, slopes) in velocity.iter_mut().zip(force).enumerate() {
            let time = at(&P::POSITIONS, self.step, stage);
            self.system.slopes(time, &q[stage], &p[stage], slopes);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn scale_forces(&mut self) {
        increments::<P, W>(&P::POSITIONS, self.step.size, &mut self.now.force);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn scale_velocities(&mut self) {
        increments::<P, W>(&P::MOMENTA, self.step.size, &mut self.now.velocity);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn positions<T: Summation>(&mut self, of_increments: bool) -> W::Scalar {
        let (columns, weights) = (Columns::<P>::POSITIONS, P::MOMENTA.weights);
        let sums = sums::<T, P>(columns, weights, self.step.size, of_increments);
        let base = (self.step.q, self.step.q_low);
        relax::<T, W>(
            &sums,
            &mut self.now.q,
            base,
            &self.now.velocity,
            BasePlusSum,
        )
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn momenta<T: Summation>(&mut self, of_increments: bool) -> W::Scalar {
        let (columns, weights) = (Columns::<P>::MOMENTA, P::POSITIONS.weights);
        let sums = sums::<T, P>(columns, weights, self.step.size, of_increments);
        let base = (self.step.p, self.step.p_low);
        relax::<T, W>(&sums, &mut self.now.p, base, &self.now.force, BasePlusSum)
    }

    /// Sets all stages to the start of the step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn fill(&mut self) {
        self.now.q.iter_mut().for_each(|q| copy(q, self.step.q));
        self.now.p.iter_mut().for_each(|p| copy(p, self.step.p));
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn extrapolate_velocities(&mut self) {
        let columns = P::MOMENTA.extrapolation;
        let (out, vectors) = (&mut self.now.velocity, &self.before.velocity);
        transform(out, vectors, |i, j| columns[j][i]);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn extrapolate_forces(&mut self) {
        let columns = P::POSITIONS.extrapolation;
        let (out, vectors) = (&mut self.now.force, &self.before.force);
        transform(out, vectors, |i, j| columns[j][i]);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn scales(&self) -> [W::Scalar; 2] {
        [
            largest(self.step.q, &self.now.q),
            largest(self.step.p, &self.now.p),
        ]
    }

    /// The velocity at the start of the step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn start(&mut self) {
        if let Some(start) = self.settled.start.first_mut() {
            let Step { time, q, p, .. } = *self.step;
            self.system.velocity(scalar::<W>(time), q, p, start);
        }
    }

    /// New positions and momenta.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn totals(&mut self, outcome: Outcome<'_, W>) {
        let (step, settled) = (self.step, &mut *self.settled);
        if !R::COMPENSATED {
            increments::<P, W>(&P::POSITIONS, step.size, &mut settled.force);
            increments::<P, W>(&P::MOMENTA, step.size, &mut settled.velocity);
        }
        let Outcome { q, q_low, p, p_low } = outcome;
        let (velocity, force) = (&settled.velocity, &settled.force);
        let base = (step.q, step.q_low);
        total::<R, P, W>((q, q_low), base, velocity, &P::MOMENTA, step.size);
        let base = (step.p, step.p_low);
        total::<R, P, W>((p, p_low), base, force, &P::POSITIONS, step.size);
    }
}

/// One half of the result of a step.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn total<R: Summation, P: StageTableau, W: Vector>(
    out: (&mut W, &mut W),
    base: (&W, &W),
    terms: &[W],
    half: &HalfTableau,
    h: f64,
) {
    let n = shortest(terms).min(base.0.dimension());
    let increments = Increments::<P, W> {
        terms,
        weights: half.weights,
        h,
        method: PhantomData,
    };
    totals_by::<R, W>(out, base, (n, half.count), increments);
}

/// The increments of evaluations, which may be increments already.
struct Increments<'a, P, W> {
    terms: &'a [W],
    weights: &'static [f64],
    h: f64,
    method: PhantomData<P>,
}

impl<P: StageTableau, W: Vector> TermsOfComponents<W::Scalar> for Increments<'_, P, W> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn term(&self, component: usize, stage: usize) -> W::Scalar {
        let entry = self.terms[stage].as_slice()[component];
        match P::INCREMENTS {
            true => entry,
            false => scalar::<W>(self.h * self.weights[stage]) * entry,
        }
    }
}
