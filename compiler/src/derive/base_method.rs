//! Compositions of one base method: `Φ_{γ_m h} ∘ … ∘ Φ_{γ_1 h}`; some steps may be of its adjoint (GNI II.4).

use std::ops::Range;
use std::sync::Arc;

use super::certified::Factors;
use super::claim;
use super::composition::{Step, check_depth, in_text, inner, separated};
use super::concatenate::concatenate;
use super::fractions::off_one;
use super::named_compositions::{MAX_ORDER, Scheme};
use super::problem::{Construction, Problem};
use super::reading::outside;
use super::reading::{Errors, misfit, misfit_at, switch};
use super::sequence::{Factor, Sequence};
use crate::catalogue;
use crate::certify::{Claim, Coefficient, Printed, certify_composition};
use crate::definition::{Definition, Key, read_parts, trimmed};
use crate::error::{Error, ErrorKind};
use crate::evidence::Evidence;
use crate::exact::Exact;
use crate::expression::{Expression, ExpressionKind, Input, parse_list, shown};
use crate::limits::Limits;
use crate::order::{self, GivenOrder, HamiltonianClass, OrderOptions, OrderReport};
use crate::properties::{Property, SeparableProperties, symmetric};
use crate::quadrature::check_stages;
use crate::symbolic::Constant;

/// A base method, alone or with the steps of a composition.
pub struct Based {
    pub(super) base: Base,
    pub(super) weights: Option<Weights>,
}

/// A method by its name in the catalogue or by its definition.
#[derive(Clone)]
pub(super) struct Base {
    /// The name, or the definition in brackets, in canonical form.
    text: String,
    method: Problem,
}

/// A symmetric base, with how its symmetry is known for every and for separable Hamiltonians.
struct Symmetry {
    exact: Arc<Exact>,
    general: Property,
    separable: Property,
    /// The class of Hamiltonians for which the latter is known: with gradient kicks those with quadratic `T`.
    class: HamiltonianClass,
}

/// The steps of a composition.
pub(super) struct Weights {
    /// In canonical form.
    pub text: String,
    /// Whether only the first half is written.
    pub symmetric: bool,
    pub components: Vec<Component>,
    /// The certificate of printed weights, or the known order of a named composition.
    pub given: Option<GivenOrder>,
    /// Whether an order is claimed for printed weights.
    pub claimed: bool,
    /// The printed weights that differ from the rounded exact ones.
    pub wrong_digits: Vec<Error>,
}

/// A step of the base method.
#[derive(Clone)]
pub(super) struct Component {
    /// The fraction of the whole step.
    pub fraction: Factor,
    /// Whether it is a step of the adjoint.
    pub adjoint: bool,
}

impl Based {
    /// Reads `base`, `weights`, `symmetric` and `claim`.
    pub fn read(definition: &Definition, limits: &Limits, errors: &mut Errors) -> Option<Self> {
        let text = definition.get(Key::Base).unwrap_or_default();
        let base = match Base::read(text, limits) {
            Ok(base) => base,
            Err(all) => {
                errors.extend(all);
                return None;
            }
        };
        let symmetric = errors.note(switch(definition, Key::Symmetric))?;
        let weights = match definition.get(Key::Weights) {
            Some(text) => {
                let read = match definition.get(Key::Claim) {
                    None => Weights::read(text, symmetric, &base, definition, limits),
                    Some(_) => Weights::certified(text, symmetric, &base, definition, limits),
                };
                Some(errors.note(read)?)
            }
            None if symmetric => {
                let message =
                    "`symmetric` mirrors the `weights` of a composition, which are missing";
                errors.push(misfit(message.to_owned()));
                return None;
            }
            None if definition.get(Key::Claim).is_some() => {
                let message =
                    "beside a `base` a `claim` is about its printed `weights`, which are missing";
                errors.push(misfit(message.to_owned()));
                return None;
            }
            None => None,
        };
        let based = Based { base, weights };
        let text = definition.get(Key::Weights).unwrap_or(text);
        let name = if based.weights.is_some() {
            Key::Weights
        } else {
            Key::Base
        }
        .name();
        let checked = check_stages(&based.stages().into(), limits)
            .map_err(|kind| Input { name, text }.error(&(0..text.len()), kind));
        errors.note(checked)?;
        Some(based)
    }

