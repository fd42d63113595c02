//! Compositions of implicit methods, one step after another: what they evaluate, where they go, and how they fail.

use symplectic::nalgebra::{Vector1, Vector2};
use symplectic::solver::FixedPoint;
use symplectic::system::Unconstrained;
use symplectic::{
    Error, General, Integrator, Method, ProvedFor, Quantity, State, Summation, System, separable,
};
use symplectic_tests::counting::{Counting, Counts};
use symplectic_tests::measure::{integrate, position_error};
use symplectic_tests::order::ObservedOrder;
use symplectic_tests::scenes::kepler::{Kepler, exact, start};

symplectic::tableau! {
    /// Order 4.
    Gauss2 { basis: polynomial(2), nodes: gauss(2) }
    /// Order 4, first same as last.
    Lobatto3 { basis: polynomial(3), nodes: lobatto(3) }
    /// Two methods, one of them twice, in a composition of a composition.
    Mixed {
        compose: [
            [1/2, basis: polynomial(3), nodes: lobatto(3)],
            [1/2, compose: [[1/3, basis: polynomial(2), nodes: gauss(2)], [2/3, basis: polynomial(3), nodes: lobatto(3)]]],
        ],
    }
}

symplectic::composition! {
    /// Order 6 of a method of order 4.
    Jump { base: gauss-2, weights: triple_jump(6), require: [order >= 6, symplectic, symmetric] }
    /// Five steps, of which neighbours have the same size.
    Fractal { base: lobatto-3, weights: suzuki(6) }
    /// Equal steps are those of the base method.
    Halves { base: gauss-2, weights: [1/2, 1/2] }
    /// What is not symmetric is composed with its adjoint.
    Euler { base: symplectic-euler, weights: [adjoint(1/2), 1/2], require: [order == 2] }
}

/// The fractions of the triple jump from order 4 to order 6.
fn jump() -> [f64; 3] {
    let outer = 1.0 / (2.0 - 2f64.powf(0.2));
    [outer, 1.0 - 2.0 * outer, outer]
}

#[test]
fn substeps_are_steps_of_the_base_method() -> Result<(), Error> {
    let mut whole = Integrator::new(Jump, Kepler, start::<f64>(0.6), 0.05)?;
    let mut parts = Integrator::new(Gauss2, Kepler, start::<f64>(0.6), 0.05)?;
    for _ in 0..100 {
        whole.step()?;
        for fraction in jump() {
            parts.set_step_size(fraction * 0.05)?;
            parts.step()?;
        }
        let (whole, parts) = (whole.state(), parts.state());
        let distance = (whole.q - parts.q).norm() + (whole.p - parts.p).norm();
        assert!(distance < 1e-12, "{distance:e} at {}", whole.time);
    }
    Ok(())
}

#[test]
fn equal_substeps_are_the_base_method_to_the_last_bit() -> Result<(), Error> {
    fn check<R: Summation>() -> Result<(), Error> {
        let mut whole: Integrator<_, _, _, R> =
            Integrator::with_summation(Halves, Kepler, start::<f64>(0.6), 0.125)?;
        let mut parts: Integrator<_, _, _, R> =
            Integrator::with_summation(Gauss2, Kepler, start::<f64>(0.6), 0.0625)?;
        for _ in 0..50 {
            whole.step()?;
            parts.step()?;
            parts.step()?;
            assert_eq!(whole.state(), parts.state());
            assert_eq!(whole.remainder(), parts.remainder());
        }
        // The stages of a substep start from those of the one before it, in this step or the last.
        assert_eq!(whole.iterations(), parts.iterations());
        assert_eq!(
            whole.statistics().evaluations,
            parts.statistics().evaluations
        );
        Ok(())
    }
    check::<symplectic::Compensated>()?;
    check::<symplectic::Plain>()
}

#[test]
fn a_substep_finds_its_own_stages_and_keeps_the_last_force() -> Result<(), Error> {
    const STEPS: u64 = 50;
    let counts = Counts::default();
    let system = Counting::new(Kepler, &counts);
    let mut integrator = Integrator::new(Fractal, system, start::<f64>(0.6), 0.1)?;
    for _ in 0..STEPS {
        integrator.step()?;
    }
    // One force a sweep, one at the end of each substep, which is the first of the next, and one to start.
    assert_eq!(counts.forces(), integrator.iterations() + 5 * STEPS + 1);
    // A velocity to start the iteration from, where the substep before has another size.
    let cold = 2 * STEPS + 1;
    assert_eq!(counts.velocities(), 3 * integrator.iterations() + cold);
    Ok(())
}

