//! Newton's iteration.

use crate::common::systems::{Kepler, Product, perihelion};

use crate::common::methods::{
    Gauss2, Gauss3, Gauss4, Gauss8, Lobatto3, Lobatto4, Midpoint, Radau3, StoermerVerlet,
};
use symplectic::nalgebra::{DVector, SVector, Vector1, Vector2};
use symplectic::num_traits::One;
use symplectic::solver::{
    AnalyticOrDifferences, Banded, ByNewton, Dense, Differences, FixedPoint, FixedPointThenNewton,
    Newton,
};
use symplectic::system::Jacobian;
use symplectic::{
    Error, General, Hamiltonian, Integrator, Method, ProvedFor, Quantity, Scalar, Separable, State,
    System, Vector, acceleration, separable,
};

type ByDifferences = Dense<Differences>;

const fn newton() -> Newton<ByDifferences> {
    Newton::new()
}

fn oscillator(omega: f64) -> impl System<Vector1<f64>, Class = Separable> {
    separable::<Vector1<f64>, _, _>(
        |_, p, velocity| *velocity = *p,
        move |_, q, force| *force = q * (-omega * omega),
    )
    .with_energy(move |_, q, p| (p[0] * p[0] + omega * omega * q[0] * q[0]) / 2.0)
}

/// H = p²/2 + k(|q| − 1)²/2 + q₂, a pendulum on a spring with ω = √k.
fn spring_pendulum(omega: f64) -> impl System<Vector2<f64>, Class = Separable> {
    let stiffness = omega * omega;
    separable::<Vector2<f64>, _, _>(
        |_, p, velocity| *velocity = *p,
        move |_, q, force| {
            let length = q.norm();
            *force = q * (-stiffness * (length - 1.0) / length) - Vector2::new(0.0, 1.0);
        },
    )
    .with_energy(move |_, q, p| {
        p.norm_squared() / 2.0 + stiffness * (q.norm() - 1.0).powi(2) / 2.0 + q[1]
    })
}

/// Both iterations for some steps: the largest distance of the states.
fn compare<M, S, V>(
    method: M,
    system: impl Fn() -> S,
    start: &State<V>,
    h: f64,
) -> Result<f64, Error>
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<V>,
    V: Vector<Scalar = f64>,
{
    let mut fixed_point = Integrator::new(method, system(), start.clone(), h)?;
    let mut newton = Integrator::new(method, system(), start.clone(), h)?.with_solver(newton());
    let mut largest = 0.0_f64;
    for _ in 0..50 {
        let expected = fixed_point.step()?;
        largest = largest.max(crate::common::distance(newton.step()?, expected));
    }
    assert!(newton.statistics().factorisations > 0, "{}", M::NAME);
    Ok(largest)
}

#[test]
fn newton_finds_the_stages_of_the_fixed_point_iteration() -> Result<(), Error> {
    fn check<M: Method + Copy + ProvedFor<General>>(method: M) -> Result<(), Error> {
        let kepler = perihelion();
        let distance = compare(method, || Kepler, &kepler, 0.05)?;
        // Rounding errors of 50 steps, growing as errors on a Kepler orbit do.
        assert!(distance < 1e-12, "{}: {distance:e}", M::NAME);
        let product = State::new(0.0, SVector::from([0.5]), SVector::from([1.0]));
        let distance = compare(method, || Product, &product, -0.1)?;
        assert!(distance < 1e-12, "{}: {distance:e}", M::NAME);
        Ok(())
    }
    // For others see `matrix.rs`.
    check(Gauss4)?;
    check(Lobatto4)
}

/// There is nothing to iterate in an explicit method.
#[test]
fn newton_leaves_explicit_methods_unchanged() -> Result<(), Error> {
    let start = || perihelion();
    let mut expected = Integrator::new(StoermerVerlet, Kepler, start(), 0.01)?;
    let mut newton = Integrator::new(StoermerVerlet, Kepler, start(), 0.01)?.by_newton();
    for _ in 0..100 {
        assert_eq!(newton.step()?, expected.step()?);
    }
    assert_eq!(newton.statistics(), expected.statistics());
    Ok(())
}

