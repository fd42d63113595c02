//! Splittings: steps that are kicks and drifts one after another.

use super::{Class, Node, StageValue, StepGraph};

impl<'a> StepGraph<'a> {
    /// The evaluations in the order of the step, if it is a splitting; evaluations without weight are left out.
    ///
    /// Where every stage of a separable system has each earlier evaluation in it in full or not at all, a step is a
    /// sequence of drifts `q += h b_j velocity(p)` and kicks `p += h b̃_j force(q)` (MW 2.6.4).
    pub fn splitting(&self) -> Option<Vec<Node>> {
        if self.class != Class::Separable {
            return None;
        }
        let forces = (0..self.forces.len()).map(Node::Force);
        let velocities = (0..self.velocities.len()).map(Node::Velocity);
        let nodes = forces.chain(velocities);
        let mut rest: Vec<Node> = nodes
            .filter(|&node| !self.evaluation(node).weight.is_zero())
            .collect();
        let mut chain = Vec::new();
        while !rest.is_empty() {
            let mut ready = rest.iter().enumerate();
            let mut ready = ready
                .by_ref()
                .filter(|&(_, &node)| self.follows(node, &chain).unwrap_or(false));
            // Were two ready, the one would have to come before the other and the other before the one.
            let (next, None) = (ready.next()?.0, ready.next()) else {
                return None;
            };
            chain.push(rest.remove(next));
        }
        Some(chain)
    }

    /// Whether exactly those evaluations have been applied that an evaluation waits for.
    fn follows(&self, node: Node, chain: &[Node]) -> Option<bool> {
        let argument = self.argument(node)?.applied.as_deref()?;
        let term = match node {
            Node::Force(_) => Node::Velocity,
            _ => Node::Force,
        };
        let mut applied = argument.iter().enumerate();
        Some(applied.all(|(j, applied)| chain.contains(&term(j)) == *applied))
    }

    /// The one stage value that an evaluation sees, for separable Hamiltonians.
    pub(crate) fn argument(&self, node: Node) -> Option<&StageValue<'a>> {
        let evaluation = self.evaluation(node);
        match node {
            Node::Force(_) => self.positions.get(evaluation.position?),
            _ => self.momenta.get(evaluation.momentum?),
        }
    }
}
