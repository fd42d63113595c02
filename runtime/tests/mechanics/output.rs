//! What is seen of runs of Lagrangians between their steps, and that it changes no step.

use core::cell::Cell;
use core::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::rc::Rc;

use symplectic::constraints::Gradients;
use symplectic::nalgebra::{SVector, Vector1, Vector2};
use symplectic::output::Moment;
use symplectic::stepper::DenseSteps;
use symplectic::system::Lagrangian;
use symplectic::variational::{
    DiracRule, DiracSteps, DiracSystem, DiscreteLagrangian, EnergyMomentumSteps, Error,
    LagrangianSteps, VariationalSteps,
};
use symplectic::{Error as CoreError, Event, Integrator, Retry, Run, Scalar, State, Vector};

use crate::circuits::{Circuit, circuit_exact, circuit_start};
use crate::dirac::{CanonicalVortices, Suzuki4, Vortices, assert_order, distance, vortices_start};
use crate::discrete_lagrangians::{Kepler, Trapezoid};
use crate::lagrangians::{Particle, Relativistic, near_perihelion};
use crate::methods::{Gauss3, Gauss6, TwoOfThree};

type Plane = State<Vector2<f64>>;

const LINEAR: Circuit = Circuit { beta: 0.0 };

fn apart<V: Vector<Scalar = f64>>(a: &State<V>, b: &State<V>) -> f64 {
    let ((q, p), (r, s)) = (a.as_slices(), b.as_slices());
    distance(q, r).max(distance(p, s))
}

/// The largest distance from the exact states at times in the first step, inside another one and at the end of a step.
fn error<S, V, E>(made: Result<Run<S>, E>, exact: impl Fn(f64) -> State<V>) -> f64
where
    S: DenseSteps<Vector = V>,
    V: Vector<Scalar = f64>,
    E: core::fmt::Debug,
{
    let (mut run, mut worst) = (made.expect("a run"), 0.0_f64);
    run.integrate_at(&[0.001, 0.54321, 0.98765, 1.0], |state| {
        worst = worst.max(apart(state, &exact(state.time)));
    })
    .expect("states");
    worst
}

#[test]
fn states_inside_steps_have_the_order_of_the_method() {
    let start = near_perihelion;
    let of_kepler = |time: f64| -> Plane {
        let run = Integrator::new(Gauss6, Kepler, start(), 0.05);
        run.and_then(|mut run| run.integrate_to(time).cloned())
            .expect("steps")
    };
    assert_order(2.0, 20, |size| {
        error(VariationalSteps::run(Trapezoid, start(), size), of_kepler)
    });
    assert_order(4.0, 10, |size| {
        let run = VariationalSteps::composed(Suzuki4, Trapezoid, start(), size);
        error(run, of_kepler)
    });
    let of_particle = |friction| {
        move |time: f64| -> Plane {
            let run = Integrator::new(Gauss6, Relativistic { friction }, start(), 0.05);
            run.and_then(|mut run| run.integrate_to(time).cloned())
                .expect("steps")
        }
    };
    assert_order(6.0, 2, |size| {
        let run = LagrangianSteps::run(Gauss3, Particle { friction: 0.1 }, start(), size);
        error(run, of_particle(0.1))
    });
    assert_order(4.0, 4, |size| {
        let run = LagrangianSteps::galerkin(TwoOfThree, Particle { friction: 0.0 }, start(), size);
        error(run, of_particle(0.0))
    });
    let of_vortices = |time: f64| {
        let State { q, .. } = vortices_start();
        let [y, x] = [3, 0].map(|k| SVector::from([q[k], q[k + 1], q[k + 2]]));
        let run = Integrator::new(Gauss6, CanonicalVortices, State::new(0.0, y, x), 0.05);
        let end = run.and_then(|mut run| run.integrate_to(time).cloned());
        let State { q: y, p: x, .. } = end.expect("steps");
        let q = SVector::from([x[0], x[1], x[2], y[0], y[1], y[2]]);
        let p = SVector::from([-y[0], -y[1], -y[2], x[0], x[1], x[2]]) / 2.0;
        State::new(time, q, p)
    };
    assert_order(2.0, 20, |size| {
        let run = DiracSteps::run(DiracRule::Midpoint, Vortices, vortices_start(), size);
        error(run, of_vortices)
    });
    assert_order(2.0, 20, |size| {
        let run = DiracSteps::run(DiracRule::Trapezoid, LINEAR, circuit_start(LINEAR), size);
        error(run, circuit_exact)
    });
}

