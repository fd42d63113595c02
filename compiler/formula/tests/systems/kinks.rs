//! Functions with kinks: accepted where the whole is smooth enough, refused at their place where it is not.

use std::collections::BTreeSet;

use expect_test::expect_file;
use symplectic_formula::graph::Node;
use symplectic_formula::{Form, System};

use crate::formula::refused;

/// H with this term.
fn energy(term: &str) -> String {
    format!("P {{ a: 1 }} q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + {term}")
}

/// A system with this force.
fn force(term: &str) -> String {
    format!("P {{ a: 1 }} q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 force: {{ x = {term} }}")
}

fn is_read(text: &str) -> bool {
    System::read("test", text).is_ok()
}

/// Terms that are twice continuously differentiable, those that are once, and those that are not.
const TERMS: [(&[&str], u32); 3] = [
    (
        &[
            "|x|^3",
            "|x|^2.1",
            "|2 x - 1|^3",
            "x^2 |x|",
            "|x y| x^2 y^2",
            "x |x|^1.5",
            "|x| |y| (x y)^2",
            "|x|^3 |y|^3",
            "|x - y|^3 + |x - y|^4.5",
            "|x| |x|",
            "|x|^2 + |px|^2",
            "|-3|",
            "|a| x + abs(a) + max(a, 1) x",
            "abs(x)^3",
            "max(x, 0)^(5/2)",
            "max(0, x - y - a)^2.5",
            "max(x, y)^3 + max(y, 1)^3 - max(x, y)^3 - max(y, 1)^3",
            "min(x, 0)^3",
            "(max(x, 0)/a)^2.5 exp(-y)",
            "x^2 max(x, 0)",
            "max(x, 0)^2 max(y, 0)^3 x",
            "cos(|x|) + cosh(|x - y|) + |x| sin(|x|)",
            "|x| - sin(|x|)",
            "exp(-|x|^3) + ln(1 + |x|^3) + atan(|x|^3)",
            "|sin(x)|^3 + |sin(x)| sin(x)^2",
            "x^2 sin(|x|)",
            "x^2/(1 + |x|)",
            "1/|x| + |x|",
            "ln(|x - y|) + 1/|x - y|^3",
            "1/max(x, 0)",
            "exp(-|x|)/|x|",
            "sqrt(x^2 + a^2) + sqrt(x^4) + sqrt(x^6)",
            "(x^2 y^4)^(3/2)",
            "hypot(x, 0)^3 + norm([x])^3",
            "|[x, y]|^3 + |[x, y]| + 1/|[x, y]|",
            "max(x^2 + 1, 0) + |x^2 + y^2|",
            "sqrt(x^4 - x^6) + sqrt(x^5 + x^7)",
            "asin(|x|^3/3) + acos(exp(-y^2) + |x|^3)",
            "sqrt(sin(t)^2) x^2",
        ],
        2,
    ),
    (
        &[
            "x |x|",
            "px |px| a",
            "|px|^1.5",
            "|x|^2 |x|^(-1/2)",
            "max(x, 0)^(3/2)",
            "max(x, 0)^2",
            "x max(x, 0)",
            "min(x, 0)^2",
            "sin(x) |x|",
            "|x| (exp(x) - 1)",
            "x^2 |y| y",
            "px |[px]|",
            "px hypot(px, 0)",
            "px sqrt(px^2)",
            "x^3/|x|",
            "x tanh(|x|)",
            "y |y| cos(|x|) (1 + |px| px)",
        ],
        1,
    ),
    (
        &[
            "|x|",
            "abs(x)",
            "|x + 1| + |x - 1|",
            "y |x|",
            "x/|x|",
            "sin(x)/|x|",
            "x |x| |y|",
            "|x|^(1/2)",
            "max(x, 0)",
            "max(x, y)",
            "min(x, y)^2",
            "min(a, x)",
            "exp(-|x|)",
            "sin(|x|)",
            "|x|/(1 + |x|)",
            "sqrt(x^2)",
            "(x^2)^(1/2) + y^2",
            "sqrt(4 x^2 (1 + y^2))",
            "hypot(x, 2 x)",
            "hypot(x, sin(x))",
            "hypot(x y, x px)",
            "sqrt(x^2 - x^4)",
            "sqrt(x^4 + 2 x^2 y)",
            "sqrt(x^3 + x^2 y)",
            "sqrt((x - y)^2 (1 + a) - (x - y)^4)",
            "asin(1 - |x|^3)",
            "acos(|x|^3 - 1)",
            "|[x]|",
            "norm([x])",
            "|x|^a",
            "||x| - 1|^3",
            "x^2 + 1e-9 |x|",
        ],
        0,
    ),
];

