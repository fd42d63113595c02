//! LaTeX.

use super::table::{Entry, Table, comments};
use crate::expression::{Expression, ExpressionKind, Input, Operator, parse_list};

/// Longer exact forms are replaced by decimals.
const LONGEST_EXACT: usize = 28;
/// For methods with more stages, drifts and kicks in two columns replace the matrices.
const MOST_COLUMNS: usize = 8;

pub(super) fn write(table: &Table<'_>) -> String {
    let mut text = comments("%", &table.description());
    text.push_str("% needs \\usepackage{amsmath} and \\usepackage{booktabs}\n");
    let entries = &table.entries;
    text.push_str("\\[\n\\renewcommand{\\arraystretch}{1.25}\n");
    let wide = table.tableau.stages() > MOST_COLUMNS;
    if let Some(flows) = flows(table).filter(|_| wide) {
        text.push_str(&flows);
    } else if table.is_runge_kutta() {
        text.push_str(&array(["c", "a", "b"], &entries.c, &entries.a, &entries.b));
    } else {
        text.push_str(&array(["c", "a", "b"], &entries.c, &entries.a, &entries.b));
        text.push_str("\\qquad\n");
        let names = ["\\tilde c", "\\tilde a", "\\tilde b"];
        text.push_str(&array(
            names,
            &entries.c_tilde,
            &entries.a_tilde,
            &entries.b_tilde,
        ));
    }
    text.push_str("\\]\n");
    text
}

/// A Butcher tableau.
fn array(
    [node, entry, weight]: [&str; 3],
    nodes: &[Entry],
    matrix: &[Vec<Entry>],
    weights: &[Entry],
) -> String {
    let columns = "c".repeat(weights.len());
    let row = |first: &str, entries: &[Entry]| {
        let cells: Vec<String> = entries.iter().map(number).collect();
        format!("{first} & {} \\\\\n", cells.join(" & "))
    };
    let rows = nodes
        .iter()
        .zip(matrix)
        .map(|(node, entries)| row(&number(node), entries));
    let rows: String = rows.collect();
    let stages = weights.len();
    format!(
        "\\begin{{array}}{{c@{{\\quad}}{columns}}}\n\\toprule\n{node} & \\multicolumn{{{stages}}}{{c}}{{{entry}}} \\\\\n\\midrule\n{rows}\\midrule\n{}\\bottomrule\n\\end{{array}}\n",
        row(weight, weights)
    )
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
    let rows = first.1.iter().zip(&second.1).enumerate();
    let rows = rows.map(|(i, (x, y))| format!("{} & {} & {} \\\\\n", i + 1, number(x), number(y)));
    let rows: String = rows.collect();
    Some(format!(
        "\\begin{{array}}{{ccc}}\n\\toprule\ni & {} & {} \\\\\n\\midrule\n{rows}\\bottomrule\n\\end{{array}}\n",
        first.0, second.0
    ))
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
    use super::exact;

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
}
