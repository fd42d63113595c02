//! Functions for what is conserved.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::Emitter;
use super::names::identifier;
use crate::formula::description::momenta;
use crate::formula::graph::Id;

impl Emitter<'_> {
    /// Functions for what is conserved.
    pub(super) fn invariants(&mut self) -> TokenStream {
        let mut code = TokenStream::new();
        for invariant in self.system.invariants.clone() {
            let how = match invariant.proved {
                true => "which the exact flow conserves: H has the symmetry",
                false => "said to be conserved, and not refuted at a few states",
            };
            let what = format!(" `{}`, {how}.", invariant.name);
            code.extend(self.function(&invariant.name, &what, &invariant.parts, invariant.scalar));
        }
        let own = |name: &str| {
            self.system
                .invariants
                .iter()
                .any(|invariant| invariant.name == name)
                || self
                    .system
                    .parameters
                    .iter()
                    .any(|parameter| parameter.name == name)
        };
        let found = momenta(&self.system, self.structure);
        let found: Vec<_> = found.into_iter().filter(|(name, _)| !own(name)).collect();
        for (name, kind) in found {
            let parts = kind.parts(&mut self.system);
            let what = format!(
                " The {}, which the exact flow conserves: H has the symmetry.",
                name.replace('_', " ")
            );
            let known = self
                .system
                .invariants
                .iter()
                .any(|invariant| invariant.parts == parts);
            if !known {
                code.extend(self.function(name, &what, &parts, parts.len() == 1));
            }
        }
        if code.is_empty() {
            return code;
        }
        let [generics, _, arguments] = self.generics();
        let name = &self.header.name;
        quote! {
            #[allow(unused_variables, non_snake_case, clippy::all)]
            impl #generics #name #arguments {
                #code
            }
        }
    }

    pub(super) fn function(
        &self,
        name: &str,
        what: &str,
        parts: &[Id],
        alone: bool,
    ) -> TokenStream {
        let name = identifier(name);
        let scalar = &self.scalar;
        let over = self.vector(&quote!(#scalar));
        let nan = vec![quote!(#scalar::from_f64(f64::NAN)); parts.len()];
        let outside = match alone {
            true => quote!(return #(#nan)*;),
            false => quote!(return [#(#nan),*];),
        };
        let values = self.values(&["q", "p"], parts, outside);
        let (result, finish) = match alone {
            true => (quote!(#scalar), quote!(result_1)),
            false => {
                let count = Literal::usize_unsuffixed(parts.len());
                let names = (1..=parts.len()).map(|k| format_ident!("result_{k}"));
                (quote!([#scalar; #count]), quote!([#(#names),*]))
            }
        };
        let timed = parts
            .iter()
            .any(|&part| self.system.graph.depends(part).time);
        let time = timed.then(|| quote!(time: #scalar,));
        quote! {
            #[doc = #what]
            pub fn #name<#scalar: Scalar>(&self, #time q: &#over, p: &#over) -> #result {
                #values
                #finish
            }
        }
    }
}
