//! Reading compositions: `[[γ_1, definition of Φ_1], …]`.

use std::ops::Range;

use super::problem::Problem;
use crate::definition::{Definition, Key, pieces, read_parts, trimmed};
use crate::error::{Error, ErrorKind, Place};
use crate::expression::{Input, parse_list, shown};
use crate::limits::Limits;
use crate::quadrature::check_stages;
use crate::symbolic::Constant;

/// A step `Φ_{γh}` of a composition.
#[derive(Clone)]
pub struct Step {
    /// The fraction `γ` of the whole step.
    pub fraction: Constant,
    /// The definition of the method `Φ`.
    pub method: Problem,
}

/// The deepest nesting of brackets in a composition; it bounds the recursion over compositions of compositions.
const MAX_DEPTH: usize = 64;

/// Returns an error if brackets are nested too deeply in the text of a composition.
///
/// # Errors
/// [`ErrorKind::ExpressionSize`]
pub fn check_depth(text: &str) -> Result<(), ErrorKind> {
    let (mut depth, mut deepest) = (0_usize, 0);
    for byte in text.bytes() {
        match byte {
            b'(' | b'[' => depth += 1,
            b')' | b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        deepest = deepest.max(depth);
    }
    if deepest > MAX_DEPTH {
        return Err(ErrorKind::ExpressionSize {
            what: "the depth of the brackets of a composition",
            size: deepest,
            limit: MAX_DEPTH,
        });
    }
    Ok(())
}

/// Reads the steps of a composition.
///
/// # Errors
/// The errors of the first wrong step, at their place in the text of the composition;
/// brackets nested too deeply; more stages than the limit.
pub fn read(text: &str, limits: &Limits) -> Result<Vec<Step>, Vec<Error>> {
    let input = Input {
        name: Key::Compose.name(),
        text,
    };
    let whole = trimmed(text, 0..text.len());
    let at_whole = |kind| vec![input.error(&whole, kind)];
    check_depth(text).map_err(at_whole)?;
    let mut steps = Vec::new();
    let mut stages = 0;
    for range in items(text, whole.clone()) {
        let step = read_step(input, range, limits)?;
        stages += step.method.stages();
        // Checked before the next step is read, so that the work on an input is bounded by its number of stages.
        check_stages(&stages.into(), limits).map_err(at_whole)?;
        steps.push(step);
    }
    Ok(steps)
}

/// The items of a list with or without brackets and with or without a trailing comma.
fn items(text: &str, range: Range<usize>) -> Vec<Range<usize>> {
    let list = inner(text, &range).map(|inner| trimmed(text, inner));
    // The brackets belong to the list, not to its only item, if items begin inside them.
    let list = list.filter(|inner| text[inner.clone()].starts_with('[') && is_one(text, &range));
    separated(text, list.unwrap_or(range))
}

/// Whether a range contains no comma outside brackets.
fn is_one(text: &str, range: &Range<usize>) -> bool {
    pieces(text, range.clone()).len() == 1
}

/// The parts between commas, without surrounding white space.
pub(super) fn separated(text: &str, range: Range<usize>) -> Vec<Range<usize>> {
    let pieces = pieces(text, range).into_iter();
    let mut pieces: Vec<_> = pieces.map(|piece| trimmed(text, piece)).collect();
    if pieces.len() > 1 && pieces.last().is_some_and(Range::is_empty) {
        pieces.pop();
    }
    pieces
}

/// The text between brackets.
pub(super) fn inner(text: &str, range: &Range<usize>) -> Option<Range<usize>> {
    let part = &text[range.clone()];
    let bracketed = part.len() >= 2 && part.starts_with('[') && part.ends_with(']');
    bracketed.then(|| range.start + 1..range.end - 1)
}

/// Reads `[γ, definition]`.
fn read_step(input: Input<'_>, range: Range<usize>, limits: &Limits) -> Result<Step, Vec<Error>> {
    let text = input.text;
    let one = |error| vec![error];
    let Some(inner) = inner(text, &range) else {
        let found = match &text[range.clone()] {
            "" => "nothing".to_owned(),
            part => format!("`{}`", shown(part)),
        };
        let expected =
            "a list of steps `[fraction, definition]`: [[1/2, basis: 1, nodes: 0], [1/2, basis: 1, nodes: 1]]"
                .to_owned();
        return Err(one(
            input.error(&range, ErrorKind::Syntax { found, expected })
        ));
    };
    let mut parts = separated(text, inner).into_iter();
    let fraction = parts.next().unwrap_or_default();
    let fraction = read_fraction(input, fraction).map_err(one)?;
    let parts = read_parts(input, parts).map_err(one)?;
    let definition = parts
        .iter()
        .map(|(key, range)| (*key, &text[range.clone()]));
    let method = Problem::read(&Definition::new(definition), limits).map_err(|errors| {
        let moved = |error| in_text(input, &range, &parts, error);
        errors.into_iter().map(moved).collect::<Vec<_>>()
    })?;
    Ok(Step { fraction, method })
}

/// Reads the single constant in a range.
fn read_fraction(input: Input<'_>, range: Range<usize>) -> Result<Constant, Error> {
    let part = Input {
        text: &input.text[range.clone()],
        ..input
    };
    let read = parse_list(part).and_then(|items| match items.as_slice() {
        [item] => item.constant(part),
        _ => {
            let kind = ErrorKind::Syntax {
                found: format!("`{}`", shown(part.text)),
                expected: "one fraction of the step".to_owned(),
            };
            Err(part.error(&(0..part.text.len()), kind))
        }
    });
    read.map_err(|error| shifted(input, &range, error))
}

/// Moves the place of an error in a part of a definition to the text that contains the definition.
pub(super) fn in_text(
    input: Input<'_>,
    definition: &Range<usize>,
    parts: &[(Key, Range<usize>)],
    error: Error,
) -> Error {
    let about = error.place.as_ref().map(|place| place.input.as_str());
    match parts.iter().find(|(key, _)| Some(key.name()) == about) {
        Some((_, range)) => shifted(input, range, error),
        None => input.error(definition, *error.kind),
    }
}

/// Moves the place of an error in a range to the whole text.
fn shifted(input: Input<'_>, range: &Range<usize>, error: Error) -> Error {
    let moved = |offset: usize| (range.start + offset).min(range.end);
    let span = error.place.map_or(range.clone(), |Place { span, .. }| {
        moved(span.start)..moved(span.end)
    });
    input.error(&span, *error.kind)
}
