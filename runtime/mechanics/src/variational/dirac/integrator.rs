//! Steps of degenerate Lagrangians, and of Lagrangians with constraints on velocities.

use crate::Error;
use alloc::format;
use alloc::vec::Vec;

use super::primary::consistent_velocity;
use super::step::Equations;
use super::{DiracRule, DiracSystem};
use crate::variational::ends::Ends;
use crate::variational::stages::{StagesOfStep, StepWithStages};
use crate::variational::two_ends::dot;
use symplectic_core::inside::{
    SaveWords, StepsBeside, SymmetricSteps, check_state, check_step_size, copy, or_as_first_step,
    words,
};
use symplectic_core::proved::StoermerVerletSteps;
use symplectic_core::solver::{Visit, vector_words};
use symplectic_core::stepper::{Equal, Stepper};
use symplectic_core::{Checkpoint, Run, State, Statistics, Vector};

/// Takes the steps of the discrete principle of Lagrange, d'Alembert and Pontryagin (Leok & Ohsawa, arXiv:0810.0740v1, 4.28 and 8.3) for a
/// [`DiracSystem`], whose Lagrangian may be degenerate:
///
/// ```text
/// p0 + D1 Ld(q0, q1) = w(q0)ᵀλ      p1 = D2 Ld(q0, q1) + w(q1)ᵀμ      w_d(q0, q1)·(q1 − q0) = 0
/// p1 = ∂L/∂v(q1, v1)                w(q1) v1 = 0
/// ```
///
/// $$ p_0 + D_1 L_d(q_0, q_1) = w(q_0)^T \lambda \qquad p_1 = D_2 L_d(q_0, q_1) + w(q_1)^T \mu \qquad w_d(q_0, q_1) (q_1 - q_0) = 0 $$
/// $$ p_1 = \frac{\partial L}{\partial v}(q_1, v_1) \qquad w(q_1) v_1 = 0 $$
///
/// A [`DiracRule`] gives `Ld` and `w_d`. A force of the Lagrangian is added to both of its derivatives, as an impulse (Marsden & West 3.2.5).
///
/// By the second line every state is a state of the continuous system. Its momentum satisfies the
/// [primary constraints](super::primary_constraints), and its velocity satisfies the constraints. For a regular Lagrangian this determines
/// μ, as in a step of [`Nonholonomic`](crate::constraints::Nonholonomic) systems, and the steps are the same. For a degenerate Lagrangian it also gives
/// the conditions on `q1` that the first line does not contain.
///
/// # Degenerate Lagrangians
///
/// Newton's iteration eliminates with complete pivoting and stops at the rank. Equations that depend on others have to be satisfied, and
/// `q1` has to be determined; otherwise an error names the component. A step is not always possible:
///
/// * A Lagrangian that is linear in the velocities, `L = a(q)·v − H(q)` with a linear a, such as that of point vortices, needs the rule
///   [`Midpoint`](DiracRule::Midpoint). Its steps are those of the one-stage Gauss method for H, and symplectic. If a is not linear,
///   `D2 Ld` is not `a(q1)`, and no such step exists. Its discrete Lagrangian is regular if `∂a/∂q − (∂a/∂q)ᵀ` is. A
///   [`VariationalIntegrator`](crate::variational::VariationalIntegrator) then takes its steps, with momenta off the primary constraints.
/// * Velocities without a mass, as in a loop of capacitors, need [`Trapezoid`](DiracRule::Trapezoid).
/// * The trapezoidal rule needs a start that satisfies the conditions on positions (secondary constraints).
///
/// # Cost
///
/// For n components and m constraints, an iteration eliminates a full matrix of 2(n + m) rows. It takes n(2n + 1) evaluations of L at each
/// point of the rule and at the end. A step allocates no memory. A step that fails leaves the state unchanged.
///
/// # Output, events and checkpoints
///
/// A state inside the last step is that of a shorter step from its start, with the order of the rule and the cost of a step. With
/// [`Midpoint`](DiracRule::Midpoint) a violation of conditions on positions at the start of the step changes its sign there, as it does from
/// step to step; an event close to the start of such a step may be missed. At a [wall](symplectic_core::Event::wall) the handler must leave
/// a momentum and a velocity that satisfy the constraints; otherwise the run ends with the error of such a start. A
/// [checkpoint](Run::checkpoint) is refused if L, its derivatives, the force or a row of w has other values near the state.
///
/// # Errors of a step
///
/// [`Error::ContradictoryStep`], [`Error::UndeterminedPosition`],
/// [`Core(DependentConstraints)`](symplectic_core::Error::DependentConstraints),
/// [`Core(MovingGradients)`](symplectic_core::Error::MovingGradients), [`Error::NoEndOfStep`],
/// [`Core(NonFinite)`](symplectic_core::Error::NonFinite), [`Core(EvaluationDimension)`](symplectic_core::Error::EvaluationDimension) and
/// [`Core(TimeResolution)`](symplectic_core::Error::TimeResolution). All other methods: [`Run`].
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::constraints::Gradients;
/// use symplectic::variational::{DiracSteps, DiracRule, DiracSystem, momentum_of_velocity};
/// use symplectic::system::Lagrangian;
/// use symplectic::{Scalar, State};
///
/// /// Two capacitors of 1 F in parallel, with an inductor of 2 H across them. The charges are those of the inductor and the capacitors.
/// struct Circuit;
///
/// type V3<T> = SVector<T, 3>;
///
/// impl Lagrangian for Circuit {
///     type Vector<T: Scalar> = V3<T>;
///
///     fn lagrangian<T: Scalar>(&self, _time: T, q: &V3<T>, v: &V3<T>) -> T {
///         v[0] * v[0] - (q[1] * q[1] + q[2] * q[2]) * T::from_f64(0.5)
///     }
/// }
///
/// impl DiracSystem for Circuit {
///     fn nonholonomic_constraints(&self) -> usize {
///         1
///     }
///
///     /// The currents at a node.
///     fn nonholonomic_rows<T: Scalar>(&self, _q: &V3<T>, rows: &mut Gradients<T>) {
///         for component in 0..3 {
///             rows.set(0, component, T::one());
///         }
///     }
/// }
///
/// # fn main() -> Result<(), symplectic::variational::Error> {
/// let q = V3::from([0.0, 1.0, 1.0]);
/// let p = momentum_of_velocity(&Circuit, 0.0, &q, &V3::zeros())?;
/// let mut run = DiracSteps::run(DiracRule::Trapezoid, Circuit, State::new(0.0, q, p), 0.01)?;
/// run.integrate_to(1.0)?;
/// let q = run.state().q;
/// // Capacities add up: the frequency is 1/√(2 · 2).
/// assert!((q[1] - 0.5_f64.cos()).abs() < 1e-5);
/// assert!((q[1] - q[2]).abs() < 1e-14); // the voltages
/// # Ok(())
/// # }
/// ```
pub type DiracIntegrator<L> = Run<DiracSteps<L>>;

