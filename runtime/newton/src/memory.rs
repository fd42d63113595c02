//! Memory of the Newton iteration.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use num_traits::Zero;

use super::coefficients::StageCoefficients;
use super::linear_solver::{LinearSolver, Parts};
use symplectic_core::inside::{first_mismatch, first_non_finite, show_vectors, words};
use symplectic_core::solver::{StageStorage, StageTableau, Visit, vector_words};
use symplectic_core::system::Class;
use symplectic_core::{Quantity, System, Vector};

/// The memory of a [`Newton`](crate::Newton) iteration with the plan `P`.
pub struct NewtonMemory<V: Vector, P, S: System<V>, L: LinearSolver<V, S>> {
    pub(super) coefficients: StageCoefficients<P>,
    pub(super) work: Workspace<V, S, L>,
}

/// What the sweeps read and write.
pub(super) struct Workspace<V: Vector, S: System<V>, L: LinearSolver<V, S>> {
    /// Stage values.
    pub(super) q: Vec<V>,
    pub(super) p: Vec<V>,
    /// Evaluations at the stages.
    pub(super) velocity: Vec<V>,
    pub(super) force: Vec<V>,
    /// Increments of the position and of the momentum, in the scaling that the tableau uses.
    pub(super) u: Vec<V>,
    pub(super) w: Vec<V>,
    /// A point in the middle of the stages.
    pub(super) middle: (V, V),
    /// Residuals and corrections, stage by stage: of `h velocity` in `x` and `h force` in `y`. For a general system `x` holds both,
    /// alternating.
    pub(super) x: Vec<V::Scalar>,
    pub(super) y: Vec<V::Scalar>,
    /// `x` after the transformation that decouples the stages, and the unknown of one linear system.
    pub(super) transformed: Vec<V::Scalar>,
    pub(super) unknown: Vec<V::Scalar>,
    /// One component of all increments, while they are extrapolated.
    pub(super) component: Vec<V::Scalar>,
    /// Two scratch vectors.
    pub(super) vectors: [Vec<V::Scalar>; 2],
    /// Coupling matrices over the stages, for methods without a decoupling.
    pub(super) couplings: [Vec<f64>; 2],
    pub(super) linear: L::Memory,
    /// The step size for which the systems were factored.
    pub(super) factored: Option<f64>,
    /// Whether the derivatives must be recomputed.
    pub(super) stale: bool,
    /// The times of all stages, and `h a_ij` and `h ã_ij` by rows: for derivatives at every stage.
    pub(super) times: Vec<f64>,
    pub(super) scaled: [Vec<f64>; 2],
    /// Number of further steps that use the derivatives at every stage.
    pub(super) steps_in_full: u32,
    /// Copies of the residuals, for the measurement of their noise.
    pub(super) residuals: [Vec<V::Scalar>; 2],
    /// Number of steps before starting values are extrapolated again.
    pub(super) pause: u32,
}

/// The number of rows of a linear system per part of its unknown, for vectors of dimension `n`.
pub(super) const fn rows<C: Class>(n: usize) -> usize {
    if C::SEPARABLE { n } else { 2 * n }
}

/// The linear systems of a method.
fn systems<P: StageTableau>(coefficients: &StageCoefficients<P>) -> Vec<Parts> {
    let Some(blocks) = coefficients.blocks() else {
        return vec![Parts::Stages(coefficients.momenta().count())];
    };
    let parts = blocks.iter().map(|&(_, imaginary)| {
        if imaginary == 0.0 {
            Parts::One
        } else {
            Parts::Two
        }
    });
    parts.collect()
}

impl<V: Vector, S: System<V>, L: LinearSolver<V, S>> Clone for Workspace<V, S, L> {
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
            component: self.component.clone(),
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

impl<V: Vector, P, S: System<V>, L: LinearSolver<V, S>> Clone for NewtonMemory<V, P, S, L> {
    fn clone(&self) -> Self {
        Self {
            coefficients: self.coefficients.clone(),
            work: self.work.clone(),
        }
    }
}

impl<V: Vector, S: System<V>, L: LinearSolver<V, S>> Workspace<V, S, L> {
    fn new<P: StageTableau>(coefficients: &StageCoefficients<P>, prototype: &V) -> Self {
        let vectors = |count| (0..count).map(|_| prototype.zeros_like()).collect();
        let zeros = |count| vec![V::Scalar::zero(); count];
        let (positions, momenta) = (
            coefficients.positions().count(),
            coefficients.momenta().count(),
        );
        let n = prototype.dimension();
        let unknowns = momenta * rows::<P::Class>(n);
        let coupled = match coefficients.blocks() {
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
            component: zeros(positions.max(momenta)),
            vectors: [zeros(n), zeros(n)],
            couplings: [vec![0.0; coupled], vec![0.0; coupled]],
            linear: L::memory(prototype, &systems(coefficients)),
            factored: None,
            stale: true,
            times: vec![0.0; positions.max(momenta)],
            scaled: [
                vec![0.0; positions * momenta],
                vec![0.0; positions * momenta],
            ],
            steps_in_full: 0,
            residuals: [zeros(unknowns), zeros(positions * n)],
            pause: 0,
        }
    }

    /// The first evaluation that is NaN or infinite although its argument is finite.
    pub(super) fn non_finite(&self) -> Option<(Quantity, usize)> {
        first_non_finite((&self.q, &self.force), (&self.p, &self.velocity))
    }
}

impl<V: Vector, P: StageTableau, S: System<V>, L: LinearSolver<V, S>> NewtonMemory<V, P, S, L> {
    pub(super) fn new(coefficients: StageCoefficients<P>, prototype: &V) -> Self {
        Self {
            work: Workspace::new(&coefficients, prototype),
            coefficients,
        }
    }
}

impl<V: Vector, P: StageTableau, S: System<V>, L: LinearSolver<V, S>> StageStorage<V>
    for NewtonMemory<V, P, S, L>
{
    fn like(prototype: &V) -> Self {
        Self::new(StageCoefficients::CONSTANT, prototype)
    }

    fn anew(&self, prototype: &V) -> Self {
        Self::new(self.coefficients.clone(), prototype)
    }

    /// What the next step starts from: increments for the extrapolation, factors, and what earlier steps have decided.
    fn words(&mut self, visit: &mut Visit<'_>) {
        let work = &mut self.work;
        for vectors in [
            &mut work.q,
            &mut work.p,
            &mut work.velocity,
            &mut work.force,
            &mut work.u,
            &mut work.w,
        ] {
            vector_words(vectors, visit);
        }
        L::words(&mut work.linear, visit);
        words!(visit: work.factored, work.stale, work.steps_in_full, work.pause);
    }

    fn show_words(&self, visit: &mut Visit<'_>) {
        let work = &self.work;
        for vectors in [
            &work.q,
            &work.p,
            &work.velocity,
            &work.force,
            &work.u,
            &work.w,
        ] {
            show_vectors(vectors, visit);
        }
        L::words(&mut work.linear.clone(), visit);
        // The visitor sees copies.
        words!(visit: { work.factored }, { work.stale }, { work.steps_in_full }, { work.pause });
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        self.work.non_finite()
    }

    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        first_mismatch(&self.work.force, &self.work.velocity, dimension)
    }
}

impl<V: Vector, P, S: System<V>, L: LinearSolver<V, S>> fmt::Debug for NewtonMemory<V, P, S, L> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("NewtonMemory")
            .field("q", &self.work.q)
            .field("p", &self.work.p)
            .field("factored", &self.work.factored)
            .finish_non_exhaustive()
    }
}
