//! Checking a file from nothing but its definition.

use std::path::Path;

use crate::error::{Error, ErrorKind};
use crate::export::{self, compare};
use crate::expression::Input;
use crate::limits::Limits;
use crate::tableau::Tableau;

/// Checks a table file, TOML or JSON by the extension of its name, and returns its tableau.
///
/// Nothing in the file is trusted. The tableau is derived again from its definition, and its
/// properties are proved. Every entry of the file is compared with the result, in the order of the
/// entries: the node polynomial, exact data, decimals to their last digit, doubles, properties with
/// their evidence. The name and the source are not checked. A file of an older format may lack properties, orders and stability.
///
/// # Errors
/// [`ErrorKind::Mismatch`] for the first entry that differs; [`ErrorKind::Document`] if the file is
/// not a table file; every error of [`derive`](crate::derive()) for its definition. Each with its
/// place in the file.
///
/// ```
/// use symplectic_compiler::{Limits, check, derive, export::toml};
///
/// let text = toml::write(&derive("polynomial(2)", "gauss(2)")?, 10);
/// check("gauss.toml", &text, &Limits::default())?;
///
/// let edited = text.replace("0.2886751346", "0.2886751345").replace("0.5386751346", "0.5386751347");
/// let error = check("gauss.toml", &edited, &Limits::default()).unwrap_err();
/// assert!(error.to_string().ends_with(
///     "`a_21 (decimal)` does not fit: the file has 0.5386751347, the derivation gives 0.5386751346"
/// ));
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
pub fn check(file_name: &str, text: &str, limits: &Limits) -> Result<Tableau, Error> {
    check_and_list(file_name, text, limits).map(|(tableau, _)| tableau)
}

/// [Checks](check()) a file, and returns with its tableau the names of the properties that the file does not state: files of
/// older formats may lack them.
///
/// # Errors
/// Those of [`check`].
///
/// ```
/// use symplectic_compiler::{Limits, check_and_list, derive, export::toml};
///
/// let text = toml::write(&derive("polynomial(2)", "gauss(2)")?, 10);
/// let older = text.replace("format = 2\n", "");
/// let older: Vec<&str> = older.lines().filter(|line| !line.starts_with("constrained")).collect();
/// let (_, not_stated) = check_and_list("gauss.toml", &older.join("\n"), &Limits::default())?;
/// assert_eq!(not_stated, ["constrained"]);
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
pub fn check_and_list(
    file_name: &str,
    text: &str,
    limits: &Limits,
) -> Result<(Tableau, Vec<&'static str>), Error> {
    let extension = Path::new(file_name).extension().and_then(|e| e.to_str());
    match extension.map(str::to_ascii_lowercase).as_deref() {
        Some("toml") => check_toml(file_name, text, limits),
        // Reading JSON is checking it.
        Some("json") => export::json::read_and_compare(file_name, text, limits),
        _ => Err(ErrorKind::Document {
            message: format!("`{file_name}` is named neither .toml nor .json"),
        }
        .into()),
    }
}

fn check_toml(
    file_name: &str,
    text: &str,
    limits: &Limits,
) -> Result<(Tableau, Vec<&'static str>), Error> {
    let file = Input::of_file(file_name, text);
    let document = export::toml::Document::parse(file, limits)?;
    let tableau = document.derive(file, limits)?;
    let Some(digits) = document.digits() else {
        // Only a definition: there is nothing to compare.
        return Ok((tableau, Vec::new()));
    };
    let fresh = export::toml::write(&tableau, digits);
    let expected = Input {
        name: "the derivation",
        text: &fresh,
    };
    let expected = export::toml::Document::parse(expected, limits)?;
    compare(
        file,
        document.format,
        &tableau,
        document.entries(),
        expected.entries(),
    )?;
    Ok((tableau, document.not_stated()))
}
