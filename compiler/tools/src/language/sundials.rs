//! C for ARKODE of SUNDIALS.

use super::c::{comment, numbers};
use super::not_expressible;
use super::table::{Entry, Stepped, Table};
use symplectic_compiler::Error;
use symplectic_compiler::Library;
use symplectic_compiler::order::HamiltonianClass;

pub(super) fn write(table: &Table<'_>) -> Result<String, Error> {
    if let Some(flows) = table.stepped_by(Library::Sundials) {
        return Ok(splitting(table, &flows));
    }
    if !table.is_runge_kutta() {
        let reason = "ARKODE has partitioned methods that are explicit only (SPRKStep), and this one is implicit";
        return Err(not_expressible("SUNDIALS", reason));
    }
    let rows = table.entries.a.iter().enumerate();
    let mut above = rows.flat_map(|(i, row)| row.iter().skip(i + 1));
    if above.any(|entry| entry.double != 0.0) {
        let reason = "its stages need one another, and the implicit methods of ARKODE (ARKStep) have lower triangular matrices";
        return Err(not_expressible("SUNDIALS", reason));
    }
    let (stages, name) = (table.tableau.stages(), &table.name);
    let a: String = table
        .entries
        .a
        .iter()
        .map(|row| numbers("    ", row))
        .collect();
    Ok(format!(
        "{}#include <arkode/arkode_butcher.h>\n\n/* For ARKStepSetTables. */\nstatic ARKodeButcherTable {name}(void) {{\n{}{}  static sunrealtype A[{}] = {{\n{a}  }};\n  return ARKodeButcherTable_Create({stages}, {}, 0, c, A, b, NULL);\n}}\n",
        comment(&table.description()),
        array("c", &table.entries.c),
        array("b", &table.entries.b),
        stages * stages,
        table.main_order(),
    ))
}

/// A table of SPRKStep: a stage kicks with the first function, then drifts with the second.
fn splitting(table: &Table<'_>, flows: &Stepped) -> String {
    let (stages, name) = (flows.drifts.len(), &table.name);
    let (a, ahat) = (flows.stepping.drift, flows.stepping.kick);
    let mut lines = table.description();
    let [separable, nystrom] =
        [HamiltonianClass::Separable, HamiltonianClass::Nystrom].map(|class| table.order(class));
    if separable < nystrom {
        lines.push(format!(
            "The order {nystrom} needs a quadratic T, so the second function has to be linear; else it is {separable}."
        ));
    }
    format!(
        "{}#include <arkode/arkode_sprk.h>\n\n/* For SPRKStepSetMethod: f1 is the force at q, f2 the velocity at p. */\nstatic ARKodeSPRKTable {name}(void) {{\n{}{}  return ARKodeSPRKTable_Create({stages}, {}, {a}, {ahat});\n}}\n",
        comment(&lines),
        array(a, &flows.drifts),
        array(ahat, &flows.kicks),
        separable.max(nystrom),
    )
}

/// A constant array. In some versions the functions take pointers to non-constant numbers.
fn array(name: &str, entries: &[Entry]) -> String {
    let (length, numbers) = (entries.len(), numbers("    ", entries));
    format!("  static sunrealtype {name}[{length}] = {{\n{numbers}  }};\n")
}
