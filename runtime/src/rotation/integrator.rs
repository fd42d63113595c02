//! The integrator of a rigid body.

use nalgebra::{UnitQuaternion, Vector3};

use super::attitude::{Attitude, Precise};
use super::body::RigidBody;
use super::free_step::{NoRotation, rotation};
use super::state::RotationState;
use crate::error::{Error, Quantity};
use crate::integrator::StepMap;
use crate::integrator::step_clock::{StepClock, Stepper};
use crate::method::StoermerVerletSteps;
use crate::method::symmetric_steps::{Part, SymmetricSteps};

/// Integrates a [`RigidBody`] by the symplectic method on SO(3) described in [`rotation`](crate::rotation). A step
/// allocates nothing and evaluates the torque once; a composition evaluates it once per substep. A failed step leaves
/// the state untouched.
///
/// ```
/// symplectic::composition! { Suzuki4 { base: stormer-verlet, weights: suzuki(4), require: [order == 4] } }
/// use symplectic::nalgebra::{UnitQuaternion, Vector3};
/// use symplectic::rotation::{HeavyTop, RotationIntegrator, RotationState};
///
/// # fn main() -> Result<(), symplectic::Error> {
/// let top = HeavyTop { moments: Vector3::new(1.0, 1.0, 0.5), weight: 1.0, centre: Vector3::new(0.0, 0.0, 1.0) };
/// let tilted = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.5);
/// let start = RotationState::new(0.0, tilted, Vector3::new(0.0, 0.0, 3.0));
/// let mut run = RotationIntegrator::composed(Suzuki4, top, start, 0.05)?;
/// let (energy, momentum) = (run.energy().expect("it is known"), run.spatial_momentum());
/// run.integrate_to(100.0)?;
/// assert!((run.energy().expect("it is known") - energy).abs() < 1e-6);
/// assert!((run.spatial_momentum().z - momentum.z).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct RotationIntegrator<B> {
    body: B,
    moments: Vector3<f64>,
    steps: SymmetricSteps,
    step_clock: StepClock,
    precise: PreciseState,
    state: RotationState,
}

/// The variables that a step changes.
#[derive(Clone, Copy, Debug)]
struct PreciseState {
    attitude: Attitude,
    /// The angular momentum in space.
    momentum: Precise<3>,
    /// The torque in space at the current attitude, if known.
    torque: Option<Vector3<f64>>,
}

impl PreciseState {
    fn new(state: &RotationState) -> Self {
        Self {
            attitude: Attitude::new(&state.attitude),
            momentum: Precise::new(state.spatial_momentum().into()),
            torque: None,
        }
    }

    /// The angular momentum in space.
    fn spatial(&self) -> Vector3<f64> {
        Vector3::from(self.momentum.high)
    }
}

impl<B: RigidBody> RotationIntegrator<B> {
    /// An integrator of order 2 from `state`; a negative `step_size` goes backward.
    ///
    /// # Errors
    ///
    /// [`Error::StepSize`] for a step size that is zero or not finite, [`Error::MomentOfInertia`] for a moment that is
    /// not positive and finite, [`Error::NonFiniteState`].
    pub fn new(body: B, state: RotationState, step_size: f64) -> Result<Self, Error> {
        Self::by(SymmetricSteps::ONE, body, state, step_size)
    }

    /// [`new`](Self::new) with a [`composition!`](crate::composition) of Störmer–Verlet steps, and with its order for
    /// general Hamiltonians, `M::ORDERS.general`.
    ///
    /// # Errors
    ///
    /// Those of [`new`](Self::new). Other methods do not compile:
    ///
    /// ```compile_fail,E0277
    /// symplectic::composition! { Sixth { base: lobatto-3, weights: triple_jump(6) } }
    /// use symplectic::nalgebra::{UnitQuaternion, Vector3};
    /// use symplectic::rotation::{FreeBody, RotationIntegrator, RotationState};
    ///
    /// let start = RotationState::new(0.0, UnitQuaternion::identity(), Vector3::z());
    /// RotationIntegrator::composed(Sixth, FreeBody::new(1.0, 2.0, 3.0), start, 0.1).unwrap();
    /// ```
    pub fn composed<M: StoermerVerletSteps>(
        _method: M,
        body: B,
        state: RotationState,
        step_size: f64,
    ) -> Result<Self, Error> {
        Self::by(SymmetricSteps::of::<M>(), body, state, step_size)
    }

