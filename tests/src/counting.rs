//! Systems that count their evaluations.

use std::cell::Cell;

use symplectic::solver::FixedPoint;
use symplectic::system::Jacobian;
use symplectic::{System, Vector};

/// Counts of evaluations.
#[derive(Debug, Default)]
pub struct Counts {
    velocities: Cell<u64>,
    forces: Cell<u64>,
}

impl Counts {
    /// Evaluations of the velocity so far.
    pub fn velocities(&self) -> u64 {
        self.velocities.get()
    }

    /// Evaluations of the force so far.
    pub fn forces(&self) -> u64 {
        self.forces.get()
    }

    fn count(counter: &Cell<u64>) {
        counter.set(counter.get() + 1);
    }
}

/// A system that counts its evaluations. Its solver is the fixed-point iteration.
#[derive(Debug)]
pub struct Counting<'a, S> {
    system: S,
    counts: &'a Counts,
}

impl<'a, S> Counting<'a, S> {
    /// Wraps `system`; evaluations are counted in `counts`.
    pub const fn new(system: S, counts: &'a Counts) -> Self {
        Self { system, counts }
    }
}

impl<V: Vector, S: System<V>> System<V> for Counting<'_, S> {
    type Class = S::Class;
    type Solver = FixedPoint;

    // What is counted are steps.
    const WELL_DECLARED: bool = S::WELL_DECLARED;

    #[inline]
    fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V) {
        Counts::count(&self.counts.velocities);
        self.system.velocity(time, q, p, velocity);
    }

    #[inline]
    fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V) {
        Counts::count(&self.counts.forces);
        self.system.force(time, q, p, force);
    }

    fn energy(&self, time: V::Scalar, q: &V, p: &V) -> Option<V::Scalar> {
        self.system.energy(time, q, p)
    }

    fn second_derivatives(
        &self,
        time: V::Scalar,
        q: &V,
        p: &V,
        jacobian: &mut Jacobian<V::Scalar>,
    ) -> bool {
        self.system.second_derivatives(time, q, p, jacobian)
    }

    fn half_bandwidth(&self) -> usize {
        self.system.half_bandwidth()
    }
}
