//! Stages in lanes.

use std::fmt::Debug;

use symplectic::nalgebra::{DVector, SVector, Vector2};
use symplectic::{
    Error, F64x4, F64x8, General, Hamiltonian, HamiltonianInLanes, Integrator, Lanes, Method,
    Quantity, Scalar, SeparableHamiltonian, State, Vector, tableau,
};

tableau! { Gauss1 { basis: polynomial(1), nodes: gauss(1) } }
tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
tableau! { Gauss3 { basis: polynomial(3), nodes: gauss(3) } }
tableau! { Gauss5 { basis: polynomial(5), nodes: gauss(5) } }
tableau! { Gauss8 { basis: polynomial(8), nodes: gauss(8) } }
tableau! { Gauss10 { basis: polynomial(10), nodes: gauss(10) } }
tableau! { Lobatto4 { basis: polynomial(4), nodes: lobatto(4) } }
tableau! { Radau3 { basis: polynomial(3), nodes: radau-right(3) } }
tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }

struct Kepler;

impl<T: Scalar> SeparableHamiltonian<SVector<T, 2>> for Kepler {
    fn velocity(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = *p;
    }

    fn force(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        let square = q.dot(q);
        *force = -q * (square * square.sqrt()).recip();
    }
}

/// H = (q² + 1)(p² + 1)/2 + q sin t, in each component.
struct Coupled;

macro_rules! coupled {
    ($V:ty, $($parameter:tt)*) => {
        impl<$($parameter)*> Hamiltonian<$V> for Coupled {
            type Class = General;

            fn velocity(&self, _time: T, q: &$V, p: &$V, velocity: &mut $V) {
                for k in 0..q.len() {
                    velocity[k] = p[k] * (q[k] * q[k] + T::one());
                }
            }

            fn force(&self, time: T, q: &$V, p: &$V, force: &mut $V) {
                for k in 0..q.len() {
                    force[k] = -q[k] * (p[k] * p[k] + T::one()) - time.sin();
                }
            }
        }
    };
}
coupled!(SVector<T, 3>, T: Scalar);
coupled!(DVector<T>, T: Scalar);

/// Both ways for 100 steps; they have to agree to the last bit, and in the number of sweeps.
fn compare<M, S, V>(
    method: M,
    system: impl Fn() -> S,
    start: &State<V>,
    h: f64,
) -> Result<(), Error>
where
    M: Method,
    S: HamiltonianInLanes<V>,
    V: Vector<Scalar = f64> + Debug,
{
    let mut one_by_one = Integrator::new(method, system(), start.clone(), h)?;
    let mut in_lanes = Integrator::new(method, system(), start.clone(), h)?.in_lanes();
    for step in 0..100 {
        let expected = one_by_one.step()?;
        assert_eq!(in_lanes.step()?, expected, "{} step {step}", M::NAME);
        assert_eq!(in_lanes.remainder(), one_by_one.remainder(), "{}", M::NAME);
    }
    assert_eq!(
        in_lanes.iterations(),
        one_by_one.iterations(),
        "{}",
        M::NAME
    );
    let mut one_by_one = Integrator::plain(method, system(), start.clone(), h)?;
    let mut in_lanes = Integrator::plain(method, system(), start.clone(), h)?.in_lanes();
    for _ in 0..100 {
        assert_eq!(in_lanes.step()?, one_by_one.step()?, "{} plain", M::NAME);
    }
    Ok(())
}

#[test]
fn lanes_give_the_same_bits() -> Result<(), Error> {
    fn check<M: Method>(method: M) -> Result<(), Error> {
        let kepler = State::new(0.0, Vector2::new(0.4, 0.0), Vector2::new(0.0, 2.0));
        compare(method, || Kepler, &kepler, 0.03)?;
        let (q, p) = (
            SVector::from([0.5, -0.3, 0.9]),
            SVector::from([1.0, 0.25, -0.5]),
        );
        compare(method, || Coupled, &State::new(0.0, q, p), 0.05)?;
        let (q, p) = (
            DVector::from_column_slice(q.as_slice()),
            DVector::from_column_slice(p.as_slice()),
        );
        compare(method, || Coupled, &State::new(0.0, q, p), -0.05)
    }
    check(Gauss1)?;
    check(Gauss2)?;
    check(Gauss3)?;
    check(Gauss5)?;
    check(Gauss8)?;
    check(Gauss10)
}

/// A function in lanes and of doubles.
type Function<L> = (fn(L) -> L, fn(f64) -> f64);

