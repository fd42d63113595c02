//! The stages of a step, and their balances of energy and momentum.

use crate::Error;
use alloc::vec::Vec;

use super::energies::{EnergyAt, weighted_energy};
use super::two_ends::{dot, solve};
use symplectic_core::inside::{Attempt, FirstFault, Plan, StageView};
use symplectic_core::solver::{Failure, Solver, Step, Stopping};
use symplectic_core::system::Class;
use symplectic_core::{
    Error as CoreError, Integrator, Method, Quantity, Scalar, Summation, System, Vector,
};

/// A stage of a step, with the evaluations there.
#[derive(Clone, Debug, PartialEq)]
pub struct StageOfStep<V: Vector> {
    /// `h b_i`
    pub weight: f64,
    /// `h b̃_i`, equal to `weight` except for splittings.
    pub force_weight: f64,
    /// The time of the position and of the force, `t0 + c_i h`.
    pub time: f64,
    /// The time of the momentum and of the velocity, `t0 + c̃_i h`.
    pub momentum_time: f64,
    /// The position `Q_i`.
    pub q: V,
    /// The momentum `P_i`.
    pub p: V,
    /// `∂H/∂p` there.
    pub velocity: V,
    /// The force there, with the applied force and without that of constraints.
    pub force: V,
    /// The [applied force](symplectic_core::Hamiltonian::applied_force) f there.
    pub applied: V,
    /// The multiplier `Λ_i` of each holonomic constraint: at this stage the constraints change the momentum by `−h b_i G(Q_i)ᵀΛ_i`, with 1
    /// in place of a weight zero, as the last one of symplectic Euler. Empty without holonomic constraints.
    ///
    /// With s stages they have order s − 1 (Jay, 1996); those of [`constraint_force`](crate::constraints::constraint_force) have the order of the state.
    /// Non-holonomic constraints have impulses at both ends of a step, not at its stages.
    pub multipliers: Vec<V::Scalar>,
}

/// The stages of the tableau, or for a composition those of all its steps. Returned by
/// [`step_with_stages`](StepWithStages::step_with_stages).
#[derive(Clone, Debug, PartialEq)]
pub struct StagesOfStep<V: Vector> {
    stages: Vec<StageOfStep<V>>,
}

impl<V: Vector> StagesOfStep<V> {
    pub(super) const fn new(stages: Vec<StageOfStep<V>>) -> Self {
        Self { stages }
    }
}

impl<V: Vector> StagesOfStep<V> {
    /// The stages, in the order of the tableau.
    pub fn stages(&self) -> &[StageOfStep<V>] {
        &self.stages
    }

    /// The work of the applied force, `h Σ b̃_i f_i·v_i`.
    ///
    /// The exact flow changes the energy by the integral of `f·v`. A step changes it by the work, up to an error of the order of the
    /// method. For splittings this error is of order 1: the velocities and forces are evaluated at different points.
    pub fn work(&self) -> V::Scalar {
        self.sum(|stage| dot(&stage.applied, &stage.velocity))
    }

    /// The impulse of the applied force in the direction of a symmetry with the generator `ξ_Q`, `h Σ b̃_i f_i·ξ_Q(Q_i)`; `generator(q, out)`
    /// writes `ξ_Q(q)` into `out`.
    ///
    /// If H and any constraints have this symmetry and `ξ_Q` is linear in q, a step changes the momentum map `J = p·ξ_Q(q)` by exactly this
    /// impulse, up to rounding (Marsden & West, 2001, 3.2.3).
    pub fn impulse(&self, mut generator: impl FnMut(&V, &mut V)) -> V::Scalar {
        let Some(first) = self.stages.first() else {
            return V::Scalar::from_f64(0.0);
        };
        let mut direction = first.q.zeros_like();
        self.sum(|stage| {
            generator(&stage.q, &mut direction);
            dot(&stage.applied, &direction)
        })
    }

