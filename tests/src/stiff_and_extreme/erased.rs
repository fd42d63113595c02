//! A type-erased system, so that a method is compiled once for all problems.

use std::fmt;
use std::rc::Rc;

use symplectic::nalgebra::{DVector, SVector};
use symplectic::solver::FixedPoint;
use symplectic::{Separable, State, System, Vector};

/// A separable system with any number of components.
#[derive(Clone)]
pub struct Erased(Rc<dyn OnSlices>);

impl Erased {
    /// Erases the type of a system with `N` components.
    pub fn new<S, const N: usize>(system: S) -> Self
    where
        S: System<SVector<f64, N>, Class = Separable> + 'static,
    {
        Self(Rc::new(OfSize(system)))
    }
}

impl fmt::Debug for Erased {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Erased")
    }
}

/// Converts a state to dynamic vectors.
pub fn erased<V: Vector<Scalar = f64>>(state: &State<V>) -> State<DVector<f64>> {
    let vector = |half: &V| DVector::from_column_slice(half.as_slice());
    State::new(state.time, vector(&state.q), vector(&state.p))
}

/// The functions of a system, on slices.
trait OnSlices {
    fn velocity(&self, time: f64, p: &[f64], velocity: &mut [f64]);
    fn force(&self, time: f64, q: &[f64], force: &mut [f64]);
    fn energy(&self, time: f64, q: &[f64], p: &[f64]) -> Option<f64>;
}

/// A system with `N` components.
struct OfSize<S, const N: usize>(S);

impl<S: System<SVector<f64, N>, Class = Separable>, const N: usize> OnSlices for OfSize<S, N> {
    fn velocity(&self, time: f64, p: &[f64], velocity: &mut [f64]) {
        let (p, mut found) = (vector(p), SVector::zeros());
        self.0.velocity(time, &p, &p, &mut found);
        velocity.copy_from_slice(found.as_slice());
    }

    fn force(&self, time: f64, q: &[f64], force: &mut [f64]) {
        let (q, mut found) = (vector(q), SVector::zeros());
        self.0.force(time, &q, &q, &mut found);
        force.copy_from_slice(found.as_slice());
    }

    fn energy(&self, time: f64, q: &[f64], p: &[f64]) -> Option<f64> {
        self.0.energy(time, &vector(q), &vector(p))
    }
}

fn vector<const N: usize>(slice: &[f64]) -> SVector<f64, N> {
    SVector::from_column_slice(slice)
}

impl System<DVector<f64>> for Erased {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(
        &self,
        time: f64,
        _q: &DVector<f64>,
        p: &DVector<f64>,
        velocity: &mut DVector<f64>,
    ) {
        self.0.velocity(time, p.as_slice(), velocity.as_mut_slice());
    }

    fn force(&self, time: f64, q: &DVector<f64>, _p: &DVector<f64>, force: &mut DVector<f64>) {
        self.0.force(time, q.as_slice(), force.as_mut_slice());
    }

    fn energy(&self, time: f64, q: &DVector<f64>, p: &DVector<f64>) -> Option<f64> {
        self.0.energy(time, q.as_slice(), p.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::kepler;
    use symplectic::SeparableHamiltonian;

    #[test]
    fn an_erased_system_has_the_same_velocity_and_force() {
        let start: State<SVector<f64, 2>> = kepler::start(0.6);
        let (system, any) = (Erased::new(kepler::Kepler), erased(&start));
        let (mut velocity, mut force) = (SVector::zeros(), SVector::zeros());
        let (mut found_velocity, mut found_force) = (DVector::zeros(2), DVector::zeros(2));
        SeparableHamiltonian::velocity(&kepler::Kepler, 0.0, &start.p, &mut velocity);
        SeparableHamiltonian::force(&kepler::Kepler, 0.0, &start.q, &mut force);
        system.velocity(0.0, &any.q, &any.p, &mut found_velocity);
        system.force(0.0, &any.q, &any.p, &mut found_force);
        assert_eq!(found_velocity.as_slice(), velocity.as_slice());
        assert_eq!(found_force.as_slice(), force.as_slice());
        assert_eq!(
            system.energy(0.0, &any.q, &any.p),
            System::energy(&kepler::Kepler, 0.0, &start.q, &start.p)
        );
    }
}
