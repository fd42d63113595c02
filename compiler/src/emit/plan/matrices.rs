//! Coupled stages all together, as the matrices of a `StageTableau`.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::super::extension::{Extension, StagePolynomials};
use super::form::Form;
use super::second_order::SecondOrder;
use super::{decoupling, extrapolation, index, literal};
use crate::schedule::{Evaluation, Node, StepGraph};

/// The implementation of `StageTableau` for the plan of a step, a type of this name, in the memory of which the `carried`
/// evaluations are as they are.
pub(super) fn code(
    graph: &StepGraph<'_>,
    form: &Form,
    name: &Ident,
    carried: Vec<Node>,
    polynomials: Option<&StagePolynomials<'_, '_>>,
) -> TokenStream {
    let most = graph.forces.len().max(graph.velocities.len());
    let (lanes, width) = if most <= 4 {
        ("F64x4", 4)
    } else {
        ("F64x8", 8)
    };
    let groups = most.div_ceil(width);
    let positions: Vec<usize> = graph.forces.iter().filter_map(|e| e.position).collect();
    let momenta: Vec<usize> = graph.velocities.iter().filter_map(|e| e.momentum).collect();
    let position = |i: usize, j: usize| match form {
        Form::Increments(relative) => relative.positions[positions[i]][j].double,
        Form::Weighted => graph.positions[positions[i]].coefficients[j].to_f64(),
    };
    let momentum = |i: usize, j: usize| match form {
        Form::Increments(relative) => relative.momenta[momenta[i]][j].double,
        Form::Weighted => graph.momenta[momenta[i]].coefficients[j].to_f64(),
    };
    let lane_count = groups * width;
    // The last stage is repeated to fill the lanes.
    let fill = |count: usize, value: &dyn Fn(usize) -> f64| {
        let values: Vec<f64> = (0..lane_count).map(|i| value(i.min(count - 1))).collect();
        literal::array(&values)
    };
    let half = |evaluations: &[Evaluation<'_>],
                others: usize,
                entry: &dyn Fn(usize, usize) -> f64,
                polynomial: TokenStream| {
        let count = evaluations.len();
        let padded = |value: &dyn Fn(usize) -> f64| fill(count, value);
        let columns = (0..others).map(|j| padded(&|i| entry(i, j)));
        let times = padded(&|i| evaluations[i].time.to_f64());
        let weights = padded(&|i| evaluations[i].weight.to_f64());
        let matrix = match form {
            Form::Increments(_) => extrapolation::matrix(&evaluations.iter().collect::<Vec<_>>()),
            Form::Weighted => None,
        };
        let extrapolation = matrix.map(|rows| {
            let columns = (0..count).map(|j| padded(&|i| rows[i][j]));
            columns.collect::<Vec<_>>()
        });
        let extrapolation = extrapolation.unwrap_or_default();
        let count = literal::count(count);
        quote! {
            ::symplectic::HalfTableau {
                count: #count,
                columns: &[#(&#columns),*],
                times: &#times,
                weights: &#weights,
                extrapolation: &[#(&#extrapolation),*],
                polynomial: #polynomial,
            }
        }
    };
    let second_order = match SecondOrder::new(graph) {
        Some(SecondOrder { nodes, matrix }) => {
            let count = nodes.len();
            let columns = (0..count).map(|k| fill(count, &|i| matrix[i][k]));
            let rest = fill(count, &|i| 1.0 - nodes[i]);
            let nodes = fill(count, &|i| nodes[i]);
            quote! {
                ::core::option::Option::Some(::symplectic::SecondOrderTableau {
                    nodes: &#nodes,
                    columns: &[#(&#columns),*],
                    rest: &#rest,
                })
            }
        }
        None => quote!(::core::option::Option::None),
    };
    let (of_forces, of_velocities) = (Node::Force(0), Node::Velocity(0));
    let extension = |kind| polynomials?.extension(graph, kind, matches!(form, Form::Increments(_)));
    let [force_extension, velocity_extension] = [extension(of_forces), extension(of_velocities)];
    let polynomial = |extension: &Option<Extension>| match extension {
        Some(Extension { rows, order }) => {
            let rows = rows.iter().map(|row| literal::array(row));
            let order = Literal::usize_unsuffixed(*order);
            quote!(::core::option::Option::Some(::symplectic::StagePolynomial { legendre: &[#(&#rows),*], order: #order }))
        }
        None => quote!(::core::option::Option::None),
    };
    let force_polynomial = polynomial(&force_extension);
    // Where both halves are the same, the second is the first.
    let velocity_polynomial = if velocity_extension == force_extension {
        quote!(Self::POSITIONS.polynomial)
    } else {
        polynomial(&velocity_extension)
    };
    let position_half = half(
        &graph.forces,
        graph.velocities.len(),
        &position,
        force_polynomial,
    );
    let momentum_half = half(
        &graph.velocities,
        graph.forces.len(),
        &momentum,
        velocity_polynomial,
    );
    let carried = |kind: Node| {
        let same = std::mem::discriminant(&kind);
        let own = carried
            .iter()
            .filter(|&&node| std::mem::discriminant(&node) == same);
        let indices = own.map(|&node| literal::count(index(node)));
        quote!(&[#(#indices),*])
    };
    let (carried_forces, carried_velocities) = (carried(of_forces), carried(of_velocities));
    let lanes = literal::identifier(lanes);
    let groups = Literal::usize_unsuffixed(groups);
    let decoupling = decoupling::code(graph, &positions, &momenta);
    let increments = matches!(form, Form::Increments(_));
    quote! {
        impl ::symplectic::StageTableau for #name {
            type Lanes = ::symplectic::#lanes;
            type Groups<T: ::core::clone::Clone + ::core::fmt::Debug> = [T; #groups];

            const INCREMENTS: bool = #increments;
            const POSITIONS: ::symplectic::HalfTableau = #position_half;
            const MOMENTA: ::symplectic::HalfTableau = #momentum_half;
            const SECOND_ORDER: ::core::option::Option<::symplectic::SecondOrderTableau> = #second_order;
            #decoupling

            #[inline(always)]
            fn groups<T: ::core::clone::Clone + ::core::fmt::Debug>(
                make: impl ::core::ops::FnMut(usize) -> T,
            ) -> [T; #groups] {
                ::core::array::from_fn(make)
            }

            #[inline(always)]
            fn stored<V: ::symplectic::Vector>(stages: &Self::Stages<V>) -> [::symplectic::StoredEvaluations<'_, V>; 2] {
                [
                    ::symplectic::StoredEvaluations { values: &stages.velocity, carried: #carried_velocities },
                    ::symplectic::StoredEvaluations { values: &stages.force, carried: #carried_forces },
                ]
            }
        }
    }
}
