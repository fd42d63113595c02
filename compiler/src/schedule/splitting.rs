//! Splittings: steps that are sequences of kicks and drifts.

use super::{Class, Node, StageValue, StepGraph};

/// The evaluations that are in the sequence so far.
struct Made {
    forces: Vec<bool>,
    velocities: Vec<bool>,
}

impl<'a> StepGraph<'a> {
    /// The evaluations in the order of the step, if it is a splitting; evaluations without weight are left out.
    ///
    /// If every stage of a separable system contains each earlier evaluation either in full or not at all, a step is a
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
        let mut made = Made {
            forces: vec![false; self.forces.len()],
            velocities: vec![false; self.velocities.len()],
        };
        while !rest.is_empty() {
            let mut ready = rest.iter().enumerate();
            let mut ready = ready
                .by_ref()
                .filter(|&(_, &node)| self.follows(node, &made).unwrap_or(false));
            // If two were ready, each would have to come before the other.
            let (next, None) = (ready.next()?.0, ready.next()) else {
                return None;
            };
            let next = rest.remove(next);
            match next {
                Node::Force(j) => made.forces[j] = true,
                Node::Velocity(j) => made.velocities[j] = true,
                Node::Position(_) | Node::Momentum(_) => {}
            }
            chain.push(next);
        }
        Some(chain)
    }

    /// Whether exactly those evaluations have been applied that this evaluation waits for.
    fn follows(&self, node: Node, made: &Made) -> Option<bool> {
        let applied = self.argument(node)?.applied.as_deref()?;
        Some(match node {
            Node::Force(_) => applied == made.velocities,
            _ => applied == made.forces,
        })
    }

    /// The only stage value that an evaluation depends on, for separable Hamiltonians.
    pub fn argument(&self, node: Node) -> Option<&StageValue<'a>> {
        let evaluation = self.evaluation(node);
        match node {
            Node::Force(_) => self.positions.get(evaluation.position?),
            _ => self.momenta.get(evaluation.momentum?),
        }
    }
}
