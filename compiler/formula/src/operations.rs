//! A formula as binary operations, in the order in which they are computed.
//!
//! Terms and factors are taken in the order of the graph. Factors that depend only on parameters come first and are computed in double
//! precision; divisors come last, in one quotient. Integer powers are products, by repeated squaring; half-integer powers contain
//! square roots.

use std::collections::{HashMap, HashSet};

use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::function::Elementary;
use crate::graph::{Coordinate, Dependence, Graph, Id, Index, LoopId, Node, Number};

/// The index of an operation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Op(pub usize);

/// The kinds of operations.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Operation {
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
    /// `−a`
    Negative(Op),
    /// `a + b`
    Add(Op, Op),
    /// `a − b`
    Subtract(Op, Op),
    /// `a b`
    Multiply(Op, Op),
    /// `1/a`
    Reciprocal(Op),
    /// `√a`
    Root(Op),
    /// `|a|`
    Absolute(Op),
    /// `a`, or 0 if b is 0.
    OrZero(Op, Op),
    /// An elementary function.
    Elementary(Elementary, Op),
    /// The angle of the point (second, first).
    Atan2(Op, Op),
    /// A function of the user, or one of its derivatives.
    User(usize, usize, Op),
    /// A sum over a loop.
    Total(LoopId, Op),
}

impl Operation {
    /// The operands.
    pub fn operands(&self) -> Vec<Op> {
        match *self {
            Operation::Negative(a)
            | Operation::Reciprocal(a)
            | Operation::Root(a)
            | Operation::Absolute(a)
            | Operation::Elementary(_, a)
            | Operation::User(_, _, a)
            | Operation::Total(_, a) => vec![a],
            Operation::Add(a, b)
            | Operation::Subtract(a, b)
            | Operation::Multiply(a, b)
            | Operation::OrZero(a, b)
            | Operation::Atan2(a, b) => vec![a, b],
            Operation::Constant(_)
            | Operation::Pi
            | Operation::Time
            | Operation::Parameter(..)
            | Operation::Coordinate(_) => Vec::new(),
        }
    }

    /// Whether the value is read where it is needed, and not stored.
    pub fn is_leaf(&self) -> bool {
        self.operands().is_empty()
    }
}

/// The operations of some formulas, without duplicates.
pub struct Operations<'a> {
    graph: &'a Graph,
    list: Vec<Operation>,
    depends: Vec<Dependence>,
    numbers: HashMap<Operation, Op>,
    /// The operation of each node.
    known: HashMap<Id, Op>,
    /// Nodes that are divisors more than once.
    divisors: HashMap<Id, usize>,
    /// Reciprocals used once, as the second factor of a product in the same loops: the product is written as a quotient.
    quotients: HashSet<Op>,
}

impl<'a> Operations<'a> {
    /// The operations for some nodes of a graph.
    pub fn new(graph: &'a Graph, roots: &[Id]) -> Self {
        let mut divisors = HashMap::new();
        let order = graph.below(roots.iter().copied());
        for &id in &order {
            if let Node::Product(factors) = graph.node(id) {
                for (x, exponent) in factors {
                    if exponent.is_negative() && exponent.is_integer() {
                        *divisors.entry(*x).or_insert(0) += 1;
                    }
                }
            }
        }
        let mut operations = Operations {
            graph,
            list: Vec::new(),
            depends: Vec::new(),
            numbers: HashMap::new(),
            known: HashMap::new(),
            divisors,
            quotients: HashSet::new(),
        };
        for id in order {
            let op = operations.lower(id);
            operations.known.insert(id, op);
        }
        operations.quotients = operations.find_quotients(roots);
        operations
    }

