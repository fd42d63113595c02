//! From a definition to code; all errors are collected.

use std::path::PathBuf;

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{ToTokens, quote, quote_spanned};
use symplectic_compiler::emit::{Header, fitted_method, method};
use symplectic_compiler::export::read_text;
use symplectic_compiler::{
    ErrorKind, Fitted, Key, Limits, Requirement, Tableau, check, did_you_mean,
};
use syn::parse::{Parse, ParseStream, Parser};
use syn::punctuated::Punctuated;
use syn::{LitInt, LitStr, Token, bracketed, parenthesized};

use crate::definition::{Definition, Definitions, Field};
use crate::form::Form;
use crate::source::Source;

/// The code of all definitions, or all their errors.
pub fn expand(definitions: &Definitions, form: Form) -> syn::Result<TokenStream> {
    let mut errors = Errors(None);
    let mut code = TokenStream::new();
    for definition in &definitions.0 {
        code.extend(errors.note(expand_one(definition, form)));
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

fn expand_one(definition: &Definition, form: Form) -> syn::Result<TokenStream> {
    let mut errors = Errors(None);
    let keys = form.keys().iter().map(|key| key.name());
    let known: Vec<&str> = keys.chain(form.others().iter().copied()).collect();
    for (index, Field { key, .. }) in definition.fields.iter().enumerate() {
        if !known.iter().any(|known| key == known) {
            let part = Key::find(&key.to_string()).is_some();
            let taken = part || Form::Tableau.others().iter().any(|other| key == other);
            let hint = if taken { "; `tableau!` takes it" } else { "" };
            let meant = match hint {
                "" => did_you_mean(&key.to_string(), known.iter().copied()),
                hint => hint.to_owned(),
            };
            let message = format!(
                "unknown key `{key}`; known here: {}{meant}",
                known.join(", ")
            );
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
    let complete = errors.note(missing(definition, form)).is_some();
    let limits = field("max_stages").map_or(Ok(Limits::default()), max_stages);
    let limits = errors.note(limits).unwrap_or_default();
    let requirements =
        field("require").map_or_else(Vec::new, |field| requirements(field, &mut errors));

    let accepted = field("accept").map_or(Ok(None), |field| accepted(field).map(Some));
    let accepted = errors.note(accepted).flatten();
    if form == Form::Tableau && field(Key::Parameters.name()).is_some() && field("file").is_none() {
        let code = errors.note(fitted(definition, form, &limits, &requirements));
        return errors.0.map_or_else(|| Ok(code.unwrap_or_default()), Err);
    }

    let mut rebuild = TokenStream::new();
    let is_part = |field: &&Field| Key::find(&field.key.to_string()).is_some();
    let parts: Vec<String> = definition
        .fields
        .iter()
        .filter(is_part)
        .map(|part| format!("`{}`", part.key))
        .collect();
    let file = field("file").filter(|_| form.others().contains(&"file"));
    let tableau = match (file, parts.is_empty()) {
        (Some(file), true) => read(file, &limits).map(|(tableau, tracking)| {
            rebuild = tracking;
            tableau
        }),
        (Some(file), false) => Err(syn::Error::new(
            file.key.span(),
            format!(
                "`file` already defines the method: leave out {}, or `file`",
                parts.join(" and ")
            ),
        )),
        (None, _) => derive(definition, form, &limits),
    };
    // A missing key is already reported.
    let tableau = if complete { errors.note(tableau) } else { None };
    if let Some(tableau) = tableau {
        let proved = prove(&requirements, |requirement| {
            tableau.require(requirement, accepted)
        });
        errors.note(proved);
        if errors.0.is_none() {
            let attributes = &definition.attributes;
            let header = Header {
                attributes: quote!(#(#attributes)*),
                visibility: definition.visibility.to_token_stream(),
                name: definition.name.clone(),
            };
            let warning = inconsistent(&tableau, &definition.name);
            let digits = wrong_digits(&tableau, definition);
            let code = method(&tableau.named(definition.name.to_string()), &header)
                .map_err(|kind| syn::Error::new(definition.name.span(), kind.to_string()))?;
            return Ok(quote!(#rebuild #warning #digits #code));
        }
    }
    errors.0.map_or(Ok(TokenStream::new()), Err)
}

/// Checks that a definition contains one of the required sets of keys.
fn missing(definition: &Definition, form: Form) -> syn::Result<()> {
    let has = |key: &Key| {
        definition
            .fields
            .iter()
            .any(|field| field.key == key.name())
    };
    let needed = form.needed();
    if needed.is_empty() || needed.iter().any(|set| set.iter().all(has)) {
        return Ok(());
    }
    // The set with most keys present; the first of equal sets.
    let there = |set: &&&[Key]| set.iter().filter(|key| has(key)).count();
    let nearest = needed
        .iter()
        .rev()
        .max_by_key(there)
        .copied()
        .unwrap_or(&[]);
    let names = |keys: &[Key]| {
        let names: Vec<String> = keys.iter().map(|key| format!("`{}`", key.name())).collect();
        names.join(" and ")
    };
    let absent: Vec<Key> = nearest.iter().filter(|key| !has(key)).copied().collect();
    let alternatives: Vec<String> = needed.iter().map(|set| names(set)).collect();
    let message = format!(
        "{} missing; this macro needs {}",
        match absent.as_slice() {
            [one] => format!("`{}` is", one.name()),
            several => format!("{} are", names(several)),
        },
        alternatives.join(", or ")
    );
    Err(syn::Error::new(definition.name.span(), message))
}

/// A warning at the name of a method that is not consistent, which is hardly intended.
///
/// The only warning that a macro can emit is the use of a deprecated item.
fn inconsistent(tableau: &Tableau, name: &Ident) -> Option<TokenStream> {
    let consistent = tableau.properties().consistent;
    let witness = consistent.witness.as_deref().unwrap_or_default();
    let note = format!("the method is not consistent, of order 0: {witness}");
    (!consistent.holds).then(|| {
        quote_spanned! {name.span()=>
            const _: () = {
                #[deprecated(note = #note)]
                const INCONSISTENT: () = ();
                INCONSISTENT
            };
        }
    })
}

/// A warning at each printed number of a claim that the exact coefficient does not round to.
fn wrong_digits(tableau: &Tableau, definition: &Definition) -> TokenStream {
    let warning = |error: &symplectic_compiler::Error| {
        let about = error.place.as_ref().map(|place| &*place.input);
        let field = definition
            .fields
            .iter()
            .find(|field| about.is_some_and(|about| field.key == about));
        let span = field.map_or(definition.name.span(), |field| {
            Source::new(field.value.clone()).locate(error).span()
        });
        let note = error.kind.to_string();
        quote_spanned! {span=>
            const _: () = {
                #[deprecated(note = #note)]
                const WRONG_DIGITS: () = ();
                WRONG_DIGITS
            };
        }
    };
    tableau.wrong_digits().iter().map(warning).collect()
}

/// The code of a method whose coefficients are functions of its parameter.
fn fitted(
    definition: &Definition,
    form: Form,
    limits: &Limits,
    requirements: &[Required],
) -> syn::Result<TokenStream> {
    let fitted = from_parts(definition, form, |defined| {
        Fitted::derive(defined, limits).map_err(|error| vec![error])
    })?;
    prove(requirements, |requirement| fitted.require(requirement))?;
    let attributes = &definition.attributes;
    let header = Header {
        attributes: quote!(#(#attributes)*),
        visibility: definition.visibility.to_token_stream(),
        name: definition.name.clone(),
    };
    fitted_method(&fitted, &header)
        .map_err(|kind| syn::Error::new(definition.name.span(), kind.to_string()))
}

/// Derives the tableau from the parts of a definition, with errors at the tokens of each part.
fn derive(definition: &Definition, form: Form, limits: &Limits) -> syn::Result<Tableau> {
    from_parts(definition, form, |defined| {
        defined.derive_or_all_errors(limits)
    })
}

/// What is derived from the parts of a definition, with errors at the tokens of each part.
fn from_parts<T>(
    definition: &Definition,
    form: Form,
    derived: impl FnOnce(&symplectic_compiler::Definition) -> Result<T, Vec<symplectic_compiler::Error>>,
) -> syn::Result<T> {
    let parts: Vec<(Key, Source)> = definition
        .fields
        .iter()
        .filter_map(|field| {
            let key = Key::find(&field.key.to_string())?;
            // Other keys are already refused.
            let taken = form.keys().contains(&key);
            taken.then(|| (key, Source::new(field.value.clone())))
        })
        .collect();
    let texts = parts.iter().map(|(key, source)| (*key, &*source.text));
    let defined = symplectic_compiler::Definition::new(texts);
    derived(&defined).map_err(|all| {
        let located = all.iter().map(|error| {
            let about = error.place.as_ref().map(|place| &*place.input);
            let part = parts.iter().find(|(key, _)| Some(key.name()) == about);
            match part {
                Some((_, source)) => source.locate(error),
                None => syn::Error::new(definition.name.span(), &error.kind),
            }
        });
        let combined = located.reduce(|mut all, error| {
            all.combine(error);
            all
        });
        combined.unwrap_or_else(|| syn::Error::new(definition.name.span(), "not a definition"))
    })
}

/// Reads and re-proves a tableau file, and makes the crate depend on it.
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

/// A requirement with its tokens.
type Required = (Requirement, Source);

/// `require: [symplectic, order >= 4]`: the valid requirements; invalid ones are recorded as errors.
fn requirements(field: &Field, errors: &mut Errors) -> Vec<Required> {
    let list = |input: ParseStream<'_>| {
        let content;
        bracketed!(content in input);
        Punctuated::<Item, Token![,]>::parse_terminated(&content)
    };
    let items = list.parse2(field.value.clone()).map_err(|error| {
        let message = "expected a list of requirements: `require: [symplectic, order >= 4]`";
        syn::Error::new(error.span(), message)
    });
    let items = errors.note(items).unwrap_or_default();
    let read = |item: &Item| {
        let source = Source::new(item.0.clone());
        match Requirement::parse(&source.text) {
            Ok(requirement) => Ok((requirement, source)),
            Err(error) => Err(source.locate(&error)),
        }
    };
    items
        .iter()
        .filter_map(|item| errors.note(read(item)))
        .collect()
}

/// The tokens up to the next comma.
struct Item(TokenStream);

impl Parse for Item {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let mut tokens = TokenStream::new();
        while !input.is_empty() && !input.peek(Token![,]) {
            tokens.extend([input.parse::<TokenTree>()?]);
        }
        if tokens.is_empty() {
            return Err(input.error("expected a requirement"));
        }
        Ok(Item(tokens))
    }
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

/// `accept: verified(100 bits)`: the binary places.
fn accepted(field: &Field) -> syn::Result<u32> {
    let shape = |input: ParseStream<'_>| {
        let content;
        let word: Ident = input.parse()?;
        parenthesized!(content in input);
        let number: LitInt = content.parse()?;
        let unit: Ident = content.parse()?;
        if word != "verified" || unit != "bits" || !content.is_empty() {
            return Err(content.error("another word"));
        }
        number.base10_parse()
    };
    shape.parse2(field.value.clone()).map_err(|_| {
        let message = "expected a number of binary places: `accept: verified(100 bits)`";
        syn::Error::new_spanned(&field.value, message)
    })
}

/// Every requirement must be decided in favour of the method.
fn prove(
    requirements: &[Required],
    decide: impl Fn(&Requirement) -> Result<(), ErrorKind>,
) -> syn::Result<()> {
    let mut errors = Errors(None);
    for (requirement, source) in requirements {
        errors.note(decide(requirement).map_err(|kind| source.locate(&kind.into())));
    }
    errors.0.map_or(Ok(()), Err)
}
