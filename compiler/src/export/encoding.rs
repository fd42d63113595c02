//! The text of a file.

use std::io::Read;
use std::path::Path;

use crate::error::{Error, ErrorKind};
use crate::expression::without_mark;

/// The largest table file that is read, in bytes; a file with 36 stages has about 1 MB.
const MAX_FILE: u64 = 64 << 20;

/// The text of a table file, without a byte-order mark. Carriage returns without a line feed become line feeds.
///
/// # Errors
/// [`ErrorKind::Document`] if the file cannot be read, is too large or is not UTF-8 text; the message identifies UTF-16 and
/// UTF-32.
pub fn read_text(path: &Path) -> Result<String, Error> {
    let name = path.display();
    let unreadable = |error: std::io::Error| bad(format!("cannot read `{name}`: {error}"));
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(unreadable)?;
    file.take(MAX_FILE + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() as u64 > MAX_FILE {
        return Err(bad(format!(
            "`{name}` is longer than {MAX_FILE} bytes, too long for a table file"
        )));
    }
    decode(&name.to_string(), bytes)
}

fn bad(message: String) -> Error {
    ErrorKind::Document { message }.into()
}

/// UTF-8 bytes as text, without a byte-order mark.
fn decode(name: &str, bytes: Vec<u8>) -> Result<String, Error> {
    const INSTEAD: &str = "save it as UTF-8 (in PowerShell with `-Encoding utf8`)";
    if let Some(encoding) = wide_encoding(&bytes) {
        return Err(bad(format!("`{name}` is {encoding} text; {INSTEAD}")));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        bad(format!(
            "`{name}` is not UTF-8 text: the byte at offset {valid} is wrong; {INSTEAD}"
        ))
    })?;
    Ok(with_line_feeds(without_mark(&text)))
}

/// The text with the line ends of old Macintosh programs replaced by those of TOML; all offsets stay the same.
fn with_line_feeds(text: &str) -> String {
    let mut rest = text.chars().peekable();
    let mut lines = String::with_capacity(text.len());
    while let Some(c) = rest.next() {
        let alone = c == '\r' && rest.peek() != Some(&'\n');
        lines.push(if alone { '\n' } else { c });
    }
    lines
}

/// The UTF-16 or UTF-32 encoding of a text, detected by its byte-order mark or by its first character, which is
/// ASCII in a table file.
fn wide_encoding(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0xff, 0xfe, 0, 0, ..] | [1..=255, 0, 0, 0, ..] => Some("UTF-32 (little-endian)"),
        [0, 0, 0xfe, 0xff, ..] | [0, 0, 0, 1..=255, ..] => Some("UTF-32 (big-endian)"),
        [0xff, 0xfe, ..] | [1..=255, 0, ..] => Some("UTF-16 (little-endian)"),
        [0xfe, 0xff, ..] | [0, 1..=255, ..] => Some("UTF-16 (big-endian)"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_is_dropped_and_other_encodings_are_named() {
        let text = "{\"name\": \"ã\"}\r\n";
        let utf16 =
            |unit: fn(u16) -> [u8; 2]| -> Vec<u8> { text.encode_utf16().flat_map(unit).collect() };
        let utf32 = |unit: fn(u32) -> [u8; 4]| -> Vec<u8> {
            text.chars().flat_map(|c| unit(c.into())).collect()
        };
        let after = |mark: &[u8], bytes: &[u8]| [mark, bytes].concat();
        for bytes in [text.into(), after(b"\xef\xbb\xbf", text.as_bytes())] {
            assert_eq!(decode("x", bytes), Ok(text.to_owned()));
        }
        assert_eq!(decode("x", Vec::new()), Ok(String::new()));
        assert_eq!(
            decode("x", b"\xef\xbb\xbfa\rb\r\nc\r\rd\r".to_vec()),
            Ok("a\nb\r\nc\n\nd\n".to_owned())
        );
        let refused = [
            (utf16(u16::to_le_bytes), "UTF-16 (little-endian)"),
            (utf16(u16::to_be_bytes), "UTF-16 (big-endian)"),
            (
                after(b"\xff\xfe", &utf16(u16::to_le_bytes)),
                "UTF-16 (little-endian)",
            ),
            (
                after(b"\xfe\xff", &utf16(u16::to_be_bytes)),
                "UTF-16 (big-endian)",
            ),
            (utf32(u32::to_le_bytes), "UTF-32 (little-endian)"),
            (utf32(u32::to_be_bytes), "UTF-32 (big-endian)"),
            (
                after(b"\xff\xfe\0\0", &utf32(u32::to_le_bytes)),
                "UTF-32 (little-endian)",
            ),
            (
                after(b"\0\0\xfe\xff", &utf32(u32::to_be_bytes)),
                "UTF-32 (big-endian)",
            ),
        ];
        for (bytes, encoding) in refused {
            let message = decode("x", bytes).expect_err("refused").to_string();
            assert!(
                message.starts_with(&format!("`x` is {encoding} text; save it as UTF-8")),
                "{message}"
            );
        }
        let message = decode("x", b"a\xe3".to_vec())
            .expect_err("refused")
            .to_string();
        assert!(
            message.contains("the byte at offset 1 is wrong; save it as UTF-8"),
            "{message}"
        );
    }
}
