//! The conjugate order of a splitting: the order that it has after a change of variables.
//!
//! A kernel K has conjugate order `p` if some processor P exists for which `P K P⁻¹` has order `p` (Butcher & Sanz-Serna 1996, as effective
//! order). Energies and other quantities that do not grow are as accurate for K alone as for a method of order `p`.
//!
//! In the Lie algebra `L` of the class, graded by the degree in the step size, let `K = exp(X + k_n + O(h^{n+1}))` with `X = A + B`. With
//! `P = exp(π)` and a `π` of degree `n − 1` the first error of `P K P⁻¹` is `k_n + [π, X]`. So the order can be raised to `n` if and only if
//! `k_n` is in the image of `[·, X]: L_{n−1} → L_n`. That is a system of linear equations with rational coefficients: those without `π` are
//! conditions on the kernel, and the others determine `π`, since from the degree 2 on only zero commutes with `X`. In the degree 1 multiples of
//! `X` do; they leave solvability as it is, since a conjugation by `exp(cX)` maps the image onto itself. So the decision needs no search.
//!
//! Coordinates of `L_n` are the coefficients of the conditions of order `n`: those of Lyndon words, or forms that vanish on the relations of a
//! quadratic kinetic energy (see [`crate::certify::Conditions`]).

use std::fmt;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero as _};

use super::perturbed::{OfLetters, with_letters};
use crate::algebra::{Balls, Field, Zero};
use crate::arithmetic::rounding::Decimal;
use crate::certify::{Alphabet, Claim, Conditions, DRIFT, MAX_ORDER, Word};
use crate::evidence::{Evidence, evidence_text};
use crate::exact::Exact;
use crate::hamiltonian_class::HamiltonianClass;

/// The conjugate order of a method for a class of Hamiltonians.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConjugateOrder {
    /// The order that a change of variables gives the method.
    pub order: usize,
    /// The evidence that it has this order.
    pub evidence: Evidence,
    /// A violated condition on the kernel for the next order. If there is none, the order is a lower bound.
    pub refuted_by: Option<ViolatedKernel>,
    /// The processor `P = exp(π_{p−1}) ⋯ exp(π_2) exp(π_1)` up to the degree `p − 1`, as an operator: the terms of the `π` that are not zero.
    /// Another processor with the same order is this one, multiplied from the left by `exp(cA + cB)`.
    pub processor: Vec<LieTerm>,
}

/// A multiple of a bracket of `A`, the Lie derivative of the drift, and `B`, that of the kick.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LieTerm {
    /// The bracket: `[A,[A,B]]`.
    pub bracket: String,
    /// Its degree in the step size.
    pub degree: usize,
    /// Its factor.
    pub factor: Decimal,
}

/// A condition of a degree on the kernel that no processor can satisfy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ViolatedKernel {
    /// The degree in the step size.
    pub degree: usize,
    /// How many conditions of this degree there are on the kernel.
    pub conditions: usize,
    /// The value that should be zero.
    pub residual: Decimal,
}

impl fmt::Display for ConjugateOrder {
    /// `8, certified; not 9: 8 conditions of this degree on the kernel, one of which is violated by 1.2e-6`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let at_least = if self.refuted_by.is_none() {
            "≥ "
        } else {
            ""
        };
        let evidence = evidence_text(self.evidence);
        write!(f, "{at_least}{}, {evidence}", self.order)?;
        match &self.refuted_by {
            Some(ViolatedKernel {
                degree,
                conditions: 1,
                residual,
            }) => write!(
                f,
                "; not {degree}: the condition of this degree on the kernel is violated by {residual}"
            ),
            Some(ViolatedKernel {
                degree,
                conditions,
                residual,
            }) => write!(
                f,
                "; not {degree}: of {conditions} conditions of this degree on the kernel one is violated by {residual}"
            ),
            None => Ok(()),
        }
    }
}

/// Bits of the enclosures that decide what is not zero.
const BITS: u32 = 256;

/// The letters of a method up to which the order is proved in exact arithmetic, and the degree.
const MAX_EXACT: (usize, usize) = (16, 6);

