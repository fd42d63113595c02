//! The facts about a refined table, as text and as JSON.

use std::collections::BTreeMap;

use num_rational::BigRational;
use num_traits::Zero;
use serde_json::{Value, json};

use super::{Array, Cell, Exact, RefinedTable};
use crate::refine::write::at_most;
use symplectic_compiler::certify::{CertifyError, Digits, MAX_DIGITS};
use symplectic_compiler::{Error, ErrorKind};
use symplectic_exact::interval::Interval;
use symplectic_exact::rational::simplest_between;
use symplectic_exact::rounding::Decimal;

/// All numbers, correctly rounded.
pub(super) fn decimals(table: &RefinedTable, digits: usize) -> Result<Vec<String>, Error> {
    if digits > MAX_DIGITS {
        let error = CertifyError::Digits {
            digits,
            limit: MAX_DIGITS,
        };
        let message = error.to_string();
        return Err(ErrorKind::NotCertified { message }.into());
    }
    Ok(table.exact.values(
        &table.cells,
        |number| number.decimal(digits).to_string(),
        |enclose| rounded(enclose, digits),
    ))
}

/// A number, given by enclosures of any precision, rounded.
fn rounded(enclose: impl Fn(u32) -> Interval, digits: usize) -> String {
    let mut bits = u32::try_from(digits * 334 / 100)
        .unwrap_or(u32::MAX)
        .saturating_add(64);
    for _ in 0..4 {
        let interval = enclose(bits);
        let low = Decimal::round(&interval.low(), digits);
        if low == Decimal::round(&interval.high(), digits) {
            return low.to_string();
        }
        bits = bits.saturating_add(bits / 2);
    }
    // Possibly a tie.
    let interval = enclose(bits);
    Decimal::round(&simplest_between(&interval.low(), &interval.high()), digits).to_string()
}

fn evidence(table: &RefinedTable) -> &'static str {
    match &table.exact {
        Exact::Derived { .. } => "proved",
        Exact::Certified { .. } => "certified",
        Exact::Solved(solved) if solved.is_certified() => "certified",
        Exact::Solved(_) => "verified",
    }
}

fn farthest(table: &RefinedTable) -> BigRational {
    let distances = table.distances().into_iter();
    let bounds = distances.map(|distance| distance.at_most);
    bounds.fold(BigRational::zero(), BigRational::max)
}

pub(super) fn text(table: &RefinedTable, digits: usize) -> Result<String, Error> {
    let mut text = String::new();
    let origin = [&table.name, &table.source].into_iter().flatten();
    let origin: Vec<&str> = origin.map(String::as_str).collect();
    if !origin.is_empty() {
        let line = origin.join(", ");
        let line = line.replace(|c: char| c.is_control(), "\u{fffd}");
        text.push_str(&format!("{line}\n\n"));
    }
    text.push_str(&format!(
        "{}: {} is within {} of the printed digits\n",
        evidence(table),
        match evidence(table) {
            "verified" => "a method",
            _ => "an exact method",
        },
        at_most(&farthest(table))
    ));
    let mut line = |name: &str, words: &str| text.push_str(&format!("  {name:<13}{words}\n"));
    line("method", &table.method);
    for (index, fact) in table.facts.iter().enumerate() {
        line(if index == 0 { "claim" } else { "" }, fact);
    }
    let wrong: BTreeMap<String, BigRational> = table.wrong_digits().into_iter().collect();
    line(
        "wrong digits",
        &match wrong.len() {
            0 => "none".to_owned(),
            count if !table.are_wrong => format!(
                "not told: {count} of {} numbers are not those of the nearest method, marked below",
                table.cells.len()
            ),
            count => format!("in {count} of {} numbers, marked below", table.cells.len()),
        },
    );
    match table.digits() {
        Digits::All => {}
        Digits::Excluded => line(
            "",
            "proved: no method of this kind as claimed rounds to all printed digits",
        ),
        Digits::NotFound => line(
            "",
            "other methods of this kind as claimed were not looked for: they may have all digits",
        ),
    }
    for note in &table.notes {
        line("note", note);
    }
    let mut last = None;
    for (cell, decimal) in table.cells.iter().zip(decimals(table, digits)?) {
        if last != Some(cell.array) {
            text.push('\n');
            last = Some(cell.array);
        }
        let name = cell.name();
        let sign = if decimal.starts_with('-') { "" } else { " " };
        let off = wrong.get(&name).map(at_most);
        let off = off.map_or_else(String::new, |off| format!("  (the print is off by {off})"));
        text.push_str(&format!("  {name:<8} {sign}{decimal}{off}\n"));
    }
    Ok(text)
}

pub(super) fn json(table: &RefinedTable, digits: usize) -> Result<String, Error> {
    let wrong = table.wrong_digits().into_iter();
    let wrong: Vec<Value> = wrong
        .map(|(name, off)| json!({ "coefficient": name, "distance": at_most(&off) }))
        .collect();
    let mut report = json!({
        "name": table.name,
        "source": table.source,
        "evidence": evidence(table),
        "method": table.method,
        "facts": table.facts,
        "notes": table.notes,
        "distance": at_most(&farthest(table)),
        "wrong_digits": wrong,
        "printed_digits": match table.digits() {
            Digits::All => "all",
            Digits::Excluded => "excluded",
            Digits::NotFound => "not found",
        },
        "digits": digits,
    });
    let decimals = decimals(table, digits)?;
    for array in Array::ALL {
        let cells = table.cells.iter().zip(&decimals);
        let cells: Vec<(&Cell, &String)> = cells.filter(|(cell, _)| cell.array == array).collect();
        if cells.is_empty() {
            continue;
        }
        let entry = |(cell, decimal): &(&Cell, &String)| json!({ "printed": cell.printed.text(), "decimal": decimal });
        report[array.name()] = match array.is_matrix() {
            true => {
                let rows = cells.chunk_by(|(x, _), (y, _)| x.row == y.row);
                rows.map(|row| Value::from(row.iter().map(entry).collect::<Vec<_>>()))
                    .collect()
            }
            false => cells.iter().map(entry).collect(),
        };
    }
    Ok(format!("{report:#}\n"))
}
