//! The macros `tableau!`, `splitting!`, `composition!`, `hamiltonian!` and `lagrangian!` of the crate `symplectic`, which re-exports and
//! documents them.
//!
//! They contain no mathematics: they parse the definition, call the compiler, and return the generated code or errors
//! at the offending tokens.

mod definition;
mod expand;
mod form;
mod source;
mod system;

use proc_macro::TokenStream;

use symplectic_formula::Form;

/// Derives, proves and emits the integrator of a basis and nodes, or of any other definition of a method.
#[proc_macro]
pub fn tableau(input: TokenStream) -> TokenStream {
    methods(input, form::Form::Tableau)
}

/// Proves and emits the integrator of a splitting into drifts and kicks.
#[proc_macro]
pub fn splitting(input: TokenStream) -> TokenStream {
    methods(input, form::Form::Splitting)
}

/// Proves and emits the integrator of a composition of other methods.
#[proc_macro]
pub fn composition(input: TokenStream) -> TokenStream {
    methods(input, form::Form::Composition)
}

/// Parses the formula of a Hamiltonian, derives the equations of motion and their structure, and emits the system.
#[proc_macro]
pub fn hamiltonian(input: TokenStream) -> TokenStream {
    formula(input, Form::Hamiltonian)
}

/// Parses the formula of a Lagrangian, derives its Hamiltonian, the equations of motion and their structure, and emits
/// the system.
#[proc_macro]
pub fn lagrangian(input: TokenStream) -> TokenStream {
    formula(input, Form::Lagrangian)
}

/// The common implementation of the macros of systems.
fn formula(input: TokenStream, form: Form) -> TokenStream {
    let parse = |input: syn::parse::ParseStream<'_>| system::Definition::parse(input, form);
    let definition = syn::parse_macro_input!(input with parse);
    system::expand(definition)
        .unwrap_or_else(|error| error.to_compile_error())
        .into()
}

/// The common implementation of the macros of methods.
fn methods(input: TokenStream, form: form::Form) -> TokenStream {
    let parse = |input: syn::parse::ParseStream<'_>| definition::Definitions::parse(input, form);
    let definitions = syn::parse_macro_input!(input with parse);
    expand::expand(&definitions, form)
        .unwrap_or_else(|errors| errors.to_compile_error())
        .into()
}
