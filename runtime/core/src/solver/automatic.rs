//! The default solver, for systems that are generic over the scalar.

#[cfg(feature = "alloc")]
use alloc::sync::Arc;
use core::fmt;
use core::marker::PhantomData;

use crate::contract::{
    Class, Failure, Inside, Outcome, OverEveryScalar, Solver, StageStorage, StageTableau, Step,
    StepStatistics, Stopping, System, SystemInLanes, WarmStart,
};
#[cfg(feature = "alloc")]
use crate::contract::{CoupledRows, StageVisit};
use crate::error::Quantity;
use crate::number::Lanes;
use crate::number::registers::{self, Avx2, Avx512, Work};
use crate::number::vector::{same, same_mut};
use crate::number::{Scalar, Summation, Vector, Visit, WideF64x4, WideF64x8, WidestF64x8};
use crate::solver::FixedPoint;
use crate::solver::fixed_point::by_stages;
use crate::solver::nystrom::{self, NystromStages, nystrom};
use crate::solver::stages_in_lanes::in_registers::InRegisters;
use crate::solver::stages_in_lanes::sweeps;

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
pub struct AutomaticStages<V: Vector, S: OverEveryScalar<V>, P: StageTableau>(Kind<V, S, P>);

/// The stages in the lanes for which the program is compiled, in wider ones, or one by one.
enum Kind<V: Vector, S: OverEveryScalar<V>, P: StageTableau> {
    /// Doubles, in lanes.
    InLanes(NystromStages<S::Doubles, P>),
    /// Four doubles in a register of AVX2.
    Four(Avx2, Wide<V, S, P, WideF64x4>),
    /// Eight doubles in two registers of AVX2.
    TwiceFour(Avx2, Wide<V, S, P, WideF64x8>),
    /// Eight doubles in a register of AVX-512.
    Eight(Avx512, Wide<V, S, P, WidestF64x8>),
    /// Other scalars.
    OneByOne(P::Stages<V>),
}

/// Stages in lanes `L`.
type Wide<V, S, P, L> = NystromStages<<S as OverEveryScalar<V>>::Doubles, InRegisters<P, L>>;

impl<V: Vector, S: OverEveryScalar<V>, P: StageTableau> Clone for AutomaticStages<V, S, P> {
    fn clone(&self) -> Self {
        Self(match &self.0 {
            Kind::InLanes(stages) => Kind::InLanes(stages.clone()),
            Kind::Four(avx2, stages) => Kind::Four(*avx2, stages.clone()),
            Kind::TwiceFour(avx2, stages) => Kind::TwiceFour(*avx2, stages.clone()),
            Kind::Eight(avx512, stages) => Kind::Eight(*avx512, stages.clone()),
            Kind::OneByOne(stages) => Kind::OneByOne(stages.clone()),
        })
    }
}

impl<V: Vector, S: OverEveryScalar<V>, P: StageTableau> fmt::Debug for AutomaticStages<V, S, P> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self.0 {
            Kind::InLanes(_) => "InLanes",
            Kind::Four(..) => "Four",
            Kind::TwiceFour(..) => "TwiceFour",
            Kind::Eight(..) => "Eight",
            Kind::OneByOne(_) => "OneByOne",
        })
    }
}

/// Whether the stages are this many doubles in lanes, and may be in registers that the program detects at run time.
const fn may_be_wide<V: Vector, S: System<V>, P: StageTableau>(width: usize) -> bool {
    registers::UNKNOWN && S::INLINED && P::Lanes::WIDTH == width
}

