//! Generating functions of Types I, II and III at given ends of a step: their derivatives, their Legendre transforms, and where there are
//! none.

use crate::methods::{ForestRuth, Gauss2, Lobatto3, StoermerVerlet};
use symplectic::nalgebra::{DVector, Vector1, Vector2};
use symplectic::solver::ByNewton;
use symplectic::stepper::StepMap;
use symplectic::variational::{
    Error, GeneratingFunctions, GivenEnds, LagrangianSteps, VariationalSteps, generating_function,
};
use symplectic::{Error as CoreError, Integrator, Quantity, State};

use crate::discrete_lagrangians::{AtTwoPoints, DoublePendulum, Shaken, Trapezoid, perihelion};
use crate::symmetry::Twisted;

symplectic::composition! { TwoSteps { base: stormer-verlet, weights: [1/2, 1/2] } }

symplectic::hamiltonian! { pub Oscillator q: [x], p: [px]; H = (px^2 + x^2)/2 }
symplectic::hamiltonian! { pub Product q: [x], p: [px]; H = x px }
symplectic::hamiltonian! { pub Swing q: [a, b], p: [pa, pb]; H = (pa^2 + pb^2)/2 - cos(a) - cos(a - b) }

type Plane = Vector2<f64>;

/// The gradient of a function, by differences of order 4 with an error of about 10⁻¹².
fn gradient(at: &Plane, function: impl Fn(&Plane) -> GivenEnds<Plane>) -> Plane {
    const WAY: f64 = 1e-3;
    Plane::from_fn(|k, _| {
        let moved = |by: f64| {
            let mut at = *at;
            at[k] += by;
            function(&at).value
        };
        (8.0 * (moved(WAY) - moved(-WAY)) - (moved(2.0 * WAY) - moved(-2.0 * WAY))) / (12.0 * WAY)
    })
}

/// Checks all three functions near a step.
#[track_caller]
fn check(run: &impl GeneratingFunctions<Vector = Plane>, way: &Plane) {
    let present = run.present().clone();
    let end = run.step_from(present.clone()).expect("a step");
    // Other ends than those of the step.
    let (q0, q1) = (present.q + way, end.q - way * 0.7);
    let one = |q0: &Plane, q1: &Plane| run.type_one(q0, q1).expect("a step");
    let two = |q0: &Plane, p1: &Plane| run.type_two(q0, p1).expect("a step");
    let three = |p0: &Plane, q1: &Plane| run.type_three(p0, q1).expect("a step");
    let step = one(&q0, &q1);
    assert!((step.end.q - q1).amax() < 1e-14 && step.start.q == q0);
    let (p0, p1) = (step.start.p, step.end.p);
    let (by_momentum, by_both) = (two(&q0, &p1), three(&p0, &q1));
    let legendre = [
        (by_momentum.value, p1.dot(&q1) - step.value),
        (by_both.value, -p0.dot(&q0) - step.value),
    ];
    for (found, expected) in legendre {
        assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    }
    let gradients = [
        ("p0", p0, -gradient(&q0, |q0| one(q0, &q1))),
        ("p1", p1, gradient(&q1, |q1| one(&q0, q1))),
        ("p0", p0, gradient(&q0, |q0| two(q0, &p1))),
        ("q1", q1, gradient(&p1, |p1| two(&q0, p1))),
        ("q0", q0, -gradient(&p0, |p0| three(p0, &q1))),
        ("p1", p1, -gradient(&q1, |q1| three(&p0, q1))),
    ];
    for (what, expected, found) in gradients {
        let error = (found - expected).amax();
        assert!(error < 1e-9, "{what}: {error:e}");
    }
    // It is another step than that of the present state.
    assert!((p0 - present.p).amax() > 1e-2);
}

#[test]
fn derivatives_are_the_other_ends() -> Result<(), Error> {
    let way = Vector2::new(0.02, -0.03);
    let start: State<Plane> = State::from_arrays(0.0, [0.8, 0.3], [0.2, 0.7]);
    check(
        &Integrator::new(Gauss2, Twisted, start.clone(), 0.25)?,
        &way,
    );
    check(
        &Integrator::new(Lobatto3, Twisted, start.clone(), 0.25)?,
        &way,
    );
    check(
        &Integrator::new(Gauss2, Twisted, start.clone(), 0.25)?.by_newton(),
        &way,
    );
    check(
        &Integrator::new(ForestRuth, Swing, start.clone(), 0.25)?,
        &way,
    );
    check(
        &Integrator::new(TwoSteps, Swing, start.clone(), -0.25)?,
        &way,
    );
    check(
        &LagrangianSteps::run(Gauss2, DoublePendulum, start, 0.25)?,
        &way,
    );
    check(&VariationalSteps::run(Trapezoid, perihelion(), 0.05)?, &way);
    check(
        &VariationalSteps::run(AtTwoPoints(0.3), perihelion(), 0.05)?,
        &way,
    );
    Ok(())
}

