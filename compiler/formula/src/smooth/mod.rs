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

use num_traits::{Signed, ToPrimitive, Zero};

use self::series::{Coefficient, MAX_POWERS, Series, Value};
use super::function::Elementary;
use super::graph::{Graph, Id, Node, Number, integer};
use symplectic_exact::rounding::to_f64;

/// The largest number of products of two terms of series for one formula.
const MAX_PRODUCTS: usize = 10_000_000;

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

/// The powers that are zero or infinite at a kink.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Powers {
    /// As they are.
    Given,
    /// Each with a random factor of its own, another one on every line and side. A formula that is still smooth, as `|x|³` is, but not
    /// `|x| sin(|x|)`, has the same derivatives at the kink whatever the factors are: those with 0 in place of the powers.
    Free,
}

/// The kinks of a formula that are wanted, each with its smoothness: whether the formula has `order` continuous derivatives there.
pub(super) fn kinks(
    graph: &Graph,
    root: Id,
    order: u32,
    powers: Powers,
    wanted: impl Fn(&Kink) -> bool,
) -> Vec<(Kink, Smoothness)> {
    let below = graph.below([root]);
    let mut work = 0;
    let all = candidates(graph, &below, &mut work);
    let kinks = all.into_iter().filter(wanted);
    let mut lines: Option<Lines<'_>> = None;
    let examined = kinks.map(|kink| {
        let smoothness = match kink.is_divisor {
            true => Smoothness::Infinite,
            false => lines
                .get_or_insert_with(|| Lines::new(graph, root, powers, &below, work))
                .smoothness(&kink, order),
        };
        (kink, smoothness)
    });
    examined.collect()
}

/// The places where powers in a formula have no derivative.
fn candidates(graph: &Graph, below: &[Id], work: &mut usize) -> Vec<Kink> {
    let mut kinks: BTreeMap<Vec<Id>, Kink> = BTreeMap::new();
    let powers = below.iter().filter_map(|&id| match graph.node(id) {
        Node::Product(factors) => Some(factors),
        _ => None,
    });
    let powers: Vec<&(Id, Number)> = powers.flatten().collect();
    let negative = powers.iter().filter(|(_, exponent)| exponent.is_negative());
    let negative: HashSet<Id> = negative.map(|(base, _)| *base).collect();
    let rough = powers.iter().filter(|(_, power)| !power.is_integer());
    let rough: BTreeSet<Id> = rough.map(|(base, _)| graph.scaled(*base).1).collect();
    let factors = Factors::of(graph, rough);
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
        let crossed = factors.even(inner);
        if crossed.is_empty()
            && let Some(zeros) = factors.squares.get(&inner).cloned()
            && zeros.iter().all(|&zero| is_variable(graph, zero))
        {
            let leaves = graph.below(zeros.iter().copied());
            let leaves = leaves
                .iter()
                .filter(|&&id| matches!(graph.node(id), Node::Coordinate(_)));
            let in_total = !graph.totals(inner).is_empty();
            let is_crossed =
                leaves.count() == 1 && !in_total && vanish_together(graph, &zeros, work);
            add(*base, zeros, is_crossed);
        }
        for zero in crossed {
            if is_variable(graph, zero) && !graph.has_one_sign(zero) {
                add(*base, vec![zero], true);
            }
        }
    }
    kinks.into_values().collect()
}

/// Whether functions of one coordinate have a common zero: `x` and `sin(x)`, but not `x` and `x - 1` or `sin(x)` and `cos(x)`. Two
/// functions of which none is linear count as having none; where they do, a step returns an error. What is too long counts as a zero.
fn vanish_together(graph: &Graph, zeros: &[Id], work: &mut usize) -> bool {
    if zeros.len() == 1 {
        return true;
    }
    let line = ([1, 0], true);
    let mut values = |at: f64| {
        let mut values: HashMap<Id, Value> = HashMap::new();
        for id in graph.below(zeros.iter().copied()) {
            let value = match graph.node(id) {
                Node::Coordinate(_) => Value::line(at, 1.0),
                _ if *work > MAX_PRODUCTS => Value::Unknown,
                _ => {
                    let of = |x| &values[&x];
                    let value = compute(graph, id, line, Powers::Given, of);
                    *work += products(graph, id, &value, of);
                    value
                }
            };
            values.insert(id, value);
        }
        values
    };
    let here = values(0.0);
    let mut roots = zeros.iter().filter_map(|zero| match &here[zero] {
        Value::Series(series) => series.root(),
        _ => None,
    });
    let first = roots.next();
    let vanish = first.is_some_and(|root| {
        let values = values(root);
        zeros.iter().all(|zero| values[zero].vanishes())
    });
    vanish || *work > MAX_PRODUCTS
}

fn is_variable(graph: &Graph, id: Id) -> bool {
    let depends = graph.depends(id);
    depends.q || depends.p || depends.v
}

fn is_even(number: &Number) -> bool {
    (number / integer(2)).is_integer()
}

/// The factors of the functions that powers are taken of.
struct Factors {
    /// The powers that are factors: of a sum, of all its terms.
    powers: HashMap<Id, BTreeMap<Id, Number>>,
    /// The functions whose even powers a sum consists of.
    squares: HashMap<Id, Vec<Id>>,
}

impl Factors {
    fn of(graph: &Graph, bases: BTreeSet<Id>) -> Self {
        let mut below = BTreeSet::new();
        let mut open: Vec<Id> = bases.into_iter().collect();
        while let Some(id) = open.pop() {
            if below.insert(id)
                && let Node::Sum(..) | Node::Product(_) | Node::Total(..) = graph.node(id)
            {
                open.extend(graph.children(id));
            }
        }
        let mut all = Factors {
            powers: HashMap::new(),
            squares: HashMap::new(),
        };
        for id in below {
            let powers = all.powers_of(graph, id);
            all.powers.insert(id, powers);
            if let Some(squares) = all.squares_of(graph, id) {
                all.squares.insert(id, squares);
            }
        }
        all
    }

