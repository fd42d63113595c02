//! A formula as a graph in which equal parts are one node.
//!
//! Nodes are only made by the functions of [`Graph`], which bring them into a normal form. These changes are exact: numeric factors
//! are collected, equal terms and equal factors are joined, and terms and factors are put in the order in which they first appeared in the
//! formula. Nothing is expanded: a sum in parentheses stays a term, a product in parentheses a factor.

use std::collections::{BTreeSet, HashMap, HashSet};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::function::Elementary;
use super::syntax::Length;

/// An exact number.
pub type Number = BigRational;

/// A node of a [`Graph`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Id(u32);

impl Id {
    /// The number of the node: operands have smaller ones.
    pub(super) fn number(self) -> u64 {
        self.0.into()
    }
}

/// Positions, momenta or velocities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Half {
    /// Positions.
    Q,
    /// Momenta.
    P,
    /// Velocities, in a Lagrangian.
    V,
}

impl Half {
    /// The letter of the vector.
    pub fn letter(self) -> &'static str {
        match self {
            Half::Q => "q",
            Half::P => "p",
            Half::V => "v",
        }
    }
}

/// A loop over one index, or over the pairs of a list.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Loop {
    /// The range of the loop.
    pub range: LoopRange,
    /// The number of loops around it.
    pub depth: usize,
}

/// The range of a loop.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum LoopRange {
    /// From the first index up to, but excluding, the second.
    Between(Index, Index),
    /// The pairs of a parameter, given by its index.
    List(usize),
}

/// The index of a loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LoopId(pub usize);

/// The index of an entry: a base and an offset.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Index {
    /// The base.
    pub base: Base,
    /// The offset.
    pub offset: i64,
}

/// The base of an index.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Base {
    /// Zero.
    Start,
    /// The end of an array.
    End(Length),
    /// The index of a loop over a range.
    Loop(LoopId),
    /// The first or the second index of a pair in a list.
    Pair(LoopId, usize),
}

impl Index {
    /// A number.
    pub fn number(offset: i64) -> Self {
        Index {
            base: Base::Start,
            offset,
        }
    }

    /// The index of a loop.
    pub fn of(base: Base) -> Self {
        Index { base, offset: 0 }
    }

    /// The loop in which the index changes.
    pub fn loop_id(&self) -> Option<LoopId> {
        match self.base {
            Base::Loop(id) | Base::Pair(id, _) => Some(id),
            Base::Start | Base::End(_) => None,
        }
    }
}

/// A coordinate or momentum.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Coordinate {
    /// The half of the state.
    pub half: Half,
    /// The index within the half.
    pub index: Index,
    /// The component, if each coordinate is a vector.
    pub component: usize,
}

impl Coordinate {
    /// The coordinate of another half with the same index.
    pub fn of(&self, half: Half) -> Self {
        Coordinate {
            half,
            ..self.clone()
        }
    }
}

/// The expression at a node.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number.
    Constant(Number),
    /// π
    Pi,
    /// The time.
    Time,
    /// A parameter, or an entry of one.
    Parameter(usize, Vec<Index>),
    /// A coordinate or momentum.
    Coordinate(Coordinate),
    /// `Σ c x + constant`
    Sum(Vec<(Number, Id)>, Number),
    /// `Π xᵉ`
    Product(Vec<(Id, Number)>),
    /// An elementary function.
    Elementary(Elementary, Id),
    /// The angle of the point (second, first).
    Atan2(Id, Id),
    /// A function of the user, or one of its derivatives.
    User(usize, usize, Id),
    /// A sum over a loop.
    Total(LoopId, Id),
}

/// The dependences of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Dependence {
    /// On positions.
    pub q: bool,
    /// On momenta.
    pub p: bool,
    /// On velocities.
    pub v: bool,
    /// On the time.
    pub time: bool,
    /// On a parameter.
    pub parameter: bool,
    /// The loops in which its value changes, as bits.
    pub loops: u64,
}

impl Dependence {
    /// Adds the dependences of another node.
    pub fn join(&mut self, other: Self) {
        self.q |= other.q;
        self.p |= other.p;
        self.v |= other.v;
        self.time |= other.time;
        self.parameter |= other.parameter;
        self.loops |= other.loops;
    }

