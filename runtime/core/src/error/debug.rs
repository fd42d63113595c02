//! Errors as `main` and `unwrap` print them.

/// Prints the message of an error in `Debug`, too, because `unwrap` and a `main` that returns the error print this form. The message says
/// more than the names and values of fields.
#[doc(hidden)]
#[macro_export]
macro_rules! debug_by_message {
    ($name:ident) => {
        impl core::fmt::Debug for $name {
            fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                core::fmt::Display::fmt(self, formatter)
            }
        }
    };
}
pub use debug_by_message;
