//! Coupled stages of several trajectories, each in one lane.

use alloc::sync::Arc;
use alloc::vec::Vec;

use symplectic_core::Vector;
use symplectic_core::inside::StagePart;
use symplectic_core::inside::rows::CoupledRows;
use symplectic_core::num_traits::Zero;
use symplectic_core::simd::Lanes;
use symplectic_core::solver::{EvaluationCounts, Outcome, StageStorage, Step, Stopping};

/// Coupled stages of trajectories in the lanes of the vectors `W`: an entry for each stage.
#[derive(Clone, Debug)]
pub(super) struct LaneStages<W> {
    pub(super) q: Vec<W>,
    pub(super) p: Vec<W>,
    pub(super) velocity: Vec<W>,
    pub(super) force: Vec<W>,
    pub(super) start: Vec<W>,
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
    pub(super) fn mismatch(&self, dimension: usize) -> bool {
        let mut all = self.velocity.iter().chain(&self.force);
        all.any(|vector| vector.dimension() != dimension)
    }
}

/// The memory of the coupled stages of several trajectories.
///
/// A step computes new stages `now` from those of the step `before`. When those of a trajectory have settled, they are copied to
/// `settled`, and further sweeps do not change them.
#[derive(Clone, Debug)]
pub(super) struct LaneMemory<W: Vector> {
    pub(super) before: LaneStages<W>,
    pub(super) now: LaneStages<W>,
    pub(super) settled: LaneStages<W>,
    /// The sizes of positions and momenta in the step before: see [`WarmStart::scales`](symplectic_core::solver::WarmStart::scales).
    pub(super) scales: [W::Scalar; 2],
    /// The rows of the stages, if they are known only at run time.
    pub(super) rows: Option<Arc<CoupledRows>>,
}

impl<W: Vector<Scalar: Lanes>> LaneMemory<W> {
    /// Memory for runs with memory like `stages`.
    pub(super) fn like<V: Vector>(stages: &mut impl StageStorage<V>, zeros: &W) -> Self {
        let made = LaneStages::like(stages, zeros);
        Self {
            before: made.clone(),
            now: made.clone(),
            settled: made,
            scales: [Zero::zero(); 2],
            rows: stages.rows().cloned(),
        }
    }

    /// Copies the stages that a run keeps into a lane.
    pub(super) fn load<V: Vector>(&mut self, lane: usize, stages: &mut impl StageStorage<V>) {
        stages.stages(&mut |part, stage, component, number| {
            if let Some(vector) = self.before.part(part).get_mut(stage)
                && let Some(lanes) = vector.as_mut_slice().get_mut(component)
            {
                lanes.set(lane, *number);
            }
        });
    }

    /// Copies the stages in a lane into the memory of a run.
    pub(super) fn store<V: Vector>(&mut self, lane: usize, stages: &mut impl StageStorage<V>) {
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
pub(super) struct LaneOutcome<L> {
    /// The lanes whose stages have settled, as bits. The trajectories in other lanes have to take the step alone.
    pub(super) settled: u32,
    /// Number of sweeps until then.
    pub(super) sweeps: L,
    /// Sizes of positions and momenta.
    pub(super) scales: [L; 2],
    /// The evaluations of the step.
    pub(super) counts: EvaluationCounts,
}

/// A step of several trajectories, after a step that has left its stages in the memory.
#[derive(Debug)]
pub(super) struct StepInLanes<'a, W: Vector, J> {
    pub(super) step: &'a Step<'a, W>,
    pub(super) system: &'a J,
    pub(super) memory: &'a mut LaneMemory<W>,
    /// The lanes with a trajectory that takes the step, as bits.
    pub(super) live: u32,
    pub(super) stopping: Stopping,
    pub(super) outcome: Outcome<'a, W>,
}
