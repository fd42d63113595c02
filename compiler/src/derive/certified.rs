//! Splittings from printed digits: what is derived is the exact method that is proved to be near them.

use std::ops::Range;

use super::problem::{Errors, misfit, misfit_at};
use super::sequence::{Factor, Sequence, Substep};
use super::splitting::Flow;
use crate::algebra::Real;
use crate::certify::{Certificate, CertifyError, Claim, Coefficient, Printed, Splitting, certify};
use crate::definition::{Definition, Key, pieces, trimmed};
use crate::error::{Error, ErrorKind};
use crate::expression::{Input, shown};
use crate::limits::Limits;
use crate::quadrature::check_stages;
use crate::symbolic::Constant;

/// Printed kicks and drifts with the certificate of the claimed order.
#[derive(Clone)]
pub struct Certified {
    printed: Splitting,
    certificate: Certificate,
}

impl Certified {
    /// Reads `kick`, `drift` and `claim`, and certifies them.
    pub fn read(definition: &Definition, limits: &Limits, errors: &mut Errors) -> Option<Self> {
        let claim = errors.note(read_claim(definition));
        let mut list = |key: Key| match definition.get(key) {
            Some(text) => errors.note(read_printed(key, text)),
            None => {
                errors.push(misfit(format!(
                    "a `claim` is about the printed `kick` and `drift` of a splitting: `{}` is missing",
                    key.name()
                )));
                None
            }
        };
        let (kick, drift) = (list(Key::Kick), list(Key::Drift));
        let printed = Splitting {
            kick: kick?,
            drift: drift?,
        };
        let claim = claim?;
        let place = |key: Key, kind: ErrorKind| {
            let (name, text) = (key.name(), definition.get(key).unwrap_or_default());
            Input { name, text }.error(&(0..text.len()), kind)
        };
        let few = check_stages(&printed.kick.len().into(), limits);
        errors.note(few.map_err(|kind| place(Key::Kick, kind)))?;
        let certificate = certify(&printed, &claim).map_err(|error| {
            let message = error.to_string();
            match &error {
                CertifyError::Lengths { .. } => misfit_at(definition, Key::Drift, message),
                CertifyError::WeightSum { what, .. } => {
                    let key = if *what == "kicks" {
                        Key::Kick
                    } else {
                        Key::Drift
                    };
                    place(key, ErrorKind::NotCertified { message })
                }
                _ => place(Key::Claim, ErrorKind::NotCertified { message }),
            }
        });
        Some(Certified {
            printed,
            certificate: errors.note(certificate)?,
        })
    }

    /// What is proved of the method.
    pub fn claim(&self) -> &Claim {
        self.certificate.claim()
    }

    /// What the step does. Coefficients that are equal by structure are the same expression.
    pub fn sequence(&self) -> Sequence {
        let mut known: Vec<(Coefficient, Real)> = Vec::new();
        let mut factor = |name: Coefficient| {
            if let Some(value) = self.certificate.rational(name) {
                // One that is too long for a constant is as exact as an expression.
                let constant = Constant::rational(value.clone());
                return constant
                    .map_or_else(|_| Factor::Real(Real::rational(value)), Factor::Constant);
            }
            let same = |(other, _): &&(Coefficient, Real)| self.certificate.same(name, *other);
            if let Some((_, real)) = known.iter().find(same) {
                return Factor::Real(real.clone());
            }
            let real = Real::certified(self.certificate.clone(), name);
            known.push((name, real.clone()));
            Factor::Real(real)
        };
        let mut substeps = Vec::new();
        for index in 0..self.printed.kick.len() {
            let kick = factor(Coefficient::Kick(index));
            substeps.push(Substep::of(Flow::Kick, kick));
            let drift = factor(Coefficient::Drift(index));
            substeps.push(Substep::of(Flow::Drift, drift));
        }
        Sequence::new(Flow::Kick, substeps)
    }

    /// The number of stages, at most.
    pub fn stages(&self) -> usize {
        self.sequence().stages()
    }

    /// The parts in canonical form.
    pub fn parts(&self) -> Vec<(Key, String)> {
        let list = |values: &[Printed]| {
            let values: Vec<&str> = values.iter().map(Printed::text).collect();
            values.join(", ")
        };
        let claim = match self.claim() {
            Claim::Separable(order) | Claim::SymmetricBase(order) => format!("separable({order})"),
            Claim::Nystrom(order) => format!("nystrom({order})"),
            Claim::Perturbed(orders) => {
                let orders: Vec<String> = orders.iter().map(usize::to_string).collect();
                format!("perturbed({})", orders.join(", "))
            }
        };
        vec![
            (Key::Kick, list(&self.printed.kick)),
            (Key::Drift, list(&self.printed.drift)),
            (Key::Claim, claim),
        ]
    }
}

/// Reads `separable(6)`, `nystrom(6)` or `perturbed(8, 6, 4)`.
fn read_claim(definition: &Definition) -> Result<Claim, Error> {
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
        let name = Key::Claim.name();
        Input { name, text }.error(&(0..text.len()), kind)
    })
}

/// Reads a list of decimals, which may stand in brackets.
fn read_printed(key: Key, text: &str) -> Result<Vec<Printed>, Error> {
    let whole = trimmed(text, 0..text.len());
    let inner = text[whole.clone()].strip_prefix('[');
    let inside = match inner.and_then(|rest| rest.strip_suffix(']')) {
        Some(_) => whole.start + 1..whole.end - 1,
        None => whole,
    };
    let read = |range: Range<usize>| {
        let range = trimmed(text, range);
        let number: String = text[range.clone()].split_whitespace().collect();
        let name = key.name();
        Printed::parse(&number).map_err(|error| {
            let message = error.to_string();
            Input { name, text }.error(&range, ErrorKind::Definition { message })
        })
    };
    pieces(text, inside).into_iter().map(read).collect()
}
