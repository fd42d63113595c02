//! From a definition to code, with all errors collected.

use std::path::PathBuf;

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use symplectic_compiler::emit::{Header, method};
use symplectic_compiler::{Evidence, Limits, Properties, Tableau, check, derive_within};
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
    let requirements = field("require").map_or(Ok(Vec::new()), requirements);
    let requirements = errors.note(requirements).unwrap_or_default();

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
        (None, basis, _) => {
            let missing = if basis.is_some() {
                "`nodes: …` is missing"
            } else {
                "`basis: …` is missing"
            };
            Err(syn::Error::new(
                definition.name.span(),
                format!("{missing}; a method needs `basis` and `nodes`, or `file`"),
            ))
        }
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
            let code = method(&tableau.named(definition.name.to_string()), &header);
            return Ok(quote!(#rebuild #code));
        }
    }
    errors.0.map_or(Ok(TokenStream::new()), Err)
}

/// Derives the tableau of a basis and nodes.
fn derive(basis: &Field, nodes: &Field, limits: &Limits) -> syn::Result<Tableau> {
    let basis = Source::new(basis.value.clone());
    let nodes = Source::new(nodes.value.clone());
    derive_within(&basis.text, &nodes.text, limits).map_err(|first| {
        // Both may be wrong; a person wants to know of both at once.
        let in_basis = first
            .place
            .as_ref()
            .is_none_or(|place| place.input == "basis");
        let mut error = if in_basis {
            basis.locate(&first)
        } else {
            nodes.locate(&first)
        };
        let basis_is_wrong = symplectic_compiler::Basis::parse(&basis.text, limits).is_err();
        if in_basis
            && basis_is_wrong
            && let Err(second) = symplectic_compiler::QuadratureRule::parse(&nodes.text, limits)
        {
            error.combine(nodes.locate(&second));
        }
        error
    })
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
    let text = std::fs::read_to_string(&path).map_err(|error| {
        syn::Error::new(
            literal.span(),
            format!("cannot read `{shown}`: {error}; the path is relative to the crate"),
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

/// `require: [symplectic, symmetric]`
fn requirements(field: &Field) -> syn::Result<Vec<Ident>> {
    let list = |input: syn::parse::ParseStream<'_>| {
        let content;
        bracketed!(content in input);
        Punctuated::<Ident, Token![,]>::parse_terminated(&content)
    };
    let names = list.parse2(field.value.clone()).map_err(|error| {
        syn::Error::new(
            error.span(),
            "expected a list of properties: `require: [symplectic, symmetric]`",
        )
    })?;
    let mut errors = Errors(None);
    for name in &names {
        if !Properties::NAMES.iter().any(|known| name == known) {
            let message = format!(
                "unknown property `{name}`; known here: {}",
                Properties::NAMES.join(", ")
            );
            errors.note::<()>(Err(syn::Error::new(name.span(), message)));
        }
    }
    errors.0.map_or(Ok(names.into_iter().collect()), Err)
}

fn max_stages(field: &Field) -> syn::Result<Limits> {
    let literal: LitInt = syn::parse2(field.value.clone())?;
    Ok(Limits {
        stages: literal.base10_parse()?,
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
