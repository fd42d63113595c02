//! Democratic heliocentric coordinates.

use super::attraction::Attraction;
use super::bodies::Bodies;
use super::drift::KeplerDrift;
use crate::{Error, Flow, FlowError, Span};
use symplectic_core::inside::array;
use symplectic_core::{State, Vector};

/// Bodies under their gravity in democratic heliocentric coordinates: positions relative to the star, momenta relative to the centre of mass.
///
/// ```text
/// Q_0 = centre of mass      Q_i = q_i − q_0      P_0 = Σ p_j      P_i = p_i − (m_i/M) P_0
/// A = |P_0|²/(2M) + Σ_i |P_i|²/(2m_i) − G m_0 m_i/|Q_i|
/// B = |Σ_i P_i|²/(2m_0) − Σ_{1≤i<j} G m_i m_j/|Q_i − Q_j|
/// ```
///
/// (Duncan, Levison & Lee, *Astron. J.* 116, 1998.) No order of the bodies is assumed, so orbits may cross. The two terms of `B` commute:
/// the jump of the star moves all planets by the same vector, and a kick leaves `Σ P_i`. So the flow of `B` is exact too.
#[derive(Clone, Debug)]
pub struct Heliocentric {
    bodies: Bodies,
    /// Whether every planet forms a pair with the star.
    pairs: bool,
}

impl Heliocentric {
    /// Bodies with these masses, the star first, and the constant of gravity `G`.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] if a mass or `G` is not finite and positive, or there is no body.
    pub fn new(gravity: f64, masses: &[f64]) -> Result<Self, Error> {
        let bodies = Bodies::new(gravity, masses)?;
        let pairs = false;
        Ok(Self { bodies, pairs })
    }

    /// The same coordinates with another splitting: each planet and the star form a pair that is solved exactly (WHDS, Hernandez & Dehnen,
    /// *MNRAS* 468, 2017).
    ///
    /// ```text
    /// A = |P_0|²/(2M) + Σ_i |P_i|²/(2μ_i) − G m_0 m_i/|Q_i|      μ_i = m_0 m_i/(m_0 + m_i)
    /// B = Σ_{i<j} P_i·P_j/m_0 − Σ_{1≤i<j} G m_i m_j/|Q_i − Q_j|
    /// ```
    ///
    /// With two bodies `B = 0`. The two terms of `B` do not commute, and are composed in a palindrome: this adds an error `O(ε³h²)`.
    ///
    /// # Errors
    ///
    /// As for [`new`](Self::new).
    pub fn of_pairs(gravity: f64, masses: &[f64]) -> Result<Self, Error> {
        let bodies = Bodies::new(gravity, masses)?;
        let pairs = true;
        Ok(Self { bodies, pairs })
    }

    /// Transforms a state from inertial to heliocentric coordinates.
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

    /// Transforms a state from heliocentric to inertial coordinates.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] if the state does not have three components for each body.
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
        let (star, planets) = (masses[0], &masses[1..]);
        let orbits = planets.iter().map(|mass| match self.pairs {
            true => (star * mass / (star + mass), gravity * (star + mass)),
            false => (*mass, gravity * star),
        });
        let (masses, mus) = orbits.unzip();
        KeplerDrift::of_checked(self.bodies.total(), masses, mus)
    }

    /// The second part: the flow of `B`, or for [pairs](Self::of_pairs) a step of order 2.
    pub fn kick(&self) -> HeliocentricKick {
        HeliocentricKick {
            star: self.bodies.masses[0],
            attraction: Attraction::new(&self.bodies),
            pairs: self.pairs,
        }
    }
}

/// The flow of the jump of the star and the gravity between planets, in [`Heliocentric`] coordinates.
///
/// # Errors
///
/// [`FlowError::Collision`] for planets at the same position, [`FlowError::NonFinite`] for other forces that are not finite, [`FlowError::Dimension`].
#[derive(Clone, Debug)]
pub struct HeliocentricKick {
    /// The mass of the star.
    star: f64,
    attraction: Attraction,
    pairs: bool,
}

impl HeliocentricKick {
    /// Moves each planet by the velocity of the star that is due to all planets, or for pairs to the others.
    fn jump(&mut self, size: f64, p: &[[f64; 3]]) {
        let factor = size / self.star;
        let mut total = [0.0; 3];
        for p in p {
            total = array(0.0, |axis| total[axis] + p[axis]);
        }
        for (i, own) in p.iter().enumerate() {
            let place = self.attraction.place(i);
            let other = |axis: usize| {
                if self.pairs {
                    total[axis] - own[axis]
                } else {
                    total[axis]
                }
            };
            self.attraction
                .put(i, array(0.0, |axis| place[axis] + factor * other(axis)));
        }
    }
}

impl<V: Vector<Scalar = f64>> Flow<V> for HeliocentricKick {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        self.attraction.check(q, p)?;
        let q = q.as_mut_slice()[3..].as_chunks_mut::<3>().0;
        let p = p.as_mut_slice()[3..].as_chunks_mut::<3>().0;
        for (i, place) in q.iter().enumerate() {
            self.attraction.put(i, *place);
        }
        // If all planets jump by the same vector, the jump commutes with the kick.
        let before = if self.pairs { span.size / 2.0 } else { 0.0 };
        if self.pairs {
            self.jump(before, p);
        }
        self.attraction
            .forces
            .iter_mut()
            .for_each(|list| list.fill(0.0));
        self.attraction.attract();
        let mut finite = true;
        let forces = &self.attraction.forces;
        let force = |i: usize| -> [f64; 3] { array(0.0, |axis| forces[axis][i]) };
        for i in 0..p.len() {
            finite &= force(i).iter().fold(true, |all, x| all & x.is_finite());
        }
        if !finite {
            return Err(self.attraction.failure(None));
        }
        for (i, p) in p.iter_mut().enumerate() {
            *p = array(0.0, |axis| p[axis] + span.size * force(i)[axis]);
        }
        self.jump(span.size - before, p);
        for (i, q) in q.iter_mut().enumerate() {
            *q = self.attraction.place(i);
        }
        Ok(())
    }
}
