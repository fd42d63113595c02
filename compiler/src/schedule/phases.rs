//! The phases in which code computes a step, and the number of evaluations of a step.

use super::{Class, Evaluation, Node, Schedule, StageValue, StepGraph};
use crate::arithmetic::rational::ratio;
use crate::exact::{Exact, over_algebra};
use crate::partitioned::{Flow, Flows};

/// The nodes of a step by the function in which they are computed.
#[derive(Debug)]
pub struct Phases<'g, 'a> {
    graph: &'g StepGraph<'a>,
    /// The nodes computed first.
    pub begin: Vec<Node>,
    /// The nodes to be solved for.
    pub coupled: Vec<Node>,
    /// The nodes computed last, starting with the first stage that is the result of the step.
    pub finish: Vec<Node>,
}

impl<'g, 'a> Phases<'g, 'a> {
    /// The phases of a step.
    pub fn new(graph: &'g StepGraph<'a>) -> Self {
        let Schedule {
            before,
            coupled,
            after,
        } = graph.schedule();
        let mut begin = before;
        let mut finish = after;
        if coupled.is_empty() {
            // Starting with the first stage that is the result itself, everything is computed where the
            // result is written.
            let is_end = |node: &Node| graph.value(*node).is_some_and(|value| value.is_end);
            let split = begin.iter().position(is_end).unwrap_or(begin.len());
            finish.splice(0..0, begin.drain(split..));
        }
        Phases {
            graph,
            begin,
            coupled,
            finish,
        }
    }

    /// Whether a stage value is never stored because it is the result of the step.
    pub fn is_aliased(&self, node: Node) -> bool {
        self.finish.contains(&node)
            && self
                .graph
                .value(node)
                .is_some_and(|value| value.is_end && !value.is_start())
    }

    /// Evaluations at the start of the step that equal one at the end of the previous step.
    pub fn carried(&self) -> Vec<(Node, Node)> {
        let forces = (0..self.graph.forces.len()).map(Node::Force);
        let velocities = (0..self.graph.velocities.len()).map(Node::Velocity);
        let nodes: Vec<Node> = forces.chain(velocities).collect();
        let sees_only = |node: Node, accept: &dyn Fn(Node) -> bool, time: i64| {
            let evaluation = self.graph.evaluation(node);
            let arguments = evaluation
                .position
                .map(Node::Position)
                .into_iter()
                .chain(evaluation.momentum.map(Node::Momentum));
            arguments.into_iter().all(accept) && evaluation.time.equals(&ratio(time, 1))
        };
        let values = || {
            self.graph
                .nodes()
                .filter(|&node| self.graph.value(node).is_some())
        };
        let at_start = |node: Node| self.graph.value(node).is_some_and(StageValue::is_start);
        let first = nodes
            .iter()
            .filter(|&&node| self.begin.contains(&node) && sees_only(node, &at_start, 0));
        let mut carried: Vec<(Node, Node)> = Vec::new();
        for &first in first {
            let is_last = |node: &&Node| {
                matches!(node, Node::Force(_)) == matches!(first, Node::Force(_))
                    && self.finish.contains(node)
                    && sees_only(**node, &|n| self.is_aliased(n), 1)
                    // Only the result uses it.
                    && values().all(|value| !self.graph.needs(value).contains(node))
                    // An evaluation can replace only one other.
                    && carried.iter().all(|(_, taken)| taken != *node)
            };
            if let Some(&last) = nodes.iter().find(is_last) {
                carried.push((first, last));
            }
        }
        carried
    }
}

impl<'a> StepGraph<'a> {
    /// The value of a node, if it is a stage.
    pub fn value(&self, node: Node) -> Option<&StageValue<'a>> {
        match node {
            Node::Position(i) => self.positions.get(i),
            Node::Momentum(i) => self.momenta.get(i),
            Node::Force(_) | Node::Velocity(_) => None,
        }
    }

    /// The evaluation at a node: the node itself, or the one at this stage.
    pub fn evaluation(&self, node: Node) -> &Evaluation<'a> {
        match node {
            Node::Position(i) | Node::Force(i) => &self.forces[i],
            Node::Momentum(i) | Node::Velocity(i) => &self.velocities[i],
        }
    }
}

/// Evaluations per step of a long run, for a separable Hamiltonian.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Evaluations {
    /// Evaluations of the force `−∂U/∂q`.
    pub forces: usize,
    /// Evaluations of the velocity `∂T/∂p`.
    pub velocities: usize,
    /// Products of the Hessian of `U` and a vector, one for each gradient kick.
    pub gradients: usize,
}

impl Evaluations {
    /// The force evaluations that the cost of a step counts: a gradient kick counts as two, a force and a product.
    pub fn cost(&self) -> usize {
        self.forces + self.gradients
    }

    /// The evaluations of a method that is explicit for separable Hamiltonians.
    pub(crate) fn of(exact: &Exact) -> Option<Self> {
        if exact.has_gradient_kicks() {
            return over_algebra!(exact, pair => Some(Evaluations::of_flows(&pair.flows()?)));
        }
        let graph = StepGraph::new(Class::Separable, exact, &exact.numbers());
        let phases = Phases::new(&graph);
        let carried = phases.carried();
        let saved = |force: bool| {
            let kinds = carried
                .iter()
                .map(|(first, _)| matches!(first, Node::Force(_)));
            kinds.filter(|kind| *kind == force).count()
        };
        phases.coupled.is_empty().then(|| Evaluations {
            forces: graph.forces.len() - saved(true),
            velocities: graph.velocities.len() - saved(false),
            gradients: 0,
        })
    }

    /// The evaluations of a splitting with gradient kicks, of which those of the first flow are those at the end of the previous step if
    /// that has them.
    fn of_flows<T>(flows: &Flows<T>) -> Self {
        let count = |of: &dyn Fn(&Flow<T>) -> bool| {
            let all = flows.iter().filter(|flow| of(flow)).count();
            let ends = [flows.iter().next(), flows.iter().last()];
            let carried = ends.into_iter().all(|end| end.is_some_and(of));
            all - usize::from(carried && all > 1)
        };
        Evaluations {
            forces: count(&|flow| flow.is_kick),
            velocities: count(&|flow| !flow.is_kick),
            gradients: count(&|flow| flow.gradient.is_some()),
        }
    }
}
