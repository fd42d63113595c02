//! The data that all languages write.

use symplectic_compiler::Coefficients;
use symplectic_compiler::Tableau;
use symplectic_compiler::inside::LowerTriangular;
use symplectic_compiler::inside::evidence_text;
use symplectic_compiler::inside::left_out;
use symplectic_compiler::inside::separable_only;
use symplectic_compiler::inside::written;
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::schedule::{Class, Node, StepGraph};
use symplectic_compiler::{Library, Stepping};
use symplectic_exact::rational::ratio;

/// Longer exact forms are left out next to decimals.
const LONGEST_EXACT: usize = 60;

/// A tableau with its coefficients in all forms.
pub(crate) struct Table<'a> {
    pub tableau: &'a Tableau,
    /// The coefficients, without the matrices of long splittings.
    pub entries: Coefficients<Entry>,
    /// The sequence of drifts and kicks, if the method consists of these for separable Hamiltonians, without gradient kicks.
    pub flows: Option<Vec<Flow>>,
    /// A name that is valid in every language: `gauss_2`.
    pub name: String,
}

/// A coefficient.
#[derive(Clone)]
pub(crate) struct Entry {
    /// An exact form in the grammar of expressions.
    pub exact: Option<String>,
    pub decimal: String,
    pub double: f64,
}

/// A drift `q += h weight ∂H/∂p` or a kick `p −= h weight ∂H/∂q`.
pub(crate) struct Flow {
    pub is_drift: bool,
    pub weight: Entry,
    /// The time at which the velocity or force is evaluated, as a fraction of the step.
    pub time: f64,
    /// Whether it reuses the last evaluation of the previous step.
    pub is_carried: bool,
}

/// Alternating drifts and kicks, equal in number, with a library's names for them.
pub(crate) struct Stepped {
    pub stepping: Stepping,
    pub drifts: Vec<Entry>,
    pub kicks: Vec<Entry>,
}

impl Entry {
    fn zero() -> Self {
        Entry {
            exact: Some("0".to_owned()),
            decimal: "0".to_owned(),
            double: 0.0,
        }
    }

    /// `p/q` or `p`.
    pub fn rational(&self) -> Option<(&str, Option<&str>)> {
        let exact = self.exact.as_deref()?;
        let whole = |text: &str| {
            let digits = text.strip_prefix('-').unwrap_or(text);
            !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
        };
        match exact.split_once('/') {
            None => whole(exact).then_some((exact, None)),
            Some((p, q)) => (whole(p) && whole(q)).then_some((p, Some(q))),
        }
    }

    /// The comment beside the double: `1/4`, `1/2 - sqrt(3)/6 = 0.2113…`.
    pub fn remark(&self) -> String {
        match &self.exact {
            Some(exact) if self.rational().is_some() => exact.clone(),
            Some(exact) if exact.len() <= LONGEST_EXACT => format!("{exact} = {}", self.decimal),
            _ => self.decimal.clone(),
        }
    }
}

impl<'a> Table<'a> {
    pub fn new(tableau: &'a Tableau, digits: usize) -> Self {
        let numbers = written(tableau, tableau.numbers());
        let entries = written(tableau, tableau.exact_forms()).zip(numbers);
        let entries = entries.map(|(exact, number)| Entry {
            exact: exact.clone(),
            decimal: number.decimal(digits).to_string(),
            double: number.to_f64(),
        });
        Table {
            tableau,
            entries,
            flows: flows(tableau, digits),
            name: identifier(tableau.name().unwrap_or("method")),
        }
    }

    /// Whether it is a Runge–Kutta method with the same coefficients for positions and momenta.
    pub fn is_runge_kutta(&self) -> bool {
        self.tableau.equal_halves() == (true, true)
    }

    /// The order for a class of Hamiltonians.
    pub fn order(&self, class: HamiltonianClass) -> usize {
        self.tableau.orders().class(class).order
    }

    /// The order for every H; for drifts and kicks the order for separable H, and with gradient kicks for quadratic T.
    pub fn main_order(&self) -> usize {
        match self.flows {
            _ if self.tableau.has_gradient_kicks() => self.order(HamiltonianClass::Nystrom),
            Some(_) => self.order(HamiltonianClass::Separable),
            None => self.order(HamiltonianClass::General),
        }
    }

