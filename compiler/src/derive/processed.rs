//! Processed methods `P ∘ K ∘ P⁻¹`: a kernel K that is taken in every step, and a processor P that is taken where a state is shown
//! (Butcher 1969; Blanes, Casas & Murua 2004).

use super::base_method::{Base, Based, Component, Weights, fraction_text, mirror, read_fraction};
use super::certified::Factors;
use super::claim::{self, BACK_AND_FORTH};
use super::composition::{Step, inner, separated};
use super::construction_kind::Kind;
use super::fractions::off;
use super::problem::{Construction, Problem};
use super::reading::{Errors, misfit_at};
use super::sequence::Factor;
use super::splitting::{Flow, Splitting};
use crate::certify::{Claim, Coefficient, Printed, Processor, certify_processed};
use crate::definition::{Definition, Key, read_parts, trimmed};
use crate::error::{Error, ErrorKind};
use crate::expression::{ExpressionKind, Input, parse_list};
use crate::limits::Limits;
use crate::order::GivenOrder;
use crate::quadrature::check_stages;
use crate::symbolic::Constant;

/// A kernel and a processor.
pub struct Processed {
    kernel: Problem,
    processor: Problem,
    /// `P⁻¹`, K and P: the first one first.
    steps: Vec<Step>,
    /// The processor in canonical form.
    text: String,
    /// The certificate of printed weights.
    given: Option<GivenOrder>,
    /// The printed weights that differ from the rounded exact ones.
    wrong_digits: Vec<Error>,
}

impl Processed {
    /// Reads a method with its `processor`.
    pub fn read(
        definition: &Definition,
        kind: Kind,
        limits: &Limits,
        errors: &mut Errors,
    ) -> Option<Self> {
        if definition.get(Key::Adjoint) == Some("true") {
            let message = "the adjoint of a processed method has another processor, P(-h): take the adjoint of the kernel";
            errors.push(misfit_at(definition, Key::Adjoint, message.to_owned()));
            return None;
        }
        // The flags of the definition hold for the whole.
        let left_out = [Key::Processor, Key::Claim, Key::Exchange, Key::Adjoint];
        let kernel = definition
            .parts()
            .filter(|(key, _)| !left_out.contains(key));
        let kernel = Definition::new(kernel);
        if kind == Kind::Splitting {
            let kernel = Splitting::read_exact(&kernel, limits, errors)?;
            let processor = read_flows(definition, limits, errors)?;
            let text = Problem::new(Construction::Splitting(processor));
            let canonical = format!("[{}]", text.definition());
            let kernel = Problem::new(Construction::Splitting(kernel));
            return Some(Processed::new(kernel, text, canonical));
        }
        if definition.get(Key::Claim).is_some() {
            let base = definition.get(Key::Base).unwrap_or_default();
            let base = Base::read(base, limits)
                .map_err(|all| errors.extend(all))
                .ok()?;
            return errors.note(Processed::certified(definition, base, limits));
        }
        let kernel = Based::read(&kernel, limits, errors)?;
        let (components, text) = errors.note(read_steps(definition, limits))?;
        let processor = based(&kernel.base, text.clone(), false, components);
        let kernel = Problem::new(Construction::from(kernel));
        Some(Processed::new(kernel, processor, text))
    }

    fn new(kernel: Problem, processor: Problem, text: String) -> Self {
        let step = |fraction, method: &Problem| Step {
            fraction: Constant::whole(fraction),
            method: method.clone(),
        };
        // The inverse of P(h) is the step −h of its adjoint.
        let steps = vec![
            step(-1, &processor.adjoint()),
            step(1, &kernel),
            step(1, &processor),
        ];
        Processed {
            kernel,
            processor,
            steps,
            text,
            given: None,
            wrong_digits: Vec::new(),
        }
    }

