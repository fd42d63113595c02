//! Real numbers as expressions that are enclosed as narrowly as needed.

use std::cmp::Ordering;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use num_rational::BigRational;
use num_traits::{One, Zero as _};

use super::{Field, Number, Zero};
use crate::arithmetic::interval::{Interval, more_places};
use crate::arithmetic::rational::{add, length, multiply};
use crate::certify::{Affine, Certificate, Coefficient};
use crate::symbolic::Constant;

/// Binary places to which equations are verified, and to which a number is compared with zero when it is rounded. Half the
/// smallest positive double is `2⁻¹⁰⁷⁵`, so a number that is not distinguished from zero is the double zero.
pub const ZERO_BITS: u32 = 1280;
/// Binary places of smallness up to which no extra places are added.
const USUAL_BITS: u64 = 256;
/// The most binary places that are added for tiny numbers.
const MAX_FINENESS: u32 = 1 << 14;

/// The binary places beyond the usual ones at which a number begins, from those at which it does.
pub(crate) fn beyond_usual(places: u64) -> u32 {
    let beyond = places.saturating_sub(USUAL_BITS);
    u32::try_from(beyond)
        .unwrap_or(MAX_FINENESS)
        .min(MAX_FINENESS)
}

/// Binary places to which a number is compared with ties when it is rounded.
pub const ROUNDING_BITS: u32 = 8192;

/// A real number: constants joined by field operations.
///
/// The expression is a graph, not a tree: shared parts are evaluated once, and the finest enclosure so far is kept.
#[derive(Debug, Clone)]
pub struct Real(Arc<Expression>);

#[derive(Debug)]
struct Expression {
    operation: Operation,
    /// The additional binary places needed to resolve the smallest of its numbers.
    fineness: u32,
    finest: Mutex<Option<Interval>>,
}

#[derive(Debug)]
enum Operation {
    Rational(BigRational),
    Constant(Constant),
    /// A coefficient of a method that is proved to exist.
    Certified(Certificate, Coefficient),
    Add(Real, Real),
    Subtract(Real, Real),
    Multiply(Real, Real),
    Inverse(Real),
}

impl Operation {
    /// The fineness of a sum is that of its finest term; the fineness of a product is the sum over its factors.
    fn fineness(&self) -> u32 {
        match self {
            Operation::Rational(value) => beyond_usual(length(value)),
            Operation::Constant(constant) => beyond_usual(constant.fineness()),
            Operation::Certified(..) => 0,
            Operation::Add(x, y) | Operation::Subtract(x, y) => x.fineness().max(y.fineness()),
            Operation::Multiply(x, y) => (x.fineness() + y.fineness()).min(MAX_FINENESS),
            Operation::Inverse(x) => x.fineness(),
        }
    }

    fn operands(&self) -> impl Iterator<Item = &Real> {
        let (x, y) = match self {
            Operation::Rational(_) | Operation::Constant(_) | Operation::Certified(..) => {
                (None, None)
            }
            Operation::Add(x, y) | Operation::Subtract(x, y) | Operation::Multiply(x, y) => {
                (Some(x), Some(y))
            }
            Operation::Inverse(x) => (Some(x), None),
        };
        x.into_iter().chain(y)
    }
}

impl Expression {
    /// Moves the operands to `rest`.
    fn give_operands(&mut self, rest: &mut Vec<Real>) {
        if self.operation.operands().next().is_some() {
            let nothing = Operation::Rational(BigRational::default());
            let operation = std::mem::replace(&mut self.operation, nothing);
            rest.extend(operation.operands().cloned());
        }
    }
}

impl Drop for Expression {
    /// A loop instead of recursion, as in [`Real::evaluate`].
    fn drop(&mut self) {
        let mut rest = Vec::new();
        self.give_operands(&mut rest);
        while let Some(number) = rest.pop() {
            if let Some(mut last) = Arc::into_inner(number.0) {
                last.give_operands(&mut rest);
            }
        }
    }
}

impl Real {
    /// The additional binary places needed to resolve the smallest number in the expression; a zero is verified only beyond
    /// them.
    pub(crate) fn fineness(&self) -> u32 {
        self.0.fineness
    }

    fn new(operation: Operation) -> Self {
        Real(Arc::new(Expression {
            fineness: operation.fineness(),
            operation,
            finest: Mutex::new(None),
        }))
    }

    /// A rational number.
    pub fn rational(value: BigRational) -> Self {
        Real::new(Operation::Rational(value))
    }

    /// A constant.
    pub fn constant(value: Constant) -> Self {
        match value.as_rational() {
            Some(value) => Real::rational(value.clone()),
            None => Real::new(Operation::Constant(value)),
        }
    }

    /// A coefficient of a certified method, which has to have it.
    pub(crate) fn certified(certificate: Certificate, coefficient: Coefficient) -> Self {
        Real::new(Operation::Certified(certificate, coefficient))
    }

