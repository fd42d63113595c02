//! The order of discrete Lagrangians, observed along orbits.

use crate::methods::Gauss6;
use symplectic::nalgebra::{DVector, SVector, Vector1};
use symplectic::variational::{DiscreteLagrangian, Error, observed_order};
use symplectic::{
    Error as CoreError, Integrator, Scalar, State, System, Vector, system::Unconstrained,
};

use super::discrete_lagrangians::{
    AtOnePoint, AtTwoPoints, DoublePendulum, Kepler, Pendulum, Shaken, ShakenLagrangian, Simpson,
    Trapezoid,
};
use super::forces::Ring;

/// The orbit from a state, by Gauss with six stages.
fn orbit<S, V>(system: S, start: State<V>) -> impl Fn(f64) -> Result<State<V>, Error>
where
    S: System<V, Class: Unconstrained> + Copy,
    V: Vector<Scalar = f64>,
{
    move |time| {
        let mut run = Integrator::new(Gauss6, system, start.clone(), 0.05)?;
        Ok(run.integrate_to(time)?.clone())
    }
}

/// Checks the order at two step sizes.
fn check<L: DiscreteLagrangian>(
    name: &str,
    lagrangian: &L,
    orbit: impl Fn(f64) -> Result<State<L::Vector<f64>>, Error>,
    (time, h): (f64, f64),
    order: f64,
) {
    for h in [h, h / 2.0] {
        let found = observed_order(lagrangian, &orbit, time, h).expect("momenta");
        assert!((found - order).abs() < 0.05, "{name}, h = {h}: {found}");
    }
}

#[test]
fn observed_orders_of_quadratures_are_the_known_ones() {
    symplectic::hamiltonian! {
        Swinging
        q: [x], p: [px];
        H = px^2/2 - cos(x)
    }
    let swinging = orbit(Swinging, State::from_arrays(0.0, [1.0], [0.4]));
    check("midpoint", &Pendulum(0.5), &swinging, (0.4, 0.04), 2.0);
    check("α = 0.3", &Pendulum(0.3), &swinging, (0.4, 0.02), 1.0);
    check("α = 1", &Pendulum(1.0), &swinging, (0.4, 0.02), 1.0);
    check("Lobatto", &Simpson, &swinging, (1.2, 0.08), 4.0);
    let double = orbit(
        DoublePendulum,
        State::from_arrays(0.0, [1.0, -0.4], [0.5, 0.2]),
    );
    check("midpoint", &AtOnePoint(0.5), &double, (0.4, 0.01), 2.0);
    check("α = 0.2", &AtOnePoint(0.2), &double, (0.4, 0.01), 1.0);
    check("both", &AtTwoPoints(0.2), &double, (0.4, 0.01), 2.0);
    let planet = orbit(Kepler, State::from_arrays(0.0, [0.4, 0.0], [0.0, 2.0]));
    check("trapezoid", &Trapezoid, &planet, (0.4, 0.005), 2.0);
}

/// With the time, and over vectors on the heap.
#[test]
fn observed_order_of_a_time_dependent_lagrangian_is_two() {
    let fixed = orbit(Shaken, State::from_arrays(0.0, [1.0], [0.3]));
    let shaken = |time| {
        let state = fixed(time)?;
        Ok(State::from_slices(
            time,
            state.q.as_slice(),
            state.p.as_slice(),
        )?)
    };
    check::<ShakenLagrangian>("midpoint", &ShakenLagrangian, shaken, (0.4, 0.005), 2.0);
}

/// The discrete forces count: with half of `h f` at each end the order is 2, with all of it at the start 1.
#[test]
fn observed_order_depends_on_the_discrete_forces() {
    #[derive(Clone, Copy)]
    struct Drag {
        end: f64,
    }
    type V2<T> = SVector<T, 2>;
    impl DiscreteLagrangian for Drag {
        type Vector<T: Scalar> = V2<T>;

        fn value<T: Scalar>(&self, _: T, h: T, q0: &V2<T>, q1: &V2<T>) -> T {
            let half = T::from_f64(0.5);
            let (q, v) = ((q0 + q1) * half, (q1 - q0) * h.recip());
            let r = q.dot(&q);
            h * (v.dot(&v) * half - r * (r - T::one()).powi(2))
        }

        const FORCED: bool = true;

        fn forces<T: Scalar>(
            &self,
            _: T,
            _: T,
            q0: &V2<T>,
            q1: &V2<T>,
            minus: &mut V2<T>,
            plus: &mut V2<T>,
        ) {
            let impulse = (q0 - q1) * T::from_f64(0.25);
            *minus = impulse * T::from_f64(1.0 - self.end);
            *plus = impulse * T::from_f64(self.end);
        }
    }
    let start = State::from_arrays(0.0, [1.25, 0.0], [0.0, 0.5]);
    let ring = |time| {
        let mut run = Integrator::new(Gauss6, Ring { gamma: 0.25 }, start.clone(), 0.05)?;
        Ok(run.integrate_to(time)?.clone())
    };
    check("half", &Drag { end: 0.5 }, ring, (0.4, 0.01), 2.0);
    check("at the start", &Drag { end: 0.0 }, ring, (0.4, 0.01), 1.0);
}

#[test]
fn an_orbit_that_does_not_solve_the_equations_has_no_order() {
    let free = |time: f64| Ok(State::from_arrays(time, [time], [1.0]));
    let ask = |h| observed_order(&Pendulum(0.5), free, 1.0, h);
    assert_eq!(
        ask(0.0),
        Err(Error::Core(CoreError::StepSize { value: 0.0 }))
    );
    // Free motion is no orbit of the pendulum: the force is missing.
    assert!((ask(0.01).expect("momenta") - 1.0).abs() < 0.05);
    // An orbit with a NaN has no order, wherever the NaN is.
    for p in [[f64::NAN, 1.0], [1.0, f64::NAN]] {
        let broken = |time: f64| Ok(State::from_arrays(time, [1.0, time], p));
        let order = observed_order(&AtOnePoint(0.5), broken, 0.0, 0.1).expect("momenta");
        assert!(order.is_nan(), "{p:?}: {order}");
    }
    let growing = |time: f64| {
        let n = if time > 0.0 { 2 } else { 1 };
        Ok(State::new(time, DVector::zeros(n), DVector::zeros(n)))
    };
    assert!(matches!(
        observed_order(&ShakenLagrangian, growing, 0.0, 0.1),
        Err(Error::Core(CoreError::Dimension { .. }))
    ));
    let failing =
        |_: f64| -> Result<State<Vector1<f64>>, Error> { Err(Error::Core(CoreError::NoStep)) };
    assert_eq!(
        observed_order(&Pendulum(0.5), failing, 0.0, 0.1),
        Err(Error::Core(CoreError::NoStep))
    );
}
