//! Tables of no particular construction: the entries are unknowns, and the claims are equations.
//!
//! The equations are the order conditions of all trees, symplecticity `b_i ã_ij + b̃_j a_ji = b_i b̃_j` and symmetry
//! `a_ij + a_{σi,σj} = b_j`, as far as they are claimed, and nodes that are printed exactly. Conditions that provably follow
//! from others are left out: those of even orders in a symmetric method, and all but one for each unrooted tree in a
//! symplectic method (GNI VI.7). Independent equations are solved for as many unknowns, as in [`certify`](symplectic_compiler::certify);
//! the other unknowns move within their last places. Equations that depend on these to first order are evaluated at the
//! solution: they are verified to some binary places, which is not a proof.

mod equations;
mod reading;

use std::sync::Arc;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use self::equations::TableSystem;
pub(super) use self::reading::Form;
use self::reading::{Reading, Way};
use super::read::{Claimed, Table, not_certified};
use super::{Array, Cell, Exact, RefinedTable};
use symplectic_compiler::Error;
use symplectic_compiler::certify::Coefficient;
use symplectic_compiler::expression::Input;
use symplectic_compiler::inside::{
    Enclosed, Equations, PROOF_BITS, Proof, Settled, Square, Unknown, pivots, settle,
};
use symplectic_compiler::order::HamiltonianClass;
use symplectic_exact::interval::Interval;
use symplectic_exact::rational::ratio;

/// Bounds on the work.
const MAX_STAGES: usize = 6;
const MAX_ORDER: usize = 8;
const MAX_UNKNOWNS: usize = 60;
/// The largest number of products of two numbers with their derivatives in one evaluation of all conditions.
const MAX_PRODUCTS: usize = 300_000;
/// Pivots of derivatives below this count as zero, because printed numbers have few digits.
const RANK_THRESHOLD: f64 = 1e-7;
/// The smallest number of binary places to which the equations left out hold.
const VERIFIED_BITS: i64 = 200;

/// The numbers behind a table, as zeros of equations.
#[derive(Debug, Clone)]
pub(in crate::refine) struct Solved {
    enclosed: Arc<Enclosed<TableSystem>>,
    forms: Arc<Vec<Form>>,
    /// The number of equations, the number solved with proof, and the places to which the others hold.
    equations: usize,
    proved: usize,
    verified_bits: Option<i64>,
}

impl Solved {
    /// Whether all equations hold exactly.
    pub fn is_certified(&self) -> bool {
        self.verified_bits.is_none()
    }

    /// An enclosure of the number behind a cell.
    pub fn enclose(&self, cell: usize, bits: u32) -> Interval {
        let form = &self.forms[cell];
        let constant = Interval::enclosing(&form.constant, bits);
        if form.terms.is_empty() {
            return constant;
        }
        let unknowns = self.enclosed.unknowns(bits);
        let terms = form.terms.iter();
        terms.fold(constant, |sum, (index, factor)| {
            sum.add(&unknowns[*index].scale(factor))
        })
    }
}

/// An exact method near the print.
struct Found {
    solved: Solved,
    /// Whether all numbers round to their prints, and whether it is proved that they cannot in this reading.
    right: bool,
    excluded: bool,
    /// The cells, each of which is the only wrong one for some method.
    suspects: Vec<usize>,
}

