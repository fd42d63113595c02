//! Writing TOML.

use crate::algebra::{NodeAlgebra, Tensor};
use crate::arithmetic::polynomial::Polynomial;
use crate::exact::Exact;
use crate::export::Format;
use crate::export::columns::{right, widths};
use crate::export::facts::{self, Fact};
use crate::export::json::evidence;
use crate::export::written;
use crate::partitioned::{LowerTriangular, Partitioned};
use crate::properties::Property;
use crate::tableau::Tableau;
use crate::tableau::left_out;

/// Wider rows have one entry per line.
const WIDEST: usize = 110;

/// Exact forms with a greater total length are left out: the definition from which they are derived is as exact
/// and shorter.
const LONGEST_EXPRESSIONS: usize = 50_000;

const HEAD: &str = "\
# A symplectic partitioned Runge–Kutta method. `symplectic check` derives it anew and compares every entry.
";

const EXACT: &str = "\
# The nodes are the roots of the node polynomial in ascending order; coefficients of 1, x, x^2, …
";

const ONE_INDEX: &str = "\
# b_i = b(c_i) and b̃_i = b̃(c_i): polynomials in a node, coefficients of 1, x, x^2, …
";

const TWO_INDICES: &str = "\
# a_ij = a(c_i, c_j) and ã_ij = ã(c_i, c_j): polynomials in two nodes x = c_i and y = c_j.
# A row has the coefficients of 1, x, x^2, … beside one power of y.
";

const GRADIENT: &str = "\
# Gradient kicks, for quadratic T: with the force f, p += h (b̃_i f + 2 g_i h² f′ M⁻¹ f).
";

const KICKS_FIRST: &str = "\
# Not written out, as the weights say it: a_ij = b_j for j < i and ã_ij = b̃_j for j ≤ i, zero elsewhere.
# In each stage a kick b̃_i, then a drift b_i.
";

const DRIFTS_FIRST: &str = "\
# Not written out, as the weights say it: a_ij = b_j for j ≤ i and ã_ij = b̃_j for j < i, zero elsewhere.
# In each stage a drift b_i, then a kick b̃_i.
";

/// Writes a tableau as TOML with decimals of `digits ≥ 1` significant digits.
///
/// The text is the same for the same tableau, and [`read`](super::read()) returns that tableau.
///
/// ```
/// use symplectic_compiler::{Limits, derive, export::toml};
///
/// let tableau = derive("polynomial(3)", "gauss(3)")?.named("gauss-3");
/// let text = toml::write(&tableau, 40);
/// assert_eq!(toml::read("gauss-3.toml", &text, &Limits::default())?, tableau);
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
pub fn write(tableau: &Tableau, digits: usize) -> String {
    let mut text = format!("{HEAD}format = {}\n", Format::CURRENT);
    if let Some(name) = tableau.name() {
        text.push_str(&format!("name = {}\n", string(name)));
    }
    text.push_str(&format!("stages = {}\n", tableau.stages()));

    let provenance = tableau.provenance();
    text.push_str("\n[provenance]\n");
    for (key, part) in provenance.definition.parts() {
        let value = match key {
            key if key.is_switch() => part.to_owned(),
            _ => string(part),
        };
        text.push_str(&format!("{} = {value}\n", key.name()));
    }
    text.push_str(&format!("tier = {}\n", string(tableau.tier().name())));
    if let Some(source) = &provenance.source {
        text.push_str(&format!("source = {}\n", string(source)));
    }

    match &*tableau.exact {
        Exact::Nodes(pair) => write_functions_of_nodes(&mut text, pair),
        Exact::Field(_) => write_expressions(&mut text, tableau),
        Exact::Reals(_) => {}
    }
    write_decimals(&mut text, tableau, digits);

    text.push_str("\n[properties]\n");
    let properties = tableau.properties();
    let all = properties.all();
    let width = all.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    for (name, property) in all {
        text.push_str(&format!("{name:width$} = {}\n", property_text(property)));
    }
    for (section, facts) in facts::sections(tableau, digits) {
        text.push_str(&format!("\n[{section}]\n"));
        for (key, fact) in facts
            .iter()
            .filter(|(_, fact)| !matches!(fact, Fact::Absent))
        {
            text.push_str(&format!("{key} = {}\n", fact.toml()));
        }
    }
    text
}

fn write_functions_of_nodes(text: &mut String, pair: &Partitioned<NodeAlgebra>) {
    let stages = pair.algebra.dimension();
    text.push_str("\n[exact]\n");
    text.push_str(EXACT);
    let modulus = coefficients(pair.algebra.modulus(), stages + 1);
    write_vector(text, "node_polynomial", &modulus);
    text.push_str(ONE_INDEX);
    write_vector(text, "b", &coefficients(&pair.b, stages));
    write_vector(text, "b_tilde", &coefficients(&pair.b_tilde, stages));
    text.push_str(TWO_INDICES);
    let rows = |tensor: &Tensor| -> Vec<Vec<String>> {
        (0..stages)
            .map(|k| {
                let column = tensor.columns().get(k);
                column.map_or_else(|| vec![quoted("0"); stages], |c| coefficients(c, stages))
            })
            .collect()
    };
    write_matrix(text, "a", &rows(&pair.a), power_of_y);
    write_matrix(text, "a_tilde", &rows(&pair.a_tilde), power_of_y);
}