#[test]
fn oscillators_of_any_stiffness_take_few_iterations() -> Result<(), Error> {
    fn check<M: Method + Copy>(method: M) -> Result<(), Error> {
        for exponent in -8..=8 {
            let omega = 10f64.powi(exponent);
            let start = State::new(0.0, Vector1::new(1.0), Vector1::new(omega));
            let integrator = Integrator::new(method, oscillator(omega), start, 1.0)?;
            let mut integrator = integrator.with_solver(newton());
            let before = integrator.energy().expect("known");
            let mut error = 0.0_f64;
            for _ in 0..200 {
                integrator.step()?;
                let energy = integrator.energy().expect("known");
                error = error.max((energy / before - 1.0).abs());
            }
            // The method conserves the quadratic energy: this is the rounding of 200 steps.
            let name = M::NAME;
            assert!(error < 1e-13, "{name}, hω = 1e{exponent}: {error:e}");
            let statistics = integrator.statistics();
            let mean = statistics.mean_iterations();
            assert!(mean < 6.0, "{name}, hω = 1e{exponent}: {mean} iterations");
            assert!(statistics.factorisations <= 2, "{name}: {statistics:?}");
        }
        Ok(())
    }
    check(Midpoint)?;
    check(Gauss3)?;
    check(Gauss4)?;
    check(Gauss8)
}

/// The stiffness goes round with the pendulum: derivatives at one point of a step converge as long as h²ω is small.
#[test]
fn newton_steps_a_stiff_spring_pendulum() -> Result<(), Error> {
    for omega in [1e4, 1e6] {
        for h in [25.0 / omega, 0.25 / f64::sqrt(omega)] {
            let begin = || State::new(0.0, Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0));
            let mut fixed_point = Integrator::new(Gauss4, spring_pendulum(omega), begin(), h)?;
            let failure = fixed_point.step().map(|_| ());
            assert!(matches!(failure, Err(Error::NoConvergence { .. })));
            let integrator = Integrator::new(Gauss4, spring_pendulum(omega), begin(), h)?;
            let mut integrator = integrator.with_solver(newton());
            let before = integrator.energy().expect("known");
            for _ in 0..400 {
                integrator.step()?;
            }
            // The spring is as long as the centrifugal force and the weight make it.
            let state = integrator.state();
            assert!((state.q.norm() - 1.0).abs() < 10.0 / (omega * omega) + 1e-10);
            let after = integrator.energy().expect("known");
            assert!((after - before).abs() < 1e-5, "{:e}", after - before);
            let statistics = integrator.statistics();
            let mean = statistics.mean_iterations();
            assert!(mean < 10.0, "ω = {omega}, h = {h}: {statistics:?}");
        }
        // Far beyond, the derivatives of every stage do.
        let begin = State::new(0.0, Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0));
        let integrator = Integrator::new(Gauss4, spring_pendulum(omega), begin, 1.0)?;
        let mut integrator = integrator.with_solver(newton());
        integrator.step()?;
        let statistics = integrator.statistics();
        assert!(statistics.factorisations > 4, "{statistics:?}");
        assert!(statistics.iterations <= 30, "{statistics:?}");
    }
    Ok(())
}

