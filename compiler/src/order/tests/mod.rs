//! Orders of known methods.

pub(super) mod methods;

use std::sync::Arc;

use num_traits::{Signed, ToPrimitive};
use proptest::prelude::*;

use super::*;
use crate::catalogue;
use crate::exact::Exact;
use crate::tableau::Tableau;
use methods::{
    RationalPair, decimal, drift_first, explicit_runge_kutta, rational, runge_kutta, splitting,
    weight,
};

fn order<A: StageAlgebra>(pair: &Partitioned<A>, options: &OrderOptions) -> OrderReport {
    order_of_pair(pair, options, None)
}

const QUICK: OrderOptions = OrderOptions {
    limit: 7,
    all_conditions: false,
};

fn orders(report: &OrderReport) -> [usize; 3] {
    HamiltonianClass::ALL.map(|class| {
        let found = report.class(class);
        assert_eq!(found.evidence, Evidence::Proved);
        let violated = found.refuted_by.as_ref().expect("sharp");
        assert_eq!(violated.tree.order(), found.order + 1);
        assert!(class.contains(&violated.tree));
        found.order
    })
}

fn derived(basis: &str, nodes: &str) -> Tableau {
    crate::derive(basis, nodes).expect("derived")
}

#[test]
fn classical_methods_have_their_orders() {
    for (basis, nodes, expected) in [
        ("polynomial(1)", "0", [1, 1, 1]),
        ("polynomial(1)", "1/2", [2, 2, 2]),
        ("polynomial(2)", "lobatto(2)", [2, 2, 2]),
        ("polynomial(2)", "gauss(2)", [4, 4, 4]),
        ("polynomial(3)", "lobatto(3)", [4, 4, 4]),
        ("polynomial(3)", "gauss(3)", [6, 6, 6]),
        ("polynomial(2)", "radau-right(2)", [3, 3, 3]),
        ("polynomial(3)", "radau-left(3)", [5, 5, 5]),
        ("polynomial(3)", "chebyshev(3)", [4, 4, 4]),
    ] {
        let report = derived(basis, nodes).order(&QUICK);
        assert_eq!(orders(&report), expected, "{basis} {nodes}");
    }
    for (name, known) in [("euler", 1), ("midpoint", 2), ("kutta3", 3), ("rk4", 4)] {
        let report = order(&explicit_runge_kutta(name), &QUICK);
        assert_eq!(orders(&report), [known; 3], "{name}");
    }
}

#[test]
fn the_violated_condition_is_named() {
    let report = derived("polynomial(3)", "lobatto(3)").order(&QUICK);
    assert_eq!(
        report.general.to_string(),
        "4, proved; not 5: q[q^4] has the weight 5/24 instead of 1/5, a difference of 1/120"
    );
    let report = order(
        &explicit_runge_kutta("rk4"),
        &OrderOptions { limit: 4, ..QUICK },
    );
    // Beyond the limit, the quadrature refutes the order.
    let violated = report.nystrom.refuted_by.expect("refuted");
    assert_eq!(
        violated.to_string(),
        "p[q^4] has the weight 5/24 instead of 1/5, a difference of 1/120"
    );
    assert_eq!(report.nystrom.error_constant, None);
}

#[test]
fn exchanged_and_misprinted_coefficients_are_refuted() {
    let numbers =
        |list: &[&str]| -> Vec<BigRational> { list.iter().map(|x| rational(x)).collect() };
    // Ruth 1983.
    let drift = numbers(&["2/3", "-2/3", "1"]);
    let kick = numbers(&["7/24", "3/4", "-1/24"]);
    let ruth = order(&splitting(&drift, &kick), &QUICK);
    assert_eq!((ruth.separable.order, ruth.nystrom.order), (3, 3));
    let exchanged = order(&splitting(&kick, &drift), &QUICK).separable;
    assert_eq!(exchanged.order, 1);
    let violated = exchanged.refuted_by.expect("refuted");
    assert_eq!(violated.tree.order(), 2);

    let drift = numbers(&["0", "1/3", "-1/3", "1", "-1/3", "1/3"]);
    let kick = numbers(&["7/48", "3/8", "-1/48", "-1/48", "3/8", "7/48"]);
    let right = order(&drift_first(&drift, &kick), &QUICK);
    assert_eq!((right.separable.order, right.nystrom.order), (4, 4));
    let exchanged = order(&drift_first(&kick, &drift), &QUICK).separable;
    assert_eq!(exchanged.order, 1);
    let violated = exchanged.refuted_by.expect("refuted");
    assert_eq!(
        (
            violated.tree.order(),
            violated.residual.trim_start_matches('-')
        ),
        (2, "5/144")
    );

    // Gauss 2 with √3 to ten digits is symplectic, but only of order 2.
    let root = decimal("1.732050808");
    let gauss = |root: &BigRational| -> RationalPair {
        let off = root / rational("6");
        let a = [rational("1/4") - &off, rational("1/4") + &off].map(|x| x.to_string());
        runge_kutta(
            &[&format!("1/4 {}", a[0]), &format!("{} 1/4", a[1])],
            "1/2 1/2",
        )
    };
    let report = order(&gauss(&root), &QUICK);
    assert_eq!(orders(&report), [2, 2, 2]);
    let violated = report.nystrom.refuted_by.expect("refuted");
    let residual = (&root * &root - rational("3")) / rational("36");
    assert_eq!(
        (violated.tree.to_string().as_str(), violated.residual),
        ("p[q,q]", residual.to_string())
    );
}