/// The steps of a [`DiracIntegrator`].
#[derive(Clone)]
pub struct DiracSteps<L: DiracSystem> {
    system: L,
    equations: Equations<L>,
    steps: SymmetricSteps,
    ends: Ends<L::Vector<f64>>,
    velocity: L::Vector<f64>,
    /// The velocity at the start of the last step, or inside a step.
    next_velocity: L::Vector<f64>,
}

impl<L: DiracSystem> DiracSteps<L> {
    /// An integrator at `state`, with steps of size `step_size`, which is negative to go backward.
    ///
    /// The velocity that belongs to the momentum is sought from `v = 0`. There `∂²L/∂v∂v` must have the same rank as elsewhere: a momentum
    /// of `L = v⁴` is refused.
    ///
    /// # Errors
    ///
    /// [`Core(StepSize)`](symplectic_core::Error::StepSize), [`Core(Dimension)`](symplectic_core::Error::Dimension) if `q` and `p` differ,
    /// [`Core(NonFiniteState)`](symplectic_core::Error::NonFiniteState); [`Error::PrimaryConstraint`] if no velocity has this momentum,
    /// [`Core(InconsistentVelocity)`](symplectic_core::Error::InconsistentVelocity) if that velocity violates the constraints,
    /// [`Error::NoVelocity`] if none is found; [`Core(ConstraintCount)`](symplectic_core::Error::ConstraintCount) and
    /// [`Core(GradientPlace)`](symplectic_core::Error::GradientPlace) if the rows are wrong;
    /// [`Core(ResizedEvaluation)`](symplectic_core::Error::ResizedEvaluation).
    pub fn run(
        rule: DiracRule,
        system: L,
        state: State<L::Vector<f64>>,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        Self::by(SymmetricSteps::ONE, rule, system, state, step_size)
    }

