//! What a step evaluates: as often as it has to and no more, at the times it has to.

use std::cell::RefCell;

use symplectic::nalgebra::{Vector1, Vector2};
use symplectic::solver::FixedPoint;
use symplectic::{Error, General, Integrator, Method, Separable, State, System};
use symplectic_tests::counting::{Counting, Counts};
use symplectic_tests::measure::{integrate, position_error};
use symplectic_tests::methods::{Gauss4, Gauss8, Lobatto3, StoermerVerlet, SymplecticEuler};
use symplectic_tests::order::ObservedOrder;
use symplectic_tests::scenes::kepler;

const STEPS: u64 = 100;

/// Evaluations of force and velocity and sweeps in [`STEPS`] steps of Kepler's problem.
fn evaluations<M: Method + Copy>(method: M) -> Result<(u64, u64, u64), Error> {
    let counts = Counts::default();
    let system = Counting::new(kepler::Kepler, &counts);
    let mut integrator = Integrator::new(method, system, kepler::start::<f64>(0.6), 0.05)?;
    for _ in 0..STEPS {
        integrator.step()?;
    }
    Ok((
        counts.forces(),
        counts.velocities(),
        integrator.iterations(),
    ))
}

#[test]
fn stoermer_verlet_makes_one_force_evaluation_a_step_and_one_to_start() -> Result<(), Error> {
    assert_eq!(evaluations(StoermerVerlet)?, (STEPS + 1, STEPS, 0));
    Ok(())
}

#[test]
fn symplectic_euler_evaluates_velocity_and_force_once_a_step() -> Result<(), Error> {
    assert_eq!(evaluations(SymplecticEuler)?, (STEPS, STEPS, 0));
    Ok(())
}

#[test]
fn lobatto_3_makes_one_force_evaluation_a_sweep_and_one_at_the_end() -> Result<(), Error> {
    let (forces, velocities, sweeps) = evaluations(Lobatto3)?;
    // Only the middle position is solved for: the first is q0, the last q1, and its force is that of the next first.
    assert_eq!(forces, sweeps + STEPS + 1);
    // All three momenta are, the first time from the velocity at the start, then from the step before.
    assert_eq!(velocities, 3 * sweeps + 1);
    assert!(sweeps > 2 * STEPS);
    Ok(())
}

#[test]
fn gauss_4_evaluates_velocity_and_force_four_times_a_sweep() -> Result<(), Error> {
    let (forces, velocities, sweeps) = evaluations(Gauss4)?;
    assert_eq!(forces, 4 * sweeps);
    assert_eq!(velocities, 4 * sweeps + 1);
    Ok(())
}

#[test]
fn a_new_state_costs_a_force_evaluation_and_a_new_step_size_none() -> Result<(), Error> {
    let counts = Counts::default();
    let system = Counting::new(kepler::Kepler, &counts);
    let start = kepler::start::<f64>(0.6);
    let mut integrator = Integrator::new(StoermerVerlet, system, start.clone(), 0.05)?;
    integrator.step()?;
    integrator.set_step_size(0.025)?;
    integrator.step()?;
    assert_eq!(
        counts.forces(),
        3,
        "the last force holds for any next step size"
    );
    integrator.set_state(start)?;
    integrator.step()?;
    assert_eq!(
        counts.forces(),
        5,
        "the last force does not hold for another state"
    );
    Ok(())
}

/// An oscillator that notes when it is asked for its force.
struct Times<'a>(&'a RefCell<Vec<f64>>);

impl System<Vector1<f64>> for Times<'_> {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(
        &self,
        _time: f64,
        _q: &Vector1<f64>,
        p: &Vector1<f64>,
        velocity: &mut Vector1<f64>,
    ) {
        *velocity = *p;
    }

    fn force(&self, time: f64, q: &Vector1<f64>, _p: &Vector1<f64>, force: &mut Vector1<f64>) {
        self.0.borrow_mut().push(time);
        *force = -q;
    }
}

#[test]
fn lobatto_3_evaluates_the_force_once_a_step_at_its_end_and_never_at_its_start() -> Result<(), Error>
{
    let times = RefCell::default();
    let mut integrator = Integrator::new(Lobatto3, Times(&times), point(1.0, 0.0), 0.25)?;
    // That the force does not depend on the momentum was tested at the start.
    assert_eq!(times.take(), [0.0, 0.0]);
    for step in 0..4_u32 {
        integrator.step()?;
        let (begin, end) = (0.25 * f64::from(step), 0.25 * f64::from(step + 1));
        let mut times = times.take();
        if step == 0 {
            assert_eq!(times.remove(0), begin);
        }
        assert_eq!(times.pop(), Some(end));
        assert!(
            times.len() > 2 && times.iter().all(|time| *time == begin + 0.125),
            "step {step}: {times:?}"
        );
    }
    Ok(())
}

/// Kepler's problem, not known to be separable.
struct Whole<'a>(Counting<'a, kepler::Kepler>);

