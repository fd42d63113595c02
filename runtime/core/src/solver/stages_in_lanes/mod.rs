//! Coupled stages side by side in SIMD lanes.

pub(crate) mod change;
pub(crate) mod in_registers;
pub(crate) mod stages;
pub(crate) mod sums;
pub(crate) mod sweeps;

use crate::contract::{
    Class, Failure, Inside, Outcome, Solver, StageTableau, Step, StepStatistics, Stopping, System,
    SystemInLanes, WarmStart,
};
use crate::number::{Summation, Vector};
use crate::solver::stages_in_lanes::stages::SimdStages;
use crate::solver::stages_in_lanes::sums::{entry, extend};
use crate::solver::stages_in_lanes::sweeps::take;

/// The iteration of [`FixedPoint`](crate::solver::FixedPoint) with the stages side by side in lanes: one evaluation of the
/// system computes two, four or eight stages.
///
/// The system must be generic over the scalar. Long vectors are allowed. [`FixedPoint`](crate::solver::FixedPoint) vectorises along
/// the components instead. Its sums over the stages are slower than sums that have all stages of a component at hand. `--example ratios` of
/// the benchmarks times both for a chain of 1024 particles.
#[derive(Clone, Copy, Debug, Default)]
pub struct SimdFixedPoint;

impl<V, S> Solver<V, S> for SimdFixedPoint
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
        take::<P, R, V, S, false>(step, system, stages, kept, stopping, outcome)
    }

    fn extend<P: StageTableau>(stages: &SimdStages<V, P>, at: Inside<'_, V>, q: &mut V, p: &mut V) {
        let velocity = |stage, k| entry::<P, V>(stages.velocity.as_ref(), stage, k);
        let force = |stage, k| entry::<P, V>(stages.force.as_ref(), stage, k);
        extend::<P, V>(&P::MOMENTA, at, velocity, q);
        extend::<P, V>(&P::POSITIONS, at, force, p);
    }
}

/// [`SimdFixedPoint`] for Hamiltonians that are not separable, with positions and momenta iterated simultaneously.
///
/// A sweep of [`SimdFixedPoint`] evaluates the velocities at the new momenta, after its forces (Gauss–Seidel). Here both are evaluated
/// at the stages of the previous sweep (Jacobi). Velocities and forces do not wait for each other, but more sweeps may be needed. It pays
/// if `∂²H/∂q∂p` is as large as the other second derivatives and evaluations are cheap. If velocity and force have costly parts in common,
/// [`Hamiltonian::slopes`](crate::Hamiltonian::slopes) evaluates them together. The stages are those of [`SimdFixedPoint`] up to rounding.
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
        match P::Class::SEPARABLE {
            true => take::<P, R, V, S, false>(step, system, stages, kept, stopping, outcome),
            false => take::<P, R, V, S, true>(step, system, stages, kept, stopping, outcome),
        }
    }

    fn extend<P: StageTableau>(stages: &SimdStages<V, P>, at: Inside<'_, V>, q: &mut V, p: &mut V) {
        <SimdFixedPoint as Solver<V, S>>::extend::<P>(stages, at, q, p);
    }
}
