//! Gravity between bodies.

use alloc::vec::Vec;

use crate::error::Error;
use crate::flow::{FlowError, check_parameter};
use crate::number::{F64x4, Lanes, Scalar, Vector};
use crate::state::State;

/// Masses, the first of which is the star's, and the constant of gravity.
#[derive(Clone, Debug)]
pub(super) struct Bodies {
    pub(super) gravity: f64,
    pub(super) masses: Vec<f64>,
    /// `M_i`, the mass of the bodies up to each one.
    pub(super) sums: Vec<f64>,
    /// `m_i/M_i` and `M_{i−1}/M_i`.
    pub(super) shares: Vec<[f64; 2]>,
}

impl Bodies {
    pub(super) fn new(gravity: f64, masses: &[f64]) -> Result<Self, Error> {
        check_parameter("constant of gravity", 0, gravity, false)?;
        for (index, &mass) in masses.iter().enumerate() {
            check_parameter("mass", index, mass, false)?;
        }
        if masses.is_empty() {
            return Err(Error::FlowParameter {
                what: "count of bodies",
                index: 0,
                value: 0.0,
                range: "1 or more",
            });
        }
        let sums = masses.iter().scan(0.0, |sum, mass| {
            *sum += mass;
            Some(*sum)
        });
        let sums: Vec<f64> = sums.collect();
        let shares = masses
            .iter()
            .zip(&sums)
            .enumerate()
            .map(|(i, (mass, sum))| {
                let before = if i == 0 { 0.0 } else { sums[i - 1] };
                [mass / sum, before / sum]
            });
        Ok(Self {
            gravity,
            shares: shares.collect(),
            sums,
            masses: masses.into(),
        })
    }

    /// The mass of all bodies.
    pub(super) fn total(&self) -> f64 {
        self.sums.last().copied().unwrap_or_default()
    }

    /// A copy of a state of these bodies, to be transformed.
    pub(super) fn copy<V: Vector<Scalar = f64>>(
        &self,
        state: &State<V>,
    ) -> Result<State<V>, Error> {
        let (position, momentum) = (state.q.dimension(), state.p.dimension());
        if position == 3 * self.masses.len() && momentum == position {
            Ok(state.clone())
        } else {
            Err(Error::Dimension { position, momentum })
        }
    }

    /// Adds the forces of gravity between the bodies from `first` on, without that between the bodies 0 and 1.
    pub(super) fn forces(
        &self,
        first: usize,
        q: &[f64],
        forces: &mut [f64],
    ) -> Result<(), FlowError> {
        let (q, _) = q.as_chunks::<3>();
        let (forces, _) = forces.as_chunks_mut::<3>();
        for (i, (&[x, y, z], &mass)) in q.iter().zip(&self.masses).enumerate().skip(first) {
            let from = (i + 1).max(2);
            let mut own = [0.0; 3];
            // Roots and quotients of four pairs at once.
            for first in (from..q.len()).step_by(4) {
                let others = q[first..].iter().zip(&self.masses[first..]);
                let mut apart = [[0.0; 4]; 3];
                let mut weights = [0.0; 4];
                let mut squares = [1.0; 4];
                for (k, (place, other)) in others.take(4).enumerate() {
                    let [dx, dy, dz] = [place[0] - x, place[1] - y, place[2] - z];
                    (apart[0][k], apart[1][k], apart[2][k]) = (dx, dy, dz);
                    squares[k] = dx * dx + dy * dy + dz * dz;
                    weights[k] = other * mass;
                }
                if let Some(k) = squares.iter().position(|&square| square == 0.0) {
                    return Err(FlowError::Collision {
                        first: i,
                        second: first + k,
                    });
                }
                let squares = F64x4::from_array(squares);
                let strength = F64x4::from_f64(self.gravity) * F64x4::from_array(weights);
                let pulls = (strength / (squares * squares.sqrt())).to_array();
                for (k, (force, pull)) in forces[first..].iter_mut().zip(pulls).enumerate() {
                    for axis in 0..3 {
                        let pull = pull * apart[axis][k];
                        own[axis] += pull;
                        force[axis] -= pull;
                    }
                }
            }
            for (force, own) in forces[i].iter_mut().zip(own) {
                *force += own;
            }
        }
        Ok(())
    }
}
