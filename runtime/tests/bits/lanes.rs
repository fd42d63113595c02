//! Stages in lanes.

use std::cell::Cell;
use std::fmt::Debug;

use crate::common::methods::{
    Gauss2, Gauss3, Gauss5, Gauss8, Gauss10, Gauss18, Lobatto4, Midpoint, Radau3, RadauIIA,
    StoermerVerlet, Twins,
};
use crate::common::systems::{Kepler, Product, perihelion};
use symplectic::nalgebra::{DVector, SVector, Vector1, Vector2};
use symplectic::simd::{F64x2, F64x4, F64x8, F64x16, Lanes};
use symplectic::solver::{FixedPoint, SimdFixedPoint, SimdJacobi, Solver};
use symplectic::system::Masses;
use symplectic::system::SystemInLanes;
use symplectic::{
    Compensated, Error, General, Hamiltonian, Integrator, Method, Plain, ProvedFor, Quantity,
    Scalar, Separable, SeparableHamiltonian, State, Summation, System, Vector,
};

/// H = (q² + 1)(p² + 1)/2 + q sin t, in each component.
#[derive(Clone, Copy)]
struct Coupled;

macro_rules! coupled {
    ($V:ty, $($parameter:tt)*) => {
        impl<$($parameter)*> System<$V> for Coupled {
            type Class = General;
            type Solver = FixedPoint;

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
    M: Method + Copy + ProvedFor<<S as System<V>>::Class>,
    S: SystemInLanes<V>,
    V: Vector<Scalar = f64> + Debug,
{
    let mut one_by_one =
        Integrator::new(method, system(), start.clone(), h)?.with_solver(FixedPoint);
    let mut in_lanes =
        Integrator::new(method, system(), start.clone(), h)?.with_solver(SimdFixedPoint);
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
    let mut one_by_one =
        Integrator::plain(method, system(), start.clone(), h)?.with_solver(FixedPoint);
    let mut in_lanes =
        Integrator::plain(method, system(), start.clone(), h)?.with_solver(SimdFixedPoint);
    for _ in 0..100 {
        assert_eq!(in_lanes.step()?, one_by_one.step()?, "{} plain", M::NAME);
    }
    Ok(())
}

/// Of long vectors; of short ones see `matrix.rs`.
#[test]
#[ignore = "thorough"]
fn lanes_give_the_same_bits() -> Result<(), Error> {
    fn check<M: Method + Copy + ProvedFor<General>>(
        method: M,
        n: usize,
        h: f64,
    ) -> Result<(), Error> {
        let wave = |phase: f64| DVector::from_fn(n, |k, _| (phase + 1.3 * k as f64).sin());
        compare(
            method,
            || Coupled,
            &State::new(0.0, wave(0.1), wave(2.0)),
            h,
        )
    }
    check(Midpoint, 3, -0.05)?;
    check(Gauss3, 19, 0.05)?;
    check(Gauss5, 19, -0.05)?;
    check(Gauss8, 3, 0.05)?;
    check(Gauss10, 19, 0.05)
}

/// A function in lanes and of doubles.
type Function<L> = (fn(L) -> L, fn(f64) -> f64);

/// Elementary functions in lanes are those of the doubles.
#[test]
fn elementary_functions_in_lanes_are_those_of_doubles() {
    fn check<L: Lanes>() {
        let value = |lane: usize| 0.1 + 0.05 * lane as f64;
        let x = L::from_fn(value);
        let functions: [Function<L>; 13] = [
            (L::sqrt, Scalar::sqrt),
            (L::recip, Scalar::recip),
            (L::abs, Scalar::abs),
            (L::exp, Scalar::exp),
            (L::ln, Scalar::ln),
            (L::sin, Scalar::sin),
            (L::cos, Scalar::cos),
            (L::tan, Scalar::tan),
            (L::asin, Scalar::asin),
            (L::acos, Scalar::acos),
            (L::atan, Scalar::atan),
            (L::sinh, Scalar::sinh),
            (L::cosh, Scalar::cosh),
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
    check::<F64x2>();
    check::<F64x4>();
    check::<F64x8>();
    check::<F64x16>();
}

/// A force that is not finite beyond q = 1.
struct Wall;

impl SeparableHamiltonian for Wall {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
        force[0] = (T::one() - q[0]).ln();
    }
}

/// [`Wall`], said to have masses of one.
struct LightWall;

impl SeparableHamiltonian for LightWall {
    type Vector<T: Scalar> = SVector<T, 1>;

    const MASSES: Masses = Masses::Unit;

    fn velocity<T: Scalar>(&self, time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
        SeparableHamiltonian::velocity(&Wall, time, p, velocity);
    }

    fn force<T: Scalar>(&self, time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
        SeparableHamiltonian::force(&Wall, time, q, force);
    }
}

/// The third stage of a step of 0.15 from 0.9 with the velocity 1 is beyond 1, the second is not.
fn third_force_is_named<S: System<Vector1<f64>>, N: Solver<Vector1<f64>, S>>(
    mut integrator: Integrator<Gauss3, S, Vector1<f64>, Compensated, N>,
) {
    let start = integrator.state().clone();
    let error = integrator.step().map(|_| ()).expect_err("beyond the wall");
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
}

#[test]
fn a_nonfinite_force_in_lanes_is_named_with_its_stage() -> Result<(), Error> {
    let start = || State::new(0.0, SVector::from([0.9]), SVector::from([1.0]));
    third_force_is_named(Integrator::new(Gauss3, Wall, start(), 0.15)?);
    third_force_is_named(Integrator::new(Gauss3, Wall, start(), 0.15)?.with_solver(SimdFixedPoint));
    third_force_is_named(Integrator::new(Gauss3, Wall, start(), 0.15)?);
    third_force_is_named(
        Integrator::new(Gauss3, LightWall, start(), 0.15)?.with_solver(SimdFixedPoint),
    );
    third_force_is_named(Integrator::new(Gauss3, LightWall, start(), 0.15)?);
    Ok(())
}

/// The same method without its momentum stages.
fn without_momentum_stages<M, S>(method: M, system: S) -> Result<(), Error>
where
    M: Method + Copy,
    S: SystemInLanes<Vector2<f64>> + System<Vector2<f64>, Class = Separable> + Copy,
{
    without_momentum_stages_by::<Compensated, M, S>(method, system)?;
    without_momentum_stages_by::<Plain, M, S>(method, system)
}

/// The same with these sums.
fn without_momentum_stages_by<R: Summation, M, S>(method: M, system: S) -> Result<(), Error>
where
    M: Method + Copy,
    S: SystemInLanes<Vector2<f64>> + System<Vector2<f64>, Class = Separable> + Copy,
{
    let start = perihelion();
    let made = || Integrator::<_, _, _, R>::with_summation(method, system, start.clone(), 0.03);
    let mut whole = made()?.with_solver(SimdFixedPoint);
    let mut half = made()?;
    for _ in 0..100 {
        let (expected, found) = (whole.step()?, half.step()?);
        assert!((found.q - expected.q).norm() < 1e-12, "{}", M::NAME);
        assert!((found.p - expected.p).norm() < 1e-12, "{}", M::NAME);
        // Inside of the step too.
        let time = whole.state().time - 0.01;
        let (expected, found) = (whole.dense()?.state(time)?, half.dense()?.state(time)?);
        assert!((found.q - expected.q).norm() < 1e-12, "{}", M::NAME);
        assert!((found.p - expected.p).norm() < 1e-12, "{}", M::NAME);
    }
    assert!(half.iterations() <= whole.iterations(), "{}", M::NAME);
    Ok(())
}

#[test]
fn second_order_systems_need_no_momentum_stages() -> Result<(), Error> {
    without_momentum_stages(Midpoint, Kepler)?;
    without_momentum_stages(Gauss3, Kepler)?;
    without_momentum_stages(Gauss8, Kepler)?;
    without_momentum_stages(Gauss10, Kepler)?;
    // More than their starting values are made of at once.
    without_momentum_stages(Gauss18, Kepler)?;
    without_momentum_stages(Lobatto4, Kepler)?;
    without_momentum_stages(Radau3, Kepler)?;
    without_momentum_stages(StoermerVerlet, Kepler)?;
    // The coefficients of second order are for symplectic methods only.
    without_momentum_stages(RadauIIA, Kepler)
}

/// Both halves at once, beside one after the other, with these sums.
fn at_once<R: Summation, M: Method + Copy + ProvedFor<General>, V>(
    method: M,
    start: &State<V>,
) -> Result<(), Error>
where
    V: Vector<Scalar = f64> + Debug,
    Coupled: SystemInLanes<V> + System<V, Class = General>,
{
    let made = || Integrator::<_, _, _, R>::with_summation(method, Coupled, start.clone(), 0.05);
    let (mut in_turn, mut at_once) = (
        made()?.with_solver(SimdFixedPoint),
        made()?.with_solver(SimdJacobi),
    );
    let check = |expected: &State<V>, found: &State<V>| {
        for (expected, found) in [(&expected.q, &found.q), (&expected.p, &found.p)] {
            for (expected, found) in expected.as_slice().iter().zip(found.as_slice()) {
                assert!((found - expected).abs() < 1e-12, "{}", M::NAME);
            }
        }
    };
    for _ in 0..100 {
        check(in_turn.step()?, at_once.step()?);
        // Inside of the step too.
        let time = in_turn.state().time - 0.02;
        check(
            &in_turn.dense()?.state(time)?,
            &at_once.dense()?.state(time)?,
        );
    }
    // Steps by themselves and in blocks.
    let mut block = made()?.with_solver(SimdJacobi);
    assert_eq!(block.take_steps(100)?, at_once.state(), "{}", M::NAME);
    assert_eq!(block.statistics(), at_once.statistics(), "{}", M::NAME);
    Ok(())
}

#[test]
#[ignore = "thorough"]
fn simultaneous_halves_agree_with_alternating_ones_to_rounding() -> Result<(), Error> {
    fn check<M: Method + Copy + ProvedFor<General>>(method: M) -> Result<(), Error> {
        let q = SVector::from([0.5, -0.3, 0.9]);
        let p = SVector::from([1.0, 0.25, -0.5]);
        let long = |x: SVector<f64, 3>| DVector::from_column_slice(x.as_slice());
        at_once::<Compensated, M, _>(method, &State::new(0.0, q, p))?;
        at_once::<Plain, M, _>(method, &State::new(0.0, q, p))?;
        at_once::<Plain, M, _>(method, &State::new(0.0, long(q), long(p)))
    }
    check(Midpoint)?;
    check(Gauss3)?;
    check(Gauss8)?;
    check(Gauss10)?;
    // More than their starting values are made of at once.
    check(Gauss18)?;
    check(Lobatto4)?;
    check(Radau3)?;
    // Not symplectic: stages are sums of evaluations.
    check(RadauIIA)
}

/// For a separable system there would be twice as many sweeps at once.
#[test]
fn halves_of_separable_systems_are_iterated_alternately() -> Result<(), Error> {
    let start = perihelion();
    let mut in_turn =
        Integrator::new(Gauss3, Kepler, start.clone(), 0.03)?.with_solver(SimdFixedPoint);
    let mut at_once = Integrator::new(Gauss3, Kepler, start, 0.03)?.with_solver(SimdJacobi);
    assert_eq!(at_once.take_steps(100)?, in_turn.take_steps(100)?);
    assert_eq!(at_once.statistics(), in_turn.statistics());
    Ok(())
}

/// Counts the calls of its evaluations, which are one for all lanes.
struct Counting<'a, S> {
    system: S,
    calls: &'a Cell<u64>,
}

impl Hamiltonian for Counting<'_, Coupled> {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 3>;

    fn velocity<T: Scalar>(
        &self,
        t: T,
        q: &SVector<T, 3>,
        p: &SVector<T, 3>,
        velocity: &mut SVector<T, 3>,
    ) {
        self.calls.set(self.calls.get() + 1);
        System::velocity(&self.system, t, q, p, velocity);
    }

    fn force<T: Scalar>(
        &self,
        t: T,
        q: &SVector<T, 3>,
        p: &SVector<T, 3>,
        force: &mut SVector<T, 3>,
    ) {
        self.calls.set(self.calls.get() + 1);
        System::force(&self.system, t, q, p, force);
    }
}

/// Kepler's problem.
struct CountingKepler<'a>(&'a Cell<u64>);

impl SeparableHamiltonian for CountingKepler<'_> {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn velocity<T: Scalar>(&self, time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        self.0.set(self.0.get() + 1);
        SeparableHamiltonian::velocity(&Kepler, time, p, velocity);
    }

    fn force<T: Scalar>(&self, time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        self.0.set(self.0.get() + 1);
        SeparableHamiltonian::force(&Kepler, time, q, force);
    }
}

