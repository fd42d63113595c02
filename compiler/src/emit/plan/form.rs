//! What the evaluations of a step are multiplied by, and when.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::known::Known;
use super::{index, literal, relative, slot, start, terms_of};
use crate::algebra::Number;
use crate::schedule::{Evaluation, Node, StepGraph};
use relative::{Relative, Rounded};

/// The form of the sums that stages are.
#[derive(Debug)]
pub(super) enum Form {
    /// `Q_i = q0 + Σ_j μ_ij (h b_j velocity_j)`: every evaluation becomes an increment as soon as it is made, and the
    /// result is the sum of the increments. Symplectic methods; it stays symplectic when rounded.
    Increments(Relative),
    /// `Q_i = q0 + Σ_j (h a_ij) velocity_j`: any method.
    Weighted,
}

impl Form {
    /// Increments where it can be.
    pub(super) fn new(graph: &StepGraph<'_>, known: &Known) -> Self {
        Relative::new(graph, known).map_or(Form::Weighted, Form::Increments)
    }

    /// The factors and terms of a stage value as two arguments: `weights, [terms]`.
    pub(super) fn sum(&self, graph: &StepGraph<'_>, node: Node) -> TokenStream {
        let term = terms_of(node);
        let value = graph.value(node);
        let coefficients = value.map_or(&[][..], |value| &value.coefficients);
        let nonzero = (0..coefficients.len()).filter(|&j| !coefficients[j].is_zero());
        let nonzero: Vec<usize> = nonzero.collect();
        let slots = nonzero.iter().map(|&j| slot(term(j)));
        let factors = match (self, node) {
            (Form::Increments(relative), Node::Momentum(i)) => {
                factors(nonzero.iter().map(|&j| relative.momenta[i][j]))
            }
            (Form::Increments(relative), _) => {
                factors(nonzero.iter().map(|&j| relative.positions[index(node)][j]))
            }
            (Form::Weighted, _) => weights(nonzero.iter().map(|&j| &coefficients[j])),
        };
        quote!(#factors, [#(&#slots),*])
    }

    /// What makes an increment of an evaluation that has just been written into its place; nothing in the other form.
    pub(super) fn increment(&self, evaluation: &Evaluation<'_>, node: Node) -> TokenStream {
        match self {
            Form::Weighted => TokenStream::new(),
            Form::Increments(_) => {
                let (slot, weight) = (slot(node), literal::coefficient(&evaluation.weight));
                quote!(::symplectic::scale(&mut #slot, step.size, #weight);)
            }
        }
    }

    /// The result of the step, written to `out`: from the start and those of the evaluations that are `included`.
    pub(super) fn total(
        &self,
        evaluations: &[Evaluation<'_>],
        kind: Node,
        included: impl Fn(usize) -> bool,
    ) -> TokenStream {
        let (out, base) = match kind {
            Node::Momentum(_) => (quote!(p1, p1_low), super::base(kind)),
            _ => (quote!(q1, q1_low), super::base(kind)),
        };
        let term = terms_of(kind);
        let nonzero =
            (0..evaluations.len()).filter(|&j| included(j) && !evaluations[j].weight.is_zero());
        let nonzero: Vec<usize> = nonzero.collect();
        let slots = nonzero.iter().map(|&j| slot(term(j)));
        match self {
            Form::Increments(_) => {
                quote!(::symplectic::total::<R, V, _>(#out, #base, [#(&#slots),*]);)
            }
            Form::Weighted => {
                let weights = weights(nonzero.iter().map(|&j| &evaluations[j].weight));
                quote!(::symplectic::weighted_total::<R, V, _>(#out, #base, #weights, [#(&#slots),*]);)
            }
        }
    }

    /// The line that adds one evaluation, as it is, to the result of the step.
    pub(super) fn late(evaluation: &Evaluation<'_>, node: Node) -> TokenStream {
        let out = match node {
            Node::Force(_) => quote!(p1, p1_low),
            _ => quote!(q1, q1_low),
        };
        let (slot, weight) = (slot(node), literal::coefficient(&evaluation.weight));
        quote!(::symplectic::advance::<R, V>(#out, step.size, #weight, &#slot);)
    }

    /// Sets a stage value to the start of the step.
    pub(super) fn reset(node: Node) -> TokenStream {
        let (stage, start) = (slot(node), start(node));
        quote!(::symplectic::copy(&mut #stage, #start);)
    }
}

/// Factors of increments, as they are.
fn factors(values: impl Iterator<Item = Rounded>) -> TokenStream {
    let values = values.map(literal::rounded);
    quote!(::symplectic::factors([#(#values),*]))
}

/// Factors of evaluations, times the step size.
fn weights<'n, 'a: 'n>(values: impl Iterator<Item = &'n Number<'a>>) -> TokenStream {
    let values = values.map(literal::coefficient);
    quote!(::symplectic::weights(step.size, [#(#values),*]))
}