    /// The discrete Lagrangian `L_d(q0, q1) = h Σ (b_i P_i·v_i − b_i T(P_i) − b̃_i U(Q_i))`, the action of the step. If H is not `T + U`,
    /// then `b̃ = b` and it is `h Σ b_i (P_i·v_i − H(Q_i, P_i))`.
    ///
    /// # Errors
    ///
    /// [`Core(NoEnergy)`](CoreError::NoEnergy) if the system has no energy; [`Error::DifferentNodes`] if it depends on time and the method
    /// has `c ≠ c̃`.
    pub fn action<S: System<V>>(&self, system: &S) -> Result<V::Scalar, Error> {
        let Some(first) = self.stages.first() else {
            return Ok(V::Scalar::from_f64(0.0));
        };
        let stages = self.stages.iter().map(|stage| EnergyAt {
            weights: [stage.weight, stage.force_weight].map(V::Scalar::from_f64),
            times: [stage.time, stage.momentum_time],
            q: &stage.q,
            p: &stage.p,
        });
        let energy = weighted_energy(system, (&first.q, &first.p), stages, |_, _| Ok(()))?;
        let mut action = -energy;
        for StageOfStep {
            weight,
            p,
            velocity,
            ..
        } in &self.stages
        {
            action += V::Scalar::from_f64(*weight) * dot(p, velocity);
        }
        Ok(action)
    }

    /// A sum over the stages with the weights of forces.
    fn sum(&self, mut term: impl FnMut(&StageOfStep<V>) -> V::Scalar) -> V::Scalar {
        let mut sum = V::Scalar::from_f64(0.0);
        for stage in &self.stages {
            sum += V::Scalar::from_f64(stage.force_weight) * term(stage);
        }
        sum
    }
}

/// A run whose steps are shown with their stages.
pub trait StepWithStages {
    /// The vectors of positions and momenta.
    type Vector: Vector;