impl System<Vector2<f64>> for Whole<'_> {
    type Class = General;
    type Solver = FixedPoint;

    fn velocity(
        &self,
        time: f64,
        _q: &Vector2<f64>,
        p: &Vector2<f64>,
        velocity: &mut Vector2<f64>,
    ) {
        System::velocity(&self.0, time, p, p, velocity);
    }

    fn force(&self, time: f64, q: &Vector2<f64>, _p: &Vector2<f64>, force: &mut Vector2<f64>) {
        System::force(&self.0, time, q, q, force);
    }
}

#[test]
fn verlet_iterates_on_a_general_system_and_ends_at_the_same_state() -> Result<(), Error> {
    let counts = Counts::default();
    let start = kepler::start::<f64>(0.6);
    let mut whole = Integrator::new(
        StoermerVerlet,
        Whole(Counting::new(kepler::Kepler, &counts)),
        start.clone(),
        0.05,
    )?;
    let mut split = Integrator::new(StoermerVerlet, kepler::Kepler, start, 0.05)?;
    for _ in 0..STEPS {
        whole.step()?;
        split.step()?;
    }
    assert!(whole.iterations() >= STEPS && counts.forces() > 2 * STEPS);
    // Nothing is extrapolated, so every step begins with a velocity.
    assert_eq!(
        whole.statistics().evaluations,
        counts.forces() + counts.velocities()
    );
    assert_eq!(split.iterations(), 0);
    // The same steps up to rounding, which the orbit enlarges with the step errors it makes: 100 steps, 2 ε each.
    let distance = position_error(whole.state(), split.state());
    assert!(distance < 1e-11, "{distance:e}");
    Ok(())
}

fn point(q: f64, p: f64) -> State<Vector1<f64>> {
    State::new(0.0, Vector1::new(q), Vector1::new(p))
}

/// H = p²/2 + q²/2 − q cos 3t.
#[derive(Clone, Copy)]
struct Driven;

impl System<Vector1<f64>> for Driven {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(
        &self,
        _time: f64,
        _q: &Vector1<f64>,
        p: &Vector1<f64>,
        velocity: &mut Vector1<f64>,
    ) {
        *velocity = *p;
    }

    fn force(&self, time: f64, q: &Vector1<f64>, _p: &Vector1<f64>, force: &mut Vector1<f64>) {
        force[0] = (3.0 * time).cos() - q[0];
    }
}

/// The solution of [`Driven`] from q = 1, p = 0 at t = 0.
fn driven(time: f64) -> State<Vector1<f64>> {
    let q = (9.0 * time.cos() - (3.0 * time).cos()) / 8.0;
    let p = (3.0 * (3.0 * time).sin() - 9.0 * time.sin()) / 8.0;
    State::new(time, Vector1::new(q), Vector1::new(p))
}

/// H = p² (1 + sin(t)/2)/2 + q²/2 − q cos 3t: a mass and a force that change with time.
#[derive(Clone, Copy)]
struct Breathing;

impl System<Vector1<f64>> for Breathing {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(
        &self,
        time: f64,
        _q: &Vector1<f64>,
        p: &Vector1<f64>,
        velocity: &mut Vector1<f64>,
    ) {
        *velocity = *p * (1.0 + time.sin() / 2.0);
    }

    fn force(&self, time: f64, q: &Vector1<f64>, _p: &Vector1<f64>, force: &mut Vector1<f64>) {
        force[0] = (3.0 * time).cos() - q[0];
    }
}

/// From time 0 to 7 with 64 to 512 steps.
fn order<M, S>(
    method: M,
    system: S,
    reference: &State<Vector1<f64>>,
) -> Result<ObservedOrder, Error>
where
    M: Method + Copy,
    S: System<Vector1<f64>, Class = Separable> + Copy,
{
    let mut errors = Vec::new();
    for steps in [64.0, 128.0, 256.0, 512.0] {
        let step_size = reference.time / steps;
        let end = integrate(method, system, &point(1.0, 0.0), reference.time, step_size)?;
        errors.push((
            step_size,
            position_error(&end, reference).max((end.p - reference.p).norm()),
        ));
    }
    Ok(ObservedOrder::of(&errors))
}

#[test]
fn time_dependent_systems_keep_the_order() -> Result<(), Error> {
    let end = 7.0;
    let breathing = integrate(Gauss8, Breathing, &point(1.0, 0.0), end, 0.05)?;
    let finer = integrate(Gauss8, Breathing, &point(1.0, 0.0), end, 0.025)?;
    // Order 16 is down to rounding, far below the errors of order 4 with 512 steps, 1e-10.
    assert!(position_error(&breathing, &finer) < 1e-13);
    for (name, order, expected) in [
        (
            "Euler, driven",
            order(SymplecticEuler, Driven, &driven(end))?,
            1.0,
        ),
        (
            "Verlet, driven",
            order(StoermerVerlet, Driven, &driven(end))?,
            2.0,
        ),
        (
            "Verlet, breathing",
            order(StoermerVerlet, Breathing, &breathing)?,
            2.0,
        ),
        (
            "Lobatto 3, driven",
            order(Lobatto3, Driven, &driven(end))?,
            4.0,
        ),
        (
            "Lobatto 3, breathing",
            order(Lobatto3, Breathing, &breathing)?,
            4.0,
        ),
    ] {
        assert!(order.shows(expected, 0.1), "{name}: {order}");
    }
    Ok(())
}
