//! Linear stability as exact algebra (Hairer, Lubich & Wanner, *Geometric Numerical
//! Integration*, §I.5 and §IX.9; Hairer & Wanner, *Solving Ordinary Differential Equations II*, §IV.3).
//!
//! For the oscillator `q' = p`, `p' = −ω²q` one step is a 2×2 matrix whose entries are rational functions of `ν = hω`.
//! Their coefficients are computed without rounding, so that statements about them can be decided: equalities by exact
//! arithmetic, signs and roots by enclosures or Sturm's theorem. If exact arithmetic is not available or takes too
//! long, enclosures of the coefficients decide, or the stability stays undecided. Over the node algebra all of this is
//! rational, because the coefficients of the functions are traces.

mod budget;
mod cascade;
mod cells;
mod dispersion;
mod end_point;
mod field_polynomial;
mod fraction;
mod halves;
mod intervals;
mod isolation;
mod oscillator;
mod polynomial;
mod resolvent;
mod runge_kutta;
mod stable_steps;
#[cfg(test)]
mod tests;

use std::fmt;
use std::sync::Arc;

use num_rational::BigRational;
use num_traits::{One, Signed};
use serde::Serialize;

use self::budget::Budget;
use self::field_polynomial::FieldPolynomial;
use self::fraction::Fraction;
use self::oscillator::{Parts, Step};
use self::polynomial::RealPolynomial;
use crate::algebra::{Field, Number, Scalar, StageAlgebra, ZERO_BITS};
use crate::arithmetic::polynomial::Polynomial;
use crate::evidence::{Evidence, evidence_text};
use crate::exact::{Exact, over_algebra};
use crate::partitioned::Partitioned;

pub use dispersion::Dispersion;
pub use end_point::EndPoint;
pub(crate) use fraction::superscript;
pub use fraction::{Coefficient, RationalFunction, Variable};
pub use intervals::StabilityInterval;
pub use runge_kutta::RungeKuttaStability;
pub use stable_steps::{MAX_STAGES, StableSteps};

/// Linear stability of a method.
#[derive(Debug, Clone)]
pub struct Stability {
    /// The matrix `M` with `(q1, p1/ω) = M (q0, p0/ω)`.
    pub matrix: [[RationalFunction; 2]; 2],
    /// The trace of `M`, a function of `ν²`.
    pub trace: RationalFunction,
    /// The determinant of `M`, a function of `ν²`; 1 for symplectic methods.
    pub determinant: RationalFunction,
    /// Whether `det M = 1`.
    pub preserves_area: bool,
    /// All step sizes `ν = hω > 0` for which the stages have a solution and all powers of `M` are bounded,
    /// in ascending order, with as few intervals as possible.
    pub intervals: Vec<StabilityInterval>,
    /// Whether the powers of `M` are bounded for all `ν > 0`.
    pub p_stable: bool,
    /// The leading term of the phase error; `None` if the method is not even of order 1.
    pub dispersion: Option<Dispersion>,
    /// The stability function, for methods with `ã = a` and `b̃ = b`.
    pub runge_kutta: Option<RungeKuttaStability>,
    /// Whether the matrix is 1 or −1 for some ν.
    #[doc(hidden)]
    pub touches: bool,
    /// `det(1 + ν²ÃA)`, where the stages have no unique solution if it vanishes.
    #[doc(hidden)]
    pub stages: RationalFunction,
    /// The evidence: proved, verified if zeros are known only from enclosures, or undecided. If it is undecided, the
    /// other fields need not be correct.
    pub evidence: Evidence,
}

impl Stability {
    /// Decides the linear stability of a method.
    ///
    /// If exact arithmetic is not available or takes more than a fixed number of operations, enclosures
    /// of the coefficients decide; numbers taken to be zero are then only verified.
    pub(crate) fn of(exact: &Exact) -> Self {
        over_algebra!(exact, pair => Stability::of_pair(pair))
    }