/// Values in closed form, and the value of Type II by the other algorithm.
#[test]
fn generating_functions_of_given_ends_have_known_values() -> Result<(), Error> {
    let (h, q0, q1) = (0.25, Vector1::new(0.7), Vector1::new(0.9));
    let start = State::from_arrays(0.0, [0.7], [0.1]);
    let run = Integrator::new(StoermerVerlet, Oscillator, start, h)?;
    let action = |q0: f64, q1: f64| (q1 - q0).powi(2) / (2.0 * h) - h / 4.0 * (q0 * q0 + q1 * q1);
    assert!((run.type_one(&q0, &q1)?.value - action(0.7, 0.9)).abs() < 1e-14);
    let (q0, p1) = (Vector2::new(0.5, -0.2), Vector2::new(0.3, 0.6));
    let start = State::new(0.0, q0, p1);
    let run = Integrator::new(Gauss2, Twisted, start, 0.25)?;
    let (found, expected) = (
        run.type_two(&q0, &p1)?,
        generating_function(Gauss2, &Twisted, 0.0, &q0, &p1, 0.25)?,
    );
    assert!((found.value - expected.value).abs() < 1e-14);
    assert!(
        (found.start.p - expected.p0).amax() < 1e-14 && (found.end.q - expected.q1).amax() < 1e-14
    );
    Ok(())
}

/// The weights of forces and velocities of a splitting differ; the value by stages and that by Newton's iteration agree. If H depends on time
/// there is no single energy of a stage.
#[test]
fn generating_functions_of_splittings_agree_with_newton() -> Result<(), Error> {
    let (q0, p1) = (Vector2::new(0.5, -0.2), Vector2::new(0.3, 0.6));
    let run = Integrator::new(ForestRuth, Swing, State::new(0.0, q0, p1), 0.2)?;
    let found = run.type_two(&q0, &p1)?;
    let expected = generating_function(ForestRuth, &Swing, 0.0, &q0, &p1, 0.2)?;
    let error = (found.value - expected.value).abs();
    assert!(error < 1e-14, "{error:e}");
    let run = Integrator::new(
        StoermerVerlet,
        Shaken,
        State::from_arrays(0.0, [0.5], [0.3]),
        0.1,
    )?;
    let outcome = run.type_one(&Vector1::new(0.5), &Vector1::new(0.52));
    assert!(
        matches!(outcome, Err(Error::DifferentNodes { .. })),
        "{outcome:?}"
    );
    Ok(())
}

/// The present state is a step already: nothing has to be found, whatever its size.
#[test]
fn the_ends_of_a_known_step_give_its_start() -> Result<(), Error> {
    for size in [1e-6, 1e-3, 0.3] {
        let start: State<Plane> = State::from_arrays(0.0, [0.8, 0.3], [0.2, 0.7]);
        let mut run = Integrator::new(Gauss2, Twisted, start.clone(), size)?;
        let there = run.clone();
        let end = run.step()?.q;
        let found = there.type_one(&start.q, &end)?;
        // The momentum is known to the rounding of the positions, divided by the step size.
        assert!((found.start.p - start.p).amax() < 1e-14 / size);
        assert_eq!(there.steps(), 0);
    }
    Ok(())
}

