//! Tableaux at run time beside the emitted methods of the same coefficients.

use crate::common::methods::{ForestRuth, Gauss2, Gauss4, Lobatto3, Midpoint, StoermerVerlet};
use crate::common::systems::{Driven, Pendulum, Product};
use crate::common::{coefficients, distance, tableau};
use symplectic::at_run_time::{RunTimeCoefficients, RunTimeTableau, TableauError};
use symplectic::nalgebra::{DVector, Vector1, Vector2};
use symplectic::simd::{F64x4, Lanes};
use symplectic::solver::{ByNewton, FixedPoint, FixedPointThenNewton};
use symplectic::system::{Conservative, Frictionless};
use symplectic::{
    Error, Event, Integrator, Method, ProvedFor, Quantity, Retry, Scalar, Separable, State, System,
    acceleration, separable,
};

symplectic::tableau! { BlanesMoanSrkn11b { base: blanes-moan-2002-srkn11b } }

symplectic::hamiltonian! { Rod q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + y constraints: { rod = x^2 + y^2 - 1 } }
symplectic::hamiltonian! {
    Skate q: [x, y, a], p: [px, py, pa]; v: [vx, vy, va];
    H = (px^2 + py^2 + pa^2)/2 + x
    nonholonomic: { edge = vx sin(a) - vy cos(a) }
}

/// The slopes between numbers of steps that are doubled again and again.
fn slopes(
    coarsest: u32,
    halvings: u32,
    error: impl Fn(u32) -> Result<f64, Error>,
) -> Result<Vec<f64>, Error> {
    let errors = (0..=halvings)
        .map(|i| error(coarsest << i))
        .collect::<Result<Vec<_>, _>>()?;
    Ok(errors
        .windows(2)
        .map(|pair| (pair[0] / pair[1]).log2())
        .collect())
}

fn kepler() -> impl System<Vector2<f64>, Class = Separable> + Copy {
    separable(
        |_time, p: &Vector2<f64>, velocity| *velocity = *p,
        |_time, q, force| *force = -q / q.norm().powi(3),
    )
}

fn ellipse() -> State<Vector2<f64>> {
    State::from_arrays(0.0, [0.4, 0.0], [0.0, 2.0])
}

/// 200 steps of the same method in both forms, with either sums: no farther apart than rounding.
fn same<M, S, V>(method: M, system: impl Fn() -> S, start: &State<V>) -> Result<(), Error>
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<V, Class: Conservative>,
    V: symplectic::Vector<Scalar = f64>,
{
    let tableau = tableau(method);
    let h = 0.01;
    let mut emitted = Integrator::new(method, system(), start.clone(), h)?.with_solver(FixedPoint);
    let mut at_run_time = Integrator::new(tableau.clone(), system(), start.clone(), h)?;
    emitted.take_steps(200)?;
    at_run_time.take_steps(200)?;
    let apart = distance(emitted.state(), at_run_time.state());
    assert!(apart < 4e-15, "{}, compensated: {apart:e}", M::NAME);
    let mut emitted =
        Integrator::plain(method, system(), start.clone(), h)?.with_solver(FixedPoint);
    let mut at_run_time = Integrator::plain(tableau.clone(), system(), start.clone(), h)?;
    emitted.take_steps(200)?;
    at_run_time.take_steps(200)?;
    // 200 steps with a rounding error each, amplified by the flow.
    let apart = distance(emitted.state(), at_run_time.state());
    assert!(apart < 2e-13, "{}, plain: {apart:e}", M::NAME);
    assert_eq!(at_run_time.steps(), 200);
    Ok(())
}

#[test]
fn steps_of_separable_systems_are_those_of_emitted_methods() -> Result<(), Error> {
    same(StoermerVerlet, kepler, &ellipse())?;
    same(ForestRuth, kepler, &ellipse())?;
    same(BlanesMoanSrkn11b, kepler, &ellipse())?;
    same(Midpoint, kepler, &ellipse())?;
    same(Gauss2, kepler, &ellipse())?;
    same(Gauss4, kepler, &ellipse())?;
    same(Lobatto3, kepler, &ellipse())?;
    let dynamic = State::new(
        0.0,
        DVector::from_element(17, 1.0),
        DVector::from_element(17, 0.5),
    );
    same(Gauss2, Pendulum::default, &dynamic)
}