/// Evaluations are counted stage by stage, although one call is for all of them.
#[test]
fn evaluations_are_counted_for_every_stage() -> Result<(), Error> {
    const STEPS: u64 = 20;

    /// Of steps that call for `alone` evaluations of a single stage.
    fn check<M, S, V, R, N>(
        calls: &Cell<u64>,
        stages: u64,
        alone: u64,
        mut integrator: Integrator<M, S, V, R, N>,
    ) -> Result<(), Error>
    where
        M: Method + ProvedFor<S::Class>,
        S: System<V>,
        V: Vector,
        R: Summation,
        N: Solver<V, S>,
    {
        calls.set(0);
        integrator.take_steps(STEPS)?;
        let expected = stages * (calls.get() - STEPS * alone) + STEPS * alone;
        assert_eq!(integrator.statistics().evaluations, expected, "{}", M::NAME);
        Ok(())
    }

    fn all<M: Method + Copy + ProvedFor<General>>(method: M, stages: u64) -> Result<(), Error> {
        let calls = Cell::new(0);
        let q = SVector::from([0.5, -0.3, 0.9]);
        let start = State::new(0.0, q, SVector::from([1.0, 0.25, -0.5]));
        let (system, calls) = (Coupled, &calls);
        let coupled = || {
            let system = Counting { system, calls };
            Integrator::new(method, system, start.clone(), 0.05)
        };
        check(calls, stages, 0, coupled()?.with_solver(SimdFixedPoint))?;
        check(calls, stages, 0, coupled()?.with_solver(SimdJacobi))?;
        let system = Counting { system, calls };
        let plain = Integrator::plain(method, system, start.clone(), -0.05)?;
        check(calls, stages, 0, plain.with_solver(SimdJacobi))?;
        let start = perihelion();
        let kepler = || Integrator::new(method, CountingKepler(calls), start.clone(), 0.03);
        check(calls, stages, 0, kepler()?.with_solver(SimdFixedPoint))?;
        let plain = || Integrator::plain(method, CountingKepler(calls), start.clone(), 0.03);
        check(calls, stages, 0, plain()?.with_solver(SimdFixedPoint))
    }
    all(Gauss3, 3)?;
    all(Gauss8, 8)?;
    all(Twins, 2)?;

    // The velocity at the start, and with compensated sums that of what the momentum leaves out.
    let calls = &Cell::new(0);
    let start = perihelion();
    let half = Integrator::new(Gauss3, CountingKepler(calls), start.clone(), 0.03)?;
    check(calls, 3, 2, half)?;
    let half = Integrator::plain(Gauss3, CountingKepler(calls), start, 0.03)?;
    check(calls, 3, 1, half)
}