    /// Name, definition, sources, and proved properties; one line each.
    pub fn description(&self) -> Vec<String> {
        let provenance = self.tableau.provenance();
        let mut title: Vec<String> = self.tableau.name().map(one_line).into_iter().collect();
        title.push(match self.tableau.stages() {
            1 => "1 stage".to_owned(),
            stages => format!("{stages} stages"),
        });
        let parts = provenance.definition.parts();
        title.extend(parts.map(|(key, text)| format!("{} {}", key.name(), one_line(text))));
        let mut lines = vec![title.join(", ")];
        if let Some(source) = &provenance.source {
            lines.extend(
                source
                    .split("; ")
                    .map(|paper| format!("source: {}", one_line(paper))),
            );
        }
        let orders = self.tableau.orders();
        let classes = HamiltonianClass::ALL.into_iter();
        let order = classes.filter(|class| orders.class(*class).exists());
        let order: Vec<String> = order
            .map(|class| {
                let found = orders.class(class);
                let what = match class {
                    HamiltonianClass::General => "every H",
                    HamiltonianClass::Separable => "T(p) + U(q)",
                    HamiltonianClass::Nystrom => "T quadratic",
                };
                format!(
                    "{} for {what} ({})",
                    found.order,
                    evidence_text(found.evidence)
                )
            })
            .collect();
        lines.push(format!("order {}", order.join(", ")));
        let properties = self.tableau.properties();
        let both = [
            ("symplectic", &properties.symplectic),
            ("symmetric", &properties.symmetric),
        ];
        let held = both.iter().filter(|(_, property)| property.holds);
        let held = held.map(|(name, property)| (*name, property.evidence));
        let separable = separable_only(self.tableau);
        let separable = separable.iter();
        let separable = separable.map(|(_, name, property)| (*name, property.evidence));
        let held: Vec<String> = held
            .chain(separable)
            .map(|(name, evidence)| format!("{name} ({})", evidence_text(evidence)))
            .collect();
        if !held.is_empty() {
            lines.push(held.join(", "));
        }
        if let Some(rule) = self.left_out() {
            lines.push(rule.to_owned());
        }
        if self.tableau.has_gradient_kicks() {
            let rule =
                "gradient kicks with the force f: p += h (b_tilde_i f + 2 gradient_i h^2 f' f/M)";
            lines.push(rule.to_owned());
        }
        lines.push(format!(
            "written by symplectic {}",
            env!("CARGO_PKG_VERSION")
        ));
        lines
    }

    /// How the weights determine the matrices that are left out.
    fn left_out(&self) -> Option<&'static str> {
        Some(match left_out(self.tableau)? {
            LowerTriangular::KicksFirst => {
                "a_ij = b_j for j < i, a_tilde_ij = b_tilde_j for j <= i, else 0"
            }
            LowerTriangular::DriftsFirst => {
                "a_ij = b_j for j <= i, a_tilde_ij = b_tilde_j for j < i, else 0"
            }
        })
    }

    /// The named vectors; those for momenta only if they differ.
    pub fn vectors(&self) -> Vec<(&'static str, &[Entry])> {
        let Coefficients {
            c,
            c_tilde,
            b,
            b_tilde,
            gradient,
            ..
        } = &self.entries;
        let mut vectors: Vec<(_, &[Entry])> = vec![("c", c), ("b", b)];
        if !self.is_runge_kutta() {
            vectors.extend([("c_tilde", &c_tilde[..]), ("b_tilde", &b_tilde[..])]);
        }
        if !gradient.is_empty() {
            vectors.push(("gradient", gradient));
        }
        vectors
    }

    /// The named matrices, like [`vectors`](Self::vectors), without those that are left out.
    pub fn matrices(&self) -> Vec<(&'static str, &[Vec<Entry>])> {
        let Coefficients { a, a_tilde, .. } = &self.entries;
        if a.is_empty() {
            return Vec::new();
        }
        let mut matrices: Vec<(_, &[Vec<Entry>])> = vec![("a", a)];
        if !self.is_runge_kutta() {
            matrices.push(("a_tilde", a_tilde));
        }
        matrices
    }

    /// The drifts and kicks in the order in which a library steps them.
    pub fn stepped_by(&self, library: Library) -> Option<Stepped> {
        let stepping = library.stepping()?;
        let [drifts, kicks] = self.drifts_and_kicks(stepping.drifts_first)?;
        Some(Stepped {
            stepping,
            drifts,
            kicks,
        })
    }

    /// Whether the first of the drifts and kicks is a drift.
    pub fn begins_with_a_drift(&self) -> Option<bool> {
        self.flows.as_ref()?.first().map(|flow| flow.is_drift)
    }

    /// The weights of alternating drifts and kicks, equal in number; drifts come first if `drifts_first`. If the method has no flow at
    /// some place, a flow of size zero is inserted.
    pub fn drifts_and_kicks(&self, drifts_first: bool) -> Option<[Vec<Entry>; 2]> {
        let (mut first, mut second): (Vec<Entry>, Vec<Entry>) = (Vec::new(), Vec::new());
        for Flow {
            is_drift, weight, ..
        } in self.flows.as_ref()?
        {
            if *is_drift == drifts_first {
                if first.len() > second.len() {
                    second.push(Entry::zero());
                }
                first.push(weight.clone());
            } else {
                if first.len() == second.len() {
                    first.push(Entry::zero());
                }
                second.push(weight.clone());
            }
        }
        second.resize_with(first.len(), Entry::zero);
        Some(if drifts_first {
            [first, second]
        } else {
            [second, first]
        })
    }
}

