//! Steps of a Lagrangian.

use super::coefficients::StageCoefficients;
use super::legendre::{momentum_of_velocity, velocity_near, velocity_of_momentum};
use super::linear::{LinearConstraint, is_regular_beside};
use super::stages::{Kept, Stages, Start};
use crate::Error;
use crate::variational::ends::Ends;
use crate::variational::given_ends::GeneratingFunctions;
use crate::variational::stages::{StagesOfStep, StepWithStages};
use crate::variational::two_ends::dot;
use alloc::format;
use alloc::vec::Vec;
use symplectic_core::inside::{
    SaveWords, StepsBeside, beside, check_state, check_step_size, or_as_first_step, words,
};
use symplectic_core::solver::{Visit, Words};
use symplectic_core::stepper::{Equal, Stepper};
use symplectic_core::system::Lagrangian;
use symplectic_core::{
    Checkpoint, Error as CoreError, General, Method, ProvedFor, Quantity, Run, State, Statistics,
    Vector,
};

/// Takes the steps of a partitioned Runge–Kutta method in Lagrangian form (Marsden & West 2001, 2.6.1):
///
/// ```text
/// Q_i = q0 + h Σ_j a_ij V_j      P_i = p0 + h Σ_j ã_ij (∂L/∂q + f)_j      P_i = ∂L/∂v(t0 + c_i h, Q_i, V_i)
/// q1 = q0 + h Σ_i b_i V_i        p1 = p0 + h Σ_i b̃_i (∂L/∂q + f)_i
/// ```
///
/// $$ Q_i = q_0 + h \sum_j a_{ij} V_j \qquad P_i = p_0 + h \sum_j \tilde a_{ij} \Big( \frac{\partial L}{\partial q} + f \Big)_j \qquad
/// P_i = \frac{\partial L}{\partial v}(t_0 + c_i h, Q_i, V_i) $$
///
/// They are the steps of the same method for the Hamiltonian of L, but do not need it: the unknowns are the stage velocities. If L depends
/// on time and `c̃ ≠ c`, as for Störmer–Verlet, the steps differ but have the same order. L need not be quadratic in v.
///
/// A degenerate L is refused, because steps leave its primary constraints. The exception is `L = a(q)·v − H(q)` with a linear, for which
/// Gauss methods stay on `p = a(q)`; every step is checked. [`DiracIntegrator`](super::super::DiracIntegrator) takes other degenerate ones.
///
/// Without a force the step has the discrete Lagrangian `Ld = h Σ_i b_i L(Q_i, V_i)`, whose value is
/// [`action`](LagrangianSteps::action). It is symplectic, and conserves the momentum maps of linear
/// symmetries of L.
///
/// # Cost
///
/// Newton's iteration begins with the velocities and the factors of the previous step, and factors a new matrix when it contracts slowly.
/// For s stages and n components, a new matrix takes s n(2n + 1) evaluations of L by hyper-dual numbers and the elimination of a full
/// matrix of size sn. An iteration takes s evaluations of L with its [gradient](Lagrangian::gradient), or s n by hyper-dual numbers. A step
/// allocates no memory. A step that fails leaves the state unchanged.
///
/// A state inside the last step is that of a shorter step from its start, with the order of the method and the cost of a step. A
/// [checkpoint](Run::checkpoint) is refused if L, its derivatives or the force has other values near the state.
///
/// # Errors of a step
///
/// [`Error::IrregularLagrangian`], [`Error::NoEndOfStep`], [`Core(NonFinite)`](CoreError::NonFinite),
/// [`Core(EvaluationDimension)`](CoreError::EvaluationDimension) and [`Core(TimeResolution)`](CoreError::TimeResolution);
/// [`Error::DegenerateLagrangian`] if L is linear in v and the step leaves `p = ∂L/∂v`. A new state off `p = ∂L/∂v` is then refused with
/// [`Error::PrimaryConstraint`]. All other methods: [`Run`].
///
/// ```
/// symplectic::tableau! { Gauss3 { basis: polynomial(3), nodes: gauss(3) } }
/// use symplectic::nalgebra::SVector;
/// use symplectic::variational::LagrangianSteps;
/// use symplectic::system::Lagrangian;
/// use symplectic::Scalar;
///
/// /// A relativistic particle in Kepler's potential: L = −√(1 − |v|²) + 1/|q|, with the speed of light 1.
/// struct Relativistic;
///
/// impl Lagrangian for Relativistic {
///     type Vector<T: Scalar> = SVector<T, 2>;
///
///     fn lagrangian<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, v: &SVector<T, 2>) -> T {
///         q.dot(q).sqrt().recip() - (T::one() - v.dot(v)).sqrt()
///     }
/// }
///
/// # fn main() -> Result<(), symplectic::variational::Error> {
/// let (q, v) = (SVector::from([4.0, 0.0]), SVector::from([0.0, 0.4]));
/// let mut run = LagrangianSteps::from_velocity(Gauss3, Relativistic, 0.0, q, v, 0.5)?;
/// let energy = run.stepper().energy()?;
/// run.integrate_to(1000.0)?;
/// assert!((run.stepper().energy()? - energy).abs() < 1e-6);
/// let state = run.state();
/// let angular_momentum = 4.0 * 0.4 / (1.0_f64 - 0.16).sqrt();
/// assert!((state.q.perp(&state.p) - angular_momentum).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
pub type LagrangianIntegrator<L> = Run<LagrangianSteps<L>>;

