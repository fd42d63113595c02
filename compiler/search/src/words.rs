//! Coefficients of words in a product of exponentials, in doubles, with their derivatives.
//!
//! A factor with the argument `x` is `exp(x l)` for a letter `l`, or `exp(Σ_l x^{|l|} l)` over all letters for a basic method, where `|l|` is
//! the degree of `l` (see [`symplectic_compiler::certify`]). The coefficient of a block `u` of `m` letters in it is `x^{|u|}/m!`. The
//! coefficients of all beginnings of words in the products of the first `0, 1, …` factors, and of all ends in the products of the last ones,
//! are computed once. Together they give the derivative with respect to the argument of each factor.

use std::collections::HashMap;

use nalgebra::DMatrix;
use symplectic_compiler::certify::{Alphabet, DRIFT, KICK, Word};

/// The exponent of a factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Exponent {
    /// One letter.
    Letter(u8),
    /// All letters: a basic method.
    Base,
    /// `[B, [A, B]] = 2BAB − ABB − BBA`, of a gradient kick.
    Gradient,
}

/// The factor of three letters in the exponent of a gradient kick.
fn of_gradient(three: &[u8]) -> f64 {
    match *three {
        [KICK, DRIFT, KICK] => 2.0,
        [DRIFT, KICK, KICK] | [KICK, KICK, DRIFT] => -1.0,
        _ => 0.0,
    }
}

/// A set of words, closed under taking away the last letter, or the first one.
#[derive(Debug, Clone)]
struct Closed {
    /// For each word: its blocks at the open end, shortest first. The empty word comes first and has none.
    blocks: Vec<Vec<Block>>,
    /// The number of each word.
    index: HashMap<Word, usize>,
}

/// A word as a shorter one and a block.
#[derive(Debug, Clone, Copy)]
struct Block {
    /// The number of the word without the block.
    rest: usize,
    /// The letter, if all letters of the block are equal.
    letter: Option<u8>,
    length: usize,
    degree: usize,
    /// The factor of its threes of letters in a power of the exponent of a gradient kick.
    gradient: f64,
}

impl Closed {
    /// The beginnings of words, or their ends, from short to long.
    fn of(words: &[Word], alphabet: &Alphabet, beginnings: bool) -> Self {
        let mut all: Vec<Word> = words
            .iter()
            .flat_map(|word| {
                (0..=word.len()).map(move |k| match beginnings {
                    true => word[..k].to_vec(),
                    false => word[k..].to_vec(),
                })
            })
            .collect();
        all.sort_by(|x, y| x.len().cmp(&y.len()).then_with(|| x.cmp(y)));
        all.dedup();
        let index: HashMap<Word, usize> = all.iter().cloned().zip(0..).collect();
        let block = |word: &Word, length: usize| {
            let (rest, block) = match beginnings {
                true => word.split_at(word.len() - length),
                false => {
                    let (block, rest) = word.split_at(length);
                    (rest, block)
                }
            };
            Block {
                rest: index[rest],
                letter: block.iter().all(|l| *l == block[0]).then_some(block[0]),
                length,
                degree: alphabet.degree(block),
                gradient: block.chunks(3).map(of_gradient).product(),
            }
        };
        let blocks = all
            .iter()
            .map(|word| (1..=word.len()).map(|n| block(word, n)).collect())
            .collect();
        Closed { blocks, index }
    }

    fn len(&self) -> usize {
        self.blocks.len()
    }

    /// The coefficients of all words in the product with one more factor.
    fn multiply(&self, values: &mut [f64], exponent: Exponent, powers: &Powers) {
        // Long words first: the shorter ones do not include the factor yet.
        for word in (1..self.len()).rev() {
            let mut sum = values[word];
            for block in &self.blocks[word] {
                match exponent {
                    Exponent::Letter(own) if block.letter != Some(own) => break,
                    Exponent::Letter(_) => {
                        sum += values[block.rest] * powers.value(block.length, block.length)
                    }
                    Exponent::Base => {
                        sum += values[block.rest] * powers.value(block.degree, block.length);
                    }
                    Exponent::Gradient if block.gradient != 0.0 => {
                        let power = block.length / 3;
                        sum += values[block.rest] * block.gradient * powers.value(power, power);
                    }
                    Exponent::Gradient => {}
                }
            }
            values[word] = sum;
        }
    }
}