/// Elementary functions in lanes are those of the doubles.
#[test]
fn functions_are_taken_lane_by_lane() {
    fn check<L: Lanes>() {
        let value = |lane: usize| 0.1 + 0.1 * lane as f64;
        let x = L::from_fn(value);
        let functions: [Function<L>; 13] = [
            (L::sqrt, f64::sqrt),
            (L::recip, f64::recip),
            (L::abs, f64::abs),
            (L::exp, f64::exp),
            (L::ln, f64::ln),
            (L::sin, f64::sin),
            (L::cos, f64::cos),
            (L::tan, f64::tan),
            (L::asin, f64::asin),
            (L::acos, f64::acos),
            (L::atan, f64::atan),
            (L::sinh, f64::sinh),
            (L::cosh, f64::cosh),
        ];
        for (in_lanes, alone) in functions {
            for (lane, &found) in in_lanes(x).to_array().as_ref().iter().enumerate() {
                assert_eq!(found, alone(value(lane)));
            }
        }
        for exponent in [-3, -1, 0, 1, 2, 7] {
            for (lane, &found) in x.powi(exponent).to_array().as_ref().iter().enumerate() {
                assert_eq!(found, Scalar::powi(value(lane), exponent));
            }
        }
        let mixed = L::from_fn(|lane| if lane == 1 { f64::NAN } else { -(lane as f64) });
        assert!(mixed.magnitude().is_nan());
        assert_eq!(
            L::from_fn(|lane| -(lane as f64)).magnitude(),
            (L::WIDTH - 1) as f64
        );
    }
    check::<F64x4>();
    check::<F64x8>();
}

/// Where the stages at the ends are the ends themselves, they are left out of the iteration stage by stage.
/// For a separable system nothing is left to iterate of Störmer–Verlet.
#[test]
fn methods_with_stages_at_the_ends_agree_up_to_rounding() -> Result<(), Error> {
    fn check<M: Method>(method: M) -> Result<(), Error> {
        let start = State::new(0.0, Vector2::new(0.4, 0.0), Vector2::new(0.0, 2.0));
        let mut one_by_one = Integrator::new(method, Kepler, start.clone(), 0.03)?;
        let mut in_lanes = Integrator::new(method, Kepler, start, 0.03)?.in_lanes();
        for _ in 0..100 {
            let (expected, found) = (one_by_one.step()?, in_lanes.step()?);
            // Ten units in the last place, growing with the steps as errors on a Kepler orbit do.
            assert!((found.q - expected.q).norm() < 1e-12);
        }
        Ok(())
    }
    check(Lobatto4)?;
    check(Radau3)?;
    let start = State::new(0.0, Vector2::new(0.4, 0.0), Vector2::new(0.0, 2.0));
    compare(StoermerVerlet, || Kepler, &start, 0.01)
}

/// A force that is not finite beyond q = 1.
struct Wall;

impl<T: Scalar> SeparableHamiltonian<SVector<T, 1>> for Wall {
    fn velocity(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
        *velocity = *p;
    }

    fn force(&self, _time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
        force[0] = (T::one() - q[0]).ln();
    }
}

#[test]
fn what_is_not_finite_is_named_with_its_stage() -> Result<(), Error> {
    let start = State::new(0.0, SVector::from([0.9]), SVector::from([1.0]));
    let mut integrator = Integrator::new(Gauss3, Wall, start.clone(), 0.15)?.in_lanes();
    let error = integrator.step().expect_err("beyond the wall");
    // The third stage is at 0.9 + 0.89·0.15 > 1, the second is not.
    assert!(
        matches!(
            error,
            Error::NonFinite {
                what: Quantity::Force,
                stage: Some(3),
                ..
            }
        ),
        "{error:?}"
    );
    assert_eq!(integrator.state(), &start);
    Ok(())
}

/// The same method without its momentum stages.
#[test]
fn second_order_systems_need_no_momentum_stages() -> Result<(), Error> {
    fn check<M: Method>(method: M) -> Result<(), Error> {
        let start = State::new(0.0, Vector2::new(0.4, 0.0), Vector2::new(0.0, 2.0));
        let mut whole = Integrator::new(method, Kepler, start.clone(), 0.03)?.in_lanes();
        let mut half = Integrator::new(method, Kepler, start, 0.03)?.in_second_order_lanes()?;
        for _ in 0..100 {
            let (expected, found) = (whole.step()?, half.step()?);
            assert!((found.q - expected.q).norm() < 1e-12, "{}", M::NAME);
            assert!((found.p - expected.p).norm() < 1e-12, "{}", M::NAME);
        }
        let [half, whole] = [half.statistics(), whole.statistics()].map(|s| s.evaluations);
        assert!(half < whole || M::NAME == "StoermerVerlet", "{}", M::NAME);
        Ok(())
    }
    check(Gauss1)?;
    check(Gauss3)?;
    check(Gauss8)?;
    check(Gauss10)?;
    check(Lobatto4)?;
    check(Radau3)?;
    check(StoermerVerlet)
}

/// Particles of mass 2.
struct Heavy;

impl<T: Scalar> SeparableHamiltonian<SVector<T, 2>> for Heavy {
    fn velocity(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = p * T::from_f64(0.5);
    }

    fn force(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        *force = -q;
    }
}

#[test]
fn a_velocity_that_is_not_the_momentum_is_refused() -> Result<(), Error> {
    // At rest the two agree.
    let start = State::new(0.0, Vector2::new(0.4, 0.0), Vector2::zeros());
    let integrator = Integrator::new(Gauss2, Heavy, start, 0.1)?;
    let error = integrator.in_second_order_lanes().expect_err("a mass");
    let (velocity, momentum) = (0.375, 0.75);
    assert_eq!(
        error,
        Error::NotSecondOrder {
            component: 0,
            velocity,
            momentum
        }
    );
    Ok(())
}
