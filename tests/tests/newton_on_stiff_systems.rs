//! Newton's iteration on stiff systems: right to what rounding does to the exact solution, in few sweeps.
//!
//! `cargo run -p symplectic-tests --example stiff_steps` makes the whole grid, k = 10² … 10¹² and h = 10⁻⁴ … 1.

use symplectic_tests::stiff_steps::grid;

/// Sweeps, where full Newton in doubles needs at most [`EASY`] iterations.
const MAX_SWEEPS: u32 = 30;

const EASY: u32 = 5;

#[test]
fn steps_are_as_right_as_rounding_lets_them_be() {
    let mut runs = 0;
    grid(&[2, 7, 10], &[-3, 0], |outcome| {
        runs += 1;
        // Beyond its stability a method has several solutions, or an overflow.
        if outcome.grows {
            return;
        }
        let is_easy = outcome.in_full.is_some_and(|iterations| iterations <= EASY);
        match &outcome.sweeps {
            Ok(sweeps) => assert!(!is_easy || *sweeps <= MAX_SWEEPS, "{outcome:?}"),
            Err(_) => assert!(!is_easy, "{outcome:?}"),
        }
        // The unit is the bound, to first order, of one rounding in each place.
        if let (Some(error), Ok(_)) = (outcome.error, &outcome.sweeps) {
            assert!(error < 4.0, "{outcome:?}");
        }
    });
    assert_eq!(runs, 3 * 2 * 4 * 6 * 4);
}
