//! Collocation methods with polynomials and their symplectic partners, from their nodes.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::collocation::{Family, Nodes, coefficients, off_collocation, rule, symmetric};
use super::kinds::close;
use super::read::{Claimed, Table, not_certified};
use super::{Array, Cell, Exact, RefinedTable};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::ratio;
use crate::basis::Basis;
use crate::certify::{Row, middle, minimax};
use crate::definition::{Definition, Key};
use crate::derive::derive_from;
use crate::error::Error;
use crate::evidence::Evidence;
use crate::expression::Input;
use crate::order::HamiltonianClass;
use crate::quadrature::QuadratureRule;
use crate::tableau::Tableau;

/// Which array is that of a collocation method.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// `a`, and `ã` is its partner or not printed.
    Positions,
    /// `ã`, and `a` is its partner.
    Momenta,
    /// The partner of `a`, which is not printed: `a` is that of Radau IA or Lobatto IIIB.
    Partner,
}

impl Role {
    /// An entry of the collocation method; `None` where a weight vanishes, so that there is no partner.
    fn entry(self, table: &Table, i: usize, j: usize) -> Option<BigRational> {
        let weight = |i: usize| table.value(Array::B, i, 0);
        match self {
            Role::Positions => Some(table.value(Array::A, i, j)),
            Role::Momenta => Some(table.value(Array::ATilde, i, j)),
            Role::Partner if weight(i).is_zero() => None,
            Role::Partner => {
                Some(weight(j) * (BigRational::one() - table.value(Array::A, j, i) / weight(i)))
            }
        }
    }

    /// The printed node of a stage: an entry of `c`, or the sum of the row.
    fn node(self, table: &Table, stage: usize) -> BigRational {
        let row = (0..table.stages).filter_map(|j| self.entry(table, stage, j));
        let sum: BigRational = row.sum();
        let list = match self {
            Role::Positions | Role::Partner => Array::C,
            Role::Momenta => Array::CTilde,
        };
        let cell = table.cell(list, stage, 0);
        match (self, cell.map(|cell| cell.printed.value().clone())) {
            // Its nodes need not be the sums of the rows that are printed.
            (Role::Partner, Some(printed)) if close(&printed, &sum) => near_end(printed),
            (Role::Partner, _) => near_end(sum),
            (_, Some(printed)) => printed,
            (_, None) => sum,
        }
    }

    /// Whether a node is printed exactly: as a fraction or an integer, or as 0 or 1.
    fn is_exact(self, table: &Table, stage: usize) -> bool {
        let (list, matrix) = match self {
            Role::Positions => (Array::C, Array::A),
            Role::Momenta => (Array::CTilde, Array::ATilde),
            Role::Partner => {
                let value = self.node(table, stage);
                return value.is_zero() || value.is_one();
            }
        };
        let value = self.node(table, stage);
        let exact = |cell: &Cell| cell.printed.places().is_none();
        let row = table.cells.iter();
        let mut row = row.filter(|cell| cell.array == matrix && cell.row == stage);
        value.is_zero()
            || value.is_one()
            || match table.cell(list, stage, 0) {
                Some(cell) => exact(cell),
                None => row.all(exact),
            }
    }
}

/// 0 or 1, if a number computed from rounded ones lies that near; otherwise the number.
fn near_end(value: BigRational) -> BigRational {
    let ends = [BigRational::zero(), BigRational::one()].into_iter();
    let mut near = ends.filter(|end| (&value - end).abs() <= ratio(1, 1_000_000));
    near.next().unwrap_or(value)
}

pub(super) fn collocation_of(table: &Table) -> Option<Role> {
    let is = |role: &Role| {
        let stages = 0..table.stages;
        let row = |i: usize| stages.clone().map(move |j| role.entry(table, i, j));
        let entries: Option<Vec<Vec<BigRational>>> =
            stages.clone().map(|i| row(i).collect()).collect();
        let c: Vec<BigRational> = stages.clone().map(|i| role.node(table, i)).collect();
        entries.is_some_and(|a| {
            let off = off_collocation(table.stages, |i, j| a[i][j].clone(), |i| c[i].clone());
            off <= ratio(1, 1000)
        })
    };
    let roles: &[Role] = match table.has(Array::ATilde) {
        true => &[Role::Positions, Role::Momenta],
        false => &[Role::Positions, Role::Partner],
    };
    roles.iter().copied().find(is)
}

