//! Order conditions for kinetic energies that are quadratic in the momenta.
//!
//! The Lie derivatives of `T` and `U` correspond to `T` and `U` with the Poisson bracket. If `T` has degree 2 and `U` degree
//! 0, a Lie element with `a` letters `A` and `b` letters `B` has degree `a − b + 1` in `p`: each of the `a + b − 1` brackets
//! takes one derivative with respect to `p`. So the elements with `b − a ≥ 2` vanish, and with them the ideal `J` that they
//! generate in the free Lie algebra `L` (McLachlan 1995; Blanes & Moan 2002).
//!
//! Conditions in the quotient. Let `I` be the two-sided ideal of the free associative algebra `F = U(L)` that `J` generates;
//! as products of Lie derivatives its elements vanish too. Let `S = exp Z` with a Lie series `Z`, and let `Z ≡ A + B` modulo
//! `J` hold in the degrees below `n`. The part of degree `n` of `exp Z` is then, modulo `I`, that of `exp(A + B + Z_n)`. There
//! `Z_n` occurs without any other factor, so `S_n − exp(A + B)_n ≡ Z_n` (for `n = 1`, `Z₁ − A − B`). A linear form `φ` on
//! `F_n` that vanishes on `I_n` has therefore the same value for both sides. Let the restrictions of such forms to `L_n` be a
//! basis of the dual of `L_n/(L_n ∩ I_n)`. These forms are a sufficient set of conditions of degree `n`: if all are satisfied,
//! `Z_n` lies in `I`. No condition is superfluous, because `F/I = U(L/J)`, and `L ∩ I = J` by the theorem of Poincaré,
//! Birkhoff and Witt.
//!
//! `I` and `L` are graded by the numbers of both letters, so both are computed exactly, degree by degree.
//! The dimensions of `L_n/J_n` are 2, 1, 2, 2, 4, 5, 10, 14, 25, 39 (Blanes, Casas &
//! Murua 2008 list the same numbers).

use std::collections::BTreeMap;

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::lyndon::{DRIFT, KICK, Word, split_words};

/// A linear form on words, or an element of the free associative algebra.
pub type Combination = BTreeMap<Word, BigRational>;

/// Linear forms on the words with `a` drifts and `b` kicks: zero on the ideal, and a basis of the dual of the
/// quotient Lie algebra.
#[derive(Debug, Default)]
pub struct Quotient {
    lie: BTreeMap<(usize, usize), Vec<Combination>>,
    ideal: BTreeMap<(usize, usize), Vec<Combination>>,
}

impl Quotient {
    /// The forms of a degree.
    pub fn forms(&mut self, degree: usize) -> Vec<Combination> {
        let grades = (0..=degree).rev().map(|a| (a, degree - a));
        grades.flat_map(|grade| self.forms_of(grade)).collect()
    }

    fn forms_of(&mut self, grade: (usize, usize)) -> Vec<Combination> {
        if vanishes(grade) {
            return Vec::new();
        }
        let (ideal, lie) = (self.ideal(grade), self.lie(grade));
        // The ideal is spanned by rows e_p + Σ_c r_pc e_c with pivots p, so e_c − Σ_p r_pc e_p vanishes on it.
        let pivots: Vec<&Word> = ideal.iter().filter_map(first).collect();
        let mut forms: Vec<Combination> = split_words(grade.0, grade.1)
            .into_iter()
            .filter(|word| !pivots.contains(&word))
            .map(|word| {
                let mut form = Combination::new();
                for (pivot, row) in pivots.iter().zip(&ideal) {
                    if let Some(entry) = row.get(&word) {
                        form.insert((*pivot).clone(), -entry);
                    }
                }
                form.insert(word, BigRational::one());
                form
            })
            .collect();
        // Forms with few words first; a form is kept if its restriction to L is independent of the earlier ones.
        forms.sort_by_key(Combination::len);
        let mut restrictions: Vec<Combination> = Vec::new();
        forms.retain(|form| {
            let values = lie.iter().enumerate().map(|(index, element)| {
                let index = u32::try_from(index).unwrap_or(u32::MAX);
                (index.to_be_bytes().to_vec(), apply(form, element))
            });
            let values = values.filter(|(_, value)| !value.is_zero()).collect();
            insert(&mut restrictions, values)
        });
        forms
    }

    /// A basis of the free Lie algebra, in reduced echelon form: spanned by brackets with a letter.
    fn lie(&mut self, grade: (usize, usize)) -> Vec<Combination> {
        if let Some(known) = self.lie.get(&grade) {
            return known.clone();
        }
        let mut basis = Vec::new();
        if grade.0 + grade.1 == 1 {
            let letter = if grade.0 == 1 { DRIFT } else { KICK };
            basis.push(Combination::from([(vec![letter], BigRational::one())]));
        } else {
            for (letter, below) in predecessors(grade) {
                for element in self.lie(below) {
                    let mut bracket = multiplied(&element, |word| [&[letter], word].concat());
                    let right = multiplied(&element, |word| [word, &[letter]].concat());
                    subtract(&mut bracket, &BigRational::one(), &right);
                    insert(&mut basis, bracket);
                }
            }
        }
        self.lie.insert(grade, basis.clone());
        basis
    }

