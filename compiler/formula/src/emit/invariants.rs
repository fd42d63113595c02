//! Functions for conserved quantities, and their observers.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::Emitter;
use super::names::identifier;
use crate::Layout;
use crate::description::{conserves_energy, momenta};
use crate::graph::Id;

/// A function for a conserved quantity.
struct Conserved {
    name: String,
    parts: Vec<Id>,
    /// Whether the value is a number and not an array.
    scalar: bool,
}

impl Emitter<'_> {
    /// Functions for conserved quantities, and observers of their values.
    pub(super) fn invariants(&mut self) -> TokenStream {
        let mut code = TokenStream::new();
        let mut conserved = Vec::new();
        for invariant in self.system.invariants.clone() {
            let how = match invariant.proved {
                true => "which the exact flow conserves: H has the symmetry",
                false => "said to be conserved, and not refuted at a few states",
            };
            let what = format!(" `{}`, {how}.", invariant.name);
            code.extend(self.function(&invariant.name, &what, &invariant.parts, invariant.scalar));
            conserved.push(Conserved {
                name: invariant.name,
                parts: invariant.parts,
                scalar: invariant.scalar,
            });
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
        let observed = !own("invariants");
        for (name, kind) in found {
            let parts = kind.parts(&mut self.system);
            let what = format!(
                " The {}{}, which the exact flow conserves: H has the symmetry.",
                name.replace('_', " "),
                kind.in_words(&self.system)
            );
            let known = self
                .system
                .invariants
                .iter()
                .any(|invariant| invariant.parts == parts);
            if !known {
                let scalar = parts.len() == 1;
                code.extend(self.function(name, &what, &parts, scalar));
                conserved.push(Conserved {
                    name: name.to_owned(),
                    parts,
                    scalar,
                });
            }
        }
        if observed {
            code.extend(self.observers(&conserved));
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

    /// The method that makes an observer of each number that is conserved: the energy, the momenta of cyclic coordinates, and the
    /// components of the functions.
    fn observers(&self, conserved: &[Conserved]) -> TokenStream {
        let vector = self.vector(&quote!(f64));
        let mut values: Vec<(String, TokenStream)> = Vec::new();
        if conserves_energy(&self.system, self.structure) {
            let energy = quote! {
                ::symplectic::emitted::System::energy(system, state.time, &state.q, &state.p).unwrap_or(f64::NAN)
            };
            values.push(("energy".to_owned(), energy));
        }
        if let Layout::Named([_, momenta]) = &self.system.layout {
            for &k in &self.structure.cyclic {
                let place = Literal::usize_unsuffixed(k);
                values.push((momenta[k].clone(), quote!(state.p[#place])));
            }
        }
        for function in conserved {
            let name = identifier(&function.name);
            let time = self
                .depends_on_time(&function.parts)
                .then(|| quote!(state.time,));
            let value = quote!(system.#name(#time &state.q, &state.p));
            if function.scalar {
                values.push((function.name.clone(), value));
            } else {
                for k in 0..function.parts.len() {
                    let place = Literal::usize_unsuffixed(k);
                    values.push((format!("{}[{k}]", function.name), quote!(#value[#place])));
                }
            }
        }
        if values.is_empty() {
            return TokenStream::new();
        }
        let count = Literal::usize_unsuffixed(values.len());
        let [_, _, arguments] = self.generics();
        let captured = match arguments.is_empty() {
            true => quote!(use<>),
            false => quote!(use #arguments),
        };
        let names = values.iter().map(|(name, _)| name);
        let what = format!(
            " Observers of what the exact flow conserves, from a first state: {}.",
            values
                .iter()
                .map(|(name, _)| format!("`{name}`"))
                .collect::<Vec<_>>()
                .join(", ")
        );
        let arms = values.iter().enumerate().map(|(k, (_, value))| {
            let number = Literal::usize_unsuffixed(k);
            quote!(#number => #value,)
        });
        quote! {
            #[doc = #what]
            #[inline]
            pub fn invariants(
                &self,
                start: &::symplectic::State<#vector>,
            ) -> [(&'static str, ::symplectic::Invariant<impl Fn(&::symplectic::State<#vector>) -> f64 + #captured>); #count] {
                ::symplectic::emitted::invariants(
                    [#(#names),*],
                    self,
                    |system: &Self, number, state| match number { #(#arms)* _ => f64::NAN },
                    start,
                )
            }
        }
    }

    fn depends_on_time(&self, parts: &[Id]) -> bool {
        (parts.iter()).any(|&part| self.system.graph.depends(part).time)
    }

    pub(super) fn function(
        &self,
        name: &str,
        what: &str,
        parts: &[Id],
        alone: bool,
    ) -> TokenStream {
        let name = identifier(name);
        let (scalar, bound) = (&self.scalar, &self.bound);
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
        let time = self.depends_on_time(parts).then(|| quote!(time: #scalar,));
        quote! {
            #[doc = #what]
            pub fn #name<#scalar: #bound>(&self, #time q: &#over, p: &#over) -> #result {
                #values
                #finish
            }
        }
    }
}
