//! The order conditions of a splitting as polynomials in its coefficients, with their derivatives.
//!
//! A step with the argument `x` is `exp(x·l)` for a letter `l` of a splitting, or `exp(Σ_l x^{|l|} l)` for a
//! basic method, where `|l|` is the degree of `l`. The coefficient of a word `u` with `m` letters in it is
//!
//! ```text
//! [u] = x^|u|/m!      (for a letter: if all letters of u are that letter, else 0 for m > 0),
//! ```
//!
//! A gradient kick is `exp(xB) exp(yC)` with `C = [B, [A, B]] = 2BAB − ABB − BBA`, where `[B, C]` vanishes for quadratic `T`. In
//! `exp(yC)` the coefficient of a word of `3m` letters is `yᵐ/m!` times the product of the coefficients of its threes in `C`. It is
//! determined modulo the ideal of [`super::nystrom`] only, on which the linear forms of the conditions vanish.
//!
//! and that of a word `w` in the product of the steps is the sum over all ways to cut `w` into as many blocks,
//! possibly empty, as there are steps. Prefixes of `w` in the product of the first `i` steps, and suffixes in the product
//! of the others, are computed step by step. Together they give the derivative with respect to the argument of each step.

use std::borrow::Cow;
use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::conditions::{Condition, Conditions};
use super::lyndon::{DRIFT, KICK};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::ratio;

/// One factor of the product.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// The exponent.
    pub kind: Kind,
    /// The index of its argument.
    pub argument: usize,
    /// Whether it takes minus its argument: the inverse of the step of a letter, or of a symmetric basic method.
    pub negative: bool,
}

impl Step {
    /// A step with its argument.
    pub fn new(kind: Kind, argument: usize) -> Self {
        Step {
            kind,
            argument,
            negative: false,
        }
    }

    /// The inverse step.
    pub fn inverse(self) -> Self {
        Step {
            negative: !self.negative,
            ..self
        }
    }

    /// Adds the product of two entries, the second of this degree for the argument, to a sum: with the sign of the step.
    fn add(self, sum: &Interval, x: &Interval, y: &Interval, degree: usize) -> Interval {
        let product = x.multiply(y);
        match self.negative && degree % 2 == 1 {
            true => sum.subtract(&product),
            false => sum.add(&product),
        }
    }
}

/// The exponent of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// One letter.
    Letter(u8),
    /// All letters: a basic method.
    Base,
    /// `[B, [A, B]]`: what a gradient kick adds to a kick.
    Gradient,
}

/// The coefficient of a block in a step with the argument `x`: `factor x^power/of!`.
struct Block {
    power: usize,
    of: usize,
    factor: i64,
}

/// The order conditions of a product of steps.
#[derive(Debug, Clone)]
pub struct System {
    /// The steps.
    pub steps: Vec<Step>,
    /// The conditions on their product.
    pub conditions: Conditions,
    /// Conditions on another product of the same arguments.
    pub beside: Option<Box<System>>,
}

/// A linear condition, `Σ_j m_j x_j = w`: the kicks, the drifts or the weights sum to 1.
#[derive(Debug, Clone)]
pub struct Sum {
    /// Arguments with their multiplicities.
    terms: BTreeMap<usize, i64>,
    wanted: BigRational,
}

impl Sum {
    /// If an argument is the last one that is not known: the others with their factors, and the constant, of which it is the sum.
    pub fn last_of(
        &self,
        argument: usize,
        is_known: impl Fn(usize) -> bool,
    ) -> Option<(Vec<(usize, BigRational)>, BigRational)> {
        let (&last, &count) = self.terms.iter().rfind(|(index, _)| !is_known(**index))?;
        let others = self.terms.iter().filter(|(index, _)| **index != last);
        let others = others.map(|(index, other)| (*index, ratio(-other, count)));
        (last == argument).then(|| (others.collect(), &self.wanted / ratio(count, 1)))
    }

    /// The argument that is determined by the others, if all of these are known.
    pub fn missing(&self, known: &[Option<BigRational>]) -> Option<(usize, BigRational)> {
        let mut unknown = self
            .terms
            .iter()
            .filter(|(index, _)| known[**index].is_none());
        let (argument, count) = unknown.next()?;
        if unknown.next().is_some() {
            return None;
        }
        let others = self.terms.iter().filter_map(|(index, count)| {
            let value = known[*index].as_ref()?;
            Some(value * ratio(*count, 1))
        });
        let rest = others.fold(self.wanted.clone(), |rest, value| rest - value);
        Some((*argument, rest / ratio(*count, 1)))
    }
}

