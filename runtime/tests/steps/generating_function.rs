//! The Type II generating function: its derivatives are the step, its sum along an orbit solves the discrete
//! Hamilton–Jacobi equation.
//!
//! Bounds: everything here is of size 1 to 10, an iteration stops within a few roundings of its fixed point, and the
//! derivatives that dual numbers carry through it come to the same; 1e-14 is 50 roundings.

use std::error::Error as StdError;

use crate::common::dual::{Dual, dual};
use crate::common::systems::{Driven, Kepler, Pendulum, Product, point};

use crate::common::methods::{
    Askew, Gauss2, Gauss3, Lobatto3, Midpoint, Radau2, StoermerVerlet, SymplecticEuler,
};
use symplectic::nalgebra::{DVector, SVector, Vector1, Vector2};
use symplectic::solver::{Coefficient, Coefficients};
use symplectic::system::Conservative;
use symplectic::variational::{
    Error, GeneratingFunction, generating_function, step_with_generating_function,
};
use symplectic::{
    Error as CoreError, General, Hamiltonian, Integrator, Method, Orders, ProvedFor, Quantity,
    Scalar, State, System, hamiltonian, separable,
};

/// H = q·p, which has no Lagrangian (Leok & Zhang, Example 1).
#[derive(Clone, Copy)]
struct Degenerate;

impl Hamiltonian for Degenerate {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 1>;

    fn velocity<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 1>,
        _p: &SVector<T, 1>,
        velocity: &mut SVector<T, 1>,
    ) {
        *velocity = *q;
    }

    fn force<T: Scalar>(
        &self,
        _time: T,
        _q: &SVector<T, 1>,
        p: &SVector<T, 1>,
        force: &mut SVector<T, 1>,
    ) {
        *force = -*p;
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>) -> Option<T> {
        Some(q[0] * p[0])
    }
}

fn constants<const N: usize>(values: [f64; N]) -> SVector<Dual, N> {
    SVector::from(values.map(|x| dual(x, 0.0)))
}

/// The largest |p0 − D1 H_d⁺| and |q1 − D2 H_d⁺| in a component, the derivatives by dual numbers.
fn defect<M, S, const N: usize>(
    method: M,
    system: &S,
    (q0, p1): ([f64; N], [f64; N]),
    h: f64,
) -> Result<f64, Error>
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<SVector<Dual, N>, Class: Conservative>,
{
    let mut worst = 0.0_f64;
    for i in 0..N {
        let (mut q, p) = (constants(q0), constants(p1));
        q[i].derivative = 1.0;
        let by_q = generating_function(method, system, 0.0, &q, &p, h)?;
        worst = worst.max((by_q.value.derivative - by_q.p0[i].value).abs());
        let (q, mut p) = (constants(q0), constants(p1));
        p[i].derivative = 1.0;
        let by_p = generating_function(method, system, 0.0, &q, &p, h)?;
        worst = worst.max((by_p.value.derivative - by_p.q1[i].value).abs());
    }
    Ok(worst)
}

/// The same by central differences of order 4 in double precision.
fn defect_by_differences<M, S, const N: usize>(
    method: M,
    system: &S,
    (q0, p1): ([f64; N], [f64; N]),
    h: f64,
) -> Result<f64, Error>
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<SVector<f64, N>, Class: Conservative>,
{
    const DISTANCE: f64 = 1e-3;
    let (q0, p1) = (SVector::from(q0), SVector::from(p1));
    let value = |dq: SVector<f64, N>, dp: SVector<f64, N>| {
        generating_function(method, system, 0.0, &(q0 + dq), &(p1 + dp), h)
    };
    let zero = SVector::zeros();
    let at = value(zero, zero)?;
    let mut worst = 0.0_f64;
    for i in 0..N {
        let mut unit = SVector::zeros();
        unit[i] = DISTANCE;
        for (by_q, expected) in [(true, at.p0[i]), (false, at.q1[i])] {
            let shifted = |k: f64| {
                let both = if by_q {
                    value(unit * k, zero)
                } else {
                    value(zero, unit * k)
                };
                both.map(|generating| generating.value)
            };
            let near = shifted(1.0)? - shifted(-1.0)?;
            let far = shifted(2.0)? - shifted(-2.0)?;
            let difference = (8.0 * near - far) / (12.0 * DISTANCE);
            worst = worst.max((difference - expected).abs());
        }
    }
    Ok(worst)
}

