//! Statistics over many orbits of the effect of rounding errors on the energy.
//!
//! With an ideal integrator the energy error of an orbit is a random walk: its mean over an ensemble is zero, and its
//! spread grows like the square root of the number of steps (Brouwer's law). A drift is a mean that differs from zero
//! by many standard errors and grows linearly with the number of steps.

use symplectic::solver::Solver;
use symplectic::{Error, Integrator, Method, ProvedFor, State, Summation, System, Vector};

/// The relative energy errors of an ensemble after a number of steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Steps taken.
    pub steps: u64,
    /// The mean.
    pub mean: f64,
    /// The standard deviation.
    pub spread: f64,
    /// The mean in units of its standard error, `spread/√orbits`.
    pub significance: f64,
}

/// Integrates every orbit with the integrator that `integrator` creates from its start, and samples after each number
/// of `steps`, in ascending order.
///
/// # Errors
///
/// Those of a step.
pub fn ensemble<M, S, V, R, N>(
    integrator: impl Fn(State<V>) -> Result<Integrator<M, S, V, R, N>, Error>,
    starts: &[State<V>],
    steps: &[u64],
) -> Result<Vec<Sample>, Error>
where
    M: Method + ProvedFor<S::Class>,
    S: System<V>,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    let mut errors = vec![Vec::new(); steps.len()];
    for start in starts {
        let mut orbit = integrator(start.clone())?;
        let energy = orbit.energy().unwrap_or(f64::NAN);
        for (&steps, errors) in steps.iter().zip(&mut errors) {
            while orbit.steps() < steps {
                orbit.step()?;
            }
            let change = orbit.energy().unwrap_or(f64::NAN) - energy;
            errors.push(change / energy.abs());
        }
    }
    let samples = steps.iter().zip(&errors);
    Ok(samples
        .map(|(&steps, errors)| sample(steps, errors))
        .collect())
}

fn sample(steps: u64, errors: &[f64]) -> Sample {
    let count = errors.len() as f64;
    let mean = errors.iter().sum::<f64>() / count;
    let squares = errors.iter().map(|error| (error - mean) * (error - mean));
    let spread = (squares.sum::<f64>() / (count - 1.0)).sqrt();
    Sample {
        steps,
        mean,
        spread,
        significance: mean / (spread / count.sqrt()),
    }
}

/// The exponent `k` of a quantity that grows like `stepsᵏ`, by a least-squares fit of the logarithms.
pub fn exponent(samples: &[Sample], quantity: impl Fn(&Sample) -> f64) -> f64 {
    let points = samples
        .iter()
        .map(|sample| ((sample.steps as f64).ln(), quantity(sample).abs().ln()));
    let points: Vec<(f64, f64)> = points.collect();
    let count = points.len() as f64;
    let (x, y) = points
        .iter()
        .fold((0.0, 0.0), |(x, y), point| (x + point.0, y + point.1));
    let (x, y) = (x / count, y / count);
    let covariance: f64 = points
        .iter()
        .map(|point| (point.0 - x) * (point.1 - y))
        .sum();
    let variance: f64 = points.iter().map(|point| (point.0 - x).powi(2)).sum();
    covariance / variance
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drift_statistics_of_known_numbers_are_right() {
        let found = sample(4, &[1.0, 3.0]);
        assert_eq!((found.mean, found.spread), (2.0, 2.0_f64.sqrt()));
        assert!((found.significance - 2.0).abs() < 1e-15);
        let samples: Vec<Sample> = [1_u64, 4, 16, 64]
            .iter()
            .map(|&steps| Sample {
                steps,
                mean: steps as f64,
                spread: (steps as f64).sqrt(),
                significance: 0.0,
            })
            .collect();
        assert!((exponent(&samples, |sample| sample.mean) - 1.0).abs() < 1e-14);
        assert!((exponent(&samples, |sample| sample.spread) - 0.5).abs() < 1e-14);
    }
}
