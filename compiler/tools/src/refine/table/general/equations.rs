//! The equations of a table: order conditions tree by tree, and equations of degree at most two between its entries.

use std::collections::BTreeMap;
use std::sync::Arc;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use symplectic_compiler::inside::Equations;
use symplectic_compiler::inside::Plan;
use symplectic_exact::interval::Interval;

/// An entry of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Entry {
    Exact(BigRational),
    Unknown(usize),
}

/// One half of a method.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Half {
    pub a: Vec<Vec<Entry>>,
    pub b: Vec<Entry>,
}

/// `Σ factor·Π unknowns = 0`; the keys are the unknowns of each term, at most two.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Quadratic(pub BTreeMap<Vec<usize>, BigRational>);

impl Quadratic {
    fn add_term(&mut self, unknowns: Vec<usize>, factor: BigRational) {
        let sum = self.0.remove(&unknowns).unwrap_or_default() + factor;
        if !sum.is_zero() {
            self.0.insert(unknowns, sum);
        }
    }

    /// The equation with `factor` times a product of entries added.
    #[must_use]
    pub fn plus(mut self, factor: i64, entries: &[&Entry]) -> Self {
        let (mut product, mut unknowns) = (BigRational::from_integer(factor.into()), Vec::new());
        for entry in entries {
            match entry {
                Entry::Exact(value) => product *= value,
                Entry::Unknown(index) => unknowns.push(*index),
            }
        }
        unknowns.sort_unstable();
        self.add_term(unknowns, product);
        self
    }

    /// Subtracts a multiple of another equation.
    fn less(&mut self, factor: &BigRational, other: &Quadratic) {
        for (unknowns, own) in &other.0 {
            self.add_term(unknowns.clone(), -(factor * own));
        }
    }

    fn evaluate(&self, x: &[Dual], bits: u32) -> Dual {
        let slopes = x.first().map_or(0, |x| x.slopes.len());
        self.0
            .iter()
            .fold(Dual::zero(slopes, bits), |sum, (unknowns, factor)| {
                let mut product = Dual::exact(factor, slopes, bits);
                for &index in unknowns {
                    product = product.multiply(&x[index]);
                }
                sum.add(&product)
            })
    }
}

/// A linearly independent subset of the equations; `None` for a contradiction.
pub(super) fn independent(equations: Vec<Quadratic>) -> Option<Vec<Quadratic>> {
    let mut reduced: Vec<(Vec<usize>, Quadratic)> = Vec::new();
    let mut kept = Vec::new();
    for equation in equations {
        let mut rest = equation.clone();
        for (pivot, row) in &reduced {
            if let Some(factor) = rest.0.get(pivot).cloned() {
                rest.less(&factor, row);
            }
        }
        let Some((pivot, factor)) = rest.0.iter().next_back() else {
            continue;
        };
        if pivot.is_empty() {
            return None;
        }
        let (pivot, factor) = (pivot.clone(), factor.recip());
        rest.0.values_mut().for_each(|x| *x *= &factor);
        for (_, row) in &mut reduced {
            if let Some(factor) = row.0.get(&pivot).cloned() {
                row.less(&factor, &rest);
            }
        }
        reduced.push((pivot, rest));
        kept.push(equation);
    }
    Some(kept)
}

/// All equations of a table, or some of them.
#[derive(Debug, Clone)]
pub(super) struct TableSystem {
    pub positions: Arc<Half>,
    pub momenta: Arc<Half>,
    pub plan: Arc<Plan>,
    pub quadratics: Arc<Vec<Quadratic>>,
    /// The equations in use, by index: first those of degree two, then the conditions.
    pub kept: Vec<usize>,
}

impl TableSystem {
    /// The number of all equations.
    pub fn count(&self) -> usize {
        self.quadratics.len() + self.plan.conditions.len()
    }

    /// The same system with other equations in use.
    pub fn keeping(&self, kept: Vec<usize>) -> Self {
        TableSystem {
            kept,
            ..self.clone()
        }
    }

