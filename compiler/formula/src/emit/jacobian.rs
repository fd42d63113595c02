//! The second derivatives of H.

use num_traits::One;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::Emitter;
use super::block::{Task, Write, Writer};
use super::names::index_tokens;
use crate::Layout;
use crate::derivative::{Scatter, gradient};
use crate::graph::{Coordinate, Half, Id, LoopId, Node, Number};
use crate::operations::Operations;
use crate::structure::Split;

/// Greatest number of second derivatives that are written out. With more, the Jacobian is left to dual numbers and differences.
const MAX_PARTS: usize = 2_000;

impl Emitter<'_> {
    /// The second derivatives and their bandwidth, for Newton's iteration: methods of the trait.
    pub(super) fn jacobian(&mut self, split: Option<Split>) -> TokenStream {
        let (scalar, bound) = (self.scalar.clone(), self.bound.clone());
        let over = self.vector(&quote!(#scalar));
        let energy = self.system.energy;
        // The matrix, H or its part, the sign, the half of the row and that of the column.
        let blocks = match split {
            Some(split) => vec![
                ("velocity_by_momentum", split.kinetic, 1, Half::P, Half::P),
                ("force_by_position", split.potential, -1, Half::Q, Half::Q),
            ],
            None => vec![
                ("velocity_by_momentum", energy, 1, Half::P, Half::P),
                ("velocity_by_position", energy, 1, Half::P, Half::Q),
                ("force_by_position", energy, -1, Half::Q, Half::Q),
            ],
        };
        let mut parts: Vec<(&str, Coordinate, Scatter)> = Vec::new();
        for (matrix, of, sign, row, column) in blocks {
            let sign = Number::from_integer(sign.into());
            for first in gradient(&mut self.system.graph, of, &[], sign, row) {
                if parts.len() > MAX_PARTS {
                    break;
                }
                let loops: Vec<LoopId> = first.loops.clone();
                for second in gradient(
                    &mut self.system.graph,
                    first.value,
                    &loops,
                    Number::one(),
                    column,
                ) {
                    parts.push((matrix, first.target.clone(), second));
                }
            }
        }
        for applied in self.system.applied.clone() {
            let matrices = [
                ("force_by_position", Half::Q),
                ("applied_force_by_momentum", Half::P),
            ];
            for (matrix, column) in matrices {
                let (value, loops) = (applied.value, &applied.loops);
                let all = gradient(&mut self.system.graph, value, loops, Number::one(), column);
                let target = &applied.target;
                parts.extend(
                    all.into_iter()
                        .map(|second| (matrix, target.clone(), second)),
                );
            }
        }
        let third = |id: &Id| {
            let nodes = self.system.graph.below([*id]);
            nodes
                .iter()
                .any(|&id| matches!(self.system.graph.node(id), Node::User(_, 3.., _)))
        };
        if parts.len() > MAX_PARTS || parts.iter().any(|(_, _, part)| third(&part.value)) {
            return TokenStream::new();
        }
        let roots: Vec<Id> = parts.iter().map(|(_, _, part)| part.value).collect();
        let operations = Operations::new(&self.system.graph, &roots);
        let views = self.views(&["q", "p"], &[]);
        let nan =
            quote!(jacobian.force_by_position.set(0, 0, #scalar::from_f64(f64::NAN)); return true;);
        let least = self.least(&nan);
        let tasks = parts.iter().map(|(matrix, row, part)| {
            let matrix = format_ident!("{matrix}");
            let [row, column] = [row, &part.target].map(|place| self.place(place));
            let write: Write =
                Box::new(move |value| quote!(jacobian.#matrix.add(#row, #column, #value);));
            Task {
                loops: part.loops.clone(),
                value: operations.of(part.value),
                write,
                fixed: false,
            }
        });
        let writer = Writer::new(&self.system, &operations, scalar.clone(), &self.prefix, nan);
        let statements = writer.write(&tasks.collect::<Vec<_>>());
        let places = parts.iter().map(|(_, row, part)| [row, &part.target]);
        let half_bandwidth = self.half_bandwidth(places);
        quote! {
            ::symplectic::emitted::if_alloc! {
                fn second_derivatives<#scalar: #bound>(&self, time: #scalar, q: &#over, p: &#over, jacobian: &mut ::symplectic::system::Jacobian<#scalar>) -> bool {
                    #views #least #statements
                    true
                }
            }

            #half_bandwidth
        }
    }

    /// The index of a component in the whole vector.
    pub(super) fn place(&self, coordinate: &Coordinate) -> TokenStream {
        let index = index_tokens(&coordinate.index);
        match self.system.layout {
            Layout::Numbered(_, Some(components)) => {
                let component = Literal::usize_unsuffixed(coordinate.component);
                let components = Literal::usize_unsuffixed(components);
                let index = match coordinate.index.offset {
                    0 => index,
                    _ => quote!((#index)),
                };
                quote!(#index * #components + #component)
            }
            _ => index,
        }
    }
}
