//! Values of formulas at a state.

use std::collections::HashMap;

use super::derivative::Scatter;
use super::function::Elementary;
use super::graph::{Base, Coordinate, Graph, Half, Id, Index, LoopId, LoopRange, Node, Number};

/// Numbers in which formulas can be evaluated.
pub trait Real: Clone {
    /// A rational number.
    fn number(value: &Number) -> Self;
    /// π
    fn pi() -> Self;
    /// The sum.
    fn add(&self, other: &Self) -> Self;
    /// The product.
    fn multiply(&self, other: &Self) -> Self;
    /// A power.
    fn power(&self, exponent: &Number) -> Self;
    /// An elementary function.
    fn elementary(&self, function: Elementary) -> Self;
    /// The angle of the point `(x, self)`.
    fn atan2(&self, x: &Self) -> Self;
}

/// The point at which a formula is evaluated.
#[derive(Debug, Clone)]
pub struct Point<R> {
    /// The time.
    pub time: R,
    /// Positions, and momenta or velocities, each with its components.
    pub halves: [Vec<Vec<R>>; 2],
    /// The parameters, by rows.
    pub parameters: Vec<Vec<Vec<R>>>,
    /// The pairs of parameters that are lists.
    pub pairs: Vec<Vec<[usize; 2]>>,
}

/// The largest number of nodes that are computed.
const MAX_NODES: usize = 3_000_000;

/// The values of nodes at a point.
pub struct Evaluator<'a, R> {
    graph: &'a Graph,
    point: &'a Point<R>,
    values: HashMap<Id, R>,
    /// The indices of the running loops; for a list, the index of the pair.
    indices: HashMap<LoopId, usize>,
    /// How many more nodes may be computed.
    budget: usize,
}

impl<'a, R: Real> Evaluator<'a, R> {
    /// An evaluator without values.
    pub fn new(graph: &'a Graph, point: &'a Point<R>) -> Self {
        Evaluator {
            graph,
            point,
            values: HashMap::new(),
            indices: HashMap::new(),
            budget: MAX_NODES,
        }
    }

    /// Fixes the index of a loop around the nodes.
    pub fn fix(&mut self, over: LoopId, index: usize) {
        self.indices.insert(over, index);
        self.forget(over);
    }

    /// The value of a node; `None` if a user's function is needed, or an entry does not exist.
    pub fn value(&mut self, id: Id) -> Option<R> {
        let order = self.graph.below([id]);
        self.run(&order);
        self.values.get(&id).cloned()
    }

    /// The derivative with these parts, with respect to all coordinates and their components.
    pub fn sum(&mut self, parts: &[Scatter]) -> Option<Vec<Vec<R>>> {
        let zero = R::number(&super::graph::integer(0));
        let shape = &self.point.halves[0];
        let mut sum: Vec<Vec<R>> = shape
            .iter()
            .map(|all| vec![zero.clone(); all.len()])
            .collect();
        for part in parts {
            self.scatter(part, 0, &mut |this, value| {
                let index = this.index(&part.target.index)?;
                let entry = sum.get_mut(index)?.get_mut(part.target.component)?;
                *entry = entry.add(&value);
                Some(())
            })?;
        }
        Some(sum)
    }

    /// The matrix of second derivatives with these parts, each preceded by the coordinate of its row; the components of a body are
    /// adjacent.
    pub fn matrix(&mut self, parts: &[(Coordinate, Scatter)]) -> Option<Vec<Vec<R>>> {
        let components = self.point.halves[0].first().map_or(1, Vec::len);
        let size = self.point.halves[0].len() * components;
        let zero = R::number(&super::graph::integer(0));
        let mut matrix = vec![vec![zero; size]; size];
        for (row, part) in parts {
            self.scatter(part, 0, &mut |this, value| {
                let place = |target: &Coordinate| {
                    Some(this.index(&target.index)? * components + target.component)
                };
                let entry = matrix.get_mut(place(row)?)?.get_mut(place(&part.target)?)?;
                *entry = entry.add(&value);
                Some(())
            })?;
        }
        Some(matrix)
    }

    /// Computes a part of a derivative for all indices of its loops.
    fn scatter(
        &mut self,
        part: &Scatter,
        depth: usize,
        add: &mut dyn FnMut(&Self, R) -> Option<()>,
    ) -> Option<()> {
        let Some(&over) = part.loops.get(depth) else {
            let value = self.value(part.value)?;
            return add(self, value);
        };
        for index in self.range(over)? {
            self.indices.insert(over, index);
            self.forget(over);
            self.scatter(part, depth + 1, add)?;
        }
        self.indices.remove(&over);
        self.forget(over);
        Some(())
    }

    fn forget(&mut self, over: LoopId) {
        let graph = self.graph;
        self.values
            .retain(|&id, _| !graph.depends(id).changes_in(over));
    }

    fn range(&self, over: LoopId) -> Option<std::ops::Range<usize>> {
        match &self.graph.get_loop(over).range {
            LoopRange::Between(start, end) => Some(self.index(start)?..self.index(end)?),
            LoopRange::List(parameter) => Some(0..self.point.pairs[*parameter].len()),
        }
    }

