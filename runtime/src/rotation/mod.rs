//! Rigid bodies that turn about a fixed point: variational integrators on SO(3).
//!
//! The attitude `R` takes components along the principal axes of the body to components in space; `Π` is the angular momentum along the
//! axes of the body, `I` the diagonal matrix of the principal moments of inertia, `Ω = I⁻¹Π` and `τ` the torque:
//!
//! ```text
//! R' = R Ω̂      Π' = Π × Ω + τ(t, R)      H = Π·I⁻¹Π/2 + V(t, R)
//! ```
//!
//! $$ \dot R = R \hat\Omega \qquad \dot\Pi = \Pi \times \Omega + \tau(t, R) \qquad H = \tfrac12 \Pi \cdot I^{-1} \Pi + V(t, R) $$
//!
//! A step of the discrete Lagrangian `Ld(R0, R1) = h ℓ(ξ) − (h/2)(V(R0) + V(R1))`, `R1 = R0 exp(hξ̂)`, `ℓ = ξ·Iξ/2`, is a kick by `(h/2) τ`, a free step and
//! a kick by `(h/2) τ`. The free step goes along a geodesic (Leok & Zhang 2011, §5, eq. 51, with one stage):
//!
//! ```text
//! Π0 = Iξ + (h/2) ξ×Iξ + h²κ ξ×(ξ×Iξ)      κ = (1 − (θ/2) cot(θ/2))/θ²      θ = h|ξ| < π
//! R1 = R0 F      Π1 = Fᵀ Π0      F = exp(hξ̂)
//! ```
//!
//! It is symmetric, symplectic and of order 2. The angular momentum in space, `RΠ`, is conserved exactly if there is no torque, and its component along
//! an axis if the potential is symmetric about that axis. With a composition of Störmer–Verlet steps it has the order of that
//! composition.
//!
//! # Rounding
//!
//! The integrator carries the angular momentum in space, which a free step does not touch, and the attitude as a unit quaternion. Its norm is
//! the only thing that can go wrong, and is corrected in every step, along the quaternion and not across it: `RᵀR = 1` to rounding after any number of
//! steps, and the correction does not turn the body. Momentum and quaternion are compensated sums.
//!
//! ```
//! use symplectic::nalgebra::{UnitQuaternion, Vector3};
//! use symplectic::rotation::{FreeBody, RotationIntegrator, RotationState};
//!
//! # fn main() -> Result<(), symplectic::Error> {
//! // A book that turns about its middle axis, almost: it tumbles.
//! let book = FreeBody::new(1.0, 2.0, 3.0);
//! let start = RotationState::new(0.0, UnitQuaternion::identity(), Vector3::new(0.01, 2.0, 0.0));
//! let mut run = RotationIntegrator::new(book, start, 0.01)?;
//! let before = run.spatial_momentum();
//! run.integrate_to(10.0)?;
//! assert_eq!(run.spatial_momentum(), before);
//! # Ok(())
//! # }
//! ```

mod attitude;
mod body;
mod free_step;
mod integrator;
mod state;

pub use body::{FreeBody, HeavyTop, RigidBody};
pub use integrator::RotationIntegrator;
pub use state::RotationState;