    /// Whether the node depends on a half of the state.
    pub fn on(self, half: Half) -> bool {
        match half {
            Half::Q => self.q,
            Half::P => self.p,
            Half::V => self.v,
        }
    }

    /// Whether the node is a function of parameters only.
    pub fn is_fixed(self) -> bool {
        !(self.q || self.p || self.v || self.time)
    }

    /// Whether the node changes in a loop.
    pub fn changes_in(self, id: LoopId) -> bool {
        self.loops & (1 << id.0) != 0
    }
}

/// The largest number of factors of a product; a longer product becomes a product of products.
const MAX_FACTORS: usize = 8;
/// The longest numeric power that is evaluated, in bits.
const MAX_BITS: u64 = 4096;
/// The largest number of loops of a formula.
pub const MAX_LOOPS: usize = 64;

/// The nodes of formulas.
#[derive(Debug, Clone, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    depends: Vec<Dependence>,
    /// Whether the value of each node is visibly never negative.
    one_sign: Vec<bool>,
    ids: HashMap<Node, Id>,
    loops: Vec<Loop>,
    /// Whether a derivative needed more loops than allowed.
    overflowed: bool,
    /// Bases of powers at whose zeros the formulas are smooth.
    smooth: HashSet<Id>,
}

impl Graph {
    /// The expression at a node.
    pub fn node(&self, id: Id) -> &Node {
        &self.nodes[id.0 as usize]
    }

    /// The dependences of a node.
    pub fn depends(&self, id: Id) -> Dependence {
        self.depends[id.0 as usize]
    }

    /// A loop.
    pub fn get_loop(&self, id: LoopId) -> &Loop {
        &self.loops[id.0]
    }

    /// The index of a loop; `None` if there are too many.
    pub fn add_loop(&mut self, new: Loop) -> Option<LoopId> {
        let found = self.loops.iter().position(|known| *known == new);
        if found.is_none() && self.loops.len() == MAX_LOOPS {
            self.overflowed = true;
            return None;
        }
        Some(LoopId(found.unwrap_or_else(|| {
            self.loops.push(new);
            self.loops.len() - 1
        })))
    }

    /// The loops in which the range of a loop changes.
    pub fn range_loops(&self, id: LoopId) -> u64 {
        let LoopRange::Between(start, end) = &self.loops[id.0].range else {
            return 0;
        };
        bits(start) | bits(end)
    }

    fn add(&mut self, node: Node) -> Id {
        if let Some(&id) = self.ids.get(&node) {
            return id;
        }
        let mut depends = Dependence::default();
        match &node {
            Node::Time => depends.time = true,
            Node::Coordinate(coordinate) => {
                depends.q = coordinate.half == Half::Q;
                depends.p = coordinate.half == Half::P;
                depends.v = coordinate.half == Half::V;
                depends.loops = bits(&coordinate.index);
            }
            Node::Parameter(_, indices) => {
                depends.parameter = true;
                depends.loops = indices.iter().map(bits).fold(0, |all, bits| all | bits);
            }
            _ => {
                for child in children(&node) {
                    depends.join(self.depends(child));
                }
            }
        }
        if let Node::Total(id, _) = node {
            depends.loops &= !(1 << id.0);
            depends.loops |= self.range_loops(id);
        }
        let one_sign = self.is_never_negative(&node);
        let id = Id(self.nodes.len() as u32);
        self.nodes.push(node.clone());
        self.depends.push(depends);
        self.one_sign.push(one_sign);
        self.ids.insert(node, id);
        id
    }

    fn is_never_negative(&self, node: &Node) -> bool {
        match node {
            Node::Constant(value) => !value.is_negative(),
            Node::Pi => true,
            Node::Sum(terms, constant) => {
                let mut terms = terms.iter();
                !constant.is_negative()
                    && terms.all(|(factor, x)| factor.is_positive() && self.has_one_sign(*x))
            }
            // An even power, or one whose denominator is even.
            Node::Product(factors) => factors.iter().all(|(x, exponent)| {
                let [above, below] =
                    [exponent.numer(), exponent.denom()].map(|part| (part % 2_u32).is_zero());
                above || below || self.has_one_sign(*x)
            }),
            Node::Elementary(Elementary::Exp | Elementary::Cosh | Elementary::Acos, _) => true,
            Node::Total(_, body) => self.has_one_sign(*body),
            _ => false,
        }
    }

