//! Problems, one a file: the Hamiltonian over any scalar, the initial data with its source, a reference, and what a
//! method has to bring along to integrate it.

pub mod double_pendulum;
pub mod fput_chain;
pub mod fput_springs;
pub mod henon_heiles;
pub mod kepler;
pub mod nonseparable;
pub mod outer_solar_system;

/// What every scene has to hold.
#[cfg(test)]
mod check {
    use symplectic::{Hamiltonian, Integrator, State, Vector};

    use crate::methods::Gauss8;

    /// The velocity is ∂H/∂p and the force −∂H/∂q, by central differences of width `step`, to `tolerance` times
    /// the largest component.
    pub fn derivatives<V, S>(system: &S, state: &State<V>, step: f64, tolerance: f64)
    where
        V: Vector<Scalar = f64>,
        S: Hamiltonian<V>,
    {
        let State { time, q, p } = state;
        let energy = |q: &V, p: &V| {
            system
                .energy(*time, q, p)
                .expect("every scene has an energy")
        };
        let slope = |vector: &V, i: usize, energy: &dyn Fn(&V) -> f64| {
            let mut shifted = vector.clone();
            shifted.as_mut_slice()[i] = vector.as_slice()[i] + step;
            let above = energy(&shifted);
            shifted.as_mut_slice()[i] = vector.as_slice()[i] - step;
            (above - energy(&shifted)) / (2.0 * step)
        };
        let (mut velocity, mut force) = (q.zeros_like(), q.zeros_like());
        system.velocity(*time, q, p, &mut velocity);
        system.force(*time, q, p, &mut force);
        let components = velocity.as_slice().iter().chain(force.as_slice());
        let bound = tolerance * components.fold(1.0_f64, |largest, x| largest.max(x.abs()));
        for i in 0..q.dimension() {
            let error = velocity.as_slice()[i] - slope(p, i, &|p| energy(q, p));
            assert!(error.abs() < bound, "velocity {i} is off by {error:e}");
            let error = force.as_slice()[i] + slope(q, i, &|q| energy(q, p));
            assert!(error.abs() < bound, "force {i} is off by {error:e}");
        }
    }

    /// The state at `end`, by Gauss with eight stages.
    pub fn end<V, S>(system: S, start: State<V>, step_size: f64, end: f64) -> State<V>
    where
        V: Vector<Scalar = f64>,
        S: Hamiltonian<V>,
    {
        let mut integrator = Integrator::new(Gauss8, system, start, step_size).expect("a start");
        integrator
            .integrate_to(end)
            .expect("small steps converge")
            .clone()
    }

    /// [`end`] has the energy of `start` to the relative `tolerance`, and is elsewhere.
    pub fn conservation<V, S>(system: S, start: State<V>, step_size: f64, time: f64, tolerance: f64)
    where
        V: Vector<Scalar = f64>,
        S: Hamiltonian<V> + Copy,
    {
        let energy = |state: &State<V>| {
            let energy = system.energy(state.time, &state.q, &state.p);
            energy.expect("every scene has an energy")
        };
        let end = end(system, start.clone(), step_size, time);
        assert_ne!(end.q, start.q);
        let error = (energy(&end) / energy(&start) - 1.0).abs();
        assert!(error < tolerance, "{error:e}");
    }
}
