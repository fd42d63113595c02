//! State of a rigid body.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use symplectic_core::State;
use symplectic_core::inside::words;
use symplectic_core::solver::{Visit, Words, scalar_words};
use symplectic_core::stepper::{PhasePoint, Timed};

/// The attitude and the angular momentum of a rigid body at a time.
///
/// ```
/// use symplectic::nalgebra::{UnitQuaternion, Vector3};
/// use symplectic::rotation::RotationState;
///
/// // The first axis of the body is along the y axis of space.
/// let quarter_turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), core::f64::consts::FRAC_PI_2);
/// let state = RotationState::new(0.0, quarter_turn, Vector3::new(1.0, 0.0, 0.0));
/// assert!((state.spatial_momentum() - Vector3::y()).norm() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotationState {
    /// Time t.
    pub time: f64,
    /// The attitude R, from the frame of the body to the space frame.
    pub attitude: UnitQuaternion<f64>,
    /// The angular momentum Π, in the frame of the body.
    pub momentum: Vector3<f64>,
}

impl RotationState {
    /// The state `(R, Π)` at `time`.
    pub const fn new(time: f64, attitude: UnitQuaternion<f64>, momentum: Vector3<f64>) -> Self {
        Self {
            time,
            attitude,
            momentum,
        }
    }

    /// The angular momentum `RΠ`, in the space frame.
    pub fn spatial_momentum(&self) -> Vector3<f64> {
        self.attitude * self.momentum
    }
}

impl Timed for RotationState {
    fn time(&self) -> f64 {
        self.time
    }
}

impl Words for RotationState {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.time);
        let attitude = self.attitude.as_mut_unchecked();
        scalar_words(attitude.coords.as_mut_slice(), visit);
        scalar_words(self.momentum.as_mut_slice(), visit);
    }
}

/// `q = R` and `p = RΠ̂/2` in `T*R⁹`: with `dR = Rη̂` the canonical form `tr(pᵀdR)` is `Π·η`, that of `T*SO(3)`. So `dq∧dp` is
/// `η·dΠ' − η'·dΠ + Π·(η×η')` on two directions.
impl PhasePoint for RotationState {
    type Vector = Matrix3<f64>;

    fn canonical(&self) -> State<Matrix3<f64>> {
        let attitude = self.attitude.to_rotation_matrix().into_inner();
        let momentum = attitude * self.momentum.cross_matrix() * 0.5;
        State::new(self.time, attitude, momentum)
    }
}
