//! Steps of systems with non-holonomic constraints `w(q)·q' = 0`: discrete Lagrange–d'Alembert–Pontryagin (Leok & Ohsawa,
//! arXiv:0810.0740v1, 4.28).
//!
//! ```text
//! p = p0 − w(q0)ᵀλ      Q_i = q0 + h Σ_j a_ij velocity_j    P_i = p + h Σ_j ã_ij force_j
//! Σ_i b_i w(Q_i)·(q1 − q0) = 0    q1 = q0 + h Σ_i b_i velocity_i    p1 = p + h Σ_i b_i force_i − w(q1)ᵀμ,   w(q1) ∂H/∂p(q1, p1) = 0
//! ```
//!
//! For Gauss with one stage the discrete constraint is imposed at the midpoint. For Lobatto IIIA–IIIB with two stages it is the mean of
//! both ends. For the Euler methods it is imposed at one end. A step is its own adjoint if its tableau is; the two Euler steps are adjoints
//! of each other. So a symmetric tableau gives a symmetric step of order 2, which can be composed as such. Positions do not depend on μ:
//! the next step finds λ for any momentum in `p1 + span wᵀ`.
//!
//! The stages need only H, so H may be degenerate as long as `w H_pp wᵀ` is invertible. Let `H_d^±` be the generating functions of the same
//! tableau without constraints, `P = p1 + w(q1)ᵀμ` and `p = p0 − w(q0)ᵀλ`. A step then satisfies the implicit discrete Hamilton's equations
//! (Leok & Ohsawa 4.35 and 4.52):
//!
//! ```text
//! (+)  p0 − D1 H_d⁺(q0, P) ∈ span w(q0)ᵀ     q1 = D2 H_d⁺(q0, P)                     P − p1 ∈ span w(q1)ᵀ
//! (−)  q0 = −D1 H_d⁻(p, q1)                  p1 + D2 H_d⁻(p, q1) ∈ span w(q1)ᵀ       p − p0 ∈ span w(q0)ᵀ
//! ```

mod start;
mod step;

pub use start::consistent_momentum;

use alloc::vec;
use alloc::vec::Vec;

use crate::constraints::kind::Kind;
use crate::constraints::memory::OwnPart;
use crate::constraints::metric::{Metric, Point};
use crate::constraints::with_constraints::Constraints;
use crate::constraints::{Gradients, Nonholonomic, WithConstraints, Workspace};
use symplectic_core::inside::{ConstrainedStep, ConstrainedTableau};
use symplectic_core::solver::{Failure, Outcome, Step, StepStatistics, Stopping, Visit};
use symplectic_core::system::{Class, Unconstrained};
use symplectic_core::{Error, Method, Scalar, Summation, System, Vector};

impl<C: Class + Unconstrained> Kind for Nonholonomic<C> {
    type Part<V: Vector> = NonholonomicPart<V>;

    const GIVEN_BY: &'static str = "NonholonomicConstraints";

    fn constraints_of<'a, V: Vector>(given: Self::Extra<'a, V>) -> Constraints<'a, V> {
        Constraints::Nonholonomic(given)
    }

    fn steps_of<M: Method>(method: &M) -> &'static [ConstrainedStep] {
        method.nonholonomic()
    }

    fn known_steps<M: Method>() -> &'static [ConstrainedStep] {
        M::NONHOLONOMIC
    }

    fn check_start<V: Vector, S: System<V>>(
        system: &WithConstraints<'_, V, S>,
        time: f64,
        q: &V,
        p: &V,
    ) -> Result<(), Error> {
        start::check_start(system, time, q, p)
    }
}

/// The part of the memory that only steps with non-holonomic constraints need.
#[derive(Clone, Debug)]
pub struct NonholonomicPart<V: Vector> {
    /// Whether the last sweep moved a position.
    moved: Vec<bool>,
    /// w(Q_i) of one stage.
    rows: Gradients<V::Scalar>,
    /// `w(Q_i)·(q1 − q0)` of one stage, and the weighted mean over all stages.
    part: Vec<V::Scalar>,
    defects: Vec<V::Scalar>,
    /// `q1 − q0`
    displacement: V,
    /// The largest displacement of every component over all sweeps of a step.
    reach: V,
}

impl<V: Vector> OwnPart<V> for NonholonomicPart<V> {
    /// `−w(q0)ᵀλ` and `−w(q1)ᵀμ`
    const IMPULSES: usize = 2;

    fn for_steps<S: System<V>>(
        _: &[ConstrainedStep],
        stages: usize,
        system: &WithConstraints<'_, V, S>,
        q: &V,
        (_, point): (&Metric<V::Scalar>, &Point<V>),
    ) -> Self {
        let numbers = || vec![V::Scalar::from_f64(0.0); system.constraints()];
        Self {
            moved: vec![true; stages],
            rows: point.gradients.clone(),
            part: numbers(),
            defects: numbers(),
            displacement: q.zeros_like(),
            reach: q.zeros_like(),
        }
    }

    /// Takes a step; `carried` means that the previous step ended where this one starts.
    ///
    /// A sweep evaluates the forces at the stages, computes the stages with the present multipliers, and corrects the multipliers by
    ///
    /// ```text
    /// λ += S⁻¹ Σ_i b_i w(Q_i)·(q1 − q0)/h      S = w M⁻¹ wᵀ at q0
    /// ```
    ///
    /// until the residuals are rounding errors. Then the last impulse follows from `w velocity(q1, p1) = 0`.
    fn take_substep<R: Summation, S: System<V>>(
        workspace: &mut Workspace<V, Self>,
        (_, tableau): (usize, &ConstrainedTableau),
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        carried: bool,
        stopping: Stopping,
        outcome: &mut Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure> {
        let mut work = StepStatistics::default();
        if !carried {
            let (end, scratch) = (&mut workspace.end, &mut workspace.scratch);
            (workspace.metric).evaluate(system, step.time, (step.q, step.p), end, scratch)?;
        }
        core::mem::swap(&mut workspace.start, &mut workspace.end);
        workspace.begin(tableau, step, system, &mut work);
        workspace.iterate::<R, S>(tableau, step, system, stopping, outcome, &mut work)?;
        workspace.finish::<R, S>(tableau, step, system, stopping, outcome, &mut work)?;
        Ok(work)
    }

    fn impulses_at<'w>(
        _: &'w Workspace<V, Self>,
        _: &ConstrainedTableau,
        _: usize,
    ) -> &'w [V::Scalar] {
        &[]
    }

    fn own_words(workspace: &mut Workspace<V, Self>, visit: &mut Visit<'_>) {
        workspace.end.gradients.words(visit);
        workspace.end.normal.words(visit);
    }
}