/// A pendulum on a spring of stiffness k = 3·10⁷ from rest, `h²k/4 = 750`: the momenta shrink to their rounding error by 1/751 a sweep.
#[test]
fn newton_stops_at_changes_of_the_size_of_rounding() -> Result<(), Error> {
    fn check<R: symplectic::Summation>() -> Result<(), Error> {
        let start = State::new(0.0, Vector2::new(1.0, 0.0), Vector2::new(0.0, 0.0));
        let system = spring_pendulum(3e7_f64.sqrt());
        let integrator: Integrator<_, _, _, R> =
            Integrator::with_summation(Midpoint, system, start, 0.01)?;
        let mut integrator = integrator.by_newton();
        let state = integrator.step()?.clone();
        // By mpmath with 60 digits.
        assert!(
            (state.q[0] - 0.999_999_999_375_832_2).abs() < 1e-15,
            "{state:?}"
        );
        assert!(
            (state.q[1] + 0.000_049_999_999_984_395_8).abs() < 1e-15,
            "{state:?}"
        );
        let statistics = integrator.statistics();
        assert!(statistics.iterations <= 12, "{statistics:?}");
        // The positions are uncertain by half a unit, the momenta, of the size of gh = 0.01, by 2/h of that.
        let residual = statistics.largest_residual;
        assert!(residual < 64.0 * f64::EPSILON / 1e-4, "{residual:e}");
        Ok(())
    }
    check::<symplectic::Plain>()?;
    check::<symplectic::Compensated>()
}

/// The same as a general system, whose momenta count too.
#[test]
fn the_noise_of_evaluations_is_measured() -> Result<(), Error> {
    struct Spring;

    impl System<Vector2<f64>> for Spring {
        type Class = General;
        type Solver = FixedPoint;

        fn velocity(
            &self,
            _: f64,
            _: &Vector2<f64>,
            p: &Vector2<f64>,
            velocity: &mut Vector2<f64>,
        ) {
            *velocity = *p;
        }

        fn force(&self, _: f64, q: &Vector2<f64>, _: &Vector2<f64>, force: &mut Vector2<f64>) {
            let length = q.norm();
            *force = q * (-1e10 * (length - 1.0) / length) - Vector2::new(0.0, 1.0);
        }
    }

    for h in [1e-4, 1e-3, 1e-2] {
        let start = State::new(0.0, Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0));
        let mut integrator = Integrator::new(Gauss2, Spring, start, h)?.by_newton();
        for _ in 0..10 {
            integrator.step()?;
        }
        let statistics = integrator.statistics();
        assert!(statistics.most_iterations <= 30, "{statistics:?}");
    }
    Ok(())
}

/// A force in single precision: the stages stand still at its errors, and no smaller step would help.
#[test]
fn noisy_evaluations_are_reported_as_stagnation() -> Result<(), Error> {
    let system = || {
        separable::<Vector1<f64>, _, _>(
            |_, p, velocity| *velocity = *p,
            |_, q, force| force[0] = f64::from((q[0] * -1e4) as f32) * (1.0 + 0.1 * q[0]),
        )
    };
    let start = || State::new(0.0, Vector1::new(1.1), Vector1::new(0.3));
    let mut integrator = Integrator::new(Gauss3, system(), start(), 0.01)?.by_newton();
    let error = integrator.integrate_to(1.0).map(|_| ()).expect_err("noisy");
    let Error::Stagnation { residual, .. } = error else {
        panic!("{error}");
    };
    assert!(residual > 1e-12 && residual < 1e-6, "{residual:e}");
    // As the message says.
    let mut integrator = Integrator::plain(Gauss3, system(), start(), 0.01)?.by_newton();
    integrator.set_tolerance(1e-5)?;
    integrator.integrate_to(1.0)?;
    Ok(())
}

