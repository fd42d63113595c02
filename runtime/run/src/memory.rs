//! The memory that a run needs, which is bounded before anything is computed.

/// Largest memory of a run in bytes.
const MAX_BYTES: u128 = 4_000_000_000;

/// Why the starts need too much memory; each consists of a number of coordinates and parameters.
pub(super) fn fault_of_starts(starts: usize, numbers: usize) -> Option<String> {
    let needed = of_starts(starts, numbers);
    (needed > MAX_BYTES).then(|| {
        format!(
            "the starts need about {} GB of memory, and at most {} are allowed: split the run into several files",
            gigabytes(needed),
            gigabytes(MAX_BYTES)
        )
    })
}

/// Why one of several parts of a run needs too much memory. Each start consists of `numbers` coordinates and parameters, and gives a state of a
/// dimension at each of the times.
pub(super) fn fault_of_states(
    (starts, numbers): (usize, usize),
    (times, dimension): (usize, usize),
    parts: usize,
) -> Option<String> {
    let fixed = of_starts(starts, numbers);
    let states = of_states(starts, times, dimension);
    let needed = fixed + states.div_ceil(parts as u128);
    (needed > MAX_BYTES).then(|| {
        let enough = states.div_ceil(MAX_BYTES.saturating_sub(fixed).max(1));
        format!(
            "the run needs about {} GB of memory, and at most {} are allowed: give fewer `times`, or run at least {enough} parts, with `--shard 0/{enough}` and so on",
            gigabytes(needed),
            gigabytes(MAX_BYTES)
        )
    })
}

/// How many states of a section a run may keep, beside its starts.
pub(super) fn most_states((starts, numbers): (usize, usize), dimension: usize) -> usize {
    let left = MAX_BYTES.saturating_sub(of_starts(starts, numbers));
    usize::try_from(left / of_states(1, 1, dimension)).unwrap_or(usize::MAX)
}

/// Why a section of several trajectories needs too much memory.
pub(super) fn fault_of_section(most: usize, trajectories: usize) -> String {
    let parts = match trajectories {
        0 | 1 => "",
        _ => ", or run parts, with `--shard 0/2` and so on",
    };
    format!(
        "the section has more than {most} states, and {} GB of memory are allowed: give an `end` nearer to the start{parts}",
        gigabytes(MAX_BYTES)
    )
}

/// Starts, last states, statistics and the arrays of the output: measured were 532 bytes with one degree of freedom, 950 with
/// ten, and 765 with one and a parameter that varies.
fn of_starts(starts: usize, numbers: usize) -> u128 {
    starts as u128 * (650 + 25 * numbers as u128)
}

/// Time, positions, momenta and the error of the energy, and an array of the output with its bytes: measured were 57 bytes with
/// one degree of freedom and 383 with ten. A section with one degree of freedom took 49 bytes in a `.npz`, 32 in a table.
fn of_states(starts: usize, times: usize, dimension: usize) -> u128 {
    starts as u128 * times as u128 * (16 + 40 * dimension as u128)
}

fn gigabytes(bytes: u128) -> String {
    format!("{}", (bytes as f64 / 1e8).ceil() / 10.0)
}

#[cfg(test)]
mod tests {
    use super::{fault_of_section, fault_of_states, most_states};

    /// 56 bytes for a state of one degree of freedom, and none if the starts take all.
    #[test]
    fn sections_are_bounded() {
        let most = most_states((1000, 2), 1);
        assert!((71_000_000..4_000_000_000 / 56).contains(&most), "{most}");
        assert_eq!(most_states((1 << 22, 1000), 1), 0);
        let told = |trajectories| fault_of_section(most, trajectories);
        assert!(told(1).ends_with("4 GB of memory are allowed: give an `end` nearer to the start"));
        assert!(told(2).ends_with(", or run parts, with `--shard 0/2` and so on"));
    }

    /// The number of parts in the message is the least one that is allowed.
    #[test]
    fn the_advice_is_followed_by_success() {
        let fault = |parts| fault_of_states((1000, 2), (4_000_000, 1), parts);
        let told = fault(1).expect("too much");
        assert!(
            told.contains("about 224.1 GB of memory, and at most 4 are"),
            "{told}"
        );
        assert!(
            told.contains("at least 57 parts, with `--shard 0/57`"),
            "{told}"
        );
        assert!(fault(56).is_some() && fault(57).is_none());
    }
}
