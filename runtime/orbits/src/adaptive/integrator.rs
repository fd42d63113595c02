//! Reversible steps of variable size: the integrating controller.

use core::fmt;

use super::monitor::{Monitor, Slopes, monitor_at, seen, value_at};
use crate::Error;
use symplectic_core::inside::{
    advance_in_time, check_state, check_step_size, fast_two_sum, parts_of, two_sum,
};
use symplectic_core::output::DenseOutput;
use symplectic_core::proved::SymmetricFor;
use symplectic_core::solver::Solver;
use symplectic_core::stepper::{Own, Stepper};
use symplectic_core::{
    Compensated, Integrator, Method, ProvedFor, Retry, Run, State, Statistics, Summation, System,
    Vector,
};

/// A symmetric method with reversible steps of variable size `h ≈ ε σ(q)`: the integrating controller of Hairer & Söderlind (2005;
/// Hairer, Lubich & Wanner, *Geometric numerical integration*, VIII.3.2).
///
/// The step density `z ≈ 1/σ` is an additional variable. It is kicked before and after a step Φ of the method:
///
/// ```text
/// z ← z + ε/2 G(q, p)      (q, p) ← Φ_{ε/z}(q, p)      t ← t + ε/z      z ← z + ε/2 G(q, p)
/// G = −∇σ·q'/σ             z_0 = 1/σ(q_0)
/// ```
///
/// $$ z_{n+1/2} = z_n + \frac{\varepsilon}{2} G(q_n, p_n) \qquad (q, p)_{n+1} = \Phi_{\varepsilon/z_{n+1/2}}((q, p)_n) \qquad
/// z_{n+1} = z_{n+1/2} + \frac{\varepsilon}{2} G(q_{n+1}, p_{n+1}) $$
///
/// The map of (q, p, z) is symmetric, and reversible if the flow is. So the energy of a reversible system does not drift. It would if the
/// step size were a function of the state before the step. The map is not symplectic, so the energy of other systems may drift: use
/// [`Poincare`](super::Poincare) or [`Logarithmic`](super::Logarithmic) for them.
///
/// The order in ε is that of the method: t is the sum of the step sizes. Steps are explicit if the method is. Each step costs one
/// additional derivative of the [`Monitor`], and one velocity unless it [is the momentum](symplectic_core::system::Masses::Unit).
///
/// # Errors of a step
///
/// In [`Error::Core`] those of an [`Integrator`], and `Monitor` if `∇σ·q'/σ` is not finite, or if dual numbers evaluate it and σ is not
/// positive; [`Error::StepDensity`] if z is no longer positive, or `ε/z` overflows. State and step density are then unchanged. All other methods:
/// [`Run`].
///
/// # Back to the start
///
/// [`reverse`](AdaptiveSteps::reverse) reverses the direction of the run. The first step back has exactly the size of the last step. The sizes of the
/// other steps, like positions and momenta, agree with those of the forward run up to rounding.
///
/// # Output
///
/// Output does not change the steps. A run ends with the first step that reaches or passes its end time. States at times inside a step come
/// from the [dense output](AdaptiveSteps::dense), or from a shorter step with the same start.
///
/// ```
/// use symplectic::adaptive::{AdaptiveSteps, DistancePower, Error};
/// use symplectic::State;
///
/// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
/// symplectic::hamiltonian! {
///     Kepler
///     q: [x, y], p: [px, py];
///     H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)
/// }
///
/// # fn main() -> Result<(), Error> {
/// // The pericentre of an orbit of eccentricity 0.9.
/// let start = State::from_arrays(0.0, [0.1, 0.0], [0.0, 19_f64.sqrt()]);
/// let mut run = AdaptiveSteps::run(VelocityVerlet, Kepler, DistancePower(1.5), start, 0.02)?;
/// let before = run.stepper().energy().expect("the system has an energy");
/// run.integrate_to(20.0 * core::f64::consts::TAU)?;
/// let after = run.stepper().energy().expect("the system has an energy");
/// assert!((after - before).abs() < 1e-3);
/// # Ok(())
/// # }
/// ```
///
/// A method that is not symmetric does not compile:
///
/// ```compile_fail,E0277
/// use symplectic::adaptive::{AdaptiveSteps, DistancePower, Error};
/// use symplectic::State;
///
/// symplectic::tableau! { SymplecticEuler { basis: polynomial(1), nodes: [0] } }
/// symplectic::hamiltonian! { Kepler q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2) }
///
/// let start = State::from_arrays(0.0, [0.1, 0.0], [0.0, 19_f64.sqrt()]);
/// let run = AdaptiveSteps::run(SymplecticEuler, Kepler, DistancePower(1.5), start, 0.02);
/// ```
pub type Adaptive<M, S, W, V, R = Compensated, N = <S as System<V>>::Solver> =
    Run<AdaptiveSteps<M, S, W, V, R, N>>;

