//! Reversible steps of variable size.

use std::f64::consts::TAU;
use symplectic::constraints::{Constrained, Gradients, HolonomicConstraints};

use symplectic::adaptive::{Adaptive, AdaptiveSteps, DistancePower, Error, Monitor, Symmetry};
use symplectic::nalgebra::{SVector, Vector1, Vector2};
use symplectic::proved::SymmetricFor;
use symplectic::system::Masses;
use symplectic::{
    General, Hamiltonian, Integrator, Method, ProvedFor, Scalar, Separable, State, acceleration,
};

use super::kepler::{
    ForestRuth, Gauss2, Gauss5, Kepler, McLachlanAtela, Rattle, VelocityVerlet, assert_order,
    energy, pericentre, position,
};

const FREE_FALL: DistancePower = DistancePower(1.5);

type Run = Adaptive<VelocityVerlet, Kepler, DistancePower, Vector2<f64>>;

fn leapfrog(epsilon: f64) -> Result<Run, Error> {
    AdaptiveSteps::run(VelocityVerlet, Kepler, FREE_FALL, pericentre(0.9), epsilon)
}

fn assert_near(found: f64, expected: f64) {
    assert!(
        (found / expected - 1.0).abs() < 0.01,
        "{found:e} instead of {expected:e}"
    );
}

/// `h = ε/z`, and between steps z is kicked by `ε G` with `G = −∇σ·q'/σ = −3/2 q·p/|q|²`.
#[test]
fn the_step_density_is_that_of_the_last_step() -> Result<(), Error> {
    const EPSILON: f64 = 0.05;
    let mut run = leapfrog(EPSILON)?;
    let at_start = pericentre(0.9).q.norm().powf(-1.5);
    assert!((run.stepper().step_density() / at_start - 1.0).abs() < 4.0 * f64::EPSILON);
    run.step()?;
    for _ in 0..100 {
        let (before, density) = (run.state().clone(), run.stepper().step_density());
        let time = run.step()?.time;
        let rate = -1.5 * before.q.dot(&before.p) / before.q.norm_squared();
        let expected = density + EPSILON * rate;
        // Some roundings of terms no larger than the density at the pericentre.
        let error = (run.stepper().step_density() - expected).abs();
        assert!(error < 16.0 * f64::EPSILON * at_start, "{error:e}");
        assert_eq!(run.step_size(), EPSILON / run.stepper().step_density());
        // The times are rounded.
        assert!((time - before.time - run.step_size()).abs() < 4.0 * f64::EPSILON * time);
    }
    Ok(())
}

/// The figures of an independent program, to two digits: 8.8e-4, 6.9e-4, 7.6e-4, and 1.2e-3, 6.8e-2, 0.18.
#[test]
fn reversible_steps_keep_the_energy_and_one_sided_steps_do_not() -> Result<(), Error> {
    let orbits = [1_u32, 100, 300];
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let error = |state: &State<Vector2<f64>>| energy(state) + 0.5;
    let mut found = Vec::new();
    let mut run = leapfrog(0.05)?;
    for orbit in 1..=300 {
        let mut errors = Vec::new();
        run.integrate_with(TAU * f64::from(orbit), |state| errors.push(error(state)))?;
        if orbits.contains(&orbit) {
            found.push(mean(&errors));
        }
    }
    for (found, expected) in found.into_iter().zip([8.81e-4, 6.90e-4, 7.62e-4]) {
        assert_near(found, expected);
    }
    let steps = run.stepper().integrator().steps();
    assert!(
        (steps as f64 / 300.0 * 0.0075 / TAU - 0.2).abs() < 0.005,
        "{steps}"
    );

    let mut twin = Integrator::new(VelocityVerlet, Kepler, pericentre(0.9), 1.0)?;
    let mut found = Vec::new();
    for orbit in 1..=300 {
        let mut errors = Vec::new();
        while twin.state().time < TAU * f64::from(orbit) {
            twin.set_step_size(0.05 * FREE_FALL.value(twin.state().q.as_slice()))?;
            errors.push(error(twin.step()?));
        }
        if orbits.contains(&orbit) {
            found.push(mean(&errors));
        }
    }
    for (found, expected) in found.into_iter().zip([1.21e-3, 6.81e-2, 1.80e-1]) {
        assert_near(found, expected);
    }
    Ok(())
}

#[test]
fn the_order_in_epsilon_is_that_of_the_method() -> Result<(), Error> {
    fn errors<M>(method: M, epsilon: f64) -> Result<Vec<f64>, Error>
    where
        M: Copy + ProvedFor<Separable> + SymmetricFor<Separable>,
    {
        let halved = [1.0, 0.5, 0.25].map(|part| part * epsilon);
        let errors = halved.into_iter().map(|epsilon| {
            let mut run = AdaptiveSteps::run(method, Kepler, FREE_FALL, pericentre(0.9), epsilon)?;
            Ok((run.integrate_to(1.0)?.q - position(0.9, 1.0)).norm())
        });
        errors.collect()
    }
    assert_order("Störmer–Verlet", 2.0, &errors(VelocityVerlet, 0.025)?);
    assert_order("Forest–Ruth", 4.0, &errors(ForestRuth, 0.05)?);
    assert_order("Gauss", 4.0, &errors(Gauss2, 0.05)?);
    Ok(())
}

