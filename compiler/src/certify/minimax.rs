//! The point nearest to printed numbers, each distance measured in units of the number's last place: a linear programme.
//!
//! For rows `i` with a residual `r_i`, slopes `A_i` and half a unit `h_i > 0` of the last place, [`minimax`] finds a shift
//! `y`. It minimises `t` such that `|r_i + A_i y| ≤ t h_i` for all `i`. It does so with the simplex method on the dual
//! programme,
//!
//! ```text
//! max Σ μ_i r_i    with    Σ μ_i A_i = 0,    Σ |μ_i| h_i = 1,
//! ```
//!
//! in exact integers (Edmonds 1967): no tolerance decides anything. The `μ_i` prove that no smaller `t` is possible.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// One printed number. All rows are integers in the same unit.
#[derive(Debug, Clone)]
pub struct Row {
    /// The difference between the number and its print.
    pub residual: BigInt,
    /// The derivatives of the number with respect to the components of the shift.
    pub slopes: Vec<BigInt>,
    /// Half a unit of its last printed place, positive.
    pub half: BigInt,
}

/// The best shift.
#[derive(Debug, Clone)]
pub struct Best {
    /// The largest remaining distance, in halves of a unit of the last place.
    pub level: BigRational,
    /// The shift.
    pub shift: Vec<BigRational>,
    /// `μ_i`.
    pub multipliers: Vec<BigRational>,
}

/// A bound on the number of pivots, well above what problems of this size take.
const MAX_PIVOTS: usize = 2000;

/// The best shift; `None` if there are no rows, or if the simplex method takes too many pivots.
pub fn minimax(rows: &[Row]) -> Option<Best> {
    let shifts = rows.first()?.slopes.len();
    let mut table = Table::new(rows, shifts);
    table.start(shifts);
    for pivots in 0..MAX_PIVOTS {
        // After many pivots, use the rule that cannot cycle (Bland 1977).
        let Some(column) = table.entering(pivots > MAX_PIVOTS / 2) else {
            return Some(table.best(rows.len(), shifts));
        };
        let row = table.leaving(column)?;
        table.pivot(row, column);
    }
    None
}

/// The programme in the current basis: integers over a common positive denominator.
///
/// Columns are `μ⁺_i`, then `μ⁻_i`, then one artificial variable per row, then the right-hand side.
struct Table {
    rows: Vec<Vec<BigInt>>,
    objective: Vec<BigInt>,
    basis: Vec<usize>,
    denominator: BigInt,
    /// The number of columns of `μ⁺` and `μ⁻`.
    real: usize,
}

impl Table {
    fn new(rows: &[Row], shifts: usize) -> Self {
        let real = 2 * rows.len();
        let constraint = |index: usize| {
            let balance = index < shifts;
            let entry = |row: &Row| match balance {
                true => row.slopes[index].clone(),
                false => row.half.clone(),
            };
            let plus = rows.iter().map(entry);
            let minus = rows
                .iter()
                .map(|row| if balance { -entry(row) } else { entry(row) });
            let artificial = (0..=shifts).map(|i| BigInt::from(u8::from(i == index)));
            let right = std::iter::once(BigInt::from(u8::from(!balance)));
            plus.chain(minus).chain(artificial).chain(right).collect()
        };
        let plus = rows.iter().map(|row| -&row.residual);
        let minus = rows.iter().map(|row| row.residual.clone());
        let rest = std::iter::repeat_n(BigInt::zero(), shifts + 2);
        Table {
            rows: (0..=shifts).map(constraint).collect(),
            objective: plus.chain(minus).chain(rest).collect(),
            basis: (real..=real + shifts).collect(),
            denominator: BigInt::one(),
            real,
        }
    }

    /// The basis with `μ⁺_0 = μ⁻_0`, which satisfies all constraints; all other basic variables are zero.
    fn start(&mut self, shifts: usize) {
        let minus = self.real / 2;
        self.pivot(shifts, 0);
        let balance = (0..shifts).find(|&row| !self.rows[row][minus].is_zero());
        if let Some(row) = balance {
            self.pivot(row, minus);
        }
        for row in 0..shifts {
            if self.basis[row] >= self.real {
                let column = (0..self.real).find(|&column| !self.rows[row][column].is_zero());
                if let Some(column) = column {
                    self.pivot(row, column);
                }
            }
        }
    }

    fn entering(&self, first: bool) -> Option<usize> {
        let costs = self.objective[..self.real].iter().enumerate();
        let mut negative = costs.filter(|(_, cost)| cost.is_negative());
        let found = match first {
            true => negative.next(),
            false => negative.min_by(|(_, x), (_, y)| x.cmp(y)),
        };
        found.map(|(column, _)| column)
    }

    fn leaving(&self, column: usize) -> Option<usize> {
        let rows = (0..self.rows.len()).filter(|&row| self.rows[row][column].is_positive());
        rows.min_by(|&x, &y| {
            let right = |row: usize| self.rows[row].last().cloned().unwrap_or_default();
            let [a, b] = [
                right(x) * &self.rows[y][column],
                right(y) * &self.rows[x][column],
            ];
            a.cmp(&b).then(self.basis[x].cmp(&self.basis[y]))
        })
    }

