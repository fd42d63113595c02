//! How smooth a formula is where a power in it has no derivative.
//!
//! `|x|` is `(x²)^(1/2)`, and only such powers of functions that touch zero make a formula less smooth than its parts. Whether the whole
//! is smooth there, as `x|x|` is once, follows from series: along a random line through a point with `x = 0`, the formula is a series in
//! the distance τ from the point, on either side of it. It is k times continuously differentiable if both series have whole exponents up to
//! k and agree. `x`, if it is not a coordinate, is a variable of its own: what is smooth in it and the coordinates is smooth.
//!
//! The length of a vector, `(x² + y²)^(1/2)`, is zero at a point. There the terms up to τᵏ must also be a polynomial of the direction.

mod series;

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use num_traits::{Signed, Zero};

use self::series::{Coefficient, Series, Value};
use super::function::Elementary;
use super::graph::{Graph, Id, Node, Number, integer};
use crate::arithmetic::rounding::to_f64;

/// The largest number of values that are computed for one formula.
const MOST_VALUES: usize = 2_000_000;

/// Where a formula may be less smooth than its parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Kink {
    /// The bases of the powers that have no derivative there.
    pub(super) bases: BTreeSet<Id>,
    /// The functions that are zero there.
    pub(super) zeros: Vec<Id>,
    /// Whether this is where one function changes its sign, and not an isolated point of several.
    pub(super) is_crossed: bool,
    /// Whether a length is a divisor, so that the formula has a pole there.
    is_divisor: bool,
}

/// The smoothness of a formula at a kink.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Smoothness {
    /// As smooth as required.
    Smooth,
    /// The formula is infinite there.
    Infinite,
    /// Less smooth than required, as far as is known.
    Rough,
    /// The formula is too long.
    TooLong,
}

/// The kinks of a formula that are wanted, each with its smoothness: whether the formula has `order` continuous derivatives there.
pub(super) fn kinks(
    graph: &Graph,
    root: Id,
    order: u32,
    wanted: impl Fn(&Kink) -> bool,
) -> Vec<(Kink, Smoothness)> {
    let below = graph.below([root]);
    let kinks = candidates(graph, &below).into_iter().filter(wanted);
    let mut lines: Option<Lines<'_>> = None;
    let examined = kinks.map(|kink| {
        let smoothness = match kink.is_divisor {
            true => Smoothness::Infinite,
            false => lines
                .get_or_insert_with(|| Lines::new(graph, root, &below))
                .smoothness(&kink, order),
        };
        (kink, smoothness)
    });
    examined.collect()
}

/// The places where powers in a formula have no derivative.
fn candidates(graph: &Graph, below: &[Id]) -> Vec<Kink> {
    let mut kinks: BTreeMap<Vec<Id>, Kink> = BTreeMap::new();
    let powers = below.iter().filter_map(|&id| match graph.node(id) {
        Node::Product(factors) => Some(factors),
        _ => None,
    });
    let powers: Vec<&(Id, Number)> = powers.flatten().collect();
    let negative = powers.iter().filter(|(_, exponent)| exponent.is_negative());
    let negative: HashSet<Id> = negative.map(|(base, _)| *base).collect();
    let mut add = |base: Id, zeros: Vec<Id>, is_crossed: bool| {
        let kink = kinks.entry(zeros.clone()).or_insert_with(|| Kink {
            bases: BTreeSet::new(),
            zeros,
            is_crossed,
            is_divisor: false,
        });
        kink.is_divisor |= !is_crossed && negative.contains(&base);
        kink.bases.insert(base);
    };
    for (base, exponent) in powers {
        if exponent.is_integer() {
            continue;
        }
        let (_, inner) = graph.scaled(*base);
        if let Some((_, x)) = graph.positive_part(inner) {
            add(*base, vec![x], true);
            continue;
        }
        let crossed = common_squares(graph, inner);
        if crossed.is_empty()
            && let Some(zeros) = squares(graph, inner)
            && zeros.iter().all(|&zero| is_variable(graph, zero))
        {
            let leaves = graph.below(zeros.iter().copied());
            let leaves = leaves
                .iter()
                .filter(|&&id| matches!(graph.node(id), Node::Coordinate(_)));
            let in_total = !graph.totals(inner).is_empty();
            let is_crossed = leaves.count() == 1 && !in_total && vanish_together(graph, &zeros);
            add(*base, zeros, is_crossed);
        }
        for zero in crossed {
            if is_variable(graph, zero) && !has_one_sign(graph, zero) {
                add(*base, vec![zero], true);
            }
        }
    }
    kinks.into_values().collect()
}

