//! Parts of error messages.

use core::fmt;

use super::ConstraintName;

/// " (`name`)", or nothing.
pub(super) struct Named(pub(super) Option<ConstraintName>);

impl fmt::Display for Named {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0
            .map_or(Ok(()), |name| write!(formatter, " (`{name}`)"))
    }
}

/// A number of entries.
pub(super) struct Entries(pub(super) usize);

impl fmt::Display for Entries {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ending = if self.0 == 1 { "y" } else { "ies" };
        write!(formatter, "{} entr{ending}", self.0)
    }
}

/// A number; one that is very small or very large with an exponent, and not with hundreds of zeros.
pub struct Short(pub f64);

impl fmt::Display for Short {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(number) = *self;
        if number == 0.0 || !number.is_finite() || (1e-5..1e16).contains(&number.abs()) {
            write!(formatter, "{number}")
        } else {
            write!(formatter, "{number:e}")
        }
    }
}

/// The undetermined component, or nothing.
pub(super) struct Undetermined(pub(super) Option<usize>);

impl fmt::Display for Undetermined {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |component| {
            write!(
                formatter,
                ": ∂L/∂v does not determine component {component}"
            )
        })
    }
}

/// " at stage i", or nothing.
pub(super) struct AtStage(pub(super) Option<usize>);

impl fmt::Display for AtStage {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0
            .map_or(Ok(()), |stage| write!(formatter, " at stage {stage}"))
    }
}

/// What an iteration did instead of converging.
pub(super) struct Divergence {
    pub(super) residual: f64,
    pub(super) iterations: u32,
}

impl fmt::Display for Divergence {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            residual,
            iterations,
        } = *self;
        if residual.is_finite() {
            write!(
                formatter,
                "did not converge in {iterations} iterations (last relative change {residual:e})"
            )
        } else {
            write!(formatter, "are not finite after {iterations} iterations")
        }
    }
}
