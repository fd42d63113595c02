//! Errors of steps, in the terms of a setup file.

use symplectic::Error;

/// The message of an error, with the keys of a file in place of calls that a file cannot make.
pub(super) fn message(mut error: Error) -> String {
    match &mut error {
        Error::NoConvergence {
            newton_may_help, ..
        } => {
            let newton = match std::mem::take(newton_may_help) {
                true => ", or `solver = \"newton\"` for a stiff system",
                false => "",
            };
            format!("{error} (the key `step_size`){newton}")
        }
        Error::Stagnation { .. } => {
            format!(
                "{error}; the keys are `step_size` and `sums`, a tolerance needs a program with the macros"
            )
        }
        _ => error.to_string(),
    }
}
