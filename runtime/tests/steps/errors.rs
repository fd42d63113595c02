//! Every error, with the state untouched and the way on.

use std::cell::Cell;
use std::marker::PhantomData;

use crate::common;
use crate::common::systems::{Pendulum, Product, point};

use crate::common::methods::{Gauss2, Lobatto3, Midpoint, StoermerVerlet};
use symplectic::nalgebra::{DVector, Vector1};
use symplectic::solver::{ByNewton, FixedPoint, FixedPointThenNewton};
use symplectic::system::Class;
use symplectic::variational::{self, StepWithStages};
use symplectic::{
    Error, General, Integrator, Method, ProvedFor, Quantity, Separable, State, System, Vector,
    acceleration, hamiltonian, separable,
};

type Point = Vector1<f64>;

symplectic::tableau! { Rattle { base: lobatto-2 } }

symplectic::hamiltonian! {
    /// A point on a circle.
    Rotor q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2
    constraints: { rod = x^2 + y^2 - 1 }
}

/// A damped oscillator, by hand.
struct Declared<const FORCED: bool, C>(PhantomData<C>);

impl<const FORCED: bool, C: Class> System<Point> for Declared<FORCED, C> {
    type Class = C;
    type Solver = FixedPoint;

    const FORCED: bool = FORCED;

    fn velocity(&self, _: f64, _: &Point, p: &Point, velocity: &mut Point) {
        *velocity = *p;
    }

    fn force(&self, _: f64, q: &Point, p: &Point, force: &mut Point) {
        *force = -q - p;
    }

    fn applied_force(&self, _: f64, _: &Point, p: &Point, applied: &mut Point) {
        *applied = -p;
    }
}

#[test]
fn false_declarations_are_refused() {
    let start = || State::from_arrays(0.0, [1.0], [0.5]);
    let separable = Declared::<true, Separable>(PhantomData);
    let error = Integrator::new(Gauss2, separable, start(), 0.1).err();
    let (what, component) = (Quantity::Force, 0);
    assert_eq!(error, Some(Error::NotSeparable { what, component }));
    let silent = Declared::<false, General>(PhantomData);
    let error = Integrator::new(Gauss2, silent, start(), 0.1).err();
    assert_eq!(error, Some(Error::NotForced { component }));
    let right = Declared::<true, General>(PhantomData);
    assert!(Integrator::new(Gauss2, right, start(), 0.1).is_ok());
}

/// Fails once, checks that nothing changed, then steps on and compares with one that never failed.
fn assert_recovers<M, S, V>(
    method: M,
    system: impl Fn(bool) -> S,
    heal: impl Fn(&S),
    start: &State<V>,
) -> Error
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<V>,
    V: Vector,
{
    let mut good = Integrator::new(method, system(true), start.clone(), 0.1).expect("good");
    let mut bad = Integrator::new(method, system(false), start.clone(), 0.1).expect("good");
    let error = bad.step().expect_err("the system is broken");
    assert_eq!(bad.state(), start);
    assert_eq!((bad.steps(), bad.iterations()), (0, 0));
    heal(bad.system());
    for _ in 0..3 {
        assert_eq!(bad.step().expect("healed"), good.step().expect("good"));
    }
    error
}

#[test]
fn step_sizes_that_are_zero_or_not_finite_are_refused() -> Result<(), Error> {
    for value in [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = Integrator::new(StoermerVerlet, Product, point(1.0, 0.0), value)
            .expect_err("no step size");
        assert!(matches!(error, Error::StepSize { value: v } if v.to_bits() == value.to_bits()));
        let mut integrator = Integrator::new(StoermerVerlet, Product, point(1.0, 0.0), 0.1)?;
        assert!(integrator.set_step_size(value).is_err());
        assert_eq!(integrator.step_size(), 0.1);
    }
    Ok(())
}

