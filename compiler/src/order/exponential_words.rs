//! Coefficients of words in the product of the exponentials of a splitting, exactly.
//!
//! With the letters of [`crate::certify`], `A` for drifts and `B` for kicks, a step that begins with the kick `k₁` acts
//! on functions by `S = exp(k₁B) exp(d₁A) exp(k₂B) ⋯`. The coefficient of a word in the product of the first `i`
//! factors is a sum over the number `n` of letters at its end that come from the last factor,
//!
//! ```text
//! [w]ᵢ = Σ_n [w without its last n letters]ᵢ₋₁ xᵢⁿ/n!,
//! ```
//!
//! with only `n = 0` if the last letter differs from that of the factor. The coefficients of the prefixes of a word are stored for
//! other words.

use std::collections::HashMap;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use crate::algebra::Field;
use crate::certify::Word;

/// The product of the exponentials of letters.
pub(super) struct Product<'a, F: Field> {
    field: &'a F,
    factors: Vec<Factor<F>>,
    /// The coefficients of words in the products of the first 0, 1, … factors.
    known: HashMap<Word, Vec<F::Element>>,
}

/// The exponential of a letter.
struct Factor<F: Field> {
    letter: u8,
    /// `x, x²/2, x³/6, …`
    powers: Vec<F::Element>,
}

impl<'a, F: Field> Product<'a, F> {
    /// The product of `exp(xᵢ lᵢ)` for letters `lᵢ` and numbers `xᵢ`.
    pub fn new(field: &'a F, letters: Vec<(u8, F::Element)>) -> Self {
        let one = field.rational(&BigRational::one());
        let empty = vec![one; letters.len() + 1];
        let factor = |(letter, x)| Factor {
            letter,
            powers: vec![x],
        };
        Product {
            field,
            factors: letters.into_iter().map(factor).collect(),
            known: HashMap::from([(Word::new(), empty)]),
        }
    }

    /// The field of the numbers.
    pub fn field(&self) -> &'a F {
        self.field
    }

    /// The approximate number of products computed so far.
    pub fn cost(&self) -> usize {
        self.known.len() * self.factors.len()
    }

    /// The coefficient of a word.
    pub fn coefficient(&mut self, word: &[u8]) -> F::Element {
        for length in 1..=word.len() {
            if !self.known.contains_key(&word[..length]) {
                let coefficients = self.extend(&word[..length]);
                self.known.insert(word[..length].to_vec(), coefficients);
            }
        }
        let zero = || self.field.rational(&BigRational::default());
        let last = self.known.get(word).and_then(|all| all.last());
        last.cloned().unwrap_or_else(zero)
    }

    /// The coefficients of a word whose proper prefixes are known.
    fn extend(&mut self, word: &[u8]) -> Vec<F::Element> {
        let zero = self.field.rational(&BigRational::default());
        let Some(letter) = word.last() else {
            return Vec::new();
        };
        let run = word.iter().rev().take_while(|other| *other == letter);
        // The word without its last letter, its last two letters, …
        let prefixes = (1..=run.count()).map(|n| &self.known[&word[..word.len() - n]]);
        let prefixes: Vec<&Vec<F::Element>> = prefixes.collect();
        let mut sum = zero.clone();
        let mut all = vec![zero.clone()];
        for (index, factor) in self.factors.iter_mut().enumerate() {
            if factor.letter == *letter {
                for (n, prefix) in prefixes.iter().enumerate() {
                    if prefix[index] != zero {
                        let power = factor.power(self.field, n);
                        let term = self.field.multiply(&prefix[index], power);
                        sum = self.field.add(&sum, &term);
                    }
                }
            }
            all.push(sum.clone());
        }
        all
    }
}

impl<F: Field> Factor<F> {
    /// `xⁿ⁺¹/(n + 1)!`
    fn power(&mut self, field: &F, n: usize) -> &F::Element {
        while self.powers.len() <= n {
            let next = BigInt::from(self.powers.len() + 1);
            let inverse = field.rational(&BigRational::new(BigInt::one(), next));
            let last = &self.powers[self.powers.len() - 1];
            let power = field.multiply(&field.multiply(last, &self.powers[0]), &inverse);
            self.powers.push(power);
        }
        &self.powers[n]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Rationals;
    use crate::arithmetic::rational::ratio;

    /// `exp(k₁B) exp(d₁A) exp(k₂B)`, by hand: `[AB] = d₁k₂`, `[AAB] = d₁²k₂/2`, `[ABB] = d₁k₂²/2`.
    #[test]
    fn coefficients_are_those_found_by_hand() {
        let letters = vec![(1, ratio(1, 3)), (0, ratio(5, 7)), (1, ratio(2, 11))];
        let mut product = Product::new(&Rationals, letters);
        for (word, value) in [
            (vec![], ratio(1, 1)),
            (vec![0], ratio(5, 7)),
            (vec![1], ratio(17, 33)),
            (vec![0, 1], ratio(10, 77)),
            (vec![1, 0], ratio(5, 21)),
            (vec![0, 0, 1], ratio(25, 539)),
            (vec![0, 1, 1], ratio(10, 847)),
            (vec![1, 1, 1], ratio(17 * 17 * 17, 6 * 33 * 33 * 33)),
            (vec![0, 1, 0], ratio(0, 1)),
        ] {
            assert_eq!(product.coefficient(&word), value, "{word:?}");
        }
    }
}
