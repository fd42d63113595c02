//! Chooses the values of the coefficients that the conditions leave free, within their last places, so that all others
//! round to their prints too.
//!
//! The exact methods near the digits form a manifold. Let `F` be the conditions. Newton's iteration solves them for the unknowns
//! `B`, one for each condition, and keeps the other unknowns `N` fixed. A shift `y` of `N` moves the printed number `i`, a linear form
//! `L_i` of the unknowns, along the manifold by
//!
//! ```text
//! A_i y = (L_iN − L_iB F_B⁻¹ F_N) y.
//! ```
//!
//! [`minimax`] finds the shift that brings all of them nearest to their prints, each measured by its own last place.
//! Newton's iteration leads back to the manifold. This repeats until all round to their prints or no shift can help.
//!
//! **No method has all digits.** Let `p` be the print, `X` the box of all `x` that round to it, and `h` its half edges. For any
//! numbers `μ` and `λ` let `φ(x) = Σ μ_i (L_i x − p_i) − λᵀF(x)`. At a method in `X`, `|φ(x)| ≤ Σ |μ_i| h_i`. But
//! `|φ(x)| ≥ |φ(p)| − Σ_j |∂_jφ(X)| h_j` in all of `X`. If the second bound is larger than the first, interval arithmetic proves that
//! no method has all digits. The `μ` of the linear programme with `λᵀF_B = Σ μ_i L_iB` show it.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::digits::smallest;
use super::linear::{Dyadics, ball, magnitude, middle, point};
use super::minimax::{Best, Row, minimax};
use super::newton::{Equations, Square, points};
use super::printed::power_of_ten;
use super::structure::{Coefficient, Target, Unknown};
use crate::arithmetic::interval::Interval;

/// The maximum number of shifts; a few suffice, because each one squares the remaining error.
const MAX_SHIFTS: usize = 8;
/// Longer digits are not searched: one Newton iteration would take seconds.
const MAX_BITS: u32 = 8192;
/// The maximum number of suspect prints that are examined.
const MAX_SUSPECTS: usize = 4;
/// Binary places of the linear programme beyond the finest half unit.
const GUARD_BITS: u64 = 40;

/// The outcome of the search.
pub enum Settled {
    /// Values of the fixed unknowns with which all numbers round to their prints.
    All(Vec<Option<BigRational>>),
    /// No such values were found.
    Wrong {
        /// Whether it is proved that there are none.
        excluded: bool,
        /// Printed numbers, each of which is the only wrong one for some method.
        suspects: Vec<Suspect>,
    },
}

/// A printed number that could be wrong.
pub struct Suspect {
    pub coefficient: Coefficient,
    /// Values of the fixed unknowns with which all other numbers round to their prints.
    pub fixed: Vec<Option<BigRational>>,
}

/// Looks for an exact method near that of `square` which has all printed digits.
pub fn settle<S: Equations>(
    square: &Square<S>,
    unknowns: &[Unknown],
    targets: &[Target],
    digit_bits: u32,
    bits: u32,
) -> Settled {
    let nothing = Settled::Wrong {
        excluded: false,
        suspects: Vec::new(),
    };
    let bits = digit_bits.max(bits);
    if bits > MAX_BITS {
        return nothing;
    }
    let search = Search {
        unknowns,
        prints: prints(targets),
        bits,
    };
    let Some(start) = search.solved(square.clone()) else {
        return nothing;
    };
    let best = match search.shifted(start.clone(), None) {
        Outcome::Reached(found) => return Settled::All(found.square.fixed),
        Outcome::OutOfReach(best) => best,
    };
    let excluded = best.is_some_and(|(at, best)| search.excluded(&at, &best) == Some(true));
    Settled::Wrong {
        excluded,
        suspects: search.suspects(&start),
    }
}

/// The printed numbers, without duplicates.
fn prints(targets: &[Target]) -> Vec<Target> {
    let mut prints: Vec<Target> = Vec::new();
    for target in targets {
        let same = |other: &Target| {
            (&other.terms, &other.printed, &other.half)
                == (&target.terms, &target.printed, &target.half)
        };
        if !target.terms.is_empty() && !prints.iter().any(same) {
            prints.push(target.clone());
        }
    }
    prints
}

struct Search<'a> {
    unknowns: &'a [Unknown],
    prints: Vec<Target>,
    bits: u32,
}

