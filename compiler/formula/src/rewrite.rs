//! Formulas derived from other formulas: copied, at rest, and with sums written out.

use std::collections::HashMap;

use num_traits::{One, Signed, Zero};

use super::graph::{Base, Coordinate, Graph, Id, Index, LoopId, LoopRange, Node, Number, integer};

/// Copies nodes into another graph with the same loops. Nodes copied first come first there.
pub(super) struct Copier {
    from: Graph,
    /// The copies of nodes.
    pub known: HashMap<Id, Id>,
}

impl Copier {
    /// A copier from a graph.
    pub fn new(from: Graph) -> Self {
        Copier {
            from,
            known: HashMap::new(),
        }
    }

    /// Copies the nodes with which every formula begins, named coordinates and numeric parameters, so that they come first again.
    pub fn copy_names(&mut self, to: &mut Graph) {
        let all = self.from.ids();
        let names = all.take_while(|&id| match self.from.node(id) {
            Node::Coordinate(_) => true,
            Node::Parameter(_, indices) => indices.is_empty(),
            _ => false,
        });
        for id in names.collect::<Vec<_>>() {
            self.copy(id, to);
        }
    }

    /// The copy of a node.
    pub fn copy(&mut self, root: Id, to: &mut Graph) -> Id {
        for id in self.from.below([root]) {
            if !self.known.contains_key(&id) {
                let copy = to.make(self.from.node(id).clone(), |part| self.known[&part]);
                self.known.insert(id, copy);
            }
        }
        self.known[&root]
    }
}

/// A formula with all velocities set to zero.
pub(super) fn at_rest(graph: &mut Graph, root: Id) -> Id {
    let zero = graph.integer(0);
    let mut known: HashMap<Id, Id> = HashMap::new();
    for id in graph.below([root]) {
        if !graph.depends(id).v {
            continue;
        }
        let rest = match graph.node(id) {
            Node::Coordinate(_) => zero,
            _ => graph.rebuild(id, |part| known.get(&part).copied().unwrap_or(part)),
        };
        known.insert(id, rest);
    }
    known.get(&root).copied().unwrap_or(root)
}

/// The terms of a formula or, with the sign −1, of its negative. Sums with another factor, and nodes in `kept`, stay one term.
pub(super) fn flat(graph: &mut Graph, sign: i64, id: Id, kept: &[Id]) -> Vec<(Number, Id)> {
    let mut open = vec![(integer(sign), id)];
    let mut terms = Vec::new();
    while let Some((factor, id)) = open.pop() {
        match graph.node(id).clone() {
            Node::Sum(parts, constant) if factor.abs().is_one() && !kept.contains(&id) => {
                if !constant.is_zero() {
                    terms.push((&factor * constant, graph.integer(1)));
                }
                open.extend(
                    parts
                        .into_iter()
                        .rev()
                        .map(|(inner, x)| (&factor * inner, x)),
                );
            }
            _ => terms.push((factor, id)),
        }
    }
    terms
}

/// The greatest depth of formulas whose sums are written out.
const MAX_DEPTH: usize = 500;
/// The largest number of nodes of a graph in which sums are written out.
const MAX_NODES: usize = 200_000;

/// Writes out sums over velocities.
#[derive(Default)]
pub(super) struct Unroll {
    /// The current indices of the surrounding loops.
    indices: Vec<(LoopId, i64)>,
    known: HashMap<(Id, Vec<(LoopId, i64)>), Id>,
    depth: usize,
}

impl Unroll {
    /// The formula with its sums over velocities written out; `None` if a length is not known, or the formula is too large.
    pub fn run(&mut self, graph: &mut Graph, id: Id) -> Option<Id> {
        let depends = graph.depends(id);
        let around = self.indices.iter().copied();
        let around: Vec<_> = around
            .filter(|(over, _)| depends.changes_in(*over))
            .collect();
        if around.is_empty() && !depends.v {
            return Some(id);
        }
        let key = (id, around);
        if let Some(&known) = self.known.get(&key) {
            return Some(known);
        }
        if self.depth >= MAX_DEPTH || graph.size() > MAX_NODES {
            return None;
        }
        self.depth += 1;
        let written = match graph.node(id).clone() {
            Node::Coordinate(coordinate) => {
                let index = self.index(&coordinate.index);
                graph.coordinate(Coordinate {
                    index,
                    ..coordinate
                })
            }
            Node::Parameter(parameter, indices) => {
                let indices = indices.iter().map(|index| self.index(index)).collect();
                graph.parameter(parameter, indices)
            }
            Node::Total(over, body) => {
                let LoopRange::Between(start, end) = graph.get_loop(over).range.clone() else {
                    return None;
                };
                let (start, end) = (self.index(&start), self.index(&end));
                if start.base != Base::Start || end.base != Base::Start {
                    return None;
                }
                let mut terms = Vec::new();
                for k in start.offset..end.offset {
                    self.indices.push((over, k));
                    let term = self.run(graph, body);
                    self.indices.pop();
                    terms.push((Number::one(), term?));
                }
                graph.sum(terms)
            }
            node => {
                let mut parts = HashMap::new();
                for child in graph.children(id) {
                    parts.insert(child, self.run(graph, child)?);
                }
                graph.make(node, |part| parts[&part])
            }
        };
        self.depth -= 1;
        self.known.insert(key, written);
        Some(written)
    }

    fn index(&self, index: &Index) -> Index {
        let Base::Loop(over) = index.base else {
            return index.clone();
        };
        // The innermost loop, if a sum is nested in one with the same index.
        match self.indices.iter().rev().find(|(known, _)| *known == over) {
            Some((_, k)) => Index::number(k + index.offset),
            None => index.clone(),
        }
    }
}
