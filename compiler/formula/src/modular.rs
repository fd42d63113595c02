//! Whether a formula is identically zero in its coordinates and parameters: it is evaluated exactly at random points.
//!
//! The numbers are elements of the field with 2⁶¹ − 1 elements. A nonzero rational function vanishes there at a random point with a
//! probability of its degree over 2⁶¹. Sine and cosine are rational functions of a random number that depends on their argument, so that
//! sin² + cos² = 1 holds. The same is true of hyperbolic functions and the exponential function; other functions have random values.
//! Zeros by other identities, such as the addition theorem of sin(a + b), are detected in doubles.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, ToPrimitive};

use super::evaluate::{Evaluator, Point, Real};
use super::function::Elementary;
use super::graph::{Graph, Id, LoopId, Number};
use super::system::System;

/// The number of elements.
const PRIME: u64 = (1 << 61) - 1;
/// The number of points at which a formula is evaluated.
const POINTS: u64 = 6;
/// A double below this, relative to its terms, counts as zero up to round-off.
const ROUNDING: f64 = 1e-11;

/// An element of the field; `None` after a division by zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Modular(Option<u64>);

/// Points at which formulas of a system are evaluated.
pub struct Points {
    exact: Vec<Point<Modular>>,
    doubles: Vec<Point<f64>>,
}

impl Points {
    /// Pseudo-random points; none if the system is very large.
    pub fn of(system: &System) -> Self {
        let doubles: Vec<_> = (0..POINTS)
            .filter_map(|seed| system.random_point(seed))
            .collect();
        Points {
            exact: doubles.iter().map(modular).collect(),
            doubles,
        }
    }

    /// The points with exact numbers.
    pub fn exact(&self) -> &[Point<Modular>] {
        &self.exact
    }

    /// The points in doubles.
    pub fn doubles(&self) -> &[Point<f64>] {
        &self.doubles
    }

    /// Whether a node, in a loop or in none, is zero at all points. In doubles: up to the round-off of a number of the size of `scale`.
    pub fn vanishes(&self, graph: &Graph, id: Id, scale: Id, within: Option<LoopId>) -> bool {
        if let Some(value) = graph.value(id) {
            return *value == Number::default();
        }
        let exact = self.exact.iter().filter_map(|point| {
            let mut evaluator = Evaluator::new(graph, point);
            within.inspect(|&over| evaluator.fix(over, 0));
            evaluator.value(id)?.0
        });
        let doubles = self.doubles.iter().filter_map(|point| {
            let mut evaluator = Evaluator::new(graph, point);
            within.inspect(|&over| evaluator.fix(over, 0));
            let (value, scale) = (evaluator.value(id)?, evaluator.value(scale)?);
            value
                .is_finite()
                .then_some(value.abs() <= ROUNDING * scale.abs())
        });
        all_true(exact.map(|value| value == 0)) || all_true(doubles)
    }
}

/// Whether there is at least one value and all are true.
fn all_true(mut found: impl Iterator<Item = bool>) -> bool {
    found.next() == Some(true) && found.all(|zero| zero)
}

/// A point with other pseudo-random numbers.
fn modular(point: &Point<f64>) -> Point<Modular> {
    let number = |x: &f64| Modular(Some(random(x.to_bits())));
    let rows = |rows: &Vec<Vec<f64>>| -> Vec<Vec<Modular>> {
        rows.iter()
            .map(|row| row.iter().map(number).collect())
            .collect()
    };
    Point {
        time: number(&point.time),
        halves: [rows(&point.halves[0]), rows(&point.halves[1])],
        parameters: point.parameters.iter().map(rows).collect(),
        pairs: point.pairs.clone(),
    }
}

/// A pseudo-random number, the same for the same seed.
fn random(seed: u64) -> u64 {
    let mut x = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    (x ^ (x >> 31)) % PRIME
}

fn times(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b) % u128::from(PRIME);
    product as u64
}

