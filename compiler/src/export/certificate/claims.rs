//! The proved claims about a method, and the names of those that are not proved.

use num_rational::BigRational;

use crate::evidence::Evidence;
use crate::exact::Exact;
use crate::export::facts::Fact;
use crate::order::{ClassOrder, HamiltonianClass};
use crate::pair::Staircase;
use crate::properties::images;
use crate::stability::{Stability, StabilityInterval, StableSteps};
use crate::tableau::Tableau;

use Fact::{List, Literal, Table, Text};

/// The significant digits of the ends of intervals.
const DIGITS: usize = 40;

/// The claims, and `not_covered` with the names of the missing ones.
pub(super) fn of(tableau: &Tableau, staircase: Option<Staircase>) -> Vec<(&'static str, Fact)> {
    let mut claims = Vec::new();
    let mut missing: Vec<String> = Vec::new();
    let properties = tableau.properties();
    if staircase.is_some() {
        // Symplectic by the form of its matrices.
        let palindrome = tableau.separable_properties().symmetric;
        note(
            &mut claims,
            &mut missing,
            "palindrome",
            palindrome.holds,
            palindrome.evidence,
        );
    } else {
        let found = properties.symplectic;
        note(
            &mut claims,
            &mut missing,
            "symplectic",
            found.holds,
            found.evidence,
        );
        let found = properties.symmetric;
        // A witness means that the order of the stages is not the reverse one; the checker does not look for it.
        match (found.holds && found.witness.is_some(), found.evidence) {
            (true, Evidence::Proved) => match order_of_stages(tableau) {
                Some(order) => claims.push(("symmetric", order)),
                None => missing.push("symmetric".to_owned()),
            },
            (true, _) => missing.push("symmetric".to_owned()),
            (_, evidence) => note(
                &mut claims,
                &mut missing,
                "symmetric",
                found.holds,
                evidence,
            ),
        }
    }
    let report = tableau.orders();
    let mut orders = Vec::new();
    for class in HamiltonianClass::ALL {
        match class_order(report.class(class)) {
            Some(order) => orders.push((class.name(), order)),
            None => missing.push(format!("order ({class})")),
        }
    }
    claims.push(("order", Table(orders)));
    if let Some(found) = tableau.perturbed_order() {
        let proved = found
            .powers
            .iter()
            .all(|power| is_proved(power.evidence) && power.refuted_by.is_some());
        match proved && staircase.is_some() {
            true => {
                let orders = found.orders().into_iter();
                let orders = orders.map(|order| Literal(order.to_string()));
                claims.push(("perturbed", List(orders.collect())));
            }
            false => missing.push("order (perturbed)".to_owned()),
        }
    }
    match stability(tableau, staircase) {
        Some(found) => claims.push(("stability", found)),
        None => missing.push("stability".to_owned()),
    }
    claims.push(("not_covered", List(missing.into_iter().map(Text).collect())));
    claims
}

/// The order of the stages, counted from 1, with which the method is symmetric; `None` if its matrices are functions of the nodes.
fn order_of_stages(tableau: &Tableau) -> Option<Fact> {
    let images = match &tableau.exact {
        Exact::Field(_) => images(&tableau.numbers())?,
        _ => return None,
    };
    let stages = images.into_iter().map(|i| Literal((i + 1).to_string()));
    Some(List(stages.collect()))
}

fn is_proved(evidence: Evidence) -> bool {
    matches!(
        evidence,
        Evidence::Proved | Evidence::Refuted | Evidence::Certified
    )
}

/// Notes a property that holds or does not hold as a claim, if that is proved.
fn note(
    claims: &mut Vec<(&'static str, Fact)>,
    missing: &mut Vec<String>,
    name: &'static str,
    holds: bool,
    evidence: Evidence,
) {
    match is_proved(evidence) {
        true => claims.push((name, Literal(holds.to_string()))),
        false => missing.push(name.to_owned()),
    }
}

/// The order, and a violated condition of the next order.
fn class_order(found: &ClassOrder) -> Option<Fact> {
    let violated = found.refuted_by.as_ref()?;
    is_proved(found.evidence).then(|| {
        Table(vec![
            ("order", Literal(found.order.to_string())),
            ("violated", Text(violated.tree.to_string())),
            ("residual", Text(violated.residual_decimal.to_string())),
        ])
    })
}

/// All stable steps of an area-preserving method, and the trace if it is rational. Those of a solution of order conditions, which are
/// verified here, the checker proves: it needs no zeros for a splitting.
fn stability(tableau: &Tableau, staircase: Option<Staircase>) -> Option<Fact> {
    let StableSteps::All(found) = tableau.stable_steps() else {
        return None;
    };
    let Stability {
        trace, intervals, ..
    } = &*found;
    let is_known = match found.evidence {
        Evidence::Proved => true,
        Evidence::Verified { .. } => staircase.is_some(),
        _ => false,
    };
    if !found.preserves_area || !is_known {
        return None;
    }
    let list = |texts: Vec<BigRational>| List(texts.iter().map(|x| Text(x.to_string())).collect());
    let interval = |i: &StabilityInterval| {
        List(vec![
            Text(i.low.decimal(DIGITS)),
            Text(i.high.decimal(DIGITS)),
            Literal(i.low_closed.to_string()),
            Literal(i.high_closed.to_string()),
        ])
    };
    let mut members = Vec::new();
    if let Some((numerator, denominator)) = &trace.rational {
        members.extend([
            ("numerator", list(numerator.coefficients())),
            ("denominator", list(denominator.coefficients())),
        ]);
    }
    members.push(("intervals", List(intervals.iter().map(interval).collect())));
    Some(Table(members))
}