/// Lanes at once that are not finite are named too.
#[test]
fn a_nonfinite_force_of_simultaneous_halves_is_named_with_its_stage() -> Result<(), Error> {
    /// H = p²/2 + q²/2, beyond q = 1 nothing.
    struct Disc;

    impl Hamiltonian for Disc {
        type Class = General;
        type Vector<T: Scalar> = SVector<T, 1>;

        fn velocity<T: Scalar>(
            &self,
            _time: T,
            _q: &SVector<T, 1>,
            p: &SVector<T, 1>,
            v: &mut SVector<T, 1>,
        ) {
            *v = *p;
        }

        fn force<T: Scalar>(
            &self,
            _time: T,
            q: &SVector<T, 1>,
            _p: &SVector<T, 1>,
            f: &mut SVector<T, 1>,
        ) {
            f[0] = -q[0] + T::from_f64(0.0) * (T::one() - q[0]).ln();
        }
    }

    let start = State::new(0.0, SVector::from([0.9]), SVector::from([1.0]));
    third_force_is_named(Integrator::new(Gauss3, Disc, start, 0.15)?.with_solver(SimdJacobi));
    Ok(())
}

/// Masses 2 and 3.
#[derive(Clone, Copy)]
struct Heavy;

impl SeparableHamiltonian for Heavy {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        velocity[0] = p[0] / T::from_f64(2.0);
        velocity[1] = p[1] / T::from_f64(3.0);
    }

    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        *force = -q;
    }
}

