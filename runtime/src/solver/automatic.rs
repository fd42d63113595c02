//! The default solver, for systems that are generic over the scalar.

use core::fmt;

use crate::error::Quantity;
use crate::method::{
    Failure, Inside, Outcome, Solver, StageStorage, StageTableau, Step, StepStatistics, Stopping,
    WarmStart,
};
#[cfg(feature = "alloc")]
use crate::method::{LaneStep, RunTimeStages, StageVisit};
#[cfg(feature = "alloc")]
use crate::number::Lanes;
use crate::number::vector::{same, same_mut};
use crate::number::{Scalar, Summation, Vector, Visit};
use crate::solver::FixedPoint;
use crate::solver::fixed_point::by_stages;
#[cfg(feature = "alloc")]
use crate::solver::in_lanes;
use crate::solver::nystrom::{self, NystromStages, nystrom};
#[cfg(feature = "alloc")]
use crate::solver::run_time::by_rows;
use crate::solver::simd::sweeps;
use crate::system::{Class, OverEveryScalar, System};

/// The fastest fixed-point iteration for a method, a system and its scalar. It is the default of an
/// [`Integrator`](crate::Integrator).
///
/// | Scalar | Hamiltonian | Iteration |
/// |---|---|---|
/// | f64 | separable, velocity linear in the momentum | positions only (Nyström form), stages in SIMD lanes |
/// | f64 | separable | [`SimdFixedPoint`](crate::solver::SimdFixedPoint) |
/// | f64 | other | [`SimdJacobi`](crate::solver::SimdJacobi) |
/// | other | any | [`FixedPoint`] |
///
/// When the integrator is constructed, it tests whether the velocity is linear in the momentum and independent of time.
#[derive(Clone, Copy, Debug, Default)]
pub struct Automatic;

/// The memory of [`Automatic`].
pub enum AutomaticStages<V: Vector, S: OverEveryScalar<V>, P: StageTableau> {
    /// Stages of doubles, in lanes.
    InLanes(NystromStages<S::Doubles, P>),
    /// Stages of other scalars, one by one.
    OneByOne(P::Stages<V>),
}

impl<V: Vector, S: OverEveryScalar<V>, P: StageTableau> Clone for AutomaticStages<V, S, P> {
    fn clone(&self) -> Self {
        match self {
            Self::InLanes(stages) => Self::InLanes(stages.clone()),
            Self::OneByOne(stages) => Self::OneByOne(stages.clone()),
        }
    }
}

impl<V: Vector, S: OverEveryScalar<V>, P: StageTableau> fmt::Debug for AutomaticStages<V, S, P> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("AutomaticStages")
    }
}

/// Message of a failure that is possible only if a scalar claims to be `f64` but is not.
const NO_DOUBLES: &str = "vectors over f64 are those of the system over f64";

impl<V: Vector, S: OverEveryScalar<V>, P: StageTableau> StageStorage<V>
    for AutomaticStages<V, S, P>
{
    fn like(prototype: &V) -> Self {
        // A constant condition: doubles compile without the other branch, and other scalars without code for lanes.
        if V::Scalar::IS_DOUBLE {
            let prototype = same::<V, S::Doubles>(prototype).expect(NO_DOUBLES);
            Self::InLanes(NystromStages::like(prototype))
        } else {
            Self::OneByOne(StageStorage::like(prototype))
        }
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        match self {
            Self::InLanes(stages) => stages.words(visit),
            Self::OneByOne(stages) => stages.words(visit),
        }
    }

    #[cfg(feature = "alloc")]
    fn stages(&mut self, visit: &mut StageVisit<'_>) {
        if let Self::InLanes(stages) = self {
            stages.stages(visit);
        }
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        match self {
            Self::InLanes(stages) => stages.non_finite(),
            Self::OneByOne(stages) => stages.non_finite(),
        }
    }

    fn non_finite_force(&self) -> Option<usize> {
        match self {
            Self::InLanes(stages) => stages.non_finite_force(),
            Self::OneByOne(stages) => stages.non_finite_force(),
        }
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        match self {
            Self::InLanes(stages) => stages.mismatch(dimension),
            Self::OneByOne(stages) => stages.mismatch(dimension),
        }
    }
}

impl<V: Vector, S: OverEveryScalar<V>> Solver<V, S> for Automatic {
    type Memory<P: StageTableau> = AutomaticStages<V, S, P>;

    const TRIES_LINEARITY: bool = V::Scalar::IS_DOUBLE;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<P, R>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Self::Memory<P>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>
    where
        P: StageTableau,
        R: Summation,
        S: System<V, Class = P::Class>,
    {
        // A constant condition, as above.
        if !V::Scalar::IS_DOUBLE {
            let AutomaticStages::OneByOne(stages) = memory else {
                unreachable!("{NO_DOUBLES}");
            };
            return by_stages::<P, R, V, S>(step, system, stages, kept, stopping, outcome);
        }
        let AutomaticStages::InLanes(stages) = memory else {
            unreachable!("{NO_DOUBLES}");
        };
        let step: &Step<'_, S::Doubles> = &step.same().expect(NO_DOUBLES);
        let outcome: Outcome<'_, S::Doubles> = outcome.same().expect(NO_DOUBLES);
        if !P::Class::SEPARABLE {
            let stages = &mut stages.lanes;
            sweeps::take::<P, R, _, _, true>(step, system, stages, kept, stopping, outcome)
        } else if step.linear_velocity {
            nystrom::<P, R, _, _>(step, system, stages, kept, stopping, outcome)
        } else {
            let stages = &mut stages.lanes;
            sweeps::take::<P, R, _, _, false>(step, system, stages, kept, stopping, outcome)
        }
    }

    #[cfg(feature = "alloc")]
    fn take_at_run_time<C, R>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut RunTimeStages<V, C>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>
    where
        C: Class,
        R: Summation,
        S: System<V, Class = C>,
    {
        by_rows::<C, R, V, S>(step, system, memory, kept, stopping, outcome)
    }

    #[cfg(feature = "alloc")]
    fn goes_in_lanes() -> bool {
        V::Scalar::IS_DOUBLE
    }

    #[cfg(feature = "alloc")]
    #[inline]
    fn lane_step<P, R, W, J>() -> Option<LaneStep<W, J>>
    where
        P: StageTableau,
        R: Summation,
        W: Vector<Scalar: Lanes>,
        J: System<W, Class = P::Class>,
    {
        Some(in_lanes::take::<P, R, W, J>)
    }

    #[cfg(feature = "alloc")]
    #[inline]
    fn lane_step_at_run_time<C, R, W, J>() -> Option<LaneStep<W, J>>
    where
        C: Class,
        R: Summation,
        W: Vector<Scalar: Lanes>,
        J: System<W, Class = C>,
    {
        Some(in_lanes::take_at_run_time::<C, R, W, J>)
    }

    fn extend<P: StageTableau>(memory: &Self::Memory<P>, at: Inside<'_, V>, q: &mut V, p: &mut V) {
        match memory {
            AutomaticStages::InLanes(stages) => {
                let at = at.same::<S::Doubles>().expect(NO_DOUBLES);
                let (q, p) = (
                    same_mut(q).expect(NO_DOUBLES),
                    same_mut(p).expect(NO_DOUBLES),
                );
                nystrom::extend::<P, S::Doubles, S>(stages, at, q, p);
            }
            AutomaticStages::OneByOne(stages) => {
                <FixedPoint as Solver<V, S>>::extend::<P>(stages, at, q, p);
            }
        }
    }
}
