//! What a Newton iteration keeps.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;

use num_traits::Zero;

use super::linear_solver::{LinearSolver, Parts};
use crate::error::Quantity;
use crate::method::storage::{first_mismatch, first_non_finite};
use crate::method::{StageStorage, StageTableau};
use crate::number::words::words;
use crate::number::{Vector, Visit, vector_words};
use crate::system::{Class, System};

/// The memory of a [`Newton`](crate::solver::Newton) iteration for the plan `P`.
pub struct NewtonMemory<V: Vector, P, S: System<V>, L: LinearSolver<V, S>> {
    /// Stage values.
    pub(super) q: Vec<V>,
    pub(super) p: Vec<V>,
    /// Evaluations there.
    pub(super) velocity: Vec<V>,
    pub(super) force: Vec<V>,
    /// Increments of the position and of the momentum, in the form of the plan.
    pub(super) u: Vec<V>,
    pub(super) w: Vec<V>,
    /// A point in the middle of the stages.
    pub(super) middle: (V, V),
    /// Residuals and corrections, one stage after another: of `h velocity` and `h force`, or, of a general system, of both
    /// in `x`, by turns.
    pub(super) x: Vec<V::Scalar>,
    pub(super) y: Vec<V::Scalar>,
    /// The same after the transformation, and the unknown of one linear system.
    pub(super) transformed: Vec<V::Scalar>,
    pub(super) unknown: Vec<V::Scalar>,
    /// Two vectors.
    pub(super) vectors: [Vec<V::Scalar>; 2],
    /// Matrices over the stages, where these stay coupled.
    pub(super) couplings: [Vec<f64>; 2],
    pub(super) linear: L::Memory,
    /// The step size that the factors are for.
    pub(super) factored: Option<f64>,
    /// Whether the derivatives are to be taken anew.
    pub(super) stale: bool,
    /// The largest factor from one change to the next in this step.
    pub(super) contraction: f64,
    /// How often the linear systems were factored in this step.
    pub(super) factorisations: u32,
    /// The times of all stages, and `h a_ij` and `h ã_ij` by rows: for derivatives at every stage.
    pub(super) times: Vec<f64>,
    pub(super) scaled: [Vec<f64>; 2],
    /// Steps that are left to the derivatives at every stage.
    pub(super) steps_in_full: u32,
    /// Residuals, to tell their noise by.
    pub(super) residuals: [Vec<V::Scalar>; 2],
    /// The first change of this step, if it began with extrapolated values.
    pub(super) first_change: Option<f64>,
    /// Steps to go before starting values are extrapolated again.
    pub(super) waiting: u32,
    plan: PhantomData<(P, S)>,
}

/// The number of components that a linear system has for each part, for vectors of dimension `n`.
pub(super) const fn rows<P: StageTableau>(n: usize) -> usize {
    if P::Class::SEPARABLE { n } else { 2 * n }
}

/// The linear systems of a plan.
fn systems<P: StageTableau>() -> Vec<Parts> {
    let Some(decoupling) = P::DECOUPLING else {
        return vec![Parts::Stages(P::MOMENTA.count)];
    };
    let parts = decoupling.blocks.iter().map(|&(_, imaginary)| {
        if imaginary == 0.0 {
            Parts::One
        } else {
            Parts::Two
        }
    });
    parts.collect()
}

impl<V: Vector, P, S: System<V>, L: LinearSolver<V, S>> Clone for NewtonMemory<V, P, S, L> {
    fn clone(&self) -> Self {
        Self {
            q: self.q.clone(),
            p: self.p.clone(),
            velocity: self.velocity.clone(),
            force: self.force.clone(),
            u: self.u.clone(),
            w: self.w.clone(),
            middle: self.middle.clone(),
            x: self.x.clone(),
            y: self.y.clone(),
            transformed: self.transformed.clone(),
            unknown: self.unknown.clone(),
            vectors: self.vectors.clone(),
            couplings: self.couplings.clone(),
            linear: self.linear.clone(),
            times: self.times.clone(),
            scaled: self.scaled.clone(),
            residuals: self.residuals.clone(),
            ..*self
        }
    }
}

impl<V: Vector, P: StageTableau, S: System<V>, L: LinearSolver<V, S>> StageStorage<V>
    for NewtonMemory<V, P, S, L>
{
    fn like(prototype: &V) -> Self {
        let vectors = |count| (0..count).map(|_| prototype.zeros_like()).collect();
        let zeros = |count| vec![V::Scalar::zero(); count];
        let (positions, momenta) = (P::POSITIONS.count, P::MOMENTA.count);
        let n = prototype.dimension();
        let unknowns = momenta * rows::<P>(n);
        let coupled = match P::DECOUPLING {
            Some(_) => 0,
            None => momenta * momenta,
        };
        Self {
            q: vectors(positions),
            p: vectors(momenta),
            velocity: vectors(momenta),
            force: vectors(positions),
            u: vectors(momenta),
            w: vectors(positions),
            middle: (prototype.zeros_like(), prototype.zeros_like()),
            x: zeros(unknowns),
            y: zeros(positions * n),
            transformed: zeros(unknowns),
            unknown: zeros(unknowns),
            vectors: [zeros(n), zeros(n)],
            couplings: [vec![0.0; coupled], vec![0.0; coupled]],
            linear: L::memory(prototype, &systems::<P>()),
            factored: None,
            stale: true,
            contraction: 0.0,
            factorisations: 0,
            times: vec![0.0; positions.max(momenta)],
            scaled: [
                vec![0.0; positions * momenta],
                vec![0.0; positions * momenta],
            ],
            steps_in_full: 0,
            residuals: [zeros(unknowns), zeros(positions * n)],
            first_change: None,
            waiting: 0,
            plan: PhantomData,
        }
    }

    /// What a step begins with: the increments that stages are extrapolated from, the factors, and what the steps before were like.
    fn words(&mut self, visit: &mut Visit<'_>) {
        for vectors in [
            &mut self.q,
            &mut self.p,
            &mut self.velocity,
            &mut self.force,
            &mut self.u,
            &mut self.w,
        ] {
            vector_words(vectors, visit);
        }
        L::words(&mut self.linear, visit);
        words!(
            visit: self.factored, self.stale, self.contraction, self.factorisations, self.steps_in_full,
            self.first_change, self.waiting,
        );
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        first_non_finite((&self.q, &self.force), (&self.p, &self.velocity))
    }

    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        first_mismatch(&self.force, &self.velocity, dimension)
    }
}

impl<V: Vector, P, S: System<V>, L: LinearSolver<V, S>> fmt::Debug for NewtonMemory<V, P, S, L> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("NewtonMemory")
            .field("q", &self.q)
            .field("p", &self.p)
            .field("factored", &self.factored)
            .finish_non_exhaustive()
    }
}
