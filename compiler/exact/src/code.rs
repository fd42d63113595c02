//! Rust code: what both methods and systems write.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

/// What the user writes before the braces: attributes, visibility and the name of the type.
#[derive(Debug, Clone)]
pub struct Header {
    /// Attributes, including doc comments.
    pub attributes: TokenStream,
    /// The visibility.
    pub visibility: TokenStream,
    /// The name of the type.
    pub name: Ident,
}

/// A name of the generated code.
pub fn identifier(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

/// A double as the shortest literal that parses to it. Negative numbers are in parentheses, so that a method call
/// applies to the negative number.
pub fn double(value: f64) -> TokenStream {
    // `{:?}` always reads as a floating-point literal: 1.0, never the integer 1.
    let size = format!("{:?}", value.abs());
    signed(&size, "f64", value.is_sign_negative())
}

/// A single as a literal: where an f32 is expected, the literal is read as an f32 directly, not through a double.
pub fn single(value: f32) -> TokenStream {
    let size = format!("{:?}", value.abs());
    signed(&size, "f32", value.is_sign_negative())
}

fn signed(size: &str, kind: &str, negative: bool) -> TokenStream {
    let size = match size.parse::<Literal>() {
        Ok(literal) => quote!(#literal),
        // Every finite number is a valid literal; this one is infinite.
        Err(_) => {
            let kind = identifier(kind);
            quote!(::core::primitive::#kind::INFINITY)
        }
    };
    if negative { quote!((-#size)) } else { size }
}
