//! What constrained steps evaluate.

use std::cell::Cell;
use symplectic::constraints::{Constrained, Gradients, HolonomicConstraints};

use symplectic::nalgebra::Vector2;
use symplectic::solver::FixedPoint;
use symplectic::system::Masses;
use symplectic::{Error, Integrator, Method, ProvedFor, Separable, State, System};

use crate::systems::{Lobatto3, Pendulum, Rattle};

/// The plane pendulum, which counts evaluations; `UNIT` says that the velocity is the momentum.
#[derive(Default)]
struct Counted<const UNIT: bool> {
    velocities: Cell<u64>,
    forces: Cell<u64>,
    gradients: Cell<u64>,
}

fn count(cell: &Cell<u64>) {
    cell.set(cell.get() + 1);
}

impl<const UNIT: bool> System<Vector2<f64>> for Counted<UNIT> {
    type Class = Constrained<Separable>;
    type Solver = FixedPoint;

    const MASSES: Masses = if UNIT { Masses::Unit } else { Masses::Any };

    fn velocity(&self, _: f64, _: &Vector2<f64>, p: &Vector2<f64>, velocity: &mut Vector2<f64>) {
        count(&self.velocities);
        *velocity = *p;
    }

    fn force(&self, _: f64, _: &Vector2<f64>, _: &Vector2<f64>, force: &mut Vector2<f64>) {
        count(&self.forces);
        *force = Vector2::new(0.0, -1.0);
    }

    fn extra(&self) -> Option<&dyn HolonomicConstraints<Vector2<f64>>> {
        Some(self)
    }
}

impl<const UNIT: bool> HolonomicConstraints<Vector2<f64>> for Counted<UNIT> {
    fn constraints(&self) -> usize {
        1
    }
    fn constraint_values(&self, q: &Vector2<f64>, values: &mut [f64]) {
        HolonomicConstraints::constraint_values(&Pendulum, q, values);
    }
    fn constraint_gradients(&self, q: &Vector2<f64>, gradients: &mut Gradients<f64>) {
        count(&self.gradients);
        HolonomicConstraints::constraint_gradients(&Pendulum, q, gradients);
    }
}

const STEPS: u64 = 100;

/// Velocities, forces, gradients and sweeps of a hundred steps.
fn evaluations<M, const UNIT: bool>(method: M) -> Result<[u64; 4], Error>
where
    M: Method + ProvedFor<Constrained<Separable>>,
{
    let start = State::from_arrays(0.0, [1.0, 0.0], [0.0, 0.3]);
    let mut run = Integrator::new(method, Counted::<UNIT>::default(), start, 0.05)?;
    run.step()?;
    let counts = |run: &Integrator<M, Counted<UNIT>, Vector2<f64>, _, _>| {
        let Counted {
            velocities,
            forces,
            gradients,
        } = run.system();
        [
            velocities.get(),
            forces.get(),
            gradients.get(),
            run.iterations(),
        ]
    };
    let before = counts(&run);
    for _ in 0..STEPS {
        run.step()?;
    }
    let after = counts(&run);
    Ok([0, 1, 2, 3].map(|k| after[k] - before[k]))
}

/// With unit masses the velocity at the end is the momentum, and the last multiplier solves linear equations with the factors of
/// `G(q1) G(q1)ᵀ`, which the next step needs anyway: no evaluation of the system belongs to it.
#[test]
fn unit_masses_need_no_velocity_for_the_last_multiplier() -> Result<(), Error> {
    // RATTLE: one velocity for the first guess and one in each sweep, because both stages have the same momentum; one force, at the end, and
    // two gradients, there and for the matrix of Newton's iteration.
    let [velocities, forces, gradients, sweeps] = evaluations::<_, true>(Rattle)?;
    assert_eq!(
        [velocities, forces, gradients],
        [STEPS + sweeps, STEPS, 2 * STEPS]
    );
    assert!(sweeps <= 5 * STEPS, "{sweeps}");
    // Otherwise the last multiplier takes two velocities, its own and that which shows that it is one, and at most one more for rounding.
    let [others, forces, gradients, same_sweeps] = evaluations::<_, false>(Rattle)?;
    assert_eq!([forces, gradients, same_sweeps], [STEPS, 2 * STEPS, sweeps]);
    let last = others - velocities;
    assert!((2 * STEPS..=3 * STEPS).contains(&last), "{last}");
    // Lobatto with three stages: also the force and the gradient in the middle in each sweep; the last sweep of a step moves nothing more.
    let [velocities, forces, gradients, sweeps] = evaluations::<_, true>(Lobatto3)?;
    assert_eq!([forces, gradients], [STEPS + sweeps, 2 * STEPS + sweeps]);
    // Three momenta in each sweep, and again where stages follow the multipliers, after all sweeps but the last.
    assert_eq!(velocities, STEPS + 3 * sweeps + 3 * (sweeps - STEPS));
    let [others, ..] = evaluations::<_, false>(Lobatto3)?;
    let last = others - velocities;
    assert!((2 * STEPS..=3 * STEPS).contains(&last), "{last}");
    Ok(())
}

symplectic::hamiltonian! {
    /// A particle on a tilted plane, with a force along the plane and a constant one across it.
    Tilted { across: 0 }
    q: [x, y, z], p: [px, py, pz];
    let along = (2 x - y)/2;
    H = (px^2 + py^2 + pz^2)/2 + along^4/4 + across (x + 2 y - 3 z)
    constraints: { plane = x + 2 y - 3 z - 1 }
}

/// Where no force acts across the constraint, its multipliers are rounding errors. They are extrapolated all the same, so a step takes as
/// many sweeps as with a constant force across it.
#[test]
fn multipliers_that_vanish_cost_no_sweeps() -> Result<(), Error> {
    let sweeps = |across: f64| -> Result<f64, Error> {
        let start = State::from_arrays(0.0, [0.9, 0.05, 0.0], [0.8, -0.4, 0.0]);
        let mut run = Integrator::new(Lobatto3, Tilted { across }, start, 0.1)?;
        run.take_steps(500)?;
        Ok(run.statistics().mean_iterations())
    };
    let (without, with) = (sweeps(0.0)?, sweeps(1.0)?);
    assert!((without - with).abs() < 0.3, "{without} {with}");
    Ok(())
}
