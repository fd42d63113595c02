//! States whose velocities obey the constraints.

use crate::constraints::holonomic::{CONSISTENT, Examined, check_numbers};
use crate::constraints::kind::with_constraints;
use crate::constraints::{Nonholonomic, WithConstraints};
use symplectic_core::system::{Class, Unconstrained};
use symplectic_core::{Error, State, System, Vector};

/// Checks that the velocity of a state obeys the constraints, and that these are independent.
pub(super) fn check_start<V: Vector, S: System<V>>(
    system: &WithConstraints<'_, V, S>,
    time: f64,
    q: &V,
    p: &V,
) -> Result<(), Error> {
    system.check_given()?;
    let examined = system.check(time, Examined::new(system, time, q, p))?;
    let (constraint, rate) = examined.momentum();
    if rate <= CONSISTENT {
        return Ok(());
    }
    Err(Error::InconsistentVelocity {
        constraint,
        name: system.constraint_name(constraint),
        rate: examined.rate(constraint),
    })
}

/// The state of a system with non-holonomic constraints that is nearest to `state` in the metric of its masses, at the same position:
///
/// ```text
/// p ← p − w(q)ᵀν    with w(q) ∂H/∂p(q, p) = 0
/// ```
///
/// An integrator does not project by itself: [`Integrator::new`](symplectic_core::Integrator#method.new) refuses a state whose velocity does not obey
/// the constraints.
///
/// # Errors
///
/// [`Error::NoExtra`] if the system does not give its constraints; [`Error::NoConsistentState`] if the iteration does not converge; [`Error::DependentConstraints`],
/// [`Error::NonFiniteState`], [`Error::ResizedEvaluation`], and the errors of a system whose rows are wrong.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::constraints::consistent_momentum;
/// use symplectic::{Error, State};
///
/// symplectic::lagrangian! { Skate q: [x, y, a], v: [vx, vy, va]; L = (vx^2 + vy^2 + va^2)/2 nonholonomic: { blade = vx sin(a) - vy cos(a) } }
///
/// # fn main() -> Result<(), Error> {
/// // A skate, x' sin a − y' cos a = 0, that points along y and is pushed along both axes.
/// let pushed: State<SVector<f64, 3>> = State::from_arrays(0.0, [0.0, 0.0, std::f64::consts::FRAC_PI_2], [3.0, 2.0, 1.0]);
/// let start = consistent_momentum(&Skate, pushed)?;
/// assert!(start.p[0].abs() < 1e-15 && (start.p[1] - 2.0).abs() < 1e-15 && start.p[2] == 1.0);
/// # Ok(())
/// # }
/// ```
pub fn consistent_momentum<V, S, C>(system: &S, state: State<V>) -> Result<State<V>, Error>
where
    V: Vector,
    S: System<V, Class = Nonholonomic<C>>,
    C: Class + Unconstrained,
{
    let State { time, q, mut p } = state;
    check_numbers(&q, &p)?;
    let system = &with_constraints(system, q.dimension());
    system.check_given()?;
    let mut examined = system.check(time, Examined::new(system, time, &q, &p))?;
    let projected = examined.project_momentum(system, time, &q, &mut p);
    system.check(time, projected)?;
    let (constraint, rate) = examined.momentum();
    if rate <= CONSISTENT {
        check_numbers(&q, &p)?;
        return Ok(State { time, q, p });
    }
    Err(Error::NoConsistentState {
        value: 0.0,
        rate: examined.rate(constraint),
    })
}
