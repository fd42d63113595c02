//! Symplectic–energy–momentum steps.

use symplectic::nalgebra::{SVector, Vector2};
use symplectic::variational::{DiscreteLagrangian, EnergyMomentumSteps, VariationalSteps};
use symplectic::{Error, Scalar, State};

use super::kepler::{assert_order, pericentre, position};

type Plane<T> = SVector<T, 2>;

/// The midpoint rule for L = |v|²/2 − U(|q|²).
struct Midpoint<U>(U);

trait Potential {
    fn value<T: Scalar>(&self, square: T) -> T;
}

struct Attraction;

impl Potential for Attraction {
    fn value<T: Scalar>(&self, square: T) -> T {
        -square.sqrt().recip()
    }
}

/// Of Marsden & West (2001), Figure 2.
struct Ring;

impl Potential for Ring {
    fn value<T: Scalar>(&self, square: T) -> T {
        square * (square - T::one()) * (square - T::one())
    }
}

impl<U: Potential> DiscreteLagrangian for Midpoint<U> {
    type Vector<T: Scalar> = Plane<T>;

    fn value<T: Scalar>(&self, _time: T, h: T, q0: &Plane<T>, q1: &Plane<T>) -> T {
        let half = T::from_f64(0.5);
        let (way, middle) = (q1 - q0, (q0 + q1) * half);
        half * way.dot(&way) / h - h * self.0.value(middle.dot(&middle))
    }
}

/// `−∂Ld/∂h` of the midpoint rule is the energy at the middle with the mean velocity.
fn discrete_energy<U: Potential>(
    potential: &U,
    from: &State<Vector2<f64>>,
    to: &State<Vector2<f64>>,
    h: f64,
) -> f64 {
    let (velocity, middle) = ((to.q - from.q) / h, (to.q + from.q) / 2.0);
    velocity.norm_squared() / 2.0 + potential.value(middle.norm_squared())
}

#[test]
fn energy_and_angular_momentum_are_conserved() -> Result<(), Error> {
    let start = pericentre(0.5);
    let mut run = EnergyMomentumSteps::run(Midpoint(Attraction), start.clone(), 0.01)?;
    let mut fixed = VariationalSteps::run(Midpoint(Attraction), start.clone(), 0.01)?;
    let (mut worst, mut spread) = (0.0_f64, 0.0_f64);
    let mut first = f64::NAN;
    for number in 0..100 {
        let before = run.state().clone();
        run.step()?;
        let energy = discrete_energy(&Attraction, &before, run.state(), run.step_size());
        if number == 0 {
            first = energy;
            assert_eq!(run.step_size(), 0.01);
        }
        worst = worst.max((energy - first).abs());
        let momentum = run.state().q.perp(&run.state().p) - start.q.perp(&start.p);
        assert!(momentum.abs() < 1e-13, "{momentum:e}");

        let before = fixed.state().clone();
        fixed.step()?;
        let energy = discrete_energy(&Attraction, &before, fixed.state(), 0.01);
        spread = spread.max((energy - first).abs());
    }
    // Rounding times h⁻².
    assert!(worst < 1e-11, "{worst:e}");
    assert!(spread > 1e-4, "{spread:e}");
    let energy = run.stepper().discrete_energy().expect("steps");
    assert!((energy - first).abs() < 1e-12);
    Ok(())
}

#[test]
fn the_state_at_the_reached_time_has_order_two() -> Result<(), Error> {
    let errors = [(0.01, 100), (0.005, 200), (0.0025, 400)].map(|(size, steps)| {
        let mut run =
            EnergyMomentumSteps::run(Midpoint(Attraction), pericentre(0.5), size).expect("a run");
        for _ in 0..steps {
            run.step().expect("a step");
        }
        assert!(run.state().time > 1.0, "{}", run.state().time);
        (run.state().q - position(0.5, run.state().time)).norm()
    });
    assert_order("midpoint", 2.0, &errors);
    Ok(())
}

