//! The proof that order conditions have a solution near given decimals, for Krawczyk's test: the conditions, a box around the solution,
//! and an approximate inverse of the derivative.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed};

use symplectic_compiler::algebra::Rationals;
use symplectic_compiler::certify::{Claim, Conditions, Word};
use symplectic_compiler::inside::Fact;
use symplectic_compiler::inside::one_of_each_rooting;
use symplectic_compiler::inside::{Affine, DRIFT, KICK, Kind, Step, System, inverse};
use symplectic_compiler::inside::{LowerTriangular, Partitioned};
use symplectic_exact::interval::Interval;

use Fact::{List, Text};

/// The binary places of the solution and of the derivatives there.
pub(super) const BITS: u32 = 512;
/// The binary places of the point where difference quotients are taken, and of their step: the error is far below that of the inverse.
const COARSE: u32 = 128;
/// The decimal places of the ends of the box, which are two units apart,
const BOX_PLACES: u32 = 38;
/// and of the inverse.
const INVERSE_PLACES: u32 = 10;

/// The coefficients as functions of the unknowns, and the conditions for these.
pub(super) struct Solution<'a> {
    pub claim: &'a Claim,
    pub lower_triangular: LowerTriangular,
    pub b: &'a [Affine],
    pub b_tilde: &'a [Affine],
    /// The weights of gradient kicks.
    pub gradient: Option<&'a [Affine]>,
    /// The fractions of a composition of Störmer–Verlet.
    pub weights: Option<&'a [Affine]>,
    /// The conditions of a processed composition, and all their arguments.
    pub processed: Option<(&'a System, &'a [Affine])>,
    /// The unknowns with their enclosures, of [`BITS`] binary places.
    pub unknowns: BTreeMap<usize, Interval>,
}

