//! Which stages coincide, which need which, and in what order they can be computed.

use num_rational::BigRational;

use crate::algebra::{NodeAlgebra, Number, Tensor};
use crate::arithmetic::polynomial::Polynomial;
use crate::tableau::{Coefficients, Tableau};

/// A stage of a method for separable Hamiltonians.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// The position stage `Q_i` of this index, at which the force is evaluated.
    Position(usize),
    /// The momentum stage `P_i` of this index, at which the velocity is evaluated.
    Momentum(usize),
}

/// A tableau in which equal position stages are one, and equal momentum stages are one.
///
/// `a` has a row for each position stage and a column for each momentum stage, `ã` the other way
/// round; the coefficients of stages that have become one are added, exactly.
#[derive(Debug)]
pub struct ReducedTableau<'a> {
    /// The original stages of each position stage.
    pub positions: Vec<Vec<usize>>,
    /// The original stages of each momentum stage.
    pub momenta: Vec<Vec<usize>>,
    /// `a`, by position and momentum stage.
    pub a: Vec<Vec<Number<'a>>>,
    /// `ã`, by momentum and position stage.
    pub a_tilde: Vec<Vec<Number<'a>>>,
    /// `b`, by momentum stage.
    pub b: Vec<Number<'a>>,
    /// `b̃`, by position stage.
    pub b_tilde: Vec<Number<'a>>,
    /// `c`, by position stage.
    pub c: Vec<Number<'a>>,
    /// `c̃`, by momentum stage.
    pub c_tilde: Vec<Number<'a>>,
}

