//! Reproducible random numbers, identical on every machine.

use symplectic::Scalar;

/// Word `number` of the sequence of a seed, by SplitMix64 (Steele, Lea & Flood, *Fast splittable pseudorandom number
/// generators*, OOPSLA 2014); its state is a counter.
fn word(seed: u64, number: u64) -> u64 {
    let state = seed.wrapping_add(number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let word = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ (word >> 31)
}

/// A 53-bit number in (0, 1].
fn unit(seed: u64, number: u64) -> f64 {
    ((word(seed, number) >> 11) + 1) as f64 * (f64::EPSILON / 2.0)
}

/// Draw number `draw` from the uniform distribution on (0, 1].
pub(super) fn uniform(seed: u64, draw: u64) -> f64 {
    unit(seed, 2 * draw)
}

/// No draw of [`normal`] is larger: √(−2 ln 2⁻⁵³) < 8.6.
pub(super) const MAX_DEVIATIONS: f64 = 9.0;

/// Draw number `draw` from the standard normal distribution (Box–Muller).
pub(super) fn normal(seed: u64, draw: u64) -> f64 {
    let radius = Scalar::sqrt(-2.0 * Scalar::ln(unit(seed, 2 * draw)));
    radius * Scalar::cos(std::f64::consts::TAU * unit(seed, 2 * draw + 1))
}

#[cfg(test)]
mod tests {
    use super::word;

    /// The first words of Vigna's `splitmix64.c` with the seed 1234567.
    #[test]
    fn the_words_are_those_of_the_source() {
        let expected = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        assert_eq!(
            [0, 1, 2, 3, 4].map(|number| word(1_234_567, number)),
            expected
        );
    }
}
