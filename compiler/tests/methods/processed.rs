//! Processed methods: a kernel between a processor and its inverse.

use symplectic_compiler::order::{HamiltonianClass, Pendulum};
use symplectic_compiler::{Definition, Evidence, Limits, Tableau};

fn read(text: &str) -> Result<Tableau, symplectic_compiler::Error> {
    Definition::parse(text)?.derive(&Limits::default())
}

fn derive(text: &str) -> Tableau {
    read(text).expect(text)
}

fn refused(text: &str) -> String {
    read(text).expect_err(text).to_string()
}

/// Morales et al. 2025, Table 2, with the last weights from their sums.
const MORALES: &str = "base: velocity-verlet, weights: [0.21456475499897766986381219621761, 0.51788649682987924281787142226803, \
     -0.33342207567391682979227850551172, 0.15757644257569146373033662060461, -0.37307499512657736825709230652023, \
     0.18372413281145589944261642180363, 0.1947017706053903224022456342907, 0.21784176681731006074681969186513, \
     -0.55959658767642092190866235003552], symmetric: true, processor: back_and_forth(-0.44324901019570126590495430949294, \
     0.25459857192003772850622377066944, -0.73862036266779261573694538099739, -0.00024139614958652134370419495289618, \
     0.73873460354125365739379753874964, -0.20285971152536085519251666906017, 0.44989521689676869571827637424046, \
     0.29538398007876871184026747505657, -0.3364996155865700091428329802017, -0.017142276311817526137611624011)";

#[test]
fn the_symplectic_euler_method_processed_with_half_a_kick_is_stoermer_verlet() {
    let tableau = derive("kick: [1], drift: [1], processor: [kick: [1/2], drift: [0]]");
    let verlet = derive("kick: [1/2, 1/2], drift: [1, 0]");
    assert!(tableau.has_coefficients_of(&verlet));
    assert!(tableau.separable_properties().symmetric.holds);
    let kernel = &tableau.processed().expect("processed").kernel;
    assert!(kernel.has_coefficients_of(&derive("kick: [1], drift: [1]")));
    assert_eq!(tableau.evaluations(), kernel.evaluations());
    let steps = [&tableau, kernel].map(|method| method.stable_steps().to_string());
    assert_eq!(steps, ["(0, 2)"; 2]);
    // A quarter of a kick leaves an error of order 1.
    let other = derive("kick: [1], drift: [1], processor: [kick: [1/4], drift: [0]]");
    assert_eq!(other.orders().separable.order, 1);
}

#[test]
fn the_definition_of_a_processed_method_is_read_back() {
    for text in [
        "kick: [1], drift: [1], processor: [kick: [1/2], drift: [0]]",
        "kick: [1], drift: [1], processor: [kick: [1/2], drift: [0]], exchange: true",
        "base: velocity-verlet, weights: [1/2, 1/2], processor: back_and_forth(1/3, -1/3)",
        "base: [basis: 1, nodes: 0], processor: [1/3, adjoint(-1/3)]",
    ] {
        if text.contains("exchange") {
            assert!(refused(text).contains("the kicks sum to 1/2, but must sum to 0"));
            continue;
        }
        let tableau = derive(text);
        let written = tableau.provenance().definition.to_string();
        let again = derive(&written);
        assert_eq!(again.provenance().definition.to_string(), written);
        assert!(again.has_coefficients_of(&tableau), "{written}");
    }
}

/// The processor of the paper is Q(h) Q(−h), whose logarithm is even in h up to the degree 6 only, because Σγ³ is not zero.
#[test]
fn the_method_of_morales_has_order_7_as_a_whole_and_not_8() {
    let tableau = derive(&format!("{MORALES}, claim: separable(7)"));
    assert!(tableau.wrong_digits().is_empty());
    let orders = tableau.orders();
    assert_eq!(
        (orders.separable.order, orders.separable.evidence),
        (7, Evidence::Certified)
    );
    let violated = orders
        .separable
        .refuted_by
        .as_ref()
        .expect("a condition of order 8");
    assert_eq!(violated.tree.order(), 8);
    let refused = refused(&format!("{MORALES}, claim: separable(8)"));
    assert!(
        refused.contains("is 0.000039 away from the digits"),
        "{refused}"
    );
}

