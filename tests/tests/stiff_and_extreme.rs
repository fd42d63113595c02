//! The table of methods and problems, stiff and extreme: each cell has the outcome that is written here, or that the proved
//! stability set says, and none is silent.
//!
//! `cargo run --release --example stiff_and_extreme -- --long` prints it with 10⁷ steps in its last row.

use symplectic_tests::linear_stability::catalogue;
use symplectic_tests::outcomes::{
    BY_NEWTON, EXPLICIT, METHODS, OSCILLATOR_STEPS, Outcome, Row, extremes, oscillators,
    oscillators_at_the_limit,
};

/// The outcomes of [`extremes`], a letter a method as [`Outcome::letter`] has them, in the order of [`METHODS`]: symplectic
/// Euler, Störmer–Verlet, Forest & Ruth, Blanes & Moan; Lobatto 3, Gauss 2, 4 and 8 by fixed-point iteration; Gauss 4 by
/// Newton's.
///
/// Through a collision an explicit method leaps, and only the energy knows; the iteration of an implicit one stops.
const EXPECTED: &[(&str, &str)] = &[
    ("spring pendulum, ω = 10⁴, resolved", "aaaa aaaa a"),
    ("FPUT springs, ω = 10⁵, resolved", "bbaa aaaa a"),
    (
        "spring pendulum, ω = 10⁴, a hundred times too long",
        "uuuu nnnn a",
    ),
    (
        "FPUT springs, ω = 10⁵, a hundred times too long",
        "uuuu nnnn a",
    ),
    ("Kepler, e = 0.9", "bbba aaaa a"),
    ("Kepler, e = 0.999, resolved", "bbba aaaa a"),
    ("Kepler, e = 0.999, not resolved", "uuub ubbb b"),
    ("Kepler, e = 1 − 10⁻⁹, resolved", "ubba baaa a"),
    ("Kepler, e = 1 − 10⁻⁹, not resolved", "uuuu uuuu n"),
    ("Kepler, head-on collision", "bbub bnnn n"),
    ("three bodies, not resolved", "bbbb nnnn n"),
    ("oscillator of the size 10^-300", "baaa aaaa a"),
    ("oscillator of the size 10^-150", "baaa aaaa a"),
    ("oscillator of the size 10^150", "baaa aaaa a"),
    ("oscillator of the size 10^300", "baaa aaaa a"),
    ("Kepler, e = 0.6, 2000 steps", "bbaa aaaa a"),
];

#[test]
fn every_explicit_method_has_its_proved_limit() {
    let catalogue = catalogue().expect("the files of the repository");
    let explicit = catalogue.values().filter(|entry| entry.is_explicit);
    let mut measured = 0;
    for entry in explicit {
        let step = entry.explicit().expect("an order of the stages");
        let proved = entry.proved_limit().expect("a limit");
        let error = (step.measured_limit() / proved - 1.0).abs();
        assert!(error < 0.01, "{}: {error} of {proved}", entry.name);
        measured += 1;
    }
    assert!(measured >= 80, "{measured}");
}

#[test]
fn oscillators_are_stable_where_that_is_proved_and_nowhere_else() {
    let catalogue = catalogue().expect("the files of the repository");
    let entries = METHODS.map(|(_, name)| &catalogue[name]);
    let mut kinds = String::new();
    let mut check = |row: &Row, nu: &dyn Fn(usize) -> f64| {
        for (column, outcome) in row.outcomes.iter().enumerate() {
            let Some(outcome) = outcome else { continue };
            let letters = match entries[column].is_stable_at(nu(column)) {
                false => "u",
                true if (EXPLICIT..BY_NEWTON).contains(&column) => "abn",
                true => "ab",
            };
            // An iteration that does not converge hides what the method would do.
            let stopped = (EXPLICIT..BY_NEWTON).contains(&column) && outcome.letter() == 'n';
            assert!(
                outcome.is_finite() && (letters.contains(outcome.letter()) || stopped),
                "{}, {}: {outcome}",
                row.problem,
                METHODS[column].0
            );
            kinds.push(outcome.letter());
        }
    };
    for (row, nu) in oscillators().iter().zip(OSCILLATOR_STEPS) {
        check(row, &|_| nu);
    }
    for fraction in [0.99, 1.01] {
        let row = oscillators_at_the_limit(fraction, entries);
        assert_eq!(row.outcomes.iter().flatten().count(), EXPLICIT + 1);
        let limit = |column: usize| entries[column].proved_limit().unwrap_or(f64::NAN);
        check(&row, &|column| fraction * limit(column));
    }
    for kind in "abun".chars() {
        assert!(kinds.contains(kind), "{kinds}");
    }
}

#[test]
fn extremes_end_as_they_are_known_to() {
    let rows = extremes(2_000);
    assert_eq!(rows.len(), EXPECTED.len());
    for (row, (problem, letters)) in rows.iter().zip(EXPECTED) {
        let outcomes = row.outcomes.iter().flatten();
        let found: String = outcomes.clone().map(Outcome::letter).collect();
        assert_eq!(
            (row.problem.as_str(), found),
            (*problem, letters.replace(' ', ""))
        );
        assert!(outcomes.clone().all(Outcome::is_finite));
    }
}