/// The steps of a [`LagrangianIntegrator`].
#[derive(Clone)]
pub struct LagrangianSteps<L: Lagrangian> {
    lagrangian: L,
    ends: Ends<L::Vector<f64>>,
    stages: Stages<L>,
    action: Option<f64>,
    /// Name and definition of the method.
    method: &'static str,
    definition: &'static str,
    /// Checks that momenta stay on `p = a(q)`, if `L = a(q)·v − H(q)`.
    constraint: Option<LinearConstraint<L>>,
}

impl<L: Lagrangian> LagrangianSteps<L> {
    /// An integrator at `state`, with steps of size `step_size`, which is negative to go backward.
    ///
    /// # Errors
    ///
    /// [`Core(StepSize)`](CoreError::StepSize), [`Core(Dimension)`](CoreError::Dimension) if `q` and `p` differ,
    /// [`Core(NonFiniteState)`](CoreError::NonFiniteState). [`Error::DegenerateLagrangian`] if `∂²L/∂v∂v` is singular where Newton's
    /// iteration for the velocity at the start needs it, from v = 0 and from v = p, and L is not linear in v. [`Error::PrimaryConstraint`]
    /// if L is linear in v and `p ≠ ∂L/∂v`.
    pub fn run<M: Method + ProvedFor<General>>(
        _method: M,
        lagrangian: L,
        state: State<L::Vector<f64>>,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        let mut run = Self::by::<M>(StageCoefficients::of::<M>(), lagrangian, state, step_size)?;
        run.stepper_mut().find_velocity::<M>(true)?;
        Ok(run)
    }

    /// An integrator by the Galerkin method of the basis and the quadrature formula of `M` (Leok & Zhang 2011, 38), at `state`. The
    /// positions inside a step are combinations of integrals of the s basis functions. The action is that of the quadrature formula, with
    /// r ≥ s nodes. Of all such paths the step takes the one with stationary action. The space of the basis has to contain the constants.
    ///
    /// For r = s it is the Runge–Kutta method. For r > s, `tableau! { … basis: …, quadrature: … }`, it is that method only if
    /// `L = v·Mv/2 − U(q)`. On other systems both have the order of `M` and differ by their errors. There are s unknown velocities, not r.
    ///
    /// Newton's iteration of the first step begins at rest, or with the velocity of the start if that cannot be found from rest.
    ///
    /// # Errors
    ///
    /// As for [`run`](Self::run), and [`Error::NoConstants`]. For r > s an L that is linear in v
    /// is refused too.
    ///
    /// ```
    /// symplectic::tableau! { Rectangular { basis: polynomial(2), quadrature: gauss(3) } }
    /// use symplectic::State;
    /// use symplectic::variational::LagrangianSteps;
    ///
    /// symplectic::lagrangian! {
    ///     /// A particle on a rotating parabola.
    ///     Bead q: [x], v: [vx];
    ///     L = (1 + x^2) vx^2/2 - x^2/4
    /// }
    ///
    /// # fn main() -> Result<(), symplectic::variational::Error> {
    /// let start = State::from_arrays(0.0, [1.0], [0.0]);
    /// let mut run = LagrangianSteps::galerkin(Rectangular, Bead, start, 0.1)?;
    /// let energy = run.stepper().energy()?;
    /// run.integrate_to(100.0)?;
    /// assert!((run.stepper().energy()? - energy).abs() < 1e-6);
    /// # Ok(())
    /// # }
    /// ```
    pub fn galerkin<M: Method + ProvedFor<General>>(
        _method: M,
        lagrangian: L,
        state: State<L::Vector<f64>>,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        let coefficients = StageCoefficients::galerkin::<M>()?;
        let mut run = Self::by::<M>(coefficients, lagrangian, state, step_size)?;
        run.stepper_mut()
            .find_velocity::<M>(M::FUNCTIONS == M::STAGES)?;
        Ok(run)
    }

