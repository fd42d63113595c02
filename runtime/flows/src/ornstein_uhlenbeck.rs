//! A heat bath: friction and noise.

use super::philox::normal_pair;
use super::{Flow, FlowError, Span, check_dimension, check_parameter};
use crate::Error;
use symplectic_core::{Scalar, Vector};

/// A heat bath, the Ornstein–Uhlenbeck process `dp = −γp dt + √(2γ m kT) dW`, exact in law:
///
/// ```text
/// p ← e^{−γh} p + √(m kT (1 − e^{−2γh})) ξ      ξ standard normal
/// ```
///
/// The stationary distribution of p is that of Maxwell and Boltzmann. `Palindrome::new(kick, Palindrome::new(drift, ou))` is BAOAB, the
/// splitting of these parts with the most accurate position averages (Leimkuhler & Matthews, *Appl. Math. Res. Express* 2013, 34).
///
/// The random numbers come from the counter-based generator Philox-4×32-10. They depend only on the seed, the number of the
/// [draw](Self::draws) and the component, and are the same on every machine. Every call of the flow is one draw. If a step fails, a
/// [`FlowIntegrator`](super::FlowIntegrator) with the feature `alloc` resets the number of draws. Several baths in one step need different
/// seeds.
///
/// ```
/// symplectic::tableau! { Verlet { base: velocity-verlet } }
/// use symplectic::flow::{Drift, FlowSteps, Kick, OrnsteinUhlenbeck, Palindrome};
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{State, acceleration};
///
/// # fn main() -> Result<(), symplectic::flow::Error> {
/// let spring = || acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0]);
/// let run = |seed| {
///     let bath = OrnsteinUhlenbeck::new(0.5, 1.0, [1.0], seed)?;
///     let step = Palindrome::new(Kick::new(spring()), Palindrome::new(Drift::new(spring()), bath));
///     let mut run = FlowSteps::run(step, State::from_arrays(0.0, [1.0], [0.0]), 0.1)?;
///     run.integrate_to(10.0)?;
///     Ok::<_, symplectic::flow::Error>(run.into_state())
/// };
/// assert_eq!(run(1)?, run(1)?);
/// assert_ne!(run(1)?, run(2)?);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct OrnsteinUhlenbeck<W> {
    friction: f64,
    temperature: f64,
    masses: W,
    seed: u64,
    draws: u64,
}

impl<W: AsRef<[f64]>> OrnsteinUhlenbeck<W> {
    /// A bath with the friction rate γ, the temperature `kT`, and the mass of every component of the momentum.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] if a rate or a temperature is negative or not finite, or a mass is not finite and positive.
    pub fn new(friction: f64, temperature: f64, masses: W, seed: u64) -> Result<Self, Error> {
        check_parameter("friction", 0, friction, true)?;
        check_parameter("temperature", 0, temperature, true)?;
        for (index, &mass) in masses.as_ref().iter().enumerate() {
            check_parameter("mass", index, mass, false)?;
        }
        Ok(Self {
            friction,
            temperature,
            masses,
            seed,
            draws: 0,
        })
    }

    /// The number of draws so far: one per call of the flow, each with its own random numbers.
    pub const fn draws(&self) -> u64 {
        self.draws
    }

    /// Sets the number of draws, to continue a run.
    pub const fn set_draws(&mut self, draws: u64) {
        self.draws = draws;
    }
}

impl<V: Vector<Scalar = f64>, W: AsRef<[f64]>> Flow<V> for OrnsteinUhlenbeck<W> {
    fn flow(&mut self, span: Span, _q: &mut V, p: &mut V) -> Result<(), FlowError> {
        let masses = self.masses.as_ref();
        check_dimension(masses.len(), p)?;
        if span.size < 0.0 {
            return Err(FlowError::Backward { size: span.size });
        }
        let exponent = -self.friction * span.size;
        let loss = libm::expm1(exponent);
        let variance = -self.temperature * libm::expm1(2.0 * exponent);
        let pairs = p.as_mut_slice().chunks_mut(2).zip(masses.chunks(2));
        for (pair, (p, masses)) in (0..).zip(pairs) {
            let noise = normal_pair(self.seed, self.draws, pair);
            for ((p, &mass), noise) in p.iter_mut().zip(masses).zip(noise) {
                *p += loss * *p + Scalar::sqrt(mass * variance) * noise;
            }
        }
        self.draws += 1;
        Ok(())
    }

    fn memory(&mut self, visit: &mut dyn FnMut(&mut u64)) {
        visit(&mut self.draws);
    }
}