/// `x^n/m!` for an argument `x`: the coefficients of blocks.
struct Powers {
    /// The entries by `n` and `m`.
    entries: Vec<Vec<Interval>>,
    /// The derivatives `n x^{n−1}/m!`.
    derivatives: Vec<Vec<Interval>>,
}

impl Powers {
    fn new(x: &Interval, length: usize) -> Self {
        let one = BigRational::one();
        let mut powers = vec![Interval::enclosing(&one, x.bits())];
        for n in 1..=length {
            powers.push(powers[n - 1].multiply(x));
        }
        let factorials: Vec<BigInt> = (0..=length)
            .map(|m| (1..=m).fold(BigInt::one(), |product, k| product * k))
            .collect();
        let scaled = |power: &Interval, n: usize, from: usize| -> Vec<Interval> {
            let factor = |m: &BigInt| BigRational::new(n.into(), m.clone());
            let entries = factorials[..=from].iter();
            entries.map(|m| power.scale(&factor(m))).collect()
        };
        Powers {
            entries: (0..=length).map(|n| scaled(&powers[n], 1, n)).collect(),
            derivatives: (0..=length)
                .map(|n| scaled(&powers[n.saturating_sub(1)], n, n))
                .collect(),
        }
    }
}

impl Block {
    /// The coefficient, from the powers of the argument or their derivatives.
    fn of<'p>(&self, powers: &'p [Vec<Interval>]) -> Cow<'p, Interval> {
        let entry = &powers[self.power][self.of];
        match self.factor {
            1 => Cow::Borrowed(entry),
            factor => Cow::Owned(entry.scale(&ratio(factor, 1))),
        }
    }
}

impl System {
    /// The coefficient of a block in a step, if it is nonzero.
    fn block(&self, step: Step, block: &[u8]) -> Option<Block> {
        let of = block.len();
        match step.kind {
            Kind::Letter(own) => block.iter().all(|&l| l == own).then_some(Block {
                power: of,
                of,
                factor: 1,
            }),
            Kind::Base => Some(Block {
                power: self.conditions.alphabet().degree(block),
                of,
                factor: 1,
            }),
            Kind::Gradient => {
                let threes = block.chunks(3).map(|three| match *three {
                    [KICK, DRIFT, KICK] => Some(2),
                    [DRIFT, KICK, KICK] | [KICK, KICK, DRIFT] => Some(-1),
                    _ => None,
                });
                Some(Block {
                    power: of / 3,
                    of: of / 3,
                    factor: threes.product::<Option<i64>>()?,
                })
            }
        }
    }

    /// The conditions on a product of steps.
    pub fn new(steps: Vec<Step>, conditions: Conditions) -> Self {
        System {
            steps,
            conditions,
            beside: None,
        }
    }

    /// All conditions, those on the other product last.
    pub fn all(&self) -> impl Iterator<Item = &Condition> {
        let beside = self.beside.iter().flat_map(|x| x.conditions.conditions());
        self.conditions.conditions().iter().chain(beside)
    }

    /// The conditions of degree 1 with a single letter.
    pub fn linear_conditions(&self) -> Vec<Sum> {
        let conditions = self.conditions.conditions().iter();
        let linear = conditions.filter_map(|condition| match &*condition.terms {
            [(word, factor)] if condition.degree == 1 && factor.is_one() => {
                Some((&self.conditions.words()[*word], &condition.wanted))
            }
            _ => None,
        });
        let beside = self.beside.iter().flat_map(|x| x.linear_conditions());
        linear
            .map(|(word, wanted)| {
                let mut terms = BTreeMap::new();
                for step in &self.steps {
                    if self
                        .block(*step, word)
                        .is_some_and(|block| block.power == 1)
                    {
                        let sign = if step.negative { -1 } else { 1 };
                        *terms.entry(step.argument).or_insert(0) += sign;
                    }
                }
                // Those of a step and of its inverse cancel.
                terms.retain(|_, count| *count != 0);
                Sum {
                    terms,
                    wanted: wanted.clone(),
                }
            })
            .chain(beside)
            .collect()
    }

    fn longest(&self) -> usize {
        let conditions = self.conditions.conditions().iter();
        conditions.map(|c| c.degree).max().unwrap_or(0)
    }