#[test]
fn second_order_systems_may_have_masses() -> Result<(), Error> {
    without_momentum_stages(Gauss3, Heavy)?;
    without_momentum_stages(Gauss8, Heavy)?;
    without_momentum_stages(Lobatto4, Heavy)
}

/// Kepler's problem, with its masses said to be one.
#[derive(Clone, Copy)]
struct UnitKepler;

impl SeparableHamiltonian for UnitKepler {
    type Vector<T: Scalar> = SVector<T, 2>;

    const MASSES: Masses = Masses::Unit;

    fn velocity<T: Scalar>(&self, time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        SeparableHamiltonian::velocity(&Kepler, time, p, velocity);
    }

    fn force<T: Scalar>(&self, time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        SeparableHamiltonian::force(&Kepler, time, q, force);
    }
}

/// Without their velocities the second-order lanes give the same bits, at the ends of steps and inside.
#[test]
fn unit_masses_keep_the_bits_of_second_order_lanes() -> Result<(), Error> {
    fn check<M: Method + Copy>(method: M) -> Result<(), Error> {
        check_with::<Compensated, M>(method)?;
        check_with::<Plain, M>(method)
    }
    fn check_with<R: Summation, M: Method + Copy>(method: M) -> Result<(), Error> {
        let start = perihelion();
        let asked = Integrator::<_, _, _, R>::with_summation(method, Kepler, start.clone(), 0.03)?;
        let known = Integrator::<_, _, _, R>::with_summation(method, UnitKepler, start, 0.03)?;
        let mut asked = asked;
        let mut known = known;
        assert_eq!(known.take_steps(300)?, asked.take_steps(300)?);
        assert_eq!(known.statistics(), asked.statistics());
        let time = known.state().time - 0.01;
        assert_eq!(known.dense()?.state(time)?, asked.dense()?.state(time)?);
        Ok(())
    }
    check(Gauss3)?;
    check(Gauss10)?;
    check(Lobatto4)
}

