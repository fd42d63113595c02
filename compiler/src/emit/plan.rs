//! The plan of a step for one class of Hamiltonians, as code.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::literal::{self, identifier};
use crate::algebra::Number;
use crate::arithmetic::rational::ratio;
use crate::coefficients::Coefficients;
use crate::schedule::{Class, Evaluation, Node, Schedule, StageValue, StepGraph};
use crate::tableau::Tableau;

/// The type of a plan and its implementation of `Plan`.
pub(super) fn implementation(
    class: Class,
    tableau: &Tableau,
    numbers: &Coefficients<Number<'_>>,
    name: &Ident,
) -> TokenStream {
    let graph = StepGraph::new(class, tableau, numbers);
    let phases = Phases::new(&graph);
    let class = identifier(match class {
        Class::General => "General",
        Class::Separable => "Separable",
    });
    let coupling = identifier(if phases.coupled.is_empty() {
        "Explicit"
    } else {
        "Coupled"
    });
    let forces = Literal::usize_unsuffixed(graph.forces.len());
    let velocities = Literal::usize_unsuffixed(graph.velocities.len());
    let begin = phases.begin();
    let sweep = phases.sweep();
    let finish = phases.finish();
    let carry = phases.carry();
    let bounds =
        quote!(<V: ::symplectic::Vector, S: ::symplectic::Hamiltonian<V, Class = Self::Class>>);
    quote! {
        pub struct #name;

        #[allow(unused_variables)]
        impl ::symplectic::Plan for #name {
            type Class = ::symplectic::#class;
            type Coupling = ::symplectic::#coupling;
            type Stages<V: ::symplectic::Vector> = ::symplectic::Stages<V, #forces, #velocities>;

            #[inline]
            fn begin #bounds (step: &::symplectic::Step<'_, V>, system: &S, stages: &mut Self::Stages<V>, carried: bool) {
                let ::symplectic::Stages { q, p, velocity, force } = stages;
                #begin
            }

            #[inline]
            fn sweep #bounds (step: &::symplectic::Step<'_, V>, system: &S, stages: &mut Self::Stages<V>) -> ::symplectic::Change {
                #sweep
            }

            #[inline]
            fn finish #bounds (step: &::symplectic::Step<'_, V>, system: &S, stages: &mut Self::Stages<V>, q1: &mut V, p1: &mut V) {
                let ::symplectic::Stages { q, p, velocity, force } = stages;
                #finish
            }

            #[inline]
            fn carry<V: ::symplectic::Vector>(stages: &mut Self::Stages<V>) -> bool {
                #carry
            }
        }
    }
}

/// The nodes of a step by the function in which they are computed.
struct Phases<'g, 'a> {
    graph: &'g StepGraph<'a>,
    begin: Vec<Node>,
    coupled: Vec<Node>,
    finish: Vec<Node>,
}

impl<'g, 'a> Phases<'g, 'a> {
    fn new(graph: &'g StepGraph<'a>) -> Self {
        let Schedule {
            before,
            coupled,
            after,
        } = graph.schedule();
        let mut begin = before;
        let mut finish = after;
        if coupled.is_empty() {
            // From the first stage on that is the result itself, everything is computed where the
            // result is written.
            let is_end = |node: &Node| value(graph, *node).is_some_and(|value| value.is_end);
            let split = begin.iter().position(is_end).unwrap_or(begin.len());
            finish.splice(0..0, begin.drain(split..));
        }
        Phases {
            graph,
            begin,
            coupled,
            finish,
        }
    }

