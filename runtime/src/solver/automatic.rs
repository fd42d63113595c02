//! The default solver, for systems that are generic over the scalar.

use core::fmt;
use core::marker::PhantomData;

use crate::error::Quantity;
use crate::method::{
    Failure, Inside, Outcome, Solver, StageStorage, StageTableau, Step, StepStatistics, Stopping,
    WarmStart,
};
#[cfg(feature = "alloc")]
use crate::method::{LaneStep, RunTimeStages, StageVisit};
use crate::number::Lanes;
use crate::number::registers::{self, Avx2, Avx512, Work};
use crate::number::vector::{same, same_mut};
use crate::number::{Scalar, Summation, Vector, Visit};
use crate::solver::FixedPoint;
use crate::solver::fixed_point::by_stages;
#[cfg(feature = "alloc")]
use crate::solver::in_lanes;
use crate::solver::nystrom::{self, NystromStages, nystrom};
#[cfg(feature = "alloc")]
use crate::solver::run_time::by_rows;
use crate::solver::simd::in_registers::{Wide, Widest};
use crate::solver::simd::sweeps;
use crate::system::{Class, OverEveryScalar, System, SystemInLanes};

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
    /// The same in registers of AVX2.
    InAvx2(Avx2, NystromStages<S::Doubles, Wide<P>>),
    /// The same in registers of AVX-512.
    InAvx512(Avx512, NystromStages<S::Doubles, Widest<P>>),
    /// Stages of other scalars, one by one.
    OneByOne(P::Stages<V>),
}

impl<V: Vector, S: OverEveryScalar<V>, P: StageTableau> Clone for AutomaticStages<V, S, P> {
    fn clone(&self) -> Self {
        match self {
            Self::InLanes(stages) => Self::InLanes(stages.clone()),
            Self::InAvx2(avx2, stages) => Self::InAvx2(*avx2, stages.clone()),
            Self::InAvx512(avx512, stages) => Self::InAvx512(*avx512, stages.clone()),
            Self::OneByOne(stages) => Self::OneByOne(stages.clone()),
        }
    }
}

impl<V: Vector, S: OverEveryScalar<V>, P: StageTableau> fmt::Debug for AutomaticStages<V, S, P> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("AutomaticStages")
    }
}

/// Whether these lanes may be in registers that the program has to find: four doubles or more, of a system that is inlined there.
const fn may_be_wide<V: Vector, S: System<V>, P: StageTableau>() -> bool {
    registers::UNKNOWN && S::INLINED && P::Lanes::WIDTH >= 4
}

/// Whether these lanes fill a register of AVX-512.
const fn may_be_widest<V: Vector, S: System<V>, P: StageTableau>() -> bool {
    may_be_wide::<V, S, P>() && P::Lanes::WIDTH >= 8
}

/// The same expression for the stages of every kind.
macro_rules! with_stages {
    ($memory:expr, $stages:ident => $result:expr) => {
        match $memory {
            AutomaticStages::InLanes($stages) => $result,
            AutomaticStages::InAvx2(_, $stages) => $result,
            AutomaticStages::InAvx512(_, $stages) => $result,
            AutomaticStages::OneByOne($stages) => $result,
        }
    };
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
            if may_be_widest::<V, S, P>()
                && let Some(avx512) = Avx512::detect()
            {
                return Self::InAvx512(avx512, NystromStages::like(prototype));
            }
            if may_be_wide::<V, S, P>()
                && let Some(avx2) = Avx2::detect()
            {
                return Self::InAvx2(avx2, NystromStages::like(prototype));
            }
            Self::InLanes(NystromStages::like(prototype))
        } else {
            Self::OneByOne(StageStorage::like(prototype))
        }
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        with_stages!(self, stages => stages.words(visit))
    }

    #[cfg(feature = "alloc")]
    fn stages(&mut self, visit: &mut StageVisit<'_>) {
        with_stages!(self, stages => stages.stages(visit));
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        with_stages!(self, stages => stages.non_finite())
    }

    fn non_finite_force(&self) -> Option<usize> {
        with_stages!(self, stages => stages.non_finite_force())
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        with_stages!(self, stages => stages.mismatch(dimension))
    }
}

/// A step with coupled stages in lanes.
struct InLanes<'a, V: Vector, S, P: StageTableau, R> {
    step: &'a Step<'a, V>,
    system: &'a S,
    stages: &'a mut NystromStages<V, P>,
    kept: WarmStart,
    stopping: Stopping,
    outcome: Outcome<'a, V>,
    sums: PhantomData<R>,
}

impl<V, S, P, R> Work for InLanes<'_, V, S, P, R>
where
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
    P: StageTableau,
    R: Summation,
{
    type Output = Result<StepStatistics, Failure>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Self::Output {
        let Self {
            step,
            system,
            stages,
            kept,
            stopping,
            outcome,
            ..
        } = self;
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
        let step: &Step<'_, S::Doubles> = &step.same().expect(NO_DOUBLES);
        let outcome: Outcome<'_, S::Doubles> = outcome.same().expect(NO_DOUBLES);
        macro_rules! in_lanes {
            ($plan:ty, $stages:ident) => {
                InLanes::<S::Doubles, S, $plan, R> {
                    step,
                    system,
                    stages: $stages,
                    kept,
                    stopping,
                    outcome,
                    sums: PhantomData,
                }
            };
        }
        // Constant conditions: other systems and methods compile without this code.
        match memory {
            AutomaticStages::InLanes(stages) => in_lanes!(P, stages).run(),
            AutomaticStages::InAvx2(avx2, stages) if may_be_wide::<V, S, P>() => {
                avx2.run(in_lanes!(Wide<P>, stages))
            }
            AutomaticStages::InAvx512(avx512, stages) if may_be_widest::<V, S, P>() => {
                avx512.run(in_lanes!(Widest<P>, stages))
            }
            _ => unreachable!("{NO_DOUBLES}"),
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
        macro_rules! in_lanes {
            ($plan:ty, $stages:ident) => {{
                let at = at.same::<S::Doubles>().expect(NO_DOUBLES);
                let (q, p) = (
                    same_mut(q).expect(NO_DOUBLES),
                    same_mut(p).expect(NO_DOUBLES),
                );
                nystrom::extend::<$plan, S::Doubles, S>($stages, at, q, p);
            }};
        }
        match memory {
            AutomaticStages::InLanes(stages) => in_lanes!(P, stages),
            AutomaticStages::InAvx2(_, stages) => in_lanes!(Wide<P>, stages),
            AutomaticStages::InAvx512(_, stages) => in_lanes!(Widest<P>, stages),
            AutomaticStages::OneByOne(stages) => {
                <FixedPoint as Solver<V, S>>::extend::<P>(stages, at, q, p);
            }
        }
    }
}