/// Rounding errors make the energy a random walk, not a drift.
#[test]
#[ignore = "thorough"]
fn the_energy_does_not_drift() -> Result<(), Error> {
    // A stiff oscillator that is coupled to a soft one: H = |p|²/2 + ω²q₁²/2 + q₂²/2 + q₁q₂ + γ q₁²q₂²/2.
    let system = |omega: f64, gamma: f64| {
        separable::<Vector2<f64>, _, _>(
            |_, p, velocity| *velocity = *p,
            move |_, q, force| {
                force[0] = -q[0] * (omega * omega + gamma * q[1] * q[1]) - q[1];
                force[1] = -q[1] * (1.0 + gamma * q[0] * q[0]) - q[0];
            },
        )
        .with_energy(move |_, q, p| {
            let quartic = gamma * q[0] * q[0] * q[1] * q[1];
            let quadratic = omega * omega * q[0] * q[0] + q[1] * q[1] + 2.0 * q[0] * q[1];
            0.5 * (p.norm_squared() + quadratic + quartic)
        })
    };
    const ORBITS: u32 = 16;
    // With hω = 1 the error of the method is below rounding; with 10⁴ there is none, for the energy is quadratic.
    for (omega, gamma) in [(1e1, 1.0), (1e5, 0.0)] {
        let mut errors = Vec::new();
        for orbit in 0..ORBITS {
            let q = Vector2::new((1.0 + 0.01 * f64::from(orbit)) / omega, 0.3);
            let start = State::new(0.0, q, Vector2::new(0.0, 0.5));
            let integrator = Integrator::new(Gauss8, system(omega, gamma), start, 0.1)?;
            let mut integrator = integrator.by_newton();
            let energy = integrator.energy().expect("known");
            for _ in 0..256 {
                integrator.step()?;
            }
            errors.push(integrator.energy().expect("known") / energy - 1.0);
        }
        let count = f64::from(ORBITS);
        let mean = errors.iter().sum::<f64>() / count;
        let squares = errors.iter().map(|error| (error - mean) * (error - mean));
        let spread = (squares.sum::<f64>() / (count - 1.0)).sqrt();
        // The increments of a step are rounded to half a unit of theirs, some units of the energy all together: in 256
        // steps that is 16 times as much as a random walk. A drift would make it 256 times.
        assert!(spread < 64.0 * f64::EPSILON, "ω = {omega}: {spread:e}");
        // Student's t with 15 degrees of freedom is beyond 4.07 once in a thousand.
        let significance = mean / (spread / count.sqrt());
        assert!(
            significance.abs() < 4.07,
            "ω = {omega}: {mean:e} {spread:e}"
        );
    }
    Ok(())
}

/// Masses on a line, with springs of stiffness k to their neighbours and a weak quartic potential each.
#[derive(Clone, Copy)]
struct Chain(f64);

impl<V: Vector> System<V> for Chain {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(&self, _time: V::Scalar, _q: &V, p: &V, velocity: &mut V) {
        velocity.as_mut_slice().copy_from_slice(p.as_slice());
    }

    fn force(&self, _time: V::Scalar, q: &V, _p: &V, force: &mut V) {
        let (stiffness, q) = (V::Scalar::from_f64(self.0), q.as_slice());
        for (i, force) in force.as_mut_slice().iter_mut().enumerate() {
            *force = -q[i] * q[i] * q[i];
            if i > 0 {
                *force -= (q[i] - q[i - 1]) * stiffness;
            }
            if i + 1 < q.len() {
                *force -= (q[i] - q[i + 1]) * stiffness;
            }
        }
    }

    fn second_derivatives(
        &self,
        _time: V::Scalar,
        q: &V,
        _p: &V,
        jacobian: &mut Jacobian<V::Scalar>,
    ) -> bool {
        let (stiffness, q) = (V::Scalar::from_f64(self.0), q.as_slice());
        let forces = &mut jacobian.force_by_position;
        for i in 0..q.len() {
            jacobian.velocity_by_momentum.set(i, i, V::Scalar::one());
            forces.set(i, i, V::Scalar::from_f64(-3.0) * q[i] * q[i]);
            for k in [i.wrapping_sub(1), i + 1] {
                if k < q.len() {
                    forces.set(i, k, stiffness);
                    forces.add(i, i, -stiffness);
                }
            }
        }
        true
    }
}

