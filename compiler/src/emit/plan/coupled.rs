//! Coupled stages: the evaluations and the sums of a sweep, each written once, and the starting values.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::super::facts::Extrapolation;
use super::increments::Form;
use super::stages::Stored;
use super::{evaluation_name, index, literal, predictor, slot};
use crate::schedule::{Class, Evaluation, Node};

/// The kinds of stage values and of evaluations, in the order of a sweep.
const KINDS: [Node; 4] = [
    Node::Force(0),
    Node::Momentum(0),
    Node::Velocity(0),
    Node::Position(0),
];

impl Stored<'_, '_> {
    /// A function for each kind of coupled node.
    pub(super) fn coupled(&self) -> TokenStream {
        let functions = KINDS.map(|kind| match kind {
            Node::Force(_) | Node::Velocity(_) => self.evaluations(kind),
            Node::Momentum(_) | Node::Position(_) => self.sums(kind),
        });
        quote!(#(#functions)*)
    }

    /// The starting values of the coupled stages, `extrapolated` if the previous step allows it.
    pub(super) fn starting_values(&self, extrapolated: Option<&TokenStream>) -> TokenStream {
        let initial = self.initial();
        let code = match extrapolated {
            Some(extrapolated) => quote!(if kept.stages { #extrapolated } else { #initial }),
            None => initial,
        };
        let sums = (!code.is_empty())
            .then(|| quote!(let sums = &mut emitted::StartingValues::<R>::new();));
        quote!(#sums #code)
    }

    /// The lines that scale the evaluations of sweeps to increments; empty in the other form.
    pub(super) fn increments(&self) -> TokenStream {
        let lines = [Node::Force(0), Node::Velocity(0)].map(|kind| self.scale_coupled(kind));
        quote!(#(#lines)*)
    }

    /// The coupled nodes of the kind of a node.
    fn coupled_of_kind(&self, kind: Node) -> Vec<Node> {
        let same = |node: &&Node| std::mem::discriminant(*node) == std::mem::discriminant(&kind);
        self.phases.coupled.iter().filter(same).copied().collect()
    }

    fn evaluations_of_kind(&self, kind: Node) -> &[Evaluation<'_>] {
        match kind {
            Node::Force(_) | Node::Momentum(_) => &self.graph.forces,
            Node::Velocity(_) | Node::Position(_) => &self.graph.velocities,
        }
    }

    /// Each list of coefficients once: a list that equals an earlier one refers to it.
    pub(super) fn constants(&self) -> TokenStream {
        let mut written: Vec<(String, Ident)> = Vec::new();
        let mut constant = |name: Ident, kind: TokenStream, values: &[TokenStream]| {
            let list = quote!([#(#values),*]);
            let text = list.to_string();
            let value = match written.iter().find(|(known, _)| *known == text) {
                Some((_, known)) => quote!(Self::#known),
                None => list,
            };
            written.push((text, name.clone()));
            let count = literal::count(values.len());
            quote!(const #name: [#kind; #count] = #value;)
        };
        let coefficient = || quote!(emitted::Coefficient);
        let mut constants = Vec::new();
        for kind in [Node::Force(0), Node::Velocity(0)] {
            if self.coupled_of_kind(kind).is_empty() {
                continue;
            }
            let evaluations = self.evaluations_of_kind(kind);
            let list = |value: fn(&Evaluation<'_>) -> TokenStream| -> Vec<TokenStream> {
                evaluations.iter().map(value).collect()
            };
            let times = list(|evaluation| literal::coefficient(&evaluation.time));
            constants.push(constant(times_name(kind), coefficient(), &times));
            if let Form::Increments(_) = self.form {
                let weights = list(|evaluation| literal::coefficient(&evaluation.weight));
                constants.push(constant(weights_name(kind), coefficient(), &weights));
            }
        }
        for kind in [Node::Position(0), Node::Momentum(0)] {
            for node in self.coupled_of_kind(kind) {
                let coefficients = self.form.coefficients(self.graph, node);
                constants.push(constant(row_name(node), coefficient(), &coefficients));
            }
        }
        if self.extrapolated().is_some() {
            let general = self.graph.class == Class::General;
            for (kind, used) in [(Node::Velocity(0), true), (Node::Force(0), general)] {
                let used = used && !self.coupled_of_kind(kind).is_empty();
                if let Some(matrix) = used.then(|| self.extrapolation(kind)).flatten() {
                    let name = extrapolation_name(kind);
                    let columns = self.extrapolation_columns(kind, &matrix);
                    constants.push(quote!(const #name: &'static [&'static [f64]] = #columns;));
                }
            }
        }
        quote!(#(#constants)*)
    }

    /// The function that computes the coupled evaluations of a kind.
    fn evaluations(&self, kind: Node) -> Option<TokenStream> {
        let nodes = self.coupled_of_kind(kind);
        if nodes.is_empty() {
            return None;
        }
        let [times, weights] = [times_name(kind), weights_name(kind)];
        let lines = nodes.iter().map(|&node| {
            let (evaluation, number) = (evaluation_name(node), literal::count(index(node)));
            let (out, [q, p]) = (slot(node), self.arguments(node));
            let scale = matches!(self.form, Form::Increments(_)).then(
                || quote!(emitted::increment::<R, V>(&mut #out, step.size, Self::#weights[#number]);),
            );
            quote!(system.#evaluation(step.at(Self::#times[#number]), #q, #p, &mut #out); #scale)
        });
        let (function, array) = (function_name(kind), evaluation_name(kind));
        Some(quote! {
            #[inline]
            fn #function<R: emitted::Summation, V: emitted::Vector, S: emitted::System<V, Class = Self::Class>>(
                step: &emitted::Step<'_, V>,
                system: &S,
                stages: &mut Self::Stages<V>,
            ) {
                let emitted::Stages { q, p, #array, .. } = stages;
                #(#lines)*
            }
        })
    }

    /// The function that computes the coupled stage values of a kind.
    fn sums(&self, kind: Node) -> Option<TokenStream> {
        let nodes = self.coupled_of_kind(kind);
        if nodes.is_empty() {
            return None;
        }
        let count = self.evaluations_of_kind(kind).len();
        let mut any_made = false;
        let lines: Vec<TokenStream> = nodes
            .iter()
            .map(|&node| {
                let (stage, name) = (slot(node), row_name(node));
                let terms = Form::terms(self.graph, node);
                let chosen = |array: &str, one: &dyn Fn(Node) -> bool| {
                    let array = literal::identifier(array);
                    if terms.len() == count && !terms.iter().any(|&term| one(term)) {
                        return quote!(#array);
                    }
                    let entries = terms.iter().map(|&term| match one(term) {
                        true => quote!(one),
                        false => {
                            let number = literal::count(index(term));
                            quote!(#array[#number])
                        }
                    });
                    quote!([#(#entries),*])
                };
                let list = chosen("terms", &|_| false);
                match self.form {
                    Form::Weighted => {
                        let factors = quote!(emitted::weights(step.size, Self::#name));
                        quote!(sums.evaluations(&mut #stage, base, #factors, #list);)
                    }
                    // Evaluations made before the sweeps are increments already.
                    Form::Increments(_) => {
                        let made = |term: Node| !self.phases.coupled.contains(&term);
                        any_made |= terms.iter().any(|&term| made(term));
                        let weights = chosen("weights", &made);
                        quote!(sums.increments(&mut #stage, base, Self::#name, #weights, #list);)
                    }
                }
            })
            .collect();
        let weights = weights_name(kind);
        let weights = matches!(self.form, Form::Increments(_)).then(
            || quote!(let weights = emitted::weights::<V::Scalar, _>(step.size, Self::#weights);),
        );
        let one =
            any_made.then(|| quote!(let one = <V::Scalar as emitted::Scalar>::from_f64(1.0);));
        let (values, base) = match kind {
            Node::Momentum(_) => (literal::identifier("p"), super::base(kind)),
            _ => (literal::identifier("q"), super::base(kind)),
        };
        let (function, array) = (
            function_name(kind),
            evaluation_name(super::terms_of(kind)(0)),
        );
        let numbers = (0..count).map(literal::count);
        Some(quote! {
            #[inline]
            fn #function<V: emitted::Vector, A: emitted::StageSums>(
                step: &emitted::Step<'_, V>,
                stages: &mut Self::Stages<V>,
                sums: &mut A,
            ) {
                let emitted::Stages { #values, #array, .. } = stages;
                let (base, terms) = ((#base), [#(&#array[#numbers]),*]);
                #weights
                #one
                #(#lines)*
            }
        })
    }

    /// Starting values from the start of the step alone: one velocity for all stages, the positions that follow from it,
    /// and the other coupled stages there.
    fn initial(&self) -> TokenStream {
        let reset = self.coupled_of_kind(Node::Momentum(0));
        let reset = (!reset.is_empty()).then(|| {
            let numbers = reset.iter().map(|&node| literal::count(index(node)));
            quote!(emitted::reset(&mut stages.p, [#(#numbers),*], step.p);)
        });
        let velocities = self.coupled_of_kind(Node::Velocity(0));
        let Some((&first, others)) = velocities.split_first() else {
            return quote!(#reset);
        };
        let (number, times) = (literal::count(index(first)), times_name(first));
        let evaluate = quote! {
            let time = step.at(Self::#times[#number]);
            system.velocity(time, step.q, step.p, &mut stages.velocity[#number]);
        };
        let copies = (!others.is_empty()).then(|| {
            let others = others.iter().map(|&node| literal::count(index(node)));
            quote!(emitted::copy_to(&mut stages.velocity, #number, [#(#others),*]);)
        });
        let scale = self.scale_coupled(first);
        let positions = self.start(Node::Position(0));
        quote!(#reset #evaluate #copies #scale #positions)
    }

    /// Starting values from the increments of the previous step: those of the velocities and, if forces depend on
    /// the momenta, those of the forces too. `None` if there is no extrapolation.
    pub(super) fn extrapolated(&self) -> Option<TokenStream> {
        let Form::Increments(_) = self.form else {
            return None;
        };
        let velocities = self.transform(Node::Velocity(0))?;
        let positions = self.start(Node::Position(0));
        if self.graph.class == Class::Separable {
            return Some(quote!(#velocities #positions));
        }
        let forces = self.transform(Node::Force(0))?;
        let momenta = self.start(Node::Momentum(0));
        let momenta = quote!(#forces #momenta);
        let momenta = match self.separable {
            Some(_) => quote!(if !K::SEPARABLE { #momenta }),
            None => momenta,
        };
        Some(quote!(#velocities #positions #momenta))
    }

    /// The line that computes the starting values of a kind from the increments.
    fn start(&self, kind: Node) -> Option<TokenStream> {
        let function = function_name(kind);
        let any = !self.coupled_of_kind(kind).is_empty();
        any.then(|| quote!(Self::#function(step, stages, sums);))
    }

    /// The line that scales the coupled evaluations of a kind to increments; empty in the other form.
    fn scale_coupled(&self, kind: Node) -> Option<TokenStream> {
        let nodes = self.coupled_of_kind(kind);
        if nodes.is_empty() || matches!(self.form, Form::Weighted) {
            return None;
        }
        let (array, weights) = (evaluation_name(kind), weights_name(kind));
        let numbers: Vec<_> = nodes
            .iter()
            .map(|&node| literal::count(index(node)))
            .collect();
        let weights = if nodes.len() == self.evaluations_of_kind(kind).len() {
            quote!(Self::#weights)
        } else {
            quote!([#(Self::#weights[#numbers]),*])
        };
        Some(quote!(emitted::scale_all(&mut stages.#array, [#(#numbers),*], step.size, #weights);))
    }

    /// The line that extrapolates the increments of one kind to the next step.
    fn transform(&self, kind: Node) -> Option<TokenStream> {
        let nodes = self.coupled_of_kind(kind);
        if nodes.is_empty() {
            return Some(TokenStream::new());
        }
        self.extrapolation(kind)?;
        let numbers = nodes.iter().map(|&node| literal::count(index(node)));
        let (array, name) = (evaluation_name(kind), extrapolation_name(kind));
        Some(quote!(emitted::transform(&mut stages.#array, [#(#numbers),*], Self::#name);))
    }

    /// The columns of the matrix that extrapolates the increments of one kind to the next step. If all evaluations are coupled, they are also
    /// in the matrices for the stages in lanes.
    fn extrapolation_columns(&self, kind: Node, rows: &[Vec<f64>]) -> TokenStream {
        if rows.len() == self.evaluations_of_kind(kind).len() {
            let half = literal::identifier(match kind {
                Node::Force(_) => "POSITIONS",
                _ => "MOMENTA",
            });
            return quote!(<Self as emitted::StageTableau>::#half.extrapolation);
        }
        let columns = (0..rows.len()).map(|j| {
            let column: Vec<f64> = rows.iter().map(|row| row[j]).collect();
            literal::array(&column)
        });
        quote!(&[#(&#columns),*])
    }

    /// The matrix that extrapolates the increments of one kind to the next step, if there is one.
    fn extrapolation(&self, kind: Node) -> Extrapolation {
        let nodes = self.coupled_of_kind(kind).into_iter();
        let evaluations: Vec<_> = nodes.map(|node| self.graph.evaluation(node)).collect();
        predictor::matrix(self.graph, kind, &evaluations, self.known)
    }
}

fn function_name(kind: Node) -> Ident {
    literal::identifier(match kind {
        Node::Force(_) => "forces",
        Node::Momentum(_) => "momenta",
        Node::Velocity(_) => "velocities",
        Node::Position(_) => "positions",
    })
}

/// The times of the evaluations of a kind: `c` for forces, `c̃` for velocities.
fn times_name(kind: Node) -> Ident {
    literal::identifier(match kind {
        Node::Force(_) => "C",
        _ => "C_TILDE",
    })
}

/// The weights of the evaluations of a kind, or of the terms of a kind of stages.
fn weights_name(kind: Node) -> Ident {
    literal::identifier(match kind {
        Node::Force(_) | Node::Momentum(_) => "B_TILDE",
        Node::Velocity(_) | Node::Position(_) => "B",
    })
}

/// The matrix that extrapolates the increments of a kind: see [`predictor::matrix`].
fn extrapolation_name(kind: Node) -> Ident {
    literal::identifier(match kind {
        Node::Force(_) => "E_TILDE",
        _ => "E",
    })
}

/// The coefficients of a stage value.
fn row_name(node: Node) -> Ident {
    match node {
        Node::Momentum(i) => format_ident!("P_{i}"),
        _ => format_ident!("Q_{}", index(node)),
    }
}
