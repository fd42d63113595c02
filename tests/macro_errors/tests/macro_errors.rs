//! What the macro refuses, and what it says: the right words at the right tokens.

use std::path::Path;
use std::{fs, io};

/// The files that `cases/files.rs` names, made from the catalogue.
///
/// Paths are relative to the crate, and for the cases this is the one that trybuild makes.
fn write_files() -> io::Result<()> {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .parent()
        .unwrap_or(Path::new(""));
    let folder = target.join("tests/trybuild").join(env!("CARGO_PKG_NAME"));
    fs::create_dir_all(&folder)?;
    let lobatto = fs::read_to_string(
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tableaux/lobatto-3.toml"),
    )?;
    let half = lobatto.find("[decimals]").unwrap_or(lobatto.len());
    // 1/6 to its last digit.
    let edited = lobatto.replacen("6666667\"", "6666666\"", 1);
    assert_ne!(edited, lobatto);
    for (name, text) in [
        ("not_toml.toml", "The four-stage Gauss method\n"),
        ("no_table.toml", "[package]\nname = \"gauss-4\"\n"),
        ("truncated.toml", &lobatto[..half]),
        ("last_digit.toml", &edited),
        ("lobatto-3.toml", &lobatto),
        ("not_toml.txt", "gauss(4)\n"),
    ] {
        fs::write(folder.join(name), text)?;
    }
    Ok(())
}

#[test]
fn errors_say_what_is_wrong_and_where() -> io::Result<()> {
    write_files()?;
    trybuild::TestCases::new().compile_fail("cases/*.rs");
    Ok(())
}