    /// The parts in canonical form.
    pub fn parts(&self) -> Vec<(Key, String)> {
        let mut parts = vec![(Key::Base, self.base.text.clone())];
        if let Some(weights) = &self.weights {
            parts.push((Key::Weights, weights.text.clone()));
            if weights.symmetric {
                parts.push((Key::Symmetric, "true".to_owned()));
            }
            if let Some(given) = weights.given.as_ref().filter(|_| weights.claimed) {
                parts.push((Key::Claim, given.claim.notation()));
            }
        }
        parts
    }

    /// The printed weights that differ from the rounded exact ones.
    pub fn wrong_digits(&self) -> &[Error] {
        self.weights
            .as_ref()
            .map_or(&[], |weights| &weights.wrong_digits)
    }

    /// The order that follows from the weights, or for a base alone from its construction.
    pub fn given(&self) -> Option<GivenOrder> {
        match &self.weights {
            Some(weights) => weights.given.clone(),
            None => self.base.method.constructed_order(),
        }
    }

    /// The base method, if it is the method itself.
    pub fn alone(&self) -> Option<&Problem> {
        self.weights.is_none().then_some(&self.base.method)
    }

    pub fn stages(&self) -> usize {
        if let Some(method) = self.alone() {
            return method.stages();
        }
        let steps = self
            .weights
            .as_ref()
            .map_or(1, |weights| weights.components.len());
        match self.sequence() {
            Some(sequence) => sequence.stages(),
            None => self.base.method.stages().saturating_mul(steps),
        }
    }

    /// The sequence of kicks and drifts of the step, if the base method is a splitting.
    pub fn sequence(&self) -> Option<Sequence> {
        let sequence = self.base.method.sequence()?;
        let Some(weights) = &self.weights else {
            return Some(sequence);
        };
        Sequence::joined(weights.components.iter().map(|component| {
            let step = sequence.clone();
            let step = if component.adjoint {
                step.reversed()
            } else {
                step
            };
            (component.fraction.clone(), Some(step))
        }))
    }

    /// The steps, a single one without weights; `None` if weights are not constants (certified weights, whose base is a splitting).
    pub fn steps(&self) -> Option<Vec<Step>> {
        let Some(Weights { components, .. }) = &self.weights else {
            return Some(vec![Step {
                fraction: Constant::one(),
                method: self.base.method.clone(),
            }]);
        };
        let step = |component: &Component| {
            let method = &self.base.method;
            Some(Step {
                fraction: component.fraction.constant()?.clone(),
                method: match component.adjoint {
                    true => method.adjoint(),
                    false => method.clone(),
                },
            })
        };
        components.iter().map(step).collect()
    }

    /// The coefficients.
    pub fn exact(&self) -> Result<Exact, ErrorKind> {
        let Some(weights) = &self.weights else {
            return self.base.method.exact().map(Arc::unwrap_or_clone);
        };
        if let Some(sequence) = self.sequence() {
            return sequence.exact();
        }
        let method = &*self.base.method.exact()?;
        let adjoint = &method.adjoint();
        let steps = weights.components.iter().map(|component| {
            let method = if component.adjoint { adjoint } else { method };
            Some((component.fraction.constant()?, method))
        });
        let steps: Option<Vec<_>> = steps.collect();
        concatenate(&steps.ok_or_else(outside)?)
    }
}

