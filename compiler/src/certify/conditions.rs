//! Order conditions as linear forms in the coefficients of words.
//!
//! Let `A` and `B` be the Lie derivatives of the drift and the kick, `f ↦ d/dt f∘φ_t` at `t = 0`. The pull-back
//! of a composition reverses its factors, `(φ₂∘φ₁)* = φ₁*φ₂*`, so a splitting that begins with the kick
//! `k₁` and continues with the drift `d₁` acts on functions by
//!
//! ```text
//! S = exp(k₁B) exp(d₁A) exp(k₂B) exp(d₂A) ⋯,      h = 1,
//! ```
//!
//! and has order `p` for every separable `H` if `S = exp(A + B)` in the free associative algebra up to the
//! degree `p` (GNI III.5; Murua & Sanz-Serna 1999).
//!
//! **Lyndon words suffice.** Both sides are exponentials of Lie series, so for both the map of a word to its coefficient is a
//! character of the shuffle algebra. The Lyndon words generate that algebra over ℚ (Radford 1979; Reutenauer, *Free Lie
//! algebras*, theorem 6.1): a word is a polynomial in Lyndon words that have together the same letters. So if the coefficients
//! of all Lyndon words of degree at most `p` are those of `exp(A + B)`, namely `1/|w|!`, so are those of all words.
//!
//! **Symmetric methods need odd degrees only.** For a palindromic `S`, replacing `h` by `−h` gives the inverse, so `log S` is
//! odd in `h`. If the conditions of all degrees below an even degree `2k` hold, then `log S = A + B + O(h^{2k+1})`, because
//! its part of degree `2k` is zero. So the conditions of degree `2k` hold too.
//!
//! **Compositions of a symmetric method.** A symmetric basic method has the logarithm `hE₁ + h³E₃ + h⁵E₅ + ⋯`,
//! and its composition with weights `w₁, …, w_s` is `∏ exp(w_i E₁ + w_i³ E₃ + ⋯)`. Over the letters `E₁, E₃, …`
//! of degrees 1, 3, … the same holds with `exp(E₁)` on the right: `[E₁] = 1`, and every other Lyndon word has
//! the coefficient 0. This is sufficient for every basic method, implicit ones included (McLachlan 1995;
//! GNI V.3.2). There are 1, 1, 2, 4, 8 conditions of degree 1, 3, 5, 7, 9.
//!
//! **Perturbed systems**, `H = H_A + εH_B`. The order is `(s₁, s₂, …, s_m)` with `s₁ ≥ s₂ ≥ …` if the terms of `log S` with
//! `j` letters `B` vanish up to the degree `s_j` (for `j > m`, `s_m`), apart from `A + B` (Blanes, Casas, Farrés, Laskar,
//! Makazaga & Murua 2013; Laskar & Robutel 2001 for `m = 2`). The grades with `a` drifts and `j ≥ 1` kicks, `a + j > s_j`,
//! span an ideal. If a word has any other grade, so do all words with at most as many of each letter, except powers of `A`,
//! which `[A] = 1` determines. So the Lyndon words of the other grades are a sufficient set.

use std::collections::BTreeMap;
use std::fmt;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::CertifyError;
use super::lyndon::{Alphabet, Word, split_lyndon};
use super::nystrom::{Combination, Quotient};
use crate::hamiltonian_class::HamiltonianClass;

/// The highest order that a method can claim.
pub const MAX_ORDER: usize = 10;
/// The highest order in `ε` that a method for perturbed systems can claim. Beyond
/// [`MAX_ORDER`] there is one condition per degree.
pub const MAX_PERTURBED_ORDER: usize = 24;

/// The claim of a method.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Claim {
    /// The order for every `H = T(p) + U(q)`.
    Separable(usize),
    /// The order for every `H = pᵀM⁻¹p/2 + U(q)`.
    Nystrom(usize),
    /// The order `(s₁, s₂, …)` for every `H = H_A + εH_B`: local errors `O(εh^{s₁+1} + ε²h^{s₂+1} + ⋯)`.
    Perturbed(Vec<usize>),
    /// The order of the composition of any symmetric basic method of order 2.
    SymmetricBase(usize),
}

