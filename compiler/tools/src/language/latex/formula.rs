//! Formulas in LaTeX, and their widths.

use num_traits::{One, Signed, Zero};

use symplectic_compiler::expression::{Expression, ExpressionKind, Input, Operator, parse_list};
use symplectic_exact::polynomial::Polynomial;

/// The width of a formula, in digits: about that of Computer Modern.
pub(super) fn width(formula: &str) -> f64 {
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

/// The contents of the braces at the start of a text; `rest` then begins after them.
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

/// An exact form; `None` if a part of it has no LaTeX notation. A root of a polynomial has a letter: its number in `roots`, which
/// grows by the roots that it does not have.
pub(super) fn exact(text: &str, roots: &mut Vec<String>) -> Option<String> {
    let input = Input {
        name: "entry",
        text,
    };
    let list = parse_list(input).ok()?;
    let [expression] = &list[..] else {
        return None;
    };
    rendered(expression, 0, roots)
}

/// The letter of a root.
fn letter(root: String, roots: &mut Vec<String>) -> String {
    let known = roots.iter().position(|known| *known == root);
    let index = known.unwrap_or_else(|| {
        roots.push(root);
        roots.len() - 1
    });
    root_letter(index)
}

/// `α`, and with an index if there are several.
pub(super) fn root_letter(index: usize) -> String {
    match index {
        0 => "\\alpha".to_owned(),
        _ => format!("\\alpha_{{{}}}", index + 1),
    }
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
fn rendered(expression: &Expression, around: u8, roots: &mut Vec<String>) -> Option<String> {
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
            if let ("root", [polynomial, index]) = (function.as_str(), &arguments[..]) {
                let (polynomial, index) =
                    (rendered(polynomial, 0, roots)?, rendered(index, 0, roots)?);
                return Some(letter(
                    format!("root {index}, in ascending order, of ${polynomial} = 0$"),
                    roots,
                ));
            }
            let [argument] = &arguments[..] else {
                return None;
            };
            let argument = rendered(argument, 0, roots)?;
            match function.as_str() {
                "cbrt" => (format!("\\sqrt[3]{{{argument}}}"), 5),
                "sqrt" => (format!("\\sqrt{{{argument}}}"), 5),
                "cos" | "sin" | "exp" => (format!("\\{function}\\left({argument}\\right)"), 5),
                _ => return None,
            }
        }
        ExpressionKind::Negate(inner) => (format!("-{}", rendered(inner, 2, roots)?), 1),
        ExpressionKind::Binary {
            operator,
            left,
            right,
        } => {
            if let (Operator::Divide, ExpressionKind::Negate(inner)) = (operator, &left.kind) {
                // The sign stands before the fraction, so the result binds like a sum.
                let (above, below) = (rendered(inner, 0, roots)?, rendered(right, 0, roots)?);
                return Some(parenthesised(
                    format!("-\\frac{{{above}}}{{{below}}}"),
                    1,
                    around,
                ));
            }
            let own = strength(*operator);
            let (left, right) = match operator {
                Operator::Divide => (rendered(left, 0, roots)?, rendered(right, 0, roots)?),
                Operator::Power => (rendered(left, 5, roots)?, rendered(right, 0, roots)?),
                Operator::Subtract => (
                    rendered(left, own, roots)?,
                    rendered(right, own + 1, roots)?,
                ),
                _ => (rendered(left, own, roots)?, rendered(right, own, roots)?),
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

/// A polynomial, lowest degree first.
pub(super) fn polynomial(f: &Polynomial, variable: &str) -> String {
    let mut text = String::new();
    let terms = f.coefficients().into_iter().enumerate();
    for (power, coefficient) in terms.filter(|(_, coefficient)| !coefficient.is_zero()) {
        let sign = match (coefficient.is_negative(), text.is_empty(), power) {
            (true, true, 0) => "-",
            (true, true, _) => "- ",
            (true, false, _) => " - ",
            (false, true, _) => "",
            (false, false, _) => " + ",
        };
        let size = coefficient.abs();
        let (p, q) = (size.numer(), size.denom());
        let number = match q.is_one() {
            true => p.to_string(),
            false => format!("\\frac{{{p}}}{{{q}}}"),
        };
        let monomial = match power {
            0 => String::new(),
            1 => variable.to_owned(),
            _ => format!("{variable}^{{{power}}}"),
        };
        let term = match (size.is_one(), power) {
            (_, 0) => number,
            (true, _) => monomial,
            (false, _) => format!("{number} {monomial}"),
        };
        text.push_str(sign);
        text.push_str(&term);
    }
    if text.is_empty() {
        "0".to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::{exact, polynomial, width};
    use symplectic_exact::polynomial::Polynomial;
    use symplectic_exact::rational::ratio;

    #[test]
    fn exact_numbers_are_written_in_latex() {
        for (text, expected) in [
            ("1/2 - sqrt(3)/6", "\\frac{1}{2} - \\frac{\\sqrt{3}}{6}"),
            ("-1/24", "-\\frac{1}{24}"),
            ("2*sqrt(15)/3", "\\frac{2 \\sqrt{15}}{3}"),
            ("1/(2 - 2^(1/3))", "\\frac{1}{2 - 2^{\\frac{1}{3}}}"),
            ("(1 - sqrt(2))^2", "\\left(1 - \\sqrt{2}\\right)^{2}"),
            ("(1/2)^2", "\\left(\\frac{1}{2}\\right)^{2}"),
            ("1 - (1 - pi)", "1 - \\left(1 - \\pi\\right)"),
        ] {
            assert_eq!(
                exact(text, &mut Vec::new()).as_deref(),
                Some(expected),
                "{text}"
            );
        }
        let mut roots = Vec::new();
        let text = "1 - root(t^3 - 2, 1)^2/3 + root(t^2 - 2, 2) + root(t^3 - 2, 1) + cbrt(2)";
        assert_eq!(
            exact(text, &mut roots).as_deref(),
            Some("1 - \\frac{\\alpha^{2}}{3} + \\alpha_{2} + \\alpha + \\sqrt[3]{2}")
        );
        assert_eq!(roots[1], "root 2, in ascending order, of $t^{2} - 2 = 0$");
        assert_eq!(exact("gamma(2, 3)", &mut roots), None);
    }

    #[test]
    fn polynomials_are_written_in_latex() {
        let shown = |f: Polynomial| polynomial(&f, "x");
        assert_eq!(
            shown(Polynomial::from_integers(&[0, -1, 2])),
            "- x + 2 x^{2}"
        );
        let f = Polynomial::from_rationals(&[ratio(-1, 9), ratio(35, 36)]);
        assert_eq!(shown(f), "-\\frac{1}{9} + \\frac{35}{36} x");
        assert_eq!(shown(Polynomial::zero()), "0");
    }

    #[test]
    fn widths_of_latex_formulas_count_what_is_printed() {
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