/// The same expression for the stages of every kind.
macro_rules! with_stages {
    ($memory:expr, $stages:ident => $result:expr) => {
        match $memory {
            Kind::InLanes($stages) => $result,
            Kind::Four(_, $stages) => $result,
            Kind::TwiceFour(_, $stages) => $result,
            Kind::Eight(_, $stages) => $result,
            Kind::OneByOne($stages) => $result,
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
            let kind = if const { may_be_wide::<V, S, P>(8) }
                && let Some(avx512) = Avx512::detect()
            {
                Kind::Eight(avx512, NystromStages::like(prototype))
            } else if const { may_be_wide::<V, S, P>(8) }
                && let Some(avx2) = Avx2::detect()
            {
                Kind::TwiceFour(avx2, NystromStages::like(prototype))
            } else if const { may_be_wide::<V, S, P>(4) }
                && let Some(avx2) = Avx2::detect()
            {
                Kind::Four(avx2, NystromStages::like(prototype))
            } else {
                Kind::InLanes(NystromStages::like(prototype))
            };
            Self(kind)
        } else {
            Self(Kind::OneByOne(StageStorage::like(prototype)))
        }
    }

    fn anew(&self, prototype: &V) -> Self {
        match &self.0 {
            // A constant condition, again.
            Kind::OneByOne(stages) if P::AT_RUN_TIME => {
                Self(Kind::OneByOne(stages.anew(prototype)))
            }
            _ => Self::like(prototype),
        }
    }

    #[cfg(feature = "alloc")]
    fn rows(&self) -> Option<&Arc<CoupledRows>> {
        match &self.0 {
            Kind::OneByOne(stages) => stages.rows(),
            _ => None,
        }
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        with_stages!(&mut self.0, stages => stages.words(visit));
    }

    fn show_words(&self, visit: &mut Visit<'_>) {
        with_stages!(&self.0, stages => stages.show_words(visit));
    }

    #[cfg(feature = "alloc")]
    fn stages(&mut self, visit: &mut StageVisit<'_>) {
        with_stages!(&mut self.0, stages => stages.stages(visit));
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        with_stages!(&self.0, stages => stages.non_finite())
    }

    fn non_finite_force(&self) -> Option<usize> {
        with_stages!(&self.0, stages => stages.non_finite_force())
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        with_stages!(&self.0, stages => stages.mismatch(dimension))
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

    fn memory<P: StageTableau>(plan: &P, prototype: &V) -> Self::Memory<P> {
        match P::AT_RUN_TIME {
            true => AutomaticStages(Kind::OneByOne(plan.stages(prototype))),
            false => StageStorage::like(prototype),
        }
    }

    const IS_AUTOMATIC: bool = true;

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
        if P::AT_RUN_TIME || !V::Scalar::IS_DOUBLE {
            let Kind::OneByOne(stages) = &mut memory.0 else {
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
        match &mut memory.0 {
            Kind::InLanes(stages) => in_lanes!(P, stages).run(),
            Kind::Four(avx2, stages) if const { may_be_wide::<V, S, P>(4) } => {
                avx2.run(in_lanes!(InRegisters<P, WideF64x4>, stages))
            }
            Kind::TwiceFour(avx2, stages) if const { may_be_wide::<V, S, P>(8) } => {
                avx2.run(in_lanes!(InRegisters<P, WideF64x8>, stages))
            }
            Kind::Eight(avx512, stages) if const { may_be_wide::<V, S, P>(8) } => {
                avx512.run(in_lanes!(InRegisters<P, WidestF64x8>, stages))
            }
            _ => unreachable!("{NO_DOUBLES}"),
        }
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
        match &memory.0 {
            Kind::InLanes(stages) => in_lanes!(P, stages),
            Kind::Four(_, stages) => in_lanes!(InRegisters<P, WideF64x4>, stages),
            Kind::TwiceFour(_, stages) => in_lanes!(InRegisters<P, WideF64x8>, stages),
            Kind::Eight(_, stages) => in_lanes!(InRegisters<P, WidestF64x8>, stages),
            Kind::OneByOne(stages) => {
                <FixedPoint as Solver<V, S>>::extend::<P>(stages, at, q, p);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::string::{String, ToString};
    use std::{format, vec, vec::Vec};

    use nalgebra::Vector2;

    use super::*;
    use crate::contract::Method;
    use crate::method::Coupled;
    use crate::number::{Compensated, Plain};
    use crate::solver::nystrom::NystromStages;

    symplectic::tableau! {
        Gauss2 { basis: polynomial(2), nodes: gauss(2) }
        Gauss4 { basis: polynomial(4), nodes: gauss(4) }
        Gauss8 { basis: polynomial(8), nodes: gauss(8) }
    }
    symplectic::hamiltonian! { Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q| }
    symplectic::hamiltonian! { Turning q: [2], p: [2]; H = |p|^2/2 - 1/|q| + q[0] p[1] - sin(q[1]) p[0] }

    /// The stages of a plan.
    trait StagesOf {
        type Stages: StageTableau;
    }

    impl<P: StageTableau> StagesOf for Coupled<P> {
        type Stages = P;
    }

    type Separable<M> = <<M as Method>::Separable as StagesOf>::Stages;
    type General<M> = <<M as Method>::General as StagesOf>::Stages;

    /// The end of twenty steps, as bits.
    fn end<R, S, P>(system: &S, mut memory: AutomaticStages<Vector2<f64>, S, P>) -> Vec<u64>
    where
        R: Summation,
        P: StageTableau,
        S: OverEveryScalar<Vector2<f64>> + System<Vector2<f64>, Class = P::Class>,
    {
        let (mut q, mut p) = (Vector2::new(0.6, 0.1), Vector2::new(-0.2, 1.1));
        let (mut q_low, mut p_low) = (Vector2::zeros(), Vector2::zeros());
        let mut kept = WarmStart::default();
        for number in 0..20 {
            let step = Step {
                time: 0.1 * f64::from(number),
                size: 0.1,
                q: &q.clone(),
                q_low: &q_low.clone(),
                p: &p.clone(),
                p_low: &p_low.clone(),
                linear_velocity: P::Class::SEPARABLE,
            };
            let outcome = Outcome {
                q: &mut q,
                q_low: &mut q_low,
                p: &mut p,
                p_low: &mut p_low,
            };
            let stopping = Stopping::DEFAULT;
            let taken = <Automatic as Solver<_, S>>::take::<P, R>(
                &step,
                system,
                &mut memory,
                kept,
                stopping,
                outcome,
            );
            kept.scales = taken.expect("the stages converge").scales;
            kept.stages = true;
        }
        let all = [q, q_low, p, p_low];
        all.iter().flatten().map(|x| x.to_bits()).collect()
    }

    /// The kinds of stages that this processor can have; each ends with the bits of the lanes for which the program is compiled.
    fn kinds<S, P>(system: &S) -> Vec<String>
    where
        P: StageTableau,
        S: OverEveryScalar<Vector2<f64>, Doubles = Vector2<f64>>
            + System<Vector2<f64>, Class = P::Class>,
    {
        let zero = Vector2::zeros();
        let found: AutomaticStages<_, S, P> = StageStorage::like(&zero);
        let mut kinds = vec![found];
        // Only if they are used at all: with the feature `fma` the lanes of the program have other bits.
        if registers::UNKNOWN
            && P::Lanes::WIDTH == 8
            && let Some(avx2) = Avx2::detect()
        {
            kinds.push(AutomaticStages(Kind::TwiceFour(
                avx2,
                StageStorage::like(&zero),
            )));
        }
        let narrow = || AutomaticStages(Kind::InLanes(NystromStages::like(&zero)));
        let plain = end::<Plain, S, P>(system, narrow());
        let compensated = end::<Compensated, S, P>(system, narrow());
        let mut names = Vec::new();
        for memory in kinds {
            names.push(format!("{memory:?}"));
            assert_eq!(
                end::<Plain, S, P>(system, memory.clone()),
                plain,
                "{memory:?}"
            );
            let name = format!("{memory:?}");
            assert_eq!(
                end::<Compensated, S, P>(system, memory),
                compensated,
                "{name}"
            );
        }
        names
    }

    #[test]
    fn the_widest_registers_are_used_and_all_give_the_same_bits() {
        let (avx2, avx512) = match registers::UNKNOWN {
            true => (Avx2::detect().is_some(), Avx512::detect().is_some()),
            false => (false, false),
        };
        let four = if avx2 { "Four" } else { "InLanes" };
        let eight = match (avx2, avx512) {
            (_, true) => "Eight",
            (true, false) => "TwiceFour",
            (false, false) => "InLanes",
        };
        let first = |names: Vec<String>| names.first().map(ToString::to_string);
        for (names, expected) in [
            (kinds::<_, Separable<Gauss2>>(&Kepler), "InLanes"),
            (kinds::<_, Separable<Gauss4>>(&Kepler), four),
            (kinds::<_, Separable<Gauss8>>(&Kepler), eight),
            (kinds::<_, General<Gauss4>>(&Turning), four),
            (kinds::<_, General<Gauss8>>(&Turning), eight),
        ] {
            assert_eq!(first(names).as_deref(), Some(expected));
        }
    }
}
