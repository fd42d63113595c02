//! The numbers `(m + n√d)/k` that decimals round.
//!
//! They are a guess: the resulting table is proved or refuted afterwards.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::{Cell, read::Table};

/// The largest `d`, `k` and `|n|`.
const MAX_RADICAND: i128 = 110;
const MAX_DENOMINATOR: i128 = 5040;
const MAX_MULTIPLE: i128 = 128;
/// Binary places: with the bounds above and on entries, no number exceeds 127 bits.
const PLACES: u32 = 96;
/// Decimals with fewer places are not reliable enough.
const MIN_PLACES: u32 = 9;

/// A decimal, scaled by `2^PLACES`, and a bound on its distance from the exact number.
#[derive(Clone, Copy)]
struct Scaled {
    value: i128,
    half: i128,
}

fn scaled(value: &BigRational) -> Option<i128> {
    let unit = BigRational::from_integer(BigInt::from(1) << PLACES);
    (value * unit).round().to_integer().to_i128()
}

impl Scaled {
    fn of(cell: &Cell) -> Option<Self> {
        if cell.printed.places()? < MIN_PLACES {
            return None;
        }
        Some(Scaled {
            value: scaled(cell.printed.value())?,
            half: scaled(&cell.printed.half_unit())?,
        })
    }

    /// The number with the smallest denominator that rounds to this one, for a root `√d`.
    fn surd(self, radicand: i128, root: i128) -> Option<String> {
        let one = 1i128 << PLACES;
        // Pairs (k, n) are limited so that one in a hundred decimals is near such a number by chance: the fewer digits, the fewer
        // pairs.
        let pairs = one / (100 * 4 * MAX_MULTIPLE * self.half.max(1));
        for k in (1..=MAX_DENOMINATOR).take_while(|k| k * k <= pairs) {
            let value = self.value.checked_mul(k)?;
            // The round-off of the value and of n roots.
            let slack = self.half * k + k + MAX_MULTIPLE;
            let (mut up, mut down) = (value + slack, value + slack);
            for n in 1..=MAX_MULTIPLE {
                up -= root;
                down += root;
                for (shifted, n) in [(up, n), (down, -n)] {
                    if shifted & (one - 1) <= 2 * slack {
                        let m = shifted >> PLACES;
                        return Some(format!("({m} + ({n})*sqrt({radicand}))/{k}"));
                    }
                }
            }
        }
        None
    }
}

/// The text from which the table is derived, for each cell: fractions, and surds with one common root.
pub(super) fn recognised(table: &Table) -> Option<Vec<String>> {
    let simple = |cell: &Cell| cell.printed.simple();
    let rational = table.cells.iter().map(simple);
    let rational: Vec<Option<String>> = rational.map(|x| x.map(|x| format!("({x})"))).collect();
    let others = table.cells.iter().zip(&rational);
    let others = others.filter(|(_, text)| text.is_none());
    let others: Option<Vec<Scaled>> = others.map(|(cell, _)| Scaled::of(cell)).collect();
    let surds = surds(&others?)?;
    let mut surds = surds.into_iter();
    let texts = rational.into_iter();
    texts.map(|text| text.or_else(|| surds.next())).collect()
}

fn surds(numbers: &[Scaled]) -> Option<Vec<String>> {
    if numbers.is_empty() {
        return Some(Vec::new());
    }
    let squarefree = |d: &i128| {
        (2..=*d)
            .take_while(|f| f * f <= *d)
            .all(|f| d % (f * f) != 0)
    };
    (2..=MAX_RADICAND).filter(squarefree).find_map(|d| {
        let square = BigInt::from(d) << (2 * PLACES);
        let root = square.sqrt().to_i128()?;
        numbers.iter().map(|number| number.surd(d, root)).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::{Signed, Zero};

    fn found(texts: &[&str]) -> Option<Vec<String>> {
        let number = |text: &&str| {
            let printed = symplectic_compiler::certify::Printed::parse(text).expect("a number");
            let value = printed.value().clone();
            assert!(!value.is_zero() && value.abs() < BigRational::from_integer(1000.into()));
            Scaled {
                value: scaled(&value).expect("small"),
                half: scaled(&printed.half_unit()).expect("small"),
            }
        };
        let numbers: Vec<Scaled> = texts.iter().map(number).collect();
        surds(&numbers)
    }

    #[test]
    #[ignore = "thorough"]
    fn entries_are_recognised_as_surds_with_one_common_root() {
        // (3 + √3)/6 and −√3/3.
        let crouzeix = found(&["0.788675134595", "-0.577350269190"]).expect("surds");
        assert_eq!(crouzeix, ["(3 + (1)*sqrt(3))/6", "(0 + (-1)*sqrt(3))/3"]);
        // Lobatto IIIC with five stages.
        let lobatto = found(&["0.281309183323043", "-0.052836961100821"]).expect("surds");
        assert_eq!(lobatto[0], "(329 + (105)*sqrt(21))/2880");
        // √2/2 is in another field, and 0.788675134605 is not a surd of this form.
        assert!(found(&["0.788675134594813", "0.707106781186548"]).is_none());
        assert!(found(&["0.788675134594913", "-0.577350269189626"]).is_none());
    }
}