    fn begin(&self) -> TokenStream {
        let explicit = self.begin.iter().map(|&node| self.compute(node));
        // Values that are solved for start from the start of the step …
        let initial = self
            .coupled
            .iter()
            .filter(|&&node| value(self.graph, node).is_some_and(|value| !value.is_start()));
        let initial = initial.map(|&node| {
            let (stage, base) = (slot(node), base(node));
            quote!(::symplectic::combine(&mut #stage, #base, step.size, [], []);)
        });
        // … and so do the velocities, which the first sweep reads; one evaluation is made for all.
        let velocities = self.start_velocities();
        quote!(#(#explicit)* #(#initial)* #velocities)
    }

    /// The first coupled velocity at the start of the step, copied to the others.
    fn start_velocities(&self) -> TokenStream {
        let velocities = 0..self.graph.velocities.len();
        let coupled: Vec<usize> = velocities
            .filter(|&i| self.coupled.contains(&Node::Velocity(i)))
            .collect();
        let Some((&first, others)) = coupled.split_first() else {
            return TokenStream::new();
        };
        let evaluate = self.evaluate(Node::Velocity(first), &quote!(step.q), &quote!(step.p));
        if others.is_empty() {
            return evaluate;
        }
        let first = Literal::usize_unsuffixed(first);
        let others = others.iter().map(|&i| Literal::usize_unsuffixed(i));
        quote!(#evaluate ::symplectic::copy_to(velocity, #first, [#(#others),*]);)
    }

    fn sweep(&self) -> TokenStream {
        if self.coupled.is_empty() {
            return quote!(::symplectic::Change::default());
        }
        // Each kind sees the newest of the kind before it, which converges in fewer sweeps than all
        // stage values from all old evaluations.
        let rank = |node: &Node| match node {
            Node::Position(_) => 0,
            Node::Force(_) => 1,
            Node::Momentum(_) => 2,
            Node::Velocity(_) => 3,
        };
        let mut nodes = self.coupled.clone();
        nodes.sort_by_key(rank);
        let lines = nodes.iter().map(|&node| match value(self.graph, node) {
            Some(value) if !value.is_start() => {
                let (stage, base) = (slot(node), base(node));
                let (coefficients, terms) = terms(node, &value.coefficients);
                let change = identifier(if matches!(node, Node::Position(_)) { "q" } else { "p" });
                quote!(::symplectic::relax(&mut #stage, #base, step.size, #coefficients, #terms, &mut change.#change);)
            }
            _ => self.compute(node),
        });
        quote! {
            let ::symplectic::Stages { q, p, velocity, force } = stages;
            let mut change = ::symplectic::Change::default();
            #(#lines)*
            change
        }
    }

    fn finish(&self) -> TokenStream {
        let mut lines: Vec<TokenStream> = Vec::new();
        // A stage that is the result is computed as the result, once.
        let is_result = |node: &Node| self.is_aliased(*node);
        for &node in &self.finish {
            lines.push(if is_result(&node) {
                self.result(node)
            } else {
                self.compute(node)
            });
        }
        for result in [Node::Position(0), Node::Momentum(0)] {
            let same_kind = |node: &&Node| {
                matches!(
                    (node, result),
                    (Node::Position(_), Node::Position(_)) | (Node::Momentum(_), Node::Momentum(_))
                )
            };
            if !self.finish.iter().filter(same_kind).any(is_result) {
                lines.push(self.result(result));
            }
        }
        quote!(#(#lines)*)
    }

    /// The line that writes the result of the step, for positions or momenta.
    fn result(&self, kind: Node) -> TokenStream {
        let (out, evaluations) = match kind {
            Node::Momentum(_) => (identifier("p1"), &self.graph.forces),
            _ => (identifier("q1"), &self.graph.velocities),
        };
        let weights: Vec<Number<'_>> = evaluations
            .iter()
            .map(|evaluation| evaluation.weight.clone())
            .collect();
        let (coefficients, terms) = terms(kind, &weights);
        let base = base(kind);
        quote!(::symplectic::combine(#out, #base, step.size, #coefficients, #terms);)
    }

    /// Whether a stage value is never stored because it is the result of the step.
    fn is_aliased(&self, node: Node) -> bool {
        self.finish.contains(&node)
            && value(self.graph, node).is_some_and(|value| value.is_end && !value.is_start())
    }

    /// The line that computes a stage value or an evaluation.
    fn compute(&self, node: Node) -> TokenStream {
        match value(self.graph, node) {
            Some(value) if value.is_start() => TokenStream::new(),
            Some(value) => {
                let (stage, base) = (slot(node), base(node));
                let (coefficients, terms) = terms(node, &value.coefficients);
                quote!(::symplectic::combine(&mut #stage, #base, step.size, #coefficients, #terms);)
            }
            None => {
                let evaluation = evaluation(self.graph, node);
                let argument = |index: Option<usize>, kind: fn(usize) -> Node| match index {
                    Some(index) => self.argument(kind(index)),
                    // Separable: this argument is not read.
                    None => base(kind(0)),
                };
                let q = argument(evaluation.position, Node::Position);
                let p = argument(evaluation.momentum, Node::Momentum);
                let evaluate = self.evaluate(node, &q, &p);
                if self.carried().iter().any(|(first, _)| *first == node) {
                    quote!(if !carried { #evaluate })
                } else {
                    evaluate
                }
            }
        }
    }

    fn evaluate(&self, node: Node, q: &TokenStream, p: &TokenStream) -> TokenStream {
        let function = evaluation_name(node);
        let out = slot(node);
        let time = literal::coefficient(&evaluation(self.graph, node).time);
        quote!(system.#function(step.at(#time), #q, #p, &mut #out);)
    }

    /// A stage value as an argument: the start of the step, its result, or where it is stored.
    fn argument(&self, node: Node) -> TokenStream {
        let start = value(self.graph, node).is_some_and(StageValue::is_start);
        match node {
            _ if start => base(node),
            Node::Position(_) if self.is_aliased(node) => quote!(q1),
            Node::Momentum(_) if self.is_aliased(node) => quote!(p1),
            _ => {
                let stage = slot(node);
                quote!(&#stage)
            }
        }
    }

    /// Evaluations at the start of the step that are the same as one at the end of the previous step.
    fn carried(&self) -> Vec<(Node, Node)> {
        let forces = (0..self.graph.forces.len()).map(Node::Force);
        let velocities = (0..self.graph.velocities.len()).map(Node::Velocity);
        let nodes: Vec<Node> = forces.chain(velocities).collect();
        let sees_only = |node: Node, accept: &dyn Fn(Node) -> bool, time: i64| {
            let evaluation = evaluation(self.graph, node);
            let arguments = evaluation
                .position
                .map(Node::Position)
                .into_iter()
                .chain(evaluation.momentum.map(Node::Momentum));
            arguments.into_iter().all(accept) && evaluation.time.equals(&ratio(time, 1))
        };
        let at_start = |node: Node| value(self.graph, node).is_some_and(StageValue::is_start);
        let first = nodes
            .iter()
            .filter(|&&node| self.begin.contains(&node) && sees_only(node, &at_start, 0));
        let mut carried: Vec<(Node, Node)> = Vec::new();
        for &first in first {
            let is_last = |node: &&Node| {
                evaluation_name(**node) == evaluation_name(first)
                    && self.finish.contains(node)
                    && sees_only(**node, &|n| self.is_aliased(n), 1)
                    // An evaluation can take the place of one other only.
                    && carried.iter().all(|(_, taken)| taken != *node)
            };
            if let Some(&last) = nodes.iter().find(is_last) {
                carried.push((first, last));
            }
        }
        carried
    }

    fn carry(&self) -> TokenStream {
        let carried = self.carried();
        if carried.is_empty() {
            return quote!(false);
        }
        let swaps = carried.iter().map(|&(first, last)| {
            let name = evaluation_name(first);
            let [first, last] = [first, last].map(|node| Literal::usize_unsuffixed(index(node)));
            quote!(stages.#name.swap(#first, #last);)
        });
        quote!(#(#swaps)* true)
    }
}

fn value<'g, 'a>(graph: &'g StepGraph<'a>, node: Node) -> Option<&'g StageValue<'a>> {
    match node {
        Node::Position(i) => graph.positions.get(i),
        Node::Momentum(i) => graph.momenta.get(i),
        Node::Force(_) | Node::Velocity(_) => None,
    }
}

fn evaluation<'g, 'a>(graph: &'g StepGraph<'a>, node: Node) -> &'g Evaluation<'a> {
    match node {
        Node::Position(i) | Node::Force(i) => &graph.forces[i],
        Node::Momentum(i) | Node::Velocity(i) => &graph.velocities[i],
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
fn base(node: Node) -> TokenStream {
    match node {
        Node::Momentum(_) | Node::Force(_) => quote!(step.p),
        Node::Position(_) | Node::Velocity(_) => quote!(step.q),
    }
}

fn evaluation_name(node: Node) -> Ident {
    identifier(match node {
        Node::Force(_) | Node::Position(_) => "force",
        Node::Velocity(_) | Node::Momentum(_) => "velocity",
    })
}

/// The coefficients that are not zero and the evaluations that they belong to.
fn terms(node: Node, coefficients: &[Number<'_>]) -> (TokenStream, TokenStream) {
    let kind = match node {
        Node::Momentum(_) => Node::Force,
        _ => Node::Velocity,
    };
    let nonzero: Vec<usize> = (0..coefficients.len())
        .filter(|&j| !coefficients[j].is_zero())
        .collect();
    let values = nonzero
        .iter()
        .map(|&j| literal::coefficient(&coefficients[j]));
    let evaluations = nonzero.iter().map(|&j| slot(kind(j)));
    (quote!([#(#values),*]), quote!([#(&#evaluations),*]))
}
