//! Jacobi sweeps for systems that are not separable: positions and momenta are iterated simultaneously.

use core::marker::PhantomData;

use crate::error::Quantity;
use crate::method::{
    EvaluationCounts, Failure, HalfTableau, Inside, Outcome, Solver, StageTableau, Step,
    StepStatistics, Stopping, WarmStart,
};
use crate::number::{Summation, Vector};
use crate::solver::SimdFixedPoint;
use crate::solver::convergence::{Sweeps, settle};
use crate::solver::predictor::{Starting, StartingColumns, starts_at_once};
use crate::solver::simd::change::LaneMovement;
use crate::solver::simd::gauss_seidel::{ByLanes, extrapolates, gauss_seidel};
use crate::solver::simd::stages::SimdStages;
use crate::solver::simd::sums::{Sums, extrapolate, fill, sum, totals, values};
use crate::system::SystemInLanes;
use crate::system::{Class, System};

/// [`SimdFixedPoint`] for Hamiltonians that are not separable, with positions and momenta iterated simultaneously.
///
/// A sweep of [`SimdFixedPoint`] evaluates the velocities at the new momenta, after its forces (Gauss–Seidel). Here both are evaluated
/// at the stages of the previous sweep (Jacobi). Neither half waits for the other, but more sweeps may be needed.
/// It pays if `∂²H/∂q∂p` is as large as the other second derivatives and evaluations are cheap. If velocity and force have
/// costly parts in common, [`Hamiltonian::slopes`](crate::Hamiltonian::slopes) evaluates them together.
/// The stages are those of [`SimdFixedPoint`] up to rounding.
///
/// Separable systems are solved as by [`SimdFixedPoint`]: for them, Jacobi sweeps would double the number of sweeps.
#[derive(Clone, Copy, Debug, Default)]
pub struct SimdJacobi;

impl<V, S> Solver<V, S> for SimdJacobi
where
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    type Memory<P: StageTableau> = SimdStages<V, P>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<P, R>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut SimdStages<V, P>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>
    where
        P: StageTableau,
        R: Summation,
        S: System<V, Class = P::Class>,
    {
        jacobi::<P, R, V, S>(step, system, stages, kept, stopping, outcome)
    }

    fn extend<P: StageTableau>(stages: &SimdStages<V, P>, at: Inside<'_, V>, q: &mut V, p: &mut V) {
        <SimdFixedPoint as Solver<V, S>>::extend::<P>(stages, at, q, p);
    }
}

/// [`SimdJacobi::take`](Solver::take)
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn jacobi<P, R, V, S>(
    step: &Step<'_, V>,
    system: &S,
    stages: &mut SimdStages<V, P>,
    kept: WarmStart,
    stopping: Stopping,
    outcome: Outcome<'_, V>,
) -> Result<StepStatistics, Failure>
where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    if P::Class::SEPARABLE {
        return gauss_seidel::<P, R, V, S>(step, system, stages, kept, stopping, outcome);
    }
    let mut sweeps = Halves::<P, R, V, S>(ByLanes {
        step,
        system,
        stages: &mut *stages,
        sums: PhantomData,
    });
    let work = settle::<P::Class, f64, _>(&mut sweeps, kept, stopping)?;
    if !R::COMPENSATED {
        sweeps.0.increments();
    }
    totals::<R, P, V>(step, stages, outcome);
    Ok(work)
}

/// Stages whose positions and momenta are iterated simultaneously.
struct Halves<'a, P: StageTableau, R, V: Vector, S>(ByLanes<'a, P, R, V, S>);

impl<P, R, V, S> Halves<'_, P, R, V, S>
where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    /// Whether force and velocity of each stage are evaluated at the same time.
    const AT_ONE_TIME: bool = are_at_one_time::<P>();

    /// Computes new stages from the evaluations; returns their change.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stages(&mut self) -> LaneMovement<P::Lanes> {
        if R::COMPENSATED {
            self.0.increments();
        }
        LaneMovement {
            p: self.0.momenta(R::COMPENSATED),
            q: self.0.positions(R::COMPENSATED),
        }
    }

    /// Predicts the stages from the increments of the previous step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn start(&mut self) {
        let (step, stages) = (self.0.step, &mut *self.0.stages);
        let factor = (!P::INCREMENTS).then_some(step.size);
        let sums = |half: &HalfTableau, columns: &'static StartingColumns| Sums {
            count: half.columns.len(),
            column: move |j: usize| &columns[j][..],
            factor: move |_| factor,
            with_low: R::COMPENSATED,
            beyond: false,
        };
        let momenta = sums(&P::MOMENTA, Starting::<P>::MOMENTA);
        let (base, forces) = ((step.p, step.p_low), stages.force.as_ref());
        values::<P, V>(&momenta, stages.p.as_mut(), base, forces, sum::<P>);
        let positions = sums(&P::POSITIONS, Starting::<P>::POSITIONS);
        let (base, velocities) = ((step.q, step.q_low), stages.velocity.as_ref());
        values::<P, V>(&positions, stages.q.as_mut(), base, velocities, sum::<P>);
    }
}

/// Whether force and velocity of each stage are evaluated at the same time.
pub(crate) const fn are_at_one_time<P: StageTableau>() -> bool {
    same(P::POSITIONS.times, P::MOMENTA.times)
}

/// Whether two lists are equal.
const fn same(left: &[f64], right: &[f64]) -> bool {
    let mut i = 0;
    while i < left.len() && i < right.len() && left[i] == right[i] {
        i += 1;
    }
    i == left.len() && i == right.len()
}

impl<P, R, V, S> Sweeps for Halves<'_, P, R, V, S>
where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    type Movement = LaneMovement<P::Lanes>;

    const STOPS_AT_ROUNDING: bool = !R::COMPENSATED;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluations(&self) -> EvaluationCounts {
        let both = (P::POSITIONS.count + P::MOMENTA.count) as u32;
        let (begin, start) = if extrapolates::<P>() {
            (0, both)
        } else {
            (both, 0)
        };
        EvaluationCounts {
            begin,
            start,
            ..self.0.evaluations()
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn time(&self) -> f64 {
        self.0.time()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn begin(&mut self, kept: WarmStart) {
        if kept.stages && starts_at_once(&P::POSITIONS) && starts_at_once(&P::MOMENTA) {
            self.start();
            return;
        }
        if kept.stages && extrapolates::<P>() {
            extrapolate::<P, V>(&P::MOMENTA, self.0.stages.velocity.as_mut());
            extrapolate::<P, V>(&P::POSITIONS, self.0.stages.force.as_mut());
            self.0.momenta(true);
            self.0.positions(true);
            return;
        }
        fill::<P, V>(self.0.stages.q.as_mut(), self.0.step.q);
        fill::<P, V>(self.0.stages.p.as_mut(), self.0.step.p);
        self.sweep();
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn non_finite(&self) -> Option<(Quantity, usize)> {
        self.0.non_finite()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn non_finite_force(&self) -> Option<usize> {
        self.0.non_finite_force()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep(&mut self) -> LaneMovement<P::Lanes> {
        if Self::AT_ONE_TIME {
            self.0.slopes();
        } else {
            self.0.forces();
            self.0.velocities();
        }
        self.stages()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn overrelaxed_sweep(&mut self) -> LaneMovement<P::Lanes> {
        Halves(self.0.beyond()).sweep()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn scales(&self, movement: &Self::Movement) -> [f64; 2] {
        self.0.scales(movement)
    }
}