impl Solution<'_> {
    /// The members of the certificate; `None` if the derivative has no inverse.
    pub(super) fn proof(&self) -> Option<Vec<(&'static str, Fact)>> {
        let mut derivatives = match (self.processed, self.claim) {
            (Some((system, arguments)), _) => self.derivatives_of(system, arguments),
            (None, Claim::Nystrom(order)) => self.derivatives_of_trees(*order),
            (None, _) => self.derivatives_of_words()?,
        };
        // Conditions without unknowns.
        derivatives.retain(|(_, row)| row.iter().any(|x| !is_zero(x)));
        let (names, rows): (Vec<String>, Vec<_>) = derivatives.into_iter().unzip();
        if rows.len() != self.unknowns.len() {
            return None;
        }
        let scale = BigInt::from(10).pow(INVERSE_PLACES);
        let entry = |x: &BigInt| rounded(&BigRational::new(x * &scale, BigInt::one() << BITS));
        let row = |row: &Vec<BigInt>| {
            let entries = row.iter().map(|x| fixed(&entry(x), INVERSE_PLACES));
            List(entries.collect())
        };
        let inverse = inverse(&rows, BITS)?;
        let scale = BigRational::from_integer(BigInt::from(10).pow(BOX_PLACES));
        let edge = |x: &Interval| {
            let middle = rounded(&(x.middle() * &scale));
            List(vec![
                fixed(&(&middle - 1), BOX_PLACES),
                fixed(&(middle + 1), BOX_PLACES),
            ])
        };
        Some(vec![
            ("conditions", List(names.into_iter().map(Text).collect())),
            ("box", List(self.unknowns.values().map(edge).collect())),
            ("inverse", List(inverse.iter().map(row).collect())),
        ])
    }

    /// The Lyndon words of the conditions, and the derivatives by the unknowns of their coefficients times `n!` for `n` letters.
    fn derivatives_of_words(&self) -> Option<Vec<(String, Vec<Interval>)>> {
        let factors: Vec<(Kind, &Affine)> = match self.weights {
            Some(weights) => weights.iter().map(|x| (Kind::Base, x)).collect(),
            None => self.flows(),
        };
        let mut arguments: Vec<&Affine> = Vec::new();
        let mut steps = Vec::new();
        for (kind, x) in factors {
            let known = arguments.iter().position(|y| *y == x);
            let argument = known.unwrap_or(arguments.len());
            if known.is_none() {
                arguments.push(x);
            }
            steps.push(Step::new(kind, argument));
        }
        let symmetric = steps.iter().eq(steps.iter().rev());
        let conditions = Conditions::new(self.claim, symmetric).ok()?;
        let words = conditions.words().to_vec();
        let name = |word: &Word| conditions.alphabet().text(word);
        let names: Vec<String> = words.iter().map(name).collect();
        let values: Vec<Interval> = arguments.iter().map(|x| self.value(x)).collect();
        let all: Vec<usize> = (0..arguments.len()).collect();
        let rows = System::new(steps, conditions).derivatives(&values, &all);
        let row = |(word, row): (&Word, &Vec<Interval>)| {
            let factorial = (1..=word.len()).fold(BigInt::one(), |n, k| n * k);
            let arguments = || arguments.iter().copied();
            let factorial = BigRational::from_integer(factorial);
            let scaled = |x| by(arguments(), row, x).scale(&factorial);
            self.unknowns.keys().map(scaled).collect()
        };
        let rows = words.iter().zip(&rows).map(row);
        Some(names.into_iter().zip(rows).collect())
    }

    /// The same for a processed composition: the words of the whole, and those that vanish in the processor. That its weights sum to 0 is no
    /// condition on the unknowns.
    fn derivatives_of(
        &self,
        system: &System,
        arguments: &[Affine],
    ) -> Vec<(String, Vec<Interval>)> {
        let words = |system: &System, prefix: &str| -> Vec<(String, usize)> {
            let alphabet = system.conditions.alphabet();
            let word = |word: &Word| (format!("{prefix}{}", alphabet.text(word)), word.len());
            system.conditions.words().iter().map(word).collect()
        };
        let of_whole = words(system, "");
        let linear = of_whole.len();
        let of_processor = system.beside.iter().flat_map(|x| words(x, "processor "));
        let names = of_whole.into_iter().chain(of_processor);
        let values: Vec<Interval> = arguments.iter().map(|x| self.value(x)).collect();
        let all: Vec<usize> = (0..arguments.len()).collect();
        let rows = system.derivatives(&values, &all);
        let named = names.zip(&rows).enumerate();
        let named = named.filter(|(index, _)| *index != linear);
        named
            .map(|(_, ((name, length), row))| {
                let factorial = (1..=length).fold(BigInt::one(), |n, k| n * k);
                let factorial = BigRational::from_integer(factorial);
                let unknowns = self.unknowns.keys();
                let row = unknowns.map(|x| by(arguments.iter(), row, x).scale(&factorial));
                (name, row.collect())
            })
            .collect()
    }

    /// One tree for all its rootings, and the difference quotients of its elementary weight by the unknowns.
    fn derivatives_of_trees(&self, order: usize) -> Vec<(String, Vec<Interval>)> {
        let step = BigRational::new(BigInt::one(), BigInt::one() << COARSE);
        let point = self.unknowns.iter();
        let point: BTreeMap<usize, BigRational> = point
            .map(|(index, x)| (*index, x.with_bits(COARSE).low()))
            .collect();
        let symmetric = self.flows().iter().eq(self.flows().iter().rev())
            && self.gradient.is_none_or(|gradient| {
                let zero = Affine::rational(BigRational::default());
                // In the order of the flows there is one gradient weight for each kick.
                let kicks = gradient.iter().zip(self.b_tilde);
                let kicks = kicks.filter(|(g, kick)| **g != zero || **kick != zero);
                kicks.clone().eq(kicks.rev())
            });
        let residuals = |point: &BTreeMap<usize, BigRational>| {
            let at = |x: &Affine| {
                let terms = x.factors.iter();
                terms.fold(x.constant.clone(), |sum, (index, factor)| {
                    sum + factor * &point[index]
                })
            };
            let list = |list: &[Affine]| -> Vec<BigRational> { list.iter().map(at).collect() };
            let (b, b_tilde) = (list(self.b), list(self.b_tilde));
            let pair = Partitioned {
                gradient: self.gradient.map(list),
                ..Partitioned::of_splitting(Rationals, self.lower_triangular, b, b_tilde)
            };
            one_of_each_rooting(&pair, (1..=order).step_by(if symmetric { 2 } else { 1 }))
        };
        let here = residuals(&point);
        let columns: Vec<_> = self
            .unknowns
            .keys()
            .map(|index| {
                let mut moved = point.clone();
                moved.entry(*index).and_modify(|x| *x += &step);
                residuals(&moved)
            })
            .collect();
        let quotient = |k: usize| {
            let column = |there: &Vec<(_, BigRational)>| {
                let difference = &there[k].1 - &here[k].1;
                Interval::enclosing(&(difference / &step), BITS)
            };
            columns.iter().map(column).collect()
        };
        let row = |(k, (tree, _)): (usize, &(_, _))| (ToString::to_string(tree), quotient(k));
        here.iter().enumerate().map(row).collect()
    }

    /// The flows in sequence, without those of zero length.
    fn flows(&self) -> Vec<(Kind, &Affine)> {
        let [drift, kick] = [Kind::Letter(DRIFT), Kind::Letter(KICK)];
        let each =
            self.b
                .iter()
                .zip(self.b_tilde)
                .flat_map(|(b, b_tilde)| match self.lower_triangular {
                    LowerTriangular::KicksFirst => [(kick, b_tilde), (drift, b)],
                    LowerTriangular::DriftsFirst => [(drift, b), (kick, b_tilde)],
                });
        let zero = Affine::rational(BigRational::default());
        each.filter(|(_, x)| **x != zero).collect()
    }

    fn value(&self, x: &Affine) -> Interval {
        let terms = x.factors.iter();
        terms.fold(
            Interval::enclosing(&x.constant, BITS),
            |sum, (index, factor)| match self.unknowns.get(index) {
                Some(value) => sum.add(&value.scale(factor)),
                None => sum,
            },
        )
    }
}

/// The derivative by an unknown of which the arguments are functions, from those by the arguments.
fn by<'a>(
    arguments: impl Iterator<Item = &'a Affine>,
    row: &[Interval],
    unknown: &usize,
) -> Interval {
    let zero = Interval::enclosing(&BigRational::default(), BITS);
    let terms = arguments.zip(row);
    terms.fold(zero, |sum, (x, derivative)| match x.factors.get(unknown) {
        Some(factor) => sum.add(&derivative.scale(factor)),
        None => sum,
    })
}

fn is_zero(x: &Interval) -> bool {
    *x == Interval::enclosing(&BigRational::default(), x.bits())
}

/// The nearest whole number.
fn rounded(x: &BigRational) -> BigInt {
    x.round().to_integer()
}

/// `units·10⁻ᵖˡᵃᶜᵉˢ` with all its decimal places.
fn fixed(units: &BigInt, places: u32) -> Fact {
    let places = places as usize;
    let digits = format!("{:0>1$}", units.abs().to_string(), places + 1);
    let (whole, rest) = digits.split_at(digits.len() - places);
    let sign = if units.is_negative() { "-" } else { "" };
    Text(format!("{sign}{whole}.{rest}"))
}
