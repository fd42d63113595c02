//! Steps whose stages are stored: coupled ones, and explicit ones that are not splittings.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::dense_output::StagePolynomials;
use super::super::facts::Known;
use super::increments::Form;
use super::matrices::Matrices;
use super::{Bodies, base, evaluation_name, index, literal, slot, start};
use crate::schedule::{Node, Phases, StageValue, StepGraph};

/// A step that stores its stages.
pub(super) struct Stored<'g, 'a> {
    pub(super) graph: &'g StepGraph<'a>,
    pub(super) form: Form,
    pub(super) known: &'g Known,
    pub(super) phases: Phases<'g, 'a>,
    /// The graph of the separable class, if the code is for both classes.
    pub(super) separable: Option<&'g StepGraph<'a>>,
    /// Evaluations at the start of the step that equal one at the end of the previous step.
    carried: Vec<(Node, Node)>,
}

impl<'g, 'a> Stored<'g, 'a> {
    /// The step of a graph.
    pub(super) fn new(graph: &'g StepGraph<'a>, known: &'g Known) -> Self {
        let phases = Phases::new(graph);
        Stored {
            graph,
            form: Form::new(graph, known),
            known,
            separable: None,
            carried: phases.carried(),
            phases,
        }
    }

    /// One step for both classes, if their stages are coupled in the same way.
    pub(super) fn for_both(
        [general, separable]: [&'g StepGraph<'a>; 2],
        known: &'g Known,
        polynomials: Option<&StagePolynomials<'_, '_>>,
    ) -> Option<Self> {
        if !general.has_the_stages_of(separable) {
            return None;
        }
        let [step, other] = [general, separable].map(|graph| Stored::new(graph, known));
        let same = step.phases.coupled == other.phases.coupled
            && step.phases.begin == other.phases.begin
            && step.phases.finish == other.phases.finish
            && step.carried == other.carried
            && step.extrapolated().is_some() == other.extrapolated().is_some()
            && !step.phases.coupled.is_empty();
        let halves = |step: &Self| step.matrices_of(polynomials).halves();
        (same && halves(&step) == halves(&other)).then_some(Stored {
            separable: Some(separable),
            ..step
        })
    }