impl Claim {
    /// The claim of an order for a class; `None` for general Hamiltonians, which no splitting integrates.
    pub fn of(class: HamiltonianClass, order: usize) -> Option<Self> {
        match class {
            HamiltonianClass::General => None,
            HamiltonianClass::Separable => Some(Claim::Separable(order)),
            HamiltonianClass::Nystrom => Some(Claim::Nystrom(order)),
        }
    }

    /// The order; for perturbed systems the largest of the orders.
    pub fn order(&self) -> usize {
        match self {
            Claim::Separable(order) | Claim::Nystrom(order) | Claim::SymmetricBase(order) => *order,
            Claim::Perturbed(orders) => orders.first().copied().unwrap_or(0),
        }
    }

    /// The order that follows from the conditions with at most `power` letters `B` (at least one): the `s_j` of a method
    /// for perturbed systems.
    pub fn order_in_power(&self, power: usize) -> usize {
        match self {
            Claim::Separable(order) => *order,
            // The terms that vanish for quadratic T have at least three letters B; the first is [B, [B, [B, A]]], of degree 4.
            Claim::Nystrom(order) if power <= 2 => *order,
            Claim::Nystrom(order) => (*order).min(3),
            Claim::Perturbed(orders) => {
                let order = orders.get(power.saturating_sub(1)).or(orders.last());
                order.copied().unwrap_or(0)
            }
            // For every basic method.
            Claim::SymmetricBase(_) => 1,
        }
    }

    /// A lower bound on the order for a class of Hamiltonians. Kicks and drifts that sum to 1 give order 1
    /// for every class.
    pub(crate) fn order_for(&self, class: HamiltonianClass) -> usize {
        match (class, self) {
            (HamiltonianClass::General, _) => 1,
            (HamiltonianClass::Nystrom, Claim::Nystrom(order)) => *order,
            _ => self.order_in_power(usize::MAX),
        }
    }

    /// The same claim with an order higher by `step`; `None` for perturbed systems, whose claims have several orders.
    pub fn next(&self, step: usize) -> Option<Claim> {
        match self {
            Claim::Separable(order) => Some(Claim::Separable(order + step)),
            Claim::Nystrom(order) => Some(Claim::Nystrom(order + step)),
            Claim::SymmetricBase(order) => Some(Claim::SymmetricBase(order + step)),
            Claim::Perturbed(_) => None,
        }
    }

    /// The claim as a definition writes it: `separable(6)`, `perturbed(8, 4)`.
    pub fn notation(&self) -> String {
        match self {
            Claim::Separable(order) | Claim::SymmetricBase(order) => format!("separable({order})"),
            Claim::Nystrom(order) => format!("nystrom({order})"),
            Claim::Perturbed(orders) => {
                let orders: Vec<String> = orders.iter().map(usize::to_string).collect();
                format!("perturbed({})", orders.join(", "))
            }
        }
    }

    pub(super) fn check(&self) -> Result<(), CertifyError> {
        let wrong = |order, limit| Err(CertifyError::Order { order, limit });
        match self {
            Claim::Perturbed(orders) => {
                let first = self.order();
                let rest = orders.get(1).copied().unwrap_or(first);
                let descending = orders.windows(2).all(|pair| pair[0] >= pair[1]);
                if !descending || orders.contains(&0) || first > MAX_PERTURBED_ORDER {
                    return wrong(first, MAX_PERTURBED_ORDER);
                }
                if orders.is_empty() || rest > MAX_ORDER {
                    return wrong(rest, MAX_ORDER);
                }
                Ok(())
            }
            _ if (1..=MAX_ORDER).contains(&self.order()) => Ok(()),
            _ => wrong(self.order(), MAX_ORDER),
        }
    }

    pub(super) fn alphabet(&self) -> Alphabet {
        match self {
            Claim::SymmetricBase(order) => Alphabet::symmetric_base(*order),
            _ => Alphabet::splitting(),
        }
    }
}

