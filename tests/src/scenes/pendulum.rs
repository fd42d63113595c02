//! The pendulum `H = p²/2 − cos q`, from the lowest point.
//!
//! *Needs:* nothing. Separable, quadratic kinetic energy, not stiff. It swings for momenta below 2 and rotates above;
//! at 2 it approaches the top asymptotically. *Source:* GNI §I.1.1; the start is our choice. *Reference:* closed form
//! in elliptic functions, [`exact`].

use symplectic::nalgebra::SVector;
use symplectic::system::Masses;
use symplectic::{Scalar, SeparableHamiltonian, State};

use super::Needs;

/// Its needs.
pub const NEEDS: Needs = Needs::NOTHING;

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct Pendulum;

impl SeparableHamiltonian for Pendulum {
    type Vector<T: Scalar> = SVector<T, 1>;

    const MASSES: Masses = Masses::Unit;

    #[inline]
    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
        *velocity = *p;
    }

    #[inline]
    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
        force[0] = -q[0].sin();
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>) -> Option<T> {
        Some(p[0] * p[0] * T::from_f64(0.5) - q[0].cos())
    }
}

/// At the lowest point with this momentum.
pub fn start<T: Scalar>(momentum: f64) -> State<SVector<T, 1>> {
    State::from_arrays(0.0, [T::zero()], [T::from_f64(momentum)])
}

/// The solution from [`start`] with a positive momentum, at `time`.
///
/// With `k = p_0/2` it is `sin(q/2) = k sn(t, k)`, `p = 2k cn(t, k)` below the separatrix, `q = 2 am(kt, 1/k)`,
/// `p = 2k dn(kt, 1/k)` above it, and `sin(q/2) = tanh t`, `p = 2 sech t` on it. The phase error is a few rounding
/// errors of the time; near the separatrix, where orbits diverge, it grows with the time from the lowest point.
pub fn exact(momentum: f64, time: f64) -> State<SVector<f64, 1>> {
    let k = momentum / 2.0;
    let (q, p) = if k < 1.0 {
        let Jacobi { amplitude, delta } = Jacobi::new(time, k, (1.0 - k) * (1.0 + k));
        let (sine, cosine) = amplitude.sin_cos();
        (2.0 * (k * sine).atan2(delta), 2.0 * k * cosine)
    } else if k > 1.0 {
        let complement = (k - 1.0) * (k + 1.0) / (k * k);
        let Jacobi { amplitude, delta } = Jacobi::new(k * time, k.recip(), complement);
        (2.0 * amplitude, 2.0 * k * delta)
    } else {
        (2.0 * time.sinh().atan(), 2.0 / time.cosh())
    };
    State::from_arrays(time, [q], [p])
}

/// Jacobi's elliptic functions at a point.
struct Jacobi {
    /// The amplitude am: `sn = sin am`, `cn = cos am`.
    amplitude: f64,
    /// dn.
    delta: f64,
}

impl Jacobi {
    /// At `u` for the modulus `0 < k < 1` with `complement = 1 − k²`, by the arithmetic-geometric mean and Landen's
    /// descending transformation (Abramowitz & Stegun 16.4).
    fn new(u: f64, k: f64, complement: f64) -> Self {
        let (mut mean, mut geometric) = (1.0, complement.sqrt());
        // c_n/a_n, which converges quadratically: a dozen terms even for the complement 1e-300.
        let mut ratios = Vec::new();
        let mut phase = u;
        loop {
            let half_difference = 0.5 * (mean - geometric);
            (mean, geometric) = (0.5 * (mean + geometric), (mean * geometric).sqrt());
            ratios.push(half_difference / mean);
            phase *= 2.0;
            if half_difference <= f64::EPSILON / 8.0 * mean {
                break;
            }
        }
        phase *= mean;
        for ratio in ratios.iter().rev() {
            phase = 0.5 * (phase + (ratio * phase.sin()).asin());
        }
        // 1 − k² sn² without cancellation.
        let delta = (complement + (k * phase.cos()).powi(2)).sqrt();
        Self {
            amplitude: phase,
            delta,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let state = State::from_arrays(0.0, [0.7], [-1.3]);
        check::derivatives(&Pendulum, &state, 1e-5, 1e-8);
        check::needs(NEEDS, &Pendulum, &state);
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(Pendulum, start(1.0), 0.125, 10.0, 1e-13);
    }

    #[test]
    fn the_closed_form_agrees_with_the_integrator() {
        for momentum in [1e-3, 0.5, 1.0, 1.9, 2.0, 2.1, 4.0] {
            let found = check::end(Pendulum, start(momentum), 1.0 / 32.0, 5.0);
            let expected = exact(momentum, 5.0);
            // At the separatrix neighbouring orbits diverge by a factor e⁵.
            let error = (found.q - expected.q).norm() + (found.p - expected.p).norm();
            assert!(error < 1e-13 * momentum.max(1.0), "{momentum}: {error:e}");
        }
    }

    #[test]
    fn the_closed_form_has_the_digits_of_a_multiprecision_computation() {
        for &(momentum, time, [q, p]) in GOLDEN {
            let state = exact(momentum, time);
            let bound = 16.0 * f64::EPSILON * (1.0 + time);
            let error = (state.q[0] - q).abs().max((state.p[0] - p).abs());
            assert!(error <= bound, "{momentum}, {time}: {error:e}");
        }
    }

    /// Momentum, time, then q and p (mpmath 1.3 with 50 digits, `ellipfun`).
    const GOLDEN: &[(f64, f64, [f64; 2])] = &[
        (0.5, 3.0, [0.09564929471674713, -0.49077304868912364]),
        (1.0, 100.0, [-0.9221904930464955, 0.45623665959681076]),
        (1.5, 0.125, [0.187012954170103, 1.4883305973593366]),
        (1.5, 10000.0, [1.6743368250924304, 0.20805963506388908]),
        (1.984375, 7.0, [-0.0897669422185648, -1.9823449362669103]),
        (2.0, 3.0, [2.9426086822343853, 0.1986558548388664]),
        (3.0, 2.0, [5.076913525789969, 2.777230678468717]),
        (4.0, 100.0, [372.78773208655224, 3.6090700851017377]),
    ];
}