pub(super) fn by_nodes(file: Input<'_>, table: &Table, role: Role) -> Result<RefinedTable, Error> {
    let printed: Vec<BigRational> = (0..table.stages).map(|i| role.node(table, i)).collect();
    let exact = (0..table.stages).filter(|&i| role.is_exact(table, i));
    let claimed = table.claims(Claimed::Symmetric);
    let mut nodes = Nodes {
        exact: exact.map(|i| printed[i].clone()).collect(),
        symmetric: claimed,
        order: table.order,
        printed,
    };
    // Nodes that are symmetric in print and not claimed to be are kept so, if anything is left to choose.
    let mut family = Family::of(&nodes);
    let only_one = family
        .as_ref()
        .is_some_and(|family| family.free().is_empty());
    if family.is_some() && !only_one && symmetric(&nodes.printed) {
        nodes.symmetric = true;
        family = Family::of(&nodes).or(family);
    }
    let refused = |message: String| not_certified(file, table.order_span.clone(), message);
    let Some(family) = family else {
        let stages = table.stages;
        let message = format!(
            "no collocation method with {stages} node{}{}{} has order {}",
            if stages == 1 { "" } else { "s" },
            if nodes.symmetric {
                ", symmetric ones,"
            } else {
                ""
            },
            match nodes.exact.len() {
                0 => String::new(),
                count => format!(", {count} of them as printed exactly,"),
            },
            table.order
        );
        return Err(refused(message));
    };
    let build = |coefficients: &[BigRational]| {
        let (rule, named) = rule(&family.polynomial(coefficients))?;
        let exact = Exact::Derived {
            tableau: Box::new(derived(&rule, named, role)?),
            stages: ranks(&nodes.printed),
        };
        Ok::<_, String>((rule, exact))
    };
    let start = coefficients(&nodes.printed);
    let (rule, exact) =
        within_last_places(table, &family.free(), start, build).map_err(&refused)?;
    let Exact::Derived { tableau, .. } = &exact else {
        return Err(refused("the table is not derived".to_owned()));
    };
    let collocation = format!("polynomial({}) at {}", table.stages, rule.name());
    let method = match (role, table.has(Array::ATilde)) {
        (Role::Positions, false) => collocation,
        (Role::Positions, true) => format!("{collocation} with its symplectic partner"),
        (Role::Momenta, _) => {
            format!("{collocation} for momenta, with its symplectic partner for positions")
        }
        (Role::Partner, _) => format!("the symplectic partner of {collocation}, alone"),
    };
    let facts = proved(file, table, tableau, &rule, role)?;
    Ok(RefinedTable {
        name: table.name.clone(),
        source: table.source.clone(),
        cells: table.cells.clone(),
        exact,
        method,
        facts,
        notes: Vec::new(),
        only_one,
    })
}

/// The method whose numbers are nearest to their prints, each measured by its own last place: the free coefficients of the
/// node polynomial are moved as in [`minimax`].
fn within_last_places(
    table: &Table,
    free: &[usize],
    start: Vec<BigRational>,
    build: impl Fn(&[BigRational]) -> Result<(QuadratureRule, Exact), String>,
) -> Result<(QuadratureRule, Exact), String> {
    const MAX_SHIFTS: usize = 4;
    let places = table
        .cells
        .iter()
        .filter_map(|cell| cell.printed.places())
        .max();
    let places = places.unwrap_or(0);
    let bits = 192 + 4 * places;
    // Steps of difference quotients: as small as the digits.
    let step = BigRational::new(BigInt::one(), BigInt::from(10).pow(places));
    let scale = BigRational::from_integer(BigInt::from(10).pow(places + 4));
    let printed: Vec<&Cell> = {
        let cells = table.cells.iter();
        cells
            .filter(|cell| cell.printed.half_unit().is_positive())
            .collect()
    };
    let units = |value: &BigRational| middle(&Interval::enclosing(value, bits));
    let numbers = |exact: &Exact| -> Vec<BigInt> {
        let pairs = table.cells.iter().zip(exact.enclosures(&table.cells, bits));
        let pairs = pairs.filter(|(cell, _)| cell.printed.half_unit().is_positive());
        pairs.map(|(_, enclosure)| middle(&enclosure)).collect()
    };
    let mut coefficients = start;
    let mut best = build(&coefficients)?;
    let mut reached = None;
    for _ in 0..MAX_SHIFTS {
        let at = numbers(&best.1);
        let halves: Vec<BigInt> = printed
            .iter()
            .map(|cell| units(&cell.printed.half_unit()))
            .collect();
        let residuals: Vec<BigInt> = {
            let pairs = at.iter().zip(&printed);
            pairs
                .map(|(value, cell)| value - units(cell.printed.value()))
                .collect()
        };
        let mut pairs = residuals.iter().zip(&halves);
        if free.is_empty() || pairs.all(|(residual, half)| residual.abs() <= *half) {
            break;
        }
        let mut slopes: Vec<Vec<BigInt>> = vec![Vec::new(); printed.len()];
        for &power in free {
            let mut moved = coefficients.clone();
            moved[power] += &step;
            let moved = numbers(&build(&moved)?.1);
            for ((slopes, after), before) in slopes.iter_mut().zip(moved).zip(&at) {
                slopes.push(after - before);
            }
        }
        let rows: Vec<Row> = {
            let rows = residuals.into_iter().zip(slopes).zip(halves);
            rows.map(|((residual, slopes), half)| Row {
                residual,
                slopes,
                half,
            })
            .collect()
        };
        // A level that does not fall is the nearest there is.
        let Some(found) = minimax(&rows) else { break };
        if reached.as_ref().is_some_and(|level| found.level >= *level) {
            break;
        }
        reached = Some(found.level);
        for (&power, shift) in free.iter().zip(&found.shift) {
            let exact = (&coefficients[power] + shift * &step) * &scale;
            coefficients[power] = exact.round() / &scale;
        }
        best = build(&coefficients)?;
    }
    Ok(best)
}

