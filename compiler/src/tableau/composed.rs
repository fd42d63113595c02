//! Properties that a composition has because its steps have them: it steps systems with constraints by one step of each part after another.

use super::{Parts, Tableau};
use crate::evidence::Evidence;
use crate::exact::over_algebra;
use crate::expression::shown;
use crate::order::composition::{self, Step};
use crate::properties::{Property, has_steps};

/// `constrained` of a composition: whether each of its methods is; `None` for a single step, whose coefficients decide it. It says nothing
/// about the order with constraints.
pub(crate) fn constrained(parts: &Parts) -> Option<Property> {
    let found = each(parts, |method| method.properties().constrained)?;
    Some(match found {
        Ok(evidence) => Property::holding(evidence, Some(steps(parts, "constrained"))),
        Err(refused) => refused,
    })
}

/// `nonholonomic` of a composition: whether each of its methods has steps with non-holonomic constraints, and the composition has its order
/// with any such steps; `None` for a single step, and without an order.
///
/// These steps have order 2 for symmetric methods and order 1 for others, whatever the order of the method. So a method that loses its order
/// may be a part of a composition that does not. Steps of a method and of its adjoint are adjoint to each other.
pub(crate) fn nonholonomic(tableau: &Tableau, parts: &Parts) -> Option<Property> {
    let found = each(
        parts,
        |method| over_algebra!(&method.exact, pair => has_steps(pair)),
    )?;
    let mut evidence = match found {
        Ok(evidence) => evidence,
        Err(refused) => return Some(refused),
    };
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
    let used = symmetric.iter().filter(|property| property.holds);
    evidence = used.fold(evidence, |evidence, property| {
        evidence.and(property.evidence)
    });
    let loses = |method: &&Tableau| !method.properties().nonholonomic.holds;
    let losing = parts.methods.iter().find(loses);
    // A named composition, or certified weights, have their order with any symmetric method of the order of theirs.
    let given = tableau
        .given
        .as_ref()
        .filter(|given| flags == [true] && losing.is_none() && given.claim.order() >= order);
    let of_order = match given {
        Some(given) => Some(given.evidence),
        None => composition::has_order(&list, &flags, order),
    };
    let Some(of_order) = of_order else {
        let kept = |order: &usize| composition::has_order(&list, &flags, *order).is_some();
        let kept = (1..order).take_while(kept).last().unwrap_or(0);
        let mut witness =
            format!("with non-holonomic constraints its steps give order {kept}, not {order}");
        if let Some(part) = losing {
            let why = refused(part, &part.properties().nonholonomic);
            witness = format!("{witness}: {why}");
        }
        return Some(Property::refuted(witness));
    };
    let witness = format!("order {order}: {}", steps(parts, "non-holonomic"));
    Some(Property::holding(evidence.and(of_order), Some(witness)))
}

/// The evidence that each method of a composition has a property, or that of the first which has not.
fn each(
    parts: &Parts,
    property: impl Fn(&Tableau) -> Property,
) -> Option<Result<Evidence, Property>> {
    if parts.substeps.len() < 2 {
        return None;
    }
    let mut methods = parts.methods.iter();
    Some(methods.try_fold(Evidence::Proved, |evidence, method| {
        let property = property(method);
        match property.holds {
            true => Ok(evidence.and(property.evidence)),
            false => Err(Property {
                witness: Some(refused(method, &property)),
                ..property
            }),
        }
    }))
}

/// Why a method of a composition does not qualify.
fn refused(method: &Tableau, property: &Property) -> String {
    let witness = property.witness.as_deref().unwrap_or("no witness");
    let definition = shown(&method.provenance().definition.to_string());
    format!("its part `{definition}` is not: {witness}")
}

fn steps(parts: &Parts, what: &str) -> String {
    format!("each of its {} steps is {what}", parts.substeps.len())
}
