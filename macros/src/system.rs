//! From the formula of a Hamiltonian or a Lagrangian to code.

use proc_macro2::{Ident, TokenStream};
use quote::ToTokens;
use symplectic_compiler::emit::Header;
use symplectic_formula::emit::system;
use symplectic_formula::{Form, Structure, System};
use syn::parse::ParseStream;
use syn::{Attribute, Visibility};

use crate::source::Source;

/// The input of `hamiltonian! { … }` or `lagrangian! { … }`.
pub struct Definition {
    form: Form,
    attributes: Vec<Attribute>,
    visibility: Visibility,
    name: Ident,
    /// The name and all tokens after it.
    text: TokenStream,
}

impl Definition {
    /// Parses attributes, visibility and name; the compiler parses the rest.
    pub fn parse(input: ParseStream<'_>, form: Form) -> syn::Result<Self> {
        let shape = match form {
            Form::Hamiltonian => {
                "expected a system: `Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)`"
            }
            Form::Lagrangian => {
                "expected a system: `Pendulum { g: 9.81 } q: [a], v: [va]; L = va^2/2 + g cos(a)`"
            }
        };
        let attributes = input.call(Attribute::parse_outer)?;
        let visibility = input.parse()?;
        let name: Ident = input
            .parse()
            .map_err(|error| syn::Error::new(error.span(), shape))?;
        let mut text = name.to_token_stream();
        text.extend(input.parse::<TokenStream>()?);
        Ok(Definition {
            form,
            attributes,
            visibility,
            name,
            text,
        })
    }
}

/// The code of a system, or the errors in its definition.
pub fn expand(definition: Definition) -> syn::Result<TokenStream> {
    let source = Source::new(definition.text);
    let located = |error| source.locate(&error);
    let form = definition.form;
    let mut read = System::read_as(form, form.macro_name(), &source.text).map_err(located)?;
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
