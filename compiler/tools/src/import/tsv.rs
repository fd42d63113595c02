//! The tab-separated file of RungeKutta.jl.
//!
//! ```text
//! # order stages type
//! c_1  a_11 … a_1s
//! …
//! c_s  a_s1 … a_ss
//! 0    b_1  … b_s
//! ```

use std::ops::Range;

use super::numbers::{Numbers, half};
use symplectic_compiler::Limits;
use symplectic_compiler::expression::Input;
use symplectic_compiler::inside::Value;
use symplectic_compiler::inside::check_stages;
use symplectic_compiler::{Error, ErrorKind};

/// A word of the text and its bytes.
type Word<'a> = (&'a str, Range<usize>);

/// Whether the text is such a file: it begins with a number, or its first line is the one of `to_file` with a type of numbers, and no
/// assignment follows.
pub(super) fn is_tsv(text: &str) -> bool {
    const TYPES: [&str; 5] = ["Float16", "Float32", "Float64", "BigFloat", "Rational{"];
    let kind = header(text).and_then(|(_, kind)| kind);
    let whole = kind.is_some_and(|kind| TYPES.iter().any(|known| kind.starts_with(known)));
    match rows(text).next() {
        Some(row) if whole => row.iter().all(|(word, _)| !word.contains('=')),
        Some(row) => row[0].0.parse::<f64>().is_ok(),
        None => whole,
    }
}

/// The stages and the type in the first line.
fn header(text: &str) -> Option<(usize, Option<&str>)> {
    let mut words = text.lines().next()?.strip_prefix('#')?.split_whitespace();
    let _order: usize = words.next()?.parse().ok()?;
    let header = (words.next()?.parse().ok()?, words.next());
    words.next().is_none().then_some(header)
}

/// The words of each line that has any outside comments.
fn rows(text: &str) -> impl Iterator<Item = Vec<Word<'_>>> {
    let lines = text
        .lines()
        .map(move |line| line.split('#').next().unwrap_or(line));
    let rows = lines.map(move |line| {
        let words = line.split_whitespace();
        // A word is borrowed from the text.
        let place = |word: &str| (word.as_ptr() as usize).saturating_sub(text.as_ptr() as usize);
        words
            .map(|word| (word, place(word)..place(word) + word.len()))
            .collect()
    });
    rows.filter(|row: &Vec<Word<'_>>| !row.is_empty())
}

/// The table of such a file.
///
/// # Errors
/// [`ErrorKind::Document`] for the first word that is not a number, and rows that do not fit the stages.
pub(super) fn read(input: Input<'_>, limits: &Limits) -> Result<Numbers, Error> {
    let document = |message: String| ErrorKind::Document { message };
    let rows: Vec<Vec<Word<'_>>> = rows(input.text).collect();
    let header = header(input.text);
    let found = rows.len().saturating_sub(1);
    if let Some((stages, _)) = header.filter(|&(stages, _)| stages != found) {
        let first = input.text.lines().next().unwrap_or_default().len();
        let message = format!(
            "{stages} stages need {} rows of numbers, and the file has {}",
            stages.saturating_add(1),
            rows.len()
        );
        return Err(input.error(&(0..first), document(message)));
    }
    if found == 0 {
        let message =
            "there is no table: it has a row for each stage, and a row of weights".to_owned();
        return Err(input.error(&(0..0), document(message)));
    }
    check_stages(&found.into(), limits).map_err(|kind| input.error(&(0..0), kind))?;
    // The binary digits of the type; what it does not name is written as doubles.
    let bits = match header.and_then(|(_, kind)| kind) {
        Some("Float32") => 24,
        Some("BigFloat" | "Rational{BigInt}") => 256,
        _ => 53,
    };
    let mut values = Vec::with_capacity(rows.len());
    for (index, row) in rows.iter().enumerate() {
        let (start, end) = (row[0].1.start, row[row.len() - 1].1.end);
        if row.len() != rows.len() {
            let message = format!(
                "row {} has {} numbers, and a file of {} rows has as many columns",
                index + 1,
                row.len(),
                rows.len()
            );
            return Err(input.error(&(start..end), document(message)));
        }
        let number = |(word, span): &Word<'_>| {
            Value::rounded(word, bits).map_err(|kind| input.error(span, kind))
        };
        values.push(
            row.iter()
                .map(number)
                .collect::<Result<Vec<Value>, Error>>()?,
        );
    }
    let weights = values
        .pop()
        .map(|row| row[1..].to_vec())
        .unwrap_or_default();
    let nodes = values.iter().map(|row| row[0].clone()).collect();
    let matrix = values.iter().flat_map(|row| row[1..].to_vec()).collect();
    let place = rows.first().map_or(0..0, |row| row[0].1.clone());
    let positions =
        half(matrix, weights, Some(nodes), limits).map_err(|kind| input.error(&place, kind))?;
    Ok(Numbers::RungeKutta {
        positions,
        momenta: None,
    })
}
