//! Full Newton: one linear system for all stages, with the derivatives at each of them.

use alloc::vec;
use alloc::vec::Vec;

use symplectic_core::solver::Failure;
use symplectic_core::system::Jacobian;
use symplectic_core::{Quantity, Scalar};
use symplectic_linearisation::Elimination;

/// All stages of a step, for a [`LinearSolver`](crate::LinearSolver) that evaluates the derivatives at each of them.
#[derive(Clone, Copy, Debug)]
pub struct EveryStage<'a, V> {
    /// Positions of the stages, at which the forces are evaluated.
    pub q: &'a [V],
    /// Momenta of the stages, at which the velocities are evaluated. In a separable system their number may differ from that of the
    /// positions.
    pub p: &'a [V],
    /// Position and momentum at the start of the step, for evaluations that do not depend on them.
    pub start: (&'a V, &'a V),
    /// The times of the stages.
    pub times: &'a [f64],
    /// `h a_ij` by rows: coefficient of velocity `j` in position `i`.
    pub positions: &'a [f64],
    /// `h ã_ij` by rows: coefficient of force `j` in momentum `i`.
    pub momenta: &'a [f64],
}

impl<'a, V> EveryStage<'a, V> {
    /// The number of points at which derivatives are evaluated.
    pub fn count(&self) -> usize {
        self.q.len().max(self.p.len())
    }

    /// Time, position and momentum of one of these points.
    pub fn point(&self, number: usize) -> (f64, &'a V, &'a V) {
        let time = self.times.get(number).copied().unwrap_or(f64::NAN);
        let q = self.q.get(number).unwrap_or(self.start.0);
        (time, q, self.p.get(number).unwrap_or(self.start.1))
    }
}

/// Memory of full Newton.
#[derive(Clone, Debug)]
pub(super) struct AllStages<T> {
    pub(super) jacobians: Vec<Jacobian<T>>,
    elimination: Elimination<T>,
    /// `Σ_i ã_ji F_i a_il` for the stages `j` and `l` of one row of blocks.
    vectors: [Vec<T>; 2],
}

impl<T: Scalar> AllStages<T> {
    /// For `points` stages with derivatives of the shape of `like`; `momenta` of the stages have a velocity.
    pub(super) fn new(like: &Jacobian<T>, points: usize, momenta: usize, separable: bool) -> Self {
        let (n, half) = (
            like.force_by_position.size(),
            like.force_by_position.half_bandwidth(),
        );
        let (rows, half) = if separable {
            (n, 2 * half)
        } else {
            (2 * n, 2 * half + 1)
        };
        let band = (half + 1).saturating_mul(momenta).saturating_sub(1);
        Self {
            jacobians: vec![like.clone(); points],
            elimination: Elimination::new(
                rows * momenta,
                band.min((rows * momenta).saturating_sub(1)),
            ),
            vectors: [vec![T::zero(); n], vec![T::zero(); n]],
        }
    }

    /// Turns residuals into corrections, for a separable system: `x` for the velocities, `y` for the forces, stage by stage.
    ///
    /// ```text
    /// x_j − V_j Σ_i ã_ji F_i Σ_l a_il x_l = ρ_j + V_j Σ_i ã_ji σ_i      y_i = σ_i + F_i Σ_l a_il x_l
    /// ```
    pub(super) fn correct_separable<V>(
        &mut self,
        stages: &EveryStage<'_, V>,
        x: &mut [T],
        y: &mut [T],
    ) -> Result<(), Failure> {
        let Self {
            jacobians,
            elimination,
            vectors: [sum, product],
        } = self;
        let (positions, momenta, n) = (stages.q.len(), stages.p.len(), sum.len());
        let a = |i: usize, l: usize| T::from_f64(stages.positions[i * momenta + l]);
        let a_tilde = |j: usize, i: usize| T::from_f64(stages.momenta[j * positions + i]);
        for j in 0..momenta {
            sum.fill(T::zero());
            for i in 0..positions {
                let part = sum.iter_mut().zip(&y[i * n..]);
                part.for_each(|(sum, &y)| *sum += a_tilde(j, i) * y);
            }
            jacobians[j].velocity_by_momentum.multiply(sum, product);
            let row = x[j * n..].iter_mut().zip(&*product);
            row.for_each(|(x, &product)| *x += product);
        }
        let entry = |row: usize, column: usize| {
            let ((k, j), (m, l)) = (
                (row / momenta, row % momenta),
                (column / momenta, column % momenta),
            );
            let velocities = &jacobians[j].velocity_by_momentum;
            let mut entry = if row == column { T::one() } else { T::zero() };
            for between in velocities.columns(k) {
                let mut forces = T::zero();
                for (i, jacobian) in jacobians.iter().enumerate().take(positions) {
                    let force = jacobian.force_by_position.get(between, m);
                    forces += a_tilde(j, i) * a(i, l) * force;
                }
                entry -= velocities.get(k, between) * forces;
            }
            entry
        };
        solve(elimination, entry, x, momenta, n)?;
        for i in 0..positions {
            sum.fill(T::zero());
            for l in 0..momenta {
                let part = sum.iter_mut().zip(&x[l * n..]);
                part.for_each(|(sum, &x)| *sum += a(i, l) * x);
            }
            jacobians[i].force_by_position.multiply(sum, product);
            let row = y[i * n..].iter_mut().zip(&*product);
            row.for_each(|(y, &product)| *y += product);
        }
        Ok(())
    }

    /// Turns residuals into corrections, for a general system; `x` alternates between velocities and forces.
    pub(super) fn correct_general<V>(
        &mut self,
        stages: &EveryStage<'_, V>,
        x: &mut [T],
    ) -> Result<(), Failure> {
        let Self {
            jacobians,
            elimination,
            vectors,
        } = self;
        let (count, n) = (stages.q.len(), vectors[0].len());
        let entry = |row: usize, column: usize| {
            let ((r, i), (c, j)) = ((row / count, row % count), (column / count, column % count));
            let jacobian = &jacobians[i];
            let (k, l) = (r / 2, c / 2);
            let derivative = match (r % 2, c % 2) {
                (0, 0) => jacobian.velocity_by_position.get(k, l),
                (0, _) => jacobian.velocity_by_momentum.get(k, l),
                (_, 0) => jacobian.force_by_position.get(k, l),
                _ => jacobian.force_by_momentum(k, l),
            };
            let coupling = if c % 2 == 0 {
                stages.positions
            } else {
                stages.momenta
            };
            let unit = if row == column { T::one() } else { T::zero() };
            unit - T::from_f64(coupling[i * count + j]) * derivative
        };
        solve(elimination, entry, x, count, 2 * n)
    }
}

/// Solves for an unknown that is stored stage by stage; the linear system orders it component by component.
fn solve<T: Scalar>(
    elimination: &mut Elimination<T>,
    entry: impl Fn(usize, usize) -> T,
    x: &mut [T],
    count: usize,
    rows: usize,
) -> Result<(), Failure> {
    if !elimination.factor(entry) {
        return Err(Failure::SingularMatrix);
    }
    for (place, right) in elimination.right.iter_mut().enumerate() {
        *right = x[place % count * rows + place / count];
    }
    elimination.solve();
    for (place, &entry) in elimination.right.iter().enumerate() {
        x[place % count * rows + place / count] = entry;
    }
    Ok(())
}

/// Error if derivatives are NaN or infinite.
pub(super) const NOT_FINITE: Failure = Failure::NonFinite {
    what: Quantity::Derivative,
    stage: None,
};
