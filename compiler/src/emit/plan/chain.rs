//! Splittings: each evaluation is applied to the state as soon as it is made, so that no stage is stored.
//!
//! Where every stage of a separable system has each earlier evaluation in it in full or not at all, a step is a
//! sequence of drifts `q += h b_j velocity(p)` and kicks `p += h b̃_j force(q)` (MW 2.6.4).

use proc_macro2::TokenStream;
use quote::quote;

use super::{Bodies, base, evaluation_name, literal};
use crate::schedule::{Class, Node, Phases, StageValue, StepGraph};

/// The evaluations of a splitting in their order.
pub(super) struct Chain<'g, 'a> {
    graph: &'g StepGraph<'a>,
    evaluations: Vec<Node>,
}

impl<'g, 'a> Chain<'g, 'a> {
    /// The order of the evaluations, if the step is a splitting.
    pub(super) fn new(graph: &'g StepGraph<'a>) -> Option<Self> {
        if graph.class != Class::Separable {
            return None;
        }
        let forces = (0..graph.forces.len()).map(Node::Force);
        let velocities = (0..graph.velocities.len()).map(Node::Velocity);
        let nodes = forces.chain(velocities);
        let mut rest: Vec<Node> = nodes
            .filter(|&node| !graph.evaluation(node).weight.is_zero())
            .collect();
        let mut chain = Chain {
            graph,
            evaluations: Vec::new(),
        };
        while !rest.is_empty() {
            let mut ready = rest.iter().enumerate();
            let mut ready = ready
                .by_ref()
                .filter(|&(_, &node)| chain.is_ready(node).unwrap_or(false));
            // Were two ready, the one would have to come before the other and the other before the one.
            let (next, None) = (ready.next()?.0, ready.next()) else {
                return None;
            };
            chain.evaluations.push(rest.remove(next));
        }
        Some(chain)
    }

    /// Whether exactly those evaluations have been applied that an evaluation waits for.
    fn is_ready(&self, node: Node) -> Option<bool> {
        let argument = self.argument(node)?.applied.as_deref()?;
        let term = match node {
            Node::Force(_) => Node::Velocity,
            _ => Node::Force,
        };
        let mut applied = argument.iter().enumerate();
        Some(applied.all(|(j, applied)| self.evaluations.contains(&term(j)) == *applied))
    }

    /// The value that an evaluation sees.
    fn argument(&self, node: Node) -> Option<&'g StageValue<'a>> {
        let evaluation = self.graph.evaluation(node);
        match node {
            Node::Force(_) => self.graph.positions.get(evaluation.position?),
            _ => self.graph.momenta.get(evaluation.momentum?),
        }
    }

    /// The code of the step.
    pub(super) fn bodies(&self) -> Bodies {
        // The first evaluation, if any: it is left in its place by the last one of its kind.
        let carried = !Phases::new(self.graph).carried().is_empty();
        let mut moved = [false; 2];
        let mut lines = Vec::new();
        for (number, &node) in self.evaluations.iter().enumerate() {
            let is_force = matches!(node, Node::Force(_));
            let value = |moved: bool, end: TokenStream, start: TokenStream| {
                if moved { quote!(&*#end) } else { start }
            };
            let q = value(moved[0], quote!(q1), quote!(step.q));
            let p = value(moved[1], quote!(p1), quote!(step.p));
            let evaluation = self.graph.evaluation(node);
            let time = literal::coefficient(&evaluation.time);
            let weight = literal::coefficient(&evaluation.weight);
            let function = evaluation_name(node);
            let stage = literal::count(super::index(node) + 1);
            let kind = literal::identifier(if is_force { "Force" } else { "Velocity" });
            let argument = if is_force { &q } else { &p };
            let evaluate = quote! {
                system.#function(step.at(#time), #q, #p, #function);
                witness.evaluation(::symplectic::Quantity::#kind, #stage, #argument, #function);
            };
            lines.push(if number == 0 && carried {
                quote!(if !kept.evaluation { #evaluate })
            } else {
                evaluate
            });
            let (out, low, from) = if is_force {
                (quote!(p1), quote!(p1_low), quote!(step.p, step.p_low))
            } else {
                (quote!(q1), quote!(q1_low), quote!(step.q, step.q_low))
            };
            let moved = &mut moved[usize::from(is_force)];
            lines.push(if *moved {
                quote!(::symplectic::advance_in_place::<R, V>(#out, #low, step.size, #weight, #function);)
            } else {
                quote!(::symplectic::advance::<R, V>(#out, #low, #from, step.size, #weight, #function);)
            });
            *moved = true;
        }
        for (moved, node, out) in [
            (moved[0], Node::Position(0), quote!(q1, q1_low)),
            (moved[1], Node::Momentum(0), quote!(p1, p1_low)),
        ] {
            if !moved {
                let base = base(node);
                lines.push(quote!(::symplectic::total::<R, V, 0>(#out, #base, []);));
            }
        }
        Bodies {
            coupling: "Explicit",
            stages: quote!(::symplectic::Evaluations<V>),
            begin: TokenStream::new(),
            sweep: quote!(::symplectic::Change::default()),
            finish: quote! {
                let ::symplectic::Evaluations { velocity, force } = stages;
                #(#lines)*
            },
            counts: [self.evaluations.len(), 0, 0, 0],
            carried: usize::from(carried),
        }
    }
}
