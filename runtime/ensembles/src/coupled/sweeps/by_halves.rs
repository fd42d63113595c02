//! Sweeps over positions and momenta.

use super::emitted::Emitted;
use super::{LaneSweeps, Sums, keep, relax};
use symplectic_core::inside::copy;
use symplectic_core::inside::sweeps::{
    BasePlusSum, LaneMovement, Overrelaxed, Starting, extrapolates, starts_at_once,
};
use symplectic_core::simd::Lanes;
use symplectic_core::solver::{EvaluationCounts, StageTableau};
use symplectic_core::system::Class;
use symplectic_core::{Summation, System, Vector};

/// The evaluations of a step.
pub(super) const fn counts<P: StageTableau>() -> EvaluationCounts {
    let (velocities, forces) = (P::MOMENTA.count as u32, P::POSITIONS.count as u32);
    let begin = match (extrapolates::<P>(), P::Class::SEPARABLE) {
        (true, _) => 0,
        (false, true) => velocities,
        (false, false) => velocities + forces,
    };
    EvaluationCounts {
        begin,
        start: 0,
        sweep: velocities + forces,
        finish: 0,
        carried: 0,
    }
}

/// The sweeps of [`SimdFixedPoint`](symplectic_core::solver::SimdFixedPoint), for separable systems.
pub(super) struct GaussSeidel<'a, P, R, W, S>(pub(super) Emitted<'a, P, R, W, S>);

impl<P, R, W, S> LaneSweeps<W::Scalar> for GaussSeidel<'_, P, R, W, S>
where
    P: StageTableau,
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W, Class = P::Class>,
{
    const STOPS_AT_ROUNDING: bool = !R::COMPENSATED;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn begin(&mut self) {
        let stages = &mut self.0;
        if extrapolates::<P>() {
            stages.extrapolate_velocities();
            // The first sweep compares the momenta with those of the previous step.
            for (p, before) in stages.now.p.iter_mut().zip(&stages.before.p) {
                copy(p, before);
            }
        } else {
            stages.fill();
            stages.velocities();
            stages.scale_velocities();
        }
        stages.positions::<R>(true);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep(&mut self) -> LaneMovement<W::Scalar> {
        let stages = &mut self.0;
        stages.forces();
        if R::COMPENSATED {
            stages.scale_forces();
        }
        let p = stages.momenta::<R>(R::COMPENSATED);
        stages.velocities();
        if R::COMPENSATED {
            stages.scale_velocities();
        }
        let q = stages.positions::<R>(R::COMPENSATED);
        LaneMovement { q, p }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn scales(&self) -> [W::Scalar; 2] {
        self.0.scales()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn keep(&mut self, lanes: u32) {
        keep(lanes, self.0.now, self.0.settled);
    }
}

/// The sweeps of [`SimdJacobi`](symplectic_core::solver::SimdJacobi), for systems that are not separable.
pub(super) struct Jacobi<'a, P, R, W, S>(pub(super) Emitted<'a, P, R, W, S>);

impl<P, R, W, S> Jacobi<'_, P, R, W, S>
where
    P: StageTableau,
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W, Class = P::Class>,
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep_by<T: Summation>(&mut self) -> LaneMovement<W::Scalar> {
        let stages = &mut self.0;
        stages.slopes();
        if R::COMPENSATED {
            stages.scale_forces();
            stages.scale_velocities();
        }
        LaneMovement {
            p: stages.momenta::<T>(R::COMPENSATED),
            q: stages.positions::<T>(R::COMPENSATED),
        }
    }

    /// Predicts the stages from the increments of the previous step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn start(&mut self) {
        let Emitted {
            step, before, now, ..
        } = &mut self.0;
        let factor = |entry: f64| match P::INCREMENTS {
            true => entry,
            false => entry * step.size,
        };
        let sums = Sums {
            count: |_| P::MOMENTA.columns.len(),
            term: |stage: usize, j: usize| (j, factor(Starting::<P>::MOMENTA[j][stage])),
            with_low: R::COMPENSATED,
        };
        relax::<R, W>(
            &sums,
            &mut now.p,
            (step.p, step.p_low),
            &before.force,
            BasePlusSum,
        );
        let sums = Sums {
            count: |_| P::POSITIONS.columns.len(),
            term: |stage: usize, j: usize| (j, factor(Starting::<P>::POSITIONS[j][stage])),
            with_low: R::COMPENSATED,
        };
        let base = (step.q, step.q_low);
        relax::<R, W>(&sums, &mut now.q, base, &before.velocity, BasePlusSum);
    }
}

impl<P, R, W, S> LaneSweeps<W::Scalar> for Jacobi<'_, P, R, W, S>
where
    P: StageTableau,
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W, Class = P::Class>,
{
    const STOPS_AT_ROUNDING: bool = !R::COMPENSATED;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn begin(&mut self) {
        if starts_at_once(&P::POSITIONS) && starts_at_once(&P::MOMENTA) {
            self.start();
        } else if extrapolates::<P>() {
            let stages = &mut self.0;
            stages.extrapolate_velocities();
            stages.extrapolate_forces();
            stages.momenta::<R>(true);
            stages.positions::<R>(true);
        } else {
            self.0.fill();
            self.sweep();
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep(&mut self) -> LaneMovement<W::Scalar> {
        self.sweep_by::<R>()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn overrelaxed_sweep(&mut self) -> LaneMovement<W::Scalar> {
        self.sweep_by::<Overrelaxed<R>>()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn scales(&self) -> [W::Scalar; 2] {
        self.0.scales()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn keep(&mut self, lanes: u32) {
        keep(lanes, self.0.now, self.0.settled);
    }
}
