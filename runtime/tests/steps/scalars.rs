//! The same systems over other numbers and other vectors.

use crate::common::dual::{Dual, dual};
use crate::common::methods::{Midpoint, StoermerVerlet};
use crate::common::run;
use crate::common::systems::{Pendulum, Product, point};
use symplectic::nalgebra::{DVector, SVector, Vector1};
use symplectic::{
    Error, Integrator, Method, ProvedFor, Scalar, State, System, Vector, hamiltonian, separable,
};

#[test]
fn single_precision_follows_double() -> Result<(), Error> {
    let single = State::new(0.0, Vector1::new(0.5_f32), Vector1::new(0.3_f32));
    for (coarse, fine) in [
        (
            run(
                StoermerVerlet,
                Pendulum::default(),
                single.clone(),
                2.0,
                100,
            )?,
            run(
                StoermerVerlet,
                Pendulum::default(),
                point(0.5, 0.3),
                2.0,
                100,
            )?,
        ),
        (
            run(Midpoint, Product, single.clone(), 2.0, 100)?,
            run(Midpoint, Product, point(0.5, 0.3), 2.0, 100)?,
        ),
    ] {
        // 100 steps with a few roundings of 6e-8 each.
        let difference = (f64::from(coarse.q[0]) - fine.q[0]).abs();
        assert!(difference < 2e-5 && difference > 0.0, "{difference:e}");
    }
    Ok(())
}

#[test]
fn dual_numbers_differentiate_the_flow() -> Result<(), Error> {
    fn check<M, S>(method: M, system: impl Fn() -> S) -> Result<(), Error>
    where
        M: Method
            + Copy
            + ProvedFor<<S as System<Vector1<f64>>>::Class>
            + ProvedFor<<S as System<Vector1<Dual>>>::Class>,
        S: System<Vector1<f64>> + System<Vector1<Dual>>,
    {
        let q = |q0: f64| Ok(run(method, system(), point(q0, 0.3), 2.0, 50)?.q[0]);
        let start = State::new(
            0.0,
            Vector1::new(dual(0.5, 1.0)),
            Vector1::new(dual(0.3, 0.0)),
        );
        let end = run(method, system(), start, 2.0, 50)?;
        let difference = (q(0.5 + 1e-5)? - q(0.5 - 1e-5)?) / 2e-5;
        // Central differences: truncation 1e-10, rounding 1e-16/1e-5.
        let derivative = end.q[0].derivative;
        assert!(
            (derivative - difference).abs() < 1e-8,
            "{derivative} {difference}"
        );
        assert!((derivative - 1.0).abs() > 0.1);
        assert!((end.q[0].value - q(0.5)?).abs() < 1e-14);
        Ok(())
    }
    check(StoermerVerlet, Pendulum::default)?;
    check(Midpoint, Pendulum::default)?;
    check(StoermerVerlet, || Product)?;
    check(Midpoint, || Product)
}

#[test]
fn derivatives_converge_too() -> Result<(), Error> {
    // Where the iteration stopped with the values, the derivatives would still be on their way.
    let start = State::new(
        0.0,
        Vector1::new(dual(0.5, 1.0)),
        Vector1::new(dual(0.3, 0.0)),
    );
    let other = State::new(
        0.0,
        Vector1::new(dual(0.5, 0.0)),
        Vector1::new(dual(0.3, 1.0)),
    );
    let (by_q, by_p) = (
        run(Midpoint, Product, start, 2.0, 20)?,
        run(Midpoint, Product, other, 2.0, 20)?,
    );
    // The flow is symplectic: in one degree of freedom its Jacobian has determinant 1.
    let determinant =
        by_q.q[0].derivative * by_p.p[0].derivative - by_q.p[0].derivative * by_p.q[0].derivative;
    assert!(
        (determinant - 1.0).abs() < 20.0 * 32.0 * f64::EPSILON,
        "{determinant}"
    );
    Ok(())
}

#[test]
fn dynamic_vectors_give_the_same_bits() -> Result<(), Error> {
    fn compare<M: Method + Copy>(method: M) -> Result<(), Error> {
        let (q, p) = ([0.5, 1.0, -0.25], [0.3, 0.0, 1.5]);
        let fixed = State::new(0.0, SVector::from(q), SVector::from(p));
        let dynamic = State::new(
            0.0,
            DVector::from_row_slice(&q),
            DVector::from_row_slice(&p),
        );
        let fixed = run(method, Pendulum::default(), fixed, 5.0, 100)?;
        let dynamic = run(method, Pendulum::default(), dynamic, 5.0, 100)?;
        assert_eq!(fixed.q.as_slice(), dynamic.q.as_slice());
        assert_eq!(fixed.p.as_slice(), dynamic.p.as_slice());
        Ok(())
    }
    compare(StoermerVerlet)?;
    compare(Midpoint)
}

