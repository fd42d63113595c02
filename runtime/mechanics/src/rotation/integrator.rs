//! The integrator of a rigid body.

use crate::Error;
use nalgebra::{UnitQuaternion, Vector3};

use super::attitude::{Attitude, Precise};
use super::body::RigidBody;
use super::free_step::{NoRotation, rotation};
use super::state::RotationState;
use symplectic_core::inside::{Part, SymmetricSteps, check_step_size, words};
use symplectic_core::proved::StoermerVerletSteps;
use symplectic_core::solver::{Visit, Words};
use symplectic_core::stepper::{Equal, Stepper};
use symplectic_core::{Error as CoreError, Quantity, Run, Statistics};

/// Integrates a [`RigidBody`] by the symplectic method on SO(3) described in [`rotation`](crate::rotation). A step
/// allocates nothing and evaluates the torque once; a composition evaluates it once per substep. A failed step leaves
/// the state untouched. All other methods: [`Run`].
///
/// The errors of a step are [`Error::HalfTurn`] for a rotation by π or more, [`Error::NoEndOfStep`] if Newton's iteration does not
/// converge, [`Core(NonFinite)`](CoreError::NonFinite) for a torque, and [`Core(TimeResolution)`](CoreError::TimeResolution).
///
/// With the feature `alloc` a [checkpoint](Run::checkpoint) is refused if the moments of inertia or the torque have other values. A run has no
/// output times or events inside steps.
///
/// ```
/// symplectic::composition! { Suzuki4 { base: stormer-verlet, weights: suzuki(4), require: [order == 4] } }
/// use symplectic::nalgebra::{UnitQuaternion, Vector3};
/// use symplectic::rotation::{HeavyTop, RotationSteps, RotationState};
///
/// # fn main() -> Result<(), symplectic::rotation::Error> {
/// let top = HeavyTop { moments: Vector3::new(1.0, 1.0, 0.5), weight: 1.0, centre: Vector3::new(0.0, 0.0, 1.0) };
/// let tilted = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.5);
/// let start = RotationState::new(0.0, tilted, Vector3::new(0.0, 0.0, 3.0));
/// let mut run = RotationSteps::composed(Suzuki4, top, start, 0.05)?;
/// let (energy, momentum) = (run.stepper().energy().expect("it is known"), run.stepper().spatial_momentum());
/// run.integrate_to(100.0)?;
/// assert!((run.stepper().energy().expect("it is known") - energy).abs() < 1e-6);
/// assert!((run.stepper().spatial_momentum().z - momentum.z).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
pub type RotationIntegrator<B> = Run<RotationSteps<B>>;

/// The steps of a [`RotationIntegrator`].
#[derive(Clone, Debug)]
pub struct RotationSteps<B> {
    pub(super) body: B,
    pub(super) moments: Vector3<f64>,
    pub(super) steps: SymmetricSteps,
    pub(super) present: Present,
}

/// What a step changes.
#[derive(Clone, Copy, Debug)]
pub struct Present {
    precise: PreciseState,
    state: RotationState,
    statistics: Statistics,
}

impl Words for Present {
    fn words(&mut self, visit: &mut Visit<'_>) {
        let PreciseState {
            attitude,
            momentum,
            torque,
        } = &mut self.precise;
        words!(visit: *attitude, *momentum, *torque, self.state, self.statistics);
    }
}

/// The state with its rounding errors, and the torque there.
#[derive(Clone, Copy, Debug)]
struct PreciseState {
    attitude: Attitude,
    /// The angular momentum in space.
    momentum: Precise<3>,
    /// The torque in space at the current attitude, if known.
    torque: Option<[f64; 3]>,
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

impl<B: RigidBody> RotationSteps<B> {
    /// An integrator of order 2 from `state`; a negative `step_size` goes backward.
    ///
    /// # Errors
    ///
    /// [`Core(StepSize)`](CoreError::StepSize) for a step size that is zero or not finite, [`Error::MomentOfInertia`] for a moment that is
    /// not positive and finite, [`Core(NonFiniteState)`](CoreError::NonFiniteState).
    pub fn run(body: B, state: RotationState, step_size: f64) -> Result<Run<Self>, Error> {
        Self::by(SymmetricSteps::ONE, body, state, step_size)
    }