#[test]
fn a_kink_is_accepted_where_the_formula_is_smooth_enough() {
    for (terms, order) in TERMS {
        for term in terms {
            let found = [is_read(&energy(term)), is_read(&force(term))];
            assert_eq!(found, [order >= 2, order >= 1], "{term}");
        }
    }
}

#[test]
fn kinks_in_sums_over_bodies_and_bonds_are_examined() {
    let numbered = |term: &str| {
        is_read(&format!(
            "P<N> q: [N], p: [N]; H = sum(i: p[i]^2/2) + {term}"
        ))
    };
    assert!(numbered("sum(i < j: |q[i] - q[j]|^3)"));
    assert!(numbered("sum(i in 1..N: max(q[i] - q[i-1], 0)^(5/2))"));
    assert!(!numbered("sum(i < j: |q[i] - q[j]|)"));
    assert!(!numbered("sum(i in 1..N: max(q[i] - q[i-1], 0)^2)"));
    let bonds = |term: &str| {
        is_read(&format!(
            "P q: [..], p: [..]; bonds: walls; H = sum(i: p[i]^2/2) + sum(bonds d: {term})"
        ))
    };
    assert!(bonds("max(-d, 0)^(5/2)"));
    assert!(!bonds("max(-d, 0)^(3/2)"));
}

#[test]
fn constraints_and_forces_with_kinks_are_accepted_if_smooth_enough() {
    let read = |rest: &str| is_read(&format!("P q: [x, y], p: [px, py]{rest}"));
    let h = "; H = (px^2 + py^2)/2";
    assert!(read(&format!("{h} constraints: {{ rod = |x|^3 + y - 1 }}")));
    assert!(!read(&format!(
        "{h} constraints: {{ rod = |x| x + y - 1 }}"
    )));
    let rolling = format!(", v: [vx, vy]{h}");
    assert!(read(&format!(
        "{rolling} nonholonomic: {{ edge = vx x |x| - vy }}"
    )));
    assert!(!read(&format!(
        "{rolling} nonholonomic: {{ edge = vx |x| - vy }}"
    )));
    // A conserved quantity is only evaluated.
    assert!(read(&format!("{h} invariants: {{ size = |px| }}")));
    let lagrangian = |l: &str| {
        let text = format!("P q: [x], v: [vx]; L = vx^2/2 - {l}");
        System::read_as(Form::Lagrangian, "test", &text).is_ok()
    };
    assert!(lagrangian("|x|^3") && lagrangian("|vx|^3"));
    assert!(!lagrangian("|x|") && !lagrangian("vx |vx|"));
}

#[test]
fn formulas_that_are_not_smooth_enough_are_refused_at_their_place() {
    let lagrangian = "P q: [x], v: [vx]; L = vx^2/2 - |x - 1|";
    let all = [
        refused(
            Form::Hamiltonian,
            &energy("x^4 + |x - y|^3 + y |x - y|^2 |x|"),
        ),
        refused(Form::Hamiltonian, &energy("max(x - 1, 0)^2")),
        refused(Form::Hamiltonian, &force("-a |px|")),
        refused(Form::Hamiltonian, &force("x |x| + sqrt(px^2)")),
        refused(Form::Hamiltonian, &force("sign(x) x^2")),
        refused(Form::Lagrangian, lagrangian),
    ];
    expect_file!["data/kinks_refused.txt"].assert_eq(&(all.join("\n\n") + "\n"));
}

/// The number of bases of powers that are not whole, and how many of them are replaced by 0 at a kink.
fn replaced(text: &str) -> [usize; 2] {
    let graph = System::read("test", text).expect(text).graph;
    let bases: BTreeSet<_> = graph
        .ids()
        .filter_map(|id| match graph.node(id) {
            Node::Product(factors) => Some(factors),
            _ => None,
        })
        .flatten()
        .filter(|(base, exponent)| !exponent.is_integer() && !graph.depends(*base).is_fixed())
        .map(|(base, _)| *base)
        .collect();
    let smooth = bases.iter().filter(|base| graph.is_smooth(**base)).count();
    [bases.len(), smooth]
}