    pub(crate) fn of_pair<A: StageAlgebra + 'static>(pair: &Partitioned<A>) -> Self {
        Stability::within(pair, PRODUCTS)
    }

    fn within<A: StageAlgebra + 'static>(pair: &Partitioned<A>, products: u64) -> Self {
        let field = pair.algebra.constants();
        let exact = field.verified_bits().is_none();
        let equal = pair.equal_halves() == (true, true);
        let budget = Arc::new(Budget::new(products));
        budget.spend(oscillator::cost(pair));
        if exact && !budget.is_spent() {
            let parts = oscillator::parts(pair);
            let function = equal.then(|| runge_kutta::parts(pair));
            let rational = |list: &Vec<Scalar<A>>| rational_polynomial(field, list);
            // Over the rationals, polynomial arithmetic is much faster.
            let lists = function.as_ref();
            let rational_function = lists.map(|[d, n]| Some([rational(d)?, rational(n)?]));
            if let (Some(parts), None | Some(Some(_))) = (parts.map(rational), &rational_function) {
                let stability = Stability::decide(&parts, rational_function.flatten());
                if stability.is_decided() {
                    return stability;
                }
            } else {
                let stability = Stability::over(&pair.algebra, &budget, &parts, lists);
                if stability.is_decided() && !budget.is_spent() {
                    budget.lift();
                    return stability;
                }
            }
        }
        Stability::enclosed(pair, &Precision::USUAL)
    }

    /// From the coefficients of polynomials over a field.
    fn over<A: StageAlgebra + 'static>(
        algebra: &Arc<A>,
        budget: &Arc<Budget>,
        parts: &Parts<Vec<Scalar<A>>>,
        function: Option<&[Vec<Scalar<A>>; 2]>,
    ) -> Self {
        let make = |list: &Vec<Scalar<A>>| FieldPolynomial::new(algebra, budget, list.clone());
        let function = function.map(|[d, n]| [make(d), make(n)]);
        let parts = Parts {
            determinant: make(&parts.determinant),
            b_one: make(&parts.b_one),
            b_c: make(&parts.b_c),
            ab_one: make(&parts.ab_one),
            ab_c: make(&parts.ab_c),
            b_sum: make(&parts.b_sum),
        };
        Stability::decide(&parts, function)
    }

    /// Stability from enclosures of the coefficients. The bits grow until every number taken to be zero is very small compared
    /// with the terms of its sum, and with the smallest of the given numbers.
    fn enclosed<A: StageAlgebra>(pair: &Partitioned<A>, precision: &Precision) -> Self {
        let numbers = pair.numbers();
        let equal = pair.equal_halves() == (true, true);
        let fineness = numbers.iter().map(Number::fineness).max().unwrap_or(0);
        // Determinants contain products of large numbers, one from each row, which may cancel to a number of about 1.
        let row = |row: &Vec<Number<'_>>| row.iter().map(Number::largeness).max().unwrap_or(0);
        let rows = numbers.a.iter().chain(&numbers.a_tilde);
        let rows = rows.chain([&numbers.b, &numbers.b_tilde]);
        let largeness: u64 = rows.map(row).sum();
        let wanted = precision
            .zero
            .saturating_add(u32::try_from(largeness).unwrap_or(u32::MAX))
            .saturating_add(ORDERS.saturating_mul(fineness));
        // More bits than allowed: the computation would be wasted.
        let most = if wanted.saturating_add(GUARD) > precision.most {
            FEWEST
        } else {
            precision.most
        };
        let mut bits = wanted.saturating_add(GUARD).min(most).next_power_of_two();
        loop {
            let pair = pair.enclosed(bits);
            let balls = &pair.algebra;
            let parts = oscillator::parts(&pair);
            let function = equal.then(|| runge_kutta::parts(&pair));
            let budget = Arc::new(Budget::new(ENCLOSED_PRODUCTS));
            let stability = Stability::over(balls, &budget, &parts, function.as_ref());
            let verified = balls.field().zero_bits();
            if stability.is_decided() && verified >= wanted && !budget.is_spent() {
                let evidence = Evidence::Verified { bits: ZERO_BITS };
                budget.lift();
                return Stability {
                    evidence,
                    ..stability
                };
            }
            if bits >= most || budget.is_spent() {
                return Stability {
                    intervals: Vec::new(),
                    p_stable: false,
                    runge_kutta: None,
                    dispersion: None,
                    evidence: Evidence::Undecided { bits },
                    ..stability
                };
            }
            bits *= 2;
        }
    }

    fn is_decided(&self) -> bool {
        !matches!(self.evidence, Evidence::Undecided { .. })
    }

    /// Stability from enclosures with several times as many bits.
    #[cfg(test)]
    pub(crate) fn with_more_bits<A: StageAlgebra>(pair: &Partitioned<A>, times: u32) -> Self {
        let Precision { zero, most } = Precision::USUAL;
        let precision = Precision {
            zero: times * zero,
            most: 4 * most,
        };
        Stability::enclosed(pair, &precision)
    }

    /// Decides everything from polynomials, or returns "undecided" if the roots cannot be separated.
    fn decide<P: RealPolynomial>(parts: &Parts<P>, function: Option<[P; 2]>) -> Self {
        let step = Step::new(parts);
        let intervals = intervals::stable(&step);
        let runge_kutta = function.map(|[d, n]| runge_kutta::decide(&d, &n));
        let evidence = match (&intervals, &runge_kutta) {
            (Some(_), None | Some(Some(_))) => Evidence::Proved,
            _ => Evidence::Undecided { bits: 0 },
        };
        let (intervals, touches) = intervals.unwrap_or_default();
        let even = |f: &Fraction<P>| f.exported(Variable::NuSquared);
        let odd = |f: &Fraction<P>| f.exported(Variable::NuTimesSquared);
        Stability {
            matrix: [
                [even(&step.m11), odd(&step.m12)],
                [odd(&step.m21), even(&step.m22)],
            ],
            trace: even(&step.trace),
            determinant: even(&step.determinant),
            preserves_area: step.preserves_area(),
            p_stable: matches!(intervals.as_slice(), [only] if only.low.is_zero() && only.high.is_infinite()),
            intervals,
            dispersion: dispersion::leading(&step),
            runge_kutta: runge_kutta.flatten(),
            touches,
            stages: even(&Fraction::new(
                &step.stages,
                &step.stages.constant(&BigRational::one()),
            )),
            evidence,
        }
    }

    /// The interval that begins at zero, for a palindromic splitting of any length. [`Stability::of`] decides everything else.
    pub(crate) fn first_interval(exact: &Exact) -> Option<StabilityInterval> {
        over_algebra!(exact, pair => halves::first_interval(pair))
    }

    /// Whether a step size `ν = hω > 0` is stable.
    pub fn contains(&self, nu: &BigRational) -> bool {
        self.intervals.iter().any(|interval| interval.contains(nu))
    }

    /// Whether all `0 < ν ≤ bound` are stable.
    pub fn stable_to(&self, bound: &BigRational) -> bool {
        let first = self.intervals.first().filter(|first| first.low.is_zero());
        first.is_some_and(|first| !bound.is_positive() || first.contains(bound))
    }

    /// The set as text: `(0, 2*sqrt(2)) ∪ (2*sqrt(3), 2*sqrt(6))`, or `∅`.
    pub fn intervals_text(&self) -> String {
        if let Evidence::Undecided { .. } = self.evidence {
            return evidence_text(self.evidence);
        }
        if self.intervals.is_empty() {
            return "∅".to_owned();
        }
        intervals::union(&self.intervals)
    }

    /// Everything as plain data, with numbers to this many significant digits.
    pub fn summary(&self, digits: usize) -> StabilitySummary {
        let exact = |end: &EndPoint| end.exact().map(str::to_owned);
        let intervals = self.intervals.iter();
        StabilitySummary {
            trace: self.trace.to_string(),
            determinant: self.determinant.to_string(),
            intervals: intervals
                .clone()
                .map(|i| [exact(&i.low), exact(&i.high)])
                .collect(),
            decimal: intervals
                .clone()
                .map(|i| [i.low.decimal(digits), i.high.decimal(digits)])
                .collect(),
            closed: intervals.map(|i| [i.low_closed, i.high_closed]).collect(),
            p_stable: self.p_stable,
            evidence: evidence_text(self.evidence),
            dispersion_order: self.dispersion.as_ref().map(|d| d.order),
            dispersion: self.dispersion.as_ref().map(|d| d.coefficient.to_string()),
            runge_kutta: self.runge_kutta.as_ref().map(|rk| RungeKuttaSummary {
                function: rk.function.to_string(),
                at_infinity: rk.at_infinity.as_ref().map(ToString::to_string),
                a_stable: rk.a_stable,
                l_stable: rk.l_stable,
                imaginary: exact(&rk.imaginary),
                imaginary_decimal: rk.imaginary.decimal(digits),
            }),
        }
    }
}

