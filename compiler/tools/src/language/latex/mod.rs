//! LaTeX.

mod formula;
mod legend;

use self::formula::width;
use self::legend::Legend;
use super::table::{Entry, Table, comments};

/// For methods with more stages, drifts and kicks in two columns replace the matrices.
const MAX_COLUMNS: usize = 8;
/// The digits in a line of text: 345 pt in the class `article`, 5 pt each.
const LINE: f64 = 69.0;

pub(super) fn write(table: &Table<'_>) -> String {
    let mut legend = Legend::new(table);
    let halves = halves(table, &mut legend);
    let widths: Vec<f64> = halves.iter().map(Half::width).collect();
    let wide = widths.iter().any(|&width| width > LINE);
    let many = table.tableau.stages() > MAX_COLUMNS;
    let mut legend_of_flows = Legend::new(table);
    let flows = flows(table, &mut legend_of_flows).filter(|_| wide || many);
    if flows.is_some() {
        legend = legend_of_flows;
    }
    let lists = flows.or_else(|| wide.then(|| halves.iter().map(Half::lists).collect()));
    let text = comments("%", &table.description());
    if let Some(lists) = lists {
        let gradient = gradient(table, &mut legend);
        return format!(
            "{text}% needs \\usepackage{{booktabs}} and \\usepackage{{longtable}}\n{{\\renewcommand{{\\arraystretch}}{{1.5}}\n{lists}}}\n{gradient}{legend}",
            legend = legend.text()
        );
    }
    let gradient = gradient(table, &mut legend);
    let stretch = "\\[\n\\renewcommand{\\arraystretch}{1.5}\n";
    let between = if widths.iter().sum::<f64>() + 4.0 > LINE {
        format!("\\]\n{stretch}")
    } else {
        "\\qquad\n".to_owned()
    };
    let arrays: Vec<String> = halves.iter().map(Half::array).collect();
    format!(
        "{text}% needs \\usepackage{{amsmath}} and \\usepackage{{booktabs}}\n{stretch}{}\\]\n{gradient}{}",
        arrays.join(&between),
        legend.text()
    )
}

/// The weights of gradient kicks, if there are any.
fn gradient(table: &Table<'_>, legend: &mut Legend<'_>) -> String {
    let weights = table.entries.gradient.iter();
    let weights: Vec<String> = weights.map(|entry| legend.cell(entry)).collect();
    match weights.is_empty() {
        true => String::new(),
        false => format!(
            "\\[\ng = ({}), \\qquad p \\mathrel{{+}}= h\\,(\\tilde b_i f + 2 g_i h^2 f' M^{{-1}} f)\n\\]\n",
            weights.join(", ")
        ),
    }
}

/// The tableau for positions or for momenta, in LaTeX.
struct Half {
    /// The letters of nodes, entries and weights.
    letters: [&'static str; 3],
    nodes: Vec<String>,
    matrix: Vec<Vec<String>>,
    weights: Vec<String>,
}

/// The tableaux for positions and momenta, or the one for both.
fn halves(table: &Table<'_>, legend: &mut Legend<'_>) -> Vec<Half> {
    let mut half = |letters, nodes: &[Entry], matrix: &[Vec<Entry>], weights: &[Entry]| {
        let mut numbers = |entries: &[Entry]| -> Vec<String> {
            entries.iter().map(|entry| legend.cell(entry)).collect()
        };
        Half {
            letters,
            nodes: numbers(nodes),
            matrix: matrix.iter().map(|row| numbers(row)).collect(),
            weights: numbers(weights),
        }
    };
    let x = &table.entries;
    let mut halves = vec![half(["c", "a", "b"], &x.c, &x.a, &x.b)];
    if !table.is_runge_kutta() {
        let letters = ["\\tilde c", "\\tilde a", "\\tilde b"];
        halves.push(half(letters, &x.c_tilde, &x.a_tilde, &x.b_tilde));
    }
    halves
}

impl Half {
    /// The width of its tableau, in digits.
    fn width(&self) -> f64 {
        let widest = |cells: &mut dyn Iterator<Item = &String>| {
            cells.map(|cell| width(cell)).fold(1.0, f64::max) + 2.0
        };
        let columns = self.weights.iter().enumerate().map(|(j, weight)| {
            let column = self.matrix.iter().map(|row| &row[j]);
            widest(&mut column.chain([weight]))
        });
        columns.sum::<f64>() + widest(&mut self.nodes.iter())
    }

    /// A Butcher tableau.
    fn array(&self) -> String {
        let [node, entry, weight] = self.letters;
        let row = |first: &str, cells: &[String]| format!("{first} & {} \\\\\n", cells.join(" & "));
        let rows = self.nodes.iter().zip(&self.matrix);
        let rows: String = rows.map(|(node, cells)| row(node, cells)).collect();
        let stages = self.weights.len();
        format!(
            "\\begin{{array}}{{c@{{\\quad}}{}}}\n\\toprule\n{node} & \\multicolumn{{{stages}}}{{c}}{{{entry}}} \\\\\n\\midrule\n{rows}\\midrule\n{}\\bottomrule\n\\end{{array}}\n",
            "c".repeat(stages),
            row(weight, &self.weights)
        )
    }

    /// Nodes and weights, and then the matrix, one entry in a line.
    fn lists(&self) -> String {
        let [node, entry, weight] = self.letters;
        let ends = self.nodes.iter().zip(&self.weights).zip(1..);
        let ends = ends.map(|((c, b), i)| [i.to_string(), c.clone(), b.clone()]);
        let rows = self.matrix.iter().zip(1..);
        let entries = rows.flat_map(|(row, i)| {
            let cells = row.iter().zip(1..);
            cells.map(move |(a, j)| [i.to_string(), j.to_string(), a.clone()])
        });
        list(["i", &format!("{node}_i"), &format!("{weight}_i")], ends)
            + &list(["i", "j", &format!("{entry}_{{ij}}")], entries)
    }
}

/// The drifts and kicks of a method that consists of them, two per line.
fn flows(table: &Table<'_>, legend: &mut Legend<'_>) -> Option<String> {
    let drifts_first = table.begins_with_a_drift()?;
    let [drifts, kicks] = table.drifts_and_kicks(drifts_first)?;
    let (drifts, kicks) = (("b_i", drifts), ("\\tilde b_i", kicks));
    let [first, second] = if drifts_first {
        [drifts, kicks]
    } else {
        [kicks, drifts]
    };
    let rows = first.1.iter().zip(&second.1).zip(1..);
    let rows = rows.map(|((x, y), i)| [i.to_string(), legend.cell(x), legend.cell(y)]);
    Some(list(["i", first.0, second.0], rows))
}

/// A table that continues on the next page.
fn list(head: [&str; 3], rows: impl Iterator<Item = [String; 3]>) -> String {
    let line = |[x, y, z]: [&str; 3]| format!("${x}$ & ${y}$ & ${z}$ \\\\\n");
    let rows: String = rows.map(|[x, y, z]| line([&x, &y, &z])).collect();
    format!(
        "\\begin{{longtable}}{{ccc}}\n\\toprule\n{}\\midrule\n\\endhead\n\\bottomrule\n\\endfoot\n{rows}\\end{{longtable}}\n",
        line(head)
    )
}
