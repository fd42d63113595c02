//! Definitions by printed digits: the tableau of the exact method that is proved to be near them.

use serde_json::Value;
use symplectic_compiler::certify::{Claim, Coefficient, Splitting, certify};
use symplectic_compiler::export::{json, toml};
use symplectic_compiler::{
    Definition, Evidence, Limits, Requirement, Tableau, Tier, catalogue, check,
};

fn derive(text: &str) -> Tableau {
    let definition = Definition::parse(text).expect(text);
    definition.derive(&Limits::default()).expect(text)
}

fn refused(text: &str) -> String {
    let definition = Definition::parse(text).expect(text);
    let error = definition.derive(&Limits::default()).expect_err(text);
    error.to_string()
}

/// Forest & Ruth 1990, as a paper prints it.
const JUMP: &str = "kick: [0.675603595979829, -0.175603595979829, -0.175603595979829, 0.675603595979829], \
                    drift: [1.351207191959658, -1.702414383919315, 1.351207191959658, 0.0], claim: separable(4)";

#[test]
fn a_certified_method_is_that_of_the_closed_form() {
    let tableau = derive(JUMP);
    assert_eq!(tableau.tier(), Tier::Enclosure);
    let exact = catalogue::find("forest-ruth-1990").expect("known");
    let exact = exact.derive().expect("derived");
    assert_eq!(tableau.to_f64(), exact.to_f64());
    let digits = |tableau: &Tableau| {
        tableau
            .numbers()
            .map(|number| number.decimal(60).to_string())
    };
    assert_eq!(digits(&tableau), digits(&exact));
    // The digits, as exact numbers, are another method, of order 2 at most.
    let printed = JUMP.replace(", claim: separable(4)", "");
    assert!(
        refused(&printed).contains("the drifts sum to"),
        "{}",
        refused(&printed)
    );
}

#[test]
fn the_claimed_order_is_certified_and_the_next_one_refuted() {
    let tableau = derive(JUMP);
    let orders = tableau.orders();
    for (found, order) in [
        (&orders.general, 1),
        (&orders.separable, 4),
        (&orders.nystrom, 4),
    ] {
        assert_eq!((found.order, found.evidence), (order, Evidence::Certified));
        assert!(found.refuted_by.is_some());
    }
    assert!(
        orders
            .separable
            .to_string()
            .starts_with("4, certified; not 5: ")
    );
    let require = |text: &str| tableau.require(&Requirement::parse(text).expect(text), None);
    assert_eq!(require("order(separable) == 4"), Ok(()));
    assert_eq!(require("order(nystrom) >= 4"), Ok(()));
    assert!(require("order(separable) >= 5").is_err());
    // Symmetry is in the structure, which enclosures need not verify.
    let separable = tableau.separable_properties();
    assert!(separable.symplectic.holds && separable.symmetric.holds);
    // A claim for quadratic T is order 4 for separable H, too, if the method is symmetric; a higher one is verified.
    let quadratic = derive(&JUMP.replace("separable(4)", "nystrom(4)"));
    let separable = &quadratic.orders().separable;
    assert_eq!(
        (separable.order, separable.evidence),
        (4, Evidence::Certified)
    );
    let yoshida = derive(
        "kick: [0.392256805238778632, 0.510043411918457699, -0.471053385409756437, 0.068753168252520106, 0.068753168252520106, -0.471053385409756437, 0.510043411918457699, 0.392256805238778632], \
         drift: [0.784513610477557264, 0.235573213359358134, -1.177679984178871007, 1.315186320683911219, -1.177679984178871007, 0.235573213359358134, 0.784513610477557264, 0], claim: nystrom(6)",
    );
    let orders = yoshida.orders();
    assert_eq!(orders.nystrom.evidence, Evidence::Certified);
    assert_eq!(orders.separable.order, 6);
    assert!(matches!(
        orders.separable.evidence,
        Evidence::Verified { .. }
    ));
    let error = yoshida.require(
        &Requirement::parse("order(separable) == 6").expect("read"),
        None,
    );
    assert!(
        error
            .expect_err("verified")
            .to_string()
            .contains("only verified")
    );
    // Exchanged, it is U that is quadratic.
    let exchanged = derive(&format!(
        "{}, exchange: true",
        JUMP.replace("separable(4)", "nystrom(4)")
    ));
    assert!(matches!(
        exchanged.orders().nystrom.evidence,
        Evidence::Verified { .. }
    ));
}

#[test]
fn definitions_and_files_come_back() {
    for text in [
        JUMP.to_owned(),
        format!("{JUMP}, exchange: true, adjoint: true"),
    ] {
        let tableau = derive(&text);
        let definition = tableau.provenance().definition.to_string();
        assert_eq!(definition, text);
        assert_eq!(derive(&definition), tableau);
        let limits = Limits::default();
        let written = toml::write(&tableau, 40);
        assert!(written.contains("claim = \"separable(4)\"\n"), "{written}");
        assert!(written.contains("evidence = \"certified\""), "{written}");
        assert_eq!(check("jump.toml", &written, &limits), Ok(tableau.clone()));
        let edited = written.replace("\"certified\"", "\"proved\"");
        assert!(check("jump.toml", &edited, &limits).is_err());
        let written = json::write(&tableau, 40);
        assert_eq!(check("jump.json", &written, &limits), Ok(tableau.clone()));
        // The method of an operation is that of its definition.
        let adjoint = tableau.adjoint();
        let again = derive(&adjoint.provenance().definition.to_string());
        assert_eq!(adjoint.orders(), again.orders());
        assert_eq!(adjoint.to_f64(), again.to_f64());
    }
}