/// Whether functions of one coordinate have a common zero: `x` and `sin(x)`, but not `x` and `x - 1` or `sin(x)` and `cos(x)`. Two
/// functions of which none is linear count as having none; where they do, a step returns an error.
fn vanish_together(graph: &Graph, zeros: &[Id]) -> bool {
    let line = ([1, 0], true);
    let values = |at: f64| {
        let mut values: HashMap<Id, Value> = HashMap::new();
        for id in graph.below(zeros.iter().copied()) {
            let value = match graph.node(id) {
                Node::Coordinate(_) => Value::line(at, 1.0),
                _ => compute(graph, id, line, |x| &values[&x]),
            };
            values.insert(id, value);
        }
        values
    };
    let here = values(0.0);
    let roots = zeros.iter().filter_map(|zero| match &here[zero] {
        Value::Series(series) => series.root(),
        _ => None,
    });
    let is_zero = |value: &Value| match value {
        Value::Series(series) => series.vanishes(),
        _ => false,
    };
    let mut roots = roots.take(1);
    zeros.len() == 1
        || roots.any(|root| {
            let values = values(root);
            zeros.iter().all(|zero| is_zero(&values[zero]))
        })
}

fn is_variable(graph: &Graph, id: Id) -> bool {
    let depends = graph.depends(id);
    depends.q || depends.p || depends.v
}

fn is_even(number: &Number) -> bool {
    (number / integer(2)).is_integer()
}

/// The functions whose even powers are factors of a product, or of all terms of a sum of terms that are not negative.
fn common_squares(graph: &Graph, id: Id) -> Vec<Id> {
    match graph.node(id) {
        Node::Product(factors) => {
            let even = factors.iter().filter(|(_, power)| is_even(power));
            factors_of(graph, even.map(|(x, _)| *x).collect())
        }
        Node::Sum(terms, constant) if constant.is_zero() => {
            let signs = [Signed::is_positive, Signed::is_negative];
            let same = signs
                .iter()
                .any(|sign: &fn(&Number) -> bool| terms.iter().all(|(factor, _)| sign(factor)));
            let whole = terms.iter().all(|(_, x)| has_one_sign(graph, *x));
            let Some(((_, first), rest)) = terms.split_first().filter(|_| same && whole) else {
                return Vec::new();
            };
            let mut common = common_squares(graph, *first);
            for (_, x) in rest {
                let others = common_squares(graph, *x);
                common.retain(|x| others.contains(x));
            }
            common
        }
        _ => Vec::new(),
    }
}

/// The factors of products.
fn factors_of(graph: &Graph, mut open: Vec<Id>) -> Vec<Id> {
    let mut all = BTreeSet::new();
    while let Some(id) = open.pop() {
        match graph.node(id) {
            Node::Product(factors) => open.extend(factors.iter().map(|(x, _)| *x)),
            _ => {
                all.insert(id);
            }
        }
    }
    all.into_iter().collect()
}

/// The functions whose even powers a sum consists of.
fn squares(graph: &Graph, id: Id) -> Option<Vec<Id>> {
    let (factor, id) = graph.scaled(id);
    if factor.is_negative() {
        return None;
    }
    match graph.node(id) {
        Node::Product(factors) => match factors.as_slice() {
            [(x, power)] if is_even(power) && power.is_positive() => Some(vec![*x]),
            _ => None,
        },
        Node::Sum(terms, constant) if constant.is_zero() => {
            let mut all = Vec::new();
            for (factor, x) in terms {
                all.extend(squares(graph, *x).filter(|_| factor.is_positive())?);
            }
            all.sort_unstable();
            all.dedup();
            Some(all)
        }
        Node::Total(_, body) => squares(graph, *body),
        _ => None,
    }
}

/// Whether a value is visibly never negative.
pub(super) fn has_one_sign(graph: &Graph, id: Id) -> bool {
    match graph.node(id) {
        Node::Constant(value) => !value.is_negative(),
        Node::Pi => true,
        Node::Sum(terms, constant) => {
            let mut terms = terms.iter();
            !constant.is_negative()
                && terms.all(|(factor, x)| factor.is_positive() && has_one_sign(graph, *x))
        }
        // An even power, or one whose denominator is even.
        Node::Product(factors) => factors.iter().all(|(x, exponent)| {
            let [above, below] =
                [exponent.numer(), exponent.denom()].map(|part| (part % 2_u32).is_zero());
            above || below || has_one_sign(graph, *x)
        }),
        Node::Elementary(Elementary::Exp | Elementary::Cosh | Elementary::Acos, _) => true,
        Node::Total(_, body) => has_one_sign(graph, *body),
        _ => false,
    }
}

