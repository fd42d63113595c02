//! Coupled stages of several trajectories, each in one lane, with the bits of [`Automatic`](symplectic_core::solver::Automatic).
//!
//! A sweep computes the stages of all trajectories at once, with the operations of a single run in the same order. Only steps with a warm
//! start are taken here. If the stages of a trajectory do not settle in few sweeps, the trajectory takes the step alone.

mod by_halves;
mod emitted;
mod run_time;
mod second_order;
mod settle;

use core::marker::PhantomData;

use super::stages::{LaneOutcome, LaneStages, StepInLanes};
use emitted::ByMethod;
use run_time::ByTableau;
use symplectic_core::inside::TableauWork;
use symplectic_core::inside::sweeps::{
    LaneMovement, StageValue, eliminates, moved, noted, shortest, sum_of_products,
};
use symplectic_core::num_traits::Zero;
use symplectic_core::simd::Lanes;
use symplectic_core::solver::StageTableau;
use symplectic_core::system::Class;
use symplectic_core::{Scalar, Summation, System, Vector};

/// Tests whether steps with a tableau can be taken in lanes.
pub(super) struct Fits;

impl<C: Class> TableauWork<C> for Fits {
    type Output = bool;

    fn run<P: StageTableau<Class = C>>(self) -> bool {
        // If momenta are eliminated, the velocities' memory holds the slopes of the positions, one for each force.
        !eliminates::<P>() || P::POSITIONS.count == P::MOMENTA.count
    }
}

/// Takes a step of several trajectories. Writes the results of those whose stages converge into its outcome. They have the bits of a
/// single run with [`Automatic`](symplectic_core::solver::Automatic). The result is `None` if stages are not coupled.
pub(super) type LaneStep<W, J> =
    for<'a> fn(StepInLanes<'a, W, J>) -> Option<LaneOutcome<<W as Vector>::Scalar>>;

/// Finds the function that takes a step with a tableau and the sums `R`.
pub(super) struct FindStep<R, W, J>(pub(super) PhantomData<fn(W, J) -> R>);

impl<C, R, W, J> TableauWork<C> for FindStep<R, W, J>
where
    C: Class,
    R: Summation,
    W: Vector<Scalar: Lanes>,
    J: System<W, Class = C>,
{
    type Output = LaneStep<W, J>;

    #[inline]
    fn run<P: StageTableau<Class = C>>(self) -> Self::Output {
        match P::AT_RUN_TIME {
            true => |step| W::Scalar::in_registers(ByTableau::<C, R, _>(step, PhantomData)),
            false => |step| W::Scalar::in_registers(ByMethod::<P, R, _>(step, PhantomData)),
        }
    }
}

/// Sweeps over the coupled stages of several trajectories.
trait LaneSweeps<L: Lanes> {
    /// Whether a change at the level of rounding errors is the last if the next one would be at most one unit of EPSILON.
    const STOPS_AT_ROUNDING: bool;

    /// Computes the starting values from the stages of the previous step.
    fn begin(&mut self);

    /// One sweep over all stages.
    fn sweep(&mut self) -> LaneMovement<L>;

    /// A sweep that moves the stages twice as far.
    fn overrelaxed_sweep(&mut self) -> LaneMovement<L> {
        self.sweep()
    }

    /// The largest position and the largest momentum of each trajectory.
    fn scales(&self) -> [L; 2];

    /// Keeps the stages in these lanes, which have settled.
    fn keep(&mut self, lanes: u32);
}

/// Stage values `base + Σ_j factor_j terms_j`.
struct Sums<N, F> {
    /// Number of terms of a stage.
    count: N,
    /// The index of a term of a stage, and its factor.
    term: F,
    /// Whether each sum starts with the low part of the base.
    with_low: bool,
}

/// Computes new stage values; returns the largest change of each trajectory. `value` gets the indices of the stage and of the component.
#[cfg_attr(not(debug_assertions), inline(always))]
fn relax<R: Summation, W: Vector<Scalar: Lanes>>(
    sums: &Sums<impl Fn(usize) -> usize, impl Fn(usize, usize) -> (usize, f64)>,
    out: &mut [W],
    (base, low): (&W, &W),
    terms: &[W],
    value: impl StageValue<W::Scalar>,
) -> W::Scalar {
    let n = shortest(&*out).min(shortest(terms));
    let n = n.min(base.dimension()).min(low.dimension());
    let (base, low) = (&base.as_slice()[..n], &low.as_slice()[..n]);
    let mut largest = None;
    for k in 0..n {
        for (stage, out) in out.iter_mut().enumerate() {
            let (start, low) = (base[k], low[k]);
            let new = match (sums.count)(stage) {
                0 => start,
                count => {
                    let product = |j: usize| {
                        let (index, factor) = (sums.term)(stage, j);
                        (scalar::<W>(factor), terms[index].as_slice()[k])
                    };
                    let sum = sum_of_products(sums.with_low.then_some(low), count, product);
                    value.of((stage, k), (start, low), sum)
                }
            };
            let component = &mut out.as_mut_slice()[k];
            let new = moved(R::OVERRELAXED, *component, new);
            largest = Some(noted(largest, (new - *component).abs()));
            *component = new;
        }
    }
    largest.unwrap_or_else(W::Scalar::zero)
}

/// The same number in all lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
fn scalar<W: Vector>(number: f64) -> W::Scalar {
    W::Scalar::from_f64(number)
}

/// `out_i = Σ_j matrix(i, j) vectors_j`
#[cfg_attr(not(debug_assertions), inline(always))]
fn transform<W: Vector>(out: &mut [W], vectors: &[W], matrix: impl Fn(usize, usize) -> f64) {
    let n = shortest(&*out).min(shortest(vectors));
    for (i, out) in out.iter_mut().enumerate() {
        for (k, out) in out.as_mut_slice()[..n].iter_mut().enumerate() {
            let product = |j: usize| (scalar::<W>(matrix(i, j)), vectors[j].as_slice()[k]);
            *out = sum_of_products(None, vectors.len(), product);
        }
    }
}

/// The largest component of the base and of the stages.
#[cfg_attr(not(debug_assertions), inline(always))]
fn largest<W: Vector<Scalar: Lanes>>(base: &W, stages: &[W]) -> W::Scalar {
    let mut largest = W::Scalar::zero();
    for component in base.as_slice() {
        largest = largest.larger(component.abs());
    }
    for stage in stages {
        for component in stage.as_slice() {
            largest = largest.larger(component.abs());
        }
    }
    largest
}

/// Copies the lanes of vectors.
#[cfg_attr(not(debug_assertions), inline(always))]
fn copy_lanes<W: Vector<Scalar: Lanes>>(lanes: u32, from: &[W], to: &mut [W]) {
    for (from, to) in from.iter().zip(to) {
        for (from, to) in from.as_slice().iter().zip(to.as_mut_slice()) {
            *to = W::Scalar::select(lanes, *from, *to);
        }
    }
}

/// Copies the momenta of stages, and all evaluations, in these lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
fn keep<W: Vector<Scalar: Lanes>>(lanes: u32, from: &LaneStages<W>, to: &mut LaneStages<W>) {
    copy_lanes(lanes, &from.p, &mut to.p);
    copy_lanes(lanes, &from.velocity, &mut to.velocity);
    copy_lanes(lanes, &from.force, &mut to.force);
}