    fn by<M: Method>(
        coefficients: StageCoefficients,
        lagrangian: L,
        state: State<L::Vector<f64>>,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        let n = state.q.dimension();
        check_state(state.time, &state.q, &state.p, n)?;
        lagrangian.check_dimension(n)?;
        check_force(&lagrangian, &state)?;
        check_step_size(step_size)?;
        let stepper = LagrangianSteps {
            stages: Stages::new(coefficients, n)?,
            lagrangian,
            ends: Ends::new(state),
            action: None,
            method: M::NAME,
            definition: M::DEFINITION,
            constraint: None,
        };
        Ok(Run::of(stepper, step_size)?)
    }

    /// [`run`](Self::run) with the momentum `∂L/∂v` of the velocity `v`, where Newton's iteration
    /// begins; that of [`run`](Self::run) begins at rest.
    ///
    /// # Errors
    ///
    /// As for [`run`](Self::run), and [`Core(NonFiniteState)`](CoreError::NonFiniteState) if the momentum is not finite.
    pub fn from_velocity<M: Method + ProvedFor<General>>(
        _method: M,
        lagrangian: L,
        time: f64,
        q: L::Vector<f64>,
        v: L::Vector<f64>,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        let p = momentum_of_velocity(&lagrangian, time, &q, &v)?;
        let state = State::new(time, q, p);
        let coefficients = StageCoefficients::of::<M>();
        let mut run = Self::by::<M>(coefficients, lagrangian, state, step_size)?;
        let State { q, p, .. } = run.state();
        if let Err(Error::NoVelocity {
            component: Some(component),
            ..
        }) = velocity_near(run.stepper().lagrangian(), time, q, p, v.clone())
        {
            run.stepper_mut().allow_linear::<M>(true, component)?;
        }
        run.stepper_mut().stages.begin_with(v.as_slice());
        Ok(run)
    }

    /// The velocity of the present state, as from [`velocity_of_momentum`], but Newton's iteration begins with the mean velocity of the
    /// last step.
    ///
    /// # Errors
    ///
    /// Those of [`velocity_of_momentum`].
    pub fn velocity(&self) -> Result<L::Vector<f64>, Error> {
        let State { time, q, p } = self.state();
        let LagrangianSteps {
            stages, lagrangian, ..
        } = self;
        let mut mean = q.zeros_like();
        stages.add_mean_velocity(mean.as_mut_slice());
        velocity_near(lagrangian, *time, q, p, mean)
            .or_else(|_| velocity_of_momentum(lagrangian, *time, q, p))
    }

    /// The energy `p·v − L` of the present state.
    ///
    /// # Errors
    ///
    /// Those of [`velocity_of_momentum`].
    pub fn energy(&self) -> Result<f64, Error> {
        let State { time, q, p } = self.state();
        let v = self.velocity()?;
        Ok(dot(p, &v) - self.lagrangian().lagrangian(*time, q, &v))
    }

    /// The discrete Lagrangian `h Σ_i b_i L_i` of the last step, or of the last part of a [split](symplectic_core::Retry) step; `None`
    /// before the first step.
    pub const fn action(&self) -> Option<f64> {
        self.action
    }

    /// The Lagrangian.
    pub const fn lagrangian(&self) -> &L {
        &self.lagrangian
    }
}

impl<L: Lagrangian> LagrangianSteps<L> {
    /// Finds the velocity of the start: from rest, or, because L may be degenerate at rest only, as v⁴ is, from v = p. A degenerate L is
    /// refused, unless it `may_be_linear` in the velocities and is.
    fn find_velocity<M: Method>(&mut self, may_be_linear: bool) -> Result<(), Error> {
        let State { time, q, p } = &self.ends.state;
        let near = |velocity| velocity_near(&self.lagrangian, *time, q, p, velocity);
        let Err(error) = near(q.zeros_like()) else {
            return Ok(());
        };
        if let Ok(velocity) = near(p.clone()) {
            self.stages.begin_with(velocity.as_slice());
            return Ok(());
        }
        let Error::NoVelocity {
            component: Some(component),
            ..
        } = error
        else {
            // The first step says what is wrong.
            return Ok(());
        };
        self.allow_linear::<M>(may_be_linear, component)
    }

