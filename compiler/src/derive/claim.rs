//! Printed digits and what is claimed of them.

use std::ops::Range;

use super::composition::separated;
use super::problem::misfit_at;
use crate::certify::{CertifyError, Claim, Printed};
use crate::definition::{Definition, Key, trimmed};
use crate::error::{Error, ErrorKind};
use crate::expression::{Input, parse_list, shown};

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

/// The claim as it is written.
pub fn text(claim: &Claim) -> String {
    match claim {
        Claim::Separable(order) | Claim::SymmetricBase(order) => format!("separable({order})"),
        Claim::Nystrom(order) => format!("nystrom({order})"),
        Claim::Perturbed(orders) => {
            let orders: Vec<String> = orders.iter().map(usize::to_string).collect();
            format!("perturbed({})", orders.join(", "))
        }
    }
}

/// Reads a list of decimals, which may stand in brackets.
pub fn read_printed(key: Key, text: &str) -> Result<Vec<Printed>, Error> {
    let whole = trimmed(text, 0..text.len());
    let inner = text[whole.clone()].strip_prefix('[');
    let inside = match inner.and_then(|rest| rest.strip_suffix(']')) {
        Some(_) => whole.start + 1..whole.end - 1,
        None => whole,
    };
    let read = |range: Range<usize>| {
        let number: String = text[range.clone()].split_whitespace().collect();
        let name = key.name();
        Printed::parse(&number).map_err(|error| {
            let part = &text[range.clone()];
            let exact = parse_list(Input { name, text: part }).is_ok();
            let hint = match exact {
                true => "; a `claim` is about printed digits: leave it out where numbers are exact",
                false => "",
            };
            let message = format!("{error}{hint}");
            Input { name, text }.error(&range, ErrorKind::Definition { message })
        })
    };
    separated(text, inside).into_iter().map(read).collect()
}

/// Why printed digits are not certified, at the part that it is about.
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

/// An error about a whole part.
fn at(definition: &Definition, key: Key, kind: ErrorKind) -> Error {
    let (name, text) = (key.name(), definition.get(key).unwrap_or_default());
    Input { name, text }.error(&(0..text.len()), kind)
}