/// The conjugate order up to a limit, at most [`MAX_ORDER`]; `None` if the method is not a splitting for separable Hamiltonians, and for
/// general ones.
pub(crate) fn conjugate_order(
    exact: &Exact,
    class: HamiltonianClass,
    limit: usize,
) -> Option<ConjugateOrder> {
    let claim = Claim::of(class, limit.min(MAX_ORDER))?;
    with_letters(exact, Decide { claim })
}

struct Decide {
    claim: Claim,
}

impl OfLetters for Decide {
    type Found = Option<ConjugateOrder>;

    fn of<F: Field>(self, field: &F, letters: Vec<(u8, F::Element)>) -> Option<ConjugateOrder> {
        let balls = Balls::new(BITS);
        let enclosed = letters
            .iter()
            .map(|(letter, x)| (*letter, field.number(x).ball(BITS)));
        let found = order_of(&balls, enclosed.collect(), &self.claim)?;
        let exact = field.verified_bits().is_none()
            && letters.len() <= MAX_EXACT.0
            && found.order <= MAX_EXACT.1;
        if !exact || found.order == 0 {
            return Some(found);
        }
        let claim = match self.claim {
            Claim::Nystrom(_) => Claim::Nystrom(found.order),
            _ => Claim::Separable(found.order),
        };
        let proved = order_of(field, letters, &claim)?;
        let same = proved.order == found.order;
        Some(if same {
            ConjugateOrder {
                evidence: proved.evidence,
                ..found
            }
        } else {
            proved
        })
    }
}

/// The order up to that of a claim; `None` where multiples of `X` are not all that commutes with it.
fn order_of<F: Field>(
    field: &F,
    letters: Vec<(u8, F::Element)>,
    claim: &Claim,
) -> Option<ConjugateOrder> {
    let limit = claim.order();
    let conditions = Conditions::new(claim, false).ok()?;
    let mut kernel = Series::of_letters(field, &letters, limit);
    let evidence = || match field.verified_bits() {
        Some(bits) => Evidence::Verified { bits },
        None => Evidence::Proved,
    };
    let (mut below, mut processor) = (0, Vec::new());
    for degree in 1..=limit {
        let forms = conditions.conditions().iter();
        let forms: Vec<Vec<(usize, BigRational)>> = forms
            .filter(|condition| condition.degree == degree)
            .map(|condition| {
                let terms = condition.terms.iter();
                let term = |(word, factor): &(usize, BigRational)| {
                    (index_of(&conditions.words()[*word]), factor.clone())
                };
                terms.map(term).collect()
            })
            .collect();
        let generators = lie_basis(degree.saturating_sub(1));
        let brackets: Vec<Vec<BigInt>> = generators.iter().map(|b| bracket_with_sum(b)).collect();
        let rows: Vec<(Vec<BigRational>, F::Element)> = forms
            .iter()
            .map(|form| {
                let by = |bracket: &Vec<BigInt>| {
                    form.iter()
                        .fold(BigRational::default(), |sum, (w, c)| sum + c * &bracket[*w])
                };
                (
                    brackets.iter().map(by).collect(),
                    kernel.error(field, degree, form),
                )
            })
            .collect();
        let (solution, rest) = eliminated(field, rows, generators.len());
        // All that commutes with X is zero, or in the degree 1 a multiple of X.
        let rank = solution.iter().flatten().count();
        let wanted = below - usize::from(degree == 2);
        if rank != wanted {
            return None;
        }
        below = forms.len();
        let violated = rest.iter().find(|x| field.zero(x) == Zero::No);
        if let Some(violated) = violated {
            return Some(ConjugateOrder {
                order: degree - 1,
                evidence: evidence(),
                refuted_by: Some(ViolatedKernel {
                    degree,
                    conditions: rest.len(),
                    residual: field.number(violated).decimal(12),
                }),
                processor,
            });
        }
        let pairs = generators.iter().zip(&solution);
        let terms: Vec<(&Vec<BigInt>, &F::Element)> = pairs
            .filter_map(|(generator, value)| Some((generator, value.as_ref()?)))
            .collect();
        let words = lyndon_words(degree.saturating_sub(1));
        for (word, value) in words.iter().zip(&solution) {
            let value = value.as_ref().filter(|x| field.zero(x) == Zero::No);
            processor.extend(value.map(|value| LieTerm {
                bracket: bracket_text(word),
                degree: degree - 1,
                factor: field.number(value).decimal(20),
            }));
        }
        if !terms.is_empty() && degree < limit {
            kernel.conjugate(field, degree - 1, &terms);
        }
    }
    Some(ConjugateOrder {
        order: limit,
        evidence: evidence(),
        refuted_by: None,
        processor,
    })
}

