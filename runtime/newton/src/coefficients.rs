//! The coefficients of coupled stages: the constants of an emitted method, or the rows of a tableau at run time.

use alloc::sync::Arc;
use core::marker::PhantomData;

use symplectic_core::inside::rows::{CoupledRows, HalfRows, RowDecoupling};
use symplectic_core::solver::{HalfTableau, StageTableau};

/// The coefficients of coupled stages, as Newton's iteration reads them:
///
/// ```text
/// Q_i = q0 + Σ_j positions_ij u_j    u_j = h b_j velocity_j
/// P_i = p0 + Σ_j momenta_ij w_j      w_j = h b̃_j force_j
/// ```
///
/// if the sums are of [increments](Self::increments); otherwise `u_j = velocity_j` and `w_j = force_j`, with factors of `h` in front of
/// the sums.
#[derive(Debug)]
pub struct StageCoefficients<P> {
    /// Those of a plan whose coefficients are known only at run time.
    rows: Option<Arc<CoupledRows>>,
    plan: PhantomData<P>,
}

impl<P> Clone for StageCoefficients<P> {
    fn clone(&self) -> Self {
        Self {
            rows: self.rows.clone(),
            plan: PhantomData,
        }
    }
}

impl<P: StageTableau> StageCoefficients<P> {
    /// The constants of a plan.
    pub(super) const CONSTANT: Self = Self {
        rows: None,
        plan: PhantomData,
    };

    /// The coefficients of a plan.
    pub(super) fn of(plan: &P) -> Self {
        Self {
            rows: plan.rows().cloned(),
            plan: PhantomData,
        }
    }

    /// The rows. A constant condition: emitted methods compile without them.
    #[inline]
    fn rows(&self) -> Option<&CoupledRows> {
        match P::AT_RUN_TIME {
            true => self.rows.as_deref(),
            false => None,
        }
    }

    /// Whether stages are sums of increments.
    pub(super) const fn increments(&self) -> bool {
        P::INCREMENTS
    }

    /// Positions, and the forces there.
    #[inline]
    pub(super) fn positions(&self) -> HalfCoefficients<'_> {
        match self.rows() {
            Some(rows) => HalfCoefficients::Rows(&rows.positions),
            None => HalfCoefficients::Constant(&P::POSITIONS),
        }
    }

    /// Momenta, and the velocities there.
    #[inline]
    pub(super) fn momenta(&self) -> HalfCoefficients<'_> {
        match self.rows() {
            Some(rows) => HalfCoefficients::Rows(&rows.momenta),
            None => HalfCoefficients::Constant(&P::MOMENTA),
        }
    }

    fn decoupling(&self) -> Option<&RowDecoupling> {
        self.rows().and_then(|rows| rows.decoupling.as_ref())
    }

    /// The blocks of the [`Decoupling`](symplectic_core::solver::Decoupling): `(α, ω)`, with `ω = 0` for a real eigenvalue. `None` if the linear
    /// systems do not decouple.
    pub(super) fn blocks(&self) -> Option<&[(f64, f64)]> {
        match P::AT_RUN_TIME {
            true => self.decoupling().map(|decoupling| &decoupling.blocks[..]),
            false => P::DECOUPLING.map(|decoupling| decoupling.blocks),
        }
    }

    /// A row of `X`.
    pub(super) fn stage_row(&self, row: usize) -> &[f64] {
        match P::AT_RUN_TIME {
            true => (self.decoupling()).map_or(&[], |decoupling| &decoupling.to_stages[row]),
            false => P::DECOUPLING.map_or(&[], |decoupling| decoupling.to_stages[row]),
        }
    }

    /// A row of `X⁻¹`.
    pub(super) fn block_row(&self, row: usize) -> &[f64] {
        match P::AT_RUN_TIME {
            true => (self.decoupling()).map_or(&[], |decoupling| &decoupling.from_stages[row]),
            false => P::DECOUPLING.map_or(&[], |decoupling| decoupling.from_stages[row]),
        }
    }
}

/// The positions or the momenta of [`StageCoefficients`]: stage values, and the evaluations at them.
#[derive(Clone, Copy, Debug)]
pub(super) enum HalfCoefficients<'a> {
    Constant(&'static HalfTableau),
    Rows(&'a HalfRows),
}

impl HalfCoefficients<'_> {
    /// The number of stages.
    #[inline]
    pub(super) const fn count(self) -> usize {
        match self {
            Self::Constant(half) => half.count,
            Self::Rows(half) => half.evaluations.len(),
        }
    }

    /// The coefficient of evaluation `j` of the other half in stage `i`.
    #[inline]
    pub(super) fn entry(self, i: usize, j: usize) -> f64 {
        match self {
            Self::Constant(half) => half.columns[j][i],
            Self::Rows(half) => half.matrix[i][j],
        }
    }

    /// The time of an evaluation, as a fraction of the step.
    #[inline]
    pub(super) fn time(self, evaluation: usize) -> f64 {
        match self {
            Self::Constant(half) => half.times[evaluation],
            Self::Rows(half) => half.evaluations[evaluation].time,
        }
    }

    /// The factor of an evaluation in its increment, without `h`.
    #[inline]
    pub(super) fn weight(self, evaluation: usize) -> f64 {
        match self {
            Self::Constant(half) => half.weights[evaluation],
            Self::Rows(half) => half.evaluations[evaluation].factor,
        }
    }

    /// Whether an evaluation enters the result of the step.
    #[inline]
    pub(super) fn counts(self, evaluation: usize) -> bool {
        match self {
            Self::Constant(_) => true,
            Self::Rows(half) => half.evaluations[evaluation].counts,
        }
    }

    /// Whether increments can be extrapolated to the next step of the same size.
    #[inline]
    pub(super) const fn extrapolates(self) -> bool {
        match self {
            Self::Constant(half) => !half.extrapolation.is_empty(),
            Self::Rows(half) => !half.extrapolation.is_empty(),
        }
    }

    /// The coefficient of the old increment `j` in the new increment `i`.
    #[inline]
    pub(super) fn extrapolation(self, i: usize, j: usize) -> f64 {
        match self {
            Self::Constant(half) => half.extrapolation[j][i],
            Self::Rows(half) => half.extrapolation[i][j],
        }
    }
}
