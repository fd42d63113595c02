//! Methods listed by their orders for perturbed systems.

use crate::run::{failure, stdout};

/// The names in a table of `list`.
fn names(arguments: &[&str]) -> Vec<String> {
    let text = stdout(&[&["list", "--class", "perturbed"], arguments].concat());
    let rows = text.lines().filter(|line| line.starts_with("  "));
    let name = |row: &str| row.split_whitespace().next().map(str::to_owned);
    rows.skip(1).filter_map(name).collect()
}

#[test]
#[ignore = "thorough"]
fn list_filters_and_sorts_by_several_orders() {
    let has = |names: &[String], name: &str| names.iter().any(|other| other == name);
    let eight = names(&["--min-order", "8,2", "--max-order", "8,2"]);
    assert!(has(&eight, "saba-4") && has(&eight, "sbab-4"));
    assert!(!has(&eight, "saba-3") && !has(&eight, "stormer-verlet"));
    let six = names(&["--min-order", "6,2", "--max-order", "6,4"]);
    assert!(has(&six, "saba-3") && !has(&six, "saba-4") && !has(&six, "triple-jump-6"));
    let sorted = names(&["--sort", "order", "--max-evaluations", "4"]);
    let place = |name: &str| sorted.iter().position(|other| other == name).expect(name);
    let expected = [
        "saba-4",
        "saba-3",
        "mclachlan-1995-s4",
        "saba-2",
        "ruth-1983",
        "saba-1",
    ];
    assert!(expected.map(place).is_sorted(), "{sorted:?}");
    assert!(!has(&sorted, "gauss-2"));
    // One number is that of all powers.
    let four = names(&["--min-order", "4", "--max-evaluations", "4"]);
    assert!(has(&four, "mclachlan-1995-s4") && !has(&four, "saba-4"));
}

#[test]
fn list_refuses_orders_that_do_not_fit_the_class() {
    for (arguments, told) in [
        (
            &["--min-order", "8,2"][..],
            "several orders need `--class perturbed`",
        ),
        (
            &["--class", "perturbed", "--sort", "error"],
            "there is no error constant for",
        ),
        (
            &["--class", "perturbed", "--min-order", "8;2"],
            "orders such as 8,4",
        ),
    ] {
        let (status, errors) = failure(&[&["list"], arguments].concat());
        assert_eq!(status, Some(2));
        assert!(errors.contains(told), "{errors}");
    }
    let shown = stdout(&["show", "saba-1"]);
    assert!(
        shown.contains("\n  perturbed  (2, 2), proved; not 3 in ε: "),
        "{shown}"
    );
}