/// The solution of `M x = −r` for rational `M`, where pivots determine it and zero elsewhere, and the values `r` of the rows without a pivot
/// after the elimination.
fn eliminated<F: Field>(
    field: &F,
    mut rows: Vec<(Vec<BigRational>, F::Element)>,
    columns: usize,
) -> (Vec<Option<F::Element>>, Vec<F::Element>) {
    let mut pivots: Vec<usize> = Vec::new();
    for column in 0..columns {
        let done = pivots.len();
        let Some(found) = (done..rows.len()).find(|&row| !rows[row].0[column].is_zero()) else {
            continue;
        };
        rows.swap(done, found);
        let (pivot, value) = rows[done].clone();
        for (index, (row, other)) in rows.iter_mut().enumerate() {
            if index == done || row[column].is_zero() {
                continue;
            }
            let factor = &row[column] / &pivot[column];
            row.iter_mut()
                .zip(&pivot)
                .for_each(|(x, y)| *x -= &factor * y);
            let part = field.multiply(&field.rational(&factor), &value);
            *other = field.subtract(other, &part);
        }
        pivots.push(column);
    }
    let mut solution = vec![None; columns];
    for (index, &column) in pivots.iter().enumerate() {
        let (row, value) = &rows[index];
        let factor = field.rational(&-row[column].recip());
        solution[column] = Some(field.multiply(&factor, value));
    }
    let rest = rows.split_off(pivots.len());
    (solution, rest.into_iter().map(|(_, value)| value).collect())
}

/// The place of a word among those of its degree: its letters as binary digits.
fn index_of(word: &[u8]) -> usize {
    word.iter()
        .fold(0, |index, letter| 2 * index + usize::from(*letter))
}

/// A basis of the free Lie algebra of two letters in a degree: the bracketed Lyndon words, by the coefficients of all words.
fn lie_basis(degree: usize) -> Vec<Vec<BigInt>> {
    let words = lyndon_words(degree);
    words.iter().map(|word| bracketed(word)).collect()
}

fn lyndon_words(degree: usize) -> Vec<Word> {
    match degree {
        0 => Vec::new(),
        _ => Alphabet::splitting().lyndon(degree),
    }
}

/// Where the standard bracketing cuts a Lyndon word: before its longest proper Lyndon suffix.
fn cut(word: &[u8]) -> usize {
    let lyndon = |word: &[u8]| (1..word.len()).all(|start| word < &word[start..]);
    (1..word.len())
        .find(|&cut| lyndon(&word[cut..]))
        .unwrap_or(1)
}

/// `[A,[A,B]]` for the word `AAB`.
fn bracket_text(word: &[u8]) -> String {
    match word {
        [DRIFT] => "A".to_owned(),
        [_] => "B".to_owned(),
        _ => {
            let (left, right) = word.split_at(cut(word));
            format!("[{},{}]", bracket_text(left), bracket_text(right))
        }
    }
}

/// The standard bracketing of a Lyndon word: its longest proper Lyndon suffix is the right operand.
fn bracketed(word: &[u8]) -> Vec<BigInt> {
    if let [letter] = word {
        let mut own = vec![BigInt::default(); 2];
        own[usize::from(*letter)] = BigInt::one();
        return own;
    }
    let (left, right) = word.split_at(cut(word));
    bracket(&bracketed(left), &bracketed(right))
}

/// `xy − yx`
fn bracket(x: &[BigInt], y: &[BigInt]) -> Vec<BigInt> {
    let mut found = vec![BigInt::default(); x.len() * y.len()];
    for (i, left) in x.iter().enumerate().filter(|(_, left)| !left.is_zero()) {
        for (j, right) in y.iter().enumerate() {
            let product = left * right;
            found[i * y.len() + j] += &product;
            found[j * x.len() + i] -= product;
        }
    }
    found
}

