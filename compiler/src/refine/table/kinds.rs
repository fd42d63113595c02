//! What kind of method printed arrays are, and the exact method of that kind.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::collocation::{Family, Nodes, coefficients, off_collocation, rule, symmetric};
use super::read::{Claimed, OffSum, Table, not_certified, off_sums};
use super::{Array, Cell, Exact, RefinedTable, Terms};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::ratio;
use crate::arithmetic::rounding::Decimal;
use crate::basis::Basis;
use crate::certify::{
    Certificate, Claim, Coefficient, Digits, Printed, Row, Splitting, certify, certify_composition,
    middle, minimax,
};
use crate::definition::{Definition, Key};
use crate::derive::derive_from;
use crate::error::Error;
use crate::expression::Input;
use crate::order::HamiltonianClass;
use crate::properties::Evidence;
use crate::quadrature::QuadratureRule;
use crate::tableau::Tableau;

/// Digits up to which an array is taken for one of a kind. What it leads to is compared with all digits.
fn close(x: &BigRational, y: &BigRational) -> bool {
    (x - y).abs() <= ratio(1, 1000)
}

/// The exact method behind a table.
///
/// A `c` that is not a row sum is an error, unless it is right, and what is wrong is in the row.
pub(super) fn refine(file: Input<'_>, table: Table) -> Result<RefinedTable, Error> {
    let off = off_sums(&table);
    let fault = |off: &OffSum| not_certified(file, off.cell.span.clone(), off.message.clone());
    let mut found = find(file, &table).map_err(|error| off.first().map_or(error, fault))?;
    let wrong = found.wrong_digits();
    let is_wrong = |off: &&OffSum| wrong.iter().any(|(name, _)| *name == off.cell.name());
    match off.iter().find(is_wrong) {
        Some(off) => Err(fault(off)),
        None => {
            found.notes = off.into_iter().map(|off| off.message).collect();
            Ok(found)
        }
    }
}

fn find(file: Input<'_>, table: &Table) -> Result<RefinedTable, Error> {
    let explicit = [true, false]
        .into_iter()
        .find(|&kicks_first| is_explicit(table, kicks_first));
    let collocation = table.claims(Claimed::Collocation);
    let found = if let Some(partner) = collocation_of(table) {
        by_nodes(file, table, partner)
    } else if collocation {
        let span = claim_span(table, Claimed::Collocation);
        let message = "these are not the arrays of a collocation method with polynomials, Σ_j a_ij c_j^k = c_i^(k+1)/(k+1), nor its symplectic partner, within 0.001; leave `collocation` out of the claim".to_owned();
        Err(not_certified(file, span, message))
    } else if is_steps_of_midpoint(table) {
        steps_of_midpoint(file, table)
    } else if let Some(kicks_first) = explicit {
        explicit_pair(file, table, kicks_first)
    } else {
        let message = "no exact method is looked for near these arrays: they are neither collocation with polynomials (with or without the symplectic partner), nor steps of the implicit midpoint rule, nor an explicit symplectic pair".to_owned();
        Err(not_certified(file, table.order_span.clone(), message))
    }?;
    check_distance(file, table, &found)?;
    Ok(found)
}

fn claim_span(table: &Table, property: Claimed) -> std::ops::Range<usize> {
    let mut claimed = table.properties.iter();
    let found = claimed.find(|(known, _)| *known == property);
    found.map_or(table.order_span.clone(), |(_, span)| span.clone())
}

/// Refuses a method that is farther from the print than its digits or a computation in doubles explain.
fn check_distance(file: Input<'_>, table: &Table, found: &RefinedTable) -> Result<(), Error> {
    const TOLERANCE_PLACES: std::ops::RangeInclusive<u32> = 3..=10;
    let places = table.cells.iter().filter_map(|cell| cell.printed.places());
    let (fewest, most) = (*TOLERANCE_PLACES.start(), *TOLERANCE_PLACES.end());
    let places = places
        .max()
        .map_or(most, |n| n.saturating_sub(1).clamp(fewest, most));
    let tolerance = ratio(1, 10i64.pow(places));
    let far = table.cells.iter().zip(found.distances());
    let far = far.filter(|(cell, distance)| {
        distance.at_most > tolerance && distance.at_least > cell.printed.half_unit()
    });
    let farthest = far.max_by(|(_, x), (_, y)| x.at_most.cmp(&y.at_most));
    let Some((cell, distance)) = farthest else {
        return Ok(());
    };
    let message = format!(
        "the method that is claimed, {}, is {} away from {} = {}, and the digits allow for {}",
        found.method,
        Decimal::round(&distance.at_most, 2),
        cell.name(),
        cell.printed.text(),
        Decimal::round(&tolerance, 2),
    );
    Err(not_certified(file, cell.span.clone(), message))
}