fn chain_start() -> State<DVector<f64>> {
    State::new(
        0.0,
        DVector::from_fn(24, |i, _| (0.3 * i as f64).sin()),
        DVector::zeros(24),
    )
}

#[test]
fn bands_give_what_full_matrices_give() -> Result<(), Error> {
    fn check<M: Method + Copy>(method: M, stiffness: f64) -> Result<(), Error> {
        let integrator = || Integrator::new(method, Chain(stiffness), chain_start(), 0.1);
        let mut dense = integrator()?.with_solver(Newton::<Dense<AnalyticOrDifferences>>::new());
        let mut banded =
            integrator()?.with_solver(Newton::<Banded<1, AnalyticOrDifferences>>::new());
        let mut differences = integrator()?.with_solver(Newton::<Banded<1, Differences>>::new());
        let expected = dense.integrate_to(2.0)?.clone();
        for (name, state) in [
            ("banded", banded.integrate_to(2.0)?),
            ("differences", differences.integrate_to(2.0)?),
        ] {
            let distance = (&state.q - &expected.q).norm() / expected.q.norm();
            assert!(distance < 1e-12, "{} {name}: {distance:e}", M::NAME);
        }
        Ok(())
    }
    check(Midpoint, 1e6)?;
    check(Gauss3, 1e6)?;
    // These are not stable for every hω: Lobatto's below √8, where ω² ≤ 4k + 3.
    check(Radau3, 190.0)?;
    check(Lobatto3, 190.0)?;
    // Without the neighbours the iteration does not converge: the band is what makes it do so.
    let integrator = Integrator::new(Gauss3, Chain(1e6), chain_start(), 0.1)?;
    let mut diagonal = integrator.with_solver(Newton::<Banded<0, AnalyticOrDifferences>>::new());
    let failure = diagonal.step().map(|_| ());
    assert!(
        matches!(failure, Err(Error::NoConvergence { .. })),
        "{failure:?}"
    );
    Ok(())
}

/// A general system over a band: H = Σ (1 + q_i²) p_i²/2 + k (q_i − q_{i+1})²/2
struct Rotors(f64);

impl Hamiltonian for Rotors {
    type Class = General;
    type Vector<T: Scalar> = DVector<T>;

    fn velocity<T: Scalar>(&self, _: T, q: &DVector<T>, p: &DVector<T>, velocity: &mut DVector<T>) {
        for i in 0..q.len() {
            velocity[i] = p[i] * (T::one() + q[i] * q[i]);
        }
    }

    fn force<T: Scalar>(&self, _: T, q: &DVector<T>, p: &DVector<T>, force: &mut DVector<T>) {
        let stiffness = T::from_f64(self.0);
        for i in 0..q.len() {
            force[i] = -q[i] * p[i] * p[i];
            if i > 0 {
                force[i] -= (q[i] - q[i - 1]) * stiffness;
            }
            if i + 1 < q.len() {
                force[i] -= (q[i] - q[i + 1]) * stiffness;
            }
        }
    }
}

#[test]
fn newton_steps_stiff_general_systems() -> Result<(), Error> {
    fn check<M: Method + Copy + ProvedFor<General>>(
        method: M,
        stiffness: f64,
    ) -> Result<(), Error> {
        let start = || State::new(0.0, chain_start().q * 1e-3, DVector::zeros(24));
        let integrator = || Integrator::new(method, Rotors(stiffness), start(), 0.1);
        let mut dense = integrator()?.by_newton();
        let mut banded = integrator()?.with_solver(Newton::<Banded<1, Differences>>::new());
        let expected = dense.integrate_to(1.0)?;
        let distance = (&banded.integrate_to(1.0)?.q - &expected.q).norm();
        assert!(distance < 1e-12, "{}: {distance:e}", M::NAME);
        Ok(())
    }
    check(Midpoint, 1e4)?;
    check(Gauss3, 1e4)?;
    check(Gauss4, 1e4)?;
    let start = State::new(0.0, chain_start().q * 1e-3, DVector::zeros(24));
    let mut fixed_point = Integrator::new(Gauss3, Rotors(1e4), start, 0.1)?;
    assert!(fixed_point.step().is_err());
    // The matrices of the two halves differ, and all stages are solved for together.
    check(Lobatto3, 190.0)?;
    check(Radau3, 190.0)
}