/// Products of machine words beyond which stability is decided from enclosures: about a second, including the
/// overhead of products in a field.
const PRODUCTS: u64 = 2_500_000;
/// Products of machine words beyond which stability from enclosures is left undecided: about two seconds.
const ENCLOSED_PRODUCTS: u64 = 1 << 31;
/// The precision of enclosures.
struct Precision {
    /// The binary places to which numbers must vanish to be taken as zero, for given numbers of ordinary size.
    zero: u32,
    /// The most bits of enclosures.
    most: u32,
}

impl Precision {
    const USUAL: Precision = Precision {
        zero: ZERO_BITS,
        most: 1 << 14,
    };
}

/// The bits of the enclosures if none can decide.
const FEWEST: u32 = 1 << 10;
/// Bits that are usually lost during the computation.
const GUARD: u32 = 512;
/// A quantity that vanishes to first order in the smallest given number may be nonzero to a higher order, up to about this one.
const ORDERS: u32 = 4;

/// A polynomial whose coefficients are known to be rational.
fn rational_polynomial<F: Field>(field: &F, list: &[F::Element]) -> Option<Polynomial> {
    let values = list.iter().map(|x| match field.number(x) {
        Number::Rational(value) => Some(value),
        _ => None,
    });
    let values: Option<Vec<BigRational>> = values.collect();
    Some(Polynomial::from_rationals(&values?))
}