impl Base {
    pub(super) fn read(text: &str, limits: &Limits) -> Result<Self, Vec<Error>> {
        let input = Input {
            name: Key::Base.name(),
            text,
        };
        let whole = trimmed(text, 0..text.len());
        check_depth(text).map_err(|kind| vec![input.error(&whole, kind)])?;
        if let Some(inside) = inner(text, &whole) {
            return Self::read_definition(input, whole, inside, limits);
        }
        let name = &text[whole.clone()];
        let Some(entry) = catalogue::find(name) else {
            return Err(vec![input.error(&whole, *catalogue::unknown(name).kind)]);
        };
        // The catalogue is tested; its methods may still have too many stages.
        let moved = |error: Error| input.error(&whole, *error.kind);
        let definition =
            Definition::parse(&entry.definition).map_err(|error| vec![moved(error)])?;
        let method = Problem::read(&definition, limits)
            .map_err(|all| all.into_iter().map(moved).collect::<Vec<_>>())?;
        Ok(Base {
            text: entry.name,
            method,
        })
    }

    fn read_definition(
        input: Input<'_>,
        whole: Range<usize>,
        inside: Range<usize>,
        limits: &Limits,
    ) -> Result<Self, Vec<Error>> {
        let parts =
            read_parts(input, separated(input.text, inside)).map_err(|error| vec![error])?;
        let texts = parts
            .iter()
            .map(|(key, range)| (*key, &input.text[range.clone()]));
        let method = Problem::read(&Definition::new(texts), limits).map_err(|all| {
            let moved = |error| in_text(input, &whole, &parts, error);
            all.into_iter().map(moved).collect::<Vec<_>>()
        })?;
        Ok(Base {
            text: format!("[{}]", method.definition()),
            method,
        })
    }

    /// Proves the requirement of certified weights: a symmetric base of kicks and drifts.
    pub(super) fn proved_symmetric_splitting(&self, definition: &Definition) -> Result<(), Error> {
        let refused = |message| Err(misfit_at(definition, Key::Base, message));
        if self.method.sequence().is_none() {
            return refused(format!(
                "a `claim` takes a base of kicks and drifts, such as velocity-verlet, not {}",
                self.text
            ));
        }
        let symmetry = self.symmetry("a `claim`", definition)?;
        if symmetry.class == HamiltonianClass::Nystrom {
            return refused(format!(
                "a `claim` takes a base for separable H, and {} has gradient kicks, which need quadratic T",
                self.text
            ));
        }
        match symmetry.separable.evidence {
            Evidence::Proved => Ok(()),
            _ => refused(format!(
                "a `claim` takes a base that is proved to be symmetric, and {} is only verified to be",
                self.text
            )),
        }
    }

    /// The symmetry of the base, which a composition requires.
    fn symmetry(&self, what: &str, definition: &Definition) -> Result<Symmetry, Error> {
        let at_base = |message: String| misfit_at(definition, Key::Base, message);
        let exact = self.method.exact();
        let exact = exact.map_err(|kind| at_base(kind.to_string()))?;
        let general = symmetric(&exact);
        let SeparableProperties {
            class,
            symmetric: separable,
            ..
        } = SeparableProperties::of(&exact, general.clone());
        if !separable.holds {
            let witness = separable.witness.unwrap_or_default();
            return Err(at_base(format!(
                "{what} needs a base method that is symmetric, and {} is not: {witness}; steps of the adjoint are written `adjoint(1/2)` among the weights",
                self.text
            )));
        }
        Ok(Symmetry {
            exact,
            general,
            separable,
            class,
        })
    }
}