#[test]
fn steps_of_general_systems_are_those_of_emitted_methods() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [0.3], [0.7]);
    same(StoermerVerlet, || Product, &start)?;
    same(Gauss2, || Product, &start)?;
    same(Gauss4, || Product, &start)?;
    same(Lobatto3, || Product, &start)
}

#[test]
fn run_time_tableaux_use_the_nodes_of_emitted_methods() -> Result<(), Error> {
    let start = State::from_arrays(0.25, [0.3], [0.7]);
    same(StoermerVerlet, || Driven, &start)?;
    same(ForestRuth, || Driven, &start)?;
    same(Gauss2, || Driven, &start)?;
    same(Lobatto3, || Driven, &start)
}

#[test]
fn explicit_tableaux_take_as_many_evaluations() -> Result<(), Error> {
    for (at_run_time, emitted) in [
        (
            Integrator::new(tableau(StoermerVerlet), kepler(), ellipse(), 0.01)?.run()?,
            Integrator::new(StoermerVerlet, kepler(), ellipse(), 0.01)?.run()?,
        ),
        (
            Integrator::new(tableau(ForestRuth), kepler(), ellipse(), 0.01)?.run()?,
            Integrator::new(ForestRuth, kepler(), ellipse(), 0.01)?.run()?,
        ),
    ] {
        assert_eq!(at_run_time, emitted);
    }
    assert!(tableau(ForestRuth).is_explicit() && !tableau(Lobatto3).is_explicit());
    Ok(())
}

trait Run {
    fn run(self) -> Result<u64, Error>;
}

impl<M: Method, S: System<Vector2<f64>>> Run for Integrator<M, S, Vector2<f64>> {
    fn run(mut self) -> Result<u64, Error> {
        self.take_steps(50)?;
        Ok(self.statistics().evaluations)
    }
}

symplectic::hamiltonian! { Swing q: [a], p: [pa]; H = pa^2/2 - cos(a) }

/// Lanes are a scalar like others: all of them converge before a step ends.
#[test]
fn lanes_are_stepped_as_doubles() -> Result<(), Error> {
    let momenta = [0.3, 0.5, 0.7, 1.1];
    for tableau in [tableau(StoermerVerlet), tableau(Gauss4)] {
        let q = Vector1::new(F64x4::from_f64(0.2));
        let p = Vector1::new(F64x4::from_array(momenta));
        let mut lanes = Integrator::new(tableau.clone(), Swing, State::new(0.0, q, p), 0.1)?;
        lanes.take_steps(30)?;
        for (lane, momentum) in momenta.into_iter().enumerate() {
            let start = State::from_arrays(0.0, [0.2], [momentum]);
            let mut alone = Integrator::new(tableau.clone(), Swing, start, 0.1)?;
            let apart = alone.take_steps(30)?.q[0] - lanes.state().q[0].get(lane);
            assert!(apart.abs() < 1e-14, "{}: {apart:e}", tableau.name());
        }
    }
    Ok(())
}

#[test]
fn errors_fall_with_the_order() -> Result<(), Error> {
    fn check<M: Method>(method: M, coarsest: u32) -> Result<(), Error> {
        let tableau = tableau(method);
        let order = f64::from(tableau.orders().separable);
        let found = slopes(coarsest, 2, |steps| {
            let h = core::f64::consts::TAU / f64::from(steps);
            let mut integrator = Integrator::new(tableau.clone(), kepler(), ellipse(), h)?;
            let end = integrator.integrate_to(core::f64::consts::TAU)?;
            Ok((end.q - ellipse().q).norm())
        })?;
        for slope in found {
            assert!((slope - order).abs() < 0.25, "{}: {slope}", M::NAME);
        }
        Ok(())
    }
    check(StoermerVerlet, 512)?;
    check(ForestRuth, 512)?;
    check(Gauss2, 128)?;
    check(Lobatto3, 256)
}

#[test]
fn a_step_back_comes_to_where_it_began() -> Result<(), Error> {
    for tableau in [tableau(Gauss4), tableau(ForestRuth)] {
        let mut integrator = Integrator::new(tableau.clone(), kepler(), ellipse(), 0.02)?;
        integrator.take_steps(100)?;
        integrator.set_step_size(-0.02)?;
        integrator.take_steps(100)?;
        let apart = distance(integrator.state(), &ellipse());
        assert!(apart < 1e-14, "{apart:e}");
    }
    Ok(())
}

