//! Steps of the implicit midpoint rule, and explicit symplectic pairs: compositions of simple steps, which are certified.

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::kinds::close;
use super::read::{Claimed, Table, not_certified};
use super::{Array, Cell, Exact, RefinedTable, Terms};
use symplectic_compiler::Error;
use symplectic_compiler::certify::{
    Certificate, CertifyError, Claim, Coefficient, Digits, Printed, Splitting, certify,
    certify_composition,
};
use symplectic_compiler::expression::Input;
use symplectic_exact::rational::ratio;

/// Whether the entries are those of implicit midpoint steps of lengths `b_i`.
pub(super) fn is_steps_of_midpoint(table: &Table) -> bool {
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

pub(super) fn steps_of_midpoint(
    file: Input<'_>,
    table: &Table,
    nearest: bool,
) -> Result<RefinedTable, Error> {
    let weights = printed(table, Array::B);
    let certificate = or_nearest(certify_composition(&weights, table.order), nearest)
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

/// Whether a pair is explicit: each stage of one half has the terms of all earlier stages; the other half also has its own term.
pub(super) fn is_explicit(table: &Table, kicks_first: bool) -> bool {
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

pub(super) fn explicit_pair(
    file: Input<'_>,
    table: &Table,
    kicks_first: bool,
    nearest: bool,
) -> Result<RefinedTable, Error> {
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
    let splitting = Splitting {
        kick,
        drift,
        gradient: Vec::new(),
    };
    let certificate = or_nearest(certify(&splitting, &claim), nearest);
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

/// A certificate, or with `nearest` the one of the nearest solution that was found.
fn or_nearest(
    found: Result<Certificate, CertifyError>,
    nearest: bool,
) -> Result<Certificate, CertifyError> {
    match nearest {
        true => found.or_else(CertifyError::into_nearest),
        false => found,
    }
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
    // Both kinds are compositions of symplectic maps; kicks and drifts are symplectic for separable H.
    let symplectic = match certificate.structure() {
        structure if structure.composition() => "symplectic, by its structure",
        _ => "symplectic for separable H, by its structure",
    };
    let mut facts = vec![format!("{}, certified", certificate.claim())];
    for (claimed, span) in &table.properties {
        match claimed {
            Claimed::Symplectic => {
                facts.push(symplectic.to_owned());
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
        are_wrong: true,
        exact: Exact::Certified {
            terms: table.cells.iter().map(terms).collect(),
            certificate: Box::new(certificate),
        },
        method,
        facts,
    })
}
