//! From the formula of a Hamiltonian to code.

use proc_macro2::{Ident, TokenStream};
use quote::ToTokens;
use symplectic_compiler::emit::{Header, system};
use symplectic_compiler::formula::{Structure, System};
use syn::parse::{Parse, ParseStream};
use syn::{Attribute, Visibility};

use crate::source::Source;

/// What is written in `hamiltonian! { … }`.
pub struct Definition {
    attributes: Vec<Attribute>,
    visibility: Visibility,
    name: Ident,
    /// The name, and everything after it.
    text: TokenStream,
}

impl Parse for Definition {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        const SHAPE: &str =
            "expected a system: `Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)`";
        let attributes = input.call(Attribute::parse_outer)?;
        let visibility = input.parse()?;
        let name: Ident = input
            .parse()
            .map_err(|error| syn::Error::new(error.span(), SHAPE))?;
        let mut text = name.to_token_stream();
        text.extend(input.parse::<TokenStream>()?);
        Ok(Definition {
            attributes,
            visibility,
            name,
            text,
        })
    }
}

/// The code of a system, or what is wrong with its definition.
pub fn expand(definition: Definition) -> syn::Result<TokenStream> {
    let source = Source::new(definition.text);
    let located = |error| source.locate(&error);
    let mut read = System::read("hamiltonian!", &source.text).map_err(located)?;
    let structure = Structure::of(&mut read);
    read.check(&structure, &source.text).map_err(located)?;
    let attributes = &definition.attributes;
    let header = Header {
        attributes: quote::quote!(#(#attributes)*),
        visibility: definition.visibility.to_token_stream(),
        name: definition.name,
    };
    Ok(system(&read, &structure, &header))
}
