//! Printed digits and their claims.

use std::ops::Range;

use super::composition::separated;
use super::reading::misfit_at;
use crate::certify::{Certificate, CertifyError, Claim, Coefficient, Digits, Printed};
use crate::definition::{Definition, Key, trimmed};
use crate::error::{Error, ErrorKind};
use crate::expression::{Input, complex, is_complex, parse_list, shown};
use crate::numerals::computed;

/// Reads `separable(6)`, `nystrom(6)` or `perturbed(8, 6, 4)`.
pub fn read(definition: &Definition) -> Result<Claim, Error> {
    let text = definition.get(Key::Claim).unwrap_or_default();
    let compact: String = text.split_whitespace().collect();
    let call = compact.strip_suffix(')').and_then(|c| c.split_once('('));
    let claim = call.and_then(|(class, orders)| {
        let orders: Vec<usize> = orders
            .split(',')
            .map(|order| order.parse().ok())
            .collect::<Option<_>>()?;
        match (class, &*orders) {
            ("separable", [order]) => Some(Claim::Separable(*order)),
            ("nystrom", [order]) => Some(Claim::Nystrom(*order)),
            ("perturbed", _) => Some(Claim::Perturbed(orders)),
            _ => None,
        }
    });
    claim.ok_or_else(|| {
        let kind = ErrorKind::Type {
            found: shown(text),
            expected: "`separable(6)`, `nystrom(6)` or `perturbed(8, 6, 4)`".to_owned(),
        };
        at(definition, Key::Claim, kind)
    })
}

/// Reads a list of decimals, optionally in brackets.
pub fn read_printed(key: Key, text: &str) -> Result<Vec<Printed>, Error> {
    let read = |range: Range<usize>| {
        let name = key.name();
        printed(Input { name, text }, range.clone()).map_err(|error| {
            let part = &text[range.clone()];
            if is_complex(part.trim()) {
                return Input { name, text }.error(&range, complex());
            }
            let exact = parse_list(Input { name, text: part }).is_ok();
            let hint = match exact {
                true => "; a `claim` is about printed digits: leave it out where numbers are exact",
                false => "",
            };
            let message = format!("{error}{hint}");
            Input { name, text }.error(&range, ErrorKind::Definition { message })
        })
    };
    separated(text, list_inside(text))
        .into_iter()
        .map(read)
        .collect()
}

/// A printed number, or one that is computed from printed ones.
fn printed(input: Input<'_>, range: Range<usize>) -> Result<Printed, CertifyError> {
    let number: String = input.text[range.clone()].split_whitespace().collect();
    Printed::parse(&number).or_else(|error| computed(input, range).ok_or(error))
}

/// The error for printed digits that are not certified, placed at the relevant part.
pub fn refused(definition: &Definition, error: &CertifyError) -> Error {
    let message = error.to_string();
    let key = match error {
        CertifyError::WeightSum { what, .. } => match *what {
            "kicks" => Key::Kick,
            "drifts" => Key::Drift,
            _ => Key::Weights,
        },
        CertifyError::Lengths { .. } => return misfit_at(definition, Key::Drift, message),
        _ => Key::Claim,
    };
    at(definition, key, ErrorKind::NotCertified { message })
}

/// The printed numbers that differ from the rounded exact ones, each at its place in the definition.
///
/// `items` are the numbers as written: the key and the index in its list.
pub fn wrong_digits(
    definition: &Definition,
    certificate: &Certificate,
    items: impl IntoIterator<Item = (Key, usize, Coefficient)>,
) -> Vec<Error> {
    let all = certificate.wrong_digits();
    let wrong = |name: Coefficient| all.iter().any(|(other, _)| *other == name);
    let items = items.into_iter().filter(|(_, _, name)| wrong(*name));
    items
        .map(|(key, index, name)| {
            let text = definition.get(key).unwrap_or_default();
            let range = separated(text, list_inside(text)).get(index).cloned();
            let range = range.unwrap_or(0..text.len());
            let input = Input {
                name: key.name(),
                text,
            };
            let message = wrong_number(certificate, name, input, range.clone());
            input.error(&range, ErrorKind::WrongDigits { message })
        })
        .collect()
}

/// The message about one wrong printed number.
fn wrong_number(
    certificate: &Certificate,
    name: Coefficient,
    input: Input<'_>,
    range: Range<usize>,
) -> String {
    let text = shown(&input.text[range.clone()]);
    let printed = printed(input, range).ok();
    let exact = printed.and_then(|printed| certificate.as_printed(name, &printed));
    let mut message = format!("`{text}` is not the exact {name}, rounded");
    if let Some(exact) = exact {
        message.push_str(&format!(": that is {exact}"));
    }
    let suspects = certificate.suspects();
    if !suspects.is_empty() {
        let names: Vec<String> = suspects.iter().map(Coefficient::to_string).collect();
        message.push_str(&format!(", unless {} is wrong instead", names.join(" or ")));
    }
    message.push_str(match certificate.digits() {
        Digits::All => "",
        Digits::Excluded => {
            "; no method of this structure and order has all printed digits, which is proved"
        }
        Digits::NotFound => {
            "; no method was found that has all printed digits, which is not proved"
        }
    });
    message
}

/// The processor `P(h) = Q(h) Q(−h)`, as it is written: `back_and_forth(1/3, -1/3)`.
pub const BACK_AND_FORTH: &str = "back_and_forth";

/// The contents of the brackets of a list or of [`BACK_AND_FORTH`], or the whole text.
fn list_inside(text: &str) -> Range<usize> {
    let whole = trimmed(text, 0..text.len());
    let call = text[whole.clone()].strip_prefix(BACK_AND_FORTH);
    let call = call.and_then(|rest| rest.trim_start().strip_prefix('(')?.strip_suffix(')'));
    if let Some(inside) = call {
        return whole.end - 1 - inside.len()..whole.end - 1;
    }
    let inner = text[whole.clone()].strip_prefix('[');
    match inner.and_then(|rest| rest.strip_suffix(']')) {
        Some(_) => whole.start + 1..whole.end - 1,
        None => whole,
    }
}

/// An error about a whole part.
fn at(definition: &Definition, key: Key, kind: ErrorKind) -> Error {
    let (name, text) = (key.name(), definition.get(key).unwrap_or_default());
    Input { name, text }.error(&(0..text.len()), kind)
}
