//! Coupled stages in lanes of other registers.

use core::fmt::Debug;
use core::marker::PhantomData;

use crate::contract::{
    Decoupling, EvaluationCounts, HalfTableau, Outcome, SecondOrderTableau, StagePlan,
    StageTableau, Step, StoredEvaluations, System, SystemLanes, WarmStart,
};
use crate::number::{Summation, Vector};

/// The stages of a method `P` in lanes `L`, as many as the method has.
pub struct InRegisters<P, L>(PhantomData<(P, L)>);

impl<P: StagePlan, L> StagePlan for InRegisters<P, L> {
    type Class = P::Class;
    type Stages<V: Vector> = P::Stages<V>;

    const EVALUATIONS: EvaluationCounts = P::EVALUATIONS;

    fn begin<R: Summation, V: Vector, S: System<V, Class = Self::Class>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut Self::Stages<V>,
        kept: WarmStart,
    ) {
        P::begin::<R, V, S>(step, system, stages, kept);
    }

    fn finish<R: Summation, V: Vector, S: System<V, Class = Self::Class>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut Self::Stages<V>,
        kept: WarmStart,
        outcome: Outcome<'_, V>,
    ) {
        P::finish::<R, V, S>(step, system, stages, kept, outcome);
    }
}

impl<P: StageTableau, L: SystemLanes> StageTableau for InRegisters<P, L> {
    type Lanes = L;
    type Groups<T: Debug> = P::Groups<T>;

    const INCREMENTS: bool = P::INCREMENTS;
    const POSITIONS: HalfTableau = P::POSITIONS;
    const MOMENTA: HalfTableau = P::MOMENTA;
    const SECOND_ORDER: Option<SecondOrderTableau> = P::SECOND_ORDER;
    const DECOUPLING: Option<Decoupling> = P::DECOUPLING;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn groups<T: Debug>(make: impl FnMut(usize) -> T) -> Self::Groups<T> {
        P::groups(make)
    }

    fn stored<V: Vector>(stages: &Self::Stages<V>) -> [StoredEvaluations<'_, V>; 2] {
        P::stored(stages)
    }
}
