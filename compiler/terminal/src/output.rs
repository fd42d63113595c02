//! Text on standard output.

use std::io::{ErrorKind as IoErrorKind, Write};
use std::process::ExitCode;

use symplectic_compiler::export::columns;
use symplectic_compiler::{Error, ErrorKind};

/// Prints to standard output. A closed pipe is not an error.
pub fn print(text: &str) -> Result<ExitCode, Error> {
    let mut stdout = std::io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        Ok(()) => Ok(ExitCode::SUCCESS),
        Err(error) if error.kind() == IoErrorKind::BrokenPipe => Ok(ExitCode::SUCCESS),
        Err(error) => {
            let message = format!("cannot write the output: {error}");
            Err(ErrorKind::Document { message }.into())
        }
    }
}

/// A table with its columns aligned on a screen.
pub fn aligned<const N: usize>(rows: &[[String; N]]) -> String {
    let mut widths = [0; N];
    for row in rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = columns::width(cell).max(*width);
        }
    }
    let mut text = String::new();
    for row in rows {
        let cells = row.iter().zip(widths);
        let cells: Vec<String> = cells
            .map(|(cell, width)| columns::left(cell, width))
            .collect();
        text.push_str("  ");
        text.push_str(cells.join("  ").trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::aligned;

    #[test]
    fn combining_marks_do_not_shift_columns() {
        let rows =
            [["IIIF\u{304}", "2"], ["IIIF", "2"], ["I", "4"]].map(|row| row.map(str::to_owned));
        assert_eq!(aligned(&rows), "  IIIF\u{304}  2\n  IIIF  2\n  I     4\n");
    }
}