    /// The value, if the expression is known to be a rational.
    pub fn as_rational(&self) -> Option<&BigRational> {
        match &self.0.operation {
            Operation::Rational(value) => Some(value),
            _ => None,
        }
    }

    /// The number as an affine function of the unknowns of `certificate`, which is set to the first certificate found; `None`
    /// if the number is not such a function.
    pub fn affine(&self, certificate: &mut Option<Certificate>) -> Option<Affine> {
        let one = BigRational::one();
        match &self.0.operation {
            Operation::Rational(value) => Some(Affine::rational(value.clone())),
            Operation::Constant(_) | Operation::Inverse(_) => None,
            Operation::Certified(own, name) => {
                let known = certificate.get_or_insert_with(|| own.clone());
                known.is(own).then(|| own.affine(*name))?
            }
            Operation::Add(x, y) => {
                Some(x.affine(certificate)?.plus(&y.affine(certificate)?, &one))
            }
            Operation::Subtract(x, y) => {
                Some(x.affine(certificate)?.plus(&y.affine(certificate)?, &-one))
            }
            Operation::Multiply(x, y) => {
                let (x, y) = (x.affine(certificate)?, y.affine(certificate)?);
                match (x.as_rational(), y.as_rational()) {
                    (Some(factor), _) => Some(y.scaled(factor)),
                    (_, Some(factor)) => Some(x.scaled(factor)),
                    _ => None,
                }
            }
        }
    }

    /// An enclosure of width at most `2⁻ᵇⁱᵗˢ`.
    pub fn enclose(&self, bits: u32) -> Interval {
        // Elimination among a few functions loses some dozen places.
        let mut guard = 96;
        loop {
            let working = bits + guard;
            let found = self.evaluate(working);
            if let Some(interval) = &found
                && interval.width_bits() <= -i64::from(bits)
            {
                return interval.clone();
            }
            // The inverses in an expression are of numbers that are known not to be zero, so some
            // precision suffices.
            guard = more_places(guard, bits, found.as_ref());
        }
    }

    /// The value by interval arithmetic with this many binary places; `None` where the enclosure of a
    /// divisor is still too wide.
    fn evaluate(&self, working: u32) -> Option<Interval> {
        // A loop instead of recursion: a sum of many terms is deeper than the stack of a thread. Operands come first.
        let mut pending = vec![self];
        while let Some(&number) = pending.last() {
            let place = pending.len();
            if !number.is_enclosed(working) {
                let unknown = |operand: &&Real| !operand.is_enclosed(working);
                pending.extend(number.0.operation.operands().filter(unknown));
                if pending.len() > place {
                    continue;
                }
                let value = number.evaluate_from_operands(working)?;
                *number.finest() = Some(value);
            }
            pending.pop();
        }
        self.enclosed(working)
    }

    fn finest(&self) -> MutexGuard<'_, Option<Interval>> {
        let finest = self.0.finest.lock();
        finest.unwrap_or_else(PoisonError::into_inner)
    }

    fn is_enclosed(&self, working: u32) -> bool {
        (self.finest().as_ref()).is_some_and(|known| known.bits() >= working)
    }

    /// The finest enclosure so far, rounded to this many binary places, if it has them.
    fn enclosed(&self, working: u32) -> Option<Interval> {
        let known = self.finest().clone();
        known
            .filter(|known| known.bits() >= working)
            .map(|known| known.with_bits(working))
    }

    fn evaluate_from_operands(&self, working: u32) -> Option<Interval> {
        let enclosed = |x: &Real| x.enclosed(working);
        Some(match &self.0.operation {
            Operation::Rational(value) => Interval::enclosing(value, working),
            Operation::Constant(constant) => constant.enclose(working)?.with_bits(working),
            Operation::Certified(certificate, name) => certificate.enclose(*name, working)?,
            Operation::Add(x, y) => enclosed(x)?.add(&enclosed(y)?),
            Operation::Subtract(x, y) => enclosed(x)?.subtract(&enclosed(y)?),
            Operation::Multiply(x, y) => enclosed(x)?.multiply(&enclosed(y)?),
            Operation::Inverse(x) => {
                let one = Interval::enclosing(&BigRational::one(), working);
                one.divide(&enclosed(x)?)?
            }
        })
    }

    /// Whether the number equals a rational, by enclosures with `limit` binary places and those needed to resolve the smallest
    /// of its numbers.
    pub fn difference(&self, value: &BigRational, limit: u32) -> Zero {
        if let Some(known) = self.as_rational() {
            return if known == value { Zero::Yes } else { Zero::No };
        }
        // The sign of a product of tiny numbers is known from its form.
        if let Operation::Constant(constant) = &self.0.operation
            && value.is_zero()
            && constant.sign().is_some_and(Ordering::is_ne)
        {
            return Zero::No;
        }
        // Nearly every number is told apart by the first enclosure; what is not is likely equal.
        for bits in [PIVOT_BITS, limit.saturating_add(self.fineness())] {
            if !self.enclose(bits).contains(value) {
                return Zero::No;
            }
        }
        Zero::Within(limit)
    }
}

