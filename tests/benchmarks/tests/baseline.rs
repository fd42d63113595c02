//! The hand-written integrators, against which the library is timed, give the results of the library.

use std::num::NonZero;
use std::thread;

use symplectic::Error;
use symplectic_benchmarks::pairs;

/// The failures among every `shares`-th pair.
fn failures(share: usize, shares: usize) -> Result<Vec<String>, Error> {
    let mut failures = Vec::new();
    for pair in pairs().into_iter().skip(share).step_by(shares) {
        let difference = pair.difference()?;
        // If the order of operations differs, rounding errors grow with the phase of an orbit and by chaos.
        let bound = if pair.same_arithmetic { 0.0 } else { 1e-11 };
        if difference.is_nan() || difference > bound {
            failures.push(format!("{}: {difference:e}", pair.label()));
        }
    }
    Ok(failures)
}

#[test]
fn library_and_baseline_go_to_the_same_states() -> Result<(), Error> {
    // In parallel, because without optimisation they take minutes.
    let shares = thread::available_parallelism().map_or(1, NonZero::get);
    let found = thread::scope(|scope| {
        let start = |share| scope.spawn(move || failures(share, shares));
        let threads: Vec<_> = (0..shares).map(start).collect();
        let threads = threads.into_iter();
        threads
            .map(|thread| thread.join().expect("a panic is printed"))
            .collect::<Result<Vec<_>, _>>()
    })?;
    let failures = found.concat();
    assert!(failures.is_empty(), "{failures:#?}");
    Ok(())
}
