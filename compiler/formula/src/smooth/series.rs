//! Series in a small positive number τ, with rational exponents.

use std::collections::BTreeMap;

use num_traits::{Signed, ToPrimitive, Zero};

use crate::function::Elementary;
use crate::graph::{Number, integer};

/// Terms from this exponent on are dropped.
const LAST: i64 = 8;
/// The largest number of terms.
const MAX_TERMS: usize = 40;
/// The largest number of terms of the series of a function.
pub(super) const MAX_POWERS: usize = 16;
/// A coefficient below this, relative to the terms that it is the sum of, counts as zero.
const ROUNDING: f64 = 1e-13;

/// A coefficient, and the size of the terms that it is the sum of.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Coefficient {
    pub(super) value: f64,
    pub(super) size: f64,
}

impl Coefficient {
    /// Whether it differs from zero by more than rounding.
    pub(super) fn is_zero(self) -> bool {
        self.size.is_finite() && self.value.abs() <= ROUNDING * self.size
    }

    pub(super) fn add(self, other: Self) -> Self {
        Coefficient {
            value: self.value + other.value,
            size: self.size + other.size,
        }
    }

    pub(super) fn times(self, factor: f64) -> Self {
        Coefficient {
            value: self.value * factor,
            size: self.size * factor.abs(),
        }
    }
}

/// `Σ c τᵉ + O(τᵒʳᵈᵉʳ)`
#[derive(Debug, Clone, Default)]
pub(super) struct Series {
    terms: BTreeMap<Number, Coefficient>,
    /// The exponent from which on terms are unknown; `None` for a finite sum.
    order: Option<Number>,
}

/// A function of τ.
#[derive(Debug, Clone)]
pub(super) enum Value {
    /// A series, with a pole if it has negative exponents.
    Series(Series),
    /// Infinite for τ → 0, such as ln τ.
    Infinite,
    Unknown,
}

impl Series {
    /// `c + dτ`
    pub(super) fn line(c: f64, d: f64) -> Self {
        let term = |value: f64| Coefficient {
            value,
            size: value.abs(),
        };
        Series::new([(integer(0), term(c)), (integer(1), term(d))], None)
    }

    fn new(
        terms: impl IntoIterator<Item = (Number, Coefficient)>,
        mut order: Option<Number>,
    ) -> Self {
        let mut sums: BTreeMap<Number, Coefficient> = BTreeMap::new();
        for (exponent, term) in terms {
            let sum = sums.entry(exponent).or_default();
            *sum = sum.add(term);
        }
        sums.retain(|_, sum| !sum.is_zero());
        let last = sums.keys().find(|&exponent| *exponent >= integer(LAST));
        let last = last.or_else(|| sums.keys().nth(MAX_TERMS)).cloned();
        if let Some(last) = last {
            order = Some(order.map_or(last.clone(), |order| order.min(last)));
        }
        if let Some(order) = &order {
            sums.retain(|exponent, _| exponent < order);
        }
        Series { terms: sums, order }
    }

    /// The smallest exponent, or that of the first unknown term; `None` for 0.
    fn least(&self) -> Option<&Number> {
        self.terms.keys().next().or(self.order.as_ref())
    }

    /// The τ where it is zero, if it is linear.
    pub(super) fn root(&self) -> Option<f64> {
        let is_linear = self.order.is_none()
            && self
                .terms
                .keys()
                .all(|e| *e == integer(0) || *e == integer(1));
        let slope = self.coefficient(1).value;
        (is_linear && slope != 0.0).then(|| -self.coefficient(0).value / slope)
    }

    /// Whether it is zero at τ = 0, except for rounding.
    fn vanishes(&self) -> bool {
        let next = self.least();
        next.is_none_or(Signed::is_positive)
    }

    /// Whether it is infinite for τ → 0.
    pub(super) fn has_pole(&self) -> bool {
        self.terms.keys().next().is_some_and(Signed::is_negative)
    }

