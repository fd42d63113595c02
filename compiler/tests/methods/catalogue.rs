//! What the catalogue says of its methods.

use symplectic_compiler::{Tableau, catalogue};

fn derived(name: &str) -> Tableau {
    let entry = catalogue::find(name).expect(name);
    entry.derive().expect(name)
}

#[test]
#[ignore = "thorough"]
fn only_methods_listed_as_the_same_have_equal_coefficients() {
    let all: Vec<_> = catalogue::entries()
        .map(|entry| (entry.derive().expect("derived"), entry))
        .collect();
    for (one, entry) in &all {
        for (other, second) in all.iter().filter(|(_, second)| second.name != entry.name) {
            let equal = one.has_coefficients_of(other);
            let said = entry.same_as().contains(&second.name.as_str());
            assert_eq!(equal, said, "{} and {}", entry.name, second.name);
            if said {
                assert!(entry.source.contains(&second.name), "{}", entry.source);
            }
        }
    }
}

#[test]
#[ignore = "thorough"]
fn every_method_is_symplectic_for_separable_systems_consistent_and_has_a_source() {
    for entry in catalogue::entries() {
        let tableau = entry.derive().expect("derived");
        let symplectic = tableau.separable_properties().symplectic;
        assert!(
            symplectic.holds && tableau.properties().consistent.holds,
            "{}",
            entry.name
        );
        assert!(
            !entry.source.is_empty() && !entry.title.is_empty(),
            "{}",
            entry.name
        );
    }
}

#[test]
fn the_titles_of_the_radau_methods_are_true() {
    let entries = |table: Vec<Vec<Option<String>>>| {
        let shown = |row: Vec<Option<String>>| row.into_iter().flatten().collect::<Vec<_>>();
        table.into_iter().map(shown).collect::<Vec<_>>()
    };
    // Hairer & Wanner, Solving Ordinary Differential Equations II, tables IV.5.4 and IV.5.5.
    let left = derived("radau-left-2").exact_forms();
    assert_eq!(
        entries(left.a_tilde),
        [["1/4", "-1/4"], ["1/4", "5/12"]],
        "Radau IA"
    );
    let right = derived("radau-right-2").exact_forms();
    assert_eq!(
        entries(right.a),
        [["5/12", "-1/12"], ["3/4", "1/4"]],
        "Radau IIA"
    );
    // The partner of Radau IIA has the right nodes and is not Radau IA.
    assert_eq!(entries(right.a_tilde), [["1/3", "0"], ["1", "0"]]);
}

#[test]
fn symplectic_euler_and_its_adjoint_are_adjoint() {
    let adjoint = derived("symplectic-euler").adjoint();
    let forms = |tableau: &Tableau| {
        let forms = tableau.exact_forms();
        (forms.a, forms.a_tilde, forms.b)
    };
    assert_eq!(forms(&adjoint), forms(&derived("symplectic-euler-adjoint")));
    assert_ne!(forms(&derived("midpoint")), forms(&adjoint));
}