#[test]
fn factors_are_kept_from_step_to_step() -> Result<(), Error> {
    let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    let integrator = Integrator::new(Gauss4, oscillator(1e3), start, 0.1)?;
    let mut integrator = integrator.with_solver(newton());
    for _ in 0..100 {
        integrator.step()?;
    }
    assert_eq!(integrator.statistics().factorisations, 1);
    // Another step size is another matrix.
    integrator.set_step_size(0.05)?;
    for _ in 0..100 {
        integrator.step()?;
    }
    assert_eq!(integrator.statistics().factorisations, 2);
    Ok(())
}

/// q″ = q: 1 − h²/4 is the matrix of the midpoint rule.
#[test]
fn a_singular_matrix_is_an_error() -> Result<(), Error> {
    struct Repulsion;

    impl System<DVector<f64>> for Repulsion {
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
            force.copy_from(q);
        }

        fn second_derivatives(
            &self,
            _time: f64,
            _q: &DVector<f64>,
            _p: &DVector<f64>,
            jacobian: &mut Jacobian<f64>,
        ) -> bool {
            for i in 0..3 {
                jacobian.velocity_by_momentum.set(i, i, 1.0);
                jacobian.force_by_position.set(i, i, 1.0);
            }
            true
        }
    }

    let one = || DVector::from_element(3, 1.0);
    let begin = State::new(1.0, one(), one());
    let mut integrator = Integrator::new(Midpoint, Repulsion, begin.clone(), 2.0)?.by_newton();
    let error = integrator.step().map(|_| ()).expect_err("singular");
    let expected = Error::SingularMatrix {
        time: 1.0,
        step_size: 2.0,
        step: 1,
    };
    assert_eq!(error, expected);
    assert_eq!(integrator.state(), &begin);
    assert_eq!(integrator.statistics().factorisations, 0);
    // Not so another step size, or the step in two parts.
    integrator.set_retry(symplectic::Retry::Split { halvings: 1 });
    integrator.step()?;
    assert_eq!(integrator.statistics().rejected, 1);
    Ok(())
}

#[test]
fn derivatives_that_are_not_finite_are_an_error() -> Result<(), Error> {
    struct Broken;

    impl System<Vector1<f64>> for Broken {
        type Class = Separable;
        type Solver = FixedPoint;

        fn velocity(
            &self,
            _time: f64,
            _q: &Vector1<f64>,
            p: &Vector1<f64>,
            velocity: &mut Vector1<f64>,
        ) {
            *velocity = *p;
        }

        fn force(&self, _time: f64, q: &Vector1<f64>, _p: &Vector1<f64>, force: &mut Vector1<f64>) {
            *force = -q;
        }

        fn second_derivatives(
            &self,
            _time: f64,
            _q: &Vector1<f64>,
            _p: &Vector1<f64>,
            jacobian: &mut Jacobian<f64>,
        ) -> bool {
            jacobian.force_by_position.set(0, 0, f64::NAN);
            true
        }
    }

    let begin = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    let mut integrator = Integrator::new(Gauss2, Broken, begin, 0.1)?.by_newton();
    let error = integrator.step().map(|_| ()).expect_err("NaN");
    let what = Quantity::Derivative;
    assert!(
        matches!(error, Error::NonFinite { what: found, .. } if found == what),
        "{error}"
    );
    Ok(())
}

