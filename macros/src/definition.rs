//! The syntax of `tableau! { … }` and the other macros of methods.

use proc_macro2::{Ident, TokenStream, TokenTree};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Attribute, Token, Visibility, braced};

use crate::form::Form;

/// One or more definitions.
pub struct Definitions(pub Vec<Definition>);

/// `/// Docs. pub Name { key: value, … }`
pub struct Definition {
    /// Attributes, including doc comments.
    pub attributes: Vec<Attribute>,
    /// The visibility of the type.
    pub visibility: Visibility,
    /// The name of the type.
    pub name: Ident,
    /// The entries between the braces.
    pub fields: Punctuated<Field, Token![,]>,
}

/// `key: value`. The syntax of the value depends on the key and is checked later, so that all errors are reported
/// together.
pub struct Field {
    /// The key.
    pub key: Ident,
    /// Everything up to the next comma.
    pub value: TokenStream,
}

impl Definitions {
    /// Reads the definitions of a macro.
    pub fn parse(input: ParseStream<'_>, form: Form) -> syn::Result<Self> {
        let mut definitions = vec![Definition::parse(input, form)?];
        while !input.is_empty() {
            definitions.push(Definition::parse(input, form)?);
        }
        Ok(Definitions(definitions))
    }
}

impl Definition {
    fn parse(input: ParseStream<'_>, form: Form) -> syn::Result<Self> {
        let shape = form.shape();
        if input.is_empty() {
            return Err(input.error(shape));
        }
        let content;
        Ok(Definition {
            attributes: input.call(Attribute::parse_outer)?,
            visibility: input.parse()?,
            name: input
                .parse()
                .map_err(|error| syn::Error::new(error.span(), shape))?,
            fields: {
                braced!(content in input);
                content.parse_terminated(Field::parse, Token![,])?
            },
        })
    }
}

impl Parse for Field {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        const KEY: &str = "expected a key such as `nodes:`; lists need brackets: `[0, 1/2, 1]`";
        let key: Ident = input
            .parse()
            .map_err(|error| syn::Error::new(error.span(), KEY))?;
        input
            .parse::<Token![:]>()
            .map_err(|error| syn::Error::new(error.span(), KEY))?;
        let mut value = TokenStream::new();
        while !input.is_empty() && !input.peek(Token![,]) {
            value.extend([input.parse::<TokenTree>()?]);
        }
        if value.is_empty() {
            return Err(syn::Error::new(key.span(), format!("`{key}` has no value")));
        }
        Ok(Field { key, value })
    }
}
