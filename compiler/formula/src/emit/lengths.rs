//! The check of the parameters against the dimension of a state.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::Emitter;
use super::names::{identifier, length_tokens};
use crate::syntax::Length;
use crate::{Layout, Shape};

impl Emitter<'_> {
    /// The check that parameters are numbers, and that the lengths of arrays, the pairs and the number of bodies fit; empty if there is
    /// nothing to check.
    pub(super) fn check_dimension(&self) -> TokenStream {
        let mut checks = TokenStream::new();
        let length = self.system.layout.length();
        let bodies = length_tokens(&length);
        if let Layout::Numbered(Length::Runtime, components) = &self.system.layout {
            let components = Literal::usize_unsuffixed(components.unwrap_or(1));
            checks.extend(quote!(let n = ::symplectic::emitted::bodies(dimension, #components)?;));
        }
        let mut checked = matches!(
            self.system.layout,
            Layout::Numbered(Length::Runtime, Some(_))
        );
        if self.system.least > 0 && !matches!(length, Length::Fixed(_)) {
            checked = true;
            let least = Literal::usize_unsuffixed(self.system.least);
            checks.extend(quote!(::symplectic::emitted::check_bodies(#bodies, #least)?;));
        }
        for parameter in &self.system.parameters {
            let (name, field) = (&parameter.name, identifier(&parameter.name));
            let check = match &parameter.shape {
                Shape::Number(_) => {
                    quote!(::symplectic::emitted::check_number(#name, self.#field)?;)
                }
                Shape::Pairs => {
                    quote!(::symplectic::emitted::check_pairs(#name, &self.#field, #bodies)?;)
                }
                Shape::Array(lengths) => check_array(name, &quote!(self.#field), lengths),
            };
            checked |= !check.is_empty();
            checks.extend(check);
        }
        if !checked {
            return TokenStream::new();
        }
        quote! {
            #[allow(unused_variables)]
            fn check_dimension(&self, dimension: usize) -> ::core::result::Result<(), ::symplectic::Error> {
                #checks
                ::core::result::Result::Ok(())
            }
        }
    }
}

/// The checks of an array, and of its rows if it is a matrix: lengths, and that entries are numbers. A fixed length is a matter of its
/// type.
fn check_array(name: &str, array: &TokenStream, lengths: &[Length]) -> TokenStream {
    let [length, rest @ ..] = lengths else {
        return TokenStream::new();
    };
    let expected = match length {
        Length::Fixed(_) | Length::Generic(_) => None,
        Length::Runtime => Some(length_tokens(length)),
        Length::PairsOf(pairs) => {
            let pairs = identifier(pairs);
            Some(quote!(self.#pairs.len()))
        }
    };
    let own = expected.map(
        |expected| quote!(::symplectic::emitted::check_length(#name, #array.len(), #expected)?;),
    );
    let entries = if rest.is_empty() {
        quote!(::symplectic::emitted::check_numbers(#name, &#array[..])?;)
    } else {
        let row = check_array(name, &quote!(row), rest);
        quote!(for row in &#array { #row })
    };
    quote!(#own #entries)
}
