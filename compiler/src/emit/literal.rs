//! Numbers and names as tokens.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

/// A name of the generated code.
pub(super) fn identifier(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

/// A double as a literal, the shortest that reads back to it; negative ones in parentheses, so that a
/// method call on it means the negative number.
pub(super) fn double(value: f64) -> TokenStream {
    // `{:?}` always reads as a floating-point literal: 1.0, never the integer 1.
    let literal: Option<Literal> = format!("{:?}", value.abs()).parse().ok();
    // Coefficients are finite, and finite doubles read as literals.
    let literal = literal.unwrap_or_else(|| Literal::f64_suffixed(value.abs()));
    if value.is_sign_negative() {
        quote!((-#literal))
    } else {
        quote!(#literal)
    }
}

/// A number of stages without a suffix.
pub(super) fn count(value: usize) -> Literal {
    Literal::usize_unsuffixed(value)
}

/// An array of doubles.
pub(super) fn array(values: &[f64]) -> TokenStream {
    let values = values.iter().map(|&value| double(value));
    quote!([#(#values),*])
}
