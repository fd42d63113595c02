//! From a definition to code, with all errors collected.

use std::path::PathBuf;

use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, quote};
use symplectic_compiler::emit::{Header, method};
use symplectic_compiler::export::read_text;
use symplectic_compiler::{
    Basis, Evidence, Limits, Properties, QuadratureRule, Tableau, check, derive_from,
};
use syn::parse::Parser;
use syn::punctuated::Punctuated;
use syn::{LitInt, LitStr, Token, bracketed};

use crate::definition::{Definition, Definitions, Field};
use crate::source::Source;

/// The code of all definitions, or all their errors.
pub fn expand(definitions: &Definitions) -> syn::Result<TokenStream> {
    let mut errors = Errors(None);
    let mut code = TokenStream::new();
    for definition in &definitions.0 {
        code.extend(errors.note(expand_one(definition)));
    }
    errors.0.map_or(Ok(code), Err)
}

/// Errors that are reported together.
struct Errors(Option<syn::Error>);

impl Errors {
    fn note<T>(&mut self, result: syn::Result<T>) -> Option<T> {
        let error = match result {
            Ok(value) => return Some(value),
            Err(error) => error,
        };
        match &mut self.0 {
            Some(first) => first.combine(error),
            None => self.0 = Some(error),
        }
        None
    }

    /// All errors noted; there is at least one.
    fn all(self) -> syn::Error {
        self.0
            .unwrap_or_else(|| syn::Error::new(Span::call_site(), "nothing is wrong"))
    }
}

const KEYS: [&str; 5] = ["basis", "nodes", "file", "require", "max_stages"];