impl fmt::Display for Claim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Claim::Separable(order) => write!(f, "order {order} for separable H"),
            Claim::Nystrom(order) => write!(f, "order {order} for quadratic T"),
            Claim::SymmetricBase(order) => {
                write!(f, "order {order} with any symmetric basic method")
            }
            Claim::Perturbed(orders) => {
                let orders: Vec<String> = orders.iter().map(usize::to_string).collect();
                write!(f, "order ({}) for perturbed H", orders.join(", "))
            }
        }
    }
}

/// One condition: `Σ_w c_w [w]S` equals the wanted value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Condition {
    /// The coefficients `c_w` with the indices of the words `w` in [`Conditions::words`].
    pub terms: Vec<(usize, BigRational)>,
    /// The value for the exact flow.
    pub wanted: BigRational,
    /// The degree in the step size.
    pub degree: usize,
}

/// A sufficient set of order conditions.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Conditions {
    alphabet: Alphabet,
    words: Vec<Word>,
    conditions: Vec<Condition>,
}

impl Conditions {
    /// The conditions for a claim; only those of odd degree if the method is symmetric.
    ///
    /// ```
    /// use symplectic_compiler::certify::{Claim, Conditions};
    ///
    /// // 2 + 1 + 2 + 3 and 2 + 2.
    /// assert_eq!(Conditions::new(&Claim::Separable(4), false)?.conditions().len(), 8);
    /// assert_eq!(Conditions::new(&Claim::Separable(4), true)?.conditions().len(), 4);
    /// # Ok::<(), symplectic_compiler::certify::CertifyError>(())
    /// ```
    ///
    /// # Errors
    /// [`CertifyError::Order`] for an order that is zero or too high.
    pub fn new(claim: &Claim, symmetric: bool) -> Result<Self, CertifyError> {
        claim.check()?;
        let step = if symmetric { 2 } else { 1 };
        Ok(Conditions::of_degrees(
            claim,
            (1..=claim.order()).step_by(step),
        ))
    }

    /// The conditions of one degree in the step size, for splittings: a method that satisfies those of all lower degrees has these residuals
    /// as the coordinates of its leading error.
    ///
    /// # Errors
    /// [`CertifyError::Order`] for a degree that is zero, or more than one beyond the highest order.
    pub fn of_degree(class: HamiltonianClass, degree: usize) -> Result<Self, CertifyError> {
        let highest = MAX_ORDER + 1;
        let claim = match class {
            HamiltonianClass::Nystrom => Claim::Nystrom(degree),
            HamiltonianClass::Separable | HamiltonianClass::General => Claim::Separable(degree),
        };
        match (1..=highest).contains(&degree) {
            true => Ok(Conditions::of_degrees(&claim, std::iter::once(degree))),
            false => Err(CertifyError::Order {
                order: degree,
                limit: highest,
            }),
        }
    }

    /// The conditions of the given degrees, which are ascending.
    pub(super) fn of_degrees(claim: &Claim, degrees: impl Iterator<Item = usize>) -> Self {
        let mut all = Conditions {
            alphabet: claim.alphabet(),
            words: Vec::new(),
            conditions: Vec::new(),
        };
        let mut indices = BTreeMap::new();
        let mut quotient = Quotient::default();
        for degree in degrees {
            let forms: Vec<Combination> = match claim {
                Claim::Separable(_) | Claim::SymmetricBase(_) => {
                    single(all.alphabet.lyndon(degree))
                }
                Claim::Nystrom(_) => quotient.forms(degree),
                Claim::Perturbed(orders) => single(perturbed(orders, degree)),
            };
            for form in forms {
                let mut wanted = BigRational::zero();
                let mut terms = Vec::new();
                for (word, factor) in form {
                    wanted += all.exact_flow(&word) * &factor;
                    let next = indices.len();
                    let index = *indices.entry(word.clone()).or_insert(next);
                    if index == next {
                        all.words.push(word);
                    }
                    terms.push((index, factor));
                }
                all.conditions.push(Condition {
                    terms,
                    wanted,
                    degree,
                });
            }
        }
        all
    }