/// An oscillator that is stiff for a while: ω² = 1 + 10⁸ exp(−(t − 5)²).
#[test]
fn newton_helps_the_fixed_point_iteration_out() -> Result<(), Error> {
    let system = || {
        separable::<Vector1<f64>, _, _>(
            |_, p, velocity| *velocity = *p,
            |time, q, force| *force = -q * (1.0 + 1e8 * (-(time - 5.0) * (time - 5.0)).exp()),
        )
    };
    let begin = || State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    let mut alone = Integrator::new(Gauss4, system(), begin(), 0.01)?;
    assert!(alone.integrate_to(10.0).is_err());
    let mut newton = Integrator::new(Gauss4, system(), begin(), 0.01)?.with_solver(newton());
    let expected = newton.integrate_to(10.0)?.clone();
    let solver = FixedPointThenNewton::<ByDifferences>::new();
    let mut both = Integrator::new(Gauss4, system(), begin(), 0.01)?.with_solver(solver);
    let end = both.integrate_to(10.0)?;
    // Rounding errors of 1e4 oscillations, through which a phase is carried.
    let scale = expected.q.norm() + expected.p.norm() * 1e-2;
    assert!(
        (end.q - expected.q).norm() < 1e-8 * scale,
        "{end:?} {expected:?}"
    );
    let statistics = both.statistics();
    assert!(
        statistics.rejected > 0 && statistics.rejected < 60,
        "{statistics:?}"
    );
    assert_eq!(statistics.steps, 1000);
    assert!(statistics.factorisations > 0);
    assert!(newton.statistics().rejected == 0);
    Ok(())
}

/// A system that resizes its result is told so, and nothing panics.
#[test]
fn wrong_dimensions_are_an_error() -> Result<(), Error> {
    struct Resizing;

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
            *velocity = p.clone();
        }

        fn force(
            &self,
            _time: f64,
            _q: &DVector<f64>,
            _p: &DVector<f64>,
            force: &mut DVector<f64>,
        ) {
            *force = DVector::zeros(5);
        }
    }

    for dimension in [2, 7] {
        let zeros = || DVector::zeros(dimension);
        let begin = State::new(0.0, zeros(), zeros());
        let integrator = Integrator::new(Gauss2, Resizing, begin, 0.1)?;
        let mut integrator = integrator.with_solver(newton());
        let error = integrator.step().map(|_| ()).expect_err("resized");
        let Error::EvaluationDimension {
            expected, found, ..
        } = error
        else {
            panic!("{error}");
        };
        assert_eq!((expected, found), (dimension, 5));
    }
    Ok(())
}

#[cfg(feature = "num-dual")]
#[test]
fn dual_numbers_give_the_derivatives() -> Result<(), Error> {
    use symplectic::solver::{Derivatives, DualNumbers};

    let State { q, p, .. } = chain_start();
    let mut expected = Jacobian::new(24, 1);
    assert!(Chain(1e6).second_derivatives(0.0, &q, &p, &mut expected));
    let mut memory = <DualNumbers as Derivatives<_, Chain>>::memory(&q);
    let mut found = Jacobian::new(24, 1);
    DualNumbers::evaluate(&mut memory, &Chain(1e6), 0.0, &q, &p, &mut found);
    let mut memory = <Differences as Derivatives<_, Chain>>::memory(&q);
    let mut nearly = Jacobian::new(24, 1);
    Differences::evaluate(&mut memory, &Chain(1e6), 0.0, &q, &p, &mut nearly);
    for i in 0..24 {
        for j in 0..24 {
            let entry = |jacobian: &Jacobian<f64>| {
                (
                    jacobian.force_by_position.get(i, j),
                    jacobian.velocity_by_momentum.get(i, j),
                )
            };
            let (expected, found, nearly) = (entry(&expected), entry(&found), entry(&nearly));
            assert!((expected.0 - found.0).abs() <= 1e-15 * expected.0.abs());
            assert_eq!(expected.1, found.1);
            assert!(
                (expected.0 - nearly.0).abs() < 1e-6 * 2e6,
                "{expected:?} {nearly:?}"
            );
            assert!((expected.1 - nearly.1).abs() < 1e-6);
        }
    }
    // The general system, by rows of both kinds.
    let (q, p) = (q * 0.3, chain_start().q);
    let mut memory = <DualNumbers as Derivatives<_, Rotors>>::memory(&q);
    let mut found = Jacobian::new(24, 23);
    DualNumbers::evaluate(&mut memory, &Rotors(10.0), 0.0, &q, &p, &mut found);
    for i in 0..24 {
        let diagonal = found.velocity_by_position.get(i, i);
        assert!((diagonal - 2.0 * p[i] * q[i]).abs() < 1e-15);
        assert!((found.velocity_by_momentum.get(i, i) - 1.0 - q[i] * q[i]).abs() < 1e-15);
    }
    let integrator = Integrator::new(Gauss3, Rotors(1e4), State::new(0.0, q, p * 0.1), 0.1)?;
    let mut integrator = integrator.with_solver(Newton::<Dense<DualNumbers>>::new());
    integrator.integrate_to(1.0)?;
    Ok(())
}

