//! The macro `tableau!` of the crate `symplectic`, which re-exports and documents it.
//!
//! It holds no mathematics: it reads the definition, calls the compiler, and hands back the generated
//! code or errors at the offending tokens.

mod definition;
mod expand;
mod source;

use proc_macro::TokenStream;

/// Derives, proves and emits the integrator of a basis and nodes.
#[proc_macro]
pub fn tableau(input: TokenStream) -> TokenStream {
    let definitions = syn::parse_macro_input!(input as definition::Definitions);
    expand::expand(&definitions)
        .unwrap_or_else(|errors| errors.to_compile_error())
        .into()
}
