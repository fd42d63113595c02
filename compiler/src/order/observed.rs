//! The observed order: one step of the pendulum compared with its exact flow, in 96 digits.
//!
//! `H = T(p) − cos q` with `T = p²/2`, which is in the Nyström class, or with `T = √(1 + p²)`, which is in no smaller class than the
//! separable one. No tree and no order condition is used. The local error of a method of order `p` is `C hᵖ⁺¹`, so that the error at
//! `h` is `2ᵖ⁺¹` times the error at `h/2`. The steps are so small (`2⁻⁶⁷` at order 1, `2⁻¹⁷` at order 10) that the next power of `h`
//! is negligible. A step of ordinary size can suggest an order that a method does not have.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::coefficients::Coefficients;
use crate::tableau::Tableau;

/// Numbers are integers, in units of `2^−BITS`.
const BITS: usize = 320;
/// The binary places of the error that are used.
const ERROR_BITS: usize = 200;
/// Errors below this many bits count as round-off.
const NOISE_BITS: u64 = 40;
/// The number of terms of the Taylor series of the exact flow: `(2⁻¹⁷)²⁴` is below a unit.
const TERMS: usize = 24;
/// Sweeps over the stages; each reduces the error by a factor proportional to `h`.
const SWEEPS: usize = 64;

/// A kinetic energy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kinetic {
    /// `T = p²/2`
    Quadratic,
    /// `T = √(1 + p²)`
    Relativistic,
}

impl Tableau {
    /// The order observed on the pendulum with a kinetic energy: `log₂` of the ratio of the errors of one step, minus 1.
    /// `expected` determines the size of the step.
    ///
    /// `None` if the error is lost in round-off, because the order is much higher than expected, or if the iteration for the
    /// stages does not converge.
    ///
    /// ```
    /// use symplectic_compiler::{catalogue, order::Kinetic};
    ///
    /// // Of order 4 for quadratic T, of order 3 for others.
    /// let method = catalogue::find("mclachlan-atela-1992-order-4-optimal").expect("a known method").derive()?;
    /// let seen = |kinetic, expected| method.observed_order(kinetic, expected).expect("an order");
    /// assert!((seen(Kinetic::Quadratic, 4) - 4.0).abs() < 0.01);
    /// assert!((seen(Kinetic::Relativistic, 4) - 3.0).abs() < 0.01);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn observed_order(&self, kinetic: Kinetic, expected: usize) -> Option<f64> {
        let bits = u32::try_from(BITS + 16).unwrap_or(u32::MAX);
        let method = self
            .numbers()
            .map(|number| fixed(&number.enclose(bits).middle()));
        let start = [(5, 13), (4, 17)].map(|(p, q)| (BigInt::from(p) << BITS) / q);
        let series = series(kinetic, &start);
        let halvings = ERROR_BITS / (expected + 2);
        let mut logarithms = [0.0; 2];
        for (logarithm, halvings) in logarithms.iter_mut().zip([halvings, halvings + 1]) {
            let found = step(&method, kinetic, &start, halvings)?;
            let exact = [0, 1].map(|i| -> BigInt {
                let terms = series.iter().enumerate();
                terms.map(|(n, term)| &term[i] >> (n * halvings)).sum()
            });
            let squares = found.iter().zip(&exact).map(|(x, y)| (x - y).pow(2));
            let square: BigInt = squares.sum();
            if square.bits() <= 2 * NOISE_BITS {
                return None;
            }
            *logarithm = log2(&square) / 2.0;
        }
        Some(logarithms[0] - logarithms[1] - 1.0)
    }
}

/// A rational number in units of `2^−BITS`.
fn fixed(value: &BigRational) -> BigInt {
    (value.numer() << BITS) / value.denom()
}

fn product(x: &BigInt, y: &BigInt) -> BigInt {
    (x * y) >> BITS
}

/// The logarithm to base 2 of a positive integer.
fn log2(integer: &BigInt) -> f64 {
    let more = integer.bits().saturating_sub(60);
    let leading = (integer >> more).to_f64().unwrap_or(1.0);
    leading.log2() + more as f64
}

fn sine(x: &BigInt) -> BigInt {
    let square = product(x, x);
    let (mut term, mut sum) = (x.clone(), x.clone());
    let mut n = 1_u32;
    while !term.is_zero() && n < 400 {
        term = -product(&term, &square) / ((n + 1) * (n + 2));
        sum += &term;
        n += 2;
    }
    sum
}

/// `cos x = √(1 − sin² x)`, for `|x| < π/2`.
fn cosine(sine: &BigInt) -> BigInt {
    let one = BigInt::one() << (2 * BITS);
    (one - sine * sine).sqrt()
}

/// `∂T/∂p`
fn velocity(kinetic: Kinetic, p: &BigInt) -> BigInt {
    match kinetic {
        Kinetic::Quadratic => p.clone(),
        Kinetic::Relativistic => product(p, &inverse_root(p)),
    }
}