#[test]
fn states_of_wrong_dimension_or_not_finite_are_refused() -> Result<(), Error> {
    let dynamic = |q: &[f64], p: &[f64]| {
        let state = State::new(0.0, DVector::from_row_slice(q), DVector::from_row_slice(p));
        Integrator::new(StoermerVerlet, Pendulum::default(), state, 0.1)
    };
    let dimension = |position, momentum| Error::Dimension { position, momentum };
    assert_eq!(
        dynamic(&[1.0, 2.0], &[0.0]).expect_err("differ"),
        dimension(2, 1)
    );

    let mut integrator = dynamic(&[1.0, 2.0], &[0.0, 0.0])?;
    let before = integrator.state().clone();
    let three = State::new(0.0, DVector::zeros(3), DVector::zeros(3));
    assert_eq!(integrator.set_state(three), Err(dimension(3, 3)));
    assert_eq!(integrator.state(), &before);

    let non_finite = |what| Error::NonFiniteState { what };
    for (state, what) in [
        (point(f64::NAN, 0.0), Quantity::Position),
        (point(0.0, f64::INFINITY), Quantity::Momentum),
        (
            State {
                time: f64::NAN,
                ..point(0.0, 0.0)
            },
            Quantity::Time,
        ),
    ] {
        let error = Integrator::new(Midpoint, Product, state.clone(), 0.1).expect_err("not finite");
        assert_eq!(error, non_finite(what));
        let mut integrator = Integrator::new(Midpoint, Product, point(1.0, 0.0), 0.1)?;
        assert_eq!(integrator.set_state(state), Err(non_finite(what)));
        assert_eq!(integrator.state(), &point(1.0, 0.0));
    }
    Ok(())
}

#[test]
fn divergence_is_reported_and_harmless() -> Result<(), Error> {
    // hω = 20: the fixed-point iteration for the midpoint grows by a factor of (hω/2)² = 100 a sweep.
    let stiff = separable::<Point, _, _>(
        |_, p, velocity| *velocity = *p,
        |_, q, force| force[0] = -40_000.0 * q[0],
    );
    let mut integrator = Integrator::new(Midpoint, stiff, point(1.0, 0.0), 0.1)?;
    let error = integrator.step().expect_err("diverges");
    let Error::NoConvergence {
        time,
        step_size,
        step,
        residual,
        iterations,
        newton_may_help,
    } = error
    else {
        panic!("{error}");
    };
    assert!(newton_may_help);
    assert_eq!((time, step_size, step), (0.0, 0.1, 1));
    assert!(residual.is_finite() && residual > 0.1, "{residual}");
    assert!(iterations > 100 && iterations <= 200, "{iterations}");
    assert_eq!(integrator.state(), &point(1.0, 0.0));
    assert_eq!((integrator.steps(), integrator.iterations()), (0, 0));

    integrator.set_step_size(0.001)?;
    assert_eq!(integrator.step()?.time, 0.001);
    Ok(())
}

#[test]
fn one_half_at_rest_does_not_hide_the_divergence_of_the_other() -> Result<(), Error> {
    // H = 100 q p at q = 0: the positions never change, the momenta grow by a factor of 5 a sweep.
    let system = hamiltonian::<Point, _, _>(
        |_, q, _p, velocity| *velocity = 100.0 * q,
        |_, _q, p, force| *force = -100.0 * p,
    );
    let mut integrator = Integrator::new(Midpoint, system, point(0.0, 1.0), 0.1)?;
    let error = integrator.step().expect_err("diverges");
    assert!(
        matches!(
            error,
            Error::NoConvergence {
                iterations: 200,
                ..
            }
        ),
        "{error:?}"
    );
    integrator.set_step_size(0.001)?;
    integrator.step()?;
    Ok(())
}

#[test]
fn the_bound_on_iterations_holds() -> Result<(), Error> {
    let mut integrator = Integrator::new(Midpoint, Product, point(0.5, 0.3), 0.1)?;
    for (bound, expected) in [(3, 3), (0, 1)] {
        integrator.set_max_iterations(bound);
        let error = integrator.step().expect_err("too few");
        assert!(
            matches!(error, Error::NoConvergence { iterations, residual, .. }
                if iterations == expected && residual > 1e-9 && residual < 1.0),
            "{error:?}"
        );
    }
    integrator.set_max_iterations(100);
    integrator.step()?;
    assert!(integrator.iterations() > 3);
    Ok(())
}

