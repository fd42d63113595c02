//! What files claim, checked by a program in Python that shares no code with the compiler.

use std::path::PathBuf;
use std::process::Command;

/// The output of Python; `None` if there is no Python 3.11 here.
fn python(arguments: &[&str]) -> Option<String> {
    let version = "import sys; sys.exit(sys.version_info < (3, 11))";
    let known = Command::new("python3").args(["-c", version]).status();
    known.ok().filter(std::process::ExitStatus::success)?;
    let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let output = Command::new("python3")
        .args(arguments)
        .current_dir(root)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .expect("Python runs");
    let (text, errors) = (output.stdout, String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(text).expect("text");
    assert!(output.status.success(), "{arguments:?}: {text}{errors}");
    Some(text)
}

#[test]
fn the_catalogue_is_right() {
    let Some(text) = python(&["tableaux/check_certificate.py"]) else {
        return;
    };
    assert_eq!(text.matches(": right: ").count(), 78, "{text}");
    // Enclosures, and functions that the program does not know.
    assert_eq!(text.matches(": not checked: ").count(), 62, "{text}");
    assert!(text.contains(
        "gauss-3.toml: right: decimals, symplectic, symmetric, general 6, separable 6, nystrom 6"
    ));
    assert!(text.contains("gauss-4.toml: right: decimals, symplectic, symmetric, general 6 of 8, separable 8, nystrom 8"));
}

/// The numbers of rooted trees with two colours, in all and where the colours alternate (OEIS A000151, A000081, each twice).
#[test]
fn the_trees_are_counted_right() {
    let program = "import sys; sys.path.insert(0, 'tableaux'); import check_certificate as c; \
                   print([len(c.trees(n, 'general')) for n in range(1, 7)], [len(c.trees(n, 'separable')) for n in range(1, 10)])";
    let Some(text) = python(&["-c", program]) else {
        return;
    };
    let expected = "[2, 4, 14, 52, 214, 916] [2, 2, 4, 8, 18, 40, 96, 230, 572]\n";
    assert_eq!(text, expected);
}

/// Every digit of ten files and some of others, changed.
#[test]
fn a_wrong_digit_is_found() {
    let arguments = "compiler/tests/certificates/mutations.py tableaux \
         all-of symplectic-euler symplectic-euler-adjoint midpoint stormer-verlet velocity-verlet position-verlet \
         ruth-1983 radau-left-2 gauss-2 lobatto-3 \
         sampled gauss-3 forest-ruth-1990 saba-2 leok-zhang-3 newton-cotes-4 lobatto-2-exchanged";
    let arguments: Vec<&str> = arguments.split_whitespace().collect();
    let Some(text) = python(&arguments) else {
        return;
    };
    let tried = text.strip_suffix(" changes\n").map(str::parse::<usize>);
    assert!(matches!(tried, Some(Ok(5000..))), "{text}");
}