impl Weights {
    fn read(
        text: &str,
        symmetric: bool,
        base: &Base,
        definition: &Definition,
        limits: &Limits,
    ) -> Result<Self, Error> {
        let input = Input {
            name: Key::Weights.name(),
            text,
        };
        let items = parse_list(input)?;
        if let [item] = items.as_slice()
            && let Some((scheme, order)) = Scheme::find(item)
        {
            return Self::of_scheme(scheme, order, input, symmetric, base, definition);
        }
        let count = if symmetric {
            2 * items.len() - 1
        } else {
            items.len()
        };
        let whole = 0..text.len();
        check_stages(&count.into(), limits).map_err(|kind| input.error(&whole, kind))?;
        let fractions = items.iter().map(|item| read_fraction(item, input));
        let mut fractions: Vec<(Constant, bool)> = fractions.collect::<Result<_, _>>()?;
        let texts: Vec<String> = fractions.iter().map(fraction_text).collect();
        if symmetric {
            base.symmetry("`symmetric`", definition)?;
            mirror(&mut fractions);
        }
        if let Some(sum) = off_one(fractions.iter().map(|(fraction, _)| fraction)) {
            let mirrored = if symmetric { ", mirrored," } else { "" };
            let message = format!(
                "the weights{mirrored} sum to {sum}, and a step makes fractions that sum to 1; give exact numbers, one of them as 1 minus the others"
            );
            return Err(misfit_at(definition, Key::Weights, message));
        }
        let component = |(fraction, adjoint)| Component {
            fraction: Factor::Constant(fraction),
            adjoint,
        };
        Ok(Weights {
            text: texts.join(", "),
            symmetric,
            components: fractions.into_iter().map(component).collect(),
            given: None,
            claimed: false,
            wrong_digits: Vec::new(),
        })
    }

    /// Reads printed weights and certifies their claim.
    ///
    /// The proof holds for any symmetric base of order 2; the base is proved to be one for separable
    /// Hamiltonians.
    fn certified(
        text: &str,
        symmetric: bool,
        base: &Base,
        definition: &Definition,
        limits: &Limits,
    ) -> Result<Self, Error> {
        let claim = claim::read(definition)?;
        let Claim::Separable(order) = claim else {
            let message = "printed `weights` claim an order that they give every symmetric base: `separable(8)`";
            return Err(misfit_at(definition, Key::Claim, message.to_owned()));
        };
        let mut printed = claim::read_printed(Key::Weights, text)?;
        let texts: Vec<&str> = printed.iter().map(Printed::text).collect();
        let canonical = texts.join(", ");
        let written = printed.len();
        if symmetric {
            mirror(&mut printed);
        }
        let name = Key::Weights.name();
        check_stages(&printed.len().into(), limits)
            .map_err(|kind| Input { name, text }.error(&(0..text.len()), kind))?;
        base.proved_symmetric_splitting(definition)?;
        let certificate = certify_composition(&printed, order)
            .map_err(|error| claim::refused(definition, &error))?;
        let items = (0..written).map(|i| (Key::Weights, i, Coefficient::Weight(i)));
        let wrong_digits = claim::wrong_digits(definition, &certificate, items);
        let mut factors = Factors::new(certificate);
        let component = |index| Component {
            fraction: factors.get(Coefficient::Weight(index)),
            adjoint: false,
        };
        Ok(Weights {
            text: canonical,
            symmetric,
            components: (0..printed.len()).map(component).collect(),
            given: Some(GivenOrder::certified(claim)),
            claimed: true,
            wrong_digits,
        })
    }

    fn of_scheme(
        scheme: Scheme,
        order: &Expression,
        input: Input<'_>,
        symmetric: bool,
        base: &Base,
        definition: &Definition,
    ) -> Result<Self, Error> {
        let name = scheme.name();
        if symmetric {
            let message = format!("`{name}` is symmetric by itself: leave out `symmetric`");
            return Err(misfit_at(definition, Key::Symmetric, message));
        }
        let written = order.whole(input)?;
        let symmetry = base.symmetry(&format!("`{name}`"), definition)?;
        let options = OrderOptions {
            limit: MAX_ORDER,
            ..OrderOptions::default()
        };
        // A symmetric method has an even order, and the scheme raises it by two.
        let given = base.method.given(&symmetry.exact);
        let orders_of_base = order::order(&symmetry.exact, &options, given.as_ref());
        let class = symmetry.class;
        let start = orders_of_base.class(class).order;
        let orders = (start + 2..=MAX_ORDER).step_by(2);
        let wanted = orders.clone().find(|order| written == (*order).into());
        let Some(wanted) = wanted else {
            let orders: Vec<String> = orders.map(|order| order.to_string()).collect();
            let possible = match orders.is_empty() {
                true => format!("no order above {MAX_ORDER}"),
                false => format!("the orders {}", orders.join(", ")),
            };
            let written = shown(&written.to_string());
            let message = format!(
                "`{name}` builds {possible} from the order {start} of the base, not {written}"
            );
            return Err(input.error(&order.span, ErrorKind::Definition { message }));
        };
        let fractions = scheme
            .fractions(start, wanted)
            .map_err(|kind| input.error(&(0..input.text.len()), kind))?;
        let component = |fraction| Component {
            fraction: Factor::Constant(fraction),
            adjoint: false,
        };
        Ok(Weights {
            text: format!("{name}({wanted})"),
            symmetric: false,
            components: fractions.into_iter().map(component).collect(),
            given: symmetry.raised(&orders_of_base, wanted),
            claimed: false,
            wrong_digits: Vec::new(),
        })
    }
}

