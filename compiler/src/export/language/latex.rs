//! LaTeX.

use super::table::{Entry, Table, comments};
use crate::expression::{Expression, ExpressionKind, Input, Operator, parse_list};

/// Longer exact forms are replaced by decimals.
const LONGEST_EXACT: usize = 28;
/// For methods with more stages, drifts and kicks in two columns replace the matrices.
const MOST_COLUMNS: usize = 8;
/// The digits in a line of text: 345 pt in the class `article`, 5 pt each.
const LINE: f64 = 69.0;

pub(super) fn write(table: &Table<'_>) -> String {
    let halves = halves(table);
    let widths: Vec<f64> = halves.iter().map(Half::width).collect();
    let wide = widths.iter().any(|&width| width > LINE);
    let many = table.tableau.stages() > MOST_COLUMNS;
    let flows = flows(table).filter(|_| wide || many);
    let lists = flows.or_else(|| wide.then(|| halves.iter().map(Half::lists).collect()));
    let text = comments("%", &table.description());
    if let Some(lists) = lists {
        return format!(
            "{text}% needs \\usepackage{{booktabs}} and \\usepackage{{longtable}}\n{{\\renewcommand{{\\arraystretch}}{{1.5}}\n{lists}}}\n"
        );
    }
    let stretch = "\\[\n\\renewcommand{\\arraystretch}{1.5}\n";
    let between = if widths.iter().sum::<f64>() + 4.0 > LINE {
        format!("\\]\n{stretch}")
    } else {
        "\\qquad\n".to_owned()
    };
    let arrays: Vec<String> = halves.iter().map(Half::array).collect();
    format!(
        "{text}% needs \\usepackage{{amsmath}} and \\usepackage{{booktabs}}\n{stretch}{}\\]\n",
        arrays.join(&between)
    )
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
fn halves(table: &Table<'_>) -> Vec<Half> {
    let half = |letters, nodes: &[Entry], matrix: &[Vec<Entry>], weights: &[Entry]| {
        let numbers = |entries: &[Entry]| entries.iter().map(number).collect();
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
fn flows(table: &Table<'_>) -> Option<String> {
    let drifts_first = table.begins_with_a_drift()?;
    let [drifts, kicks] = table.drifts_and_kicks(drifts_first)?;
    let (drifts, kicks) = (("b_i", drifts), ("\\tilde b_i", kicks));
    let [first, second] = if drifts_first {
        [drifts, kicks]
    } else {
        [kicks, drifts]
    };
    let rows = first.1.iter().zip(&second.1).zip(1..);
    let rows = rows.map(|((x, y), i)| [i.to_string(), number(x), number(y)]);
    Some(list(["i", first.0, second.0], rows))
}

/// A table that goes on on the next page.
fn list(head: [&str; 3], rows: impl Iterator<Item = [String; 3]>) -> String {
    let line = |[x, y, z]: [&str; 3]| format!("${x}$ & ${y}$ & ${z}$ \\\\\n");
    let rows: String = rows.map(|[x, y, z]| line([&x, &y, &z])).collect();
    format!(
        "\\begin{{longtable}}{{ccc}}\n\\toprule\n{}\\midrule\n\\endhead\n\\bottomrule\n\\endfoot\n{rows}\\end{{longtable}}\n",
        line(head)
    )
}

/// The width of a formula, in digits: about that of Computer Modern.
fn width(formula: &str) -> f64 {
    let mut rest = formula;
    let mut sum = 0.0;
    while let Some(c) = rest.chars().next() {
        rest = &rest[c.len_utf8()..];
        sum += match c {
            '\\' => {
                let end = rest.find(|c: char| !c.is_ascii_alphabetic());
                let (name, after) = rest.split_at(end.unwrap_or(rest.len()));
                rest = after;
                if name == "frac" {
                    let above = group(&mut rest);
                    let below = group(&mut rest);
                    0.8 * width(above).max(width(below)) + 0.5
                } else {
                    1.5
                }
            }
            '+' | '-' => 1.6,
            ' ' | '.' => 0.5,
            '{' | '}' | '^' => 0.0,
            _ => 1.0,
        };
    }
    sum
}

/// What the braces at the start of a text hold; the text goes on behind them.
fn group<'a>(rest: &mut &'a str) -> &'a str {
    let mut depth = 0;
    let end = rest.char_indices().find_map(|(at, c)| {
        depth += match c {
            '{' => 1,
            '}' => -1,
            _ => 0,
        };
        (depth == 0).then_some(at)
    });
    let (held, after) = rest.split_at(end.unwrap_or(rest.len()));
    *rest = after.strip_prefix('}').unwrap_or(after);
    held.strip_prefix('{').unwrap_or(held)
}

/// The exact form if it is short, otherwise the decimal.
fn number(entry: &Entry) -> String {
    let short = entry.exact.as_deref();
    let short = short.filter(|exact| exact.len() <= LONGEST_EXACT);
    short
        .and_then(exact)
        .unwrap_or_else(|| entry.decimal.clone())
}

/// An exact form; `None` if a part of it has no LaTeX notation.
fn exact(text: &str) -> Option<String> {
    let input = Input {
        name: "entry",
        text,
    };
    let list = parse_list(input).ok()?;
    let [expression] = &list[..] else {
        return None;
    };
    rendered(expression, 0)
}

/// The precedence of an operator.
fn strength(operator: Operator) -> u8 {
    match operator {
        Operator::Add | Operator::Subtract => 1,
        Operator::Multiply => 2,
        // A fraction needs no parentheses.
        Operator::Divide => 4,
        Operator::Power => 3,
    }
}

/// An expression, in parentheses if the surrounding operator binds tighter.
fn rendered(expression: &Expression, around: u8) -> Option<String> {
    let (text, own) = match &expression.kind {
        ExpressionKind::Number(value) if value.is_integer() => (value.to_string(), 5),
        ExpressionKind::Number(value) => {
            let (p, q) = (value.numer(), value.denom());
            (format!("\\frac{{{p}}}{{{q}}}"), 4)
        }
        ExpressionKind::Name(name) if name == "pi" => ("\\pi".to_owned(), 5),
        ExpressionKind::Name(name) => (name.clone(), 5),
        ExpressionKind::Call {
            function,
            arguments,
            ..
        } => {
            let [argument] = &arguments[..] else {
                return None;
            };
            let argument = rendered(argument, 0)?;
            match function.as_str() {
                "sqrt" => (format!("\\sqrt{{{argument}}}"), 5),
                "cos" | "sin" | "exp" => (format!("\\{function}\\left({argument}\\right)"), 5),
                _ => return None,
            }
        }
        ExpressionKind::Negate(inner) => (format!("-{}", rendered(inner, 2)?), 1),
        ExpressionKind::Binary {
            operator,
            left,
            right,
        } => {
            if let (Operator::Divide, ExpressionKind::Negate(inner)) = (operator, &left.kind) {
                // The sign stands before the fraction, so the result binds like a sum.
                let (above, below) = (rendered(inner, 0)?, rendered(right, 0)?);
                return Some(parenthesised(
                    format!("-\\frac{{{above}}}{{{below}}}"),
                    1,
                    around,
                ));
            }
            let own = strength(*operator);
            let (left, right) = match operator {
                Operator::Divide => (rendered(left, 0)?, rendered(right, 0)?),
                Operator::Power => (rendered(left, 4)?, rendered(right, 0)?),
                Operator::Subtract => (rendered(left, own)?, rendered(right, own + 1)?),
                _ => (rendered(left, own)?, rendered(right, own)?),
            };
            let text = match operator {
                Operator::Add => format!("{left} + {right}"),
                Operator::Subtract => format!("{left} - {right}"),
                Operator::Multiply if right.starts_with(|c: char| c.is_ascii_digit()) => {
                    format!("{left} \\cdot {right}")
                }
                Operator::Multiply => format!("{left} {right}"),
                Operator::Divide => format!("\\frac{{{left}}}{{{right}}}"),
                Operator::Power => format!("{left}^{{{right}}}"),
            };
            (text, own)
        }
    };
    Some(parenthesised(text, own, around))
}

/// A text in parentheses, if the surrounding operator binds tighter than its own.
fn parenthesised(text: String, own: u8, around: u8) -> String {
    if own < around {
        format!("\\left({text}\\right)")
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::{exact, width};

    #[test]
    fn exact_forms() {
        for (text, expected) in [
            ("1/2 - sqrt(3)/6", "\\frac{1}{2} - \\frac{\\sqrt{3}}{6}"),
            ("-1/24", "-\\frac{1}{24}"),
            ("2*sqrt(15)/3", "\\frac{2 \\sqrt{15}}{3}"),
            ("1/(2 - 2^(1/3))", "\\frac{1}{2 - 2^{\\frac{1}{3}}}"),
            ("(1 - sqrt(2))^2", "\\left(1 - \\sqrt{2}\\right)^{2}"),
            ("1 - (1 - pi)", "1 - \\left(1 - \\pi\\right)"),
        ] {
            assert_eq!(exact(text).as_deref(), Some(expected), "{text}");
        }
        assert_eq!(exact("root(x^3 - 2, 1)"), None);
    }

    #[test]
    fn widths() {
        for (formula, expected) in [
            ("12", 2.0),
            ("-0.5", 4.1),
            ("\\frac{1}{24}", 2.1),
            ("\\frac{1}{2 - \\frac{1}{3}}", 4.42),
            ("1 - \\sqrt{2}", 6.1),
        ] {
            assert!((width(formula) - expected).abs() < 1e-12, "{formula}");
        }
    }
}