/// The order up to which the conditions hold to a tolerance, for coefficients printed as
/// decimals, which satisfy them only to that accuracy. The residuals of the next order must be far
/// larger.
fn approximate_order(pair: &RationalPair, class: HamiltonianClass) -> usize {
    let mut weights = Weights::new(pair, TreeRule::Class(class));
    for order in 1.. {
        // The printed splittings are exactly symplectic.
        let conditions = weights.conditions(order, true);
        let residual = |condition| {
            let Number::Rational(value) = weights.value(condition) else {
                unreachable!("rational")
            };
            (value - weights.wanted(condition))
                .abs()
                .to_f64()
                .expect("a double")
        };
        let largest = conditions.into_iter().map(residual).fold(0.0, f64::max);
        if largest > 1e-9 {
            assert!(
                largest > 1e-7,
                "{largest} at order {order} is neither small nor large"
            );
            return order - 1;
        }
        assert!(
            largest < 1e-11,
            "{largest} at order {order} is neither small nor large"
        );
    }
    0
}

#[test]
#[ignore = "thorough"]
fn explicit_methods_have_the_orders_of_their_papers() {
    let text = include_str!("../../../tests/data/explicit-methods.json");
    let data: serde_json::Value = serde_json::from_str(text).expect("valid");
    let methods = data["methods"].as_array().expect("a list");
    assert_eq!(methods.len(), 31);
    for method in methods {
        let list = |key: &str| -> Vec<BigRational> {
            let number = |x: &serde_json::Value| match x.as_str().expect("text").split_once(" / ") {
                Some((n, d)) => decimal(n) / decimal(d),
                None => decimal(x.as_str().expect("text")),
            };
            method[key]
                .as_array()
                .expect("a list")
                .iter()
                .map(number)
                .collect()
        };
        let known = |key: &str| method[key].as_u64().expect("an order") as usize;
        let pair = splitting(&list("drift"), &list("kick"));
        let name = &method["name"];
        let separable = approximate_order(&pair, HamiltonianClass::Separable);
        assert_eq!(separable, known("order_general_separable"), "{name}");
        let nystrom = approximate_order(&pair, HamiltonianClass::Nystrom);
        assert_eq!(nystrom, known("order"), "{name}");
    }
}

/// McLachlan & Atela 4, published as order 4 for every separable `H`, is of order 4 only for quadratic `T`.
#[test]
fn only_trees_that_vanish_for_quadratic_kinetic_energy_refute_mclachlan_atela_4() {
    let drift = [
        "0.5153528374311229364",
        "-0.085782019412973646",
        "0.4415830236164665242",
        "0.1288461583653841854",
    ];
    let kick = [
        "0.1344961992774310892",
        "-0.2248198030794208058",
        "0.7563200005156682911",
        "0.3340036032863214255",
    ];
    let pair = splitting(&drift.map(decimal), &kick.map(decimal));
    let mut weights = Weights::new(&pair, TreeRule::Class(HamiltonianClass::Separable));
    let mut violated = Vec::new();
    for condition in weights.conditions(4, false) {
        let tree = weights.tree(condition);
        let value = weights.value(condition).to_f64();
        let holds = (value - 1.0 / tree.density().to_f64().expect("a double")).abs() < 1e-12;
        assert!(
            holds || !HamiltonianClass::Nystrom.contains(&tree),
            "{tree}"
        );
        if !holds {
            violated.push(tree.to_string());
        }
    }
    assert_eq!(violated, ["q[p,p,p]", "p[q[p,p]]"]);
}

/// One condition for each tree without a root gives the same as all conditions, and so does the theorem.
#[test]
fn all_conditions_agree_with_those_of_symplectic_methods() {
    for entry in catalogue::entries().filter(|entry| entry.stages <= 6) {
        let tableau = entry.derive().expect("derived");
        let few = tableau.order(&QUICK);
        let all = tableau.order(&OrderOptions {
            all_conditions: true,
            ..QUICK
        });
        for class in HamiltonianClass::ALL {
            let (few, all) = (few.class(class), all.class(class));
            if few.order < QUICK.limit {
                assert_eq!(few.order, all.order, "{} {class}", entry.name);
                assert_eq!(
                    few.error_constant, all.error_constant,
                    "{} {class}",
                    entry.name
                );
            } else {
                assert_eq!(all.order, QUICK.limit, "{} {class}", entry.name);
            }
        }
    }
}