/// `1/√(1 + p²)`
fn inverse_root(p: &BigInt) -> BigInt {
    let one = BigInt::one() << (2 * BITS);
    let root = (&one + p * p).sqrt();
    one / root
}

/// The Taylor coefficients of `q` and `p`, from the polynomial system for `q, p, sin q, cos q, 1/√(1 + p²)`.
fn series(kinetic: Kinetic, start: &[BigInt; 2]) -> Vec<[BigInt; 2]> {
    let [q, p] = start;
    let sine = sine(q);
    let root = match kinetic {
        Kinetic::Quadratic => BigInt::one() << BITS,
        Kinetic::Relativistic => inverse_root(p),
    };
    let mut y: [Vec<BigInt>; 5] = [
        vec![q.clone()],
        vec![p.clone()],
        vec![sine.clone()],
        vec![cosine(&sine)],
        vec![root],
    ];
    let coefficient = |x: &[BigInt], y: &[BigInt], n: usize| -> BigInt {
        let products = (0..=n).map(|k| &x[k] * &y[n - k]);
        products.sum::<BigInt>() >> BITS
    };
    // Products of series, extended together with them.
    let (mut velocities, mut forces): (Vec<BigInt>, Vec<BigInt>) = (Vec::new(), Vec::new());
    let (mut squares, mut cubes, mut momenta): (Vec<BigInt>, Vec<BigInt>, Vec<BigInt>) =
        (Vec::new(), Vec::new(), Vec::new());
    for n in 0..TERMS {
        velocities.push(coefficient(&y[1], &y[4], n));
        forces.push(-&y[2][n]);
        squares.push(coefficient(&y[4], &y[4], n));
        cubes.push(coefficient(&squares, &y[4], n));
        momenta.push(coefficient(&y[1], &forces, n));
        let slopes = [
            velocities[n].clone(),
            forces[n].clone(),
            coefficient(&y[3], &velocities, n),
            -coefficient(&y[2], &velocities, n),
            match kinetic {
                Kinetic::Quadratic => BigInt::zero(),
                Kinetic::Relativistic => -coefficient(&cubes, &momenta, n),
            },
        ];
        for (series, slope) in y.iter_mut().zip(slopes) {
            series.push(slope / (n + 1));
        }
    }
    let [q, p, ..] = y;
    q.into_iter().zip(p).map(|(q, p)| [q, p]).collect()
}

/// One step of the size `2^−halvings`.
fn step(
    method: &Coefficients<BigInt>,
    kinetic: Kinetic,
    start: &[BigInt; 2],
    halvings: usize,
) -> Option<[BigInt; 2]> {
    let [q, p] = start;
    let advanced = |from: &BigInt, row: &[BigInt], slopes: &[BigInt]| -> BigInt {
        let products = row.iter().zip(slopes).filter(|(a, _)| !a.is_zero());
        let sum: BigInt = products.map(|(a, slope)| a * slope).sum();
        from + (sum >> (BITS + halvings))
    };
    let stages = method.b.len();
    let mut velocities = vec![velocity(kinetic, p); stages];
    let mut forces = vec![-sine(q); stages];
    for _ in 0..SWEEPS {
        let mut moved = 0;
        for i in 0..stages {
            // Explicit stages are found in one sweep.
            let kick_first = !method.a_tilde[i][i].is_zero();
            for positions in [kick_first, !kick_first] {
                let (slopes, new) = match positions {
                    true => {
                        let position = advanced(q, &method.a[i], &velocities);
                        (&mut forces, -sine(&position))
                    }
                    false => {
                        let momentum = advanced(p, &method.a_tilde[i], &forces);
                        (&mut velocities, velocity(kinetic, &momentum))
                    }
                };
                moved = moved.max((&new - &slopes[i]).abs().bits());
                slopes[i] = new;
            }
        }
        if moved <= 4 {
            return Some([
                advanced(q, &method.b, &velocities),
                advanced(p, &method.b_tilde, &forces),
            ]);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reference conserves the energy.
    #[test]
    fn the_exact_flow_conserves_energy() {
        for kinetic in [Kinetic::Quadratic, Kinetic::Relativistic] {
            let start = [(5, 13), (4, 17)].map(|(p, q)| (BigInt::from(p) << BITS) / q);
            let series = series(kinetic, &start);
            let end = [0, 1].map(|i| -> BigInt {
                let terms = series.iter().enumerate();
                terms.map(|(n, term)| &term[i] >> (n * 17)).sum()
            });
            let energy = |[q, p]: &[BigInt; 2]| {
                let one = BigInt::one() << (2 * BITS);
                let kinetic = match kinetic {
                    Kinetic::Quadratic => product(p, p) / 2,
                    Kinetic::Relativistic => (one + p * p).sqrt(),
                };
                kinetic - cosine(&sine(q))
            };
            assert!(
                (energy(&end) - energy(&start)).abs().bits() < 12,
                "{kinetic:?}"
            );
        }
    }
}