/// Looks into every step leave everything that the next steps depend on as it is.
#[test]
fn a_run_that_is_looked_at_takes_the_same_steps() -> Result<(), Box<dyn std::error::Error>> {
    macro_rules! each {
        ($($run:expr;)*) => {$(
            let (mut plain, mut seen) = ($run?, $run?);
            let event = Event::crossing(|state: &State<_>| (7.0 * state.time).sin()).samples(4).by_steps();
            let times: Vec<_> = (0..60).map(|k| 0.033 * f64::from(k)).collect();
            let end = 2.0;
            seen.integrate_through(end, &times, &event, |_| ControlFlow::<()>::Continue(()))?;
            while plain.state().time < seen.state().time {
                plain.step()?;
            }
            let beside = seen.state().time - 0.01;
            let states = [seen.state_at(beside)?, seen.state_at(beside)?];
            assert_eq!(states[0], states[1]);
            assert_eq!(seen.state(), plain.state());
            assert_eq!(seen.statistics(), plain.statistics());
            assert_eq!(seen.clone().take_steps(3)?, plain.clone().take_steps(3)?);
            // A restored run knows its last step, too.
            let mut restored = $run?;
            restored.restore(&plain.checkpoint()?)?;
            assert_eq!(restored.state_at(beside)?, states[0]);
            assert_eq!(plain.state_at(beside)?, states[0]);
        )*};
    }
    let start = near_perihelion;
    let particle = Particle { friction: 0.02 };
    each! {
        VariationalSteps::composed(Suzuki4, Trapezoid, start(), 0.125);
        LagrangianSteps::run(Gauss3, particle, start(), 0.125);
        DiracSteps::run(DiracRule::Midpoint, Vortices, vortices_start(), 0.125);
        DiracSteps::run(DiracRule::Trapezoid, LINEAR, circuit_start(LINEAR), 0.125);
        EnergyMomentumSteps::run(Trapezoid, State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.1]), 0.05);
    }
    Ok(())
}

/// The same of steps that are too long and are taken in parts.
#[test]
fn a_run_whose_steps_are_split_takes_the_same_steps_when_it_is_looked_at() -> Result<(), Error> {
    let make =
        |size| LagrangianSteps::run(Gauss3, Particle { friction: 0.0 }, near_perihelion(), size);
    // Only a step after others begins elsewhere than a first step.
    let fails = |&size: &f64| {
        let run = make(size);
        run.is_ok_and(|mut run| run.step().is_ok() && run.take_steps(19).is_err())
    };
    let sizes = (16..100).map(|k| 0.125 * f64::from(k));
    let sizes: Vec<_> = sizes.filter(fails).take(4).collect();
    assert_eq!(sizes.len(), 4);
    for size in sizes {
        let [mut plain, mut seen] = [make(size)?, make(size)?];
        plain.set_retry(Retry::Split { halvings: 12 });
        seen.set_retry(Retry::Split { halvings: 12 });
        let times: Vec<_> = (0..30).map(|k| 0.7 * size * f64::from(k)).collect();
        seen.integrate_at(&times, |_| {})?;
        while plain.state().time < seen.state().time {
            plain.step()?;
        }
        assert!(plain.statistics().rejected > 0);
        assert_eq!(seen.state(), plain.state());
        assert_eq!(seen.statistics(), plain.statistics());
    }
    Ok(())
}

/// A particle whose Lagrangian panics when it is told to.
#[derive(Clone)]
struct Panicking(Rc<Cell<bool>>);

impl DiscreteLagrangian for Panicking {
    type Vector<T: Scalar> = Vector1<T>;

    fn value<T: Scalar>(&self, _time: T, h: T, q0: &Vector1<T>, q1: &Vector1<T>) -> T {
        assert!(!self.0.get(), "as told");
        let way = q1[0] - q0[0];
        way * way / h * T::from_f64(0.5)
    }
}

#[test]
fn a_look_in_which_the_system_panics_leaves_the_run_as_it_was() -> Result<(), Error> {
    let panics = Rc::new(Cell::new(false));
    let start = State::from_arrays(0.0, [0.0], [1.0]);
    let mut run = VariationalSteps::run(Panicking(panics.clone()), start, 0.5)?;
    run.take_steps(3)?;
    let before = run.checkpoint();
    panics.set(true);
    let look = catch_unwind(AssertUnwindSafe(|| run.state_at(1.25).is_ok()));
    assert!(look.is_err());
    panics.set(false);
    assert_eq!(run.checkpoint(), before);
    assert_eq!(run.state_at(1.25)?.q[0], 1.25);
    Ok(())
}

