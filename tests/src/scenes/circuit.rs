//! A circuit of an inductor and three capacitors (Yoshimura & Marsden 2006): the charges q that have passed each element, with
//!
//! ```text
//! L = ℓ q₀'²/2 − q₁²/2C₁ − q₂²/2C₂ − q₃²/2C₃      q₀' = q₂',  q₂' = q₁' + q₃'   (Kirchhoff)
//! ```
//!
//! *Needs:* Dirac mechanics: L has no velocities of the capacitors, so p₁ = p₂ = p₃ = 0.
//! *Source:* the circuit of Yoshimura & Marsden, J. Geom. Phys. 57 (2006); the numbers are our choice.
//! *Reference:* [`exact`], a closed form.

use std::cell::Cell;

use symplectic::constraints::Gradients;
use symplectic::nalgebra::{SVector, Vector4};
use symplectic::system::Lagrangian;
use symplectic::variational::{DiracSystem, momentum_of_velocity};
use symplectic::{General, Hamiltonian, Scalar, State};

const INDUCTANCE: f64 = 0.7;
/// C₁, C₂ and C₃.
const CAPACITIES: [f64; 3] = [1.3, 0.6, 0.9];

/// The circuit as a degenerate Lagrangian with two constraints.
#[derive(Clone, Debug, Default)]
pub struct Circuit {
    /// Number of evaluations of the Lagrangian.
    pub evaluations: Cell<u64>,
}

impl Lagrangian for Circuit {
    type Vector<T: Scalar> = SVector<T, 4>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &SVector<T, 4>, v: &SVector<T, 4>) -> T {
        self.evaluations.set(self.evaluations.get() + 1);
        v[0] * v[0] * T::from_f64(0.5 * INDUCTANCE) - stored(q)
    }
}

impl DiracSystem for Circuit {
    fn nonholonomic_constraints(&self) -> usize {
        2
    }

    fn nonholonomic_rows<T: Scalar>(&self, _: &SVector<T, 4>, rows: &mut Gradients<T>) {
        rows.set(0, 0, -T::one());
        rows.set(0, 2, T::one());
        rows.set(1, 1, -T::one());
        rows.set(1, 2, T::one());
        rows.set(1, 3, -T::one());
    }
}

/// The energy of the capacitors.
fn stored<T: Scalar>(q: &SVector<T, 4>) -> T {
    let [a, b, c] = CAPACITIES.map(|capacity| T::from_f64(0.5 / capacity));
    q[1] * q[1] * a + q[2] * q[2] * b + q[3] * q[3] * c
}

/// The rates of all charges for a current 1 in the inductor: parallel capacitors share it by their capacities.
fn shares() -> Vector4<f64> {
    let [a, _, c] = CAPACITIES;
    Vector4::new(1.0, a / (a + c), 1.0, c / (a + c))
}

/// The same motion with the laws of Kirchhoff solved by hand, for methods without constraints.
#[derive(Clone, Copy, Debug)]
pub struct SolvedByHand;

impl Hamiltonian for SolvedByHand {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 4>;

    fn velocity<T: Scalar>(
        &self,
        _time: T,
        _q: &SVector<T, 4>,
        p: &SVector<T, 4>,
        velocity: &mut SVector<T, 4>,
    ) {
        let current = p[0] * T::from_f64(1.0 / INDUCTANCE);
        *velocity = shares().map(|share| T::from_f64(share) * current);
    }

    fn force<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 4>,
        _p: &SVector<T, 4>,
        force: &mut SVector<T, 4>,
    ) {
        let [a, b, _] = CAPACITIES.map(|capacity| T::from_f64(1.0 / capacity));
        *force = SVector::from([-(q[1] * a + q[2] * b), T::zero(), T::zero(), T::zero()]);
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 4>, p: &SVector<T, 4>) -> Option<T> {
        Some(p[0] * p[0] * T::from_f64(0.5 / INDUCTANCE) + stored(q))
    }
}

/// The current 0.4 in the inductor, and the same voltage on both parallel capacitors.
pub fn start() -> State<SVector<f64, 4>> {
    let [a, _, c] = CAPACITIES;
    let q = Vector4::new(0.1, 0.5 * a / c, -0.3, 0.5);
    let v = shares() * 0.4;
    let p = momentum_of_velocity(&Circuit::default(), 0.0, &q, &v).expect("finite");
    State::new(0.0, q, p)
}

/// The state at `time`: an oscillation with ω² = (1/(C₁ + C₃) + 1/C₂)/ℓ.
pub fn exact(time: f64) -> State<SVector<f64, 4>> {
    let State { q, p, .. } = start();
    let [a, b, c] = CAPACITIES;
    let omega = ((1.0 / (a + c) + 1.0 / b) / INDUCTANCE).sqrt();
    let (current, voltage) = (p[0] / INDUCTANCE, q[1] / a + q[2] / b);
    let (sin, cos) = (omega * time).sin_cos();
    let charge = current / omega * sin + voltage / (INDUCTANCE * omega * omega) * (cos - 1.0);
    let momentum = INDUCTANCE * current * cos - voltage / omega * sin;
    State::from_arrays(
        time,
        (q + shares() * charge).into(),
        [momentum, 0.0, 0.0, 0.0],
    )
}

#[cfg(test)]
mod tests {
    use symplectic::variational::{DiracRule, DiracSteps};

    use super::*;

    /// The closed form obeys the equations solved by hand, and the integrator with constraints follows it.
    #[test]
    fn the_closed_form_solves_both_formulations() {
        for time in [0.3, 1.1, 7.0] {
            let (before, here, after) = (exact(time - 1e-4), exact(time), exact(time + 1e-4));
            let (mut velocity, mut force) = (Vector4::zeros(), Vector4::zeros());
            SolvedByHand.velocity(time, &here.q, &here.p, &mut velocity);
            SolvedByHand.force(time, &here.q, &here.p, &mut force);
            assert!(((after.q - before.q) / 2e-4 - velocity).norm() < 1e-7);
            assert!(((after.p - before.p) / 2e-4 - force).norm() < 1e-7);
        }
        let circuit = Circuit::default();
        let run = DiracSteps::run(DiracRule::Trapezoid, circuit, start(), 1.0 / 256.0);
        let mut run = run.expect("a start");
        let end = run.integrate_to(10.0).expect("steps").clone();
        assert!((end.q - exact(10.0).q).norm() < 1e-4);
    }
}