fn raised(base: u64, mut exponent: u64) -> u64 {
    let (mut square, mut power) = (base, 1);
    while exponent > 0 {
        if exponent % 2 == 1 {
            power = times(power, square);
        }
        square = times(square, square);
        exponent /= 2;
    }
    power
}

impl Modular {
    fn integer(value: &BigInt) -> Self {
        Modular(value.mod_floor(&PRIME.into()).to_u64())
    }

    fn map(self, function: impl FnOnce(u64) -> u64) -> Self {
        Modular(self.0.map(function))
    }

    /// Whether the number is known and nonzero.
    pub fn is_not_zero(self) -> bool {
        self.0.is_some_and(|x| x != 0)
    }

    /// 0 for zero, and 1 for any other number; `None` if it is not known.
    pub fn size(self) -> Option<f64> {
        self.0.map(|x| if x == 0 { 0.0 } else { 1.0 })
    }

    fn inverse(self) -> Self {
        Modular(self.0.filter(|&x| x != 0).map(|x| raised(x, PRIME - 2)))
    }

    fn negative(self) -> Self {
        self.map(|x| (PRIME - x) % PRIME)
    }

    /// A pseudo-random number determined by this one and some words.
    fn mixed(self, words: impl IntoIterator<Item = u64>) -> Self {
        let words = words.into_iter();
        self.map(|x| words.fold(random(x), |all, word| random(all ^ word.rotate_left(17))))
    }
}

impl Real for Modular {
    fn number(value: &Number) -> Self {
        Self::integer(value.numer()).multiply(&Self::integer(value.denom()).inverse())
    }

    fn pi() -> Self {
        Modular(Some(random(3)))
    }

    fn add(&self, other: &Self) -> Self {
        let sum = self.0.zip(other.0).map(|(a, b)| (a + b) % PRIME);
        Modular(sum)
    }

    fn multiply(&self, other: &Self) -> Self {
        Modular(self.0.zip(other.0).map(|(a, b)| times(a, b)))
    }

    fn power(&self, exponent: &Number) -> Self {
        // x^((P + 1)/4) is a root of x or of −x, and it is multiplicative.
        let base = match exponent.denom() {
            denominator if denominator.is_one() => *self,
            denominator if *denominator == 2.into() => self.map(|x| raised(x, PRIME.div_ceil(4))),
            denominator => self.mixed(denominator.iter_u64_digits()),
        };
        let (size, negative) = (exponent.numer().magnitude(), exponent < &Number::default());
        let size = (size % (PRIME - 1)).to_u64().unwrap_or(0);
        let power = base.map(|x| raised(x, size));
        match negative {
            true => power.inverse(),
            false => power,
        }
    }

    fn elementary(&self, function: Elementary) -> Self {
        use Elementary::{Acos, Asin, Atan, Cos, Cosh, Exp, Ln, Sin, Sinh, Tan, Tanh};
        let one = Modular(Some(1));
        let family = match function {
            Sin | Cos | Tan => 1,
            Sinh | Cosh | Tanh | Exp => 2,
            Ln => 3,
            Asin => 4,
            Acos => 5,
            Atan => 6,
        };
        let t = self.mixed([family]);
        let square = t.multiply(&t);
        let (plus, minus) = (one.add(&square), one.add(&square.negative()));
        let over = |above: Modular, below: Modular| above.multiply(&below.inverse());
        match function {
            Sin => over(t.add(&t), plus),
            Cos => over(minus, plus),
            Tan => over(t.add(&t), minus),
            Sinh => over(t.add(&t), minus),
            Cosh => over(plus, minus),
            Tanh => over(t.add(&t), plus),
            Exp => over(one.add(&t), one.add(&t.negative())),
            Ln | Asin | Acos | Atan => t,
        }
    }

    fn atan2(&self, x: &Self) -> Self {
        match x.0 {
            Some(x) => self.mixed([7, x]),
            None => *x,
        }
    }
}