/// With 0 for `|x|` and `x/|x|`, `|x| sin(|x|)` has the second derivative 0 at x = 0, and not 2.
#[test]
fn a_power_is_replaced_by_zero_only_where_the_derivatives_stay_the_same() {
    for term in [
        "|x|^3",
        "|x|^2.3",
        "x^2 |x| + |x| - sin(|x|)",
        "max(x, 0)^(5/2)",
        "|[x, y]|^3",
    ] {
        let [all, smooth] = replaced(&energy(term));
        assert!(all == smooth && all > 0, "{term}");
    }
    for term in [
        "sqrt(x^4 + (x^2 y)^2 + x^6)",
        "|x|/sqrt(x^2 + x^4)",
        "(|x|^3 + |x|)/|x|",
        "sin(|x|)/|x|",
        "|x| sin(|x|)",
        "exp(|x|) + exp(-|x|)",
        "cos(|[x, y]|)",
        "max(x, 0)^2 + min(x, 0)^2",
    ] {
        assert_eq!(replaced(&energy(term))[1], 0, "{term}");
    }
    // An even function of |x| has no kink, nor has the root of a fourth power.
    for term in [
        "cos(|x|) + cosh(2 |x - y|)",
        "hypot(x^2, x^2 y) + sqrt(x^4 + x^6) + sqrt(2 x^8 (1 + y^2))",
    ] {
        assert_eq!(replaced(&energy(term))[1], 0, "{term}");
        assert!(is_read(&energy(term)), "{term}");
    }
    let of_force = |term: &str| replaced(&force(term))[1];
    assert_eq!([of_force("x |x|"), of_force("x |x|/sqrt(1 + |x|)")], [1, 1]);
}

#[test]
fn a_conserved_quantity_is_infinite_where_a_length_in_it_is_a_divisor() {
    let with = |quantity: &str| {
        let text = energy("|x|^3") + &format!(" invariants: {{ size = {quantity} }}");
        replaced(&text)[1]
    };
    assert_eq!([with("|x|"), with("1/|x|"), with("x/|x|^3 + y")], [1, 0, 0]);
}

/// What is never negative is its absolute value: `(x² + y²)/|x² + y²|` would be 0/0 at the origin.
#[test]
fn an_expression_that_is_never_negative_has_no_kink() {
    for term in [
        "|x^2 + y^2|",
        "max(x^2 + y^2, 0)",
        "min(0, x^2 + y^2)",
        "sqrt((x^2 + y^2)^2)",
        "|exp(x)| + |x^4|",
    ] {
        assert_eq!(replaced(&energy(term)), [0, 0], "{term}");
    }
}

/// Sums that contain each other twice are as many as they are written.
#[test]
fn a_root_of_sums_in_sums_is_examined_once_for_each_sum() {
    for (first, step) in [("exp(x)", "1"), ("x^2", "y^2"), ("x^2 y", "x^2")] {
        let lets: Vec<String> = (2..=60)
            .map(|k| format!("a{k} = a{} + 2 (a{} + {step})", k - 1, k - 1))
            .collect();
        let lets = lets.join("; let ");
        let text = format!(
            "P q: [x, y], p: [px, py]; let a1 = {first}; let {lets}; H = px^2/2 + py^2/2 + sqrt(a60)"
        );
        assert_eq!(is_read(&text), first != "x^2 y", "{first}");
    }
}

/// Thousands of kinks, each in a term of its own or each in the next: the answer comes, whatever it is.
#[test]
fn many_kinks_are_examined_in_bounded_time() {
    let terms: Vec<String> = (0..400).map(|k| format!("|x - {k}|^3")).collect();
    assert!(is_read(&energy(&terms.join(" + "))));
    let nested = (0..60).fold("x".to_owned(), |inner, k| format!("|{inner} - {k}|"));
    assert!(!is_read(&energy(&nested)));
    let lets = (1..2000).map(|k| format!("let c{k} = cos(c{} + |x - {k}|^3);", k - 1));
    let lets: String = lets.collect();
    let text = format!("P q: [x], p: [px]; let c0 = x; {lets} H = px^2/2 + c1999");
    assert!(!is_read(&text));
}
