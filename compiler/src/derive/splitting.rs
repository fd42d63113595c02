//! Splittings: their definition and parsing.
//!
//! For `H = T(p) + U(q)` the two parts can be integrated exactly. A splitting composes fractions of their flows
//! (Ruth 1983; GNI II.5): for `i = 1, …, n`
//!
//! ```text
//! kick    p −= kick_i h ∂U/∂q(q)
//! drift   q += drift_i h ∂T/∂p(p)
//! ```
//!
//! With quadratic `T = pᵀM⁻¹p/2` the potential of a kick may contain `∇U·M⁻¹∇U`, the function of `[B, [A, B]]` (Suzuki 1995; Chin
//! 1997). With the force `f = −∂U/∂q` and its derivative `f′` such a gradient kick is
//!
//! ```text
//! kick    p += h (kick_i f + 2 g_i h² f′ M⁻¹ f),    the flow of kick_i U − g_i h² ∇U·M⁻¹∇U
//! ```

use super::fractions::off;
use super::reading::{Errors, misfit, misfit_at, read_vector, switch};
use super::sequence::{Factor, Sequence, Substep};
use crate::definition::{Definition, Key};
use crate::error::{Error, ErrorKind};
use crate::expression::{Input, shown};
use crate::limits::Limits;
use crate::quadrature::check_stages;
use crate::symbolic::Constant;

/// A flow of a splitting as written.
pub struct Written<'a, T> {
    pub flow: Flow,
    /// The fraction of the step.
    pub fraction: &'a T,
    /// The weight of a gradient kick.
    pub gradient: Option<&'a T>,
}

impl<T> Clone for Written<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Written<'_, T> {}

/// The flow of one part of `H = T(p) + U(q)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// The flow of `U(q)`, which changes momenta.
    Kick,
    /// The flow of `T(p)`, which changes positions.
    Drift,
}

impl Flow {
    /// The other flow.
    pub fn other(self) -> Self {
        match self {
            Flow::Kick => Flow::Drift,
            Flow::Drift => Flow::Kick,
        }
    }

    /// The key of its list.
    fn key(self) -> Key {
        match self {
            Flow::Kick => Key::Kick,
            Flow::Drift => Key::Drift,
        }
    }
}

/// A splitting with exact coefficients.
pub type Splitting = Lists<Constant>;

/// A splitting as written, with coefficients of any kind.
pub struct Lists<T> {
    kick: Vec<T>,
    drift: Vec<T>,
    /// A weight for each kick.
    gradient: Option<Vec<T>>,
    /// The flow that comes first of the two with the same index.
    first: Flow,
    /// Whether the lists are the first half of a palindromic sequence.
    symmetric: bool,
}

impl<T> Lists<T> {
    /// Reads `kick` and `drift`, each list by `read`, `first` and `symmetric`.
    ///
    /// Both lists have the same length. Only if they are mirrored, the first flow may occur once more than the
    /// other: it is then in the middle.
    pub fn read(
        definition: &Definition,
        limits: &Limits,
        errors: &mut Errors,
        read: impl Fn(Key, &str) -> Result<Vec<T>, Error>,
    ) -> Option<Self> {
        let first = errors.note(read_first(definition));
        let symmetric = errors.note(switch(definition, Key::Symmetric));
        let mut list = |flow: Flow| match definition.get(flow.key()) {
            Some(text) => errors.note(read(flow.key(), text)),
            None => {
                errors.push(misfit(format!(
                    "a splitting has `kick` and `drift`, two lists of the same length: `{}` is missing beside `{}`",
                    flow.key().name(),
                    flow.other().key().name()
                )));
                None
            }
        };
        let (kick, drift) = (list(Flow::Kick), list(Flow::Drift));
        let gradient = definition.get(Key::Gradient);
        let gradient = gradient.map(|text| errors.note(read(Key::Gradient, text)));
        let lists = Lists {
            kick: kick?,
            drift: drift?,
            gradient: match gradient {
                Some(read) => Some(read?),
                None => None,
            },
            first: first?,
            symmetric: symmetric?,
        };
        errors.note(lists.check_lengths(definition, limits))?;
        Some(lists)
    }

    /// The weights of gradient kicks, as written.
    pub fn gradient(&self) -> Option<&[T]> {
        self.gradient.as_deref()
    }

    /// The list of a flow, as written.
    pub fn list(&self, flow: Flow) -> &[T] {
        match flow {
            Flow::Kick => &self.kick,
            Flow::Drift => &self.drift,
        }
    }

