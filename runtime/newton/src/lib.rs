//! Newton's iteration of the package `symplectic`, for the coupled stages of stiff and strongly coupled systems
//!
//! Programs depend on `symplectic` with its feature `newton`, whose module `solver` gives all names of this package.

#![no_std]

extern crate alloc;

mod by_newton;
mod coefficients;
mod convergence;
#[cfg(feature = "num-dual")]
mod dual_numbers;
mod every_stage;
mod fallback;
mod jacobian;
mod linear_solver;
mod memory;
mod sweep;

use core::marker::PhantomData;

pub use by_newton::ByNewton;
#[cfg(feature = "num-dual")]
pub use dual_numbers::{DualNumbers, SystemInDuals};
pub use every_stage::EveryStage;
pub use fallback::{FixedPointThenNewton, FixedPointThenNewtonMemory};
pub use jacobian::{AnalyticOrDifferences, Derivatives, Differences};
pub use linear_solver::{BandOrDense, Banded, Coupling, Dense, LinearSolver, Matrices, Parts};
pub use memory::NewtonMemory;

use coefficients::StageCoefficients;
use convergence::settle;
use sweep::ByIncrements;
use symplectic_core::output::Inside;
use symplectic_core::solver::{
    Failure, Outcome, Solver, StageTableau, Step, StepStatistics, Stopping, StoredEvaluations,
    WarmStart,
};
use symplectic_core::{Summation, System, Vector};

/// The simplified Newton iteration, for stiff and strongly coupled systems. The [`LinearSolver`] `L` solves its linear
/// systems. [`by_newton`](ByNewton::by_newton) uses [`BandOrDense`] matrices, and the second derivatives that the system provides
/// ([`AnalyticOrDifferences`]). Alternatives are named explicitly: [`Dense`] or [`Banded`] matrices, with dual numbers or [`Differences`].
///
/// The unknowns are the increments `h velocity_j` and `h force_j`, not the stages. In a stiff system, the evaluation at a
/// rounded stage has the rounding error times the stiffness; the solution of the linear system does not. With the
/// derivatives at one point in the middle of the stages, and the residuals `ρ`, the correction of a separable system is
///
/// ```text
/// (1 − h² ÃA ⊗ ∂v/∂p ∂f/∂q) x = ρ_v + h Ã ⊗ ∂v/∂p ρ_f      y = ρ_f + h A ⊗ ∂f/∂q x
/// ```
///
/// and that of a general system is `(1 − h A ⊗ J) (x, y) = (ρ_v, ρ_f)`, where the columns of `y` have `Ã`. The
/// [`Decoupling`](symplectic_core::solver::Decoupling) of the method decouples the stages: s/2 complex matrices with n rows replace
/// one matrix with sn rows (Hairer & Wanner, *Solving ODEs II*, IV.8).
///
/// # Derivatives
///
/// The factors are kept from step to step. They are recomputed if the step size changes, or if nothing is [kept](WarmStart::stages) of
/// the previous step. They are also recomputed after a step in which the change shrank by less than a factor of 32 per sweep. They are
/// recomputed within the step if the contraction rate predicts more than 16 sweeps.
///
/// Derivatives at one point do not suffice for all stages if a stiff direction turns within the step. An example is a pendulum with a
/// spring of frequency ω if `h²ω` is above 1. If recomputed derivatives still contract too slowly, the step starts again with full Newton,
/// with the derivatives of every stage in every sweep ([`LinearSolver::correct`]). The next 16 steps also use full Newton.
///
/// # Convergence
///
/// The iteration stops if the change of the stages no longer shrinks and is at the level of rounding. The remaining error then
/// causes no energy drift.
///
/// * The change stagnates if it has not halved in three sweeps. It also stagnates if it has not become smaller for at least one
///   sweep and more than a sixteenth of all sweeps.
/// * The level of rounding is 64 units of [`Scalar::EPSILON`](symplectic_core::Scalar::EPSILON) of the largest position or momentum. One of the two
///   suffices for a separable system. Otherwise the noise is measured. The arguments of all evaluations move by one unit, and a change up
///   to 16 times the response is noise. A stiff spring `k (r − 1)` is evaluated with an error of `k` units; momenta are then uncertain by
///   `1/h` units of the positions.
///
/// With [`Plain`](symplectic_core::Plain) sums it stops earlier, as [`FixedPoint`](symplectic_core::solver::FixedPoint) does. The remaining change is
/// [`Statistics::largest_residual`](symplectic_core::Statistics::largest_residual).
///
/// A step fails with [`Error::NoConvergence`](symplectic_core::Error::NoConvergence) if full Newton does not converge either. It fails with
/// [`Error::Stagnation`](symplectic_core::Error::Stagnation) if the change shrinks but stagnates far above rounding: the evaluations are noisier.
///
/// ```
/// symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }
/// use symplectic::nalgebra::Vector2;
/// use symplectic::solver::ByNewton;
/// use symplectic::{Error, Integrator, State, separable};
///
/// # fn main() -> Result<(), Error> {
/// // A pendulum on a stiff spring: H = |p|²/2 + 10⁸ (|q| − 1)²/2 + q₂.
/// let pendulum = || separable::<Vector2<f64>, _, _>(
///     |_time, p, velocity| *velocity = *p,
///     |_time, q, force| *force = q * (1e8 * (q.norm().recip() - 1.0)) - Vector2::new(0.0, 1.0),
/// );
/// let start = || State::new(0.0, Vector2::new(1.0, 0.0), Vector2::new(0.0, 0.0));
///
/// let mut fixed_point = Integrator::new(Gauss4, pendulum(), start(), 0.01)?;
/// assert!(matches!(fixed_point.step(), Err(Error::NoConvergence { .. })));
///
/// let mut integrator = Integrator::new(Gauss4, pendulum(), start(), 0.01)?.by_newton();
/// let end = integrator.integrate_to(10.0)?;
/// assert!((end.q.norm() - 1.0).abs() < 1e-6);
/// assert!(integrator.statistics().mean_iterations() < 10.0);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Newton<L = BandOrDense<AnalyticOrDifferences>>(PhantomData<L>);

impl<L> Newton<L> {
    /// The solver.
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<L> Default for Newton<L> {
    fn default() -> Self {
        Self::new()
    }
}

impl<V: Vector, S: System<V>, L: LinearSolver<V, S>> Solver<V, S> for Newton<L> {
    const IS_NEWTON: bool = true;

    type Memory<P: StageTableau> = NewtonMemory<V, P, S, L>;

    fn memory<P: StageTableau>(plan: &P, prototype: &V) -> Self::Memory<P> {
        NewtonMemory::new(StageCoefficients::of(plan), prototype)
    }

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
        let mut sweeps = ByIncrements::<P, R, V, S, L>::new(step, system, memory);
        let mut work = settle(&mut sweeps, kept, stopping)?;
        work.factorisations = sweeps.finish(outcome);
        Ok(work)
    }

    fn extend<P: StageTableau>(memory: &Self::Memory<P>, at: Inside<'_, V>, q: &mut V, p: &mut V) {
        let halves = [
            (&P::MOMENTA, &memory.work.u, q),
            (&P::POSITIONS, &memory.work.w, p),
        ];
        for (half, values, out) in halves {
            let increments = StoredEvaluations {
                values,
                carried: &[],
            };
            at.add(half, P::INCREMENTS, increments, out);
        }
    }
}