    fn find_quotients(&self, roots: &[Id]) -> HashSet<Op> {
        let mut uses: HashMap<Op, usize> = HashMap::new();
        let mut open: Vec<Op> = roots.iter().map(|&root| self.of(root)).collect();
        let mut reached = Vec::new();
        while let Some(op) = open.pop() {
            let count = uses.entry(op).or_insert(0);
            *count += 1;
            if *count == 1 {
                reached.push(op);
                open.extend(self.get(op).operands());
            }
        }
        let once = reached.into_iter().filter_map(|op| match *self.get(op) {
            Operation::Multiply(_, b) => {
                let is_reciprocal = matches!(self.get(b), Operation::Reciprocal(_));
                let same_loops = self.depends(b).loops == self.depends(op).loops;
                (is_reciprocal && same_loops && uses[&b] == 1).then_some(b)
            }
            _ => None,
        });
        once.collect()
    }

    /// Whether a reciprocal is only the division in the single product that contains it, not a separate operation.
    ///
    /// This depends on all roots, not on the function that is written: two functions with the same operations round alike.
    pub fn is_division(&self, op: Op) -> bool {
        self.quotients.contains(&op)
    }

    /// The operands as they are written: of a quotient its divisor.
    pub fn written_operands(&self, op: Op) -> Vec<Op> {
        match *self.get(op) {
            Operation::Multiply(a, b) => match *self.get(b) {
                Operation::Reciprocal(divisor) if self.is_division(b) => vec![a, divisor],
                _ => vec![a, b],
            },
            ref operation => operation.operands(),
        }
    }

    /// The operation of a node.
    pub fn of(&self, id: Id) -> Op {
        self.known[&id]
    }

    /// An operation.
    pub fn get(&self, op: Op) -> &Operation {
        &self.list[op.0]
    }

    /// All operations: operands come before the operations that use them.
    pub fn all(&self) -> impl Iterator<Item = Op> + use<> {
        (0..self.list.len()).map(Op)
    }

    /// The dependences of a result.
    pub fn depends(&self, op: Op) -> Dependence {
        self.depends[op.0]
    }

    fn add(&mut self, operation: Operation) -> Op {
        // −(a − b) = b − a
        let operation = match operation {
            Operation::Negative(a) => match *self.get(a) {
                Operation::Negative(a) => return a,
                Operation::Subtract(a, b) => Operation::Subtract(b, a),
                _ => operation,
            },
            operation => operation,
        };
        if let Some(&op) = self.numbers.get(&operation) {
            return op;
        }
        let mut depends = Dependence::default();
        for operand in operation.operands() {
            depends.join(self.depends(operand));
        }
        if let Operation::Total(id, _) = operation {
            depends.loops &= !(1 << id.0);
            depends.loops |= self.graph.range_loops(id);
        }
        self.push(operation, depends)
    }

    fn push(&mut self, operation: Operation, depends: Dependence) -> Op {
        let op = Op(self.list.len());
        self.list.push(operation.clone());
        self.depends.push(depends);
        self.numbers.insert(operation, op);
        op
    }

    fn constant(&mut self, value: &Number) -> Op {
        self.add(Operation::Constant(value.clone()))
    }

    fn lower(&mut self, id: Id) -> Op {
        let graph = self.graph;
        let leaf = |operation: Operation| (operation, graph.depends(id));
        let (operation, depends) = match graph.node(id) {
            Node::Constant(value) if value.is_negative() => {
                let size = self.constant(&-value);
                return self.add(Operation::Negative(size));
            }
            Node::Constant(value) => return self.constant(value),
            Node::Pi => leaf(Operation::Pi),
            Node::Time => leaf(Operation::Time),
            Node::Parameter(parameter, indices) => {
                leaf(Operation::Parameter(*parameter, indices.clone()))
            }
            Node::Coordinate(coordinate) => leaf(Operation::Coordinate(coordinate.clone())),
            Node::Sum(terms, constant) => return self.sum(terms, constant),
            Node::Product(factors) => return self.product(&Number::one(), factors),
            Node::Elementary(function, x) => {
                return self.add(Operation::Elementary(*function, self.of(*x)));
            }
            Node::Atan2(y, x) => return self.add(Operation::Atan2(self.of(*y), self.of(*x))),
            Node::User(function, derivative, x) => {
                return self.add(Operation::User(*function, *derivative, self.of(*x)));
            }
            Node::Total(over, body) => return self.add(Operation::Total(*over, self.of(*body))),
        };
        match self.numbers.get(&operation) {
            Some(&op) => op,
            None => self.push(operation, depends),
        }
    }

