//! The table of methods and problems, stiff and extreme: each cell has the verdict that is written here, or that the proved
//! stability set says, and none is silent.
//!
//! `cargo run --release -p symplectic-tests --bin report -- --scene stiff` makes a page of it, with 10⁷ steps in its last row.

use symplectic_report::Verdict;
use symplectic_tests::stiff_and_extreme::{
    ENTRANTS, PARTS_OF_THE_LIMIT, Stages, at_the_limit, extremes, limits, oscillators, verdicts,
};

/// The verdicts on [`extremes`], a letter a method as [`Verdict::letter`] has them, in the order of [`ENTRANTS`]. Explicit ones:
/// symplectic Euler, Störmer–Verlet, Ruth, McLachlan & Atela, Forest & Ruth; Blanes & Moan S6, S10, SRKN 11b and 14a, ABA
/// (10, 6, 4); Yoshida 8, Kahan & Li 8, Sofroniou & Spaletta 10, triple jump 8. By fixed-point iteration: Lobatto 3, Gauss 2, 4
/// and 8. By Newton's: midpoint, Gauss 4, Lobatto 3, Radau 3, Clenshaw–Curtis 4, Galerkin, trigonometric Gauss 4, triple jump of
/// Gauss 2.
///
/// Through a collision an explicit method leaps, and only the energy knows; the iteration of most implicit ones stops.
const EXPECTED: &[(&str, &str)] = &[
    (
        "spring pendulum, ω = 10⁴, resolved",
        "aaaaa aaaaa aaaa aaaa aaaaaaaa",
    ),
    (
        "FPUT springs, ω = 10⁵, resolved",
        "bbaaa aaaaa aaaa aaaa aaaaaaaa",
    ),
    (
        "spring pendulum, ω = 10⁴, a hundred times too long",
        "uuuuu uuuuu uuuu nnnn aauuuuaa",
    ),
    (
        "FPUT springs, ω = 10⁵, a hundred times too long",
        "uuuuu uuuuu ffff nnnn aauuuuba",
    ),
    ("Kepler, e = 0.9", "bbbab aaaaa aaab aaaa baaabaaa"),
    (
        "Kepler, e = 0.999, resolved",
        "bbbab aaaaa aaaa aaaa baaabaaa",
    ),
    (
        "Kepler, e = 0.999, not resolved",
        "uuuuu uuubb uuuu ubbb bbububbn",
    ),
    (
        "Kepler, e = 1 − 10⁻⁹, resolved",
        "ubbab aaaaa aaaa baaa bababaaa",
    ),
    (
        "Kepler, e = 1 − 10⁻⁹, not resolved",
        "uuuuu uuuuu uuuu uuuu uuunuuuu",
    ),
    (
        "Kepler, head-on collision",
        "bbbbu bbbbb ubub bnnn nubnnunn",
    ),
    (
        "three bodies, not resolved",
        "bbbbb bbbbb ubbb nnnn nnnnbnnn",
    ),
    (
        "oscillator of the size 10^-300",
        "baaaa aaaaa aaaa aaaa aaaaaaaa",
    ),
    (
        "oscillator of the size 10^-150",
        "baaaa aaaaa aaaa aaaa aaaaaaaa",
    ),
    (
        "oscillator of the size 10^150",
        "baaaa aaaaa aaaa aaaa aaaaaaaa",
    ),
    (
        "oscillator of the size 10^300",
        "baaaa aaaaa aaaa aaaa aaaaaaaa",
    ),
    (
        "Kepler, e = 0.6, 2e2 steps",
        "bbaaa aaaaa aaaa aaaa baaaaaaa",
    ),
    ("Kepler, e = 0.6, 2e3 steps", "bbaaa aaaaa aaaa aaaa"),
];

#[test]
fn every_explicit_method_has_its_proved_limit() {
    let limits = limits(|_| true).expect("the files of the repository");
    for limit in &limits {
        let deviation = limit.deviation();
        assert!(deviation < 0.01, "{limit:?}: {deviation}");
    }
    assert!(limits.len() >= 80, "{}", limits.len());
}

#[test]
fn oscillators_are_stable_where_that_is_proved_and_the_others_end_as_they_are_known_to() {
    let table = verdicts(2_000, |_| true, |_, _| {}).expect("the files of the repository");
    let problems: Vec<&str> = table.rows.iter().map(|row| row.problem.as_str()).collect();
    let expected: Vec<String> = oscillators()
        .map(|(problem, _)| problem)
        .chain(PARTS_OF_THE_LIMIT.map(at_the_limit))
        .chain(extremes(2_000).into_iter().map(|(problem, _)| problem))
        .collect();
    assert_eq!(problems, expected);
    let of_extremes = &table.rows[table.rows.len() - extremes(2_000).len()..];
    let linear = &table.rows[..table.rows.len() - of_extremes.len()];
    let mut kinds = String::new();
    for row in linear {
        for (entrant, cell) in ENTRANTS.iter().zip(&row.cells) {
            let Some(cell) = cell else {
                // Only where there is no limit.
                assert!(row.problem.ends_with('*'), "{}", row.problem);
                continue;
            };
            // An iteration by fixed points that does not converge hides what the method would do.
            let hidden = entrant.stages == Stages::FixedPoint && cell.verdict.letter() == 'n';
            let as_proved = cell.is_as_proved() == Some(true);
            assert!(
                cell.verdict.is_finite() && (as_proved || hidden),
                "{}, {}: {cell:?}",
                row.problem,
                entrant.name
            );
            kinds.push(cell.verdict.letter());
        }
    }
    for kind in "abun".chars() {
        assert!(kinds.contains(kind), "{kinds}");
    }
    for row in of_extremes {
        let mut cells = row.cells.iter().flatten();
        assert!(cells.all(|cell| cell.verdict.is_finite()));
    }
    let found: Vec<(&str, String)> = of_extremes
        .iter()
        .map(|row| {
            let cells = row.cells.iter().flatten();
            let letters = cells.map(|cell| Verdict::letter(&cell.verdict));
            (row.problem.as_str(), letters.collect())
        })
        .collect();
    let expected: Vec<(&str, String)> = EXPECTED
        .iter()
        .map(|(problem, letters)| (*problem, letters.replace(' ', "")))
        .collect();
    assert_eq!(found, expected);
}
