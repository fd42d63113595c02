//! The step of an integrator as a map of states: whether it is symplectic, and equivariant under a symmetry.

use super::{Run, Stepper};
use crate::number::{Scalar, Vector};
use crate::state::State;

/// A state of an integrator as a point `(q, p)` of a cotangent bundle, with the form `ω = dq∧dp`.
pub trait PhasePoint {
    /// The vectors q and p.
    type Vector: Vector;

    /// The time and the point `(q, p)`. Coordinates of a larger space are allowed, such as those of `T*R⁹` for a rotation. Then `p·dq` must
    /// be the canonical form of the smaller space.
    fn canonical(&self) -> State<Self::Vector>;
}

impl<V: Vector> PhasePoint for State<V> {
    type Vector = V;

    fn canonical(&self) -> Self {
        self.clone()
    }
}

/// The next step of an integrator as a map of states, and checks of this map for tests. The integrator itself takes no step. For a stepper
/// with its [own](crate::stepper::Own) pace it is the first step of a new run from each state.
///
/// With constraints it is a map of the constrained phase space: all states must satisfy them, see `constraints::consistent`.
///
/// ```
/// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
/// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
/// symplectic::hamiltonian! { Damped q: [a], p: [pa]; H = pa^2/2 - cos(a) force: { a = -pa } }
/// use symplectic::stepper::StepMap;
/// use symplectic::{Error, Integrator, State};
///
/// # fn main() -> Result<(), Error> {
/// let near = |a: f64, b: f64| State::from_arrays(0.0, [0.4 + a], [0.9 + b]);
/// let run = Integrator::new(Gauss2, Pendulum, near(0.0, 0.0), 0.25)?;
/// assert!(run.symplecticity_defect(near)? < 1e-11);
/// let run = Integrator::new(Gauss2, Damped, near(0.0, 0.0), 0.25)?;
/// assert!(run.symplecticity_defect(near)? > 0.1);
/// # Ok(())
/// # }
/// ```
pub trait StepMap {
    /// The state of the integrator.
    type State: PhasePoint;

    /// The error of a step.
    type Error;

    /// The present state.
    fn present(&self) -> &Self::State;

    /// The state one step after `state`, the first of a new run from there.
    ///
    /// # Errors
    ///
    /// Those of a new integrator at `state`, and of its step.
    fn step_from(&self, state: Self::State) -> Result<Self::State, Self::Error>;

    /// How much the step changes `ω = dq∧dp` on two directions, relative to the size of its terms: zero up to about 10⁻¹¹ for a symplectic
    /// step.
    ///
    /// `family(a, b)` are states near the present one, which is `family(0, 0)`. The directions are its derivatives with respect to a and b,
    /// computed as differences of order 4 from values up to 1/500. A family that varies little over this range gives the best accuracy.
    ///
    /// # Errors
    ///
    /// Those of [`step_from`](Self::step_from), from a state of the family.
    fn symplecticity_defect(
        &self,
        mut family: impl FnMut(f64, f64) -> Self::State,
    ) -> Result<f64, Self::Error> {
        let prototype = self.present().canonical();
        let vectors = || (prototype.q.zeros_like(), prototype.q.zeros_like());
        // The directions before and after the step, each a change of q and one of p.
        let [mut before, mut after] = [0, 1].map(|_| [vectors(), vectors()]);
        for (direction, (before, after)) in before.iter_mut().zip(&mut after).enumerate() {
            for (place, weight) in [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)] {
                let by = place * STEP;
                let state = match direction {
                    0 => family(by, 0.0),
                    _ => family(0.0, by),
                };
                let weight = weight / (12.0 * STEP);
                add(before, weight, &state.canonical());
                add(after, weight, &self.step_from(state)?.canonical());
            }
        }
        let ((before, size), (after, new_size)) = (form(&before), form(&after));
        Ok((after - before).magnitude() / size.max(new_size))
    }

    /// The distance between the step from `act(state)` and `act` of the step, relative to the largest component (Marsden & West, 2001,
    /// §1.3.3). It is zero up to rounding if the step commutes with the symmetry `act`. The methods of this crate are equivariant under
    /// linear symmetries of the system.
    ///
    /// # Errors
    ///
    /// Those of [`step_from`](Self::step_from).
    ///
    /// ```
    /// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
    /// symplectic::hamiltonian! { Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q| }
    /// # use symplectic::stepper::StepMap;
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
    fn equivariance_defect(
        &self,
        mut act: impl FnMut(&Self::State) -> Self::State,
    ) -> Result<f64, Self::Error>
    where
        Self::State: Clone,
    {
        let expected = act(&self.step_from(self.present().clone())?).canonical();
        let found = self.step_from(act(self.present()))?.canonical();
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

/// Spacing of the states of a family.
const STEP: f64 = 1e-3;

/// `direction += weight · state`
fn add<V: Vector>((q, p): &mut (V, V), weight: f64, state: &State<V>) {
    let weight = V::Scalar::from_f64(weight);
    for (sum, part) in [(q, &state.q), (p, &state.p)] {
        let pairs = sum.as_mut_slice().iter_mut().zip(part.as_slice());
        pairs.for_each(|(sum, &part)| *sum += weight * part);
    }
}

/// dq∧dp of two directions, and the sum of the magnitudes of its terms.
fn form<V: Vector>([(q, p), (other_q, other_p)]: &[(V, V); 2]) -> (V::Scalar, f64) {
    let (mut sum, mut size) = (V::Scalar::from_f64(0.0), 0.0);
    let pairs = q.as_slice().iter().zip(other_p.as_slice());
    let others = other_q.as_slice().iter().zip(p.as_slice());
    for ((&q, &other_p), (&other_q, &p)) in pairs.zip(others) {
        sum += q * other_p - other_q * p;
        size += (q * other_p).magnitude() + (other_q * p).magnitude();
    }
    (sum, size)
}

impl<S: Stepper<State: PhasePoint> + Clone> StepMap for Run<S> {
    type State = S::State;
    type Error = S::Error;

    fn present(&self) -> &S::State {
        self.state()
    }

    fn step_from(&self, state: S::State) -> Result<S::State, S::Error> {
        let mut run = self.clone();
        run.set_state(state)?;
        run.step()?;
        Ok(run.into_state())
    }
}