#[test]
fn reversed_steps_go_back_with_the_same_sizes() -> Result<(), Error> {
    let mut run = leapfrog(0.05)?;
    let mut forward = Vec::new();
    for _ in 0..500 {
        run.step()?;
        forward.push((run.step_size(), run.state().clone()));
    }
    run.stepper_mut().reverse();
    let last = run.step_size();
    run.step()?;
    // The first one to the bit.
    assert_eq!(run.step_size(), last);
    for number in (1..500).rev() {
        let before = &forward[number - 1].1;
        assert!((run.state().time - before.time).abs() < 1e-11);
        assert!((run.state().q - before.q).norm() < 1e-8);
        run.step()?;
        let size = forward[number - 1].0;
        assert!((run.step_size() / size + 1.0).abs() < 1e-8, "{number}");
    }
    let start = pericentre(0.9);
    assert!(run.state().time.abs() < 1e-12);
    assert!((run.state().q - start.q).norm() < 1e-9);

    // Steps by the state before are not reversible: they come back with sizes that differ by far more.
    let mut twin = Integrator::new(VelocityVerlet, Kepler, start.clone(), 1.0)?;
    for sign in [1.0, -1.0] {
        for _ in 0..500 {
            let monitor = FREE_FALL.value(twin.state().q.as_slice());
            twin.set_step_size(sign * 0.05 * monitor)?;
            twin.step()?;
        }
    }
    let missed = (twin.state().q - start.q).norm();
    assert!(missed > 1e-3, "{missed:e}");
    Ok(())
}

#[test]
fn flipped_momenta_go_back_as_well() -> Result<(), Error> {
    // The controller is reversible by the symmetry of the flow too: a new run from the flipped state at the apocentre, where
    // the density of a new start is that of the run to O(ε²).
    let ends = [0.05, 0.025, 0.0125].map(|epsilon| {
        let mut run = leapfrog(epsilon).expect("a run");
        let there = run.integrate_to(3.0).expect("steps");
        let flipped = State::new(0.0, there.q, -there.p);
        let mut back =
            AdaptiveSteps::run(VelocityVerlet, Kepler, FREE_FALL, flipped, epsilon).expect("a run");
        let end = back.integrate_to(3.0).expect("steps");
        (end.q - pericentre(0.9).q).norm()
    });
    assert!(ends[2] < 0.1 * ends[0], "{ends:?}");
    Ok(())
}

#[test]
fn step_sizes_follow_the_monitor_to_second_order() -> Result<(), Error> {
    let worst = |epsilon: f64| -> Result<f64, Error> {
        let mut run = leapfrog(epsilon)?;
        let mut worst = 0.0_f64;
        run.step()?;
        while run.state().time < TAU {
            let before = run.step_size();
            let size = epsilon * FREE_FALL.value(run.state().q.as_slice());
            run.step()?;
            // The density at the state lies between those of the steps on both sides.
            let density = 0.5 * (epsilon / before + epsilon / run.step_size());
            worst = worst.max((size * density / epsilon - 1.0).abs());
        }
        Ok(worst)
    };
    assert_order("density", 2.0, &[worst(0.02)?, worst(0.01)?, worst(0.005)?]);
    Ok(())
}

#[test]
fn a_step_backward_is_the_inverse_of_a_step_from_the_start() -> Result<(), Error> {
    // With ε < 0 from the start: the orbit is symmetric about the pericentre.
    let (mut forward, mut backward) = (leapfrog(0.05)?, leapfrog(-0.05)?);
    for _ in 0..300 {
        let there = forward.step()?.clone();
        let here = backward.step()?;
        assert_eq!(here.time, -there.time);
        assert_eq!((here.q[0], here.q[1]), (there.q[0], -there.q[1]));
    }
    Ok(())
}

#[test]
fn the_time_does_not_drift_from_the_steps() -> Result<(), Error> {
    let mut run = leapfrog(0.01)?;
    // The sizes are summed without rounding errors that grow: by their differences from the last time.
    let (mut sum, mut low) = (0.0_f64, 0.0_f64);
    for _ in 0..20_000 {
        run.step()?;
        let term = run.step_size();
        let next = sum + term;
        low += (sum - next) + term;
        sum = next;
    }
    assert!((run.state().time - (sum + low)).abs() < 1e-14 * sum);
    Ok(())
}

/// H = |p|²/(2(1 + |q|²)) − 1/|q| is not separable.
struct Curved;

impl Hamiltonian for Curved {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 2>;

    fn velocity<T: Scalar>(
        &self,
        _: T,
        q: &SVector<T, 2>,
        p: &SVector<T, 2>,
        velocity: &mut SVector<T, 2>,
    ) {
        *velocity = p * (q.dot(q) + T::one()).recip();
    }