#[test]
fn slopes_at_a_new_state_of_a_dirac_system_are_those_of_a_new_run() -> Result<(), Error> {
    let circuit = Circuit { beta: 0.5 };
    let make = || DiracSteps::run(DiracRule::Trapezoid, circuit, circuit_start(circuit), 0.125);
    let (mut new, mut used) = (make()?, make()?);
    used.take_steps(5)?;
    used.set_state(circuit_start(circuit))?;
    let slopes = |run: &mut Run<DiracSteps<Circuit>>| {
        let (state, zero) = (run.state().clone(), run.state().q * 0.0);
        let [mut velocity, mut force] = [zero, zero];
        let stepper = run.stepper_mut();
        stepper.slopes(&state, 1e-3, &mut velocity, &mut force);
        (velocity, force)
    };
    assert_eq!(slopes(&mut used), slopes(&mut new));
    Ok(())
}

/// L = v²/2 − q, which all these methods integrate exactly.
#[derive(Clone, Copy)]
struct Ball;

impl Lagrangian for Ball {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &SVector<T, 1>, v: &SVector<T, 1>) -> T {
        v[0] * v[0] * T::from_f64(0.5) - q[0]
    }
}

impl DiracSystem for Ball {}

impl DiscreteLagrangian for Ball {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn value<T: Scalar>(&self, time: T, h: T, q0: &SVector<T, 1>, q1: &SVector<T, 1>) -> T {
        self.lagrangian(time, &((q0 + q1) * T::from_f64(0.5)), &((q1 - q0) / h)) * h
    }
}

/// A ball that is thrown up from the floor lands there, at first within a step.
fn bounces<S: DenseSteps<Vector = Vector1<f64>>>(
    made: impl Fn(State<Vector1<f64>>) -> Result<Run<S>, Error>,
) -> Result<(), S::Error> {
    let mut run = made(State::from_arrays(0.0, [0.0], [0.025])).expect("a run");
    let floor = Event::wall(|state: &State<Vector1<f64>>| state.q[0]);
    let top = Event::falling(|state: &State<Vector1<f64>>| state.p[0]);
    let (mut impacts, mut tops) = (Vec::new(), Vec::new());
    run.integrate_through(3.9, &[], &(floor, top), |moment| {
        match moment {
            Moment::Event { index: 0, state } => {
                impacts.push(state.time);
                state.p[0] *= -2.0;
            }
            Moment::Event { state, .. } => tops.push(state.q[0]),
            Moment::Output(_) => {}
        }
        ControlFlow::<()>::Continue(())
    })?;
    let expected: Vec<f64> = (1..=6).map(|k| 0.05 * f64::from((1 << k) - 1)).collect();
    assert!(distance(&impacts, &expected) < 1e-11, "{impacts:?}");
    assert_eq!(impacts.len(), 6);
    let expected: Vec<f64> = (0..6)
        .map(|k| 0.025_f64.powi(2) / 2.0 * f64::from(1 << (2 * k)))
        .collect();
    assert!(distance(&tops, &expected) < 1e-12, "{tops:?}");
    Ok(())
}

#[test]
fn a_ball_bounces_off_a_wall_by_every_lagrangian() -> Result<(), Error> {
    let h = 0.1;
    bounces(|start| VariationalSteps::run(Ball, start, h))?;
    bounces(|start| LagrangianSteps::run(Gauss3, Ball, start, h))?;
    bounces(|start| DiracSteps::run(DiracRule::Midpoint, Ball, start, h))
}

/// The ball is back where it was thrown: Newton's iteration has no length for its last change.
#[test]
fn a_step_that_ends_where_it_began_is_taken() -> Result<(), Error> {
    let start = || State::from_arrays(0.0, [0.0], [0.025]);
    let mut run = VariationalSteps::run(Ball, start(), 0.05)?;
    let mut of_equal_energy = EnergyMomentumSteps::run(Ball, start(), 0.05)?;
    for end in [run.step()?, of_equal_energy.step()?] {
        assert!(end.q[0].abs() < 1e-17 && (end.p[0] + 0.025).abs() < 1e-17);
    }
    Ok(())
}

