//! Coupled stages of a tableau at run time: rows of coefficients instead of straight-line code.

use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt::Debug;
use core::marker::PhantomData;

use symplectic_core::inside::rows::{CoupledRows, CoupledStep};
use symplectic_core::inside::{
    StagePart, StagePlan, StageVisit, copy, first_mismatch, first_non_finite, first_non_finite_of,
    show_vectors,
};
use symplectic_core::simd::F64x2;
use symplectic_core::solver::{
    EvaluationCounts, HalfChange, HalfTableau, Outcome, SecondOrderTableau, StageChange,
    StageStorage, StageTableau, Step, StoredEvaluations, Visit, WarmStart, vector_words,
};
use symplectic_core::system::Class;
use symplectic_core::{Quantity, Scalar, Summation, System, Vector};

/// The coupled stages of a tableau at run time, for systems of class `C`.
#[derive(Clone, Debug)]
pub struct RunTimeRows<C> {
    rows: Arc<CoupledRows>,
    class: PhantomData<C>,
}

impl<C> RunTimeRows<C> {
    pub(crate) const fn new(rows: Arc<CoupledRows>) -> Self {
        Self {
            rows,
            class: PhantomData,
        }
    }
}

/// Coupled stages one by one: one vector for each stage value and evaluation. Evaluations are stored as increments.
#[derive(Clone, Debug)]
pub struct RunTimeStages<V> {
    rows: Arc<CoupledRows>,
    q: Vec<V>,
    p: Vec<V>,
    velocity: Vec<V>,
    force: Vec<V>,
}

impl<V: Vector> RunTimeStages<V> {
    fn new(rows: Arc<CoupledRows>, prototype: &V) -> Self {
        let zeros = |count: usize| (0..count).map(|_| prototype.zeros_like()).collect();
        let (positions, momenta) = (rows.positions.rows.len(), rows.momenta.rows.len());
        Self {
            q: zeros(positions),
            p: zeros(momenta),
            velocity: zeros(momenta),
            force: zeros(positions),
            rows,
        }
    }
}

impl<V: Vector> StageStorage<V> for RunTimeStages<V> {
    /// Without rows there are no stages.
    fn like(prototype: &V) -> Self {
        Self::new(Arc::default(), prototype)
    }

    fn anew(&self, prototype: &V) -> Self {
        Self::new(self.rows.clone(), prototype)
    }

    fn rows(&self) -> Option<&Arc<CoupledRows>> {
        Some(&self.rows)
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        for vectors in [
            &mut self.q,
            &mut self.p,
            &mut self.velocity,
            &mut self.force,
        ] {
            vector_words(vectors, visit);
        }
    }

    fn show_words(&self, visit: &mut Visit<'_>) {
        for vectors in [&self.q, &self.p, &self.velocity, &self.force] {
            show_vectors(vectors, visit);
        }
    }

    fn stages(&mut self, visit: &mut StageVisit<'_>) {
        let parts = [
            (StagePart::Positions, &mut self.q),
            (StagePart::Momenta, &mut self.p),
            (StagePart::Velocities, &mut self.velocity),
            (StagePart::Forces, &mut self.force),
        ];
        for (part, vectors) in parts {
            for (stage, vector) in vectors.iter_mut().enumerate() {
                let numbers = V::Scalar::doubles_mut(vector.as_mut_slice());
                for (component, number) in numbers.unwrap_or(&mut []).iter_mut().enumerate() {
                    visit(part, stage, component, number);
                }
            }
        }
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        first_non_finite((&self.q, &self.force), (&self.p, &self.velocity))
    }

    fn non_finite_force(&self) -> Option<usize> {
        first_non_finite_of(&self.force)
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        first_mismatch(&self.force, &self.velocity, dimension)
    }
}

/// Nothing is allocated in a step.
impl<C: Class> StagePlan for RunTimeRows<C> {
    type Class = C;
    type Stages<V: Vector> = RunTimeStages<V>;