#[test]
fn evaluations_that_are_not_finite_are_named() {
    struct Broken {
        good: Cell<bool>,
        what: Quantity,
    }
    impl Broken {
        fn factor(&self, what: Quantity) -> f64 {
            if self.good.get() || self.what != what {
                1.0
            } else {
                f64::NAN
            }
        }
    }
    struct Split(Broken);
    impl System<Point> for Split {
        type Class = Separable;
        type Solver = FixedPoint;

        fn velocity(&self, _time: f64, _q: &Point, p: &Point, velocity: &mut Point) {
            *velocity = p * self.0.factor(Quantity::Velocity);
        }
        fn force(&self, _time: f64, q: &Point, _p: &Point, force: &mut Point) {
            *force = -q * self.0.factor(Quantity::Force);
        }
    }
    struct Whole(Broken);
    impl System<Point> for Whole {
        type Class = General;
        type Solver = FixedPoint;
        fn velocity(&self, _time: f64, q: &Point, p: &Point, velocity: &mut Point) {
            *velocity = p * (1.0 + q[0] * q[0]) * self.0.factor(Quantity::Velocity);
        }
        fn force(&self, _time: f64, q: &Point, p: &Point, force: &mut Point) {
            *force = -q * (1.0 + p[0] * p[0]) * self.0.factor(Quantity::Force);
        }
    }
    for what in [Quantity::Velocity, Quantity::Force] {
        let broken = |good| Broken {
            good: Cell::new(good),
            what,
        };
        let start = point(0.5, 0.3);
        let (split, whole) = (|good| Split(broken(good)), |good| Whole(broken(good)));
        let heal_split = |system: &Split| system.0.good.set(true);
        let heal_whole = |system: &Whole| system.0.good.set(true);
        let expected = Error::NonFinite {
            time: 0.0,
            step_size: 0.1,
            step: 1,
            what,
            stage: Some(1),
        };
        assert_eq!(
            assert_recovers(StoermerVerlet, split, heal_split, &start),
            expected
        );
        assert_eq!(
            assert_recovers(Midpoint, split, heal_split, &start),
            expected
        );
        assert_eq!(
            assert_recovers(StoermerVerlet, whole, heal_whole, &start),
            expected
        );
        assert_eq!(
            assert_recovers(Midpoint, whole, heal_whole, &start),
            expected
        );
    }
}

#[test]
fn the_stage_of_a_late_evaluation_is_named() -> Result<(), Error> {
    let wall = separable::<Point, _, _>(
        |_, p, velocity| *velocity = *p,
        |_, q, force| force[0] = if q[0] > 0.45 { f64::NAN } else { 0.0 },
    );
    let mut integrator = Integrator::new(StoermerVerlet, wall, point(0.0, 1.0), 0.1)?;
    let error = integrator.integrate_to(1.0).expect_err("there is a wall");
    let what = Quantity::Force;
    assert_eq!(
        error,
        Error::NonFinite {
            time: 0.4,
            step_size: 0.1,
            step: 5,
            what,
            stage: Some(2)
        }
    );
    assert_eq!(integrator.state().time, 0.4);
    assert!((integrator.state().q[0] - 0.4).abs() < 1e-15);
    assert_eq!(integrator.step_size(), 0.1);
    // Back from the wall, with the force evaluated again.
    assert_eq!(integrator.integrate_to(0.0)?.time, 0.0);
    Ok(())
}

#[test]
fn a_result_that_overflows_is_named() -> Result<(), Error> {
    let fast = separable::<Point, _, _>(
        |_, _p, velocity| velocity[0] = f64::MAX,
        |_, _q, force| force[0] = 0.0,
    );
    let mut integrator = Integrator::new(StoermerVerlet, fast, point(0.0, 1.0), 4.0)?;
    let what = Quantity::Position;
    assert_eq!(
        integrator.step(),
        Err(Error::NonFinite {
            time: 0.0,
            step_size: 4.0,
            step: 1,
            what,
            stage: None
        })
    );
    assert_eq!(integrator.state(), &point(0.0, 1.0));
    Ok(())
}