    fn evaluate(&self, arguments: &[Interval], by: &[usize]) -> Vec<Dual> {
        let bits = arguments.first().map_or(0, Interval::bits);
        let x: Vec<Dual> = {
            let arguments = arguments.iter().enumerate();
            arguments
                .map(|(index, x)| Dual::variable(x, index, by))
                .collect()
        };
        let numbers = Numbers {
            x: &x,
            slopes: by.len(),
            bits,
        };
        let first = self.quadratics.len();
        let applied = match self.kept.iter().any(|&index| index >= first) {
            true => self.applied(&numbers),
            false => Vec::new(),
        };
        let equation = |&index: &usize| match index.checked_sub(first) {
            None => self.quadratics[index].evaluate(&x, bits),
            Some(index) => self.condition(index, &applied, &numbers),
        };
        self.kept.iter().map(equation).collect()
    }

    fn half(&self, momentum: bool) -> &Half {
        match momentum {
            true => &self.momenta,
            false => &self.positions,
        }
    }

    /// `Φ_i` and `Σ_j a_ij Φ_j` of all trees.
    fn applied(&self, numbers: &Numbers<'_>) -> Vec<(Vec<Dual>, Vec<Dual>)> {
        let mut all: Vec<(Vec<Dual>, Vec<Dual>)> = Vec::new();
        for tree in &self.plan.trees {
            let stages: Vec<Dual> = match tree.product {
                None => vec![numbers.one(); self.positions.b.len()],
                Some((rest, last)) => {
                    let pairs = all[rest].0.iter().zip(&all[last].1);
                    pairs.map(|(x, y)| x.multiply(y)).collect()
                }
            };
            let rows = self.half(tree.momentum).a.iter();
            let applied = rows.map(|row| numbers.inner(row, &stages)).collect();
            all.push((stages, applied));
        }
        all
    }

    fn condition(
        &self,
        index: usize,
        applied: &[(Vec<Dual>, Vec<Dual>)],
        numbers: &Numbers<'_>,
    ) -> Dual {
        let condition = &self.plan.conditions[index];
        let half = self.half(self.plan.trees[condition.rest].momentum);
        let pairs = applied[condition.rest]
            .0
            .iter()
            .zip(&applied[condition.last].1);
        let products: Vec<Dual> = pairs.map(|(x, y)| x.multiply(y)).collect();
        let wanted = Dual::exact(&-&condition.wanted, numbers.slopes, numbers.bits);
        numbers.inner(&half.b, &products).add(&wanted)
    }
}

impl Equations for TableSystem {
    fn residuals(&self, arguments: &[Interval]) -> Vec<Interval> {
        let all = self.evaluate(arguments, &[]).into_iter();
        all.map(|dual| dual.value).collect()
    }

    fn derivatives(&self, arguments: &[Interval], by: &[usize]) -> Vec<Vec<Interval>> {
        let all = self.evaluate(arguments, by).into_iter();
        all.map(|dual| dual.slopes).collect()
    }
}

/// The values of the unknowns, in a box.
struct Numbers<'a> {
    x: &'a [Dual],
    slopes: usize,
    bits: u32,
}

impl Numbers<'_> {
    fn one(&self) -> Dual {
        Dual::exact(&BigRational::one(), self.slopes, self.bits)
    }

    fn inner(&self, entries: &[Entry], values: &[Dual]) -> Dual {
        let zero = Dual::zero(self.slopes, self.bits);
        entries
            .iter()
            .zip(values)
            .fold(zero, |sum, (entry, value)| match entry {
                Entry::Exact(factor) if factor.is_zero() => sum,
                Entry::Exact(factor) => sum.add(&value.scale(factor)),
                Entry::Unknown(index) => sum.add(&self.x[*index].multiply(value)),
            })
    }
}

/// A number with its derivatives with respect to some unknowns.
#[derive(Debug, Clone)]
struct Dual {
    value: Interval,
    slopes: Vec<Interval>,
}

fn is_zero(interval: &Interval) -> bool {
    interval.low.is_zero() && interval.high.is_zero()
}

fn zero(bits: u32) -> Interval {
    Interval {
        low: BigInt::zero(),
        high: BigInt::zero(),
        bits,
    }
}