    /// The functions whose even powers are factors.
    fn even(&self, id: Id) -> Vec<Id> {
        let powers = self.powers.get(&id).into_iter().flatten();
        let even = powers.filter(|(_, power)| is_even(power) && !power.is_zero());
        even.map(|(x, _)| *x).collect()
    }

    fn powers_of(&self, graph: &Graph, id: Id) -> BTreeMap<Id, Number> {
        let mut all = BTreeMap::new();
        match graph.node(id) {
            Node::Product(factors) => {
                for (x, exponent) in factors {
                    for (y, power) in &self.powers[x] {
                        *all.entry(*y).or_insert_with(Number::zero) += power * exponent;
                    }
                }
                return all;
            }
            Node::Sum(terms, constant) if constant.is_zero() => {
                let mut terms = terms.iter().map(|(_, x)| &self.powers[x]);
                all = terms.next().cloned().unwrap_or_default();
                for powers in terms {
                    all.retain(|x, power| match powers.get(x) {
                        Some(other) => {
                            *power = (&*power).min(other).clone();
                            true
                        }
                        None => false,
                    });
                }
            }
            _ => {}
        }
        all.insert(id, integer(1));
        all
    }

    fn squares_of(&self, graph: &Graph, id: Id) -> Option<Vec<Id>> {
        match graph.node(id) {
            Node::Product(factors) => match factors.as_slice() {
                [(x, power)] if is_even(power) && power.is_positive() => Some(vec![*x]),
                _ => None,
            },
            Node::Sum(terms, constant) if constant.is_zero() => {
                let mut all = BTreeSet::new();
                for (factor, x) in terms {
                    all.extend(self.squares.get(x).filter(|_| factor.is_positive())?);
                }
                Some(all.into_iter().collect())
            }
            Node::Total(_, body) => self.squares.get(body).cloned(),
            _ => None,
        }
    }
}

/// A line through a point: two directions, with their factors, and a side.
type Line = ([i8; 2], bool);

/// The values of a formula along lines.
struct Lines<'a> {
    graph: &'a Graph,
    root: Id,
    powers: Powers,
    parents: HashMap<Id, Vec<Id>>,
    /// The terms of the formula, if it is a sum.
    terms: Option<HashMap<Id, Number>>,
    /// The values of nodes that no kink has changed.
    plain: HashMap<Line, HashMap<Id, Value>>,
    /// The number of products of two terms so far.
    work: usize,
}

impl<'a> Lines<'a> {
    fn new(graph: &'a Graph, root: Id, powers: Powers, below: &[Id], work: usize) -> Self {
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
            powers,
            parents,
            terms: terms.map(Iterator::collect),
            plain: HashMap::new(),
            work,
        }
    }

    fn smoothness(&mut self, kink: &Kink, order: u32) -> Smoothness {
        if self.work > MAX_PRODUCTS {
            return Smoothness::TooLong;
        }
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
            if self.work > MAX_PRODUCTS {
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
            let of = |x| &plain[&x];
            let value = compute(self.graph, id, line, Powers::Given, of);
            self.work += products(self.graph, id, &value, of);
            plain.insert(id, value);
            if self.work > MAX_PRODUCTS {
                return Value::Unknown;
            }
        }
        let mut new: HashMap<Id, Value> = HashMap::new();
        for &id in changed {
            let of = |x: Id| new.get(&x).unwrap_or_else(|| &plain[&x]);
            let value = match &self.terms {
                _ if kink.zeros.contains(&id) => Value::line(0.0, slope(id, line)),
                // The terms that the kink does not change are smooth.
                Some(terms) if id == self.root => {
                    let terms = changed.iter().filter_map(|x| Some((terms.get(x)?, *x)));
                    self.work += changed.len();
                    total(terms, of)
                }
                _ => {
                    let value = compute(self.graph, id, line, self.powers, of);
                    self.work += products(self.graph, id, &value, of);
                    value
                }
            };
            if self.work > MAX_PRODUCTS {
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

/// A bound of the number of products of two terms in the computation of a value.
fn products<'v>(graph: &Graph, id: Id, value: &Value, of: impl Fn(Id) -> &'v Value) -> usize {
    let operands = graph.children(id).into_iter().map(|x| of(x).size());
    let terms: usize = operands.sum();
    match graph.node(id) {
        Node::Sum(..) | Node::Total(..) => 1 + terms,
        _ => 1 + terms * value.size() * MAX_POWERS,
    }
}

/// The factor of a [free](Powers::Free) power.
fn free_factor(base: Id, exponent: &Number, ([a, b], side): Line) -> f64 {
    let bits = exponent.to_f64().unwrap_or_default().to_bits();
    let power = bits.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 45;
    let line = 9 * u64::from(side) + (3 * (a + 1) + b + 1) as u64;
    random(base, (power << 5) + 3 + line)
}

/// The value of a node from those of its operands.
fn compute<'v>(
    graph: &Graph,
    id: Id,
    line: Line,
    powers: Powers,
    of: impl Fn(Id) -> &'v Value,
) -> Value {
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
            let factors = factors.iter().map(|(x, exponent)| {
                let power = of(*x).power(exponent);
                let is_free = powers == Powers::Free && !exponent.is_integer();
                match is_free && of(*x).vanishes() {
                    true => power.times(free_factor(*x, exponent, line)),
                    false => power,
                }
            });
            factors.fold(Value::line(1.0, 0.0), |product, power| {
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