    /// The conditions of the odd degrees up to one for a product that is even in the step size: the coefficients of the words vanish.
    pub(super) fn even(claim: &Claim, degree: usize) -> Self {
        let mut found = Conditions::of_degrees(claim, (1..=degree).step_by(2));
        for condition in &mut found.conditions {
            condition.wanted = BigRational::zero();
        }
        found
    }

    /// The coefficient of a word in `exp(A + B)` or `exp(E₁)`: `1/|w|!` if all letters are of degree 1.
    fn exact_flow(&self, word: &[u8]) -> BigRational {
        if self.alphabet.degree(word) > word.len() {
            return BigRational::zero();
        }
        let factorial: BigInt = (1..=word.len()).fold(BigInt::one(), |n, k| n * k);
        BigRational::new(BigInt::one(), factorial)
    }

    /// The letters.
    pub fn alphabet(&self) -> &Alphabet {
        &self.alphabet
    }

    /// The words that occur.
    pub fn words(&self) -> &[Word] {
        &self.words
    }

    /// The conditions, by ascending degree.
    pub fn conditions(&self) -> &[Condition] {
        &self.conditions
    }
}

fn single(words: Vec<Word>) -> Vec<Combination> {
    let form = |word| Combination::from([(word, BigRational::one())]);
    words.into_iter().map(form).collect()
}

/// The Lyndon words of a degree for which a claimed order `(s₁, s₂, …)` has conditions.
fn perturbed(orders: &[usize], degree: usize) -> Vec<Word> {
    if degree == 1 {
        return Alphabet::splitting().lyndon(1);
    }
    let grade = |kicks: usize| {
        let order = orders.get(kicks - 1).or(orders.last());
        let wanted = order.is_some_and(|order| degree <= *order);
        if wanted {
            split_lyndon(degree - kicks, kicks)
        } else {
            Vec::new()
        }
    };
    // A power of one letter is a Lyndon word in degree 1 only.
    (1..degree).flat_map(grade).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(claim: &Claim, symmetric: bool) -> Vec<usize> {
        let conditions = Conditions::new(claim, symmetric).expect("a claim");
        let of = |degree| {
            let all = conditions.conditions().iter();
            all.filter(|c| c.degree == degree).count()
        };
        (1..=claim.order()).map(of).collect()
    }

    #[test]
    fn numbers_of_order_conditions_agree_with_the_literature() {
        assert_eq!(
            counts(&Claim::Separable(8), false),
            [2, 1, 2, 3, 6, 9, 18, 30]
        );
        assert_eq!(
            counts(&Claim::Separable(8), true),
            [2, 0, 2, 0, 6, 0, 18, 0]
        );
        assert_eq!(counts(&Claim::Nystrom(6), false), [2, 1, 2, 2, 4, 5]);
        assert_eq!(
            counts(&Claim::SymmetricBase(10), true),
            [1, 0, 1, 0, 2, 0, 4, 0, 8, 0]
        );
        // (10, 4): one condition with one kick per degree, and all conditions of degree 3, one of which has two kicks.
        let claim = Claim::Perturbed(vec![10, 4]);
        assert_eq!(counts(&claim, true), [2, 0, 2, 0, 1, 0, 1, 0, 1, 0]);
        // (10, 6, 4) also has in degree 5 the two Lyndon words with two kicks.
        let claim = Claim::Perturbed(vec![10, 6, 4]);
        assert_eq!(counts(&claim, true), [2, 0, 2, 0, 3, 0, 1, 0, 1, 0]);
        // Equal orders amount to an order for separable H.
        let claim = Claim::Perturbed(vec![8]);
        assert_eq!(counts(&claim, false), counts(&Claim::Separable(8), false));
    }

    #[test]
    fn orders_out_of_bounds_are_errors() {
        for claim in [
            Claim::Separable(0),
            Claim::Nystrom(MAX_ORDER + 1),
            Claim::Perturbed(vec![]),
            Claim::Perturbed(vec![4, 6]),
            Claim::Perturbed(vec![MAX_PERTURBED_ORDER + 1, 2]),
            Claim::Perturbed(vec![20, 12]),
        ] {
            assert!(Conditions::new(&claim, true).is_err(), "{claim}");
        }
    }
}
