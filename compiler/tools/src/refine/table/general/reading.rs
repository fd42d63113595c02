//! The unknowns of a table: ways to read the digits, and the equations of the claims for each.

use std::sync::Arc;

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::super::read::{Claimed, Table};
use super::super::{Array, Cell};
use super::equations::{Entry, Half, Quadratic, TableSystem, independent};
use symplectic_compiler::certify::Coefficient;
use symplectic_compiler::inside::Plan;
use symplectic_compiler::inside::{Target, Unknown};
use symplectic_compiler::order::{HamiltonianClass, TreeRule};

/// How digits are read. Zeros, fractions and integers are always exact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Way {
    /// Whether equal numbers share one unknown.
    pub tied: bool,
    /// Whether decimals that look like short fractions are taken as these.
    pub simple: bool,
}

/// `constant + Σ factor·unknown`.
#[derive(Debug, Clone, Default)]
pub(in crate::refine) struct Form {
    pub constant: BigRational,
    pub terms: Vec<(usize, BigRational)>,
}

impl Form {
    fn plus(mut self, entry: &Entry) -> Self {
        match entry {
            Entry::Exact(value) => self.constant += value,
            Entry::Unknown(index) => match self.terms.iter_mut().find(|(i, _)| i == index) {
                Some((_, factor)) => *factor += BigRational::one(),
                None => self.terms.push((*index, BigRational::one())),
            },
        }
        self
    }
}

/// One way to read a table.
pub(super) struct Reading {
    pub way: Way,
    pub unknowns: Vec<Unknown>,
    /// The number behind each cell.
    pub forms: Vec<Form>,
    /// The printed numbers as combinations of unknowns, with the indices of weights.
    pub targets: Vec<Target>,
    pub system: TableSystem,
}

struct Reader<'a> {
    table: &'a Table,
    way: Way,
    unknowns: Vec<Unknown>,
}

impl Reader<'_> {
    fn exact(&self, cell: &Cell) -> Option<BigRational> {
        let value = cell.printed.value();
        match cell.printed.places() {
            Some(_) if !value.is_zero() => cell.printed.simple().filter(|_| self.way.simple),
            _ => Some(value.clone()),
        }
    }

    fn entry(&mut self, array: Array, row: usize, column: usize) -> Entry {
        let Some(cell) = self.table.cell(array, row, column) else {
            return Entry::Exact(BigRational::zero());
        };
        if let Some(value) = self.exact(cell) {
            return Entry::Exact(value);
        }
        let start = cell.printed.value();
        let known = self.unknowns.iter().position(|known| known.start == *start);
        if let Some(index) = known.filter(|_| self.way.tied) {
            return Entry::Unknown(index);
        }
        self.unknowns.push(Unknown {
            name: Coefficient::Weight(self.unknowns.len()),
            start: start.clone(),
            simple: cell.printed.simple(),
            exact: false,
        });
        Entry::Unknown(self.unknowns.len() - 1)
    }

    fn matrix(&mut self, array: Array) -> Vec<Vec<Entry>> {
        let stages = 0..self.table.stages;
        let mut row = |i| stages.clone().map(|j| self.entry(array, i, j)).collect();
        let rows = stages.clone();
        rows.map(&mut row).collect()
    }

    fn list(&mut self, array: Array) -> Vec<Entry> {
        (0..self.table.stages)
            .map(|i| self.entry(array, i, 0))
            .collect()
    }
}

impl Reading {
    /// Whether another way leads to the same equations.
    pub fn is_same(&self, other: &Reading) -> bool {
        let (own, other) = (&self.system, &other.system);
        own.positions == other.positions
            && own.momenta == other.momenta
            && own.quadratics == other.quadratics
    }

    /// The reading of a table; `None` if it contradicts the claim.
    pub fn new(table: &Table, way: Way) -> Option<Self> {
        let mut reader = Reader {
            table,
            way,
            unknowns: Vec::new(),
        };
        let positions = Half {
            a: reader.matrix(Array::A),
            b: reader.list(Array::B),
        };
        // The two weight vectors of a symplectic method are equal, unless H is separable.
        let general = table.class == HamiltonianClass::General;
        let same = general && table.claims(Claimed::Symplectic) || !table.has(Array::BTilde);
        let momenta = match table.has(Array::ATilde) {
            false => positions.clone(),
            true => Half {
                a: reader.matrix(Array::ATilde),
                b: match same {
                    true => positions.b.clone(),
                    false => reader.list(Array::BTilde),
                },
            },
        };
        let form = |cell: &Cell| {
            let half = match cell.array {
                Array::A | Array::B | Array::C => &positions,
                _ => &momenta,
            };
            match cell.array {
                Array::A | Array::ATilde => Form::default().plus(&half.a[cell.row][cell.column]),
                Array::B | Array::BTilde => Form::default().plus(&half.b[cell.row]),
                _ => half.a[cell.row].iter().fold(Form::default(), Form::plus),
            }
        };
        let forms: Vec<Form> = table.cells.iter().map(form).collect();
        let sums = table.cells.iter().filter_map(|cell| {
            let half = match cell.array {
                Array::C => &positions,
                Array::CTilde => &momenta,
                _ => return None,
            };
            let wanted = Entry::Exact(reader.exact(cell)?);
            let row = half.a[cell.row].iter();
            Some(
                row.fold(Quadratic::default().plus(-1, &[&wanted]), |sum, entry| {
                    sum.plus(1, &[entry])
                }),
            )
        });
        let mut quadratics: Vec<Quadratic> = weights(&positions, &momenta).chain(sums).collect();
        if table.claims(Claimed::Symmetric) {
            quadratics.extend(symmetric(&positions));
            quadratics.extend(symmetric(&momenta));
        }
        if table.claims(Claimed::Symplectic) {
            quadratics.extend(symplectic(table, &positions, &momenta));
        }
        let quadratics = independent(quadratics)?;
        let plan = plan(table, &positions, &momenta);
        let system = TableSystem {
            kept: (0..quadratics.len() + plan.conditions.len()).collect(),
            positions: Arc::new(positions),
            momenta: Arc::new(momenta),
            plan: Arc::new(plan),
            quadratics: Arc::new(quadratics),
        };
        Some(Reading {
            way,
            targets: targets(table, &forms),
            unknowns: reader.unknowns,
            forms,
            system,
        })
    }
}

