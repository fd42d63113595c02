//! Splittings: each evaluation is applied to the state immediately, so that no stage is stored.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::{Plan, class_name, literal};
use crate::algebra::Number;
use crate::coefficients::Coefficients;
use crate::emit::symplectic_rounding::Rounded;
use crate::partitioned::LowerTriangular;
use crate::schedule::{Class, Node, Phases, StepGraph};

/// The plan of these lines as a type of this name, with the numbers of its evaluations and of those that are carried.
fn plan(
    name: &Ident,
    counts: [usize; 2],
    lines: impl Iterator<Item = TokenStream>,
    splits: bool,
) -> Plan {
    let class = class_name(Class::Separable);
    let [count, carried] = counts.map(Literal::usize_unsuffixed);
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
        splits,
    }
}

/// A kick or a drift of a stage, from 1, of a splitting with gradient kicks.
struct Flow<'n, 'a> {
    is_kick: bool,
    stage: usize,
    time: &'n Number<'a>,
    weight: &'n Number<'a>,
    /// `g` of a gradient kick.
    gradient: Option<&'n Number<'a>>,
}

impl Flow<'_, '_> {
    /// The number of its evaluations.
    fn evaluations(&self) -> usize {
        1 + usize::from(self.gradient.is_some())
    }

    /// Its operations; the previous step may have made its first `carried` evaluations.
    fn lines(&self, carried: usize) -> TokenStream {
        let (time, weight) = (
            literal::coefficient(self.time),
            literal::coefficient(self.weight),
        );
        let stage = literal::count(self.stage);
        let name = |number: usize, name: &str| {
            let kept = if number <= carried { "kept_" } else { "" };
            literal::identifier(&format!("{kept}{name}"))
        };
        if !self.is_kick {
            let drift = name(1, "drift");
            return quote!(step.#drift(#stage, #time, #weight););
        }
        let (force, force_gradient) = (name(1, "force"), name(2, "force_gradient"));
        let kick = (!self.weight.is_zero()).then(|| quote!(step.kick(#weight);));
        let gradient_kick = self.gradient.map(|g| {
            let twice = literal::rounded(Rounded::of(g).twice());
            quote! {
                step.#force_gradient(#stage, #time);
                step.gradient_kick(#twice);
            }
        });
        quote! {
            step.#force(#stage, #time);
            #kick
            #gradient_kick
        }
    }
}

/// The plan of a splitting with gradient kicks, for separable systems. Friction and other flows do not replace such kicks.
pub(super) fn with_gradient_kicks(
    numbers: &Coefficients<Number<'_>>,
    lower_triangular: LowerTriangular,
    name: &Ident,
) -> Plan {
    let stages = (0..numbers.b.len()).flat_map(|i| {
        let gradient = numbers.gradient.get(i);
        let kick = Flow {
            is_kick: true,
            stage: i + 1,
            time: &numbers.c[i],
            weight: &numbers.b_tilde[i],
            gradient: gradient.filter(|g| !g.is_zero()),
        };
        let drift = Flow {
            is_kick: false,
            stage: i + 1,
            time: &numbers.c_tilde[i],
            weight: &numbers.b[i],
            gradient: None,
        };
        match lower_triangular {
            LowerTriangular::KicksFirst => [kick, drift],
            LowerTriangular::DriftsFirst => [drift, kick],
        }
    });
    let flows = stages.filter(|flow| flow.gradient.is_some() || !flow.weight.is_zero());
    let flows: Vec<Flow<'_, '_>> = flows.collect();
    // The last kick leaves its force, and the force gradient, in their slots.
    let carried = match &flows[..] {
        [first, .., last] if first.is_kick == last.is_kick => {
            first.evaluations().min(last.evaluations())
        }
        _ => 0,
    };
    let count = flows.iter().map(Flow::evaluations).sum();
    let lines = flows.iter().enumerate();
    let lines = lines.map(|(number, flow)| flow.lines(if number == 0 { carried } else { 0 }));
    plan(name, [count, carried], lines, false)
}

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
        plan(name, [self.evaluations.len(), carried], lines, true)
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
