//! Poincaré's time transformation.

use alloc::boxed::Box;
use core::cell::Cell;
use core::fmt;

use super::extended::{Workspace, energy_of, extended, parted, parted_mut, reduced};
use super::monitor::{Monitor, Slopes, monitor_at, value_at};
use crate::Error;
use symplectic_core::solver::FixedPoint;
use symplectic_core::system::Conservative;
use symplectic_core::{General, Hamiltonian, State, System, Vector};

/// The Hamiltonian `K = σ(q)(H + p_t)` of Poincaré's time transformation (Hairer 1997; Reich 1999), for any H and any [`Monitor`] σ, in a
/// fictitious time τ:
///
/// ```text
/// dq/dτ = σ H_p      dt/dτ = σ      dp/dτ = −σ H_q − (H + p_t) ∇σ      dp_t/dτ = −σ H_t
/// ```
///
/// $$ K = \sigma(q)\,(H(t, q, p) + p_t) \qquad p_t = -H(\text{start}) \qquad \frac{dt}{d\tau} = \sigma(q) $$
///
/// Positions are (q, t) and momenta (p, p_t). K is zero along the motion, and its orbits there are those of H. A step of size ε in τ takes
/// about the time `ε σ(q)`. K is not separable, even if H is. It needs a method for [`General`] systems, such as
/// `basis: polynomial(s), nodes: gauss(s)`, which is symplectic in the extended phase space. The order in ε is that of the method.
///
/// The system must give its [energy](Hamiltonian::energy), which may depend on time. [`extend`](Self::extend) constructs the initial state,
/// whose vectors have one component more than those of the system; [`reduce`](Self::reduce) returns the state at time t.
///
/// ```
/// use symplectic::adaptive::{DistancePower, Error, Poincare};
/// use symplectic::nalgebra::Vector3;
/// use symplectic::{Event, Integrator, State};
///
/// symplectic::tableau! { Gauss3 { basis: polynomial(3), nodes: gauss(3) } }
/// symplectic::hamiltonian! {
///     Kepler
///     q: [x, y], p: [px, py];
///     H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)
/// }
///
/// # fn main() -> Result<(), Error> {
/// // The pericentre of an orbit of eccentricity 0.9.
/// let start = State::from_arrays(0.0, [0.1, 0.0], [0.0, 19_f64.sqrt()]);
/// let poincare = Poincare::new(Kepler, DistancePower(1.5));
/// let extended: State<Vector3<f64>> = poincare.extend(&start)?;
/// let mut run = Integrator::new(Gauss3, poincare, extended, 0.1)?;
/// // One period.
/// let end = core::f64::consts::TAU;
/// let arrival = Event::rising(|state: &State<Vector3<f64>>| state.q[2] - end).by_steps();
/// let found = run.find_event(100.0, &arrival)?.expect("time goes on");
/// let found = run.system().reduce(&found)?;
/// assert!((found.q - start.q).norm() < 1e-4);
/// # Ok(())
/// # }
/// ```
///
/// # Errors of steps
///
/// [`Monitor`](symplectic_core::Error::Monitor) if the monitor is not finite and positive. K cannot contain a force without a
/// potential: a system with an [applied force](Hamiltonian::applied_force) does not compile.
pub struct Poincare<S: Hamiltonian, W> {
    system: S,
    monitor: W,
    /// Work vectors for evaluations of system and monitor; `None` before the first evaluation and during an evaluation.
    workspace: Cell<Option<Box<Workspaces<S>>>>,
    /// The value of the monitor in the last failed evaluation, unless it was NaN.
    fault: Cell<Option<f64>>,
}

struct Workspaces<S: Hamiltonian> {
    of_system: Workspace<S>,
    of_monitor: Slopes<S::Vector<f64>>,
}

impl<S: Hamiltonian<Class: Conservative>, W: Monitor> Poincare<S, W> {
    /// The transformed Hamiltonian of a system.
    pub const fn new(system: S, monitor: W) -> Self {
        const {
            assert!(
                !S::FORCED,
                "a force without a potential has no place in a transformed Hamiltonian: take `AdaptiveSteps::run`"
            );
        }
        Self {
            system,
            monitor,
            workspace: Cell::new(None),
            fault: Cell::new(None),
        }
    }

    /// The extended state ((q, t), (p, p_t)) at τ = 0.
    ///
    /// # Errors
    ///
    /// [`Error::Core`] with `Dimension`, `NonFiniteState`, `NoEnergy`, `Monitor`,
    /// `Length` if the vectors of type `V` cannot have one component more than those of the system.
    pub fn extend<V: Vector<Scalar = f64>>(
        &self,
        state: &State<S::Vector<f64>>,
    ) -> Result<State<V>, Error> {
        let energy = energy_of(&self.system, state)?;
        value_at(&self.monitor, state.q.as_slice()).map_err(monitor_at(state.time))?;
        extended(state, -energy)
    }

    /// The state (q, p) at time t of an extended state.
    ///
    /// # Errors
    ///
    /// [`Error::Core`] with `Dimension`, `NonFiniteState` or `Length`.
    pub fn reduce<V: Vector<Scalar = f64>>(
        &self,
        state: &State<V>,
    ) -> Result<State<S::Vector<f64>>, Error> {
        reduced(state)
    }

