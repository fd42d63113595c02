//! Readable errors: the message, the line of the input, and carets under the position.

use std::io::{IsTerminal, Write};
use std::process::ExitCode;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use symplectic_compiler::{Error, ErrorKind};

/// The exit status for an error: 1 if a file does not match or is not certified, 2 for invalid input.
pub fn status(error: &Error) -> u8 {
    match *error.kind {
        ErrorKind::Mismatch { .. } | ErrorKind::NotCertified { .. } => 1,
        _ => 2,
    }
}

/// The exit status of a command; an error is written to standard error.
pub fn exit_code(outcome: Result<ExitCode, Error>) -> ExitCode {
    outcome.unwrap_or_else(|error| {
        to_stderr(&error);
        ExitCode::from(status(&error))
    })
}

/// Writes an error to standard error, in colour if that is a terminal.
pub fn to_stderr(error: &Error) {
    // A failure to write an error cannot be reported.
    let _ = writeln!(std::io::stderr().lock(), "{}", render(error, in_colour()));
}

/// An error as text without colour: the message, and the line of the input with carets.
pub fn plain(error: &Error) -> String {
    render(error, false)
}

/// Writes a warning to standard error.
pub fn warning(message: &str) {
    let title = Level::WARNING.primary_title(message.to_owned());
    let text = renderer(in_colour()).render(&[Group::with_title(title)]);
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Writes an error to standard error as a warning.
pub fn warning_at(error: &Error) {
    let text = render_as(Level::WARNING, error, in_colour());
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

fn in_colour() -> bool {
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none()
}

fn renderer(colour: bool) -> Renderer {
    if colour {
        Renderer::styled()
    } else {
        Renderer::plain()
    }
}

fn render(error: &Error, colour: bool) -> String {
    render_as(Level::ERROR, error, colour)
}

fn render_as(level: Level<'_>, error: &Error, colour: bool) -> String {
    let renderer = renderer(colour);
    let message = error.kind.to_string();
    let title = level.primary_title(message);
    match &error.place {
        None => renderer.render(&[Group::with_title(title)]),
        Some(place) => {
            let place_in_text = AnnotationKind::Primary.span(place.span.clone());
            let source = Snippet::source(&place.text)
                .path(&place.input)
                .annotation(place_in_text);
            renderer.render(&[title.element(source)])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use symplectic_compiler::Place;

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
            ("ã", 2..2),
            ("a\u{2028}b 1/0", 6..9),
            ("a\tb", 2..3),
        ] {
            let place = Place {
                input: "nodes".to_owned(),
                text: text.to_owned(),
                span: span.clone(),
            };
            let rendered = render(&Error::at(ErrorKind::DivisionByZero, place), false);
            assert!(
                rendered.starts_with("error: division by zero"),
                "{rendered}"
            );
            assert!(rendered.contains('^'), "{text:?} {span:?}: {rendered}");
        }
    }
}