fn derived(rule: &QuadratureRule, named: bool, role: Role) -> Result<Tableau, String> {
    let basis = Basis::monomials(rule.len());
    if named && role != Role::Partner {
        let mut parts = vec![
            (Key::Basis, format!("polynomial({})", rule.len())),
            (Key::Nodes, rule.name().to_owned()),
        ];
        if role == Role::Momenta {
            parts.push((Key::Exchange, "true".to_owned()));
        }
        let derived = Definition::new(parts).derive(&crate::Limits::default());
        return derived.map_err(|error| error.kind.to_string());
    }
    let mut tableau = derive_from(&basis, rule).map_err(|kind| kind.to_string())?;
    tableau.exact = match role {
        Role::Positions => tableau.exact,
        Role::Momenta => tableau.exact.exchanged(),
        Role::Partner => tableau.exact.partner_alone(),
    };
    Ok(tableau)
}

/// The place of each value in ascending order.
fn ranks(values: &[BigRational]) -> Vec<usize> {
    let mut sorted: Vec<usize> = (0..values.len()).collect();
    sorted.sort_by(|&i, &j| values[i].cmp(&values[j]));
    let mut ranks = vec![0; values.len()];
    for (rank, index) in sorted.into_iter().enumerate() {
        ranks[index] = rank;
    }
    ranks
}

/// What is claimed and proved of a derived table.
fn proved(
    file: Input<'_>,
    table: &Table,
    tableau: &Tableau,
    rule: &QuadratureRule,
    role: Role,
) -> Result<Vec<String>, Error> {
    let properties = tableau.properties();
    // A table alone stands for both halves.
    let pair = table.has(Array::ATilde) || properties.equal_matrices.holds;
    let quadrature = rule.degree_of_precision() + 1;
    let (order, class, why) = match pair {
        true => {
            let orders = tableau.orders();
            let found = orders.class(table.class);
            match found.evidence {
                Evidence::Proved | Evidence::Refuted => (found.order, table.class, "proved"),
                _ => (0, table.class, "not proved"),
            }
        }
        // The order of a collocation method is that of its quadrature (GNI II.1.5), for all Hamiltonians.
        false => (
            quadrature,
            HamiltonianClass::General,
            "that of the quadrature, proved",
        ),
    };
    if order < table.order {
        let message = format!(
            "the method has order {order} for {class} H, {why}, and not {}",
            table.order
        );
        return Err(not_certified(file, table.order_span.clone(), message));
    }
    let mut facts = vec![format!("order {order} for {class} H, {why}")];
    let degree = rule.degree_of_precision();
    for (claimed, span) in &table.properties {
        let (holds, name) = match claimed {
            Claimed::Symplectic if pair => (properties.symplectic.holds, "symplectic"),
            // With C(s) and the Vandermonde matrix V, VᵀMV of M_ij = b_i a_ij + b_j a_ji − b_i b_j vanishes iff B(2s) holds.
            Claimed::Symplectic => (degree + 1 >= 2 * table.stages, "symplectic"),
            Claimed::Symmetric if pair => (properties.symmetric.holds, "symmetric"),
            Claimed::Symmetric => (is_symmetric(rule), "symmetric"),
            Claimed::Collocation => (role != Role::Partner, "collocation"),
        };
        if !holds {
            let message = format!("the method is not {name}, which is proved");
            return Err(not_certified(file, span.clone(), message));
        }
        facts.push(format!("{name}, proved"));
    }
    Ok(facts)
}

/// Whether the nodes are: the polynomial is, up to its sign, its own mirror image.
fn is_symmetric(rule: &QuadratureRule) -> bool {
    let modulus = rule.algebra().modulus();
    let mirror = crate::arithmetic::polynomial::Polynomial::from_integers(&[1, -1]);
    let mirrored = modulus.compose(&mirror);
    mirrored.primitive() == modulus.primitive()
        || mirrored.scale(&ratio(-1, 1)).primitive() == modulus.primitive()
}
