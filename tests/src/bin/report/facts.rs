//! The facts that the compiler proves about a method.

use symplectic_compiler::order::{ClassOrder, HamiltonianClass};
use symplectic_compiler::{Definition, Error, Limits, Property};
use symplectic_report::Fact;
use symplectic_tests::linear_stability::evidence;

/// Largest number of stages for which stability is computed; beyond it this takes seconds.
const STABILITY_STAGES: usize = 20;

/// Derives the method from its definition again and returns its facts.
pub fn facts(definition: &str) -> Vec<Fact> {
    proved(definition).unwrap_or_else(|error| vec![Fact::new("order", error.to_string())])
}

fn proved(definition: &str) -> Result<Vec<Fact>, Error> {
    let tableau = Definition::parse(definition)?.derive(&Limits::default())?;
    let orders = tableau.orders();
    let order = |class| in_words(orders.class(class));
    let [general, separable, nystrom] = HamiltonianClass::ALL.map(order);
    let order = if general == separable && separable == nystrom {
        general
    } else {
        format!("any H: {general}; separable: {separable}; quadratic T: {nystrom}")
    };
    let properties = tableau.properties();
    let own = tableau.separable_properties();
    let for_class = |general: &Property, separable: &Property| {
        if general.holds {
            held(general)
        } else if separable.holds {
            format!("for separable H, {}", evidence(separable.evidence))
        } else {
            "no".into()
        }
    };
    let stable = if tableau.stages() > STABILITY_STAGES {
        "not computed".into()
    } else {
        let intervals = tableau.stability().intervals;
        let first = intervals
            .first()
            .map_or_else(|| "∅".into(), ToString::to_string);
        format!("{first}{}", if intervals.len() > 1 { " ∪ …" } else { "" })
    };
    Ok(vec![
        Fact::new("order", order),
        Fact::new(
            "symplectic",
            for_class(&properties.symplectic, &own.symplectic),
        ),
        Fact::new(
            "symmetric",
            for_class(&properties.symmetric, &own.symmetric),
        ),
        Fact::new("stable for hω in", stable),
    ])
}

fn in_words(found: &ClassOrder) -> String {
    format!("{}, {}", found.order, evidence(found.evidence))
}

fn held(property: &Property) -> String {
    evidence(property.evidence).into()
}