macro_rules! for_every_method {
    ($check:ident) => {
        $check!(SymplecticEuler);
        $check!(Midpoint);
        $check!(StoermerVerlet);
        $check!(Lobatto3);
        $check!(Gauss3);
        $check!(Radau2);
        $check!(Askew);
    };
}

const PRODUCT: ([f64; 1], [f64; 1]) = ([0.5], [0.3]);
const KEPLER: ([f64; 2], [f64; 2]) = ([1.0, 0.2], [-0.1, 0.9]);

#[test]
fn the_derivatives_are_the_momentum_before_and_the_position_after() -> Result<(), Error> {
    macro_rules! check {
        ($method:ident) => {
            for h in [0.25, -0.25] {
                let product = defect($method, &Product, PRODUCT, h)?;
                let kepler = defect($method, &Kepler, KEPLER, h)?;
                let worst = product.max(kepler);
                assert!(worst < 1e-14, "{} {h}: {worst:e}", $method::NAME);
            }
        };
    }
    for_every_method!(check);
    Ok(())
}

#[test]
fn generating_functions_agree_with_differences() -> Result<(), Error> {
    macro_rules! check {
        ($method:ident) => {
            let product = defect_by_differences($method, &Product, PRODUCT, 0.25)?;
            let kepler = defect_by_differences($method, &Kepler, KEPLER, 0.25)?;
            let worst = product.max(kepler);
            // δ⁴/30 times a fifth derivative of 1/|q|, 5!·h: 1e-12. Rounding: a few 1e-16/1e-3.
            assert!(worst < 2e-12, "{}: {worst:e}", $method::NAME);
        };
    }
    for_every_method!(check);
    Ok(())
}

/// A method with the matrices of another one, and of its stages only the number.
macro_rules! impostor {
    ($name:ident: $coefficients:expr) => {
        #[derive(Clone, Copy, Debug)]
        struct $name;

        impl Method for $name {
            const NAME: &'static str = stringify!($name);
            const STAGES: usize = StoermerVerlet::STAGES;
            const DEFINITION: &'static str = "";
            const COEFFICIENTS: Coefficients = $coefficients;
            const ORDERS: Orders = StoermerVerlet::ORDERS;
            type General = <StoermerVerlet as Method>::General;
            type Separable = <StoermerVerlet as Method>::Separable;
        }

        impl<C> ProvedFor<C> for $name {}
    };
}

impostor! { Same: StoermerVerlet::COEFFICIENTS }
impostor! { Trapezoidal: Coefficients {
    a_tilde: StoermerVerlet::COEFFICIENTS.a,
    c_tilde: StoermerVerlet::COEFFICIENTS.c,
    ..StoermerVerlet::COEFFICIENTS
} }
impostor! { Perturbed: Coefficients {
    a: &[
        &[Coefficient::exact(0.0), Coefficient::exact(0.0)],
        &[Coefficient::exact(0.5 + 1e-6), Coefficient::exact(0.5)],
    ],
    ..StoermerVerlet::COEFFICIENTS
} }

#[test]
fn a_method_that_is_not_symplectic_has_no_generating_function() -> Result<(), Error> {
    assert!(defect(Same, &Product, PRODUCT, 0.25)? < 1e-14);
    // The trapezoidal rule: of order 2 and symmetric, but not symplectic.
    let trapezoidal = defect(Trapezoidal, &Product, PRODUCT, 0.25)?;
    assert!(trapezoidal > 1e-4, "{trapezoidal:e}");
    // One coefficient off by 1e-6, times h² and derivatives of order 1.
    let perturbed = defect(Perturbed, &Product, PRODUCT, 0.25)?;
    assert!((1e-9..1e-6).contains(&perturbed), "{perturbed:e}");
    Ok(())
}

/// Position and momentum at t_0, …, t_k with their derivatives by one parameter, and S_d^0, …, S_d^k (eq. 21).
type Orbit<const N: usize> = Vec<(State<SVector<Dual, N>>, Dual)>;

/// An orbit from `q0`, which is fixed, and `p0` + ε `direction`.
fn orbit<M, S, const N: usize>(
    method: M,
    system: S,
    (q0, p0): ([f64; N], [f64; N]),
    direction: usize,
    h: f64,
) -> Result<Orbit<N>, Error>
where
    M: Method + ProvedFor<S::Class>,
    S: System<SVector<Dual, N>, Class: Conservative>,
{
    let mut start = State::new(0.0, constants(q0), constants(p0));
    start.p[direction].derivative = 1.0;
    let mut integrator = Integrator::new(method, system, start.clone(), h)?;
    let mut extremum = start.p.dot(&start.q);
    let mut states = vec![(start, extremum)];
    for _ in 0..8 {
        let before = integrator.state().clone();
        let generating = step_with_generating_function(&mut integrator)?;
        // S^(k+1) = p_(k+1)·q_(k+1) − Σ [p_(l+1)·q_(l+1) − H_d⁺]: all but the new sum cancel.
        extremum += generating.value - before.p.dot(&before.q);
        states.push((integrator.state().clone(), extremum));
    }
    Ok(states)
}