/// A bead on a rail: y' = x', for a Dirac system.
#[derive(Clone, Copy)]
struct Rail;

impl Lagrangian for Rail {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn lagrangian<T: Scalar>(&self, _: T, _: &SVector<T, 2>, v: &SVector<T, 2>) -> T {
        v.dot(v) * T::from_f64(0.5)
    }
}

impl DiracSystem for Rail {
    fn nonholonomic_constraints(&self) -> usize {
        1
    }

    fn nonholonomic_rows<T: Scalar>(&self, _: &SVector<T, 2>, rows: &mut Gradients<T>) {
        rows.set(0, 0, T::one());
        rows.set(0, 1, -T::one());
    }
}

#[test]
fn a_wall_off_the_constraints_is_an_error_of_the_new_start() -> Result<(), Error> {
    let start = || State::from_arrays(0.0, [0.0, 0.0], [1.0, 1.0]);
    let made = || DiracSteps::run(DiracRule::Trapezoid, Rail, start(), 0.1);
    let wall = Event::wall(|state: &Plane| 0.55 - state.q[0]);
    let (mut run, mut refused) = (made()?, made()?);
    run.integrate_through(1.0, &[], &wall, |moment| {
        if let Moment::Event { state, .. } = moment {
            state.p *= -1.0;
        }
        ControlFlow::<()>::Continue(())
    })?;
    assert!((run.state().q[1] - 0.1).abs() < 1e-12);
    let outcome = refused.integrate_through(1.0, &[], &wall, |moment| {
        if let Moment::Event { state, .. } = moment {
            state.p[0] *= -1.0;
        }
        ControlFlow::<()>::Continue(())
    });
    assert!(matches!(
        outcome,
        Err(Error::Core(CoreError::InconsistentVelocity { .. }))
    ));
    assert!((refused.state().time - 0.55).abs() < 1e-12);
    Ok(())
}

#[test]
fn a_run_of_equal_energy_reaches_a_given_time() -> Result<(), Error> {
    let start = || State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.1]);
    let made = || EnergyMomentumSteps::run(Trapezoid, start(), 0.05);
    let (mut run, mut plain) = (made()?, made()?);
    let end = run.integrate_to(1.0)?;
    assert_eq!(end.time, 1.0);
    plain.take_steps(run.steps())?;
    assert_eq!(run.state(), plain.state());
    assert_eq!(run.step_size(), plain.step_size());
    let (start, present) = run.stepper().last_span().expect("a step");
    assert!(start < 1.0 && 1.0 < present);
    let exact = Integrator::new(Gauss6, Kepler, self::start(), 0.05)?
        .integrate_to(1.0)?
        .clone();
    assert!(apart(&end, &exact) < 1e-3);
    Ok(())
}

fn start() -> Plane {
    State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.1])
}

/// A free particle, until the time 0.1.
#[derive(Clone, Copy)]
struct Ending;

impl DiscreteLagrangian for Ending {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn value<T: Scalar>(&self, time: T, h: T, q0: &SVector<T, 1>, q1: &SVector<T, 1>) -> T {
        let way = q1[0] - q0[0];
        way * way * T::from_f64(0.5) / h + (T::from_f64(0.1) - time).sqrt()
    }
}

#[test]
fn there_is_no_look_before_a_step_or_outside_of_it() -> Result<(), Error> {
    let mut run = VariationalSteps::run(Trapezoid, start(), 0.125)?;
    let none = Err(Error::Core(CoreError::NoStep));
    assert_eq!(run.state_at(0.0), none);
    run.take_steps(2)?;
    assert_eq!(run.state_at(0.25)?, *run.state());
    assert!(matches!(
        run.state_at(0.1),
        Err(Error::Core(CoreError::OutsideStep {
            time: 0.1,
            start: 0.125,
            end: 0.25
        }))
    ));
    run.set_state(start())?;
    assert_eq!(run.state_at(0.0), none);
    // After a step that fails.
    let mut run = VariationalSteps::run(Ending, State::from_arrays(0.0, [1.0], [1.0]), 0.125)?;
    run.step()?;
    run.state_at(0.1)?;
    run.step().expect_err("time is over");
    assert_eq!(run.state_at(0.1), Err(Error::Core(CoreError::NoStep)));
    Ok(())
}