fn targets(table: &Table, forms: &[Form]) -> Vec<Target> {
    let pairs = table.cells.iter().zip(forms).enumerate();
    pairs
        .map(|(index, (cell, form))| Target {
            name: Coefficient::Weight(index),
            printed: cell.printed.value() - &form.constant,
            half: cell.printed.half_unit(),
            terms: form.terms.clone(),
        })
        .collect()
}

/// The conditions of order 1.
fn weights(positions: &Half, momenta: &Half) -> impl Iterator<Item = Quadratic> {
    let sum = |half: &Half| {
        let one = Entry::Exact(BigRational::one());
        let start = Quadratic::default().plus(-1, &[&one]);
        half.b.iter().fold(start, |sum, b| sum.plus(1, &[b]))
    };
    [sum(positions), sum(momenta)].into_iter()
}

/// `a_ij + a_{σi,σj} = b_j` and `b_j = b_{σj}`, where `σ` reverses the stages.
fn symmetric(half: &Half) -> Vec<Quadratic> {
    let stages = half.b.len();
    let mirror = |i: usize| stages - 1 - i;
    let b = (0..stages).map(|j| {
        let start = Quadratic::default().plus(1, &[&half.b[j]]);
        start.plus(-1, &[&half.b[mirror(j)]])
    });
    let a = pairs(stages).map(|(i, j)| {
        Quadratic::default()
            .plus(1, &[&half.a[i][j]])
            .plus(1, &[&half.a[mirror(i)][mirror(j)]])
            .plus(-1, &[&half.b[j]])
    });
    b.chain(a).collect()
}

fn pairs(stages: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..stages).flat_map(move |i| (0..stages).map(move |j| (i, j)))
}

/// `N_ij = b_i ã_ij + b̃_j a_ji − b_i b̃_j = 0`.
///
/// If one tableau is used for both, `N_ji = N_ij`. In a symmetric method `N_{σi,σj} = −N_ij`, which follows from symmetry by
/// a line of algebra. So one equation of each set of indices is kept, and none if the two are the same.
fn symplectic(table: &Table, positions: &Half, momenta: &Half) -> Vec<Quadratic> {
    let mirror = |i: usize| table.stages - 1 - i;
    let one_tableau = positions == momenta;
    let ordered = |(i, j): (usize, usize)| match one_tableau && i > j {
        true => (j, i),
        false => (i, j),
    };
    let is_left = |pair: &(usize, usize)| {
        let own = ordered(*pair);
        let mirrored = ordered((mirror(pair.0), mirror(pair.1)));
        own == *pair && (!table.claims(Claimed::Symmetric) || own < mirrored)
    };
    let equation = |(i, j): (usize, usize)| {
        let (b, b_tilde) = (&positions.b[i], &momenta.b[j]);
        Quadratic::default()
            .plus(1, &[b, &momenta.a[i][j]])
            .plus(1, &[b_tilde, &positions.a[j][i]])
            .plus(-1, &[b, b_tilde])
    };
    pairs(table.stages).filter(is_left).map(equation).collect()
}

/// The order conditions that remain after symmetry and symplecticity.
fn plan(table: &Table, positions: &Half, momenta: &Half) -> Plan {
    let quadratic_kinetic = table.class == HamiltonianClass::Nystrom;
    let rule = match positions == momenta && !quadratic_kinetic {
        true => TreeRule::OneColour,
        false => TreeRule::Class(table.class),
    };
    // A symmetric method has even order: if it has an odd order, it has the next.
    let needed = |order: &usize| !table.claims(Claimed::Symmetric) || order % 2 == 1;
    let orders: Vec<usize> = (2..=table.order).filter(needed).collect();
    let mut plan = Plan::new(rule, &orders, table.claims(Claimed::Symplectic));
    // For general H the colour of the root does not matter if the weights are equal.
    if rule == TreeRule::Class(HamiltonianClass::General) && positions.b == momenta.b {
        let trees = &plan.trees;
        plan.conditions
            .retain(|condition| !trees[condition.rest].momentum);
    }
    plan
}
