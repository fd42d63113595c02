//! Tables of fractions and surds of any construction: all claims are decided in exact arithmetic.

use super::read::{Claimed, Table, not_certified};
use super::surds::recognised;
use super::write::decimals;
use super::{Array, Cell, Exact, RefinedTable};
use symplectic_compiler::Error;
use symplectic_compiler::Evidence;
use symplectic_compiler::Limits;
use symplectic_compiler::Tableau;
use symplectic_compiler::certify::Printed;
use symplectic_compiler::expression::Input;
use symplectic_compiler::{Definition, Key};

/// The printed numbers themselves, if they satisfy the claim exactly and every printed `c` is the rounded sum of its row.
pub(super) fn as_printed(file: Input<'_>, table: &Table) -> Option<RefinedTable> {
    let texts = table.cells.iter();
    let texts: Vec<String> = texts.map(|x| format!("({})", x.printed.value())).collect();
    let tableau = tableau(table, &texts)?;
    let facts = facts(file, table, &tableau).ok()?;
    let method = "the numbers as they are printed, which satisfy the claim exactly";
    let kept = derived(table, tableau, method, facts);
    kept.wrong_digits().is_empty().then_some(kept)
}

/// A table of which the printed stages are the stages.
fn derived(table: &Table, tableau: Tableau, method: &str, facts: Vec<String>) -> RefinedTable {
    RefinedTable {
        name: table.name.clone(),
        source: table.source.clone(),
        cells: table.cells.clone(),
        exact: Exact::Derived {
            stages: (0..table.stages).collect(),
            tableau: Box::new(tableau),
        },
        method: method.to_owned(),
        facts,
        notes: Vec::new(),
        only_one: false,
        are_wrong: true,
    }
}

/// The table that the digits round; `None` if the digits are not those of fractions and surds with one root.
///
/// # Errors
/// A claim that does not hold for this table.
pub(super) fn by_numbers(file: Input<'_>, table: &Table) -> Option<Result<RefinedTable, Error>> {
    let texts = recognised(table)?;
    let tableau = tableau(table, &texts)?;
    let method = "the fractions and surds that the digits are the roundings of";
    let facts = facts(file, table, &tableau);
    Some(facts.map(|facts| derived(table, tableau, method, facts)))
}

/// The same method in exact numbers, if the numbers that were found are fractions and surds.
pub(super) fn in_exact_numbers(
    file: Input<'_>,
    table: &Table,
    found: RefinedTable,
) -> RefinedTable {
    const DIGITS: usize = 40;
    let reprinted = |decimals: Vec<String>| -> Option<Table> {
        let pairs = table.cells.iter().zip(decimals);
        let cells = pairs.map(|(cell, decimal)| {
            let printed = Printed::parse(&decimal).ok()?;
            Some(Cell {
                printed,
                ..cell.clone()
            })
        });
        Some(Table {
            cells: cells.collect::<Option<_>>()?,
            ..table.clone()
        })
    };
    let decimals = decimals(&found, DIGITS).ok();
    let exact = decimals.and_then(reprinted);
    match exact.and_then(|exact| by_numbers(file, &exact)) {
        Some(Ok(exact)) => RefinedTable {
            cells: found.cells,
            notes: found.notes,
            only_one: found.only_one,
            are_wrong: found.are_wrong,
            method: "fractions and surds, from the equations of the table".to_owned(),
            ..exact
        },
        _ => found,
    }
}

fn tableau(table: &Table, texts: &[String]) -> Option<Tableau> {
    let row = |array: Array, row: Option<usize>| {
        let cells = table.cells.iter().zip(texts);
        let cells = cells.filter(|(cell, _)| cell.array == array);
        let cells = cells.filter(|(cell, _)| row.is_none_or(|row| cell.row == row));
        let texts: Vec<&str> = cells.map(|(_, text)| text.as_str()).collect();
        texts.join(", ")
    };
    let rows = |array: Array| {
        let rows = (0..table.stages).map(|i| format!("[{}]", row(array, Some(i))));
        format!("[{}]", rows.collect::<Vec<_>>().join(", "))
    };
    let mut parts = vec![(Key::A, rows(Array::A)), (Key::B, row(Array::B, None))];
    if table.has(Array::ATilde) {
        parts.push((Key::ATilde, rows(Array::ATilde)));
    }
    if table.has(Array::BTilde) {
        parts.push((Key::BTilde, row(Array::BTilde, None)));
    }
    Definition::new(parts).derive(&Limits::default()).ok()
}

/// The proved claims.
fn facts(file: Input<'_>, table: &Table, tableau: &Tableau) -> Result<Vec<String>, Error> {
    let orders = tableau.orders();
    let (found, class) = (orders.class(table.class), table.class);
    let proved = matches!(found.evidence, Evidence::Proved | Evidence::Refuted);
    if !proved || found.order < table.order {
        let what = match proved {
            true => format!("order {} for {class} H, which is proved", found.order),
            false => format!("an order for {class} H that is not proved"),
        };
        let message = format!(
            "the fractions and surds that the digits are the roundings of have {what}, and not {}; other exact methods near them are not looked for",
            table.order
        );
        return Err(not_certified(file, table.order_span.clone(), message));
    }
    let mut facts = vec![format!("order {} for {class} H, proved", found.order)];
    let properties = tableau.properties();
    for (claimed, span) in &table.properties {
        let (property, name) = match claimed {
            Claimed::Symplectic => (Some(&properties.symplectic), "symplectic"),
            Claimed::Symmetric => (Some(&properties.symmetric), "symmetric"),
            // Collocation tables are recognised by their nodes.
            Claimed::Collocation => (None, "collocation"),
        };
        let evidence = property.map_or(Evidence::Refuted, |property| property.evidence);
        let refused = match evidence {
            Evidence::Proved => None,
            Evidence::Refuted => Some(format!("the method is not {name}, which is proved")),
            _ => Some(format!("whether the method is {name} is not proved")),
        };
        if let Some(message) = refused {
            return Err(not_certified(file, span.clone(), message));
        }
        facts.push(format!("{name}, proved"));
    }
    Ok(facts)
}