/// The steps of an [`Adaptive`] run.
pub struct AdaptiveSteps<
    M: Method,
    S: System<V>,
    W,
    V: Vector,
    R: Summation = Compensated,
    N: Solver<V, S> = <S as System<V>>::Solver,
> {
    pub(super) integrator: Integrator<M, S, V, R, N>,
    pub(super) monitor: W,
    pub(super) slopes: Slopes<V>,
    velocity: V,
    pub(super) controller: Controller,
}

/// The controller of the step sizes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Controller {
    pub(super) epsilon: f64,
    /// `z_{n+1/2}` of the last step, or `z_0` before the first step.
    pub(super) density: f64,
    /// The factor ε/2 of the second kick of z in the last step, which is applied in the next step; 0 before the first step.
    pub(super) unfinished: f64,
    /// The rounding error of the time of the state; it prevents errors from accumulating.
    pub(super) time_low: f64,
    /// The step size at the start. An error names the monitor only if this step would change the time.
    pub(super) first_size: f64,
}

impl Controller {
    /// The controller at the start, with the value of the monitor there.
    const fn new(epsilon: f64, monitor: f64) -> Self {
        Self {
            epsilon,
            density: 1.0 / monitor,
            unfinished: 0.0,
            time_low: 0.0,
            first_size: epsilon * monitor,
        }
    }

    fn step_size(&self) -> f64 {
        self.epsilon / self.density
    }
}

impl<M, S, W, V> AdaptiveSteps<M, S, W, V>
where
    M: Method,
    S: System<V>,
    W: Monitor,
    V: Vector<Scalar = f64>,
{
    /// An integrator with steps of variable size: see [`Adaptive`]. `epsilon` is the ε of the step size `h ≈ ε σ(q)`; a negative one steps
    /// backward.
    ///
    /// Does not compile unless the method is symmetric on systems of this class.
    ///
    /// # Errors
    ///
    /// [`Error::Core`] with those of [`Integrator::new`], `StepSize` for ε, and `Monitor` if σ is not finite and positive at the start.
    pub fn run(
        method: M,
        system: S,
        monitor: W,
        start: State<V>,
        epsilon: f64,
    ) -> Result<Adaptive<M, S, W, V>, Error>
    where
        M: ProvedFor<S::Class> + SymmetricFor<S::Class>,
    {
        Self::of(
            Integrator::new(method, system, start, 1.0)?,
            monitor,
            epsilon,
        )
    }
}