#[test]
fn a_changed_digit_of_the_kernel_or_of_the_processor_is_found() {
    for (right, wrong, place) in [
        (
            "0.51788649682987924281787142226803",
            "0.51788649682887924281787142226803",
            "weight[1], rounded: that is 0.51788649682987924281787142226803",
        ),
        (
            "-0.73862036266779261573694538099739",
            "-0.73862036266679261573694538099739",
            "processor[2], rounded: that is -0.73862036266779261573694538099739",
        ),
    ] {
        let text = format!("{MORALES}, claim: separable(7)").replace(right, wrong);
        let tableau = derive(&text);
        let [found] = tableau.wrong_digits() else {
            panic!("{:?}", tableau.wrong_digits());
        };
        assert!(found.to_string().contains(place), "{found}");
    }
}

#[test]
fn a_processor_that_does_not_fit_is_refused() {
    for (text, expected) in [
        (
            "base: velocity-verlet, weights: [1], processor: [1/3, -1/4]",
            "the fractions of the processor sum to 1/12, but must sum to 0",
        ),
        (
            "kick: [1], drift: [1], processor: [kick: [1/2], drift: [1/2]]",
            "the drifts sum to 1/2, but must sum to 0",
        ),
        (
            "kick: [1], drift: [1], processor: [base: velocity-verlet]",
            "the processor of a splitting consists of kicks",
        ),
        (
            "kick: [1], drift: [1], processor: [kick: [1/2], drift: [0]], adjoint: true",
            "take the adjoint of the kernel",
        ),
        (
            "kick: [1.0], drift: [1.0], processor: [kick: [0.5], drift: [0.0]], claim: separable(2)",
            "takes a `base` with `weights`",
        ),
        (
            "basis: polynomial(2), nodes: gauss(2), processor: [1/2, -1/2]",
            "a `processor` goes with",
        ),
    ] {
        let found = refused(text);
        assert!(found.contains(expected), "{text}: {found}");
    }
}

/// A kernel of coupled stages.
#[test]
fn a_processed_composition_of_a_coupled_method_keeps_its_order() {
    let text =
        "base: gauss-1, weights: triple_jump(4), processor: back_and_forth(1/3, -1/5, -2/15)";
    let tableau = derive(text);
    assert_eq!(tableau.orders().general.order, 4);
    let seen = tableau
        .observed_order(Pendulum::Coupled, 4)
        .expect("an order");
    assert!((seen - 4.0).abs() < 0.05, "{seen}");
}

#[test]
fn the_kernel_of_morales_has_conjugate_order_8_and_a_changed_digit_takes_it_away() {
    let tableau = derive(&format!("{MORALES}, claim: separable(7)"));
    let kernel = &tableau.processed().expect("processed").kernel;
    assert_eq!(kernel.orders().separable.order, 4);
    for class in [HamiltonianClass::Separable, HamiltonianClass::Nystrom] {
        let found = tableau.conjugate_order(class).expect("a splitting");
        assert_eq!(
            (found.order, found.evidence),
            (8, Evidence::Certified),
            "{class:?}"
        );
        let violated = found.refuted_by.expect("conditions of degree 9");
        assert_eq!(violated.degree, 9);
    }
    assert!(tableau.conjugate_order(HamiltonianClass::General).is_none());
    // As exact numbers; the middle one makes the sum.
    let (list, _) = MORALES
        .split_once("weights: [")
        .and_then(|(_, rest)| rest.split_once(", -0.5595"))
        .expect("the weights before the middle one");
    let changed = list.replace("0.51788649682987924", "0.51788649682887924");
    let sum = changed.replace(',', " +");
    let text =
        format!("base: velocity-verlet, weights: [{changed}, 1 - 2*({sum})], symmetric: true");
    let found = derive(&text).conjugate_order(HamiltonianClass::Separable);
    assert_eq!(found.expect("a splitting").order, 2);
}
