//! A skate on a plane that slopes down along x. It moves along its edge only, a non-holonomic constraint.
//!
//! It turns at a constant rate and moves on a cycloid: across the slope, not down.
//!
//! *Needs:* a method that is `nonholonomic`. *Source:* Bloch, Nonholonomic mechanics and control (2003), §1.6, the
//! knife edge; the numbers are our choice. *Reference:* closed form, [`exact`].

use symplectic::State;
use symplectic::nalgebra::SVector;

symplectic::hamiltonian! {
    /// The skate at (x, y) with the direction a.
    pub Skate { slope: 2 }
    q: [x, y, a], p: [px, py, pa], v: [vx, vy, va];
    H = (px^2 + py^2 + pa^2)/2 - slope x
    nonholonomic: { edge = vx sin(a) - vy cos(a) }
}

/// The turning rate.
const RATE: f64 = 1.5;

/// The state at `time`, for the slope 2 and a start at rest along x.
pub fn exact(time: f64) -> State<SVector<f64, 3>> {
    let angle = RATE * time;
    let (sine, cosine) = angle.sin_cos();
    // slope / 2Ω²
    let factor = 1.0 / (RATE * RATE);
    let q = [
        factor * sine * sine,
        factor * (angle - sine * cosine),
        angle,
    ];
    let speed = 2.0 * sine / RATE;
    State::from_arrays(time, q, [speed * cosine, speed * sine, RATE])
}

/// The state at time 0.
pub fn start() -> State<SVector<f64, 3>> {
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
        check::derivatives(&Skate::new(), &exact(1.0), 1e-5, 1e-8);
    }

    /// The velocities equal the momenta and obey the constraint, and the energy is conserved.
    #[test]
    fn the_closed_form_is_a_motion() {
        let energy = |state: &State<SVector<f64, 3>>| {
            System::energy(&Skate::new(), 0.0, &state.q, &state.p).expect("known")
        };
        for time in [0.3, 1.1, 7.0] {
            let (before, here, after) = (exact(time - 1e-4), exact(time), exact(time + 1e-4));
            assert!(((after.q - before.q) / 2e-4 - here.p).norm() < 1e-7);
            let edge = here.p[0] * here.q[2].sin() - here.p[1] * here.q[2].cos();
            assert!(edge.abs() < 1e-15);
            assert!((energy(&here) - energy(&start())).abs() < 1e-14);
        }
        let mut run =
            Integrator::new(Midpoint4, Skate::new(), start(), 1.0 / 64.0).expect("a start");
        let end = run.integrate_to(10.0).expect("steps");
        assert!((end.q - exact(10.0).q).norm() < 1e-5);
    }
}
