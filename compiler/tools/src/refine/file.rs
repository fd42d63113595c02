//! Reading a file with printed coefficients, and the places of its errors.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use super::Refinement;
use symplectic_compiler::certify::{
    Certificate, CertifyError, Claim, Coefficient, Printed, Splitting, certify, certify_composition,
};
use symplectic_compiler::expression::Input;
use symplectic_compiler::inside::computed;
use symplectic_compiler::inside::first_line;
use symplectic_compiler::inside::shown;
use symplectic_compiler::inside::with_suggestion;
use symplectic_compiler::{Error, ErrorKind};

type List = Spanned<Vec<Spanned<String>>>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    name: Option<String>,
    source: Option<String>,
    claim: Spanned<ClaimTable>,
    printed: Spanned<PrintedTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ClaimTable {
    class: Option<Spanned<String>>,
    order: Option<Spanned<usize>>,
    perturbed: Option<Spanned<Vec<usize>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PrintedTable {
    kick: Option<List>,
    drift: Option<List>,
    gradient: Option<List>,
    weights: Option<List>,
}

/// The lists of coefficients of a file.
enum Lists<'a> {
    Splitting {
        kick: &'a List,
        drift: &'a List,
        /// The weights of gradient kicks.
        gradient: Option<&'a List>,
    },
    Weights(&'a List),
}

/// One printed coefficient and its place.
struct Entry {
    name: Coefficient,
    printed: Printed,
    span: Range<usize>,
}

/// The method of a file. With `nearest` it may be far from the digits.
pub(super) fn refine(file: Input<'_>, nearest: bool) -> Result<Refinement, Error> {
    let keys: Keys = toml::from_str(file.text).map_err(|error| {
        let message = format!(
            "not a file of printed coefficients: {}",
            with_suggestion(error.message())
        );
        wrong_file(file, error.span().unwrap_or(0..0), message)
    })?;
    let lists = keys.printed.get_ref().lists();
    let lists = lists.map_err(|message| wrong_file(file, keys.printed.span(), message))?;
    let (claim, claim_span) = claim(file, &keys.claim, &lists)?;
    let entries = lists.entries(file)?;
    let certificate = match &lists {
        Lists::Splitting { .. } => certify(&splitting(&entries), &claim),
        Lists::Weights(_) => {
            let weights: Vec<Printed> = entries.iter().map(|e| e.printed.clone()).collect();
            certify_composition(&weights, claim.order())
        }
    };
    let certificate = match nearest {
        true => certificate.or_else(CertifyError::into_nearest),
        false => certificate,
    };
    let printed = |entry: &Entry| (entry.name, entry.printed.clone());
    Ok(Refinement {
        certificate: certificate
            .map_err(|error| in_file(file, error, &lists, &entries, claim_span))?,
        printed: entries.iter().map(printed).collect(),
        name: keys.name,
        source: keys.source,
    })
}

fn wrong_file(file: Input<'_>, span: Range<usize>, message: String) -> Error {
    file.error(
        &first_line(file.text, span),
        ErrorKind::Document { message },
    )
}

/// A printed number, or one that is computed from printed ones.
pub(super) fn read_printed(file: Input<'_>, text: &Spanned<String>) -> Result<Printed, Error> {
    Printed::parse(text.get_ref()).or_else(|error| {
        let span = text.span();
        // Without the quotes.
        let inside = span.start + 1..span.end.saturating_sub(1);
        let computed = (!inside.is_empty())
            .then(|| computed(file, inside))
            .flatten();
        computed.ok_or_else(|| wrong_file(file, span, error.to_string()))
    })
}

impl PrintedTable {
    fn lists(&self) -> Result<Lists<'_>, String> {
        let gradient = self.gradient.as_ref();
        match (&self.kick, &self.drift, &self.weights) {
            (Some(kick), Some(drift), None) => Ok(Lists::Splitting {
                kick,
                drift,
                gradient,
            }),
            (None, None, _) if gradient.is_some() => {
                Err("`gradient` goes with the `kick` and `drift` of a splitting".to_owned())
            }
            (None, None, Some(weights)) => Ok(Lists::Weights(weights)),
            (None, None, None) => {
                Err("printed are the `kick` and `drift` of a splitting, or the `weights` of a composition".to_owned())
            }
            (_, _, Some(_)) => {
                Err("a composition is all in `weights`: leave them out, or `kick` and `drift`".to_owned())
            }
            (kick, ..) => {
                let missing = if kick.is_some() { "drift" } else { "kick" };
                Err(format!("a splitting has `kick` and `drift`: `{missing}` is missing"))
            }
        }
    }
}

impl Lists<'_> {
    /// All coefficients, the kicks first.
    fn entries(&self, file: Input<'_>) -> Result<Vec<Entry>, Error> {
        type Named<'a> = (&'a List, fn(usize) -> Coefficient);
        let lists: Vec<Named<'_>> = match self {
            Lists::Splitting {
                kick,
                drift,
                gradient,
            } => {
                let both: [Named<'_>; 2] = [(kick, Coefficient::Kick), (drift, Coefficient::Drift)];
                let gradient = gradient.map(|list| -> Named<'_> { (list, Coefficient::Gradient) });
                both.into_iter().chain(gradient).collect()
            }
            Lists::Weights(weights) => vec![(weights, Coefficient::Weight)],
        };
        let entry = |name: Coefficient, text: &Spanned<String>| {
            let printed = read_printed(file, text)?;
            let span = text.span();
            Ok::<Entry, Error>(Entry {
                name,
                printed,
                span,
            })
        };
        let mut entries = Vec::new();
        for (list, name) in lists {
            for (index, text) in list.get_ref().iter().enumerate() {
                entries.push(entry(name(index), text)?);
            }
        }
        Ok(entries)
    }

    /// The place of the list named `kicks`, `drifts` or `weights` in an error.
    fn span(&self, what: &str) -> Range<usize> {
        match self {
            Lists::Splitting { kick, .. } if what == "kicks" => kick.span(),
            Lists::Splitting { drift, .. } => drift.span(),
            Lists::Weights(weights) => weights.span(),
        }
    }
}

