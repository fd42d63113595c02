//! Chaplygin's sleigh: a body on a plane that glides on two points and on a blade, which moves along its edge only.
//!
//! (x, y) is the position of the blade, a its direction. The motion tends to a straight line with the blade behind the
//! centre of mass.
//!
//! *Needs:* a method that is `nonholonomic`, for a kinetic energy that depends on the position. *Source:* Bloch,
//! Nonholonomic mechanics and control (2003), §1.7; the numbers are our choice. *Reference:* [`exact`], integrals of
//! closed forms.

use symplectic::State;
use symplectic::nalgebra::SVector;

symplectic::lagrangian! {
    /// The sleigh of mass 1; its centre of mass is the distance `length` ahead of the blade.
    pub Sleigh { length: 0.5, inertia: 0.4 }
    q: [x, y, a], v: [vx, vy, turns];
    L = ((vx - length turns sin(a))^2 + (vy + length turns cos(a))^2 + inertia turns^2)/2
    nonholonomic: { edge = vx sin(a) - vy cos(a) }
}

/// Direction, speed along the blade and turning rate at time 0.
const START: [f64; 3] = [0.3, -0.4, 1.1];
/// Number of steps of the integrals; their error is below 1e-13 up to time 20.
const STEPS: u32 = 40_000;

/// The state at `time`: v' = ℓω² and (I + ℓ²)ω' = −ℓvω for the speed v and the rate ω, so that v² + (I + ℓ²)ω² = C², and
///
/// ```text
/// v = C tanh θ    √(I + ℓ²) ω = C / cosh θ    θ' = ℓC/(I + ℓ²)    ℓ a = √(I + ℓ²) 2 atan(tanh(θ/2)) + constant
/// ```
pub fn exact(time: f64) -> State<SVector<f64, 3>> {
    let (length, inertia) = (0.5, 0.4);
    let [angle, speed, rate] = START;
    let whole = f64::mul_add(length, length, inertia);
    let constant = (speed * speed + whole * rate * rate).sqrt();
    let theta = |t: f64| (speed / constant).atanh() + length * constant / whole * t;
    let gudermann = |t: f64| 2.0 * (theta(t) / 2.0).tanh().atan();
    let direction = |t: f64| angle + whole.sqrt() / length * (gudermann(t) - gudermann(0.0));
    let speed = |t: f64| constant * theta(t).tanh();
    let h = time / f64::from(STEPS);
    let [mut x, mut y] = [0.0; 2];
    for k in 0..STEPS {
        // Simpson's rule.
        for (part, weight) in [(0.0, 1.0), (0.5, 4.0), (1.0, 1.0)] {
            let t = (f64::from(k) + part) * h;
            let (sine, cosine) = direction(t).sin_cos();
            x += weight * h / 6.0 * speed(t) * cosine;
            y += weight * h / 6.0 * speed(t) * sine;
        }
    }
    let (a, speed, rate) = (
        direction(time),
        speed(time),
        constant / whole.sqrt() / theta(time).cosh(),
    );
    let (sine, cosine) = a.sin_cos();
    // The velocity of the centre of mass.
    let px = speed * cosine - length * rate * sine;
    let py = speed * sine + length * rate * cosine;
    State::from_arrays(time, [x, y, a], [px, py, whole * rate])
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
        check::derivatives(&Sleigh::new(), &exact(1.0), 1e-5, 1e-8);
    }

    /// The derivatives match the velocities, which obey the constraint, and the energy is conserved.
    #[test]
    fn the_closed_form_is_a_motion() {
        let energy = |state: &State<SVector<f64, 3>>| {
            System::energy(&Sleigh::new(), 0.0, &state.q, &state.p).expect("known")
        };
        for time in [0.3, 1.1, 7.0] {
            let (before, here, after) = (exact(time - 1e-4), exact(time), exact(time + 1e-4));
            let mut velocity = SVector::zeros();
            System::velocity(&Sleigh::new(), 0.0, &here.q, &here.p, &mut velocity);
            assert!(((after.q - before.q) / 2e-4 - velocity).norm() < 1e-7);
            let edge = velocity[0] * here.q[2].sin() - velocity[1] * here.q[2].cos();
            assert!(edge.abs() < 1e-14);
            assert!((energy(&here) - energy(&start())).abs() < 1e-14);
        }
        let mut run =
            Integrator::new(Midpoint4, Sleigh::new(), start(), 1.0 / 64.0).expect("a start");
        let end = run.integrate_to(10.0).expect("steps");
        assert!((end.q - exact(10.0).q).norm() < 1e-5);
    }
}