#[test]
fn coefficients_that_are_wrong_are_refused_with_the_row() {
    let refused = |change: fn(&mut RunTimeCoefficients)| {
        let mut coefficients = coefficients(Gauss2);
        change(&mut coefficients);
        RunTimeTableau::new("wrong", &coefficients, Gauss2::ORDERS).expect_err("it is wrong")
    };
    let shape = |what, row, expected, found| TableauError::Shape {
        what,
        row,
        expected,
        found,
    };
    assert_eq!(
        refused(|x| *x = RunTimeCoefficients::default()),
        TableauError::NoStages
    );
    assert_eq!(refused(|x| x.a[1].truncate(1)), shape("a", Some(2), 2, 1));
    assert_eq!(
        refused(|x| x.a_tilde.push(vec![0.0; 2])),
        shape("ã", None, 2, 3)
    );
    assert_eq!(refused(|x| x.c.push(1.0)), shape("c", None, 2, 3));
    assert!(matches!(
        refused(|x| x.b_tilde[1] = f64::NAN),
        TableauError::NotFinite {
            what: "b̃",
            row: None,
            column: 2,
            ..
        }
    ));
    assert!(matches!(
        refused(|x| x.a[1][0] = f64::INFINITY),
        TableauError::NotFinite {
            what: "a",
            row: Some(2),
            column: 1,
            ..
        }
    ));
    assert_eq!(
        refused(|x| x.b = vec![0.5, 0.25]),
        TableauError::Weights {
            what: "b",
            sum: 0.75
        }
    );
    let node = refused(|x| x.c_tilde[1] += 1e-14);
    assert!(
        matches!(
            node,
            TableauError::Node {
                what: "ã",
                row: 2,
                ..
            }
        ),
        "{node}"
    );
    // A consistent method that is not symplectic: one row of a changed, and its node with it.
    let wrong = refused(|x| {
        x.a[1][0] += 1e-14;
        x.a[1][1] -= 1e-14;
    });
    let TableauError::NotSymplectic {
        row: 1,
        column: 2,
        defect,
    } = wrong
    else {
        panic!("{wrong}");
    };
    assert!((defect / 5e-15 - 1.0).abs() < 0.1, "{defect:e}");
    assert!(wrong.to_string().contains("row 1 of ã and column 1 of a"));
}

#[test]
fn every_emitted_method_passes_the_checks() {
    // Coefficients of size 100 and more in some rows do not pass for wrong ones.
    assert!(tableau(BlanesMoanSrkn11b).is_explicit());
    assert_eq!(tableau(Midpoint).stages(), 1);
    assert_eq!(tableau(Gauss4).name(), "Gauss4");
}

#[test]
fn systems_of_lower_order_are_refused() -> Result<(), Error> {
    let splitting = tableau(ForestRuth);
    let start = || State::from_arrays(0.0, [0.3], [0.7]);
    let refused = Integrator::new(splitting.clone(), Product, start(), 0.1).err();
    let expected = Error::SeparableTableau {
        order: 4,
        lower_order: ForestRuth::ORDERS.general,
    };
    assert_eq!(refused, Some(expected));
    let accepted = splitting.accept_lower_order();
    Integrator::new(accepted.clone(), Product, start(), 0.1)?.step()?;
    // Runge–Kutta–Nyström on a kinetic energy that is not quadratic.
    let quartic = || {
        separable::<Vector1<f64>, _, _>(
            |_, p, velocity| velocity[0] = p[0].powi(3),
            |_, q, force| *force = -q,
        )
    };
    let nystrom = tableau(BlanesMoanSrkn11b);
    let refused = Integrator::new(nystrom.clone(), quartic(), start(), 0.1).err();
    assert!(
        matches!(refused, Some(Error::NotQuadraticKinetic { order: 6, .. })),
        "{refused:?}"
    );
    Integrator::new(nystrom.accept_lower_order(), quartic(), start(), 0.1)?.step()?;
    Ok(())
}