/// Which of the two arrays is that of a collocation method.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    /// `a`, and `ã` is its partner or not printed.
    Positions,
    /// `ã`, and `a` is its partner.
    Momenta,
}

fn collocation_of(table: &Table) -> Option<Role> {
    let is = |matrix: Array| {
        let c: Vec<BigRational> = (0..table.stages).map(|i| node(table, matrix, i)).collect();
        let off = off_collocation(
            table.stages,
            |i, j| table.value(matrix, i, j),
            |i| c[i].clone(),
        );
        off <= ratio(1, 1000)
    };
    if is(Array::A) {
        Some(Role::Positions)
    } else if table.has(Array::ATilde) && is(Array::ATilde) {
        Some(Role::Momenta)
    } else {
        None
    }
}

/// The printed node of a stage: an entry of `c`, or the sum of the row.
fn node(table: &Table, matrix: Array, stage: usize) -> BigRational {
    let list = if matrix == Array::A {
        Array::C
    } else {
        Array::CTilde
    };
    match table.cell(list, stage, 0) {
        Some(cell) => cell.printed.value().clone(),
        None => table.row_sum(matrix, stage).0,
    }
}

/// Whether a node is printed exactly: as a fraction or an integer, or as 0 or 1.
fn is_exact(table: &Table, matrix: Array, stage: usize) -> bool {
    let list = if matrix == Array::A {
        Array::C
    } else {
        Array::CTilde
    };
    let value = node(table, matrix, stage);
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

fn by_nodes(file: Input<'_>, table: &Table, role: Role) -> Result<RefinedTable, Error> {
    let matrix = match role {
        Role::Positions => Array::A,
        Role::Momenta => Array::ATilde,
    };
    let printed: Vec<BigRational> = (0..table.stages).map(|i| node(table, matrix, i)).collect();
    let exact = (0..table.stages).filter(|&i| is_exact(table, matrix, i));
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
    let mut method = format!("polynomial({}) at {}", table.stages, rule.name());
    method.push_str(match (role, table.has(Array::ATilde)) {
        (Role::Positions, false) => "",
        (Role::Positions, true) => " with its symplectic partner",
        (Role::Momenta, _) => " for momenta, with its symplectic partner for positions",
    });
    let facts = proved(file, table, tableau, &rule)?;
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
    if named {
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
    if role == Role::Momenta {
        tableau.exact = tableau.exact.exchanged();
    }
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
            Claimed::Collocation => (true, "collocation"),
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

/// Whether the entries are those of implicit midpoint steps of lengths `b_i`.
fn is_steps_of_midpoint(table: &Table) -> bool {
    let wanted = |i: usize, j: usize| {
        let b = table.value(Array::B, j, 0);
        match i.cmp(&j) {
            std::cmp::Ordering::Greater => b,
            std::cmp::Ordering::Equal => b * ratio(1, 2),
            std::cmp::Ordering::Less => BigRational::zero(),
        }
    };
    let fits = |cell: &Cell| match cell.array {
        Array::A | Array::ATilde => close(cell.printed.value(), &wanted(cell.row, cell.column)),
        Array::BTilde => close(cell.printed.value(), &table.value(Array::B, cell.row, 0)),
        _ => true,
    };
    table.cells.iter().all(fits)
}

fn steps_of_midpoint(file: Input<'_>, table: &Table) -> Result<RefinedTable, Error> {
    let weights = printed(table, Array::B);
    let certificate = certify_composition(&weights, table.order)
        .map_err(|error| not_certified(file, table.order_span.clone(), error.to_string()))?;
    let weight = |index: usize, factor: BigRational| (Coefficient::Weight(index), factor);
    let terms = |cell: &Cell| -> Terms {
        let half = ratio(1, 2);
        let row = |end: usize| (0..end).map(|j| weight(j, BigRational::one()));
        match cell.array {
            Array::B | Array::BTilde => vec![weight(cell.row, BigRational::one())],
            Array::A | Array::ATilde if cell.column < cell.row => {
                vec![weight(cell.column, BigRational::one())]
            }
            Array::A | Array::ATilde if cell.column == cell.row => vec![weight(cell.row, half)],
            Array::A | Array::ATilde => Vec::new(),
            Array::C | Array::CTilde => row(cell.row).chain([weight(cell.row, half)]).collect(),
        }
    };
    let method = "steps of the implicit midpoint rule of lengths b".to_owned();
    certified(file, table, certificate, method, terms)
}

/// Whether a pair is explicit: each stage of one half has the terms of all earlier ones, and of the other half its own too.
fn is_explicit(table: &Table, kicks_first: bool) -> bool {
    if !table.has(Array::ATilde) {
        return false;
    }
    let fits = |cell: &Cell| {
        let (weights, own) = match cell.array {
            Array::A => (Array::B, !kicks_first),
            Array::ATilde => (b_tilde(table), kicks_first),
            _ => return true,
        };
        let there = cell.column < cell.row || own && cell.column == cell.row;
        let wanted = match there {
            true => table.value(weights, cell.column, 0),
            false => BigRational::zero(),
        };
        close(cell.printed.value(), &wanted)
    };
    table.cells.iter().all(fits)
}

fn b_tilde(table: &Table) -> Array {
    if table.has(Array::BTilde) {
        Array::BTilde
    } else {
        Array::B
    }
}

fn explicit_pair(file: Input<'_>, table: &Table, kicks_first: bool) -> Result<RefinedTable, Error> {
    let refused = |message: String| not_certified(file, table.order_span.clone(), message);
    let Some(claim) = Claim::of(table.class, table.order) else {
        let message = "an explicit pair has its order for separable H, or for quadratic T: claim `class = \"separable\"` or \"nystrom\"";
        return Err(refused(message.to_owned()));
    };
    let (mut kick, mut drift) = (printed(table, b_tilde(table)), printed(table, Array::B));
    if !kicks_first {
        kick.insert(0, Printed::zero());
        drift.push(Printed::zero());
    }
    let certificate = certify(&Splitting { kick, drift }, &claim);
    let certificate = certificate.map_err(|error| refused(error.to_string()))?;
    let shift = usize::from(!kicks_first);
    let terms = |cell: &Cell| -> Terms {
        let kicks = matches!(cell.array, Array::ATilde | Array::BTilde | Array::CTilde);
        let own = kicks == kicks_first;
        let term = |index: usize| {
            let name = match kicks {
                true => Coefficient::Kick(index + shift),
                false => Coefficient::Drift(index),
            };
            (name, BigRational::one())
        };
        let end = cell.row + usize::from(own);
        match cell.array {
            Array::B | Array::BTilde => vec![term(cell.row)],
            Array::A | Array::ATilde if cell.column < end => vec![term(cell.column)],
            Array::A | Array::ATilde => Vec::new(),
            Array::C | Array::CTilde => (0..end).map(term).collect(),
        }
    };
    let order = if kicks_first {
        "kicks first"
    } else {
        "drifts first"
    };
    certified(
        file,
        table,
        certificate,
        format!("explicit pair, {order}"),
        terms,
    )
}

fn printed(table: &Table, array: Array) -> Vec<Printed> {
    let cells = table.cells.iter().filter(|cell| cell.array == array);
    cells.map(|cell| cell.printed.clone()).collect()
}

fn certified(
    file: Input<'_>,
    table: &Table,
    certificate: Certificate,
    method: String,
    terms: impl Fn(&Cell) -> Terms,
) -> Result<RefinedTable, Error> {
    // Both kinds are compositions of symplectic maps. In an explicit pair they are so for separable H.
    let mut facts = vec![format!("{}, certified", certificate.claim())];
    for (claimed, span) in &table.properties {
        match claimed {
            Claimed::Symplectic => {
                facts.push("symplectic, by its structure".to_owned());
            }
            Claimed::Symmetric if certificate.structure().symmetric() => {
                facts.push("symmetric, by its structure".to_owned());
            }
            Claimed::Symmetric => {
                let message = "no symmetric method was found near these digits".to_owned();
                return Err(not_certified(file, span.clone(), message));
            }
            Claimed::Collocation => {}
        }
    }
    Ok(RefinedTable {
        name: table.name.clone(),
        source: table.source.clone(),
        cells: table.cells.clone(),
        notes: Vec::new(),
        only_one: certificate.digits() == Digits::Excluded,
        exact: Exact::Certified {
            terms: table.cells.iter().map(terms).collect(),
            certificate: Box::new(certificate),
        },
        method,
        facts,
    })
}
