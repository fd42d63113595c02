//! Sweeps over positions only, for second-order systems (Nyström).

use core::marker::PhantomData;

use super::emitted::{Emitted, increments, total};
use super::{LaneSweeps, Sums, copy_lanes, largest, relax, scalar, transform};
use crate::coupled::stages::LaneStages;
use symplectic_core::inside::sweeps::{
    Columns, LaneMovement, StageValue, Start, Terms, position, shortest, starts_at_once,
    sum_of_products, tableau,
};
use symplectic_core::inside::{add, copy};
use symplectic_core::simd::Lanes;
use symplectic_core::solver::{EvaluationCounts, Outcome, StageTableau};
use symplectic_core::{Plain, Scalar, Summation, System, Vector};

/// The evaluations of a step.
pub(super) const fn counts<P: StageTableau, R: Summation>() -> EvaluationCounts {
    let forces = P::POSITIONS.count as u32;
    let predicted = if starts_at_once(&P::POSITIONS) {
        0
    } else {
        forces
    };
    EvaluationCounts {
        begin: 1 + predicted,
        start: 0,
        sweep: 2 * forces,
        finish: R::COMPENSATED as u32,
        carried: 0,
    }
}

/// The sweeps over positions only, for second-order systems. The places of the velocities hold `M⁻¹` times the increments of the momentum.
pub(super) struct SecondOrder<'a, P, R, W, S>(pub(super) Emitted<'a, P, R, W, S>);

/// [`position`] as a [`StageValue`].
struct Position<'a, P, R, L> {
    size: f64,
    factor: f64,
    velocity: &'a [L],
    method: PhantomData<(P, R)>,
}

impl<P: StageTableau, R: Summation, L: Lanes> StageValue<L> for Position<'_, P, R, L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(&self, (stage, k): (usize, usize), base: (L, L), sum: L) -> L {
        let node = L::from_f64(tableau::<P>().nodes[stage]);
        // A velocity of another dimension: the trajectory takes the step alone, which reports it.
        let velocity = match self.velocity.get(k) {
            Some(velocity) => *velocity,
            None => L::from_f64(f64::NAN),
        };
        position::<R, _>(base, (self.size, node), velocity, (self.factor, sum))
    }
}

/// Component `k` of evaluations, each multiplied by its weight.
struct Weighted<'a, F, W> {
    weight: F,
    terms: &'a [W],
    k: usize,
}

impl<F: Fn(usize) -> f64, W: Vector> Terms<W::Scalar> for Weighted<'_, F, W> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn term(&self, stage: usize) -> W::Scalar {
        scalar::<W>((self.weight)(stage)) * self.terms[stage].as_slice()[self.k]
    }
}

/// `M⁻¹` times the increments of the momentum.
#[cfg_attr(not(debug_assertions), inline(always))]
const fn slopes<S: System<W>, W: Vector>(stages: &LaneStages<W>) -> &alloc::vec::Vec<W> {
    match S::MASSES.are_unit() {
        true => &stages.force,
        false => &stages.velocity,
    }
}