impl<'a> ReducedTableau<'a> {
    /// The reduction for separable Hamiltonians, where the velocity depends on the momentum stage only
    /// and the force on the position stage only.
    pub fn separable(tableau: &'a Tableau, numbers: &Coefficients<Number<'a>>) -> Self {
        let algebra = &*tableau.algebra;
        let positions = equal_rows(algebra, &tableau.a);
        let momenta = equal_rows(algebra, &tableau.a_tilde);
        let matrix = |tensor: &Tensor,
                      entries: &[Vec<Number<'a>>],
                      rows: &[Vec<usize>],
                      columns: &[Vec<usize>]| {
            let entry = |row: usize, column: &[usize]| match column {
                [single] => entries[row][*single].clone(),
                // Only stages at rational nodes are joined.
                _ => Number::at(
                    algebra,
                    sum(column, |j| {
                        rational(algebra, j).map(|node| tensor.column_at(node))
                    }),
                    row,
                ),
            };
            rows.iter()
                .map(|row| columns.iter().map(|column| entry(row[0], column)).collect())
                .collect()
        };
        let vector = |element: &Polynomial, entries: &[Number<'a>], groups: &[Vec<usize>]| {
            let entry = |group: &Vec<usize>| match group.as_slice() {
                [single] => entries[*single].clone(),
                _ => {
                    let value = |j| {
                        rational(algebra, j)
                            .map(|node| Polynomial::constant(element.evaluate(node)))
                    };
                    Number::at(algebra, sum(group, value), group[0])
                }
            };
            groups.iter().map(entry).collect()
        };
        let first = |entries: &[Number<'a>], groups: &[Vec<usize>]| {
            groups.iter().map(|g| entries[g[0]].clone()).collect()
        };
        ReducedTableau {
            a: matrix(&tableau.a, &numbers.a, &positions, &momenta),
            a_tilde: matrix(&tableau.a_tilde, &numbers.a_tilde, &momenta, &positions),
            b: vector(&tableau.b, &numbers.b, &momenta),
            b_tilde: vector(&tableau.b_tilde, &numbers.b_tilde, &positions),
            c: first(&numbers.c, &positions),
            c_tilde: first(&numbers.c_tilde, &momenta),
            positions,
            momenta,
        }
    }

    /// The name of a stage: `Q1`.
    pub fn name(&self, stage: Stage) -> String {
        match stage {
            Stage::Position(index) => format!("Q{}", self.positions[index][0] + 1),
            Stage::Momentum(index) => format!("P{}", self.momenta[index][0] + 1),
        }
    }

    /// The names of all stages that have become one: `P1 = P2`.
    pub fn all_names(&self, stage: Stage) -> String {
        let (letter, group) = match stage {
            Stage::Position(index) => ('Q', &self.positions[index]),
            Stage::Momentum(index) => ('P', &self.momenta[index]),
        };
        group
            .iter()
            .map(|i| format!("{letter}{}", i + 1))
            .collect::<Vec<_>>()
            .join(" = ")
    }
}

fn rational(algebra: &NodeAlgebra, node: usize) -> Option<&BigRational> {
    algebra.roots()[node].rational()
}

fn sum(group: &[usize], value: impl Fn(usize) -> Option<Polynomial>) -> Polynomial {
    group
        .iter()
        .filter_map(|&j| value(j))
        .fold(Polynomial::zero(), |sum, value| &sum + &value)
}

/// Groups the stages whose rows of a matrix are equal. Rows at irrational nodes stay alone.
fn equal_rows(algebra: &NodeAlgebra, matrix: &Tensor) -> Vec<Vec<usize>> {
    let mut groups: Vec<(Option<Polynomial>, Vec<usize>)> = Vec::new();
    for stage in 0..algebra.dimension() {
        let row = rational(algebra, stage).map(|node| matrix.row_at(node));
        match groups
            .iter_mut()
            .find(|(known, _)| row.is_some() && *known == row)
        {
            Some((_, group)) => group.push(stage),
            None => groups.push((row, vec![stage])),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// Which stages need which, for separable Hamiltonians.
#[derive(Debug)]
pub struct StageGraph {
    /// For each position stage, the momentum stages with `a_ij ≠ 0`.
    positions: Vec<Vec<usize>>,
    /// For each momentum stage, the position stages with `ã_ij ≠ 0`.
    momenta: Vec<Vec<usize>>,
}

/// An order of computation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Schedule {
    /// Stages that can be computed one after another from the start of the step.
    pub before: Vec<Stage>,
    /// Stages that need one another, positions before momenta.
    pub coupled: Vec<Stage>,
    /// Stages that can be computed one after another when the coupled ones are known.
    pub after: Vec<Stage>,
}

impl StageGraph {
    /// The dependencies of a reduced tableau.
    pub fn new(reduced: &ReducedTableau<'_>) -> Self {
        let nonzero = |rows: &[Vec<Number<'_>>]| {
            let columns =
                |row: &Vec<Number<'_>>| (0..row.len()).filter(|&j| !row[j].is_zero()).collect();
            rows.iter().map(columns).collect()
        };
        StageGraph {
            positions: nonzero(&reduced.a),
            momenta: nonzero(&reduced.a_tilde),
        }
    }

    /// The stages that a stage needs.
    pub fn needs(&self, stage: Stage) -> Vec<Stage> {
        match stage {
            Stage::Position(i) => self.positions[i]
                .iter()
                .map(|&j| Stage::Momentum(j))
                .collect(),
            Stage::Momentum(i) => self.momenta[i]
                .iter()
                .map(|&j| Stage::Position(j))
                .collect(),
        }
    }

    fn stages(&self) -> Vec<Stage> {
        let positions = (0..self.positions.len()).map(Stage::Position);
        positions
            .chain((0..self.momenta.len()).map(Stage::Momentum))
            .collect()
    }

    /// An order in which every stage comes after those that it needs.
    ///
    /// # Errors
    /// Where there is none: stages each of which needs the next, and the last the first.
    pub fn order(&self) -> Result<Vec<Stage>, Vec<Stage>> {
        let schedule = self.schedule();
        let Some(&start) = schedule.coupled.first() else {
            return Ok(schedule.before.into_iter().chain(schedule.after).collect());
        };
        // Every stage left needs one that is left: walk until one comes again.
        let rest = [schedule.coupled.as_slice(), &schedule.after].concat();
        let mut path = vec![start];
        loop {
            let last = path[path.len() - 1];
            let next = self
                .needs(last)
                .into_iter()
                .find(|stage| rest.contains(stage))
                .unwrap_or(start);
            if let Some(position) = path.iter().position(|&stage| stage == next) {
                return Err(path.split_off(position));
            }
            path.push(next);
        }
    }

    /// Splits the stages into those before, in and after the coupled ones.
    pub fn schedule(&self) -> Schedule {
        let mut rest = self.stages();
        let before = take_while_possible(&mut rest, |stage, rest| {
            self.needs(stage)
                .iter()
                .all(|needed| !rest.contains(needed))
        });
        // The same from the other end: what no remaining stage needs comes last.
        let mut after = take_while_possible(&mut rest, |stage, rest| {
            rest.iter()
                .all(|&other| !self.needs(other).contains(&stage))
        });
        after.reverse();
        Schedule {
            before,
            coupled: rest,
            after,
        }
    }
}

/// Moves stages out of `rest`, one at a time, the first that is possible.
fn take_while_possible(
    rest: &mut Vec<Stage>,
    possible: impl Fn(Stage, &[Stage]) -> bool,
) -> Vec<Stage> {
    let mut taken = Vec::new();
    while let Some(position) = rest.iter().position(|&stage| possible(stage, rest)) {
        taken.push(rest.remove(position));
    }
    taken
}