impl Dual {
    fn exact(value: &BigRational, slopes: usize, bits: u32) -> Self {
        Dual {
            value: Interval::enclosing(value, bits),
            slopes: vec![zero(bits); slopes],
        }
    }

    fn zero(slopes: usize, bits: u32) -> Self {
        Dual::exact(&BigRational::zero(), slopes, bits)
    }

    fn variable(value: &Interval, index: usize, by: &[usize]) -> Self {
        let bits = value.bits();
        let slope = |&column: &usize| match column == index {
            true => Interval::enclosing(&BigRational::one(), bits),
            false => zero(bits),
        };
        Dual {
            value: value.clone(),
            slopes: by.iter().map(slope).collect(),
        }
    }

    fn add(&self, other: &Dual) -> Dual {
        let pairs = self.slopes.iter().zip(&other.slopes);
        Dual {
            value: self.value.add(&other.value),
            slopes: pairs.map(|(x, y)| x.add(y)).collect(),
        }
    }

    fn scale(&self, factor: &BigRational) -> Dual {
        Dual {
            value: self.value.scale(factor),
            slopes: self.slopes.iter().map(|x| x.scale(factor)).collect(),
        }
    }

    fn multiply(&self, other: &Dual) -> Dual {
        let pairs = self.slopes.iter().zip(&other.slopes);
        let slope = |(x, y): (&Interval, &Interval)| match (is_zero(x), is_zero(y)) {
            (true, true) => zero(self.value.bits()),
            (false, true) => x.multiply(&other.value),
            (true, false) => self.value.multiply(y),
            (false, false) => x.multiply(&other.value).add(&self.value.multiply(y)),
        };
        Dual {
            value: self.value.multiply(&other.value),
            slopes: pairs.map(slope).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use symplectic_compiler::order::TreeRule;
    use symplectic_exact::rational::ratio;

    /// The midpoint rule has order 2 and not 3: `b (a)² = 1/4` instead of 1/3 and 1/6.
    #[test]
    fn conditions_are_those_of_the_trees() {
        let half = Arc::new(Half {
            a: vec![vec![Entry::Unknown(0)]],
            b: vec![Entry::Unknown(1)],
        });
        let system = TableSystem {
            positions: Arc::clone(&half),
            momenta: half,
            plan: Arc::new(Plan::new(TreeRule::OneColour, &[2, 3], false)),
            quadratics: Arc::new(vec![]),
            kept: vec![0, 1, 2],
        };
        let at = [ratio(1, 2), ratio(1, 1)].map(|x| Interval::enclosing(&x, 60));
        let mut residuals: Vec<BigRational> =
            system.residuals(&at).iter().map(Interval::middle).collect();
        residuals.sort_unstable();
        for (found, wanted) in residuals
            .iter()
            .zip([ratio(-1, 12), ratio(0, 1), ratio(1, 12)])
        {
            assert!((found - wanted) * ratio(1 << 50, 1) < ratio(1, 1));
        }
        // b a², twice, and b a: derivatives with respect to a are 1, 1, 1.
        for row in system.derivatives(&at, &[0]) {
            assert!(row[0].contains(&ratio(1, 1)));
        }
    }

    #[test]
    fn dependent_equations_are_left_out() {
        let [x, y] = [Entry::Unknown(0), Entry::Unknown(1)];
        let one = Entry::Exact(ratio(1, 1));
        let sum = Quadratic::default()
            .plus(1, &[&x])
            .plus(1, &[&y])
            .plus(-1, &[&one]);
        let twice = Quadratic::default()
            .plus(2, &[&y])
            .plus(2, &[&x])
            .plus(-2, &[&one]);
        let product = Quadratic::default().plus(1, &[&x, &y]);
        let all = vec![sum.clone(), twice, product.clone()];
        assert_eq!(independent(all), Some(vec![sum.clone(), product]));
        let other = Quadratic::default().plus(1, &[&x]).plus(1, &[&y]);
        assert_eq!(independent(vec![sum, other]), None);
    }
}
