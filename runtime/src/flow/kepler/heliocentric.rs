//! Democratic heliocentric coordinates.

use super::attraction::Attraction;
use super::bodies::Bodies;
use super::drift::KeplerDrift;
use crate::error::Error;
use crate::flow::{Flow, FlowError, Span};
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
/// (Duncan, Levison & Lee, *Astron. J.* 116, 1998.) No order of the bodies is distinguished, so orbits may cross. The two terms of `B` commute: the
/// jump of the star moves all planets by the same vector, and a kick leaves `Σ P_i`. So the flow of `B` is exact too.
#[derive(Clone, Debug)]
pub struct Heliocentric {
    bodies: Bodies,
    /// Whether every planet makes a pair with the star.
    pairs: bool,
}

impl Heliocentric {
    /// Bodies with these masses, the first one that of the star, and the constant of gravity `G`.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] where a mass or `G` is not finite and positive, or there is no body.
    pub fn new(gravity: f64, masses: &[f64]) -> Result<Self, Error> {
        let bodies = Bodies::new(gravity, masses)?;
        let pairs = false;
        Ok(Self { bodies, pairs })
    }

    /// The same coordinates, with another splitting: each planet and the star are a pair that is solved exactly (WHDS, Hernandez & Dehnen,
    /// *MNRAS* 468, 2017).
    ///
    /// ```text
    /// A = |P_0|²/(2M) + Σ_i |P_i|²/(2μ_i) − G m_0 m_i/|Q_i|      μ_i = m_0 m_i/(m_0 + m_i)
    /// B = Σ_{i<j} P_i·P_j/m_0 − Σ_{1≤i<j} G m_i m_j/|Q_i − Q_j|
    /// ```
    ///
    /// With two bodies `B = 0`. The two terms of `B` do not commute, and are taken by a palindrome: the error has `O(ε³h²)` in addition.
    ///
    /// # Errors
    ///
    /// As for [`new`](Self::new).
    pub fn of_pairs(gravity: f64, masses: &[f64]) -> Result<Self, Error> {
        let bodies = Bodies::new(gravity, masses)?;
        let pairs = true;
        Ok(Self { bodies, pairs })
    }

    /// The state in heliocentric coordinates of one in inertial coordinates.
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
    /// [`Error::FlowParameter`] where the state does not have three components for each body.
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

    /// The flow of `B`, or of [pairs](Self::of_pairs) a step of order 2: the second part.
    pub fn kick(&self) -> HeliocentricKick {
        HeliocentricKick {
            attraction: Attraction::new(self.bodies.clone()),
            pairs: self.pairs,
        }
    }
}

/// The flow of the jump of the star and of the gravity between planets in [`Heliocentric`] coordinates.
///
/// # Errors
///
/// [`FlowError::Collision`] for planets in one place, [`FlowError::NonFinite`] for other forces that are not finite, [`FlowError::Dimension`].
#[derive(Clone, Debug)]
pub struct HeliocentricKick {
    attraction: Attraction,
    pairs: bool,
}

impl HeliocentricKick {
    /// Moves each planet by the velocity that the star has from all planets, or from the others.
    fn jump(&mut self, size: f64, p: &[f64]) {
        let positions = &mut self.attraction.positions;
        let factor = size / self.attraction.bodies.masses[0];
        for axis in 3..6 {
            let total: f64 = p.iter().skip(axis).step_by(3).sum();
            let planets = positions.iter_mut().zip(p).skip(axis).step_by(3);
            for (q, own) in planets {
                *q += factor * if self.pairs { total - own } else { total };
            }
        }
    }
}

impl<V: Vector<Scalar = f64>> Flow<V> for HeliocentricKick {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        self.attraction.check(q, p)?;
        let (q, p) = (q.as_mut_slice(), p.as_mut_slice());
        self.attraction.positions.copy_from_slice(q);
        // The jump of all planets by one vector commutes with the kick.
        let before = if self.pairs { span.size / 2.0 } else { 0.0 };
        if self.pairs {
            self.jump(before, p);
        }
        self.attraction.attract(1)?;
        self.attraction.kick(span.size, p)?;
        self.jump(span.size - before, p);
        q.copy_from_slice(&self.attraction.positions);
        Ok(())
    }
}
