//! A disk of radius 1 that rolls upright on a plane without slipping: two non-holonomic constraints.
//!
//! (x, y) is the point of contact, θ the rolling angle, φ the heading. The disk moves on a circle.
//!
//! *Needs:* a method that is `nonholonomic`. *Source:* Bloch, Nonholonomic mechanics and control (2003), §1.4, without
//! forces; the numbers are our choice. *Reference:* closed form, [`exact`].

use symplectic::State;
use symplectic::nalgebra::SVector;

symplectic::hamiltonian! {
    /// The disk, with the moment of inertia about its axis; the moment about a diameter is half of it.
    pub Disk { inertia: 0.5 }
    q: [x, y, theta, phi], p: [px, py, ptheta, pphi], v: [vx, vy, rolls, turns];
    H = (px^2 + py^2)/2 + ptheta^2/(2 inertia) + pphi^2/inertia
    nonholonomic: { along_x = vx - cos(phi) rolls, along_y = vy - sin(phi) rolls }
}

/// The rolling rate and the turning rate.
const RATES: [f64; 2] = [1.25, 0.5];

/// The state at `time`: θ' and φ' are constant.
pub fn exact(time: f64) -> State<SVector<f64, 4>> {
    let [rolls, turns] = RATES;
    let (theta, phi) = (rolls * time, turns * time);
    let (sine, cosine) = phi.sin_cos();
    let radius = rolls / turns;
    let q = [radius * sine, radius * (1.0 - cosine), theta, phi];
    let p = [rolls * cosine, rolls * sine, 0.5 * rolls, 0.25 * turns];
    State::from_arrays(time, q, p)
}

/// The state at time 0.
pub fn start() -> State<SVector<f64, 4>> {
    exact(0.0)
}

#[cfg(test)]
mod tests {
    use symplectic::{Integrator, System};

    use super::*;
    use crate::methods::Midpoint4;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        check::derivatives(&Disk::new(), &exact(1.0), 1e-5, 1e-8);
    }

    /// By difference quotients, x', y' and θ' obey the constraints and the momenta match the velocities.
    #[test]
    fn the_closed_form_is_a_motion() {
        let (before, here, after) = (exact(0.7 - 1e-4), exact(0.7), exact(0.7 + 1e-4));
        let rates = (after.q - before.q) / 2e-4;
        let mut velocity = here.q;
        System::velocity(&Disk::new(), 0.7, &here.q, &here.p, &mut velocity);
        assert!((rates - velocity).norm() < 1e-8);
        assert!((velocity[0] - velocity[2] * here.q[3].cos()).abs() < 1e-15);
        assert!((velocity[1] - velocity[2] * here.q[3].sin()).abs() < 1e-15);
        // A method of order 4 stays near it.
        let mut run =
            Integrator::new(Midpoint4, Disk::new(), start(), 1.0 / 64.0).expect("a start");
        let end = run.integrate_to(10.0).expect("steps");
        assert!((end.q - exact(10.0).q).norm() < 1e-6);
    }
}
