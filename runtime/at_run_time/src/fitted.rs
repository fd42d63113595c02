//! Methods that are fitted to a frequency: coefficients as functions of `ν = wh`.

use alloc::vec::Vec;

use symplectic_core::Orders;

use crate::coefficients::RunTimeCoefficients;
use crate::error::TableauError;
use crate::tableau::RunTimeTableau;
use crate::wide::Wide;

/// Larger angles `|wh|` are refused: a step would be longer than ten periods.
const LARGEST: f64 = 64.0;

/// A sum is used as a divisor if it is at least this part of the bound on its terms. The rest of its 104 bits is then enough for
/// a double.
const SMALLEST_PART: f64 = 1.0 / (1_u64 << 40) as f64;

/// `coefficient·νᵏ·cos(frequency·ν)`, or with the sine. A number is the sum of two doubles.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedTerm {
    /// The factor.
    pub coefficient: [f64; 2],
    /// `k`
    pub power: u32,
    /// The factor of `ν` in the angle.
    pub frequency: [f64; 2],
    /// Whether it is a sine.
    pub sine: bool,
}

/// A coefficient: its power series for small `ν`, and its numerator over the common denominator.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedEntry {
    /// The coefficients of `1, ν, ν², …`.
    pub series: &'static [[f64; 2]],
    /// The numerator.
    pub numerator: &'static [FittedTerm],
}

/// The coefficients of a method that `tableau!` with `parameters` emits, as functions of `ν = wh`, the product of frequency and step size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedCoefficients {
    #[doc(hidden)]
    pub name: &'static str,
    #[doc(hidden)]
    pub orders: Orders,
    /// The largest `|ν|` at which the series are used.
    #[doc(hidden)]
    pub near: f64,
    #[doc(hidden)]
    pub denominator: &'static [FittedTerm],
    #[doc(hidden)]
    pub a: &'static [&'static [FittedEntry]],
    #[doc(hidden)]
    pub b: &'static [FittedEntry],
    #[doc(hidden)]
    pub exchanged: bool,
}

impl FittedCoefficients {
    /// The coefficients at `ν`.
    ///
    /// Each is within two units in the last place of the exact function of this double: near 0 by its power series, elsewhere by its
    /// closed form, in numbers of two doubles.
    ///
    /// # Errors
    ///
    /// * [`TableauError::Angle`] if `ν` is not a number or its absolute value is above 64;
    /// * [`TableauError::NoMethod`] if `ν` is a zero of a weight or of the denominator, to twelve digits.
    pub fn at(&self, nu: f64) -> Result<RunTimeCoefficients, TableauError> {
        if nu.is_nan() || nu.abs() > LARGEST {
            return Err(TableauError::Angle { nu });
        }
        let angle = Wide::of(nu);
        let none = TableauError::NoMethod { nu };
        let small = nu.abs() <= self.near;
        let denominator = match small {
            true => Wide::ONE,
            false => divisor(self.denominator, angle).ok_or_else(|| none.clone())?,
        };
        let value = |entry: &FittedEntry| match small {
            true => series(entry.series, angle),
            false => total(entry.numerator, angle).0 / denominator,
        };
        let mut b: Vec<Wide> = Vec::new();
        for entry in self.b {
            if !small && divisor(entry.numerator, angle).is_none() {
                return Err(none);
            }
            b.push(value(entry));
        }
        let row = |row: &&[FittedEntry]| -> Vec<Wide> { row.iter().map(value).collect() };
        let a: Vec<Vec<Wide>> = self.a.iter().map(row).collect();
        // ã_ij = b_j (b_i − a_ji)/b_i
        let partner: Vec<Vec<Wide>> = b
            .iter()
            .enumerate()
            .map(|(i, weight)| {
                let entry = |(row, b_j): (&Vec<Wide>, &Wide)| *b_j * (*weight - row[i]) / *weight;
                a.iter().zip(&b).map(entry).collect()
            })
            .collect();
        let (a, a_tilde) = match self.exchanged {
            false => (a, partner),
            true => (partner, a),
        };
        let doubles = |list: &[Wide]| -> Vec<f64> { list.iter().map(|x| x.double()).collect() };
        let matrix =
            |m: &[Vec<Wide>]| -> Vec<Vec<f64>> { m.iter().map(|row| doubles(row)).collect() };
        let sums = |m: &[Vec<Wide>]| -> Vec<f64> {
            let sum = |row: &Vec<Wide>| row.iter().fold(Wide::ZERO, |sum, x| sum + *x).double();
            m.iter().map(sum).collect()
        };
        Ok(RunTimeCoefficients {
            c: sums(&a),
            c_tilde: sums(&a_tilde),
            a: matrix(&a),
            a_tilde: matrix(&a_tilde),
            b: doubles(&b),
            b_tilde: doubles(&b),
            gradient: Vec::new(),
        })
    }

    /// The method at `ν`, for [`Integrator::new`](symplectic_core::Integrator#method.new) with the step size `ν/w`.
    ///
    /// # Errors
    ///
    /// Those of [`Self::at`].
    pub fn method(&self, nu: f64) -> Result<RunTimeTableau, TableauError> {
        RunTimeTableau::fitted(self.name, self.at(nu)?, self.orders)
    }
}

/// A sum of terms, and a bound on the sum of their absolute values.
fn total(terms: &[FittedTerm], nu: Wide) -> (Wide, f64) {
    terms.iter().fold((Wide::ZERO, 0.0), |(sum, size), term| {
        let (sine, cosine) = (Wide::pair(term.frequency) * nu).sine_cosine();
        let wave = if term.sine { sine } else { cosine };
        let factor = Wide::pair(term.coefficient) * nu.power(term.power);
        (sum + factor * wave, size + factor.absolute().high)
    })
}

/// A sum that is not zero up to rounding.
fn divisor(terms: &[FittedTerm], nu: Wide) -> Option<Wide> {
    let (sum, size) = total(terms, nu);
    (sum.absolute().high > SMALLEST_PART * size).then_some(sum)
}

/// Horner's rule.
fn series(coefficients: &[[f64; 2]], nu: Wide) -> Wide {
    let terms = coefficients.iter().rev();
    terms.fold(Wide::ZERO, |sum, pair| sum * nu + Wide::pair(*pair))
}
