//! Properties that a composition has because its steps have them: it steps systems with constraints by one step of each part after another.

use super::{Evidence, Properties, Property};
use crate::derive::Parts;
use crate::order::composition::{self, Step};
use crate::tableau::Tableau;

/// `constrained`, if each method of a composition is; `None` if not. It says nothing about the order with constraints.
pub(crate) fn constrained(parts: &Parts) -> Option<Property> {
    let evidence = each(parts, |properties| &properties.constrained)?;
    let witness = steps(parts, "constrained");
    Some(Property::holding(evidence, Some(witness)))
}

/// `nonholonomic`, if each method of a composition is and the composition has its order with any such steps; `None` if not.
///
/// Steps of methods that are not symmetric have order 1, and those of a method and of its adjoint are adjoint to each other.
pub(crate) fn nonholonomic(tableau: &Tableau, parts: &Parts) -> Option<Property> {
    let evidence = each(parts, |properties| &properties.nonholonomic)?;
    let order = tableau.orders().general.order;
    if order == 0 {
        return None;
    }
    // The methods without those that are adjoint to an earlier one.
    let mut methods: Vec<&Tableau> = Vec::new();
    let mut number = |method| {
        let at = |wanted: &Tableau| methods.iter().position(|m| m.has_coefficients_of(wanted));
        let (same, mirrored) = (at(method), at(&method.adjoint()));
        match (same, mirrored) {
            (Some(number), _) => (number, false),
            (None, Some(number)) => (number, true),
            (None, None) => {
                methods.push(method);
                (methods.len() - 1, false)
            }
        }
    };
    let numbers: Vec<(usize, bool)> = parts.methods.iter().map(&mut number).collect();
    let symmetric: Vec<Property> = methods.iter().map(|m| m.properties().symmetric).collect();
    let flags: Vec<bool> = symmetric.iter().map(|property| property.holds).collect();
    let list = parts.substeps.iter().map(|step| {
        let (method, adjoint) = numbers[step.method];
        Step {
            fraction: &step.fraction,
            method,
            adjoint,
        }
    });
    let list: Vec<Step<'_>> = list.collect();
    let mut evidence = symmetric
        .iter()
        .filter(|property| property.holds)
        .fold(evidence, |evidence, property| {
            evidence.and(property.evidence)
        });
    // A named composition, or certified weights, have their order with any symmetric method.
    let given = tableau.given.as_ref();
    let given = given.filter(|given| flags == [true] && given.claim.order() >= order);
    evidence = evidence.and(match given {
        Some(given) => given.evidence,
        None => composition::has_order(&list, &flags, order)?,
    });
    let witness = format!("order {order}: {}", steps(parts, "non-holonomic"));
    Some(Property::holding(evidence, Some(witness)))
}

/// The evidence that each method of a composition has a property.
fn each(parts: &Parts, property: impl Fn(&Properties) -> &Property) -> Option<Evidence> {
    // The coefficients of a single step are its own.
    if parts.substeps.len() < 2 {
        return None;
    }
    parts
        .methods
        .iter()
        .try_fold(Evidence::Proved, |evidence, method| {
            let properties = method.properties();
            let property = property(&properties);
            property.holds.then(|| evidence.and(property.evidence))
        })
}

fn steps(parts: &Parts, what: &str) -> String {
    format!("each of its {} steps is {what}", parts.substeps.len())
}