/// The kicks and drifts that a paper prints lead to the method that the catalogue derives from half of them, or from the
/// weights of a composition.
#[test]
#[ignore = "thorough"]
fn methods_of_the_literature_are_derived() {
    let data: Value =
        serde_json::from_str(include_str!("../data/explicit-methods.json")).expect("JSON");
    let mut count = 0;
    for method in data["methods"].as_array().expect("a list") {
        let name = method["name"].as_str().expect("a name");
        let entry = catalogue::find(name).expect(name);
        let Some((_, claim)) = entry.definition.split_once("claim: ") else {
            continue;
        };
        let list = |key: &str| -> Vec<&str> {
            let list = method[key].as_array().into_iter().flatten();
            list.filter_map(Value::as_str).collect()
        };
        let (kick, drift) = (list("kick"), list("drift"));
        let order = method["order"].as_u64().expect(name) as usize;
        let claim = match claim.split_once('(').expect(claim) {
            ("nystrom", _) => Claim::Nystrom(order),
            _ => Claim::Separable(order),
        };
        let printed = Splitting::parse(&kick, &drift).expect(name);
        let certificate = certify(&printed, &claim).expect(name);
        let digits = |coefficient: Coefficient| {
            let decimal = certificate.decimal(coefficient, 50).expect(name);
            decimal.expect(name).to_string()
        };
        let numbers = entry.derive().expect(name);
        let numbers = numbers.numbers();
        for (weights, name) in [
            (
                numbers.b_tilde,
                Coefficient::Kick as fn(usize) -> Coefficient,
            ),
            (numbers.b, Coefficient::Drift),
        ] {
            let weights = weights.iter().map(|weight| weight.decimal(50).to_string());
            let certified = (0..kick.len()).map(|index| digits(name(index)));
            let nonzero = |digits: &String| digits != "0";
            assert!(
                weights.filter(nonzero).eq(certified.filter(nonzero)),
                "{}",
                entry.name
            );
        }
        count += 1;
    }
    assert_eq!(count, 19);
}

/// Halves and whole lists, drifts first and kicks first.
#[test]
fn printed_halves_are_mirrored() {
    let half = "kick: [0.675603595979829, -0.175603595979829], drift: [1.351207191959658, -1.702414383919315], \
                symmetric: true, claim: separable(4)";
    let drifts = |tableau: &Tableau| {
        tableau
            .numbers()
            .b
            .iter()
            .map(|x| x.decimal(50).to_string())
            .collect::<Vec<_>>()
    };
    assert_eq!(drifts(&derive(half)), drifts(&derive(JUMP)));
    assert_eq!(derive(half).evaluations(), derive(JUMP).evaluations());
    let position = "kick: [1.351207191959658, -1.702414383919315], drift: [0.675603595979829, -0.175603595979829], \
                    first: drift, symmetric: true, claim: separable(4)";
    let tableau = derive(position);
    assert_eq!(tableau.stages(), 4);
    assert_eq!(tableau.orders().separable.evidence, Evidence::Certified);
    assert_eq!(
        derive(&tableau.provenance().definition.to_string()),
        tableau
    );
}

/// `(10, 6, 4)` in the size of a perturbation and the step is order 4 for all separable systems.
#[test]
fn methods_for_perturbed_systems_have_their_last_order() {
    for (name, order, evidence) in [
        ("blanes-2013-aba-10-6-4", 4, Evidence::Certified),
        ("saba-8", 2, Evidence::Certified),
        ("saba-5", 2, Evidence::Proved),
    ] {
        let tableau = catalogue::find(name).and_then(|entry| entry.derive().ok());
        let orders = tableau.expect(name).orders();
        for found in [orders.separable, orders.nystrom] {
            assert_eq!((found.order, found.evidence), (order, evidence), "{name}");
            assert!(found.refuted_by.is_some(), "{name}");
        }
    }
}

#[test]
fn wrong_claims_and_digits_are_refused_at_the_key() {
    let wrong = |from: &str, to: &str| {
        assert!(JUMP.contains(from), "{from}");
        refused(&JUMP.replace(from, to))
    };
    let told = wrong("separable(4)", "separable(5)");
    assert!(told.starts_with("claim, column 1: "), "{told}");
    let told = wrong("separable(4)", "general(4)");
    assert!(
        told.ends_with(
            "found general(4), expected `separable(6)`, `nystrom(6)` or `perturbed(8, 6, 4)`"
        ),
        "{told}"
    );
    let told = wrong("-1.702414383919315", "-1.702414483919315");
    assert!(
        told.starts_with("drift, column 1: the drifts sum to 0.99999"),
        "{told}"
    );
    let told = wrong(", 0.0]", "]");
    assert!(
        told.starts_with("drift, column 1: 4 kicks and 3 drifts"),
        "{told}"
    );
    let told = wrong("0.0]", "sqrt(2)]");
    assert!(told.contains("`sqrt(2)` is not a decimal"), "{told}");
    let told = wrong("claim", "nodes: [0], claim");
    assert!(told.contains("leave out `nodes`"), "{told}");
    let told = refused("claim: separable(4)");
    assert!(
        told.contains(
            "`kick` and `drift` of a splitting, or the `weights` of a `base`, which are missing"
        ),
        "{told}"
    );
    let told = refused("kick: [0.5, 0.5], claim: separable(2)");
    assert!(told.contains("`drift` is missing beside `kick`"), "{told}");
}
