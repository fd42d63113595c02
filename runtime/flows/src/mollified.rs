//! A kick by the slow force at mean positions of the fast motion.

use alloc::vec::Vec;

use super::kick::{add, work_vector};
use super::{Flow, FlowError, Linear, Span, check_dimension, check_parameter};
use crate::Error;
use symplectic_core::{Quantity, Separable, System, Vector};

/// The kick of the mollified impulse method (García-Archilla, Sanz-Serna & Skeel, *SIAM J. Sci. Comput.* 20, 930, 1998; Hairer, Lubich &
/// Wanner, *Geometric numerical integration*, XIII.1). It replaces the slow potential `U(q)` by `U(Aq)`; `Aq` is the mean position over a
/// time τ of the fast motion that starts at rest from q.
///
/// ```text
/// p ← p + h Aᵀ force(t, Aq)        A = 1/τ ∫_0^τ ∂q(s)/∂q(0) ds
/// ```
///
/// $$ p \leftarrow p + h A^T f(t, Aq) \qquad A = \frac{1}{\tau} \int_0^\tau \frac{\partial q(s)}{\partial q(0)}\, ds $$
///
/// The fast motion is [`Linear`]. For oscillators with the frequencies Ω, `A = sin(τΩ)/(τΩ)`. It removes from the force the components in
/// resonance with the fast motion. Take τ equal to the step size h of the run: A vanishes at `hω = π, 2π, …` (`LongAverage` of the paper).
/// With `τ = h/2` it vanishes at `hω = 2π, 4π, …` (`ShortAverage`). `τ = 0` gives the impulse method, whose energy grows at the resonances.
///
/// The kick is the exact flow of the potential `U(Aq)`. So a splitting with it is symplectic, and symmetric if the method is. With `τ ∝ h`,
/// Störmer–Verlet with the exact fast flow has order 2. Splittings of higher order have order 2 as well, because `U(Aq) − U(q) = O(τ²)`. A
/// is computed once, for the given τ; changing the step size does not change it.
///
/// The fast motion must be linear: otherwise A would depend on q, and the kick would need the derivative of the mean.
///
/// ```
/// symplectic::tableau! { Verlet { base: velocity-verlet } }
/// use symplectic::flow::{FlowSteps, Linear, MollifiedKick, Splitting};
/// use symplectic::nalgebra::{DMatrix, Vector1};
/// use symplectic::{State, acceleration};
///
/// # fn main() -> Result<(), symplectic::flow::Error> {
/// // H = p²/2 + 50² q²/2 + q⁴/4 with a step of half a fast period.
/// let h = std::f64::consts::PI / 50.0;
/// let fast = Linear::oscillators(&[1.0], &DMatrix::from_element(1, 1, 2500.0))?;
/// let soft = acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0].powi(3));
/// let kick = MollifiedKick::new(soft, &fast, h)?;
/// let start = State::from_arrays(0.0, [0.01], [0.3]);
/// let mut run = FlowSteps::run(Splitting::new(Verlet, fast, kick), start, h)?;
/// let state = run.take_steps(10_000)?;
/// let energy = state.p[0].powi(2) / 2.0 + 1250.0 * state.q[0].powi(2);
/// assert!((energy - 0.17).abs() < 1e-6);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct MollifiedKick<S, V> {
    system: S,
    dimension: usize,
    /// A, row by row.
    mean: Vec<f64>,
    /// The mean positions, and the force there.
    work_vectors: (Option<V>, Option<V>),
}

impl<V: Vector<Scalar = f64>, S: System<V, Class = Separable>> MollifiedKick<S, V> {
    /// The kick by the force of this system at the mean positions of the fast motion over the time τ = `duration`.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] if the duration is negative or not finite, or so long that the fast motion overflows or loses all but three
    /// digits.
    pub fn new(system: S, fast: &Linear, duration: f64) -> Result<Self, Error> {
        let what = "duration of the mean";
        check_parameter(what, 0, duration, true)?;
        let mean = fast.mean_positions(duration);
        Ok(Self {
            system,
            dimension: fast.dimension(),
            mean: mean.map_err(|_| Error::FlowParameter {
                what,
                index: 0,
                value: duration,
                range: "so short that the fast motion is finite, and known to three digits",
            })?,
            work_vectors: (None, None),
        })
    }
}

impl<V: Vector<Scalar = f64>, S: System<V, Class = Separable>> Flow<V> for MollifiedKick<S, V> {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        let n = self.dimension;
        check_dimension(n, q)?;
        if n == 0 {
            return Ok(());
        }
        let place = work_vector(&mut self.work_vectors.0, q, p)?;
        let force = work_vector(&mut self.work_vectors.1, q, p)?;
        let rows = || self.mean.chunks_exact(n);
        for (place, row) in place.as_mut_slice().iter_mut().zip(rows()) {
            *place = row.iter().zip(q.as_slice()).map(|(a, q)| a * q).sum();
        }
        self.system.force(span.middle(), place, p, force);
        // `Aᵀ force` replaces the mean positions.
        place.as_mut_slice().fill(0.0);
        for (row, force) in rows().zip(force.as_slice()) {
            for (sum, a) in place.as_mut_slice().iter_mut().zip(row) {
                *sum += a * force;
            }
        }
        add(Quantity::Force, span.size, place, p)
    }
}
