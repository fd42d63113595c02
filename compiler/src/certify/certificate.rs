//! What is known about the exact method behind printed digits.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

use super::CertifyError;
use super::conditions::Claim;
use super::digits::{Digits, Distance, distances};
use super::newton::Equations;
use super::printed::{MAX_DIGITS, Printed};
use super::proof::{LOST_BITS, Proof};
use super::structure::{Coefficient, Structure, Target};
use super::system::{Step, System};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::simplest_between;
use crate::arithmetic::rounding::Decimal;

/// A proof that an exact method has the claimed order, with all its digits.
///
/// Copies share the digits that have been computed. The results do not depend on the order of the calls.
#[derive(Debug, Clone)]
pub struct Certificate(Arc<Facts>);

#[derive(Debug)]
pub(super) struct Facts {
    pub claim: Claim,
    pub structure: Structure,
    pub conditions: usize,
    pub unknowns: usize,
    pub fixed: Vec<Fixed>,
    pub targets: Vec<Target>,
    pub sharp: Option<bool>,
    pub distance: BigRational,
    /// The binary places with which digits are compared.
    pub digit_bits: u32,
    /// Whether an exact method has all printed digits.
    pub digits: Digits,
    /// Other printed numbers, any one of which could be the wrong number.
    pub suspects: Vec<Coefficient>,
    pub uniqueness: Option<Uniqueness>,
    pub solution: Solution,
}

/// The radius around printed values within which the solution is unique, computed on demand.
#[derive(Debug)]
pub(super) struct Uniqueness {
    proof: Proof,
    start: Vec<BigRational>,
    radius: OnceLock<Option<BigRational>>,
}

impl Uniqueness {
    /// Around the values of the free unknowns.
    pub fn around(start: Vec<BigRational>, proof: Proof) -> Self {
        Uniqueness {
            proof,
            start,
            radius: OnceLock::new(),
        }
    }
}

/// A coefficient that the conditions leave free, with its exact value in the certified method.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fixed {
    /// The first of the coefficients that are equal by symmetry or structure.
    pub coefficient: Coefficient,
    /// The exact value.
    pub value: BigRational,
    /// Whether the value is that of the printed text. Otherwise the text is a rounding of the value: a simple fraction, or
    /// a number with which the other coefficients round to their prints.
    pub as_printed: bool,
}

/// The unknowns.
#[derive(Debug)]
pub(super) enum Solution {
    /// Rational numbers for which all conditions hold exactly.
    Exact(Vec<BigRational>),
    /// The unique zero in a cube.
    Enclosed(Box<Enclosed>),
}

/// Enclosures of the unknowns with increasing binary places.
#[derive(Debug)]
pub struct Enclosed<S = System> {
    proof: Proof<S>,
    /// The rational unknowns: the fixed ones, and those that they determine linearly.
    known: Vec<Option<BigRational>>,
    levels: Mutex<Vec<Level>>,
}

#[derive(Debug, Clone)]
struct Level {
    bits: u32,
    at: Vec<BigInt>,
    solution: Arc<Vec<Interval>>,
}

impl Enclosed {
    /// The solution that a proof encloses.
    pub fn new(proof: Proof) -> Self {
        let known = proof.square.linear_values();
        Enclosed::with_known(proof, known)
    }

    /// The steps whose product satisfies the conditions.
    pub(super) fn steps(&self) -> &[Step] {
        &self.system().steps
    }

    /// The conditions.
    pub(super) fn system(&self) -> &System {
        &self.proof.square.system
    }
}

impl<S: Equations> Enclosed<S> {
    /// A solution with the unknowns that are known to be rational.
    pub fn with_known(proof: Proof<S>, known: Vec<Option<BigRational>>) -> Self {
        let solution = proof.solution(&proof.center, proof.bits);
        let first = Level {
            bits: proof.bits,
            at: proof.center.clone(),
            solution: Arc::new(solution),
        };
        Enclosed {
            known,
            proof,
            levels: Mutex::new(vec![first]),
        }
    }

    /// Enclosures of all unknowns.
    pub fn unknowns(&self, bits: u32) -> Vec<Interval> {
        let free = self.free(bits);
        let places = free.first().map_or(bits, Interval::bits);
        let all = self.proof.square.arguments(&free, places);
        let known = self.known.iter().zip(&all);
        known
            .map(|(known, enclosure)| match known {
                Some(value) => Interval::enclosing(value, bits),
                None => enclosure.with_bits(bits),
            })
            .collect()
    }