impl<M, S, W, V, R, N> AdaptiveSteps<M, S, W, V, R, N>
where
    M: Method,
    S: System<V>,
    W: Monitor,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    /// Continues from the state of an integrator, which may have any sums and solver. Its step size is not used. A failed step is not
    /// [split](Retry), because its parts would not be symmetric.
    ///
    /// Does not compile unless the method is symmetric on systems of this class.
    ///
    /// # Errors
    ///
    /// [`Error::Core`] with `StepSize` for ε, and with `Monitor` if σ is not finite and positive at the start.
    ///
    /// ```
    /// use symplectic::adaptive::{AdaptiveSteps, DistancePower, Error};
    /// use symplectic::nalgebra::Vector2;
    /// use symplectic::solver::ByNewton;
    /// use symplectic::{Integrator, State, acceleration};
    ///
    /// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
    ///
    /// # fn main() -> Result<(), Error> {
    /// let kepler = acceleration(|_time, q: &Vector2<f64>, acceleration| *acceleration = -q / q.norm().powi(3));
    /// let start = State::from_arrays(0.0, [0.1, 0.0], [0.0, 19_f64.sqrt()]);
    /// let newton = Integrator::plain(Gauss2, kepler, start, 1.0)?.by_newton();
    /// let mut run = AdaptiveSteps::of(newton, DistancePower(1.5), 0.1)?;
    /// let end = run.integrate_to(core::f64::consts::TAU)?;
    /// assert!((end.q[0] - 0.1).abs() < 0.01);
    /// # Ok(())
    /// # }
    /// ```
    pub fn of(
        mut integrator: Integrator<M, S, V, R, N>,
        monitor: W,
        epsilon: f64,
    ) -> Result<Adaptive<M, S, W, V, R, N>, Error>
    where
        M: SymmetricFor<S::Class>,
    {
        check_step_size(epsilon)?;
        let State { time, q, .. } = integrator.state();
        let value = value_at(&monitor, seen::<S, V>(q)).map_err(monitor_at(*time))?;
        let (slopes, velocity) = (Slopes::like(q), q.zeros_like());
        integrator.set_retry(Retry::Never);
        let last_event = parts_of(&mut integrator).last_event.take();
        let stepper = Self {
            integrator,
            monitor,
            slopes,
            velocity,
            controller: Controller::new(epsilon, value),
        };
        let mut run = Run::of(stepper, 1.0)?;
        *parts_of(&mut run).last_event = last_event;
        Ok(run)
    }

    /// Reverses the direction of the run: the next step undoes the last one.
    ///
    /// ```
    /// use symplectic::adaptive::{AdaptiveSteps, DistancePower, Error};
    /// use symplectic::nalgebra::Vector2;
    /// use symplectic::{State, acceleration};
    ///
    /// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    ///
    /// # fn main() -> Result<(), Error> {
    /// let kepler = acceleration(|_time, q: &Vector2<f64>, acceleration| *acceleration = -q / q.norm().powi(3));
    /// let start = State::from_arrays(0.0, [0.1, 0.0], [0.0, 19_f64.sqrt()]);
    /// let mut run = AdaptiveSteps::run(VelocityVerlet, kepler, DistancePower(1.5), start.clone(), 0.05)?;
    /// run.take_steps(100)?;
    /// let size = run.step_size();
    /// run.stepper_mut().reverse();
    /// run.step()?;
    /// assert_eq!(run.step_size(), -size);
    /// run.take_steps(99)?;
    /// assert!((run.state().q - start.q).norm() < 1e-11);
    /// # Ok(())
    /// # }
    /// ```
    pub const fn reverse(&mut self) {
        self.controller.epsilon = -self.controller.epsilon;
    }
}

impl<M, S, W, V, R, N> AdaptiveSteps<M, S, W, V, R, N>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    /// The energy of the present state, if the system gives it.
    pub fn energy(&self) -> Option<V::Scalar> {
        self.integrator.energy()
    }

    /// The step density z, positive: `z_{n+1/2}` of the last step, whose size was `ε/z`. Before the first step, and after
    /// [`set_state`](Run::set_state), `1/σ(q)`.
    pub const fn step_density(&self) -> f64 {
        self.controller.density
    }

    /// The ε of the run, negative in a run backward.
    pub const fn epsilon(&self) -> f64 {
        self.controller.epsilon
    }

    /// The monitor.
    pub const fn monitor(&self) -> &W {
        &self.monitor
    }

    /// The states inside the last step: see [`Integrator::dense`](symplectic_core::Integrator#method.dense).
    ///
    /// # Errors
    ///
    /// Those of [`Integrator::dense`](symplectic_core::Integrator#method.dense).
    pub fn dense(&self) -> Result<DenseOutput<'_, M, S, V, R, N>, Error> {
        Ok(self.integrator.dense()?)
    }

    /// The integrator that takes the steps, for example to read its system and its statistics.
    pub const fn integrator(&self) -> &Integrator<M, S, V, R, N> {
        &self.integrator
    }
}

