//! What is written in `tableau! { … }`.

use proc_macro2::{Ident, TokenStream, TokenTree};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Attribute, Token, Visibility, braced};

/// One or more definitions.
pub struct Definitions(pub Vec<Definition>);

/// `/// Docs. pub Name { key: value, … }`
pub struct Definition {
    /// Attributes, doc comments among them.
    pub attributes: Vec<Attribute>,
    /// The visibility of the type.
    pub visibility: Visibility,
    /// The name of the type.
    pub name: Ident,
    /// The entries between the braces.
    pub fields: Punctuated<Field, Token![,]>,
}

/// `key: value`; what a value may be depends on the key and is looked at later, so that all errors
/// come together.
pub struct Field {
    /// The key.
    pub key: Ident,
    /// Everything up to the next comma.
    pub value: TokenStream,
}

impl Parse for Definitions {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let mut definitions = vec![input.parse()?];
        while !input.is_empty() {
            definitions.push(input.parse()?);
        }
        Ok(Definitions(definitions))
    }
}

impl Parse for Definition {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        const SHAPE: &str = "expected `pub Name { basis: polynomial(3), nodes: lobatto(3) }`";
        if input.is_empty() {
            return Err(input.error(SHAPE));
        }
        let content;
        Ok(Definition {
            attributes: input.call(Attribute::parse_outer)?,
            visibility: input.parse()?,
            name: input
                .parse()
                .map_err(|error| syn::Error::new(error.span(), SHAPE))?,
            fields: {
                braced!(content in input);
                content.parse_terminated(Field::parse, Token![,])?
            },
        })
    }
}

impl Parse for Field {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        const KEY: &str =
            "expected a key such as `nodes:`; a list stands in brackets: `[0, 1/2, 1]`";
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
