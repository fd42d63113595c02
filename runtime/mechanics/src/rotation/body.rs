//! Rigid bodies.

use nalgebra::{UnitQuaternion, Vector3};

/// A rigid body with a fixed point, and its torque. Vectors have components along the principal axes.
///
/// ```
/// use symplectic::nalgebra::{UnitQuaternion, Vector3};
/// use symplectic::rotation::{RigidBody, RotationSteps, RotationState};
///
/// /// A magnet of moment 1 along its third axis, in a field along the x axis: V = −e1·R e3.
/// struct Needle;
///
/// impl RigidBody for Needle {
///     fn moments(&self) -> Vector3<f64> {
///         Vector3::new(1.0, 1.0, 0.1)
///     }
///
///     fn torque(&self, _time: f64, attitude: &UnitQuaternion<f64>) -> Vector3<f64> {
///         Vector3::z().cross(&attitude.inverse_transform_vector(&Vector3::x()))
///     }
///
///     fn potential(&self, _time: f64, attitude: &UnitQuaternion<f64>) -> Option<f64> {
///         Some(-(attitude * Vector3::z()).x)
///     }
/// }
///
/// # fn main() -> Result<(), symplectic::rotation::Error> {
/// let start = RotationState::new(0.0, UnitQuaternion::identity(), Vector3::zeros());
/// let mut run = RotationSteps::run(Needle, start, 0.01)?;
/// run.integrate_to(10.0)?;
/// assert!(run.stepper().energy().is_some_and(|energy| energy.abs() < 1e-4));
/// # Ok(())
/// # }
/// ```
pub trait RigidBody {
    /// The principal moments of inertia, finite and positive. An integrator reads them once.
    fn moments(&self) -> Vector3<f64>;

    /// The torque `τ(t, R)` about the fixed point, in the frame of the body: `δV = −τ·η` for a variation `δR = R η̂`.
    fn torque(&self, time: f64, attitude: &UnitQuaternion<f64>) -> Vector3<f64>;

    /// The potential `V(t, R)`; `None` by default.
    fn potential(&self, _time: f64, _attitude: &UnitQuaternion<f64>) -> Option<f64> {
        None
    }
}

impl<B: RigidBody> RigidBody for &B {
    fn moments(&self) -> Vector3<f64> {
        (**self).moments()
    }

    fn torque(&self, time: f64, attitude: &UnitQuaternion<f64>) -> Vector3<f64> {
        (**self).torque(time, attitude)
    }

    fn potential(&self, time: f64, attitude: &UnitQuaternion<f64>) -> Option<f64> {
        (**self).potential(time, attitude)
    }
}

/// A rigid body without torque: Euler's top.
///
/// ```
/// use symplectic::rotation::{FreeBody, RigidBody};
///
/// assert_eq!(FreeBody::new(1.0, 2.0, 3.0).moments().y, 2.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeBody {
    /// The principal moments of inertia.
    pub moments: Vector3<f64>,
}

impl FreeBody {
    /// The body with these principal moments of inertia.
    pub const fn new(first: f64, second: f64, third: f64) -> Self {
        Self {
            moments: Vector3::new(first, second, third),
        }
    }
}

impl RigidBody for FreeBody {
    fn moments(&self) -> Vector3<f64> {
        self.moments
    }

    fn torque(&self, _time: f64, _attitude: &UnitQuaternion<f64>) -> Vector3<f64> {
        Vector3::zeros()
    }

    fn potential(&self, _time: f64, _attitude: &UnitQuaternion<f64>) -> Option<f64> {
        Some(0.0)
    }
}

/// A rigid body with a fixed point in gravity along −e3: `V = mg e3·Rχ`, `τ = mg (Rᵀe3) × χ`; `χ` is the vector from
/// the fixed point to the centre of mass.
///
/// It is Lagrange's top if two moments are equal and `χ` lies on the third axis.
///
/// ```
/// use symplectic::nalgebra::{UnitQuaternion, Vector3};
/// use symplectic::rotation::{HeavyTop, RigidBody};
///
/// let top = HeavyTop { moments: Vector3::new(1.0, 1.0, 0.5), weight: 2.0, centre: Vector3::new(0.0, 0.0, 0.3) };
/// let upright = UnitQuaternion::identity();
/// assert_eq!(top.potential(0.0, &upright), Some(0.6));
/// assert_eq!(top.torque(0.0, &upright), Vector3::zeros());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeavyTop {
    /// The principal moments of inertia about the fixed point.
    pub moments: Vector3<f64>,
    /// The weight mg.
    pub weight: f64,
    /// The centre of mass χ relative to the fixed point, in components along the principal axes.
    pub centre: Vector3<f64>,
}

impl RigidBody for HeavyTop {
    fn moments(&self) -> Vector3<f64> {
        self.moments
    }

    fn torque(&self, _time: f64, attitude: &UnitQuaternion<f64>) -> Vector3<f64> {
        let up = attitude.inverse_transform_vector(&Vector3::z());
        up.cross(&self.centre) * self.weight
    }

    fn potential(&self, _time: f64, attitude: &UnitQuaternion<f64>) -> Option<f64> {
        Some((attitude * self.centre).z * self.weight)
    }
}