/// H = √(1 + |p|²): a velocity that is not linear in the momentum.
#[derive(Clone, Copy)]
struct Relativistic;

impl SeparableHamiltonian for Relativistic {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = p / (T::one() + p.dot(p)).sqrt();
    }

    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        *force = -q;
    }
}

/// Masses that change.
#[derive(Clone, Copy)]
struct Rocket;

impl SeparableHamiltonian for Rocket {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn velocity<T: Scalar>(&self, time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = p / (T::from_f64(2.0) - time);
    }

    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        *force = -q;
    }
}

/// Velocities that are not linear are taken with the momenta of the stages.
#[test]
fn other_velocities_need_momentum_stages() -> Result<(), Error> {
    fn check<S: SystemInLanes<Vector2<f64>> + System<Vector2<f64>, Class = Separable> + Copy>(
        system: S,
    ) -> Result<(), Error> {
        // At rest they are linear.
        let start = State::new(0.0, Vector2::new(0.4, 0.0), Vector2::zeros());
        let made = || Integrator::new(Gauss3, system, start.clone(), 0.05);
        let (mut automatic, mut whole) = (made()?, made()?.with_solver(SimdFixedPoint));
        assert_eq!(automatic.take_steps(30)?, whole.take_steps(30)?);
        assert_eq!(automatic.statistics(), whole.statistics());
        let time = whole.state().time - 0.02;
        assert_eq!(automatic.dense()?.state(time)?, whole.dense()?.state(time)?);
        Ok(())
    }
    check(Relativistic)?;
    check(Rocket)
}

/// What is not separable is taken at once, with the bits of [`SimdJacobi`]; other scalars one stage after another.
#[test]
fn the_types_choose_the_solver() -> Result<(), Error> {
    let start = State::new(0.0, Vector1::new(0.5), Vector1::new(1.0));
    let made = || Integrator::new(Gauss3, Product, start.clone(), 0.05);
    let (mut automatic, mut at_once) = (made()?, made()?.with_solver(SimdJacobi));
    assert_eq!(automatic.take_steps(100)?, at_once.take_steps(100)?);
    assert_eq!(automatic.statistics(), at_once.statistics());

    let start = State::new(0.0, Vector1::new(0.5_f32), Vector1::new(1.0));
    let made = || Integrator::new(Gauss3, Product, start.clone(), 0.05);
    let (mut automatic, mut one_by_one) = (made()?, made()?.with_solver(FixedPoint));
    assert_eq!(automatic.take_steps(100)?, one_by_one.take_steps(100)?);
    let time = one_by_one.state().time - 0.02;
    assert_eq!(
        automatic.dense()?.state(time)?,
        one_by_one.dense()?.state(time)?
    );
    Ok(())
}