/// `[x, A + B]`
fn bracket_with_sum(x: &[BigInt]) -> Vec<BigInt> {
    bracket(x, &[BigInt::one(), BigInt::one()])
}

/// An element of the free associative algebra up to a degree: for each degree the coefficients of all words, in lexicographic order.
struct Series<E>(Vec<Vec<E>>);

impl<E: Clone> Series<E> {
    /// The product of the flows of letters, the first one on the left.
    fn of_letters<F: Field<Element = E>>(field: &F, letters: &[(u8, E)], limit: usize) -> Self {
        let zero = field.rational(&BigRational::default());
        let mut parts: Vec<Vec<E>> = (0..=limit).map(|n| vec![zero.clone(); 1 << n]).collect();
        parts[0][0] = field.rational(&BigRational::one());
        for (letter, x) in letters {
            // xⁿ/n!
            let mut powers = vec![field.rational(&BigRational::one())];
            for n in 1..=limit {
                let inverse = field.rational(&BigRational::new(BigInt::one(), n.into()));
                powers.push(field.multiply(&field.multiply(&powers[n - 1], x), &inverse));
            }
            let own = usize::from(*letter);
            for degree in (1..=limit).rev() {
                for word in 0..1 << degree {
                    let mut rest: usize = word;
                    let mut sum = parts[degree][word].clone();
                    for n in 1..=degree {
                        if rest & 1 != own {
                            break;
                        }
                        rest >>= 1;
                        let term = field.multiply(&parts[degree - n][rest], &powers[n]);
                        sum = field.add(&sum, &term);
                    }
                    parts[degree][word] = sum;
                }
            }
        }
        Series(parts)
    }

    /// A linear form of the difference from `exp(A + B)` in a degree.
    fn error<F: Field<Element = E>>(
        &self,
        field: &F,
        degree: usize,
        form: &[(usize, BigRational)],
    ) -> E {
        let factorial: BigInt = (1..=degree).fold(BigInt::one(), |n, k| n * k);
        let wanted = BigRational::new(BigInt::one(), factorial);
        let start = form.iter().map(|(_, factor)| factor).sum::<BigRational>() * -wanted;
        form.iter()
            .fold(field.rational(&start), |sum, (word, factor)| {
                let value = &self.0[degree][*word];
                field.add(&sum, &field.multiply(&field.rational(factor), value))
            })
    }

    /// Replaces the element `K` by `exp(π) K exp(−π)` with a `π` of one degree, a sum of multiples.
    fn conjugate<F: Field<Element = E>>(
        &mut self,
        field: &F,
        degree: usize,
        terms: &[(&Vec<BigInt>, &E)],
    ) {
        let zero = field.rational(&BigRational::default());
        let coefficient = |word: usize| {
            let own = terms.iter().filter(|(words, _)| !words[word].is_zero());
            own.fold(zero.clone(), |sum, (words, value)| {
                let factor = field.rational(&BigRational::from_integer(words[word].clone()));
                field.add(&sum, &field.multiply(&factor, value))
            })
        };
        let processor: Vec<E> = (0..1 << degree).map(coefficient).collect();
        for left in [true, false] {
            let mut power = Series(self.0.clone());
            for n in 1..=self.0.len() / degree.max(1) {
                let sign = if left { 1 } else { -1 };
                let factor = BigRational::new(sign.into(), n.into());
                power = power.times(field, degree, &processor, &factor, left);
                for (own, added) in self.0.iter_mut().flatten().zip(power.0.iter().flatten()) {
                    *own = field.add(own, added);
                }
            }
        }
    }

