//! The sums over the evaluations that give coupled stages. Generated code has each sum once, for starting values and for sweeps.

use core::marker::PhantomData;

use super::relax::relax;
use crate::contract::HalfChange;
use crate::number::array::array;
use crate::number::linear_combination::{combine, factors};
use crate::number::{Coefficient, Scalar, Summation, Vector};

/// What the sums are for: [`StartingValues`], or a [`Sweep`].
pub trait StageSums {
    /// The factors of terms that are increments, or that the `weights` turn into increments.
    fn factors<T: Scalar, const N: usize>(
        coefficients: [Coefficient; N],
        weights: [T; N],
    ) -> [T; N];

    /// `stage = base + Σ_j coefficients_j increments_j`. With plain sums, the terms of a sweep are evaluations, and the increments are
    /// `weights_j terms_j`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn increments<V: Vector, const N: usize>(
        &mut self,
        stage: &mut V,
        base: (&V, &V),
        coefficients: [Coefficient; N],
        weights: [V::Scalar; N],
        terms: [&V; N],
    ) {
        self.evaluations(stage, base, Self::factors(coefficients, weights), terms);
    }

    /// `stage = base + Σ_j factors_j evaluations_j`
    fn evaluations<V: Vector, const N: usize>(
        &mut self,
        stage: &mut V,
        base: (&V, &V),
        factors: [V::Scalar; N],
        terms: [&V; N],
    );
}

/// The sums of starting values: all terms are increments.
pub struct StartingValues<R>(PhantomData<R>);

impl<R> StartingValues<R> {
    /// Starting values.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[expect(clippy::new_without_default, reason = "for generated code")]
    pub const fn new() -> Self {
        StartingValues(PhantomData)
    }
}

impl<R: Summation> StageSums for StartingValues<R> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn factors<T: Scalar, const N: usize>(
        coefficients: [Coefficient; N],
        _weights: [T; N],
    ) -> [T; N] {
        factors(coefficients)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluations<V: Vector, const N: usize>(
        &mut self,
        stage: &mut V,
        (base, low): (&V, &V),
        factors: [V::Scalar; N],
        terms: [&V; N],
    ) {
        combine::<R, V, N>(stage, base, low, factors, terms);
    }
}

/// The sums of a sweep, which records how much the stages change.
///
/// With [compensated](Summation::COMPENSATED) sums a sweep turns evaluations into [increments](crate::emitted::increment) as soon as they
/// are made. With plain sums the factors of the sums have the weights.
pub struct Sweep<'a, R> {
    change: &'a mut HalfChange,
    sums: PhantomData<R>,
}

impl<'a, R> Sweep<'a, R> {
    /// A sweep over the stages of one kind.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn new(change: &'a mut HalfChange) -> Self {
        Sweep {
            change,
            sums: PhantomData,
        }
    }
}

impl<R: Summation> StageSums for Sweep<'_, R> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn factors<T: Scalar, const N: usize>(
        coefficients: [Coefficient; N],
        weights: [T; N],
    ) -> [T; N] {
        let factors = factors(coefficients);
        match R::COMPENSATED {
            true => factors,
            false => array(T::zero(), |j| factors[j] * weights[j]),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluations<V: Vector, const N: usize>(
        &mut self,
        stage: &mut V,
        (base, low): (&V, &V),
        factors: [V::Scalar; N],
        terms: [&V; N],
    ) {
        relax::<R, V, N>(stage, base, low, factors, terms, self.change);
    }
}
