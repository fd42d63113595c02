//! Velocity and force at once.

use std::cell::Cell;

use crate::common::methods::{Gauss3, Lobatto3, SymplecticEuler};
use symplectic::nalgebra::SVector;
use symplectic::solver::SimdJacobi;
use symplectic::{
    Error, General, Hamiltonian, Integrator, Method, ProvedFor, Scalar, State, Statistics,
};

type Vector1<T> = SVector<T, 1>;

/// `H = p² exp(−q² − t/8)/2`, with one exponential for both if they are `SHARED`; counts its exponentials.
struct Bell<'a, const SHARED: bool>(&'a Cell<u64>);

impl<const SHARED: bool> Bell<'_, SHARED> {
    fn exponential<T: Scalar>(&self, time: T, q: T) -> T {
        self.0.set(self.0.get() + 1);
        (-q * q - time * T::from_f64(0.125)).exp()
    }
}

impl<const SHARED: bool> Hamiltonian for Bell<'_, SHARED> {
    type Class = General;
    type Vector<T: Scalar> = Vector1<T>;

    fn velocity<T: Scalar>(
        &self,
        time: T,
        q: &Vector1<T>,
        p: &Vector1<T>,
        velocity: &mut Vector1<T>,
    ) {
        velocity[0] = p[0] * self.exponential(time, q[0]);
    }

    fn force<T: Scalar>(&self, time: T, q: &Vector1<T>, p: &Vector1<T>, force: &mut Vector1<T>) {
        force[0] = q[0] * p[0] * (p[0] * self.exponential(time, q[0]));
    }

    fn slopes<T: Scalar>(
        &self,
        time: T,
        q: &Vector1<T>,
        p: &Vector1<T>,
        (velocity, force): (&mut Vector1<T>, &mut Vector1<T>),
    ) {
        Hamiltonian::velocity(self, time, q, p, velocity);
        match SHARED {
            true => force[0] = q[0] * p[0] * velocity[0],
            false => Hamiltonian::force(self, time, q, p, force),
        }
    }
}

#[test]
fn subexpressions_of_both_slopes_are_evaluated_once() -> Result<(), Error> {
    type Run = (State<Vector1<f64>>, Statistics, u64);
    fn run<M: Method + ProvedFor<General>, const SHARED: bool>(method: M) -> Result<Run, Error> {
        let count = Cell::new(0);
        let start = State::new(0.0, Vector1::new(0.4), Vector1::new(0.7));
        let made = Integrator::new(method, Bell::<SHARED>(&count), start, 0.05)?;
        let mut at_once = made.with_solver(SimdJacobi);
        count.set(0);
        at_once.take_steps(500)?;
        Ok((at_once.state().clone(), *at_once.statistics(), count.get()))
    }
    fn check<M: Method + Copy + ProvedFor<General>>(method: M, share: u64) -> Result<(), Error> {
        let (shared, alone) = (run::<M, true>(method)?, run::<M, false>(method)?);
        assert_eq!((&shared.0, &shared.1), (&alone.0, &alone.1), "{}", M::NAME);
        assert_eq!(share * shared.2, alone.2, "{}", M::NAME);
        Ok(())
    }
    check(Gauss3, 2)?;
    check(Lobatto3, 2)?;
    check(SymplecticEuler, 1)
}
