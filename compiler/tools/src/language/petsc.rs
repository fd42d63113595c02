//! C for TS of PETSc.

use super::c::{comment, hexadecimal, numbers};
use super::not_expressible;
use super::table::{Stepped, Table};
use symplectic_compiler::Error;
use symplectic_compiler::Library;
use symplectic_compiler::order::HamiltonianClass;
use symplectic_exact::inverse;

pub(super) fn write(table: &Table<'_>) -> Result<String, Error> {
    if let Some(flows) = table.stepped_by(Library::Petsc) {
        return Ok(splitting(table, &flows));
    }
    if !table.is_runge_kutta() {
        let reason = "TS has partitioned methods that are explicit only (TSBASICSYMPLECTIC), and this one is implicit";
        return Err(not_expressible("PETSc", reason));
    }
    let a = table.tableau.numbers().a;
    let enclosed = |bits| {
        let rows = a
            .iter()
            .map(|row| row.iter().map(|x| x.enclose(bits)).collect());
        rows.collect()
    };
    let Some(inverse) = inverse::rounded(enclosed) else {
        let reason = "TSIRK needs the inverse of the matrix, and this one is singular";
        return Err(not_expressible("PETSc", reason));
    };
    Ok(implicit(table, &inverse))
}

/// Before this version `c` were kicks and came first: the same numbers are another method there.
const GUARD: &str = "#if PETSC_VERSION_LT(3, 19, 4)\n#error \"before PETSc 3.19.4 a stage of TSBASICSYMPLECTIC begins with the kick, and this table with the drift\"\n#endif\n";

/// A method of TSBASICSYMPLECTIC: a stage drifts, then kicks.
fn splitting(table: &Table<'_>, flows: &Stepped) -> String {
    let name = &table.name;
    let (c, d) = (flows.stepping.drift, flows.stepping.kick);
    let orders =
        [HamiltonianClass::Separable, HamiltonianClass::Nystrom].map(|class| table.order(class));
    let order = orders[0].max(orders[1]);
    format!(
        "{}#include <petscts.h>\n\n{GUARD}\n/* After it: TSSetType(ts, TSBASICSYMPLECTIC), TSBasicSymplecticSetType(ts, \"{name}\"). */\nstatic PetscErrorCode {name}_register(void)\n{{\n{}{}  PetscFunctionBegin;\n  PetscCall(TSBasicSymplecticRegister(\"{name}\", {order}, {}, {c}, {d}));\n  PetscFunctionReturn(PETSC_SUCCESS);\n}}\n",
        comment(&table.description()),
        array(c, &numbers("    ", &flows.drifts)),
        array(d, &numbers("    ", &flows.kicks)),
        flows.drifts.len(),
    )
}

/// A method of TSIRK.
fn implicit(table: &Table<'_>, inverse: &[Vec<f64>]) -> String {
    let (stages, name) = (table.tableau.stages(), &table.name);
    let plain = |values: &[f64]| -> String {
        let lines = values
            .iter()
            .map(|&value| format!("    {},\n", hexadecimal(value)));
        lines.collect()
    };
    let a: String = table
        .entries
        .a
        .iter()
        .map(|row| numbers("    ", row))
        .collect();
    // TSIRK reads this matrix column by column (`SNESTSFormFunction_IRK`), whatever its manual page says.
    let columns: Vec<f64> = (0..stages)
        .flat_map(|j| inverse.iter().map(move |row| row[j]))
        .collect();
    let sums: Vec<f64> = inverse.iter().map(|row| row.iter().sum()).collect();
    let identity: Vec<f64> = (0..stages * stages)
        .map(|k| f64::from(u8::from(k % (stages + 1) == 0)))
        .collect();
    let arrays = [
        array("A", &a),
        array("b", &numbers("    ", &table.entries.b)),
        array("c", &numbers("    ", &table.entries.c)),
        scalars("A_inv", &plain(&columns)),
        scalars("A_inv_rowsum", &plain(&sums)),
        scalars("I_s", &plain(&identity)),
    ];
    format!(
        "{}#include <petscts.h>\n\n/* Order {}. A is stored row by row, and A_inv column by column, as TSIRK reads it.\n   After TSIRKRegister(\"{name}\", {name}_create): TSSetType(ts, TSIRK), TSIRKSetNumStages(ts, {stages}), TSIRKSetType(ts, \"{name}\"). */\nstatic PetscErrorCode {name}_create(TS ts)\n{{\n{}  PetscFunctionBegin;\n  PetscCall(TSIRKTableauCreate(ts, {stages}, A, b, c, NULL, A_inv, A_inv_rowsum, I_s));\n  PetscFunctionReturn(PETSC_SUCCESS);\n}}\n",
        comment(&table.description()),
        table.main_order(),
        arrays.concat(),
    )
}

fn array(name: &str, lines: &str) -> String {
    format!("  PetscReal {name}[] = {{\n{lines}  }};\n")
}

fn scalars(name: &str, lines: &str) -> String {
    format!("  const PetscScalar {name}[] = {{\n{lines}  }};\n")
}
