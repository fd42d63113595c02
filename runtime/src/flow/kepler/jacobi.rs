//! Jacobi coordinates.

use alloc::vec::Vec;

use super::attraction::Attraction;
use super::bodies::Bodies;
use super::drift::KeplerDrift;
use crate::error::Error;
use crate::flow::{Flow, FlowError, Span};
use crate::number::{Scalar, Vector};
use crate::state::State;

/// Bodies under their gravity, `H = Σ |p|²/(2m) − Σ G m_i m_j/|q_i − q_j|`, in Jacobi coordinates: the position of each body relative to the centre of
/// mass of those before it.
///
/// ```text
/// Q_0 = centre of mass      Q_i = q_i − (Σ_{j<i} m_j q_j)/M_{i−1}      M_i = Σ_{j≤i} m_j
/// P_0 = Σ p_j               P_i = (M_{i−1}/M_i) p_i − (m_i/M_i) Σ_{j<i} p_j
/// A = |P_0|²/(2M) + Σ_i |P_i|²/(2m_i') − G m_i M_{i−1}/|Q_i|      m_i' = m_i M_{i−1}/M_i
/// B = Σ_{i≥2} G m_i M_{i−1}/|Q_i| − Σ_{i<j, j≥2} G m_i m_j/|q_i − q_j|
/// ```
///
/// (Wisdom & Holman 1991; Rein & Tamayo 2015, §2.) `A` and `B` depend on positions and momenta such that both flows are exact. With two
/// bodies `B = 0`. Positions and momenta have three components for each body.
#[derive(Clone, Debug)]
pub struct Jacobi {
    bodies: Bodies,
}

impl Jacobi {
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

    /// The state in Jacobi coordinates of one in inertial coordinates.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] where the state does not have three components for each body.
    #[allow(clippy::wrong_self_convention)]
    pub fn from_inertial<V: Vector<Scalar = f64>>(
        &self,
        state: &State<V>,
    ) -> Result<State<V>, Error> {
        let mut state = self.bodies.copy(state)?;
        let Bodies { masses, sums, .. } = &self.bodies;
        let q = state.q.as_mut_slice();
        for axis in 0..3 {
            let mut moment = masses[0] * q[axis];
            for i in 1..masses.len() {
                let place = &mut q[3 * i + axis];
                let centre = moment / sums[i - 1];
                moment += masses[i] * *place;
                *place -= centre;
            }
            q[axis] = moment / self.bodies.total();
        }
        to_relative(&self.bodies, state.p.as_mut_slice());
        Ok(state)
    }

    /// The state in inertial coordinates of one in Jacobi coordinates.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] where the state does not have three components for each body.
    pub fn to_inertial<V: Vector<Scalar = f64>>(
        &self,
        state: &State<V>,
    ) -> Result<State<V>, Error> {
        let mut state = self.bodies.copy(state)?;
        to_positions(&self.bodies, state.q.as_mut_slice());
        let p = state.p.as_mut_slice();
        for axis in 0..3 {
            let mut total = p[axis];
            for (i, [own, _]) in self.bodies.shares.iter().enumerate().skip(1).rev() {
                let place = &mut p[3 * i + axis];
                *place += own * total;
                total -= *place;
            }
            p[axis] = total;
        }
        Ok(state)
    }

    /// The flow of `A`: the first part of a splitting.
    pub fn drift(&self) -> KeplerDrift {
        let Bodies {
            gravity,
            masses,
            sums,
            ..
        } = &self.bodies;
        let planets = 1..masses.len();
        let reduced: Vec<f64> = planets
            .clone()
            .map(|i| masses[i] * sums[i - 1] / sums[i])
            .collect();
        let mus: Vec<f64> = planets.map(|i| gravity * sums[i]).collect();
        KeplerDrift::of_checked(self.bodies.total(), reduced, mus)
    }

    /// The flow of `B`: the second part.
    pub fn kick(&self) -> JacobiKick {
        JacobiKick {
            attraction: Attraction::new(self.bodies.clone()),
        }
    }
}

/// Momenta, or forces, of Jacobi coordinates from those in space.
fn to_relative(bodies: &Bodies, p: &mut [f64]) {
    let (p, _) = p.as_chunks_mut::<3>();
    let Some((first, planets)) = p.split_first_mut() else {
        return;
    };
    for (planet, &[own, before]) in planets.iter_mut().zip(&bodies.shares[1..]) {
        for (total, p) in first.iter_mut().zip(planet) {
            let relative = before * *p - own * *total;
            *total += *p;
            *p = relative;
        }
    }
}

/// Positions in space from Jacobi coordinates.
fn to_positions(bodies: &Bodies, q: &mut [f64]) {
    let (q, _) = q.as_chunks_mut::<3>();
    let Some((first, planets)) = q.split_first_mut() else {
        return;
    };
    for (planet, [own, _]) in planets.iter_mut().zip(&bodies.shares[1..]).rev() {
        for (centre, q) in first.iter_mut().zip(planet) {
            *centre -= own * *q;
            *q += *centre;
        }
    }
}

/// The flow of the gravity between planets in [`Jacobi`] coordinates: a kick.
///
/// # Errors
///
/// [`FlowError::Collision`] for bodies in one place, [`FlowError::NonFinite`] for other forces that are not finite, [`FlowError::Dimension`].
#[derive(Clone, Debug)]
pub struct JacobiKick {
    attraction: Attraction,
}

impl<V: Vector<Scalar = f64>> Flow<V> for JacobiKick {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        let attraction = &mut self.attraction;
        attraction.check(q, p)?;
        let q = q.as_slice();
        attraction.positions.copy_from_slice(q);
        to_positions(&attraction.bodies, &mut attraction.positions);
        attraction.attract(0)?;
        let Attraction { bodies, forces, .. } = attraction;
        to_relative(bodies, forces);
        for i in 2..bodies.masses.len() {
            let planet = &q[3 * i..3 * i + 3];
            let square = planet.iter().map(|x| x * x).sum::<f64>();
            let pull = bodies.gravity * bodies.masses[i] * bodies.sums[i - 1]
                / (square * Scalar::sqrt(square));
            for (force, x) in forces[3 * i..].iter_mut().zip(planet) {
                *force += pull * x;
            }
        }
        self.attraction.kick(span.size, p.as_mut_slice())
    }
}