    fn by(
        steps: SymmetricSteps,
        body: B,
        state: RotationState,
        step_size: f64,
    ) -> Result<Self, Error> {
        let step_clock = StepClock::new(state.time, step_size)?;
        let moments = body.moments();
        for (axis, &value) in moments.iter().enumerate() {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::MomentOfInertia { axis, value });
            }
        }
        check_state(&state)?;
        Ok(Self {
            body,
            moments,
            steps,
            step_clock,
            precise: PreciseState::new(&state),
            state,
        })
    }

    /// Takes one step and returns the state after it. The time after `k` steps is `start + k h`.
    ///
    /// # Errors
    ///
    /// [`Error::HalfTurn`] for a rotation by π or more, [`Error::NoEndOfStep`] if Newton's iteration does not converge,
    /// [`Error::NonFinite`] for a torque, [`Error::TimeResolution`]; the state is then untouched.
    pub fn step(&mut self) -> Result<&RotationState, Error> {
        self.one_step()?;
        Ok(&self.state)
    }

    /// Integrates to exactly the time `end`, forward or backward, in the smallest number of equal steps that do not
    /// exceed the step size.
    ///
    /// # Errors
    ///
    /// [`Error::EndTime`], [`Error::StepCount`], and those of [`step`](Self::step); the state is then that of the last
    /// successful step.
    pub fn integrate_to(&mut self, end: f64) -> Result<&RotationState, Error> {
        self.steps_to(end)?;
        Ok(&self.state)
    }

    /// The present state, rounded.
    pub const fn state(&self) -> &RotationState {
        &self.state
    }

    /// The angular momentum `RΠ` in the space frame. Without torque it is constant to the last bit.
    pub fn spatial_momentum(&self) -> Vector3<f64> {
        self.precise.spatial()
    }

    /// The energy `Π·I⁻¹Π/2 + V(t, R)`; `None` if the body has no potential.
    pub fn energy(&self) -> Option<f64> {
        let RotationState {
            time,
            attitude,
            momentum,
        } = &self.state;
        let kinetic = momentum.dot(&momentum.component_div(&self.moments)) / 2.0;
        Some(kinetic + self.body.potential(*time, attitude)?)
    }

    /// The body.
    pub const fn body(&self) -> &B {
        &self.body
    }

    /// The step size.
    pub const fn step_size(&self) -> f64 {
        self.step_clock.step_size()
    }

    /// Number of steps taken.
    pub const fn steps(&self) -> u64 {
        self.step_clock.taken()
    }

    /// Changes the step size; a negative size goes backward.
    ///
    /// # Errors
    ///
    /// [`Error::StepSize`]; the step size is then unchanged.
    pub fn set_step_size(&mut self, step_size: f64) -> Result<(), Error> {
        self.step_clock.set_step_size(self.state.time, step_size)
    }

    /// A step of order 2: half a kick, the free step, half a kick.
    fn kick_free_step_kick(&self, precise: &mut PreciseState, part: Part) -> Result<(), Failure> {
        let before = match precise.torque {
            Some(torque) => torque,
            None => self.torque(part.time, &precise.attitude.rounded())?,
        };
        precise.momentum.add((before * (part.size / 2.0)).into());
        let attitude = precise.attitude.rounded();
        let momentum = attitude.inverse_transform_vector(&precise.spatial());
        let rotation = rotation(&self.moments, &momentum, part.size).map_err(Failure::Rotation)?;
        precise.attitude.turn(&rotation);
        let after = self.torque(part.end, &precise.attitude.rounded())?;
        precise.momentum.add((after * (part.size / 2.0)).into());
        precise.torque = Some(after);
        Ok(())
    }

    /// The torque in space.
    fn torque(&self, time: f64, attitude: &UnitQuaternion<f64>) -> Result<Vector3<f64>, Failure> {
        let torque = self.body.torque(time, attitude);
        if torque.iter().all(|component| component.is_finite()) {
            Ok(attitude * torque)
        } else {
            Err(Failure::Torque)
        }
    }
}

impl<B: RigidBody> Stepper for RotationIntegrator<B> {
    fn step_clock(&mut self) -> &mut StepClock {
        &mut self.step_clock
    }

    fn time(&self) -> f64 {
        self.state.time
    }

    fn advance(&mut self, size: f64, end: f64, number: u64) -> Result<(), Error> {
        let start = self.state.time;
        let mut precise = self.precise;
        for part in self.steps.parts(start, size, end) {
            self.kick_free_step_kick(&mut precise, part)
                .map_err(|failure| failure.error(start, size, number))?;
        }
        let attitude = precise.attitude.rounded();
        let momentum = attitude.inverse_transform_vector(&precise.spatial());
        self.precise = precise;
        self.state = RotationState::new(end, attitude, momentum);
        Ok(())
    }
}

impl<B: RigidBody + Clone> StepMap for RotationIntegrator<B> {
    type State = RotationState;

    fn present(&self) -> &RotationState {
        &self.state
    }

    fn step_from(&self, state: RotationState) -> Result<RotationState, Error> {
        check_state(&state)?;
        let mut run = self.clone();
        run.step_clock.restart(state.time);
        run.precise = PreciseState::new(&state);
        run.state = state;
        run.step()?;
        Ok(run.state)
    }
}

/// Why a step was not taken.
enum Failure {
    Torque,
    Rotation(NoRotation),
}

impl Failure {
    fn error(self, time: f64, step_size: f64, step: u64) -> Error {
        match self {
            Self::Torque => Error::NonFinite {
                time,
                step_size,
                step,
                what: Quantity::Torque,
                stage: None,
            },
            Self::Rotation(NoRotation::HalfTurn { angle }) => Error::HalfTurn {
                time,
                step_size,
                step,
                angle,
            },
            Self::Rotation(NoRotation::NotFound {
                residual,
                iterations,
            }) => Error::NoEndOfStep {
                time,
                step_size,
                step,
                residual,
                iterations,
            },
        }
    }
}

fn check_state(state: &RotationState) -> Result<(), Error> {
    let finite = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
    let what = if !state.time.is_finite() {
        Quantity::Time
    } else if !finite(state.attitude.coords.as_slice()) {
        Quantity::Attitude
    } else if !finite(state.momentum.as_slice()) {
        Quantity::Momentum
    } else {
        return Ok(());
    };
    Err(Error::NonFiniteState { what })
}
