//! Indicators of chaos.

use super::check_even;
use super::dual_vector::halves;
use crate::Error;
use symplectic_core::inside::{check_state, words};
use symplectic_core::solver::{Visit, Words};
use symplectic_core::{Checkpoint, CheckpointError, Scalar, State, Vector};

/// MEGNO, the mean exponential growth factor of nearby orbits, and the largest Lyapunov exponent, from the growth of a
/// [displacement](super::Tangent) `δ(t)`:
///
/// ```text
/// Y(t) = 2/t ∫₀ᵗ s d ln|δ(s)| = 2 (ln|δ(t)| − 1/t ∫₀ᵗ ln|δ(s)| ds)      Ȳ(t) = 1/t ∫₀ᵗ Y(s) ds      |δ(0)| = 1
/// ```
///
/// | orbit | `∣δ∣` grows like | Ȳ tends to | λ tends to |
/// |---|---|---|---|
/// | quasi-periodic | t | 2 | 0 |
/// | of linear oscillators | 1 | 0 | 0 |
/// | chaotic, or near an unstable periodic one | `e^{λt}` | `λt/2` | λ |
///
/// Ȳ tends to 2 from below, slowly near stable periodic orbits. The integrals use the trapezoidal rule between the
/// observed states: observe at least one state per period, at any times.
///
/// Source: Cincotta, Giordano & Simó, Physica D 182 (2003) 151; the second form of Y follows by partial integration.
///
/// See [`Tangent`](super::Tangent) for an example. An indicator is saved as a [`Checkpoint`], next to that of the run, and resumes with the
/// same bits. With the feature `serde` it is written as this checkpoint.
///
/// ```
/// use symplectic::nalgebra::{Vector1, Vector2};
/// use symplectic::tangent::{Megno, Tangent};
/// use symplectic::{Checkpoint, Integrator, State};
///
/// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
/// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let system = Tangent::new(Pendulum);
/// let displacement = (&Vector1::new(1.0), &Vector1::new(0.0));
/// let start: State<Vector2<f64>> = system.start(&State::from_arrays(0.0, [3.0], [0.0]), displacement)?;
/// let (mut megno, mut run) = (Megno::new(&start)?, Integrator::new(VelocityVerlet, system, start, 0.1)?);
/// for _ in 0..100 {
///     megno.see(run.step()?);
/// }
/// let saved = [run.checkpoint()?, Checkpoint::from(megno)];
///
/// // In another process, after `run` is made again.
/// run.restore(&saved[0])?;
/// let mut resumed = Megno::try_from(&saved[1])?;
/// resumed.see(run.step()?);
/// # megno.see(run.state());
/// # assert_eq!(megno, resumed);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(into = "Checkpoint", try_from = "Checkpoint"))]
pub struct Megno {
    begin: f64,
    /// Time since `begin`; negative in a backward run.
    elapsed: f64,
    /// ln|δ| at the start.
    first: f64,
    /// ln|δ| − `first`.
    growth: f64,
    /// Integral of `growth` over |t|.
    area: f64,
    value: f64,
    /// Integral of `value` over |t|.
    sum: f64,
}

impl Megno {
    /// An indicator that begins at `start`, a state of a [`Tangent`](super::Tangent).
    ///
    /// # Errors
    ///
    /// [`Error::NoDisplacement`] for a zero displacement. [`Error::Core`] with `NonFiniteState`, `Dimension` if position and momentum differ
    /// in dimension, `Length` if it is odd.
    pub fn new<W: Vector<Scalar = f64>>(start: &State<W>) -> Result<Self, Error> {
        check_even(&start.q)?;
        check_state(start.time, &start.q, &start.p, start.q.dimension())?;
        let first = logarithm(start).ok_or(Error::NoDisplacement)?;
        Ok(Self {
            begin: start.time,
            elapsed: 0.0,
            first,
            growth: 0.0,
            area: 0.0,
            value: 0.0,
            sum: 0.0,
        })
    }

    /// Observes the next state of the run, forward or backward in time. A state that does not follow the last observed
    /// state in that direction is ignored.
    pub fn see<W: Vector<Scalar = f64>>(&mut self, state: &State<W>) {
        let elapsed = state.time - self.begin;
        let (time, step) = (elapsed.abs(), elapsed.abs() - self.elapsed.abs());
        let Some(logarithm) = logarithm(state) else {
            return;
        };
        if !(step > 0.0 && elapsed * self.elapsed >= 0.0) {
            return;
        }
        let growth = logarithm - self.first;
        self.area += step * (0.5 * (self.growth + growth));
        let value = 2.0 * (growth - self.area / time);
        self.sum += step * (0.5 * (self.value + value));
        (self.elapsed, self.growth, self.value) = (elapsed, growth, value);
    }

    /// Y(t). For quasi-periodic orbits it oscillates around 2.
    pub const fn value(&self) -> f64 {
        self.value
    }

    /// Ȳ(t), the indicator plotted in stability maps.
    pub fn mean(&self) -> f64 {
        self.over_time(self.sum)
    }

    /// `λ = ln(|δ(t)|/|δ(0)|)/t`, which tends to the largest Lyapunov exponent; for regular orbits to zero, like `ln t/t`.
    pub fn lyapunov_exponent(&self) -> f64 {
        self.over_time(self.growth)
    }

    /// `ln(|δ(t)|/|δ(0)|)`.
    pub const fn growth(&self) -> f64 {
        self.growth
    }

    fn over_time(&self, quantity: f64) -> f64 {
        match self.elapsed.abs() {
            0.0 => 0.0,
            time => quantity / time,
        }
    }
}

impl Words for Megno {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.begin, self.elapsed, self.first, self.growth, self.area, self.value, self.sum);
    }
}

/// The name of its checkpoints.
const NAME: &str = "MEGNO";

impl From<Megno> for Checkpoint {
    fn from(mut megno: Megno) -> Self {
        Self::of_values(NAME).filled(|visit| megno.words(visit))
    }
}

impl TryFrom<&Checkpoint> for Megno {
    type Error = CheckpointError;

    fn try_from(checkpoint: &Checkpoint) -> Result<Self, CheckpointError> {
        let mut megno = Self {
            begin: 0.0,
            elapsed: 0.0,
            first: 0.0,
            growth: 0.0,
            area: 0.0,
            value: 0.0,
            sum: 0.0,
        };
        checkpoint.read(&Checkpoint::of_values(NAME), |visit| megno.words(visit))?;
        Ok(megno)
    }
}

impl TryFrom<Checkpoint> for Megno {
    type Error = CheckpointError;

    fn try_from(checkpoint: Checkpoint) -> Result<Self, CheckpointError> {
        Self::try_from(&checkpoint)
    }
}

/// ln|δ| of a state of a tangent system, scaled against overflow and underflow; `None` for δ = 0.
fn logarithm<W: Vector<Scalar = f64>>(state: &State<W>) -> Option<f64> {
    let (q, p) = state.as_slices();
    let parts = || {
        let (dq, dp) = (halves(q).1, halves(p).0);
        dq.iter().chain(dp).map(|part| part.abs())
    };
    let largest = parts().fold(0.0, f64::max);
    if largest == 0.0 {
        return None;
    }
    let square = parts().fold(0.0, |sum, part| {
        let part = part / largest;
        sum + part * part
    });
    Some(Scalar::ln(largest) + 0.5 * Scalar::ln(square))
}