/// Below order 8 the simplifying assumptions give what enumeration finds for general `H`.
#[test]
#[ignore = "thorough"]
fn simplifying_assumptions_give_the_order_of_the_catalogue() {
    for entry in catalogue::entries() {
        let tableau = entry.derive().expect("derived");
        let Exact::Nodes(pair) = &*tableau.exact else {
            continue;
        };
        for pair in [pair.clone(), pair.clone().exchanged()] {
            let assumptions = simplifying_assumptions(&pair).expect("b = b̃");
            let known = Known {
                limit: 8,
                order: 0,
                evidence: Evidence::Proved,
                symplecticity: Symplecticity::of(&pair),
            };
            let options = OrderOptions {
                limit: 8,
                all_conditions: false,
            };
            let found = class_order(&pair, HamiltonianClass::General, &known);
            let proved = assumptions.order().min(options.limit);
            assert_eq!(proved, found.order, "{} {assumptions:?}", entry.name);
        }
    }
}

/// The theorem does not require symplecticity; without it, the theorem may give less than enumeration.
#[test]
fn simplifying_assumptions_never_overstate_the_order_of_other_methods() {
    let options = OrderOptions {
        limit: 6,
        all_conditions: true,
    };
    for entry in catalogue::entries().filter(|entry| entry.stages <= 4) {
        let tableau = entry.derive().expect("derived");
        let Exact::Nodes(pair) = &*tableau.exact else {
            continue;
        };
        let Partitioned { algebra, b, .. } = pair.clone();
        for matrix in [&pair.a, &pair.a_tilde] {
            let pair = Partitioned::equal(Arc::clone(&algebra), matrix.clone(), b.clone());
            let proved = simplifying_assumptions(&pair).expect("b = b̃").order();
            let found = order(&pair, &options).general.order;
            assert!(
                proved.min(6) <= found,
                "{}: {proved} but {found}",
                entry.name
            );
        }
    }
    // C(1) and D(1) prove order 3 of the 4 that RK4 has.
    let rk4 = simplifying_assumptions(&explicit_runge_kutta("rk4")).expect("b = b̃");
    assert_eq!((rk4.b, rk4.c, rk4.d, rk4.order()), (4, 1, 1, 3));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Splittings are symplectic for separable `H` with weights that differ.
    #[test]
    fn splittings_need_one_condition_for_each_tree_without_root(
        drift in prop::collection::vec(-9i64..9, 3),
        kick in prop::collection::vec(-9i64..9, 3),
        symmetric: bool,
    ) {
        let share = |n: i64| BigRational::new(n.into(), 7.into());
        let consistent = |numbers: Vec<i64>| -> Vec<BigRational> {
            let mut numbers: Vec<_> = numbers.into_iter().map(share).collect();
            let sum: BigRational = numbers.iter().sum();
            numbers.push(rational("1") - sum);
            numbers
        };
        let mut pair = splitting(&consistent(drift.clone()), &consistent(kick.clone()));
        if symmetric {
            // Order 2.
            let (x, y, half) = (share(drift[0]), share(kick[0]), rational("1/2"));
            let inner = rational("1") - &x - &x;
            let drift = [x.clone(), inner, x, rational("0")];
            pair = splitting(&drift, &[y.clone(), &half - &y, &half - &y, y]);
        }
        let few = order(&pair, &OrderOptions { limit: 5, all_conditions: false });
        let all = order(&pair, &OrderOptions { limit: 5, all_conditions: true });
        for class in [HamiltonianClass::Separable, HamiltonianClass::Nystrom] {
            let (few, all) = (few.class(class), all.class(class));
            prop_assert_eq!(few.order, all.order);
            prop_assert_eq!(&few.error_constant, &all.error_constant);
        }
    }
}

#[test]
fn high_orders_are_proved_and_sharp() {
    for (nodes, stages, order) in [
        ("gauss", 20, 40),
        ("lobatto", 20, 38),
        ("radau-right", 20, 39),
        ("radau-left", 20, 39),
    ] {
        let report = derived(
            &format!("polynomial({stages})"),
            &format!("{nodes}({stages})"),
        )
        .order(&QUICK);
        assert_eq!(orders(&report), [order; 3], "{nodes}");
    }
}

