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
            impl ::symplectic::emitted::SplittingPlan for #name {
                type Class = ::symplectic::emitted::#class;

                const EVALUATIONS: u32 = #count;
                const CARRIED: u32 = #carried;

                #[inline(always)]
                fn apply<
                    R: ::symplectic::emitted::Summation,
                    V: ::symplectic::emitted::Vector,
                    S: ::symplectic::emitted::System<V, Class = Self::Class>,
                    K: ::symplectic::emitted::KickDrift,
                    W: ::symplectic::emitted::EvaluationObserver,
                >(
                    span: ::symplectic::emitted::Span,
                    system: &S,
                    evaluations: &mut ::symplectic::emitted::Evaluations<V>,
                    kept: ::symplectic::emitted::WarmStart,
                    state: ::symplectic::emitted::Outcome<'_, V>,
                    kick_drift: &mut K,
                    witness: &mut W,
                ) {
                    let ::symplectic::emitted::Evaluations { velocity, force } = evaluations;
                    let ::symplectic::emitted::Outcome { q, q_low, p, p_low } = state;
                    #(#lines)*
                }
            }
        };
        Plan {
            name: quote!(::symplectic::emitted::Splitting<#name>),
            code,
        }
    }

    /// An evaluation, unless it is `carried`, and its update of the state.
    fn line(&self, node: Node, carried: bool) -> TokenStream {
        let evaluation = self.graph.evaluation(node);
        let time = literal::coefficient(&evaluation.time);
        let weight = literal::coefficient(&evaluation.weight);
        let stage = literal::count(super::index(node) + 1);
        let known = match carried {
            true => quote!(kept.evaluation),
            false => quote!(false),
        };
        if !matches!(node, Node::Force(_)) {
            return quote! {
                kick_drift.drift::<R, V, S, W>(
                    ::symplectic::emitted::Drift { span, stage: #stage, time: #time, weight: #weight, known: #known },
                    system, (&mut *velocity, &mut *force), (&mut *q, &mut *q_low), (&mut *p, &mut *p_low), witness,
                );
            };
        }
        let evaluate = quote! {
            kick_drift.force::<R, V, S, W>(
                ::symplectic::emitted::Force { span, stage: #stage, time: #time },
                system, &mut *force, &mut *q, (&mut *p, &mut *p_low), witness,
            );
        };
        let evaluate = match carried {
            true => quote!(if !kept.evaluation { #evaluate }),
            false => evaluate,
        };
        quote! {
            #evaluate
            kick_drift.kick::<R, V, S>(span.size, #weight, system, &mut *force, &mut *q, (&mut *p, &mut *p_low));
        }
    }
}