    /// Whether all terms up to this exponent are known.
    pub(super) fn is_known_to(&self, exponent: u32) -> bool {
        let order = self.order.as_ref();
        order.is_none_or(|order| *order > integer(exponent.into()))
    }

    /// Whether it is this number at τ = 0 and not constant.
    fn starts_at(&self, number: f64) -> bool {
        let at = self.coefficient(0).value;
        let is_constant = self.terms.len() <= 1 && self.order.is_none();
        !is_constant && !self.has_pole() && (at - number).abs() <= ROUNDING
    }

    /// The exponents with their coefficients.
    pub(super) fn terms(&self) -> impl Iterator<Item = (&Number, Coefficient)> {
        self.terms.iter().map(|(exponent, term)| (exponent, *term))
    }

    fn coefficient(&self, exponent: i64) -> Coefficient {
        self.terms
            .get(&integer(exponent))
            .copied()
            .unwrap_or_default()
    }

    pub(super) fn add(&self, other: &Self) -> Self {
        let terms = [self, other].into_iter().flat_map(|side| side.terms());
        let terms = terms.map(|(exponent, term)| (exponent.clone(), term));
        let order = [&self.order, &other.order].into_iter().flatten().min();
        Series::new(terms, order.cloned())
    }

    pub(super) fn times(&self, factor: f64) -> Self {
        let terms = self
            .terms()
            .map(|(e, term)| (e.clone(), term.times(factor)));
        Series::new(terms, self.order.clone())
    }

    fn shifted(&self, by: &Number) -> Self {
        let terms = self.terms().map(|(exponent, term)| (exponent + by, term));
        Series::new(terms, self.order.as_ref().map(|order| order + by))
    }

    fn multiply(&self, other: &Self) -> Self {
        let product = |(a, x): (&Number, Coefficient), (b, y): (&Number, Coefficient)| {
            let term = Coefficient {
                value: x.value * y.value,
                size: x.size * y.size,
            };
            (a + b, term)
        };
        let terms = self.terms();
        let terms = terms.flat_map(|a| other.terms().map(move |b| product(a, b)));
        let terms: Vec<_> = terms.collect();
        let order = |a: &Self, b: &Self| Some(a.order.as_ref()? + b.least()?);
        let orders = [order(self, other), order(other, self)];
        Series::new(terms, orders.into_iter().flatten().min())
    }

    /// `Σ f_j δʲ` for this series δ, which vanishes at τ = 0.
    fn inserted(&self, coefficient: impl Fn(usize) -> f64) -> Self {
        let (mut sum, mut power) = (Series::default(), Series::line(1.0, 0.0));
        for j in 0..=MAX_POWERS {
            sum = sum.add(&power.times(coefficient(j)));
            power = power.multiply(self);
            if power.terms.is_empty() {
                break;
            }
        }
        let rest = Series::new([], power.least().cloned());
        sum.add(&rest)
    }

    /// The constant term, and the rest, which vanishes at τ = 0; `None` for a pole.
    fn at_zero(&self) -> Option<(f64, Self)> {
        let unknown = !self.is_known_to(0);
        if self.has_pole() || unknown {
            return None;
        }
        let mut rest = self.clone();
        let constant = rest.terms.remove(&integer(0)).unwrap_or_default();
        Some((constant.value, rest))
    }
}

impl Value {
    /// The number of its terms, one more for the unknown ones.
    pub(super) fn size(&self) -> usize {
        match self {
            Value::Series(series) => series.terms.len() + 1,
            _ => 1,
        }
    }

    /// Whether it is zero at τ = 0, except for rounding.
    pub(super) fn vanishes(&self) -> bool {
        match self {
            Value::Series(series) => series.vanishes(),
            _ => false,
        }
    }

    pub(super) fn line(c: f64, d: f64) -> Self {
        Value::Series(Series::line(c, d))
    }

