//! The kind of method of printed arrays.

use num_rational::BigRational;
use num_traits::Signed;

use super::RefinedTable;
use super::composed::{explicit_pair, is_explicit, is_steps_of_midpoint, steps_of_midpoint};
use super::exact::{as_printed, by_numbers, in_exact_numbers};
use super::general::by_equations;
use super::nodes::{by_nodes, collocation_of};
use super::read::{Claimed, OffSum, Table, not_certified, off_sums};
use symplectic_compiler::Error;
use symplectic_compiler::expression::Input;
use symplectic_exact::rational::ratio;
use symplectic_exact::rounding::Decimal;

/// Whether two numbers agree well enough to recognise a kind of array. The result is compared with all digits.
pub(super) fn close(x: &BigRational, y: &BigRational) -> bool {
    (x - y).abs() <= ratio(1, 1000)
}

/// The exact method behind a table.
///
/// A `c` that is not a row sum is an error, unless `c` is right and the error is in the row.
/// With `nearest` it is a note, and the method may be far from the digits.
pub(super) fn refine(file: Input<'_>, table: Table, nearest: bool) -> Result<RefinedTable, Error> {
    let off = off_sums(&table);
    let fault = |off: &OffSum| not_certified(file, off.cell.span.clone(), off.message.clone());
    let found = find(file, &table, nearest);
    // Nothing is moved if the numbers satisfy the claim as they are printed.
    let kept = match &found {
        Ok(found) if found.is_as_printed() => None,
        _ => as_printed(file, &table),
    };
    let found = kept.map_or(found, Ok);
    let mut found = found.map_err(|error| off.first().map_or(error, fault))?;
    let wrong = found.wrong_digits();
    let is_wrong = |off: &&OffSum| wrong.iter().any(|(name, _)| *name == off.cell.name());
    match off.iter().find(is_wrong).filter(|_| !nearest) {
        Some(off) => Err(fault(off)),
        None => {
            found.notes.extend(off.into_iter().map(|off| off.message));
            Ok(found)
        }
    }
}

fn find(file: Input<'_>, table: &Table, nearest: bool) -> Result<RefinedTable, Error> {
    let explicit = [true, false]
        .into_iter()
        .find(|&kicks_first| is_explicit(table, kicks_first));
    let collocation = table.claims(Claimed::Collocation);
    let found = if let Some(role) = collocation_of(table) {
        by_nodes(file, table, role)
    } else if collocation {
        let span = claim_span(table, Claimed::Collocation);
        let message = "these are not the arrays of a collocation method with polynomials, Σ_j a_ij c_j^k = c_i^(k+1)/(k+1), nor its symplectic partner, within 0.001; leave `collocation` out of the claim".to_owned();
        Err(not_certified(file, span, message))
    } else if is_steps_of_midpoint(table) {
        steps_of_midpoint(file, table, nearest)
    } else if let Some(kicks_first) = explicit {
        explicit_pair(file, table, kicks_first, nearest)
    } else {
        match by_numbers(file, table) {
            Some(Ok(found)) => Ok(found),
            None => from_equations(file, table),
            // Another method may be as near.
            Some(Err(error)) => {
                let other = from_equations(file, table).ok();
                let near = other.filter(|other| check_distance(file, table, other).is_ok());
                near.ok_or(error)
            }
        }
    }?;
    if !nearest {
        check_distance(file, table, &found)?;
    }
    Ok(found)
}

fn from_equations(file: Input<'_>, table: &Table) -> Result<RefinedTable, Error> {
    let found = by_equations(file, table)?;
    Ok(in_exact_numbers(file, table, found))
}

fn claim_span(table: &Table, property: Claimed) -> std::ops::Range<usize> {
    let mut claimed = table.properties.iter();
    let found = claimed.find(|(known, _)| *known == property);
    found.map_or(table.order_span.clone(), |(_, span)| span.clone())
}

/// Rejects a method that is farther from the print than its digits or a computation in doubles explain.
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
