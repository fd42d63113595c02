//! The set of step sizes for which all powers of the matrix of one step are bounded.

use std::cmp::Ordering;
use std::fmt;
use std::sync::Arc;

use num_rational::BigRational;

use super::cells::Cells;
use super::end_point::{EndPoint, PositiveRoot};
use super::oscillator::Step;
use super::polynomial::RealPolynomial;

/// An interval of step sizes `ν = hω > 0`; a single point if both ends are equal and closed.
#[derive(Debug, Clone)]
pub struct StabilityInterval {
    /// The lower end.
    pub low: EndPoint,
    /// The upper end.
    pub high: EndPoint,
    /// Whether the lower end belongs to the interval.
    pub low_closed: bool,
    /// Whether the upper end belongs to the interval.
    pub high_closed: bool,
}

impl StabilityInterval {
    /// Whether a step size is in the interval.
    pub fn contains(&self, nu: &BigRational) -> bool {
        let inside = |order: Ordering, outside: Ordering, closed: bool| {
            order != outside && (closed || order.is_ne())
        };
        inside(self.low.compare(nu), Ordering::Greater, self.low_closed)
            && inside(self.high.compare(nu), Ordering::Less, self.high_closed)
    }
}

/// Digits of an end without a short exact form.
pub(super) const SHOWN_DIGITS: usize = 12;
/// How often the digits are doubled to distinguish two ends.
const MAX_DOUBLINGS: u32 = 7;

/// The digits with which the ends of ascending intervals are shown: enough to distinguish each from the ends beside it.
///
/// Equal ends, as those of a single point, have the fewest digits.
fn distinguishing_digits(intervals: &[StabilityInterval]) -> Vec<usize> {
    let ends: Vec<&EndPoint> = intervals.iter().flat_map(|i| [&i.low, &i.high]).collect();
    let mut digits = vec![SHOWN_DIGITS; ends.len()];
    for last in 1..ends.len() {
        let (low, high) = (ends[last - 1], ends[last]);
        if low.exact().is_some() && low.exact() == high.exact() {
            continue;
        }
        let mut enough = (0..=MAX_DOUBLINGS).map(|n| SHOWN_DIGITS << n);
        if let Some(enough) = enough.find(|&n| low.decimal(n) != high.decimal(n)) {
            digits[last - 1] = digits[last - 1].max(enough);
            digits[last] = enough;
        }
    }
    digits
}

/// `(0, 2*sqrt(2)) ∪ (2*sqrt(3), 2*sqrt(6))`, with brackets at closed ends, and enough digits to distinguish the ends.
pub(super) fn union(intervals: &[StabilityInterval]) -> String {
    let digits = distinguishing_digits(intervals);
    let text = |(interval, digits): (&StabilityInterval, &[usize])| {
        let open = if interval.low_closed { '[' } else { '(' };
        let close = if interval.high_closed { ']' } else { ')' };
        let (low, high) = (interval.low.text(digits[0]), interval.high.text(digits[1]));
        format!("{open}{low}, {high}{close}")
    };
    let texts: Vec<String> = intervals.iter().zip(digits.chunks(2)).map(text).collect();
    texts.join(" ∪ ")
}

impl fmt::Display for StabilityInterval {
    /// `(0, 2*sqrt(2))`, with brackets at closed ends, and enough digits to distinguish the ends.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&union(std::slice::from_ref(self)))
    }
}

/// The quantities that vanish at all roots of a polynomial; no other polynomial has these roots.
struct Vanishing<P> {
    polynomial: Arc<P>,
    stages: bool,
    conditions: [bool; 4],
    scalar: bool,
}