impl<M, S, W, V, R, N> AdaptiveSteps<M, S, W, V, R, N>
where
    M: Method,
    S: System<V>,
    W: Monitor,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    /// The system.
    pub const fn system(&self) -> &S {
        self.integrator.system()
    }

    /// `G = −∇σ·q'/σ` at the present state.
    fn rate(&mut self) -> Result<f64, Error> {
        let State { time, q, p } = self.integrator.state();
        let velocity = if S::MASSES.are_unit() {
            p
        } else {
            let system = self.integrator.system();
            system.velocity(*time, q, p, &mut self.velocity);
            &self.velocity
        };
        let slope = self
            .slopes
            .along(&self.monitor, seen::<S, V>(q), seen::<S, V>(velocity));
        if slope.is_finite() {
            Ok(-slope)
        } else {
            Err(monitor_at(*time)(self.monitor.value(seen::<S, V>(q))).into())
        }
    }

    fn restarted(&self, state: &State<V>) -> Result<Controller, Error> {
        let State { time, q, p } = state;
        check_state(*time, q, p, self.integrator.state().q.dimension())?;
        let value = value_at(&self.monitor, seen::<S, V>(q)).map_err(monitor_at(*time))?;
        Ok(Controller::new(self.controller.epsilon, value))
    }
}

impl<M, S, W, V, R, N> Stepper for AdaptiveSteps<M, S, W, V, R, N>
where
    M: Method,
    S: System<V>,
    W: Monitor,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    type State = State<V>;
    type Error = Error;
    type Pace = Own;
    /// Parts of a step would not be symmetric.
    type Saved = ();

    fn state(&self) -> &State<V> {
        self.integrator.state()
    }

    fn statistics(&self) -> &Statistics {
        self.integrator.statistics()
    }

    fn statistics_mut(&mut self) -> &mut Statistics {
        self.integrator.stepper_mut().statistics_mut()
    }

    /// The step density becomes 1/σ.
    fn set_state(&mut self, state: &State<V>) -> Result<(), Error> {
        let controller = self.restarted(state)?;
        self.integrator.copy_state(state)?;
        self.controller = controller;
        Ok(())
    }

    fn advance(&mut self, _size: f64, _end: f64) -> Result<(), Error> {
        let mut next = self.controller;
        let half = 0.5 * next.epsilon;
        let kick = next.unfinished + half;
        // Just after a reversal the two kicks cancel: z does not change, and the step has the size of the last one.
        if kick != 0.0 {
            next.density += kick * self.rate()?;
        }
        let size = next.step_size();
        let time = self.integrator.state().time;
        if !(next.density > 0.0 && size.is_finite()) {
            return Err(Error::StepDensity {
                time,
                step: self.integrator.steps() + 1,
                density: next.density,
            });
        }
        let (span, rest) = two_sum(size, next.time_low);
        let (sum, error) = two_sum(time, span);
        let (end, low) = fast_two_sum(sum, error + rest);
        let stepper = self.integrator.stepper_mut();
        if let Err(error) = advance_in_time(stepper, size, end) {
            return Err(match error {
                // The steps have become too short, not too short from the start.
                symplectic_core::Error::TimeResolution { .. } if time + next.first_size != time => {
                    let q = seen::<S, V>(&self.integrator.state().q);
                    monitor_at(time)(self.monitor.value(q))
                }
                error => error,
            }
            .into());
        }
        next.time_low = low;
        next.unfinished = half;
        self.controller = next;
        Ok(())
    }

    fn own_step_size(&self) -> Option<f64> {
        Some(self.controller.step_size())
    }

    fn save(&self) {}

    fn go_back(&mut self, _saved: &()) {}
}

impl<M, S, W, V, R, N> Clone for AdaptiveSteps<M, S, W, V, R, N>
where
    M: Method,
    S: System<V> + Clone,
    W: Clone,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    /// Both continue with the same bits.
    fn clone(&self) -> Self {
        Self {
            integrator: self.integrator.clone(),
            monitor: self.monitor.clone(),
            slopes: self.slopes.clone(),
            velocity: self.velocity.clone(),
            controller: self.controller,
        }
    }
}

impl<M, S, W, V, R, N> fmt::Debug for AdaptiveSteps<M, S, W, V, R, N>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("AdaptiveSteps")
            .field("integrator", &self.integrator)
            .field("controller", &self.controller)
            .finish_non_exhaustive()
    }
}
