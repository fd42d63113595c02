//! The plan of a step as code, for one class of Hamiltonians or for both.

mod composition;
mod coupled;
mod decoupling;
mod increments;
mod matrices;
mod splitting;
mod stages;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::dense_output::StagePolynomials;
use super::facts::Known;
use super::{literal, literal::identifier, nystrom, predictor, symplectic_rounding};
use crate::algebra::Number;
use crate::coefficients::Coefficients;
use crate::schedule::{Class, Node, Phases, StepGraph};
use crate::tableau::Substep;
use crate::tableau::Tableau;
use crate::tableau::left_out;
use composition::Composed;
pub(super) use matrices::HalfTableau;
use splitting::Chain;
use stages::Stored;

/// The function bodies of a plan.
struct Bodies {
    /// Whether the stages are coupled.
    coupling: &'static str,
    /// The type of the memory.
    stages: TokenStream,
    /// The coefficients of the coupled stages.
    constants: TokenStream,
    /// The functions that make a sweep.
    coupled: TokenStream,
    begin: TokenStream,
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
    /// Whether it consists of kicks and drifts.
    pub(super) splits: bool,
}

impl Plan {
    /// The plan for general systems of a splitting that has none.
    fn none() -> Self {
        Plan {
            name: quote!(emitted::SeparableOnly),
            code: TokenStream::new(),
            splits: false,
        }
    }
}

/// The plans of a method, under these names; one plan for both classes has the name `shared`. A composition of at least two substeps with
/// coupled stages is computed substep by substep, from its methods and substeps.
pub(super) fn plans(
    tableau: &Tableau,
    numbers: &Coefficients<Number<'_>>,
    (methods, substeps): (&[Tableau], &[Substep]),
    names: [(Class, &Ident); 2],
    shared: &Ident,
) -> [Plan; 2] {
    if let Some(lower_triangular) = tableau.exact.lower_triangular()
        && tableau.has_gradient_kicks()
    {
        let [_, (_, name)] = names;
        return [
            Plan::none(),
            splitting::with_gradient_kicks(numbers, lower_triangular, name),
        ];
    }
    let parts: Vec<_> = methods.iter().map(Tableau::numbers).collect();
    let polynomials = StagePolynomials::new(numbers);
    let known = Known::new(tableau);
    let parts_known: Vec<_> = methods.iter().map(Known::new).collect();
    let long = left_out(tableau).is_some();
    // There is no plan for general systems if the matrices are left out.
    let graphs = names.map(|(class, _)| {
        let stepped = !long || class == Class::Separable;
        stepped.then(|| StepGraph::new(class, &tableau.exact, numbers))
    });
    let composed = |plans| Composed {
        plans,
        methods,
        substeps,
    };
    let is_composed =
        |graph: &StepGraph<'_>| substeps.len() > 1 && !Phases::new(graph).coupled.is_empty();
    if let [Some(general), Some(separable)] = &graphs {
        if is_composed(general) && is_composed(separable) {
            if let Some(plans) = parts_of_both(methods, &parts, &parts_known, shared) {
                return composed(plans).of_both(shared);
            }
        } else if let Some(step) =
            Stored::for_both([general, separable], &known, Some(&polynomials))
        {
            let code = of_both(&step, shared, Some(&polynomials));
            return for_each_class(code, &quote!(Coupled), shared);
        }
    }
    let [general, separable] = names;
    let [general_graph, separable_graph] = graphs;
    [(general, general_graph), (separable, separable_graph)].map(|((class, name), graph)| {
        let Some(graph) = graph else {
            return Plan::none();
        };
        if !is_composed(&graph) {
            return of_stages(&graph, name, &known, Some(&polynomials));
        }
        let part = |(k, name): (usize, Ident)| {
            let graph = StepGraph::new(class, &methods[k].exact, &parts[k]);
            of_stages(&graph, &name, &parts_known[k], None)
        };
        let plans = numbered(name, methods.len())
            .enumerate()
            .map(part)
            .collect();
        composed(plans).of_class(class, name)
    })
}