    fn check_lengths(&self, definition: &Definition, limits: &Limits) -> Result<(), Error> {
        let second = self.first.other();
        let [n, m] = [self.first, second].map(|flow| self.list(flow).len());
        if n != m && !(self.symmetric && n == m + 1) {
            let middle = if self.symmetric {
                format!(
                    " the same number of both, or one more in `{}`, which is in the middle then",
                    self.first.key().name()
                )
            } else {
                " the same number of both; write 0 where there is none".to_owned()
            };
            let message = format!(
                "{} kick{} and {} drift{}:{middle}",
                self.kick.len(),
                plural(self.kick.len()),
                self.drift.len(),
                plural(self.drift.len()),
            );
            return Err(misfit_at(definition, second.key(), message));
        }
        if let Some(gradient) = self.gradient.as_ref().map(Vec::len)
            && gradient != self.kick.len()
        {
            let message = format!(
                "{} kick{} and {gradient} weight{} of gradient kicks: one for each kick; write 0 where there is none",
                self.kick.len(),
                plural(self.kick.len()),
                plural(gradient),
            );
            return Err(misfit_at(definition, Key::Gradient, message));
        }
        let stages = if self.symmetric { n + m } else { n };
        check_stages(&stages.into(), limits)
            .map(|_| ())
            .map_err(|kind| {
                let key = self.first.key();
                let text = definition.get(key).unwrap_or_default();
                let name = key.name();
                Input { name, text }.error(&(0..text.len()), kind)
            })
    }

    /// Kicks and drifts in the order of the step.
    pub fn flows(&self) -> Vec<Written<'_, T>> {
        let second = self.first.other();
        let mut flows = Vec::new();
        for i in 0..self.list(self.first).len() {
            let written = |flow: Flow| {
                let gradient = self.gradient.as_ref().filter(|_| flow == Flow::Kick);
                Some(Written {
                    flow,
                    fraction: self.list(flow).get(i)?,
                    gradient: gradient.and_then(|all| all.get(i)),
                })
            };
            flows.extend([self.first, second].map(written));
        }
        let mut flows: Vec<_> = flows.into_iter().flatten().collect();
        if self.symmetric {
            flows.extend_from_within(..flows.len().saturating_sub(1));
            let half = flows.len() / 2 + 1;
            flows[half..].reverse();
        }
        flows
    }

    /// The flow that comes first of the two with the same index.
    pub fn first(&self) -> Flow {
        self.first
    }

    /// The parts in canonical form.
    pub fn parts(&self, text: impl Fn(&T) -> String) -> Vec<(Key, String)> {
        let list = |values: &[T]| {
            let values: Vec<String> = values.iter().map(&text).collect();
            values.join(", ")
        };
        let mut parts = vec![
            (Key::Kick, list(&self.kick)),
            (Key::Drift, list(&self.drift)),
        ];
        if let Some(gradient) = &self.gradient {
            parts.push((Key::Gradient, list(gradient)));
        }
        if self.first == Flow::Drift {
            parts.push((Key::First, Key::Drift.name().to_owned()));
        }
        if self.symmetric {
            parts.push((Key::Symmetric, "true".to_owned()));
        }
        parts
    }
}

impl Splitting {
    /// Reads exact coefficients.
    pub fn read_exact(
        definition: &Definition,
        limits: &Limits,
        errors: &mut Errors,
    ) -> Option<Self> {
        Splitting::read_with_sum(1, &[Flow::Kick, Flow::Drift], definition, limits, errors)
    }

    /// Reads exact coefficients, where the lists of these flows have a given sum.
    pub fn read_with_sum(
        wanted: u8,
        of: &[Flow],
        definition: &Definition,
        limits: &Limits,
        errors: &mut Errors,
    ) -> Option<Self> {
        let splitting = Splitting::read(definition, limits, errors, read_vector)?;
        errors.note(splitting.check_sums(wanted, of, definition))?;
        Some(splitting)
    }

    /// Checks that lists have their sum; a method whose lists do not sum to 1 has order 0.
    fn check_sums(&self, wanted: u8, of: &[Flow], definition: &Definition) -> Result<(), Error> {
        let flows = self.flows();
        for &flow in of {
            let values = flows.iter().filter(|written| written.flow == flow);
            if let Some(sum) = off(wanted, values.map(|written| written.fraction)) {
                let mirrored = if self.symmetric { ", mirrored," } else { "" };
                let message = format!(
                    "the {}s{mirrored} sum to {sum}, but must sum to {wanted}; give exact numbers, one of them as {wanted} minus the others",
                    flow.key().name(),
                );
                return Err(misfit_at(definition, flow.key(), message));
            }
        }
        Ok(())
    }

    /// The sequence of kicks and drifts of the step.
    pub fn sequence(&self) -> Sequence {
        let substep = |written: Written<'_, Constant>| {
            Substep::new(
                written.flow,
                Factor::Constant(written.fraction.clone()),
                written.gradient.cloned().map(Factor::Constant),
            )
        };
        Sequence::new(self.first, self.flows().into_iter().map(substep).collect())
    }
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}

fn read_first(definition: &Definition) -> Result<Flow, Error> {
    match definition.get(Key::First) {
        None | Some("kick") => Ok(Flow::Kick),
        Some("drift") => Ok(Flow::Drift),
        Some(text) => {
            let input = Input {
                name: Key::First.name(),
                text,
            };
            let kind = ErrorKind::Type {
                found: shown(text),
                expected: "`kick` or `drift`".to_owned(),
            };
            Err(input.error(&(0..text.len()), kind))
        }
    }
}
