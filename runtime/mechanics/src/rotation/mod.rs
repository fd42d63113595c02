//! Rigid bodies with a fixed point: variational integrators on SO(3).
//!
//! The attitude `R` maps components along the principal axes of the body to components in space. `Π` is the angular
//! momentum in the frame of the body, `I` the diagonal matrix of the principal moments of inertia, `Ω = I⁻¹Π` and `τ`
//! the torque:
//!
//! ```text
//! R' = R Ω̂      Π' = Π × Ω + τ(t, R)      H = Π·I⁻¹Π/2 + V(t, R)
//! ```
//!
//! $$ \dot R = R \hat\Omega \qquad \dot\Pi = \Pi \times \Omega + \tau(t, R) \qquad H = \tfrac12 \Pi \cdot I^{-1} \Pi + V(t, R) $$
//!
//! The discrete Lagrangian is `Ld(R0, R1) = h ℓ(ξ) − (h/2)(V(R0) + V(R1))` with `R1 = R0 exp(hξ̂)` and `ℓ = ξ·Iξ/2`.
//! Its step is a kick by `(h/2) τ`, a free step and a kick by `(h/2) τ`. The free step follows a geodesic (Leok & Zhang
//! 2011, §5, eq. 51, with one stage):
//!
//! ```text
//! Π0 = Iξ + (h/2) ξ×Iξ + h²κ ξ×(ξ×Iξ)      κ = (1 − (θ/2) cot(θ/2))/θ²      θ = h|ξ| < π
//! R1 = R0 F      Π1 = Fᵀ Π0      F = exp(hξ̂)
//! ```
//!
//! The method is symmetric, symplectic and of order 2. Without torque the angular momentum in space, `RΠ`, is conserved
//! exactly; with a potential that is symmetric about an axis, so is its component along that axis. A composition of
//! Störmer–Verlet steps has the order of the composition.
//!
//! # Rounding
//!
//! The integrator stores the angular momentum in space, which a free step leaves unchanged, and the attitude as a unit
//! quaternion. Only the norm of the quaternion drifts. Every step corrects it, parallel to the quaternion, which does
//! not rotate the body; so `RᵀR = 1` to rounding after any number of steps. Momentum and quaternion are compensated
//! sums.
//!
//! ```
//! use symplectic::nalgebra::{UnitQuaternion, Vector3};
//! use symplectic::rotation::{Error, FreeBody, RotationSteps, RotationState};
//!
//! # fn main() -> Result<(), Error> {
//! // A book that turns about its middle axis, almost: it tumbles.
//! let book = FreeBody::new(1.0, 2.0, 3.0);
//! let start = RotationState::new(0.0, UnitQuaternion::identity(), Vector3::new(0.01, 2.0, 0.0));
//! let mut run = RotationSteps::run(book, start, 0.01)?;
//! let before = run.stepper().spatial_momentum();
//! run.integrate_to(10.0)?;
//! assert_eq!(run.stepper().spatial_momentum(), before);
//! # Ok(())
//! # }
//! ```

mod attitude;
mod body;
#[cfg(feature = "alloc")]
mod checkpoint;
mod free_step;
mod integrator;
mod state;

pub use crate::Error;
pub use body::{FreeBody, HeavyTop, RigidBody};
pub use integrator::{RotationIntegrator, RotationSteps};
pub use state::RotationState;