#[test]
fn the_sum_along_an_orbit_solves_the_discrete_hamilton_jacobi_equation() -> Result<(), Error> {
    // Along 8 steps the errors of all steps add up, and those of the derivatives grow with the orbits.
    const BOUND: f64 = 1e-13;
    macro_rules! check {
        ($method:ident) => {
            let h = 0.2;
            // In one dimension DS^k(p_k) is a quotient: eq. 24, q_k = DS^k(p_k), and eq. 22 with it.
            let states = orbit($method, Product, PRODUCT, 0, h)?;
            for pair in states.windows(2) {
                let [(state, extremum), (next, after)] = pair else {
                    unreachable!("windows of two")
                };
                let slope = extremum.derivative / state.p[0].derivative;
                assert!((slope - state.q[0].value).abs() < BOUND, "{}", $method::NAME);
                let (q, p) = (Vector1::new(slope), Vector1::new(next.p[0].value));
                let generating = generating_function($method, &Product, 0.0, &q, &p, h)?;
                let left = after.value - extremum.value;
                let right = generating.value - state.p[0].value * slope;
                assert!((left - right).abs() < BOUND, "{}: {left} {right}", $method::NAME);
            }
            // In two, in the direction of the derivative: dS^k = DS^k·dp_k = q_k·dp_k.
            for direction in 0..2 {
                for (state, extremum) in orbit($method, Kepler, KEPLER, direction, h)? {
                    let pairs = state.q.iter().zip(state.p.iter());
                    let along: f64 = pairs.map(|(q, p)| q.value * p.derivative).sum();
                    assert!((extremum.derivative - along).abs() < BOUND, "{}", $method::NAME);
                }
            }
        };
    }
    for_every_method!(check);
    Ok(())
}

#[test]
fn a_sum_with_another_function_does_not() -> Result<(), Error> {
    // The negative twin: the generating function of another method of the same order, at the ends of the step.
    let start = State::new(
        0.0,
        Vector1::new(dual(0.5, 0.0)),
        Vector1::new(dual(0.3, 1.0)),
    );
    let extremum = start.p[0] * start.q[0];
    let mut integrator = Integrator::new(Midpoint, Product, start.clone(), 0.2)?;
    let end = integrator.step()?;
    let other = generating_function(StoermerVerlet, &Product, 0.0, &start.q, &end.p, 0.2)?;
    let after = extremum + other.value - start.p[0] * start.q[0];
    let slope = after.derivative / end.p[0].derivative;
    assert!((slope - end.q[0].value).abs() > 1e-5);
    Ok(())
}

#[test]
fn a_degenerate_hamiltonian_has_the_function_q0_p1_r() -> Result<(), Error> {
    fn check<M: Method + Copy + ProvedFor<General>>(
        method: M,
        stability: impl Fn(f64) -> f64,
    ) -> Result<(), Error> {
        for h in [0.5, 0.1, -0.3] {
            let (q0, p1) = (Vector1::new(1.5), Vector1::new(0.75));
            let GeneratingFunction { value, p0, q1 } =
                generating_function(method, &Degenerate, 0.0, &q0, &p1, h)?;
            let r = stability(h);
            let expected = [q0[0] * p1[0] * r, p1[0] * r, q0[0] * r];
            for (found, expected) in [value, p0[0], q1[0]].into_iter().zip(expected) {
                // The stages within a few roundings, enlarged by 1/(1 − h/2) or so.
                let error = (found / expected - 1.0).abs();
                assert!(error < 16.0 * f64::EPSILON, "{} {h}: {error:e}", M::NAME);
            }
            assert!(defect(method, &Degenerate, ([1.5], [0.75]), h)? < 1e-14);
        }
        Ok(())
    }
    // Padé approximations of e^h: diagonal for Gauss, and for Lobatto IIIA; (1, 2) for Radau IIA.
    check(SymplecticEuler, |h| 1.0 + h)?;
    check(Midpoint, |h| (1.0 + h / 2.0) / (1.0 - h / 2.0))?;
    let two = |h: f64| 1.0 + h / 2.0 + h * h / 12.0;
    check(Gauss2, |h| two(h) / two(-h))?;
    check(Lobatto3, |h| two(h) / two(-h))?;
    let three = |h: f64| 1.0 + h / 2.0 + h * h / 10.0 + h * h * h / 120.0;
    check(Gauss3, |h| three(h) / three(-h))?;
    check(Radau2, |h| {
        (1.0 + h / 3.0) / (1.0 - 2.0 * h / 3.0 + h * h / 6.0)
    })
}