impl fmt::Display for Stability {
    /// A few lines of text.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Evidence::Undecided { .. } = self.evidence {
            return write!(f, "stable for ν: {}", evidence_text(self.evidence));
        }
        writeln!(f, "trace: {}", self.trace)?;
        if !self.preserves_area {
            writeln!(f, "determinant: {}", self.determinant)?;
        }
        let p_stable = if self.p_stable { " (P-stable)" } else { "" };
        let evidence = evidence_text(self.evidence);
        write!(
            f,
            "stable for ν in {}{p_stable}, {evidence}",
            self.intervals_text()
        )?;
        if let Some(Dispersion { order, coefficient }) = &self.dispersion {
            // A sum is in parentheses, as in the trace.
            let coefficient = match coefficient.text.contains(' ') {
                true => format!("({coefficient})"),
                false => coefficient.to_string(),
            };
            write!(
                f,
                "\nphase: order {order}, error {coefficient} ν^{}, {evidence}",
                order + 1
            )?;
        }
        let Some(rk) = &self.runge_kutta else {
            return Ok(());
        };
        let yes = |holds: bool| if holds { "yes" } else { "no" };
        write!(
            f,
            "\nR(z) = {}, {evidence}\nA-stable: {}, L-stable: {}, on the imaginary axis up to {}, {evidence}",
            rk.function,
            yes(rk.a_stable),
            yes(rk.l_stable),
            rk.imaginary
        )
    }
}

/// Linear stability as plain data.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StabilitySummary {
    /// The trace as text.
    pub trace: String,
    /// The determinant as text.
    pub determinant: String,
    /// The exact ends of the intervals, if they are short.
    pub intervals: Vec<[Option<String>; 2]>,
    /// The ends of the intervals as decimals.
    pub decimal: Vec<[String; 2]>,
    /// Which ends are closed.
    pub closed: Vec<[bool; 2]>,
    /// Whether the method is stable for all step sizes.
    pub p_stable: bool,
    /// The evidence.
    pub evidence: String,
    /// The order of the phase error.
    pub dispersion_order: Option<usize>,
    /// The coefficient of the phase error.
    pub dispersion: Option<String>,
    /// The stability function of a Runge–Kutta method.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub runge_kutta: Option<RungeKuttaSummary>,
}

/// Linear stability of a Runge–Kutta method as plain data.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RungeKuttaSummary {
    /// The stability function as text.
    pub function: String,
    /// Its value at infinity; `None` if infinite.
    pub at_infinity: Option<String>,
    /// Whether the method is A-stable.
    pub a_stable: bool,
    /// Whether the method is L-stable.
    pub l_stable: bool,
    /// The exact bound on the imaginary axis, if it is short.
    pub imaginary: Option<String>,
    /// The bound on the imaginary axis as a decimal.
    pub imaginary_decimal: String,
}