impl PartialEq for Real {
    /// Whether both are the same expression; different expressions may have equal values.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
            || match (&self.0.operation, &other.0.operation) {
                (Operation::Rational(x), Operation::Rational(y)) => x == y,
                (Operation::Constant(x), Operation::Constant(y)) => x == y,
                _ => false,
            }
    }
}

/// The real numbers, as expressions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reals;

/// The bits of a rational beyond which enclosures take less time than lowest terms.
const LONGEST: u64 = 4096;

/// Whether the sum of two rationals stays short: below that bound, or over the denominator that both have.
fn is_short_sum(p: &BigRational, q: &BigRational) -> bool {
    p.denom() == q.denom() || length(p) + length(q) <= LONGEST
}

impl Field for Reals {
    type Element = Real;

    fn rational(&self, value: &BigRational) -> Real {
        Real::rational(value.clone())
    }

    fn constant(&self, value: &Constant) -> Option<Real> {
        Some(Real::constant(value.clone()))
    }

    fn real(&self, x: &Real) -> Option<Real> {
        Some(x.clone())
    }

    fn add(&self, x: &Real, y: &Real) -> Real {
        match (x.as_rational(), y.as_rational()) {
            (Some(p), _) if p.is_zero() => y.clone(),
            (_, Some(q)) if q.is_zero() => x.clone(),
            (Some(p), Some(q)) if is_short_sum(p, q) => self.rational(&add(p, q)),
            _ => Real::new(Operation::Add(x.clone(), y.clone())),
        }
    }

    fn subtract(&self, x: &Real, y: &Real) -> Real {
        match (x.as_rational(), y.as_rational()) {
            (_, Some(q)) if q.is_zero() => x.clone(),
            _ if x == y => self.rational(&BigRational::default()),
            (Some(p), Some(q)) if is_short_sum(p, q) => self.rational(&add(p, &-q)),
            _ => Real::new(Operation::Subtract(x.clone(), y.clone())),
        }
    }

    fn multiply(&self, x: &Real, y: &Real) -> Real {
        match (x.as_rational(), y.as_rational()) {
            (Some(p), _) if p.is_zero() => x.clone(),
            (_, Some(q)) if q.is_zero() => y.clone(),
            (Some(p), _) if p.is_one() => y.clone(),
            (_, Some(q)) if q.is_one() => x.clone(),
            (Some(p), Some(q)) if length(p) + length(q) <= LONGEST => {
                self.rational(&multiply(p, q))
            }
            _ => Real::new(Operation::Multiply(x.clone(), y.clone())),
        }
    }

    fn inverse(&self, x: &Real) -> Option<Real> {
        match x.as_rational() {
            Some(value) => (!value.is_zero()).then(|| self.rational(&value.recip())),
            None if self.zero(x) == Zero::No => Some(Real::new(Operation::Inverse(x.clone()))),
            None => None,
        }
    }

    fn verified_bits(&self) -> Option<u32> {
        Some(ZERO_BITS)
    }

    fn keeps_operands(&self) -> bool {
        true
    }

    fn zero(&self, x: &Real) -> Zero {
        x.difference(&BigRational::default(), ZERO_BITS)
    }

    /// The largest, so that enclosures stay narrow.
    fn pivot(&self, candidates: &[&Real]) -> Option<usize> {
        let size = |x: &Real| x.enclose(PIVOT_BITS).magnitude_bits();
        let sizes = candidates.iter().map(|x| size(x)).enumerate();
        // Of equal ones the first.
        let (index, _) = sizes.max_by_key(|&(index, size)| (size, std::cmp::Reverse(index)))?;
        let nonzero = |index: usize| self.zero(candidates[index]) == Zero::No;
        if nonzero(index) {
            return Some(index);
        }
        (0..candidates.len()).find(|&index| nonzero(index))
    }

    fn number(&self, x: &Real) -> Number<'_> {
        match x.as_rational() {
            Some(value) => Number::Rational(value.clone()),
            None => Number::Real(x.clone()),
        }
    }

    fn exact(&self, x: &Real) -> Option<String> {
        x.as_rational().map(|value| value.to_string())
    }
}

/// Binary places of the first enclosures, which compare pivots: those of [`Number::enclose`], so that everything is evaluated
/// once with them.
const PIVOT_BITS: u32 = 192;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;

    #[test]
    fn sum_of_many_terms_needs_no_deep_stack() {
        let (field, pi) = (Reals, Real::constant(Constant::pi()));
        let terms = 200_000;
        let sum = (1..terms).fold(pi.clone(), |sum, _| field.add(&sum, &pi));
        let product = field.multiply(&pi, &field.rational(&ratio(terms, 1)));
        let difference = sum.enclose(200).subtract(&product.enclose(200));
        assert!(difference.contains(&BigRational::default()) && difference.width_bits() < -198);
    }
}
