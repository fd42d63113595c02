//! Splittings from printed digits: the derived method is the exact one that is proved to be near them.

use super::claim;
use super::reading::{Errors, misfit};
use super::sequence::{Factor, Sequence, Substep};
use super::splitting::{Flow, Lists, Written};
use crate::algebra::Real;
use crate::certify::{Certificate, Claim, Coefficient, Printed, Splitting, certify};
use crate::definition::{Definition, Key};
use crate::error::Error;
use crate::limits::Limits;
use crate::symbolic::Constant;

/// Printed kicks and drifts with the certificate of the claimed order.
pub struct Certified {
    printed: Lists<Printed>,
    certificate: Certificate,
    wrong_digits: Vec<Error>,
}

impl Certified {
    /// Reads `kick`, `drift`, `first`, `symmetric` and `claim`, and certifies them.
    pub fn read(definition: &Definition, limits: &Limits, errors: &mut Errors) -> Option<Self> {
        let missing = |key: Key| definition.get(key).is_none();
        if missing(Key::Kick) && missing(Key::Drift) {
            let message = "a `claim` is about the printed `kick` and `drift` of a splitting, or the `weights` of a `base`, which are missing";
            errors.push(misfit(message.to_owned()));
            return None;
        }
        let claim = errors.note(claim::read(definition));
        let printed = Lists::read(definition, limits, errors, claim::read_printed)?;
        let (splitting, flows) = whole(&printed);
        let certificate = certify(&splitting, &claim?);
        let certificate = certificate.map_err(|error| claim::refused(definition, &error));
        let certificate = errors.note(certificate)?;
        // The flows of a mirrored list come again after the written ones.
        let (mut kicks, mut drifts) = (0.., 0..);
        let written = flows.into_iter().flat_map(|named| match named.flow {
            Flow::Kick => {
                let index = kicks.next().unwrap_or(usize::MAX);
                let gradient = named.gradient.map(|name| (Key::Gradient, index, name));
                [Some((Key::Kick, index, named.fraction)), gradient]
            }
            Flow::Drift => {
                let index = drifts.next().unwrap_or(usize::MAX);
                [Some((Key::Drift, index, named.fraction)), None]
            }
        });
        let written = written.flatten();
        let count = |key: Key| match key {
            Key::Drift => printed.list(Flow::Drift).len(),
            _ => printed.list(Flow::Kick).len(),
        };
        let written = written.filter(|(key, index, _)| *index < count(*key));
        let wrong_digits = claim::wrong_digits(definition, &certificate, written);
        Some(Certified {
            printed,
            certificate,
            wrong_digits,
        })
    }

    /// The proved claim of the method.
    pub fn claim(&self) -> &Claim {
        self.certificate.claim()
    }

    /// The printed numbers that differ from the rounded exact ones.
    pub fn wrong_digits(&self) -> &[Error] {
        &self.wrong_digits
    }

    /// The sequence of kicks and drifts of the step.
    pub fn sequence(&self) -> Sequence {
        let mut factors = Factors::new(self.certificate.clone());
        let (_, flows) = whole(&self.printed);
        let substep = |named: Named| {
            let fraction = factors.get(named.fraction);
            Substep::new(
                named.flow,
                fraction,
                named.gradient.map(|name| factors.get(name)),
            )
        };
        Sequence::new(
            self.printed.first(),
            flows.into_iter().map(substep).collect(),
        )
    }

    /// An upper bound on the number of stages.
    pub fn stages(&self) -> usize {
        self.sequence().stages()
    }

    /// The parts in canonical form.
    pub fn parts(&self) -> Vec<(Key, String)> {
        let mut parts = self.printed.parts(|printed| printed.text().to_owned());
        parts.push((Key::Claim, self.claim().notation()));
        parts
    }
}

/// A written flow with the names of its coefficients.
struct Named {
    flow: Flow,
    fraction: Coefficient,
    /// The weight of a gradient kick.
    gradient: Option<Coefficient>,
}

/// The splitting in which each kick comes before the drift of the same index, and the written flows with their names in it.
fn whole(printed: &Lists<Printed>) -> (Splitting, Vec<Named>) {
    let [mut kick, mut drift, mut gradient]: [Vec<Printed>; 3] = Default::default();
    let mut names = Vec::new();
    for written in printed.flows() {
        let Written { flow, fraction, .. } = written;
        let of_gradient = Coefficient::Gradient(kick.len());
        let name = match flow {
            Flow::Kick => {
                kick.push(fraction.clone());
                gradient.push(written.gradient.cloned().unwrap_or_else(Printed::zero));
                Coefficient::Kick(kick.len() - 1)
            }
            Flow::Drift => {
                if kick.len() == drift.len() {
                    kick.push(Printed::zero());
                    gradient.push(Printed::zero());
                }
                drift.push(fraction.clone());
                Coefficient::Drift(drift.len() - 1)
            }
        };
        names.push(Named {
            flow,
            fraction: name,
            gradient: written.gradient.map(|_| of_gradient),
        });
    }
    drift.resize_with(kick.len(), Printed::zero);
    if printed.gradient().is_none() {
        gradient.clear();
    }
    let splitting = Splitting {
        kick,
        drift,
        gradient,
    };
    (splitting, names)
}

/// The coefficients of a certified method. Coefficients that are equal by structure share one expression.
pub struct Factors {
    certificate: Certificate,
    known: Vec<(Coefficient, Real)>,
}

impl Factors {
    /// The coefficients of a certificate.
    pub fn new(certificate: Certificate) -> Self {
        Factors {
            certificate,
            known: Vec::new(),
        }
    }

    /// The coefficient of an existing name.
    pub fn get(&mut self, name: Coefficient) -> Factor {
        let Factors { certificate, known } = self;
        if let Some(value) = certificate.rational(name) {
            // A rational that is too long for a constant becomes an equally exact expression.
            let constant = Constant::rational(value.clone());
            return constant.map_or_else(|_| Factor::Real(Real::rational(value)), Factor::Constant);
        }
        if let Some((_, real)) = known
            .iter()
            .find(|(other, _)| certificate.same(name, *other))
        {
            return Factor::Real(real.clone());
        }
        let real = Real::certified(certificate.clone(), name);
        known.push((name, real.clone()));
        Factor::Real(real)
    }
}