/// With two steps of Störmer–Verlet of size k = h/2, ∂q1/∂p0 = 2k(1 − k²/2) vanishes at k = √2. With one, ∂q1/∂q0 = 1 − h²/2 does so at
/// h = √2, and ∂p1/∂p0 too. A degenerate H has no Type I at all.
#[test]
fn ends_that_do_not_determine_the_step_are_refused() -> Result<(), Error> {
    let root = 2.0_f64.sqrt();
    let (one, other) = (Vector1::new(0.7), Vector1::new(0.9));
    let start = || State::from_arrays(0.0, [0.7], [0.1]);
    let two_steps = |size| Integrator::new(TwoSteps, Oscillator, start(), size);
    let one_step = |size| Integrator::new(StoermerVerlet, Oscillator, start(), size);
    let none = |found: Result<GivenEnds<Vector1<f64>>, Error>, unknown: Quantity| match found {
        Err(Error::NoStart {
            component: Some(0),
            what,
            residual,
            ..
        }) => what == unknown && residual > 1e-3,
        _ => false,
    };
    assert!(none(
        two_steps(2.0 * root)?.type_one(&one, &other),
        Quantity::Momentum
    ));
    assert!(none(
        one_step(root)?.type_two(&one, &other),
        Quantity::Momentum
    ));
    assert!(none(
        one_step(root)?.type_three(&one, &other),
        Quantity::Position
    ));
    let product = Integrator::new(Gauss2, Product, start(), 0.1)?;
    assert!(none(product.type_one(&one, &other), Quantity::Momentum));
    // The other types exist there, and this type at a size nearby.
    for found in [
        two_steps(2.0 * root)?.type_two(&one, &other),
        two_steps(2.0 * root)?.type_three(&one, &other),
        two_steps(2.8)?.type_one(&one, &other),
        one_step(root)?.type_one(&one, &other),
        one_step(1.4)?.type_two(&one, &other),
        one_step(1.4)?.type_three(&one, &other),
        product.type_two(&one, &other),
        product.type_three(&one, &other),
    ] {
        assert!(found?.value.is_finite());
    }
    let text = two_steps(2.0 * root)?
        .type_one(&one, &other)
        .expect_err("a conjugate point")
        .to_string();
    assert!(
        text.contains("component 0") && text.contains("another type"),
        "{text}"
    );
    Ok(())
}

symplectic::hamiltonian! { pub Root q: [x], p: [px]; H = sqrt(1 + px^2) }

/// Faster than light: no momentum leads so far. Wrong vectors are refused.
#[test]
fn unreachable_ends_are_refused() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [0.0], [0.5]);
    let run = Integrator::new(Gauss2, Root, start, 0.1)?;
    let outcome = run.type_one(&Vector1::new(0.0), &Vector1::new(0.2));
    assert!(
        matches!(
            outcome,
            Err(Error::NoStart { .. } | Error::Core(CoreError::NonFiniteState { .. }))
        ),
        "{outcome:?}"
    );
    assert!(
        run.type_one(&Vector1::new(0.0), &Vector1::new(0.09))
            .is_ok()
    );
    let outcome = run.type_three(&Vector1::new(f64::NAN), &Vector1::new(0.2));
    assert!(
        matches!(
            outcome,
            Err(Error::Core(CoreError::NonFiniteState {
                what: Quantity::Momentum
            }))
        ),
        "{outcome:?}"
    );
    let heap = symplectic::separable::<DVector<f64>, _, _>(
        |_, p, velocity| velocity.copy_from(p),
        |_, q, force| force.copy_from(&-q),
    );
    let vector = |n: usize| DVector::from_element(n, 0.3);
    let run = Integrator::new(Gauss2, heap, State::new(0.0, vector(2), vector(2)), 0.1)?;
    for (q0, q1) in [(3, 2), (2, 3)] {
        let outcome = run.type_one(&vector(q0), &vector(q1));
        assert!(
            matches!(outcome, Err(Error::Core(CoreError::Dimension { .. }))),
            "{outcome:?}"
        );
    }
    Ok(())
}

symplectic::hamiltonian! { pub Spring { k } q: [x], p: [px]; H = px^2/2 + k (x - 1)^2/2 }
symplectic::hamiltonian! { pub Displaced q: [x], p: [px]; H = (px^2 + x^2)/2 + x }

/// The force `k(x0 − x)` of a stiff spring near rest has rounding errors of the size of `k x0`, which exceed those of the momentum. Near
/// zero there are no positions to compare a residual with.
#[test]
fn ends_with_rounding_errors_of_the_step_are_solved() -> Result<(), Error> {
    for (k, size) in [(100.0, 0.1), (1e6, 1e-3)] {
        let start = State::from_arrays(0.0, [1.0], [0.0]);
        let run = Integrator::new(StoermerVerlet, Spring { k }, start, size)?;
        for number in 1..=40 {
            // Irregular displacements.
            let by = |factor: f64| 1e-3 * (factor * f64::from(number)).sin();
            let (q0, p0) = (1.0 + by(1.3), size * k * by(2.7));
            let end = run.step_from(State::from_arrays(0.0, [q0], [p0]))?;
            let found = run.type_two(&Vector1::new(q0), &end.p)?;
            // ε h k x0, divided by ∂p1/∂p0 = 1 − h²k/2 = 1/2.
            let rounding = 16.0 * f64::EPSILON * size * k;
            assert!((found.start.p[0] - p0).abs() < rounding, "{k} {number}");
        }
    }
    let zero = Vector1::new(0.0);
    let start = State::new(0.0, zero, zero);
    for number in 1..=40 {
        let size = 0.01 * f64::from(number);
        let run = Integrator::new(Gauss2, Displaced, start.clone(), size)?;
        let (p0, p1) = {
            let found = run.type_one(&zero, &zero)?;
            (found.start.p[0], found.end.p[0])
        };
        // The solution is x = cos t + tan(h/2) sin t − 1, and the step is symmetric.
        assert!((p0 - (size / 2.0).tan()).abs() < 1e-5 && (p0 + p1).abs() < 1e-14);
    }
    Ok(())
}