    /// The code of the step.
    pub(super) fn bodies(&self) -> Bodies {
        let with_slots = |code: TokenStream| match code.is_empty() {
            true => code,
            false => quote! {
                let emitted::Stages { q, p, velocity, force } = &mut *stages;
                #code
            },
        };
        let [begin, finish] = [self.begin(), self.finish()].map(with_slots);
        let extrapolated = self.extrapolated();
        let starting_values = self.starting_values(extrapolated.as_ref());
        let forces = literal::count(self.graph.forces.len());
        let velocities = literal::count(self.graph.velocities.len());
        let increments = self.increments();
        let evaluations = |nodes: &[Node]| {
            nodes
                .iter()
                .filter(|&&node| self.graph.value(node).is_none())
                .count()
        };
        let is_velocity = |node: &Node| matches!(node, Node::Velocity(_));
        let starts = usize::from(self.phases.coupled.iter().any(is_velocity));
        // Without extrapolation every step starts with an evaluation.
        let (always, starts) = match extrapolated {
            Some(_) => (0, starts),
            None => (starts, 0),
        };
        Bodies {
            coupling: if self.phases.coupled.is_empty() {
                "Explicit"
            } else {
                "Coupled"
            },
            stages: quote!(emitted::Stages<V, #forces, #velocities>),
            constants: self.constants(),
            coupled: self.coupled(),
            begin: quote!(#begin #starting_values),
            increments: (!increments.is_empty()).then_some(increments),
            finish,
            counts: [
                evaluations(&self.phases.begin) + always,
                starts,
                evaluations(&self.phases.coupled),
                evaluations(&self.phases.finish),
            ],
            carried: self.carried.len(),
        }
    }

    /// All stages as the matrices of a type with these generic parameters, if they are coupled.
    pub(super) fn matrices(
        &self,
        generics: &TokenStream,
        name: &TokenStream,
        polynomials: Option<&StagePolynomials<'_, '_>>,
    ) -> Option<TokenStream> {
        let coupled = !self.phases.coupled.is_empty();
        coupled.then(|| {
            let carried: Vec<Node> = self.carried.iter().map(|&(_, last)| last).collect();
            let matrices = self.matrices_of(polynomials);
            matrices.code(generics, name, &carried)
        })
    }

    fn matrices_of<'m, 'n, 'p>(
        &'m self,
        polynomials: Option<&'m StagePolynomials<'n, 'p>>,
    ) -> Matrices<'m, 'a, 'n, 'p> {
        Matrices {
            graph: self.graph,
            separable: self.separable,
            form: &self.form,
            known: self.known,
            polynomials,
        }
    }

    fn begin(&self) -> TokenStream {
        let explicit = self.phases.begin.iter().map(|&node| self.compute(node));
        quote!(#(#explicit)*)
    }

    fn finish(&self) -> TokenStream {
        let mut lines: Vec<TokenStream> = Vec::new();
        // A stage that equals the result is computed as the result, once.
        for &node in &self.phases.finish {
            lines.push(if self.phases.is_aliased(node) {
                self.result(node)
            } else {
                self.compute(node)
            });
        }
        for result in [Node::Position(0), Node::Momentum(0)] {
            let same = std::mem::discriminant(&result);
            let mut stages = self.phases.finish.iter();
            if !stages
                .any(|node| std::mem::discriminant(node) == same && self.phases.is_aliased(*node))
            {
                lines.push(self.result(result));
            }
        }
        quote!(#(#lines)*)
    }

    /// The lines that write the result of the step, for positions or momenta.
    fn result(&self, kind: Node) -> TokenStream {
        let evaluations = match kind {
            Node::Momentum(_) => &self.graph.forces,
            _ => &self.graph.velocities,
        };
        let term = super::terms_of(kind);
        let (late, early): (Vec<usize>, Vec<usize>) =
            (0..evaluations.len()).partition(|&j| self.is_kept(term(j)));
        let total = self.form.total(evaluations, kind, |j| early.contains(&j));
        let late = late.iter().map(|&j| Form::late(&evaluations[j], term(j)));
        quote!(#total #(#late)*)
    }

    /// The line that computes a stage value or an evaluation.
    fn compute(&self, node: Node) -> TokenStream {
        match self.graph.value(node) {
            Some(value) if value.is_start() => TokenStream::new(),
            Some(_) => {
                let (stage, base) = (slot(node), base(node));
                let sum = self.form.sum(self.graph, node);
                quote!(emitted::combine::<R, V, _>(&mut #stage, #base, #sum);)
            }
            None => self.evaluation(node, &self.increment(node)),
        }
    }

    /// The lines that make an evaluation and its `increment`.
    fn evaluation(&self, node: Node, increment: &TokenStream) -> TokenStream {
        let [q, p] = self.arguments(node);
        if let Some(&(_, last)) = self.carried.iter().find(|(first, _)| *first == node) {
            // The evaluation stays where the previous step left it, and its increment goes to its own place.
            let evaluate = self.evaluate_into(node, last, &q, &p);
            let array = evaluation_name(node);
            let [from, to] = [last, node].map(|node| literal::count(index(node)));
            return quote! {
                if !kept.evaluation { #evaluate }
                emitted::copy_to(#array, #from, [#to]);
                #increment
            };
        }
        let evaluate = self.evaluate(node, &q, &p);
        let increment = (!self.is_kept(node)).then_some(increment);
        quote!(#evaluate #increment)
    }

    /// The position and the momentum of an evaluation.
    pub(super) fn arguments(&self, node: Node) -> [TokenStream; 2] {
        let evaluation = self.graph.evaluation(node);
        let argument = |index: Option<usize>, kind: fn(usize) -> Node| match index {
            Some(index) => self.argument(kind(index)),
            // Separable: this argument is not read.
            None => start(kind(0)),
        };
        [
            argument(evaluation.position, Node::Position),
            argument(evaluation.momentum, Node::Momentum),
        ]
    }

    fn increment(&self, node: Node) -> TokenStream {
        self.form.increment(self.graph.evaluation(node), node)
    }

    fn evaluate(&self, node: Node, q: &TokenStream, p: &TokenStream) -> TokenStream {
        self.evaluate_into(node, node, q, p)
    }

    /// The line that writes an evaluation into the place of another evaluation of its kind.
    fn evaluate_into(
        &self,
        node: Node,
        place: Node,
        q: &TokenStream,
        p: &TokenStream,
    ) -> TokenStream {
        let function = evaluation_name(node);
        let out = slot(place);
        let time = literal::coefficient(&self.graph.evaluation(node).time);
        quote!(system.#function(step.at(#time), #q, #p, &mut #out);)
    }

    /// A stage value as an argument: the start of the step, its result, or where it is stored.
    fn argument(&self, node: Node) -> TokenStream {
        let is_start = self.graph.value(node).is_some_and(StageValue::is_start);
        match node {
            _ if is_start => start(node),
            Node::Position(_) if self.phases.is_aliased(node) => quote!(&*q1),
            Node::Momentum(_) if self.phases.is_aliased(node) => quote!(&*p1),
            _ => {
                let stage = slot(node);
                quote!(&#stage)
            }
        }
    }

    /// Whether an evaluation is kept unscaled for the next step.
    fn is_kept(&self, node: Node) -> bool {
        self.carried.iter().any(|(_, last)| *last == node)
    }
}