    /// `Σ c x + constant`: the part that depends only on parameters is one number.
    fn sum(&mut self, terms: &[(Number, Id)], constant: &Number) -> Op {
        let graph = self.graph;
        let (fixed, free): (Vec<_>, Vec<_>) = terms
            .iter()
            .partition(|(_, x)| graph.depends(*x).is_fixed());
        let mut list: Vec<(bool, Op)> = Vec::new();
        for (factor, x) in free {
            list.push((factor.is_negative(), self.scaled(&factor.abs(), *x)));
        }
        let mut numbers: Vec<(bool, Op)> = Vec::new();
        for (factor, x) in fixed {
            numbers.push((factor.is_negative(), self.scaled(&factor.abs(), *x)));
        }
        if !constant.is_zero() {
            numbers.push((constant.is_negative(), self.constant(&constant.abs())));
        }
        // The numeric terms together, with their common sign outside.
        if !numbers.is_empty() {
            let negative = numbers.iter().all(|(minus, _)| *minus);
            if negative {
                numbers.iter_mut().for_each(|term| term.0 = false);
            }
            let number = self.chain(numbers);
            list.push((negative, number));
        }
        self.chain(list)
    }

    /// The sum of terms from left to right, `true` for those that are subtracted; the first added term begins.
    fn chain(&mut self, mut terms: Vec<(bool, Op)>) -> Op {
        let start = terms.iter().position(|(minus, _)| !minus).unwrap_or(0);
        let (minus, first) = terms.remove(start);
        let mut sum = if minus {
            self.add(Operation::Negative(first))
        } else {
            first
        };
        for (minus, term) in terms {
            sum = self.add(match minus {
                true => Operation::Subtract(sum, term),
                false => Operation::Add(sum, term),
            });
        }
        sum
    }

    /// `factor·x` for a positive factor.
    fn scaled(&mut self, factor: &Number, x: Id) -> Op {
        if factor.is_one() {
            return self.of(x);
        }
        match self.graph.node(x) {
            Node::Product(factors) => self.product(factor, factors),
            _ => self.product(factor, &[(x, Number::one())]),
        }
    }

    /// `factor·Π xᵉ`
    fn product(&mut self, factor: &Number, factors: &[(Id, Number)]) -> Op {
        let graph = self.graph;
        // Factors that depend only on parameters, and the others; in numerator and denominator.
        let mut parts: [[Vec<Op>; 2]; 2] = Default::default();
        if !factor.is_one() {
            let number = self.constant(factor);
            parts[0][0].push(number);
        }
        for (x, exponent) in factors {
            let fixed = usize::from(!graph.depends(*x).is_fixed());
            let often = self.divisors.get(x).is_some_and(|&times| times > 1);
            let base = self.of(*x);
            if exponent.is_negative() && exponent.is_integer() && often {
                let reciprocal = self.add(Operation::Reciprocal(base));
                let power = self.power(reciprocal, &-exponent, *x);
                parts[fixed][0].push(power);
            } else if !exponent.is_integer() && graph.is_smooth(*x) {
                let power = self.smooth_power(base, exponent, *x);
                parts[fixed][0].push(power);
            } else {
                let power = self.power(base, &exponent.abs(), *x);
                parts[fixed][usize::from(exponent.is_negative())].push(power);
            }
        }
        let [fixed, [above, below]] = parts;
        let number = match fixed {
            [above, below] if above.is_empty() && below.is_empty() => None,
            [above, below] => Some(self.quotient(above, below)),
        };
        if above.is_empty() && below.is_empty() {
            return number.unwrap_or_else(|| self.constant(&Number::one()));
        }
        self.quotient(number.into_iter().chain(above).collect(), below)
    }