/// The plans of the methods of a composition for both classes, generic over the class `K`, if each has one.
fn parts_of_both(
    methods: &[Tableau],
    numbers: &[Coefficients<Number<'_>>],
    known: &[Known],
    name: &Ident,
) -> Option<Vec<Plan>> {
    let plan = |(k, name): (usize, Ident)| {
        let graphs = [Class::General, Class::Separable]
            .map(|class| StepGraph::new(class, &methods[k].exact, &numbers[k]));
        let step = Stored::for_both(graphs.each_ref(), &known[k], None)?;
        Some(Plan {
            code: of_both(&step, &name, None),
            name: quote!(emitted::Coupled<#name<K>>),
            splits: false,
        })
    };
    numbered(name, methods.len())
        .enumerate()
        .map(plan)
        .collect()
}

/// The name with the numbers 1 to `count`.
fn numbered(name: &Ident, count: usize) -> impl Iterator<Item = Ident> {
    (1..=count).map(move |k| format_ident!("{name}{k}"))
}

fn class_name(class: Class) -> Ident {
    identifier(match class {
        Class::General => "General",
        Class::Separable => "Separable",
    })
}

/// A plan of stages for one class: a type of this name and its implementation of `StagePlan`. Without polynomials there is no
/// dense output.
fn of_stages(
    graph: &StepGraph<'_>,
    name: &Ident,
    known: &Known,
    polynomials: Option<&StagePolynomials<'_, '_>>,
) -> Plan {
    if let Some(chain) = Chain::new(graph) {
        return chain.plan(name);
    }
    let class = class_name(graph.class);
    let stored = Stored::new(graph, known);
    let bodies = stored.bodies();
    let coupling = identifier(bodies.coupling);
    let (generics, name) = (TokenStream::new(), quote!(#name));
    let matrices = stored.matrices(&generics, &name, polynomials);
    let plan = bodies.code(&generics, &name, &quote!(emitted::#class));
    Plan {
        name: quote!(emitted::#coupling<#name>),
        code: quote!(pub struct #name; #plan #matrices),
        splits: false,
    }
}

/// A plan of coupled stages for both classes: a type of this name, generic over the class. Without polynomials there is no dense output.
fn of_both(
    step: &Stored<'_, '_>,
    name: &Ident,
    polynomials: Option<&StagePolynomials<'_, '_>>,
) -> TokenStream {
    let (generics, generic_name) = (quote!(<K: emitted::Class>), quote!(#name<K>));
    let matrices = step.matrices(&generics, &generic_name, polynomials);
    let plan = (step.bodies()).code(&generics, &generic_name, &quote!(K));
    quote! {
        pub struct #name<K>(::core::marker::PhantomData<K>);

        #plan
        #matrices
    }
}

/// The plans of both classes, from the code of a type that is generic over the class.
fn for_each_class(code: TokenStream, kind: &TokenStream, name: &Ident) -> [Plan; 2] {
    [
        (Class::General, code),
        (Class::Separable, TokenStream::new()),
    ]
    .map(|(class, code)| {
        let class = class_name(class);
        Plan {
            name: quote!(emitted::#kind<#name<emitted::#class>>),
            code,
            splits: false,
        }
    })
}

impl Bodies {
    /// The implementation of `StagePlan` for a type and a class, with these generic parameters.
    fn code(self, generics: &TokenStream, name: &TokenStream, class: &TokenStream) -> TokenStream {
        let Bodies {
            stages,
            constants,
            coupled,
            begin,
            increments,
            finish,
            ..
        } = self;
        let [at_begin, at_start, in_sweep, at_finish] = self.counts.map(Literal::usize_unsuffixed);
        let carried = Literal::usize_unsuffixed(self.carried);
        let increments = increments.map(|increments| {
            quote! {
                #[inline]
                fn increments<V: emitted::Vector>(step: &emitted::Step<'_, V>, stages: &mut Self::Stages<V>) {
                    #increments
                }
            }
        });
        let constants =
            (!constants.is_empty()).then(|| quote!(impl #generics #name { #constants }));
        let system = quote!(S: emitted::System<V, Class = Self::Class>);
        let arguments = quote! {
            step: &emitted::Step<'_, V>, system: &S, stages: &mut Self::Stages<V>
        };
        quote! {
            #constants

            #[allow(unused_variables)]
            impl #generics emitted::StagePlan for #name {
                type Class = #class;
                type Stages<V: emitted::Vector> = #stages;

                const EVALUATIONS: emitted::EvaluationCounts = emitted::EvaluationCounts {
                    begin: #at_begin,
                    start: #at_start,
                    sweep: #in_sweep,
                    finish: #at_finish,
                    carried: #carried,
                };

                #[inline]
                fn begin<R: emitted::Summation, V: emitted::Vector, #system>(#arguments, kept: emitted::WarmStart) {
                    #begin
                }

                #coupled

                #increments

                #[inline]
                fn finish<R: emitted::Summation, V: emitted::Vector, #system>(
                    #arguments,
                    kept: emitted::WarmStart,
                    outcome: emitted::Outcome<'_, V>,
                ) {
                    let emitted::Outcome { q: q1, q_low: q1_low, p: p1, p_low: p1_low } = outcome;
                    #finish
                }
            }
        }
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
