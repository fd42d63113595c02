//! The bandwidth of the second derivatives.

use std::collections::BTreeSet;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::Emitter;
use super::names::identifier;
use crate::distance::{Distance, distance};
use crate::graph::Coordinate;

impl Emitter<'_> {
    /// The method `half_bandwidth` for second derivatives in these rows and columns; empty if an entry can be anywhere.
    pub(super) fn half_bandwidth<'p>(
        &self,
        places: impl Iterator<Item = [&'p Coordinate; 2]>,
    ) -> TokenStream {
        let (mut known, mut lists) = (0, BTreeSet::new());
        let places: BTreeSet<_> = places.collect();
        for places in places {
            match distance(&self.system, places) {
                Some(Distance::Number(distance)) => known = known.max(distance),
                Some(Distance::OfPairs {
                    list,
                    components,
                    more,
                }) => {
                    lists.insert((list, components, more));
                }
                None => return TokenStream::new(),
            }
        }
        let known = Literal::u64_unsuffixed(known);
        let lists = lists.into_iter().map(|(list, components, more)| {
            let list = identifier(&self.system.parameters[list].name);
            let [components, more] = [components, more].map(Literal::u64_unsuffixed);
            quote! {
                .chain(self.#list.iter().map(|&(k, l)| k.abs_diff(l).saturating_mul(#components).saturating_add(#more)))
            }
        });
        let lists: Vec<_> = lists.collect();
        let half_bandwidth = match lists.as_slice() {
            [] => quote!(#known),
            lists => quote!(::core::iter::once(#known) #(#lists)* .fold(0, usize::max)),
        };
        quote! {
            #[allow(non_snake_case, clippy::all)]
            fn half_bandwidth(&self) -> usize {
                #half_bandwidth
            }
        }
    }
}