/// A line through a point: two directions, with their factors, and a side.
type Line = ([i8; 2], bool);

/// The values of a formula along lines.
struct Lines<'a> {
    graph: &'a Graph,
    root: Id,
    parents: HashMap<Id, Vec<Id>>,
    /// The terms of the formula, if it is a sum.
    terms: Option<HashMap<Id, Number>>,
    /// The values of nodes that no kink has changed.
    plain: HashMap<Line, HashMap<Id, Value>>,
    /// The number of computed values.
    computed: usize,
}

impl<'a> Lines<'a> {
    fn new(graph: &'a Graph, root: Id, below: &[Id]) -> Self {
        let mut parents: HashMap<Id, Vec<Id>> = HashMap::new();
        for &id in below {
            for child in graph.children(id) {
                parents.entry(child).or_default().push(id);
            }
        }
        let terms = match graph.node(root) {
            Node::Sum(terms, _) => Some(terms.iter().map(|(factor, x)| (*x, factor.clone()))),
            _ => None,
        };
        Lines {
            graph,
            root,
            parents,
            terms: terms.map(Iterator::collect),
            plain: HashMap::new(),
            computed: 0,
        }
    }

    fn smoothness(&mut self, kink: &Kink, order: u32) -> Smoothness {
        let mut changed: BTreeSet<Id> = BTreeSet::new();
        let mut open = kink.zeros.clone();
        while let Some(id) = open.pop() {
            if changed.insert(id) {
                open.extend(self.parents.get(&id).into_iter().flatten());
            }
        }
        let directions: &[[i8; 2]] = match kink.is_crossed {
            true => &[[1, 0]],
            false => &[[1, 0], [0, 1], [1, 1], [1, -1]],
        };
        let mut along = Vec::new();
        for &direction in directions {
            let sides = [true, false].map(|side| self.value(kink, &changed, (direction, side)));
            if self.computed > MOST_VALUES {
                return Smoothness::TooLong;
            }
            let [Value::Series(right), Value::Series(left)] = sides else {
                let infinite = sides.iter().any(|side| matches!(side, Value::Infinite));
                let unknown = sides.iter().any(|side| matches!(side, Value::Unknown));
                return match infinite && !unknown {
                    true => Smoothness::Infinite,
                    false => Smoothness::Rough,
                };
            };
            if right.has_pole() || left.has_pole() {
                return Smoothness::Infinite;
            }
            match both(&right, &left, order) {
                Some(terms) => along.push(terms),
                None => return Smoothness::Rough,
            }
        }
        let [a, b, sum, difference] = along.as_slice() else {
            return Smoothness::Smooth;
        };
        // The constant is one number, the next terms are linear and quadratic in the direction.
        let rule = |k: usize| match k {
            0 => sum[0].add(difference[0]).add(a[0].add(b[0]).times(-1.0)),
            1 => sum[1].add(difference[1]).add(a[1].times(-2.0)),
            _ => {
                let squares = a[2].add(b[2]).times(-2.0);
                sum[2].add(difference[2]).add(squares)
            }
        };
        match (0..=order as usize).all(|k| rule(k).is_zero()) {
            true => Smoothness::Smooth,
            false => Smoothness::Rough,
        }
    }