/// `x^n` and `1/m!`.
struct Powers {
    powers: Vec<f64>,
}

impl Powers {
    fn new(x: f64, highest: usize) -> Self {
        let mut powers = vec![1.0];
        for n in 0..highest {
            powers.push(powers[n] * x);
        }
        Powers { powers }
    }

    /// `x^n/m!`
    fn value(&self, n: usize, m: usize) -> f64 {
        self.powers[n] * INVERSE_FACTORIALS[m]
    }

    /// `n x^{n−1}/m!`
    fn slope(&self, n: usize, m: usize) -> f64 {
        n as f64 * self.powers[n - 1] * INVERSE_FACTORIALS[m]
    }
}

/// The most letters of a word.
pub(crate) const LONGEST: usize = 24;

const INVERSE_FACTORIALS: [f64; LONGEST + 1] = {
    let mut all = [1.0; LONGEST + 1];
    let mut n = 1;
    while n <= LONGEST {
        all[n] = all[n - 1] / n as f64;
        n += 1;
    }
    all
};

/// The words whose coefficients are wanted.
#[derive(Debug, Clone)]
pub(crate) struct Words {
    beginnings: Closed,
    ends: Closed,
    /// For each word its beginnings and its ends, by the number of letters before the cut.
    cuts: Vec<Cuts>,
    highest: usize,
}

#[derive(Debug, Clone)]
struct Cuts {
    word: Word,
    beginnings: Vec<usize>,
    ends: Vec<usize>,
    /// The degree of the first letters.
    degrees: Vec<usize>,
}

impl Words {
    pub(crate) fn new(words: &[Word], alphabet: &Alphabet) -> Self {
        let beginnings = Closed::of(words, alphabet, true);
        let ends = Closed::of(words, alphabet, false);
        let cuts = |word: &Word| Cuts {
            word: word.clone(),
            beginnings: (0..=word.len())
                .map(|k| beginnings.index[&word[..k]])
                .collect(),
            ends: (0..=word.len()).map(|k| ends.index[&word[k..]]).collect(),
            degrees: (0..=word.len())
                .map(|k| alphabet.degree(&word[..k]))
                .collect(),
        };
        Words {
            cuts: words.iter().map(cuts).collect(),
            highest: words
                .iter()
                .map(|word| alphabet.degree(word))
                .max()
                .unwrap_or(0),
            beginnings,
            ends,
        }
    }

    fn powers(&self, arguments: &[f64]) -> Vec<Powers> {
        let powers = |x: &f64| Powers::new(*x, self.highest);
        arguments.iter().map(powers).collect()
    }

