//! Runs of rigid bodies and of Lagrangians that are interrupted.

use core::cell::Cell;
use core::fmt::Debug;
use std::rc::Rc;

use symplectic::constraints::Gradients;
use symplectic::nalgebra::{DVector, SVector, Vector2};
use symplectic::rotation::{FreeBody, HeavyTop, RotationState, RotationSteps};
use symplectic::stepper::{Equal, Stepper};
use symplectic::system::Lagrangian;
use symplectic::variational::{
    DiracRule, DiracSteps, DiracSystem, DiscreteLagrangian, EnergyMomentumSteps, LagrangianSteps,
    VariationalSteps,
};
use symplectic::{Checkpoint, CheckpointError, Retry, Run, Scalar, State};

use crate::dirac::{Vortices, vortices_start};
use crate::discrete_lagrangians::{AtOnePoint, Jump6, ShakenLagrangian, Trapezoid};
use crate::lagrangians::{self, Particle, near_perihelion};
use crate::methods::{Gauss2, Gauss3, TwoOfThree};
use crate::rolling::{Disk, disk_start};
use crate::rotation::{LOPSIDED, Suzuki4, start as top_start};

/// A stepper, and how its runs are saved and restored.
trait Saved: Stepper<State: PartialEq + Debug> + Sized {
    fn saved(run: &mut Run<Self>) -> Checkpoint;
    fn restore(run: &mut Run<Self>, checkpoint: &Checkpoint) -> Result<(), CheckpointError>;
}

macro_rules! saved {
    ($($stepper:ty),*) => {$(
        impl Saved for $stepper {
            fn saved(run: &mut Run<Self>) -> Checkpoint {
                run.checkpoint().expect("doubles")
            }

            fn restore(run: &mut Run<Self>, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
                run.restore(checkpoint)
            }
        }
    )*};
}

saved! {
    RotationSteps<HeavyTop>, RotationSteps<FreeBody>, VariationalSteps<Trapezoid>, VariationalSteps<AtOnePoint>,
    VariationalSteps<ShakenLagrangian>, VariationalSteps<Weighted>, EnergyMomentumSteps<Trapezoid>, LagrangianSteps<Particle>,
    LagrangianSteps<lagrangians::Vortices>, DiracSteps<Vortices>, DiracSteps<Disk>, DiracSteps<Rail>
}

/// Runs with steps of a size that are saved after any numbers of steps, restored elsewhere, and taken on beside the one that was not
/// interrupted.
fn restarts<S: Saved>(name: &str, make: impl Fn(f64) -> Run<S>) {
    let mut whole = make(0.1);
    let goes_on = |whole: &mut Run<S>| {
        let saved = S::saved(whole);
        assert_eq!(saved, S::saved(whole), "{name}");
        let mut resumed = make(0.05);
        // It has steps of its own.
        resumed.take_steps(4).expect(name);
        S::restore(&mut resumed, &saved).expect(name);
        assert_eq!(S::saved(&mut resumed), saved, "{name}");
        for steps in [1, 6] {
            assert_eq!(
                resumed.take_steps(steps).expect(name),
                whole.take_steps(steps).expect(name),
                "{name}"
            );
            assert_eq!(resumed.statistics(), whole.statistics(), "{name}");
            assert_eq!(resumed.step_size(), whole.step_size(), "{name}");
            assert_eq!(S::saved(&mut resumed), S::saved(whole), "{name}");
        }
        resumed
    };
    let start = whole.state().clone();
    for steps in [0, 1, 3, 17] {
        whole.take_steps(steps).expect(name);
        goes_on(&mut whole);
    }
    whole.set_state(start.clone()).expect(name);
    let mut resumed = goes_on(&mut whole);
    // A new state is that of a new run, there too.
    for run in [&mut whole, &mut resumed] {
        run.set_state(start.clone()).expect(name);
    }
    let expected = whole.take_steps(3).expect(name);
    assert_eq!(resumed.take_steps(3).expect(name), expected, "{name}");
}

/// [`restarts`], also after a step that was shortened to end at a given time, with another size, and in parts.
fn equal_steps_restart<S: Saved + Stepper<Pace = Equal>>(name: &str, make: impl Fn(f64) -> Run<S>) {
    restarts(name, &make);
    let mut whole = make(0.1);
    whole.integrate_to(0.73).expect(name);
    whole.set_step_size(0.07).expect(name);
    whole.set_retry(Retry::Split { halvings: 2 });
    whole.integrate_to(1.0).expect(name);
    let mut resumed = make(0.05);
    S::restore(&mut resumed, &S::saved(&mut whole)).expect(name);
    assert_eq!(
        resumed.integrate_to(1.77).expect(name),
        whole.integrate_to(1.77).expect(name),
        "{name}"
    );
    assert_eq!(S::saved(&mut resumed), S::saved(&mut whole), "{name}");
}

/// [`AtOnePoint`] at the middle, times a weight.
#[derive(Clone, Copy)]
struct Weighted(f64);

impl DiscreteLagrangian for Weighted {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn value<T: Scalar>(&self, time: T, h: T, q0: &SVector<T, 2>, q1: &SVector<T, 2>) -> T {
        AtOnePoint(0.5).value(time, h, q0, q1) * T::from_f64(self.0)
    }
}