impl<P, R, W, S> SecondOrder<'_, P, R, W, S>
where
    P: StageTableau,
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W, Class = P::Class>,
{
    /// Computes `M⁻¹` times the increments of the momentum, except with unit masses.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocities(&mut self) {
        if S::MASSES.are_unit() {
            return;
        }
        let Emitted {
            step, system, now, ..
        } = &mut self.0;
        for (stage, velocity) in now.velocity.iter_mut().enumerate() {
            let (q, force) = (&now.q[stage], &now.force[stage]);
            if force.dimension() == velocity.dimension() {
                system.velocity(scalar::<W>(step.time), q, force, velocity);
            }
        }
    }

    /// Computes positions `base + h node start + before Σ_j factor_j slope_j`; returns their change.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn positions(
        &mut self,
        count: usize,
        factor: impl Fn(usize, usize) -> f64,
        before: f64,
        of_previous_step: bool,
    ) -> W::Scalar {
        let Emitted {
            step,
            before: previous,
            now,
            settled,
            ..
        } = &mut self.0;
        let sums = Sums {
            count: |_| count,
            term: |stage: usize, j: usize| (j, factor(stage, j)),
            with_low: false,
        };
        let start = match (S::MASSES.are_unit(), settled.start.first()) {
            (false, Some(start)) => start,
            _ => step.p,
        };
        let start = start.as_slice();
        let value = Position::<P, R, W::Scalar> {
            size: step.size,
            factor: before,
            velocity: start,
            method: PhantomData,
        };
        let LaneStages {
            q, velocity, force, ..
        } = &mut **now;
        let slopes = match (of_previous_step, S::MASSES.are_unit()) {
            (true, _) => slopes::<S, W>(previous),
            (false, true) => force,
            (false, false) => velocity,
        };
        relax::<Plain, W>(&sums, q, (step.q, step.q_low), slopes, value)
    }

    /// The positions from the slopes of the previous sweep.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn next(&mut self) -> W::Scalar {
        let h = self.0.step.size;
        if R::COMPENSATED {
            return self.of_increments();
        }
        let columns = Columns::<P>::OF_FORCES;
        let factor = |stage: usize, j: usize| columns[j][stage] * (h * h);
        self.positions(columns.len(), factor, 1.0, false)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of_increments(&mut self) -> W::Scalar {
        let h = self.0.step.size;
        let columns = Columns::<P>::SECOND_ORDER;
        let factor = |stage: usize, j: usize| columns[j][stage];
        self.positions(columns.len(), factor, h, false)
    }

    /// New positions and momenta.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn update(&mut self, Outcome { q, q_low, p, p_low }: Outcome<'_, W>) {
        let Emitted {
            step,
            system,
            settled,
            ..
        } = &mut self.0;
        let (h, count) = (step.size, P::POSITIONS.count);
        let rest = |stage: usize| 1.0 - tableau::<P>().nodes[stage];
        let (forces, slopes) = (&settled.force, slopes::<S, W>(settled));
        let start = match (S::MASSES.are_unit(), settled.start.first()) {
            (false, Some(start)) => start.as_slice(),
            _ => step.p.as_slice(),
        };
        let n = shortest(forces).min(shortest(slopes));
        let n = n.min(step.q.dimension()).min(start.len());
        let size = scalar::<W>(h);
        if R::COMPENSATED {
            let base = (step.p, step.p_low);
            total::<R, P, W>((p, p_low), base, forces, &P::POSITIONS, h);
            // The velocity of the low part of the momentum, stored in the place of the result.
            system.velocity(scalar::<W>(step.time), step.q, step.p_low, q);
            let (base, low) = (step.q.as_slice(), step.q_low.as_slice());
            let (q, q_low) = (q.as_mut_slice(), q_low.as_mut_slice());
            for k in 0..n.min(q.len()) {
                let sum = sum_of_products(None, count, |stage| {
                    (scalar::<W>(rest(stage)), slopes[stage].as_slice()[k])
                });
                let parts = [size * sum, size * start[k]];
                let low = low[k] + size * q[k];
                (q[k], q_low[k]) = add::<R, _>(base[k], low, 2, |part: usize| parts[part]);
            }
            return;
        }
        let zero = scalar::<W>(0.0);
        let (q, p) = (q.as_mut_slice(), p.as_mut_slice());
        let weight = |stage: usize| P::POSITIONS.weights[stage] * h;
        for k in 0..n {
            let kicks = Weighted {
                weight,
                terms: forces,
                k,
            };
            p[k] = add::<Plain, _>(step.p.as_slice()[k], zero, count, kicks).0;
            let weight = |stage: usize| rest(stage) * weight(stage);
            let terms = slopes;
            let mean = add::<Plain, _>(start[k], zero, count, Weighted { weight, terms, k }).0;
            q[k] = size.fused(mean, step.q.as_slice()[k]);
        }
    }
}

impl<P, R, W, S> LaneSweeps<W::Scalar> for SecondOrder<'_, P, R, W, S>
where
    P: StageTableau,
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W, Class = P::Class>,
{
    const STOPS_AT_ROUNDING: bool = !R::COMPENSATED;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn begin(&mut self) {
        let h = self.0.step.size;
        if starts_at_once(&P::POSITIONS) {
            let count = P::POSITIONS.extrapolation.len();
            match R::COMPENSATED {
                true => {
                    let factor = |stage: usize, j: usize| Start::<P>::OF_INCREMENTS[j][stage];
                    self.positions(count, factor, h, true)
                }
                false => {
                    let factor = |stage: usize, j: usize| Start::<P>::OF_FORCES[j][stage];
                    self.positions(count, factor, h * h, true)
                }
            };
            return;
        }
        if P::POSITIONS.extrapolation.is_empty() {
            for force in &mut self.0.now.force {
                force.as_mut_slice().fill(scalar::<W>(0.0));
            }
        } else {
            // A trajectory that takes the step alone needs the stages of the previous step unchanged.
            let stages = &mut self.0;
            for (to, from) in stages.settled.force.iter_mut().zip(&stages.before.force) {
                copy(to, from);
            }
            if !R::COMPENSATED {
                increments::<P, W>(&P::POSITIONS, h, &mut stages.settled.force);
            }
            let columns = P::POSITIONS.extrapolation;
            let (out, vectors) = (&mut stages.now.force, &stages.settled.force);
            transform(out, vectors, |i, j| columns[j][i]);
        }
        self.velocities();
        self.of_increments();
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep(&mut self) -> LaneMovement<W::Scalar> {
        self.0.forces();
        if R::COMPENSATED {
            self.0.scale_forces();
        }
        self.velocities();
        let q = self.next();
        // The change of the positions is used for the momenta, too.
        LaneMovement { q, p: q }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn scales(&self) -> [W::Scalar; 2] {
        [largest(self.0.step.q, &self.0.now.q); 2]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn keep(&mut self, lanes: u32) {
        copy_lanes(lanes, &self.0.now.force, &mut self.0.settled.force);
        if !S::MASSES.are_unit() {
            copy_lanes(lanes, &self.0.now.velocity, &mut self.0.settled.velocity);
        }
    }
}