    /// The combination of the values of words in a condition, minus the wanted value if `wanted`.
    fn combined(&self, condition: &Condition, words: &[Interval], wanted: bool) -> Interval {
        let bits = words.first().map_or(0, Interval::bits);
        let start = if wanted {
            -&condition.wanted
        } else {
            BigRational::zero()
        };
        let start = Interval::enclosing(&start, bits);
        condition.terms.iter().fold(start, |sum, (word, factor)| {
            if factor.is_one() {
                sum.add(&words[*word])
            } else {
                sum.add(&words[*word].scale(factor))
            }
        })
    }

    /// Enclosures of the residuals of all conditions for all arguments in a box.
    pub fn residuals(&self, arguments: &[Interval]) -> Vec<Interval> {
        let length = self.longest();
        let powers: Vec<Powers> = arguments.iter().map(|x| Powers::new(x, length)).collect();
        let bits = arguments.first().map_or(0, Interval::bits);
        let value = |word: &Vec<u8>| {
            let prefixes = self.prefixes(word, &powers, bits);
            prefixes[self.steps.len()][word.len()].clone()
        };
        let words: Vec<Interval> = self.conditions.words().iter().map(value).collect();
        let conditions = self.conditions.conditions().iter();
        let own = conditions.map(|c| self.combined(c, &words, true));
        let beside = self.beside.iter().flat_map(|x| x.residuals(arguments));
        own.chain(beside).collect()
    }

    /// Enclosures of the derivatives of all conditions with respect to some arguments, for all arguments in a box.
    pub fn derivatives(&self, arguments: &[Interval], by: &[usize]) -> Vec<Vec<Interval>> {
        let length = self.longest();
        let powers: Vec<Powers> = arguments.iter().map(|x| Powers::new(x, length)).collect();
        let bits = arguments.first().map_or(0, Interval::bits);
        let gradients: Vec<Vec<Interval>> = {
            let words = self.conditions.words().iter();
            words
                .map(|word| self.gradient(word, &powers, by, bits))
                .collect()
        };
        let row = |condition: &Condition| -> Vec<Interval> {
            let entry = |column: usize| {
                let mut sum = zero(bits);
                for (word, factor) in &condition.terms {
                    sum = sum.add(&gradients[*word][column].scale(factor));
                }
                sum
            };
            (0..by.len()).map(entry).collect()
        };
        let own = self.conditions.conditions().iter().map(row);
        let beside = self.beside.iter();
        own.chain(beside.flat_map(|x| x.derivatives(arguments, by)))
            .collect()
    }

    /// The coefficients of the prefixes of a word in the products of the first 0, 1, … steps.
    fn prefixes(&self, word: &[u8], powers: &[Powers], bits: u32) -> Vec<Vec<Interval>> {
        let mut current = vec![zero(bits); word.len() + 1];
        current[0] = Interval::enclosing(&BigRational::one(), bits);
        let mut all = vec![current.clone()];
        for &step in &self.steps {
            let powers = &powers[step.argument];
            // From the end, so that the shorter prefixes do not include this step yet.
            for end in (1..=word.len()).rev() {
                for start in (0..end).rev() {
                    let Some(block) = self.block(step, &word[start..end]) else {
                        if step.kind == Kind::Gradient {
                            continue;
                        }
                        break;
                    };
                    if !is_zero(&current[start]) {
                        let entry = block.of(&powers.entries);
                        current[end] =
                            step.add(&current[end], &current[start], &entry, block.power);
                    }
                }
            }
            all.push(current.clone());
        }
        all
    }

    /// The derivatives of the coefficient of a word with respect to some arguments.
    fn gradient(&self, word: &[u8], powers: &[Powers], by: &[usize], bits: u32) -> Vec<Interval> {
        let prefixes = self.prefixes(word, powers, bits);
        let mut gradient = vec![zero(bits); by.len()];
        // The coefficients of the suffixes word[start..] in the product of the steps after this one.
        let mut suffixes = vec![zero(bits); word.len() + 1];
        suffixes[word.len()] = Interval::enclosing(&BigRational::one(), bits);
        for (index, &step) in self.steps.iter().enumerate().rev() {
            let own = &powers[step.argument];
            let column = by.iter().position(|&argument| argument == step.argument);
            for start in 0..word.len() {
                let mut derivative = zero(bits);
                for end in start + 1..=word.len() {
                    let Some(block) = self.block(step, &word[start..end]) else {
                        if step.kind == Kind::Gradient {
                            continue;
                        }
                        break;
                    };
                    if is_zero(&suffixes[end]) {
                        continue;
                    }
                    if column.is_some() {
                        let entry = block.of(&own.derivatives);
                        derivative = step.add(&derivative, &suffixes[end], &entry, block.power);
                    }
                    let entry = block.of(&own.entries);
                    suffixes[start] =
                        step.add(&suffixes[start], &suffixes[end], &entry, block.power);
                }
                if let Some(column) = column {
                    let prefix = &prefixes[index][start];
                    gradient[column] = gradient[column].add(&prefix.multiply(&derivative));
                }
            }
        }
        gradient
    }