/// A particle in the plane that moves along this slope.
#[derive(Clone, Copy)]
struct Rail(f64);

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
        rows.set(0, 0, T::from_f64(self.0));
        rows.set(0, 1, -T::one());
    }
}

/// At rest: the constraint alone tells one slope from another.
fn rail(slope: f64) -> Run<DiracSteps<Rail>> {
    let start = State::from_arrays(0.0, [0.0, 0.0], [0.0, 0.0]);
    DiracSteps::run(DiracRule::Midpoint, Rail(slope), start, 0.1).expect("a run")
}

fn top(body: HeavyTop, size: f64) -> Run<RotationSteps<HeavyTop>> {
    RotationSteps::run(body, top_start(), size).expect("a run")
}

fn weighted(weight: f64) -> Run<VariationalSteps<Weighted>> {
    VariationalSteps::run(Weighted(weight), near_perihelion(), 0.1).expect("a run")
}

fn particle(friction: f64, size: f64) -> Run<LagrangianSteps<Particle>> {
    LagrangianSteps::run(Gauss2, Particle { friction }, near_perihelion(), size).expect("a run")
}

fn vortices(rule: DiracRule, size: f64) -> Run<DiracSteps<Vortices>> {
    DiracSteps::run(rule, Vortices, vortices_start(), size).expect("a run")
}

fn kepler(size: f64) -> Run<VariationalSteps<Trapezoid>> {
    VariationalSteps::run(Trapezoid, near_perihelion(), size).expect("a run")
}

fn of_equal_energy(size: f64) -> Run<EnergyMomentumSteps<Trapezoid>> {
    let start = State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.1]);
    EnergyMomentumSteps::run(Trapezoid, start, size).expect("a run")
}

#[test]
fn every_interrupted_run_goes_on_with_the_same_bits() {
    equal_steps_restart("top", |size| top(LOPSIDED, size));
    equal_steps_restart("top, order 4", |size| {
        RotationSteps::composed(Suzuki4, LOPSIDED, top_start(), size).expect("a run")
    });
    equal_steps_restart("discrete Lagrangian", kepler);
    equal_steps_restart("composed", |size| {
        VariationalSteps::composed(Suzuki4, Trapezoid, near_perihelion(), size).expect("a run")
    });
    equal_steps_restart("discrete Lagrangian that depends on time", |size| {
        let [q, p] = [0.4, 0.9].map(|x| DVector::from_element(1, x));
        VariationalSteps::run(ShakenLagrangian, State::new(0.0, q, p), size).expect("a run")
    });
    restarts("energy and momentum", of_equal_energy);
    equal_steps_restart("Lagrangian", |size| particle(0.02, size));
    equal_steps_restart("Galerkin", |size| {
        let system = Particle { friction: 0.0 };
        LagrangianSteps::galerkin(TwoOfThree, system, near_perihelion(), size).expect("a run")
    });
    equal_steps_restart("from a velocity", |size| {
        let (q, v) = (Vector2::new(2.0, 0.0), Vector2::new(0.1, 0.6));
        let system = Particle { friction: 0.0 };
        LagrangianSteps::from_velocity(Gauss3, system, 0.0, q, v, size).expect("a run")
    });
    equal_steps_restart("linear in the velocities", |size| {
        let q = SVector::from([1.0, 0.3, -0.5, -0.2]);
        let (system, v) = (lagrangians::Vortices, SVector::zeros());
        LagrangianSteps::from_velocity(Gauss2, system, 0.0, q, v, size).expect("a run")
    });
    equal_steps_restart("vortices", |size| vortices(DiracRule::Midpoint, size));
    equal_steps_restart("rolling", |size| {
        DiracSteps::run(DiracRule::Trapezoid, Disk, disk_start(), size).expect("a run")
    });
}

/// The error of a run that is given the checkpoint of another one, and stays as it is.
fn refused<S: Saved, T: Saved>(mut run: Run<S>, mut other: Run<T>) -> CheckpointError {
    run.take_steps(2).expect("two steps");
    let before = S::saved(&mut run);
    let error = S::restore(&mut run, &T::saved(&mut other)).expect_err("another run");
    assert_eq!(S::saved(&mut run), before);
    assert_eq!(run.steps(), 2);
    error
}

/// What differs.
fn other<S: Saved, T: Saved>(run: Run<S>, of: Run<T>) -> &'static str {
    match refused(run, of) {
        CheckpointError::OtherRun { what, .. } => what,
        error => panic!("{error}"),
    }
}

/// A free particle; its Lagrangian has another constant in every evaluation.
#[derive(Clone)]
struct Unrepeatable(Rc<Cell<f64>>);

impl DiscreteLagrangian for Unrepeatable {
    type Vector<T: Scalar> = Vector2<T>;

    fn value<T: Scalar>(&self, _time: T, h: T, q0: &Vector2<T>, q1: &Vector2<T>) -> T {
        let way = q1 - q0;
        let constant = self.0.replace(self.0.get() + 1.0);
        way.dot(&way) / h * T::from_f64(0.5) + T::from_f64(constant)
    }
}

