//! Coinciding stages, the dependencies between stages, and the order of computation.

mod phases;
mod splitting;
mod unused;

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};

pub use phases::{Evaluations, Phases};

use crate::algebra::{Number, StageAlgebra, group_by};
use crate::arithmetic::roots::compare;
use crate::coefficients::Coefficients;
use crate::exact::{Exact, over_algebra};
use crate::partitioned::Partitioned;

/// What the derivatives of a Hamiltonian depend on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Class {
    /// Velocity and force depend on position and momentum.
    General,
    /// `H = T(p) + U(q)`: the velocity depends on the momentum only, the force on the position only.
    Separable,
}

/// A value or an evaluation in a step; the index counts within its kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Node {
    /// A position stage `Q_i`.
    Position(usize),
    /// A force `−∂H/∂q`.
    Force(usize),
    /// A momentum stage `P_i`.
    Momentum(usize),
    /// A velocity `∂H/∂p`.
    Velocity(usize),
}

/// A distinct stage value: `Q = q0 + h Σ coefficient · velocity`, or `P = p0 + h Σ coefficient · force`.
#[derive(Debug)]
pub struct StageValue<'a> {
    /// The stages of the tableau that have this value.
    pub stages: Vec<usize>,
    /// One coefficient for each evaluation.
    pub coefficients: Vec<Number<'a>>,
    /// Whether the value is the result of the step: its coefficients are the weights.
    pub is_end: bool,
    /// For each evaluation, whether it has been applied when the value is reached. `Some` only if every coefficient is either the
    /// weight of its evaluation or zero, as in a splitting.
    pub applied: Option<Vec<bool>>,
}

impl StageValue<'_> {
    /// Whether the value is the start of the step: all its coefficients are zero.
    pub fn is_start(&self) -> bool {
        self.coefficients.iter().all(Number::is_zero)
    }
}

/// A distinct evaluation of a velocity or a force.
#[derive(Debug)]
pub struct Evaluation<'a> {
    /// The index of the position stage at which it is evaluated; `None` if it does not depend on one.
    pub position: Option<usize>,
    /// The index of the momentum stage at which it is evaluated; `None` if it does not depend on one.
    pub momentum: Option<usize>,
    /// Its time as a fraction of the step: `c` for a force, `c̃` for a velocity.
    pub time: Number<'a>,
    /// Its weight in the result of the step.
    pub weight: Number<'a>,
}

/// The distinct values and evaluations of a step for one class of Hamiltonians.
///
/// Stages with equal rows have equal values, and evaluations at equal values are equal; their
/// coefficients are added, exactly.
#[derive(Debug)]
pub struct StepGraph<'a> {
    /// The class of Hamiltonians.
    pub class: Class,
    /// The distinct position stages.
    pub positions: Vec<StageValue<'a>>,
    /// The distinct momentum stages.
    pub momenta: Vec<StageValue<'a>>,
    /// The distinct velocities.
    pub velocities: Vec<Evaluation<'a>>,
    /// The distinct forces.
    pub forces: Vec<Evaluation<'a>>,
}

/// An order of computation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Schedule {
    /// Nodes that can be computed in order from the start of the step.
    pub before: Vec<Node>,
    /// Nodes that depend on themselves, possibly through others.
    pub coupled: Vec<Node>,
    /// Nodes that can be computed in order once the coupled ones are known.
    pub after: Vec<Node>,
}

impl<'a> StepGraph<'a> {
    /// The graph of a tableau.
    pub fn new(class: Class, exact: &'a Exact, numbers: &Coefficients<Number<'a>>) -> Self {
        over_algebra!(exact, pair => Self::of_pair(class, pair, numbers))
    }

