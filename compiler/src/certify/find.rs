//! Processors for a given kernel, by Newton's iteration from random starts.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use super::conditions::Claim;
use super::error::CertifyError;
use super::linear::middle;
use super::printed::Printed;
use super::processed::Processor;
use super::search::{certify_processed, system_of};
use super::splitting::check;
use super::structure::{Coefficient, processed_readings};
use super::system::System;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rounding::to_f64;

/// Binary places of the iteration.
const BITS: u32 = 128;
/// The iterations from one start.
const MAX_ITERATIONS: usize = 60;
/// The residual at which the certificate takes over.
const CLOSE: f64 = 1e-13;
/// Derivatives below this are those of conditions on the kernel alone.
const NO_DERIVATIVE: f64 = 1e-10;
/// The largest step of the iteration.
const LARGEST_STEP: f64 = 0.5;
/// The digits of the result.
const DIGITS: usize = 32;

/// Finds a processor `P(h) = Q(h) Q(−h)` for the kernel with these weights, so that `P K P⁻¹` has an order for every symmetric base: the one with
/// the smallest sum of magnitudes that Newton's iteration finds from `starts` starts, which are always the same. It has as many weights as
/// `count` and is certified with the kernel by [`certify_processed`].
///
/// `None` if no start leads to one: the kernel may have a lower conjugate order, there may be too few weights, or too few starts.
///
/// ```
/// use symplectic_compiler::certify::{Printed, certify_processed, find_processor};
///
/// // 7 steps of Störmer–Verlet with Σ w = 1 and Σ w³ = Σ w⁵ = 0: of order 4, and of conjugate order 6.
/// let [a, b, c] = ["-0.83416055508086497628193553653445", "0.43117553188395997977422677584312", "0.9436189826258900334669639696964"].map(Printed::parse);
/// let (a, b, c) = (a?, b?, c?);
/// let kernel = [&a, &b, &b, &c, &b, &b, &a].map(Clone::clone);
/// let processor = find_processor(&kernel, 6, 3, 4)?.expect("a processor");
/// assert!(certify_processed(&kernel, &processor, 6)?.wrong_digits().is_empty());
/// # Ok::<(), symplectic_compiler::certify::CertifyError>(())
/// ```
///
/// # Errors
/// [`CertifyError::Stages`], [`CertifyError::TooLarge`] and [`CertifyError::Order`] for a kernel or an order that cannot be certified.
pub fn find_processor(
    weights: &[Printed],
    order: usize,
    count: usize,
    starts: u32,
) -> Result<Option<Processor<Printed>>, CertifyError> {
    check(weights, Coefficient::Weight)?;
    let blank = Processor::BackAndForth(vec![Printed::zero(); count]);
    check(blank.weights(), Coefficient::Processor)?;
    let claim = Claim::SymmetricBase(order);
    claim.check()?;
    let readings = processed_readings(weights, &blank);
    let Some(reading) = readings.first() else {
        return Ok(None);
    };
    let values = reading.unknowns.iter().map(|unknown| unknown.start.clone());
    let search = Search {
        system: system_of(reading, &claim)?,
        kernel: values.take(reading.unknowns.len() - count).collect(),
        count,
    };
    let mut best: Option<(f64, Processor<Printed>)> = None;
    for start in 0..starts {
        let Some(found) = search.solved(start) else {
            continue;
        };
        let size: f64 = found.iter().map(|x| x.abs()).sum();
        if best.as_ref().is_some_and(|(known, _)| *known <= size) {
            continue;
        }
        if let Some(processor) = certified(weights, &found, order)? {
            best = Some((size, processor));
        }
    }
    Ok(best.map(|(_, processor)| processor))
}

