//! Julia.

use super::table::{Entry, Table, comments};

pub(super) fn write(table: &Table<'_>) -> String {
    let name = &table.name;
    let entries: Vec<&Entry> = table.entries.iter().collect();
    let exact = entries.iter().all(|entry| entry.rational().is_some());
    let kind = if exact {
        "Rational{BigInt}"
    } else {
        "BigFloat"
    };
    let number = |entry: &Entry| match entry.rational() {
        Some((p, q)) if exact => format!("{}//{}", whole(p), whole(q.unwrap_or("1"))),
        _ => format!("big\"{}\"", entry.decimal),
    };
    let row = |entries: &[Entry], separator: &str| {
        let numbers: Vec<String> = entries.iter().map(number).collect();
        numbers.join(separator)
    };
    let mut text = comments("#", &table.description());
    if !exact {
        text.push_str("# Numbers are rounded to the digits that they have.\n");
    }
    text.push_str(&format!(
        "{name} = (\n    name = :{name},\n    order = {},\n    stages = {},\n",
        table.main_order(),
        table.tableau.stages()
    ));
    for (vector, entries) in table.vectors() {
        text.push_str(&format!("    {vector} = {kind}[{}],\n", row(entries, ", ")));
    }
    for (matrix, rows) in table.matrices() {
        let rows: Vec<String> = rows.iter().map(|entries| row(entries, " ")).collect();
        text.push_str(&format!(
            "    {matrix} = {kind}[\n        {}\n    ],\n",
            rows.join("\n        ")
        ));
    }
    text.push_str(")\n");
    if !table.matrices().is_empty() && !table.tableau.has_gradient_kicks() {
        text.push_str(&constructors(table));
    }
    text
}

/// An integer as a literal.
fn whole(digits: &str) -> String {
    // Up to 18 digits always fit into 64 bits.
    match digits.len() {
        ..=18 => digits.to_owned(),
        _ => format!("big\"{digits}\""),
    }
}

/// The constructors of Julia packages that take the table.
fn constructors(table: &Table<'_>) -> String {
    let t = &table.name;
    if table.is_runge_kutta() {
        return format!(
            "# RungeKutta.jl: Tableau({t}.name, {t}.order, {t}.a, {t}.b, {t}.c)\n\
             # DiffEqBase.jl: ImplicitRKTableau(Float64.({t}.a), Float64.({t}.c), Float64.({t}.b), {t}.order)\n\
             # RootedTrees.jl: RungeKuttaMethod({t}.a, {t}.b, {t}.c)\n"
        );
    }
    format!(
        "# RungeKutta.jl: PartitionedTableau({t}.name,\n\
         #     Tableau({t}.name, {t}.order, {t}.a, {t}.b, {t}.c),\n\
         #     Tableau({t}.name, {t}.order, {t}.a_tilde, {t}.b_tilde, {t}.c_tilde))\n\
         # RootedTrees.jl: AdditiveRungeKuttaMethod([\n\
         #     RungeKuttaMethod({t}.a, {t}.b, {t}.c), RungeKuttaMethod({t}.a_tilde, {t}.b_tilde, {t}.c_tilde)])\n"
    )
}