/// The step sizes `ν > 0` for which the powers of the matrix are bounded.
///
/// The powers are bounded where the eigenvalues are in the closed unit disc ([`Step::conditions`]) and those on the
/// circle are semisimple. A real matrix can only fail the latter with a double eigenvalue ±1, that is with `det M = 1`
/// and `tr M = ±2`, unless `M = ±1`. Where the stages have no unique solution there is no step, and so no stability.
/// Returns `None` if the roots cannot be separated. The truth value says if the matrix is 1 or −1 somewhere, so that the trace touches 2
/// or −2 there.
pub(super) fn stable<P: RealPolynomial>(step: &Step<P>) -> Option<(Vec<StabilityInterval>, bool)> {
    let conditions = step.conditions();
    let scalar = step.scalar();
    let mut cuts = vec![step.stages.clone()];
    for condition in &conditions {
        cuts.push(condition.numerator.clone());
        if !scalar.is_zero() && !condition.numerator.is_zero() {
            cuts.push(condition.numerator.common_factor(&scalar));
        }
    }
    let [area, _, one, minus_one] = [0, 1, 2, 3].map(|k| conditions[k].numerator.is_zero());
    if area && (one || minus_one) {
        // The eigenvalue is double everywhere, and semisimple at the roots of this polynomial.
        cuts.push(scalar.clone());
    }
    let cells = Cells::new(&cuts)?;
    let mut vanishing: Vec<Vanishing<P>> = Vec::new();
    for PositiveRoot { polynomial, .. } in &cells.roots {
        if vanishing_at(&vanishing, polynomial).is_none() {
            let vanishes = |p: &P| p.is_multiple_of(polynomial);
            vanishing.push(Vanishing {
                stages: vanishes(&step.stages),
                conditions: [0, 1, 2, 3].map(|k| vanishes(&conditions[k].numerator)),
                scalar: vanishes(&scalar),
                polynomial: Arc::clone(polynomial),
            });
        }
    }
    // At the root next to the sample, if one is given; otherwise at the sample.
    let bounded = |sample: &BigRational, root: Option<&PositiveRoot<P>>| {
        let zero = root.and_then(|root| vanishing_at(&vanishing, &root.polynomial));
        if zero.is_some_and(|zero| zero.stages) {
            return false;
        }
        let signs = [0, 1, 2, 3].map(|k| match zero {
            Some(zero) if zero.conditions[k] => Ordering::Equal,
            _ => conditions[k].sign_at(sample),
        });
        let [area, _, one, minus_one] = signs;
        let double = area.is_eq() && (one.is_eq() || minus_one.is_eq());
        let semisimple = || scalar.is_zero() || zero.is_some_and(|zero| zero.scalar);
        signs.into_iter().all(Ordering::is_ge) && (!double || semisimple())
    };
    let mut intervals = Vec::new();
    let mut open: Option<(EndPoint, bool)> = None;
    for (index, sample) in cells.samples.iter().enumerate() {
        let inside = bounded(sample, None);
        if inside && open.is_none() {
            let end = index
                .checked_sub(1)
                .map(|k| EndPoint::square_root_of(&cells.roots[k]));
            open = Some((end.unwrap_or(EndPoint::ZERO), false));
        } else if !inside && let Some((low, low_closed)) = open.take() {
            // The previous root was stable, and ends the interval.
            let high = index
                .checked_sub(1)
                .map(|k| EndPoint::square_root_of(&cells.roots[k]));
            intervals.push(StabilityInterval {
                low,
                high: high.unwrap_or(EndPoint::ZERO),
                low_closed,
                high_closed: true,
            });
        }
        let Some(root) = cells.roots.get(index) else {
            break;
        };
        match (bounded(sample, Some(root)), open.take()) {
            (true, None) => open = Some((EndPoint::square_root_of(root), true)),
            (true, known) => open = known,
            (false, Some((low, low_closed))) => intervals.push(StabilityInterval {
                low,
                high: EndPoint::square_root_of(root),
                low_closed,
                high_closed: false,
            }),
            (false, None) => {}
        }
    }
    intervals.extend(open.map(|(low, low_closed)| StabilityInterval {
        low,
        high: EndPoint::INFINITY,
        low_closed,
        high_closed: false,
    }));
    let is_scalar = |zero: &Vanishing<P>| zero.scalar && zero.conditions[2..].contains(&true);
    let touches = vanishing.iter().any(is_scalar);
    Some((intervals, touches))
}

fn vanishing_at<'a, P>(list: &'a [Vanishing<P>], polynomial: &Arc<P>) -> Option<&'a Vanishing<P>> {
    let is_that = |v: &&Vanishing<P>| Arc::ptr_eq(&v.polynomial, polynomial);
    list.iter().find(is_that)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::polynomial::Polynomial;
    use crate::arithmetic::rational::ratio;

    /// The interval between the square roots of two roots of polynomials.
    fn between(low: &[BigRational], high: &[BigRational]) -> StabilityInterval {
        let end = |list: &[BigRational]| {
            let polynomial = Polynomial::from_rationals(list);
            let root = polynomial.positive_roots().expect("roots").remove(0);
            EndPoint::square_root_of(&PositiveRoot::new(&Arc::new(polynomial), root))
        };
        StabilityInterval {
            low: end(low),
            high: end(high),
            low_closed: false,
            high_closed: false,
        }
    }

    #[test]
    fn ends_of_an_interval_are_shown_with_the_digits_that_differ() {
        let cubic = |constant: BigRational| [-constant, ratio(0, 1), ratio(0, 1), ratio(1, 1)];
        let tiny = BigRational::new(1.into(), num_bigint::BigInt::from(10).pow(30));
        let interval = between(&cubic(ratio(2, 1)), &cubic(ratio(2, 1) + tiny));
        assert_eq!(
            interval.to_string(),
            "(1.12246204830937298143353304967917951623241111061…, 1.12246204830937298143353304967927305473643689170…)"
        );
        let apart = between(&cubic(ratio(2, 1)), &cubic(ratio(3, 1)));
        assert_eq!(apart.to_string(), "(1.12246204831…, 1.20093695518…)");
        let point = between(&cubic(ratio(2, 1)), &cubic(ratio(2, 1)));
        assert_eq!(point.to_string(), "(1.12246204831…, 1.12246204831…)");
    }
}
