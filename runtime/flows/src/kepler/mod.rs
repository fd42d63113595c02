//! Kepler orbits, and the splitting of Wisdom and Holman.
//!
//! Planets move almost on Kepler orbits. So `H = A + B`: `A` is a sum of Kepler problems, solved exactly by [`KeplerDrift`], and `B` is the
//! gravity between planets. `B` is smaller by ε, the ratio of a planet's mass to the star's (Wisdom & Holman, *Astron. J.* 102, 1991). With
//! a method for perturbed systems, such as SABA or ABA(10, 6, 4), the error is `O(εh^s1 + ε²h^s2 + …)`.
//!
//! | coordinates | `A` | `B` |
//! |---|---|---|
//! | [`Jacobi`] | each planet about the centre of mass of the bodies before it | a kick |
//! | [`Heliocentric`] | each planet about the star | a kick and a jump of the star, which commute |
//! | [`Heliocentric::of_pairs`] | each planet and the star as a pair | a kick and jumps: of order 2 |
//!
//! All are canonical, `H` is the same function, and the flows are exact unless noted. The star comes first; for Jacobi the planets follow
//! outward.
//!
//! # Rounding
//!
//! The universal anomaly is always accurate to the last bits. Steps shorter than a third of a period and than a few radii go in lanes,
//! others one at a time. Relative to their largest terms, energy and angular momentum have errors of about ten ε. Over many steps shorter
//! than a seventh of a period these have no common sign: their mean is below ε/100, for eccentricities up to 0.3 and all masses. The centre
//! of mass moves without a drift.
//!
//! Position and velocity at the end have the errors that ten changes of the start by ε would cause, each of the largest component: also if
//! a hyperbola passes its pericentre in one flow. If half of the digits are lost, as of the direction after a fast fall through the centre,
//! the error is [`FlowError::NoOrbit`](super::FlowError::NoOrbit). Over k periods the error of the phase is `kε`; from 2²⁶
//! periods in one flow on, the error is [`FlowError::Periods`](super::FlowError::Periods). Every body has the same bits for every lane
//! width.
//!
//! ```
//! symplectic::tableau! { Saba3 { base: saba-3 } }
//! use symplectic::flow::kepler::Jacobi;
//! use symplectic::flow::{Error, FlowSteps, Splitting};
//! use symplectic::nalgebra::SMatrix;
//! use symplectic::State;
//!
//! # fn main() -> Result<(), Error> {
//! // A star and two planets, in astronomical units and years: G times the mass of the star is 4π².
//! let jacobi = Jacobi::new(39.478, &[1.0, 1e-3, 3e-4])?;
//! let q = SMatrix::<f64, 3, 3>::from_columns(&[[0.0; 3].into(), [5.2, 0.0, 0.0].into(), [0.0, 9.5, 0.0].into()]);
//! let p = SMatrix::<f64, 3, 3>::from_columns(&[[0.0; 3].into(), [0.0, 2.75e-3, 0.0].into(), [-6.1e-4, 0.0, 0.0].into()]);
//! let step = Splitting::new(Saba3, jacobi.drift(), jacobi.kick());
//! let start = jacobi.from_inertial(&State::new(0.0, q, p))?;
//! let mut run = FlowSteps::run(step, start, 0.5)?;
//! run.integrate_to(1000.0)?;
//! let end = jacobi.to_inertial(run.state())?;
//! assert!(end.q.column(1).norm() < 6.0);
//! # Ok(())
//! # }
//! ```

mod attraction;
mod bodies;
mod drift;
mod free;
mod groups;
mod heliocentric;
mod in_lanes;
mod jacobi;
mod orbit;
mod path;
mod stumpff;

pub use drift::KeplerDrift;
pub use heliocentric::{Heliocentric, HeliocentricKick};
pub use jacobi::{Jacobi, JacobiKick};
