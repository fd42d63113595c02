//! The gravity between bodies.

use alloc::vec;
use alloc::vec::Vec;

use super::bodies::Bodies;
use crate::error::Quantity;
use crate::flow::{FlowError, check_dimension};
use crate::number::{F64x4, Lanes, Scalar, Vector};

/// Bodies, their positions, the forces on them, and room for those of one body.
#[derive(Clone, Debug)]
pub(super) struct Attraction {
    pub(super) bodies: Bodies,
    pub(super) positions: Vec<f64>,
    pub(super) forces: Vec<f64>,
    /// From a body to each of the ones after it, and a group of lanes more.
    apart: Vec<[f64; 3]>,
    /// The squares of the distances, and then the pulls.
    pulls: Vec<f64>,
    /// The masses, and zeros.
    masses: Vec<f64>,
}

/// Pairs side by side.
const WIDTH: usize = F64x4::WIDTH;

impl Attraction {
    pub(super) fn new(bodies: Bodies) -> Self {
        let count = bodies.masses.len();
        let mut masses = bodies.masses.clone();
        masses.resize(count + WIDTH, 0.0);
        Self {
            positions: vec![0.0; 3 * count],
            forces: vec![0.0; 3 * count],
            apart: vec![[0.0; 3]; count],
            pulls: vec![1.0; count + WIDTH],
            masses,
            bodies,
        }
    }

    /// Checks that a state is one of these bodies.
    pub(super) fn check<V: Vector<Scalar = f64>>(&self, q: &V, p: &V) -> Result<(), FlowError> {
        check_dimension(self.positions.len(), q)?;
        check_dimension(self.positions.len(), p)
    }

    /// Computes the forces of gravity between the bodies from `first` on, without that between the bodies 0 and 1.
    pub(super) fn attract(&mut self, first: usize) -> Result<(), FlowError> {
        self.forces.fill(0.0);
        let (positions, _) = self.positions.as_chunks::<3>();
        let (forces, _) = self.forces.as_chunks_mut::<3>();
        for (i, &[x, y, z]) in positions.iter().enumerate().skip(first) {
            let from = (i + 1).max(2);
            let others = positions.get(from..).unwrap_or_default();
            let pairs = self.apart.iter_mut().zip(&mut self.pulls).zip(others);
            for ((apart, square), place) in pairs {
                let [dx, dy, dz] = [place[0] - x, place[1] - y, place[2] - z];
                *apart = [dx, dy, dz];
                *square = dx * dx + dy * dy + dz * dz;
            }
            let squares = &self.pulls[..others.len()];
            if let Some(k) = squares.iter().position(|&square| square == 0.0) {
                let (first, second) = (i, from + k);
                return Err(FlowError::Collision { first, second });
            }
            // Roots and quotients of a few pairs at once; those after the last pair are not used.
            let strength = F64x4::from_f64(self.bodies.gravity * self.masses[i]);
            let (pulls, _) = self.pulls.as_chunks_mut::<WIDTH>();
            let (masses, _) = self.masses[from..].as_chunks::<WIDTH>();
            for (pulls, masses) in pulls
                .iter_mut()
                .zip(masses)
                .take(others.len().div_ceil(WIDTH))
            {
                let (squares, masses) = (F64x4::from_array(*pulls), F64x4::from_array(*masses));
                *pulls = (strength * masses / (squares * squares.sqrt())).to_array();
            }
            let mut own = [0.0; 3];
            let pairs = self.apart.iter().zip(&self.pulls);
            for (force, (apart, pull)) in forces.iter_mut().skip(from).zip(pairs) {
                for axis in 0..3 {
                    own[axis] += pull * apart[axis];
                    force[axis] -= pull * apart[axis];
                }
            }
            for (force, own) in forces[i].iter_mut().zip(own) {
                *force += own;
            }
        }
        Ok(())
    }

    /// Adds `size · forces` to the momenta of planets, if they are finite; that of the centre of mass stays.
    pub(super) fn kick(&self, size: f64, p: &mut [f64]) -> Result<(), FlowError> {
        if !self.forces.iter().all(|force| force.is_finite()) {
            let what = Quantity::Force;
            return Err(FlowError::NonFinite { what });
        }
        for (p, force) in p.iter_mut().zip(&self.forces).skip(3) {
            *p += size * force;
        }
        Ok(())
    }
}