    fn force<T: Scalar>(
        &self,
        _: T,
        q: &SVector<T, 2>,
        p: &SVector<T, 2>,
        force: &mut SVector<T, 2>,
    ) {
        let square = q.dot(q);
        let mass = square + T::one();
        *force = q * (p.dot(p) / (mass * mass) - (square * square.sqrt()).recip());
    }

    fn energy<T: Scalar>(&self, _: T, q: &SVector<T, 2>, p: &SVector<T, 2>) -> Option<T> {
        let kinetic = p.dot(p) * T::from_f64(0.5) / (q.dot(q) + T::one());
        Some(kinetic - q.dot(q).sqrt().recip())
    }
}

#[test]
fn a_general_hamiltonian_keeps_its_energy() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [1.5, 0.0], [0.0, 0.4]);
    let spread = |epsilon: f64| -> Result<[f64; 2], Error> {
        let mut run = AdaptiveSteps::run(Gauss2, Curved, FREE_FALL, start.clone(), epsilon)?;
        let before = run.stepper().energy().expect("an energy");
        let mut spreads = [0.0_f64; 2];
        for (spread, end) in spreads.iter_mut().zip([20.0, 400.0]) {
            while run.state().time < end {
                run.step()?;
                let error = run.stepper().energy().expect("an energy") - before;
                *spread = spread.max(error.abs());
            }
        }
        Ok(spreads)
    };
    let [coarse, fine] = [spread(0.2)?, spread(0.1)?];
    // As large after twenty times the time, and of order 4.
    assert!(
        coarse[1] < 1.5 * coarse[0] && fine[1] < 1.5 * fine[0],
        "{coarse:?} {fine:?}"
    );
    let slope = (coarse[1] / fine[1]).log2();
    assert!((slope - 4.0).abs() < 0.3, "{slope}");
    Ok(())
}

#[test]
fn methods_state_for_which_systems_they_are_symmetric() {
    fn symmetry<M: Method>(_: M) -> (bool, bool) {
        let Symmetry { general, separable } = M::SYMMETRY;
        (general, separable)
    }
    assert_eq!(symmetry(VelocityVerlet), (false, true));
    assert_eq!(symmetry(ForestRuth), (false, true));
    assert_eq!(symmetry(Gauss2), (true, true));
    assert_eq!(symmetry(McLachlanAtela), (false, false));
    assert_eq!(symmetry(Gauss2.accept_lower_order()), (true, true));
}

/// A pendulum of length 1 in the plane: H = |p|²/2 + y, |q|² = 1.
struct Pendulum;

impl Hamiltonian for Pendulum {
    type Class = Constrained<Separable>;
    type Vector<T: Scalar> = SVector<T, 2>;

    const MASSES: Masses = Masses::Unit;

    fn velocity<T: Scalar>(
        &self,
        _: T,
        _: &SVector<T, 2>,
        p: &SVector<T, 2>,
        velocity: &mut SVector<T, 2>,
    ) {
        *velocity = *p;
    }

    fn force<T: Scalar>(
        &self,
        _: T,
        _: &SVector<T, 2>,
        _: &SVector<T, 2>,
        force: &mut SVector<T, 2>,
    ) {
        *force = SVector::from([T::zero(), -T::one()]);
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn HolonomicConstraints<SVector<T, 2>>> {
        Some(self)
    }
}

impl<T: Scalar> HolonomicConstraints<SVector<T, 2>> for Pendulum {
    fn constraints(&self) -> usize {
        1
    }
    fn constraint_values(&self, q: &SVector<T, 2>, values: &mut [T]) {
        values[0] = q.dot(q) - T::one();
    }
    fn constraint_gradients(&self, q: &SVector<T, 2>, gradients: &mut Gradients<T>) {
        gradients.set(0, 0, q[0] + q[0]);
        gradients.set(0, 1, q[1] + q[1]);
    }
}

/// Shorter steps where the pendulum is low and fast.
struct Height;

impl Monitor for Height {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        q[1] + T::from_f64(1.5)
    }
}

#[test]
fn constrained_systems_have_variable_steps_too() -> Result<(), Error> {
    // The same motion in the angle: θ'' = −sin θ.
    let angle = acceleration(|_, q: &Vector1<f64>, a: &mut Vector1<f64>| a[0] = -q[0].sin());
    let mut fine = Integrator::new(Gauss5, angle, State::from_arrays(0.0, [0.0], [1.9]), 1e-2)?;
    let angle = fine.integrate_to(7.0)?.q[0];
    let expected = Vector2::new(angle.sin(), -angle.cos());
    let start = || State::from_arrays(0.0, [0.0, -1.0], [1.9, 0.0]);
    let errors = [0.02, 0.01, 0.005].map(|epsilon| {
        let mut run =
            AdaptiveSteps::run(Rattle, Pendulum, Height, start(), epsilon).expect("a run");
        (run.integrate_to(7.0).expect("steps").q - expected).norm()
    });
    assert_order("RATTLE", 2.0, &errors);
    Ok(())
}