    /// Exchanges a variable of the basis; every division is exact.
    fn pivot(&mut self, row: usize, column: usize) {
        if self.rows[row][column].is_negative() {
            self.rows[row].iter_mut().for_each(|entry| *entry *= -1);
        }
        let reference = self.rows[row].clone();
        let pivot = reference[column].clone();
        let others = self.rows.iter_mut().enumerate();
        let others = others
            .filter(|(index, _)| *index != row)
            .map(|(_, other)| other);
        for other in others.chain(std::iter::once(&mut self.objective)) {
            let factor = other[column].clone();
            for (entry, own) in other.iter_mut().zip(&reference) {
                *entry = (&*entry * &pivot - &factor * own) / &self.denominator;
            }
        }
        self.denominator = pivot;
        self.basis[row] = column;
    }

    fn best(&self, count: usize, shifts: usize) -> Best {
        let value =
            |numerator: &BigInt| BigRational::new(numerator.clone(), self.denominator.clone());
        let mut multipliers = vec![BigRational::zero(); count];
        for (row, &variable) in self.rows.iter().zip(&self.basis) {
            let right = row.last().map_or_else(BigRational::zero, value);
            if variable < count {
                multipliers[variable] += right;
            } else if variable < self.real {
                multipliers[variable - count] -= right;
            }
        }
        let prices = &self.objective[self.real..self.real + shifts];
        Best {
            level: self.objective.last().map_or_else(BigRational::zero, value),
            shift: prices.iter().map(|price| -value(price)).collect(),
            multipliers,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;

    fn rows(entries: &[(i64, &[i64], i64)]) -> Vec<Row> {
        let row = |(residual, slopes, half): &(i64, &[i64], i64)| Row {
            residual: BigInt::from(*residual),
            slopes: slopes.iter().map(|&slope| BigInt::from(slope)).collect(),
            half: BigInt::from(*half),
        };
        entries.iter().map(row).collect()
    }

    /// Checks that the level is reached, and that the multipliers prove that it is minimal.
    fn assert_best(rows: &[Row], found: &Best) {
        let integer = |x: &BigInt| BigRational::from_integer(x.clone());
        let shifts = found.shift.len();
        let mut largest = BigRational::zero();
        let (mut bound, mut norm) = (BigRational::zero(), BigRational::zero());
        let mut balance = vec![BigRational::zero(); shifts];
        for (row, multiplier) in rows.iter().zip(&found.multipliers) {
            let moved = (0..shifts).map(|j| integer(&row.slopes[j]) * &found.shift[j]);
            let moved = moved.fold(integer(&row.residual), |sum, x| sum + x);
            largest = largest.max(moved.abs() / integer(&row.half));
            bound += multiplier * integer(&row.residual);
            norm += multiplier.abs() * integer(&row.half);
            for (sum, slope) in balance.iter_mut().zip(&row.slopes) {
                *sum += multiplier * integer(slope);
            }
        }
        assert_eq!(largest, found.level);
        assert_eq!(bound, found.level);
        assert!(norm <= ratio(1, 1), "{norm}");
        assert!(balance.iter().all(Zero::is_zero));
    }

    #[test]
    fn minimax_solves_small_problems_known_by_hand() {
        // |y − 1| and |y + 1|: the midpoint.
        let two = rows(&[(-1, &[1], 1), (1, &[1], 1)]);
        let found = minimax(&two).expect("small");
        assert_eq!(
            (&found.level, &found.shift[0]),
            (&ratio(1, 1), &ratio(0, 1))
        );
        assert_best(&two, &found);
        // The second row counts three times as much: |y − 1| = 3 |y + 1|.
        let weighted = rows(&[(-3, &[3], 3), (1, &[1], 1), (0, &[0], 1)]);
        assert_best(&weighted, &minimax(&weighted).expect("small"));
        // No shift at all.
        let fixed = rows(&[(2, &[], 4), (-3, &[], 2)]);
        assert_eq!(minimax(&fixed).expect("small").level, ratio(3, 2));
        // Dependent components.
        let dependent = rows(&[(5, &[1, 2], 1), (-1, &[2, 4], 2), (3, &[1, 2], 7)]);
        assert_best(&dependent, &minimax(&dependent).expect("small"));
        assert!(minimax(&[]).is_none());
    }

    #[test]
    fn the_bound_is_reached_in_random_problems() {
        let mut state = 1u64;
        let mut next = |range: i64| {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            i64::try_from(state >> 40).unwrap_or(0) % (2 * range + 1) - range
        };
        for case in 0..60 {
            let (shifts, count) = (case % 5, 2 + case % 9);
            let problem: Vec<Row> = (0..count)
                .map(|_| Row {
                    residual: BigInt::from(next(50)),
                    slopes: (0..shifts).map(|_| BigInt::from(next(9))).collect(),
                    half: BigInt::from(1 + next(10).abs()),
                })
                .collect();
            assert_best(&problem, &minimax(&problem).expect("small"));
        }
    }
}
