//! Derivatives.
//!
//! [`gradient`] goes through a formula from the result to the coordinates (reverse mode), *under* the sums: the derivative of a sum over an
//! index is a loop over that index, for any number of terms. [`directional`] goes from the coordinates to the result.

use std::collections::{BTreeMap, HashMap};

use num_traits::One;

use super::function::Elementary;
use super::graph::{Coordinate, Graph, Half, Id, LoopId, Node, Number, integer};

/// A part of a derivative: in these nested loops, the value is added to the derivative with respect to the coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Scatter {
    /// The loops, outermost first.
    pub loops: Vec<LoopId>,
    /// The coordinate.
    pub target: Coordinate,
    /// The value.
    pub value: Id,
}

/// The derivatives of a node with respect to all positions or all momenta, times a factor. The node is inside the given loops, and so are
/// the derivatives.
///
/// If a coordinate has several parts, they come in the order in which they are listed.
pub fn gradient(
    graph: &mut Graph,
    root: Id,
    loops: &[LoopId],
    factor: Number,
    half: Half,
) -> Vec<Scatter> {
    // The adjoints collected for each node, by the loops in which they are added.
    type Open = BTreeMap<Id, Vec<(Vec<LoopId>, Vec<(Number, Id)>)>>;
    let mut open = Open::new();
    let own = loops.len();
    let one = graph.integer(1);
    let send =
        |graph: &mut Graph, open: &mut Open, to: Id, mut loops: Vec<LoopId>, mut value: Id| {
            if !graph.depends(to).on(half) || graph.is_zero(value) {
                return;
            }
            // A loop on which the node does not depend becomes a sum.
            while let Some(place) = (own..loops.len()).rev().find(|&k| {
                let others = loops.iter().enumerate().filter(|&(other, _)| other != k);
                let needed = others.fold(0, |all, (_, id)| all | graph.range_loops(*id));
                !graph.depends(to).changes_in(loops[k]) && needed & (1 << loops[k].0) == 0
            }) {
                let id = loops.remove(place);
                value = graph.total(id, value);
            }
            let entries = open.entry(to).or_default();
            match entries.iter_mut().find(|(known, _)| *known == loops) {
                Some((_, values)) => values.push((Number::one(), value)),
                None => entries.push((loops, vec![(Number::one(), value)])),
            }
        };
    let start = graph.scale(factor, one);
    // Loops on which the root does not depend stay: they belong to the caller.
    if graph.depends(root).on(half) {
        open.entry(root)
            .or_default()
            .push((loops.to_vec(), vec![(Number::one(), start)]));
    }
    let mut scatters = Vec::new();
    while let Some((id, entries)) = open.pop_last() {
        for (loops, values) in entries {
            let adjoint = graph.sum(values);
            match graph.node(id).clone() {
                Node::Coordinate(target) => scatters.push(Scatter {
                    loops,
                    target,
                    value: adjoint,
                }),
                Node::Sum(terms, _) => {
                    for (factor, x) in terms {
                        let value = graph.scale(factor, adjoint);
                        send(graph, &mut open, x, loops.clone(), value);
                    }
                }
                Node::Product(factors) => {
                    for k in 0..factors.len() {
                        if graph.depends(factors[k].0).on(half) {
                            let (to, value) = by_factor(graph, &factors, k, |_| adjoint);
                            send(graph, &mut open, to, loops.clone(), value);
                        }
                    }
                }
                Node::Atan2(y, x) => {
                    for (k, to) in [y, x].into_iter().enumerate() {
                        let slope = by_argument(graph, y, x, k);
                        let value = graph.multiply(adjoint, slope);
                        send(graph, &mut open, to, loops.clone(), value);
                    }
                }
                Node::Elementary(_, x) | Node::User(_, _, x) => {
                    let slope = slope(graph, id);
                    let value = graph.multiply(adjoint, slope);
                    send(graph, &mut open, x, loops, value);
                }
                Node::Total(over, body) => {
                    let (over, body) = apart(graph, &loops, over, body);
                    let mut inner = loops;
                    inner.push(over);
                    send(graph, &mut open, body, inner, adjoint);
                }
                Node::Constant(_) | Node::Pi | Node::Time | Node::Parameter(..) => {}
            }
        }
    }
    // In the order of the coordinates in the formula.
    scatters.reverse();
    let mut known = HashMap::new();
    for scatter in &mut scatters {
        scatter.value = distinct(graph, scatter.value, &scatter.loops, &mut known);
    }
    scatters
}

/// A sum, with its index renamed to one that none of the loops uses.
fn apart(graph: &mut Graph, loops: &[LoopId], over: LoopId, body: Id) -> (LoopId, Id) {
    if !loops.contains(&over) {
        return (over, body);
    }
    let mut new = graph.get_loop(over).clone();
    let inner = graph.below([body]);
    let inner = inner.iter().filter_map(|&id| match graph.node(id) {
        Node::Total(id, _) => Some(*id),
        _ => None,
    });
    let depths = loops
        .iter()
        .copied()
        .chain(inner)
        .map(|id| graph.get_loop(id).depth);
    new.depth = depths.max().map_or(0, |deepest| deepest + 1);
    match graph.add_loop(new) {
        Some(other) => (other, graph.rename(body, over, other)),
        // More loops than are allowed: see `MAX_LOOPS`.
        None => (over, body),
    }
}

/// The node x in factor k of a product, its base or a function in the base, and `value(x)·∂(Π yᵉ)/∂x`.
fn by_factor(
    graph: &mut Graph,
    factors: &[(Id, Number)],
    k: usize,
    value: impl FnOnce(Id) -> Id,
) -> (Id, Id) {
    let (base, exponent) = &factors[k];
    let (x, factor, slope) = graph.slope_of_power(*base, exponent);
    let others = factors.iter().enumerate().filter(|&(other, _)| other != k);
    let mut parts: Vec<(Id, Number)> = others.map(|(_, part)| part.clone()).collect();
    parts.extend(slope);
    parts.push((value(x), Number::one()));
    (x, graph.product(factor, parts))
}

