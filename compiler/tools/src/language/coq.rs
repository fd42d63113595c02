//! A theorem for Coq, which `tableaux/coq` proves by computation.

use std::ops::Range;

use num_rational::BigRational;

use super::polynomials::{Halves, Polynomials};
use super::table::Table;
use symplectic_compiler::Evidence;
use symplectic_compiler::Property;
use symplectic_compiler::Tableau;
use symplectic_compiler::algebra::NodeAlgebra;
use symplectic_compiler::inside::images;
use symplectic_compiler::inside::left_out;
use symplectic_compiler::inside::{LowerTriangular, Partitioned};
use symplectic_compiler::order::{HamiltonianClass, TreeRule, Trees};
use symplectic_compiler::{Error, ErrorKind};
use symplectic_exact::polynomial::Polynomial;

/// Wider lists have one item per line.
const WIDEST: usize = 100;
/// The greatest number of trees times the squares of the stages and of the field's degree; beyond it Coq would take minutes.
const MAX_WORK: usize = 6_000_000;

pub(super) fn write(table: &Table<'_>) -> Result<String, Error> {
    let no_theorem = |reason| Error::from(ErrorKind::NoTheorem { reason });
    if left_out(table.tableau).is_some() {
        return Err(no_theorem("its matrices are too large to be written"));
    }
    let polynomials = Polynomials::of(table.tableau).map_err(no_theorem)?;
    let theorem = match &polynomials {
        Polynomials::InNumber {
            modulus,
            number,
            coefficients,
        } => in_number(table, modulus, number, coefficients),
        Polynomials::InNodes(pair) => in_nodes(table, pair),
    };
    if theorem.claims.is_empty() {
        let reason = "nothing is proved of it: no order, not that it is symplectic or symmetric";
        return Err(no_theorem(reason));
    }
    Ok(theorem.text(table))
}