    /// [`run`](Self::run) with the steps of a composition of Störmer–Verlet steps, made by
    /// [`composition!`](symplectic_core::composition). With the rule [`Trapezoid`](DiracRule::Trapezoid) it has the order of that composition for
    /// general Hamiltonians, `M::ORDERS.general`. For regular Lagrangians and those linear in the velocities it also has this order with
    /// [`Midpoint`](DiracRule::Midpoint).
    ///
    /// # Errors
    ///
    /// As for [`run`](Self::run). Does not compile with another method.
    pub fn composed<M: StoermerVerletSteps>(
        _method: M,
        rule: DiracRule,
        system: L,
        state: State<L::Vector<f64>>,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        Self::by(SymmetricSteps::of::<M>(), rule, system, state, step_size)
    }

    fn by(
        steps: SymmetricSteps,
        rule: DiracRule,
        system: L,
        state: State<L::Vector<f64>>,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        check_step_size(step_size)?;
        check_state(state.time, &state.q, &state.p, state.q.dimension())?;
        let velocity = consistent_velocity(&system, &state)?;
        let stepper = DiracSteps {
            equations: Equations::new(rule, &system, state.q.as_slice())?,
            system,
            steps,
            ends: Ends::new(state),
            next_velocity: velocity.clone(),
            velocity,
        };
        Ok(Run::of(stepper, step_size)?)
    }

    /// A velocity v with `∂L/∂v = p` and `w(q) v = 0`. Components that these equations leave free are those of the mean velocity of the
    /// last step, and 0 before the first step.
    pub const fn velocity(&self) -> &L::Vector<f64> {
        &self.velocity
    }

    /// The energy `p·v − L(t, q, v)`; it does not depend on velocities that p does not determine.
    pub fn energy(&self) -> f64 {
        let (State { time, q, p }, velocity) = (self.state(), self.velocity());
        dot(p, velocity) - self.system().lagrangian(*time, q, velocity)
    }

    /// The system.
    pub const fn system(&self) -> &L {
        &self.system
    }
}

impl<L: DiracSystem> DiracSteps<L> {
    /// Repeats the last step, from its start and a starting value of the velocity.
    fn stages_from(
        &mut self,
        size: f64,
        mut state: State<L::Vector<f64>>,
        mut velocity: L::Vector<f64>,
    ) -> Result<StagesOfStep<L::Vector<f64>>, Error> {
        let (start, end) = (state.time, self.ends.state.time);
        let mut stages = Vec::new();
        for part in self.steps.parts(start, size, end) {
            let q0 = state.q.clone();
            self.equations
                .take(&self.system, part, &mut state, &mut velocity)
                .map_err(|failure| failure.error(start, size, self.statistics().steps))?;
            stages.extend(self.equations.stages(&self.system, part, q0.as_slice()));
        }
        Ok(StagesOfStep::new(stages))
    }

    /// Computes a step into `next`, whose velocity is the starting value.
    fn attempt(&mut self, size: f64, end: f64) -> Result<(), Error> {
        let (start, number) = (self.ends.state.time, self.ends.begin());
        let Ends { state, next, .. } = &mut self.ends;
        next.copy_from(state);
        for part in self.steps.parts(start, size, end) {
            self.equations
                .take(&self.system, part, next, &mut self.next_velocity)
                .map_err(|failure| failure.error(start, size, number))?;
        }
        Ok(())
    }

    /// Lets the next attempt start from the velocity with which a new integrator starts; returns whether it differs.
    fn begin_as_first(&mut self) -> bool {
        match consistent_velocity(&self.system, &self.ends.state) {
            Ok(velocity) if velocity.as_slice() != self.velocity.as_slice() => {
                self.next_velocity = velocity;
                true
            }
            _ => false,
        }
    }
}

impl<L: DiracSystem> StepWithStages for DiracIntegrator<L> {
    type Vector = L::Vector<f64>;