#[test]
fn the_degenerate_function_tends_to_that_of_the_flow() -> Result<(), Error> {
    fn errors<M: Method + Copy + ProvedFor<General>>(method: M) -> Result<Vec<f64>, Error> {
        let (q0, p1) = (Vector1::new(1.5), Vector1::new(0.75));
        let error = |h: f64| {
            let generating = generating_function(method, &Degenerate, 0.0, &q0, &p1, h)?;
            Ok((generating.value - 1.5 * 0.75 * h.exp()).abs())
        };
        [0.1, 0.05, 0.025].into_iter().map(error).collect()
    }
    // Of order p, the error is of h^(p+1).
    for (errors, order) in [
        (errors(Midpoint)?, 2.0),
        (errors(Gauss2)?, 4.0),
        (errors(Radau2)?, 3.0),
    ] {
        for pair in errors.windows(2) {
            let slope = (pair[0] / pair[1]).log2();
            assert!((slope - order - 1.0).abs() < 0.1, "{order}: {errors:?}");
        }
    }
    Ok(())
}

#[test]
fn a_step_comes_with_its_generating_function() -> Result<(), Error> {
    fn check<M: Method + Copy>(method: M) -> Result<(), Error> {
        let start = State::new(0.0, Vector2::from(KEPLER.0), Vector2::from(KEPLER.1));
        let mut integrator = Integrator::new(method, Kepler, start.clone(), 0.1)?;
        let mut plain = Integrator::new(method, Kepler, start, 0.1)?;
        for step in 1..=20 {
            let before = integrator.state().clone();
            let generating = step_with_generating_function(&mut integrator)?;
            let after = integrator.state();
            assert_eq!(after, plain.step()?);
            assert_eq!(
                (integrator.steps(), integrator.iterations()),
                (step, plain.iterations())
            );
            assert!((generating.p0 - before.p).norm() < 1e-14);
            assert!((generating.q1 - after.q).norm() < 1e-14);
            let beside =
                generating_function(method, &Kepler, before.time, &before.q, &after.p, 0.1)?;
            assert_eq!(beside, generating);
        }
        Ok(())
    }
    check(StoermerVerlet)?;
    check(Gauss3)?;
    check(SymplecticEuler)
}

#[test]
fn a_refused_step_is_not_taken() -> Result<(), Error> {
    let silent = separable::<Vector1<f64>, _, _>(
        |_, p, velocity| *velocity = *p,
        |_, q, force| force[0] = -q[0].sin(),
    );
    let mut refused = Integrator::new(StoermerVerlet, silent, point(1.0, 0.5), 0.1)?;
    let mut plain = Integrator::new(StoermerVerlet, silent, point(1.0, 0.5), 0.1)?;
    for _ in 0..5 {
        let before = refused.state().clone();
        assert_eq!(
            step_with_generating_function(&mut refused),
            Err(Error::Core(CoreError::NoEnergy))
        );
        assert_eq!(refused.state(), &before);
        assert_eq!(refused.step()?, plain.step()?);
    }
    assert_eq!((refused.steps(), refused.iterations()), (5, 0));
    Ok(())
}

#[test]
fn vectors_and_scalars_of_all_kinds_have_it() -> Result<(), Error> {
    let (q, p) = ([0.5, 1.0, -0.25], [0.3, 0.0, 1.5]);
    let pendulum = Pendulum::default();
    let fixed = generating_function(
        Lobatto3,
        &pendulum,
        0.0,
        &SVector::from(q),
        &SVector::from(p),
        0.2,
    )?;
    let [dynamic_q, dynamic_p] = [q, p].map(|x| DVector::from_row_slice(&x));
    let dynamic = generating_function(Lobatto3, &pendulum, 0.0, &dynamic_q, &dynamic_p, 0.2)?;
    assert_eq!(fixed.value, dynamic.value);
    assert_eq!(fixed.q1.as_slice(), dynamic.q1.as_slice());
    assert_eq!(fixed.p0.as_slice(), dynamic.p0.as_slice());
    let [single_q, single_p] = [q, p].map(|x| SVector::from(x.map(|x| x as f32)));
    let single = generating_function(Lobatto3, &pendulum, 0.0, &single_q, &single_p, 0.2)?;
    // A few roundings of numbers below 4.
    assert!((f64::from(single.value) - fixed.value).abs() < 16.0 * f64::from(f32::EPSILON));
    Ok(())
}

