//! Systems from files.

use std::path::Path;

use symplectic_compiler::export::read_text;
use symplectic_compiler::{Error, ErrorKind};
use symplectic_formula::{Form, Structure, System};

/// Reads and checks the system of a file: a formula, or a TOML file with one.
pub(crate) fn read(file: &Path) -> Result<(System, Structure), Error> {
    let name = file.display().to_string();
    let mut text = read_text(file)?;
    let mut form = Form::of(&text);
    if file
        .extension()
        .is_some_and(|extension| extension == "toml")
    {
        (form, text) = formula(&name, &text)?;
    }
    let mut system = System::read_as(form, &name, &text)?;
    let structure = Structure::of(&mut system);
    system.check(&structure, &text)?;
    Ok((system, structure))
}

/// The formula in a TOML file.
fn formula(name: &str, text: &str) -> Result<(Form, String), Error> {
    let refused = |message: String| Error::from(ErrorKind::Document { message });
    let table: toml::Table = text
        .parse()
        .map_err(|error| refused(format!("{name}: {error}")))?;
    let value = |key: &str| table.get(key).and_then(toml::Value::as_str);
    match (value("hamiltonian"), value("lagrangian")) {
        (Some(formula), None) => Ok((Form::Hamiltonian, formula.to_owned())),
        (None, Some(formula)) => Ok((Form::Lagrangian, formula.to_owned())),
        (None, None) => Err(refused(format!(
            "{name} has no key `hamiltonian` or `lagrangian` with a formula in quotes"
        ))),
        (Some(_), Some(_)) => Err(refused(format!(
            "{name} has both keys `hamiltonian` and `lagrangian`: a system has one of them"
        ))),
    }
}
