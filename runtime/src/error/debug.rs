//! Errors as `main` and `unwrap` print them.

/// Prints an error by its message in `Debug`, too: a `main` that returns it, and `unwrap`, print that form. It says more than the names and
/// values of fields.
macro_rules! debug_by_message {
    ($name:ident) => {
        impl core::fmt::Debug for $name {
            fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                core::fmt::Display::fmt(self, formatter)
            }
        }
    };
}
pub(crate) use debug_by_message;