    /// Reads printed weights of the kernel and the processor, and certifies their claim.
    fn certified(definition: &Definition, base: Base, limits: &Limits) -> Result<Self, Error> {
        let claim = claim::read(definition)?;
        let Claim::Separable(order) = claim else {
            let message = "printed `weights` claim an order that they give every symmetric base: `separable(8)`";
            return Err(misfit_at(definition, Key::Claim, message.to_owned()));
        };
        let Some(text) = definition.get(Key::Weights) else {
            let message =
                "beside a `base` a `claim` is about its printed `weights`, which are missing";
            return Err(misfit_at(definition, Key::Claim, message.to_owned()));
        };
        let mut printed = claim::read_printed(Key::Weights, text)?;
        let texts = |printed: &[Printed]| {
            let texts: Vec<&str> = printed.iter().map(Printed::text).collect();
            texts.join(", ")
        };
        let (canonical, written) = (texts(&printed), printed.len());
        let symmetric = definition.get(Key::Symmetric) == Some("true");
        if symmetric {
            mirror(&mut printed);
        }
        check_count(definition, Key::Weights, printed.len(), limits)?;
        let processor = definition.get(Key::Processor).unwrap_or_default();
        let both_ways = processor.trim_start().starts_with(BACK_AND_FORTH);
        let weights = claim::read_printed(Key::Processor, processor)?;
        let processor_text = call(both_ways, texts(&weights));
        let processor = match both_ways {
            true => Processor::BackAndForth(weights),
            false => Processor::Steps(weights),
        };
        let steps = processor.clone().steps(|weight| weight).len();
        check_count(definition, Key::Processor, steps, limits)?;
        base.proved_symmetric_splitting(definition)?;
        let certificate = certify_processed(&printed, &processor, order)
            .map_err(|error| claim::refused(definition, &error))?;
        let kernel = (0..written).map(|i| (Key::Weights, i, Coefficient::Weight(i)));
        let count = processor.weights().len();
        let others = (0..count).map(|i| (Key::Processor, i, Coefficient::Processor(i)));
        let wrong_digits = claim::wrong_digits(definition, &certificate, kernel.chain(others));
        let mut factors = Factors::new(certificate);
        let mut component = |name| Component {
            fraction: factors.get(name),
            adjoint: false,
        };
        let kernel: Vec<Component> = {
            let weights = 0..printed.len();
            weights.map(|i| component(Coefficient::Weight(i))).collect()
        };
        let written = (0..count).map(|i| component(Coefficient::Processor(i)));
        let processor = both(processor.with(written.collect()))
            .map_err(|kind| misfit_at(definition, Key::Processor, kind.to_string()))?;
        let kernel = based(&base, canonical, symmetric, kernel);
        let processor = based(&base, processor_text.clone(), false, processor);
        Ok(Processed {
            given: Some(GivenOrder::certified(claim)),
            wrong_digits,
            ..Processed::new(kernel, processor, processor_text)
        })
    }

    /// The kernel and the processor.
    pub fn parts_of_run(&self) -> [Problem; 2] {
        [&self.kernel, &self.processor].map(Problem::clone)
    }

    /// The steps of the whole method.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The parts in canonical form.
    pub fn parts(&self) -> Vec<(Key, String)> {
        let kernel = self.kernel.definition();
        let parts = kernel.parts().map(|(key, text)| (key, text.to_owned()));
        let claim = self.given.as_ref();
        let claim = claim.map(|given| (Key::Claim, given.claim.notation()));
        let processor = [(Key::Processor, self.text.clone())];
        parts.chain(processor).chain(claim).collect()
    }

    /// The order that the certificate of printed weights proves.
    pub fn given(&self) -> Option<GivenOrder> {
        self.given.clone()
    }

    /// The printed weights that differ from the rounded exact ones.
    pub fn wrong_digits(&self) -> &[Error] {
        &self.wrong_digits
    }
}

/// Steps of a base.
fn based(base: &Base, text: String, symmetric: bool, components: Vec<Component>) -> Problem {
    let weights = Weights {
        text,
        symmetric,
        components,
        given: None,
        claimed: false,
        wrong_digits: Vec::new(),
    };
    Problem::new(Construction::from(Based {
        base: base.clone(),
        weights: Some(weights),
    }))
}

