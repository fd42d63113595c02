//! The proof that an exact solution exists, and where it is unique.
//!
//! Let `F` be the residuals as a function of the free coefficients, and `y` a point with exact dyadic coordinates. Let `C` be a matrix,
//! and `X` the cube of all `x` with `|x − y|_∞ ≤ ρ`. Interval arithmetic gives
//!
//! ```text
//! δ ≥ ‖C F(y)‖_∞        and        ε ≥ ‖1 − C F'(X)‖_∞.
//! ```
//!
//! **Existence** (Krawczyk 1969; Moore 1977; Rump 2010, §13). If `δ + ερ < ρ`, every component of
//! `K(X) = y − C F(y) + (1 − C F'(X))(X − y)` lies inside that of `X`. Then `g(x) = x − C F(x)` maps `X` into itself
//! and contracts it by `ε < 1`, so that it has exactly one fixed point in `X`. As `ε < 1`, `C` is regular, and the
//! fixed point is a zero of `F`.
//!
//! **Uniqueness** in a cube `X` around any point, for instance the printed one, follows from `ε(X) < 1`. Zeros `x, x'` in `X` have
//! `0 = C(F(x) − F(x')) = C M (x − x')` with the mean `M ∈ F'(X)` of the derivative on the segment between them, and `CM` is regular.
//!
//! **Refinement.** In the same way the zero `x*` and another point `z` of `X` satisfy `C F(z) = CM(z − x*)`, so
//! `‖z − x*‖_∞ ≤ ‖C F(z)‖_∞/(1 − ε)`. After any approximate iteration, one evaluation of `F` at `z`, rounded outward, encloses the
//! solution again. Simplified Newton iterations lead from one such `z` to the next, with more digits.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::linear::{Dyadics, ball, magnitude, middle, point, rescaled};
use super::newton::{Equations, Square, largest, points};
use super::system::System;
use crate::arithmetic::interval::Interval;

/// A proof fails if evaluating the conditions loses more binary places than this, whatever the precision. Conditions of
/// degree 20 are divided by 20!, which is 62 places.
const ROUNDING_BITS: u64 = 128;
/// The largest number of binary places of a refined solution that are unknown.
pub const LOST_BITS: u32 = 160;

/// The radius `2⁻⁶⁴` of the cube that is tried first.
const SMALL_RADIUS_BITS: u32 = 64;

/// A cube with exactly one solution, which a point approximates.
#[derive(Debug, Clone)]
pub struct Proof<S = System> {
    /// The conditions and the fixed arguments.
    pub square: Square<S>,
    /// The binary places of `center`, `matrix` and `radius`.
    pub bits: u32,
    /// The middle of the cube.
    pub center: Vec<BigInt>,
    /// `C`.
    matrix: Dyadics,
    /// Half the length of the cube's edges.
    radius: BigInt,
}

impl<S: Equations> Proof<S> {
    /// Proves that there is a solution near an approximate one; `None` if the proof fails.
    pub fn new(square: Square<S>, center: Vec<BigInt>, bits: u32) -> Option<Self> {
        let matrix = square.inverse_derivative(&center, bits)?;
        let mut proof = Proof {
            square,
            bits,
            center,
            matrix,
            radius: BigInt::zero(),
        };
        let delta = proof.step(&proof.center, bits);
        if delta.bits() > ROUNDING_BITS {
            return None;
        }
        // The contraction ε grows with the radius. A small radius usually works; otherwise bisection finds the largest power of two with
        // ε ≤ 1/2.
        let half = BigInt::one() << (bits - 1);
        let contraction = |exponent: u32| {
            let radius = BigInt::one() << exponent;
            proof.contraction(&proof.center, &radius)
        };
        let small = bits - SMALL_RADIUS_BITS;
        let exponent = if contraction(small) <= half {
            small
        } else {
            largest_power(bits, |radius| {
                proof.contraction(&proof.center, radius) <= half
            })?
        };
        let radius = BigInt::one() << exponent;
        let image = (delta << bits) + contraction(exponent) * &radius;
        proof.radius = radius;
        (image < (&proof.radius << bits)).then_some(proof)
    }

