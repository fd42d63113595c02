//! The type of a system: a field for each parameter.

use proc_macro2::TokenStream;
use quote::quote;

use super::Emitter;
use super::names::{identifier, length_tokens};
use crate::Shape;
use crate::description::page;
use crate::display::number_text;
use crate::syntax::Length;
use symplectic_exact::code::{self as literal, Header};
use symplectic_exact::rounding::to_f64;

impl Emitter<'_> {
    /// The type of a parameter.
    pub(super) fn field(shape: &Shape) -> TokenStream {
        let vector = |item: TokenStream, length: &Length| match length {
            Length::Runtime | Length::PairsOf(_) => quote!(::symplectic::emitted::Vec<#item>),
            length => {
                let length = length_tokens(length);
                quote!([#item; #length])
            }
        };
        match shape {
            Shape::Number(_) => quote!(f64),
            Shape::Pairs => quote!(::symplectic::emitted::Vec<(usize, usize)>),
            Shape::Array(lengths) => lengths.iter().rev().fold(quote!(f64), vector),
        }
    }

    /// The type, its constructor, and the default.
    pub(super) fn fields(&self) -> TokenStream {
        let Header {
            attributes,
            visibility,
            name,
        } = self.header;
        let [generics, _, arguments] = self.generics();
        let documentation = page(&self.system, self.structure);
        if self.system.parameters.is_empty() {
            return quote! {
                #attributes
                #[doc = #documentation]
                #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
                #visibility struct #name #generics;
            };
        }
        let mut fields = Vec::new();
        let (mut names, mut values, mut inputs) = (Vec::new(), Vec::new(), Vec::new());
        let mut all_copy = true;
        for parameter in &self.system.parameters {
            let field = identifier(&parameter.name);
            let kind = Self::field(&parameter.shape);
            let what = match &parameter.shape {
                Shape::Number(Some(value)) => format!(
                    " The parameter `{}`, {} unless it is set.",
                    parameter.name,
                    number_text(value)
                ),
                _ => format!(" The parameter `{}`.", parameter.name),
            };
            fields.push(quote!(#[doc = #what] pub #field: #kind));
            all_copy &= !kind.to_string().contains("Vec");
            match &parameter.shape {
                Shape::Number(Some(value)) => {
                    let value = literal::double(to_f64(value));
                    values.push(quote!(#field: #value));
                }
                _ => {
                    inputs.push(quote!(#field: #kind));
                    values.push(quote!(#field));
                }
            }
            names.push(field);
        }
        let copy = all_copy.then(|| quote!(Copy,));
        let default = inputs.is_empty().then(|| {
            quote! {
                impl #generics ::core::default::Default for #name #arguments {
                    fn default() -> Self {
                        Self::new()
                    }
                }
            }
        });
        quote! {
            #attributes
            #[doc = #documentation]
            #[allow(non_snake_case)]
            #[derive(Clone, #copy Debug, PartialEq)]
            #visibility struct #name #generics {
                #(#fields),*
            }

            impl #generics #name #arguments {
                /// The system with these parameters, and the values of the definition for the others.
                #[allow(non_snake_case, clippy::too_many_arguments)]
                pub const fn new(#(#inputs),*) -> Self {
                    Self { #(#values),* }
                }
            }

            #default
        }
    }
}