symplectic::hamiltonian! { pub Masses { a, b } q: [x, y], p: [px, py]; H = px^2/(2 a) + py^2/(2 b) + a x^4/4 }
symplectic::hamiltonian! { pub Quartic { a } q: [x], p: [px]; H = px^2/(2 a) + a x^4/4 }

/// Each momentum has its own difference, which moves the end even where the momentum is zero; each position its own rounding error.
#[test]
fn ends_are_solved_for_masses_of_any_size() -> Result<(), Error> {
    for heavy in [1e10, 1e-10, 1e30] {
        let masses = Masses { a: 1.0, b: heavy };
        let start: State<Plane> = State::from_arrays(0.0, [0.3, 0.7], [0.5, 0.0]);
        let run = Integrator::new(Gauss2, masses, start.clone(), 0.1)?;
        let q1 = Vector2::new(0.4, 0.7 + 1e-3);
        let found = run.type_one(&start.q, &q1)?;
        let velocity = found.start.p[1] / heavy;
        // 16 ε of the positions, divided by the step size.
        assert!((velocity - 1e-2).abs() < 1e-13, "{heavy:e}: {velocity}");
        // Heavy and at rest.
        let found = run.type_one(&start.q, &Vector2::new(0.4, 0.7))?;
        assert!((found.start.p[1] / heavy).abs() < 1e-13, "{heavy:e}");
    }
    // The same step in other units of mass, from rest.
    let velocity = |a: f64| {
        let rest = State::from_arrays(0.0, [0.3], [0.0]);
        let run = Integrator::new(Gauss2, Quartic { a }, rest, 0.1)?;
        let found = run.type_one(&Vector1::new(0.3), &Vector1::new(0.4))?;
        Ok::<_, Error>(found.start.p[0] / a)
    };
    let expected = velocity(1.0)?;
    for a in [1e-30, 1e-10, 1e10, 1e30] {
        assert!((velocity(a)? - expected).abs() < 1e-13, "{a:e}");
    }
    // A small position next to a large one is found as accurately as alone.
    let (small, large) = (1e-9, 1e9);
    let masses = Masses { a: 1.0, b: 1.0 };
    let start: State<Plane> =
        State::from_arrays(0.0, [0.3 * small, 0.7 * large], [0.5 * small, 0.2 * large]);
    let run = Integrator::new(Gauss2, masses, start.clone(), 0.1)?;
    let found = run.type_one(&start.q, &Vector2::new(0.4 * small, 0.75 * large))?;
    let velocities = (found.start.p[0] / small, found.start.p[1] / large);
    assert!(
        (velocities.0 - 1.0).abs() < 1e-13 && (velocities.1 - 0.5).abs() < 1e-13,
        "{velocities:?}"
    );
    // From rest, where there is no length to begin with, this momentum is still not determined.
    let rest = State::from_arrays(0.0, [0.7], [0.0]);
    let outcome = Integrator::new(Gauss2, Product, rest, 0.1)?
        .type_one(&Vector1::new(0.7), &Vector1::new(0.9));
    assert!(
        matches!(
            outcome,
            Err(Error::NoStart {
                component: Some(0),
                ..
            })
        ),
        "{outcome:?}"
    );
    Ok(())
}

/// A step from a given state does not depend on the past of the integrator.
#[test]
fn steps_of_a_lagrangian_forget_the_run() -> Result<(), Error> {
    let start: State<Plane> = State::from_arrays(0.0, [0.8, 0.3], [0.2, 0.7]);
    let fresh = LagrangianSteps::run(Gauss2, DoublePendulum, start.clone(), 0.25)?;
    let mut used = fresh.clone();
    for _ in 0..5 {
        used.step()?;
    }
    assert_eq!(used.step_from(start.clone())?, fresh.step_from(start)?);
    Ok(())
}