    /// Enclosures of the free unknowns with a width of at most `2^(−bits)`.
    ///
    /// Each level has 3/2 times the binary places of the level before, for any `bits`. So the result depends on `bits`
    /// only.
    fn free(&self, bits: u32) -> Arc<Vec<Interval>> {
        let needed = bits.saturating_add(LOST_BITS);
        let mut levels = self.levels.lock().unwrap_or_else(PoisonError::into_inner);
        let mut index = 0;
        loop {
            let level = levels[index].clone();
            if level.bits >= needed {
                return level.solution;
            }
            index += 1;
            if index == levels.len() {
                let bits = level.bits.saturating_add(level.bits / 2);
                let (at, solution) = self.proof.refine(&level.at, level.bits, bits);
                levels.push(Level {
                    bits,
                    at,
                    solution: Arc::new(solution),
                });
            }
        }
    }
}

impl Solution {
    /// The value of an unknown that is known to be rational.
    pub fn known(&self, index: usize) -> Option<BigRational> {
        match self {
            Solution::Exact(values) => values.get(index).cloned(),
            Solution::Enclosed(enclosed) => enclosed.known.get(index).cloned()?,
        }
    }

    /// Enclosures of all unknowns.
    pub fn unknowns(&self, bits: u32) -> Vec<Interval> {
        match self {
            Solution::Exact(values) => values
                .iter()
                .map(|x| Interval::enclosing(x, bits))
                .collect(),
            Solution::Enclosed(enclosed) => enclosed.unknowns(bits),
        }
    }
}

impl Target {
    /// The exact value, if the values of all its unknowns are known.
    pub(super) fn rational(&self, solution: &Solution) -> Option<BigRational> {
        let mut terms = self.terms.iter();
        terms.try_fold(BigRational::zero(), |sum, (index, factor)| {
            Some(sum + solution.known(*index)? * factor)
        })
    }

    pub(super) fn enclosed(&self, unknowns: &[Interval], bits: u32) -> Interval {
        let zero = Interval::enclosing(&BigRational::zero(), bits);
        self.terms.iter().fold(zero, |sum, (index, factor)| {
            sum.add(&unknowns[*index].scale(factor))
        })
    }
}

impl Certificate {
    pub(super) fn new(facts: Facts) -> Self {
        Certificate(Arc::new(facts))
    }

    pub(super) fn solution(&self) -> &Solution {
        &self.0.solution
    }

    /// Whether both are the same certificate (the same allocation).
    pub fn is(&self, other: &Certificate) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// What is proved.
    pub fn claim(&self) -> &Claim {
        &self.0.claim
    }

    /// The structure of the coefficients of the exact method.
    pub fn structure(&self) -> Structure {
        self.0.structure
    }

    /// The number of order conditions that were solved.
    pub fn conditions(&self) -> usize {
        self.0.conditions
    }

    /// The number of unknowns: distinct coefficients, up to structure.
    pub fn unknowns(&self) -> usize {
        self.0.unknowns
    }

    /// The coefficients that the conditions leave free, with the exact values at which they are fixed.
    pub fn fixed(&self) -> &[Fixed] {
        &self.0.fixed
    }

    /// Whether the conditions of the next order are refuted; `None` if the next order is not a single claim.
    pub fn sharp(&self) -> Option<bool> {
        self.0.sharp
    }

    /// An upper bound on the distance of any printed coefficient from that of the exact method.
    pub fn distance(&self) -> &BigRational {
        &self.0.distance
    }

    /// [`Certificate::distance`] to two digits.
    pub fn distance_text(&self) -> String {
        Decimal::round(&self.0.distance, 2).to_string()
    }

    /// The coefficients that do not round to their print, with upper bounds on their distance from it. Each is proved to be more than
    /// half a unit of its last place away. A printed fraction or integer is exact.
    pub fn wrong_digits(&self) -> Vec<(Coefficient, BigRational)> {
        let distances = distances(&self.0.targets, &self.0.solution, self.0.digit_bits);
        let pairs = self.0.targets.iter().zip(distances);
        let mut wrong: Vec<(Coefficient, BigRational)> = pairs
            .filter(|(target, distance)| distance.at_least > target.half)
            .map(|(target, distance)| (target.name, distance.at_most))
            .collect();
        wrong.sort_unstable();
        wrong
    }

    /// Whether every coefficient agrees with its print to within half a unit of its last place or a tolerance.
    pub(super) fn is_near(&self, tolerance: &BigRational) -> bool {
        let distances = distances(&self.0.targets, &self.0.solution, self.0.digit_bits);
        let mut pairs = self.0.targets.iter().zip(distances);
        pairs.all(|(target, distance)| {
            let allowed = &target.half;
            distance.at_most <= *tolerance || distance.at_most <= *allowed
        })
    }

    /// Whether an exact method has all printed digits: this method, none, or none that was found.
    pub fn digits(&self) -> Digits {
        self.0.digits
    }