/// A checkpoint of either continues with the same bits.
#[test]
fn constrained_steps_at_run_time_have_the_bits_of_the_method()
-> Result<(), Box<dyn std::error::Error>> {
    fn same<M, S, V>(
        method: M,
        system: S,
        start: State<V>,
    ) -> Result<(), Box<dyn std::error::Error>>
    where
        M: Method + Copy + ProvedFor<S::Class>,
        S: System<V, Class: Frictionless> + Clone,
        V: symplectic::Vector<Scalar = f64>,
    {
        let without = tableau(method);
        let refused = Integrator::new(without.clone(), system.clone(), start.clone(), 0.05).err();
        assert_eq!(refused, Some(Error::NoConstrainedSteps));
        let tableau = without.with_constrained_steps(M::CONSTRAINED, M::NONHOLONOMIC);
        let mut emitted = Integrator::new(method, system.clone(), start.clone(), 0.05)?;
        let made = || Integrator::new(tableau.clone(), system.clone(), start.clone(), 0.05);
        let (mut whole, mut resumed) = (made()?, made()?);
        emitted.take_steps(100)?;
        whole.take_steps(100)?;
        resumed.restore(&whole.checkpoint()?)?;
        for run in [&mut whole, &mut resumed] {
            run.take_steps(100)?;
        }
        emitted.take_steps(100)?;
        assert!(whole.state() == emitted.state() && resumed.state() == emitted.state());
        Ok(())
    }
    let rod = State::from_arrays(0.0, [0.6, -0.8], [0.8, 0.6]);
    same(Lobatto3, Rod, rod.clone())?;
    same(StoermerVerlet, Rod, rod)?;
    let skate = State::from_arrays(0.0, [0.0; 3], [1.0, 0.0, 0.5]);
    same(Midpoint, Skate, skate)
}

#[test]
fn a_step_that_fails_leaves_the_state() -> Result<(), Error> {
    let wall = || {
        acceleration(|_time, q: &Vector1<f64>, acceleration: &mut Vector1<f64>| {
            acceleration[0] = if q[0] < 1.2 { 1.0 } else { f64::NAN };
        })
    };
    let start = || State::from_arrays(0.0, [1.0], [0.0]);
    // Only the second stage lies behind the wall.
    for tableau in [tableau(StoermerVerlet), tableau(Gauss2)] {
        let mut integrator = Integrator::new(tableau.clone(), wall(), start(), 0.25)?;
        let error = loop {
            let before = integrator.state().clone();
            if let Err(error) = integrator.step() {
                assert_eq!(integrator.state(), &before);
                break error;
            }
        };
        let Error::NonFinite {
            what: Quantity::Force,
            stage: Some(found),
            ..
        } = error
        else {
            panic!("{error}");
        };
        assert_eq!(found, 2, "{error}");
        // The tableau is still there.
        integrator.set_state(start())?;
        integrator.step()?;
    }
    let mut integrator = Integrator::new(tableau(Gauss2), kepler(), ellipse(), 0.1)?;
    integrator.set_max_iterations(3);
    assert!(matches!(
        integrator.step(),
        Err(Error::NoConvergence { .. })
    ));
    integrator.set_max_iterations(8);
    integrator.set_retry(Retry::Split { halvings: 8 });
    integrator.step()?;
    assert!(integrator.statistics().rejected > 0);
    Ok(())
}

#[test]
fn a_run_time_integrator_copies_restarts_and_changes_solvers()
-> Result<(), Box<dyn std::error::Error>> {
    for tableau in [tableau(Gauss4), tableau(ForestRuth)] {
        let run = || Integrator::new(tableau.clone(), kepler(), ellipse(), 0.02);
        // Another copy, another solver, a checkpoint: the same bits.
        let mut whole = run()?;
        whole.take_steps(100)?;
        let (mut copy, checkpoint) = (whole.clone(), whole.checkpoint()?);
        let mut resumed = run()?;
        resumed.restore(&checkpoint)?;
        for integrator in [&mut whole, &mut copy, &mut resumed] {
            integrator.take_steps(100)?;
        }
        assert_eq!(whole.state(), copy.state());
        assert_eq!(whole.state(), resumed.state());
        run()?.with_solver(FixedPoint).take_steps(100)?;
        // That of another tableau is refused.
        let mut other = Integrator::new(self::tableau(Gauss2), kepler(), ellipse(), 0.02)?;
        assert!(other.restore(&checkpoint).is_err());
    }
    Ok(())
}