#[test]
fn leaving_the_domain_while_iterating_is_reported_as_divergence() -> Result<(), Error> {
    // Finite at the start and at the first new stage value (0.5), not at the second (1).
    let system = hamiltonian::<Point, _, _>(
        |_, q, _p, velocity| {
            velocity[0] = if q[0] < 0.9 {
                1.0 + 2.0 * q[0]
            } else {
                f64::NAN
            }
        },
        |_, _q, _p, force| force[0] = 0.0,
    );
    let mut integrator = Integrator::new(Midpoint, system, point(0.0, 0.0), 1.0)?;
    let error = integrator.step().expect_err("runs out");
    assert!(
        matches!(
            error,
            Error::NoConvergence {
                residual: 0.5,
                iterations: 2,
                ..
            }
        ),
        "{error:?}"
    );
    Ok(())
}

#[test]
fn a_result_resized_by_the_system_is_an_error() {
    struct Resizing {
        good: Cell<bool>,
        to: usize,
    }
    impl System<DVector<f64>> for Resizing {
        type Class = Separable;
        type Solver = FixedPoint;

        fn velocity(
            &self,
            _time: f64,
            _q: &DVector<f64>,
            p: &DVector<f64>,
            velocity: &mut DVector<f64>,
        ) {
            velocity.copy_from(p);
        }
        fn force(&self, _time: f64, q: &DVector<f64>, _p: &DVector<f64>, force: &mut DVector<f64>) {
            if self.good.get() {
                force.copy_from(&-q);
            } else {
                *force = DVector::from_element(self.to, 1.0);
            }
        }
    }
    let start = State::new(0.0, DVector::from_element(2, 1.0), DVector::zeros(2));
    for to in [0, 1, 3] {
        let system = |good| Resizing {
            good: Cell::new(good),
            to,
        };
        let heal = |system: &Resizing| system.good.set(true);
        let expected = Error::EvaluationDimension {
            time: 0.0,
            step_size: 0.1,
            step: 1,
            what: Quantity::Force,
            stage: Some(1),
            expected: 2,
            found: to,
        };
        assert_eq!(
            assert_recovers(StoermerVerlet, system, heal, &start),
            expected
        );
        assert_eq!(assert_recovers(Midpoint, system, heal, &start), expected);
    }
}

#[test]
fn iteration_over_states_ends_with_the_error() -> Result<(), Error> {
    let wall = separable::<Point, _, _>(
        |_, p, velocity| *velocity = *p,
        |_, q, force| force[0] = if q[0] > 0.25 { f64::NAN } else { 0.0 },
    );
    let mut integrator = Integrator::new(StoermerVerlet, wall, point(0.0, 1.0), 0.1)?;
    let items: Vec<_> = integrator.states().take(10).collect();
    assert_eq!(items.len(), 3);
    assert!(items[0].is_ok() && items[1].is_ok() && items[2].is_err());
    Ok(())
}

#[test]
fn messages_name_the_cause_the_step_and_a_remedy() {
    let error = Error::NonFinite {
        time: 1.5,
        step_size: 0.1,
        step: 16,
        what: Quantity::Force,
        stage: Some(2),
    };
    assert_eq!(
        error.to_string(),
        "step 16 of size 0.1 at time 1.5: the force at stage 2 is not finite; take a smaller step, \
         or keep the state where the system is defined"
    );
    let message = |newton_may_help| {
        let error = Error::NoConvergence {
            time: 0.0,
            step_size: 0.1,
            step: 1,
            residual: 0.25,
            iterations: 200,
            newton_may_help,
        };
        error.to_string()
    };
    let plain = "step 1 of size 0.1 at time 0: the stages did not converge in 200 iterations (last relative change 2.5e-1); take a smaller step";
    assert_eq!(message(false), plain);
    assert_eq!(
        message(true),
        format!("{plain}, or, with the feature `newton`, `by_newton()` for a stiff system")
    );
}