    /// Whether all conditions hold for rational arguments, in exact arithmetic.
    pub fn holds_exactly(&self, arguments: &[BigRational]) -> bool {
        // Enclosures refute false conditions faster.
        let enclosed: Vec<Interval> = arguments
            .iter()
            .map(|x| Interval::enclosing(x, 256))
            .collect();
        let zero = BigRational::zero();
        if !self.residuals(&enclosed).iter().all(|r| r.contains(&zero)) {
            return false;
        }
        let values: Vec<BigRational> = {
            let words = self.conditions.words().iter();
            words.map(|word| self.exact(word, arguments)).collect()
        };
        let own = self.conditions.conditions().iter().all(|condition| {
            let terms = condition.terms.iter();
            let sum = terms.fold(BigRational::zero(), |sum, (word, factor)| {
                sum + factor * &values[*word]
            });
            sum == condition.wanted
        });
        let beside = self.beside.as_ref();
        own && beside.is_none_or(|x| x.holds_exactly(arguments))
    }

    fn exact(&self, word: &[u8], arguments: &[BigRational]) -> BigRational {
        let mut current = vec![BigRational::zero(); word.len() + 1];
        current[0] = BigRational::one();
        for &step in &self.steps {
            let x = &arguments[step.argument];
            for end in (1..=word.len()).rev() {
                for start in (0..end).rev() {
                    let Some(block) = self.block(step, &word[start..end]) else {
                        if step.kind == Kind::Gradient {
                            continue;
                        }
                        break;
                    };
                    let factorial: BigInt = (1..=block.of).fold(BigInt::one(), |n, k| n * k);
                    let x = if step.negative { -x } else { x.clone() };
                    let power = num_traits::pow(x, block.power);
                    let value = power * BigRational::new(block.factor.into(), factorial);
                    let added = &current[start] * value;
                    current[end] += added;
                }
            }
        }
        current.pop().unwrap_or_else(BigRational::zero)
    }
}

fn zero(bits: u32) -> Interval {
    Interval {
        low: BigInt::zero(),
        high: BigInt::zero(),
        bits,
    }
}

