//! Newton's iteration for as many conditions as unknowns, in approximate dyadic arithmetic.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::linear::{Dyadics, inverse, magnitude, middle, point, rescaled};
use super::system::System;
use crate::arithmetic::interval::Interval;

/// The maximum number of iterations from the printed digits. A handful suffices near a regular solution; a solution
/// found after many iterations is unrelated to the digits.
const MAX_ITERATIONS: usize = 24;
/// The iteration stops without a solution when an unknown exceeds `2^12`.
const MAX_MAGNITUDE_BITS: u64 = 12;

/// Equations between arguments.
pub trait Equations: Clone + std::fmt::Debug {
    /// Enclosures of the residuals for all arguments in a box.
    fn residuals(&self, arguments: &[Interval]) -> Vec<Interval>;
    /// Enclosures of the derivatives with respect to some arguments, for all arguments in a box.
    fn derivatives(&self, arguments: &[Interval], by: &[usize]) -> Vec<Vec<Interval>>;
}

impl Equations for System {
    fn residuals(&self, arguments: &[Interval]) -> Vec<Interval> {
        self.residuals(arguments)
    }

    fn derivatives(&self, arguments: &[Interval], by: &[usize]) -> Vec<Vec<Interval>> {
        self.derivatives(arguments, by)
    }
}

/// As many conditions as unknowns: the other arguments are fixed.
#[derive(Debug, Clone)]
pub struct Square<S = System> {
    /// The conditions.
    pub system: S,
    /// The values of the fixed arguments.
    pub fixed: Vec<Option<BigRational>>,
    /// The indices of the free arguments.
    pub free: Vec<usize>,
}

impl Square {
    /// The arguments that are rational numbers: the fixed ones, and those that a linear condition determines from
    /// known ones.
    pub fn linear_values(&self) -> Vec<Option<BigRational>> {
        let mut known = self.fixed.clone();
        let sums = self.system.linear_conditions();
        // Each pass that determines an argument may make another one determinable.
        while let Some((argument, value)) = sums.iter().find_map(|sum| sum.missing(&known)) {
            known[argument] = Some(value);
        }
        known
    }
}

impl<S: Equations> Square<S> {
    /// All arguments, from the free ones.
    pub fn arguments(&self, free: &[Interval], bits: u32) -> Vec<Interval> {
        let mut next = free.iter();
        let value = |fixed: &Option<BigRational>| match fixed {
            Some(value) => Interval::enclosing(value, bits),
            None => next
                .next()
                .map_or_else(|| point(&BigInt::zero(), bits), Interval::clone),
        };
        self.fixed.iter().map(value).collect()
    }

    /// Enclosures of the residuals for free arguments in a box.
    pub fn residuals(&self, free: &[Interval], bits: u32) -> Vec<Interval> {
        self.system.residuals(&self.arguments(free, bits))
    }

    /// Enclosures of the derivatives with respect to the free arguments in a box.
    pub fn derivatives(&self, free: &[Interval], bits: u32) -> Vec<Vec<Interval>> {
        self.system
            .derivatives(&self.arguments(free, bits), &self.free)
    }

    /// The inverse of the derivative at a point, rounded.
    pub fn inverse_derivative(&self, at: &[BigInt], bits: u32) -> Option<Dyadics> {
        inverse(&self.derivatives(&points(at, bits), bits), bits)
    }

    /// `x − C F(x)`, rounded, with a matrix of `matrix_bits` binary places, and the largest correction.
    pub fn corrected(
        &self,
        at: &[BigInt],
        bits: u32,
        matrix: &Dyadics,
        matrix_bits: u32,
    ) -> (Vec<BigInt>, BigInt) {
        let residuals: Vec<BigInt> = {
            let residuals = self.residuals(&points(at, bits), bits);
            residuals.iter().map(middle).collect()
        };
        let mut largest = BigInt::zero();
        let mut moved = Vec::with_capacity(at.len());
        for (x, row) in at.iter().zip(matrix) {
            let sum: BigInt = row.iter().zip(&residuals).map(|(c, r)| c * r).sum();
            let correction = sum >> matrix_bits;
            largest = largest.max(correction.abs());
            moved.push(x - correction);
        }
        (moved, largest)
    }

    /// The limit of Newton's iteration, to all but some of the last binary places; `None` if it does not converge.
    pub fn solve(&self, start: &[BigRational], bits: u32) -> Option<Vec<BigInt>> {
        let enclosed = start.iter().map(|x| middle(&Interval::enclosing(x, bits)));
        let mut at: Vec<BigInt> = enclosed.collect();
        for _ in 0..MAX_ITERATIONS {
            let matrix = self.inverse_derivative(&at, bits)?;
            let (moved, largest) = self.corrected(&at, bits, &matrix, bits);
            at = moved;
            let too_large = |x: &BigInt| x.bits() > u64::from(bits) + MAX_MAGNITUDE_BITS;
            if at.iter().any(too_large) {
                return None;
            }
            if largest.bits() <= u64::from(bits / 4) {
                return Some(at);
            }
        }
        None
    }

    /// Refines an approximation with `from` correct binary places towards `bits` places, by at most three simplified
    /// Newton iterations, which share one derivative.
    pub fn polish(&self, at: &[BigInt], from: u32, bits: u32) -> Vec<BigInt> {
        let mut at: Vec<BigInt> = at.iter().map(|x| rescaled(x, from, bits)).collect();
        // The derivative only needs as many places as each iteration adds.
        let coarse = from.min(bits);
        let rounded: Vec<BigInt> = at.iter().map(|x| rescaled(x, bits, coarse)).collect();
        let Some(matrix) = self.inverse_derivative(&rounded, coarse) else {
            return at;
        };
        for _ in 0..3 {
            let (moved, largest) = self.corrected(&at, bits, &matrix, coarse);
            at = moved;
            // The error after this correction is its product with the error of the inverse.
            if largest.bits() <= u64::from(coarse / 2) {
                break;
            }
        }
        at
    }
}

/// Intervals that contain one number each.
pub fn points(at: &[BigInt], bits: u32) -> Vec<Interval> {
    at.iter().map(|x| point(x, bits)).collect()
}

/// The largest absolute value in some intervals.
pub fn largest(intervals: &[Interval]) -> BigInt {
    intervals
        .iter()
        .map(magnitude)
        .max()
        .unwrap_or_else(BigInt::zero)
}
