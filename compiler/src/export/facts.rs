//! Order and stability of a tableau as data, in the same shape for all formats.

use super::json::evidence;
use crate::evidence::evidence_text;
use crate::order::{ClassOrder, HamiltonianClass, PerturbedOrder, PowerOrder, SymplecticityOrder};
use crate::properties::Property;
use crate::stability::{EndPoint, MAX_STAGES, RungeKuttaStability, Stability, StableSteps};
use crate::tableau::Tableau;

/// A value in a file.
pub enum Fact {
    /// A text.
    Text(String),
    /// A number or a truth value in its notation, the same in all formats.
    Literal(String),
    /// An absent value: null in JSON, left out of a table and an empty text in a list of TOML.
    Absent,
    /// A list.
    List(Vec<Fact>),
    /// Named values.
    Table(Vec<(&'static str, Fact)>),
}

use Fact::{Absent, List, Literal, Table, Text};

impl Fact {
    fn optional(text: Option<impl ToString>) -> Self {
        text.map_or(Absent, |text| Text(text.to_string()))
    }

    /// The value as JSON on one line.
    pub fn json(&self) -> String {
        match self {
            Text(text) => serde_json::Value::from(text.as_str()).to_string(),
            Literal(text) => text.clone(),
            Absent => "null".to_owned(),
            List(items) => {
                let items: Vec<String> = items.iter().map(Fact::json).collect();
                format!("[{}]", items.join(", "))
            }
            Table(entries) => {
                let entry = |(key, value): &(&str, Fact)| format!("\"{key}\": {}", value.json());
                let entries: Vec<String> = entries.iter().map(entry).collect();
                format!("{{{}}}", entries.join(", "))
            }
        }
    }

    /// The value as TOML on one line.
    pub fn toml(&self) -> String {
        match self {
            Text(_) => self.json().replace('\u{7f}', "\\u007f"),
            Literal(text) => text.clone(),
            Absent => "\"\"".to_owned(),
            List(items) => {
                let items: Vec<String> = items.iter().map(Fact::toml).collect();
                format!("[{}]", items.join(", "))
            }
            Table(entries) => {
                let present = entries.iter().filter(|(_, value)| !matches!(value, Absent));
                let entries: Vec<String> = present
                    .map(|(key, value)| format!("{key} = {}", value.toml()))
                    .collect();
                format!("{{ {} }}", entries.join(", "))
            }
        }
    }
}

/// The sections of a file: `order` and `stability`, each a list of named values.
pub(super) fn sections(
    tableau: &Tableau,
    digits: usize,
) -> [(&'static str, Vec<(&'static str, Fact)>); 2] {
    let report = tableau.orders();
    let mut order: Vec<(&'static str, Fact)> = HamiltonianClass::ALL
        .map(|class| (class.name(), class_order(report.class(class))))
        .into();
    let perturbed = tableau.perturbed_order();
    order.push(("perturbed", perturbed.map_or(Absent, perturbed_order)));
    order.push(("symplecticity", symplecticity(tableau)));
    for (name, _, property) in separable_only(tableau) {
        let (found, bits) = evidence(property.evidence);
        let bits = bits.map_or(Absent, |bits| Literal(bits.to_string()));
        let entries = vec![("evidence", Text(found.to_owned())), ("bits", bits)];
        order.push((name, Table(entries)));
    }
    let stability = match tableau.stable_steps() {
        StableSteps::All(found) => stability(&found, digits),
        StableSteps::First {
            interval,
            evidence: known,
        } => {
            let (name, _) = evidence(known);
            let ends = [&interval.low, &interval.high];
            let ends = ends.map(|end| Text(end.decimal(digits)));
            vec![
                ("omitted", Text(omitted("all but the first interval"))),
                ("first", List(ends.into())),
                ("evidence", Text(name.to_owned())),
            ]
        }
        StableSteps::NotDecided { bits } => vec![
            ("evidence", Text("undecided".to_owned())),
            ("bits", Literal(bits.to_string())),
        ],
        StableSteps::NotComputed => vec![("omitted", Text(omitted("all")))],
    };
    [("order", order), ("stability", stability)]
}

/// Properties that hold for separable Hamiltonians, or with gradient kicks for those with quadratic `T`, and are not known to hold for all:
/// their names in files and for people.
pub fn separable_only(tableau: &Tableau) -> Vec<(&'static str, &'static str, Property)> {
    let properties = tableau.properties();
    if properties.symplectic.holds && properties.symmetric.holds {
        return Vec::new();
    }
    let separable = tableau.separable_properties();
    let [symplectic, symmetric] = match separable.class {
        HamiltonianClass::Nystrom => [
            ("symplectic_nystrom", "symplectic(nystrom)"),
            ("symmetric_nystrom", "symmetric(nystrom)"),
        ],
        _ => [
            ("symplectic_separable", "symplectic(separable)"),
            ("symmetric_separable", "symmetric(separable)"),
        ],
    };
    let both = [
        (symplectic, &properties.symplectic, separable.symplectic),
        (symmetric, &properties.symmetric, separable.symmetric),
    ];
    let only = both
        .into_iter()
        .filter(|(_, general, found)| !general.holds && found.holds);
    only.map(|((key, words), _, found)| (key, words, found))
        .collect()
}

/// The note about a part of stability that is left out, with the reason.
fn omitted(what: &str) -> String {
    format!("{what}: more than {MAX_STAGES} stages")
}

fn class_order(found: &ClassOrder) -> Fact {
    let (name, bits) = evidence(found.evidence);
    let violated = found.refuted_by.as_ref();
    Table(vec![
        ("order", Literal(found.order.to_string())),
        ("evidence", Text(name.to_owned())),
        (
            "bits",
            bits.map_or(Absent, |bits| Literal(bits.to_string())),
        ),
        ("refuted_by", Fact::optional(violated.map(|v| &v.tree))),
        ("value", Fact::optional(violated.map(|v| &v.value))),
        ("wanted", Fact::optional(violated.map(|v| &v.wanted))),
        ("residual", Fact::optional(violated.map(|v| &v.residual))),
        (
            "error_constant",
            Fact::optional(found.error_constant.as_ref()),
        ),
    ])
}

/// A table for each power of `ε`.
fn perturbed_order(found: PerturbedOrder) -> Fact {
    let power = |power: PowerOrder| {
        let (name, bits) = evidence(power.evidence);
        let violated = power.refuted_by.as_ref();
        Table(vec![
            ("order", Literal(power.order.to_string())),
            ("evidence", Text(name.to_owned())),
            (
                "bits",
                bits.map_or(Absent, |bits| Literal(bits.to_string())),
            ),
            ("refuted_by", Fact::optional(violated.map(|v| &v.word))),
            ("value", Fact::optional(violated.map(|v| &v.value))),
            ("wanted", Fact::optional(violated.map(|v| &v.wanted))),
            ("residual", Fact::optional(violated.map(|v| &v.residual))),
        ])
    };
    List(found.powers.into_iter().map(power).collect())
}

/// The highest order of symplecticity that is tested.
pub(super) const SYMPLECTICITY_LIMIT: usize = 8;

/// The order of symplecticity of a method that is not symplectic.
fn symplecticity(tableau: &Tableau) -> Fact {
    let Some(SymplecticityOrder {
        order,
        evidence: found,
        violated,
    }) = tableau.symplecticity_order(SYMPLECTICITY_LIMIT)
    else {
        return Absent;
    };
    let (name, bits) = evidence(found);
    Table(vec![
        ("order", Literal(order.to_string())),
        ("evidence", Text(name.to_owned())),
        (
            "bits",
            bits.map_or(Absent, |bits| Literal(bits.to_string())),
        ),
        (
            "refuted_by",
            Fact::optional(violated.as_ref().map(ToString::to_string)),
        ),
    ])
}

fn stability(found: &Stability, digits: usize) -> Vec<(&'static str, Fact)> {
    let exact = |end: &EndPoint| Fact::optional(end.exact());
    let decimal = |end: &EndPoint| Text(end.decimal(digits));
    let closed = |closed: bool| Literal(closed.to_string());
    let pairs = |each: &dyn Fn(&crate::stability::StabilityInterval) -> [Fact; 2]| {
        let intervals = found.intervals.iter();
        List(intervals.map(|i| List(each(i).into())).collect())
    };
    let (name, bits) = evidence(found.evidence);
    let dispersion = found.dispersion.as_ref();
    let mut facts = vec![
        ("trace", Text(found.trace.to_string())),
        ("determinant", Text(found.determinant.to_string())),
        ("intervals", pairs(&|i| [exact(&i.low), exact(&i.high)])),
        ("decimal", pairs(&|i| [decimal(&i.low), decimal(&i.high)])),
        (
            "closed",
            pairs(&|i| [closed(i.low_closed), closed(i.high_closed)]),
        ),
        ("p_stable", Literal(found.p_stable.to_string())),
        ("evidence", Text(name.to_owned())),
        (
            "bits",
            bits.map_or(Absent, |bits| Literal(bits.to_string())),
        ),
        (
            "dispersion_order",
            dispersion.map_or(Absent, |d| Literal(d.order.to_string())),
        ),
        (
            "dispersion",
            Fact::optional(dispersion.map(|d| &d.coefficient)),
        ),
    ];
    if let Some(RungeKuttaStability {
        function,
        at_infinity,
        a_stable,
        l_stable,
        imaginary,
    }) = &found.runge_kutta
    {
        facts.push((
            "runge_kutta",
            Table(vec![
                ("function", Text(function.to_string())),
                ("at_infinity", Fact::optional(at_infinity.as_ref())),
                ("a_stable", closed(*a_stable)),
                ("l_stable", closed(*l_stable)),
                ("imaginary", exact(imaginary)),
                ("imaginary_decimal", decimal(imaginary)),
            ]),
        ));
    }
    facts
}

/// Order and stability as lines for people.
pub(super) fn lines(tableau: &Tableau) -> Vec<String> {
    let report = tableau.orders();
    let mut lines = vec!["order".to_owned()];
    for class in HamiltonianClass::ALL {
        let found = report.class(class);
        let mut line = format!("  {:10} {found}", class.name());
        if let Some(constant) = &found.error_constant {
            line.push_str(&format!(
                "; error constant {}",
                short(&constant.to_string())
            ));
        }
        lines.push(line);
    }
    if let Some(found) = tableau.perturbed_order() {
        lines.push(format!("  {:10} {found}", "perturbed"));
    }
    if let Some(found) = tableau.symplecticity_order(SYMPLECTICITY_LIMIT) {
        let evidence = evidence_text(found.evidence);
        let violated = found.violated.as_ref();
        let not = violated.map_or(String::new(), |v| format!("; not {}: {v}", found.order + 1));
        let at_least = if violated.is_none() { "at least " } else { "" };
        lines.push(format!(
            "  of symplecticity: {at_least}{}, {evidence}{not}",
            found.order
        ));
    }
    if let Some(processed) = tableau.processed() {
        lines.push(String::new());
        lines.extend(kernel_lines(tableau, &processed.kernel));
    }
    lines.push(String::new());
    lines.extend(exact_on(tableau));
    lines.push("stability on the oscillator, ν = hω".to_owned());
    match tableau.stable_steps() {
        StableSteps::All(found) => {
            lines.extend(found.to_string().lines().map(|line| format!("  {line}")));
        }
        StableSteps::First { interval, evidence } => {
            let evidence = evidence_text(evidence);
            let omitted = omitted("all but the first interval");
            lines.push(format!("  stable for ν in {interval}, {evidence}"));
            lines.push(format!("  left out: {omitted}"));
        }
        steps @ StableSteps::NotDecided { .. } => lines.push(format!("  stable for ν: {steps}")),
        StableSteps::NotComputed => lines.push(format!("  left out: {}", omitted("all"))),
    }
    lines
}

/// What is known of the kernel of a processed method.
fn kernel_lines(tableau: &Tableau, kernel: &Tableau) -> Vec<String> {
    let evaluations = kernel.evaluations().map_or(String::new(), |found| {
        format!(", {} forces a step", found.forces)
    });
    let mut lines = vec![format!(
        "kernel K of P K P⁻¹, {} stages{evaluations}",
        kernel.stages()
    )];
    let symmetric = kernel.separable_properties().symmetric;
    let not = if symmetric.holds { "" } else { "not " };
    lines.push(format!(
        "  {not}symmetric for separable H, {}",
        evidence_text(symmetric.evidence)
    ));
    for class in HamiltonianClass::ALL {
        if let Some(found) = tableau.conjugate_order(class) {
            let order = kernel.orders().class(class).order;
            lines.push(format!(
                "  {:10} {order}, conjugate order {found}",
                class.name()
            ));
        }
    }
    lines
}

/// For which functions a step is exact by construction, if the basis is not polynomial; followed by an empty line.
fn exact_on(tableau: &Tableau) -> Vec<String> {
    let problem = tableau.known_problem();
    let Some((basis, of_momenta)) = problem.and_then(|problem| problem.exact_on()) else {
        return Vec::new();
    };
    let [stages, other] = match of_momenta {
        false => ["positions, for velocities", "momenta, for forces"],
        true => ["momenta, for forces", "positions, for velocities"],
    };
    vec![
        format!("exact on the span of {}, proved", basis.name()),
        format!("  at the stages and at the end of a step: {stages} in the span"),
        format!("  at the end of a step: {other} in the span"),
        String::new(),
    ]
}

/// The first digits of a decimal.
fn short(decimal: &str) -> String {
    const DIGITS: usize = 8;
    match decimal.split_once('e') {
        Some((mantissa, exponent)) => {
            let mantissa: String = mantissa.chars().take(DIGITS).collect();
            format!("{mantissa}…e{exponent}")
        }
        None if decimal.len() > DIGITS => {
            let mantissa: String = decimal.chars().take(DIGITS).collect();
            format!("{mantissa}…")
        }
        None => decimal.to_owned(),
    }
}
