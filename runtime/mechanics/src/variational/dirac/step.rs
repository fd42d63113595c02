//! The equations of a step, and Newton's iteration for them.

use alloc::vec;
use alloc::vec::Vec;

use num_traits::Float;

use super::failure::{Failure, MAX_ITERATIONS};
use super::rows::Rows;
use super::{DiracRule, DiracSystem};
use crate::rank::{RankElimination, Rest};
use crate::variational::lagrangian::derivatives::Derivatives;
use crate::variational::regular::largest;
use symplectic_core::inside::{Part, beside};
use symplectic_core::{Error, Quantity, State, Vector};

/// The residual of a dependent equation counts as zero if it is smaller than this, relative to its terms.
pub(super) const CONSISTENT: f64 = 1e-10;

/// If an iterate changes by less than this, relative to the velocity, the next iterate is exact up to rounding: the iteration converges
/// quadratically.
pub(super) const LAST_CHANGE: f64 = 1e-9;

/// The equations of a step, in this order:
///
/// ```text
/// p0 + D1 Ld(q0, q1) − w(q0)ᵀλ = 0      L_v(q1, v1) − D2 Ld(q0, q1) − w(q1)ᵀμ = 0      w_d(q0, q1)·u = 0      w(q1)·v1 = 0
/// ```
///
/// with `q1 = q0 + h u` and `v1 = u + z`, for `u, z, λ, μ`. Velocities that no equation determines have z = 0.
#[derive(Clone)]
pub(super) struct Equations<L: DiracSystem> {
    pub(super) rule: DiracRule,
    pub(super) derivatives: Derivatives<L>,
    pub(super) rows: Rows<L>,
    pub(super) linear: RankElimination,
    /// u, z, λ and μ.
    pub(super) unknowns: Vec<f64>,
    /// A point of the rule, or q1.
    pub(super) q: Vec<f64>,
    /// v1.
    pub(super) velocity: Vec<f64>,
}

impl<L: DiracSystem> Equations<L> {
    pub(super) fn new(rule: DiracRule, system: &L, q: &[f64]) -> Result<Self, Error> {
        let (n, rows) = (q.len(), Rows::new(system, q)?);
        let count = 2 * (n + rows.constraints());
        Ok(Self {
            rule,
            derivatives: Derivatives::new(n)?,
            rows,
            linear: RankElimination::new(count, count),
            unknowns: vec![0.0; count],
            q: vec![0.0; n],
            velocity: vec![0.0; n],
        })
    }

    /// Takes a step from `state`, and writes its end there. On entry `velocity` is an approximation of that at the start; on return it is
    /// that at the end.
    pub(super) fn take(
        &mut self,
        system: &L,
        part: Part,
        state: &mut State<L::Vector<f64>>,
        velocity: &mut L::Vector<f64>,
    ) -> Result<(), Failure> {
        self.solve(system, part, state, velocity.as_slice())?;
        let State { q, p, .. } = state;
        self.look_at(q.as_slice(), part.size);
        self.derivatives
            .first(system, part.end, &self.q, &self.velocity);
        if !self.derivatives.is_finite() {
            return Err(Failure::Evaluation(self.derivatives.failure(None)));
        }
        q.as_mut_slice().copy_from_slice(&self.q);
        p.as_mut_slice().copy_from_slice(&self.derivatives.momentum);
        velocity.as_mut_slice().copy_from_slice(&self.velocity);
        Ok(())
    }

    fn solve(
        &mut self,
        system: &L,
        part: Part,
        state: &State<L::Vector<f64>>,
        velocity: &[f64],
    ) -> Result<(), Failure> {
        let n = velocity.len();
        let (q0, p0) = (state.q.as_slice(), state.p.as_slice());
        self.unknowns.fill(0.0);
        self.unknowns[..n].copy_from_slice(velocity);
        let resolution = 16.0 * f64::EPSILON * largest(q0) / Float::abs(part.size);
        let (mut residual, mut contradicted) = (f64::INFINITY, false);
        for _ in 0..MAX_ITERATIONS {
            self.assemble(system, part, q0, p0)?;
            self.eliminate(n)?;
            let changes = self.linear.solve();
            for (unknown, change) in self.unknowns.iter_mut().zip(changes) {
                *unknown += change;
            }
            let changed = largest(&changes[..2 * n]);
            let size = largest(&self.unknowns[..2 * n]);
            residual = changed / size;
            if changed <= LAST_CHANGE * size + resolution {
                match self.contradiction(n) {
                    None => return Ok(()),
                    // The iterate before the last change was not exact.
                    Some(_) if !contradicted => contradicted = true,
                    Some(failure) => return Err(failure),
                }
            }
        }
        Err(Failure::NotFound { residual })
    }

    /// Eliminates z, λ and μ, then u from the remaining equations: u is unique if each of its components has a pivot.
    fn eliminate(&mut self, n: usize) -> Result<(), Failure> {
        let linear = &mut self.linear;
        if !linear.is_finite() {
            return Err(Failure::NonFinite);
        }
        let (m, count) = (self.rows.constraints(), self.unknowns.len());
        linear.eliminate(0..count, n..count);
        if let Some(constraint) = (0..m).find(|a| !linear.has_pivot(2 * n + a)) {
            return Err(Failure::Dependent { constraint });
        }
        linear.eliminate(0..count, 0..n);
        match (0..n).find(|&component| !linear.has_pivot(component)) {
            Some(component) => Err(Failure::Undetermined { component }),
            None => Ok(()),
        }
    }

    /// The equation with the largest contradiction, if there is one.
    fn contradiction(&self, n: usize) -> Option<Failure> {
        let Rest { row, value, .. } = largest_contradiction(self.linear.rests())?;
        let (what, index) = if row < 2 * n {
            (Quantity::Momentum, row % n)
        } else {
            (
                Quantity::Constraint,
                (row - 2 * n) % self.rows.constraints(),
            )
        };
        let value = Float::abs(value);
        Some(Failure::Contradiction { what, index, value })
    }

    /// Identifies a system, by its Lagrangian, and by its constraints at a position beside that of a state.
    pub(super) fn fingerprint(
        &mut self,
        system: &L,
        State { time, q, .. }: &State<L::Vector<f64>>,
        velocity: &L::Vector<f64>,
    ) -> Vec<f64> {
        let mut numbers = (self.derivatives).fingerprint(system, *time, q, velocity);
        if let Some(entries) = self.rows.at(system, beside(q).as_slice()) {
            numbers.extend(entries.map(|entry| entry.value));
        }
        numbers
    }

    /// Moves to q1 and v1.
    pub(super) fn look_at(&mut self, q0: &[f64], way: f64) {
        let n = q0.len();
        self.go(q0, way);
        for (k, v) in self.velocity.iter_mut().enumerate() {
            *v = self.unknowns[k] + self.unknowns[n + k];
        }
    }

    /// Moves to the position `q0 + way u`.
    pub(super) fn go(&mut self, q0: &[f64], way: f64) {
        let pairs = q0.iter().zip(&self.unknowns);
        for (q, (q0, u)) in self.q.iter_mut().zip(pairs) {
            *q = q0 + way * u;
        }
    }
}

/// The largest of the residuals that exceed rounding errors, relative to their terms.
pub(super) fn largest_contradiction(rests: impl Iterator<Item = Rest>) -> Option<Rest> {
    let relative = |rest: &Rest| Float::abs(rest.value) / rest.size;
    rests
        .filter(|rest| Float::abs(rest.value) > CONSISTENT * rest.size)
        .max_by(|a, b| relative(a).total_cmp(&relative(b)))
}