fn write_expressions(text: &mut String, tableau: &Tableau) {
    let forms = written(tableau, tableau.exact_forms()).map(|form| {
        let form = form.as_deref().unwrap_or_default();
        quoted(form)
    });
    if forms.iter().map(String::len).sum::<usize>() > LONGEST_EXPRESSIONS {
        return;
    }
    text.push_str("\n[exact]\n");
    write_vector(text, "b", &forms.b);
    write_vector(text, "b_tilde", &forms.b_tilde);
    write_gradient(text, &forms.gradient);
    if left_out(tableau).is_none() {
        write_matrix(text, "a", &forms.a, stage);
        write_matrix(text, "a_tilde", &forms.a_tilde, stage);
    }
}

fn write_decimals(text: &mut String, tableau: &Tableau, digits: usize) {
    let numbers = written(tableau, tableau.numbers());
    let decimals = numbers.map(|number| quoted(number.decimal(digits)));
    text.push_str("\n[decimals]\n# Significant digits, correctly rounded.\n");
    text.push_str(&format!("digits = {digits}\n"));
    write_vector(text, "c", &decimals.c);
    write_vector(text, "c_tilde", &decimals.c_tilde);
    write_vector(text, "b", &decimals.b);
    write_vector(text, "b_tilde", &decimals.b_tilde);
    write_gradient(text, &decimals.gradient);
    match left_out(tableau) {
        Some(LowerTriangular::KicksFirst) => text.push_str(KICKS_FIRST),
        Some(LowerTriangular::DriftsFirst) => text.push_str(DRIFTS_FIRST),
        None => {
            write_matrix(text, "a", &decimals.a, stage);
            write_matrix(text, "a_tilde", &decimals.a_tilde, stage);
        }
    }
}

/// The weights of gradient kicks, if there are any.
fn write_gradient(text: &mut String, gradient: &[String]) {
    if !gradient.is_empty() {
        text.push_str(GRADIENT);
        write_vector(text, "gradient", gradient);
    }
}

/// The comment at a row of exact coefficients.
fn power_of_y(row: usize) -> String {
    match row {
        0 => "1".to_owned(),
        1 => "y".to_owned(),
        _ => format!("y^{row}"),
    }
}

/// The comment at a row of decimals.
fn stage(row: usize) -> String {
    format!("i = {}", row + 1)
}

/// The first `count` coefficients, of `1, x, x², …`.
fn coefficients(polynomial: &Polynomial, count: usize) -> Vec<String> {
    (0..count)
        .map(|k| quoted(polynomial.coefficient(k)))
        .collect()
}

fn quoted(value: impl std::fmt::Display) -> String {
    format!("\"{value}\"")
}

fn string(text: &str) -> String {
    // A JSON string is a TOML basic string, except for this character, which TOML requires to be escaped.
    serde_json::Value::from(text)
        .to_string()
        .replace('\u{7f}', "\\u007f")
}

fn write_vector(text: &mut String, key: &str, entries: &[String]) {
    let line = format!("{key} = [{}]\n", entries.join(", "));
    if crate::export::columns::width(&line) <= WIDEST {
        text.push_str(&line);
        return;
    }
    text.push_str(&format!("{key} = [\n"));
    let width = column(entries);
    for entry in entries {
        text.push_str(&format!("    {},\n", right(entry, width)));
    }
    text.push_str("]\n");
}

fn write_matrix(text: &mut String, key: &str, rows: &[Vec<String>], comment: fn(usize) -> String) {
    let widths = widths(rows);
    text.push_str(&format!("{key} = [\n"));
    let in_lines = widths.iter().map(|w| w + 2).sum::<usize>() <= WIDEST;
    let width = rows.iter().map(|row| column(row)).max().unwrap_or(0);
    for (index, row) in rows.iter().enumerate() {
        if in_lines {
            let cells: Vec<String> = row.iter().zip(&widths).map(|(c, w)| right(c, *w)).collect();
            text.push_str(&format!(
                "    [{}], # {}\n",
                cells.join(", "),
                comment(index)
            ));
        } else {
            text.push_str(&format!("    [ # {}\n", comment(index)));
            for entry in row {
                text.push_str(&format!("        {},\n", right(entry, width)));
            }
            text.push_str("    ],\n");
        }
    }
    text.push_str("]\n");
}

/// The width of the widest entry.
fn column(entries: &[String]) -> usize {
    entries.iter().map(String::len).max().unwrap_or(0)
}

fn property_text(property: &Property) -> String {
    let (evidence, bits) = evidence(property.evidence);
    let mut text = format!(
        "{{ holds = {}, evidence = {}",
        property.holds,
        quoted(evidence)
    );
    if let Some(bits) = bits {
        text.push_str(&format!(", bits = {bits}"));
    }
    if let Some(witness) = &property.witness {
        text.push_str(&format!(", witness = {}", string(witness)));
    }
    text.push_str(" }");
    text
}
