//! The order of a composition of any methods, for all systems on which they have steps.
//!
//! The logarithm of a method's step is `hE₁ + h²E₂ + h³E₃ + ⋯`, with the same `E₁` for all methods. The even terms vanish for a symmetric
//! method, and have the opposite sign for its adjoint. So a composition with the fractions `γ_1, …, γ_m` is
//! `∏ exp(γ_i hE₁ ± γ_i²h²E₂ + γ_i³h³E₃ ± ⋯)`, with the terms of each method. It has order p iff the coefficients of all Lyndon words over
//! these letters up to the degree p are those of `exp(hE₁)`: see [`Conditions`](crate::certify::Conditions).

use num_rational::BigRational;
use num_traits::{Signed, Zero};

use crate::algebra::{Ball, Balls, Constants, Field, Rationals};
use crate::arithmetic::rational::ratio;
use crate::certify::{Alphabet, MAX_ORDER};
use crate::evidence::Evidence;
use crate::symbolic::Constant;

/// Binary places of the enclosures in which the conditions for fractions that are not rational are verified.
const BITS: u32 = 512;

/// With more fractions that are not rational, exact arithmetic would take long.
const MAX_EXACT_STEPS: usize = 24;

/// The largest number of letters. Words of more would take long.
const MAX_LETTERS: usize = 32;

/// A step of a composition.
pub(crate) struct Step<'a> {
    /// The fraction `γ` of the whole step.
    pub fraction: &'a Constant,
    /// The number of the method.
    pub method: usize,
    /// Whether it is a step of the adjoint of this method.
    pub adjoint: bool,
}