    pub(super) fn add(&self, other: &Self) -> Self {
        match (self, other) {
            (Value::Unknown, _) | (_, Value::Unknown) => Value::Unknown,
            (Value::Series(a), Value::Series(b)) => Value::Series(a.add(b)),
            _ => Value::Infinite,
        }
    }

    pub(super) fn times(&self, factor: f64) -> Self {
        match self {
            Value::Series(series) => Value::Series(series.times(factor)),
            other => other.clone(),
        }
    }

    pub(super) fn multiply(&self, other: &Self) -> Self {
        match (self, other) {
            (Value::Unknown, _) | (_, Value::Unknown) => Value::Unknown,
            (Value::Series(a), Value::Series(b)) => Value::Series(a.multiply(b)),
            (Value::Infinite, Value::Infinite) => Value::Infinite,
            (Value::Infinite, Value::Series(series)) | (Value::Series(series), Value::Infinite) => {
                let vanishes = series.least().is_none_or(Signed::is_positive);
                match series.terms.is_empty() || vanishes {
                    true => Value::Unknown,
                    false => Value::Infinite,
                }
            }
        }
    }

    /// A power. Of a negative base the power of its negative is taken, which is as smooth.
    pub(super) fn power(&self, exponent: &Number) -> Self {
        let series = match self {
            Value::Series(series) => series,
            Value::Infinite if exponent.is_positive() => return Value::Infinite,
            _ => return Value::Unknown,
        };
        let Some((least, first)) = series.terms().next() else {
            return match (&series.order, exponent.is_positive()) {
                (None, true) => Value::Series(Series::default()),
                (None, false) => Value::Infinite,
                (Some(order), true) => Value::Series(Series::new([], Some(order * exponent))),
                (Some(_), false) => Value::Unknown,
            };
        };
        // (c τᵉ (1 + δ))ᵖ
        let power = exponent.to_f64().unwrap_or(f64::NAN);
        let mut rest = series.shifted(&-least).times(first.value.recip());
        rest.terms.remove(&integer(0));
        let binomial = |j: usize| {
            let factors = (0..j).map(|k| (power - k as f64) / (k + 1) as f64);
            factors.product()
        };
        let is_odd = exponent.is_integer() && !(exponent.numer() % 2_u32).is_zero();
        let sign = if is_odd { first.value.signum() } else { 1.0 };
        let whole = exponent.is_integer().then(|| exponent.to_usize()).flatten();
        let coefficients = |j: usize| match whole {
            Some(whole) if j > whole => 0.0,
            _ => binomial(j),
        };
        let scale = sign * first.value.abs().powf(power);
        let power = rest.inserted(coefficients).times(scale);
        Value::Series(power.shifted(&(least * exponent)))
    }

    /// A function with these derivatives at a point, divided by the factorials.
    fn function(&self, coefficients: impl Fn(f64) -> Vec<f64>) -> Self {
        let Value::Series(series) = self else {
            return Value::Unknown;
        };
        let Some((point, rest)) = series.at_zero() else {
            return Value::Unknown;
        };
        let coefficients = coefficients(point);
        let sum = rest.inserted(|j| coefficients.get(j).copied().unwrap_or(0.0));
        let order = rest
            .least()
            .map(|least| least * integer(coefficients.len() as i64));
        Value::Series(sum.add(&Series::new([], order)))
    }