    /// The formula along a line, on one side of a kink.
    fn value(&mut self, kink: &Kink, changed: &BTreeSet<Id>, line: Line) -> Value {
        let plain = self.plain.entry(line).or_default();
        let is_sum = |id: Id| id == self.root && self.terms.is_some();
        let inner = changed
            .iter()
            .filter(|id| !kink.zeros.contains(id) && !is_sum(**id));
        let mut open: Vec<Id> = inner.flat_map(|&id| self.graph.children(id)).collect();
        let mut needed = BTreeSet::new();
        while let Some(id) = open.pop() {
            if !changed.contains(&id) && !plain.contains_key(&id) && needed.insert(id) {
                open.extend(self.graph.children(id));
            }
        }
        for id in needed {
            let value = compute(self.graph, id, line, |x| &plain[&x]);
            plain.insert(id, value);
            self.computed += 1;
        }
        let mut new: HashMap<Id, Value> = HashMap::new();
        for &id in changed {
            let value = match kink.zeros.contains(&id) {
                true => Value::line(0.0, slope(id, line)),
                false => {
                    let of = |x: Id| new.get(&x).unwrap_or_else(|| &plain[&x]);
                    match &self.terms {
                        // The terms that the kink does not change are smooth.
                        Some(terms) if id == self.root => {
                            let terms = changed.iter().filter_map(|x| Some((terms.get(x)?, *x)));
                            total(terms, of)
                        }
                        _ => compute(self.graph, id, line, of),
                    }
                }
            };
            self.computed += 1 + match id == self.root {
                true => changed.len(),
                false => self.graph.children(id).len(),
            };
            if self.computed > MOST_VALUES {
                return Value::Unknown;
            }
            new.insert(id, value);
        }
        new.remove(&self.root).unwrap_or(Value::Unknown)
    }
}

/// A pseudo-random number between 0.3 and 1.3, the same for the same seed.
fn random(id: Id, seed: u64) -> f64 {
    let mut x = (id.number() ^ seed << 40).wrapping_add(0x9E37_79B9_7F4A_7C15);
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    0.3 + ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// The slope of a variable along a line.
fn slope(id: Id, ([a, b], side): Line) -> f64 {
    let slope = f64::from(a) * random(id, 1) + f64::from(b) * random(id, 2);
    if side { slope } else { -slope }
}

/// `Σ c x`
fn total<'t, 'v>(
    terms: impl Iterator<Item = (&'t Number, Id)>,
    of: impl Fn(Id) -> &'v Value,
) -> Value {
    let start = Value::line(0.0, 0.0);
    terms.fold(start, |sum, (factor, x)| {
        sum.add(&of(x).times(to_f64(factor)))
    })
}

/// The value of a node from those of its operands.
fn compute<'v>(graph: &Graph, id: Id, line: Line, of: impl Fn(Id) -> &'v Value) -> Value {
    match graph.node(id) {
        Node::Constant(value) => Value::line(to_f64(value), 0.0),
        Node::Pi => Value::line(std::f64::consts::PI, 0.0),
        Node::Parameter(..) => Value::line(random(id, 0), 0.0),
        Node::Time | Node::Coordinate(_) => Value::line(random(id, 0), slope(id, line)),
        Node::Sum(terms, constant) => {
            let sum = total(terms.iter().map(|(factor, x)| (factor, *x)), of);
            sum.add(&Value::line(to_f64(constant), 0.0))
        }
        Node::Product(factors) => {
            let powers = factors.iter().map(|(x, exponent)| of(*x).power(exponent));
            powers.fold(Value::line(1.0, 0.0), |product, power| {
                product.multiply(&power)
            })
        }
        Node::Elementary(function, x) => of(*x).elementary(*function),
        Node::Atan2(y, x) => of(*y).angle(of(*x)),
        // Any function serves.
        Node::User(function, derivative, x) => {
            let shift = Value::line(random(id, 0) + (function + derivative) as f64, 0.0);
            of(*x).add(&shift).elementary(Elementary::Sin)
        }
        Node::Total(_, body) => of(*body).clone(),
    }
}

/// The terms up to τᵏ of a function with these series on both sides; `None` if it is not k times continuously differentiable.
fn both(right: &Series, left: &Series, order: u32) -> Option<Vec<Coefficient>> {
    let mut terms = vec![Coefficient::default(); order as usize + 1];
    let mut differences = terms.clone();
    let last = integer(order.into());
    for (series, is_left) in [(right, false), (left, true)] {
        if !series.is_known_to(order) {
            return None;
        }
        for (exponent, term) in series
            .terms()
            .take_while(|(exponent, _)| **exponent <= last)
        {
            let k = usize::try_from(exponent.to_integer()).ok()?;
            if !exponent.is_integer() {
                return None;
            }
            let odd = if is_left && k % 2 == 1 { -1.0 } else { 1.0 };
            terms[k] = terms[k].add(term.times(odd / 2.0));
            differences[k] = differences[k].add(term.times(if is_left { -odd } else { odd }));
        }
    }
    let agree = differences.iter().all(|difference| difference.is_zero());
    agree.then_some(terms)
}