    /// Whether a value is visibly never negative.
    pub fn has_one_sign(&self, id: Id) -> bool {
        self.one_sign[id.0 as usize]
    }

    /// A number.
    pub fn constant(&mut self, value: Number) -> Id {
        self.add(Node::Constant(value))
    }

    /// An integer.
    pub fn integer(&mut self, value: i64) -> Id {
        self.constant(integer(value))
    }

    /// π
    pub fn pi(&mut self) -> Id {
        self.add(Node::Pi)
    }

    /// The time.
    pub fn time(&mut self) -> Id {
        self.add(Node::Time)
    }

    /// A parameter.
    pub fn parameter(&mut self, parameter: usize, indices: Vec<Index>) -> Id {
        self.add(Node::Parameter(parameter, indices))
    }

    /// A coordinate.
    pub fn coordinate(&mut self, coordinate: Coordinate) -> Id {
        self.add(Node::Coordinate(coordinate))
    }

    /// The value of a node that is a number.
    pub fn value(&self, id: Id) -> Option<&Number> {
        match self.node(id) {
            Node::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// Whether a node is the number 0.
    pub fn is_zero(&self, id: Id) -> bool {
        self.value(id).is_some_and(Zero::is_zero)
    }

    /// A node as a number times another.
    pub fn scaled(&self, id: Id) -> (Number, Id) {
        match self.node(id) {
            Node::Sum(terms, constant) if terms.len() == 1 && constant.is_zero() => {
                terms[0].clone()
            }
            _ => (Number::one(), id),
        }
    }

    /// `factor·x`
    pub fn scale(&mut self, factor: Number, x: Id) -> Id {
        self.sum([(factor, x)])
    }

    /// `Σ c x`
    pub fn sum(&mut self, terms: impl IntoIterator<Item = (Number, Id)>) -> Id {
        let mut constant = Number::zero();
        let mut list: Vec<(Number, Id)> = Vec::new();
        for (factor, x) in terms {
            let (inner, x) = self.scaled(x);
            match self.value(x) {
                Some(value) => constant += factor * inner * value,
                None => list.push((factor * inner, x)),
            }
        }
        list.sort_by_key(|&(_, x)| x);
        let mut joined: Vec<(Number, Id)> = Vec::with_capacity(list.len());
        for (factor, x) in list {
            match joined.last_mut() {
                Some(last) if last.1 == x => last.0 += factor,
                _ => joined.push((factor, x)),
            }
        }
        joined.retain(|(factor, _)| !factor.is_zero());
        match joined.as_slice() {
            [] => return self.constant(constant),
            [(factor, x)] if factor.is_one() && constant.is_zero() => return *x,
            _ => {}
        }
        // d and −d share one node.
        if joined.len() > 1 && constant.is_zero() && joined[0].0.is_negative() {
            for term in &mut joined {
                term.0 = -&term.0;
            }
            let negative = self.add(Node::Sum(joined, constant));
            return self.add(Node::Sum(vec![(-Number::one(), negative)], Number::zero()));
        }
        self.add(Node::Sum(joined, constant))
    }

    /// `factor·Π xᵉ`; 0 must not have a negative exponent.
    pub fn product(
        &mut self,
        factor: Number,
        factors: impl IntoIterator<Item = (Id, Number)>,
    ) -> Id {
        let mut factor = factor;
        let mut list: Vec<(Id, Number)> = Vec::new();
        for (x, exponent) in factors {
            let (scale, x) = self.scaled(x);
            match exponent.is_integer().then(|| exponent.to_i64()).flatten() {
                // A numeric power becomes part of the factor.
                Some(power) if scale.is_one() || is_short(&scale, power) => {
                    factor *= whole_power(&scale, power);
                    match self.value(x) {
                        Some(value)
                            if is_short(value, power) && (power >= 0 || !value.is_zero()) =>
                        {
                            factor *= whole_power(&value.clone(), power);
                        }
                        _ => self.factor(&mut list, x, exponent),
                    }
                }
                _ => {
                    let (powers, x) = self.even_powers(x, &exponent);
                    list.extend(powers);
                    let whole = self.scale(scale, x);
                    self.factor(&mut list, whole, exponent);
                }
            }
        }
        if factor.is_zero() {
            return self.constant(factor);
        }
        list.sort_by_key(|&(x, _)| x);
        let mut joined: Vec<(Id, Number)> = Vec::with_capacity(list.len());
        for (x, exponent) in list {
            match joined.last_mut() {
                Some(last) if last.0 == x => last.1 += exponent,
                _ => joined.push((x, exponent)),
            }
        }
        joined.retain(|(_, exponent)| !exponent.is_zero());
        self.absolute_values(&mut joined);
        let x = match joined.as_slice() {
            [] => return self.constant(factor),
            [(x, exponent)] if exponent.is_one() => *x,
            _ => self.product_of(joined),
        };
        self.scale(factor, x)
    }

    fn product_of(&mut self, factors: Vec<(Id, Number)>) -> Id {
        if factors.len() <= MAX_FACTORS {
            return self.add(Node::Product(factors));
        }
        let parts = factors
            .chunks(MAX_FACTORS)
            .map(<[_]>::to_vec)
            .collect::<Vec<_>>();
        let parts = parts.into_iter().map(|part| {
            let single = part.len() == 1 && part[0].1.is_one();
            let x = if single {
                part[0].0
            } else {
                self.add(Node::Product(part))
            };
            (x, Number::one())
        });
        let mut parts: Vec<_> = parts.collect();
        parts.sort_by_key(|&(x, _)| x);
        self.product_of(parts)
    }

    /// Adds a factor; a power of a power becomes one power if the two are equal: `(x²)^(1/2) = |x|` is `x` if x is never negative.
    fn factor(&self, list: &mut Vec<(Id, Number)>, x: Id, exponent: Number) {
        if let Node::Product(inner) = self.node(x)
            && let [(base, power)] = inner.as_slice()
        {
            let even = |power: &Number| (power.numer() % BigInt::from(2)).is_zero();
            let whole = power * &exponent;
            let same = exponent.is_integer() || !even(power) || self.has_one_sign(*base);
            if same || whole.is_integer() && even(&whole) {
                return list.push((*base, power * exponent));
            }
        }
        list.push((x, exponent));
    }

    /// `(x⁴ a + x⁴ b)^(1/2) = x² (a + b)^(1/2)`: for a power of a product, or of a sum of products, the even powers that leave it, and the base
    /// that remains.
    fn even_powers(&mut self, id: Id, exponent: &Number) -> (Vec<(Id, Number)>, Id) {
        let terms = match self.node(id) {
            Node::Sum(terms, constant) if constant.is_zero() => terms.clone(),
            Node::Product(factors) if factors.len() > 1 => vec![(Number::one(), id)],
            _ => return (Vec::new(), id),
        };
        let terms: Vec<(Number, Vec<(Id, Number)>)> = terms
            .into_iter()
            .map(|(factor, term)| (factor, self.flat_factors(term)))
            .collect();
        // The even powers of which also the power is even.
        let step = integer(2) * Number::from_integer(exponent.denom().clone());
        let common = |base: Id| {
            let powers = terms.iter().map(|(_, factors)| {
                let (_, power) = factors.iter().find(|(x, _)| *x == base)?;
                Some((power / &step).floor() * &step)
            });
            let powers: Option<Vec<Number>> = powers.collect();
            powers?.into_iter().min().filter(Signed::is_positive)
        };
        let first = terms.first().into_iter().flat_map(|(_, factors)| factors);
        let bases: BTreeSet<Id> = first.map(|(base, _)| *base).collect();
        let common: Vec<(Id, Number)> = bases
            .into_iter()
            .filter_map(|base| Some((base, common(base)?)))
            .collect();
        if common.is_empty() {
            return (common, id);
        }
        let divisors: Vec<_> = common.iter().map(|(x, power)| (*x, -power)).collect();
        let rest = terms.into_iter().map(|(factor, factors)| {
            let divided = factors.into_iter().chain(divisors.iter().cloned());
            (factor, self.product(Number::one(), divided))
        });
        let rest: Vec<_> = rest.collect();
        let powers = common.into_iter().map(|(x, power)| (x, power * exponent));
        (powers.collect(), self.sum(rest))
    }

    /// The factors of a product and of the products in it that have whole exponents.
    fn flat_factors(&self, id: Id) -> Vec<(Id, Number)> {
        let factors = |id: Id| match self.node(id) {
            Node::Product(factors) => factors.clone(),
            _ => vec![(id, Number::one())],
        };
        let all = factors(id).into_iter().flat_map(|(x, exponent)| {
            let inner = match exponent.is_integer() {
                true => factors(x),
                false => vec![(x, Number::one())],
            };
            let powers = inner.into_iter();
            powers.map(move |(y, power)| (y, power * &exponent))
        });
        all.collect()
    }

    /// `x²·(x²)ᵉ = (x²)ᵉ⁺¹`, which is defined at zero even if the left side is not.
    fn absolute_values(&self, factors: &mut Vec<(Id, Number)>) {
        let two = integer(2);
        for k in 0..factors.len() {
            let (square, exponent) = &factors[k];
            let Node::Product(inner) = self.node(*square) else {
                continue;
            };
            let [(base, power)] = inner.as_slice() else {
                continue;
            };
            if exponent.is_integer() || *power != two {
                continue;
            }
            let Some(place) = factors.iter().position(|(x, _)| x == base) else {
                continue;
            };
            let whole = &factors[place].1;
            if whole.is_integer() && *whole >= two {
                let squares = (whole / &two).floor();
                factors[place].1 -= &squares * &two;
                factors[k].1 += squares;
            }
        }
        factors.retain(|(_, exponent)| !exponent.is_zero());
    }

    /// `xᵉ`
    pub fn power(&mut self, x: Id, exponent: Number) -> Id {
        self.product(Number::one(), [(x, exponent)])
    }

    /// `|x|`, which is `(x²)^(1/2)`.
    pub fn absolute(&mut self, x: Id) -> Id {
        let (factor, x) = self.scaled(x);
        if let Some(value) = self.value(x) {
            let value = value.abs();
            return self.constant(factor.abs() * value);
        }
        if self.has_one_sign(x) {
            return self.scale(factor.abs(), x);
        }
        let square = self.power(x, integer(2));
        let root = self.power(square, Number::new(1.into(), 2.into()));
        self.scale(factor.abs(), root)
    }

    /// The larger one of two numbers.
    pub fn larger(&mut self, a: Id, b: Id) -> Id {
        let difference = self.sum([(integer(1), a), (integer(-1), b)]);
        let size = self.absolute(difference);
        let positive = self.sum([(integer(1), difference), (integer(1), size)]);
        self.sum([(Number::new(1.into(), 2.into()), positive), (integer(1), b)])
    }

    /// The function x of a power `(x²)ᵉ` whose exponent is not whole.
    fn absolute_power(&self, base: Id, exponent: &Number) -> Option<Id> {
        match self.node(base) {
            Node::Product(factors) if !exponent.is_integer() => match factors.as_slice() {
                [(x, power)] if *power == integer(2) => Some(*x),
                _ => None,
            },
            _ => None,
        }
    }

    /// The function x of `|x|`.
    fn absolute_of(&self, id: Id) -> Option<Id> {
        let Node::Product(factors) = self.node(id) else {
            return None;
        };
        match factors.as_slice() {
            [(square, exponent)] if *exponent == Number::new(1.into(), 2.into()) => {
                self.absolute_power(*square, exponent)
            }
            _ => None,
        }
    }

    /// For a node `c(x + |x|)` or `c(x − |x|)`, which is zero on one side of `x = 0`: the derivative with respect to x on the other, and x.
    pub fn positive_part(&self, id: Id) -> Option<(Number, Id)> {
        let (scale, id) = self.scaled(id);
        let Node::Sum(terms, constant) = self.node(id) else {
            return None;
        };
        let [(factor, x), (other, size)] = terms.as_slice() else {
            return None;
        };
        let is_size = self.absolute_of(*size) == Some(*x);
        let same = constant.is_zero() && factor.abs() == other.abs();
        (is_size && same).then(|| (scale * factor * integer(2), *x))
    }

    /// The derivative of `baseᵉ`: with respect to which node, its factor, and its other factors. It is that with respect to the base,
    /// except if the base is the square of x, `(x²)ᵉ = |x|²ᵉ`, or zero on one side of `x = 0`: then it is that with respect to x.
    pub(super) fn slope_of_power(
        &self,
        base: Id,
        exponent: &Number,
    ) -> (Id, Number, Vec<(Id, Number)>) {
        let lower = (base, exponent - Number::one());
        if let Some(x) = self.absolute_power(base, exponent) {
            return (x, exponent * integer(2), vec![lower, (x, Number::one())]);
        }
        match self.positive_part(base) {
            Some((slope, x)) if *exponent > Number::one() => (x, exponent * slope, vec![lower]),
            _ => (base, exponent.clone(), vec![lower]),
        }
    }

    /// Declares that the formulas are smooth where the base of a power is zero, and have the same derivatives there with 0 for the power.
    pub(super) fn set_smooth(&mut self, base: Id) {
        self.smooth.insert(base);
    }

    /// Whether the formulas are smooth where the base of a power is zero, and have the same derivatives there with 0 for the power.
    pub fn is_smooth(&self, base: Id) -> bool {
        self.smooth.contains(&base)
    }

    /// The product of two nodes.
    pub fn multiply(&mut self, a: Id, b: Id) -> Id {
        self.product(Number::one(), [(a, Number::one()), (b, Number::one())])
    }

    /// An elementary function.
    pub fn elementary(&mut self, function: Elementary, x: Id) -> Id {
        use Elementary::{Acos, Asin, Atan, Cos, Cosh, Exp, Ln, Sin, Sinh, Tan, Tanh};
        if let Some(value) = self.value(x) {
            match function {
                Sin | Tan | Asin | Atan | Sinh | Tanh if value.is_zero() => return self.integer(0),
                Exp | Cos | Cosh if value.is_zero() => return self.integer(1),
                Ln | Acos if value.is_one() => return self.integer(0),
                _ => {}
            }
        }
        if let Some(value) = self
            .half_turns(x)
            .and_then(|turns| quarter_turn(function, &turns))
        {
            return self.integer(value);
        }
        let (scale, inner) = self.scaled(x);
        // An even function of |x| is that of x.
        if matches!(function, Cos | Cosh)
            && let Some(side) = self.absolute_of(inner)
        {
            let argument = self.scale(scale, side);
            return self.elementary(function, argument);
        }
        if scale.is_negative() {
            let positive = self.scale(-scale, inner);
            match function {
                Sin | Tan | Asin | Atan | Sinh | Tanh => {
                    let value = self.add(Node::Elementary(function, positive));
                    return self.scale(-Number::one(), value);
                }
                Cos | Cosh => return self.add(Node::Elementary(function, positive)),
                Exp | Ln | Acos => {}
            }
        }
        self.add(Node::Elementary(function, x))
    }

    /// An angle as a multiple of π, if twice the multiple is whole.
    pub fn half_turns(&self, x: Id) -> Option<Number> {
        let (turns, inner) = self.scaled(x);
        let known = *self.node(inner) == Node::Pi && (&turns * integer(2)).is_integer();
        known.then_some(turns)
    }

    /// The angle of the point `(x, y)`.
    pub fn atan2(&mut self, y: Id, x: Id) -> Id {
        self.add(Node::Atan2(y, x))
    }

    /// A function of the user, or one of its derivatives.
    pub fn user(&mut self, function: usize, derivative: usize, x: Id) -> Id {
        self.add(Node::User(function, derivative, x))
    }

    /// The sum over a loop.
    pub fn total(&mut self, id: LoopId, body: Id) -> Id {
        if self.is_zero(body) {
            return body;
        }
        let (factor, body) = self.scaled(body);
        let total = self.add(Node::Total(id, body));
        self.scale(factor, total)
    }

    /// The operands of a node.
    pub fn children(&self, id: Id) -> Vec<Id> {
        children(self.node(id))
    }

    /// The roots and all nodes below them, in an order in which they can be computed.
    pub fn below(&self, roots: impl IntoIterator<Item = Id>) -> Vec<Id> {
        let mut found = BTreeSet::new();
        let mut open: Vec<Id> = roots.into_iter().collect();
        while let Some(id) = open.pop() {
            if found.insert(id) {
                open.extend(self.children(id));
            }
        }
        found.into_iter().collect()
    }

    /// The loops of the sums in a formula.
    pub fn totals(&self, root: Id) -> Vec<LoopId> {
        let below = self.below([root]);
        let loops = below.into_iter().filter_map(|id| match self.node(id) {
            Node::Total(over, _) => Some(*over),
            _ => None,
        });
        loops.collect()
    }

    /// A node with the index of one loop replaced by that of another.
    pub fn rename(&mut self, root: Id, from: LoopId, to: LoopId) -> Id {
        let index = |index: &Index| {
            let base = match &index.base {
                Base::Loop(id) if *id == from => Base::Loop(to),
                Base::Pair(id, slot) if *id == from => Base::Pair(to, *slot),
                base => base.clone(),
            };
            Index {
                base,
                offset: index.offset,
            }
        };
        let mut known: HashMap<Id, Id> = HashMap::new();
        for id in self.below([root]) {
            if !self.depends(id).changes_in(from) {
                continue;
            }
            let of = |x: Id| known.get(&x).copied().unwrap_or(x);
            let renamed = match self.node(id).clone() {
                Node::Coordinate(coordinate) => {
                    let index = index(&coordinate.index);
                    self.coordinate(Coordinate {
                        index,
                        ..coordinate
                    })
                }
                Node::Parameter(parameter, indices) => {
                    let indices = indices.iter().map(index).collect();
                    self.parameter(parameter, indices)
                }
                Node::Total(over, body) if self.range_loops(over) & (1 << from.0) != 0 => {
                    let mut new = self.get_loop(over).clone();
                    if let LoopRange::Between(start, end) = &mut new.range {
                        (*start, *end) = (index(start), index(end));
                    }
                    let body = of(body);
                    match self.add_loop(new) {
                        Some(other) => {
                            let body = self.rename(body, over, other);
                            self.total(other, body)
                        }
                        None => id,
                    }
                }
                _ => self.rebuild(id, of),
            };
            known.insert(id, renamed);
        }
        known.get(&root).copied().unwrap_or(root)
    }

    /// A node with the index of a loop over a range replaced by another index; no sum in it may change in that loop.
    pub fn with_index(&mut self, root: Id, from: LoopId, to: &Index) -> Id {
        let index = |index: &Index| match &index.base {
            Base::Loop(id) if *id == from => Index {
                base: to.base.clone(),
                offset: index.offset + to.offset,
            },
            _ => index.clone(),
        };
        let mut known: HashMap<Id, Id> = HashMap::new();
        for id in self.below([root]) {
            if !self.depends(id).changes_in(from) {
                continue;
            }
            let replaced = match self.node(id).clone() {
                Node::Coordinate(coordinate) => {
                    let index = index(&coordinate.index);
                    self.coordinate(Coordinate {
                        index,
                        ..coordinate
                    })
                }
                Node::Parameter(parameter, indices) => {
                    let indices = indices.iter().map(index).collect();
                    self.parameter(parameter, indices)
                }
                _ => self.rebuild(id, |x| known.get(&x).copied().unwrap_or(x)),
            };
            known.insert(id, replaced);
        }
        known.get(&root).copied().unwrap_or(root)
    }

    /// Whether more loops were needed than allowed; a derivative is then wrong.
    pub fn overflowed(&self) -> bool {
        self.overflowed
    }

    /// The number of loops.
    pub fn count_loops(&self) -> usize {
        self.loops.len()
    }

    /// All nodes, in the order in which they appeared.
    pub fn ids(&self) -> impl Iterator<Item = Id> + use<> {
        (0..self.nodes.len() as u32).map(Id)
    }

    /// The number of nodes.
    pub fn size(&self) -> usize {
        self.nodes.len()
    }

    /// Rebuilds a node with other operands.
    pub fn rebuild(&mut self, id: Id, part: impl FnMut(Id) -> Id) -> Id {
        let new = self.make(self.node(id).clone(), part);
        if self.is_smooth(id) {
            self.smooth.insert(new);
        }
        new
    }

    /// Makes a copy of a node, from this graph or another one with the same loops, with other operands.
    pub fn make(&mut self, node: Node, mut part: impl FnMut(Id) -> Id) -> Id {
        match node {
            Node::Sum(terms, constant) => {
                let constant = (constant, self.integer(1));
                let terms: Vec<_> = terms
                    .into_iter()
                    .map(|(factor, x)| (factor, part(x)))
                    .collect();
                self.sum(terms.into_iter().chain([constant]))
            }
            Node::Product(factors) => {
                let factors: Vec<_> = factors
                    .into_iter()
                    .map(|(x, power)| (part(x), power))
                    .collect();
                self.product(Number::one(), factors)
            }
            Node::Elementary(function, x) => self.elementary(function, part(x)),
            Node::Atan2(y, x) => self.atan2(part(y), part(x)),
            Node::User(function, derivative, x) => self.user(function, derivative, part(x)),
            Node::Total(id, body) => self.total(id, part(body)),
            Node::Constant(_)
            | Node::Pi
            | Node::Time
            | Node::Parameter(..)
            | Node::Coordinate(_) => self.add(node),
        }
    }

    /// A graph with the same loops and no nodes.
    pub fn with_loops_of(other: &Self) -> Self {
        Graph {
            loops: other.loops.clone(),
            overflowed: other.overflowed,
            ..Graph::default()
        }
    }
}

/// An integer.
pub fn integer(value: i64) -> Number {
    Number::from_integer(value.into())
}

fn bits(index: &Index) -> u64 {
    index.loop_id().map_or(0, |id| 1 << id.0)
}

/// Whether a numeric power is short enough.
fn is_short(base: &Number, power: i64) -> bool {
    let bits = base.numer().bits() + base.denom().bits();
    bits.saturating_mul(power.unsigned_abs()) <= MAX_BITS
}

fn whole_power(base: &Number, power: i64) -> Number {
    let size = num_traits::pow(base.clone(), power.unsigned_abs() as usize);
    if power < 0 { size.recip() } else { size }
}

fn children(node: &Node) -> Vec<Id> {
    match node {
        Node::Sum(terms, _) => terms.iter().map(|&(_, x)| x).collect(),
        Node::Product(factors) => factors.iter().map(|&(x, _)| x).collect(),
        Node::Elementary(_, x) | Node::User(_, _, x) | Node::Total(_, x) => vec![*x],
        Node::Atan2(y, x) => vec![*y, *x],
        Node::Constant(_) | Node::Pi | Node::Time | Node::Parameter(..) | Node::Coordinate(_) => {
            Vec::new()
        }
    }
}

/// The function at a multiple of π, twice which is whole; `None` for other functions, and for the tangent where it is infinite.
fn quarter_turn(function: Elementary, turns: &Number) -> Option<i64> {
    // The remainder of division by a full turn, in quarters.
    let full = turns / integer(2);
    let quarters = ((&full - full.floor()) * integer(4)).to_i64()?;
    match (function, quarters) {
        (Elementary::Sin, quarters) => Some([0, 1, 0, -1][usize::try_from(quarters).ok()? % 4]),
        (Elementary::Cos, quarters) => Some([1, 0, -1, 0][usize::try_from(quarters).ok()? % 4]),
        (Elementary::Tan, 0 | 2) => Some(0),
        _ => None,
    }
}