/// How it is known that the composition has this order with any methods of order 1, of which some are symmetric; `None` if it is not.
pub(crate) fn has_order(steps: &[Step<'_>], symmetric: &[bool], order: usize) -> Option<Evidence> {
    let letters = letters(symmetric, order);
    if letters.len() > MAX_LETTERS {
        return None;
    }
    let methods: Vec<(usize, bool)> = steps.iter().map(|s| (s.method, s.adjoint)).collect();
    let fractions: Vec<&Constant> = steps.iter().map(|step| step.fraction).collect();
    let over = (&methods[..], &fractions[..], &letters[..]);
    if fractions.iter().all(|x| x.as_rational().is_some()) {
        return holds_over(&Rationals, over, order);
    }
    let field = match steps.len() <= MAX_EXACT_STEPS {
        true => Constants::containing(fractions.iter().copied()),
        false => None,
    };
    match field {
        Some(field) => holds_over(&field, over, order),
        None => holds_over(&Balls::new(BITS), over, order),
    }
}

/// How it is known that all conditions hold, in a field of constants or in enclosures; `None` if they do not.
fn holds_over<F: Field>(
    field: &F,
    (methods, fractions, letters): (&[(usize, bool)], &[&Constant], &[Letter]),
    order: usize,
) -> Option<Evidence> {
    let fractions = fractions.iter().map(|fraction| field.constant(fraction));
    let fractions = fractions.collect::<Option<Vec<F::Element>>>()?;
    let holds = all_hold(field, methods, &fractions, letters, order, |x, wanted| {
        let difference = field.subtract(x, &field.rational(wanted));
        field.zero(&difference).may_be()
    });
    let evidence = match field.verified_bits() {
        Some(bits) => Evidence::Verified { bits },
        None => Evidence::Proved,
    };
    holds.then_some(evidence)
}

/// The order of a composition of any method of order 1, or of any symmetric one, with these fractions, as far as conditions of at most this
/// residual tell.
pub fn order_within(fractions: &[BigRational], symmetric: bool, tolerance: &BigRational) -> usize {
    let near = |x: &BigRational, wanted: &BigRational| (x - wanted).abs() <= *tolerance;
    if tolerance.is_zero() {
        return highest_order(&Rationals, fractions, symmetric, near);
    }
    // Sums of long products of long decimals; their last digits do not matter.
    let balls = Balls::new(BITS);
    let fractions: Vec<Ball> = fractions.iter().map(|x| balls.rational(x)).collect();
    highest_order(&balls, &fractions, symmetric, |x: &Ball, wanted| {
        near(&x.interval(BITS).middle(), wanted)
    })
}

fn highest_order<F: Field>(
    field: &F,
    fractions: &[F::Element],
    symmetric: bool,
    is: impl Fn(&F::Element, &BigRational) -> bool,
) -> usize {
    let steps = vec![(0, false); fractions.len()];
    let holds = |order: &usize| {
        let letters = letters(&[symmetric], *order);
        all_hold(field, &steps, fractions, &letters, *order, &is)
    };
    (1..=MAX_ORDER).take_while(holds).last().unwrap_or(0)
}

/// A term `E_k` of the logarithm of a step.
#[derive(Clone, Copy)]
struct Letter {
    degree: usize,
    /// The method; `None` for the term of degree 1, which is that of all.
    method: Option<usize>,
}

/// The terms up to an order of the logarithms of methods, of which some are symmetric.
fn letters(symmetric: &[bool], order: usize) -> Vec<Letter> {
    let mut letters = vec![Letter {
        degree: 1,
        method: None,
    }];
    for (method, &symmetric) in symmetric.iter().enumerate() {
        let degrees = (2..=order).filter(|degree| !symmetric || degree % 2 == 1);
        letters.extend(degrees.map(|degree| Letter {
            degree,
            method: Some(method),
        }));
    }
    letters
}

fn all_hold<F: Field>(
    field: &F,
    methods: &[(usize, bool)],
    fractions: &[F::Element],
    letters: &[Letter],
    order: usize,
    is: impl Fn(&F::Element, &BigRational) -> bool,
) -> bool {
    let alphabet = Alphabet::of_degrees(letters.iter().map(|letter| letter.degree).collect());
    let mut words = (1..=order).flat_map(|degree| alphabet.lyndon(degree));
    words.all(|word| {
        let word: Vec<Letter> = word.iter().map(|&l| letters[usize::from(l)]).collect();
        let is_first = word.len() == 1 && word[0].degree == 1;
        let wanted = ratio(i64::from(is_first), 1);
        is(&coefficient(field, &word, methods, fractions), &wanted)
    })
}

/// The coefficient of a word in a product of steps of methods or, where that is true, of their adjoints.
fn coefficient<F: Field>(
    field: &F,
    word: &[Letter],
    methods: &[(usize, bool)],
    fractions: &[F::Element],
) -> F::Element {
    let [zero, one] = [0, 1].map(|number| field.rational(&ratio(number, 1)));
    // The coefficients of the word's prefixes in the product of the factors so far.
    let mut known = vec![zero; word.len() + 1];
    known[0] = one.clone();
    for (&(own, adjoint), fraction) in methods.iter().zip(fractions) {
        for end in (1..=word.len()).rev() {
            // The coefficient of the letters from `start` in the factor.
            let mut factor = one.clone();
            for start in (0..end).rev() {
                let Letter { degree, method } = word[start];
                if method.is_some_and(|method| method != own) {
                    break;
                }
                for _ in 0..degree {
                    factor = field.multiply(&factor, fraction);
                }
                let sign = if adjoint && degree.is_multiple_of(2) {
                    -1
                } else {
                    1
                };
                let count = i64::try_from(end - start).unwrap_or(i64::MAX);
                factor = field.multiply(&factor, &field.rational(&ratio(sign, count)));
                let term = field.multiply(&known[start], &factor);
                known[end] = field.add(&known[end], &term);
            }
        }
    }
    known.swap_remove(word.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derive::Problem;
    use crate::tableau::Parts;
    use crate::{Definition, Limits};

    /// The orders up to 9 with these methods, the first of which may be symmetric, and the second its adjoint.
    fn orders(definition: &str, symmetric: bool) -> Vec<usize> {
        let definition = Definition::parse(definition).expect(definition);
        let limits = Limits { stages: 100 };
        let problem = Problem::read(&definition, &limits).expect("a problem");
        let parts = Parts::of(&problem).expect("steps");
        let steps: Vec<Step<'_>> = parts
            .substeps
            .iter()
            .map(|step| Step {
                fraction: &step.fraction,
                method: 0,
                adjoint: step.method == 1,
            })
            .collect();
        (1..=9)
            .filter(|&order| has_order(&steps, &[symmetric], order).is_some())
            .collect()
    }

    #[test]
    fn orders_are_those_of_the_books_and_no_higher() {
        for (definition, symmetric, order) in [
            ("base: gauss-1, weights: triple_jump(4)", true, 4),
            ("base: gauss-1, weights: suzuki(4)", true, 4),
            ("base: gauss-1, weights: triple_jump(6)", true, 6),
            ("base: lobatto-2, weights: triple_jump(8)", true, 8),
            // Two equal steps, and two whose fractions do not sum to 1.
            (
                "compose: [[1/2, basis: polynomial(1), nodes: gauss(1)], [1/2, basis: polynomial(1), nodes: gauss(1)]]",
                true,
                2,
            ),
            (
                "compose: [[1/2, basis: polynomial(1), nodes: gauss(1)], [1/3, basis: polynomial(1), nodes: gauss(1)]]",
                true,
                0,
            ),
            // A method that is not symmetric, alone, and with its adjoint.
            ("base: gauss-1, weights: triple_jump(4)", false, 1),
            ("base: [basis: 1, nodes: 0], weights: [1/2, 1/2]", false, 1),
            (
                "base: [basis: 1, nodes: 0], weights: [1/2, adjoint(1/2)]",
                false,
                2,
            ),
            (
                "base: [basis: 1, nodes: 0], weights: [adjoint(1/4), 1/4, adjoint(1/4), 1/4]",
                false,
                2,
            ),
            (
                "base: [base: [basis: 1, nodes: 0], weights: [1/2, adjoint(1/2)]], weights: triple_jump(6)",
                false,
                6,
            ),
        ] {
            assert_eq!(
                orders(definition, symmetric),
                (1..=order).collect::<Vec<_>>(),
                "{definition}"
            );
        }
    }
}
