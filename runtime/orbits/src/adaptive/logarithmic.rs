//! The logarithmic Hamiltonian.

use alloc::boxed::Box;
use core::cell::Cell;
use core::fmt;

use super::extended::{Workspace, energy_of, extended, parted, parted_mut, reduced};
use crate::Error;
use symplectic_core::inside::non_linear_velocity;
use symplectic_core::solver::FixedPoint;
use symplectic_core::{Hamiltonian, Scalar, Separable, State, System, Vector};

/// The logarithmic Hamiltonian of a system `H = T(p) + U(q)` with `U < 0` (Mikkola & Tanikawa 1999; Preto & Tremaine 1999), in a fictitious
/// time τ:
///
/// ```text
/// K = ln(T(p) + B) − ln(−U(q))      B = −H(start)
/// dq/dτ = v/(T + B)      dt/dτ = 1/(T + B)      dp/dτ = −∇U/(−U)      dB/dτ = U_t/U
/// ```
///
/// $$ K = \ln(T(p) + B) - \ln(-U(q)) \qquad \frac{dt}{d\tau} = \frac{1}{T + B} $$
///
/// Positions are (q, t) and momenta (p, B). K is zero along the motion, and its orbits there are those of H. A step of size ε in τ takes
/// about the time `ε/(T + B) = ε/(−U)`, which is short where the potential is deep. K is separable: all splittings for separable systems
/// apply, explicit and symplectic. The kinetic part of K is not quadratic: methods whose order holds for quadratic kinetic energy only
/// (Runge–Kutta–Nyström) are refused with [`NotQuadraticKinetic`](symplectic_core::Error::NotQuadraticKinetic).
///
/// For the Kepler problem `position-verlet` and its compositions follow the exact orbit, up to rounding: they conserve the energy and the
/// Laplace vector. Only the time has an error, of the order of the method. Other splittings, and `velocity-verlet`, have an error in the
/// orbit as well.
///
/// `T = p·M⁻¹p/2` with a constant M. U may depend on time. The system must give its [energy](Hamiltonian::energy), which determines U:
/// `U(t, q) = H(t, q, 0)`.
///
/// # How to use it
///
/// [`extend`](Self::extend) constructs the initial state, whose vectors have one component more than those of the system.
/// [`reduce`](Self::reduce) returns the state at time t. To stop at a time t, use an [`Event`](symplectic_core::Event) of the last position.
///
/// ```
/// use symplectic::adaptive::{Error, Logarithmic};
/// use symplectic::nalgebra::Vector3;
/// use symplectic::{Event, Integrator, State};
///
/// symplectic::composition! { TripleJump { base: position-verlet, weights: triple_jump(4) } }
/// symplectic::hamiltonian! {
///     Kepler
///     q: [x, y], p: [px, py];
///     H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)
/// }
///
/// # fn main() -> Result<(), Error> {
/// // The pericentre of an orbit of eccentricity 0.99.
/// let start = State::from_arrays(0.0, [0.01, 0.0], [0.0, 199_f64.sqrt()]);
/// let logarithmic = Logarithmic::new(Kepler);
/// let extended: State<Vector3<f64>> = logarithmic.extend(&start)?;
/// let mut run = Integrator::new(TripleJump, logarithmic, extended, 0.05)?;
/// // One period.
/// let end = core::f64::consts::TAU;
/// let arrival = Event::rising(|state: &State<Vector3<f64>>| state.q[2] - end).by_steps();
/// let found = run.find_event(100.0, &arrival)?.expect("time goes on");
/// let found = run.system().reduce(&found)?;
/// assert!((found.time - end).abs() < 1e-13);
/// let energy = found.p.norm_squared() / 2.0 - 1.0 / found.q.norm();
/// assert!((energy + 0.5).abs() < 1e-11);
/// # Ok(())
/// # }
/// ```
///
/// # Errors of steps
///
/// [`LogarithmicDomain`](symplectic_core::Error::LogarithmicDomain) if `U ≥ 0` or `T + B ≤ 0`. K cannot contain a force
/// without a potential: a system with an [applied force](Hamiltonian::applied_force) does not compile.
pub struct Logarithmic<S: Hamiltonian<Class = Separable>> {
    system: S,
    /// Work vectors for evaluations of the system; `None` before the first evaluation and during an evaluation.
    workspace: Cell<Option<Box<Workspace<S>>>>,
    /// In the last failed evaluation, the name and the value of the logarithm's argument that was not positive.
    fault: Cell<Option<(&'static str, f64)>>,
}

impl<S: Hamiltonian<Class = Separable>> Logarithmic<S> {
    /// The logarithmic Hamiltonian of a system.
    pub const fn new(system: S) -> Self {
        const {
            assert!(
                !S::FORCED,
                "a force without a potential has no place in a logarithmic Hamiltonian: take `AdaptiveSteps::run`"
            );
        }
        Self {
            system,
            workspace: Cell::new(None),
            fault: Cell::new(None),
        }
    }