    fn quotient(&mut self, above: Vec<Op>, below: Vec<Op>) -> Op {
        let multiply = |this: &mut Self, factors: Vec<Op>| {
            factors
                .into_iter()
                .reduce(|a, b| this.add(Operation::Multiply(a, b)))
        };
        let (above, below) = (multiply(self, above), multiply(self, below));
        let reciprocal = below.map(|below| self.add(Operation::Reciprocal(below)));
        match (above, reciprocal) {
            (Some(above), Some(reciprocal)) => self.add(Operation::Multiply(above, reciprocal)),
            (Some(op), None) | (None, Some(op)) => op,
            (None, None) => self.constant(&Number::one()),
        }
    }

    /// `baseᵉ` for a positive exponent; `node` is the base.
    fn power(&mut self, base: Op, exponent: &Number, node: Id) -> Op {
        let whole = exponent.floor();
        let rest = exponent - &whole;
        let power = whole
            .to_u32()
            .filter(|&n| n > 0)
            .map(|n| self.whole_power(base, n));
        if rest.is_zero() {
            return power.unwrap_or_else(|| self.constant(&Number::one()));
        }
        let part = match *rest.denom() == 2.into() {
            true => match self.square_root_of_square(node) {
                Some(op) => self.add(Operation::Absolute(op)),
                None => self.add(Operation::Root(base)),
            },
            false => {
                let logarithm = self.add(Operation::Elementary(Elementary::Ln, base));
                let rest = self.constant(&rest);
                let product = self.add(Operation::Multiply(rest, logarithm));
                self.add(Operation::Elementary(Elementary::Exp, product))
            }
        };
        match power {
            Some(whole) => self.add(Operation::Multiply(whole, part)),
            None => part,
        }
    }

    /// `baseᵉ` for an exponent that is not whole, at whose zeros the formulas are [smooth](Graph::is_smooth): 0 there, even if the exponent
    /// is negative, as of the last factor of `x·x/|x|`. The formulas have the same derivatives there whatever the power is multiplied by.
    fn smooth_power(&mut self, base: Op, exponent: &Number, node: Id) -> Op {
        let size = match *exponent.denom() == 2.into() {
            true => self.square_root_of_square(node),
            false => None,
        };
        let (base, power) = match size {
            // |x| has a derivative on either side.
            Some(_) if exponent.is_positive() => return self.power(base, exponent, node),
            Some(x) => {
                let size = self.add(Operation::Absolute(x));
                let times = exponent.numer().magnitude().to_u32().unwrap_or(1);
                (size, self.whole_power(size, times))
            }
            None => (base, self.power(base, &exponent.abs(), node)),
        };
        let power = match exponent.is_negative() {
            true => self.add(Operation::Reciprocal(power)),
            false => power,
        };
        self.add(Operation::OrZero(power, base))
    }

    fn square_root_of_square(&self, node: Id) -> Option<Op> {
        let Node::Product(factors) = self.graph.node(node) else {
            return None;
        };
        match factors.as_slice() {
            [(x, exponent)] if *exponent == Number::from_integer(2.into()) => Some(self.of(*x)),
            _ => None,
        }
    }

    fn whole_power(&mut self, base: Op, exponent: u32) -> Op {
        let (mut rest, mut square, mut power) = (exponent, base, None);
        while rest > 0 {
            if rest % 2 == 1 {
                power = Some(match power {
                    None => square,
                    Some(power) => self.add(Operation::Multiply(power, square)),
                });
            }
            rest /= 2;
            if rest > 0 {
                square = self.add(Operation::Multiply(square, square));
            }
        }
        power.unwrap_or(base)
    }
}