    /// An upper bound on `‖C F(z)‖_∞` for a point `z` with `bits` binary places, in units of the last place.
    fn step(&self, z: &[BigInt], bits: u32) -> BigInt {
        let residuals = self.square.residuals(&points(z, bits), bits);
        // Products with the entries of C are exact, with the places of both factors.
        let components = self.matrix.iter().map(|row| {
            let mut sum = point(&BigInt::zero(), bits + self.bits);
            for (entry, residual) in row.iter().zip(&residuals) {
                let (a, b) = (&residual.low * entry, &residual.high * entry);
                let (low, high) = if entry.is_negative() { (b, a) } else { (a, b) };
                sum.low += low;
                sum.high += high;
            }
            sum.with_bits(bits)
        });
        largest(&components.collect::<Vec<_>>())
    }

    /// An upper bound on `‖1 − C F'(X)‖_∞`, in units of `2⁻ᵇⁱᵗˢ`, for the cube `X` around a point.
    fn contraction(&self, around: &[BigInt], radius: &BigInt) -> BigInt {
        let cube: Vec<Interval> = around.iter().map(|x| ball(x, radius, self.bits)).collect();
        let derivatives = self.square.derivatives(&cube, self.bits);
        let one = BigInt::one() << self.bits;
        let row_sum = |(index, row): (usize, &Vec<BigInt>)| -> BigInt {
            let entry = |column: usize| {
                let start = if column == index {
                    one.clone()
                } else {
                    BigInt::zero()
                };
                let mut sum = point(&start, self.bits);
                for (entry, derivative) in row.iter().zip(&derivatives) {
                    let product = point(entry, self.bits).multiply(&derivative[column]);
                    sum = sum.subtract(&product);
                }
                magnitude(&sum)
            };
            (0..row.len()).map(entry).sum()
        };
        let sums = self.matrix.iter().enumerate().map(row_sum);
        sums.max().unwrap_or_else(BigInt::zero)
    }

    /// The largest power of two for which the solution is proved to be unique in the cube with that radius around a point; `None` if the
    /// point is not near enough for a proof.
    pub fn unique_around(&self, start: &[BigRational]) -> Option<BigRational> {
        let enclosed: Vec<Interval> = {
            let enclose = |x| Interval::enclosing(x, self.bits);
            start.iter().map(enclose).collect()
        };
        let around: Vec<BigInt> = enclosed.iter().map(middle).collect();
        let one = BigInt::one() << self.bits;
        // One extra unit in the last place covers the rounding of the point.
        let proved = |radius: &BigInt| self.contraction(&around, &(radius + 1u32)) < one;
        let radius = BigInt::one() << largest_power(self.bits, proved)?;
        let solution = self.solution(&self.center, self.bits);
        let inside = solution.iter().zip(&enclosed).all(|(x, y)| {
            let difference = x.subtract(y);
            magnitude(&difference) <= radius
        });
        inside.then(|| BigRational::new(radius, BigInt::one() << self.bits))
    }

    /// Enclosures of the solution from a point of the cube near it.
    pub fn solution(&self, z: &[BigInt], bits: u32) -> Vec<Interval> {
        // ε ≤ 1/2, so that 1/(1 − ε) ≤ 2.
        let radius = self.step(z, bits) * 2u32;
        z.iter().map(|x| ball(x, &radius, bits)).collect()
    }

