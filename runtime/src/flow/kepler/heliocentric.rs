//! Democratic heliocentric coordinates.

use alloc::vec;
use alloc::vec::Vec;

use super::drift::KeplerDrift;
use super::gravity::Bodies;
use super::jacobi::add;
use crate::error::Error;
use crate::flow::{Flow, FlowError, Span, check_dimension};
use crate::number::Vector;
use crate::state::State;

/// Bodies under their gravity in democratic heliocentric coordinates: positions relative to the star, momenta relative to the centre of mass.
///
/// ```text
/// Q_0 = centre of mass      Q_i = q_i − q_0      P_0 = Σ p_j      P_i = p_i − (m_i/M) P_0
/// A = |P_0|²/(2M) + Σ_i |P_i|²/(2m_i) − G m_0 m_i/|Q_i|
/// B = |Σ_i P_i|²/(2m_0) − Σ_{1≤i<j} G m_i m_j/|Q_i − Q_j|
/// ```
///
/// (Duncan, Levison & Lee, *Astron. J.* 116, 1998.) No order of the bodies is distinguished, so orbits may cross. The two terms of `B`, the
/// jump of the star and a kick, do not commute: [`kick`](Self::kick) is their palindrome, with the error O(ε³h²).
#[derive(Clone, Debug)]
pub struct Heliocentric {
    bodies: Bodies,
}

impl Heliocentric {
    /// Bodies with these masses, the first one that of the star, and the constant of gravity `G`.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] where a mass or `G` is not finite and positive, or there is no body.
    pub fn new(gravity: f64, masses: &[f64]) -> Result<Self, Error> {
        Ok(Self {
            bodies: Bodies::new(gravity, masses)?,
        })
    }

    /// The state in heliocentric coordinates of one in inertial coordinates.
    ///
    /// # Errors
    ///
    /// [`Error::Dimension`] where the state does not have three components for each body.
    #[allow(clippy::wrong_self_convention)]
    pub fn from_inertial<V: Vector<Scalar = f64>>(
        &self,
        state: &State<V>,
    ) -> Result<State<V>, Error> {
        let mut state = self.bodies.copy(state)?;
        let (q, p) = (state.q.as_mut_slice(), state.p.as_mut_slice());
        let (masses, total) = (&self.bodies.masses, self.bodies.total());
        for axis in 0..3 {
            let star = q[axis];
            let (mut moment, mut momentum) = (masses[0] * star, p[axis]);
            for i in 1..masses.len() {
                moment += masses[i] * q[3 * i + axis];
                momentum += p[3 * i + axis];
                q[3 * i + axis] -= star;
            }
            for i in 1..masses.len() {
                p[3 * i + axis] -= masses[i] / total * momentum;
            }
            (q[axis], p[axis]) = (moment / total, momentum);
        }
        Ok(state)
    }

    /// The state in inertial coordinates of one in heliocentric coordinates.
    ///
    /// # Errors
    ///
    /// [`Error::Dimension`] where the state does not have three components for each body.
    pub fn to_inertial<V: Vector<Scalar = f64>>(
        &self,
        state: &State<V>,
    ) -> Result<State<V>, Error> {
        let mut state = self.bodies.copy(state)?;
        let (q, p) = (state.q.as_mut_slice(), state.p.as_mut_slice());
        let (masses, total) = (&self.bodies.masses, self.bodies.total());
        for axis in 0..3 {
            let momentum = p[axis];
            let planets = 1..masses.len();
            let moment: f64 = planets.clone().map(|i| masses[i] * q[3 * i + axis]).sum();
            let others: f64 = planets.clone().map(|i| p[3 * i + axis]).sum();
            let star = q[axis] - moment / total;
            for i in planets {
                q[3 * i + axis] += star;
                p[3 * i + axis] += masses[i] / total * momentum;
            }
            (q[axis], p[axis]) = (star, masses[0] / total * momentum - others);
        }
        Ok(state)
    }

    /// The flow of `A`: the first part of a splitting.
    pub fn drift(&self) -> KeplerDrift {
        let Bodies {
            gravity, masses, ..
        } = &self.bodies;
        let mus = vec![gravity * masses[0]; masses.len() - 1];
        KeplerDrift::of_checked(self.bodies.total(), masses[1..].into(), mus)
    }

    /// A step for `B`, half a jump, a kick and half a jump: the second part.
    pub fn kick(&self) -> HeliocentricKick {
        HeliocentricKick {
            bodies: self.bodies.clone(),
            positions: vec![0.0; 3 * self.bodies.masses.len()],
            forces: vec![0.0; 3 * self.bodies.masses.len()],
        }
    }
}

/// The jump of the star and the gravity between planets in [`Heliocentric`] coordinates: a step of order 2.
///
/// # Errors
///
/// [`FlowError::Collision`] for planets in one place, [`FlowError::NonFinite`] for other forces that are not finite, [`FlowError::Dimension`].
#[derive(Clone, Debug)]
pub struct HeliocentricKick {
    bodies: Bodies,
    positions: Vec<f64>,
    forces: Vec<f64>,
}

impl HeliocentricKick {
    /// Moves all planets by `size Σ P_i/m_0`.
    fn jump(&mut self, size: f64, p: &[f64]) {
        for axis in 0..3 {
            let total: f64 = p.iter().skip(3 + axis).step_by(3).sum();
            let shift = size * total / self.bodies.masses[0];
            for q in self.positions.iter_mut().skip(3 + axis).step_by(3) {
                *q += shift;
            }
        }
    }
}

impl<V: Vector<Scalar = f64>> Flow<V> for HeliocentricKick {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        check_dimension(self.positions.len(), q)?;
        check_dimension(self.positions.len(), p)?;
        let (q, p, half) = (q.as_mut_slice(), p.as_mut_slice(), span.size / 2.0);
        self.positions.copy_from_slice(q);
        self.jump(half, p);
        self.forces.fill(0.0);
        self.bodies.forces(1, &self.positions, &mut self.forces)?;
        add(span.size, &self.forces, p)?;
        self.jump(half, p);
        q.copy_from_slice(&self.positions);
        Ok(())
    }
}
