//! A harmonic oscillator with linear friction, `x'' = −x − γ x'` with γ = 1/4, whose friction is a part of every kick: class `Damped`.
//!
//! *Needs:* a splitting with its order for separable Hamiltonians. *Source:* every textbook of mechanics; the numbers are our choice.
//! *Reference:* closed form, [`exact`].

use symplectic::State;
use symplectic::nalgebra::Vector1;

/// γ
const FRICTION: f64 = 0.25;

symplectic::hamiltonian! {
    /// The oscillator.
    pub Oscillator { gamma: 0.25 }
    q: [x], p: [px];
    H = (px^2 + x^2)/2
    friction: gamma
}

/// The state at `time`: a decaying oscillation with ω² = 1 − γ²/4.
pub fn exact(time: f64) -> State<Vector1<f64>> {
    let half = FRICTION / 2.0;
    let omega = (1.0 - half * half).sqrt();
    let (sine, cosine) = (omega * time).sin_cos();
    let decay = (-half * time).exp();
    // x = 1 and x' = 1/2 at time 0.
    let slope = (0.5 + half) / omega;
    let place = decay * (cosine + slope * sine);
    let rate = decay * omega * (slope * cosine - sine) - half * place;
    State::from_arrays(time, [place], [rate])
}

/// The state at time 0.
pub fn start() -> State<Vector1<f64>> {
    exact(0.0)
}

#[cfg(test)]
mod tests {
    use symplectic::Integrator;

    use super::*;
    use crate::methods::ForestRuth;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        check::derivatives(&Oscillator::new(), &exact(1.0), 1e-5, 1e-8);
    }

    /// By difference quotients it solves the equation, and a method of order 4 stays near it.
    #[test]
    fn the_closed_form_is_a_motion() {
        let (before, here, after) = (exact(0.7 - 1e-4), exact(0.7), exact(0.7 + 1e-4));
        let rates = [
            (after.q[0] - before.q[0]) / 2e-4,
            (after.p[0] - before.p[0]) / 2e-4,
        ];
        assert!((rates[0] - here.p[0]).abs() < 1e-8);
        assert!((rates[1] + here.q[0] + FRICTION * here.p[0]).abs() < 1e-8);
        assert_eq!(start(), State::from_arrays(0.0, [1.0], [0.5]));
        let mut run =
            Integrator::new(ForestRuth, Oscillator::new(), start(), 1.0 / 64.0).expect("a start");
        let end = run.integrate_to(10.0).expect("steps");
        assert!((end.q - exact(10.0).q).norm() < 1e-7);
    }
}