    /// Keeps an L that is linear in the velocities if it `may_be`, and one that is degenerate at the start only; refuses others, which do not
    /// determine this component.
    fn allow_linear<M: Method>(&mut self, may_be: bool, component: usize) -> Result<(), Error> {
        let State { time, q, p } = &self.ends.state;
        let degenerate = Error::DegenerateLagrangian {
            method: M::NAME,
            component,
        };
        if !may_be {
            return Err(degenerate);
        }
        let Some(mut constraint) = LinearConstraint::new(&self.lagrangian, *time, q)? else {
            return match is_regular_beside(&self.lagrangian, *time, q, p)? {
                true => Ok(()),
                false => Err(degenerate),
            };
        };
        if let Some((component, value)) = constraint.violation(&self.lagrangian, *time, q, p) {
            return Err(Error::PrimaryConstraint { component, value });
        }
        self.constraint = Some(constraint);
        Ok(())
    }

    /// Computes a step into `next`.
    fn attempt(&mut self, size: f64, end: f64) -> Result<(), Error> {
        let number = self.ends.begin();
        let Ends { state, next, .. } = &mut self.ends;
        let start = Start {
            time: state.time,
            size,
            q: state.q.as_slice(),
            p: state.p.as_slice(),
        };
        let (q1, p1) = (next.q.as_mut_slice(), next.p.as_mut_slice());
        self.stages
            .take(&self.lagrangian, start, q1, p1)
            .map_err(|failure| failure.error(Quantity::Lagrangian, start.time, size, number))?;
        let State { q, p, .. } = &*next;
        if let Some(constraint) = &mut self.constraint
            && let Some((component, _)) = constraint.violation(&self.lagrangian, end, q, p)
        {
            // The next attempt begins as the first step did.
            self.stages.forget();
            let method = self.method;
            return Err(Error::DegenerateLagrangian { method, component });
        }
        Ok(())
    }

    /// Lets the next step start like that of a new integrator at the present state; returns `true`.
    fn begin_as_first(&mut self) -> bool {
        let Self {
            stages,
            lagrangian,
            ends,
            ..
        } = self;
        let State { time, q, p } = &ends.state;
        let velocity = || velocity_near(&*lagrangian, *time, q, p, p.clone()).ok();
        stages.begin_as_first(velocity);
        true
    }
}

impl<L: Lagrangian> StepWithStages for LagrangianIntegrator<L> {
    type Vector = L::Vector<f64>;

    /// The force of a stage is `∂L/∂q + f`.
    ///
    /// In a step the momentum map of a linear symmetry of L changes by exactly the [impulse](StagesOfStep::impulse) of the force. The
    /// energy changes by its [work](StagesOfStep::work), up to an error of the order of the method.
    ///
    /// ```
    /// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
    /// use symplectic::State;
    /// use symplectic::variational::{LagrangianSteps, StepWithStages};
    ///
    /// symplectic::lagrangian! {
    ///     /// A particle that is slowed down.
    ///     Slowed q: [x], v: [vx];
    ///     L = vx^2/2
    ///     force: { x = -vx/4 }
    /// }
    ///
    /// # fn main() -> Result<(), symplectic::variational::Error> {
    /// let mut run = LagrangianSteps::run(Gauss2, Slowed, State::from_arrays(0.0, [0.0], [1.0]), 0.1)?;
    /// // Translations: J = p.
    /// let impulse = run.step_with_stages()?.impulse(|_, out| out[0] = 1.0);
    /// assert!((run.state().p[0] - 1.0 - impulse).abs() < 1e-15 && impulse < -0.02);
    /// # Ok(())
    /// # }
    /// ```
    fn step_with_stages(&mut self) -> Result<StagesOfStep<L::Vector<f64>>, Error> {
        let State { time, q, p } = self.state().clone();
        self.step_at_once()?;
        let start = Start {
            time,
            size: self.step_size(),
            q: q.as_slice(),
            p: p.as_slice(),
        };
        let LagrangianSteps {
            stages, lagrangian, ..
        } = self.stepper_mut();
        let stages = stages.of_step(lagrangian, start);
        Ok(StagesOfStep::new(stages))
    }
}

impl<L: Lagrangian> Stepper for LagrangianSteps<L> {
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

    /// Newton's iteration begins where it began in the first step of this stepper.
    fn set_state(&mut self, state: &Self::State) -> Result<(), Error> {
        let State { time, q, p } = state;
        self.ends.check(state)?;
        if let Some(constraint) = &mut self.constraint
            && let Some((component, value)) =
                constraint.violation_at_start(&self.lagrangian, *time, q, p)
        {
            return Err(Error::PrimaryConstraint { component, value });
        }
        self.ends.set(state);
        self.stages.forget();
        self.action = None;
        Ok(())
    }

