//! The table for people: the partitioned Butcher tableau of LZ §4.4 and the properties.

use super::columns::{left, right, width, widths};
use super::facts::separable_only;
use super::written;
use crate::coefficients::Coefficients;
use crate::evidence::{Evidence, evidence_text};
use crate::partitioned::LowerTriangular;
use crate::tableau::Tableau;
use crate::tableau::left_out;

/// Longer exact forms are replaced by decimals.
const LONGEST_EXACT: usize = 28;
/// The largest total width of two tables side by side.
const WIDEST: usize = 100;
const GAP: &str = "     ";

/// Writes a tableau as a table: exact entries where they are short, and otherwise decimals of
/// `digits ≥ 1` significant digits, correctly rounded.
///
/// ```
/// use symplectic_compiler::{derive, export::text};
///
/// let table = text::write(&derive("polynomial(2)", "lobatto(2)")?.named("stormer-verlet"), 16);
/// let lines: Vec<&str> = table.lines().collect();
/// assert_eq!(lines[0], "stormer-verlet, 2 stages, basis polynomial(2), nodes lobatto(2)");
/// assert_eq!(lines[4], "0 │   0    0     1/2 │ 1/2    0");
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
pub fn write(tableau: &Tableau, digits: usize) -> String {
    let provenance = tableau.provenance();
    let stages = match tableau.stages() {
        1 => "1 stage".to_owned(),
        stages => format!("{stages} stages"),
    };
    let mut title: Vec<String> = tableau.name().map(str::to_owned).into_iter().collect();
    title.push(stages);
    let parts = provenance.definition.parts();
    title.extend(parts.map(|(key, text)| format!("{} {text}", key.name())));
    let mut text = title.join(", ") + "\n";
    if let Some(source) = &provenance.source {
        // One paper per line.
        text.push_str(&format!(
            "source: {}\n",
            source.replace("; ", ";\n        ")
        ));
    }
    text.push('\n');

    let (cells, rounded) = cells(tableau, digits);
    if let Some(lower_triangular) = left_out(tableau) {
        push_lines(&mut text, &flows(&cells, lower_triangular));
        return finished(text, tableau, rounded.then_some(digits));
    }
    let positions = table(["c", "a", "b"], &cells.c, &cells.a, &cells.b);
    if tableau.equal_halves() == (true, true) {
        push_lines(&mut text, &positions);
        text.push_str("\nã = a, b̃ = b, c̃ = c: the same for momenta.\n");
    } else {
        let momenta = table(
            ["c̃", "ã", "b̃"],
            &cells.c_tilde,
            &cells.a_tilde,
            &cells.b_tilde,
        );
        let gradient = &cells.gradient;
        let widest = |lines: &[String]| lines.iter().map(|l| width(l)).max().unwrap_or(0);
        if widest(&positions) + GAP.len() + widest(&momenta) <= WIDEST {
            let to = widest(&positions);
            let pairs = positions.iter().zip(&momenta);
            let lines: Vec<String> = pairs
                .map(|(p, m)| format!("{}{GAP}{m}", left(p, to)))
                .collect();
            push_lines(&mut text, &lines);
        } else {
            push_lines(&mut text, &positions);
            text.push('\n');
            push_lines(&mut text, &momenta);
        }
        if !gradient.is_empty() {
            let weights = gradient.join(", ");
            text.push_str(&format!(
                "\ng = {weights}: p += h (b̃_i f + 2 g_i h² f′ M⁻¹ f)\n"
            ));
        }
    }
    finished(text, tableau, rounded.then_some(digits))
}

/// The text with the notes below the coefficients, including the number of digits if entries are rounded.
fn finished(mut text: String, tableau: &Tableau, digits: Option<usize>) -> String {
    if let Some(digits) = digits {
        text.push_str(&format!(
            "\nEntries with a decimal point are correctly rounded to {digits} significant digits; all others are exact.\n"
        ));
    }
    text.push_str("\nproperties\n");
    push_lines(&mut text, &property_lines(tableau));
    text
}

/// Writes order and stability, for below the table.
///
/// ```
/// use symplectic_compiler::{derive, export::text};
///
/// let facts = text::write_facts(&derive("polynomial(2)", "lobatto(2)")?);
/// let lines: Vec<&str> = facts.lines().collect();
/// assert!(lines[1].starts_with("  general    2, proved; not 3: "));
/// assert_eq!(lines[4], "  perturbed  (2, 2), proved; not 3 in ε: A^2B has the coefficient 1/4 instead of 1/6, a difference of 1/12");
/// assert_eq!(lines[7], "  trace: 2 − ν²");
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
pub fn write_facts(tableau: &Tableau) -> String {
    let mut text = String::new();
    push_lines(&mut text, &super::facts::lines(tableau));
    text
}

