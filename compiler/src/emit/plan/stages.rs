//! Steps whose stages are stored: coupled ones, and explicit ones that are not splittings.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::dense_output::StagePolynomials;
use super::super::facts::Known;
use super::increments::Form;
use super::matrices::Matrices;
use super::{Bodies, base, evaluation_name, index, literal, predictor, slot, start};
use crate::schedule::{Class, Node, Phases, StageValue, StepGraph};

/// A step that stores its stages.
pub(super) struct Stored<'g, 'a> {
    graph: &'g StepGraph<'a>,
    form: Form,
    known: &'g Known,
    phases: Phases<'g, 'a>,
    /// Evaluations at the start of the step that equal one at the end of the previous step.
    carried: Vec<(Node, Node)>,
}

impl<'g, 'a> Stored<'g, 'a> {
    pub(super) fn new(graph: &'g StepGraph<'a>, form: Form, known: &'g Known) -> Self {
        let phases = Phases::new(graph);
        Stored {
            graph,
            form,
            known,
            carried: phases.carried(),
            phases,
        }
    }

    /// The code of the step.
    pub(super) fn bodies(&self) -> Bodies {
        let forces = literal::count(self.graph.forces.len());
        let velocities = literal::count(self.graph.velocities.len());
        let slots = quote!(let ::symplectic::emitted::Stages { q, p, velocity, force } = stages;);
        let [begin, sweep] = [self.begin(), self.sweep()];
        let [increments, finish] = [self.increments(), self.finish()];
        let evaluations = |nodes: &[Node]| {
            nodes
                .iter()
                .filter(|&&node| self.graph.value(node).is_none())
                .count()
        };
        let starts = usize::from(!self.coupled_of_kind(Node::Velocity(0)).is_empty());
        Bodies {
            coupling: if self.phases.coupled.is_empty() {
                "Explicit"
            } else {
                "Coupled"
            },
            stages: quote!(::symplectic::emitted::Stages<V, #forces, #velocities>),
            begin: quote!(#slots #begin),
            sweep: quote!(#slots #sweep),
            increments: (!increments.is_empty()).then(|| quote!(#slots #increments)),
            finish: quote!(#slots #finish),
            counts: [
                evaluations(&self.phases.begin),
                starts,
                evaluations(&self.phases.coupled),
                evaluations(&self.phases.finish),
            ],
            carried: self.carried.len(),
        }
    }

    /// All stages as the matrices of the type of this name, if they are coupled.
    pub(super) fn matrices(
        &self,
        name: &Ident,
        polynomials: Option<&StagePolynomials<'_, '_>>,
    ) -> Option<TokenStream> {
        let coupled = !self.phases.coupled.is_empty();
        coupled.then(|| {
            let carried: Vec<Node> = self.carried.iter().map(|&(_, last)| last).collect();
            let matrices = Matrices {
                graph: self.graph,
                form: &self.form,
                known: self.known,
                polynomials,
            };
            matrices.code(name, &carried)
        })
    }

    /// The coupled nodes of the kind of a node.
    fn coupled_of_kind(&self, kind: Node) -> Vec<Node> {
        let same = |node: &&Node| std::mem::discriminant(*node) == std::mem::discriminant(&kind);
        self.phases.coupled.iter().filter(same).copied().collect()
    }

    fn begin(&self) -> TokenStream {
        let explicit = self.phases.begin.iter().map(|&node| self.compute(node));
        let (extrapolated, initial) = (self.extrapolated(), self.initial());
        let start = match extrapolated {
            Some(extrapolated) => quote!(if kept.stages { #extrapolated } else { #initial }),
            None => initial,
        };
        quote!(#(#explicit)* #start)
    }

    /// Starting approximations from the start of the step alone: one velocity for all stages, the positions that follow from it,
    /// and the other coupled stages there.
    fn initial(&self) -> TokenStream {
        let momenta = self.coupled_of_kind(Node::Momentum(0)).into_iter();
        let momenta = momenta.filter(|&node| {
            let value = self.graph.value(node);
            value.is_some_and(|value| !value.is_start())
        });
        let momenta = momenta.map(Form::reset);
        let velocities = self.coupled_of_kind(Node::Velocity(0));
        let Some((&first, others)) = velocities.split_first() else {
            return quote!(#(#momenta)*);
        };
        let evaluate = self.evaluate(first, &quote!(step.q), &quote!(step.p));
        let copies = (!others.is_empty()).then(|| {
            let first = literal::count(index(first));
            let others = others.iter().map(|&node| literal::count(index(node)));
            quote!(::symplectic::emitted::copy_to(velocity, #first, [#(#others),*]);)
        });
        let increments = velocities.iter().map(|&node| self.increment(node));
        let positions = self.stages_of_kind(Node::Position(0));
        quote!(#(#momenta)* #evaluate #copies #(#increments)* #positions)
    }

    /// Starting approximations from the increments of the previous step: those of the velocities and, if forces depend on
    /// the momenta, those of the forces too. `None` if there is no extrapolation.
    fn extrapolated(&self) -> Option<TokenStream> {
        let Form::Increments(_) = self.form else {
            return None;
        };
        let velocities = self.transform(Node::Velocity(0))?;
        let positions = self.stages_of_kind(Node::Position(0));
        if self.graph.class == Class::Separable {
            return Some(quote!(#velocities #positions));
        }
        let forces = self.transform(Node::Force(0))?;
        let momenta = self.stages_of_kind(Node::Momentum(0));
        Some(quote!(#velocities #positions #forces #momenta))
    }

    /// The lines that compute the coupled stages of one kind from the current evaluations.
    fn stages_of_kind(&self, kind: Node) -> TokenStream {
        let nodes = self.coupled_of_kind(kind);
        let lines = nodes.iter().map(|&node| self.compute(node));
        quote!(#(#lines)*)
    }

    /// The line that extrapolates the increments of one kind to the next step.
    fn transform(&self, kind: Node) -> Option<TokenStream> {
        let nodes = self.coupled_of_kind(kind);
        if nodes.is_empty() {
            return Some(TokenStream::new());
        }
        let evaluations: Vec<_> = nodes
            .iter()
            .map(|&node| self.graph.evaluation(node))
            .collect();
        let matrix = predictor::matrix(self.graph, kind, &evaluations, self.known)?;
        let rows = matrix.iter().map(|row| literal::array(row));
        let indices = nodes.iter().map(|&node| literal::count(index(node)));
        let array = evaluation_name(kind);
        Some(quote!(::symplectic::emitted::transform(#array, [#(#indices),*], [#(#rows),*]);))
    }

    fn sweep(&self) -> TokenStream {
        if self.phases.coupled.is_empty() {
            return quote!(::symplectic::emitted::StageChange::default());
        }
        // Each kind uses the newest values of the previous kind (Gauss–Seidel), which converges in fewer sweeps than
        // computing all stage values from old evaluations. The positions come last: their change measures what
        // the next sweep would gain.
        let rank = |node: &Node| match node {
            Node::Force(_) => 0,
            Node::Momentum(_) => 1,
            Node::Velocity(_) => 2,
            Node::Position(_) => 3,
        };
        let mut nodes = self.phases.coupled.clone();
        nodes.sort_by_key(rank);
        let weights = [
            (&self.graph.forces, Node::Force(0)),
            (&self.graph.velocities, Node::Velocity(0)),
        ];
        let weights = (weights.into_iter())
            .filter(|&(_, kind)| !self.coupled_of_kind(kind).is_empty())
            .map(|(evaluations, kind)| self.form.weights(evaluations, kind));
        let lines = nodes.iter().map(|&node| match self.graph.value(node) {
            Some(value) if !value.is_start() => {
                let (stage, base) = (slot(node), base(node));
                let sum = (self.form).sum(self.graph, node, |term| self.is_swept(term));
                let change = literal::identifier(match node {
                    Node::Position(_) => "q",
                    _ => "p",
                });
                quote!(::symplectic::emitted::relax::<R, V, _>(&mut #stage, #base, #sum, &mut change.#change);)
            }
            Some(_) => TokenStream::new(),
            None => {
                let evaluation = self.graph.evaluation(node);
                let increment = self.form.increment_in_sweep(evaluation, node);
                self.evaluation(node, &increment)
            }
        });
        quote! {
            let mut change = ::symplectic::emitted::StageChange::default();
            #(#weights)*
            #(#lines)*
            change
        }
    }

    /// The lines that scale the evaluations of sweeps to increments.
    fn increments(&self) -> TokenStream {
        let nodes = self.phases.coupled.iter().copied();
        let lines = nodes.filter(|&node| self.is_swept(node));
        let lines = lines.map(|node| self.increment(node));
        quote!(#(#lines)*)
    }

    /// Whether a node is an evaluation that sweeps make and that becomes an increment at the end.
    fn is_swept(&self, node: Node) -> bool {
        let evaluation = self.graph.value(node).is_none();
        evaluation && self.phases.coupled.contains(&node) && !self.is_kept(node)
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
                let sum = self.form.sum(self.graph, node, |_| false);
                quote!(::symplectic::emitted::combine::<R, V, _>(&mut #stage, #base, #sum);)
            }
            None => self.evaluation(node, &self.increment(node)),
        }
    }

    /// The lines that make an evaluation and its `increment`.
    fn evaluation(&self, node: Node, increment: &TokenStream) -> TokenStream {
        let evaluation = self.graph.evaluation(node);
        let argument = |index: Option<usize>, kind: fn(usize) -> Node| match index {
            Some(index) => self.argument(kind(index)),
            // Separable: this argument is not read.
            None => start(kind(0)),
        };
        let q = argument(evaluation.position, Node::Position);
        let p = argument(evaluation.momentum, Node::Momentum);
        if let Some(&(_, last)) = self.carried.iter().find(|(first, _)| *first == node) {
            // The evaluation stays where the previous step left it, and its increment goes to its own place.
            let evaluate = self.evaluate_into(node, last, &q, &p);
            let array = evaluation_name(node);
            let [from, to] = [last, node].map(|node| literal::count(index(node)));
            return quote! {
                if !kept.evaluation { #evaluate }
                ::symplectic::emitted::copy_to(#array, #from, [#to]);
                #increment
            };
        }
        let evaluate = self.evaluate(node, &q, &p);
        let increment = (!self.is_kept(node)).then_some(increment);
        quote!(#evaluate #increment)
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