/// A method: the conditions with the fixed unknowns, and the solution.
#[derive(Clone)]
struct Method<S> {
    square: Square<S>,
    free: Vec<BigInt>,
}

enum Outcome<S> {
    Reached(Method<S>),
    /// No shift suffices: the method and the linear programme that show it.
    OutOfReach(Option<(Method<S>, Best)>),
}

impl Search<'_> {
    /// The solution with the fixed unknowns of `square`, starting from the printed digits.
    fn solved<S: Equations>(&self, square: Square<S>) -> Option<Method<S>> {
        let unknowns = self.unknowns;
        let start = square.free.iter().map(|&i| unknowns[i].start.clone());
        let start: Vec<BigRational> = start.collect();
        let free = square.solve(&start, self.bits)?;
        Some(Method { square, free })
    }

    /// All unknowns of a method.
    fn values<S: Equations>(&self, method: &Method<S>) -> Vec<BigInt> {
        let free = points(&method.free, self.bits);
        let all = method.square.arguments(&free, self.bits);
        all.iter().map(middle).collect()
    }

    /// The value minus the print, in units of `2⁻ᵇⁱᵗˢ`.
    fn residual(&self, print: &Target, values: &[BigInt]) -> BigInt {
        let terms = print.terms.iter();
        let value = terms.fold(BigInt::zero(), |sum, (index, factor)| {
            sum + (&values[*index] * factor.numer()).div_floor(factor.denom())
        });
        value - units(&print.printed, self.bits)
    }

    /// Whether all numbers except `apart_from` round to their prints; numbers printed exactly are checked by the certificate.
    fn reached<S: Equations>(&self, method: &Method<S>, apart_from: Option<usize>) -> bool {
        let values = self.values(method);
        let mut prints = self.prints.iter().enumerate();
        prints.all(|(index, print)| {
            let half = units(&print.half, self.bits);
            let exact = half.is_zero();
            exact || Some(index) == apart_from || self.residual(print, &values).abs() <= half
        })
    }

    /// Shifts the fixed unknowns until all numbers except `apart_from` round to their prints.
    fn shifted<S: Equations>(&self, start: Method<S>, apart_from: Option<usize>) -> Outcome<S> {
        let mut method = start;
        let mut last: Option<(Method<S>, Best)> = None;
        for _ in 0..MAX_SHIFTS {
            if self.reached(&method, apart_from) {
                return Outcome::Reached(method);
            }
            let movable = self.movable(&method.square, apart_from);
            let Some(best) = self.best(&method, &movable, apart_from) else {
                break;
            };
            let hopeless = best.level > BigRational::one();
            let again = last
                .as_ref()
                .is_some_and(|(_, known)| known.level > BigRational::one());
            let moved = self.moved(&method.square, &movable, &best);
            last = Some((method, best));
            if hopeless && again || movable.is_empty() {
                break;
            }
            match self.solved(moved) {
                Some(next) => method = next,
                None => break,
            }
        }
        Outcome::OutOfReach(last)
    }

    /// The fixed unknowns that may move, which excludes those printed exactly.
    fn movable<S: Equations>(&self, square: &Square<S>, apart_from: Option<usize>) -> Vec<usize> {
        let unknowns = self.unknowns.iter().enumerate();
        let wrong = apart_from.map(|index| &self.prints[index].terms);
        let may_move = |index: usize| {
            let is_wrong = wrong.is_some_and(|terms| terms.iter().any(|(i, _)| *i == index));
            !self.unknowns[index].exact || is_wrong
        };
        let movable = unknowns.map(|(index, _)| index);
        movable
            .filter(|&index| !square.free.contains(&index) && may_move(index))
            .collect()
    }

    /// The unit in which shifts are measured: the coarsest half unit.
    fn coarsest(&self) -> BigRational {
        let halves = self.prints.iter().map(|print| print.half.clone());
        halves.fold(BigRational::zero(), BigRational::max)
    }

    /// The best shift at a method.
    fn best<S: Equations>(
        &self,
        method: &Method<S>,
        movable: &[usize],
        apart_from: Option<usize>,
    ) -> Option<Best> {
        let halves = self.prints.iter().map(|print| &print.half);
        let finest = halves.filter(|half| half.is_positive()).min()?;
        let places = (finest.denom() / finest.numer()).bits() + GUARD_BITS;
        let coarse = u32::try_from(places).unwrap_or(u32::MAX).min(self.bits);
        let down = self.bits - coarse;
        let values = self.values(method);
        let slopes = self.slopes(method, &values, movable)?;
        let unit = units(&self.coarsest(), self.bits);
        let row = |(print, slopes): (&Target, &Vec<BigInt>)| Row {
            residual: self.residual(print, &values) >> down,
            slopes: slopes
                .iter()
                .map(|slope| (slope * &unit) >> (self.bits + down))
                .collect(),
            half: units(&print.half, coarse),
        };
        let rows = self.prints.iter().zip(&slopes).enumerate();
        let rows = rows
            .filter(|(index, (print, _))| Some(*index) != apart_from && print.half.is_positive());
        let (kept, rows): (Vec<usize>, Vec<Row>) =
            rows.map(|(index, pair)| (index, row(pair))).unzip();
        let mut best = minimax(&rows)?;
        // One multiplier for each print, including those that are not in the programme.
        let mut multipliers = vec![BigRational::zero(); self.prints.len()];
        for (index, multiplier) in kept.into_iter().zip(best.multipliers) {
            multipliers[index] = multiplier;
        }
        best.multipliers = multipliers;
        Some(best)
    }

    /// `A_i`, rounded, for every print.
    fn slopes<S: Equations>(
        &self,
        method: &Method<S>,
        values: &[BigInt],
        movable: &[usize],
    ) -> Option<Dyadics> {
        let square = &method.square;
        let at = points(values, self.bits);
        let inverse = square.inverse_derivative(&method.free, self.bits)?;
        let by_fixed = square.system.derivatives(&at, movable);
        // F_B⁻¹ F_N.
        let follows = |row: &Vec<BigInt>, column: usize| -> BigInt {
            let entries = row.iter().zip(&by_fixed);
            let sum: BigInt = entries.map(|(c, d)| c * middle(&d[column])).sum();
            sum >> self.bits
        };
        let one = BigInt::one() << self.bits;
        let slope = |print: &Target, column: usize| {
            let terms = print.terms.iter();
            terms.fold(BigInt::zero(), |sum, (index, factor)| {
                let moves = match square.free.iter().position(|free| free == index) {
                    Some(row) => -follows(&inverse[row], column),
                    None if movable[column] == *index => one.clone(),
                    None => return sum,
                };
                sum + (moves * factor.numer()).div_floor(factor.denom())
            })
        };
        let prints = self.prints.iter();
        Some(
            prints
                .map(|print| (0..movable.len()).map(|j| slope(print, j)).collect())
                .collect(),
        )
    }

    /// The conditions with the fixed unknowns moved by a shift, to a few more decimal places than are printed.
    fn moved<S: Equations>(&self, square: &Square<S>, movable: &[usize], best: &Best) -> Square<S> {
        let places = self.prints.iter().map(|print| print.half.denom().bits());
        // A decimal place takes 3.32 binary places.
        let places = places.max().unwrap_or(0) * 3 / 10 + 4;
        let scale = power_of_ten(u32::try_from(places).unwrap_or(u32::MAX));
        let unit = self.coarsest();
        let mut moved = square.clone();
        for (&index, shift) in movable.iter().zip(&best.shift) {
            if let Some(value) = &mut moved.fixed[index] {
                let exact = (&*value + shift * &unit) * &scale;
                *value = BigRational::new(exact.round().to_integer(), scale.clone());
            }
        }
        moved
    }

    /// The printed numbers, each of which is the only wrong number for some method. The last number in the step comes first: papers
    /// compute it from the others.
    fn suspects<S: Equations>(&self, start: &Method<S>) -> Vec<Suspect> {
        let level = |index: usize| {
            let movable = self.movable(&start.square, Some(index));
            Some((self.best(start, &movable, Some(index))?.level, index))
        };
        let mut levels: Vec<_> = (0..self.prints.len()).filter_map(level).collect();
        levels.sort_unstable();
        levels.truncate(MAX_SUSPECTS);
        levels.sort_unstable_by_key(|(_, index)| std::cmp::Reverse(*index));
        let suspect =
            |(_, index): (BigRational, usize)| match self.shifted(start.clone(), Some(index)) {
                Outcome::Reached(found) => Some(Suspect {
                    coefficient: self.prints[index].name,
                    fixed: found.square.fixed,
                }),
                Outcome::OutOfReach(_) => None,
            };
        levels.into_iter().filter_map(suspect).collect()
    }

    /// Whether it is proved that no method rounds to all prints.
    fn excluded<S: Equations>(&self, method: &Method<S>, best: &Best) -> Option<bool> {
        let square = &method.square;
        let enclosing = |x: &BigRational| Interval::enclosing(x, self.bits);
        // The printed unknowns, and the box of all values that round to them.
        let center: Vec<Interval> = {
            let unknowns = self.unknowns.iter();
            unknowns.map(|unknown| enclosing(&unknown.start)).collect()
        };
        let halves: Vec<BigInt> = (0..center.len())
            .map(|index| self.reach(index))
            .collect::<Option<_>>()?;
        let cube: Vec<Interval> = {
            let pairs = center.iter().zip(&halves);
            pairs
                .map(|(x, half)| ball(&middle(x), &(half + 2u32), self.bits))
                .collect()
        };
        let inverse = square.inverse_derivative(&method.free, self.bits)?;
        let largest = best.multipliers.iter().map(|x| x.abs()).max()?;
        if largest.is_zero() {
            return None;
        }
        // Any numbers serve for the proof; these are exact integers after rounding.
        let weights: Vec<BigInt> = {
            let all = best.multipliers.iter();
            all.map(|x| units(&(x / &largest), self.bits)).collect()
        };
        let weighted = |index: usize| {
            let prints = self.prints.iter().zip(&weights);
            prints.fold(point(&BigInt::zero(), self.bits), |sum, (print, weight)| {
                let terms = print.terms.iter().filter(|(i, _)| *i == index);
                terms.fold(sum, |sum, (_, factor)| {
                    sum.add(&point(weight, self.bits).scale(factor))
                })
            })
        };
        let gradient: Vec<Interval> = (0..center.len()).map(weighted).collect();
        let multiplier = |condition: usize| -> BigInt {
            let free = square.free.iter().zip(&inverse);
            let sum: BigInt = free
                .map(|(&i, row)| middle(&gradient[i]) * &row[condition])
                .sum();
            sum >> self.bits
        };
        let multipliers: Vec<Interval> = (0..inverse.len())
            .map(|condition| point(&multiplier(condition), self.bits))
            .collect();
        let all: Vec<usize> = (0..center.len()).collect();
        let derivatives = square.system.derivatives(&cube, &all);
        let residuals = square.system.residuals(&center);
        // |φ(p)| minus its possible variation in the box …
        let combined = |entries: &mut dyn Iterator<Item = &Interval>, start: Interval| {
            let pairs = multipliers.iter().zip(entries);
            pairs.fold(start, |sum, (factor, x)| sum.subtract(&factor.multiply(x)))
        };
        let mut at_center = point(&BigInt::zero(), self.bits);
        for (print, weight) in self.prints.iter().zip(&weights) {
            let value = print.enclosed(&center, self.bits);
            let difference = value.subtract(&enclosing(&print.printed));
            at_center = at_center.add(&point(weight, self.bits).multiply(&difference));
        }
        let mut left = smallest(&combined(&mut residuals.iter(), at_center)) << self.bits;
        for (index, own) in gradient.iter().enumerate() {
            let mut column = derivatives.iter().map(|row| &row[index]);
            let slope = combined(&mut column, own.clone());
            left -= magnitude(&slope) * (&halves[index] + 2u32);
        }
        // … is larger than any method in the box allows.
        let pairs = self.prints.iter().zip(&weights);
        let allowed: BigInt = pairs
            .map(|(print, weight)| weight.abs() * (units(&print.half, self.bits) + 1u32))
            .sum();
        Some(left > allowed)
    }

    /// A bound, in units of `2⁻ᵇⁱᵗˢ`, on the distance of an unknown that rounds to its print from its printed value.
    fn reach(&self, index: usize) -> Option<BigInt> {
        let start = &self.unknowns[index].start;
        let alone = self
            .prints
            .iter()
            .filter(|print| print.terms == [(index, BigRational::one())]);
        let reach = alone.map(|print| &print.half + (&print.printed - start).abs());
        Some(units(&reach.min()?, self.bits) + 1u32)
    }
}

/// A number in units of `2⁻ᵇⁱᵗˢ`, rounded down.
fn units(value: &BigRational, bits: u32) -> BigInt {
    (value.numer() << bits).div_floor(value.denom())
}