fn push_lines(text: &mut String, lines: &[String]) {
    for line in lines {
        text.push_str(line.trim_end());
        text.push('\n');
    }
}

/// The text of every coefficient, and whether any of them is rounded.
fn cells(tableau: &Tableau, digits: usize) -> (Coefficients<String>, bool) {
    let short = written(tableau, tableau.exact_forms()).map(|form| {
        let exact = form.as_ref();
        exact.filter(|exact| width(exact) <= LONGEST_EXACT).cloned()
    });
    let rounded = short.iter().any(Option::is_none);
    let cells = short
        .zip(written(tableau, tableau.numbers()))
        .map(|(exact, number)| {
            exact
                .clone()
                .unwrap_or_else(|| number.decimal(digits).to_string())
        });
    (cells, rounded)
}

/// The flows of a splitting, one line per stage, in place of the matrices that the weights determine.
fn flows(cells: &Coefficients<String>, lower_triangular: LowerTriangular) -> Vec<String> {
    let (kick, drift) = (("kick b̃", &cells.b_tilde), ("drift b", &cells.b));
    let mut columns = match lower_triangular {
        LowerTriangular::KicksFirst => vec![kick, drift],
        LowerTriangular::DriftsFirst => vec![drift, kick],
    };
    if !cells.gradient.is_empty() {
        columns.push(("gradient g", &cells.gradient));
    }
    let mut rows = vec![vec!["i".to_owned()]];
    rows[0].extend(columns.iter().map(|(name, _)| (*name).to_owned()));
    rows.extend((0..cells.b.len()).map(|i| {
        let cells = columns.iter().map(|(_, cells)| cells[i].clone());
        std::iter::once((i + 1).to_string()).chain(cells).collect()
    }));
    let columns = widths(&rows);
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&columns);
        let cells: Vec<String> = cells.map(|(c, w)| right(c, *w)).collect();
        cells.join("  ")
    };
    rows.iter().map(line).collect()
}

/// The lines of a tableau: nodes beside the matrix, the weights below it.
fn table(
    labels: [&str; 3],
    nodes: &[String],
    matrix: &[Vec<String>],
    weights: &[String],
) -> Vec<String> {
    let [node, entry, weight] = labels;
    let weights = weights.to_vec();
    let columns = widths(matrix.iter().chain([&weights]));
    let side = nodes
        .iter()
        .map(|c| width(c))
        .chain([width(weight)])
        .max()
        .unwrap_or(0);
    let cells = |row: &[String]| {
        let cells: Vec<String> = row
            .iter()
            .zip(&columns)
            .map(|(c, w)| right(c, *w))
            .collect();
        cells.join("  ")
    };
    let inside = columns.iter().sum::<usize>() + 2 * columns.len().saturating_sub(1);
    let rule = format!("{}┼{}", "─".repeat(side + 1), "─".repeat(inside + 1));
    let mut lines = vec![format!("{} │ {entry}", right(node, side)), rule.clone()];
    for (c, row) in nodes.iter().zip(matrix) {
        lines.push(format!("{} │ {}", right(c, side), cells(row)));
    }
    lines.push(rule);
    lines.push(format!("{} │ {}", right(weight, side), cells(&weights)));
    lines
}

fn property_lines(tableau: &Tableau) -> Vec<String> {
    let properties = tableau.properties();
    let separable = separable_only(tableau);
    let separable = separable
        .iter()
        .map(|(_, name, property)| (*name, property));
    let rows: Vec<Vec<String>> = properties
        .all()
        .into_iter()
        .chain(separable)
        .map(|(name, property)| {
            let evidence = match property.evidence {
                Evidence::Proved => "proved".to_owned(),
                Evidence::Refuted => "refuted".to_owned(),
                known => evidence_text(known),
            };
            let holds = match (property.holds, property.evidence) {
                (_, Evidence::Undecided { .. }) => "?",
                (true, _) => "yes",
                (false, _) => "no",
            };
            let witness = property.witness.clone().unwrap_or_default();
            vec![name.to_owned(), holds.to_owned(), evidence, witness]
        })
        .collect();
    let columns = widths(&rows);
    rows.iter()
        .map(|row| {
            let cells: Vec<String> = row.iter().zip(&columns).map(|(c, w)| left(c, *w)).collect();
            format!("  {}", cells.join("  "))
        })
        .collect()
}
