//! Definitions by printed digits: the tableau of the exact method that is proved to be near them.

use symplectic_compiler::export::{json, toml};
use symplectic_compiler::{
    Definition, Evidence, Limits, Requirement, Tableau, Tier, check, refine,
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
    let exact = symplectic_compiler::catalogue::find("forest-ruth-1990").expect("known");
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
    // Without the claim of it an order is verified.
    let lower = derive(&JUMP.replace("separable(4)", "nystrom(4)"));
    let orders = lower.orders();
    assert_eq!(orders.nystrom.evidence, Evidence::Certified);
    assert!(matches!(
        orders.separable.evidence,
        Evidence::Verified { .. }
    ));
    assert_eq!(orders.separable.order, 4);
    let error = lower.require(
        &Requirement::parse("order(separable) == 4").expect("read"),
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

/// The methods that are known by their decimals only: what is derived is what `refine` finds.
#[test]
fn methods_of_the_literature_are_derived() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/printed");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).expect("the folder") {
        let path = entry.expect("an entry").path();
        let name = path.display().to_string();
        let text = std::fs::read_to_string(&path).expect(&name);
        let refinement = refine(&name, &text).expect(&name);
        let file: ::toml::Table = text.parse().expect(&name);
        let list = |key: &str| {
            let list = file["printed"][key].as_array().expect(key).iter();
            let list: Vec<&str> = list.filter_map(::toml::Value::as_str).collect();
            list.join(", ")
        };
        let (class, order) = (
            file["claim"]["class"].as_str(),
            file["claim"]["order"].as_integer(),
        );
        let (class, order) = (class.expect(&name), order.expect(&name));
        let definition = format!(
            "kick: [{}], drift: [{}], claim: {class}({order})",
            list("kick"),
            list("drift")
        );
        let tableau = derive(&definition);
        assert_eq!(tableau.provenance().definition.to_string(), definition);
        let orders = tableau.orders();
        let found = match class {
            "separable" => &orders.separable,
            _ => &orders.nystrom,
        };
        assert_eq!(found.order, order as usize, "{name}");
        assert_eq!(found.evidence, Evidence::Certified, "{name}");
        assert!(found.refuted_by.is_some(), "{name}");
        assert!(tableau.separable_properties().symplectic.holds, "{name}");
        // The kicks, less those of no time at all.
        let weights = tableau.numbers().b_tilde;
        let kicks = refinement.printed().iter().filter_map(|(coefficient, _)| {
            let decimal = refinement.certificate().decimal(*coefficient, 50);
            let decimal = decimal.expect(&name)?.to_string();
            let kick = matches!(
                coefficient,
                symplectic_compiler::certify::Coefficient::Kick(_)
            );
            (kick && decimal != "0").then_some(decimal)
        });
        let weights = weights.iter().map(|weight| weight.decimal(50).to_string());
        let weights: Vec<String> = weights.filter(|weight| weight != "0").collect();
        assert_eq!(weights, kicks.collect::<Vec<_>>(), "{name}");
        count += 1;
    }
    assert_eq!(count, 19);
}

#[test]
fn what_does_not_fit_is_told_at_its_part() {
    let wrong = |from: &str, to: &str| {
        assert!(JUMP.contains(from), "{from}");
        refused(&JUMP.replace(from, to))
    };
    let told = wrong("separable(4)", "separable(5)");
    assert!(told.starts_with("claim, column 1: "), "{told}");
    let told = wrong("separable(4)", "general(4)");
    assert!(
        told.ends_with(
            "general(4) where `separable(6)`, `nystrom(6)` or `perturbed(8, 6, 4)` is needed"
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
    let told = wrong("claim", "symmetric: true, claim");
    assert!(told.contains("leave out `symmetric`"), "{told}");
    let told = refused("claim: separable(4)");
    assert!(told.contains("`kick` is missing"), "{told}");
}