#[test]
fn generating_functions_of_driven_systems_need_equal_nodes() -> Result<(), Box<dyn StdError>> {
    let (q, p) = (Vector1::new(dual(0.5, 1.0)), Vector1::new(dual(0.3, 0.0)));
    let driven = separable::<Vector1<Dual>, _, _>(
        |_, p, velocity| *velocity = *p,
        |time, q, force| force[0] = time.cos() - q[0],
    )
    .with_energy(|time, q, p| {
        (p[0] * p[0] + q[0] * q[0]) * Dual::from_f64(0.5) - q[0] * time.cos()
    });
    // Gauss has c̃ = c.
    let generating = generating_function(Gauss2, &driven, 0.7, &q, &p, 0.25)?;
    assert!((generating.value.derivative - generating.p0[0].value).abs() < 1e-14);
    let outcome = generating_function(StoermerVerlet, &driven, 0.75, &q, &p, 0.25);
    let Err(error) = outcome else {
        return Err("a value".into());
    };
    assert_eq!(
        error,
        Error::DifferentNodes {
            stage: 1,
            position_time: 0.75,
            momentum_time: 0.875
        }
    );
    let text = "the energy depends on time, and stage 1 has the time 0.75 for the position and 0.875 for the \
                momentum; take a method with c = c̃";
    assert_eq!(error.to_string(), text);
    Ok(())
}

#[test]
fn generating_functions_refuse_bad_input() {
    let [one, none, infinite] = [1.0, f64::NAN, f64::INFINITY].map(Vector1::new);
    let pendulum = Pendulum::default();
    let ask = |q: &Vector1<f64>, p: &Vector1<f64>, h| {
        generating_function(Gauss2, &pendulum, 0.0, q, p, h).map(|generating| generating.value)
    };
    assert_eq!(
        ask(&one, &one, 0.0),
        Err(Error::Core(CoreError::StepSize { value: 0.0 }))
    );
    let what = Quantity::Position;
    assert_eq!(
        ask(&infinite, &one, 0.1),
        Err(Error::Core(CoreError::NonFiniteState { what }))
    );
    let what = Quantity::Momentum;
    assert!(ask(&one, &none, 0.1) == Err(Error::Core(CoreError::NonFiniteState { what })));
    let (short, long) = (DVector::zeros(1), DVector::zeros(2));
    assert_eq!(
        generating_function(Gauss2, &pendulum, 0.0, &short, &long, 0.1),
        Err(Error::Core(CoreError::Dimension {
            position: 1,
            momentum: 2
        }))
    );
    assert_eq!(
        generating_function(Gauss2, &Driven, 0.0, &one, &one, 0.1),
        Err(Error::Core(CoreError::NoEnergy))
    );
    // Stages that are h times a velocity of 10⁶ apart.
    let wild = hamiltonian::<Vector1<f64>, _, _>(
        |_, q, p, velocity| velocity[0] = 1e6 * (p[0] + q[0]).cos(),
        |_, q, p, force| force[0] = -1e6 * (p[0] + q[0]).cos(),
    );
    let outcome = generating_function(Gauss2, &wild, 2.0, &one, &one, 0.5);
    assert!(matches!(
        outcome,
        Err(Error::Core(CoreError::NoConvergence {
            time: 2.0,
            step_size: 0.5,
            step: 1,
            iterations: 200,
            ..
        }))
    ));
    let bottomless = wild.with_energy(|_, _, _| f64::NAN);
    assert_eq!(
        generating_function(Gauss2, &bottomless, 2.0, &one, &one, 1e-9),
        Err(Error::Core(CoreError::NonFinite {
            time: 2.0,
            step_size: 1e-9,
            step: 1,
            what: Quantity::Energy,
            stage: Some(1)
        }))
    );
    let growing = separable::<DVector<f64>, _, _>(
        |_, p, velocity| velocity.copy_from(p),
        |_, _, force| *force = DVector::zeros(3),
    );
    assert_eq!(
        generating_function(Gauss2, &growing, 0.0, &long, &long, 0.1),
        Err(Error::Core(CoreError::EvaluationDimension {
            time: 0.0,
            step_size: 0.1,
            step: 1,
            what: Quantity::Force,
            stage: Some(1),
            expected: 2,
            found: 3
        }))
    );
}