#[test]
fn a_checkpoint_of_other_steps_is_refused_as_such_by_a_system_that_does_not_repeat_its_values()
-> Result<(), Box<dyn std::error::Error>> {
    let system = Unrepeatable(Rc::new(Cell::new(0.0)));
    let start = State::from_arrays(0.0, [0.0, 0.0], [1.0, 2.0]);
    let mut run = VariationalSteps::run(system, start, 0.5)?;
    let error = run.restore(&of_equal_energy(0.1).checkpoint()?);
    assert!(matches!(error, Err(CheckpointError::OtherRun { .. })));
    let checkpoint = run.checkpoint()?;
    assert_eq!(run.restore(&checkpoint), Err(CheckpointError::OtherSystem));
    Ok(())
}

#[test]
fn checkpoints_of_other_steps_are_refused() {
    assert_eq!(other(kepler(0.1), of_equal_energy(0.1)), "method");
    assert_eq!(other(of_equal_energy(0.1), kepler(0.1)), "method");
    assert_eq!(other(top(LOPSIDED, 0.1), kepler(0.1)), "method");
    assert_eq!(
        other(vortices(DiracRule::Midpoint, 0.1), kepler(0.1)),
        "method"
    );
    assert_eq!(
        other(particle(0.0, 0.1), vortices(DiracRule::Midpoint, 0.1)),
        "method"
    );
    let galerkin = || {
        let system = Particle { friction: 0.0 };
        LagrangianSteps::galerkin(TwoOfThree, system, near_perihelion(), 0.1).expect("a run")
    };
    let rectangular = || {
        let system = Particle { friction: 0.0 };
        LagrangianSteps::run(TwoOfThree, system, near_perihelion(), 0.1).expect("a run")
    };
    assert_eq!(other(particle(0.0, 0.1), rectangular()), "method");
    assert_eq!(other(galerkin(), rectangular()), "method");
    let composed = |order| {
        let start = near_perihelion();
        let run = match order {
            4 => VariationalSteps::composed(Suzuki4, Trapezoid, start, 0.1),
            _ => VariationalSteps::composed(Jump6, Trapezoid, start, 0.1),
        };
        run.expect("a run")
    };
    assert_eq!(other(kepler(0.1), composed(4)), "definition");
    assert_eq!(other(composed(6), composed(4)), "definition");
    let words = "the definition of the checkpoint is `single steps`, that of this integrator `composed steps: 1.58";
    assert!(
        refused(composed(6), kepler(0.1))
            .to_string()
            .starts_with(words)
    );
    let top_of_order_4 = || RotationSteps::composed(Suzuki4, LOPSIDED, top_start(), 0.1);
    assert_eq!(
        other(top(LOPSIDED, 0.1), top_of_order_4().expect("a run")),
        "definition"
    );
    let (midpoint, trapezoid) = (DiracRule::Midpoint, DiracRule::Trapezoid);
    assert_eq!(
        other(vortices(midpoint, 0.1), vortices(trapezoid, 0.1)),
        "definition"
    );
    let disk = DiracSteps::run(midpoint, Disk, disk_start(), 0.1).expect("a run");
    assert_eq!(other(vortices(midpoint, 0.1), disk), "dimension");
    let [q, p] = [0.4, 0.9].map(|x| DVector::from_element(1, x));
    let shaken = VariationalSteps::run(ShakenLagrangian, State::new(0.0, q, p), 0.1);
    assert_eq!(other(kepler(0.1), shaken.expect("a run")), "dimension");
}

#[test]
fn checkpoints_of_other_systems_are_refused() {
    let heavier = HeavyTop {
        weight: 1.5,
        ..LOPSIDED
    };
    assert_eq!(
        refused(top(LOPSIDED, 0.1), top(heavier, 0.1)),
        CheckpointError::OtherSystem
    );
    let free = |third| {
        let body = FreeBody::new(1.0, 1.4, third);
        RotationSteps::run(
            body,
            RotationState::new(0.0, top_start().attitude, top_start().momentum),
            0.1,
        )
        .expect("a run")
    };
    assert_eq!(refused(free(0.8), free(0.9)), CheckpointError::OtherSystem);
    assert_eq!(refused(rail(1.0), rail(1.5)), CheckpointError::OtherSystem);
    assert_eq!(
        refused(weighted(1.0), weighted(1.5)),
        CheckpointError::OtherSystem
    );
    assert_eq!(
        refused(particle(0.0, 0.1), particle(0.1, 0.1)),
        CheckpointError::OtherSystem
    );
}

#[cfg(feature = "serde")]
#[test]
fn a_checkpoint_of_a_lagrangian_is_written_and_read() -> Result<(), Box<dyn core::error::Error>> {
    let (mut run, mut resumed) = (particle(0.0, 0.1), particle(0.0, 0.1));
    run.take_steps(9)?;
    let text = serde_json::to_string(&run.checkpoint()?)?;
    resumed.restore(&serde_json::from_str(&text)?)?;
    assert_eq!(resumed.take_steps(9)?, run.take_steps(9)?);
    Ok(())
}