/// Newton's iteration is advised where it is another one, and possible.
#[test]
fn newton_is_advised_only_where_it_may_help() -> Result<(), Error> {
    let advised = |outcome: Result<(), Error>| {
        let text = outcome.expect_err("the step is too large").to_string();
        assert!(text.contains("; take a smaller step"), "{text}");
        text.contains("by_newton")
    };
    let made = || Integrator::new(Midpoint, Product, point(0.5, 0.3), 1000.0);
    let stiff = made()?;
    assert!(advised(stiff.clone().step().map(|_| ())));
    let mut newton = stiff.clone().by_newton();
    newton.set_max_iterations(2);
    assert!(!advised(newton.step().map(|_| ())));
    let mut both = stiff.with_solver(<FixedPointThenNewton>::new());
    both.set_max_iterations(2);
    assert!(!advised(both.step().map(|_| ())));
    // The step is found by Newton's iteration; its stages are not.
    let staged = made()?.by_newton().step_with_stages();
    let outcome = staged.map(|_| ()).map_err(|error| match error {
        variational::Error::Core(error) => error,
        error => panic!("{error}"),
    });
    assert!(!advised(outcome));
    let start = State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.0]);
    let mut constrained = Integrator::new(Rattle, Rotor, start, 1.5)?;
    assert!(!advised(constrained.step().map(|_| ())));
    let tableau = common::tableau(Midpoint);
    let mut at_run_time = Integrator::new(tableau.clone(), Product, point(0.5, 0.3), 1000.0)?;
    assert!(advised(at_run_time.step().map(|_| ())));
    let mut newton = at_run_time.by_newton();
    newton.set_max_iterations(2);
    assert!(!advised(newton.step().map(|_| ())));
    Ok(())
}

/// What a step has begun to change is not used by the next one if the system panics.
#[test]
fn a_panic_of_the_system_leaves_nothing_behind() -> Result<(), Error> {
    fn check<M: Method>(method: M) -> Result<(), Error> {
        let panics = Cell::new(u32::MAX);
        let pendulum = acceleration(|_time, q: &Point, acceleration| {
            panics.set(panics.get() - 1);
            assert!(panics.get() > 0, "the system panics");
            acceleration[0] = -q[0].sin();
        });
        let start = State::new(0.0, Point::new(1.0), Point::new(0.5));
        let mut integrator = Integrator::plain(method, pendulum, start, 0.125)?;
        integrator.take_steps(5)?;
        let before = integrator.state().clone();
        for calls in [1, 2, 5] {
            panics.set(calls);
            let taken = std::panic::AssertUnwindSafe(|| integrator.step().map(|_| ()));
            assert!(std::panic::catch_unwind(taken).is_err());
            panics.set(u32::MAX);
            assert_eq!(integrator.state(), &before);
            assert!(integrator.dense().is_err());
        }
        // As from a state that is new.
        let end = integrator.step()?.clone();
        integrator.set_state(before)?;
        assert_eq!(integrator.step()?, &end);
        Ok(())
    }
    check(Lobatto3)?;
    check(Gauss2)
}

/// Very small and very large numbers have an exponent.
#[test]
fn numbers_in_messages_are_short() {
    let message = |time, step_size| Error::TimeResolution { time, step_size }.to_string();
    let text = message(1e300, 1e-300);
    assert!(
        text.contains("size 1e-300 ") && text.contains("time 1e300,"),
        "{text}"
    );
    let text = message(-0.5, 0.001);
    assert!(
        text.contains("size 0.001 ") && text.contains("time -0.5,"),
        "{text}"
    );
    let start = State::from_arrays(1.0, [1.0], [0.0]);
    let system = acceleration(|_, q: &Point, acceleration| *acceleration = -q);
    let mut run = Integrator::new(StoermerVerlet, system, start, 2e-200).expect("a valid start");
    let text = run
        .step()
        .expect_err("the time does not change")
        .to_string();
    assert!(text.contains("2e-200") && text.len() < 200, "{text}");
    let refused = Error::StepSize { value: f64::NAN }.to_string();
    assert!(refused.contains("is NaN;"), "{refused}");
}
