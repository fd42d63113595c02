//! The page: one table per library, with the differences above it.

use super::{Audit, Row, Verdict};

const STYLE: &str = "body{font:15px/1.5 system-ui,sans-serif;max-width:78rem;margin:2rem auto;padding:0 1rem;color:#222}\
table{border-collapse:collapse;width:100%;margin:0 0 2rem;font-size:13px}th,td{padding:.3rem .5rem;text-align:left;vertical-align:top;\
border-bottom:1px solid #ddd}th{border-bottom:2px solid #888}.less{background:#fbe4e0}.more{background:#e4f0fb}\
.unexplained{outline:2px solid #c00}code{font-size:12px}p.convention{color:#555;font-size:13px}";

pub(super) fn page(audit: &Audit) -> String {
    let differences: Vec<&Row> = audit.differences().collect();
    let unexplained = audit.unexplained().count();
    let mut body = format!(
        "<h1>Claims and proofs of symplectic tables</h1>\n<p>{} tables, for {} of which the proved order is not the claimed order; {} unexplained. \
         An order is proved by its order conditions in exact arithmetic, for the exact method near the decimals where the numbers are \
         decimals. Observed is the slope of the error of one step in 96 digits, for H = √(1 + p²) (2 − cos q), for H = √(1 + p²) − cos q and for H = p²/2 − cos q.</p>\n",
        audit.rows.len(),
        differences.len(),
        unexplained
    );
    if !differences.is_empty() {
        body.push_str("<h2>Differences</h2>\n<ul>\n");
        for row in &differences {
            body.push_str(&format!("<li>{}</li>\n", escape(&difference(row))));
        }
        body.push_str("</ul>\n");
    }
    let key = |row: &Row| -> [String; 4] {
        [&row.library, &row.version, &row.source, &row.convention].map(String::clone)
    };
    let mut sources: Vec<[String; 4]> = Vec::new();
    for row in &audit.rows {
        let source = key(row);
        if !sources.contains(&source) {
            sources.push(source);
        }
    }
    for source in sources {
        let rows: Vec<&Row> = audit.rows.iter().filter(|row| key(row) == source).collect();
        let Some(first) = rows.first() else { continue };
        let address = escape(&first.source);
        let address =
            match first.source.starts_with("http://") || first.source.starts_with("https://") {
                true => format!("<a href=\"{address}\">{address}</a>"),
                false => address,
            };
        body.push_str(&format!(
            "<h2>{}</h2>\n<p class=\"convention\">{}, {address}. Steps: {}.</p>\n",
            escape(&first.library),
            escape(&first.version),
            escape(&first.convention)
        ));
        body.push_str(
            "<table>\n<tr><th>table</th><th>stages</th><th>claim</th><th>every H</th><th>T(p) + U(q)</th><th>T quadratic</th><th>first violated condition</th>\
             <th>observed for each</th><th></th><th>places of an exact method</th><th>stable hω</th></tr>\n",
        );
        rows.iter().for_each(|row| body.push_str(&line(row)));
        body.push_str("</table>\n");
    }
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>Claims and proofs of symplectic tables</title>\n\
         <style>{STYLE}</style></head>\n<body>\n{body}</body>\n</html>\n"
    )
}

/// A difference in words.
fn difference(row: &Row) -> String {
    let proved = row.proved();
    let violated = match (&proved.violated, &proved.residual) {
        (Some(tree), Some(residual)) => format!("; the condition of {tree} is off by {residual}"),
        _ => String::new(),
    };
    format!(
        "{} {}: claimed {} for {} H, proved {}{violated}. Orders for every H, for T(p) + U(q) and for quadratic T: {}, {}, {}; observed {}.",
        row.library,
        row.name,
        row.claim.order,
        row.claim.class,
        proved.order,
        row.general.order,
        row.separable.order,
        row.nystrom.order,
        seen(row)
    )
}

fn seen(row: &Row) -> String {
    let shown = |seen: Option<f64>| seen.map_or("–".to_owned(), |seen| format!("{seen:.2}"));
    let seen = [row.seen_coupled, row.seen_relativistic, row.seen_quadratic];
    seen.map(shown).join(", ")
}

fn line(row: &Row) -> String {
    let mut class = match row.verdict {
        Verdict::AsClaimed => String::new(),
        Verdict::LessThanClaimed => "less".to_owned(),
        Verdict::MoreThanClaimed => "more".to_owned(),
    };
    if !row.explained {
        class.push_str(" unexplained");
    }
    let proved = row.proved();
    let violated = match (&proved.violated, &proved.residual) {
        (Some(tree), Some(residual)) => format!("{tree}: {residual}"),
        _ => "–".to_owned(),
    };
    let kinds = [(row.symmetric, "symmetric"), (row.symplectic, "symplectic")];
    let kinds: Vec<&str> = kinds
        .into_iter()
        .filter_map(|(holds, word)| holds.then_some(word))
        .collect();
    let places = match row.right_places {
        Some((right, printed)) => format!("{right} of {printed}"),
        None => row.numbers.clone(),
    };
    // Distant intervals are often very narrow; JSON has all of them.
    let stable = match row.stable.split_once(" ∪ ") {
        Some((first, _)) => format!("{first} ∪ …"),
        None => row.stable.clone(),
    };
    let cells = [
        row.name.clone(),
        row.stages.to_string(),
        format!("{} ({})", row.claim.order, row.claim.class),
        format!("{}, {}", row.general.order, row.general.evidence),
        format!("{}, {}", row.separable.order, row.separable.evidence),
        format!("{}, {}", row.nystrom.order, row.nystrom.evidence),
        violated,
        seen(row),
        kinds.join(", "),
        places,
        stable,
    ];
    let note = row
        .note
        .as_deref()
        .map_or(String::new(), |note| format!(" title=\"{}\"", escape(note)));
    let cells: String = cells
        .iter()
        .map(|cell| format!("<td>{}</td>", escape(cell)))
        .collect();
    format!("<tr class=\"{class}\"{note}>{cells}</tr>\n")
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
