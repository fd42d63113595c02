//! Tests whether a step is symplectic, and equivariant under a symmetry.

use crate::error::Error;
use crate::integrator::Integrator;
use crate::method::{Method, Solver};
use crate::number::{Scalar, Summation, Vector};
use crate::state::State;
use crate::system::System;

/// The momentum map `J(q, p)·ξ = p·ξ_Q(q)` of a symmetry with the generator `ξ_Q`, which `generator(q, out)` writes into `out`
/// (Marsden & West, 2001, §1.3.3).
///
/// ```
/// use symplectic::State;
/// use symplectic::nalgebra::Vector2;
/// use symplectic::variational::momentum_map;
///
/// // Rotations of the plane: the angular momentum.
/// let state = State::new(0.0, Vector2::new(1.0, 2.0), Vector2::new(3.0, 5.0));
/// assert_eq!(momentum_map(&state, |q, out| *out = Vector2::new(-q[1], q[0])), -1.0);
/// ```
pub fn momentum_map<V: Vector>(state: &State<V>, generator: impl FnOnce(&V, &mut V)) -> V::Scalar {
    let mut direction = state.q.zeros_like();
    generator(&state.q, &mut direction);
    super::two_ends::dot(&state.p, &direction)
}

/// Spacing of the states of the family in [`Integrator::symplecticity_defect`].
const STEP: f64 = 1e-3;

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N>
where
    Self: Clone,
{
    /// How much the next step changes `ω = dq∧dp` on two directions, relative to the size of its terms: zero up to about 10⁻¹¹ for a
    /// symplectic step.
    ///
    /// `family(a, b)` are states near the present one, which is `family(0, 0)`. The directions are its derivatives with respect to a and b,
    /// computed as differences of order 4 from values up to 1/500. A family that varies little over this range gives the best accuracy.
    /// With constraints all of its states have to obey them: see [`consistent`](crate::consistent). The integrator itself takes no step.
    ///
    /// # Errors
    ///
    /// Those of [`set_state`](Self::set_state) and [`step`](Self::step), from a state of the family.
    ///
    /// ```
    /// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
    /// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
    /// symplectic::hamiltonian! { Damped q: [a], p: [pa]; H = pa^2/2 - cos(a) force: { a = -pa } }
    /// # use symplectic::{Error, Integrator, State};
    /// # fn main() -> Result<(), Error> {
    /// let near = |a: f64, b: f64| State::from_arrays(0.0, [0.4 + a], [0.9 + b]);
    /// let run = Integrator::new(Gauss2, Pendulum, near(0.0, 0.0), 0.25)?;
    /// assert!(run.symplecticity_defect(near)? < 1e-11);
    /// let run = Integrator::new(Gauss2, Damped, near(0.0, 0.0), 0.25)?;
    /// assert!(run.symplecticity_defect(near)? > 0.1);
    /// # Ok(())
    /// # }
    /// ```
    pub fn symplecticity_defect(
        &self,
        mut family: impl FnMut(f64, f64) -> State<V>,
    ) -> Result<f64, Error> {
        let zero = V::Scalar::from_f64(0.0);
        let vector = || (self.state().q.zeros_like(), self.state().q.zeros_like());
        // The directions before and after the step, each a change of q and one of p.
        let [mut before, mut after] = [0, 1].map(|_| [vector(), vector()]);
        for (direction, (before, after)) in before.iter_mut().zip(&mut after).enumerate() {
            for (place, weight) in [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)] {
                let by = place * STEP;
                let state = match direction {
                    0 => family(by, 0.0),
                    _ => family(0.0, by),
                };
                let weight = V::Scalar::from_f64(weight / (12.0 * STEP));
                add(before, weight, &state);
                let mut run = self.clone();
                run.set_state(state)?;
                add(after, weight, run.step()?);
            }
        }
        let form = |[(q, p), (other_q, other_p)]: &[(V, V); 2]| {
            let (mut sum, mut size) = (zero, 0.0);
            let pairs = q.as_slice().iter().zip(other_p.as_slice());
            let others = other_q.as_slice().iter().zip(p.as_slice());
            for ((&q, &other_p), (&other_q, &p)) in pairs.zip(others) {
                sum += q * other_p - other_q * p;
                size += (q * other_p).magnitude() + (other_q * p).magnitude();
            }
            (sum, size)
        };
        let ((before, size), (after, new_size)) = (form(&before), form(&after));
        Ok((after - before).magnitude() / size.max(new_size))
    }

    /// How far the next step is from commuting with a symmetry, relative to the largest component: the distance between the step from
    /// `act(state)` and `act` of the step (Marsden & West, 2001, §1.3.3). Zero up to rounding for an equivariant step; all these methods
    /// are equivariant under linear symmetries of the system. The integrator itself takes no step.
    ///
    /// # Errors
    ///
    /// Those of [`set_state`](Self::set_state) and [`step`](Self::step).
    ///
    /// ```
    /// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
    /// symplectic::hamiltonian! { Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q| }
    /// # use symplectic::{Error, Integrator, State};
    /// # use symplectic::nalgebra::{Rotation2, Vector2};
    /// # fn main() -> Result<(), Error> {
    /// let start = State::new(0.0, Vector2::new(0.4, 0.0), Vector2::new(0.0, 2.0));
    /// let run = Integrator::new(Gauss2, Kepler, start, 0.05)?;
    /// let turn = |state: &State<Vector2<f64>>| {
    ///     let turn = Rotation2::new(0.7);
    ///     State::new(state.time, turn * state.q, turn * state.p)
    /// };
    /// assert!(run.equivariance_defect(turn)? < 1e-14);
    /// # Ok(())
    /// # }
    /// ```
    pub fn equivariance_defect(
        &self,
        mut act: impl FnMut(&State<V>) -> State<V>,
    ) -> Result<f64, Error> {
        let mut run = self.clone();
        let expected = act(run.step()?);
        let mut moved = self.clone();
        moved.set_state(act(self.state()))?;
        let found = moved.step()?;
        let (mut distance, mut size) = (0.0_f64, f64::MIN_POSITIVE);
        for (found, expected) in [(&found.q, &expected.q), (&found.p, &expected.p)] {
            for (&found, &expected) in found.as_slice().iter().zip(expected.as_slice()) {
                distance = distance.max((found - expected).magnitude());
                size = size.max(expected.magnitude());
            }
        }
        Ok(distance / size)
    }
}

/// `direction += weight · state`
fn add<V: Vector>((q, p): &mut (V, V), weight: V::Scalar, state: &State<V>) {
    for (sum, part) in [(q, &state.q), (p, &state.p)] {
        let pairs = sum.as_mut_slice().iter_mut().zip(part.as_slice());
        pairs.for_each(|(sum, &part)| *sum += weight * part);
    }
}