    /// [`run`](Self::run) with a [`composition!`](symplectic_core::composition) of Störmer–Verlet steps, and
    /// with its order for general Hamiltonians, `M::ORDERS.general`.
    ///
    /// # Errors
    ///
    /// Those of [`run`](Self::run). Other methods do not compile:
    ///
    /// ```compile_fail,E0277
    /// symplectic::composition! { Sixth { base: lobatto-3, weights: triple_jump(6) } }
    /// use symplectic::nalgebra::{UnitQuaternion, Vector3};
    /// use symplectic::rotation::{FreeBody, RotationSteps, RotationState};
    ///
    /// let start = RotationState::new(0.0, UnitQuaternion::identity(), Vector3::z());
    /// RotationSteps::composed(Sixth, FreeBody::new(1.0, 2.0, 3.0), start, 0.1).unwrap();
    /// ```
    pub fn composed<M: StoermerVerletSteps>(
        _method: M,
        body: B,
        state: RotationState,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        Self::by(SymmetricSteps::of::<M>(), body, state, step_size)
    }

    fn by(
        steps: SymmetricSteps,
        body: B,
        state: RotationState,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        check_step_size(step_size)?;
        let moments = body.moments();
        for (axis, &value) in moments.iter().enumerate() {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::MomentOfInertia { axis, value });
            }
        }
        check_state(&state)?;
        let present = Present {
            precise: PreciseState::new(&state),
            state,
            statistics: Statistics::default(),
        };
        let stepper = RotationSteps {
            body,
            moments,
            steps,
            present,
        };
        Ok(Run::of(stepper, step_size)?)
    }

    /// The angular momentum `RΠ` in the space frame. Without torque it is constant to the last bit.
    pub fn spatial_momentum(&self) -> Vector3<f64> {
        self.present.precise.spatial()
    }

    /// The energy `Π·I⁻¹Π/2 + V(t, R)`; `None` if the body has no potential.
    pub fn energy(&self) -> Option<f64> {
        let RotationState {
            time,
            attitude,
            momentum,
        } = self.state();
        let kinetic = momentum.dot(&momentum.component_div(&self.moments)) / 2.0;
        Some(kinetic + self.body.potential(*time, attitude)?)
    }

    /// The body.
    pub const fn body(&self) -> &B {
        &self.body
    }
}

impl<B: RigidBody> RotationSteps<B> {
    /// A step of order 2: half a kick, the free step, half a kick.
    fn kick_free_step_kick(&self, precise: &mut PreciseState, part: Part) -> Result<(), Failure> {
        let before = match precise.torque {
            Some(torque) => torque.into(),
            None => self.torque(part.time, &precise.attitude.rounded())?,
        };
        precise.momentum.add((before * (part.size / 2.0)).into());
        let attitude = precise.attitude.rounded();
        let momentum = attitude.inverse_transform_vector(&precise.spatial());
        let rotation = rotation(&self.moments, &momentum, part.size).map_err(Failure::Rotation)?;
        precise.attitude.turn(&rotation);
        let after = self.torque(part.end, &precise.attitude.rounded())?;
        precise.momentum.add((after * (part.size / 2.0)).into());
        precise.torque = Some(after.into());
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

impl<B: RigidBody> Stepper for RotationSteps<B> {
    type State = RotationState;
    type Error = Error;
    type Pace = Equal;
    type Saved = Present;

    fn state(&self) -> &RotationState {
        &self.present.state
    }

    fn statistics(&self) -> &Statistics {
        &self.present.statistics
    }

    fn statistics_mut(&mut self) -> &mut Statistics {
        &mut self.present.statistics
    }

    fn set_state(&mut self, state: &RotationState) -> Result<(), Error> {
        check_state(state)?;
        self.present.precise = PreciseState::new(state);
        self.present.state = *state;
        Ok(())
    }

    fn advance(&mut self, size: f64, end: f64) -> Result<(), Error> {
        let mut next = self.present;
        next.statistics.steps += 1;
        let start = next.state.time;
        for part in self.steps.parts(start, size, end) {
            self.kick_free_step_kick(&mut next.precise, part)
                .map_err(|failure| failure.error(start, size, next.statistics.steps))?;
        }
        let attitude = next.precise.attitude.rounded();
        let momentum = attitude.inverse_transform_vector(&next.precise.spatial());
        next.state = RotationState::new(end, attitude, momentum);
        self.present = next;
        Ok(())
    }

    fn save(&self) -> Present {
        self.present
    }

    fn go_back(&mut self, saved: &Present) {
        self.present = *saved;
    }

    fn may_split(&self, error: &Error) -> bool {
        error.depends_on_the_size()
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
            Self::Torque => CoreError::NonFinite {
                time,
                step_size,
                step,
                what: Quantity::Torque,
                stage: None,
            }
            .into(),
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

fn check_state(state: &RotationState) -> Result<(), CoreError> {
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
    Err(CoreError::NonFiniteState { what })
}
