//! The masses of bodies.

use alloc::vec::Vec;

use crate::{Error, check_count, check_parameter};
use symplectic_core::{State, Vector};

/// Masses, the first of which is the star's, and the constant of gravity.
#[derive(Clone, Debug)]
pub(super) struct Bodies {
    pub(super) gravity: f64,
    pub(super) masses: Vec<f64>,
    /// `M_i`, the total mass of the bodies up to body i.
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
        check_count(
            "number of bodies",
            masses.len(),
            !masses.is_empty(),
            "1 or more",
        )?;
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
        for count in [state.q.dimension(), state.p.dimension()] {
            check_count(
                "number of components of the state",
                count,
                count == 3 * self.masses.len(),
                "three for each body",
            )?;
        }
        Ok(state.clone())
    }
}
