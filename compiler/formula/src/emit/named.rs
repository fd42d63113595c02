//! The names of the coordinates.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::Emitter;
use crate::Layout;

impl Emitter<'_> {
    /// The names of positions and momenta; of numbered vectors the number of components.
    pub(super) fn named(&self) -> TokenStream {
        let [generics, _, arguments] = self.generics();
        let name = &self.header.name;
        let names = match &self.system.layout {
            Layout::Named([positions, momenta]) => quote! {
                const NAMES: [&'static [&'static str]; 2] = [&[#(#positions),*], &[#(#momenta),*]];
            },
            Layout::Numbered(_, None) => TokenStream::new(),
            Layout::Numbered(_, Some(components)) => {
                let components = Literal::usize_unsuffixed(*components);
                quote! {
                    const COMPONENTS: ::core::option::Option<usize> = ::core::option::Option::Some(#components);
                }
            }
        };
        quote!(impl #generics ::symplectic::emitted::Named for #name #arguments { #names })
    }
}
