//! Coupled stages of several trajectories, each in one lane.

use alloc::sync::Arc;
use alloc::vec::Vec;

use crate::contract::{CoupledRows, EvaluationCounts, Outcome, StageStorage, Step, Stopping};
use crate::number::{Lanes, Vector};

/// A part of the memory of coupled stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StagePart {
    /// The positions of the stages.
    Positions,
    /// The momenta of the stages.
    Momenta,
    /// The velocities, or the increments computed from them.
    Velocities,
    /// The forces, or the increments computed from them.
    Forces,
    /// The velocity at the start of the step, if momenta are eliminated.
    Start,
}

/// Called with the part, the stage, the component, and the number there.
pub type StageVisit<'a> = dyn FnMut(StagePart, usize, usize, &mut f64) + 'a;

/// Coupled stages of trajectories in the lanes of the vectors `W`: an entry for each stage.
#[derive(Clone, Debug)]
pub struct LaneStages<W> {
    pub(crate) q: Vec<W>,
    pub(crate) p: Vec<W>,
    pub(crate) velocity: Vec<W>,
    pub(crate) force: Vec<W>,
    pub(crate) start: Vec<W>,
}

impl<W: Vector<Scalar: Lanes>> LaneStages<W> {
    /// Zeros in place of the stages of a single run.
    fn like<V: Vector>(stages: &mut impl StageStorage<V>, zeros: &W) -> Self {
        let mut made = Self {
            q: Vec::new(),
            p: Vec::new(),
            velocity: Vec::new(),
            force: Vec::new(),
            start: Vec::new(),
        };
        stages.stages(&mut |part, stage, _, _| {
            let vectors = made.part(part);
            while vectors.len() <= stage {
                vectors.push(zeros.clone());
            }
        });
        made
    }

    const fn part(&mut self, part: StagePart) -> &mut Vec<W> {
        match part {
            StagePart::Positions => &mut self.q,
            StagePart::Momenta => &mut self.p,
            StagePart::Velocities => &mut self.velocity,
            StagePart::Forces => &mut self.force,
            StagePart::Start => &mut self.start,
        }
    }

    /// Whether an evaluation has another dimension.
    pub(crate) fn mismatch(&self, dimension: usize) -> bool {
        let mut all = self.velocity.iter().chain(&self.force);
        all.any(|vector| vector.dimension() != dimension)
    }
}

/// The memory of the coupled stages of several trajectories.
///
/// A step computes new stages `now` from those of the step `before`. When those of a trajectory have settled, they are copied to
/// `settled`, and further sweeps do not change them.
#[derive(Clone, Debug)]
pub struct LaneMemory<W: Vector> {
    pub(crate) before: LaneStages<W>,
    pub(crate) now: LaneStages<W>,
    pub(crate) settled: LaneStages<W>,
    /// The sizes of positions and momenta in the step before: see [`WarmStart::scales`](crate::solver::WarmStart::scales).
    pub(crate) scales: [W::Scalar; 2],
    /// The rows of the stages, if they are known only at run time.
    pub(crate) rows: Option<Arc<CoupledRows>>,
}

impl<W: Vector<Scalar: Lanes>> LaneMemory<W> {
    /// Memory for runs with memory like `stages`.
    pub(crate) fn like<V: Vector>(stages: &mut impl StageStorage<V>, zeros: &W) -> Self {
        let made = LaneStages::like(stages, zeros);
        Self {
            before: made.clone(),
            now: made.clone(),
            settled: made,
            scales: [num_traits::Zero::zero(); 2],
            rows: stages.rows().cloned(),
        }
    }

    /// Copies the stages that a run keeps into a lane.
    pub(crate) fn load<V: Vector>(&mut self, lane: usize, stages: &mut impl StageStorage<V>) {
        stages.stages(&mut |part, stage, component, number| {
            if let Some(vector) = self.before.part(part).get_mut(stage)
                && let Some(lanes) = vector.as_mut_slice().get_mut(component)
            {
                lanes.set(lane, *number);
            }
        });
    }

    /// Copies the stages in a lane into the memory of a run.
    pub(crate) fn store<V: Vector>(&mut self, lane: usize, stages: &mut impl StageStorage<V>) {
        stages.stages(&mut |part, stage, component, number| {
            if let Some(vector) = self.before.part(part).get(stage)
                && let Some(lanes) = vector.as_slice().get(component)
            {
                *number = lanes.get(lane);
            }
        });
    }
}

/// The result of a step of several trajectories.
#[derive(Clone, Copy, Debug)]
pub struct LaneOutcome<L> {
    /// The lanes whose stages have settled, as bits. The trajectories in other lanes have to take the step alone.
    pub(crate) settled: u32,
    /// Number of sweeps until then.
    pub(crate) sweeps: L,
    /// Sizes of positions and momenta.
    pub(crate) scales: [L; 2],
    /// The evaluations of the step.
    pub(crate) counts: EvaluationCounts,
}

/// A step of several trajectories, after a step that has left its stages in the memory.
#[derive(Debug)]
pub struct StepInLanes<'a, W: Vector, J> {
    pub(crate) step: &'a Step<'a, W>,
    pub(crate) system: &'a J,
    pub(crate) memory: &'a mut LaneMemory<W>,
    /// The lanes with a trajectory that takes the step, as bits.
    pub(crate) live: u32,
    pub(crate) stopping: Stopping,
    pub(crate) outcome: Outcome<'a, W>,
}

/// Takes a step of several trajectories. Writes the results of those whose stages converge into the outcome. They have the bits of
/// [`Plan::take`](crate::emitted::Plan::take) with the solver of the run. `None` if that is impossible.
pub type LaneStep<W, J> =
    for<'a> fn(StepInLanes<'a, W, J>) -> Option<LaneOutcome<<W as Vector>::Scalar>>;