    pub(crate) fn of_pair<A: StageAlgebra>(
        class: Class,
        pair: &'a Partitioned<A>,
        numbers: &Coefficients<Number<'a>>,
    ) -> Self {
        let algebra = &*pair.algebra;
        let groups = Groups::new(class, pair);
        let adjoint = pair.adjoint();
        let merged = |matrix: &A::Matrix, row: usize, group: &[usize]| {
            algebra.merged_entry(matrix, row, group)
        };
        let values = |stages: &[Vec<usize>],
                      evaluations: &[Vec<usize>],
                      (matrix, entries): (&A::Matrix, &[Vec<Number<'a>>]),
                      (complement, weights): (&A::Matrix, &[Number<'a>])| {
            // A weight that is itself an entry, as in the rows of a splitting, is tested once for all rows.
            let zero_weights: Vec<OnceCell<bool>> = vec![OnceCell::new(); weights.len()];
            let is_zero_weight =
                |stage: usize| *zero_weights[stage].get_or_init(|| weights[stage].is_zero());
            let value = |stages: &Vec<usize>| {
                let row = stages[0];
                let is_weight = |group: &[usize]| match *group {
                    [single] => entries[row][single]
                        .is_same(&weights[single])
                        .then_some(single),
                    _ => None,
                };
                let rest = OnceCell::new();
                let differ = |stage: usize| {
                    let [entry, weight] = [&entries[row][stage], &weights[stage]];
                    compare(&entry.enclose(0), &weight.enclose(0)).is_some()
                };
                // A row is the row of weights if its complement b_j − a_ij vanishes.
                let vanishes = |group: &Vec<usize>| match group.as_slice() {
                    group if is_weight(group).is_some() => true,
                    [single] if differ(*single) => false,
                    [single] => {
                        rest.get_or_init(|| algebra.row(complement, row))[*single].is_zero()
                    }
                    _ => merged(complement, row, group).is_zero(),
                };
                let coefficient = |group: &Vec<usize>| match group.as_slice() {
                    [single] => entries[row][*single].clone(),
                    _ => merged(matrix, row, group),
                };
                let coefficients: Vec<Number<'a>> = evaluations.iter().map(coefficient).collect();
                let applied = coefficients
                    .iter()
                    .zip(evaluations)
                    .map(|(coefficient, group)| {
                        if let Some(stage) = is_weight(group) {
                            Some(!is_zero_weight(stage))
                        } else if coefficient.is_zero() {
                            Some(false)
                        } else {
                            vanishes(group).then_some(true)
                        }
                    });
                StageValue {
                    applied: applied.collect(),
                    is_end: evaluations.iter().all(vanishes),
                    coefficients,
                    stages: stages.clone(),
                }
            };
            stages.iter().map(value).collect::<Vec<_>>()
        };
        let evaluations = |stages: &[Vec<usize>],
                           times: &[Number<'a>],
                           (weights, vector): (&[Number<'a>], &A::Vector),
                           [sees_position, sees_momentum]: [bool; 2]| {
            let evaluation = |group: &Vec<usize>| Evaluation {
                position: sees_position.then(|| index_of(&groups.positions, group[0])),
                momentum: sees_momentum.then(|| index_of(&groups.momenta, group[0])),
                time: times[group[0]].clone(),
                weight: match group.as_slice() {
                    [single] => weights[*single].clone(),
                    _ => algebra.merged_value(vector, group),
                },
            };
            stages.iter().map(evaluation).collect::<Vec<_>>()
        };
        let general = class == Class::General;
        let (velocities, forces) = (&groups.velocities, &groups.forces);
        let graph = StepGraph {
            class,
            velocities: evaluations(
                velocities,
                &numbers.c_tilde,
                (&numbers.b, &pair.b),
                [general, true],
            ),
            forces: evaluations(
                forces,
                &numbers.c,
                (&numbers.b_tilde, &pair.b_tilde),
                [true, general],
            ),
            positions: values(
                &groups.positions,
                velocities,
                (&pair.a, &numbers.a),
                (&adjoint.a, &numbers.b),
            ),
            momenta: values(
                &groups.momenta,
                forces,
                (&pair.a_tilde, &numbers.a_tilde),
                (&adjoint.a_tilde, &numbers.b_tilde),
            ),
        };
        match class {
            // For general H, evaluations of both kinds use every stage.
            Class::General => graph,
            Class::Separable => graph.without_unused_evaluations(),
        }
    }

    /// The stages of the tableau that an evaluation belongs to.
    pub fn stages_of(&self, evaluation: &Evaluation<'_>) -> Vec<usize> {
        let position = evaluation.position.map(|i| &self.positions[i].stages);
        let momentum = evaluation.momentum.map(|i| &self.momenta[i].stages);
        match (position, momentum) {
            (Some(first), Some(second)) => {
                let both = first.iter().filter(|stage| second.contains(stage));
                both.copied().collect()
            }
            (Some(stages), None) | (None, Some(stages)) => stages.clone(),
            (None, None) => Vec::new(),
        }
    }

    /// Whether both have the same values and evaluations, at the same stages of the same tableau. They may differ in what an
    /// evaluation depends on.
    pub(crate) fn has_the_stages_of(&self, other: &Self) -> bool {
        let values = |values: &[StageValue<'a>]| -> Vec<Vec<usize>> {
            values.iter().map(|value| value.stages.clone()).collect()
        };
        let evaluations = |graph: &Self, evaluations: &[Evaluation<'_>]| -> Vec<Vec<usize>> {
            evaluations.iter().map(|e| graph.stages_of(e)).collect()
        };
        values(&self.positions) == values(&other.positions)
            && values(&self.momenta) == values(&other.momenta)
            && evaluations(self, &self.forces) == evaluations(other, &other.forces)
            && evaluations(self, &self.velocities) == evaluations(other, &other.velocities)
    }

    /// The nodes that a node needs.
    pub fn needs(&self, node: Node) -> Vec<Node> {
        let terms = |value: &StageValue<'_>, evaluation: fn(usize) -> Node| {
            let nonzero = value
                .coefficients
                .iter()
                .enumerate()
                .filter(|(_, c)| !c.is_zero());
            nonzero.map(|(j, _)| evaluation(j)).collect()
        };
        let arguments = |evaluation: &Evaluation<'_>| {
            let position = evaluation.position.map(Node::Position);
            position
                .into_iter()
                .chain(evaluation.momentum.map(Node::Momentum))
                .collect()
        };
        match node {
            Node::Position(i) => terms(&self.positions[i], Node::Velocity),
            Node::Momentum(i) => terms(&self.momenta[i], Node::Force),
            Node::Velocity(i) => arguments(&self.velocities[i]),
            Node::Force(i) => arguments(&self.forces[i]),
        }
    }

    /// All nodes.
    pub fn nodes(&self) -> impl Iterator<Item = Node> {
        let positions = (0..self.positions.len()).map(Node::Position);
        let forces = (0..self.forces.len()).map(Node::Force);
        let momenta = (0..self.momenta.len()).map(Node::Momentum);
        let velocities = (0..self.velocities.len()).map(Node::Velocity);
        positions.chain(forces).chain(momenta).chain(velocities)
    }

    /// Splits the nodes into those before the coupled ones, the coupled ones, and those after them.
    pub fn schedule(&self) -> Schedule {
        let nodes: Vec<Node> = self.nodes().collect();
        let indices: BTreeMap<Node, usize> = nodes.iter().copied().zip(0..).collect();
        let index = |node: Node| indices.get(&node).copied();
        let needs = nodes.iter().map(|&node| self.needs(node));
        let needs: Vec<Vec<usize>> = needs
            .map(|needs| needs.into_iter().filter_map(index).collect())
            .collect();
        let mut needed_by = vec![Vec::new(); nodes.len()];
        for (node, needs) in needs.iter().enumerate() {
            needs
                .iter()
                .for_each(|&needed| needed_by[needed].push(node));
        }
        let mut left = vec![true; nodes.len()];
        let before = take_while_possible(&mut left, &needs, &needed_by);
        // The same in reverse: nodes that no remaining node needs come last.
        let mut after = take_while_possible(&mut left, &needed_by, &needs);
        after.reverse();
        let coupled = (0..nodes.len()).filter(|&node| left[node]).collect();
        let named = |indices: Vec<usize>| indices.into_iter().map(|i| nodes[i]).collect();
        Schedule {
            before: named(before),
            coupled: named(coupled),
            after: named(after),
        }
    }

    /// The names of the stages in an order in which each can be computed from the earlier ones.
    ///
    /// # Errors
    /// If there is no such order: the names of the stages of a cycle, each of which needs the next.
    pub fn order(&self) -> Result<Vec<String>, Vec<String>> {
        let schedule = self.schedule();
        let Some(&start) = schedule.coupled.first() else {
            let order = schedule.before.iter().chain(&schedule.after);
            return Ok(order.filter_map(|&node| self.names(node)).collect());
        };
        // Every coupled node needs a coupled one: walk until a node repeats.
        let mut path = vec![start];
        let cycle = loop {
            let needs = self.needs(path[path.len() - 1]);
            let next = needs
                .into_iter()
                .find(|node| schedule.coupled.contains(node))
                .unwrap_or(start);
            if let Some(position) = path.iter().position(|&node| node == next) {
                break path.split_off(position);
            }
            path.push(next);
        };
        Err(cycle.iter().filter_map(|&node| self.names(node)).collect())
    }

    /// The names of the stages that share a value: `P1 = P2`.
    fn names(&self, node: Node) -> Option<String> {
        let (letter, value) = match node {
            Node::Position(i) => ('Q', &self.positions[i]),
            Node::Momentum(i) => ('P', &self.momenta[i]),
            Node::Force(_) | Node::Velocity(_) => return None,
        };
        Some(
            value
                .stages
                .iter()
                .map(|i| format!("{letter}{}", i + 1))
                .collect::<Vec<_>>()
                .join(" = "),
        )
    }
}

fn index_of(groups: &[Vec<usize>], stage: usize) -> usize {
    groups
        .iter()
        .position(|group| group.contains(&stage))
        .unwrap_or_default()
}

/// Stages that coincide, as lists of the stages of the tableau.
pub(crate) struct Groups {
    pub positions: Vec<Vec<usize>>,
    pub momenta: Vec<Vec<usize>>,
    pub velocities: Vec<Vec<usize>>,
    pub forces: Vec<Vec<usize>>,
}

impl Groups {
    /// Joins stages with equal rows, then evaluations at equal stages, then the stages whose rows have
    /// become equal thereby, until nothing more coincides.
    pub fn new<A: StageAlgebra>(class: Class, pair: &Partitioned<A>) -> Self {
        let algebra = &*pair.algebra;
        let single: Vec<Vec<usize>> = (0..algebra.stages()).map(|stage| vec![stage]).collect();
        let mut groups = Groups {
            positions: single.clone(),
            momenta: single.clone(),
            velocities: single.clone(),
            forces: single,
        };
        loop {
            let positions = algebra.equal_rows(&pair.a, &groups.velocities);
            let momenta = algebra.equal_rows(&pair.a_tilde, &groups.forces);
            if positions == groups.positions && momenta == groups.momenta {
                return groups;
            }
            (groups.velocities, groups.forces) = match class {
                Class::Separable => (momenta.clone(), positions.clone()),
                Class::General => {
                    let at = |stage| (index_of(&positions, stage), index_of(&momenta, stage));
                    let both = group_by(algebra.stages(), |stage| Some(at(stage)), PartialEq::eq);
                    (both.clone(), both)
                }
            };
            (groups.positions, groups.momenta) = (positions, momenta);
        }
    }
}

/// Takes the remaining nodes one at a time, always the first that waits for no remaining node. `awaited_by` is the
/// transpose of `waits_for`.
fn take_while_possible(
    left: &mut [bool],
    waits_for: &[Vec<usize>],
    awaited_by: &[Vec<usize>],
) -> Vec<usize> {
    let waiting = |waits_for: &Vec<usize>| waits_for.iter().filter(|&&other| left[other]).count();
    let mut counts: Vec<usize> = waits_for.iter().map(waiting).collect();
    let possible = (0..left.len()).filter(|&node| left[node] && counts[node] == 0);
    let mut possible: BTreeSet<usize> = possible.collect();
    let mut taken = Vec::new();
    while let Some(node) = possible.pop_first() {
        left[node] = false;
        taken.push(node);
        for &other in awaited_by[node].iter().filter(|&&other| left[other]) {
            counts[other] -= 1;
            if counts[other] == 0 {
                possible.insert(other);
            }
        }
    }
    taken
}

#[cfg(test)]
mod tests {
    use super::*;

    fn schedule(class: Class, basis: &str, nodes: &str) -> Schedule {
        let tableau = crate::derive(basis, nodes).expect("derived");
        StepGraph::new(class, &tableau.exact, &tableau.numbers()).schedule()
    }

    #[test]
    fn stoermer_verlet_is_explicit_with_one_momentum_stage() {
        use Node::*;
        let schedule = schedule(Class::Separable, "polynomial(2)", "lobatto(2)");
        assert_eq!(
            schedule.before,
            [
                Position(0),
                Force(0),
                Momentum(0),
                Velocity(0),
                Position(1),
                Force(1)
            ]
        );
        assert_eq!((schedule.coupled, schedule.after), (vec![], vec![]));
    }

    #[test]
    fn the_ends_of_lobatto_are_not_coupled() {
        use Node::*;
        let schedule = schedule(Class::Separable, "polynomial(3)", "lobatto(3)");
        assert_eq!(schedule.before, [Position(0), Force(0)]);
        assert_eq!(schedule.coupled.len(), 8);
        assert_eq!(schedule.after, [Position(2), Force(2)]);
    }

    #[test]
    fn gauss_is_coupled_throughout() {
        for class in [Class::General, Class::Separable] {
            let schedule = schedule(class, "polynomial(3)", "gauss(3)");
            assert_eq!(
                (
                    schedule.before.len(),
                    schedule.coupled.len(),
                    schedule.after.len()
                ),
                (0, 12, 0)
            );
        }
    }

    /// b = (1/2, 1/2, −1/2) and a_ij = μ_ij b_j with rows (0 0 0), (2 0 0), (2 1 1) of μ: the last two
    /// momentum stages coincide, then their velocities cancel in Q3, so that Q2 = Q3.
    #[test]
    fn stages_that_coincide_through_others_are_merged() {
        let basis = "403/6 - 16052/9*t + 13702*t^2 - 416320/9*t^3 + 232960/3*t^4 - 190976/3*t^5 + 60928/3*t^6, \
                     23/6 - 1144/9*t + 3742/3*t^2 - 48896/9*t^3 + 104000/9*t^4 - 34816/3*t^5 + 39424/9*t^6, \
                     -155/6 + 6604/9*t - 18514/3*t^2 + 209216/9*t^3 - 392960/9*t^4 + 119296/3*t^5 - 125440/9*t^6";
        let tableau = crate::derive(basis, "1/4, 1/2, 3/4").expect("derived");
        let groups = over_algebra!(&tableau.exact, pair => Groups::new(Class::Separable, pair));
        assert_eq!(groups.positions, [vec![0], vec![1, 2]]);
        assert_eq!(groups.momenta, groups.positions);
        // Their weights cancel, and no other stage needs them: they are not evaluated at all.
        let graph = StepGraph::new(Class::Separable, &tableau.exact, &tableau.numbers());
        assert_eq!((graph.positions.len(), graph.momenta.len()), (1, 1));
        assert_eq!(graph.order(), Ok(["Q1", "P1"].map(String::from).to_vec()));
    }
}
