//! `symplectic list`

use std::process::ExitCode;

use clap::Args;
use rayon::prelude::*;
use symplectic_compiler::order::{HamiltonianClass, OrderReport};
use symplectic_compiler::{Error, Evidence, FAMILIES, Tableau, catalogue};
use symplectic_terminal::{aligned, print};

use crate::choice::{self, Choice};
use crate::output;

/// List the methods of the catalogue and the quadrature rules.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Show the proved facts about every method, as a Markdown table: order per class, properties, stability.
    #[arg(long)]
    facts: bool,
    #[command(flatten)]
    choice: Choice,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    if arguments.facts {
        return print(&facts()?);
    }
    if arguments.choice.is_made() {
        return print(&choice::table(&arguments.choice)?);
    }
    let mut methods = vec![["name", "stages", "title; definition"].map(str::to_owned)];
    methods.extend(catalogue::entries().map(|entry| {
        let others = entry.same_as();
        let title = if others.is_empty() {
            entry.title
        } else {
            format!("{} (also {})", entry.title, others.join(", "))
        };
        [
            entry.name,
            entry.stages.to_string(),
            // Not a separate column: the longest definition has 800 characters.
            format!("{title}; {}", entry.definition),
        ]
    }));
    let mut rules = vec![["nodes", "least s", "quadrature rule"].map(str::to_owned)];
    rules.extend(FAMILIES.map(|family| {
        [
            format!("{}(s)", family.name),
            family.minimum.to_string(),
            family.description.to_owned(),
        ]
    }));
    let mut text = String::from("Methods, for `symplectic show NAME`\n\n");
    text.push_str(&aligned(&methods));
    text.push_str(
        "\nNodes, for `symplectic derive --nodes`; also any list of distinct numbers in [0, 1]\n\n",
    );
    text.push_str(&aligned(&rules));
    print(&text)
}

/// The table of facts about every method.
fn facts() -> Result<String, Error> {
    let entries: Vec<_> = catalogue::entries().collect();
    let rows: Result<Vec<String>, Error> = entries.into_par_iter().map(row_of_facts).collect();
    let head = "| method | order: general, separable, Nyström | perturbed | | stable for hω in |\n|---|---|---|---|---|\n";
    Ok(head.to_owned() + &rows?.concat())
}

/// What is proved about a method.
fn row_of_facts(entry: catalogue::Entry) -> Result<String, Error> {
    let tableau = entry.derive()?;
    let report = tableau.orders();
    let orders = HamiltonianClass::ALL.map(|class| output::order(report.class(class)));
    let perturbed = tableau.perturbed_order();
    let properties = tableau.properties();
    let separable = tableau.separable_properties();
    let held: Vec<&str> = [
        ("symmetric", &separable.symmetric),
        ("explicit", &properties.explicit),
        ("ã = a", &properties.equal_matrices),
    ]
    .into_iter()
    .filter_map(|(word, property)| property.holds.then_some(word))
    .chain(
        (!properties.symplectic.holds).then_some(match tableau.has_gradient_kicks() {
            true => "quadratic T only",
            false => "separable H only",
        }),
    )
    .chain(less_than_proved(&report))
    .collect();
    let stable = first_interval(&tableau);
    Ok(format!(
        "| {} | {} | {} | {} | {stable} |\n",
        entry.name,
        orders.join(", "),
        perturbed.map_or_else(String::new, |found| found.numbers()),
        held.join(", "),
    ))
}

/// The evidence for the orders, unless all are proved for exact coefficients.
fn less_than_proved(report: &OrderReport) -> Option<&'static str> {
    let mut evidence = HamiltonianClass::ALL
        .map(|class| report.class(class).evidence)
        .into_iter();
    if evidence.clone().any(|found| found == Evidence::Certified) {
        return Some("certified");
    }
    let verified = evidence.any(|found| matches!(found, Evidence::Verified { .. }));
    verified.then_some("verified")
}

/// The first interval of stable steps.
fn first_interval(tableau: &Tableau) -> String {
    let steps = tableau.stable_steps().to_string();
    match steps.split_once(" ∪ ") {
        Some((first, _)) => format!("{first} ∪ …"),
        None => steps,
    }
}
