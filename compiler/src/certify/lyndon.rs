//! Words over a graded alphabet, including Lyndon words.

/// A word: indices of letters.
pub type Word = Vec<u8>;

/// The letters with their degrees in the step size.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Alphabet {
    names: Vec<String>,
    degrees: Vec<usize>,
}

/// The letter of the drift `q += d h ∂T/∂p`.
pub const DRIFT: u8 = 0;
/// The letter of the kick `p -= k h ∂U/∂q`.
pub const KICK: u8 = 1;

impl Alphabet {
    /// `A`, the Lie derivative of the drift, and `B`, that of the kick, both of degree 1.
    pub fn splitting() -> Self {
        Alphabet {
            names: vec!["A".to_owned(), "B".to_owned()],
            degrees: vec![1, 1],
        }
    }

    /// `E1, E3, E5, …` up to a degree: the terms of the logarithm of a symmetric basic method.
    pub fn symmetric_base(degree: usize) -> Self {
        let degrees: Vec<usize> = (1..=degree).step_by(2).collect();
        Alphabet {
            names: degrees.iter().map(|n| format!("E{n}")).collect(),
            degrees,
        }
    }

    /// Letters `E1, E2, …` of these degrees.
    pub(crate) fn of_degrees(degrees: Vec<usize>) -> Self {
        Alphabet {
            names: (1..=degrees.len()).map(|n| format!("E{n}")).collect(),
            degrees,
        }
    }

    /// The degree of a letter.
    pub fn degree_of(&self, letter: u8) -> usize {
        self.degrees[usize::from(letter)]
    }

    /// The degree of a word.
    pub fn degree(&self, word: &[u8]) -> usize {
        word.iter().map(|&letter| self.degree_of(letter)).sum()
    }

    /// A word as text: `AAB`, `E1E1E3`.
    pub fn text(&self, word: &[u8]) -> String {
        let names = word.iter().map(|&letter| &*self.names[usize::from(letter)]);
        names.collect()
    }

    /// All words of a degree, in lexicographic order.
    pub fn words(&self, degree: usize) -> Vec<Word> {
        if degree == 0 {
            return vec![Word::new()];
        }
        let mut words = Vec::new();
        for (letter, own) in (0u8..).zip(&self.degrees) {
            if *own <= degree {
                for rest in self.words(degree - own) {
                    words.push([vec![letter], rest].concat());
                }
            }
        }
        words
    }

    /// The Lyndon words of a degree, in lexicographic order.
    pub fn lyndon(&self, degree: usize) -> Vec<Word> {
        let mut words = self.words(degree);
        words.retain(|word| is_lyndon(word));
        words
    }
}

/// The words with these numbers of drifts and kicks, in lexicographic order.
pub fn split_words(drifts: usize, kicks: usize) -> Vec<Word> {
    if drifts + kicks == 0 {
        return vec![Word::new()];
    }
    let mut found = Vec::new();
    let mut begin_with = |letter: u8, rest: Vec<Word>| {
        found.extend(rest.into_iter().map(|rest| [vec![letter], rest].concat()));
    };
    if drifts > 0 {
        begin_with(DRIFT, split_words(drifts - 1, kicks));
    }
    if kicks > 0 {
        begin_with(KICK, split_words(drifts, kicks - 1));
    }
    found
}

/// The Lyndon words with these numbers of drifts and kicks, in lexicographic order.
pub fn split_lyndon(drifts: usize, kicks: usize) -> Vec<Word> {
    let mut words = split_words(drifts, kicks);
    words.retain(|word| is_lyndon(word));
    words
}

/// Whether a word is smaller than each of its proper right factors.
pub fn is_lyndon(word: &[u8]) -> bool {
    !word.is_empty() && (1..word.len()).all(|start| word < &word[start..])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Dimensions of the free Lie algebras: Witt's formula for two letters of degree 1; 1, 1, 2, 4, 8 for the
    /// odd letters in odd degrees (McLachlan & Quispel 2002).
    #[test]
    fn numbers_of_lyndon_words_are_dimensions_of_the_free_lie_algebra() {
        let count = |alphabet: &Alphabet, degree| alphabet.lyndon(degree).len();
        let splitting = Alphabet::splitting();
        let counts: Vec<usize> = (1..=10).map(|n| count(&splitting, n)).collect();
        assert_eq!(counts, [2, 1, 2, 3, 6, 9, 18, 30, 56, 99]);
        let base = Alphabet::symmetric_base(9);
        let counts: Vec<usize> = (1..=9).step_by(2).map(|n| count(&base, n)).collect();
        assert_eq!(counts, [1, 1, 2, 4, 8]);
        let texts: Vec<String> = base.lyndon(7).iter().map(|w| base.text(w)).collect();
        assert_eq!(texts, ["E1E1E1E1E3", "E1E1E5", "E1E3E3", "E7"]);
    }
}