    pub(super) fn elementary(&self, function: Elementary) -> Self {
        use Elementary::{Acos, Asin, Atan, Cos, Cosh, Exp, Ln, Sin, Sinh, Tan, Tanh};
        // Of a large argument that of a smaller one is taken, which is as smooth.
        let exponential = |x: f64, sign: i32| {
            let x = x.clamp(-20.0, 20.0);
            divided(|j| {
                let other = [1.0, -1.0][j % 2] * (-x).exp();
                match sign {
                    0 => x.exp(),
                    sign => (x.exp() + f64::from(sign) * other) / 2.0,
                }
            })
        };
        let turned = |x: f64, turns: usize| {
            divided(|j| {
                let (sine, cosine) = x.sin_cos();
                [sine, cosine, -sine, -cosine][(j + turns) % 4]
            })
        };
        // ∫ of (1 + sign·x²)ᵉ
        let integral = |x: f64, sign: i64, exponent: Number| {
            let x = Value::line(x, 1.0);
            let square = x.multiply(&x).times(sign as f64);
            let slope = Value::line(1.0, 0.0).add(&square).power(&exponent);
            let Value::Series(slope) = slope else {
                return Vec::new();
            };
            let slopes = (1..LAST).map(|j| slope.coefficient(j - 1).value / j as f64);
            std::iter::once(0.0).chain(slopes).collect()
        };
        let arc = |x: f64| match x.abs() < 1.0 {
            true => integral(x, -1, Number::new((-1).into(), 2.into())),
            false => integral(x, 1, integer(-1)),
        };
        let with = |mut all: Vec<f64>, constant: f64| {
            if let Some(first) = all.first_mut() {
                *first = constant;
            }
            all
        };
        // The arcs of sine and cosine begin with a root at ±1.
        let at_end = match self {
            Value::Series(series) => series.starts_at(1.0) || series.starts_at(-1.0),
            _ => false,
        };
        match function {
            Asin | Acos if at_end => Value::Unknown,
            Exp => self.function(|x| exponential(x, 0)),
            Cosh => self.function(|x| exponential(x, 1)),
            Sinh => self.function(|x| exponential(x, -1)),
            Sin => self.function(|x| turned(x, 0)),
            Cos => self.function(|x| turned(x, 1)),
            Tan => self.over(Sin, Cos),
            Tanh => self.over(Sinh, Cosh),
            Asin => self.function(|x| with(arc(x), x.atan())),
            Acos => self.function(|x| with(arc(x), x.atan() - 2.0)).times(-1.0),
            Atan => self.function(|x| with(integral(x, 1, integer(-1)), x.atan())),
            Ln => match self {
                Value::Series(series) => match series.terms().next() {
                    Some((exponent, _)) if exponent.is_zero() => self.function(|x| {
                        let terms = (1..=MAX_POWERS).map(|j| -(-x).powi(-(j as i32)) / j as f64);
                        std::iter::once(x.abs().ln()).chain(terms).collect()
                    }),
                    Some(_) => Value::Infinite,
                    None if series.order.is_none() => Value::Infinite,
                    None => Value::Unknown,
                },
                _ => Value::Unknown,
            },
        }
    }

    fn over(&self, above: Elementary, below: Elementary) -> Self {
        let below = self.elementary(below).power(&integer(-1));
        self.elementary(above).multiply(&below)
    }

    /// The angle of the point `(x, self)`, up to a constant.
    pub(super) fn angle(&self, x: &Self) -> Self {
        let (Value::Series(above), Value::Series(below)) = (self, x) else {
            return Value::Unknown;
        };
        let least = |series: &Series| match series.terms.keys().next() {
            Some(exponent) if !exponent.is_positive() => Some(exponent.clone()),
            _ => None,
        };
        match (least(above), least(below)) {
            (None, None) => Value::Unknown,
            (above, Some(below)) if above.as_ref().is_none_or(|above| below <= *above) => self
                .multiply(&x.power(&integer(-1)))
                .elementary(Elementary::Atan),
            _ => x
                .multiply(&self.power(&integer(-1)))
                .elementary(Elementary::Atan)
                .times(-1.0),
        }
    }
}

/// Derivatives divided by the factorials.
fn divided(derivative: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut factorial = 1.0;
    let terms = (0..=MAX_POWERS).map(|j| {
        factorial *= j.max(1) as f64;
        derivative(j) / factorial
    });
    terms.collect()
}
