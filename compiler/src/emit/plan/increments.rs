//! The factors of the evaluations of a step, and when they are applied.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::facts::Known;
use super::{index, literal, slot, start, symplectic_rounding, terms_of};
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

    /// The factors and terms of a stage value as two arguments: `factors, [terms]`. Terms `evaluated` in the sweeps may not have been
    /// multiplied by their weights yet.
    pub(super) fn sum(
        &self,
        graph: &StepGraph<'_>,
        node: Node,
        evaluated: impl Fn(Node) -> bool,
    ) -> TokenStream {
        let term = terms_of(node);
        let value = graph.value(node);
        let coefficients = value.map_or(&[][..], |value| &value.coefficients);
        let nonzero = (0..coefficients.len()).filter(|&j| !coefficients[j].is_zero());
        let nonzero: Vec<usize> = nonzero.collect();
        let slots = nonzero.iter().map(|&j| slot(term(j)));
        let factors = match self {
            Form::Increments(relative) => {
                let row = match node {
                    Node::Momentum(i) => &relative.momenta[i],
                    _ => &relative.positions[index(node)],
                };
                let row = nonzero.iter().map(|&j| literal::rounded(row[j]));
                if nonzero.iter().any(|&j| evaluated(term(j))) {
                    // Evaluations made before the sweeps are increments already.
                    let weights = nonzero.iter().map(|&j| match evaluated(term(j)) {
                        true => weight_slot(term(j)),
                        false => {
                            quote!(<V::Scalar as ::symplectic::emitted::Scalar>::from_f64(1.0))
                        }
                    });
                    quote!(::symplectic::emitted::relative::<R, _, _>([#(#row),*], [#(#weights),*]))
                } else {
                    quote!(::symplectic::emitted::factors([#(#row),*]))
                }
            }
            Form::Weighted => weights(nonzero.iter().map(|&j| &coefficients[j])),
        };
        quote!(#factors, [#(&#slots),*])
    }

    /// The line that scales an evaluation, just written to its place, to an increment; empty in the other form.
    pub(super) fn increment(&self, evaluation: &Evaluation<'_>, node: Node) -> TokenStream {
        self.scaled(evaluation, node, &quote!(::symplectic::emitted::scale))
    }

    /// [`increment`](Self::increment) in a sweep, where it may be postponed.
    pub(super) fn increment_in_sweep(
        &self,
        evaluation: &Evaluation<'_>,
        node: Node,
    ) -> TokenStream {
        self.scaled(
            evaluation,
            node,
            &quote!(::symplectic::emitted::increment::<R, V>),
        )
    }

    fn scaled(
        &self,
        evaluation: &Evaluation<'_>,
        node: Node,
        function: &TokenStream,
    ) -> TokenStream {
        match self {
            Form::Weighted => TokenStream::new(),
            Form::Increments(_) => {
                let (slot, weight) = (slot(node), literal::coefficient(&evaluation.weight));
                quote!(#function(&mut #slot, step.size, #weight);)
            }
        }
    }

    /// The weights that scale all evaluations of a kind to increments, under the name that [`sum`](Self::sum) uses; empty
    /// in the other form.
    pub(super) fn weights(&self, evaluations: &[Evaluation<'_>], kind: Node) -> TokenStream {
        match self {
            Form::Weighted => TokenStream::new(),
            Form::Increments(_) => {
                let name = weights_name(kind);
                let weights = evaluations
                    .iter()
                    .map(|evaluation| literal::coefficient(&evaluation.weight));
                quote!(let #name = ::symplectic::emitted::weights::<V::Scalar, _>(step.size, [#(#weights),*]);)
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
                quote!(::symplectic::emitted::total::<R, V, _>(#out, #base, [#(&#slots),*]);)
            }
            Form::Weighted => {
                let weights = weights(nonzero.iter().map(|&j| &evaluations[j].weight));
                quote!(::symplectic::emitted::weighted_total::<R, V, _>(#out, #base, #weights, [#(&#slots),*]);)
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
        quote!(::symplectic::emitted::advance::<R, V>(#out, step.size, #weight, &#slot);)
    }

    /// Sets a stage value to the start of the step.
    pub(super) fn reset(node: Node) -> TokenStream {
        let (stage, start) = (slot(node), start(node));
        quote!(::symplectic::emitted::copy(&mut #stage, #start);)
    }
}

/// The weights of the evaluations of a kind.
fn weights_name(kind: Node) -> Ident {
    literal::identifier(match kind {
        Node::Force(_) | Node::Position(_) => "force_weights",
        Node::Velocity(_) | Node::Momentum(_) => "velocity_weights",
    })
}

/// The weight of an evaluation among those of its kind.
fn weight_slot(node: Node) -> TokenStream {
    let (name, index) = (weights_name(node), literal::count(index(node)));
    quote!(#name[#index])
}

/// Factors of evaluations, times the step size.
fn weights<'n, 'a: 'n>(values: impl Iterator<Item = &'n Number<'a>>) -> TokenStream {
    let values = values.map(literal::coefficient);
    quote!(::symplectic::emitted::weights(step.size, [#(#values),*]))
}
