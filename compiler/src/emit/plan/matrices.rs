//! Coupled stages as the matrices of a `StageTableau`.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::super::dense_output::{Extension, StagePolynomials};
use super::super::facts::Known;
use super::increments::Form;
use super::nystrom::SecondOrder;
use super::{decoupling, index, literal, predictor};
use crate::schedule::{Evaluation, Node, StepGraph};

/// How many stages go into SIMD lanes.
struct Lanes {
    name: &'static str,
    groups: usize,
    width: usize,
}

impl Lanes {
    /// Lanes for the larger of the numbers of forces and velocities.
    fn new(graph: &StepGraph<'_>) -> Self {
        let most = graph.forces.len().max(graph.velocities.len());
        let (name, width) = match most {
            0..=2 => ("F64x2", 2),
            3..=4 => ("F64x4", 4),
            _ => ("F64x8", 8),
        };
        let groups = most.div_ceil(width);
        Lanes {
            name,
            groups,
            width,
        }
    }

    /// A value for each lane; the value of the last stage is repeated to fill the lanes.
    fn fill(&self, count: usize, value: impl Fn(usize) -> f64) -> Vec<f64> {
        let lanes = 0..self.groups * self.width;
        lanes.map(|i| value(i.min(count - 1))).collect()
    }
}

/// The stages of one kind from the evaluations of the other, with lanes for the stages.
#[derive(Debug, PartialEq)]
pub(in super::super) struct HalfTableau {
    count: usize,
    /// The column of each evaluation.
    columns: Vec<Vec<f64>>,
    times: Vec<f64>,
    weights: Vec<f64>,
    /// The columns of the matrix that maps this half's evaluations to those of the next step.
    extrapolation: Vec<Vec<f64>>,
    polynomial: Option<Extension>,
}

