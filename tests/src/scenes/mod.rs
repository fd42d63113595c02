//! Problems, one per file: the Hamiltonian over any scalar, the initial data with their source, a reference, and the
//! requirements on a method.

pub mod argon_crystal;
pub mod chain_of_links;
pub mod charged_particle;
pub mod circuit;
pub mod damped_oscillator;
pub mod damped_particle;
pub mod double_pendulum;
pub mod fput_chain;
pub mod fput_springs;
pub mod harmonic_oscillator;
pub mod heavy_top;
pub mod henon_heiles;
pub mod hyperbolic;
pub mod kepler;
pub mod nonholonomic_oscillator;
pub mod nonseparable;
pub mod outer_solar_system;
pub mod pendulum;
pub mod point_vortices;
pub mod post_newtonian_kepler;
pub mod pythagorean_three_body;
pub mod resisted_pendulum;
pub mod rigid_triangles;
pub mod rolling_disk;
pub mod sine_gordon;
pub mod skate;
pub mod sleigh;
pub mod spring_pendulum;

/// The requirements of a scene on a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needs {
    /// `H = T(p) + U(q)`: any method applies, and many are explicit.
    pub separable: bool,
    /// `H = pᵀM⁻¹p/2 + U(q)` with a constant matrix M: Nyström orders hold.
    pub quadratic_kinetic_energy: bool,
    /// Frequencies differ widely: the fastest frequency limits the steps of explicit methods.
    pub stiff: bool,
    /// `∂²H/∂p²` is singular everywhere: there is no Lagrangian, so a method must not need one.
    pub degenerate: bool,
}

impl Needs {
    /// No requirements: separable, with quadratic kinetic energy, neither stiff nor degenerate.
    pub const NOTHING: Self = Self {
        separable: true,
        quadratic_kinetic_energy: true,
        stiff: false,
        degenerate: false,
    };

    /// A method for any Hamiltonian.
    pub const GENERAL: Self = Self {
        separable: false,
        quadratic_kinetic_energy: false,
        ..Self::NOTHING
    };
}

/// Checks for every scene.
#[cfg(test)]
mod check {
    use symplectic::nalgebra::DMatrix;
    use symplectic::system::Class;
    use symplectic::system::Unconstrained;
    use symplectic::{Integrator, State, System, Vector};

    use super::Needs;
    use crate::methods::Gauss8;

    /// Checks the declared needs of the system at `state`, except stiffness.
    pub fn needs<V, S>(needs: Needs, system: &S, state: &State<V>)
    where
        V: Vector<Scalar = f64>,
        S: System<V>,
    {
        assert_eq!(needs.separable, S::Class::SEPARABLE);
        let n = state.q.dimension();
        let shifted = |vector: &V, by: f64| {
            let mut vector = vector.clone();
            let components = vector.as_mut_slice().iter_mut().enumerate();
            components.for_each(|(i, x)| *x += by * (1.0 + i as f64).sin());
            vector
        };
        // ∂²H/∂p², by central differences.
        let masses = |q: &V, p: &V| {
            let velocity = |j: usize, step: f64| {
                let (mut p, mut velocity) = (p.clone(), p.zeros_like());
                p.as_mut_slice()[j] += step;
                system.velocity(state.time, q, &p, &mut velocity);
                velocity
            };
            DMatrix::from_fn(n, n, |i, j| {
                let step = 1e-4 * (1.0 + p.as_slice()[j].abs());
                let difference = velocity(j, step).as_slice()[i] - velocity(j, -step).as_slice()[i];
                difference / (2.0 * step)
            })
        };
        let here = masses(&state.q, &state.p);
        let there = masses(&shifted(&state.q, 0.1), &shifted(&state.p, 0.1));
        let constant = (&here - &there).norm() <= 1e-6 * here.norm();
        assert_eq!(needs.quadratic_kinetic_energy, constant, "{here} {there}");
        let singular = |matrix: &DMatrix<f64>| {
            // Scaled by rows, because masses may differ by many powers of ten.
            let mut scaled = matrix.clone();
            for mut row in scaled.row_iter_mut() {
                let largest = row.amax();
                row /= if largest > 0.0 { largest } else { 1.0 };
            }
            let values = scaled.singular_values();
            values.min() <= 1e-6 * values.max()
        };
        assert_eq!(needs.degenerate, singular(&here) && singular(&there));
    }

    /// Checks that the velocity is ∂H/∂p and the force −∂H/∂q, by central differences of width `step`, to `tolerance`
    /// times the largest component.
    pub fn derivatives<V, S>(system: &S, state: &State<V>, step: f64, tolerance: f64)
    where
        V: Vector<Scalar = f64>,
        S: System<V>,
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
        S: System<V, Class: Unconstrained>,
    {
        let mut integrator = Integrator::new(Gauss8, system, start, step_size).expect("a start");
        integrator
            .integrate_to(end)
            .expect("small steps converge")
            .clone()
    }

    /// Checks that [`end`] has the energy of `start` to the relative `tolerance` and another position.
    pub fn conservation<V, S>(system: S, start: State<V>, step_size: f64, time: f64, tolerance: f64)
    where
        V: Vector<Scalar = f64>,
        S: System<V, Class: Unconstrained> + Copy,
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