/// The certified weights near some numbers, if there are any.
fn certified(
    weights: &[Printed],
    near: &[f64],
    order: usize,
) -> Result<Option<Processor<Printed>>, CertifyError> {
    let printed = near.iter().map(|x| Printed::parse(&format!("{x:.15}")));
    let printed = Processor::BackAndForth(printed.collect::<Result<_, _>>()?);
    let Ok(certificate) = certify_processed(weights, &printed, order) else {
        return Ok(None);
    };
    let digits = (0..near.len()).map(|k| {
        let decimal = certificate.decimal(Coefficient::Processor(k), DIGITS)?;
        Printed::parse(&decimal.map_or_else(String::new, |decimal| decimal.to_string()))
    });
    let found = Processor::BackAndForth(digits.collect::<Result<_, _>>()?);
    let again = certify_processed(weights, &found, order);
    let right = again.is_ok_and(|certificate| certificate.wrong_digits().is_empty());
    Ok(right.then_some(found))
}

struct Search {
    system: System,
    /// The unknowns of the kernel, which come first.
    kernel: Vec<BigRational>,
    count: usize,
}

impl Search {
    /// A solution by steps of least length, if the iteration from this start converges.
    fn solved(&self, start: u32) -> Option<Vec<f64>> {
        let mut random = Random(u64::from(start));
        let mut at: Vec<f64> = (0..self.count).map(|_| random.next() - 0.5).collect();
        let mean = at.iter().sum::<f64>() / self.count as f64;
        at.iter_mut().for_each(|x| *x -= mean);
        for _ in 0..MAX_ITERATIONS {
            let (residuals, rows) = self.equations(&at)?;
            let largest = residuals.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            if largest < CLOSE {
                return Some(at);
            }
            // J⁺ r = Jᵀ (J Jᵀ)⁻¹ r
            let products = |x: &Vec<f64>| rows.iter().map(|y| dot(x, y)).collect();
            let multipliers = solve(rows.iter().map(products).collect(), residuals)?;
            let step = (0..self.count).map(|column| {
                let terms = rows.iter().zip(&multipliers);
                terms.map(|(row, y)| row[column] * y).sum::<f64>()
            });
            let step: Vec<f64> = step.collect();
            let shrink = (LARGEST_STEP / dot(&step, &step).sqrt()).min(1.0);
            at.iter_mut()
                .zip(&step)
                .for_each(|(x, step)| *x -= shrink * step);
        }
        None
    }

    /// The residuals of the conditions that depend on the processor, and their derivatives.
    fn equations(&self, at: &[f64]) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
        let processor = at.iter().map(|x| BigRational::from_float(*x));
        let processor: Vec<BigRational> = processor.collect::<Option<_>>()?;
        let all = self.kernel.iter().chain(&processor);
        let all: Vec<Interval> = all.map(|x| Interval::enclosing(x, BITS)).collect();
        let by: Vec<usize> = (self.kernel.len()..all.len()).collect();
        let unit = BigInt::one() << BITS;
        let float = |x: &Interval| to_f64(&BigRational::new(middle(x), unit.clone()));
        let rows = self.system.derivatives(&all, &by);
        let rows = rows.iter().map(|row| row.iter().map(float).collect());
        let residuals = self.system.residuals(&all);
        let pairs = residuals.iter().map(float).zip(rows);
        let depends = |row: &Vec<f64>| row.iter().any(|x| x.abs() > NO_DERIVATIVE);
        Some(pairs.filter(|(_, row)| depends(row)).unzip())
    }
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// The solution of linear equations by elimination with pivots; `None` if there is no unique one.
fn solve(mut rows: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let n = right.len();
    for column in 0..n {
        let size = |row: usize| rows[row][column].abs();
        let pivot = (column..n).max_by(|&i, &j| size(i).total_cmp(&size(j)))?;
        if size(pivot) == 0.0 || size(pivot).is_nan() {
            return None;
        }
        rows.swap(column, pivot);
        right.swap(column, pivot);
        let own = rows[column].clone();
        for row in column + 1..n {
            let factor = rows[row][column] / own[column];
            rows[row]
                .iter_mut()
                .zip(&own)
                .for_each(|(x, y)| *x -= factor * y);
            right[row] -= factor * right[column];
        }
    }
    for row in (0..n).rev() {
        let known = dot(&rows[row][row + 1..], &right[row + 1..]);
        right[row] = (right[row] - known) / rows[row][row];
    }
    Some(right)
}

/// Numbers from 0 to 1 (SplitMix64: Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}
