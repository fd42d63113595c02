//! Splittings: each evaluation is applied to the state immediately, so that no stage is stored.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::{Plan, class_name, literal};
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

    /// The plan as a type of this name.
    pub(super) fn plan(&self, name: &Ident) -> Plan {
        // Only the first evaluation can be carried over: the last evaluation of its kind in the previous step leaves it
        // in its slot.
        let carried = Phases::new(self.graph).carried().len();
        let lines = self.evaluations.iter().enumerate();
        let lines = lines.map(|(number, &node)| self.line(node, number == 0 && carried > 0));
        let class = class_name(self.graph.class);
        let count = Literal::usize_unsuffixed(self.evaluations.len());
        let carried = Literal::usize_unsuffixed(carried);
        let code = quote! {
            pub struct #name;

            #[allow(unused_variables)]
            impl emitted::SplittingPlan for #name {
                type Class = emitted::#class;

                const EVALUATIONS: u32 = #count;
                const CARRIED: u32 = #carried;

                #[inline(always)]
                fn apply<R, V, S, K, W>(step: &mut emitted::SplittingStep<'_, R, V, S, K, W>)
                where
                    R: emitted::Summation,
                    V: emitted::Vector,
                    S: emitted::System<V, Class = Self::Class>,
                    K: emitted::KickDrift,
                    W: emitted::EvaluationObserver,
                {
                    #(#lines)*
                }
            }
        };
        Plan {
            name: quote!(emitted::Splitting<#name>),
            code,
            splits: true,
        }
    }

    /// An evaluation, which may be `carried` from the previous step, and its update of the state.
    fn line(&self, node: Node, carried: bool) -> TokenStream {
        let evaluation = self.graph.evaluation(node);
        let time = literal::coefficient(&evaluation.time);
        let weight = literal::coefficient(&evaluation.weight);
        let stage = literal::count(super::index(node) + 1);
        if !matches!(node, Node::Force(_)) {
            let drift = literal::identifier(if carried { "kept_drift" } else { "drift" });
            return quote!(step.#drift(#stage, #time, #weight););
        }
        let force = literal::identifier(if carried { "kept_force" } else { "force" });
        quote! {
            step.#force(#stage, #time);
            step.kick(#weight);
        }
    }
}