/// All steps of a processor.
fn both(processor: Processor<Component>) -> Result<Vec<Component>, ErrorKind> {
    let written = processor.weights().iter();
    let back = written.map(|component| {
        Ok(Component {
            fraction: component.fraction.negated()?,
            adjoint: component.adjoint,
        })
    });
    let mut back: Vec<Component> = back.collect::<Result<_, ErrorKind>>()?;
    Ok(match processor {
        Processor::Steps(written) => written,
        Processor::BackAndForth(written) => {
            back.extend(written);
            back
        }
    })
}

fn call(both_ways: bool, list: String) -> String {
    match both_ways {
        true => format!("{BACK_AND_FORTH}({list})"),
        false => list,
    }
}

fn check_count(
    definition: &Definition,
    key: Key,
    count: usize,
    limits: &Limits,
) -> Result<(), Error> {
    let text = definition.get(key).unwrap_or_default();
    let name = key.name();
    let checked = check_stages(&count.into(), limits);
    checked.map_err(|kind| Input { name, text }.error(&(0..text.len()), kind))?;
    Ok(())
}

/// Reads the steps of a base with exact fractions.
fn read_steps(definition: &Definition, limits: &Limits) -> Result<(Vec<Component>, String), Error> {
    let text = definition.get(Key::Processor).unwrap_or_default();
    let name = Key::Processor.name();
    let input = Input { name, text };
    let items = parse_list(input)?;
    let inside = match items.as_slice() {
        [item] => match &item.kind {
            ExpressionKind::Call {
                function,
                arguments,
                ..
            } if function == BACK_AND_FORTH => Some(arguments),
            _ => None,
        },
        _ => None,
    };
    let list = inside.unwrap_or(&items);
    let fractions = list.iter().map(|item| read_fraction(item, input));
    let fractions: Vec<(Constant, bool)> = fractions.collect::<Result<_, _>>()?;
    if let Some(sum) = off(0, fractions.iter().map(|(fraction, _)| fraction)) {
        let message = format!(
            "the fractions of the processor sum to {sum}, but must sum to 0: P does not take time; give exact numbers, one of them as minus the others"
        );
        return Err(misfit_at(definition, Key::Processor, message));
    }
    let texts: Vec<String> = fractions.iter().map(fraction_text).collect();
    let text = call(inside.is_some(), texts.join(", "));
    let component = |(fraction, adjoint)| Component {
        fraction: Factor::Constant(fraction),
        adjoint,
    };
    let written = fractions.into_iter().map(component).collect();
    let processor = match inside {
        Some(_) => Processor::BackAndForth(written),
        None => Processor::Steps(written),
    };
    let steps = both(processor).map_err(|kind| input.error(&(0..input.text.len()), kind))?;
    check_count(definition, Key::Processor, steps.len(), limits)?;
    Ok((steps, text))
}

/// Reads kicks and drifts in brackets.
fn read_flows(definition: &Definition, limits: &Limits, errors: &mut Errors) -> Option<Splitting> {
    let text = definition.get(Key::Processor).unwrap_or_default();
    let name = Key::Processor.name();
    let input = Input { name, text };
    let whole = trimmed(text, 0..text.len());
    let inside = inner(text, &whole).unwrap_or(whole.clone());
    let parts = errors.note(read_parts(input, separated(text, inside)))?;
    let known = [Key::Kick, Key::Drift, Key::First, Key::Symmetric];
    if let Some((_, range)) = parts.iter().find(|(key, _)| !known.contains(key)) {
        let message = "the processor of a splitting consists of kicks, and of drifts that sum to 0: `[kick: [1/4, -1/4], drift: [1/5, -1/5]]`";
        let message = message.to_owned();
        errors.push(input.error(range, ErrorKind::Definition { message }));
        return None;
    }
    let parts = parts.into_iter().map(|(key, range)| (key, &text[range]));
    // A processor that took time would shift the times of a run; exchanged, the kicks are those that do.
    let timed = match definition.get(Key::Exchange) {
        Some("true") => Flow::Kick,
        _ => Flow::Drift,
    };
    let mut inside = Errors(Vec::new());
    let parts = Definition::new(parts);
    let found = Splitting::read_with_sum(0, &[timed], &parts, limits, &mut inside);
    let moved = |error: Error| input.error(&whole, *error.kind);
    errors.extend(inside.0.into_iter().map(moved).collect());
    found
}