/// The exact table near the digits that satisfies the claims.
pub(super) fn by_equations(file: Input<'_>, table: &Table) -> Result<RefinedTable, Error> {
    let refused = |message: String| not_certified(file, table.order_span.clone(), message);
    check(table).map_err(&refused)?;
    let ways = [(true, true), (true, false), (false, true), (false, false)];
    let ways = ways.map(|(tied, simple)| Way { tied, simple });
    let mut best: Option<Found> = None;
    let mut too_much: Option<String> = None;
    let rank = |found: &Found| (found.right, found.solved.is_certified());
    let readings: Vec<Reading> = ways
        .into_iter()
        .filter_map(|way| Reading::new(table, way))
        .collect();
    for (index, reading) in readings.iter().enumerate() {
        if let Err(message) = check_work(table, reading) {
            too_much.get_or_insert(message);
            continue;
        }
        if readings[..index].iter().any(|known| known.is_same(reading)) {
            continue;
        }
        let Some(mut found) = solve(reading, table) else {
            continue;
        };
        // Only the last way contains all others.
        let last = readings
            .last()
            .filter(|last| !last.way.tied && !last.way.simple);
        found.excluded &= last.is_some_and(|last| last.is_same(reading));
        match &mut best {
            Some(best) if rank(&found) <= rank(best) => best.excluded |= found.excluded,
            _ => best = Some(found),
        }
        if best.as_ref().is_some_and(|best| rank(best) == (true, true)) {
            break;
        }
    }
    let Some(found) = best else {
        let none = || {
            format!(
                "no exact method with order {} for {} H and what else is claimed was found near these arrays; but this does not prove that none exists",
                table.order, table.class
            )
        };
        return Err(refused(too_much.unwrap_or_else(none)));
    };
    Ok(RefinedTable {
        name: table.name.clone(),
        source: table.source.clone(),
        cells: table.cells.clone(),
        facts: facts(table, &found.solved),
        exact: Exact::Solved(found.solved),
        method: "a table of no particular construction, from its equations".to_owned(),
        notes: other_suspects(table, &found.suspects).into_iter().collect(),
        only_one: found.excluded,
        are_wrong: true,
    })
}

/// The note that a number other than the marked one may be wrong.
fn other_suspects(table: &Table, suspects: &[usize]) -> Option<String> {
    let cells = suspects
        .iter()
        .skip(1)
        .filter_map(|&cell| table.cells.get(cell));
    let names: Vec<String> = cells.map(Cell::name).collect();
    let note = || format!("the wrong number may as well be {}", names.join(" or "));
    (!names.is_empty()).then(note)
}

fn check(table: &Table) -> Result<(), String> {
    let (stages, order) = (table.stages, table.order);
    if stages > MAX_STAGES || !(1..=MAX_ORDER).contains(&order) {
        return Err(format!(
            "{stages} stages and order {order}: tables that are not collocation, steps of the midpoint rule, an explicit symplectic pair or short fractions and surds are refined up to {MAX_STAGES} stages, and orders from 1 to {MAX_ORDER}"
        ));
    }
    Ok(())
}

fn check_work(table: &Table, reading: &Reading) -> Result<(), String> {
    let unknowns = reading.unknowns.len();
    let conditions = reading.system.plan.conditions.len();
    let trees = reading.system.plan.trees.len() + conditions;
    let products = trees * table.stages * table.stages * (1 + unknowns);
    if unknowns > MAX_UNKNOWNS || products > MAX_PRODUCTS {
        return Err(format!(
            "{unknowns} unknowns and {conditions} order conditions are too many: tables of no particular construction are refined up to {MAX_UNKNOWNS} unknowns, and order conditions with {MAX_PRODUCTS} products; claim a lower order, or more properties"
        ));
    }
    Ok(())
}

fn facts(table: &Table, solved: &Solved) -> Vec<String> {
    let evidence = match solved.verified_bits {
        None => "certified".to_owned(),
        Some(bits) => format!("verified to 2^-{bits}, not proved"),
    };
    let mut facts = vec![format!(
        "order {} for {} H, {evidence}",
        table.order, table.class
    )];
    let pair = table.has(Array::ATilde);
    for (claimed, _) in &table.properties {
        facts.push(match claimed {
            Claimed::Symplectic if table.class == HamiltonianClass::General || !pair => {
                format!("symplectic, {evidence}")
            }
            Claimed::Symplectic => format!("symplectic for separable H, {evidence}"),
            Claimed::Symmetric => format!("symmetric, {evidence}"),
            Claimed::Collocation => continue,
        });
    }
    if solved.verified_bits.is_some() {
        let (proved, equations) = (solved.proved, solved.equations);
        facts.push(format!("{proved} of {equations} equations hold, certified"));
    }
    facts
}

