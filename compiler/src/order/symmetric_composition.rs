//! The order of compositions of any symmetric method of order 2, for all systems.
//!
//! The logarithm of a symmetric map is `hE₁ + h³E₃ + h⁵E₅ + ⋯`, so a composition with the fractions `γ_1, …, γ_m` is
//! `∏ exp(γ_i hE₁ + γ_i³h³E₃ + ⋯)`. It has order p iff the coefficients of all Lyndon words over `E₁, E₃, …` up to the degree p are those
//! of `exp(hE₁)`: see [`Conditions`](crate::certify::Conditions).

use num_rational::BigRational;

use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::ratio;
use crate::certify::Alphabet;
use crate::symbolic::Constant;

/// Binary places of the enclosures in which the conditions are verified.
const BITS: u32 = 512;

/// Whether a composition with these fractions of any symmetric method of order 2 has this order.
pub(crate) fn has_order(fractions: &[Constant], order: usize) -> bool {
    let enclosed = fractions.iter().map(|fraction| fraction.enclose(BITS));
    let Some(fractions) = enclosed.collect::<Option<Vec<Interval>>>() else {
        return false;
    };
    let alphabet = Alphabet::symmetric_base(order);
    let words = (1..=order).flat_map(|degree| alphabet.lyndon(degree));
    words.into_iter().all(|word| {
        let degrees: Vec<usize> = word.iter().map(|&l| alphabet.degree_of(l)).collect();
        let wanted = ratio(i64::from(degrees == [1]), 1);
        coefficient(&degrees, &fractions).contains(&wanted)
    })
}

/// The coefficient of a word of letters of these degrees.
fn coefficient(degrees: &[usize], fractions: &[Interval]) -> Interval {
    let constant = |value: &BigRational| Interval::enclosing(value, BITS);
    // The coefficients of the word's prefixes in the product of the factors so far.
    let mut known = vec![constant(&ratio(0, 1)); degrees.len() + 1];
    known[0] = constant(&ratio(1, 1));
    for fraction in fractions {
        for end in (1..=degrees.len()).rev() {
            let (mut power, mut factorial) = (0, 1);
            for start in (0..end).rev() {
                power += degrees[start];
                factorial *= (end - start) as i64;
                let factor = fraction.power(power as u32).scale(&ratio(1, factorial));
                known[end] = known[end].add(&known[start].multiply(&factor));
            }
        }
    }
    known.swap_remove(degrees.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::definition::Definition;
    use crate::derive::parts;

    fn orders(definition: &str) -> Vec<usize> {
        let definition = Definition::parse(definition).expect(definition);
        let substeps = parts(&definition).expect("steps").substeps;
        let fractions: Vec<Constant> = substeps.into_iter().map(|step| step.fraction).collect();
        (1..=9)
            .filter(|&order| has_order(&fractions, order))
            .collect()
    }

    #[test]
    fn orders_are_those_of_the_books_and_no_higher() {
        for (definition, order) in [
            ("base: gauss-1, weights: triple_jump(4)", 4),
            ("base: gauss-1, weights: suzuki(4)", 4),
            ("base: gauss-1, weights: triple_jump(6)", 6),
            ("base: lobatto-2, weights: triple_jump(8)", 8),
            // Two equal steps, and two whose fractions do not sum to 1.
            (
                "compose: [[1/2, basis: polynomial(1), nodes: gauss(1)], [1/2, basis: polynomial(1), nodes: gauss(1)]]",
                2,
            ),
            (
                "compose: [[1/2, basis: polynomial(1), nodes: gauss(1)], [1/3, basis: polynomial(1), nodes: gauss(1)]]",
                0,
            ),
        ] {
            assert_eq!(
                orders(definition),
                (1..=order).collect::<Vec<_>>(),
                "{definition}"
            );
        }
    }
}