#[test]
fn error_constants_are_those_found_by_hand() {
    let constant = |found: &ClassOrder| found.error_constant.as_ref().map(ToString::to_string);
    let verlet = derived("polynomial(2)", "lobatto(2)").order(&QUICK);
    // q[p,p]: −1/24, q[p[q]]: −1/6, p[q,q] and p[q[p]]: 1/12, each divided by the symmetry.
    assert_eq!(
        constant(&verlet.separable).as_deref(),
        Some("0.208333333333")
    );
    // Without q[p,p]: √(16 + 4 + 4)/24.
    assert_eq!(constant(&verlet.nystrom).as_deref(), Some("0.204124145232"));
    let midpoint = derived("polynomial(1)", "1/2").order(&QUICK);
    // ∓1/12 for both shapes: (3 + 8)/144.
    assert_eq!(
        constant(&midpoint.general).as_deref(),
        Some("0.276385399196")
    );
    // One colour: √17/24, and the norm for RK4 in the tables of Dormand & Prince, 0.0145.
    let one_colour = |name: &str, order: usize| {
        let pair = explicit_runge_kutta(name);
        let mut weights = Weights::new(&pair, TreeRule::OneColour);
        let conditions = weights.conditions(order, false);
        let term = |condition| Term {
            value: weights.value(condition),
            wanted: weights.wanted(condition),
            weight: unrooted::weight(HamiltonianClass::General, &weights.tree(condition), false),
        };
        let terms: Vec<_> = conditions.into_iter().map(term).collect();
        error_constant::norm(&terms).map(|norm| norm.to_string())
    };
    assert_eq!(one_colour("midpoint", 3).as_deref(), Some("0.171796067734"));
    assert!(one_colour("rk4", 5).is_some_and(|norm| norm.starts_with("0.0145")));
}

#[test]
fn weights_are_those_of_the_recursion_over_each_tree() {
    let pair = splitting(
        &[rational("2/3"), rational("-2/3"), rational("1")],
        &[rational("7/24"), rational("3/4"), rational("-1/24")],
    );
    let mut weights = Weights::new(&pair, TreeRule::Class(HamiltonianClass::General));
    for order in 1..=5 {
        for condition in weights.conditions(order, false) {
            let tree = weights.tree(condition);
            assert_eq!(tree.order(), order);
            assert_eq!(weights.wanted(condition), tree.wanted());
            assert!(
                weights.value(condition).equals(&weight(&pair, &tree)),
                "{tree}"
            );
        }
    }
}

#[test]
#[ignore = "thorough"]
fn order_10_of_five_stages_by_full_enumeration() {
    let options = OrderOptions {
        limit: 10,
        all_conditions: true,
    };
    let tableau = derived("polynomial(5)", "gauss(5)");
    let Exact::Nodes(pair) = &*tableau.exact else {
        panic!("classical nodes");
    };
    let found = class_order(pair, HamiltonianClass::General, &Known::of(pair, &options));
    assert_eq!(found.order, 10);
}

/// Yoshida's triple jump of Gauss with 4 stages has order 10. Its numbers are expressions; those for all trees of
/// order 9 would take more than 10 GB.
#[test]
fn memory_is_bounded_where_numbers_are_expressions() {
    let (outer, gauss) = (
        "1/(2 - root(t^9 - 2, 1))",
        "basis: polynomial(4), nodes: gauss(4)",
    );
    let text =
        format!("compose: [[{outer}, {gauss}], [1 - 2*({outer}), {gauss}], [{outer}, {gauss}]]");
    let definition = crate::Definition::parse(&text).expect("a definition");
    let tableau = definition
        .derive(&crate::Limits::default())
        .expect("derived");
    let report = tableau.order(&OrderOptions::default());
    assert!(
        (8..=10).contains(&report.general.order),
        "{}",
        report.general
    );
    assert_eq!(report.nystrom.order, 10);
    assert!(report.nystrom.refuted_by.is_some());
}

/// The order of symplecticity is no lower than the order, which may be beyond the limit of its trees.
#[test]
fn methods_are_as_symplectic_as_accurate() {
    let fractions: Vec<String> = (0..5).map(|i| format!("{i}/4")).collect();
    let tableau = derived("polynomial(5)", &fractions.join(", "));
    let numbers = tableau.exact_forms();
    let list = |row: &[Option<String>]| -> String {
        let numbers: Vec<&str> = row
            .iter()
            .map(|x| x.as_deref().expect("rational"))
            .collect();
        numbers.join(", ")
    };
    let rows: Vec<String> = numbers
        .a
        .iter()
        .map(|row| format!("[{}]", list(row)))
        .collect();
    let text = format!("a: [{}], b: [{}]", rows.join(", "), list(&numbers.b));
    let definition = crate::Definition::parse(&text).expect("a definition");
    let boole = definition
        .derive(&crate::Limits::default())
        .expect("derived");
    assert_eq!(boole.orders().general.order, 6);
    let found = boole.symplecticity_order(3).expect("not symplectic");
    assert_eq!((found.order, found.violated), (6, None));
}