    /// See [`evaluations`](StagePlan::evaluations).
    const EVALUATIONS: EvaluationCounts = EvaluationCounts {
        begin: 0,
        start: 0,
        sweep: 0,
        finish: 0,
        carried: 0,
    };

    fn evaluations<V: Vector>(stages: &RunTimeStages<V>) -> EvaluationCounts {
        stages.rows.counts()
    }

    fn stages<V: Vector>(&self, prototype: &V) -> RunTimeStages<V> {
        RunTimeStages::new(self.rows.clone(), prototype)
    }

    #[inline]
    fn begin<R: Summation, V: Vector, S: System<V, Class = C>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut RunTimeStages<V>,
        kept: WarmStart,
    ) {
        let RunTimeStages {
            rows,
            q,
            p,
            velocity,
            force,
        } = stages;
        let rows: &CoupledRows = rows;
        let CoupledRows {
            positions, momenta, ..
        } = rows;
        if kept.stages && !momenta.extrapolation.is_empty() {
            momenta.extrapolate(velocity);
        } else {
            CoupledStep { step, system, rows }.start(velocity);
        }
        let mut ignored = HalfChange::default();
        positions.relax::<R, V>(q, (step.q, step.q_low), velocity, &mut ignored);
        if kept.stages && !positions.extrapolation.is_empty() {
            positions.extrapolate(force);
            momenta.relax::<R, V>(p, (step.p, step.p_low), force, &mut ignored);
        } else {
            p.iter_mut().for_each(|p| copy(p, step.p));
        }
    }

    #[inline]
    fn sweep<R: Summation, V: Vector, S: System<V, Class = C>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut RunTimeStages<V>,
    ) -> StageChange {
        let mut change = StageChange::default();
        let RunTimeStages {
            rows,
            q,
            p,
            velocity,
            force,
        } = stages;
        let rows: &CoupledRows = rows;
        let common = CoupledStep { step, system, rows };
        common.forces(q, p, force);
        rows.momenta
            .relax::<R, V>(p, (step.p, step.p_low), force, &mut change.p);
        common.velocities(q, p, velocity);
        rows.positions
            .relax::<R, V>(q, (step.q, step.q_low), velocity, &mut change.q);
        change
    }

    #[inline]
    fn finish<R: Summation, V: Vector, S: System<V, Class = C>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut RunTimeStages<V>,
        _kept: WarmStart,
        outcome: Outcome<'_, V>,
    ) {
        let rows = &stages.rows;
        CoupledStep { step, system, rows }.totals::<R>(&stages.velocity, &stages.force, outcome);
    }
}

/// In place of constants.
const NO_CONSTANTS: HalfTableau = HalfTableau {
    count: 0,
    columns: &[],
    times: &[],
    weights: &[],
    extrapolation: &[],
    polynomial: None,
};

/// The constants are empty: see [`StageTableau::AT_RUN_TIME`].
impl<C: Class> StageTableau for RunTimeRows<C> {
    type Lanes = F64x2;
    type Groups<T: Debug> = [T; 0];

    const AT_RUN_TIME: bool = true;
    const INCREMENTS: bool = true;
    const POSITIONS: HalfTableau = NO_CONSTANTS;
    const MOMENTA: HalfTableau = NO_CONSTANTS;
    const SECOND_ORDER: Option<SecondOrderTableau> = None;

    fn rows(&self) -> Option<&Arc<CoupledRows>> {
        Some(&self.rows)
    }

    fn groups<T: Debug>(_make: impl FnMut(usize) -> T) -> [T; 0] {
        []
    }

    fn stored<V: Vector>(stages: &RunTimeStages<V>) -> [StoredEvaluations<'_, V>; 2] {
        [&stages.velocity, &stages.force].map(|values| StoredEvaluations {
            values,
            carried: &[],
        })
    }
}