impl Symmetry {
    /// The order of a named composition by the theorem of [`GivenOrder`], if the order and the symmetry of its base are
    /// proved or certified. Each level of the composition has its own root, with which its two equations are identities.
    fn raised(&self, orders: &OrderReport, wanted: usize) -> Option<GivenOrder> {
        let order = orders.class(self.class);
        let evidence = self.separable.evidence.and(order.evidence);
        let general = &orders.general;
        // The fractions cancel the leading error of a base of this order for every Hamiltonian.
        let for_all = self.general.holds
            && general.order == order.order
            && self.general.evidence.and(general.evidence) == evidence;
        matches!(evidence, Evidence::Proved | Evidence::Certified).then_some(GivenOrder {
            claim: match self.class {
                HamiltonianClass::Nystrom => Claim::Nystrom(wanted),
                _ => Claim::Separable(wanted),
            },
            general: if for_all { wanted } else { 1 },
            evidence,
            symmetric: false,
        })
    }
}

/// Extends the first half of a palindromic list to the whole list; its last item is in the middle.
/// The mirror image of a symmetric method is the method itself.
pub(super) fn mirror<T: Clone>(half: &mut Vec<T>) {
    let count = half.len();
    half.extend_from_within(..count.saturating_sub(1));
    half[count..].reverse();
}

/// Reads `1/2` or `adjoint(1/2)`: the fraction, and whether it belongs to the adjoint.
pub(super) fn read_fraction(
    item: &Expression,
    input: Input<'_>,
) -> Result<(Constant, bool), Error> {
    if let ExpressionKind::Call {
        function,
        arguments,
        ..
    } = &item.kind
    {
        if function == "adjoint" {
            let [fraction] = arguments.as_slice() else {
                let kind = ErrorKind::Arguments {
                    function: function.clone(),
                    expected: "one fraction of the step".to_owned(),
                    found: format!("{} of them", arguments.len()),
                };
                return Err(input.error(&item.span, kind));
            };
            return Ok((fraction.constant(input)?, true));
        }
        if Scheme::NAMES.contains(&function.as_str()) {
            let kind = ErrorKind::Type {
                found: format!("`{function}` among others"),
                expected: format!("`weights: {function}(4)` alone, or a list of fractions"),
            };
            return Err(input.error(&item.span, kind));
        }
    }
    let fraction = item.constant(input).map_err(|mut error| {
        if let ErrorKind::Unknown { what, known, .. } = &mut *error.kind
            && *what == "function"
        {
            *known = format!("{}, adjoint, {known}", Scheme::NAMES.join(", "));
        }
        error
    });
    Ok((fraction?, false))
}

/// A fraction as text.
pub(super) fn fraction_text((fraction, adjoint): &(Constant, bool)) -> String {
    match adjoint {
        true => format!("adjoint({fraction})"),
        false => fraction.to_string(),
    }
}

impl From<Based> for Construction {
    fn from(based: Based) -> Self {
        Construction::Based(Box::new(based))
    }
}