    /// The original system.
    pub const fn system(&self) -> &S {
        &self.system
    }

    /// The monitor.
    pub const fn monitor(&self) -> &W {
        &self.monitor
    }

    /// Calls `evaluate` with σ and the work vectors, which hold the state; `None` if σ is not finite and positive, or the system has another
    /// dimension.
    fn at_state<T>(
        &self,
        (q, p): (&[f64], &[f64]),
        evaluate: impl FnOnce(f64, &mut Workspaces<S>) -> T,
    ) -> Option<T> {
        let workspace = self.workspace.take();
        let mut workspace =
            match workspace.filter(|workspace| workspace.of_system.q.dimension() == q.len()) {
                Some(workspace) => workspace,
                None => {
                    let of_system = Workspace::new(q.len()).ok()?;
                    let of_monitor = Slopes::like(&of_system.q);
                    Box::new(Workspaces {
                        of_system,
                        of_monitor,
                    })
                }
            };
        workspace.of_system.set_q(q);
        workspace.of_system.set_p(p);
        let value = value_at(&self.monitor, workspace.of_system.q.as_slice());
        let value = value.map(|value| evaluate(value, &mut workspace));
        self.workspace.set(Some(workspace));
        // NaN comes from an earlier failed evaluation, whose value is kept until an error is explained, even if a second attempt succeeds.
        value
            .map_err(|value| {
                if !value.is_nan() {
                    self.fault.set(Some(value));
                }
            })
            .ok()
    }
}

impl<S, W, V> System<V> for Poincare<S, W>
where
    S: Hamiltonian<Class: Conservative>,
    W: Monitor,
    V: Vector<Scalar = f64>,
{
    type Class = General;
    type Solver = FixedPoint;

    const WELL_DECLARED: bool = true;

    fn velocity(&self, _time: f64, q: &V, p: &V, velocity: &mut V) {
        let ((q, time), (p, _)) = (parted(q), parted(p));
        let found = self.at_state((q, p), |monitor, workspace| {
            let Workspace { q, p, slope, .. } = &mut workspace.of_system;
            Hamiltonian::velocity(&self.system, time, q, p, slope);
            let (out, last) = parted_mut(velocity)?;
            for (out, v) in out.iter_mut().zip(slope.as_slice()) {
                *out = monitor * v;
            }
            *last = monitor;
            Some(())
        });
        if found.flatten().is_none() {
            velocity.as_mut_slice().fill(f64::NAN);
        }
    }

    fn force(&self, _time: f64, q: &V, p: &V, force: &mut V) {
        let ((q, time), (p, momentum)) = (parted(q), parted(p));
        let found = self.at_state((q, p), |monitor, workspace| {
            let energy = workspace.of_system.energy(&self.system, time);
            let Workspace { q, p, slope, .. } = &mut workspace.of_system;
            let gradient = workspace.of_monitor.gradient(&self.monitor, q);
            Hamiltonian::force(&self.system, time, q, p, slope);
            let excess = energy.real() + momentum;
            let (out, last) = parted_mut(force)?;
            let terms = slope.as_slice().iter().zip(gradient.as_slice());
            for (out, (f, g)) in out.iter_mut().zip(terms) {
                *out = monitor * (f - excess * g);
            }
            *last = -monitor * energy.first();
            Some(())
        });
        if found.flatten().is_none() {
            force.as_mut_slice().fill(f64::NAN);
        }
    }

    /// K, which is zero along the motion.
    fn energy(&self, _time: f64, q: &V, p: &V) -> Option<f64> {
        let ((q, time), (p, momentum)) = (parted(q), parted(p));
        let fault = self.fault.get();
        let found = self.at_state((q, p), |monitor, workspace| {
            let energy = workspace.of_system.energy(&self.system, time);
            monitor * (energy.real() + momentum)
        });
        // This evaluation is not part of a step.
        self.fault.set(fault);
        Some(found.unwrap_or(f64::NAN))
    }

    fn check_dimension(&self, dimension: usize) -> Result<(), symplectic_core::Error> {
        self.system.check_dimension(dimension.saturating_sub(1))
    }

    fn explain(&self, error: symplectic_core::Error, q: &V) -> symplectic_core::Error {
        match (self.fault.take(), error) {
            (
                Some(value),
                symplectic_core::Error::NonFinite { .. }
                | symplectic_core::Error::NoConvergence { .. },
            ) => monitor_at(parted(q).1)(value),
            (_, error) => error,
        }
    }
}

impl<S: Hamiltonian + Clone, W: Clone> Clone for Poincare<S, W> {
    fn clone(&self) -> Self {
        Self {
            system: self.system.clone(),
            monitor: self.monitor.clone(),
            workspace: Cell::new(None),
            fault: Cell::new(None),
        }
    }
}

impl<S: Hamiltonian + fmt::Debug, W: fmt::Debug> fmt::Debug for Poincare<S, W> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut structure = formatter.debug_struct("Poincare");
        structure.field("system", &self.system);
        structure.field("monitor", &self.monitor);
        structure.finish_non_exhaustive()
    }
}