fn expand_one(definition: &Definition) -> syn::Result<TokenStream> {
    let mut errors = Errors(None);
    for (index, Field { key, .. }) in definition.fields.iter().enumerate() {
        if !KEYS.iter().any(|known| key == known) {
            let message = format!("unknown key `{key}`; known here: {}", KEYS.join(", "));
            errors.note::<()>(Err(syn::Error::new(key.span(), message)));
        } else if definition
            .fields
            .iter()
            .take(index)
            .any(|earlier| earlier.key == *key)
        {
            errors.note::<()>(Err(syn::Error::new(
                key.span(),
                format!("`{key}` is given twice"),
            )));
        }
    }
    let field = |name: &str| definition.fields.iter().find(|field| field.key == name);
    let limits = field("max_stages").map_or(Ok(Limits::default()), max_stages);
    let limits = errors.note(limits).unwrap_or_default();
    let requirements =
        field("require").map_or_else(Vec::new, |field| requirements(field, &mut errors));

    let mut rebuild = TokenStream::new();
    let tableau = match (field("file"), field("basis"), field("nodes")) {
        (Some(file), None, None) => read(file, &limits).map(|(tableau, tracking)| {
            rebuild = tracking;
            tableau
        }),
        (None, Some(basis), Some(nodes)) => derive(basis, nodes, &limits),
        (Some(file), _, _) => Err(syn::Error::new(
            file.key.span(),
            "`file` says everything: leave out `basis` and `nodes`, or `file`",
        )),
        (None, basis, nodes) => Err(incomplete(definition, basis, nodes, &limits)),
    };
    if let Some(tableau) = errors.note(tableau) {
        errors.note(prove(&tableau, &requirements));
        if errors.0.is_none() {
            let attributes = &definition.attributes;
            let header = Header {
                attributes: quote!(#(#attributes)*),
                visibility: definition.visibility.to_token_stream(),
                name: definition.name.clone(),
            };
            let code = method(&tableau.named(definition.name.to_string()), &header)
                .map_err(|kind| syn::Error::new(definition.name.span(), kind.to_string()))?;
            return Ok(quote!(#rebuild #code));
        }
    }
    errors.0.map_or(Ok(TokenStream::new()), Err)
}

/// Derives the tableau of a basis and nodes.
fn derive(basis: &Field, nodes: &Field, limits: &Limits) -> syn::Result<Tableau> {
    let mut errors = Errors(None);
    let [basis, nodes] = [basis, nodes].map(|field| Source::new(field.value.clone()));
    // Both may be wrong, and a person wants to know of both at once.
    let functions =
        errors.note(Basis::parse(&basis.text, limits).map_err(|error| basis.locate(&error)));
    let rule = errors
        .note(QuadratureRule::parse(&nodes.text, limits).map_err(|error| nodes.locate(&error)));
    let (Some(functions), Some(rule)) = (functions, rule) else {
        return Err(errors.all());
    };
    derive_from(&functions, &rule).map_err(|kind| {
        let source = if kind.is_about_basis() {
            &basis
        } else {
            &nodes
        };
        source.locate(&kind.into())
    })
}

/// What is wrong with the one of `basis` and `nodes` that is there, and that the other is missing.
fn incomplete(
    definition: &Definition,
    basis: Option<&Field>,
    nodes: Option<&Field>,
    limits: &Limits,
) -> syn::Error {
    let mut errors = Errors(None);
    let missing = match (basis, nodes) {
        (Some(_), None) => "`nodes: …` is missing; ",
        (None, Some(_)) => "`basis: …` is missing; ",
        _ => "",
    };
    let message = format!("{missing}a method needs `basis` and `nodes`, or `file`");
    errors.note::<()>(Err(syn::Error::new(definition.name.span(), message)));
    let source = |field: &Field| Source::new(field.value.clone());
    if let Some(basis) = basis.map(source) {
        errors.note(Basis::parse(&basis.text, limits).map_err(|error| basis.locate(&error)));
    }
    if let Some(nodes) = nodes.map(source) {
        errors
            .note(QuadratureRule::parse(&nodes.text, limits).map_err(|error| nodes.locate(&error)));
    }
    errors.all()
}

/// Reads and re-proves a table file, and makes the crate depend on it.
fn read(file: &Field, limits: &Limits) -> syn::Result<(Tableau, TokenStream)> {
    let literal: LitStr = syn::parse2(file.value.clone()).map_err(|error| {
        syn::Error::new(
            error.span(),
            "expected a path in quotes, relative to the crate: `file: \"tableaux/gauss-4.toml\"`",
        )
    })?;
    let root = std::env::var_os("CARGO_MANIFEST_DIR").map_or_else(PathBuf::new, PathBuf::from);
    let path = root.join(literal.value());
    let shown = path.display().to_string();
    let text = read_text(&path).map_err(|error| {
        syn::Error::new(
            literal.span(),
            format!("{error}; the path is relative to the crate"),
        )
    })?;
    let tableau = check(&literal.value(), &text, limits)
        .map_err(|error| syn::Error::new(literal.span(), error.to_string()))?;
    Ok((
        tableau,
        quote!(
            const _: &[::core::primitive::u8] = ::core::include_bytes!(#shown);
        ),
    ))
}

/// `require: [symplectic, symmetric]`: the properties that exist; the others are errors.
fn requirements(field: &Field, errors: &mut Errors) -> Vec<Ident> {
    let list = |input: syn::parse::ParseStream<'_>| {
        let content;
        bracketed!(content in input);
        Punctuated::<Ident, Token![,]>::parse_terminated(&content)
    };
    let names = list.parse2(field.value.clone()).map_err(|error| {
        let message = "expected a list of properties: `require: [symplectic, symmetric]`";
        syn::Error::new(error.span(), message)
    });
    let known = |name: &Ident| {
        if Properties::NAMES.iter().any(|known| name == known) {
            return Ok(name.clone());
        }
        let message = format!(
            "unknown property `{name}`; known here: {}",
            Properties::NAMES.join(", ")
        );
        Err(syn::Error::new(name.span(), message))
    };
    let names = errors.note(names).unwrap_or_default();
    names
        .iter()
        .filter_map(|name| errors.note(known(name)))
        .collect()
}

fn max_stages(field: &Field) -> syn::Result<Limits> {
    let number =
        syn::parse2::<LitInt>(field.value.clone()).and_then(|literal| literal.base10_parse());
    number.map(|stages| Limits { stages }).map_err(|_| {
        syn::Error::new_spanned(
            &field.value,
            "expected a number of stages: `max_stages: 40`",
        )
    })
}

/// Every requirement has to be proved.
fn prove(tableau: &Tableau, requirements: &[Ident]) -> syn::Result<()> {
    let mut errors = Errors(None);
    if requirements.is_empty() {
        return Ok(());
    }
    let properties = tableau.properties();
    for name in requirements {
        let Some(property) = properties.get(&name.to_string()) else {
            continue;
        };
        let witness = property.witness.as_deref().unwrap_or("no witness");
        match property.evidence {
            Evidence::Proved => {}
            Evidence::Refuted => {
                let message = format!("the method is not `{name}`: {witness}");
                errors.note::<()>(Err(syn::Error::new(name.span(), message)));
            }
            Evidence::Verified { bits } => {
                let message = format!("`{name}` is not proved, only verified to 2^-{bits}");
                errors.note::<()>(Err(syn::Error::new(name.span(), message)));
            }
        }
    }
    errors.0.map_or(Ok(()), Err)
}
