//! Errors of steps, in the terms of a setup file.

use symplectic::Error;

/// The same error without the advice to call `by_newton()`, which a file cannot follow.
pub(super) fn without_calls(mut error: Error) -> Error {
    if let Error::NoConvergence {
        newton_may_help, ..
    } = &mut error
    {
        *newton_may_help = false;
    }
    error
}

/// What a file can do about an error, and what it cannot.
pub(super) fn note(error: &Error) -> Option<&'static str> {
    match error {
        Error::NoConvergence { .. } => Some(
            "note: the key is `step_size`; Newton's iteration, for stiff systems, needs a program with the macros\n",
        ),
        Error::Stagnation { .. } => Some(
            "note: the keys are `step_size` and `sums`; a tolerance needs a program with the macros\n",
        ),
        _ => None,
    }
}
