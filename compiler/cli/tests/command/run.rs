//! Running the binary.
#![allow(dead_code)]

use std::process::{Command, Output};

/// Runs the binary.
pub fn symplectic(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_symplectic"))
        .args(arguments)
        .output()
        .expect("the binary runs")
}

/// The output of what must succeed without a message.
pub fn stdout(arguments: &[&str]) -> String {
    let output = symplectic(arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success() && errors.is_empty(),
        "{arguments:?}: {errors}"
    );
    String::from_utf8(output.stdout).expect("text")
}

/// Runs what must fail without output, and returns its status and message.
pub fn failure(arguments: &[&str]) -> (Option<i32>, String) {
    let output = symplectic(arguments);
    assert_eq!(String::from_utf8_lossy(&output.stdout), "", "{arguments:?}");
    let errors = String::from_utf8(output.stderr).expect("text");
    assert!(!errors.contains("panicked"), "{errors}");
    (output.status.code(), errors)
}