#[test]
fn the_curvature_is_that_of_the_midpoint_rule() -> Result<(), Error> {
    // (p·V''p + |∇V|²)/8 at q = (x, 0), p = (0, y), where V = −1/|q|: V'' across is 1/x³.
    let start = State::from_arrays(0.0, [0.5, 0.0], [0.0, 1.5]);
    let expected = (1.5_f64.powi(2) / 0.5_f64.powi(3) + 0.5_f64.powi(-4)) / 8.0;
    let mut run = EnergyMomentumSteps::run(Midpoint(Attraction), start, 1e-3)?;
    assert_eq!(run.stepper().curvature(), None);
    run.step()?;
    let found = run.stepper().curvature().expect("a step");
    assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
    Ok(())
}

#[test]
fn a_run_ends_where_no_step_conserves_the_energy() -> Result<(), Error> {
    for size in [0.05, 0.025, 0.0125] {
        let start = State::from_arrays(0.0, [1.25, 0.0], [0.0, 0.5]);
        let mut run = EnergyMomentumSteps::run(Midpoint(Ring), start, size)?;
        run.step()?;
        let curvature = run.stepper().curvature().expect("a step");
        let error = loop {
            assert!(run.steps() < 1000);
            let state = run.state().clone();
            if let Err(error) = run.step() {
                assert_eq!(*run.state(), state);
                break error;
            }
        };
        assert!(run.step_size() > size);
        let Error::NoEnergyStep {
            time,
            step,
            curvature: last,
            ..
        } = error
        else {
            panic!("{error}")
        };
        assert_eq!((time, step), (run.state().time, run.steps() + 1));
        assert!(last < 0.5 * curvature, "{last} {curvature}");
        assert!(
            error
                .to_string()
                .contains("no step between half and twice the size")
        );
    }
    Ok(())
}

/// Kepler's problem about a centre at (x, 0).
struct About(f64);

impl DiscreteLagrangian for About {
    type Vector<T: Scalar> = Plane<T>;

    fn value<T: Scalar>(&self, time: T, h: T, q0: &Plane<T>, q1: &Plane<T>) -> T {
        let centre = Plane::from([T::from_f64(self.0), T::zero()]);
        Midpoint(Attraction).value(time, h, &(q0 - centre), &(q1 - centre))
    }
}

#[test]
fn rounding_errors_of_positions_do_not_end_a_run() -> Result<(), Error> {
    // The same orbit far from the origin, and in steps that are short beside the distance.
    for (x, size) in [(1e4, 0.01), (1e6, 0.01), (0.0, 1e-5), (0.0, 1e-7)] {
        let mut start = pericentre(0.5);
        let mut near = EnergyMomentumSteps::run(About(0.0), start.clone(), 0.01)?;
        start.q[0] += x;
        let mut run = EnergyMomentumSteps::run(About(x), start, size)?;
        for _ in 0..50 {
            run.step()?;
            near.step()?;
        }
        let (found, expected) = match x {
            0.0 => (run.state().q, position(0.5, run.state().time)),
            _ => (run.state().q - Vector2::new(x, 0.0), near.state().q),
        };
        // The rounding of the position, 10⁻¹⁰ where x is 10⁶, times the condition h⁻².
        assert!(
            (found - expected).norm() < 1e-4,
            "{x} {size}: {found} {expected}"
        );
    }
    Ok(())
}

struct Free;

impl Potential for Free {
    fn value<T: Scalar>(&self, _: T) -> T {
        T::zero()
    }
}

#[test]
fn a_free_particle_conserves_the_energy_by_every_step() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [0.25, 0.0], [1.0, 0.5]);
    let mut run = EnergyMomentumSteps::run(Midpoint(Free), start, 0.125)?;
    for _ in 0..8 {
        run.step()?;
    }
    assert!((run.state().q - Vector2::new(1.25, 0.5)).norm() < 1e-15);
    assert_eq!(run.step_size(), 0.125);
    Ok(())
}

#[test]
fn bad_step_sizes_and_states_are_refused() {
    let start = || pericentre(0.5);
    for size in [0.0, f64::NAN] {
        let made = EnergyMomentumSteps::run(Midpoint(Ring), start(), size);
        assert!(matches!(made.err(), Some(Error::StepSize { .. })));
    }
    let mut bad = start();
    bad.p[0] = f64::INFINITY;
    let made = EnergyMomentumSteps::run(Midpoint(Ring), bad, 0.1);
    assert!(matches!(made.err(), Some(Error::NonFiniteState { .. })));
}