fn splitting(entries: &[Entry]) -> Splitting {
    let of = |is_named: fn(&Coefficient) -> bool| {
        let entries = entries.iter().filter(|entry| is_named(&entry.name));
        entries.map(|entry| entry.printed.clone()).collect()
    };
    Splitting {
        kick: of(|name| matches!(name, Coefficient::Kick(_))),
        drift: of(|name| matches!(name, Coefficient::Drift(_))),
        gradient: of(|name| matches!(name, Coefficient::Gradient(_))),
    }
}

/// The claim of the file, and its place.
fn claim(
    file: Input<'_>,
    table: &Spanned<ClaimTable>,
    lists: &Lists<'_>,
) -> Result<(Claim, Range<usize>), Error> {
    let refused =
        |span: Range<usize>, message: &str| Err(wrong_file(file, span, message.to_owned()));
    let ClaimTable {
        class,
        order,
        perturbed,
    } = table.get_ref();
    if let Some(orders) = perturbed {
        if class.is_some() || order.is_some() {
            let message = "`perturbed` is a claim on its own, for H = H_A + εH_B: leave out `class` and `order`";
            return refused(orders.span(), message);
        }
        if matches!(lists, Lists::Weights(_)) {
            let message = "a composition of any symmetric base claims an `order` alone";
            return refused(orders.span(), message);
        }
        return Ok((Claim::Perturbed(orders.get_ref().clone()), orders.span()));
    }
    let Some(order) = order else {
        let message = "the claim is an `order` with a `class`, or `perturbed = [8, 4]`";
        return refused(table.span(), message);
    };
    let claim = match (lists, class) {
        (Lists::Weights(_), None) => Claim::SymmetricBase(*order.get_ref()),
        (Lists::Weights(_), Some(class)) => {
            let message =
                "a composition has its order with any symmetric base: leave out the `class`";
            return refused(class.span(), message);
        }
        (Lists::Splitting { .. }, None) => {
            let message = "the order of a splitting is for a `class`: \"separable\", or \"nystrom\" for quadratic T";
            return refused(table.span(), message);
        }
        (Lists::Splitting { .. }, Some(class)) => match class.get_ref().as_str() {
            "separable" => Claim::Separable(*order.get_ref()),
            "nystrom" => Claim::Nystrom(*order.get_ref()),
            other => {
                let kind = ErrorKind::Unknown {
                    what: "class",
                    name: shown(other),
                    known: "separable, nystrom".to_owned(),
                };
                return Err(file.error(&first_line(file.text, class.span()), kind));
            }
        },
    };
    Ok((claim, order.span()))
}

/// An error with its place in the file: a coefficient, a list or the claim.
fn in_file(
    file: Input<'_>,
    error: CertifyError,
    lists: &Lists<'_>,
    entries: &[Entry],
    claim: Range<usize>,
) -> Error {
    let message = error.to_string();
    let not_certified = |span: Range<usize>, message: String| {
        let kind = ErrorKind::NotCertified { message };
        file.error(&first_line(file.text, span), kind)
    };
    match &error {
        CertifyError::TooLarge { coefficient, .. } => {
            let named = |entry: &&Entry| entry.name.to_string() == *coefficient;
            let entry = entries.iter().find(named);
            wrong_file(file, entry.map_or(claim, |e| e.span.clone()), message)
        }
        CertifyError::Lengths { .. } | CertifyError::Stages { .. } => {
            wrong_file(file, lists.span("drifts"), message)
        }
        CertifyError::GradientLengths { .. } => {
            let Lists::Splitting {
                gradient: Some(gradient),
                ..
            } = lists
            else {
                return wrong_file(file, claim, message);
            };
            wrong_file(file, gradient.span(), message)
        }
        CertifyError::Order { .. } => wrong_file(file, claim, message),
        CertifyError::WeightSum { what, .. } => not_certified(lists.span(what), message),
        CertifyError::DifferentSolution { certificate, .. } => {
            match farthest(certificate, entries) {
                Some((entry, found)) => not_certified(
                    entry.span.clone(),
                    format!("{message}; the farthest is {} = {found}…", entry.name),
                ),
                None => not_certified(claim, message),
            }
        }
        _ => not_certified(claim, message),
    }
}

/// The coefficient that is farthest from its print, and a few of its digits.
fn farthest<'a>(certificate: &Certificate, entries: &'a [Entry]) -> Option<(&'a Entry, String)> {
    let wrong = certificate.wrong_digits().into_iter();
    // The first of equal ones.
    let (name, _) = wrong.rev().max_by(|(_, x), (_, y)| x.cmp(y))?;
    let entry = entries.iter().find(|entry| entry.name == name)?;
    let digits = certificate.decimal(name, 20).ok()??;
    Some((entry, digits.to_string()))
}
