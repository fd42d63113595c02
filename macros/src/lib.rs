//! The macros `tableau!`, `splitting!`, `composition!`, `hamiltonian!` and `lagrangian!` of the crate `symplectic`, which re-exports and
//! documents them.
//!
//! They hold no mathematics: they read the definition, call the compiler, and hand back the generated
//! code or errors at the offending tokens.

mod definition;
mod expand;
mod form;
mod source;
mod system;

use proc_macro::TokenStream;

use symplectic_compiler::formula::Form;

/// Derives, proves and emits the integrator of a basis and nodes, or of anything else that defines a method.
#[proc_macro]
pub fn tableau(input: TokenStream) -> TokenStream {
    methods(input, form::Form::Tableau)
}

/// Proves and emits the integrator of drifts and kicks.
#[proc_macro]
pub fn splitting(input: TokenStream) -> TokenStream {
    methods(input, form::Form::Splitting)
}

/// Proves and emits the integrator of steps of other methods.
#[proc_macro]
pub fn composition(input: TokenStream) -> TokenStream {
    methods(input, form::Form::Composition)
}

/// Reads the formula of a Hamiltonian, derives what an integrator needs, and emits the system.
#[proc_macro]
pub fn hamiltonian(input: TokenStream) -> TokenStream {
    formula(input, Form::Hamiltonian)
}

/// Reads the formula of a Lagrangian, derives its Hamiltonian and what an integrator needs, and emits the system.
#[proc_macro]
pub fn lagrangian(input: TokenStream) -> TokenStream {
    formula(input, Form::Lagrangian)
}

/// The two macros of systems are one; they differ in what the formula is.
fn formula(input: TokenStream, form: Form) -> TokenStream {
    let parse = |input: syn::parse::ParseStream<'_>| system::Definition::parse(input, form);
    let definition = syn::parse_macro_input!(input with parse);
    system::expand(definition)
        .unwrap_or_else(|error| error.to_compile_error())
        .into()
}

/// The three macros of methods are one; they differ in the keys that they expect.
fn methods(input: TokenStream, form: form::Form) -> TokenStream {
    let parse = |input: syn::parse::ParseStream<'_>| definition::Definitions::parse(input, form);
    let definitions = syn::parse_macro_input!(input with parse);
    expand::expand(&definitions, form)
        .unwrap_or_else(|errors| errors.to_compile_error())
        .into()
}