/// The derivative of `atan2(y, x)` with respect to its first or second argument.
fn by_argument(graph: &mut Graph, y: Id, x: Id, argument: usize) -> Id {
    let [x2, y2] = [x, y].map(|side| graph.power(side, integer(2)));
    let square = graph.sum([(Number::one(), x2), (Number::one(), y2)]);
    let (sign, other) = if argument == 0 { (1, x) } else { (-1, y) };
    graph.product(
        integer(sign),
        [(other, Number::one()), (square, integer(-1))],
    )
}

/// The derivative of a function of one variable.
fn slope(graph: &mut Graph, id: Id) -> Id {
    use Elementary::{Acos, Asin, Atan, Cos, Cosh, Exp, Ln, Sin, Sinh, Tan, Tanh};
    let (function, x) = match *graph.node(id) {
        Node::User(function, derivative, x) => return graph.user(function, derivative + 1, x),
        Node::Elementary(function, x) => (function, x),
        _ => return graph.integer(0),
    };
    let one_and = |graph: &mut Graph, sign: i64, of: Id| {
        let square = graph.power(of, integer(2));
        let one = graph.integer(1);
        graph.sum([(Number::one(), one), (integer(sign), square)])
    };
    match function {
        Exp => id,
        Ln => graph.power(x, integer(-1)),
        Sin => graph.elementary(Cos, x),
        Cos => {
            let sine = graph.elementary(Sin, x);
            graph.scale(integer(-1), sine)
        }
        Tan => one_and(graph, 1, id),
        Asin | Acos => {
            let rest = one_and(graph, -1, x);
            let sign = if function == Asin { 1 } else { -1 };
            graph.product(integer(sign), [(rest, Number::new((-1).into(), 2.into()))])
        }
        Atan => {
            let square = one_and(graph, 1, x);
            graph.power(square, integer(-1))
        }
        Sinh => graph.elementary(Cosh, x),
        Cosh => graph.elementary(Sinh, x),
        Tanh => one_and(graph, -1, id),
    }
}

/// The derivative of a node in a direction, given by the rate of each coordinate and of the time.
pub fn directional(
    graph: &mut Graph,
    root: Id,
    time: Option<Id>,
    mut direction: impl FnMut(&mut Graph, &Coordinate) -> Id,
) -> Id {
    let zero = graph.integer(0);
    let mut known: HashMap<Id, Id> = HashMap::new();
    for id in graph.below([root]) {
        let of = |x: &Id| known.get(x).copied().unwrap_or(zero);
        let speed = match graph.node(id).clone() {
            Node::Coordinate(coordinate) => direction(graph, &coordinate),
            Node::Time => time.unwrap_or(zero),
            Node::Constant(_) | Node::Pi | Node::Parameter(..) => zero,
            Node::Sum(terms, _) => {
                let terms: Vec<_> = terms
                    .iter()
                    .map(|(factor, x)| (factor.clone(), of(x)))
                    .collect();
                graph.sum(terms)
            }
            Node::Product(factors) => {
                let mut terms = Vec::new();
                for k in 0..factors.len() {
                    if !graph.is_zero(of(&factors[k].0)) {
                        let (_, term) = by_factor(graph, &factors, k, |x| of(&x));
                        terms.push((Number::one(), term));
                    }
                }
                graph.sum(terms)
            }
            Node::Atan2(y, x) => {
                let parts = [(0, of(&y)), (1, of(&x))].map(|(argument, speed)| {
                    let slope = by_argument(graph, y, x, argument);
                    (Number::one(), graph.multiply(slope, speed))
                });
                graph.sum(parts)
            }
            Node::Elementary(_, x) | Node::User(_, _, x) => {
                let speed = of(&x);
                let slope = slope(graph, id);
                graph.multiply(slope, speed)
            }
            Node::Total(over, body) => {
                let speed = of(&body);
                graph.total(over, speed)
            }
        };
        known.insert(id, speed);
    }
    known.get(&root).copied().unwrap_or(zero)
}

/// A value in some loops; sums in it whose index is that of a loop around them get another index.
fn distinct(
    graph: &mut Graph,
    root: Id,
    around: &[LoopId],
    known: &mut HashMap<(Id, Vec<LoopId>), Id>,
) -> Id {
    let key = (root, around.to_vec());
    if let Some(&id) = known.get(&key) {
        return id;
    }
    // The nodes below the value, down to its outermost sums.
    let (mut order, mut open) = (std::collections::BTreeSet::new(), vec![root]);
    while let Some(id) = open.pop() {
        if order.insert(id) && !matches!(graph.node(id), Node::Total(..)) {
            open.extend(graph.children(id));
        }
    }
    let mut new: HashMap<Id, Id> = HashMap::new();
    for id in order {
        let made = match *graph.node(id) {
            Node::Total(over, body) => {
                // The value is computed in the outermost loops that it needs.
                let felt = around
                    .iter()
                    .rposition(|&id2| graph.depends(id).changes_in(id2));
                let mut around = around[..felt.map_or(0, |k| k + 1)].to_vec();
                let (over, body) = apart(graph, &around, over, body);
                around.push(over);
                let body = distinct(graph, body, &around, known);
                graph.total(over, body)
            }
            _ => graph.rebuild(id, |x| new.get(&x).copied().unwrap_or(x)),
        };
        new.insert(id, made);
    }
    known.insert(key, new[&root]);
    new[&root]
}
