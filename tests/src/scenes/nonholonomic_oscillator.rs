//! An oscillator in the plane with a third coordinate that obeys the non-holonomic constraint z' = y x'.
//!
//! *Needs:* a method that is `nonholonomic`.
//! *Source:* Rosenberg, Analytical dynamics of discrete systems (1977), the particle with z' = y x'; the potential of Cortés & Martínez,
//! Nonlinearity 14 (2001); the numbers are our choice.
//! *Reference:* [`exact`], two integrals of closed forms.

use symplectic::State;
use symplectic::nalgebra::SVector;

symplectic::hamiltonian! {
    /// The particle in space.
    pub Oscillator
    q: [x, y, z], p: [px, py, pz], v: [vx, vy, vz];
    H = (px^2 + py^2 + pz^2 + x^2 + y^2)/2
    nonholonomic: { carried = vz - y vx }
}

/// x, y, x' and y' at time 0.
const START: [f64; 4] = [0.6, 0.5, 0.8, 0.9];
/// Number of steps of the integrals; their error is below 1e-13 up to time 20.
const STEPS: u32 = 40_000;

/// The state at `time`: y'' = −y; with s = √(1 + y²) and dτ = dt/s the constraint leaves d²x/dτ² = −x, and z' = y x'.
pub fn exact(time: f64) -> State<SVector<f64, 3>> {
    let [x0, y0, x_rate0, y_rate0] = START;
    let y = |t: f64| y0 * t.cos() + y_rate0 * t.sin();
    let s = |t: f64| y(t).hypot(1.0);
    let slope = x_rate0 * s(0.0);
    let x_rate = |t: f64, tau: f64| (slope * tau.cos() - x0 * tau.sin()) / s(t);
    let h = time / f64::from(STEPS);
    let (mut tau, mut z) = (0.0, 0.0);
    for k in 0..STEPS {
        let start = f64::from(k) * h;
        // Simpson's rule; τ at the midpoint is the integral of the parabola through 1/s at both ends and the midpoint.
        let rates = [0.0, 0.5, 1.0].map(|part| 1.0 / s(start + part * h));
        let half = tau + h / 24.0 * (5.0 * rates[0] + 8.0 * rates[1] - rates[2]);
        let whole = tau + h / 6.0 * (rates[0] + 4.0 * rates[1] + rates[2]);
        let carried = |part: f64, tau: f64| {
            let t = start + part * h;
            y(t) * x_rate(t, tau)
        };
        z += h / 6.0 * (carried(0.0, tau) + 4.0 * carried(0.5, half) + carried(1.0, whole));
        tau = whole;
    }
    let rate = x_rate(time, tau);
    let x = x0 * tau.cos() + slope * tau.sin();
    let y_rate = y_rate0 * time.cos() - y0 * time.sin();
    State::from_arrays(time, [x, y(time), z], [rate, y_rate, y(time) * rate])
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
        check::derivatives(&Oscillator, &exact(1.0), 1e-5, 1e-8);
    }

    /// The velocities equal the momenta and obey the constraint, and the energy is conserved.
    #[test]
    fn the_closed_form_is_a_motion() {
        let energy = |state: &State<SVector<f64, 3>>| {
            System::energy(&Oscillator, 0.0, &state.q, &state.p).expect("known")
        };
        for time in [0.3, 1.1, 7.0] {
            let (before, here, after) = (exact(time - 1e-4), exact(time), exact(time + 1e-4));
            assert!(((after.q - before.q) / 2e-4 - here.p).norm() < 1e-7);
            assert!((here.p[2] - here.q[1] * here.p[0]).abs() < 1e-15);
            assert!((energy(&here) - energy(&start())).abs() < 1e-13);
        }
        let mut run = Integrator::new(Midpoint4, Oscillator, start(), 1.0 / 64.0).expect("a start");
        let end = run.integrate_to(10.0).expect("steps");
        assert!((end.q - exact(10.0).q).norm() < 1e-5);
    }
}
