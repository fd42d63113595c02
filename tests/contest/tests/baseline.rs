//! The integrators written by hand, against which the library is timed, integrate what the library integrates.

use symplectic::Error;
use symplectic_contest::pairs;

#[test]
fn library_and_baseline_go_to_the_same_states() -> Result<(), Error> {
    let mut failures = Vec::new();
    for pair in pairs() {
        let difference = pair.difference()?;
        // Where the order of the operations differs, rounding errors grow by the phase of an orbit and by chaos.
        let bound = if pair.same_arithmetic { 0.0 } else { 1e-11 };
        if difference.is_nan() || difference > bound {
            failures.push(format!("{}: {difference:e}", pair.label()));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
    Ok(())
}