    /// A point with more binary places, and the enclosure of the solution around it.
    ///
    /// The width is at most `2^(160 − bits)`.
    pub fn refine(&self, at: &[BigInt], from: u32, bits: u32) -> (Vec<BigInt>, Vec<Interval>) {
        let mut at = self.square.polish(at, from, bits);
        let outside = |at: &[BigInt]| {
            at.iter().zip(&self.center).any(|(x, y)| {
                (x - rescaled(y, self.bits, bits)).abs() > rescaled(&self.radius, self.bits, bits)
            })
        };
        let center = || -> Vec<BigInt> {
            let center = self.center.iter();
            center.map(|x| rescaled(x, self.bits, bits)).collect()
        };
        if outside(&at) {
            at = center();
        }
        // g maps the cube into itself and at least halves the distance to the solution, so that this many
        // iterations suffice. Usually one is enough, and none is needed after Newton's iteration.
        for _ in 0..bits {
            let solution = self.solution(&at, bits);
            let width = solution.iter().map(Interval::width_bits).max().unwrap_or(0);
            if width <= i64::from(LOST_BITS) - i64::from(bits) {
                return (at, solution);
            }
            let moved = self.square.corrected(&at, bits, &self.matrix, self.bits).0;
            at = if outside(&moved) { center() } else { moved };
        }
        let solution = self.solution(&at, bits);
        (at, solution)
    }
}

/// The largest exponent `n` with `bits/2 ≤ n < bits` for which a monotone predicate holds for the radius `2ⁿ` in units
/// of the last place; `None` if there is none.
fn largest_power(bits: u32, holds: impl Fn(&BigInt) -> bool) -> Option<u32> {
    let at = |exponent: u32| holds(&(BigInt::one() << exponent));
    // Radii below 2^(−bits/2) are of no use.
    let (mut low, mut high) = (bits / 2, bits);
    if !at(low) {
        return None;
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if at(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use crate::certify::conditions::{Claim, Conditions};
    use crate::certify::system::{Kind, Step, System};

    const BITS: u32 = 200;

    /// The triple jump: `2x + y = 1`, `2x³ + y³ = 0`, with `x = 1/(2 − ∛2)`.
    fn triple_jump() -> Square {
        let step = |argument| Step::new(Kind::Base, argument);
        Square {
            system: System::new(
                vec![step(0), step(1), step(0)],
                Conditions::new(&Claim::SymmetricBase(4), true).expect("a claim"),
            ),
            fixed: vec![None, None],
            free: vec![0, 1],
        }
    }

    fn near() -> [BigRational; 2] {
        [ratio(13512, 10000), ratio(-17024, 10000)]
    }

    #[test]
    fn a_solution_is_proved_and_refined() {
        let square = triple_jump();
        let center = square.solve(&near(), BITS).expect("convergence");
        let proof = Proof::new(square, center, BITS).expect("a proof");
        let (_, solution) = proof.refine(&proof.center, BITS, 3 * BITS);
        assert!(solution[0].width_bits() <= i64::from(LOST_BITS) - 3 * i64::from(BITS));
        // x(2 − ∛2) = 1: (2x − 1)³ = 2x³.
        let x = &solution[0];
        let two_x = x.add(x);
        let cube = two_x
            .subtract(&Interval::enclosing(&BigRational::one(), 3 * BITS))
            .power(3);
        let difference = cube.subtract(&x.power(3).scale(&ratio(2, 1)));
        assert!(difference.contains(&BigRational::zero()));
        assert!(difference.magnitude_bits() < -450);
        // Around the digits the solution is unique …
        let unique = proof.unique_around(&near()).expect("near");
        assert!(unique > ratio(1, 1000) && unique < ratio(1, 1));
        // … and around a point far away nothing is proved.
        assert!(proof.unique_around(&[ratio(1, 3), ratio(1, 3)]).is_none());
    }

    #[test]
    fn the_proof_fails_for_points_that_are_not_solutions() {
        let square = triple_jump();
        let mut center = square.solve(&near(), BITS).expect("convergence");
        center[0] += BigInt::one() << (BITS - 60);
        assert!(Proof::new(square, center, BITS).is_none());
        // x = y = 1/3 satisfies the first condition only.
        let third = |_| middle(&Interval::enclosing(&ratio(1, 3), BITS));
        let center: Vec<BigInt> = (0..2).map(third).collect();
        assert!(Proof::new(triple_jump(), center, BITS).is_none());
    }
}