    /// The extended state ((q, t), (p, B)) at τ = 0.
    ///
    /// # Errors
    ///
    /// [`Error::LogarithmicMasses`] if the velocity is not `M⁻¹p` with a constant M. [`Error::Core`] with `Dimension`, `NonFiniteState`,
    /// `NoEnergy`, `LogarithmicDomain` if `U ≥ 0`, `Length` if the vectors of type
    /// `W` cannot have one component more than those of the system.
    pub fn extend<W: Vector<Scalar = f64>>(
        &self,
        state: &State<S::Vector<f64>>,
    ) -> Result<State<W>, Error> {
        let energy = energy_of(&self.system, state)?;
        let State { time, q, p } = state;
        if let Some(found) = non_linear_velocity(&self.system, *time, q, p) {
            return Err(Error::LogarithmicMasses {
                component: found.component,
                velocity: found.velocity,
                linear: found.linear,
            });
        }
        let rest = p.zeros_like();
        let potential = Hamiltonian::energy(&self.system, *time, q, &rest)
            .ok_or(symplectic_core::Error::NoEnergy)?;
        if !(potential < 0.0 && potential.is_finite()) {
            return Err(symplectic_core::Error::LogarithmicDomain {
                time: *time,
                step: 0,
                what: POTENTIAL,
                value: -potential,
            }
            .into());
        }
        extended(state, -energy)
    }

    /// The state (q, p) at time t of an extended state.
    ///
    /// # Errors
    ///
    /// [`Error::Core`] with `Dimension`, `NonFiniteState` or `Length`.
    pub fn reduce<W: Vector<Scalar = f64>>(
        &self,
        state: &State<W>,
    ) -> Result<State<S::Vector<f64>>, Error> {
        reduced(state)
    }

    /// The original system.
    pub const fn system(&self) -> &S {
        &self.system
    }

    /// Calls `evaluate` with the work vectors for `dimension` components; `None` if the system has another dimension.
    fn with_workspace<T>(
        &self,
        dimension: usize,
        evaluate: impl FnOnce(&mut Workspace<S>) -> T,
    ) -> Option<T> {
        let workspace = self.workspace.take();
        let mut workspace = match workspace.filter(|workspace| workspace.q.dimension() == dimension)
        {
            Some(workspace) => workspace,
            None => Box::new(Workspace::new(dimension).ok()?),
        };
        let value = evaluate(&mut workspace);
        self.workspace.set(Some(workspace));
        Some(value)
    }

    /// `T + B`; `None` if it is not positive. Leaves the velocity in the work vectors.
    fn kinetic(&self, workspace: &mut Workspace<S>, p: &[f64], b: f64) -> Option<f64> {
        workspace.set_p(p);
        let Workspace { q, p, slope, .. } = workspace;
        Hamiltonian::velocity(&self.system, 0.0, q, p, slope);
        let products = p
            .as_slice()
            .iter()
            .zip(slope.as_slice())
            .map(|(p, v)| p * v);
        let kinetic = 0.5 * products.fold(0.0, |sum, product| sum + product) + b;
        self.positive(KINETIC, kinetic)
    }