#[test]
fn closures_are_systems() -> Result<(), Error> {
    let split = separable::<Vector1<f64>, _, _>(
        |_, p, velocity| *velocity = *p,
        |_, q, force| force[0] = -q[0].sin(),
    );
    let by_trait = run(
        StoermerVerlet,
        Pendulum::default(),
        point(1.0, 0.5),
        1.0,
        10,
    )?;
    assert_eq!(
        run(StoermerVerlet, split, point(1.0, 0.5), 1.0, 10)?,
        by_trait
    );

    let whole = hamiltonian(
        |_, q: &Vector1<f64>, p, velocity| velocity[0] = p[0] * (q.dot(q) + 1.0),
        |_, q, p, force| *force = -q * (p.dot(p) + 1.0),
    );
    let by_trait = run(Midpoint, Product, point(0.5, 0.3), 1.0, 10)?;
    assert_eq!(run(Midpoint, whole, point(0.5, 0.3), 1.0, 10)?, by_trait);

    let integrator = Integrator::new(Midpoint, whole, point(0.5, 0.3), 0.1)?;
    assert_eq!(integrator.energy(), None);
    let whole = whole.with_energy(|_, q, p| (q[0] * q[0] + 1.0) * (p[0] * p[0] + 1.0) / 2.0);
    let integrator = Integrator::new(Midpoint, whole, point(1.0, 1.0), 0.1)?;
    assert_eq!(integrator.energy(), Some(2.0));
    let split = split.with_energy(|time, q, p| time + q[0] + p[0]);
    let start = State {
        time: 4.0,
        ..point(1.0, 2.0)
    };
    assert_eq!(
        Integrator::new(Midpoint, split, start, 0.1)?.energy(),
        Some(7.0)
    );

    let dynamic = hamiltonian::<DVector<f64>, _, _>(
        |_, q, p, velocity| velocity[0] = p[0] * (q.dot(q) + 1.0),
        |_, q, p, force| force[0] = -q[0] * (p.dot(p) + 1.0),
    );
    let start = State::new(
        0.0,
        DVector::from_element(1, 0.5),
        DVector::from_element(1, 0.3),
    );
    assert_eq!(run(Midpoint, dynamic, start, 1.0, 10)?.q[0], by_trait.q[0]);
    Ok(())
}

#[test]
fn systems_without_degrees_of_freedom_advance_the_time() -> Result<(), Error> {
    fn steps<M: Method, V: Vector>(method: M, nothing: V) -> Result<(), Error> {
        let start = State::new(0.0, nothing.clone(), nothing);
        let mut integrator = Integrator::new(method, Pendulum::default(), start, 0.5)?;
        assert_eq!(integrator.integrate_to(2.0)?.time, 2.0);
        assert_eq!(integrator.energy(), None);
        Ok(())
    }
    steps(StoermerVerlet, SVector::<f64, 0>::zeros())?;
    steps(Midpoint, SVector::<f64, 0>::zeros())?;
    steps(StoermerVerlet, DVector::<f64>::zeros(0))?;
    steps(Midpoint, DVector::<f64>::zeros(0))
}

#[test]
fn functions_of_f32_and_f64_satisfy_their_identities() {
    fn check<T: Scalar>(tolerance: f64) {
        let x = T::from_f64(0.5);
        let one = T::one();
        let (sine, cosine) = x.sin_cos();
        for (i, zero) in [
            x.sqrt() * x.sqrt() - x,
            x.recip() - one - one,
            x.powi(-2) * x * x - one,
            (-x).abs() - x,
            x.exp().ln() - x,
            x.sin().asin() - x,
            x.cos().acos() - x,
            x.tan().atan() - x,
            x.sin() / x.cos() - x.tan(),
            x.cosh() - (x.exp() + (-x).exp()) * x,
            x.sinh() - (x.exp() - (-x).exp()) * x,
            x.sinh() / x.cosh() - x.tanh(),
            sine * sine + cosine * cosine - one,
        ]
        .into_iter()
        .enumerate()
        {
            assert!(zero.magnitude() <= 4.0 * tolerance, "{i}: {zero:?}");
        }
        assert!(T::from_f64(f64::NAN).magnitude().is_nan());
        assert!(!T::from_f64(f64::INFINITY).is_finite() && x.is_finite());
        assert!((one + T::from_f64(T::EPSILON)) != one);
        assert!((one + T::from_f64(T::EPSILON / 4.0)) == one);
    }
    check::<f32>(f64::from(f32::EPSILON));
    check::<f64>(f64::EPSILON);
}