#[test]
fn events_are_where_emitted_methods_find_them() -> Result<(), Error> {
    fn check<M: Method + Copy + ProvedFor<Separable>>(method: M) -> Result<(), Error> {
        let tableau = tableau(method);
        let event = || Event::crossing(|state: &State<Vector2<f64>>| state.q[1]).by_steps();
        let mut emitted = Integrator::new(method, kepler(), ellipse(), 0.02)?;
        let mut at_run_time = Integrator::new(tableau.clone(), kepler(), ellipse(), 0.02)?;
        // Half of the period.
        let expected = emitted.find_event(4.0, &event())?.map(|state| state.time);
        let found = at_run_time
            .find_event(4.0, &event())?
            .map(|state| state.time);
        let (expected, found) = (expected.expect("a crossing"), found.expect("a crossing"));
        assert!((found - core::f64::consts::PI).abs() < 1e-3, "{found}");
        assert!((found - expected).abs() < 1e-13, "{found} {expected}");
        Ok(())
    }
    check(Gauss4)?;
    check(ForestRuth)
}

symplectic::hamiltonian! {
    /// A chain of stiff springs between the walls of a quartic potential.
    Springs { k }
    q: [..], p: [..];
    bonds: free;
    H = sum(i: p[i]^2/2 + q[i]^4/4) + sum(bonds d: k d^2/2)
}

symplectic::hamiltonian! {
    /// A stiff oscillator and a soft one, coupled by a product of momentum and position.
    Mixed { k }
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + k x^2/2 + y^2/2 + px y^2/10
}

/// A run of a tableau beside that of the emitted method, by Newton's iteration: the same states, and about as many sweeps.
fn same_by_newton<M, S, V>(method: M, system: &S, start: &State<V>, h: f64) -> Result<(), Error>
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<V, Class: Conservative> + Clone,
    V: symplectic::Vector<Scalar = f64>,
{
    let tableau = tableau(method);
    let made = || Integrator::new(tableau.clone(), system.clone(), start.clone(), h);
    let mut emitted = Integrator::new(method, system.clone(), start.clone(), h)?.by_newton();
    let mut at_run_time = made()?.by_newton();
    emitted.take_steps(100)?;
    at_run_time.take_steps(100)?;
    let size = 1.0
        + distance(
            start,
            &State::new(start.time, start.q.zeros_like(), start.p.zeros_like()),
        );
    let apart = distance(emitted.state(), at_run_time.state()) / size;
    assert!(apart < 1e-12, "{}: {apart:e}", M::NAME);
    let (expected, found) = (emitted.statistics(), at_run_time.statistics());
    assert!(found.factorisations > 0 && found.factorisations <= 2 * expected.factorisations + 4);
    let sweeps = found.mean_iterations() / expected.mean_iterations();
    assert!(sweeps < 1.2, "{}: {sweeps} times the sweeps", M::NAME);
    // The fixed-point iteration diverges, and its fallback takes over.
    assert!(made()?.step().is_err(), "{}", M::NAME);
    let mut fallback = made()?.with_solver(<FixedPointThenNewton>::new());
    fallback.take_steps(100)?;
    assert!(fallback.statistics().rejected > 0);
    let apart = distance(emitted.state(), fallback.state()) / size;
    assert!(apart < 1e-12, "{}: {apart:e}", M::NAME);
    Ok(())
}

#[test]
fn newtons_iteration_is_that_of_emitted_methods() -> Result<(), Error> {
    let q = DVector::from_fn(12, |i, _| (i as f64).sin() * 1e-3);
    let chain = State::new(0.0, q.clone(), q);
    let mixed = State::from_arrays(0.0, [1e-3, 1.0], [0.2, 0.1]);
    macro_rules! check {
        ($($method:ident)*) => {$(
            same_by_newton($method, &Springs::new(1e6), &chain, 0.1)?;
            same_by_newton($method, &Mixed::new(1e6), &mixed, 0.1)?;
        )*};
    }
    check!(Midpoint Gauss2 Gauss4);
    Ok(())
}

#[test]
fn newtons_iteration_takes_explicit_tableaux_too() -> Result<(), Error> {
    let made = || Integrator::new(tableau(StoermerVerlet), kepler(), ellipse(), 0.01);
    let (mut plain, mut by_newton) = (made()?, made()?.by_newton());
    assert_eq!(by_newton.take_steps(100)?, plain.take_steps(100)?);
    assert_eq!(by_newton.statistics(), plain.statistics());
    let both = made()?
        .with_solver(<FixedPointThenNewton>::new())
        .take_steps(100)?
        .clone();
    assert_eq!(&both, plain.state());
    Ok(())
}
