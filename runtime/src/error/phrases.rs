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