/// The parts of a theorem that differ between tables in a number and tables in the nodes.
struct Theorem {
    /// The required file of `tableaux/coq`.
    library: &'static str,
    remark: String,
    record: &'static str,
    /// The fields of the record with their values.
    fields: Vec<(&'static str, String)>,
    /// The hypothesis of the theorem: `forall (K : Algebra) (x : K), is_root … x ->`.
    hypothesis: String,
    /// The method of the theorem.
    method: String,
    claims: Vec<String>,
    tactic: String,
}

impl Theorem {
    fn text(&self, table: &Table<'_>) -> String {
        let name = &table.name;
        let fields = self
            .fields
            .iter()
            .map(|(field, value)| format!("  {field} := {value}"));
        let fields: Vec<String> = fields.collect();
        format!(
            "{}\nFrom Coq Require Import List QArith.\nFrom SPRK Require Import {}.\nImport ListNotations.\nOpen Scope Q_scope.\n\n\
             (** {} *)\nDefinition {name}_table : {} := {{|\n{}\n|}}.\n\n\
             Theorem {name}_is_proved : {}\n  let M := {} in\n  {}.\nProof. {}. Qed.\n\nPrint Assumptions {name}_is_proved.\n",
            comment(&table.description()),
            self.library,
            self.remark,
            self.record,
            fields.join(";\n"),
            self.hypothesis,
            self.method,
            self.claims.join(" /\\\n  "),
            self.tactic,
        )
    }
}

fn in_number(
    table: &Table<'_>,
    modulus: &Polynomial,
    number: &str,
    coefficients: &Halves<Polynomial>,
) -> Theorem {
    let degree = modulus.degree().unwrap_or(1);
    let row = |row: &Vec<Polynomial>| list(row.iter().map(|f| polynomial(f, degree)), 4);
    let [a, a_tilde] = [0, 1].map(|half| list(coefficients.a[half].iter().map(row), 4));
    let [b, b_tilde] = [0, 1].map(|half| row(&coefficients.b[half]));
    let each = (coefficients.b[0].len() * degree).pow(2);
    let mut claims = claims(table, |class, order| affordable(class, order, each));
    let (symmetry, proof) = symmetry(table, coefficients);
    claims.extend(symmetry.map(str::to_owned));
    let name = &table.name;
    let (remark, hypothesis, method, tactic) = if degree == 1 {
        (
            "The entries are rational: polynomials in x = 0.".to_owned(),
            "forall K : Algebra,".to_owned(),
            format!("method {name}_table (@zero K)"),
            format!("prove_rational_{proof}"),
        )
    } else {
        (
            format!("The entries are polynomials in x = {number}; coefficients of 1, x, ..."),
            format!("forall (K : Algebra) (x : K), is_root (reduction {name}_table) x ->"),
            format!("method {name}_table x"),
            format!("prove_{proof}"),
        )
    };
    Theorem {
        library: "Tables",
        remark,
        record: "Table",
        fields: vec![
            ("reduction", reduction(modulus)),
            ("matrix c", halves(a, a_tilde)),
            ("weights c", halves(b, b_tilde)),
        ],
        hypothesis,
        method,
        claims,
        tactic,
    }
}

/// The symmetry that is claimed, and the tactic that proves it.
fn symmetry(
    table: &Table<'_>,
    coefficients: &Halves<Polynomial>,
) -> (Option<&'static str>, String) {
    let tableau = table.tableau;
    if is_proved(&tableau.properties().symmetric)
        && let Some(images) = images(&tableau.numbers())
    {
        let images: Vec<String> = images.iter().map(ToString::to_string).collect();
        let tactic = format!("table [{}]%nat", images.join("; "));
        return (Some("is_symmetric M"), tactic);
    }
    if is_proved(&tableau.separable_properties().symmetric)
        && let Some([drifts, kicks]) = used_stages(tableau, &coefficients.b)
    {
        let range = |used: Range<usize>| format!("({}, {})%nat", used.start, used.len());
        let tactic = format!("splitting {} {}", range(drifts), range(kicks));
        return (Some("is_symmetric_for_separable M"), tactic);
    }
    (None, "table no_images".to_owned())
}

/// The drift stages and the kick stages of a palindromic splitting, without those of zero time at either end.
fn used_stages(
    tableau: &Tableau,
    [drifts, kicks]: &[Vec<Polynomial>; 2],
) -> Option<[Range<usize>; 2]> {
    let drift_first = tableau.exact().lower_triangular()? == LowerTriangular::DriftsFirst;
    // Twice the stage, and one more for its second flow.
    let place = |stage: usize, is_drift: bool| 2 * stage + usize::from(is_drift != drift_first);
    let places = |weights: &[Polynomial], is_drift: bool| -> Vec<usize> {
        let used = (0..weights.len()).filter(|&stage| !weights[stage].is_zero());
        used.map(|stage| place(stage, is_drift)).collect()
    };
    let used = [places(drifts, true), places(kicks, false)].concat();
    let (first, last) = (*used.iter().min()?, *used.iter().max()?);
    let stages = |is_drift: bool| {
        let within = |&stage: &usize| (first..=last).contains(&place(stage, is_drift));
        let stages: Vec<usize> = (0..drifts.len()).filter(within).collect();
        let start = stages.first().copied().unwrap_or(0);
        start..start + stages.len()
    };
    let used = [stages(true), stages(false)];
    let is_palindrome = [drifts, kicks].iter().zip(&used).all(|(weights, used)| {
        let weights = &weights[used.clone()];
        weights.iter().eq(weights.iter().rev())
    });
    is_palindrome.then_some(used)
}

fn in_nodes(table: &Table<'_>, pair: &Partitioned<NodeAlgebra>) -> Theorem {
    let (name, modulus) = (&table.name, pair.algebra.modulus());
    let degree = pair.algebra.dimension();
    let function = |f: &Polynomial| polynomial(f, degree);
    let [a, a_tilde] = [&pair.a, &pair.a_tilde].map(|m| list(m.columns().iter().map(function), 4));
    let [b, b_tilde] = [&pair.b, &pair.b_tilde].map(function);
    // Most trees have equal weights there.
    let mut claims = claims(table, |_, order| order);
    if is_mirrored(table, pair) {
        claims.push("(are_mirrored nodes -> is_symmetric M)".to_owned());
    }
    let text = modulus.display("x").to_string().replace('−', "-");
    Theorem {
        library: "Nodes",
        remark: format!("The nodes are the roots of {text}; the entries are polynomials in them."),
        record: "NodeTable",
        fields: vec![
            ("node_reduction", reduction(modulus)),
            ("columns c", halves(a, a_tilde)),
            ("node_weights c", halves(b, b_tilde)),
        ],
        hypothesis: format!(
            "forall (K : Algebra) (nodes : list K), are_roots (node_reduction {name}_table) nodes ->"
        ),
        method: format!("node_method {name}_table nodes"),
        claims,
        tactic: "prove_nodes".to_owned(),
    }
}

/// Whether the method equals its adjoint with the stages in reverse order: `c` becomes `1 − c`.
fn is_mirrored(table: &Table<'_>, pair: &Partitioned<NodeAlgebra>) -> bool {
    let properties = table.tableau.properties();
    let (modulus, node) = (pair.algebra.modulus(), pair.algebra.variable());
    let reflection = Polynomial::from_integers(&[1, -1]);
    is_proved(&properties.symmetric)
        && properties.consistent.holds
        && [pair.c(), pair.c_tilde()].contains(&node)
        && modulus.compose(&reflection).primitive() == *modulus
}

fn is_proved(property: &Property) -> bool {
    property.holds && property.evidence == Evidence::Proved
}

/// The orders and symplecticity, as far as they are proved. An order that a larger class also has is not repeated. An order that would
/// take Coq too long is lowered, and a comment says so.
fn claims(table: &Table<'_>, lowered: impl Fn(HamiltonianClass, usize) -> usize) -> Vec<String> {
    let orders = table.tableau.orders();
    let mut claims = Vec::new();
    let mut known = 0;
    for class in HamiltonianClass::ALL {
        let found = orders.class(class);
        let order = lowered(class, found.order);
        if found.evidence == Evidence::Proved && order > known {
            let remark = if order < found.order {
                format!(" (* of {}; higher orders take Coq too long *)", found.order)
            } else {
                String::new()
            };
            claims.push(format!("has_order M {class} {order}{remark}"));
            known = order;
        }
    }
    if is_proved(&table.tableau.properties().symplectic) {
        claims.push("is_symplectic M".to_owned());
    } else if is_proved(&table.tableau.separable_properties().symplectic) {
        claims.push("is_symplectic_for_separable M".to_owned());
    }
    claims
}

/// The highest order up to `order` whose trees Coq can check, if each tree takes this much work.
fn affordable(class: HamiltonianClass, order: usize, each: usize) -> usize {
    let mut trees = Trees::up_to(TreeRule::Class(class), 1);
    let mut number = trees.count(1);
    while trees.order() < order {
        let next = trees.order() + 1;
        number += trees.count(next);
        if number.saturating_mul(each) > MAX_WORK {
            break;
        }
        trees.grow(next);
    }
    trees.order().min(order)
}

/// Lines as a comment.
fn comment(lines: &[String]) -> String {
    // Within comments, Coq reads texts in quotation marks and nested comments.
    let plain = |line: &String| {
        line.replace("(*", "( *")
            .replace("*)", "* )")
            .replace('"', "'")
    };
    let lines: Vec<String> = lines.iter().map(plain).collect();
    format!("(* {} *)\n", lines.join("\n   "))
}

/// The values for positions and for momenta.
fn halves(position: String, momentum: String) -> String {
    if position == momentum {
        return position;
    }
    format!("match c with\n  | position => {position}\n  | momentum => {momentum}\n  end")
}

/// `r` with `x^d = r_0 + r_1 x + …`, modulo the polynomial of degree `d`.
fn reduction(modulus: &Polynomial) -> String {
    let degree = modulus.degree().unwrap_or(0);
    let coefficients =
        (0..degree).map(|k| rational(&-(modulus.coefficient(k) / modulus.leading())));
    list(coefficients, 4)
}

/// The first `count` coefficients, of `1, x, …`.
fn polynomial(f: &Polynomial, count: usize) -> String {
    list((0..count).map(|k| rational(&f.coefficient(k))), 6)
}

fn rational(value: &BigRational) -> String {
    if value.is_integer() {
        value.to_string()
    } else {
        format!("{}#{}", value.numer(), value.denom())
    }
}

/// A list, with one item per line if it is wide.
fn list(items: impl Iterator<Item = String>, indent: usize) -> String {
    let items: Vec<String> = items.collect();
    let in_line = items.join("; ");
    if in_line.len() <= WIDEST && !in_line.contains('\n') {
        return format!("[{in_line}]");
    }
    let separator = format!(";\n{}", " ".repeat(indent + 1));
    format!("[{}]", items.join(&separator))
}