    /// `−U` and `∂ ln(−U)/∂t`; `None` if U is not negative.
    fn potential(&self, workspace: &mut Workspace<S>, q: &[f64], time: f64) -> Option<(f64, f64)> {
        workspace.set_q(q);
        workspace.p.as_mut_slice().fill(0.0);
        let found = workspace.energy(&self.system, time);
        let depth = self.positive(POTENTIAL, -found.real())?;
        Some((depth, -found.first() / depth))
    }

    fn positive(&self, what: &'static str, value: f64) -> Option<f64> {
        if value > 0.0 {
            return Some(value);
        }
        // NaN comes from an earlier failed evaluation.
        if !value.is_nan() {
            self.fault.set(Some((what, value)));
        }
        None
    }
}

const POTENTIAL: &str = "−U";
const KINETIC: &str = "T + B";

impl<S, W> System<W> for Logarithmic<S>
where
    S: Hamiltonian<Class = Separable>,
    W: Vector<Scalar = f64>,
{
    type Class = Separable;
    type Solver = FixedPoint;

    const WELL_DECLARED: bool = true;

    fn velocity(&self, _time: f64, _q: &W, p: &W, velocity: &mut W) {
        let (p, b) = parted(p);
        let found = self.with_workspace(p.len(), |workspace| {
            let sum = self.kinetic(workspace, p, b)?;
            let (out, last) = parted_mut(velocity)?;
            for (out, v) in out.iter_mut().zip(workspace.slope.as_slice()) {
                *out = v / sum;
            }
            *last = 1.0 / sum;
            Some(())
        });
        if found.flatten().is_none() {
            velocity.as_mut_slice().fill(f64::NAN);
        }
    }

    fn force(&self, _time: f64, q: &W, _p: &W, force: &mut W) {
        let (q, time) = parted(q);
        let found = self.with_workspace(q.len(), |workspace| {
            let (depth, slope) = self.potential(workspace, q, time)?;
            let Workspace { q, p, slope: f, .. } = workspace;
            Hamiltonian::force(&self.system, time, q, p, f);
            let (out, last) = parted_mut(force)?;
            for (out, f) in out.iter_mut().zip(f.as_slice()) {
                *out = f / depth;
            }
            *last = slope;
            Some(())
        });
        if found.flatten().is_none() {
            force.as_mut_slice().fill(f64::NAN);
        }
    }

    /// K, which is zero along the motion.
    fn energy(&self, _time: f64, q: &W, p: &W) -> Option<f64> {
        let ((q, time), (p, b)) = (parted(q), parted(p));
        let fault = self.fault.get();
        let found = self.with_workspace(q.len(), |workspace| {
            let sum = self.kinetic(workspace, p, b)?;
            let (depth, _) = self.potential(workspace, q, time)?;
            Some(Scalar::ln(sum / depth))
        });
        // This evaluation is not part of a step.
        self.fault.set(fault);
        Some(found.flatten().unwrap_or(f64::NAN))
    }

    fn check_dimension(&self, dimension: usize) -> Result<(), symplectic_core::Error> {
        self.system.check_dimension(dimension.saturating_sub(1))
    }

    fn explain(&self, error: symplectic_core::Error, q: &W) -> symplectic_core::Error {
        match (self.fault.take(), error) {
            (Some((what, value)), symplectic_core::Error::NonFinite { step, .. }) => {
                symplectic_core::Error::LogarithmicDomain {
                    time: parted(q).1,
                    step,
                    what,
                    value,
                }
            }
            (_, error) => error,
        }
    }
}

impl<S: Hamiltonian<Class = Separable> + Clone> Clone for Logarithmic<S> {
    fn clone(&self) -> Self {
        Self::new(self.system.clone())
    }
}

impl<S: Hamiltonian<Class = Separable> + fmt::Debug> fmt::Debug for Logarithmic<S> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut structure = formatter.debug_struct("Logarithmic");
        structure
            .field("system", &self.system)
            .finish_non_exhaustive()
    }
}
