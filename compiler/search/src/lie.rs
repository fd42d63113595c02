//! The free Lie algebra of two letters, in one degree, in doubles.

use std::collections::BTreeMap;

use symplectic_compiler::certify::{Alphabet, Word, is_lyndon};

/// A combination of words.
pub(crate) type Combination = BTreeMap<Word, f64>;

/// A basis of the Lie elements of a degree: the brackets of the Lyndon words.
pub(crate) fn basis(degree: usize) -> Vec<Combination> {
    let words = Alphabet::splitting().lyndon(degree);
    words.iter().map(|word| bracket_of(word)).collect()
}

/// `[x, y] = xy − yx`
pub(crate) fn bracket(x: &Combination, y: &Combination) -> Combination {
    let mut sum = Combination::new();
    for (left, a) in x {
        for (right, b) in y {
            *sum.entry([&left[..], right].concat()).or_default() += a * b;
            *sum.entry([&right[..], left].concat()).or_default() -= a * b;
        }
    }
    sum.retain(|_, factor| *factor != 0.0);
    sum
}

/// The bracket of a Lyndon word `uv` with the longest Lyndon word `v` that is a proper end of it: `[u, v]`.
fn bracket_of(word: &[u8]) -> Combination {
    if word.len() <= 1 {
        return Combination::from([(word.to_vec(), 1.0)]);
    }
    let cut = (1..word.len()).find(|&start| is_lyndon(&word[start..]));
    let (left, right) = word.split_at(cut.unwrap_or(1));
    bracket(&bracket_of(left), &bracket_of(right))
}

/// The shuffle product: all ways to merge two words.
pub(crate) fn shuffle(x: &Combination, y: &Combination) -> Combination {
    let mut sum = Combination::new();
    for (left, a) in x {
        for (right, b) in y {
            merge(left, right, Word::new(), a * b, &mut sum);
        }
    }
    sum
}

/// The coefficient of a word in a logarithm, as a combination of coefficients of words in the series itself:
/// `Σ_k (−1)^{k−1}/k` over all ways to cut the word into `k` parts, with the shuffle of the parts.
pub(crate) fn logarithm(word: &[u8]) -> Combination {
    // `powers[end]`: the sum over all ways to cut the first letters into `k` parts.
    let empty = Combination::from([(Word::new(), 1.0)]);
    let mut powers = vec![Combination::new(); word.len() + 1];
    powers[0] = empty;
    let mut sum = Combination::new();
    for k in 1..=word.len() {
        let mut next = vec![Combination::new(); word.len() + 1];
        for end in k..=word.len() {
            for start in k - 1..end {
                let part = Combination::from([(word[start..end].to_vec(), 1.0)]);
                for (merged, factor) in shuffle(&powers[start], &part) {
                    *next[end].entry(merged).or_default() += factor;
                }
            }
        }
        let factor = if k % 2 == 1 { 1.0 } else { -1.0 } / k as f64;
        for (merged, count) in &next[word.len()] {
            *sum.entry(merged.clone()).or_default() += factor * count;
        }
        powers = next;
    }
    sum.retain(|_, factor| factor.abs() > 1e-12);
    sum
}

fn merge(left: &[u8], right: &[u8], so_far: Word, factor: f64, sum: &mut Combination) {
    let (Some((l, left_rest)), Some((r, right_rest))) = (left.split_first(), right.split_first())
    else {
        let word = [&so_far[..], left, right].concat();
        *sum.entry(word).or_default() += factor;
        return;
    };
    let with = |letter: &u8| {
        let mut word = so_far.clone();
        word.push(*letter);
        word
    };
    merge(left_rest, right, with(l), factor, sum);
    merge(left, right_rest, with(r), factor, sum);
}

/// `Σ_w x_w y_w`
pub(crate) fn pair(x: &Combination, y: &Combination) -> f64 {
    x.iter()
        .filter_map(|(word, a)| Some(a * y.get(word)?))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_have_coefficient_one_at_their_lyndon_word() {
        for (element, word) in basis(6).iter().zip(Alphabet::splitting().lyndon(6)) {
            assert_eq!(element.get(&word), Some(&1.0));
        }
    }

    /// `log(exp(A) exp(B)) = A + B + [A, B]/2 + [A, [A, B]]/12 + …`
    #[test]
    fn logarithms_are_those_of_baker_campbell_and_hausdorff() {
        use crate::words::{Exponent, Words};
        for (word, expected) in [
            (vec![0, 1], 0.5),
            (vec![1, 0], -0.5),
            (vec![0, 0, 1], 1.0 / 12.0),
            (vec![0, 1, 0], -1.0 / 6.0),
        ] {
            let combination = logarithm(&word);
            let words: Vec<Word> = combination.keys().cloned().collect();
            let exponents = [Exponent::Letter(0), Exponent::Letter(1)];
            let values = Words::new(&words, &Alphabet::splitting()).values(&exponents, &[1.0, 1.0]);
            let found: f64 = combination
                .values()
                .zip(values)
                .map(|(factor, value)| factor * value)
                .sum();
            assert!((found - expected).abs() < 1e-14, "{word:?}: {found}");
        }
    }

    #[test]
    fn lie_elements_are_orthogonal_to_shuffles() {
        let letter = |l: u8| Combination::from([(vec![l], 1.0)]);
        let shuffled = shuffle(&shuffle(&letter(0), &letter(1)), &letter(0));
        for element in basis(3) {
            assert_eq!(pair(&element, &shuffled), 0.0);
        }
    }
}