    /// The product with an element of one degree, on the left or on the right, times a factor.
    fn times<F: Field<Element = E>>(
        &self,
        field: &F,
        degree: usize,
        other: &[E],
        factor: &BigRational,
        left: bool,
    ) -> Self {
        let (zero, factor) = (
            field.rational(&BigRational::default()),
            field.rational(factor),
        );
        let part = |n: usize| {
            let mut found = vec![zero.clone(); 1 << n];
            let Some(below) = n.checked_sub(degree).and_then(|below| self.0.get(below)) else {
                return found;
            };
            for (i, x) in other.iter().enumerate() {
                let x = field.multiply(x, &factor);
                for (j, y) in below.iter().enumerate() {
                    let word = match left {
                        true => i * below.len() + j,
                        false => j * other.len() + i,
                    };
                    found[word] = field.multiply(&x, y);
                }
            }
            found
        };
        Series((0..self.0.len()).map(part).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Rationals;
    use crate::arithmetic::rational::ratio;
    use crate::certify::KICK;

    fn order(claim: &Claim, letters: &[(u8, BigRational)]) -> ConjugateOrder {
        order_of(&Rationals, letters.to_vec(), claim).expect("decided")
    }

    /// The conditions on a kernel of each degree: the dimensions of `L_n` less those of `L_{n−1}`.
    #[test]
    fn multiples_of_the_hamiltonian_alone_commute_with_it() {
        let euler = [(DRIFT, ratio(1, 1)), (KICK, ratio(1, 1))];
        for (claim, counts) in [
            (Claim::Separable(7), [2, 0, 1, 1, 3, 3, 9]),
            (Claim::Nystrom(7), [2, 0, 1, 0, 2, 1, 5]),
        ] {
            // No kernel satisfies all conditions, so the ranks are taken one by one.
            let conditions = Conditions::new(&claim, false).expect("a claim");
            for (degree, count) in (1..=7).zip(counts) {
                let forms = conditions.conditions().iter();
                let forms: Vec<_> = forms.filter(|c| c.degree == degree).collect();
                let basis = lie_basis(degree - 1);
                let rows = forms.iter().map(|form| {
                    let by = |b: &Vec<BigInt>| {
                        let bracket = bracket_with_sum(b);
                        form.terms.iter().fold(ratio(0, 1), |sum, (word, factor)| {
                            sum + factor * &bracket[index_of(&conditions.words()[*word])]
                        })
                    };
                    (basis.iter().map(by).collect(), ratio(0, 1))
                });
                let (_, rest) = eliminated(&Rationals, rows.collect(), basis.len());
                assert_eq!(rest.len(), count, "{claim} {degree}");
            }
            // exp(−A/2) exp(A) exp(B) exp(A/2) is symmetric.
            let found = order(&claim, &euler);
            assert_eq!(found.order, 2);
            let terms: Vec<String> = found
                .processor
                .iter()
                .map(|term| format!("{} {}", term.factor, term.bracket))
                .collect();
            assert_eq!(terms, ["-0.50000000000000000000 A"]);
        }
    }

    /// `exp(π) K exp(−π)` has the conjugate order of K, whatever its own order is.
    #[test]
    fn a_conjugation_does_not_change_the_conjugate_order() {
        // Of order 2 and conjugate order 2.
        let third = ratio(1, 3);
        let kernel = [
            (KICK, ratio(1, 2)),
            (DRIFT, ratio(1, 1)),
            (KICK, ratio(1, 2)),
        ];
        let before = [(DRIFT, third.clone()), (KICK, -third.clone())];
        let after = [(KICK, third.clone()), (DRIFT, -third)];
        let whole = [&before[..], &kernel[..], &after[..]].concat();
        let claim = Claim::Separable(5);
        let [alone, conjugated] = [&kernel[..], &whole[..]].map(|letters| order(&claim, letters));
        assert_eq!((alone.order, conjugated.order), (2, 2));
        let conditions = |found: &ConjugateOrder| found.refuted_by.clone().map(|x| x.conditions);
        assert_eq!(conditions(&alone), Some(1));
        assert_eq!(conditions(&conjugated), Some(1));
        // The whole has lost its order.
        let exact = Conditions::new(&Claim::Separable(2), false).expect("a claim");
        let series = Series::of_letters(&Rationals, &whole, 2);
        let wrong = exact.conditions().iter().any(|condition| {
            let terms = condition.terms.iter();
            let form: Vec<_> = terms
                .map(|(word, c)| (index_of(&exact.words()[*word]), c.clone()))
                .collect();
            !series.error(&Rationals, condition.degree, &form).is_zero()
        });
        assert!(wrong);
    }
}
