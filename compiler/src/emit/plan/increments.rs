//! The factors of the evaluations of a step, and when they are applied.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::facts::Known;
use super::{index, literal, slot, symplectic_rounding, terms_of};
use crate::algebra::Number;
use crate::schedule::{Evaluation, Node, StepGraph};
use symplectic_rounding::Relative;

/// The form of the sums that give the stages.
#[derive(Debug)]
pub(super) enum Form {
    /// `Q_i = q0 + Σ_j μ_ij (h b_j velocity_j)`: every evaluation becomes an increment as soon as it is made, and the
    /// result is the sum of the increments. Symplectic methods; it stays symplectic when rounded.
    Increments(Relative),
    /// `Q_i = q0 + Σ_j (h a_ij) velocity_j`: any method.
    Weighted,
}

impl Form {
    /// The form with increments, if the method admits it.
    pub(super) fn new(graph: &StepGraph<'_>, known: &Known) -> Self {
        Relative::new(graph, known).map_or(Form::Weighted, Form::Increments)
    }

    /// The factors and terms of a stage value as two arguments: `factors, [terms]`.
    pub(super) fn sum(&self, graph: &StepGraph<'_>, node: Node) -> TokenStream {
        let coefficients = self.coefficients(graph, node);
        let slots = Self::terms(graph, node).into_iter().map(slot);
        let factors = match self {
            Form::Increments(_) => quote!(emitted::factors([#(#coefficients),*])),
            Form::Weighted => quote!(emitted::weights(step.size, [#(#coefficients),*])),
        };
        quote!(#factors, [#(&#slots),*])
    }

    /// The evaluations that a stage value needs.
    pub(super) fn terms(graph: &StepGraph<'_>, node: Node) -> Vec<Node> {
        let nonzero = nonzero(graph, node).into_iter();
        nonzero.map(|(j, _)| terms_of(node)(j)).collect()
    }

    /// Their coefficients.
    pub(super) fn coefficients(&self, graph: &StepGraph<'_>, node: Node) -> Vec<TokenStream> {
        let coefficient = |(j, number): (usize, &Number<'_>)| match self {
            Form::Increments(relative) => {
                let row = match node {
                    Node::Momentum(i) => &relative.momenta[i],
                    _ => &relative.positions[index(node)],
                };
                literal::rounded(row[j])
            }
            Form::Weighted => literal::coefficient(number),
        };
        nonzero(graph, node).into_iter().map(coefficient).collect()
    }

    /// The line that scales an evaluation, just written to its place, to an increment; empty in the other form.
    pub(super) fn increment(&self, evaluation: &Evaluation<'_>, node: Node) -> TokenStream {
        match self {
            Form::Weighted => TokenStream::new(),
            Form::Increments(_) => {
                let (slot, weight) = (slot(node), literal::coefficient(&evaluation.weight));
                quote!(emitted::scale(&mut #slot, step.size, #weight);)
            }
        }
    }

    /// The result of the step, written to `out`: the start plus the evaluations that are `included`.
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
                quote! {
                    let increments = [#(&#slots),*];
                    emitted::total::<R, V, _>(#out, #base, increments);
                }
            }
            Form::Weighted => {
                let weights = weights(nonzero.iter().map(|&j| &evaluations[j].weight));
                quote! {
                    let (weights, terms) = (#weights, [#(&#slots),*]);
                    emitted::weighted_total::<R, V, _>(#out, #base, weights, terms);
                }
            }
        }
    }

    /// The line that adds one evaluation, unscaled, to the result of the step.
    pub(super) fn late(evaluation: &Evaluation<'_>, node: Node) -> TokenStream {
        let out = match node {
            Node::Force(_) => quote!(p1, p1_low),
            _ => quote!(q1, q1_low),
        };
        let (slot, weight) = (slot(node), literal::coefficient(&evaluation.weight));
        quote!(emitted::advance::<R, V>(#out, step.size, #weight, &#slot);)
    }
}

/// The nonzero coefficients of a stage value, each with the number of its evaluation.
fn nonzero<'g, 'a>(graph: &'g StepGraph<'a>, node: Node) -> Vec<(usize, &'g Number<'a>)> {
    let value = graph.value(node);
    let coefficients = value.map_or(&[][..], |value| &value.coefficients);
    let numbered = coefficients.iter().enumerate();
    numbered.filter(|(_, number)| !number.is_zero()).collect()
}

/// Factors of evaluations, times the step size.
fn weights<'n, 'a: 'n>(values: impl Iterator<Item = &'n Number<'a>>) -> TokenStream {
    let values = values.map(literal::coefficient);
    quote!(emitted::weights(step.size, [#(#values),*]))
}