    /// The coefficients in the product of factors.
    pub(crate) fn values(&self, exponents: &[Exponent], arguments: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; self.beginnings.len()];
        values[0] = 1.0;
        for (exponent, powers) in exponents.iter().zip(self.powers(arguments)) {
            self.beginnings.multiply(&mut values, *exponent, &powers);
        }
        let last = |cuts: &Cuts| cuts.beginnings.last().map_or(1.0, |&at| values[at]);
        self.cuts.iter().map(last).collect()
    }

    /// The coefficients, and their derivatives with respect to the arguments of the factors: one row a word, one column a factor.
    pub(crate) fn derivatives(
        &self,
        exponents: &[Exponent],
        arguments: &[f64],
    ) -> (Vec<f64>, DMatrix<f64>) {
        let powers = self.powers(arguments);
        let mut values = vec![0.0; self.beginnings.len()];
        values[0] = 1.0;
        let mut before = Vec::with_capacity(exponents.len());
        for (exponent, powers) in exponents.iter().zip(&powers) {
            before.push(values.clone());
            self.beginnings.multiply(&mut values, *exponent, powers);
        }
        let mut derivatives = DMatrix::zeros(self.cuts.len(), exponents.len());
        let mut after = vec![0.0; self.ends.len()];
        after[0] = 1.0;
        for column in (0..exponents.len()).rev() {
            let (before, powers) = (&before[column], &powers[column]);
            match exponents[column] {
                // d/dx exp(x l) = l exp(x l)
                Exponent::Letter(own) => {
                    self.ends.multiply(&mut after, exponents[column], powers);
                    for (row, cuts) in self.cuts.iter().enumerate() {
                        let mut sum = 0.0;
                        for (k, letter) in cuts.word.iter().enumerate() {
                            if *letter == own {
                                sum += before[cuts.beginnings[k]] * after[cuts.ends[k + 1]];
                            }
                        }
                        derivatives[(row, column)] = sum;
                    }
                }
                // The same with three letters.
                Exponent::Gradient => {
                    self.ends.multiply(&mut after, Exponent::Gradient, powers);
                    for (row, cuts) in self.cuts.iter().enumerate() {
                        let threes = cuts.word.windows(3).enumerate();
                        derivatives[(row, column)] = threes
                            .map(|(k, three)| {
                                before[cuts.beginnings[k]]
                                    * of_gradient(three)
                                    * after[cuts.ends[k + 3]]
                            })
                            .sum();
                    }
                }
                Exponent::Base => {
                    for (row, cuts) in self.cuts.iter().enumerate() {
                        let mut sum = 0.0;
                        for start in 0..cuts.word.len() {
                            for end in start + 1..=cuts.word.len() {
                                let degree = cuts.degrees[end] - cuts.degrees[start];
                                sum += before[cuts.beginnings[start]]
                                    * powers.slope(degree, end - start)
                                    * after[cuts.ends[end]];
                            }
                        }
                        derivatives[(row, column)] = sum;
                    }
                    self.ends.multiply(&mut after, exponents[column], powers);
                }
            }
        }
        let last = |cuts: &Cuts| cuts.beginnings.last().map_or(1.0, |&at| values[at]);
        (self.cuts.iter().map(last).collect(), derivatives)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `exp(k₁B) exp(d₁A) exp(k₂B)`: `[AB] = d₁k₂`, `[AAB] = d₁²k₂/2`, `[BAB] = k₁d₁k₂`.
    #[test]
    fn coefficients_of_three_factors_are_those_found_by_hand() {
        let words = [vec![0, 1], vec![0, 0, 1], vec![1, 0, 1]];
        let words = Words::new(&words, &Alphabet::splitting());
        let exponents = [1, 0, 1].map(Exponent::Letter);
        let (k, d, l) = (0.3, 0.7, -0.2);
        let (values, slopes) = words.derivatives(&exponents, &[k, d, l]);
        assert_eq!(values, [d * l, d * d * l / 2.0, k * d * l]);
        let expected = [
            [0.0, l, d],
            [0.0, d * l, d * d / 2.0],
            [d * l, k * l, k * d],
        ];
        for (row, expected) in expected.iter().enumerate() {
            for (column, expected) in expected.iter().enumerate() {
                assert!((slopes[(row, column)] - expected).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn derivatives_for_gradient_kicks_are_differences_of_values() {
        let alphabet = Alphabet::splitting();
        let words: Vec<Word> = (1..=6).flat_map(|degree| alphabet.words(degree)).collect();
        let words = Words::new(&words, &alphabet);
        let exponents = [
            Exponent::Letter(1),
            Exponent::Gradient,
            Exponent::Letter(0),
            Exponent::Gradient,
        ];
        let at = [0.4, -0.3, 0.5, 0.2];
        let (_, slopes) = words.derivatives(&exponents, &at);
        for column in 0..4 {
            let moved = |by: f64| {
                let mut moved = at;
                moved[column] += by;
                words.values(&exponents, &moved)
            };
            let (high, low) = (moved(1e-5), moved(-1e-5));
            for row in 0..slopes.nrows() {
                let difference = (high[row] - low[row]) / 2e-5;
                assert!((difference - slopes[(row, column)]).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn derivatives_for_a_base_are_differences_of_values() {
        let alphabet = Alphabet::symmetric_base(7);
        let words: Vec<Word> = (1..=7).flat_map(|degree| alphabet.lyndon(degree)).collect();
        let words = Words::new(&words, &alphabet);
        let (exponents, at) = ([Exponent::Base; 4], [0.4, -0.3, 0.5, 0.4]);
        let (_, slopes) = words.derivatives(&exponents, &at);
        for column in 0..4 {
            let moved = |by: f64| {
                let mut moved = at;
                moved[column] += by;
                words.values(&exponents, &moved)
            };
            let (high, low) = (moved(1e-5), moved(-1e-5));
            for row in 0..slopes.nrows() {
                let difference = (high[row] - low[row]) / 2e-5;
                assert!((difference - slopes[(row, column)]).abs() < 1e-8);
            }
        }
    }
}