    /// The force of a stage is `∂L/∂q + f`, without the impulses of constraints.
    ///
    /// In a step the momentum map of a linear symmetry of L and of the constraints changes by exactly the [impulse](StagesOfStep::impulse)
    /// of the force. The energy changes by its [work](StagesOfStep::work), up to an error of the order of the method. The step is taken
    /// twice.
    fn step_with_stages(&mut self) -> Result<StagesOfStep<L::Vector<f64>>, Error> {
        let (state, velocity) = (self.state().clone(), self.stepper().velocity().clone());
        self.step_at_once()?;
        let (size, run) = (self.step_size(), self.stepper_mut());
        let stages = run.stages_from(size, state.clone(), velocity);
        let take = |run: &mut DiracSteps<L>| {
            let velocity = consistent_velocity(&run.system, &state)?;
            run.stages_from(size, state, velocity)
        };
        or_as_first_step(run, stages, |_| true, take)
    }
}

impl<L: DiracSystem> Stepper for DiracSteps<L> {
    type State = State<L::Vector<f64>>;
    type Error = Error;
    type Pace = Equal;
    type Saved = <Self as StepsBeside>::Moving;

    fn state(&self) -> &Self::State {
        &self.ends.state
    }

    fn statistics(&self) -> &Statistics {
        &self.ends.statistics
    }

    fn statistics_mut(&mut self) -> &mut Statistics {
        &mut self.ends.statistics
    }

    fn set_state(&mut self, state: &Self::State) -> Result<(), Error> {
        self.ends.check(state)?;
        self.velocity = consistent_velocity(&self.system, state)?;
        copy(&mut self.next_velocity, &self.velocity);
        self.ends.set(state);
        Ok(())
    }

    fn advance(&mut self, size: f64, end: f64) -> Result<(), Error> {
        copy(&mut self.next_velocity, &self.velocity);
        let taken = self.attempt(size, end);
        or_as_first_step(self, taken, Self::begin_as_first, |run| {
            run.attempt(size, end)
        })?;
        self.ends.end(size, end);
        core::mem::swap(&mut self.velocity, &mut self.next_velocity);
        Ok(())
    }

    fn save(&self) -> Self::Saved {
        self.moving()
    }

    fn go_back(&mut self, saved: &Self::Saved) {
        (self.ends, [self.velocity, self.next_velocity]) = saved.clone();
    }

    fn may_split(&self, error: &Error) -> bool {
        error.depends_on_the_size()
    }
}

impl<L: DiracSystem> StepsBeside for DiracSteps<L> {
    type Vector = L::Vector<f64>;
    type Moving = (Ends<L::Vector<f64>>, [L::Vector<f64>; 2]);

    fn moving(&self) -> Self::Moving {
        let velocities = [&self.velocity, &self.next_velocity].map(Clone::clone);
        (self.ends.clone(), velocities)
    }

    fn exchange(&mut self, (ends, [velocity, next]): &mut Self::Moving) {
        core::mem::swap(&mut self.ends, ends);
        core::mem::swap(&mut self.velocity, velocity);
        core::mem::swap(&mut self.next_velocity, next);
    }

    /// Newton's iteration begins with the velocity at the start of the last step.
    fn begin_beside(&mut self, (run, [_, start]): &Self::Moving, state: &Self::State, _: f64) {
        self.ends.set_beside(run, state);
        copy(&mut self.velocity, start);
    }

    fn last_step(&self) -> Option<(&Self::State, f64)> {
        self.ends.last_step()
    }
}

impl<L: DiracSystem> SaveWords for DiracSteps<L> {
    fn blank_checkpoint(&self) -> Checkpoint {
        let definition = format!("{:?}, {}", self.equations.rule, self.steps.definition());
        Checkpoint::of_method(
            "steps of a Dirac system",
            definition,
            self.velocity.dimension(),
        )
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.ends);
        for velocity in [&mut self.velocity, &mut self.next_velocity] {
            vector_words(core::slice::from_mut(velocity), visit);
        }
    }

    fn fingerprint(&mut self) -> Vec<f64> {
        self.equations
            .fingerprint(&self.system, &self.ends.state, &self.velocity)
    }
}
