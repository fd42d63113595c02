//! The observed order: one step of the pendulum compared with its exact flow, in 96 digits.
//!
//! One [`Pendulum`] for each class of Hamiltonians. No tree and no order condition is used. The local error of a method of order `p` is
//! `C hᵖ⁺¹`, so that the error at `h` is `2ᵖ⁺¹` times the error at `h/2`. The steps are so small (`2⁻⁶⁷` at order 1, `2⁻¹⁷` at order 10)
//! that the next power of `h` is negligible. A step of ordinary size can suggest an order that a method does not have.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::algebra::Number;
use crate::coefficients::Coefficients;
use crate::partitioned::LowerTriangular;

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

/// A Hamiltonian of the pendulum; each represents the smallest class that contains it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pendulum {
    /// `H = p²/2 − cos q`, with quadratic kinetic energy.
    Quadratic,
    /// `H = √(1 + p²) − cos q`, separable.
    Relativistic,
    /// `H = √(1 + p²) (2 − cos q)`, not separable.
    Coupled,
}

/// The order observed on a pendulum; `expected` determines the size of the step.
pub(crate) fn observed_order(
    numbers: Coefficients<Number<'_>>,
    lower_triangular: Option<LowerTriangular>,
    pendulum: Pendulum,
    expected: usize,
) -> Option<f64> {
    if !numbers.gradient.is_empty() && pendulum != Pendulum::Quadratic {
        return None;
    }
    let bits = u32::try_from(BITS + 16).unwrap_or(u32::MAX);
    let method = numbers.map(|number| fixed(&number.enclose(bits).middle()));
    let own_kick = lower_triangular.is_some_and(LowerTriangular::has_own_kick);
    // The weights 2g_j of the gradient kicks in the momentum of a stage, as ã has those of the forces.
    let weight = |i: usize, j: usize, weight: &BigInt| match j < i + usize::from(own_kick) {
        true => weight * 2,
        false => BigInt::zero(),
    };
    let row = |i: usize| {
        let all = method.gradient.iter().enumerate();
        all.map(|(j, g)| weight(i, j, g)).collect()
    };
    let gradients: Vec<Vec<BigInt>> = (0..=method.b.len()).map(row).collect();
    let start = [(5, 13), (4, 17)].map(|(p, q)| (BigInt::from(p) << BITS) / q);
    let series = series(pendulum, &start);
    let halvings = ERROR_BITS / (expected + 2);
    let mut logarithms = [0.0; 2];
    for (logarithm, halvings) in logarithms.iter_mut().zip([halvings, halvings + 1]) {
        let found = step(&method, &gradients, pendulum, &start, halvings)?;
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

/// `∂H/∂p`
fn velocity(pendulum: Pendulum, q: &BigInt, p: &BigInt) -> BigInt {
    match pendulum {
        Pendulum::Quadratic => p.clone(),
        Pendulum::Relativistic => product(p, &inverse_root(p)),
        Pendulum::Coupled => {
            let factor = factor(&cosine(&sine(q)));
            product(&product(p, &inverse_root(p)), &factor)
        }
    }
}

/// `−∂H/∂q`
fn force(pendulum: Pendulum, q: &BigInt, p: &BigInt) -> BigInt {
    let sine = sine(q);
    match pendulum {
        Pendulum::Quadratic | Pendulum::Relativistic => -sine,
        Pendulum::Coupled => -product(&root(p), &sine),
    }
}

/// `f′ f` for the force `f` of `H = p²/2 − cos q`
fn gradient(q: &BigInt) -> BigInt {
    let sine = sine(q);
    product(&cosine(&sine), &sine)
}

/// `2 − cos q`
fn factor(cosine: &BigInt) -> BigInt {
    (BigInt::from(2) << BITS) - cosine
}

/// `√(1 + p²)`
fn root(p: &BigInt) -> BigInt {
    let one = BigInt::one() << (2 * BITS);
    (one + p * p).sqrt()
}

/// `1/√(1 + p²)`
fn inverse_root(p: &BigInt) -> BigInt {
    (BigInt::one() << (2 * BITS)) / root(p)
}

/// The Taylor coefficients of `q` and `p`, from the polynomial system for `q, p, sin q, cos q, 1/w, w, m`. Here `w` is `√(1 + p²)` and `m`
/// is `2 − cos q`, or 1 where `H` does not have them: `q' = p m/w`, `p' = −w sin q` or `−sin q`.
fn series(pendulum: Pendulum, start: &[BigInt; 2]) -> Vec<[BigInt; 2]> {
    let [q, p] = start;
    let one = BigInt::one() << BITS;
    let (sine, relativistic) = (sine(q), pendulum != Pendulum::Quadratic);
    let (cosine, coupled) = (cosine(&sine), pendulum == Pendulum::Coupled);
    let mut y: [Vec<BigInt>; 7] = [
        q.clone(),
        p.clone(),
        sine,
        cosine.clone(),
        if relativistic {
            inverse_root(p)
        } else {
            one.clone()
        },
        if coupled { root(p) } else { one.clone() },
        if coupled { factor(&cosine) } else { one },
    ]
    .map(|first| vec![first]);
    let coefficient = |x: &[BigInt], y: &[BigInt], n: usize| -> BigInt {
        let products = (0..=n).map(|k| &x[k] * &y[n - k]);
        products.sum::<BigInt>() >> BITS
    };
    // Products of series, extended together with them: p/w, q', p', w⁻³, p p', (√(1 + p²))'.
    let mut products: [Vec<BigInt>; 7] = Default::default();
    for n in 0..TERMS {
        let [ratios, velocities, forces, squares, cubes, momenta, growth] = &mut products;
        ratios.push(coefficient(&y[1], &y[4], n));
        velocities.push(coefficient(ratios, &y[6], n));
        forces.push(-coefficient(&y[5], &y[2], n));
        squares.push(coefficient(&y[4], &y[4], n));
        cubes.push(coefficient(squares, &y[4], n));
        momenta.push(coefficient(&y[1], forces, n));
        growth.push(coefficient(ratios, forces, n));
        let only = |holds: bool, slope: BigInt| if holds { slope } else { BigInt::zero() };
        let turned = coefficient(&y[2], velocities, n);
        let slopes = [
            velocities[n].clone(),
            forces[n].clone(),
            coefficient(&y[3], velocities, n),
            -turned.clone(),
            only(relativistic, -coefficient(cubes, momenta, n)),
            only(coupled, growth[n].clone()),
            only(coupled, turned),
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
    gradients: &[Vec<BigInt>],
    pendulum: Pendulum,
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
    let mut points = vec![start.clone(); stages];
    let mut velocities = vec![velocity(pendulum, q, p); stages];
    let mut forces = vec![force(pendulum, q, p); stages];
    let kicked = |i: usize, row: &[BigInt], points: &[[BigInt; 2]], forces: &[BigInt]| {
        let row_of_gradients = gradients[i]
            .iter()
            .zip(points)
            .filter(|(g, _)| !g.is_zero());
        let sum: BigInt = row_of_gradients.map(|(g, [q, _])| g * gradient(q)).sum();
        advanced(p, row, forces) + (sum >> (BITS + 3 * halvings))
    };
    for _ in 0..SWEEPS {
        let mut moved = 0;
        for i in 0..stages {
            // The stages of a splitting are found in one sweep if H is separable.
            let kick_first = !method.a_tilde[i][i].is_zero();
            for positions in [kick_first, !kick_first] {
                let (slopes, new) = match positions {
                    true => {
                        points[i][0] = advanced(q, &method.a[i], &velocities);
                        let [q, p] = &points[i];
                        (&mut forces, force(pendulum, q, p))
                    }
                    false => {
                        points[i][1] = kicked(i, &method.a_tilde[i], &points, &forces);
                        let [q, p] = &points[i];
                        (&mut velocities, velocity(pendulum, q, p))
                    }
                };
                moved = moved.max((&new - &slopes[i]).abs().bits());
                slopes[i] = new;
            }
        }
        if moved <= 4 {
            return Some([
                advanced(q, &method.b, &velocities),
                kicked(stages, &method.b_tilde, &points, &forces),
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
        for pendulum in [
            Pendulum::Quadratic,
            Pendulum::Relativistic,
            Pendulum::Coupled,
        ] {
            let start = [(5, 13), (4, 17)].map(|(p, q)| (BigInt::from(p) << BITS) / q);
            let series = series(pendulum, &start);
            let end = [0, 1].map(|i| -> BigInt {
                let terms = series.iter().enumerate();
                terms.map(|(n, term)| &term[i] >> (n * 17)).sum()
            });
            let energy = |[q, p]: &[BigInt; 2]| {
                let cosine = cosine(&sine(q));
                match pendulum {
                    Pendulum::Quadratic => product(p, p) / 2 - cosine,
                    Pendulum::Relativistic => root(p) - cosine,
                    Pendulum::Coupled => product(&root(p), &factor(&cosine)),
                }
            };
            assert!(
                (energy(&end) - energy(&start)).abs().bits() < 12,
                "{pendulum:?}"
            );
        }
    }
}
