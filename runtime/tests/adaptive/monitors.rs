//! Monitors and their derivatives.

use symplectic::adaptive::{
    AdaptiveSteps, DistancePower, Error, ForcePower, Monitor, PairDistances,
};
use symplectic::nalgebra::{Vector2, Vector6};
use symplectic::{Scalar, State, acceleration};

use super::kepler::{Kepler, VelocityVerlet, pericentre};

/// A monitor the derivatives of which are left to dual numbers.
struct ByDuals<W>(W);

impl<W: Monitor> Monitor for ByDuals<W> {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        self.0.value(q)
    }
}

const PAIRS: PairDistances = PairDistances {
    dimensions: 2,
    sharpness: 3,
    exponent: 1.25,
};

#[test]
fn logarithmic_gradients_are_those_of_the_values() {
    fn check<W: Monitor>(monitor: W, q: [f64; 6]) {
        let mut gradient = [f64::NAN; 6];
        assert!(monitor.logarithmic_gradient(&q, &mut gradient));
        for k in 0..6 {
            // Differences of order 4.
            let at = |shift: f64| {
                let mut q = q;
                q[k] += shift;
                monitor.value::<f64>(&q).ln()
            };
            const H: f64 = 1e-3;
            let slope = (8.0 * (at(H) - at(-H)) - (at(2.0 * H) - at(-2.0 * H))) / (12.0 * H);
            assert!(
                (slope - gradient[k]).abs() < 1e-9,
                "{k}: {slope} {gradient:?}"
            );
        }
    }
    let q = [0.3, -0.4, 1.2, 0.7, -0.9, 1.6];
    check(DistancePower(1.5), q);
    check(DistancePower(-0.7), q);
    check(PAIRS, q);
}

#[test]
fn pairs_see_the_least_distance() {
    let far = [0.0, 0.0, 0.1, 0.0, 30.0, 40.0];
    let least = PAIRS.value::<f64>(&far) / 0.1_f64.powf(1.25);
    assert!((least - 1.0).abs() < 1e-9, "{least}");
    // Where all three distances are 1 the sum has three terms.
    let height = 0.75_f64.sqrt();
    let triangle = PAIRS.value::<f64>(&[0.0, 0.0, 1.0, 0.0, 0.5, height]);
    assert!((triangle - 3.0_f64.powf(-1.25 / 6.0)).abs() < 1e-14);
    let moved = PAIRS.value::<f64>(&[5.0, 1.0, 6.0, 1.0, 5.5, 1.0 + height]);
    assert!((triangle - moved).abs() < 1e-14);
}

#[test]
fn components_left_over_do_not_count() {
    let triangle = [0.0, 0.0, 1.0, 0.0, 0.5, 0.75];
    let more = [0.0, 0.0, 1.0, 0.0, 0.5, 0.75, 9.0];
    assert_eq!(PAIRS.value::<f64>(&triangle), PAIRS.value::<f64>(&more));
    let (mut first, mut second) = ([0.0; 6], [f64::NAN; 7]);
    PAIRS.logarithmic_gradient(&triangle, &mut first);
    PAIRS.logarithmic_gradient(&more, &mut second);
    assert_eq!((&first[..], 0.0), (&second[..6], second[6]));
    // No space and no sharpness is no monitor, and no panic.
    for (dimensions, sharpness) in [(0, 2), (2, 0), (9, 2)] {
        let bad = PairDistances {
            dimensions,
            sharpness,
            exponent: 1.5,
        };
        bad.logarithmic_gradient(&triangle, &mut first);
        let value = bad.value::<f64>(&triangle);
        assert!(!(value > 0.0 && value.is_finite()), "{value}");
    }
}

#[test]
fn dual_numbers_give_the_same_steps() -> Result<(), Error> {
    let monitor = DistancePower(1.5);
    let start = || pericentre(0.6);
    let mut own = AdaptiveSteps::run(VelocityVerlet, Kepler, monitor, start(), 0.05)?;
    let mut duals = AdaptiveSteps::run(VelocityVerlet, Kepler, ByDuals(monitor), start(), 0.05)?;
    for _ in 0..200 {
        own.step()?;
        duals.step()?;
        assert!((own.step_size() / duals.step_size() - 1.0).abs() < 1e-10);
    }

    let bodies = || {
        acceleration(|_, q: &Vector6<f64>, acceleration: &mut Vector6<f64>| {
            acceleration.fill(0.0);
            for (i, j) in [(0, 2), (2, 4), (4, 0)] {
                let apart = Vector2::new(q[i] - q[j], q[i + 1] - q[j + 1]);
                let pull = apart / apart.norm().powi(3);
                for k in 0..2 {
                    acceleration[i + k] -= pull[k];
                    acceleration[j + k] += pull[k];
                }
            }
        })
    };
    let start = || State::from_arrays(0.0, [1.0, 3.0, -2.0, -1.0, 1.0, -1.0], [0.0; 6]);
    let mut own = AdaptiveSteps::run(VelocityVerlet, bodies(), PAIRS, start(), 0.02)?;
    let mut duals = AdaptiveSteps::run(VelocityVerlet, bodies(), ByDuals(PAIRS), start(), 0.02)?;
    for _ in 0..100 {
        own.step()?;
        duals.step()?;
        assert!((own.step_size() / duals.step_size() - 1.0).abs() < 1e-10);
    }
    Ok(())
}

symplectic::hamiltonian! {
    /// Kepler's problem, from its formula.
    FromFormula
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)
}

/// |F|^{-3/4} = |q|^{3/2}: the same steps.
#[test]
fn a_power_of_the_force_gives_the_steps_of_a_power_of_the_distance() -> Result<(), Error> {
    let by_force = ForcePower {
        system: FromFormula,
        exponent: 0.75,
        floor: 0.0,
    };
    let start = || pericentre(0.8);
    let mut distance =
        AdaptiveSteps::run(VelocityVerlet, Kepler, DistancePower(1.5), start(), 0.02)?;
    let mut force = AdaptiveSteps::run(VelocityVerlet, FromFormula, by_force, start(), 0.02)?;
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for _ in 0..500 {
        distance.step()?;
        force.step()?;
        let size = force.step_size();
        assert!((size / distance.step_size() - 1.0).abs() < 1e-10);
        (least, most) = (least.min(size), most.max(size));
    }
    assert!(most > 10.0 * least, "{least} {most}");
    // A floor bounds the steps where the force is weak, and a state of another size has none.
    let floor = ForcePower {
        floor: 2.0,
        ..by_force
    };
    assert!(floor.value(&[1e9, 0.0_f64]) <= 2.0_f64.powf(-0.75));
    assert!(by_force.value(&[1.0_f64; 3]).is_nan());
    Ok(())
}
