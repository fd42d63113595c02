//! The plan of a step for one class of Hamiltonians, as code.

mod composition;
mod decoupling;
mod increments;
mod matrices;
mod splitting;
mod stages;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::dense_output::StagePolynomials;
use super::facts::Known;
use super::{literal, literal::identifier, nystrom, predictor, symplectic_rounding};
use crate::algebra::Number;
use crate::coefficients::Coefficients;
use crate::derive::Substep;
use crate::schedule::{Class, Node, Phases, StepGraph};
use crate::tableau::Tableau;
use crate::tableau::left_out;
use composition::Composed;
use increments::Form;
pub(super) use matrices::HalfTableau;
use splitting::Chain;
use stages::Stored;

/// The function bodies of a plan.
struct Bodies {
    /// Whether the stages are coupled.
    coupling: &'static str,
    /// The type of the memory.
    stages: TokenStream,
    begin: TokenStream,
    sweep: TokenStream,
    /// The code after the last sweep if sums are plain (not compensated), if any.
    increments: Option<TokenStream>,
    finish: TokenStream,
    /// Evaluations in `begin`, for starting values, in a sweep and in `finish`.
    counts: [usize; 4],
    /// Number of evaluations in `begin` that are reused from the previous step.
    carried: usize,
}

/// The plan of a method for one class of Hamiltonians.
pub(super) struct Plan {
    /// Its type.
    pub(super) name: TokenStream,
    /// The code that defines the type.
    pub(super) code: TokenStream,
}

/// The plans of a method, under these names. A composition of at least two substeps with coupled stages is computed
/// substep by substep, from its methods and substeps.
pub(super) fn plans(
    tableau: &Tableau,
    numbers: &Coefficients<Number<'_>>,
    (methods, substeps): (&[Tableau], &[Substep]),
    names: [(Class, &Ident); 2],
) -> [Plan; 2] {
    let parts: Vec<_> = methods.iter().map(Tableau::numbers).collect();
    let polynomials = StagePolynomials::new(numbers);
    let known = Known::new(tableau);
    let parts_known: Vec<_> = methods.iter().map(Known::new).collect();
    let long = left_out(tableau).is_some();
    names.map(|(class, name)| {
        if long && class == Class::General {
            return Plan {
                name: quote!(::symplectic::emitted::SeparableOnly),
                code: TokenStream::new(),
            };
        }
        let graph = StepGraph::new(class, tableau, numbers);
        if substeps.len() < 2 || Phases::new(&graph).coupled.is_empty() {
            return of_stages(&graph, name, &known, Some(&polynomials));
        }
        let composed = Composed {
            class,
            methods,
            numbers: &parts,
            known: &parts_known,
            substeps,
        };
        Plan {
            name: quote!(::symplectic::emitted::Composition<#name>),
            code: composed.code(name),
        }
    })
}

fn class_name(class: Class) -> Ident {
    identifier(match class {
        Class::General => "General",
        Class::Separable => "Separable",
    })
}

/// A plan of stages: a type of this name and its implementation of `StagePlan`. Without polynomials there is no dense
/// output.
fn of_stages(
    graph: &StepGraph<'_>,
    name: &Ident,
    known: &Known,
    polynomials: Option<&StagePolynomials<'_, '_>>,
) -> Plan {
    if let Some(chain) = Chain::new(graph) {
        return chain.plan(name);
    }
    let stored = Stored::new(graph, Form::new(graph, known), known);
    let (bodies, matrices) = (stored.bodies(), stored.matrices(name, polynomials));
    let Bodies {
        stages,
        begin,
        sweep,
        increments,
        finish,
        ..
    } = bodies;
    let increments = increments.map(|increments| {
        quote! {
            #[inline]
            fn increments<V: ::symplectic::emitted::Vector>(step: &::symplectic::emitted::Step<'_, V>, stages: &mut Self::Stages<V>) {
                #increments
            }
        }
    });
    let class = class_name(graph.class);
    let coupling = identifier(bodies.coupling);
    let [at_begin, at_start, in_sweep, at_finish] = bodies.counts.map(Literal::usize_unsuffixed);
    let carried = Literal::usize_unsuffixed(bodies.carried);
    let system = quote!(S: ::symplectic::emitted::System<V, Class = Self::Class>);
    let arguments = quote! {
        step: &::symplectic::emitted::Step<'_, V>, system: &S, stages: &mut Self::Stages<V>
    };
    let code = quote! {
        pub struct #name;

        #[allow(unused_variables)]
        impl ::symplectic::emitted::StagePlan for #name {
            type Class = ::symplectic::emitted::#class;
            type Stages<V: ::symplectic::emitted::Vector> = #stages;

            const EVALUATIONS: ::symplectic::emitted::EvaluationCounts = ::symplectic::emitted::EvaluationCounts {
                begin: #at_begin,
                start: #at_start,
                sweep: #in_sweep,
                finish: #at_finish,
                carried: #carried,
            };

            #[inline]
            fn begin<R: ::symplectic::emitted::Summation, V: ::symplectic::emitted::Vector, #system>(#arguments, kept: ::symplectic::emitted::WarmStart) {
                #begin
            }

            #[inline]
            fn sweep<R: ::symplectic::emitted::Summation, V: ::symplectic::emitted::Vector, #system>(#arguments) -> ::symplectic::emitted::StageChange {
                #sweep
            }

            #increments

            #[inline]
            fn finish<R: ::symplectic::emitted::Summation, V: ::symplectic::emitted::Vector, #system, W: ::symplectic::emitted::EvaluationObserver>(
                #arguments,
                kept: ::symplectic::emitted::WarmStart,
                outcome: ::symplectic::emitted::Outcome<'_, V>,
                witness: &mut W,
            ) {
                let ::symplectic::emitted::Outcome { q: q1, q_low: q1_low, p: p1, p_low: p1_low } = outcome;
                #finish
            }
        }

        #matrices
    };
    Plan {
        name: quote!(::symplectic::emitted::#coupling<#name>),
        code,
    }
}

fn index(node: Node) -> usize {
    match node {
        Node::Position(i) | Node::Force(i) | Node::Momentum(i) | Node::Velocity(i) => i,
    }
}

/// Where a node is stored.
fn slot(node: Node) -> TokenStream {
    let array = identifier(match node {
        Node::Position(_) => "q",
        Node::Momentum(_) => "p",
        Node::Force(_) => "force",
        Node::Velocity(_) => "velocity",
    });
    let index = Literal::usize_unsuffixed(index(node));
    quote!(#array[#index])
}

/// The start of the step for a stage value.
fn start(node: Node) -> TokenStream {
    match node {
        Node::Momentum(_) | Node::Force(_) => quote!(step.p),
        Node::Position(_) | Node::Velocity(_) => quote!(step.q),
    }
}

/// The start of the step and its compensation, as two arguments.
fn base(node: Node) -> TokenStream {
    match node {
        Node::Momentum(_) | Node::Force(_) => quote!(step.p, step.p_low),
        Node::Position(_) | Node::Velocity(_) => quote!(step.q, step.q_low),
    }
}

/// The evaluations whose sum gives a stage value.
fn terms_of(node: Node) -> fn(usize) -> Node {
    match node {
        Node::Momentum(_) => Node::Force,
        _ => Node::Velocity,
    }
}

fn evaluation_name(node: Node) -> Ident {
    identifier(match node {
        Node::Force(_) | Node::Position(_) => "force",
        Node::Velocity(_) | Node::Momentum(_) => "velocity",
    })
}