fn is_zero(interval: &Interval) -> bool {
    interval.low.is_zero() && interval.high.is_zero()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use crate::certify::conditions::Claim;
    use crate::certify::lyndon::{DRIFT, KICK};

    /// Three steps, kick, drift, kick; the first and the last have different arguments.
    fn system(claim: Claim, kinds: &[Kind]) -> System {
        let step = |(argument, &kind)| Step::new(kind, argument);
        let steps = kinds.iter().enumerate().map(step).collect();
        System::new(steps, Conditions::new(&claim, false).expect("a claim"))
    }

    fn splitting() -> System {
        let kinds = [Kind::Letter(KICK), Kind::Letter(DRIFT), Kind::Letter(KICK)];
        system(Claim::Separable(3), &kinds)
    }

    /// `exp(k₁B) exp(d₁A) exp(k₂B)`, by hand: `[AB] = d₁k₂`, `[AAB] = d₁²k₂/2`, `[ABB] = d₁k₂²/2`.
    #[test]
    fn coefficients_of_words_are_those_found_by_hand() {
        let system = splitting();
        let arguments = [ratio(1, 3), ratio(5, 7), ratio(2, 11)];
        let value = |word: &[u8]| system.exact(word, &arguments);
        assert_eq!(value(&[0]), ratio(5, 7));
        assert_eq!(value(&[1]), ratio(1, 3) + ratio(2, 11));
        assert_eq!(value(&[0, 1]), ratio(5 * 2, 77));
        assert_eq!(value(&[1, 0]), ratio(5, 21));
        assert_eq!(value(&[0, 0, 1]), ratio(25, 49) * ratio(1, 11));
        assert_eq!(value(&[0, 1, 1]), ratio(5, 7) * ratio(2, 121));
        assert_eq!(
            value(&[1, 1]),
            num_traits::pow(value(&[1]), 2) * ratio(1, 2)
        );
    }

    /// `exp(kB) exp(yC) exp(dA)` with `C = 2BAB − ABB − BBA`, by hand: a gradient kick, then a drift.
    #[test]
    fn coefficients_of_gradient_kicks_are_those_found_by_hand() {
        let kinds = [Kind::Letter(KICK), Kind::Gradient, Kind::Letter(DRIFT)];
        let system = system(Claim::Nystrom(4), &kinds);
        let (k, y, d) = (ratio(1, 3), ratio(-2, 7), ratio(5, 11));
        let arguments = [k.clone(), y.clone(), d.clone()];
        let value = |word: &[u8]| system.exact(word, &arguments);
        assert_eq!(value(&[1, 0, 1]), &y * ratio(2, 1));
        assert_eq!(value(&[0, 1, 1]), -&y);
        assert_eq!(value(&[1, 1, 0]), -&y + &k * &k * &d * ratio(1, 2));
        assert_eq!(value(&[1, 0, 1, 0]), &y * &d * ratio(2, 1));
        assert_eq!(value(&[1, 1, 0, 1]), &k * &y * ratio(2, 1));
        assert_eq!(value(&[1, 0, 1, 0, 1, 1]), -(&y * &y));
        assert_eq!(value(&[1, 0, 0]), &k * &d * &d * ratio(1, 2));
    }

    /// `exp(xE₁ + x³E₃) exp(yE₁ + y³E₃)`, by hand.
    #[test]
    fn coefficients_of_compositions_are_those_found_by_hand() {
        let system = system(Claim::SymmetricBase(4), &[Kind::Base, Kind::Base]);
        let (x, y) = (ratio(2, 3), ratio(-3, 5));
        let arguments = [x.clone(), y.clone()];
        let cube = |x: &BigRational| num_traits::pow(x.clone(), 3);
        let fourth = |x: &BigRational| num_traits::pow(x.clone(), 4);
        let wanted = (fourth(&x) + fourth(&y)) * ratio(1, 2) + &x * cube(&y);
        assert_eq!(system.exact(&[0, 1], &arguments), wanted);
    }

    /// Enclosures contain the exact residuals, and the derivatives are quotients of differences.
    #[test]
    fn enclosures_agree_with_exact_arithmetic() {
        let exact = [ratio(1, 3), ratio(5, 7), ratio(2, 11)];
        let kinds = [Kind::Base; 3];
        let gradient = [Kind::Gradient, Kind::Letter(DRIFT), Kind::Letter(KICK)];
        for system in [
            splitting(),
            system(Claim::SymmetricBase(5), &kinds),
            system(Claim::Nystrom(6), &gradient),
        ] {
            let boxed = |values: &[BigRational]| -> Vec<Interval> {
                values.iter().map(|x| Interval::enclosing(x, 200)).collect()
            };
            let residuals = system.residuals(&boxed(&exact));
            let by = [2, 0];
            let derivatives = system.derivatives(&boxed(&exact), &by);
            for (row, condition) in system.conditions.conditions().iter().enumerate() {
                let value = |arguments: &[BigRational]| {
                    let terms = condition.terms.iter();
                    terms.fold(-&condition.wanted, |sum, (word, factor)| {
                        sum + factor * system.exact(&system.conditions.words()[*word], arguments)
                    })
                };
                assert!(residuals[row].contains(&value(&exact)));
                assert!(residuals[row].width_bits() < -180);
                for (column, &argument) in by.iter().enumerate() {
                    // Central differences with steps δ and 2δ differ from the derivative by O(δ²).
                    let delta = ratio(1, 1 << 40);
                    let mut moved = exact.clone();
                    moved[argument] += &delta;
                    let above = value(&moved);
                    moved[argument] -= &delta + &delta;
                    let quotient = (above - value(&moved)) / (&delta + &delta);
                    let error =
                        derivatives[row][column].subtract(&Interval::enclosing(&quotient, 200));
                    assert!(error.magnitude_bits() < -70, "{}", error.magnitude_bits());
                }
            }
        }
    }
}