/// A light body round a heavy one that moves: its momentum is less than a unit in the last place of the other one's.
#[test]
fn a_light_body_near_a_heavy_one_keeps_its_accuracy() {
    type Bodies = SVector<f64, 4>;
    let energy_error = |heavy: f64| {
        let system = separable::<Bodies, _, _>(
            move |_, p, velocity| {
                *velocity = Bodies::new(p[0] / heavy, p[1] / heavy, p[2], p[3]);
            },
            |_, q, force| {
                let (x, y) = (q[2] - q[0], q[3] - q[1]);
                let square = x * x + y * y;
                let pull = (square * square.sqrt()).recip();
                *force = Bodies::new(pull * x, pull * y, -pull * x, -pull * y);
            },
        );
        let energy = |state: &State<Bodies>| {
            let State { q, p, .. } = state;
            let relative = Vector2::new(p[2] - p[0] / heavy, p[3] - p[1] / heavy);
            let distance = Vector2::new(q[2] - q[0], q[3] - q[1]).norm();
            relative.norm_squared() / 2.0 - distance.recip()
        };
        let start = State::from_arrays(0.0, [0.0, 0.0, 1.0, 0.0], [0.0, heavy / 3.0, 0.0, 1.1]);
        let before = energy(&start);
        let integrator = Integrator::new(Gauss4, system, start, 0.0625).expect("an integrator");
        let mut integrator = integrator.by_newton();
        integrator.take_steps(200).expect("steps");
        (energy(integrator.state()) - before).abs()
    };
    for heavy in [1e10, 1e20, 1e30] {
        assert!(
            energy_error(heavy) < 1e-9,
            "{heavy} {}",
            energy_error(heavy)
        );
    }
}

symplectic::tableau! {
    /// One momentum and two forces a step.
    Coarse { basis: polynomial(1), quadrature: gauss(2) }
}

/// All increments are extrapolated, also if there are more forces than unknowns. With a tolerance the steps show their starting values.
#[test]
fn one_pendulum_takes_the_steps_of_each_of_two() -> Result<(), Error> {
    let end = |count: usize| {
        let pendula = acceleration(|_time, q: &DVector<f64>, acceleration| {
            acceleration.zip_apply(q, |a, q| *a = -q.sin());
        });
        let q = DVector::from_element(count, 1.0);
        let start = State::new(0.0, q, DVector::zeros(count));
        let mut integrator = Integrator::plain(Coarse, pendula, start, 0.1)?.by_newton();
        integrator.set_tolerance(1e-3)?;
        Ok(integrator.take_steps(200)?.q[0])
    };
    let apart: f64 = end(1)? - end(2)?;
    assert!(apart.abs() < 1e-12, "{apart:e}");
    Ok(())
}