/// Unit masses pulled to the origin; results of the wrong dimension while it is broken.
struct Resizing<const UNIT: bool> {
    what: Quantity,
    to: usize,
    broken: Cell<bool>,
}

impl<const UNIT: bool> Resizing<UNIT> {
    fn write<T: Scalar>(&self, what: Quantity, from: DVector<T>, into: &mut DVector<T>) {
        match self.broken.get() && self.what == what {
            true => *into = DVector::from_element(self.to, T::one()),
            false => into.copy_from(&from),
        }
    }
}

impl<const UNIT: bool> SeparableHamiltonian for Resizing<UNIT> {
    type Vector<T: Scalar> = DVector<T>;

    const MASSES: Masses = match UNIT {
        true => Masses::Unit,
        false => Masses::Any,
    };

    fn velocity<T: Scalar>(&self, _time: T, p: &DVector<T>, velocity: &mut DVector<T>) {
        self.write(Quantity::Velocity, p.clone(), velocity);
    }

    fn force<T: Scalar>(&self, _time: T, q: &DVector<T>, force: &mut DVector<T>) {
        self.write(Quantity::Force, -q, force);
    }
}

#[test]
fn a_resized_result_is_an_error_in_lanes() -> Result<(), Error> {
    type Made<const UNIT: bool, R> = Integrator<Gauss2, Resizing<UNIT>, DVector<f64>, R>;
    fn check<const UNIT: bool, R: Summation, N: Solver<DVector<f64>, Resizing<UNIT>>>(
        solved: impl Fn(
            Made<UNIT, R>,
        )
            -> Result<Integrator<Gauss2, Resizing<UNIT>, DVector<f64>, R, N>, Error>,
    ) -> Result<(), Error> {
        let start = State::new(
            0.0,
            DVector::from_element(2, 1.0),
            DVector::from_element(2, 0.5),
        );
        for what in [Quantity::Velocity, Quantity::Force] {
            for (to, before) in [0, 1, 3].into_iter().flat_map(|to| [(to, 0), (to, 1)]) {
                let made = || {
                    let system = Resizing {
                        what,
                        to,
                        broken: Cell::new(false),
                    };
                    solved(Made::with_summation(Gauss2, system, start.clone(), 0.1)?)
                };
                let (mut broken, mut good) = (made()?, made()?);
                for _ in 0..before {
                    assert_eq!(broken.step()?, good.step()?);
                }
                broken.system().broken.set(true);
                match broken.step() {
                    Err(Error::EvaluationDimension { what: found, .. }) => assert_eq!(found, what),
                    // Velocities of unit masses need not be asked for.
                    Ok(_) if UNIT && what == Quantity::Velocity => continue,
                    other => panic!("{what:?} {to} {UNIT}: {other:?}"),
                }
                assert_eq!(broken.state(), good.state());
                broken.system().broken.set(false);
                for _ in 0..3 {
                    let (broken, good) = (broken.step()?, good.step()?);
                    assert!((&broken.q - &good.q).amax() < 1e-15);
                }
            }
        }
        Ok(())
    }
    check::<false, Plain, _>(|made| Ok(made.with_solver(SimdFixedPoint)))?;
    check::<false, Compensated, _>(|made| Ok(made.with_solver(SimdFixedPoint)))?;
    check::<true, Plain, _>(|made| Ok(made.with_solver(SimdFixedPoint)))?;
    check::<true, Compensated, _>(|made| Ok(made.with_solver(SimdFixedPoint)))?;
    check::<false, Plain, _>(Ok)?;
    check::<false, Compensated, _>(Ok)?;
    check::<true, Plain, _>(Ok)?;
    check::<true, Compensated, _>(Ok)
}