    /// A basis of the two-sided ideal, in reduced echelon form.
    fn ideal(&mut self, grade: (usize, usize)) -> Vec<Combination> {
        if let Some(known) = self.ideal.get(&grade) {
            return known.clone();
        }
        let mut basis = Vec::new();
        if vanishes(grade) {
            for element in self.lie(grade) {
                insert(&mut basis, element);
            }
        }
        for (letter, below) in predecessors(grade) {
            for element in self.ideal(below) {
                let left = multiplied(&element, |word| [&[letter], word].concat());
                insert(&mut basis, left);
                let right = multiplied(&element, |word| [word, &[letter]].concat());
                insert(&mut basis, right);
            }
        }
        self.ideal.insert(grade, basis.clone());
        basis
    }
}

/// Whether the degree in `p` of Lie elements of a grade would be negative.
fn vanishes((drifts, kicks): (usize, usize)) -> bool {
    kicks >= drifts + 2
}

fn predecessors((a, b): (usize, usize)) -> Vec<(u8, (usize, usize))> {
    let mut found = Vec::new();
    if a > 0 {
        found.push((DRIFT, (a - 1, b)));
    }
    if b > 0 {
        found.push((KICK, (a, b - 1)));
    }
    found
}

fn multiplied(element: &Combination, with: impl Fn(&[u8]) -> Word) -> Combination {
    let terms = element.iter();
    terms
        .map(|(word, factor)| (with(word), factor.clone()))
        .collect()
}

fn first(row: &Combination) -> Option<&Word> {
    row.keys().next()
}

fn apply(form: &Combination, element: &Combination) -> BigRational {
    let values = form
        .iter()
        .filter_map(|(word, x)| Some(x * element.get(word)?));
    values.fold(BigRational::zero(), |sum, value| sum + value)
}

/// `row −= factor·other`.
fn subtract(row: &mut Combination, factor: &BigRational, other: &Combination) {
    for (word, entry) in other {
        let value = row.entry(word.clone()).or_insert_with(BigRational::zero);
        *value -= factor * entry;
        if value.is_zero() {
            row.remove(word);
        }
    }
}

/// Adds a vector to a basis in reduced echelon form, unless it is linearly dependent on it. Returns whether it was
/// added.
fn insert(basis: &mut Vec<Combination>, mut vector: Combination) -> bool {
    for row in basis.iter() {
        let factor = first(row).and_then(|pivot| vector.get(pivot)).cloned();
        if let Some(factor) = factor {
            subtract(&mut vector, &factor, row);
        }
    }
    let Some((pivot, leading)) = vector.first_key_value() else {
        return false;
    };
    let (pivot, inverse) = (pivot.clone(), leading.recip());
    vector.values_mut().for_each(|entry| *entry *= &inverse);
    for row in basis.iter_mut() {
        if let Some(factor) = row.get(&pivot).cloned() {
            subtract(row, &factor, &vector);
        }
    }
    basis.push(vector);
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certify::lyndon::Alphabet;

    /// Blanes & Moan 2002, table 1: the order conditions of Runge–Kutta–Nyström splittings.
    #[test]
    fn the_quotient_has_the_known_dimensions() {
        let mut quotient = Quotient::default();
        let counts: Vec<usize> = (1..=10).map(|n| quotient.forms(n).len()).collect();
        assert_eq!(counts, [2, 1, 2, 2, 4, 5, 10, 14, 25, 39]);
    }

    #[test]
    fn the_free_lie_algebra_has_the_dimensions_of_the_lyndon_words() {
        let mut quotient = Quotient::default();
        for degree in 1..=8 {
            let grades = (0..=degree).map(|a| (a, degree - a));
            let dimension: usize = grades.map(|grade| quotient.lie(grade).len()).sum();
            assert_eq!(dimension, Alphabet::splitting().lyndon(degree).len());
        }
    }

    #[test]
    fn forms_vanish_on_the_ideal_and_only_there() {
        let mut quotient = Quotient::default();
        for grade in [(1, 2), (2, 3), (3, 3), (2, 4), (3, 4)] {
            let (forms, ideal) = (quotient.forms_of(grade), quotient.ideal(grade));
            let zero = |element: &Combination| forms.iter().all(|f| apply(f, element).is_zero());
            assert!(ideal.iter().all(zero), "{grade:?}");
            // The elements of L on which all forms vanish lie in the ideal: dimensions add up.
            let mut sum = ideal.clone();
            let added = quotient
                .lie(grade)
                .into_iter()
                .filter(|l| insert(&mut sum, l.clone()));
            assert_eq!(added.count(), forms.len(), "{grade:?}");
        }
        // [B, [B, [B, A]]] = 0 for quadratic T.
        assert!(quotient.forms_of((1, 3)).is_empty());
        assert_eq!(quotient.forms_of((2, 2)).len(), 1);
    }
}
