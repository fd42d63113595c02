//! The exact forms that are too long for a cell of the table.

use super::formula::{exact, polynomial, root_letter, width};
use crate::language::table::{Entry, Table};
use symplectic_compiler::algebra::NodeAlgebra;
use symplectic_compiler::inside::Exact;
use symplectic_compiler::inside::Partitioned;
use symplectic_exact::polynomial::Polynomial;

/// Longer exact forms are not written in cells,
const LONGEST_EXACT: usize = 28;
/// unless they are not wider than this, in digits.
const NARROW: f64 = 6.0;

/// The legend below a table.
pub(super) struct Legend<'a> {
    /// The coefficients as polynomials in the nodes; then a cell with a long form has the decimal.
    nodes: Option<&'a Partitioned<NodeAlgebra>>,
    is_runge_kutta: bool,
    /// The long forms in cells, with their decimals; cell `x_k` has number `k − 1`.
    long: Vec<(String, String)>,
    /// The roots of polynomials in these forms.
    roots: Vec<String>,
    /// Whether a cell has the decimal of a polynomial in the nodes.
    decimals: bool,
}

impl<'a> Legend<'a> {
    pub fn new(table: &Table<'a>) -> Self {
        let nodes = match table.tableau.exact() {
            Exact::Nodes(pair) => Some(pair),
            _ => None,
        };
        Legend {
            nodes,
            is_runge_kutta: table.is_runge_kutta(),
            long: Vec::new(),
            roots: Vec::new(),
            decimals: false,
        }
    }

    /// A coefficient: its exact form if that is short, otherwise `x_k` or the decimal, which the legend explains. A number that
    /// is known by enclosures only has a decimal and no explanation.
    pub fn cell(&mut self, entry: &Entry) -> String {
        let form = entry.exact.as_deref();
        let short = form.filter(|exact| exact.len() <= LONGEST_EXACT);
        if let Some(text) = short.and_then(|form| exact(form, &mut self.roots)) {
            return text;
        }
        if self.nodes.is_some() {
            self.decimals = true;
            return entry.decimal.clone();
        }
        let Some(text) = form.and_then(|form| exact(form, &mut self.roots)) else {
            return entry.decimal.clone();
        };
        if width(&text) <= NARROW {
            return text;
        }
        let known = self.long.iter().position(|(known, _)| *known == text);
        let index = known.unwrap_or_else(|| {
            self.long.push((text, entry.decimal.clone()));
            self.long.len() - 1
        });
        format!("x_{{{}}}", index + 1)
    }

    /// One paragraph for each form, broken between terms.
    pub fn text(&self) -> String {
        let mut lines: Vec<String> = Vec::new();
        for ((form, decimal), k) in self.long.iter().zip(1..) {
            lines.push(format!("$x_{{{k}}} = {form}$ ${{}}\\approx {decimal}$"));
        }
        for (index, root) in self.roots.iter().enumerate() {
            lines.push(format!("${}$ is {root}", root_letter(index)));
        }
        if let Some(pair) = self.nodes.filter(|_| self.decimals) {
            lines.extend(self.nodes_in_words(pair));
        }
        if lines.is_empty() {
            return String::new();
        }
        let lines: Vec<String> = lines
            .into_iter()
            .map(|line| format!("\\noindent {line}\\par\n"))
            .collect();
        format!("{{\\raggedright\n{}}}\n", lines.concat())
    }

    /// The polynomials whose values at the nodes are the coefficients.
    fn nodes_in_words(&self, pair: &Partitioned<NodeAlgebra>) -> Vec<String> {
        let matrix = |columns: &[Polynomial]| {
            let powers = columns.iter().enumerate();
            let powers = powers.filter(|(_, f)| f.degree().is_some());
            let terms = powers.map(|(power, f)| {
                let f = polynomial(f, "x");
                match power {
                    0 => f,
                    1 => format!("({f}) y"),
                    _ => format!("({f}) y^{{{power}}}"),
                }
            });
            let terms: Vec<String> = terms.collect();
            if terms.is_empty() {
                "0".to_owned()
            } else {
                terms.join(" + ")
            }
        };
        let modulus = polynomial(pair.algebra.modulus(), "x");
        let mut lines = vec![
            format!(
                "The nodes $z_1 < z_2 < \\dots$ are the roots of ${modulus} = 0$, and $b_i = b(z_i)$, $a_{{ij}} = a(z_i, z_j)$ with"
            ),
            format!("$b(x) = {}$", polynomial(&pair.b, "x")),
            format!("$a(x, y) = {}$", matrix(pair.a.columns())),
        ];
        if !self.is_runge_kutta {
            lines.push(format!(
                "$\\tilde b(x) = {}$",
                polynomial(&pair.b_tilde, "x")
            ));
            lines.push(format!(
                "$\\tilde a(x, y) = {}$",
                matrix(pair.a_tilde.columns())
            ));
        }
        lines
    }
}