/// The drifts and kicks of a method that consists of them.
fn flows(tableau: &Tableau, digits: usize) -> Option<Vec<Flow>> {
    if !tableau.properties().explicit.holds || tableau.has_gradient_kicks() {
        return None;
    }
    let (numbers, forms) = (tableau.numbers(), tableau.exact_forms());
    let graph = StepGraph::new(Class::Separable, tableau.exact(), &numbers);
    let chain = graph.splitting()?;
    let kind = |node: &Node| matches!(node, Node::Velocity(_));
    let time = |node: Option<&Node>, end: i64| {
        node.is_some_and(|&node| graph.evaluation(node).time.equals(&ratio(end, 1)))
    };
    let (first, last) = (chain.first(), chain.last());
    let carries =
        chain.len() > 1 && first.map(kind) == last.map(kind) && time(first, 0) && time(last, 1);
    let flow = |(number, &node): (usize, &Node)| Flow {
        is_drift: kind(&node),
        weight: weight(&graph, node, &forms, digits),
        time: graph.evaluation(node).time.to_f64(),
        is_carried: carries && number == 0,
    };
    Some(chain.iter().enumerate().map(flow).collect())
}

/// The weight of a velocity or a force.
pub(crate) fn weight(
    graph: &StepGraph<'_>,
    node: Node,
    forms: &Coefficients<Option<String>>,
    digits: usize,
) -> Entry {
    let evaluation = graph.evaluation(node);
    let forms = match node {
        Node::Velocity(_) | Node::Momentum(_) => &forms.b,
        Node::Force(_) | Node::Position(_) => &forms.b_tilde,
    };
    let exact = match graph.stages_of(evaluation)[..] {
        [stage] => forms[stage].clone(),
        // The sum of several weights.
        _ => (evaluation.weight.short_rational()).map(|sum| sum.to_string()),
    };
    Entry {
        exact,
        decimal: evaluation.weight.decimal(digits).to_string(),
        double: evaluation.weight.to_f64(),
    }
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Words that cannot be names in C, Fortran, Julia or Python; those of Python in lower case.
const KEYWORDS: &[&str] = &[
    "and",
    "as",
    "assert",
    "async",
    "auto",
    "await",
    "baremodule",
    "begin",
    "bool",
    "break",
    "case",
    "catch",
    "char",
    "class",
    "const",
    "continue",
    "def",
    "default",
    "del",
    "do",
    "double",
    "elif",
    "else",
    "elseif",
    "end",
    "enum",
    "except",
    "export",
    "extern",
    "false",
    "finally",
    "float",
    "for",
    "from",
    "function",
    "global",
    "goto",
    "if",
    "import",
    "in",
    "inline",
    "int",
    "is",
    "isa",
    "lambda",
    "let",
    "local",
    "long",
    "macro",
    "main",
    "match",
    "module",
    "none",
    "nonlocal",
    "not",
    "nothing",
    "or",
    "pass",
    "quote",
    "raise",
    "register",
    "restrict",
    "return",
    "short",
    "signed",
    "sizeof",
    "static",
    "struct",
    "switch",
    "true",
    "try",
    "type",
    "typedef",
    "union",
    "unsigned",
    "using",
    "void",
    "volatile",
    "where",
    "while",
    "with",
    "yield",
];

/// The most letters of a name, less than the 63 of Fortran because more may follow.
const MAX_LETTERS: usize = 40;

/// A name of letters, digits and single underscores that begins with a letter and is not a keyword.
fn identifier(name: &str) -> String {
    let mut found = String::new();
    for c in name.chars() {
        if c.is_ascii_alphanumeric() {
            found.push(c.to_ascii_lowercase());
        } else if !found.is_empty() && !found.ends_with('_') {
            found.push('_');
        }
    }
    found.truncate(MAX_LETTERS);
    let found = found.trim_end_matches('_');
    if found.starts_with(|c: char| c.is_ascii_alphabetic()) && !KEYWORDS.contains(&found) {
        found.to_owned()
    } else {
        format!("method_{found}").trim_end_matches('_').to_owned()
    }
}

/// Lines as comments.
pub(crate) fn comments(mark: &str, lines: &[String]) -> String {
    let line = |line: &String| format!("{}\n", format!("{mark} {line}").trim_end());
    lines.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_valid_identifiers() {
        assert_eq!(identifier("blanes-moan-s6"), "blanes_moan_s6");
        assert_eq!(identifier("Größe 2"), "gr_e_2");
        assert_eq!(identifier("2nd"), "method_2nd");
        assert_eq!(identifier("—"), "method");
        for keyword in ["lambda", "None", "end", "class"] {
            assert!(identifier(keyword).starts_with("method_"));
        }
        assert_eq!(identifier(&"long".repeat(20)).len(), MAX_LETTERS);
    }
}