fn solve(reading: &Reading, table: &Table) -> Option<Found> {
    let (unknowns, system) = (&reading.unknowns, &reading.system);
    if unknowns.is_empty() {
        return None;
    }
    let pivots = pivots(system, unknowns, RANK_THRESHOLD);
    let (mut kept, mut free): (Vec<usize>, Vec<usize>) = pivots.into_iter().unzip();
    kept.sort_unstable();
    free.sort_unstable();
    let left: Vec<usize> = (0..system.count()).filter(|i| !kept.contains(i)).collect();
    let fixed = unknowns.iter().enumerate().map(|(index, unknown)| {
        let value = || unknown.simple.clone().unwrap_or(unknown.start.clone());
        (!free.contains(&index)).then(value)
    });
    let square = Square {
        fixed: fixed.collect(),
        system: system.keeping(kept),
        free,
    };
    let left = system.keeping(left);
    let places = table.cells.iter().filter_map(|cell| cell.printed.places());
    let digit_bits = 128 + 4 * places.max().unwrap_or(0);
    let first = solved(&square, &left, reading)?;
    if is_right(&first, table, digit_bits) {
        return Some(Found {
            solved: first,
            right: true,
            excluded: false,
            suspects: Vec::new(),
        });
    }
    let (unknowns, targets) = (&reading.unknowns, &reading.targets);
    let (fixed, excluded, suspects) =
        match settle(&square, unknowns, targets, digit_bits, PROOF_BITS) {
            Settled::All(fixed) => (Some(fixed), false, Vec::new()),
            Settled::Wrong { excluded, suspects } => {
                let cells = suspects
                    .iter()
                    .filter_map(|suspect| match suspect.coefficient {
                        Coefficient::Weight(cell) => Some(cell),
                        _ => None,
                    });
                let cells = cells.collect();
                let first = suspects.into_iter().next().map(|suspect| suspect.fixed);
                (first, excluded, cells)
            }
        };
    let moved = fixed.and_then(|fixed| solved(&Square { fixed, ..square }, &left, reading));
    let solved = moved.unwrap_or(first);
    Some(Found {
        right: is_right(&solved, table, digit_bits),
        solved,
        excluded,
        suspects,
    })
}

/// The solution, if it is proved to exist and the remaining equations hold as far as can be determined.
fn solved(square: &Square<TableSystem>, left: &TableSystem, reading: &Reading) -> Option<Solved> {
    let start = square.free.iter().map(|&index| &reading.unknowns[index]);
    let start: Vec<BigRational> = start
        .map(|unknown: &Unknown| unknown.start.clone())
        .collect();
    let center = square.solve(&start, PROOF_BITS)?;
    let proof = Proof::new(square.clone(), center, PROOF_BITS)?;
    let enclosed = Enclosed::with_known(proof, square.fixed.clone());
    let mut verified_bits = None;
    if !left.kept.is_empty() {
        let residuals = left.residuals(&enclosed.unknowns(PROOF_BITS));
        let holds =
            |x: &Interval| x.contains(&BigRational::zero()) && -x.magnitude_bits() >= VERIFIED_BITS;
        if !residuals.iter().all(holds) {
            return None;
        }
        verified_bits = residuals.iter().map(|x| -x.magnitude_bits()).min();
    }
    Some(Solved {
        enclosed: Arc::new(enclosed),
        forms: Arc::new(reading.forms.clone()),
        equations: left.count(),
        proved: square.free.len(),
        verified_bits,
    })
}

fn is_right(solved: &Solved, table: &Table, bits: u32) -> bool {
    let mut cells = table.cells.iter().enumerate();
    let slack = ratio(1, 1) / BigRational::from_integer(BigInt::one() << (bits - 8));
    cells.all(|(index, cell)| {
        let off = solved.enclose(index, bits).middle() - cell.printed.value();
        off.abs() <= cell.printed.half_unit() + &slack
    })
}
