//! Counter-based random numbers.

use symplectic_core::Scalar;

/// Philox-4×32-10 (Salmon, Moraes, Dror & Shaw, *Parallel random numbers: as easy as 1, 2, 3*, SC 2011): maps a counter and a key to four
/// random words.
const fn philox(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    let mut round = 0;
    while round < 10 {
        let first = 0xD251_1F53 * counter[0] as u64;
        let second = 0xCD9E_8D57 * counter[2] as u64;
        counter = [
            (second >> 32) as u32 ^ counter[1] ^ key[0],
            second as u32,
            (first >> 32) as u32 ^ counter[3] ^ key[1],
            first as u32,
        ];
        key = [
            key[0].wrapping_add(0x9E37_79B9),
            key[1].wrapping_add(0xBB67_AE85),
        ];
        round += 1;
    }
    counter
}

/// Two independent standard normal numbers, by the Box–Muller method: pair number `pair` of draw number `draw`.
pub(super) fn normal_pair(seed: u64, draw: u64, pair: u64) -> [f64; 2] {
    let halves = |word: u64| [word as u32, (word >> 32) as u32];
    let ([a, b], [c, d]) = (halves(draw), halves(pair));
    let [a, b, c, d] = philox([a, b, c, d], halves(seed)).map(u64::from);
    // A number in (0, 1] with 53 bits.
    let unit = |high: u64, low: u64| {
        let bits = ((high << 32) | low) >> 11;
        (bits + 1) as f64 * f64::EPSILON / 2.0
    };
    let radius = Scalar::sqrt(-2.0 * Scalar::ln(unit(a, b)));
    let (sine, cosine) = Scalar::sin_cos(core::f64::consts::TAU * unit(c, d));
    [radius * cosine, radius * sine]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The known-answer tests of the authors' library Random123 (`kat_vectors`).
    #[test]
    fn the_words_are_those_of_the_authors() {
        let ones = u32::MAX;
        assert_eq!(
            philox([0; 4], [0; 2]),
            [0x6627_E8D5, 0xE169_C58D, 0xBC57_AC4C, 0x9B00_DBD8]
        );
        assert_eq!(
            philox([ones; 4], [ones; 2]),
            [0x408F_276D, 0x41C8_3B0E, 0xA20B_C7C6, 0x6D54_51FD]
        );
        let digits_of_pi = [0x243F_6A88, 0x85A3_08D3, 0x1319_8A2E, 0x0370_7344];
        assert_eq!(
            philox(digits_of_pi, [0xA409_3822, 0x299F_31D0]),
            [0xD16C_FE09, 0x94FD_CCEB, 0x5001_E420, 0x2412_6EA1]
        );
    }
}
