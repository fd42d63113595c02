//! Jacobi coordinates.

use alloc::vec::Vec;

use num_traits::Zero;

use super::attraction::{Attraction, Group, pull};
use super::bodies::Bodies;
use super::drift::KeplerDrift;
use super::groups::{Axes, gather, load_one, store};
use crate::{Error, Flow, FlowError, Span};
use symplectic_core::inside::array;
use symplectic_core::simd::Lanes;
use symplectic_core::{Scalar, State, Vector};

/// Bodies under their gravity, `H = Σ |p|²/(2m) − Σ G m_i m_j/|q_i − q_j|`, in Jacobi coordinates: the position of each body is relative to
/// the centre of mass of the bodies before it.
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
    /// Bodies with these masses, the star first, and the constant of gravity `G`.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] if a mass or `G` is not finite and positive, or there is no body.
    pub fn new(gravity: f64, masses: &[f64]) -> Result<Self, Error> {
        Ok(Self {
            bodies: Bodies::new(gravity, masses)?,
        })
    }

    /// Transforms a state from inertial to Jacobi coordinates.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] if the state does not have three components for each body.
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

    /// Transforms a state from Jacobi to inertial coordinates.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] if the state does not have three components for each body.
    pub fn to_inertial<V: Vector<Scalar = f64>>(
        &self,
        state: &State<V>,
    ) -> Result<State<V>, Error> {
        let before = state;
        let mut state = self.bodies.copy(before)?;
        let places = state.q.as_mut_slice().as_chunks_mut::<3>().0;
        let put = |planet: usize, place| places[planet + 1] = place;
        if let [centre, planets @ ..] = before.q.as_slice().as_chunks().0 {
            places[0] = to_positions(&self.bodies, *centre, planets, put);
        }
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
        JacobiKick::new(&self.bodies)
    }
}

/// Transforms momenta or forces from inertial to Jacobi coordinates.
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

/// Passes the inertial positions of the planets to `put`, the last first, and returns the position of the star; `centre` is that of the
/// centre of mass.
#[cfg_attr(not(debug_assertions), inline(always))]
fn to_positions(
    bodies: &Bodies,
    mut centre: [f64; 3],
    planets: &[[f64; 3]],
    mut put: impl FnMut(usize, [f64; 3]),
) -> [f64; 3] {
    for (i, (planet, [own, _])) in planets.iter().zip(&bodies.shares[1..]).enumerate().rev() {
        centre = array(0.0, |axis| centre[axis] - own * planet[axis]);
        put(i, array(0.0, |axis| centre[axis] + planet[axis]));
    }
    centre
}

/// The flow of the gravity between planets in [`Jacobi`] coordinates: a kick.
///
/// # Errors
///
/// [`FlowError::Collision`] for bodies at the same position, [`FlowError::NonFinite`] for other forces that are not finite, [`FlowError::Dimension`].
#[derive(Clone, Debug)]
pub struct JacobiKick {
    bodies: Bodies,
    attraction: Attraction,
    /// `G m_i m_0` and `G m_i M_{i−1}`; 0 for the first planet and after the last.
    strengths: [Vec<f64>; 2],
    /// 1 where the strengths are 0.
    more: Vec<f64>,
    /// The forces with these strengths, in Jacobi coordinates.
    falls: Axes,
}

impl JacobiKick {
    fn new(bodies: &Bodies) -> Self {
        let Bodies {
            gravity,
            masses,
            sums,
            ..
        } = bodies;
        let attraction = Attraction::new(bodies);
        let length = attraction.forces[0].len();
        let list = |of: &dyn Fn(usize) -> f64, rest: f64| {
            let all = (1..=length).map(|i| {
                let counts = i > 1 && i < masses.len();
                if counts { of(i) } else { rest }
            });
            all.collect()
        };
        Self {
            bodies: bodies.clone(),
            strengths: [
                list(&|i| gravity * masses[i] * masses[0], 0.0),
                list(&|i| gravity * masses[i] * sums[i - 1], 0.0),
            ],
            more: list(&|_| 0.0, 1.0),
            falls: attraction.forces.clone(),
            attraction,
        }
    }
}

impl<V: Vector<Scalar = f64>> Flow<V> for JacobiKick {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        let Self {
            bodies,
            attraction,
            strengths: [by_star, by_centre],
            more,
            falls,
        } = self;
        attraction.check(q, p)?;
        let count = attraction.count();
        let planets = &q.as_slice().as_chunks().0[1..];
        // Relative to the centre of mass, which may be far away.
        let star = to_positions(bodies, [0.0; 3], planets, |planet, place| {
            attraction.put(planet, place);
        });
        let zero = Group::zero();
        let at: [Group; 3] = array(zero, |axis| Group::from_f64(star[axis]));
        for first in (0..count).step_by(Group::WIDTH) {
            let places = attraction.places(first);
            let more = load_one(more, first);
            let way = array(zero, |axis| at[axis] - places[axis]);
            let to_star = pull(load_one(by_star, first), way, more);
            store(&mut attraction.forces, first, to_star);
            store(
                falls,
                first,
                pull(load_one(by_centre, first), gather(&planets[first..]), more),
            );
        }
        attraction.attract();
        // The force on the bodies before a planet is opposite to the force on the others.
        let (mut rest, mut finite) = ([0.0; 3], true);
        for i in (0..count).rev() {
            let [own, _] = bodies.shares[i + 1];
            for axis in 0..3 {
                let force = attraction.forces[axis][i];
                // The shares have the exact sum 1, as in the positions: a torque of their rounding errors would be the same in all steps.
                let relative = (force + own * rest[axis]) + falls[axis][i];
                rest[axis] += force;
                falls[axis][i] = relative;
                finite &= relative.is_finite();
            }
        }
        if !finite {
            return Err(attraction.failure(Some(star)));
        }
        let p = p.as_mut_slice()[3..].as_chunks_mut::<3>().0;
        for i in 0..count {
            p[i] = array(0.0, |axis| p[i][axis] + span.size * falls[axis][i]);
        }
        Ok(())
    }
}