impl HalfTableau {
    fn code(&self) -> TokenStream {
        let arrays = |columns: &[Vec<f64>]| {
            let columns = columns.iter().map(|column| literal::array(column));
            quote!(&[#(&#columns),*])
        };
        let count = literal::count(self.count);
        let columns = arrays(&self.columns);
        let extrapolation = arrays(&self.extrapolation);
        let [times, weights] = [&self.times, &self.weights].map(|values| literal::array(values));
        let polynomial = match &self.polynomial {
            Some(Extension { rows, order }) => {
                let legendre = arrays(rows);
                let order = Literal::usize_unsuffixed(*order);
                quote!(::core::option::Option::Some(emitted::StagePolynomial { legendre: #legendre, order: #order }))
            }
            None => quote!(::core::option::Option::None),
        };
        quote! {
            emitted::HalfTableau {
                count: #count,
                columns: #columns,
                times: &#times,
                weights: &#weights,
                extrapolation: #extrapolation,
                polynomial: #polynomial,
            }
        }
    }
}

/// The data that the matrices are computed from.
pub(super) struct Matrices<'m, 'g, 'n, 'a> {
    pub(super) graph: &'m StepGraph<'g>,
    /// The graph of the separable class, if the matrices are for both classes.
    pub(super) separable: Option<&'m StepGraph<'g>>,
    pub(super) form: &'m Form,
    pub(super) known: &'m Known,
    pub(super) polynomials: Option<&'m StagePolynomials<'n, 'a>>,
}

impl Matrices<'_, '_, '_, '_> {
    /// The implementation of `StageTableau` for the plan of a step, a type with these generic parameters. Its memory keeps the
    /// `carried` evaluations unscaled.
    pub(super) fn code(
        &self,
        generics: &TokenStream,
        name: &TokenStream,
        carried: &[Node],
    ) -> TokenStream {
        let lanes = Lanes::new(self.graph);
        let [positions, momenta] = self.halves();
        let place = |half: &str| {
            let half = literal::identifier(half);
            quote!(<#name as emitted::StageTableau>::#half)
        };
        let momenta = match positions == momenta {
            true => quote!(Self::POSITIONS),
            false => (self.known).written(place("MOMENTA"), momenta, HalfTableau::code),
        };
        let positions = (self.known).written(place("POSITIONS"), positions, HalfTableau::code);
        let second_order = self.second_order(&lanes);
        let decoupling = self.decoupling();
        let carried = |kind: Node| {
            let same = std::mem::discriminant(&kind);
            let own = carried
                .iter()
                .filter(|&node| std::mem::discriminant(node) == same);
            let indices = own.map(|&node| literal::count(index(node)));
            quote!(&[#(#indices),*])
        };
        let [carried_forces, carried_velocities] = [Node::Force(0), Node::Velocity(0)].map(carried);
        let numbers = (0..lanes.groups).map(Literal::usize_unsuffixed);
        let groups = Literal::usize_unsuffixed(lanes.groups);
        let lanes = literal::identifier(lanes.name);
        let increments = self.increments();
        quote! {
            impl #generics emitted::StageTableau for #name {
                type Lanes = emitted::#lanes;
                type Groups<T: ::core::fmt::Debug> = [T; #groups];

                const INCREMENTS: bool = #increments;
                const POSITIONS: emitted::HalfTableau = #positions;
                const MOMENTA: emitted::HalfTableau = #momenta;
                const SECOND_ORDER: ::core::option::Option<emitted::SecondOrderTableau> = #second_order;
                #decoupling

                #[inline(always)]
                fn groups<T: ::core::fmt::Debug>(mut make: impl ::core::ops::FnMut(usize) -> T) -> [T; #groups] {
                    [#(make(#numbers)),*]
                }

                #[inline(always)]
                fn stored<V: emitted::Vector>(stages: &Self::Stages<V>) -> [emitted::StoredEvaluations<'_, V>; 2] {
                    stages.stored(#carried_velocities, #carried_forces)
                }
            }
        }
    }

    /// The `DECOUPLING` constant; empty if the systems do not decouple in any class.
    fn decoupling(&self) -> TokenStream {
        let own = decoupling::code(self.graph, self.known);
        let Some(separable) = self.separable else {
            return own.map_or_else(TokenStream::new, decoupling::constant);
        };
        let none = || quote!(::core::option::Option::None);
        match (own, decoupling::code(separable, self.known)) {
            (None, None) => TokenStream::new(),
            (general, separable) => {
                let [general, separable] =
                    [general, separable].map(|code| code.unwrap_or_else(none));
                decoupling::constant(quote!(if K::SEPARABLE { #separable } else { #general }))
            }
        }
    }

    fn increments(&self) -> bool {
        matches!(self.form, Form::Increments(_))
    }

    /// The positions at which forces are evaluated, and the momenta at which velocities are.
    pub(super) fn halves(&self) -> [HalfTableau; 2] {
        let graph = self.graph;
        let lanes = &Lanes::new(graph);
        let position = |i: usize, j: usize| {
            let value = graph.forces[i].position.unwrap_or_default();
            match self.form {
                Form::Increments(relative) => relative.positions[value][j].double,
                Form::Weighted => graph.positions[value].coefficients[j].to_f64(),
            }
        };
        let momentum = |i: usize, j: usize| {
            let value = graph.velocities[i].momentum.unwrap_or_default();
            match self.form {
                Form::Increments(relative) => relative.momenta[value][j].double,
                Form::Weighted => graph.momenta[value].coefficients[j].to_f64(),
            }
        };
        let (forces, velocities) = (&graph.forces, &graph.velocities);
        let columns = |count: usize, others: usize, entry: &dyn Fn(usize, usize) -> f64| {
            let column = |j| lanes.fill(count, |i| entry(i, j));
            (0..others).map(column).collect()
        };
        [
            self.half(
                lanes,
                (forces, Node::Force(0)),
                columns(forces.len(), velocities.len(), &position),
            ),
            self.half(
                lanes,
                (velocities, Node::Velocity(0)),
                columns(velocities.len(), forces.len(), &momentum),
            ),
        ]
    }

    /// The half with these evaluations at its stages; a node gives the kind of the stages.
    fn half(
        &self,
        lanes: &Lanes,
        (evaluations, kind): (&[Evaluation<'_>], Node),
        columns: Vec<Vec<f64>>,
    ) -> HalfTableau {
        let count = evaluations.len();
        let matrix = self.increments().then(|| {
            let evaluations: Vec<_> = evaluations.iter().collect();
            predictor::matrix(self.graph, kind, &evaluations, self.known)
        });
        let extrapolation = matrix.flatten().map(|rows| {
            let column = |j: usize| lanes.fill(count, |i| rows[i][j]);
            (0..count).map(column).collect()
        });
        let extension = |polynomials: &StagePolynomials<'_, '_>| {
            polynomials.extension(self.graph, kind, self.increments())
        };
        HalfTableau {
            count,
            columns,
            times: lanes.fill(count, |i| evaluations[i].time.to_f64()),
            weights: lanes.fill(count, |i| evaluations[i].weight.to_f64()),
            extrapolation: extrapolation.unwrap_or_default(),
            polynomial: self.polynomials.and_then(extension),
        }
    }

    /// The coefficients of a step of a second-order system; only symplectic methods have them.
    fn second_order(&self, lanes: &Lanes) -> TokenStream {
        let none = quote!(::core::option::Option::None);
        let graph = self.separable.unwrap_or(self.graph);
        let coefficients = self.increments().then(|| SecondOrder::new(graph));
        let Some(SecondOrder { nodes, matrix }) = coefficients.flatten() else {
            return none;
        };
        let count = nodes.len();
        let fill = |value: &dyn Fn(usize) -> f64| literal::array(&lanes.fill(count, value));
        let columns = (0..count).map(|k| fill(&|i| matrix[i][k]));
        let of_forces = (0..count).map(|k| {
            let weight = graph.forces[k].weight.to_f64();
            fill(&|i| matrix[i][k] * weight)
        });
        let nodes = fill(&|i| nodes[i]);
        quote! {
            ::core::option::Option::Some(emitted::SecondOrderTableau {
                nodes: &#nodes,
                columns: &[#(&#columns),*],
                of_forces: &[#(&#of_forces),*],
            })
        }
    }
}