    fn index(&self, index: &Index) -> Option<usize> {
        let base = match &index.base {
            Base::Start => 0,
            Base::End(_) => self.point.halves[0].len(),
            Base::Loop(id) => *self.indices.get(id)?,
            Base::Pair(id, slot) => {
                let number = *self.indices.get(id)?;
                let LoopRange::List(parameter) = self.graph.get_loop(*id).range else {
                    return None;
                };
                let pair = self.point.pairs[parameter].get(number)?;
                match slot {
                    0 | 1 => pair[*slot],
                    _ => number,
                }
            }
        };
        usize::try_from(i64::try_from(base).ok()? + index.offset).ok()
    }

    /// Evaluates nodes; operands come before the nodes that use them.
    fn run(&mut self, order: &[Id]) {
        for &id in order {
            if !self.values.contains_key(&id)
                && let Some(value) = self.compute(id)
            {
                self.values.insert(id, value);
            }
        }
    }

    fn compute(&mut self, id: Id) -> Option<R> {
        self.budget = self.budget.checked_sub(1)?;
        let of = |this: &Self, id: &Id| this.values.get(id).cloned();
        Some(match self.graph.node(id) {
            Node::Constant(value) => R::number(value),
            Node::Pi => R::pi(),
            Node::Time => self.point.time.clone(),
            Node::Parameter(parameter, indices) => {
                let all = &self.point.parameters[*parameter];
                let mut indices = indices.iter().map(|index| self.index(index));
                let (row, column) = (
                    indices.next().unwrap_or(Some(0))?,
                    indices.next().unwrap_or(Some(0))?,
                );
                all.get(row)?.get(column)?.clone()
            }
            Node::Coordinate(coordinate) => {
                let half = &self.point.halves[usize::from(coordinate.half != Half::Q)];
                half.get(self.index(&coordinate.index)?)?
                    .get(coordinate.component)?
                    .clone()
            }
            Node::Sum(terms, constant) => {
                let mut sum = R::number(constant);
                for (factor, x) in terms {
                    sum = sum.add(&R::number(factor).multiply(&of(self, x)?));
                }
                sum
            }
            Node::Product(factors) => {
                let mut product = R::number(&super::graph::integer(1));
                for (x, exponent) in factors {
                    product = product.multiply(&of(self, x)?.power(exponent));
                }
                product
            }
            Node::Elementary(function, x) => of(self, x)?.elementary(*function),
            Node::Atan2(y, x) => of(self, y)?.atan2(&of(self, x)?),
            // Any function serves: sin(x + c).
            Node::User(function, derivative, x) => {
                let shift = R::number(&super::graph::integer(*function as i64 + 1));
                let angle = of(self, x)?.add(&shift);
                match derivative % 4 {
                    0 => angle.elementary(Elementary::Sin),
                    1 => angle.elementary(Elementary::Cos),
                    _ => {
                        let minus = R::number(&super::graph::integer(-1));
                        angle.elementary(Elementary::Sin).multiply(&minus)
                    }
                }
            }
            Node::Total(over, body) => {
                // In loops that are not running it is evaluated later.
                if self.graph.depends(id).loops & !self.bound() != 0 {
                    return None;
                }
                let (over, body) = (*over, *body);
                let outer = self.indices.get(&over).copied();
                let order = self.graph.below([body]);
                let graph = self.graph;
                let changes = |id: &Id| graph.depends(*id).changes_in(over);
                let kept: Vec<(Id, R)> = match outer {
                    Some(_) => {
                        let values = self.values.iter().filter(|(id, _)| changes(id));
                        values.map(|(id, value)| (*id, value.clone())).collect()
                    }
                    None => Vec::new(),
                };
                let mut sum = R::number(&super::graph::integer(0));
                for index in self.range(over)? {
                    self.indices.insert(over, index);
                    self.forget(over);
                    self.run(&order);
                    sum = sum.add(&of(self, &body)?);
                }
                match outer {
                    Some(index) => self.indices.insert(over, index),
                    None => self.indices.remove(&over),
                };
                self.forget(over);
                self.values.extend(kept);
                sum
            }
        })
    }

    fn bound(&self) -> u64 {
        self.indices.keys().fold(0, |all, id| all | 1 << id.0)
    }
}

impl Real for f64 {
    fn number(value: &Number) -> Self {
        symplectic_exact::rounding::to_f64(value)
    }

    fn pi() -> Self {
        std::f64::consts::PI
    }

    fn add(&self, other: &Self) -> Self {
        self + other
    }

    fn multiply(&self, other: &Self) -> Self {
        self * other
    }

    fn power(&self, exponent: &Number) -> Self {
        self.powf(symplectic_exact::rounding::to_f64(exponent))
    }

    fn elementary(&self, function: Elementary) -> Self {
        match function {
            Elementary::Exp => self.exp(),
            Elementary::Ln => self.ln(),
            Elementary::Sin => self.sin(),
            Elementary::Cos => self.cos(),
            Elementary::Tan => self.tan(),
            Elementary::Asin => self.asin(),
            Elementary::Acos => self.acos(),
            Elementary::Atan => self.atan(),
            Elementary::Sinh => self.sinh(),
            Elementary::Cosh => self.cosh(),
            Elementary::Tanh => self.tanh(),
        }
    }

    fn atan2(&self, x: &Self) -> Self {
        f64::atan2(*self, *x)
    }
}