    /// Takes one step and returns its stages, for balances of energy and momentum, and for the discrete action. The step is never
    /// [split](symplectic_core::Retry), and memory is allocated.
    ///
    /// # Errors
    ///
    /// Those of [`step`](symplectic_core::Run::step), and those of the implementation; the state is then unchanged.
    fn step_with_stages(&mut self) -> Result<StagesOfStep<Self::Vector>, Error>;
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> StepWithStages
    for Integrator<M, S, V, R, N>
{
    type Vector = V;

    /// The solver of the step does not keep its stages in this form. So they are computed again, to rounding, without starting values. This
    /// takes two to four times as many evaluations as a step for Gauss methods, and many more for explicit methods. Use it for
    /// tests and reports, not for every step of a long run.
    ///
    /// # Errors
    ///
    /// [`Core(EvaluationDimension)`](CoreError::EvaluationDimension) for the applied force too; [`Error::NoStages`] for a system of class
    /// `friction::Damped` (feature `flows`), whose kicks are exact flows.
    ///
    /// ```
    /// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
    /// # use symplectic::{Integrator, State};
    /// use symplectic::variational::{Error, StepWithStages};
    /// symplectic::hamiltonian! {
    ///     /// A particle in a central field, with friction.
    ///     Ring { gamma: 0.1 }
    ///     q: [x, y], p: [px, py];
    ///     let r2 = x^2 + y^2;
    ///     H = (px^2 + py^2)/2 + r2 (r2 - 1)^2
    ///     force: { x = -gamma px, y = -gamma py }
    /// }
    ///
    /// # fn main() -> Result<(), Error> {
    /// let start = State::from_arrays(0.0, [1.25, 0.0], [0.0, 0.5]);
    /// let mut run = Integrator::new(Gauss2, Ring::new(), start, 0.1)?;
    /// let angular_momentum = |state: &State<_>| {
    ///     let State { q, p, .. }: &State<symplectic::nalgebra::Vector2<f64>> = state;
    ///     q[0] * p[1] - q[1] * p[0]
    /// };
    /// let before = angular_momentum(run.state());
    /// let stages = run.step_with_stages()?;
    /// // The torque of the friction is all that changes it.
    /// let impulse = stages.impulse(|q, turned| *turned = [-q[1], q[0]].into());
    /// let change = angular_momentum(run.state()) - before;
    /// assert!((change - impulse).abs() < 1e-15 && change < -0.005);
    /// # Ok(())
    /// # }
    /// ```
    fn step_with_stages(&mut self) -> Result<StagesOfStep<V>, Error> {
        self.step_solved_by(|system, step, _, number, stopping| {
            stages::<M, S, V, R>(system, step, number, stopping)
        })
    }
}

/// The stages of a step with known position and momentum at its start.
fn stages<M: Method, S: System<V>, V: Vector, R: Summation>(
    system: &S,
    step: &Step<'_, V>,
    number: u64,
    stopping: Stopping,
) -> Result<StagesOfStep<V>, Error> {
    if S::Class::FRICTION {
        return Err(Error::NoStages);
    }
    let (mut stages, mut mismatch) = (Vec::new(), None);
    let mut add = |view: StageView<'_, V>| {
        let [mut velocity, mut force, mut applied] = core::array::from_fn(|_| step.q.zeros_like());
        let (q, p) = (view.q, view.p);
        let [time, momentum_time] = [view.time, view.momentum_time].map(V::Scalar::from_f64);
        system.velocity(momentum_time, q, p, &mut velocity);
        system.force(time, q, p, &mut force);
        system.applied_force(time, q, p, &mut applied);
        let evaluations = [
            (Quantity::Velocity, &velocity),
            (Quantity::Force, &force),
            (Quantity::Force, &applied),
        ];
        for (what, found) in evaluations.map(|(what, vector)| (what, vector.dimension())) {
            if found != q.dimension() {
                mismatch.get_or_insert((what, stages.len() + 1, found));
            }
        }
        stages.push(StageOfStep {
            weight: view.weight,
            force_weight: view.force_weight,
            time: view.time,
            momentum_time: view.momentum_time,
            q: q.clone(),
            p: p.clone(),
            velocity,
            force,
            applied,
            multipliers: (view.impulses.iter())
                .map(|&impulse| impulse / V::Scalar::from_f64(view.impulse_weight))
                .collect(),
        });
    };
    let shown =
        <S::Class as Class>::Plan::<M>::show_stages::<R, V, S>(step, system, stopping, &mut add);
    match shown {
        Some(Ok(())) => {}
        Some(Err(failure)) => return Err(error(step, number, failure).into()),
        None => {
            let (found, _) = solve::<true, M, S, V>(system, step, number, stopping)?;
            let coefficients = M::COEFFICIENTS;
            let nodes = coefficients.c.iter().zip(coefficients.c_tilde);
            let places = found.q.iter().zip(&found.p);
            let weights = coefficients.b.iter().zip(coefficients.b_tilde);
            for ((&c, &c_tilde), ((q, p), (b, b_tilde))) in nodes.zip(places.zip(weights)) {
                add(StageView {
                    weight: step.size * b.double(),
                    force_weight: step.size * b_tilde.double(),
                    time: step.at(c),
                    momentum_time: step.at(c_tilde),
                    q,
                    p,
                    impulses: &[],
                    impulse_weight: step.size,
                });
            }
        }
    }
    if let Some((what, stage, found)) = mismatch {
        return Err(CoreError::EvaluationDimension {
            time: step.time,
            step_size: step.size,
            step: number,
            what,
            stage: Some(stage),
            expected: step.q.dimension(),
            found,
        }
        .into());
    }
    Ok(StagesOfStep { stages })
}

/// The error of a step that succeeded once and failed when repeated.
fn error<V: Vector>(step: &Step<'_, V>, number: u64, failure: Failure) -> CoreError {
    let attempt = Attempt::of(step, number);
    let observed = FirstFault::new(attempt.dimension);
    let nothing: symplectic_core::inside::Evaluations<V> =
        symplectic_core::solver::StageStorage::like(step.q);
    attempt.error(Some(failure), &observed, &nothing, step.q)
}
