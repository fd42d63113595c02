//! Gravity between bodies.

use alloc::vec::Vec;

use crate::error::Error;
use crate::flow::{FlowError, check_parameter};
use crate::number::{Scalar, Vector};
use crate::state::State;

/// Masses, the first of which is the star's, and the constant of gravity.
#[derive(Clone, Debug)]
pub(super) struct Bodies {
    pub(super) gravity: f64,
    pub(super) masses: Vec<f64>,
    /// `M_i`, the mass of the bodies up to each one.
    pub(super) sums: Vec<f64>,
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
        Ok(Self {
            gravity,
            sums: sums.collect(),
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
        let count = self.masses.len();
        for i in first..count {
            for j in (i + 1).max(2)..count {
                let apart = [0, 1, 2].map(|axis| q[3 * j + axis] - q[3 * i + axis]);
                let square = apart.iter().map(|x| x * x).sum::<f64>();
                if square == 0.0 {
                    return Err(FlowError::Collision {
                        first: i,
                        second: j,
                    });
                }
                let pull = self.gravity * self.masses[i] * self.masses[j]
                    / (square * Scalar::sqrt(square));
                for (axis, apart) in apart.into_iter().enumerate() {
                    forces[3 * i + axis] += pull * apart;
                    forces[3 * j + axis] -= pull * apart;
                }
            }
        }
        Ok(())
    }
}
