//! Errors for people: the message, the line of the input and a caret under the place.

use std::io::{IsTerminal, Write};
use std::ops::Range;

use symplectic_compiler::{Error, ErrorKind, Place};
use unicode_width::UnicodeWidthStr;

/// Longer lines are not shown.
const LONGEST_LINE: usize = 400;

/// The exit status for an error: 1 where a file does not fit, 2 for bad input.
pub(crate) fn status(error: &Error) -> u8 {
    match *error.kind {
        ErrorKind::Mismatch { .. } => 1,
        _ => 2,
    }
}

/// Writes an error to standard error, in colour if that is a terminal.
pub(crate) fn to_stderr(error: &Error) {
    let stderr = std::io::stderr();
    let colour = stderr.is_terminal() && std::env::var_os("NO_COLOR").is_none();
    // There is nobody left to tell where this fails.
    let _ = stderr.lock().write_all(&render(error, colour));
}

fn render(error: &Error, colour: bool) -> Vec<u8> {
    error
        .place
        .as_ref()
        .and_then(|place| with_caret(&error.kind, place, colour))
        .unwrap_or_else(|| format!("Error: {error}\n").into_bytes())
}

/// The message over the line and the carets; `None` where the line is too long to look at.
fn with_caret(kind: &ErrorKind, place: &Place, colour: bool) -> Option<Vec<u8>> {
    let (number, line, span) = line_of(place);
    if line.len() > LONGEST_LINE {
        return None;
    }
    let (strong, red, plain) = if colour {
        ("\x1b[1;31m", "\x1b[31m", "\x1b[0m")
    } else {
        ("", "", "")
    };
    let column = line[..span.start].chars().count() + 1;
    let number = number.to_string();
    let gutter = " ".repeat(number.len());
    let before = " ".repeat(line[..span.start].width());
    let carets = "^".repeat(line[span].width().max(1));
    let input = &place.input;
    let shown = format!("{number} | {line}");
    let shown = shown.trim_end();
    let picture = format!(
        "{strong}Error{plain}: {kind}\n\
         {gutter}--> {input}:{number}:{column}\n\
         {gutter} |\n\
         {shown}\n\
         {gutter} | {before}{red}{carets}{plain}\n"
    );
    Some(picture.into_bytes())
}

/// The number of the line in which a place begins, counted from 1, the line, and the part of it that
/// the place covers.
fn line_of(place: &Place) -> (usize, String, Range<usize>) {
    let text = &place.text;
    let floor = |mut offset: usize| {
        offset = offset.min(text.len());
        while !text.is_char_boundary(offset) {
            offset -= 1;
        }
        offset
    };
    let (start, end) = (floor(place.span.start), floor(place.span.end));
    let first = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
    let last = text[start..]
        .find('\n')
        .map_or(text.len(), |length| start + length);
    // Characters that move the cursor would break the picture; bytes keep their places.
    let mut line = String::new();
    for c in text[first..last].chars() {
        if c.is_control() || matches!(c, '\u{2028}' | '\u{2029}') {
            line.push_str(&" ".repeat(c.len_utf8()));
        } else {
            line.push(c);
        }
    }
    let number = text[..first].matches('\n').count() + 1;
    (number, line, start - first..end.clamp(start, last) - first)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn caret(text: &str, span: Range<usize>) -> Vec<String> {
        let place = Place {
            input: "nodes".to_owned(),
            text: text.to_owned(),
            span,
        };
        let rendered = render(&Error::at(ErrorKind::DivisionByZero, place), false);
        let rendered = String::from_utf8(rendered).expect("text");
        rendered
            .lines()
            .map(|line| line.trim_end().to_owned())
            .collect()
    }

    #[test]
    fn every_span_has_a_caret_under_it() {
        for (text, span) in [
            ("0, 1/0", 3..6),
            ("(0, 1", 5..5),
            ("", 0..0),
            ("a", 1..1),
            ("0,\n 1/0,\n 1", 4..7),
            ("0,\n1", 2..2),
            ("0,\r\n1", 2..4),
            ("ã ∂ é 1/0", 11..14),
            ("ã", 1..1),
            ("a\u{2028}b 1/0", 6..9),
            ("a\tb", 2..3),
            ("1", 7..9),
        ] {
            let lines = caret(text, span.clone());
            assert!(
                lines.iter().any(|line| line.contains('^')),
                "{text:?} {span:?}: {lines:#?}"
            );
        }
    }

    #[test]
    fn wide_and_combining_letters_do_not_shift_the_carets() {
        assert_eq!(
            caret("ã ∂ 式 b̃ 1/0", "ã ∂ 式 b̃ ".len().."ã ∂ 式 b̃ 1/0".len()),
            [
                "Error: division by zero",
                " --> nodes:1:10",
                "  |",
                "1 | ã ∂ 式 b̃ 1/0",
                "  |          ^^^",
            ]
        );
    }

    #[test]
    fn lines_are_counted_in_the_whole_input() {
        assert_eq!(
            caret("0,\n 1/0,\n 1", 4..7)[1..],
            [" --> nodes:2:2", "  |", "2 |  1/0,", "  |  ^^^"]
        );
        // The end of a line and of the input.
        assert_eq!(caret("0,\n1", 2..2)[3..], ["1 | 0,", "  |   ^"]);
        assert_eq!(caret("(0, 1", 5..5)[3..], ["1 | (0, 1", "  |      ^"]);
        // A place of several lines is shown by its first.
        assert_eq!(caret("0,\n1", 0..4)[3..], ["1 | 0,", "  | ^^"]);
    }
}
