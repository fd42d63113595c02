//! Splittings: each evaluation is applied to the state as soon as it is made, so that no stage is stored.

use proc_macro2::TokenStream;
use quote::quote;

use super::{Bodies, base, evaluation_name, literal};
use crate::schedule::{Node, Phases, StepGraph};

/// The evaluations of a splitting in their order.
pub(super) struct Chain<'g, 'a> {
    graph: &'g StepGraph<'a>,
    evaluations: Vec<Node>,
}

impl<'g, 'a> Chain<'g, 'a> {
    /// The order of the evaluations, if the step is a splitting.
    pub(super) fn new(graph: &'g StepGraph<'a>) -> Option<Self> {
        let evaluations = graph.splitting()?;
        Some(Chain { graph, evaluations })
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