    fn advance(&mut self, size: f64, end: f64) -> Result<(), Error> {
        let are_new = self.stages.are_new();
        let taken = self.attempt(size, end);
        let forget = |run: &mut Self| !are_new && run.begin_as_first();
        or_as_first_step(self, taken, forget, |run| run.attempt(size, end))?;
        self.ends.end(size, end);
        self.action = Some(self.stages.action(size));
        Ok(())
    }

    fn save(&self) -> Self::Saved {
        self.moving()
    }

    fn go_back(&mut self, saved: &Self::Saved) {
        self.exchange(&mut saved.clone());
    }

    fn may_split(&self, error: &Error) -> bool {
        error.depends_on_the_size()
    }
}

/// What a step changes.
#[derive(Clone)]
pub struct Moving<V> {
    ends: Ends<V>,
    action: Option<f64>,
    kept: Kept,
    /// The largest term of the primary constraints.
    size: f64,
}

impl<L: Lagrangian> StepsBeside for LagrangianSteps<L> {
    type Vector = L::Vector<f64>;
    type Moving = Moving<L::Vector<f64>>;

    fn moving(&self) -> Self::Moving {
        let constraint = self.constraint.as_ref();
        Moving {
            ends: self.ends.clone(),
            action: self.action,
            kept: self.stages.kept.clone(),
            size: constraint.map_or(0.0, |constraint| constraint.size),
        }
    }

    fn exchange(&mut self, moving: &mut Self::Moving) {
        core::mem::swap(&mut self.ends, &mut moving.ends);
        core::mem::swap(&mut self.action, &mut moving.action);
        core::mem::swap(&mut self.stages.kept, &mut moving.kept);
        if let Some(constraint) = &mut self.constraint {
            core::mem::swap(&mut constraint.size, &mut moving.size);
        }
    }

    /// Newton's iteration begins with the velocities of the last step.
    fn begin_beside(&mut self, run: &Self::Moving, state: &Self::State, _size: f64) {
        self.ends.set_beside(&run.ends, state);
        self.stages.kept.begin_with_those_of(&run.kept);
        if let Some(constraint) = &mut self.constraint {
            constraint.size = run.size;
        }
    }

    fn last_step(&self) -> Option<(&Self::State, f64)> {
        self.ends.last_step()
    }
}

impl<L: Lagrangian> SaveWords for LagrangianSteps<L> {
    fn blank_checkpoint(&self) -> Checkpoint {
        let form = match self.stages.is_rectangular() {
            true => "Galerkin",
            false => "Lagrangian",
        };
        let linear = match self.constraint {
            Some(_) => " for L = a(q)·v − H(q)",
            None => "",
        };
        let dimension = self.ends.state.q.dimension();
        let definition = format!("{}{linear}", self.definition);
        Checkpoint::of_method(&format!("{}, {form}", self.method), definition, dimension)
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.ends, self.action, self.stages.kept);
        if let Some(constraint) = &mut self.constraint {
            constraint.words(visit);
        }
    }

    fn fingerprint(&mut self) -> Vec<f64> {
        let State { time, q, .. } = &self.ends.state;
        self.stages.fingerprint(&self.lagrangian, *time, q)
    }
}

impl<L: Lagrangian + Clone> GeneratingFunctions for LagrangianIntegrator<L> {
    type Vector = L::Vector<f64>;

    /// Does not compile with a force.
    fn step_with_action(&self, start: Self::State) -> Result<(Self::State, f64), Error> {
        const {
            assert!(
                !L::FORCED,
                "with a force a step is not symplectic and has no generating function"
            )
        }
        let mut run = self.clone();
        run.set_state(start)?;
        run.step_at_once()?;
        let action = run.stepper().action().unwrap_or(f64::NAN);
        Ok((run.into_state(), action))
    }
}

/// Checks that a force is declared.
fn check_force<L: Lagrangian>(
    lagrangian: &L,
    State { time, q, p }: &State<L::Vector<f64>>,
) -> Result<(), CoreError> {
    if L::FORCED {
        return Ok(());
    }
    let mut force = q.zeros_like();
    lagrangian.force(*time, q, &beside(p), &mut force);
    match force.as_slice().iter().position(|&force| force != 0.0) {
        Some(component) => Err(CoreError::NotForced { component }),
        None => Ok(()),
    }
}