    /// The printed numbers that could be wrong instead of those in [`Certificate::wrong_digits`]: for each, some exact method
    /// has all other digits.
    pub fn suspects(&self) -> &[Coefficient] {
        &self.0.suspects
    }

    /// The radius around the printed values of the free unknowns within which the solution is unique, with the others fixed. `None`
    /// if the method is exact, or if the digits are too far away for a proof.
    pub fn uniqueness_radius(&self) -> Option<&BigRational> {
        let Uniqueness {
            proof,
            start,
            radius,
        } = self.0.uniqueness.as_ref()?;
        let radius = radius.get_or_init(|| proof.unique_around(start));
        radius.as_ref()
    }

    /// Whether all coefficients are known rational numbers.
    pub fn is_exact(&self) -> bool {
        matches!(self.0.solution, Solution::Exact(_))
    }

    /// The coefficients of the method: the kicks, the drifts, or the weights.
    pub fn coefficients(&self) -> impl Iterator<Item = Coefficient> {
        let mut names: Vec<Coefficient> = self.0.targets.iter().map(|t| t.name).collect();
        names.sort_unstable();
        names.into_iter()
    }

    pub(super) fn target(&self, coefficient: Coefficient) -> Option<&Target> {
        self.0.targets.iter().find(|t| t.name == coefficient)
    }

    /// The value of a coefficient, if it is known to be rational. This holds for fixed coefficients, for those that a linear
    /// condition determines from such coefficients, and if all coefficients are known to be rational.
    pub fn rational(&self, coefficient: Coefficient) -> Option<BigRational> {
        self.target(coefficient)?.rational(&self.0.solution)
    }

    /// Whether two coefficients are equal by symmetry or structure.
    pub(crate) fn same(&self, one: Coefficient, other: Coefficient) -> bool {
        match (self.target(one), self.target(other)) {
            (Some(one), Some(other)) => one.terms == other.terms,
            _ => false,
        }
    }

    /// A coefficient of the exact method, enclosed with `bits` binary places; `None` if there is no coefficient of that
    /// name.
    ///
    /// The width is at most a few units of the last place. The time grows with `bits`; the caller
    /// must keep it reasonable.
    pub fn enclose(&self, coefficient: Coefficient, bits: u32) -> Option<Interval> {
        let target = self.target(coefficient)?;
        let fine = bits.saturating_add(8);
        let unknowns = self.0.solution.unknowns(fine);
        Some(target.enclosed(&unknowns, fine).with_bits(bits))
    }

    /// A coefficient with as many digits as its print has; `None` if there is no coefficient of that name.
    pub fn as_printed(&self, coefficient: Coefficient, printed: &Printed) -> Option<Decimal> {
        self.decimal(coefficient, printed.significant_digits())
            .ok()?
    }

    /// A coefficient, correctly rounded to `digits` significant digits; `None` if there is no coefficient of that name.
    ///
    /// # Errors
    /// [`CertifyError::Digits`] for more than [`MAX_DIGITS`].
    pub fn decimal(
        &self,
        coefficient: Coefficient,
        digits: usize,
    ) -> Result<Option<Decimal>, CertifyError> {
        if digits > MAX_DIGITS {
            return Err(CertifyError::Digits {
                digits,
                limit: MAX_DIGITS,
            });
        }
        if let Some(value) = self.rational(coefficient) {
            return Ok(Some(Decimal::round(&value, digits)));
        }
        // log₂ 10 < 10/3 + 1/100; 64 for the size of the number and its distance from a tie.
        let places = u32::try_from(digits * 334 / 100).unwrap_or(u32::MAX);
        let mut bits = places.saturating_add(64);
        for _ in 0..4 {
            let Some(interval) = self.enclose(coefficient, bits) else {
                return Ok(None);
            };
            let [low, high] = [interval.low(), interval.high()];
            let rounded = Decimal::round(&low, digits);
            if rounded == Decimal::round(&high, digits) {
                return Ok(Some(rounded));
            }
            bits = bits.saturating_add(bits / 2);
        }
        // Possibly a tie: the simplest number in the enclosure is taken to be the midpoint of two decimals.
        let interval = self.enclose(coefficient, bits);
        Ok(interval.map(|x| Decimal::round(&simplest_between(&x.low(), &x.high()), digits)))
    }
}

/// An upper bound on the distance of any target from its print.
pub(super) fn distance(targets: &[Target], solution: &Solution, bits: u32) -> BigRational {
    let distances = distances(targets, solution, bits).into_iter();
    let bounds = distances.map(|Distance { at_most, .. }| at_most);
    bounds.fold(BigRational::zero(), BigRational::max)
}
