//! Aligned columns on a screen.

/// The number of columns of a text on a screen: combining marks, as in `b̃`, take none.
///
/// ```
/// use symplectic_compiler::export::columns::{left, width};
///
/// assert_eq!(width("IIIF\u{304}"), 4);
/// assert_eq!(left("IIIF\u{304}", 6), "IIIF\u{304}  ");
/// ```
pub fn width(text: &str) -> usize {
    text.chars()
        .filter(|c| !('\u{300}'..='\u{36f}').contains(c))
        .count()
}

/// The text padded with spaces on the left, up to a width.
pub(super) fn right(text: &str, to: usize) -> String {
    format!("{}{text}", " ".repeat(to.saturating_sub(width(text))))
}

/// The text padded with spaces on the right, up to a [width].
pub fn left(text: &str, to: usize) -> String {
    format!("{text}{}", " ".repeat(to.saturating_sub(width(text))))
}

/// The width of each column of a table.
pub(super) fn widths<'a>(rows: impl IntoIterator<Item = &'a Vec<String>>) -> Vec<usize> {
    let mut widths: Vec<usize> = Vec::new();
    for row in rows {
        widths.resize(widths.len().max(row.len()), 0);
        for (known, cell) in widths.iter_mut().zip(row) {
            *known = (*known).max(width(cell));
        }
    }
    widths
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn combining_marks_have_width_zero() {
        assert_eq!(width("b̃_1"), 3);
        assert_eq!(right("c̃", 3), "  c̃");
        assert_eq!(left("ã", 3), "ã  ");
        assert_eq!(
            widths(&[vec!["a".into()], vec!["".into(), "bc".into()]]),
            [1, 2]
        );
    }
}