/// All three substeps of [`Mixed`] for both classes of systems.
#[test]
fn different_methods_follow_one_another() -> Result<(), Error> {
    #[derive(Clone, Copy)]
    struct Coupled;
    impl System<Vector1<f64>> for Coupled {
        type Class = General;
        type Solver = FixedPoint;
        fn velocity(
            &self,
            _: f64,
            q: &Vector1<f64>,
            p: &Vector1<f64>,
            velocity: &mut Vector1<f64>,
        ) {
            velocity[0] = p[0] * (q[0] * q[0] + 1.0);
        }
        fn force(&self, _: f64, q: &Vector1<f64>, p: &Vector1<f64>, force: &mut Vector1<f64>) {
            force[0] = -q[0] * (p[0] * p[0] + 1.0);
        }
    }
    fn by_hand<S: System<V, Class: Unconstrained> + Copy, V: symplectic::Vector>(
        system: S,
        start: &State<V>,
        h: f64,
    ) -> Result<State<V>, Error> {
        fn one<M: Method + Copy + ProvedFor<S::Class>, S: System<V>, V: symplectic::Vector>(
            method: M,
            system: S,
            start: State<V>,
            h: f64,
        ) -> Result<State<V>, Error> {
            let mut integrator = Integrator::new(method, system, start, h)?;
            integrator.step()?;
            Ok(integrator.into_state())
        }
        let state = one(Lobatto3, system, start.clone(), h / 2.0)?;
        let state = one(Gauss2, system, state, h / 6.0)?;
        one(Lobatto3, system, state, h / 3.0)
    }
    let begin = start::<f64>(0.3);
    let mut integrator = Integrator::new(Mixed, Kepler, begin.clone(), 0.25)?;
    let (found, expected) = (integrator.step()?, by_hand(Kepler, &begin, 0.25)?);
    assert!((found.q - expected.q).norm() < 1e-15 && (found.p - expected.p).norm() < 1e-15);
    let begin = State::new(0.0, Vector1::new(0.7), Vector1::new(-0.2));
    let mut integrator = Integrator::new(Mixed, Coupled, begin.clone(), 0.25)?;
    let (found, expected) = (integrator.step()?, by_hand(Coupled, &begin, 0.25)?);
    assert!((found.q - expected.q).norm() < 1e-15 && (found.p - expected.p).norm() < 1e-15);
    Ok(())
}

#[test]
fn the_order_is_seen() -> Result<(), Error> {
    const END: f64 = 8.0;
    fn slope<M: Method + Copy>(method: M, rates: [f64; 3]) -> Result<ObservedOrder, Error> {
        let reference = exact(0.3, END);
        let run = |rate: f64| -> Result<(f64, f64), Error> {
            let end = integrate(method, Kepler, &start(0.3), END, rate.recip())?;
            Ok((rate.recip(), position_error(&end, &reference)))
        };
        let runs = rates.into_iter().map(run).collect::<Result<Vec<_>, _>>()?;
        Ok(ObservedOrder::of(&runs))
    }
    let found = slope(Jump, [24.0, 32.0, 48.0])?;
    assert!(found.shows(6.0, 0.2), "{found}");
    let found = slope(Fractal, [12.0, 16.0, 24.0])?;
    assert!(found.shows(6.0, 0.2), "{found}");
    let found = slope(Euler, [64.0, 128.0, 256.0])?;
    assert!(found.shows(2.0, 0.1), "{found}");
    Ok(())
}

/// Times of a substep are those of the whole step: p' = t has p = t²/2 exactly.
#[test]
fn a_substep_knows_the_time() -> Result<(), Error> {
    let driven = separable::<Vector1<f64>, _, _>(
        |_, p, velocity| velocity[0] = p[0],
        |time, _, force| force[0] = time,
    );
    let begin = State::new(1.0, Vector1::new(0.0), Vector1::new(0.5));
    let mut integrator = Integrator::new(Jump, driven, begin, 0.5)?;
    let end = integrator.integrate_to(3.0)?;
    assert!((end.p[0] - 4.5).abs() < 1e-14, "{}", end.p[0]);
    assert!((end.q[0] - 26.0 / 6.0).abs() < 1e-14, "{}", end.q[0]);
    Ok(())
}

#[test]
fn a_failure_names_its_stage_and_leaves_the_state() -> Result<(), Error> {
    // The middle step of the jump goes back, and its second stage alone is where the force is not known.
    let fragile = separable::<Vector2<f64>, _, _>(
        |_, p, velocity| *velocity = *p,
        |time: f64, q, force| {
            *force = if (0.05..0.06).contains(&time) {
                q * f64::NAN
            } else {
                -q
            }
        },
    );
    let begin = State::new(0.0, Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0));
    let mut integrator = Integrator::new(Jump, fragile, begin.clone(), 0.5)?;
    let error = integrator.step().map(|_| ()).expect_err("no force");
    let Error::NonFinite { what, stage, .. } = error else {
        panic!("{error}");
    };
    // Substeps of two stages each.
    assert_eq!((what, stage), (Quantity::Force, Some(4)));
    assert_eq!(integrator.state(), &begin);
    assert_eq!((integrator.steps(), integrator.iterations()), (0, 0));
    Ok(())
}
