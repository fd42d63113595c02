//! The coefficients of coupled stages: the constants of an emitted method, or those of a tableau at run time.

use core::marker::PhantomData;

use symplectic_core::inside::run_time::{self, Coupled};
use symplectic_core::solver::{HalfTableau, StageTableau};
use symplectic_core::{Class, RunTimeTableau};

/// The coefficients of coupled stages, as Newton's iteration reads them:
///
/// ```text
/// Q_i = q0 + Σ_j positions_ij u_j    u_j = h b_j velocity_j
/// P_i = p0 + Σ_j momenta_ij w_j      w_j = h b̃_j force_j
/// ```
///
/// if the sums are of [increments](Self::increments); otherwise `u_j = velocity_j` and `w_j = force_j`, with factors of `h` in front of
/// the sums.
pub trait StageCoefficients: Clone + Default {
    /// The class of systems.
    type Class: Class;
    /// The positions or the momenta.
    type Half<'a>: HalfCoefficients
    where
        Self: 'a;

    /// Whether stages are sums of increments.
    fn increments(&self) -> bool;

    /// Positions, and the forces there.
    fn positions(&self) -> Self::Half<'_>;

    /// Momenta, and the velocities there.
    fn momenta(&self) -> Self::Half<'_>;

    /// The blocks of the [`Decoupling`](symplectic_core::solver::Decoupling): `(α, ω)`, with `ω = 0` for a real eigenvalue. `None` if the linear
    /// systems do not decouple.
    fn blocks(&self) -> Option<&[(f64, f64)]>;

    /// A row of `X`.
    fn stage_row(&self, row: usize) -> &[f64];

    /// A row of `X⁻¹`.
    fn block_row(&self, row: usize) -> &[f64];

    /// The tableau, if it is known only at run time.
    fn tableau(&self) -> Option<&RunTimeTableau> {
        None
    }

    /// Takes the coefficients of a tableau at run time.
    fn set_tableau(&mut self, _tableau: &RunTimeTableau) {}
}

/// The positions or the momenta of [`StageCoefficients`]: stage values, and the evaluations at them.
pub trait HalfCoefficients: Copy {
    /// The number of stages.
    fn count(self) -> usize;

    /// The coefficient of evaluation `j` of the other half in stage `i`.
    fn entry(self, i: usize, j: usize) -> f64;

    /// The time of an evaluation, as a fraction of the step.
    fn time(self, evaluation: usize) -> f64;

    /// The factor of an evaluation in its increment, without `h`.
    fn weight(self, evaluation: usize) -> f64;

    /// Whether an evaluation enters the result of the step.
    fn counts(self, evaluation: usize) -> bool;

    /// Whether increments can be extrapolated to the next step of the same size.
    fn extrapolates(self) -> bool;

    /// The coefficient of the old increment `j` in the new increment `i`.
    fn extrapolation(self, i: usize, j: usize) -> f64;
}

/// The coefficients of an emitted method.
#[derive(Debug)]
pub struct Emitted<P>(PhantomData<P>);

impl<P> Clone for Emitted<P> {
    fn clone(&self) -> Self {
        Self(PhantomData)
    }
}

impl<P> Default for Emitted<P> {
    fn default() -> Self {
        Self(PhantomData)
    }
}

impl<P: StageTableau> StageCoefficients for Emitted<P> {
    type Class = P::Class;
    type Half<'a>
        = EmittedHalf
    where
        Self: 'a;

    fn increments(&self) -> bool {
        P::INCREMENTS
    }

    fn positions(&self) -> EmittedHalf {
        EmittedHalf(&P::POSITIONS)
    }

    fn momenta(&self) -> EmittedHalf {
        EmittedHalf(&P::MOMENTA)
    }

    fn blocks(&self) -> Option<&[(f64, f64)]> {
        P::DECOUPLING.map(|decoupling| decoupling.blocks)
    }

    fn stage_row(&self, row: usize) -> &[f64] {
        P::DECOUPLING.map_or(&[], |decoupling| decoupling.to_stages[row])
    }

    fn block_row(&self, row: usize) -> &[f64] {
        P::DECOUPLING.map_or(&[], |decoupling| decoupling.from_stages[row])
    }
}

/// The positions or the momenta of an emitted method.
#[derive(Clone, Copy, Debug)]
pub struct EmittedHalf(&'static HalfTableau);

impl HalfCoefficients for EmittedHalf {
    fn count(self) -> usize {
        self.0.count
    }

    fn entry(self, i: usize, j: usize) -> f64 {
        self.0.columns[j][i]
    }

    fn time(self, evaluation: usize) -> f64 {
        self.0.times[evaluation]
    }

    fn weight(self, evaluation: usize) -> f64 {
        self.0.weights[evaluation]
    }

    fn counts(self, _evaluation: usize) -> bool {
        true
    }

    fn extrapolates(self) -> bool {
        !self.0.extrapolation.is_empty()
    }

    fn extrapolation(self, i: usize, j: usize) -> f64 {
        self.0.extrapolation[j][i]
    }
}

/// The coefficients of a tableau at run time, for systems of class `C`.
#[derive(Clone, Debug)]
pub struct OfTableau<C> {
    tableau: Option<RunTimeTableau>,
    class: PhantomData<C>,
}

impl<C> Default for OfTableau<C> {
    fn default() -> Self {
        Self {
            tableau: None,
            class: PhantomData,
        }
    }
}

impl<C: Class> OfTableau<C> {
    fn coupled(&self) -> &Coupled {
        run_time::coupled::<C>(self.tableau.as_ref())
    }
}

impl<C: Class> StageCoefficients for OfTableau<C> {
    type Class = C;
    type Half<'a>
        = &'a run_time::Half
    where
        Self: 'a;

    fn increments(&self) -> bool {
        true
    }

    fn positions(&self) -> &run_time::Half {
        &self.coupled().positions
    }

    fn momenta(&self) -> &run_time::Half {
        &self.coupled().momenta
    }

    fn blocks(&self) -> Option<&[(f64, f64)]> {
        let decoupling = self.coupled().decoupling.as_ref();
        decoupling.map(|decoupling| &decoupling.blocks[..])
    }

    fn stage_row(&self, row: usize) -> &[f64] {
        let decoupling = self.coupled().decoupling.as_ref();
        decoupling.map_or(&[], |decoupling| &decoupling.to_stages[row])
    }

    fn block_row(&self, row: usize) -> &[f64] {
        let decoupling = self.coupled().decoupling.as_ref();
        decoupling.map_or(&[], |decoupling| &decoupling.from_stages[row])
    }

    fn tableau(&self) -> Option<&RunTimeTableau> {
        self.tableau.as_ref()
    }

    fn set_tableau(&mut self, tableau: &RunTimeTableau) {
        self.tableau = Some(tableau.clone());
    }
}

impl HalfCoefficients for &run_time::Half {
    fn count(self) -> usize {
        self.evaluations.len()
    }

    fn entry(self, i: usize, j: usize) -> f64 {
        self.matrix[i][j]
    }

    fn time(self, evaluation: usize) -> f64 {
        self.evaluations[evaluation].time
    }

    fn weight(self, evaluation: usize) -> f64 {
        self.evaluations[evaluation].factor
    }

    fn counts(self, evaluation: usize) -> bool {
        self.evaluations[evaluation].counts
    }

    fn extrapolates(self) -> bool {
        !self.extrapolation.is_empty()
    }

    fn extrapolation(self, i: usize, j: usize) -> f64 {
        self.extrapolation[i][j]
    }
}
